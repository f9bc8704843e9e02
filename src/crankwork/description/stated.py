"""What a machine file states and what it leaves to defaults, by path: numbers, names, inputs."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any

from crankwork.description.schema import TableSpec, Values
from crankwork.description.value_types import MeasuredValue, look_alikes
from crankwork.locale import has_text
from crankwork.machine import FileInput, FileInputs, InputNumber
from crankwork.units import TO_LATIN


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
    return name in ("method", "rod", "motor_selection") or (name == "timing" and values["kind"] == "wiebe")


def _meaning(table: TableSpec, name: str) -> str:
    """Return the key of the text about a field, empty if it has none."""
    keys = (f"fields.{table.name}.{name}", f"fields.{name}")
    return next((key for key in keys if has_text(key)), "")
