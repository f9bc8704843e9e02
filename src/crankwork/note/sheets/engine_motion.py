"""Displacement, velocity and acceleration of the piston over the crank angle, and Tolle's construction."""

from __future__ import annotations

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.diagrams import tangent_ends, tolle_points
from crankwork.note.sheets.engine_gas import angle_side, value_side
from crankwork.note.sheets.graph import KINDS, Curve, Graph, Side, graph
from crankwork.note.sheets.words import Words
from crankwork.report.figure_data import Drawn
from crankwork.report.language import displayed
from crankwork.show.scene import SMALL, Box, Circle, Item, Text, line


def motion_graph(drawn: Drawn, noun: str, box: Box, words: Words) -> Graph:
    """Return displacement, velocity or acceleration over one revolution.

    An approximate method shows the two orders it is made of.
    """
    key = f"piston_{noun}"
    keys = [one for one in (key, f"{key}_first_order", f"{key}_second_order") if one in drawn.columns]
    turn = drawn.degrees <= 360
    curves = [
        Curve(one, words.symbol(one), "", drawn.degrees[turn], drawn.values(one)[turn], kind)
        for one, kind in zip(keys, KINDS, strict=False)
    ]
    sides = angle_side(drawn, words, 360.0), value_side(key, [one.y for one in curves], words)
    return graph(key, box, sides, curves, words)


def tolle(drawn: Drawn, box: Box, words: Words, scale: float, at: float) -> Graph:
    """Return the acceleration over the displacement, with the lines that envelop it by Tolle's construction.

    `drawn`: what the graphs share; of an engine whose cylinder is not offset. Source: kolchin_demidov_2008, ch. 6.
    """
    half = drawn.degrees <= 180
    x, y = drawn.values("piston_displacement")[half], drawn.values("piston_acceleration")[half]
    corners = tolle_corners(drawn)
    accelerations = value_side("piston_acceleration", [y, 1.12 * corners[1:, 1], corners[:1, 1]], words)
    displacements = Side(words.symbol("piston_displacement"), "mm", 0.0, float(np.max(x)), scale, at)
    curve = Curve("piston_acceleration", accelerations.symbol, "", x, y)
    shown = graph("tolle", box, (displacements, accelerations), [curve], words)
    return shown.with_items(_envelope(shown, corners))


def tolle_corners(drawn: Drawn) -> Array:
    """Return the points C, E, F and D of the construction: displacement and acceleration, shape (4, 2), shape (4, 2).

    C above top and D below bottom dead centre at the accelerations there, E where CD cuts the axis, and F under E at
    -3 lambda r w^2 [mm], [m/s2].
    """
    solved = drawn.results.solved
    r, ratio = solved.lengths.crank_radius, solved.lengths.rod_ratio
    unit = displayed("piston_acceleration", r * solved.speed**2)
    radius = displayed("piston_displacement", r)
    found = tolle_points(ratio)
    return np.array([found.c, found.e, found.f, found.d]) * [radius, unit]


def _envelope(shown: Graph, corners: Array) -> list[Item]:
    """Return the lines CF and FD in equal parts, what joins their parts, and the names of the points."""
    c, e, f, d = (np.array(shown.point(*one)) for one in corners)
    a, b = (np.array(shown.point(x, 0.0)) for x in (corners[0, 0], corners[3, 0]))
    items: list[Item] = [line(one, other) for one, other in ((a, c), (b, d), (c, d), (e, f), (c, f), (f, d))]
    for part, ends in enumerate(tangent_ends(c, f, d), start=1):
        first, second = ends[:2], ends[2:]
        items.append(line(first, second))
        items += [Circle((float(one[0]), float(one[1])), 0.4, "thin", 0.0) for one in (first, second)]
        items.append(Text((float(first[0] - 1.2), float(first[1] - 2.6)), str(part), SMALL, "end"))
        items.append(Text((float(second[0]), float(second[1] - 4.0)), f"{part}′", SMALL, "middle"))
    for name, place, (right, up) in (
        ("C", c, (-4.8, 0.8)), ("D", d, (2.0, -3.5)), ("E", e, (1.5, 1.2)), ("F", f, (1.5, -4.2)), ("A", a, (1.5, 1.2)),
        ("B", b, (1.5, 1.2)),
    ):  # fmt: skip
        items.append(Text((float(place[0] + right), float(place[1] + up)), name))
    return items
