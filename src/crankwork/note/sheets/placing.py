"""Names beside points, placed so that they cover neither lines nor each other. [mm]"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.show.scene import SMALL, Box, Circle, Item, Polyline, Text, line, text_width

_REACHES = np.array([2.6, 3.6, 5.0, 7.0, 9.5, 12.5, 16.0])
_TURNS = np.radians([45, 135, 90, 0, 180, 315, 225, 270, 22, 67, 112, 157, 202, 247, 292, 337])
_AROUND = np.column_stack([np.cos(_TURNS), np.sin(_TURNS)])
_SPACING = 0.9
_SAME = 0.4


class Named(NamedTuple):
    """A point with what is written beside it."""

    name: str
    place: tuple[float, float]


def names_beside(
    points: Sequence[Named], lines: Iterable[Array], room: Box, *, height: float = SMALL, dot: float = 0.6
) -> list[Item]:
    """Return dots at points and their names, with a thin line to a name that had to go further away.

    `points`: what is named; points that fall together share one dot; `lines`: what to keep clear of [mm], shape (n,
    2); `height` and `dot`: height of the letters, radius of the dots or 0 for none [mm].
    """
    points = _merged(points)
    if not points:
        return []
    marks = np.array([one.place for one in points])
    obstacles = np.vstack([marks, *(spread(one) for one in lines)])
    items: list[Item] = [Circle(one.place, dot, "thin", 0.0) for one in points] if dot else []
    placed: list[tuple[Array, Array]] = []
    for one, mark in zip(points, marks, strict=True):
        half = np.array([text_width(one.name, height) / 2, height / 2])
        others = marks[np.hypot(*(marks - mark).T) > _SAME]
        shift = _best_shift(mark, half, placed, (obstacles, others), room)
        centre = mark + shift
        placed.append((centre, half))
        if np.max(np.abs(shift) - half) > 4.0:
            near = centre - np.clip(shift, -half - 0.4, half + 0.4)
            items.append(line(mark, near, "net"))
            obstacles = np.vstack([obstacles, spread(np.array([mark, near]))])
        items.append(Text((float(centre[0]), float(centre[1] - height / 2)), one.name, height, "middle"))
    return items


def _best_shift(
    mark: Array, half: Array, placed: Sequence[tuple[Array, Array]], clear: tuple[Array, Array], room: Box
) -> Array:
    """Return where the middle of a name goes from its mark: clear first, then near."""
    obstacles, others = clear
    shifts = np.concatenate([_AROUND * (reach + np.abs(_AROUND) * (half - half.min())) for reach in _REACHES])
    centres = mark + shifts
    near = obstacles[np.all(np.abs(obstacles - mark) < _REACHES[-1] + 2 * half + 3, axis=1)]
    cost = 8.0 * np.all(np.abs(centres[:, None] - near) < half + 0.5, axis=2).sum(axis=1)
    cost += np.repeat(2.5 * _REACHES, len(_AROUND)) + 0.1 * np.tile(np.arange(len(_AROUND)), len(_REACHES))
    if others.size:
        nearest = np.min(np.hypot(*np.moveaxis(centres[:, None] - others, -1, 0)), axis=1)
        cost += 12.0 * (nearest < 1.2 * np.hypot(*shifts.T))
    for centre, other in placed:
        cost += 500.0 * np.all(np.abs(centres - centre) < half + other + 0.4, axis=1)
    low, high = np.array([room.left, room.bottom]), np.array([room.right, room.top])
    cost += 200.0 * np.any((centres - half < low) | (centres + half > high), axis=1)
    return np.asarray(shifts[np.argmin(cost)])


def spread(points: Array) -> Array:
    """Return points along a line at even distances, shape (m, 2). [mm]"""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    even = np.arange(0.0, length[-1] + _SPACING, _SPACING)
    return np.column_stack([np.interp(even, length, points[:, 0]), np.interp(even, length, points[:, 1])])


def lines_of(items: Iterable[Item]) -> list[Array]:
    """Return what names keep clear of: all lines but the net, and the middle of texts."""
    found = [one.points for one in items if isinstance(one, Polyline) and one.kind not in ("net", "grid", "grid_bold")]
    for one in items:
        if isinstance(one, Text) and not one.angle:
            width = text_width(one.text, one.height)
            left = one.place[0] - {"start": 0.0, "middle": width / 2, "end": width}[one.anchor]
            rows = (one.place[1] + 0.2 * one.height, one.place[1] + 0.8 * one.height)
            found += [np.array([[left, y], [left + width, y]]) for y in rows]
    return found


def _merged(points: Sequence[Named]) -> list[Named]:
    result: list[Named] = []
    for one in points:
        apart = [np.hypot(one.place[0] - other.place[0], one.place[1] - other.place[1]) for other in result]
        same = next((i for i, distance in enumerate(apart) if distance < _SAME), None)
        if same is None:
            result.append(one)
        elif one.name not in result[same].name.split(", "):
            result[same] = result[same]._replace(name=f"{result[same].name}, {one.name}")
    return result
