"""The sheets of results: each that they have what it needs for."""

from __future__ import annotations

from crankwork.analysis import Results
from crankwork.analysis.whole_engine import as_engine
from crankwork.errors import CrankworkError
from crankwork.note.sheets.engine import engine_sheets
from crankwork.note.sheets.linkage import linkage_sheets
from crankwork.note.sheets.sheet import Paper, Sheet, numbered
from crankwork.quantities import Language
from crankwork.report.language import for_readers

PLAIN = Paper()


@for_readers
def drawn_sheets(
    results: Results, language: Language = "en", *, paper: Paper = PLAIN, per_area: bool = False
) -> tuple[Sheet, ...]:
    """Return the sheets of a machine; figures for which nothing is known are left out."""
    # sheets say what the note says, which takes a crank gear of its own as an engine of one cylinder
    results = as_engine(results)
    sheets = [*engine_sheets(results, language, paper, per_area=per_area), *linkage_sheets(results, language, paper)]
    if not sheets:
        raise CrankworkError("sheets need the motion of a piston, a drawn linkage or torques; these results have none")
    return numbered(sheets, paper)
