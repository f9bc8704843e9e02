"""The figure of masses in planes of a shaft: where they stand, and the polygons of their moments and couples."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.rotor_balance import polygons
from crankwork.report.look import Drawn
from crankwork.show.canvas import Canvas
from crankwork.show.chart import BOTTOM, TOP, ChartBox, Graph, round_ticks
from crankwork.show.chart_layout import columns_of, current_layout, scaled_height
from crankwork.show.label_placement import label_marks

_SIDE, _GAP, _TITLE = 220.0, 66.0, 36.0
# with the symbols of the axes
_SUMS = {"plane_moment": "plane_moment", "plane_couple": "rotor_couple"}


def has_polygons(machine: Drawn) -> bool:
    """Return whether masses on a shaft form polygons."""
    return "planes" in machine.results.listings


def balance_polygons(machine: Drawn) -> tuple[Canvas, Mapping[str, Graph]]:
    """Return the directions of the masses, the polygon of their moments, and that of the couples of the moments."""
    drawn = polygons(machine.results)
    star = np.array(drawn["plane_moment"][1])
    panels: dict[str, tuple[str, tuple[str, ...], Array, Array]] = {
        "directions": ("plane_moment", drawn["plane_moment"][0], np.zeros((len(star) - 1, 2)), np.diff(star, axis=0)),
        **{kind: (kind, names, ends[:-1], ends[1:]) for kind, (names, ends) in drawn.items()},
    }
    columns = columns_of(2)
    side = min((current_layout().inner - (columns - 1) * _GAP) / columns, scaled_height(_SIDE))
    lines = -(-len(panels) // columns)
    paper, graphs = Canvas(current_layout().width, TOP + lines * (side + _TITLE) + BOTTOM - _TITLE), dict[str, Graph]()
    for index, (name, (kind, sides, starts, ends)) in enumerate(panels.items()):
        left = current_layout().left + (index % columns) * (side + _GAP)
        box = ChartBox(left, TOP + (index // columns) * (side + _TITLE), side, side)
        graphs[name] = _polygon(machine, paper, box, kind, sides, starts, ends)
    return paper, graphs


def _polygon(  # noqa: PLR0913 - where, what of, and its sides
    machine: Drawn, paper: Canvas, box: ChartBox, kind: str, names: tuple[str, ...], starts: Array, ends: Array
) -> Graph:
    """Draw vectors by their ends, each with its name beside it, in equal scales."""
    shown = machine.shown(kind, np.concatenate([starts, ends]))
    middle, reach = (shown.max(axis=0) + shown.min(axis=0)) / 2, 0.62 * float(np.ptp(shown, axis=0).max())
    x, y = ((float(value) - reach, float(value) + reach) for value in middle)
    graph = Graph(paper, box, x, y, machine.language)
    graph.frame(round_ticks(*x, 4), round_ticks(*y, 4))
    first, last = shown[: len(names)], shown[len(names) :]
    marks = []
    for name, start, end in zip(names, first, last, strict=True):
        tail, head = graph.point(*start.tolist()), graph.point(*end.tolist())
        paper.arrow(tail, head)
        marks.append((name, (tail[0] + head[0]) / 2, (tail[1] + head[1]) / 2))
    label_marks(paper, marks, dot=0.0, frame=box)
    graph.curves[kind] = last[:, 0], last[:, 1]
    for axis, write in (("x", graph.x_title), ("y", graph.y_title)):
        write(f"{machine.symbol(f'{_SUMS[kind]}_{axis}')}, {machine.unit(kind)}")
    return graph
