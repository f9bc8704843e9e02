"""The figures of a shaft with torques on it: turning moment diagram with its loops, energy, speed."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.turning import TurningDiagram, turning_diagram
from crankwork.locale import say
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.figure_data import figure_title
from crankwork.report.figure_labels import label_points
from crankwork.report.figure_look import (
    BOTTOM,
    DASH_DOT,
    DASHED,
    DOTTED,
    add_axes,
    legend_above,
    math_symbol,
    new_figure,
    plain,
    single_axes,
    svg,
    through_zero,
)
from crankwork.report.language import number, unit_name
from crankwork.report.linkage_energy import speed_curve
from crankwork.report.linkage_look import Style, axis_title, displayed_values, figure_look
from crankwork.report.summary import results_method
from crankwork.units import from_si

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_UPPER, _LOWER, _GAP, _TOP = 3.0, 2.0, 0.2, 0.5
_TICKS = (10.0, 15.0, 30.0, 60.0, 90.0, 180.0, 360.0, 720.0, 1800.0, 3600.0)
_MOST_TICKS = 12
_MOST_NAMED = 24


def turning_figures(results: Results, *, language: Language = "en") -> dict[str, bytes]:
    """Return the figures of a shaft as SVG by name; those for which nothing is known are left out."""
    style, drawn = Style(language, (), results_method(results, language)), _shown(turning_diagram(results))
    if drawn is None:
        loops = results.listings.get("energy_extremes")
        return {} if loops is None else {"loops": _loops(loops.columns["kinetic_energy_change"], style)}
    figures = {"turning_moment": _diagram(results, drawn, style)}
    if "crank_speed" in results.columns:
        speed = results.columns_at(drawn.degrees, ["crank_speed"])["crank_speed"]
        figures["speed"] = speed_curve(drawn.degrees, speed, style)
    return figures


def _shown(drawn: TurningDiagram | None) -> TurningDiagram | None:
    """Return a diagram in display units."""
    if drawn is None:
        return None
    torque, work = (float(from_si(1.0, QUANTITIES[key].unit)) for key in ("turning_moment", "excess_work"))
    return drawn._replace(
        torque=drawn.torque * torque,
        load=drawn.load * torque,
        energy=drawn.energy * work,
        loops=tuple((middle, height * torque, one) for middle, height, one in drawn.loops),
    )


def _diagram(results: Results, drawn: TurningDiagram, style: Style) -> bytes:
    """Return the torque over its load with the works of the loops between them, and below it the energy."""
    language = style.language
    with figure_look():
        figure = new_figure(BOTTOM + _LOWER + _GAP + _UPPER + _TOP)
        lower = add_axes(figure, language, BOTTOM, _LOWER)
        upper = add_axes(figure, language, BOTTOM + _LOWER + _GAP, _UPPER)
        _energy(lower, results, drawn, language)
        _torques(upper, results, drawn, language)
        for axes in (upper, lower):
            over_period(axes, float(drawn.degrees[-1]), language)
        through_zero(lower, drawn.energy)
        through_zero(upper, drawn.torque, drawn.load)
        upper.set_xlabel("")
        upper.tick_params(labelbottom=False)
        excess = results.summary["excess_work"]
        remark = f"{math_symbol(QUANTITIES['excess_work'].symbol(language))} = {_work(excess, language)}"
        return svg(figure, figure_title("turning_moment", language), style.method, remark)


def _torques(axes: Axes, results: Results, drawn: TurningDiagram, language: Language) -> None:
    over = drawn.torque > drawn.load
    for where, colour, hatch in ((over, "0.85", ""), (~over, "white", "////")):
        axes.fill_between(
            drawn.degrees, drawn.torque, drawn.load, where=where.tolist(), facecolor=colour, edgecolor="0.6",
            hatch=hatch, linewidth=0.0, interpolate=True,
        )  # fmt: skip
    turning = results.machine.turning
    given = {} if turning is None else turning.diagrams
    for key, values, table, line in (
        ("turning_moment", drawn.torque, "torque", "-"),
        ("load_torque", drawn.load, "load", DASHED),
    ):
        row, mean = QUANTITIES[key], f" ({say('report.mean', language)})" if table not in given else ""
        name = f"{math_symbol(row.symbol(language))} – {plain(row.label(language))}{mean}"
        axes.plot(drawn.degrees, values, color="black", linestyle=line, label=name)
    names = ", ".join(math_symbol(QUANTITIES[key].symbol(language)) for key in ("turning_moment", "load_torque"))
    axes.set_ylabel(f"{names}, {unit_name(QUANTITIES['turning_moment'].unit, language)}")
    legend_above(axes)
    if len(drawn.loops) <= _MOST_NAMED:
        for middle, height, work in drawn.loops:
            axes.annotate(
                _work(work, language, sign=True), (middle, height), ha="center", va="center", size=7.5,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8, "alpha": 0.85},
            )  # fmt: skip


def _work(work: float, language: Language, *, sign: bool = False) -> str:
    unit = QUANTITIES["excess_work"].unit
    shown = number(float(from_si(work, unit)), language, digits=4)
    return f"{'+' if sign and work > 0 else ''}{shown} {unit_name(unit, language)}"


def _energy(axes: Axes, results: Results, drawn: TurningDiagram, language: Language) -> None:
    row = QUANTITIES["kinetic_energy_change"]
    axes.plot(drawn.degrees, drawn.energy, color="black")
    columns = results.listings["energy_extremes"].columns
    angle, energy = np.degrees(columns["crank_angle"]), displayed_values(row, columns["kinetic_energy_change"])
    for find, line in ((np.argmax, DASH_DOT), (np.argmin, DOTTED)):
        axes.axhline(float(energy[int(find(energy))]), color="black", linewidth=0.8, linestyle=line)
    if angle.size <= _MOST_NAMED:
        axes.plot(angle, energy, "o", color="black", markersize=2.6, clip_on=False)
    axes.set_ylabel(axis_title(row, language).replace(" $", "\n$", 1))


def over_period(axes: Axes, end: float, language: Language) -> None:
    """Make the horizontal axis the angle of a shaft over a period of any length. [deg]"""
    step = next((one for one in _TICKS if end / one <= _MOST_TICKS), 10 ** math.ceil(math.log10(end / _MOST_TICKS)))
    axes.set_xlim(0, end)
    axes.set_xticks(np.arange(0.0, end * (1 + 1e-9), step))
    sign = math_symbol(QUANTITIES["crank_angle"].symbol(language))
    axes.set_xlabel(f"{say('drawing.angle_of_shaft', language)} {sign}, °")


def _loops(energy: Array, style: Style) -> bytes:
    """Return the energy after each loop about the mean, as a broken line over their numbers."""
    language, row = style.language, QUANTITIES["kinetic_energy_change"]
    count, values = np.arange(energy.size + 1.0), displayed_values(row, np.append(0.0, energy))
    with figure_look():
        figure, axes = single_axes(language, 0)
        axes.plot(count, values, color="black")
        axes.set_xlim(0, energy.size)
        axes.set_xticks(count[:: max(1, math.ceil(count.size / _MOST_TICKS))])
        through_zero(axes, values)
        names = [(number(y, language, digits=4), x, y) for x, y in zip(count.tolist(), values.tolist(), strict=True)]
        label_points(axes, names, (count, values))
        axes.set_xlabel(axis_title(QUANTITIES["loop_number"], language))
        axes.set_ylabel(axis_title(row, language))
        return svg(figure, figure_title("loops", language), style.method)
