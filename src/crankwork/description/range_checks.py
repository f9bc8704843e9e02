"""The range of motion of a described linkage: what blocks it, and what in its description depends on it."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from crankwork.analysis.motion_range import ReachableMotion, find_reachable_motion, open_range
from crankwork.description.schema import Values
from crankwork.description.value_types import Reader
from crankwork.dynamics.reduction import reduced_inertia
from crankwork.errors import GeometryError, Problem
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.kinematics.assembly import first_failure
from crankwork.kinematics.configuration_curve import EQUAL
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.crank_range import (
    CrankRange,
    find_crank_range,
    has_steady_crank,
    pass_change_points,
    turns_fully,
)
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.position_analysis import place
from crankwork.kinematics.traced_motion import traced_motion
from crankwork.loads.curves import LoadCurve
from crankwork.loads.load import Load, applied_loads
from crankwork.loads.process import ProcessForce
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.decomposition import mechanism_of
from crankwork.mechanism.linkage import GROUND, Linkage, Member
from crankwork.mechanism.mechanism import Crank, Mechanism, period_in_turns

_STEP = 1.0


def with_crank_range(mechanism: Mechanism) -> tuple[Mechanism, CrankRange | None]:
    """Return a linkage that passes its change points, and its crank range; if not assembled, that is reported later."""
    try:
        return pass_change_points(mechanism)
    except GeometryError:
        return mechanism, None


def explain_redundant(linkage: Linkage, problems: list[Problem]) -> list[Problem]:
    """Return problems; that of a redundant link says whether the link fits while the other links move."""
    return [
        Problem(problem.key, _redundant(linkage, problem.key.partition(".")[2], problem.message) or problem.message)
        if isinstance(problem.message, ErrorMessage) and problem.message.name == "stiff_one"
        else problem
        for problem in problems
    ]


def _redundant(linkage: Linkage, name: str, message: ErrorMessage) -> ErrorMessage | None:
    """Return the message about a link without which the linkage moves, None if it does not move without it."""
    member = linkage.member(name)
    return check_redundant_fit(
        replace(linkage, members=tuple(other for other in linkage.members if other is not member)),
        member,
        message.values["mobility"],
    )


def check_redundant_fit(without: Linkage, member: Member, freedom: object) -> ErrorMessage | None:
    """Return a message whether a redundant link fits in every position of a linkage, None if that is unknown."""
    joints = [point for point in member.points if point in without.owners]
    mechanism, problems = mechanism_of(without)
    if mechanism is None or problems or member.guide or len(joints) != 2 or not has_steady_crank(mechanism):
        return None
    name = member.name
    links = [link.name for link in without.members if not link.guide]
    try:
        mechanism, crank_range = pass_change_points(mechanism)
        ends = (0.0, 360.0) if crank_range is None or crank_range.is_whole else open_range(crank_range)
        points = linkage_motion(mechanism, CrankGrid.from_degrees(np.linspace(*ends, 361))).points
    except GeometryError:
        return None
    (x, y), (u, v) = (points[joint] for joint in joints)
    distance = np.hypot(u.position - x.position, v.position - y.position)
    length = math.dist(*(member.points[joint] for joint in joints))
    values = {"name": name, "mobility": freedom}
    if np.max(np.abs(distance - length)) <= EQUAL * max(length, float(np.max(distance))):
        # the link that is joined to the same link
        neighbour = next((link for link in links if _is_on_link_of(without, without.member(link), joints)), links[-1])
        return ErrorMessage("redundant_fits", **values, other=neighbour)
    least, most = (f"{limit * 1e3:.9g}" for limit in (np.min(distance), np.max(distance)))
    return ErrorMessage("redundant_misses", **values, least=least, most=most, length=f"{length * 1e3:.9g}")


def _is_on_link_of(linkage: Linkage, member: Member, joints: list[str]) -> bool:
    """Return whether a link of two joints is joined to a link that has one of some joints."""
    own = [point for point in member.points if len(linkage.owners[point]) > 1]
    owners = {owner for point in joints for owner in linkage.owners[point]} - {GROUND, member.name}
    return len(own) == 2 and any(owners & {*linkage.owners[point]} for point in own)


def checked_motion(machine: Machine, crank: Values, reader: Reader) -> Machine | None:
    """Report a linkage that can be assembled nowhere, and a transient that cannot start."""
    try:
        reached = find_reachable_motion(machine, _STEP)
    except GeometryError as error:
        is_by_law = machine.mechanism.driver.law is not None
        key = "driver.law" if is_by_law else _unassembled_key(machine, CrankGrid.steps(_STEP, 360.0))
        reader.add_error(key, error.args[0])
        return None
    machine = replace(machine, working_range=_working_range(crank, reached.travel, reader))
    try:
        applied_loads(machine.mechanism, reached.motion, machine.loads)
    except GeometryError as error:
        reader.add_error("loads", error.args[0])
        return None
    if machine.transient is not None:
        _check_transient(machine, reached, reader)
    return None if reader.problems else machine


def _working_range(crank: Values, crank_range: CrankRange | None, reader: Reader) -> tuple[float, float] | None:
    """Return the crank angles of the working range; report angles that the crank does not reach."""
    given = [key for key in ("from", "to") if key in crank]
    if not given:
        return None
    if crank_range is None:
        reader.add_error(f"crank.{given[0]}", ErrorMessage("working_range_full"))
        return None
    low = math.degrees(crank["from"].value) if "from" in crank else open_range(crank_range)[0]
    high = math.degrees(crank["to"].value) if "to" in crank else open_range(crank_range)[1]
    if not crank_range.start < low < high < crank_range.end:
        ends = {"from": crank_range.start, "to": crank_range.end}
        reader.add_error(f"crank.{given[0]}", ErrorMessage("working_range_outside", low=low, high=high, **ends))
        return None
    return low, high


def with_starts(
    loads: tuple[Load, ...], values: Values, mechanism: Mechanism, crank_range: CrankRange | None
) -> tuple[Load, ...]:
    """Return the loads; a process force without a start counts from the beginning of the working stroke."""
    swept = None
    result = []
    for load, written in zip(loads, values["loads"], strict=True):
        if isinstance(load, ProcessForce) and load.against == "stroke" and "start" not in written:
            swept = swept or _swept(mechanism, crank_range)
            if load.slider in swept:
                low, high = swept[load.slider]
                load = replace(load, start=low if load.forward > 0 else high, begins_at_end=True)  # noqa: PLW2901
                if isinstance(load.force, LoadCurve) and load.force.stroke:
                    load = replace(load, force=load.force.over(high - low))  # noqa: PLW2901
        result.append(load)
    return tuple(result)


def _swept(mechanism: Mechanism, crank_range: CrankRange | None) -> dict[str, tuple[float, float]]:
    """Return the least and the greatest distance of every slider, empty if the linkage cannot be assembled. [m]"""
    try:
        if turns_fully(mechanism):
            motion = traced_motion(mechanism, linkage_motion(mechanism, CrankGrid.steps(_STEP, 360.0)))
            slides: dict[str, Any] = {name: slide.position for name, slide in motion.sliders.items()}
            over = CycleInterpolant(slides, CrankGrid.from_degrees, 360.0)
            return {name: (least.value, largest.value) for name, (largest, least) in over.extreme_points.items()}
        if not has_steady_crank(mechanism):
            return {}
        limits = find_crank_range(mechanism, crank_range)
    except GeometryError:
        return {}
    each = {name: limits.circuit.extent(slider, limits.branch) for name, slider in limits.circuit.sliders.items()}
    return {name: (extent.least, extent.greatest) for name, extent in each.items()}


def _check_transient(machine: Machine, reached: ReachableMotion, reader: Reader) -> None:
    """Report a transient of a massless linkage, or one that starts outside the crank range."""
    settings, limits = machine.transient, reached.travel
    inertia = np.min(reduced_inertia(machine.mechanism, reached.motion).inertia) + machine.drive.inertia
    if not inertia > 0:
        reader.add_error("transient", ErrorMessage("transient_massless"))
    driver = machine.mechanism.driver
    for geared_crank in driver.geared if isinstance(driver, Crank) else ():
        if not period_in_turns(geared_crank.ratio):
            reader.add_error("transient", ErrorMessage("transient_geared", name=geared_crank.link))
    if settings is not None and limits is not None and not limits.start < math.degrees(settings.start) < limits.end:
        reader.add_error("transient.start", ErrorMessage("transient_outside", low=limits.start, high=limits.end))


def _unassembled_key(machine: Machine, grid: CrankGrid) -> str:
    """Return the key of the first link of the group that cannot be assembled at any angle."""
    try:
        closures = place(machine.mechanism, grid).closures
    except GeometryError:
        # a group of class III cannot be assembled at the start
        return "links"
    for group, closure in zip(machine.mechanism.dyads, closures, strict=True):
        if first_failure(closure) is not None:
            names = [link.name for link in group.links] if isinstance(group, Chain) else vars(group).values()
            member = next(drawn for drawn in machine.drawn.members if drawn.name in names)
            return f"{'sliders' if member.guide else 'links'}.{member.name}"
    return "links"
