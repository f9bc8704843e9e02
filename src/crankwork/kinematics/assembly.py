"""Whether a group can be assembled: where it cannot, by how much, and what would help."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import GeometryError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dyads import Closure
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
    what, why = _singular(group) if singular else _missing(group, float(closure.excess.flat[worst]))
    return GeometryError(f"{what} at a crank angle of {grid.degrees[worst]:.7g} deg: {why}")


_UNDETERMINED = (
    "a singular position (dead centre or change point), in which the motion is not determined; "
    "change a length, or leave this angle out"
)


def _singular(group: Dyad | Chain) -> tuple[str, str]:
    """Return what is singular, and what would help."""
    match group:
        case RRR():
            return f"links {group.link_a} and {group.link_b} are in line", _UNDETERMINED
        case RRP():
            return f"link {group.link} is square to the guide of {group.slider}", _UNDETERMINED
        case RPR():
            return f"the pin {group.joint} comes to where {group.link} may turn freely", _UNDETERMINED
        case PRP():
            return f"the guides of {group.block_a} and {group.block_b} are parallel", _UNDETERMINED
        case RPP():
            return f"slot and guide of {group.link} are parallel", "they never meet; change the angle of the slot"
        case Chain():
            return f"links {_names(group)} are in a position", _UNDETERMINED


def _missing(group: Dyad | Chain, measure: float) -> tuple[str, str]:
    """Return what does not meet, by how much, and what would help."""
    match group:
        case RRR():
            return f"links {group.link_a} and {group.link_b} do not meet at {group.point}", _apart(group, measure)
        case RRP():
            return f"link {group.link} does not reach the guide of {group.slider}", (
                f"it is {(abs(measure) - group.length) * 1e3:.4g} mm too short; lengthen it by more than that or "
                "move the guide"
            )
        case RPR():
            return f"the pin {group.joint} comes nearer to {group.pivot} than the slot of {group.link} passes by", (
                f"it misses {_slot_offset(group, measure) * 1e3:.4g} mm; reduce the offset of the slot or move "
                f"{group.pivot}"
            )
        case PRP() | RPP():
            return _singular(group)
        case Chain():
            return f"links {_names(group)} cannot be brought from their start at {math.degrees(group.start):g} deg", (
                "a singular position lies between; change a length or the start"
            )


def _names(chain: Chain) -> str:
    return ", ".join(link.name for link in chain.links)


def _apart(group: RRR, square: float) -> str:
    p, q, distance = group.length_a, group.length_b, math.sqrt(square)
    if distance > p + q:
        return (
            f"together they are {(distance - p - q) * 1e3:.4g} mm too short; lengthen one of them or bring "
            f"{group.joint_a} and {group.joint_b} closer"
        )
    longer, shorter = (group.link_a, group.link_b) if p > q else (group.link_b, group.link_a)
    return (
        f"{longer} is {(abs(p - q) - distance) * 1e3:.4g} mm too long; shorten it, lengthen {shorter} or move "
        f"{group.joint_a} and {group.joint_b} apart"
    )


def _slot_offset(dyad: RPR, square: float) -> float:
    (x, y), angle = dyad.slot.point, dyad.slot.angle
    return abs(y * math.cos(angle) - x * math.sin(angle)) - math.sqrt(square)


def singular_between(
    grid: CrankGrid, closure: Closure, closure_at: Callable[[CrankGrid], Closure]
) -> Iterator[tuple[int, float]]:
    """Yield the intervals between ascending angles in which a group does not close, and an angle in each. [rad]

    Where a smooth function is least it is convex, and there the secants of its neighbours bound it from below.
    Only an interval in which that bound is negative is looked at more closely.
    """
    angle = grid.angle
    if angle.size < 3 or closure.value.size != angle.size:
        return
    for index in _suspects(angle, closure.value):
        found = _narrowed(angle[index], angle[index + 1], closure.scale, closure_at)
        if found is not None:
            yield int(index), found


def _suspects(angle: Array, value: Array) -> NDArray[np.intp]:
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


def _narrowed(low: float, high: float, scale: float, closure_at: Callable[[CrankGrid], Closure]) -> float | None:
    """Return an angle of a range at which a group does not close, or None, by looking ever closer."""
    for _ in range(12):
        angle = np.linspace(low, high, 33)
        value = np.nan_to_num(closure_at(CrankGrid.from_radians(angle)).value, nan=-1.0)
        worst = int(np.argmin(value))
        if value[worst] <= _SINGULAR * scale:
            return float(angle[worst])
        suspects = _suspects(angle, value)
        if not suspects.size:
            return None
        low, high = angle[suspects[0]], angle[suspects[-1] + 1]
    return None
