"""A TOML text: positions of its keys, and changes of it that keep comments, order and layout."""

from __future__ import annotations

import datetime as dt
import json
import re
import tomllib
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

_TOKEN = re.compile(
    r"""
      (?P<long>\"\"\"(?:\\.|[^\\])*?\"{3,5}|'''.*?'{3,5})
    | (?P<text>"(?:\\.|[^"\\\n])*"|'[^'\n]*')
    | (?P<comment>\#[^\n]*)
    | (?P<newline>\n)
    | (?P<mark>\[\[|\]\]|[\[\]{}=,.])
    | (?P<bare>[^\s\[\]{}=,."'\#]+)
    | (?P<space>[^\S\n]+)
    """,
    re.VERBOSE | re.DOTALL,
)
_BARE = re.compile(r"[A-Za-z0-9_-]+")


class _Token(NamedTuple):
    kind: str
    text: str
    line: int
    start: int

    @property
    def end(self) -> int:
        return self.start + len(self.text)


class Span(NamedTuple):
    """A range of characters; `end` is the index after the last."""

    start: int
    end: int


def locate(source: str) -> dict[str, int]:
    """Return the line of every key and table of a valid TOML text.

    Line by dotted key; entries of arrays are counted from one, `gas.pieces[2].law`.
    """
    return TomlPositions(source).lines


class TomlPositions:
    """Positions of keys, values and tables in a valid TOML text, by dotted key.

    `lines` of all; `values` and `pairs`: spans of values without and with their keys; `ends`: end of the last pair of a
    table; `inner`: span of the pairs of an inline table; `headers`: names and starts of tables in order.
    """

    def __init__(self, source: str) -> None:
        self.lines: dict[str, int] = {}
        self.values: dict[str, Span] = {}
        self.pairs: dict[str, Span] = {}
        self.ends: dict[str, int] = {}
        self.inner: dict[str, Span] = {}
        self.headers: list[tuple[str, int]] = []
        self.counts: dict[str, int] = {}
        self.tokens = list(_tokens(source))
        self.at = 0
        self._document()

    def _document(self) -> None:
        prefix = ""
        while self.at < len(self.tokens):
            token = self.tokens[self.at]
            if token.kind == "newline":
                self.at += 1
            elif token.text in ("[", "[["):
                prefix = self._header()
            else:
                self._pair(prefix)
                self.ends[prefix] = self._end()

    def _header(self) -> str:
        opening = self.tokens[self.at]
        self.at += 1
        names = self._key()
        self.at += 1 if self._text() == "]]" or opening.text == "[" else 2
        path = ""
        for name in names[:-1]:
            path = self._join(path, name)
            self.lines.setdefault(path, opening.line)
            path = f"{path}[{self.counts[path]}]" if path in self.counts else path
        path = self._join(path, names[-1])
        if opening.text == "[[":
            self.counts[path] = self.counts.get(path, 0) + 1
            self.lines.setdefault(path, opening.line)
            path = f"{path}[{self.counts[path]}]"
        self.lines[path] = opening.line
        self.headers.append((path, opening.start))
        self.ends[path] = self._end()
        return path

    def _pair(self, prefix: str) -> None:
        first = self.tokens[self.at]
        for name in self._key():
            prefix = self._join(prefix, name)
            self.lines.setdefault(prefix, first.line)
        self.at += 1  # the equals sign
        self._value(prefix)
        self.pairs[prefix] = Span(first.start, self._end())

    def _key(self) -> list[str]:
        names, token = [], self.tokens[self.at]
        while True:
            names.append(_name(token) if token.kind == "text" else token.text)
            self.at += 1
            if self._text() != ".":
                return names
            self.at += 1
            token = self.tokens[self.at]

    def _value(self, path: str) -> None:
        start = self.tokens[self.at].start
        self._skip_value(path)
        self.values[path] = Span(start, self._end())

    def _skip_value(self, path: str) -> None:
        text = self._text()
        if text in ("[", "[["):
            self._array(path)
        elif text == "{":
            self._inline_table(path)
        else:
            # a date or a float is several tokens; everything up to the next separator belongs to it
            while self._text() not in (",", "]", "]]", "}", "") and self.tokens[self.at].kind != "newline":
                self.at += 1

    def _array(self, path: str) -> None:
        self._split("[[")
        self.at += 1
        number = 0
        while True:
            self._skip_newlines()
            self._split("]]")
            if self._text() == "]":
                self.at += 1
                return
            if self._text() == ",":
                self.at += 1
                continue
            number += 1
            self.lines[f"{path}[{number}]"] = self.tokens[self.at].line
            self._value(f"{path}[{number}]")

    def _inline_table(self, path: str) -> None:
        self.at += 1
        start = last = self._end()
        while True:
            self._skip_newlines()
            if self._text() == "}":
                self.at += 1
                self.inner[path] = Span(start, last)
                return
            if self._text() == ",":
                self.at += 1
                continue
            self._pair(path)
            last = self._end()

    def _split(self, double: str) -> None:
        """Split a doubled bracket that opens or closes nested arrays into two tokens."""
        if self._text() == double:
            token = self.tokens[self.at]
            half = token._replace(text=double[0])
            self.tokens[self.at : self.at + 1] = [half, half._replace(start=token.start + 1)]

    def _skip_newlines(self) -> None:
        while self.at < len(self.tokens) and self.tokens[self.at].kind == "newline":
            self.at += 1

    def _end(self) -> int:
        """Return the end of the last token read."""
        return self.tokens[self.at - 1].end

    def _text(self) -> str:
        return self.tokens[self.at].text if self.at < len(self.tokens) else ""

    @staticmethod
    def _join(prefix: str, name: str) -> str:
        return f"{prefix}.{name}" if prefix else name


def _name(token: _Token) -> str:
    """Return the key that a quoted token spells."""
    return str(tomllib.loads(f"name = {token.text}")["name"]) if "\\" in token.text else token.text[1:-1]


def _tokens(source: str) -> Iterator[_Token]:
    line = 1
    for match in _TOKEN.finditer(source):
        kind = str(match.lastgroup)
        if kind not in ("comment", "space"):
            yield _Token(kind, match[0], line, match.start())
        line += match[0].count("\n")


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
            return f"{{ {', '.join(f'{key_text(key)} = {toml(item)}' for key, item in value.items())} }}"
        case list() | tuple():
            return f"[{', '.join(map(toml, value))}]"
    return str(value)


def document(values: Mapping[str, Any]) -> str:
    """Return a machine file as text, keys outside of tables first.

    Examples
    --------
    >>> print(document({"crank": {"radius": "45 mm"}, "title": "Pump"}), end="")
    title = "Pump"
    <BLANKLINE>
    [crank]
    radius = "45 mm"
    """
    tables = {key: item for key, item in values.items() if isinstance(item, Mapping)}
    lines = [f"{key_text(key)} = {toml(item)}" for key, item in values.items() if key not in tables]
    for key, table in tables.items():
        lines += ["", f"[{key_text(key)}]", *(f"{key_text(name)} = {toml(item)}" for name, item in table.items())]
    return "\n".join([*lines, ""]).lstrip("\n")


def key_text(name: str) -> str:
    """Return the name of a key as TOML writes it."""
    return name if _BARE.fullmatch(name) else toml(name)


def with_value(source: str, key: str, value: Any, gives_way: tuple[str, ...] = ()) -> str:  # noqa: ANN401
    """Return a text with a value under a dotted key, `loads[2].stiffness`.

    `gives_way`: equivalent keys; the first that is present is replaced, the others are removed.
    """
    around, name = _split(key)
    places = TomlPositions(source)
    existing = [path for path in (f"{around}.{synonym}".lstrip(".") for synonym in gives_way) if path in places.lines]
    replaced = next((path for path in existing if path in places.pairs and key not in places.lines), None)
    if replaced is not None:
        source = _replaced(source, places.pairs[replaced], f"{key_text(name)} = {toml(value)}")
    for other in existing:
        source = source if other == replaced else without_key(source, other)
    if replaced is not None:
        return source
    places = TomlPositions(source)
    if key in places.values:
        return _replaced(source, places.values[key], toml(value))
    return (_with_table if key in places.lines else _with_new)(source, places, key, value)


def _with_new(source: str, places: TomlPositions, key: str, value: Any) -> str:  # noqa: ANN401
    """Return a text with a new key."""
    around, name = _split(key)
    pair = f"{key_text(name)} = {toml(value)}"
    if around in places.inner:
        start, last = places.inner[around]
        return _replaced(source, Span(last, last), f"{',' * (last > start)} {pair}{' ' * (last == start)}")
    if isinstance(value, Mapping) and not around:
        return _with_block(source, key, value)
    if around in places.ends or not around:
        return _with_line(source, places, around, pair)
    if any(pair_key.startswith(f"{around}.") for pair_key in places.pairs) and around not in _tables(places):
        # a table of dotted keys only, perhaps in another such table
        while around and around not in places.ends:
            around, name = _split(around)
            pair = f"{key_text(name)}.{pair}"
        return _with_line(source, places, around, pair)
    if "." not in around or around in places.lines:
        return _with_block(source, around, {name: value})
    return with_value(source, around, {name: value})


def with_table_entry(source: str, key: str, values: Mapping[str, Any]) -> str:
    """Return a text with a further table in a list of tables.

    Examples
    --------
    >>> with_table_entry('loads = [{ kind = "force" }]', "loads", {"kind": "spring"})
    'loads = [{ kind = "force" }, { kind = "spring" }]'
    """
    span = TomlPositions(source).values.get(key)
    if span is None:
        return _with_block(source, key, values, "[[{}]]")
    inside = source[span.start : span.end].rstrip("]").rstrip().rstrip(",")
    return _replaced(source, span, f"{inside}{', ' * (inside != '[')}{toml(values)}]")


def without_key(source: str, key: str) -> str:
    """Return a text without a key or a table, and without the comment on its line."""
    places = TomlPositions(source)
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


def _line_start(source: str, index: int) -> int:
    return source.rfind("\n", 0, index) + 1


def _line_end(source: str, index: int) -> int:
    end = source.find("\n", index)
    return end if end >= 0 else len(source)


def _with_line(source: str, places: TomlPositions, around: str, pair: str) -> str:
    """Return a text with a line after the last line of a table."""
    if around in places.ends:
        index = _line_end(source, places.ends[around])
        return f"{source[:index]}\n{pair}{source[index:]}"
    # after the comments at the beginning of the file
    head = re.match(r"(?:#[^\n]*\n)*", source)
    index = head.end() if head else 0
    gap = "\n" if index else ""
    return f"{source[:index]}{gap}{pair}\n{source[index:]}"


def _with_block(source: str, name: str, values: Mapping[str, Any], head: str = "[{}]") -> str:
    """Return a text with a table at its end."""
    pairs = "".join(f"{key_text(key)} = {toml(item)}\n" for key, item in values.items())
    gap = "" if not source.strip() else "\n" if source.endswith("\n") else "\n\n"
    return f"{source}{gap}{head.format('.'.join(map(key_text, name.split('.'))))}\n{pairs}"


def _with_table(source: str, places: TomlPositions, key: str, value: Any) -> str:  # noqa: ANN401
    """Return a text with other values in a table with a header, or another value in its place."""
    if not isinstance(value, Mapping) or key not in places.ends:
        return with_value(_without_table(source, key), key, value)
    for name in dict.fromkeys(_below(places, key)):
        if name not in value:
            source = without_key(source, f"{key}.{name}")
    for name, item in value.items():
        source = with_value(source, f"{key}.{name}", item)
    return source


def _below(places: TomlPositions, key: str) -> Iterator[str]:
    """Yield the names of the keys of a table."""
    for path in places.lines:
        if path.startswith(f"{key}."):
            yield re.split(r"[.\[]", path.removeprefix(f"{key}."), maxsplit=1)[0]


def _without_table(source: str, key: str) -> str:
    """Return a text without a table with a header, and without its subtables."""
    # later entries of a list get its number once it is removed
    for pair in [pair_key for pair_key in TomlPositions(source).pairs if pair_key.startswith(f"{key}.")]:
        source = without_key(source, pair)
    headers = TomlPositions(source).headers
    ends = [*(start for _, start in headers[1:]), len(source)]
    for (name, start), end in reversed(list(zip(headers, ends, strict=False))):
        if name == key or name.startswith((f"{key}.", f"{key}[")):
            source = source[: _line_start(source, start)] + source[_block_end(source, start, end) :]
    return source


def _tables(places: TomlPositions) -> set[str]:
    """Return the names of tables with a header, and of their parent tables."""
    parts = (re.split(r"[.\[]", name) for name, _ in places.headers)
    return {".".join(names[:count]) for names in parts for count in range(1, len(names) + 1)}


def _block_end(source: str, start: int, end: int) -> int:
    """Return the end of a table: before the comments above the next table, which begins at `end`."""
    lines = source[start:end].splitlines(keepends=True)
    while end < len(source) and len(lines) > 1 and lines[-1].startswith("#"):
        lines.pop()
    return start + len("".join(lines))
