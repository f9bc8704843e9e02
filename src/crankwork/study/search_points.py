"""The points of a search for a number of a machine file."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from crankwork import units
from crankwork.description.numeric_field import NumericField
from crankwork.description.value_types import shown
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage

# ratio of the ends from which points are spaced by equal ratios
_FAR = 30.0
# ratio of the limits up to which the range is all between them
_WIDE = 100.0
# factor of the stated number that bounds the range if the limits are wider
_AROUND = 10.0


class SearchPoints(NamedTuple):
    """Values of a number that are sampled."""

    values: Array  # Ascending values [SI]
    is_even: bool  # By equal ratios otherwise
    is_stated: bool  # From the stated number or its limits otherwise


def search_points(field: NumericField, start: str | float | None, end: str | float | None, steps: int) -> SearchPoints:
    """Return the points of a search, between the stated ends or around the stated number."""
    low, high = (limit(field, text, option) for text, option in ((start, "--from"), (end, "--to")))
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


def limit(field: NumericField, written: str | float | None, option: str) -> float | None:
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
