"""The indicator diagram over the volume, with the volumes at the dead centres."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from crankwork.analysis import Array
from crankwork.locale import say
from crankwork.report.engine_figure_cylinder import mark_points, named_points
from crankwork.report.engine_figure_data import EngineDrawn
from crankwork.report.engine_figure_labels import spread
from crankwork.show.chart import Graph, Row, limits, round_ticks, sheet, small_text
from crankwork.show.paper import Paper
from crankwork.show.scene import DASH_DOT, DASHED

_HEIGHT, _ABOVE = 245.0, 24.0


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
    box = box._replace(top=box.top + _ABOVE, height=_HEIGHT)
    ends, reach = limits(*pressures), 1.06 * float(np.max(volume))
    graph = Graph(paper, box, (0.0, reach), ends, engine.language)
    graph.frame(round_ticks(0.0, reach, 8), round_ticks(*ends, 9))
    if sharp is not None:
        graph.curve("theoretical", volume, pressures[1], DASHED, width=0.9)
    graph.curve("gas_pressure", volume, values)
    graph.x_title(engine.title("cylinder_volume"))
    graph.y_title(engine.title("gas_pressure"))
    centres = _dead_centres(engine, graph)
    points = [
        (name, float(np.interp(angle, drawn.degrees, volume)), value) for name, angle, value in named_points(engine)
    ]
    mark_points(graph, points, spread(graph.across(volume), graph.down(values)), *centres)
    return paper, {"indicator": graph}


def _dead_centres(engine: EngineDrawn, graph: Graph) -> list[Array]:
    """Mark the volumes at the dead centres, clearance and swept volume above, and return points along the lines."""
    space, paper, box = engine.drawn.results.solved.space, graph.paper, graph.box
    volumes = [float(engine.shown("cylinder_volume", one)) for one in (space.clearance, space.clearance + space.swept)]
    lines = []
    for name, volume in zip(("tdc", "bdc"), volumes, strict=True):
        at = float(graph.across(volume))
        down = np.array([box.top - 6, box.top + box.height])
        paper.line([at, at], down, style=DASH_DOT, width=0.6)
        small_text(paper, at, box.top - 17, say(f"drawing.{name}", engine.language))
        lines.append(spread(np.array([at, at]), down))
    level = box.top - 4
    spans = (("clearance_volume", 0.0, volumes[0]), ("swept_volume", volumes[0], volumes[1]))
    for key, start, end in spans:
        left, right = float(graph.across(start)), float(graph.across(end))
        middle = (left + right) / 2
        paper.arrow((middle, level), (left, level), width=0.5)
        paper.arrow((middle, level), (right, level), width=0.5)
        paper.text(middle, level - 3, engine.symbol(key), size=8, anchor="middle")
    return lines
