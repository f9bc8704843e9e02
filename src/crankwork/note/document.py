"""A note as data: blocks in order, in one language, without a format.

A writer (`pdf`, `word`, `web`) draws the blocks; `numbering` gives them their numbers, so that all formats agree.
Where a block takes runs, a plain text is a run too.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Self

from crankwork.formula.expression import Expression, Formula
from crankwork.formula.lines import Line
from crankwork.note.options import NoteOptions
from crankwork.quantities import Language
from crankwork.units import System


@dataclass(frozen=True)
class Bold:
    """Words in bold."""

    text: str


@dataclass(frozen=True)
class Math:
    """A symbol written as the tables do, `v_п.ср`, or a recorded formula, in the line of the text."""

    content: str | Expression


@dataclass(frozen=True)
class Reference:
    """The number of the block that has this label; of an equation in parentheses."""

    label: str


@dataclass(frozen=True)
class Citation:
    """A source in brackets: key of the bibliography, with chapter, page or equation after a comma if wanted."""

    source: str


Run = str | Bold | Math | Reference | Citation
Runs = tuple[Run, ...]
# what stands in a table: finished text or a symbol
Cell = str | Math


@dataclass(frozen=True)
class Heading:
    """The title of a section, `level` 1 to 3."""

    level: int
    text: str
    numbered: bool = True
    label: str = ""


@dataclass(frozen=True)
class Paragraph:
    """A paragraph of text."""

    runs: Runs


@dataclass(frozen=True)
class Explanation:
    """A symbol of an equation and what it stands for, with its unit after a comma if it has one."""

    symbol: str
    text: str


@dataclass(frozen=True)
class Equation:
    """A worked step, or a formula without numbers, with the number of its source and its own.

    `symbol` replaces the symbol of the step's key; `legend` explains symbols below it, after "where". `defined` is the
    key of a value without a formula whose definition stands before the number.
    """

    step: Line | Formula
    symbol: str = ""
    numbered: bool = True
    label: str = ""
    legend: tuple[Explanation, ...] = ()
    defined: str = ""


@dataclass(frozen=True)
class Table:
    """A table: rows of finished text and symbols under headings; a wide one stands on a page turned on its side.

    `align` has a letter per column, `l`, `c` or `r`; without it everything stands to the right.
    """

    caption: str
    headings: tuple[Runs, ...]
    rows: Sequence[Sequence[Cell]]
    wide: bool = False
    align: str = ""
    label: str = ""

    def __post_init__(self) -> None:
        count = len(self.headings)
        if any(len(row) != count for row in self.rows) or len(self.align or self.headings) != count:
            raise ValueError(
                f'table "{self.caption}": every row, and align, must have {count} entries, as headings has'
            )


def cell_length(cell: Cell) -> int:
    """Return about how many letters wide a cell is."""
    return len(cell if isinstance(cell, str) else str(cell.content))


@dataclass(frozen=True)
class Figure:
    """A drawing as SVG; `png` is the same for Word, made from the SVG if it is left out. `alt` says what it shows."""

    svg: bytes
    caption: str
    alt: str
    png: bytes | None = None
    label: str = ""


@dataclass(frozen=True)
class ItemList:
    """A list with dashes, or with numbers."""

    items: tuple[Runs, ...]
    ordered: bool = False


@dataclass(frozen=True)
class PageBreak:
    """A new page begins here."""


@dataclass(frozen=True)
class Contents:
    """The list of sections."""


@dataclass(frozen=True)
class TitlePage:
    """Title, subtitle, authors and date of the note on a page of their own."""


@dataclass(frozen=True)
class Bibliography:
    """The list of the sources, in the order in which the text comes to them."""


Block = (
    Heading | Paragraph | Equation | Table | Figure | ItemList | PageBreak | Contents | TitlePage | Bibliography
)  # fmt: skip


@dataclass(frozen=True)
class Note:
    """A whole note; `sources` are listed in the bibliography even if nothing cites them."""

    title: str
    language: Language
    blocks: tuple[Block, ...]
    subtitle: str = ""
    authors: tuple[str, ...] = ()
    date: dt.date | None = None
    sources: tuple[str, ...] = ()
    units: System = "metric"
    provenance: str = ""  # program, method and hash of the machine file

    @classmethod
    def of(cls, blocks: Iterable[Block], options: NoteOptions, title: str, subtitle: str) -> Self:
        """Return a note of these blocks behind a title page and contents."""
        authors = (options.author,) if options.author else ()
        front = (TitlePage(), Contents(), PageBreak())
        return cls(options.title or title, options.language, (*front, *blocks), subtitle, authors)
