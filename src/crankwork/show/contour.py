"""Contour lines over a grid, with their numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.locale.numbers import number
from crankwork.show.canvas import WIDER, text_width
from crankwork.show.chart import Graph

# size of numbers, distance between numbers, and from the edges of the graph [pt]
_SIZE, _SPACING, _EDGE = 7.5, 30.0, 9.0
# a shorter line has no number [pt]
_SHORT = 45.0


class Field:
    """Heights over a grid of shape (across, up), split into triangles; nan makes a hole."""

    def __init__(self, x: Array, y: Array, z: Array) -> None:
        across, up = np.meshgrid(x, y, indexing="ij")
        points = np.stack([across, up, z], axis=-1)
        # a fifth point amid four corners makes the course of lines unique
        middle = (points[:-1, :-1] + points[1:, :-1] + points[:-1, 1:] + points[1:, 1:]) / 4
        nodes = np.arange(z.size).reshape(z.shape)
        ring = nodes[:-1, :-1], nodes[1:, :-1], nodes[1:, 1:], nodes[:-1, 1:]
        centre = z.size + np.arange(middle[..., 0].size).reshape(middle.shape[:2])
        self._points = np.concatenate([points.reshape(-1, 3), middle.reshape(-1, 3)])
        sides = zip(ring, ring[1:] + ring[:1], strict=True)
        corners = [np.stack([start, end, centre], axis=-1) for start, end in sides]
        self._triangles = np.sort(np.array(corners).reshape(-1, 3), axis=1)
        self.holes = np.isnan(middle[..., 2])

    def lines(self, level: float) -> list[Array]:
        """Return the contour lines of a height, each of shape (n, 2)."""
        height = self._points[self._triangles, 2] - level
        with np.errstate(invalid="ignore"):
            is_over = height >= 0
        is_cut = is_over.any(axis=1) & ~is_over.all(axis=1) & np.isfinite(height).all(axis=1)
        neighbours: dict[tuple[int, int], list[tuple[int, int]]] = {}
        for triangle, over in zip(self._triangles[is_cut].tolist(), is_over[is_cut].tolist(), strict=True):
            first, second = ((triangle[a], triangle[b]) for a, b in ((0, 1), (0, 2), (1, 2)) if over[a] != over[b])
            neighbours.setdefault(first, []).append(second)
            neighbours.setdefault(second, []).append(first)
        # open lines before closed ones
        starts = [edge for edge, adjacent in neighbours.items() if len(adjacent) == 1] + list(neighbours)
        return [self._points_on(edges, level) for start in starts if len(edges := _follow_line(neighbours, start)) > 1]

    def _points_on(self, edges: list[tuple[int, int]], level: float) -> Array:
        start, end = self._points[np.array(edges).T]
        share = (level - start[:, 2:]) / (end[:, 2:] - start[:, 2:])
        return np.asarray(start[:, :2] + share * (end[:, :2] - start[:, :2]))


def _follow_line(
    neighbours: dict[tuple[int, int], list[tuple[int, int]]], start: tuple[int, int]
) -> list[tuple[int, int]]:
    """Return the edges that a line crosses from a first one, and remove them from the neighbours."""
    edges = [start]
    while neighbours.get(edges[-1]):
        following = neighbours[edges[-1]].pop()
        neighbours[following].remove(edges[-1])
        edges.append(following)
    return edges


def contours(graph: Graph, field: Field, levels: Array, mark: tuple[float, float] | None = None) -> None:
    """Draw contour lines with their numbers, none where a mark is on the canvas. [pt]"""
    lines_by_level = {level: field.lines(level) for level in levels.tolist()}
    for level, lines in lines_by_level.items():
        for index, line in enumerate(lines):
            graph.curve(f"{level:g}_{index}", line[:, 0], line[:, 1], width=0.9)
    occupied = [] if mark is None else [np.array(mark)]
    for level, lines in lines_by_level.items():
        shown = [np.column_stack([graph.across(line[:, 0]), graph.down(line[:, 1])]) for line in lines]
        for line in sorted(shown, key=_length, reverse=True):
            text = number(level, graph.language)
            half = WIDER * text_width(text, _SIZE) / 2
            position = _free(line, graph, occupied, half) if _length(line) >= _SHORT else None
            if position is not None:
                occupied.append(position)
                graph.text_on_white(float(position[0]), float(position[1]) + 0.35 * _SIZE, text, "middle", _SIZE)


def _length(line: Array) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


def _free(line: Array, graph: Graph, occupied: list[NDArray[np.float64]], half: float) -> NDArray[np.float64] | None:
    """Return the position on a line that is farthest from occupied ones, or near the middle if there are none.

    `half`: half the width of a number. [pt]
    """
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    samples = np.linspace(0.0, along[-1], 41)
    positions = np.column_stack([np.interp(samples, along, line[:, axis]) for axis in (0, 1)])
    left, top, width, height = graph.box
    # the axis is at the left edge; the right edge is free
    low, high = np.array([left + half + 4, top + _EDGE]), np.array([left + width, top + height - _EDGE])
    distance = np.full(len(positions), 4 * _SPACING)
    for point in occupied:
        distance = np.minimum(distance, np.hypot(*(positions - point).T))
    distance = np.where(((positions > low) & (positions < high)).all(axis=1), distance, 0.0)
    best = int(np.argmax(distance - 1e-3 * np.abs(samples - along[-1] / 2)))
    return positions[best] if distance[best] >= _SPACING else None
