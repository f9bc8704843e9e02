"""Tables of results as CSV and as a workbook."""

from __future__ import annotations

import io
import math
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import replace
from datetime import datetime
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.rounding import without_rounding
from crankwork.errors import CrankworkError, MissingExtraError
from crankwork.locale import Refusal, say
from crankwork.locale.numbers import unit_name
from crankwork.quantities import Language
from crankwork.report.comparison import comparison_columns
from crankwork.report.language import displayed_column, in_own_units, key_unit, label, row_name
from crankwork.report.summary import provenance

if TYPE_CHECKING:
    import xlsxwriter

# cells of a workbook that memory has no room for
_MANY = 500_000
_CREATED = datetime(2000, 1, 1)  # noqa: DTZ001 - a workbook knows no time zones


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
        name: sheet(one.names, {key: displayed_column(key, one.columns[key], per_area=area) for key in one.columns})
        for name, one in results.listings.items()
    }


def csv_of_sheet(sheet: Sheet, *, for_excel: bool = False) -> bytes:
    """Return one table as CSV."""
    separator = ";" if for_excel else ","
    headings = [_quoted(f"{key} [{sheet.units[key] or '-'}]") for key in sheet.columns]
    columns = [[_number(one, for_excel=for_excel) for one in values.tolist()] for values in sheet.columns.values()]
    if sheet.names:
        headings.insert(0, "row")
        columns.insert(0, list(sheet.names))
    rows = zip(*columns, strict=True)
    lines = [separator.join(headings), *(separator.join(row) for row in rows)]
    text = "\r\n".join([*lines, ""])
    return ("\ufeff" + text if for_excel else text).encode()


def _number(value: float, *, for_excel: bool) -> str:
    """Return a number with all digits; an empty field where there is none."""
    if value != value:  # noqa: PLR0124 - not a number
        return ""
    return repr(value).replace(".", ",") if for_excel else repr(value)


def _quoted(heading: str) -> str:
    """Return a heading as CSV has it: names of joints are the user's and may hold separators and quotes."""
    return '"' + heading.replace('"', '""') + '"' if any(mark in heading for mark in ',;"') else heading


def workbook(results: Results, *, language: Language = "en", per_area: bool = False) -> bytes:
    """Return all tables and the summary as an XLSX workbook."""
    try:
        import xlsxwriter  # noqa: PLC0415 - an optional part
        from xlsxwriter.exceptions import FileCreateError  # noqa: PLC0415
    except ImportError:
        raise MissingExtraError(Refusal("extra_writing", names="XLSX"), "tables") from None
    stream, tables = io.BytesIO(), sheets(results, per_area=per_area)
    cells = sum(len(column) for table in tables.values() for column in table.columns.values())
    # rows that are written wait in files, which takes longer where they are few
    kept = {"in_memory": True} if cells < _MANY else {"constant_memory": True}
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        book = xlsxwriter.Workbook(stream, {**kept, "strings_to_formulas": False, "tmpdir": folder})
        # the same tables are the same bytes
        told = {"title": results.machine.title[:255], "comments": provenance(results)}
        book.set_properties({"created": _CREATED, **told})
        try:
            _fill(book, tables, language)
            book.close()
        except (OSError, FileCreateError) as error:
            raise _full(error) from None
        finally:
            # a workbook that could not be finished leaves the files of its rows open
            for rows in (getattr(one, "row_data_fh", None) for one in book.worksheets()):
                if rows is not None:
                    rows.close()
    return stream.getvalue()


def _full(error: Exception) -> CrankworkError:
    """Return the refusal for a place that could not take the rows of a workbook."""
    full = error if isinstance(error, OSError) else error.args[0]
    reason = str(getattr(full, "strerror", None) or full).lower()
    return CrankworkError(Refusal("place_unwritable", path=tempfile.gettempdir(), reason=reason))


def _fill(book: xlsxwriter.Workbook, tables: Mapping[str, Sheet], language: Language) -> None:
    """Write tables into a workbook, row by row."""
    heading = book.add_format({"bold": True, "text_wrap": True, "valign": "top", "bottom": 1})
    decimals = book.add_format({"num_format": "0.0000"})
    taken: set[str] = set()
    for name, table in tables.items():
        sheet = book.add_worksheet(_sheet_name(say(f"tables.{name}", language), taken))
        sheet.freeze_panes(1, 1)
        first = 1 if table.names else 0
        sheet.set_column(0, first + len(table.columns) - 1, 16, decimals)
        if table.names:
            sheet.write_string(0, 0, say("report.row", language), heading)
        for number, key in enumerate(table.columns, start=first):
            unit, title = unit_name(table.units[key], language), label(key, language)
            sheet.write_string(0, number, f"{title}, {unit}" if unit else title, heading)
        columns = [values.tolist() for values in table.columns.values()]
        for row, values in enumerate(zip(*columns, strict=True), start=1):
            if table.names:
                sheet.write_string(row, 0, row_name(table.names[row - 1], language))
            for number, value in enumerate(values, start=first):
                if math.isfinite(value):
                    sheet.write_number(row, number, value)


def _sheet_name(title: str, taken: set[str]) -> str:
    """Return a name for a sheet: at most 31 characters, none twice."""
    name, number = title[:31], 2
    while name in taken:
        name, number = f"{title[:28]} {number}", number + 1
    taken.add(name)
    return name
