"""What the motion of a described linkage decides: branches, redundant links, the range and what depends on it."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from crankwork.description.schema import Values
from crankwork.description.value_types import Reader
from crankwork.dynamics.reduction import reduced_inertia
from crankwork.dynamics.redundant import RedundantLink
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
from crankwork.kinematics.kinematic_coefficients import PointMotion
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.position_analysis import place
from crankwork.kinematics.traced_motion import traced_motion
from crankwork.loads.curves import LoadCurve
from crankwork.loads.load import Load, ProcessForce, applied_loads
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.mechanism.decomposition import mechanism_of
from crankwork.mechanism.dyads import RPR, RRP, RRR, Chain
from crankwork.mechanism.linkage import GROUND, Linkage, Member
from crankwork.mechanism.mechanism import Crank, Mechanism, period_in_turns
from crankwork.mechanism.structure import mobility
from crankwork.mechanism.table_reader import linkage_from
from crankwork.preparation.reachable_motion import ReachableMotion, find_reachable_motion, open_range

_STEP = 1.0
_KEYS = ("share", "of")
# largest number of redundant links without a share, and of combinations tried
_MOST_UNSHARED, _MOST_TRIED = 3, 100
# share of the size of a linkage by which a stated position may differ
_ROUGHLY = 0.25


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


def checked_motion(machine: Machine, values: Values, reader: Reader) -> Machine | None:
    """Report a linkage that can be assembled nowhere, and a transient that cannot start."""
    try:
        reached = find_reachable_motion(machine, _STEP)
    except GeometryError as error:
        if machine.mechanism.driver.law is not None:
            key = "driver.velocity" if "velocity" in values["driver"] else "driver.law"
        else:
            key = _unassembled_key(machine, CrankGrid.steps(_STEP, 360.0))
        reader.add_error(key, error.args[0])
        return None
    machine = replace(machine, working_range=_working_range(values["crank"], reached.travel, reader))
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


def geometry_of(link: Mapping[str, Any]) -> dict[str, Any]:
    """Return the keys of a link without those of its share of the load."""
    return {name: value for name, value in link.items() if name not in _KEYS}


def without_redundant(linkage: Linkage, values: Values, reader: Reader) -> tuple[Linkage, tuple[Member, ...]]:
    """Return a linkage without the links with a share, and these links; report invalid shares."""
    links = values["links"]
    for name, link in links.items():
        for key, other in (_KEYS, _KEYS[::-1]):
            if key in link and other not in link:
                example = next((member_name for member_name in links if member_name != name), "rocker")
                reader.add_error(f"links.{name}.{other}", ErrorMessage(f"{other}_missing", name=name, example=example))
    shared = tuple(member for member in linkage.members if set(_KEYS) <= set(links.get(member.name, ())))
    if reader.problems or not shared:
        return linkage, ()
    if not mechanism_of(linkage)[1]:
        for member in shared:
            reader.add_error(f"links.{member.name}.share", ErrorMessage("share_needless", name=member.name))
        return linkage, ()
    without = replace(linkage, members=tuple(member for member in linkage.members if member not in shared))
    for member in shared:
        _check((linkage, without), member, links[member.name]["of"], reader)
    return without, shared


def without_unshared(linkage: Linkage, taken: tuple[Member, ...]) -> tuple[Linkage, tuple[Member, ...]]:
    """Return a linkage without redundant links that fit and have no mass, and all links removed.

    `taken`: links with a share, removed already.
    """
    named = [problem.key.partition(".")[2] for problem in mechanism_of(linkage)[1] if _is_stiff(problem)]
    count = 1 - round(float(mobility(linkage).value))
    if not named or not 1 <= count <= _MOST_UNSHARED:
        return linkage, taken
    weightless = [member for member in linkage.members if not (member.mass or member.inertia or member.guide)]
    weightless.sort(key=lambda member: member.name not in named)
    for subset in itertools.islice(itertools.combinations(weightless, count), _MOST_TRIED):
        without = replace(linkage, members=tuple(member for member in linkage.members if member not in subset))
        if mechanism_of(without)[1]:
            continue
        fits = [check_redundant_fit(without, member, 0.0) for member in subset]
        if all(message is not None and message.name == "redundant_fits" for message in fits):
            return without, (*taken, *subset)
    return linkage, taken


def _is_stiff(problem: Problem) -> bool:
    return isinstance(problem.message, ErrorMessage) and problem.message.name == "stiff_one"


def _check(both: tuple[Linkage, Linkage], link: Member, other: str, reader: Reader) -> None:
    """Report a link that cannot have a share, and a link that it cannot share with.

    `both`: the linkage with all links, and without those with a share.
    """
    key, (full, without) = f"links.{link.name}", both
    if sum(point in without.owners for point in link.points) != 2:
        reader.add_error(f"{key}.share", ErrorMessage("share_joints", name=link.name))
    if link.mass or link.inertia:
        reader.add_error(f"{key}.mass", ErrorMessage("share_mass", name=link.name))
    known = [member.name for member in without.members if not member.guide]
    if other not in known:
        reader.add_error(f"{key}.of", ErrorMessage("absent_link", name=other, known=", ".join(known)))
    elif len(_joints(full, full.member(other))) != 2:
        reader.add_error(f"{key}.of", ErrorMessage("share_joints", name=other))


def _joints(linkage: Linkage, member: Member) -> list[str]:
    return [point for point in member.points if len(linkage.owners[point]) > 1]


def fitting(linkage: Linkage, members: tuple[Member, ...], values: Values, reader: Reader) -> tuple[RedundantLink, ...]:
    """Return redundant links that fit the motion of the linkage; report those that do not."""
    redundant = []
    for link in members:
        freedom = float(mobility(replace(linkage, members=(*linkage.members, link))).value)
        message = check_redundant_fit(linkage, link, freedom)
        if message is None or message.name != "redundant_fits":
            reader.add_error(f"links.{link.name}", message or ErrorMessage("share_driver", name=link.name))
            continue
        start, end = (point for point in link.points if point in linkage.owners)
        length = math.dist(link.points[start], link.points[end])
        if "share" not in values["links"][link.name]:
            redundant.append(RedundantLink(link, start, end, length))
            continue
        other = linkage.member(values["links"][link.name]["of"])
        near, far = _counted(linkage, other, (start, end))
        of_length = math.dist(other.points[near], other.points[far])
        share = values["links"][link.name]["share"]
        redundant.append(RedundantLink(link, start, end, length, share, other.name, near, far, of_length))
    return tuple(redundant)


def _counted(linkage: Linkage, other: Member, ends: tuple[str, str]) -> tuple[str, str]:
    """Return the two joints of a link, first that on a link which the ends belong to: the force counts there."""
    owners = {owner for end in ends for owner in linkage.owners[end]} - {GROUND}
    joints = _joints(linkage, other)
    near = next((joint for joint in joints if owners & {*linkage.owners[joint]} - {other.name}), joints[0])
    return near, next(joint for joint in joints if joint != near)


class BranchedMechanism(NamedTuple):
    """A mechanism with its branches, its problems, and the positions of its joints at the start. [m]"""

    mechanism: Mechanism | None
    problems: list[Problem]
    places: Mapping[str, tuple[float, float]]


def branches_from_positions(linkage: Linkage) -> BranchedMechanism:
    """Return the mechanism of a linkage with branches from stated positions, group after group.

    A group may need solved positions of points on links of groups before it.
    """
    mechanism, problems = mechanism_of(linkage)
    solved: dict[str, tuple[float, float]] = {}
    for _ in mechanism.dyads if mechanism is not None and linkage.positions else ():
        if mechanism is None:
            break
        points = _placed(mechanism)
        places = {name: tuple(float(np.ravel(axis.position)[0]) for axis in point) for name, point in points.items()}
        solved = {name: (x, y) for name, (x, y) in places.items() if math.isfinite(x) and math.isfinite(y)}
        before = mechanism
        mechanism, problems = mechanism_of(linkage, solved)
        if mechanism == before:
            break
    return BranchedMechanism(None if problems else mechanism, problems, solved)


def _placed(mechanism: Mechanism) -> Mapping[str, PointMotion]:
    """Return the points at the start, of as many groups as can be assembled with the branches so far."""
    for count in range(len(mechanism.dyads), 0, -1):
        try:
            return place(replace(mechanism, dyads=mechanism.dyads[:count]), CrankGrid.from_degrees([0.0])).points
        except GeometryError:
            continue
    return {}


def position_notices(
    tables: Mapping[str, Any], linkage: Linkage, branched: BranchedMechanism, reader: Reader, *, is_new: bool
) -> Iterator[tuple[str, dict[str, float | str]]]:
    """Yield notices of positions far from their joints, unless they decide the branch of a dyad.

    In files of format 2 (`is_new`) report these, and all positions without effect.
    """
    if branched.mechanism is None:
        return
    branches, starts = _settling(linkage, branched.mechanism)
    size = max(
        (math.dist(first, second) for first in branched.places.values() for second in branched.places.values()),
        default=0.0,
    )
    for name, stated in linkage.positions.items():
        if name in branches:
            continue
        if name in branched.places and math.dist(stated, branched.places[name]) > _ROUGHLY * size:
            code = "position_far" if name in starts else "position_idle"
            values: dict[str, float | str] = {"name": name}
            values |= dict(zip("xy", (float(f"{1e3 * axis:.4g}") for axis in branched.places[name]), strict=True))
            if is_new:
                reader.add_error(f"positions.{name}", ErrorMessage(code, **values))
            else:
                yield code, values
        elif is_new and name not in starts and _is_idle(tables, linkage, branched.mechanism, name):
            yield "position_unused", {"name": name}


def _is_idle(tables: Mapping[str, Any], linkage: Linkage, mechanism: Mechanism, name: str) -> bool:
    """Return whether a linkage is the same without a stated position."""
    rest = {joint: position for joint, position in tables["positions"].items() if joint != name}
    other, _ = linkage_from({**tables, "positions": rest})
    if other is None:
        return False
    names = {member.name for member in linkage.members}
    other = replace(other, members=tuple(member for member in other.members if member.name in names))
    return (
        replace(other, positions={}) == replace(linkage, positions={})
        and branches_from_positions(other).mechanism == mechanism
    )


def _settling(linkage: Linkage, mechanism: Mechanism) -> tuple[set[str], set[str]]:
    """Return the points whose stated positions settle a branch, and those where a chain begins."""
    branches, starts = set[str](), set[str]()
    for group in mechanism.dyads:
        match group:
            case RRR(point=name) | RRP(slider=name):
                branches |= {name} - set(linkage.branches)
            case RPR(link=name):
                branches |= set() if name in linkage.branches else set(linkage.member(name).points)
            case Chain(links=links):
                starts |= {name for link in links for name in link.points}
    return branches, starts
