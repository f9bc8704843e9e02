"""The indicator diagram over the volume, with the volumes at the dead centres."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from crankwork.analysis import Array
from crankwork.locale import say
from crankwork.report.engine_figure_cylinder import mark_points, named_points
from crankwork.report.engine_figure_data import EngineDrawn
from crankwork.show.chart import Box, Graph, Row, limits, round_ticks, sheet, small_text
from crankwork.show.paper import Paper
from crankwork.show.scene import DASH_DOT, DASHED

_HEIGHT, _ABOVE = 245.0, 24.0
_FOUR_STROKE = 720.0
# crank angles before and after which the cylinder is open [deg], and what share of the diagram its loop may be
_CALM, _FLAT = (180.0, 620.0), 0.1
# where the loop may begin, as shares of the width, and what its numbers take beside it [pt]
_STARTS, _NUMBERS = (0.36, 0.44, 0.52), 36.0

# an inset lower than this shows nothing [pt]
_LOWEST = 60.0


def indicator(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the gas pressure over the volume with its named points, and the diagram with sharp corners if known."""
    drawn, space = engine.drawn, engine.drawn.results.solved.space
    volume, values = drawn.values("cylinder_volume"), drawn.values("gas_pressure")
    sharp = space.theoretical
    pressures = [values]
    if sharp is not None:
        absolute = sharp.pressure(drawn.degrees, drawn.columns["cylinder_volume"])
        pressures.append(engine.shown("gas_pressure", space.gauge(absolute)))
    rows = [Row(engine.named("gas_pressure")), Row(say("drawing.sharp", engine.language), DASHED, 0.9)]
    paper, box = sheet(_HEIGHT + _ABOVE, rows if sharp is not None else ())
    box = box._replace(top=box.top + _ABOVE, height=box.height - _ABOVE)
    ends, reach = limits(*pressures), 1.06 * float(np.max(volume))
    graph = Graph(paper, box, (0.0, reach), ends, engine.language)
    graph.frame(round_ticks(0.0, reach, 8), round_ticks(*ends, 9))
    if sharp is not None:
        graph.curve("theoretical", volume, pressures[1], DASHED, width=0.9, angles=drawn.degrees)
    graph.curve("gas_pressure", volume, values, angles=drawn.degrees)
    graph.x_title(engine.title("cylinder_volume"))
    graph.y_title(engine.title("gas_pressure"))
    _dead_centres(engine, graph)
    points = [
        (name, float(np.interp(angle, drawn.degrees, volume)), value) for name, angle, value in named_points(engine)
    ]
    mark_points(graph, points)
    inset = _inset(engine, graph, volume, values)
    return paper, {"indicator": graph} | ({"inset": inset} if inset else {})


def _inset(engine: EngineDrawn, graph: Graph, volume: Array, values: Array) -> Graph | None:
    """Draw the loop of gas exchange larger where no curve is, above the pressure of the surroundings."""
    degrees, (left, top, width, height) = engine.drawn.degrees, graph.box
    calm = (degrees < _CALM[0]) | (degrees > _CALM[1])
    if engine.cycle != _FOUR_STROKE or np.ptp(values[calm]) > _FLAT * np.ptp(values):
        return None
    ends = limits(values[calm], margin=0.5)
    x, y = graph.across(volume), graph.down(values)
    centre = float(np.max(x))
    for start in _STARTS:
        begin = left + start * width
        box = Box(begin, top + 0.05 * height, centre - 8 - begin, 0.36 * height)
        room = (x > box.left - _NUMBERS) & (y < box.top + box.height + 10) & (x < box.left + box.width)
        if not np.any(room):
            break
    else:
        return None
    if box.height < _LOWEST:
        return None
    inset = Graph(graph.paper, box, (0.0, graph.x[1]), ends, engine.language)
    # on a sheet it is smaller, to a round scale
    box = inset.box
    corners = box.left - _NUMBERS, box.left + box.width, box.top - 6, box.top + box.height + 6
    graph.paper.area([corners[0], corners[1], corners[1], corners[0]], [*corners[2:3] * 2, *corners[3:] * 2])
    inset.frame(np.array([]), round_ticks(*ends, min(5, round(inset.box.height / 16))))
    inset.curve("gas_exchange", *_within(inset, volume, values))
    graph.paper.text(box.left + box.width, float(inset.down(0.0)) - 3, engine.symbol("ambient_pressure"), size=8,
                     anchor="end")  # fmt: skip
    return inset


def _within(graph: Graph, x: Array, y: Array) -> tuple[Array, Array]:
    """Return a curve with gaps where it leaves the graph."""
    low, high = sorted(graph.y)
    return x, np.where((y < low) | (y > high), np.nan, y)


def _dead_centres(engine: EngineDrawn, graph: Graph) -> None:
    """Mark the volumes at the dead centres, clearance and swept volume above."""
    space, paper, box = engine.drawn.results.solved.space, graph.paper, graph.box
    volumes = [float(engine.shown("cylinder_volume", one)) for one in (space.clearance, space.clearance + space.swept)]
    for name, volume in zip(("tdc", "bdc"), volumes, strict=True):
        at = float(graph.across(volume))
        down = np.array([box.top - 6, box.top + box.height])
        paper.line([at, at], down, style=DASH_DOT, width=0.6)
        small_text(paper, at, box.top - 17, say(f"drawing.{name}", engine.language))
    level = box.top - 4
    spans = (("clearance_volume", 0.0, volumes[0]), ("swept_volume", volumes[0], volumes[1]))
    for key, start, end in spans:
        left, right = float(graph.across(start)), float(graph.across(end))
        middle = (left + right) / 2
        paper.arrow((middle, level), (left, level), width=0.5)
        paper.arrow((middle, level), (right, level), width=0.5)
        paper.text(middle, level - 3, engine.symbol(key), size=8, anchor="middle")
