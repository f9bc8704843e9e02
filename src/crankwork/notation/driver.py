"""Arguments of the formulas of drivers and their laws."""

from __future__ import annotations

from crankwork.notation.argument import Argument

ARGUMENTS: dict[str, Argument] = {
    "z": Argument("time_share"),
    "c_0": Argument("law_coefficient", "{}₀"),
    "c_1": Argument("law_coefficient", "{}₁"),
    "c_2": Argument("law_coefficient", "{}₂"),
    "c_3": Argument("law_coefficient", "{}₃"),
    "c_4": Argument("law_coefficient", "{}₄"),
    "c_5": Argument("law_coefficient", "{}₅"),
    "c_6": Argument("law_coefficient", "{}₆"),
    "c_7": Argument("law_coefficient", "{}₇"),
    "A_s": Argument("law_amplitude"),
    "k_s": Argument("law_frequency"),
    "d_s": Argument("law_phase"),
    "q_a": Argument("driver_displacement", "{}₀"),
    "h_q": Argument("driver_way"),
    "f_z": Argument("way_share"),
    "f_z1": Argument("way_share_1"),
    "f_z2": Argument("way_share_2"),
    "T_s": Argument("segment_time"),
    "Q_q": Argument("driver_force"),
    "v_q": Argument("driver_velocity"),
    "l_s": Argument("link_length", "{}₃"),
    "l_1": Argument("link_length_1"),
    "l_2": Argument("link_length_2"),
    "cos_g": Argument("line_angle", "cos {}"),
    "sin_g": Argument("line_angle", "sin {}"),
}
