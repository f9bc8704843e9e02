"""Firing orders: which angles they give, and whether a crankshaft allows them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice, permutations, product
from typing import NamedTuple

from crankwork.errors import CrankworkError
from crankwork.locale import ErrorMessage

# Angles closer than this are the same. [deg]
SAME_ANGLE = 1e-6
_DECIMALS = 9
_TURN = 360.0


class LayoutError(CrankworkError):
    """Cylinders, crank and firing order that do not fit together; `key` is the key of the description at fault."""

    def __init__(self, key: str, message: str) -> None:
        super().__init__(message)
        self.key = key


class LayoutNotice(NamedTuple):
    """Something the reader should know about a layout: a code and its values."""

    code: str
    values: Mapping[str, float | str]


def wrap_angle(angle: float, cycle: float = _TURN) -> float:
    """Return an angle without full cycles, rounded to decimals if that changes it by rounding only. [deg]

    At least 0 and less than the cycle. `angle` and `cycle`: the angle, and the length of the cycle [deg].

    Examples
    --------
    >>> wrap_angle(-240.0), wrap_angle(0.1 + 0.2 + 720.0, 720.0)
    (120.0, 0.3)
    """
    rest = angle % cycle
    near = round(rest, _DECIMALS)
    if abs(rest - near) <= 1e-15 * (abs(angle) + cycle):
        rest = near
    return 0.0 if cycle - rest <= 1e-12 * cycle else rest


def order_text(order: Sequence[int]) -> str:
    """Return a firing order as it is written, `1-3-4-2`."""
    return "-".join(str(number) for number in order)


def angle_list(angles: Sequence[float]) -> str:
    """Return angles as text, `180, 270, 180, 90`.

    `angles`: the angles [deg].
    """
    return ", ".join(f"{angle:.7g}" for angle in angles)


def checked_order(order: Sequence[int], cylinders: int) -> tuple[int, ...]:
    """Return a firing order rotated to begin with cylinder 1."""
    key, given = "engine.firing_order", [int(number) for number in order]
    unknown = sorted({number for number in given if not 1 <= number <= cylinders})
    if unknown:
        raise LayoutError(key, ErrorMessage("cylinder_absent", number=unknown[0], count=cylinders))
    twice = sorted({number for number in given if given.count(number) > 1})
    missing = [number for number in range(1, cylinders + 1) if number not in given]
    if twice or missing:
        values = {"order": order_text(given), "count": cylinders}
        if not missing:
            raise LayoutError(key, ErrorMessage("order_twice", **values, twice=twice[0]))
        if not twice:
            raise LayoutError(key, ErrorMessage("order_leaves_out", **values, missing=missing[0]))
        raise LayoutError(key, ErrorMessage("order_twice_leaves_out", **values, twice=twice[0], missing=missing[0]))
    first = given.index(1)
    return tuple(given[first:] + given[:first])


def even_angles(order: Sequence[int], cycle: float) -> tuple[float, ...]:
    """Return the firing angles of equal intervals. [deg]

    By number of the cylinder, from the firing of cylinder 1.
    """
    index = {number: place for place, number in enumerate(order)}
    return tuple(index[number] * cycle / len(order) for number in sorted(index))


def firing_angles(
    order: Sequence[int], dead_centres: Sequence[float], cycle: float, *, together: bool = False
) -> tuple[float, ...] | None:
    """Return the firing angles of an order on a given crankshaft, the most even ones, or None if there are none.

    By number of the cylinder, from the firing of cylinder 1 [deg]. `cycle`: 720 or 360; in a cycle of 720 a cylinder
    fires at every other dead centre [deg]; `together`: whether two may fire at once.
    """
    turns = round(cycle / _TURN)
    best: tuple[float, tuple[float, ...]] | None = None
    # in the order, the cylinders of the first turn come before those of the second
    for first in range(len(order), 0, -1) if turns > 1 else (len(order),):
        angles = tuple(dead_centres[number - 1] + _TURN * (place >= first) for place, number in enumerate(order))
        steps = intervals(angles, cycle)
        if min(steps) > (-SAME_ANGLE if together else SAME_ANGLE):
            unevenness = sum(step * step for step in steps)
            if best is None or unevenness < best[0] - SAME_ANGLE:
                best = unevenness, angles
    if best is None:
        return None
    by_number = dict(zip(order, best[1], strict=True))
    return tuple(by_number[number] for number in sorted(by_number))


def intervals(angles: Sequence[float], cycle: float) -> tuple[float, ...]:
    """Return the angles from each firing to the next, around the cycle. [deg]

    `angles`: firing angles in the order of firing; an interval is negative where they descend [deg].
    """
    following = (*angles[1:], angles[0] + cycle)
    return tuple(_decimal(later - earlier) for earlier, later in zip(angles, following, strict=True))


def _decimal(angle: float) -> float:
    near = round(angle, _DECIMALS)
    return near if abs(angle - near) < 1e-12 else angle


def is_even(steps: Sequence[float]) -> bool:
    """Return whether all intervals are the same.

    `steps`: intervals [deg].
    """
    return max(steps) - min(steps) <= SAME_ANGLE


def even_orders(dead_centres: Sequence[float], cycle: float, *, limit: int = 1000) -> tuple[tuple[int, ...], ...]:
    """Return the firing orders of equal intervals that a crankshaft allows.

    Orders that start with 1, in ascending order.

    Examples
    --------
    >>> even_orders((0.0, 180.0, 180.0, 0.0), 720.0)
    ((1, 2, 4, 3), (1, 3, 4, 2))
    """
    return tuple(sorted(islice(_even_orders(dead_centres, cycle), limit)))


def _even_orders(dead_centres: Sequence[float], cycle: float) -> Iterator[tuple[int, ...]]:
    """Yield every assignment of the cylinders of each dead centre to the firings at it."""
    count = len(dead_centres)
    slots: dict[float, list[int]] = {}
    for firing in range(count):
        slots.setdefault(round(wrap_angle(firing * cycle / count), 5) % _TURN, []).append(firing)
    waiting: dict[float, list[int]] = {}
    for number, angle in enumerate(dead_centres, start=1):
        waiting.setdefault(round(wrap_angle(angle), 5) % _TURN, []).append(number)
    if {angle: len(members) for angle, members in slots.items()} != {
        angle: len(members) for angle, members in waiting.items()
    }:
        return
    for choice in product(*(permutations(waiting[angle]) for angle in slots)):
        order = [0] * count
        for group, numbers in zip(slots.values(), choice, strict=True):
            for slot, number in zip(group, numbers, strict=True):
                order[slot] = number
        if order[0] == 1:
            yield tuple(order)


def possible_order(dead_centres: Sequence[float], cycle: float) -> tuple[int, ...]:
    """Return the firing order that a crankshaft allows, equal intervals or not, or in which two fire at once.

    It starts with 1; in a cycle of 720 every other cylinder fires in the second turn.
    """
    turns = round(cycle / _TURN)
    ranked = sorted(range(len(dead_centres)), key=lambda index: (dead_centres[index], index))
    angles = {index + 1: dead_centres[index] + _TURN * (rank % turns) for rank, index in enumerate(ranked)}
    return tuple(sorted(angles, key=lambda number: angles[number]))
