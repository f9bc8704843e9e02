"""What single values take of columns where these change a little, and single values of parts of the cycle."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.graph import Value, in_order
from crankwork.kernel.grid import Grid
from crankwork.kernel.reduced import Block, Extreme

Array = NDArray[np.float64]

# of a change of a polynomial over its panel, what is no longer level
_LEVEL = 1e-6


def in_part(key: str, part: int) -> str:
    """Return what a single value is called that looks for extremes in one part of the cycle."""
    return f"{key} in {part}"


def apart(value: Value, parts: int) -> list[Value]:
    """Return a single value with its one extreme looked for in each part of the cycle; none where it is no such one.

    The extreme of the whole cycle changes its place at once where two are level; each part's own goes on.
    """
    inner = list(in_order([value], into=lambda one: one.kind != "reduction"))
    extremes = [one for one in inner if one.kind == "reduction"]
    if len(extremes) != 1 or extremes[0].detail not in ("max", "min"):
        return []
    found = []
    for part in range(parts):
        made: dict[int, Value] = {}
        for one in inner:
            operands = [made.get(other.at, other) for other in one.operands]
            if one is extremes[0]:
                made[one.at] = one.graph.reduction(f"{one.detail} {part}", *one.operands)
            elif any(new is not old for new, old in zip(operands, one.operands, strict=True)):
                made[one.at] = one.graph.apply(one.kind, *operands)
        found.append(made[value.at])
    return found


class Taken(NamedTuple):
    """What a reduction takes of a column, or of its square, at crank angles, each in a panel. [deg]"""

    column: Value
    degrees: Array
    panels: NDArray[np.intp]
    weights: Array
    is_square: bool = False


class Taking:
    """What the reductions of one design take of its columns, and of the angles where laws end that it moves.

    `edges`: which of these each edge of a panel is, -1 where it is none.
    """

    def __init__(self, block: Block, grid: Grid, edges: NDArray[np.intp]) -> None:
        self._block, self._exact, self._edges = block, block.followed, edges
        self._degrees, self._weights = self._exact.nodes
        self._panels = grid.panel[: grid.nodes]
        # of the reduction that was asked for last [1/deg]
        self.of_ends = np.zeros(int(edges.max(initial=-1)) + 1)

    def of(self, one: Value) -> list[Taken]:
        """Return what a reduction takes of its columns; `of_ends` tells what of the ends of laws."""
        self.of_ends = np.zeros_like(self.of_ends)
        match one.detail:
            case "mean" | "integral":
                part = 1.0 / (self._block.cycle if one.detail == "mean" else 1.0)
                if self._block.is_root(one.operands[0]):
                    return [self._of_root(one.operands[0], part)]
                return [self._integral(one.operands[0], part * self._weights, np.full(self._edges.size, part))]
            case "range" | "tangents":
                both = zip((1.0, -1.0), self._block.range(one), one.operands[2:] or (None, None), strict=True)
                return [taken for sign, found, slope in both for taken in self._work(one, sign, found, slope)]
        return [self._extreme(one)]

    def _integral(self, column: Value, weights: Array, at_edges: Array) -> Taken:
        """Return what an integral takes: where a law ends later its jump counts, times a factor of each edge."""
        moving = np.flatnonzero(self._edges >= 0)
        if moving.size:
            values = self._block.column(column)[0, :, 0].reshape(-1, self._exact.each)
            jumps = np.pad(values[:-1, -1] - values[1:, 0], 1) * at_edges
            np.add.at(self.of_ends, self._edges[moving], np.radians(jumps[moving]))
        return Taken(column, self._degrees, self._panels, weights)

    def _of_root(self, column: Value, part: float) -> Taken:
        """Return what an integral takes of the square of a column, which has no corner where that vanishes."""
        weights = self._exact.at_roots(self._block.column(column)[..., :1] ** 2)
        taken = self._integral(column, part * weights, np.full(self._edges.size, part))
        return taken._replace(is_square=True)

    def _work(self, one: Value, sign: float, found: Extreme, slope: Value | None) -> Iterator[Taken]:
        """Yield what the work of a column about its mean takes at an extreme, less a tangent times an inertia."""
        column, (panel, u) = one.operands[0], found.place
        self._add_corner(found, 1.0)
        part = self._exact.up_to(panel, u)
        share = part.sum() / self._block.cycle
        sign *= 1.0 if slope is None else -1.0
        before = np.arange(self._edges.size) <= panel
        yield self._integral(column, sign * (part - share * self._weights), sign * (before - share))
        if slope is not None:
            for of, other in ((one.operands[1], slope), (slope, one.operands[1])):
                value, *_ = self._exact.around(panel, u)
                read = float(value @ self._block.column(other)[0, self._exact.of_panel(panel), 0])
                yield self._point(of, found, sign * read)

    def _extreme(self, one: Value) -> Taken:
        found, is_angle = self._block.extreme(one)
        column, (panel, u) = one.operands[0], found.place
        is_square, at = self._block.is_root(column), self._exact.of_panel(panel)
        if not is_angle:
            weight = 0.5 / float(self._block.value(one)[0]) if is_square else 1.0
            self._add_corner(found, weight)
            return self._point(column, found, weight)._replace(is_square=is_square)
        _, first, second = self._exact.around(panel, u)
        values = found.columns[0, at, 0]
        if abs(first @ values) * np.ptp(np.radians(self._degrees[at])) > 2 * _LEVEL * np.ptp(values):
            # a corner stays, or goes with the end of a law
            if self._end(panel, u) >= 0:
                self.of_ends[self._end(panel, u)] += np.radians(1.0)
            return Taken(column, np.zeros(0), np.zeros(0, dtype=np.intp), np.zeros(0))
        return Taken(column, self._degrees[at], self._panels[at], -first / (second @ values), is_square)

    def _point(self, column: Value, found: Extreme, weight: float) -> Taken:
        return Taken(column, np.degrees(found.peaks.angle[:, 0]), found.peaks.panel[:, 0], np.array([weight]))

    def _add_corner(self, found: Extreme, weight: float) -> None:
        """Add what an extreme at the end of a law takes of that: it goes up or down the column with it."""
        panel, u = found.place
        if self._end(panel, u) >= 0:
            _, first, _ = self._exact.around(panel, u)
            values = found.columns[0, self._exact.of_panel(panel), 0]
            self.of_ends[self._end(panel, u)] += np.radians(weight * float(first @ values))

    def _end(self, panel: int, u: float) -> int:
        """Return which end of a law a place in a panel is, -1 where it is none."""
        return int(self._edges[panel + (u > 0)]) if abs(u) == 1.0 else -1
