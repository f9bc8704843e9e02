"""What of drawings is alike: the same on paper, the same but for rounding, the same to whoever sees it move."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from crankwork.analysis import Array
from crankwork.show.inline import frame_marks
from crankwork.show.moving import Animation
from crankwork.show.scene import Arc, Box, Circle, Drawing, Hatch, Item, Plot, Polyline, Text

# of its size, how far a line may be from another that is the same
_SAME_PLACE = 1e-6
# millimetres that nobody sees; beyond a graph, above and to the right, where marks of its scales stand
_UNSEEN, _BESIDE = 1e-3, 8.0
# of parts that move, in millimetres and degrees
_UNSEEN_MOVE = 0.05


def is_same_film(film: Animation, other: Animation) -> bool:
    """Return whether nobody sees a difference between two films."""
    own, others = ({one.name: one for one in each.parts} for each in (film, other))
    return own.keys() == others.keys() and all(
        one.track.shape == others[name].track.shape
        and bool(np.all(np.abs(one.track - others[name].track) < _UNSEEN_MOVE))
        and list(map(signed, one.items)) == list(map(signed, others[name].items))
        for name, one in own.items()
    )


def scaled(drawn: Sequence[Drawing]) -> list[bool]:
    """Return which items stand within graphs whose scales differ: the same on paper, they say something else."""
    boxes = []
    for own, *others in zip(*(one.plots for one in drawn), strict=False):
        is_other = ~np.all([_is_near_scale(own, one) for one in others], axis=0)
        if is_other.any():
            across, up = np.where(is_other, _BESIDE, 0.0)
            box = own.box
            boxes += [box._replace(height=box.height + across), box._replace(width=box.width + up)]
    items, frames = drawn[0].items, frame_marks(drawn[0])
    # a legend says of curves what they are
    legend = {id(one) for pair in pairwise(items) for one in pair if getattr(pair[0], "name", "") == "legend"}
    return [
        not frame and id(item) not in legend and is_within(item, boxes)
        for frame, item in zip(frames, items, strict=True)
    ]


def _is_near_scale(one: Plot, other: Plot) -> list[bool]:
    """Return whether the scales across and upward are the same but for rounding."""
    return [
        bool(np.all(np.abs(np.subtract(own, of)) <= _SAME_PLACE * abs(own[0] - own[1])))
        for own, of in zip((one.x, one.y), (other.x, other.y), strict=True)
    ]


def is_within(item: Item, boxes: Iterable[Box]) -> bool:
    """Return whether the middle of an item lies within some box."""
    match item:
        case Text(place=place):
            x, y = place
        case Circle(centre=centre) | Arc(centre=centre):
            x, y = centre
        case Polyline(points=points) | Hatch(points=points):
            x, y = (np.min(points, axis=0) + np.max(points, axis=0)) / 2
    return any(0 <= x - one.left <= one.width and 0 <= y - one.bottom <= one.height for one in boxes)


def is_title(item: Item, boxes: Iterable[Box]) -> bool:
    """Return whether an item is the title of an axis of a graph in some box: upright beside it, or below its middle."""
    if not isinstance(item, Text):
        return False
    x, y = item.place
    return any(
        (x < one.left and one.bottom < y < one.top)
        if item.angle == 90
        else y < one.bottom and abs(x - one.left - one.width / 2) < _UNSEEN
        for one in boxes
    )


def is_beside(item: Item, boxes: Iterable[Box]) -> bool:
    """Return whether an item stands within some box, or where marks of its scales do."""
    return is_within(item, (one.inset(*[-_BESIDE] * 4) for one in boxes))


def staying(drawn: Sequence[Drawing]) -> set[str]:
    """Return the names of curves that are the same in every design but for rounding, which thins them otherwise."""
    found, moving = set[str](), set[str]()
    for plots in zip(*(one.plots for one in drawn), strict=False):
        for name, curve in plots[0].curves.items():
            others = [one.curves.get(name, ()) for one in plots[1:]]
            is_same = all(len(one) == 2 and _are_near(curve, one) for one in others)
            (found if is_same else moving).add(name)
    return found - moving


def _are_near(one: Sequence[Array], other: Sequence[Array]) -> bool:
    """Return whether two curves are the same line; extremes may add points to either."""
    (x, y), (across, up) = map(np.asarray, one), map(np.asarray, other)
    shared, others = np.isin(x, across), np.isin(across, x)
    if shared.sum() == others.sum() and 2 * shared.sum() > max(x.size, across.size):
        x, y, across, up = x[shared], y[shared], across[others], up[others]
    if x.shape != across.shape:
        return False
    near = [_SAME_PLACE * np.max(np.abs(of[np.isfinite(of)]), initial=0.0) for of in (x, y)]
    return np.allclose(x, across, rtol=0, atol=near[0]) and np.allclose(y, up, rtol=0, atol=near[1], equal_nan=True)


def signed(item: Item) -> tuple[Any, ...]:
    """Return what tells an item from others that look otherwise."""

    def rounded(of: Any) -> bytes:  # noqa: ANN401 - numbers
        return (np.rint(np.asarray(of, dtype=float) / _UNSEEN) + 0.0).tobytes()

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
