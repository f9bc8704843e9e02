"""Velocity and acceleration plans as figures: vectors from the pole to scale, and what each of them is."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from crankwork.analysis.moving import Moving
from crankwork.analysis.plans import Kind, Plan, Vector, accelerations, velocities
from crankwork.locale import say
from crankwork.locale.numbers import number, unit_name
from crankwork.mechanism.mechanism import Mechanism
from crankwork.quantities import Language
from crankwork.report.figure_data import figure_title
from crankwork.report.language import symbol
from crankwork.report.linkage_look import (
    PLAIN,
    POINTS_PER_MM,
    Style,
    math_symbol,
    position_sign,
    position_text,
    round_scale,
    scale_text,
)
from crankwork.show.chart import WIDTH, Box, Graph, sign
from crankwork.show.labels import Line, label_points
from crankwork.show.paper import Paper
from crankwork.show.scene import DASH_DOT, DASHED, SOLID, Drawing
from crankwork.show.scene import Style as Dashes

_SIDE, _TALL, _MARGIN, _LIST, _ROW = 290.0, 330.0, 26.0, 150.0, 13.5
_UNDER = 3
_LOOKS: dict[Kind, tuple[float, Dashes]] = {
    "absolute": (1.6, SOLID), "relative": (0.9, SOLID), "tangential": (0.9, SOLID), "sliding": (0.9, SOLID),
    "normal": (0.9, DASHED), "coriolis": (0.9, DASH_DOT),
}  # fmt: skip
_MARKS: dict[Kind, str] = {
    "absolute": "", "relative": "", "normal": "^n", "tangential": "^t", "coriolis": "^k", "sliding": "^r"
}  # fmt: skip


class _Kind(NamedTuple):
    """Velocities or accelerations: title, symbol, unit, symbol and unit of turning, pole, the plan's own letter."""

    title: str
    sign: str
    unit: str
    turning: str
    turning_unit: str
    pole: str


def velocity_plan(mechanism: Mechanism, moving: Moving, index: int, speed: float, style: Style = PLAIN) -> Drawing:
    """Return the velocity plan of a linkage at one crank angle."""
    kind = _Kind("velocity_plan", "v", "m/s", symbol("speed", style.language), "rad/s", "p")
    return _figure(velocities(mechanism, moving, index, speed, style.links), kind, moving.degrees[index], style)


def acceleration_plan(
    mechanism: Mechanism,
    moving: Moving,
    index: int,
    speed: float,
    angular_acceleration: float = 0.0,
    style: Style = PLAIN,
) -> Drawing:
    """Return the acceleration plan of a linkage at one crank angle."""
    plan = accelerations(mechanism, moving, index, speed, angular_acceleration, style.links)
    pole = "q" if style.language == "en" else "π"
    kind = _Kind("acceleration_plan", "a", "m/s2", symbol("angular_acceleration", style.language), "rad/s2", pole)
    return _figure(plan, kind, moving.degrees[index], style)


def _figure(plan: Plan, kind: _Kind, degrees: float, style: Style) -> Drawing:
    """Draw a plan, and beside it what its vectors and the turning of the links are."""
    language = style.language
    seen = [one for one in plan.vectors if one.length > 1e-9 * max(other.length for other in plan.vectors)]
    places = np.array([[0.0, 0.0], *(end for one in seen for end in (one.start, one.end))])
    width, height = np.maximum(np.ptp(places, axis=0), 1e-12)
    scale = round_scale(float(POINTS_PER_MM * max(width / (_SIDE - 2 * _MARGIN), height / (_TALL - 2 * _MARGIN))))
    unit = POINTS_PER_MM / scale
    rows = _rows(seen, plan, kind, language)
    tall = max(float(height) * unit + 2 * _MARGIN, _ROW * len(rows) + 30) + 34
    paper = Paper(WIDTH, tall)
    middle = (places.min(axis=0) + places.max(axis=0)) / 2 * unit
    left, bottom = middle[0] - _SIDE / 2, middle[1] - (tall + 34) / 2
    graph = Graph(paper, Box(0.0, 0.0, WIDTH, tall), (left, left + WIDTH), (bottom, bottom + tall), language)
    _vectors(graph, seen, unit)
    _nodes(graph, plan, kind.pole, seen, unit)
    for count, row in enumerate(rows):
        paper.text(WIDTH - _LIST, 23 + _ROW * count, row, size=8.5)
    paper.text(14, tall - 20, scale_text(f"μ_{kind.sign}", scale, kind.unit, language))
    shown = f"{position_sign(style)} = {position_text(float(degrees), style)}"
    paper.text(WIDTH - 14, tall - 20, shown, anchor="end")
    sign(paper, style.method, _remark(plan, kind, language))
    return paper.drawing(f"{figure_title(kind.title, language)}, {position_text(float(degrees), style)}", language)


def _remark(plan: Plan, kind: _Kind, language: Language) -> str:
    """Return what the sign of turning means, and what a point with the number of a link is."""
    remarks = [say("drawing.anticlockwise", language, symbol=kind.turning)]
    if plan.beneath:
        some = list(plan.beneath.items())[:_UNDER]
        points, links = (_plain(name) for name, _ in some), (str(link) for _, (link, _) in some)
        others = (_plain(one) for _, (_, one) in some)
        joined = {"points": ", ".join(points), "links": ", ".join(links), "others": ", ".join(others)}
        remarks.append(say("drawing.beneath", language, **joined))
    return "; ".join(remarks)


def _vectors(graph: Graph, vectors: list[Vector], unit: float) -> None:
    for one in vectors:
        width, line = _LOOKS[one.kind]
        start, end = (graph.point(*(place * unit)) for place in (one.start, one.end))
        if one.length * unit > 6:
            graph.paper.arrow(start, end, width=width, style=line)
        else:
            graph.paper.line([start[0], end[0]], [start[1], end[1]], width=width, style=line)


def _nodes(graph: Graph, plan: Plan, pole: str, vectors: list[Vector], unit: float) -> None:
    """Name the pole and the ends of the vectors."""
    taken = {node_name(name) for name in plan.nodes}
    points = [(next(one for one in (pole, "o", f"{pole}₀") if one not in taken), 0.0, 0.0)]
    points += [(node_name(name), float(at[0] * unit), float(at[1] * unit)) for name, at in plan.nodes.items()
               if np.hypot(*at) * unit > 1.0]  # fmt: skip
    lines: list[Line] = [tuple(np.array([one.start, one.end]).T * unit) for one in vectors]
    label_points(graph, points, *lines)


def node_name(letter: str) -> str:
    """Return the letter of the end of a vector: that of its point, small."""
    return letter[0].lower() + letter[1:] if len(letter) <= 3 else letter


def _rows(vectors: list[Vector], plan: Plan, kind: _Kind, language: Language) -> list[str]:
    """Return the magnitudes of the vectors and the turning of the links."""
    rows, unit = [], unit_name(kind.unit, language)
    for one in vectors:
        mark = _MARKS[one.kind] if kind.sign == "a" else ""
        name = math_symbol(f"{kind.sign}_{_plain(one.of)}").removesuffix("$")
        rows.append(f"{name}{mark}$ = {number(one.length, language, digits=4)} {unit}")
    unit = unit_name(kind.turning_unit, language)
    for link, value in plan.turning.items():
        if abs(value) > 1e-9 * max(abs(one) for one in plan.turning.values()):
            name = math_symbol(f"{kind.turning}_{link}")
            rows.append(f"{name} = {number(value, language, digits=4)} {unit}")
    return rows


def _plain(name: str) -> str:
    """Return a name without what mathtext would read."""
    return "".join(one if one.isalnum() or one in "′'. " else "-" for one in name)
