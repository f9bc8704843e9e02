"""Changes to a machine file as text: what is not changed stays as it is, comments, order and layout too."""

from __future__ import annotations

import datetime as dt
import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

from crankwork.description.locate import Places, Span

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def toml(value: Any) -> str:  # noqa: ANN401 - whatever TOML holds
    """Return a value as TOML writes it.

    Examples
    --------
    >>> toml({"joins": ["A", "B"], "mass": "1 kg", "of two": 2.0})
    '{ joins = ["A", "B"], mass = "1 kg", "of two" = 2.0 }'
    """
    match value:
        case bool():
            return str(value).lower()
        case dt.date():
            return value.isoformat()
        case str():
            return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
        case Mapping():
            return f"{{ {', '.join(f'{key_text(key)} = {toml(one)}' for key, one in value.items())} }}"
        case list() | tuple():
            return f"[{', '.join(map(toml, value))}]"
    return str(value)


def document(values: Mapping[str, Any]) -> str:
    """Return a whole machine file, what stands outside of tables first.

    Examples
    --------
    >>> print(document({"crank": {"radius": "45 mm"}, "title": "Pump"}), end="")
    title = "Pump"
    <BLANKLINE>
    [crank]
    radius = "45 mm"
    """
    tables = {key: one for key, one in values.items() if isinstance(one, Mapping)}
    lines = [f"{key_text(key)} = {toml(one)}" for key, one in values.items() if key not in tables]
    for key, table in tables.items():
        lines += ["", f"[{key_text(key)}]", *(f"{key_text(name)} = {toml(one)}" for name, one in table.items())]
    return "\n".join([*lines, ""]).lstrip("\n")


def key_text(name: str) -> str:
    """Return the name of a key as TOML writes it."""
    return name if _BARE.fullmatch(name) else toml(name)


def with_value(source: str, key: str, value: Any, gives_way: tuple[str, ...] = ()) -> str:  # noqa: ANN401
    """Return a text with a value under a dotted key, `loads[2].stiffness`.

    `gives_way`: keys that say the same; the first of them that has a line makes room, the others go.
    """
    around, name = _split(key)
    places = Places(source)
    others = [one for one in (f"{around}.{one}".lstrip(".") for one in gives_way) if one in places.lines]
    room = next((one for one in others if one in places.pairs and key not in places.lines), None)
    if room is not None:
        source = _replaced(source, places.pairs[room], f"{key_text(name)} = {toml(value)}")
    for other in others:
        source = source if other == room else without(source, other)
    if room is not None:
        return source
    places = Places(source)
    if key in places.values:
        return _replaced(source, places.values[key], toml(value))
    return (_with_table if key in places.lines else _with_new)(source, places, key, value)


def _with_new(source: str, places: Places, key: str, value: Any) -> str:  # noqa: ANN401
    """Return a text with a key that does not stand there yet."""
    around, name = _split(key)
    pair = f"{key_text(name)} = {toml(value)}"
    if around in places.inner:
        start, last = places.inner[around]
        return _replaced(source, Span(last, last), f"{',' * (last > start)} {pair}{' ' * (last == start)}")
    if isinstance(value, Mapping) and not around:
        return _with_block(source, key, value)
    if around in places.ends or not around:
        return _with_line(source, places, around, pair)
    further, last_name = _split(around)
    if any(one.startswith(f"{around}.") for one in places.pairs) and around not in _tables(places):
        # a table that only dotted keys make
        return _with_line(source, places, further, f"{key_text(last_name)}.{pair}")
    if not further or around in places.lines:
        return _with_block(source, around, {name: value})
    return with_value(source, around, {name: value})


def with_entry(source: str, key: str, values: Mapping[str, Any]) -> str:
    """Return a text with a table more in a list of tables.

    Examples
    --------
    >>> with_entry('loads = [{ kind = "force" }]', "loads", {"kind": "spring"})
    'loads = [{ kind = "force" }, { kind = "spring" }]'
    """
    found = Places(source).values.get(key)
    if found is None:
        return _with_block(source, key, values, "[[{}]]")
    inside = source[found.start : found.end].rstrip("]").rstrip().rstrip(",")
    return _replaced(source, found, f"{inside}{', ' * (inside != '[')}{toml(values)}]")


def without(source: str, key: str) -> str:
    """Return a text without a key or a table, and without what is said beside it."""
    places = Places(source)
    is_entry = key.endswith("]") and key in places.values
    if key not in places.pairs and not is_entry:
        return _without_table(source, key)
    start, end = places.values[key] if is_entry else places.pairs[key]
    around, _ = _split(key)
    if is_entry or around in places.inner:
        before, after = source[:start].rstrip(), source[end:].lstrip()
        if before.endswith(","):
            return f"{before[:-1].rstrip()}{source[end:]}"
        return f"{source[:start]}{after[1:].lstrip()}" if after.startswith(",") else source[:start] + source[end:]
    return source[: _line_start(source, start)] + source[_line_end(source, end) + 1 :]


def _split(key: str) -> tuple[str, str]:
    around, _, name = key.rpartition(".")
    return around, name


def _replaced(source: str, span: Span, text: str) -> str:
    return source[: span.start] + text + source[span.end :]


def _line_start(source: str, at: int) -> int:
    return source.rfind("\n", 0, at) + 1


def _line_end(source: str, at: int) -> int:
    end = source.find("\n", at)
    return end if end >= 0 else len(source)


def _with_line(source: str, places: Places, around: str, pair: str) -> str:
    """Return a text with a line behind the last one of a table."""
    if around in places.ends:
        at = _line_end(source, places.ends[around])
        return f"{source[:at]}\n{pair}{source[at:]}"
    # before everything but what is said of the file at its beginning
    head = re.match(r"(?:#[^\n]*\n)*", source)
    at = head.end() if head else 0
    gap = "\n" if at else ""
    return f"{source[:at]}{gap}{pair}\n{source[at:]}"


def _with_block(source: str, name: str, values: Mapping[str, Any], head: str = "[{}]") -> str:
    """Return a text with a table at its end."""
    pairs = "".join(f"{key_text(key)} = {toml(one)}\n" for key, one in values.items())
    gap = "" if not source.strip() else "\n" if source.endswith("\n") else "\n\n"
    return f"{source}{gap}{head.format('.'.join(map(key_text, name.split('.'))))}\n{pairs}"


def _with_table(source: str, places: Places, key: str, value: Any) -> str:  # noqa: ANN401
    """Return a text with other values in a table that has lines of its own, or another value in its place."""
    if not isinstance(value, Mapping) or key not in places.ends:
        return with_value(_without_table(source, key), key, value)
    for name in dict.fromkeys(_below(places, key)):
        if name not in value:
            source = without(source, f"{key}.{name}")
    for name, one in value.items():
        source = with_value(source, f"{key}.{name}", one)
    return source


def _below(places: Places, key: str) -> Iterator[str]:
    """Yield the names of what stands in a table."""
    for one in places.lines:
        if one.startswith(f"{key}."):
            yield re.split(r"[.\[]", one.removeprefix(f"{key}."), maxsplit=1)[0]


def _without_table(source: str, key: str) -> str:
    """Return a text without a table that has lines of its own, and without those below it."""
    # entries of a list that follow have its number once it is gone
    for pair in [one for one in Places(source).pairs if one.startswith(f"{key}.")]:
        source = without(source, pair)
    headers = Places(source).headers
    ends = [*(start for _, start in headers[1:]), len(source)]
    for (name, start), end in reversed(list(zip(headers, ends, strict=False))):
        if name == key or name.startswith((f"{key}.", f"{key}[")):
            source = source[: _line_start(source, start)] + source[_block_end(source, start, end) :]
    return source


def _tables(places: Places) -> set[str]:
    """Return the names of tables with lines of their own, and of those around them."""
    parts = (re.split(r"[.\[]", name) for name, _ in places.headers)
    return {".".join(names[:count]) for names in parts for count in range(1, len(names) + 1)}


def _block_end(source: str, start: int, end: int) -> int:
    """Return where a table ends whose next one begins at `end`: before the comment that heads that one."""
    lines = source[start:end].splitlines(keepends=True)
    while end < len(source) and len(lines) > 1 and lines[-1].startswith("#"):
        lines.pop()
    return start + len("".join(lines))
