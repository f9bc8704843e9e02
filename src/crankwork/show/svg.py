"""A drawing as SVG, in millimetres, its texts as text."""

from __future__ import annotations

import html
from collections.abc import Iterator
from itertools import groupby

from crankwork.kinematics.crank_grid import Array
from crankwork.show.scene import (
    CAP_HEIGHT,
    INDEX,
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
    thinned,
)
from crankwork.show.theme import Look, Theme, look_of, themed

FONTS = "Libertinus Serif, Times New Roman, Liberation Serif, DejaVu Serif, serif"


def svg(drawing: Drawing, theme: Theme = "print") -> bytes:
    """Return a drawing as SVG whose user unit is a millimetre of the paper."""
    look = look_of(theme)
    drawing = themed(drawing, theme)
    width, height = (_number(one) for one in (drawing.width, drawing.height))
    size = f'width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}"'
    inked = "" if theme == "print" else f' fill="{look.ink}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="{FONTS}" lang="{drawing.language}"{inked}>'
    title = f"<title>{html.escape(drawing.title)}</title>"
    ground = f'<rect width="{width}" height="{height}" fill="{look.ground}"/>'
    written = _Writer(drawing.height, look).written(drawing.items)
    return "\n".join([head, title, ground, *written, "</svg>", ""]).encode()


def _number(value: float) -> str:
    return f"{value:.3f}".rstrip("0").rstrip(".") if abs(value) >= 5e-4 else "0"


class _Writer:
    """Items as SVG, which counts downward from the top of the paper."""

    def __init__(self, height: float, look: Look) -> None:
        self._height, self._look = height, look

    def written(self, items: tuple[Item, ...]) -> Iterator[str]:
        for (_, is_plain), group in groupby(items, _joined):
            some = list(group)
            if is_plain:
                yield self._path([one for one in some if isinstance(one, Polyline)])
            else:
                for one in some:
                    yield self._one(one)

    def _path(self, lines: list[Polyline]) -> str:
        """Return lines of one kind as one path."""
        d = "".join(self._steps(one.points, closed=one.closed) for one in lines)
        return f'<path d="{d}" fill="none" {self._stroke(lines[0].kind)}/>'

    def _one(self, item: Item) -> str:
        match item:
            case Text():
                return self._text(item)
            case Circle():
                x, y = self._at(*item.centre)
                style = self._stroke(item.kind)
                return f'<circle cx="{x}" cy="{y}" r="{_number(item.radius)}" fill="{self._fill(item.fill)}" {style}/>'
            case Arc():
                return f'<path d="{self._steps(arc_points(item))}" fill="none" {self._stroke(item.kind)}/>'
            case Hatch():
                strokes = "".join(self._steps(one) for one in hatch_lines(item))
                return f'<path d="{strokes}" fill="none" {self._stroke("thin")}/>'
            case _:
                name = f' class="{html.escape(item.name)}"' if item.name else ""
                d = self._steps(item.points, closed=item.closed)
                return f'<path{name} d="{d}" fill="{self._fill(item.fill)}" {self._stroke(item.kind)}/>'

    def _text(self, item: Text) -> str:
        x, y = self._at(*item.place)
        turn = f' transform="rotate({_number(-item.angle)} {x} {y})"' if item.angle else ""
        size = item.height / CAP_HEIGHT
        anchor = f' text-anchor="{item.anchor}"' if item.anchor != "start" else ""
        anchor += f' fill="{self._shade(item.grey)}"' if item.grey else ""
        body, below = "", 0.0
        for run in runs(item.text):
            wanted = {-1: 0.3 * item.height, 0: 0.0, 1: -0.5 * item.height}[run.shift]
            text = html.escape(run.text)
            if run.shift or below or run.is_slanted:
                look = f' dy="{_number(wanted - below)}"' if wanted != below else ""
                look += f' font-size="{_number(INDEX * size)}"' if run.shift else ""
                look += ' font-style="italic"' if run.is_slanted else ""
                text = f"<tspan{look}>{text}</tspan>"
            body, below = body + text, wanted
        return f'<text x="{x}" y="{y}" font-size="{_number(size)}"{anchor}{turn} xml:space="preserve">{body}</text>'

    def _at(self, x: float, y: float) -> tuple[str, str]:
        return _number(x), _number(self._height - y)

    def _steps(self, points: Array, *, closed: bool = False) -> str:
        places = [" ".join(self._at(x, y)) for x, y in thinned(points).tolist()]
        return "M" + "L".join(places) + ("z" if closed else "")

    def _stroke(self, kind: LineKind | Pen) -> str:
        pen = pen_of(kind)
        if not pen.width:
            return 'stroke="none"'
        dashes = f' stroke-dasharray="{" ".join(_number(one) for one in pen.dashes)}"' if pen.dashes else ""
        colour = self._coloured(pen.colour) if pen.colour else self._shade(pen.grey)
        return f'stroke="{colour}" stroke-width="{_number(pen.width)}" stroke-linejoin="round"{dashes}'

    def _coloured(self, colour: str) -> str:
        """Return a colour, a grey one between ink and ground."""
        red, green, blue = (colour[at : at + 2] for at in (1, 3, 5))
        return self._shade(int(red, 16) / 255) if red == green == blue else colour

    def _fill(self, fill: float | None) -> str:
        return "none" if fill is None else self._shade(fill)

    def _shade(self, grey: float) -> str:
        """Return a shade from ink 0 to ground 1."""
        ends = [[int(one[at : at + 2], 16) for at in (1, 3, 5)] for one in (self._look.ink, self._look.ground)]
        return "#" + "".join(f"{round(ink + grey * (ground - ink)):02x}" for ink, ground in zip(*ends, strict=True))


def _joined(item: Item) -> tuple[object, bool]:
    """Return what items must share to be written as one path."""
    if isinstance(item, Polyline) and item.fill is None and not item.name:
        return item.kind, True
    return id(item), False
