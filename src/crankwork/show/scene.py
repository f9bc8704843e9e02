"""Scenes: lines, circles, arcs, texts and hatches on a paper. All lengths in millimetres, y upward."""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language

LineKind = Literal["thick", "medium", "thin", "dashed", "dash_dot", "dotted", "axis", "net", "grid", "grid_bold"]
Anchor = Literal["start", "middle", "end"]

# heights of letters by GOST 2.304
TITLE, TEXT, SMALL = 5.0, 3.5, 2.5


class Pen(NamedTuple):
    """Style of a line: width, lengths of dashes and gaps, shade from black 0 to white 1, or a colour `#rrggbb`.

    Lengths in mm.
    """

    width: float
    dashes: tuple[float, ...] = ()
    grey: float = 0.0
    colour: str = ""


PENS: dict[LineKind, Pen] = {
    "thick": Pen(0.7),
    "medium": Pen(0.5),
    "thin": Pen(0.25),
    "dashed": Pen(0.5, (4.0, 1.5)),
    "dash_dot": Pen(0.5, (8.0, 1.5, 1.0, 1.5)),
    "dotted": Pen(0.5, (1.0, 1.4)),
    "axis": Pen(0.25, (12.0, 2.0, 1.5, 2.0)),
    "net": Pen(0.13, (), 0.65),
    "grid": Pen(0.05, (), 0.75),
    "grid_bold": Pen(0.13, (), 0.7),
}


# widths of lines after ISO 128
_WIDTHS = (0.13, 0.18, 0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0)

# dashes and gaps of the lines of a chart, in widths of the line
Style = tuple[float, ...]
SOLID: Style = ()
DASHED: Style = (5.0, 2.0)
DASH_DOT: Style = (7.0, 2.0, 1.5, 2.0)
DOTTED: Style = (1.2, 1.6)
# of curves beside each other, in their order
STYLES: tuple[Style, ...] = (SOLID, DASHED, DASH_DOT, DOTTED)


def pen_of(kind: LineKind | Pen) -> Pen:
    """Return the pen of a kind of line, or the pen itself."""
    return kind if isinstance(kind, Pen) else PENS[kind]


def shade_of(pen: Pen) -> float:
    """Return the lightness of a line, from ink 0 to paper 1; of a colour that of its red."""
    return int(pen.colour[1:3], 16) / 255 if pen.colour else pen.grey


class ChartBox(NamedTuple):
    """A rectangle. [mm]"""

    left: float
    bottom: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """Its right side. [mm]"""
        return self.left + self.width

    @property
    def top(self) -> float:
        """Its upper side. [mm]"""
        return self.bottom + self.height

    def inset(self, left: float, bottom: float, right: float, top: float) -> ChartBox:
        """Return the box within margins."""
        return ChartBox(self.left + left, self.bottom + bottom, self.width - left - right, self.height - bottom - top)


class Polyline(NamedTuple):
    """A polyline through points, array of shape (n, 2); `fill` shades a closed one, 1 is white.

    `name`: key of the quantity that it shows, or empty.
    """

    points: Array
    kind: LineKind | Pen = "thin"
    closed: bool = False
    fill: float | None = None
    name: str = ""


class Circle(NamedTuple):
    """A circle; `fill` shades it, 1 is white."""

    centre: tuple[float, float]
    radius: float
    kind: LineKind | Pen = "thin"
    fill: float | None = None


class Arc(NamedTuple):
    """A part of a circle, anticlockwise from one direction to another. [deg]"""

    centre: tuple[float, float]
    radius: float
    start: float
    end: float
    kind: LineKind = "thin"


class Text(NamedTuple):
    """A line of text on its baseline, capitals `height` tall, rotated by an angle [deg].

    `M_{i}` sets an index, `10^{3}` an exponent, `/{M}` slanted letters; `grey` as of a `Pen`; `halo` clears the ground
    around its edges; `wide`: width over that of the font, at most 1.
    """

    place: tuple[float, float]
    text: str
    height: float = TEXT
    anchor: Anchor = "start"
    angle: float = 0.0
    grey: float = 0.0
    halo: bool = False
    wide: float = 1.0


class Hatch(NamedTuple):
    """Slanted thin lines at a distance within a polygon, array of shape (n, 2). [mm]"""

    points: Array
    spacing: float = 2.5


Item = Polyline | Circle | Arc | Text | Hatch


class Plot(NamedTuple):
    """Position and scales of a graph on its drawing.

    `over`: key of the quantity on the x axis, if tables use it; `angles`: crank angles [deg] of the points of curves
    over other quantities, by the names of their lines; `curves`: their values in the units of the scales, by the same
    names; `titles`: of the axes, by `x` and `y`; `frame`: its `ticks` across and upward, which of them have `labels`,
    `powers` of ten, and the range of its `items`; `metre`: its length if joints of a linkage are drawn to scale. [mm]
    """

    box: ChartBox
    x: tuple[float, float]
    y: tuple[float, float]
    over: str
    angles: Mapping[str, Array]
    curves: Mapping[str, tuple[Array, Array]]
    titles: Mapping[str, str]
    frame: Mapping[str, Any] = {}
    metre: float = 0.0


class Drawing(NamedTuple):
    """A scene on white paper, with its graphs."""

    title: str
    language: Language
    width: float
    height: float
    items: tuple[Item, ...]
    plots: tuple[Plot, ...] = ()


def line(start: ArrayLike, end: ArrayLike, kind: LineKind = "thin") -> Polyline:
    """Return a straight line between two points, shape (2,)."""
    return Polyline(np.array([start, end], dtype=float), kind)


def rotation_arrow(
    centre: ArrayLike, radius: float, sense: float, around: float = 90.0, kind: LineKind | Pen = "thin"
) -> list[Item]:
    """Return an arrow of rotation about a centre, on both sides of a direction [deg]; `sense`: + anticlockwise."""
    turns = np.radians(around + math.copysign(1.0, sense) * np.linspace(-43.0, 43.0, 16))
    points = np.asarray(centre, dtype=float) + radius * np.column_stack([np.cos(turns), np.sin(turns)])
    head = Polyline(np.array([(0.0, 0.0), (-1.8, 0.55), (-1.8, -0.55)]), Pen(0.0), closed=True, fill=0.0)
    ahead = math.degrees(math.atan2(*(points[-1] - points[-4])[::-1]))
    return [Polyline(points[:-2], kind), use_layout(head, points[-1], ahead)]


def rectangle(box: ChartBox, kind: LineKind = "thin", fill: float | None = None) -> Polyline:
    """Return the sides of a rectangle."""
    corners = [(box.left, box.bottom), (box.right, box.bottom), (box.right, box.top), (box.left, box.top)]
    return Polyline(np.array(corners), kind, closed=True, fill=fill)


class Run(NamedTuple):
    """Part of a text: index (-1), exponent (1) or neither (0), and whether it is slanted."""

    text: str
    shift: int
    is_slanted: bool = False


_MARKED = re.compile(r"([_^/])\{([^{}]*)\}")
# braces in users' names, replaced by unprintable characters until the marks have been read
_BRACES = str.maketrans("{}", "\uf07b\uf07d")
_AS_WRITTEN = str.maketrans("\uf07b\uf07d", "{}")
_SHIFTS = {"_": -1, "^": 1, "/": 0}


def runs(text: str) -> list[Run]:
    """Split a text into plain parts, indices, exponents and slanted letters.

    Examples
    --------
    >>> [tuple(run) for run in runs("/{M}_{кр} = 5")]
    [('M', 0, True), ('кр', -1, False), (' = 5', 0, False)]
    """
    parts, last = [], 0
    for match in _MARKED.finditer(text):
        parts += [Run(text[last : match.start()], 0), Run(match[2], _SHIFTS[match[1]], match[1] == "/")]
        last = match.end()
    parts.append(Run(text[last:], 0))
    return [part._replace(text=part.text.translate(_AS_WRITTEN)) for part in parts if part.text]


def literal(name: str) -> str:
    """Escape a user's name, so that no mark is read in it.

    Examples
    --------
    >>> [run.text for run in runs(f"point {literal('P_{1}')}")]
    ['point P_{1}']
    """
    return name.translate(_BRACES)


def printable(name: str, longest: int = 24) -> str:
    """Return a name, shortened, with a box for each unprintable character.

    Examples
    --------
    >>> printable("piston"), printable("piston", longest=6), printable("piston", longest=5)
    ('piston', 'piston', 'pist…')
    """
    name = name if len(name) <= longest else f"{name[: longest - 1]}…"
    return "".join(letter if letter.isprintable() else "□" for letter in name)


_NARROW, _WIDE = frozenset(" .,:;|!'′ijltfrI()[]/°·"), frozenset("mwMWШЩЖЮФМшщжюфыЫЪм@—…%ωφψΣΦΩ")
_EMS = dict.fromkeys("0123456789−", 0.48)
CAP_HEIGHT = 0.658
INDEX = 0.7


def text_width(text: str, height: float = TEXT) -> float:
    """Return an upper estimate of the width of a text. [mm]"""
    return _ems(text) * height / CAP_HEIGHT


# the layout of sheets is tried with the same words again and again
@functools.lru_cache(maxsize=4096)
def _ems(text: str) -> float:
    width = 0.0
    for run in runs(text):
        for sign in run.text:
            ems = (
                0.33 if sign in _NARROW else 0.86 if sign in _WIDE else 0.69 if sign.isupper() else _EMS.get(sign, 0.53)
            )
            # Cyrillic letters are wider than Latin ones
            ems += 0.05 if "Ѐ" <= sign <= "ӿ" else 0.0
            width += ems * (INDEX if run.shift else 1.0)
    return width


def flow_rows(texts: Sequence[str], between: str, room: float, width: Callable[[str], float] = text_width) -> list[str]:
    """Join texts to rows of a limited width."""
    rows: list[str] = []
    for text in texts:
        joined = f"{rows[-1]}{between}{text}" if rows else text
        if rows and width(joined) <= room:
            rows[-1] = joined
        else:
            rows.append(text)
    return rows


def moved(item: Item, right: float, up: float, larger: float = 1.0) -> Item:
    """Return an item enlarged about the origin, then shifted. [mm]"""
    shift = np.array([right, up])
    match item:
        case Text():
            x, y = item.place
            return item._replace(place=(larger * x + right, larger * y + up), height=larger * item.height)
        case Circle() | Arc():
            x, y = item.centre
            centre, radius = (larger * x + right, larger * y + up), larger * item.radius
            if isinstance(item, Arc):
                return item._replace(centre=centre, radius=radius)
            return item._replace(centre=centre, radius=radius, kind=_broader(item.kind, larger))
        case Hatch():
            return Hatch(larger * item.points + shift, larger * item.spacing)
    return item._replace(points=larger * item.points + shift, kind=_broader(item.kind, larger))


def use_layout(item: Item, shift: ArrayLike, turn: float = 0.0, stretch: float = 1.0) -> Item:
    """Return an item stretched along x, rotated anticlockwise about the origin, shifted; circles stay round. [deg]"""
    cos, sin = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    matrix = np.array([[stretch * cos, stretch * sin], [-sin, cos]])
    match item:
        case Text():
            x, y = np.array(item.place) @ matrix
            item = item._replace(place=(float(x), float(y)), angle=item.angle + turn)
        case Circle() | Arc():
            x, y = np.array(item.centre) @ matrix
            item = item._replace(centre=(float(x), float(y)))
            item = item._replace(start=item.start + turn, end=item.end + turn) if isinstance(item, Arc) else item
        case _:
            item = item._replace(points=item.points @ matrix)
    return moved(item, *np.asarray(shift, dtype=float).tolist())


def moved_plot(plot: Plot, right: float, up: float, larger: float = 1.0) -> Plot:
    """Return a graph enlarged about the origin, then shifted. [mm]"""
    left, bottom, width, height = (larger * length for length in plot.box)
    return plot._replace(box=ChartBox(left + right, bottom + up, width, height))


def _broader(kind: LineKind | Pen, larger: float) -> LineKind | Pen:
    """Return the pen of an enlarged line, with a standard width."""
    if larger == 1.0 or not isinstance(kind, Pen) or not kind.width:
        return kind
    width = min(_WIDTHS, key=lambda width: abs(math.log(width / (larger * kind.width))))
    return kind._replace(width=width, dashes=tuple(larger * dash for dash in kind.dashes))


def extent(item: Item) -> ChartBox:
    """Return the bounding box of an item, of letters an estimate. [mm]"""
    match item:
        case Text():
            width = item.wide * text_width(item.text, item.height)
            left = {"start": 0.0, "middle": -width / 2, "end": -width}[item.anchor]
            low = -0.35 * item.height
            turn = np.radians(item.angle)
            corners = np.array([[x, y] for x in (left, left + width) for y in (low, item.height)])
            points = corners @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]) + item.place
        case Circle() | Arc():
            x, y = item.centre
            points = np.array([[x - item.radius, y - item.radius], [x + item.radius, y + item.radius]])
            if isinstance(item, Arc):
                points = arc_points(item)
        case _:
            points = item.points
    low, high = points.min(axis=0), points.max(axis=0)
    return ChartBox(float(low[0]), float(low[1]), float(high[0] - low[0]), float(high[1] - low[1]))


# invisible deviation of a line [mm]
INVISIBLE_DEVIATION = 0.01


def simplified(points: Array, within: float = INVISIBLE_DEVIATION) -> Array:
    """Return a line without the points that are within a distance of the remaining line. [mm]"""
    return points[visible_points(points, within)] if len(points) > 2 else points


def visible_points(points: Array, within: float) -> NDArray[np.bool_]:
    """Return a mask of the points of a line that are not within a distance of the line through the others. [mm]"""
    return visible_points_of_each([points], within)[0]


def visible_points_of_each(lines: Sequence[Array], within: float) -> list[NDArray[np.bool_]]:
    """Return the masks of visible points of all lines at once. [mm]

    By Douglas and Peucker.
    """
    ends = np.cumsum([len(line) for line in lines])
    mask = np.zeros(ends[-1] if len(lines) else 0, dtype=bool)
    mask[ends - 1] = mask[ends[:-1]] = True
    mask[:1] = True
    across, up = np.vstack([*lines, np.zeros((0, 2))]).T.copy()
    unknown = np.flatnonzero(~mask)
    while unknown.size:
        # all intervals between visible points at once
        known = np.flatnonzero(mask)
        part = np.cumsum(mask)[unknown] - 1
        start, end = known[part], known[part + 1]
        span_x, span_y = across[end] - across[start], up[end] - up[start]
        off_x, off_y = across[unknown] - across[start], up[unknown] - up[start]
        # nearest point between the ends, because a line may turn back
        along = (off_x * span_x + off_y * span_y) / np.maximum(span_x * span_x + span_y * span_y, 1e-30)
        shares = np.clip(along, 0.0, 1.0)
        distance = np.hypot(off_x - shares * span_x, off_y - shares * span_y)
        begins = np.append(True, part[1:] != part[:-1])
        farthest = np.maximum.reduceat(distance, np.flatnonzero(begins))[np.cumsum(begins) - 1]
        is_seen = farthest > within
        candidates = np.flatnonzero(is_seen & (distance == farthest))
        # the first of equally distant points
        is_first = np.append(True, part[candidates[1:]] != part[candidates[:-1]])[: candidates.size]
        mask[unknown[candidates[is_first]]] = True
        unknown = unknown[is_seen & ~mask[unknown]]
    return np.split(mask, ends[:-1])


def arc_points(item: Arc) -> Array:
    """Return points along an arc, shape (n, 2). [mm]"""
    angles = np.radians(np.linspace(item.start, item.end, 1 + max(2, int(abs(item.end - item.start) / 3))))
    return np.column_stack([np.cos(angles), np.sin(angles)]) * item.radius + item.centre


def hatch_lines(item: Hatch) -> list[Array]:
    """Return the strokes of a hatch at 45 degrees within its polygon, arrays of shape (2, 2). [mm]"""
    turn = np.array([[1.0, -1.0], [1.0, 1.0]]) / np.sqrt(2)
    # columns of `turned`: across and along the strokes
    turned = item.points @ turn
    start, end = turned, np.roll(turned, -1, axis=0)
    first = np.ceil(turned[:, 1].min() / item.spacing) * item.spacing
    strokes = []
    for level in np.arange(first, turned[:, 1].max(), item.spacing):
        crossed = (start[:, 1] > level) != (end[:, 1] > level)
        share = (level - start[crossed, 1]) / (end[crossed, 1] - start[crossed, 1])
        cuts = np.sort(start[crossed, 0] + share * (end[crossed, 0] - start[crossed, 0]))
        strokes += [np.array([[a, level], [b, level]]) @ turn.T for a, b in zip(cuts[::2], cuts[1::2], strict=False)]
    return strokes
