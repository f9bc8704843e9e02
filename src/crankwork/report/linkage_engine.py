"""The moving drawing of a crank gear: cranks, rods and pistons in cylinders that hang on one crank pin."""

from __future__ import annotations

import math
import string
from typing import NamedTuple

import numpy as np

from crankwork.analysis.moving import Moving
from crankwork.machine import Cylinder
from crankwork.mechanism.dyads import RRP
from crankwork.mechanism.mechanism import Crank, Mechanism
from crankwork.report import drawing_parts as parts
from crankwork.report.drawing_parts import Box, Stage

_SIZE = 420.0


class Gear(NamedTuple):
    """A crank gear: mechanism, its rods, cylinder if known, whether gas closes the cylinder."""

    mechanism: Mechanism
    rods: tuple[RRP, ...]
    cylinder: Cylinder | None
    has_gas: bool


def crank_gear(mechanism: Mechanism, cylinder: Cylinder | None = None, *, has_gas: bool = False) -> Gear | None:
    """Return the crank gear that a mechanism is, or None if it is another linkage."""
    rods = tuple(one for one in mechanism.dyads if isinstance(one, RRP))
    is_gear = len(rods) == len(mechanism.dyads) and not mechanism.points
    is_gear = is_gear and isinstance(mechanism.driver, Crank)
    if is_gear and all(one.joint == mechanism.crank.pin and not one.guide_link for one in rods):
        return Gear(mechanism, rods, cylinder, has_gas)
    return None


def engine_drawing(gear: Gear, moving: Moving, duration: str, still: int) -> tuple[list[str], Box, float]:
    """Return the parts of the drawing, the box that holds them at all angles, and the scale in pixels per metre."""
    stage = Stage(_scale(moving, gear), duration, still)
    sliders = [_slider(gear, dyad, moving, stage) for dyad in gear.rods]
    body = [
        *_fixed(gear, moving, stage, sliders),
        *_links(gear, moving, stage, sliders),
        *_names(gear, moving, stage, sliders),
    ]
    return body, _reach(gear, moving, stage, sliders), stage.scale


class _Slider(NamedTuple):
    """A block in its guide: half sizes of the block, ends of the guide along it [px], and whether a head closes it."""

    dyad: RRP
    half_width: float
    half_height: float
    start: float
    end: float
    is_closed: bool


def _scale(moving: Moving, gear: Gear) -> float:
    """Return how many pixels a metre takes."""
    bore = gear.cylinder.bore if gear.cylinder else 0.0
    places = np.vstack([gear.mechanism.crank.pivot, *(point.place for point in moving.points.values())])
    return float(_SIZE / max(*np.ptp(places, axis=0), 1.5 * bore))


def _slider(gear: Gear, dyad: RRP, moving: Moving, stage: Stage) -> _Slider:
    """Return block and guide of a slider; the guide of a cylinder ends at the head, the clearance above the piston."""
    along = moving.sliders[dyad.piece]
    low, high = float(np.min(along)) * stage.scale, float(np.max(along)) * stage.scale
    stroke, cylinder = high - low, gear.cylinder
    half_width = max(stage.scale * cylinder.bore / 2 if cylinder else 0.4 * stroke, 24.0)
    half_height = max(min(0.6 * half_width, 0.45 * stroke), 14.0)
    gap = 0.2 * half_height
    if cylinder and cylinder.clearance_volume is not None:
        gap = stage.scale * cylinder.clearance_volume / (math.pi / 4 * cylinder.bore**2)
    elif cylinder and cylinder.compression_ratio is not None:
        gap = stroke / (cylinder.compression_ratio - 1)
    end = high + half_height + min(max(gap, 5.0), stroke)
    return _Slider(dyad, half_width, half_height, low - 0.4 * half_height, end, gear.has_gas)


def _reach(gear: Gear, moving: Moving, stage: Stage, sliders: list[_Slider]) -> Box:
    """Return the corners of a box that nothing leaves at any angle. [px]"""
    pivot = stage.fixed(gear.mechanism.crank.pivot)
    reach = [pivot + np.array(parts.GROUND_REACH)]
    reach += [stage.points(point) for point in moving.points.values()]
    for one in sliders:
        around = one.half_width + parts.HATCH
        walls = [(one.start - 2 * one.half_height, around), (one.end + parts.HATCH, around)]
        reach += [parts.on_guide(one.dyad, stage, s, side * t) for s, t in walls for side in (1, -1)]
    corners = np.vstack(reach)
    (left, top), (right, bottom) = corners.min(axis=0), corners.max(axis=0)
    return Box(left, top, right, bottom)


def _fixed(gear: Gear, moving: Moving, stage: Stage, sliders: list[_Slider]) -> list[str]:
    """Draw what stands still: centre lines, the path of the crank pin, guides and the pivot."""
    crank = gear.mechanism.crank
    pivot, arm = stage.fixed(crank.pivot), crank.radius * stage.scale + 16
    drawn = [
        parts.centre_line(parts.moved(pivot, -right, -down), parts.moved(pivot, right, down))
        for right, down in ((arm, 0.0), (0.0, arm))
        if not any(parts.is_on_guide(one.dyad, crank.pivot, (right, -down)) for one in sliders)
    ]
    drawn.append(parts.path(stage.points(moving.points[crank.pin])))
    for one in sliders:
        foot = parts.foot_on_guide(one.dyad, stage, crank.pivot)
        ends = (min(foot, one.start) - 16, max(foot, one.end) + 20)
        drawn.append(parts.centre_line(*(parts.on_guide(one.dyad, stage, end, 0.0) for end in ends)))
        walls = (one.start, one.end, one.half_width + 1.5)
        drawn.append(parts.guide(one.dyad, stage, *walls, is_closed=one.is_closed))
    return [*drawn, parts.ground_pivot(pivot)]


def _links(gear: Gear, moving: Moving, stage: Stage, sliders: list[_Slider]) -> list[str]:
    """Draw what moves: blocks, links between their points, and joints upon them."""
    crank = gear.mechanism.crank
    at = {name: stage.points(point) for name, point in moving.points.items()}
    pivot = np.broadcast_to(stage.fixed(crank.pivot), at[crank.pin].shape)
    drawn = [parts.block(one.dyad, stage, at[one.dyad.slider], one.half_width, one.half_height) for one in sliders]
    drawn += [parts.link(stage, one.link, at[one.joint], at[one.slider], 3.0) for one in reversed(gear.rods)]
    drawn.append(parts.link(stage, crank.link, pivot, at[crank.pin], 5.0))
    return [*drawn, *(parts.joint(stage, place) for place in (pivot, *at.values()))]


def _names(gear: Gear, moving: Moving, stage: Stage, sliders: list[_Slider]) -> list[str]:
    """Write letters at the points and numbers at the links: 0 the frame, 1 the crank, then dyad by dyad."""
    crank = gear.mechanism.crank
    at = {name: stage.points(point) for name, point in moving.points.items()}
    pivot = np.broadcast_to(stage.fixed(crank.pivot), at[crank.pin].shape)
    letters = iter("ABCDEFGHIJKLMNPQRSTUVWXYZ" + string.ascii_lowercase)
    outward = parts.direction(pivot, at[crank.pin])
    drawn = [
        parts.name(stage, parts.moved(pivot, -22, 20), "O"),
        parts.number(stage, parts.moved(pivot, 32, 24), 0),
        parts.name(stage, at[crank.pin] + 17 * outward, next(letters)),
        parts.number(stage, (pivot + at[crank.pin]) / 2 + 13 * parts.normal(outward), 1),
    ]
    for count, one in enumerate(sliders):
        joint, pin = at[one.dyad.joint], at[one.dyad.slider]
        side = parts.on_guide(one.dyad, stage, 0.0, 1.0) - parts.on_guide(one.dyad, stage, 0.0, 0.0)
        along = parts.direction(joint, pin)
        drawn.append(parts.number(stage, (joint + pin) / 2 + 13 * parts.normal(along), 2 + 2 * count))
        drawn.append(parts.name(stage, pin - 14 * side, next(letters)))
        drawn.append(parts.number(stage, pin + max(14.0, one.half_width - 12) * side, 3 + 2 * count))
    return drawn
