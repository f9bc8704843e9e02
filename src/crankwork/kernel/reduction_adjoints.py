"""Linearised reductions of columns, and reductions over parts of the cycle."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.block_reductions import Block, Extreme
from crankwork.kernel.graph import KernelValue, in_order
from crankwork.kernel.grid import Grid

Array = NDArray[np.float64]

# slope of a level polynomial, relative to its range over the panel
_LEVEL = 1e-6


def part_key(key: str, part: int) -> str:
    """Return the key of a single value with the extreme of one part of the cycle."""
    return f"{key} in {part}"


def split_extreme(value: KernelValue, parts: int) -> list[KernelValue]:
    """Return a single value with its one extreme taken in each part of the cycle; empty if it has not exactly one.

    The position of the extreme of the whole cycle jumps if two are level; those of parts are continuous.
    """
    nodes = list(in_order([value], into=lambda node: node.kind != "reduction"))
    extremes = [node for node in nodes if node.kind == "reduction"]
    if len(extremes) != 1 or extremes[0].detail not in ("max", "min"):
        return []
    values = []
    for part in range(parts):
        results: dict[int, KernelValue] = {}
        for node in nodes:
            operands = [results.get(operand.index, operand) for operand in node.operands]
            if node is extremes[0]:
                results[node.index] = node.graph.reduction(f"{node.detail} {part}", *node.operands)
            elif any(new is not old for new, old in zip(operands, node.operands, strict=True)):
                results[node.index] = node.graph.apply(node.kind, *operands)
        values.append(results[value.index])
    return values


class ColumnWeights(NamedTuple):
    """Weights of a linearised reduction for a column, or its square, at crank angles with their panels. [deg]"""

    column: KernelValue
    degrees: Array
    panels: NDArray[np.intp]
    weights: Array
    is_square: bool = False


class ReductionAdjoint:
    """Derivatives of the reductions of one design by its columns, and by the crank angles of its ends of laws.

    `edges`: index of the end of a law at each edge of a panel, -1 if there is none.
    """

    def __init__(self, block: Block, grid: Grid, edges: NDArray[np.intp]) -> None:
        self._block, self._exact, self._edges = block, block.polynomials, edges
        self._degrees, self._weights = self._exact.nodes
        self._panels = grid.panel[: grid.nodes]
        # of the last reduction [1/deg]
        self.end_weights = np.zeros(int(edges.max(initial=-1)) + 1)

    def weights(self, reduction: KernelValue) -> list[ColumnWeights]:
        """Return the weights of the columns of a reduction, and set `end_weights` to those of the ends of laws."""
        self.end_weights = np.zeros_like(self.end_weights)
        column = reduction.operands[0]
        match reduction.detail:
            case "mean" | "integral":
                factor = 1.0 / (self._block.cycle if reduction.detail == "mean" else 1.0)
                if self._block.is_root(column):
                    return [self._of_root(column, factor)]
                return [self._integral(column, factor * self._weights, np.full(self._edges.size, factor))]
            case "range" | "tangents":
                slopes = reduction.operands[2:] or (None, None)
                both = zip((1.0, -1.0), self._block.range(reduction), slopes, strict=True)
                return [term for values in both for term in self._work(reduction, *values)]
        return [self._extreme(reduction)]

    def _integral(self, column: KernelValue, weights: Array, at_edges: Array) -> ColumnWeights:
        """Return the weights of an integral; jumps at ends of laws, times a factor, are weights of their angles."""
        moving = np.flatnonzero(self._edges >= 0)
        if moving.size:
            values = self._block.column(column)[0, :, 0].reshape(-1, self._exact.each)
            jumps = np.pad(values[:-1, -1] - values[1:, 0], 1) * at_edges
            np.add.at(self.end_weights, self._edges[moving], np.radians(jumps[moving]))
        return ColumnWeights(column, self._degrees, self._panels, weights)

    def _of_root(self, column: KernelValue, factor: float) -> ColumnWeights:
        """Return the weights of an integral for the square of a column, which has no corner where it is 0."""
        weights = self._exact.at_roots(self._block.column(column)[..., :1] ** 2)
        terms = self._integral(column, factor * weights, np.full(self._edges.size, factor))
        return terms._replace(is_square=True)

    def _work(
        self, reduction: KernelValue, sign: float, extreme: Extreme, slope: KernelValue | None
    ) -> Iterator[ColumnWeights]:
        """Yield the weights of the work of a column about its mean at an extreme, less a slope times an inertia."""
        column, (panel, u) = reduction.operands[0], extreme.place
        self._add_corner(extreme, 1.0)
        part = self._exact.up_to(panel, u)
        share = part.sum() / self._block.cycle
        sign *= 1.0 if slope is None else -1.0
        before = np.arange(self._edges.size) <= panel
        yield self._integral(column, sign * (part - share * self._weights), sign * (before - share))
        if slope is not None:
            inertia = reduction.operands[1]
            for factor, other in ((inertia, slope), (slope, inertia)):
                value, *_ = self._exact.around(panel, u)
                read = float(value @ self._block.column(other)[0, self._exact.of_panel(panel), 0])
                yield self._point(factor, extreme, sign * read)

    def _extreme(self, reduction: KernelValue) -> ColumnWeights:
        extreme, is_angle = self._block.extreme(reduction)
        column, (panel, u) = reduction.operands[0], extreme.place
        is_square, nodes = self._block.is_root(column), self._exact.of_panel(panel)
        if not is_angle:
            weight = 0.5 / float(self._block.value(reduction)[0]) if is_square else 1.0
            self._add_corner(extreme, weight)
            return self._point(column, extreme, weight)._replace(is_square=is_square)
        _, first, second = self._exact.around(panel, u)
        values = extreme.columns[0, nodes, 0]
        if abs(first @ values) * np.ptp(np.radians(self._degrees[nodes])) > 2 * _LEVEL * np.ptp(values):
            # a corner is fixed, or moves with the end of a law
            if self._end(panel, u) >= 0:
                self.end_weights[self._end(panel, u)] += np.radians(1.0)
            return ColumnWeights(column, np.zeros(0), np.zeros(0, dtype=np.intp), np.zeros(0))
        return ColumnWeights(column, self._degrees[nodes], self._panels[nodes], -first / (second @ values), is_square)

    def _point(self, column: KernelValue, extreme: Extreme, weight: float) -> ColumnWeights:
        peaks = extreme.peaks
        return ColumnWeights(column, np.degrees(peaks.angle[:, 0]), peaks.panel[:, 0], np.array([weight]))

    def _add_corner(self, extreme: Extreme, weight: float) -> None:
        """Add the weight of the angle of an end of a law at which an extreme is, which moves along the column."""
        panel, u = extreme.place
        if self._end(panel, u) >= 0:
            _, first, _ = self._exact.around(panel, u)
            values = extreme.columns[0, self._exact.of_panel(panel), 0]
            self.end_weights[self._end(panel, u)] += np.radians(weight * float(first @ values))

    def _end(self, panel: int, u: float) -> int:
        """Return the index of the end of a law at a point of a panel, -1 if there is none."""
        return int(self._edges[panel + (u > 0)]) if abs(u) == 1.0 else -1
