"""Figures of a map: lines of equal value over two numbers of a file, a curve over one."""

from __future__ import annotations

import numpy as np

from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Language, capital, say
from crankwork.locale.numbers import number, unit_name
from crankwork.quantities import QUANTITIES, Quantity
from crankwork.report.language import FILE_KEYS, displayed_column, key_unit, label
from crankwork.show.chart import CIRCLE, Graph, Row, limits, round_ticks, sheet
from crankwork.show.contour import Field, contours
from crankwork.show.paper import plain
from crankwork.show.scene import Drawing
from crankwork.study.mapped import Map
from crankwork.units import coherent_unit, from_si, use_units

_TALL, _WIDE_TALL = 250.0, 190.0
_LINES = 9
_DIGITS = 5


def map_drawings(found: Map, language: Language) -> dict[str, Drawing]:
    """Return a figure of every value that depends on a field, over those fields that it depends on."""
    with use_units(found.units):
        return {
            f"map.{key}": _drawing(found, key, language)
            for key in found.varying
            # the angle of the largest of two peaks is no surface, nor is what goes in steps
            if not key.partition(".")[0].endswith("_angle") and not _goes_in_steps(_dependent(found, key)[0])
        }


def _goes_in_steps(values: Array) -> bool:
    """Return whether few of all values differ, so that between points of a map there is nothing."""
    known = values[np.isfinite(values)]
    return bool(2 * values.ndim * np.unique(known).size < known.size)


def _dependent(found: Map, key: str) -> tuple[Array, list[str]]:
    """Return values over the fields that they depend on, in the unit that they are displayed in, and these fields."""
    values = displayed_column(key, found.values[key])
    over = {one: at for at, one in enumerate(found.fields) if key not in found.independent[one]}
    for axis in sorted(set(range(values.ndim)) - set(over.values()), reverse=True):
        # the same all along, where there are any
        values = np.fmax.reduce(values, axis=axis)
    return values, list(over)


def _drawing(found: Map, key: str, language: Language) -> Drawing:
    values, over = _dependent(found, key)
    rows = [Row(_largest(found, key, over, values, language), CIRCLE)]
    rows += [
        Row(say("study.same_at", language, field=_symbol(found, one, language)), width=0.0)
        for one in found.fields
        if one not in over
    ]
    if np.isnan(values).any():
        rows.append(Row(say("study.hatched", language), width=0.0))
    drawn = _surface if values.ndim == 2 else _curve
    return drawn(found, key, over, values, rows, language)


def _largest(found: Map, key: str, over: list[str], values: Array, language: Language) -> str:
    """Return the largest value and where it is."""
    place = np.unravel_index(np.nanargmax(values), values.shape)
    where = ", ".join(
        f"{_symbol(found, one, language)} = {_shown(float(_at(found, one)[at]), found.fields[one].unit, language)}"
        for one, at in zip(over, place, strict=True)
    )
    value = _shown(float(values[place]), key_unit(key), language)
    return say("study.largest", language, value=value, where=where)


def _shown(value: float, unit: str, language: Language) -> str:
    space = "" if unit == "deg" else " "
    return f"{number(value, language, digits=_DIGITS)}{space}{unit_name(unit, language)}".rstrip()


def _at(found: Map, field: str) -> Array:
    return np.asarray(from_si(found.at[field].at, found.fields[field].unit))


def _axis(found: Map, field: str, language: Language) -> str:
    unit, row = unit_name(found.fields[field].unit, language), _quantity(found, field)
    name = f"{plain(row.label(language))} ${row.symbol(language)}$" if row else plain(field)
    return f"{name}, {unit}" if unit else name


def _symbol(found: Map, field: str, language: Language) -> str:
    """Return the symbol of a field, its key where it has none."""
    row = _quantity(found, field)
    return f"${row.symbol(language)}$" if row else plain(field)


def _quantity(found: Map, field: str) -> Quantity | None:
    """Return the quantity that a field of a table states, if it is one by its own name or by that of its table."""
    table, _, key = field.partition(".")
    unit = coherent_unit(found.fields[field].unit)
    names = (f"rotational_{key}", f"{table}_{key}", FILE_KEYS.get(key, key))
    return next((QUANTITIES[one] for one in names if one in QUANTITIES and QUANTITIES[one].si_unit == unit), None)


def _named(key: str, language: Language) -> str:
    unit = unit_name(key_unit(key), language)
    return plain(f"{label(key, language)}, {unit}" if unit else label(key, language))


def _ends(values: Array) -> tuple[float, float]:
    return float(values[0]), float(values[-1])


def _title(key: str, language: Language) -> str:
    return say("study.map_of", language, name=label(key, language))


def _surface(found: Map, key: str, over: list[str], values: Array, rows: list[Row], language: Language) -> Drawing:
    x, y = (_at(found, one) for one in over)
    paper, box = sheet(_TALL, [Row(capital(_named(key, language)), width=0.0), *rows])
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
    paper.dot(*largest, 2.6, fill="#ffffff", width=1.0)
    graph.x_title(_axis(found, over[0], language))
    graph.y_title(_axis(found, over[1], language))
    return paper.drawing(_title(key, language), language)


def _curve(found: Map, key: str, over: list[str], values: Array, rows: list[Row], language: Language) -> Drawing:
    x = _at(found, over[0])
    paper, box = sheet(_WIDE_TALL, rows)
    graph = Graph(paper, box, _ends(x), limits(values, is_place=True), language)
    graph.frame(round_ticks(*graph.x), graph.up_ticks)
    graph.curve(key, x, values)
    for at, value in zip(x.tolist(), values.tolist(), strict=True):
        if np.isfinite(value):
            paper.dot(*graph.point(at, value), 1.3)
    largest = int(np.nanargmax(values))
    paper.dot(*graph.point(float(x[largest]), float(values[largest])), 2.6, fill="#ffffff", width=1.0)
    graph.x_title(_axis(found, over[0], language))
    graph.y_title(_named(key, language))
    return paper.drawing(_title(key, language), language)
