"""The gas in the chambers of a linkage: indicator diagrams, and volume, pressure and force over the crank angle."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.chambers import indicators
from crankwork.locale import say
from crankwork.report.figure_look import DASH_DOT, DASHED, DOTTED, SOLID, legend_above, plain, single_axes, svg
from crankwork.report.linkage_curves import curves
from crankwork.report.linkage_look import PLAIN, Style, axis_title, displayed_values, figure_look, quantity_of

_STYLES = (SOLID, DASHED, DASH_DOT, DOTTED)
_KINDS = ("cylinder_volume", "gas_pressure", "gas_force", "rod_load")
_PER_PANEL = 4


def chamber_figures(
    results: Results, degrees: Array, known: Mapping[str, Array], style: Style = PLAIN
) -> dict[str, bytes]:
    """Return the figures of the gas by name; none without chambers."""
    panels = [keys for kind in _KINDS for keys in _panels([one for one in known if one.partition(".")[0] == kind])]
    if not panels:
        return {}
    return {
        "indicator": indicator(results, style),
        "chambers": curves(degrees, known, panels, say("figures.chambers", style.language), style),
    }


def indicator(results: Results, style: Style = PLAIN) -> bytes:
    """Return pressure over volume of every chamber."""
    found = indicators(results)
    volume, pressure = quantity_of("cylinder_volume"), quantity_of("diagram_pressure")
    with figure_look():
        figure, axes = single_axes(style.language, len(found) if len(found) > 1 else 0, height=3.6)
        for number, (name, one) in enumerate(found.items()):
            x, y = displayed_values(volume, one.volume), displayed_values(pressure, one.pressure)
            axes.plot(x, y, color="black", linestyle=_STYLES[number % 4], label=plain(name))
        low = min(0.0, *(float(np.min(one.pressure)) for one in found.values()))
        axes.set_xlim(left=0)
        axes.set_ylim(bottom=None if low < 0 else 0)
        axes.set_xlabel(axis_title(volume, style.language))
        axes.set_ylabel(axis_title(pressure, style.language).replace(" $", "\n$", 1))
        if len(found) > 1:
            legend_above(axes)
        return svg(figure, say("figures.indicator", style.language), style.method)


def _panels(keys: Sequence[str]) -> list[Sequence[str]]:
    return [keys[start : start + _PER_PANEL] for start in range(0, len(keys), _PER_PANEL)]
