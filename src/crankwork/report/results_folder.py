"""Everything that goes into a folder of results, with the Excel workbook."""

from __future__ import annotations

import io
import json
import math
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import datetime
from typing import TYPE_CHECKING, Any

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.sampled_motion import transient_animation_path
from crankwork.errors import CrankworkError, MissingExtraError, missing_extras
from crankwork.locale import ErrorMessage, capital, translate
from crankwork.locale.numbers import unit_name
from crankwork.quantities import QUANTITIES, Language, base_key
from crankwork.report.display import display_key, displayed, in_own_units, key_unit, label, row_name, symbol
from crankwork.report.drawing import film_of, moving_drawing
from crankwork.report.figures import drawings
from crankwork.report.summary import by_subject, check_status, provenance, summary_data
from crankwork.report.tables import Sheet, csv_of_sheet, sheets
from crankwork.show.canvas import WIDTHS, use_layout
from crankwork.show.formats import FORMATS
from crankwork.show.svg import moving_svg
from crankwork.show.theme import Theme
from crankwork.units import from_si

# What some files of the folder need that the base installation lacks: extra by module.
_WORKBOOK = {"xlsxwriter": "tables"}


def missing_writers() -> MissingExtraError | None:
    """Return the extras to install for files that a results folder lacks, if there are any."""
    missing = missing_extras(_WORKBOOK)
    return MissingExtraError(ErrorMessage("extra_writing", names=["tables.xlsx"]), *missing) if missing else None


def results_folder(  # noqa: PLR0913 - results, and how they are shown
    results: Results,
    *,
    language: Language = "en",
    per_area: bool = False,
    for_excel: bool = False,
    formats: Sequence[str] = ("svg",),
    theme: Theme = "print",
    width: str = "170",
) -> Iterator[dict[str, bytes]]:
    """Yield the files of a results folder in steps, to show progress; `missing_writers` says what is left out.

    `formats`: of the figures, none for none; `width`: of the figures, 85 or 170. [mm]
    """
    summary = summary_data(results, per_area=per_area)
    yield {
        "summary.json": f"{json.dumps(summary, ensure_ascii=False, indent=1)}\n".encode(),
    } | {
        f"tables/{name}.csv": csv_of_sheet(sheet, for_excel=for_excel)
        for name, sheet in sheets(results, per_area=per_area).items()
    }
    if not missing_extras(_WORKBOOK):
        yield {"tables.xlsx": workbook(results, language=language, per_area=per_area)}
    # nobody prints what moves
    on_screen: Theme = "dark" if theme == "dark" else "colour"
    film = film_of(results, language=language)
    if film is not None:
        yield {"machine.svg": moving_svg(film, on_screen)}
    free = transient_animation_path(results)
    if free is not None:
        yield {"transient.svg": moving_svg(moving_drawing(results, language=language, path=free), on_screen)}
    if formats:
        with use_layout(WIDTHS[width]):
            drawn = drawings(results, language=language, per_area=per_area)
        for ending in formats:
            yield {f"figures/{name}.{ending}": FORMATS[ending](drawing, theme) for name, drawing in drawn.items()}


if TYPE_CHECKING:
    import xlsxwriter

# cells of a workbook that memory has no room for
_MANY = 500_000
_CREATED = datetime(2000, 1, 1)  # noqa: DTZ001 - a workbook knows no time zones
# of the largest number of a column
_DIGITS = 6
_WIDTH, _WORDS, _HEADING = 15, 52, 48
_A4 = 9
# curves of a chart, charts of a sheet, and how far apart those stand in rows
_CURVES, _CHARTS, _ROWS_OF_CHART = 6, 4, 20
# what runs along the horizontal axis of a chart
_ALONG = ("crank_angle", "time")


class _Writer:
    """Writes sheets into a workbook: their names, none twice, and their formats."""

    def __init__(self, book: xlsxwriter.Workbook, language: Language) -> None:
        self._book, self._language = book, language
        top = {"text_wrap": True, "valign": "top", "bottom": 1}
        self.heading = book.add_format({"bold": True, **top})
        self._symbol = book.add_format({"italic": True})
        self._below = book.add_format({"font_script": 2})
        self._words = book.add_format({"bold": True})
        self._formats: dict[str, Any] = {}
        self._taken: set[str] = set()

    def sheet(self, title: str, rows: int = 1, columns: int = 1) -> Any:  # noqa: ANN401 - xlsxwriter has no types
        """Return a new sheet whose first rows and columns stay where they are."""
        sheet = self._book.add_worksheet(_sheet_name(title, self._taken))
        sheet.freeze_panes(rows, columns)
        # on paper as wide as the page, headings on every one
        sheet.set_landscape()
        sheet.set_paper(_A4)
        sheet.fit_to_pages(1, 0)
        sheet.repeat_rows(0)
        return sheet

    def format(self, number: str) -> Any:  # noqa: ANN401 - xlsxwriter has no types
        """Return the format of numbers that are shown like this."""
        if number not in self._formats:
            self._formats[number] = self._book.add_format({"num_format": number})
        return self._formats[number]

    def symbol(self, sheet: Any, row: int, column: int, shown: str) -> None:  # noqa: ANN401 - xlsxwriter has no types
        """Write a symbol, its subscript below."""
        parts = self._set(shown)
        if len(parts) > 2:
            sheet.write_rich_string(row, column, *parts)
        else:
            sheet.write_string(row, column, shown, *parts[:1])

    def title(self, sheet: Any, column: int, key: str, unit: str) -> None:  # noqa: ANN401 - xlsxwriter has no types
        """Write the heading of a column: its name, its symbol with the subscript below, and its unit."""
        # tables of a study hold numbers of the machine file too
        is_result = base_key(key) in QUANTITIES
        named, unit = label(key, self._language) if is_result else key, unit_name(unit, self._language)
        parts = self._set(symbol(key, self._language)) if is_result else []
        after = f", {unit}" if unit else ""
        if not parts:
            sheet.write_string(0, column, f"{named}{after}", self.heading)
            return
        runs = [self._words, f"{named} ", *parts, *([self._words, after] if after else [])]
        sheet.write_rich_string(0, column, *runs, self.heading)

    def _set(self, shown: str) -> list[Any]:
        base, _, below = shown.partition("_")
        if not base or " " in shown or "/" in shown:
            return [self._words, shown] if shown else []
        return [self._symbol, base, *([self._below, below] if below else [])]

    def charts(self, sheet: Any, table: Sheet, after: int) -> None:  # noqa: ANN401 - xlsxwriter has no types
        """Put charts of the columns beside them, those with one unit together."""
        along, *keys = table.columns
        if along not in _ALONG or len(table.columns[along]) < 3:
            return
        by_unit: dict[str, list[str]] = {}
        for key in keys:
            by_unit.setdefault(table.units[key], []).append(key)
        last = len(table.columns[along])
        for index, (unit, keys_of_unit) in enumerate(list(by_unit.items())[:_CHARTS]):
            chart = self._book.add_chart({"type": "scatter", "subtype": "straight"})
            for key in keys_of_unit[:_CURVES]:
                column = list(table.columns).index(key)
                chart.add_series({
                    "name": symbol(key, self._language).replace("_", "") or label(key, self._language),
                    "categories": [sheet.name, 1, 0, last, 0],
                    "values": [sheet.name, 1, column, last, column],
                    "line": {"width": 1.5},
                })  # fmt: skip
            ends = table.columns[along]
            across, span = unit_name(table.units[along], self._language), float(ends[-1] - ends[0])
            is_marked = along == "crank_angle" and span >= 180.0
            steps = {"major_unit": 90.0 if span > 360.0 else 30.0} if is_marked else {}
            chart.set_x_axis({
                "name": f"{label(along, self._language)}, {across}", "label_position": "low",
                "min": float(ends[0]), "max": float(ends[-1]), **steps,
            })  # fmt: skip
            chart.set_y_axis({"name": unit_name(unit, self._language), "major_gridlines": {"visible": True}})
            chart.set_legend({"position": "bottom"})
            chart.set_size({"width": 640, "height": 380})
            sheet.insert_chart(1 + index * _ROWS_OF_CHART, after + 1, chart)


def workbook(results: Results, *, language: Language = "en", per_area: bool = False) -> bytes:
    """Return single values, what was given, checks and all tables as an XLSX workbook."""

    def fill(writer: _Writer) -> None:
        _values(results, writer, language, per_area=per_area)
        _givens(results, writer, language)
        _checks(results, writer, language)

    named = {translate(f"tables.{name}", language): table for name, table in sheets(results, per_area=per_area).items()}
    properties = {"title": results.machine.title[:255], "comments": provenance(results)}
    return workbook_of(named, properties, language, fill)


def workbook_of(
    tables: Mapping[str, Sheet],
    properties: Mapping[str, str],
    language: Language,
    fill: Callable[[_Writer], None] = lambda _: None,
) -> bytes:
    """Return tables by title as an XLSX workbook, after the sheets that `fill` writes."""
    try:
        import xlsxwriter  # noqa: PLC0415 - an optional part
        from xlsxwriter.exceptions import FileCreateError  # noqa: PLC0415
    except ImportError:
        raise MissingExtraError(ErrorMessage("extra_writing", names="XLSX"), "tables") from None
    stream = io.BytesIO()
    cells = sum(len(column) for table in tables.values() for column in table.columns.values())
    # rows that are written wait in files, which takes longer where they are few
    kept = {"in_memory": True} if cells < _MANY else {"constant_memory": True}
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        book = xlsxwriter.Workbook(stream, {**kept, "strings_to_formulas": False, "tmpdir": folder})
        # the same tables are the same bytes
        book.set_properties({"created": _CREATED, **properties})
        writer = _Writer(book, language)
        try:
            fill(writer)
            for title, table in tables.items():
                _fill(writer, capital(title), table, language)
            book.close()
        except (OSError, FileCreateError) as error:
            raise _full(error) from None
        finally:
            # a workbook that could not be finished leaves the files of its rows open
            for rows in (getattr(worksheet, "row_data_fh", None) for worksheet in book.worksheets()):
                if rows is not None:
                    rows.close()
    return stream.getvalue()


def _full(error: Exception) -> CrankworkError:
    """Return the refusal for a place that could not take the rows of a workbook."""
    full = error if isinstance(error, OSError) else error.args[0]
    reason = str(getattr(full, "strerror", None) or full).lower()
    return CrankworkError(ErrorMessage("place_unwritable", path=tempfile.gettempdir(), reason=reason))


@in_own_units
def _values(results: Results, writer: _Writer, language: Language, *, per_area: bool) -> None:
    """Write the single values, by subject."""
    area = results.summary["piston_area"] if per_area else None
    sheet = writer.sheet(capital(translate("headings.results", language)))
    sheet.set_column(0, 0, _WORDS)
    sheet.set_column(1, 3, _WIDTH)
    _headings(sheet, writer, ("columns.quantity", "columns.symbol", "columns.value", "columns.unit"), language)
    row = 1
    for subject, values in by_subject(results).items():
        sheet.write_string(row, 0, capital(translate(f"subjects.{subject}", language)), writer.heading)
        row += 1
        for key, value in values.items():
            sheet.write_string(row, 0, label(display_key(key, results), language))
            writer.symbol(sheet, row, 1, symbol(key, language))
            shown = displayed(key, value, per_area=area)
            if math.isfinite(shown):
                sheet.write_number(row, 2, shown, writer.format(_number_format([shown])))
            sheet.write_string(row, 3, unit_name(key_unit(key, per_area=per_area), language))
            row += 1


def _givens(results: Results, writer: _Writer, language: Language) -> None:
    """Write the numbers of the machine file as they are stated."""
    if not results.machine.stated:
        return
    sheet = writer.sheet(capital(translate("headings.data", language)))
    sheet.set_column(0, 0, _WORDS)
    sheet.set_column(1, 2, _WIDTH)
    _headings(sheet, writer, ("columns.quantity", "columns.value", "columns.unit"), language)
    for row, (path, number) in enumerate(results.machine.stated.items(), start=1):
        shown = float(from_si(number.value, number.unit)) if number.unit else number.value
        sheet.write_string(row, 0, path)
        sheet.write_number(row, 1, float(f"{shown:.12g}"))
        sheet.write_string(row, 2, unit_name(number.unit, language))


def _checks(results: Results, writer: _Writer, language: Language) -> None:
    """Write the identities that were checked, with their residuals."""
    if not results.checks:
        return
    sheet = writer.sheet(capital(translate("headings.checks", language)))
    sheet.set_column(0, 0, _WORDS + _WIDTH)
    sheet.set_column(1, 2, _WIDTH)
    _headings(sheet, writer, ("columns.identity", "columns.residual"), language)
    for row, (key, value) in enumerate(results.checks.items(), start=1):
        sheet.write_string(row, 0, translate(f"report.{key}", language))
        if math.isfinite(value):
            sheet.write_number(row, 1, value * 100, writer.format("0.0E+00"))
        sheet.write_string(row, 2, check_status(results, key, language))


def _headings(sheet: Any, writer: _Writer, keys: Sequence[str], language: Language) -> None:  # noqa: ANN401
    for column, key in enumerate(keys):
        sheet.write_string(0, column, capital(translate(key, language)), writer.heading)


def _fill(writer: _Writer, title: str, table: Sheet, language: Language) -> None:
    """Write a table, row by row."""
    sheet = writer.sheet(title)
    sheet.set_row(0, _HEADING)
    first = 1 if table.names else 0
    if table.names:
        sheet.set_column(0, 0, 2 * _WIDTH)
        sheet.write_string(0, 0, capital(translate("report.row", language)), writer.heading)
    formats = [writer.format(_number_format(values)) for values in table.columns.values()]
    for number, (key, shown) in enumerate(zip(table.columns, formats, strict=True), start=first):
        sheet.set_column(number, number, _WIDTH, shown)
        writer.title(sheet, number, key, table.units[key])
    columns = [values.tolist() for values in table.columns.values()]
    for row, values in enumerate(zip(*columns, strict=True), start=1):
        if table.names:
            sheet.write_string(row, 0, row_name(table.names[row - 1], language))
        for number, value in enumerate(values, start=first):
            if isinstance(value, str):
                sheet.write_string(row, number, value)
            elif math.isfinite(value):
                sheet.write_number(row, number, value)
    if not table.names:
        writer.charts(sheet, table, len(columns))


def _number_format(values: Array | Sequence[float]) -> str:
    """Return the format in which the largest number of a column shows its digits, whole ones none behind the mark."""
    if np.asarray(values).dtype == object:
        return "@"
    known = np.abs(np.asarray(values, dtype=float))
    known = known[np.isfinite(known)]
    largest = float(known.max(initial=0.0))
    if not largest or np.all(known == np.round(known)):
        return "0"
    if largest < 1e-4 or largest >= 1e9:
        return "0.0000E+00"
    decimals = max(0, min(_DIGITS, _DIGITS - 1 - math.floor(math.log10(largest))))
    return "0." + "0" * decimals if decimals else "0"


def _sheet_name(title: str, taken: set[str]) -> str:
    """Return a name for a sheet: at most 31 characters, none twice."""
    name, number = title[:31], 2
    while name in taken:
        name, number = f"{title[:28]} {number}", number + 1
    taken.add(name)
    return name
