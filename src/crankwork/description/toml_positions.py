"""Positions of keys in a TOML text: the text is read again after the standard parser, which does not keep them."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from typing import NamedTuple

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
