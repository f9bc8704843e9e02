"""From a linkage to its results over one revolution: motion, reduced inertia, torques, joint forces, speed."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import replace
from functools import cache, partial
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.analysis.bearings import ON_CRANKPIN, BearingCycle
from crankwork.analysis.counterweight_balance import counterweight_balance
from crankwork.analysis.gas_chambers import gas_check, gas_summary
from crankwork.analysis.given_motion import DYNAMICS
from crankwork.analysis.harmonics import delivered_harmonics, listed_harmonics
from crankwork.analysis.joint_bearings import FOLLOWED as BEARING_COLUMNS
from crankwork.analysis.joint_bearings import JointBearings, bearings_of
from crankwork.analysis.joint_friction import COLUMNS as FRICTION
from crankwork.analysis.joint_friction import FOLLOWED as FOLLOWED_FRICTION
from crankwork.analysis.joint_friction import FrictionColumns, add_friction, mean_values
from crankwork.analysis.mechanism_trace import linkage_trace, traced_state
from crankwork.analysis.motion_range import (
    SingularColumns,
    clear_of_changes,
    find_singular_columns,
    limits_of,
    rows_inside,
    with_limits,
)
from crankwork.analysis.motor_choice import motor_of_crank
from crankwork.analysis.operating_state import operating_state
from crankwork.analysis.pump_flow import COLUMNS as FLOWS
from crankwork.analysis.pump_flow import flow_columns, flow_values
from crankwork.analysis.results import Deferred, Results
from crankwork.analysis.rod_load import COLUMNS as ROD_LOADS
from crankwork.analysis.rod_load import rod_load_columns, rod_load_notices, rod_load_values
from crankwork.analysis.speed import (
    SpeedResults,
    analyse_speed,
    balance_of,
    driven_by_motor,
    has_flywheel,
    has_friction,
)
from crankwork.analysis.stages import stage_checks, stage_listing, stage_notices
from crankwork.analysis.transient import simulate_transient
from crankwork.analysis.transmission_quality import (
    FOLLOWED,
    limits_of_transmissions,
    quality_of,
    rocks,
    smooth_transmissions,
    time_ratios,
)
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.routes import TORQUE_METHODS, torque_by_groups
from crankwork.errors import CrankworkError
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import ProcedureValue, TracedValue, given
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.crank_range import pass_change_points
from crankwork.kinematics.instant_centres import absent_where_still, pivoted_links
from crankwork.kinematics.motion import Motion, linkage_motion
from crankwork.kinematics.motion_laws import rate_jumps
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.mechanism.driver import Law, LinkMotor
from crankwork.mechanism.dyads import RRR
from crankwork.mechanism.mechanism import Crank, Driver
from crankwork.mechanism.structure import FourBarType, grashof, mobility
from crankwork.preparation import traced_inputs
from crankwork.preparation.equal_cells import with_equal_columns
from crankwork.preparation.linkage import speed_of, traced_linkage
from crankwork.preparation.prepared import Notice, PreparedLinkage
from crankwork.preparation.reachable_motion import ReachableMotion, find_reachable_motion, open_range
from crankwork.quantities.key import key_of

_DENSE_STEP = 1.0
_NO_TRAVEL = 1e-12
_TRAVEL = {"slider_displacement": "slider_stroke", "link_angle": "link_swing"}
_EXTENT = {"point_x": "path_width", "point_y": "path_height"}
_TURNING = ("link_angular_velocity", "link_angular_acceleration")
# quantities without a sign, whose least value is of no use
_SIZES = ("joint_force", "joint_force_with_friction", "friction_power", "gas_pressure", "shaking_force")
_STATIC_EXTREMES = ("static_torque_max", "static_torque_min")
_MOST_COEFFICIENTS = 10_000_000
_OF_DRIVER = (
    "driver_displacement", "driver_velocity", "driver_acceleration", "driver_angle", "driver_speed",
    "driver_angular_acceleration", "driver_jerk", "driver_angular_jerk",
    "driver_force", "driver_torque", "driver_power",
)  # fmt: skip
# how far from a change point the routes are compared, which lose their digits in it [deg]
_SIDE_STEP = 0.05


def four_bar_type(machine: Machine) -> FourBarType | Literal[""]:
    """Return the type of a four-bar linkage by Grashof, empty for any other linkage."""
    crank, ground = machine.mechanism.driver, machine.mechanism.ground
    if not isinstance(crank, Crank):
        return ""
    match machine.mechanism.dyads:
        case (RRR() as dyad,) if {dyad.joint_a, dyad.joint_b} & set(ground):
            coupler, rocker, fixed = dyad.length_a, dyad.length_b, dyad.joint_b
            if dyad.joint_a in ground:
                coupler, rocker, fixed = rocker, coupler, dyad.joint_a
            return grashof(crank.radius, coupler, rocker, math.dist(ground[fixed], crank.pivot)).type
    return ""


def analyse_linkage(
    machine: Machine, grid: CrankGrid | None = None, progress: Callable[[float], None] | None = None
) -> Results:
    """Return all results of a linkage over one cycle: a revolution, or two of some gas.

    Columns, summary, checks and notices; of a crank that does not turn fully between its dead positions. `grid`:
    ascending crank angles within one cycle; the machine's own table otherwise [rad]; `progress`: as `analyse` takes it.
    """
    moved = _moved(machine, grid)
    machine, reached, motion, solved = moved.machine, moved.reached, moved.motion, moved.solved
    trace, friction, table, result = moved.trace, moved.friction, moved.table, reached.travel
    over, summary, cycle_notices, unusual, program = _singles(moved, trace)
    notices = reached.notices + tuple(Notice(*notice) for notice in solved.filling.notices)
    notices += friction.notices + cycle_notices
    checks = (
        _checks(solved, clear_of_changes(machine.mechanism, reached.motion))
        | gas_check(solved, motion)
        | friction.checks
    )
    between = {"mobility": mobility(machine.whole)}
    if result is None and "reduced_inertia" in trace:
        for turn in _turns(machine, over, {**trace, **summary}):
            trace |= turn.columns
            checks |= turn.checks
            summary |= {key: value.named(key) for key, value in turn.summary.items()}
            between |= turn.between
            notices += turn.notices
    if moved.has_steady_crank:
        largest = max(abs(summary[key].value) if key in summary else 0.0 for key in _STATIC_EXTREMES)
        summary |= motor_of_crank(machine, summary.get("mean_torque"), speed_of(machine), largest)
    mechanism = machine.mechanism
    if moved.has_steady_crank and "shaking_force" in trace:
        balance = counterweight_balance(mechanism.crank, trace | summary, mechanism.period)
        summary |= {key: known.named(key) for key, known in balance}
    components = moved.bearings.of_journals
    cycle = BearingCycle(
        moved.bearings.loaded(machine, over),
        components,
        over,
        lambda grid: dict(zip(components, program.rows(grid, components), strict=True)),
        machine.cycle,
        machine.bearings.rays,
    )
    summary |= cycle.summary()
    ran = simulate_transient(solved, motion, result, summary, progress)
    summary, checks = summary | ran.summary, checks | ran.checks
    notices += ran.notices + tuple(_of_machine(machine)) + tuple(stage_notices(summary))
    notices += tuple(rod_load_notices(summary, machine))
    checks |= stage_checks(summary)
    # change points have a notice of their own
    notices += () if machine.mechanism.passages else unusual
    columns = absent_where_still(Program(trace)(table))
    if result is not None:
        columns = with_limits(columns, trace, result, table)
    # instant centres of links that never turn
    none = {key for key, value in columns.items() if key.startswith("instant_centre_") and np.isnan(value).all()}
    columns = {key: value for key, value in columns.items() if key not in none}
    trace = {key: value for key, value in trace.items() if key not in none}
    values = {key: value.value for key, value in summary.items()}
    trace |= {**summary, **between}
    harmonics = cache(partial(_harmonics, moved, over))
    deferred = Deferred(trace, lambda: {**moved.bearings.between, **cycle.values} | harmonics())
    listings = Deferred(
        {**ran.listings, **stage_listing(summary)}, lambda: cycle.listings() | listed_harmonics(harmonics())
    )
    return Results(solved, table, columns, values, checks, notices, _groups(columns), listings, ran.allowed, deferred)


def _harmonics(moved: _Moved, over: CycleInterpolant) -> dict[str, TracedValue]:
    """Return the harmonics of the driving torque of a crank at a steady speed."""
    machine = moved.machine
    return delivered_harmonics(over, machine.cycle, machine.mechanism.crank.radius) if moved.has_steady_crank else {}


def _turns(machine: Machine, over: CycleInterpolant, trace: Mapping[str, TracedValue]) -> Iterator[SpeedResults]:
    """Yield the speed fluctuation if a flywheel is given or wanted, and the results of a motor if there is one."""
    drive, w, mean = machine.drive, speed_of(machine), trace.get("mean_torque")
    if not has_flywheel(drive) and drive.motor is None:
        return
    added = 0.0
    if has_flywheel(drive):
        balance = balance_of(machine, over, trace)
        turn = analyse_speed(machine, balance, w, mean)
        yield turn
        added = turn.added
    if drive.motor is not None:
        # the motor drives through the efficiency
        balance = balance_of(machine, over, trace, counts_efficiency=False)
        yield driven_by_motor(machine, drive.motor, balance, w, mean, added)


def linkage_columns(machine: Machine) -> Results:
    """Return the columns of a linkage over the crank angle, without the values of its whole cycle."""
    moved = _moved(machine, None)
    return Results(moved.solved, moved.table, {}, {}, {}, (), {}, trace=moved.trace)


def linkage_value(machine: Machine, key: str) -> Results:
    """Return the values over the cycle of the one link, joint or point that a key names; no checks, and no table."""
    moved, name = _moved(machine, None), key_of(key).owner
    of_one = {key: known for key, known in moved.trace.items() if key_of(key).owner == name}
    summary = _singles(moved, of_one, name).summary
    values = {key: known.value for key, known in summary.items()}
    return Results(moved.solved, moved.table, {}, values, {}, (), {}, trace=of_one | summary)


class _Singles(NamedTuple):
    """Single values over the whole cycle of a linkage, and notices: of the values, and of what is unusual."""

    over: CycleInterpolant
    summary: dict[str, TracedValue]
    notices: tuple[Notice, ...]
    unusual: tuple[Notice, ...]
    program: Program  # Of the columns over the cycle, and of the loads of crankpins and main journals


def _singles(moved: _Moved, trace: Mapping[str, TracedValue], name: str | None = None) -> _Singles:
    """Return the single values that follow from traced columns; `name`: of one link, joint or point only."""
    machine, result = moved.machine, moved.reached.travel
    quality = dict(smooth_transmissions(machine.mechanism, moved.motion.bar, moved.motion.frames))
    quality = with_equal_columns(quality, machine.mechanism, moved.motion.equal_parts)
    quality = {key: value for key, value in quality.items() if name is None or key_of(key).owner == name}
    pivoted = pivoted_links(machine.mechanism)
    followed = _followed(trace, pivoted, has_friction=moved.friction.is_free) | quality
    measured = [f"{kind}.{point}" for point in machine.extents for kind in _EXTENT]
    followed |= {key: trace[key] for key in measured if key in trace}
    notices = list[Notice]()
    start, end = (0.0, machine.cycle) if result is None else machine.working_range or open_range(result)
    ends = singular_ends(machine, None if result is None else (result.start, result.end))
    without = find_singular_columns(followed, *ends, machine.cycle if result is None else result.end - result.start)
    notices += _singular_notices(without)
    if machine.working_range is None or result is None:
        followed = {key: value for key, value in followed.items() if not any(key in part for part in without)}
    else:
        notices.append(Notice("working_range", {"from": start, "to": end}))
    if name is None:
        followed |= moved.bearings.followed(followed)
    program = Program({**followed, **moved.bearings.of_journals})
    over = CycleInterpolant(followed, CrankGrid.from_degrees, end - start, start, program=program)
    limits = limits_of_transmissions(result) if result is not None and machine.working_range is None else {}
    extremes, unusual = quality_of(over, limits)
    law = machine.mechanism.driver.law
    of_instant = law is not None and law.is_instant
    summary = {} if of_instant else _summary(moved.solved, over, extremes, is_whole=result is None)
    summary |= rod_load_values(machine, over) if result is None else limits_of(result, trace)
    summary |= flow_values(machine, over)
    return _Singles(over, summary, tuple(notices), unusual, program)


class _Moved(NamedTuple):
    """A linkage in motion: how far it reaches, and its traced columns over the crank angle."""

    machine: Machine
    reached: ReachableMotion
    motion: Motion
    solved: PreparedLinkage
    trace: dict[str, TracedValue]
    friction: FrictionColumns
    table: CrankGrid
    bearings: JointBearings

    @property
    def has_steady_crank(self) -> bool:
        """Whether a crank turns fully at the speed that is stated."""
        driver = self.machine.mechanism.driver
        return self.reached.travel is None and isinstance(driver, Crank) and driver.law is None


def _moved(machine: Machine, grid: CrankGrid | None) -> _Moved:
    mechanism, travel = pass_change_points(machine.mechanism, machine.way)
    machine = replace(machine, mechanism=mechanism, way=travel or machine.way)
    reached = find_reachable_motion(machine, _DENSE_STEP)
    table = _table(machine, reached, grid)
    motion, solved = traced_linkage(machine, reached.motion)
    running = traced_state(solved, motion)
    trace = with_equal_columns(linkage_trace(solved, running), machine.mechanism, motion.equal_parts)
    friction = add_friction(solved, running, trace)
    bearings = bearings_of(machine, running.motion, trace) if reached.travel is None else JointBearings()
    trace |= {**friction.columns, **bearings.columns, **rod_load_columns(solved, running, trace)}
    trace |= flow_columns(solved, trace)
    return _Moved(machine, reached, motion, solved, trace, friction, table, bearings)


def _of_machine(machine: Machine) -> Iterator[Notice]:
    """Yield notices of redundant links, with unknown shares or not, of gears without teeth, and of a law."""
    for item in machine.redundant:
        freedom = float(mobility(machine.whole).value)
        if item.share is None:
            yield Notice("redundant_unshared", {"name": item.member.name, "mobility": freedom})
        else:
            yield Notice(
                "redundant",
                {"name": item.member.name, "mobility": freedom, "share": item.share, "other": item.reference},
            )
    driver = machine.mechanism.driver
    if isinstance(driver, Crank) and any(item.pressure_angle is None for item in driver.geared):
        yield Notice("geared", {})
    if driver.law is not None:
        yield Notice("instant" if driver.law.is_instant else "by_law", {})
        jumps = rate_jumps(driver.law, turns=driver.turns)
        for number, before, after in jumps[:1]:
            time = driver.law.period * math.fsum(segment.share for segment in driver.law.segments[:number])
            names = {"path": f"driver.law[{number}]", "quantity": "driver_speed" if driver.turns else "driver_velocity"}
            yield Notice("law_jump", {**names, "before": before, "after": after, "time": time, "count": len(jumps)})


def _table(machine: Machine, reached: ReachableMotion, grid: CrankGrid | None) -> CrankGrid:
    """Return the crank angles of the table, of a crank that turns back those between its dead positions."""
    requested = grid or CrankGrid.steps(machine.table_step, machine.cycle, special=machine.table_special)
    if reached.travel is None:
        return requested
    inside = rows_inside(reached.travel, requested.degrees)
    if grid is None and len(inside) == 0:
        return reached.grid
    if len(inside) == 0:
        raise CrankworkError(ErrorMessage("table_unreached", low=reached.travel.start, high=reached.travel.end))
    return inside


def singular_ends(machine: Machine, ends: tuple[float, float] | None) -> tuple[list[float], list[float]]:
    """Return the crank angles at which columns may grow beyond all bounds, and on which side of them the motion is.

    `ends`: the limits of a crank that turns back. [deg]
    """
    if ends is not None:
        return [*ends], [1.0, -1.0]
    passages = machine.mechanism.passages.values()
    changes = sorted({change for passage in passages for change in passage.changes if 0.0 <= change <= machine.cycle})
    return changes, [-1.0 if change == machine.cycle else 1.0 for change in changes]


def _singular_notices(columns: SingularColumns) -> Iterator[Notice]:
    """Yield notices of columns that grow beyond all bounds, and of columns without a value."""
    if columns.unbounded:
        yield Notice("unbounded", _where(columns.unbounded))
    if columns.undetermined:
        yield Notice("undetermined", _where(columns.undetermined))


def _where(columns: Mapping[str, tuple[float, ...]]) -> dict[str, float | str]:
    """Return the kinds of singular columns, and the crank angles of the singularities."""
    kinds = dict.fromkeys(key_of(key).quantity for key in columns)
    angles = sorted({angle for column in columns.values() for angle in column})
    return {"angles": "°, ".join(f"{angle:.6g}" for angle in angles), "quantities": ", ".join(kinds)}


def _followed(
    trace: Mapping[str, TracedValue], pivoted: Collection[str], *, has_friction: bool
) -> dict[str, TracedValue]:
    """Return the columns that single values are taken from; those with friction where it locks nowhere.

    `pivoted`: links that turn about fixed pivots, whose rates are included.
    """
    kinds = (
        "slider_displacement", "slider_velocity", "slider_acceleration", "link_angle", "joint_force", "tooth_force",
        "axial_force", "gas_pressure", "gas_force", *ROD_LOADS, *FLOWS, *_OF_DRIVER, "shaking_force",
        *(FOLLOWED_FRICTION if has_friction else ()),
    )  # fmt: skip
    turning = {f"{kind}.{name}" for kind in _TURNING for name in pivoted}
    return {
        key: value
        for key, value in trace.items()
        if key in DYNAMICS or key_of(key).quantity in kinds or (key in turning and value.varies)
    }


def _summary(
    solved: PreparedLinkage, over: CycleInterpolant, quality: Mapping[str, TracedValue], *, is_whole: bool
) -> dict[str, TracedValue]:
    machine, law = solved.machine, solved.machine.mechanism.driver.law
    result = {**_given_values(machine), **quality}
    elsewhere = (*FOLLOWED, *BEARING_COLUMNS)
    keys = [key for key in over.columns if key_of(key).quantity not in elsewhere and not over.is_zero(key)]
    extremes, pivoted = over.extremes(*keys), pivoted_links(machine.mechanism)
    for key in keys:
        kind, name = key_of(key)
        largest, least = (extremes[key_of(key).derived(ending)] for ending in ("_max", "_min"))
        travel, is_place = largest - least, kind in _TRAVEL
        size = 1.0 if kind == "link_angle" else max(abs(largest.value), abs(least.value))
        if is_place and travel.value <= _NO_TRAVEL * size:
            # a travel of rounding errors is zero
            travel = TracedValue(ProcedureValue(0.0, "range", (largest, least)))
        # a crank that turns back has limits instead
        if is_place and not is_whole:
            continue
        if is_place and (kind == "slider_displacement" or travel.value < math.pi):
            result[f"{_TRAVEL[kind]}.{name}"] = travel
        if not is_place or rocks(pivoted, key, travel.value):
            for word in ("max",) if kind in _SIZES else ("max", "min"):
                extreme, place = (key_of(key).derived(ending) for ending in (f"_{word}", f"_{word}_angle"))
                result[extreme] = extremes[extreme]
                result |= _at_time(extreme, extremes[place], law) if law else {place: extremes[place]}
    if is_whole and law is None:
        result |= time_ratios(over, {key: value.named(key) for key, value in result.items()})
    if (machine.loads or machine.chambers) and is_whole and law is None and "static_torque" in over.columns:
        # inertia does no work in a cycle, friction does
        torque = "torque_with_friction" if has_friction(machine.drive, over) else "static_torque"
        needed = over.mean(torque, "mean_driving_torque")
        # an engine gives torque, which is stated as positive
        result["mean_torque"] = needed if needed.value >= 0 else (-needed).named("mean_torque")
    if is_whole:
        result |= {mean_value.key: mean_value for mean_value in mean_values(over)}
    result |= gas_summary(solved) | _extents(extremes)
    return {key: value if key == "mean_torque" else value.named(key) for key, value in result.items()}


def _extents(extremes: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return width and height of the paths of points that are followed."""
    ends = {key: key_of(key) for key in extremes if key.startswith(("point_x_max.", "point_y_max."))}
    return {
        f"{_EXTENT[end.quantity[:7]]}.{end.owner}": extremes[key] - extremes[key.replace("_max", "_min", 1)]
        for key, end in ends.items()
    }


def _given_values(machine: Machine) -> dict[str, TracedValue]:
    """Return speed, acceleration and efficiency of a crank, or the period of a law."""
    law = machine.mechanism.driver.law
    if law is not None:
        return {"period": given("period", law.period, "driver.period")}
    eps = traced_inputs.acceleration(machine)
    changing = {} if eps.is_absent else {eps.key: eps}
    return traced_inputs.speeds(machine, speed_of(machine)) | changing | traced_inputs.efficiency(machine.drive)


def _at_time(extreme: str, angle: TracedValue, law: Law) -> dict[str, TracedValue]:
    """Return the time of an extreme from its angle in the period. [s]"""
    key, node = key_of(extreme).derived("_time"), angle.node
    if not isinstance(node, ProcedureValue) or node.at is None:
        return {}
    time, word = node.at / 360.0 * law.period, node.word.replace("angle", "time")
    share = angle * given("", law.period, "driver.period") / math.tau
    return {key: TracedValue(ProcedureValue(time, word, node.operands, node.at, share))}


def _checks(solved: PreparedLinkage, motion: Motion) -> dict[str, float]:
    """Return how far four independent routes to the balancing torque differ, relative to the forces."""
    if not (solved.machine.mechanism.bodies or solved.machine.loads or solved.machine.chambers):
        return {}
    running, grid = operating_state(solved, motion), motion.grid
    values = joint_forces(running)
    reference = values.balancing_torque
    rows = _stride(grid, len(solved.machine.drawn.members))
    part = operating_state(solved, linkage_motion(solved.machine.mechanism, grid[rows]))
    # forces without work cancel only up to their own rounding, so a torque of zero is measured by them
    sizes = [float(np.max(pin.resultant)) for pin in values.pins.values()]
    turning = _lever(solved.machine.mechanism.driver) * max(sizes, default=0.0)
    scale = max(float(np.max(np.abs(reference))), turning) or 1.0
    residuals = {
        name: route(part) - reference[rows] if name == "whole_system" else route(running) - reference
        for name, route in TORQUE_METHODS.items()
    }
    return {name: float(np.max(np.abs(value))) / scale for name, value in residuals.items()}


def _lever(driver: Driver) -> float:
    """Return the lever arm from a joint force to the torque of the driver, or 1 for a driver with a force."""
    match driver:
        case Crank(radius=radius):
            return radius
        case LinkMotor(sides=sides):
            return max(sides)
    return 1.0


class TorqueByRoutes(NamedTuple):
    """The balancing torque by every route, arrays of shape (n,) [N m], and how far they are apart. [-]"""

    torques: Mapping[str, Array]
    differences: Array


def torque_by_routes(results: Results, degrees: ArrayLike) -> TorqueByRoutes:
    """Return the balancing torque by five routes; at a change point the mean of both sides of it."""
    solved: PreparedLinkage = results.solved
    angles, mechanism = np.atleast_1d(np.asarray(degrees, dtype=float)), solved.machine.mechanism
    changes = np.array([change for passage in mechanism.passages.values() for change in passage.changes])
    offset = np.zeros_like(angles)
    if changes.size:
        offset[np.abs(angles[:, None] - changes).min(axis=1) < _SIDE_STEP] = _SIDE_STEP
    sides = []
    for side in (1.0, -1.0) if offset.any() else (0.0,):
        running = operating_state(solved, linkage_motion(mechanism, CrankGrid.from_degrees(angles + side * offset)))
        sides.append(
            {"by_groups": torque_by_groups(running), **{name: route(running) for name, route in TORQUE_METHODS.items()}}
        )
    torques = {name: np.mean([side[name] for side in sides], axis=0) for name in sides[0]}
    return TorqueByRoutes(torques, differences(list(torques.values())))


def differences(routes: list[Array]) -> Array:
    """Return how far routes are apart at each position, relative to the largest torque of the turn. [-]"""
    torques = np.array(routes)
    return np.asarray(np.ptp(torques, axis=0) / (float(np.max(np.abs(torques))) or 1.0))


def _stride(grid: CrankGrid, links: int) -> slice:
    """Return the rows at which the system of all links is solved: all, or as many as the memory allows."""
    return slice(None, None, math.ceil(len(grid) * (3 * max(links, 1)) ** 2 / _MOST_COEFFICIENTS))


def _groups(columns: Mapping[str, Array]) -> dict[str, tuple[str, ...]]:
    """Return the keys of each table."""
    kinds = {
        "points": ("point_x", "point_y", "point_velocity_x", "point_velocity_y", "point_velocity",
                   "point_acceleration_x", "point_acceleration_y", "point_acceleration"),
        "links": ("link_angle", "link_angular_velocity", "link_angular_acceleration",
                  "slider_displacement", "slider_velocity", "slider_acceleration", "coriolis_acceleration",
                  "transmission_angle", "pressure_angle", "instant_centre_x", "instant_centre_y"),
        "balance": ("shaking_force_x", "shaking_force_y", "shaking_force", "shaking_moment"),
        "speed": ("crank_speed", "kinetic_energy_change"),
        "chambers": ("cylinder_volume", "diagram_pressure", "gas_pressure", "gas_force", *ROD_LOADS, *FLOWS),
        "friction": FRICTION,
        "joint_forces": ("joint_force_x", "joint_force_y", "joint_force", "tooth_force", "separating_force",
                         "axial_force", "normal_force",
                         "normal_moment"),
        "bearings": ON_CRANKPIN,
        "main_journals": ("main_journal_load",),
    }  # fmt: skip
    groups = {name: tuple(key for key in columns if key_of(key).quantity in keys) for name, keys in kinds.items()}
    return {"driver": _OF_DRIVER, "dynamics": DYNAMICS, **groups}
