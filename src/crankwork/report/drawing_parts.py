"""The parts of a moving drawing: link, joint, pivot in the ground, guide, block, names. All sizes in pixels."""

from __future__ import annotations

import html
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.analysis import Array
from crankwork.analysis.moving import Track
from crankwork.locale.numbers import number as number_text
from crankwork.locale.numbers import unit_name
from crankwork.mechanism.dyads import RRP, Point
from crankwork.quantities import Language

HATCH = 8.0
GROUND_REACH = ((-34.0, 0.0), (38.0, 36.0))
FONT = 'font-family="DejaVu Sans, Verdana, Arial, sans-serif" font-size="14"'
_LINE = 'stroke="black" fill="none"'
_EDGE = 'stroke="black" stroke-width="1.6"'


class Box(NamedTuple):
    """What a drawing covers. [px]"""

    left: float
    top: float
    right: float
    bottom: float


class Stage(NamedTuple):
    """From metres to the picture: pixels per metre, time of a revolution, frame that is shown where nothing moves."""

    scale: float
    duration: str
    still: int

    def points(self, point: Track) -> Array:
        """Return the places of a point, shape (n, 2); the picture counts downward."""
        return np.asarray(point.place * np.array([1.0, -1.0]) * self.scale)

    def fixed(self, point: Point) -> Array:
        """Return the place of a fixed point, shape (2,)."""
        return np.array([point[0], -point[1]]) * self.scale


def animate(attribute: str, values: Sequence[str], stage: Stage, *, times: Sequence[float] = ()) -> str:
    """Return an animation of an attribute through values, in steps where their times are given."""
    steps = f' calcMode="discrete" keyTimes="{";".join(f"{time:.5g}" for time in times)}"' if times else ""
    again = f'dur="{stage.duration}" repeatCount="indefinite"'
    return f'<animate attributeName="{attribute}" values="{";".join(values)}"{steps} {again}/>'


def _moving(stage: Stage, coordinates: dict[str, Array]) -> tuple[str, str]:
    """Return attributes at rest, and the animations of those that change."""
    attributes, animations = [], []
    for name, values in coordinates.items():
        texts = [_text(value) for value in values]
        attributes.append(f'{name}="{texts[stage.still]}"')
        if len(set(texts)) > 1:
            animations.append(animate(name, texts, stage))
    return " ".join(attributes), "".join(animations)


def _text(value: float) -> str:
    return f"{value:.2f}".rstrip("0").rstrip(".") if abs(value) >= 0.005 else "0"


def moved(place: Array, right: float, down: float) -> Array:
    """Return a place, or each of shape (n, 2), moved by a fixed distance."""
    return np.asarray(place + np.array([right, down]))


def direction(start: Array, end: Array) -> Array:
    """Return unit vectors from one moving point to another, shape (n, 2)."""
    along = end - start
    return np.asarray(along / np.maximum(np.hypot(*along.T), 1e-9)[:, None])


def normal(along: Array) -> Array:
    """Return unit vectors a quarter turn further, shape (n, 2)."""
    return np.column_stack([-along[:, 1], along[:, 0]])


def on_guide(dyad: RRP, stage: Stage, along: ArrayLike, across: float) -> Array:
    """Return the place at a distance along a guide from its point, and across to its left."""
    cos, sin = math.cos(dyad.guide_angle), math.sin(dyad.guide_angle)
    return stage.fixed(dyad.guide_point) + np.multiply.outer(along, [cos, -sin]) + across * np.array([-sin, -cos])


def foot_on_guide(dyad: RRP, stage: Stage, point: Point) -> float:
    """Return how far along a guide a fixed point lies."""
    x, y = point[0] - dyad.guide_point[0], point[1] - dyad.guide_point[1]
    return stage.scale * (x * math.cos(dyad.guide_angle) + y * math.sin(dyad.guide_angle))


def is_on_guide(dyad: RRP, point: Point, along: Point) -> bool:
    """Return whether a line through a point is the centre line of a guide."""
    cos, sin = math.cos(dyad.guide_angle), math.sin(dyad.guide_angle)
    x, y = point[0] - dyad.guide_point[0], point[1] - dyad.guide_point[1]
    return abs(x * sin - y * cos) < 1e-3 * dyad.length and abs(along[0] * sin - along[1] * cos) < 1e-3


def link(stage: Stage, name: str, start: Array, end: Array, width: float) -> str:
    """Return a link as a line between two points, arrays of shape (n, 2)."""
    at, moves = _moving(stage, {"x1": start[:, 0], "y1": start[:, 1], "x2": end[:, 0], "y2": end[:, 1]})
    cap = 'stroke-linecap="round"'
    return f'<line class="link {html.escape(name)}" {at} {_LINE} stroke-width="{width:g}" {cap}>{moves}</line>'


def plate(stage: Stage, name: str, corners: Sequence[Array]) -> str:
    """Return a link as a polygon with moving corners, arrays of shape (n, 2)."""
    texts = [" ".join(f"{_text(x)},{_text(y)}" for x, y in frame) for frame in np.stack(corners, axis=1)]
    moves = animate("points", texts, stage) if len(set(texts)) > 1 else ""
    style = 'fill="#eee" stroke="black" stroke-width="3" stroke-linejoin="round"'
    return f'<polygon class="link {html.escape(name)}" points="{texts[stage.still]}" {style}>{moves}</polygon>'


def carried(stage: Stage, name: str, place: Array, along: Array, half: tuple[float, float], radius: float = 0) -> str:
    """Return a rectangle that follows a point and turns with a direction, arrays of shape (n, 2)."""
    turns = np.degrees(np.unwrap(np.arctan2(along[:, 1], along[:, 0])))
    x, y, width, height = (_text(one) for one in (-half[0], -half[1], 2 * half[0], 2 * half[1]))
    fill, rounded = ("white", f' rx="{radius:g}"') if radius else ("#ddd", "")
    shape = f'<rect x="{x}" y="{y}" width="{width}" height="{height}"{rounded} fill="{fill}" {_EDGE}>'
    turn = _transform(stage, "rotate", [_text(one) for one in turns])
    go = _transform(stage, "translate", [f"{_text(u)} {_text(v)}" for u, v in place])
    return f'<g class="{html.escape(name)}" {go[0]}>{go[1]}{shape[:-1]} {turn[0]}>{turn[1]}</rect></g>'


def _transform(stage: Stage, kind: str, texts: list[str]) -> tuple[str, str]:
    """Return a transformation at rest, and its animation if it changes."""
    moves = animate("transform", texts, stage).replace("<animate ", f'<animateTransform type="{kind}" ')
    return f'transform="{kind}({texts[stage.still]})"', moves if len(set(texts)) > 1 else ""


def rail(walls: Sequence[tuple[Array, Array]]) -> str:
    """Return the walls of a guide, from place to place, hatched on the left of the way as the picture shows it."""
    edges = "".join(_move(one) + _line(other) for one, other in walls)
    hatches = "".join(_hatch(one, other) for one, other in walls)
    return f'<path d="{edges}" {_LINE} stroke-width="1.6"/><path d="{hatches}" {_LINE} stroke-width="0.8"/>'


def centre_of_mass(stage: Stage, place: Array) -> str:
    """Return a centre of mass as a dot that follows a point, array of shape (n, 2)."""
    at, moves = _moving(stage, {"cx": place[:, 0], "cy": place[:, 1]})
    return f'<circle class="centre" {at} r="3" fill="black">{moves}</circle>'


def joint(stage: Stage, place: Array) -> str:
    """Return a turning joint as a circle that follows a point, array of shape (n, 2)."""
    at, moves = _moving(stage, {"cx": place[:, 0], "cy": place[:, 1]})
    return f'<circle class="joint" {at} r="5" fill="white" stroke="black" stroke-width="1.6">{moves}</circle>'


def block(dyad: RRP, stage: Stage, place: Array, half_width: float, half_height: float) -> str:
    """Return a slider as a rectangle across its guide that follows a point, array of shape (n, 2)."""
    texts = [f"{_text(x)} {_text(y)}" for x, y in place]
    turn = 90 - math.degrees(dyad.guide_angle)
    moves = animate("transform", texts, stage).replace("<animate ", '<animateTransform type="translate" ')
    x, y, width, height = (_text(one) for one in (-half_width, -half_height, 2 * half_width, 2 * half_height))
    shape = f'<rect x="{x}" y="{y}" width="{width}" height="{height}" transform="rotate({_text(turn)})"'
    shape += ' fill="#ddd" stroke="black" stroke-width="1.6"/>'
    return f'<g class="block {html.escape(dyad.slider)}" transform="translate({texts[stage.still]})">{moves}{shape}</g>'


def guide(dyad: RRP, stage: Stage, start: float, end: float, half_width: float, *, is_closed: bool) -> str:
    """Return the two walls of a guide, and its head if it has one, hatched on the outside."""

    def place(along: float, across: float) -> Array:
        return on_guide(dyad, stage, along, across)

    walls = [(place(start, half_width), place(end, half_width)), (place(end, -half_width), place(start, -half_width))]
    if is_closed:
        walls.insert(1, (place(end, half_width), place(end, -half_width)))
    return rail(walls)


def ground_pivot(place: Array) -> str:
    """Return the support of a fixed joint: a triangle upon hatched ground."""
    x, y = place
    support = f'<path d="M{_text(x)} {_text(y)}l-13 24h26z" fill="white" stroke="black" stroke-width="1.6"/>'
    start, end = moved(place, 20, 24), moved(place, -20, 24)
    base = f'<path d="{_move(start)}{_line(end)}" {_LINE} stroke-width="1.6"/>'
    return f'{support}{base}<path d="{_hatch(start, end)}" {_LINE} stroke-width="0.8"/>'


def centre_line(start: Array, end: Array) -> str:
    """Return a dash-dot line between two places."""
    return f'<path d="{_move(start)}{_line(end)}" {_LINE} stroke-width="0.8" stroke-dasharray="12 3 2 3"/>'


def path(places: Array) -> str:
    """Return the path of a point, array of shape (n, 2), as a thin dash-dot line."""
    d = _move(places[0]) + "".join(_line(one) for one in places[1:-1]) + "z"
    return f'<path class="path" d="{d}" {_LINE} stroke-width="0.6" stroke-dasharray="9 3 2 3"/>'


def name(stage: Stage, place: Array, letter: str) -> str:
    """Return an italic letter whose middle follows a place, array of shape (n, 2)."""
    return _writing(stage, place, letter, 'class="name" font-style="italic"')


def number(stage: Stage, place: Array, value: int) -> str:
    """Return the number of a link whose middle follows a place, array of shape (n, 2)."""
    return _writing(stage, place, str(value), 'class="number"')


def _writing(stage: Stage, place: Array, text: str, style: str) -> str:
    at, moves = _moving(stage, {"x": place[:, 0], "y": place[:, 1] + 5})
    halo = 'stroke="white" stroke-width="3" paint-order="stroke" text-anchor="middle"'
    return f"<text {style} {at} {FONT} {halo}>{html.escape(text)}{moves}</text>"


def scale_bar(x: float, y: float, scale: float, longest: float, language: Language) -> str:
    """Return a bar of a round length with the length written on it; `scale` in pixels per metre."""
    millimetres = longest / scale * 1e3
    power = 10.0 ** math.floor(math.log10(millimetres))
    round_length = max(one * power for one in (1, 2, 5) if one * power <= millimetres)
    width = round_length / 1e3 * scale
    line = f"M{_text(x)} {_text(y - 5)}v10m0 -5h{_text(width)}m0 -5v10"
    bar = f'<path class="scale" d="{line}" {_LINE} stroke-width="1.6"/>'
    text = f"{number_text(round_length, language)} {unit_name('mm', language)}"
    return f'{bar}<text x="{_text(x + width / 2)}" y="{_text(y - 8)}" {FONT} text-anchor="middle">{text}</text>'


def _move(place: Array) -> str:
    return f"M{_text(place[0])} {_text(place[1])}"


def _line(place: Array) -> str:
    return f"L{_text(place[0])} {_text(place[1])}"


def _hatch(start: Array, end: Array) -> str:
    """Return short slanted strokes on the left of the way from start to end, as the picture shows it."""
    along = end - start
    length = float(np.hypot(*along))
    ahead = along / length
    slant = HATCH * (np.array([ahead[1], -ahead[0]]) - ahead)
    feet = start + np.arange(HATCH, length + 0.1, HATCH)[:, None] * ahead
    return "".join(f"{_move(one)}l{_text(slant[0])} {_text(slant[1])}" for one in feet)
