"""Zeros of a function: crossings, touches and jumps, and the intervals without a value."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev

from crankwork.errors import CrankworkError, InputError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage

Kind = Literal["rising", "falling", "touching"]

# relative to the position, and to the largest value
_CONVERGED, _ZERO = 1e-13, 1e-12
# tolerance of the ends of intervals, of the range
_EDGE = 1e-6
# a jump keeps its size when sampled this close on both sides, as a fraction of a step of the search
_ACROSS, _JUMP_SHARE, _MIN_JUMP = 1e-8, 0.5, 1e-9
_GOLDEN = (3 - math.sqrt(5)) / 2
_NARROW = 1e-9
_ROUNDING = 4 * float(np.finfo(float).eps)
_MAX_ITERATIONS = 200
_USUAL = 1e3
# distance from a zero sample at which the sign is sampled, as a fraction of a step
_OFFSET = 1e-3
# a minimum further from zero than this many times its rise to the neighbours cannot reach zero between them
_REACH = 3.0
# nodes of a polynomial, and its largest truncation error relative to the largest coefficient
_NODES, _SMOOTH = 16, 1e-5
# slope of a polynomial whose coefficients are rounding errors, relative to the largest of these
_SLOPE = math.sqrt(_NODES**3 / 6)
# stop at a polynomial that is this many times less exact than the best
_WORSE = 1e3
# width of the narrowest polynomial, as a divisor of the range
_FINEST = 1600.0


class Sample(NamedTuple):
    """The value of the function at a position, or the reason why there is none."""

    at: float
    value: float
    reason: str = ""

    @property
    def state(self) -> str:
        """Key that is equal for samples of one interval: empty with a value, the kind of reason without."""
        return self.reason.name if isinstance(self.reason, ErrorMessage) else self.reason


class Root(NamedTuple):
    """Position of a zero, and the value there, which is zero to rounding."""

    at: float
    value: float
    kind: Kind


class Jump(NamedTuple):
    """Position where the function changes sign without a zero, and its values on both sides."""

    at: float
    before: float
    after: float


class Interval(NamedTuple):
    """Part of the range without a value and the reason, or where the function is zero throughout."""

    start: float
    end: float
    reason: str = ""


class RootSearchResult(NamedTuple):
    """Results between the first and the last sampled position."""

    roots: tuple[Root, ...]
    jumps: tuple[Jump, ...]
    without: tuple[Interval, ...]
    zero: tuple[Interval, ...]
    nearest: Sample | None


def find_roots(
    function: Callable[[float], float],
    places: Array,
    size: float = 0.0,
    progress: Callable[[float], None] | None = None,
) -> RootSearchResult:
    """Return the zeros of a function sampled at ascending positions.

    `function` raises CrankworkError where it has no value; two roots, or two ends of intervals, between two of the
    positions may be missed; `size`: size of the subtracted terms, whose rounding is taken as zero; `progress` is called
    with the fraction done.

    Examples
    --------
    >>> found = find_roots(lambda x: x * x - 2, np.linspace(0, 2, 9))
    >>> [(one.kind, round(one.at, 12)) for one in found.roots]
    [('rising', 1.414213562373)]
    """
    return _Search(function, places, size).search(progress)


class _Search:
    """One search: its samples and the tolerance of zero."""

    def __init__(self, function: Callable[[float], float], places: Array, size: float) -> None:
        self._function, self._places = function, places
        self._width = float(places[-1] - places[0])
        self._size, self._zero = size, 0.0

    def search(self, progress: Callable[[float], None] | None) -> RootSearchResult:
        samples = []
        for done, place in enumerate(self._places.tolist(), start=1):
            samples.append(self._sample(place))
            if progress is not None:
                progress(done / len(self._places))
        sizes = [abs(sample.value) for sample in samples if not sample.reason] or [0.0]
        # a pole must not raise the tolerance elsewhere
        self._size = max(self._size, min(max(sizes), _USUAL * float(np.median(sizes)) or math.inf))
        self._zero = _ZERO * self._size
        runs = self._runs(samples)
        roots, jumps, zero, near = list[Root](), list[Jump](), list[Interval](), list[Sample]()
        for run in runs:
            if run[0].reason:
                continue
            plain = self._without_zeros(run, zero, roots)
            for left, right in itertools.pairwise(plain):
                if left.value * right.value < 0 and not _passes(left, right, zero, roots):
                    self._cross(left, right, roots, jumps)
            self._touches(plain, zero, roots, jumps, near)
            near += run
        nearest = min(near, key=lambda sample: abs(sample.value), default=None)
        without = tuple(Interval(run[0].at, run[-1].at, run[0].reason) for run in runs if run[0].reason)
        distinct = tuple(_distinct_roots(roots, self._width))
        return RootSearchResult(distinct, tuple(sorted(jumps)), without, tuple(zero), nearest)

    def _sample(self, place: float) -> Sample:
        try:
            value = self._function(place)
        except CrankworkError as error:
            return Sample(place, math.nan, reason_of(error))
        return Sample(place, value) if math.isfinite(value) else Sample(place, math.nan, ErrorMessage("value_none"))

    def _runs(self, samples: Sequence[Sample]) -> list[list[Sample]]:
        """Return the samples as runs of one state, bisected to the ends of each."""
        runs = [[samples[0]]]
        for sample in samples[1:]:
            while sample.state != (last := runs[-1][-1]).state:
                low, high = last, sample
                while high.at - low.at > _EDGE * self._width:
                    middle = self._sample((low.at + high.at) / 2)
                    low, high = (middle, high) if middle.state == low.state else (low, middle)
                runs[-1] += [low] if low is not last else []
                runs.append([high])
            runs[-1] += [sample] if runs[-1][-1] is not sample else []
        return runs

    def _without_zeros(self, run: list[Sample], zero: list[Interval], roots: list[Root]) -> list[Sample]:
        """Return the samples that are not zero; record intervals of three and more zeros, and roots at the ends."""
        result, start = list[Sample](), 0
        while start < len(run):
            end = start
            while end < len(run) and abs(run[end].value) <= self._zero:
                end += 1
            if end == start:
                result.append(run[start])
            elif end - start > 2:
                zero.append(Interval(run[start].at, run[end - 1].at))
            else:
                result += self._side_samples(run, start, end, roots)
            start = max(end, start + 1)
        return result

    def _side_samples(self, run: list[Sample], start: int, end: int, roots: list[Root]) -> list[Sample]:
        """Return samples on both sides of one or two zero samples; at an end, or if all are zero, add a root."""
        sides = [(start, start - 1), (end - 1, end)]
        if start > 0 and end < len(run):
            neighbours = [self._sample(run[i].at + _OFFSET * (run[j].at - run[i].at)) for i, j in sides]
            if all(not sample.reason and abs(sample.value) > self._zero for sample in neighbours):
                return neighbours
        before, after = (run[j].value if 0 <= j < len(run) else 0.0 for _, j in sides)
        best = min(run[start:end], key=lambda sample: abs(sample.value))
        kind: Kind = "touching" if before * after > 0 else "rising" if after > before else "falling"
        roots.append(Root(best.at, best.value, kind))
        return []

    def _cross(self, low: Sample, high: Sample, roots: list[Root], jumps: list[Jump]) -> None:
        """Find the zero between two samples of different sign by Chandrupatla's method, or the jump."""
        step = high.at - low.at
        kind: Kind = "rising" if high.value > low.value else "falling"
        a, b, part = low, high, 0.5
        for _ in range(_MAX_ITERATIONS):
            middle = self._sample(a.at + part * (b.at - a.at))
            if middle.reason:
                return
            c = a if math.copysign(1, middle.value) == math.copysign(1, a.value) else b
            b, a = (b if c is a else a), middle
            best = min(a, b, key=lambda sample: abs(sample.value))
            width = abs(b.at - a.at)
            # tolerance relative to the position, near 0 to the step
            least = max(_CONVERGED * abs(best.at), np.finfo(float).eps * step)
            if best.value == 0.0 or width <= 2 * least:
                break
            across = (a.at - b.at) / (c.at - b.at)
            along = (a.value - b.value) / (c.value - b.value)
            part = 0.5
            if along**2 < across and (1 - along) ** 2 < 1 - across:
                part = a.value / (b.value - a.value) * c.value / (b.value - c.value)
                part += (
                    (c.at - a.at) / (b.at - a.at)
                    * a.value / (c.value - a.value) * b.value / (c.value - b.value)
                )  # fmt: skip
            part = min(1 - least / width, max(least / width, part))
        a, b = sorted((a, b))
        if best.value and self._is_jump(a, b, low, high):
            jumps.append(Jump(best.at, a.value, b.value))
        else:
            roots.append(Root(best.at, best.value, kind))

    def _is_jump(self, left: Sample, right: Sample, low: Sample, high: Sample) -> bool:
        """Return whether the change of sign stays as large on a much narrower interval."""
        gap, offset = abs(right.value - left.value), _ACROSS * (high.at - low.at)
        if gap <= _MIN_JUMP * self._size:
            return False
        before, after = self._sample(max(low.at, left.at - offset)), self._sample(min(high.at, right.at + offset))
        return bool(before.reason or after.reason) or gap > _JUMP_SHARE * abs(after.value - before.value)

    def _touches(
        self, run: list[Sample], zero: list[Interval], roots: list[Root], jumps: list[Jump], near: list[Sample]
    ) -> None:
        """Find zeros between samples of one sign, and collect the samples closest to zero."""
        sizes = [abs(sample.value) for sample in run]
        least = min(sizes, default=0.0)
        for index in range(1, len(run) - 1):
            before, middle, after = run[index - 1 : index + 2]
            size, same_sign = sizes[index], before.value * middle.value > 0 and middle.value * after.value > 0
            if not same_sign or size > min(sizes[index - 1], sizes[index + 1]) or _passes(before, after, zero, roots):
                continue
            rise = max(abs(a - b) for a, b in itertools.pairwise(sizes[max(index - 2, 0) : index + 3]))
            if size > _REACH * rise and size > least:
                continue
            low, best, high = self._least(before, middle, after)
            if best.value * middle.value < 0 and abs(best.value) > self._zero:
                self._cross(low, best, roots, jumps)
                self._cross(best, high, roots, jumps)
                continue
            near.append(best)
            if abs(best.value) <= self._zero:
                roots.append(Root(self._smooth_least(run, best, after.at - before.at), best.value, "touching"))

    def _least(self, low: Sample, best: Sample, high: Sample) -> tuple[Sample, Sample, Sample]:
        """Minimise the absolute value between samples of one sign, or stop at a value of the other sign.

        A value that is zero to rounding has either sign.
        """
        sign = math.copysign(1.0, best.value)
        for _ in range(_MAX_ITERATIONS):
            top = max(abs(low.value), abs(high.value))
            settled = max(_ROUNDING * self._size, (1 + _NARROW) * abs(best.value))
            if high.at - low.at <= _CONVERGED * max(abs(best.at), _CONVERGED * self._width) or top <= settled:
                break
            # minimum of the parabola through the three samples, or golden section of the longer side
            left, right = best.at - low.at, high.at - best.at
            down, up = sign * (best.value - low.value) * right, sign * (best.value - high.value) * left
            wide = left if left > right else -right
            place = best.at - _GOLDEN * wide
            if down + up < 0 and min(left, right) > _GOLDEN**3 * max(left, right):
                place = best.at + (right * down - left * up) / (2 * (down + up))
            if not low.at < place < high.at or place == best.at:
                place = best.at - _GOLDEN * wide
            tried = self._sample(place)
            if tried.reason:
                break
            if sign * tried.value < -self._zero:
                return (low, tried, best) if place < best.at else (best, tried, high)
            if sign * tried.value < sign * best.value:
                low, best, high = (low, tried, best) if place < best.at else (best, tried, high)
            else:
                low, high = (tried, high) if place < best.at else (low, tried)
        return low, best, high

    def _smooth_least(self, run: Sequence[Sample], best: Sample, width: float) -> float:
        """Return the minimum of a smooth function, more exactly than its values near the minimum allow.

        It is a zero of the derivative of a polynomial, the most exact of those fitted to ever wider intervals: on
        narrow ones values differ by rounding only, on wide ones no polynomial follows the function.
        """
        ends, half = min(best.at - run[0].at, run[-1].at - best.at), max(width / 4, self._width / _FINEST)
        least, place = math.inf, best.at
        while half <= ends:
            estimate = self._least_of_polynomial(best.at, half)
            if estimate is None or estimate[0] > _WORSE * least:
                break
            least, place = min((least, place), estimate)
            half *= 2
        return place

    def _least_of_polynomial(self, middle: float, half: float) -> tuple[float, float] | None:
        """Return the uncertainty of the minimum of a fitted polynomial and its position; None if none fits."""
        nodes = middle + half * np.cos(np.pi * (np.arange(_NODES) + 0.5) / _NODES)
        samples = [self._sample(node) for node in nodes.tolist()]
        if any(sample.reason for sample in samples):
            return None
        values = [sample.value for sample in samples]
        fit = Chebyshev.fit(nodes, values, _NODES - 1, domain=[middle - half, middle + half])
        left = float(np.abs(fit.coef[-3:]).max())
        if left > _SMOOTH * np.abs(fit.coef).max():
            return None
        left = max(left, _ROUNDING * self._size)
        roots = fit.deriv().roots()
        inside = roots.real[(np.abs(roots.imag) < half * _NARROW) & (np.abs(roots.real - middle) < half)]
        place = float(min(inside, key=lambda root: abs(root - middle), default=math.nan))
        # second derivative by the half width
        bend = abs(float(fit.deriv(2)(place))) * half**2
        return (_SLOPE * left / bend * half, place) if bend > 0 else None


def reason_of(error: CrankworkError) -> str:
    """Return why there is no machine or value: the first of several messages."""
    reason: str = error.problems[0].message if isinstance(error, InputError) else error.args[0]
    return reason


def _passes(left: Sample, right: Sample, zero: Sequence[Interval], roots: Sequence[Root]) -> bool:
    """Return whether a zero between two samples is already recorded."""
    intervals = [(each.start, each.end) for each in zero] + [(each.at, each.at) for each in roots]
    return any(left.at < start and end < right.at for start, end in intervals)


def _distinct_roots(roots: list[Root], width: float) -> list[Root]:
    """Return roots in order, each once if it was found from both sides."""
    result: list[Root] = []
    for root in sorted(roots):
        if not result or root.at - result[-1].at > _NARROW * _EDGE * width or root.kind != result[-1].kind:
            result.append(root)
    return result
