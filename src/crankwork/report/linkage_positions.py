"""Position plans: a linkage at a dozen crank angles drawn over each other, one of them bold."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.moving import moving
from crankwork.analysis.skeleton import Pose, skeleton
from crankwork.mechanism.mechanism import Mechanism
from crankwork.report import drawing_parts as parts
from crankwork.report.figure_data import figure_title
from crankwork.report.linkage_drawing import corners, slot_middle, walls
from crankwork.report.linkage_labels import labels
from crankwork.report.linkage_look import (
    PLAIN,
    POINTS_PER_MM,
    Style,
    position_sign,
    position_text,
    round_scale,
    scale_text,
)
from crankwork.report.linkage_scene import SLOT, Scene, scene
from crankwork.show.chart import WIDTH, Box, Graph, sign
from crankwork.show.labels import Line, label_points
from crankwork.show.paper import BLACK, Paper, plain
from crankwork.show.scene import DASH_DOT, SOLID, Drawing
from crankwork.show.scene import Style as Dashes

_STEP = 2.0
# steps of the plans of a crank that swings; that of one that turns is the last
_STEPS, _APART, _MOST = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0), 30.0, 12
_MARGIN, _FOOT = 24.0, 50.0
_TALLEST = 560.0
# points whose places have the numbers of the plans; of more nobody could tell which number is whose
_NUMBERED = 6
_THIN, _BLOCK, WHITE = "#8c8c8c", "#d9d9d9", "#ffffff"
# parts are drawn smaller than on a screen: units of the picture in a point of the paper
_UNITS = 1.5


class _Sheet(NamedTuple):
    """What is drawn on: a graph in units of the picture, the parts at all angles, which of them are plans."""

    graph: Graph
    drawn: Scene
    plans: list[int]
    main: int


def position_plans(
    mechanism: Mechanism, ends: tuple[float, float] | None = None, main: int = 1, style: Style = PLAIN
) -> Drawing:
    """Return the position plans of a linkage over each other, numbered from 0.

    `ends`: crank angles between which a crank swings that does not turn fully [deg]; `main`: the plan that is drawn
    bold, with names of points.
    """
    shape = skeleton(mechanism, style.links)
    first, last = ends or (0.0, mechanism.period)
    step = _APART if ends is None else next(one for one in _STEPS if (last - first) / one <= _MOST or one == _APART)
    degrees = step * np.arange(math.ceil(first / step), math.ceil(last / step))
    if not degrees.size:
        degrees = np.array([(first + last) / 2])
    main = min(main, degrees.size - 1)
    moved = moving(mechanism, np.union1d(np.append(np.arange(first, last, _STEP), last), degrees))
    plans = [int(np.argmin(np.abs(moved.degrees - one))) for one in degrees]
    room = _UNITS * (WIDTH - 2 * _MARGIN)
    drawn, scale = scene(shape, moved, room)
    paper = round_scale(_least_scale(drawn, scale))
    drawn, _ = scene(shape, moved, room * _UNITS * POINTS_PER_MM * 1e3 / paper / scale)
    sheet = _sheet(drawn, plans, main, style)
    _ground(sheet)
    for plan in plans:
        if plan != plans[main]:
            _plan(sheet, plan, is_main=False)
    _paths(sheet, shape.coupler_points)
    _plan(sheet, plans[main], is_main=True)
    _texts(sheet)
    foot, hand = sheet.graph.box.height - 20, sheet.graph.paper
    hand.text(0.03 * hand.width, foot, scale_text("μ_l", paper, "mm", style.language))
    shown = f"{position_sign(style, f'_{main}')} = {position_text(float(degrees[main]), style)}"
    hand.text(0.97 * hand.width, foot, shown, anchor="end")
    sign(hand, style.method)
    return hand.drawing(figure_title("position_plans", style.language), style.language)


def _sheet(drawn: Scene, plans: list[int], main: int, style: Style) -> _Sheet:
    """Return an empty sheet that holds the linkage at all angles, with a foot for the scale."""
    places = corners(drawn)
    (left, bottom), (right, top) = places.min(axis=0) - _MARGIN, places.max(axis=0) + _MARGIN
    spare = max(0.0, _UNITS * WIDTH - (right - left)) / 2
    left, right, bottom = left - spare, right + spare, bottom - _FOOT
    box = Box(0.0, 0.0, (right - left) / _UNITS, (top - bottom) / _UNITS)
    paper = Paper(box.width, box.height)
    return _Sheet(Graph(paper, box, (left, right), (bottom, top), style.language), drawn, plans, main)


def _least_scale(drawn: Scene, scale: float) -> float:
    """Return how many millimetres of the linkage a millimetre of paper must take at least."""
    width, height = np.ptp(corners(drawn), axis=0)
    fit = min((WIDTH - 2 * _MARGIN) / width, _TALLEST / height)
    return float(POINTS_PER_MM * 1e3 / (scale * fit))


def _ground(sheet: _Sheet) -> None:
    """Draw guides and pivots, hatched."""
    for rail in sheet.drawn.rails:
        ends = np.array([rail.line.place(one)[0] for one in (rail.start - 14, rail.end + 14)])
        _line_of(sheet.graph, ends, width=0.6, style=DASH_DOT)
        for wall in walls(rail):
            _hatched(sheet.graph, *wall)
    for name in sheet.drawn.skeleton.pivots:
        x, y = sheet.drawn.points[name][0]
        _area_of(sheet.graph, np.array([[x, y], [x - 13, y - 24], [x + 13, y - 24]]), WHITE)
        _hatched(sheet.graph, np.array([x + 20, y - 24]), np.array([x - 20, y - 24]))


def _line_of(graph: Graph, points: Array, *, width: float, style: Dashes = SOLID, colour: str = BLACK) -> None:
    graph.paper.line(graph.across(points[:, 0]), graph.down(points[:, 1]), width=width, style=style, colour=colour)


def _area_of(graph: Graph, points: Array, fill: str) -> None:
    graph.paper.area(graph.across(points[:, 0]), graph.down(points[:, 1]), fill=fill, width=1.0)


def _hatched(graph: Graph, start: Array, end: Array) -> None:
    """Draw a wall, hatched on the left of the way from start to end."""
    length = float(np.hypot(*(end - start)))
    ahead = (end - start) / length
    slant = parts.HATCH * (np.array([-ahead[1], ahead[0]]) - ahead)
    _line_of(graph, np.array([start, end]), width=1.0)
    feet = start + np.arange(parts.HATCH, length + 0.1, parts.HATCH)[:, None] * ahead
    ends = [side(one[:, axis]) for one in (feet, feet + slant) for axis, side in ((0, graph.across), (1, graph.down))]
    graph.paper.segments(np.column_stack(ends), width=0.5)


def _plan(sheet: _Sheet, at: int, *, is_main: bool) -> None:
    """Draw the linkage at one crank angle."""
    colour, width = (BLACK, 2.0) if is_main else (_THIN, 0.5)
    graph = sheet.graph
    for bar in sheet.drawn.bars:
        nodes = np.array([node[at] for node in (*bar.nodes, bar.nodes[0])])
        _line_of(graph, nodes, width=width, colour=colour)
    for slot in sheet.drawn.slots:
        middle, half = slot_middle(slot)
        if is_main:
            _rectangle(graph, Pose(middle, slot.line.along), (half, SLOT), at, WHITE)
        else:
            ends = np.array([slot.line.place(end)[at] for end in (slot.start, slot.end)])
            _line_of(graph, ends, width=width, colour=colour)
    for block in sheet.drawn.blocks:
        if is_main:
            _rectangle(graph, block.pose, block.half, at, _BLOCK)
    joints = [place[at] for name, place in sheet.drawn.points.items() if name in sheet.drawn.skeleton.letters]
    for x, y in joints:
        place = graph.point(float(x), float(y))
        if is_main:
            graph.paper.dot(*place, 2.5, fill=WHITE, width=0.9)
        else:
            graph.paper.dot(*place, 0.9, fill=_THIN)


def _rectangle(graph: Graph, pose: Pose, half: tuple[float, float], at: int, fill: str) -> None:
    u, v = half
    _area_of(graph, np.array([pose.place(x, y)[at] for x, y in ((u, v), (-u, v), (-u, -v), (u, -v))]), fill)


def _paths(sheet: _Sheet, names: Sequence[str]) -> None:
    """Draw the paths of the crank pin and of the coupler points."""
    for name in (*([sheet.drawn.skeleton.pin] if sheet.drawn.skeleton.pin else []), *names):
        _line_of(sheet.graph, sheet.drawn.points[name], width=0.6, style=DASH_DOT)


def _texts(sheet: _Sheet) -> None:
    """Write names of points at the bold plan, and the numbers of the plans at points that show the motion."""
    drawn, plans = sheet.drawn, sheet.plans
    at = plans[sheet.main]
    named = [one for one in labels(_at(drawn, at), every=1) if not one.is_number]
    lines: list[Line] = []
    for one in named:
        x, y = one.places[0]
        across, down = sheet.graph.point(float(x), float(y))
        sheet.graph.paper.text(across, down + 3, _slanted(one.text), anchor="middle")
        lines += [([x - one.half[0], x + one.half[0]], [y + side, y + side]) for side in (-3.0, 3.0)]
    for bar in drawn.bars:
        nodes = np.array([node[at] for node in (*bar.nodes, bar.nodes[0])])
        lines.append((nodes[:, 0], nodes[:, 1]))
    lines += [_line(*wall) for rail in drawn.rails for wall in walls(rail)]
    lines += [_line(*wall) for rail in drawn.rails for wall in walls(rail._replace(half=rail.half + 5))]
    numbered = [drawn.skeleton.driven] if drawn.skeleton.driven else []
    numbered += [one.points[0] for one in drawn.skeleton.members if one.guide and not one.guide.link and one.points]
    numbered += drawn.skeleton.coupler_points[: max(_NUMBERED - len(numbered), 0)]
    points = [
        (str(count), float(drawn.points[name][plan, 0]), float(drawn.points[name][plan, 1]))
        for name in dict.fromkeys(numbered)
        for count, plan in enumerate(plans)
    ]
    label_points(sheet.graph, points, *lines)


def _slanted(name: str) -> str:
    """Return the name of a point in slanted letters, where none of them would mark something."""
    return f"${name}$" if name.isalnum() else plain(name)


def _line(start: Array, end: Array) -> Line:
    return [start[0], end[0]], [start[1], end[1]]


def _at(drawn: Scene, at: int) -> Scene:
    """Return the parts at one crank angle."""
    one = slice(at, at + 1)

    def pose(whole: Pose) -> Pose:
        return Pose(whole.origin[one], whole.along[one])

    return drawn._replace(
        points={name: place[one] for name, place in drawn.points.items()},
        bars=[bar._replace(nodes=tuple(node[one] for node in bar.nodes)) for bar in drawn.bars],
        slots=[slot._replace(line=pose(slot.line)) for slot in drawn.slots],
        blocks=[block._replace(pose=pose(block.pose)) for block in drawn.blocks],
        rails=[rail._replace(line=pose(rail.line)) for rail in drawn.rails],
    )
