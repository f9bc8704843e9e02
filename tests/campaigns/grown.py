"""Machine files grown by chance from examples, templates and machines of the tests, so that every key occurs."""

from __future__ import annotations

import copy
import functools
import random
import re
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from crankwork.description.machine_file import entry_at, file_keys, read_machine
from crankwork.description.schema import (
    InertiaKind,
    ListOf,
    MapOf,
    NameOr,
    Nested,
    NumberOr,
    OneForAll,
    OneOrMore,
    TableSpec,
    WordOr,
)
from crankwork.description.value_types import Choice, Flag, Number, Quantity, UnitOf
from crankwork.errors import CrankworkError
from crankwork.units import EXAMPLES, spellings
from expansions import ROOT, machine_files, written

Values = dict[str, Any]
# attempts at one change, most of which are refused
_ATTEMPTS = 60
# they change no result, or name a file
_LEFT = re.compile(r"title|document|format|units|decimal_mark|table|source|file|sheet|trials|modes|time_unit")
# of a length, a pressure and so on, times which a value is likely: the example of a dimension is of no machine
_SIZE = re.compile(r"([-+]?[\d.]+(?:[eE][-+]?\d+)?)(.*)", re.DOTALL)


@functools.cache
def files() -> dict[str, str]:
    """Return the files to begin with."""
    return machine_files("examples", "tests/machines")


@functools.cache
def _seen() -> dict[tuple[str, object], list[Any]]:
    """Return the values that the files have, by key and kind."""
    values: dict[tuple[str, object], list[Any]] = {}
    for text in files().values():
        tables = tomllib.loads(text)
        for table, spec in _tables(tables, file_keys(tables)):
            for name, value in table.items():
                if name in spec.keys and not isinstance(value, Mapping):
                    values.setdefault((spec.name, name), []).append(value)
    return values


def _tables(value: Any, kind: object) -> Iterator[tuple[Values, TableSpec]]:
    """Yield the tables in a value, with the keys that each may have."""
    kind = kind.other if isinstance(kind, NameOr) else kind
    if isinstance(value, dict):
        if isinstance(kind, TableSpec):
            yield value, kind
        for name, item in value.items():
            yield from _tables(item, entry_at(kind, name))
    elif isinstance(value, list):
        for number, item in enumerate(value, start=1):
            yield from _tables(item, entry_at(kind, number))


def grown_file(seed: int, number: int) -> tuple[str, Path]:
    """Return the text of a machine file that no rule refuses, and the folder of its data."""
    draw = random.Random(f"grown {seed} {number}")  # noqa: S311 - no secret
    name = draw.choice(sorted(files()))
    values = tomllib.loads(files()[name])
    folder = ROOT / ("tests/machines" if (ROOT / "tests" / "machines" / f"{name}.toml").exists() else "examples")
    wanted = draw.choice((1, 2, 3, 4, 6))
    for _ in range(_ATTEMPTS):
        other = copy.deepcopy(values)
        draw.choice((_add, _add, _add, _alter, _drop))(draw, other)
        try:
            if other == values or read_machine(written(other), folder=folder) is None:
                continue
        except (CrankworkError, RecursionError):
            continue
        values, wanted = other, wanted - 1
        if not wanted:
            break
    return written(values), folder


def _add(draw: random.Random, values: Values) -> None:
    """Put a key into one of the tables, what it needs with it, and take out what it stands for."""
    tables = [(table, spec) for table, spec in _tables(values, file_keys(values)) if spec.keys.keys() - table.keys()]
    table, spec = draw.choice(tables)
    _put(draw, table, spec, draw.choice(sorted(spec.keys.keys() - table.keys())), values)


def _put(draw: random.Random, table: Values, spec: TableSpec, name: str, values: Values, depth: int = 0) -> None:
    key = spec.keys[name]
    if _LEFT.fullmatch(name) or depth > 4:
        return
    for other in (*key.instead_of, *(other for other in spec.keys if name in spec.keys[other].instead_of)):
        table.pop(other, None)
    value = _value(draw, key.kind, (spec.name, name), values, depth)
    if value is None:
        return
    table[name] = value
    for other, options in key.only.items():
        if options and table.get(other, spec.keys[other].default) not in options:
            table[other] = draw.choice(options)
        elif not options and other not in table:
            _put(draw, table, spec, other, values, depth + 1)


def _value(draw: random.Random, kind: Any, key: tuple[str, str], values: Values, depth: int) -> Any:  # noqa: C901, PLR0912 - one case for each kind
    """Return a value of a kind: one that other files have at this key, or one of a likely size."""
    seen = _seen().get(key)
    if seen and draw.random() < 0.7:
        return _scaled(draw, copy.deepcopy(draw.choice(seen)))
    match kind:
        case Quantity():
            return _quantity(draw, kind)
        case Number(low=low, high=high, whole=True):
            return draw.randint(int(low), min(int(high), int(low) + 8))
        case Number(low=low, high=high):
            top = min(high, low + 2.0) if low >= 0 else min(high, 2.0)
            return float(f"{draw.uniform(max(low, -top), top):.4g}")
        case Choice():
            return draw.choice(kind.options)
        case UnitOf():
            return draw.choice(spellings(kind.dimension))
        case Flag():
            return draw.random() < 0.5
        case NumberOr() | WordOr():
            inner = draw.choice([getattr(kind, field) for field in kind._fields])
            return _value(draw, inner, ("", ""), values, depth)
        case InertiaKind():
            return draw.choice(("m l^2 / 12", "0.1 m l^2", _quantity(draw, kind.quantity)))
        case NameOr():
            return draw.choice((_name(draw, values), _value(draw, kind.other, ("", ""), values, depth)))
        case OneForAll() | OneOrMore():
            return _value(draw, draw.choice((kind.entry, ListOf(kind.entry, 1))), ("", ""), values, depth)
        case ListOf():
            count = draw.choice((max(kind.fewest, 1), 2, 3, values.get("engine", {}).get("cylinders", 2)))
            return [_value(draw, kind.entry, ("", ""), values, depth + 1) for _ in range(min(count, kind.most))]
        case Nested():
            return [0.95, [0.9, 0.97]]
        case MapOf():
            return {_name(draw, values): _value(draw, kind.entry, ("", ""), values, depth + 1)}
        case TableSpec():
            table: Values = {}
            optional = [name for name in kind.keys if not kind.keys[name].required]
            for name in [name for name in kind.keys if kind.keys[name].required] + draw.sample(
                optional, min(len(optional), draw.choice((0, 1, 2, 3)))
            ):
                if name not in table and not any(name in kind.keys[other].instead_of for other in table):
                    _put(draw, table, kind, name, values, depth + 1)
            return table
    # a name of a part
    return _name(draw, values)


def _quantity(draw: random.Random, kind: Quantity) -> str:
    number, unit = EXAMPLES[draw.choice(kind.dimensions)].split(" ", 1)
    sign = -1 if kind.low < 0 and draw.random() < 0.2 else 1
    if not kind.above and kind.low <= 0 and draw.random() < 0.1:
        sign = 0
    return f"{sign * float(number) * 10 ** draw.uniform(-1.5, 1.0):.4g} {unit}"


def _name(draw: random.Random, values: Values) -> str:
    """Return a name that stands in the file as a key or a text, or a new one."""
    names = {"a"}

    def look(value: Any, kind: object) -> None:
        if isinstance(value, Mapping):
            names.update(value if isinstance(kind, MapOf) else ())
            for name, item in value.items():
                look(item, entry_at(kind, name))
        elif isinstance(value, list):
            for number, item in enumerate(value, start=1):
                look(item, entry_at(kind, number))

    look(values, file_keys(values))
    crank = values.get("crank", {})
    return draw.choice(sorted(names | {crank[key] for key in ("pivot", "pin") if key in crank}))


def _scaled(draw: random.Random, value: Any) -> Any:
    """Return a value with its numbers, or some of them, a little different."""
    factor = draw.choice((1.0, 0.5, 0.9, 1.1, 1.5))
    match value:
        case bool():
            return value
        case float():
            return float(f"{value * factor:.6g}")
        case str() if found := _SIZE.fullmatch(value):
            return f"{float(found[1]) * factor:.6g}{found[2]}"
        case list():
            return [_scaled(draw, item) for item in value] if draw.random() < 0.5 else value
        case dict():
            return {name: _scaled(draw, item) for name, item in value.items()}
    return value


def _alter(draw: random.Random, values: Values) -> None:
    """Change a value."""
    table, spec = draw.choice(list(_tables(values, file_keys(values))))
    names = [name for name in table if name in spec.keys and not isinstance(table[name], Mapping)]
    if not names:
        return
    name = draw.choice(names)
    kind = spec.keys[name].kind
    if isinstance(kind, Choice | Flag) or draw.random() < 0.2:
        other = _value(draw, kind, (spec.name, name), values, 0)
    else:
        other = _scaled(draw, table[name])
    if other is not None and not _LEFT.fullmatch(name):
        table[name] = other


def _drop(draw: random.Random, values: Values) -> None:
    """Take out a key that need not be there."""
    table, spec = draw.choice(list(_tables(values, file_keys(values))))
    names = [name for name in table if name in spec.keys and not spec.keys[name].required]
    if names:
        del table[draw.choice(names)]
