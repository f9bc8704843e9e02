"""How a result is made: exactly, as a series, or the textbook way. A method is data."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal, Self

from crankwork.errors import MethodError
from crankwork.locale import ErrorMessage

STANDARD_GRAVITY = 9.80665
MAX_SERIES_ORDER = 200

RodModel = Literal["rigid", "two-mass"]


@dataclass(frozen=True)
class Method:
    """How motion and forces are computed.

    Parameters
    ----------
    kinematics : {"exact", "series", "textbook"}
        Closed form; Fourier series in multiples of the crank angle; the first two terms of the binomial.
    order : int
        Highest harmonic of the series, 0 otherwise.
    rod : {"rigid", "two-mass"}
        Rigid rod, or two masses at its pins without the correction couple.
    pi, gravity : float
        The constants the calculation uses, so that a printed document can be reproduced. [-], [m/s2]
    inertia_rod_ratio : float or None
        Crank-to-rod ratio used for the inertia force alone, where a document mixes two. [-]
    """

    kinematics: Literal["exact", "series", "textbook"] = "exact"
    order: int = 0
    rod: RodModel = "rigid"
    pi: float = math.pi
    gravity: float = STANDARD_GRAVITY
    inertia_rod_ratio: float | None = None

    @property
    def name(self) -> str:
        """Name of the kinematics, that of a series with its order."""
        return f"series:{self.order}" if self.kinematics == "series" else self.kinematics

    @property
    def is_exact(self) -> bool:
        """Whether the motion is the closed form."""
        return self.kinematics == "exact"

    def named(self, name: str) -> Self:
        """Return this method with the kinematics, and the rod that goes with them, of another name.

        Raises
        ------
        MethodError
            If `name` is none of `exact`, `textbook`, `series:N` with N from 1 to 200.
        """
        kind, _, order = name.partition(":")
        if (
            kind == "series"
            and order.isascii()
            and order.isdecimal()
            and len(order) < 5
            and 1 <= int(order) <= MAX_SERIES_ORDER
        ):
            return replace(self, kinematics="series", order=int(order), rod="two-mass")
        if name == "exact":
            return replace(self, kinematics="exact", order=0, rod="rigid")
        if name == "textbook":
            return replace(self, kinematics="textbook", order=0, rod="two-mass")
        raise MethodError(ErrorMessage("method_unknown", name=name[:40], most=MAX_SERIES_ORDER))


EXACT = Method()
TEXTBOOK = Method(kinematics="textbook", rod="two-mass")
