"""Arguments of the formulas of many cylinders on one shaft."""

from __future__ import annotations

from crankwork.notation.argument import Argument

ARGUMENTS: dict[str, Argument] = {
    "M_j": Argument("journal_torque"),
    "M_t": Argument("throw_torque"),
    "a_nu": Argument("harmonic_cosine"),
    "b_nu": Argument("harmonic_sine"),
    "M_nu": Argument("harmonic_amplitude"),
    "s_nu": Argument("phase_sum"),
    "l_a": Argument("articulated_rod_length"),
    "r_a": Argument("knuckle_radius"),
    "sin_delta_a": Argument("knuckle_direction", "sin {}"),
    "cos_delta_a": Argument("knuckle_direction", "cos {}"),
    "x_A1": Argument("knuckle_x", "{}′"),
    "x_A2": Argument("knuckle_x", "{}″"),
    "y_A": Argument("knuckle_y"),
    "y_A1": Argument("knuckle_y", "{}′"),
    "y_A2": Argument("knuckle_y", "{}″"),
    "sin_beta_a": Argument("articulated_rod_angle", "sin {}"),
    "cos_beta_a": Argument("articulated_rod_angle", "cos {}"),
    "beta_a1": Argument("articulated_rod_angle", "{}′"),
    "M_a": Argument("knuckle_couple"),
    "X_A": Argument("knuckle_force_x"),
    "Y_A": Argument("knuckle_force_y"),
    "a_Ax": Argument("knuckle_acceleration_x"),
    "a_Ay": Argument("knuckle_acceleration_y"),
    "m_2a": Argument("knuckle_mass"),
}
