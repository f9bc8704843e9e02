"""About how wide a table prints, and in which size of letters it fits on a page."""

from __future__ import annotations

from collections.abc import Sequence

from crankwork.note.document import Cell, Math, Runs, Table, cell_length
from crankwork.note.layout import width
from crankwork.note.symbols import symbol_box
from crankwork.show.scene import CAP_HEIGHT, text_width

# of the text on a page upright, half of it, and on its side, and beside the text of each column [pt]
PAGE, HALF_PAGE, WIDE_PAGE, _SIDES = 480.0, 231.0, 725.0, 8.0
# rows of a table beside a figure, and columns among which words have little room there
_FEW, _MANY = 20, 5
# of letters of tables [pt]
SIZES = (10.0, 9.0, 8.0)
# of a digit, a letter of a word, a space, and what a capital of a symbol is wider than its other letters [em]
_DIGIT, _LETTER, _SPACE, _CAPITAL = 0.5, 0.52, 0.3, 0.2


def room(table: Table) -> float:
    """Return the width that a table has. [pt]"""
    return WIDE_PAGE if table.wide else HALF_PAGE if table.half else PAGE


def is_narrow(table: Table) -> bool:
    """Return whether a table is read at half the width of the text."""
    if len(table.rows) > _FEW or not fits(table.headings, table.rows, SIZES[-1], HALF_PAGE):
        return False
    # words of many columns would stand one below the other
    many = len(table.headings) > _MANY
    return not many or bool(one_line_widths(table.headings, table.rows, SIZES[-1], HALF_PAGE))


def fits(headings: Sequence[Runs], rows: Sequence[Sequence[Cell]], size: float, page: float = PAGE) -> bool:
    """Return whether a table fits on a page, or a part of one, with letters of a size, no word of it divided."""
    columns = list(zip(*rows, strict=True)) or [()] * len(headings)
    ems = sum(max(*_parts(runs), *map(_cell, column), 0.0) for runs, column in zip(headings, columns, strict=True))
    return ems * size + _SIDES * len(headings) <= page


def one_line_widths(headings: Sequence[Runs], rows: Sequence[Sequence[Cell]], size: float, page: float) -> list[float]:
    """Return the widths of columns in which every entry is one line, none if they are too wide together. [pt]

    Headings stand in one line too where there is room for all of them.
    """
    entries = [max(map(_line, column), default=0.0) for column in zip(*rows, strict=True)] or [0.0] * len(headings)
    parts = [_parts(runs) for runs in headings]
    for words in ([sum(pieces) + _SPACE * (len(pieces) - 1) for pieces in parts], [max(pieces) for pieces in parts]):
        ems = [max(entry, word) for entry, word in zip(entries, words, strict=True)]
        widths = [width_in_em * size + _SIDES for width_in_em in ems]
        if sum(widths) <= page:
            return widths
    return []


def free_widths(table: Table, size: float, widths: Sequence[float]) -> list[float]:
    """Return the width that a heading leaves beside the numbers of each column of them. [pt]"""
    columns, align = list(zip(*table.rows, strict=True)), table.align or "r" * len(widths)
    return [
        max(0.0, wide - _SIDES - size * max(map(_line, column), default=0.0)) * (place == "r")
        for wide, column, place in zip(widths, columns, align, strict=True)
    ]


def _line(cell: Cell) -> float:
    """Return the width of a cell in one line. [em]"""
    if isinstance(cell, Math):
        return width(symbol_box(cell.content)) if isinstance(cell.content, str) else cell_length(cell) * _DIGIT
    return _DIGIT * len(cell) if not any(map(str.isalpha, cell)) else text_width(cell, CAP_HEIGHT)


def _cell(cell: Cell) -> float:
    if isinstance(cell, Math):
        return _DIGIT * cell_length(cell)
    return _DIGIT * len(cell) if not any(map(str.isalpha, cell)) else _LETTER * max(map(len, cell.split()), default=0)


def _parts(runs: Runs) -> list[float]:
    """Return the widths of the words of a heading. [em]"""
    parts = [0.0]
    for run in runs:
        if isinstance(run, Math):
            content = run.content if isinstance(run.content, str) else ""
            parts[-1] += width(symbol_box(content)) + _CAPITAL * sum(map(str.isupper, content)) if content else 0.0
        elif isinstance(run, str):
            first, *further = (max(_LETTER * len(word), text_width(word, CAP_HEIGHT)) for word in run.split(" "))
            parts[-1] += first
            parts += further
    return parts
