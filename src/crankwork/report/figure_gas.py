"""The figures of the gas: pressure over the crank angle and over the volume."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from crankwork.analysis import WorkingSpace
from crankwork.errors import CrankworkError
from crankwork.quantities import Language
from crankwork.report.figure_data import Drawn
from crankwork.report.figure_labels import Line, label_points
from crankwork.report.figure_look import DASH_DOT, figure_word, math_symbol, over_crank_angle, single_axes, through_zero
from crankwork.report.language import displayed, symbol

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def pressure(drawn: Drawn) -> bytes:
    """Return the gas pressure over the cycle with the named points of the diagram.

    Parameters
    ----------
    drawn : Drawn
        What the figures share.

    Returns
    -------
    bytes
        SVG.
    """
    figure, axes = single_axes(drawn.language, 0)
    values = drawn.values("gas_pressure")
    axes.plot(drawn.degrees, values, color="black")
    over_crank_angle(axes, drawn.results.machine.cycle, drawn.language)
    through_zero(axes, values)
    axes.set_ylabel(drawn.title("gas_pressure"))
    label_points(axes, _named(drawn), (drawn.degrees, values))
    return drawn.finished("pressure", figure)


def _space(drawn: Drawn) -> WorkingSpace:
    space: WorkingSpace | None = drawn.results.solved.space
    if space is None:
        raise CrankworkError("this figure needs the gas of a cylinder")
    return space


def _named(drawn: Drawn) -> list[tuple[str, float, float]]:
    """Return the named points of the diagram: name, crank angle [deg] and gauge pressure [display unit]."""
    space = _space(drawn)
    return [
        (name, angle, displayed("gas_pressure", pressure - space.ambient))
        for name, (angle, pressure) in space.diagram.named.items()
    ]


def indicator(drawn: Drawn) -> bytes:
    """Return the gas pressure over the volume, with the volumes at the dead centres.

    Parameters
    ----------
    drawn : Drawn
        What the figures share.

    Returns
    -------
    bytes
        SVG.
    """
    language, space = drawn.language, _space(drawn)
    figure, axes = single_axes(language, 0, height=3.4, above=0.42)
    volume, values = drawn.values("cylinder_volume"), drawn.values("gas_pressure")
    axes.plot(volume, values, color="black")
    axes.set_xlim(0, 1.06 * float(np.max(volume)))
    through_zero(axes, values)
    axes.set_xlabel(drawn.title("cylinder_volume"))
    axes.set_ylabel(drawn.title("gas_pressure"))
    centres = _dead_centres(axes, space, language)
    at_angle = [(name, float(np.interp(angle, drawn.degrees, volume)), value) for name, angle, value in _named(drawn)]
    label_points(axes, at_angle, (volume, values), *centres)
    return drawn.finished("indicator", figure)


def _dead_centres(axes: Axes, space: WorkingSpace, language: Language) -> list[Line]:
    """Mark the volumes at the dead centres, with clearance and swept volume between, and return the two lines."""
    top, bottom = (displayed("cylinder_volume", one) for one in (space.clearance, space.clearance + space.swept))
    above = axes.get_xaxis_transform()
    for name, at in (("tdc", top), ("bdc", bottom)):
        axes.plot([at, at], [0, 1.02], color="black", linewidth=0.6, linestyle=DASH_DOT, transform=above, clip_on=False)
        axes.text(at, 1.08, figure_word(name, language), size=8, ha="center", va="bottom", transform=above)
    for key, start, end in (("clearance_volume", 0.0, top), ("swept_volume", top, bottom)):
        arrow = {"arrowstyle": "<->", "linewidth": 0.6, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 6}
        axes.annotate("", (start, 1.02), (end, 1.02), above, arrowprops=arrow, annotation_clip=False)
        name = math_symbol(symbol(key, language))
        axes.text((start + end) / 2, 1.03, name, size=8, ha="center", va="bottom", transform=above)
    return [([at, at], list(axes.get_ylim())) for at in (top, bottom)]
