"""Words of the note of a linkage put together with symbols, numbers and names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from string import Formatter

from crankwork.note.document import Figure, Heading, Math, Paragraph, Run, Runs
from crankwork.note.stated_units import printed_unit
from crankwork.note.texts.linkage_headings import CAPTIONS, COLUMNS, FIGURES, FOUR_BAR, HEADINGS, SPECIES, WAYS
from crankwork.note.texts.linkage_sentences import SENTENCES
from crankwork.quantities import LANGUAGES, QUANTITIES, Language
from crankwork.report.language import number
from crankwork.report.language import symbol as key_symbol
from crankwork.units import from_si

_RAISED = str.maketrans("0123456789-−", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁻")
_WITHIN = str.maketrans({".": ",", "/": ":", "′": "'", "″": "'"})
_TIGHT = ("°", "%")


class Words:
    """What is said in one language."""

    def __init__(self, language: Language) -> None:
        self.language: Language = language
        self._place = LANGUAGES.index(language)

    def heading(self, key: str, level: int = 1, label: str = "") -> Heading:
        """Return a heading of a section; that of the bibliography has no number."""
        return Heading(level, HEADINGS[key][self._place], numbered=key not in ("sources", "appendix"), label=label)

    def title(self, key: str) -> str:
        """Return the words of a heading."""
        return HEADINGS[key][self._place]

    def caption(self, key: str, part: int = 1) -> str:
        """Return the caption of a table; from the second part on it says that it goes on."""
        own = CAPTIONS[key][self._place]
        return own if part == 1 else CAPTIONS["continued"][self._place].format(caption=own, part=part - 1)

    def column(self, key: str, unit: str = "") -> str:
        """Return the title of a column, or another single word of a table."""
        return COLUMNS[key][self._place].format(unit=printed_unit(unit, self.language))

    def way(self, key: str) -> str:
        """Return the name of a way to find a flywheel."""
        return WAYS[key][self._place]

    def four_bar(self, key: str) -> str:
        """Return the type of a four-bar linkage."""
        return FOUR_BAR[key][self._place]

    def species(self, kind: str) -> str:
        """Return the kind of a dyad by its letters; a larger group has none."""
        return SPECIES[kind][self._place] if kind in SPECIES else "–"

    def figure(self, name: str, svg: bytes) -> Figure:
        """Return a figure with caption and description."""
        caption, seen = FIGURES[name]
        return Figure(svg, caption[self._place], seen[self._place], label=f"figure:{name}")

    def sentence(self, key: str, **values: Run) -> Runs:
        """Return a sentence; what is in braces is put in, a key of the table of quantities as its symbol."""
        parts: list[Run] = []
        for literal, name, _, _ in Formatter().parse(SENTENCES[key][self._place]):
            if literal:
                parts.append(literal)
            if name:
                parts.append(values[name] if name in values else Math(self.symbol(name)))
        return tuple(parts)

    def paragraph(self, key: str, **values: Run) -> Paragraph:
        """Return a sentence as a paragraph."""
        return Paragraph(self.sentence(key, **values))

    def symbol(self, key: str) -> str:
        """Return the symbol of a key as `base_subscript`, the name of what it belongs to in the subscript."""
        kind, _, name = key.partition(".")
        shown = QUANTITIES[kind].symbol(self.language) if kind in QUANTITIES else key_symbol(kind, self.language)
        if not name:
            return shown
        name = subscript(name)
        if "_i" in shown:
            return shown.replace("_i", f"_{name}", 1)
        return f"{shown}{',' if '_' in shown else '_'}{name}"

    def titled(self, key: str, unit: str | None = None) -> Runs:
        """Return the heading of a column of a table: symbol and unit, that of the quantity if none is given."""
        unit = printed_unit(QUANTITIES[key.partition(".")[0]].unit if unit is None else unit, self.language)
        symbol = Math(self.symbol(key))
        return (symbol, f", {unit}") if unit else (symbol,)

    def amount(self, value: float, unit: str, *, digits: int = 6) -> str:
        """Return a value in SI as text in a unit."""
        name = printed_unit(unit, self.language)
        shown = self.number(float(from_si(value, unit)) if unit else value, digits=digits)
        return shown + ("" if not name or name in _TIGHT else "\u00a0") + name

    def number(self, value: float, *, digits: int = 6) -> str:
        """Return a number as text, a power of ten with a raised exponent."""
        shown = number(value, self.language, digits=digits)
        head, mark, exponent = shown.partition("10^")
        return f"{head}10{exponent.translate(_RAISED)}" if mark else shown

    def column_texts(self, values: Sequence[float], *, digits: int = 4) -> list[str]:
        """Return numbers of one column with as many decimals as give the largest that many digits."""
        largest = max((abs(one) for one in values), default=0.0)
        if not largest:
            return ["0"] * len(values)
        whole = len(f"{largest:.0f}") if largest >= 1 else 1 - _leading_zeros(largest)
        if whole < -digits:
            return [self.number(one, digits=digits) for one in values]
        decimals = max(digits - whole, 0)
        return [self._fixed(one, decimals) for one in values]

    def _fixed(self, value: float, decimals: int) -> str:
        shown = f"{value:.{decimals}f}"
        if not shown.strip("-0."):
            shown = shown.lstrip("-")
        return (shown if self.language == "en" else shown.replace(".", ",")).replace("-", "−")


def subscript(name: str) -> str:
    """Return the name of a link or point for the subscript of a symbol, without what would end it or divide it.

    Examples
    --------
    >>> subscript("upper rod.x")
    'upper-rod,x'
    """
    return "-".join(name.translate(_WITHIN).split())


def _leading_zeros(value: float) -> int:
    """Return how many zeros stand after the decimal mark before the first digit, and one more."""
    return int(f"{value:.0e}".partition("e-")[2] or 0)


def in_display_unit(key: str, values: Sequence[float]) -> list[float]:
    """Return values in SI in the unit in which tables show their key."""
    unit = QUANTITIES[key.partition(".")[0]].unit
    # adding zero turns -0.0 into 0.0
    return [float(from_si(one, unit)) + 0.0 for one in values] if unit else [float(one) + 0.0 for one in values]


def named(columns: Mapping[str, object], *kinds: str) -> list[str]:
    """Return the keys of columns that are of some kinds, in their order within each kind."""
    return [key for kind in kinds for key in columns if key.partition(".")[0] == kind]
