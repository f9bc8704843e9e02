"""Blocks of a note as WordprocessingML: text, tables and equations that can be edited, for the body of a document."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from crankwork.formula.calculation_lines import FormulaLine
from crankwork.formula.expression import Expression
from crankwork.locale import translate
from crankwork.note.captions import caption
from crankwork.note.document import (
    Block,
    Bold,
    Cell,
    Equation,
    Figure,
    Math,
    Note,
    Person,
    Run,
    Runs,
    Strong,
    Table,
    TitlePage,
    cell_length,
    side_by_side,
    xml_text,
)
from crankwork.note.equations import formula_of
from crankwork.note.layout import (
    Apply,
    Box,
    Digits,
    Fence,
    Fraction,
    Letter,
    Marked,
    PrintedEquation,
    Root,
    Row,
    Script,
    Sign,
    Upright,
)
from crankwork.note.layout import width as box_width
from crankwork.note.math import formula_box
from crankwork.note.numbering import Numbering, is_whole
from crankwork.note.symbols import symbol_box
from crankwork.quantities import Language

PREFIXES = (
    'xmlns:w="http://schemas.openxmlformats.org/wordprocessingml/2006/main" '
    'xmlns:m="http://schemas.openxmlformats.org/officeDocument/2006/math" '
    'xmlns:r="http://schemas.openxmlformats.org/officeDocument/2006/relationships"'
)
# of a column, and the room beside its text [twip]
_NARROWEST, _SIDES = 640, 140
# how wide a digit and a letter are for every half point of their size, and an em of mathematics, in a wide font: what
# stands in for Times New Roman elsewhere is no wider [twip]
_DIGIT, _BOLD, _LETTER, _EM = 6.6, 7.2, 7.4, 12
# of a line of an equation in Cambria Math, whose digits are wider than those of the PDF [em]
EQUATION_WIDTH = 26.0
# of the text of tables, tried in turn [half pt]
_SIZES = (20, 18)
# height of a row of one line, for every half point [pt]
_ROW_HEIGHT = 0.6
# of source and number, at least; of a letter of them [twip]
_MARK_WIDTH, _MARK = 2150, 122
_CELL_STYLE = '<w:pStyle w:val="TableText"/>'
# rows that stay with the heading of their table; LibreOffice loses the others where one alone ends a page
_TOGETHER = 2
_ALIGN = {"l": "left", "c": "center", "r": "right"}
_FONT = '<w:rPr><w:rFonts w:ascii="Cambria Math" w:hAnsi="Cambria Math" w:cs="Cambria Math"/></w:rPr>'
# normal text keeps a decimal comma tight, where mathematics would put a space after it
# a parenthesis whose partner stands on another line is literal, or a reader of formulas looks for the partner
_STYLES = {"letter": '<m:sty m:val="i"/>', "upright": '<m:sty m:val="p"/>', "text": "<m:nor/>",
           "bold": '<m:sty m:val="b"/>',
           "literal": '<m:lit/><m:sty m:val="p"/>'}  # fmt: skip


def runs_xml(runs: Runs, numbers: Numbering, properties: str = "") -> str:
    """Return runs of a note as runs of Word."""
    return "".join(_run(run, numbers, properties) for run in runs)


def _run(run: Run, numbers: Numbering, properties: str) -> str:
    if isinstance(run, Math):
        boxes = omml_box(inline_box(run.content, numbers.language)).replace("</w:rPr>", f"{properties}</w:rPr>")
        return f"<m:oMath>{boxes}</m:oMath>"
    return text_run(numbers.words(run), "<w:b/>" + properties if isinstance(run, Bold | Strong) else properties)


def inline_box(content: str | Expression | FormulaLine, language: Language) -> Box:
    """Return the boxes of mathematics in a line: of a symbol, or of a recorded formula."""
    if isinstance(content, FormulaLine):
        return formula_of(content, language)
    return symbol_box(content) if isinstance(content, str) else formula_box(content, None, language)


def equation_xml(block: Equation, number: str, numbers: Numbering, printed: PrintedEquation) -> Iterator[str]:
    """Yield an equation, a table without lines: mathematics in the middle, source and number at the right."""
    mark = numbers.mark(block, number)
    spacing = '<w:spacing w:before="60" w:after="60" w:line="240" w:lineRule="auto"/>'
    lines = "".join(
        paragraph(
            f"<m:oMathPara><m:oMath>{omml_box(line)}</m:oMath></m:oMathPara>", "", f'{spacing}<w:jc w:val="center"/>'
        )
        for line in printed.lines
    )
    marked = max(_MARK_WIDTH, _MARK * len(mark))
    left = TEXT_WIDTH - marked
    place = "center" if len(printed.lines) == 1 else "bottom"
    right = paragraph(text_run(mark), "", f'{spacing}<w:jc w:val="right"/>')
    yield (
        f'<w:tbl><w:tblPr><w:tblW w:w="{TEXT_WIDTH}" w:type="dxa"/><w:tblLayout w:type="fixed"/>'
        '<w:tblCellMar><w:left w:w="0" w:type="dxa"/><w:right w:w="0" w:type="dxa"/></w:tblCellMar>'
        f'<w:tblDescription w:val="{xml_text(printed.text)}"/></w:tblPr>'
        f'<w:tblGrid><w:gridCol w:w="{left}"/><w:gridCol w:w="{marked}"/></w:tblGrid>'
        f"<w:tr><w:trPr><w:cantSplit/></w:trPr>{cell(left, lines, 'center')}{cell(marked, right, place)}</w:tr>"
        "</w:tbl>"
    )
    # two tables without a paragraph between them would become one
    yield paragraph("", "", '<w:spacing w:before="0" w:after="0" w:line="40" w:lineRule="exact"/>')


def pair_xml(left: Iterable[str], right: Iterable[str], place: str = "top") -> Iterator[str]:
    """Yield the paragraphs of two blocks side by side, the lower one at the top or the bottom of the other."""
    half = TEXT_WIDTH // 2
    yield (
        f'<w:tbl><w:tblPr><w:tblW w:w="{TEXT_WIDTH}" w:type="dxa"/><w:tblLayout w:type="fixed"/>{_NONE}</w:tblPr>'
        f'<w:tblGrid>{2 * f"""<w:gridCol w:w="{half}"/>"""}</w:tblGrid><w:tr><w:trPr><w:cantSplit/></w:trPr>'
        f"{''.join(cell(half, ''.join(part), place) for part in (left, right))}</w:tr></w:tbl>"
    )
    yield paragraph("", "", '<w:spacing w:before="0" w:after="0"/>')


def table_xml(block: Table, number: str, numbers: Numbering, columns: Columns) -> Iterator[str]:
    """Yield the caption of a table, the table with a header on every page, and a gap after it."""
    size, widths, row_height, _ = columns
    # a short table stays on one page
    together = len(block.rows) - 1 if is_whole(block) else _TOGETHER
    font = f'<w:sz w:val="{size}"/><w:szCs w:val="{size}"/>'
    words = caption("table", number, block.caption, numbers.language)
    yield paragraph(text_run(words), "Caption", '<w:keepNext/><w:jc w:val="left"/>')
    heading = "".join(
        cell(
            width,
            paragraph(runs_xml(runs, numbers, font), "TableText", '<w:keepNext/><w:jc w:val="center"/>'),
            "center",
        )
        for width, runs in zip(widths, block.headings, strict=True)
    )
    grid = "".join(f'<w:gridCol w:w="{width}"/>' for width in widths)
    borders = "".join(
        f'<w:{side} w:val="single" w:sz="{size}" w:space="0" w:color="{colour}"/>'
        for side, size, colour in (("top", 6, "auto"), ("bottom", 4, "B0B0B0"), ("insideH", 4, "B0B0B0"))
    )
    aligned = [f'<w:jc w:val="{_ALIGN[letter]}"/></w:pPr>' for letter in (block.align or "r" * len(widths))]
    starts = [f"<w:tc><w:p><w:pPr>{_CELL_STYLE}" + keep for keep in ("", "<w:keepNext/>")]
    free, kept = ([start + kind for kind in aligned] for start in starts)
    # rows as high as they are counted on to be, whatever font stands in for that of the note
    high = f'<w:trHeight w:val="{round(20 * row_height)}" w:hRule="exact"/>' if row_height else ""
    rows = "".join(
        f"<w:tr><w:trPr><w:cantSplit/>{high}</w:trPr>"
        + "".join(
            f"{start}{_run(cell, numbers, font)}</w:p></w:tc>"
            for start, cell in zip(kept if k < together else free, row, strict=True)
        )
        + "</w:tr>"
        for k, row in enumerate(block.rows)
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


def readable(blocks: Sequence[Block], numbers: Numbering) -> Iterator[Block]:
    """Yield blocks, a table with too many columns for letters of a size that is read as several.

    One that is too wide for half a page stands below what would stand beside it.
    """
    for places in side_by_side(blocks):
        row = [blocks[place] for place in places]
        wide = [block for block in row if isinstance(block, Table) and not table_columns(block, numbers).fits]
        if not wide:
            yield from row
        elif len(row) > 1:
            blocks_below = [replace(part, half=False) for part in row if isinstance(part, Figure | Table)]
            yield from readable(blocks_below, numbers)
        else:
            yield from _divided(wide[0], numbers)


def _divided(table: Table, numbers: Numbering) -> Iterator[Block]:
    """Yield a table with the parts below each other that stand side by side, or with some of its columns in another."""
    count, align = len(table.headings), table.align or "r" * len(table.headings)
    for parts in (3, 2):
        wide = count // parts
        if table.headings == parts * table.headings[:wide]:
            pieces = [row[k : k + wide] for k in range(0, count, wide) for row in table.rows]
            rows = [piece for piece in pieces if any(piece)]
            yield replace(table, headings=table.headings[:wide], rows=rows, align=align[:wide])
            return
    first = max(1, len(align) - len(align.lstrip("c")))
    half = (count + first + 1) // 2
    if not first < half < count:
        yield table
        return
    for places in ((*range(half),), (*range(first), *range(half, count))):
        part = replace(table, headings=tuple(table.headings[place] for place in places),
                       rows=[tuple(row[place] for place in places) for row in table.rows],
                       align="".join(align[place] for place in places))  # fmt: skip
        if places[-1] == count - 1:
            part = replace(part, caption="", label="")
        yield from readable([part], numbers)


class Columns(NamedTuple):
    """Size of the text of a table [half pt], widths of its columns [twip], height of a row [pt], 0 if they differ."""

    size: int
    widths: list[int]
    row_height: float
    fits: bool = True  # Whether no word of it is divided


def table_columns(block: Table, numbers: Numbering) -> Columns:
    """Return the columns of a table, together no wider than the text.

    A column is as wide as its entries, but no narrower than a word of them or of its heading.
    """
    full = WIDE_TEXT_WIDTH if block.wide else HALF_TEXT_WIDTH if block.half else TEXT_WIDTH
    columns = list(zip(*block.rows, strict=True)) or [()] * len(block.headings)
    words = [max(map(_word_width, column), default=0.0) for column in columns]
    entries = [max(*map(_entry_width, column), word) if column else 0.0
               for column, word in zip(columns, words, strict=True)]  # fmt: skip
    size, least = _SIZES[0], [0]
    for size in _SIZES:
        headings = [_heading_width(runs, numbers, size) for runs in block.headings]
        least = [
            round(max(_NARROWEST * size / _SIZES[0], heading + _SIDES, size * word + _SIDES))
            for heading, word in zip(headings, words, strict=True)
        ]
        if sum(least) <= full:
            break
    else:
        return Columns(size, [part * full // sum(least) for part in least], 0.0, fits=False)
    wanted = [max(part, round(size * entry) + _SIDES) for part, entry in zip(least, entries, strict=True)]
    excess = sum(wanted) - sum(least)
    share = min(1.0, (full - sum(least)) / excess) if excess else 1.0
    is_even = share == 1.0 and all(isinstance(cell, str) and " " not in cell for row in block.rows for cell in row)
    widths = [int(part + share * (most - part)) for part, most in zip(least, wanted, strict=True)]
    return Columns(size, widths, _ROW_HEIGHT * size if is_even else 0.0)


def _word_width(cell: Cell) -> float:
    """Return the width of the longest word of a cell, or of its symbol, for every half point of its size. [twip]"""
    if isinstance(cell, Math | Strong):
        return _entry_width(cell)
    return max((_letters_width(word) for word in cell.split()), default=0.0)


def _entry_width(cell: Cell) -> float:
    return (_BOLD if isinstance(cell, Strong) else _DIGIT) * cell_length(cell)


def _letters_width(word: str) -> float:
    return (_LETTER if word.isalpha() else _DIGIT) * len(word)


def _heading_width(runs: Runs, numbers: Numbering, size: int) -> float:
    """Return the width of the widest word of a heading. [twip]"""
    widths = [0.0]
    for run in runs:
        if isinstance(run, Math):
            widths[-1] += _EM * size * box_width(inline_box(run.content, numbers.language))
            continue
        first, *further = (size * _letters_width(word) for word in numbers.words(run).split(" "))
        widths[-1] += first
        widths += further
    return max(widths)


def contents_xml(headings: list[tuple[int, str]], language: Language) -> Iterator[str]:
    """Yield the list of sections, each with its page, which whatever opens the document fills in.

    A list that Word gathers itself would stay without pages everywhere else.
    """
    yield paragraph(text_run(translate("note.contents", language)), "ContentsTitle")
    for k, (level, text) in enumerate(headings):
        if level <= 2:
            link = f'<w:hyperlink w:anchor="{bookmark(k)}">{text_run(text)}<w:r><w:tab/></w:r>{_page(k)}</w:hyperlink>'
            yield paragraph(link, f"TOC{level}")


def _page(k: int) -> str:
    """Return a field with the page of a heading."""
    return (
        '<w:r><w:fldChar w:fldCharType="begin" w:dirty="true"/></w:r>'
        f'<w:r><w:instrText xml:space="preserve"> PAGEREF {bookmark(k)} \\h </w:instrText></w:r>'
        '<w:r><w:fldChar w:fldCharType="separate"/></w:r><w:r><w:fldChar w:fldCharType="end"/></w:r>'
    )


def bookmark(k: int) -> str:
    """Return the name of the bookmark at the k-th heading."""
    return f"_Toc{k + 1:08d}"


def heading_xml(level: int, text: str, k: int) -> str:
    """Return the k-th heading with its bookmark."""
    start = f'<w:bookmarkStart w:id="{k}" w:name="{bookmark(k)}"/>'
    return paragraph(f'{start}{text_run(text)}<w:bookmarkEnd w:id="{k}"/>', f"Heading{level}")


# twentieths of a point, for an A4 page upright, half of it, and on its side
TEXT_WIDTH, HALF_TEXT_WIDTH, WIDE_TEXT_WIDTH = 9638, 4640, 14570


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


def cell(width: int, content: str, place: str) -> str:
    """Return a cell of a table, its content at the top, in the middle or at the bottom."""
    size = f'<w:tcW w:w="{width}" w:type="dxa"/>'
    return f'<w:tc><w:tcPr>{size}<w:vAlign w:val="{place}"/></w:tcPr>{content}</w:tc>'


# least heights of the parts of the page, head to foot: 250 of its 257 mm [twip]
_HEAD, _TITLE, _PEOPLE, _PLACE = 3200, 5700, 4200, 650
_LABEL, _SIGN, _NAME = 3000, 1500, 3200
# letters of a name that stand in one line
_SHORT = 60
_INDENT = '<w:ind w:left="60"/>'
_NONE = '<w:tblCellMar><w:left w:w="0" w:type="dxa"/><w:right w:w="0" w:type="dxa"/></w:tblCellMar>'
_STROKE = '<w:tcBorders><w:bottom w:val="single" w:sz="4" w:space="0" w:color="auto"/></w:tcBorders>'


def cover_xml(page: TitlePage, note: Note) -> Iterator[str]:
    """Yield the cover and the end of its page; a plain one stands above the text."""
    small = 0.62 if page.is_crowded else 1.0

    def lines(texts: tuple[str, ...], size: int, *, bold: bool = False, style: str = "TitleLine") -> str:
        font = f'{"<w:b/>" if bold else ""}<w:sz w:val="{int(size * small)}"/><w:szCs w:val="{int(size * small)}"/>'
        return "".join(paragraph(text_run(entry_text, font), style) for entry_text in texts)

    if page.is_plain:
        names = tuple(", ".join(person.names) for person in page.people)
        yield lines((note.headline,), 36, bold=True, style="Title")
        yield from (lines((entry_text,), 24) for entry_text in (*page.below, *names))
        return
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
    """Return the people of the note in the right part of the page, with a line for each signature."""
    if not people:
        return ""
    signs = any(man.signs for man in people)
    most = max(len(name) for man in people for name in man.names)
    name_width = _NAME if most < _SHORT else TEXT_WIDTH - _LABEL - _SIGN
    widths = [_LABEL, _SIGN, name_width] if signs else [_LABEL, name_width]
    font = f'<w:sz w:val="{size}"/><w:szCs w:val="{size}"/>'

    def entry(width: int, text: str, more: str = "") -> str:
        look = f'<w:tcW w:w="{width}" w:type="dxa"/>{more}<w:vAlign w:val="bottom"/>'
        return f"<w:tc><w:tcPr>{look}</w:tcPr>{paragraph(text_run(text, font), '', _INDENT)}</w:tc>"

    rows = ""
    for person in people:
        for k, name in enumerate(person.names):
            stroke = entry(_SIGN, "", _STROKE if person.signs else "") if signs else ""
            label = entry(_LABEL, f"{person.label}:" if k == 0 else "")
            rows += f"<w:tr><w:trPr><w:cantSplit/></w:trPr>{label}{stroke}{entry(widths[-1], name)}</w:tr>"
    grid = "".join(f'<w:gridCol w:w="{column}"/>' for column in widths)
    return (
        f'<w:tbl><w:tblPr><w:tblW w:w="{sum(widths)}" w:type="dxa"/><w:jc w:val="right"/>'
        f'<w:tblLayout w:type="fixed"/></w:tblPr><w:tblGrid>{grid}</w:tblGrid>{rows}</w:tbl>'
        # a cell ends with a paragraph
        + paragraph("", "", '<w:spacing w:before="0" w:after="0" w:line="20" w:lineRule="exact"/>')
    )


# as wide as the text at most [mm]
_WIDEST = 169.6
# English metric units
_EMU = 36000
_DRAWING = "http://schemas.openxmlformats.org/drawingml/2006"


def figure_xml(block: Figure, words: str, k: int, picture: str, lines: str) -> Iterator[str]:
    """Yield the k-th figure and its caption; `picture` and `lines` are the names of its parts."""
    drawing = block.drawing
    width = min(block.width, _WIDEST)
    size = f'cx="{round(width * _EMU)}" cy="{round(drawing.height * width / drawing.width * _EMU)}"'
    about = f'id="{k}" name="drawing{k}" descr="{xml_text(block.alt)}"'
    blip = (
        f'<a:blip r:embed="{picture}"><a:extLst><a:ext uri="{{96DAC541-7B7A-43D3-8B79-37D633B846F1}}">'
        '<asvg:svgBlip xmlns:asvg="http://schemas.microsoft.com/office/drawing/2016/SVG/main" '
        f'r:embed="{lines}"/></a:ext></a:extLst></a:blip>'
    )
    shape = (
        f"<pic:pic><pic:nvPicPr><pic:cNvPr {about}/><pic:cNvPicPr/></pic:nvPicPr><pic:blipFill>{blip}"
        f'<a:stretch><a:fillRect/></a:stretch></pic:blipFill><pic:spPr><a:xfrm><a:off x="0" y="0"/><a:ext {size}/>'
        '</a:xfrm><a:prstGeom prst="rect"><a:avLst/></a:prstGeom></pic:spPr></pic:pic>'
    )
    inline = (
        f'<w:r><w:drawing><wp:inline xmlns:wp="{_DRAWING}/wordprocessingDrawing" xmlns:a="{_DRAWING}/main" '
        f'xmlns:pic="{_DRAWING}/picture" distT="0" distB="0" distL="0" distR="0"><wp:extent {size}/>'
        f'<wp:docPr {about}/><a:graphic><a:graphicData uri="{_DRAWING}/picture">{shape}</a:graphicData></a:graphic>'
        "</wp:inline></w:drawing></w:r>"
    )
    yield paragraph(inline, "Drawing")
    yield paragraph(text_run(words), "Caption", '<w:jc w:val="center"/>')


def omml_box(box: Box) -> str:  # noqa: C901, PLR0912 - one case per kind of box
    """Return a box as elements of Word's mathematics, prefixes `m` and `w` undeclared."""
    match box:
        case Letter(text):
            return _math_run(text, "letter")
        case Upright(text):
            return _math_run(text, "text")
        case Digits(text):
            return _math_run(text, "upright")
        case Sign(text, "fence"):
            return _math_run(text, "literal")
        case Sign(text, _):
            return _math_run(text or "\u2009", "upright")
        case Row(parts):
            return "".join(map(omml_box, parts))
        case Fraction(top, bottom):
            return f"<m:f><m:num>{omml_box(top)}</m:num><m:den>{omml_box(bottom)}</m:den></m:f>"
        case Root(inside):
            hidden = '<m:radPr><m:degHide m:val="1"/></m:radPr><m:deg/>'
            return f"<m:rad>{hidden}<m:e>{omml_box(inside)}</m:e></m:rad>"
        case Fence(inside, marks):
            ends = f'<m:dPr><m:begChr m:val="{marks[0]}"/><m:endChr m:val="{marks[1]}"/></m:dPr>'
            return f"<m:d>{ends}<m:e>{omml_box(inside)}</m:e></m:d>"
        case Script():
            return _script(box)
        case Apply(name, argument):
            return f"<m:func><m:fName>{omml_box(name)}</m:fName><m:e>{omml_box(argument)}</m:e></m:func>"
        case Marked(Letter(text), "bold"):
            return _math_run(text, "bold")
        case Marked(inside, "arrow" | "bold"):
            return f'<m:acc><m:accPr><m:chr m:val="\u20d7"/></m:accPr><m:e>{omml_box(inside)}</m:e></m:acc>'
        case Marked(inside, mark):
            place = "bot" if mark == "line" else "top"
            return f'<m:bar><m:barPr><m:pos m:val="{place}"/></m:barPr><m:e>{omml_box(inside)}</m:e></m:bar>'


def _math_run(text: str, style: str) -> str:
    properties = f"<m:rPr>{_STYLES[style]}</m:rPr>{_FONT}"
    return f'<m:r>{properties}<m:t xml:space="preserve">{xml_text(text)}</m:t></m:r>'


def _script(box: Script) -> str:
    """Return a base with what stands at its foot and head; the name of the element says which of them there are."""
    kind = ("Sub" if box.below else "") + ("Sup" if box.above else "")
    below = f"<m:sub>{omml_box(box.below)}</m:sub>" if box.below else ""
    above = f"<m:sup>{omml_box(box.above)}</m:sup>" if box.above else ""
    return f"<m:s{kind}><m:e>{omml_box(box.base)}</m:e>{below}{above}</m:s{kind}>"
