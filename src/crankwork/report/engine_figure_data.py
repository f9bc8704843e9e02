"""What the figures of a whole engine share: its loads, torques and balance, computed finer than the tables, once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from crankwork.analysis.cylinders import WholeEngine, breaks, cylinder_columns, torque_curves, whole_engine
from crankwork.analysis.engine_balance import EngineBalance, engine_balance
from crankwork.analysis.engine_bearings import BearingLoads, dense_loads
from crankwork.analysis.engine_torque import EngineTorque, engine_torque
from crankwork.cylinders.bearings import big_end_inertia_force
from crankwork.kinematics.crank_grid import Array
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.engine_figure_axes import sign
from crankwork.report.engine_figure_paper import Paper
from crankwork.report.figure_data import Drawn, figure_title
from crankwork.report.language import displayed, key_unit, method_name, number, unit_name, word

# Behind a corner of the pressure, where there may be a jump. [deg]
_AFTER = 1e-6


@dataclass(frozen=True)
class EngineDrawn:
    """What is drawn of an engine.

    Parameters
    ----------
    drawn : Drawn
        What the figures of one cylinder share.
    """

    drawn: Drawn

    @property
    def language(self) -> Language:
        """Language of names, units and numbers."""
        return self.drawn.language

    @property
    def cycle(self) -> float:
        """Length of the cycle. [deg]"""
        return self.drawn.results.machine.cycle

    @cached_property
    def whole(self) -> WholeEngine:
        """The engine."""
        return whole_engine(self.drawn.results.solved)

    @cached_property
    def torque(self) -> EngineTorque:
        """Torque of one cylinder and of all, excess work and speed."""
        return engine_torque(self.whole, *torque_curves(self.whole))[0]

    @cached_property
    def degrees(self) -> Array:
        """Crank angles of the torques, on both sides of every corner of the pressure. [deg]"""
        corners = breaks(self.whole)
        angles = np.concatenate([np.arange(0.0, self.cycle + 0.5), corners, corners[:-1] + _AFTER])
        return np.unique(angles)

    @cached_property
    def torques(self) -> Array:
        """Torque of every cylinder at `degrees`, shape (cylinders, n). [N m]"""
        return cylinder_columns(self.whole, self.degrees)["crank_torque"]

    @cached_property
    def loads(self) -> tuple[Array, BearingLoads]:
        """Crank angles one degree apart [deg], and the loads of the bearings there, those of the summary. [N]"""
        return dense_loads(self.whole)

    @cached_property
    def balance(self) -> EngineBalance:
        """Free forces and moments."""
        return engine_balance(self.whole)

    @property
    def rod_inertia(self) -> float:
        """Inertia force of the mass of one rod at the crankpin, never positive. [N]"""
        solved = self.whole.master
        return float(big_end_inertia_force(self.whole.masses.rod_big_end, solved.lengths.crank_radius, solved.speed))

    def shown(self, key: str, values: Array | float) -> Array:
        """Return SI values in the display unit of a quantity.

        Parameters
        ----------
        key : str
            The quantity.
        values : array or float
            Its values. [SI]

        Returns
        -------
        array
            Values. [display unit]
        """
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
        """Return an SI value with its unit.

        Parameters
        ----------
        key : str
            The quantity.
        value : float
            Its value. [SI]
        digits : int
            How many significant ones.

        Returns
        -------
        str
            Number and unit.
        """
        shown = self.number(float(self.shown(key, value)), digits)
        unit = self.unit(key)
        return f"{shown}{unit}" if unit in ("", "°") else f"{shown}\N{NO-BREAK SPACE}{unit}"

    def number(self, value: float, digits: int = 6) -> str:
        """Return a number as the language prints it."""
        return number(float(f"{value:.{digits}g}"), self.language, digits=max(digits, 9))

    def finished(self, name: str, paper: Paper, remark: str = "", *, forces: bool = False) -> bytes:
        """Return a figure as SVG, with the method that made it.

        Parameters
        ----------
        name : str
            Name of the figure.
        paper : Paper
            What is drawn.
        remark : str
            Printed at the lower left.
        forces : bool
            Whether forces per piston area must be said to be so.

        Returns
        -------
        bytes
            SVG.
        """
        method = self.drawn.results.method
        if forces and self.drawn.per_area:
            remark = "; ".join(one for one in (remark, word("per_area", self.language)) if one)
        sign(paper, method_name(method.kinematics, method.order, method.rod, self.language), remark)
        return paper.svg(figure_title(name, self.language))
