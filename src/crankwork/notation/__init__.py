"""What the short names in formulas stand for.

A formula is written with the symbols of its subject; this table gives each argument its quantity and,
for arguments that are functions of one, the function: `cos_phi` is the cosine of the crank angle.
"""

from __future__ import annotations

from crankwork.notation import balance, bearings, cycle, cylinders, machine
from crankwork.notation.argument import Argument

__all__ = ["ARGUMENTS", "Argument"]

ARGUMENTS: dict[str, Argument] = {
    **machine.ARGUMENTS,
    **cycle.ARGUMENTS,
    **cylinders.ARGUMENTS,
    **bearings.ARGUMENTS,
    **balance.ARGUMENTS,
}
