"""The motion of the bodies of a mechanism: centre of mass and rotation."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from crankwork.errors import GeometryError
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.motion import Motion
from crankwork.kinematics.transfer import PointMotion, Transfer
from crankwork.mechanism.mechanism import Body, Mechanism


class BodyMotion(NamedTuple):
    """A moving mass: its centre [m] and its rates of turning [-], arrays of shape (n,); `body` says how heavy."""

    body: Body
    centre: PointMotion
    angle_1: Array
    angle_2: Array


def body_motions(mechanism: Mechanism, motion: Motion) -> tuple[BodyMotion, ...]:
    """Return the motion of every body of a mechanism.

    Parameters
    ----------
    mechanism : Mechanism
        Whose bodies they are.
    motion : Motion
        How it moves.

    Returns
    -------
    tuple of BodyMotion, arrays of shape (n,)
        Centres of mass with first and second transfer functions [m], first and second rate of turning [-].

    Raises
    ------
    GeometryError
        If a body has a moment of inertia and nothing says how it turns.
    """
    return tuple(BodyMotion(body, centre_of_mass(body, motion), *_rates(body, motion)) for body in mechanism.bodies)


def centre_of_mass(body: Body, motion: Motion) -> PointMotion:
    """Return the motion of the centre of mass of a body, on the line between two points.

    Parameters
    ----------
    body : Body
        The body.
    motion : Motion
        Where its points are.

    Returns
    -------
    PointMotion, arrays of shape (n,)
        Position, first and second transfer function. [m]
    """
    start, end = motion.points[body.start], motion.points[body.end]
    if body.start == body.end or body.share == 0:
        return start
    x, y = (
        Transfer(*(one + body.share * (other - one) for one, other in zip(mine, its, strict=True)))
        for mine, its in zip(start, end, strict=True)
    )
    return PointMotion(x, y)


def _rates(body: Body, motion: Motion) -> tuple[Array, Array]:
    still = np.zeros_like(motion.grid.angle)
    if body.link in motion.frames:
        frame = motion.frames[body.link]
        return frame.angle_1 + still, frame.angle_2 + still
    if body.link in motion.links:
        _, angle_1, angle_2 = motion.links[body.link]
        return angle_1 + still, angle_2 + still
    if body.inertia:
        raise GeometryError(
            f"body {body.link} has a moment of inertia, but the motion does not say how it turns; "
            "add its rotation, or set its inertia to zero if it only slides"
        )
    return still, still
