"""How a study varies a number of a machine file, and the points of a search for one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork import units
from crankwork.description.document import NumericField
from crankwork.description.machine_file import Setting
from crankwork.description.value_types import shown
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage
from crankwork.report.display import key_unit

# ratio of the ends from which points are spaced by equal ratios
_FAR = 30.0
# ratio of the limits up to which the range is all between them
_WIDE = 100.0
# factor of the stated number that bounds the range if the limits are wider
_AROUND = 10.0
Law = Literal["list", "even", "ratios", "uniform", "normal", "words"]
# range of a normal distribution that a calculation is compiled for, in deviations
_WITHIN = 5.0
# least probability of a quantile
_MIN_PROBABILITY = 2.0**-40


class SearchPoints(NamedTuple):
    """Values of a number that are sampled."""

    values: Array  # Ascending values [SI]
    is_even: bool  # By equal ratios otherwise
    is_stated: bool  # From the stated number or its limits otherwise


def search_points(
    field: NumericField, start: str | float | None, end: str | float | None, steps: int, around: float = _AROUND,
    options: tuple[str, str] = ("--from", "--to"),
) -> SearchPoints:  # fmt: skip
    """Return the points of a search, between the stated ends or `around` the stated number, by this factor.

    `options`: what messages name for the ends.
    """
    low, high = (stated_limit(field, text, option) for text, option in zip((start, end), options, strict=True))
    own = None if low is not None and high is not None else _own_range(field, around)
    if own is None and (low is None or high is None):
        raise CrankworkError(ErrorMessage("range_needed", option=options[low is not None], key=field.key))
    is_stated = own is None
    own = own or (0, 0)
    low, high = own[0] if low is None else low, own[1] if high is None else high
    if not low < high:
        ends = ((start, low), (end, high))
        written = [stated if isinstance(stated, str) else shown(field.written(value)) for stated, value in ends]
        raise CrankworkError(ErrorMessage("range_empty", option=options[0], start=written[0], end=written[1]))
    is_even = not 0 < low * _FAR <= high
    values = np.linspace(low, high, steps + 1) if is_even else np.geomspace(low, high, steps + 1)
    values[0], values[-1] = low, high
    return SearchPoints(values, is_even, is_stated)


def stated_limit(field: NumericField, written: str | float | None, option: str) -> float | None:
    """Return an end of the range in SI; a number without a unit is in the unit of the file."""
    if written is None:
        return None
    text = str(written).strip()
    try:
        mistake = ErrorMessage("number_plain", value=shown(text), example="0.25")
        value = _parsed(text, field.unit, mistake, field.dimension)
    except ValueError as error:
        raise CrankworkError(ErrorMessage("option_wrong", option=option, mistake=error.args[0])) from None
    if not math.isfinite(value) or not field.low <= value <= field.high:
        low, high = (str(field.written(end)) for end in (field.low, field.high))
        raise CrankworkError(ErrorMessage("limit_outside", option=option, key=field.key, low=low, high=high))
    return value


def level(key: str, text: str) -> float:
    """Return a target in SI; a bare number is in the unit of the tables."""
    try:
        return level_of(key, text)
    except ValueError as error:
        option = f"{key} = {text[:40]}"
        raise CrankworkError(ErrorMessage("option_wrong", option=option, mistake=error.args[0])) from None


def level_of(key: str, text: str) -> float:
    """Return a level of a value in SI; ValueError with the mistake if the text is none."""
    mistake = ErrorMessage("level_plain", text=text[:40])
    value = _parsed(text, key_unit(key), mistake)
    if not math.isfinite(value):
        raise ValueError(mistake)
    return value


def _parsed(text: str, unit: str, mistake: ErrorMessage, dimension: str = "") -> float:
    """Return a number in SI; ValueError with the mistake, which is told of a number without a unit."""
    try:
        return units.parse_in(text, unit, dimension) if unit else float(text.replace(",", "."))
    except ValueError as error:
        raise ValueError(error.args[0] if unit else mistake) from None


def _own_range(field: NumericField, around: float) -> tuple[float, float] | None:
    """Return the limits of a number if they are close together, or a range around the stated number."""
    low, high, now = field.low, field.high, field.now
    if field.dimension == "angle" and low < 0:
        middle = now or 0.0
        return max(low, middle - math.pi), min(high, middle + math.pi)
    if field.dimension == "angle" or (not field.unit and high - low <= _WIDE) or 0 < high <= _WIDE * low:
        return low, high
    if not now:
        return None
    if low >= 0:
        return max(low, now / around), min(high, now * around)
    return max(low, now - around * abs(now)), min(high, now + around * abs(now))


@dataclass(frozen=True)
class VariedField:
    """A field that designs differ in. Designs hold it in SI; names and integers by their index in the list.

    `ends`: of a range or a uniform distribution; for a normal one mean and standard deviation.
    """

    key: str
    law: Law
    number: NumericField | None = None
    ends: tuple[float, float] = (0.0, 0.0)
    values: tuple[Any, ...] = ()
    steps: int = 0

    @property
    def unit(self) -> str:
        """Unit in the file."""
        return self.number.unit if self.number else ""

    @property
    def count(self) -> int:
        """Number of values of a grid, 0 for any number."""
        return len(self.values) or (self.steps + 1 if self.steps else 0)

    def of_places(self, places: NDArray[Any]) -> Array:
        """Return the values at indices of a list or a range, counted from 0."""
        if self.law == "words":
            return np.asarray(places, dtype=float)
        if self.values:
            return np.asarray(np.array(self.values, dtype=float)[places])
        return self.of_shares(places / self.steps)

    def of_shares(self, shares: Array) -> Array:
        """Return the quantiles of the distribution at probabilities."""
        low, high = self.ends
        if self.values:
            return self.of_places(np.minimum(shares * len(self.values), len(self.values) - 1).astype(np.intp))
        if self.law == "ratios":
            return np.where(shares < 1, low * (high / low) ** shares, high)
        if self.law == "normal":
            from scipy.special import ndtri  # noqa: PLC0415 - an optional part

            return np.asarray(low + high * ndtri(np.clip(shares, _MIN_PROBABILITY, 1 - _MIN_PROBABILITY)))
        return np.asarray(low * (1 - shares) + high * shares)

    @property
    def span(self) -> tuple[float, float, float]:
        """Least, intermediate and largest value of designs. [SI]"""
        low, high = (min(self.values), max(self.values)) if self.values and self.number else self.ends
        if self.law == "normal" and self.number is not None:
            low, high = (low - _WITHIN * high, low + _WITHIN * high)
            low, high = max(low, self.number.low), min(high, self.number.high)
        return low, (low * high) ** 0.5 if self.law == "ratios" else (low + high) / 2, high

    def setting(self, value: float) -> Setting:
        """Return the setting of a design."""
        return self.number.setting(value) if self.number else Setting(self.key, self.key, self.values[int(value)])
