"""Columns over a whole cycle without sampling: their means, integrals and extremes.

Between the angles where a law changes a column is smooth; there it is followed by polynomials, on intervals halved
until the polynomials have converged. Integrals are those of the polynomials; where an extreme stands is found on them,
what it amounts to is replayed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from crankwork.formula.known import Array, Found, Known, breaks_of, distinct
from crankwork.formula.replay import Angles, Program

_NODES, _WEIGHTS = legendre.leggauss(12)
_DEGREES = np.arange(_NODES.size)
_FROM_VALUES = (legendre.legvander(_NODES, _NODES.size - 1) * _WEIGHTS[:, None]).T * ((2 * _DEGREES + 1) / 2)[:, None]
_LOOK = np.linspace(-1.0, 1.0, 25)
_AT_LOOK = legendre.legvander(_LOOK, _NODES.size - 1)
_EDGES = np.array([-1.0, 1.0])
_WIDTH = 30.0
_CONVERGED = 1e-12
_HALVINGS = 14
_NO_BETTER = 0.3
_PATIENT = 2
# of equal values, whatever rounding says, the first counts
_PLATEAU = 1e-13
_NEAR_TOP = 0.05
_NEWTON = 12
_SETTLED = 1e-15
_JUMP = 1e-10
_AT_EDGE = 0.05
_ZERO = 1e-14
_BISECTIONS = 60


class Extreme(NamedTuple):
    """A largest or least value and the first crank angle where it stands. [deg]"""

    value: float
    at: float


class _Seen(NamedTuple):
    """Crank angles to be looked at, and peaks inside intervals: which, where from -1 to 1, and their polynomials."""

    angles: Array
    interval: NDArray[np.intp]
    u: Array
    coefficients: Array


class OverCycle:
    """Columns over one cycle.

    Parameters
    ----------
    knowns : mapping of str to Known
        The columns, by key.
    angles_at : callable
        The grid of crank angles. [deg]
    cycle : float
        Length of the cycle. [deg]
    start : float
        Where it begins. [deg]
    size_of : mapping of str to str
        The column whose size says what counts in another: that of an error is the column it is an error of.

    Notes
    -----
    `error` is the largest coefficient left out, relative to the largest value of its column: what integrals and the
    places of extremes may be wrong by.
    """

    def __init__(
        self,
        knowns: Mapping[str, Known],
        angles_at: Callable[[Any], Angles],
        cycle: float,
        start: float = 0.0,
        *,
        size_of: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        self._program, self._angles_at = Program(knowns), angles_at
        self._row = {key: at for at, key in enumerate(knowns)}
        self.knowns = dict(knowns)
        self.breaks = breaks_of(knowns.values(), cycle, start)
        parts = np.maximum(1, np.ceil(np.diff(self.breaks) / _WIDTH - 1e-9)).astype(int)
        within = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
        start_of, width = np.repeat(self.breaks[:-1], parts), np.repeat(np.diff(self.breaks) / parts, parts)
        low = start_of + within * width
        high = np.append(low[1:], self.breaks[-1])
        coefficients = self._fit(low, high)
        size = np.maximum(np.max(np.abs(coefficients).sum(axis=2), axis=1), 1e-300)
        self._scale = size[[self._row[size_of.get(key, key)] for key in self._row]]
        rounding = np.zeros(coefficients.shape[:2], dtype=bool)
        for halving in range(_HALVINGS):
            left = np.where(rounding, 0.0, self._left_out(coefficients))
            coarse = np.flatnonzero(np.max(left, axis=0, initial=0.0) > _CONVERGED)
            if not coarse.size:
                break
            middle = (low[coarse] + high[coarse]) / 2
            fine_low, fine_high = np.concatenate([low[coarse], middle]), np.concatenate([middle, high[coarse]])
            kept = np.delete(np.arange(low.size), coarse)
            low, high = np.concatenate([low[kept], fine_low]), np.concatenate([high[kept], fine_high])
            fine = self._fit(fine_low, fine_high)
            coefficients = np.concatenate([coefficients[:, kept], fine], axis=1)
            # what is no nearer in either half is rounding, and no polynomial follows it
            better = self._left_out(fine).reshape(-1, 2, coarse.size).min(axis=1)
            hopeless = rounding[:, coarse] | ((better > _NO_BETTER * left[:, coarse]) & (halving >= _PATIENT))
            rounding = np.concatenate([rounding[:, kept], hopeless, hopeless], axis=1)
        order = np.argsort(low)
        self._low, self._high, self._coefficients = low[order], high[order], coefficients[:, order]
        self.error = float(np.max(self._left_out(self._coefficients), initial=0.0))

    def _fit(self, low: Array, high: Array) -> Array:
        """Return Legendre coefficients, shape (columns, intervals, degrees)."""
        degrees = (low + high)[:, None] / 2 + (high - low)[:, None] / 2 * _NODES
        columns = self._program(self._angles_at(degrees.ravel()))
        values = (
            np.stack([columns[key].reshape(degrees.shape) for key in self._row]) if columns else np.empty((0, 0, 0))
        )
        return np.asarray(values @ _FROM_VALUES.T)

    def _left_out(self, coefficients: Array) -> Array:
        return np.asarray(np.abs(coefficients[:, :, -2:]).sum(axis=2) / self._scale[:, None])

    def integral(self, key: str) -> float:
        """Return the integral of a column over the crank angle. [its unit, rad]"""
        widths = np.radians(self._high - self._low)
        return float(widths @ self._coefficients[self._row[key], :, 0])

    def mean(self, key: str, name: str) -> Known:
        """Return the mean of a column under a name; what rounding leaves of nothing is nothing."""
        mean = self.integral(key) / float(np.radians(self._high[-1] - self._low[0]))
        if abs(mean) <= _PLATEAU * self._scale[self._row[key]]:
            mean = 0.0
        return Known(Found(mean, "mean", (self.knowns[key],)), name)

    def polynomials(self, key: str) -> Array:
        """Return the Legendre coefficients of a column between `edges`, shape (intervals, degrees)."""
        return np.asarray(self._coefficients[self._row[key]])

    @property
    def edges(self) -> Array:
        """Crank angles between which every column is as good as a polynomial. [deg]"""
        return np.append(self._low, self._high[-1])

    def is_nothing(self, key: str) -> bool:
        """Return whether a column is zero everywhere."""
        return not np.any(self._coefficients[self._row[key]])

    def at(self, key: str, degrees: Array) -> Array:
        """Return a column at crank angles. [deg]"""
        return self._program(self._angles_at(degrees))[key]

    def crossings(self, key: str, level: float = 0.0) -> Array:
        """Return the crank angles where a column passes a level, ascending. [deg]"""
        row = self._row[key]
        coefficients = self._coefficients[row].copy()
        coefficients[:, 0] -= level
        looked = coefficients @ _AT_LOOK.T
        looked[np.abs(looked) <= _ZERO * max(self._scale[row], abs(level))] = 0.0
        below = looked < 0
        interval, place = np.nonzero(below[:, 1:] != below[:, :-1])
        low, high, start = _LOOK[place], _LOOK[place + 1], below[interval, place]
        for _ in range(_BISECTIONS if interval.size else 0):
            middle = (low + high) / 2
            same = (legendre.legval(middle, coefficients[interval].T, tensor=False) < 0) == start
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        middle, half = (self._low + self._high) / 2, (self._high - self._low) / 2
        inside = middle[interval] + half[interval] * (low + high) / 2
        return distinct(np.concatenate([inside, self._high[:-1][below[:-1, -1] != below[1:, 0]]]))

    def stretches(self, key: str) -> tuple[list[float], list[bool]]:
        """Return where stretches of one sign end, the last at the end of the cycle, and whether each is negative."""
        start, end = float(self._low[0]), float(self._high[-1])
        inner = [one for one in self.crossings(key).tolist() if start + _AT_EDGE < one < end - _AT_EDGE]
        edges = np.array([start, *inner, end])
        values = self.at(key, (edges[1:] + edges[:-1]) / 2)
        ends: list[float] = []
        signs: list[bool] = []
        for at, negative in zip(edges[1:].tolist(), (values < 0).tolist(), strict=True):
            if signs and signs[-1] == negative:
                ends[-1] = at
            else:
                ends.append(at)
                signs.append(negative)
        return ends, signs

    def largest(self, key: str) -> Extreme:
        """Return the largest value of a column and where it stands."""
        return self._found([(key, 1.0)])[0]

    def least(self, key: str) -> Extreme:
        """Return the least value of a column and where it stands."""
        return self._found([(key, -1.0)])[0]

    def extremes(self, *keys: str) -> dict[str, Known]:
        """Return the extremes of columns and their crank angles as `KEY_max`, `KEY_max_angle` and so on."""
        words = (("max", 1.0), ("min", -1.0))
        found = iter(self._found([(key, sign) for key in keys for _, sign in words]))
        result = {}
        for key in keys:
            kind, dot, name = key.partition(".")
            of = (self.knowns[key],)
            for word, _ in words:
                value, at = next(found)
                extreme, angle = f"{kind}_{word}{dot}{name}", f"{kind}_{word}_angle{dot}{name}"
                result[extreme] = Known(Found(value, word, of, at), extreme)
                result[angle] = Known(Found(float(np.radians(at)), f"{word}_angle", of, at), angle)
        return result

    def errors(self, *keys: str) -> dict[str, Known]:
        """Return the largest of columns by size, each under its own key."""
        found = iter(self._found([(key, sign) for key in keys for sign in (1.0, -1.0)]))
        result = {}
        for key in keys:
            largest, least = next(found), next(found)
            worst = largest if largest.value >= -least.value else least
            result[key] = Known(Found(abs(worst.value), "error", (self.knowns[key],), worst.at), key)
        return result

    def _found(self, wanted: list[tuple[str, float]]) -> list[Extreme]:
        """Return extremes, largest where the sign is 1 and least where it is -1, all replayed together."""
        seen = [self._seen(*one) for one in wanted]
        counts = np.cumsum([one.interval.size for one in seen])[:-1]
        peaks = np.split(self._peaks(seen), counts) if seen else []
        places = [distinct(np.concatenate([one.angles, found])) for one, found in zip(seen, peaks, strict=True)]
        every = distinct(np.concatenate(places)) if places else np.empty(0)
        columns = Program({key: self.knowns[key] for key, _ in wanted})(self._angles_at(every)) if places else {}
        return [
            self._first_of_equal(near, sign * columns[key][np.searchsorted(every, near)], sign)
            for (key, sign), near in zip(wanted, places, strict=True)
        ]

    def _seen(self, key: str, sign: float) -> _Seen:
        """Return where the extreme of a column may stand: edges, jumps, and inside intervals roughly."""
        coefficients = sign * self._coefficients[self._row[key]]
        looked = coefficients @ _AT_LOOK.T
        floor = float(np.max(looked)) - _NEAR_TOP * float(np.ptp(looked))
        jumps = np.flatnonzero(np.abs(looked[1:, 0] - looked[:-1, -1]) > _JUMP * self._scale[self._row[key]]) + 1
        angles = np.concatenate([self._low, self._high, np.nextafter(self._low[jumps], np.inf)])
        inner = looked[:, 1:-1]
        interval, place = np.nonzero((inner >= looked[:, :-2]) & (inner >= looked[:, 2:]) & (inner >= floor))
        # a peak may hide between an edge and the first look beside it: there the column rises away from the edge
        slope = legendre.legval(_EDGES, legendre.legder(coefficients.T))
        low = np.flatnonzero((looked[:, 0] >= looked[:, 1]) & (slope[:, 0] > 0) & (looked[:, 0] >= floor))
        high = np.flatnonzero((looked[:, -1] >= looked[:, -2]) & (slope[:, 1] < 0) & (looked[:, -1] >= floor))
        beside = (_LOOK[1] + _LOOK[0]) / 2
        which = np.concatenate([interval, low, high])
        start = np.concatenate([_LOOK[place + 1], np.full(low.size, beside), np.full(high.size, -beside)])
        return _Seen(angles, which, start, coefficients[which])

    def _first_of_equal(self, near: Array, values: Array, sign: float) -> Extreme:
        spare = _PLATEAU * (float(np.ptp(values)) + float(np.max(np.abs(values))))
        equal = np.flatnonzero(values >= np.max(values) - spare)
        # an edge is meant where rounding alone tells the angle from it
        at = next((i for i in equal if near[i] in self._low and near[i] - near[equal[0]] < _AT_EDGE), equal[0])
        return Extreme(sign * float(values[at]), float(near[at]))

    def _peaks(self, seen: list[_Seen]) -> Array:
        """Return the crank angles of peaks inside intervals, those of all columns together. [deg]"""
        interval, u = (np.concatenate([one[at] for one in seen]) for at in (1, 2))
        if not interval.size:
            return np.empty(0)
        first = legendre.legder(np.concatenate([one.coefficients for one in seen]).T)
        second, step = legendre.legder(first), _LOOK[1] - _LOOK[0]
        low, high = np.maximum(u - step, -1.0), np.minimum(u + step, 1.0)
        for _ in range(_NEWTON):
            slope, bend = legendre.legval(u, first, tensor=False), legendre.legval(u, second, tensor=False)
            moved = np.clip(u - np.divide(slope, bend, out=np.zeros_like(u), where=bend != 0), low, high)
            change, u = np.max(np.abs(moved - u), initial=0.0), moved
            if change < _SETTLED:
                break
        return np.asarray((self._low[interval] + self._high[interval]) / 2 + (self._high - self._low)[interval] / 2 * u)
