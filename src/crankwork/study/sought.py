"""The number of a machine file that is sought: what it may be, what it is now, and where to look for it."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from crankwork import units
from crankwork.description.document import stated_value
from crankwork.description.kinds import Measure, Number, Quantity, Reader, shown
from crankwork.description.machine_file import entry_at, file_keys, steps_of
from crankwork.description.schema import ListOf, NameOr, NumberOr, Table, nearest_name
from crankwork.errors import CrankworkError, UnknownKeyError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal

# a range whose ends are further apart than this is looked at by equal ratios
_FAR = 30.0
# limits that are no further apart than this are looked at from one to the other
_WIDE = 100.0
# how far around the number of the file it is looked for where its own range is wider
_AROUND = 10.0


class Sought(NamedTuple):
    """A number of a machine file: its key, its limits in SI, the unit it is written in, and what it is now."""

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


class Places(NamedTuple):
    """Where a number is looked for."""

    at: Array  # Ascending values [SI]
    is_even: bool  # Whether they are evenly spaced; by equal ratios otherwise
    is_stated: bool  # Whether somebody has said so; by the number of the file or its limits otherwise


def kind_of(values: dict[str, Any], key: str) -> Any:  # noqa: ANN401 - each kind has its own type
    """Return the kind of what a key of a machine file means; the refusal does not name the key."""
    kind: Any = file_keys(values)
    for step in steps_of(key):
        around, kind = kind, entry_at(kind, step)
        if kind is None:
            raise UnknownKeyError(_unknown(key, around, step))
    return kind


def sought_number(values: dict[str, Any], key: str) -> Sought:
    """Return the number of a machine file that a key means; it must be one that could be between two others."""
    try:
        kind = kind_of(values, key)
    except UnknownKeyError as error:
        mistake = error.args[0]
        told = mistake if mistake.name == "key_form" else Refusal("option_key_wrong", key=key[:60], mistake=mistake)
        raise UnknownKeyError(told) from None
    now = stated_value(values, key)
    kind = single_kind(kind, now)
    match kind:
        case Quantity(dimensions, low, high):
            read = None if now is None else kind.read(now, key, Reader(decimal_comma=True))
            unit = units.EXAMPLES[dimensions[0]].split()[1]
            if not isinstance(read, Measure):
                return Sought(key, low, high, unit, dimensions[0])
            return Sought(key, low, high, read.unit or unit, read.dimension, read.value)
        case Number(low, high, whole=False):
            return Sought(key, low, high, now=None if now is None else kind.read(now, key, Reader(decimal_comma=True)))
        case Number():
            raise CrankworkError(Refusal("sought_counts", key=key))
    raise CrankworkError(Refusal("sought_no_number", key=key))


def single_kind(kind: Any, now: object) -> Any:  # noqa: ANN401 - each kind has its own type
    """Return the kind of numbers that a field holds where it may hold something else too."""
    if isinstance(kind, NameOr):
        kind = kind.other
    if isinstance(kind, ListOf) and kind.may_be_one and isinstance(now, str):
        kind = kind.entry
    if isinstance(kind, NumberOr):
        return kind.quantity if isinstance(now, str) else kind.number
    return kind


def _unknown(key: str, around: object, step: str | int) -> Refusal:
    """Return the refusal of a key that no file has."""
    if isinstance(around, Table) and isinstance(step, str):
        nearest = nearest_name(step, tuple(around.keys))
        told = Refusal("unknown_key_near", nearest=nearest) if nearest else None
        return told or Refusal("unknown_key", known=", ".join(around.keys))
    return Refusal("key_form", key=key[:60])


def places(sought: Sought, start: str | float | None, end: str | float | None, steps: int) -> Places:
    """Return where a number is looked for: from and to what is stated, or else around what it is now."""
    low, high = (limit(sought, one, told) for one, told in ((start, "--from"), (end, "--to")))
    own = None if low is not None and high is not None else _own_range(sought)
    if own is None and (low is None or high is None):
        missing = "--from" if low is None else "--to"
        raise CrankworkError(Refusal("range_needed", option=missing, key=sought.key))
    is_stated = own is None
    low, high = (given if given is not None else found for given, found in zip((low, high), own or (0, 0), strict=True))
    if not low < high:
        ends = ((start, low), (end, high))
        written = [stated if isinstance(stated, str) else shown(sought.written(one)) for stated, one in ends]
        raise CrankworkError(Refusal("range_empty", start=written[0], end=written[1]))
    is_even = not 0 < low * _FAR <= high
    at = np.linspace(low, high, steps + 1) if is_even else np.geomspace(low, high, steps + 1)
    at[0], at[-1] = low, high
    return Places(at, is_even, is_stated)


def limit(sought: Sought, written: str | float | None, option: str) -> float | None:
    """Return an end of the range in SI; a number without a unit is in that of the file."""
    if written is None:
        return None
    text = str(written).strip()
    try:
        value = units.parse_in(text, sought.unit) if sought.unit else float(text.replace(",", "."))
    except ValueError as error:
        mistake = error.args[0] if sought.unit else Refusal("number_plain", value=shown(text), example="0.25")
        raise CrankworkError(Refusal("option_wrong", option=option, mistake=mistake)) from None
    if not math.isfinite(value) or not sought.low <= value <= sought.high:
        low, high = (str(sought.written(one)) for one in (sought.low, sought.high))
        raise CrankworkError(Refusal("limit_outside", option=option, key=sought.key, low=low, high=high))
    return value


def _own_range(sought: Sought) -> tuple[float, float] | None:
    """Return the limits of a number where they are near, and else those around what it is now."""
    low, high, now = sought.low, sought.high, sought.now
    if sought.dimension == "angle" and low < 0:
        middle = now or 0.0
        return max(low, middle - math.pi), min(high, middle + math.pi)
    if sought.dimension == "angle" or (not sought.unit and high - low <= _WIDE) or 0 < high <= _WIDE * low:
        return low, high
    if not now:
        return None
    if low >= 0:
        return max(low, now / _AROUND), min(high, now * _AROUND)
    return max(low, now - _AROUND * abs(now)), min(high, now + _AROUND * abs(now))
