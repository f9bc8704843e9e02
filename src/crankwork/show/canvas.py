"""Canvas for charts in points, downward from its upper left corner, which becomes a scene; layouts of charts."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language
from crankwork.show import scene
from crankwork.show.scene import (
    CAP_HEIGHT,
    SOLID,
    TEXT,
    Circle,
    Drawing,
    Hatch,
    Item,
    Pen,
    Plot,
    Polyline,
    Style,
    Text,
    flow_rows,
)

BLACK, GREY, LIGHT = "#000000", "#737373", "#e0e0e0"
# factor for text in a reader's font over our table of widths
WIDER = 1.1
_SYMBOL = re.compile(r"(?<!\\)\$((?:[^$\\]|\\.)*)\$")
# symbols or parts of symbols that are upright
_UPRIGHT = ("sin", "cos", "tan", "tg")
MM = 25.4 / 72
# font size of a chart that a sheet enlarges to the standard size; smaller text on a chart gets the small one [pt]
_LETTERS, _READ = 8.5, 8.0
# figures narrower than this are as wide as a column, and what small graphs beside each other take at least [pt]
_NARROW, _SMALLEST = 300.0, 110.0
# millimetres of a sheet in a millimetre of the same chart in a text
LARGER = TEXT / (_LETTERS * MM * CAP_HEIGHT)


def plain(text: str) -> str:
    r"""Return a text with names of the user's own, which no mark of a symbol is read in.

    Examples
    --------
    >>> print(plain("force at the joint, $x^$"))
    force at the joint, \$x^\$
    """
    return scene.literal(text).replace("$", r"\$")


def marked(text: str) -> str:
    r"""Return a text in which symbols `base_index` stand between dollar signs, with the marks of a scene.

    Examples
    --------
    >>> marked("$v_п.ср$ – mean speed"), marked("$sin φ$"), marked("$a_B^n$")
    ('/{v}_{п.ср} – mean speed', 'sin φ', '/{a}_{B}^{n}')
    """
    return _SYMBOL.sub(lambda match: _symbol(match[1]), text).replace(r"\$", "$")


def _symbol(symbol: str) -> str:
    symbol, _, power = symbol.partition("^")
    base, _, index = symbol.partition("_")
    slanted = not base.startswith(_UPRIGHT) and "/" not in base
    parts = re.findall(r"[^\W\d_ΣΔ]+|[\W\d_ΣΔ]+", base) if slanted else [base]
    shown = "".join(f"/{{{part}}}" if slanted and part[0].isalpha() and part[0] not in "ΣΔ" else part for part in parts)
    return shown + (f"_{{{index}}}" if index else "") + (f"^{{{power}}}" if power else "")


def text_width(text: str, size: float) -> float:
    """Return an upper estimate of the width of a text. [pt]"""
    return scene.text_width(marked(text), font_size(size) * CAP_HEIGHT)


def fitted_lines(text: str, size: float, width: float) -> tuple[str, ...]:
    """Return a text on as many lines as it needs."""
    return tuple(flow_rows(text.split(" "), " ", width, partial(text_width, size=size)))


def _grey(colour: str) -> float:
    return int(colour[1:3], 16) / 255


class Canvas:
    """Collects items; coordinates to the right and downward from its upper left corner. [pt]"""

    def __init__(self, width: float, height: float) -> None:
        self.width, self.height = width, height
        self.texts: list[tuple[str, float, float, float, float]] = []
        self.items: list[Item] = []
        self.plots: list[Plot] = []
        # what is drawn when everything else is, since it keeps clear of that
        self.last: list[Callable[[], None]] = []
        # cells that lines pass, and the number of items sampled, for the placement of names
        self.sampled: NDArray[np.int64] = np.zeros((0, 3), dtype=np.int64)
        self.sampled_items = 0

    def plot(self, plot: Plot) -> None:
        """Add a graph: left, upper edge, width and height in points, and its scales."""
        box = plot.box
        place = scene.ChartBox(box.left * MM, -(box.bottom + box.height) * MM, box.width * MM, box.height * MM)
        self.plots.append(plot._replace(box=place))

    def line(
        self,
        x: Sequence[float] | Array,
        y: Sequence[float] | Array,
        *,
        style: Style = SOLID,
        width: float = 0.45,
        colour: str = BLACK,
        name: str = "",
    ) -> None:
        """Draw a line through points.

        `name`: by which the line is found in the file.
        """
        dashes = tuple(length * width * MM for length in style)
        self.items.append(Polyline(_places(x, y), Pen(width * MM, dashes, colour=colour), name=name))

    def area(
        self, x: Sequence[float] | Array, y: Sequence[float] | Array, *, fill: str = "#ffffff", width: float = 0.0
    ) -> None:
        """Fill an area, with a black outline if it has a width."""
        self.items.append(Polyline(_places(x, y), Pen(width * MM), closed=True, fill=_grey(fill)))

    def hatch(self, x: Sequence[float] | Array, y: Sequence[float] | Array, spacing: float = 5.0) -> None:
        """Hatch an area with slanted lines at a distance. [pt]"""
        self.items.append(Hatch(_places(x, y), spacing * MM))

    def segments(self, ends: Array, *, width: float = 0.45, colour: str = BLACK) -> None:
        """Draw many straight lines at once, such as hatching.

        `ends`: x and y of the start, x and y of the end of each [pt], shape (n, 4).
        """
        pen = Pen(width * MM, colour=colour)
        self.items += [Polyline(_places((a, c), (b, d)), pen) for a, b, c, d in np.asarray(ends).tolist()]

    def dot(self, x: float, y: float, radius: float = 1.5, *, fill: str = BLACK, width: float = 0.0) -> None:
        """Draw a dot, or a circle."""
        self.items.append(Circle((x * MM, -y * MM), radius * MM, Pen(width * MM), _grey(fill)))

    def arrow(
        self,
        start: Sequence[float],
        end: Sequence[float],
        *,
        width: float = 0.9,
        colour: str = BLACK,
        style: Style = SOLID,
    ) -> None:
        """Draw an arrow with a filled head; one too short for a head is a line."""
        (x, y), (u, v) = start, end
        length = math.hypot(u - x, v - y)
        head = min(4.0 + 1.6 * width, 0.7 * length)
        if length < 1e-6:
            return
        a, b = (u - x) / length, (v - y) / length
        foot = u - a * head, v - b * head
        self.line([x, foot[0]], [y, foot[1]], style=style, width=width, colour=colour)
        half = 0.32 * head
        corners = [u, foot[0] - b * half, foot[0] + b * half], [v, foot[1] + a * half, foot[1] - a * half]
        self.area(*corners, fill=colour)

    def text(
        self, x: float, y: float, text: str, *, size: float = 8.0, anchor: scene.Anchor = "start", colour: str = BLACK
    ) -> None:
        """Write a text.

        `x` and `y`: where its baseline begins, ends or has its middle [pt], as `anchor` says: start, end or middle.
        """
        width, size = text_width(text, size), font_size(size)
        left = x - {"start": 0.0, "middle": width / 2, "end": width}[anchor]
        self.texts.append((text, left, y - 0.75 * size, left + width, y + 0.25 * size))
        self.write((x, y), text, size, anchor, grey=_grey(colour))

    def upward_text(self, x: float, y: float, text: str, *, size: float = 8.0) -> None:
        """Write a text that runs upward."""
        half, size = text_width(text, size) / 2, font_size(size)
        self.texts.append((text, x - 0.75 * size, y - half, x + 0.25 * size, y + half))
        self.write((x, y), text, size, "middle", angle=90.0)

    def write(  # noqa: PLR0913 - place, letters and ground
        self,
        place: tuple[float, float],
        text: str,
        size: float,
        anchor: scene.Anchor = "start",
        *,
        angle: float = 0.0,
        grey: float = 0.0,
        halo: bool = False,
    ) -> None:
        """Write a text that no name keeps clear of; `halo` clears the ground around its edges."""
        position = place[0] * MM, -place[1] * MM
        height = font_size(size) * MM * CAP_HEIGHT
        self.items.append(Text(position, marked(text), height, anchor, angle, grey, halo))

    def make_room(self, height: float) -> None:
        """Move everything downward, so that there is room above. [pt]"""
        self.height += height
        self.items = [scene.moved(item, 0.0, -height * MM) for item in self.items]
        self.plots = [scene.moved_plot(plot, 0.0, -height * MM) for plot in self.plots]
        self.texts = [(text, left, top + height, right, foot + height) for text, left, top, right, foot in self.texts]
        self.sampled, self.sampled_items = self.sampled[:0], 0

    def drawing(self, title: str, language: Language = "en") -> Drawing:
        """Return the drawing, on a paper whose origin is its lower left corner."""
        while self.last:
            self.last.pop(0)()
        larger = LARGER if current_layout().is_sheet else 1.0
        width, height = self.width * MM * larger, self.height * MM * larger
        items = tuple(scene.moved(item, 0.0, height, larger) for item in self.items)
        plots = tuple(scene.moved_plot(plot, 0.0, height, larger) for plot in self.plots)
        return Drawing(title, language, width, height, items, plots)


def _places(x: Sequence[float] | Array, y: Sequence[float] | Array) -> Array:
    return np.column_stack([np.asarray(x, dtype=float), -np.asarray(y, dtype=float)]) * MM


class ChartLayout(NamedTuple):
    """Width of a canvas, margins of graphs on it [pt], and factor of their height over that in a text.

    `is_rough`: only the size of the drawing is needed, so names of points, whose placement takes long, are left out.
    """

    width: float = 481.9
    left: float = 70.6
    right: float = 18.0
    tall: float = 1.0
    is_sheet: bool = False
    is_rough: bool = False

    @property
    def inner(self) -> float:
        """Width of graphs on it. [pt]"""
        return self.width - self.left - self.right


_TEXT_LAYOUT = ChartLayout()
# widths of figures in millimetres: of a column and of a page, whose graphs are as tall as fits them
WIDTHS = {"85": ChartLayout(85 / MM, 66.0, 10.0, 0.8), "170": _TEXT_LAYOUT}
# on a screen, whose letters are as large on a phone as on a desk
SCREEN = ChartLayout(88 / MM, 66.0, 10.0, 0.8)
# scales for drawings as large as their paper allows
FINE = (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8)

_LAYOUT: ContextVar[ChartLayout] = ContextVar("place", default=_TEXT_LAYOUT)


def current_layout() -> ChartLayout:
    """Return the layout of charts in this context."""
    return _LAYOUT.get()


@contextmanager
def use_layout(place: ChartLayout) -> Iterator[None]:
    """Draw charts with a layout within this context."""
    before = _LAYOUT.set(place)
    try:
        yield
    finally:
        _LAYOUT.reset(before)


def is_narrow() -> bool:
    """Return whether figures are as wide as a column."""
    return current_layout().width < _NARROW


def columns_of(count: int) -> int:
    """Return how many small graphs stand beside each other at most."""
    return max(1, min(count, int(current_layout().width / _SMALLEST)))


def font_size(size: float) -> float:
    """Return the font size in the current layout: on a sheet 3.5 mm, or 2.5 mm for small text. [pt]"""
    if not current_layout().is_sheet:
        return size
    return _LETTERS if size >= _READ else _LETTERS * 2.5 / TEXT


def scaled_height(height: float) -> float:
    """Return the height of a graph in the current layout. [pt]"""
    return current_layout().tall * height


def points_per_mm() -> float:
    """Return the points of a chart per millimetre of the finished paper."""
    return 1.0 / (MM * (LARGER if current_layout().is_sheet else 1.0))


def round_scale(least: float, among: Sequence[float] = (1, 2, 2.5, 4, 5)) -> float:
    """Return the smallest of 1, 2, 2.5, 4, 5 times a power of ten that is not less; `among`: other factors, as `FINE`.

    Examples
    --------
    >>> round_scale(0.013), round_scale(0.3), round_scale(0.5)
    (0.02, 0.4, 0.5)
    """
    power = math.floor(math.log10(least))
    scales = (float(f"{factor}e{power}") for factor in (*among, 10))
    return next(scale for scale in scales if scale >= least * (1 - 1e-9))
