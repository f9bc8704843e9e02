"""Centrodes of a coupler: where its instant centre goes on the ground, and on the coupler itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import combinations

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.moving import Frame, moving
from crankwork.analysis.skeleton import Member, skeleton
from crankwork.locale import say
from crankwork.locale.numbers import unit_name
from crankwork.mechanism.mechanism import Mechanism
from crankwork.quantities import QUANTITIES
from crankwork.report.figure_data import figure_title
from crankwork.report.language import symbol
from crankwork.report.linkage_look import Style, displayed_values, position_text
from crankwork.show.chart import DOT, ChartBox, Graph, Row, round_ticks, sheet, write_method
from crankwork.show.labels import label_marks
from crankwork.show.paper import Canvas, plain
from crankwork.show.place import scaled_height
from crankwork.show.scene import SOLID, Drawing

_HIGH, _AROUND, _LINK = 300.0, 0.6, "#8c8c8c"
# dashes that short centrodes show, too
_ROLLING = (3.0, 1.5)
# how much of its way a centre must be near to be drawn, and how far it must go there
_SEEN, _SMALL = 0.3, 0.2
# a coupler that turns less than this share of the crank has its centre far away
_LEAST = 1e-6


def centrodes(
    mechanism: Mechanism, known: Mapping[str, Array], degrees: Array, row: int, style: Style
) -> dict[str, Callable[[], Drawing]]:
    """Return the function that draws both centrodes of a coupler at one crank angle; none if the centre is far away.

    `at`: which of the crank angles [deg].
    """
    names = [key.partition(".")[2] for key in known if key.startswith("instant_centre_x.")]
    moved = moving(mechanism, degrees)
    reach = _reach(np.vstack([point.place for point in moved.points.values()]))
    centres = {name: instant_centres(moved.frames[name], row) for name in names if name in moved.frames}
    name = max(centres, key=lambda link: _seen(centres[link][0], reach), default="")
    if not name or _seen(centres[name][0], reach) < _SEEN:
        return {}

    def draw() -> Drawing:
        fixed, rolling = centres[name]
        scale = float(displayed_values(QUANTITIES["point_x"], np.array(1.0)))
        places = {name: point.place[row] * scale for name, point in moved.points.items()}
        letters = skeleton(mechanism, style.links).letters
        # the letter that tables have, unless a point has it
        centre = symbol("instant_centre_x", style.language).partition("_")[2]
        centre += "₀" if centre in letters.values() else ""
        rows = [
            Row(say("drawing.fixed_centrode", style.language, link=plain(name))),
            Row(
                f"{say('drawing.moving_centrode', style.language)}, {position_text(float(degrees[row]), style)}",
                _ROLLING,
            ),
            Row(f"${centre}$ – {say('drawing.instant_centre', style.language)}", DOT),
        ]
        paper, box = sheet(scaled_height(_HIGH), rows)
        graph = _graph(paper, box, np.vstack([point.place * scale for point in moved.points.values()]), style)
        _linkage(graph, skeleton(mechanism, style.links).members, places)
        for key, path, dashes in (("fixed_centrode", fixed, SOLID), ("moving_centrode", rolling, _ROLLING)):
            graph.curve(key, *_within(graph, path * scale), dashes)
        marks = [(plain(letters[point]), *graph.point(*place)) for point, place in places.items() if point in letters]
        x, y = fixed[row] * scale
        if graph.x[0] < x < graph.x[1] and graph.y[0] < y < graph.y[1]:
            marks.append((f"${centre}$", *graph.point(float(x), float(y))))
        label_marks(paper, marks, frame=graph.box)
        unit = unit_name(QUANTITIES["point_x"].unit, style.language)
        graph.x_title(f"$x$, {unit}")
        graph.y_title(f"$y$, {unit}")
        write_method(paper, style.method)
        return paper.drawing(figure_title("centrodes", style.language), style.language)

    return {"centrodes": draw}


def instant_centres(frame: Frame, row: int) -> tuple[Array, Array]:
    """Return the instant centre on the ground, and on the coupler where it is at one crank angle. [m]"""
    rate = np.where(np.abs(frame.angle_1) > _LEAST, frame.angle_1, np.nan)
    offset = frame.origin.place_1 / rate[:, None]
    fixed = frame.origin.place + np.column_stack([-offset[:, 1], offset[:, 0]])
    across = np.column_stack([-frame.along[:, 1], frame.along[:, 0]])
    off = fixed - frame.origin.place
    u, v = np.sum(off * frame.along, axis=1), np.sum(off * across, axis=1)
    return fixed, frame.origin.place[row] + u[:, None] * frame.along[row] + v[:, None] * across[row]


def _seen(path: Array, reach: tuple[Array, Array]) -> float:
    """Return how much of its way a centre is near a linkage; nothing of one that hardly moves there."""
    near = np.all(np.abs(path - reach[0]) < reach[1], axis=1)
    size = float(np.max(np.ptp(path[near], axis=0))) if np.any(near) else 0.0
    return float(np.mean(near)) if size > _SMALL * float(reach[1][0]) else 0.0


def _reach(places: Array) -> tuple[Array, Array]:
    """Return the middle of a linkage, and how far around it centres are shown, across and up."""
    low, high = places.min(axis=0), places.max(axis=0)
    return (low + high) / 2, np.full(2, float(np.max(high - low)) * (1 + _AROUND) / 2)


def _graph(paper: Canvas, box: ChartBox, places: Array, style: Style) -> Graph:
    """Return a graph of equal scales around a linkage, its frame drawn."""
    middle, size = _reach(places)
    unit = 2 * max(float(size[0]) / box.width, float(size[1]) / box.height) or 1.0
    half = unit * box.width / 2, unit * box.height / 2
    x = float(middle[0]) - half[0], float(middle[0]) + half[0]
    y = float(middle[1]) - half[1], float(middle[1]) + half[1]
    graph = Graph(paper, box, x, y, style.language, to_scale=False)
    graph.frame(round_ticks(*x), round_ticks(*y))
    return graph


def _linkage(graph: Graph, members: Sequence[Member], places: Mapping[str, Array]) -> None:
    """Draw the links as lines between their points."""
    for member in members:
        for start, end in combinations([places[name] for name in member.points if name in places], 2):
            x, y = graph.across(np.array([start[0], end[0]])), graph.down(np.array([start[1], end[1]]))
            graph.paper.line(x, y, width=1.8, colour=_LINK)


def _within(graph: Graph, path: Array) -> tuple[Array, Array]:
    """Return a path with gaps where it leaves the graph."""
    x, y = path.T
    with np.errstate(invalid="ignore"):
        inside = (x > graph.x[0]) & (x < graph.x[1]) & (y > graph.y[0]) & (y < graph.y[1])
    return np.where(inside, x, np.nan), np.where(inside, y, np.nan)
