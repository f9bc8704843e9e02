"""Whether a group can be assembled: where it cannot, by how much, and what would help."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import GeometryError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dyads import Closure
from crankwork.locale import Refusal
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Dyad

# square of the sine of the smallest angle between links whose transfer functions still mean something
_SINGULAR = 1e-13


def unassembled(closure: Closure) -> NDArray[np.bool_] | None:
    """Return where a group does not close or is singular, or None if it closes everywhere.

    True where it does not.
    """
    value = closure.value
    limit = _SINGULAR * closure.scale
    if value.min() > limit:
        return None
    return ~(value > limit)


def refusal(group: Dyad | Chain, closure: Closure, grid: CrankGrid, bad: NDArray[np.bool_]) -> GeometryError:
    """Return the error that says where and by how much a group cannot be assembled, and what would help."""
    value = np.where(bad, np.nan_to_num(closure.value, nan=-np.inf), np.inf)
    worst = int(np.argmin(value))
    singular = abs(float(closure.value.flat[worst])) <= _SINGULAR * closure.scale
    at = float(grid.degrees[worst])
    told = _singular(group, at) if singular else _missing(group, float(closure.excess.flat[worst]), at)
    return GeometryError(told)


def _singular(group: Dyad | Chain, at: float) -> Refusal:
    """Return what is singular, and what would help; `at`: the crank angle [deg]."""
    match group:
        case RRR():
            return Refusal("rrr_singular", first=group.link_a, second=group.link_b, angle=at)
        case RRP():
            return Refusal("rrp_singular", link=group.link, slider=group.slider, angle=at)
        case RPR():
            return Refusal("rpr_singular", pin=group.joint, link=group.link, angle=at)
        case PRP():
            return Refusal("prp_singular", first=group.block_a, second=group.block_b, angle=at)
        case RPP():
            return Refusal("rpp_singular", link=group.link, angle=at)
        case Chain():
            return Refusal("chain_singular", links=_names(group), angle=at)


def _missing(group: Dyad | Chain, measure: float, at: float) -> Refusal:
    """Return what does not meet, by how much, and what would help; `at`: the crank angle [deg]."""
    match group:
        case RRR():
            return _apart(group, measure, at)
        case RRP():
            short = (abs(measure) - group.length) * 1e3
            return Refusal("rrp_short", link=group.link, slider=group.slider, missing=short, angle=at)
        case RPR():
            short = _slot_offset(group, measure) * 1e3
            return Refusal("rpr_near", pin=group.joint, pivot=group.pivot, link=group.link, missing=short, angle=at)
        case PRP() | RPP():
            return _singular(group, at)
        case Chain():
            start = math.degrees(group.start)
            return Refusal("chain_lost", links=_names(group), start=start, angle=at)


def _names(chain: Chain) -> str:
    return ", ".join(link.name for link in chain.links)


def _apart(group: RRR, square: float, at: float) -> Refusal:
    p, q, distance = group.length_a, group.length_b, math.sqrt(square)
    names = {
        "first": group.link_a, "second": group.link_b, "point": group.point,
        "joint": group.joint_a, "other": group.joint_b, "angle": at,
    }  # fmt: skip
    if distance > p + q:
        return Refusal("rrr_short", **names, missing=(distance - p - q) * 1e3)
    longer, shorter = (group.link_a, group.link_b) if p > q else (group.link_b, group.link_a)
    return Refusal("rrr_long", **names, longer=longer, shorter=shorter, missing=(abs(p - q) - distance) * 1e3)


def _slot_offset(dyad: RPR, square: float) -> float:
    (x, y), angle = dyad.slot.point, dyad.slot.angle
    return abs(y * math.cos(angle) - x * math.sin(angle)) - math.sqrt(square)


def singular_between(
    grid: CrankGrid, closure: Closure, closure_at: Callable[[CrankGrid], Closure], singular: float = _SINGULAR
) -> Iterator[tuple[int, float]]:
    """Yield the intervals between ascending angles in which a group does not close, and an angle in each. [rad]

    Where a smooth function is least it is convex, and there the secants of its neighbours bound it from below.
    Only an interval in which that bound is negative is looked at more closely. `singular`: what is as good as zero.
    """
    angle = grid.angle
    if angle.size < 3 or closure.value.size != angle.size:
        return
    for index in suspects(angle, closure.value):
        found = _narrowed(angle[index], angle[index + 1], closure.scale * singular, closure_at)
        if found is not None:
            yield int(index), found


def suspects(angle: Array, value: Array) -> NDArray[np.intp]:
    """Return the intervals in which a locally convex function may reach zero, by the secants beside them."""
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
    """Return an angle of a range at which a group does not close, or None, by looking ever closer."""
    for _ in range(12):
        angle = np.linspace(low, high, 33)
        value = np.nan_to_num(closure_at(CrankGrid.from_radians(angle)).value, nan=-1.0)
        worst = int(np.argmin(value))
        if value[worst] <= singular:
            return float(angle[worst])
        within = suspects(angle, value)
        if not within.size:
            return None
        low, high = angle[within[0]], angle[within[-1] + 1]
    return None
