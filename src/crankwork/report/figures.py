"""Figures of results: each that they have what it needs for."""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import partial

from crankwork.analysis import Results
from crankwork.quantities import Language
from crankwork.report.comparison_figure import comparison_figure, drawn_keys
from crankwork.report.engine_figure_data import engine_drawn
from crankwork.report.engine_figure_list import engine_pictures
from crankwork.report.language import for_readers
from crankwork.report.linkage_figures import linkage_pictures
from crankwork.report.turning_figures import turning_pictures
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
    return {
        name: svg(drawing, theme) for name, drawing in drawings(results, language=language, per_area=per_area).items()
    }


@for_readers
def drawings(
    results: Results, *, language: Language = "en", per_area: bool = False, only: Collection[str] | None = None
) -> dict[str, Drawing]:
    """Return the figures of a machine as drawings; `only`: the names of those that are wanted."""
    listed = _pictures(results, language, per_area=per_area)
    return {name: draw() for name, draw in listed.items() if only is None or name in only}


@for_readers
def figure_names(results: Results, language: Language = "en") -> list[str]:
    """Return the names of the figures of a machine, of which none is drawn."""
    return list(_pictures(results, language, per_area=False))


def _pictures(results: Results, language: Language, *, per_area: bool) -> dict[str, Callable[[], Drawing]]:
    """Return the functions that draw the figures of a machine."""
    listed = linkage_pictures if results.machine.turning is None else turning_pictures
    pictures = listed(results, language)
    if "piston_displacement" in results.columns:
        pictures |= engine_pictures(engine_drawn(results, language, per_area=per_area))
    if results.compared is not None and drawn_keys(results.compared):
        pictures["comparison"] = partial(comparison_figure, results, results.compared, language, per_area=per_area)
    return pictures
