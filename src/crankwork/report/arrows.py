"""Forces of a moving drawing: arrows to one scale, each with its head at its end."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis import Array
from crankwork.analysis.moving_engine import CylinderMoving
from crankwork.report.language import displayed
from crankwork.report.sketch import Sketch
from crankwork.show.moving import Part, part
from crankwork.show.place import round_scale
from crankwork.show.scene import Box, Circle, Pen, Polyline, Text, extent, moved

# of the largest arrow, of a head, half the width of a shaft [mm]
_LONGEST, _HEAD, _HALF = 32.0, 3.2, 0.28
# height of letters, and how far they are from a tip [mm]
_LETTERS, _CLEAR = 3.2, 4.0
# where nothing moves: what is too short to be seen, what is free around a name [mm]
_SHORTEST, _FREE = 1.6, 0.7
# how a name stands to its force, turned from its way [deg], and how far off
_TURNS, _REACHES = (0.0, 45.0, -45.0, 80.0, -80.0, 120.0, -120.0), (1.0, 1.4, 1.9, 2.5)
_NO_LINE = Pen(0.0)


class Arrow(NamedTuple):
    """A force at a place, shape (n, 2) [mm], along a direction [deg], against it where negative, shape (n,) [N].

    `label`: what is written at its tip.
    """

    name: str
    place: Array
    turn: Array
    force: Array
    label: str = ""


def with_forces(sketch: Sketch, arrows: Sequence[Arrow], frame: int | None = None) -> Sketch:
    """Return a sketch with forces upon it, and how many units of force a millimetre of them is.

    `frame`: the only one that is looked at; its forces are as long as there is room, and their names clear of others.
    """
    at = slice(None) if frame is None else slice(frame, frame + 1)
    largest = max((float(np.max(np.abs(one.force[at]))) for one in arrows), default=0.0)
    if not largest > 0:
        return sketch
    scale = round_scale(displayed("piston_force", largest) / _LONGEST)
    found, parts = [sketch.low[None], sketch.high[None]], list(sketch.parts)
    taken = [] if frame is None else [extent(item) for one in parts for item in one.at(_of(one, frame))
                                      if isinstance(item, Text | Circle)]  # fmt: skip
    for one in arrows:
        length = displayed("piston_force", 1.0) * one.force / scale
        if frame is not None and abs(length[frame]) < _SHORTEST:
            continue
        turns = np.radians(one.turn)
        ways = np.column_stack([np.cos(turns), np.sin(turns)]) * np.sign(length)[:, None]
        ends = one.place + np.abs(length)[:, None] * ways
        parts += _arrow(one, length, ends)
        found.append(ends[at])
        if one.label:
            text = Text((0.0, -_LETTERS / 2), one.label, _LETTERS, "middle", halo=True)
            away = _CLEAR * ways
            if frame is not None:
                away, box = _beside(text, ends[frame], ways[frame], taken)
                taken.append(box)
            found += [(ends + away + side * _CLEAR)[at] for side in (1, -1)]
            # a force that is too short for its head has no name
            shown = np.abs(length) > (_HEAD if frame is None else _SHORTEST)
            parts.append(part(f"force.{one.name}.text", [text], ends + away, tint=shown))
    places = np.vstack(found)
    return sketch._replace(parts=parts, low=places.min(axis=0), high=places.max(axis=0), force_scale=scale)


def _of(one: Part, frame: int) -> int:
    """Return which row of its track a part has at a frame."""
    return frame if len(one.shift) > 1 else 0


def _beside(text: Text, tip: Array, way: Array, taken: Sequence[Box]) -> tuple[Array, Box]:
    """Return how far from its tip the name of a force stands clear of what is written, and what it covers. [mm]"""
    ways = []
    for turn, reach in product(_TURNS, _REACHES):
        cos, sin = np.cos(np.radians(turn)), np.sin(np.radians(turn))
        away = reach * _CLEAR * np.array([cos * way[0] - sin * way[1], sin * way[0] + cos * way[1]])
        box = extent(moved(text, *(tip + away))).inset(-_FREE, -_FREE, -_FREE, -_FREE)
        over = sum(
            max(0.0, min(box.right, one.right) - max(box.left, one.left))
            * max(0.0, min(box.top, one.top) - max(box.bottom, one.bottom))
            for one in taken
        )
        ways.append((over + 0.3 * reach + 0.002 * abs(turn), away, box))
    _, away, box = min(ways, key=lambda one: one[0])
    return away, box


def _arrow(one: Arrow, length: Array, ends: Array) -> list[Part]:
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
        part(f"force.{one.name}.shaft", [shaft], one.place, one.turn, stretch=length - share * _HEAD),
        part(f"force.{one.name}.head", [head], ends, one.turn, stretch=share),
    ]


def forces_of(one: CylinderMoving, labels: Mapping[str, str]) -> list[Arrow]:
    """Return the forces on pins and wall of a cylinder on its paper, as far as they are known."""
    arm, rod = one.pin, one.joint - one.piston
    axis, number = np.full(len(arm), 90.0 - one.place.axis), one.place.number
    ways = {
        "piston_force": (one.piston, axis + 180.0),
        "side_force": (one.piston, axis + 90.0),
        "rod_force": (one.joint, _turns(rod)),
        # across the crank arm, with the rotation
        "tangential_force": (one.pin, _turns(arm) - 90.0),
    }
    return [Arrow(f"{key}.{number}", *ways[key], force, labels.get(key, "")) for key, force in one.forces.items()]


def forces_in_joints(
    columns: Mapping[str, Array], points: Mapping[str, Array], labels: Mapping[str, str]
) -> list[Arrow]:
    """Return the forces in the joints of a linkage; where links share a pin, each of them has its own. [mm]"""
    arrows = []
    for key, x in columns.items():
        kind, _, name = key.partition(".")
        joint = name if name in points else name.rpartition("_")[0]
        if kind == "joint_force_x" and joint in points:
            force = np.nan_to_num(np.column_stack([x, columns[f"joint_force_y.{name}"]]))
            arrows.append(Arrow(name, points[joint], _turns(force), np.hypot(*force.T), labels.get(name, "")))
    return arrows


def _turns(ways: NDArray[np.float64]) -> Array:
    return np.degrees(np.unwrap(np.arctan2(ways[:, 1], ways[:, 0])))
