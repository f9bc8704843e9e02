"""Bands over the crank angle, above a graph: the strokes of a cylinder, and where each cylinder fires."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from crankwork.locale import say
from crankwork.report.engine_figure_data import EngineDrawn
from crankwork.show.chart import Box, Graph, Row, sheet, small_text
from crankwork.show.paper import Paper

_BAND = 12.0
_FOUR_STROKES = ("intake", "compression", "expansion", "exhaust")
_TWO_STROKES, _COMPRESSOR = ("expansion", "compression"), ("suction", "delivery")
# a cycle of this length has its dead centre of ignition in the middle [deg]
_FOUR_STROKE = 720.0


def banded_sheet(engine: EngineDrawn, height: float, rows: Sequence[Row] = ()) -> tuple[Paper, Box]:
    """Return paper with a legend and the place for a graph with a band above it. [pt]"""
    if not _names(engine):
        return sheet(height, rows)
    paper, box = sheet(height + _BAND, rows)
    return paper, box._replace(top=box.top + _BAND, height=box.height - _BAND)


def strokes(engine: EngineDrawn, graph: Graph) -> None:
    """Write the strokes of a cylinder above a graph, each over its half turn."""
    names = _names(engine)
    if not names:
        return
    ends = graph.across(np.arange(0.0, engine.cycle + 1, 180.0))
    top = graph.box.top
    lines = [(end, top - _BAND, end, top) for end in ends]
    graph.paper.segments(np.array([*lines, (ends[0], top - _BAND, ends[-1], top - _BAND)]), width=0.4)
    for name, (left, right) in zip(names, pairwise(ends), strict=True):
        small_text(graph.paper, float(left + right) / 2, top - 3.5, say(f"drawing.{name}", engine.language))


def _names(engine: EngineDrawn) -> tuple[str, ...]:
    """Return the keys of the strokes from the first dead centre on, none without gas that does work or takes it."""
    space = engine.drawn.results.solved.space
    if space is None or not space.work:
        return ()
    if engine.cycle == _FOUR_STROKE:
        return _FOUR_STROKES
    return _TWO_STROKES if space.work > 0 else _COMPRESSOR


def firings(engine: EngineDrawn, graph: Graph) -> None:
    """Write the number of each cylinder above a graph where it fires."""
    centre = 360.0 if engine.cycle == _FOUR_STROKE else 0.0
    found: dict[float, list[str]] = {}
    for number, place in enumerate(engine.diagrams.whole.layout.places, start=1):
        at = (place.firing_angle + place.top + centre) % engine.cycle
        found.setdefault(round(at, 6), []).append(str(number))
    top = graph.box.top
    for at, numbers in found.items():
        x = float(graph.across(at))
        graph.paper.area([x, x - 2.2, x + 2.2], [top, top - 4.5, top - 4.5], fill="#000000")
        small_text(graph.paper, x, top - 7, ",".join(numbers))
