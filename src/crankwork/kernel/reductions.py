"""Reductions of columns: at evenly spaced angles, or of polynomials between the breaks of laws."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from crankwork.formula.over_cycle import integrals_of_roots
from crankwork.kernel.grid import Grid, Polynomials

Array = NDArray[np.float64]

# of equal values, whatever rounding says, the first counts
PLATEAU = 1e-13
_STEPS = 8
_EQUAL = 8 * float(np.finfo(float).eps)
# of the size of a column, what the mean of a root may miss
_ROUNDING = 1e-12


class Peaks(NamedTuple):
    """The largest of columns, the crank angles where they stand [rad], and in which panel where from -1 to 1.

    Shape (columns, lanes); over evenly spaced angles each is a panel.
    """

    value: Array
    angle: Array
    panel: NDArray[np.intp]
    u: Array

    def part(self, part: int) -> Peaks:
        """Return those of one part, of those of several, shape (columns, parts, lanes)."""
        return Peaks(self.value[:, part], self.angle[:, part], self.panel[:, part], self.u[:, part])

    def of(self, column: int) -> Peaks:
        """Return those of one column, still in its shape."""
        return Peaks(self.value[[column]], self.angle[[column]], self.panel[[column]], self.u[[column]])


class Even:
    """Reductions over evenly spaced crank angles, of columns of shape (columns, angles, lanes)."""

    def __init__(self, grid: Grid) -> None:
        self._grid = grid

    @property
    def count(self) -> int:
        """How many angles there are."""
        return int(self._grid.degrees.size)

    def left_out(self, columns: Array) -> Array:
        """Return nothing: what lies between the angles is not looked at, shape (columns, lanes)."""
        return np.zeros((columns.shape[0], columns.shape[2]))

    def integrals(self, columns: Array) -> Array:
        """Return the integrals of columns over the crank angle, shape (columns, lanes)."""
        return np.asarray(np.matmul(self._grid.weights, columns))

    def of_roots(self, squares: Array) -> Array:
        """Return the integrals of the roots of columns, shape (columns, lanes)."""
        return self.integrals(np.sqrt(squares))

    def running(self, columns: Array) -> Array:
        """Return the integrals of columns from the start of the cycle to each angle, in their shape."""
        steps = (columns + np.roll(columns, -1, axis=1)) / 2 * self._grid.weights[:, None]
        return np.asarray(np.cumsum(steps, axis=1) - steps)

    def largest(self, columns: Array) -> Peaks:
        """Return the largest of columns at the angles, the first of equal ones."""
        return self.largest_in(columns, (0,)).part(0)

    def largest_in(self, columns: Array, starts: Sequence[int]) -> Peaks:
        """Return the largest of columns at the angles of each part that starts at one of them."""
        parts = np.split(columns, starts[1:], axis=1)
        place = np.stack([one.argmax(axis=1) + start for one, start in zip(parts, starts, strict=True)], axis=1)
        value = np.take_along_axis(columns, place, axis=1)
        return Peaks(value, np.radians(self._grid.degrees)[place], place, 0.0 * value)


class Exact:
    """Reductions over the nodes of polynomials, of columns of shape (columns, angles, lanes)."""

    def __init__(self, grid: Grid, polynomials: Polynomials) -> None:
        count = polynomials.nodes.size
        self._nodes, self._to_coefficients = polynomials.nodes, polynomials.coefficients
        self._half = np.radians(np.diff(grid.edges))[:, None] / 2
        self._middle = np.radians(grid.edges[1:] + grid.edges[:-1])[:, None] / 2
        self._degrees, self._weights = grid.degrees[: grid.nodes], grid.weights
        # integral from the left end of a panel to each node, of values at the nodes
        integrals = [legendre.legint(one, lbnd=-1) for one in np.eye(count)]
        self._integrals = np.array(integrals).T @ self._to_coefficients
        self._to_integrals = legendre.legvander(polynomials.nodes, count) @ self._integrals
        derivative = np.pad(legendre.legder(np.eye(count)), ((0, 1), (0, 0)))
        self._slope = derivative
        self._bend = derivative @ derivative

    def moved_to(self, edges: Array, degrees: Array, weights: Array) -> Exact:
        """Return the same between edges that each design has elsewhere, shape (edges, lanes), (angles, lanes)."""
        found = copy.copy(self)
        vars(found).update(
            _half=np.radians(np.diff(edges, axis=0)) / 2,
            _middle=np.radians(edges[1:] + edges[:-1]) / 2,
            _degrees=degrees,
            _weights=weights,
        )
        return found

    def panels(self, columns: Array) -> Array:
        """Return columns with their panels apart, shape (columns, panels, nodes, lanes)."""
        return columns.reshape(len(columns), -1, self._nodes.size, columns.shape[-1])

    def left_out(self, columns: Array) -> Array:
        """Return the last coefficients of columns beside their size, shape (columns, lanes)."""
        values = self.panels(columns)
        last = np.abs(np.matmul(self._to_coefficients[-2:], values)).sum(axis=2)
        size = np.maximum(np.abs(columns).max(axis=1), np.finfo(float).tiny)
        return np.asarray(last.max(axis=1) / size)

    def integrals(self, columns: Array) -> Array:
        """Return the integrals of columns over the crank angle, shape (columns, lanes)."""
        weights = self._weights
        return np.asarray(np.matmul(weights, columns) if weights.ndim == 1 else (weights * columns).sum(axis=1))

    def of_roots(self, squares: Array) -> Array:
        """Return the integrals of the roots of columns, shape (columns, lanes)."""
        coefficients = np.moveaxis(self.series(squares), 2, 3)
        found = integrals_of_roots(coefficients.reshape(-1, self.each), self._limits(squares, coefficients))
        return np.asarray(2 * (self._half * found.reshape(coefficients.shape[:3])).sum(axis=1))

    @staticmethod
    def _limits(squares: Array, coefficients: Array) -> Array:
        """Return what the mean of each root may miss, in one row."""
        limits = _ROUNDING * np.sqrt(np.abs(squares).max(axis=1))[:, None]
        return np.broadcast_to(limits, coefficients.shape[:3]).reshape(-1)

    def running(self, columns: Array) -> Array:
        """Return the integrals of columns from the start of the cycle to each angle, in their shape."""
        values = self.panels(columns)
        within = np.matmul(self._to_integrals, values) * self._half[:, None]
        before = np.cumsum(within[:, :, -1], axis=1) - within[:, :, -1]
        return np.asarray((within + before[:, :, None]).reshape(columns.shape))

    @property
    def edges(self) -> Array:
        """The ends of panels, shape (edges, lanes or 1). [rad]"""
        return np.concatenate([self._middle - self._half, self._middle[-1:] + self._half[-1:]])

    def series(self, columns: Array) -> Array:
        """Return the Legendre coefficients of columns, shape (columns, panels, degrees, lanes)."""
        return np.asarray(np.matmul(self._to_coefficients, self.panels(columns)))

    @property
    def count(self) -> int:
        """How many panels there are."""
        return len(self._half)

    def largest(self, columns: Array) -> Peaks:
        """Return the largest of columns: at an angle, or on the polynomial beside it."""
        return self.largest_in(columns, (0,)).part(0)

    def largest_in(self, columns: Array, starts: Sequence[int]) -> Peaks:
        """Return the largest of columns in each part that starts at a panel, shape (columns, parts, lanes)."""
        values = self.panels(columns)
        highest = values.max(axis=2)
        top = np.maximum.reduceat(highest, starts, axis=1)
        least = np.minimum.reduceat(values.min(axis=2), starts, axis=1)
        part_of = np.repeat(np.arange(len(starts)), np.diff([*starts, self.count]))
        size = np.maximum(np.abs(top), np.abs(least))
        rounding = _EQUAL * size
        # no polynomial comes further from its mean than its other coefficients together
        series = np.matmul(self._to_coefficients, values)
        rise = np.abs(series[:, :, 1:]).sum(axis=2)
        is_high = series[:, :, 0] + rise >= (top - rounding)[:, part_of]
        # where it is level but for rounding its first node is as good as any
        is_level = rise <= (PLATEAU * size)[:, part_of]
        inner = np.pad(values, ((0, 0), (0, 0), (1, 1), (0, 0)), constant_values=-np.inf)
        is_peak = (values >= inner[:, :, :-2]) & (values >= inner[:, :, 2:]) & (is_high & ~is_level)[:, :, None]
        is_peak[:, :, 0] |= is_high & is_level
        column, panel, node, lane = np.nonzero(is_peak)
        at_node, u = values[column, panel, node, lane], self._nodes[node]
        moving = ~is_level[column, panel, lane]
        at_node = np.where(moving, at_node, highest[column, panel, lane])
        at_peak = at_node.copy()
        coefficients = np.ascontiguousarray(series[column[moving], panel[moving], :, lane[moving]].T)
        u[moving] = self._peaks(coefficients, node[moving])
        at_peak[moving] = legendre.legval(u[moving], coefficients, tensor=False)
        # at the end of a panel the column itself counts, and where only rounding tells a peak from it
        of = column, part_of[panel], lane
        is_node = at_node >= at_peak - rounding[of]
        found, u = np.where(is_node, at_node, at_peak), np.where(is_node, self._nodes[node], u)
        best = np.full(top.shape, -np.inf)
        np.maximum.at(best, of, found)
        angle = self._of(self._middle, panel, lane) + self._of(self._half, panel, lane) * u
        with np.errstate(invalid="ignore"):
            is_best = found >= (best - PLATEAU * (np.abs(best) + best - least))[of]
        first = np.full(top.shape, np.inf)
        np.minimum.at(first, tuple(one[is_best] for one in of), angle[is_best])
        is_first = is_best & (angle == first[of])
        place = tuple(one[is_first] for one in of)
        inside, at = np.zeros(top.shape, dtype=np.intp), np.zeros(top.shape)
        inside[place], at[place] = panel[is_first], u[is_first]
        value, angle = (np.where(np.isfinite(top), one, np.nan) for one in (best, first))
        return Peaks(value, angle, inside, at)

    def _peaks(self, coefficients: Array, node: NDArray[np.intp]) -> Array:
        """Return where polynomials have a peak between the neighbours of a node: Newton steps, kept between these."""
        low, high = self._nodes[np.maximum(node - 1, 0)], self._nodes[np.minimum(node + 1, self._nodes.size - 1)]
        slopes, u = np.stack([self._slope @ coefficients, self._bend @ coefficients], axis=1), self._nodes[node]
        for _ in range(_STEPS):
            slope, bend = legendre.legval(u, slopes, tensor=False)
            low, high = np.where(slope > 0, u, low), np.where(slope > 0, high, u)
            with np.errstate(divide="ignore", invalid="ignore"):
                moved = u - slope / bend
            u = np.where(
                (bend < 0) & (moved >= low) & (moved <= high), moved, np.where(slope == 0, u, (low + high) / 2)
            )
        return u

    @staticmethod
    def _of(panels: Array, panel: NDArray[np.intp], lane: NDArray[np.intp]) -> Array:
        return np.asarray(panels[panel, lane if panels.shape[1] > 1 else 0])

    # what follows is of the first lane alone

    @property
    def each(self) -> int:
        """How many nodes a panel has."""
        return int(self._nodes.size)

    @property
    def nodes(self) -> tuple[Array, Array]:
        """The crank angles of nodes [deg], and what an integral over the crank angle takes of each [rad]."""
        first = (one if one.ndim == 1 else one[:, 0] for one in (self._degrees, self._weights))
        return next(first), next(first)

    def of_panel(self, panel: int) -> slice:
        """Return where the nodes of a panel stand."""
        return slice(panel * self.each, (panel + 1) * self.each)

    def up_to(self, panel: int, u: float) -> Array:
        """Return what the integral from the start of the cycle to a place in a panel takes of each node. [rad]"""
        found, at = self.nodes[1].copy(), self.of_panel(panel)
        found[at] = self._half[panel, 0] * (_legendre(u, self.each + 1) @ self._integrals)
        found[at.stop :] = 0.0
        return found

    def at_roots(self, squares: Array) -> Array:
        """Return what the integral of the root of a column takes of each node of this, shape (1, angles, 1). [rad]"""
        coefficients = np.moveaxis(self.series(squares), 2, 3)
        slopes = np.zeros((coefficients.shape[1], self.each))
        integrals_of_roots(coefficients.reshape(-1, self.each), self._limits(squares, coefficients), slopes)
        return (2 * self._half[:, :1] * (slopes @ self._to_coefficients)).ravel()

    def around(self, panel: int, u: float) -> tuple[Array, Array, Array]:
        """Return what a value in a panel, its first and second derivative take of each of the nodes. [1, 1/rad ...]"""
        at, half = _legendre(u, self.each), self._half[panel, 0]
        first, second = (at @ one @ self._to_coefficients for one in (self._slope, self._bend))
        return at @ self._to_coefficients, first / half, second / half**2


def _legendre(u: float, count: int) -> Array:
    """Return so many of Legendre's polynomials at a place."""
    found = [1.0, u]
    for n in range(1, count - 1):
        found.append(((2 * n + 1) * u * found[n] - n * found[n - 1]) / (n + 1))
    return np.array(found)
