"""The figures of speed and flywheel: excess work, speed over the cycle, the energy-mass diagram."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.constructions import Fluctuation, Tangents, tangents
from crankwork.analysis.given_torques import turning_diagram
from crankwork.locale import texts, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.display import symbol
from crankwork.report.look import (
    Drawn,
    axis_title,
    displayed_values,
    drive_graph,
    figure_title,
    quantity_of,
    scale_text,
)
from crankwork.show.canvas import GREY, Canvas
from crankwork.show.chart import BOTTOM, TOP, ChartBox, Graph, Row, limits, over_cycle, round_ticks, sheet, write_remark
from crankwork.show.chart_layout import current_layout, is_narrow, points_per_mm, round_scale, scaled_height
from crankwork.show.label_placement import label_marks, label_points, mark_point
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, Drawing
from crankwork.units import METRIC, use_units

_PANEL_GAP, _NAMES = 15.0, 24.0
_TALL, _WIDE = 331.0, 1.08
# share of an excess work by which two are the same
_SAME = 1e-6
# how much taller it may be for a round scale; how far tangents are drawn beyond the curve, of its width
_TALLER, _BEYOND = 1.3, 0.12

Ends = tuple[float, float]


def excess_work(engine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
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
