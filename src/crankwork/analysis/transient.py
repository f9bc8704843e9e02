"""Transient motion of a linkage: how it moves in time from a given state, its events, and its energy balance."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis.path_coordinate import CLOSE, PathCoordinate, PathSegment, path_coordinate
from crankwork.analysis.prepared import Notice, PreparedLinkage
from crankwork.analysis.results import Listing
from crankwork.analysis.transient_model import TransientModel
from crankwork.dynamics.friction import friction_forces
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.operating_state import OperatingState
from crankwork.dynamics.reduction import kinetic_energy, reduced_torque
from crankwork.errors import GeometryError, MethodError
from crankwork.formula.traced_value import FunctionValue, ProcedureValue, TracedValue
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.crank_range import CrankRange
from crankwork.kinematics.motion import Motion
from crankwork.loads.load import has_potential, potential_energy
from crankwork.locale import ErrorMessage
from crankwork.mechanism.joints import names_of_pivots
from crankwork.shaft.collocation import gauss
from crankwork.shaft.compiled_integrator import TransientReplay
from crankwork.shaft.transient import MOST_STEPS, RATE, Direction, Integrator, Trajectory

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
