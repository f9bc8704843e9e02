"""Title blocks in the lower right corner: form 1 of GOST 2.104, a student's of TCVN 3821, and that of ISO 7200."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import NamedTuple

from crankwork.locale import Language, translate
from crankwork.machine import Document
from crankwork.note.captions import printed_date
from crankwork.show.scene import (
    SMALL,
    TEXT,
    TITLE,
    ChartBox,
    Item,
    Text,
    line,
    literal,
    printable,
    rectangle,
    text_width,
)

_SIZES: dict[Language, tuple[float, float]] = {"ru": (185.0, 55.0), "vi": (185.0, 55.0), "en": (180.0, 36.0)}
_HEIGHTS = (10.0, 7.0, TITLE, TEXT, SMALL)
_LONGEST = 300
# letters of a reader may be wider than our table has them; letters may be set narrower; from row to row, in heights
_READERS, _NARROWEST, _STEP = 1.15, 0.55, 1.6


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
        (candidate for candidate in broken if candidate[2] and _tall(candidate[2], candidate[0]) <= high),
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


def _tall(rows: list[str], height: float) -> float:
    return _STEP * height * (len(rows) - 1) + 1.3 * height


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
