"""Figures of results as SVG: each that they have what it needs for."""

from __future__ import annotations

from crankwork.analysis import Results
from crankwork.quantities import Language
from crankwork.report.comparison_figure import comparison_figure
from crankwork.report.engine_figure_list import engine_figures
from crankwork.report.figure_data import drawn_from
from crankwork.report.language import in_own_units
from crankwork.report.linkage_figures import linkage_figures
from crankwork.report.turning_figures import turning_figures


@in_own_units
def figures(results: Results, *, language: Language = "en", per_area: bool = False, only: str = "") -> dict[str, bytes]:
    """Return the figures of a machine as SVG by name; those for which nothing is known are left out.

    `only`: the name of the one that is wanted; others may be there, too.

    Raises
    ------
    CrankworkError
        If forces per area are asked for where no bore is known.
    """
    shown = linkage_figures if results.machine.turning is None else turning_figures
    found = shown(results, language=language)
    if "piston_displacement" in results.columns:
        found |= engine_figures(drawn_from(results, language, per_area=per_area), only)
    compared = comparison_figure(results, language, per_area=per_area)
    return found if compared is None else {**found, "comparison": compared}
