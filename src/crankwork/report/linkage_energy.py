"""The energy-mass diagram with its tangents, and the angular speed that follows."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from crankwork.analysis import Array
from crankwork.analysis.diagrams import Fluctuation, Tangents, tangents
from crankwork.locale import say
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.figure_data import figure_title
from crankwork.report.figure_labels import Line, label_points
from crankwork.report.figure_look import DASH_DOT, DASHED, DOTTED, single_axes, svg
from crankwork.report.language import number, symbol, unit_name
from crankwork.report.linkage_look import (
    PLAIN,
    Style,
    axis_title,
    figure_look,
    over_drive_angle,
    quantity_of,
)
from crankwork.units import shown_in

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def wittenbauer(inertia: Array, energy: Array, wanted: Fluctuation, degrees: Array, style: Style = PLAIN) -> bytes:
    """Return the energy-mass diagram, its tangents and the piece kl that they cut from the energy axis.

    `inertia` and `energy`: reduced moment of inertia [kg m2] and change of the kinetic energy [J] over one cycle;
    `degrees`: crank angles; every thirtieth degree is marked [deg].
    """
    found, language = tangents(inertia, energy, wanted), style.language
    # slopes and angles are those of J over kg m2
    with figure_look(), shown_in("metric"):
        figure, axes = single_axes(language, 2, height=4.6)
        _lines(axes, inertia, energy, found, degrees, language)
        axes.set_xlabel(_title("reduced_inertia", language))
        axes.set_ylabel(_title("kinetic_energy_change", language))
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=1, handlelength=3.2, borderpad=0.2)
        flywheel = say("drawing.flywheel", language)
        shown = f"{number(found.flywheel, language, digits=4)} {unit_name('kg*m2', language)}"
        slopes = r"\tan ψ_{\text{max}} - \tan ψ_{\text{min}}"
        return svg(
            figure, figure_title("wittenbauer", language), style.method, f"{flywheel}: $kl/({slopes})$ = {shown}"
        )


def _lines(axes: Axes, inertia: Array, energy: Array, found: Tangents, degrees: Array, language: Language) -> None:
    """Draw the curve, its tangents down to the energy axis, and the angles on it."""
    width = 1.08 * float(np.max(inertia))
    feet = (found.foot_max, found.foot_min)
    through = np.array([*energy, *feet, 0.0])
    margin = 0.06 * float(np.ptp(through))
    axes.set_xlim(0, width)
    axes.set_ylim(float(through.min()) - margin, float(through.max()) + margin)
    axes.plot(inertia, energy, color="black")
    axes.axhline(0, color="black", linewidth=0.8)
    lines: list[Line] = [(inertia, energy)]
    looks = ((found.slope_max, DASHED, "max"), (found.slope_min, DASH_DOT, "min"))
    for foot, (slope, line, name) in zip(feet, looks, strict=True):
        ends = ([0.0, width], [foot, foot + slope * width])
        axes.plot(*ends, color="black", linestyle=line, linewidth=0.9, label=_angle(axes, slope, name, language))
        lines.append(ends)
    marks = [int(np.argmin(np.abs(degrees - one))) for one in np.arange(0, float(degrees[-1]) - 1, 30)]
    points = [(f"{degrees[i]:g}", float(inertia[i]), float(energy[i])) for i in marks]
    label_points(axes, [*points, ("k", 0.0, feet[0]), ("l", 0.0, feet[1])], *lines)


# rows for the diagram until the table of quantities holds them


def _title(key: str, language: Language) -> str:
    return axis_title(QUANTITIES[key], language)


def _angle(axes: Axes, slope: float, name: str, language: Language) -> str:
    """Return the angle of a tangent on paper, in words of the legend."""
    (left, right), (bottom, top), box = axes.get_xlim(), axes.get_ylim(), axes.get_window_extent()
    angle = math.degrees(math.atan(slope * (right - left) / box.width * box.height / (top - bottom)))
    words = say("drawing.slope", language)
    unit = f"{unit_name('J', language)}/({unit_name('kg*m2', language)})"
    shown = f"{words} {number(slope, language, digits=4)} {unit}"
    return f"$ψ_{{\\text{{{name}}}}}$ = {number(angle, language, digits=4)}°; {shown}"


def speed_curve(degrees: Array, speed: Array, style: Style = PLAIN) -> bytes:
    """Return the angular speed of the crank over one cycle, with its largest, mean and smallest value."""
    language, row = style.language, quantity_of("speed")
    low, high = float(np.min(speed)), float(np.max(speed))
    with figure_look():
        figure, axes = single_axes(language, 1)
        axes.plot(degrees, speed, color="black")
        sign = symbol("speed", language)
        for value, name, line in ((high, "max", DOTTED), ((low + high) / 2, "m", DASHED), (low, "min", DOTTED)):
            text = f"${sign}_{{\\text{{{name}}}}}$ = {number(value, language, digits=5)}"
            axes.axhline(value, color="black", linewidth=0.8, linestyle=line, label=text)
        delta = 2 * (high - low) / (high + low)
        axes.plot([], [], " ", label=f"$δ$ = {number(delta, language, digits=3)}")
        axes.legend(
            loc="lower left", bbox_to_anchor=(0, 1), ncols=4, handlelength=2.4, borderpad=0.2, columnspacing=1.4
        )
        spare = 0.08 * (high - low) or 0.01 * high
        axes.set_ylim(low - spare, high + spare)
        over_drive_angle(axes, (float(degrees[0]), float(degrees[-1])), language)
        axes.set_ylabel(axis_title(row, language))
        return svg(figure, figure_title("speed", language), style.method)
