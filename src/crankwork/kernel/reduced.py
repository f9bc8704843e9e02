"""What columns of a block of designs come to: reductions, and what each of them takes of its columns."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.graph import Value
from crankwork.kernel.plan import Level
from crankwork.kernel.reductions import PLATEAU, Even, Exact, Peaks
from crankwork.kernel.source import Source

Array = NDArray[np.float64]


class Extreme(NamedTuple):
    """Where columns are the largest; `columns` are these, smooth ones, shape (1, angles, lanes)."""

    columns: Array
    peaks: Peaks

    @property
    def place(self) -> tuple[int, float]:
        """Panel and place of the first lane."""
        return int(self.peaks.panel[0, 0]), float(self.peaks.u[0, 0])


class Reduced:
    """The reductions of the levels of a plan.

    The word of a reduction is what it is, and in which of `parts` of the cycle if it is not the whole: `max 3`.
    """

    def __init__(self, source: Source, reductions: Even | Exact, parts: int) -> None:
        self._source, self._reductions = source, reductions
        self._starts = np.linspace(0, reductions.count, parts + 1)[:-1].round().astype(int).tolist()

    def __call__(
        self, level: Level, store: Array, kept: Array, reductions: Even | Exact | None, count: int
    ) -> Block | None:
        """Put reductions of columns into the store, and return what was found of these; None where there are none.

        `reductions`: those of other edges than the stated ones; `count`: how many lanes are designs that are asked for.
        """
        every = [one for one in level.reductions if one.detail != "column"]
        if not every:
            return None
        block = Block(self._source, reductions or self._reductions, self._starts, every, kept, count)
        for one in every:
            store[self._source.rows(self._source.place(one))] = block.value(one)
        return block


class Block:
    """The columns of some designs, and what was found of them; `left_out`: what polynomials leave out, by lanes."""

    def __init__(
        self,
        source: Source,
        reductions: Even | Exact,
        starts: Sequence[int],
        every: Sequence[Value],
        kept: Array,
        count: int,
    ) -> None:
        self._source, self.reductions, self._starts, self._count = source, reductions, starts, count
        self._kept = kept[:, : source.plan.grid.nodes]
        reduced = {one.at: one for reduction in every for one in _looked_at(reduction)}
        self._row_of = {at: row for row, at in enumerate(reduced)}
        self._columns = self._kept[[source.columns(at) for at in reduced]]
        # a root has a corner where it vanishes, and its square has none
        self._is_root = is_root = np.array([one.kind == "sqrt" for one in reduced.values()])
        self._smooth = np.where(is_root[:, None, None], self._columns**2, self._columns)
        self._left_out = reductions.left_out(self._smooth)
        self.left_out: Array = self._left_out.max(axis=0)
        self.cycle = np.radians(source.plan.grid.cycle)
        self._integral = reductions.integrals(self._columns)
        if is_root.any() and any(one.detail == "mean" for one in every):
            self._integral[is_root] = reductions.of_roots(self._smooth[is_root])
        self._peaks: dict[tuple[float, bool], Peaks] = {}
        self._ranges: dict[Value, tuple[Extreme, Extreme]] = {}
        self._procedures: dict[tuple[str, tuple[Value, ...]], Array] = {}

    def value(self, one: Value) -> Array:
        """Return what a reduction comes to, shape (lanes,)."""
        match one.detail.split()[0]:
            case "procedure":
                return np.asarray(self._by_procedure(one)[int(one.detail.split()[2])])
            case "mean" | "integral":
                row = self._row_of[one.operands[0].at]
                if one.detail == "integral":
                    return np.asarray(self._integral[row])
                mean = self._integral[row] / self.cycle
                # what rounding leaves of nothing is nothing
                return np.where(np.abs(mean) <= PLATEAU * np.abs(self._columns[row]).max(axis=0), 0.0, mean)
            case "range" | "tangents":
                up, down = self.range(one)
                return np.asarray(up.peaks.value[0] + down.peaks.value[0])
        found, is_angle = self.extreme(one)
        if is_angle:
            return np.asarray(found.peaks.angle[0])
        value: Array = (1.0 if one.detail.startswith("max") else -1.0) * found.peaks.value[0]
        return np.asarray(np.sqrt(np.maximum(value, 0.0)) if self.is_root(one.operands[0]) else value)

    @property
    def followed(self) -> Exact:
        """The reductions, which are those of polynomials."""
        if not isinstance(self.reductions, Exact):
            raise TypeError("evenly spaced angles are not followed")
        return self.reductions

    def left_out_of(self, one: Value) -> Array:
        """Return what polynomials leave out of the columns of a reduction, shape (lanes,)."""
        return np.asarray(self._left_out[[self._row_of[of.at] for of in _looked_at(one)]].max(axis=0))

    def is_root(self, column: Value) -> bool:
        """Return whether of a column the square is looked at."""
        return bool(self._is_root[self._row_of[column.at]])

    def range(self, one: Value) -> tuple[Extreme, Extreme]:
        """Return where the work of a column, or what tangents of the mass-energy curve cut off, is most and least."""
        if one not in self._ranges:
            above = below = self._work(self.column(one.operands[0]))
            if one.detail == "tangents":
                # the work of a load is negative
                inertia, *slopes = map(self.column, one.operands[1:])
                above, below = (-above - slope * inertia for slope in slopes)
            self._ranges[one] = (
                Extreme(above, self.reductions.largest(above)),
                Extreme(-below, self.reductions.largest(-below)),
            )
        return self._ranges[one]

    def _by_procedure(self, one: Value) -> Array:
        """Return what a function finds of columns, shape (values, lanes)."""
        _, function, _ = one.detail.split()
        key = function, one.operands
        if key not in self._procedures:
            series = self.followed.series(self._kept[[self._source.columns(column.at) for column in one.operands]])
            call, lanes = one.graph.functions[int(function)], np.minimum(np.arange(series.shape[-1]), self._count - 1)
            edges = np.broadcast_to(self.followed.edges, (series.shape[1] + 1, lanes.size))
            found = np.array([call(edges[:, lane], series[..., lane]) for lane in range(self._count)])
            self._procedures[key] = found[lanes].T
        return self._procedures[key]

    def column(self, value: Value) -> Array:
        """Return a column, shape (1, angles, lanes)."""
        return self._kept[[self._source.columns(value.at)]]

    def _work(self, column: Array) -> Array:
        """Return the integral of a column about its mean, over the angles."""
        return self.reductions.running(column - self.reductions.integrals(column)[:, None] / self.cycle)

    def extreme(self, one: Value) -> tuple[Extreme, bool]:
        """Return where a column, or its square, is the largest or the least, and whether the angle is wanted."""
        word, *part = one.detail.split()
        kind, _, angle = word.partition("_")
        sign, row = 1.0 if kind == "max" else -1.0, self._row_of[one.operands[0].at]
        if (sign, bool(part)) not in self._peaks:
            starts = self._starts if part else (0,)
            self._peaks[sign, bool(part)] = self.reductions.largest_in(sign * self._smooth, starts)
        peaks = self._peaks[sign, bool(part)].part(int(part[0]) if part else 0)
        return Extreme(self._smooth[[row]], peaks.of(row)), bool(angle)


def _looked_at(one: Value) -> tuple[Value, ...]:
    """Return the columns of a reduction that polynomials must follow."""
    if one.detail.startswith("procedure"):
        return one.operands
    return one.operands[:2] if one.detail == "tangents" else one.operands[:1]
