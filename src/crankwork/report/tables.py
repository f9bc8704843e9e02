"""Tables of results, and as CSV."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.rounding_noise import without_rounding
from crankwork.report.comparison import comparison_columns
from crankwork.report.display import displayed_column, in_own_units, key_unit


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
