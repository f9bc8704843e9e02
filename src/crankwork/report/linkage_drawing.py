"""How a linkage is drawn: its ground, and its links as parts that move."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import count

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.moving import Moving
from crankwork.analysis.skeleton import Pose, Skeleton
from crankwork.machine import Machine
from crankwork.report.arrows import forces_in_joints, with_forces
from crankwork.report.linkage_gas import gas, spaces, with_pistons
from crankwork.report.linkage_labels import labels
from crankwork.report.linkage_scene import RAM, SLOT, Bar, Block, Rail, Scene, Slot, scene
from crankwork.report.sketch import Sketch
from crankwork.show.moving import Part, part
from crankwork.show.scene import Circle, Item, Pen, Polyline, Text, line, literal

# millimetres of paper in a unit in which blocks and pivots are sized; distance of hatches in such units
UNIT, HATCH = 0.3, 8.0
_SIZE = 420.0
_GROUND_REACH = ((-34.0, 0.0), (38.0, -36.0))
_LINK, _DRIVER, _BARREL = Pen(0.9), Pen(1.5), Pen(2.7)
_LETTERS = 3.2


def linkage_sketch(
    shape: Skeleton,
    moving: Moving,
    machine: Machine | None = None,
    columns: Mapping[str, Array] | None = None,
    forces: Mapping[str, str] | None = None,
    frame: int | None = None,
) -> Sketch:
    """Return a linkage as it is drawn over all its angles; `frame`: the only one that is looked at.

    `columns`: gas of the chambers of a machine, and forces in joints where they are to be drawn, by key, shape (n,);
    `forces`: what is written at them, by joint.
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
    sketch = Sketch([*items, *walls, *ground(drawn)], parts, low, high, scale * UNIT)
    points = {name: point * UNIT for name, point in drawn.points.items()}
    return with_forces(sketch, forces_in_joints(columns or {}, points, forces or {}), frame)


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
        yield _carried(f"slot.{slot.carrier}.{index}", Pose(middle, slot.line.along), _slotted(half), 1.0)
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


def _carried(name: str, pose: Pose, outline: Array, fill: float) -> Part:
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
