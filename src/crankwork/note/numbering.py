"""The numbers of sections, equations, tables, figures and sources, and the order in which blocks are printed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis import Array
from crankwork.errors import CrankworkError
from crankwork.formula.calculation_lines import FormulaLine
from crankwork.formula.expression import Formula
from crankwork.note.captions import place_in_source
from crankwork.note.document import (
    Block,
    Bold,
    Citation,
    Contents,
    Equation,
    Figure,
    Heading,
    ItemList,
    Note,
    PageBreak,
    Paragraph,
    Reference,
    Run,
    Table,
    TitlePage,
)
from crankwork.quantities import Language
from crankwork.sources import school_source, source_language, sources

# of a page: height of its text, what may stay empty within a section, and where text would fill it [pt]
PAGE, _LITTLE, _EMPTY = 728.0, 60.0, 180.0
# how much text a figure waits for until it stands anywhere, a line of text, the beginning of a long table [pt]
_LONG, LINE, _BEGINS = 1.2 * PAGE, 16.0, 90.0
# height of the caption of a figure [pt], by what share its height may be wrong, what share of its size it keeps
_CAPTION, _TOLERANCE, _SMALLEST = 36.0, 0.02, 0.8
# rows of a table that stays on one page with its caption, and the list of symbols, which may be divided anywhere
TOGETHER, DIVIDED = 20, "t:nomenclature"


class Numbering(NamedTuple):
    """Numbers of the blocks by their place in the note (empty where a block has none), of labels and of sources."""

    blocks: tuple[str, ...]
    labels: dict[str, str]
    sources: dict[str, int]
    language: Language

    def reference(self, label: str) -> str:
        """Return the number of the block with a label."""
        if label not in self.labels:
            raise CrankworkError(f'the note refers to "{label}", which no block has as its label; label the block')
        return self.labels[label]

    def citation(self, source: str) -> str:
        """Return a source as `[2, ch. 6]`, the place as the language of the note abbreviates it."""
        key, _, place = source.partition(",")
        number = str(self.sources[key])
        return f"[{number}, {place_in_source(place.strip(), self.language)}]" if place.strip() else f"[{number}]"

    def words(self, run: str | Bold | Reference | Citation) -> str:
        """Return the text of a run that is no mathematics."""
        match run:
            case Bold(words):
                return words
            case Reference(label):
                return self.reference(label)
            case Citation(source):
                return self.citation(school_source(source, self.language))
        return run

    def mark(self, block: Equation, number: str, between: str = "\u2002") -> str:
        """Return the source and the number of an equation, printed beside it."""
        source = equation_source(block, self.language) if block.cites else ""
        return between.join(([self.citation(source)] if source else []) + ([f"({number})"] if number else []))


def numbering(note: Note) -> Numbering:
    """Return the numbers of everything that a note numbers."""
    counts: Counter[str] = Counter()
    sections = [0, 0, 0]
    numbers: list[str] = []
    labels: dict[str, str] = {}
    for block in note.blocks:
        number = _section_number(block, sections) if isinstance(block, Heading) else _plain_number(block, counts)
        numbers.append(number)
        label = getattr(block, "label", "")
        if label in labels:
            raise CrankworkError(f'two blocks of the note have the label "{label}"; give each its own')
        if label:
            labels[label] = f"({number})" if isinstance(block, Equation) else number
    return Numbering(tuple(numbers), labels, _source_numbers(note), note.language)


def _section_number(heading: Heading, sections: list[int]) -> str:
    """Return `2.1` and count on; a heading without number counts nothing."""
    if not heading.numbered:
        return ""
    level = min(max(heading.level, 1), 3)
    sections[level - 1] += 1
    sections[level:] = [0] * (3 - level)
    return ".".join(map(str, sections[:level]))


def _plain_number(block: Block, counts: Counter[str]) -> str:
    counted = isinstance(block, Table | Figure | Equation)
    if not counted:
        return ""
    kind = type(block).__name__
    counts[kind] += not (isinstance(block, Table) and not block.caption)
    return str(counts[kind])


def equation_source(block: Equation, language: Language) -> str:
    """Return the source of the formula of an equation in the school of a language, empty where it has none."""
    match block.step:
        case FormulaLine(formula=formula) | (Formula() as formula):
            return school_source(formula.source, language, formula.quantity)
    return ""


def _source_numbers(note: Note) -> dict[str, int]:
    keys = list(dict.fromkeys([*(key.partition(",")[0] for key in _cited(note)), *note.sources]))
    unknown = [key for key in keys if key not in sources()]
    if unknown:
        raise CrankworkError(f'the bibliography has no "{unknown[0]}"; add it to sources.bib or cite another source')
    # those in the language of the note first, as lists of references have them
    keys.sort(key=lambda key: source_language(key) != note.language)
    return {key: number for number, key in enumerate(keys, start=1)}


def _cited(note: Note) -> Iterator[str]:
    """Yield the sources in the order in which the text comes to them."""
    for block in note.blocks:
        if isinstance(block, Equation) and (source := equation_source(block, note.language)):
            yield source
        for run in _runs(block):
            if isinstance(run, Citation):
                yield school_source(run.source, note.language)


def _runs(block: Block) -> Iterator[Run]:
    match block:
        case Paragraph(runs):
            yield from runs
        case ItemList(items):
            for item in items:
                yield from item
        case Table(headings=headings):
            for heading in headings:
                yield from heading


def leads(block: Block) -> bool:
    """Return whether a block is a line that leads to an equation, and does not stand alone at the foot of a page."""
    last = block.runs[-1] if isinstance(block, Paragraph) and block.runs else ""
    return isinstance(last, str) and last.endswith(":")


def is_whole(block: Block) -> bool:
    """Return whether a block stands on one page, and may wait for it."""
    if isinstance(block, Table):
        return not block.wide and len(block.rows) <= TOGETHER and block.label != DIVIDED
    return isinstance(block, Figure)


def flow(
    blocks: Sequence[Block], heights: Sequence[float], off: float, smaller: dict[int, float] | None = None
) -> list[int]:
    """Return the places of blocks in the order in which they are printed, that which leaves least of the pages empty.

    `heights`: how high each is [pt]; `off`: by what share they may be wrong; `smaller`: is given the share of its size
    that a figure keeps which has almost room on its page.
    """
    order, at_once = list(range(len(blocks))), frozenset[int]()
    best = _flow(order, blocks, heights, off, None if smaller is None else at_once)
    for k, block in enumerate(blocks):
        if not isinstance(block, Figure):
            continue
        # a figure may stand before the table that comes before it, or be smaller so that it need not wait
        choices = [(order, at_once | {k})] if smaller is not None else []
        before = next((n for n in range(k - 1, -1, -1) if not isinstance(blocks[n], Paragraph)), k)
        if isinstance(blocks[before], Table) and is_whole(blocks[before]):
            changed = [n for n in order if n != k]
            changed.insert(changed.index(before), k)
            choices += [(changed, at_once | {k}), (changed, at_once)]
        for sequence, chosen in choices:
            tried = _flow(sequence, blocks, heights, off, None if smaller is None else chosen)
            if tried.empty < best.empty - LINE:
                best, order, at_once = tried, sequence, chosen
    if smaller is not None:
        smaller |= best.smaller
    return best.order


class _Flow(NamedTuple):
    """An order of blocks, how much of the pages stays empty [pt], and the shares of their size that figures keep."""

    order: list[int]
    empty: float
    smaller: dict[int, float]


def _flow(
    sequence: Sequence[int], blocks: Sequence[Block], heights: Sequence[float], off: float,
    at_once: frozenset[int] | None,
) -> _Flow:  # fmt: skip
    """Return blocks that come in some sequence in the order in which they are printed.

    `at_once`: the figures that are made smaller rather than wait; others only where their section ends; None: none is.
    """
    heights, order, smaller, empty = list(heights), list[int](), dict[int, float](), 0.0
    waiting: list[int] = []
    factors = np.linspace(1.0 - off, 1.0 + off, 15)
    filled, waited, is_heading = np.zeros(len(factors)), 0.0, False
    for k in sequence:
        block, height = blocks[k], heights[k]
        may_wait = is_whole(block)
        waiting += [k] if may_wait else []
        covers = isinstance(block, TitlePage) and not block.is_plain
        is_new = covers or isinstance(block, PageBreak) or (isinstance(block, Table) and block.wide)
        most = PAGE if is_new or (isinstance(block, Heading) and block.level == 1) else _LITTLE
        # what waits does not stand between a heading and its text
        while waiting and (not is_heading or waiting == [k]):
            # no derivation is divided by what it does not need
            inside = k and isinstance(block, Equation) and isinstance(blocks[k - 1], Equation)
            ready = [] if inside else [*_ready(waiting, blocks)]
            # what has room on the page stands before what would leave the rest of it empty
            ready.sort(key=lambda place: bool(_left(filled, heights[place]).max()))
            free = PAGE - float(filled.max())
            place = next(
                (place for place in ready if _left(filled, heights[place]).max() <= most
                 or (at_once is not None and (most > _LITTLE or place in at_once)
                     and _share_of_size(blocks[place], heights[place], free) < 1.0)), None,
            )  # fmt: skip
            if place is None and (waited <= _LONG or _left(filled, heights[waiting[0]]).mean() > _EMPTY):
                break
            place = waiting[0] if place is None else place
            waiting.remove(place)
            share = _share_of_size(blocks[place], heights[place], free)
            if at_once is not None and share < 1.0:
                smaller[place], heights[place] = share, free / (1.0 + off)
            after = _after(filled, blocks[place], heights[place] * factors)
            empty += _unused(filled, after, heights[place])
            filled, waited, is_heading = after, 0.0, False
            order.append(place)
        if not may_wait:
            order.append(k)
            is_heading = isinstance(block, Heading)
            waited += height if waiting else 0.0
            after = np.zeros(len(factors)) if is_new else _after(filled, block, height * factors)
            empty += 0.0 if is_new else _unused(filled, after, height)
            filled = after
    return _Flow(order + waiting, empty, smaller)


def _unused(before: Array, after: Array, height: float) -> float:
    """Return how much of a page stays empty before a block of some height. [pt]"""
    return float(np.mean((after - before - height + LINE) % PAGE)) - LINE


def _ready(waiting: Sequence[int], blocks: Sequence[Block]) -> Iterator[int]:
    """Yield what may be printed next of what waits: figures keep their order, and so do tables."""
    before: set[type] = set()
    for place in waiting:
        block = blocks[place]
        kinds = {Figure, Table} if isinstance(block, Figure | Table) and block.half else {type(block)}
        if not kinds & before:
            yield place
        before |= kinds


def _share_of_size(block: Block, height: float, free: float) -> float:
    """Return the share of its size at which a figure has room on its page, the whole where that is too small."""
    if not isinstance(block, Figure) or block.half or block.to_scale or height <= _CAPTION:
        return 1.0
    share = (free - _TOLERANCE * height - _CAPTION) / (height - _CAPTION)
    return share if _SMALLEST <= share < 1.0 else 1.0


def _left(filled: Array, height: float) -> Array:
    """Return the empty height of a page on which a figure is placed. [pt]"""
    return np.where(filled + height > PAGE, PAGE - filled, 0.0)


def _after(filled: Array, block: Block, high: Array) -> Array:
    """Return the filled height of the page after a block; text and long tables continue on the next one."""
    begins = filled
    is_divided = isinstance(block, Table | Paragraph | ItemList | Contents) and not is_whole(block)
    if isinstance(block, Heading) or leads(block) or (isinstance(block, Table) and is_divided):
        # neither caption and header nor a heading stand alone at the foot of a page; a header stands on every page
        least = _BEGINS if isinstance(block, Table) else high + 2 * LINE
        begins = np.where(filled + least > PAGE, 0.0, filled)
        high = high + 2 * LINE * ((begins + high) // PAGE)
    return np.where(begins + high <= PAGE, begins + high, (begins + high) % PAGE if is_divided else high)
