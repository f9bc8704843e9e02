"""What is wrong with how a drawing looks, told from its scene: where letters stand, and what runs through them."""

from __future__ import annotations

import re
from typing import NamedTuple
from xml.etree import ElementTree as ET

import numpy as np

from crankwork.show.scene import Arc, ChartBox, Circle, Drawing, Polyline, Text, arc_points, pen_of, runs, text_width
from crankwork.show.svg import svg

# letters of a reader's own font may be wider than our table has them
WIDER = 1.1
# lighter lines are nets that letters may stand on
_LIGHT = 0.8
_HAIR = 0.15


class Fault(NamedTuple):
    """Something that no drawing should have: of what kind, and the text that it befell."""

    kind: str
    text: str


def box_of(item: Text) -> ChartBox:
    """Return what the letters of a text cover, wider than our table says. [mm]"""
    width, height = WIDER * item.wide * text_width(item.text, item.height), item.height
    shown = runs(item.text)
    low = -0.3 * height if any(one.shift < 0 for one in shown) or re.search("[gjpqyβρφψμη,;(]", item.text) else 0.0
    high = height * (1.25 if any(one.shift > 0 for one in shown) else 1.0)
    left = {"start": 0.0, "middle": -width / 2, "end": -width}[item.anchor]
    x, y = item.place
    if abs(item.angle) == 90:
        return ChartBox(x - high, y + left, high - low, width)
    if item.angle == 180:
        return ChartBox(x - left - width, y - high, width, high - low)
    assert item.angle == 0, item
    return ChartBox(x + left, y + low, width, high - low)


def _is_through(lines: np.ndarray, box: ChartBox) -> np.ndarray:
    """Return which straight lines, shape (n, 4), enter a box."""
    low, high = np.array([box.left, box.bottom]), np.array([box.right, box.top])
    start, end = lines[:, :2], lines[:, 2:]
    near = ~(((start <= low) & (end <= low)) | ((start >= high) & (end >= high))).any(axis=1)
    if not near.all():
        found = np.zeros(len(lines), dtype=bool)
        found[near] = _is_through(lines[near], box)
        return found
    way = end - start
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (low - start) / way, (high - start) / way
    inside = (start > low) & (start < high)
    enter = np.where(way != 0, np.fmin(one, other), np.where(inside, -np.inf, np.inf)).max(axis=1)
    leave = np.where(way != 0, np.fmax(one, other), np.where(inside, np.inf, -np.inf)).min(axis=1)
    return (enter < leave) & (leave > 0) & (enter < 1)


def _lines(drawing: Drawing) -> tuple[np.ndarray, np.ndarray]:
    """Return all straight pieces of dark lines and which item each belongs to."""
    found, owners = [np.zeros((0, 4))], [np.zeros(0, int)]
    for at, item in enumerate(drawing.items):
        if isinstance(item, Polyline):
            points = np.vstack([item.points, item.points[:1]]) if item.closed else item.points
        elif isinstance(item, Arc):
            points = arc_points(item)
        elif isinstance(item, Circle):
            points = arc_points(Arc(item.centre, item.radius, 0, 360))
        else:
            continue
        pen = pen_of(item.kind)
        fill = None if isinstance(item, Arc) else item.fill
        shade = int(pen.colour[1:3], 16) / 255 if pen.colour else pen.grey
        if not (pen.width and shade < _LIGHT) and not (fill is not None and fill < 0.5):
            continue
        found.append(np.column_stack([points[:-1], points[1:]]))
        owners.append(np.full(len(points) - 1, at))
    return np.vstack(found), np.concatenate(owners)


def _overlap(one: ChartBox, other: ChartBox) -> bool:
    return (
        min(one.right, other.right) - max(one.left, other.left) > _HAIR
        and min(one.top, other.top) - max(one.bottom, other.bottom) > _HAIR
    )


def faults(drawing: Drawing) -> list[Fault]:
    """Return what is wrong with the texts of a drawing."""
    texts = [(at, item, box_of(item)) for at, item in enumerate(drawing.items) if isinstance(item, Text)]
    lines, owners = _lines(drawing)
    grounds = [
        (at, ChartBox(*item.points.min(axis=0), *np.ptp(item.points, axis=0)))
        for at, item in enumerate(drawing.items)
        if isinstance(item, Polyline) and item.fill == 1.0
    ]
    found = []
    for number, (at, item, box) in enumerate(texts):
        if box.left < 0 or box.bottom < 0 or box.right > drawing.width or box.top > drawing.height:
            found.append(Fault("outside", item.text))
        others = (other for _, other, place in texts[:number] if _overlap(box, place))
        found += [Fault("overlap", f"{item.text} | {other.text}") for other in others]
        inner = box.inset(_HAIR, _HAIR, _HAIR, _HAIR)
        # what stood there before a ground was laid cannot be seen
        cleared = max((one for one, place in grounds if one < at and _holds(place, box)), default=-1)
        through = owners[_is_through(lines, inner)]
        if np.any(through > cleared):
            found.append(Fault("crossed", item.text))
        # a line between two words is a name of the user's own
        if re.search(r"[\^${}]|(?<!\w{3})_|_(?!\w{3})", "".join(one.text for one in runs(item.text))):
            found.append(Fault("mark", item.text))
    return found


def _holds(ground: ChartBox, box: ChartBox) -> bool:
    """Return whether a ground holds the middle of a text, letters of our own width."""
    inner = box.inset(box.width * 0.06, box.height * 0.2, box.width * 0.06, box.height * 0.2)
    return (
        ground.left <= inner.left
        and ground.right >= inner.right
        and ground.bottom <= inner.bottom
        and ground.top >= inner.top
    )


def svg_texts(drawing: Drawing | bytes) -> list[ET.Element]:
    """Return the texts of a picture as elements of SVG."""
    data = drawing if isinstance(drawing, bytes) else svg(drawing)
    return list(ET.fromstring(data).iter("{http://www.w3.org/2000/svg}text"))  # noqa: S314 - our own bytes


def said(drawing: Drawing | bytes) -> list[str]:
    """Return what stands in a picture, text by text."""
    return ["".join(one.itertext()) for one in svg_texts(drawing)]
