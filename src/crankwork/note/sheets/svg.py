"""A sheet as SVG, in millimetres."""

from __future__ import annotations

import html
from collections.abc import Iterator
from itertools import groupby

from crankwork.analysis import Array
from crankwork.note.sheets.scene import (
    CAP_HEIGHT,
    INDEX,
    PENS,
    Arc,
    Circle,
    Hatch,
    Item,
    LineKind,
    Polyline,
    Text,
    arc_points,
    hatch_lines,
    runs,
)
from crankwork.note.sheets.sheet import Sheet

FONTS = "Libertinus Serif, Times New Roman, Liberation Serif, DejaVu Serif, serif"


def sheet_svg(sheet: Sheet) -> bytes:
    """Return a sheet as SVG whose user unit is a millimetre of the paper."""
    box = sheet.paper.box
    writer = _Writer(box.height)
    size = f'width="{box.width:g}mm" height="{box.height:g}mm" viewBox="0 0 {box.width:g} {box.height:g}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="{FONTS}" lang="{sheet.language}">'
    title = f"<title>{html.escape(sheet.title)}</title>"
    ground = f'<rect width="{box.width:g}" height="{box.height:g}" fill="white"/>'
    return "\n".join([head, title, ground, *writer.written(sheet.items), "</svg>", ""]).encode()


def _number(value: float) -> str:
    return f"{value:.3f}".rstrip("0").rstrip(".") if abs(value) >= 5e-4 else "0"


class _Writer:
    """Items as SVG, which counts downward from the top of the paper."""

    def __init__(self, height: float) -> None:
        self._height = height

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
        return f'<path d="{d}" fill="none" {_stroke(lines[0].kind)}/>'

    def _one(self, item: Item) -> str:
        match item:
            case Text():
                return self._text(item)
            case Circle():
                x, y = self._at(*item.centre)
                style = _stroke(item.kind)
                return f'<circle cx="{x}" cy="{y}" r="{_number(item.radius)}" fill="{_fill(item.fill)}" {style}/>'
            case Arc():
                return f'<path d="{self._steps(arc_points(item))}" fill="none" {_stroke(item.kind)}/>'
            case Hatch():
                strokes = "".join(self._steps(one) for one in hatch_lines(item))
                return f'<path d="{strokes}" fill="none" {_stroke("thin")}/>'
            case _:
                name = f' class="{html.escape(item.name)}"' if item.name else ""
                d = self._steps(item.points, closed=item.closed)
                return f'<path{name} d="{d}" fill="{_fill(item.fill)}" {_stroke(item.kind)}/>'

    def _text(self, item: Text) -> str:
        x, y = self._at(*item.place)
        turn = f' transform="rotate({_number(-item.angle)} {x} {y})"' if item.angle else ""
        size = item.height / CAP_HEIGHT
        anchor = f' text-anchor="{item.anchor}"' if item.anchor != "start" else ""
        body, below = "", 0.0
        for run in runs(item.text):
            wanted = {-1: 0.3 * item.height, 0: 0.0, 1: -0.5 * item.height}[run.shift]
            text = html.escape(run.text)
            if run.shift or below:
                small = f' font-size="{_number(INDEX * size)}"' if run.shift else ""
                text = f'<tspan dy="{_number(wanted - below)}"{small}>{text}</tspan>'
            body, below = body + text, wanted
        return f'<text x="{x}" y="{y}" font-size="{_number(size)}"{anchor}{turn} xml:space="preserve">{body}</text>'

    def _at(self, x: float, y: float) -> tuple[str, str]:
        return _number(x), _number(self._height - y)

    def _steps(self, points: Array, *, closed: bool = False) -> str:
        places = [" ".join(self._at(float(x), float(y))) for x, y in points]
        return "M" + "L".join(places) + ("z" if closed else "")


def _joined(item: Item) -> tuple[object, bool]:
    """Return what items must share to be written as one path."""
    if isinstance(item, Polyline) and item.fill is None and not item.name:
        return item.kind, True
    return id(item), False


def _stroke(kind: LineKind) -> str:
    pen = PENS[kind]
    shade = round(255 * pen.grey)
    dashes = f' stroke-dasharray="{" ".join(f"{one:g}" for one in pen.dashes)}"' if pen.dashes else ""
    return f'stroke="#{shade:02x}{shade:02x}{shade:02x}" stroke-width="{pen.width:g}" stroke-linejoin="round"{dashes}'


def _fill(fill: float | None) -> str:
    shade = round(255 * fill) if fill is not None else 0
    return "none" if fill is None else f"#{shade:02x}{shade:02x}{shade:02x}"
