"""Quantities over the crank angle as piecewise polynomials: their integral, extremes and zeros without sampling."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crankwork.errors import MethodError
from crankwork.kinematics.crank_grid import Array

# Where a polynomial is looked at for changes of sign, inside each of its intervals.
_PARTS = 8
_BISECTIONS = 100
# of an interval: Newton's next step would be the square of this
_SETTLED = 1e-9
_PLATEAU = 1e-14
_NODES = (np.polynomial.legendre.leggauss(8)[0] + 1) / 2


def _powers(count: int) -> Array:
    """Return the coefficients of Legendre polynomials of 2 u - 1 by ascending powers of u, a row for each degree."""
    rows = np.zeros((count, count))
    for n in range(count):
        for k in range(n + 1):
            rows[n, k] = (-1) ** (n + k) * math.comb(n, k) * math.comb(n + k, k)
    return rows


_POWERS = _powers(16)


class Extremes(NamedTuple):
    """The least and the largest value of a curve over its cycle, and the first angles where they occur. [rad]"""

    least: float
    at_least: float
    largest: float
    at_largest: float

    @classmethod
    def among(cls, angles: Array, values: Array, equal: float) -> Self:
        """Return those of values at angles; of values that only a part of the largest tells apart the first counts."""
        near = equal * float(np.max(np.abs(values)))
        extremes = list[float]()
        for is_extreme in (values <= np.min(values) + near, values >= np.max(values) - near):
            equals = np.flatnonzero(is_extreme)
            first = equals[np.argmin(angles[equals])]
            extremes += [float(values[first]), float(angles[first])]
        return cls(*extremes)


@dataclass(frozen=True)
class Curve:
    """A quantity over one cycle of the crank, repeated in every cycle. Made by `linear`, `fitted` or `legendre`."""

    # Ascending angles between which it is a polynomial; the last is the first, one cycle on, shape (n + 1,) [rad]
    angle: Array
    # Coefficients of ascending powers of the angle from the start of each interval, shape (k, n) [unit
    # of the quantity / rad^i]
    coefficients: Array
    # How much it grows per cycle; zero unless it is the integral of a quantity with a mean [unit of the quantity]
    growth: float = 0.0

    @classmethod
    def linear(cls, angle: ArrayLike, value: ArrayLike) -> Self:
        """Return the broken line through given corners; an angle given twice is a jump.

        `angle`: angles that do not descend, over one whole cycle [rad].

        Examples
        --------
        >>> Curve.linear([0.0, 1.0, 3.0], [0.0, 6.0, 0.0]).mean
        3.0
        """
        angle, value = _checked(angle, value)
        step = np.diff(angle)
        real = step > 0
        left, rise = value[:-1][real], np.diff(value)[real] / step[real]
        return cls(np.concatenate([angle[:-1][real], angle[-1:]]), np.stack([left, rise]))

    @classmethod
    def fitted(cls, function: Callable[[Array], Array], breaks: ArrayLike, *, width: float = np.pi / 24) -> Self:
        """Return the polynomials that agree with a function at Gauss points between the breaks.

        `function`: the quantity at ascending angles, smooth between the breaks. [rad] -> [its unit]; `breaks`:
        ascending angles over one whole cycle; the function is never asked at a break itself [rad].

        Examples
        --------
        >>> curve = Curve.fitted(np.cos, [0.0, 2 * np.pi])
        >>> bool(abs(curve(1.0) - np.cos(1.0)) < 1e-14)
        True
        """
        breaks = np.asarray(breaks, dtype=float)
        parts = np.maximum(1, np.ceil(np.diff(breaks) / width - _PARTS * np.finfo(float).eps)).astype(int)
        starts = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(breaks, breaks[1:], parts, strict=False)]
        angle = np.append(np.concatenate(starts), breaks[-1])
        steps = np.diff(angle)
        values = function((angle[:-1, None] + steps[:, None] * _NODES).ravel()).reshape(steps.size, _NODES.size)
        scaled = np.linalg.solve(np.vander(_NODES, increasing=True), values.T)
        return cls(angle, scaled / _ascending(steps, _NODES.size))

    @classmethod
    def legendre(cls, angle: ArrayLike, coefficients: ArrayLike) -> Self:
        """Return the curve of Legendre polynomials, each over its own interval.

        `angle`: ascending angles over one whole cycle [rad], shape (n + 1,); `coefficients`: coefficients of
        ascending degrees on each interval [its unit], shape (n, k).

        Examples
        --------
        >>> float(Curve.legendre([0.0, 2.0], [[1.0, 1.0]])(0.5))
        0.5
        """
        angle, coefficients = np.asarray(angle, dtype=float), np.asarray(coefficients, dtype=float)
        k = coefficients.shape[1]
        return cls(angle, (coefficients @ _POWERS[:k, :k]).T / _ascending(np.diff(angle), k))

    @classmethod
    def constant(cls, value: float, cycle: float = 2 * np.pi) -> Self:
        """Return a quantity that does not change."""
        return cls(np.array([0.0, cycle]), np.array([[float(value)]]))

    @property
    def cycle(self) -> float:
        """Length of the cycle. [rad]"""
        return float(self.angle[-1] - self.angle[0])

    def __call__(self, angle: ArrayLike) -> Array:
        """Return the quantity at any angles, from the right at a jump."""
        turns, interval, u = self._place(angle)
        return np.asarray(_horner(self.coefficients[:, interval], u) + turns * self.growth)

    def within(self, parts: Array) -> Array:
        """Return the quantity at the same parts of all intervals, from 0 to 1, shape (parts, intervals)."""
        return np.asarray(np.vander(parts, len(self.coefficients), increasing=True) @ self.of_parts)

    @property
    def of_parts(self) -> Array:
        """Coefficients of ascending powers of the part of each interval, from 0 to 1. [unit of the quantity]"""
        return self.coefficients * _ascending(np.diff(self.angle), len(self.coefficients))

    def _place(self, angle: ArrayLike) -> tuple[Array, NDArray[np.intp], Array]:
        """Return whole cycles, interval and angle from the start of the interval."""
        from_start = np.asarray(angle, dtype=float) - self.angle[0]
        turns = np.floor(from_start / self.cycle)
        rest = np.minimum(from_start - turns * self.cycle, self.cycle) + self.angle[0]
        interval = np.clip(np.searchsorted(self.angle, rest, side="right") - 1, 0, len(self.angle) - 2)
        return turns, interval, rest - self.angle[interval]

    @property
    def derivative(self) -> Self:
        """Derivative by the angle."""
        powers = np.arange(1, len(self.coefficients))
        derived = self.coefficients[1:] * powers[:, None] if powers.size else np.zeros_like(self.coefficients)
        return type(self)(self.angle, derived)

    @property
    def integral(self) -> Self:
        """Integral over the angle, zero at the start of the cycle."""
        powers = np.arange(1, len(self.coefficients) + 1)[:, None]
        ends = np.append(0.0, np.cumsum(self._parts_of_integral))
        return type(self)(self.angle, np.concatenate([[ends[:-1]], self.coefficients / powers]), float(ends[-1]))

    @property
    def _parts_of_integral(self) -> Array:
        """The integral over each interval."""
        return np.asarray(np.diff(self.angle) * (1 / np.arange(1, len(self.coefficients) + 1) @ self.of_parts))

    @property
    def mean(self) -> float:
        """Mean over the cycle."""
        return float(self._parts_of_integral.sum()) / self.cycle

    def __add__(self, other: Curve | float) -> Self:
        if not isinstance(other, Curve):
            shifted = self.coefficients.copy()
            shifted[0] += other
            return type(self)(self.angle, shifted, self.growth)
        first, second = self.on_common_intervals(other)
        k = max(len(first.coefficients), len(second.coefficients))
        total = np.zeros((k, first.coefficients.shape[1]))
        for curve in (first, second):
            total[: len(curve.coefficients)] += curve.coefficients
        return type(self)(first.angle, total, self.growth + other.growth)

    def __mul__(self, other: Curve | float) -> Self:
        if not isinstance(other, Curve):
            return type(self)(self.angle, other * self.coefficients, other * self.growth)
        if self.growth or other.growth:
            raise MethodError("a quantity that grows from cycle to cycle cannot be multiplied")
        first, second = self.on_common_intervals(other)
        p, q = first.coefficients, second.coefficients
        product = np.zeros((len(p) + len(q) - 1, p.shape[1]))
        for i, coefficient in enumerate(p):
            product[i : i + len(q)] += coefficient * q
        return type(self)(first.angle, product)

    def __neg__(self) -> Self:
        return self * -1.0

    def __sub__(self, other: Curve | float) -> Self:
        return self + -other

    def delayed(self, shift: float) -> Self:
        """Return the same quantity, every value later by an angle: the next cylinder of an engine."""
        if self.growth:
            raise MethodError("a quantity that grows from cycle to cycle cannot be delayed")
        first, last = self.angle[0], self.angle[-1]
        cut = float(first + (first - shift - first) % self.cycle)
        curve = self if np.any(self.angle == cut) else self._refined(np.union1d(self.angle, [cut]))
        index = int(np.searchsorted(curve.angle, cut))
        if cut in (first, last):
            return self
        angle = np.concatenate([curve.angle[index:], curve.angle[1 : index + 1] + self.cycle]) - cut + first
        rolled = np.roll(curve.coefficients, -index, axis=1)
        angle[-1] = last
        return type(self)(angle, rolled)

    def on_common_intervals(self, other: Curve) -> tuple[Curve, Curve]:
        """Return this curve and another, both on the intervals of both."""
        if np.array_equal(self.angle, other.angle):
            return self, other
        reach = 1e-9 * self.cycle
        if abs(self.cycle - other.cycle) > reach or abs(self.angle[0] - other.angle[0]) > reach:
            raise MethodError(
                f"quantities over different cycles cannot be combined: one from {np.degrees(self.angle[0]):g} to "
                f"{np.degrees(self.angle[-1]):g} deg, one from {np.degrees(other.angle[0]):g} to "
                f"{np.degrees(other.angle[-1]):g} deg"
            )
        inside = np.union1d(self.angle[1:-1], other.angle[1:-1])
        angle = np.concatenate([self.angle[:1], inside, self.angle[-1:]])
        return self._refined(angle), other._refined(angle)

    def _refined(self, angle: Array) -> Curve:
        """Return the same curve on more intervals."""
        middle = (angle[1:] + angle[:-1]) / 2
        interval = np.clip(np.searchsorted(self.angle, middle, side="right") - 1, 0, len(self.angle) - 2)
        u = angle[:-1] - self.angle[interval]
        shifted = self.coefficients[:, interval].copy()
        for low in range(len(shifted) - 1):
            for i in range(len(shifted) - 2, low - 1, -1):
                shifted[i] += u * shifted[i + 1]
        return Curve(angle, shifted, self.growth)

    def zeros(self) -> Array:
        """Return every angle of the cycle where the quantity changes its sign inside an interval. [rad]"""
        angles, _ = self.at_zeros(self)
        return np.unique(angles)

    def at_zeros(self, *curves: Curve) -> tuple[Array, ...]:
        """Return the angles where the quantity changes its sign, and curves on the same intervals there. [rad]"""
        interval, parts = _sign_changes(self.of_parts)
        u = np.diff(self.angle)[interval] * parts
        return self.angle[interval] + u, *(_horner(curve.coefficients[:, interval], u) for curve in curves)

    def extremes(self) -> Extremes:
        """Return the least and the largest value, over all corners, jumps and points of zero slope."""
        (extremes,) = extremes_of([self])
        return extremes


def extremes_of(curves: Sequence[Curve]) -> list[Extremes]:
    """Return the extremes of curves on the same intervals, with coefficients of the same powers, found at once."""
    angle, count = curves[0].angle, len(curves[0].angle) - 1
    coefficients = np.concatenate([curve.of_parts for curve in curves], axis=1)
    place, parts = _sign_changes(coefficients[1:] * np.arange(1, len(coefficients))[:, None])
    (which, interval), peaks = np.divmod(place, count), _horner(coefficients[:, place], parts)
    angles = angle[interval] + np.diff(angle)[interval] * parts
    starts, ends = (values.reshape(-1, count) for values in (coefficients[0], coefficients.sum(axis=0)))
    result = []
    for number, (start, end) in enumerate(zip(starts, ends, strict=True)):
        places = np.concatenate([angle[:-1], angles[which == number], angle[1:]])
        result.append(Extremes.among(places, np.concatenate([start, peaks[which == number], end]), _PLATEAU))
    return result


@dataclass(frozen=True)
class AtDegrees:
    """A curve as a table over the crank angle in degrees."""

    curve: Curve

    def __call__(self, degrees: Array) -> Array:
        """Return the values at crank angles."""
        return self.curve(np.radians(degrees))


def _checked(angle: ArrayLike, value: ArrayLike) -> tuple[Array, Array]:
    angle, value = np.asarray(angle, dtype=float), np.asarray(value, dtype=float)
    if angle.ndim != 1 or angle.shape != value.shape or angle.size < 2:
        raise MethodError(f"angles and values must be rows of equal length, not of shapes {angle.shape}, {value.shape}")
    if np.any(np.diff(angle) < 0) or angle[-1] <= angle[0] or not np.all(np.isfinite(value)):
        raise MethodError("angles must ascend over one whole cycle, and all values must be finite")
    return angle, value


def _ascending(steps: Array, count: int) -> Array:
    """Return so many ascending powers of steps, shape (count, n)."""
    return np.asarray(np.vander(steps, count, increasing=True).T)


def _horner(coefficients: Array, u: Array) -> Array:
    value: Array = coefficients[-1] + np.zeros_like(u)
    for power in coefficients[-2::-1]:
        value *= u
        value += power
    return value


def _sign_changes(coefficients: Array) -> tuple[NDArray[np.intp], Array]:
    """Return which polynomials change their sign between 0 and 1, and where, each as often as it does."""
    count = len(coefficients)
    looks = np.linspace(0.0, 1.0, (_PARTS if count > 2 else 1) + 1)
    value = np.vander(looks, count, increasing=True) @ coefficients
    part, interval = np.nonzero((value[:-1] < 0) != (value[1:] < 0))
    low, high, below, above = looks[part], looks[part + 1], value[part, interval], value[part + 1, interval]
    both = np.zeros((2, count, interval.size))
    both[0] = coefficients[:, interval]
    both[1, :-1] = both[0, 1:] * np.arange(1, count)[:, None]
    # a root between two places, by Newton's method where it stays between them, else by halving
    u = (low * above - high * below) / (above - below)
    for _ in range(_BISECTIONS if u.size else 0):
        value, slope = np.einsum("skm,mk->sm", both, np.vander(u, count, increasing=True))
        is_left = (value < 0) == (below < 0)
        low, high = np.where(is_left, u, low), np.where(is_left, high, u)
        moved = u - np.divide(value, slope, out=np.full_like(u, np.inf), where=slope != 0)
        moved = np.where((moved >= low) & (moved <= high), moved, (low + high) / 2)
        change, u = np.max(np.abs(moved - u)), moved
        if change < _SETTLED:
            break
    return interval, u
