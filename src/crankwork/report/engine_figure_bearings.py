"""The polar diagrams of the bearing loads, and the load of the crankpin over the crank angle."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Self

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.engine_diagrams import CrankpinLoad, PolarDiagram, crankpin_of_one
from crankwork.analysis.results import Listing
from crankwork.locale import say
from crankwork.report.engine_figure_data import EngineDrawn
from crankwork.report.engine_figure_labels import label_marks, spread
from crankwork.report.language import row_name
from crankwork.show.chart import (
    BOTTOM,
    CIRCLE,
    RIGHT,
    TOP,
    WIDTH,
    Box,
    Graph,
    Row,
    limits,
    over_cycle,
    round_ticks,
    sheet,
    small_text,
)
from crankwork.show.paper import Paper
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID

_HEIGHT, _MARGIN = 340.0, 1.12
_LINES = (SOLID, DASHED, DASH_DOT, DOTTED)


class _OverCycle(NamedTuple):
    """Mean and extremes of a load and where they are. [N], [deg]"""

    mean: float
    max: float
    max_angle: float
    min: float
    min_angle: float

    @classmethod
    def read(cls, listing: Listing, name: str) -> Self:
        """Return the row of a bearing."""
        at = listing.names.index(name)
        mean, *ends = (
            float(listing.columns[key][at]) for key in ("mean_bearing_load", "bearing_load_max", "bearing_load_min")
        )
        angles = (float(np.degrees(listing.columns[f"bearing_load_{one}_angle"][at])) for one in ("max", "min"))
        return cls(mean, *(value for pair in zip(ends, angles, strict=True) for value in pair))


def crankpin_polar(engine: EngineDrawn, pin: int) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the load of all rods on a crankpin: tangential to the right, radial downward, seen from its pole."""
    return _pin_polar(engine, engine.diagrams.crankpin(pin))


def _pin_polar(engine: EngineDrawn, load: CrankpinLoad) -> tuple[Paper, Mapping[str, Graph]]:
    """Draw the polar diagram of a crankpin with the inertia force of its rods from its pole."""
    rods, inertia = load.rods, load.inertia
    count = f"{rods} " if rods > 1 else ""
    pole = say("drawing.pole_rods" if rods > 1 else "drawing.pole", engine.language)
    force = (
        f"{count}{engine.symbol('big_end_inertia_force')} – {engine.named('big_end_inertia_force').partition(' – ')[2]}"
    )
    rows = [Row(f"O – {pole}", CIRCLE), Row(f"{force}, {engine.value('big_end_inertia_force', -inertia)}", width=1.8)]
    titles = (
        f"{engine.symbol('tangential_force')}, {engine.unit('tangential_force')}",
        f"{engine.symbol('radial_force')}, {engine.unit('radial_force')}",
    )
    return _polar(engine, "crankpin_load", load.polar, rows if inertia else [], titles)


def crankpin_polar_of_one(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the load of the one rod of a crank gear on its crankpin, from the columns of the results."""
    drawn = engine.drawn
    return _pin_polar(engine, crankpin_of_one(drawn.results, drawn.degrees, drawn.columns))


def big_end_polar(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the load of the crankpin on the big-end bearing, in the frame of the rod."""
    return _rod_polar(engine, "big_end_load")


def small_end_polar(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the load of the piston pin on the small-end bearing, in the frame of the rod."""
    return _rod_polar(engine, "small_end_load")


def _rod_polar(engine: EngineDrawn, key: str) -> tuple[Paper, Mapping[str, Graph]]:
    unit = engine.unit(key)
    titles = (
        f"{engine.symbol(key)} {say('drawing.across_rod', engine.language)}, {unit}",
        f"{engine.symbol(key)} {say('drawing.along_rod', engine.language)}, {unit}",
    )
    # along the rod is upward, not downward
    return _polar(engine, key, engine.diagrams.rod_bearings[key], [], titles, upward=True)


def _polar(
    engine: EngineDrawn,
    key: str,
    diagram: PolarDiagram,
    rows: list[Row],
    titles: tuple[str, str],
    *,
    upward: bool = False,
) -> tuple[Paper, Mapping[str, Graph]]:
    """Draw a polar diagram on equal scales with its pole, marked every 30 degrees."""
    across, down = (
        np.append(one, one[0]) for one in (engine.shown(key, diagram.across), engine.shown(key, diagram.down))
    )
    pole = tuple(float(one) for one in engine.shown(key, np.array(diagram.pole)))
    paper, box = sheet(_HEIGHT, rows)
    x, y = _equal_scales(box, np.append(across, [0.0, pole[0]]), np.append(down, [0.0, pole[1]]))
    graph = Graph(paper, box, x, (-y[0], -y[1]) if upward else y, engine.language)
    sign = -1.0 if upward else 1.0
    graph.frame(round_ticks(*x, 7), round_ticks(min(graph.y), max(graph.y), 7))
    origin = graph.point(0.0, 0.0)
    paper.segments(np.array([(origin[0], box.top, origin[0], box.top + box.height)]), width=0.8)
    graph.curve("load", across, sign * down)
    cross = [
        spread(graph.across(np.array(x)), np.full(2, origin[1])),
        spread(np.full(2, origin[0]), np.array([box.top, box.top + box.height])),
    ]
    graph.curves["pole"] = np.array([pole[0]]), sign * np.array([pole[1]])
    at = graph.point(pole[0], sign * pole[1])
    if pole[1]:
        paper.arrow(at, origin, width=1.8)
        cross.append(spread(np.array([at[0], origin[0]]), np.array([at[1], origin[1]])))
    marked = engine.shown(key, diagram.marks_across), sign * engine.shown(key, diagram.marks_down)
    graph.curves["marks"] = marked
    places = zip(diagram.marks, graph.across(marked[0]), graph.down(marked[1]), strict=True)
    line = spread(graph.across(across), graph.down(sign * down))
    names = [("O", *at), *((f"{angle:g}", float(a), float(b)) for angle, a, b in places)]
    label_marks(paper, names, np.vstack([line, *cross]))
    paper.dot(*at, 2.6, fill="#ffffff", width=1.0)
    graph.x_title(titles[0])
    graph.y_title(titles[1], 48.0)
    return paper, {key: graph}


def _equal_scales(box: Box, x: Array, y: Array) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return ends of the scales that hold the points, equal both ways, the vertical one downward."""
    middle = (float(x.min()) + float(x.max())) / 2, (float(y.min()) + float(y.max())) / 2
    scale = _MARGIN * max(float(np.ptp(x)) / box.width, float(np.ptp(y)) / box.height) or 1.0
    half = scale * box.width / 2, scale * box.height / 2
    return (middle[0] - half[0], middle[0] + half[0]), (middle[1] + half[1], middle[1] - half[1])


def crankpin_load(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the size of the load on every unlike crankpin over the crank angle, mean and extremes of the first."""
    degrees, loads = engine.diagrams.loads
    sizes = {pin: engine.shown("crankpin_load", one.resultant) for pin, one in loads.crankpins.items()}
    first = next(iter(sizes))
    found = _OverCycle.read(engine.drawn.results.listings["bearing_loads"], f"crankpin.{first}")
    rows = [
        Row(
            engine.named("crankpin_load")
            + (f", {row_name(f'crankpin.{pin}', engine.language)}" if len(sizes) > 1 else ""),
            _LINES[at % len(_LINES)],
        )
        for at, pin in enumerate(sizes)
    ]
    style = (10.0, 3.0) if len(sizes) > 1 else DASHED
    which = row_name(f"crankpin.{first}", engine.language) if len(sizes) > 1 else ""
    mean = f"{engine.named('mean_crankpin_load')}{', ' if which else ''}{which}"
    rows.append(Row(f"{mean}, {engine.value('mean_crankpin_load', found.mean)}", style, 0.8))
    base = engine.symbol("crankpin_load")[:-1]
    ends = (
        f"{base}{',' if '_' in base else '_'}{name}$ = {engine.value('crankpin_load', value)} ({engine.number(angle)}°)"
        for name, angle, value in (("max", found.max_angle, found.max), ("min", found.min_angle, found.min))
    )
    rows.append(Row(f"{which}{': ' if which else ''}{'; '.join(ends)}", width=0.0))
    paper, box = sheet(210.0, rows)
    _, high = limits(*sizes.values(), margin=0.14)
    # room for the name of a minimum near zero
    low = -0.08 * high if found.min < 0.08 * found.max else 0.0
    graph = over_cycle(paper, box, (low, high), engine.cycle, engine.language)
    for at, (pin, values) in enumerate(sizes.items()):
        graph.curve(
            f"pin_{pin}", np.append(degrees, engine.cycle), np.append(values, values[0]), _LINES[at % len(_LINES)]
        )
    level = float(engine.shown("crankpin_load", found.mean))
    graph.curve("mean", [0.0, engine.cycle], [level, level], style, width=0.8)
    for name, angle, value in (("max", found.max_angle, found.max), ("min", found.min_angle, found.min)):
        graph.mark(name, angle, float(engine.shown("crankpin_load", value)), name, below=name == "min")
    graph.x_title(engine.title("crank_angle"))
    graph.y_title(
        engine.title("crankpin_load")
        if len(sizes) == 1
        else f"{engine.symbol('crankpin_load')}, {engine.unit('crankpin_load')}"
    )
    return paper, {"crankpin_load": graph}


def main_journal_polar(engine: EngineDrawn) -> tuple[Paper, Mapping[str, Graph]]:
    """Return the loads of all main journals in the frame of the shaft, side by side on equal scales."""
    diagrams = engine.diagrams.mains
    most = max(float(np.hypot(one.across, one.down).max()) for one in diagrams)
    reach = 1.18 * float(engine.shown("main_journal_load", most)) or 1.0
    columns = min(len(diagrams), 2 if len(diagrams) in (2, 4) else 3)
    lines = -(-len(diagrams) // columns)
    side, gap = (WIDTH - 52 - RIGHT + 22) / columns - 22, (22.0, 26.0)
    paper = Paper(WIDTH, TOP + 12 + lines * side + (lines - 1) * gap[1] + BOTTOM)
    graphs = {}
    for at, diagram in enumerate(diagrams):
        column, line = at % columns, at // columns
        box = Box(52 + column * (side + gap[0]), TOP + 12 + line * (side + gap[1]), side, side)
        has_below = at + columns >= len(diagrams)
        graphs[str(at + 1)] = _small_polar(engine, paper, box, diagram, reach, labels=(has_below, column == 0))
        small_text(paper, box.left + side / 2, box.top - 5, row_name(f"main_journal.{at + 1}", engine.language))
        if has_below:
            graphs[str(at + 1)].x_title(f"{engine.symbol('main_journal_load')}, {engine.unit('main_journal_load')}")
    return paper, graphs


def _small_polar(
    engine: EngineDrawn, paper: Paper, box: Box, diagram: PolarDiagram, reach: float, *, labels: tuple[bool, bool]
) -> Graph:
    """Draw one of several polar diagrams, crank 1 upward, marked every 90 degrees."""
    graph = Graph(paper, box, (-reach, reach), (-reach, reach), engine.language)
    ticks = round_ticks(-reach, reach, 5)
    graph.frame(ticks, ticks, labels=labels)
    middle = graph.point(0.0, 0.0)
    paper.segments(np.array([(middle[0], box.top, middle[0], box.top + box.height)]), width=0.8)
    across, up = engine.shown("main_journal_load", diagram.across), -engine.shown("main_journal_load", diagram.down)
    across, up = np.append(across, across[0]), np.append(up, up[0])
    graph.curve("load", across, up, width=1.0)
    marked = (
        engine.shown("main_journal_load", diagram.marks_across),
        -engine.shown("main_journal_load", diagram.marks_down),
    )
    graph.curves["marks"] = marked
    places = zip(diagram.marks, graph.across(marked[0]), graph.down(marked[1]), strict=True)
    cross = spread(np.array([box.left, box.left + box.width]), np.full(2, middle[1]))
    line = np.vstack([spread(graph.across(across), graph.down(up)), cross])
    label_marks(paper, [(f"{angle:g}", float(a), float(b)) for angle, a, b in places], line, size=6.5, dot=1.3)
    return graph
