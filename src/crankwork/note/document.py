"""A note as data: blocks in order, in one language, without a format.

A writer (`pdf`, `word`, `web`) draws the blocks; `numbering` gives them their numbers, so that all formats agree.
Where a block takes runs, a plain text is a run too.
"""

from __future__ import annotations

import datetime as dt
import html
import re
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from crankwork.formula.calculation_lines import FormulaLine, Line
from crankwork.formula.expression import Expression, Formula
from crankwork.note.layout import PrintedEquation
from crankwork.quantities import Language
from crankwork.show.scene import Drawing
from crankwork.units import METRIC, DisplayUnits

_BLANK = re.compile("[\t\n\v\f\r\x85\u2028\u2029]")
# controls, halves of characters, what is none, and the byte order mark, which PDF/A forbids
_NONE = re.compile(
    "[\\x00-\\x1f\\x7f-\\x9f\\ud800-\\udfff\\ufdd0-\\ufdef\\ufeff"
    + "".join(f"\\U{plane:04x}fffe\\U{plane:04x}ffff" for plane in range(17))
    + "]"
)


if TYPE_CHECKING:
    from crankwork.analysis import Results


@dataclass(frozen=True)
class Bold:
    """Words in bold."""

    text: str


@dataclass(frozen=True)
class Math:
    """A symbol written as the tables do, `v_п.ср`, a recorded formula, or that of a line, in the line of the text."""

    content: str | Expression | FormulaLine


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


def listed(labels: Sequence[str]) -> Runs:
    """Return references with commas between them."""
    first, *further = (Reference(label) for label in labels)
    return (first, *(run for reference in further for run in (", ", reference)))


# letters of a line of the cover, and how many lines fit
_COVER_LINE, _COVER_LINES = 60, 24
# letters of a formula in a table, about
_FORMULA = 24


# what stands in a table: finished text or a symbol
class Strong(str):
    """A cell in bold: of the row that is worked."""

    __slots__ = ()


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
class Equation:
    """A worked step, or a formula without numbers, with the number of its source and its own.

    `symbol` replaces the symbol of the step's key. `defined` is the key of a value without a formula whose definition
    stands before the number. `area`: piston area by which tables divide the value, 0 if they do not [m2]. `cites`:
    whether the source of the formula is printed beside it; `digits`: significant digits of its value.
    """

    step: Line | Formula
    symbol: str = ""
    label: str = ""
    defined: str = ""
    area: float = 0.0
    cites: bool = True
    digits: int = 6
    printed: PrintedEquation | None = None  # Instead of the step, where it is no single value


@dataclass(frozen=True)
class Table:
    """A table: rows of finished text and symbols under headings; a wide one stands on a page turned on its side.

    `align` has a letter per column, `l`, `c` or `r`; without it everything stands to the right. Without a caption it is
    more of the table before it. `half`: whether it stands beside another block that is half as wide as the text.
    """

    caption: str
    headings: tuple[Runs, ...]
    rows: Sequence[Sequence[Cell]]
    wide: bool = False
    align: str = ""
    label: str = ""
    half: bool = False
    defined: tuple[tuple[str, str], ...] = ()  # Symbols of headings that no equation explains, and their meanings

    def __post_init__(self) -> None:
        count = len(self.headings)
        if any(len(row) != count for row in self.rows) or len(self.align or self.headings) != count:
            raise ValueError(
                f'table "{self.caption}": every row, and align, must have {count} entries, as headings has'
            )


def cell_length(cell: Cell) -> int:
    """Return about how many letters wide a cell is."""
    if isinstance(cell, Math) and isinstance(cell.content, FormulaLine):
        return _FORMULA
    return len(cell if isinstance(cell, str) else str(cell.content))


@dataclass(frozen=True)
class Figure:
    """A drawing; `alt` says what it shows, and the end of its label what it is called elsewhere.

    `high`: how high it is at most [mm]; `half`: as of a table.
    """

    drawing: Drawing
    caption: str
    alt: str
    label: str = ""
    high: float = 240.0
    half: bool = False
    to_scale: bool = False  # Whether it states a scale, so that it is printed as large as it is

    @property
    def width(self) -> float:
        """Width on the page, where letters are 8 pt unless it would be too high. [mm]"""
        return self.drawing.width * min(1.0 if self.to_scale else 0.87, self.high / self.drawing.height)

    @property
    def name(self) -> str:
        """The name of the figure."""
        return self.label.partition(":")[2]


@dataclass(frozen=True)
class ItemList:
    """A list with dashes."""

    items: tuple[Runs, ...]


@dataclass(frozen=True)
class PageBreak:
    """A new page begins here."""


@dataclass(frozen=True)
class Contents:
    """The list of sections."""


@dataclass(frozen=True)
class Person:
    """Who has to do with a note, as what, and whether there is room for a signature."""

    label: str
    names: tuple[str, ...]
    signs: bool = False


@dataclass(frozen=True)
class TitlePage:
    """A page of its own with the title of the note: whose it is, what stands around the title, who, where and when."""

    institution: tuple[str, ...] = ()
    above: tuple[str, ...] = ()
    below: tuple[str, ...] = ()
    people: tuple[Person, ...] = ()
    place: str = ""

    @property
    def is_plain(self) -> bool:
        """Whether only a title, and who wrote it, is known: it then stands above the text."""
        return not (self.institution or self.above or self.place) and len(self.people) < 2

    @property
    def is_crowded(self) -> bool:
        """Whether it has so many lines that they fit in small letters only."""
        texts = [*self.institution, *self.above, *self.below, *(name for man in self.people for name in man.names)]
        return sum(-(-len(text) // _COVER_LINE) for text in texts) > _COVER_LINES


@dataclass(frozen=True)
class Bibliography:
    """The list of the sources, in the order in which the text comes to them."""


Block = (
    Heading | Paragraph | Equation | Table | Figure | ItemList | PageBreak | Contents | TitlePage | Bibliography
)  # fmt: skip


def side_by_side(blocks: Sequence[Block]) -> Iterator[tuple[int, ...]]:
    """Yield the place of each block, of two that are half as wide as the text both together."""
    places = iter(range(len(blocks)))
    for place in places:
        block = blocks[place]
        yield (place, next(places)) if isinstance(block, Table | Figure) and block.half else (place,)


@dataclass(frozen=True)
class Note:
    """A whole note; `sources` are listed in the bibliography even if nothing cites them."""

    title: str
    language: Language
    blocks: tuple[Block, ...]
    authors: tuple[str, ...] = ()
    date: dt.date | None = None
    sources: tuple[str, ...] = ()
    units: DisplayUnits = METRIC
    provenance: str = ""  # program, method and hash of the machine file
    results: Results | None = None  # What it tells of, for a page that is read with a cursor

    @property
    def headline(self) -> str:
        """The title, each number on one line with what follows it."""
        return re.sub(r"(?<=\d) (?=[^\W\d])", "\u00a0", self.title)


def plain_text(text: str) -> str:
    r"""Return text in composed letters, on one line and without control characters.

    Examples
    --------
    >>> plain_text("one\ntwo\x07")
    'one two'
    """
    return _NONE.sub("", _BLANK.sub(" ", unicodedata.normalize("NFC", text)))


def typst_string(text: str) -> str:
    """Return text as a string of Typst, in which no character but these two means anything."""
    escaped = plain_text(text).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def xml_text(text: str) -> str:
    """Return text for an element or attribute of XML or HTML."""
    return html.escape(plain_text(text), quote=True)
