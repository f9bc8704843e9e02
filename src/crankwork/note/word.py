"""Notes as Word files: their blocks, the order of their figures, styles and pages.

The heights of blocks are estimated; where that is wrong a figure stands a little earlier or later.
"""

from __future__ import annotations

import datetime as dt
import io
import math
import zipfile
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from crankwork.errors import MissingExtraError
from crankwork.locale import ErrorMessage
from crankwork.note.captions import LANGUAGE_TAGS, caption
from crankwork.note.document import (
    Bibliography,
    Block,
    Contents,
    Equation,
    Figure,
    Heading,
    ItemList,
    Math,
    Note,
    PageBreak,
    Paragraph,
    Runs,
    Table,
    TitlePage,
    plain_text,
    side_by_side,
)
from crankwork.note.equations import printed_equation
from crankwork.note.layout import Apply, Box, Fence, Fraction, Marked, Root, Row, Script
from crankwork.note.numbering import LINE, Numbering, flow, numbering
from crankwork.note.word_parts import (
    EQUATION_WIDTH,
    PAGE_BREAK,
    PREFIXES,
    Columns,
    contents_xml,
    cover_xml,
    equation_xml,
    figure_xml,
    heading_xml,
    pair_xml,
    paragraph,
    readable,
    runs_xml,
    table_columns,
    table_xml,
    text_run,
)
from crankwork.quantities import Language
from crankwork.show.canvas import MM
from crankwork.show.formats import pngs
from crankwork.show.scene import CAP_HEIGHT, text_width
from crankwork.show.svg import svg
from crankwork.sources import cite

if TYPE_CHECKING:
    from docx.document import Document
    from docx.section import Section


_EPOCH = dt.datetime(2000, 1, 1, tzinfo=dt.UTC)
_ZIP_TIME = (1980, 1, 1, 0, 0, 0)
_PIXELS_PER_INCH = 110.0
# width of the text of a page [pt]
_WIDTH = 481.0
# lines of text and of mathematics; what a line of a legend and a fraction have more; what stands after a paragraph [pt]
_MATHS, _HIGHER, _AFTER = 16.4, 12.0, 6.0
_CAPTION = 17.0 + LINE
# by how much the heights may be wrong
_OFF = 0.03
_HEADINGS = {1: 46.0, 2: 37.0, 3: 33.0}
_SIZE = 12.0
# before the words of a legend and of an item [pt]; as wide as a symbol in the line, about
_ITEM, _SYMBOL = 21.0, 6 * "x"
_FONT = "Times New Roman"
_WORD = "http://schemas.openxmlformats.org/wordprocessingml/2006/main"
_CENTRE, _LEFT, _BOTH = "center", "left", "both"
FOOTER = (
    '<w:p><w:pPr><w:jc w:val="center"/></w:pPr><w:r><w:fldChar w:fldCharType="begin"/></w:r>'
    '<w:r><w:instrText xml:space="preserve"> PAGE </w:instrText></w:r><w:r><w:fldChar w:fldCharType="end"/></w:r></w:p>'
)
# identifier: name, size in half points, bold, alignment, space before and after in twentieths of a point, further
_STYLES = {
    "Normal": ("Normal", 24, False, _LEFT, 0, 80, ""),
    "BodyText": ("Body Text", 24, False, _BOTH, 0, 120, ""),
    "Heading1": ("heading 1", 30, True, _LEFT, 360, 160, "<w:keepNext/><w:keepLines/>"),
    "Heading2": ("heading 2", 26, True, _LEFT, 280, 120, "<w:keepNext/><w:keepLines/>"),
    "Heading3": ("heading 3", 24, True, _LEFT, 240, 100, "<w:keepNext/><w:keepLines/>"),
    "Title": ("Title", 40, True, _CENTRE, 240, 240, ""),
    "Subtitle": ("Subtitle", 28, False, _CENTRE, 0, 240, ""),
    "TitleLine": ("Title Line", 24, False, _CENTRE, 0, 80, ""),
    "Caption": ("caption", 24, False, _CENTRE, 120, 120, ""),
    "Drawing": ("Drawing", 24, False, _CENTRE, 160, 0, "<w:keepNext/>"),
    "TableText": ("Table Text", 20, False, _LEFT, 0, 0, ""),
    "ContentsTitle": ("Contents Title", 30, True, _LEFT, 240, 160, "<w:keepNext/>"),
    "Item": ("Item", 24, False, _BOTH, 0, 60, ""),
    "TOC1": ("toc 1", 24, False, _LEFT, 0, 60, ""),
    "TOC2": ("toc 2", 24, False, _LEFT, 0, 60, ""),
}
_TABS = '<w:tabs><w:tab w:val="right" w:leader="dot" w:pos="9638"/></w:tabs>'
_PLACES = {
    "Item": ("", '<w:ind w:left="425" w:hanging="425"/>'),
    "TOC1": (_TABS, ""),
    "TOC2": (_TABS, '<w:ind w:left="240"/>'),
}
_LEVELS = {"Heading1": 0, "Heading2": 1, "Heading3": 2}
_TIGHT = ("TableText", "TitleLine")


def word(note: Note) -> bytes:
    """Return a note as a Word file."""
    try:
        import docx  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError(ErrorMessage("extra_writing", names="DOCX"), "report") from None
    note = replace(note, blocks=tuple(readable(note.blocks, numbering(note))))
    numbers = numbering(note)
    document = docx.Document()
    _set_properties(document, note)
    set_styles(document, note.language)
    writer = _Writer(document, note, numbers)
    set_pages(document.sections[0], wide=False)
    document.sections[0].different_first_page_header_footer = any(isinstance(block, TitlePage) for block in note.blocks)
    writer.footer()
    writer.write()
    stream = io.BytesIO()
    document.save(stream)
    return _reproducible(stream.getvalue())


class _Writer:
    """Adds blocks to a document; knows whether the page is on its side and how many headings there were."""

    def __init__(self, document: Document, note: Note, numbers: Numbering) -> None:
        self._document = document
        self._note = note
        self._numbers = numbers
        self._wide = False
        self._headings = 0
        self._figures = 0
        self._pictures = _pictures(note)
        self._printed = {
            id(block): printed_equation(block, note.language, EQUATION_WIDTH)
            for block in note.blocks
            if isinstance(block, Equation)
        }
        self._columns = {id(block): table_columns(block, numbers) for block in note.blocks if isinstance(block, Table)}

    def write(self) -> None:
        """Add the blocks of the note, figures where they fit."""
        blocks, rows = self._note.blocks, list(side_by_side(self._note.blocks))
        headings = len(_headings(self._note, self._numbers))
        # a line stands below blocks side by side
        heights = [max(self._height(blocks[k], headings) for k in row) + LINE * (len(row) > 1) for row in rows]
        for number in flow([blocks[row[0]] for row in rows], heights, _OFF):
            first = blocks[rows[number][0]]
            self.turn(wide=isinstance(first, Table) and first.wide)
            parts = [self._xml(blocks[k], self._numbers.blocks[k]) for k in rows[number]]
            body = self._document.element.body
            place = "bottom" if all(isinstance(blocks[k], Figure) for k in rows[number]) else "top"
            for xml in parts[0] if len(parts) == 1 else pair_xml(parts[0], parts[-1], place):
                body.insert(len(body) - 1, _element(xml))

    def _height(self, block: Block, headings: int) -> float:
        match block:
            case Equation():
                return equation_height(self._printed[id(block)].lines)
            case Table():
                return table_height(block, self._columns[id(block)])
        return block_height(block, headings, self._numbers.sources)

    def footer(self) -> None:
        footer = self._document.sections[0].footer
        footer.is_linked_to_previous = False
        footer.paragraphs[0]._p.getparent().replace(footer.paragraphs[0]._p, _element(FOOTER))  # noqa: SLF001

    def turn(self, *, wide: bool) -> None:
        """Begin a page of the other orientation if the next block needs it."""
        if wide == self._wide:
            return
        body = self._document.element.body
        section = self._document.add_section() if len(body) > 1 else self._document.sections[0]
        section.different_first_page_header_footer = False
        set_pages(section, wide=wide)
        self._wide = wide

    def _xml(self, block: Block, number: str) -> Iterator[str]:  # noqa: C901 - one case per kind of block
        numbers, note = self._numbers, self._note
        match block:
            case Heading(level, words):
                yield heading_xml(level, f"{number} {words}".strip(), self._headings)
                self._headings += 1
            case Paragraph(runs):
                yield paragraph(runs_xml(runs, numbers), "BodyText")
            case Equation():
                yield from equation_xml(block, number, numbers, self._printed[id(block)])
            case Figure():
                yield from self._figure(block, number)
            case Table():
                yield from table_xml(block, number, numbers, self._columns[id(block)])
            case ItemList(items):
                for item in items:
                    yield _item("–", runs_xml(item, numbers))
            case PageBreak():
                yield PAGE_BREAK
            case Contents():
                yield from contents_xml(_headings(note, numbers), note.language)
            case TitlePage():
                yield from cover_xml(block, note)
            case Bibliography():
                for key, k in numbers.sources.items():
                    yield _item(f"{k}.", text_run(cite(key)))

    def _figure(self, block: Figure, number: str) -> Iterator[str]:
        from docx.opc.constants import RELATIONSHIP_TYPE  # noqa: PLC0415 - an optional part
        from docx.opc.packuri import PackURI  # noqa: PLC0415
        from docx.opc.part import Part  # noqa: PLC0415

        self._figures += 1
        part, (drawn, picture) = self._document.part, self._pictures[id(block)]
        lines = Part(PackURI(f"/word/media/drawing{self._figures}.svg"), "image/svg+xml", drawn, part.package)
        relations = part.get_or_add_image(io.BytesIO(picture))[0], part.relate_to(lines, RELATIONSHIP_TYPE.IMAGE)
        words = caption("figure", number, block.caption, self._note.language)
        return figure_xml(block, words, self._figures, *relations)


def _pictures(note: Note) -> dict[int, tuple[bytes, bytes]]:
    """Return figures as lines and as pixels, those of one size made at once."""
    sizes: dict[tuple[float, float], list[Figure]] = defaultdict(list)
    for block in note.blocks:
        if isinstance(block, Figure):
            sizes[block.drawing.width, block.drawing.height].append(block)
    made: dict[int, tuple[bytes, bytes]] = {}
    for figures in sizes.values():
        drawn = [svg(figure.drawing) for figure in figures]
        pictures = pngs([figure.drawing for figure in figures], "print", _PIXELS_PER_INCH, drawn)
        made |= {id(figure): pair for figure, pair in zip(figures, zip(drawn, pictures, strict=True), strict=True)}
    return made


def _element(xml: str) -> Any:  # noqa: ANN401 - an element of lxml, which has no types
    from docx.oxml import parse_xml  # noqa: PLC0415 - an optional part

    name, _, rest = xml.partition(">") if xml.find(" ") < 0 or xml.find(">") < xml.find(" ") else xml.partition(" ")
    return parse_xml(f"{name} {PREFIXES}{'>' if xml[len(name)] == '>' else ' '}{rest}")


def _headings(note: Note, numbers: Numbering) -> list[tuple[int, str]]:
    return [
        (block.level, f"{number} {block.text}".strip())
        for block, number in zip(note.blocks, numbers.blocks, strict=True)
        if isinstance(block, Heading)
    ]


def _item(mark: str, content: str) -> str:
    return paragraph(f"{text_run(mark)}<w:r><w:tab/></w:r>{content}", "Item")


def _set_properties(document: Document, note: Note) -> None:
    """Set title, authors and language, and dates that do not depend on when the file is written."""
    properties = document.core_properties
    when = dt.datetime(note.date.year, note.date.month, note.date.day, tzinfo=dt.UTC) if note.date else _EPOCH
    properties.title = plain_text(note.title)[:255]
    properties.author = plain_text(", ".join(note.authors))[:255]
    properties.last_modified_by = ""
    properties.comments = plain_text(note.provenance)[:255]
    properties.language = LANGUAGE_TAGS[note.language]
    properties.created = properties.modified = when
    properties.revision = 1


def _reproducible(data: bytes) -> bytes:
    """Return a zip file with the same members, none of which says when it was written."""
    stream = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as new:
        for name in old.namelist():
            entry = zipfile.ZipInfo(name, _ZIP_TIME)
            entry.compress_type = zipfile.ZIP_STORED if name.endswith(".png") else zipfile.ZIP_DEFLATED
            new.writestr(entry, old.read(name))
    return stream.getvalue()


def equation_height(lines: Sequence[Row]) -> float:
    """Return about how high the lines of an equation are. [pt]"""
    return sum(_MATHS + _HIGHER * (_high(row) - 1.0) for row in lines) + 2.0


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
    return rows + (2.4 + 1.2 * tall) * size + _CAPTION + 0.7 * LINE


def block_height(block: Block, headings: int, sources: Iterable[str]) -> float:
    """Return about how high another block is; `headings`, `sources`: how many the note has, what it cites. [pt]"""
    match block:
        case Heading(level):
            return _HEADINGS[min(level, 3)]
        case Paragraph(runs):
            return LINE * _lines(runs) + _AFTER
        case Figure(drawing=drawing):
            return drawing.height / drawing.width * min(block.width / MM, _WIDTH) + _CAPTION
        case ItemList(items):
            return sum(LINE * _lines(item, _WIDTH - _ITEM) + 3 for item in items)
        case Contents():
            return _HEADINGS[1] + (LINE + 3) * headings
        case Bibliography():
            return sum(LINE * _lines((cite(source),), _WIDTH - _ITEM) + 3 for source in sources)
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
        case Marked(inside):
            return _high(inside) + 0.2
        case _:
            return 1.0


def set_styles(document: Document, language: Language) -> None:
    """Give a document the styles of a note and its language."""
    from docx.oxml import parse_xml  # noqa: PLC0415 - an optional part

    styles: Any = document.styles.element
    tag = LANGUAGE_TAGS[language]
    for name in _STYLES:
        for old in styles.xpath(f'w:style[@w:styleId="{name}"]'):
            styles.remove(old)
        styles.append(parse_xml(_style(name)))
    defaults = styles.xpath("w:docDefaults/w:rPrDefault/w:rPr")[0]
    for old in defaults.xpath("w:lang|w:rFonts"):
        defaults.remove(old)
    defaults.insert(0, parse_xml(f'<w:rFonts xmlns:w="{_WORD}" {_fonts()}/>'))
    defaults.append(parse_xml(f'<w:lang xmlns:w="{_WORD}" w:val="{tag}" w:eastAsia="{tag}" w:bidi="ar-SA"/>'))


def _fonts() -> str:
    return " ".join(f'w:{kind}="{_FONT}"' for kind in ("ascii", "hAnsi", "eastAsia", "cs"))


def _style(key: str) -> str:
    name, size, bold, align, before, after, keep = _STYLES[key]
    tabs, indent = _PLACES.get(key, ("", ""))
    level = f'<w:outlineLvl w:val="{_LEVELS[key]}"/>' if key in _LEVELS else ""
    line = 240 if key in _TIGHT else 276
    default = ' w:default="1"' if key == "Normal" else ""
    based = "" if key == "Normal" else '<w:basedOn w:val="Normal"/>'
    following = '<w:next w:val="BodyText"/>' if key in _LEVELS else ""
    return (
        f'<w:style xmlns:w="{_WORD}" w:type="paragraph"{default} w:styleId="{key}"><w:name w:val="{name}"/>{based}'
        f"{following}<w:qFormat/><w:pPr>{keep}{tabs}"
        f'<w:spacing w:before="{before}" w:after="{after}" w:line="{line}" w:lineRule="auto"/>'
        f'{indent}<w:jc w:val="{align}"/>{level}</w:pPr>'
        f'<w:rPr><w:rFonts {_fonts()}/>{"<w:b/>" if bold else ""}<w:color w:val="000000"/>'
        f'<w:sz w:val="{size}"/><w:szCs w:val="{size}"/></w:rPr></w:style>'
    )


def set_pages(section: Section, *, wide: bool) -> None:
    """Make the pages of a section A4, upright or on their side, with margins of 25, 15 and 20 mm."""
    from docx.enum.section import WD_ORIENT  # noqa: PLC0415 - an optional part
    from docx.shared import Mm  # noqa: PLC0415

    section.orientation = WD_ORIENT.LANDSCAPE if wide else WD_ORIENT.PORTRAIT
    section.page_width, section.page_height = (Mm(297), Mm(210)) if wide else (Mm(210), Mm(297))
    section.left_margin, section.right_margin = (Mm(20), Mm(20)) if wide else (Mm(25), Mm(15))
    section.top_margin, section.bottom_margin = (Mm(25), Mm(15)) if wide else (Mm(20), Mm(20))
