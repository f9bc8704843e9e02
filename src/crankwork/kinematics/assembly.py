"""Whether a group can be assembled; if not, by how much it fails, and advice."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import GeometryError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dyads import Closure
from crankwork.locale import ErrorMessage
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Chain, Dyad

# square of the sine of the smallest angle between links at which transfer functions are still accurate
_SINGULAR = 1e-13


def first_failure(closure: Closure) -> NDArray[np.bool_] | None:
    """Return where a group does not close or is singular, or None if it closes everywhere."""
    value = closure.value
    limit = _SINGULAR * closure.scale
    if value.min() > limit:
        return None
    return ~(value > limit)


def assembly_error(group: Dyad | Chain, closure: Closure, grid: CrankGrid, bad: NDArray[np.bool_]) -> GeometryError:
    """Return the error at the angle where assembly fails worst: the gap, and advice."""
    value = np.where(bad, np.nan_to_num(closure.value, nan=-np.inf), np.inf)
    worst = int(np.argmin(value))
    singular = abs(float(closure.value.flat[worst])) <= _SINGULAR * closure.scale
    angle = float(grid.degrees[worst])
    message = _singular(group, angle) if singular else _missing(group, float(closure.excess.flat[worst]), angle)
    return GeometryError(message)


def _singular(group: Dyad | Chain, angle: float) -> ErrorMessage:
    """Return the message that a group is singular at a crank angle, with advice. [deg]"""
    match group:
        case RRR():
            return ErrorMessage("rrr_singular", first=group.link_a, second=group.link_b, angle=angle)
        case RRP():
            return ErrorMessage("rrp_singular", link=group.link, slider=group.slider, angle=angle)
        case RPR():
            return ErrorMessage("rpr_singular", pin=group.joint, link=group.link, angle=angle)
        case PRP():
            return ErrorMessage("prp_singular", first=group.block_a, second=group.block_b, angle=angle)
        case RPP():
            return ErrorMessage("rpp_singular", link=group.link, angle=angle)
        case Chain():
            return ErrorMessage("chain_singular", links=_names(group), angle=angle)


def dead_position(group: Dyad | Chain) -> ErrorMessage:
    """Return the message that a group stops a crank in a dead position."""
    match group:
        case RRR():
            return ErrorMessage("rrr_dead", first=group.link_a, second=group.link_b, point=group.point)
        case RRP():
            return ErrorMessage("rrp_dead", link=group.link, slider=group.slider)
        case RPR():
            return ErrorMessage("rpr_dead", pin=group.joint, link=group.link)
        case PRP():
            return ErrorMessage("prp_dead", first=group.block_a, second=group.block_b)
        case RPP():
            return ErrorMessage("rpp_dead", link=group.link)
        case Chain():
            return ErrorMessage("chain_dead", links=_names(group))


def _missing(group: Dyad | Chain, measure: float, angle: float) -> ErrorMessage:
    """Return the message that a group does not meet at a crank angle, by how much, with advice. [deg]"""
    match group:
        case RRR():
            return _gap_message(group, measure, angle)
        case RRP():
            short = (abs(measure) - group.length) * 1e3
            return ErrorMessage("rrp_short", link=group.link, slider=group.slider, missing=short, angle=angle)
        case RPR():
            short = _slot_offset(group, measure) * 1e3
            return ErrorMessage(
                "rpr_near", pin=group.joint, pivot=group.pivot, link=group.link, missing=short, angle=angle
            )
        case PRP() | RPP():
            return _singular(group, angle)
        case Chain():
            start = math.degrees(group.start)
            return ErrorMessage("chain_lost", links=_names(group), start=start, angle=angle)


def _names(chain: Chain) -> str:
    return ", ".join(link.name for link in chain.links)


def _gap_message(group: RRR, square: float, angle: float) -> ErrorMessage:
    p, q, distance = group.length_a, group.length_b, math.sqrt(square)
    names = {
        "first": group.link_a, "second": group.link_b, "point": group.point,
        "joint": group.joint_a, "other": group.joint_b, "angle": angle,
    }  # fmt: skip
    if distance > p + q:
        return ErrorMessage("rrr_short", **names, missing=(distance - p - q) * 1e3)
    longer, shorter = (group.link_a, group.link_b) if p > q else (group.link_b, group.link_a)
    return ErrorMessage("rrr_long", **names, longer=longer, shorter=shorter, missing=(abs(p - q) - distance) * 1e3)


def _slot_offset(dyad: RPR, square: float) -> float:
    (x, y), angle = dyad.slot.point, dyad.slot.angle
    return abs(y * math.cos(angle) - x * math.sin(angle)) - math.sqrt(square)


def singular_between(
    grid: CrankGrid, closure: Closure, closure_at: Callable[[CrankGrid], Closure], singular: float = _SINGULAR
) -> Iterator[tuple[int, float]]:
    """Yield the intervals between ascending angles in which a group does not close, and an angle in each. [rad]

    Near a minimum a smooth function is convex, and the secants of the neighbouring intervals bound it from below; only
    intervals with a negative bound are refined. `singular`: tolerance of zero.
    """
    angle = grid.angle
    if angle.size < 3 or closure.value.size != angle.size:
        return
    for index in suspect_intervals(angle, closure.value):
        singular_angle = _narrowed(angle[index], angle[index + 1], closure.scale * singular, closure_at)
        if singular_angle is not None:
            yield int(index), singular_angle


def suspect_intervals(angle: Array, value: Array) -> NDArray[np.intp]:
    """Return the intervals in which a locally convex function may reach zero, by the secants of their neighbours."""
    least = value.min()
    step, rise = angle[1:] - angle[:-1], value[1:] - value[:-1]
    shortest = step.min()
    if shortest <= 0 or least * shortest > max(rise.max(), -rise.min()) * step.max():
        return np.empty(0, dtype=np.intp)
    slope = rise / step
    low = np.full(rise.shape, -np.inf)
    low[1:] = value[1:-1] + np.minimum(slope[:-1], 0) * step[1:]
    low[:-1] = np.maximum(low[:-1], value[1:-1] - np.maximum(slope[1:], 0) * step[:-1])
    return np.flatnonzero((low <= 0) & (value[:-1] > 0) & (value[1:] > 0))


def _narrowed(low: float, high: float, singular: float, closure_at: Callable[[CrankGrid], Closure]) -> float | None:
    """Return an angle of an interval at which a group does not close, by repeated refinement, or None."""
    for _ in range(12):
        angle = np.linspace(low, high, 33)
        value = np.nan_to_num(closure_at(CrankGrid.from_radians(angle)).value, nan=-1.0)
        worst = int(np.argmin(value))
        if value[worst] <= singular:
            return float(angle[worst])
        within = suspect_intervals(angle, value)
        if not within.size:
            return None
        low, high = angle[within[0]], angle[within[-1] + 1]
    return None
