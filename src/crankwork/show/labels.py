"""Names beside points of a drawing, placed so that they cover neither lines nor each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.show.chart import Box, Graph
from crankwork.show.paper import GREY, WIDER, Paper, plain, text_width
from crankwork.show.place import MM, here, letters
from crankwork.show.scene import Arc, Circle, Hatch, Item, Polyline, Text, arc_points, pen_of, printable, shade_of

_SIZE = 8.0
_LONGEST = 16
# samples along lines [pt]
_SPACING, _ALIKE = 2.4, 1.2
_REACHES = np.array([7.0, 9.0, 12.0, 16.0, 21.0, 27.0, 34.0, 42.0, 50.0])
_ANGLES = np.radians([45, 135, 90, 0, 180, 315, 225, 270, 22, 67, 112, 157, 202, 247, 292, 337])
_DIRECTIONS = np.column_stack([np.cos(_ANGLES), -np.sin(_ANGLES)])
# all ways from a mark to its name: where to, how far, and what each costs at least
_TOWARDS, _FAR = np.tile(_DIRECTIONS, (len(_REACHES), 1)), np.repeat(_REACHES, len(_DIRECTIONS))
_LEAST = _FAR + np.tile(0.1 * np.arange(len(_DIRECTIONS)), len(_REACHES))
# lines lighter than a net are what letters may stand on; what a place on a dark line and on a lighter one costs
_NET, _DARK = 0.8, 0.4
_FULL, _FAINT = 10, 3
# names looked at together, ways looked at closely first, and how far from the paper lines are minded [pt]
_TOGETHER, _CLOSELY, _BEYOND = 32, 16, 200.0

# a mark is misleading that is nearer than so many times the own one
_NEARER = 1.2
# names nearer than this would be read as one [pt]
_APART = np.array([2.5, 0.3])
_ALONG = np.linspace(0.1, 1.0, 10)[:, None, None]
_AROUND = arc_points(Arc((0.0, 0.0), 1.0, 0.0, 360.0))

# further from their mark than this, names have a line to it [pt]
_LED = 6.0

Mark = tuple[str, float, float]


class _Covered(NamedTuple):
    """What letters on lines cost: sums over the squares of a net from its lower corner onward, and that corner."""

    sums: NDArray[np.int64]
    corner: NDArray[np.int64]

    def cost(self, middles: Array, half: Array) -> Array:
        """Return how much of lines names would cover, arrays of shape (..., 2). [pt]"""
        size = np.array(self.sums.shape) - 1
        low = np.clip(np.floor((middles - half) / _ALIKE - 1).astype(int) + 1 - self.corner, 0, size)
        high = np.clip(np.ceil((middles + half) / _ALIKE + 1).astype(int) - self.corner, low, size)
        (a, b), (c, d) = np.moveaxis(low, -1, 0), np.moveaxis(high, -1, 0)
        return np.asarray(self.sums[c, d] - self.sums[a, d] - self.sums[c, b] + self.sums[a, b], dtype=float)


def label_points(graph: Graph, points: Sequence[Mark], *, size: float = _SIZE, dot: float = 1.3) -> None:
    """Mark points of a graph and write names of the user's own beside them.

    `points`: name and place in the units of the scales.
    """
    marks = [(plain(printable(name, _LONGEST)), *graph.point(x, y)) for name, x, y in points]
    label_marks(graph.paper, marks, size=size, dot=dot, frame=graph.box)


def mark(graph: Graph, name: str, x: float, y: float, text: str) -> None:
    """Mark a point of a curve with a dot and a text beside it, and keep it by its name."""
    graph.curves[name] = np.array([x]), np.array([y])
    label_marks(graph.paper, [(text, *graph.point(x, y))], dot=2.0, frame=graph.box)


def label_marks(
    paper: Paper, marks: Sequence[Mark], *, size: float = _SIZE, dot: float = 1.5, frame: Box | None = None
) -> None:
    """Mark places of a paper and name them, clear of all that was drawn before; far names get a thin line.

    Those that fall together share one mark; letters stand on cleared ground.
    """
    marks = _merged(marks)
    if not marks or here().is_rough:
        return
    places = np.array([(x, y) for _, x, y in marks])
    if dot:
        for x, y in places.tolist():
            paper.dot(x, y, dot)
    low, high = np.zeros(2), np.array([paper.width, paper.height])
    if frame is not None:
        low, high = np.array(frame[:2]), np.array(frame[:2]) + np.array(frame[2:])
    halves = np.array([[WIDER * text_width(name, size) / 2 + 0.8, 0.5 * letters(size) + 0.4] for name, _, _ in marks])
    ways = _TOWARDS * (_FAR[:, None] + np.abs(_TOWARDS) * (halves - halves.min(axis=1)[:, None])[:, None])
    costs = _costs(places, halves, ways, _covered(paper), (low, high))
    texts = _Texts.on(paper)
    chosen: list[tuple[str, Array, Array]] = []
    for at, (name, _, _) in enumerate(marks):
        start, half, way = places[at], halves[at], ways[at]
        best = texts.cheapest(start, half, way, costs[at])
        if np.max(np.abs(way[best]) - half) > _LED or _is_misleading(places, at, way[best]):
            _lead(paper, start, way[best], half)
        texts.add(start + way[best], half)
        chosen.append((name, start + way[best], half))
    # letters stand on cleared ground, over the thin lines of all names
    for _, place, half in chosen:
        corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half + place
        paper.area(corners[:, 0], corners[:, 1])
    for name, place, _ in chosen:
        paper.text(float(place[0]), float(place[1]) + 0.35 * letters(size), name, size=size, anchor="middle")


def _lead(paper: Paper, mark: Array, shift: Array, half: Array) -> None:
    """Draw a thin line to where a name begins."""
    share = 1.0 - min(1.0, float(np.min(half / np.maximum(np.abs(shift), 1e-9))))
    start, end = mark + 0.12 * shift, mark + share * shift
    paper.line([start[0], end[0]], [start[1], end[1]], width=0.4, colour=GREY)


class _Texts:
    """What is written on a paper: middles and halves of texts. [pt]"""

    def __init__(self, middles: Array, halves: Array) -> None:
        self._middles, self._halves = middles, halves

    @classmethod
    def on(cls, paper: Paper) -> Self:
        """Return what was written on a paper."""
        boxes = np.array([one[1:] for one in paper.texts]).reshape(-1, 4)
        return cls((boxes[:, :2] + boxes[:, 2:]) / 2, (boxes[:, 2:] - boxes[:, :2]) / 2 * (WIDER, 1.0))

    def add(self, middle: Array, half: Array) -> None:
        """Keep clear of a text, too."""
        self._middles, self._halves = np.vstack([self._middles, middle]), np.vstack([self._halves, half])

    def cheapest(self, mark: Array, half: Array, ways: Array, costs: Array) -> int:
        """Return which way from a mark costs least, clear of all texts."""
        near = np.all(np.abs(self._middles - mark) < np.abs(ways).max(axis=0) + half + self._halves + _APART, axis=1)
        if not near.any():
            return int(np.argmin(costs))
        middles, halves = self._middles[near] - mark, self._halves[near]
        apart = np.abs(ways[:, None] - middles) - (half + halves + _APART)
        costs = costs + 500.0 * ((apart[..., 0] < 0) & (apart[..., 1] < 0)).sum(axis=1)
        # texts beneath the line to a name are looked for only where it may go
        found = np.full_like(costs, np.inf)
        order = np.argsort(costs, kind="stable")
        for some in (order[:_CLOSELY], order[_CLOSELY:]):
            found[some] = costs[some] + 40.0 * _crossed(ways[some], middles, halves)
            if found.min() < costs[order[_CLOSELY]]:
                break
        return int(np.argmin(found))


def _crossed(ways: Array, middles: Array, halves: Array) -> NDArray[np.int64]:
    """Return how many texts the line to each place of a name would cross."""
    apart = np.abs(ways[:, None, None] * _ALONG - middles) - halves
    return np.asarray(((apart[..., 0] < 0) & (apart[..., 1] < 0)).any(axis=1).sum(axis=1))


def _costs(places: Array, halves: Array, ways: Array, covered: _Covered, frame: tuple[Array, Array]) -> Array:
    """Return what each way to each name costs, whatever other names do, shape (names, ways)."""
    result = np.tile(_LEAST, (len(places), 1))
    for first in range(0, len(places), _TOGETHER):
        some = slice(first, first + _TOGETHER)
        half, middles = halves[some, None], places[some, None] + ways[some]
        cost = result[some]
        cost += covered.cost(middles, half)
        x, y = (np.abs(middles[..., at, None] - places[:, at]) for at in (0, 1))
        others = np.any(places[some, None] != places, axis=2)[:, None]
        own = np.sum(ways[some] ** 2, axis=2)
        cost += 12.0 * (np.where(others, x * x + y * y, np.inf).min(axis=2) < _NEARER**2 * own)
        # a level line to a number would be read as its sign
        cost += 12.0 * (np.abs(_TOWARDS[:, 1]) < 0.2) * (_FAR - half[..., 1] > _LED)
        cost += 60.0 * np.any(others & (x < half[..., :1] + 1.4) & (y < half[..., 1:] + 1.4), axis=2)
        cost += 200.0 * np.any((middles - half < frame[0]) | (middles + half > frame[1]), axis=2)
    return result


def _is_misleading(places: Array, at: int, way: Array) -> bool:
    """Return whether a name would stand about as near to another mark as to its own."""
    others = places[np.any(places != places[at], axis=1)]
    nearest = np.min(np.hypot(*(places[at] + way - others).T), initial=np.inf)
    return bool(nearest < _NEARER * np.hypot(*way))


def _covered(paper: Paper) -> _Covered:
    """Return what letters on the lines of a paper cost; those sampled before are known to the paper."""
    cells = np.vstack([paper.sampled, _sampled(paper.items[paper.looked_at :], (paper.width, paper.height))])
    paper.sampled, paper.looked_at = cells, len(paper.items)
    corner = cells[:, :2].min(axis=0, initial=0)
    size = cells[:, :2].max(axis=0, initial=0) - corner + 1
    # where lines crowd, their points are not counted twice
    are_passed = np.zeros((2, *size), dtype=bool)
    are_passed[cells[:, 2], cells[:, 0] - corner[0], cells[:, 1] - corner[1]] = True
    sums = np.zeros(size + 1, dtype=np.int64)
    sums[1:, 1:] = (_FAINT * are_passed[0] + _FULL * are_passed[1]).cumsum(axis=0).cumsum(axis=1)
    return _Covered(sums, corner)


def _sampled(items: Sequence[Item], paper: tuple[float, float]) -> NDArray[np.int64]:
    """Return the squares of a net that lines near a paper pass, and whether they are dark, shape (n, 3)."""
    lines: list[Array] = []
    shades: list[float] = []
    # letters may stand on hatches, and give way to others elsewhere
    for item in (one for one in items if not isinstance(one, Text | Hatch)):
        shade = _shade(item)
        if shade <= _NET:
            lines.append(_points(item))
            shades.append(shade)
    if not lines:
        return np.zeros((0, 3), dtype=int)
    counts = [len(one) for one in lines]
    first = np.cumsum([0, *counts[:-1]])
    places = np.vstack(lines) / (MM, -MM)
    steps = np.hypot(*np.diff(places, axis=0, prepend=places[:1]).T)
    # lines follow one another with a gap between
    steps[first] = 1.0
    along = np.cumsum(steps)
    starts, ends = along[first], along[first + counts - 1]
    numbers = np.ceil((ends - starts) / _SPACING + 1).astype(int)
    of = np.repeat(np.arange(len(lines)), numbers)
    steps = _SPACING * (np.arange(len(of)) - (np.cumsum(numbers) - numbers)[of])
    at = np.minimum(starts[of] + steps, ends[of])
    found = np.column_stack([np.interp(at, along, places[:, 0]), np.interp(at, along, places[:, 1])])
    kept = np.all((found > -_BEYOND) & (found < np.array(paper) + _BEYOND), axis=1)
    are_dark = np.array(shades)[of] < _DARK
    return np.column_stack([np.round(found / _ALIKE), are_dark])[kept].astype(np.int64)


def _shade(item: Polyline | Circle | Arc) -> float:
    """Return how light a line is, 1 for what letters may stand on."""
    pen, fill = pen_of(item.kind), None if isinstance(item, Arc) else item.fill
    return shade_of(pen) if pen.width else 1.0 if fill is None else fill


def _points(item: Polyline | Circle | Arc) -> Array:
    """Return points along a line, shape (n, 2). [mm]"""
    if isinstance(item, Circle):
        return _AROUND * item.radius + item.centre
    if isinstance(item, Arc):
        return arc_points(item)
    return np.vstack([item.points, item.points[:1]]) if item.closed else item.points


def _merged(marks: Sequence[Mark]) -> list[Mark]:
    """Return the marks, those within a point of the paper joined."""
    result: list[Mark] = []
    for name, x, y in marks:
        same = [at for at, (_, a, b) in enumerate(result) if np.hypot(a - x, b - y) < 1.0]
        if same:
            first, a, b = result[same[0]]
            result[same[0]] = (", ".join(dict.fromkeys([*first.split(", "), name])), a, b)
        else:
            result.append((name, float(x), float(y)))
    return result
