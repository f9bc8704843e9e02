"""The figures of one cylinder over the crank angle: motion, gas pressure, forces and torque."""

from __future__ import annotations

import itertools
import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.locale import say
from crankwork.quantities import QUANTITIES
from crankwork.report.engine_figure_bands import banded_sheet, strokes
from crankwork.report.engine_figure_data import EngineDrawn
from crankwork.show.chart import BOTTOM, TOP, Box, Graph, Row, limits, over_cycle
from crankwork.show.labels import label_marks
from crankwork.show.paper import Paper
from crankwork.show.place import here, tall
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, Style

_STYLES = (SOLID, DASHED, DASH_DOT, DOTTED)
_HEIGHT, _PANEL, _PANEL_GAP = 216.0, 126.0, 38.0
_LONGEST = 16
# a letter with an index and primes
_SYMBOL = re.compile(r"([^\W\d_])_?([^\W_]{0,3})(['′″]*)")


class _Line(NamedTuple):
    """A curve: key of its quantity, values [display unit], line style."""

    key: str
    values: Array
    style: Style = SOLID


def kinematics(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return three panels over one revolution; an approximate method shows the two orders it is made of."""
    drawn = engine.drawn
    turn = drawn.degrees <= 360
    has_orders = "piston_velocity_first_order" in drawn.columns
    gap = _PANEL_GAP if has_orders else 20.0
    head = 16.0 if has_orders else 4.0
    panel = tall(_PANEL)
    paper = Paper(here().width, TOP + head + 3 * panel + 2 * gap + BOTTOM)
    graphs: dict[str, Graph] = {}
    top = TOP + head
    for row, noun in enumerate(("displacement", "velocity", "acceleration")):
        keys = {f"piston_{noun}": SOLID}
        if has_orders:
            keys |= {f"piston_{noun}_first_order": DASHED, f"piston_{noun}_second_order": DASH_DOT}
        curves = [_Line(key, drawn.values(key)[turn], style) for key, style in keys.items()]
        box = Box(here().left, top, here().inner, panel)
        ends = limits(*(one.values for one in curves))
        graph = over_cycle(paper, box, ends, 360.0, engine.language, numbers=row == 2)
        for at, one in enumerate(curves):
            graph.curve(one.key, drawn.degrees[turn], one.values, one.style)
            if has_orders:
                left = box.left + 8 + 70 * at
                paper.line([left, left + 20], [box.top - 10] * 2, style=one.style, width=1.2, name="legend")
                paper.text(left + 27, box.top - 7, engine.symbol(one.key), size=8.5)
        graph.y_title(engine.title(f"piston_{noun}"), 42.0)
        graphs[noun] = graph
        top += graph.box.height + gap
    graphs["acceleration"].x_title(engine.title("crank_angle"))
    return paper, graphs


def pressure(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the gas pressure over the cycle with the named points, and that of cylinders that differ."""
    degrees, values = engine.drawn.degrees, engine.drawn.values("gas_pressure")
    others = engine.other_pressures
    names = [say("drawing.cylinder", engine.language, number=number) for number in (1, *others)]
    rows = [Row(name, style) for name, style in zip(names, itertools.cycle(_STYLES), strict=False)]
    paper, box = banded_sheet(engine, _HEIGHT, rows if others else ())
    graph = over_cycle(paper, box, limits(values, *others.values()), engine.cycle, engine.language)
    for (number, other), row in zip(others.items(), rows[1:], strict=True):
        graph.curve(f"gas_pressure.{number}", degrees, other, row.style)
    graph.curve("gas_pressure", degrees, values)
    graph.x_title(engine.title("crank_angle"))
    graph.y_title(engine.title("gas_pressure"))
    strokes(engine, graph)
    mark_points(graph, named_points(engine))
    return paper, {"pressure": graph}


def named_points(engine: EngineDrawn) -> list[tuple[str, float, float]]:
    """Return the named points of the diagram: name, crank angle [deg] and gauge pressure [display unit]."""
    space = engine.drawn.results.solved.space
    return [
        (_short(name), angle, float(engine.shown("gas_pressure", space.gauge(value))))
        for name, (angle, value) in space.diagram.named.items()
    ]


def _short(name: str) -> str:
    """Return the name of a point as it is printed: with a subscript if it has one, shortened if it is long."""
    if symbol := _SYMBOL.fullmatch(name):
        base, index, primes = symbol.groups()
        marks = "″" * (primes == "''") or primes.replace("'", "′")
        return f"${base}{marks}{'_' if index else ''}{index}$"
    known = "".join(one if one.isprintable() and one != "$" else "□" for one in name)
    return known if len(known) <= _LONGEST else f"{known[: _LONGEST - 1]}…"


def mark_points(graph: Graph, points: Sequence[tuple[str, float, float]]) -> None:
    """Mark named points of a graph, their names clear of what is drawn.

    `points`: name and place in the units of the scales [their units].
    """
    if points:
        graph.curves["points"] = np.array([one[1] for one in points]), np.array([one[2] for one in points])
        label_marks(graph.paper, [(name, *graph.point(x, y)) for name, x, y in points], frame=graph.box)


def piston_forces(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the parts of the force on the piston and their sum; a part that is the whole sum stands for it."""
    styles = {"gas_force": DASHED, "inertia_force": DASH_DOT, "weight_force": DOTTED}
    parts = {key: style for key, style in styles.items() if key in engine.drawn.columns}
    if len(parts) == 1:
        return _forces(engine, "piston_forces", dict.fromkeys(parts, SOLID))
    return _forces(engine, "piston_forces", {**parts, "piston_force": SOLID})


def rod_forces(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the force along the rod and the side force."""
    return _forces(engine, "rod_forces", {"rod_force": SOLID, "side_force": DASHED})


def crankpin_forces(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the tangential and the radial force on the crankpin."""
    return _forces(engine, "crankpin_forces", {"tangential_force": SOLID, "radial_force": DASHED})


def _forces(engine: EngineDrawn, name: str, keys: Mapping[str, Style]) -> tuple[Paper, Mapping[str, Graph]]:
    """Draw columns of forces over the cycle."""
    curves = [_Line(key, engine.drawn.values(key), style) for key, style in keys.items()]
    title = f"{', '.join(engine.symbol(key) for key in keys)}, {engine.unit('piston_force')}"
    return _over_cycle(engine, name, curves, [Row(engine.named(key), style) for key, style in keys.items()], title)


def _over_cycle(
    engine: EngineDrawn, name: str, curves: Sequence[_Line], rows: Sequence[Row], title: str
) -> tuple[Paper, Mapping[str, Graph]]:
    paper, box = banded_sheet(engine, _HEIGHT, rows)
    graph = over_cycle(paper, box, limits(*(one.values for one in curves)), engine.cycle, engine.language)
    for one in curves:
        graph.curve(one.key, engine.drawn.degrees, one.values, one.style)
    strokes(engine, graph)
    graph.x_title(engine.title("crank_angle"))
    graph.y_title(title)
    return paper, {name: graph}


def torque(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the crank torque of one cylinder and its mean."""
    values, mean = engine.drawn.values("crank_torque"), engine.drawn.results.summary["mean_torque"]
    if abs(float(engine.shown("mean_torque", mean))) < 1e-6 * float(np.max(np.abs(values))):
        mean = 0.0
    row = QUANTITIES["mean_torque"]
    text = f"{engine.symbol('mean_torque')} – {row.label(engine.language)}, {engine.value('mean_torque', mean)}"
    level = np.full_like(values, float(engine.shown("mean_torque", mean)))
    curves = [_Line("crank_torque", values), _Line("mean_torque", level, DASHED)]
    rows = [Row(engine.named("crank_torque")), Row(text, DASHED)]
    return _over_cycle(engine, "torque", curves, rows, engine.title("crank_torque"))
