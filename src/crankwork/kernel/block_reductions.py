"""Reductions of the columns of a block of designs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.graph import KernelValue
from crankwork.kernel.python_source import Source
from crankwork.kernel.reductions import PLATEAU, Peaks, PolynomialReductions, SampledReductions
from crankwork.kernel.schedule import Level

Array = NDArray[np.float64]


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
        self.truncation_error: Array = self._truncation_error.max(axis=0)
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
            above = below = self._work(self.column(reduction.operands[0]))
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

    def _work(self, column: Array) -> Array:
        """Return the integral of a column about its mean, over the angles."""
        return self.reductions.running(column - self.reductions.integrals(column)[:, None] / self.cycle)

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
    return reduction.operands[:2] if reduction.detail == "tangents" else reduction.operands[:1]
