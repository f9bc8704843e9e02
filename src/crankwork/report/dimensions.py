"""Dimension lines of a linkage as it stands: lengths of its links, distances of its fixed points (ISO 129-1)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.show.scene import Item, Pen, Polyline, Text, line

# letters; half width and length of an arrowhead; how far extension lines go beyond; the shortest length drawn [mm]
_LETTERS, _HEAD, _BEYOND, _SHORTEST = 3.2, (0.5, 2.6), 1.5, 12.0
# how far lines are from what they measure, of a link and beneath supports, and from everything else at least [mm]
_OFF, _BELOW, _CLEAR = (7.0, 10.0, 13.0, 17.0), (15.5, 20.0, 24.5), 5.0
_PLACES = np.linspace(0.0, 1.0, 15)[:, None]


class Length(NamedTuple):
    """The distance of two points, or that along an axis, and what is written there."""

    start: str
    end: str
    text: str
    axis: int | None = None


def dimension_lines(
    lengths: Sequence[Length], points: Mapping[str, Array], obstacles: Array
) -> tuple[list[Item], Array]:
    """Return dimension lines clear of links and letters, and what they cover; short ones are left out. [mm]"""
    links = [points[link.start] + _PLACES * (points[link.end] - points[link.start])
             for link in lengths if link.axis is None]  # fmt: skip
    busy, items = np.vstack([obstacles, *points.values(), *links]), list[Item]()
    for length in lengths:
        start, end = points[length.start], points[length.end]
        if np.hypot(*_along(length, start, end)) < _SHORTEST:
            continue
        p, q = min(_choices(length, start, end, busy), key=lambda ends: _crowding(ends[0], ends[1], busy))
        busy = np.vstack([busy, p + _PLACES * (q - p)])
        items += _drawn(length, (start, end), (p, q))
    return items, busy


def _along(length: Length, start: Array, end: Array) -> Array:
    return end - start if length.axis is None else (end - start) * np.eye(2)[length.axis]


def _choices(length: Length, start: Array, end: Array, busy: Array) -> Iterator[tuple[Array, Array]]:
    """Yield the ends of a dimension line, the nearer ones first."""
    if length.axis is None:
        across = np.array([-(end - start)[1], (end - start)[0]]) / np.hypot(*(end - start))
        yield from ((start + side * off * across, end + side * off * across) for off, side in product(_OFF, (1, -1)))
        return
    other = 1 - length.axis
    for off in _BELOW:
        level = np.eye(2)[other] * (busy[:, other].min() - off if length.axis else min(start[1], end[1]) - off)
        keep = np.eye(2)[length.axis]
        yield start * keep + level, end * keep + level


def _crowding(start: Array, end: Array, busy: Array) -> float:
    """Return how much else is near a line."""
    places = start + _PLACES * (end - start)
    near = np.hypot(*(places[:, None] - busy[None]).T).T
    # what is written in the middle needs more room
    needed = np.where(np.arange(len(places)) == len(places) // 2, 2.0, 1.0) * _CLEAR
    return float(np.sum(np.maximum(0.0, needed[:, None] - near) ** 2))


def arrowhead(tip: Array, ahead: Array) -> Polyline:
    """Return the arrowhead of a dimension line that points ahead, a vector of length 1."""
    back, across = tip - _HEAD[1] * ahead, _HEAD[0] * np.array([-ahead[1], ahead[0]])
    return Polyline(np.array([tip, back + across, back - across]), Pen(0.0), closed=True, fill=0.0)


def _drawn(length: Length, ends: tuple[Array, Array], feet: tuple[Array, Array]) -> Iterator[Item]:
    """Yield extension lines, the line with its arrowheads, and the length on it."""
    along = (feet[1] - feet[0]) / np.hypot(*(feet[1] - feet[0]))
    for point, foot, ahead in zip(ends, feet, (-along, along), strict=True):
        side = foot - point
        # a support and its letter stand between
        gap = 2.0 if length.axis is None else min(_BELOW[0] - 2.0, np.hypot(*side))
        yield line(point + gap * side / np.hypot(*side), foot + _BEYOND * side / np.hypot(*side))
        yield arrowhead(foot, ahead)
    yield line(*feet)
    x, y = ((feet[0] + feet[1]) / 2).tolist()
    yield Text((x, y - _LETTERS / 2), length.text, _LETTERS, "middle", halo=True)
