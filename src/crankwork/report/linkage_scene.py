"""Where the parts of a drawn linkage are: bars, slots, blocks, rails, rods and bushings, in units of the picture."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.moving import Moving
from crankwork.analysis.skeleton import Member, Pose, Skeleton, guide_pose, tracks
from crankwork.mechanism.driver import rod_name

BLOCK = (14.0, 8.0)
RAM = (22.0, 13.0)
SLOT = 9.5
_SLOT_SPARE, _RAIL_SPARE, _GAP = 18.0, 10.0, 1.5
# of the shortest length of a cylinder, how far its rod reaches, and how much its barrel is longer than it must be
_IN_BARREL, _SPARE_OF_BARREL = 0.85, 0.1
_BUSHING, _BUSHING_CLEAR, _ROD_SPARE = 34.0, 30.0, 14.0


class Bar(NamedTuple):
    """A link between its points, arrays of shape (n, 2); a triangle or more where they are not in line."""

    name: str
    nodes: tuple[Array, ...]
    is_flat: bool = True


class Slot(NamedTuple):
    """A slot that a link carries, from `start` to `end` along its line."""

    carrier: str
    line: Pose
    start: float
    end: float


class Block(NamedTuple):
    """A sliding piece: its middle at each angle, the direction of its line, half its length and width."""

    name: str
    pose: Pose
    half: tuple[float, float]
    is_still: bool
    kind: str = "block"


class Rail(NamedTuple):
    """A fixed guide: two walls beside what slides in it, by its name, from `start` to `end` along its line."""

    name: str
    line: Pose
    start: float
    end: float
    half: float


class Scene(NamedTuple):
    """All parts of a linkage, in units of the picture, y upwards; `points` are arrays of shape (n, 2)."""

    skeleton: Skeleton
    points: dict[str, Array]
    bars: list[Bar]
    slots: list[Slot]
    blocks: list[Block]
    rails: list[Rail]

    def bar(self, name: str) -> Bar | None:
        """Return the first bar of a link."""
        return next((one for one in self.bars if one.name == name), None)


def scene(shape: Skeleton, moving: Moving, size: float) -> tuple[Scene, float]:
    """Return the parts of a linkage and the scale, units of the picture per metre."""
    metres = tracks(shape, moving)
    slides = _slides(shape, moving, metres)
    reach = [*metres.values(), *(one.anchor for one in slides)]
    reach += [one.anchor + one.side * np.ptp(one.along) * one.line.along for one in slides if one.member.has_rod]
    places = np.vstack(reach)
    scale = size / float(np.max(np.ptp(places, axis=0), initial=1e-9))
    points = {name: place * scale for name, place in metres.items()}
    drawn = Scene(shape, points, [], [], [], [])
    for one in shape.members:
        if one.rod:
            drawn.bars.extend(_cylinder(one.name, points[one.points[0]], points[one.points[1]]))
        elif not one.guide:
            drawn.bars.extend(_bars(one.name, [points[name] for name in one.points]))
    scaled = [one.scaled(scale) for one in slides]
    _add_slots(drawn, [one for one in scaled if one.member.guide and one.member.guide.link])
    _add_rails(drawn, [one for one in scaled if one.member.guide and not one.member.guide.link])
    _add_stubs(drawn, scaled)
    return drawn, scale


def _cylinder(name: str, barrel: Array, rod: Array) -> list[Bar]:
    """Return a rod and the barrel that it moves in, which holds its end at every length."""
    way = rod - barrel
    length = np.hypot(way[:, :1], way[:, 1:])
    inside = _IN_BARREL * float(length.min())
    along = way / length
    reach = min(float(length.max()) - inside + _SPARE_OF_BARREL * float(length.min()), float(length.min()))
    return [Bar(rod_name(name), (rod - inside * along, rod)), Bar(name, (barrel, barrel + reach * along))]


class _Slide(NamedTuple):
    """A piece on its line: where it is, how far along, and on which side its rod leaves it."""

    member: Member
    line: Pose
    anchor: Array
    along: Array
    side: int

    def scaled(self, scale: float) -> _Slide:
        line = Pose(self.line.origin * scale, self.line.along)
        return self._replace(line=line, anchor=self.anchor * scale, along=self.along * scale)


def _slides(shape: Skeleton, moving: Moving, metres: dict[str, Array]) -> list[_Slide]:
    found = []
    middle = np.mean([np.mean(place, axis=0) for place in metres.values()], axis=0)
    for member in shape.members:
        if member.guide is None:
            continue
        line = guide_pose(member.guide, moving)
        anchor, far = moving.frames[member.name].origin.place, None
        if member.points and member.has_rod:
            # its rod goes towards what it carries
            far = np.mean([np.mean(metres[name], axis=0) for name in member.points], axis=0)
        elif member.points:
            seen = line.seen(metres[member.points[0]])
            if np.max(np.abs(seen[:, 1])) < 1e-6 * max(np.ptp(seen[:, 0]), 1e-6):
                anchor = metres[member.points[0]]
        along = line.seen(anchor)[:, 0]
        ahead = np.mean(anchor, axis=0) - middle if far is None else far - np.mean(anchor, axis=0)
        side = -1 if float(ahead @ line.along[0]) < -1e-9 else 1
        found.append(_Slide(member, line, anchor, along, side))
    return found


def _bars(name: str, nodes: list[Array]) -> list[Bar]:
    """Return the line or the polygon of a link."""
    if len(nodes) < 2:
        return []
    first = np.array([node[0] for node in nodes])
    apart = first - first[0]
    axis = apart[int(np.argmax(np.hypot(*apart.T)))]
    length = float(np.hypot(*axis)) or 1.0
    across = (apart[:, 1] * axis[0] - apart[:, 0] * axis[1]) / length
    if np.ptp(across) < 4.0:
        order = np.argsort(apart @ axis)
        return [Bar(name, (nodes[order[0]], nodes[order[-1]]))]
    centre = first.mean(axis=0)
    around = np.argsort(np.arctan2(first[:, 1] - centre[1], first[:, 0] - centre[0]))
    return [Bar(name, tuple(nodes[i] for i in around), is_flat=False)]


def _add_slots(drawn: Scene, slides: list[_Slide]) -> None:
    """Add blocks and the slots that they run in, one slot for pieces on one line of a link."""
    for one in slides:
        guide = one.member.guide
        if guide is None:
            continue
        low, high = float(one.along.min()) - _SLOT_SPARE, float(one.along.max()) + _SLOT_SPARE
        drawn.blocks.append(Block(one.member.name, Pose(one.anchor, one.line.along), BLOCK, is_still=False))
        for index, slot in enumerate(drawn.slots):
            offset = slot.line.seen(one.line.origin)[0]
            if slot.carrier == guide.link and abs(offset[1]) < 0.5 and _is_parallel(slot.line, one.line):
                turn = float(np.sign(slot.line.along[0] @ one.line.along[0]))
                ends = sorted((offset[0] + turn * low, offset[0] + turn * high))
                drawn.slots[index] = slot._replace(start=min(slot.start, ends[0]), end=max(slot.end, ends[1]))
                break
        else:
            drawn.slots.append(Slot(guide.link, one.line, low, high))


def _is_parallel(one: Pose, other: Pose) -> bool:
    return abs(abs(float(one.along[0] @ other.along[0])) - 1) < 1e-6


def _add_rails(drawn: Scene, slides: list[_Slide]) -> None:
    """Add what slides on fixed guides: rams between walls, and rods in bushings."""
    for one in slides:
        low, high = float(one.along.min()), float(one.along.max())
        if not one.member.has_rod:
            half_along = RAM[0]
            drawn.blocks.append(Block(one.member.name, Pose(one.anchor, one.line.along), RAM, is_still=True))
            spare = half_along + _RAIL_SPARE
            drawn.rails.append(Rail(one.member.name, one.line, low - spare, high + spare, RAM[1] + _GAP))
            continue
        clear = _BUSHING_CLEAR + _slot_reach(drawn, one)
        near = (high if one.side > 0 else low) + one.side * clear
        far = near + one.side * _BUSHING
        start = low if one.side > 0 else high
        tip = one.anchor + (far + one.side * _ROD_SPARE - start) * one.line.along
        drawn.bars.append(Bar(one.member.name, (one.anchor, tip)))
        drawn.rails.append(Rail(one.member.name, one.line, min(near, far), max(near, far), 5.0))


def _slot_reach(drawn: Scene, one: _Slide) -> float:
    """Return how far the slots of a piece reach ahead of it along its line."""
    reach = 0.0
    for slot in drawn.slots:
        if slot.carrier == one.member.name:
            for end in (slot.start, slot.end):
                ahead = np.sum((slot.line.place(end) - one.anchor) * one.line.along, axis=1) * one.side
                reach = max(reach, float(np.max(ahead)) + SLOT)
    return reach


def _add_stubs(drawn: Scene, slides: list[_Slide]) -> None:
    """Join each slot to the points of its link that it does not reach, and a piece to its further points."""
    anchors = {one.member.name: one.anchor for one in slides}
    for slot in drawn.slots:
        member = drawn.skeleton.member(slot.carrier)
        nodes = [anchors[member.name]] if member.name in anchors else [drawn.points[name] for name in member.points]
        line = drawn.bar(member.name)
        for node in nodes:
            seen = slot.line.seen(node)[0]
            nearest = slot.line.place(min(max(float(seen[0]), slot.start), slot.end))
            if float(np.hypot(*(node[0] - nearest[0]))) > 2.0 and not (
                line and line.is_flat and abs(seen[1]) < 1.0 and _runs_along(line, slot)
            ):
                drawn.bars.append(Bar(member.name, (node, nearest)))
    for one in slides:
        for name in one.member.points:
            if float(np.hypot(*(drawn.points[name][0] - one.anchor[0]))) > 2.0:
                drawn.bars.append(Bar(one.member.name, (one.anchor, drawn.points[name])))


def _runs_along(bar: Bar, slot: Slot) -> bool:
    """Return whether a bar lies on the line of a slot and meets it."""
    ends = np.array([slot.line.seen(node)[0] for node in bar.nodes])
    return bool(np.ptp(ends[:, 1]) < 1.0 and ends[:, 0].max() > slot.start and ends[:, 0].min() < slot.end)
