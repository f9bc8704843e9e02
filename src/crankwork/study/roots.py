"""Where a function reaches zero: crossings, touches, jumps, and stretches where it has no value."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev

from crankwork.errors import CrankworkError, InputError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal

Kind = Literal["rising", "falling", "touching"]

# of the place itself, and of the largest value
_CONVERGED, _ZERO = 1e-13, 1e-12
# how near the ends of stretches are found, of the range
_EDGE = 1e-6
# a step that nothing makes smaller is a jump: it is looked at across this part of a step of the search
_ACROSS, _STAYS, _SEEN = 1e-8, 0.5, 1e-9
_GOLDEN = (3 - math.sqrt(5)) / 2
_NARROW = 1e-9
_ROUNDING = 4 * float(np.finfo(float).eps)
_MOST = 200
_USUAL = 1e3
# how near beside a place that is zero it is looked which way the function passes it, of a step
_BESIDE = 1e-3
# a minimum that is further above zero than its neighbours are above it, times this, does not reach zero between them
_REACH = 3.0
# places that a polynomial goes through, and what it may leave out of its largest coefficient
_NODES, _SMOOTH = 16, 1e-5
# what coefficients of rounding make of the slope of a polynomial, of the largest of them
_SLOPE = math.sqrt(_NODES**3 / 6)
# how much less exact than the best polynomial one is beyond which the others are worse still
_WORSE = 1e3
# the narrowest range that a polynomial is looked for in, of the whole
_FINEST = 1600.0


class Sample(NamedTuple):
    """A value at a place, or the reason why there is none."""

    at: float
    value: float
    reason: str = ""

    @property
    def state(self) -> str:
        """What two samples have in common if nothing ends between them: having a value, or the kind of reason."""
        return self.reason.name if isinstance(self.reason, Refusal) else self.reason


class Root(NamedTuple):
    """A place where the function is zero, and what it is there to rounding."""

    at: float
    value: float
    kind: Kind


class Jump(NamedTuple):
    """A place where the function changes its sign without being zero, and its values on both sides."""

    at: float
    before: float
    after: float


class Stretch(NamedTuple):
    """A part of the range, and why there is no value in it; without a reason the function is zero all along."""

    start: float
    end: float
    reason: str = ""


class Found(NamedTuple):
    """What was found between the first and the last of the places looked at."""

    roots: tuple[Root, ...]
    jumps: tuple[Jump, ...]
    without: tuple[Stretch, ...]
    zero: tuple[Stretch, ...]
    nearest: Sample | None
    asked: int


def find_roots(
    function: Callable[[float], float],
    places: Array,
    size: float = 0.0,
    told: Callable[[float], None] | None = None,
) -> Found:
    """Return where a function is zero, looked at in ascending places.

    `function` raises CrankworkError where it has no value; two roots, or two ends of stretches, between two of the
    places may be missed; `size`: of what is subtracted to make the function, whose rounding is that of zero; `told` is
    told the part of the places that is done.

    Examples
    --------
    >>> found = find_roots(lambda x: x * x - 2, np.linspace(0, 2, 9))
    >>> [(one.kind, round(one.at, 12)) for one in found.roots]
    [('rising', 1.414213562373)]
    """
    return _Search(function, places, size).found(told)


class _Search:
    """One search: its samples, and what a zero is beside them."""

    def __init__(self, function: Callable[[float], float], places: Array, size: float) -> None:
        self._function, self._places, self._asked = function, places, 0
        self._width = float(places[-1] - places[0])
        self._size, self._zero = size, 0.0

    def found(self, told: Callable[[float], None] | None) -> Found:
        samples = []
        for done, at in enumerate(self._places.tolist(), start=1):
            samples.append(self._sample(at))
            if told is not None:
                told(done / len(self._places))
        sizes = [abs(one.value) for one in samples if not one.reason] or [0.0]
        # what grows beyond all bounds somewhere says nothing of rounding elsewhere
        self._size = max(self._size, min(max(sizes), _USUAL * float(np.median(sizes)) or math.inf))
        self._zero = _ZERO * self._size
        runs = self._runs(samples)
        roots, jumps, zero, near = list[Root](), list[Jump](), list[Stretch](), list[Sample]()
        for run in runs:
            if run[0].reason:
                continue
            plain = self._without_zeros(run, zero, roots)
            for one, other in itertools.pairwise(plain):
                if one.value * other.value < 0 and not _passes(one, other, zero, roots):
                    self._cross(one, other, roots, jumps)
            self._touches(plain, zero, roots, jumps, near)
            near += run
        nearest = min(near, key=lambda one: abs(one.value), default=None)
        without = tuple(Stretch(run[0].at, run[-1].at, run[0].reason) for run in runs if run[0].reason)
        return Found(
            tuple(_apart(roots, self._width)), tuple(sorted(jumps)), without, tuple(zero), nearest, self._asked
        )

    def _sample(self, at: float) -> Sample:
        self._asked += 1
        try:
            value = self._function(at)
        except CrankworkError as error:
            return Sample(at, math.nan, _reason(error))
        return Sample(at, value) if math.isfinite(value) else Sample(at, math.nan, Refusal("value_none"))

    def _runs(self, samples: Sequence[Sample]) -> list[list[Sample]]:
        """Return the samples as runs of one state, each with the places where it ends."""
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

    def _without_zeros(self, run: list[Sample], zero: list[Stretch], roots: list[Root]) -> list[Sample]:
        """Return the samples that are not zero; tell stretches where three and more are, and what cannot be passed."""
        result, at = list[Sample](), 0
        while at < len(run):
            end = at
            while end < len(run) and abs(run[end].value) <= self._zero:
                end += 1
            if end == at:
                result.append(run[at])
            elif end - at > 2:
                zero.append(Stretch(run[at].at, run[end - 1].at))
            else:
                result += self._beside(run, at, end, roots)
            at = max(end, at + 1)
        return result

    def _beside(self, run: list[Sample], at: int, end: int, roots: list[Root]) -> list[Sample]:
        """Return samples on both sides of one or two that are zero; at an end, or where all is flat, that is a root."""
        ways = [(at, at - 1), (end - 1, end)]
        if at > 0 and end < len(run):
            aside = [self._sample(run[one].at + _BESIDE * (run[other].at - run[one].at)) for one, other in ways]
            if all(not one.reason and abs(one.value) > self._zero for one in aside):
                return aside
        before, after = (run[one].value if 0 <= one < len(run) else 0.0 for _, one in ways)
        best = min(run[at:end], key=lambda one: abs(one.value))
        kind: Kind = "touching" if before * after > 0 else "rising" if after > before else "falling"
        roots.append(Root(best.at, best.value, kind))
        return []

    def _cross(self, low: Sample, high: Sample, roots: list[Root], jumps: list[Jump]) -> None:
        """Find the zero between two samples of different sign, by the method of Chandrupatla, or the jump."""
        step = high.at - low.at
        kind: Kind = "rising" if high.value > low.value else "falling"
        one, other, part = low, high, 0.5
        for _ in range(_MOST):
            middle = self._sample(one.at + part * (other.at - one.at))
            if middle.reason:
                return
            third = one if math.copysign(1, middle.value) == math.copysign(1, one.value) else other
            other, one = (other if third is one else one), middle
            best = min(one, other, key=lambda each: abs(each.value))
            width = abs(other.at - one.at)
            # what stands beside zero is told from it by its distance from zero, in parts of the step
            least = max(_CONVERGED * abs(best.at), np.finfo(float).eps * step)
            if best.value == 0.0 or width <= 2 * least:
                break
            across = (one.at - other.at) / (third.at - other.at)
            along = (one.value - other.value) / (third.value - other.value)
            part = 0.5
            if along**2 < across and (1 - along) ** 2 < 1 - across:
                part = one.value / (other.value - one.value) * third.value / (other.value - third.value)
                part += (
                    (third.at - one.at) / (other.at - one.at)
                    * one.value / (third.value - one.value) * other.value / (third.value - other.value)
                )  # fmt: skip
            part = min(1 - least / width, max(least / width, part))
        one, other = sorted((one, other))
        if best.value and self._is_jump(one, other, low, high):
            jumps.append(Jump(best.at, one.value, other.value))
        else:
            roots.append(Root(best.at, best.value, kind))

    def _is_jump(self, one: Sample, other: Sample, low: Sample, high: Sample) -> bool:
        """Return whether a change of sign stays as large however near to it one looks."""
        gap, aside = abs(other.value - one.value), _ACROSS * (high.at - low.at)
        if gap <= _SEEN * self._size:
            return False
        before, after = (self._sample(at) for at in (max(low.at, one.at - aside), min(high.at, other.at + aside)))
        return bool(before.reason or after.reason) or gap > _STAYS * abs(after.value - before.value)

    def _touches(
        self, run: list[Sample], zero: list[Stretch], roots: list[Root], jumps: list[Jump], near: list[Sample]
    ) -> None:
        """Find where samples of one sign come to zero between them, and those that come nearest."""
        sizes = [abs(one.value) for one in run]
        least = min(sizes, default=0.0)
        for at in range(1, len(run) - 1):
            before, here, after = run[at - 1 : at + 2]
            alike = before.value * here.value > 0 and here.value * after.value > 0
            if not alike or sizes[at] > min(sizes[at - 1], sizes[at + 1]) or _passes(before, after, zero, roots):
                continue
            rise = max(abs(sizes[one] - sizes[one + 1]) for one in range(max(at - 2, 0), min(at + 2, len(run) - 1)))
            if sizes[at] > _REACH * rise and sizes[at] > least:
                continue
            low, best, high = self._least(before, here, after)
            if best.value * here.value < 0 and abs(best.value) > self._zero:
                self._cross(low, best, roots, jumps)
                self._cross(best, high, roots, jumps)
                continue
            near.append(best)
            if abs(best.value) <= self._zero:
                roots.append(Root(self._smooth_least(run, best, after.at - before.at), best.value, "touching"))

    def _least(self, low: Sample, best: Sample, high: Sample) -> tuple[Sample, Sample, Sample]:
        """Return where values of one sign are least, between the samples beside it, or where one has the other sign.

        What is zero to rounding has either.
        """
        sign = math.copysign(1.0, best.value)
        for _ in range(_MOST):
            top = max(abs(low.value), abs(high.value))
            settled = max(_ROUNDING * self._size, (1 + _NARROW) * abs(best.value))
            if high.at - low.at <= _CONVERGED * max(abs(best.at), _CONVERGED * self._width) or top <= settled:
                break
            # the lowest place of the parabola through the three, or else the golden section of the longer side
            left, right = best.at - low.at, high.at - best.at
            down, up = sign * (best.value - low.value) * right, sign * (best.value - high.value) * left
            wide = left if left > right else -right
            at = best.at - _GOLDEN * wide
            if down + up < 0 and min(left, right) > _GOLDEN**3 * max(left, right):
                at = best.at + (right * down - left * up) / (2 * (down + up))
            if not low.at < at < high.at or at == best.at:
                at = best.at - _GOLDEN * wide
            tried = self._sample(at)
            if tried.reason:
                break
            if sign * tried.value < -self._zero:
                return (low, tried, best) if at < best.at else (best, tried, high)
            if sign * tried.value < sign * best.value:
                low, best, high = (low, tried, best) if at < best.at else (best, tried, high)
            else:
                low, high = (tried, high) if at < best.at else (low, tried)
        return low, best, high

    def _smooth_least(self, run: Sequence[Sample], best: Sample, width: float) -> float:
        """Return where a smooth function is least near a place that its values cannot tell more exactly.

        That is where the slope of a polynomial vanishes: of the one that tells it most exactly, of those that follow
        the function ever further around the place. Near to it values differ by rounding only; far from it no polynomial
        follows them.
        """
        ends, half = min(best.at - run[0].at, run[-1].at - best.at), max(width / 4, self._width / _FINEST)
        least, found = math.inf, best.at
        while half <= ends:
            told = self._least_of_polynomial(best.at, half)
            if told is None or told[0] > _WORSE * least:
                break
            least, found = min((least, found), told)
            half *= 2
        return found

    def _least_of_polynomial(self, middle: float, half: float) -> tuple[float, float] | None:
        """Return how unsure it is where a function is least, and where; None if no polynomial follows it there."""
        nodes = middle + half * np.cos(np.pi * (np.arange(_NODES) + 0.5) / _NODES)
        values = [self._sample(one) for one in nodes.tolist()]
        if any(one.reason for one in values):
            return None
        fit = Chebyshev.fit(nodes, [one.value for one in values], _NODES - 1, domain=[middle - half, middle + half])
        left = float(np.abs(fit.coef[-3:]).max())
        if left > _SMOOTH * np.abs(fit.coef).max():
            return None
        left = max(left, _ROUNDING * self._size)
        roots = fit.deriv().roots()
        inside = roots.real[(np.abs(roots.imag) < half * _NARROW) & (np.abs(roots.real - middle) < half)]
        at = float(min(inside, key=lambda one: abs(one - middle), default=math.nan))
        # the slope of the slope, by the half width
        bend = abs(float(fit.deriv(2)(at))) * half**2
        return (_SLOPE * left / bend * half, at) if bend > 0 else None


def _reason(error: CrankworkError) -> str:
    """Return why there is no value: the first of several mistakes."""
    if isinstance(error, InputError):
        return error.problems[0].message
    told: object = error.args[0]
    return told if isinstance(told, str) else str(error)


def _passes(one: Sample, other: Sample, zero: Sequence[Stretch], roots: Sequence[Root]) -> bool:
    """Return whether between two samples there is a zero that has been told."""
    told = [(each.start, each.end) for each in zero] + [(each.at, each.at) for each in roots]
    return any(one.at < start and end < other.at for start, end in told)


def _apart(roots: list[Root], width: float) -> list[Root]:
    """Return roots in order, those once that were found from both sides."""
    result: list[Root] = []
    for root in sorted(roots):
        if not result or root.at - result[-1].at > _NARROW * _EDGE * width or root.kind != result[-1].kind:
            result.append(root)
    return result
