"""A linkage let go: how it moves in time from a given state, what happens on the way, and where its energy goes."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis.results import Listing
from crankwork.analysis.solved import Notice, SolvedLinkage
from crankwork.dynamics.force_system import whole_system
from crankwork.dynamics.friction import Rubbing, friction_forces, rubbing_joints, unit_effect
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import link_wrenches
from crankwork.dynamics.reduction import kinetic_energy, reduced_inertia, reduced_torque
from crankwork.dynamics.running import Running
from crankwork.errors import MethodError
from crankwork.formula.expression import Value
from crankwork.formula.known import Found, Known, breaks_of
from crankwork.kinematics.circuits import with_branches
from crankwork.kinematics.coordinates import driver_coordinate
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.memory import remembered_motion
from crankwork.kinematics.motion import Motion, linkage_motion
from crankwork.kinematics.transfer import Transfer
from crankwork.kinematics.travel import Travel, branches_of
from crankwork.loads.applied import AppliedLoads
from crankwork.loads.damper import Damper, SliderDamper
from crankwork.loads.load import applied_loads
from crankwork.loads.potential import has_potential, potential_energy
from crankwork.loads.process import ProcessForce, ProcessForceAtPoint, TorqueOnLink
from crankwork.locale import Refusal
from crankwork.machine import Machine, Transient
from crankwork.mechanism.dyads import RPR, RRP, RRR
from crankwork.mechanism.mechanism import Mechanism
from crankwork.shaft.collocation import gauss
from crankwork.shaft.fitted import fitted
from crankwork.shaft.slipping import Slipping
from crankwork.shaft.transient import OWN, RATE, Course, FreeMachine, Run, Way

_WIDTH = math.pi / 8
_ROWS = 200
_BESIDE = 1e-6
_LOOKS, _HALVINGS, _NOTHING = 2001, 60, 1e-12
# inertia and its derivative; energy and torques; damping; rate of the crank
_ALIKE = (0, 1, 1, 1, 2, 3, 0, 1)
_CHECKED_STEPS = 20_000
_STEADY = 1e-10
_SAME_CYCLES = 2
_AT_PERIOD = 1e-9
_NODES, _WEIGHTS, *_ = gauss(8)


class Piece(NamedTuple):
    """A branch of a linkage: the crank angle goes from one dead position to the next as the coordinate grows."""

    mechanism: Mechanism
    # Coordinates, and crank angles there [rad]
    low: float
    high: float
    first: float
    last: float
    turns_back: bool  # Whether its ends are dead positions; the coordinate is the crank angle where they are none

    def crank(self, u: Array) -> Transfer:
        """Return the crank angle and its derivatives by the coordinate. [rad]"""
        if not self.turns_back:
            return Transfer(u, np.ones_like(u), np.zeros_like(u))
        half, rate = (self.last - self.first) / 2, math.pi / (self.high - self.low)
        angle = rate * (u - self.low)
        # from the nearer end, where the difference to it is small
        away = half * 2 * np.sin(angle / 2) ** 2
        return Transfer(self.first + away, half * rate * np.sin(angle), half * rate**2 * np.cos(angle))


@dataclass(frozen=True)
class Chart:
    """A coordinate that grows all along the way of a linkage, through the dead positions of its crank."""

    pieces: tuple[Piece, ...]
    period: float  # Infinite where the way has ends

    @property
    def ends(self) -> tuple[float, ...]:
        """Where pieces meet."""
        return (self.pieces[0].low, *(one.high for one in self.pieces))

    def each(self, u: Array) -> Iterator[tuple[Piece, NDArray[np.intp]]]:
        """Yield the pieces, and which of some coordinates of the first period are on them."""
        inner = [one.low for one in self.pieces[1:]]
        which = np.searchsorted(inner, u, side="right")
        for k, piece in enumerate(self.pieces):
            here = np.flatnonzero(which == k)
            if here.size:
                yield piece, here

    def within(self, u: Array) -> tuple[Array, Array]:
        """Return coordinates in the first period, and the crank angle of whole turns before it. [rad]"""
        if math.isinf(self.period):
            return u, np.zeros_like(u)
        turns = np.floor((u - self.ends[0]) / self.period)
        return u - turns * self.period, (0.0 if self.pieces[0].turns_back else self.period) * turns

    def beside(self, u: Array) -> Array:
        """Return how far coordinates are from the dead positions, over the way between these. [-]"""
        if not self.pieces[0].turns_back:
            return np.full_like(u, np.inf)
        apart = np.abs(self.within(u)[0][:, None] - np.array(self.ends)).min(axis=1)
        return np.asarray(apart / (self.ends[-1] - self.ends[0]))

    def aside(self, u: Array) -> Array:
        """Return coordinates, those in dead positions put beside these, where a motion has rates by the crank."""
        return np.where(
            self.beside(u) < _BESIDE, u + 2 * _BESIDE * (self.ends[-1] - self.ends[0]) * _inward(self, u), u
        )

    def crank(self, u: Array) -> Transfer:
        """Return the crank angle and its derivatives by the coordinate, turns counted. [rad]"""
        inside, turned = self.within(u)
        found = np.empty((3, u.size))
        for piece, here in self.each(inside):
            found[:, here] = piece.crank(inside[here])
        return Transfer(found[0] + turned, found[1], found[2])

    def coordinate(self, angle: float) -> float:
        """Return the coordinate of a crank angle on the first piece. [rad]"""
        one = self.pieces[0]
        if not one.turns_back:
            return angle
        share = (angle - one.first) / (one.last - one.first)
        return one.low + (one.high - one.low) * math.acos(min(max(1 - 2 * share, -1.0), 1.0)) / math.pi


def chart_of(machine: Machine, found: Travel | None) -> Chart:
    """Return the coordinate along the way of a linkage: its crank angle, or what goes on where that turns back."""
    if found is None or found.is_whole:
        turn = math.radians(machine.cycle)
        return Chart((Piece(machine.mechanism, 0.0, turn, 0.0, turn, turns_back=False),), turn)
    circuit = found.circuit
    only_dyads = all(isinstance(one, RRR | RRP | RPR) for one in machine.mechanism.dyads)
    parts = circuit.branches(driver_coordinate(circuit.mechanism))
    if not (only_dyads and circuit.curve.is_closed and not len(circuit.curve.crossings)):
        parts = [found.branch]
    stated = next((k for k, one in enumerate(parts) if _same(one, found.branch, circuit.curve.length)), 0)
    parts = [*parts[stated:], *parts[:stated]]
    pieces, low = [], 0.0
    for part in parts:
        first, last = (float(one) for one in circuit.values(driver_coordinate(circuit.mechanism), np.array(part)))
        mechanism = machine.mechanism
        if len(parts) > 1:
            middle = circuit.stretch(np.array([(part.start + part.end) / 2]))
            mechanism = with_branches(replace(mechanism, passages={}), branches_of(mechanism, middle))
        # alike at the dead position for the pieces on both sides of it
        high = low + math.pi * math.sqrt(abs(last - first) / 2)
        pieces.append(Piece(mechanism, low, high, first, last, turns_back=True))
        low = high
    return Chart(tuple(pieces), low if len(parts) > 1 else math.inf)


def _inward(chart: Chart, u: Array) -> Array:
    """Return which way leads on along a chart: back from its end, where it has one."""
    return np.where(np.isinf(chart.period) & (u > (chart.ends[0] + chart.ends[-1]) / 2), -1.0, 1.0)


def _same(one: tuple[float, float], other: tuple[float, float], length: float) -> bool:
    apart = (sum(one) - sum(other)) / 2
    return abs(apart - length * round(apart / length)) < 1e-6 * length


@dataclass(frozen=True)
class Loose:
    """A linkage at liberty: its masses and loads along the coordinate of a chart."""

    solved: SolvedLinkage
    chart: Chart
    flywheel: float = 0.0  # Moment of inertia on the crank besides what the machine has [kg m2]

    @property
    def machine(self) -> Machine:
        """The machine."""
        return self.solved.machine

    @property
    def wanted(self) -> Transient:
        """What is asked for."""
        if self.machine.transient is None:
            raise TypeError("no transient is asked for")
        return self.machine.transient

    @property
    def beside(self) -> float:
        """Moment of inertia that turns with the crank. [kg m2]"""
        motor = self.machine.drive.motor
        return self.machine.drive.inertia + self.flywheel + (motor.reduced_inertia if motor else 0.0)

    def moved(self, piece: Piece, angle: Array, way: Way = 1) -> Motion:
        """Return the motion of a branch at crank angles, forwards or backwards. [rad]"""
        motion = linkage_motion(piece.mechanism, CrankGrid.from_radians(angle))
        back = Transfer(angle, np.full_like(angle, float(way)), np.zeros_like(angle))
        return motion if way > 0 else replace(motion, driver=back)

    def loads(self, piece: Piece, motion: Motion, speed: Value = 0.0, *, with_potential: bool = True) -> AppliedLoads:
        """Return what pushes the linkage at some speeds of the crank. [rad/s]"""
        loads = [one for one in self.machine.loads if with_potential or not has_potential(one)]
        gas = self.solved.filling.loads(piece.mechanism, motion)
        return applied_loads(piece.mechanism, motion, loads, speed).also(gas)

    def inertia(self, piece: Piece, motion: Motion) -> Array:
        """Return the reduced moment of inertia with all that turns with the crank. [kg m2]"""
        still = np.zeros_like(motion.grid.angle)
        return np.asarray(reduced_inertia(piece.mechanism, motion).inertia + still + self.beside)

    def _columns(self, u: Array) -> Array:
        found = np.zeros((OWN + self._rubbing_rows, u.size))
        for piece, here in self.chart.each(u):
            q, q_1, _ = piece.crank(u[here])
            motion = self.moved(piece, q)
            found[0, here] = self.inertia(piece, motion) * q_1**2
            found[1, here] = potential_energy(piece.mechanism, motion, self.machine.loads)
            found[RATE, here] = q_1
            dampers = [one for one in self.machine.loads if isinstance(one, Damper | SliderDamper)]
            found[4, here] = -reduced_torque(motion, applied_loads(piece.mechanism, motion, dampers, 1.0)) * q_1**2
            torques = [
                reduced_torque(one, self.loads(piece, one, with_potential=False)) * q_1
                for one in ((motion, self.moved(piece, q, -1)) if self.is_two_sided else (motion, motion))
            ]
            if not piece.turns_back:
                found[6, here] = reduced_inertia(piece.mechanism, motion).inertia_1
                held = [one for one in self.machine.loads if has_potential(one)]
                found[7, here] = -reduced_torque(motion, applied_loads(piece.mechanism, motion, held))
            if self.machine.friction:
                found[OWN:, here] = self._rubbing(piece, motion, piece.crank(u[here]))
            found[2:4, here] = torques if piece.last >= piece.first else torques[::-1]
        return found

    @cached_property
    def _joints(self) -> tuple[Rubbing, ...]:
        """The joints that rub."""
        piece = self.chart.pieces[0]
        middle = np.array([(piece.first + piece.last) / 2])
        return rubbing_joints(Running(piece.mechanism, self.moved(piece, middle)), self.machine.friction)

    @property
    def _slipping(self) -> Slipping | None:
        return Slipping(self._joints, OWN) if self.machine.friction else None

    @property
    def _rubbing_rows(self) -> int:
        return self._slipping.count * len(self._joints) if self._slipping else 0

    @property
    def _alike(self) -> tuple[int, ...]:
        """Which rows of the rubbing joints are of like size."""
        if self._slipping is None:
            return ()
        kinds = (3, *(kind for kind in (5, 5, 6, 7, 8) for _ in range(2)), *(9 for _ in range(2 * len(self._joints))))
        return kinds * len(self._joints)

    def _rubbing(self, piece: Piece, motion: Motion, crank: Transfer) -> Array:
        """Return the rows of `Slipping`: rates of the joints, and their unknowns for each cause, shape (rows, n)."""
        still = Running(piece.mechanism, motion)
        system, back = whole_system(still), self.moved(piece, motion.grid.angle, -1)
        dampers = [one for one in self.machine.loads if isinstance(one, Damper | SliderDamper)]
        ways = (motion, back) if piece.last >= piece.first else (back, motion)
        causes = [
            *(Running(piece.mechanism, motion, 0.0, self.loads(piece, one)) for one in ways),
            Running(piece.mechanism, motion, 1.0),
            Running(piece.mechanism, motion, 0.0, applied_loads(piece.mechanism, motion, dampers, 1.0)),
            Running(piece.mechanism, motion, 0.0, angular_acceleration=1.0),
        ]
        right = [system.right_side(link_wrenches(one)) + np.zeros((len(motion.grid), 1)) for one in causes]
        right += [-unit_effect(motion, system, one.joint) for one in self._joints]
        grows, falls, square, rate, acceleration, *own = np.moveaxis(
            np.linalg.solve(system.matrix, np.stack(right, axis=-1)), -1, 0
        )
        _, q_1, q_2 = (one[:, None] for one in crank)
        by_cause = [grows, falls, square * q_1**2 + acceleration * q_2, rate * q_1, acceleration * q_1, *own]
        rows = []
        for one in rubbing_joints(still, self.machine.friction):
            at = 2 * system.joints.index(one.joint)
            rows += [one.rate * crank.position_1, *(each[:, at + k] for each in by_cause[:5] for k in range(2))]
            rows += [each[:, at + k] for k in range(2) for each in by_cause[5:]]
        return np.stack(rows)

    @cached_property
    def is_two_sided(self) -> bool:
        """Whether loads are others when the crank turns back."""
        processes = (one for one in self.machine.loads if isinstance(one, ProcessForce | ProcessForceAtPoint))
        return any(one.acts == "forward" for one in processes)

    @cached_property
    def felt(self) -> FreeMachine:
        """What its coordinate feels."""
        wanted, ends = self.wanted, self.chart.ends
        breaks = np.unique(np.concatenate([ends, *(self._breaks(one) for one in self.chart.pieces)]))
        reduced = fitted(self._columns, breaks, _WIDTH, self.chart.period, alike=(*_ALIKE, *self._alike))
        # towards dead positions the derivatives by the crank angle are differences of infinite terms
        dead = self.chart.pieces[0].turns_back
        reduced = reduced.with_slopes((0, 6), (1, 7)) if dead else reduced
        if not np.min(reduced.powers[:, 0, 0]) > 0:
            raise MethodError(Refusal("transient_massless"))
        slipping = self._slipping
        if slipping is not None:
            breaks = np.unique(np.concatenate([breaks, _roots(lambda u: slipping.rates(reduced(u)), breaks)]))
        return FreeMachine(
            reduced,
            tuple(map(float, breaks)),
            slipping=slipping,
            dead=frozenset(ends) if dead else frozenset(),
            changes=self._changes,
            torque=wanted.torque,
            motor=self.machine.drive.motor if wanted.motor else None,
            stops=wanted.stops,
            restitution=wanted.restitution,
        )

    @property
    def _changes(self) -> tuple[float, ...]:
        """The coordinates of change points, of a crank that turns fully. [rad]"""
        if self.chart.pieces[0].turns_back:
            return ()
        passages = self.machine.mechanism.passages.values()
        every = {math.radians(one % math.degrees(self.chart.period)) for passage in passages for one in passage.changes}
        return tuple(sorted(every))

    def _breaks(self, piece: Piece) -> Array:
        """Return the coordinates on a branch at which a law of the loads changes."""
        jumping = (ProcessForce, ProcessForceAtPoint, TorqueOnLink)
        if not (any(isinstance(one, jumping) for one in self.machine.loads) or self.machine.chambers):
            return np.empty(0)
        start, end = sorted(map(math.degrees, (piece.first, piece.last)))
        inside = np.linspace(start, end, 363)[1:-1]
        motion = linkage_motion(piece.mechanism, CrankGrid.from_degrees(inside))
        remembered = remembered_motion(piece.mechanism, motion, self.machine.linkage)
        torque = reduced_torque(remembered, self.loads(piece, remembered))
        if not isinstance(torque, Known):
            return np.empty(0)
        angles = np.radians(breaks_of([torque], end - start, start))
        if not piece.turns_back:
            return angles
        share = (angles - piece.first) / (piece.last - piece.first)
        return np.asarray(piece.low + (piece.high - piece.low) * np.arccos(np.clip(1 - 2 * share, -1, 1)) / math.pi)


def _roots(function: Callable[[Array], Array], breaks: Array) -> Array:
    """Return where one of some functions changes its sign between the first and the last of the breaks."""
    places = np.unique(np.concatenate([breaks, np.linspace(breaks[0], breaks[-1], _LOOKS)]))
    values = function(places)
    values = np.where(np.abs(values) <= _NOTHING * np.max(np.abs(values), axis=1, keepdims=True), 0.0, values)
    found = []
    for row, k in zip(*np.nonzero(values[:, 1:] * values[:, :-1] < 0), strict=True):
        low, high, below = places[k], places[k + 1], values[row, k] < 0
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if (function(np.array([middle]))[row, 0] < 0) == below else (low, middle)
        found.append(high)
    exact = places[np.any(values == 0, axis=0) & np.any(values != 0, axis=0)]
    return np.concatenate([np.array(found), exact[np.isin(exact, places[1:-1])]])


class Ran(NamedTuple):
    """How a linkage went: single values, tables over time and of events, checks, notices."""

    summary: dict[str, Known]
    listings: dict[str, Listing]
    checks: dict[str, float]
    notices: tuple[Notice, ...]


def let_go(
    solved: SolvedLinkage,
    found: Travel | None,
    summary: Mapping[str, Known],
    progress: Callable[[float], None] | None = None,
) -> Ran:
    """Return how a linkage moves in time from where it is let go (artobolevsky_1988, ch. 15); nothing if it is not.

    `found`: the way of a crank that does not turn fully; `summary`: what else is known, such as its flywheel;
    `progress`: told the part of the time that is done.
    """
    if solved.machine.transient is None:
        return Ran({}, {}, {}, ())
    chart = chart_of(solved.machine, found)
    flywheel = summary.get("flywheel_inertia.exact")
    loose = Loose(solved, chart, flywheel.value if flywheel is not None else 0.0)
    wanted = loose.wanted
    start = chart.coordinate(wanted.start)
    rate = float(chart.crank(np.array([start]))[1][0])
    if not rate:
        raise MethodError(Refusal("transient_dead"))
    cycles = _Cycles(loose, progress)
    course = Run(loose.felt, start, wanted.speed / rate).until(wanted.time, watched=wanted.speeds, each=cycles)
    checks = {"energy_balance": _missing(loose, course)}
    if course.events and course.events[-1].word == "steady":
        checks |= cycles.against(summary)
    end = np.array([course.end])
    (q, q_1, _), (_, v, _) = chart.crank(course.at(end)[0]), course.at(end)
    turn, speed = float(q[0]) - wanted.start, float(q_1[0] * v[0])
    keys = {"transient_time": course.end, "final_turn": turn, "final_speed": speed}
    return Ran(
        {key: Known(Found(value, "followed"), key) for key, value in keys.items()},
        {"transient": _history(loose, course), **_events(chart, course)},
        checks,
        tuple(_told(loose, course)),
    )


class _Cycles:
    """Where a motion passes the coordinate that it started from, and whether it is steady there."""

    def __init__(self, loose: Loose, progress: Callable[[float], None] | None) -> None:
        self._time, self._progress = loose.wanted.time, progress
        self._place, self._period = loose.chart.coordinate(loose.wanted.start), loose.chart.period
        self._until = loose.wanted.until
        # the steady speed is that without friction
        self._rubs = bool(loose.machine.friction)
        self.times, self.rates = [0.0], [loose.wanted.speed]

    def __call__(self, run: Run) -> bool:
        """Return whether enough has been seen."""
        if self._progress is not None:
            self._progress(run.time / self._time)
        if self._until == "rest":
            return run.is_over
        if self._until == "time" or not run.course.steps or math.isinf(self._period):
            return False
        step, turned = run.course.steps[-1], run.course.turned[-1]
        ahead = self._place + self._period * len(self.times) * run.way - turned
        ended = abs(step.end[0] - ahead) < _AT_PERIOD
        for time in [step.time + step.length] if ended else step.crossings(lambda q, _: q - ahead)[:1]:
            self.times.append(time)
            self.rates.append(float(step.at(np.array(time))[1]))
        last = self.rates[-_SAME_CYCLES - 1 :]
        if len(last) <= _SAME_CYCLES or np.ptp(last) > _STEADY * abs(last[-1]):
            return False
        run.tell("steady")
        return True

    def against(self, summary: Mapping[str, Known]) -> dict[str, float]:
        """Return by how much the last cycle misses the steady speed that was found without its start. [-]"""
        if "steady_speed" not in summary or self._rubs or len(self.times) <= _SAME_CYCLES:
            return {}
        mean = self._period / (self.times[-1] - self.times[-2])
        return {"steady_cycle": abs(mean / summary["steady_speed"].value - 1)}


def _history(loose: Loose, course: Course) -> Listing:
    """Return the motion as a table over time: crank, sliding pieces, joint forces, energies."""
    step = loose.wanted.step or course.end / _ROWS
    times = np.asarray(np.arange(math.floor(course.end / step * (1 + 1e-12)) + 1) * step, dtype=float)
    times = np.asarray(np.append(times, course.end) if course.end - times[-1] > 1e-9 * step else times)
    u, v, a = course.at(times)
    u = loose.chart.aside(u)
    crank = loose.chart.crank(u)
    speed = crank.position_1 * v
    acceleration = crank.position_1 * a + crank.position_2 * v**2
    columns = {"time": times, "crank_angle": crank.position, "crank_speed": speed, "angular_acceleration": acceleration}
    rest = _Filled(times.size)
    for piece, here in loose.chart.each(loose.chart.within(u)[0]):
        motion = loose.moved(piece, crank.position[here])
        for name, slide in motion.sliders.items():
            rest.put(f"slider_displacement.{name}", here, slide.position)
            rest.put(f"slider_velocity.{name}", here, slide.position_1 * speed[here])
        rest.put("kinetic_energy", here, kinetic_energy(loose.inertia(piece, motion), speed[here]))
        rest.put("potential_energy", here, potential_energy(piece.mechanism, motion, loose.machine.loads))
        loads = loose.loads(piece, motion, speed[here])
        running = Running(piece.mechanism, motion, speed[here], loads, acceleration[here])
        with np.errstate(divide="ignore", invalid="ignore"):
            rubbed = friction_forces(running, loose.machine.friction) if loose.machine.friction else None
        if rubbed is not None:
            rest.put("friction_power", here, rubbed.power_loss)
        for name, pin in (rubbed.joint_forces if rubbed else joint_forces(running)).pins.items():
            rest.put(f"joint_force.{name}", here, pin.resultant)
    rest.columns["driving_torque"] = loose.felt.drive(speed)
    return Listing(columns | rest.columns)


class _Filled:
    """Columns that are filled branch by branch."""

    def __init__(self, count: int) -> None:
        self.count, self.columns = count, dict[str, Array]()

    def put(self, key: str, rows: NDArray[np.intp], values: Array) -> None:
        self.columns.setdefault(key, np.full(self.count, np.nan))[rows] = values


def _events(chart: Chart, course: Course) -> dict[str, Listing]:
    """Return the table of what happens; none where nothing does."""
    if not course.events:
        return {}
    times, u, v = (np.array([getattr(one, name) for one in course.events]) for name in ("time", "coordinate", "rate"))
    crank = chart.crank(u)
    counted: Counter[str] = Counter()
    names = []
    for one in course.events:
        counted[one.word] += 1
        names.append(f"{one.word}.{counted[one.word]}")
    columns = {"time": times, "crank_angle": crank.position, "crank_speed": crank.position_1 * v}
    return {"transient_events": Listing(columns, tuple(names))}


def _missing(loose: Loose, course: Course) -> float:
    """Return by how much energy gained and work done differ, over the largest kinetic energy. [-]

    Energies are those of speed and place, the work that of powers between, on a grid of its own.
    """
    steps = course.steps[:_CHECKED_STEPS]
    start, length = (np.array([getattr(one, name) for one in steps]) for name in ("time", "length"))
    ends = np.append(start, start[-1] + length[-1])
    known = loose.chart.beside(course.at(ends)[0]) > _BESIDE
    kinetic, potential = _energies(loose, course, np.asarray(ends[known]))
    half = start[:, None] + length[:, None] / 2 * np.arange(2)
    nodes = half[..., None] + length[:, None, None] / 2 * _NODES
    work = (_power(loose, course, nodes.ravel()).reshape(nodes.shape) @ _WEIGHTS).sum(axis=1) * length / 2
    done = np.append(0.0, np.cumsum(work))[known]
    largest = float(np.max(kinetic))
    return float(np.ptp(kinetic + potential - done)) / largest if largest else 0.0


def _energies(loose: Loose, course: Course, times: Array) -> tuple[Array, Array]:
    """Return kinetic and potential energy at some times. [J]"""
    u, v, _ = course.at(times)
    crank, found = loose.chart.crank(u), np.empty((2, times.size))
    for piece, here in loose.chart.each(loose.chart.within(u)[0]):
        motion = loose.moved(piece, crank.position[here])
        speed = crank.position_1[here] * v[here]
        found[0, here] = kinetic_energy(loose.inertia(piece, motion), speed)
        found[1, here] = potential_energy(piece.mechanism, motion, loose.machine.loads)
    return np.asarray(found[0]), np.asarray(found[1])


def _power(loose: Loose, course: Course, times: Array) -> Array:
    """Return the power of the driver and of the loads without a potential energy. [W]"""
    u, v, a = course.at(times)
    crank = loose.chart.crank(u)
    speed, acceleration = crank.position_1 * v, crank.position_1 * a + crank.position_2 * v**2
    power = loose.felt.drive(speed) * speed
    if (
        not loose.machine.friction
        and all(has_potential(one) for one in loose.machine.loads)
        and not loose.machine.chambers
    ):
        return np.asarray(power)
    for piece, here in loose.chart.each(loose.chart.within(u)[0]):
        ways: tuple[Way, Way] = (1, -1)
        for way in ways:
            rows = here[speed[here] * way > 0]
            if rows.size:
                order = rows[np.argsort(crank.position[rows], kind="stable")]
                motion = loose.moved(piece, crank.position[order], way)
                loads = loose.loads(piece, motion, speed[order], with_potential=False)
                power[order] += reduced_torque(motion, loads) * speed[order]
                power[order] -= _lost(loose, piece, motion, (speed[order], acceleration[order]))
    return np.asarray(power)


def _lost(loose: Loose, piece: Piece, motion: Motion, rates: tuple[Array, Array]) -> Array | float:
    """Return the power that friction takes, from the equilibrium of all links at speeds and accelerations. [W]"""
    if not loose.machine.friction:
        return 0.0
    loads = loose.loads(piece, motion, rates[0])
    running = Running(piece.mechanism, motion, rates[0], loads, rates[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        # nothing drives, and there is no efficiency
        return friction_forces(running, loose.machine.friction).power_loss


def _told(loose: Loose, course: Course) -> Iterator[Notice]:
    """Yield what keeps it from starting, and what happens on the way: the first time of each."""
    missing = _missing_torque(loose)
    stays = bool(course.events) and course.events[0].time == 0 and course.events[0].word == "comes_to_rest"
    if missing > 0:
        values: dict[str, float | str] = {"angle": math.degrees(loose.wanted.start), "torque": missing}
        yield Notice("transient_stays" if stays else "transient_overcome", values)
    counted: Counter[str] = Counter(one.word for one in course.events)
    for word, count in counted.items():
        event = next(one for one in course.events if one.word == word)
        crank = loose.chart.crank(np.array([event.coordinate]))
        angle, speed = math.degrees(float(crank.position[0])), float(crank.position_1[0] * event.rate)
        if not (stays and word == "comes_to_rest" and missing > 0):
            yield Notice(f"transient_{word}", {"time": event.time, "angle": angle, "speed": speed, "count": count})


def _missing_torque(loose: Loose) -> float:
    """Return what more torque on the crank would start a machine at rest the way that it is driven. [N m]"""
    drive = float(loose.felt.drive(np.zeros(1))[0])
    if not drive or loose.wanted.speed:
        return 0.0
    felt, start = loose.felt, loose.chart.coordinate(loose.wanted.start)
    way: Way = 1 if drive * float(felt.reduced(np.array([start]))[RATE][0]) > 0 else -1
    u = np.array([felt.placed(float(loose.chart.within(np.array([start]))[0][0]), way)])
    inertia, rate = (float(felt.reduced(u)[row][0]) for row in (0, RATE))
    return (
        -way * float(felt.acceleration(u, np.zeros(1), way, *felt.stretch(float(u[0]), way))[0]) * inertia / abs(rate)
    )
