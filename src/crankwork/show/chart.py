"""Graphs: scales, ticks, titles, curves, contours, marks and the legend above, in the style of all figures."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.locale.numbers import number
from crankwork.quantities import Language
from crankwork.show import scene
from crankwork.show.canvas import (
    BLACK,
    GREY,
    LIGHT,
    WIDER,
    Canvas,
    current_layout,
    fitted_lines,
    marked,
    points_per_mm,
    round_scale,
    scaled_height,
    text_width,
)
from crankwork.show.label_placement import name_curves
from crankwork.show.scene import DASH_DOT, SOLID, Anchor, Style

BOTTOM, TOP = 45.0, 10.0
LEGEND_ROW = 13.4
_TICK, _SMALL, _LEGEND = 8.0, 7.5, 8.0
_FOOT_ROW = 9.0
# more curves than these are named by a legend above
_NAMED = 4
# from an axis to its numbers, with the gap between them and the title [pt]; readers' fonts may have wider figures
_CLEAR, WIDE_FIGURES = 15.0, 1.3
# range of the largest number of an axis without a power of ten
_SHORT = 0.01, 1e5
# Styles of legend rows that explain an open circle, a dot, and an arrow.
CIRCLE: Style = (0.0,)
DOT: Style = (-2.0,)
ARROW: Style = (-1.0,)
# size of numbers, distance between numbers, and from the edges of the graph [pt]
_SIZE, _SPACING, _EDGE = 7.5, 30.0, 9.0
# a shorter line has no number [pt]
_SHORT_LINE = 45.0


class ChartBox(NamedTuple):
    """Position of a graph on its canvas: left and upper edge, width, height. [pt]"""

    left: float
    top: float
    width: float
    height: float


class Row(NamedTuple):
    """A row of a legend: text, style (`CIRCLE`, `DOT`, `ARROW`), width of the line [pt] or 0 for none, its colour."""

    text: str
    style: Style = SOLID
    width: float = 0.9
    colour: str = BLACK


def round_ticks(low: float, high: float, most: float = 8) -> Array:
    """Return round numbers within a range. [its unit]

    Multiples of 1, 2, 2.5 or 5 times a power of ten.
    """
    span = (high - low) or 1.0
    power = 10.0 ** math.floor(math.log10(span / most))
    step = next(factor * power for factor in (1, 2, 2.5, 5, 10, 20) if span / (factor * power) <= most)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return np.array([float(f"{index * step:.10g}") for index in range(first, last + 1)])


def true_slices(where: NDArray[np.bool_]) -> list[slice]:
    """Return the slices in which a condition holds."""
    ends = np.flatnonzero(np.diff(np.concatenate([[False], where, [False]])))
    return [slice(int(start), int(end)) for start, end in ends.reshape(-1, 2)]


def _rounded(length: float, ends: tuple[float, float]) -> float:
    """Return the greatest length, no longer than this one, at which a millimetre is a round number. [pt]"""
    span = abs(ends[1] - ends[0])
    return span / round_scale(span * points_per_mm() / length) * points_per_mm()


def _power(ends: tuple[float, float]) -> int:
    """Return the power of ten, a multiple of 3, that keeps the numbers of an axis short; 0 if they are short anyway."""
    most = max(abs(end) for end in ends)
    return 0 if _SHORT[0] <= most < _SHORT[1] else 3 * math.floor(math.log10(2 * most) / 3)


class Graph:
    """Axes on a canvas with fixed scales: x from left to right, y from the lower to the upper edge.

    `over`: key of the quantity on the x axis, if tables use it; `to_scale`: on a sheet the graph shrinks until a
    millimetre is a round number of its units.
    """

    def __init__(  # noqa: PLR0913 - where, both scales, and what they are of
        self,
        paper: Canvas,
        box: ChartBox,
        x: tuple[float, float],
        y: tuple[float, float],
        language: Language,
        over: str = "",
        *,
        to_scale: bool = True,
    ) -> None:
        if current_layout().is_sheet and to_scale:
            box = box._replace(width=_rounded(box.width, x), height=_rounded(box.height, y))
        self.paper, self.box, self.x, self.y, self.language = paper, box, x, y, language
        self.curves: dict[str, tuple[Array, Array]] = {}
        self._angles: dict[str, Array] = {}
        self._titles: dict[str, str] = {}
        self._frame: dict[str, Any] = {}
        # width of the numbers of the vertical axis [pt]
        self._numbers = 0.0
        titles = self._titles if to_scale or not current_layout().is_sheet else {}
        paper.plot(scene.Plot(scene.ChartBox(*box), x, y, over, self._angles, self.curves, titles, self._frame))

    @property
    def powers(self) -> tuple[int, int]:
        """Powers of ten that are taken out of the numbers of both axes and written in their titles."""
        if current_layout().is_sheet:
            return 0, 0
        return _power(self.x), _power(self.y)

    @property
    def up_ticks(self) -> Array:
        """Round numbers on the vertical axis, as many as have room. [its unit]"""
        most = max(4, round(self.box.height / 24))
        return round_ticks(*self.y, max(1.0, min(most, self.box.height / 13)) if current_layout().is_sheet else most)

    def across(self, x: float | Array) -> Array:
        """Return the positions of values of x on the canvas. [pt]"""
        start, end = self.x
        return self.box.left + self.box.width * (np.asarray(x, dtype=float) - start) / (end - start)

    def down(self, y: float | Array) -> Array:
        """Return the positions of values of y on the canvas. [pt]"""
        start, end = self.y
        return self.box.top + self.box.height * (1 - (np.asarray(y, dtype=float) - start) / (end - start))

    def point(self, x: float, y: float) -> tuple[float, float]:
        """Return the position of a point on the canvas. [pt]"""
        return float(self.across(x)), float(self.down(y))

    def curve(  # noqa: PLR0913 - values, how they are drawn, and where they stand
        self,
        name: str,
        x: Sequence[float] | Array,
        y: Sequence[float] | Array,
        style: Style = SOLID,
        *,
        width: float = 0.9,
        colour: str = BLACK,
        angles: Array | None = None,
    ) -> None:
        """Draw a named curve; `angles`: crank angles of its points over another quantity. [deg]"""
        x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        self.curves[name] = (x, y)
        if angles is not None:
            self._angles[name] = angles
        # gaps at missing values
        for part in true_slices(np.isfinite(x + y)):
            self.paper.line(
                self.across(x[part]), self.down(y[part]), style=style, width=width, colour=colour, name=name
            )

    def shade(self, x: Array, y: Array, fill: str = "#d9d9d9") -> None:
        """Shade a polygon."""
        self.paper.area(self.across(x), self.down(y), fill=fill)

    def hatch(self, x: Array, y: Array) -> None:
        """Hatch a polygon."""
        self.paper.hatch(self.across(x), self.down(y))

    def frame(self, x_ticks: Array, y_ticks: Array, *, labels: tuple[bool, bool] = (True, True)) -> None:
        """Draw grid, ticks and numbers; the horizontal axis goes through zero if that is within the scale."""
        left, top, width, height = self.box
        right, bottom = left + width, top + height
        first = len(self.paper.items)
        if labels[0] and x_ticks.size > 1:
            # numbers that would touch are left out, zero last
            number_width = max(text_width(self._number(value, 0), _TICK) for value in x_ticks) + _TICK / 2
            step = math.ceil(number_width / float(np.ptp(self.across(x_ticks[:2]))))
            x_ticks = x_ticks[int(np.argmin(np.abs(x_ticks))) % step :: step]
        across, down = self.across(x_ticks), self.down(y_ticks)
        grid = [(x, top, x, bottom) for x in across] + [(left, y, right, y) for y in down]
        self.paper.segments(np.array(grid), colour=LIGHT)
        is_inside = min(self.y) < 0 < max(self.y)
        level = float(self.down(0.0)) if is_inside else bottom
        marks = [(x, level - 2.5, x, level + 2.5) for x in across] + [(left - 3.5, y, left, y) for y in down]
        self.paper.segments(np.array([(left, top, left, bottom), (left, level, right, level), *marks]), width=0.45)
        if labels[0]:
            for value, x in zip(x_ticks, across, strict=True):
                self.paper.text(x, bottom + 12.5, self._number(value, 0), size=_TICK, anchor="middle")
        if labels[1]:
            for value, y in zip(y_ticks, down, strict=True):
                text = self._number(value, 1)
                self.paper.text(left - 6, y + 3, text, size=_TICK, anchor="end")
                self._numbers = max(self._numbers, WIDE_FIGURES * text_width(text, _TICK))
        ticks, items = [x_ticks.tolist(), y_ticks.tolist()], (first, len(self.paper.items))
        self._frame |= {"ticks": ticks, "labels": labels, "powers": self.powers, "items": items}

    def tick_text(self, value: float) -> str:
        """Format a value as the numbers of the vertical axis, to four digits."""
        return self._number(float(f"{value:.4g}"), 1)

    def _number(self, value: float, axis: int) -> str:
        return number(float(f"{value / 10.0 ** self.powers[axis]:.10g}"), self.language)

    def _titled(self, text: str, axis: int) -> str:
        """Return the title of an axis with the power of ten that is taken out of its numbers before its unit."""
        power = self.powers[axis]
        if not power:
            return text
        name, comma, unit = text.rpartition(", ")
        factor = f"10^{{{power}}}".replace("-", "−")
        return f"{name}{comma}{factor} {unit}" if comma else f"{text}, {factor}"

    def set_quantity(self, y: str) -> None:
        """Set the quantity of the vertical axis if its title is written elsewhere."""
        self._titles["y"] = marked(y)

    def x_title(self, text: str) -> None:
        """Write the title of the horizontal axis under its numbers."""
        self._titles["x"], text = marked(text), self._titled(text, 0)
        self.paper.text(self.box.left + self.box.width / 2, self.box.top + self.box.height + 26, text, anchor="middle")

    def y_title(self, text: str, offset: float = 44.0) -> None:
        """Write the title of the vertical axis, on two lines if it is long; `offset`: its least distance. [pt]"""
        self._titles["y"], offset = marked(text), max(offset, self._numbers + _CLEAR)
        size, text, room = 8.0, self._titled(text, 1), (self.box.height + 10) / WIDER
        lines = fitted_lines(text, size, room)
        words, sign, rest = text.partition("$")
        if len(lines) == 2 and words and text_width(words, size) <= room:
            # a unit does not stand without its symbol
            lines = words.rstrip(), sign + rest
        if len(lines) > 2 and current_layout().is_sheet and "$" in text:
            # a sheet has no smaller letters; the symbol is explained above it
            lines = fitted_lines(text[text.index("$") :], size, room)
        elif len(lines) > 2:
            size = 7.0
            lines = fitted_lines(text, size, room)
        for index, line in enumerate(reversed(lines)):
            x = self.box.left - offset - 11 * index
            self.paper.upward_text(x, self.box.top + self.box.height / 2, line, size=size)

    def text_on_white(self, x: float, y: float, text: str, anchor: Anchor = "start", size: float = 8.0) -> None:
        """Write a text on white ground, so that no line of the graph runs through it. [pt]"""
        width = text_width(text, size)
        left = {"start": x, "middle": x - width / 2, "end": x - width}[anchor] - 2
        right, top, bottom = left + width + 4, y - size, y + 0.4 * size
        corners = [left, right, right, left], [top, top, bottom, bottom]
        self.paper.area(*corners)
        self.paper.text(x, y, text, size=size, anchor=anchor)

    def level(self, value: float, style: Style = DASH_DOT, name: str = "") -> None:
        """Draw a horizontal line across the graph at a value. [its unit]"""
        self.curve(name, [self.x[0], self.x[1]], [value, value], style, width=0.45 if style == DASH_DOT else 0.9)


def _is_line(row: Row) -> bool:
    """Return whether a row names a curve, not a mark, an arrow or what is said of the whole figure."""
    return bool(row.width) and row.style not in (CIRCLE, DOT, ARROW)


def _above(rows: Sequence[Row]) -> list[Row]:
    """Return the rows that stand above a graph: those of curves on sheets, and of more than can be named in it."""
    is_legend = current_layout().is_sheet or sum(map(_is_line, rows)) > _NAMED
    return [row for row in rows if is_legend or not _is_line(row)]


def _legend_lines(rows: Sequence[Row]) -> list[tuple[Row | None, str]]:
    """Return the lines of a legend; continued lines of a long text have no row."""
    lines: list[tuple[Row | None, str]] = []
    for row in rows:
        first, *continued = fitted_lines(
            row.text, _LEGEND, (current_layout().width - current_layout().left - 38) / WIDER
        )
        lines += [(row, first), *((None, line) for line in continued)]
    return lines


def _column_count(lines: Sequence[tuple[Row | None, str]]) -> int:
    """Return how many lines of a legend stand beside each other: two where each is short."""
    layout = current_layout()
    half = (layout.width - layout.left - 8) / 2
    short = all(row is not None and text_width(text, _LEGEND) * WIDER + 30 < half for row, text in lines)
    return 2 if short and len(lines) > 1 and not layout.is_sheet else 1


def legend_height(rows: Sequence[Row]) -> float:
    """Return the height of a legend above its graph. [pt]"""
    lines = _legend_lines(rows)
    return LEGEND_ROW * -(-len(lines) // _column_count(lines)) + 5.0 if rows else 0.0


def legend(paper: Canvas, rows: Sequence[Row], top: float) -> None:
    """Draw a legend at the left edge of a graph, from `top` downward. [pt]"""
    lines, layout = _legend_lines(rows), current_layout()
    columns = _column_count(lines)
    for index, (row, text) in enumerate(lines):
        line, column = divmod(index, columns)
        left, level = layout.left + 8 + column * (layout.width - layout.left - 8) / 2, top + LEGEND_ROW * line
        if row is not None and row.style == CIRCLE:
            paper.dot(left + 10, level + 6, 2.6, fill="#ffffff", width=0.9)
        elif row is not None and row.style == DOT:
            paper.dot(left + 10, level + 6, 1.6, fill=row.colour)
        elif row is not None and row.style == ARROW:
            paper.arrow((left, level + 6), (left + 20, level + 6), width=row.width)
        elif row is not None and row.width:
            ends = [left, left + 20], [level + 6] * 2
            paper.line(*ends, style=row.style, width=row.width, colour=row.colour, name="legend")
        paper.text(left + 27, level + 9, text, size=_LEGEND)


def name_at_the_end(paper: Canvas, rows: Sequence[Row], box: ChartBox) -> None:
    """Name the curves of the first graph of a box in it once all else is drawn, above it where it has no room."""
    if rows and not current_layout().is_rough:
        paper.last.append(partial(_name, paper, rows, box))


def _name(paper: Canvas, rows: Sequence[Row], box: ChartBox) -> None:
    if left_over := name_curves(paper, rows, box):
        paper.make_room(legend_height(left_over))
        legend(paper, left_over, TOP - 4)


def limits(*values: Array, margin: float = 0.06, is_place: bool = False) -> tuple[float, float]:
    """Return the ends of a scale that includes zero and all values. [its unit]

    `margin`: beyond the extremes, as a fraction of the range; `is_place`: the scale of a coordinate does not include
    zero if zero is further away than the range is wide.
    """
    known = np.concatenate([np.ravel(column)[np.isfinite(np.ravel(column))] for column in values])
    if is_place and known.size and 0 < np.ptp(known) < np.min(np.abs(known)):
        room = margin * float(np.ptp(known))
        return float(np.min(known)) - room, float(np.max(known)) + room
    known = np.append(known, 0.0)
    low, high = float(np.min(known)), float(np.max(known))
    room = margin * (high - low) or 1.0
    return (low - room if low < 0 else 0.0), (high + room if high > 0 or low == 0 else 0.0)


def over_cycle(
    paper: Canvas, box: ChartBox, y: tuple[float, float], cycle: float, language: Language, *, numbers: bool = True
) -> Graph:
    """Return a graph over the crank angle with its frame drawn.

    `cycle`: end of the crank angle [deg].
    """
    graph = Graph(paper, box, (0.0, cycle), y, language, "crank_angle")
    ticks = np.arange(0.0, cycle + 1, 30.0 if graph.box.width * 30.0 > 22.0 * cycle else 90.0)
    graph.frame(ticks, graph.up_ticks, labels=(numbers, True))
    return graph


def sheet(height: float, rows: Sequence[Row] = (), *, below: float = BOTTOM) -> tuple[Canvas, ChartBox]:
    """Return a canvas with what stands above a graph, and the box of the graph, whose curves are named in it. [pt]"""
    kept = _above(rows)
    above = legend_height(kept)
    layout, height = current_layout(), scaled_height(height)
    paper = Canvas(layout.width, TOP + above + height + below)
    legend(paper, kept, TOP - 4)
    box = ChartBox(layout.left, TOP + above, layout.inner, height)
    name_at_the_end(paper, [row for row in rows if row not in kept], box)
    return paper, box


def write_remark(paper: Canvas, remark: str) -> None:
    """Write a remark under a figure."""
    if not remark:
        return
    if current_layout().is_sheet:
        layout, foot = current_layout(), max(box[4] for box in paper.texts) + 13
        for index, row in enumerate(fitted_lines(remark, 8, layout.width / WIDER)):
            paper.text(layout.left + layout.inner / 2, foot + 12 * index, row, size=8, anchor="middle")
        return
    size = 7.0
    rows = fitted_lines(remark, size, 0.94 * paper.width / WIDER)
    paper.height += _FOOT_ROW * (len(rows) - 1)
    for index, row in enumerate(rows):
        foot = paper.height - 6 - _FOOT_ROW * (len(rows) - 1 - index)
        paper.text(paper.width * 0.02, foot, row, size=size, colour=GREY)


def small_text(paper: Canvas, x: float, y: float, text: str, anchor: Anchor = "middle") -> None:
    """Write a text in small letters. [pt]"""
    paper.text(x, y, text, size=_SMALL, anchor=anchor)


class Field:
    """Heights over a grid of shape (across, up), split into triangles; nan makes a hole."""

    def __init__(self, x: Array, y: Array, z: Array) -> None:
        across, up = np.meshgrid(x, y, indexing="ij")
        points = np.stack([across, up, z], axis=-1)
        # a fifth point amid four corners makes the course of lines unique
        middle = (points[:-1, :-1] + points[1:, :-1] + points[:-1, 1:] + points[1:, 1:]) / 4
        nodes = np.arange(z.size).reshape(z.shape)
        ring = nodes[:-1, :-1], nodes[1:, :-1], nodes[1:, 1:], nodes[:-1, 1:]
        centre = z.size + np.arange(middle[..., 0].size).reshape(middle.shape[:2])
        self._points = np.concatenate([points.reshape(-1, 3), middle.reshape(-1, 3)])
        sides = zip(ring, ring[1:] + ring[:1], strict=True)
        corners = [np.stack([start, end, centre], axis=-1) for start, end in sides]
        self._triangles = np.sort(np.array(corners).reshape(-1, 3), axis=1)
        self.holes = np.isnan(middle[..., 2])

    def lines(self, level: float) -> list[Array]:
        """Return the contour lines of a height, each of shape (n, 2)."""
        height = self._points[self._triangles, 2] - level
        with np.errstate(invalid="ignore"):
            is_over = height >= 0
        is_cut = is_over.any(axis=1) & ~is_over.all(axis=1) & np.isfinite(height).all(axis=1)
        neighbours: dict[tuple[int, int], list[tuple[int, int]]] = {}
        for triangle, over in zip(self._triangles[is_cut].tolist(), is_over[is_cut].tolist(), strict=True):
            first, second = ((triangle[a], triangle[b]) for a, b in ((0, 1), (0, 2), (1, 2)) if over[a] != over[b])
            neighbours.setdefault(first, []).append(second)
            neighbours.setdefault(second, []).append(first)
        # open lines before closed ones
        starts = [edge for edge, adjacent in neighbours.items() if len(adjacent) == 1] + list(neighbours)
        return [self._points_on(edges, level) for start in starts if len(edges := _follow_line(neighbours, start)) > 1]

    def _points_on(self, edges: list[tuple[int, int]], level: float) -> Array:
        start, end = self._points[np.array(edges).T]
        share = (level - start[:, 2:]) / (end[:, 2:] - start[:, 2:])
        return np.asarray(start[:, :2] + share * (end[:, :2] - start[:, :2]))


def _follow_line(
    neighbours: dict[tuple[int, int], list[tuple[int, int]]], start: tuple[int, int]
) -> list[tuple[int, int]]:
    """Return the edges that a line crosses from a first one, and remove them from the neighbours."""
    edges = [start]
    while neighbours.get(edges[-1]):
        following = neighbours[edges[-1]].pop()
        neighbours[following].remove(edges[-1])
        edges.append(following)
    return edges


def contours(graph: Graph, field: Field, levels: Array, mark: tuple[float, float] | None = None) -> None:
    """Draw contour lines with their numbers, none where a mark is on the canvas. [pt]"""
    lines_by_level = {level: field.lines(level) for level in levels.tolist()}
    for level, lines in lines_by_level.items():
        for index, line in enumerate(lines):
            graph.curve(f"{level:g}_{index}", line[:, 0], line[:, 1], width=0.9)
    occupied = [] if mark is None else [np.array(mark)]
    for level, lines in lines_by_level.items():
        shown = [np.column_stack([graph.across(line[:, 0]), graph.down(line[:, 1])]) for line in lines]
        for line in sorted(shown, key=_length, reverse=True):
            text = number(level, graph.language)
            half = WIDER * text_width(text, _SIZE) / 2
            position = _free(line, graph, occupied, half) if _length(line) >= _SHORT_LINE else None
            if position is not None:
                occupied.append(position)
                graph.text_on_white(float(position[0]), float(position[1]) + 0.35 * _SIZE, text, "middle", _SIZE)


def _length(line: Array) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


def _free(line: Array, graph: Graph, occupied: list[NDArray[np.float64]], half: float) -> NDArray[np.float64] | None:
    """Return the position on a line that is farthest from occupied ones, or near the middle if there are none.

    `half`: half the width of a number. [pt]
    """
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    samples = np.linspace(0.0, along[-1], 41)
    positions = np.column_stack([np.interp(samples, along, line[:, axis]) for axis in (0, 1)])
    left, top, width, height = graph.box
    # the axis is at the left edge; the right edge is free
    low, high = np.array([left + half + 4, top + _EDGE]), np.array([left + width, top + height - _EDGE])
    distance = np.full(len(positions), 4 * _SPACING)
    for point in occupied:
        distance = np.minimum(distance, np.hypot(*(positions - point).T))
    distance = np.where(((positions > low) & (positions < high)).all(axis=1), distance, 0.0)
    best = int(np.argmax(distance - 1e-3 * np.abs(samples - along[-1] / 2)))
    return positions[best] if distance[best] >= _SPACING else None
