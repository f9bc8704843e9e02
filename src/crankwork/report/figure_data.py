"""What the figures of one machine share: fine columns, language and units."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from crankwork.analysis import Array, Results
from crankwork.analysis.diagrams import fine_columns
from crankwork.errors import CrankworkError
from crankwork.locale import has_text, say
from crankwork.quantities import Language
from crankwork.report.language import displayed


def kind_of(name: str) -> str:
    """Return the name of a figure without the number of a crankpin, or of one that goes on."""
    return name.rstrip("0123456789").rstrip("_")


def figure_title(name: str, language: Language) -> str:
    """Return what a figure shows, for its caption."""
    kind = kind_of(name)
    number = name.removeprefix(kind).removeprefix("_")
    # some are called what their table is
    room = "figures" if has_text(f"figures.{kind}") else "tables"
    return say(f"{room}.{kind}", language) + (f", {number}" if number else "")


class Drawn(NamedTuple):
    """What is drawn: results, fine columns in SI and their angles [deg], language, piston area or None [m2]."""

    results: Results
    columns: Mapping[str, Array]
    degrees: Array
    language: Language
    area: float | None

    @property
    def per_area(self) -> bool:
        """Whether forces are per piston area."""
        return self.area is not None

    def values(self, key: str) -> Array:
        """Return a column in its display unit."""
        return self.columns[key] * displayed(key, 1.0, per_area=self.area)


def drawn_from(results: Results, language: Language, *, per_area: bool) -> Drawn:
    """Return what the figures share, computed finer than the tables."""
    area = results.summary.get("piston_area") if per_area else None
    if per_area and area is None and "piston_force" in results.columns:
        raise CrankworkError("forces per piston area need cylinder.bore")
    fine = fine_columns(results)
    return Drawn(results, fine.columns, fine.degrees, language, area)
