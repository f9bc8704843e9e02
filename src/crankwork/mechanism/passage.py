"""How a dyad goes on through a change point, in which its two branches meet."""

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
    """A quantity about a crank angle, by Chebyshev polynomials of the distance from it. [deg]"""

    centre: float
    reach: float  # How far from the centre the values lie that it goes through
    coefficients: tuple[float, ...]

    def __call__(self, degrees: Array) -> Array:
        """Return the quantity at crank angles."""
        return np.asarray(chebyshev.chebval((degrees - self.centre) / self.reach, self.coefficients))


@dataclass(frozen=True)
class Bridge:
    """What leads a dyad over a change point: there its own formulas are nought by nought."""

    degrees: float  # Crank angle of the change point
    width: float  # How far on both sides the polynomials are used [deg]
    columns: Mapping[str, Polynomial]  # By the quantity that they replace


@dataclass(frozen=True)
class Passage:
    """A dyad that passes change points, and with each from one of its branches to the other."""

    changes: tuple[float, ...]  # Crank angles at which its branch changes, ascending [deg]
    stated: float  # Crank angle at which it is on the branch that is its own, or just behind which [deg]
    period: float = math.inf  # Crank angle after which everything repeats, of a crank that turns fully [deg]
    bridges: tuple[Bridge, ...] = ()

    def within(self, degrees: Array) -> Array:
        """Return crank angles within the period."""
        outside = (degrees < 0.0) | (degrees > self.period)
        return np.where(outside, np.mod(degrees, self.period), degrees) if math.isfinite(self.period) else degrees

    def signs(self, degrees: Array) -> Array:
        """Return 1 where the dyad is on its own branch, -1 where it is on the other."""
        passed = np.searchsorted(self.changes, self.within(degrees), side="left")
        return np.where((passed - np.searchsorted(self.changes, self.stated, side="right")) % 2 == 0, 1.0, -1.0)

    def is_bridged(self, degrees: Array) -> NDArray[np.bool_]:
        """Return where polynomials are used."""
        inside, local = np.zeros(degrees.shape, dtype=bool), self.within(degrees)
        for bridge in self.bridges:
            inside |= np.abs(local - bridge.degrees) <= bridge.width
        return inside
