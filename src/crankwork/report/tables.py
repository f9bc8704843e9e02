"""Tables of results as CSV and as a workbook."""

from __future__ import annotations

import io

import numpy as np

from crankwork.analysis import Results
from crankwork.errors import MissingExtraError
from crankwork.kinematics.crank_grid import Array
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.language import key_unit, label, unit_name, word
from crankwork.units import from_si


def table_column(results: Results, key: str, *, per_area: bool = False) -> Array:
    """Return a column in its display unit.

    Parameters
    ----------
    results : Results
        The results.
    key : str
        Key of the column.
    per_area : bool
        Divide forces by the piston area.

    Returns
    -------
    array, shape (n,)
        Values in the unit that `language.key_unit` names.
    """
    if key == "crank_angle":
        return results.grid.degrees
    values = results.columns[key]
    if per_area and QUANTITIES[key].per_area_unit:
        values = values / results.summary["piston_area"]
    # adding zero turns -0.0 into 0.0
    return np.asarray(from_si(values, key_unit(key, per_area=per_area)) + 0.0)


def csv_table(results: Results, name: str, *, per_area: bool = False, for_excel: bool = False) -> bytes:
    """Return a table as CSV, all digits, one heading line `key [unit]`.

    Parameters
    ----------
    results : Results
        The results.
    name : str
        A name of `results.tables`.
    per_area : bool
        Divide forces by the piston area.
    for_excel : bool
        Semicolons, decimal commas and a byte order mark, as Russian and Vietnamese Excel expect.

    Returns
    -------
    bytes
        UTF-8 text.
    """
    keys = results.tables[name]
    separator = ";" if for_excel else ","
    headings = [_quoted(f"{key} [{key_unit(key, per_area=per_area) or '-'}]") for key in keys]
    rows = zip(*(table_column(results, key, per_area=per_area).tolist() for key in keys), strict=True)
    lines = [separator.join(headings), *(separator.join(map(repr, row)) for row in rows)]
    text = "\r\n".join([*lines, ""])
    if for_excel:
        head, _, body = text.partition("\r\n")
        return ("\ufeff" + head + "\r\n" + body.replace(".", ",")).encode()
    return text.encode()


def _quoted(heading: str) -> str:
    """Return a heading as CSV has it: names of joints are the user's and may hold separators and quotes."""
    return '"' + heading.replace('"', '""') + '"' if any(mark in heading for mark in ',;"') else heading


def workbook(results: Results, *, language: Language = "en", per_area: bool = False) -> bytes:
    """Return all tables and the summary as an XLSX workbook.

    Parameters
    ----------
    results : Results
        The results.
    language : str
        Language of headings and sheet names.
    per_area : bool
        Divide forces by the piston area.

    Returns
    -------
    bytes
        The workbook; numbers keep all digits, the display is rounded.

    Raises
    ------
    MissingExtraError
        If XlsxWriter is not installed.
    """
    try:
        import xlsxwriter  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError("writing a workbook", "tables") from None
    stream = io.BytesIO()
    with xlsxwriter.Workbook(stream, {"in_memory": True, "strings_to_formulas": False}) as book:
        heading = book.add_format({"bold": True, "text_wrap": True, "valign": "top", "bottom": 1})
        decimals = book.add_format({"num_format": "0.0000"})
        for name, keys in results.tables.items():
            sheet = book.add_worksheet(word(name, language)[:31])
            sheet.freeze_panes(1, 1)
            sheet.set_column(0, len(keys) - 1, 16, decimals)
            for number, key in enumerate(keys):
                unit = unit_name(key_unit(key, per_area=per_area), language)
                sheet.write_string(
                    0, number, f"{label(key, language)}, {unit}" if unit else label(key, language), heading
                )
                sheet.write_column(1, number, table_column(results, key, per_area=per_area).tolist())
    return stream.getvalue()
