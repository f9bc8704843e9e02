"""Position plans on a sheet: the mechanism at twelve crank angles over each other, one of them bold."""

from __future__ import annotations

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.moving import Moving
from crankwork.analysis.skeleton import Pose, Skeleton
from crankwork.note.sheets.graph import Axis, Graph, heading
from crankwork.note.sheets.placing import Named, lines_of, names_beside
from crankwork.note.sheets.words import Words
from crankwork.report.drawing_parts import HATCH
from crankwork.report.linkage_drawing import corners, slot_middle, walls
from crankwork.report.linkage_look import round_scale
from crankwork.report.linkage_scene import SLOT, Scene, scene
from crankwork.show.scene import SMALL, TEXT, Box, Circle, Item, LineKind, Polyline, line, printable

# millimetres of the sheet in a unit in which blocks and pivots are sized
_UNIT = 0.3
_HEAD = 15.0


def position_plans(shape: Skeleton, moving: Moving, plans: list[int], main: int, box: Box, words: Words) -> Graph:
    """Return the position plans.

    `plans`: which crank angles are drawn, numbered from 0; `main`: the plan that is bold, with names of points.
    """
    room = box.inset(6.0, 6.0, 6.0, _HEAD + 4.0)
    drawn, scale = _to_scale(shape, moving, room)
    places = corners(drawn) * _UNIT
    low, high = places.min(axis=0), places.max(axis=0)
    middle = np.array([room.left + room.width / 2, room.bottom + room.height / 2]) - (low + high) / 2
    items = [*_ground(drawn, middle)]
    for at in plans:
        if at != plans[main]:
            items += _plan(drawn, at, middle, is_main=False)
    for name in shape.traced:
        items.append(Polyline(_placed(drawn.points[name], middle), "axis", name=f"path.{name}"))
    items += _plan(drawn, plans[main], middle, is_main=True)
    items += _names(drawn, plans, main, middle, (items, room))
    items += heading(words.say("position_plans"), [words.scale("l", scale, "m")], [], box)
    x = Axis("x", "m", scale, float(middle[0]), room.left, room.right)
    y = Axis("y", "m", scale, float(middle[1]), room.bottom, room.top)
    return Graph("position_plans", box, x, y, tuple(items))


def _to_scale(shape: Skeleton, moving: Moving, room: Box) -> tuple[Scene, float]:
    """Return the parts to the largest round scale at which they fit into a room, and the scale. [m/mm]"""
    drawn, units = scene(shape, moving, room.width / _UNIT)
    metres = room.width / _UNIT / units
    # blocks keep their size, so that a smaller drawing is not smaller in proportion
    for _ in range(4):
        width, height = np.ptp(corners(drawn), axis=0) * _UNIT
        fit = min(room.width / width, room.height / height)
        wanted = round_scale(1.0 / (units * _UNIT * fit))
        if fit >= 1 and abs(wanted * units * _UNIT - 1) < 1e-9:
            break
        drawn, units = scene(shape, moving, metres / (wanted * _UNIT))
    return drawn, 1.0 / (units * _UNIT)


def _placed(places: Array, middle: Array) -> Array:
    return np.asarray(middle + places * _UNIT)


def _ground(drawn: Scene, middle: Array) -> list[Item]:
    """Return guides and pivots, hatched."""
    items: list[Item] = []
    for rail in drawn.rails:
        ends = [_placed(rail.line.place(one)[0], middle) for one in (rail.start - 14, rail.end + 14)]
        items.append(line(ends[0], ends[1], "axis"))
        for start, end in walls(rail):
            items += _hatched(_placed(start, middle), _placed(end, middle))
    for name in drawn.skeleton.pivots:
        at = _placed(drawn.points[name][0], middle)
        triangle = at + np.array([[0.0, 0.0], [-13.0, -24.0], [13.0, -24.0]]) * _UNIT
        items.append(Polyline(triangle, "medium", closed=True, fill=1.0))
        items += _hatched(at + np.array([20.0, -24.0]) * _UNIT, at + np.array([-20.0, -24.0]) * _UNIT)
    return items


def _hatched(start: Array, end: Array) -> list[Item]:
    """Return a wall, hatched on the left of the way from start to end."""
    length = float(np.hypot(*(end - start)))
    ahead, step = (end - start) / length, HATCH * _UNIT
    slant = step * (np.array([-ahead[1], ahead[0]]) - ahead)
    feet = start + np.arange(step, length + 0.03, step)[:, None] * ahead
    return [line(start, end, "medium"), *(line(foot, foot + slant) for foot in feet)]


def _plan(drawn: Scene, at: int, middle: Array, *, is_main: bool) -> list[Item]:
    """Return the mechanism at one crank angle."""
    kind: LineKind = "thick" if is_main else "thin"
    items: list[Item] = []
    for bar in drawn.bars:
        nodes = np.array([_placed(node[at], middle) for node in bar.nodes])
        items.append(Polyline(nodes, kind, closed=not bar.is_flat))
    for slot in drawn.slots:
        whole, half = slot_middle(slot)
        if is_main:
            items.append(_rectangle(Pose(whole, slot.line.along), (half, SLOT), at, middle))
        else:
            ends = [_placed(slot.line.place(end)[at], middle) for end in (slot.start, slot.end)]
            items.append(line(ends[0], ends[1], kind))
    if is_main:
        items += [_rectangle(block.pose, block.half, at, middle, 0.85) for block in drawn.blocks]
    radius = 1.3 if is_main else 0.5
    for name, place in drawn.points.items():
        if name in drawn.skeleton.letters:
            x, y = _placed(place[at], middle)
            is_centre = name in drawn.skeleton.centres
            fill = 0.0 if is_centre or not is_main else 1.0
            items.append(Circle((float(x), float(y)), 0.6 * radius if is_centre else radius, "thin", fill))
    return items


def _rectangle(pose: Pose, half: tuple[float, float], at: int, middle: Array, fill: float = 1.0) -> Item:
    u, v = half
    around = np.array([_placed(pose.place(x, y)[at], middle) for x, y in ((u, v), (-u, v), (-u, -v), (u, -v))])
    return Polyline(around, "medium", closed=True, fill=fill)


def _names(drawn: Scene, plans: list[int], main: int, middle: Array, clear: tuple[list[Item], Box]) -> list[Item]:
    """Return letters at the bold plan, and numbers of the plans at points that show the motion."""
    items, room = clear
    shape = drawn.skeleton
    lines = lines_of(items)
    letters: dict[str, Named] = {}
    for name, letter in shape.letters.items():
        if name in drawn.points:
            x, y = _placed(drawn.points[name][plans[main]], middle)
            letters.setdefault(letter, Named(printable(letter), (float(x), float(y))))
    named = names_beside(list(letters.values()), lines, room, height=TEXT, dot=0.0)
    shown = [*([shape.driven] if shape.driven else []), *shape.traced]
    shown += [one.points[0] for one in shape.members if one.guide and not one.guide.link and one.points]
    points = []
    for name in dict.fromkeys(shown):
        for count, plan in enumerate(plans):
            x, y = _placed(drawn.points[name][plan], middle)
            points.append(Named(str(count), (float(x), float(y))))
    return [*named, *names_beside(points, [*lines, *lines_of(named)], room, height=SMALL, dot=0.0)]
