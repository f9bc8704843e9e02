"""Figures of results, as many as there are data for, and the figure of a comparison."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import partial

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.compare import Comparison, beside, difference
from crankwork.locale import say
from crankwork.locale.numbers import unit_name
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.comparison import shown_names
from crankwork.report.engine_figure_data import engine_drawn
from crankwork.report.engine_figure_list import engine_pictures
from crankwork.report.language import displayed, for_readers, in_own_units, key_unit, symbol
from crankwork.report.linkage_figures import linkage_pictures
from crankwork.report.turning_figures import turning_pictures
from crankwork.show.chart import LEGEND_ROW, ChartBox, Graph, Row, limits, over_cycle, round_ticks, sheet
from crankwork.show.paper import Canvas
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, Drawing, Style
from crankwork.show.svg import svg
from crankwork.show.theme import Theme

_STEP, _MOST = 1.0, 2000
# a cycle of more has no lines at multiples of 90 degrees
_LONG = 720.0
_STYLES: tuple[Style, ...] = (SOLID, DASHED, DASH_DOT, DOTTED)
_COLOURS = ("#000000", "#b03030", "#2f5fa8", "#3a7d44", "#8a5a9c", "#a87b1f", "#4d4d4d")
_UPPER, _LOWER, _GAP = 110.0, 62.0, 12.0
# what a page of a note holds of it beside its caption, without axis and edges [pt]
_TALLEST = 540.0
# what a figure shows: of each row the first kind that there is
_DRAWN = (
    ("piston_displacement", "slider_displacement", "link_angle", "turning_moment"),
    ("piston_velocity", "slider_velocity", "link_angular_velocity", "excess_torque"),
    ("piston_acceleration", "slider_acceleration", "link_angular_acceleration", "kinetic_energy_change"),
    ("total_torque", "crank_torque", "driving_torque", "balancing_torque", "static_torque", "driver_force",
     "driver_torque"),
)  # fmt: skip


def figures(
    results: Results, *, language: Language = "en", per_area: bool = False, theme: Theme = "print"
) -> dict[str, bytes]:
    """Return the figures of a machine as SVG by name; those for which nothing is known are left out.

    `theme`: `print`, `colour` or `dark`.

    Raises
    ------
    CrankworkError
        If forces per area are asked for where no bore is known.
    """
    return {
        name: svg(drawing, theme) for name, drawing in drawings(results, language=language, per_area=per_area).items()
    }


@for_readers
def drawings(
    results: Results, *, language: Language = "en", per_area: bool = False, only: Collection[str] | None = None
) -> dict[str, Drawing]:
    """Return the figures of a machine as drawings; `only`: the names of those that are wanted."""
    listed = _pictures(results, language, per_area=per_area)
    return {name: draw() for name, draw in listed.items() if only is None or name in only}


@for_readers
def figure_names(results: Results, language: Language = "en") -> list[str]:
    """Return the names of the figures of a machine, of which none is drawn."""
    return list(_pictures(results, language, per_area=False))


def _pictures(results: Results, language: Language, *, per_area: bool) -> dict[str, Callable[[], Drawing]]:
    """Return the functions that draw the figures of a machine."""
    listed = linkage_pictures if results.machine.turning is None else turning_pictures
    pictures = listed(results, language)
    if "piston_displacement" in results.columns:
        pictures |= engine_pictures(engine_drawn(results, language, per_area=per_area))
    if results.compared is not None and drawn_keys(results.compared):
        pictures["comparison"] = partial(comparison_figure, results, results.compared, language, per_area=per_area)
    return pictures


@in_own_units
def comparison_figure(results: Results, compared: Comparison, language: Language, *, per_area: bool = False) -> Drawing:
    """Return the figure of a comparison: quantities by each name, and below each its differences."""
    keys = drawn_keys(compared)
    # two machines have pistons of their own
    per_area = per_area and compared.is_of_methods
    cycle = results.machine.cycle
    degrees = np.linspace(0.0, cycle, min(round(cycle / _STEP), _MOST) + 1)
    area = results.summary["piston_area"] if per_area else None
    columns = compared.columns_at(degrees)
    other_names, named = compared.names[1:], shown_names(compared, language)
    looks = zip(named, _looks(compared.names), strict=True)
    rows = [Row(shown, style, 1.2, colour) for shown, (_, style, colour) in looks]
    if len(other_names) == 1:
        rows.append(Row(f"Δ: {say('report.less', language, name=named[1], other=named[0])}", width=0.0))
    else:
        rows.append(Row(f"Δ: {say('report.less_own', language, other=named[0])}", width=0.0))
    room = (_TALLEST - LEGEND_ROW * len(rows)) / len(keys) - 1.5 * _GAP
    upper, lower = (min(most, share * room) for most, share in ((_UPPER, 0.63), (_LOWER, 0.37)))
    paper, box = sheet(len(keys) * (upper + lower + 1.5 * _GAP) - _GAP, rows)
    abscissas = _across(results, degrees)
    top = box.top
    for key in keys:
        scale, unit = displayed(key, 1.0, per_area=area), unit_name(key_unit(key, per_area=per_area), language)
        sign = QUANTITIES[key.partition(".")[0]]._replace(key=key).symbol(language)
        for names, place, tall, mark in (
            ([(beside(key, name), name) for name in compared.names], top, upper, f"${sign}$"),
            ([(difference(key, name), name) for name in other_names], top + upper + _GAP / 2, lower, f"$Δ{sign}$"),
        ):
            is_last = key == keys[-1] and place > top
            curves = {name: columns[column] * scale for column, name in names}
            graph = _graph(
                paper, ChartBox(box.left, place, box.width, tall), abscissas, curves, results, language, numbers=is_last
            )
            for name, style, colour in _looks(compared.names):
                if name in curves:
                    graph.curve(name, abscissas, curves[name], style, colour=colour)
            graph.y_title(f"{mark}, {unit}" if unit else mark)
            if is_last:
                graph.x_title(_x_title(results, language))
        top += upper + lower + 1.5 * _GAP
    return paper.drawing(say("figures.comparison", language), language)


def drawn_keys(compared: Comparison) -> list[str]:
    """Return the columns that a figure shows; of several links or sliders the last, which others move."""
    selected = []
    for kinds in _DRAWN:
        keys = {key.partition(".")[0]: key for key in compared.keys if np.any(compared.columns[_own(compared, key)])}
        selected += [keys[kind] for kind in kinds if kind in keys][:1]
    return selected


def _own(compared: Comparison, key: str) -> str:
    return beside(key, compared.names[0])


def _looks(names: tuple[str, ...]) -> list[tuple[str, Style, str]]:
    return [
        (name, _STYLES[min(index, len(_STYLES) - 1)], _COLOURS[index % len(_COLOURS)])
        for index, name in enumerate(names)
    ]


def _across(results: Results, degrees: Array) -> Array:
    return degrees * results.period / 360.0 if results.period else degrees


def _x_title(results: Results, language: Language) -> str:
    key = "time" if results.period else "crank_angle"
    return f"{QUANTITIES[key].label(language)} ${symbol(key, language)}$, {unit_name(key_unit(key), language)}"


def _graph(  # noqa: PLR0913 - place, curves and how they are told
    paper: Canvas,
    box: ChartBox,
    abscissas: Array,
    curves: Mapping[str, Array],
    results: Results,
    language: Language,
    *,
    numbers: bool,
) -> Graph:
    """Return a graph that holds all numbers of some curves, with its frame drawn."""
    y = limits(*curves.values())
    if results.period or results.machine.cycle > _LONG:
        over = "time" if results.period else "crank_angle"
        graph = Graph(paper, box, (0.0, float(abscissas[-1])), y, language, over)
        graph.frame(round_ticks(0.0, float(abscissas[-1])), round_ticks(*y, 4), labels=(numbers, True))
        return graph
    return over_cycle(paper, box, y, float(abscissas[-1]), language, numbers=numbers)
