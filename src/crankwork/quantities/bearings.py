"""Quantities of bearing loads."""

from __future__ import annotations

from crankwork.quantities.quantity import row

ROWS = (
    # crankpin and big end
    row("big_end_inertia_force", "N", "F_cr|K_Rш|P_k0", "inertia force of the rod mass at the crankpin"
         " | центробежная сила массы шатуна на оси кривошипа"
         " | lực quán tính ly tâm của khối lượng thanh truyền quy về đầu to",
         "Along the crank arm, positive towards the crankshaft, so never positive itself.", "MPa"),
    row("crankpin_radial_force", "N", "F_Bc|P_к|Z_c", "radial load on the crankpin"
         " | суммарная радиальная сила на шатунной шейке | tổng lực pháp tuyến trên chốt khuỷu",
         "Radial force of the rods and inertia force of their masses at the crankpin, positive towards the crankshaft.",
         "MPa"),
    row("crankpin_tangential_force", "N", "F_Tc|T_шш|T_c", "tangential load on the crankpin"
         " | суммарная тангенциальная сила на шатунной шейке | tổng lực tiếp tuyến trên chốt khuỷu",
         "Tangential force of all rods on the crankpin, positive with the rotation.", "MPa"),
    row("mean_crankpin_load", "N", "R_cm|R_шш.ср|Q_tb", "mean load on the crankpin"
         " | средняя нагрузка на шатунную шейку | phụ tải trung bình trên chốt khuỷu",
         "Mean over the cycle of the size of the load on the crankpin.", "MPa"),
    row("crankpin_load", "N", "R_c|R_шш|Q_ch", "load on the crankpin | результирующая сила на шатунную шейку"
         " | phụ tải tác dụng lên chốt khuỷu", "Size of the force of the rods on the crankpin.", "MPa"),
    row("big_end_load", "N", "R_B|R_шп|Q_đt", "load on the big-end bearing | нагрузка на шатунный подшипник"
         " | phụ tải tác dụng lên đầu to thanh truyền", "Size of the force of the crankpin on the big end of the rod.",
         "MPa"),
    # piston pin and small end
    row("piston_pin_force", "N", "F_pp|P_пп|P_ch", "axial force of the piston on its pin"
         " | осевая сила поршня на палец | lực dọc trục của piston tác dụng lên chốt",
         "Gas, inertia of the piston group alone and its weight along the axis, positive towards the crankshaft.",
         "MPa"),
    row("small_end_load", "N", "R_S|R_п|Q_đn", "load on the small-end bearing"
         " | нагрузка на подшипник верхней головки шатуна | phụ tải tác dụng lên đầu nhỏ thanh truyền",
         "Size of the force of the piston pin on the small end of the rod.", "MPa"),
    row("reversal_duration", "deg", "Δφ_r|Δφ_р|Δα_r", "duration of load reversal"
         " | продолжительность смены знака нагрузки | thời gian đổi chiều phụ tải",
         "Longest unbroken stretch of the cycle in the direction of the load that has the shorter one."),
    row("reversal_ratio", "", "k_r|k_р|k_r", "reversal ratio | отношение нагрузок при смене знака"
         " | tỉ số phụ tải đổi chiều", "Smaller over larger of the peak loads in the two directions."),
    # main journals
    row("shaft_unbalance", "kg*m", "Q_u|Q_в|Q_lt", "unbalance of the shaft | дисбаланс массы на валу"
         " | mômen tĩnh của khối lượng trên trục",
         "Mass of a throw or a counterweight times the distance of its centre from the axis of rotation."),
    row("unbalance_force", "N", "F_u|P_цб|P_lt", "centrifugal force of a mass on the shaft"
         " | центробежная сила массы на валу | lực ly tâm của khối lượng trên trục",
         "Force of a mass fixed to the crankshaft, away from the axis of rotation."),
    row("shaft_position", "mm", "z", "position along the shaft | координата вдоль вала | vị trí dọc trục",
         "Distance along the crankshaft, positive towards higher throws."),
    row("journal_share", "", "k_z", "share of a force carried by a journal | доля силы, передаваемая на шейку"
         " | phần lực truyền lên cổ trục", "By the lever between the two journals of a throw."),
    row("main_journal_load", "N", "R_mj|R_кш|Q_ck", "load on the main journal"
         " | результирующая сила на коренную шейку | phụ tải tác dụng lên cổ trục khuỷu",
         "Size of the force of the main bearing on the journal.", "MPa"),
    # what a load comes to
    row("bearing_load", "N", "R|R|Q", "bearing load | нагрузка на подшипник | phụ tải ổ trục",
         "Size of the force on the journal or the bearing.", "MPa"),
    row("bearing_load_direction", "deg", "ψ_R|ψ_R|ψ_Q", "direction of the bearing load"
         " | направление нагрузки на подшипник | phương của phụ tải ổ trục",
         "Angle of the force from the reference direction of its frame, positive with the rotation."),
    row("mean_bearing_load", "N", "R_mean|R_ср|Q_tb", "mean bearing load | средняя нагрузка на подшипник"
         " | phụ tải trung bình", "Mean of the size of the load over the cycle.", "MPa"),
    row("bearing_load_ratio", "", "χ", "largest over mean load | отношение наибольшей нагрузки к средней"
         " | hệ số va đập", "Largest bearing load over the mean one."),
    row("bearing_pressure", "MPa", "p_b|k|k", "specific bearing load | удельная нагрузка на подшипник"
         " | phụ tải riêng của ổ trục", "Bearing load over diameter times length of the bearing."),
    row("bearing_diameter", "mm", "d", "bearing diameter | диаметр шейки | đường kính cổ trục",
         "Diameter of the journal."),
    row("bearing_length", "mm", "l_b|l′|l_ô", "bearing length | рабочая ширина вкладыша | chiều dài làm việc của ổ",
         "Length of the journal that carries load."),
    # wear
    row("wear_ray_angle", "deg", "ψ", "ray of the wear diagram | луч диаграммы износа | tia đồ thị mài mòn",
         "Direction from the centre of the journal to a point of its surface, from the reference direction of its"
         " frame, positive with the rotation."),
    row("wear_sum", "N", "ΣR|ΣR_i|ΣQ", "sum of loads on a ray | сумма сил по лучу"
         " | tổng phụ tải tác dụng tại điểm", "Sum of the loads whose arc of contact covers the ray.", "MPa"),
    row("oil_hole_angle", "deg", "ψ_o|φ_м|ψ_d", "angle of the oil hole | угол оси масляного отверстия"
         " | góc đặt lỗ khoan dầu", "Middle of the least loaded arc of the journal."),
)  # fmt: skip
