"""Loads given as curves, as traced columns with their corners."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from crankwork.formula.known import Known, Pieces, Table, absent, given
from crankwork.formula.over_cycle import OverCycle
from crankwork.kinematics.crank_grid import Array
from crankwork.loads.between import CurvePoint, curve_between
from crankwork.loads.monotone import monotone_slopes
from crankwork.loads.table import Curve
from crankwork.loads.table import Table as LoadTable

_MARGIN = 1e-12


@dataclass(frozen=True)
class StatedTable:
    """A table of loads as a column, constant beyond its ends, which rounding may pass.

    `path`: where a description states the load.
    """

    table: LoadTable
    key: str
    path: str

    def __call__(self, abscissas: Array) -> Array:
        """Return the values at some abscissas."""
        return self.table(abscissas if self.table.period else np.clip(abscissas, self.table.at[0], self.table.at[-1]))

    def between(self, abscissa: float, argument: Known) -> Known:
        """Return the value at one abscissa, interpolated between two points."""
        x, y, period = np.array(self.table.at), np.array(self.table.values), self.table.period
        turn = 0.0
        if period:
            turn = period * math.floor((abscissa - x[0]) / period)
            if x[-1] - x[0] < period * (1 - _MARGIN):
                x, y = np.append(x, x[0] + period), np.append(y, y[0])
        is_straight = self.table.interpolation == "linear"
        slopes = np.zeros_like(y) if is_straight else monotone_slopes(x, y, periodic=bool(period))
        first = int(np.clip(np.searchsorted(x, abscissa - turn, side="right") - 1, 0, len(x) - 2))

        def point(k: int) -> CurvePoint:
            number = k % len(self.table.at) + 1
            column = "torque" if self.path.endswith(".torque") else "force"
            stated = f"{self.path.removesuffix(column)}at[{number}]"
            value = given("", float(y[k]), f"{self.path}[{number}]")
            return CurvePoint(given("", float(x[k]) + turn, stated), value, float(slopes[k]))

        return curve_between(self.key, argument, point(first), point(first + 1), is_straight=is_straight)


def curve_over_angle(curve: Curve, angle: Known, key: str, path: str = "") -> Known:
    """Return a curve over the crank angle. [rad]

    `curve`: a table, or a function that may have `corners` [rad].
    """
    corners = [math.degrees(corner) for corner in _corners(curve)]
    if isinstance(curve, LoadTable) and not _varies(curve):
        return given(key, curve.values[0], f"{path}[1]")
    function = StatedTable(curve, key, path) if isinstance(curve, LoadTable) else curve
    return Known(Table(function, "given", corners, by=angle), key)


def curve_over_column(curve: Curve, over: OverCycle, column: str, key: str, path: str = "") -> Known:
    """Return a curve over a column, with its corners at the crank angles where the column passes them.

    `column`: its key among the columns over the cycle.
    """
    if isinstance(curve, LoadTable) and not _varies(curve):
        return given(key, curve.values[0], f"{path}[1]")
    known, corners = over.knowns[column], _corners(curve)
    passed = [angle for corner in corners for angle in over.crossings(column, corner).tolist()]
    if not isinstance(curve, LoadTable):
        return Known(Table(curve, "given", passed, by=known), key)
    low, high = curve.at[0], curve.at[-1]
    law = Known(Table(StatedTable(curve, key, path), "given", passed, by=known), key)
    margin = _MARGIN * max(abs(low), abs(high))
    ends = sorted([*over.crossings(column, low - margin).tolist(), *over.crossings(column, high + margin).tolist()])
    ends = [*ends, float(over.edges[-1])]
    values = over.at(column, (np.array([over.edges[0], *ends[:-1]]) + np.array(ends)) / 2)
    is_inside = (values > low - margin) & (values < high + margin)
    if is_inside.all():
        return law
    return Known(Pieces(ends, tuple(law if inside else absent(key) for inside in is_inside)), key)


def _corners(curve: Curve) -> tuple[float, ...]:
    return curve.at if isinstance(curve, LoadTable) else tuple(getattr(curve, "corners", ()))


def _varies(table: LoadTable) -> bool:
    return len(set(table.values)) > 1 or not (table.at[0] < -_ANYWHERE and table.at[-1] > _ANYWHERE)


_ANYWHERE = 100.0
