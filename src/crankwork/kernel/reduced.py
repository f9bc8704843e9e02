"""What columns of a block of designs come to: reductions, and how those change with what designs state."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from crankwork.kernel.graph import Value
from crankwork.kernel.plan import Level
from crankwork.kernel.reductions import Even, Exact, Peaks
from crankwork.kernel.source import Source

Array = NDArray[np.float64]


class Reduced:
    """The reductions of the levels of a plan.

    The word of a reduction is what it is, in which of `parts` of the cycle if it is not the whole, and `slope` for how
    it changes: `max 3 slope`, of a column and its derivative.
    """

    def __init__(self, source: Source, reductions: Even | Exact, parts: int) -> None:
        self._source, self._reductions = source, reductions
        self._starts = np.linspace(0, reductions.count, parts + 1)[:-1].round().astype(int).tolist()

    def __call__(
        self, level: Level, store: Array, kept: Array, reductions: Even | Exact | None, count: int
    ) -> Array | float:
        """Put reductions of columns into the store; return what polynomials leave out of them, shape (lanes,).

        `reductions`: those of other edges than the stated ones; `count`: how many lanes are designs that are asked for.
        """
        every = [one for one in level.reductions if one.detail != "column"]
        if not every:
            return 0.0
        block = _Block(self._source, reductions or self._reductions, self._starts, every, kept, count)
        for one in every:
            store[self._source.rows(self._source.place(one))] = block.value(one)
        return np.asarray(block.left_out.max(axis=0))


class _Block:
    """The columns of some designs, and what was found of them."""

    def __init__(
        self,
        source: Source,
        reductions: Even | Exact,
        starts: Sequence[int],
        every: Sequence[Value],
        kept: Array,
        count: int,
    ) -> None:
        self._source, self._exact, self._starts, self._count = source, reductions, starts, count
        self._kept = kept[:, : source.plan.grid.nodes]
        reduced = {one.at: one for reduction in every for one in _looked_at(reduction)}
        self._row_of = {at: row for row, at in enumerate(reduced)}
        self._columns = self._kept[[source.columns(at) for at in reduced]]
        # a root has a corner where it vanishes, and its square has none
        self._is_root = is_root = np.array([one.kind == "sqrt" for one in reduced.values()])
        self._smooth = np.where(is_root[:, None, None], self._columns**2, self._columns)
        self.left_out = reductions.left_out(self._smooth)
        self._cycle = np.radians(source.plan.grid.cycle)
        self._integral = reductions.integrals(self._columns)
        if is_root.any() and any(one.detail == "mean" for one in every):
            self._integral[is_root] = reductions.of_roots(self._smooth[is_root])
        self._peaks: dict[tuple[float, bool], Peaks] = {}
        self._ranges: dict[int, tuple[Peaks, Peaks]] = {}
        self._procedures: dict[tuple[str, tuple[Value, ...]], Array] = {}

    def value(self, one: Value) -> Array:
        """Return what a reduction comes to, shape (lanes,)."""
        word, *more = one.detail.split()
        part = more[0] if more and more[0] != "slope" else ""
        row = self._row_of[one.operands[0].at]
        if word == "procedure":
            return np.asarray(self._by_procedure(one)[int(more[1])])
        if word == "tangents":
            return self._tangents(one, is_slope=bool(more))
        change = self._column(one.operands[1]) if len(one.operands) > 1 else None
        match word:
            case "mean" | "integral":
                integral = self._integral[row] if change is None else self._exact.integrals(change)[0]
                return np.asarray(integral / (self._cycle if word == "mean" else 1.0))
            case "range":
                return self._range(row, change)
        return self._extreme(row, word, part, change)

    def _range(self, row: int, change: Array | None) -> Array:
        if row not in self._ranges:
            work = self._work(self._columns[row : row + 1])
            self._ranges[row] = self._exact.largest(work), self._exact.largest(-work)
        up, down = self._ranges[row]
        if change is None:
            return np.asarray(up.value[0] + down.value[0])
        work = self._work(change)
        return np.asarray(self._exact.at(work, up)[0] - self._exact.at(work, down)[0])

    def _by_procedure(self, one: Value) -> Array:
        """Return what a function finds of columns, shape (values, lanes)."""
        _, function, _ = one.detail.split()
        key = function, one.operands
        if not isinstance(self._exact, Exact):
            raise TypeError("procedures take polynomials")
        if key not in self._procedures:
            series = self._exact.series(self._kept[[self._source.columns(column.at) for column in one.operands]])
            call, lanes = one.graph.functions[int(function)], np.minimum(np.arange(series.shape[-1]), self._count - 1)
            edges = np.broadcast_to(self._exact.edges, (series.shape[1] + 1, lanes.size))
            found = np.array([call(edges[:, lane], series[..., lane]) for lane in range(self._count)])
            self._procedures[key] = found[lanes].T
        return self._procedures[key]

    def _column(self, value: Value) -> Array:
        return self._kept[[self._source.columns(value.at)]]

    def _tangents(self, one: Value, *, is_slope: bool) -> Array:
        """Return what tangents of the mass-energy curve cut off its axis; the work of a load is negative."""
        torque, inertia, *slopes = map(self._column, one.operands[:4])
        work = -self._work(torque)
        above, below = (work - slope * inertia for slope in slopes)
        up, down = self._exact.largest(above), self._exact.largest(-below)
        if not is_slope:
            return np.asarray(up.value[0] + down.value[0])
        torque, inertia_1, *slopes_1 = map(self._column, one.operands[4:])
        changes = [
            -self._work(torque) - slope * inertia_1 - slope_1 * inertia
            for slope, slope_1 in zip(slopes, slopes_1, strict=True)
        ]
        return np.asarray(self._exact.at(changes[0], up)[0] - self._exact.at(changes[1], down)[0])

    def _work(self, column: Array) -> Array:
        """Return the integral of a column about its mean, over the angles."""
        return self._exact.running(column - self._exact.integrals(column)[:, None] / self._cycle)

    def _extreme(self, row: int, word: str, part: str, change: Array | None) -> Array:
        kind, _, angle = word.partition("_")
        sign = 1.0 if kind == "max" else -1.0
        if (sign, bool(part)) not in self._peaks:
            starts = self._starts if part else (0,)
            self._peaks[sign, bool(part)] = self._exact.largest_in(sign * self._smooth, starts)
        peaks = self._peaks[sign, bool(part)].part(int(part or 0)).of(row)
        if change is None:
            value = sign * peaks.value[0]
            value = np.sqrt(np.maximum(value, 0.0)) if self._is_root[row] else value
            return np.asarray(peaks.angle[0] if angle else value)
        found = self._exact.moved(self._smooth[[row]], change, peaks) if angle else self._exact.at(change, peaks)
        return np.asarray(found[0])


def _looked_at(one: Value) -> tuple[Value, ...]:
    """Return the columns of a reduction that polynomials must follow."""
    if one.detail.startswith("procedure"):
        return one.operands
    return one.operands[:2] if one.detail.startswith("tangents") else one.operands[:1]
