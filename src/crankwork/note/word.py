"""A note as a Word file: styles, equations, tables and figures that can be edited there, the same bytes every time."""

from __future__ import annotations

import datetime as dt
import io
import zipfile
from collections import defaultdict
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from crankwork.errors import MissingExtraError
from crankwork.locale import Refusal
from crankwork.note.captions import LANGUAGE_TAGS, caption
from crankwork.note.characters import plain_text
from crankwork.note.document import (
    Bibliography,
    Block,
    Contents,
    Equation,
    Figure,
    Heading,
    ItemList,
    Note,
    PageBreak,
    Paragraph,
    Table,
    TitlePage,
)
from crankwork.note.equations import printed_equation
from crankwork.note.numbering import Numbering, numbering
from crankwork.note.word_flow import block_height, equation_height, flow, table_height
from crankwork.note.word_parts import (
    EQUATION_WIDTH,
    PAGE_BREAK,
    PREFIXES,
    contents_xml,
    cover_xml,
    equation_xml,
    figure_xml,
    heading_xml,
    paragraph,
    runs_xml,
    table_columns,
    table_xml,
    text_run,
)
from crankwork.note.word_styles import FOOTER, set_pages, set_styles
from crankwork.show.pdf import pngs
from crankwork.show.svg import svg
from crankwork.sources import cite

if TYPE_CHECKING:
    from docx.document import Document

_EPOCH = dt.datetime(2000, 1, 1, tzinfo=dt.UTC)
_ZIP_TIME = (1980, 1, 1, 0, 0, 0)
_PIXELS_PER_INCH = 110.0


def word(note: Note) -> bytes:
    """Return a note as a Word file."""
    try:
        import docx  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError(Refusal("extra_writing", names="DOCX"), "report") from None
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
        blocks = self._note.blocks
        headings = len(_headings(self._note, self._numbers))
        for k in flow(blocks, [self._height(item, headings) for item in blocks]):
            block = blocks[k]
            self.turn(wide=isinstance(block, Table) and block.wide)
            self.block(block, self._numbers.blocks[k])

    def _height(self, block: Block, headings: int) -> float:
        match block:
            case Equation():
                return equation_height(block, self._printed[id(block)].lines, self._note.language)
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

    def block(self, block: Block, number: str) -> None:
        """Add a block."""
        if isinstance(block, Figure):
            self._figure(block, number)
            return
        body = self._document.element.body
        for xml in self._xml(block, number):
            body.insert(len(body) - 1, _element(xml))

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

    def _figure(self, block: Figure, number: str) -> None:
        from docx.opc.constants import RELATIONSHIP_TYPE  # noqa: PLC0415 - an optional part
        from docx.opc.packuri import PackURI  # noqa: PLC0415
        from docx.opc.part import Part  # noqa: PLC0415

        self._figures += 1
        part, (drawn, picture) = self._document.part, self._pictures[id(block)]
        lines = Part(PackURI(f"/word/media/drawing{self._figures}.svg"), "image/svg+xml", drawn, part.package)
        relations = part.get_or_add_image(io.BytesIO(picture))[0], part.relate_to(lines, RELATIONSHIP_TYPE.IMAGE)
        words = caption("figure", number, block.caption, self._note.language)
        body = self._document.element.body
        for xml in figure_xml(block, words, self._figures, *relations):
            body.insert(len(body) - 1, _element(xml))


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
