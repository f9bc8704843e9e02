"""Words of a note put together with symbols, numbers and units."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from string import Formatter

import numpy as np

from crankwork.locale import Language, capital, decimal, has_text, texts, translate
from crankwork.locale.numbers import number
from crankwork.note.captions import note_text, printed_unit
from crankwork.note.document import Cell, Heading, Math, Paragraph, Run, Runs, Table
from crankwork.note.equations import NO_LINKS, value_symbol
from crankwork.note.symbols import owned_symbol
from crankwork.quantities import QUANTITIES, base_key
from crankwork.quantities.key import key_of
from crankwork.quantities.quantity import number_of
from crankwork.report.display import FILE_KEYS, displayed, displayed_column, key_unit, link_label
from crankwork.report.display import symbol as key_symbol
from crankwork.units import from_si, shown_unit

_TIGHT = ("°", "%")
# what notes of every school leave without a number
_UNNUMBERED = ("preface", "conclusion", "sources", "appendix")


class Words:
    """Texts of a note in one language.

    `per_area`: whether forces are divided by the piston area; `period`: of the law that drives, where positions are
    times [s]; `is_partial`: whether the crank goes to and fro between dead positions; `has_names`: whether links,
    points and chambers have names, which symbols tell; `digits`: of the largest value of a column.
    """

    def __init__(
        self,
        language: Language,
        *,
        per_area: bool = False,
        period: float = 0.0,
        is_partial: bool = False,
        has_names: bool = True,
        digits: int = 4,
    ) -> None:
        self.language: Language = language
        self.per_area, self.period, self.is_partial, self.has_names = per_area, period, is_partial, has_names
        self.digits = digits

    def title(self, key: str) -> str:
        """Return the words of a heading."""
        return note_text(f"headings.{key}", self.language)

    def column(self, key: str, unit: str = "") -> str:
        """Return the title of a column."""
        return capital(self.term(key, unit))

    def heading(self, key: str, level: int = 1, *, numbered: bool = True, label: str = "") -> Heading:
        """Return a heading; those of the preface, the end and the appendix have no number."""
        is_numbered = numbered and key.partition("_")[0] not in _UNNUMBERED
        return Heading(level, self.title(key), numbered=is_numbered, label=label)

    def caption(self, key: str) -> str:
        """Return the caption of a table."""
        return note_text(f"captions.{key}", self.language)

    def table(
        self, caption: str, titles: Iterable[str | Runs], rows: Sequence[Sequence[Cell]], align: str, label: str = ""
    ) -> Table:
        """Return a table; a title that is no runs is the key of a column."""
        headings = tuple((self.column(title),) if isinstance(title, str) else title for title in titles)
        return Table(self.caption(caption), headings, rows, align=align, label=label)

    def unit(self, key: str) -> str:
        """Return the unit in which tables show a key."""
        return printed_unit(key_unit(key, per_area=self.per_area), self.language)

    def titled(self, key: str, unit: str | None = None) -> Runs:
        """Return the heading of a column: symbol and unit, that of the quantity if none is given."""
        shown = self.unit(key) if unit is None else printed_unit(unit, self.language)
        between = "\u00a0" if shown in _TIGHT else " "
        return (Math(self.symbol(key)), f",{between}{shown}") if shown else (Math(self.symbol(key)),)

    def term(self, key: str, unit: str = "") -> str:
        """Return a single word of a table as it stands in a cell or sentence."""
        return note_text(f"columns.{key}", self.language, unit=printed_unit(shown_unit(unit), self.language))

    def kind(self, key: str) -> str:
        """Return the name of a kind: of an arrangement, a four-bar linkage, a dyad; a dash if it has none."""
        return texts("kinds", self.language).get(key.replace(" ", "_"), "–")

    def sentence(self, key: str, **values: Run | Runs) -> Runs:
        """Return a sentence; what is in braces is put in, a key of the table of quantities as its symbol."""
        parts: list[Run] = []
        for literal, name, _, _ in Formatter().parse(translate(f"sentences.{key}", self.language)):
            if literal:
                parts.append(literal)
            if name:
                value = values[name] if name in values else Math(self.symbol(name))
                parts += value if isinstance(value, tuple) else (value,)
        return tuple(parts)

    def phrase(self, key: str, **values: str) -> str:
        """Return a sentence as plain text."""
        return translate(f"sentences.{key}", self.language, **values)

    def paragraph(self, key: str, **values: Run | Runs) -> Paragraph:
        """Return a sentence as a paragraph."""
        return Paragraph(self.sentence(key, **values))

    def part(self, name: str) -> str:
        """Return the name of a link or guide in words, behind its number if it has one."""
        number, called = number_of(name), link_label(name, self.language)
        return called if number in (name, called) else f"{number} ({called})"

    def mark(self, key: str) -> str:
        """Return the mark of a part in symbols."""
        return texts("marks", self.language)[key]

    def way(self, key: str) -> str:
        """Return the name of a way to find a flywheel."""
        return translate("report.exact" if key == "exact" else f"report.way_{key}", self.language)

    def symbol(self, key: str) -> str:
        """Return the symbol of a key as `base_subscript`, what it belongs to in the subscript."""
        if not self.has_names or key_of(key).owner in NO_LINKS:
            return value_symbol(key, self.language)
        if base_key(key) not in QUANTITIES:
            return key
        kind, name = key_of(key)
        shown = QUANTITIES[kind].symbol(self.language) if kind in QUANTITIES else key_symbol(kind, self.language)
        return owned_symbol(kind, shown, name, self.language) if name else shown

    def amount(self, value: float, unit: str, *, digits: int = 6) -> str:
        """Return a value in SI as text in a unit, or in that which the system in use has for it."""
        unit = shown_unit(unit)
        name = printed_unit(unit, self.language)
        shown = self.number(float(from_si(value, unit)) if unit else value, digits=digits)
        return shown + ("" if not name or name in _TIGHT else "\u00a0") + name

    def angle(self, value: float) -> str:
        """Return an angle [rad] to a tenth of a degree."""
        return self.number(round(math.degrees(value), 1) + 0.0) + "°"

    def shown(self, key: str, value: float, *, digits: int = 6) -> str:
        """Return a value in SI in the unit in which tables show its key."""
        return self.number(displayed(key, value), digits=digits)

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

    def meaning(self, name: str) -> str:
        """Return the meaning of a key of the machine file, or the key itself if it has no text."""
        key = FILE_KEYS.get(name.removeprefix("engine."), name)
        if key in QUANTITIES:
            return QUANTITIES[key].label(self.language)
        return translate(f"report.{key}", self.language) if has_text(f"report.{key}") else key

    def column_texts(
        self, values: Sequence[float], *, digits: int | None = None, decimals: int | None = None
    ) -> list[str]:
        """Return numbers of one column, all with as many decimals as give the largest that many digits."""
        digits = digits or self.digits
        if decimals is None:
            leading = self._leading(values, digits)
            if leading < -digits:
                return [self.number(value, digits=digits) for value in values]
            decimals = self.decimals(values, digits)
            # of millions nobody reads the ones
            values = [round(value, digits - leading) for value in values] if leading > digits + 2 else values
        return [self.fixed(value, decimals) for value in values]

    def decimals(self, values: Sequence[float], digits: int | None = None) -> int:
        """Return how many decimals give the largest of some numbers its digits; none to whole numbers."""
        digits = digits or self.digits
        is_whole = all(value == round(value) and abs(value) < 10**digits for value in values if math.isfinite(value))
        return 0 if is_whole else max(digits - self._leading(values, digits), 0)

    @staticmethod
    def _leading(values: Sequence[float], digits: int) -> int:
        """Return how many digits the largest number has before its decimal mark; of 0.05 it is -1."""
        largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
        return 1 + int(f"{largest:.{digits - 1}e}".partition("e")[2]) if largest else 1

    def place(self, degrees: float) -> tuple[Math, float, str]:
        """Return symbol, value and unit of a position: a crank angle, or a time."""
        if self.period:
            return Math(self.symbol("time")), degrees / 360.0 * self.period, "s"
        return Math(self.symbol("crank_angle")), degrees, "deg"

    def at_place(self, degrees: float) -> dict[str, Run]:
        """Return what a sentence puts in for a position: its sign, in the place of the crank angle, and its value."""
        return {"crank_angle": Math(self.symbol("time" if self.period else "crank_angle")),
                "value": self.place_text(degrees)}  # fmt: skip

    def place_text(self, degrees: float) -> str:
        """Return a position with its unit."""
        _, value, unit = self.place(degrees)
        return self.amount(value, unit) if self.period else self.amount(math.radians(value), unit)

    def reached_at(self) -> Runs:
        """Return the heading of a column of positions at which values are reached."""
        symbol, _, unit = self.place(0.0)
        return self.column("at") + "\u00a0", symbol, f",\u00a0{printed_unit(unit, self.language)}"


def named(columns: Mapping[str, object], *kinds: str) -> list[str]:
    """Return the keys of columns that are of some kinds, in their order within each kind."""
    return [key for kind in kinds for key in columns if key_of(key).quantity == kind]


def in_display_unit(key: str, values: Sequence[float]) -> list[float]:
    """Return values in SI in the unit in which tables show their key."""
    shown: list[float] = displayed_column(key_of(key).quantity, np.asarray(values, dtype=float)).tolist()
    return shown
