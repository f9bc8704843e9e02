"""Columns over a whole cycle without sampling: their means, integrals and extremes.

Between the angles where a law changes a column is smooth; there it is followed by polynomials, on intervals cut
until the polynomials have converged. Integrals are those of the polynomials; where an extreme stands is found on them,
what it amounts to is replayed. The square root of something has a corner where that vanishes: it is followed by its
square, which has none.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from crankwork.formula.replay import Angles, Program
from crankwork.formula.traced_value import (
    Array,
    Delayed,
    FormulaCall,
    ProcedureValue,
    TracedValue,
    breakpoints_of,
    unique_sorted,
)
from crankwork.quantities.key import key_of

_NODES, _WEIGHTS = legendre.leggauss(16)
_DEGREES = np.arange(_NODES.size)
_AT_NODES = legendre.legvander(_NODES, _NODES.size - 1)
_FROM_VALUES = (_AT_NODES * _WEIGHTS[:, None]).T * ((2 * _DEGREES + 1) / 2)[:, None]
# closer towards the ends, as the zeros of polynomials are
_NODE_SPACING = math.pi / 24
_LOOK = -np.cos(np.arange(25) * _NODE_SPACING)
_AT_LOOK = legendre.legvander(_LOOK, _NODES.size - 1)
# derivatives of the Legendre polynomials: at both ends, and as sums of them
_SLOPE_AT_ENDS = np.stack([(-1.0) ** (_DEGREES + 1), np.ones(_NODES.size)]) * _DEGREES * (_DEGREES + 1) / 2
_DERIVATIVE = np.pad(legendre.legder(np.eye(_NODES.size)), ((0, 1), (0, 0)))
_PARTS = 3
_AT_ALL = np.concatenate([_AT_NODES, _AT_LOOK])
# coefficients of a polynomial on each of as many equal parts of its interval, from those on the whole
_ON_PARTS = [
    legendre.legvander((2 * part + 1 + _NODES) / _PARTS - 1, _NODES.size - 1).T @ _FROM_VALUES.T
    for part in range(_PARTS)
]
_WIDTH = 30.0
_CONVERGED = 1e-12
_CUTS = 9
_NO_BETTER = 0.03
_MAX_STALLS = 1
# of equal values, whatever rounding says, the first counts
_PLATEAU = 1e-13
# of the size of a column, what two places of its polynomials must differ by to be told apart
_TOLERANCE = 1e-9
_NEAR_TOP = 0.05
_ROUGH = 0.05
# of the largest column of its quantity: a column below is followed as far as rounding lets it
_SMALL = 1e-3
# a column that differs by this part of its size from here to as good as here is nothing but rounding [deg]
_ERRATIC, _HERE = 1e-3, 1e-10
# what a root may miss between the nodes, where squares of rounding are what vanishes
_LITTLE = 0.1
# what evaluating a polynomial may miss by, of the sum of its coefficients
_EVALUATED = 16 * float(np.finfo(float).eps)
_STEPS = 60
# Newton's next step would be the square of this
_SETTLED = 1e-9
_JUMP = 1e-10
# how far beyond a jump the law after it is met, also at the angle of another cylinder, where rounding is undone [deg]
BEYOND = 2e-11
# how far before an edge the law before it is met where the angles of two parts agree but for the digits of a file [deg]
_AHEAD = 1e-9
_AT_EDGE = 0.05
# of the end of a cycle, which is its start [deg]
_SAME_PLACE = 1e-7
_ZERO = 1e-14


class Extreme(NamedTuple):
    """A largest or least value and the first crank angle where it stands. [deg]"""

    value: float
    at: float


class _Places(NamedTuple):
    """Rows and crank angles where the largest of columns may stand, and what is equal to it, of each column. [deg]"""

    rows: NDArray[np.intp]
    angles: Array
    equal: Array


class CycleInterpolant:
    """Columns over one cycle, by key, at angles in degrees.

    `size_of` names the column whose size says what counts in another: that of an error is the column it is an error of.
    `program` replays these columns among others.
    `error` is the largest coefficient left out, relative to the largest value of its column: what integrals and the
    places of extremes may be wrong by.
    """

    def __init__(
        self,
        columns: Mapping[str, TracedValue],
        angles_at: Callable[[Any], Angles],
        cycle: float,
        start: float = 0.0,
        *,
        size_of: Mapping[str, str] = MappingProxyType({}),
        program: Program | None = None,
    ) -> None:
        self.columns = dict(columns)
        # columns that are others at another crank angle have what these have
        self._later = dict(_later(columns, cycle)) if program is None and not start else {}
        columns = {key: column for key, column in columns.items() if key not in self._later}
        self._program, self._angles_at = program or Program(columns), angles_at
        self._row = {key: row for row, key in enumerate(columns)}
        self._is_root = np.array([_is_root(column) for column in columns.values()], dtype=bool)
        self.breaks = breakpoints_of(columns.values(), cycle, start)
        parts = np.maximum(1, np.ceil(np.diff(self.breaks) / _WIDTH - 1e-9)).astype(int)
        within = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
        start_of, width = np.repeat(self.breaks[:-1], parts), np.repeat(np.diff(self.breaks) / parts, parts)
        low = start_of + within * width
        high = np.append(low[1:], self.breaks[-1])
        coefficients = self._fit(low, high)
        size = np.max(np.abs(coefficients).sum(axis=2), axis=1)
        own = size
        size = size[[self._row[size_of.get(key, key)] for key in self._row]]
        self._scale = np.maximum(np.maximum(size, self._of_rounding(size)), 1e-300)
        self._is_erratic = np.zeros(len(self._row), dtype=bool)
        rounding = np.zeros(coefficients.shape[:2], dtype=bool)
        done = []
        for cut in range(_CUTS):
            left = np.where(rounding, 0.0, self._left_out(coefficients))
            is_coarse = np.max(left, axis=0, initial=0.0) > _CONVERGED
            done.append((low[~is_coarse], high[~is_coarse], coefficients[:, ~is_coarse]))
            low, high, coefficients = low[is_coarse], high[is_coarse], coefficients[:, is_coarse]
            if not low.size:
                break
            if cut == _MAX_STALLS:
                self._is_erratic = self._differs_here(low, high, own)
            between = np.linspace(low, high, _PARTS + 1)
            low, high = between[:-1].ravel(), between[1:].ravel()
            coefficients = self._fit(low, high)
            # what is no nearer in any part is rounding, and no polynomial follows it
            better = self._left_out(coefficients).reshape(-1, _PARTS, low.size // _PARTS).min(axis=1)
            hopeless = rounding[:, is_coarse] | ((better > _NO_BETTER * left[:, is_coarse]) & (cut >= _MAX_STALLS))
            rounding = np.concatenate([hopeless | self._is_erratic[:, None]] * _PARTS, axis=1)
        done.append((low, high, coefficients))
        self._low, self._high = (np.concatenate([batch[field] for batch in done]) for field in (0, 1))
        order = np.argsort(self._low)
        self._low, self._high = self._low[order], self._high[order]
        self._coefficients = np.empty((len(self._row), order.size, _NODES.size))
        place, start = np.argsort(order), 0
        for low_ends, _, part in done:
            self._coefficients[:, place[start : start + low_ends.size]] = part
            start += low_ends.size
        # what is left out, and what a column may rise by from its mean, in each interval
        self._left = self._left_out(self._coefficients)
        self._rise = np.abs(self._coefficients) @ np.minimum(_DEGREES, 1.0)
        self.error = float(np.max(self._left, initial=0.0))

    def _fit(self, low: Array, high: Array) -> Array:
        """Return Legendre coefficients, shape (columns, intervals, degrees)."""
        values = self._at_nodes(low, high).reshape(-1, _NODES.size)
        return np.asarray((values @ _FROM_VALUES.T).reshape(len(self._row), low.size, _NODES.size))

    def _at_nodes(self, low: Array, high: Array, offset: float = 0.0) -> Array:
        """Return interpolated values of columns at the nodes of intervals, or at an offset [deg]: a row for each."""
        degrees = (low + high)[:, None] / 2 + (high - low)[:, None] / 2 * _NODES
        values = self._program.rows(self._angles_at(degrees.ravel() + offset), self._row)
        values[self._is_root] **= 2
        return values

    def _differs_here(self, low: Array, high: Array, size: Array) -> NDArray[np.bool_]:
        """Return which columns change noticeably under a negligible change of the crank angle."""
        values = self._at_nodes(low, high)
        differences = np.max(np.abs(self._at_nodes(low, high, _HERE) - values), axis=1)
        return np.asarray(differences > _ERRATIC * np.maximum(size, np.max(np.abs(values), axis=1)))

    def _of_rounding(self, size: Array) -> Array:
        """Return for each column the magnitude above rounding relative to the largest of its quantity."""
        kinds = [key_of(key).quantity for key in self._row]
        pairs = list(zip(kinds, size, strict=True))
        largest = {kind: max(value for other, value in pairs if other == kind) for kind in kinds}
        of_kind = np.array([largest[kind] for kind in kinds])
        return _SMALL * np.where(self._is_root, np.sqrt(size * of_kind), of_kind)

    def _left_out(self, coefficients: Array) -> Array:
        return np.asarray((np.abs(coefficients[:, :, -2]) + np.abs(coefficients[:, :, -1])) / self._scale[:, None])

    def integral(self, key: str) -> float:
        """Return the integral of a column over the crank angle. [its unit, rad]"""
        row = self._row_of(key)
        if self._is_root[row]:
            return float(self._integrals_of_roots[row])
        return float(np.radians(self._high - self._low) @ self._coefficients[row, :, 0])

    @cached_property
    def _integrals_of_roots(self) -> Array:
        """The integral of the root of the polynomials of each column."""
        widths = np.radians(self._high - self._low)
        row, interval = np.nonzero(self._is_root[:, None] & np.ones(widths.size, dtype=bool))
        limits = _CONVERGED * np.sqrt(self._scale)[row]
        integrals = integrals_of_roots(self._coefficients[row, interval], limits) * widths[interval]
        return np.asarray(np.bincount(row, integrals, minlength=len(self._row)), dtype=float)

    def mean(self, key: str, name: str) -> TracedValue:
        """Return the mean of a column under a name; what rounding leaves of nothing is nothing."""
        mean = self.integral(key) / float(np.radians(self._high[-1] - self._low[0]))
        if abs(mean) <= _PLATEAU * self._plain(self._scale)[self._row_of(key)]:
            mean = 0.0
        return TracedValue(ProcedureValue(mean, "mean", (self.columns[key],)), name)

    def polynomials(self, key: str) -> Array:
        """Return the Legendre coefficients of a column between `edges`, shape (intervals, degrees).

        Those of a column that is another one at another crank angle are counted from that angle.
        """
        row = self._row_of(key)
        if self._is_root[row]:
            raise TypeError(f"{key} is a square root, which is followed by its square")
        return np.asarray(self._coefficients[row])

    def _row_of(self, key: str) -> int:
        """Return the row of a column, of one that is later than another the row of that."""
        return self._row[self._later[key][0] if key in self._later else key]

    @property
    def edges(self) -> Array:
        """Crank angles between which every column is as good as a polynomial. [deg]"""
        return np.append(self._low, self._high[-1])

    def is_zero(self, key: str) -> bool:
        """Return whether a column is zero everywhere."""
        return not np.any(self._coefficients[self._row_of(key)])

    def at(self, key: str, degrees: Array) -> Array:
        """Return a column at crank angles. [deg]"""
        first, delay = self._later.get(key, (key, 0.0))
        return np.asarray(self._program.rows(self._angles_at(degrees - delay), (first,))[0])

    def crossings(self, key: str, level: float = 0.0) -> Array:
        """Return the crank angles where a column passes a level, ascending; where rounding does, none. [deg]"""
        row = self._row[key]
        if self._is_erratic[row]:
            return np.empty(0)
        coefficients = self.polynomials(key).copy()
        coefficients[:, 0] -= level
        samples = coefficients @ _AT_LOOK.T
        samples[np.abs(samples) <= _ZERO * max(self._scale[row], abs(level))] = 0.0
        below = samples < 0
        interval, place = np.nonzero(below[:, 1:] != below[:, :-1])
        inside = self._zeros(coefficients[interval], _LOOK[place], _LOOK[place + 1], below[interval, place])
        middle, half = (self._low + self._high) / 2, (self._high - self._low) / 2
        inside = middle[interval] + half[interval] * inside
        return unique_sorted(np.concatenate([inside, self._high[:-1][below[:-1, -1] != below[1:, 0]]]))

    def sign_intervals(self, key: str) -> tuple[list[float], list[bool]]:
        """Return where stretches of one sign end, the last at the end of the cycle, and whether each is negative."""
        start, end = float(self._low[0]), float(self._high[-1])
        inner = [place for place in self.crossings(key).tolist() if start + _SAME_PLACE < place < end - _SAME_PLACE]
        edges = np.array([start, *inner, end])
        middle = (edges[1:] + edges[:-1]) / 2
        interval = np.searchsorted(self._low, middle, side="right") - 1
        low, high = self._low[interval], self._high[interval]
        u = (2 * middle - low - high) / (high - low)
        values = legendre.legval(u, self._coefficients[self._row[key], interval].T, tensor=False)
        ends: list[float] = []
        signs: list[bool] = []
        for edge, negative in zip(edges[1:].tolist(), (values < 0).tolist(), strict=True):
            if signs and signs[-1] == negative:
                ends[-1] = edge
            else:
                ends.append(edge)
                signs.append(negative)
        return ends, signs

    def extremes(self, *keys: str) -> dict[str, TracedValue]:
        """Return the extremes of columns and their crank angles as `KEY_max`, `KEY_max_angle` and so on."""
        result = {}
        for key in keys:
            operands = (self.columns[key],)
            for word, (value, degrees) in zip(("max", "min"), self.extreme_points[key], strict=True):
                extreme, angle = (key_of(key).derived(ending) for ending in (f"_{word}", f"_{word}_angle"))
                result[extreme] = TracedValue(ProcedureValue(value, word, operands, degrees), extreme)
                result[angle] = TracedValue(
                    ProcedureValue(float(np.radians(degrees)), f"{word}_angle", operands, degrees), angle
                )
        return result

    def errors(self, *keys: str) -> dict[str, TracedValue]:
        """Return the largest of columns by size, each under its own key."""
        result = {}
        for key in keys:
            largest, least = self.extreme_points[key]
            worst = largest if largest.value >= -least.value else least
            result[key] = TracedValue(ProcedureValue(abs(worst.value), "error", (self.columns[key],), worst.at), key)
        return result

    @cached_property
    def extreme_points(self) -> dict[str, tuple[Extreme, Extreme]]:
        """The largest and the least of every column: where they stand by the polynomials, replayed there."""
        if not self._row:
            return {}
        count = len(self._row)
        (rows, angles, equal), falling, ahead = self._may_stand()
        ordered = unique_sorted(np.concatenate([angles, ahead]))
        values = self._program.rows(self._angles_at(ordered), self._row)
        both, top = np.concatenate([values, -values]), np.full(2 * count, -np.inf)
        np.maximum.at(top, rows, both[rows, np.searchsorted(ordered, angles)])
        # an edge may lie behind the jump that it stands for
        is_missed = both[falling, np.searchsorted(ordered, ahead)] > (top + equal)[falling]
        rows, angles = np.append(rows, falling[is_missed]), np.append(angles, ahead[is_missed])
        # where one may stand counts for the other too, so that no largest is below its least
        either = _Places(np.concatenate([rows, (rows + count) % (2 * count)]), np.tile(angles, 2), equal)
        first = self._first_of_equal(either, ordered, both)
        result = {
            key: (
                Extreme(float(column[high]), float(ordered[high])),
                Extreme(float(column[low]), float(ordered[low])),
            )
            for key, column, high, low in zip(self._row, values, first[:count], first[count:], strict=True)
        }
        for key, (other, delay) in self._later.items():
            row = self._row[other]
            largest, least = (self._first_later(either, ordered, both, side, delay) for side in (row, row + count))
            result[key] = result[other][0]._replace(at=largest), result[other][1]._replace(at=least)
        return result

    def _first_later(self, places: _Places, ordered: Array, values: Array, row: int, delay: float) -> float:
        """Return the first crank angle where a column is largest that is later than that of a row. [deg]"""
        start, end = float(self._low[0]), float(self._high[-1])
        angles = places.angles[places.rows == row]
        seen = values[row, np.searchsorted(ordered, angles)]
        angles = angles[seen >= np.max(seen, initial=-np.inf) - places.equal[row]]
        if not angles.size:
            angles = ordered[[np.argmax(values[row])]]
        begins = self._low[np.searchsorted(self._low, angles, side="right") - 1] == angles
        later = start + np.mod(angles + delay - start, end - start)
        later = np.where(end - later < _SAME_PLACE, start, later)
        edges = later[begins & (later - np.min(later) < _AT_EDGE)]
        return float(np.min(edges) if edges.size else np.min(later))

    def _may_stand(self) -> tuple[_Places, NDArray[np.intp], Array]:
        """Return where the largest of columns may stand, and then the largest of what is opposite to each.

        And the rows that may be largest before a jump, with crank angles just before it. [deg]
        """
        at_ends = self._coefficients @ _AT_LOOK[[0, -1]].T
        at_ends = np.concatenate([at_ends, -at_ends])
        top, least = at_ends.max(axis=(1, 2), initial=-np.inf), at_ends.min(axis=(1, 2), initial=np.inf)
        high, middle = top - self._tolerance(top - least), self._coefficients[:, :, 0]
        # what no polynomial follows is rounding, and its peaks are none
        is_smooth = self._rise > np.maximum(self._left / _ROUGH, _ZERO) * self._scale[:, None]
        is_high = (np.concatenate([middle, -middle]) + np.tile(self._rise, (2, 1)) >= high[:, None]).reshape(
            2, *middle.shape
        )
        side, row, interval = np.nonzero(is_high & is_smooth)
        inside = np.where(side[:, None], -1.0, 1.0) * self._coefficients[row, interval]
        row = row + side * len(self._row)
        samples = inside @ _AT_LOOK.T
        np.maximum.at(top, row, samples.max(axis=1))
        peak, u = self._peaks(inside, samples, samples >= (top - _NEAR_TOP * (top - least))[row, None])
        row, interval, at_peaks = row[peak], interval[peak], legendre.legval(u, inside[peak].T, tensor=False)
        np.maximum.at(top, row, at_peaks)
        high = top - self._tolerance(top - least)
        # what the column is before and after an edge; the end of the cycle is its start
        before, after = np.roll(at_ends[:, :, 1], 1, axis=1), at_ends[:, :, 0]
        at_edges = np.maximum(before, after) >= high[:, None]
        edge = np.nonzero(np.append(at_edges, at_edges[:, :1], axis=1))
        jumps = np.abs(after - before) > _JUMP * np.tile(self._scale, 2)[:, None]
        jump, fall = (np.nonzero(jumps & (side >= high[:, None])) for side in (after, before))
        row, interval, u = (peak_values[at_peaks >= high[row]] for peak_values in (row, interval, u))
        peaks = (self._low[interval] + self._high[interval]) / 2 + (self._high - self._low)[interval] / 2 * u
        beyond = self._low[jump[1]] + BEYOND
        top, least = self._plain(top), self._plain(least)
        equal = _PLATEAU * (top - least + np.maximum(np.abs(top), np.abs(least)))
        places = _Places(
            np.concatenate([edge[0], jump[0], row]), np.concatenate([self.edges[edge[1]], beyond, peaks]), equal
        )
        return places, fall[0], np.roll(self._high, 1)[fall[1]] - _AHEAD

    def _plain(self, values: Array) -> Array:
        """Return values of columns, or of columns and what is opposite to them, for values of what follows them."""
        is_root = np.resize(self._is_root, values.shape)
        return np.where(is_root, np.sign(values) * np.sqrt(np.abs(values)), values)

    def _peaks(self, coefficients: Array, samples: Array, is_high: NDArray[np.bool_]) -> tuple[NDArray[np.intp], Array]:
        """Return which polynomials have a peak that is high up, and the places of peaks, from -1 to 1."""
        inner = samples[:, 1:-1]
        peak, place = np.nonzero((inner >= samples[:, :-2]) & (inner >= samples[:, 2:]) & is_high[:, 1:-1])
        # a peak may hide between an edge and the first look next to it: there the column rises away from the edge
        slope = coefficients @ _SLOPE_AT_ENDS.T
        low = np.flatnonzero((samples[:, 0] >= samples[:, 1]) & (slope[:, 0] > 0) & is_high[:, 0])
        high = np.flatnonzero((samples[:, -1] >= samples[:, -2]) & (slope[:, 1] < 0) & is_high[:, -1])
        edge_start = (_LOOK[1] + _LOOK[0]) / 2
        peak = np.concatenate([peak, low, high])
        u = np.concatenate([_LOOK[place + 1], np.full(low.size, edge_start), np.full(high.size, -edge_start)])
        return peak, self._peak(coefficients[peak], u)

    def _tolerance(self, span: Array) -> Array:
        """Return the tolerance below the top of each column within which a place of its polynomials is a candidate."""
        scale, left = np.tile(self._scale, 2), np.tile(self._left.max(axis=1, initial=0.0), 2)
        return np.asarray(np.minimum((_TOLERANCE + 4 * left) * scale, np.maximum(_NEAR_TOP * span, _CONVERGED * scale)))

    def _first_of_equal(self, places: _Places, ordered: Array, values: Array) -> NDArray[np.intp]:
        """Return for each row at which of the angles its value is largest, of those that it may stand at."""
        rows, angles = places.rows, places.angles
        place = np.searchsorted(ordered, angles)
        seen, largest = values[rows, place], np.full(len(values), -np.inf)
        np.maximum.at(largest, rows, seen)
        is_equal = seen >= (largest - places.equal)[rows]
        rows, place, angles = rows[is_equal], place[is_equal], angles[is_equal]
        first, edge = np.full(len(values), ordered.size), np.full(len(values), ordered.size)
        np.minimum.at(first, rows, place)
        # an edge is meant where rounding alone tells the angle from it
        begins = self._low[np.searchsorted(self._low, angles, side="right") - 1] == angles
        near = begins & (angles - ordered[first[rows]] < _AT_EDGE)
        np.minimum.at(edge, rows[near], place[near])
        # a column of nothing but rounding has its largest anywhere
        first = np.where(first < ordered.size, first, np.argmax(values, axis=1))
        return np.where(edge < ordered.size, edge, first)

    def _zeros(self, coefficients: Array, low: Array, high: Array, starts_below: NDArray[np.bool_]) -> Array:
        """Return the zero of each polynomial between two places of different sign: Newton steps, kept between them."""
        both = np.stack([coefficients.T, _DERIVATIVE @ coefficients.T], axis=1)
        u = (low + high) / 2
        for _ in range(_STEPS if u.size else 0):
            value, slope = legendre.legval(u, both, tensor=False)
            before = (value < 0) == starts_below
            low, high = np.where(before, u, low), np.where(before, high, u)
            moved = u - np.divide(value, slope, out=np.full_like(u, np.inf), where=slope != 0)
            # a zero at an end may lie beyond it by rounding
            within = (moved >= low - _SETTLED) & (moved <= high + _SETTLED)
            moved = np.where(within, np.clip(moved, low, high), (low + high) / 2)
            change, u = np.max(np.abs(moved - u)), moved
            if change < _SETTLED:
                break
        return u

    def _peak(self, coefficients: Array, u: Array) -> Array:
        """Return the peak of each polynomial near a place from -1 to 1: Newton steps, kept where it rises to one."""
        first = _DERIVATIVE @ coefficients.T
        slopes, around = np.stack([first, _DERIVATIVE @ first], axis=1), np.arccos(-u)
        low = -np.cos(np.maximum(around - _NODE_SPACING, 0.0))
        high = -np.cos(np.minimum(around + _NODE_SPACING, math.pi))
        for _ in range(_STEPS if u.size else 0):
            slope, bend = legendre.legval(u, slopes, tensor=False)
            low, high = np.where(slope > 0, u, low), np.where(slope > 0, high, u)
            moved = u - np.divide(slope, bend, out=np.full_like(u, np.inf), where=bend < 0)
            moved = np.where((moved >= low) & (moved <= high), moved, (low + high) / 2)
            change, u = np.max(np.abs(moved - u)), moved
            if change < _SETTLED:
                break
        return u


def _later(columns: Mapping[str, TracedValue], cycle: float) -> Iterator[tuple[str, tuple[str, float]]]:
    """Yield columns that are others of them at another crank angle: their keys, those of these, and by how much."""
    keys = {id(column.node): key for key, column in columns.items()}
    for key, column in columns.items():
        node = column.node
        if isinstance(node, Delayed) and node.cycle == cycle and column.varies and id(node.of.node) in keys:
            yield key, (keys[id(node.of.node)], node.by)


def _is_root(known: TracedValue) -> bool:
    return known.varies and isinstance(known.node, FormulaCall) and known.node.formula.is_root


def integrals_of_roots(coefficients: Array, limits: Array, slopes: Array | None = None) -> Array:
    """Return the means of the roots of polynomials from -1 to 1, on parts of them where a root has a corner.

    `coefficients`: those of Legendre polynomials, shape (n, 16); `limits`: what a mean may miss, shape (n,); `slopes`:
    what the means change with coefficients is added to these, in their shape.
    """
    result = np.zeros(len(coefficients))
    # what rounding leaves a polynomial unsure by
    rounding = _EVALUATED * np.abs(coefficients).sum(axis=1)
    row = np.arange(len(coefficients))
    low, high = np.full(row.size, -1.0), np.ones(row.size)
    own = coefficients
    for cut in range(_CUTS + 1):
        roots = np.sqrt(np.maximum(own @ _AT_ALL.T, 0.0))
        fitted = roots[:, : _NODES.size] @ _FROM_VALUES.T
        # a corner beyond the outermost node shows between the nodes only
        missed = np.max(np.abs(roots[:, _NODES.size :] - fitted @ _AT_LOOK.T), axis=1, initial=0.0)
        least, little = roots.min(axis=1, initial=np.inf), rounding[row]
        enough = np.maximum(limits[row], little / np.maximum(least + np.sqrt(little), 1e-300))
        is_coarse = (np.abs(fitted[:, -2]) + np.abs(fitted[:, -1]) + _LITTLE * missed > enough) & (cut < _CUTS)
        np.add.at(result, row, np.where(is_coarse, 0.0, (high - low) / 2 * fitted[:, 0]))
        if slopes is not None:
            u = (low + high)[:, None] / 2 + (high - low)[:, None] / 2 * _NODES
            weights = np.where(is_coarse, 0.0, high - low)[:, None] * _WEIGHTS / 8
            with np.errstate(divide="ignore", invalid="ignore"):
                weights = np.where(roots[:, : _NODES.size] > 0, weights / roots[:, : _NODES.size], 0.0)
            np.add.at(slopes, row, np.einsum("nq,nqj->nj", weights, legendre.legvander(u, _NODES.size - 1)))
        row = np.tile(row[is_coarse], _PARTS)
        between = np.linspace(low[is_coarse], high[is_coarse], _PARTS + 1)
        low, high = between[:-1].ravel(), between[1:].ravel()
        if not row.size:
            break
        own = np.concatenate([own[is_coarse] @ part for part in _ON_PARTS])
    return result
