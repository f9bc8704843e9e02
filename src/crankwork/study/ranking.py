"""Running statistics of designs: the best, the Pareto set, histograms, moments and Sobol indices."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array

# indices of designs, or a mask
Index = NDArray[Any]

# largest number of bins of a histogram, and of designs of a Pareto set
_BINS, MAX_PARETO = 128, 10_000
_FINEST = -1074
# number of designs from which clearly dominated ones are removed first
_FEW = 2000


def pareto_front(costs: Array) -> Index:
    """Return the designs that no other dominates, the first of equal ones; costs of shape (n, m)."""
    if len(costs) > _FEW:
        few = _promising(costs)
        return few[pareto_front(costs[few])] if len(few) < len(costs) else _sorted_out(costs)
    return _sorted_out(costs)


def _promising(costs: Array) -> Index:
    """Return the designs that a few good ones do not dominate."""
    low, high = costs.min(axis=0), costs.max(axis=0)
    shares = (costs - low) / np.where(high > low, high - low, 1.0)
    left = np.arange(len(costs))
    for weights in (np.ones(costs.shape[1]), *(1.0 + 4.0 * np.eye(costs.shape[1]))):
        good = costs[left[np.argmin(shares[left] @ weights)]]
        left = left[np.any(costs[left] < good, axis=1) | np.all(costs[left] == good, axis=1)]
    return left


def _sorted_out(costs: Array) -> Index:
    if len(costs) == 0:
        return np.zeros(0, dtype=np.intp)
    if costs.shape[1] <= 2:
        order = np.lexsort((costs[:, -1], costs[:, 0]))
        last = costs[order, -1]
        least = np.minimum.accumulate(np.concatenate([[np.inf], last[:-1]]))
        return np.sort(order[last < least])
    # a dominating design has the smaller sum, and comes first if rounding makes sums equal
    low, high = costs.min(axis=0), costs.max(axis=0)
    sums = ((costs - low) / np.where(high > low, high - low, 1.0)).sum(axis=1)
    left = np.lexsort((*costs.T[::-1], sums))
    kept = []
    while left.size:
        kept.append(left[0])
        left = left[1:][np.any(costs[left[1:]] < costs[left[0]], axis=1)]
    return np.sort(np.array(kept, dtype=np.intp))


def thin_front(costs: Array, places: Index, most: int = MAX_PARETO) -> Index:
    """Return at most so many designs of a Pareto set, evenly spaced along the first objective, with its ends."""
    if len(places) <= most:
        return places
    order = places[np.argsort(costs[places, 0], kind="stable")]
    return np.sort(order[np.linspace(0, len(order) - 1, most).astype(np.intp)])


def best_designs(cost: Array, count: int) -> Index:
    """Return the designs with the smallest cost in order; of equal ones the first."""
    near = np.arange(len(cost))
    if len(cost) > count:
        near = np.flatnonzero(cost <= np.partition(cost, count)[count])
    return near[np.argsort(cost[near], kind="stable")[:count]]


@dataclass
class Moments:
    """Count, extremes and sums of values about a value close to them."""

    near: float
    count: int = 0
    low: float = math.inf
    high: float = -math.inf
    total: float = 0.0
    squares: float = 0.0

    @classmethod
    def of(cls, values: Array, near: float) -> Moments:
        """Return the moments of finite values."""
        if not values.size:
            return cls(near)
        away = values - near
        return cls(near, values.size, float(values.min()), float(values.max()), float(away.sum()), float(away @ away))

    def add(self, other: Moments) -> None:
        """Add moments about the same value."""
        self.count += other.count
        self.low, self.high = min(self.low, other.low), max(self.high, other.high)
        self.total += other.total
        self.squares += other.squares

    @property
    def mean(self) -> float:
        """The mean."""
        return self.near + self.total / self.count if self.count else math.nan

    @property
    def deviation(self) -> float:
        """The standard deviation of the values as a sample."""
        if self.count < 2:
            return math.nan
        return math.sqrt(max(self.squares - self.total**2 / self.count, 0.0) / (self.count - 1))


@dataclass
class Histogram:
    """Number of values in each of at most 128 bins of the width 2^exponent, starting at `first` times the width.

    Widths that are powers of two can be doubled exactly, so that the order of histograms does not change their sum.
    """

    exponent: int = _FINEST
    first: int = 0
    counts: list[int] = field(default_factory=list)

    @classmethod
    def of(cls, values: Array) -> Histogram:
        """Return the histogram of finite values."""
        if not values.size:
            return cls()
        low, high = float(values.min()), float(values.max())
        # a bin for equal values is about 1e-13 of them wide, for zeros the finest
        size = max(high - low, abs(high), abs(low))
        exponent = max(math.frexp(size)[1] - 44, _FINEST) if size else _FINEST
        exponent = max(exponent, math.frexp((high - low) / _BINS)[1] - 1 if high > low else exponent)
        while math.floor(high / 2.0**exponent) - math.floor(low / 2.0**exponent) >= _BINS:
            exponent += 1
        places = np.floor(values / 2.0**exponent).astype(np.int64)
        first = int(places.min())
        return cls(exponent, first, np.bincount(places - first).tolist())

    def add(self, other: Histogram) -> None:
        """Add another histogram."""
        if not other.counts:
            return
        if not self.counts:
            self.exponent, self.first, self.counts = other.exponent, other.first, list(other.counts)
            return
        exponent = max(self.exponent, other.exponent)
        own, added = self._coarser(exponent), other._coarser(exponent)
        while max(own.end, added.end) - min(own.first, added.first) > _BINS:
            exponent += 1
            own, added = own._coarser(exponent), added._coarser(exponent)  # noqa: SLF001
        first = min(own.first, added.first)
        counts = np.zeros(max(own.end, added.end) - first, dtype=np.int64)
        for part in (own, added):
            counts[part.first - first : part.end - first] += np.array(part.counts, dtype=np.int64)
        self.exponent, self.first, self.counts = exponent, first, counts.tolist()

    @property
    def end(self) -> int:
        """Number of the bin after the last."""
        return self.first + len(self.counts)

    @property
    def edges(self) -> Array:
        """Edges of the bins."""
        return np.asarray(np.arange(self.first, self.end + 1) * 2.0**self.exponent)

    def _coarser(self, exponent: int) -> Histogram:
        if exponent == self.exponent:
            return self
        places = np.arange(self.first, self.end) >> min(exponent - self.exponent, 62)
        first = int(places[0])
        return Histogram(exponent, first, np.bincount(places - first, weights=self.counts).astype(int).tolist())


@dataclass
class Shares:
    """Sums over points for the Sobol indices of one value: first order by Saltelli, total by Jansen.

    `products`, `differences`: sums of the estimates for each field, and of their squares.
    """

    near: float
    points: int = 0
    total: float = 0.0
    squares: float = 0.0
    products: Array = field(default_factory=lambda: np.zeros((2, 0)))
    differences: Array = field(default_factory=lambda: np.zeros((2, 0)))

    @classmethod
    def of(cls, values: Array, near: float) -> Shares:
        """Return the sums of values of shape (points, fields + 2); points with a missing value are left out."""
        away = values[np.isfinite(values).all(axis=1)] - near
        first, second, mixed = away[:, :1], away[:, 1:2], away[:, 2:]
        products, differences = second * (mixed - first), (first - mixed) ** 2 / 2
        either = away[:, :2]
        total, squares = float(either.sum()), float((either**2).sum())
        sums = (np.array([terms.sum(axis=0), (terms**2).sum(axis=0)]) for terms in (products, differences))
        return cls(near, len(away), total, squares, *sums)

    def add(self, other: Shares) -> None:
        """Add sums about the same value."""
        self.points += other.points
        self.total += other.total
        self.squares += other.squares
        is_first = self.products.shape[1] == 0
        self.products = other.products if is_first else self.products + other.products
        self.differences = other.differences if is_first else self.differences + other.differences

    def indices(self) -> tuple[Array, Array, Array, Array] | None:
        """Return first-order indices and their errors, total ones and their errors; None if nothing varies."""
        if self.points < 2:
            return None
        variance = self.squares / (2 * self.points) - (self.total / (2 * self.points)) ** 2
        if variance <= (1e-13 * self.near) ** 2:
            return None
        indices = []
        for sums in (self.products, self.differences):
            mean = sums[0] / self.points
            error = np.sqrt(np.maximum(sums[1] / self.points - mean**2, 0.0) / self.points)
            indices += [mean / variance, error / variance]
        return indices[0], indices[1], indices[2], indices[3]


def feasible(values: Sequence[Array], limits: Sequence[tuple[float, float]], count: int) -> Index:
    """Return whether each design satisfies all limits; NaN does not."""
    is_feasible = np.ones(count, dtype=bool)
    for column, (low, high) in zip(values, limits, strict=True):
        is_feasible &= (column >= low) & (column <= high)
    return is_feasible
