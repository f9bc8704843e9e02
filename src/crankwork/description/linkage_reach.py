"""How far a described linkage gets: what keeps it from moving, and what of its description depends on its way."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from crankwork.analysis.reach import Reached, open_range, reachable
from crankwork.description.kinds import Reader
from crankwork.description.schema import Values
from crankwork.dynamics.reduction import reduced_inertia
from crankwork.errors import GeometryError, Problem
from crankwork.formula.over_cycle import OverCycle
from crankwork.kinematics.assembly import unassembled
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.curves import EQUAL
from crankwork.kinematics.memory import remembered_motion
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.placement import place
from crankwork.kinematics.travel import Travel, has_steady_crank, travel, turns_fully, way_through
from crankwork.loads.load import Load, applied_loads
from crankwork.loads.process import ProcessForce
from crankwork.locale import Refusal
from crankwork.machine import Machine
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.decomposition import mechanism_of
from crankwork.mechanism.linkage import GROUND, Linkage, Member
from crankwork.mechanism.mechanism import Crank, Mechanism, period_in_turns

_STEP = 1.0


def way_if_assembled(mechanism: Mechanism) -> tuple[Mechanism, Travel | None]:
    """Return a linkage that passes its change points, and its way; where it cannot be assembled, that is told later."""
    try:
        return way_through(mechanism)
    except GeometryError:
        return mechanism, None


def told_redundant(linkage: Linkage, problems: list[Problem]) -> list[Problem]:
    """Return problems, of a link that is one too many said whether it fits where the others move."""
    return [
        Problem(one.key, _redundant(linkage, one.key.partition(".")[2], one.message) or one.message)
        if isinstance(one.message, Refusal) and one.message.name == "stiff_one"
        else one
        for one in problems
    ]


def _redundant(linkage: Linkage, name: str, told: Refusal) -> Refusal | None:
    """Return what is to be said of a link without which the linkage moves, None if it does not move."""
    member = linkage.member(name)
    return fit(
        replace(linkage, members=tuple(one for one in linkage.members if one is not member)),
        member,
        told.values["mobility"],
    )


def fit(without: Linkage, member: Member, freedom: object) -> Refusal | None:
    """Return whether a link fits where a linkage moves without it, as what is to be said; None if that is unknown."""
    joints = [point for point in member.points if point in without.owners]
    mechanism, problems = mechanism_of(without)
    if mechanism is None or problems or member.guide or len(joints) != 2 or not has_steady_crank(mechanism):
        return None
    name = member.name
    others = [one.name for one in without.members if not one.guide]
    try:
        mechanism, found = way_through(mechanism)
        ends = (0.0, 360.0) if found is None or found.is_whole else open_range(found)
        points = linkage_motion(mechanism, CrankGrid.from_degrees(np.linspace(*ends, 361))).points
    except GeometryError:
        return None
    (x, y), (u, v) = (points[joint] for joint in joints)
    apart = np.hypot(u.position - x.position, v.position - y.position)
    length = math.dist(*(member.points[joint] for joint in joints))
    values = {"name": name, "mobility": freedom}
    if np.max(np.abs(apart - length)) <= EQUAL * max(length, float(np.max(apart))):
        # that which hangs on the same link
        beside = next((one for one in others if _beside(without, without.member(one), joints)), others[-1])
        return Refusal("redundant_fits", **values, other=beside)
    least, most = (f"{one * 1e3:.9g}" for one in (np.min(apart), np.max(apart)))
    return Refusal("redundant_misses", **values, least=least, most=most, length=f"{length * 1e3:.9g}")


def _beside(linkage: Linkage, member: Member, joints: list[str]) -> bool:
    """Return whether a link of two joints hangs on a link that some joints belong to."""
    own = [point for point in member.points if len(linkage.owners[point]) > 1]
    owners = {owner for point in joints for owner in linkage.owners[point]} - {GROUND, member.name}
    return len(own) == 2 and any(owners & {*linkage.owners[point]} for point in own)


def checked_motion(machine: Machine, crank: Values, reader: Reader) -> Machine | None:
    """Complain of a linkage that can be assembled nowhere, or that cannot be let go as is asked."""
    try:
        reached = reachable(machine, _STEP)
    except GeometryError as error:
        is_by_law = machine.mechanism.driver.law is not None
        key = "driver.law" if is_by_law else _unassembled_key(machine, CrankGrid.steps(_STEP, 360.0))
        reader.complain(key, error.args[0])
        return None
    machine = replace(machine, working_range=_working_range(crank, reached.travel, reader))
    try:
        applied_loads(machine.mechanism, reached.motion, machine.loads)
    except GeometryError as error:
        reader.complain("loads", error.args[0])
        return None
    if machine.transient is not None:
        _check_let_go(machine, reached, reader)
    return None if reader.problems else machine


def _working_range(crank: Values, found: Travel | None, reader: Reader) -> tuple[float, float] | None:
    """Return the crank angles between which largest values count, and complain of what the crank does not reach."""
    given = [key for key in ("from", "to") if key in crank]
    if not given:
        return None
    if found is None:
        reader.complain(f"crank.{given[0]}", Refusal("working_range_full"))
        return None
    low = math.degrees(crank["from"].value) if "from" in crank else open_range(found)[0]
    high = math.degrees(crank["to"].value) if "to" in crank else open_range(found)[1]
    if not found.start < low < high < found.end:
        ends = {"from": found.start, "to": found.end}
        reader.complain(f"crank.{given[0]}", Refusal("working_range_outside", low=low, high=high, **ends))
        return None
    return low, high


def with_starts(loads: tuple[Load, ...], values: Values, mechanism: Mechanism, way: Travel | None) -> tuple[Load, ...]:
    """Return the loads, process forces counted from the beginning of the working stroke where no start is given."""
    swept = None
    result = []
    for load, written in zip(loads, values["loads"], strict=True):
        if isinstance(load, ProcessForce) and load.against == "stroke" and "start" not in written:
            swept = swept or _swept(mechanism, way)
            if load.slider in swept:
                load = replace(load, start=swept[load.slider][0 if load.forward > 0 else 1])  # noqa: PLW2901
        result.append(load)
    return tuple(result)


def _swept(mechanism: Mechanism, way: Travel | None) -> dict[str, tuple[float, float]]:
    """Return the least and the greatest distance of every slider, none where the linkage cannot be assembled. [m]"""
    try:
        if turns_fully(mechanism):
            motion = remembered_motion(mechanism, linkage_motion(mechanism, CrankGrid.steps(_STEP, 360.0)))
            slides: dict[str, Any] = {name: slide.position for name, slide in motion.sliders.items()}
            over = OverCycle(slides, CrankGrid.from_degrees, 360.0)
            return {name: (least.value, largest.value) for name, (largest, least) in over.largest_and_least.items()}
        if not has_steady_crank(mechanism):
            return {}
        found = travel(mechanism, way)
    except GeometryError:
        return {}
    each = {name: found.circuit.extent(way, found.branch) for name, way in found.circuit.sliders.items()}
    return {name: (extent.least, extent.greatest) for name, extent in each.items()}


def _check_let_go(machine: Machine, reached: Reached, reader: Reader) -> None:
    """Complain of a transient of what weighs nothing, or that starts where the crank does not get."""
    wanted, way = machine.transient, reached.travel
    inertia = np.min(reduced_inertia(machine.mechanism, reached.motion).inertia) + machine.drive.inertia
    if not inertia > 0:
        reader.complain("transient", Refusal("transient_massless"))
    driver = machine.mechanism.driver
    geared = (one for one in driver.geared if not period_in_turns(one.ratio)) if isinstance(driver, Crank) else ()
    for one in geared:
        reader.complain("transient", Refusal("transient_geared", name=one.link))
    if wanted is not None and way is not None and not way.start < math.degrees(wanted.start) < way.end:
        ends = {"low": way.start, "high": way.end}
        reader.complain("transient.start", Refusal("transient_outside", **ends))


def _unassembled_key(machine: Machine, grid: CrankGrid) -> str:
    """Return the key of the first link of the group that can be assembled nowhere."""
    try:
        closures = place(machine.mechanism, grid).closures
    except GeometryError:
        # a group of class III that is not even assembled once
        return "links"
    for group, closure in zip(machine.mechanism.dyads, closures, strict=True):
        if unassembled(closure) is not None:
            names = [one.name for one in group.links] if isinstance(group, Chain) else vars(group).values()
            member = next(one for one in machine.drawn.members if one.name in names)
            return f"{'sliders' if member.guide else 'links'}.{member.name}"
    return "links"
