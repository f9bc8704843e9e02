"""Figures of a map: contour lines over two numbers of a file, a curve over one."""

from __future__ import annotations

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language, capital, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Quantity
from crankwork.quantities.key import key_of
from crankwork.report.display import FILE_KEYS, displayed_column, key_unit, label
from crankwork.show.canvas import plain
from crankwork.show.chart import CIRCLE, Graph, Row, limits, round_ticks, sheet
from crankwork.show.contour import Field, contours
from crankwork.show.scene import Drawing
from crankwork.study.parameter_map import Map
from crankwork.study.study_text import axis_title
from crankwork.units import coherent_unit, from_si, use_units

_TALL, _WIDE_TALL = 250.0, 190.0
_LINES = 9
_DIGITS = 5


def map_drawings(parameter_map: Map, language: Language) -> dict[str, Drawing]:
    """Return a figure of every value that depends on a field, over the fields that it depends on."""
    with use_units(parameter_map.units):
        return {
            f"map.{key}": _drawing(parameter_map, key, language)
            for key in parameter_map.varying
            # the angle of the largest of two peaks is not a surface, nor is a stepped value
            if not key_of(key).quantity.endswith("_angle") and not _is_stepped(_dependent(parameter_map, key)[0])
        }


def _is_stepped(values: Array) -> bool:
    """Return whether few of all values differ, so that contours between them have no meaning."""
    known = values[np.isfinite(values)]
    return bool(2 * values.ndim * np.unique(known).size < known.size)


def _dependent(parameter_map: Map, key: str) -> tuple[Array, list[str]]:
    """Return values over the fields that they depend on, in display units, and these fields."""
    values = displayed_column(key, parameter_map.values[key])
    over = {
        field: index for index, field in enumerate(parameter_map.fields) if key not in parameter_map.independent[field]
    }
    for axis in sorted(set(range(values.ndim)) - set(over.values()), reverse=True):
        # equal along the axis, apart from points without a value
        values = np.fmax.reduce(values, axis=axis)
    return values, list(over)


def _drawing(parameter_map: Map, key: str, language: Language) -> Drawing:
    values, over = _dependent(parameter_map, key)
    rows = [Row(_largest(parameter_map, key, over, values, language), CIRCLE)]
    rows += [
        Row(translate("study.same_at", language, field=_symbol(parameter_map, field, language)), width=0.0)
        for field in parameter_map.fields
        if field not in over
    ]
    if np.isnan(values).any():
        rows.append(Row(translate("study.hatched", language), width=0.0))
    drawn = _surface if values.ndim == 2 else _curve
    return drawn(parameter_map, key, over, values, rows, language)


def _largest(parameter_map: Map, key: str, over: list[str], values: Array, language: Language) -> str:
    """Return the text of the largest value and its position."""
    place = np.unravel_index(np.nanargmax(values), values.shape)
    positions = []
    for field, index in zip(over, place, strict=True):
        text = _shown(float(_at(parameter_map, field)[index]), parameter_map.fields[field].unit, language)
        positions.append(f"{_symbol(parameter_map, field, language)} = {text}")
    value = _shown(float(values[place]), key_unit(key), language)
    return translate("study.largest", language, value=value, where=", ".join(positions))


def _shown(value: float, unit: str, language: Language) -> str:
    space = "" if unit == "deg" else " "
    return f"{number(value, language, digits=_DIGITS)}{space}{unit_name(unit, language)}".rstrip()


def _at(parameter_map: Map, field: str) -> Array:
    return np.asarray(from_si(parameter_map.points[field].values, parameter_map.fields[field].unit))


def _axis(parameter_map: Map, field: str, language: Language) -> str:
    unit, row = unit_name(parameter_map.fields[field].unit, language), _quantity(parameter_map, field)
    name = f"{plain(row.label(language))} ${row.symbol(language)}$" if row else plain(field)
    return f"{name}, {unit}" if unit else name


def _symbol(parameter_map: Map, field: str, language: Language) -> str:
    """Return the symbol of a field, its key if there is none."""
    row = _quantity(parameter_map, field)
    return f"${row.symbol(language)}$" if row else plain(field)


def _quantity(parameter_map: Map, field: str) -> Quantity | None:
    """Return the quantity that a field of a table states, by its own name or that of its table, or None."""
    table, _, key = field.partition(".")
    unit = coherent_unit(parameter_map.fields[field].unit)
    names = (f"rotational_{key}", f"{table}_{key}", FILE_KEYS.get(key, key))
    return next((QUANTITIES[name] for name in names if name in QUANTITIES and QUANTITIES[name].si_unit == unit), None)


def _ends(values: Array) -> tuple[float, float]:
    return float(values[0]), float(values[-1])


def _title(key: str, language: Language) -> str:
    return translate("study.map_of", language, name=label(key, language))


def _surface(
    parameter_map: Map, key: str, over: list[str], values: Array, rows: list[Row], language: Language
) -> Drawing:
    x, y = (_at(parameter_map, name) for name in over)
    paper, box = sheet(_TALL, [Row(capital(axis_title(key, language)), width=0.0), *rows])
    graph = Graph(paper, box, _ends(x), _ends(y), language)
    field = Field(x, y, values)
    for across, up in np.argwhere(field.holes):
        corners = x[[across, across + 1, across + 1, across]], y[[up, up, up + 1, up + 1]]
        graph.hatch(*corners)
    graph.frame(round_ticks(*graph.x), graph.up_ticks)
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    levels = round_ticks(low, high, _LINES)
    across, up = np.unravel_index(np.nanargmax(values), values.shape)
    largest = graph.point(float(x[across]), float(y[up]))
    contours(graph, field, levels[(levels > low) & (levels < high)], largest)
    paper.dot(*largest, 2.6, fill="#ffffff", width=0.9)
    graph.x_title(_axis(parameter_map, over[0], language))
    graph.y_title(_axis(parameter_map, over[1], language))
    return paper.drawing(_title(key, language), language)


def _curve(
    parameter_map: Map, key: str, over: list[str], values: Array, rows: list[Row], language: Language
) -> Drawing:
    x = _at(parameter_map, over[0])
    paper, box = sheet(_WIDE_TALL, rows)
    graph = Graph(paper, box, _ends(x), limits(values, is_place=True), language)
    graph.frame(round_ticks(*graph.x), graph.up_ticks)
    graph.curve(key, x, values)
    for position, value in zip(x.tolist(), values.tolist(), strict=True):
        if np.isfinite(value):
            paper.dot(*graph.point(position, value), 1.3)
    largest = int(np.nanargmax(values))
    paper.dot(*graph.point(float(x[largest]), float(values[largest])), 2.6, fill="#ffffff", width=0.9)
    graph.x_title(_axis(parameter_map, over[0], language))
    graph.y_title(axis_title(key, language))
    return paper.drawing(_title(key, language), language)
