"""Loads given as curves, as columns that remember where they are not smooth."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from crankwork.formula.known import Known, Pieces, Table, absent, given
from crankwork.formula.over_cycle import OverCycle
from crankwork.kinematics.crank_grid import Array
from crankwork.loads.between import CurvePoint, curve_between
from crankwork.loads.monotone import monotone_slopes
from crankwork.loads.table import Curve
from crankwork.loads.table import Table as LoadTable

_SPARE = 1e-12

Course = Callable[[Mapping[str, Known]], OverCycle]


@dataclass(frozen=True)
class StatedTable:
    """A table of loads as a column, level beyond its ends, which rounding may pass.

    `path`: where a description states the load.
    """

    table: LoadTable
    key: str
    path: str

    def __call__(self, at: Array) -> Array:
        """Return the values at some abscissas."""
        return self.table(at if self.table.period else np.clip(at, self.table.at[0], self.table.at[-1]))

    def between(self, at: float, by: Known) -> Known:
        """Return the value at one abscissa, of the points that it lies between."""
        x, y, period = np.array(self.table.at), np.array(self.table.values), self.table.period
        turn = 0.0
        if period:
            turn = period * math.floor((at - x[0]) / period)
            if x[-1] - x[0] < period * (1 - _SPARE):
                x, y = np.append(x, x[0] + period), np.append(y, y[0])
        is_straight = self.table.interpolation == "linear"
        slopes = np.zeros_like(y) if is_straight else monotone_slopes(x, y, periodic=bool(period))
        first = int(np.clip(np.searchsorted(x, at - turn, side="right") - 1, 0, len(x) - 2))

        def point(k: int) -> CurvePoint:
            number = k % len(self.table.at) + 1
            column = "torque" if self.path.endswith(".torque") else "force"
            stated = f"{self.path.removesuffix(column)}at[{number}]"
            value = given("", float(y[k]), f"{self.path}[{number}]")
            return CurvePoint(given("", float(x[k]) + turn, stated), value, float(slopes[k]))

        return curve_between(self.key, by, point(first), point(first + 1), is_straight=is_straight)


def by_angle(curve: Curve, angle: Known, key: str, path: str = "") -> Known:
    """Return a curve over the crank angle. [rad]

    `curve`: what is given; a table says where it has corners, and so does whatever has `corners` [rad].
    """
    corners = [math.degrees(one) for one in _corners(curve)]
    if isinstance(curve, LoadTable) and not _varies(curve):
        return given(key, curve.values[0], f"{path}[1]")
    function = StatedTable(curve, key, path) if isinstance(curve, LoadTable) else curve
    return Known(Table(function, "given", corners, by=angle), key)


def by_column(curve: Curve, column: Known, course: Course, key: str, path: str = "") -> Known:
    """Return a curve over a column, with its corners at the crank angles where the column passes them."""
    if isinstance(curve, LoadTable) and not _varies(curve):
        return given(key, curve.values[0], f"{path}[1]")
    over, corners = course({"": column}), _corners(curve)
    passed = [one for corner in corners for one in over.crossings("", corner).tolist()]
    if not isinstance(curve, LoadTable):
        return Known(Table(curve, "given", passed, by=column), key)
    low, high = curve.at[0], curve.at[-1]
    law = Known(Table(StatedTable(curve, key, path), "given", passed, by=column), key)
    spare = _SPARE * max(abs(low), abs(high))
    ends = sorted([*over.crossings("", low - spare).tolist(), *over.crossings("", high + spare).tolist()])
    ends = [*ends, float(over.edges[-1])]
    middles = (np.array([over.edges[0], *ends[:-1]]) + np.array(ends)) / 2
    at = over.at("", middles)
    is_inside = (at > low - spare) & (at < high + spare)
    if is_inside.all():
        return law
    return Known(Pieces(ends, tuple(law if one else absent(key) for one in is_inside)), key)


def _corners(curve: Curve) -> tuple[float, ...]:
    return curve.at if isinstance(curve, LoadTable) else tuple(getattr(curve, "corners", ()))


def _varies(table: LoadTable) -> bool:
    return len(set(table.values)) > 1 or not (table.at[0] < -_ANYWHERE and table.at[-1] > _ANYWHERE)


_ANYWHERE = 100.0
