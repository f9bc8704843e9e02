"""A machine let go: the motion of one coordinate in time, J q'' + J' q'^2 / 2 = Q, from event to event."""

from __future__ import annotations

import bisect
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from crankwork.dynamics.friction import FrictionJoint, PinFriction
from crankwork.kinematics.crank_grid import Array
from crankwork.shaft.fluctuation import acceleration_of_crank
from crankwork.shaft.gauss_step import POINTS, Step, gauss_step
from crankwork.shaft.motor import Motor
from crankwork.shaft.piecewise_fit import PiecewiseFit

Direction = Literal[1, -1]
EventKind = Literal[
    "turns_back", "comes_to_rest", "stop", "reaches_speed", "dead_position", "change_point", "end_of_way",
    "steady", "never_steady", "slowly_steady", "interrupted", "many_steps", "lost",
]  # fmt: skip

# rows of the quantities of a machine that are its own, and which of them is the rate of the crank
OWN, RATE = 8, 5
TAIL = 1e-12
SHARE = 1e-10
GROWTH = 2.0
SHORTEST = 1e-13
_LANDINGS = 8
_LANDED = 1e-15
MOST_STEPS = 10_000
AT_END = 1e-13
_MOMENT = 1e-12
# of the largest moment of inertia, one with which the crank would run away
LIGHT = 1e-6
# of the largest speed, what counts as standing after a stop
_STILL = 1e-6
# of the rate that a machine could come to, below which steps are not told apart; and of its forces, what is rounding
_SLOW, _NO_FORCE = 1e-3, 1e-13


class Event(NamedTuple):
    """Something that happens: when, what, where and how fast. [s], [unit of the coordinate]"""

    time: float
    word: EventKind
    coordinate: float
    rate: float


@dataclass(frozen=True)
class TransientSystem:
    """A machine as its coordinate feels it."""

    # Over the coordinate: inertia, potential energy, what loads without one push while it grows and while it falls,
    # damping, the derivative of the crank angle by it, and last the derivatives of inertia and potential energy
    reduced: PiecewiseFit
    # Coordinates at which a law of the loads changes, ascending, first and last those of the period or range
    breaks: tuple[float, ...]
    torque: float = 0.0  # Constant torque on the crank [N m]
    motor: Motor | None = None
    dead: frozenset[float] = frozenset()  # Those of the breaks at which the crank turns back
    changes: tuple[float, ...] = ()  # Those of change points
    # Coordinates at which it is stopped, and what part of its speed it then gets back [-]
    stops: tuple[float, float] = (-math.inf, math.inf)
    restitution: float = 0.0
    slipping: TransientFriction | None = None  # Joints with friction, whose rows follow
    _known: dict[tuple[float, float], Array] = field(default_factory=dict, repr=False, compare=False)

    @property
    def period(self) -> float:
        """After which all repeats. [unit of the coordinate]"""
        return self.reduced.period

    @property
    def size(self) -> float:
        """Its period or range. [unit of the coordinate]"""
        return self.breaks[-1] - self.breaks[0]

    @cached_property
    def natural_rate(self) -> float:
        """The rate that its loads and its driver could give it over its period or range."""
        J, V, grows, falls = self.reduced.powers[:, :4, 0].T
        forces = np.max(np.abs(grows)) + np.max(np.abs(falls)) + abs(float(self.drive(np.zeros(1))[0]))
        return float(np.sqrt(2 * (np.ptp(V) + forces * self.size) / np.mean(J)))

    def drive(self, speed: Array) -> Array:
        """Return the torque that drives the crank, at its speeds. [N m]"""
        own = np.full_like(speed, self.torque)
        return own if self.motor is None else own + self.motor.torque(speed)

    def acceleration(
        self, q: Array, v: Array, direction: Direction, low: float = -math.inf, high: float = math.inf
    ) -> Array:
        """Return the acceleration of the coordinate for one direction, on an interval between breakpoints."""
        rows = self.reduced(q, low, high)
        J, _, grows, falls, damping, rate, J_1, V_1 = rows[:OWN]
        torque = (grows if direction > 0 else falls) - V_1 - damping * v + self.drive(rate * v) * rate
        if self.slipping is not None:
            free = FrictionState(v, acceleration_of_crank(torque, v, J, J_1), J)
            frictions = self.slipping.frictions(rows, direction, self._senses(low, high), free)
            torque = torque + np.sum(self.slipping.rates(rows) * frictions, axis=0)
        return np.asarray(acceleration_of_crank(torque, v, J, J_1))

    def _senses(self, low: float, high: float) -> Array:
        """Return the signs of the relative rates on a stretch, on which none of them changes."""
        if self.slipping is None:
            return np.empty(0)
        if (low, high) not in self._known:
            middle = (low + high) / 2 if math.isfinite(low + high) else (self.breaks[0] + self.breaks[-1]) / 2
            self._known[low, high] = self.slipping.senses(self.reduced(np.array([middle])))
        return self._known[low, high]

    def placed(self, q: float, direction: Direction) -> float:
        """Return a coordinate moved into the first period, together with the interval ahead of it."""
        if math.isinf(self.period):
            return q
        if direction < 0 and q <= self.breaks[0]:
            return q + self.period
        return q - self.period if direction > 0 and q >= self.breaks[-1] else q

    def stretch(self, q: float, direction: Direction) -> tuple[float, float]:
        """Return the ends of the stretch between breaks that lies ahead, infinite where there are none."""
        ends = self.breaks
        if len(ends) == 2 and math.isfinite(self.period):
            return -math.inf, math.inf
        k = (bisect.bisect_right(ends, q) if direction > 0 else bisect.bisect_left(ends, q)) - 1
        k = min(max(k, 0), len(ends) - 2)
        return ends[k], ends[k + 1]


@dataclass
class Trajectory:
    """Steps of a motion with the whole periods before each of them, and its events."""

    steps: list[Step] = field(default_factory=list)
    turned: list[float] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)

    @property
    def end(self) -> float:
        """When it ends. [s]"""
        return self.steps[-1].time + self.steps[-1].length

    def at(self, times: Array) -> tuple[Array, Array, Array]:
        """Return coordinate, rate and acceleration at some times."""
        times = np.asarray(times, dtype=float)
        starts = np.array([step.time for step in self.steps])
        which = np.clip(np.searchsorted(starts, times, side="right") - 1, 0, len(starts) - 1)
        result = np.empty((3, *times.shape))
        for k in np.unique(which):
            rows = which == k
            q, v, a = self.steps[k].at(times[rows])
            result[:, rows] = q + self.turned[k], v, a
        return result[0], result[1], result[2]


class _Stretch(NamedTuple):
    """Coordinates between which one law holds."""

    low: float
    high: float


class Integrator:
    """One motion, from a coordinate and a rate."""

    def __init__(self, machine: TransientSystem, coordinate: float, rate: float) -> None:
        self.machine, self.trajectory = machine, Trajectory()
        self.time, self.q, self.v, self.base = 0.0, coordinate, rate, 0.0
        self.direction: Direction = 1 if rate >= 0 else -1
        self.largest = max(abs(rate), _SLOW * machine.natural_rate)
        self.before: Step | None = None  # The step before under the same law
        self.is_over = self.is_lost = False
        self.end = math.inf
        self._wrap()
        low, high = machine.stops
        if (rate > 0 and coordinate >= high) or (rate < 0 and coordinate <= low):
            self._stopped(self.direction)
        elif rate == 0 and not low < coordinate < high:
            self._lean(1 if coordinate >= high else -1)
        elif rate == 0:
            self._set_off()
        self.stretch = self._stretch_at()

    def until(
        self, end: float, *, watched: Sequence[float] = (), each: Callable[[Integrator], bool] | None = None
    ) -> Trajectory:
        """Go on to a time, or until `each`, asked after every step, says that it is enough. [s]

        `watched`: speeds of the crank whose passing is told [rad/s].
        """
        length, tried, self.end = end / 100, 0, end
        try:
            while self.time < end * (1 - AT_END) and not (self.is_over or self.is_lost):
                tried += 1
                if tried >= 3 * MOST_STEPS or len(self.trajectory.steps) >= MOST_STEPS:
                    self.record_event("many_steps")
                    return self.trajectory
                length = self._advance(min(length, end - self.time), watched)
                if each is not None and each(self):
                    break
        except KeyboardInterrupt:
            self.record_event("interrupted")
            return self.trajectory
        if self.is_over and self.time < end:
            # who asks for no more than the first rest sees a moment of it
            rest = end - self.time if each is None or not each(self) else _MOMENT * end
            self._add(Step(self.time, self.q, 0.0, rest, np.zeros(POINTS)))
        return self.trajectory

    def _advance(self, length: float, watched: Sequence[float]) -> float:
        """Take a step, or find that it has to be shorter; return the length to try next."""
        step = gauss_step(self._law(), self.time, (self.q, self.v), length, self.before)
        if step is None:
            self.before = None
            return self._shorter(length)
        # when the law of the step ends within it, and by what
        cuts = ((time, what) for what, value in self._limits().items() for time in step.crossings(value)[:1])
        cut = min(cuts, default=None)
        if cut is not None:
            time, what = cut
            step = self._landed(time - self.time, what)
            if step is None:
                return self._shorter(length)
        tail = self._tail(step)
        if tail > 1:
            return self._shorter(step.length)
        self._watch(step, watched)
        self._add(step)
        self.before = step
        self.time, (self.q, self.v) = self.time + step.length, step.end
        self.largest = max(self.largest, abs(step.rate), abs(self.v))
        if math.isinf(self.stretch.high):
            self._wrap()
        if cut is not None:
            self.before = None
            self._handle_event(cut[1])
            return length
        return step.length * min(GROWTH, 0.9 * math.pow(max(tail, 1e-30), -1 / POINTS))

    def _law(self) -> Callable[[Array, Array], Array]:
        direction, (low, high) = self.direction, self.stretch
        return lambda q, v: self.machine.acceleration(q, v, direction, low, high)

    def _tail(self, step: Step) -> float:
        """Return the error of a step in units of the tolerance."""
        q, v, share = step.tail
        left = max(q / (TAIL * self.machine.size), v / (TAIL * max(self.largest, abs(step.end[1]), 1e-300)))
        # polynomials of the coordinate end in rounding, and so does the acceleration
        return min(left, share / SHARE)

    def _shorter(self, length: float) -> float:
        if length / 2 <= SHORTEST * max(self.time, 1e-3):
            self.record_event("lost")
            self.is_lost = True
        return length / 2

    def _limits(self) -> dict[str, Callable[[Array, Array], Array]]:
        """Return functions whose change of sign ends the law of the step."""
        low, high = self.stretch
        stop_low, stop_high = (stop - self.base for stop in self.machine.stops)
        limits: dict[str, Callable[[Array, Array], Array]] = {}
        if math.isfinite(high) and self.direction > 0:
            limits["high"] = lambda q, _: q - high
        if math.isfinite(low) and self.direction < 0:
            limits["low"] = lambda q, _: q - low
        if math.isfinite(stop_high):
            limits["stop_high"] = lambda q, _: q - stop_high
        if math.isfinite(stop_low):
            limits["stop_low"] = lambda q, _: q - stop_low
        limits["turn"] = lambda _, v: v
        return limits

    def _landed(self, length: float, what: str) -> Step | None:
        """Return the step that ends where its law does."""
        value = self._limits()[what]
        for _ in range(_LANDINGS):
            step = gauss_step(self._law(), self.time, (self.q, self.v), length)
            if step is None:
                return None
            q, v = step.end
            miss = float(value(np.array(q), np.array(v)))
            rate = float(self._law()(np.array([q]), np.array([v]))[0]) if what == "turn" else v
            if rate == 0 or abs(miss / rate) <= _LANDED * max(self.time, length):
                break
            length -= miss / rate
            if not length > 0:
                return None
        return step

    def _handle_event(self, what: str) -> None:
        """Go over to the law after an event."""
        if what in ("stop_high", "stop_low"):
            self._stopped(1 if what == "stop_high" else -1)
        elif what == "turn":
            self.v = 0.0
            self._set_off("turns_back")
        else:
            self._cross(1 if what == "high" else -1)
            return
        self.stretch = self._stretch_at()

    def _cross(self, side: Direction) -> None:
        """Go over into the next stretch."""
        ends = self.machine.breaks
        end = self.stretch[0 if side < 0 else 1]
        self.q = end
        k = ends.index(end)
        if math.isinf(self.machine.period) and end in (ends[0], ends[-1]):
            self.record_event("end_of_way")
            self.is_lost = True
            return
        if end in self.machine.dead:
            self.record_event("dead_position")
        if math.isfinite(self.machine.period) and end == (ends[-1] if side > 0 else ends[0]):
            self.base += side * self.machine.period
            self.q -= side * self.machine.period
            k = 0 if side > 0 else len(ends) - 1
        low = k if side > 0 else k - 1
        self.stretch = _Stretch(ends[low], ends[low + 1])

    def _stopped(self, side: Direction) -> None:
        self.q = self.machine.stops[max(side, 0)] - self.base
        self.record_event("stop")
        self.v = -self.machine.restitution * self.v
        if abs(self.v) <= _STILL * self.largest:
            self._lean(side)
        else:
            self.direction = 1 if self.v > 0 else -1

    def _lean(self, side: Direction) -> None:
        """Stay at a stop, or leave it if that is where the forces go."""
        self.v = 0.0
        self.direction = 1 if side < 0 else -1
        away = float(self.machine.acceleration(np.array([self.q]), np.zeros(1), self.direction, *self._stretch_at())[0])
        if away * self.direction <= 0:
            self.record_event("comes_to_rest")
            self.is_over = True

    def _set_off(self, word: EventKind | None = None) -> None:
        """Set off from rest in the direction of the forces, if any; `word` is the kind of the event."""
        directions: list[Direction] = [1, -1]
        for direction in directions:
            self.direction = direction
            stretch = self._stretch_at()
            forced = float(self.machine.acceleration(np.array([self.q]), np.zeros(1), direction, *stretch)[0])
            if direction * forced > _NO_FORCE * self.machine.natural_rate**2 / self.machine.size:
                if word is not None:
                    self.record_event(word)
                return
        self.record_event("comes_to_rest")
        self.is_over = True

    def _stretch_at(self) -> _Stretch:
        """Return the stretch between breaks that lies ahead."""
        placed = self.machine.placed(self.q, self.direction)
        self.base, self.q = self.base + self.q - placed, placed
        return _Stretch(*self.machine.stretch(placed, self.direction))

    def _wrap(self) -> None:
        """Bring the coordinate into the first period."""
        if math.isfinite(self.machine.period):
            first = self.machine.breaks[0]
            turns = math.floor((self.q - first) / self.machine.period)
            self.base += turns * self.machine.period
            self.q -= turns * self.machine.period

    def _watch(self, step: Step, watched: Sequence[float]) -> None:
        for rate in watched:
            for time in step.crossings(lambda q, v, rate=rate: self.machine.reduced(q)[RATE] * v - rate):  # type: ignore[misc]
                q, v, _ = step.at(np.array(time))
                self.trajectory.events.append(Event(time, "reaches_speed", float(q) + self.base, float(v)))
        around = (0.0,) if math.isinf(self.machine.period) else (-self.machine.period, 0.0, self.machine.period)
        for place in (change + turn for change in self.machine.changes for turn in around):
            for time in step.crossings(lambda q, _, place=place: q - place):  # type: ignore[misc]
                _, v, _ = step.at(np.array(time))
                self.trajectory.events.append(Event(time, "change_point", place + self.base, float(v)))

    def record_event(self, word: EventKind) -> None:
        """Note that something happens now."""
        self.trajectory.events.append(Event(self.time, word, self.q + self.base, self.v))

    def _add(self, step: Step) -> None:
        self.trajectory.steps.append(step)
        self.trajectory.turned.append(self.base)


# rows of one joint: its rate by the coordinate, then pairs of its two unknowns: constant while it grows and while it
# falls, with the square of the rate, with the rate, with the acceleration
_GROWS, _FALLS, _SQUARE, _RATE, _ACCELERATION, _OWN = 1, 3, 5, 7, 9, 11
_ITERATIONS = 40
_SETTLED = 1e-14
_LOCKED = 1e-9


class FrictionState(NamedTuple):
    """Rate, acceleration without friction and inertia of the coordinate at some places, arrays of shape (n,)."""

    rate: Array
    acceleration: Array
    inertia: Array


@dataclass(frozen=True)
class TransientFriction:
    """Joints with friction, whose rows of a machine's quantities begin at a place."""

    joints: tuple[FrictionJoint, ...]
    first: int

    @property
    def count(self) -> int:
        """Rows of one joint: its own, and two for the effect of the friction of each joint on its unknowns."""
        return _OWN + 2 * len(self.joints)

    def rates(self, rows: Array) -> Array:
        """Return the relative rates of the joints by the coordinate, shape (joints, n)."""
        return rows[self.first : self.first + self.count * len(self.joints) : self.count]

    def frictions(self, rows: Array, direction: int, senses: Array, state: FrictionState) -> Array:
        """Return the friction of each joint on the link that it holds, shape (joints, n). [N m] or [N]

        `rows`: the quantities of the machine, shape (rows, n); `senses`: directions of the relative rates as the
        coordinate grows. NaN where the joints lock.
        """
        blocks = rows[self.first :].reshape(len(self.joints), self.count, -1)
        rates = np.stack([block[0] for block in blocks])
        v, a, J = state
        row = _GROWS if direction > 0 else _FALLS
        # the two unknowns of every joint without friction, and what a unit of each friction adds to them
        free = np.stack(
            [
                block[row : row + 2] + block[_SQUARE : _SQUARE + 2] * v * v + block[_RATE : _RATE + 2] * v
                + block[_ACCELERATION : _ACCELERATION + 2] * a
                for block in blocks
            ]
        )  # fmt: skip
        by_friction = np.stack(
            [
                block[_ACCELERATION : _ACCELERATION + 2, None] * (rates / J)[None]
                + block[_OWN:].reshape(2, len(blocks), -1)
                for block in blocks
            ]
        )
        return self._solved(free, by_friction, -direction * senses[:, None] * np.ones_like(v), rates * v)

    def senses(self, rows: Array) -> Array:
        """Return the signs of the relative rates at one place, shape (joints,)."""
        return np.sign(self.rates(rows)[:, 0])

    def _solved(self, free: Array, by_friction: Array, against: Array, velocity: Array) -> Array:
        """Return frictions m of m = s (f P(m) + c) - d v by Newton's method, from none."""
        count, n = velocity.shape
        drags = (pair.law.moment if isinstance(pair.law, PinFriction) else pair.law.force for pair in self.joints)
        constant = np.stack(
            [
                drag * s - pair.law.damping * v
                for pair, drag, s, v in zip(self.joints, drags, against, velocity, strict=True)
            ]
        )
        frictions, sign = np.zeros((count, n)), np.ones(n)
        for _ in range(_ITERATIONS):
            pairs = free + np.einsum("iakn,kn->ian", by_friction, frictions)
            matrix, missing = np.zeros((n, count, count)), frictions - constant
            for i, joint in enumerate(self.joints):
                pressing, by_one, by_two = joint.pressing(pairs[i, 0], pairs[i, 1])
                share = against[i] * joint.factor
                missing[i] -= share * pressing
                matrix[:, i] = (-share * (by_one * by_friction[i, 0] + by_two * by_friction[i, 1])).T
            matrix += np.eye(count)
            move = np.linalg.solve(matrix, missing.T[..., None])[..., 0].T
            frictions = frictions - move
            sign = np.linalg.det(matrix)
            if np.all(np.abs(move) <= _SETTLED * (np.abs(frictions) + np.abs(constant) + 1e-300)):
                break
        else:
            settled = np.all(np.abs(move) <= _LOCKED * (np.abs(frictions) + 1e-300), axis=0)
            frictions = np.where(settled, frictions, np.nan)
        # without friction the determinant is one; where it has changed its sign no force balances
        return np.where(sign > 0, frictions, np.nan)
