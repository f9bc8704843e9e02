"""Tables of a sheet: columns as wide as what they say, in parts below each other where they are too many."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from crankwork.locale import decimal
from crankwork.quantities import Language
from crankwork.show.canvas import WIDER, Canvas, fitted_lines, text_width
from crankwork.show.chart_layout import current_layout
from crankwork.show.scene import Drawing, flow_rows

_ROW, _PAD, _BETWEEN, _DIGITS = 13.0, 4.0, 8.0, 4
_THICK, _THIN = 1.0, 0.4
# between a table and the frame of its sheet, on both sides together [pt]
_FREE = 10.0
# how much wider and taller than what it says a table is at most, to fill its place
_WIDEST, _TALLEST = 1.7, 1.5
# letters, and smaller ones where a column would not fit
_SIZES = (8.5, 7.5)


class Column(NamedTuple):
    """A column of a table: what stands over it, and what it says."""

    head: str
    cells: Sequence[str]


def numbers(values: Sequence[float], language: Language, digits: int = _DIGITS) -> list[str]:
    """Return numbers with as many decimals as give the largest that many digits, a dash for none."""
    largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
    places = max(0, digits - 1 - math.floor(math.log10(largest))) if largest else 0
    shown = [f"{value:.{places}f}" if math.isfinite(value) else "–" for value in values]
    shown = ["0" if not text.strip("-0.") else text for text in shown]
    return [decimal(text, language).replace("-", "−") for text in shown]


def table(first: Sequence[Column], columns: Sequence[Column], title: str, language: Language) -> Drawing:
    """Draw a table; `first`: the columns that every part of it begins with."""
    parts, size = next((fitting for height in _SIZES if (fitting := _parts(first, columns, height))), None) or (
        [[*first, column] for column in columns], _SIZES[-1]
    )  # fmt: skip
    widths = np.array([sum(_width(column, size) for column in part) for part in parts])
    # as wide as what stands above and below it, if that is not much wider, and with rows as tall
    wider = float(np.clip((current_layout().width - _FREE) / widths.max(), 1.0, _WIDEST))
    row, rows = _ROW * min(max(current_layout().tall, 1.0), _TALLEST), len(first[0].cells) + 1
    hand = Canvas(wider * float(widths.max()), len(parts) * (row * rows + _BETWEEN) - _BETWEEN)
    for index, part in enumerate(parts):
        _draw(hand, part, [wider * _width(item, size) for item in part], (index * (row * rows + _BETWEEN), row), size)
    return hand.drawing(title, language)


def _parts(first: Sequence[Column], columns: Sequence[Column], size: float) -> tuple[list[list[Column]], float] | None:
    """Return columns in parts that fit, about as many in each, or nothing where one does not."""
    room = current_layout().width - _FREE - sum(_width(column, size) for column in first)
    if max(_width(column, size) for column in columns) > room:
        return None
    count = next(parts for parts in range(1, len(columns) + 1) if all(
        sum(_width(column, size) for column in part) <= room for part in _divided(columns, parts)
    ))  # fmt: skip
    return [[*first, *part] for part in _divided(columns, count)], size


def _divided(columns: Sequence[Column], count: int) -> Iterator[Sequence[Column]]:
    ends = [round(len(columns) * index / count) for index in range(count + 1)]
    yield from (columns[start:end] for start, end in itertools.pairwise(ends))


def _width(column: Column, size: float) -> float:
    return WIDER * max(text_width(text, size) for text in (column.head, *column.cells)) + 2 * _PAD


def _draw(
    hand: Canvas, columns: Sequence[Column], widths: Sequence[float], place: tuple[float, float], size: float
) -> None:
    """Draw a part of a table: thick lines around it and under its head, thin ones between rows.

    `place`: its upper edge, and the height of its rows.
    """
    top, row = place
    rows, right = len(columns[0].cells) + 1, sum(widths)
    sides = np.concatenate([[0.0], np.cumsum(widths)])
    foot = top + row * rows
    levels = top + row * np.arange(rows + 1)
    thick = [(x, top, x, foot) for x in sides] + [(0.0, y, right, y) for y in levels[[0, 1, -1]]]
    hand.segments(np.array([(0.0, y, right, y) for y in levels[2:-1]]).reshape(-1, 4), width=_THIN)
    hand.segments(np.array(thick), width=_THICK)
    for column, left, width in zip(columns, sides, widths, strict=False):
        for index, text in enumerate((column.head, *column.cells)):
            hand.text(left + width / 2, levels[index] + row / 2 + 0.22 * _ROW, text, size=size, anchor="middle")


def text_block(entries: list[str], title: str, language: Language) -> Drawing:
    """Return entries in rows, as many as fit beside each other."""
    size, row = 8.5, 14.0
    # letters of a reader may be wider
    width = 0.82 * current_layout().width
    rows = [
        line
        for entry_row in flow_rows(entries, ";   ", width, partial(text_width, size=size))
        for line in fitted_lines(entry_row, size, width)
    ]
    hand = Canvas(current_layout().width, row * len(rows))
    for index, text in enumerate(rows):
        hand.text(0.0, row * (index + 0.7), text, size=size)
    return hand.drawing(title, language)
