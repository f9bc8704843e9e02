"""Arguments of the formulas of chambers of gas."""

from __future__ import annotations

from crankwork.notation.argument import Argument

ARGUMENTS: dict[str, Argument] = {
    "sigma": Argument("face_sense"),
    "s_x": Argument("slider_displacement"),
    "s_x0": Argument("slider_displacement", "{}₀"),
    "Z": Argument("reduced_volume"),
    "Z_1": Argument("reduced_volume", "{}₁"),
    "p_ref": Argument("diagram_pressure", "{}₁"),
}
