"""Kinds of single values in a machine file, which read, complain and describe themselves, and their reader."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Mapping
from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from pathlib import Path
from typing import Any, NamedTuple, Protocol, Self

from crankwork import units
from crankwork.errors import Problem
from crankwork.locale import ErrorMessage, Language, translate

_MAX_PROBLEMS = 50
# text of a value with a tolerance or a standard deviation, the unit after either number
_LONG = 100
# standard deviations to a limit of a tolerance: 99.7 % of a normal distribution lie within
DEVIATIONS_OF_TOLERANCE = 3.0
_DEVIATION = re.compile(
    r"\s*([+-]?[0-9][0-9.,]*(?:[eE][+-]?[0-9]+)?)\s*((?:[^\s±+\d]|(?<=\s)1/)[^±+]*)?(±|\+-|\+/-|(?i:\bsd\b)|σ)"
    r"\s*([0-9][0-9.,]*(?:[eE][+-]?[0-9]+)?)\s*(\S.*)?"
)
# limits on two sides, `45 +0.1/-0.2 mm`, `45^{+0.1}_{-0.2} mm`, `45 mm -0.02 -0.05`
_SIDES = re.compile(
    r"\s*([+-]?\d+[.,]?\d*)\s*([^\W\d_]\S*)?\s*\^?\{?([+−-]\s?\d+[.,]?\d*)\}?\s*([^\W\d_]\S*?)?"
    r"(?:\s*[/_;]\s*|\s+)\{?([+−-]?\s?\d+[.,]?\d*)\}?\s*([^\W\d_]\S*)?\s*"
)
_PLAIN_SIGNS = str.maketrans(",−", ".-")
# smaller numbers become 0, so that nothing is divided by them
_SMALLEST = 1e-30
_FRACTION = re.compile(r"\s*([+-]?\d+(?:\.\d+)?)\s*/\s*(\d+(?:\.\d+)?)\s*")


def _in_range(limit: float, rounding: str) -> str:
    """Return a limit in six digits, rounded so that it may be written."""
    near = f"{limit:.6g}"
    if math.isclose(float(near), limit, rel_tol=1e-9):
        return near
    return f"{float(Context(prec=6, rounding=rounding).create_decimal(limit)):.6g}"


class Deviation(NamedTuple):
    """Text of a tolerance or a standard deviation: absolute, in percent, or with a unit of its own."""

    size: str
    is_tolerance: bool


def split_deviation(text: str) -> tuple[str, Deviation | None]:
    """Return a stated value and its tolerance, `±`, or standard deviation, `sd`.

    Examples
    --------
    >>> texts = ("75 ± 0.1 mm", "0.25 sd 2 %", "75 mm +- 1%", "2 kg σ 5 g")
    >>> [(value, *deviation) for value, deviation in map(split_deviation, texts)]
    [('75 mm', '0.1', True), ('0.25', '2%', False), ('75 mm', '1%', True), ('2 kg', '5 g', False)]
    >>> split_deviation("75 mm")
    ('75 mm', None)
    """
    match = _DEVIATION.fullmatch(text) if len(text) < _LONG else None
    if match is None:
        return text, None
    value, first, mark, size, last = (part.strip() for part in match.groups(""))
    is_tolerance = mark[0] in "±+"
    if last == "%":
        return f"{value} {first}".strip(), Deviation(f"{size}%", is_tolerance)
    return f"{value} {first or last}".strip(), Deviation(f"{size} {last}" if first and last else size, is_tolerance)


def _by_sides(text: str, message: ErrorMessage) -> ErrorMessage:
    """Return how to write a value with two limits of its own, `45 +0.1/-0.2 mm`; the message if it has none."""
    match = _SIDES.fullmatch(text) if len(text) < _LONG else None
    if match is None:
        return message
    value, upper, other = (float(re.sub(r"\s", "", part.translate(_PLAIN_SIGNS))) for part in match.group(1, 3, 5))
    units_named = {f" {unit}" for unit in match.group(2, 4, 6) if unit}
    written = f"{value + (upper + other) / 2:.12g} ± {abs(upper - other) / 2:.12g}{''.join(units_named)}"
    return ErrorMessage("tolerance_sides", text=text, written=written) if len(units_named) < 2 else message


class MeasuredValue(NamedTuple):
    """A quantity as read: SI value, dimension, and the unit in which it is written."""

    value: float
    dimension: str
    unit: str = ""


class Reader:
    """Collects the problems of one description while its values are read.

    `problems` holds the first of them; `more` counts the others; `folder`: where files named in it are looked for.
    """

    def __init__(
        self,
        *,
        decimal_comma: bool = False,
        metric_hp: bool = False,
        gravity: float = units.KGF,
        folder: Path | None = None,
    ) -> None:
        self.problems: list[Problem] = []
        self.notices: list[tuple[str, dict[str, float | str]]] = []
        # standard deviations of values, and the tolerances from which they follow, by key [SI]
        self.deviations: dict[str, float] = {}
        self.tolerances: dict[str, float] = {}
        self.tables: Mapping[str, Any] = {}  # What the tables of the file may have, by name
        self.more = 0
        self.decimal_comma, self.metric_hp, self.gravity = decimal_comma, metric_hp, gravity
        self.folder = folder or Path()
        # for a reader of another form of the same file
        self.options: dict[str, Any] = {
            "decimal_comma": decimal_comma,
            "metric_hp": metric_hp,
            "gravity": gravity,
            "folder": folder,
        }
        self._blamed: set[str] = set()
        self._suspects: set[str] = set()

    @classmethod
    def of(cls, values: Mapping[str, Any], folder: Path | None = None) -> Self:
        """Return the reader of a file, with the decimal mark, horsepower and gravity that it states."""
        comma, method = values.get("decimal_mark") == ",", values.get("method")
        gravity = method.get("gravity") if isinstance(method, dict) else None
        try:
            acceleration = units.parse(str(gravity), ("acceleration",), decimal_comma=comma).value
        except ValueError:
            acceleration = 0.0
        old = values.get("format", 1) == 1
        gravity = acceleration if acceleration > 0 else units.KGF
        return cls(decimal_comma=comma, metric_hp=old, gravity=gravity, folder=folder)

    def add_error(self, key: str, message: str, *more: str, meant: str = "") -> None:
        """Add a mistake, or all mistakes of a file; only those added first to a key are kept.

        `meant`: the correct key of a misspelt one, which is then not reported as missing.
        """
        if key in self._blamed:
            return
        self._blamed.add(key)
        self._suspects |= {key, meant or key}
        added = [Problem(key, text) for text in (message, *more)]
        space = max(_MAX_PROBLEMS - len(self.problems), 0)
        self.problems += added[:space]
        self.more += len(added[space:])

    def add_deviation(self, key: str, size: float, *, is_tolerance: bool) -> None:
        """Store the standard deviation of a value, or its tolerance and the part of it that counts as one. [SI]"""
        self.deviations[key] = size / DEVIATIONS_OF_TOLERANCE if is_tolerance else size
        if is_tolerance:
            self.tolerances[key] = size

    @property
    def is_full(self) -> bool:
        """Whether further mistakes are only counted."""
        return len(self.problems) >= _MAX_PROBLEMS

    def suspect(self, key: str) -> None:
        """Take a key for reported that follows from reported ones."""
        self._suspects.add(key)

    def has_errors(self, *keys: str) -> bool:
        """Return whether one of the keys, or a table around it, is already reported: its consequences are not."""
        around = ({key, *(key[:index] for index, mark in enumerate(key) if mark == ".")} for key in keys)
        return any(not self._suspects.isdisjoint(path) for path in around)


class ValueType(Protocol):
    """A kind of value."""

    def read(self, value: object, key: str, reader: Reader) -> Any:  # noqa: ANN401 - each kind has its own type
        """Return the value as the program uses it, or None after a complaint."""

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the JSON Schema of the value as written."""


class Quantity(NamedTuple):
    """Number and unit as text; the SI value must lie within `low` and `high`, whichever dimension it has."""

    dimensions: tuple[str, ...]
    low: float
    high: float
    above: bool = False
    negative: str = ""  # Name of the message about a value below zero

    def read(self, value: object, key: str, reader: Reader) -> MeasuredValue | None:
        """Return SI value and dimension."""
        if isinstance(value, bool) or not isinstance(value, str | int | float):
            reader.add_error(key, ErrorMessage("quantity_as_text", example=self._example()))
            return None
        if not isinstance(value, str):
            number = value if _is_moderate(value) else math.inf
            # a number of Python may be in the SI unit
            si = units.coherent_unit(units.EXAMPLES[self.dimensions[0]].split()[1])
            written = {self._written(number, shown(value)): 0} | (
                {f"{shown(value)} {si}": 0} if self._holds(number) else {}
            )
            reader.add_error(key, ErrorMessage("no_unit", value=shown(value), example=tuple(map(shown, written))))
            return None
        value, deviation = split_deviation(value)
        try:
            parsed = units.parse(
                value, self.dimensions, decimal_comma=reader.decimal_comma, metric_hp=reader.metric_hp,
                gravity=reader.gravity,
            )  # fmt: skip
        except ValueError as error:
            reader.add_error(key, _by_sides(value, self._advised(error.args[0], value, key, reader)))
            return None
        if not self._holds(parsed.value):
            advice = ErrorMessage(self.negative, value=value.strip()) if self.negative and parsed.value < 0 else None
            reader.add_error(key, advice or self._out_of_range(value.strip(), parsed.dimension))
            return None
        if deviation is not None and not self._deviates(parsed, deviation, key, reader):
            return None
        if parsed.notice:
            gravity = reader.gravity if any(letter in value for letter in "NН") else units.KGF
            values: dict[str, float | str] = {
                "path": key,
                "text": value.strip(),
                "value": parsed.value,
                "unit": parsed.unit,
                "gravity": gravity,
            }
            reader.notices.append((parsed.notice, values))
        return MeasuredValue(parsed.value if abs(parsed.value) > _SMALLEST else 0.0, parsed.dimension, parsed.unit)

    def _deviates(self, parsed: units.ParsedQuantity, deviation: Deviation, key: str, reader: Reader) -> bool:
        """Store a tolerance or standard deviation, in the unit of the value or its own; return whether it is valid."""
        stated, is_tolerance = deviation
        size, _, own = stated.partition(" ")
        try:
            unit = units.parse(stated, (parsed.dimension,), decimal_comma=reader.decimal_comma) if own else parsed
        except ValueError as error:
            reader.add_error(key, error.args[0])
            return False
        reader.add_deviation(key, units.deviation_in_si(unit, size), is_tolerance=is_tolerance)
        return True

    def _holds(self, number: float) -> bool:
        # a limit in another unit may differ by rounding
        at_end = math.isclose(number, self.high) or (math.isclose(number, self.low) and not self.above)
        return self.low < number < self.high or at_end

    def _out_of_range(self, value: str, dimension: str) -> ErrorMessage:
        low, high = (f'"{end}"' for end in self._range(dimension))
        return ErrorMessage(f"quantity_range{'_above' * self.above}", value=value, low=low, high=high)

    def _advised(self, message: ErrorMessage, value: str, key: str, reader: Reader) -> ErrorMessage:
        """Return the reason why a text is not a quantity, with an example that is in range."""
        if message.name == "speed_per_second":
            return self._per_second(message, key)
        if message.name != "decimal_comma":
            number = _float(value) if message.name == "unit_missing" else math.inf
            written = self._written(number, value.strip()) if isinstance(number, float) else self._example()
            return ErrorMessage(message.name, **{**message.values, "example": written})
        try:
            meant = units.parse(value, self.dimensions, decimal_comma=True, metric_hp=reader.metric_hp)
        except ValueError as error:
            return self._advised(error.args[0], value, key, reader)
        return message if self._holds(meant.value) else self._out_of_range(value.strip(), meant.dimension)

    def _per_second(self, message: ErrorMessage, key: str) -> ErrorMessage:
        """Return the question which speed is meant, as the lines to write, less those out of range."""
        options: Any = message.values["options"]
        held = [text for text in options if self._holds(units.parse(text.strip('"'), ("speed",)).value)]
        name = f"{key.rpartition('.')[2]} = " if not key.endswith("]") else ""
        return ErrorMessage(message.name, **{**message.values, "options": tuple(f"{name}{text}" for text in held)})

    def _written(self, number: float, text: str) -> str:
        """Return a text with the usual unit if it is then in range, else an example in range."""
        unit = units.EXAMPLES[self.dimensions[0]].split()[1]
        fits = math.isfinite(number) and self._holds(units.to_si(float(number), unit))
        return f"{text} {unit}" if fits else self._example()

    def _example(self) -> str:
        """Return an example in range: the usual value of its dimension, or the nearest limit."""
        usual = units.EXAMPLES[self.dimensions[0]]
        value = units.parse(usual, self.dimensions).value
        least, largest = self._range(self.dimensions[0])
        return usual if self._holds(value) else largest if value > self.high else least

    def _range(self, dimension: str) -> tuple[str, str]:
        """Return the least and the largest value with a unit."""
        unit = units.EXAMPLES[dimension].split()[1]
        low, high = units.from_si(self.low, unit), units.from_si(self.high, unit)
        return f"{_in_range(low, ROUND_CEILING)} {unit}", f"{_in_range(high, ROUND_FLOOR)} {unit}"

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of a text with a unit; its range in that unit is for forms, and as words for readers."""
        unit = units.EXAMPLES[self.dimensions[0]].split()[1]
        low, high = self._range(self.dimensions[0])
        described = translate(
            f"fields.quantity{'_above' * self.above}",
            language,
            dimension=" / ".join(
                translate(f"refusals.dimension_{dimension}", language) for dimension in self.dimensions
            ),
            low=low,
            high=high,
            units=", ".join(spelling for dimension in self.dimensions for spelling in units.spellings(dimension)),
        )
        return {
            "type": "string",
            "pattern": r"^\s*[+-]?[0-9.,π]+([eE][+-]?[0-9]+)?\s*\S.*$",
            "description": described,
            "examples": [units.EXAMPLES[self.dimensions[0]]],
            "unit": unit,
            "exclusiveMinimum" if self.above else "minimum": float(f"{units.from_si(self.low, unit):.12g}"),
            "maximum": float(f"{units.from_si(self.high, unit):.12g}"),
        }


class Number(NamedTuple):
    """A plain number between `low` and `high`, an integer if `whole`; `message_kind` begins the name of its message."""

    low: float
    high: float
    above: bool = False
    whole: bool = False
    message_kind: str = "number"
    percent: float = 0.01  # What one per cent is as the number

    def read(self, value: object, key: str, reader: Reader) -> float | None:
        """Return the number."""
        deviation = None
        if isinstance(value, str) and is_fraction(value):
            above, _, below = value.partition("/")
            value = float(above) / float(below)
        if isinstance(value, str):
            stated, deviation = split_deviation(value)
            is_number = deviation is not None or (reader.decimal_comma and value.count(",") == 1)
            value = _float(stated.replace(",", ".")) if is_number else value
        if isinstance(value, str) and value.rstrip().endswith("%") and not self.whole:
            share = _float(value.rstrip(" %").replace(",", "." if reader.decimal_comma else ","))
            value = share * self.percent if isinstance(share, float) else value
        if isinstance(value, bool) or not isinstance(value, int | float):
            message = ErrorMessage("number_plain", value=shown(value), example=self.example())
            reader.add_error(key, _by_sides(str(value), message))
            return None
        number = float(value) if _is_moderate(value) else math.nan
        if not (self.low < number if self.above else self.low <= number) or not number <= self.high:
            reader.add_error(key, self._out_of_range(self.message_kind, value))
            return None
        if self.whole and not number.is_integer():
            reader.add_error(key, self._out_of_range("whole", value))
            return None
        if deviation is not None:
            size = units.deviation_in_si(units.ParsedQuantity(number, "", ""), deviation.size)
            reader.add_deviation(key, size, is_tolerance=deviation.is_tolerance)
        return number if abs(number) > _SMALLEST else 0.0

    def _out_of_range(self, kind: str, value: object) -> ErrorMessage:
        name = f"{kind}_range{'_above' * self.above}"
        return ErrorMessage(name, value=shown(value), low=f"{self.low:g}", high=f"{self.high:g}")

    def example(self) -> str:
        """Return a number in range, for advice."""
        lowest = self.low + 1 if self.above and self.low >= 1 else self.low
        return f"{min(self.high, max(lowest, 1 if self.whole else 0.25)):g}"

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of a number in range."""
        kind = "integer" if self.whole else "number"
        return {"type": kind, "exclusiveMinimum" if self.above else "minimum": self.low, "maximum": self.high}


class UnitOf(NamedTuple):
    """A unit of a dimension in any spelling, read as the first of its spellings."""

    dimension: str

    def read(self, value: object, key: str, reader: Reader) -> str | None:
        """Return the unit."""
        unit = units.UNITS.get(units.known_unit(value)) if isinstance(value, str) else None
        if unit is not None and unit.dimension == self.dimension:
            return units.first_spelling(unit)
        reader.add_error(key, ErrorMessage("choice", value=shown(value), options=tuple(map(shown, self.options))))
        return None

    @property
    def options(self) -> tuple[str, ...]:
        """The usual spellings."""
        return tuple(units.spellings(self.dimension))

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of a unit, its usual spellings for forms."""
        return {"anyOf": [{"enum": list(self.options)}, {"type": "string"}]}


class Choice(NamedTuple):
    """One of a few words or numbers."""

    options: tuple[str | int, ...]
    refusals: tuple[tuple[str, ErrorMessage], ...] = ()  # Of words in small letters that are known and not possible

    def read(self, value: object, key: str, reader: Reader) -> str | int | None:
        """Return the word or number."""
        if not isinstance(value, bool) and value in self.options:
            return next(option for option in self.options if option == value)
        options = tuple(shown(option) for option in self.options)
        latin = value.translate(units.TO_LATIN) if isinstance(value, str) else value
        if latin != value and latin in self.options:
            reader.add_error(key, ErrorMessage("key_look_alike", letters=look_alikes(str(value)), written=latin))
            return None
        refusal = dict(self.refusals).get(str(value).lower())
        reader.add_error(key, refusal or ErrorMessage("choice", value=shown(value), options=options))
        return None

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of an enumeration."""
        return {"enum": list(self.options)}


class Text(NamedTuple):
    """A text, at most `longest` characters."""

    longest: int = 200

    def read(self, value: object, key: str, reader: Reader) -> str | None:
        """Return the text."""
        if not isinstance(value, str):
            reader.add_error(key, ErrorMessage("text_in_quotes", value=shown(value)))
            return None
        if len(value) > self.longest:
            reader.add_error(key, ErrorMessage("text_long", value=shown(value), count=len(value), most=self.longest))
            return None
        if not is_one_line(value):
            reader.add_error(key, ErrorMessage("text_line", value=shown(value)))
            return None
        return value

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of a text."""
        return {"type": "string", "maxLength": self.longest}


class Flag(NamedTuple):
    """true or false."""

    def read(self, value: object, key: str, reader: Reader) -> bool | None:
        """Return the truth value."""
        if isinstance(value, bool):
            return value
        reader.add_error(key, ErrorMessage("flag", value=shown(value)))
        return None

    def schema(self, _: Language, /) -> dict[str, Any]:
        """Return the schema of a truth value."""
        return {"type": "boolean"}


# characters that reverse the direction of the text after them
_TURNING = ("LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI")


def is_one_line(text: str) -> bool:
    """Return whether a text has no line break, no control character and no character that XML forbids."""
    return not any(
        unicodedata.category(character) in ("Cc", "Zl", "Zp", "Cs")
        or unicodedata.bidirectional(character) in _TURNING
        or character in "\ufffe\uffff"
        for character in text
    )


def is_fraction(text: str) -> bool:
    """Return whether a text is a fraction of numbers, such as 1/30."""
    return _FRACTION.fullmatch(text) is not None and float(text.partition("/")[2]) > 0


def look_alikes(text: str) -> str:
    """Return the Cyrillic letters of a text that looks like a Latin one, empty for other texts."""
    letters = "".join(dict.fromkeys(letter for letter in text if ord(letter) in units.TO_LATIN))
    return letters if text.translate(units.TO_LATIN).isascii() else ""


def _is_moderate(value: float) -> bool:
    """Return whether a number is finite and of a size that can be shown; TOML has integers of any length."""
    return abs(value) < 1e15


def shown(value: object) -> str:
    """Return a value for a message: short, and as TOML writes it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int) and not _is_moderate(value):
        return ErrorMessage("the_number")
    if isinstance(value, list | dict):
        return ErrorMessage("some_list" if isinstance(value, list) else "some_table")
    text = f'"{value}"' if isinstance(value, str) else str(value)
    return text if len(text) <= 40 else f"{text[:37]}..."


def _float(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text
