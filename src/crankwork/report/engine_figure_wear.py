"""The wear diagrams of crankpins and main journals."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.engine_diagrams import WearRing, wear_rings
from crankwork.locale import say
from crankwork.report.engine_figure_data import EngineDrawn
from crankwork.report.language import row_name
from crankwork.show.chart import TOP, Box, Graph, small_text
from crankwork.show.paper import GREY, WIDER, Paper, fitted_lines
from crankwork.show.place import here, tall
from crankwork.show.scene import DASH_DOT

# The largest sum takes this share of the radius of the journal.
_DEEPEST = 0.45
_FOOT, _GAP, _ROOM, _HEAD = 40.0, 14.0, 26.0, 14.0
_HATCH = 4.0
# on a sheet none takes the room of other diagrams [pt]
_LARGEST = 270.0


def crankpin_wear(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the wear rings of all unlike crankpins."""
    return _rings(engine, "crankpin_wear", "crankpin")


def main_wear(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the wear rings of all main journals."""
    return _rings(engine, "main_wear", "main_journal")


def _rings(engine: EngineDrawn, listing: str, thing: str) -> tuple[Paper, Mapping[str, Graph]]:
    """Draw the rings of a listing side by side, depths on one scale."""
    angles, rings = wear_rings(engine.drawn.results, listing)
    rings = {name: one._replace(sums=engine.shown("wear_sum", one.sums)) for name, one in rings.items()}
    across = len(rings) if len(rings) < 3 else 2 if len(rings) == 4 else 3
    lines = -(-len(rings) // across)
    side = min(
        (here().width - 24 - (across - 1) * _GAP) / across, tall(290.0), _LARGEST if here().is_sheet else math.inf
    )
    start = (here().width - across * side - (across - 1) * _GAP) / 2
    # across a ring its angle would stand on the worn surface
    below = 10.0 * any(one.hole.arc < 360 for one in rings.values())
    head = (_HEAD if len(rings) > 1 else 0.0) + below
    paper = Paper(here().width, TOP + lines * (side + head) + (lines - 1) * _GAP + _FOOT)
    deepest = max(float(one.sums.max()) for one in rings.values()) or 1.0
    graphs = {}
    for at, (name, one) in enumerate(rings.items()):
        top = TOP + (at // across) * (side + head + _GAP) + head
        box = Box(start + (at % across) * (side + _GAP), top, side, side)
        graphs[name] = _ring(engine, paper, box, angles, one, deepest)
        if len(rings) > 1:
            small_text(paper, box.left + side / 2, top - 4 - below, row_name(f"{thing}.{name}", engine.language))
        if one.hole.arc < 360:
            angle = engine.number(one.hole.angle, 4)
            hole = say("drawing.oil_hole_at", engine.language, angle=angle)
            small_text(paper, box.left + side / 2, top - 3, hole)
    unit = engine.unit("wear_sum")
    largest = say("drawing.largest", engine.language, value=f"{engine.number(deepest, 4)} {unit}")
    text = f"{engine.symbol('wear_sum')} – {largest}; {say('drawing.worn', engine.language)}"
    frame = say("drawing.crank_up" if thing == "crankpin" else "drawing.crank_one", engine.language)
    rows = [row for one in (text, frame) for row in fitted_lines(one, 8, here().width / WIDER)]
    for at, row in enumerate(rows):
        paper.text(here().width / 2, paper.height - 35 + 12 * at, row, size=8, anchor="middle")
    return paper, graphs


def _ring(engine: EngineDrawn, paper: Paper, box: Box, angles: Array, ring: WearRing, deepest: float) -> Graph:
    """Draw a journal of radius 1, what is worn off it, its numbered rays and its oil hole."""
    reach = 1 + _ROOM / (box.width / 2 - _ROOM)
    graph = Graph(paper, box, (-reach, reach), (-reach, reach), engine.language, to_scale=False)
    depth = _DEEPEST * ring.sums / deepest
    fine = np.arange(0.0, 361.0, 2.0)
    worn = 1 - np.interp(fine, angles, depth, period=360)
    direction = _towards(fine)
    _hatch(graph, fine, worn)
    graph.curve("journal", *direction, width=1.4)
    graph.curve("worn", *(direction * worn), width=1.0)
    rays = _towards(angles)
    inner = rays * (1 - depth)
    x, y = graph.across(inner[0]), graph.down(inner[1])
    outer = rays * (1 + 5 / (box.width / 2 - _ROOM))
    graph.paper.segments(np.column_stack([x, y, graph.across(outer[0]), graph.down(outer[1])]), width=0.6)
    graph.curves["ends"] = inner[0], inner[1]
    step = 1 if len(angles) <= 12 or box.width > 200 else 2
    for at in range(0, len(angles), step):
        place = rays[:, at] * (1 + 14 / (box.width / 2 - _ROOM))
        small_text(paper, float(graph.across(place[0])), float(graph.down(place[1])) + 2.7, str(at + 1))
    cross = np.array([[-0.12, 0, 0.12, 0], [0, -0.12, 0, 0.12]])
    centre = [graph.across(cross[:, 0]), graph.down(cross[:, 1]), graph.across(cross[:, 2]), graph.down(cross[:, 3])]
    paper.segments(np.column_stack(centre), width=0.6)
    _hole(graph, ring)
    return graph


def _hole(graph: Graph, ring: WearRing) -> None:
    """Draw the oil hole from the surface to the middle."""
    hole = ring.hole
    if hole.arc == 360:
        return
    axis = _towards(np.array([hole.angle]))[:, 0]
    beside = np.array([axis[1], -axis[0]]) * 0.045
    walls = [np.array([beside * side, axis + beside * side]).T for side in (-1, 1)]
    for wall in walls:
        graph.paper.line(graph.across(wall[0]), graph.down(wall[1]), width=0.9)
    end = axis * 0.98
    graph.curve("oil_hole", [0.0, end[0]], [0.0, end[1]], DASH_DOT, width=0.6)


def _hatch(graph: Graph, angles: Array, worn: Array) -> None:
    """Hatch the ring between the worn surface and the journal, under 45 degrees."""
    radius = float(graph.across(1.0) - graph.across(0.0))
    along = np.arange(-radius, radius, 0.6)
    offsets = np.arange(-radius, radius, _HATCH)
    a, b = np.meshgrid(along, offsets)
    x, y = (a + b) / np.sqrt(2), (a - b) / np.sqrt(2)
    distance = np.hypot(x, y) / radius
    edge = np.interp(np.degrees(np.arctan2(x, y)), angles, worn, period=360)
    inside = np.pad((distance >= edge) & (distance <= 1), ((0, 0), (1, 1)))
    row, start = np.nonzero(inside[:, 1:] & ~inside[:, :-1])
    _, end = np.nonzero(inside[:, :-1] & ~inside[:, 1:])
    x0, y0 = float(graph.across(0.0)), float(graph.down(0.0))
    ends = np.column_stack([x0 + x[row, start], y0 - y[row, start], x0 + x[row, end - 1], y0 - y[row, end - 1]])
    graph.paper.segments(ends, width=0.4, colour=GREY)


def _towards(angles: Array) -> Array:
    """Return unit vectors, to the right and upward, clockwise from the upward direction, shape (2, n). [deg]"""
    return np.array([np.sin(np.radians(angles)), np.cos(np.radians(angles))])
