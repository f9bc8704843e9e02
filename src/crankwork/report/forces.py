"""The figures of forces: along the cylinder axis, on rod and crankpin, force plans of groups, and the lever."""

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
from crankwork.analysis.zhukovsky_lever import Lever, LeverForce, LeverTorque, zhukovsky_lever
from crankwork.locale import texts, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.display import displayed, key_unit, symbol
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
    scale_text,
)
from crankwork.report.plans import draw_vectors, node_name, vector_mark
from crankwork.show.canvas import (
    FINE,
    GREY,
    WIDER,
    Canvas,
    current_layout,
    fitted_lines,
    is_narrow,
    plain,
    points_per_mm,
    round_scale,
    scaled_height,
    text_width,
)
from crankwork.show.chart import TOP, ChartBox, Graph, Row, limits, over_cycle, round_ticks, sheet, write_remark
from crankwork.show.label_placement import label_marks
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, STYLES, Drawing, Style

_HEAD, _MARGIN, _LIST, _ROW, _FOOT = 16.0, 22.0, 150.0, 13.5, 24.0
# the tallest plan, and all of them together [pt]
_HIGHEST, _WHOLE = 230.0, 560.0
# a paper wider than this has two plans side by side [pt]
_TWO = 560.0
# how far apart forces are drawn that coincide, and what does: nothing else is set aside, so that plans close [pt]
_LANE, _NEAR, _LANES = 6.0, 0.8, (0, 1, -1, 2, -2, 3, -3)
_LOAD, _REACTION, _LEAST = 0.45, 0.9, 12.0
# a group of fewer forces has no plan, only two that are equal
_FEWEST, _MOST = 3, 4
_TALL, _LEVER_MARGIN, _LEVER_ROW, _LEVER_FOOT = 400.0, 30.0, 14.0, 14.0
# length of the arrow of a force, which is not to scale
_FORCE = 40.0
# height of the plan at least
_LOWEST = 60.0
_BLANK, _BETWEEN = "\u00a0", 14.0


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
    room = np.maximum([width - _list_width() - 4 * _MARGIN, height - 2 * _MARGIN], 1.0)
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


class _Named(NamedTuple):
    """A force on the lever with its symbol and that of its arm."""

    force: LeverForce
    symbol: str
    arm: str


def _of(machine: Drawn) -> tuple[Lever | None, float]:
    """Return the lever at the angle that is worked, none without forces, and that angle. [deg]"""
    degrees = float(machine.reached.degrees[machine.reached.row])
    return zhukovsky_lever(machine.results, degrees, machine.style.links), degrees


def has_lever(machine: Drawn) -> bool:
    """Return whether forces act on the lever."""
    return _of(machine)[0] is not None


def lever_figure(machine: Drawn) -> Drawing:
    """Return Zhukovsky's lever at the angle that is worked."""
    (lever, degrees), style, language = _of(machine), machine.style, machine.language
    if lever is None:
        raise TypeError("no force acts on the lever")
    shape = skeleton(machine.results.machine.mechanism, style.links)
    numbers = {member.name: member.number for member in shape.members}
    forces = _named(lever, numbers, language)
    places = np.vstack([np.zeros(2), *lever.plan.nodes.values(), *(force.force.foot for force in forces)])
    (left, bottom), (right, top) = places.min(axis=0), places.max(axis=0)
    room = np.maximum(np.array([current_layout().width, scaled_height(_TALL)]) - 2 * (_LEVER_MARGIN + _FORCE), _LOWEST)
    scale = round_scale(float(points_per_mm() * max((right - left) / room[0], (top - bottom) / room[1])), FINE)
    unit = points_per_mm() / scale
    tips = np.array([_arrow(force.force, unit)[1] for force in forces if force.force.size]).reshape(-1, 2)
    (left, bottom), (right, top) = (end(np.vstack([places, tips]), axis=0) for end in (np.min, np.max))
    high = (top - bottom) * unit + 2 * _LEVER_MARGIN
    rows = _rows(lever, forces, numbers, scale, language)
    paper = Canvas(current_layout().width, high + _LEVER_ROW * (len(rows) + 1) + _LEVER_FOOT)
    low, wide = bottom - _LEVER_MARGIN / unit, current_layout().width / unit
    x, y = ((left + right - wide) / 2, (left + right + wide) / 2), (low, low + high / unit)
    graph = Graph(paper, ChartBox(0.0, 0.0, current_layout().width, high), x, y, language, to_scale=False)
    _arms(graph, forces)
    draw_vectors(graph, lever.plan.vectors, unit, 0.45)
    _forces(graph, forces, unit)
    _names(graph, lever, forces, unit)
    paper.text(14, high + 4, scale_text("μ_v", scale, "m/s", language))
    for index, row in enumerate(rows):
        paper.text(14, high + 4 + _LEVER_ROW * (index + 1), row)
    write_remark(paper, translate("drawing.lever", language))
    title = f"{figure_title('zhukovsky_lever', language)}, {position_text(degrees, style)}"
    return paper.drawing(title, language)


def _named(lever: Lever, numbers: dict[str, int], language: Language) -> list[_Named]:
    """Return the forces with their symbols, that which balances last."""
    named = []
    for acting in lever.forces:
        name = load_symbol(acting.kind, numbers.get(acting.link, acting.link), acting.before, language)
        named.append(_Named(acting, math_symbol(name), math_symbol(arm_symbol(name))))
    end = next((name for name, node in lever.plan.nodes.items() if np.allclose(node, lever.balancing.end)), "a")
    index = symbol("balancing_torque", language).partition("_")[2]
    arm = f"{_pole(lever)}{node_name(end)}"
    return [*named, _Named(lever.balancing, f"$F_{index}$", f"${arm}$" if arm.isalnum() else plain(arm))]


def _pole(lever: Lever) -> str:
    """Return the letter of the pole, which no point has."""
    taken = {node_name(name) for name in lever.plan.nodes}
    return next(letter for letter in ("p", "o", "p₀") if letter not in taken)


def _arms(graph: Graph, forces: Sequence[_Named]) -> None:
    """Draw the lines of the forces up to their arms, and the arms from the pole."""
    for force in forces:
        end, foot = force.force.end, force.force.foot
        for line, style in (((end, foot), DASH_DOT), (((0.0, 0.0), foot), DASHED)):
            (a, b), (p, q) = (graph.point(*place) for place in line)
            graph.paper.line([a, p], [b, q], style=style, width=0.45, colour=GREY)


def _forces(graph: Graph, forces: Sequence[_Named], unit: float) -> None:
    for force in forces:
        if force.force.size:
            start, end = (graph.point(*place) for place in _arrow(force.force, unit))
            graph.paper.arrow(start, end, width=0.9)


def _arrow(force: LeverForce, unit: float) -> tuple[Array, Array]:
    return force.end, force.end + force.force / force.size * _FORCE / unit


def _names(graph: Graph, lever: Lever, forces: Sequence[_Named], unit: float) -> None:
    """Name the nodes of the plan, the forces at their tips, and the arms."""
    marks = [(_pole(lever), *graph.point(0.0, 0.0))]
    marks += [
        (plain(node_name(name)), *graph.point(*node))
        for name, node in lever.plan.nodes.items() if np.hypot(*node) * unit > 1.0
    ]  # fmt: skip
    label_marks(graph.paper, marks, dot=1.3, frame=graph.box)
    marks = [(force.symbol, *graph.point(*_arrow(force.force, unit)[1])) for force in forces if force.force.size]
    marks += [(force.arm, *graph.point(*(force.force.foot / 2))) for force in forces[:-1]]
    label_marks(graph.paper, marks, dot=0.0, frame=graph.box)


def _rows(
    lever: Lever, forces: Sequence[_Named], numbers: dict[str, int], scale: float, language: Language
) -> list[str]:
    """Return forces with their arms on paper, torques with the turning of their links, and the equation of moments."""
    millimetre, per = unit_name("mm", language), unit_name("rad/s", language)
    entries, terms = list[str](), list[str]()
    for acting in forces:
        arm = number(float(f"{acting.force.arm / scale:.4g}"), language)
        size = _value_with_unit("joint_force", acting.force.size, language)
        entries.append(f"{acting.symbol} = {size}, {acting.arm} = {arm} {millimetre}")
        terms.append(f"{'−' if acting.force.moment < 0 else '+'}{_BLANK}{acting.symbol}{_BLANK}{acting.arm}")
    for other in lever.torques:
        own, turning = _torque(other, numbers, language)
        size = _value_with_unit("balancing_torque", other.torque, language)
        entries.append(f"{own} = {size}, {turning} = {number(other.turning, language, digits=4)} {per}")
        # with the signs of torque and turning it stands in the sum as it is
        terms.append(f"+{_BLANK}{own}{_BLANK}{turning}/$μ_v$")
    first, *further = terms
    first = first.removeprefix(f"+{_BLANK}").replace(f"−{_BLANK}", "−")
    equation = f"Σ$M_{_pole(lever)}$ = {' '.join([first, *further])}{_BLANK}={_BLANK}0"
    last, force = symbol("balancing_torque", language), forces[-1].symbol
    radius = (
        f"{number(displayed('crank_radius', lever.radius), language)} {unit_name(key_unit('crank_radius'), language)}"
    )
    torque = _value_with_unit("balancing_torque", lever.torque, language)
    result = f"${last}$ = {'−' if lever.torque < 0 else ''}{force} $r$ = {torque};   $r$ = {radius}"
    width = (current_layout().width - 28) / WIDER
    columns = max(1, int((width + _BETWEEN) / (max(text_width(entry, 8.0) for entry in entries) + _BETWEEN)))
    rows = [";   ".join(entries[start : start + columns]) for start in range(0, len(entries), columns)]
    return [*rows, *fitted_lines(equation, 8.0, width), result]


def _torque(torque: LeverTorque, numbers: dict[str, int], language: Language) -> tuple[str, str]:
    """Return the symbols of a torque on a link and of its turning."""
    link = numbers.get(torque.link, torque.link)
    return math_symbol(torque_symbol(torque.kind, link, language)), math_symbol(f"{symbol('speed', language)}_{link}")


def _value_with_unit(key: str, value: float, language: Language) -> str:
    """Return a value with its unit, to five digits."""
    unit = unit_name(QUANTITIES[key].unit, language)
    return f"{number(float(f'{displayed(key, value):.5g}'), language)} {unit}"
