"""Position plans: a linkage at a dozen crank angles drawn over each other, one of them bold."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.moving import moving
from crankwork.analysis.skeleton import Pose, skeleton
from crankwork.mechanism.mechanism import Mechanism
from crankwork.report import drawing_parts as parts
from crankwork.report.figure_data import figure_title
from crankwork.report.figure_labels import Line, label_points
from crankwork.report.figure_look import DASH_DOT, WIDTH, new_figure, svg
from crankwork.report.linkage_drawing import corners, slot_middle, walls
from crankwork.report.linkage_labels import labels
from crankwork.report.linkage_look import (
    PLAIN,
    POINTS_PER_MM,
    Style,
    figure_look,
    position_sign,
    position_text,
    round_scale,
    scale_text,
)
from crankwork.report.linkage_scene import SLOT, Scene, scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_STEP = 2.0
# steps of the plans of a crank that swings; that of one that turns is the last
_STEPS, _APART, _MOST = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0), 30.0, 12
_MARGIN, _FOOT = 24.0, 50.0
_TALLEST = 560.0
# points whose places have the numbers of the plans; of more nobody could tell which number is whose
_NUMBERED = 6
_THIN = "0.55"
# parts are drawn smaller than on a screen: units of the picture in a point of the paper
_UNITS = 1.5


class _Sheet(NamedTuple):
    """What is drawn on: axes in units of the picture, the parts at all angles, which of them are plans."""

    figure: Figure
    axes: Axes
    drawn: Scene
    plans: list[int]
    main: int


def position_plans(
    mechanism: Mechanism, ends: tuple[float, float] | None = None, main: int = 1, style: Style = PLAIN
) -> bytes:
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
    room = _UNITS * (WIDTH * 72 - 2 * _MARGIN)
    drawn, scale = scene(shape, moved, room)
    paper = round_scale(_least_scale(drawn, scale))
    drawn, _ = scene(shape, moved, room * _UNITS * POINTS_PER_MM * 1e3 / paper / scale)
    with figure_look():
        sheet = _sheet(drawn, plans, main)
        _ground(sheet)
        for plan in plans:
            _plan(sheet, plan, is_main=plan == plans[main])
        _paths(sheet, shape.coupler_points)
        _texts(sheet)
        at: Any = {"size": 9, "transform": sheet.axes.transAxes, "va": "bottom"}
        foot = 17 / 72 / sheet.figure.get_size_inches()[1]
        sheet.axes.text(0.03, foot, scale_text("μ_l", paper, "mm", style.language), **at)
        shown = f"{position_sign(style, f'_{{{main}}}')} = {position_text(float(degrees[main]), style)}"
        sheet.axes.text(0.97, foot, shown, ha="right", **at)
        return svg(sheet.figure, figure_title("position_plans", style.language), style.method)


def _sheet(drawn: Scene, plans: list[int], main: int) -> _Sheet:
    """Return an empty sheet that holds the linkage at all angles, with a foot for the scale."""
    places = corners(drawn)
    (left, bottom), (right, top) = places.min(axis=0) - _MARGIN, places.max(axis=0) + _MARGIN
    spare = max(0.0, _UNITS * WIDTH * 72 - (right - left)) / 2
    left, right, bottom = left - spare, right + spare, bottom - _FOOT
    figure = new_figure((top - bottom) / 72 / _UNITS, (right - left) / 72 / _UNITS)
    axes = figure.add_axes((0, 0, 1, 1), xlim=(left, right), ylim=(bottom, top))
    axes.set_axis_off()
    return _Sheet(figure, axes, drawn, plans, main)


def _least_scale(drawn: Scene, scale: float) -> float:
    """Return how many millimetres of the linkage a millimetre of paper must take at least."""
    width, height = np.ptp(corners(drawn), axis=0)
    fit = min((WIDTH * 72 - 2 * _MARGIN) / width, _TALLEST / height)
    return float(POINTS_PER_MM * 1e3 / (scale * fit))


def _ground(sheet: _Sheet) -> None:
    """Draw guides and pivots, hatched."""
    for rail in sheet.drawn.rails:
        ends = np.array([rail.line.place(one)[0] for one in (rail.start - 14, rail.end + 14)])
        sheet.axes.plot(*ends.T, color="black", linewidth=0.6, linestyle=DASH_DOT)
        for wall in walls(rail):
            _hatched(sheet.axes, *wall)
    for name in sheet.drawn.skeleton.pivots:
        x, y = sheet.drawn.points[name][0]
        sheet.axes.fill([x, x - 13, x + 13], [y, y - 24, y - 24], facecolor="white", edgecolor="black", linewidth=1.0)
        _hatched(sheet.axes, np.array([x + 20, y - 24]), np.array([x - 20, y - 24]))


def _hatched(axes: Axes, start: Array, end: Array) -> None:
    """Draw a wall, hatched on the left of the way from start to end."""
    length = float(np.hypot(*(end - start)))
    ahead = (end - start) / length
    slant = parts.HATCH * (np.array([-ahead[1], ahead[0]]) - ahead)
    axes.plot(*np.array([start, end]).T, color="black", linewidth=1.0)
    feet = start + np.arange(parts.HATCH, length + 0.1, parts.HATCH)[:, None] * ahead
    strokes = np.stack([feet, feet + slant, np.full_like(feet, np.nan)], axis=1).reshape(-1, 2)
    axes.plot(*strokes.T, color="black", linewidth=0.5)


def _plan(sheet: _Sheet, at: int, *, is_main: bool) -> None:
    """Draw the linkage at one crank angle."""
    color, width, order = ("black", 2.0, 6) if is_main else (_THIN, 0.5, 2)
    for bar in sheet.drawn.bars:
        nodes = np.array([node[at] for node in (*bar.nodes, bar.nodes[0])])
        sheet.axes.plot(*nodes.T, color=color, linewidth=width, zorder=order, solid_joinstyle="round")
    for slot in sheet.drawn.slots:
        middle, half = slot_middle(slot)
        if is_main:
            _rectangle(sheet.axes, Pose(middle, slot.line.along), (half, SLOT), at, "white")
        else:
            ends = np.array([slot.line.place(end)[at] for end in (slot.start, slot.end)])
            sheet.axes.plot(*ends.T, color=color, linewidth=width, zorder=order)
    for block in sheet.drawn.blocks:
        if is_main:
            _rectangle(sheet.axes, block.pose, block.half, at, "0.85")
    joints = np.array([place[at] for name, place in sheet.drawn.points.items() if name in sheet.drawn.skeleton.letters])
    look: Any = (
        {"markersize": 5.0, "markerfacecolor": "white"} if is_main else {"markersize": 1.4, "markerfacecolor": _THIN}
    )
    sheet.axes.plot(*joints.T, "o", color=color, markeredgewidth=0.9, zorder=order + 2, **look)


def _rectangle(axes: Axes, pose: Pose, half: tuple[float, float], at: int, fill: str) -> None:
    u, v = half
    around = np.array([pose.place(x, y)[at] for x, y in ((u, v), (-u, v), (-u, -v), (u, -v))])
    axes.fill(*around.T, facecolor=fill, edgecolor="black", linewidth=1.0, zorder=7)


def _paths(sheet: _Sheet, names: Sequence[str]) -> None:
    """Draw the paths of the crank pin and of the coupler points."""
    for name in (*([sheet.drawn.skeleton.pin] if sheet.drawn.skeleton.pin else []), *names):
        sheet.axes.plot(*sheet.drawn.points[name].T, color="black", linewidth=0.6, linestyle=DASH_DOT, zorder=3)


def _texts(sheet: _Sheet) -> None:
    """Write names of points at the bold plan, and the numbers of the plans at points that show the motion."""
    drawn, plans = sheet.drawn, sheet.plans
    at = plans[sheet.main]
    named = [one for one in labels(_at(drawn, at), every=1) if not one.is_number]
    lines: list[Line] = []
    for one in named:
        x, y = one.places[0]
        sheet.axes.text(x, y, one.text, zorder=12, parse_math=False, style="italic", size=9, ha="center", va="center")
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
    label_points(sheet.axes, points, *lines)


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
