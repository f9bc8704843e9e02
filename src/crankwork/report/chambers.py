"""The gas in the chambers of a linkage: indicator diagrams, and volume, pressure and force over the crank angle."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from crankwork.analysis import Array, Results
from crankwork.analysis.chambers import indicators
from crankwork.locale import say
from crankwork.report.linkage_curves import STYLES, curves
from crankwork.report.linkage_look import PLAIN, Style, axis_title, displayed_values, quantity_of
from crankwork.show.chart import Graph, Row, limits, round_ticks, sheet, sign
from crankwork.show.paper import plain
from crankwork.show.scene import Drawing

_KINDS = ("cylinder_volume", "gas_pressure", "gas_force", "rod_load")
_PER_PANEL = 4


def chamber_figures(
    results: Results, degrees: Array, known: Mapping[str, Array], style: Style = PLAIN
) -> dict[str, Callable[[], Drawing]]:
    """Return the figures of the gas by name; none without chambers."""
    panels = [keys for kind in _KINDS for keys in _panels([one for one in known if one.partition(".")[0] == kind])]
    if not panels:
        return {}
    return {
        "indicator": partial(indicator, results, style),
        "chambers": partial(curves, degrees, known, panels, say("figures.chambers", style.language), style),
    }


def indicator(results: Results, style: Style = PLAIN) -> Drawing:
    """Return pressure over volume of every chamber."""
    found = indicators(results)
    volume, pressure = quantity_of("cylinder_volume"), quantity_of("diagram_pressure")
    drawn = {
        name: (displayed_values(volume, one.volume), displayed_values(pressure, one.pressure))
        for name, one in found.items()
    }
    rows = [Row(plain(name), STYLES[number % 4]) for number, name in enumerate(drawn)] if len(drawn) > 1 else []
    paper, box = sheet(259.0, rows)
    x, y = (limits(*some, margin=0.05) for some in zip(*drawn.values(), strict=True))
    graph = Graph(paper, box, x, y, style.language)
    graph.frame(round_ticks(*x), round_ticks(*y, 10))
    for number, (name, (across, up)) in enumerate(drawn.items()):
        # tables of a law over time go by time
        angles = found[name].degrees * (results.period / 360.0 if results.period else 1.0)
        graph.curve(name, across, up, STYLES[number % 4], angles=angles)
    graph.x_title(axis_title(volume, style.language))
    graph.y_title(axis_title(pressure, style.language))
    sign(paper, style.method)
    return paper.drawing(say("figures.indicator", style.language), style.language)


def _panels(keys: Sequence[str]) -> list[Sequence[str]]:
    return [keys[start : start + _PER_PANEL] for start in range(0, len(keys), _PER_PANEL)]
