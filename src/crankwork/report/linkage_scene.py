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
_SLOT_MARGIN, _RAIL_MARGIN, _GAP = 18.0, 10.0, 1.5
# of the shortest length of a cylinder, how far its rod reaches, and how much its barrel is longer than it must be
_IN_BARREL, _MARGIN_OF_BARREL = 0.85, 0.1
_BUSHING, _BUSHING_CLEAR, _ROD_MARGIN = 34.0, 30.0, 14.0


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
        return next((bar for bar in self.bars if bar.name == name), None)


def scene(shape: Skeleton, moving: Moving, size: float) -> tuple[Scene, float]:
    """Return the parts of a linkage and the scale, units of the picture per metre."""
    metres = tracks(shape, moving)
    slides = _slides(shape, moving, metres)
    reach = [*metres.values(), *(slide.anchor for slide in slides)]
    reach += [
        piece.anchor + piece.side * np.ptp(piece.along) * piece.line.along for piece in slides if piece.member.has_rod
    ]
    places = np.vstack(reach)
    scale = size / float(np.max(np.ptp(places, axis=0), initial=1e-9))
    points = {name: place * scale for name, place in metres.items()}
    drawn = Scene(shape, points, [], [], [], [])
    for member in shape.members:
        if member.rod:
            drawn.bars.extend(_cylinder(member.name, points[member.points[0]], points[member.points[1]]))
        elif not member.guide:
            drawn.bars.extend(_bars(member.name, [points[name] for name in member.points]))
    scaled = [slide.scaled(scale) for slide in slides]
    _add_slots(drawn, [slide for slide in scaled if slide.member.guide and slide.member.guide.link])
    _add_rails(drawn, [slide for slide in scaled if slide.member.guide and not slide.member.guide.link])
    _add_stubs(drawn, scaled)
    return drawn, scale


def _cylinder(name: str, barrel: Array, rod: Array) -> list[Bar]:
    """Return a rod and the barrel that it moves in, which holds its end at every length."""
    vector = rod - barrel
    length = np.hypot(vector[:, :1], vector[:, 1:])
    inside = _IN_BARREL * float(length.min())
    along = vector / length
    reach = min(float(length.max()) - inside + _MARGIN_OF_BARREL * float(length.min()), float(length.min()))
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
    slides = []
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
        slides.append(_Slide(member, line, anchor, along, side))
    return slides


def _bars(name: str, nodes: list[Array]) -> list[Bar]:
    """Return the line or the polygon of a link."""
    if len(nodes) < 2:
        return []
    first = np.array([node[0] for node in nodes])
    offsets = first - first[0]
    axis = offsets[int(np.argmax(np.hypot(*offsets.T)))]
    length = float(np.hypot(*axis)) or 1.0
    across = (offsets[:, 1] * axis[0] - offsets[:, 0] * axis[1]) / length
    if np.ptp(across) < 4.0:
        order = np.argsort(offsets @ axis)
        return [Bar(name, (nodes[order[0]], nodes[order[-1]]))]
    centre = first.mean(axis=0)
    around = np.argsort(np.arctan2(first[:, 1] - centre[1], first[:, 0] - centre[0]))
    return [Bar(name, tuple(nodes[i] for i in around), is_flat=False)]


def _add_slots(drawn: Scene, slides: list[_Slide]) -> None:
    """Add blocks and the slots that they run in, one slot for pieces on one line of a link."""
    for slide in slides:
        guide = slide.member.guide
        if guide is None:
            continue
        low, high = float(slide.along.min()) - _SLOT_MARGIN, float(slide.along.max()) + _SLOT_MARGIN
        drawn.blocks.append(Block(slide.member.name, Pose(slide.anchor, slide.line.along), BLOCK, is_still=False))
        for index, slot in enumerate(drawn.slots):
            offset = slot.line.seen(slide.line.origin)[0]
            if slot.carrier == guide.link and abs(offset[1]) < 0.5 and _is_parallel(slot.line, slide.line):
                turn = float(np.sign(slot.line.along[0] @ slide.line.along[0]))
                ends = sorted((offset[0] + turn * low, offset[0] + turn * high))
                drawn.slots[index] = slot._replace(start=min(slot.start, ends[0]), end=max(slot.end, ends[1]))
                break
        else:
            drawn.slots.append(Slot(guide.link, slide.line, low, high))


def _is_parallel(first: Pose, second: Pose) -> bool:
    return abs(abs(float(first.along[0] @ second.along[0])) - 1) < 1e-6


def _add_rails(drawn: Scene, slides: list[_Slide]) -> None:
    """Add what slides on fixed guides: rams between walls, and rods in bushings."""
    for slide in slides:
        low, high = float(slide.along.min()), float(slide.along.max())
        if not slide.member.has_rod:
            half_along = RAM[0]
            drawn.blocks.append(Block(slide.member.name, Pose(slide.anchor, slide.line.along), RAM, is_still=True))
            reach = half_along + _RAIL_MARGIN
            drawn.rails.append(Rail(slide.member.name, slide.line, low - reach, high + reach, RAM[1] + _GAP))
            continue
        clear = _BUSHING_CLEAR + _slot_reach(drawn, slide)
        near = (high if slide.side > 0 else low) + slide.side * clear
        far = near + slide.side * _BUSHING
        start = low if slide.side > 0 else high
        tip = slide.anchor + (far + slide.side * _ROD_MARGIN - start) * slide.line.along
        drawn.bars.append(Bar(slide.member.name, (slide.anchor, tip)))
        drawn.rails.append(Rail(slide.member.name, slide.line, min(near, far), max(near, far), 5.0))


def _slot_reach(drawn: Scene, slide: _Slide) -> float:
    """Return the extent of the slots of a piece ahead of it along its line."""
    reach = 0.0
    for slot in drawn.slots:
        if slot.carrier == slide.member.name:
            for end in (slot.start, slot.end):
                ahead = np.sum((slot.line.place(end) - slide.anchor) * slide.line.along, axis=1) * slide.side
                reach = max(reach, float(np.max(ahead)) + SLOT)
    return reach


def _add_stubs(drawn: Scene, slides: list[_Slide]) -> None:
    """Join each slot to the points of its link that it does not reach, and a piece to its further points."""
    anchors = {slide.member.name: slide.anchor for slide in slides}
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
    for slide in slides:
        for name in slide.member.points:
            if float(np.hypot(*(drawn.points[name][0] - slide.anchor[0]))) > 2.0:
                drawn.bars.append(Bar(slide.member.name, (slide.anchor, drawn.points[name])))


def _runs_along(bar: Bar, slot: Slot) -> bool:
    """Return whether a bar lies on the line of a slot and meets it."""
    ends = np.array([slot.line.seen(node)[0] for node in bar.nodes])
    return bool(np.ptp(ends[:, 1]) < 1.0 and ends[:, 0].max() > slot.start and ends[:, 0].min() < slot.end)
