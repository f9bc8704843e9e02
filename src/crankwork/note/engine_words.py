"""Words of the note of an engine put together with symbols, numbers and units."""

from __future__ import annotations

from collections.abc import Sequence

from crankwork.locale import has_text, say
from crankwork.note.captions import note_text
from crankwork.note.document import Heading, Math, Runs
from crankwork.note.equations import value_symbol
from crankwork.note.printed_units import printed_unit
from crankwork.note.words import NoteWords
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.language import FILE_KEYS, key_unit

# what notes of every school leave without a number
_UNNUMBERED = ("preface", "conclusion", "sources", "appendix")


class EngineWords(NoteWords):
    """What the note of an engine says, in one language, forces divided by the piston area if wanted."""

    def __init__(self, language: Language, *, per_area: bool = False) -> None:
        super().__init__(language)
        self.per_area = per_area

    def heading(self, key: str, level: int = 1, *, numbered: bool = True) -> Heading:
        """Return a heading; those of the preface, the end and the appendix have no number."""
        return Heading(level, self.title(key), numbered=numbered and key not in _UNNUMBERED)

    def caption(self, key: str) -> str:
        """Return the caption of a table."""
        return note_text(f"captions.{key}", self.language)

    def symbol(self, key: str) -> str:
        """Return the symbol of a key as `base_subscript`, what tells its parts apart in the subscript."""
        return value_symbol(key, self.language)

    def meaning(self, name: str) -> str:
        """Return what a key of the machine file means; the key itself where nobody knows."""
        key = FILE_KEYS.get(name, name)
        if key in QUANTITIES:
            return QUANTITIES[key].label(self.language)
        return say(f"report.{key}", self.language) if has_text(f"report.{key}") else key

    def titled(self, key: str) -> Runs:
        """Return the heading of a column: symbol and unit."""
        symbol, unit = Math(self.symbol(key)), self.unit(key)
        return (symbol, f", {unit}") if unit else (symbol,)

    def unit(self, key: str) -> str:
        """Return the unit in which tables show a key."""
        return printed_unit(key_unit(key, per_area=self.per_area), self.language)

    def column_texts(self, values: Sequence[float], *, digits: int = 5, decimals: int | None = None) -> list[str]:
        """Return numbers of one column, all with as many decimals as give the largest that many digits."""
        known = [abs(one) for one in values if one == one]  # noqa: PLR0124 - not a number
        largest = max(known, default=0.0)
        if decimals is None:
            if not largest or all(one == round(one) and one < 10**digits for one in known):
                decimals = 0
            else:
                decimals = max(digits - 1 - int(f"{largest:.0e}".partition("e")[2]), 0)
        return [self.fixed(one, decimals) for one in values]
