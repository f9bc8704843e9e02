"""Constructions of textbooks: Brix's circle for the displacement of a piston, Tolle's tangents for its acceleration."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.diagrams import BrixPoints, brix_points, tangent_ends, tolle_parabola, tolle_points
from crankwork.locale import say
from crankwork.report.engine_figure_data import EngineDrawn
from crankwork.show.chart import ChartBox, Graph, Row, limits, round_ticks, sheet
from crankwork.show.labels import label_marks
from crankwork.show.paper import GREY, Canvas
from crankwork.show.place import current_layout, scaled_height
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID

_SIDES = ("AC", "BD", "CD", "EF", "CF", "FD")
_STEP = 30.0
_CIRCLE, _MARGIN, _TITLES = 190.0, 26.0, 44.0


def brix(engine: EngineDrawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return Brix's circle beside the displacement over the crank angle, on one vertical scale."""
    lengths = engine.results.solved.lengths
    degrees, radius = engine.degrees, float(engine.shown("piston_displacement", lengths.crank_radius))
    turn = degrees <= 360
    degrees, exact = degrees[turn], engine.values("piston_displacement")[turn]
    circle = brix_points(lengths, degrees)
    error = float(np.max(np.abs(radius * (1 - circle.up) - exact)))
    shift = engine.value("piston_displacement", float(lengths.crank_radius * lengths.rod_ratio / 2))
    difference = f"{engine.number(error, 2)} {engine.unit('piston_displacement')}"
    half = f"{engine.symbol('rod_ratio')}{engine.symbol('crank_radius')}/2"
    rows = [
        Row(f"{say('drawing.brix_circle', engine.language)} OO′ = {half} = {shift}"),
        Row(
            say("drawing.brix_error", engine.language, symbol=engine.symbol("piston_displacement"), value=difference),
            width=0.0,
        ),
    ]
    side = min(scaled_height(_CIRCLE), 0.45 * current_layout().width)
    height = side * max(1.0, float(exact.max()) / (2 * radius))
    paper, box = sheet((height + _MARGIN - 10) / current_layout().tall, rows)
    top = box.top + _MARGIN - 14
    left = _MARGIN + side + _MARGIN - 6 + _TITLES
    graph_box = ChartBox(left, top, current_layout().width - left - current_layout().right, height)
    graph = Graph(paper, graph_box, (0.0, 360.0), (float(exact.max()), 0.0), engine.language, "crank_angle")
    ring = Graph(paper, ChartBox(_MARGIN, top, side, side), (-radius, radius), (-radius, radius), engine.language)
    marks = np.arange(0.0, 360.0, _STEP)
    points = brix_points(lengths, marks)
    _projections(ring, graph, points, radius, marks)
    _rays(engine, ring, points, radius, marks)
    ticks = round_ticks(0.0, float(exact.max()), 8)
    for level in graph.down(ticks):
        corners = [left - 28, left - 4, left - 4, left - 28], [level - 5, level - 5, level + 5, level + 5]
        paper.area(*corners)
    graph.frame(np.arange(0.0, 361.0, 60.0), ticks)
    graph.curve("displacement", degrees, exact)
    graph.curves["construction"] = degrees, radius * (1 - circle.up)
    graph.x_title(engine.title("crank_angle"))
    title = engine.title("piston_displacement")
    graph.set_quantity(title)
    paper.text(current_layout().width - current_layout().right, top - 10, title, anchor="end")
    return paper, {"circle": ring, "displacement": graph}


def _rays(engine: EngineDrawn, ring: Graph, points: BrixPoints, radius: float, marks: Array) -> None:
    """Draw the circle with its axes, the rays from the pole and their angles."""
    around = np.radians(np.arange(0.0, 361.0, 3.0))
    ring.curve("circle", radius * np.sin(around), radius * np.cos(around))
    axis = -points.pole / np.hypot(*points.pole) * radius * 1.08
    for x, y in (axis, (axis[1], -axis[0])):
        ring.paper.line(ring.across(np.array([-x, x])), ring.down(np.array([-y, y])), style=DASH_DOT, width=0.6)
    pole = radius * points.pole
    x, y = ring.across(radius * points.across), ring.down(radius * points.up)
    start = ring.point(float(pole[0]), float(pole[1]))
    centre = ring.point(0.0, 0.0)
    ring.paper.segments(np.column_stack([np.full_like(x, start[0]), np.full_like(y, start[1]), x, y]), width=0.6)
    ring.curves["points"] = radius * points.across, radius * points.up
    for mark, a, b in zip(marks, x, y, strict=True):
        ring.paper.dot(float(a), float(b), 1.4)
        out = np.array([a, b]) - centre
        place = np.array(centre) + out * (1 + 12 / float(np.hypot(*out)))
        ring.text_on_white(float(place[0]), float(place[1]) + 2.8, engine.number(float(mark)), "middle", 7.5)
    label_marks(ring.paper, [("O′", *start), ("O", *centre)], dot=0.0, frame=ring.box)
    for origin in (start, centre):
        ring.paper.dot(*origin, 2.0, fill="#ffffff", width=0.9)


def _projections(ring: Graph, graph: Graph, points: BrixPoints, radius: float, marks: Array) -> None:
    """Draw the lines from the points of the right half of the circle to the curve."""
    for mark, across, up in zip(marks, points.across, points.up, strict=True):
        if mark <= 180:
            x, y = ring.point(radius * float(across), radius * float(up))
            end = float(graph.across(mark))
            graph.paper.segments(np.array([[x, y, end, y]]), width=0.5, colour=GREY)
            graph.paper.dot(end, y, 1.4)


def tolle(engine: EngineDrawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the acceleration over the displacement, and the tangents that envelop it by Tolle's construction."""
    lengths = engine.results.solved.lengths
    ratio, radius = float(lengths.rod_ratio), float(engine.shown("piston_displacement", lengths.crank_radius))
    unit = float(engine.shown("piston_acceleration", lengths.crank_radius * engine.results.solved.speed**2))
    turn = engine.degrees <= 360
    x, y = engine.values("piston_displacement")[turn], engine.values("piston_acceleration")[turn]
    points = tolle_points(ratio)
    corners = {name.upper(): (a * radius, b * unit) for name, (a, b) in points._asdict().items()}
    along, up = tolle_parabola(ratio)
    parabola = radius * along, unit * up
    rows = [
        Row(engine.title("piston_acceleration").rpartition(",")[0]),
        Row(say("drawing.tangents", engine.language), width=0.5),
    ]
    differs = float(np.max(np.abs(np.interp(x, *parabola) - y))) > 2e-3 * unit
    if differs:
        rows.insert(1, Row(say("drawing.parabola", engine.language), DOTTED, 1.0))
    paper, box = sheet(270.0, rows)
    low, high = limits(np.array([corner[1] for corner in corners.values()]), y, margin=0.09)
    room = 0.04 * 2 * radius
    graph = Graph(paper, box, (-room, max(2 * radius, float(x.max())) + room), (low, high), engine.language)
    graph.frame(round_ticks(0.0, graph.x[1], 8), round_ticks(low, high, 9))
    tangents = tangent_ends(corners["C"], corners["F"], corners["D"])
    ends = np.column_stack([graph.across(tangents[:, 0]), graph.down(tangents[:, 1]),
                            graph.across(tangents[:, 2]), graph.down(tangents[:, 3])])  # fmt: skip
    paper.segments(ends, width=0.5)
    graph.curves["tangents"] = tangents[:, [0, 2]], tangents[:, [1, 3]]
    for first, second in map(tuple, _SIDES):
        pair = np.array([corners[first], corners[second]])
        graph.curve(first + second, pair[:, 0], pair[:, 1], DASHED if first + second == "CD" else SOLID, width=0.7)
    graph.curves["parabola"] = parabola
    if differs:
        graph.curve("parabola", *parabola, DOTTED, width=1.0)
    graph.curve("acceleration", x, y, width=1.6)
    places = [(name, *graph.point(*place)) for name, place in corners.items()]
    label_marks(paper, [*places, *_numbered(graph, tangents)], frame=box)
    graph.x_title(engine.title("piston_displacement"))
    graph.y_title(engine.title("piston_acceleration"), 48.0)
    return paper, {"tolle": graph}


def _numbered(graph: Graph, tangents: Array) -> list[tuple[str, float, float]]:
    """Return the parts of the two outer tangents with their numbers, where they stand on the paper."""
    numbered = [(f"{index}", *graph.point(*row[:2])) for index, row in enumerate(tangents.tolist(), start=1)]
    return numbered + [(f"{index}′", *graph.point(*row[2:])) for index, row in enumerate(tangents.tolist(), start=1)]
