"""Drawings of mechanisms before they are placed on paper: forces as arrows to one scale, dimensions (ISO 129-1)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis import Array
from crankwork.analysis.sampled_motion import SampledCylinder
from crankwork.quantities.key import key_of
from crankwork.report.display import displayed
from crankwork.show.animation import Part, part
from crankwork.show.canvas import round_scale
from crankwork.show.scene import ChartBox, Circle, Item, Pen, Polyline, Text, extent, line, moved, use_layout

# how much of gas is seen at its least and its greatest pressure
_THIN, _THICK = 0.06, 0.75
# of the largest arrow, of a head, half the width of a shaft [mm]
_LONGEST, _HEAD, _HALF = 32.0, 3.2, 0.28
# height of letters, and how far they are from a tip [mm]
_LETTERS, _CLEAR = 3.2, 4.0
# where nothing moves: what is too short to be seen, what is free around a name [mm]
_SHORTEST, _FREE = 1.6, 0.7
# how a name stands to its force, turned from its way [deg], and how far off
_TURNS, _REACHES = (0.0, 45.0, -45.0, 80.0, -80.0, 120.0, -120.0), (1.0, 1.4, 1.9, 2.5)
_NO_LINE = Pen(0.0)
# of a dimension: half width and length of its arrowhead, how far extension lines go beyond, the shortest drawn [mm]
_ARROWHEAD, _BEYOND, _SHORTEST_LINE = (0.5, 2.6), 1.5, 12.0
# how far lines are from what they measure, of a link and beneath supports, and from everything else at least [mm]
_OFF, _BELOW, _CLEAR_LINE = (7.0, 10.0, 13.0, 17.0), (15.5, 20.0, 24.5), 5.0
_PLACES = np.linspace(0.0, 1.0, 15)[:, None]


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
        items = [use_layout(item, shift) for item in self.items]
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


class Arrow(NamedTuple):
    """A force at a place, shape (n, 2) [mm], along a direction [deg], against it where negative, shape (n,) [N].

    `label`: what is written at its tip.
    """

    name: str
    place: Array
    turn: Array
    force: Array
    label: str = ""


def with_forces(sketch: Sketch, arrows: Sequence[Arrow], frame: int | None = None, *, has_room: bool = True) -> Sketch:
    """Return a sketch with forces upon it, and how many units of force a millimetre of them is.

    `frame`: the only one that is looked at; its forces are as long as there is room, and their names clear of others;
    `has_room`: whether the sketch reaches as far as they do.
    """
    rows = slice(None) if frame is None else slice(frame, frame + 1)
    largest = max((float(np.max(np.abs(arrow.force[rows]))) for arrow in arrows), default=0.0)
    if not largest > 0:
        return sketch
    scale = round_scale(displayed("piston_force", largest) / _LONGEST)
    corners, parts = [sketch.low[None], sketch.high[None]], list(sketch.parts)
    # what does not move has one row
    seen = () if frame is None else (item for body in parts for item in body.at(frame if len(body.shift) > 1 else 0))
    taken = [extent(item) for item in seen if isinstance(item, Text | Circle)]
    taken += _rotation(sketch.items)
    for arrow in arrows:
        length = displayed("piston_force", 1.0) * arrow.force / scale
        if frame is not None and abs(length[frame]) < _SHORTEST:
            continue
        turns = np.radians(arrow.turn)
        ways = np.column_stack([np.cos(turns), np.sin(turns)]) * np.sign(length)[:, None]
        ends = arrow.place + np.abs(length)[:, None] * ways
        parts += _arrow(arrow, length, ends)
        corners.append(ends[rows])
        if arrow.label:
            text = Text((0.0, -_LETTERS / 2), arrow.label, _LETTERS, "middle", halo=True)
            away = _CLEAR * ways
            if frame is not None:
                away, box = _place_near_tip(text, ends[frame], ways[frame], taken)
                taken.append(box)
            corners += [(ends + away + side * _CLEAR)[rows] for side in (1, -1)]
            # a force that is too short for its head has no name
            shown = np.abs(length) > (_HEAD if frame is None else _SHORTEST)
            parts.append(part(f"force.{arrow.name}.text", [text], ends + away, tint=shown))
    places = np.vstack(corners if has_room else corners[:2])
    return sketch._replace(parts=parts, low=places.min(axis=0), high=places.max(axis=0), force_scale=scale)


def _rotation(items: Sequence[Item]) -> Iterator[ChartBox]:
    """Yield what the arrows of rotation cover: black heads, and before each its arc. [mm]"""
    for arc, head in pairwise(items):
        if isinstance(arc, Polyline) and isinstance(head, Polyline) and head.fill == 0.0:
            pieces = [*map(line, arc.points, arc.points[1:]), head]
            yield from (extent(piece).inset(-_FREE, -_FREE, -_FREE, -_FREE) for piece in pieces)


def _place_near_tip(text: Text, tip: Array, ahead: Array, taken: Sequence[ChartBox]) -> tuple[Array, ChartBox]:
    """Return the offset of the name of a force from its tip, clear of other names, and the box it covers. [mm]"""
    ways = []
    for turn, reach in product(_TURNS, _REACHES):
        cos, sin = np.cos(np.radians(turn)), np.sin(np.radians(turn))
        away = reach * _CLEAR * np.array([cos * ahead[0] - sin * ahead[1], sin * ahead[0] + cos * ahead[1]])
        box = extent(moved(text, *(tip + away))).inset(-_FREE, -_FREE, -_FREE, -_FREE)
        over = sum(
            max(0.0, min(box.right, other.right) - max(box.left, other.left))
            * max(0.0, min(box.top, other.top) - max(box.bottom, other.bottom))
            for other in taken
        )
        ways.append((over + 0.3 * reach + 0.002 * abs(turn), away, box))
    _, away, box = min(ways, key=lambda choice: choice[0])
    return away, box


def _arrow(arrow: Arrow, length: Array, ends: Array) -> list[Part]:
    """Return shaft and head; a force shorter than a head has a smaller one."""
    share = np.clip(length / _HEAD, -1.0, 1.0)
    shaft = Polyline(
        np.array([(0.0, _HALF), (1.0, _HALF), (1.0, -_HALF), (0.0, -_HALF)]),
        _NO_LINE,
        closed=True,
        fill=0.0,
        name="force",
    )
    head = Polyline(
        np.array([(0.0, 0.0), (-_HEAD, _HEAD / 4), (-_HEAD, -_HEAD / 4)]), _NO_LINE, closed=True, fill=0.0, name="force"
    )
    return [
        part(f"force.{arrow.name}.shaft", [shaft], arrow.place, arrow.turn, stretch=length - share * _HEAD),
        part(f"force.{arrow.name}.head", [head], ends, arrow.turn, stretch=share),
    ]


def forces_of(cylinder: SampledCylinder, labels: Mapping[str, str]) -> list[Arrow]:
    """Return the forces on pins and wall of a cylinder on its paper, as far as they are known."""
    arm, rod = cylinder.pin, cylinder.joint - cylinder.piston
    axis, number = np.full(len(arm), 90.0 - cylinder.place.axis), cylinder.place.number
    ways = {
        "piston_force": (cylinder.piston, axis + 180.0),
        "side_force": (cylinder.piston, axis + 90.0),
        "rod_force": (cylinder.joint, _turns(rod)),
        # across the crank arm, with the rotation
        "tangential_force": (cylinder.pin, _turns(arm) - 90.0),
    }
    return [Arrow(f"{key}.{number}", *ways[key], force, labels.get(key, "")) for key, force in cylinder.forces.items()]


def forces_in_joints(
    columns: Mapping[str, Array], points: Mapping[str, Array], labels: Mapping[str, str]
) -> list[Arrow]:
    """Return the forces in the joints of a linkage; where links share a pin, each of them has its own. [mm]"""
    arrows = []
    for key, x in columns.items():
        kind, name = key_of(key)
        joint = name if name in points else name.rpartition("_")[0]
        if kind == "joint_force_x" and joint in points:
            force = np.nan_to_num(np.column_stack([x, columns[f"joint_force_y.{name}"]]))
            arrows.append(Arrow(name, points[joint], _turns(force), np.hypot(*force.T), labels.get(name, "")))
    return arrows


def _turns(ways: NDArray[np.float64]) -> Array:
    return np.degrees(np.unwrap(np.arctan2(ways[:, 1], ways[:, 0])))


class Length(NamedTuple):
    """The distance of two points, or that along an axis, and what is written there."""

    start: str
    end: str
    text: str
    axis: int | None = None


def dimension_lines(
    lengths: Sequence[Length], points: Mapping[str, Array], obstacles: Array
) -> tuple[list[Item], Array]:
    """Return dimension lines clear of links and letters, and what they cover; short ones are left out. [mm]"""
    links = [points[link.start] + _PLACES * (points[link.end] - points[link.start])
             for link in lengths if link.axis is None]  # fmt: skip
    busy, items = np.vstack([obstacles, *points.values(), *links]), list[Item]()
    for length in lengths:
        start, end = points[length.start], points[length.end]
        along = end - start if length.axis is None else (end - start) * np.eye(2)[length.axis]
        if np.hypot(*along) < _SHORTEST_LINE:
            continue
        p, q = min(_choices(length, start, end, busy), key=lambda ends: _crowding(ends[0], ends[1], busy))
        busy = np.vstack([busy, p + _PLACES * (q - p)])
        items += _drawn(length, (start, end), (p, q))
    return items, busy


def _choices(length: Length, start: Array, end: Array, busy: Array) -> Iterator[tuple[Array, Array]]:
    """Yield the ends of a dimension line, the nearer ones first."""
    if length.axis is None:
        across = np.array([-(end - start)[1], (end - start)[0]]) / np.hypot(*(end - start))
        yield from ((start + side * off * across, end + side * off * across) for off, side in product(_OFF, (1, -1)))
        return
    other = 1 - length.axis
    for off in _BELOW:
        level = np.eye(2)[other] * (busy[:, other].min() - off if length.axis else min(start[1], end[1]) - off)
        keep = np.eye(2)[length.axis]
        yield start * keep + level, end * keep + level


def _crowding(start: Array, end: Array, busy: Array) -> float:
    """Return how much else is near a line."""
    places = start + _PLACES * (end - start)
    near = np.hypot(*(places[:, None] - busy[None]).T).T
    # what is written in the middle needs more room
    needed = np.where(np.arange(len(places)) == len(places) // 2, 2.0, 1.0) * _CLEAR_LINE
    return float(np.sum(np.maximum(0.0, needed[:, None] - near) ** 2))


def dimension_line(ends: Array, feet: Array, gap: float = 2.0) -> Iterator[Item]:
    """Yield extension lines from a gap behind the points that are measured, and the line with its arrowheads. [mm]"""
    along = (feet[1] - feet[0]) / np.hypot(*(feet[1] - feet[0]))
    for point, foot, ahead in zip(ends, feet, (-along, along), strict=True):
        away = np.hypot(*(foot - point))
        out = (foot - point) / away
        yield line(point + min(gap, away) * out, foot + _BEYOND * out)
        back, across = foot - _ARROWHEAD[1] * ahead, _ARROWHEAD[0] * np.array([-ahead[1], ahead[0]])
        yield Polyline(np.array([foot, back + across, back - across]), Pen(0.0), closed=True, fill=0.0)
    yield line(feet[0], feet[1])


def _drawn(length: Length, ends: tuple[Array, Array], feet: tuple[Array, Array]) -> Iterator[Item]:
    """Yield a dimension line with the length on it."""
    # a support and its letter stand between
    yield from dimension_line(np.array(ends), np.array(feet), 2.0 if length.axis is None else _BELOW[0] - 2.0)
    x, y = ((feet[0] + feet[1]) / 2).tolist()
    yield Text((x, y - _LETTERS / 2), length.text, _LETTERS, "middle", halo=True)
