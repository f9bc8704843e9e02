"""Names beside the marks of a curve on paper, where they cover neither lines nor each other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from crankwork.analysis import Array
from crankwork.show.chart import Box
from crankwork.show.paper import GREY, Paper, text_width

_SPACING = 3.0
_ANGLES = np.radians(np.arange(16) * 22.5)
_DIRECTIONS = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])
_REACHES = (7.0, 10.0, 14.0, 19.0, 25.0, 32.0)


def spread(x: Array, y: Array) -> Array:
    """Return points along a line at even distances, shape (m, 2). [pt]"""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
    even = np.arange(0.0, length[-1] + _SPACING, _SPACING)
    return np.column_stack([np.interp(even, length, x), np.interp(even, length, y)])


def label_marks(
    paper: Paper,
    marks: Sequence[tuple[str, float, float]],
    obstacles: Array,
    *,
    size: float = 8.0,
    dot: float = 1.5,
    frame: Box | None = None,
) -> None:
    """Draw marks with their names; those that fall together share one mark, far names get a thin line.

    `obstacles`: points to keep clear of [pt], shape (n, 2).
    """
    marks = _merged(marks)
    places = np.array([(x, y) for _, x, y in marks])
    taken: list[tuple[Array, Array]] = []
    for name, x, y in marks:
        mark = np.array([x, y])
        half = np.array([text_width(name, size) / 2 + 0.8, 0.42 * size])
        others = places[np.any(places != mark, axis=1)]
        shift = _shift(mark, half, taken, obstacles, others, frame)
        taken.append((mark + shift, half))
        if np.max(np.abs(shift) - half) > 6:
            start, end = (
                mark + 0.12 * shift,
                mark + shift * (1 - np.min((half + 0.5) / np.maximum(np.abs(shift), 1e-9))),
            )
            paper.segments(np.array([[*start, *end]]), width=0.4, colour=GREY)
        paper.dot(x, y, dot)
        paper.text(x + float(shift[0]), y + float(shift[1]) + 0.36 * size, name, size=size, anchor="middle")


def _shift(
    mark: Array,
    half: Array,
    taken: Sequence[tuple[Array, Array]],
    obstacles: Array,
    others: Array,
    frame: Box | None,
) -> Array:
    """Return where the middle of a name goes from its mark: clear first, then near; near rings come first. [pt]"""
    best, least = np.zeros(2), np.inf
    near = obstacles[np.all(np.abs(obstacles - mark) < _REACHES[-1] + 2 * half + 4, axis=1)]
    for reach in _REACHES:
        if reach >= least:
            break
        shifts = _DIRECTIONS * (reach + np.abs(_DIRECTIONS) * (half - half.min()))
        cost = reach + 0.05 * np.arange(len(shifts)) + _hidden(mark, shifts, half, taken, near, others)
        if frame is not None:
            low, high = np.array(frame[:2]), np.array(frame[:2]) + np.array(frame[2:])
            cost += 100.0 * np.any((mark + shifts - half < low) | (mark + shifts + half > high + 6), axis=1)
        at = int(np.argmin(cost))
        if cost[at] < least:
            best, least = shifts[at], float(cost[at])
    return best


def _hidden(
    mark: Array, shifts: Array, half: Array, taken: Sequence[tuple[Array, Array]], near: Array, others: Array
) -> Array:
    """Return what is wrong with each place of a name: lines under it, other marks, other names."""
    centres = mark + shifts
    across = np.abs(centres[:, :1] - near[:, 0]) < half[0] + 0.8
    cost = 10.0 * np.count_nonzero(across & (np.abs(centres[:, 1:] - near[:, 1]) < half[1] + 0.8), axis=1)
    if len(others):
        x, y = centres[:, :1] - others[:, 0], centres[:, 1:] - others[:, 1]
        cost += 14.0 * (np.hypot(x, y).min(axis=1) < 1.15 * np.hypot(*shifts.T))
        cost += 60.0 * np.any((np.abs(x) < half[0] + 1.6) & (np.abs(y) < half[1] + 1.6), axis=1)
    if taken:
        middles, sizes = (np.array(one) for one in zip(*taken, strict=True))
        cost += 500.0 * np.any(np.all(np.abs(centres[:, None] - middles) < half + sizes + 0.5, axis=2), axis=1)
        between = mark + shifts[:, None, None] * np.array([0.35, 0.7])[:, None, None]
        cost += 40.0 * np.any(np.all(np.abs(between - middles) < sizes, axis=3), axis=(1, 2))
    return np.asarray(cost)


def _merged(marks: Sequence[tuple[str, float, float]]) -> list[tuple[str, float, float]]:
    """Return the marks, those within a point of the paper joined."""
    result: list[tuple[str, float, float]] = []
    for name, x, y in marks:
        same = [at for at, (_, a, b) in enumerate(result) if np.hypot(a - x, b - y) < 1.0]
        if same:
            first, a, b = result[same[0]]
            result[same[0]] = (", ".join(dict.fromkeys([*first.split(", "), name])), a, b)
        else:
            result.append((name, float(x), float(y)))
    return result
