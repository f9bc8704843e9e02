"""Arguments of the formulas of bearing loads."""

from __future__ import annotations

from crankwork.notation.argument import Argument

ARGUMENTS: dict[str, Argument] = {
    "K": Argument("radial_force"),
    "K_Rb": Argument("big_end_inertia_force"),
    "K_wb": Argument("big_end_weight"),
    "T_b": Argument("big_end_tangential_force"),
    "P_p": Argument("piston_pin_force"),
    "F_wp": Argument("", "G_p", unit="N"),
    "sin_psi": Argument("crankpin_angle", "sin {}"),
    "cos_psi": Argument("crankpin_angle", "cos {}"),
    "Q_u": Argument("shaft_unbalance"),
    "z_b": Argument("shaft_position"),
    "z_left": Argument("shaft_position", "{}₁"),
    "z_right": Argument("shaft_position", "{}₂"),
    "R_b": Argument("bearing_load"),
    "R_max": Argument("bearing_load", "{}_max"),
    "R_mean": Argument("mean_bearing_load"),
    "d_b": Argument("bearing_diameter"),
    "l_b": Argument("bearing_length"),
}
