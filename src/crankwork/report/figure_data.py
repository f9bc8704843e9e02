"""Titles of figures."""

from __future__ import annotations

from crankwork.locale import has_text, say
from crankwork.quantities import Language


def kind_of(name: str) -> str:
    """Return the name of a figure without the number of a crankpin, or of one that goes on."""
    return name.rstrip("0123456789").rstrip("_")


def figure_title(name: str, language: Language) -> str:
    """Return the title of a figure, for its caption."""
    kind = kind_of(name)
    number = name.removeprefix(kind).removeprefix("_")
    # some are called what their table is
    room = "figures" if has_text(f"figures.{kind}") else "tables"
    return say(f"{room}.{kind}", language) + (f", {number}" if number else "")
