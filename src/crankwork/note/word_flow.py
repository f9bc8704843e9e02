"""In which order the blocks of a note stand in Word, which has no figures that float.

A figure that finds no room on its page waits until the text after it has filled the page, as it would in print. How
high blocks are is estimated; where that is wrong a figure stands a little earlier or later.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

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
from crankwork.note.layout import Apply, Box, Fence, Fraction, Root, Row, Script
from crankwork.show.place import MM
from crankwork.show.scene import CAP_HEIGHT, text_width

# of a page: height and width of its text, and what may stay empty for a figure that keeps to its section [pt]
PAGE, _WIDTH, _EMPTY = 728.0, 481.0, 150.0
# how far estimates of heights are off
_DOUBT = 0.04
# lines of text, of mathematics and of a legend; what a fraction has more; what stands after a paragraph [pt]
_LINE, _MATHS, _ENTRY, _HIGHER, _AFTER = 16.0, 16.2, 18.4, 12.0, 6.0
_CAPTION = 12.0 + _LINE
_HEADINGS = {1: 46.0, 2: 37.0, 3: 33.0}
_SIZE = 12.0


def flow(blocks: Sequence[Block], heights: Sequence[float]) -> Iterator[int]:
    """Yield the places of blocks in the order in which they are written; `heights`: how high each is. [pt]"""
    waiting: list[int] = []
    filled, doubt, is_heading = 0.0, 0.0, False
    for k, (block, height) in enumerate(zip(blocks, heights, strict=True)):
        left = PAGE - filled
        if isinstance(block, Figure) and (waiting or (left + doubt > _EMPTY and height > left - doubt)):
            waiting.append(k)
            continue
        is_new = isinstance(block, PageBreak | TitlePage) or (isinstance(block, Table) and block.wide)
        while waiting and not is_heading and (is_new or _goes_first(heights[waiting[0]], left, doubt, block, height)):
            figure = waiting.pop(0)
            filled, doubt = _placed(filled, doubt, heights[figure])
            left = PAGE - filled
            yield figure
        yield k
        is_heading = isinstance(block, Heading)
        if is_new:
            filled, doubt = 0.0, 0.0
        elif isinstance(block, Figure):
            filled, doubt = _placed(filled, doubt, height)
        else:
            filled, doubt = _after(filled, block, height), min(doubt + _DOUBT * height, _EMPTY)
    yield from waiting


def _placed(filled: float, doubt: float, height: float) -> tuple[float, float]:
    """Return how far the page is filled after a figure, and how sure that is; at the head of a page it is sure."""
    return (height, 0.0) if filled + doubt + height > PAGE else (filled + height, doubt)


def _goes_first(figure: float, room: float, doubt: float, block: Block, height: float) -> bool:
    """Return whether a figure that waits stands before a block: it fits, or the page is full, or its section ends."""
    is_end = isinstance(block, Heading) and block.level == 1 and room + doubt <= _EMPTY
    is_next = not isinstance(block, Table | Paragraph) and height > room
    # one as high as a page must not come upon a page that has begun
    least = doubt if figure > PAGE - 2 * _EMPTY else 0.0
    return figure <= room - doubt or room < max(4 * _LINE, least) or is_end or is_next


def _after(filled: float, block: Block, height: float) -> float:
    """Return how far the page is filled after a block; text and tables go on on the next one."""
    if filled + height <= PAGE:
        return filled + height
    if isinstance(block, Table):
        # its header stands on every page
        height += 2 * _LINE * int((filled + height) / PAGE)
    return (filled + height) % PAGE if isinstance(block, Table | Paragraph | ItemList | Contents) else height


def equation_height(block: Equation, lines: Sequence[Row]) -> float:
    """Return about how high the lines of an equation and its legend are. [pt]"""
    return sum(_MATHS + _HIGHER * (_high(one) - 1.0) for one in lines) + _ENTRY * len(block.legend)


def table_height(block: Table, size: float, row: float) -> float:
    """Return about how high a table with letters of a size is; `row`: how high a row is where all are one line. [pt]"""
    tall = any(isinstance(one, Math) and not isinstance(one.content, str) for runs in block.headings for one in runs)
    return (row or 1.3 * size) * len(block.rows) + (2.4 + 1.2 * tall) * size + _CAPTION + _LINE


def block_height(block: Block, headings: int) -> float:
    """Return about how high another block is; `headings`: how many the note has. [pt]"""
    match block:
        case Heading(level):
            return _HEADINGS[min(level, 3)]
        case Paragraph(runs):
            return _LINE * _lines(runs) + _AFTER
        case Figure(drawing=drawing):
            return drawing.height / MM * min(1.0, _WIDTH / (drawing.width / MM)) + _CAPTION
        case ItemList(items):
            return sum(_LINE * _lines(item) + 3 for item in items)
        case Contents():
            return _HEADINGS[1] + (_LINE + 3) * headings
        case Bibliography():
            return 8 * _LINE
        case _:
            return 0.0


def _lines(runs: Runs) -> int:
    wide = sum(text_width(one if isinstance(one, str) else " " * 12, CAP_HEIGHT) for one in runs)
    return max(1, math.ceil(0.92 * wide * _SIZE / _WIDTH))


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
