"""Designs between bounds: their single values with derivatives, extremes also for each part of the cycle."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Results
from crankwork.description.document import Description
from crankwork.description.machine_file import Setting
from crankwork.errors import CrankworkError, UnknownKeyError
from crankwork.kernel.compiled import Kernel
from crankwork.kernel.gradient import part_key
from crankwork.kernel.lowering import NotCompiledError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage
from crankwork.study.numeric_field import NumericField, limit, numeric_field
from crankwork.study.variants import MachineVariants, single, threaded
from crankwork.units import System

# parts of the cycle, each with its own extremes
PARTS = 24
# designs drawn if the stated design cannot be analysed
_MAX_TRIES = 100
# further points to compile the calculation at, and the half width of the range there, as a fraction of the bounds
_FURTHER_POINTS, _AROUND = 3, 0.02
# step of finite differences without a compiled calculation, as a fraction of the bounds
_STEP = 3e-5
# relative difference of equal values
_SAME = 1e-9
# rounding of a point at a bound
_ROUNDING = 1e-12


class LocalModel(NamedTuple):
    """Single values of a design, shape (keys,), and their derivatives by the point, shape (keys, fields).

    `parts`: values and derivatives of the extremes in each part of the cycle, shape (keys, parts) and (keys, parts,
    fields).
    """

    values: Array
    slopes: Array
    parts: tuple[Array, Array] | None


def _in_si(number: NumericField, stated: float | str) -> float | None:
    """Return a bound in SI; text without a unit is in the unit of the file."""
    return limit(number, stated if isinstance(stated, str) else str(number.written(float(stated))), number.key)


class DesignSpace:
    """Designs between bounds. A point is 0 at the lower bound of a field and 1 at the upper bound.

    `seen` is called with every design that is calculated and its values.
    """

    def __init__(  # noqa: PLR0913 - fields, bounds and results
        self,
        description: Description,
        bounds: Mapping[str, tuple[float | str, float | str]],
        keys: Sequence[str],
        *,
        start: Mapping[str, float | str],
        overrides: Sequence[str | Setting],
        seed: int,
        seen: Callable[[Array, Array], None],
    ) -> None:
        values = description.values_with(overrides)
        numbers = {key: numeric_field(values, key) for key in (*bounds, *start)}
        self.numbers = {key: numbers[key] for key in bounds}
        self.low, self.high = (
            np.array([_in_si(numbers[key], pair[end]) for key, pair in bounds.items()], dtype=float) for end in (0, 1)
        )
        for key, bound, low, high in zip(bounds, bounds.values(), self.low, self.high, strict=True):
            if not low < high:
                raise CrankworkError(ErrorMessage("bounds_empty", key=key, low=str(bound[0]), high=str(bound[1])))
        stated = {key: _in_si(numbers[key], value) for key, value in start.items()}
        for key, low, high in zip(bounds, self.low, self.high, strict=True):
            if not low <= stated.get(key, low) <= high:
                ends = {"low": str(bounds[key][0]), "high": str(bounds[key][1])}
                raise CrankworkError(ErrorMessage("limit_outside", option="start", key=key, **ends))
        middle = (self.low + self.high) / 2
        now = [stated.get(key, numbers[key].now) for key in bounds]
        first = np.clip(
            [half if value is None else value for value, half in zip(now, middle, strict=True)], self.low, self.high
        )
        self.keys, self._seen, self._seed = list(keys), seen, seed

        def around(design: Array, part: float = 1.0) -> MachineVariants:
            low, high = (design + sign * part * (self.high - self.low) for sign in (-1, 1))
            spans = np.array([np.maximum(low, self.low), design, np.minimum(high, self.high)]).T
            return MachineVariants(description, self.numbers, spans, keys, overrides)

        self._machines, self.start = self._first(around, first, is_stated=bool(start))
        self._kernel: Kernel | None = None
        self._many: Kernel | None = None
        self.reason = self._compiled(around)
        self._found: dict[bytes, LocalModel | Array] = {}
        self.is_extreme = self._extremes()

    def _compiled(self, around: Callable[..., MachineVariants]) -> str:
        """Compile the calculation; return the reason if that fails.

        The calculation may take other branches far from the start, or if a number is zero; then a narrower range is
        tried.
        """
        reason = ""
        places = [self.start, self.start, *self.sample(_FURTHER_POINTS)]
        for attempt, place in enumerate(places):
            try:
                varied = around(self.design(place), 1.0 if attempt == 0 else _AROUND)
                kernel = varied.kernel(parts=PARTS, is_for_few=True)
                varied.check_at(kernel, self.design(self.start))
            except NotCompiledError as error:
                reason = reason or error.reason
                if reason not in ("absent", "ways"):
                    break
            except CrankworkError:
                continue
            else:
                self._machines, self._kernel = varied, kernel
                return ""
        return reason

    def use_full_analyses(self, reason: str) -> None:
        """Discard the compiled calculation and analyse each design."""
        self._kernel, self.reason, self.is_extreme = None, reason, {}
        self._found.clear()

    def _first(
        self, around: Callable[..., MachineVariants], first: Array, *, is_stated: bool
    ) -> tuple[MachineVariants, Array]:
        """Return the variants around the first design that can be analysed, stated or drawn, and its point."""
        reasons: dict[str, list[str]] = {}
        drawn = self.low + self.sample(_MAX_TRIES) * (self.high - self.low)
        for design in [first, *drawn]:
            try:
                return around(design), (design - self.low) / (self.high - self.low)
            except UnknownKeyError as error:
                if getattr(error.args[0], "name", "") not in ("result_absent", "result_absent_near"):
                    raise
                reason = error.args[0]
            except CrankworkError as error:
                if is_stated:
                    raise CrankworkError(ErrorMessage("start_absent", reason=error.args[0])) from None
                reason = error.args[0]
            reasons.setdefault(getattr(reason, "name", ""), []).append(reason)
        most = max(reasons.values(), key=len)[0]
        raise CrankworkError(ErrorMessage("bounds_absent", count=str(_MAX_TRIES + 1), reason=most))

    def _extremes(self) -> dict[str, str]:
        """Return the values that are the extreme of those in the parts of the cycle, with "max" or "min"."""
        if self._kernel is None:
            return {}
        near = self.local_model(self.start)
        extremes = {}
        for row, key in enumerate(self.keys):
            if near is None or near.parts is None or np.isnan(near.parts[0][row]).any():
                continue
            size = _SAME * abs(near.values[row])
            for kind, best in (("max", near.parts[0][row].max()), ("min", near.parts[0][row].min())):
                if abs(best - near.values[row]) <= size:
                    extremes[key] = kind
        return extremes

    @property
    def units(self) -> System:
        """System of units of the machine."""
        return self._machines.stated.machine.units

    def sample(self, count: int) -> Array:
        """Return points spread evenly between the bounds, shape (count, fields)."""
        from scipy.stats import qmc  # noqa: PLC0415 - an optional part

        return np.asarray(qmc.LatinHypercube(self.low.size, rng=np.random.default_rng(self._seed)).random(count))

    def design(self, place: Array) -> Array:
        """Return the numbers of the design at a point. [SI]"""
        inside = self.low + np.clip(place, 0.0, 1.0) * (self.high - self.low)
        # exactly the bound, to the last digit
        return np.where(place >= 1 - _ROUNDING, self.high, np.where(place <= _ROUNDING, self.low, inside))

    def results(self, place: Array) -> Results:
        """Return the full analysis of the design at a point."""
        return self._machines.results(self.design(place))

    def values(self, place: Array) -> Array:
        """Return the single values of the design at a point; NaN if there is no machine."""
        near = self._at(place)
        return near if isinstance(near, np.ndarray) else near.values

    def local_model(self, place: Array) -> LocalModel | None:
        """Return values and derivatives at a point, or None if there is no machine."""
        near = self._at(place)
        if isinstance(near, np.ndarray) and np.isfinite(near).all():
            near = self._found[place.tobytes()] = self._by_differences(place)
        return near if isinstance(near, LocalModel) and np.isfinite(near.values).all() else None

    def _at(self, place: Array) -> LocalModel | Array:
        """Return the cached values at a point, with derivatives if the calculation is compiled."""
        key = place.tobytes()
        if key not in self._found:
            result = self._found[key] = self._analysed(place) if self._kernel is None else self._near(place)
            self._seen(self.design(place), result if isinstance(result, np.ndarray) else result.values)
        return self._found[key]

    def many(self, places: Array, *, is_often: bool = False) -> Array:
        """Return single values at points of shape (fields, n), shape (keys, n); `is_often`: compile for many calls."""
        if self._kernel is None:
            return np.array([self.values(np.ascontiguousarray(place)) for place in places.T]).T
        designs = self.low[:, None] + places * (self.high - self.low)[:, None]
        if is_often:
            self._many = self._many or self._machines.kernel()
            result = threaded(self._many, designs, os.cpu_count() or 1).values
        else:
            result = self._kernel(designs).values[: len(self.keys)]
        for design, values in zip(designs.T, result.T, strict=True):
            self._seen(design, values)
        return result

    def _near(self, place: Array) -> LocalModel:
        """Return values and derivatives of the compiled calculation at a point."""
        kernel: Kernel = self._kernel  # type: ignore[assignment]
        values, slopes = kernel.slopes(self.design(place))
        slopes = np.nan_to_num(slopes * (self.high - self.low))
        count, shape = len(self.keys), (len(self.keys), PARTS)
        parts = np.full(shape, np.nan), np.zeros((*shape, place.size))
        row_of = {key: row for row, key in enumerate(kernel.keys)}
        for row, key in enumerate(self.keys):
            if part_key(key, 0) in row_of:
                rows = slice(row_of[part_key(key, 0)], row_of[part_key(key, 0)] + PARTS)
                parts[0][row], parts[1][row] = values[rows], slopes[rows]
        return LocalModel(values[:count], slopes[:count], parts)

    def _analysed(self, place: Array) -> Array:
        try:
            results = self.results(place)
        except CrankworkError:
            return np.full(len(self.keys), np.nan)
        return np.array([single(results, key) for key in self.keys])

    def _by_differences(self, place: Array) -> LocalModel:
        """Return values and derivatives by differences of analyses inside the bounds."""
        slopes = np.empty((len(self.keys), self.low.size))
        middle = self.values(place)
        for index in range(self.low.size):
            # one-sided near a bound
            step = np.zeros(self.low.size)
            step[index] = _STEP
            if _STEP <= place[index] <= 1 - _STEP:
                low, high = (self._analysed(place + sign * step) for sign in (-1, 1))
                slopes[:, index] = (high - low) / (2 * _STEP)
            else:
                sign = 1 if place[index] < 0.5 else -1
                once, twice = (self._analysed(place + sign * many * step) for many in (1, 2))
                slopes[:, index] = sign * (4 * once - twice - 3 * middle) / (2 * _STEP)
        return LocalModel(middle, np.nan_to_num(slopes), None)
