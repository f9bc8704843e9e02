"""The sliders of a page: the numbers of a machine file that a reader may move, and their ranges."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress

import numpy as np

from crankwork.analysis import Results, analyse
from crankwork.description.document import Description, NumericField, numeric_field
from crankwork.description.machine_file import Setting
from crankwork.description.value_types import shown
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage
from crankwork.page.sliders import Slider, SliderDesigns
from crankwork.study.parameter_map import ends_of
from crankwork.study.varied_field import stated_limit

_OPTION = "--slider"
_OPTION_FORM = re.compile(r"\s*(?P<key>[^=\s]+)\s*(?:=\s*(?P<low>[^:]+?)\s*\.\.\s*(?P<high>[^:]+?)\s*)?")
_MAX_SLIDERS = 8
# default range either way, as a fraction of the number
_AROUND = 0.5
# bisections towards the last design that can be analysed
_BISECTIONS = 12
# fraction of the range that a slider uses: near its end forces are unbounded
_RANGE_SHARE = 0.97
# fraction of their ranges at which all sliders are moved together
_JOINT_SHARE = 0.3


def moved(
    description: Description,
    options: Sequence[str],
    overrides: Sequence[str | Setting],
    stated: Results,
    around: float = _AROUND,
) -> SliderDesigns:
    """Return the sliders of options such as `crank.speed=1000..6000rpm`, with results of designs in their ranges.

    The default range is a fraction `around` of the number either way, within its limits; a range ends before designs
    that cannot be analysed.
    """
    if len(options) > _MAX_SLIDERS:
        raise CrankworkError(ErrorMessage("slider_many", most=str(_MAX_SLIDERS)))
    values = description.values_with(overrides)
    ranges = [_range(values, text, around) for text in options]
    keys = [number.key for number, *_ in ranges]
    if len(set(keys)) < len(keys):
        raise CrankworkError(ErrorMessage("slider_twice", key=next(key for key in keys if keys.count(key) > 1)))
    if "crank_range" in stated.summary:
        # limit positions move with the design
        raise CrankworkError(ErrorMessage("slider_swings"))
    machines = _Machines(description, overrides, [number for number, *_ in ranges], stated)
    now = machines.now
    sliders, rows, analysed = [], [now], [stated]
    for index, (number, low, high) in enumerate(ranges):
        ends, stop = [], None
        for end in (low, high):
            reached, results, cause = machines.reached(index, end)
            ends.append(reached)
            stop = stop or cause
            rows.append(np.where(np.arange(now.size) == index, reached, now))
            analysed.append(results)
        if not ends[0] < ends[1]:
            raise CrankworkError(ErrorMessage("slider_fixed", key=number.key)) from stop
        sliders.append(Slider(number.key, float(now[index]), ends[0], ends[1], number.unit, stop))
    together = _JOINT_SHARE
    # the ends are enough for one slider
    while len(sliders) > 1 and together > 1e-3:
        row = now + together * np.array([slider.high - slider.now or slider.low - slider.now for slider in sliders])
        try:
            results = machines.results(row)
        except CrankworkError:
            together /= 2
            continue
        return SliderDesigns(tuple(sliders), np.array([*rows, row]), (*analysed, results))
    return SliderDesigns(tuple(sliders), np.array(rows), tuple(analysed))


def ends(description: Description, key: str, low: str, high: str) -> list[float]:
    """Return the range of a number as written; empty if it is not allowed or the number is outside. [SI]"""
    with suppress(CrankworkError):
        return list(_range(description.values_with(()), f"{key}={low}..{high}", _AROUND)[1:])
    return []


def around(description: Description, key: str, stated: Results, values: Sequence[float]) -> dict[float, Results]:
    """Return the results of variants with other values of one number, by value, in the order of the values. [SI]

    Values without a machine are left out; the stated value gives the stated results.
    """
    number, *_ = _range(description.values_with(()), key, _AROUND)
    machines, by_value = _Machines(description, (), [number], stated), dict[float, Results]()
    for value in values:
        if number.low <= value <= number.high:
            with suppress(CrankworkError):
                by_value[value] = stated if value == machines.now[0] else machines.results(np.array([value]))
    return by_value


def _range(values: dict[str, object], text: str, around: float) -> tuple[NumericField, float, float]:
    """Return the number that an option names, and its range. [SI]"""
    match = _OPTION_FORM.fullmatch(text)
    if match is None:
        raise CrankworkError(ErrorMessage("slider_form", text=text[:60]))
    key = match["key"]
    number = numeric_field(values, key, _OPTION)
    if number.now is None:
        raise CrankworkError(ErrorMessage("slider_unstated", key=key))
    if match["low"] is None:
        reach = around * abs(number.now) or around * min(number.high, 1.0)
        return number, max(number.low, number.now - reach), min(number.high, number.now + reach)
    low, high = ends_of(f"{match['low']}..{match['high']}")
    option = f"{_OPTION} {key}"
    ends = [stated_limit(number, bound, option) for bound in (low, high)]
    assert ends[0] is not None and ends[1] is not None  # noqa: S101, PT018 - both are stated
    if not ends[0] < ends[1]:
        raise CrankworkError(ErrorMessage("range_empty", option=option, start=low, end=high))
    if not ends[0] <= number.now <= ends[1]:
        raise CrankworkError(ErrorMessage("slider_beside", key=key, now=shown(number.written(number.now))))
    return number, ends[0], ends[1]


class _Machines:
    """Variants of a machine file with other values of the sliders."""

    def __init__(
        self,
        description: Description,
        overrides: Sequence[str | Setting],
        numbers: Sequence[NumericField],
        stated: Results,
    ) -> None:
        self._description, self._overrides, self._numbers, self._stated = description, overrides, numbers, stated
        self.now: Array = np.array([number.now for number in numbers])

    def results(self, design: Array) -> Results:
        """Return the results of a design; raise an error if its crank no longer turns through."""
        settings = [number.setting(value, _OPTION) for number, value in zip(self._numbers, design, strict=True)]
        results = analyse(self._description.machine([*self._overrides, *settings]))
        if "crank_range" in results.summary and "crank_range" not in self._stated.summary:
            raise CrankworkError(ErrorMessage("slider_no_turn"))
        return results

    def reached(self, index: int, end: float) -> tuple[float, Results, CrankworkError | None]:
        """Return how far one number can be moved to an end, the results there, and the error beyond."""

        def tried(share: float) -> Results:
            row = self.now.copy()
            row[index] += share * (end - row[index])
            return self.results(row)

        try:
            return end, tried(1.0), None
        except CrankworkError as error:
            cause = error
        low, high, results = 0.0, 1.0, self._stated
        for _ in range(_BISECTIONS):
            middle = (low + high) / 2
            try:
                results, low = tried(middle), middle
            except CrankworkError as error:
                cause, high = error, middle
        low *= _RANGE_SHARE
        return float(self.now[index] + low * (end - self.now[index])), tried(low) if low else results, cause
