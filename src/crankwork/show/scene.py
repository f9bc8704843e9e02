"""What is drawn: lines, circles, arcs, texts and hatches on a paper. All lengths in millimetres, y upward."""

from __future__ import annotations

import re
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language

LineKind = Literal["thick", "medium", "thin", "dashed", "dash_dot", "dotted", "axis", "net", "grid", "grid_bold"]
Anchor = Literal["start", "middle", "end"]

# letters as tall as GOST 2.304 has them
TITLE, TEXT, SMALL = 5.0, 3.5, 2.5


class Pen(NamedTuple):
    """How a line is drawn: width, lengths of dashes and gaps, shade from black 0 to white 1, or a colour `#rrggbb`.

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


# dashes and gaps of the lines of a chart, in widths of the line
Style = tuple[float, ...]
SOLID: Style = ()
DASHED: Style = (5.0, 2.0)
DASH_DOT: Style = (7.0, 2.0, 1.5, 2.0)
DOTTED: Style = (1.2, 1.6)


def pen_of(kind: LineKind | Pen) -> Pen:
    """Return how a line is drawn that has a kind or a pen of its own."""
    return kind if isinstance(kind, Pen) else PENS[kind]


class Box(NamedTuple):
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

    def inset(self, left: float, bottom: float, right: float, top: float) -> Box:
        """Return what is left of it within margins."""
        return Box(self.left + left, self.bottom + bottom, self.width - left - right, self.height - bottom - top)


class Polyline(NamedTuple):
    """A broken line through points, array of shape (n, 2); `fill` shades what a closed one surrounds, 1 is white.

    `name` is the key of the quantity that it shows, empty for all else.
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
    """A line of text upon its baseline, capitals `height` tall, turned by an angle [deg].

    `M_{i}` sets an index, `10^{3}` an exponent, `/{M}` slanted letters; `grey` as of a `Pen`.
    """

    place: tuple[float, float]
    text: str
    height: float = TEXT
    anchor: Anchor = "start"
    angle: float = 0.0
    grey: float = 0.0


class Hatch(NamedTuple):
    """Slanted thin lines at a distance within a polygon, array of shape (n, 2). [mm]"""

    points: Array
    spacing: float = 2.5


Item = Polyline | Circle | Arc | Text | Hatch


class Drawing(NamedTuple):
    """A scene on its paper, which is white."""

    title: str
    language: Language
    width: float
    height: float
    items: tuple[Item, ...]


def line(start: ArrayLike, end: ArrayLike, kind: LineKind = "thin") -> Polyline:
    """Return a straight line between two points, shape (2,)."""
    return Polyline(np.array([start, end], dtype=float), kind)


def rectangle(box: Box, kind: LineKind = "thin", fill: float | None = None) -> Polyline:
    """Return the sides of a rectangle."""
    corners = [(box.left, box.bottom), (box.right, box.bottom), (box.right, box.top), (box.left, box.top)]
    return Polyline(np.array(corners), kind, closed=True, fill=fill)


def arrow(start: ArrayLike, end: ArrayLike, kind: LineKind = "thin", *, head: float = 3.0) -> list[Item]:
    """Return a line with a head at its end, left out where the line is shorter than two heads. [mm]"""
    tail, tip = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    length = float(np.hypot(*(tip - tail)))
    if length < 1e-9:
        return []
    head = min(head, length / 2)
    along = (tip - tail) / length
    across = np.array([-along[1], along[0]]) * head / 6
    foot = tip - head * along
    return [line(tail, foot, kind), Polyline(np.array([tip, foot + across, foot - across]), closed=True, fill=0.0)]


class Run(NamedTuple):
    """A part of a text: what it says, whether it is an index (-1), an exponent (1) or neither, and slanted."""

    text: str
    shift: int
    is_slanted: bool = False


_MARKED = re.compile(r"([_^/])\{([^{}]*)\}")
_SHIFTS = {"_": -1, "^": 1, "/": 0}


def runs(text: str) -> list[Run]:
    """Return the parts of a text, indices, exponents and slanted letters apart.

    Examples
    --------
    >>> [tuple(one) for one in runs("/{M}_{кр} = 5")]
    [('M', 0, True), ('кр', -1, False), (' = 5', 0, False)]
    """
    found, last = [], 0
    for one in _MARKED.finditer(text):
        found += [Run(text[last : one.start()], 0), Run(one[2], _SHIFTS[one[1]], one[1] == "/")]
        last = one.end()
    found.append(Run(text[last:], 0))
    return [one for one in found if one.text]


def indexed(symbol: str) -> str:
    """Return a symbol `base_index` of the table of quantities as text with an index.

    Examples
    --------
    >>> indexed("v_п.ср"), indexed("β")
    ('v_{п.ср}', 'β')
    """
    base, _, index = symbol.partition("_")
    return f"{base}_{{{index}}}" if index else base


def printable(name: str, longest: int = 24) -> str:
    """Return a name from outside with a box for what cannot be printed, shortened, and without marks of an index."""
    name = name if len(name) <= longest else f"{name[: longest - 1]}…"
    return "".join(one if one.isprintable() else "□" for one in name).replace("{", "(").replace("}", ")")


_NARROW, _WIDE = frozenset(" .,:;|!'′ijltfrI()[]/°·"), frozenset("mwMWШЩЖЮФМшщжюфыЫЪм@—…%ωφψΣΦΩ")
_EMS = dict.fromkeys("0123456789−", 0.48)
CAP_HEIGHT = 0.658
INDEX = 0.7


def text_width(text: str, height: float = TEXT) -> float:
    """Return about how wide a text is, rather too much. [mm]"""
    width = 0.0
    for run in runs(text):
        for one in run.text:
            ems = 0.33 if one in _NARROW else 0.86 if one in _WIDE else 0.69 if one.isupper() else _EMS.get(one, 0.53)
            # Cyrillic letters are wider than Latin ones
            ems += 0.05 if "Ѐ" <= one <= "ӿ" else 0.0
            width += ems * (INDEX if run.shift else 1.0)
    return width * height / CAP_HEIGHT


def extent(item: Item) -> Box:
    """Return what an item covers, letters about. [mm]"""
    match item:
        case Text():
            width = text_width(item.text, item.height)
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
    return Box(float(low[0]), float(low[1]), float(high[0] - low[0]), float(high[1] - low[1]))


# of a line, what nobody sees [mm]
_UNSEEN = 0.01


def thinned(points: Array, within: float = _UNSEEN) -> Array:
    """Return the points of a line without those that lie as near as that to the line that is left. [mm]

    By Douglas and Peucker.
    """
    kept = np.zeros(len(points), dtype=bool)
    kept[[0, -1]] = True
    open_parts = [(0, len(points) - 1)]
    while open_parts:
        first, last = open_parts.pop()
        if last - first < 2:
            continue
        way, inner = points[last] - points[first], points[first + 1 : last] - points[first]
        # nearest point between the ends, because a line may turn back
        shares = np.clip(inner @ way / max(float(way @ way), 1e-30), 0.0, 1.0)
        apart = np.hypot(inner[:, 0] - shares * way[0], inner[:, 1] - shares * way[1])
        farthest = int(np.argmax(apart))
        if apart[farthest] > within:
            middle = first + 1 + farthest
            kept[middle] = True
            open_parts += [(first, middle), (middle, last)]
    return points[kept]


def arc_points(item: Arc) -> Array:
    """Return points along an arc, shape (n, 2). [mm]"""
    angles = np.radians(np.linspace(item.start, item.end, 1 + max(2, int(abs(item.end - item.start) / 3))))
    return np.column_stack([np.cos(angles), np.sin(angles)]) * item.radius + item.centre


def hatch_lines(item: Hatch) -> list[Array]:
    """Return the strokes of a hatch at 45 degrees within its polygon, arrays of shape (2, 2). [mm]"""
    turn = np.array([[1.0, -1.0], [1.0, 1.0]]) / np.sqrt(2)
    # rows of `turned` are measured across and along the strokes
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
