"""Transient motion of a linkage: how it moves in time from a given state, its events, and its energy balance."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis.flywheel import turning_inertia
from crankwork.analysis.path_coordinate import CLOSE, PathCoordinate, PathSegment, path_coordinate
from crankwork.analysis.results import Listing
from crankwork.dynamics.force_system import full_equilibrium
from crankwork.dynamics.friction import FrictionJoint, friction_forces, friction_joints
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import OperatingState, link_wrenches
from crankwork.dynamics.reduction import kinetic_energy, reduced_inertia, reduced_torque
from crankwork.errors import GeometryError, MethodError
from crankwork.formula.expression import Value
from crankwork.formula.traced_value import (
    FunctionValue,
    ProcedureValue,
    TracedValue,
    absent,
    breakpoints_of,
    given,
    total,
)
from crankwork.kinematics.chain_solver import ChainPath
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.crank_range import CrankRange
from crankwork.kinematics.kinematic_coefficients import Transfer
from crankwork.kinematics.motion import Motion, linkage_motion
from crankwork.kinematics.traced_motion import traced_mechanism, traced_motion
from crankwork.loads.applied_loads import AppliedLoads
from crankwork.loads.load import (
    Damper,
    ProcessForce,
    SliderDamper,
    TorqueOnLink,
    applied_loads,
    has_potential,
    potential_energy,
)
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine, Transient
from crankwork.mechanism.joints import names_of_pivots
from crankwork.preparation.prepared import Notice, PreparedLinkage
from crankwork.shaft.collocation import gauss
from crankwork.shaft.compiled_integrator import TransientReplay
from crankwork.shaft.piecewise_fit import fit_piecewise
from crankwork.shaft.transient import (
    LIGHT,
    MOST_STEPS,
    OWN,
    RATE,
    Direction,
    Integrator,
    Trajectory,
    TransientFriction,
    TransientSystem,
)

_WIDTH = math.pi / 8
_LOOKS, _HALVINGS, _NEGLIGIBLE = 2001, 60, 1e-12
# inertia and its derivative; energy and torques; damping; rate of the crank
_GROUPS = (0, 1, 1, 1, 2, 3, 0, 1)


@dataclass(frozen=True)
class TransientModel:
    """A linkage in transient motion: its masses and loads along the coordinate of a chart."""

    solved: PreparedLinkage
    chart: PathCoordinate
    flywheel: float = 0.0  # Moment of inertia on the crank, added to that of the machine [kg m2]
    # Solved paths of the chains of each branch
    paths: dict[float, dict[int, ChainPath]] = field(default_factory=dict, compare=False, repr=False)

    @property
    def machine(self) -> Machine:
        """The machine."""
        return self.solved.machine

    @property
    def wanted(self) -> Transient:
        """The transient simulation that is asked for."""
        if self.machine.transient is None:
            raise TypeError("no transient is asked for")
        return self.machine.transient

    @property
    def crank_inertia(self) -> float:
        """Moment of inertia that turns with the crank. [kg m2]"""
        motor = self.machine.drive.motor
        return self.machine.drive.inertia + self.flywheel + (motor.reduced_inertia if motor else 0.0)

    def moved(self, piece: PathSegment, angle: Array, direction: Direction = 1) -> Motion:
        """Return the motion of a branch at crank angles, forwards or backwards. [rad]"""
        paths = self.paths.setdefault(piece.low, {})
        motion = linkage_motion(piece.mechanism, CrankGrid.from_radians(angle), paths=paths)
        return motion if direction > 0 else _backwards(motion)

    def loads(
        self, piece: PathSegment, motion: Motion, speed: Value = 0.0, *, with_potential: bool = True
    ) -> AppliedLoads:
        """Return the applied loads at some speeds of the crank. [rad/s]"""
        loads = [load for load in self.machine.loads if with_potential or not has_potential(load)]
        gas = self.solved.filling.loads(piece.mechanism, motion)
        return applied_loads(piece.mechanism, motion, loads, speed).also(gas)

    def inertia(self, piece: PathSegment, motion: Motion) -> Array:
        """Return the reduced moment of inertia with all that turns with the crank. [kg m2]"""
        still = np.zeros_like(motion.grid.angle)
        return np.asarray(reduced_inertia(piece.mechanism, motion).inertia + still + self.crank_inertia)

    def _columns(self, u: Array) -> Array:
        result = np.zeros((OWN + self._slip_row_count, u.size))
        for piece, index in self.chart.each(u):
            q, q_1, _ = piece.crank(u[index])
            motion = self.moved(piece, q)
            result[0, index] = self.inertia(piece, motion) * q_1**2
            result[1, index] = potential_energy(piece.mechanism, motion, self.machine.loads)
            result[RATE, index] = q_1
            dampers = [load for load in self.machine.loads if isinstance(load, Damper | SliderDamper)]
            result[4, index] = -reduced_torque(motion, applied_loads(piece.mechanism, motion, dampers, 1.0)) * q_1**2
            torques = [
                reduced_torque(item, self.loads(piece, item, with_potential=False)) * q_1
                for item in ((motion, _backwards(motion)) if self.is_two_sided else (motion, motion))
            ]
            if not piece.turns_back:
                result[6, index] = reduced_inertia(piece.mechanism, motion).inertia_1
                held = [load for load in self.machine.loads if has_potential(load)]
                result[7, index] = -reduced_torque(motion, applied_loads(piece.mechanism, motion, held))
            if self.machine.friction:
                result[OWN:, index] = self._slip_rows(piece, motion, piece.crank(u[index]))
            result[2:4, index] = torques if piece.last >= piece.first else torques[::-1]
        return result

    @cached_property
    def _joints(self) -> tuple[FrictionJoint, ...]:
        """The joints with friction."""
        piece = self.chart.pieces[0]
        middle = np.array([(piece.first + piece.last) / 2])
        return friction_joints(OperatingState(piece.mechanism, self.moved(piece, middle)), self.machine.friction)

    @property
    def _slipping(self) -> TransientFriction | None:
        return TransientFriction(self._joints, OWN) if self.machine.friction else None

    @property
    def _slip_row_count(self) -> int:
        return self._slipping.count * len(self._joints) if self._slipping else 0

    @property
    def _slip_groups(self) -> tuple[int, ...]:
        """Groups of the rows of friction by order of magnitude."""
        if self._slipping is None:
            return ()
        kinds = (3, *(kind for kind in (5, 5, 6, 7, 8) for _ in range(2)), *(9 for _ in range(2 * len(self._joints))))
        return kinds * len(self._joints)

    def _slip_rows(self, piece: PathSegment, motion: Motion, crank: Transfer) -> Array:
        """Return the rows of `TransientFriction`: rates of the joints, unknowns by cause, shape (rows, n)."""
        still = OperatingState(piece.mechanism, motion)
        system, back = full_equilibrium(still), _backwards(motion)
        dampers = [load for load in self.machine.loads if isinstance(load, Damper | SliderDamper)]
        motions = (motion, back) if piece.last >= piece.first else (back, motion)
        causes = [
            *(OperatingState(piece.mechanism, motion, 0.0, self.loads(piece, item)) for item in motions),
            OperatingState(piece.mechanism, motion, 1.0),
            OperatingState(piece.mechanism, motion, 0.0, applied_loads(piece.mechanism, motion, dampers, 1.0)),
            OperatingState(piece.mechanism, motion, 0.0, angular_acceleration=1.0),
        ]
        right = [system.right_side(link_wrenches(cause)) + np.zeros((len(motion.grid), 1)) for cause in causes]
        right += [-joint.unit_effect(motion, system) for joint in self._joints]
        grows, falls, square, rate, acceleration, *own = np.moveaxis(
            np.linalg.solve(system.matrix, np.stack(right, axis=-1)), -1, 0
        )
        _, q_1, q_2 = (item[:, None] for item in crank)
        by_cause = [grows, falls, square * q_1**2 + acceleration * q_2, rate * q_1, acceleration * q_1, *own]
        rows = []
        for friction_joint in friction_joints(still, self.machine.friction):
            first = 2 * system.joints.index(friction_joint.joint)
            rows += [
                friction_joint.rate * crank.position_1,
                *(each[:, first + k] for each in by_cause[:5] for k in range(2)),
            ]
            rows += [each[:, first + k] for k in range(2) for each in by_cause[5:]]
        return np.stack(rows)

    @cached_property
    def is_two_sided(self) -> bool:
        """Whether loads differ when the crank turns back."""
        processes = (load for load in self.machine.loads if isinstance(load, ProcessForce))
        return any(process.acts == "forward" for process in processes)

    @cached_property
    def system(self) -> TransientSystem:
        """The equation of motion along the coordinate."""
        wanted, ends = self.wanted, self.chart.ends
        breaks = np.unique(np.concatenate([ends, *(self._breaks(piece) for piece in self.chart.pieces)]))
        reduced = fit_piecewise(self._columns, breaks, _WIDTH, self.chart.period, groups=(*_GROUPS, *self._slip_groups))
        # towards dead positions the derivatives by the crank angle are differences of infinite terms
        dead = self.chart.pieces[0].turns_back
        reduced = reduced.with_slopes((0, 6), (1, 7)) if dead else reduced
        places = np.linspace(ends[0], ends[-1], _LOOKS)
        inertia = reduced(places)[0]
        if not np.min(inertia) > LIGHT * np.max(inertia):
            light = self.chart.crank(places[[np.argmin(inertia)]]).position
            raise MethodError(ErrorMessage("transient_light", angle=math.degrees(float(light[0]))))
        slipping = self._slipping
        if slipping is not None:
            breaks = np.unique(np.concatenate([breaks, _roots(lambda u: slipping.rates(reduced(u)), breaks)]))
        return TransientSystem(
            reduced,
            tuple(map(float, breaks)),
            slipping=slipping,
            dead=frozenset(ends) if dead else frozenset(),
            changes=self._changes,
            torque=wanted.torque,
            motor=self.machine.drive.motor if wanted.motor else None,
            stops=self.chart.walls(wanted.start, wanted.stops),
            restitution=wanted.restitution,
        )

    def traced(self, motion: Motion, flywheel: TracedValue | None) -> tuple[TracedValue, ...]:
        """Return the traced operands of a motion in time, as `TransientReplay` takes them.

        Empty where they depend on more than the crank angle. `motion`: over the crank angle, traced; `flywheel`: added
        to that of the machine.
        """
        machine, wanted = self.machine, self.wanted
        if self.chart.pieces[0].turns_back or machine.friction or machine.drive.motor or self.is_two_sided:
            return ()
        mechanism = traced_mechanism(machine.mechanism, machine.linkage)
        added = [turning_inertia(machine, "reduced_inertia.drive"), *([] if flywheel is None else [flywheel])]
        dampers = [load for load in machine.loads if isinstance(load, Damper | SliderDamper)]
        undamped = [load for load in machine.loads if load not in dampers]
        pushed = applied_loads(mechanism, motion, undamped).also(self.solved.filling.loads(mechanism, motion))
        damped = applied_loads(mechanism, motion, dampers, 1.0)
        stated = (
            ("transient_time", wanted.time, "time"),
            ("driving_torque", wanted.torque, "torque"),
            ("crank_angle", wanted.start, "start"),
            ("speed", wanted.speed, "speed"),
        )
        inertia: TracedValue
        inertia, inertia_1 = reduced_inertia(mechanism, motion, total("reduced_inertia", added))
        return (
            inertia,
            inertia_1,
            reduced_torque(motion, pushed),
            -reduced_torque(motion, damped) if dampers else absent("damping"),
            *(given(key, value, f"transient.{name}") if value else absent(key) for key, value, name in stated),
        )

    @property
    def _changes(self) -> tuple[float, ...]:
        """The coordinates of change points, of a crank that turns fully. [rad]"""
        if self.chart.pieces[0].turns_back:
            return ()
        passages = self.machine.mechanism.passages.values()
        coordinates = {
            math.radians(change % math.degrees(self.chart.period)) for passage in passages for change in passage.changes
        }
        return tuple(sorted(coordinates))

    def _breaks(self, piece: PathSegment) -> Array:
        """Return the coordinates on a branch at which a law of the loads changes."""
        jumping = (ProcessForce, TorqueOnLink)
        if not (any(isinstance(load, jumping) for load in self.machine.loads) or self.machine.chambers):
            return np.empty(0)
        start, end = sorted(map(math.degrees, (piece.first, piece.last)))
        inside = np.linspace(start, end, 363)[1:-1]
        motion = linkage_motion(piece.mechanism, CrankGrid.from_degrees(inside))
        traced = traced_motion(piece.mechanism, motion, self.machine.linkage)
        torque = reduced_torque(traced, self.loads(piece, traced))
        if not isinstance(torque, TracedValue):
            return np.empty(0)
        angles = np.radians(breakpoints_of([torque], end - start, start))
        if not piece.turns_back:
            return angles
        share = (angles - piece.first) / (piece.last - piece.first)
        return np.asarray(piece.low + (piece.high - piece.low) * np.arccos(np.clip(1 - 2 * share, -1, 1)) / math.pi)


def _backwards(motion: Motion) -> Motion:
    """Return a motion whose crank turns back."""
    angle = motion.grid.angle
    return replace(motion, driver=Transfer(angle, np.full_like(angle, -1.0), np.zeros_like(angle)))


def _roots(function: Callable[[Array], Array], breaks: Array) -> Array:
    """Return the zeros at which functions change their signs between the first and the last of the breaks."""
    places = np.unique(np.concatenate([breaks, np.linspace(breaks[0], breaks[-1], _LOOKS)]))
    values = function(places)
    values = np.where(np.abs(values) <= _NEGLIGIBLE * np.max(np.abs(values), axis=1, keepdims=True), 0.0, values)
    result = []
    for row, k in zip(*np.nonzero(values[:, 1:] * values[:, :-1] < 0), strict=True):
        low, high, below = places[k], places[k + 1], values[row, k] < 0
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if (function(np.array([middle]))[row, 0] < 0) == below else (low, middle)
        result.append(high)
    exact = places[np.any((values == 0) & np.any(values != 0, axis=1, keepdims=True), axis=0)]
    return np.concatenate([np.array(result), exact[np.isin(exact, places[1:-1])]])


# tolerance of the energy balance across dead positions of the crank, where its angle is ill-conditioned
_ACROSS = 1e-6
_ROWS = 200
_CHECKED_STEPS = 20_000
_STEADY = 1e-10
_SAME_CYCLES = 2
# cycles over which a trend of the speed is looked for, and by which part its limit, or what a cycle adds, may change
_TREND, _SAME_TREND = 12, 1e-3
# how many times the greatest number of steps are certainly too many
_FAR = 2
# after so many steps, the least part of the time that has to be done for more steps to lead to its end
_TRIED_STEPS, _LEAST_DONE = 1000, 0.01
_AT_PERIOD = 1e-9
_ROUNDED = 1e-6
# least rate of the crank by the coordinate: with less, the coordinate is far faster than the crank
_ALL_BUT_DEAD = 1e-3
_NODES, _WEIGHTS, *_ = gauss(8)
# events after which more time changes nothing
_ENDS = frozenset({"comes_to_rest", "steady", "never_steady", "slowly_steady", "many_steps"})


class TransientResults(NamedTuple):
    """Transient motion of a linkage: values, tables over time and of events, checks, notices, tolerances of checks."""

    summary: dict[str, TracedValue]
    listings: dict[str, Listing]
    checks: dict[str, float]
    notices: tuple[Notice, ...]
    allowed: dict[str, float]


def simulate_transient(
    solved: PreparedLinkage,
    motion: Motion,
    travel: CrankRange | None,
    summary: Mapping[str, TracedValue],
    progress: Callable[[float], None] | None = None,
) -> TransientResults:
    """Return the transient motion of a linkage (artobolevsky_1988, ch. 15); empty if none is asked for.

    `motion`: over the crank angle, traced; `travel`: the range of a crank that does not turn fully; `summary`: the
    values so far, such as its flywheel; `progress`: called with the part of the time that is done.
    """
    if solved.machine.transient is None:
        return TransientResults({}, {}, {}, (), {})
    try:
        return _followed(solved, motion, travel, summary, progress)
    except (GeometryError, MethodError) as error:
        return TransientResults({}, {}, {}, (Notice("transient_unfollowed", {"message": error.args[0]}),), {})


def _followed(
    solved: PreparedLinkage,
    motion: Motion,
    travel: CrankRange | None,
    summary: Mapping[str, TracedValue],
    progress: Callable[[float], None] | None,
) -> TransientResults:
    chart = path_coordinate(solved.machine, travel)
    flywheel = summary.get("flywheel_inertia.exact")
    model = TransientModel(solved, chart, flywheel.value if flywheel is not None else 0.0)
    wanted = model.wanted
    start = chart.coordinate(wanted.start)
    rate = float(chart.crank(np.array([start]))[1][0])
    if solved.machine.friction and chart.pieces[0].turns_back:
        raise MethodError(ErrorMessage("transient_rubbing"))
    if abs(rate) < _ALL_BUT_DEAD and (wanted.speed or not rate):
        raise MethodError(ErrorMessage("transient_dead", angle=math.degrees(wanted.start)))
    cycles, integrator = _Cycles(model, progress), Integrator(model.system, start, wanted.speed / rate)
    trajectory = integrator.until(wanted.time, watched=wanted.speeds, each=cycles)
    if not trajectory.steps:
        return TransientResults({}, {}, {}, tuple(_notices(model, trajectory, 0.0)), {})
    checks = {"energy_balance": _missing(model, trajectory)}
    if trajectory.events and trajectory.events[-1].word == "steady":
        checks |= cycles.against(summary)
    end = np.array([trajectory.end])
    (q, q_1, _), (_, v, _) = chart.crank(trajectory.at(end)[0]), trajectory.at(end)
    turn, speed = float(q[0]) - wanted.start, float(q_1[0] * v[0])
    keys = {"transient_time": trajectory.end, "final_turn": turn, "final_speed": speed}
    system, operands = model.system, model.traced(motion, flywheel) if wanted.until == "time" else ()
    replay = TransientReplay(system.breaks, system.stops, system.restitution)
    nodes = [
        FunctionValue(key, "followed", operands, replay, k) if operands else ProcedureValue(key, "followed")
        for k, key in enumerate(keys.values())
    ]
    return TransientResults(
        {key: TracedValue(node, key) for key, node in zip(keys, nodes, strict=True)},
        {"transient": _history(model, trajectory), **_events(chart, trajectory)},
        checks,
        (*_notices(model, trajectory, cycles.steady_after), *_not_yet(model, trajectory)),
        {"energy_balance": _ACROSS} if chart.pieces[0].turns_back else {},
    )


class _Cycles:
    """Passages of the coordinate that a motion started from, and whether it is steady there."""

    def __init__(self, model: TransientModel, progress: Callable[[float], None] | None) -> None:
        self._time, self._progress = model.wanted.time, progress
        self._place, self._period = model.chart.coordinate(model.wanted.start), model.chart.period
        self._until = model.wanted.until
        # the steady-state solution has no friction
        self._has_friction = bool(model.machine.friction)
        self.times, self.rates = [0.0], [model.wanted.speed]
        self.steady_after, self._has_motor = 0.0, model.wanted.motor

    def __call__(self, run: Integrator) -> bool:
        """Return whether the simulation may end."""
        if self._progress is not None:
            self._progress(run.time / self._time)
        if self._until == "rest" or run.is_over:
            return run.is_over
        if self._until == "time" and len(run.trajectory.steps) >= _TRIED_STEPS and run.time < _LEAST_DONE * self._time:
            run.record_event("many_steps")
            return True
        if self._until == "time" or not run.trajectory.steps or math.isinf(self._period):
            return False
        step, turned = run.trajectory.steps[-1], run.trajectory.turned[-1]
        ahead = self._place + self._period * len(self.times) * run.direction - turned
        ended = abs(step.end[0] - ahead) < _AT_PERIOD
        for time in [step.time + step.length] if ended else step.crossings(lambda q, _: q - ahead)[:1]:
            self.times.append(time)
            self.rates.append(float(step.at(np.array(time))[1]))
        last = self.rates[-_SAME_CYCLES - 1 :]
        if len(last) > _SAME_CYCLES and np.ptp(last) <= _STEADY * abs(last[-1]):
            run.record_event("steady")
            return True
        self.steady_after, cycles = self._expected()
        steps = len(run.trajectory.steps) * (1 + cycles / len(self.rates))
        is_late = self.steady_after > self._time or steps > _FAR * MOST_STEPS
        if is_late:
            run.record_event("never_steady" if math.isinf(self.steady_after) else "slowly_steady")
        return is_late

    def _expected(self) -> tuple[float, float]:
        """Return when the last cycles let expect that one repeats the one before, and after how many more. [s], [-]

        Zero where they tell nothing, infinite where each adds the same to the square of the rate.
        """
        rates = np.array(self.rates[-_TREND:])
        if rates.size < _TREND:
            return 0.0, 0.0
        added, change = np.diff(rates**2), np.diff(rates)
        if np.ptp(added) <= _SAME_TREND**2 * abs(added[-1]):
            return math.inf, math.inf
        with np.errstate(divide="ignore", invalid="ignore"):
            share = change[1:] / change[:-1]
            left = change[1:] * share / (1 - share)
        limits = rates[2:] + left
        # the torque of a motor may fall and rise again; without one the speed nears its limit ever more slowly
        is_known = np.ptp(limits) <= _SAME_TREND * abs(left[-1]) or (not self._has_motor and share[-1] > share[0])
        if not (is_known and np.all((share > 0) & (share < 1))):
            return 0.0, 0.0
        cycles = max(0.0, math.log(_STEADY * abs(limits[-1] / change[-1])) / math.log(share[-1]))
        slowest = min(1.0, abs(rates[-1] / limits[-1]))
        return self.times[-1] + cycles * slowest * (self.times[-1] - self.times[-2]), cycles

    def against(self, summary: Mapping[str, TracedValue]) -> dict[str, float]:
        """Return the error of the mean speed of the last cycle against the steady-state solution. [-]"""
        if "steady_speed" not in summary or self._has_friction or len(self.times) <= _SAME_CYCLES:
            return {}
        mean = self._period / (self.times[-1] - self.times[-2])
        return {"steady_cycle": abs(mean / summary["steady_speed"].value - 1)}


def _history(model: TransientModel, trajectory: Trajectory) -> Listing:
    """Return the motion as a table over time: crank, sliding pieces, joint forces, energies."""
    step = model.wanted.step or trajectory.end / _ROWS
    times = np.asarray(np.arange(math.floor(trajectory.end / step * (1 + 1e-12)) + 1) * step, dtype=float)
    times = np.asarray(np.append(times, trajectory.end) if trajectory.end - times[-1] > 1e-9 * step else times)
    u, v, a = trajectory.at(times)
    u = model.chart.off_dead_positions(u)
    crank = model.chart.crank(u)
    speed = crank.position_1 * v
    acceleration = crank.position_1 * a + crank.position_2 * v**2
    columns = {"time": times, "crank_angle": crank.position, "crank_speed": speed, "angular_acceleration": acceleration}
    rest, pivots = _Filled(times.size), names_of_pivots(model.machine.mechanism)
    for piece, index, angle in model.chart.places(u):
        motion = model.moved(piece, angle)
        for name, slide in motion.sliders.items():
            rest.put(f"slider_displacement.{name}", index, slide.position)
            rest.put(f"slider_velocity.{name}", index, slide.position_1 * speed[index])
        rest.put("kinetic_energy", index, kinetic_energy(model.inertia(piece, motion), speed[index]))
        rest.put("potential_energy", index, potential_energy(piece.mechanism, motion, model.machine.loads))
        loads = model.loads(piece, motion, speed[index])
        running = OperatingState(piece.mechanism, motion, speed[index], loads, acceleration[index])
        with np.errstate(divide="ignore", invalid="ignore"):
            friction = friction_forces(running, model.machine.friction) if model.machine.friction else None
        if friction is not None:
            rest.put("friction_power", index, friction.power_loss)
        kind = "joint_force_with_friction" if friction else "joint_force"
        for name, pin in (friction.joint_forces if friction else joint_forces(running)).pins.items():
            rest.put(f"{kind}.{pivots.get(name, name)}", index, pin.resultant)
    rest.columns["driving_torque"] = model.system.drive(speed)
    return Listing(columns | rest.columns)


class _Filled:
    """Columns that are filled branch by branch."""

    def __init__(self, count: int) -> None:
        self.count, self.columns = count, dict[str, Array]()

    def put(self, key: str, rows: NDArray[np.intp], values: Array) -> None:
        self.columns.setdefault(key, np.full(self.count, np.nan))[rows] = values


def _events(chart: PathCoordinate, trajectory: Trajectory) -> dict[str, Listing]:
    """Return the table of events, if there are any."""
    if not trajectory.events:
        return {}
    times, u, v = (
        np.array([getattr(event, name) for event in trajectory.events]) for name in ("time", "coordinate", "rate")
    )
    crank = chart.crank(u)
    counted: Counter[str] = Counter()
    names = []
    for event in trajectory.events:
        counted[event.word] += 1
        names.append(f"{event.word}.{counted[event.word]}")
    columns = {"time": times, "crank_angle": crank.position, "crank_speed": crank.position_1 * v}
    return {"transient_events": Listing(columns, tuple(names))}


def _missing(model: TransientModel, trajectory: Trajectory) -> float:
    """Return the difference of energy gained and work done, over the largest kinetic energy. [-]

    Energies follow from speed and place, the work is the integral of the powers on a grid of its own.
    """
    steps = trajectory.steps[:_CHECKED_STEPS]
    start, length = (np.array([getattr(step, name) for step in steps]) for name in ("time", "length"))
    ends = np.append(start, start[-1] + length[-1])
    known = model.chart.margin(trajectory.at(ends)[0]) > CLOSE
    kinetic, potential = _energies(model, trajectory, np.asarray(ends[known]))
    half = start[:, None] + length[:, None] / 2 * np.arange(2)
    nodes = half[..., None] + length[:, None, None] / 2 * _NODES
    work = (_power(model, trajectory, nodes.ravel()).reshape(nodes.shape) @ _WEIGHTS).sum(axis=1) * length / 2
    lost = _lost_at_stops(model, trajectory)
    struck = np.array([event.time for event in trajectory.events if event.word == "stop"])
    passed = np.searchsorted(struck, np.append(start, -math.inf), side="right")
    passed[-1] = np.count_nonzero(struck < ends[-1])
    done = (np.append(0.0, np.cumsum(work)) - np.append(0.0, np.cumsum(lost))[passed])[known]
    # the rounding of the energies is no error
    largest = max(float(np.max(kinetic)), _ROUNDED * float(np.max(np.abs(potential))))
    return float(np.ptp(kinetic + potential - done)) / largest if largest else 0.0


def _lost_at_stops(model: TransientModel, trajectory: Trajectory) -> Array:
    """Return the kinetic energy that is lost at each stop. [J]"""
    met = [event for event in trajectory.events if event.word == "stop"]
    if not met:
        return np.empty(0)
    u, rate = np.array([item.coordinate for item in met]), np.array([item.rate for item in met])
    inertia = model.system.reduced(model.chart.within(u)[0])[0]
    return np.asarray(kinetic_energy(inertia, rate) * (1 - model.wanted.restitution**2))


def _energies(model: TransientModel, trajectory: Trajectory, times: Array) -> tuple[Array, Array]:
    """Return kinetic and potential energy at some times. [J]"""
    u, v, _ = trajectory.at(times)
    crank, result = model.chart.crank(u), np.empty((2, times.size))
    for piece, index, angle in model.chart.places(u):
        motion = model.moved(piece, angle)
        speed = crank.position_1[index] * v[index]
        result[0, index] = kinetic_energy(model.inertia(piece, motion), speed)
        result[1, index] = potential_energy(piece.mechanism, motion, model.machine.loads)
    return np.asarray(result[0]), np.asarray(result[1])


def _power(model: TransientModel, trajectory: Trajectory, times: Array) -> Array:
    """Return the power of the driver and of the loads without a potential energy. [W]"""
    u, v, a = trajectory.at(times)
    crank = model.chart.crank(u)
    speed, acceleration = crank.position_1 * v, crank.position_1 * a + crank.position_2 * v**2
    power = model.system.drive(speed) * speed
    if (
        not model.machine.friction
        and all(has_potential(load) for load in model.machine.loads)
        and not model.machine.chambers
    ):
        return np.asarray(power)
    for piece, index, angle in model.chart.places(u):
        directions: tuple[Direction, Direction] = (1, -1)
        for direction in directions:
            rows = speed[index] * direction > 0
            if rows.any():
                sorted_ = np.argsort(angle[rows], kind="stable")
                order = index[rows][sorted_]
                motion = model.moved(piece, angle[rows][sorted_], direction)
                loads = model.loads(piece, motion, speed[order], with_potential=False)
                power[order] += reduced_torque(motion, loads) * speed[order]
                power[order] -= _lost(model, piece, motion, (speed[order], acceleration[order]))
    return np.asarray(power)


def _lost(model: TransientModel, piece: PathSegment, motion: Motion, rates: tuple[Array, Array]) -> Array | float:
    """Return the power that friction takes, from the equilibrium of all links at speeds and accelerations. [W]"""
    if not model.machine.friction:
        return 0.0
    loads = model.loads(piece, motion, rates[0])
    running = OperatingState(piece.mechanism, motion, rates[0], loads, rates[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        # without a driving torque there is no efficiency
        return friction_forces(running, model.machine.friction).power_loss


def _notices(model: TransientModel, trajectory: Trajectory, steady_after: float) -> Iterator[Notice]:
    """Yield notices of a start that fails, and of events: the first time of each kind.

    `steady_after`: the time after which it is expected to run steadily. [s]
    """
    missing = _missing_torque(model)
    stays = bool(trajectory.events) and trajectory.events[0].time == 0 and trajectory.events[0].word == "comes_to_rest"
    if missing > 0:
        values: dict[str, float | str] = {"angle": math.degrees(model.wanted.start), "torque": missing}
        yield Notice("transient_stays" if stays else "transient_overcome", values)
    torque = 0.0 if model.wanted.motor or model.wanted.speed < 0 else model.wanted.torque
    if torque < 0:
        yield Notice("transient_backwards", {"torque": torque, "write": -torque})
    counted: Counter[str] = Counter(event.word for event in trajectory.events)
    for word, count in counted.items():
        event = next(event for event in trajectory.events if event.word == word)
        crank = model.chart.crank(np.array([event.coordinate]))
        angle, speed = math.degrees(float(crank.position[0])), float(crank.position_1[0] * event.rate)
        if stays and word == "comes_to_rest":
            if missing <= 0:
                yield Notice("transient_equilibrium", {"angle": angle})
        else:
            expected = steady_after if word == "slowly_steady" else event.time
            limits = {"write": expected, "steps": len(trajectory.steps)}
            code = f"transient_{word}"
            yield Notice(code, {"time": event.time, "angle": angle, "speed": speed, "count": count, **limits})


def _not_yet(model: TransientModel, trajectory: Trajectory) -> Iterator[Notice]:
    """Yield a notice if the time was up before the awaited event."""
    if model.wanted.until != "time" and not _ENDS.intersection(event.word for event in trajectory.events):
        yield Notice(f"transient_not_{model.wanted.until}", {"time": trajectory.end})


def _missing_torque(model: TransientModel) -> float:
    """Return how much more torque on the crank would start a machine at rest the way that it is driven. [N m]"""
    drive = float(model.system.drive(np.zeros(1))[0])
    if not drive or model.wanted.speed:
        return 0.0
    system, start = model.system, model.chart.coordinate(model.wanted.start)
    direction: Direction = 1 if drive * float(system.reduced(np.array([start]))[RATE][0]) > 0 else -1
    u = np.array([system.placed(float(model.chart.within(np.array([start]))[0][0]), direction)])
    inertia, rate = (float(system.reduced(u)[row][0]) for row in (0, RATE))
    acceleration = float(system.acceleration(u, np.zeros(1), direction, *system.stretch(float(u[0]), direction))[0])
    return -direction * acceleration * inertia / abs(rate)
