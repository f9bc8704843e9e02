"""Names beside points of a curve, placed so that they cover neither lines nor each other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.show.chart import Graph
from crankwork.show.paper import GREY, plain
from crankwork.show.scene import printable

_SIZE = 8.0
_SPACING, _ALIKE = 2.5, 1.25
_LONGEST = 16
_REACHES = np.array([8.0, 11.0, 15.0, 20.0, 26.0, 33.0, 41.0, 50.0])
_ANGLES = np.radians([45, 135, 90, 0, 180, 315, 225, 270, 22, 67, 112, 157, 202, 247, 292, 337])
_DIRECTIONS = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])

Line = tuple[Sequence[float] | Array, Sequence[float] | Array]
Box = tuple[Array, Array]


def label_points(graph: Graph, points: Sequence[tuple[str, float, float]], *lines: Line) -> None:
    """Mark points and name them, with a thin line to names that had to go further away.

    Points that fall together share one mark.
    """
    points = _merged(graph, points)
    if not points:
        return
    left, top, width, height = graph.box
    for _, x, y in points:
        graph.paper.dot(*graph.point(x, y), 1.3)
    frame = np.array([[left, -(top + height)], [left + width, -top]])
    low, high = sorted(graph.y)
    axis = -float(graph.down(0.0)) if low < 0 < high else -(top + height)
    edges = np.array([frame[0], [left, -top]]), np.array([[left, axis], [left + width, axis]])
    marks = _on_paper(graph, ([x for _, x, _ in points], [y for _, _, y in points]))
    obstacles = np.vstack([marks, *(_spread(one) for one in (*(_on_paper(graph, line) for line in lines), *edges))])
    # where lines crowd, their points are not counted twice, so that each name takes about as long as the first
    obstacles = np.unique(np.round(obstacles / _ALIKE), axis=0) * _ALIKE
    placed: list[Box] = []
    for (name, _, _), mark in zip(points, marks, strict=True):
        half = np.array([0.31 * _SIZE * len(name) + 0.8, 0.5 * _SIZE])
        others = marks[np.any(marks != mark, axis=1)]
        shift = _best_shift(mark, half, placed, obstacles, others, frame)
        placed.append((mark + shift, half))
        obstacles = np.vstack([obstacles, _spread(np.array([mark, mark + shift]))])
        is_far = np.max(np.abs(shift) - half) > 6 or bool(_is_misleading(mark, shift[None], others)[0])
        _write(graph, name, mark, shift, half, with_line=is_far)


def _write(graph: Graph, name: str, mark: Array, shift: Array, half: Array, *, with_line: bool) -> None:
    x, y = mark + shift
    if with_line:
        # to where the name begins
        share = 1.0 - min(1.0, float(np.min(half / np.maximum(np.abs(shift), 1e-9))))
        end = mark + share * shift
        graph.paper.line([mark[0], end[0]], [-mark[1], -end[1]], width=0.4, colour=GREY)
    graph.paper.text(float(x), float(-y) + 0.35 * _SIZE, plain(name), size=_SIZE, anchor="middle")


def _is_misleading(mark: Array, shifts: Array, others: Array) -> NDArray[np.bool_]:
    """Return where a name would stand about as near to another mark as to its own."""
    own = np.hypot(*shifts.T)
    nearest = np.min(np.hypot(*np.moveaxis(mark + shifts[:, None] - others, -1, 0)), axis=1, initial=np.inf)
    return np.asarray(nearest < 1.2 * own)


def _best_shift(
    mark: Array, half: Array, placed: Sequence[Box], obstacles: Array, others: Array, frame: Array
) -> Array:
    """Return where the middle of a name goes, from its mark: clear first, then near. [pt]"""
    room = _REACHES[-1] + 2 * half + 4
    near = obstacles[np.all(np.abs(obstacles - mark) < room, axis=1)]
    others = others[np.all(np.abs(others - mark) < 3 * _REACHES[-1] + 2 * half, axis=1)]
    middles, halves = (np.array(one).reshape(-1, 2) for one in (zip(*placed, strict=True) if placed else ((), ())))
    close = np.all(np.abs(middles - mark) < room + halves, axis=1)
    names = middles[close], halves[close]
    best, least = np.zeros(2), np.inf
    for reach in _REACHES:
        # a place further away costs more, however clear it is
        if reach >= least:
            break
        shifts = _DIRECTIONS * (reach + np.abs(_DIRECTIONS) * (half - half.min()))
        cost = reach + 0.1 * np.arange(len(shifts)) + _hidden(mark, shifts, half, names, near)
        cost += 12.0 * _is_misleading(mark, shifts, others)
        low, high = mark + shifts - half, mark + shifts + half
        cost += 200.0 * np.any((low < frame[0]) | (high > frame[1]), axis=1)
        at = int(np.argmin(cost))
        if cost[at] < least:
            best, least = shifts[at], float(cost[at])
    return best


def _hidden(mark: Array, shifts: Array, half: Array, names: Box, near: Array) -> Array:
    """Return what lines and other names under each place of a name cost, and names under the line to it."""
    centres, (middles, halves) = mark + shifts, names
    cost = 10.0 * np.all(np.abs(centres[:, None] - near) < half + 1.0, axis=2).sum(axis=1)
    cost += 500.0 * np.all(np.abs(centres[:, None] - middles) < half + halves + 0.5, axis=2).sum(axis=1)
    towards = mark + shifts[:, None, None] * np.linspace(0.1, 1.0, 10)[:, None, None]
    crossed = np.any(np.all(np.abs(towards - middles) < halves, axis=3), axis=1)
    return np.asarray(cost + 40.0 * crossed.sum(axis=1))


def _on_paper(graph: Graph, line: Line) -> Array:
    """Return coordinates of a graph in points of the paper, upward."""
    x, y = (np.asarray(one, dtype=float) for one in line)
    return np.column_stack([graph.across(x), -graph.down(y)])


def _spread(line: Array) -> Array:
    """Return points along a line at even distances on paper."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    even = np.arange(0.0, length[-1], _SPACING)
    return np.column_stack([np.interp(even, length, line[:, 0]), np.interp(even, length, line[:, 1])])


def _merged(graph: Graph, points: Sequence[tuple[str, float, float]]) -> list[tuple[str, float, float]]:
    """Return the points with printable names, those within a point of the paper joined."""
    result: list[tuple[str, float, float]] = []
    places: list[Array] = []
    for name, x, y in points:
        text, here = printable(name, _LONGEST), _on_paper(graph, ([x], [y]))[0]
        same = [i for i, place in enumerate(places) if np.hypot(*(place - here)) < 1.0]
        if same:
            first, *place = result[same[0]]
            result[same[0]] = (", ".join(dict.fromkeys([*first.split(", "), text])), place[0], place[1])
        else:
            result.append((text, x, y))
            places.append(here)
    return result
