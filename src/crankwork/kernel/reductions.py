"""Reductions of columns, at even angles or of polynomials between breakpoints, and of those of blocks of designs."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from crankwork.formula.cycle_interpolant import integrals_of_roots
from crankwork.kernel.graph import KernelValue
from crankwork.kernel.grid import Grid, Polynomials
from crankwork.kernel.python_source import Source
from crankwork.kernel.schedule import Level

Array = NDArray[np.float64]

# values closer than this are equal; the first of equal extremes counts
PLATEAU = 1e-13
_STEPS = 8
_EQUAL = 8 * float(np.finfo(float).eps)
# tolerance of the mean of a root, relative to the size of its column
_ROUNDING = 1e-12


class Peaks(NamedTuple):
    """The largest values of columns, their crank angles [rad], panels, and local coordinates from -1 to 1.

    Shape (columns, lanes); each evenly spaced angle is a panel.
    """

    value: Array
    angle: Array
    panel: NDArray[np.intp]
    u: Array

    def part(self, part: int) -> Peaks:
        """Return the peaks of one part, from those of several, shape (columns, parts, lanes)."""
        return Peaks(self.value[:, part], self.angle[:, part], self.panel[:, part], self.u[:, part])

    def of(self, column: int) -> Peaks:
        """Return the peaks of one column, in the same shape."""
        return Peaks(self.value[[column]], self.angle[[column]], self.panel[[column]], self.u[[column]])


class SampledReductions:
    """Reductions over evenly spaced crank angles, of columns of shape (columns, angles, lanes)."""

    def __init__(self, grid: Grid) -> None:
        self._grid = grid

    @property
    def count(self) -> int:
        """Number of angles."""
        return int(self._grid.degrees.size)

    def truncation_error(self, columns: Array) -> Array:
        """Return 0, since nothing between the angles counts, shape (columns, lanes)."""
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
        """Return the largest values of columns at the angles, the first of equal ones."""
        return self.largest_in(columns, (0,)).part(0)

    def largest_in(self, columns: Array, starts: Sequence[int]) -> Peaks:
        """Return the largest values of columns at the angles of each part, given by its first angle."""
        parts = np.split(columns, starts[1:], axis=1)
        indices = [part.argmax(axis=1) + start for part, start in zip(parts, starts, strict=True)]
        place = np.stack(indices, axis=1)
        value = np.take_along_axis(columns, place, axis=1)
        return Peaks(value, np.radians(self._grid.degrees)[place], place, 0.0 * value)


class PolynomialReductions:
    """Reductions over the nodes of polynomials, of columns of shape (columns, angles, lanes)."""

    def __init__(self, grid: Grid, polynomials: Polynomials) -> None:
        count = polynomials.nodes.size
        self._nodes, self._to_coefficients = polynomials.nodes, polynomials.coefficients
        self._half = np.radians(np.diff(grid.edges))[:, None] / 2
        self._middle = np.radians(grid.edges[1:] + grid.edges[:-1])[:, None] / 2
        self._degrees, self._weights = grid.degrees[: grid.nodes], grid.weights
        # integral from the left end of a panel to each node, of values at the nodes
        integrals = [legendre.legint(unit, lbnd=-1) for unit in np.eye(count)]
        self._integrals = np.array(integrals).T @ self._to_coefficients
        self._to_integrals = legendre.legvander(polynomials.nodes, count) @ self._integrals
        derivative = np.pad(legendre.legder(np.eye(count)), ((0, 1), (0, 0)))
        self._slope = derivative
        self._bend = derivative @ derivative

    def moved_to(self, edges: Array, degrees: Array, weights: Array) -> PolynomialReductions:
        """Return the reductions between the edges of each design, shape (edges, lanes), (angles, lanes)."""
        moved = copy.copy(self)
        half, middle = np.radians(np.diff(edges, axis=0)) / 2, np.radians(edges[1:] + edges[:-1]) / 2
        vars(moved).update(_half=half, _middle=middle, _degrees=degrees, _weights=weights)
        return moved

    def panels(self, columns: Array) -> Array:
        """Return columns split into panels, shape (columns, panels, nodes, lanes)."""
        return columns.reshape(len(columns), self.count, self._nodes.size, columns.shape[-1])

    def truncation_error(self, columns: Array) -> Array:
        """Return the largest truncation error of columns, shape (columns, lanes)."""
        return np.asarray(self.errors_of_panels(columns).max(axis=1))

    def errors_of_panels(self, columns: Array) -> Array:
        """Return the last coefficients of columns relative to their size, shape (columns, panels, lanes)."""
        last = np.abs(np.matmul(self._to_coefficients[-2:], self.panels(columns))).sum(axis=2)
        return np.asarray(last / np.maximum(np.abs(columns).max(axis=1), np.finfo(float).tiny)[:, None])

    def integrals(self, columns: Array) -> Array:
        """Return the integrals of columns over the crank angle, shape (columns, lanes)."""
        weights = self._weights
        return np.asarray(np.matmul(weights, columns) if weights.ndim == 1 else (weights * columns).sum(axis=1))

    def of_roots(self, squares: Array) -> Array:
        """Return the integrals of the roots of columns, shape (columns, lanes)."""
        coefficients = np.moveaxis(self.series(squares), 2, 3)
        roots = integrals_of_roots(coefficients.reshape(-1, self.each), self._limits(squares, coefficients))
        return np.asarray(2 * (self._half * roots.reshape(coefficients.shape[:3])).sum(axis=1))

    @staticmethod
    def _limits(squares: Array, coefficients: Array) -> Array:
        """Return the tolerance of the mean of each root, in one row."""
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
        """Number of panels."""
        return len(self._half)

    def largest(self, columns: Array) -> Peaks:
        """Return the largest values of columns: at an angle, or on the polynomial next to it."""
        return self.largest_in(columns, (0,)).part(0)

    def largest_in(self, columns: Array, starts: Sequence[int]) -> Peaks:
        """Return the largest values of columns in each part that begins at a panel, shape (columns, parts, lanes)."""
        values = self.panels(columns)
        highest = values.max(axis=2)
        top = np.maximum.reduceat(highest, starts, axis=1)
        least = np.minimum.reduceat(values.min(axis=2), starts, axis=1)
        part_of = np.repeat(np.arange(len(starts)), np.diff([*starts, self.count]))
        size = np.maximum(np.abs(top), np.abs(least))
        rounding = _EQUAL * size
        # a polynomial differs from its mean by at most the sum of its other coefficients
        series = np.matmul(self._to_coefficients, values)
        rise = np.abs(series[:, :, 1:]).sum(axis=2)
        is_high = series[:, :, 0] + rise >= (top - rounding)[:, part_of]
        # if it is level but for rounding, its first node is as good as any
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
        # at the end of a panel the column itself counts, and at peaks within rounding
        key = column, part_of[panel], lane
        is_node = at_node >= at_peak - rounding[key]
        value, u = np.where(is_node, at_node, at_peak), np.where(is_node, self._nodes[node], u)
        best = np.full(top.shape, -np.inf)
        np.maximum.at(best, key, value)
        angle = self._of(self._middle, panel, lane) + self._of(self._half, panel, lane) * u
        with np.errstate(invalid="ignore"):
            is_best = value >= (best - PLATEAU * (np.abs(best) + best - least))[key]
        first = np.full(top.shape, np.inf)
        np.minimum.at(first, tuple(indices[is_best] for indices in key), angle[is_best])
        is_first = is_best & (angle == first[key])
        place = tuple(indices[is_first] for indices in key)
        panels, coordinates = np.zeros(top.shape, dtype=np.intp), np.zeros(top.shape)
        panels[place], coordinates[place] = panel[is_first], u[is_first]
        value, angle = (np.where(np.isfinite(top), array, np.nan) for array in (best, first))
        return Peaks(value, angle, panels, coordinates)

    def _peaks(self, coefficients: Array, node: NDArray[np.intp]) -> Array:
        """Return the peaks of polynomials between the neighbours of a node, by Newton's method within these bounds."""
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

    # the rest is for the first lane alone

    @property
    def each(self) -> int:
        """Number of nodes of a panel."""
        return int(self._nodes.size)

    @property
    def nodes(self) -> tuple[Array, Array]:
        """Crank angles of nodes [deg], and weights of an integral over the crank angle [rad]."""
        degrees, weights = (array if array.ndim == 1 else array[:, 0] for array in (self._degrees, self._weights))
        return degrees, weights

    def of_panel(self, panel: int) -> slice:
        """Return the slice of the nodes of a panel."""
        return slice(panel * self.each, (panel + 1) * self.each)

    def up_to(self, panel: int, u: float) -> Array:
        """Return the weights of nodes of the integral from the start of the cycle to a point of a panel. [rad]"""
        weights, nodes = self.nodes[1].copy(), self.of_panel(panel)
        weights[nodes] = self._half[panel, 0] * (_legendre(u, self.each + 1) @ self._integrals)
        weights[nodes.stop :] = 0.0
        return weights

    def at_roots(self, squares: Array) -> Array:
        """Return the weights of nodes of the linearised integral of the root of a column, (1, angles, 1). [rad]"""
        coefficients = np.moveaxis(self.series(squares), 2, 3)
        slopes = np.zeros((coefficients.shape[1], self.each))
        integrals_of_roots(coefficients.reshape(-1, self.each), self._limits(squares, coefficients), slopes)
        return (2 * self._half[:, :1] * (slopes @ self._to_coefficients)).ravel()

    def around(self, panel: int, u: float) -> tuple[Array, Array, Array]:
        """Return the weights of the nodes of a panel for a value in it and its two derivatives. [1, 1/rad, 1/rad2]"""
        basis, half = _legendre(u, self.each), self._half[panel, 0]
        first, second = (basis @ matrix @ self._to_coefficients for matrix in (self._slope, self._bend))
        return basis @ self._to_coefficients, first / half, second / half**2


def _legendre(u: float, count: int) -> Array:
    """Return the first Legendre polynomials at a point."""
    values = [1.0, u]
    for n in range(1, count - 1):
        values.append(((2 * n + 1) * u * values[n] - n * values[n - 1]) / (n + 1))
    return np.array(values)


class Extreme(NamedTuple):
    """Position of the largest values; `columns`: the smooth columns, shape (1, angles, lanes)."""

    columns: Array
    peaks: Peaks

    @property
    def place(self) -> tuple[int, float]:
        """Panel and local coordinate of the first lane."""
        return int(self.peaks.panel[0, 0]), float(self.peaks.u[0, 0])


class LevelReductions:
    """The reductions of the levels of a schedule.

    The detail of a reduction is its kind, and the part of the cycle if it is not the whole cycle: `max 3`.
    """

    def __init__(self, source: Source, reductions: SampledReductions | PolynomialReductions, parts: int) -> None:
        self._source, self._reductions = source, reductions
        self._starts = np.linspace(0, reductions.count, parts + 1)[:-1].round().astype(int).tolist()

    def __call__(
        self,
        level: Level,
        store: Array,
        columns: Array,
        reductions: SampledReductions | PolynomialReductions | None,
        count: int,
    ) -> Block | None:
        """Store the reductions of columns; return their block, or None if there are none.

        `reductions`: for other edges than the stated ones; `count`: number of lanes that are requested designs.
        """
        values = [value for value in level.reductions if value.detail != "column"]
        if not values:
            return None
        block = Block(self._source, reductions or self._reductions, self._starts, values, columns, count)
        for value in values:
            store[self._source.rows(self._source.place(value))] = block.value(value)
        return block


class Block:
    """Columns of some designs, and their reductions; `truncation_error`: of the columns, by lanes."""

    def __init__(
        self,
        source: Source,
        reductions: SampledReductions | PolynomialReductions,
        starts: Sequence[int],
        values: Sequence[KernelValue],
        stored: Array,
        count: int,
    ) -> None:
        self._source, self.reductions, self._starts, self._count = source, reductions, starts, count
        self._stored = stored[:, : source.plan.grid.nodes]
        reduced = {column.index: column for value in values for column in _polynomial_columns(value)}
        self._row_of = {index: row for row, index in enumerate(reduced)}
        self._columns = self._stored[[source.columns(index) for index in reduced]]
        # a root has a corner where it is 0, and its square is smooth
        self._is_root = is_root = np.array([column.kind == "sqrt" for column in reduced.values()])
        self._smooth = np.where(is_root[:, None, None], self._columns**2, self._columns)
        self._truncation_error = reductions.truncation_error(self._smooth)
        self.truncation_error: Array = self._truncation_error.max(axis=0, initial=0.0)
        self.cycle = np.radians(source.plan.grid.cycle)
        self._integral = reductions.integrals(self._columns)
        if is_root.any() and any(value.detail == "mean" for value in values):
            self._integral[is_root] = reductions.of_roots(self._smooth[is_root])
        self._peaks: dict[tuple[float, bool], Peaks] = {}
        self._ranges: dict[KernelValue, tuple[Extreme, Extreme]] = {}
        self._procedures: dict[tuple[str, tuple[KernelValue, ...]], Array] = {}

    def value(self, reduction: KernelValue) -> Array:
        """Return the value of a reduction, shape (lanes,)."""
        match reduction.detail.split()[0]:
            case "procedure":
                return np.asarray(self._by_procedure(reduction)[int(reduction.detail.split()[2])])
            case "mean" | "integral":
                row = self._row_of[reduction.operands[0].index]
                if reduction.detail == "integral":
                    return np.asarray(self._integral[row])
                mean = self._integral[row] / self.cycle
                # a mean below rounding is 0
                return np.where(np.abs(mean) <= PLATEAU * np.abs(self._columns[row]).max(axis=0), 0.0, mean)
            case "range" | "tangents":
                up, down = self.range(reduction)
                return np.asarray(up.peaks.value[0] + down.peaks.value[0])
            case "least":
                return np.asarray(self.column(reduction.operands[0])[0].min(axis=0))
        extreme, is_angle = self.extreme(reduction)
        if is_angle:
            return np.asarray(extreme.peaks.angle[0])
        value: Array = (1.0 if reduction.detail.startswith("max") else -1.0) * extreme.peaks.value[0]
        return np.asarray(np.sqrt(np.maximum(value, 0.0)) if self.is_root(reduction.operands[0]) else value)

    @property
    def polynomials(self) -> PolynomialReductions:
        """The reductions of polynomials."""
        if not isinstance(self.reductions, PolynomialReductions):
            raise TypeError("evenly spaced angles are not followed")
        return self.reductions

    def coarse_panels(self, enough: float) -> NDArray[np.bool_]:
        """Return which panels have a larger truncation error in a design, shape (panels,)."""
        return np.asarray((self.polynomials.errors_of_panels(self._smooth) > enough).any(axis=(0, 2)))

    def truncation_error_of(self, reduction: KernelValue) -> Array:
        """Return the truncation error of the columns of a reduction, shape (lanes,)."""
        rows = [self._row_of[column.index] for column in _polynomial_columns(reduction)]
        return np.asarray(self._truncation_error[rows].max(axis=0))

    def is_root(self, column: KernelValue) -> bool:
        """Return whether the square of a column is reduced."""
        return bool(self._is_root[self._row_of[column.index]])

    def range(self, reduction: KernelValue) -> tuple[Extreme, Extreme]:
        """Return the extremes of the work of a column, or of the axis intercepts of tangents of a mass-energy curve."""
        if reduction not in self._ranges:
            column = self.column(reduction.operands[0])
            mean = self.reductions.integrals(column)[:, None] / self.cycle
            above = below = self.reductions.running(column - mean)
            if reduction.detail == "tangents":
                # the work of a load is negative
                inertia, *slopes = map(self.column, reduction.operands[1:])
                above, below = (-above - slope * inertia for slope in slopes)
            high, low = self.reductions.largest(above), self.reductions.largest(-below)
            self._ranges[reduction] = Extreme(above, high), Extreme(-below, low)
        return self._ranges[reduction]

    def _by_procedure(self, reduction: KernelValue) -> Array:
        """Return the values of a function of columns, shape (values, lanes)."""
        _, function, _ = reduction.detail.split()
        key = function, reduction.operands
        if key not in self._procedures:
            rows = [self._source.columns(column.index) for column in reduction.operands]
            series, call = self.polynomials.series(self._stored[rows]), reduction.graph.functions[int(function)]
            lanes = np.minimum(np.arange(series.shape[-1]), self._count - 1)
            edges = np.broadcast_to(self.polynomials.edges, (series.shape[1] + 1, lanes.size))
            values = np.array([call(edges[:, lane], series[..., lane]) for lane in range(self._count)])
            self._procedures[key] = values[lanes].T
        return self._procedures[key]

    def column(self, value: KernelValue) -> Array:
        """Return a column, shape (1, angles, lanes)."""
        return self._stored[[self._source.columns(value.index)]]

    def extreme(self, reduction: KernelValue) -> tuple[Extreme, bool]:
        """Return the extreme of a column, or of its square, and whether the reduction is its angle."""
        word, *part = reduction.detail.split()
        kind, _, angle = word.partition("_")
        sign, row = 1.0 if kind == "max" else -1.0, self._row_of[reduction.operands[0].index]
        if (sign, bool(part)) not in self._peaks:
            starts = self._starts if part else (0,)
            self._peaks[sign, bool(part)] = self.reductions.largest_in(sign * self._smooth, starts)
        peaks = self._peaks[sign, bool(part)].part(int(part[0]) if part else 0)
        return Extreme(self._smooth[[row]], peaks.of(row)), bool(angle)


def _polynomial_columns(reduction: KernelValue) -> tuple[KernelValue, ...]:
    """Return the columns of a reduction that polynomials must approximate."""
    if reduction.detail.startswith("procedure"):
        return reduction.operands
    if reduction.detail == "least":
        return ()
    return reduction.operands[:2] if reduction.detail == "tangents" else reduction.operands[:1]
