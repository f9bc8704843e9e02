"""A graph on paper: scales, ticks, titles, curves, marks and the legend above it, in the look of all figures."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.kinematics.crank_grid import Array
from crankwork.locale.numbers import number
from crankwork.quantities import Language
from crankwork.show.paper import BLACK, GREY, LIGHT, Paper, fitted_lines, text_width
from crankwork.show.scene import DASH_DOT, SOLID, Anchor, Style

WIDTH = 460.8
LEFT, RIGHT, BOTTOM, TOP = 70.6, 18.0, 45.0, 10.0
LEGEND_ROW = 13.4
_TICK, _SMALL, _LEGEND = 8.5, 7.5, 8.5
_FOOT_ROW = 9.0
# The style of a row of a legend that explains an open circle.
CIRCLE: Style = (0.0,)


class Box(NamedTuple):
    """Where a graph stands on its paper: left and upper edge, width, height. [pt]"""

    left: float
    top: float
    width: float
    height: float


class Row(NamedTuple):
    """A row of a legend: text, line style or `CIRCLE`, width of the line [pt] or 0 for none, its colour."""

    text: str
    style: Style = SOLID
    width: float = 1.2
    colour: str = BLACK


def round_ticks(low: float, high: float, most: int = 8) -> Array:
    """Return round numbers within a range. [its unit]

    Multiples of 1, 2, 2.5 or 5 times a power of ten.
    """
    span = (high - low) or 1.0
    power = 10.0 ** math.floor(math.log10(span / most))
    step = next(one * power for one in (1, 2, 2.5, 5, 10, 20) if span / (one * power) <= most)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return np.array([float(f"{at * step:.10g}") for at in range(first, last + 1)])


def stretches(where: NDArray[np.bool_]) -> list[slice]:
    """Return the stretches in which something is so."""
    ends = np.flatnonzero(np.diff(np.concatenate([[False], where, [False]])))
    return [slice(int(start), int(end)) for start, end in ends.reshape(-1, 2)]


class Graph:
    """Axes on paper with scales that are set once: x from left to right, y from the lower to the upper edge."""

    def __init__(
        self, paper: Paper, box: Box, x: tuple[float, float], y: tuple[float, float], language: Language
    ) -> None:
        self.paper, self.box, self.x, self.y, self.language = paper, box, x, y, language
        self.curves: dict[str, tuple[Array, Array]] = {}

    def across(self, x: float | Array) -> Array:
        """Return where values of x stand on the paper. [pt]"""
        start, end = self.x
        return self.box.left + self.box.width * (np.asarray(x, dtype=float) - start) / (end - start)

    def down(self, y: float | Array) -> Array:
        """Return where values of y stand on the paper. [pt]"""
        start, end = self.y
        return self.box.top + self.box.height * (1 - (np.asarray(y, dtype=float) - start) / (end - start))

    def point(self, x: float, y: float) -> tuple[float, float]:
        """Return where a point stands on the paper. [pt]"""
        return float(self.across(x)), float(self.down(y))

    def curve(
        self,
        name: str,
        x: Sequence[float] | Array,
        y: Sequence[float] | Array,
        style: Style = SOLID,
        *,
        width: float = 1.2,
        colour: str = BLACK,
    ) -> None:
        """Draw a curve that can be found again by its name."""
        x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        self.curves[name] = (x, y)
        # gaps where there is no value
        for part in stretches(np.isfinite(x + y)):
            self.paper.line(
                self.across(x[part]), self.down(y[part]), style=style, width=width, colour=colour, name=name
            )

    def shade(self, x: Array, y: Array, fill: str = "#d9d9d9") -> None:
        """Shade the area that points surround."""
        self.paper.area(self.across(x), self.down(y), fill=fill)

    def hatch(self, x: Array, y: Array) -> None:
        """Hatch the area that points surround."""
        self.paper.hatch(self.across(x), self.down(y))

    def frame(self, x_ticks: Array, y_ticks: Array, *, labels: tuple[bool, bool] = (True, True)) -> None:
        """Draw grid, ticks and numbers; the horizontal axis goes through zero where it is in reach."""
        left, top, width, height = self.box
        right, bottom = left + width, top + height
        across, down = self.across(x_ticks), self.down(y_ticks)
        grid = [(one, top, one, bottom) for one in across] + [(left, one, right, one) for one in down]
        self.paper.segments(np.array(grid), colour=LIGHT)
        is_inside = min(self.y) < 0 < max(self.y)
        level = float(self.down(0.0)) if is_inside else bottom
        marks = [(one, level - 2.5, one, level + 2.5) for one in across] + [
            (left - 3.5, one, left, one) for one in down
        ]
        self.paper.segments(np.array([(left, top, left, bottom), (left, level, right, level), *marks]), width=0.8)
        if labels[0]:
            for value, at in zip(x_ticks, across, strict=True):
                self.paper.text(at, bottom + 12.5, number(value, self.language), size=_TICK, anchor="middle")
        if labels[1]:
            for value, at in zip(y_ticks, down, strict=True):
                self.paper.text(left - 6, at + 3, number(value, self.language), size=_TICK, anchor="end")

    def x_title(self, text: str) -> None:
        """Write the title of the horizontal axis under its numbers."""
        self.paper.text(self.box.left + self.box.width / 2, self.box.top + self.box.height + 26, text, anchor="middle")

    def y_title(self, text: str, offset: float = 44.0) -> None:
        """Write the title of the vertical axis, on two lines if it is long; `offset` is its distance. [pt]"""
        size = 9.0
        lines = fitted_lines(text, size, self.box.height + 10)
        if len(lines) > 2:
            size = 7.5
            lines = fitted_lines(text, size, self.box.height + 16)
        for at, one in enumerate(reversed(lines)):
            x = self.box.left - offset - 11 * at
            self.paper.upward_text(x, self.box.top + self.box.height / 2, one, size=size)

    def mark(self, name: str, x: float, y: float, text: str, *, below: bool = False) -> None:
        """Mark a point of a curve with a dot and a text over or under it, inside the edges of the graph."""
        self.curves[name] = np.array([x]), np.array([y])
        at, level = self.point(x, y)
        self.paper.dot(at, level, 2.0)
        half = text_width(text, 8.0) / 2
        at = min(max(at, self.box.left + half + 3), self.box.left + self.box.width - half)
        self.paper.text(at, level + (11.0 if below else -5.0), text, size=8.0, anchor="middle")

    def boxed(self, x: float, y: float, text: str, anchor: Anchor = "start", size: float = 8.5) -> None:
        """Write a text on white, so that no line of the graph runs through it. [pt]"""
        width = text_width(text, size)
        left = {"start": x, "middle": x - width / 2, "end": x - width}[anchor] - 2
        right, top, bottom = left + width + 4, y - size, y + 0.4 * size
        corners = [left, right, right, left], [top, top, bottom, bottom]
        self.paper.area(*corners)
        self.paper.text(x, y, text, size=size, anchor=anchor)

    def level(self, value: float, style: Style = DASH_DOT, name: str = "") -> None:
        """Draw a horizontal line across the graph at a value. [its unit]"""
        self.curve(name, [self.x[0], self.x[1]], [value, value], style, width=0.8 if style == DASH_DOT else 1.2)


def _legend_lines(rows: Sequence[Row]) -> list[tuple[Row | None, str]]:
    """Return the lines of a legend; a text too long goes on without a sample of its line."""
    lines: list[tuple[Row | None, str]] = []
    for row in rows:
        first, *others = fitted_lines(row.text, _LEGEND, WIDTH - LEFT - RIGHT - 30)
        lines += [(row, first), *((None, one) for one in others)]
    return lines


def legend_height(rows: Sequence[Row]) -> float:
    """Return what a legend takes above its graph. [pt]"""
    return LEGEND_ROW * len(_legend_lines(rows)) + 5.0 if rows else 0.0


def legend(paper: Paper, rows: Sequence[Row], top: float) -> None:
    """Draw a legend at the left edge of a graph, from `top` downward. [pt]"""
    for at, (row, text) in enumerate(_legend_lines(rows)):
        left, level = LEFT + 8, top + LEGEND_ROW * at
        if row is not None and row.style == CIRCLE:
            paper.dot(left + 10, level + 6, 2.6, fill="#ffffff", width=1.0)
        elif row is not None and row.width:
            paper.line(
                [left, left + 20], [level + 6] * 2, style=row.style, width=row.width, colour=row.colour, name="legend"
            )
        paper.text(left + 27, level + 9, text, size=_LEGEND)


def limits(*values: Array, margin: float = 0.06) -> tuple[float, float]:
    """Return ends of a scale that holds zero and all values. [its unit]

    `margin`: room beyond the largest and the least, as a share of the range.
    """
    known = np.concatenate([[0.0], *(np.ravel(one)[np.isfinite(np.ravel(one))] for one in values)])
    low, high = float(np.min(known)), float(np.max(known))
    room = margin * (high - low) or 1.0
    return (low - room if low < 0 else 0.0), (high + room if high > 0 or low == 0 else 0.0)


def over_cycle(
    paper: Paper, box: Box, y: tuple[float, float], cycle: float, language: Language, *, numbers: bool = True
) -> Graph:
    """Return a graph over the crank angle with its frame drawn.

    `cycle`: end of the crank angle [deg].
    """
    graph = Graph(paper, box, (0.0, cycle), y, language)
    ticks = np.arange(0.0, cycle + 1, 90.0 if cycle > 360 else 30.0)
    graph.frame(ticks, round_ticks(*y, max(4, round(box.height / 24))), labels=(numbers, True))
    return graph


def sheet(height: float, rows: Sequence[Row] = (), *, below: float = BOTTOM) -> tuple[Paper, Box]:
    """Return paper with a legend on it, and the place for a graph below the legend. [pt]"""
    above = legend_height(rows)
    paper = Paper(WIDTH, TOP + above + height + below)
    legend(paper, rows, TOP - 4)
    return paper, Box(LEFT, TOP + above, WIDTH - LEFT - RIGHT, height)


def sign(paper: Paper, method: str, remark: str = "") -> None:
    """Write how the numbers were made at the lower right, and a remark at the lower left, or above it."""
    size = 7.0
    foot = paper.height - 6
    if text_width(method, size) + text_width(remark, size) > 0.94 * paper.width:
        paper.height += _FOOT_ROW
    paper.text(paper.width * 0.985, paper.height - 6, method, size=size, anchor="end", colour=GREY)
    if remark:
        paper.text(paper.width * 0.02, foot, remark, size=size, colour=GREY)


def small_text(paper: Paper, x: float, y: float, text: str, anchor: Anchor = "middle") -> None:
    """Write a text in small letters. [pt]"""
    paper.text(x, y, text, size=_SMALL, anchor=anchor)
