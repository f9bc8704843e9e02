"""The motion of a mechanism: positions and transfer functions of its points, links and sliders."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import GeometryError
from crankwork.formula.expression import Value
from crankwork.formula.traced_value import absent, is_traced, total
from crankwork.kinematics.chain_solver import ChainPath
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.dyads import LinkMotion
from crankwork.kinematics.kinematic_coefficients import PointMotion, Transfer
from crankwork.kinematics.motion_laws import law_at
from crankwork.kinematics.position_analysis import assembled
from crankwork.mechanism.equal_parts import EqualPart
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


Status = NDArray[np.int8]


@dataclass(frozen=True)
class Motion:
    """Position, first and second transfer function of everything that moves."""

    grid: CrankGrid  # Crank angles, shape (n,) [rad]
    points: Mapping[str, PointMotion]  # Coordinates of the named points, arrays of shape (n,) [m]
    # Direction of each link that does not slide from the x axis, arrays of shape (n,) [rad]
    links: Mapping[str, Transfer]
    sliders: Mapping[str, Transfer]  # Distance of each slider along its guide, arrays of shape (n,) [m]
    # Links and sliding pieces as frames, with origin and direction; empty where the motion comes from a table
    frames: Mapping[str, LinkMotion] = field(default_factory=dict)
    # Lines between the joints of those links of dyads whose frames they are not
    bars: Mapping[str, LinkMotion] = field(default_factory=dict)
    # Coordinate of the driver, its rate and second rate, where a law moves it; columns or traced values
    driver: Transfer | None = None
    # Parts whose traced motion is that of earlier ones
    equal_parts: tuple[EqualPart, ...] = ()

    def bar(self, link: str) -> LinkMotion:
        """Return the line from the joint of a link of a dyad that was known first to its other one, as a frame."""
        return self.bars.get(link, self.frames[link])


class Directions(Mapping[str, Transfer]):
    """Directions of links as angles, worked out when asked for: an arc tangent costs as much as half a dyad."""

    def __init__(self, grid: CrankGrid, frames: Mapping[str, LinkMotion]) -> None:
        self._grid, self._frames = grid, frames
        self._known: dict[str, Transfer] = {}

    def __getitem__(self, name: str) -> Transfer:
        """Return the direction of a link from the x axis, arrays of shape (n,). [rad]"""
        if name not in self._known:
            self._known[name] = direction(self._grid, self._frames[name])
        return self._known[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._frames)

    def __len__(self) -> int:
        return len(self._frames)


def direction(grid: CrankGrid, link: LinkMotion) -> Transfer:
    """Return the direction of a link without jumps by full turns. [rad]

    Angle from the x axis, over -pi and up to pi at the first position, and its derivatives.

    Between neighbours the angle grows by about the mean rate times the step, which gives the number of turns to add.
    """
    still = np.zeros_like(grid.angle)
    # -0 would be -180 degrees where the cosine is negative
    angle, rate = np.arctan2(link.sin + still, link.cos), link.angle_1 + still
    grown = np.diff(grid.angle) * (rate[1:] + rate[:-1]) / 2
    turns = np.nan_to_num(np.rint((grown - np.diff(angle)) / math.tau))
    angle[1:] += math.tau * np.cumsum(turns)
    return Transfer(angle, rate, link.angle_2 + still)


def linkage_motion(mechanism: Mechanism, grid: CrankGrid, *, paths: dict[int, ChainPath] | None = None) -> Motion:
    """Return the exact motion of a mechanism, group after group.

    Positions and transfer functions [m], [rad]. `paths`: see `place_at`.
    """
    placed, halves = assembled(mechanism, grid, paths), {half.link for half in mechanism.halves}

    def transfer(motion: Transfer) -> Transfer:
        return Transfer(*(part if part.ndim else np.broadcast_to(part, grid.angle.shape) for part in motion))

    points = {name: PointMotion(transfer(point.x), transfer(point.y)) for name, point in placed.points.items()}
    sliders = {name: transfer(distance) for name, distance in placed.sliders.items()}
    links = {name: frame for name, frame in placed.links.items() if name not in sliders and name not in halves}
    law = mechanism.driver.law
    driver = None if law is None else law_at(law, grid)
    return Motion(grid, points, Directions(placed.grid, links), sliders, placed.links, placed.bars, driver)
