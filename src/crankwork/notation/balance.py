"""Arguments of the formulas of balance."""

from __future__ import annotations

from crankwork.notation.argument import Argument

ARGUMENTS: dict[str, Argument] = {
    "F_sx": Argument("shaking_force_x"),
    "F_sy": Argument("shaking_force_y"),
    "A_q": Argument("acceleration_coefficient"),
    "F_jq": Argument("order_inertia_force"),
    "K_F": Argument("force_factor"),
    "K_M": Argument("moment_factor"),
    "a_z": Argument("balance_pitch"),
    "k_b": Argument("balanced_share"),
}
