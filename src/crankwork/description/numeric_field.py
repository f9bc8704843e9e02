"""One number of a machine file: its limits and its stated value, and numbers that follow others."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from crankwork import units
from crankwork.description.document import stated_value
from crankwork.description.machine_file import Setting, entry_at, file_keys, steps_of
from crankwork.description.schema import ListOf, NameOr, NumberOr, TableSpec, nearest_name
from crankwork.description.value_types import MeasuredValue, Number, Quantity, Reader, is_fraction
from crankwork.errors import CrankworkError, UnknownKeyError
from crankwork.locale import ErrorMessage

_DECIMAL = r"[0-9]+(?:[.,][0-9]+)?"
_FOLLOWING = re.compile(
    rf"(?:(?P<factor>-?{_DECIMAL})\s*[*·×]\s*)?(?P<key>[a-z][^\s*/+]*\.[^\s*/+]+)(?:\s*/\s*(?P<divisor>{_DECIMAL}))?"
)


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


def kind_of(values: dict[str, Any], key: str) -> Any:  # noqa: ANN401 - each kind has its own type
    """Return the value type of a key of a machine file; the error does not name the key."""
    kind: Any = file_keys(values)
    for step in steps_of(key):
        around, kind = kind, entry_at(kind, step)
        if kind is None:
            raise UnknownKeyError(_unknown(key, around, step))
    return kind


def numeric_field(values: dict[str, Any], key: str, option: str = "--for") -> NumericField:
    """Return the number of a machine file that a key names; it must be continuous. `option`: what messages name."""
    try:
        kind = kind_of(values, key)
    except UnknownKeyError as error:
        mistake = error.args[0]
        message = ErrorMessage("option_wrong", option=f"{option} {key[:60]}".lstrip(), mistake=mistake)
        raise UnknownKeyError(mistake if mistake.name == "key_form" else message) from None
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
    if isinstance(kind, ListOf) and kind.may_be_one and isinstance(now, str):
        kind = kind.entry
    if isinstance(kind, NumberOr):
        is_quantity = isinstance(now, list) or (isinstance(now, str) and not is_fraction(now))
        kind = kind.quantity if is_quantity else kind.number
    return kind.other if isinstance(kind, NameOr) else kind


def _unknown(key: str, around: object, step: str | int) -> ErrorMessage:
    """Return the error of a key that no file has."""
    if isinstance(around, TableSpec) and isinstance(step, str):
        nearest = nearest_name(step, tuple(around.keys))
        message = ErrorMessage("unknown_key_near", nearest=nearest) if nearest else None
        return message or ErrorMessage("unknown_key", known=", ".join(around.keys))
    return ErrorMessage("key_form", key=key[:60])


def follows_another(value: object) -> bool:
    """Return whether a setting may say that a number follows another one: `3.5 * crank.radius`."""
    return isinstance(value, str) and bool(_FOLLOWING.fullmatch(value))


def following(values: dict[str, Any], key: str, value: str) -> str | float:
    """Return what a number that follows another one amounts to; a text that names no number of the file as it is."""
    match: Any = _FOLLOWING.fullmatch(value)
    try:
        field = numeric_field(values, key)
        other = numeric_field(values, match["key"], f"{key} = {value[:60]}:")
    except CrankworkError:
        if match["key"] == value:
            # a name, such as that of a file
            return value
        raise
    if other.now is None:
        raise CrankworkError(ErrorMessage("following_nothing", key=key, other=other.key))
    if field.dimension != other.dimension:
        raise CrankworkError(ErrorMessage("following_kind", key=key, other=other.key))
    factor = float((match["factor"] or "1").replace(",", ".")) / float((match["divisor"] or "1").replace(",", "."))
    return field.written(factor * other.now)
