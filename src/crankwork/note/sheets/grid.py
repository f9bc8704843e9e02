"""Drawings beside and below each other that are one figure."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from crankwork.note.sheets.packing import covered
from crankwork.quantities import Language
from crankwork.show.place import LARGER, MM, here, placed
from crankwork.show.scene import TEXT, Box, Drawing, Item, Text, moved

# between cells, and what names of points add to the height of a cell [mm]
_GAP, _NAMES = 3.0, 10.0
# width of a cell at least [mm]
_LEAST = 60.0
# how much lower cells may be than a figure alone
_LOWER = 0.75


def in_grid(
    cells: Sequence[Callable[[], Drawing]], columns: int, title: str, language: Language, remark: Callable[[], str]
) -> Drawing:
    """Return drawings in rows of as many columns, each in the middle of its cell; `remark`: said of all then."""
    place = here()
    columns = min(columns, len(cells), max(1, int(place.width * MM * LARGER / _LEAST)))
    rows = -(-len(cells) // columns)
    with placed(place._replace(width=place.width / columns, tall=_LOWER * place.tall / math.sqrt(rows))):
        drawings = [one() for one in cells]
    inks = [covered(one.items) for one in drawings]
    wide = max(*(one.width for one in drawings), *(one.width + _GAP for one in inks))
    items, foot = list[Item](), 0.0
    for start in range(0, len(cells), columns):
        row = list(zip(drawings[start : start + columns], inks[start : start + columns], strict=True))
        high = max(ink.height for _, ink in row) + (_NAMES if place.is_rough else 0.0)
        for at, (drawing, ink) in enumerate(row):
            right, up = _middle(ink, wide * (at + 0.5), foot - high / 2)
            items += [moved(one, right, up) for one in drawing.items]
        foot -= high + _GAP
    items = [moved(one, 0.0, -foot) for one in items]
    if told := remark():
        items.append(Text((wide * columns / 2, 2.0 - foot), told, TEXT, "middle"))
    return Drawing(title, language, wide * columns, -foot, tuple(items))


def _middle(ink: Box, x: float, y: float) -> tuple[float, float]:
    """Return how far to move what covers a box until its middle is at a place. [mm]"""
    return x - ink.left - ink.width / 2, y - ink.bottom - ink.height / 2
