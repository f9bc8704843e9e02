"""Words that only sheets use, in three languages; numbers, units and symbols as all reports print them."""

from __future__ import annotations

import re
from typing import NamedTuple

from crankwork.locale import capital, say
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.language import key_unit, label, symbol
from crankwork.show.scene import indexed

# what is called as something else is called already
_SAME = {
    "bdc": "drawing.bdc",
    "crankpin_forces": "figures.crankpin_forces",
    "cylinder_torque": "drawing.one_cylinder",
    "data": "headings.data",
    "developed": "figures.pressure",
    "joint_forces": "tables.joint_forces",
    "linkage_kinematics": "headings.linkage_kinematics",
    "method": "report.method",
    "piston_forces": "figures.piston_forces",
    "polar": "figures.crankpin_polar",
    "position_plans": "figures.position_plans",
    "rod_forces": "figures.rod_forces",
    "second_sheet": "headings.dynamics",
    "tdc": "drawing.tdc",
    "torque": "quantities.crank_torque",
    "unrolled": "figures.crankpin_load",
    "wear": "figures.crankpin_wear",
    "wittenbauer": "figures.wittenbauer",
}
_POWER = re.compile(r"10([⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)")
_LEVEL = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789−")


class Words(NamedTuple):
    """How a sheet says things: its language, whether forces are per piston area, the period of a law that drives."""

    language: Language
    per_area: bool = False
    period: float = 0.0  # Curves are over time then, and not over the crank angle [s]

    def say(self, key: str) -> str:
        """Return a word of the sheets, or a title, which may be the name of a quantity."""
        if key in QUANTITIES:
            return capital(QUANTITIES[key].label(self.language))
        found = say(_SAME.get(key, f"sheets.{key}"), self.language)
        return capital(found) if _SAME.get(key, "").startswith("quantities.") else found

    def symbol(self, key: str) -> str:
        """Return the symbol of a quantity, its index marked."""
        return indexed(symbol(key, self.language))

    def label(self, key: str) -> str:
        """Return the name of a quantity."""
        return label(key, self.language)

    def unit(self, unit: str) -> str:
        """Return a unit as the language prints it."""
        return unit_name(unit, self.language)

    def unit_of(self, key: str) -> str:
        """Return the display unit of a quantity, per piston area where forces are."""
        return key_unit(key, per_area=self.per_area)

    def number(self, value: float, digits: int = 4) -> str:
        """Return a number as the language prints it."""
        shown = number(float(f"{value:.{digits}g}"), self.language, digits=7)
        return _POWER.sub(lambda found: f"10^{{{found[1].translate(_LEVEL)}}}", shown)

    def scale(self, sign: str, value: float, unit: str) -> str:
        """Return a scale as drawings state it, `μ_p = 0.02 MPa/mm`.

        `sign`: symbol of the quantity, its index marked or none; `value`: how much of it a millimetre of paper is
        [unit/mm].
        """
        name = self.unit(unit)
        name = f"({name})" if "/" in name else name
        index = sign.replace("_{", "").replace("}", "")
        head = f"μ_{{{index}}} = {self.number(value, 5)}"
        return f"{head} {name}/{self.unit('mm')}" if name else f"{head} {self.unit('mm')}⁻¹"
