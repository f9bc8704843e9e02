"""Tables of results, and as CSV; results beside others, as a table, as text and as plain data."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.compare import Comparison
from crankwork.analysis.rounding_noise import without_rounding
from crankwork.locale import Language, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.report.display import (
    display_key,
    displayed,
    displayed_column,
    in_own_units,
    key_unit,
    label,
    method_name,
    rounded,
)

_NONE = "–"
# of a value, what is no difference
_ROUNDING = 1e-12


def table_column(results: Results, key: str, *, per_area: bool = False) -> Array:
    """Return a column in its display unit."""
    if key == "crank_angle":
        return results.grid.degrees
    return displayed_column(key, results.columns[key], per_area=results.summary["piston_area"] if per_area else None)


def any_nonzero(keys: Iterable[str], columns: Mapping[str, Array]) -> list[str]:
    """Return the keys whose columns are there and not zero throughout."""
    return [key for key in keys if key in columns and bool(np.any(columns[key]))]


class Sheet(NamedTuple):
    """One table in display units: what rows are called, if they are things, columns and their units by key."""

    names: tuple[str, ...]
    columns: Mapping[str, Array]
    units: Mapping[str, str]


@in_own_units
def sheets(results: Results, *, per_area: bool = False) -> dict[str, Sheet]:
    """Return every table by name: those over the crank angle, and the listings."""
    results = replace(results, columns=without_rounding(results.columns, results.machine.speed))
    area = results.summary["piston_area"] if per_area else None

    def sheet(names: tuple[str, ...], columns: Mapping[str, Array]) -> Sheet:
        return Sheet(names, columns, {key: key_unit(key, per_area=per_area) for key in columns})

    tables = {
        name: sheet((), {key: table_column(results, key, per_area=per_area) for key in keys})
        for name, keys in results.tables.items()
    }
    if compared := comparison_columns(results, per_area=per_area):
        tables["comparison"] = sheet((), compared)
    return tables | {
        name: sheet(
            listing.names, {key: displayed_column(key, listing.columns[key], per_area=area) for key in listing.columns}
        )
        for name, listing in results.listings.items()
    }


def csv_of_sheet(sheet: Sheet, *, for_excel: bool = False) -> bytes:
    """Return one table as CSV."""
    separator = ";" if for_excel else ","
    headings = [_quoted(f"{key} [{sheet.units[key] or '-'}]") for key in sheet.columns]
    columns = [[_number(value, for_excel=for_excel) for value in values.tolist()] for values in sheet.columns.values()]
    if sheet.names:
        headings.insert(0, "row")
        columns.insert(0, list(sheet.names))
    rows = zip(*columns, strict=True)
    lines = [separator.join(headings), *(separator.join(row) for row in rows)]
    text = "\r\n".join([*lines, ""])
    return ("\ufeff" + text if for_excel else text).encode()


def _number(value: float | str, *, for_excel: bool) -> str:
    """Return a number with all digits, or a word; an empty field where there is none."""
    if isinstance(value, str):
        return _quoted(value)
    if value != value:  # noqa: PLR0124 - not a number
        return ""
    return repr(value).replace(".", ",") if for_excel else repr(value)


def _quoted(heading: str) -> str:
    """Return a heading as CSV has it: names of joints are the user's and may hold separators and quotes."""
    return '"' + heading.replace('"', '""') + '"' if any(mark in heading for mark in ',;"') else heading


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
    titles = [
        own,
        *(title for name in names for title in (name, translate("report.less", language, name=name, other=own))),
    ]
    table = [["", "", *titles]]
    for key, values in comparison_rows(results, per_area=per_area).items():
        unit = unit_name(key_unit(key, per_area=per_area), language)
        name = label(display_key(key, results) if key in results.trace else key, language)
        table.append([name, unit, *(_NONE if math.isnan(value) else number(value, language) for value in values)])
    heading = "report.methods_compared" if compared.is_of_methods else "report.machines_compared"
    return "\n".join([translate(heading, language), *_aligned(table)])


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
