"""A linkage let go: how it moves in time from a given state, what happens on the way, and where its energy goes."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis.path_coordinate import BESIDE, PathCoordinate, PathSegment, path_coordinate
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
from crankwork.loads.potential import has_potential, potential_energy
from crankwork.locale import ErrorMessage
from crankwork.mechanism.joints import names_of_pivots
from crankwork.shaft.collocation import gauss
from crankwork.shaft.compiled_integrator import TransientReplay
from crankwork.shaft.transient import RATE, Direction, Integrator, Trajectory

# share of the energy that may be missed across dead positions of the crank, beside which its angle says little
_ACROSS = 1e-6
_ROWS = 200
_CHECKED_STEPS = 20_000
_STEADY = 1e-10
_SAME_CYCLES = 2
_AT_PERIOD = 1e-9
_ROUNDED = 1e-6
# of the crank by the coordinate: with less, a speed of the crank is a far greater one of what moves
_ALL_BUT_DEAD = 1e-3
_NODES, _WEIGHTS, *_ = gauss(8)


class TransientResults(NamedTuple):
    """How a linkage went: single values, tables over time and of events, checks, notices, what checks may miss."""

    summary: dict[str, TracedValue]
    listings: dict[str, Listing]
    checks: dict[str, float]
    notices: tuple[Notice, ...]
    allowed: dict[str, float]


def simulate_transient(
    solved: PreparedLinkage,
    motion: Motion,
    found: CrankRange | None,
    summary: Mapping[str, TracedValue],
    progress: Callable[[float], None] | None = None,
) -> TransientResults:
    """Return how a linkage moves in time from where it is let go (artobolevsky_1988, ch. 15); nothing if it is not.

    `motion`: over the crank angle, traced; `found`: the way of a crank that does not turn fully; `summary`: what
    else is known, such as its flywheel; `progress`: told the part of the time that is done.
    """
    if solved.machine.transient is None:
        return TransientResults({}, {}, {}, (), {})
    try:
        return _followed(solved, motion, found, summary, progress)
    except (GeometryError, MethodError) as error:
        return TransientResults({}, {}, {}, (Notice("transient_unfollowed", {"message": error.args[0]}),), {})


def _followed(
    solved: PreparedLinkage,
    motion: Motion,
    found: CrankRange | None,
    summary: Mapping[str, TracedValue],
    progress: Callable[[float], None] | None,
) -> TransientResults:
    chart = path_coordinate(solved.machine, found)
    flywheel = summary.get("flywheel_inertia.exact")
    loose = TransientModel(solved, chart, flywheel.value if flywheel is not None else 0.0)
    wanted = loose.wanted
    start = chart.coordinate(wanted.start)
    rate = float(chart.crank(np.array([start]))[1][0])
    if solved.machine.friction and chart.pieces[0].turns_back:
        raise MethodError(ErrorMessage("transient_rubbing"))
    if abs(rate) < _ALL_BUT_DEAD and (wanted.speed or not rate):
        raise MethodError(ErrorMessage("transient_dead", angle=math.degrees(wanted.start)))
    cycles = _Cycles(loose, progress)
    course = Integrator(loose.felt, start, wanted.speed / rate).until(wanted.time, watched=wanted.speeds, each=cycles)
    if not course.steps:
        return TransientResults({}, {}, {}, tuple(_told(loose, course)), {})
    checks = {"energy_balance": _missing(loose, course)}
    if course.events and course.events[-1].word == "steady":
        checks |= cycles.against(summary)
    end = np.array([course.end])
    (q, q_1, _), (_, v, _) = chart.crank(course.at(end)[0]), course.at(end)
    turn, speed = float(q[0]) - wanted.start, float(q_1[0] * v[0])
    keys = {"transient_time": course.end, "final_turn": turn, "final_speed": speed}
    felt, of = loose.felt, loose.traced(motion, flywheel) if wanted.until == "time" else ()
    by = TransientReplay(felt.breaks, felt.stops, felt.restitution)
    nodes = [
        FunctionValue(key, "followed", of, by, k) if of else ProcedureValue(key, "followed")
        for k, key in enumerate(keys.values())
    ]
    return TransientResults(
        {key: TracedValue(node, key) for key, node in zip(keys, nodes, strict=True)},
        {"transient": _history(loose, course), **_events(chart, course)},
        checks,
        (*_told(loose, course), *_not_yet(loose, course)),
        {"energy_balance": _ACROSS} if chart.pieces[0].turns_back else {},
    )


class _Cycles:
    """Where a motion passes the coordinate that it started from, and whether it is steady there."""

    def __init__(self, loose: TransientModel, progress: Callable[[float], None] | None) -> None:
        self._time, self._progress = loose.wanted.time, progress
        self._place, self._period = loose.chart.coordinate(loose.wanted.start), loose.chart.period
        self._until = loose.wanted.until
        # the steady speed is that without friction
        self._rubs = bool(loose.machine.friction)
        self.times, self.rates = [0.0], [loose.wanted.speed]

    def __call__(self, run: Integrator) -> bool:
        """Return whether enough has been seen."""
        if self._progress is not None:
            self._progress(run.time / self._time)
        if self._until == "rest":
            return run.is_over
        if self._until == "time" or not run.trajectory.steps or math.isinf(self._period):
            return False
        step, turned = run.trajectory.steps[-1], run.trajectory.turned[-1]
        ahead = self._place + self._period * len(self.times) * run.direction - turned
        ended = abs(step.end[0] - ahead) < _AT_PERIOD
        for time in [step.time + step.length] if ended else step.crossings(lambda q, _: q - ahead)[:1]:
            self.times.append(time)
            self.rates.append(float(step.at(np.array(time))[1]))
        last = self.rates[-_SAME_CYCLES - 1 :]
        if len(last) <= _SAME_CYCLES or np.ptp(last) > _STEADY * abs(last[-1]):
            return False
        run.record_event("steady")
        return True

    def against(self, summary: Mapping[str, TracedValue]) -> dict[str, float]:
        """Return by how much the last cycle misses the steady speed that was found without its start. [-]"""
        if "steady_speed" not in summary or self._rubs or len(self.times) <= _SAME_CYCLES:
            return {}
        mean = self._period / (self.times[-1] - self.times[-2])
        return {"steady_cycle": abs(mean / summary["steady_speed"].value - 1)}


def _history(loose: TransientModel, course: Trajectory) -> Listing:
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
    rest, pivots = _Filled(times.size), names_of_pivots(loose.machine.mechanism)
    for piece, here, angle in loose.chart.places(u):
        motion = loose.moved(piece, angle)
        for name, slide in motion.sliders.items():
            rest.put(f"slider_displacement.{name}", here, slide.position)
            rest.put(f"slider_velocity.{name}", here, slide.position_1 * speed[here])
        rest.put("kinetic_energy", here, kinetic_energy(loose.inertia(piece, motion), speed[here]))
        rest.put("potential_energy", here, potential_energy(piece.mechanism, motion, loose.machine.loads))
        loads = loose.loads(piece, motion, speed[here])
        running = OperatingState(piece.mechanism, motion, speed[here], loads, acceleration[here])
        with np.errstate(divide="ignore", invalid="ignore"):
            rubbed = friction_forces(running, loose.machine.friction) if loose.machine.friction else None
        if rubbed is not None:
            rest.put("friction_power", here, rubbed.power_loss)
        kind = "joint_force_with_friction" if rubbed else "joint_force"
        for name, pin in (rubbed.joint_forces if rubbed else joint_forces(running)).pins.items():
            rest.put(f"{kind}.{pivots.get(name, name)}", here, pin.resultant)
    rest.columns["driving_torque"] = loose.felt.drive(speed)
    return Listing(columns | rest.columns)


class _Filled:
    """Columns that are filled branch by branch."""

    def __init__(self, count: int) -> None:
        self.count, self.columns = count, dict[str, Array]()

    def put(self, key: str, rows: NDArray[np.intp], values: Array) -> None:
        self.columns.setdefault(key, np.full(self.count, np.nan))[rows] = values


def _events(chart: PathCoordinate, course: Trajectory) -> dict[str, Listing]:
    """Return the table of what happens; none where nothing does."""
    if not course.events:
        return {}
    times, u, v = (
        np.array([getattr(event, name) for event in course.events]) for name in ("time", "coordinate", "rate")
    )
    crank = chart.crank(u)
    counted: Counter[str] = Counter()
    names = []
    for event in course.events:
        counted[event.word] += 1
        names.append(f"{event.word}.{counted[event.word]}")
    columns = {"time": times, "crank_angle": crank.position, "crank_speed": crank.position_1 * v}
    return {"transient_events": Listing(columns, tuple(names))}


def _missing(loose: TransientModel, course: Trajectory) -> float:
    """Return by how much energy gained and work done differ, over the largest kinetic energy. [-]

    Energies are those of speed and place, the work that of powers between, on a grid of its own.
    """
    steps = course.steps[:_CHECKED_STEPS]
    start, length = (np.array([getattr(step, name) for step in steps]) for name in ("time", "length"))
    ends = np.append(start, start[-1] + length[-1])
    known = loose.chart.beside(course.at(ends)[0]) > BESIDE
    kinetic, potential = _energies(loose, course, np.asarray(ends[known]))
    half = start[:, None] + length[:, None] / 2 * np.arange(2)
    nodes = half[..., None] + length[:, None, None] / 2 * _NODES
    work = (_power(loose, course, nodes.ravel()).reshape(nodes.shape) @ _WEIGHTS).sum(axis=1) * length / 2
    lost = _lost_at_stops(loose, course)
    struck = np.array([event.time for event in course.events if event.word == "stop"])
    passed = np.searchsorted(struck, np.append(start, -math.inf), side="right")
    passed[-1] = np.count_nonzero(struck < ends[-1])
    done = (np.append(0.0, np.cumsum(work)) - np.append(0.0, np.cumsum(lost))[passed])[known]
    # what the energies are rounded to is nothing to be missed
    largest = max(float(np.max(kinetic)), _ROUNDED * float(np.max(np.abs(potential))))
    return float(np.ptp(kinetic + potential - done)) / largest if largest else 0.0


def _lost_at_stops(loose: TransientModel, course: Trajectory) -> Array:
    """Return what each stop takes of the kinetic energy. [J]"""
    met = [event for event in course.events if event.word == "stop"]
    if not met:
        return np.empty(0)
    u, rate = np.array([item.coordinate for item in met]), np.array([item.rate for item in met])
    inertia = loose.felt.reduced(loose.chart.within(u)[0])[0]
    return np.asarray(kinetic_energy(inertia, rate) * (1 - loose.wanted.restitution**2))


def _energies(loose: TransientModel, course: Trajectory, times: Array) -> tuple[Array, Array]:
    """Return kinetic and potential energy at some times. [J]"""
    u, v, _ = course.at(times)
    crank, result = loose.chart.crank(u), np.empty((2, times.size))
    for piece, here, angle in loose.chart.places(u):
        motion = loose.moved(piece, angle)
        speed = crank.position_1[here] * v[here]
        result[0, here] = kinetic_energy(loose.inertia(piece, motion), speed)
        result[1, here] = potential_energy(piece.mechanism, motion, loose.machine.loads)
    return np.asarray(result[0]), np.asarray(result[1])


def _power(loose: TransientModel, course: Trajectory, times: Array) -> Array:
    """Return the power of the driver and of the loads without a potential energy. [W]"""
    u, v, a = course.at(times)
    crank = loose.chart.crank(u)
    speed, acceleration = crank.position_1 * v, crank.position_1 * a + crank.position_2 * v**2
    power = loose.felt.drive(speed) * speed
    if (
        not loose.machine.friction
        and all(has_potential(load) for load in loose.machine.loads)
        and not loose.machine.chambers
    ):
        return np.asarray(power)
    for piece, here, angle in loose.chart.places(u):
        ways: tuple[Direction, Direction] = (1, -1)
        for way in ways:
            rows = speed[here] * way > 0
            if rows.any():
                sorted_ = np.argsort(angle[rows], kind="stable")
                order = here[rows][sorted_]
                motion = loose.moved(piece, angle[rows][sorted_], way)
                loads = loose.loads(piece, motion, speed[order], with_potential=False)
                power[order] += reduced_torque(motion, loads) * speed[order]
                power[order] -= _lost(loose, piece, motion, (speed[order], acceleration[order]))
    return np.asarray(power)


def _lost(loose: TransientModel, piece: PathSegment, motion: Motion, rates: tuple[Array, Array]) -> Array | float:
    """Return the power that friction takes, from the equilibrium of all links at speeds and accelerations. [W]"""
    if not loose.machine.friction:
        return 0.0
    loads = loose.loads(piece, motion, rates[0])
    running = OperatingState(piece.mechanism, motion, rates[0], loads, rates[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        # nothing drives, and there is no efficiency
        return friction_forces(running, loose.machine.friction).power_loss


def _told(loose: TransientModel, course: Trajectory) -> Iterator[Notice]:
    """Yield what keeps it from starting, and what happens on the way: the first time of each."""
    missing = _missing_torque(loose)
    stays = bool(course.events) and course.events[0].time == 0 and course.events[0].word == "comes_to_rest"
    if missing > 0:
        values: dict[str, float | str] = {"angle": math.degrees(loose.wanted.start), "torque": missing}
        yield Notice("transient_stays" if stays else "transient_overcome", values)
    counted: Counter[str] = Counter(event.word for event in course.events)
    for word, count in counted.items():
        event = next(event for event in course.events if event.word == word)
        crank = loose.chart.crank(np.array([event.coordinate]))
        angle, speed = math.degrees(float(crank.position[0])), float(crank.position_1[0] * event.rate)
        if stays and word == "comes_to_rest":
            if missing <= 0:
                yield Notice("transient_equilibrium", {"angle": angle})
        else:
            yield Notice(f"transient_{word}", {"time": event.time, "angle": angle, "speed": speed, "count": count})


def _not_yet(loose: TransientModel, course: Trajectory) -> Iterator[Notice]:
    """Yield that the time was up before what was waited for."""
    waited = {"rest": "comes_to_rest", "steady": "steady"}.get(loose.wanted.until)
    if waited is not None and all(event.word != waited for event in course.events):
        yield Notice(f"transient_not_{loose.wanted.until}", {"time": course.end})


def _missing_torque(loose: TransientModel) -> float:
    """Return what more torque on the crank would start a machine at rest the way that it is driven. [N m]"""
    drive = float(loose.felt.drive(np.zeros(1))[0])
    if not drive or loose.wanted.speed:
        return 0.0
    felt, start = loose.felt, loose.chart.coordinate(loose.wanted.start)
    way: Direction = 1 if drive * float(felt.reduced(np.array([start]))[RATE][0]) > 0 else -1
    u = np.array([felt.placed(float(loose.chart.within(np.array([start]))[0][0]), way)])
    inertia, rate = (float(felt.reduced(u)[row][0]) for row in (0, RATE))
    return (
        -way * float(felt.acceleration(u, np.zeros(1), way, *felt.stretch(float(u[0]), way))[0]) * inertia / abs(rate)
    )
