"""Velocities and accelerations of a linkage at one crank angle as vectors from a pole and between points."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Literal, NamedTuple

import numpy as np

from crankwork.analysis.results import Results
from crankwork.analysis.sampled_motion import SampledMotion, Track, reached_angles
from crankwork.analysis.skeleton import Skeleton, skeleton
from crankwork.kinematics.crank_grid import Array
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import Mechanism

# between the positions of a linkage [deg]
POSITION_STEP = 30.0
_FINEST, _COARSEST = 15.0, 90.0
# columns without a value at many positions
_IN_PLACES = ("instant_centre_", "instantaneous_efficiency")
_TURNING = "link_angular_velocity."
# share of its largest angular velocity at which a link is too slow to be read on a plan
_SLOW = 0.1
Kind = Literal["absolute", "relative", "normal", "tangential", "coriolis", "sliding"]


class Vector(NamedTuple):
    """A vector of a plan: name of its points, its kind, where it starts and ends in the plan."""

    name: str
    kind: Kind
    start: Array
    end: Array

    @property
    def length(self) -> float:
        """Its magnitude."""
        return float(np.hypot(*(self.end - self.start)))


class VectorPolygon(NamedTuple):
    """A vector polygon: ends of the vectors from the pole by name of the point, the vectors, turning of the links.

    Vectors in m/s or m/s2, turning in rad/s or rad/s2 by number of the link, positive anticlockwise; `coincident`
    holds the link and the sliding point of each point of a link that coincides with a sliding one.
    """

    nodes: dict[str, Array]
    vectors: list[Vector]
    turning: dict[int, float]
    coincident: dict[str, tuple[int, str]]


class _State(NamedTuple):
    """Position, velocity and acceleration, shape (2,)."""

    place: Array
    velocity: Array
    acceleration: Array


class DriverRates(NamedTuple):
    """Rate and second rate of the driver's coordinate, shape (n,). [rad/s] or [m/s], and these over s"""

    first: Array
    second: Array


def position_step(machine: Machine) -> float:
    """Return the step of the positions of a linkage: that of its tables where plans can have it, else 30. [deg]"""
    step = machine.table_step
    return step if _FINEST <= step <= _COARSEST and not machine.cycle % step else POSITION_STEP


def positions(machine: Machine) -> Array:
    """Return the positions of a linkage as far as it reaches them. [deg]"""
    (reached, _), step = reached_angles(machine, 1.0), position_step(machine)
    angles = np.arange(0.0, machine.cycle + step, step)
    inside = angles[(angles >= reached[0]) & (angles <= reached[-1])]
    # a linkage that reaches none of these angles is shown at angles of its range
    return inside if inside.size else reached[::5]


def worked_position(results: Results) -> float:
    """Return the position of the worked example, at which plans are drawn. [deg]

    With loads, that of the largest torque at which every link turns; with a law, one at which the driver
    moves, and if possible accelerates; else the first after the start at which every link turns, if there is one.
    """
    machine = results.machine
    angles = positions(machine)
    if results.period:
        rates = driver_rates(results, results.columns_at(angles))
        both = np.abs(rates.first * rates.second)
        return float(angles[np.argmax(both if np.any(both) else np.abs(rates.first))])
    if "static_torque" in results.columns and (machine.loads or machine.chambers):
        columns = results.columns_at(angles)
        # in a change point forces may not be determined
        known = np.all([np.isfinite(value) for key, value in columns.items() if not key.startswith(_IN_PLACES)], axis=0)
        turning = [np.abs(value) for key, value in columns.items() if key.startswith(_TURNING)]
        # the lines of a link that hardly turns lie on each other
        is_slow = np.any([item < _SLOW * np.max(item) for item in turning], axis=0)
        worth = np.where(known, np.abs(columns["static_torque"]), -1.0)
        return float(angles[np.argmax(np.where(is_slow, worth - worth.max(), worth))])
    moving = [np.abs(value) for key, value in results.columns_at(angles).items() if key.startswith(_TURNING)]
    # a link that never turns has rates of rounding alone
    least = 1e-9 * max((float(np.max(item)) for item in moving), default=0.0)
    is_slow = np.any([item < _SLOW * np.max(item) for item in moving if np.max(item) > least], axis=0)
    ahead = angles - POSITION_STEP
    return float(angles[np.argmin(np.abs(ahead) + machine.cycle * (2.0 * is_slow + (ahead < -1e-9)))])


def driver_rates(results: Results, known: Mapping[str, Array]) -> DriverRates:
    """Return the rates of the driver: those of a crank that turns evenly, or the columns of a law."""
    driver = results.machine.mechanism.driver
    if driver.law is not None:
        keys = (
            ("driver_speed", "driver_angular_acceleration")
            if driver.turns
            else ("driver_velocity", "driver_acceleration")
        )
        return DriverRates(*(known[key] for key in keys))
    count = len(next(iter(known.values())))
    w: float = results.solved.speed
    return DriverRates(np.full(count, w), np.full(count, results.machine.angular_acceleration))


def velocities(
    mechanism: Mechanism, moving: SampledMotion, index: int, speed: float, links: tuple[str, ...] = ()
) -> VectorPolygon:
    """Return the velocity plan of a linkage at one crank angle. [m/s]

    v_A from the pole for every point, v_BA between points of one link, v_AA2 of a point along a slot of link 2
    against the point A2 of that link underneath.
    """
    states = _States(skeleton(mechanism, links), moving, index, speed, 0.0)
    plan = VectorPolygon({}, [], states.turnings(0), {})
    zero = np.zeros(2)
    for name, state in states.moving_points():
        plan.nodes[states.letter(name)] = state.velocity
        plan.vectors.append(Vector(states.letter(name), "absolute", zero, state.velocity))
    for base, end, _ in states.pairs():
        start, stop = states.point(base).velocity, states.point(end).velocity
        plan.vectors.append(Vector(states.letter(end) + states.letter(base), "relative", start, stop))
    for letter, under, piece, coincident, link in states.slides():
        plan.nodes.setdefault(letter, piece.velocity)
        plan.coincident[under] = (states.shape.member(link).number, letter)
        plan.nodes[under] = coincident.velocity
        plan.vectors.append(Vector(under, "absolute", zero, coincident.velocity))
        plan.vectors.append(Vector(letter + under, "sliding", coincident.velocity, piece.velocity))
    return plan


def accelerations(
    mechanism: Mechanism,
    moving: SampledMotion,
    index: int,
    speed: float,
    angular_acceleration: float = 0.0,
    links: tuple[str, ...] = (),
) -> VectorPolygon:
    """Return the acceleration plan of a linkage at one crank angle. [m/s2]

    a_A from the pole for every point; a_BA between points of one link as its normal and tangential parts; along a
    slot of link 2 the Coriolis and the sliding part from A2 to A.
    """
    states = _States(skeleton(mechanism, links), moving, index, speed, angular_acceleration)
    plan = VectorPolygon({}, [], states.turnings(1), {})
    zero = np.zeros(2)
    for name, state in states.moving_points():
        plan.nodes[states.letter(name)] = state.acceleration
        plan.vectors.append(Vector(states.letter(name), "absolute", zero, state.acceleration))
    for base, end, rate in states.pairs(with_fixed=True):
        start, stop = states.point(base), states.point(end)
        middle = start.acceleration - rate**2 * (stop.place - start.place)
        name = states.letter(end) + states.letter(base)
        plan.vectors.append(Vector(name, "normal", start.acceleration, middle))
        plan.vectors.append(Vector(name, "tangential", middle, stop.acceleration))
    for letter, under, piece, coincident, link in states.slides():
        plan.nodes.setdefault(letter, piece.acceleration)
        plan.coincident[under] = (states.shape.member(link).number, letter)
        plan.nodes[under] = coincident.acceleration
        plan.vectors.append(Vector(under, "absolute", zero, coincident.acceleration))
        x, y = piece.velocity - coincident.velocity
        middle = coincident.acceleration + 2 * states.turning(link)[0] * np.array([-y, x])
        plan.vectors.append(Vector(letter + under, "coriolis", coincident.acceleration, middle))
        plan.vectors.append(Vector(letter + under, "sliding", middle, piece.acceleration))
    return plan


class _Sliding(NamedTuple):
    """A point that slides on a link: its letter, that of the point underneath, the states of both, the link."""

    letter: str
    under: str
    piece: _State
    coincident: _State
    link: str


class _States:
    """Places, velocities and accelerations of the points of a linkage at one crank angle."""

    def __init__(self, shape: Skeleton, moving: SampledMotion, index: int, speed: float, second: float) -> None:
        self.shape, self._moving, self._index = shape, moving, index
        self._speed, self._second = speed, second

    def letter(self, name: str) -> str:
        return self.shape.letters[name]

    def _state(self, track: Track) -> _State:
        place, first, second = (item[self._index] for item in track)
        return _State(place, first * self._speed, second * self._speed**2 + first * self._second)

    def point(self, name: str) -> _State:
        if name in self.shape.pivots:
            return _State(np.array(self.shape.pivots[name]), np.zeros(2), np.zeros(2))
        return self._state(self._moving.points[name])

    def moving_points(self) -> Iterator[tuple[str, _State]]:
        for name in self.shape.letters:
            if name not in self.shape.pivots and name in self._moving.points:
                yield name, self.point(name)

    def pairs(self, *, with_fixed: bool = False) -> Iterator[tuple[str, str, float]]:
        """Yield pairs of points of one link, its first and each further one that moves, and how fast it turns."""
        for member in self.shape.members:
            if member.rod:
                continue
            points = [name for name in member.points if with_fixed or name not in self.shape.pivots]
            points.sort(key=lambda name: name not in self.shape.pivots)
            for end in points[1:]:
                if end not in self.shape.pivots:
                    yield points[0], end, self.turning(member.name)[0]

    def turning(self, link: str) -> tuple[float, float]:
        """Return how fast a link turns, and how fast that grows. [rad/s], [rad/s2]"""
        frame = self._moving.frames[link]
        first, second = float(frame.angle_1[self._index]), float(frame.angle_2[self._index])
        return first * self._speed, second * self._speed**2 + first * self._second

    def turnings(self, order: int) -> dict[int, float]:
        """Return how fast links turn, or how fast that grows, by number; a rod turns with its barrel."""
        values = {member.number: self.turning(member.name)[order] for member in self.shape.members}
        return values | {member.rod: values[member.number] for member in self.shape.members if member.rod}

    def slides(self) -> Iterator[_Sliding]:
        """Yield the points that slide on a moving guide; the rod of a cylinder slides on its barrel."""
        for member in self.shape.members:
            if member.rod:
                barrel, end = member.points[0], self.point(member.points[1])
                rod = self.letter(member.points[1])
                coincident = self._carried(member.name, self.point(barrel), end.place)
                yield _Sliding(rod, f"{rod}{member.number}", end, coincident, member.name)
            if member.guide and member.guide.link:
                piece = (
                    self.point(member.points[0])
                    if member.points
                    else self._state(self._moving.frames[member.name].origin)
                )
                letter = self.letter(member.points[0]) if member.points else member.name
                under = f"{letter}{self.shape.member(member.guide.link).number}"
                yield _Sliding(letter, under, piece, self._on_link(member.guide.link, piece.place), member.guide.link)

    def _on_link(self, link: str, place: Array) -> _State:
        """Return the state of the point of a link at a place."""
        return self._carried(link, self._state(self._moving.frames[link].origin), place)

    def _carried(self, link: str, origin: _State, place: Array) -> _State:
        """Return the state of the point of a link at a place, from the state of another point."""
        rate, rate_1 = self.turning(link)
        x, y = place - origin.place
        across, along = np.array([-y, x]), np.array([x, y])
        return _State(place, origin.velocity + rate * across, origin.acceleration + rate_1 * across - rate**2 * along)
