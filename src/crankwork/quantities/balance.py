"""Quantities of balance."""

from __future__ import annotations

from crankwork.quantities.quantity import row

ROWS = (
    # free forces and moments
    row("acceleration_coefficient", "", "A_q", "acceleration coefficient | коэффициент гармоники ускорения поршня"
         " | hệ số điều hòa của gia tốc piston",
         "Amplitude of one order of the piston acceleration over crank radius times angular speed squared."),
    row("primary_inertia_force", "N", "F_I|P_jI|P_j1", "primary inertia force | сила инерции первого порядка"
         " | lực quán tính cấp 1", "Amplitude of the first order of the inertia force of one cylinder.", "MPa"),
    row("secondary_inertia_force", "N", "F_II|P_jII|P_j2", "secondary inertia force | сила инерции второго порядка"
         " | lực quán tính cấp 2", "Amplitude of the second order of the inertia force of one cylinder.", "MPa"),
    row("order_inertia_force", "N", "F_jq|P_jq|P_jq", "inertia force of one order | сила инерции порядка q"
         " | lực quán tính cấp q", "Amplitude of one order of the inertia force of one cylinder.", "MPa"),
    row("force_factor", "", "K_F|k_P|k_P", "force factor of the layout | коэффициент суммарной силы инерции"
         " | hệ số tổng lực quán tính", "Free force of one order over that of one cylinder."),
    row("moment_factor", "", "K_M|k_M|k_M", "moment factor of the layout | коэффициент момента сил инерции"
         " | hệ số mômen lực quán tính", "Free moment of one order over that of one cylinder at one cylinder pitch."),
    row("balance_pitch", "mm", "a|a|a_xl", "distance between cylinder axes | расстояние между осями цилиндров"
         " | khoảng cách giữa hai đường tâm xylanh", "Distance along the shaft between two cylinders."),
    row("free_force", "N", "ΣF_q|ΣP_jq|ΣP_jq", "free force of one order | неуравновешенная сила инерции порядка q"
         " | lực quán tính tự do cấp q", "Largest sum of the inertia forces of one order of all cylinders."),
    row("free_force_direction", "deg", "χ_q|χ_q|χ_q", "direction of the free force"
         " | направление неуравновешенной силы | phương của lực quán tính tự do",
         "Direction of the largest free force of one order, from the reference direction of the engine."),
    row("free_moment", "N*m", "ΣM_q|ΣM_jq|ΣM_jq", "free moment of one order"
         " | неуравновешенный момент сил инерции порядка q | mômen lực quán tính tự do cấp q",
         "Largest moment of the inertia forces of one order along the shaft."),
    # counterweights
    row("balanced_share", "", "k_b|k_ур|k_cb", "balanced share of the reciprocating mass"
         " | доля уравновешиваемых поступательно движущихся масс | tỉ lệ khối lượng tịnh tiến được cân bằng",
         "Share of the reciprocating mass that counterweights balance as if it turned with the crankpin."),
    row("counterweight_moment", "kg*m", "Q_b|Q_пр|Q_đt", "counterweight mass moment"
         " | статический момент противовеса | mômen tĩnh của đối trọng",
         "Mass of a counterweight times the distance of its centre of mass from the crankshaft axis."),
    row("counterweight_mass", "kg", "m_b|m_пр|m_đt", "counterweight mass | масса противовеса"
         " | khối lượng đối trọng", "Mass of one counterweight."),
    row("counterweight_radius", "mm", "r_b|ρ_пр|r_đt", "counterweight radius"
         " | расстояние центра масс противовеса от оси вала | bán kính trọng tâm đối trọng",
         "Distance of the centre of mass of a counterweight from the crankshaft axis."),
    row("residual_force", "N", "F_res|P_ост|P_dư", "residual primary force"
         " | остаточная сила инерции первого порядка | lực quán tính cấp 1 còn dư",
         "First order of the inertia forces of one cylinder that partial balance leaves."),
    # balance shafts
    row("balance_shaft_moment", "kg*m", "Q_s|Q_в|Q_tc", "mass moment of a balance shaft"
         " | статический момент груза уравновешивающего вала | mômen tĩnh của trục cân bằng",
         "Mass of the weight on one balance shaft times the distance of its centre of mass from that shaft."),
    row("balance_shaft_torque", "N*m", "M_s|M_в|M_tc", "torque of the balance shafts on the frame"
         " | опрокидывающий момент уравновешивающих валов | mômen của các trục cân bằng tác dụng lên thân máy",
         "Moment of the forces of the balance shafts about the crankshaft axis, positive with the rotation."),
    # locomotives
    row("hammer_blow", "N", "F_hb|P_дин|P_đ", "hammer blow"
         " | динамическая сила избыточного противовеса | lực đập của bánh xe lên ray",
         "Largest vertical force of the part of a wheel's counterweight that balances reciprocating mass."),
    row("tractive_effort_variation", "N", "ΔF_t|ΔF_т|ΔF_k", "variation of tractive effort | колебание силы тяги"
         " | độ dao động của lực kéo",
         "Primary inertia force along the line of stroke that the counterweights leave."),
    row("swaying_couple", "N*m", "C_s|M_в|M_l", "swaying couple | момент виляния | ngẫu lực lắc ngang",
         "Couple, about the vertical midway between the cylinders, of the primary forces that are left."),
)  # fmt: skip
