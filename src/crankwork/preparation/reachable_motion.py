"""The motion of a linkage in its range: whole turns, or between dead positions, with notices of both."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from itertools import combinations
from typing import NamedTuple

import numpy as np

from crankwork.errors import GeometryError
from crankwork.kinematics.assembly import dead_position, first_failure
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.crank_range import CrankRange, find_crank_range, has_steady_crank, near_changes
from crankwork.kinematics.motion import Motion, linkage_motion
from crankwork.kinematics.position_analysis import assembled, place
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.mechanism.dyads import RPR, RRP, RRR, Chain
from crankwork.mechanism.mechanism import Crank, Mechanism, period_in_turns
from crankwork.preparation.prepared import Notice

# how near extremes are looked for: a part of the range
EDGE = 1e-6
# how near to a dead position motions and forces are drawn and checked: a part of the range, at most some degrees
_NEAREST, _AT_MOST = 0.005, 0.25
_FEWEST = 33
_NEARLY_SINGULAR = 1e-3
_TURN = 360.0
# most dyads whose branches are all tried: each doubles the combinations
_MOST_SIGNED = 4


class ReachableMotion(NamedTuple):
    """The motion of a linkage in its range; the range of its crank if that does not turn fully."""

    motion: Motion
    travel: CrankRange | None
    notices: tuple[Notice, ...]

    @property
    def grid(self) -> CrankGrid:
        """The crank angles of the motion."""
        return self.motion.grid


def find_reachable_motion(machine: Machine, step: float) -> ReachableMotion:
    """Return the motion of a linkage in steps, and notices of dead positions, change points and cycles."""
    engine, mechanism = CrankGrid.steps(step, machine.cycle), machine.mechanism
    try:
        moved = linkage_motion(mechanism, engine)
    except GeometryError as error:
        reason = error.args[0]
        message = _branch_first(mechanism, engine, reason)
        # a law beyond the range of its linkage has to be changed
        if not has_steady_crank(mechanism):
            raise GeometryError(message) from None
        try:
            result = find_crank_range(mechanism, machine.way)
        except GeometryError:
            if message is reason:
                raise
            raise GeometryError(message) from None
        if result.is_whole:
            raise
        ends = _reasons_of_ends(mechanism, engine, result)
        if ends:
            message = ends if message is reason else ErrorMessage(message.name, **{**message.values, "mistake": ends})
        notices = [Notice("partial", {"message": message, "from": result.start, "to": result.end})]
        if any(isinstance(group, Chain) for group in mechanism.dyads):
            notices.append(Notice("circuit_of_chain", {}))
        moved = linkage_motion(mechanism, _inside(result, step))
        return ReachableMotion(moved, result, (*notices, *_change_notices(mechanism, result)))
    margins = [np.min(closure.value) / closure.scale for closure in place(mechanism, engine).closures]
    is_near = has_steady_crank(mechanism) and min(margins, default=1.0) < _NEARLY_SINGULAR
    return ReachableMotion(
        moved, None, tuple(_change_notices(mechanism, find_crank_range(mechanism, machine.way) if is_near else None))
    )


def _reasons_of_ends(mechanism: Mechanism, grid: CrankGrid, travel: CrankRange) -> ErrorMessage | None:
    """Return what stops a crank at each end, unless the group that is reported to fail over a grid does so at both."""
    inside = place(mechanism, CrankGrid.from_degrees(open_range(travel)))
    margins = [np.broadcast_to(closure.value, 2) / closure.scale for closure in inside.closures]
    first, last = (mechanism.dyads[int(index)] for index in np.argmin(margins, axis=0))
    with suppress(GeometryError):
        closures = zip(mechanism.dyads, place(mechanism, grid).closures, strict=True)
        failing = next((group for group, closure in closures if first_failure(closure) is not None), None)
        if first is last is failing:
            return None
    if first is last:
        return ErrorMessage("both_ends", reason=dead_position(first))
    reasons = {"start_reason": dead_position(first), "end_reason": dead_position(last)}
    return ErrorMessage("range_ends", start=travel.start, end=travel.end, **reasons)


def _branch_first(mechanism: Mechanism, grid: CrankGrid, message: ErrorMessage) -> ErrorMessage:
    """Return why a linkage does not move over a grid, headed by the fewest other branches with which it does."""
    # no later dyad depends on the branch of the last one
    before = enumerate(mechanism.dyads[:-1])
    other = {index: replace(item, branch=-item.branch) for index, item in before if isinstance(item, RRR | RRP | RPR)}
    if mechanism.passages or len(other) > _MOST_SIGNED or any(isinstance(dyad, Chain) for dyad in mechanism.dyads):
        return message
    for flipped in (combination for count in range(1, len(other) + 1) for combination in combinations(other, count)):
        dyads = tuple(other[index] if index in flipped else dyad for index, dyad in enumerate(mechanism.dyads))
        with suppress(GeometryError):
            assembled(replace(mechanism, dyads=dyads), grid)
            written = ", ".join(f"{_branch_key(other[index])} = {other[index].branch}" for index in flipped)
            return ErrorMessage("branch_first", written=written, mistake=message)
    return message


def _branch_key(group: RRR | RRP | RPR) -> str:
    match group:
        case RRR():
            return group.point
        case RRP():
            return group.slider
        case RPR():
            return group.link


def _inside(travel: CrankRange, step: float) -> CrankGrid:
    """Return angles from dead position to dead position in given steps, or in smaller ones if these are too few."""
    width = travel.end - travel.start
    margin = min(_AT_MOST, _NEAREST * width)
    count = max(_FEWEST, math.ceil(width / step) + 1)
    return CrankGrid.from_degrees(np.linspace(travel.start + margin, travel.end - margin, count))


def _change_notices(mechanism: Mechanism, travel: CrankRange | None) -> Iterator[Notice]:
    """Yield notices of change points that are passed, or nearly."""
    changes = sorted({change for passage in mechanism.passages.values() for change in passage.changes})
    if changes:
        shown = sorted({round(change % mechanism.period, 6) for change in changes})
        yield Notice("change_points", {"angles": "°, ".join(f"{item:g}" for item in shown)})
    if mechanism.period > _TURN and (travel is None or travel.is_whole):
        yield Notice("two_turns", {"turns": round(mechanism.period / _TURN)})
    geared = mechanism.driver.geared if isinstance(mechanism.driver, Crank) and travel is None else ()
    for item in geared:
        if not period_in_turns(item.ratio):
            yield Notice("no_cycle", {"name": item.link, "ratio": item.ratio})
    for degrees, miss in near_changes(travel.circuit) if travel else ():
        yield Notice("nearly_change_point", {"angle": degrees, "miss": miss})


def open_range(travel: CrankRange) -> tuple[float, float]:
    """Return the range between dead positions without these. [deg]"""
    edge = EDGE * (travel.end - travel.start)
    return travel.start + edge, travel.end - edge
