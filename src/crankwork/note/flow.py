"""The order in which the blocks of a note are printed: figures and short tables stand where they leave little empty.

One without room on its page waits until the text after it has filled the page, and for the end of its section at most.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from crankwork.analysis import Array
from crankwork.note.document import (
    Block,
    Contents,
    Equation,
    Figure,
    Heading,
    ItemList,
    PageBreak,
    Paragraph,
    Table,
    TitlePage,
)

# of a page: height of its text, what may stay empty within a section, and where text would fill it [pt]
PAGE, _LITTLE, _EMPTY = 728.0, 60.0, 180.0
# how much text a figure waits for until it stands anywhere, a line of text, the beginning of a long table [pt]
_LONG, LINE, _BEGINS = 1.2 * PAGE, 16.0, 90.0
# rows of a table that stays on one page with its caption, and the list of symbols, which may be divided anywhere
TOGETHER, _DIVIDED = 20, "t:nomenclature"


def is_whole(block: Block) -> bool:
    """Return whether a block stands on one page, and may wait for it."""
    if isinstance(block, Table):
        return not block.wide and len(block.rows) <= TOGETHER and block.label != _DIVIDED
    return isinstance(block, Figure)


def flow(blocks: Sequence[Block], heights: Sequence[float], off: float) -> Iterator[int]:
    """Yield the places of blocks in the order in which they are printed.

    `heights`: how high each is [pt]; `off`: by what share they may be wrong.
    """
    waiting: list[int] = []
    factors = np.linspace(1.0 - off, 1.0 + off, 15)
    filled, waited, is_heading = np.zeros(len(factors)), 0.0, False
    for k, (block, height) in enumerate(zip(blocks, heights, strict=True)):
        may_wait = is_whole(block)
        waiting += [k] if may_wait else []
        covers = isinstance(block, TitlePage) and not block.is_plain
        is_new = covers or isinstance(block, PageBreak) or (isinstance(block, Table) and block.wide)
        most = PAGE if is_new or (isinstance(block, Heading) and block.level == 1) else _LITTLE
        # what waits does not stand between a heading and its text
        while waiting and (not is_heading or waiting == [k]):
            # no derivation is divided by what it does not need
            inside = k and isinstance(block, Equation) and isinstance(blocks[k - 1], Equation)
            ready = () if inside else _ready(waiting, blocks)
            place = next((place for place in ready if _fits_here(filled, heights[place], most)), None)
            if place is None and (waited <= _LONG or _left(filled, heights[waiting[0]]).mean() > _EMPTY):
                break
            place = waiting[0] if place is None else place
            waiting.remove(place)
            filled, waited, is_heading = _after(filled, blocks[place], heights[place] * factors), 0.0, False
            yield place
        if not may_wait:
            yield k
            is_heading = isinstance(block, Heading)
            waited += height if waiting else 0.0
            filled = np.zeros(len(factors)) if is_new else _after(filled, block, height * factors)
    yield from waiting


def _ready(waiting: Sequence[int], blocks: Sequence[Block]) -> Iterator[int]:
    """Yield what may be printed next of what waits: figures keep their order, and so do tables."""
    before: set[type] = set()
    for place in waiting:
        block = blocks[place]
        kinds = {Figure, Table} if isinstance(block, Figure | Table) and block.half else {type(block)}
        if not kinds & before:
            yield place
        before |= kinds


def _left(filled: Array, height: float) -> Array:
    """Return the empty height of a page on which a figure is placed. [pt]"""
    return np.where(filled + height > PAGE, PAGE - filled, 0.0)


def _fits_here(filled: Array, figure: float, most: float) -> bool:
    """Return whether a waiting figure leaves little empty where it is placed here."""
    return bool(_left(filled, figure).max() <= most)


def _after(filled: Array, block: Block, high: Array) -> Array:
    """Return the filled height of the page after a block; text and long tables continue on the next one."""
    begins = filled
    is_divided = isinstance(block, Table | Paragraph | ItemList | Contents) and not is_whole(block)
    if isinstance(block, Heading) or (isinstance(block, Table) and is_divided):
        # neither caption and header nor a heading stand alone at the foot of a page; a header stands on every page
        least = _BEGINS if isinstance(block, Table) else high + 2 * LINE
        begins = np.where(filled + least > PAGE, 0.0, filled)
        high = high + 2 * LINE * ((begins + high) // PAGE)
    return np.where(begins + high <= PAGE, begins + high, (begins + high) % PAGE if is_divided else high)
