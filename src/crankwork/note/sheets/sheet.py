"""A sheet of paper: its format, millimetre grid, frame, title block, text blocks, and the figures on it."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Literal, NamedTuple, get_args

import numpy as np

from crankwork.errors import CrankworkError
from crankwork.locale import decimal, translate
from crankwork.machine import Document
from crankwork.note.captions import printed_date
from crankwork.note.sheets.packing import HIGHEST, TALLEST, Fit, Layout, Picture, Sizes, finished, grown, packed, worth
from crankwork.quantities import Language
from crankwork.show.canvas import WIDER, Canvas, ChartLayout, current_layout, fitted_lines, use_layout
from crankwork.show.canvas import text_width as canvas_width
from crankwork.show.scene import (
    SMALL,
    TEXT,
    TITLE,
    ChartBox,
    Drawing,
    Item,
    Polyline,
    Text,
    flow_rows,
    line,
    literal,
    printable,
    rectangle,
    text_width,
)

Size = Literal["A0", "A1", "A2", "A3"]
SIZES: tuple[Size, ...] = get_args(Size)
_LENGTHS: dict[Size, tuple[float, float]] = {
    "A0": (1189.0, 841.0), "A1": (841.0, 594.0), "A2": (594.0, 420.0), "A3": (420.0, 297.0)
}  # fmt: skip
# shares of the width that columns of figures have, and how many figures a sheet holds
_LAYOUTS: dict[Size, tuple[Layout, ...]] = {
    "A0": ((1 / 3,) * 3, (1 / 2, 1 / 2), (1.0,)),
    "A1": ((1 / 2, 1 / 2), (1 / 3,) * 3, (1.0,)),
    # one that is too tall to stand above the title block stands beside it
    "A2": ((1 / 2, 1 / 2), (1.0,), (0.65,)),
    "A3": ((1.0,), (1 / 2, 1 / 2), (0.52,)),
}
_MOST: dict[Size, int] = {"A0": 12, "A1": 8, "A2": 4, "A3": 2}
# how tall graphs are at least, against those of a text
_LEAST: dict[Size, float] = {"A0": 0.6, "A1": 0.6, "A2": 0.4, "A3": 0.38}
_BINDING, _EDGE = 20.0, 5.0
# how often figures are placed anew whose names need more room than was thought
_TRIES = 8
_SIZES: dict[Language, tuple[float, float]] = {"ru": (185.0, 55.0), "vi": (185.0, 55.0), "en": (180.0, 36.0)}
_HEIGHTS = (10.0, 7.0, TITLE, TEXT, SMALL)
_LONGEST = 300
# letters of a reader may be wider than our table has them; letters may be set narrower; from row to row, in heights
_READERS, _NARROWEST, _STEP = 1.15, 0.55, 1.6
_ROW, _PAD, _BETWEEN, _DIGITS = 13.0, 4.0, 8.0, 4
_THICK, _THIN = 1.0, 0.4
# between a table and the frame of its sheet, on both sides together [pt]
_FREE = 10.0
# how much wider and taller than what it says a table is at most, to fill its place
_WIDEST, _TALLEST = 1.7, 1.5
# letters, and smaller ones where a column would not fit
_TEXT_SIZES = (8.5, 7.5)


class Paper(NamedTuple):
    """The paper of sheets: format `A0` to `A3`, millimetre grid, frame, and the title block if they have one."""

    size: Size = "A1"
    has_grid: bool = False
    has_frame: bool = True
    block: TitleBlock | None = None

    @property
    def box(self) -> ChartBox:
        """The whole paper. [mm]"""
        return ChartBox(0.0, 0.0, *_LENGTHS[self.size])

    @property
    def frame(self) -> ChartBox:
        """The inside of the frame: a margin of 20 mm to the left, for binding, and of 5 mm elsewhere. [mm]"""
        return self.box.inset(_BINDING, _EDGE, _EDGE, _EDGE)

    @property
    def corner(self) -> ChartBox:
        """Where the cell in the upper left corner is. [mm]"""
        width, height = size_of_corner(self.block) if self.block is not None else (0.0, 0.0)
        return ChartBox(self.frame.left, self.frame.top - height, width, height)

    @property
    def reserved(self) -> ChartBox:
        """Where the title block is. [mm]"""
        width, height = size_of_block(self.block) if self.block is not None else (0.0, 0.0)
        return ChartBox(self.frame.right - width, self.frame.bottom, width, height)


class Sheet(NamedTuple):
    """A sheet: name for its file, title, language, paper, and the figures on it."""

    name: str
    title: str
    language: Language
    paper: Paper
    figures: tuple[Fit, ...]

    @property
    def items(self) -> tuple[Item, ...]:
        """All that is drawn, from the ground up."""
        paper = self.paper
        drawn: list[Item] = _millimetres(paper.frame) if paper.has_grid else []
        for figure in self.figures:
            drawn.extend(figure.drawing.items)
        if paper.has_frame:
            drawn += [rectangle(paper.box, "net"), rectangle(paper.frame, "thick")]
            if paper.block is not None:
                drawn += corner_cell(paper.block, paper.corner)
        if paper.block is not None:
            drawn += title_block(paper.block, self.title, paper.size, paper.reserved)
        return tuple(drawn)

    @property
    def drawing(self) -> Drawing:
        """The sheet as what is written."""
        box = self.paper.box
        plots = tuple(plot for figure in self.figures for plot in figure.drawing.plots)
        return Drawing(self.title, self.language, box.width, box.height, self.items, plots)

    def figure(self, name: str) -> Fit:
        """Return a figure by its name."""
        figure = next((fit for fit in self.figures if fit.name == name), None)
        if figure is None:
            raise CrankworkError(
                f"there is no figure {name} on this sheet; there is {', '.join(fit.name for fit in self.figures)}"
            )
        return figure


def sheets_with(
    name: str, title: str, pictures: Sequence[Picture], paper: Paper, language: Language
) -> Iterator[Sheet]:
    """Yield the sheets that pictures need on a paper, each with about as many."""
    if paper.size not in SIZES:
        raise CrankworkError(f"no paper of size {paper.size} is known; take {', '.join(SIZES)}")
    sizes, most = Sizes(), _MOST[paper.size]
    count = math.ceil(len(pictures) / most)
    ends = [len(pictures) * index // count for index in range(count + 1)]
    parts = [_packed(pictures[start:end], paper, sizes) for start, end in itertools.pairwise(ends)]
    if not all(parts):
        # a picture that does not fit even alone is named in its place
        fitting = [
            picture if _packed([picture], paper, sizes) else _without_room(picture, paper, language)
            for picture in pictures
        ]
        sizes = Sizes()
        best: list[tuple[int, float, list[list[Fit]]]] = [(0, 0.0, [])]
        for end in range(1, len(pictures) + 1):
            options = []
            for start in range(max(0, end - most), end):
                if part := _packed(fitting[start:end], paper, sizes):
                    used, lost, before = best[start]
                    options.append((used + 1, lost - math.fsum(map(worth, part)), [*before, part]))
            # of few sheets those with the largest pictures
            best.append(min(options, key=lambda option: option[:2]))
        parts = best[-1][2]
    for part in parts:
        shown = [fit.picture for fit in part]
        rough = _packed(shown, paper, sizes, TALLEST) or part
        done = [finished(fit, _field(paper), paper.corner) for fit in rough]
        for _ in range(_TRIES):
            if not grown(rough, done, sizes) or not (higher := _packed(shown, paper, sizes, TALLEST)):
                break
            rough, done = higher, [finished(fit, _field(paper), paper.corner) for fit in higher]
        yield Sheet(name, title, language, paper, tuple(done))


def _without_room(picture: Picture, paper: Paper, language: Language) -> Picture:
    """Return a sentence that says which figure a paper is too small for."""
    with use_layout(ChartLayout(is_rough=True)):
        title = picture.draw().title
    text = translate("sheets.no_room", language, title=title, size=paper.size)
    return Picture(picture.name, partial(text_block, [text], title, language), has_title=False)


def _field(paper: Paper) -> ChartBox:
    return paper.frame.inset(2, 2, 2, 7)


def _packed(pictures: Sequence[Picture], paper: Paper, sizes: Sizes, highest: float = HIGHEST) -> list[Fit]:
    taken, bounds = (paper.corner, paper.reserved), (_LEAST[paper.size], highest)
    return packed(pictures, _field(paper), taken, _LAYOUTS[paper.size], bounds, sizes)


def numbered(sheets: Sequence[Sheet], paper: Paper) -> tuple[Sheet, ...]:
    """Return sheets that follow one another, each with its number in its title block."""
    if paper.block is None:
        return tuple(sheets)
    first, count = paper.block.sheet, max(paper.block.sheets, len(sheets))
    height = min((title_height(paper.block, sheet.title) for sheet in sheets), default=paper.block.title_height)
    block = paper.block._replace(sheets=count, title_height=height)
    blocks = [block._replace(sheet=first + index) for index in range(len(sheets))]
    return tuple(sheet._replace(paper=paper._replace(block=block)) for sheet, block in zip(sheets, blocks, strict=True))


def _millimetres(frame: ChartBox) -> list[Item]:
    """Return the grid of millimetre paper, every tenth line bold."""
    items: list[Item] = []
    for start, end, low, high, is_upright in (
        (frame.left, frame.right, frame.bottom, frame.top, True),
        (frame.bottom, frame.top, frame.left, frame.right, False),
    ):
        for count, position in enumerate(np.arange(start, end + 1e-9, 1.0)):
            ends = [[position, low], [position, high]] if is_upright else [[low, position], [high, position]]
            items.append(Polyline(np.array(ends), "grid" if count % 10 else "grid_bold"))
    items.sort(key=lambda grid_line: isinstance(grid_line, Polyline) and grid_line.kind == "grid_bold")
    return items


class TitleBlock(NamedTuple):
    """Texts of the title block, in the form of a language; empty ones are left to be filled in by hand.

    `title` replaces that of the sheet, `designation` is the number of the document; `scale`, `mass` and `date` stand
    as they are written.
    """

    form: Language = "en"
    title: str = ""
    designation: str = ""
    institution: str = ""
    department: str = ""
    group: str = ""
    subject: str = ""
    author: str = ""
    supervisor: str = ""
    checked_by: str = ""
    standards_by: str = ""
    approved_by: str = ""
    date: str = ""
    scale: str = ""
    mass: str = ""
    sheet: int = 1
    sheets: int = 1
    title_height: float = 7.0  # At most, since all sheets of a set have one


def block_of(document: Document, form: Language, author: str = "") -> TitleBlock:
    """Return the title block of a document; `author` replaces its own."""
    date = printed_date(document.date, form) if document.date is not None else str(document.year or "")
    return TitleBlock(
        form=form,
        designation=document.designation,
        institution=document.institution,
        department=", ".join(filter(None, (document.faculty, document.department))),
        group=document.group,
        subject=". ".join(filter(None, (document.work, document.subject))),
        author=author or ", ".join(document.author),
        supervisor=document.supervisor,
        checked_by=document.checked_by,
        standards_by=document.standards_by,
        approved_by=document.approved_by,
        date=date,
        scale=document.scale,
    )


class _Cell(NamedTuple):
    """A cell: left, bottom, width and height [mm], what it is, what it says, height of its letters at most [mm]."""

    left: float
    bottom: float
    width: float
    height: float
    label: str = ""
    text: str = ""
    most: float = TEXT


def size_of_block(block: TitleBlock) -> tuple[float, float]:
    """Return width and height of a title block. [mm]"""
    return _SIZES[block.form]


def title_block(block: TitleBlock, title: str, paper: str, place: ChartBox) -> list[Item]:
    """Return the title block.

    `title`: what the sheet shows, where the block has no title of its own; `paper`: its format.
    """
    block = block._replace(title=block.title or title)
    cells = _iso(block, paper) if block.form == "en" else _form_1(block)
    items: list[Item] = []
    for cell in cells:
        box = ChartBox(place.left + cell.left, place.bottom + cell.bottom, cell.width, cell.height)
        # rows that are filled in by hand are parted by thin lines
        items.append(rectangle(box, "thin" if cell.left < 65 and block.form != "en" else "thick"))
        items += _labelled(cell, box) if block.form == "en" else _written(cell.label or cell.text, box, cell.most)
    for left in _UPRIGHT if block.form != "en" else ():
        foot = place.left + left, place.bottom
        items.append(line(foot, (foot[0], foot[1] + _FOOT[block.form]), "thick"))
    items.append(rectangle(place, "thick"))
    return items


def title_height(block: TitleBlock, title: str) -> float:
    """Return the height of the letters of a title that has its place to itself. [mm]"""
    wide, high = (100.0, 14.0) if block.form == "en" else (70.0, 25.0)
    letters = (row.height for row in _written(block.title or title, ChartBox(0, 0, wide, high), block.title_height))
    return min(letters, default=block.title_height)


# thick lines between the columns of those who sign, and how far up they go
_UPRIGHT = (17.0, 40.0, 55.0, 65.0)
_FOOT: dict[Language, float] = {"ru": 55.0, "vi": 35.0}
_ROLES: dict[Language, tuple[str, ...]] = {
    "ru": ("drawn", "checked", "technology", "", "standards", "approved"),
    "vi": ("designed", "guided", "checked", "", "standards", "approved"),
}


def _form_1(block: TitleBlock) -> Iterator[_Cell]:
    """Yield the cells of form 1, 185 x 55 mm; a student's of Vietnam names the project where changes are noted."""
    language = block.form
    names = {
        "drawn": block.author, "designed": block.author, "guided": block.supervisor,
        "checked": block.checked_by or (block.supervisor if language == "ru" else ""),
        "standards": block.standards_by, "approved": block.approved_by,
    }  # fmt: skip
    heads = ("change", "sheet", "document", "signature", "date") if language == "ru" else (
        "function", "", "full_name", "signature", "date")  # fmt: skip
    lefts = (0.0, 7.0, 17.0, 40.0, 55.0, 65.0)
    if language == "ru":
        for row in range(4):
            for left, right in itertools.pairwise(lefts):
                yield _Cell(left, 35 + 5.0 * row, right - left, 5)
    else:
        yield _Cell(0, 35, 65, 20, text=block.subject)
        lefts = (0.0, 17.0, 17.0, 40.0, 55.0, 65.0)
    for key, (left, right) in zip(heads, itertools.pairwise(lefts), strict=True):
        if right > left:
            yield _Cell(left, 30, right - left, 5, _text(key, language), most=SMALL)
    for row, role in enumerate(_ROLES[language]):
        foot = 25 - 5.0 * row
        yield _Cell(0, foot, 17, 5, _text(role, language), most=SMALL)
        yield _Cell(17, foot, 23, 5, text=names.get(role, ""), most=SMALL)
        yield _Cell(40, foot, 15, 5)
        yield _Cell(55, foot, 10, 5, text=block.date if row == 0 else "", most=SMALL)
    yield _Cell(65, 40, 120, 15, text=block.designation, most=7.0)
    yield _Cell(65, 15, 70, 25, text=block.title, most=block.title_height)
    yield _Cell(65, 0, 70, 15, text=block.subject if language == "ru" else block.department, most=TEXT)
    for left, width, key, text in (
        (135.0, 15.0, "letter", ""), (150.0, 17.0, "mass", block.mass), (167.0, 18.0, "scale", block.scale)
    ):  # fmt: skip
        yield _Cell(left, 35, width, 5, _text(key, language), most=SMALL)
        if key == "letter":
            for column in range(3):
                yield _Cell(left + 5 * column, 20, 5, 15)
        else:
            yield _Cell(left, 20, width, 15, text=text)
    yield _Cell(135, 15, 20, 5, f"{_text('sheet', language)} {block.sheet}", most=SMALL)
    # GOST 2.104 has the number of sheets on the first of them only
    count = block.sheets if block.sheet == 1 or language != "ru" else ""
    yield _Cell(155, 15, 30, 5, f"{_text('sheets', language)} {count}", most=SMALL)
    yield _Cell(135, 0, 50, 15, text=", ".join(part for part in (block.institution, block.group) if part))


def _iso(block: TitleBlock, paper: str) -> Iterator[_Cell]:
    """Yield the cells of ISO 7200, 180 x 36 mm."""
    creator = ", ".join(filter(None, (block.author, block.group)))
    rows = (
        (27.0, ((60.0, 44.0, "department", block.department), (104.0, 38.0, "supervisor", block.supervisor),
                (142.0, 38.0, "course", block.subject))),
        (18.0, ((60.0, 44.0, "creator", creator), (104.0, 38.0, "note.cover_approved_by", block.approved_by),
                (142.0, 38.0, "document_type", _text("page.diagrams", "en")))),
        (9.0, ((100.0, 60.0, "number", block.designation), (160.0, 20.0, "format", paper))),
        (0.0, ((100.0, 15.0, "change", ""), (115.0, 30.0, "issued", block.date), (145.0, 15.0, "language", "en"),
               (160.0, 20.0, "sheet", f"{block.sheet}/{block.sheets}"))),
    )  # fmt: skip
    yield _Cell(0, 18, 60, 18, _text("owner", "en"), block.institution)
    yield _Cell(0, 0, 100, 18, _text("title", "en"), block.title, block.title_height)
    for foot, cells in rows:
        for left, width, key, text in cells:
            yield _Cell(left, foot, width, 9, _text(key, "en"), text)


def _text(key: str, language: Language) -> str:
    return translate(key if "." in key else f"sheets.{key}", language) if key else ""


def size_of_corner(block: TitleBlock) -> tuple[float, float]:
    """Return width and height of the cell in the upper left corner, that only GOST asks for. [mm]"""
    return (70.0, 14.0) if block.form == "ru" else (0.0, 0.0)


def corner_cell(block: TitleBlock, place: ChartBox) -> list[Item]:
    """Return the cell in the upper left corner, with the designation upside down, where there is one."""
    if not place.width:
        return []
    return [rectangle(place, "thick", 1.0), *_written(block.designation, place, 7.0, angle=180.0)]


def _labelled(cell: _Cell, box: ChartBox) -> list[Text]:
    """Return the label of a cell in its upper left corner, and under it what it says."""
    wide = min(1.0, (box.width - 2) / max(_width(cell.label, SMALL), 1e-9))
    label = Text((box.left + 1, box.top - 1 - SMALL), cell.label, SMALL, wide=wide)
    return [label, *_written(cell.text, box.inset(0, 0, 0, 4.0), cell.most)]


def _written(text: str, box: ChartBox, most: float, angle: float = 0.0) -> list[Text]:
    """Return a text in the middle of a box, as large as there is room for, on more rows and narrower if it is long."""
    text = literal(" ".join(printable(text, _LONGEST).split()))
    if not text:
        return []
    room, high = box.width - 0.8, box.height - 0.6
    # what is turned stands on one row
    high = min(high, 1.3 * most) if angle else high
    tried = (
        (size, wide)
        for size in _HEIGHTS
        if size <= most
        for wide in (1.0, 0.8, *((0.65, _NARROWEST) if size == SMALL else ()))
    )
    broken = ((size, wide, _broken(text, room / wide, size)) for size, wide in tried)
    height, wide, rows = next(
        (each for each in broken if each[2] and each[0] * (_STEP * (len(each[2]) - 1) + 1.3) <= high),
        (SMALL, _NARROWEST, _cut(text, room / _NARROWEST, high)),
    )
    step, middle = _STEP * height, box.left + box.width / 2
    foot = box.bottom + box.height / 2 + step * (len(rows) - 1) / 2 - height / 2
    if angle:
        place = middle, box.bottom + box.height / 2 + height / 2
        return [Text(place, rows[0], height, "middle", angle, wide=wide)]
    return [Text((middle, foot - step * count), words, height, "middle", wide=wide) for count, words in enumerate(rows)]


def _width(text: str, height: float) -> float:
    """Return the largest width of a text in the letters of a reader. [mm]"""
    return _READERS * text_width(text, height)


def _broken(text: str, room: float, height: float) -> list[str]:
    """Return a text on rows that fit, none where a word does not."""
    rows = [""]
    for word in text.split():
        joined = f"{rows[-1]} {word}".strip()
        if _width(joined, height) <= room:
            rows[-1] = joined
        elif rows[-1] and _width(word, height) <= room:
            rows.append(word)
        else:
            return []
    return rows


def _cut(text: str, room: float, high: float) -> list[str]:
    """Return as much of a text as fits in the smallest letters, broken anywhere."""
    most = max(1, int((high - 1.3 * SMALL) / (_STEP * SMALL)) + 1)
    rows: list[str] = []
    while text and len(rows) < most:
        fits = next((end for end in range(len(text), 1, -1) if _width(text[:end], SMALL) <= room), 1)
        # between words where there is one
        blank = text.rfind(" ", 0, fits + 1)
        fits = blank if blank > 0 and fits < len(text) and len(rows) < most - 1 else fits
        rows.append(text[:fits].strip())
        text = text[fits:].strip()
    if text:
        last = rows[-1]
        while last and _width(f"{last}…", SMALL) > room:
            last = last[:-1]
        rows[-1] = f"{last}…"
    return rows


class Column(NamedTuple):
    """A column of a table: what stands over it, and what it says."""

    head: str
    cells: Sequence[str]


def numbers(values: Sequence[float], language: Language, digits: int = _DIGITS) -> list[str]:
    """Return numbers with as many decimals as give the largest that many digits, a dash for none."""
    largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
    places = max(0, digits - 1 - math.floor(math.log10(largest))) if largest else 0
    shown = [f"{value:.{places}f}" if math.isfinite(value) else "–" for value in values]
    shown = ["0" if not text.strip("-0.") else text for text in shown]
    return [decimal(text, language).replace("-", "−") for text in shown]


def table(first: Sequence[Column], columns: Sequence[Column], title: str, language: Language) -> Drawing:
    """Draw a table; `first`: the columns that every part of it begins with."""
    parts, size = next((fitting for height in _TEXT_SIZES if (fitting := _parts(first, columns, height))), None) or (
        [[*first, column] for column in columns], _TEXT_SIZES[-1]
    )  # fmt: skip
    widths = np.array([sum(_text_width(column, size) for column in part) for part in parts])
    # as wide as what stands above and below it, if that is not much wider, and with rows as tall
    wider = float(np.clip((current_layout().width - _FREE) / widths.max(), 1.0, _WIDEST))
    row, rows = _ROW * min(max(current_layout().tall, 1.0), _TALLEST), len(first[0].cells) + 1
    hand = Canvas(wider * float(widths.max()), len(parts) * (row * rows + _BETWEEN) - _BETWEEN)
    for index, part in enumerate(parts):
        _draw(
            hand, part, [wider * _text_width(item, size) for item in part], (index * (row * rows + _BETWEEN), row), size
        )
    return hand.drawing(title, language)


def _parts(first: Sequence[Column], columns: Sequence[Column], size: float) -> tuple[list[list[Column]], float] | None:
    """Return columns in parts that fit, about as many in each, or nothing where one does not."""
    room = current_layout().width - _FREE - sum(_text_width(column, size) for column in first)
    if max(_text_width(column, size) for column in columns) > room:
        return None
    count = next(parts for parts in range(1, len(columns) + 1) if all(
        sum(_text_width(column, size) for column in part) <= room for part in _divided(columns, parts)
    ))  # fmt: skip
    return [[*first, *part] for part in _divided(columns, count)], size


def _divided(columns: Sequence[Column], count: int) -> Iterator[Sequence[Column]]:
    ends = [round(len(columns) * index / count) for index in range(count + 1)]
    yield from (columns[start:end] for start, end in itertools.pairwise(ends))


def _text_width(column: Column, size: float) -> float:
    return WIDER * max(canvas_width(text, size) for text in (column.head, *column.cells)) + 2 * _PAD


def _draw(
    hand: Canvas, columns: Sequence[Column], widths: Sequence[float], place: tuple[float, float], size: float
) -> None:
    """Draw a part of a table: thick lines around it and under its head, thin ones between rows.

    `place`: its upper edge, and the height of its rows.
    """
    top, row = place
    rows, right = len(columns[0].cells) + 1, sum(widths)
    sides = np.concatenate([[0.0], np.cumsum(widths)])
    foot = top + row * rows
    levels = top + row * np.arange(rows + 1)
    thick = [(x, top, x, foot) for x in sides] + [(0.0, y, right, y) for y in levels[[0, 1, -1]]]
    hand.segments(np.array([(0.0, y, right, y) for y in levels[2:-1]]).reshape(-1, 4), width=_THIN)
    hand.segments(np.array(thick), width=_THICK)
    for column, left, width in zip(columns, sides, widths, strict=False):
        for index, text in enumerate((column.head, *column.cells)):
            hand.text(left + width / 2, levels[index] + row / 2 + 0.22 * _ROW, text, size=size, anchor="middle")


def text_block(entries: list[str], title: str, language: Language) -> Drawing:
    """Return entries in rows, as many as fit beside each other."""
    size, row = 8.5, 14.0
    # letters of a reader may be wider
    width = 0.82 * current_layout().width
    rows = [
        line
        for entry_row in flow_rows(entries, ";   ", width, partial(canvas_width, size=size))
        for line in fitted_lines(entry_row, size, width)
    ]
    hand = Canvas(current_layout().width, row * len(rows))
    for index, text in enumerate(rows):
        hand.text(0.0, row * (index + 0.7), text, size=size)
    return hand.drawing(title, language)
