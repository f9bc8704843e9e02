"""The energy-mass diagram with its tangents, and the angular speed that follows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.diagrams import Fluctuation, Tangents, tangents
from crankwork.locale import say
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.figure_data import figure_title
from crankwork.report.language import symbol
from crankwork.report.linkage_look import (
    PLAIN,
    Style,
    axis_title,
    displayed_values,
    drive_graph,
    quantity_of,
    scale_text,
)
from crankwork.show.chart import Graph, Row, round_ticks, sheet, write_method
from crankwork.show.labels import label_marks, label_points
from crankwork.show.place import current_layout, points_per_mm, round_scale, scaled_height
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, Drawing
from crankwork.units import METRIC, use_units

_TALL, _WIDE = 331.0, 1.08
# how much taller it may be for a round scale; how far tangents are drawn beyond the curve, of its width
_TALLER, _BEYOND = 1.3, 0.12

Ends = tuple[float, float]


def wittenbauer(inertia: Array, energy: Array, wanted: Fluctuation, degrees: Array, style: Style = PLAIN) -> Drawing:
    """Return the energy-mass diagram, its tangents and the piece kl that they cut from the energy axis.

    `inertia` and `energy`: reduced moment of inertia [kg m2] and change of the kinetic energy [J] over one cycle;
    `degrees`: crank angles; every thirtieth degree is marked [deg].
    """
    construction, language = tangents(inertia, energy, wanted), style.language
    # slopes and angles are those of J over kg m2
    with use_units(METRIC):
        ends, scales = _ends(inertia, energy, construction)
        slopes = (construction.slope_max, DASHED, "max"), (construction.slope_min, DASH_DOT, "min")
        rows = [Row(_angle(scales.x / scales.y, slope, name, language), line, 0.9) for slope, line, name in slopes]
        if not current_layout().is_sheet:
            # a sheet has them over every graph
            rows.append(Row(_scales(scales, language), width=0.0))
        paper, box = sheet((ends[1][1] - ends[1][0]) / scales.y * points_per_mm() / scaled_height(1.0), rows)
        graph = Graph(paper, box, *ends, language)
        graph.frame(round_ticks(*graph.x), graph.up_ticks)
        _lines(graph, inertia, energy, construction, degrees)
        graph.x_title(axis_title(QUANTITIES["reduced_inertia"], language))
        graph.y_title(axis_title(QUANTITIES["kinetic_energy_change"], language))
        cut = number((construction.foot_max - construction.foot_min) / scales.y, language, digits=5)
        shown = f"{number(construction.flywheel, language, digits=4)} {unit_name('kg*m2', language)}"
        tan = "tg" if language == "ru" else "tan"
        formula = f"$μ_J$ $kl$/({tan} $ψ_max$ − {tan} $ψ_min$) = {shown}"
        foot = f"$kl$ = {cut} {unit_name('mm', language)}; {say('drawing.flywheel', language)}: {formula}"
        write_method(paper, style.method, foot)
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
    words = say("drawing.slope", language)
    unit = f"{unit_name('J', language)}/({unit_name('kg*m2', language)})"
    return f"$ψ_{name}$ = {number(angle, language, digits=6)}°; {words} {number(slope, language, digits=4)} {unit}"


def speed_curve(degrees: Array, speed: Array, evenness: Fluctuation, style: Style = PLAIN) -> Drawing:
    """Return the angular speed of the crank over one cycle, with its largest and smallest value.

    `evenness`: the mean and the fluctuation, as the results have them.
    """
    language, row = style.language, quantity_of("speed")
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
    write_method(paper, style.method)
    return paper.drawing(figure_title("speed", language), language)
