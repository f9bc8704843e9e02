"""The figures of a shaft with torques on it: turning moment diagram with its loops, energy, speed."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.diagrams import Fluctuation
from crankwork.analysis.turning import TurningDiagram, turning_diagram
from crankwork.locale import say
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.figure_data import figure_title
from crankwork.report.linkage_energy import speed_curve
from crankwork.report.linkage_look import Style, angle_ticks, axis_title, displayed_values, math_symbol
from crankwork.report.summary import results_method
from crankwork.show.chart import (
    WIDE_FIGURES,
    ChartBox,
    Graph,
    Row,
    limits,
    round_ticks,
    sheet,
    true_slices,
    write_method,
)
from crankwork.show.labels import label_points
from crankwork.show.paper import Canvas, plain, text_width
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, Drawing
from crankwork.units import from_si

_UPPER, _LOWER, _GAP = 216.0, 144.0, 16.0
_MOST_TICKS = 12
_MOST_NAMED = 24
# letters of the work of a loop [pt]
_NAME = 7.5


def turning_pictures(results: Results, language: Language) -> dict[str, Callable[[], Drawing]]:
    """Return the functions that draw the figures of a shaft."""
    style = Style(language, (), results_method(results, language), turns="shaft")
    drawn = _shown(turning_diagram(results))
    if drawn is None:
        loops = results.listings.get("energy_extremes")
        return {} if loops is None else {"loops": partial(_loops, loops.columns["kinetic_energy_change"], style)}
    pictures: dict[str, Callable[[], Drawing]] = {"turning_moment": partial(_diagram, results, drawn, style)}
    if "crank_speed" in results.columns:
        speed = results.columns_at(drawn.degrees, ["crank_speed"])["crank_speed"]
        evenness = Fluctuation(results.solved.speed, results.summary["speed_fluctuation"])
        pictures["speed"] = partial(speed_curve, drawn.degrees, speed, evenness, style)
    return pictures


def _shown(drawn: TurningDiagram | None) -> TurningDiagram | None:
    """Return a diagram in display units."""
    if drawn is None:
        return None
    torque, work = (float(from_si(1.0, QUANTITIES[key].unit)) for key in ("turning_moment", "excess_work"))
    return drawn._replace(
        torque=drawn.torque * torque,
        load=drawn.load * torque,
        energy=drawn.energy * work,
        loops=tuple((middle, height * torque, work_of_loop) for middle, height, work_of_loop in drawn.loops),
    )


def _diagram(results: Results, drawn: TurningDiagram, style: Style) -> Drawing:
    """Return the torque over its load with the works of the loops between them, and below it the energy."""
    language = style.language
    rows = _rows(results, language)
    paper, box = sheet(_UPPER + _GAP + _LOWER, rows)
    upper = ChartBox(box.left, box.top, box.width, _UPPER)
    lower = ChartBox(box.left, box.top + _UPPER + _GAP, box.width, _LOWER)
    _torques(paper, upper, drawn, language)
    _energy(paper, lower, results, drawn, language)
    excess = results.summary["excess_work"]
    write_method(
        paper, style.method, f"{math_symbol(QUANTITIES['excess_work'].symbol(language))} = {_work(excess, language)}"
    )
    return paper.drawing(figure_title("turning_moment", language), language)


_LINES = (("turning_moment", "torque", SOLID), ("load_torque", "load", DASHED))


def _rows(results: Results, language: Language) -> list[Row]:
    turning = results.machine.turning
    given = {} if turning is None else turning.diagrams
    rows = []
    for key, table, line in _LINES:
        name = plain(QUANTITIES[key].label(language))
        name = name if table in given else say("drawing.constant", language, name=name)
        rows.append(Row(f"{math_symbol(QUANTITIES[key].symbol(language))} – {name}", line))
    return rows


def _torques(paper: Canvas, box: ChartBox, drawn: TurningDiagram, language: Language) -> None:
    graph = Graph(
        paper, box, (0.0, float(drawn.degrees[-1])), limits(drawn.torque, drawn.load), language, "crank_angle"
    )
    over = drawn.torque > drawn.load
    # what is more than the load is shaded, what is less is hatched
    for where, fill in ((over, graph.shade), (~over, graph.hatch)):
        for rows in true_slices(where):
            part = slice(max(rows.start - 1, 0), rows.stop + 1)
            angles, load = drawn.degrees[part], drawn.load[part]
            # where they cross they are one
            torque = np.where(where[part], drawn.torque[part], load)
            fill(np.append(angles, angles[::-1]), np.append(torque, load[::-1]))
    _frame(graph, is_last=False)
    for (key, _, line), values in zip(_LINES, (drawn.torque, drawn.load), strict=True):
        graph.curve(key, drawn.degrees, values, line)
    names = ", ".join(math_symbol(QUANTITIES[key].symbol(language)) for key, _, _ in _LINES)
    graph.y_title(f"{names}, {unit_name(QUANTITIES['turning_moment'].unit, language)}")
    if len(drawn.loops) <= _MOST_NAMED:
        for middle, height, work in drawn.loops:
            _name_loop(graph, drawn, (middle, height), _work(work, language, signed=True))


def _name_loop(graph: Graph, drawn: TurningDiagram, place: tuple[float, float], text: str) -> None:
    """Write the work of a loop where the loop is tallest for it, upward if it is nowhere as wide as the text."""
    over, x = drawn.torque > drawn.load, graph.across(drawn.degrees)
    inside = next((rows for rows in true_slices(over) + true_slices(~over)
                   if drawn.degrees[rows][0] <= place[0] <= drawn.degrees[rows][-1]), slice(0))  # fmt: skip
    ends = graph.down(np.array([drawn.torque, drawn.load]))
    upper, lower = ends.min(axis=0), ends.max(axis=0)
    zero = float(graph.down(0.0))
    middle, length, height = graph.point(*place), WIDE_FIGURES * text_width(text, _NAME), 1.5 * _NAME
    for wide, tall in ((length, height), (height, length)):
        best, chosen = -math.inf, middle
        for place_x in x[inside].tolist():
            over_text = np.abs(x - place_x) <= wide / 2
            top, bottom = float(upper[over_text].max()), float(lower[over_text].min())
            if top < zero < bottom:
                top, bottom = (zero, bottom) if bottom - zero > zero - top else (top, zero)
            # of places with as much room that in the middle
            worth = min(bottom - top, 2 * tall) - 0.01 * abs(place_x - middle[0])
            if bottom - top > tall and worth > best:
                best, chosen = worth, (place_x, (top + bottom) / 2)
        if best > -math.inf:
            break
    else:
        wide = length
    if wide == length:
        graph.text_on_white(chosen[0], chosen[1] + 0.35 * _NAME, text, "middle", _NAME)
        return
    sides = np.array([-0.5, 0.5, 0.5, -0.5]) * wide, np.array([-0.5, -0.5, 0.5, 0.5]) * tall
    graph.paper.area(chosen[0] + sides[0], chosen[1] + sides[1])
    graph.paper.upward_text(chosen[0] + 0.35 * _NAME, chosen[1], text, size=_NAME)


def _work(work: float, language: Language, *, signed: bool = False) -> str:
    unit = QUANTITIES["excess_work"].unit
    shown = number(float(from_si(work, unit)), language, digits=4)
    return f"{'+' if signed and work > 0 else ''}{shown} {unit_name(unit, language)}"


def _energy(paper: Canvas, box: ChartBox, results: Results, drawn: TurningDiagram, language: Language) -> None:
    row = QUANTITIES["kinetic_energy_change"]
    graph = Graph(paper, box, (0.0, float(drawn.degrees[-1])), limits(drawn.energy), language, "crank_angle")
    _frame(graph, is_last=True)
    graph.curve("kinetic_energy_change", drawn.degrees, drawn.energy)
    columns = results.listings["energy_extremes"].columns
    angle, energy = np.degrees(columns["crank_angle"]), displayed_values(row, columns["kinetic_energy_change"])
    for find, line, name in ((np.argmax, DASH_DOT, "max"), (np.argmin, DOTTED, "min")):
        graph.curve(name, graph.x, [float(energy[int(find(energy))])] * 2, line, width=0.8)
    if angle.size <= _MOST_NAMED:
        for x, y in zip(angle, energy, strict=True):
            paper.dot(*graph.point(x, y), 1.3)
    graph.y_title(axis_title(row, language))
    signed = math_symbol(QUANTITIES["crank_angle"].symbol(language))
    graph.x_title(f"{say('drawing.angle_of_shaft', language)} {signed}, °")


def _frame(graph: Graph, *, is_last: bool) -> None:
    """Draw the frame of a graph over the angle of a shaft, over a period of any length."""
    rows = max(4, round(graph.box.height / 24))
    graph.frame(angle_ticks(*graph.x), round_ticks(*graph.y, rows), labels=(is_last, True))


def _loops(energy: Array, style: Style) -> Drawing:
    """Return the energy after each loop about the mean, as a broken line over their numbers."""
    language, row = style.language, QUANTITIES["kinetic_energy_change"]
    count, values = np.arange(energy.size + 1.0), displayed_values(row, np.append(0.0, energy))
    paper, box = sheet(216.0)
    y = limits(values)
    graph = Graph(paper, box, (0.0, float(energy.size)), y, language)
    graph.frame(count[:: max(1, math.ceil(count.size / _MOST_TICKS))], round_ticks(*y))
    graph.curve("kinetic_energy_change", count, values)
    names = [(number(y, language, digits=4), x, y) for x, y in zip(count.tolist(), values.tolist(), strict=True)]
    label_points(graph, names)
    graph.x_title(axis_title(QUANTITIES["loop_number"], language))
    graph.y_title(axis_title(row, language))
    write_method(paper, style.method)
    return paper.drawing(figure_title("loops", language), language)
