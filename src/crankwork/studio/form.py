"""A machine file as a form: its fields with meanings and values, and the fields that may be added."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from crankwork.description.document import Description
from crankwork.description.machine_file import entry_at, file_keys, idle_keys, steps_of
from crankwork.description.numeric_field import single_kind
from crankwork.description.schema import DefaultBy, KeySpec, ListOf, NameOr, NumberOr, TableSpec, Values, WordOr
from crankwork.description.toml_edit import toml
from crankwork.description.value_types import Choice, Flag, MeasuredValue, Number, Quantity, Reader, Text
from crankwork.errors import CrankworkError
from crankwork.locale import Language
from crankwork.units import EXAMPLES, from_si

_NUMBER = re.compile(r"\s*[+-]?[0-9][0-9.,]*(?:[eE][+-]?[0-9]+)?\s*")
_COMMA = re.compile(r"(\s*[+-]?[0-9]+),([0-9]+)(?![0-9.,])")
_THOUSANDS = 3
# coordinates of a point by index
_AXES = {"1]": "x", "2]": "y"}
_LEAVES = (Quantity, Number, NumberOr, WordOr, Choice, Flag, Text)


def form(description: Description, language: Language) -> list[dict[str, Any]]:
    """Return the tables of a machine file in order, with their fields and those that may be added."""
    values = description.values
    kinds = file_keys(values)
    groups: dict[str, dict[str, Any]] = {}
    for key in _keys(description, kinds):
        path, table, entry = _place(kinds, key)
        means = _meaning(kinds, path, language)
        fresh = {"path": path, "means": means, "label": _label(path, means, language), "rows": [], "more": []}
        group = groups.setdefault(path, fresh)
        group["rows"].append(_row(description, key, table, entry, language))
    idle = idle_keys(kinds, kinds.read(values, "", Reader.of(values)) or Values({}, kinds))
    for path, group in groups.items():
        table, stated = _kind(kinds, path), _stated(values, path)
        if isinstance(table, TableSpec):
            more = _more(table, path, stated, language)
            group["more"] = [row for row in more if row["key"] not in idle]
    return list(groups.values())


def _keys(description: Description, kinds: TableSpec) -> Iterator[str]:
    """Yield the keys of the fields of the machine; a point has one for each coordinate."""
    for key in description:
        match _kind(kinds, key), description[key]:
            case _ if key == "format":
                pass
            case ((ListOf(Quantity(), 2, 2) | NameOr(ListOf(Quantity(), 2, 2))), [_, _]):
                yield from (f"{key}[{number}]" for number in (1, 2))
            case _:
                yield key


def _place(kinds: TableSpec, key: str) -> tuple[str, object, KeySpec | None]:
    """Return the table of a key, its specification, and that of the key."""
    path, _, name = key.rpartition(".")
    table = _kind(kinds, path)
    return path, table, table.keys.get(name) if isinstance(table, TableSpec) else None


def _kind(kinds: TableSpec, path: str) -> object:
    kind: object = kinds
    for step in steps_of(path) if path else ():
        kind = entry_at(kind, step)
    return kind


def _stated(values: Mapping[str, Any], path: str) -> Mapping[str, Any]:
    table: Any = values
    for step in steps_of(path) if path else ():
        table = table[step - 1] if isinstance(step, int) else table.get(step, {})
    return table if isinstance(table, Mapping) else {}


def _meaning(kinds: TableSpec, path: str, language: Language) -> str:
    around, _, name = path.rpartition(".")
    table = _kind(kinds, around)
    return table.meaning(name, language) if path and isinstance(table, TableSpec) else ""


def _row(
    description: Description, key: str, table: object, entry: KeySpec | None, language: Language
) -> dict[str, Any]:
    """Return a field: key, name, meaning, value and how it can be changed."""
    name, stated = key.rpartition(".")[2], description[key]
    kind = entry.kind if entry else _kind(file_keys(description.values), key)
    name, bracket, number = name.partition("[")
    means = table.meaning(name, language) if isinstance(table, TableSpec) else ""
    axis = f", {_AXES[number]}" if bracket else ""
    label = _label(name, means, language)
    row: dict[str, Any] = {"key": key, "name": name + axis, "label": label + axis, "value": _written(kind, stated)}
    if means and means != label:
        row["means"] = means
    match kind:
        case Choice():
            row["options"] = list(map(str, kind.options))
        case Flag():
            row["options"] = ["false", "true"]
        case _:
            row |= _slid(kind, stated)
    return row


def _written(kind: object, stated: object) -> str:
    """Return the value of a field as text, names separated by commas."""
    if isinstance(kind, ListOf) and isinstance(kind.entry, Text) and isinstance(stated, list):
        names = list(map(str, stated))
        if not any("," in name for name in names):
            return ", ".join(names)
    return stated if isinstance(stated, str) else toml(stated)


def _slid(kind: object, stated: object) -> dict[str, Any]:
    """Return the data of a field's slider: number, unit and limits; empty if it has none."""
    match single_kind(kind, stated), stated:
        case Quantity() as numeric, str():
            measure = numeric.read(stated, "", Reader())
            if isinstance(measure, MeasuredValue):
                low, high = (float(from_si(end, measure.unit)) for end in (numeric.low, numeric.high))
                return {"number": float(from_si(measure.value, measure.unit)), "unit": measure.unit,
                        "after": _after(stated), "low": low, "high": high}  # fmt: skip
        case Number() as numeric, int() | float() if not isinstance(stated, bool):
            slider = {"number": float(stated), "unit": "", "after": "", "low": numeric.low, "high": numeric.high}
            return slider | ({"whole": True} if numeric.whole else {})
    return {}


def _label(name: str, means: str, language: Language) -> str:
    """Return the label of a field: its key in English, otherwise the beginning of its meaning."""
    first = re.split(r"[;:(,]| – | \S+ \[", means)[0].strip()
    return first if first[:1].isalpha() and language != "en" else name


def _after(stated: str) -> str:
    """Return the text after the number: unit and tolerance."""
    match = _NUMBER.match(stated)
    return f" {stated[match.end() :]}" if match else ""


def _more(table: TableSpec, path: str, stated: Mapping[str, Any], language: Language) -> Iterator[dict[str, Any]]:
    """Yield the fields that may be added to a table, each with an initial value."""
    for name, entry in table.keys.items():
        excluded = any(other in stated for other in entry.instead_of)
        fits = all(stated.get(key) in allowed if allowed else key in stated for key, allowed in entry.only.items())
        if name in stated or excluded or not fits or not isinstance(entry.kind, _LEAVES):
            continue
        first = (
            first_value(entry.kind) if entry.default is None or isinstance(entry.default, DefaultBy) else entry.default
        )
        written, means = first if isinstance(first, str) else toml(first), table.meaning(name, language)
        row: dict[str, Any] = {"key": f"{path}.{name}".lstrip("."), "name": name, "value": written,
                               "means": means, "label": _label(name, means, language)}  # fmt: skip
        if name == "mass" and "centre" in table.keys and "centre" not in stated and "joins" in stated:
            # a mass needs its centre
            row["also"] = {f"{path}.centre": _middle(stated)}
        yield row


def _middle(link: Mapping[str, Any]) -> str:
    """Return the middle of a link with a length, otherwise its first joint."""
    length = Quantity(("length",), 0.0, 1e3).read(link.get("length"), "", Reader())
    if length is None:
        return str(link["joins"][0])
    return toml([f"{from_si(length.value, length.unit) / 2:.4g} {length.unit}", f"0 {length.unit}"])


def first_value(kind: object) -> object:
    """Return an initial value of a type."""
    match kind:
        case Quantity(dimensions=("mass", *_)):
            return "1 kg"
        case Quantity():
            return EXAMPLES[kind.dimensions[0]]
        case Number():
            return float(kind.example())
        case Choice():
            return kind.options[0]
        case Flag():
            return True
        case NumberOr():
            return first_value(kind.quantity)
        case WordOr():
            return first_value(kind.words)
    return "..."


def stated_text(description: Description, key: str, typed: str, language: Language = "en") -> object:
    """Parse text typed into a field: text if the field holds text, otherwise TOML.

    A bare number gets the unit of the field, and a comma is a decimal comma unless it may separate thousands.
    """
    kind = single_kind(_kind(file_keys(description.values), key), description.get(key))
    if isinstance(kind, Text):
        return typed
    if isinstance(kind, ListOf) and isinstance(kind.entry, Text) and not typed.lstrip().startswith("["):
        return [text.strip() for text in typed.split(",")]
    if isinstance(kind, Quantity | Number):
        comma = _COMMA.match(typed)
        if comma and description.get("decimal_mark") != "," and (language != "en" or len(comma[2]) != _THOUSANDS):
            typed = f"{comma[1]}.{comma[2]}{typed[comma.end() :]}"
        stated = description.get(key)
        if isinstance(stated, str) and _NUMBER.fullmatch(typed):
            typed = typed.strip() + _after(stated)
    values: dict[str, Any]
    try:
        values = Description(f"value = {typed}\n").values if "\n" not in typed else {}
    except CrankworkError:
        return typed
    return values.get("value", typed)
