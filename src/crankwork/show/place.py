"""Where a chart is drawn: in a text, or larger on a sheet, with letters of the standard series and round scales."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import NamedTuple

from crankwork.show.scene import CAP_HEIGHT, TEXT

MM = 25.4 / 72
# letters of a chart, as large as a sheet has them, and what is no smaller than that [pt]
_LETTERS, _READ = 8.5, 8.0
# millimetres of a sheet in a millimetre of the same chart in a text
LARGER = TEXT / (_LETTERS * MM * CAP_HEIGHT)


class Place(NamedTuple):
    """Width of a paper, what is left free beside graphs on it [pt], and how much taller graphs are than in a text.

    Where only the size is asked for, a drawing is `rough`: names of points, which take long to place, are left out.
    """

    width: float = 460.8
    left: float = 70.6
    right: float = 18.0
    tall: float = 1.0
    is_sheet: bool = False
    is_rough: bool = False

    @property
    def inner(self) -> float:
        """Width of graphs on it. [pt]"""
        return self.width - self.left - self.right


_TEXT = Place()

# of a drawing that is to be as large as its paper takes it
FINE = (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8)

_PLACE: ContextVar[Place] = ContextVar("place", default=_TEXT)


def here() -> Place:
    """Return where charts are drawn now."""
    return _PLACE.get()


@contextmanager
def placed(place: Place) -> Iterator[None]:
    """Draw charts at a place while this lasts."""
    before = _PLACE.set(place)
    try:
        yield
    finally:
        _PLACE.reset(before)


def letters(size: float) -> float:
    """Return how large letters are set here: on a sheet 3.5 mm, or 2.5 mm those that are small in a text. [pt]"""
    if not here().is_sheet:
        return size
    return _LETTERS if size >= _READ else _LETTERS * 2.5 / TEXT


def tall(height: float) -> float:
    """Return how tall a graph is here that is this tall in a text. [pt]"""
    return here().tall * height


def points_per_mm() -> float:
    """Return how many points of a chart a millimetre of the paper is that it ends on."""
    return 1.0 / (MM * (LARGER if here().is_sheet else 1.0))


def round_scale(least: float, among: Sequence[float] = (1, 2, 2.5, 4, 5)) -> float:
    """Return the smallest of 1, 2, 2.5, 4, 5 times a power of ten that is not less; `among`: of others, as `FINE`.

    Examples
    --------
    >>> round_scale(0.013), round_scale(0.3), round_scale(0.5)
    (0.02, 0.4, 0.5)
    """
    power = math.floor(math.log10(least))
    for one in (*among, 10):
        scale = float(f"{one}e{power}")
        if scale >= least * (1 - 1e-9):
            return scale
    return 10.0 ** (power + 1)
