"""Pistons of a linkage and the gas between them: as wide as their bore, as far apart as the volume of the gas says."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.moving import Moving
from crankwork.analysis.skeleton import Pose, Skeleton, guide_pose, tracks
from crankwork.machine import Machine
from crankwork.report.linkage_scene import Bar, Block, Scene
from crankwork.report.sketch import tints
from crankwork.show.moving import Part, part
from crankwork.show.scene import Box, Pen, Polyline, line, rectangle

# of the bore: how far the crown of a piston is from its pin where nobody says, how thick a piston is, how far its crown
# is from its pin at most where it has no rod, and a cover that a rod goes through from the crosshead
_CROWN, _THICK, _TRUNK, _CLEAR = 0.35, 0.35, 1.25, 0.15
_GAP = 0.3
_NO_LINE = Pen(0.0)


class _Piston(NamedTuple):
    """A piece that closes a chamber: its line, where its pin is on it, shape (n,), and half its bore. [m]"""

    name: str
    line: Pose
    along: Array
    half: float
    area: float  # [m2]
    side: float  # On which side of it the chamber lies, 1 or -1
    stated: float  # How far ahead of its pin a point of it stands on that side, zero if none does [m]


class Space(NamedTuple):
    """A chamber: its pistons, and where its gas begins and ends on the line of the first of them, shape (n,). [m]"""

    name: str
    pistons: tuple[_Piston, ...]
    start: Array
    end: Array
    pressure: Array  # [Pa]


def spaces(
    machine: Machine | None, shape: Skeleton, moving: Moving, columns: Mapping[str, Array], block: float = 0.0
) -> list[Space]:
    """Return the chambers between pistons on fixed guides whose volume and pressure are known.

    `block`: half the length of a crosshead [m].
    """
    known = {
        name: (pistons, columns[f"cylinder_volume.{name}"], columns[f"gas_pressure.{name}"])
        for name in (machine.chambers if machine else ())
        if f"gas_pressure.{name}" in columns and (pistons := _pistons(machine, name, shape, moving))
    }
    rods, found = _rods(machine, known, block), []
    for name, (pistons, volume, pressure) in known.items():
        # the stated crown stands where it is stated, the other as far from it as the volume says
        first = max(pistons, key=lambda one: one.stated)
        ahead = rods.get(first.name, 0.0) + first.side * (first.stated or _CROWN * 2 * first.half)
        others, start = tuple(one for one in pistons if one is not first), first.along + ahead
        found.append(Space(name, (first, *others), start, start + first.side * volume / first.area, pressure))
    return found


def _rods(
    machine: Machine | None, known: Mapping[str, tuple[list[_Piston], Array, Array]], block: float
) -> dict[str, float]:
    """Return how far from its pin a piston stands that has gas on both sides, so that its pin is in a crosshead. [m]"""
    sides: dict[str, dict[float, tuple[float, float]]] = {}
    for name, (pistons, volume, _) in known.items():
        faces = machine.chambers[name].faces if machine else ()
        if len(pistons) == 1 and not pistons[0].stated:
            (one,), (face,) = pistons, faces
            reach = (2 * _CROWN + 2 * _CLEAR) * one.half + block + float(np.max(volume)) / one.area
            sides.setdefault(one.name, {})[one.side] = face.rod_diameter, reach
    found = {}
    for name, both in sides.items():
        if len(both) > 1:
            side = max(both, key=lambda one: both[one][0])
            found[name] = -side * both[side][1]
    return found


def _pistons(machine: Machine | None, name: str, shape: Skeleton, moving: Moving) -> list[_Piston]:
    """Return the pistons of a chamber; none where they do not face each other, or a guide moves."""
    found, places = [], tracks(shape, moving)
    for face in machine.chambers[name].faces if machine else ():
        member = next((one for one in shape.members if one.name == face.slider), None)
        if member is None or member.guide is None or member.guide.link:
            return []
        guide = guide_pose(member.guide, moving)
        along = guide.seen(moving.frames[member.name].origin.place)[:, 0]
        ahead = [-face.sense * float(np.mean(guide.seen(places[one])[:, 0] - along)) for one in member.points]
        area = face.area or math.pi / 4 * ((face.bore or 0.0) ** 2 - face.rod_diameter**2)
        half = (face.bore or math.sqrt(4 * area / math.pi)) / 2
        found.append(_Piston(member.name, guide, along, half, area, -float(face.sense), max([0.0, *ahead])))
    facing = len(found) == 1 or (len(found) == 2 and found[0].side == -found[1].side)
    return found if facing else []


def _ends(found: Sequence[Space]) -> dict[str, tuple[_Piston, float, float]]:
    """Return from where to where each piston goes, from its pin along its guide: to the gas on each side. [m]"""
    sides: dict[str, tuple[_Piston, list[float]]] = {}
    for space in found:
        for one, edge in zip(space.pistons, (space.start, space.end), strict=False):
            sides.setdefault(one.name, (one, []))[1].append(float(np.mean(edge - one.along)))
    reach = {}
    for name, (one, edges) in sides.items():
        thick = 2 * _THICK * one.half
        # a pin that is near stands in the piston, one that is far off has a rod
        behind = edges[0] - one.side * thick
        if abs(edges[0]) < 2 * _TRUNK * one.half:
            behind = min(behind, -thick / 2) if one.side > 0 else max(behind, thick / 2)
        every = edges if len(edges) > 1 else [edges[0], behind]
        reach[name] = (one, min(every), max(every))
    return reach


def with_pistons(drawn: Scene, found: Sequence[Space], scale: float) -> Scene:
    """Return a linkage with pistons in the place of blocks and guides; one with a rod has its crosshead in these.

    `scale`: units of the picture in a metre.
    """
    pistons = _ends(found)
    trunks = [name for name, (_, low, high) in pistons.items() if low <= 0 <= high]
    bars = [one for one in drawn.bars if one.name not in pistons]
    blocks = [one._replace(kind="crosshead") if one.name in pistons else one for one in drawn.blocks]
    blocks = [one for one in blocks if one.name not in trunks]
    # what is no block has a rod in a bushing, which stands for that of the piston
    rams = {one.name for one in blocks if one.is_still}
    for name, (one, low, high) in pistons.items():
        middle, half = one.line.place(one.along + (low + high) / 2) * scale, (high - low) / 2 * scale
        blocks.append(Block(name, Pose(middle, one.line.along), (half, one.half * scale), is_still=True))
        if low > 0 or high < 0:
            near = low if low > 0 else high
            bars.append(Bar(name, (one.line.place(one.along) * scale, one.line.place(one.along + near) * scale)))
    rails = [one for one in drawn.rails if one.name not in pistons or one.name in rams]
    return drawn._replace(bars=bars, blocks=blocks, rails=rails)


def gas(found: Sequence[Space], scale: float) -> tuple[list[Polyline], list[Part]]:
    """Return walls and heads, and gas; `scale`: millimetres of the paper in a metre."""
    items: list[Polyline] = []
    parts: list[Part] = []
    pistons = _ends(found)
    for space, seen in zip(found, tints([one.pressure for one in found]), strict=True):
        first, depth = space.pistons[0], np.abs(space.end - space.start)
        body = rectangle(Box(0.0, -first.half * scale, 1.0, 2 * first.half * scale), "thin", 0.0)
        turn = _turn(first.line) + (0.0 if first.side > 0 else 180.0)
        place = first.line.place(space.start) * scale
        item = body._replace(kind=_NO_LINE, name="gas")
        parts.append(part(f"gas.{space.name}", [item], place, turn, stretch=depth * scale, tint=seen))
        items += _walls(space, pistons, scale)
    return items, parts


def _walls(space: Space, pistons: Mapping[str, tuple[_Piston, float, float]], scale: float) -> list[Polyline]:
    """Return the walls along which gas and pistons reach, and a head where no piston ends the gas."""
    first, ends = space.pistons[0], [*space.start.tolist(), *space.end.tolist()]
    for one, low, high in (pistons[one.name] for one in space.pistons):
        ends += [float(one.along.min()) + low, float(one.along.max()) + high]
    sides = (first.half + _GAP / scale, -first.half - _GAP / scale)
    pairs = [((min(ends), side), (max(ends), side)) for side in sides]
    if len(space.pistons) == 1:
        head = float(np.mean(space.end))
        pairs.append(((head, sides[0]), (head, sides[1])))
    ends_of = [[first.line.place(*at)[0] * scale for at in pair] for pair in pairs]
    return [line(start, end, "thick") for start, end in ends_of]


def _turn(guide: Pose) -> float:
    x, y = guide.along[0]
    return math.degrees(math.atan2(y, x))
