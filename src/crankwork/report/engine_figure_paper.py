"""Paper to draw figures on: lines, areas and text as outlines of letters, written as SVG at once.

Figures of a whole engine are many and made of few kinds of parts, so they are written without the layout machinery of
matplotlib, whose fonts they use: two milliseconds instead of a hundred.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple
from xml.sax.saxutils import escape

import numpy as np

from crankwork.analysis import Array
from crankwork.report.figure_look import SOLID, Style, drawing_library

if TYPE_CHECKING:
    from matplotlib.ft2font import FT2Font

BLACK, GREY, LIGHT = "#000000", "#737373", "#e0e0e0"
_EM = 100.0
_SUB_SIZE, _SUB_DROP = 0.7, 0.18
_FONTS = {"r": "DejaVuSerif.ttf", "i": "DejaVuSerif-Italic.ttf"}
_UPRIGHT = ("sin", "cos", "tan", "tg")


class _Letter(NamedTuple):
    """Outline of a letter, upward, and how far the next one stands, both for a size of 100."""

    outline: str
    advance: float


@lru_cache(maxsize=4)
def _font(name: str) -> FT2Font:
    library = drawing_library()
    from matplotlib.ft2font import FT2Font  # noqa: PLC0415 - an optional part

    font = FT2Font(f"{library.get_data_path()}/fonts/ttf/{_FONTS[name]}")
    font.set_size(_EM, 72)
    return font


@lru_cache(maxsize=2048)
def _letter(font: str, letter: str) -> _Letter:
    from matplotlib.ft2font import LoadFlags  # noqa: PLC0415 - an optional part

    face = _font(font)
    glyph = face.load_char(ord(letter), flags=LoadFlags.NO_HINTING)
    points, codes = face.get_path()
    parts, at = [], 0
    while at < len(codes):
        kind, count = {1: ("M", 1), 2: ("L", 1), 3: ("Q", 2), 4: ("C", 3)}.get(int(codes[at]), ("Z", 0))
        numbers = (f"{round(float(one), 2):g}" for one in np.ravel(points[at : at + count]))
        parts.append(kind + " ".join(numbers))
        at += count or 1
    return _Letter("".join(parts), glyph.linearHoriAdvance / 65536)


def has_letter(letter: str) -> bool:
    """Return whether the font has a letter."""
    return bool(_font("r").get_char_index(ord(letter)))


class _Run(NamedTuple):
    """Letters in one font: upright or italic, size and height over the base line as shares of the size of the text."""

    font: str
    size: float
    rise: float
    letters: str


@lru_cache(maxsize=1024)
def _runs(text: str) -> tuple[_Run, ...]:
    """Return the runs of a text in which symbols `base_subscript` stand between dollar signs."""
    result = []
    for at, part in enumerate(text.split("$")):
        if at % 2 == 0:
            result.append(_Run("r", 1.0, 0.0, part))
            continue
        base, _, subscript = part.partition("_")
        slanted = not base.startswith(_UPRIGHT) and "/" not in base
        result += [_Run("i" if slanted and one.isalpha() and one not in "ΣΔ" else "r", 1.0, 0.0, one) for one in base]
        result.append(_Run("r", _SUB_SIZE, -_SUB_DROP, subscript))
    return tuple(one for one in result if one.letters)


@lru_cache(maxsize=2048)
def text_width(text: str, size: float) -> float:
    """Return how wide a text is. [pt]"""
    widths = (sum(_letter(run.font, one).advance for one in run.letters) * run.size for run in _runs(text))
    return size * sum(widths) / _EM


def fitted_lines(text: str, size: float, width: float) -> tuple[str, ...]:
    """Return a text on as many lines as it needs."""
    lines: list[str] = []
    for word in text.split(" "):
        joined = f"{lines[-1]} {word}" if lines else word
        if lines and text_width(joined, size) <= width:
            lines[-1] = joined
        else:
            lines.append(word)
    return tuple(lines)


def path_data(x: Array, y: Array, *, closed: bool = False) -> str:
    """Return points joined by straight lines as the data of an SVG path.

    `closed`: whether the last is joined with the first.
    """
    numbers = np.round(np.column_stack([x, y]), 2).tolist()
    return "M" + "L".join(f"{a:g} {b:g}" for a, b in numbers) + ("Z" if closed else "")


def _dashes(style: Style, width: float) -> str:
    if style == SOLID or isinstance(style, str):
        return ""
    return ' stroke-dasharray="{}"'.format(" ".join(f"{round(one * width, 2):g}" for one in style[1]))


def _scale(size: float) -> str:
    return f"scale({size / _EM:g} {-size / _EM:g})"


class Paper:
    """A sheet that collects what is drawn; coordinates to the right and downward from its upper left corner. [pt]"""

    def __init__(self, width: float, height: float) -> None:
        self.width, self.height = width, height
        self.texts: list[tuple[str, float, float, float, float]] = []
        self._parts: list[str] = []
        self._letters: dict[str, str] = {}

    def line(
        self,
        x: Sequence[float] | Array,
        y: Sequence[float] | Array,
        *,
        style: Style = SOLID,
        width: float = 0.8,
        colour: str = BLACK,
        name: str = "",
    ) -> None:
        """Draw a line through points.

        `name`: by which the line is found again in the file.
        """
        data = path_data(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
        named = f' class="{escape(name)}"' if name else ""
        self._path(data, f'{named} fill="none" stroke="{colour}" stroke-width="{width:g}"{_dashes(style, width)}')

    def area(
        self, x: Sequence[float] | Array, y: Sequence[float] | Array, *, fill: str = "#ffffff", width: float = 0.0
    ) -> None:
        """Fill an area, with a black outline if it has a width."""
        data = path_data(np.asarray(x, dtype=float), np.asarray(y, dtype=float), closed=True)
        self._path(data, f' fill="{fill}"' + (f' stroke="{BLACK}" stroke-width="{width:g}"' if width else ""))

    def segments(self, ends: Array, *, width: float = 0.5, colour: str = BLACK) -> None:
        """Draw many straight lines at once, such as hatching.

        `ends`: x and y of the start, x and y of the end of each [pt], shape (n, 4).
        """
        if len(ends):
            data = "".join(f"M{a:g} {b:g}L{c:g} {d:g}" for a, b, c, d in np.round(ends, 2).tolist())
            self._path(data, f' fill="none" stroke="{colour}" stroke-width="{width:g}"')

    def _path(self, data: str, paint: str) -> None:
        self._parts.append(f'<path d="{data}"{paint} stroke-linejoin="round"/>')

    def dot(self, x: float, y: float, radius: float = 1.5, *, fill: str = BLACK, width: float = 0.0) -> None:
        """Draw a dot, or a circle."""
        stroke = f' stroke="{BLACK}" stroke-width="{width:g}"' if width else ""
        self._parts.append(f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{radius:g}" fill="{fill}"{stroke}/>')

    def arrow(self, start: Sequence[float], end: Sequence[float], *, width: float = 1.0, colour: str = BLACK) -> None:
        """Draw an arrow with a filled head; one too short for a head is a line."""
        (x, y), (u, v) = start, end
        length = math.hypot(u - x, v - y)
        head = min(4.0 + 1.6 * width, 0.7 * length)
        if length < 1e-6:
            return
        a, b = (u - x) / length, (v - y) / length
        foot = u - a * head, v - b * head
        self.line([x, foot[0]], [y, foot[1]], width=width, colour=colour)
        half = 0.32 * head
        corners = [u, foot[0] - b * half, foot[0] + b * half], [v, foot[1] + a * half, foot[1] - a * half]
        self.area(*corners, fill=colour)

    def text(
        self, x: float, y: float, text: str, *, size: float = 9.0, anchor: str = "start", colour: str = BLACK
    ) -> None:
        """Write a text.

        `x` and `y`: where its base line begins, ends or has its middle [pt]; `anchor`: start, middle or end: which
        point of the text stands at x, y.
        """
        width = text_width(text, size)
        x -= {"start": 0.0, "middle": width / 2, "end": width}[anchor]
        self.texts.append((text, x, y - 0.75 * size, x + width, y + 0.25 * size))
        paint = "" if colour == BLACK else f' fill="{colour}"'
        self._write(text, f'{paint} transform="translate({x:.2f} {y:.2f}) {_scale(size)}"')

    def upward_text(self, x: float, y: float, text: str, *, size: float = 9.0) -> None:
        """Write a text that runs upward."""
        half = text_width(text, size) / 2
        self.texts.append((text, x - 0.75 * size, y - half, x + 0.25 * size, y + half))
        self._write(text, f' transform="translate({x:.2f} {y + half:.2f}) rotate(-90) {_scale(size)}"')

    def _write(self, text: str, attributes: str) -> None:
        """Put the letters of a text side by side."""
        self._parts.append(f"<g{attributes}>")
        at = 0.0
        for font, share, rise, letters in _runs(text):
            smaller = f" scale({share:g})" if share != 1 else ""
            for one in letters:
                outline, advance = _letter(font, one)
                if outline:
                    key = f"{font}{ord(one):x}"
                    self._letters[key] = outline
                    moved = f"translate({round(at, 1):g} {rise * _EM:g}){smaller}"
                    self._parts.append(f'<use xlink:href="#{key}" transform="{moved}"/>')
                at += advance * share
        self._parts.append("</g>")

    def svg(self, title: str) -> bytes:
        """Return the sheet as SVG."""
        letters = "".join(f'<path id="{key}" d="{data}"/>' for key, data in sorted(self._letters.items()))
        size = f'width="{self.width:g}pt" height="{self.height:g}pt" viewBox="0 0 {self.width:g} {self.height:g}"'
        head = '<?xml version="1.0" encoding="utf-8" standalone="no"?>\n'
        spaces = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" version="1.1"'
        white = f'<path d="M0 0H{self.width:g}V{self.height:g}H0Z" fill="#ffffff"/>'
        body = "\n".join(self._parts)
        start = f"{head}<svg {spaces} {size}>\n<title>{escape(title)}</title>\n<defs>{letters}</defs>\n"
        return f"{start}{white}\n{body}\n</svg>\n".encode()
