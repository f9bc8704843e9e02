"""Coordinates and their derivatives by the crank angle."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.formula.expression import Value


class Transfer(NamedTuple):
    """A coordinate and its first and second derivative by the crank angle, arrays of shape (n,) or knowns."""

    position: Value
    position_1: Value
    position_2: Value


class PointMotion(NamedTuple):
    """The two coordinates of a point. [m]"""

    x: Transfer
    y: Transfer
