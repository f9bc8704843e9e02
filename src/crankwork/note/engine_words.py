"""Words of the note of an engine put together with symbols, numbers and units."""

from __future__ import annotations

from collections.abc import Sequence
from string import Formatter

from crankwork.note.document import Heading, Math, Paragraph, Run, Runs
from crankwork.note.equations import value_symbol
from crankwork.note.stated_units import printed_unit
from crankwork.note.texts.engine_headings import CAPTIONS, COLUMNS, HEADINGS
from crankwork.note.texts.engine_sentences import SENTENCES
from crankwork.quantities import LANGUAGES, QUANTITIES, Language
from crankwork.report.engine_words import FILE_KEYS
from crankwork.report.language import key_unit, number
from crankwork.units import from_si

_RAISED = str.maketrans("0123456789-−", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁻")
_TIGHT = ("°", "%")
# what notes of every school leave without a number
_UNNUMBERED = ("preface", "conclusion", "sources", "appendix")


class EngineWords:
    """What the note of an engine says, in one language.

    Parameters
    ----------
    language : str
        The language.
    per_area : bool
        Whether forces are divided by the piston area.
    """

    def __init__(self, language: Language, *, per_area: bool = False) -> None:
        self.language: Language = language
        self.per_area = per_area
        self._place = LANGUAGES.index(language)

    def heading(self, key: str, level: int = 1, *, numbered: bool = True) -> Heading:
        """Return a heading; those of the preface, the end and the appendix have no number."""
        return Heading(level, self.title(key), numbered=numbered and key not in _UNNUMBERED)

    def title(self, key: str) -> str:
        """Return the words of a heading."""
        return HEADINGS[key][self._place]

    def caption(self, key: str) -> str:
        """Return the caption of a table."""
        return CAPTIONS[key][self._place]

    def continued(self, caption: str) -> str:
        """Return the caption of the next part of a table."""
        return self.caption("continued").format(caption=caption)

    def column(self, key: str, unit: str = "") -> str:
        """Return the title of a column, or another single word of a table."""
        return COLUMNS[key][self._place].format(unit=printed_unit(unit, self.language))

    def sentence(self, key: str, **values: Run | Runs) -> Runs:
        """Return a sentence; what is in braces is put in, a key of the table of quantities as its symbol."""
        parts: list[Run] = []
        for literal, name, _, _ in Formatter().parse(SENTENCES[key][self._place]):
            if literal:
                parts.append(literal)
            if name:
                value = values[name] if name in values else Math(QUANTITIES[name].symbol(self.language))
                parts += value if isinstance(value, tuple) else (value,)
        return tuple(parts)

    def phrase(self, key: str, **values: str) -> str:
        """Return a sentence as plain text."""
        return SENTENCES[key][self._place].format(**values)

    def paragraph(self, key: str, **values: Run | Runs) -> Paragraph:
        """Return a sentence as a paragraph."""
        return Paragraph(self.sentence(key, **values))

    def symbol(self, key: str) -> str:
        """Return the symbol of a key as `base_subscript`, what tells its parts apart in the subscript."""
        return value_symbol(key, self.language)

    def meaning(self, name: str) -> str:
        """Return what a key of the machine file means; the key itself where nobody knows."""
        key = FILE_KEYS.get(name, name)
        return QUANTITIES[key].label(self.language) if key in QUANTITIES else self._column_or(key)

    def _column_or(self, key: str) -> str:
        return COLUMNS[key][self._place] if key in COLUMNS else key

    def titled(self, key: str) -> Runs:
        """Return the heading of a column: symbol and unit."""
        symbol, unit = Math(self.symbol(key)), self.unit(key)
        return (symbol, f", {unit}") if unit else (symbol,)

    def unit(self, key: str) -> str:
        """Return the unit in which tables show a key."""
        return printed_unit(key_unit(key, per_area=self.per_area), self.language)

    def amount(self, value: float, unit: str, *, digits: int = 6) -> str:
        """Return a value in SI as text in a unit."""
        name = printed_unit(unit, self.language)
        shown = self.number(float(from_si(value, unit)) if unit else value, digits=digits)
        return shown + ("" if not name or name in _TIGHT else "\u00a0") + name

    def number(self, value: float, *, digits: int = 6) -> str:
        """Return a number as text, a power of ten with a raised exponent; a dash where there is none."""
        if value != value:  # noqa: PLR0124 - not a number
            return "–"
        shown = number(value, self.language, digits=digits)
        head, mark, exponent = shown.partition("10^")
        return f"{head}10{exponent.translate(_RAISED)}" if mark else shown

    def column_texts(self, values: Sequence[float], *, digits: int = 5, decimals: int | None = None) -> list[str]:
        """Return numbers of one column, all with as many decimals as give the largest that many digits.

        Parameters
        ----------
        values : sequence of float
            The numbers, in the unit in which they are shown.
        digits : int
            Significant digits of the largest.
        decimals : int, optional
            Decimals of all, instead.
        """
        known = [abs(one) for one in values if one == one]  # noqa: PLR0124 - not a number
        largest = max(known, default=0.0)
        if decimals is None:
            if not largest or all(one == round(one) and one < 10**digits for one in known):
                decimals = 0
            else:
                decimals = max(digits - 1 - int(f"{largest:.0e}".partition("e")[2]), 0)
        return [self._fixed(one, decimals) for one in values]

    def _fixed(self, value: float, decimals: int) -> str:
        if value != value:  # noqa: PLR0124 - not a number
            return "–"
        shown = f"{value:.{decimals}f}"
        if not shown.strip("-0."):
            shown = shown.lstrip("-")
        return (shown if self.language == "en" else shown.replace(".", ",")).replace("-", "−")


def flat(symbol: str) -> str:
    """Return a symbol as it stands in a cell, which holds plain text.

    Examples
    --------
    >>> flat("V_h")
    'Vh'
    """
    return symbol.replace("_", "")
