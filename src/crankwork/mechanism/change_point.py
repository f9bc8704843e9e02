"""Passages of dyads through change points, where their two branches meet."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Polynomial:
    """A quantity near a crank angle, by Chebyshev polynomials of the distance from it. [deg]"""

    centre: float
    reach: float  # Distance from the centre of the farthest fitted values
    coefficients: tuple[float, ...]

    def __call__(self, degrees: Array) -> Array:
        """Return the quantity at crank angles."""
        return np.asarray(chebyshev.chebval((degrees - self.centre) / self.reach, self.coefficients))


@dataclass(frozen=True)
class ChangePointFit:
    """Polynomials for a dyad near a change point, where its own formulas are 0/0."""

    degrees: float  # Crank angle of the change point
    width: float  # Half width of the range of the polynomials [deg]
    columns: Mapping[str, Polynomial]  # By the quantity that they replace


@dataclass(frozen=True)
class ChangePointPassage:
    """The change points of a dyad, at each of which it changes its branch."""

    changes: tuple[float, ...]  # Crank angles at which its branch changes, ascending [deg]
    stated: float  # Crank angle at which, or just after which, it is on its own branch [deg]
    period: float = math.inf  # Crank angle after which everything repeats, if the crank turns fully [deg]
    bridges: tuple[ChangePointFit, ...] = ()

    def within(self, degrees: Array) -> Array:
        """Return crank angles within the period."""
        outside = (degrees < 0.0) | (degrees > self.period)
        return np.where(outside, np.mod(degrees, self.period), degrees) if math.isfinite(self.period) else degrees

    def signs(self, degrees: Array) -> Array:
        """Return 1 where the dyad is on its own branch, -1 where it is on the other."""
        passed = np.searchsorted(self.changes, self.within(degrees), side="left")
        return np.where((passed - np.searchsorted(self.changes, self.stated, side="right")) % 2 == 0, 1.0, -1.0)

    def is_bridged(self, degrees: Array) -> NDArray[np.bool_]:
        """Return where polynomials are used (True)."""
        inside, local = np.zeros(degrees.shape, dtype=bool), self.within(degrees)
        for bridge in self.bridges:
            inside |= np.abs(local - bridge.degrees) <= bridge.width
        return inside
