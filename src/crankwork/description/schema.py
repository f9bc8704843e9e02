"""What a table of the machine file may hold: kinds of values that read, complain and describe themselves."""

from __future__ import annotations

import difflib
import math
import unicodedata
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple, Protocol

from crankwork import units
from crankwork.errors import Problem
from crankwork.locale import Refusal

_MAX_ENTRIES = 10_000
_MAX_PROBLEMS = 50
_LONGEST_NAME = 60
# what is nearer to zero than this is zero, and nothing is divided by it
_NOTHING = 1e-30
_OF_NUMBERS = "+-0123456789.,eE \t"


class Measure(NamedTuple):
    """A quantity as read: SI value, dimension, and the unit in which it is written."""

    value: float
    dimension: str
    unit: str = ""


class Reader:
    """Collects the problems of one description while its values are read.

    `problems` holds the first of them; `more` counts the others.
    """

    def __init__(self, *, decimal_comma: bool = False) -> None:
        self.problems: list[Problem] = []
        self.more = 0
        self.decimal_comma = decimal_comma
        self._blamed: set[str] = set()
        self._suspects: set[str] = set()

    def complain(self, key: str, message: str, *, meant: str = "") -> None:
        """Remember a mistake; a key that is wrong already is not blamed twice.

        `meant` is the key that a misspelt one stands for, so that it is not missed as well.
        """
        if key in self._blamed:
            return
        self._blamed.add(key)
        self._suspects |= {key, meant or key}
        if len(self.problems) < _MAX_PROBLEMS:
            self.problems.append(Problem(key, message))
        else:
            self.more += 1

    @property
    def is_full(self) -> bool:
        """Whether further mistakes are only counted."""
        return len(self.problems) >= _MAX_PROBLEMS

    def doubts(self, *keys: str) -> bool:
        """Return whether one of the keys, or a table around it, is wrong already: what follows from it is not told."""
        around = ({key, *(key[:at] for at, mark in enumerate(key) if mark == ".")} for key in keys)
        return any(not self._suspects.isdisjoint(one) for one in around)


class Kind(Protocol):
    """A kind of value."""

    def read(self, value: object, key: str, reader: Reader) -> Any:  # noqa: ANN401 - each kind has its own type
        """Return the value as the program uses it, or None after a complaint."""

    def schema(self) -> dict[str, Any]:
        """Return the JSON Schema of the value as written."""


class Quantity(NamedTuple):
    """Number and unit as text; the SI value must lie within `low` and `high`, whichever dimension it has."""

    dimensions: tuple[str, ...]
    low: float
    high: float
    above: bool = False

    def read(self, value: object, key: str, reader: Reader) -> Measure | None:
        """Return SI value and dimension."""
        example = units.EXAMPLES[self.dimensions[0]]
        if isinstance(value, bool) or not isinstance(value, str | int | float):
            reader.complain(key, Refusal("quantity_as_text", example=example))
            return None
        if not isinstance(value, str):
            text = _shown(value)
            known = example.split()[1]
            shown = f'"{text} {known}"' if _is_moderate(value) else f'"{example}"'
            reader.complain(key, Refusal("no_unit", value=text, example=shown))
            return None
        try:
            number, dimension = units.parse(value, self.dimensions, decimal_comma=reader.decimal_comma)
        except ValueError as error:
            reader.complain(key, error.args[0])
            return None
        if not self._holds(number):
            reader.complain(key, self._out_of_range(value.strip(), dimension))
            return None
        return Measure(number if abs(number) > _NOTHING else 0.0, dimension, value.lstrip(_OF_NUMBERS).rstrip())

    def _holds(self, number: float) -> bool:
        return (self.low < number if self.above else self.low <= number) and number <= self.high

    def _out_of_range(self, value: str, dimension: str) -> Refusal:
        low, high = (f'"{one}"' for one in self._range(dimension))
        return Refusal(f"quantity_range{'_above' * self.above}", value=value, low=low, high=high)

    def _range(self, dimension: str) -> tuple[str, str]:
        """Return the least and the largest value with a unit."""
        unit = units.EXAMPLES[dimension].split()[1]
        low, high = (f"{units.from_si(one, unit):.6g} {unit}" for one in (self.low, self.high))
        return low, high

    def schema(self) -> dict[str, Any]:
        """Return the schema of a text with a unit."""
        named = " or ".join(dimension.replace("_", " ") for dimension in self.dimensions)
        known = [one for dimension in self.dimensions for one in units.spellings(dimension)]
        low, high = self._range(self.dimensions[0])
        span = f"{'above' if self.above else 'from'} {low} to {high}"
        return {
            "type": "string",
            "pattern": r"^\s*[+-]?[0-9.,]+([eE][+-]?[0-9]+)?\s*\S.*$",
            "description": f"{named}; {span}; units: {', '.join(known)}",
            "examples": [units.EXAMPLES[self.dimensions[0]]],
        }


class Number(NamedTuple):
    """A plain number between `low` and `high`; a whole one if it counts something."""

    low: float
    high: float
    above: bool = False
    whole: bool = False

    def read(self, value: object, key: str, reader: Reader) -> float | None:
        """Return the number."""
        if isinstance(value, str) and reader.decimal_comma and value.count(",") == 1:
            value = _float(value.replace(",", "."))
        if isinstance(value, bool) or not isinstance(value, int | float):
            reader.complain(key, Refusal("number_plain", value=_shown(value), example=self.example()))
            return None
        number = float(value) if _is_moderate(value) else math.nan
        if not (self.low < number if self.above else self.low <= number) or not number <= self.high:
            reader.complain(key, self._out_of_range("number", value))
            return None
        if self.whole and not number.is_integer():
            reader.complain(key, self._out_of_range("whole", value))
            return None
        return number if abs(number) > _NOTHING else 0.0

    def _out_of_range(self, kind: str, value: object) -> Refusal:
        name = f"{kind}_range{'_above' * self.above}"
        return Refusal(name, value=_shown(value), low=f"{self.low:g}", high=f"{self.high:g}")

    def example(self) -> str:
        """Return a number in range, for advice."""
        lowest = self.low + 1 if self.above and self.low >= 1 else self.low
        return f"{min(self.high, max(lowest, 0.25)):g}"

    def schema(self) -> dict[str, Any]:
        """Return the schema of a number in range."""
        kind = "integer" if self.whole else "number"
        return {"type": kind, "exclusiveMinimum" if self.above else "minimum": self.low, "maximum": self.high}


class Choice(NamedTuple):
    """One of a few words or numbers."""

    options: tuple[str | int, ...]

    def read(self, value: object, key: str, reader: Reader) -> str | int | None:
        """Return the word or number."""
        if not isinstance(value, bool) and value in self.options:
            return next(one for one in self.options if one == value)
        options = tuple(_shown(one) for one in self.options)
        reader.complain(key, Refusal("choice", value=_shown(value), options=options))
        return None

    def schema(self) -> dict[str, Any]:
        """Return the schema of an enumeration."""
        return {"enum": list(self.options)}


class Text(NamedTuple):
    """A text, at most `longest` characters."""

    longest: int = 200

    def read(self, value: object, key: str, reader: Reader) -> str | None:
        """Return the text."""
        if not isinstance(value, str):
            reader.complain(key, Refusal("text_in_quotes", value=_shown(value)))
            return None
        if len(value) > self.longest:
            reader.complain(key, Refusal("text_long", value=_shown(value), count=len(value), most=self.longest))
            return None
        if not is_one_line(value):
            reader.complain(key, Refusal("text_line", value=_shown(value)))
            return None
        return value

    def schema(self) -> dict[str, Any]:
        """Return the schema of a text."""
        return {"type": "string", "maxLength": self.longest}


class Flag(NamedTuple):
    """true or false."""

    def read(self, value: object, key: str, reader: Reader) -> bool | None:
        """Return the truth value."""
        if isinstance(value, bool):
            return value
        reader.complain(key, Refusal("flag", value=_shown(value)))
        return None

    def schema(self) -> dict[str, Any]:
        """Return the schema of a truth value."""
        return {"type": "boolean"}


class ListOf(NamedTuple):
    """A list whose entries are of one kind."""

    entry: Kind
    fewest: int = 0
    most: int = _MAX_ENTRIES

    def read(self, value: object, key: str, reader: Reader) -> list[Any] | None:
        """Return the entries; a bad one is left out after its complaint."""
        if not isinstance(value, list):
            reader.complain(key, self._advice(key))
            return None
        if not self.fewest <= len(value) <= self.most:
            wanted: object = self.fewest
            if self.fewest != self.most:
                wanted = Refusal("entries_between", fewest=self.fewest, most=self.most)
            reader.complain(key, Refusal("entries", count=len(value), wanted=wanted))
            return None
        return [self.entry.read(one, f"{key}[{i}]", reader) for i, one in enumerate(value, start=1)]

    def _advice(self, key: str) -> Refusal:
        if isinstance(self.entry, Table):
            return Refusal("list_of_tables", key=key)
        example = units.EXAMPLES[self.entry.dimensions[0]] if isinstance(self.entry, Quantity) else "a"
        return Refusal("list_like", example=f'["{example}"]')

    def schema(self) -> dict[str, Any]:
        """Return the schema of an array."""
        return {"type": "array", "items": self.entry.schema(), "minItems": self.fewest, "maxItems": self.most}


class Nested(NamedTuple):
    """A list whose entries are of one kind or lists of it."""

    entry: Kind

    def read(self, value: object, key: str, reader: Reader) -> list[Any] | None:
        """Return the entries, lists within as lists."""
        if not isinstance(value, list) or not 1 <= len(value) <= _MAX_ENTRIES:
            reader.complain(key, Refusal("list_like", example="[0.98, [0.95, 0.95], 0.99]"))
            return None
        inner = ListOf(self.entry, fewest=1)
        return [
            (inner if isinstance(one, list) else self.entry).read(one, f"{key}[{i}]", reader)
            for i, one in enumerate(value, start=1)
        ]

    def schema(self) -> dict[str, Any]:
        """Return the schema of an array with arrays in it."""
        one = self.entry.schema()
        return {
            "type": "array",
            "items": {"anyOf": [one, {"type": "array", "items": one, "minItems": 1}]},
            "minItems": 1,
        }


class NameOr(NamedTuple):
    """A name, or a value of another kind."""

    other: Kind

    def read(self, value: object, key: str, reader: Reader) -> Any:  # noqa: ANN401 - a name or the other kind's type
        """Return the name or the value."""
        return value if isinstance(value, str) and value else self.other.read(value, key, reader)

    def schema(self) -> dict[str, Any]:
        """Return the schema of either."""
        return {"anyOf": [{"type": "string"}, self.other.schema()]}


class NumberOr(NamedTuple):
    """A quantity with its unit, or a plain number."""

    quantity: Quantity
    number: Number

    def read(self, value: object, key: str, reader: Reader) -> Measure | float | None:
        """Return the quantity of a text and the number of a number."""
        return (self.quantity if isinstance(value, str) else self.number).read(value, key, reader)

    def schema(self) -> dict[str, Any]:
        """Return the schema of either."""
        return {"anyOf": [self.quantity.schema(), self.number.schema()]}


class Named(NamedTuple):
    """A table whose keys are names of the user's own, all values of one kind."""

    entry: Kind
    most: int = _MAX_ENTRIES

    def read(self, value: object, key: str, reader: Reader) -> dict[str, Any] | None:
        """Return the values by name."""
        if not isinstance(value, dict):
            reader.complain(key, Refusal("table_below", key=key))
            return None
        if len(value) > self.most:
            reader.complain(key, Refusal("entries_most", count=len(value), most=self.most))
            return None
        for name in value:
            if not name or len(name) > _LONGEST_NAME or not is_one_line(name):
                reader.complain(f"{key}.{name}", Refusal("no_name", most=_LONGEST_NAME))
        return {name: self.entry.read(one, f"{key}.{name}", reader) for name, one in value.items()}

    def schema(self) -> dict[str, Any]:
        """Return the schema of a mapping."""
        names = {"minLength": 1, "maxLength": _LONGEST_NAME}
        return {"type": "object", "additionalProperties": self.entry.schema(), "propertyNames": names,
                "maxProperties": self.most}  # fmt: skip


class Key(NamedTuple):
    """A key of a table: its kind, what it means, and the keys that say the same and exclude it."""

    kind: Kind
    meaning: str
    required: bool = False
    instead_of: tuple[str, ...] = ()


class Table(NamedTuple):
    """A table with a fixed set of keys."""

    keys: Mapping[str, Key]

    def read(self, value: object, key: str, reader: Reader) -> dict[str, Any] | None:
        """Return the values by key; keys not given are absent."""
        if isinstance(value, list) and all(isinstance(one, dict) for one in value):
            reader.complain(key, Refusal("one_table", count=len(value), key=key))
            return None
        if not isinstance(value, dict):
            reader.complain(key, Refusal("table_below", key=key) if "[" not in key else Refusal("table_inline"))
            return None
        result = {}
        for name, one in value.items():
            path = f"{key}.{name}" if key else name
            if name not in self.keys:
                self._complain_unknown(name, one, path, reader)
                continue
            result[name] = self.keys[name].kind.read(one, path, reader)
            clashes = [other for other in self.keys[name].instead_of if other in value]
            later = clashes and list(value).index(name) > min(list(value).index(other) for other in clashes)
            if later or any(name not in self.keys[other].instead_of for other in clashes):
                reader.complain(path, Refusal("same", others=clashes))
        for name, entry in self.keys.items():
            if entry.required:
                self._check_there(name, value, key, reader)
        return {name: one for name, one in result.items() if one is not None}

    def _complain_unknown(self, name: str, value: object, path: str, reader: Reader) -> None:
        if reader.is_full:
            reader.complain(path, "")
            return
        what = "table" if isinstance(value, dict) else "key"
        nearest = nearest_name(name, tuple(self.keys))
        if nearest:
            meant = f"{path.removesuffix(name)}{nearest}"
            reader.complain(path, Refusal(f"unknown_{what}_near", nearest=nearest), meant=meant)
            # what stands in a misspelt table has mistakes of its own to tell
            self.keys[nearest].kind.read(value, path, reader)
        else:
            reader.complain(path, Refusal(f"unknown_{what}", known=", ".join(self.keys)))

    def _check_there(self, name: str, value: Mapping[str, object], key: str, reader: Reader) -> None:
        """Complain if a required key is missing, and so are those that could stand in its place."""
        entry = self.keys[name]
        alternatives = (name, *entry.instead_of)
        prefix = f"{key}." if key else ""
        if any(one in value for one in alternatives) or reader.doubts(*(f"{prefix}{one}" for one in alternatives)):
            return
        advice = tuple(_advice(one, self.keys[one].kind, prefix) for one in alternatives)
        reader.complain(f"{prefix}{name}", Refusal("missing", advice=advice))

    def schema(self) -> dict[str, Any]:
        """Return the schema of an object."""
        properties = {}
        for name, entry in self.keys.items():
            own = entry.kind.schema()
            described = {"description": "; ".join(part for part in (entry.meaning, own.get("description")) if part)}
            properties[name] = {**own, **described}
        required = [name for name, entry in self.keys.items() if entry.required and not entry.instead_of]
        return {"type": "object", "properties": properties, "required": required, "additionalProperties": False}


def nearest_name(word: str, options: Iterable[str]) -> str:
    """Return the option nearest to a misspelt word, or nothing if none is near."""
    matches = difflib.get_close_matches(word[:60], list(options), n=1, cutoff=0.6)
    return matches[0] if matches else ""


def is_one_line(text: str) -> bool:
    """Return whether a text has no line break, no control character and nothing that XML forbids."""
    return not any(unicodedata.category(one) in ("Cc", "Zl", "Zp", "Cs") or one in "\ufffe\uffff" for one in text)


def _is_moderate(value: float) -> bool:
    """Return whether a number is finite and of a size that can be shown; TOML has integers of any length."""
    return abs(value) < 1e15


def _shown(value: object) -> str:
    """Return a value as a message shows it: short, and as TOML writes it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int) and not _is_moderate(value):
        return Refusal("the_number")
    if isinstance(value, list | dict):
        return Refusal("some_list" if isinstance(value, list) else "some_table")
    text = f'"{value}"' if isinstance(value, str) else str(value)
    return text if len(text) <= 40 else f"{text[:37]}..."


def _advice(name: str, kind: Kind, prefix: str) -> str:
    """Return what to write for a missing key of the table whose keys begin with `prefix`."""
    match kind:
        case Quantity():
            return f'{name} = "{units.EXAMPLES[kind.dimensions[0]]}"'
        case Number():
            return f"{name} = {kind.example()}"
        case Choice():
            return f"{name} = {_shown(kind.options[0])}"
        case Text():
            return f'{name} = "..."'
        case Table():
            return Refusal("a_table", key=f"{prefix}{name}")
        case Named():
            return Refusal("tables_of_names", key=f"{prefix}{name}")
        case ListOf(Text()):
            return f'{name} = ["A", "B"]'
        case ListOf(Quantity() as entry):
            return f'{name} = ["{units.EXAMPLES[entry.dimensions[0]]}", ...]'
        case _:
            return f"{name} = [...]"


def _float(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text
