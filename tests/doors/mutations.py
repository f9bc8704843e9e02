"""Hostile machine files: every example and template with mistakes put into it.

File `i` of a seed is always the same. Half of them go through every wrong value at every place and every key in every
file, the other half are mutated at random.
"""

from __future__ import annotations

import contextlib
import datetime as dt
import functools
import json
import math
import random
import re
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from crankwork import units
from crankwork.description import schema, value_types
from crankwork.description.machine_file import FILES, file_keys, template, template_names

FOLDERS = Path(__file__).parents[2] / "examples", Path(__file__).parents[1] / "machines"
SIZES = (0.0, 5e-324, 1e-300, 1e-30, 1e-15, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9, 1e15, 1e30, 1e300, 1e308)
USUAL = {1e-9, 1e-6, 1e-3, 1, 1e3}
WRONG: tuple[object, ...] = (
    *(f"{sign}{size!r} {{unit}}" for size in SIZES for sign in ("", "-")),
    "nan {unit}", "inf {unit}", "1 parsec", "1,5 {unit}", "{unit}", "1", "", " ", "{unit} 1", "1 {unit} {unit}",
    "\N{ARABIC-INDIC DIGIT FIVE} {unit}", "x" * 3000, "\N{RIGHT-TO-LEFT OVERRIDE}", "$x^$", "%s %n {}", "=1+1",
    "0x10 {unit}",
    True, False, 0, 1, -1, 2, 10**6, 10**400, 1e-300, 1e308, math.nan, math.inf, -math.inf, 0.5, -0.5, 1.5,
    [], {}, [[]], [{}], [1, 2], ["a"], ["1 {unit}"] * 2, ["1 {unit}"] * 3000, [[1] * 40] * 40, {"a": 1},
    {"x": {"y": []}}, dt.date(2000, 1, 1), dt.time(0, 0),
)  # fmt: skip
Place = tuple[str | int, ...]
Values = dict[str, Any]


@functools.cache
def sources() -> dict[str, str]:
    """The files to begin with."""
    paths = [path for folder in FOLDERS for path in sorted(folder.glob("*.toml"))]
    found = {f"{path.parent.name}/{path.name}": path.read_text("utf-8") for path in paths}
    return found | {f"templates/{name}": template(name) for name in template_names()}


@functools.cache
def _systematic() -> tuple[tuple[str, Place, object], ...]:
    """A wrong value at every place, and every key in every file with values of its kind, in an order of no meaning."""
    cases: list[tuple[str, Place, object]] = []
    for name, text in sources().items():
        values = tomllib.loads(text)
        cases += [(name, place, value) for place, _ in _places(values) for value in WRONG]
        cases += [(name, place, value) for place, kind in _keys(file_keys(values), ()) for value in _fitting(kind)]
    random.Random("order").shuffle(cases)  # noqa: S311 - the same order every time
    return tuple(cases)


def _places(value: Any, place: Place = ()) -> Iterator[tuple[Place, Any]]:
    """Every place of some values, tables and lists too."""
    if place:
        yield place, value
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for name, one in entries:
        yield from _places(one, (*place, name))


def _keys(table: schema.TableSpec, place: Place) -> Iterator[tuple[Place, value_types.ValueType]]:
    """Every key that a file can have; names of the user's own are `a`."""
    for name, key in table.keys.items():
        here, kind = (*place, name), key.kind
        yield here, kind
        while isinstance(kind, schema.MapOf | schema.ListOf | schema.NameOr | schema.OneForAll | schema.OneOrMore):
            here += {schema.MapOf: ("a",), schema.ListOf: (0,)}.get(type(kind), ())
            kind = kind.other if isinstance(kind, schema.NameOr) else kind.entry
        if isinstance(kind, schema.TableSpec):
            yield from _keys(kind, here)


def _fitting(kind: value_types.ValueType | None) -> list[Any]:  # noqa: C901, PLR0912 - one case for each kind
    """Values that a key accepts, its limits first."""
    match kind:
        case value_types.Quantity():
            found = []
            for dimension in kind.dimensions:
                unit = units.EXAMPLES[dimension].split()[1]
                near = {one * 10.0**n for one in (kind.low, kind.high) for n in (0, -3, 3, -6)}
                inside = [one for one in sorted(near | USUAL) if kind.low <= one <= kind.high]
                found += [f"{units.from_si(one, unit)!r} {unit}" for one in inside]
            return found
        case value_types.Number(low=low, high=high, whole=True):
            return [int(low), int(high), (int(low) + int(high)) // 2]
        case value_types.Number(low=low, high=high):
            return [low, high, (low + high) / 2, low + 1e-9, high - 1e-9, 0.25]
        case value_types.Choice():
            return list(kind.options)
        case value_types.Flag():
            return [True, False]
        case value_types.Text():
            return ["textbook", "series:3", "A", "a"]
        case schema.ListOf():
            few = [_fitting(kind.entry)[:count] for count in (1, 2, 3, kind.fewest)]
            return few + [[*_fitting(kind.entry)[:1] * n, "?"][:12] for n in (1, 12)]
        case schema.Nested():
            return [[0.9, [0.8, 0.7]]]
        case schema.NameOr():
            return ["a", "petrol", *_fitting(kind.other)]
        case schema.OneForAll() | schema.OneOrMore():
            return [*_fitting(kind.entry), *_fitting(schema.ListOf(kind.entry, 1))]
        case schema.NumberOr() | schema.WordOr():
            return [value for field in kind._fields for value in _fitting(getattr(kind, field))]
        case schema.InertiaKind():
            return ["m l^2 / 12", "0 m l^2", "1e-300 m l^2", "m l^2 / 0", *_fitting(kind.quantity)]
        case value_types.UnitOf():
            return units.spellings(kind.dimension)
        case schema.MapOf():
            return [{"a": one, "b": one} for one in _fitting(kind.entry)[:4]]
        case schema.TableSpec():
            whole = {name: (_fitting(key.kind) or [0])[0] for name, key in kind.keys.items()}
            needed = {name: whole[name] for name, key in kind.keys.items() if key.required}
            return [{}, needed, whole]
    return []


def hostile_file(seed: int, number: int) -> str:
    """Return the text of a file."""
    cases = _systematic()
    if number % 2 == 0:
        # a stride that shares no factor with their number goes through all of them
        name, place, value = cases[(number // 2 + seed * 7919) % len(cases)]
        values = tomllib.loads(sources()[name])
        old = _at(values, place)
        _put(values, place, _in_unit(value, old))
        return written(values)
    draw = random.Random(f"{seed}:{number}")  # noqa: S311 - the same file every time
    name = draw.choice(sorted(sources()))
    values = tomllib.loads(sources()[name])
    for _ in range(draw.choice((1, 1, 1, 2, 2, 3, 5))):
        draw.choice(_MUTATIONS)(draw, values)
        values = _unshared(values)
    text = written(values)
    for _ in range(draw.choice((0, 0, 0, 0, 1, 2))):
        text = draw.choice(_TEXT_MUTATIONS)(draw, text)
    return text


def _at(values: Any, place: Place) -> Any:
    for name in place:
        try:
            values = values[name]
        except (KeyError, IndexError, TypeError):
            return None
    return values


def _put(values: Any, place: Place, value: object) -> None:
    """Put a value at a place, making the tables and lists on the way."""
    *path, last = place
    for name, after in zip(path, place[1:], strict=True):
        inner = _at(values, (name,))
        if not isinstance(inner, list if isinstance(after, int) else dict):
            inner = [] if isinstance(after, int) else {}
            _put(values, (name,), inner)
        values = inner
    if isinstance(values, list) and isinstance(last, int) and last >= len(values):
        values.append(value)
    elif isinstance(values, list) and not isinstance(last, int):
        values.append({last: value})
    else:
        values[last] = value


def _in_unit(value: Any, old: object) -> Any:
    """Return a wrong value with the unit of what it replaces."""
    match value:
        case str():
            unit = old.split()[-1] if isinstance(old, str) and " " in old else "mm"
            return value.replace("{unit}", unit)
        case list():
            return [_in_unit(one, old) for one in value]
        case dict():
            return {name: _in_unit(one, old) for name, one in value.items()}
    return value


def _unshared(value: Any) -> Any:
    """Return values of which no table or list stands in two places, so that none gets into itself."""
    match value:
        case list():
            return [_unshared(one) for one in value]
        case dict():
            return {name: _unshared(one) for name, one in value.items()}
    return value


def _some(draw: random.Random, values: Values) -> Place:
    places = [place for place, _ in _places(values)]
    return draw.choice(places) if places else ("crank",)


def _delete(draw: random.Random, values: Values) -> None:
    place = _some(draw, values)
    inner = _at(values, place[:-1])
    with contextlib.suppress(KeyError, IndexError):
        del inner[place[-1]]


def _rename(draw: random.Random, values: Values) -> None:
    place = _some(draw, values)
    inner, name = _at(values, place[:-1]), place[-1]
    if isinstance(inner, dict) and isinstance(name, str):
        others = name[:-1], name + "s", name.upper(), "a b", "\N{GREEK SMALL LETTER ALPHA}", "a.b", "$x^$", "", "x" * 70
        inner[draw.choice(others)] = inner.pop(name)


def _replace(draw: random.Random, values: Values) -> None:
    place = _some(draw, values)
    _put(values, place, _in_unit(draw.choice(WRONG), _at(values, place)))


def _scale(draw: random.Random, values: Values) -> None:
    """Other numbers of the same sort: a little, or by powers of ten."""
    leaves = [place for place, one in _places(values) if isinstance(one, str | int | float) and type(one) is not bool]
    for place in draw.sample(leaves, min(len(leaves), draw.choice((1, 1, 2, 4, 8)))):
        factor = draw.choice((0.0, -1.0, 0.5, 0.9, 1.1, 2.0, -10.0, *(10.0**n for n in range(-9, 10, 3))))
        old = _at(values, place)
        if isinstance(old, str):
            found = re.match(r"\s*([-+]?\d+\.?\d*(?:e[-+]?\d+)?)(.*)", old, re.ASCII)
            if found:
                _put(values, place, f"{float(found[1]) * factor:.9g}{found[2]}")
        elif abs(old) < 1e300:
            _put(values, place, old * factor if isinstance(old, float) else int(old * factor))


def _stretch(draw: random.Random, values: Values) -> None:
    """Values that their keys accept, many of them limits, in some places that have one."""
    keys = file_keys(values)
    known = [(place, _fitting(_kind_at(keys, place))) for place, one in _places(values) if not isinstance(one, dict)]
    known = [(place, fitting) for place, fitting in known if fitting]
    for place, fitting in draw.sample(known, min(len(known), draw.choice((1, 1, 2, 3)))):
        _put(values, place, draw.choice(fitting))


def _kind_at(kind: value_types.ValueType, place: Place) -> value_types.ValueType | None:
    """What a place of a file holds."""
    for name in place:
        kind = kind.other if isinstance(kind, schema.NameOr) else kind
        match kind:
            case schema.TableSpec() if name in kind.keys:
                kind = kind.keys[name].kind
            case schema.MapOf() | schema.ListOf() | schema.OneForAll() | schema.OneOrMore():
                kind = kind.entry
            case _:
                return None
    return kind


def _swap(draw: random.Random, values: Values) -> None:
    one, other = _some(draw, values), _some(draw, values)
    if one[: len(other)] != other and other[: len(one)] != one:
        first, second = _at(values, one), _at(values, other)
        _put(values, one, second)
        _put(values, other, first)


def _copy(draw: random.Random, values: Values) -> None:
    """A value in a wrong place, or once more in a list."""
    one, other = _some(draw, values), _some(draw, values)
    value = json.loads(json.dumps(_at(values, one), default=str))
    target = _at(values, other)
    if isinstance(target, list):
        target.insert(draw.randrange(len(target) + 1), value)
    elif isinstance(target, dict):
        target[str(one[-1])] = value
    else:
        _put(values, other, value)


def _repeat(draw: random.Random, values: Values) -> None:
    """A list of many times its length."""
    lists = [place for place, one in _places(values) if isinstance(one, list) and one]
    if lists:
        place = draw.choice(lists)
        _put(values, place, (_at(values, place) * draw.choice((2, 3, 30, 1000)))[:12_000])


def _reorder(draw: random.Random, values: Values) -> None:
    lists = [one for _, one in _places(values) if isinstance(one, list) and one]
    if lists:
        draw.shuffle(draw.choice(lists))


def _merge(draw: random.Random, values: Values) -> None:
    """A table of another file."""
    other = tomllib.loads(sources()[draw.choice(sorted(sources()))])
    name = draw.choice(sorted(other))
    values[name] = other[name]


def _add(draw: random.Random, values: Values) -> None:
    """A key somewhere, with a value that suits it."""
    table = draw.choice((file_keys(values), file_keys(values), draw.choice(FILES)))
    for place, kind in draw.sample(list(_keys(table, ())), draw.choice((1, 1, 2, 3))):
        fitting = _fitting(kind)
        names = sorted(_at(values, place[: place.index("a")]) or {"a": 0}) if "a" in place else ["a"]
        named = tuple(draw.choice(names) if one == "a" else one for one in place)
        _put(values, named, draw.choice(fitting) if fitting else 0)


_MUTATIONS: tuple[Callable[[random.Random, Values], None], ...] = (
    _delete, _rename, _replace, *(_scale,) * 6, *(_stretch,) * 6, _swap, _copy,
    _repeat, _reorder, _merge, _add, _add, _add,
)  # fmt: skip


def _twice(draw: random.Random, text: str) -> str:
    lines = text.split("\n")
    lines.insert(draw.randrange(len(lines)), draw.choice(lines))
    return "\n".join(lines)


def _dotted(draw: random.Random, text: str) -> str:
    lines = text.split("\n")
    parts = ("crank", "rod", "gas", "a", "points", '"b c"', "1")
    key = ".".join(draw.choice(parts) for _ in range(draw.choice((2, 3, 9, 40))))
    lines.insert(draw.randrange(len(lines)), f"{key} = 1")
    return "\n".join(lines)


def _cut(draw: random.Random, text: str) -> str:
    at = draw.randrange(len(text) + 1)
    return text[:at] + text[at + draw.choice((1, 1, 2, 5, 100)) :]


def _insert(draw: random.Random, text: str) -> str:
    at = draw.randrange(len(text) + 1)
    put = draw.choice(('"', "[", "]", "{", "}", "=", ".", ",", "\n", "#", "\0", "é", "-", "9", "\\", "'''"))
    return text[:at] + put + text[at:]


_TEXT_MUTATIONS: tuple[Callable[[random.Random, str], str], ...] = (_twice, _dotted, _cut, _insert)


def written(values: Values) -> str:
    """Return values as TOML: tables by headers as far as they go, the rest inline."""
    tables = {name: one for name, one in values.items() if isinstance(one, dict)}
    lines = [*_lines({name: one for name, one in values.items() if name not in tables}, "")]
    return "\n".join([*lines, *(line for name, one in tables.items() for line in _lines(one, _key(name)))])


def _lines(table: Values, header: str) -> Iterator[str]:
    if header:
        yield f"[{header}]"
    for name, one in table.items():
        yield f"{_key(name)} = {_inline(one)}"


def _key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else _inline(name)


def _inline(value: object) -> str:
    match value:
        case bool():
            return str(value).lower()
        case str():
            return json.dumps(value).replace("\x7f", "\\u007f")
        case float():
            return repr(value)
        case list():
            return f"[{', '.join(map(_inline, value))}]" if len(value) < 40 else f"[{','.join(map(_broken, value))}\n]"
        case dict():
            return f"{{ {', '.join(f'{_key(str(name))} = {_inline(one)}' for name, one in value.items())} }}"
        case dt.date() | dt.time():
            return value.isoformat()
    return str(value)


def _broken(value: object) -> str:
    return f"\n{_inline(value)}"
