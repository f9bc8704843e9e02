"""Positions of a linkage over the crank angle, as plain arrays: the data of plans and drawings."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.analysis.motion_range import find_reachable_motion, open_range
from crankwork.analysis.results import Results
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.crank_range import pass_change_points
from crankwork.kinematics.kinematic_coefficients import PointMotion
from crankwork.kinematics.motion import linkage_motion
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import Mechanism

_MOST_FRAMES = 600


class Track(NamedTuple):
    """Places of a point and their first and second derivative by the crank angle, arrays of shape (n, 2). [m]"""

    place: Array
    place_1: Array
    place_2: Array


class Frame(NamedTuple):
    """A link that moves: its origin, the direction of its x axis, shape (n, 2), and the derivatives of its angle."""

    origin: Track
    along: Array
    angle_1: Array
    angle_2: Array


class SampledMotion(NamedTuple):
    """A linkage at crank angles."""

    degrees: Array  # Crank angles, shape (n,) [deg]
    points: Mapping[str, Track]  # Points by name [m]
    frames: Mapping[str, Frame]  # Links and sliding pieces by name
    sliders: Mapping[str, Array]  # Distance of each slider along its guide, shape (n,) [m]


def sample_motion(mechanism: Mechanism, degrees: ArrayLike) -> SampledMotion:
    """Return a linkage at crank angles."""
    result = linkage_motion(mechanism, CrankGrid.from_degrees(degrees))
    count = len(result.grid)

    def stacked(pair: Iterable[Array]) -> Array:
        return np.column_stack([np.broadcast_to(item, count) for item in pair])

    def track(point: PointMotion) -> Track:
        return Track(*(stacked(pair) for pair in zip(*point, strict=True)))

    frames = {
        name: Frame(
            track(value.origin),
            stacked((value.cos, value.sin)),
            np.broadcast_to(value.angle_1, count),
            np.broadcast_to(value.angle_2, count),
        )
        for name, value in result.frames.items()
    }
    points = {name: track(value) for name, value in result.points.items()}
    sliders = {name: np.broadcast_to(value.position, count) for name, value in result.sliders.items()}
    return SampledMotion(result.grid.degrees, points, frames, sliders)


def transfer_ratios(mechanism: Mechanism, degrees: ArrayLike) -> dict[str, Array]:
    """Return velocities of points and sliders and angular velocities of links, over that of the crank.

    `velocity_ratio.NAME` of points, `rotation_ratio.NAME` of links, `velocity_ratio.NAME` of sliders [m], [-].
    """
    values = linkage_motion(mechanism, CrankGrid.from_degrees(degrees))
    points = {name: np.hypot(x.position_1, y.position_1) for name, (x, y) in values.points.items()}
    ratios = {f"velocity_ratio.{name}": value for name, value in points.items() if name not in mechanism.ground}
    links = {name: value.position_1 for name, value in values.links.items() if name != mechanism.crank.link}
    ratios |= {f"rotation_ratio.{name}": value for name, value in links.items()}
    return ratios | {f"velocity_ratio.{name}": value.position_1 for name, value in values.sliders.items()}


def reached_angles(machine: Machine, step: float) -> tuple[Array, bool]:
    """Return crank angles of a cycle as far as a linkage reaches them [deg], and whether it reaches all.

    `step`: step [deg].
    """
    result = find_reachable_motion(machine, step)
    return result.grid.degrees, result.travel is None


class AnimationPath(NamedTuple):
    """Crank angles of a moving drawing at equal times, the last that of the first [deg], and the mechanism drawn."""

    degrees: Array
    mechanism: Mechanism
    turns: bool  # Whether the crank turns fully; it goes to and fro otherwise
    own_time: float = 0.0  # How long what is drawn takes, of a machine let go [s]


def animation_path(mechanism: Mechanism, frames: int) -> AnimationPath:
    """Return how the crank of a moving drawing goes: round, or to and fro between its dead positions."""
    mechanism, result = pass_change_points(mechanism)
    if result is None or result.is_whole:
        return AnimationPath(np.arange(frames + 1) * mechanism.period / frames, mechanism, turns=True)
    low, high = open_range(result)
    swung = (1 - np.cos(math.tau * np.arange(frames + 1) / frames)) / 2
    return AnimationPath(low + (high - low) * swung, mechanism, turns=False)


def transient_animation_path(results: Results) -> AnimationPath | None:
    """Return the crank angles of a transient motion at equal times; None if its dyads change their branches."""
    ran = results.listings.get("transient")
    happened = results.listings.get("transient_events", ran)
    if ran is None or happened is None or any(name.startswith("dead_position") for name in happened.names):
        return None
    time, angle = ran.columns["time"], ran.columns["crank_angle"]
    # the last interval of time may be shorter
    rows = np.arange(0, len(time) - (len(time) > 2), math.ceil(len(time) / _MOST_FRAMES))
    return AnimationPath(np.degrees(angle[rows]), results.machine.mechanism, turns=True, own_time=float(time[rows[-1]]))
