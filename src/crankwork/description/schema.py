"""What a table of the machine file holds: fields that are stated once, and lists and tables of values."""

from __future__ import annotations

import difflib
import functools
import inspect
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

from crankwork import units
from crankwork.description.kinds import Choice, Kind, Measure, Number, Quantity, Reader, Text, is_one_line, shown
from crankwork.locale import Language, Refusal, say, texts

_MAX_ENTRIES = 10_000
_LONGEST_NAME = 60


class ListOf(NamedTuple):
    """A list whose entries are of one kind; `from_file`: or a column of the file that stands beside it.

    A single value may stand for a list of one that is `from_file`.
    """

    entry: Kind
    fewest: int = 0
    most: int = _MAX_ENTRIES
    from_file: bool = False

    @property
    def may_be_one(self) -> bool:
        """Whether a single value may stand for the list."""
        return self.from_file and self.fewest == 1

    def read(self, value: object, key: str, reader: Reader) -> list[Any] | None:
        """Return the entries; a bad one is left out after its complaint."""
        if self.may_be_one and isinstance(value, str) and not reader.doubts(key):
            return [self.entry.read(value, key, reader)]
        if not isinstance(value, list):
            # what a file that is none would have held is not told
            if not (self.from_file and reader.doubts(key)):
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
        match self.entry:
            case Quantity(dimensions=(first, *_)):
                example = f'"{units.EXAMPLES[first]}"'
            case Number():
                example = self.entry.example()
            case _:
                example = '"a"'
        if self.from_file:
            return Refusal("list_or_file", example=", ".join([example] * self.fewest))
        return Refusal("list_like", example=f"[{example}]")

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

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of an array with arrays in it."""
        one = self.entry.schema(language)
        return {
            "type": "array",
            "items": {"anyOf": [one, {"type": "array", "items": one, "minItems": 1}]},
            "minItems": 1,
        }


class OneOrMore(NamedTuple):
    """A value of one kind, or a list of them."""

    entry: Kind
    most: int

    def read(self, value: object, key: str, reader: Reader) -> tuple[Any, ...] | None:
        """Return the values; a bad one is left out after its complaint."""
        if not isinstance(value, list):
            one = self.entry.read(value, key, reader)
            return None if one is None else (one,)
        found = ListOf(self.entry, fewest=1, most=self.most).read(value, key, reader)
        return None if found is None else tuple(one for one in found if one is not None)

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of either."""
        own = self.entry.schema(language)
        return {"anyOf": [own, {"type": "array", "items": own, "minItems": 1, "maxItems": self.most}]}


class NameOr(NamedTuple):
    """A name, or a value of another kind."""

    other: Kind

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
    """A quantity with its unit, or a plain number."""

    quantity: Quantity
    number: Number

    def read(self, value: object, key: str, reader: Reader) -> Measure | float | None:
        """Return the quantity of a text and the number of a number."""
        return (self.quantity if isinstance(value, str) else self.number).read(value, key, reader)

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of either."""
        return {"anyOf": [self.quantity.schema(language), self.number.schema(language)]}


class Named(NamedTuple):
    """A table whose keys are names of the user's own, all values of one kind.

    `deep`: how many tables within each other dots of a name make, that are read as one.
    """

    entry: Kind
    most: int = _MAX_ENTRIES
    deep: int = 0

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

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of a mapping."""
        names = {"minLength": 1, "maxLength": _LONGEST_NAME}
        own = below = self.entry.schema(language)
        for _ in range(self.deep):
            below = {"anyOf": [own, {"type": "object", "additionalProperties": below}]}
        return {"type": "object", "additionalProperties": below, "propertyNames": names,
                "maxProperties": self.most}  # fmt: skip


class By(NamedTuple):
    """A default that follows from what stands beside it: the key that decides, and the default by its value."""

    key: str
    values: Mapping[str, Any]


Made = TypeVar("Made")


class Key(NamedTuple):
    """A field of a table: its kind, its default as a file would state it, and when it applies.

    `required`: always, or for tables of these kinds; `instead_of`: keys that say the same and exclude it; `only`: what
    must stand beside it, by key the values that it may have, none for any.
    """

    kind: Kind
    required: bool | tuple[str, ...] = False
    instead_of: tuple[str, ...] = ()
    default: Any = None
    only: Mapping[str, tuple[str, ...]] = MappingProxyType({})


class Table(NamedTuple):
    """A table with a fixed set of keys; `name` is the one that texts about its keys begin with."""

    name: str
    keys: Mapping[str, Key]

    def read(self, value: object, key: str, reader: Reader) -> Values | None:
        """Return the values by key."""
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
        values = Values({name: one for name, one in result.items() if one is not None}, self)
        prefix = f"{key}." if key else ""
        for name, entry in self.keys.items():
            if name in value:
                self._check_applies(name, values, prefix, reader)
            elif entry.required is True or (entry.required and values["kind"] in entry.required):
                self._check_there(name, value, values, prefix, reader)
        return values

    def default(self, name: str, beside: Values) -> Any:  # noqa: ANN401 - each kind has its own type
        """Return what a key is taken to be where only others are given, None for nothing."""
        entry = self.keys.get(name)
        match entry.kind if entry else None:
            case Table() as table:
                return Values({}, table)
            case Named():
                return {}
            case ListOf() if entry and entry.default is None:
                return []
        written = self.written_default(name, beside)
        return None if entry is None or written is None else entry.kind.read(written, name, Reader())

    def written_default(self, name: str, beside: Values) -> Any:  # noqa: ANN401 - as a file has it
        """Return the default of a key as a file would state it, None where it has none or does not apply."""
        entry = self.keys.get(name)
        excluding = (one for one in beside if one in self.keys and name in self.keys[one].instead_of)
        if entry is None or self._foreign(entry, beside) or any(excluding):
            return None
        one = entry.default
        return one.values.get(beside[one.key]) if isinstance(one, By) else one

    @staticmethod
    def _foreign(entry: Key, beside: Values) -> tuple[str, tuple[str, ...]] | None:
        """Return the first key, with its values wanted, that keeps a key from applying."""
        for other, wanted in entry.only.items():
            if beside[other] not in wanted if wanted else other not in beside:
                return other, wanted
        return None

    def _check_applies(self, name: str, values: Values, prefix: str, reader: Reader) -> None:
        """Complain of a key that means nothing beside the others."""
        missed = self._foreign(self.keys[name], values)
        if missed is None or reader.doubts(f"{prefix}{missed[0]}"):
            return
        other, wanted = missed
        if wanted:
            reader.complain(f"{prefix}{name}", means_nothing(other, values[other], wanted))
        else:
            advice = _advice(other, self.keys[other].kind, prefix)
            reader.complain(f"{prefix}{name}", Refusal("only_beside", key=other, advice=advice))

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

    def _check_there(self, name: str, value: Mapping[str, object], values: Values, prefix: str, reader: Reader) -> None:
        """Complain if a required key is missing, and so are those that could stand in its place."""
        entry = self.keys[name]
        alternatives = (name, *entry.instead_of)
        told = reader.doubts(*(f"{prefix}{one}" for one in (*alternatives, *entry.only)))
        if told or any(one in value for one in alternatives) or self._foreign(entry, values):
            return
        advice = tuple(_advice(one, self.keys[one].kind, prefix) for one in alternatives)
        reader.complain(f"{prefix}{name}", Refusal("missing", advice=advice))

    def schema(self, language: Language, /) -> dict[str, Any]:
        """Return the schema of an object."""
        properties, beside = {}, {}
        for name, entry in self.keys.items():
            own = entry.kind.schema(language)
            parts = [self.meaning(name, language), *_applies(entry, language), own.get("description")]
            described = "; ".join(part for part in parts if part)
            default = {} if entry.default is None or isinstance(entry.default, By) else {"default": entry.default}
            properties[name] = {**own, "description": described, **default}
            if entry.only or entry.instead_of:
                beside[name] = self._beside(entry)
        always = [name for name, one in self.keys.items() if one.required is True and not (one.only or one.instead_of)]
        rules = [self._needed(name, one) for name, one in self.keys.items() if one.required and name not in always]
        return {"type": "object", "properties": properties, "required": always, "additionalProperties": False,
                "dependentSchemas": beside, **({"allOf": rules} if rules else {})}  # fmt: skip

    @staticmethod
    def _needed(name: str, entry: Key) -> dict[str, Any]:
        """Return the schema of a table that needs a key, or one that says the same, for some of its kinds."""
        there = {"anyOf": [{"required": [one]} for one in (name, *entry.instead_of)]}
        cases = {"kind": entry.required} if isinstance(entry.required, tuple) else entry.only
        here = {"properties": {key: {"enum": list(values)} for key, values in cases.items()}, "required": list(cases)}
        return {"if": here, "then": there} if cases else there

    def _beside(self, entry: Key) -> dict[str, Any]:
        """Return the schema of a table in which a key stands."""
        wanted = {other: {"enum": list(values)} for other, values in entry.only.items() if values}
        stated = [other for other, values in entry.only.items() if self.keys[other].default not in values or not values]
        none = {"not": {"anyOf": [{"required": [other]} for other in entry.instead_of]}} if entry.instead_of else {}
        return {"properties": wanted, "required": stated, **none}

    def meaning(self, name: str, language: Language) -> str:
        """Return what a key means, in this table or in every one."""
        known = texts("fields", language)
        return known.get(f"{self.name}.{name}") or known.get(name, "")


class Values(dict[str, Any]):
    """What a table states. What it leaves out has its default when it is asked for, and is not `in` it."""

    def __init__(self, stated: Mapping[str, Any], table: Table) -> None:
        super().__init__(stated)
        self.table = table

    def __missing__(self, name: str) -> Any:  # noqa: ANN401 - each kind has its own type
        return self.table.default(name, self)

    def si(self, name: str) -> Any:  # noqa: ANN401 - a number, a word, or None
        """Return a value, that of a quantity in SI; None where there is none."""
        value = self[name]
        return value.value if isinstance(value, Measure) else value

    def degrees(self, name: str) -> Any:  # noqa: ANN401 - a number, several of a list, or None
        """Return an angle in degrees, without what radians have added to it; None where there is none."""
        value = self[name]
        if isinstance(value, list):
            return [_degrees(one) for one in value if one is not None]
        return None if value is None else _degrees(value)

    def made(self, kind: Callable[..., Made], **others: Any) -> Made:  # noqa: ANN401 - each field has its own type
        """Return an object that has these values in SI in fields of the same names, and `others`."""
        own = {name: self.si(name) for name in _fields_of(kind) if name in self.table.keys}
        return kind(**{**own, **others})

    def but(self, **changes: Any) -> Values:  # noqa: ANN401 - each kind has its own type
        """Return these values with others in their place."""
        return Values({**self, **changes}, self.table)


@functools.cache
def _fields_of(kind: Callable[..., Any]) -> tuple[str, ...]:
    return tuple(inspect.signature(kind).parameters)


def _degrees(angle: Measure) -> float:
    return round(math.degrees(angle.value), 9)


def _applies(entry: Key, language: Language) -> Iterator[str]:
    """Yield in words what must stand beside a key, and a default that follows from it."""
    for key, values in entry.only.items():
        yield say("fields.with", language, condition=" | ".join(f"{key} = {one}" for one in values) or key)
    if isinstance(entry.default, By):
        for default in dict.fromkeys(entry.default.values.values()):
            cases = [f"{entry.default.key} = {case}" for case, one in entry.default.values.items() if one == default]
            yield say("fields.default_with", language, default=default, condition=" | ".join(cases))


def means_nothing(key: str, found: object, wanted: tuple[str, ...]) -> Refusal:
    """Return what is said of a key that applies only where another one is something else."""
    return Refusal("only_with", key=key, found=shown(found), needed=tuple(map(shown, wanted[:5])))


def nearest_name(word: str, options: Iterable[str]) -> str:
    """Return the option nearest to a misspelt word, or nothing if none is near."""
    matches = difflib.get_close_matches(word[:60], list(options), n=1, cutoff=0.6)
    return matches[0] if matches else ""


def _advice(name: str, kind: Kind, prefix: str) -> str:
    """Return what to write for a missing key of the table whose keys begin with `prefix`."""
    match kind:
        case Quantity():
            return f'{name} = "{units.EXAMPLES[kind.dimensions[0]]}"'
        case Number():
            return f"{name} = {kind.example()}"
        case Choice():
            return f"{name} = {shown(kind.options[0])}"
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
