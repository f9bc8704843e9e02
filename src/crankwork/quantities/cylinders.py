"""Quantities of many cylinders on one shaft."""

from __future__ import annotations

from crankwork.quantities.quantity import row

ROWS = (
    # layout
    row("firing_interval", "deg", "Δθ|Δφ_в|δ_k", "firing interval | угловой интервал между вспышками"
         " | góc lệch công tác", "Angle of the crankshaft from one firing to the next."),
    row("firing_angle", "deg", "θ_k|θ_k|δ_k", "firing angle of a cylinder | угол сдвига рабочего процесса цилиндра"
         " | góc lệch công tác của xylanh", "Crank angle by which a cylinder fires after cylinder 1."),
    row("cylinder_number", "", "k", "cylinder | цилиндр | xylanh", "Number of the cylinder."),
    row("bank_axis", "deg", "γ_k", "direction of the cylinder axis | направление оси цилиндра"
         " | phương trục xylanh", "From the reference direction of the engine, positive with the rotation."),
    row("crankpin_angle", "deg", "ψ_k", "angle of the crankpin | угол расположения кривошипа | góc đặt chốt khuỷu",
         "Angle of the crankpin ahead of that of cylinder 1, positive with the rotation."),
    # torque along the shaft
    row("total_torque", "N*m", "M_Σ", "total torque | суммарный крутящий момент | tổng mômen quay",
         "Torque of all cylinders on the crankshaft, positive with the rotation."),
    row("mean_total_torque", "N*m", "M_Σm|M_Σср|M_Σtb", "mean total torque | средний суммарный крутящий момент"
         " | mômen tổng trung bình", "Mean of the torque of all cylinders over the cycle."),
    row("throw_torque", "N*m", "M_t|M_кол|M_kh", "torque of a throw | крутящий момент колена"
         " | mômen của một khuỷu", "Torque of all cylinders of one throw."),
    row("journal_torque", "N*m", "M_j|M_кш|M_ck", "torque on a main journal"
         " | набегающий момент на коренной шейке | mômen xoắn tích luỹ tại cổ trục",
         "Sum of the torques of all throws before the journal, from the free end of the shaft."),
    row("crankpin_torque", "N*m", "M_cp|M_шш|M_ch", "torque on a crankpin"
         " | набегающий момент на шатунной шейке | mômen xoắn tích luỹ tại chốt khuỷu",
         "Torque of the main journal before the crankpin and half of that of its own throw."),
    # harmonics
    row("harmonic_order", "", "ν", "order of a harmonic | порядок гармоники | bậc điều hoà",
         "How often the harmonic repeats in a revolution of the crankshaft."),
    row("harmonic_cosine", "N*m", "a_ν", "cosine coefficient of the torque | косинусный коэффициент момента"
         " | hệ số cosin của mômen", "Coefficient of the cosine of one order."),
    row("harmonic_sine", "N*m", "b_ν", "sine coefficient of the torque | синусный коэффициент момента"
         " | hệ số sin của mômen", "Coefficient of the sine of one order."),
    row("harmonic_amplitude", "N*m", "M_ν", "amplitude of a torque harmonic | амплитуда гармоники крутящего момента"
         " | biên độ điều hoà của mômen", "Amplitude of one order of the torque of one cylinder."),
    row("harmonic_phase", "deg", "ψ_ν", "phase of a torque harmonic | фаза гармоники крутящего момента"
         " | pha của điều hoà mômen", "Crank angle times the order at which the harmonic is largest."),
    row("phase_sum", "", "s_ν", "sum of the phase star | сумма векторов фазовой диаграммы"
         " | tổng véctơ của hình sao pha", "Length of the sum of the unit vectors of one order over all cylinders."),
    row("total_harmonic_amplitude", "N*m", "M_Σν", "amplitude of a harmonic of the total torque"
         " | амплитуда гармоники суммарного момента | biên độ điều hoà của mômen tổng",
         "Amplitude of one order of the torque of all cylinders."),
    # articulated rods
    row("articulated_rod_length", "mm", "l_1|L_1|L_1", "articulated rod length | длина прицепного шатуна"
         " | chiều dài thanh truyền phụ", "Distance between the axes of the knuckle pin and the piston pin."),
    row("knuckle_radius", "mm", "r_1|r_1|r_1", "knuckle pin radius | радиус расположения пальца прицепного шатуна"
         " | bán kính chốt phụ", "Distance from the crankpin axis to the knuckle pin axis."),
    row("knuckle_angle", "deg", "γ_1|γ_п|γ_1", "knuckle pin angle | угол расположения пальца прицепного шатуна"
         " | góc đặt chốt phụ", "From the axis of the master rod to the knuckle pin, seen from the crankpin."),
    row("knuckle_direction", "deg", "δ", "direction of the knuckle pin | направление на палец прицепного шатуна"
         " | phương của chốt phụ", "From the axis of the articulated rod's cylinder to the knuckle pin, seen from the"
         " crankpin."),
    row("knuckle_x", "mm", "x_A", "knuckle pin along the axis | координата пальца прицепного шатуна вдоль оси"
         " | toạ độ chốt phụ dọc trục", "From the crankshaft along the axis of the articulated rod's cylinder."),
    row("knuckle_y", "mm", "y_A", "knuckle pin across the axis | координата пальца прицепного шатуна поперёк оси"
         " | toạ độ chốt phụ vuông góc trục", "From the crankshaft across the axis of the articulated rod's cylinder."),
    row("articulated_rod_angle", "deg", "β_1", "angle of the articulated rod | угол отклонения прицепного шатуна"
         " | góc lệch thanh truyền phụ", "Angle between articulated rod and axis of its cylinder."),
    row("knuckle_couple", "N*m", "M_A", "moment of the knuckle pin | момент силы на пальце прицепного шатуна"
         " | mômen của lực trên chốt phụ", "Moment of the force on the knuckle pin about the crankpin."),
    row("knuckle_side_force", "N", "ΔF_N|ΔN|ΔN", "side force from the articulated rod"
         " | дополнительная боковая сила от прицепного шатуна | lực ngang bổ sung do thanh truyền phụ",
         "Side force of the master piston that holds the moment of the knuckle pin."),
    row("clearance_height", "mm", "h_c", "height of the clearance | высота камеры сжатия"
         " | chiều cao buồng cháy", "Clearance volume over piston area."),
)  # fmt: skip
