"""Figures of torques, of a cylinder, of all, along the shaft; of flywheel, speed and torsional vibration."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.constructions import Fluctuation, Tangents, tangents
from crankwork.analysis.given_torques import TurningDiagram, turning_diagram
from crankwork.analysis.one_cylinder import own_key
from crankwork.locale import texts, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language
from crankwork.quantities.key import key_of
from crankwork.report.display import link_label, row_name, symbol
from crankwork.report.forces import Line, curves_over_cycle
from crankwork.report.gas import FOUR_STROKE
from crankwork.report.look import (
    Drawn,
    angle_ticks,
    axis_title,
    displayed_values,
    drive_graph,
    figure_title,
    math_symbol,
    quantity_of,
    scale_text,
)
from crankwork.show.canvas import (
    GREY,
    Canvas,
    columns_of,
    current_layout,
    is_narrow,
    plain,
    points_per_mm,
    round_scale,
    scaled_height,
    text_width,
)
from crankwork.show.chart import (
    BOTTOM,
    TOP,
    WIDE_FIGURES,
    ChartBox,
    Graph,
    Row,
    limits,
    name_at_the_end,
    over_cycle,
    round_ticks,
    sheet,
    small_text,
    true_slices,
    write_remark,
)
from crankwork.show.label_placement import label_marks, label_points, mark_point
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, STYLES, Drawing
from crankwork.units import METRIC, from_si, use_units

_FIRING, _PANEL_GAP = 15.0, 15.0
_THIN, _NAMED = 0.45, 0.9
_UPPER, _LOWER, _GAP = 216.0, 144.0, 16.0
_MOST_TICKS = 12
# height of one of several small graphs, and what is between two beside each other [pt]
_SMALL_GRAPH, _COLUMN_GAP = 96.0, 20.0
_MOST_NAMED = 24
# letters of the work of a loop [pt]
_NAME = 7.5
_LINES = (("turning_moment", "torque", SOLID), ("load_torque", "load", DASHED))
MODES, _PANEL, _BETWEEN_PANELS = 4, 92.0, 22.0
# curves of a panel at most
_CURVES = 4
_NODE = 1e-9
_WHEEL_GAP, _NAMES = 15.0, 24.0
_TALL, _WIDE = 331.0, 1.08
# share of an excess work by which two are the same
_SAME = 1e-6
# how much taller it may be for a round scale; how far tangents are drawn beyond the curve, of its width
_TALLER, _BEYOND = 1.3, 0.12

Ends = tuple[float, float]


def torque(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the crank torque of one cylinder and its mean."""
    values, known = engine.values("crank_torque"), engine.results.trace[own_key(engine.results.machine, "mean_torque")]
    mean = -known.value if known.key == "mean_driving_torque" else known.value
    if abs(float(engine.shown("mean_torque", mean))) < 1e-6 * float(np.max(np.abs(values))):
        mean = 0.0
    level = np.full_like(values, float(engine.shown("mean_torque", mean)))
    curves = [Line("crank_torque", values), Line("mean_torque", level, DASHED)]
    rows = [Row(engine.stated("mean_torque", mean), DASHED)]
    return curves_over_cycle(engine, curves, rows, engine.title("crank_torque"))


def total_torque(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the torque of all cylinders with its mean, and that of cylinder 1."""
    return _summed(engine, "total_torque", "crank_torque", float(engine.diagrams.excess.mean_torque))


def total_tangential_force(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the sum of the tangential forces of all cylinders, and that of cylinder 1."""
    return _summed(engine, "total_tangential_force", "tangential_force")


def _summed(engine: Drawn, key: str, own: str, mean: float | None = None) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return a sum over the cylinders and its mean, with the first of what is summed, and where cylinders fire."""
    degrees, first = engine.diagrams.degrees, engine.diagrams.engine.of(1, own).key
    columns = engine.diagrams.values(key, first)
    total, cylinder = (engine.shown(name, columns[name]) for name in (key, first))
    total[-1] = total[0]
    rows = [Row(engine.named(key), width=_NAMED)]
    if mean is not None:
        level = float(engine.shown("mean_total_torque", mean))
        mean, level = (0.0, 0.0) if abs(level) < 1e-9 * float(np.max(np.abs(total))) else (mean, level)
        # a name would take the legend a line of its own
        rows.append(Row(engine.stated("mean_total_torque", mean).partition(" – ")[0], DASHED))
    which = translate("drawing.cylinder", engine.language, number=1)
    rows.append(Row(f"{engine.named(own)}, {which}", SOLID, _THIN, GREY))
    rows.append(Row(f"▼ – {translate('drawing.fires', engine.language)}", width=0.0))
    paper, box = sheet(225.0 + _FIRING, rows)
    box = box._replace(top=box.top + _FIRING, height=box.height - _FIRING)
    graph = over_cycle(paper, box, limits(total, cylinder), engine.cycle, engine.language)
    firings(engine, graph)
    graph.curve("cylinder_1", degrees, cylinder, width=_THIN, colour=GREY)
    graph.curve("total", degrees, total, width=_NAMED)
    if mean is not None:
        graph.level(level, DASHED, "mean")
    graph.x_title(engine.title("crank_angle"))
    graph.y_title(f"{engine.symbol(key)}, {engine.symbol(own)}, {engine.unit(key)}")
    return paper, {key: graph}


def cylinder_torques(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the torque of every cylinder as small graphs of common axes, in the order in which they fire."""
    values = engine.shown("crank_torque", engine.diagrams.torques)
    places, ends = engine.diagrams.engine.layout.places, limits(values)
    columns = columns_of(next(count for count in (4, 3, 5, 2, 1) if len(places) % count == 0 or count < 3))
    layout, lines, gaps = current_layout(), -(-len(places) // columns), (_COLUMN_GAP, _PANEL_GAP + 3.0)
    wide, high = (layout.inner + gaps[0]) / columns - gaps[0], scaled_height(_SMALL_GRAPH)
    paper, graphs = Canvas(layout.width, TOP + 12 + lines * (high + gaps[1]) - gaps[1] + BOTTOM), dict[str, Graph]()
    for place, index in enumerate(sorted(range(len(places)), key=lambda number: places[number].firing_angle)):
        column, line = place % columns, place // columns
        box = ChartBox(layout.left + column * (wide + gaps[0]), TOP + 12 + line * (high + gaps[1]), wide, high)
        graph = Graph(paper, box, (0.0, engine.cycle), ends, engine.language, "crank_angle")
        is_below = place + columns >= len(places)
        graph.frame(
            np.linspace(0.0, engine.cycle, 3 if columns > 2 else 5), graph.up_ticks, labels=(is_below, not column)
        )
        graph.curve(f"cylinder_{index + 1}", engine.diagrams.degrees, values[index])
        name = translate("drawing.cylinder", engine.language, number=index + 1)
        small_text(paper, graph.box.left + graph.box.width / 2, box.top - 5, name)
        if not column:
            graph.y_title(f"{engine.symbol('crank_torque')}, {engine.unit('crank_torque')}")
        if is_below:
            graph.x_title(f"{engine.symbol('crank_angle')}, {engine.unit('crank_angle')}")
        graphs[str(index + 1)] = graph
    return paper, graphs


def accumulated_torque(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the torque on every main journal that carries some, in panels of one scale."""
    journals = engine.shown("journal_torque", engine.diagrams.journal_torques)
    height = scaled_height(max(52.0, min(110.0, 560.0 / len(journals))))
    paper = Canvas(current_layout().width, TOP + len(journals) * height + (len(journals) - 1) * _PANEL_GAP + BOTTOM)
    graphs, ends, top = {}, limits(journals), TOP
    for index, values in enumerate(journals):
        is_last = index == len(journals) - 1
        box = ChartBox(current_layout().left, top, current_layout().inner, height)
        graph = over_cycle(paper, box, ends, engine.cycle, engine.language, numbers=is_last)
        graph.curve(f"journal_{index + 2}", engine.diagrams.degrees, values)
        graph.y_title(f"{engine.symbol('journal_torque')[:-1]}{index + 2}$, {engine.unit('journal_torque')}")
        name = row_name(f"main_journal.{index + 2}", engine.language)
        small_text(paper, graph.box.left + graph.box.width - 3, box.top - 2, name, "end")
        graphs[str(index + 2)] = graph
        top += graph.box.height + _PANEL_GAP
    graph.x_title(engine.title("crank_angle"))
    return paper, graphs


def firings(engine: Drawn, graph: Graph) -> None:
    """Write the number of each cylinder above a graph where it fires."""
    centre = 360.0 if engine.cycle == FOUR_STROKE else 0.0
    numbers_at: dict[float, list[str]] = {}
    for cylinder, place in enumerate(engine.diagrams.engine.layout.places, start=1):
        angle = (place.firing_angle + place.top + centre) % engine.cycle
        numbers_at.setdefault(round(angle, 6), []).append(str(cylinder))
    top = graph.box.top
    for angle, numbers in numbers_at.items():
        x = float(graph.across(angle))
        graph.paper.area([x, x - 2.2, x + 2.2], [top, top - 4.5, top - 4.5], fill="#000000")
        small_text(graph.paper, x, top - 7, ",".join(numbers))


def has_turning_moment(machine: Drawn) -> bool:
    """Return whether torques on a shaft are known over its angle."""
    return machine.results.machine.turning is not None and turning_diagram(machine.results) is not None


def _shown(drawn: TurningDiagram) -> TurningDiagram:
    """Return a diagram in display units."""
    torque, work = (float(from_si(1.0, QUANTITIES[key].unit)) for key in ("turning_moment", "excess_work"))
    return drawn._replace(
        torque=drawn.torque * torque,
        load=drawn.load * torque,
        energy=drawn.energy * work,
        loops=tuple((middle, height * torque, work_of_loop) for middle, height, work_of_loop in drawn.loops),
    )


def turning_moment(machine: Drawn) -> Drawing:
    """Return the torque over its load with the works of the loops between them, and below it the energy."""
    results, language = machine.results, machine.language
    diagram = turning_diagram(results)
    if diagram is None:
        raise TypeError("the torques on this shaft are not known over its angle")
    drawn = _shown(diagram)
    rows = _rows(results, language)
    paper, box = sheet(_UPPER + _GAP + _LOWER, rows)
    upper = ChartBox(box.left, box.top, box.width, _UPPER)
    lower = ChartBox(box.left, box.top + _UPPER + _GAP, box.width, _LOWER)
    _torques(paper, upper, drawn, language)
    _energy(paper, lower, results, drawn, language)
    excess = results.summary["excess_work"]
    write_remark(
        paper,
        f"{math_symbol(QUANTITIES['excess_work'].symbol(language))} = {_work(excess, language)}",
    )
    return paper.drawing(figure_title("turning_moment", language), language)


def _rows(results: Results, language: Language) -> list[Row]:
    turning = results.machine.turning
    given = {} if turning is None else turning.diagrams
    rows = []
    for key, table, line in _LINES:
        name = plain(QUANTITIES[key].label(language))
        name = name if table in given else translate("drawing.constant", language, name=name)
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
        graph.curve(name, graph.x, [float(energy[int(find(energy))])] * 2, line, width=0.45)
    if angle.size <= _MOST_NAMED:
        for x, y in zip(angle, energy, strict=True):
            paper.dot(*graph.point(x, y), 1.3)
    graph.y_title(axis_title(row, language))
    signed = math_symbol(QUANTITIES["crank_angle"].symbol(language))
    graph.x_title(f"{translate('drawing.angle_of_shaft', language)} {signed}, °")


def _frame(graph: Graph, *, is_last: bool) -> None:
    """Draw the frame of a graph over the angle of a shaft, over a period of any length."""
    rows = max(4, round(graph.box.height / 24))
    graph.frame(angle_ticks(*graph.x), round_ticks(*graph.y, rows), labels=(is_last, True))


def loops(machine: Drawn) -> Drawing:
    """Return the energy after each loop about the mean, as a broken line over their numbers."""
    language, row = machine.language, QUANTITIES["kinetic_energy_change"]
    energy = machine.results.listings["energy_extremes"].columns["kinetic_energy_change"]
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
    return paper.drawing(figure_title("loops", language), language)


def natural_modes(machine: Drawn) -> Drawing:
    """Return the first natural modes, one below the other: angles over the discs along the shaft, and nodes."""
    results, language = machine.results, machine.language
    columns, model = results.listings["natural_modes"].columns, results.machine.torsion
    names = [key_of(key).owner for key in columns if key.startswith("relative_amplitude.")]
    frequency = displayed_values(QUANTITIES["natural_frequency"], columns["natural_frequency"])
    count, high = min(MODES, frequency.size), scaled_height(_PANEL)
    paper = Canvas(current_layout().width, TOP + count * (high + _BETWEEN_PANELS) + BOTTOM - _BETWEEN_PANELS)
    place = {name: float(index) for index, name in enumerate(names)}
    links = []
    if model is not None:
        links = [(item.between, SOLID) for item in model.shafts.values()]
        links += [(item.between, DASHED) for item in model.gears.values()]
    for mode in range(count):
        box = ChartBox(
            current_layout().left, TOP + 12 + mode * (high + _BETWEEN_PANELS), current_layout().inner, high - 12
        )
        shape = {name: float(columns[f"relative_amplitude.{name}"][mode]) for name in names}
        graph = Graph(paper, box, (-0.5, len(names) - 0.5), limits(np.array([*shape.values()])), language)
        graph.frame(np.array([*place.values()]), round_ticks(*graph.y, 4), labels=(False, True))
        for index, (pair, style) in enumerate(links):
            ends = [(place[name], shape[name]) for name in pair if name in place]
            if len(ends) < 2:
                # an end that does not turn stands half a place beside its disc
                side = -0.45 if index == 0 else 0.45
                ends.append((ends[0][0] + side, 0.0))
            (x, a), (other, b) = ends
            graph.curve(f"shaft_{index}", [x, other], [a, b], style)
            if style is SOLID and a * b < 0 and min(abs(a), abs(b)) > _NODE:
                paper.dot(*graph.point(x + (other - x) * a / (a - b), 0.0), 2.2, fill="#ffffff", width=0.9)
        for name in names:
            if abs(shape[name]) < _NODE:
                paper.dot(*graph.point(place[name], 0.0), 2.2, fill="#ffffff", width=0.9)
            else:
                paper.dot(*graph.point(place[name], shape[name]), 1.6)
            if mode == count - 1:
                _disc_name(paper, graph, place[name], link_label(name, language))
        title = f"{machine.symbol('natural_frequency')[:-1]}_{mode + 1}$ = {machine.number(frequency[mode], 4)}"
        small_text(paper, box.left + box.width / 2, box.top - 3, f"{title} {machine.unit('natural_frequency')}")
        graph.y_title(machine.symbol("relative_amplitude"))
    return paper.drawing(figure_title("torsional_modes", language), language)


def _disc_name(paper: Canvas, graph: Graph, x: float, name: str) -> None:
    place, down = graph.point(x, graph.y[0])
    small_text(paper, place, down + 12, plain(name))


def campbell(machine: Drawn) -> Drawing:
    """Return Campbell's diagram: natural frequencies and orders over the speed; where they meet, it is critical."""
    results, language = machine.results, machine.language
    critical = results.listings["critical_speeds"].columns
    modes = np.unique(critical["mode_number"]).astype(int)
    frequency = displayed_values(
        QUANTITIES["natural_frequency"], results.listings["natural_modes"].columns["natural_frequency"]
    )
    speed = displayed_values(QUANTITIES["critical_speed"], critical["critical_speed"])
    end, top = 1.08 * float(np.max(speed)), 1.15 * float(np.max(frequency[modes - 1]))
    paper, box = _sheet(230.0)
    graph = Graph(paper, box, (0.0, end), (0.0, top), language)
    graph.frame(round_ticks(0.0, end), round_ticks(0.0, top))
    for mode in modes.tolist():
        graph.level(float(frequency[mode - 1]), SOLID, f"mode_{mode}")
    orders = critical["harmonic_order"]
    slope = float(np.median(frequency[critical["mode_number"].astype(int) - 1] / (speed * orders)))
    for order in np.unique(orders).tolist():
        last = min(end, top / (order * slope))
        graph.curve(f"order_{order:g}", [0.0, last], [0.0, order * slope * last], STYLES[1], width=0.45)
        x, y = graph.point(last, order * slope * last)
        at_top = last < end
        small_text(paper, x + (0 if at_top else 3), y - 3 if at_top else y + 3, machine.number(order),
                   "middle" if at_top else "start")  # fmt: skip
    for mode in modes.tolist():
        text = f"{machine.symbol('natural_frequency')[:-1]}_{mode}$ = {machine.number(frequency[mode - 1], 4)}"
        x, y = graph.point(0.0, float(frequency[mode - 1]))
        graph.text_on_white(x + 6, y - 4, f"{text} {machine.unit('natural_frequency')}", size=7.0)
    for x, mode in zip(speed.tolist(), critical["mode_number"].tolist(), strict=True):
        paper.dot(*graph.point(x, float(frequency[int(mode) - 1])), 1.5)
    graph.x_title(axis_title(QUANTITIES["rotational_speed"], language))
    graph.y_title(axis_title(QUANTITIES["natural_frequency"], language))
    return paper.drawing(figure_title("campbell", language), language)


def torsional_response(machine: Drawn) -> Drawing:
    """Return largest angles of discs and stresses of shafts, or their torques, over the speed."""
    results, language = machine.results, machine.language
    columns = results.listings["torsional_response"].columns
    speed = displayed_values(QUANTITIES["rotational_speed"], columns["rotational_speed"])
    kinds = ["vibration_amplitude", "vibration_stress", "vibration_torque"]
    panels = [(kind, _largest(columns, kind)) for kind in kinds]
    shown = [(kind, keys) for kind, keys in panels if keys][:2]
    high = scaled_height(150.0)
    paper = Canvas(current_layout().width, TOP + len(shown) * (high + _BETWEEN_PANELS) - _BETWEEN_PANELS + BOTTOM)
    for index, (kind, keys) in enumerate(shown):
        box = ChartBox(current_layout().left, TOP + index * (high + _BETWEEN_PANELS), current_layout().inner, high)
        values = [displayed_values(QUANTITIES[kind], columns[key]) for key in keys]
        symbol = machine.symbol(kind)
        texts = [f"{symbol} – {link_label(key_of(key).owner, language)}" for key in keys]
        name_at_the_end(paper, [Row(text, style) for text, style in zip(texts, STYLES, strict=False)], box)
        graph = Graph(paper, box, (float(speed[0]), float(speed[-1])), limits(*values), language)
        is_last = index == len(shown) - 1
        graph.frame(round_ticks(*graph.x), round_ticks(*graph.y, 6), labels=(is_last, True))
        for key, column, style in zip(keys, values, STYLES, strict=False):
            graph.curve(key_of(key).owner, speed, column, style)
        graph.y_title(axis_title(QUANTITIES[kind], language))
        if is_last:
            graph.x_title(axis_title(QUANTITIES["rotational_speed"], language))
    return paper.drawing(figure_title("torsional_response", language), language)


def _largest(columns: Mapping[str, Array], kind: str) -> Sequence[str]:
    """Return the columns of a kind that reach farthest, in their order."""
    keys = [key for key in columns if key_of(key).quantity == kind]
    kept = sorted(keys, key=lambda key: -float(np.max(columns[key])))[:_CURVES]
    return [key for key in keys if key in kept]


def _sheet(height: float) -> tuple[Canvas, ChartBox]:
    high = scaled_height(height)
    layout = current_layout()
    return Canvas(layout.width, TOP + 8 + high + BOTTOM), ChartBox(layout.left, TOP + 8, layout.inner - 12, high)


def excess_work(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the total torque less its mean, hatched where it gives energy, and below it the work of that."""
    language, excess = engine.language, engine.diagrams.excess
    angle = np.radians(engine.diagrams.degrees)
    surplus = engine.shown("total_torque", engine.diagrams.torque.total(angle) - excess.mean_torque)
    surplus[-1] = surplus[0]
    energy = engine.shown("excess_work", excess.curve(angle))
    upper, lower = scaled_height(120.0), scaled_height(150.0)
    paper = Canvas(current_layout().width, TOP + upper + _WHEEL_GAP + lower + BOTTOM)
    box = ChartBox(current_layout().left, TOP, current_layout().inner, upper)
    torque = over_cycle(paper, box, limits(surplus), engine.cycle, language, numbers=False)
    _hatch(torque, engine.diagrams.degrees, surplus)
    torque.curve("surplus", engine.diagrams.degrees, surplus)
    torque.y_title(
        f"{engine.symbol('total_torque')} − {engine.symbol('mean_total_torque')}, {engine.unit('total_torque')}"
    )
    box = box._replace(top=TOP + torque.box.height + _WHEEL_GAP, height=lower)
    # room for names above and below
    low, high = limits(energy, margin=max(0.16, _NAMES / lower))
    graph = over_cycle(paper, box, (low, high), engine.cycle, language)
    graph.curve("energy", engine.diagrams.degrees, energy)
    extremes = excess.curve.extremes()
    unit_less = [float(engine.shown("excess_work", value_si)) for value_si in (extremes.largest, extremes.least)]
    for name, value, place in zip(("max", "min"), unit_less, (extremes.at_largest, extremes.at_least), strict=True):
        graph.level(value, DASH_DOT, f"level_{name}")
        symbol = engine.symbol("excess_work")[:-1]
        sign = f"{symbol}{',' if '_' in symbol else '_'}{name}$"
        mark_point(graph, name, float(np.degrees(place)), value, sign)
    place = 0.5 * engine.cycle * (0.02 if np.degrees(extremes.at_largest) > 0.1 * engine.cycle else 1.9)
    sign, method = engine.symbol("excess_work")[:-1], ""
    if not math.isclose(excess.work, engine.results.summary.get("excess_work", excess.work), rel_tol=_SAME):
        # the flywheel may follow from another one
        sign = f"{sign}{',' if '_' in sign else '_'}{texts('marks', language)['mertsalov']}"
        method = f", {translate('report.way_mertsalov', language)}"
    _span(graph, place, unit_less, f"{sign}$ = {engine.value('excess_work', excess.work)}{method}")
    engine.name_axes(graph, "crank_angle", "excess_work")
    return paper, {"torque": torque, "energy": graph}


def _hatch(graph: Graph, degrees: Array, values: Array) -> None:
    """Hatch what lies over the horizontal axis."""
    angles = np.arange(0.0, degrees[-1], degrees[-1] / 144)
    over = np.interp(angles, degrees, values)
    x, y, zero = graph.across(angles), graph.down(over), float(graph.down(0.0))
    kept = over > 0
    graph.paper.segments(np.column_stack([x, np.full_like(x, zero), x, y])[kept], width=0.45, colour=GREY)


def _span(graph: Graph, angle: float, ends: list[float], text: str) -> None:
    """Draw a double arrow between two levels with a text above the graph, where no curve is."""
    x = float(graph.across(angle))
    top, bottom = (float(graph.down(end)) for end in ends)
    graph.paper.arrow((x, (top + bottom) / 2), (x, top), width=0.45)
    graph.paper.arrow((x, (top + bottom) / 2), (x, bottom), width=0.45)
    graph.paper.text(x, graph.box.top - 5, text, anchor="start" if angle < graph.x[1] / 2 else "end")


def crank_speed(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the angular speed over the cycle with its mean and its extremes."""
    language, speed = engine.language, engine.diagrams.torque.speed
    if speed is None:
        raise TypeError("this engine has no moment of inertia that its speed would follow from")
    values = engine.shown("crank_speed", speed.speed(np.radians(engine.diagrams.degrees)))
    mean = float(engine.shown("speed", engine.results.solved.speed))
    rows = [
        Row(
            f"{engine.symbol('speed')} = {engine.value('speed', engine.results.solved.speed)}"
            f" – {translate('report.mean', language)}",
            DASHED,
        ),
        Row(f"{engine.named('speed_fluctuation')}, {engine.number(speed.fluctuation, 4)}", width=0.0),
    ]
    paper, box = sheet(200.0, rows)
    room = 0.16 * float(np.ptp(values))
    graph = over_cycle(paper, box, (float(values.min()) - room, float(values.max()) + room), engine.cycle, language)
    graph.curve("speed", engine.diagrams.degrees, values)
    graph.level(mean, DASHED, "mean")
    ends = speed.extremes
    for name, value, angle in (("max", ends.largest, ends.at_largest), ("min", ends.least, ends.at_least)):
        text = f"{engine.symbol('speed')[:-1]}_{name}$ = {engine.value('crank_speed', value, 5)}"
        mark_point(graph, name, float(np.degrees(angle)), float(engine.shown("crank_speed", value)), text)
    engine.name_axes(graph, "crank_angle", "crank_speed")
    return paper, {"crank_speed": graph}


def has_energy_mass_diagram(machine: Drawn) -> bool:
    """Return whether a fluctuation of the speed is wanted of something that has mass, which turns fully."""
    columns, drive = machine.reached.columns, machine.results.machine.drive
    if machine.has_piston:
        return "flywheel_inertia.exact" in machine.results.summary and drive.fluctuation is not None
    # without masses the energy stands over one point
    return has_speed(machine) and drive.fluctuation is not None and bool(np.any(columns["reduced_inertia"]))


def wittenbauer(machine: Drawn) -> Drawing:
    """Return the energy-mass diagram, its tangents and the piece kl that they cut from the energy axis."""
    degrees, columns, drive = machine.reached.degrees, machine.reached.columns, machine.results.machine.drive
    if machine.has_piston:
        columns = machine.diagrams.values("reduced_inertia", "kinetic_energy_change")
        degrees = machine.diagrams.degrees
    inertia, energy = columns["reduced_inertia"], columns["kinetic_energy_change"]
    wanted = Fluctuation(machine.results.solved.speed, drive.fluctuation or 0.0)
    construction, language = tangents(inertia, energy, wanted), machine.language
    work = construction.foot_max - construction.foot_min
    # slopes and angles are those of J over kg m2
    with use_units(METRIC):
        ends, scales = _ends(inertia, energy, construction)
        slopes = (construction.slope_max, "max"), (construction.slope_min, "min")
        # a column of a note may be narrower than the drawing, and its formulas have the slopes
        rows = (
            []
            if is_narrow()
            else [Row(_angle(scales.x / scales.y, slope, name, language), width=0.0) for slope, name in slopes]
        )
        if not (current_layout().is_sheet or is_narrow()):
            # a sheet has them over every graph
            rows.append(Row(_scales(scales, language), width=0.0))
        paper, box = sheet((ends[1][1] - ends[1][0]) / scales.y * points_per_mm() / scaled_height(1.0), rows)
        graph = Graph(paper, box, *ends, language)
        graph.frame(round_ticks(*graph.x), graph.up_ticks)
        _lines(graph, inertia, energy, construction, degrees)
        graph.x_title(axis_title(QUANTITIES[f"{'total_' * (machine.cylinders > 1)}reduced_inertia"], language))
        graph.y_title(axis_title(QUANTITIES["kinetic_energy_change"], language))
        cut = number(work / scales.y, language, digits=5)
        shown = f"{number(construction.flywheel, language, digits=4)} {unit_name('kg*m2', language)}"
        tan = "tg" if language == "ru" else "tan"
        formula = f"$kl$/({tan} $ψ_max$ − {tan} $ψ_min$) = {shown}"
        foot = f"$kl$ = {cut} {unit_name('mm', language)}; {translate('drawing.flywheel', language)}: $μ_J$ {formula}"
        if is_narrow():
            foot = f"$kl$ = {number(work, language, digits=4)} {unit_name('J', language)}; {formula}"
        write_remark(paper, foot)
        return paper.drawing(figure_title("wittenbauer", language), language)


class _Scales(NamedTuple):
    """Values of a millimetre of the paper across and upward. [kg m2], [J]"""

    x: float
    y: float


def _ends(inertia: Array, energy: Array, construction: Tangents) -> tuple[tuple[Ends, Ends], _Scales]:
    """Return the ends of both axes, and their scales, which are 1, 2 or 5 times a power of ten."""
    most = float(np.max(inertia))
    feet = np.array([construction.foot_max, construction.foot_min])
    # as far as the tangents are seen to touch the curve
    touch = np.array([inertia[construction.touch_max], inertia[construction.touch_min]]) + _BEYOND * most
    beyond = feet + np.array([construction.slope_max, construction.slope_min]) * np.minimum(touch, _WIDE * most)
    through = np.array([*energy, *feet, *beyond, 0.0])
    margin = 0.06 * float(np.ptp(through))
    low, high = float(through.min()) - margin, float(through.max()) + margin
    _, box = sheet(_TALL)
    length, height = box.width / points_per_mm(), _TALLER * box.height / points_per_mm()
    scales = _Scales(round_scale(_WIDE * most / length, (1, 2, 5)), round_scale((high - low) / height, (1, 2, 5)))
    return ((0.0, scales.x * length), (low, high)), scales


def _scales(scales: _Scales, language: Language) -> str:
    """Return the scales of both axes on paper, which the angles on it depend on."""
    texts = []
    for key, value in zip(("reduced_inertia", "kinetic_energy_change"), scales, strict=True):
        sign = QUANTITIES[key].symbol(language).lstrip("Δ")
        texts.append(scale_text(f"μ_{sign.partition('_')[0]}", value, QUANTITIES[key].unit, language))
    return "; ".join(texts)


def _lines(graph: Graph, inertia: Array, energy: Array, construction: Tangents, degrees: Array) -> None:
    """Draw the curve, its tangents down to the energy axis, and the angles on it."""
    width, feet = graph.x[1], (construction.foot_max, construction.foot_min)
    graph.curve("energy", inertia, energy, angles=degrees)
    for foot, slope, line, name in (
        (feet[0], construction.slope_max, DASHED, "max"),
        (feet[1], construction.slope_min, DASH_DOT, "min"),
    ):
        ends = [0.0, width], [foot, foot + slope * width]
        graph.curve(name, *inside(ends, graph.y), line, width=0.9)
    marks = [int(np.argmin(np.abs(degrees - angle))) for angle in np.arange(0, float(degrees[-1]) - 1, 30)]
    # of several cylinders the curve runs through the same points again
    places = [(round(float(graph.across(inertia[i]))), round(float(graph.down(energy[i])))) for i in marks]
    marks = [mark for k, mark in enumerate(marks) if places[k] not in places[:k]]
    points = [(f"{degrees[i]:g}", float(inertia[i]), float(energy[i])) for i in marks]
    label_points(graph, [*points, ("k", 0.0, feet[0]), ("l", 0.0, feet[1])])
    for name in ("max", "min"):
        x, y = (coordinates[-1] for coordinates in graph.curves[name])
        foot = graph.curves[name][1][0]
        label_marks(graph.paper, [(f"$ψ_{name}$", *graph.point(0.9 * x, foot + 0.9 * (y - foot)))], dot=0.0)


def inside(ends: tuple[Sequence[float], Sequence[float]], y: tuple[float, float]) -> tuple[list[float], list[float]]:
    """Return the part of a straight line that lies within a range of its ordinates."""
    (a, b), (p, q) = ends
    low, high = min(y), max(y)
    shares = sorted(min(max((ordinate - p) / (q - p), 0.0), 1.0) for ordinate in (low, high)) if q != p else [0.0, 1.0]
    return [a + share * (b - a) for share in shares], [p + share * (q - p) for share in shares]


def _angle(scale: float, slope: float, name: str, language: Language) -> str:
    """Return the angle of a tangent on paper, in words of the legend."""
    angle = math.degrees(math.atan(slope * scale))
    words = translate("drawing.slope", language)
    unit = f"{unit_name('J', language)}/({unit_name('kg*m2', language)})"
    return f"$ψ_{name}$ = {number(angle, language, digits=6)}°; {words} {number(slope, language, digits=4)} {unit}"


def has_speed(machine: Drawn) -> bool:
    """Return whether the speed over a whole cycle is known."""
    return "crank_speed" in machine.reached.columns and machine.reached.is_whole


def speed_curve(machine: Drawn) -> Drawing:
    """Return the angular speed of the crank over one cycle, with its largest and smallest value."""
    results, style, language, row = machine.results, machine.style, machine.language, quantity_of("speed")
    evenness = Fluctuation(results.solved.speed, results.summary["speed_fluctuation"])
    shaft = turning_diagram(results) if results.machine.turning is not None else None
    degrees = machine.reached.degrees if shaft is None else shaft.degrees
    speed = results.columns_at(degrees, ["crank_speed"])["crank_speed"]
    low, high = float(np.min(speed)), float(np.max(speed))
    mean = symbol("mean_torque", language).partition("_")[2]
    levels = (high, "max", DOTTED), (evenness.mean, mean, DASHED), (low, "min", DOTTED)
    mark, unit = symbol("speed", language), unit_name(row.unit, language)
    shown = [
        f"${mark}_{name}$ = {number(float(displayed_values(row, np.asarray(value))), language, digits=5)} {unit}"
        for value, name, _ in levels
    ]
    shown.append(f"$δ$ = {number(evenness.delta, language, digits=3)}")
    paper, box = sheet(216.0, [Row(";  ".join(shown), width=0.0)])
    margin = 0.08 * (high - low) or 0.01 * high
    ends = displayed_values(row, np.array([low - margin, high + margin]))
    graph = drive_graph(paper, box, degrees, (float(ends[0]), float(ends[1])), style)
    graph.curve("speed", degrees, displayed_values(row, speed))
    for value, name, line in levels:
        graph.level(float(displayed_values(row, np.asarray(value))), line, name)
    graph.y_title(axis_title(row, language))
    return paper.drawing(figure_title("speed", language), language)
