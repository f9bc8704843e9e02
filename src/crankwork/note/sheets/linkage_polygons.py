"""Velocity and acceleration plans on a sheet: vector polygons from a pole, all of them to one round scale."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from crankwork.analysis.plans import Kind, Plan
from crankwork.note.sheets.graph import Axis, Graph, heading
from crankwork.note.sheets.placing import Named, lines_of, names_beside
from crankwork.note.sheets.words import Words
from crankwork.report.linkage_look import round_scale
from crankwork.report.linkage_plan_figures import node_name
from crankwork.show.scene import SMALL, Box, Circle, Item, LineKind, Polyline, Text, arrow, printable

_KINDS: dict[Kind, LineKind] = {
    "absolute": "medium", "relative": "thin", "tangential": "thin", "sliding": "thin", "normal": "dashed",
    "coriolis": "dash_dot",
}  # fmt: skip
_HEAD, _FOOT, _AROUND = 15.0, 6.0, 7.0
Of = Literal["velocity_plans", "acceleration_plans"]


class Numbered(NamedTuple):
    """A plan and the number of its position."""

    position: int
    plan: Plan


def vector_plans(
    of: Of, plans: Sequence[Numbered], box: Box, columns: int, words: Words
) -> tuple[list[Graph], list[Item]]:
    """Return plans side by side in a box, each as a graph of its own."""
    rows = -(-len(plans) // columns)
    width, height = box.width / columns, (box.height - _HEAD) / rows
    scale = max(_least_scale(one.plan, width, height) for one in plans)
    graphs = []
    for count, one in enumerate(plans):
        row, column = divmod(count, columns)
        cell = Box(box.left + column * width, box.top - _HEAD - (row + 1) * height, width, height)
        graphs.append(_drawn(of, one, cell, round_scale(scale), words))
    sign, unit = ("v", "m/s") if of == "velocity_plans" else ("a", "m/s2")
    return graphs, heading(words.say(of), [words.scale(sign, round_scale(scale), unit)], [], box)


def _least_scale(plan: Plan, width: float, height: float) -> float:
    """Return how much a millimetre must be at least for a plan to fit into a cell."""
    places = _places(plan)
    wide, tall = np.ptp(places, axis=0)
    return float(max(wide / (width - 2 * _AROUND), tall / (height - 2 * _AROUND - _FOOT), 1e-12))


def _places(plan: Plan) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return np.array([[0.0, 0.0], *(end for one in plan.vectors for end in (one.start, one.end))])


def _drawn(of: Of, one: Numbered, cell: Box, scale: float, words: Words) -> Graph:
    """Return a plan in its cell."""
    places = _places(one.plan)
    low, high = places.min(axis=0) / scale, places.max(axis=0) / scale
    room = cell.inset(_AROUND, _AROUND + _FOOT, _AROUND, _AROUND)
    pole = np.array([room.left + room.width / 2, room.bottom + room.height / 2]) - (low + high) / 2
    longest = max((vector.length for vector in one.plan.vectors), default=0.0)
    items: list[Item] = []
    for vector in one.plan.vectors:
        if vector.length > 1e-9 * longest:
            start, end = pole + vector.start / scale, pole + vector.end / scale
            items += arrow(start, end, _KINDS[vector.kind], head=2.5)
    letter = "p" if of == "velocity_plans" else "q" if words.language == "en" else "π"
    points = [Named(letter, (float(pole[0]), float(pole[1])))]
    for name, at in one.plan.nodes.items():
        x, y = pole + at / scale
        points.append(Named(node_name(printable(name, 8)), (float(x), float(y))))
    items.append(Circle((float(pole[0]), float(pole[1])), 0.9, "thin", 1.0))
    items += names_beside(points, lines_of(items), cell.inset(0.5, _FOOT, 0.5, 0.5), dot=0.0)
    items += [Polyline(np.array([pole, pole + at / scale]), "net", name=name) for name, at in one.plan.nodes.items()]
    below = f"{words.say('position')} {one.position}"
    items.append(Text((cell.left + cell.width / 2, cell.bottom + 2.0), below, SMALL, "middle"))
    unit = "m/s" if of == "velocity_plans" else "m/s2"
    x = Axis("x", unit, scale, float(pole[0]), room.left, room.right)
    y = Axis("y", unit, scale, float(pole[1]), room.bottom, room.top)
    return Graph(f"{of}.{one.position}", cell, x, y, tuple(items))
