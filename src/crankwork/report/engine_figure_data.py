"""What the figures of a whole engine share: its diagrams, and how values, units and titles are written."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.engine_diagrams import EngineDiagrams
from crankwork.locale import say
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.figure_data import Drawn, figure_title
from crankwork.report.language import displayed, key_unit
from crankwork.report.summary import results_method
from crankwork.show.chart import sign
from crankwork.show.paper import Paper
from crankwork.show.scene import Drawing


@dataclass(frozen=True)
class EngineDrawn:
    """What is drawn of an engine."""

    drawn: Drawn  # What the figures of one cylinder share

    @property
    def language(self) -> Language:
        """Language of names, units and numbers."""
        return self.drawn.language

    @property
    def cycle(self) -> float:
        """Length of the cycle. [deg]"""
        return self.drawn.results.machine.cycle

    @cached_property
    def diagrams(self) -> EngineDiagrams:
        """Curves and diagrams of all cylinders."""
        return EngineDiagrams(self.drawn.results)

    @property
    def other_pressures(self) -> dict[int, Array]:
        """Gas pressure of cylinders whose gas is not that of the first, by number, at their own crank angle. [MPa]"""
        machine, degrees = self.drawn.results.machine, self.drawn.degrees
        if machine.engine is None or not machine.engine.gases:
            return {}
        found = self.diagrams.other_pressures(degrees)
        return {number: self.shown("gas_pressure", one) for number, one in found.items()}

    def shown(self, key: str, values: Array | float) -> Array:
        """Return SI values in the display unit of a quantity. [display unit]"""
        return np.asarray(values) * displayed(key, 1.0, per_area=self.drawn.area)

    def unit(self, key: str) -> str:
        """Return the display unit of a quantity as the language prints it."""
        return unit_name(key_unit(key, per_area=self.drawn.per_area), self.language)

    def symbol(self, key: str) -> str:
        """Return the symbol of a quantity, between dollar signs."""
        return f"${QUANTITIES[key].symbol(self.language)}$"

    def title(self, key: str) -> str:
        """Return the axis title of a quantity: name, symbol, unit."""
        unit = self.unit(key)
        return f"{QUANTITIES[key].label(self.language)} {self.symbol(key)}" + (f", {unit}" if unit else "")

    def named(self, key: str) -> str:
        """Return symbol and name of a quantity for a legend."""
        return f"{self.symbol(key)} – {QUANTITIES[key].label(self.language)}"

    def value(self, key: str, value: float, digits: int = 4) -> str:
        """Return an SI value with its unit."""
        shown = self.number(float(self.shown(key, value)), digits)
        unit = self.unit(key)
        return f"{shown}{unit}" if unit in ("", "°") else f"{shown}\N{NO-BREAK SPACE}{unit}"

    def number(self, value: float, digits: int = 6) -> str:
        """Return a number as the language prints it."""
        return number(float(f"{value:.{digits}g}"), self.language, digits=max(digits, 9))

    def finished(self, name: str, paper: Paper, remark: str = "", *, forces: bool = False) -> Drawing:
        """Return a figure, with the method that made it."""
        if forces and self.drawn.per_area:
            remark = "; ".join(one for one in (remark, say("report.per_area", self.language)) if one)
        sign(paper, results_method(self.drawn.results, self.language), remark)
        return paper.drawing(figure_title(name, self.language), self.language)
