"""Quantities of the slider-crank and the engine."""

from __future__ import annotations

from crankwork.quantities.quantity import row

ROWS = (
    # geometry
    row("crank_angle", "deg", "φ|φ|α", "crank angle | угол поворота кривошипа | góc quay trục khuỷu",
         "Angle of the crank from the cylinder axis on the top-dead-centre side, positive with the rotation."),
    row("crank_radius", "mm", "r|R|R", "crank radius | радиус кривошипа | bán kính quay trục khuỷu",
         "Distance from the crankshaft axis to the crankpin axis."),
    row("stroke", "mm", "S|S|S", "piston stroke | ход поршня | hành trình piston",
         "Distance between the dead centres of the piston."),
    row("rod_length", "mm", "l|L|L", "connecting rod length | длина шатуна | chiều dài thanh truyền",
         "Distance between the axes of the crankpin and the piston pin."),
    row("rod_ratio", "", "λ", "crank-to-rod ratio r/l | отношение радиуса кривошипа к длине шатуна"
         " | thông số kết cấu (tỉ số R/L)", "Crank radius over rod length, r/l."),
    row("offset", "mm", "e|e|a", "cylinder offset | дезаксаж | độ lệch tâm",
         "Distance of the cylinder axis from the crankshaft axis, positive towards the crankpin at 90 degrees."),
    row("relative_offset", "", "k", "relative offset e/r | относительный дезаксаж | độ lệch tâm tương đối",
         "Cylinder offset over crank radius."),
    row("bore", "mm", "D", "cylinder bore | диаметр цилиндра | đường kính xylanh", "Diameter of the cylinder."),
    row("piston_area", "cm2", "A_p|F_п|F_p", "piston area | площадь поршня | diện tích đỉnh piston",
         "Area of the piston crown, pi D^2 / 4."),
    row("clearance_volume", "cm3", "V_c", "clearance volume | объём камеры сжатия | thể tích buồng cháy",
         "Volume of the working space at top dead centre."),
    row("swept_volume", "cm3", "V_d|V_h|V_h", "swept volume | рабочий объём цилиндра | thể tích công tác",
         "Piston area times stroke."),
    row("compression_ratio", "", "r_c|ε|ε", "compression ratio | степень сжатия | tỉ số nén",
         "Total volume over clearance volume."),
    row("cylinder_volume", "cm3", "V", "cylinder volume | объём над поршнем | thể tích xylanh",
         "Volume of the working space above the piston."),
    row("cycle_angle", "deg", "φ_c|φ_ц|α_ct", "cycle | длительность цикла | chu trình",
         "Crank angle of one working cycle: 720 degrees for four strokes, 360 for two."),
    row("inclination", "deg", "θ", "cylinder inclination | наклон оси цилиндра | góc nghiêng trục xylanh",
         "Angle from the upward vertical to the direction from the crankshaft to the head."),
    # speed
    row("rotational_speed", "rpm", "n", "rotational speed | частота вращения | số vòng quay",
         "Revolutions of the crankshaft per minute."),
    row("speed", "rad/s", "ω", "angular speed | угловая скорость | vận tốc góc",
         "Angular speed of the crank, positive from top dead centre towards the crankpin at 90 degrees."),
    row("angular_acceleration", "rad/s2", "α|ε|ε", "crank angular acceleration"
         " | угловое ускорение кривошипа | gia tốc góc trục khuỷu", "Time derivative of the angular speed."),
    row("mean_piston_speed", "m/s", "S_p|v_п.ср|C_m", "mean piston speed | средняя скорость поршня"
         " | vận tốc trung bình của piston", "Twice the stroke per revolution."),
    # motion
    row("piston_displacement", "mm", "x|S_x|x", "piston displacement | перемещение поршня"
         " | chuyển vị của piston", "Distance of the piston from top dead centre, positive towards the crankshaft."),
    row("piston_velocity", "m/s", "v", "piston velocity | скорость поршня | vận tốc của piston",
         "Time derivative of the piston displacement."),
    row("piston_acceleration", "m/s2", "a|j|j", "piston acceleration | ускорение поршня | gia tốc của piston",
         "Second time derivative of the piston displacement."),
    row("inertia_acceleration", "m/s2", "a_I|j_ин|j_qt", "acceleration behind the inertia force"
         " | ускорение, по которому вычислена сила инерции | gia tốc dùng tính lực quán tính",
         "Piston acceleration with the crank-to-rod ratio that a document uses for the inertia force alone."),
    *(
        row(f"piston_{noun}_{order}", unit, f"{en}_{mark}|{ru}_{mark}|{vi}_{mark}",
             f"piston {noun}, {order_en} order | {name_ru} поршня {order_ru} порядка"
             f" | {name_vi} piston cấp {order_vi}", f"Part of the piston {noun} of {order_en} order.")
        for noun, unit, en, ru, vi, name_ru, name_vi in (
            ("displacement", "mm", "x", "S", "x", "перемещение", "chuyển vị"),
            ("velocity", "m/s", "v", "v", "v", "скорость", "vận tốc"),
            ("acceleration", "m/s2", "a", "j", "j", "ускорение", "gia tốc"),
        )
        for order, mark, order_en, order_ru, order_vi in (
            ("first_order", "I", "first", "первого", "1"),
            ("second_order", "II", "second", "второго", "2"),
        )
    ),
    row("rod_angle", "deg", "β", "connecting rod angle | угол отклонения шатуна | góc lắc thanh truyền",
         "Swing of the rod from the cylinder axis, positive when the crankpin is on the 90-degree side."),
    row("rod_angular_velocity", "rad/s", "ω_r|ω_ш|ω_tt", "rod angular velocity"
         " | угловая скорость шатуна | vận tốc góc thanh truyền", "Time derivative of the rod angle."),
    row("rod_angular_acceleration", "rad/s2", "α_r|ε_ш|ε_tt", "rod angular acceleration"
         " | угловое ускорение шатуна | gia tốc góc thanh truyền", "Second time derivative of the rod angle."),
    row("rod_sine", "", "sin β", "sine of the rod angle | синус угла отклонения шатуна"
         " | sin góc lắc thanh truyền", "Sine of the swing of the rod from the cylinder axis."),
    row("rod_cosine", "", "cos β", "cosine of the rod angle | косинус угла отклонения шатуна"
         " | cos góc lắc thanh truyền", "Cosine of the swing of the rod from the cylinder axis."),
    row("crank_rod_sine", "", "sin(φ+β)|sin(φ+β)|sin(α+β)", "sine of crank and rod angle"
         " | синус суммы углов кривошипа и шатуна | sin tổng góc quay và góc lắc",
         "Sine of the angle between crank and rod."),
    row("crank_rod_cosine", "", "cos(φ+β)|cos(φ+β)|cos(α+β)", "cosine of crank and rod angle"
         " | косинус суммы углов кривошипа и шатуна | cos tổng góc quay và góc lắc",
         "Cosine of crank and rod angle together."),
    row("side_factor", "", "tan β|tg β|tan β", "side force per piston force"
         " | отношение боковой силы к суммарной | tỉ số lực ngang trên lực tác dụng lên chốt piston",
         "Side force over the force on the piston pin, without a correction couple."),
    row("rod_factor", "", "1/cos β", "rod force per piston force | отношение силы вдоль шатуна к суммарной"
         " | tỉ số lực dọc thanh truyền trên lực tác dụng lên chốt piston",
         "Force along the rod over the force on the piston pin, without a correction couple."),
    row("radial_factor", "", "cos(φ+β)/cos β|cos(φ+β)/cos β|cos(α+β)/cos β", "radial force per piston force"
         " | отношение радиальной силы к суммарной | tỉ số lực pháp tuyến trên lực tác dụng lên chốt piston",
         "Radial force over the force on the piston pin, without a correction couple."),
    row("tangential_factor", "", "sin(φ+β)/cos β|sin(φ+β)/cos β|sin(α+β)/cos β", "tangential force per piston force"
         " | отношение тангенциальной силы к суммарной | tỉ số lực tiếp tuyến trên lực tác dụng lên chốt piston",
         "Tangential force over the force on the piston pin, without a correction couple."),
    row("piston_transfer_1", "mm", "x′|S_x′|x′", "first transfer function of the piston"
         " | аналог скорости поршня | hàm truyền bậc một của piston",
         "Derivative of the piston displacement by the crank angle in radians."),
    row("piston_transfer_2", "mm", "x″|S_x″|x″", "second transfer function of the piston"
         " | аналог ускорения поршня | hàm truyền bậc hai của piston",
         "Second derivative of the piston displacement by the crank angle in radians."),
    *(
        row(f"piston_transfer_{rank}_{order}_order", "mm", f"x{prime}_{mark}|S{prime}_{mark}|x{prime}_{mark}",
             f"{rank_en} transfer function of the piston, {order} order"
             f" | аналог {rank_ru} поршня {order_ru} порядка | hàm truyền bậc {rank_vi} của piston, cấp {order_vi}",
             f"Part of the {rank_en} transfer function of the piston of {order} order.")
        for rank, prime, rank_en, rank_ru, rank_vi in (
            (1, "′", "first", "скорости", "một"), (2, "″", "second", "ускорения", "hai"),
        )
        for order, mark, order_ru, order_vi in (("first", "I", "первого", "1"), ("second", "II", "второго", "2"))
    ),
    row("rod_transfer_1", "", "β′", "first transfer function of the rod | аналог угловой скорости шатуна"
         " | hàm truyền bậc một của thanh truyền", "Derivative of the rod angle by the crank angle."),
    row("rod_transfer_2", "", "β″", "second transfer function of the rod | аналог углового ускорения шатуна"
         " | hàm truyền bậc hai của thanh truyền", "Second derivative of the rod angle by the crank angle."),
    row("pin_distance", "mm", "h", "distance of the piston pin from the crankshaft"
         " | расстояние от оси пальца до оси коленчатого вала | khoảng cách từ chốt piston đến trục khuỷu",
         "Distance of the piston pin from the crankshaft axis along the cylinder axis."),
    row("top_dead_centre_angle", "deg", "φ_t|φ_вмт|α_đct", "crank angle of top dead centre"
         " | угол верхней мёртвой точки | góc điểm chết trên", "Crank angle at which the piston is farthest out."),
    row("bottom_dead_centre_angle", "deg", "φ_b|φ_нмт|α_đcd", "crank angle of bottom dead centre"
         " | угол нижней мёртвой точки | góc điểm chết dưới", "Crank angle at which the piston is farthest in."),
    # masses
    row("piston_mass", "kg", "m_p|m_п|m_np", "piston group mass | масса поршневой группы"
         " | khối lượng nhóm piston", "Piston, rings and pin.", "g/cm2"),
    row("rod_mass", "kg", "m_r|m_ш|m_tt", "connecting rod mass | масса шатунной группы"
         " | khối lượng nhóm thanh truyền", "Connecting rod with its bearings and bolts.", "g/cm2"),
    row("rod_small_end_mass", "kg", "m_1|m_шп|m_A", "rod mass at the piston pin"
         " | масса шатуна на оси пальца | khối lượng thanh truyền quy về đầu nhỏ",
         "Part of the rod mass placed at the piston pin.", "g/cm2"),
    row("rod_big_end_mass", "kg", "m_2|m_шк|m_B", "rod mass at the crankpin"
         " | масса шатуна на оси кривошипа | khối lượng thanh truyền quy về đầu to",
         "Part of the rod mass placed at the crankpin.", "g/cm2"),
    row("rod_inertia", "kg*m2", "J_c|J_ш|J_tt", "rod moment of inertia | момент инерции шатуна"
         " | mômen quán tính thanh truyền", "Moment of inertia of the rod about its centre of mass."),
    row("rod_inertia_excess", "kg*m2", "ΔJ", "rod inertia excess | избыток момента инерции шатуна"
         " | phần dư mômen quán tính thanh truyền", "Moment of inertia of the rod less that of its two-mass model."),
    row("crank_mass", "kg", "m_k|m_к|m_k", "crank throw mass | масса колена | khối lượng khuỷu trục",
         "Unbalanced mass of one crank throw, placed at the crankpin.", "g/cm2"),
    row("reciprocating_mass", "kg", "m_rec|m_j|m_j", "reciprocating mass | поступательно движущаяся масса"
         " | khối lượng chuyển động tịnh tiến", "Piston group and the rod mass at the piston pin.", "g/cm2"),
    row("rotating_mass", "kg", "m_rot|m_R|m_r", "rotating mass | вращающаяся масса"
         " | khối lượng chuyển động quay", "Crank throw and the rod mass at the crankpin.", "g/cm2"),
    # gas
    row("gas_pressure", "MPa", "p_g|Δp_г|p_kt", "gas pressure on the piston | избыточное давление газов"
         " | áp suất khí thể", "Pressure above that on the crankcase side."),
    row("diagram_pressure", "MPa", "p", "pressure of the indicator diagram | давление по индикаторной диаграмме"
         " | áp suất trên đồ thị công",
         "Pressure in the cylinder, absolute or above that in the crankcase, as the diagram is given."),
    row("polytropic_exponent", "", "n_p|n_п|n_đb", "polytropic exponent | показатель политропы"
         " | chỉ số đa biến", "Exponent of the volume in the equation of a polytrope."),
    row("ambient_pressure", "MPa", "p_0", "pressure on the crankcase side | давление в картере"
         " | áp suất khí trời", "Absolute pressure under the piston."),
    row("indicated_work", "J", "W_i|L_i|L_i", "indicated work per cycle | индикаторная работа цикла"
         " | công chỉ thị chu trình", "Area of the indicator diagram."),
    row("indicated_mean_pressure", "MPa", "p_mi|p_i|p_i", "indicated mean effective pressure"
         " | среднее индикаторное давление | áp suất chỉ thị trung bình", "Indicated work over swept volume."),
    row("indicated_power", "kW", "P_i|N_i|N_i", "indicated power | индикаторная мощность"
         " | công suất chỉ thị", "Indicated work per unit of time."),
    # forces
    row("gas_force", "N", "F_g|P_г|P_kt", "gas force | сила давления газов | lực khí thể",
         "Force of the gas on the piston, positive towards the crankshaft.", "MPa"),
    row("inertia_force", "N", "F_j|P_j|P_j", "inertia force of the reciprocating mass"
         " | сила инерции поступательно движущихся масс | lực quán tính chuyển động tịnh tiến",
         "Minus reciprocating mass times piston acceleration, positive towards the crankshaft.", "MPa"),
    row("weight_force", "N", "F_w|G|G", "weight along the cylinder axis | вес вдоль оси цилиндра"
         " | trọng lực dọc trục xylanh", "Weight of the reciprocating mass along the axis.", "MPa"),
    row("transverse_weight", "N", "F_wn|G_n|G_n", "weight across the cylinder axis"
         " | вес поперёк оси цилиндра | trọng lực vuông góc với trục xylanh",
         "Weight of the reciprocating mass across the axis, positive towards the crankpin side at 90 degrees.",
         "MPa"),
    row("piston_force", "N", "F_P|P|P_1", "force on the piston pin | суммарная сила на поршневом пальце"
         " | lực tác dụng lên chốt piston", "Gas, inertia and weight, positive towards the crankshaft.", "MPa"),
    row("side_force", "N", "F_N|N|N", "side force | боковая сила | lực ngang",
         "Force of the piston on the cylinder wall, positive on the side opposite to the crankpin at 90 degrees.",
         "MPa"),
    row("rod_force", "N", "F_Q|S|P_tt", "force along the rod | сила вдоль шатуна | lực dọc tâm thanh truyền",
         "Force that the piston pin puts on the rod, along the rod; positive in compression.", "MPa"),
    row("rod_transverse_force", "N", "F_q|S_n|P_n", "force across the rod | сила поперёк шатуна"
         " | lực vuông góc với thanh truyền", "Force on the rod across its axis, from the correction couple.", "MPa"),
    row("radial_force", "N", "F_B|K|Z", "radial force on the crankpin | радиальная (нормальная) сила"
         " | lực pháp tuyến", "Along the crank arm, positive towards the crankshaft.", "MPa"),
    row("tangential_force", "N", "F_T|T|T", "tangential force on the crankpin | тангенциальная сила"
         " | lực tiếp tuyến", "Across the crank arm, positive with the rotation.", "MPa"),
    row("rotating_inertia_force", "N", "F_c|K_R|P_k", "inertia force of the rotating mass"
         " | центробежная сила вращающихся масс | lực quán tính ly tâm",
         "Along the crank arm, positive towards the crankshaft, so never positive itself.", "MPa"),
    row("crank_torque", "N*m", "M|M_кр|M", "crank torque | крутящий момент | mômen quay trục khuỷu",
         "Torque of one cylinder on the crankshaft, positive with the rotation."),
    row("mean_torque", "N*m", "M_m|M_ср|M_tb", "mean crank torque | средний крутящий момент"
         " | mômen quay trung bình", "Mean of the crank torque over the cycle."),
    row("rotating_torque", "N*m", "M_r|M_R|M_r", "torque of the rotating mass"
         " | момент вращающихся масс | mômen của khối lượng quay",
         "Weight of the rotating mass and its resistance to angular acceleration, about the crankshaft."),
    row("overturning_moment", "N*m", "M_o|M_опр|M_n", "overturning moment | опрокидывающий момент"
         " | mômen lật", "Moment of piston force and side force on the frame about the crankshaft."),
    row("correction_couple", "N*m", "M_c|M_ш|M_tt", "rod correction couple | момент пары шатуна"
         " | mômen hiệu chỉnh thanh truyền", "Couple by which the two-mass rod differs from the rigid rod."),
)  # fmt: skip
