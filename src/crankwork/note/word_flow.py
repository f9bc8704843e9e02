"""In which order the blocks of a note stand in Word, which has no figures that float.

A figure that finds no room on its page waits until the text after it has filled the page, as it would in print. How
high blocks are is estimated; where that is wrong a figure stands a little earlier or later.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from crankwork.analysis import Array
from crankwork.note.document import (
    Bibliography,
    Block,
    Contents,
    Equation,
    Figure,
    Heading,
    ItemList,
    Math,
    PageBreak,
    Paragraph,
    Runs,
    Table,
    TitlePage,
)
from crankwork.note.equations import legend_rows
from crankwork.note.layout import Apply, Box, Fence, Fraction, Root, Row, Script
from crankwork.note.word_parts import Columns
from crankwork.quantities import Language
from crankwork.show.place import MM
from crankwork.show.scene import CAP_HEIGHT, text_width
from crankwork.sources import cite

# of a page: height and width of its text, and what may stay empty for a figure that keeps to its section [pt]
PAGE, _WIDTH, _EMPTY = 728.0, 481.0, 150.0
# how high blocks may be beside what is estimated, and how much text a figure waits for until it stands anywhere [pt]
_OFF, _LONG = np.linspace(0.97, 1.03, 15), 1.5 * PAGE
# lines of text and of mathematics; what a line of a legend and a fraction have more; what stands after a paragraph [pt]
_LINE, _MATHS, _ENTRY, _HIGHER, _AFTER = 16.0, 16.4, 2.3, 12.0, 6.0
_CAPTION, _BEGINS = 17.0 + _LINE, 90.0
_HEADINGS = {1: 46.0, 2: 37.0, 3: 33.0}
_SIZE = 12.0
# before the words of a legend and of an item [pt]; as wide as a symbol in the line, about
_INDENT, _ITEM, _SYMBOL = 48.0, 21.0, 6 * "x"


def flow(blocks: Sequence[Block], heights: Sequence[float]) -> Iterator[int]:
    """Yield the places of blocks in the order in which they are written; `heights`: how high each is. [pt]"""
    waiting: list[int] = []
    filled, waited, is_heading = np.zeros(len(_OFF)), 0.0, False
    for k, (block, height) in enumerate(zip(blocks, heights, strict=True)):
        if isinstance(block, Figure) and (waiting or _left(filled, height).max() > _EMPTY):
            waiting.append(k)
            continue
        is_new = isinstance(block, PageBreak | TitlePage) or (isinstance(block, Table) and block.wide)
        while waiting and not is_heading and (is_new or _fits_here(filled, heights[waiting[0]], waited)):
            figure, waited = waiting.pop(0), 0.0
            filled = _after(filled, blocks[figure], heights[figure])
            yield figure
        yield k
        is_heading = isinstance(block, Heading)
        waited += height if waiting else 0.0
        filled = np.zeros(len(_OFF)) if is_new else _after(filled, block, height)
    yield from waiting


def _left(filled: Array, height: float) -> Array:
    """Return how much of a page stays empty where a figure comes upon it. [pt]"""
    return np.where(filled + height > PAGE, PAGE - filled, 0.0)


def _fits_here(filled: Array, figure: float, waited: float) -> bool:
    """Return whether a waiting figure is placed here: it leaves little empty, or does so on average and waited long."""
    left = _left(filled, figure)
    return bool(left.max() <= _EMPTY or (waited > _LONG and left.mean() <= _EMPTY))


def _after(filled: Array, block: Block, height: float) -> Array:
    """Return how far the page is filled after a block; text and tables go on on the next one."""
    high = np.full(len(_OFF), height) if isinstance(block, Figure) else height * _OFF
    begins = filled
    if isinstance(block, Table | Heading):
        # neither caption and header nor a heading stand alone at the foot of a page; a header stands on every page
        least = _BEGINS if isinstance(block, Table) else height + 2 * _LINE
        begins = np.where(filled + least > PAGE, 0.0, filled)
        high = high + 2 * _LINE * ((begins + high) // PAGE)
    # of an equation the lines that explain it
    is_divided = isinstance(block, Table | Paragraph | ItemList | Contents) or bool(getattr(block, "legend", ()))
    return np.where(begins + high <= PAGE, begins + high, (begins + high) % PAGE if is_divided else high)


def equation_height(block: Equation, lines: Sequence[Row], language: Language) -> float:
    """Return about how high the lines of an equation and its legend are. [pt]"""
    legend = sum(
        _LINE * _lines((words,), _WIDTH - _INDENT) + _ENTRY + _HIGHER * (_high(symbol) - 1.0)
        for _, symbol, words in legend_rows(block, language)
    )
    return sum(_MATHS + _HIGHER * (_high(row) - 1.0) for row in lines) + (legend or 2.0)


def table_height(block: Table, columns: Columns) -> float:
    """Return about how high a table is. [pt]"""
    size, row = columns.size / 2, columns.row_height
    tall = any(isinstance(run, Math) and not isinstance(run.content, str) for runs in block.headings for run in runs)
    rows = row * len(block.rows) or size * sum(
        max(
            1.44 if isinstance(cell, Math) else 1.18 * _lines((cell,), width / 20 - 6.0, size)
            for cell, width in zip(cells, columns.widths, strict=True)
        )
        for cells in block.rows
    )
    return rows + (2.4 + 1.2 * tall) * size + _CAPTION + 0.7 * _LINE


def block_height(block: Block, headings: int, sources: Iterable[str]) -> float:
    """Return about how high another block is; `headings`, `sources`: how many the note has, what it cites. [pt]"""
    match block:
        case Heading(level):
            return _HEADINGS[min(level, 3)]
        case Paragraph(runs):
            return _LINE * _lines(runs) + _AFTER
        case Figure(drawing=drawing):
            return drawing.height / MM * min(1.0, _WIDTH / (drawing.width / MM)) + _CAPTION
        case ItemList(items):
            return sum(_LINE * _lines(item, _WIDTH - _ITEM) + 3 for item in items)
        case Contents():
            return _HEADINGS[1] + (_LINE + 3) * headings
        case Bibliography():
            return sum(_LINE * _lines((cite(source),), _WIDTH - _ITEM) + 3 for source in sources)
        case _:
            return 0.0


def _lines(runs: Runs, width: float = _WIDTH, size: float = _SIZE) -> int:
    wide = sum(text_width(run if isinstance(run, str) else _SYMBOL, CAP_HEIGHT) for run in runs)
    return max(1, math.ceil(wide * size / width))


def _high(box: Box | None) -> float:
    """Return about how high a box is. [lines]"""
    match box:
        case None:
            return 0.0
        case Row(parts):
            return max(map(_high, parts), default=1.0)
        case Fraction(top, bottom):
            return _high(top) + _high(bottom) + 0.2
        case Root(inside) | Fence(inside):
            return _high(inside) + 0.1
        case Script(base, below, above):
            return _high(base) + 0.3 * _high(below) + 0.4 * _high(above)
        case Apply(name, argument):
            return max(_high(name), _high(argument))
        case _:
            return 1.0
