"""Zhukovsky's lever as a figure: the turned velocity plan with forces and their arms, and the sum of moments."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.skeleton import skeleton
from crankwork.analysis.zhukovsky_lever import Lever, LeverForce, LeverTorque, zhukovsky_lever
from crankwork.locale import translate
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.display import displayed, key_unit, symbol
from crankwork.report.forces import arm_symbol, load_symbol, torque_symbol
from crankwork.report.look import Drawn, figure_title, math_symbol, position_text, scale_text
from crankwork.report.plans import draw_vectors, node_name
from crankwork.show.canvas import GREY, WIDER, Canvas, fitted_lines, plain, text_width
from crankwork.show.chart import ChartBox, Graph, write_remark
from crankwork.show.chart_layout import FINE, current_layout, points_per_mm, round_scale, scaled_height
from crankwork.show.label_placement import label_marks
from crankwork.show.scene import DASH_DOT, DASHED, Drawing

_TALL, _MARGIN, _ROW, _FOOT = 400.0, 30.0, 14.0, 14.0
# length of the arrow of a force, which is not to scale
_FORCE = 40.0
# width of the lines of the plan, of those in a plan without forces
# height of the plan at least
_LOWEST = 60.0
_BLANK, _BETWEEN = "\u00a0", 14.0


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
    room = np.maximum(np.array([current_layout().width, scaled_height(_TALL)]) - 2 * (_MARGIN + _FORCE), _LOWEST)
    scale = round_scale(float(points_per_mm() * max((right - left) / room[0], (top - bottom) / room[1])), FINE)
    unit = points_per_mm() / scale
    high = (top - bottom) * unit + 2 * (_MARGIN + _FORCE)
    rows = _rows(lever, forces, numbers, scale, language)
    paper = Canvas(current_layout().width, high + _ROW * (len(rows) + 1) + _FOOT)
    low, wide = bottom - (_MARGIN + _FORCE) / unit, current_layout().width / unit
    x, y = ((left + right - wide) / 2, (left + right + wide) / 2), (low, low + high / unit)
    graph = Graph(paper, ChartBox(0.0, 0.0, current_layout().width, high), x, y, language, to_scale=False)
    _arms(graph, forces)
    draw_vectors(graph, lever.plan.vectors, unit, 0.45)
    _forces(graph, forces, unit)
    _names(graph, lever, forces, unit)
    paper.text(14, high + 4, scale_text("μ_v", scale, "m/s", language))
    for index, row in enumerate(rows):
        paper.text(14, high + 4 + _ROW * (index + 1), row)
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
