"""The sheets of results: each that they have what it needs for."""

from __future__ import annotations

from collections.abc import Mapping

from crankwork.analysis import Array, Results
from crankwork.errors import CrankworkError
from crankwork.note.sheets.engine import engine_sheets
from crankwork.note.sheets.linkage import linkage_sheets
from crankwork.note.sheets.sheet import Paper, Sheet, numbered
from crankwork.quantities import Language

PLAIN = Paper()


def drawn_sheets(
    results: Results,
    language: Language = "en",
    *,
    paper: Paper = PLAIN,
    per_area: bool = False,
    extra: Mapping[str, Array | float] | None = None,
) -> tuple[Sheet, ...]:
    """Return the sheets of a machine; graphs for which nothing is known are left out.

    `extra`: as `engine_sheets` takes it.
    """
    sheets = [*engine_sheets(results, language, paper, extra or {}, per_area=per_area)]
    sheets += linkage_sheets(results, language, paper)
    if not sheets:
        raise CrankworkError("sheets need the motion of a piston, a drawn linkage or torques; these results have none")
    return numbered(sheets, paper)
