"""Values against angle or stroke as a table, between its points straight or smooth."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal, Self

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.loads.monotone import hermite, monotone_slopes
from crankwork.locale import ErrorMessage

Curve = Callable[[Array], Array]


@dataclass(frozen=True)
class LoadCurve:
    """A curve through points, which is called like a function.

    Examples
    --------
    >>> import numpy as np
    >>> LoadCurve((0.0, 0.1), (0.0, 500.0))(np.array([0.05, 0.2]))
    array([250.,   0.])
    """

    # Ascending abscissas, angles in radians or lengths in metres, and ordinates [rad or m], [N or N m]
    at: tuple[float, ...]
    values: tuple[float, ...]
    # Straight, where an abscissa given twice is a jump; a smooth curve that never overshoots the points; or one value
    # between two abscissas, with a jump at both
    interpolation: Literal["linear", "monotone", "constant"] = "linear"
    period: float = 0.0  # Period of the abscissa, 0 for none: outside the table the value is then zero [rad]
    stroke: float = 0.0  # Stroke of which the abscissas are shares, 0 if they are stated as lengths [m]

    def __post_init__(self) -> None:
        if len(self.at) != len(self.values) or len(self.at) < 2:
            raise ValueError(ErrorMessage("load_table_short", at=len(self.at), values=len(self.values)))
        if not all(math.isfinite(number) for number in (*self.at, *self.values)):
            raise ValueError(ErrorMessage("load_table_finite"))
        jumps = self.interpolation == "linear"
        if any(after < before or (after == before and not jumps) for before, after in pairwise(self.at)) or (
            self.at[0] == self.at[-1]
        ):
            raise ValueError(ErrorMessage("load_table_rises"))
        if self.period and self.at[-1] - self.at[0] > self.period * (1 + 1e-12):
            raise ValueError(ErrorMessage("load_table_period"))

    def over(self, stroke: float) -> Self:
        """Return the curve over a stroke of which its abscissas are shares. [m]"""
        return replace(self, at=tuple(share * stroke for share in self.at), stroke=stroke)

    def __call__(self, abscissas: Array) -> Array:
        """Return the values at some abscissas."""
        x, y = np.array(self.at), np.array(self.values)
        if self.period:
            abscissas = x[0] + np.mod(abscissas - x[0], self.period)
            if self.interpolation != "constant" and x[-1] - x[0] < self.period * (1 - 1e-12):
                x, y = np.append(x, x[0] + self.period), np.append(y, y[0])
        inside = (abscissas >= x[0]) & (abscissas <= x[-1])
        if self.interpolation != "monotone":
            value = np.interp(abscissas, x, y)
        else:
            value = hermite(x, y, monotone_slopes(x, y, periodic=bool(self.period)), np.clip(abscissas, x[0], x[-1]))
        return np.where(inside, value, 0.0)
