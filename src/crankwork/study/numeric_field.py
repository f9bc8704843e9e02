"""Numbers of a machine file: their limits, stated values, the points of a search, and how a study varies a field."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork import units
from crankwork.description.document import stated_value
from crankwork.description.machine_file import Setting, entry_at, file_keys, steps_of
from crankwork.description.schema import ListOf, NameOr, NumberOr, TableSpec, nearest_name
from crankwork.description.value_types import MeasuredValue, Number, Quantity, Reader, is_fraction, shown
from crankwork.errors import CrankworkError, UnknownKeyError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage

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


class NumericField(NamedTuple):
    """A number of a machine file: key, limits in SI, unit as written, dimension and stated value in SI."""

    key: str
    low: float
    high: float
    unit: str = ""
    dimension: str = ""
    now: float | None = None

    def written(self, value: float) -> str | float:
        """Return a value as the file states it."""
        number = float(units.from_si(value, self.unit))
        return f"{number!r} {self.unit}" if self.unit else number

    def setting(self, value: float, option: str = "") -> Setting:
        """Return the setting of a value in SI; `option`: what messages name, by default the key."""
        return Setting(option or self.key, self.key, self.written(float(value)))


class SearchPoints(NamedTuple):
    """Values of a number that are sampled."""

    values: Array  # Ascending values [SI]
    is_even: bool  # By equal ratios otherwise
    is_stated: bool  # From the stated number or its limits otherwise


def kind_of(values: dict[str, Any], key: str) -> Any:  # noqa: ANN401 - each kind has its own type
    """Return the value type of a key of a machine file; the error does not name the key."""
    kind: Any = file_keys(values)
    for step in steps_of(key):
        around, kind = kind, entry_at(kind, step)
        if kind is None:
            raise UnknownKeyError(_unknown(key, around, step))
    return kind


def numeric_field(values: dict[str, Any], key: str) -> NumericField:
    """Return the number of a machine file that a key names; it must be continuous."""
    try:
        kind = kind_of(values, key)
    except UnknownKeyError as error:
        mistake = error.args[0]
        message = (
            mistake if mistake.name == "key_form" else ErrorMessage("option_key_wrong", key=key[:60], mistake=mistake)
        )
        raise UnknownKeyError(message) from None
    now = stated_value(values, key)
    kind, reader = single_kind(kind, now), Reader(decimal_comma=True)
    match kind:
        case Quantity(dimensions, low, high):
            read = None if now is None else kind.read(now, key, reader)
            unit = units.EXAMPLES[dimensions[0]].split()[1]
            if not isinstance(read, MeasuredValue):
                return NumericField(key, low, high, unit, dimensions[0])
            return NumericField(key, low, high, read.unit or unit, read.dimension, read.value)
        case Number(low, high, whole=False):
            return NumericField(key, low, high, now=None if now is None else kind.read(now, key, reader))
        case Number():
            raise CrankworkError(ErrorMessage("sought_counts", key=key))
    raise CrankworkError(ErrorMessage("sought_no_number", key=key))


def single_kind(kind: Any, now: object) -> Any:  # noqa: ANN401 - each kind has its own type
    """Return the type of a number in a field that also allows something else."""
    if isinstance(kind, NameOr):
        kind = kind.other
    if isinstance(kind, ListOf) and kind.may_be_one and isinstance(now, str):
        kind = kind.entry
    if isinstance(kind, NumberOr):
        return kind.quantity if isinstance(now, str) and not is_fraction(now) else kind.number
    return kind


def _unknown(key: str, around: object, step: str | int) -> ErrorMessage:
    """Return the error of a key that no file has."""
    if isinstance(around, TableSpec) and isinstance(step, str):
        nearest = nearest_name(step, tuple(around.keys))
        message = ErrorMessage("unknown_key_near", nearest=nearest) if nearest else None
        return message or ErrorMessage("unknown_key", known=", ".join(around.keys))
    return ErrorMessage("key_form", key=key[:60])


def search_points(field: NumericField, start: str | float | None, end: str | float | None, steps: int) -> SearchPoints:
    """Return the points of a search, between the stated ends or around the stated number."""
    low, high = (stated_limit(field, text, option) for text, option in ((start, "--from"), (end, "--to")))
    own = None if low is not None and high is not None else _own_range(field)
    if own is None and (low is None or high is None):
        missing = "--from" if low is None else "--to"
        raise CrankworkError(ErrorMessage("range_needed", option=missing, key=field.key))
    is_stated = own is None
    own = own or (0, 0)
    low, high = own[0] if low is None else low, own[1] if high is None else high
    if not low < high:
        ends = ((start, low), (end, high))
        written = [stated if isinstance(stated, str) else shown(field.written(value)) for stated, value in ends]
        raise CrankworkError(ErrorMessage("range_empty", start=written[0], end=written[1]))
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
        value = units.parse_in(text, field.unit) if field.unit else float(text.replace(",", "."))
    except ValueError as error:
        mistake = error.args[0] if field.unit else ErrorMessage("number_plain", value=shown(text), example="0.25")
        raise CrankworkError(ErrorMessage("option_wrong", option=option, mistake=mistake)) from None
    if not math.isfinite(value) or not field.low <= value <= field.high:
        low, high = (str(field.written(end)) for end in (field.low, field.high))
        raise CrankworkError(ErrorMessage("limit_outside", option=option, key=field.key, low=low, high=high))
    return value


def _own_range(field: NumericField) -> tuple[float, float] | None:
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
        return max(low, now / _AROUND), min(high, now * _AROUND)
    return max(low, now - _AROUND * abs(now)), min(high, now + _AROUND * abs(now))


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
