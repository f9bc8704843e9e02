"""Drawings as SVG, in millimetres, with texts as text; those that move too."""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.resources import read_resource
from crankwork.show.animation import Animation, Part, keyframes
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
from crankwork.show.theme import Palette, Theme, alt_text, palette_of, themed, themed_item

_BLACK = "#000000"
# values written as 0, and the zeros at the end of a number of three decimals
_ZERO, _ENDS = 5e-4, re.compile(r"\.?0+(?=[ L]|$)")
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
FONTS = "Libertinus Serif, Times New Roman, Liberation Serif, DejaVu Serif, serif"
_LINE = 6.0
Written = Callable[[tuple[Item, ...], float], Iterator[str]]
# rounding tolerance: millimetres, degrees, shares
_TOLERANCE = 1e-4
_COLOUR = re.compile(r'(?:fill|stroke)="(#[0-9a-f]{6})"')
_SCRIPT = f"<script><![CDATA[\n{read_resource('show', 'moving.js')}]]></script>"


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


def moving_svg(film: Animation, theme: Theme = "print") -> bytes:
    """Return an animation as SVG that plays by itself."""
    palette, moves = palette_of(theme), _Moves(film)

    def written(items: tuple[Item, ...], height: float) -> Iterator[str]:
        return SvgWriter(height, palette).written(tuple(themed_item(item, theme) for item in items))

    body = [*film_body(film, written, moves), *_readout(film, palette)]
    style = [*moves.rules(), *(() if theme == "dark" else _in_the_dark(film, theme))]
    numbers = {"TIME": 1000 * film.seconds, "FRAMES": film.frames, "REST": film.rest / film.frames}
    script = re.sub("TIME|FRAMES|REST", lambda match: f"{numbers[match[0]]:g}", _SCRIPT)
    return page(film.ground, palette, ["<style>", *style, "</style>", *body, script], film.about)


def film_body(film: Animation, written: Written, moves: _Moves | None = None) -> Iterator[str]:
    """Yield everything but the readout; without movements each part is at rest.

    Parts are groups with their name as `data-part`, which a page moves by `moving.data`; equal shapes are written once.
    `written`: items as elements, on a paper of a height. [mm]
    """
    yield from written(film.ground.items, film.ground.height)
    shapes: dict[str, str] = {}
    for part in film.parts:
        yield f'<g data-part="{clean(part.name)}" '
        x, y, turn, stretch, tint = part.track[film.rest if len(part.shift) > 1 else 0]
        inner = None
        if moves is not None:
            x, y, turn, inner = moves.of(part)
            stretch = tint = 1.0
        yield f'transform="{_placed(x, film.ground.height - y, -turn, stretch)}"{_opacity(tint)}>{inner or ""}'
        shape = "\n".join(written(part.items, 0.0))
        if shape in shapes:
            yield f'<use href="#{shapes[shape]}"/>'
        else:
            shapes[shape] = f"s{len(shapes) + 1}"
            yield f'<g id="{shapes[shape]}">{shape}</g>'
        yield "</g></g>" if inner else "</g>"


class _Moves:
    """Movements relative to mean positions; equal movements, also delayed ones, are shared."""

    def __init__(self, film: Animation) -> None:
        self._film = film
        self._movements: list[Array] = []

    def of(self, part: Part) -> tuple[float, float, float, str | None]:
        """Return mean position and angle of a part, and the group that moves in it."""
        track = part.track
        is_closed = bool(np.allclose(track[0], track[-1], atol=1e-6))
        x, y, turned = track[:-1, :3].mean(axis=0) if is_closed and len(track) > 1 else track[0, :3]
        cos, sin = np.cos(np.radians(turned)), np.sin(np.radians(turned))
        # from here on downward and clockwise, as in SVG
        offset = (track[:, :2] - (x, y)) @ np.array([[cos, -sin], [sin, cos]]) * (1.0, -1.0)
        own = np.column_stack([offset, turned - track[:, 2], track[:, 3:]])
        own = own[[0]] if np.all(np.abs(own - own[0]) < _TOLERANCE) else own
        number, later = self._number(own, is_closed=is_closed) if len(own) > 1 else (0, 0)
        right, down, turn, stretch, tint = own[self._film.rest if number else 0]
        moved = f' class="moves m{number}"' if number else ""
        moved += f' style="animation-delay:{self._delay(later)}s"' if later else ""
        is_plain = not number and max(abs(right), abs(down), abs(turn), abs(stretch - 1), abs(tint - 1)) < _TOLERANCE
        group = f'<g{moved} transform="{_placed(right, down, turn, stretch)}"{_opacity(tint)}>'
        return float(x), float(y), float(turned), None if is_plain else group

    def _number(self, own: Array, *, is_closed: bool) -> tuple[int, int]:
        """Return the number of a movement, and its lead in frames over the equal movement that has it."""
        count = len(own) - 1
        ahead = (np.arange(count)[:, None] + np.arange(count)) % count if is_closed else np.arange(count)[None]
        for number, other in enumerate(self._movements, start=1):
            if np.all(np.abs(other[:-1].mean(axis=0) - own[:-1].mean(axis=0)) < _TOLERANCE):
                difference = np.abs(other[ahead] - own[:-1]).max(axis=(1, 2))
                if difference.min() < _TOLERANCE:
                    return number, int(np.argmin(difference))
        self._movements.append(own)
        return len(self._movements), 0

    def _delay(self, later: int) -> str:
        return f"{-self._film.seconds * (self._film.rest + later) / self._film.frames:.4f}"

    def rules(self) -> Iterator[str]:
        """Yield the rules of animation; they begin at rest, so that nothing jumps if animation is off."""
        yield f".moves{{animation:{self._film.seconds:g}s linear {self._delay(0)}s infinite}}"
        for number, own in enumerate(self._movements, start=1):
            steps = "".join(
                f"{_short_number(100 * frame / self._film.frames)}%{{{_step(own, frame)}}}" for frame in keyframes(own)
            )
            yield f".m{number}{{animation-name:m{number}}}@keyframes m{number}{{{steps}}}"
        frames, end = self._film.frames, _short_number(-_LINE * self._film.frames)
        yield f".readout{{animation-name:readout;animation-timing-function:steps({frames})}}"
        yield f"@keyframes readout{{from{{transform:none}}to{{transform:translateY({end}px)}}}}"
        yield "@media (prefers-reduced-motion: reduce){.moves{animation-play-state:paused}}"


def _step(own: Array, frame: int) -> str:
    """Return a frame of a movement, without constant components."""
    right, down, turn, stretch, tint = own[frame]
    shifts, falls, turns, stretches, fades = np.any(
        np.abs(own - (0.0, 0.0, 0.0, 1.0, 1.0)) > _TOLERANCE, axis=0
    ).tolist()
    fall = f",{_short_number(down)}px" if falls else ""
    how = f"translate({_short_number(right)}px{fall})" if shifts or falls else ""
    how += f"rotate({_short_number(turn)}deg)" if turns else ""
    how += f"scale({_short_number(stretch)},1)" if stretches else ""
    return ";".join([*([f"transform:{how}"] if how else []), *([f"opacity:{_short_number(tint)}"] if fades else [])])


def _placed(right: float, down: float, turn: float, stretch: float) -> str:
    turned = f"rotate({_short_number(turn)})" if _short_number(turn) != "0" else ""
    scaled = f"scale({_short_number(stretch)} 1)" if stretch != 1 else ""
    return f"translate({_short_number(right)} {_short_number(down)}){turned}{scaled}"


def _opacity(tint: float) -> str:
    return f' opacity="{_short_number(tint)}"' if tint != 1 else ""


def _short_number(value: float) -> str:
    """Format a number with at most two decimals."""
    return f"{round(value, 2) + 0.0:.2f}".rstrip("0").rstrip(".")


def _readout(film: Animation, palette: Palette) -> Iterator[str]:
    """Yield all readouts as a column that moves in steps behind a window of one line."""
    x, y = film.readout
    top = _short_number(film.ground.height - y - 0.75 * _LINE)
    yield f'<clipPath id="readout"><rect y="{top}" width="100%" height="{_short_number(_LINE)}"/></clipPath>'
    up = _short_number(-_LINE * film.rest)
    yield f'<g clip-path="url(#readout)"><g class="moves readout" transform="translate(0 {up})">'
    lines = tuple(Text((x, y - index * _LINE), text, anchor="end") for index, text in enumerate(film.readouts))
    yield from SvgWriter(film.ground.height, palette).written(lines)
    yield "</g></g>"


def _in_the_dark(film: Animation, theme: Theme) -> Iterator[str]:
    """Yield the colours on dark ground for readers who prefer it."""
    items = (*film.ground.items, *(item for part in film.parts for item in part.items))
    other: Theme = "print" if theme == "print" else "dark"
    dark, ground = palette_of("dark"), palette_of(theme).ground
    bright, dim = (
        _COLOUR.findall("\n".join(SvgWriter(0.0, palette).written(tuple(themed_item(item, name) for item in items))))
        for name, palette in ((theme, palette_of(theme)), (other, dark))
    )
    light = dict(zip(bright, dim, strict=True))
    attributes = "fill", "stroke"
    rules = [f'[{name}="{colour}"]{{{name}:{light[colour]}}}' for colour in sorted(light) for name in attributes]
    rules += [f'[{name}="{ground}"]{{{name}:{dark.ground}}}' for name in attributes]
    yield f"@media (prefers-color-scheme: dark){{svg{{fill:{dark.ink}}}{''.join(rules)}}}"
