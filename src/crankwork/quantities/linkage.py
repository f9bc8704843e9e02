"""Quantities of linkages: motion, reduction to the crank, joint forces, friction, springs."""

from __future__ import annotations

from crankwork.quantities.quantity import row

ROWS = (
    # structure
    row("mobility", "", "W", "degrees of freedom | степень подвижности | bậc tự do",
         "Independent motions of a planar chain, by the formula of Chebyshev."),
    row("moving_links", "", "n", "moving links | число подвижных звеньев | số khâu động",
         "Number of links that move, the crank among them."),
    row("lower_pairs", "", "p_5", "joints of one freedom | число пар пятого класса | số khớp loại năm",
         "Number of revolute and sliding joints; a pin of k links counts k - 1."),
    # reduction of a linkage to its crank
    row("reduced_inertia", "kg*m2", "J|J_пр|J_tt", "reduced moment of inertia | приведённый момент инерции"
         " | mômen quán tính thu gọn", "Moment of inertia on the crank with the kinetic energy of the mechanism."),
    row("reduced_inertia_1", "kg*m2", "J′|J′_пр|J′_tt", "derivative of the reduced moment of inertia"
         " | производная приведённого момента инерции | đạo hàm mômen quán tính thu gọn",
         "Derivative of the reduced moment of inertia by the crank angle in radians."),
    row("reduced_torque", "N*m", "M_red|M_пр|M_tt", "reduced torque of the loads | приведённый момент сил"
         " | mômen thu gọn của lực",
         "Torque on the crank that does the work of the loads, positive with the rotation."),
    row("static_torque", "N*m", "M_st|M_ст|M_t", "static torque | статический момент | mômen tĩnh",
         "Torque on the crank that balances the loads, without masses and losses."),
    row("dynamic_torque", "N*m", "M_dyn|M_дин|M_đ", "dynamic torque | динамический момент | mômen động",
         "Torque on the crank that changes the speed of the masses."),
    row("driving_torque", "N*m", "M_d|M_Σ|M_Σ", "driving torque | суммарный движущий момент | mômen dẫn động",
         "Torque of the motor on the crank with the losses of the joints."),
    row("balancing_torque", "N*m", "M_b|M_ур|M_cb", "balancing torque | уравновешивающий момент"
         " | mômen cân bằng",
         "Torque on the crank that holds loads and inertia in balance, positive with the rotation."),
    row("kinetic_energy", "J", "E|T|T", "kinetic energy | кинетическая энергия | động năng",
         "Kinetic energy of all bodies."),
    row("efficiency", "", "η", "efficiency | коэффициент полезного действия | hiệu suất",
         "Power that comes out over power that goes in."),
    row("body_mass", "kg", "m_i", "mass of a link | масса звена | khối lượng khâu", "Mass of one body."),
    row("body_inertia", "kg*m2", "J_S", "moment of inertia of a link | момент инерции звена"
         " | mômen quán tính khâu", "Moment of inertia of one body about its centre of mass."),
    row("centre_x", "mm", "x_S", "x of the centre of mass | абсцисса центра масс | hoành độ khối tâm",
         "Coordinate of the centre of mass of a body along the fixed x axis."),
    row("centre_y", "mm", "y_S", "y of the centre of mass | ордината центра масс | tung độ khối tâm",
         "Coordinate of the centre of mass of a body along the fixed y axis."),
    row("centre_acceleration", "m/s2", "a_S", "acceleration of the centre of mass | ускорение центра масс"
         " | gia tốc khối tâm", "Acceleration of the centre of mass of a body along one axis."),
    row("link_angle", "deg", "θ|φ_i|φ_i", "direction of a link | угол поворота звена | góc quay của khâu",
         "Direction of a link from the fixed x axis, positive anticlockwise."),
    row("link_angular_acceleration", "rad/s2", "α_i|ε_i|ε_i", "angular acceleration of a link"
         " | угловое ускорение звена | gia tốc góc của khâu", "Second time derivative of the direction of a link."),
    row("velocity_ratio", "mm", "v_i/ω|V_i/ω₁|v_i/ω₁", "velocity over crank speed | передаточная функция скорости"
         " | tỉ số vận tốc", "Speed of the centre of mass of a body over the angular speed of the crank."),
    row("rotation_ratio", "", "ω_i/ω|ω_i/ω₁|ω_i/ω₁", "angular speed over crank speed | передаточное отношение"
         " | tỉ số vận tốc góc", "Angular speed of a body over the angular speed of the crank."),
    # forces in joints
    row("link_inertia_force", "N", "F_i|P_и|P_qt", "inertia force of a link | сила инерции звена"
         " | lực quán tính của khâu", "Minus mass times acceleration of the centre of mass."),
    row("link_inertia_torque", "N*m", "M_i|M_и|M_qt", "inertia torque of a link | момент сил инерции звена"
         " | mômen quán tính của khâu", "Minus moment of inertia times angular acceleration."),
    row("link_torque", "N*m", "M_i", "torque on a link | момент на звене | mômen tác dụng lên khâu",
         "Torque applied to a link, positive anticlockwise."),
    row("joint_force", "N", "R", "joint force | реакция в шарнире | phản lực khớp",
         "Force in a revolute joint on the link that is held."),
    row("normal_force", "N", "N", "normal force of a guide | нормальная реакция направляющей"
         " | phản lực pháp tuyến của rãnh",
         "Force of a guide on its piece, positive to the left of the direction in which"
         " the distance of the piece counts."),
    row("normal_moment", "N*m", "M_N", "moment of the guide force | момент реакции направляющей"
         " | mômen phản lực của rãnh",
         "Moment of a guide on its piece about the origin of the piece, positive anticlockwise."),
    row("pin_radius", "mm", "r_z|r_ц|r_ch", "pin radius | радиус цапфы | bán kính chốt",
         "Radius of a pin in its bearing."),
    row("pin_friction", "", "f_z|f′|f′", "friction coefficient of a pin | приведённый коэффициент трения в шарнире"
         " | hệ số ma sát khớp quay", "Friction moment over joint force and pin radius."),
    row("friction_radius", "mm", "ρ", "radius of the friction circle | радиус круга трения"
         " | bán kính vòng tròn ma sát", "Distance at which the force in a pin with friction passes its centre."),
    row("guide_friction", "", "f", "friction coefficient of a guide | коэффициент трения скольжения"
         " | hệ số ma sát trượt", "Friction force over normal force in a guide."),
    row("friction_torque", "N*m", "M_f|M_т|M_ms", "friction moment | момент трения | mômen ma sát",
         "Moment of friction in a revolute joint."),
    row("friction_force", "N", "F_f|F_т|F_ms", "friction force | сила трения | lực ma sát",
         "Force of friction in a guide."),
    row("friction_power", "W", "P_f|N_т|P_ms", "friction power | мощность трения | công suất ma sát",
         "Power lost in the joints."),
    row("spring_stiffness", "N/m", "c", "spring stiffness | жёсткость пружины | độ cứng lò xo",
         "Force over elongation."),
    row("spring_length", "mm", "s", "spring length | длина пружины | chiều dài lò xo",
         "Distance of the ends of a spring."),
    row("spring_force", "N", "F_s|F_пр|F_lx", "spring force | сила пружины | lực lò xo",
         "Pull of a spring, positive as it draws its ends together."),
    # motion of any linkage
    row("point_x", "mm", "x", "x of a point | координата x точки | tọa độ x của điểm",
         "Coordinate along the fixed x axis."),
    row("point_y", "mm", "y", "y of a point | координата y точки | tọa độ y của điểm",
         "Coordinate along the fixed y axis."),
    row("point_velocity", "m/s", "v", "velocity of a point | скорость точки | vận tốc của điểm",
        "Magnitude of the velocity of a point."),
    row("point_acceleration", "m/s2", "a", "acceleration of a point | ускорение точки | gia tốc của điểm",
        "Magnitude of the acceleration of a point."),
    row("link_angular_velocity", "rad/s", "ω_i", "angular velocity of a link | угловая скорость звена"
        " | vận tốc góc của khâu", "Time derivative of the direction of a link."),
    row("slider_displacement", "mm", "s|S|s", "displacement of a slider | перемещение ползуна | chuyển vị con trượt",
        "Distance of a sliding piece along its guide."),
    row("slider_velocity", "m/s", "v_s|v_B|v_s", "velocity of a slider | скорость ползуна | vận tốc con trượt",
        "Time derivative of the displacement of a slider."),
    row("slider_acceleration", "m/s2", "a_s|a_B|a_s", "acceleration of a slider | ускорение ползуна"
        " | gia tốc con trượt", "Second time derivative of the displacement of a slider."),
    row("slider_stroke", "mm", "H|H|H", "stroke of a slider | ход ползуна | hành trình con trượt",
        "Difference of the extreme displacements of a slider."),
    row("link_swing", "deg", "ψ|ψ|ψ", "swing of a link | угол размаха звена | góc lắc của khâu",
        "Difference of the extreme directions of a link that does not turn fully."),
    row("joint_force_x", "N", "R_x", "x component of a joint force | проекция реакции на ось x"
        " | thành phần x của phản lực khớp",
         "Force in a revolute joint on the link that is held, along the fixed x axis."),
    row("joint_force_y", "N", "R_y", "y component of a joint force | проекция реакции на ось y"
        " | thành phần y của phản lực khớp",
         "Force in a revolute joint on the link that is held, along the fixed y axis."),
    row("steady_speed", "rpm", "n_s|n_уст|n_ôđ", "steady speed | установившаяся частота вращения"
        " | số vòng quay ổn định", "Mean speed of the crank that motor and loads settle at."),
    row("transient_time", "s", "t", "time | время | thời gian", "Time from the start of a transient."),
    row("final_turn", "rad", "φ_t|φ_t|φ_t", "angle turned by then | угол поворота за это время"
        " | góc quay sau thời gian đó", "Crank angle from the start of a transient."),
    row("final_speed", "rad/s", "ω_t|ω_t|ω_t", "angular speed by then | угловая скорость в этот момент"
        " | vận tốc góc lúc đó", "Angular speed of the crank at the end of a transient."),
    row("steady_fluctuation", "", "δ|δ|δ", "fluctuation at steady speed | неравномерность установившегося движения"
        " | hệ số không đều khi ổn định", "Largest less least speed, over the mean of the two, with motor and loads."),
    row("kinetic_energy_change", "J", "ΔT", "change of kinetic energy | изменение кинетической энергии"
        " | độ biến thiên động năng", "Work of loads and driving torque since the start of the cycle."),
    row("crank_speed", "rad/s", "ω|ω₁|ω₁", "true speed of the crank | угловая скорость кривошипа"
        " | vận tốc góc tay quay", "Angular speed of the crank over the cycle."),
    row("time_ratio", "", "K", "time ratio | коэффициент изменения средней скорости | hệ số về nhanh",
        "Time of the slower stroke over that of the faster one."),
    row("transmission_angle", "deg", "μ|γ|γ", "transmission angle | угол передачи | góc truyền động",
        "Angle between the links of a dyad, or between a link and the normal of its guide."),
)  # fmt: skip
