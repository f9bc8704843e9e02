"""Figures of results: each that they have what it needs for."""

from __future__ import annotations

from crankwork.analysis import Results
from crankwork.quantities import Language
from crankwork.report.comparison_figure import comparison_figure
from crankwork.report.engine_figure_list import engine_figures
from crankwork.report.figure_data import drawn_from
from crankwork.report.language import for_readers
from crankwork.report.linkage_figures import linkage_figures
from crankwork.report.turning_figures import turning_figures
from crankwork.show.scene import Drawing
from crankwork.show.svg import svg
from crankwork.show.theme import Theme


def figures(
    results: Results, *, language: Language = "en", per_area: bool = False, theme: Theme = "print"
) -> dict[str, bytes]:
    """Return the figures of a machine as SVG by name; those for which nothing is known are left out.

    `theme`: `print`, `colour` or `dark`.

    Raises
    ------
    CrankworkError
        If forces per area are asked for where no bore is known.
    """
    return {name: svg(one, theme) for name, one in drawings(results, language=language, per_area=per_area).items()}


@for_readers
def drawings(
    results: Results, *, language: Language = "en", per_area: bool = False, only: str = ""
) -> dict[str, Drawing]:
    """Return the figures of a machine as drawings; `only`: the name of the one that is wanted, others may be there."""
    shown = linkage_figures if results.machine.turning is None else turning_figures
    found = shown(results, language=language)
    if "piston_displacement" in results.columns:
        found |= engine_figures(drawn_from(results, language, per_area=per_area), only)
    compared = comparison_figure(results, language, per_area=per_area)
    return found if compared is None else {**found, "comparison": compared}
