"""The order in which the blocks of a note are printed: figures and short tables stand where they leave little empty.

One without room on its page waits until the text after it has filled the page, and for the end of its section at most,
unless much of the page would stay empty there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from crankwork.analysis import Array
from crankwork.note.document import Block, Contents, Figure, Heading, ItemList, PageBreak, Paragraph, Table, TitlePage

# of a page: height of its text, what may stay empty within a section, and at its end [pt]
PAGE, _LITTLE, _EMPTY = 728.0, 60.0, 180.0
# how much text a figure waits for until it stands anywhere, a line of text, the beginning of a long table [pt]
_LONG, LINE, _BEGINS = 1.2 * PAGE, 16.0, 90.0
# rows of a table that stays on one page with its caption
TOGETHER = 20


def is_whole(block: Block) -> bool:
    """Return whether a block stands on one page, and may wait for it."""
    return isinstance(block, Figure) or (isinstance(block, Table) and not block.wide and len(block.rows) <= TOGETHER)


def flow(blocks: Sequence[Block], heights: Sequence[float], off: float) -> Iterator[int]:
    """Yield the places of blocks in the order in which they are printed.

    `heights`: how high each is [pt]; `off`: by what share they may be wrong.
    """
    waiting: list[int] = []
    factors = np.linspace(1.0 - off, 1.0 + off, 15)
    filled, waited, is_heading = np.zeros(len(factors)), 0.0, False
    for k, (block, height) in enumerate(zip(blocks, heights, strict=True)):
        if is_whole(block) and (waiting or _left(filled, height).max() > _LITTLE):
            waiting.append(k)
            continue
        covers = isinstance(block, TitlePage) and not block.is_plain
        is_new = covers or isinstance(block, PageBreak) or (isinstance(block, Table) and block.wide)
        most = _EMPTY if isinstance(block, Heading) and block.level == 1 else _LITTLE
        while waiting and not is_heading and (is_new or _fits_here(filled, heights[waiting[0]], waited, most)):
            figure, waited = waiting.pop(0), 0.0
            filled = _after(filled, blocks[figure], heights[figure] * factors)
            yield figure
        yield k
        is_heading = isinstance(block, Heading)
        waited += height if waiting else 0.0
        filled = np.zeros(len(factors)) if is_new else _after(filled, block, height * factors)
    yield from waiting


def _left(filled: Array, height: float) -> Array:
    """Return the empty height of a page on which a figure is placed. [pt]"""
    return np.where(filled + height > PAGE, PAGE - filled, 0.0)


def _fits_here(filled: Array, figure: float, waited: float, most: float) -> bool:
    """Return whether a waiting figure is placed here: it leaves little empty, or does so on average and waited long."""
    left = _left(filled, figure)
    return bool(left.max() <= most or (waited > _LONG and left.mean() <= _EMPTY))


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
