"""Drawings of mechanisms before they are placed on paper."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.show.moving import Part
from crankwork.show.scene import Item, placed

# how much of gas is seen at its least and its greatest pressure
_THIN, _THICK = 0.06, 0.75


def tints(pressures: Sequence[Array]) -> list[Array]:
    """Return the tints of gas, darker with higher pressure, of all spaces to one scale."""
    if not pressures:
        return []
    low, high = min(map(np.min, pressures)), max(map(np.max, pressures))
    return [_THIN + (_THICK - _THIN) * np.sqrt((p - low) / max(float(high - low), 1e-9)) for p in pressures]


class View(NamedTuple):
    """A part of a sketch that may be looked at alone: along the shaft, or the cylinders of a bank from the side."""

    cylinders: tuple[int, ...]  # None where it is seen along the shaft
    low: Array  # Lower left corner [mm]
    high: Array  # Upper right corner [mm]


class Sketch(NamedTuple):
    """Static items and moving parts, those behind first, in millimetres about an origin of their own."""

    items: list[Item]
    parts: list[Part]
    low: Array  # Lower left corner of what they cover at all angles [mm]
    high: Array  # Upper right corner [mm]
    scale: float  # Millimetres of the paper in a metre
    force_scale: float = 0.0  # Displayed units of force in a millimetre of an arrow
    views: tuple[View, ...] = ()

    def moved(self, shift: Array) -> Sketch:
        """Return it elsewhere. [mm]"""
        items = [placed(item, shift) for item in self.items]
        parts = [part._replace(shift=part.shift + shift) for part in self.parts]
        views = tuple(view._replace(low=view.low + shift, high=view.high + shift) for view in self.views)
        return self._replace(items=items, parts=parts, low=self.low + shift, high=self.high + shift, views=views)

    def seen(self, *cylinders: int) -> Sketch:
        """Return it as a view."""
        return self._replace(views=(View(cylinders, self.low, self.high),))

    @staticmethod
    def joined(views: Sequence[Sketch]) -> Sketch:
        """Return several as one."""
        low, high = (np.min([view.low for view in views], axis=0), np.max([view.high for view in views], axis=0))
        items, parts = [item for view in views for item in view.items], [each for view in views for each in view.parts]
        seen = tuple(each for view in views for each in view.views)
        return Sketch(items, parts, low, high, views[0].scale, views=seen)
