"""How figures share a sheet: in columns, each as large as round scales let it be."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from crankwork.locale import capital
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import Language
from crankwork.show.canvas import LARGER, MM, WIDER, ChartLayout, current_layout, use_layout
from crankwork.show.scene import (
    TEXT,
    TITLE,
    ChartBox,
    Drawing,
    Item,
    Plot,
    Polyline,
    Text,
    extent,
    flow_rows,
    moved,
    moved_plot,
    text_width,
)

# between rows of a heading and of scales, and between both [mm]
_TITLE_ROW, _ROW, _HEADING_GAP = 8.5, 6.0, 2.0
_LEFT, _RIGHT = 35.0, 7.0
# how much taller than in a text the graphs of a figure are tried
_SCALES = tuple(0.3 * 1.16**step for step in range(21))
# how much higher than in a text it is, for its width: where sheets are divided, and where there is room at last
HIGHEST, TALLEST = 1.6, 2.1
_GAP, _FEW, _CLEAR = 7.0, 2, 0.3
# shares of the width on which the rows of a heading are of about one length
_EVEN = (0.55, 0.65, 0.75, 0.85, 1.0)
# below the cell in the corner [mm]
_BELOW = 4.0
# width of a graph over the crank angle at least [mm]
_READABLE = 70.0
_SYMBOL = re.compile(r"/\{([^{}]+)\}([′″]*)")


class Picture(NamedTuple):
    """A function that draws a picture in the current layout, its name, and whether its title is written above it."""

    name: str
    draw: Callable[[], Drawing]
    has_title: bool = True


class Fit(NamedTuple):
    """A picture of one size: what draws it where, as drawn with its heading, and what it covers. [mm]"""

    picture: Picture
    place: ChartLayout
    drawing: Drawing
    ink: ChartBox
    stretch: float = 1.0  # How much higher than in a text it is, for its width

    @property
    def name(self) -> str:
        """The name of its figure."""
        return self.picture.name


class Limits(NamedTuple):
    """Heights [mm] and widths of pictures: how they are bound."""

    height: float  # Of what use a height is at most [mm]
    least: float  # How tall graphs are at least, against those of a text
    highest: float  # How much higher than in a text they are at most
    is_alone: bool = False  # Whether a column is as wide as the sheet


Layout = tuple[float, ...]
Sizes = dict[tuple[str, float], list[Fit]]


def packed(
    pictures: Sequence[Picture],
    field: ChartBox,
    taken: tuple[ChartBox, ChartBox],
    layouts: Sequence[Layout],
    bounds: tuple[float, float],
    sizes: Sizes,
) -> list[Fit]:
    """Return pictures placed in columns in their order, so that they fill as much of the field as they can.

    `taken`: free areas at the upper left and at the lower right of the field [mm]; `layouts`: shares of the
    width of columns; `bounds`: how tall graphs are at least, against those of a text, and how much higher pictures
    are at most; `sizes`: those tried before.
    """
    best, most = list[Fit](), -math.inf
    for layout in layouts:
        # of many pictures none is as wide as the sheet
        if len(layout) > len(pictures) or (best and len(layout) == 1 and len(pictures) > _FEW):
            continue
        boxes = list(_columns(field, taken, layout))
        for ends in itertools.combinations(range(1, len(pictures)), len(layout) - 1):
            parts = [pictures[start:end] for start, end in itertools.pairwise((0, *ends, len(pictures)))]
            limits = Limits(field.height, *bounds, is_alone=len(layout) == 1)
            columns = [_stacked(part, box, limits, sizes) for part, box in zip(parts, boxes, strict=True)]
            if any(fits is None for fits in columns):
                continue
            placed_ones = [fit for fits in columns for fit in fits or ()]
            score = math.fsum(map(worth, placed_ones))
            if score > most:
                best, most = placed_ones, score
    return best


def grown(rough: Sequence[Fit], complete: Sequence[Fit], sizes: Sizes) -> bool:
    """Return whether complete drawings are higher than rough ones had room for, and let these sizes grow."""
    higher = [
        (before, after.ink.height)
        for before, after in zip(rough, complete, strict=True)
        if after.ink.height > before.ink.height + _CLEAR
    ]
    for before, height in higher:
        for fits in (fits for (name, _), fits in sizes.items() if name == before.name):
            fits[:] = [
                fit._replace(ink=fit.ink._replace(height=height)) if fit.place == before.place else fit for fit in fits
            ]
    return bool(higher)


def finished(fit: Fit, field: ChartBox, corner: ChartBox) -> Fit:
    """Return a picture drawn in full in the place of its rough drawing, inside the field."""
    with use_layout(fit.place._replace(is_rough=False)):
        complete = headed(fit.picture, fit.picture.draw(), fit.place.width * MM * LARGER, fit.place)
    left = fit.ink.left + (fit.ink.width - complete.ink.width) / 2
    top = max(fit.ink.top, field.bottom + complete.ink.height)
    left = min(max(left, field.left), field.right - complete.ink.width)
    placed = _at(complete, left, top)
    words = [extent(item._replace(wide=WIDER)) for item in placed.drawing.items if isinstance(item, Text)]
    into = max((word.top - corner.bottom + _BELOW for word in words if word.left < corner.right), default=0.0)
    # a heading does not touch the cell in the corner
    return placed if into <= 0 else _at(complete, left, top - into)


def _columns(field: ChartBox, taken: tuple[ChartBox, ChartBox], layout: Layout) -> Iterator[ChartBox]:
    """Yield columns from left to right, shorter where something is taken."""
    left, (corner, block) = field.left, taken
    for share in layout:
        width = share * (field.width + _GAP) - _GAP
        foot = block.top + _GAP - field.bottom if block.width and left + width > block.left else 0.0
        head = max(field.top - corner.bottom + _BELOW, 0.0) if left < corner.right else 0.0
        yield ChartBox(left, field.bottom + foot, width, field.height - foot - head)
        left += width + _GAP


def _stacked(pictures: Sequence[Picture], box: ChartBox, limits: Limits, sizes: Sizes) -> list[Fit] | None:
    """Return pictures one below the other in a column, or None if it has no room for them."""
    choices = []
    for picture in pictures:
        key = picture.name, box.width
        if key not in sizes:
            sizes[key] = _sizes(picture, box.width, limits)
        choices.append([fit for fit in sizes[key] if fit.ink.height <= box.height and fit.stretch <= limits.highest])
    room = int(box.height - _GAP * (len(pictures) - 1))
    # the best value for each height used [mm]
    best: dict[int, tuple[float, tuple[Fit, ...]]] = {0: (0.0, ())}
    for fits in choices:
        further: dict[int, tuple[float, tuple[Fit, ...]]] = {}
        for (used, (score, chosen)), fit in itertools.product(best.items(), fits):
            total = used + math.ceil(fit.ink.height)
            value = score + worth(fit)
            if total <= room and value > further.get(total, (-math.inf, ()))[0]:
                further[total] = value, (*chosen, fit)
        best = further
    if not best:
        return None
    used, (_, chosen) = max(best.items(), key=lambda item: item[1][0])
    # headings of columns stand on one line, what is as wide as the sheet in its middle
    margin, top, result = (room - used) / len(chosen), box.top, []
    top -= margin / 2 if limits.is_alone else 0.0
    for fit in chosen:
        result.append(_at(fit, box.left + (box.width - fit.ink.width) / 2, top))
        top -= fit.ink.height + margin + _GAP
    return result


def worth(fit: Fit) -> float:
    """Return the value of the size of a picture: none is left small to make another one large."""
    # titles and legends beside a small graph make it no larger
    area = fit.ink.width * fit.ink.height
    seen = sum(plot.box.width * plot.box.height for plot in fit.drawing.plots) or area
    return -1.0 / math.sqrt(math.sqrt(seen * area))


def _at(fit: Fit, left: float, top: float) -> Fit:
    """Return a picture with its upper left corner at a place, its first graph on the lines of millimetre paper."""
    right, up = left - fit.ink.left, top - fit.ink.top
    if fit.drawing.plots:
        first = fit.drawing.plots[0].box
        right, up = round(first.left + right) - first.left, math.ceil(first.bottom + up - 0.5) - first.bottom
    ink = fit.ink._replace(left=fit.ink.left + right, bottom=fit.ink.bottom + up)
    items = tuple(moved(item, right, up) for item in fit.drawing.items)
    plots = tuple(moved_plot(plot, right, up) for plot in fit.drawing.plots)
    return fit._replace(drawing=fit.drawing._replace(items=items, plots=plots), ink=ink)


def _sizes(picture: Picture, width: float, limits: Limits) -> list[Fit]:
    """Return a picture in every height that it has at a width, from low to high. [mm]"""
    usable = [scale for scale in _SCALES if scale >= limits.least]
    with use_layout(ChartLayout(is_rough=True)):
        in_text = picture.draw()
    ratio, point = in_text.height / in_text.width, MM * LARGER

    def fit(index: int) -> Fit:
        place = ChartLayout(width / point, _LEFT / point, _RIGHT / point, usable[index], is_sheet=True, is_rough=True)
        with use_layout(place):
            drawn = headed(picture, picture.draw(), width, place)
        return drawn._replace(stretch=drawn.ink.height / (ratio * drawn.ink.width))

    fits = {0: fit(0), len(usable) - 1: fit(len(usable) - 1)}
    parts = [(0, len(usable) - 1)]
    while parts:
        first, last = parts.pop()
        low, high = fits[first].ink, fits[last].ink
        # between two of about one height there is no other, and no need of higher ones
        useful = min(TALLEST * ratio * low.width, limits.height)
        if last - first > 1 and high.height > low.height + 1 and low.height < useful:
            middle = (first + last) // 2
            fits[middle] = fit(middle)
            parts += [(first, middle), (middle, last)]
    result: list[Fit] = []
    for _, fit_at in sorted(fits.items()):
        if result and fit_at.stretch > TALLEST:
            break
        # of a single graph over the crank angle less could not be read
        angles = [plot.box.width for plot in fit_at.drawing.plots if plot.over == "crank_angle"]
        if len(angles) == 1 and angles[0] < _READABLE:
            continue
        if fit_at.ink.width <= width + _GAP / 2 and (not result or fit_at.ink.height > result[-1].ink.height + 1):
            result.append(fit_at)
    return result


def headed(picture: Picture, drawing: Drawing, width: float, place: ChartLayout) -> Fit:
    """Return a drawing with its title and its scales above it, and the area that they cover."""
    ink = covered(drawing.items)
    if not picture.has_title:
        return Fit(picture, place, drawing, ink)
    middle, top = ink.left + ink.width / 2, ink.top + 2.0
    rows = [(row_text, TEXT) for row_text in flow_rows(scales(drawing), ";  ", width / WIDER)]
    scale_rows = len(rows)
    room = partial(text_width, height=WIDER * TITLE)
    words = capital(drawing.title).split(" ")
    tried = [flow_rows(words, " ", share * width, room) for share in _EVEN]
    rows = [*((text, TITLE) for text in next(title for title in tried if len(title) == len(tried[-1]))), *rows]
    items: list[Item] = []
    for text, height in reversed(rows):
        top += _HEADING_GAP if items and len(items) == scale_rows else 0.0
        items.append(Text((middle, top + 1.5), text, height, "middle"))
        top += _TITLE_ROW if len(items) > scale_rows else _ROW
    drawing = drawing._replace(items=(*drawing.items, *items))
    return Fit(picture, place, drawing, covered(drawing.items))


def covered(items: Sequence[Item]) -> ChartBox:
    """Return the area that items cover, with letters as wide as a reader may have them. [mm]"""
    wide = (item._replace(wide=WIDER * item.wide) if isinstance(item, Text) else item for item in items)
    boxes = [extent(item) for item in wide if not isinstance(item, Polyline)]
    corners = [(box.left, box.bottom) for box in boxes] + [(box.right, box.top) for box in boxes]
    points = np.concatenate(
        [np.array(corners).reshape(-1, 2), *(item.points for item in items if isinstance(item, Polyline))]
    )
    (left, bottom), (right, top) = points.min(axis=0), points.max(axis=0)
    return ChartBox(float(left), float(bottom), float(right - left), float(top - bottom))


def scales(drawing: Drawing) -> list[str]:
    """Return the scales of the graphs of a drawing, `μ_p = 0.02 MPa/mm`, each once."""
    texts = [
        _scale(drawing, title, (ends[1] - ends[0]) / length)
        for plot in drawing.plots
        for title, ends, length in _axes(plot)
    ]
    return list(dict.fromkeys(text for text in texts if text))


def _axes(plot: Plot) -> Iterator[tuple[str, tuple[float, float], float]]:
    yield plot.titles.get("y", ""), plot.y, plot.box.height
    yield plot.titles.get("x", ""), plot.x, plot.box.width


def _scale(drawing: Drawing, title: str, value: float) -> str:
    """Return a scale by the title of its axis, that has symbols and a unit; nothing where it has neither."""
    symbols = list(dict.fromkeys(map("".join, _SYMBOL.findall(title))))
    if not symbols:
        return ""
    unit, millimetre = _unit(title), unit_name("mm", drawing.language)
    shown = number(float(f"{abs(value):.5g}"), drawing.language, digits=7)
    head = f"μ_{{{','.join(symbols)}}} = {shown}"
    return f"{head} {f'({unit})' if '/' in unit else unit}/{millimetre}" if unit else f"{head} {millimetre}⁻¹"


def _unit(title: str) -> str:
    """Return the text after the last comma of a title, if it has no symbol."""
    last = title.rpartition(", ")[2]
    return "" if "/{" in last or last == title else last


# between cells, and what names of points add to the height of a cell [mm]
_BETWEEN, _NAMES = 3.0, 10.0
# width of a cell at least [mm]
_LEAST = 60.0
# how much lower cells may be than a figure alone
_LOWER = 0.75


def in_grid(
    cells: Sequence[Callable[[], Drawing]], columns: int, title: str, language: Language, remark: Callable[[], str]
) -> Drawing:
    """Return drawings in rows of as many columns, each in the middle of its cell; `remark`: said of all then."""
    place = current_layout()
    columns = min(columns, len(cells), max(1, int(place.width * MM * LARGER / _LEAST)))
    rows = -(-len(cells) // columns)
    with use_layout(place._replace(width=place.width / columns, tall=_LOWER * place.tall / math.sqrt(rows))):
        drawings = [cell() for cell in cells]
    inks = [covered(picture.items) for picture in drawings]
    wide = max(*(picture.width for picture in drawings), *(cover.width + _BETWEEN for cover in inks))
    items, foot = list[Item](), 0.0
    for start in range(0, len(cells), columns):
        row = list(zip(drawings[start : start + columns], inks[start : start + columns], strict=True))
        high = max(ink.height for _, ink in row) + (_NAMES if place.is_rough else 0.0)
        for index, (drawing, ink) in enumerate(row):
            right = wide * (index + 0.5) - ink.left - ink.width / 2
            up = foot - high / 2 - ink.bottom - ink.height / 2
            items += [moved(item, right, up) for item in drawing.items]
        foot -= high + _BETWEEN
    items = [moved(item, 0.0, -foot) for item in items]
    if text := remark():
        items.append(Text((wide * columns / 2, 2.0 - foot), text, TEXT, "middle"))
    return Drawing(title, language, wide * columns, -foot, tuple(items))
