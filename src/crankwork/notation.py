"""What the short names in formulas stand for.

A formula is written with the symbols of its subject; this table gives each argument its quantity and,
for arguments that are functions of one, the function: `cos_phi` is the cosine of the crank angle.
"""

from __future__ import annotations

from typing import NamedTuple


class Argument(NamedTuple):
    """The quantity behind an argument of a formula; `pattern` places its symbol, `cos {}`."""

    quantity: str
    pattern: str = "{}"
    extra: str = ""


# `extra` is a second quantity where the pattern takes two, or a literal symbol where there is no quantity.
ARGUMENTS: dict[str, Argument] = {
    "r": Argument("crank_radius"),
    "l": Argument("rod_length"),
    "e": Argument("offset"),
    "lam": Argument("rod_ratio"),
    "D": Argument("bore"),
    "A": Argument("piston_area"),
    "stroke": Argument("stroke"),
    "V": Argument("cylinder_volume"),
    "V_c": Argument("clearance_volume"),
    "V_d": Argument("swept_volume"),
    "h": Argument("", "h"),
    "x": Argument("piston_displacement"),
    "a": Argument("piston_acceleration"),
    "n": Argument("rotational_speed"),
    "w": Argument("speed"),
    "eps": Argument("angular_acceleration"),
    "sin_phi": Argument("crank_angle", "sin {}"),
    "cos_phi": Argument("crank_angle", "cos {}"),
    "sin_2phi": Argument("crank_angle", "sin 2{}"),
    "cos_2phi": Argument("crank_angle", "cos 2{}"),
    "sin_beta": Argument("rod_angle", "sin {}"),
    "cos_beta": Argument("rod_angle", "cos {}"),
    "sin_phi_beta": Argument("crank_angle", "sin({} + {})", "rod_angle"),
    "cos_phi_beta": Argument("crank_angle", "cos({} + {})", "rod_angle"),
    "beta_1": Argument("rod_angle", "{}′"),
    "beta_2": Argument("rod_angle", "{}″"),
    "x_1": Argument("piston_displacement", "{}′"),
    "x_2": Argument("piston_displacement", "{}″"),
    "r_c": Argument("compression_ratio"),
    "p": Argument("gas_pressure"),
    "p_0": Argument("ambient_pressure"),
    "p_1": Argument("gas_pressure", "{}₁"),
    "V_1": Argument("cylinder_volume", "{}₁"),
    "n_p": Argument("", "n"),
    "A_r": Argument("", "A_r"),
    "p_b": Argument("", "p_b"),
    "W": Argument("indicated_work"),
    "phi_c": Argument("cycle_angle"),
    "pi": Argument("", "π"),
    "g": Argument("", "g"),
    "cos_theta": Argument("inclination", "cos {}"),
    "sin_theta": Argument("inclination", "sin {}"),
    "m": Argument("rod_mass"),
    "m_p": Argument("piston_mass"),
    "m_1": Argument("rod_small_end_mass"),
    "m_2": Argument("rod_big_end_mass"),
    "m_k": Argument("crank_mass"),
    "m_rec": Argument("reciprocating_mass"),
    "m_rot": Argument("rotating_mass"),
    "b": Argument("", "b"),
    "J_c": Argument("rod_inertia"),
    "dJ": Argument("rod_inertia_excess"),
    "eps_r": Argument("rod_angular_acceleration"),
    "F_g": Argument("gas_force"),
    "F_j": Argument("inertia_force"),
    "F_w": Argument("weight_force"),
    "F_wn": Argument("transverse_weight"),
    "P": Argument("piston_force"),
    "N": Argument("side_force"),
    "T": Argument("tangential_force"),
    "M_r": Argument("rotating_torque"),
    "M_c": Argument("correction_couple"),
}
