"""The cover of a note in Word: a page of its own, held apart by the heights of the rows of a table without lines."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.note.document import Note, Person, TitlePage
from crankwork.note.word_xml import PAGE_BREAK, TEXT_WIDTH, cell, paragraph, text_run

# least heights of the parts of the page, head to foot: 250 of its 257 mm [twip]
_HEAD, _TITLE, _PEOPLE, _PLACE = 3200, 5700, 4200, 650
_LABEL, _SIGN, _NAME = 3000, 1500, 3200
# letters of a name that stand in one line
_SHORT = 60
_INDENT = '<w:ind w:left="60"/>'
_NONE = '<w:tblCellMar><w:left w:w="0" w:type="dxa"/><w:right w:w="0" w:type="dxa"/></w:tblCellMar>'
_STROKE = '<w:tcBorders><w:bottom w:val="single" w:sz="4" w:space="0" w:color="auto"/></w:tcBorders>'


def cover_xml(page: TitlePage, note: Note) -> Iterator[str]:
    """Yield the cover and the end of its page."""
    small = 0.62 if page.is_crowded else 1.0

    def lines(some: tuple[str, ...], size: int, *, bold: bool = False, style: str = "TitleLine") -> str:
        font = f'{"<w:b/>" if bold else ""}<w:sz w:val="{int(size * small)}"/><w:szCs w:val="{int(size * small)}"/>'
        return "".join(paragraph(text_run(one, font), style) for one in some)

    title = lines(page.above, 30) + lines((note.headline,), 40, bold=True, style="Title") + lines(page.below, 28)
    parts = [
        (_HEAD, "top", lines(page.institution, 26)),
        (_TITLE, "center", title),
        (_PEOPLE, "center", _people(page.people, int(24 * small))),
        (_PLACE, "bottom", lines((page.place,), 24)),
    ]
    rows = "".join(
        f'<w:tr><w:trPr><w:cantSplit/><w:trHeight w:val="{int(height * small**2)}" w:hRule="atLeast"/></w:trPr>'
        f"{cell(TEXT_WIDTH, content or paragraph(''), place)}</w:tr>"
        for height, place, content in parts
    )
    yield (
        f'<w:tbl><w:tblPr><w:tblW w:w="{TEXT_WIDTH}" w:type="dxa"/><w:tblLayout w:type="fixed"/>{_NONE}</w:tblPr>'
        f'<w:tblGrid><w:gridCol w:w="{TEXT_WIDTH}"/></w:tblGrid>{rows}</w:tbl>'
    )
    yield PAGE_BREAK


def _people(people: tuple[Person, ...], size: int) -> str:
    """Return who has to do with the note in the right part of the page, with a stroke for each signature."""
    if not people:
        return ""
    signs = any(one.signs for one in people)
    most = max(len(name) for one in people for name in one.names)
    name_width = _NAME if most < _SHORT else TEXT_WIDTH - _LABEL - _SIGN
    widths = [_LABEL, _SIGN, name_width] if signs else [_LABEL, name_width]
    font = f'<w:sz w:val="{size}"/><w:szCs w:val="{size}"/>'

    def entry(width: int, text: str, more: str = "") -> str:
        look = f'<w:tcW w:w="{width}" w:type="dxa"/>{more}<w:vAlign w:val="bottom"/>'
        return f"<w:tc><w:tcPr>{look}</w:tcPr>{paragraph(text_run(text, font), '', _INDENT)}</w:tc>"

    rows = ""
    for one in people:
        for k, name in enumerate(one.names):
            stroke = entry(_SIGN, "", _STROKE if one.signs else "") if signs else ""
            label = entry(_LABEL, f"{one.label}:" if k == 0 else "")
            rows += f"<w:tr><w:trPr><w:cantSplit/></w:trPr>{label}{stroke}{entry(widths[-1], name)}</w:tr>"
    grid = "".join(f'<w:gridCol w:w="{one}"/>' for one in widths)
    return (
        f'<w:tbl><w:tblPr><w:tblW w:w="{sum(widths)}" w:type="dxa"/><w:jc w:val="right"/>'
        f'<w:tblLayout w:type="fixed"/></w:tblPr><w:tblGrid>{grid}</w:tblGrid>{rows}</w:tbl>'
        # a cell ends with a paragraph
        + paragraph("", "", '<w:spacing w:before="0" w:after="0" w:line="20" w:lineRule="exact"/>')
    )
