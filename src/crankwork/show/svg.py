"""Drawings as SVG, in millimetres, with texts as text."""

from __future__ import annotations

import html
import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.show.scene import (
    CAP_HEIGHT,
    INDEX,
    INVISIBLE_DEVIATION,
    Arc,
    Circle,
    Drawing,
    Hatch,
    Item,
    LineKind,
    Pen,
    Polyline,
    Text,
    arc_points,
    hatch_lines,
    pen_of,
    runs,
    simplified,
    visible_points_of_each,
)
from crankwork.show.theme import Palette, Theme, alt_text, palette_of, themed

_BLACK = "#000000"
# values written as 0, and the zeros at the end of a number of three decimals
_ZERO, _ENDS = 5e-4, re.compile(r"\.?0+(?=[ L]|$)")
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
FONTS = "Libertinus Serif, Times New Roman, Liberation Serif, DejaVu Serif, serif"


def svg(drawing: Drawing, theme: Theme = "print") -> bytes:
    """Return a drawing as SVG whose user unit is a millimetre of the paper."""
    palette = palette_of(theme)
    return page(drawing, palette, SvgWriter(drawing.height, palette).written(themed(drawing, theme).items))


def page(drawing: Drawing, palette: Palette, written: Iterable[str], about: str = "") -> bytes:
    """Return elements as SVG on the ground of a drawing; `about`: alternative text."""
    width, height = _number(drawing.width), _number(drawing.height)
    size = f'width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}"'
    inked = "" if palette.ink == _BLACK else f' fill="{palette.ink}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="{FONTS}" lang="{drawing.language}"{inked}>'
    title = f"<title>{clean(drawing.title)}</title><desc>{clean(about or alt_text(drawing))}</desc>"
    ground = f'<rect width="{width}" height="{height}" fill="{palette.ground}"/>'
    return "\n".join([head, title, ground, *written, "</svg>", ""]).encode()


def clean(text: str) -> str:
    """Escape a text for SVG, without characters that XML cannot have."""
    return html.escape(_NOT_XML.sub("", text))


def _number(value: float) -> str:
    return f"{value:.3f}".rstrip("0").rstrip(".") if abs(value) >= _ZERO else "0"


class SvgWriter:
    """Writes items as SVG, downward from the top of the paper."""

    _SPACES = ' xml:space="preserve"'
    _SLANTED = ' font-style="italic"'
    _JOIN = ' stroke-linejoin="round"'

    def __init__(self, height: float, palette: Palette) -> None:
        self._height, self._palette = height, palette
        self._masks: dict[int, NDArray[np.bool_]] = {}

    def written(self, items: tuple[Item, ...]) -> Iterator[str]:
        """Yield the elements of items; consecutive lines of one kind become one path."""
        self._find_visible([item for item in items if isinstance(item, Polyline) and len(item.points) > 2])
        for (_, is_plain), group in groupby(_sorted(items), _joined):
            if is_plain:
                yield self._path([item for item in group if isinstance(item, Polyline)])
            else:
                yield from map(self._element, group)

    def _find_visible(self, lines: Sequence[Polyline]) -> None:
        """Find the visible points of lines, all lines of one deviation at once."""
        for within in sorted({self._invisible_deviation(line) for line in lines}):
            places = [line.points for line in lines if self._invisible_deviation(line) == within]
            masks = visible_points_of_each(places, within)
            self._masks |= {id(points): mask for points, mask in zip(places, masks, strict=True)}

    def _invisible_deviation(self, _item: Polyline) -> float:
        """Return the invisible deviation of a line. [mm]"""
        return INVISIBLE_DEVIATION

    def _simplified(self, item: Polyline) -> Array:
        return item.points[self._masks[id(item.points)]] if len(item.points) > 2 else item.points

    def _path(self, lines: list[Polyline]) -> str:
        """Return lines of one kind as one path."""
        d = "".join(self._steps(self._simplified(line), closed=line.closed) for line in lines)
        return f'<path d="{d}"{self._drawn_as(lines[0].kind, lines[0].fill)}/>'

    def _element(self, item: Item) -> str:
        match item:
            case Text():
                return self._text(item)
            case Circle():
                x, y = self._at(*item.centre)
                look = self._drawn_as(item.kind, item.fill)
                return f'<circle cx="{x}" cy="{y}" r="{self._number(item.radius)}"{look}/>'
            case Arc():
                d = self._steps(simplified(arc_points(item)))
                return f'<path d="{d}"{self._drawn_as(item.kind)}/>'
            case Hatch():
                strokes = "".join(self._steps(stroke) for stroke in hatch_lines(item))
                return f'<path d="{strokes}"{self._drawn_as("thin")}/>'
            case _:
                return self._line(item)

    def _line(self, item: Polyline) -> str:
        name = f' class="{clean(item.name)}"' if item.name else ""
        d = self._steps(self._simplified(item), closed=item.closed)
        return f'<path{name} d="{d}"{self._drawn_as(item.kind, item.fill)}/>'

    def _text(self, item: Text) -> str:
        x, y = self._at(*item.place)
        moves = [f"rotate({self._number(-item.angle)} {x} {y})"] if item.angle else []
        if item.wide != 1:
            moves, x, y = [*moves, f"translate({x} {y}) scale({self._number(item.wide)} 1)"], "0", "0"
        turn = f' transform="{" ".join(moves)}"' if moves else ""
        size = item.height / CAP_HEIGHT
        body, below = "", 0.0
        for run in runs(item.text):
            level = {-1: 0.3 * item.height, 0: 0.0, 1: -0.5 * item.height}[run.shift]
            text = clean(run.text)
            if run.shift or below or run.is_slanted:
                look = f' dy="{self._number(level - below)}"' if level != below else ""
                look += f' font-size="{self._number(INDEX * size)}"' if run.shift else ""
                look += self._SLANTED if run.is_slanted else ""
                text = f"<tspan{look}>{text}</tspan>"
            body, below = body + text, level
        return f'<text x="{x}" y="{y}"{self._sized(size)}{self._lettered(item)}{turn}{self._SPACES}>{body}</text>'

    def _sized(self, size: float) -> str:
        return f' font-size="{self._number(size)}"'

    def _lettered(self, item: Text) -> str:
        """Return anchor, shade and halo of a text."""
        anchor = f' text-anchor="{item.anchor}"' if item.anchor != "start" else ""
        anchor += self._filled(item.grey) if item.grey else ""
        halo = f'stroke-width="{self._number(0.3 * item.height)}"{self._JOIN} paint-order="stroke"'
        return f"{anchor}{self._drawn(self._palette.ground)} {halo}" if item.halo else anchor

    def _at(self, x: float, y: float) -> tuple[str, str]:
        return self._number(x), self._number(self._height - y)

    def _steps(self, points: Array, *, closed: bool = False) -> str:
        places = (points * (1, -1) + (0, self._height)).ravel()
        places[np.abs(places) < _ZERO] = 0.0
        written = "L".join(["%.3f %.3f"] * len(points)) % tuple(places.tolist())
        return "M" + _ENDS.sub("", written) + ("z" if closed else "")

    def _drawn_as(self, kind: LineKind | Pen, fill: float | None = None) -> str:
        """Return the attributes of line and fill."""
        pen = pen_of(kind)
        return self._filled(fill, pen.colour) + self._stroke(pen)

    def _stroke(self, pen: Pen) -> str:
        if not pen.width:
            return self._drawn("none")
        dashes = f' stroke-dasharray="{" ".join(self._number(dash) for dash in pen.dashes)}"' if pen.dashes else ""
        colour = self._coloured(pen.colour) if pen.colour else self._shade(pen.grey)
        return f'{self._drawn(colour)} stroke-width="{self._number(pen.width)}"{self._JOIN}{dashes}'

    def _number(self, value: float) -> str:
        return _number(value)

    def _drawn(self, colour: str) -> str:
        return f' stroke="{colour}"'

    def _filled(self, fill: float | None, colour: str = "") -> str:
        return f' fill="{"none" if fill is None else self._shade(fill, colour)}"'

    def _coloured(self, colour: str) -> str:
        """Return a colour; grey as a shade between ink and ground."""
        red, green, blue = (colour[index : index + 2] for index in (1, 3, 5))
        return self._shade(int(red, 16) / 255) if red == green == blue else colour

    def _shade(self, grey: float, colour: str = "") -> str:
        """Return a shade from ink 0, or a colour, to ground 1."""
        first = colour or self._palette.ink
        ends = [[int(end[index : index + 2], 16) for index in (1, 3, 5)] for end in (first, self._palette.ground)]
        return "#" + "".join(f"{round(ink + grey * (ground - ink)):02x}" for ink, ground in zip(*ends, strict=True))


def _joined(item: Item) -> tuple[object, bool]:
    """Return the key of items that are written as one path; outlined fills stay single."""
    if isinstance(item, Polyline) and not item.name and (item.fill is None or not pen_of(item.kind).width):
        return (item.kind, item.fill), True
    return id(item), False


def _sorted(items: tuple[Item, ...]) -> Iterator[Item]:
    """Yield items in order, but equal styles together among items in ink, whose order is invisible."""
    for is_ink, group in groupby(items, _is_ink):
        items_of_group = list(group)
        yield from sorted(items_of_group, key=lambda item: repr(_joined(item))) if is_ink else items_of_group


def _is_ink(item: Item) -> bool:
    if not isinstance(item, Polyline) or item.name or item.fill not in (None, 0):
        return False
    pen = pen_of(item.kind)
    return not pen.grey and pen.colour in ("", _BLACK)
