"""What the short names in formulas stand for.

A formula is written with the symbols of its subject; this table gives each argument its quantity and,
for arguments that are functions of one, the function: `cos_phi` is the cosine of the crank angle.
"""

from __future__ import annotations

from crankwork.notation import balance, bearings, chambers, cycle, cylinders, driver, linkage, machine
from crankwork.notation.argument import Argument
from crankwork.quantities import QUANTITIES

__all__ = ["ARGUMENTS", "Argument", "argument_unit"]

ARGUMENTS: dict[str, Argument] = {
    **machine.ARGUMENTS,
    **linkage.ARGUMENTS,
    **driver.ARGUMENTS,
    **chambers.ARGUMENTS,
    **cycle.ARGUMENTS,
    **cylinders.ARGUMENTS,
    **bearings.ARGUMENTS,
    **balance.ARGUMENTS,
}


def argument_unit(name: str) -> str:
    """Return the unit in which every formula takes an argument; functions of an angle have none.

    Examples
    --------
    >>> argument_unit("r"), argument_unit("n"), argument_unit("cos_phi")
    ('m', 'rpm', '')
    """
    entry = ARGUMENTS[name]
    if entry.unit or not entry.quantity:
        return entry.unit
    unit = QUANTITIES[entry.quantity].si_unit
    derivative = entry.pattern.endswith(("′", "″"))
    return "" if entry.pattern.startswith(("sin", "cos")) or (derivative and unit == "rad") else unit
