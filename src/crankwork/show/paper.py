"""A hand that draws charts on a paper in points, counted downward from its upper left corner, and leaves a scene."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language
from crankwork.show import scene
from crankwork.show.place import LARGER, MM, here, letters
from crankwork.show.scene import (
    CAP_HEIGHT,
    SOLID,
    Circle,
    Drawing,
    Hatch,
    Item,
    Pen,
    Plot,
    Polyline,
    Style,
    Text,
    flowed,
)

BLACK, GREY, LIGHT = "#000000", "#737373", "#e0e0e0"
# letters of a reader may be wider than our table has them
WIDER = 1.1
_SYMBOL = re.compile(r"(?<!\\)\$((?:[^$\\]|\\.)*)\$")
# what stands upright in a symbol
_UPRIGHT = ("sin", "cos", "tan", "tg")


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
    return _SYMBOL.sub(lambda found: _symbol(found[1]), text).replace(r"\$", "$")


def _symbol(symbol: str) -> str:
    symbol, _, power = symbol.partition("^")
    base, _, index = symbol.partition("_")
    slanted = not base.startswith(_UPRIGHT) and "/" not in base
    parts = re.findall(r"[^\W\d_ΣΔ]+|[\W\d_ΣΔ]+", base) if slanted else [base]
    shown = "".join(f"/{{{one}}}" if slanted and one[0].isalpha() and one[0] not in "ΣΔ" else one for one in parts)
    return shown + (f"_{{{index}}}" if index else "") + (f"^{{{power}}}" if power else "")


def text_width(text: str, size: float) -> float:
    """Return about how wide a text is, rather too much. [pt]"""
    return scene.text_width(marked(text), letters(size) * CAP_HEIGHT)


def fitted_lines(text: str, size: float, width: float) -> tuple[str, ...]:
    """Return a text on as many lines as it needs."""
    return tuple(flowed(text.split(" "), " ", width, partial(text_width, size=size)))


def _grey(colour: str) -> float:
    return int(colour[1:3], 16) / 255


class Paper:
    """A paper that collects what is drawn; coordinates to the right and downward from its upper left corner. [pt]"""

    def __init__(self, width: float, height: float) -> None:
        self.width, self.height = width, height
        self.texts: list[tuple[str, float, float, float, float]] = []
        self.items: list[Item] = []
        self._plots: list[Plot] = []
        # where lines go, of as many items as were looked at when names were placed
        self.sampled: NDArray[np.int64] = np.zeros((0, 3), dtype=np.int64)
        self.looked_at = 0

    def plot(self, plot: Plot) -> None:
        """Say where a graph stands, left, upper edge, width and height in points, and what its scales are."""
        box = plot.box
        place = scene.Box(box.left * MM, -(box.bottom + box.height) * MM, box.width * MM, box.height * MM)
        self._plots.append(plot._replace(box=place))

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
        dashes = tuple(one * width * MM for one in style)
        self.items.append(Polyline(_places(x, y), Pen(width * MM, dashes, colour=colour), name=name))

    def area(
        self, x: Sequence[float] | Array, y: Sequence[float] | Array, *, fill: str = "#ffffff", width: float = 0.0
    ) -> None:
        """Fill an area, with a black outline if it has a width."""
        self.items.append(Polyline(_places(x, y), Pen(width * MM), closed=True, fill=_grey(fill)))

    def hatch(self, x: Sequence[float] | Array, y: Sequence[float] | Array, spacing: float = 5.0) -> None:
        """Hatch an area with slanted lines at a distance. [pt]"""
        self.items.append(Hatch(_places(x, y), spacing * MM))

    def segments(self, ends: Array, *, width: float = 0.5, colour: str = BLACK) -> None:
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
        width: float = 1.0,
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
        self, x: float, y: float, text: str, *, size: float = 9.0, anchor: scene.Anchor = "start", colour: str = BLACK
    ) -> None:
        """Write a text.

        `x` and `y`: where its base line begins, ends or has its middle [pt]; `anchor`: start, middle or end: which
        point of the text stands at x, y.
        """
        width, size = text_width(text, size), letters(size)
        left = x - {"start": 0.0, "middle": width / 2, "end": width}[anchor]
        self.texts.append((text, left, y - 0.75 * size, left + width, y + 0.25 * size))
        self._write((x, y), text, size, anchor, grey=_grey(colour))

    def upward_text(self, x: float, y: float, text: str, *, size: float = 9.0) -> None:
        """Write a text that runs upward."""
        half, size = text_width(text, size) / 2, letters(size)
        self.texts.append((text, x - 0.75 * size, y - half, x + 0.25 * size, y + half))
        self._write((x, y), text, size, "middle", angle=90.0)

    def _write(
        self,
        place: tuple[float, float],
        text: str,
        size: float,
        anchor: scene.Anchor,
        *,
        angle: float = 0.0,
        grey: float = 0.0,
    ) -> None:
        at = place[0] * MM, -place[1] * MM
        self.items.append(Text(at, marked(text), letters(size) * MM * CAP_HEIGHT, anchor, angle, grey))

    def drawing(self, title: str, language: Language = "en") -> Drawing:
        """Return what was drawn, on a paper whose origin is its lower left corner."""
        larger = LARGER if here().is_sheet else 1.0
        width, height = self.width * MM * larger, self.height * MM * larger
        items = tuple(scene.moved(one, 0.0, height, larger) for one in self.items)
        plots = tuple(scene.moved_plot(one, 0.0, height, larger) for one in self._plots)
        return Drawing(title, language, width, height, items, plots)


def _places(x: Sequence[float] | Array, y: Sequence[float] | Array) -> Array:
    return np.column_stack([np.asarray(x, dtype=float), -np.asarray(y, dtype=float)]) * MM
