"""Blocks of a note as WordprocessingML: text, tables and equations as elements for the body of a document."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.expressions import Expression
from crankwork.note.captions import caption, fixed_word
from crankwork.note.characters import xml_text
from crankwork.note.document import Bold, Citation, Equation, Math, Reference, Run, Runs, Table
from crankwork.note.equations import legend_rows, printed_equation
from crankwork.note.layout import Box
from crankwork.note.math import formula_box
from crankwork.note.numbering import Numbering, equation_source
from crankwork.note.omml import omml_box
from crankwork.note.symbols import symbol_box
from crankwork.quantities import Language

PREFIXES = (
    'xmlns:w="http://schemas.openxmlformats.org/wordprocessingml/2006/main" '
    'xmlns:m="http://schemas.openxmlformats.org/officeDocument/2006/math" '
    'xmlns:r="http://schemas.openxmlformats.org/officeDocument/2006/relationships"'
)
# twentieths of a point, for an A4 page upright and on its side
TEXT_WIDTH, WIDE_TEXT_WIDTH = 9638, 14570
# of a column, so that a heading fits above short numbers [twip]
_NARROWEST = 640
_MARK_WIDTH = 2150
_LEGEND = (
    '<w:tabs><w:tab w:val="left" w:pos="960"/></w:tabs><w:spacing w:after="0"/><w:ind w:left="960" w:hanging="960"/>'
)
_ALIGN = {"l": "left", "c": "center", "r": "right"}


def text_run(text: str, properties: str = "") -> str:
    """Return a run of text."""
    look = f"<w:rPr>{properties}</w:rPr>" if properties else ""
    return f'<w:r>{look}<w:t xml:space="preserve">{xml_text(text)}</w:t></w:r>'


def paragraph(content: str, style: str = "", properties: str = "") -> str:
    """Return a paragraph of runs."""
    named = f'<w:pStyle w:val="{style}"/>' if style else ""
    return f"<w:p><w:pPr>{named}{properties}</w:pPr>{content}</w:p>"


# the rest of its paragraph stands on the next page, as low as can be
PAGE_BREAK = paragraph(
    '<w:r><w:br w:type="page"/></w:r>', "", '<w:spacing w:before="0" w:after="0" w:line="20" w:lineRule="exact"/>'
)


def runs_xml(runs: Runs, numbers: Numbering, properties: str = "") -> str:
    """Return runs of a note as runs of Word.

    Parameters
    ----------
    runs : tuple of run
        What stands in the line.
    numbers : Numbering
        Numbers of what they refer to.
    properties : str
        Elements that every run of text has, such as its size.
    """
    return "".join(_run(run, numbers, properties) for run in runs)


def _run(run: Run, numbers: Numbering, properties: str) -> str:
    match run:
        case Bold(words):
            return text_run(words, "<w:b/>" + properties)
        case Math(content):
            return f"<m:oMath>{omml_box(inline_box(content, numbers.language))}</m:oMath>"
        case Reference(label):
            return text_run(numbers.reference(label), properties)
        case Citation(source):
            return text_run(numbers.citation(source), properties)
    return text_run(run, properties)


def inline_box(content: str | Expression, language: Language) -> Box:
    """Return the boxes of mathematics in a line: of a symbol, or of a recorded formula."""
    return symbol_box(content) if isinstance(content, str) else formula_box(content, None, language)


def equation_xml(block: Equation, number: str, numbers: Numbering) -> Iterator[str]:
    """Yield an equation, a table without lines: mathematics in the middle, source and number at the right."""
    printed = printed_equation(block, numbers.language)
    source = equation_source(block)
    mark = "\u2002".join(([numbers.citation(source)] if source else []) + ([f"({number})"] if number else []))
    spacing = '<w:spacing w:before="60" w:after="60" w:line="240" w:lineRule="auto"/>'
    lines = "".join(
        paragraph(
            f"<m:oMathPara><m:oMath>{omml_box(line)}</m:oMath></m:oMathPara>", "", f'{spacing}<w:jc w:val="center"/>'
        )
        for line in printed.lines
    )
    left = TEXT_WIDTH - _MARK_WIDTH
    place = "center" if len(printed.lines) == 1 else "bottom"
    right = paragraph(text_run(mark), "", f'{spacing}<w:jc w:val="right"/>')
    yield (
        f'<w:tbl><w:tblPr><w:tblW w:w="{TEXT_WIDTH}" w:type="dxa"/><w:tblLayout w:type="fixed"/>'
        '<w:tblCellMar><w:left w:w="0" w:type="dxa"/><w:right w:w="0" w:type="dxa"/></w:tblCellMar>'
        f'<w:tblDescription w:val="{xml_text(printed.text)}"/></w:tblPr>'
        f'<w:tblGrid><w:gridCol w:w="{left}"/><w:gridCol w:w="{_MARK_WIDTH}"/></w:tblGrid>'
        f"<w:tr><w:trPr><w:cantSplit/></w:trPr>{_cell(left, lines, 'center')}{_cell(_MARK_WIDTH, right, place)}</w:tr>"
        "</w:tbl>"
    )
    if not block.legend:
        # two tables without a paragraph between them would become one
        yield paragraph("", "", '<w:spacing w:before="0" w:after="0" w:line="40" w:lineRule="exact"/>')
    for where, box, words in legend_rows(block, numbers.language):
        mathematics = f"<m:oMath>{omml_box(box)}</m:oMath>"
        yield paragraph(f"{text_run(where)}<w:r><w:tab/></w:r>{mathematics}{text_run(words)}", "", _LEGEND)


def _cell(width: int, content: str, place: str) -> str:
    size = f'<w:tcW w:w="{width}" w:type="dxa"/>'
    return f'<w:tc><w:tcPr>{size}<w:vAlign w:val="{place}"/></w:tcPr>{content}</w:tc>'


def table_xml(block: Table, number: str, numbers: Numbering) -> Iterator[str]:
    """Yield the caption of a table, the table with a header on every page, and a gap after it."""
    count = len(block.headings)
    size = 20 if count <= 9 else 18 if count <= 14 else 16
    font = f'<w:sz w:val="{size}"/><w:szCs w:val="{size}"/>'
    words = caption("table", number, block.caption, numbers.language)
    yield paragraph(text_run(words), "Caption", '<w:keepNext/><w:jc w:val="left"/>')
    full = WIDE_TEXT_WIDTH if block.wide else TEXT_WIDTH
    widths = _widths(block, full, size)
    heading = "".join(
        _cell(width, paragraph(runs_xml(runs, numbers, font), "TableText", '<w:jc w:val="center"/>'), "center")
        for width, runs in zip(widths, block.headings, strict=True)
    )
    grid = "".join(f'<w:gridCol w:w="{width}"/>' for width in widths)
    borders = "".join(
        f'<w:{side} w:val="single" w:sz="4" w:space="0" w:color="auto"/>'
        for side in ("top", "left", "bottom", "right", "insideH", "insideV")
    )
    before = [
        f'<w:tc><w:p><w:pPr><w:pStyle w:val="TableText"/><w:jc w:val="{_ALIGN[letter]}"/></w:pPr>'
        f'<w:r><w:rPr>{font}</w:rPr><w:t xml:space="preserve">'
        for letter in (block.align or "r" * count)
    ]
    after = "</w:t></w:r></w:p></w:tc>"
    rows = "".join(
        "<w:tr><w:trPr><w:cantSplit/></w:trPr>"
        + "".join(f"{start}{xml_text(cell)}{after}" for start, cell in zip(before, row, strict=True))
        + "</w:tr>"
        for row in block.rows
    )
    yield (
        f'<w:tbl><w:tblPr><w:tblW w:w="{sum(widths)}" w:type="dxa"/><w:jc w:val="center"/>'
        f'<w:tblBorders>{borders}</w:tblBorders><w:tblLayout w:type="fixed"/>'
        '<w:tblCellMar><w:left w:w="60" w:type="dxa"/><w:right w:w="60" w:type="dxa"/></w:tblCellMar>'
        f'<w:tblCaption w:val="{xml_text(words)}"/></w:tblPr>'
        f"<w:tblGrid>{grid}</w:tblGrid>"
        f"<w:tr><w:trPr><w:cantSplit/><w:tblHeader/></w:trPr>{heading}</w:tr>{rows}</w:tbl>"
    )
    yield paragraph("", "", '<w:spacing w:before="0" w:after="0"/>')


def _widths(block: Table, full: int, size: int) -> list[int]:
    """Return the widths of the columns: as wide as their entries, and together no wider than the text. [twip]"""
    longest = [max(map(len, column), default=0) for column in zip(*block.rows, strict=True)] or [0] * len(
        block.headings
    )
    wanted = [max(_NARROWEST, round(5.6 * size * length) + 140) for length in longest]
    room = full - sum(min(one, _NARROWEST) for one in wanted)
    excess = sum(one - min(one, _NARROWEST) for one in wanted)
    share = min(1.0, room / excess) if excess > 0 else 1.0
    if room < 0:
        return [full // len(wanted)] * len(wanted)
    return [round(_NARROWEST + share * (one - _NARROWEST)) for one in wanted]


def contents_xml(headings: list[tuple[int, str]], language: Language) -> Iterator[str]:
    """Yield the list of sections as a field of Word, filled with the sections; Word adds the pages when it updates it.

    Parameters
    ----------
    headings : list of tuple
        Level and text of every heading; their bookmarks are numbered in this order.
    language : str
        Language of the title.
    """
    yield paragraph(text_run(fixed_word("contents", language)), "ContentsTitle")
    begin = (
        '<w:r><w:fldChar w:fldCharType="begin" w:dirty="true"/></w:r>'
        '<w:r><w:instrText xml:space="preserve"> TOC \\o "1-2" \\h \\z \\u </w:instrText></w:r>'
        '<w:r><w:fldChar w:fldCharType="separate"/></w:r>'
    )
    end = '<w:r><w:fldChar w:fldCharType="end"/></w:r>'
    shown = [(k, level, text) for k, (level, text) in enumerate(headings) if level <= 2]
    for k, level, text in shown:
        link = f'<w:hyperlink w:anchor="{bookmark(k)}">{text_run(text)}<w:r><w:tab/></w:r>{_page(k)}</w:hyperlink>'
        start = begin if k == shown[0][0] else ""
        yield paragraph(f"{start}{link}{end if k == shown[-1][0] else ''}", f"TOC{level}")
    if not shown:
        yield paragraph(begin + end)


def _page(k: int) -> str:
    """Return a field with the page of a heading, which Word fills in."""
    return (
        '<w:r><w:fldChar w:fldCharType="begin" w:dirty="true"/></w:r>'
        f'<w:r><w:instrText xml:space="preserve"> PAGEREF {bookmark(k)} \\h </w:instrText></w:r>'
        '<w:r><w:fldChar w:fldCharType="end"/></w:r>'
    )


def bookmark(k: int) -> str:
    """Return the name of the bookmark at the k-th heading."""
    return f"_Toc{k + 1:08d}"


def heading_xml(level: int, text: str, k: int) -> str:
    """Return the k-th heading with its bookmark."""
    start = f'<w:bookmarkStart w:id="{k}" w:name="{bookmark(k)}"/>'
    return paragraph(f'{start}{text_run(text)}<w:bookmarkEnd w:id="{k}"/>', f"Heading{level}")
