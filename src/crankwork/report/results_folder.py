"""Everything that goes into a folder of results."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence

from crankwork.analysis import Results
from crankwork.analysis.sampled_motion import transient_animation_path
from crankwork.errors import MissingExtraError, missing_extras
from crankwork.locale import ErrorMessage
from crankwork.quantities import Language
from crankwork.report.drawing import film_of, moving_drawing
from crankwork.report.figures import drawings
from crankwork.report.summary import summary_data
from crankwork.report.tables import csv_of_sheet, sheets
from crankwork.report.workbook import workbook
from crankwork.show.animated_svg import moving_svg
from crankwork.show.chart_layout import WIDTHS, use_layout
from crankwork.show.formats import FORMATS
from crankwork.show.theme import Theme

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
