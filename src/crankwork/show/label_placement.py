"""Placement of names next to points, so that they cover neither lines nor each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.show.canvas import GREY, MM, WIDER, Canvas, current_layout, fitted_lines, font_size, plain, text_width
from crankwork.show.scene import Arc, Circle, Hatch, Item, Polyline, Text, arc_points, pen_of, printable, shade_of

if TYPE_CHECKING:
    from crankwork.show.chart import ChartBox, Graph, Row

_SIZE = 8.0
_LONGEST = 16
# spacing of samples along lines, and cell of the net that counts them [pt]
_SPACING, _CELL = 2.4, 1.2
_REACHES = np.array([7.0, 9.0, 12.0, 16.0, 21.0, 27.0, 34.0, 42.0, 50.0])
_ANGLES = np.radians([45, 135, 90, 0, 180, 315, 225, 270, 22, 67, 112, 157, 202, 247, 292, 337])
_DIRECTIONS = np.column_stack([np.cos(_ANGLES), -np.sin(_ANGLES)])
# all offsets from a mark to its name, their lengths, and their least costs
_OFFSETS, _LENGTHS = np.tile(_DIRECTIONS, (len(_REACHES), 1)), np.repeat(_REACHES, len(_DIRECTIONS))
_MIN_COSTS = _LENGTHS + np.tile(0.1 * np.arange(len(_DIRECTIONS)), len(_REACHES))
# letters may cover lines lighter than a net; costs of a cell of a dark line and of a lighter one
_NET, _DARK = 0.8, 0.4
_FULL, _FAINT = 10, 3
# names per batch, offsets examined first, and distance from the paper up to which lines count [pt]
_BATCH_SIZE, _CLOSELY, _BEYOND = 32, 16, 200.0
# a name is ambiguous if another mark is nearer than this factor times its own
_NEARER = 1.2
# names nearer than this would be read as one [pt]
_CLEARANCE = np.array([2.5, 0.3])
_ALONG = np.linspace(0.1, 1.0, 10)[:, None, None]
_AROUND = arc_points(Arc((0.0, 0.0), 1.0, 0.0, 360.0))

# names further from their mark have a leader line [pt]
_LEADER_DISTANCE = 6.0

# name of a curve: its letters, the sample of its line, the gap behind it, net of the places that are tried, edge [pt]
_NAME, _SAMPLE, _GAP, _PLACES, _EDGE = 8.0, 15.0, 3.0, (8.0, 4.0), 2.5
# shares of the width of a graph on which a name is tried, cost of a further row, of being nearer to another curve [pt]
_WIDTHS, _FURTHER, _CONFUSED = (0.75, 0.36, 0.2), 40.0, 30.0
# points of a curve to which distances are taken, and the cost of a name on lines or other names
_POINTS, _CROSSED = 40, 1e4

Mark = tuple[str, float, float]


class _LineCosts(NamedTuple):
    """Cumulative costs of letters on lines over the cells of a net, and the lower corner of the net."""

    sums: NDArray[np.int64]
    corner: NDArray[np.int64]

    def cost(self, middles: Array, half: Array) -> Array:
        """Return the cost of the lines that names would cover, arrays of shape (..., 2). [pt]"""
        size = np.array(self.sums.shape) - 1
        low = np.clip(np.floor((middles - half) / _CELL - 1).astype(int) + 1 - self.corner, 0, size)
        high = np.clip(np.ceil((middles + half) / _CELL + 1).astype(int) - self.corner, low, size)
        (a, b), (c, d) = np.moveaxis(low, -1, 0), np.moveaxis(high, -1, 0)
        return np.asarray(self.sums[c, d] - self.sums[a, d] - self.sums[c, b] + self.sums[a, b], dtype=float)


def label_points(graph: Graph, points: Sequence[Mark], *, size: float = _SIZE, dot: float = 1.3) -> None:
    """Mark points of a graph and write the user's names next to them.

    `points`: name and position in the units of the scales.
    """
    marks = [(plain(printable(name, _LONGEST)), *graph.point(x, y)) for name, x, y in points]
    label_marks(graph.paper, marks, size=size, dot=dot, frame=graph.box)


def mark_point(graph: Graph, name: str, x: float, y: float, text: str) -> None:
    """Mark a point of a curve with a dot and a text, and store it by its name."""
    graph.curves[name] = np.array([x]), np.array([y])
    label_marks(graph.paper, [(text, *graph.point(x, y))], dot=2.0, frame=graph.box)


def label_marks(
    paper: Canvas, marks: Sequence[Mark], *, size: float = _SIZE, dot: float = 1.5, frame: ChartBox | None = None
) -> None:
    """Mark positions and name them, clear of everything drawn before.

    Coinciding marks are merged; far names get a thin line; letters have cleared ground.
    """
    marks = _merged(marks)
    if not marks or current_layout().is_rough:
        return
    positions = np.array([(x, y) for _, x, y in marks])
    if dot:
        for x, y in positions.tolist():
            paper.dot(x, y, dot)
    low, high = np.zeros(2), np.array([paper.width, paper.height])
    if frame is not None:
        low, high = np.array(frame[:2]), np.array(frame[:2]) + np.array(frame[2:])
    halves = np.array([[WIDER * text_width(name, size) / 2 + 0.8, 0.5 * font_size(size) + 0.4] for name, _, _ in marks])
    offsets = _OFFSETS * (_LENGTHS[:, None] + np.abs(_OFFSETS) * (halves - halves.min(axis=1)[:, None])[:, None])
    costs = _costs(positions, halves, offsets, _line_costs(paper), (low, high))
    texts = _Texts.on(paper)
    chosen: list[tuple[str, Array, Array]] = []
    for index, (name, _, _) in enumerate(marks):
        start, half = positions[index], halves[index]
        offset = offsets[index][texts.cheapest(start, half, offsets[index], costs[index])]
        if np.max(np.abs(offset) - half) > _LEADER_DISTANCE or _is_ambiguous(positions, index, offset):
            _draw_leader(paper, start, offset, half)
        texts.add(start + offset, half)
        chosen.append((name, start + offset, half))
    # above the leader lines of all names
    for _, middle, half in chosen:
        corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half + middle
        paper.area(corners[:, 0], corners[:, 1])
    for name, middle, _ in chosen:
        paper.text(float(middle[0]), float(middle[1]) + 0.35 * font_size(size), name, size=size, anchor="middle")


def _draw_leader(paper: Canvas, mark: Array, shift: Array, half: Array) -> None:
    """Draw a thin line from a mark to the edge of its name."""
    share = 1.0 - min(1.0, float(np.min(half / np.maximum(np.abs(shift), 1e-9))))
    start, end = mark + 0.12 * shift, mark + share * shift
    paper.line([start[0], end[0]], [start[1], end[1]], width=0.45, colour=GREY)


class _Texts:
    """Texts on a canvas: middles and half sizes. [pt]"""

    def __init__(self, middles: Array, halves: Array) -> None:
        self._middles, self._halves = middles, halves

    @classmethod
    def on(cls, paper: Canvas) -> Self:
        """Return the texts that are on a canvas."""
        boxes = np.array([text[1:] for text in paper.texts]).reshape(-1, 4)
        return cls((boxes[:, :2] + boxes[:, 2:]) / 2, (boxes[:, 2:] - boxes[:, :2]) / 2 * (WIDER, 1.0))

    def add(self, middle: Array, half: Array) -> None:
        """Add a text to keep clear of."""
        self._middles, self._halves = np.vstack([self._middles, middle]), np.vstack([self._halves, half])

    def overlapped(self, middles: Array, half: Array) -> NDArray[np.int64]:
        """Return the number of texts that a text would cover at each place, shape (n,)."""
        reach = half + self._halves + _CLEARANCE
        near = np.all(
            (self._middles + reach > middles.min(axis=0)) & (self._middles - reach < middles.max(axis=0)), axis=1
        )
        x, y = (np.abs(middles[:, None, axis] - self._middles[near, axis]) < reach[near, axis] for axis in (0, 1))
        return np.asarray((x & y).sum(axis=1))

    def cheapest(self, mark: Array, half: Array, offsets: Array, costs: Array) -> int:
        """Return the index of the cheapest offset from a mark, clear of all texts."""
        limit = np.abs(offsets).max(axis=0) + half + self._halves + _CLEARANCE
        near = np.all(np.abs(self._middles - mark) < limit, axis=1)
        if not near.any():
            return int(np.argmin(costs))
        middles, halves = self._middles[near] - mark, self._halves[near]
        gaps = np.abs(offsets[:, None] - middles) - (half + halves + _CLEARANCE)
        costs = costs + 500.0 * ((gaps[..., 0] < 0) & (gaps[..., 1] < 0)).sum(axis=1)
        # leader lines over texts are searched for the cheapest offsets first
        total = np.full_like(costs, np.inf)
        order = np.argsort(costs, kind="stable")
        for batch in (order[:_CLOSELY], order[_CLOSELY:]):
            total[batch] = costs[batch] + 40.0 * _crossed(offsets[batch], middles, halves)
            if total.min() < costs[order[_CLOSELY]]:
                break
        return int(np.argmin(total))


def name_curves(paper: Canvas, rows: Sequence[Row], box: ChartBox) -> list[Row]:
    """Write what rows say within the first graph of a box, each near the curve of its line, clear of all else.

    Returned are the rows that have no clear place.
    """
    # above it there may be a band
    places = [
        np.array([left, -low - height, width, height]) / MM
        for left, low, width, height in (plot.box for plot in paper.plots)
    ]
    under = [place for place in places if abs(place[0] - box.left) < 1 and place[1] > box.top - 1]
    first = min(under, key=lambda place: float(place[1]), default=np.array(box))
    frame = first[:2], first[2:]
    left_over: list[Row] = []
    texts, costs = _Texts.on(paper), _line_costs(paper)
    lines = [item for item in paper.items if isinstance(item, Polyline) and item.name and _lies_in(item, frame)]
    curves = [_points_of_row(row, lines) for row in rows]
    for index, row in enumerate(rows):
        other_curves = np.vstack([*curves[:index], *curves[index + 1 :], np.zeros((0, 2))])
        tried = dict.fromkeys(fitted_lines(row.text, _NAME, share * frame[1][0]) for share in _WIDTHS)
        options = [_place_of_name(words, frame, (curves[index], other_curves), (texts, costs)) for words in tried]
        cost, words, middle, half = min(options, key=lambda option: option[0])
        if cost > _CROSSED:
            left_over.append(row)
            continue
        texts.add(middle, half)
        (left, top), size = (middle - half).tolist(), font_size(_NAME)
        ends = [left, left + _SAMPLE], [top + 0.6 * size] * 2
        paper.line(*ends, style=row.style, width=row.width, colour=row.colour, name="legend")
        for count, text in enumerate(words):
            paper.write((left + _SAMPLE + _GAP, top + size * (0.85 + 1.15 * count)), text, _NAME, halo=True)
    return left_over


def _place_of_name(
    words: tuple[str, ...], frame: tuple[Array, Array], curves: tuple[Array, Array], taken: tuple[_Texts, _LineCosts]
) -> tuple[float, tuple[str, ...], Array, Array]:
    """Return the cost of the best place for the name of a curve, the name, its middle and half its size."""
    width = WIDER * max(text_width(text, _NAME) for text in words) + _SAMPLE + _GAP
    half = np.array([width, font_size(_NAME) * 1.15 * len(words)]) / 2
    low, high = frame[0] + half + _EDGE, frame[0] + frame[1] - half - _EDGE
    if np.any(low > high):
        return np.inf, words, (low + high) / 2, half
    counts = (np.arange(int(count) + 1) for count in (high - low) / _PLACES)
    middles = low + np.stack(np.meshgrid(*counts), axis=-1).reshape(-1, 2) * _PLACES
    covered = taken[1].cost(middles, half + _EDGE) + 500.0 * taken[0].overlapped(middles, half)
    middles, least = middles[covered == covered.min()], float(covered.min())
    own, other = (_distances(middles, half, points) for points in curves)
    cost = own + _CONFUSED * (other <= own) + _FURTHER * len(words) + _CROSSED * (least > 0)
    return float(cost.min()), words, middles[int(np.argmin(cost))], half


def _distances(middles: Array, half: Array, points: Array) -> Array:
    """Return the distances of boxes from the nearest of some points. [pt]"""
    x, y = (np.maximum(np.abs(middles[:, None, axis] - points[:, axis]) - half[axis], 0.0) for axis in (0, 1))
    return np.asarray(np.sqrt((x * x + y * y).min(axis=1, initial=1e6)))


def _lies_in(item: Polyline, frame: tuple[Array, Array]) -> bool:
    middle = item.points.mean(axis=0) / (MM, -MM) - frame[0]
    return bool(np.all((middle >= -1) & (middle <= frame[1] + 1)))


def _points_of_row(row: Row, lines: Sequence[Polyline]) -> Array:
    """Return points along the curves that have the line of a row, of its width if there are any, shape (n, 2). [pt]"""
    style, lines_of_style = np.round(row.style, 2).tolist(), list[tuple[Polyline, bool]]()
    for item in lines:
        pen = pen_of(item.kind)
        if pen.colour == row.colour and np.round(np.array(pen.dashes) / pen.width, 2).tolist() == style:
            lines_of_style.append((item, bool(np.isclose(pen.width, row.width * MM))))
    any_as_wide = any(is_as_wide for _, is_as_wide in lines_of_style)
    chosen = [item.points / (MM, -MM) for item, is_as_wide in lines_of_style if is_as_wide or not any_as_wide]
    return np.vstack([np.zeros((0, 2)), *map(_evenly, chosen)])


def _evenly(line: Array) -> Array:
    """Return points at equal distances along a line, shape (n, 2)."""
    along = np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))
    places = np.linspace(0.0, along[-1], _POINTS)
    return np.column_stack([np.interp(places, along, column) for column in line.T])


def _crossed(offsets: Array, middles: Array, halves: Array) -> NDArray[np.int64]:
    """Return the number of texts that the line to each offset would cross."""
    gaps = np.abs(offsets[:, None, None] * _ALONG - middles) - halves
    return np.asarray(((gaps[..., 0] < 0) & (gaps[..., 1] < 0)).any(axis=1).sum(axis=1))


def _costs(positions: Array, halves: Array, offsets: Array, lines: _LineCosts, frame: tuple[Array, Array]) -> Array:
    """Return the cost of each offset of each name, independent of other names, shape (names, offsets)."""
    result = np.tile(_MIN_COSTS, (len(positions), 1))
    for first in range(0, len(positions), _BATCH_SIZE):
        batch = slice(first, first + _BATCH_SIZE)
        half, middles = halves[batch, None], positions[batch, None] + offsets[batch]
        cost = result[batch]
        cost += lines.cost(middles, half)
        x, y = (np.abs(middles[..., axis, None] - positions[:, axis]) for axis in (0, 1))
        is_other = np.any(positions[batch, None] != positions, axis=2)[:, None]
        own = np.sum(offsets[batch] ** 2, axis=2)
        cost += 12.0 * (np.where(is_other, x * x + y * y, np.inf).min(axis=2) < _NEARER**2 * own)
        # a level line to a number would be read as its sign
        cost += 12.0 * (np.abs(_OFFSETS[:, 1]) < 0.2) * (_LENGTHS - half[..., 1] > _LEADER_DISTANCE)
        cost += 60.0 * np.any(is_other & (x < half[..., :1] + 1.4) & (y < half[..., 1:] + 1.4), axis=2)
        cost += 200.0 * np.any((middles - half < frame[0]) | (middles + half > frame[1]), axis=2)
    return result


def _is_ambiguous(positions: Array, index: int, offset: Array) -> bool:
    """Return whether a name would be about as near to another mark as to its own."""
    others_at = positions[np.any(positions != positions[index], axis=1)]
    nearest = np.min(np.hypot(*(positions[index] + offset - others_at).T), initial=np.inf)
    return bool(nearest < _NEARER * np.hypot(*offset))


def _line_costs(paper: Canvas) -> _LineCosts:
    """Return the costs of letters on the lines of a canvas, which stores its samples."""
    cells = np.vstack([paper.sampled, _sampled(paper.items[paper.sampled_items :], (paper.width, paper.height))])
    paper.sampled, paper.sampled_items = cells, len(paper.items)
    corner = cells[:, :2].min(axis=0, initial=0)
    size = cells[:, :2].max(axis=0, initial=0) - corner + 1
    # each cell counts once, even if lines crowd in it
    are_passed = np.zeros((2, *size), dtype=bool)
    are_passed[cells[:, 2], cells[:, 0] - corner[0], cells[:, 1] - corner[1]] = True
    sums = np.zeros(size + 1, dtype=np.int64)
    sums[1:, 1:] = (_FAINT * are_passed[0] + _FULL * are_passed[1]).cumsum(axis=0).cumsum(axis=1)
    return _LineCosts(sums, corner)


def _sampled(items: Sequence[Item], paper: tuple[float, float]) -> NDArray[np.int64]:
    """Return the cells of a net that lines near a paper pass, and whether the lines are dark, shape (n, 3)."""
    lines: list[Array] = []
    shades: list[float] = []
    # letters may cover hatches, and other letters are avoided elsewhere
    for item in items:
        if not isinstance(item, Text | Hatch) and (shade := _shade(item)) <= _NET:
            lines.append(_points(item))
            shades.append(shade)
    if not lines:
        return np.zeros((0, 3), dtype=int)
    counts = [len(line) for line in lines]
    first = np.cumsum([0, *counts[:-1]])
    points = np.vstack(lines) / (MM, -MM)
    steps = np.hypot(*np.diff(points, axis=0, prepend=points[:1]).T)
    # a gap between consecutive lines
    steps[first] = 1.0
    along = np.cumsum(steps)
    starts, ends = along[first], along[first + counts - 1]
    numbers = np.ceil((ends - starts) / _SPACING + 1).astype(int)
    owner = np.repeat(np.arange(len(lines)), numbers)
    steps = _SPACING * (np.arange(len(owner)) - (np.cumsum(numbers) - numbers)[owner])
    distances = np.minimum(starts[owner] + steps, ends[owner])
    samples = np.column_stack([np.interp(distances, along, points[:, axis]) for axis in (0, 1)])
    mask = np.all((samples > -_BEYOND) & (samples < np.array(paper) + _BEYOND), axis=1)
    are_dark = np.array(shades)[owner] < _DARK
    return np.column_stack([np.round(samples / _CELL), are_dark])[mask].astype(np.int64)


def _shade(item: Polyline | Circle | Arc) -> float:
    """Return the lightness of a line, 1 if letters may cover it."""
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
    """Return the marks, with those that coincide within a point merged."""
    result: list[Mark] = []
    for name, x, y in marks:
        same = [index for index, (_, a, b) in enumerate(result) if np.hypot(a - x, b - y) < 1.0]
        if same:
            first, a, b = result[same[0]]
            result[same[0]] = (", ".join(dict.fromkeys([*first.split(", "), name])), a, b)
        else:
            result.append((name, float(x), float(y)))
    return result
