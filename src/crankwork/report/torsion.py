"""Figures of torsional vibration: natural modes along the shaft, Campbell's diagram, vibration over the speed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from crankwork.analysis import Array
from crankwork.quantities import QUANTITIES
from crankwork.quantities.key import key_of
from crankwork.report.display import link_label
from crankwork.report.look import Drawn, axis_title, displayed_values, figure_title
from crankwork.show.canvas import Canvas, plain
from crankwork.show.chart import BOTTOM, TOP, ChartBox, Graph, Row, limits, name_at_the_end, round_ticks, small_text
from crankwork.show.chart_layout import current_layout, scaled_height
from crankwork.show.scene import DASHED, SOLID, STYLES, Drawing

MODES, _PANEL, _GAP = 4, 92.0, 22.0
# curves of a panel at most
_CURVES = 4
_NODE = 1e-9


def natural_modes(machine: Drawn) -> Drawing:
    """Return the first natural modes, one below the other: angles over the discs along the shaft, and nodes."""
    results, language = machine.results, machine.language
    columns, model = results.listings["natural_modes"].columns, results.machine.torsion
    names = [key_of(key).owner for key in columns if key.startswith("relative_amplitude.")]
    frequency = displayed_values(QUANTITIES["natural_frequency"], columns["natural_frequency"])
    count, high = min(MODES, frequency.size), scaled_height(_PANEL)
    paper = Canvas(current_layout().width, TOP + count * (high + _GAP) + BOTTOM - _GAP)
    place = {name: float(index) for index, name in enumerate(names)}
    links = []
    if model is not None:
        links = [(item.between, SOLID) for item in model.shafts.values()]
        links += [(item.between, DASHED) for item in model.gears.values()]
    for mode in range(count):
        box = ChartBox(current_layout().left, TOP + 12 + mode * (high + _GAP), current_layout().inner, high - 12)
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
    paper = Canvas(current_layout().width, TOP + len(shown) * (high + _GAP) - _GAP + BOTTOM)
    for index, (kind, keys) in enumerate(shown):
        box = ChartBox(current_layout().left, TOP + index * (high + _GAP), current_layout().inner, high)
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
