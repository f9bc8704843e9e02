"""The motion of the bodies of a mechanism: centre of mass and rotation."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from crankwork.errors import GeometryError
from crankwork.formula.expression import Value
from crankwork.formula.known import absent, is_known, total
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import Motion
from crankwork.kinematics.transfer import PointMotion, Transfer
from crankwork.mechanism.mechanism import Body, Mechanism


class BodyMotion(NamedTuple):
    """A moving mass: its centre [m] and its rates of turning [-], arrays of shape (n,); `body` says how heavy."""

    body: Body
    centre: PointMotion
    angle_1: Value
    angle_2: Value


def body_motions(mechanism: Mechanism, motion: Motion) -> tuple[BodyMotion, ...]:
    """Return centres of mass with first and second transfer functions [m], and the rates of turning, of every body."""
    return tuple(BodyMotion(body, centre_of_mass(body, motion), *_rates(body, motion)) for body in mechanism.bodies)


def centre_of_mass(body: Body, motion: Motion) -> PointMotion:
    """Return the motion of the centre of mass of a body, on the line between two points. [m]

    Position, first and second transfer function.
    """
    start, end = motion.points[body.start], motion.points[body.end]
    if body.start == body.end or body.share == 0:
        return start
    x, y = (
        Transfer(*(one + body.share * (other - one) for one, other in zip(mine, its, strict=True)))
        for mine, its in zip(start, end, strict=True)
    )
    return PointMotion(x, y)


def _rates(body: Body, motion: Motion) -> tuple[Value, Value]:
    if body.link in motion.frames:
        frame = motion.frames[body.link]
        return everywhere(frame.angle_1, motion.grid), everywhere(frame.angle_2, motion.grid)
    if body.link in motion.links:
        _, angle_1, angle_2 = motion.links[body.link]
        return everywhere(angle_1, motion.grid), everywhere(angle_2, motion.grid)
    if body.inertia:
        raise GeometryError(
            f"body {body.link} has a moment of inertia, but the motion does not say how it turns; "
            "add its rotation, or set its inertia to zero if it only slides"
        )
    return nothing(motion.grid), nothing(motion.grid)


def nothing(grid: CrankGrid) -> Value:
    """Return zero at every crank angle, or an absent value where columns are remembered."""
    return absent("") if is_known(grid.angle) else np.zeros_like(grid.angle)


def everywhere(value: Value, grid: CrankGrid) -> Value:
    """Return a value at every crank angle; a known is that already."""
    return value if is_known(value, grid.angle) else value + np.zeros_like(grid.angle)


def summed(key: str, terms: Iterable[Value], grid: CrankGrid) -> Value:
    """Return the sum of columns in their order; of none, nothing."""
    if not is_known(grid.angle):
        return sum(terms, np.zeros_like(grid.angle))
    stated = [one for one in terms if not (is_known(one) and one.is_absent)]
    return total(key, stated) if stated else absent(key)
