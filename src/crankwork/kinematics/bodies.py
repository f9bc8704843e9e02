"""The motion of the bodies of a mechanism: centre of mass and rotation."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from crankwork.errors import GeometryError
from crankwork.formula.expression import Value
from crankwork.formula.traced_value import absent, is_traced, total
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.kinematic_coefficients import PointMotion, Transfer
from crankwork.kinematics.motion import Motion
from crankwork.mechanism.mechanism import Body, Mechanism


class BodyMotion(NamedTuple):
    """The motion of a body: its centre of mass [m] and its rates of rotation [-], arrays of shape (n,)."""

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
        Transfer(*(a + body.share * (b - a) for a, b in zip(at_start, at_end, strict=True)))
        for at_start, at_end in zip(start, end, strict=True)
    )
    return PointMotion(x, y)


def _rates(body: Body, motion: Motion) -> tuple[Value, Value]:
    if body.link in motion.frames:
        frame = motion.frames[body.link]
        return broadcast(frame.angle_1, motion.grid), broadcast(frame.angle_2, motion.grid)
    if body.link in motion.links:
        _, angle_1, angle_2 = motion.links[body.link]
        return broadcast(angle_1, motion.grid), broadcast(angle_2, motion.grid)
    if body.inertia:
        raise GeometryError(
            f"body {body.link} has a moment of inertia, but the motion does not say how it turns; "
            "add its rotation, or set its inertia to zero if it only slides"
        )
    return zero_column(motion.grid), zero_column(motion.grid)


def zero_column(grid: CrankGrid) -> Value:
    """Return a column of zeros, an absent value for a traced motion."""
    return absent("") if is_traced(grid.angle) else np.zeros_like(grid.angle)


def broadcast(value: Value, grid: CrankGrid) -> Value:
    """Return a value as a column over the crank angle; traced values stay as they are."""
    return value if is_traced(value, grid.angle) else value + np.zeros_like(grid.angle)


def sum_columns(key: str, terms: Iterable[Value], grid: CrankGrid) -> Value:
    """Return the sum of columns in their order, zero for no columns."""
    if not is_traced(grid.angle):
        return sum(terms, np.zeros_like(grid.angle))
    stated = [term for term in terms if not (is_traced(term) and term.is_absent)]
    return total(key, stated) if stated else absent(key)
