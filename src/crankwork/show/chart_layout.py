"""Layout of charts: in a text, or larger on a sheet, with letters of the standard series and round scales."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import NamedTuple

from crankwork.show.scene import CAP_HEIGHT, TEXT

MM = 25.4 / 72
# font size of a chart that a sheet enlarges to the standard size; smaller text on a chart gets the small one [pt]
_LETTERS, _READ = 8.5, 8.0
# figures narrower than this are as wide as a column, and what small graphs beside each other take at least [pt]
_NARROW, _SMALLEST = 300.0, 110.0
# millimetres of a sheet in a millimetre of the same chart in a text
LARGER = TEXT / (_LETTERS * MM * CAP_HEIGHT)


class ChartLayout(NamedTuple):
    """Width of a canvas, margins of graphs on it [pt], and factor of their height over that in a text.

    `is_rough`: only the size of the drawing is needed, so names of points, whose placement takes long, are left out.
    """

    width: float = 481.9
    left: float = 70.6
    right: float = 18.0
    tall: float = 1.0
    is_sheet: bool = False
    is_rough: bool = False

    @property
    def inner(self) -> float:
        """Width of graphs on it. [pt]"""
        return self.width - self.left - self.right


_TEXT_LAYOUT = ChartLayout()
# widths of figures in millimetres: of a column and of a page, whose graphs are as tall as fits them
WIDTHS = {"85": ChartLayout(85 / MM, 66.0, 10.0, 0.8), "170": _TEXT_LAYOUT}

# on a screen, whose letters are as large on a phone as on a desk
SCREEN = ChartLayout(88 / MM, 66.0, 10.0, 0.8)
# scales for drawings as large as their paper allows
FINE = (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8)

_LAYOUT: ContextVar[ChartLayout] = ContextVar("place", default=_TEXT_LAYOUT)


def current_layout() -> ChartLayout:
    """Return the layout of charts in this context."""
    return _LAYOUT.get()


@contextmanager
def use_layout(place: ChartLayout) -> Iterator[None]:
    """Draw charts with a layout within this context."""
    before = _LAYOUT.set(place)
    try:
        yield
    finally:
        _LAYOUT.reset(before)


def is_narrow() -> bool:
    """Return whether figures are as wide as a column."""
    return current_layout().width < _NARROW


def columns_of(count: int) -> int:
    """Return how many small graphs stand beside each other at most."""
    return max(1, min(count, int(current_layout().width / _SMALLEST)))


def font_size(size: float) -> float:
    """Return the font size in the current layout: on a sheet 3.5 mm, or 2.5 mm for small text. [pt]"""
    if not current_layout().is_sheet:
        return size
    return _LETTERS if size >= _READ else _LETTERS * 2.5 / TEXT


def scaled_height(height: float) -> float:
    """Return the height of a graph in the current layout. [pt]"""
    return current_layout().tall * height


def points_per_mm() -> float:
    """Return the points of a chart per millimetre of the finished paper."""
    return 1.0 / (MM * (LARGER if current_layout().is_sheet else 1.0))


def round_scale(least: float, among: Sequence[float] = (1, 2, 2.5, 4, 5)) -> float:
    """Return the smallest of 1, 2, 2.5, 4, 5 times a power of ten that is not less; `among`: other factors, as `FINE`.

    Examples
    --------
    >>> round_scale(0.013), round_scale(0.3), round_scale(0.5)
    (0.02, 0.4, 0.5)
    """
    power = math.floor(math.log10(least))
    for factor in (*among, 10):
        scale = float(f"{factor}e{power}")
        if scale >= least * (1 - 1e-9):
            return scale
    return 10.0 ** (power + 1)
