"""Quantities of the working cycle."""

from __future__ import annotations

from crankwork.quantities.quantity import row

ROWS = (
    # fuel and mixture
    row("fuel_carbon", "", "C", "carbon in the fuel | содержание углерода в топливе"
         " | hàm lượng cacbon trong nhiên liệu",
         "Mass of carbon in 1 kg of fuel."),
    row("fuel_hydrogen", "", "H", "hydrogen in the fuel | содержание водорода в топливе"
         " | hàm lượng hyđrô trong nhiên liệu", "Mass of hydrogen in 1 kg of fuel."),
    row("fuel_oxygen", "", "O", "oxygen in the fuel | содержание кислорода в топливе"
         " | hàm lượng ôxy trong nhiên liệu", "Mass of oxygen in 1 kg of fuel."),
    row("fuel_molar_mass", "kg/kmol", "m_f|m_т|μ_nl", "molar mass of the fuel | молярная масса топлива"
         " | phân tử lượng của nhiên liệu", "Mass of 1 kmol of fuel vapour."),
    row("air_mass_needed", "", "l_0", "air needed by mass | теоретически необходимое количество воздуха, кг/кг"
         " | lượng không khí lý thuyết theo khối lượng", "Mass of air that burns 1 kg of fuel completely."),
    row("air_amount_needed", "kmol/kg", "L_0|L_0|M_0", "air needed | теоретически необходимое количество воздуха"
         " | lượng không khí lý thuyết", "Amount of air that burns 1 kg of fuel completely."),
    row("excess_air", "", "λ_a|α|α", "excess air ratio | коэффициент избытка воздуха | hệ số dư lượng không khí",
         "Air in the charge over the air that the fuel needs."),
    row("fresh_charge_amount", "kmol/kg", "M_1", "fresh charge | количество горючей смеси | lượng khí nạp mới",
         "Amount of fresh charge per 1 kg of fuel."),
    row("hydrogen_share", "", "K", "hydrogen over carbon monoxide | отношение количеств водорода и оксида углерода"
         " | tỉ số lượng hyđrô và cacbon monoxit", "Amount of hydrogen over that of carbon monoxide in rich products."),
    *(
        row(f"product_{key}", "kmol/kg", f"M_{formula}", f"{en} in the products | количество {ru} в продуктах сгорания"
             f" | lượng {vi} trong sản vật cháy", f"Amount of {en} in the products of 1 kg of fuel.")
        for key, formula, en, ru, vi in (
            ("co2", "CO₂", "carbon dioxide", "диоксида углерода", "cacbon đioxit"),
            ("co", "CO", "carbon monoxide", "оксида углерода", "cacbon monoxit"),
            ("h2o", "H₂O", "water vapour", "водяного пара", "hơi nước"),
            ("h2", "H₂", "hydrogen", "водорода", "hyđrô"),
            ("o2", "O₂", "oxygen", "кислорода", "ôxy"),
            ("n2", "N₂", "nitrogen", "азота", "nitơ"),
        )
    ),
    row("product_amount", "kmol/kg", "M_2", "products | количество продуктов сгорания | lượng sản vật cháy",
         "Amount of products of burning per 1 kg of fuel."),
    row("molar_change_ideal", "", "μ_0|μ_0|β_0", "ideal molar change"
         " | химический коэффициент молекулярного изменения | hệ số thay đổi phân tử lý thuyết",
         "Products over fresh charge, by amount."),
    row("molar_change", "", "μ|μ|β", "molar change | действительный коэффициент молекулярного изменения"
         " | hệ số thay đổi phân tử thực tế",
         "Products and residual gas over fresh charge and residual gas, by amount."),
    row("heat_lost_incomplete", "MJ/kg", "ΔH_u|ΔH_u|ΔQ_H", "heat lost to incomplete burning"
         " | потеря теплоты вследствие химической неполноты сгорания | tổn thất nhiệt do cháy không hết",
         "Heat that 1 kg of fuel does not give for want of air."),
    # intake and residual gas
    row("ambient_temperature", "K", "T_0", "ambient temperature | температура окружающей среды"
         " | nhiệt độ môi trường", "Absolute temperature of the surroundings."),
    row("charge_pressure", "MPa", "p_k|p_к|p_k", "pressure before the intake | давление перед впуском"
         " | áp suất trước xupáp nạp", "Absolute pressure behind compressor and cooler; ambient without them."),
    row("charge_temperature", "K", "T_k|T_к|T_k", "temperature before the intake | температура перед впуском"
         " | nhiệt độ trước xupáp nạp", "Absolute temperature behind compressor and cooler; ambient without them."),
    row("compressor_exponent", "", "n_k|n_к|m", "compressor exponent | показатель политропы в компрессоре"
         " | chỉ số nén đa biến trong máy nén", "Exponent of the polytrope of the compressor."),
    row("compressor_temperature", "K", "T_k′|T_к′|T_k′", "temperature behind the compressor"
         " | температура за компрессором | nhiệt độ sau máy nén", "Before the cooler."),
    row("cooler_drop", "K", "ΔT_cl|ΔT_охл|ΔT_m", "temperature drop of the cooler | охлаждение наддувочного воздуха"
         " | độ giảm nhiệt độ ở két làm mát khí nạp", "By how much the cooler lowers the temperature of the charge."),
    row("charge_density", "kg/m3", "ρ_k|ρ_к|ρ_k", "density before the intake | плотность заряда на впуске"
         " | khối lượng riêng của khí nạp", "Density of the air before the intake."),
    row("intake_loss_factor", "", "ξ_in|ξ_вп|ξ_n", "loss factor of the intake"
         " | коэффициент потерь на впуске β² + ξ | hệ số tổn thất đường nạp",
         "Square of the slowing of the charge plus the resistance of the intake system."),
    row("intake_speed", "m/s", "w_in|ω_вп|ω_n", "speed in the intake | скорость заряда во впускной системе"
         " | tốc độ khí nạp", "Mean speed of the charge in the narrowest section of the intake."),
    row("intake_pressure_loss", "MPa", "Δp_a", "pressure loss of the intake | потери давления на впуске"
         " | tổn thất áp suất đường nạp", "Pressure before the intake less that at its end."),
    row("intake_pressure", "MPa", "p_a", "pressure at the end of intake | давление в конце впуска"
         " | áp suất cuối quá trình nạp", "Absolute pressure at point a."),
    row("residual_pressure", "MPa", "p_r", "pressure of the residual gas | давление остаточных газов"
         " | áp suất khí sót", "Absolute pressure at point r."),
    row("residual_temperature", "K", "T_r", "temperature of the residual gas | температура остаточных газов"
         " | nhiệt độ khí sót", "Absolute temperature at point r."),
    row("charge_heating", "K", "ΔT", "heating of the charge | подогрев свежего заряда"
         " | độ sấy nóng khí nạp mới", "By how much the walls heat the charge on its way in."),
    row("charge_up", "", "φ_ch|φ_доз|λ_1", "charging after the dead centre | коэффициент дозарядки | hệ số nạp thêm",
         "Charge enclosed over the charge at the bottom dead centre."),
    row("scavenging", "", "φ_sc|φ_оч|λ_2", "scavenging | коэффициент очистки | hệ số quét buồng cháy",
         "Residual gas left over that of the clearance volume."),
    row("heat_correction", "", "λ_t", "correction of the heats | поправка на различие теплоёмкостей"
         " | hệ số hiệu đính tỉ nhiệt", "Heat of the residual gas over that of the fresh charge."),
    row("residual_fraction", "", "γ_r", "residual gas fraction | коэффициент остаточных газов | hệ số khí sót",
         "Residual gas over fresh charge, by amount."),
    row("intake_temperature", "K", "T_a", "temperature at the end of intake | температура в конце впуска"
         " | nhiệt độ cuối quá trình nạp", "Absolute temperature at point a."),
    row("volumetric_efficiency", "", "η_v|η_v|η_v", "volumetric efficiency | коэффициент наполнения | hệ số nạp",
         "Charge over the charge that the swept volume would hold at the state before the intake."),
    row("lost_stroke", "", "ψ", "lost share of the stroke | доля потерянного хода | phần hành trình tổn thất",
         "Share of the stroke of a two-stroke engine in which the ports are open."),
    row("geometric_compression_ratio", "", "r_g|ε_г|ε_h", "geometric compression ratio | геометрическая степень сжатия"
         " | tỉ số nén hình học", "Largest over smallest volume; the ports of a two-stroke engine close later."),
    # compression
    row("compression_exponent", "", "n_1", "compression exponent | показатель политропы сжатия"
         " | chỉ số nén đa biến trung bình", "Mean exponent of the polytrope of compression."),
    row("compression_pressure", "MPa", "p_c", "pressure at the end of compression | давление в конце сжатия"
         " | áp suất cuối quá trình nén", "Absolute pressure at point c."),
    row("compression_temperature", "K", "T_c", "temperature at the end of compression | температура в конце сжатия"
         " | nhiệt độ cuối quá trình nén", "Absolute temperature at point c."),
    row("compression_celsius", "", "t_c", "temperature at the end of compression, °C | температура в конце сжатия, °C"
         " | nhiệt độ cuối quá trình nén, °C", "Temperature at point c in degrees Celsius."),
    # heat capacities
    row("molar_gas_constant", "kJ/(kmol*K)", "R_m|R|R", "molar gas constant | универсальная газовая постоянная"
         " | hằng số khí phổ biến", "Pressure times volume over amount and absolute temperature."),
    row("fresh_charge_heat", "kJ/(kmol*K)", "c_vm|mc_v|mc_v", "mean molar heat of the fresh charge"
         " | средняя мольная теплоёмкость свежего заряда | tỉ nhiệt mol đẳng tích trung bình của khí nạp mới",
         "At constant volume, from the zero of the law used to the temperature."),
    row("product_heat", "kJ/(kmol*K)", "c_vm″|mc_v″|mc_v″", "mean molar heat of the products"
         " | средняя мольная теплоёмкость продуктов сгорания | tỉ nhiệt mol đẳng tích trung bình của sản vật cháy",
         "At constant volume, from the zero of the law used to the temperature."),
    row("mixture_heat", "kJ/(kmol*K)", "c_vm′|mc_v′|mc_v′", "mean molar heat of the working mixture"
         " | средняя мольная теплоёмкость рабочей смеси | tỉ nhiệt mol đẳng tích trung bình của hỗn hợp công tác",
         "Of fresh charge and residual gas, at constant volume."),
    row("product_heat_constant", "kJ/(kmol*K)", "a_z", "constant of the heat of the products"
         " | постоянная в законе теплоёмкости продуктов | hằng số trong tỉ nhiệt của sản vật cháy",
         "First coefficient of the mean molar heat a + b t at constant volume."),
    row("product_heat_slope", "", "b_z", "slope of the heat of the products, kJ/(kmol·K²)"
         " | коэффициент при температуре в законе теплоёмкости, кДж/(кмоль·К²)"
         " | hệ số nhiệt độ trong tỉ nhiệt của sản vật cháy, kJ/(kmol·K²)",
         "Second coefficient of the mean molar heat a + b t."),
    row("product_heat_constant_pressure", "kJ/(kmol*K)", "a_p",
         "constant of the heat of the products at constant pressure"
         " | постоянная в законе теплоёмкости при постоянном давлении"
         " | hằng số trong tỉ nhiệt đẳng áp của sản vật cháy",
         "First coefficient of the mean molar heat a + b t at constant pressure."),
    # combustion
    row("heat_use", "", "ξ_z", "heat use up to z | коэффициент использования теплоты | hệ số lợi dụng nhiệt tại z",
         "Heat turned into internal energy and work up to point z over that of the fuel."),
    row("working_mixture_heat", "kJ/kmol", "H_m|H_раб.см|Q_hh", "heat of the working mixture"
         " | теплота сгорания рабочей смеси | nhiệt trị của hỗn hợp công tác",
         "Heat that 1 kmol of working mixture gives."),
    row("combustion_energy", "kJ/kmol", "E_z|U_z|U_z", "energy of 1 kmol at z"
         " | энергия 1 кмоль рабочей смеси в точке z | năng lượng của 1 kmol hỗn hợp tại z",
         "Left side of the equation of burning: what the products of 1 kmol of mixture hold at point z."),
    row("combustion_celsius", "", "t_z", "temperature at the end of burning, °C | температура в конце сгорания, °C"
         " | nhiệt độ cuối quá trình cháy, °C", "Temperature at point z in degrees Celsius."),
    row("combustion_temperature", "K", "T_z", "temperature at the end of burning | температура в конце сгорания"
         " | nhiệt độ cuối quá trình cháy", "Absolute temperature at point z."),
    row("pressure_rise_ratio", "", "λ_p|λ|λ", "pressure ratio of burning | степень повышения давления"
         " | tỉ số tăng áp suất khi cháy", "Pressure at z over that at c."),
    row("combustion_pressure", "MPa", "p_z", "pressure at the end of burning | давление в конце сгорания"
         " | áp suất cuối quá trình cháy", "Absolute pressure at point z of the theoretical diagram."),
    row("combustion_pressure_real", "MPa", "p_zr|p_zд|p_zt", "real pressure at the end of burning"
         " | действительное максимальное давление сгорания | áp suất cháy cực đại thực tế",
         "Largest pressure of the rounded diagram."),
    row("cut_off", "", "ρ", "cut-off ratio | степень предварительного расширения | tỉ số giãn nở sớm",
         "Volume at z over the clearance volume."),
    row("afterexpansion", "", "δ", "expansion ratio | степень последующего расширения | tỉ số giãn nở sau",
         "Volume at b over that at z."),
    # expansion and exhaust
    row("expansion_exponent", "", "n_2", "expansion exponent | показатель политропы расширения"
         " | chỉ số giãn nở đa biến trung bình", "Mean exponent of the polytrope of expansion."),
    row("expansion_pressure", "MPa", "p_b", "pressure at the end of expansion | давление в конце расширения"
         " | áp suất cuối quá trình giãn nở", "Absolute pressure at point b."),
    row("expansion_temperature", "K", "T_b", "temperature at the end of expansion | температура в конце расширения"
         " | nhiệt độ cuối quá trình giãn nở", "Absolute temperature at point b."),
    row("exhaust_exponent", "", "m_r", "exponent of the exhaust | показатель политропы выпуска"
         " | chỉ số giãn nở khi thải",
         "Exponent of the polytrope from b to r; 1.5 makes the cube root of books."),
    row("residual_temperature_found", "K", "T_r′", "temperature of the residual gas, found"
         " | температура остаточных газов, расчётная | nhiệt độ khí sót tính lại", "From the end of expansion."),
    row("residual_temperature_deviation", "", "Δ_Tr", "deviation of the residual temperature"
         " | погрешность принятой температуры остаточных газов | sai số nhiệt độ khí sót",
         "Temperature found less the one assumed, over the one assumed."),
    # results of the cycle
    row("theoretical_mean_pressure", "MPa", "p_mi′|p_i′|p_i′", "theoretical indicated mean pressure"
         " | теоретическое среднее индикаторное давление | áp suất chỉ thị trung bình lý thuyết",
         "Work of the theoretical diagram over the swept volume."),
    row("indicated_efficiency", "", "η_i", "indicated efficiency | индикаторный КПД | hiệu suất chỉ thị",
         "Indicated work over the heat of the fuel."),
    row("indicated_fuel_consumption", "g/(kW*h)", "g_i", "indicated specific fuel consumption"
         " | удельный индикаторный расход топлива | suất tiêu hao nhiên liệu chỉ thị",
         "Fuel per indicated work."),
    row("mechanical_loss_pressure", "MPa", "p_mf|p_м|p_m", "mean pressure of mechanical losses"
         " | среднее давление механических потерь | áp suất tổn thất cơ giới trung bình",
         "Work of mechanical losses over the swept volume."),
    row("effective_mean_pressure", "MPa", "p_me|p_e|p_e", "brake mean effective pressure"
         " | среднее эффективное давление | áp suất có ích trung bình", "Effective work over the swept volume."),
    row("mechanical_efficiency", "", "η_m|η_м|η_m", "mechanical efficiency | механический КПД | hiệu suất cơ giới",
         "Effective over indicated work."),
    row("effective_efficiency", "", "η_e", "effective efficiency | эффективный КПД | hiệu suất có ích",
         "Effective work over the heat of the fuel."),
    row("effective_fuel_consumption", "g/(kW*h)", "g_e", "effective specific fuel consumption"
         " | удельный эффективный расход топлива | suất tiêu hao nhiên liệu có ích", "Fuel per effective work."),
    # size
    row("strokes_per_cycle", "", "τ", "strokes per cycle | тактность | số kỳ", "Four or two."),
    row("cylinder_count", "", "i", "number of cylinders | число цилиндров | số xylanh", "Cylinders of the engine."),
    row("stroke_bore_ratio", "", "k_S", "stroke over bore | отношение хода поршня к диаметру"
         " | tỉ số hành trình trên đường kính", "Stroke over bore."),
    row("displacement", "l", "V_e|V_л|V_lđ", "displacement | литраж двигателя | thể tích công tác của động cơ",
         "Swept volume of all cylinders."),
    row("effective_power", "kW", "P_e|N_e|N_e", "effective power | эффективная мощность | công suất có ích",
         "Power at the end of the crankshaft."),
    row("effective_torque", "N*m", "M_e", "effective torque | эффективный крутящий момент | mômen có ích",
         "Mean torque at the end of the crankshaft."),
    row("fuel_rate", "kg/h", "G_f|G_т|G_nl", "fuel consumption | часовой расход топлива"
         " | lượng tiêu hao nhiên liệu giờ",
         "Fuel that the engine burns in a unit of time."),
    row("power_per_litre", "kW/l", "P_l|N_л|N_l", "power per litre | литровая мощность | công suất lít",
         "Effective power over displacement."),
    # heat balance
    row("molar_enthalpy", "kJ/kmol", "h", "molar enthalpy | мольная энтальпия | entanpi mol",
         "Mean molar heat at constant pressure times temperature."),
    row("cooling_factor", "", "c", "factor of the heat to the coolant | коэффициент теплоотдачи в охлаждающую среду"
         " | hệ số truyền nhiệt cho nước làm mát", "Between 0.45 and 0.53 for four-stroke engines."),
    row("cooling_exponent", "", "m", "exponent of the heat to the coolant | показатель степени теплоотдачи"
         " | số mũ truyền nhiệt cho nước làm mát", "Between 0.5 and 0.7 for four-stroke engines."),
    row("heat_supplied", "kW", "Q_0", "heat of the fuel per time | теплота, введённая с топливом | nhiệt lượng đưa vào",
         "Heat that the fuel would give if all of it burned completely, per unit of time."),
    row("heat_to_coolant", "kW", "Q_cl|Q_в|Q_lm", "heat to the coolant | теплота, отданная охлаждающей среде"
         " | nhiệt truyền cho nước làm mát", "Per unit of time."),
    row("heat_to_exhaust", "kW", "Q_ex|Q_r|Q_th", "heat of the exhaust gas | теплота, унесённая с отработавшими газами"
         " | nhiệt theo khí thải", "Enthalpy of the exhaust gas less that of the charge, per unit of time."),
    row("heat_unburnt", "kW", "Q_ub|Q_н.с|Q_ch", "heat lost to incomplete burning per time"
         " | теплота, потерянная из-за неполноты сгорания | nhiệt tổn thất do cháy không hoàn toàn",
         "Per unit of time."),
    row("heat_rest", "kW", "Q_rs|Q_ост|Q_cl", "rest of the heat | неучтённые потери теплоты"
         " | nhiệt tổn thất còn lại", "Heat of the fuel less effective power and all counted losses."),
    row("heat_share", "", "q", "share of the heat | доля теплоты | phần nhiệt",
         "Part of the heat balance over the whole."),
    # ideal cycles
    row("state_pressure", "MPa", "p", "pressure at a point of the cycle | давление в точке цикла"
         " | áp suất tại điểm của chu trình", "Absolute pressure at a numbered point."),
    row("state_temperature", "K", "T", "temperature at a point of the cycle | температура в точке цикла"
         " | nhiệt độ tại điểm của chu trình", "Absolute temperature at a numbered point."),
    row("isochoric_heat", "J/(kg*K)", "c_v", "specific heat at constant volume | удельная изохорная теплоёмкость"
         " | nhiệt dung riêng đẳng tích", "Of 1 kg of an ideal gas."),
    row("heat_added", "kJ/kg", "q_1", "heat added | подведённая теплота | nhiệt lượng cấp vào",
         "Heat added to 1 kg of gas in a cycle."),
    row("heat_rejected", "kJ/kg", "q_2", "heat rejected | отведённая теплота | nhiệt lượng thải ra",
         "Heat taken from 1 kg of gas in a cycle."),
    row("ideal_work", "kJ/kg", "w_t|l_ц|l_ct", "work of the ideal cycle | удельная работа цикла | công của chu trình",
         "Work of 1 kg of gas in a cycle."),
    row("thermal_efficiency", "", "η_t", "thermal efficiency | термический КПД | hiệu suất nhiệt",
         "Work over heat added."),
    row("ideal_mean_pressure", "MPa", "p_t", "mean pressure of the ideal cycle | среднее давление цикла"
         " | áp suất trung bình của chu trình", "Work over the change of volume."),
    row("volume_ratio", "", "i_V|i_V|i", "volume over clearance volume | отношение объёма к объёму камеры сжатия"
         " | tỉ số thể tích V/V_c", "Volume above the piston over the clearance volume."),
    row("compression_line", "MPa", "p_cm|p_сж|p_n", "pressure on the compression line | давление на линии сжатия"
         " | áp suất trên đường nén", "Absolute pressure of the polytrope of compression."),
    row("expansion_line", "MPa", "p_ex|p_р|p_gn", "pressure on the expansion line | давление на линии расширения"
         " | áp suất trên đường giãn nở", "Absolute pressure of the polytrope of expansion."),
    # heat release
    row("burning_progress", "", "s", "progress of burning | относительная длительность сгорания"
         " | tiến độ thời gian cháy", "Crank angle since the start of burning over its duration."),
    row("burning_start", "deg", "θ_0|φ_0|φ_0", "start of burning | начало сгорания | góc bắt đầu cháy",
         "Crank angle at which heat begins to be released."),
    row("burning_duration", "deg", "Δθ_b|φ_z|φ_z", "duration of burning | продолжительность сгорания"
         " | khoảng thời gian cháy", "Crank angle from the start of burning until 0.999 of the heat is released."),
    row("burning_shape", "", "m", "Wiebe shape exponent | показатель характера сгорания"
         " | chỉ số đặc trưng cháy Vibe", "Exponent of the Wiebe function; larger burns later."),
    row("burnt_fraction", "", "x_b|x|x", "fraction burnt | доля выгоревшего топлива | phần nhiên liệu đã cháy",
         "Heat released since the start of burning over the heat of the cycle."),
    row("burning_rate", "", "x_b′|x′|x′", "rate of burning | скорость сгорания | tốc độ cháy",
         "Derivative of the fraction burnt by the crank angle in radians."),
    row("burning_efficiency", "", "η_c|ξ_z|ξ_z", "combustion efficiency | коэффициент использования теплоты"
         " | hệ số lợi dụng nhiệt", "Share of the heating value that is released in the cylinder."),
    row("fuel_per_cycle", "g", "m_f|g_ц|g_ct", "fuel per cycle | цикловая подача топлива"
         " | lượng nhiên liệu chu trình", "Mass of fuel burnt in one cylinder per cycle."),
    row("fuel_heating_value", "MJ/kg", "Q_LHV|H_u|Q_H", "lower heating value of the fuel"
         " | низшая теплота сгорания топлива | nhiệt trị thấp của nhiên liệu",
         "Heat of burning one kilogram of fuel, water remaining vapour."),
    row("fuel_heat", "J", "Q", "heat of the fuel per cycle | теплота топлива за цикл"
         " | nhiệt lượng nhiên liệu một chu trình", "Heat that complete burning brings into one cylinder per cycle."),
    row("heat_released", "J", "Q_b|Q_x|Q_x", "heat released | выделившаяся теплота | nhiệt lượng toả ra",
         "Heat released by burning from intake closing to exhaust opening."),
    row("cylinder_pressure", "MPa", "p", "pressure in the cylinder | давление в цилиндре | áp suất trong xylanh",
         "Absolute pressure of the gas in the cylinder."),
    row("motored_pressure", "MPa", "p_m|p_прок|p_k", "motored pressure | давление прокрутки | áp suất kéo không cháy",
         "Pressure that the cylinder would have at the same crank angle without burning."),
    row("cylinder_temperature", "K", "T", "gas temperature | температура газа | nhiệt độ khí thể",
         "Mean absolute temperature of the gas in the cylinder."),
    row("gas_mass", "g", "m_g|m_г|m_kt", "mass of the gas | масса газа в цилиндре | khối lượng khí trong xylanh",
         "Mass enclosed from intake closing to exhaust opening."),
    row("specific_gas_constant", "J/(kg*K)", "R", "specific gas constant | удельная газовая постоянная"
         " | hằng số khí riêng", "Pressure times volume over mass and absolute temperature."),
    row("gas_heat_ratio", "", "γ|k|k", "ratio of specific heats | показатель адиабаты | chỉ số đoạn nhiệt",
         "Specific heat at constant pressure over that at constant volume."),
    row("gas_heat_ratio_slope", "1/K", "γ_T|k_T|k_T", "change of the ratio of specific heats with temperature"
         " | изменение показателя адиабаты с температурой | độ biến thiên chỉ số đoạn nhiệt theo nhiệt độ",
         "Derivative of the ratio of specific heats by the temperature; negative."),
    row("pressure_rise", "MPa/deg", "dp/dθ|dp/dφ|dp/dφ", "rate of pressure rise"
         " | скорость нарастания давления | tốc độ tăng áp suất", "Derivative of the pressure by the crank angle."),
    row("wall_temperature", "K", "T_w|T_ст|T_w", "wall temperature | температура стенок | nhiệt độ vách",
         "Mean temperature of the surfaces around the gas."),
    row("wall_area", "cm2", "A_w|F_ст|F_w", "wall area | площадь стенок | diện tích vách",
         "Head, piston crown and the part of the liner that the piston leaves free."),
    row("head_area", "cm2", "A_h|F_гол|F_n", "area of the head | площадь днища головки | diện tích nắp xylanh",
         "Surface of the head around the gas."),
    row("crown_area", "cm2", "A_cr|F_дн|F_đ", "area of the piston crown | площадь днища поршня"
         " | diện tích bề mặt đỉnh piston", "Surface of the piston crown."),
    row("wall_gas_speed", "m/s", "w", "gas speed at the walls | скорость газа у стенок | vận tốc khí tại vách",
         "Speed that stands for the turbulence in Woschni's correlation."),
    row("gas_speed_factor", "", "C_1", "coefficient of the piston speed | коэффициент при скорости поршня"
         " | hệ số vận tốc piston", "Part of the gas speed that follows the piston: 2.28 with the valves shut."),
    row("burning_speed_factor", "m/(s*K)", "C_2", "coefficient of burning | коэффициент при приросте давления"
         " | hệ số do cháy", "Part of the gas speed that burning adds: 0.00324 m/(s K)."),
    row("heat_transfer_coefficient", "W/(m2*K)", "h_c|α_w|α_w", "heat transfer coefficient"
         " | коэффициент теплоотдачи | hệ số truyền nhiệt", "Heat flow to the walls per area and temperature."),
    row("wall_heat_rate", "J", "Q_w′|Q_ст′|Q_w′", "heat to the walls by crank angle"
         " | теплоотдача в стенки по углу поворота | nhiệt truyền cho vách theo góc quay",
         "Derivative of the heat lost to the walls by the crank angle in radians."),
    row("wall_heat", "J", "Q_w|Q_ст|Q_w", "heat lost to the walls | теплота, отданная стенкам"
         " | nhiệt lượng truyền cho vách", "Heat lost to the walls from intake closing to exhaust opening."),
    row("internal_energy_change", "J", "ΔU", "change of internal energy | изменение внутренней энергии"
         " | độ biến thiên nội năng", "Internal energy of the gas at exhaust opening less that at intake closing."),
    row("closed_work", "J", "W_cl|L_з|L_k", "work with the valves shut | работа при закрытых клапанах"
         " | công khi các xupáp đóng", "Work of the gas from intake closing to exhaust opening."),
    row("filling_factor", "", "φ_i|φ_и|φ_đ", "roundness factor of the diagram"
         " | коэффициент полноты индикаторной диаграммы | hệ số điền đầy đồ thị công",
         "Work of the rounded diagram over that of the theoretical one."),
)  # fmt: skip
