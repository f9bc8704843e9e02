"""Lines of equal height over a grid, and numbers on them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.locale.numbers import number
from crankwork.show.chart import Graph
from crankwork.show.paper import WIDER, text_width

# letters of numbers, how far numbers stay from each other, and from the edges of the graph [pt]
_SIZE, _APART, _EDGE = 7.5, 30.0, 9.0
# a line that is shorter has no number [pt]
_SHORT = 45.0


class Field:
    """Heights over a grid, of shape (across, up), parted into triangles; without height there is a hole."""

    def __init__(self, x: Array, y: Array, z: Array) -> None:
        across, up = np.meshgrid(x, y, indexing="ij")
        points = np.stack([across, up, z], axis=-1)
        # a fifth point amid four corners leaves no doubt how lines go through
        middle = (points[:-1, :-1] + points[1:, :-1] + points[:-1, 1:] + points[1:, 1:]) / 4
        nodes = np.arange(z.size).reshape(z.shape)
        ring = nodes[:-1, :-1], nodes[1:, :-1], nodes[1:, 1:], nodes[:-1, 1:]
        centre = z.size + np.arange(middle[..., 0].size).reshape(middle.shape[:2])
        self._points = np.concatenate([points.reshape(-1, 3), middle.reshape(-1, 3)])
        corners = [
            np.stack([one, other, centre], axis=-1) for one, other in zip(ring, ring[1:] + ring[:1], strict=True)
        ]
        self._triangles = np.sort(np.array(corners).reshape(-1, 3), axis=1)
        self.holes = np.isnan(middle[..., 2])

    def lines(self, level: float) -> list[Array]:
        """Return the lines of a height, each of shape (n, 2)."""
        height = self._points[self._triangles, 2] - level
        with np.errstate(invalid="ignore"):
            is_over = height >= 0
        is_cut = is_over.any(axis=1) & ~is_over.all(axis=1) & np.isfinite(height).all(axis=1)
        ways: dict[tuple[int, int], list[tuple[int, int]]] = {}
        for triangle, over in zip(self._triangles[is_cut].tolist(), is_over[is_cut].tolist(), strict=True):
            one, other = ((triangle[a], triangle[b]) for a, b in ((0, 1), (0, 2), (1, 2)) if over[a] != over[b])
            ways.setdefault(one, []).append(other)
            ways.setdefault(other, []).append(one)
        # those with ends before those that are closed
        starts = [edge for edge, next_ones in ways.items() if len(next_ones) == 1] + list(ways)
        return [self._places(found, level) for start in starts if len(found := _followed(ways, start)) > 1]

    def _places(self, edges: list[tuple[int, int]], level: float) -> Array:
        start, end = self._points[np.array(edges).T]
        share = (level - start[:, 2:]) / (end[:, 2:] - start[:, 2:])
        return np.asarray(start[:, :2] + share * (end[:, :2] - start[:, :2]))


def _followed(ways: dict[tuple[int, int], list[tuple[int, int]]], start: tuple[int, int]) -> list[tuple[int, int]]:
    """Return the edges that a line goes through from one on, and take the way away."""
    found = [start]
    while ways.get(found[-1]):
        following = ways[found[-1]].pop()
        ways[following].remove(found[-1])
        found.append(following)
    return found


def contours(graph: Graph, field: Field, levels: Array, mark: tuple[float, float] | None = None) -> None:
    """Draw lines of equal height with their numbers, none where a mark stands on the paper. [pt]"""
    every = {level: field.lines(level) for level in levels.tolist()}
    for level, lines in every.items():
        for at, line in enumerate(lines):
            graph.curve(f"{level:g}_{at}", line[:, 0], line[:, 1], width=0.9)
    taken = [] if mark is None else [np.array(mark)]
    for level, lines in every.items():
        shown = [np.column_stack([graph.across(line[:, 0]), graph.down(line[:, 1])]) for line in lines]
        for line in sorted(shown, key=_length, reverse=True):
            text = number(level, graph.language)
            half = WIDER * text_width(text, _SIZE) / 2
            place = _free(line, graph, taken, half) if _length(line) >= _SHORT else None
            if place is not None:
                taken.append(place)
                graph.boxed(float(place[0]), float(place[1]) + 0.35 * _SIZE, text, "middle", _SIZE)


def _length(line: Array) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


def _free(line: Array, graph: Graph, taken: list[NDArray[np.float64]], half: float) -> NDArray[np.float64] | None:
    """Return the place on a line that is the farthest from what is taken, near the middle if nothing is.

    `half`: half of what a number is wide. [pt]
    """
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    at = np.linspace(0.0, along[-1], 41)
    places = np.column_stack([np.interp(at, along, line[:, axis]) for axis in (0, 1)])
    left, top, width, height = graph.box
    # the axis stands at the left, and nothing at the right
    low, high = np.array([left + half + 4, top + _EDGE]), np.array([left + width, top + height - _EDGE])
    apart = np.full(len(places), 4 * _APART)
    for one in taken:
        apart = np.minimum(apart, np.hypot(*(places - one).T))
    apart = np.where(((places > low) & (places < high)).all(axis=1), apart, 0.0)
    best = int(np.argmax(apart - 1e-3 * np.abs(at - along[-1] / 2)))
    return places[best] if apart[best] >= _APART else None
