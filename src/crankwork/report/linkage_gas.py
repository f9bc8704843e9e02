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
    rods, chambers = _rods(machine, known, block), []
    for name, (pistons, volume, pressure) in known.items():
        # the stated crown stands where it is stated, the other as far from it as the volume says
        first = max(pistons, key=lambda piston: piston.stated)
        ahead = rods.get(first.name, 0.0) + first.side * (first.stated or _CROWN * 2 * first.half)
        further, start = tuple(piston for piston in pistons if piston is not first), first.along + ahead
        chambers.append(Space(name, (first, *further), start, start + first.side * volume / first.area, pressure))
    return chambers


def _rods(
    machine: Machine | None, known: Mapping[str, tuple[list[_Piston], Array, Array]], block: float
) -> dict[str, float]:
    """Return the distance from its pin to a piston with gas on both sides, whose pin is in a crosshead. [m]"""
    sides: dict[str, dict[float, tuple[float, float]]] = {}
    for name, (pistons, volume, _) in known.items():
        faces = machine.chambers[name].faces if machine else ()
        if len(pistons) == 1 and not pistons[0].stated:
            (piston,), (face,) = pistons, faces
            reach = (2 * _CROWN + 2 * _CLEAR) * piston.half + block + float(np.max(volume)) / piston.area
            sides.setdefault(piston.name, {})[piston.side] = face.rod_diameter, reach
    lengths = {}
    for name, both in sides.items():
        if len(both) > 1:
            side = max(both, key=lambda sense: both[sense][0])
            lengths[name] = -side * both[side][1]
    return lengths


def _pistons(machine: Machine | None, name: str, shape: Skeleton, moving: Moving) -> list[_Piston]:
    """Return the pistons of a chamber; none where they do not face each other, or a guide moves."""
    pistons, places = [], tracks(shape, moving)
    for face in machine.chambers[name].faces if machine else ():
        member = next((candidate for candidate in shape.members if candidate.name == face.slider), None)
        if member is None or member.guide is None or member.guide.link:
            return []
        guide = guide_pose(member.guide, moving)
        along = guide.seen(moving.frames[member.name].origin.place)[:, 0]
        ahead = [-face.sense * float(np.mean(guide.seen(places[point])[:, 0] - along)) for point in member.points]
        area = face.area or math.pi / 4 * ((face.bore or 0.0) ** 2 - face.rod_diameter**2)
        half = (face.bore or math.sqrt(4 * area / math.pi)) / 2
        pistons.append(_Piston(member.name, guide, along, half, area, -float(face.sense), max([0.0, *ahead])))
    facing = len(pistons) == 1 or (len(pistons) == 2 and pistons[0].side == -pistons[1].side)
    return pistons if facing else []


def _ends(chambers: Sequence[Space]) -> dict[str, tuple[_Piston, float, float]]:
    """Return the extent of each piston from its pin along its guide, up to the gas on each side. [m]"""
    sides: dict[str, tuple[_Piston, list[float]]] = {}
    for space in chambers:
        for piston, edge in zip(space.pistons, (space.start, space.end), strict=False):
            sides.setdefault(piston.name, (piston, []))[1].append(float(np.mean(edge - piston.along)))
    reach = {}
    for name, (piston, edges) in sides.items():
        thick = 2 * _THICK * piston.half
        # a pin that is near stands in the piston, one that is far off has a rod
        behind = edges[0] - piston.side * thick
        if abs(edges[0]) < 2 * _TRUNK * piston.half:
            behind = min(behind, -thick / 2) if piston.side > 0 else max(behind, thick / 2)
        both_edges = edges if len(edges) > 1 else [edges[0], behind]
        reach[name] = (piston, min(both_edges), max(both_edges))
    return reach


def with_pistons(drawn: Scene, chambers: Sequence[Space], scale: float) -> Scene:
    """Return a linkage with pistons in the place of blocks and guides; one with a rod has its crosshead in these.

    `scale`: units of the picture in a metre.
    """
    pistons = _ends(chambers)
    trunks = [name for name, (_, low, high) in pistons.items() if low <= 0 <= high]
    bars = [bar for bar in drawn.bars if bar.name not in pistons]
    blocks = [block._replace(kind="crosshead") if block.name in pistons else block for block in drawn.blocks]
    blocks = [block for block in blocks if block.name not in trunks]
    # what is no block has a rod in a bushing, which stands for that of the piston
    rams = {block.name for block in blocks if block.is_still}
    for name, (piston, low, high) in pistons.items():
        middle, half = piston.line.place(piston.along + (low + high) / 2) * scale, (high - low) / 2 * scale
        blocks.append(Block(name, Pose(middle, piston.line.along), (half, piston.half * scale), is_still=True))
        if low > 0 or high < 0:
            near = low if low > 0 else high
            bars.append(
                Bar(name, (piston.line.place(piston.along) * scale, piston.line.place(piston.along + near) * scale))
            )
    rails = [rail for rail in drawn.rails if rail.name not in pistons or rail.name in rams]
    return drawn._replace(bars=bars, blocks=blocks, rails=rails)


def gas(chambers: Sequence[Space], scale: float) -> tuple[list[Polyline], list[Part]]:
    """Return walls and heads, and gas; `scale`: millimetres of the paper in a metre."""
    items: list[Polyline] = []
    parts: list[Part] = []
    pistons = _ends(chambers)
    for space, seen in zip(chambers, tints([chamber.pressure for chamber in chambers]), strict=True):
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
    for piston, low, high in (pistons[member.name] for member in space.pistons):
        ends += [float(piston.along.min()) + low, float(piston.along.max()) + high]
    sides = (first.half + _GAP / scale, -first.half - _GAP / scale)
    pairs = [((min(ends), side), (max(ends), side)) for side in sides]
    if len(space.pistons) == 1:
        head = float(np.mean(space.end))
        pairs.append(((head, sides[0]), (head, sides[1])))
    ends_of = [[first.line.place(*corner)[0] * scale for corner in pair] for pair in pairs]
    return [line(start, end, "thick") for start, end in ends_of]


def _turn(guide: Pose) -> float:
    x, y = guide.along[0]
    return math.degrees(math.atan2(y, x))
