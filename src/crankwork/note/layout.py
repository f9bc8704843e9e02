"""Printed mathematics as boxes: what stands over, under and beside what, in no format yet.

A formula becomes boxes once; Typst, Word and the web page each draw the same boxes. Numbers are boxes of
finished text, so that every format prints the same digits and no space follows a decimal comma.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

SignKind = Literal["binary", "prefix", "relation", "times", "slash", "comma", "fence"]


@dataclass(frozen=True, slots=True)
class Letter:
    """A variable, slanted."""

    text: str


@dataclass(frozen=True, slots=True)
class Upright:
    """Letters that stand upright: a subscript, the name of a function, a unit."""

    text: str


@dataclass(frozen=True, slots=True)
class Digits:
    """A number as it is printed, decimal mark included, without sign and power of ten."""

    text: str


@dataclass(frozen=True, slots=True)
class Sign:
    """An operator or relation; `times` without text is a product written by standing side by side."""

    text: str
    kind: SignKind = "binary"


@dataclass(frozen=True, slots=True)
class Row:
    """Boxes side by side."""

    parts: tuple[Box, ...]


@dataclass(frozen=True, slots=True)
class Fraction:
    """A numerator over a denominator."""

    top: Box
    bottom: Box


@dataclass(frozen=True, slots=True)
class Root:
    """A square root."""

    inside: Box


@dataclass(frozen=True, slots=True)
class Script:
    """A base with something at its foot, at its head, or both."""

    base: Box
    below: Box | None = None
    above: Box | None = None


@dataclass(frozen=True, slots=True)
class Fence:
    """Parentheses, or the bars of an absolute value, as high as what they hold."""

    inside: Box
    marks: str = "()"


@dataclass(frozen=True, slots=True)
class Apply:
    """A function written before its argument without parentheses, `sin φ`."""

    name: Box
    argument: Box


@dataclass(frozen=True, slots=True)
class Marked:
    """A box with a bar or an arrow over it, in bold, or with a line under it, as vectors have."""

    inside: Box
    mark: str  # `bar`, `arrow`, `bold` or `line`


Box = Letter | Upright | Digits | Sign | Row | Fraction | Root | Script | Fence | Apply | Marked


class PrintedEquation(NamedTuple):
    """An equation as lines of boxes, and as plain text for those who cannot see it."""

    lines: tuple[Row, ...]
    text: str


PRODUCT = Sign("", "times")
DOT = Sign("·", "times")
MINUS = Sign("−", "prefix")
EQUALS = Sign("=", "relation")
SPACE = Upright("\u2009")
# parentheses that need not end on the line on which they begin
OPEN, CLOSE = Sign("(", "fence"), Sign(")", "fence")

# widths in em of Libertinus Serif and New Computer Modern Math, rounded up
_LETTER, _TEXT, _FENCE, _ROOT, _BAR, _SCRIPT = 0.58, 0.5, 0.8, 0.9, 0.24, 0.72
# how much too wide a line may be before a fraction is taken apart; widths are rounded up
_TOLERANCE = 1.1
_SIGNS = {"binary": 1.22, "prefix": 0.78, "relation": 1.34, "times": 0.17, "slash": 0.5, "comma": 0.45,
          "fence": 0.4}  # fmt: skip


def row(*boxes: Box) -> Row:
    """Return boxes side by side, rows among them laid open."""
    parts: list[Box] = []
    for box in boxes:
        parts.extend(box.parts if isinstance(box, Row) else (box,))
    return Row(tuple(parts))


def width(box: Box | None) -> float:  # noqa: C901 - one case per kind of box
    """Return an estimate of how wide a box prints. [em]"""
    match box:
        case None:
            return 0.0
        case Letter(text):
            return _LETTER * len(text)
        case Upright(text) | Digits(text):
            return _TEXT * len(text)
        case Sign(text, kind):
            return _SIGNS[kind] if text != "·" else 0.72
        case Row(parts):
            return sum(map(width, parts))
        case Fraction(top, bottom):
            return max(width(top), width(bottom)) + _BAR
        case Root(inside):
            return width(inside) + _ROOT
        case Script(base, below, above):
            return width(base) + _SCRIPT * max(width(below), width(above))
        case Fence(inside):
            return width(inside) + _FENCE
        case Apply(name, argument):
            return width(name) + width(argument) + 0.17
        case Marked(inside):
            return width(inside)


def first(box: Box) -> Box:
    """Return the leftmost box of a row, or the box itself."""
    return first(box.parts[0]) if isinstance(box, Row) and box.parts else box


def last(box: Box) -> Box:
    """Return the rightmost box of a row, or the box itself."""
    return last(box.parts[-1]) if isinstance(box, Row) and box.parts else box


def leads_with_sign(box: Box) -> bool:
    """Return whether a box begins with a minus."""
    start = first(box)
    return isinstance(start, Sign) and start.kind == "prefix"


def broken(line: Row, limit: float) -> list[Row]:
    """Return a row as rows no wider than `limit` where that is possible. [em]

    A row is divided before a plus or minus that stands in no parentheses, else before a dot; the sign that it is
    divided at leads the next row. Where there is neither, a fraction with a long numerator becomes one over its
    denominator, times the numerator in parentheses, and long parentheses may be divided inside.
    """
    if width(line) <= limit:
        return [line]
    for kind in ("binary", "times"):
        places = [k for k, part in enumerate(line.parts) if k and isinstance(part, Sign) and part.kind == kind]
        places = [k for k in places if line.parts[k] != PRODUCT]
        if places:
            fitting = [k for k in places if width(Row(line.parts[:k])) <= limit]
            place = fitting[-1] if fitting else places[0]
            return [*_opened(Row(line.parts[:place]), limit), *broken(Row(line.parts[place:]), limit)]
    return _opened(line, limit)


def _opened(line: Row, limit: float) -> list[Row]:
    """Return a row that cannot be divided as rows, its widest box taken apart if that makes divisions possible."""
    if width(line) <= _TOLERANCE * limit:
        return [line]
    widest = max(range(len(line.parts)), key=lambda k: width(line.parts[k]))
    match line.parts[widest]:
        case Fraction(Row() as top, bottom) if width(top) > width(bottom):
            inside = row(Fraction(Digits("1"), bottom), DOT, OPEN, top, CLOSE)
        case Fence(Row() as content, "()"):
            inside = row(OPEN, content, CLOSE)
        case _:
            return [line]
    return broken(row(*line.parts[:widest], inside, *line.parts[widest + 1 :]), limit)
