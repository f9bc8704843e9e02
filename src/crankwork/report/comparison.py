"""Results beside others: as a table over the crank angle, as text, as plain data and as a figure."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.compare import Comparison, beside, difference
from crankwork.locale import Language, say
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES
from crankwork.report.language import (
    display_key,
    displayed,
    in_own_units,
    key_unit,
    label,
    method_name,
    rounded,
    symbol,
)
from crankwork.show.chart import LEGEND_ROW, ChartBox, Graph, Row, limits, over_cycle, round_ticks, sheet
from crankwork.show.paper import Canvas
from crankwork.show.scene import DASH_DOT, DASHED, DOTTED, SOLID, Drawing, Style

_NONE = "–"
# of a value, what is no difference
_ROUNDING = 1e-12
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


@in_own_units
def comparison_columns(results: Results, *, per_area: bool = False) -> dict[str, Array]:
    """Return the table of a comparison in display units: crank angle, and each column by each name with differences."""
    compared = results.compared
    if compared is None or not compared.keys:
        return {}
    area = results.summary["piston_area"] if per_area else None
    first: dict[str, Array] = {"crank_angle": results.grid.degrees}
    if "time" in results.columns:
        first = {"time": results.columns["time"]}
    return first | {key: values * displayed(key, 1.0, per_area=area) + 0.0 for key, values in compared.columns.items()}


@in_own_units
def comparison_rows(results: Results, *, per_area: bool = False) -> dict[str, tuple[float, ...]]:
    """Return single values in display units by key: the own one, and for each other its value and the difference."""
    if results.compared is None:
        return {}
    areas = [compared.summary["piston_area"] if per_area else None for compared in (results, *results.compared.others)]
    rows = {}
    for key, values in results.compared.values(results).items():
        own, *further = (displayed(key, value, per_area=area) for value, area in zip(values, areas, strict=True))
        rows[key] = (own, *(shown for other in further for shown in (other, _less(other, own))))
    return rows


def _less(other: float, own: float) -> float:
    """Return the difference of two values, zero where only rounding is left."""
    return 0.0 if abs(other - own) <= _ROUNDING * abs(own) else other - own


@in_own_units
def comparison_text(results: Results, language: Language = "en", *, per_area: bool = False) -> str:
    """Return the single values beside those of the others as aligned text."""
    compared = results.compared
    if compared is None:
        return ""
    own, *names = compared.names
    titles = [own, *(title for name in names for title in (name, say("report.less", language, name=name, other=own)))]
    table = [["", "", *titles]]
    for key, values in comparison_rows(results, per_area=per_area).items():
        unit = unit_name(key_unit(key, per_area=per_area), language)
        name = label(display_key(key, results) if key in results.memory else key, language)
        table.append([name, unit, *(_shown(value, language) for value in values)])
    return "\n".join([say(_heading(compared), language), *_aligned(table)])


def _heading(compared: Comparison) -> str:
    return "report.methods_compared" if compared.is_of_methods else "report.machines_compared"


def _shown(value: float, language: Language) -> str:
    return _NONE if math.isnan(value) else number(value, language)


def _aligned(table: list[list[str]]) -> list[str]:
    wide = [max(len(row[index]) for row in table) for index in range(len(table[0]))]
    sides = "<<" + ">" * (len(wide) - 2)
    return [
        "  " + "  ".join(f"{cell:{side}{w}}" for cell, side, w in zip(row, sides, wide, strict=True)).rstrip()
        for row in table
    ]


@in_own_units
def comparison_data(results: Results, *, per_area: bool = False) -> dict[str, Any]:
    """Return the single values of the others, and how far they are above the own ones, as plain data."""
    if results.compared is None:
        return {}
    own, *other_names = results.compared.names
    rows = comparison_rows(results, per_area=per_area)

    def plain(value: float) -> float | None:
        return None if math.isnan(value) else rounded(value)

    each = {
        name: {
            key: {"value": plain(values[2 * index + 1]), "difference": plain(values[2 * index + 2]),
                  "unit": key_unit(key, per_area=per_area)}
            for key, values in rows.items()
        }
        for index, name in enumerate(other_names)
    }  # fmt: skip
    return {"comparison": {"own": own, "others": each}}


def shown_names(compared: Comparison, language: Language) -> list[str]:
    """Return the names of what is compared: methods in words, machines by the names of their files."""
    if not compared.is_of_methods:
        return list(compared.names)
    parts = [name.partition(":") for name in compared.names]
    return [method_name(kind, int(order or 0), "", language) for kind, _, order in parts]


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
