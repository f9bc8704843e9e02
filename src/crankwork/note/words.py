"""Words of a note put together with symbols, numbers and units."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from string import Formatter

import numpy as np

from crankwork.locale import Language, capital, decimal, say, texts
from crankwork.locale.numbers import number
from crankwork.note.captions import note_text
from crankwork.note.document import Math, Paragraph, Run, Runs
from crankwork.note.printed_units import printed_unit
from crankwork.report.language import displayed, displayed_column
from crankwork.units import from_si, shown_unit

_TIGHT = ("°", "%")


class NoteWords(ABC):
    """What a note says, in one language."""

    def __init__(self, language: Language) -> None:
        self.language: Language = language

    def title(self, key: str) -> str:
        """Return the words of a heading."""
        return note_text(f"headings.{key}", self.language)

    def column(self, key: str, unit: str = "") -> str:
        """Return the title of a column."""
        return capital(self.term(key, unit))

    def term(self, key: str, unit: str = "") -> str:
        """Return a single word of a table as it stands in a cell or sentence."""
        return note_text(f"columns.{key}", self.language, unit=printed_unit(shown_unit(unit), self.language))

    def kind(self, key: str) -> str:
        """Return the name of a kind: of an arrangement, a four-bar linkage, a dyad; a dash if it has none."""
        return texts("kinds", self.language).get(key.replace(" ", "_"), "–")

    def sentence(self, key: str, **values: Run | Runs) -> Runs:
        """Return a sentence; what is in braces is put in, a key of the table of quantities as its symbol."""
        parts: list[Run] = []
        for literal, name, _, _ in Formatter().parse(say(f"sentences.{key}", self.language)):
            if literal:
                parts.append(literal)
            if name:
                value = values[name] if name in values else Math(self.symbol(name))
                parts += value if isinstance(value, tuple) else (value,)
        return tuple(parts)

    def phrase(self, key: str, **values: str) -> str:
        """Return a sentence as plain text."""
        return say(f"sentences.{key}", self.language, **values)

    def paragraph(self, key: str, **values: Run | Runs) -> Paragraph:
        """Return a sentence as a paragraph."""
        return Paragraph(self.sentence(key, **values))

    @abstractmethod
    def symbol(self, key: str) -> str:
        """Return the symbol of a key as `base_subscript`."""

    def amount(self, value: float, unit: str, *, digits: int = 6) -> str:
        """Return a value in SI as text in a unit, or in that which the system in use has for it."""
        unit = shown_unit(unit)
        name = printed_unit(unit, self.language)
        shown = self.number(float(from_si(value, unit)) if unit else value, digits=digits)
        return shown + ("" if not name or name in _TIGHT else "\u00a0") + name

    def shown(self, key: str, value: float) -> str:
        """Return a value in SI in the unit in which tables show its key."""
        return self.number(displayed(key, value))

    def number(self, value: float, *, digits: int = 6) -> str:
        """Return a number as text; a dash where there is none."""
        return "–" if value != value else number(value, self.language, digits=digits)  # noqa: PLR0124 - not a number

    def fixed(self, value: float, decimals: int) -> str:
        """Return a number with that many decimals; a dash where there is none."""
        if value != value:  # noqa: PLR0124 - not a number
            return "–"
        shown = f"{value:.{decimals}f}"
        if not shown.strip("-0."):
            shown = shown.lstrip("-")
        return decimal(shown, self.language).replace("-", "−")


def in_display_unit(key: str, values: Sequence[float]) -> list[float]:
    """Return values in SI in the unit in which tables show their key."""
    shown: list[float] = displayed_column(key.partition(".")[0], np.asarray(values, dtype=float)).tolist()
    return shown
