"""The figures of the gas: pressure over the cycle, indicator diagrams, volume and force of chambers."""

from __future__ import annotations

import itertools
import re
from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.gas_chambers import indicators
from crankwork.analysis.stages import stage_diagrams
from crankwork.locale import translate
from crankwork.locale.numbers import unit_name
from crankwork.quantities.key import key_of
from crankwork.quantities.quantity import number_of
from crankwork.report.look import Drawn, axis_title, displayed_values, key_of_links, math_symbol, quantity_of
from crankwork.show.canvas import WIDER, Canvas, current_layout, plain, points_per_mm, text_width
from crankwork.show.chart import (
    ChartBox,
    Graph,
    Row,
    limits,
    over_cycle,
    round_ticks,
    sheet,
    small_text,
    true_slices,
    write_remark,
)
from crankwork.show.label_placement import label_marks, mark_point
from crankwork.show.scene import DASH_DOT, DASHED, SOLID, STYLES, Drawing

HEIGHT = 216.0
_LONGEST = 16
# a letter with an index and primes
_SYMBOL = re.compile(r"([^\W\d_])_?([^\W_]{0,3})(['′″]*)")
_BAND = 12.0
_FOUR_STROKES = ("intake", "compression", "expansion", "exhaust")
_TWO_STROKES, _COMPRESSOR = ("expansion", "compression"), ("suction", "delivery")
# a cycle of this length has its dead centre of ignition in the middle [deg]
FOUR_STROKE = 720.0
_INDICATOR, _ABOVE = 245.0, 24.0
# crank angles before and after which the cylinder is open [deg], and what share of the diagram its loop may be
_CALM, _FLAT = (180.0, 620.0), 0.1
# where the loop may begin, as shares of the width, and what its numbers take beside it [pt]
_STARTS, _NUMBERS = (0.36, 0.44, 0.52), 36.0

# an inset lower than this shows nothing [pt]
_LOWEST = 60.0


def pressure(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the gas pressure over the cycle with the named points, and that of cylinders that differ."""
    degrees, (key, values) = engine.degrees, diagram(engine)
    other_pressures = {number: _above_zero(engine, other) for number, other in engine.other_pressures.items()}
    names = [translate("drawing.cylinder", engine.language, number=number) for number in (1, *other_pressures)]
    rows = [Row(name, style) for name, style in zip(names, itertools.cycle(STYLES), strict=False)]
    paper, box = banded_sheet(engine, HEIGHT, rows if other_pressures else _ambient(engine))
    graph = over_cycle(paper, box, limits(values, *other_pressures.values()), engine.cycle, engine.language)
    for (number, other), row in zip(other_pressures.items(), rows[1:], strict=True):
        graph.curve(f"{key}.{number}", degrees, other, row.style)
    graph.curve(key, degrees, values)
    _draw_ambient(engine, graph)
    engine.name_axes(graph, "crank_angle", key)
    strokes(engine, graph)
    mark_points(graph, named_points(engine))
    return paper, {"pressure": graph}


def diagram(engine: Drawn) -> tuple[str, Array]:
    """Return the key of what diagrams show, the absolute pressure where the ambient one is known, and its values."""
    space = engine.results.solved.space
    key = "diagram_pressure" if space.ambient and space.gas.factor == 1 else "gas_pressure"
    return key, _above_zero(engine, engine.values("gas_pressure"))


def _above_zero(engine: Drawn, gauge: Array) -> Array:
    """Return pressures as diagrams show them where those above the ambient pressure are known. [display unit]"""
    space = engine.results.solved.space
    return gauge + (engine.shown("ambient_pressure", space.ambient) if space.gas.factor == 1 else 0.0)


def _ambient(engine: Drawn) -> list[Row]:
    """Return the name of the line of the ambient pressure, if diagrams have one."""
    space = engine.results.solved.space
    is_drawn = space.ambient and space.gas.factor == 1
    return [Row(engine.stated("ambient_pressure", space.ambient), DASH_DOT, 0.45)] if is_drawn else []


def _draw_ambient(engine: Drawn, graph: Graph) -> None:
    if _ambient(engine):
        graph.level(float(engine.shown("ambient_pressure", engine.results.solved.space.ambient)), DASH_DOT, "ambient")


def named_points(engine: Drawn) -> list[tuple[str, float, float]]:
    """Return the points of the diagram: name, crank angle [deg] and its pressure [display unit].

    Those of a table over the stroke are too many for names.
    """
    space = engine.results.solved.space
    listed = {name for name, point in space.gas.points.items() if point.inputs}
    return [
        (
            "" if name in listed else _short(name),
            angle,
            float(_above_zero(engine, engine.shown("gas_pressure", space.gauge(value)))),
        )
        for name, (angle, value) in space.diagram.named.items()
    ]


def _short(name: str) -> str:
    """Return the name of a point as it is printed: with a subscript if it has one, shortened if it is long."""
    if symbol := _SYMBOL.fullmatch(name):
        base, index, primes = symbol.groups()
        marks = "″" * (primes == "''") or primes.replace("'", "′")
        return f"${base}{marks}{'_' if index else ''}{index}$"
    known = "".join(letter if letter.isprintable() and letter != "$" else "□" for letter in name)
    return known if len(known) <= _LONGEST else f"{known[: _LONGEST - 1]}…"


def mark_points(graph: Graph, points: Sequence[tuple[str, float, float]]) -> None:
    """Mark named points of a graph, their names clear of what is drawn.

    `points`: name and place in the units of the scales [their units].
    """
    if points:
        graph.curves["points"] = np.array([point[1] for point in points]), np.array([point[2] for point in points])
        places = [(name, *graph.point(x, y)) for name, x, y in points]
        label_marks(graph.paper, [place for place in places if place[0]], frame=graph.box)
        for _, x, y in (place for place in places if not place[0]):
            graph.paper.dot(x, y, 1.5)


def banded_sheet(engine: Drawn, height: float, rows: Sequence[Row] = ()) -> tuple[Canvas, ChartBox]:
    """Return paper with a legend and the place for a graph with a band above it. [pt]"""
    if not _names(engine):
        return sheet(height, rows)
    paper, box = sheet(height + _BAND, rows)
    return paper, box._replace(top=box.top + _BAND, height=box.height - _BAND)


def strokes(engine: Drawn, graph: Graph) -> None:
    """Write the strokes of a cylinder above a graph, each over its half turn."""
    names = [translate(f"drawing.{name}", engine.language) for name in _names(engine)]
    ends = graph.across(np.arange(0.0, engine.cycle + 1, 180.0))
    top = graph.box.top
    if not names or WIDER * max(text_width(name, 7.5) for name in names) > ends[1] - ends[0]:
        return
    lines = [(end, top - _BAND, end, top) for end in ends]
    graph.paper.segments(np.array([*lines, (ends[0], top - _BAND, ends[-1], top - _BAND)]), width=0.45)
    for name, (left, right) in zip(names, pairwise(ends), strict=True):
        small_text(graph.paper, float(left + right) / 2, top - 3.5, name)


def _names(engine: Drawn) -> tuple[str, ...]:
    """Return the keys of the strokes from the first dead centre on, none without gas that does work or takes it."""
    space = engine.results.solved.space
    if space is None or not space.work:
        return ()
    if engine.cycle == FOUR_STROKE:
        return _FOUR_STROKES
    return _TWO_STROKES if space.work > 0 else _COMPRESSOR


def indicator(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the gas pressure over the volume with its named points, and the diagram with sharp corners if known."""
    space = engine.results.solved.space
    volume, (key, values) = engine.values("cylinder_volume"), diagram(engine)
    sharp = space.theoretical
    pressures = [values]
    if sharp is not None:
        absolute = sharp.pressure(engine.degrees, engine.columns["cylinder_volume"])
        pressures.append(_above_zero(engine, engine.shown("gas_pressure", space.gauge(absolute))))
    rows = [Row(translate("drawing.sharp", engine.language), DASHED, 0.9)] if sharp is not None else []
    paper, box = sheet(_INDICATOR + _ABOVE, [*rows, *_ambient(engine)])
    box = box._replace(top=box.top + _ABOVE, height=box.height - _ABOVE)
    ends, reach = limits(*pressures), 1.06 * float(np.max(volume))
    graph = Graph(paper, box, (0.0, reach), ends, engine.language)
    graph.frame(round_ticks(0.0, reach, 8), round_ticks(*ends, 9))
    if sharp is not None:
        graph.curve("theoretical", volume, pressures[1], DASHED, width=0.9, angles=engine.degrees)
    graph.curve(key, volume, values, angles=engine.degrees)
    _draw_ambient(engine, graph)
    engine.name_axes(graph, "cylinder_volume", key)
    _dead_centres(engine, graph)
    points = [
        (name, float(np.interp(angle, engine.degrees, volume)), value) for name, angle, value in named_points(engine)
    ]
    mark_points(graph, points)
    inset = _inset(engine, graph, volume, values)
    return paper, {"indicator": graph} | ({"inset": inset} if inset else {})


def _inset(engine: Drawn, graph: Graph, volume: Array, values: Array) -> Graph | None:
    """Draw the loop of gas exchange larger in a frame where no curve is, above the ambient pressure."""
    left, top, width, height = graph.box
    x, y = graph.across(volume), graph.down(values)
    centre = float(np.max(x))
    for start in _STARTS:
        begin = left + start * width
        box = ChartBox(begin, top + 0.05 * height, centre - 8 - begin, 0.36 * height)
        room = (x > box.left - _NUMBERS) & (y < box.top + box.height + 10) & (x < box.left + box.width)
        if not np.any(room) and box.height >= _LOWEST:
            return gas_exchange(engine, graph.paper, box, volume, values)
    return None


def gas_exchange(engine: Drawn, paper: Canvas, box: ChartBox, volume: Array, pressure: Array) -> Graph | None:
    """Draw the loop of gas exchange of four strokes larger in a frame, with the ambient pressure."""
    calm = (engine.degrees < _CALM[0]) | (engine.degrees > _CALM[1])
    if engine.cycle != FOUR_STROKE or np.ptp(pressure[calm]) > _FLAT * np.ptp(pressure):
        return None
    ambient = float(engine.shown("ambient_pressure", engine.results.solved.space.ambient))
    ends = limits(np.append(pressure[calm], ambient), margin=0.3, is_place=True)
    graph = Graph(paper, box, (0.0, 1.06 * float(np.max(volume))), ends, engine.language)
    box = graph.box
    corners = box.left - _NUMBERS, box.left + box.width, box.top - 6, box.top + box.height + 6
    paper.area([corners[0], corners[1], corners[1], corners[0]], [*corners[2:3] * 2, *corners[3:] * 2], width=0.45)
    graph.frame(np.array([]), round_ticks(*ends, min(5, round(box.height / 16))))
    graph.curve("gas_exchange", *_within(graph, volume, pressure), angles=engine.degrees)
    graph.level(ambient, DASH_DOT, "ambient")
    level = float(graph.down(ambient)) - 3
    small_text(paper, box.left + box.width, level, engine.symbol("ambient_pressure"), "end")
    if current_layout().is_sheet:
        # at the graph, as the scale of the diagrams is another
        value = float(f"{(graph.y[1] - graph.y[0]) / box.height * points_per_mm():.5g}")
        sign, unit = engine.symbol("diagram_pressure").strip("$"), engine.unit("diagram_pressure")
        text = f"{math_symbol(f'μ_{sign}')} = {engine.number(value)} {unit}/{unit_name('mm', engine.language)}"
        paper.text(box.left + box.width / 2, box.top + box.height + 16, text, anchor="middle")
    return graph


def _within(graph: Graph, x: Array, y: Array) -> tuple[Array, Array]:
    """Return a curve with gaps where it leaves the graph."""
    low, high = sorted(graph.y)
    return x, np.where((y < low) | (y > high), np.nan, y)


def _dead_centres(engine: Drawn, graph: Graph) -> None:
    """Mark the volumes at the dead centres, clearance and swept volume above."""
    space, paper, box = engine.results.solved.space, graph.paper, graph.box
    volumes = [
        float(engine.shown("cylinder_volume", size)) for size in (space.clearance, space.clearance + space.swept)
    ]
    for name, volume in zip(("tdc", "bdc"), volumes, strict=True):
        x = float(graph.across(volume))
        down = np.array([box.top - 6, box.top + box.height])
        paper.line([x, x], down, style=DASH_DOT, width=0.45)
        small_text(paper, x, box.top - 17, translate(f"drawing.{name}", engine.language))
    level = box.top - 4
    spans = (("clearance_volume", 0.0, volumes[0]), ("swept_volume", volumes[0], volumes[1]))
    for key, start, end in spans:
        left, right = float(graph.across(start)), float(graph.across(end))
        middle = (left + right) / 2
        paper.arrow((middle, level), (left, level), width=0.45)
        paper.arrow((middle, level), (right, level), width=0.45)
        paper.text(middle, level - 3, engine.symbol(key), size=8, anchor="middle")


def log_indicator(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the decimal logarithms of pressure and volume, in which polytropes are straight."""
    key, absolute = diagram(engine)
    volume, pressure = (np.log10(np.maximum(values, 1e-9)) for values in (engine.values("cylinder_volume"), absolute))
    paper, box = sheet(_INDICATOR)
    across, up = (limits(values, is_place=True) for values in (volume, pressure))
    graph = Graph(paper, box, across, up, engine.language)
    graph.frame(round_ticks(*across, 8), round_ticks(*up, 9))
    graph.curve(key, volume, pressure, angles=engine.degrees)
    graph.x_title(f"lg {engine.symbol('cylinder_volume')} ({engine.unit('cylinder_volume')})")
    graph.y_title(f"lg {engine.symbol(key)} ({engine.unit(key)})")
    return paper, {"log_indicator": graph}


def recorded_cycles(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the indicated mean pressure of every recorded cycle, with their mean."""
    listed, key = engine.results.listings["recorded_cycles"].columns, "indicated_mean_pressure"
    numbers, values = listed["cycle_number"], engine.shown(key, listed[key])
    paper, box = sheet(_INDICATOR / 2)
    ends = limits(values, margin=0.2, is_place=True)
    graph = Graph(paper, box, (0.0, float(numbers[-1]) + 1), ends, engine.language)
    graph.frame(round_ticks(0.0, float(numbers[-1]), 10), round_ticks(*ends, 6))
    graph.curve(key, numbers, values)
    graph.level(float(np.mean(values)), DASHED, "mean")
    engine.name_axes(graph, "cycle_number", key)
    return paper, {"recorded_cycles": graph}


def willans(test: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return fuel over brake power with its straight line, which meets the axis of powers at the power of losses."""
    results, keys = test.results, ("effective_power", "fuel_rate")
    power, rate = (test.shown(key, results.listings["willans"].columns[key]) for key in keys)
    loss, idle = (float(test.shown(key, results.summary[key])) for key in ("willans_loss_power", "idle_fuel_rate"))
    ends = np.array([-loss, 0.0, float(np.max(power))])
    line = idle * (1 + ends / loss)
    paper, box = sheet(_INDICATOR)
    # room for names left of the dashed line
    across, up = limits(2 * ends[:1], ends), limits(rate, line)
    graph = Graph(paper, box, across, up, test.language)
    graph.frame(round_ticks(*across), round_ticks(*up))
    paper.segments(np.array([(*graph.point(0.0, up[0]), *graph.point(0.0, up[1]))]), width=0.45)
    graph.curve("extended", ends[:2], line[:2], DASHED)
    graph.curve("fuel_rate", ends[1:], line[1:])
    for x, y in zip(power.tolist(), rate.tolist(), strict=True):
        paper.dot(*graph.point(x, y), 2.0)
    for key, x, y in (("willans_loss_power", -loss, 0.0), ("idle_fuel_rate", 0.0, idle)):
        mark_point(graph, key, x, y, f"{test.symbol(key)} = {test.value(key, results.summary[key])}")
    test.name_axes(graph, *keys)
    return paper, {"willans": graph}


def _number(chamber: str) -> str:
    """Return the Roman number of a chamber, or its name; a link of the same name has a number of its own."""
    return chamber if number_of(chamber).isdecimal() else number_of(chamber)


def chamber_indicator(machine: Drawn) -> Drawing:
    """Return pressure over volume of every chamber."""
    results = machine.results
    # tables of a law over time go by time
    factor = results.period / 360.0 if results.period else 1.0
    diagrams = indicators(results)
    curves = {plain(name): (*diagram[:2], diagram.degrees * factor) for name, diagram in diagrams.items()}
    known = {_number(name): name for name in diagrams if _number(name) != name} if len(diagrams) > 1 else {}
    return _indicators(machine, curves, "indicator", "; ".join(key_of_links(known, known, machine.language)))


def stage_indicator(machine: Drawn) -> Drawing:
    """Return pressure over volume of one side of the piston of every stage."""
    curves = {
        translate("drawing.stage", machine.language, number=number): (*diagram, None)
        for number, diagram in stage_diagrams(machine.results).items()
    }
    return _indicators(machine, curves, "stage_indicator")


def _moments(across: Array, up: Array) -> tuple[float, ...]:
    """Return area and first moments of a closed curve in a square of one: curves of one size differ in them."""
    x, y = ((values - values.min()) / (np.ptp(values) or 1.0) for values in (across, up))
    return tuple(abs(float(np.trapezoid(part, x))) for part in (y, x * y, y * y))


def _indicators(
    machine: Drawn, curves: Mapping[str, tuple[Array, Array, Array | None]], title: str, remark: str = ""
) -> Drawing:
    """Return closed curves of pressure over volume by name, with the angles of their points. [SI]"""
    style, volume, pressure = machine.style, quantity_of("cylinder_volume"), quantity_of("diagram_pressure")
    drawn = {
        name: (displayed_values(volume, across), displayed_values(pressure, up), angles)
        for name, (across, up, angles) in curves.items()
    }
    equal = dict[tuple[float, ...], list[str]]()
    for name, (across, up, _) in drawn.items():
        sizes = (across.min(), across.max(), up.min(), up.max(), *_moments(across, up))
        equal.setdefault(tuple(round(float(size), 6) + 0.0 for size in sizes), []).append(name)
    rows = (
        [Row(", ".join(map(_number, names)), STYLES[k % 4]) for k, names in enumerate(equal.values())]
        if len(drawn) > 1
        else []
    )
    paper, box = sheet(259.0, rows)
    x, y = (limits(*values, margin=0.05) for values in list(zip(*drawn.values(), strict=True))[:2])
    graph = Graph(paper, box, x, y, style.language)
    graph.frame(round_ticks(*x), round_ticks(*y, 10))
    for k, (first, *further) in enumerate(equal.values()):
        across, up, angles = drawn[first]
        graph.curves |= {name: drawn[name][:2] for name in further}
        graph.curve(first, across, up, STYLES[k % 4], angles=angles)
    graph.x_title(axis_title(volume, style.language))
    graph.y_title(axis_title(pressure, style.language))
    write_remark(paper, remark)
    return paper.drawing(translate(f"figures.{title}", style.language), style.language)


def _named(machine: Drawn, key: str) -> str:
    """Return symbol and name of what a part has."""
    quantity = quantity_of(key)
    return (
        f"{math_symbol(quantity.symbol(machine.language))} – {machine.named(key_of(key).quantity).partition(' – ')[2]}"
    )


def rod_loads(machine: Drawn, slider: str) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the loads of a piston rod and of its crosshead pin over the cycle, the reversed load of the pin shaded."""
    degrees, keys = machine.reached.degrees, ("crosshead_load", "piston_rod_load", "rod_load")
    values = [machine.shown(key, machine.reached.columns[f"{key}.{slider}"]) for key in keys]
    duration = machine.value("reversal_duration", machine.results.summary[f"reversal_duration.{slider}"])
    names = [_named(machine, f"{key}.{slider}") for key in keys]
    rows = [Row(name, style) for name, style in zip(names, STYLES, strict=False)]
    rows.append(Row(translate("drawing.reversed", machine.language, duration=duration), SOLID, 0.0))
    paper, box = sheet(HEIGHT, rows)
    graph = over_cycle(paper, box, limits(*values), machine.cycle, machine.language)
    is_shorter = values[0] < 0
    if np.trapezoid(is_shorter, degrees) > machine.cycle / 2:
        is_shorter = values[0] > 0
    for part in true_slices(is_shorter):
        inside = degrees[part]
        graph.shade(np.append(inside, inside[::-1]), np.append(values[0][part], np.zeros(inside.size)))
    for key, load, style in zip(keys, values, STYLES, strict=False):
        graph.curve(f"{key}.{slider}", degrees, load, style)
    machine.name_axes(graph, "crank_angle", "crosshead_load")
    return paper, {"rod_loads": graph}


def pump_flow(machine: Drawn, vessel: str) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the flow at a vessel over the cycle with its mean."""
    degrees, key = machine.reached.degrees, f"vessel_flow.{vessel}"
    mean, values = machine.results.summary[f"mean_flow.{vessel}"], machine.shown(key, machine.reached.columns[key])
    rows = [Row(_named(machine, key), SOLID), Row(machine.stated("mean_flow", mean), DASH_DOT, 0.45)]
    paper, box = sheet(HEIGHT, rows)
    graph = over_cycle(paper, box, limits(values, np.zeros(1)), machine.cycle, machine.language)
    graph.curve(key, degrees, values)
    graph.level(float(machine.shown("mean_flow", mean)), DASH_DOT, "mean")
    machine.name_axes(graph, "crank_angle", "vessel_flow")
    return paper, {"pump_flow": graph}
