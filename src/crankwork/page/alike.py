"""Comparison of drawings: equal up to rounding, or without a visible difference."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from crankwork.analysis import Array
from crankwork.show.inline import frame_marks
from crankwork.show.moving import Animation
from crankwork.show.scene import Arc, Box, Circle, Drawing, Hatch, Item, Plot, Polyline, Text

# relative distance of equal lines
_SAME_PLACE = 1e-6
# invisible distance, and margin of a graph for the labels of its scales [mm]
_UNSEEN, _MARGIN = 1e-3, 8.0
# invisible difference of moving parts, in millimetres and degrees
_UNSEEN_MOVE = 0.05


def is_same_film(film: Animation, other: Animation) -> bool:
    """Return whether two animations have no visible difference."""
    own, other_parts = ({part.name: part for part in each.parts} for each in (film, other))
    return own.keys() == other_parts.keys() and all(
        part.track.shape == other_parts[name].track.shape
        and bool(np.all(np.abs(part.track - other_parts[name].track) < _UNSEEN_MOVE))
        and list(map(signature, part.items)) == list(map(signature, other_parts[name].items))
        for name, part in own.items()
    )


def scaled(drawn: Sequence[Drawing]) -> list[bool]:
    """Return which items lie within graphs whose scales differ: equal on paper, they mean different values."""
    boxes = []
    for own, *other_plots in zip(*(drawing.plots for drawing in drawn), strict=False):
        is_other = ~np.all([_is_near_scale(own, plot) for plot in other_plots], axis=0)
        if is_other.any():
            across, up = np.where(is_other, _MARGIN, 0.0)
            box = own.box
            boxes += [box._replace(height=box.height + across), box._replace(width=box.width + up)]
    items, frames = drawn[0].items, frame_marks(drawn[0])
    # legends do not depend on the scales
    legend = {id(item) for pair in pairwise(items) for item in pair if getattr(pair[0], "name", "") == "legend"}
    return [
        not frame and id(item) not in legend and is_within(item, boxes)
        for frame, item in zip(frames, items, strict=True)
    ]


def _is_near_scale(plot: Plot, other_plot: Plot) -> list[bool]:
    """Return for x and y whether the scales are equal up to rounding."""
    return [
        bool(np.all(np.abs(np.subtract(own, ends)) <= _SAME_PLACE * abs(own[0] - own[1])))
        for own, ends in zip((plot.x, plot.y), (other_plot.x, other_plot.y), strict=True)
    ]


def is_within(item: Item, boxes: Iterable[Box]) -> bool:
    """Return whether the middle of an item lies within one of the boxes."""
    match item:
        case Text(place=place):
            x, y = place
        case Circle(centre=centre) | Arc(centre=centre):
            x, y = centre
        case Polyline(points=points) | Hatch(points=points):
            x, y = (np.min(points, axis=0) + np.max(points, axis=0)) / 2
    return any(0 <= x - box.left <= box.width and 0 <= y - box.bottom <= box.height for box in boxes)


def is_title(item: Item, boxes: Iterable[Box]) -> bool:
    """Return whether an item is the title of an axis of a graph: upright left of it, or below its middle."""
    if not isinstance(item, Text):
        return False
    x, y = item.place
    return any(
        (x < box.left and box.bottom < y < box.top)
        if item.angle == 90
        else y < box.bottom and abs(x - box.left - box.width / 2) < _UNSEEN
        for box in boxes
    )


def is_near(item: Item, boxes: Iterable[Box]) -> bool:
    """Return whether an item lies within one of the boxes or its margin for labels."""
    return is_within(item, (box.inset(*[-_MARGIN] * 4) for box in boxes))


def unchanged_curves(drawn: Sequence[Drawing]) -> set[str]:
    """Return the names of curves that are equal in every design up to rounding, which may thin them differently."""
    constant, moving = set[str](), set[str]()
    for plots in zip(*(drawing.plots for drawing in drawn), strict=False):
        for name, curve in plots[0].curves.items():
            other_curves = [plot.curves.get(name, ()) for plot in plots[1:]]
            is_same = all(len(other) == 2 and _are_near(curve, other) for other in other_curves)
            (constant if is_same else moving).add(name)
    return constant - moving


def _are_near(first: Sequence[Array], second: Sequence[Array]) -> bool:
    """Return whether two curves are the same line; either may have additional points at extremes."""
    (x, y), (across, up) = map(np.asarray, first), map(np.asarray, second)
    shared, common = np.isin(x, across), np.isin(across, x)
    if shared.sum() == common.sum() and 2 * shared.sum() > max(x.size, across.size):
        x, y, across, up = x[shared], y[shared], across[common], up[common]
    if x.shape != across.shape:
        return False
    near = [_SAME_PLACE * np.max(np.abs(values[np.isfinite(values)]), initial=0.0) for values in (x, y)]
    return np.allclose(x, across, rtol=0, atol=near[0]) and np.allclose(y, up, rtol=0, atol=near[1], equal_nan=True)


def signature(item: Item) -> tuple[Any, ...]:
    """Return a key that is equal for items that look the same."""

    def rounded(numbers: Any) -> bytes:  # noqa: ANN401 - numbers
        return (np.rint(np.asarray(numbers, dtype=float) / _UNSEEN) + 0.0).tobytes()

    match item:
        case Polyline():
            return "line", rounded(item.points), item.kind, item.fill, item.name
        case Text():
            return "text", rounded(item.place), item.text, item.angle
        case Circle():
            return "circle", rounded((*item.centre, item.radius)), item.fill
        case Arc():
            return "arc", rounded((*item.centre, item.radius, item.start, item.end))
        case Hatch():
            return "hatch", rounded(item.points)
