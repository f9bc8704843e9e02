"""Notes and sheets that tests look at, each made once, and what is in them."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

import crankwork
from crankwork.note.document import Block, Equation, Figure, Heading, ItemList, Math, Note, Paragraph, Table
from crankwork.note.equations import printed_equation
from crankwork.note.layout import PrintedEquation
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of
from crankwork.note.sheets import Paper, TitleBlock, drawn_sheets
from crankwork.note.sheets.sheet import Sheet
from crankwork.quantities import Language
from crankwork.quantities.quantity import use_numbers
from crankwork.report.display import link_numbers
from crankwork.show.scene import Drawing, Polyline, Text

ROOT = Path(__file__).parents[1]
SIGNED = Paper(
    block=TitleBlock(
        form="ru", designation="КП.01.02.000 <&>", author="Nguyễn Văn Đức", institution="МГТУ", group="РК2-41Б",
        supervisor="Щербаков Ю. Ё.", subject="Курсовой проект по теории механизмов и машин",
    )
)  # fmt: skip
T = TypeVar("T")


@functools.cache
def results(name: str) -> crankwork.Results:
    """Return the results of an example, of a machine of the tests or of a template."""
    folders = ("examples", "tests/machines")
    file = next((path for one in folders if (path := ROOT / one / f"{name}.toml").exists()), None)
    return crankwork.analyse(crankwork.read(file) if file else crankwork.read_machine(crankwork.template(name)))


_note = functools.cache(lambda name, options: note_of(results(name), options))
_sheets = functools.cache(lambda name, *options: drawn_sheets(results(name), options[0], **dict(options[1:])))
# the note as well, so that no other one is taken for it
_SHOWN: dict[int, tuple[Note, list[PrintedEquation]]] = {}


def note(name: str, language: Language = "en", **options: Any) -> Note:
    """Return the note of a machine, without figures where they are not asked for."""
    return _note(name, NoteOptions(**{"full": True, "language": language, "figures": False, **options}))


def sheets(name: str, language: Language = "en", paper: Paper = SIGNED, **options: Any) -> tuple[Sheet, ...]:
    """Return the drawing sheets of a machine, signed where no other paper is asked for."""
    return _sheets(name, language, ("paper", paper), *options.items())


def blocks(one: Note, kind: type[Block]) -> list[Any]:
    """Return the blocks of a kind."""
    return [block for block in one.blocks if isinstance(block, kind)]


def headings(one: Note) -> list[str]:
    """Return what the main sections are called."""
    return [block.text for block in blocks(one, Heading) if block.level == 1]


def tables(one: Note) -> dict[str, Table]:
    """Return the tables by their labels, without what says that they are tables."""
    return {block.label.removeprefix("t:"): block for block in blocks(one, Table)}


def nomenclature(one: Note) -> list[tuple[Math, str]]:
    """Return the symbols and their meanings as the table of symbols lists them, its halves one below the other."""
    rows = tables(one)["nomenclature"].rows if "nomenclature" in tables(one) else ()
    pairs = [pair for left in (0, 2) for row in rows if (pair := tuple(row[left : left + 2]))]
    return [(symbol, meaning) for symbol, meaning in pairs if isinstance(symbol, Math)]


def value_rows(one: Note, *labels: str) -> list[tuple[object, ...]]:
    """Return the rows of tables of single values, their parts one below the other: name, symbol, value, unit, place."""
    found = [row for label in labels if label in tables(one) for row in tables(one)[label].rows]
    parts = [(row, 4 if len(row) % 5 else 5) for row in found]
    return [tuple(row[start : start + size]) for row, size in parts for start in range(0, len(row), size)]


def figures(one: Note) -> dict[str, Figure]:
    """Return the figures by their labels, without what says that they are figures."""
    return {block.label.removeprefix("f:"): block for block in blocks(one, Figure)}


def symbols(table: Table) -> list[str]:
    """Return the symbols above the columns of a table."""
    return [title[0].content for title in table.headings]


def value(text: str) -> float:
    """Return a number as a note prints it."""
    return float(text.replace(",", ".").replace("−", "-"))


def column(table: Table, at: int) -> list[float]:
    """Return the numbers of a column."""
    return [value(row[at]) for row in table.rows]


def worked(one: Note) -> dict[str, float]:
    """Return the values of the equations by key and by symbol."""
    found = blocks(one, Equation)
    return {block.step.key: block.step.value for block in found} | {
        block.symbol: block.step.value for block in found if block.symbol
    }


def as_numbered(function: Callable[[Note], T]) -> Callable[[Note], T]:
    """Return a function of a note that calls links as the note does, by their numbers."""

    @functools.wraps(function)
    def numbered(one: Note) -> T:
        with use_numbers(link_numbers(one.results)):
            return function(one)

    return numbered


@as_numbered
def shown(one: Note) -> list[PrintedEquation]:
    """Return the equations as they are printed, worked out once."""
    if id(one) not in _SHOWN:
        _SHOWN[id(one)] = one, [printed_equation(block, one.language) for block in blocks(one, Equation)]
    return _SHOWN[id(one)][1]


def printed(one: Note) -> list[str]:
    """Return the equations as text."""
    return [equation.text.replace("\u00a0", " ") for equation in shown(one)]


def words(one: Note) -> Iterator[str]:
    """Yield all words of a note but its title and sources, which are the user's and the publishers'."""
    for block in one.blocks:
        match block:
            case Heading(text=text):
                yield text
            case Paragraph(runs):
                yield from (run for run in runs if isinstance(run, str))
            case Table(caption=caption, headings=titles, rows=rows):
                yield caption
                yield from (run for runs in (*titles, *rows) for run in runs if isinstance(run, str))
            case Figure(caption=caption, alt=alt):
                yield from (caption, alt)
            case ItemList(items):
                yield from (run for item in items for run in item if isinstance(run, str))


def texts(drawing: Drawing | Sheet) -> list[Text]:
    """Return the texts of a drawing."""
    return [one for one in drawing.items if isinstance(one, Text)]


def lines(drawing: Drawing | Sheet, key: str) -> list[np.ndarray]:
    """Return the lines of a drawing that have a key."""
    return [one.points for one in drawing.items if isinstance(one, Polyline) and one.name == key]


def scale(drawing: Drawing, sign: str) -> float:
    """Return the number of a scale as it stands in a drawing."""
    found = re.search(rf"μ_\{{{re.escape(sign)}\}} = ([\d.,]+)", "\n".join(one.text for one in texts(drawing)))
    assert found is not None
    return value(found[1])
