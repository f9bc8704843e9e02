"""The moving drawing of any linkage: its parts as SVG, one after the other from the ground up."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.moving import Moving
from crankwork.analysis.skeleton import Skeleton
from crankwork.report import drawing_parts as parts
from crankwork.report.drawing_parts import Box, Stage
from crankwork.report.linkage_labels import Label, labels
from crankwork.report.linkage_scene import SLOT, Rail, Scene, Slot, scene

_SIZE = 420.0
_BARREL = 9.0
_DOWN = np.array([1.0, -1.0])


def linkage_drawing(shape: Skeleton, moving: Moving, duration: str, still: int) -> tuple[list[str], Box, float]:
    """Return the parts of the drawing, the box that holds them at all angles, and the scale in pixels per metre."""
    drawn, scale = scene(shape, moving, _SIZE)
    stage = Stage(scale, duration, still)
    paths = [drawn.points[name] for name in shape.traced]
    texts = labels(drawn, [path[::2] for path in paths])
    body = [
        *(parts.path(path * _DOWN) for path in paths),
        *_ground(drawn),
        *_moving(drawn, stage),
        *(_written(one, stage) for one in texts),
    ]
    return body, _box(drawn, texts), scale


def _ground(drawn: Scene) -> Iterator[str]:
    """Draw guides with their centre lines, and the pivots."""
    for rail in drawn.rails:
        ends = [rail.line.place(one)[0] * _DOWN for one in (rail.start - 14, rail.end + 14)]
        yield parts.centre_line(*ends)
        yield parts.rail([(one * _DOWN, other * _DOWN) for one, other in walls(rail)])
    for name in drawn.skeleton.pivots:
        yield parts.ground_pivot(drawn.points[name][0] * _DOWN)


def walls(rail: Rail) -> list[tuple[Array, Array]]:
    """Return the two walls of a fixed guide, the outside on the left of the way as seen from above."""
    upper = [rail.line.place(end, rail.half)[0] for end in (rail.start, rail.end)]
    lower = [rail.line.place(end, -rail.half)[0] for end in (rail.end, rail.start)]
    return [(upper[0], upper[1]), (lower[0], lower[1])]


def _moving(drawn: Scene, stage: Stage) -> Iterator[str]:
    """Draw what moves: rams, links, slots and the blocks in them, the driving link, joints upon all."""
    driver, points = drawn.skeleton.driver, drawn.points
    for block in (one for one in drawn.blocks if one.is_still):
        yield parts.carried(
            stage, f"block {block.name}", block.pose.origin * _DOWN, block.pose.along * _DOWN, block.half
        )
    for bar in sorted(drawn.bars, key=lambda one: one.is_flat):
        if bar.name == driver.name:
            continue
        nodes = [node * _DOWN for node in bar.nodes]
        yield (
            parts.link(stage, bar.name, nodes[0], nodes[1], 3.0) if bar.is_flat else parts.plate(stage, bar.name, nodes)
        )
    for slot in drawn.slots:
        middle, half = slot_middle(slot)
        yield parts.carried(stage, f"slot {slot.carrier}", middle * _DOWN, slot.line.along * _DOWN, (half, SLOT), SLOT)
    for block in (one for one in drawn.blocks if not one.is_still):
        yield parts.carried(
            stage, f"block {block.name}", block.pose.origin * _DOWN, block.pose.along * _DOWN, block.half
        )
    wide = _BARREL if driver.is_cylinder else 5.0
    for bar in (one for one in drawn.bars if one.name == driver.name):
        nodes, flat = [node * _DOWN for node in bar.nodes], bar.is_flat
        yield parts.link(stage, bar.name, nodes[0], nodes[1], wide) if flat else parts.plate(stage, bar.name, nodes)
    for name in drawn.skeleton.letters:
        if name in drawn.skeleton.centres:
            yield parts.centre_of_mass(stage, points[name] * _DOWN)
        elif name in points:
            yield parts.joint(stage, points[name] * _DOWN)


def slot_middle(slot: Slot) -> tuple[Array, float]:
    """Return the middle of a slot, array of shape (n, 2), and half its length."""
    return slot.line.place((slot.start + slot.end) / 2), (slot.end - slot.start) / 2


def _written(one: Label, stage: Stage) -> str:
    place = one.places * _DOWN
    return parts.number(stage, place, int(one.text)) if one.is_number else parts.name(stage, place, one.text)


def corners(drawn: Scene) -> Array:
    """Return places that the parts of a linkage reach, shape (k, 2)."""
    found = [*drawn.points.values(), *(node for bar in drawn.bars for node in bar.nodes)]
    for slot in drawn.slots:
        found += [slot.line.place(end, side) for end in (slot.start, slot.end) for side in (SLOT, -SLOT)]
    for block in drawn.blocks:
        u, v = block.half
        found += [block.pose.place(x, y) for x in (u, -u) for y in (v, -v)]
    for rail in drawn.rails:
        outside = rail.half + parts.HATCH
        found += [
            rail.line.place(end, side) for end in (rail.start - 14, rail.end + 14) for side in (outside, -outside)
        ]
    for name in drawn.skeleton.pivots:
        found += [drawn.points[name] + np.array(reach) * _DOWN for reach in parts.GROUND_REACH]
    return np.vstack(found)


def _box(drawn: Scene, texts: list[Label]) -> Box:
    """Return the corners of a box that nothing leaves at any angle. [px]"""
    found = [corners(drawn), *(one.places + side * one.half for one in texts for side in (1, -1))]
    places = np.vstack(found) * _DOWN
    (left, top), (right, bottom) = places.min(axis=0), places.max(axis=0)
    return Box(float(left), float(top), float(right), float(bottom))
