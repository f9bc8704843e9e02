"""Quantities of flywheel, motor and speed."""

from __future__ import annotations

from crankwork.quantities.quantity import row

ROWS = (
    # speed, flywheel, motor
    row("crank_torque_sum", "N*m", "M_Σ", "sum of the reduced torques | суммарный приведённый момент"
         " | tổng mômen thu gọn", "Torque of motor and loads on the crank, positive with the rotation."),
    row("load_torque", "N*m", "M_L|M_с|M_c", "load torque | момент сопротивления | mômen cản",
         "Torque that drives the crank against its load, mean or root mean square."),
    row("excess_work", "J", "ΔE|L_изб|L_dư", "excess work | избыточная работа | công dư",
         "Difference of the extremes of the work that the torque does beyond its mean."),
    row("speed_fluctuation", "", "δ", "speed fluctuation | коэффициент неравномерности хода"
         " | hệ số không đều của chuyển động", "Largest less least speed, over the mean of the two."),
    row("work_per_cycle", "J", "W|A_ц|A_ck", "work per cycle | работа за цикл | công trong một chu trình",
         "Mean torque times the crank angle of the cycle."),
    row("energy_fluctuation", "", "C_E|k_E|C_E", "coefficient of fluctuation of energy"
         " | коэффициент избыточной работы | hệ số dao động năng lượng", "Excess work over work per cycle."),
    row("wittenbauer_slope", "J", "tan ψ", "slope of the tangent | тангенс угла наклона касательной"
         " | hệ số góc tiếp tuyến", "Half the square of the speed: kinetic energy per moment of inertia."),
    row("whole_inertia", "kg*m2", "J_Σ", "inertia of machine and flywheel"
         " | суммарный приведённый момент инерции | tổng mômen quán tính thu gọn",
         "Moment of inertia on the crank that the wanted fluctuation needs."),
    row("flywheel_inertia", "kg*m2", "J_f|J_м|J_đ", "flywheel inertia | момент инерции маховика"
         " | mômen quán tính bánh đà", "Moment of inertia of the flywheel about its shaft."),
    row("inertia_on_crank", "kg*m2", "J_red|J_прив|J_qd",
         "inertia on the crank | приведённый к кривошипу момент инерции"
         " | mômen quán tính quy đổi", "Moment of inertia on the crank that stores the same energy."),
    row("flywheel_mass", "kg", "m_f|m_м|m_đ", "flywheel mass | масса маховика | khối lượng bánh đà",
         "Mass of the flywheel."),
    row("radius_of_gyration", "mm", "k|ρ_и|k", "radius of gyration | радиус инерции | bán kính quán tính",
         "Root of moment of inertia over mass."),
    row("rim_speed", "m/s", "v_r|v_об|v_v", "rim speed | окружная скорость обода | vận tốc vành",
         "Speed of the rim at its mean radius."),
    row("rim_stress", "MPa", "σ", "rim stress | напряжение в ободе | ứng suất vành", "Hoop stress of a turning rim."),
    row("gear_ratio", "", "i", "gear ratio | передаточное отношение привода | tỉ số truyền",
         "Speed of the shaft over the speed of the crank."),
    row("mains_frequency", "Hz", "f", "mains frequency | частота сети | tần số lưới điện", "Frequency of the mains."),
    row("pole_pairs", "", "p", "pairs of poles | число пар полюсов | số đôi cực", "Half the number of poles."),
    row("synchronous_speed", "rad/s", "ω_0|ω_с|ω_0", "synchronous speed | синхронная угловая скорость"
         " | vận tốc góc đồng bộ", "Speed of the field of an alternating-current motor."),
    row("slip", "", "s", "slip | скольжение | hệ số trượt", "Lag behind the synchronous speed, over that speed."),
    row("rated_slip", "", "s_n|s_н|s_đm", "rated slip | номинальное скольжение | hệ số trượt định mức",
         "Slip at rated power."),
    row("breakdown_slip", "", "s_k|s_к|s_th", "breakdown slip | критическое скольжение | hệ số trượt tới hạn",
         "Slip of the greatest torque."),
    row("overload_capacity", "", "λ_m|λ_м|λ_m", "overload capacity | перегрузочная способность"
         " | hệ số quá tải", "Greatest over rated torque of a motor."),
    row("resistance_ratio", "", "a", "resistance ratio R1/R2' | отношение сопротивлений R1/R2'"
         " | tỉ số điện trở R1/R2'", "Resistance of the stator over that of the rotor, referred to the stator."),
    row("breakdown_torque", "N*m", "M_k|M_к|M_th", "breakdown torque | критический момент | mômen tới hạn",
         "Greatest torque of an asynchronous motor."),
    row("motor_torque", "N*m", "M_m|M_дв|M_đc", "motor torque | момент двигателя | mômen động cơ",
         "Torque of the motor on its own shaft."),
    row("motor_power", "kW", "P_m|P_дв|P_đc", "motor power needed | потребная мощность двигателя"
         " | công suất động cơ cần thiết",
         "Power that the motor must have."),
    row("power_reserve", "", "k_s|k_з|k_s", "safety factor on the power | коэффициент запаса мощности"
         " | hệ số dự trữ công suất", "Rated power over the power that is needed."),
)  # fmt: skip
