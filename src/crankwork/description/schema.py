"""Types of tables and lists in the machine file, what a file states by path; reader and JSON Schema follow."""

from __future__ import annotations

import difflib
import functools
import inspect
import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

from crankwork import units
from crankwork.description.value_types import (
    Choice,
    MeasuredValue,
    Number,
    Quantity,
    Reader,
    Text,
    ValueType,
    is_fraction,
    is_one_line,
    look_alikes,
    shown,
)
from crankwork.errors import Problem
from crankwork.locale import ErrorMessage, Language, has_text, texts, translate
from crankwork.machine import FileInput, FileInputs, InputNumber
from crankwork.mechanism.linkage import LengthInertia
from crankwork.units import TO_LATIN

_MAX_ENTRIES = 10_000
_LONGEST_NAME = 60


class ListOf(NamedTuple):
    """A list of entries of one type; `from_file`: or the name of a column, or a single value if `fewest` is 1."""

    entry: ValueType
    fewest: int = 0
    most: int = _MAX_ENTRIES
    from_file: bool = False
    first: ValueType | None = None  # Of the first entry, where others may be of more kinds

    @property
    def may_be_one(self) -> bool:
        """Whether a single value may stand for the list."""
        return self.from_file and self.fewest == 1

    def read(self, value: object, key: str, reader: Reader) -> list[Any] | None:
        """Return the entries; an invalid entry becomes None after its complaint."""
        single = (str, int, float) if isinstance(self.entry, Quantity) else str
        if self.may_be_one and isinstance(value, single) and not reader.has_errors(key):
            return [self.entry.read(value, key, reader)]
        if (
            isinstance(value, str)
            and isinstance(self.entry, Number)
            and re.fullmatch(r"\s*\d+(\s*[-–—]\s*\d+)+\s*", value)
        ):
            # a firing order as sheets write it
            value = list(map(int, re.findall(r"\d+", value)))
        if not isinstance(value, list):
            # the missing content of an unreadable file is not reported
            if not (self.from_file and reader.has_errors(key)):
                reader.add_error(key, self._advice(key, value))
            return None
        if not self.fewest <= len(value) <= self.most:
            wanted: object = self.fewest
            if self.fewest != self.most:
                wanted = ErrorMessage("entries_between", fewest=self.fewest, most=self.most)
            reader.add_error(key, ErrorMessage("entries", count=len(value), wanted=wanted))
            return None
        return [
            ((self.first if i == 1 else None) or self.entry).read(entry, f"{key}[{i}]", reader)
            for i, entry in enumerate(value, start=1)
        ]

    def _advice(self, key: str, value: object) -> ErrorMessage:
        if isinstance(self.entry, TableSpec):
            return ErrorMessage("list_of_tables", key=key)
        match self.entry:
            case Quantity(dimensions=(first, *_)) | NumberOr(quantity=Quantity(dimensions=(first, *_))):
                example = f'"{units.EXAMPLES[first]}"'
            case Number(whole=True) if isinstance(value, str) and (numbers := re.findall(r"\d+", value)):
                example = ", ".join(numbers)
            case Number():
                example = self.entry.example()
            case _:
                example = '"a"'
        if self.from_file:
            return ErrorMessage("list_or_file", example=", ".join([example] * self.fewest))
        count = self.fewest if isinstance(self.entry, Quantity) else 1
        return ErrorMessage("list_like", example=f"[{', '.join([example] * max(count, 1))}]")

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of an array."""
        own = {"type": "array", "items": self.entry.schema(language), "minItems": self.fewest, "maxItems": self.most}
        if not self.from_file:
            return own
        name = {"anyOf": [{"type": "string"}, {"type": "integer", "minimum": 1}]}
        properties = {"column": name, "unit": {"type": "string"}}
        with_unit = {"type": "object", "properties": properties, "required": ["column"], "additionalProperties": False}
        return {"anyOf": [own, *name["anyOf"], with_unit]}


class Nested(NamedTuple):
    """A list whose entries are of one type or lists of it."""

    entry: ValueType

    def read(self, value: object, key: str, reader: Reader) -> list[Any] | None:
        """Return the entries, inner lists as lists."""
        if not isinstance(value, list) or not 1 <= len(value) <= _MAX_ENTRIES:
            reader.add_error(key, ErrorMessage("list_like", example="[0.98, [0.95, 0.95], 0.99]"))
            return None
        inner = ListOf(self.entry, fewest=1)
        return [
            (inner if isinstance(entry, list) else self.entry).read(entry, f"{key}[{i}]", reader)
            for i, entry in enumerate(value, start=1)
        ]

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of an array with arrays in it."""
        entry = self.entry.schema(language)
        return {
            "type": "array",
            "items": {"anyOf": [entry, {"type": "array", "items": entry, "minItems": 1}]},
            "minItems": 1,
        }


class OneOrMore(NamedTuple):
    """A value of one kind, or a list of them."""

    entry: ValueType
    most: int

    def read(self, value: object, key: str, reader: Reader) -> tuple[Any, ...] | None:
        """Return the values; an invalid value is left out after its complaint."""
        if not isinstance(value, list):
            single = self.entry.read(value, key, reader)
            return None if single is None else (single,)
        entries = ListOf(self.entry, fewest=1, most=self.most).read(value, key, reader)
        return None if entries is None else tuple(entry for entry in entries if entry is not None)

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of either."""
        own = self.entry.schema(language)
        return {"anyOf": [own, {"type": "array", "items": own, "minItems": 1, "maxItems": self.most}]}


class OneForAll(NamedTuple):
    """A value of one kind for all of several parts, or a list with one for each."""

    entry: ValueType
    most: int

    def read(self, value: object, key: str, reader: Reader) -> Any:  # noqa: ANN401 - a value or a list of them
        """Return the value, or the list."""
        is_list = isinstance(value, list)
        return (ListOf(self.entry, fewest=1, most=self.most) if is_list else self.entry).read(value, key, reader)

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of either."""
        return OneOrMore(self.entry, self.most).schema(language)


class NameOr(NamedTuple):
    """A name, or a value of another kind."""

    other: ValueType

    def read(self, value: object, key: str, reader: Reader) -> Any:  # noqa: ANN401 - a name or the other kind's type
        """Return the name or the value."""
        return value if isinstance(value, str) and value else self.other.read(value, key, reader)

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of either."""
        return {"anyOf": [{"type": "string"}, self.other.schema(language)]}


class WordOr(NamedTuple):
    """One of a few words, or a plain number."""

    words: Choice
    number: Number

    def read(self, value: object, key: str, reader: Reader) -> str | float | None:
        """Return the word or the number."""
        return (self.words if isinstance(value, str) else self.number).read(value, key, reader)

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of either."""
        return {"anyOf": [self.words.schema(language), self.number.schema(language)]}


class NumberOr(NamedTuple):
    """A quantity with its unit or a list of them, or a plain number."""

    quantity: ValueType
    number: Number

    def read(self, value: object, key: str, reader: Reader) -> Any:  # noqa: ANN401 - a number or the other kind's type
        """Return the number of a number, a fraction or a percentage, and the quantity of all else."""
        return self.kind_of(value).read(value, key, reader)

    def kind_of(self, value: object) -> ValueType:
        """Return the type that a value is of."""
        is_number = isinstance(value, str) and (is_fraction(value) or value.rstrip().endswith("%"))
        return self.quantity if isinstance(value, list) or (isinstance(value, str) and not is_number) else self.number

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of either."""
        return {"anyOf": [self.quantity.schema(language), self.number.schema(language)]}


_SIZE = r"\s*(\d+(?:[.,]\d+)?)\s*"
_OF_LENGTH = re.compile(
    rf"(?:{_SIZE}(?:/{_SIZE})?[*·]?)?\s*m\s*[*·]?\s*l\s*(?:\^|\*\*)?\s*[2²]\s*(?:/{_SIZE})?", re.IGNORECASE
)
# the greatest share about the centre of mass, and that of a bar about its end
_LARGEST_SHARE, _ABOUT_END = 0.25, 1 / 3


class InertiaKind(NamedTuple):
    """A moment of inertia with its unit, or a share of m l^2: `m l^2 / 12`, `0.17 m l^2`, about an end `m l^2 / 3`."""

    quantity: Quantity

    def read(self, value: object, key: str, reader: Reader) -> MeasuredValue | LengthInertia | None:
        """Return the moment of inertia, or how it follows from the length."""
        match = _OF_LENGTH.fullmatch(value) if isinstance(value, str) else None
        if match is None:
            return self.quantity.read(value, key, reader)
        above, below, under = (float((part or "1").replace(",", ".")) for part in match.groups())
        share = above / (below * under) if below * under else 0.0
        about_end = math.isclose(share, _ABOUT_END, rel_tol=1e-3)
        if not about_end and not 0 < share <= _LARGEST_SHARE:
            reader.add_error(key, ErrorMessage("inertia_share", value=shown(value)))
            return None
        return LengthInertia(_ABOUT_END if about_end else share, about_end)

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of either."""
        own = self.quantity.schema(language)
        return {**own, "pattern": rf"({own['pattern']})|m\s*l"}


class MapOf(NamedTuple):
    """A table with names of the user as keys and values of one type; `deep`: levels of tables from dotted names."""

    entry: ValueType
    most: int = _MAX_ENTRIES
    deep: int = 0

    def read(self, value: object, key: str, reader: Reader) -> dict[str, Any] | None:
        """Return the values by name."""
        if not isinstance(value, dict):
            reader.add_error(key, ErrorMessage("table_below", key=key))
            return None
        if len(value) > self.most:
            reader.add_error(key, ErrorMessage("entries_most", count=len(value), most=self.most))
            return None
        for name in value:
            if not name or len(name) > _LONGEST_NAME or not is_one_line(name):
                reader.add_error(f"{key}.{name}", ErrorMessage("no_name", most=_LONGEST_NAME))
        return {name: self.entry.read(item, f"{key}.{name}", reader) for name, item in value.items()}

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of a mapping."""
        names = {"minLength": 1, "maxLength": _LONGEST_NAME}
        own = below = self.entry.schema(language)
        for _ in range(self.deep):
            below = {"anyOf": [own, {"type": "object", "additionalProperties": below}]}
        return {"type": "object", "additionalProperties": below, "propertyNames": names,
                "maxProperties": self.most}  # fmt: skip


class DefaultBy(NamedTuple):
    """A default that depends on a key of its table or of the table around: that key, and the default for its values."""

    key: str
    values: Mapping[str, Any]


Made = TypeVar("Made")


class KeySpec(NamedTuple):
    """A field of a table: its kind, its default as a file would state it, and when it applies.

    `required`: always, or for tables of these kinds; `instead_of`: equivalent keys that exclude it; `only`: keys that
    must be present, each with its allowed values, or empty for any; `example`: as a file has it.
    """

    kind: ValueType
    required: bool | tuple[str, ...] = False
    instead_of: tuple[str, ...] = ()
    default: Any = None
    only: Mapping[str, tuple[str, ...]] = MappingProxyType({})
    example: str = ""


class TableSpec(NamedTuple):
    """A table with a fixed set of keys; `name` begins the keys of texts about its fields."""

    name: str
    keys: Mapping[str, KeySpec]

    def read(self, value: object, key: str, reader: Reader) -> Values | None:
        """Return the values by key."""
        if isinstance(value, list) and all(isinstance(part, dict) for part in value):
            reader.add_error(key, ErrorMessage("one_table", count=len(value), key=key))
            return None
        if not isinstance(value, dict):
            reader.add_error(
                key, ErrorMessage("table_below", key=key) if "[" not in key else ErrorMessage("table_inline")
            )
            return None
        result = {}
        for name, item in value.items():
            path = f"{key}.{name}" if key else name
            if name not in self.keys:
                self._report_unknown(name, item, path, reader)
                continue
            result[name] = self.keys[name].kind.read(item, path, reader)
            self._suggest_key(name, path, reader)
            clashes = [other for other in self.keys[name].instead_of if other in value]
            later = clashes and list(value).index(name) > min(list(value).index(other) for other in clashes)
            if later or any(name not in self.keys[other].instead_of for other in clashes):
                reader.add_error(path, ErrorMessage("same", others=clashes))
        values = Values({name: read_value for name, read_value in result.items() if read_value is not None}, self)
        for inner in (item for item in values.values() if isinstance(item, Values)):
            inner.outer = values
        prefix = f"{key}." if key else ""
        for name, entry in self.keys.items():
            if name in value:
                self._check_applies(name, values, prefix, reader)
            elif entry.required is True or (entry.required and values["kind"] in entry.required):
                self._check_there(name, value, values, prefix, reader)
        return values

    def _suggest_key(self, name: str, path: str, reader: Reader) -> None:
        """Name the key that takes a unit which this key does not, if it tells another size of the same thing."""
        problem = reader.problems[-1] if reader.problems else None
        message = problem.message if problem is not None and problem.key == path else None
        measured = message.values.get("measured") if isinstance(message, ErrorMessage) else None
        if not isinstance(message, ErrorMessage) or not isinstance(measured, ErrorMessage):
            return
        dimension, subject = measured.name.removeprefix("dimension_"), name.partition("_")[0]
        for other, entry in self.keys.items():
            of_unit = isinstance(entry.kind, Quantity) and dimension in entry.kind.dimensions
            if of_unit and other.partition("_")[0] == subject:
                reader.problems[-1] = Problem(path, ErrorMessage("unit_of_key", nearest=other, **message.values))

    def default(self, name: str, values: Values) -> Any:  # noqa: ANN401 - each kind has its own type
        """Return the default of a key, given the other values of its table, or None."""
        entry = self.keys.get(name)
        match entry.kind if entry else None:
            case TableSpec() as table:
                return Values({}, table, values)
            case MapOf():
                return {}
            case ListOf() if entry and entry.default is None:
                return []
        written = self.written_default(name, values)
        return None if entry is None or written is None else entry.kind.read(written, name, Reader())

    def written_default(self, name: str, values: Values) -> Any:  # noqa: ANN401 - as a file has it
        """Return the default of a key as a file would state it, None if it has none or does not apply."""
        entry = self.keys.get(name)
        excluding = (other for other in values if other in self.keys and name in self.keys[other].instead_of)
        if entry is None or self._foreign(entry, values) or any(excluding):
            return None
        default = entry.default
        if not isinstance(default, DefaultBy):
            return default
        governing = values if default.key in self.keys else values.outer
        return None if governing is None else default.values.get(governing[default.key])

    @staticmethod
    def _foreign(entry: KeySpec, values: Values) -> tuple[str, tuple[str, ...]] | None:
        """Return the first key, with its required values, because of which a key does not apply."""
        for other, wanted in entry.only.items():
            if values[other] not in wanted if wanted else other not in values:
                return other, wanted
        return None

    def _check_applies(self, name: str, values: Values, prefix: str, reader: Reader) -> None:
        """Report a key without effect because of the other keys."""
        missed = self._foreign(self.keys[name], values)
        if missed is None or reader.has_errors(f"{prefix}{missed[0]}"):
            return
        other, wanted = missed
        if wanted:
            reader.add_error(f"{prefix}{name}", no_effect_message(other, values[other], wanted))
        else:
            advice = _advice(other, self.keys[other], prefix)
            reader.add_error(f"{prefix}{name}", ErrorMessage("only_beside", key=other, advice=advice))

    def _report_unknown(self, name: str, value: object, path: str, reader: Reader) -> None:
        if reader.is_full:
            reader.add_error(path, "")
            return
        what = "table" if isinstance(value, dict) else "key"
        latin = name.translate(units.TO_LATIN)
        if (letters := look_alikes(name)) and latin in self.keys:
            meant = f"{path.removesuffix(name)}{latin}"
            reader.add_error(path, ErrorMessage("key_look_alike", letters=letters, written=latin), meant=meant)
            return
        meant = name
        for word, own_word in _OF_BOOKS:
            meant = meant.replace(word, own_word)
        own = [key for key in self.keys if f"_{key}".endswith((f"_{meant}", f"_{name}"))]
        nearest = own[0] if len(own) == 1 else "" if own else nearest_name(name, tuple(self.keys))
        tables = {} if own or isinstance(value, dict) else {key: spec.kind for key, spec in reader.tables.items()}
        others = [f"{key}.{name}" for key, kind in tables.items() if isinstance(kind, TableSpec) and name in kind.keys]
        if len(others) in {1, 2, 3}:
            reader.add_error(path, ErrorMessage("unknown_key_near", nearest=", ".join(others)), meant=others[0])
        elif nearest:
            meant = f"{path.removesuffix(name)}{nearest}"
            reader.add_error(path, ErrorMessage(f"unknown_{what}_near", nearest=nearest), meant=meant)
            # report mistakes inside a misspelt table too
            self.keys[nearest].kind.read(value, path, reader)
        else:
            reader.add_error(path, ErrorMessage(f"unknown_{what}", known=", ".join(own or self.keys)))

    def _check_there(self, name: str, value: Mapping[str, object], values: Values, prefix: str, reader: Reader) -> None:
        """Report a required key if it and its alternatives are missing."""
        entry = self.keys[name]
        alternatives = (name, *entry.instead_of)
        is_reported = reader.has_errors(*(f"{prefix}{key}" for key in (*alternatives, *entry.only)))
        if is_reported or any(alternative in value for alternative in alternatives) or self._foreign(entry, values):
            return
        # what is there tells which alternative is meant
        depended = {other for stated in value if stated in self.keys for other in self.keys[stated].only}
        alternatives = tuple(key for key in alternatives if key in depended) or alternatives
        fixed = [
            f"{name} = {shown(fit[0])}" for stated in value if (fit := self.keys.get(stated, entry).only.get(name))
        ]
        advice = tuple(fixed[:1] or (_advice(key, self.keys[key], prefix) for key in alternatives))
        reader.add_error(f"{prefix}{alternatives[0]}", ErrorMessage("missing", advice=advice))

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of an object."""
        properties, dependent = {}, {}
        for name, entry in self.keys.items():
            own = entry.kind.schema(language)
            parts = [self.meaning(name, language), *_applies(entry, language), own.get("description")]
            described = "; ".join(part for part in parts if part)
            default = (
                {} if entry.default is None or isinstance(entry.default, DefaultBy) else {"default": entry.default}
            )
            properties[name] = {**own, "description": described, **default}
            if entry.only or entry.instead_of:
                dependent[name] = self._dependent_schema(entry)
        always = [name for name, key in self.keys.items() if key.required is True and not (key.only or key.instead_of)]
        rules = [self._needed(name, key) for name, key in self.keys.items() if key.required and name not in always]
        return {"type": "object", "properties": properties, "required": always, "additionalProperties": False,
                "dependentSchemas": dependent, **({"allOf": rules} if rules else {})}  # fmt: skip

    @staticmethod
    def _needed(name: str, entry: KeySpec) -> dict[str, Any]:
        """Return the schema of a table that needs a key, or an equivalent key, for some of its kinds."""
        present = {"anyOf": [{"required": [alternative]} for alternative in (name, *entry.instead_of)]}
        cases = {"kind": entry.required} if isinstance(entry.required, tuple) else entry.only
        when = {"properties": {key: {"enum": list(values)} for key, values in cases.items()}, "required": list(cases)}
        return {"if": when, "then": present} if cases else present

    def _dependent_schema(self, entry: KeySpec) -> dict[str, Any]:
        """Return the schema of a table that has a key."""
        wanted = {other: {"enum": list(values)} for other, values in entry.only.items() if values}
        stated = [other for other, values in entry.only.items() if self.keys[other].default not in values or not values]
        none = {"not": {"anyOf": [{"required": [other]} for other in entry.instead_of]}} if entry.instead_of else {}
        return {"properties": wanted, "required": stated, **none}

    def meaning(self, name: str, language: Language) -> str:
        """Return the text about a key, of this table or of any table."""
        known = texts("fields", language)
        return known.get(f"{self.name}.{name}") or known.get(name, "")


class Values(dict[str, Any]):
    """Values of a table; a missing key gives its default and is not `in` the table."""

    def __init__(self, stated: Mapping[str, Any], table: TableSpec, outer: Values | None = None) -> None:
        super().__init__(stated)
        self.table, self.outer = table, outer

    def __missing__(self, name: str) -> Any:  # noqa: ANN401 - each kind has its own type
        return self.table.default(name, self)

    def si(self, name: str) -> Any:  # noqa: ANN401 - a number, a word, or None
        """Return a value, of a quantity in SI, or None."""
        value = self[name]
        return value.value if isinstance(value, MeasuredValue) else value

    def degrees(self, name: str) -> Any:  # noqa: ANN401 - a number, several of a list, or None
        """Return an angle, or a list of angles, in degrees without rounding errors of radians, or None."""
        value = self[name]
        if isinstance(value, list):
            return [_degrees(angle) for angle in value if angle is not None]
        return None if value is None else _degrees(value)

    def made(self, kind: Callable[..., Made], **fields: Any) -> Made:  # noqa: ANN401 - each field has its own type
        """Return an object with these values in SI in fields of the same names, and `fields`."""
        own = {name: self.si(name) for name in _fields_of(kind) if name in self.table.keys}
        return kind(**{**own, **fields})

    def but(self, **changes: Any) -> Values:  # noqa: ANN401 - each kind has its own type
        """Return these values with changes."""
        return Values({**self, **changes}, self.table, self.outer)


@functools.cache
def _fields_of(kind: Callable[..., Any]) -> tuple[str, ...]:
    return tuple(inspect.signature(kind).parameters)


def _degrees(angle: MeasuredValue) -> float:
    return round(math.degrees(angle.value), 9)


def _applies(entry: KeySpec, language: Language) -> Iterator[str]:
    """Yield texts about the keys that a key needs, and about a default that depends on another key."""
    for key, values in entry.only.items():
        yield translate("fields.with", language, condition=" | ".join(f"{key} = {option}" for option in values) or key)
    if isinstance(entry.default, DefaultBy):
        for default in dict.fromkeys(entry.default.values.values()):
            cases = [f"{entry.default.key} = {case}" for case, item in entry.default.values.items() if item == default]
            yield translate("fields.default_with", language, default=default, condition=" | ".join(cases))


def no_effect_message(key: str, value: object, wanted: tuple[str, ...]) -> ErrorMessage:
    """Return the message about a key that applies only with other values of another key."""
    return ErrorMessage("only_with", key=key, found=shown(value), needed=tuple(map(shown, wanted[:5])))


# words of books for keys
_OF_BOOKS = (("brake", "effective"), ("calorific", "heating"), ("moment_of_inertia", "inertia"), ("diameter", "bore"),
             ("swept_volume", "displacement"), ("bmep", "effective_mean_pressure"))  # fmt: skip


def nearest_name(word: str, options: Iterable[str]) -> str:
    """Return the option closest to a misspelt word, empty if none is close."""
    matches = difflib.get_close_matches(word[:60], list(options), n=1, cutoff=0.6)
    return matches[0] if matches else ""


def _advice(name: str, entry: KeySpec, prefix: str) -> str:
    """Return an example of a missing key; `prefix`: of the keys of its table."""
    if entry.example:
        return f"{name} = {entry.example}"
    wanted = entry.kind.entry if isinstance(entry.kind, ListOf) and entry.kind.may_be_one else entry.kind
    match wanted:
        case Quantity() as kind:
            return f'{name} = "{units.EXAMPLES[kind.dimensions[0]]}"'
        case Number() as kind:
            return f"{name} = {kind.example()}"
        case Choice() as kind:
            return f"{name} = {shown(kind.options[0])}"
        case Text():
            return f'{name} = "..."'
        case TableSpec():
            return ErrorMessage("a_table", key=f"{prefix}{name}")
        case MapOf():
            return ErrorMessage("tables_of_names", key=f"{prefix}{name}")
        case ListOf(Text()):
            return f'{name} = ["A", "B"]'
        case ListOf(Quantity() as kind):
            return f'{name} = ["{units.EXAMPLES[kind.dimensions[0]]}", ...]'
        case _:
            return f"{name} = [...]"


def stated_numbers(values: Mapping[str, Any]) -> dict[str, InputNumber]:
    """Return the numbers of read values by path; entries of lists are counted from 1, `efficiency.chain[2]`."""
    return dict(_numbers("", values))


def _numbers(path: str, value: Any) -> Iterator[tuple[str, InputNumber]]:  # noqa: ANN401 - tables, lists and quantities
    match value:
        case MeasuredValue():
            yield path, InputNumber(value.value, value.unit)
        case bool():
            return
        case int() | float():
            yield path, InputNumber(float(value))
        case str() if match := re.fullmatch(r"(\d+) deg", value):
            yield path, InputNumber(math.radians(float(match[1])), "deg")
        case Mapping():
            for name, item in value.items():
                yield from _numbers(f"{path}.{name}" if path else name, item)
        case list():
            for index, item in enumerate(value, start=1):
                yield from _numbers(f"{path}[{index}]", item)


def mistaken_names(values: Mapping[str, Any]) -> Iterator[tuple[str, str, str]]:
    """Yield path, Cyrillic letters and Latin spelling of names that are another name of the file but for these."""
    words = [(path, text) for path, text in _words("", values) if path != "title"]
    names = {text for _, text in words}
    for path, text in words:
        if (letters := look_alikes(text)) and text.translate(TO_LATIN) in names:
            yield path, letters, text.translate(TO_LATIN)


def _words(path: str, value: Any) -> Iterator[tuple[str, str]]:  # noqa: ANN401 - tables, lists and texts
    """Yield texts and names of tables by path."""
    if isinstance(value, str):
        yield path, value
    items = (
        value.items() if isinstance(value, Mapping) else enumerate(value, start=1) if isinstance(value, list) else ()
    )
    for name, item in items:
        inner = f"{path}[{name}]" if isinstance(name, int) else f"{path}.{name}".lstrip(".")
        if isinstance(name, str):
            yield inner, name
        yield from _words(inner, item)


def file_inputs(values: Values, written: Mapping[str, Any]) -> FileInputs:
    """Return the inputs of a file: `values` as read, `written` as they stand in it."""
    return FileInputs(dict(_stated(written, values, "")), dict(_defaults(values, "")))


def _stated(written: Any, read: Any, path: str, meaning: str = "") -> Iterator[tuple[str, FileInput]]:  # noqa: ANN401
    """Yield every value that a file states, by path."""
    if isinstance(written, Mapping):
        table = read.table if isinstance(read, Values) else None
        for name, item in written.items():
            inner = read.get(name) if isinstance(read, Mapping) else None
            own = meaning if table is None else _meaning(table, name)
            yield from _stated(item, inner, f"{path}.{name}" if path else name, own)
    elif isinstance(written, list):
        entries = read if isinstance(read, list) else [None] * len(written)
        for number, (item, inner) in enumerate(zip(written, entries, strict=False), start=1):
            yield from _stated(item, inner, f"{path}[{number}]", meaning)
    else:
        yield path, FileInput(written, meaning)


def _defaults(values: Any, path: str) -> Iterator[tuple[str, FileInput]]:  # noqa: ANN401 - tables, lists and values
    """Yield the default of every key that a table of a file could state and does not, by path."""
    if isinstance(values, list):
        for number, item in enumerate(values, start=1):
            yield from _defaults(item, f"{path}[{number}]")
    elif isinstance(values, Values):
        for name, spec in values.table.keys.items():
            inner = f"{path}.{name}" if path else name
            if name in values:
                yield from _defaults(values[name], inner)
            elif isinstance(spec.kind, TableSpec) and _holds(name, values):
                yield from _defaults(Values({}, spec.kind, values), inner)
            elif (default := values.table.written_default(name, values)) is not None:
                yield inner, FileInput(default, _meaning(values.table, name))
    elif isinstance(values, Mapping):
        for name, item in values.items():
            yield from _defaults(item, f"{path}.{name}")


def _holds(name: str, values: Values) -> bool:
    """Return whether the defaults of a table hold where it is left out."""
    if name == "cylinder":
        return "rod" in values
    if values.table.name == "driver":
        return False
    return name in ("method", "rod", "motor_selection") or (name == "timing" and values["kind"] == "wiebe")


def _meaning(table: TableSpec, name: str) -> str:
    """Return the key of the text about a field, empty if it has none."""
    keys = (f"fields.{table.name}.{name}", f"fields.{name}")
    return next((key for key in keys if has_text(key)), "")
