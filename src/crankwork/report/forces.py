"""The figures of forces: along the cylinder axis, on rod and crankpin, and the force plans of groups of links."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.constructions import force_laws
from crankwork.analysis.force_plans import ForcePolygon, PolygonForce, force_plans
from crankwork.analysis.skeleton import skeleton
from crankwork.analysis.vector_polygons import Kind
from crankwork.locale import texts, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.display import symbol
from crankwork.report.gas import HEIGHT, banded_sheet, strokes
from crankwork.report.look import (
    Drawn,
    displayed_values,
    draw_scale,
    figure_title,
    key_of_links,
    math_symbol,
    position_sign,
    position_text,
)
from crankwork.report.plans import vector_mark
from crankwork.show.canvas import GREY, Canvas, plain
from crankwork.show.chart import TOP, ChartBox, Graph, Row, limits, over_cycle, round_ticks, sheet, write_remark
from crankwork.show.chart_layout import FINE, current_layout, is_narrow, points_per_mm, round_scale, scaled_height
from crankwork.show.label_placement import label_marks
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, STYLES, Drawing, Style

_HEAD, _MARGIN, _LIST, _ROW, _FOOT = 16.0, 22.0, 150.0, 13.5, 34.0
# the tallest plan, and all of them together [pt]
_HIGHEST, _WHOLE = 230.0, 560.0
# a paper wider than this has two plans side by side [pt]
_TWO = 560.0
# how far apart forces are drawn that coincide, and what does: nothing else is set aside, so that plans close [pt]
_LANE, _NEAR, _LANES = 6.0, 0.8, (0, 1, -1, 2, -2, 3, -3)
_LOAD, _REACTION, _LEAST = 0.45, 0.9, 12.0
# a group of fewer forces has no plan, only two that are equal
_FEWEST, _MOST = 3, 4


class Line(NamedTuple):
    """A curve: key of its quantity, values [display unit], line style."""

    key: str
    values: Array
    style: Style = SOLID


def piston_forces(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the parts of the force on the piston and their sum; a part that is the whole sum stands for it."""
    styles = {"gas_force": DASHED, "inertia_force": DASH_DOT, "weight_force": DOTTED}
    parts = {key: style for key, style in styles.items() if key in engine.columns}
    alone = len(parts) == 1
    return forces_over_cycle(engine, dict.fromkeys(parts, SOLID) if alone else {**parts, "piston_force": SOLID})


def forces_over_cycle(engine: Drawn, styles: Mapping[str, Style]) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return columns of forces over the cycle, each in its style."""
    curves = [Line(key, engine.values(key), style) for key, style in styles.items()]
    rows = [Row(engine.named(key), style) for key, style in styles.items()]
    title = f"{', '.join(engine.symbol(key) for key in styles)}, {engine.unit('piston_force')}"
    return curves_over_cycle(engine, curves, rows, title)


def curves_over_cycle(
    engine: Drawn, curves: Sequence[Line], rows: Sequence[Row], title: str
) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return curves of one cylinder with their legend, and the strokes above them."""
    paper, box = banded_sheet(engine, HEIGHT, rows)
    graph = over_cycle(paper, box, limits(*(curve.values for curve in curves)), engine.cycle, engine.language)
    for curve in curves:
        graph.curve(curve.key, engine.degrees, curve.values, curve.style)
    strokes(engine, graph)
    graph.x_title(engine.title("crank_angle"))
    graph.y_title(title)
    return paper, {curves[0].key: graph}


def force_law(machine: Drawn) -> Drawing:
    """Return the forces of processes over the displacement of the pieces that they act on."""
    key, laws = "process_force", force_laws(machine.results)
    shown = {
        name: (machine.shown("slider_displacement", places), machine.shown(key, values))
        for name, (places, values) in laws.items()
    }
    rows = [Row(plain(name), STYLES[k % 4]) for k, name in enumerate(shown)] if len(shown) > 1 else []
    paper, box = sheet(HEIGHT, rows)
    across, up = (limits(*values, is_place=not k) for k, values in enumerate(zip(*shown.values(), strict=True)))
    graph = Graph(paper, box, across, up, machine.language)
    graph.frame(round_ticks(*across), graph.up_ticks)
    for k, (name, law) in enumerate(shown.items()):
        graph.curve(f"{key}.{name}", *law, STYLES[k % 4])
    machine.name_axes(graph, "slider_displacement", key)
    return paper.drawing(figure_title(key, machine.language), machine.language)


def _plans(machine: Drawn) -> list[ForcePolygon]:
    reached = machine.reached
    plans = force_plans(machine.results, float(reached.degrees[reached.row]))
    return [plan for plan in plans if len(plan.forces) >= _FEWEST][:_MOST]


def has_force_plans(machine: Drawn) -> bool:
    """Return whether a group of links has three forces at the angle that is worked."""
    return bool(_plans(machine))


def plans_of_forces(machine: Drawn) -> Drawing:
    """Return the force plans at the angle that is worked."""
    style, reached, plans = machine.style, machine.reached, _plans(machine)
    shape = skeleton(machine.results.machine.mechanism, style.links)
    numbers, degrees = {member.name: member.number for member in shape.members}, float(reached.degrees[reached.row])
    title, spans = figure_title("force_plans", style.language), [np.ptp(_ends(plan), axis=0) for plan in plans]
    # upright ones side by side where there is room
    upright = sum(bool(high > wide) for wide, high in spans)
    columns = 2 if current_layout().width > _TWO and upright > max(1, len(plans) / 2) else 1
    rows = [plans[start : start + columns] for start in range(0, len(plans), columns)]
    most = scaled_height(min(_HIGHEST, _WHOLE / len(rows)))
    heights = []
    for row in rows:
        listed = max(len(plan.forces) + len(plan.links) for plan in row)
        list_height = _ROW * listed + _HEAD
        needed = [_needed(plan, most, columns) for plan in row]
        heights.append(list_height + max(needed) if is_narrow() else max(list_height, *needed))
    paper = Canvas(current_layout().width, TOP + sum(heights) + _HEAD * len(rows) + _FOOT)
    top, wide, scales = TOP, current_layout().width / columns, set[float]()
    for row, height in zip(rows, heights, strict=True):
        for index, plan in enumerate(row):
            scales.add(_plan(paper, plan, ChartBox(index * wide, top, wide, height), numbers, style.language))
        top += height + _HEAD
    shown = f"{position_sign(style)} = {position_text(degrees, style)}"
    paper.text(current_layout().width - 14, paper.height - 20, shown, anchor="end")
    remarks = ["force_plan", *(["own_scales"] if len(scales) > 1 else [])]
    write_remark(paper, "; ".join(translate(f"drawing.{remark}", style.language) for remark in remarks))
    return paper.drawing(f"{title}, {position_text(degrees, style)}", style.language)


def _list_width() -> float:
    """Return the width of the list beside a plan, which stands below it where figures are narrow. [pt]"""
    return 0.0 if is_narrow() else _LIST


def _scale(plan: ForcePolygon, width: float, height: float) -> float:
    """Return the scale at which a polygon has room beside its list. [displayed unit/mm]"""
    # beside it letters stand between it and the list
    room = np.array([width - _list_width() - 4 * _MARGIN, height - 2 * _MARGIN])
    return round_scale(float(points_per_mm() * np.max(np.ptp(_ends(plan), axis=0) / room)), FINE)


def _needed(plan: ForcePolygon, most: float, columns: int) -> float:
    """Return the height of a plan, at most `most`. [pt]"""
    scale = _scale(plan, current_layout().width / columns, most)
    return float(np.ptp(_ends(plan), axis=0)[1]) * points_per_mm() / scale + 2 * _MARGIN


def _plan(paper: Canvas, plan: ForcePolygon, place: ChartBox, numbers: dict[str, int], language: Language) -> float:
    """Draw the polygon of a group to its own scale, which is returned, and its forces beside it."""
    left, top, width, height = place
    listed = _ROW * (len(plan.forces) + len(plan.links)) + _HEAD
    height -= listed if is_narrow() else 0.0
    row, ends, scale = QUANTITIES["joint_force"], _ends(plan), _scale(plan, width, height)
    width -= _list_width()
    list_corner = (left + 14, top + _HEAD + height) if is_narrow() else (left + width, top + _HEAD)
    unit = points_per_mm() / scale
    middle, half = (ends.min(axis=0) + ends.max(axis=0)) / 2, np.array([width, height]) / 2 / unit
    x, y = zip(*(middle - half, middle + half), strict=True)
    graph = Graph(paper, ChartBox(left, top + _HEAD, width, height), x, y, language, to_scale=False)
    marks = list[tuple[str, float, float]]()
    corners = np.array([graph.point(*end) for end in ends])
    sides = _separated_sides(corners)
    for index, force in enumerate(plan.forces):
        start, end = sides[index]
        for corner, moved in zip(corners[index : index + 2], sides[index], strict=True):
            if np.any(corner != moved):
                paper.line([corner[0], moved[0]], [corner[1], moved[1]], width=0.45, colour=GREY)
        paper.arrow(start, end, width=_LOAD if force.is_load else _REACTION, style=SOLID)
        marks += _components(paper, force, (start, end), force_symbol(force, numbers, language), language)
        marks.append((force_symbol(force, numbers, language), (start[0] + end[0]) / 2, (start[1] + end[1]) / 2))
    label_marks(paper, marks, dot=0.0)
    links = ", ".join(str(numbers.get(link, link)) for link in plan.links)
    head = translate("drawing.links" if len(plan.links) > 1 else "drawing.link", language, links=links)
    draw_scale(paper, (left + 14, top + 10), ("μ_F", scale, row.unit), language, f"{head}:  ")
    for count, force in enumerate(plan.forces):
        shown = number(float(f"{_size(force):.4g}"), language)
        text = f"{force_symbol(force, numbers, language)} = {shown} {unit_name(row.unit, language)}"
        paper.text(list_corner[0], list_corner[1] + 12 + _ROW * count, text)
    names = {own_number: name for name, own_number in numbers.items()}
    keys = key_of_links(names, (numbers[link] for link in plan.links if link in numbers), language)
    for count, key in enumerate(keys):
        paper.text(list_corner[0], list_corner[1] + 12 + _ROW * (len(plan.forces) + count), key)
    return scale


def _components(
    paper: Canvas, force: PolygonForce, ends: tuple[Array, Array], name: str, language: Language
) -> Iterator[tuple[str, float, float]]:
    """Draw the parts of a force across and along its link, and yield their names and places."""
    (start, end), size = ends, force.size
    if force.across is None or not size:
        return
    # on paper the y axis points down
    turned, share = complex(force.x, -force.y), complex(force.across[0], -force.across[1])
    side = complex(*(end - start)) * (share / turned)
    corner = complex(*start) + side
    middle = np.array([corner.real, corner.imag])
    if min(np.hypot(*(middle - start)), np.hypot(*(end - middle))) < _LEAST:
        return
    kinds: tuple[Kind, ...] = ("tangential", "normal")
    for part, (tail, tip) in zip(kinds, ((start, middle), (middle, end)), strict=True):
        paper.arrow(tail.tolist(), tip.tolist(), width=_LOAD, style=DASHED)
        yield name.removesuffix("$") + vector_mark(part, language) + "$" * name.endswith("$"), *((tail + tip) / 2)


def _ends(plan: ForcePolygon) -> Array:
    """Return the corners of the polygon of a group, shape (n, 2). [displayed unit]"""
    ends = np.vstack([np.zeros(2), np.cumsum([(force.x, force.y) for force in plan.forces], axis=0)])
    return displayed_values(QUANTITIES["joint_force"], ends)


def _separated_sides(corners: Array) -> list[Array]:
    """Return the sides of a polygon, those that would lie over others shifted across. [pt]"""
    placed: list[Array] = []
    for start, end in pairwise(corners):
        side = end - start
        across = np.array([-side[1], side[0]]) / max(float(np.hypot(*side)), 1e-9)
        lanes = [np.array([start, end]) + lane * _LANE * across for lane in _LANES]
        free = [lane for lane in lanes if not any(_lie_over(lane, other) for other in placed)]
        placed.append((free or lanes)[0])
    return placed


def _lie_over(first: Array, second: Array) -> bool:
    """Return whether two sides lie along each other."""
    vector, length = first[1] - first[0], float(np.hypot(*(first[1] - first[0])))
    if length < _LANE:
        return False
    off = second - first[0]
    along, distance = off @ vector / length, np.abs(off @ np.array([-vector[1], vector[0]])) / length
    return bool(np.all(distance < _NEAR)) and min(along.max(), length) - max(along.min(), 0.0) > _LANE


def _size(force: PolygonForce) -> float:
    values: Array = displayed_values(QUANTITIES["joint_force"], np.array(force.size))
    return float(values)


def load_symbol(kind: str, link: int | str, before: int, language: Language) -> str:
    """Return the symbol of a load, weight or inertia force on a link: `F_2`, `G_2`, `P_i,2`; primes tell several."""
    bases = {"inertia": symbol("link_inertia_force", language), "weight": texts("marks", language)["weight"]}
    letter, _, index = bases.get(kind, "F").partition("_")
    return f"{letter}{'′' * before}_{index}{',' if index else ''}{link}"


def arm_symbol(force: str) -> str:
    """Return the symbol of the arm of a force, which has its index: `h_и,2`, `h_G2`, `h_RC`."""
    letter, _, index = force.partition("_")
    own = "" if "," in index or letter.startswith("F") else letter
    return f"h{'′' * force.count('′')}_{own.rstrip('′')}{index}"


def torque_symbol(kind: str, link: int | str, language: Language) -> str:
    """Return the symbol of a torque on a link: `M_2` of a load, `M_и,2` of inertia."""
    return f"{symbol('link_inertia_torque', language)},{link}" if kind == "inertia" else f"M_{link}"


def force_symbol(force: PolygonForce, numbers: dict[str, int], language: Language) -> str:
    """Return the symbol of a force: that of its joint, of its guide, of the loads on its link, or of the driver."""
    if force.kind == "driver":
        return math_symbol(QUANTITIES["driver_force"].symbol(language))
    if force.is_load:
        return math_symbol(load_symbol(force.kind, numbers.get(force.name, plain(force.name)), force.before, language))
    if force.kind == "guide":
        return math_symbol(f"N_{numbers.get(force.name, plain(force.name))}")
    return math_symbol(QUANTITIES["joint_force"]._replace(key=f"joint_force.{force.name}").symbol(language))
