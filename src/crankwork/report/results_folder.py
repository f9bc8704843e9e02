"""Everything that goes into a folder of results."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

from crankwork.analysis import Results
from crankwork.errors import GeometryError
from crankwork.linkage_machine import TabulatedMachine
from crankwork.quantities import Language
from crankwork.report.drawing import moving_drawing
from crankwork.report.figures import figures
from crankwork.report.tables import csv_of_sheet, sheets, workbook

# What a results folder may hold, so that a run that overwrites leaves nothing of another machine.
OUTPUTS = ("tables/*.csv", "tables.xlsx", "machine.svg", "figures/*.svg")


def results_folder(
    results: Results,
    *,
    language: Language = "en",
    per_area: bool = False,
    for_excel: bool = False,
    with_figures: bool = True,
) -> Iterator[dict[str, bytes]]:
    """Yield the files of a results folder in steps, so that progress can be shown.

    Parameters
    ----------
    results : Results
        The results.
    language : str
        Language of headings and labels.
    per_area : bool
        Divide forces by the piston area.
    for_excel : bool
        CSV for Russian and Vietnamese Excel.
    with_figures : bool
        Draw figures too.

    Yields
    ------
    dict of str to bytes
        Data by path within the folder.
    """
    yield {
        f"tables/{name}.csv": csv_of_sheet(sheet, per_area=per_area, for_excel=for_excel)
        for name, sheet in sheets(results, per_area=per_area).items()
    }
    yield {"tables.xlsx": workbook(results, language=language, per_area=per_area)}
    if not isinstance(results.machine, TabulatedMachine):
        # a linkage that cannot turn fully has a notice that says so, and no moving drawing
        with contextlib.suppress(GeometryError):
            yield {"machine.svg": moving_drawing(results.machine, language=language).encode()}
    if with_figures:
        drawn = figures(results, language=language, per_area=per_area)
        yield {f"figures/{name}.svg": data for name, data in drawn.items()}
