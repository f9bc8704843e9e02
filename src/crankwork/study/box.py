"""Designs between bounds: their single values, how those change, and in parts of the cycle."""

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
from crankwork.kernel.slopes import part_key
from crankwork.kernel.trace import NotCompiledError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal
from crankwork.study.machines import Machines, single, threaded
from crankwork.study.sought import Sought, limit, sought_number
from crankwork.units import System

# parts of the cycle in each of which an extreme is followed for itself
PARTS = 24
# designs that are tried where the stated one is no machine
_TRIED = 100
# other places from which the calculation is compiled, and how far around, of the bounds
_ELSEWHERE, _AROUND = 3, 0.02
# of the bounds, the step of differences where values are analysed and not compiled
_STEP = 3e-5
# beside the size of a value, what is the same
_SAME = 1e-9
# of the bounds
_ROUNDING = 1e-12


class Near(NamedTuple):
    """Single values of a design, shape (keys,), and their derivatives by the place, shape (keys, fields).

    `parts` are values and derivatives of extremes in each part of the cycle, shape (keys, parts) and
    (keys, parts, fields).
    """

    values: Array
    slopes: Array
    parts: tuple[Array, Array] | None


def _in_si(number: Sought, stated: float | str) -> float | None:
    """Return a bound in SI, as numbers are; a text without a unit is in that of the file."""
    return limit(number, stated if isinstance(stated, str) else str(number.written(float(stated))), number.key)


class Box:
    """Designs between bounds. A place is 0 at the lower bound of a field and 1 at the upper one.

    `seen` is told every design that is calculated and its values.
    """

    def __init__(  # noqa: PLR0913 - what varies from where, and what is wanted
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
        numbers = {key: sought_number(values, key) for key in (*bounds, *start)}
        self.numbers = {key: numbers[key] for key in bounds}
        self.low, self.high = (
            np.array([_in_si(numbers[key], of[end]) for key, of in bounds.items()], dtype=float) for end in (0, 1)
        )
        for key, of, low, high in zip(bounds, bounds.values(), self.low, self.high, strict=True):
            if not low < high:
                raise CrankworkError(Refusal("bounds_empty", key=key, low=str(of[0]), high=str(of[1])))
        stated = {key: _in_si(numbers[key], of) for key, of in start.items()}
        for key, low, high in zip(bounds, self.low, self.high, strict=True):
            if not low <= stated.get(key, low) <= high:
                ends = {"low": str(bounds[key][0]), "high": str(bounds[key][1])}
                raise CrankworkError(Refusal("limit_outside", option="start", key=key, **ends))
        middle = (self.low + self.high) / 2
        now = [stated.get(key, numbers[key].now) for key in bounds]
        first = np.clip(
            [half if one is None else one for one, half in zip(now, middle, strict=True)], self.low, self.high
        )
        self.keys, self._seen, self._seed = list(keys), seen, seed

        def around(design: Array, part: float = 1.0) -> Machines:
            low, high = (design + sign * part * (self.high - self.low) for sign in (-1, 1))
            spans = np.array([np.maximum(low, self.low), design, np.minimum(high, self.high)]).T
            return Machines(description, self.numbers, spans, keys, overrides)

        self._machines, self.start = self._first(around, first, is_stated=bool(start))
        self._kernel: Kernel | None = None
        self._many: Kernel | None = None
        self.reason = self._compiled(around)
        self._found: dict[bytes, Near | Array] = {}
        self.is_extreme = self._extremes()

    def _compiled(self, around: Callable[..., Machines]) -> str:
        """Compile what the values come from; return why that cannot be done.

        A calculation may go other ways far from the start, or where a number is nothing.
        """
        reason = ""
        places = [self.start, self.start, *self.drawn(_ELSEWHERE)]
        for at, place in enumerate(places):
            try:
                varied = around(self.design(place), 1.0 if at == 0 else _AROUND)
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

    def give_up(self, reason: str) -> None:
        """Go on with whole analyses."""
        self._kernel, self.reason, self.is_extreme = None, reason, {}
        self._found.clear()

    def _first(self, around: Callable[..., Machines], first: Array, *, is_stated: bool) -> tuple[Machines, Array]:
        """Return designs around the first that is a machine: the stated one, or one that is drawn."""
        told: dict[str, list[str]] = {}
        drawn = self.low + self.drawn(_TRIED) * (self.high - self.low)
        for design in [first, *drawn]:
            try:
                return around(design), (design - self.low) / (self.high - self.low)
            except UnknownKeyError as error:
                if getattr(error.args[0], "name", "") != "result_absent":
                    raise
                reason = error.args[0]
            except CrankworkError as error:
                if is_stated:
                    raise CrankworkError(Refusal("start_absent", reason=error.args[0])) from None
                reason = error.args[0]
            told.setdefault(getattr(reason, "name", ""), []).append(reason)
        most = max(told.values(), key=len)[0]
        raise CrankworkError(Refusal("bounds_absent", count=str(_TRIED + 1), reason=most))

    def _extremes(self) -> dict[str, str]:
        """Return which values are the largest, or the least, of those in the parts of the cycle."""
        if self._kernel is None:
            return {}
        near = self.near(self.start)
        found = {}
        for row, key in enumerate(self.keys):
            if near is None or near.parts is None or np.isnan(near.parts[0][row]).any():
                continue
            size = _SAME * abs(near.values[row])
            for kind, best in (("max", near.parts[0][row].max()), ("min", near.parts[0][row].min())):
                if abs(best - near.values[row]) <= size:
                    found[key] = kind
        return found

    @property
    def units(self) -> System:
        """The system of units that the machine is shown in."""
        return self._machines.stated.machine.units

    def drawn(self, count: int) -> Array:
        """Return places that fill the bounds evenly, shape (count, fields)."""
        from scipy.stats import qmc  # noqa: PLC0415 - an optional part

        return np.asarray(qmc.LatinHypercube(self.low.size, rng=np.random.default_rng(self._seed)).random(count))

    def design(self, place: Array) -> Array:
        """Return what a design states. [SI]"""
        inside = self.low + np.clip(place, 0.0, 1.0) * (self.high - self.low)
        # at a bound to the last digit
        return np.where(place >= 1 - _ROUNDING, self.high, np.where(place <= _ROUNDING, self.low, inside))

    def results(self, place: Array) -> Results:
        """Return the whole analysis of a design."""
        return self._machines.results(self.design(place))

    def values(self, place: Array) -> Array:
        """Return the single values of a design; not numbers where there is no machine."""
        near = self._at(place)
        return near if isinstance(near, np.ndarray) else near.values

    def near(self, place: Array) -> Near | None:
        """Return values and derivatives at a place, or None where there is no machine."""
        near = self._at(place)
        if isinstance(near, np.ndarray) and np.isfinite(near).all():
            near = self._found[place.tobytes()] = self._by_differences(place)
        return near if isinstance(near, Near) and np.isfinite(near.values).all() else None

    def _at(self, place: Array) -> Near | Array:
        """Return what is known of a design: derivatives where they cost nothing more."""
        key = place.tobytes()
        if key not in self._found:
            found = self._found[key] = self._analysed(place) if self._kernel is None else self._near(place)
            self._seen(self.design(place), found if isinstance(found, np.ndarray) else found.values)
        return self._found[key]

    def many(self, places: Array, *, is_often: bool = False) -> Array:
        """Return the single values of designs at places of shape (fields, n), shape (keys, n); often, compiled."""
        if self._kernel is None:
            return np.array([self.values(np.ascontiguousarray(one)) for one in places.T]).T
        designs = self.low[:, None] + places * (self.high - self.low)[:, None]
        if is_often:
            self._many = self._many or self._machines.kernel()
            found = threaded(self._many, designs, os.cpu_count() or 1).values
        else:
            found = self._kernel(designs).values[: len(self.keys)]
        for design, values in zip(designs.T, found.T, strict=True):
            self._seen(design, values)
        return found

    def _near(self, place: Array) -> Near:
        """Return what the kernel says of a place."""
        kernel: Kernel = self._kernel  # type: ignore[assignment]
        values, slopes = kernel.slopes(self.design(place))
        slopes = np.nan_to_num(slopes * (self.high - self.low))
        count, shape = len(self.keys), (len(self.keys), PARTS)
        parts = np.full(shape, np.nan), np.zeros((*shape, place.size))
        row_of = {key: row for row, key in enumerate(kernel.keys)}
        for row, key in enumerate(self.keys):
            if part_key(key, 0) in row_of:
                of = slice(row_of[part_key(key, 0)], row_of[part_key(key, 0)] + PARTS)
                parts[0][row], parts[1][row] = values[of], slopes[of]
        return Near(values[:count], slopes[:count], parts)

    def _analysed(self, place: Array) -> Array:
        try:
            results = self.results(place)
        except CrankworkError:
            return np.full(len(self.keys), np.nan)
        return np.array([single(results, key) for key in self.keys])

    def _by_differences(self, place: Array) -> Near:
        """Return derivatives by differences of analyses, which stay between the bounds."""
        slopes = np.empty((len(self.keys), self.low.size))
        middle = self.values(place)
        for at in range(self.low.size):
            # away from a bound that is near
            step = np.zeros(self.low.size)
            step[at] = _STEP
            if _STEP <= place[at] <= 1 - _STEP:
                low, high = (self._analysed(place + sign * step) for sign in (-1, 1))
                slopes[:, at] = (high - low) / (2 * _STEP)
            else:
                sign = 1 if place[at] < 0.5 else -1
                one, two = (self._analysed(place + sign * many * step) for many in (1, 2))
                slopes[:, at] = sign * (4 * one - two - 3 * middle) / (2 * _STEP)
        return Near(middle, np.nan_to_num(slopes), None)
