"""Shared context of the figures of an engine: its diagrams, and its values, units and titles as text."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.bearing_diagrams import BearingDiagrams
from crankwork.analysis.diagrams import fine_columns
from crankwork.analysis.engine_diagrams import EngineDiagrams
from crankwork.errors import CrankworkError
from crankwork.locale import say
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.figure_data import figure_title
from crankwork.report.language import displayed, key_unit, row_name
from crankwork.report.summary import results_method
from crankwork.show.chart import Graph, write_method
from crankwork.show.paper import Canvas, plain
from crankwork.show.scene import Drawing


@dataclass(frozen=True)
class Drawn:
    """Data of the figures of a machine, with its values, units and titles as displayed."""

    results: Results
    language: Language
    area: float | None  # Of the piston, by which forces are divided [m2]

    @property
    def cycle(self) -> float:
        """Length of the cycle. [deg]"""
        return self.results.machine.cycle

    @property
    def per_area(self) -> bool:
        """Whether forces are per piston area."""
        return self.area is not None

    def shown(self, key: str, values: Array | float) -> Array:
        """Return SI values in the display unit of a quantity. [display unit]"""
        return np.asarray(values) * displayed(key, 1.0, per_area=self.area)

    def unit(self, key: str) -> str:
        """Return the display unit of a quantity as the language prints it."""
        return unit_name(key_unit(key, per_area=self.per_area), self.language)

    def symbol(self, key: str) -> str:
        """Return the symbol of a quantity, between dollar signs."""
        return f"${QUANTITIES[key].symbol(self.language)}$"

    def title(self, key: str) -> str:
        """Return the axis title of a quantity: name, symbol, unit."""
        unit = self.unit(key)
        return f"{QUANTITIES[key].label(self.language)} {self.symbol(key)}" + (f", {unit}" if unit else "")

    def name_axes(self, graph: Graph, across: str, up: str) -> None:
        """Write the titles of both axes."""
        graph.x_title(self.title(across))
        graph.y_title(self.title(up))

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

    def finished(self, name: str, paper: Canvas, remark: str = "", *, forces: bool = False, owner: str = "") -> Drawing:
        """Return a figure, with the method that made it; `owner`: what it is of, for its title."""
        if forces and self.per_area:
            remark = "; ".join(text for text in (remark, say("report.per_area", self.language)) if text)
        write_method(paper, results_method(self.results, self.language), remark)
        title = figure_title(name, self.language)
        return paper.drawing(f"{title}, {owner}" if owner else title, self.language)


@dataclass(frozen=True)
class BearingsDrawn(Drawn):
    """Data of the figures of the bearings of a machine."""

    @property
    def bearings(self) -> BearingDiagrams:
        """The loads of its bearings."""
        raise NotImplementedError

    @property
    def cylinders(self) -> int:
        """How many cylinders its torque is one of; none of a linkage."""
        return 0

    # the frame of the loads of main journals in words
    shaft_frame = "crank_up"

    def row(self, kind: str, name: str) -> str:
        """Return the name of a bearing in listings; `kind`: `crankpin` or `main_journal`."""
        return name if kind else ""

    def row_text(self, kind: str, name: str) -> str:
        """Return what a bearing is called."""
        return plain(self.row(kind, name))


@dataclass(frozen=True)
class EngineDrawn(BearingsDrawn):
    """Data of the figures of an engine or its crank mechanism: results on a finer grid than tables, as displayed."""

    columns: Mapping[str, Array]  # [SI]
    degrees: Array  # [deg]

    shaft_frame = "crank_one"

    @property
    def bearings(self) -> BearingDiagrams:
        """The loads of its bearings."""
        return self.diagrams

    @property
    def cylinders(self) -> int:
        """How many cylinders it has."""
        return self.diagrams.count

    def row(self, kind: str, name: str) -> str:
        """Return the name of a bearing in listings; `kind`: `crankpin` or `main_journal`."""
        return f"{kind}.{name}"

    def row_text(self, kind: str, name: str) -> str:
        """Return what a bearing is called."""
        return row_name(self.row(kind, name), self.language)

    def values(self, key: str) -> Array:
        """Return a column in its display unit."""
        return self.shown(key, self.columns[key])

    @cached_property
    def diagrams(self) -> EngineDiagrams:
        """Curves and diagrams of all cylinders."""
        return EngineDiagrams(self.results)

    @property
    def other_pressures(self) -> dict[int, Array]:
        """Gas pressure of cylinders whose gas is not that of the first, by number, at their own crank angle. [MPa]"""
        machine = self.results.machine
        if machine.engine is None or not machine.engine.gases:
            return {}
        pressures = self.diagrams.other_pressures(self.degrees)
        return {number: self.shown("gas_pressure", pressure) for number, pressure in pressures.items()}


def engine_drawn(results: Results, language: Language, *, per_area: bool) -> EngineDrawn:
    """Return the shared context of the figures."""
    area = results.summary.get("piston_area") if per_area else None
    if per_area and area is None and "piston_force" in results.columns:
        raise CrankworkError("forces per piston area need cylinder.bore")
    fine = fine_columns(results)
    return EngineDrawn(results, language, area, fine.columns, fine.degrees)
