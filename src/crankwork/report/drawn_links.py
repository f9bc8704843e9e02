"""How a linkage is drawn: its ground, its links as parts that move, the gas in its chambers, its labels."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import count, pairwise, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis import Array
from crankwork.analysis.sampled_motion import SampledMotion
from crankwork.analysis.skeleton import Member, MovingFrame, Skeleton, guide_pose, tracks
from crankwork.machine import Machine
from crankwork.mechanism.driver import rod_name
from crankwork.mechanism.linkage import GROUND
from crankwork.report.sketch import Length, Sketch, dimension_lines, forces_in_joints, tints, with_forces
from crankwork.show.animation import Part, part
from crankwork.show.scene import ChartBox, Circle, Item, Pen, Polyline, Text, line, literal, rectangle, rotation_arrow

BLOCK = (14.0, 8.0)
RAM = (22.0, 13.0)
SLOT = 9.5
_SLOT_MARGIN, _RAIL_MARGIN, _AIR = 18.0, 10.0, 1.5
# of the shortest length of a cylinder, how far its rod reaches, and how much its barrel is longer than it must be
_IN_BARREL, _MARGIN_OF_BARREL = 0.85, 0.1
_BUSHING, _BUSHING_CLEAR, _ROD_MARGIN = 34.0, 30.0, 14.0
# millimetres of paper in a unit in which blocks and pivots are sized; distance of hatches in such units
UNIT, HATCH = 0.3, 8.0
_SIZE = 420.0
_GROUND_REACH = ((-34.0, 0.0), (38.0, -36.0))
_LINK, _DRIVER, _BARREL = Pen(0.9), Pen(1.5), Pen(2.7)
_LETTERS, _ROTATION = 3.2, 4.5
_TURNS = np.radians([45, 135, 315, 225, 90, 0, 180, 270, 20, 70, 110, 160, 200, 250, 290, 340])
_AROUND = np.column_stack([np.cos(_TURNS), np.sin(_TURNS)])
_REACHES = (15.0, 19.0, 24.0, 30.0)
# a centre of mass nearer than this to a joint has no name
_NEAR_JOINT = 10.0
# under a support and beside it, where no link goes
_SUPPORTS = (0.0, -43.0), (-27.0, -12.0), (27.0, -12.0)
_EVERY = 3
_STEP = 7.0
# a number nearer than this to a link is read as that of the link
_NEAR = 15.0
# of the bore: how far the crown of a piston is from its pin where nobody says, how thick a piston is, how far its crown
# is from its pin at most where it has no rod, and a cover that a rod goes through from the crosshead
_CROWN, _THICK, _TRUNK, _CLEAR = 0.35, 0.35, 1.25, 0.15
_GAP = 0.3
_NO_LINE = Pen(0.0)


class Bar(NamedTuple):
    """A link between its points, arrays of shape (n, 2); a triangle or more where they are not in line."""

    name: str
    nodes: tuple[Array, ...]
    is_flat: bool = True


class Slot(NamedTuple):
    """A slot that a link carries, from `start` to `end` along its line."""

    carrier: str
    line: MovingFrame
    start: float
    end: float


class Block(NamedTuple):
    """A sliding piece: its middle at each angle, the direction of its line, half its length and width."""

    name: str
    pose: MovingFrame
    half: tuple[float, float]
    is_still: bool
    kind: str = "block"


class Rail(NamedTuple):
    """A fixed guide: two walls beside what slides in it, by its name, from `start` to `end` along its line."""

    name: str
    line: MovingFrame
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


def scene(shape: Skeleton, moving: SampledMotion, size: float) -> tuple[Scene, float]:
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
    line: MovingFrame
    anchor: Array
    along: Array
    side: int

    def scaled(self, scale: float) -> _Slide:
        line = MovingFrame(self.line.origin * scale, self.line.along)
        return self._replace(line=line, anchor=self.anchor * scale, along=self.along * scale)


def _slides(shape: Skeleton, moving: SampledMotion, metres: dict[str, Array]) -> list[_Slide]:
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
        drawn.blocks.append(
            Block(slide.member.name, MovingFrame(slide.anchor, slide.line.along), BLOCK, is_still=False)
        )
        for index, slot in enumerate(drawn.slots):
            offset = slot.line.seen(slide.line.origin)[0]
            turn = float(slot.line.along[0] @ slide.line.along[0])
            if abs(abs(turn) - 1) < 1e-6 and slot.carrier == guide.link and abs(offset[1]) < 0.5:
                turn = float(np.sign(turn))
                ends = sorted((offset[0] + turn * low, offset[0] + turn * high))
                drawn.slots[index] = slot._replace(start=min(slot.start, ends[0]), end=max(slot.end, ends[1]))
                break
        else:
            drawn.slots.append(Slot(guide.link, slide.line, low, high))


def _add_rails(drawn: Scene, slides: list[_Slide]) -> None:
    """Add what slides on fixed guides: rams between walls, and rods in bushings."""
    for slide in slides:
        low, high = float(slide.along.min()), float(slide.along.max())
        if not slide.member.has_rod:
            half_along = RAM[0]
            drawn.blocks.append(
                Block(slide.member.name, MovingFrame(slide.anchor, slide.line.along), RAM, is_still=True)
            )
            reach = half_along + _RAIL_MARGIN
            drawn.rails.append(Rail(slide.member.name, slide.line, low - reach, high + reach, RAM[1] + _AIR))
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


def linkage_sketch(  # noqa: PLR0913 - a linkage, and what is shown of it
    shape: Skeleton,
    moving: SampledMotion,
    machine: Machine | None = None,
    columns: Mapping[str, Array] | None = None,
    forces: Mapping[str, str] | None = None,
    frame: int | None = None,
    lengths: Sequence[Length] = (),
    *,
    has_room: bool = True,
) -> Sketch:
    """Return a linkage as it is drawn over all its angles; `frame`: the only one that is looked at, with `lengths`.

    `columns`: gas of the chambers of a machine, and forces in joints where they are to be drawn, by key, shape (n,);
    `forces`: what is written at them, by joint; `has_room`: whether there is room for them.
    """
    drawn, scale = scene(shape, moving, _SIZE)
    chambers = spaces(machine, shape, moving, columns or {}, RAM[0] / scale)
    drawn = with_pistons(drawn, chambers, scale)
    paths = [drawn.points[name] for name in shape.traced]
    texts = labels(drawn, [path[::2] for path in paths])
    items: list[Item] = [
        Polyline(path * UNIT, "axis", name=f"path.{name}") for name, path in zip(shape.traced, paths, strict=True)
    ]
    written = [
        part(f"text.{index}", [_text(label.text, slanted=not label.is_number)], label.places * UNIT)
        for index, label in enumerate(texts, start=1)
    ]
    places = (
        np.vstack([corners(drawn), *(label.places + side * label.half for label in texts for side in (1, -1))]) * UNIT
    )
    walls, filled = gas(chambers, scale * UNIT)
    places = np.vstack([places, *(wall.points for wall in walls)])
    parts = [*filled, *_parts(drawn), *written]
    low, high = places.min(axis=0), places.max(axis=0)
    if shape.pin:
        pivot_of_crank = drawn.points[next(iter(shape.pivots))][0]
        (x, y), (u, v) = drawn.points[shape.pin][:2] - pivot_of_crank
        items += rotation_arrow(pivot_of_crank * UNIT, _ROTATION, x * v - y * u)
    if lengths and frame is not None:
        standing = {name: point[frame] * UNIT for name, point in drawn.points.items()}
        letters = np.vstack([label.places[frame] for label in texts]) * UNIT
        measured, covered = dimension_lines(lengths, standing, letters)
        items += measured
        low, high = np.minimum(low, covered.min(axis=0) - _LETTERS), np.maximum(high, covered.max(axis=0) + _LETTERS)
    sketch = Sketch([*items, *walls, *ground(drawn)], parts, low, high, scale * UNIT)
    points = {name: point * UNIT for name, point in drawn.points.items()}
    return with_forces(sketch, forces_in_joints(columns or {}, points, forces or {}), frame, has_room=has_room)


def _text(text: str, *, slanted: bool) -> Text:
    shown = f"/{{{text}}}" if slanted and text.isalnum() else literal(text)
    return Text((0.0, -_LETTERS / 2), shown, _LETTERS, "middle", halo=True)


def ground(drawn: Scene, middle: Array | tuple[float, float] = (0.0, 0.0)) -> list[Item]:
    """Return guides and pivots, hatched; `middle`: where the origin stands on the paper [mm]."""
    items: list[Item] = []
    for rail in drawn.rails:
        ends = [rail.line.place(end)[0] * UNIT + middle for end in (rail.start - 14, rail.end + 14)]
        items.append(line(ends[0], ends[1], "axis"))
        for start, end in walls(rail):
            items += hatched(start * UNIT + middle, end * UNIT + middle)
    for name in drawn.skeleton.pivots:
        items += pivot(drawn.points[name][0] * UNIT + middle)
    return items


def pivot(position: Array) -> list[Item]:
    """Return the support of a fixed joint: a triangle upon hatched ground. [mm]"""
    triangle = position + np.array([[0.0, 0.0], [-13.0, -24.0], [13.0, -24.0]]) * UNIT
    foot = [position + np.array([side, -24.0]) * UNIT for side in (20.0, -20.0)]
    return [Polyline(triangle, "medium", closed=True, fill=1.0), *hatched(*foot)]


def hatched(start: Array, end: Array) -> list[Item]:
    """Return a wall, hatched on the left of the way from start to end. [mm]"""
    length = float(np.hypot(*(end - start)))
    ahead, step = (end - start) / length, HATCH * UNIT
    slant = step * (np.array([-ahead[1], ahead[0]]) - ahead)
    feet = start + np.arange(step, length + 0.03, step)[:, None] * ahead
    return [line(start, end, "medium"), *(line(foot, foot + slant) for foot in feet)]


def walls(rail: Rail) -> list[tuple[Array, Array]]:
    """Return the two walls of a fixed guide, the outside on the left of the way as seen from above."""
    upper = [rail.line.place(end, rail.half)[0] for end in (rail.start, rail.end)]
    lower = [rail.line.place(end, -rail.half)[0] for end in (rail.end, rail.start)]
    return [(upper[0], upper[1]), (lower[0], lower[1])]


def _parts(drawn: Scene) -> Iterator[Part]:
    """Yield the moving parts: rams, links, slots and the blocks in them, the driving link, joints upon all."""
    driver = drawn.skeleton.driver
    for block in (block_ for block_ in drawn.blocks if block_.is_still):
        yield _block(block)
    numbers = {name: count(1) for name in [bar_.name for bar_ in drawn.bars]}
    for bar in sorted(drawn.bars, key=lambda item: item.is_flat):
        if bar.name != driver.name:
            yield _link(bar, _LINK, next(numbers[bar.name]))
    for index, slot in enumerate(drawn.slots, start=1):
        middle, half = slot_middle(slot)
        yield _carried(f"slot.{slot.carrier}.{index}", MovingFrame(middle, slot.line.along), _slotted(half), 1.0)
    for block in (block_ for block_ in drawn.blocks if not block_.is_still):
        yield _block(block)
    for bar in (bar_ for bar_ in drawn.bars if bar_.name == driver.name):
        yield _link(bar, _BARREL if driver.rod else _DRIVER, next(numbers[bar.name]))
    for name in drawn.skeleton.letters:
        if name in drawn.points:
            dot = Circle((0.0, 0.0), 0.9, "thin", 0.0) if name in drawn.skeleton.centres else _JOINT
            yield part(f"joint.{name}", [dot], drawn.points[name] * UNIT)


_JOINT = Circle((0.0, 0.0), 1.5, "medium", 1.0)


def _block(block: Block) -> Part:
    u, v = block.half
    return _carried(f"{block.kind}.{block.name}", block.pose, np.array([(u, v), (-u, v), (-u, -v), (u, -v)]), 0.87)


def _slotted(half: float) -> Array:
    """Return the outline of a slot with round ends, shape (k, 2)."""
    turns = np.radians(np.linspace(-90, 90, 13))
    end = np.column_stack([half - SLOT + SLOT * np.cos(turns), SLOT * np.sin(turns)])
    return np.vstack([end, -end])


def _carried(name: str, pose: MovingFrame, outline: Array, fill: float) -> Part:
    """Return an area that follows a frame."""
    turns = np.degrees(np.unwrap(np.arctan2(pose.along[:, 1], pose.along[:, 0])))
    return part(name, [Polyline(outline * UNIT, "medium", closed=True, fill=fill)], pose.origin * UNIT, turns)


def _link(bar: Bar, pen: Pen, number: int) -> Part:
    """Return a link as a line, or as a plate between its points."""
    start = bar.nodes[0]
    far = max(bar.nodes[1:], key=lambda node: float(np.hypot(*(node[0] - start[0]))))
    vector = far - start
    turns = np.unwrap(np.arctan2(vector[:, 1], vector[:, 0]))
    cos, sin = np.cos(turns[0]), np.sin(turns[0])
    nodes = np.array([node[0] - start[0] for node in bar.nodes]) @ np.array([[cos, -sin], [sin, cos]]) * UNIT
    shape = Polyline(nodes, pen) if bar.is_flat else Polyline(nodes, _LINK, closed=True, fill=0.93)
    return part(f"link.{bar.name}.{number}", [shape], start * UNIT, np.degrees(turns))


def slot_middle(slot: Slot) -> tuple[Array, float]:
    """Return the middle of a slot, array of shape (n, 2), and half its length."""
    return slot.line.place((slot.start + slot.end) / 2), (slot.end - slot.start) / 2


def corners(drawn: Scene) -> Array:
    """Return places that the parts of a linkage reach, shape (k, 2)."""
    places = [*drawn.points.values(), *(node for bar in drawn.bars for node in bar.nodes)]
    for slot in drawn.slots:
        places += [slot.line.place(end, side) for end in (slot.start, slot.end) for side in (SLOT, -SLOT)]
    for block in drawn.blocks:
        u, v = block.half
        places += [block.pose.place(x, y) for x in (u, -u) for y in (v, -v)]
    for rail in drawn.rails:
        outside = rail.half + HATCH
        places += [
            rail.line.place(end, side) for end in (rail.start - 14, rail.end + 14) for side in (outside, -outside)
        ]
    for name in drawn.skeleton.pivots:
        places += [drawn.points[name] + np.array(reach) for reach in _GROUND_REACH]
    return np.vstack(places)


class Label(NamedTuple):
    """A text whose middle follows places, array of shape (n, 2); y upwards."""

    text: str
    places: Array
    is_number: bool

    @property
    def half(self) -> Array:
        """Half its width and height. [px]"""
        return np.array([4.4 * len(self.text) + 1.5, 6.5])


def labels(drawn: Scene, fixed: Sequence[Array] = (), *, stride: int = _EVERY) -> list[Label]:
    """Return the names of points and the numbers of links."""
    obstacles, owners = _samples(drawn, stride)
    still = np.vstack([*fixed, np.zeros((0, 2))])
    count = obstacles.shape[0]
    obstacles = np.concatenate([obstacles, np.broadcast_to(still, (count, *still.shape))], axis=1)
    owners += [""] * len(still)
    placed: list[Label] = []
    # without pivots there is no place for the number of the ground
    for text, link, ways in (label for label in _wanted(drawn) if label[2]):
        # places on other links, of which a number could be
        is_other = np.array([bool(link and owner and owner != link) for owner in owners])
        seen = _Seen(np.ascontiguousarray(obstacles[..., 0]), np.ascontiguousarray(obstacles[..., 1]), is_other)
        choices = [(Label(text, place, bool(link)), extra) for place, extra in ways]
        placed.append(_cheapest(choices, seen, placed, stride))
    return placed


class _Seen(NamedTuple):
    """Places on all that is drawn, shape (frames, k), and which of them are on links that a number is not of."""

    x: Array
    y: Array
    is_other: NDArray[np.bool_]


def _cheapest(ways: Sequence[tuple[Label, float]], seen: _Seen, placed: Sequence[Label], stride: int) -> Label:
    """Return the label that costs least; one that costs more at least than another does is not looked at."""
    best, chosen = np.inf, 0
    seen = _reachable([label for label, _ in ways], seen, stride)
    names = np.array([label.places[::stride] for label in placed]), np.array([[label.half] for label in placed])
    for index in sorted(range(len(ways)), key=lambda candidate: ways[candidate][1]):
        label, extra = ways[index]
        if extra > best:
            break
        cost = _cost(label, extra, seen, names, stride)
        best, chosen = min((best, chosen), (cost, index))
    return ways[chosen][0]


def _reachable(ways: Sequence[Label], seen: _Seen, stride: int) -> _Seen:
    """Return the places that a label could cover, or be read as the number of, at one place or another."""
    places = np.array([label.places[::stride] for label in ways])
    half = np.max([label.half for label in ways], axis=0) + (_NEAR if seen.is_other.any() else 0.0)
    low, high = places.min(axis=0) - half, places.max(axis=0) + half
    near = (seen.x > low[:, :1]) & (seen.x < high[:, :1]) & (seen.y > low[:, 1:]) & (seen.y < high[:, 1:])
    kept = near.any(axis=0)
    return _Seen(np.ascontiguousarray(seen.x[:, kept]), np.ascontiguousarray(seen.y[:, kept]), seen.is_other[kept])


def _cost(label: Label, extra: float, seen: _Seen, names: tuple[Array, Array], stride: int) -> float:
    centre, half = label.places[::stride, None], label.half
    off = seen.x - centre[..., 0], seen.y - centre[..., 1]
    covered = (np.abs(off[0]) < half[0]) & (np.abs(off[1]) < half[1])
    cost = extra + 10.0 * float(np.count_nonzero(covered)) / len(centre)
    if seen.is_other.any():
        # a number as close to another link as to its own is misleading
        distance = np.hypot(off[0][:, seen.is_other], off[1][:, seen.is_other]).min(axis=1)
        cost += 60.0 * float(np.mean(distance < _NEAR))
    middles, halves = names
    if len(middles):
        covers = np.all(np.abs(middles - label.places[::stride]) < half + halves + (11.0, 2.0), axis=2)
        cost += 60.0 * float(covers.mean(axis=1).sum())
    return cost


def _wanted(drawn: Scene) -> Iterator[tuple[str, str, list[tuple[Array, float]]]]:
    """Yield each text, the link it numbers, the places where it could be, and the least cost of each."""
    shape = drawn.skeleton
    seen: set[str] = set()
    for name, letter in shape.letters.items():
        if name in drawn.points and letter not in seen and not _is_crossed(drawn, name):
            seen.add(letter)
            wide = 4.4 * (len(letter) - 1)
            supports = _SUPPORTS if name in shape.pivots else ()
            yield (
                letter,
                "",
                [(drawn.points[name] + spot, 0.0) for spot in supports]
                + [
                    (
                        drawn.points[name] + (reach + wide * abs(direction[0])) * direction,
                        0.4 * (reach - 15) + 0.2 * rank,
                    )
                    for reach in _REACHES
                    for rank, direction in enumerate(_AROUND)
                ],
            )
    spots = [(side * x, -y) for x, y in ((32, 24), (30, 12), (36, 36), (12, 46)) for side in (1, -1)]
    yield (
        "0",
        GROUND,
        [(drawn.points[name] + spot, 3.0 * rank) for rank, name in enumerate(shape.pivots) for spot in spots],
    )
    for member in shape.members:
        yield str(member.number), member.name, list(_number_ways(drawn, member.name))
        if member.rod:
            yield str(member.rod), rod_name(member.name), list(_number_ways(drawn, rod_name(member.name)))


def _is_crossed(drawn: Scene, name: str) -> bool:
    """Return whether a joint goes over a centre of mass, whose name would be in a heap with its own."""
    place, joints = (
        drawn.points[name],
        [letter for letter in drawn.skeleton.letters if letter not in drawn.skeleton.centres],
    )
    return name in drawn.skeleton.centres and any(
        np.hypot(*(drawn.points[joint] - place).T).min() < _NEAR_JOINT for joint in joints if joint in drawn.points
    )


def _number_ways(drawn: Scene, name: str) -> Iterator[tuple[Array, float]]:
    """Yield the places beside a link or block, and the least cost of each."""
    for block in (item for item in drawn.blocks if item.name == name):
        ways = product((10, 18, 26), (-0.6, 0.0, 0.6, -1.3, 1.3), (1, -1))
        for reach, share, side in ways:
            yield block.pose.place(share * block.half[0], side * (block.half[1] + reach)), 0.3 * reach
    for slot in (item for item in drawn.slots if item.carrier == name):
        for share, side in product((0.2, 0.5, 0.8), (1, -1)):
            yield slot.line.place(slot.start + share * (slot.end - slot.start), side * (SLOT + 10)), 6.0
    for bar in (item for item in drawn.bars if item.name == name):
        if not bar.is_flat:
            yield np.asarray(np.mean(bar.nodes, axis=0)), -8.0
        for start, end in _edges(bar.nodes, is_flat=bar.is_flat):
            yield from _places_along(start, end)


def _places_along(start: Array, end: Array) -> Iterator[tuple[Array, float]]:
    """Yield the places beside a line, its middle first."""
    along = end - start
    left = np.column_stack([-along[:, 1], along[:, 0]]) / np.maximum(np.hypot(*along.T), 1e-9)[:, None]
    for share, side in product((0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8), (1, -1)):
        yield start + share * along + side * 13 * left, 8 * abs(share - 0.5)


def _edges(nodes: Sequence[Array], *, is_flat: bool) -> Iterator[tuple[Array, Array]]:
    yield from pairwise(nodes)
    if not is_flat:
        yield nodes[-1], nodes[0]


def _samples(drawn: Scene, stride: int) -> tuple[Array, list[str]]:
    """Return places on everything that is drawn, shape (frames, k, 2), and the links that they are on."""
    lines = [(bar.name, edge) for bar in drawn.bars for edge in _edges(bar.nodes, is_flat=bar.is_flat)]
    for slot in drawn.slots:
        sides = (SLOT, -SLOT)
        ends = ((slot.line.place(slot.start, side), slot.line.place(slot.end, side)) for side in sides)
        lines += [(slot.carrier, end) for end in ends]
    for block in drawn.blocks:
        u, v = block.half
        rows = np.linspace(v, -v, max(3, int(v / _STEP))).tolist()
        lines += [(block.name, (block.pose.place(-u, side), block.pose.place(u, side))) for side in rows]
    for rail in drawn.rails:
        for side in (rail.half, rail.half + 6, -rail.half, -rail.half - 6):
            lines.append(("", (rail.line.place(rail.start, side), rail.line.place(rail.end, side))))
    for pivot in (place for name, place in drawn.points.items() if name in drawn.skeleton.pivots):
        feet = [(pivot, np.add(pivot, foot)) for foot in ((-13.0, -24.0), (13.0, -24.0))]
        feet += [(np.add(pivot, (-26.0, drop)), np.add(pivot, (20.0, drop))) for drop in (-24.0, -31.0)]
        lines += [("", foot_line) for foot_line in feet]
    samples, owners = [place[::stride, None] for place in drawn.points.values()], [""] * len(drawn.points)
    for name, (start, end) in lines:
        length = float(np.max(np.hypot(*(end - start).T)))
        shares = np.linspace(0, 1, max(2, int(length / _STEP)))[:, None]
        samples.append(start[::stride, None] + shares * (end - start)[::stride, None])
        owners += [name] * len(shares)
    return np.concatenate(samples, axis=1), owners


class _Piston(NamedTuple):
    """A piece that closes a chamber: its line, where its pin is on it, shape (n,), and half its bore. [m]"""

    name: str
    line: MovingFrame
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
    machine: Machine | None, shape: Skeleton, moving: SampledMotion, columns: Mapping[str, Array], block: float = 0.0
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


def _pistons(machine: Machine | None, name: str, shape: Skeleton, moving: SampledMotion) -> list[_Piston]:
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
        blocks.append(Block(name, MovingFrame(middle, piston.line.along), (half, piston.half * scale), is_still=True))
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
        body = rectangle(ChartBox(0.0, -first.half * scale, 1.0, 2 * first.half * scale), "thin", 0.0)
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


def _turn(guide: MovingFrame) -> float:
    x, y = guide.along[0]
    return math.degrees(math.atan2(y, x))
