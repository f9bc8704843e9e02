"""A graph on a sheet: axes with round scales that fill its box, curves, and the scales written on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.note.sheets.words import Words
from crankwork.report.linkage_look import round_scale
from crankwork.show.scene import (
    SMALL,
    TEXT,
    TITLE,
    Box,
    Item,
    LineKind,
    Polyline,
    Text,
    arrow,
    line,
    text_width,
)

_LEFT, _BOTTOM, _TAIL = 14.5, 6.8, 9.0
_TITLE_ROW, _ROW = 8.0, 6.0
_TICK = 13.0
_ANGLES = (10.0, 15.0, 30.0, 60.0, 90.0, 180.0, 360.0)
_SAMPLE = 14.0
_ONE_ROW = 110.0
# line kinds of the curves of one graph, one after the other
KINDS: tuple[LineKind, ...] = ("thick", "dashed", "dash_dot", "dotted", "thin")


class Side(NamedTuple):
    """What an axis is to show: symbol, display unit, least and largest value in that unit.

    `scale` [unit/mm] and `zero`, the place of the value 0 [mm], are found where they are left out. The values of an
    axis that `is_down` grow downward or to the left. `mark` is the index of its scale, that of the symbol otherwise.
    """

    symbol: str
    unit: str
    low: float
    high: float
    scale: float | None = None
    zero: float | None = None
    is_down: bool = False
    mark: str = ""


class Axis(NamedTuple):
    """An axis as drawn: symbol, display unit, scale [unit/mm], place of the value 0, its ends [mm], index of scale."""

    symbol: str
    unit: str
    scale: float
    zero: float
    start: float
    end: float
    mark: str = ""

    def place(self, values: Array | float) -> Array:
        """Return where values are along the axis. [mm]"""
        return np.asarray(self.zero + np.asarray(values) / self.scale)

    def value(self, place: Array | float) -> Array:
        """Return the values at places along the axis. [mm]"""
        return np.asarray((np.asarray(place) - self.zero) * self.scale)

    @property
    def ticks(self) -> Array:
        """The round values between its ends."""
        step = _step(abs(self.scale), self.unit)
        low, high = sorted((float(self.value(self.start)), float(self.value(self.end))))
        first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
        return np.asarray(step * np.arange(first, last + 1), dtype=float)

    @property
    def power(self) -> int:
        """The power of ten that its numbers are divided by where they would be too long."""
        largest = float(np.max(np.abs(self.ticks), initial=0.0))
        return 0 if largest == 0 or 1e-3 <= largest < 1e5 else 3 * math.floor(math.log10(largest) / 3)


class Curve(NamedTuple):
    """A line of a graph: key of its quantity, symbol, name, values in the units of the axes, kind of line."""

    key: str
    symbol: str
    label: str
    x: Array
    y: Array
    kind: LineKind = "thick"


class Graph(NamedTuple):
    """A graph: name, the box that it fills, its axes, all that is drawn."""

    name: str
    box: Box
    x: Axis
    y: Axis
    items: tuple[Item, ...]

    def point(self, x: float, y: float) -> tuple[float, float]:
        """Return where a point in units of the axes is. [mm]"""
        return float(self.x.place(x)), float(self.y.place(y))

    def points(self, x: Array, y: Array) -> Array:
        """Return where points in units of the axes are, shape (n, 2). [mm]"""
        return np.column_stack([self.x.place(x), self.y.place(y)])

    def curve(self, key: str) -> Array:
        """Return the points of the line that shows a quantity, shape (n, 2). [mm]"""
        return next(one.points for one in self.items if isinstance(one, Polyline) and one.name == key)

    def with_items(self, items: Sequence[Item]) -> Graph:
        """Return the graph with more drawn on it."""
        return self._replace(items=(*self.items, *items))

    @property
    def plot(self) -> Box:
        """The part between the ends of the axes. [mm]"""
        return Box(self.x.start, self.y.start, self.x.end - self.x.start, self.y.end - self.y.start)


def graph(  # noqa: PLR0913 - what it shows, and two choices
    name: str,
    box: Box,
    sides: tuple[Side, Side],
    curves: Sequence[Curve],
    words: Words,
    *,
    legend: bool = True,
    of: str = "",
) -> Graph:
    """Return a graph of curves that share their axes.

    `name`: key of its title among the words of sheets; `sides`: what its axes show, the horizontal one first;
    `legend`: name the lines, if there are several; `of`: which of several things it shows, for its title.
    """
    entries = curves if legend and len(curves) > 1 else ()
    room = box.inset(_LEFT, _BOTTOM, 0.0, heading_height(entries, box))
    x = _fitted(sides[0], room.left, room.width - _tail(sides[0], words), 0.0)
    y = _fitted(sides[1], room.bottom, room.height - _TAIL, 0.5)
    scales = [words.scale(one.mark, abs(one.scale), one.unit) for one in (y, x)]
    items = [*_net(x, y, words), *_axes(x, y, words)]
    for one in curves:
        points = np.column_stack([x.place(one.x), y.place(one.y)])
        items.append(Polyline(points, one.kind, name=one.key))
    items += heading(titled(words.say(name), of), scales, entries, box)
    return Graph(name, box, x, y, tuple(items))


def _fitted(side: Side, start: float, room: float, share: float) -> Axis:
    """Return an axis whose values fit into a room, what is left over before it by a share."""
    span = side.high - side.low
    scale = side.scale or round_scale(max(span, 1e-12) / room)
    used = span / scale
    begin = start + share * (room - used)
    if side.zero is not None:
        begin = side.zero + side.low / scale if not side.is_down else side.zero - side.high / scale
    mark = side.mark or side.symbol.partition("_")[0].removeprefix("Δ")
    if side.is_down:
        return Axis(side.symbol, side.unit, -scale, begin + side.high / scale, begin, begin + used, mark)
    return Axis(side.symbol, side.unit, scale, begin - side.low / scale, begin, begin + used, mark)


def _step(scale: float, unit: str) -> float:
    """Return the distance of ticks, at least so much that their labels fit."""
    least = _TICK * scale
    if unit == "deg":
        return next((one for one in _ANGLES if one >= least * 0.9), _ANGLES[-1])
    power = 10.0 ** math.floor(math.log10(least))
    return next(float(f"{one * power:.6g}") for one in (1, 2, 5, 10, 20) if one * power >= least * (1 - 1e-9))


def _title(axis: Axis, words: Words) -> str:
    """Return symbol and unit of an axis, and what its numbers are multiplied by."""
    unit, power = words.unit(axis.unit), f"·10^{{{-axis.power}}}".replace("-", "−") if axis.power else ""
    return f"{axis.symbol}{power}, {unit}" if unit else f"{axis.symbol}{power}"


def _tail(side: Side, words: Words) -> float:
    """Return how far an axis goes on behind its values, for the arrow and the symbol. [mm]"""
    spare = 5.0 if side.unit in ("deg", "mm", "cm3") else 14.0
    return text_width(f"{side.symbol}, {words.unit(side.unit)}") + spare


def _net(x: Axis, y: Axis, words: Words) -> list[Item]:
    """Return thin lines at round values, with the values beside them."""
    items: list[Item] = []
    for value in x.ticks:
        at = float(x.place(value))
        items.append(line((at, y.start), (at, y.end), "net"))
        foot = y.start - 1.5 - SMALL if y.scale > 0 else y.end + 1.5
        items.append(Text((at, foot), words.number(float(value) / 10**x.power, 7), SMALL, "middle"))
    for value in y.ticks:
        at = float(y.place(value))
        items.append(line((x.start, at), (x.end, at), "net"))
        items.append(Text((x.start - 1.5, at - SMALL / 2), words.number(float(value) / 10**y.power, 7), SMALL, "end"))
    return items


def _axes(x: Axis, y: Axis, words: Words) -> list[Item]:
    """Return the two axes through zero, with arrows, ticks and symbols."""
    across = min(max(y.zero, y.start), y.end)
    upright = min(max(x.zero, x.start), x.end)
    tail = text_width(f"{x.symbol}, {words.unit(x.unit)}") + 5.0
    ends = (x.start, x.end + tail)
    down = y.scale < 0
    top = (y.end, y.start - 6.0) if down else (y.start, y.end + 7.0)
    items = [*arrow((ends[0], across), (ends[1], across)), *arrow((upright, top[0]), (upright, top[1]))]
    items.append(Text((x.end + 4.5, across - 1.5 - TEXT), _title(x, words)))
    if down:
        items.append(Text((upright + 1.8, top[1] + 0.3), _title(y, words)))
    else:
        items.append(Text((upright + 2.0, top[1] - TEXT + 0.5), _title(y, words)))
    if y.start < across < y.end:
        for value in x.ticks:
            at = float(x.place(value))
            items.append(line((at, across - 1.0), (at, across + 1.0)))
    return items


def titled(title: str, of: str) -> str:
    """Return a title that says which of several things a graph shows, if that is to be said."""
    return f"{title}, {of}" if of else title


def heading(title: str, scales: Sequence[str], curves: Sequence[Curve], box: Box) -> list[Item]:
    """Return the title of a graph, its scales, and the names of its lines, from the top of its box down.

    Title and scales stand in the middle, where the cell in the corner of a sheet does not cover them.
    """
    height = TITLE if text_width(title, TITLE) <= box.width - 2 else TEXT
    middle = box.left + box.width / 2
    items: list[Item] = [Text((middle, box.top - 6.5), title, height, "middle")]
    foot = box.top - _TITLE_ROW
    for row in _flowed(tuple(dict.fromkeys(scales)), box.width - 3):
        foot -= _ROW
        items.append(Text((middle, foot + 1.5), row, TEXT, "middle"))
    for entries in _legend_rows(curves, box.width):
        foot -= _ROW
        for at, one in entries:
            left = box.left + 1.5 + at
            items.append(line((left, foot + 1.5 + TEXT / 2), (left + _SAMPLE - 2, foot + 1.5 + TEXT / 2), one.kind))
            items.append(Text((left + _SAMPLE, foot + 1.5), _entry(one)))
    return items


def heading_height(curves: Sequence[Curve], box: Box) -> float:
    """Return how much of a box the heading of a graph takes. [mm]"""
    scale_rows = 1 if box.width > _ONE_ROW else 2
    return _TITLE_ROW + _ROW * (scale_rows + len(_legend_rows(curves, box.width)))


def _entry(curve: Curve) -> str:
    return f"{curve.symbol} – {curve.label}" if curve.label else curve.symbol


def _flowed(texts: Sequence[str], room: float) -> list[str]:
    """Return texts joined to rows that fit into a room."""
    rows: list[str] = []
    for one in texts:
        joined = f"{rows[-1]};   {one}" if rows else one
        if rows and text_width(joined) <= room:
            rows[-1] = joined
        else:
            rows.append(one)
    return rows


def _legend_rows(curves: Sequence[Curve], width: float) -> list[list[tuple[float, Curve]]]:
    """Return the rows of a legend: each entry with its distance from the left. [mm]"""
    rows: list[list[tuple[float, Curve]]] = []
    at = math.inf
    for one in curves:
        wide = _SAMPLE + text_width(_entry(one)) + 6.0
        if at + wide > width:
            rows.append([])
            at = 0.0
        rows[-1].append((at, one))
        at += wide
    return rows
