"""The figures of the torque of all cylinders: sum, torques along the shaft, excess work and speed."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from crankwork.analysis import Array
from crankwork.locale import say
from crankwork.report.engine_figure_cylinder import firings
from crankwork.report.engine_figure_data import EngineDrawn
from crankwork.report.language import row_name
from crankwork.show.chart import BOTTOM, TOP, ChartBox, Graph, Row, limits, over_cycle, sheet, small_text
from crankwork.show.labels import label_marks, mark_point
from crankwork.show.paper import BLACK, GREY, Canvas
from crankwork.show.place import current_layout, scaled_height
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, Style

_MANY, _FIRING = 8, 15.0
_PANEL_GAP, _NAMES = 15.0, 24.0
_THIN, _NAMED = 0.8, 1.3
# of the torques of cylinders, and what is lighter than black
_DASHES: tuple[Style, ...] = (DOTTED, DASH_DOT, (3.0, 2.0), (12.0, 2.0, 1.5, 2.0, 1.5, 2.0))
_LIGHTER = "#808080"


def total_torque(engine: EngineDrawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the torque of each cylinder, thin, and their sum with its mean."""
    language, torque = engine.language, engine.diagrams.torque
    each = engine.shown("crank_torque", engine.diagrams.torques)
    shown = each if len(each) <= _MANY else each[:1]
    total = engine.shown("total_torque", torque.total(np.radians(engine.diagrams.degrees)))
    total[-1] = total[0]
    mean = float(engine.shown("mean_total_torque", engine.diagrams.excess.mean_torque))
    mean = 0.0 if abs(mean) < 1e-9 * float(np.max(np.abs(total))) else mean
    rows = [
        Row(engine.named("total_torque"), width=_NAMED),
        Row(f"{engine.named('mean_total_torque')}, {engine.value('mean_total_torque', mean)}", DASHED),
        *_of_cylinders(engine, len(shown)),
        Row(f"▼ – {say('drawing.fires', language)}", width=0.0),
    ]
    paper, box = sheet(225.0 + _FIRING, rows)
    box = box._replace(top=box.top + _FIRING, height=box.height - _FIRING)
    graph = over_cycle(paper, box, limits(total, shown), engine.cycle, language)
    firings(engine, graph)
    for index, torque_curve in enumerate(shown):
        style, colour = _look(index)
        graph.curve(f"cylinder_{index + 1}", engine.diagrams.degrees, torque_curve, style, width=_THIN, colour=colour)
    graph.curve("total", engine.diagrams.degrees, total, width=_NAMED)
    graph.level(mean, DASHED, "mean")
    graph.x_title(engine.title("crank_angle"))
    graph.y_title(f"{engine.symbol('total_torque')}, {engine.symbol('crank_torque')}, {engine.unit('total_torque')}")
    if len(shown) > 1:
        peaks = [(index, int(np.argmax(torque_curve))) for index, torque_curve in enumerate(shown)]
        tips = [(str(k + 1), *graph.point(engine.diagrams.degrees[peak], shown[k][peak])) for k, peak in peaks]
        label_marks(paper, tips, size=7.5, dot=1.2, frame=graph.box)
    return paper, {"total_torque": graph}


def _look(cylinder: int) -> tuple[Style, str]:
    """Return dashes and shade of the torque of a cylinder, no two alike of as many as are shown."""
    return _DASHES[cylinder % len(_DASHES)], (BLACK, _LIGHTER)[cylinder // len(_DASHES)]


def _of_cylinders(engine: EngineDrawn, count: int) -> list[Row]:
    """Return what a legend says of the torques of so many cylinders, one line for each way they are dashed."""
    rows = []
    for first in range(min(count, len(_DASHES))):
        numbers = ", ".join(str(index + 1) for index in range(first, count, len(_DASHES)))
        key = "drawing.cylinders" if "," in numbers else "drawing.cylinder"
        which = say(key, engine.language, number=numbers)
        other = _LIGHTER if "," in numbers else ""
        rows.append(Row(f"{engine.named('crank_torque')}, {which}", _DASHES[first], _THIN, other=other))
    return rows


def accumulated_torque(engine: EngineDrawn) -> tuple[Canvas, Mapping[str, Graph]]:
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


def excess_work(engine: EngineDrawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the total torque less its mean, hatched where it gives energy, and below it the work of that."""
    language, excess = engine.language, engine.diagrams.excess
    angle = np.radians(engine.diagrams.degrees)
    surplus = engine.shown("total_torque", engine.diagrams.torque.total(angle) - excess.mean_torque)
    surplus[-1] = surplus[0]
    energy = engine.shown("excess_work", excess.curve(angle))
    upper, lower = scaled_height(120.0), scaled_height(150.0)
    paper = Canvas(current_layout().width, TOP + upper + _PANEL_GAP + lower + BOTTOM)
    box = ChartBox(current_layout().left, TOP, current_layout().inner, upper)
    torque = over_cycle(paper, box, limits(surplus), engine.cycle, language, numbers=False)
    _hatch(torque, engine.diagrams.degrees, surplus)
    torque.curve("surplus", engine.diagrams.degrees, surplus)
    torque.y_title(
        f"{engine.symbol('total_torque')} − {engine.symbol('mean_total_torque')}, {engine.unit('total_torque')}"
    )
    box = box._replace(top=TOP + torque.box.height + _PANEL_GAP, height=lower)
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
    _span(graph, place, unit_less, f"{engine.symbol('excess_work')} = {engine.value('excess_work', excess.work)}")
    engine.name_axes(graph, "crank_angle", "excess_work")
    return paper, {"torque": torque, "energy": graph}


def _hatch(graph: Graph, degrees: Array, values: Array) -> None:
    """Hatch what lies over the horizontal axis."""
    angles = np.arange(0.0, degrees[-1], degrees[-1] / 144)
    over = np.interp(angles, degrees, values)
    x, y, zero = graph.across(angles), graph.down(over), float(graph.down(0.0))
    kept = over > 0
    graph.paper.segments(np.column_stack([x, np.full_like(x, zero), x, y])[kept], width=0.5, colour=GREY)


def _span(graph: Graph, angle: float, ends: list[float], text: str) -> None:
    """Draw a double arrow between two levels with a text above the graph, where no curve is."""
    x = float(graph.across(angle))
    top, bottom = (float(graph.down(end)) for end in ends)
    graph.paper.arrow((x, (top + bottom) / 2), (x, top), width=0.8)
    graph.paper.arrow((x, (top + bottom) / 2), (x, bottom), width=0.8)
    graph.paper.text(x, graph.box.top - 5, text, size=8.5, anchor="start" if angle < graph.x[1] / 2 else "end")


def crank_speed(engine: EngineDrawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the angular speed over the cycle with its mean and its extremes."""
    language, speed = engine.language, engine.diagrams.torque.speed
    if speed is None:
        raise TypeError("this engine has no moment of inertia that its speed would follow from")
    values = engine.shown("crank_speed", speed.speed(np.radians(engine.diagrams.degrees)))
    mean = float(engine.shown("speed", engine.results.solved.speed))
    rows = [
        Row(engine.named("crank_speed")),
        Row(
            f"{engine.symbol('speed')} – {say('report.mean', language)},"
            f" {engine.value('speed', engine.results.solved.speed)}",
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
