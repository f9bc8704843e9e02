"""Figures of torques, of a cylinder, of all, along the shaft, and of torsional vibration."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.given_torques import TurningDiagram, turning_diagram
from crankwork.analysis.one_cylinder import own_key
from crankwork.locale import translate
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language
from crankwork.quantities.key import key_of
from crankwork.report.display import link_label, row_name
from crankwork.report.forces import Line, curves_over_cycle
from crankwork.report.gas import FOUR_STROKE
from crankwork.report.look import Drawn, angle_ticks, axis_title, displayed_values, figure_title, math_symbol
from crankwork.show.canvas import GREY, Canvas, plain, text_width
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
from crankwork.show.chart_layout import columns_of, current_layout, scaled_height
from crankwork.show.label_placement import label_points
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, STYLES, Drawing
from crankwork.units import from_si

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
_MODES, _PANEL, _BETWEEN_PANELS = 4, 92.0, 22.0
# curves of a panel at most
_CURVES = 4
_NODE = 1e-9


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
    count, high = min(_MODES, frequency.size), scaled_height(_PANEL)
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
