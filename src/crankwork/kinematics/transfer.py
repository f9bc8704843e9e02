"""Coordinates and their derivatives by the crank angle."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.kinematics.crank_grid import Array


class Transfer(NamedTuple):
    """A coordinate and its first and second derivative by the crank angle, arrays of shape (n,)."""

    position: Array
    position_1: Array
    position_2: Array


class PointMotion(NamedTuple):
    """The two coordinates of a point. [m]"""

    x: Transfer
    y: Transfer
