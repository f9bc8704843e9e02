"""A note as PDF, from Typst markup: tagged, archivable (PDF/A-2a), the same bytes every time.

All text stands in strings of Typst, so that nothing in it is markup.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import replace

from crankwork.errors import CrankworkError, MissingExtraError
from crankwork.formula.calculation_lines import FormulaLine
from crankwork.formula.expression import Expression, text
from crankwork.locale import ErrorMessage, translate
from crankwork.note.captions import LANGUAGE_TAGS, caption, continued
from crankwork.note.document import (
    Bibliography,
    Block,
    Bold,
    Contents,
    Equation,
    Figure,
    Heading,
    ItemList,
    Math,
    Note,
    PageBreak,
    Paragraph,
    Run,
    Runs,
    Strong,
    Table,
    TitlePage,
    side_by_side,
    typst_string,
)
from crankwork.note.equations import formula_of, line_parts, printed_equation
from crankwork.note.layout import (
    Apply,
    Box,
    Digits,
    Fence,
    Fraction,
    Letter,
    Marked,
    Root,
    Row,
    Script,
    Sign,
    Upright,
    width,
)
from crankwork.note.math import formula_box
from crankwork.note.numbering import DIVIDED, TOGETHER, Numbering, flow, is_whole, leads, numbering
from crankwork.note.symbols import symbol_box
from crankwork.note.table_width import SIZES, fits, free_widths, one_line_widths, room
from crankwork.quantities import Language
from crankwork.resources import read_resource
from crankwork.show.canvas import MM
from crankwork.show.svg import svg
from crankwork.sources import cite

_NO_GLYPH = re.compile(r'the text `"(?P<text>.+?)"` could not be displayed', re.DOTALL)
_SETTINGS = "\n" + read_resource("note", "pdf.typ")
# one page of any height, on which positions show how high everything is, within a share
_ENDLESS = "#set page(width: 210mm, height: auto)\n"
_HEIGHTS = """
#[#metadata(none)<at>]
#context {
  let down = query(<at>).map(one => one.location().position().y.pt())
  [#metadata(range(down.len() - 1).map(k => calc.max(0, down.at(k + 1) - down.at(k))))<heights>]
}
"""
_OFF = 0.01
# width of the text of a page [mm]
_TEXT_WIDTH = 170.0
_TURNED, _TURNED_END = "#page(flipped: true)[\n", "\n]"
# a line of an equation and its number that are estimated no wider are not measured, which takes long; of a letter [em]
_SURELY_FITS, _LETTER = 33.5, 0.5
# a unit with a dot or a slash, and what is written against it
_COMPOSED = re.compile(r"((?<!\S)[^\W\d][^\s/·]{0,3}[/·][^\W\d]\S{0,8}(?!\S))")
# letters of an entry that has room for its words whatever stands beside it
_SHORT = 12
# columns of a table whose parts stand side by side
_SEVERAL_PARTS = 8
# height of a line of a table [em], and what is free above and below it [pt]
_LINE, _INSET = 0.66, 2.3
# a word that may be wider than a column of the cover
_LONG_WORD = re.compile(r"\S{28,}")
_ALIGN = {"l": "left", "c": "center", "r": "right"}
_SIGNS = {"·": "dot.op", "": "thin", "/": "slash", "(": "paren.l", ")": "paren.r", ",": "comma thin", ";": '";" thin'}
_MARKS = {"bar": "overline", "arrow": "arrow", "bold": "bold", "line": "underline"}
_PRIMES = {"′": "prime", "″": "prime.double", "‴": "prime.triple"}


def pdf(note: Note) -> bytes:
    """Return a note as a PDF file."""
    try:
        import typst  # noqa: PLC0415 - an optional part
    except ImportError:
        raise MissingExtraError(ErrorMessage("extra_writing", names="PDF"), "report") from None
    numbers = numbering(note)
    rows, head, written = list(side_by_side(note.blocks)), _head(note), list(_written(note, numbers))
    try:
        marked = "\n".join(f"#[#metadata(none)<at>]\n{text}" for text in written)
        measured = f"{head}{_ENDLESS}{marked}{_HEIGHTS}".encode()
        heights = typst.query(measured, "<heights>", field="value", ignore_system_fonts=True)
        smaller = dict[int, float]()
        order = list(flow([note.blocks[row[0]] for row in rows], json.loads(heights)[0], _OFF, smaller))
        for place, share in smaller.items():
            (k,) = rows[place]
            written[place] = "\n".join(_block(_sized(note.blocks[k], share), numbers.blocks[k], note, numbers))
        # wide tables that follow each other share pages
        body = "\n".join(written[place] for place in order).replace(f"{_TURNED_END}\n{_TURNED}", "")
        source = f"{head}{body}\n".encode()
        return typst.compile(source, format="pdf", ignore_system_fonts=True, pdf_standards="a-2a")
    except typst.TypstError as error:
        missing = _NO_GLYPH.search(str(error))
        if not missing:
            raise
        raise _missing_character(missing["text"]) from None


def _sized(block: Block, share: float) -> Block:
    """Return a figure at a share of its size."""
    if not isinstance(block, Figure):
        return block
    # no wider than the text before it is made smaller
    wide = min(block.width, _TEXT_WIDTH)
    return replace(block, high=share * wide * block.drawing.height / block.drawing.width)


def _missing_character(text: str) -> CrankworkError:
    # Typst writes rare characters as \u{1f600}
    shown = re.sub(r"\\u\{([0-9a-fA-F]+)\}", lambda code: chr(int(code[1], 16)), text)
    codes = " ".join(f"U+{ord(character):04X}" for character in shown)
    return CrankworkError(ErrorMessage("glyph_missing", character=shown, codes=codes))


def _head(note: Note) -> str:
    """Return how a note as Typst document begins."""
    year, month, day = (note.date.year, note.date.month, note.date.day) if note.date else (2000, 1, 1)
    authors = "".join(f"{typst_string(author)}, " for author in note.authors)
    language, _, region = LANGUAGE_TAGS[note.language].partition("-")
    date = f"datetime(year: {year}, month: {month}, day: {day})"
    return (
        f"#set document(title: {typst_string(note.title)}, author: ({authors}), date: {date})\n"
        f"#set document(keywords: {typst_string(note.provenance)})\n"
        f'#set text(lang: "{language}", region: "{region}"){_SETTINGS}'
    )


def _written(note: Note, numbers: Numbering) -> Iterator[str]:
    """Yield the source of each row of blocks, as `side_by_side` has them."""
    for places in side_by_side(note.blocks):
        cells = ["\n".join(_block(note.blocks[place], numbers.blocks[place], note, numbers)) for place in places]
        first = note.blocks[places[0]]
        if isinstance(first, Table) and first.wide:
            yield f"{_TURNED}{cells[0]}{_TURNED_END}"
        else:
            foot = "(align: bottom)" * all(isinstance(note.blocks[place], Figure) for place in places)
            yield cells[0] if len(cells) == 1 else f"#beside{foot}[{cells[0]}][{cells[1]}]"


def _block(block: Block, number: str, note: Note, numbers: Numbering) -> Iterator[str]:  # noqa: C901 - one case per block
    """Yield the markup of a block."""
    match block:
        case Heading(level, words):
            yield f"#heading(level: {level}, {typst_string(f'{number} {words}'.strip())})"
        case Paragraph(runs):
            words = f"#par[{_runs(runs, numbers)}]"
            yield f"#block(sticky: true, spacing: 0.75em)[{words}]" if leads(block) else words
        case Equation():
            yield from _equation(block, number, numbers)
        case Table():
            yield from _table(block, number, numbers)
        case Figure():
            yield _figure(block, number, note.language)
        case ItemList(items):
            yield f"#list({', '.join(f'[{_runs(item, numbers)}]' for item in items)})"
        case PageBreak():
            yield "#pagebreak(weak: true)"
        case Contents():
            title = typst_string(translate("note.contents", note.language))
            yield f"#outline(title: {title}, depth: 2, indent: 1em)"
        case TitlePage():
            yield _title_page(block, note)
        case Bibliography():
            listed = ", ".join(typst_string(cite(key)) for key in numbers.sources)
            yield f"#[#set text(size: 10pt)\n#enum(spacing: 0.45em, {listed})]"


def _runs(runs: Runs, numbers: Numbering) -> str:
    return "".join(_run(run, numbers) for run in runs)


def _run(run: Run, numbers: Numbering) -> str:
    if isinstance(run, Math):
        return _inline(run.content, numbers.language)
    # no line begins with a dash, and a composed unit is neither divided nor stretched
    parts = map(typst_string, _COMPOSED.split(numbers.words(run).replace(" – ", "\u00a0– ")))
    words = "".join(f"#box({part});" if k % 2 else f"#{part};" for k, part in enumerate(parts))
    return f"#strong[{words}]" if isinstance(run, Bold) else words


def _inline(content: str | Expression | FormulaLine, language: Language) -> str:
    if isinstance(content, str):
        return _math(symbol_box(content), content)
    if isinstance(content, FormulaLine):
        return _math(formula_of(content, language), line_parts(content, language)[0])
    return _math(formula_box(content, None, language), text(content, language=language))


def _math(box: Box, words: str) -> str:
    return f"#math.equation(alt: {typst_string(words)}, ${typst_box(box)}$);"


def _equation(block: Equation, number: str, numbers: Numbering) -> Iterator[str]:
    printed = printed_equation(block, numbers.language)
    mark = numbers.mark(block, number)
    drawn, free = [], _SURELY_FITS - _LETTER * len(mark)
    for k, line in enumerate(printed.lines):
        # what is read aloud is the whole equation once
        words = typst_string(printed.text if k == 0 else "…")
        set_line = f"math.equation(block: true, alt: {words}, $ {typst_box(line)} $)"
        drawn.append(f"fitted({set_line})" if width(line) > free else set_line)
    yield f"#lines({typst_string(mark)}, {', '.join(drawn)})"


def _table(block: Table, number: str, numbers: Numbering) -> Iterator[str]:
    count = len(block.headings)
    sizes = SIZES[len(block.rows) > TOGETHER or count >= _SEVERAL_PARTS or block.half :]
    size = next((letters for letters in sizes if fits(block.headings, block.rows, letters, room(block))), SIZES[-1])
    align = ", ".join(_ALIGN[letter] for letter in (block.align or "r" * count))
    is_kept = is_whole(block)
    if is_kept:
        yield "#block(breakable: false)["
    above = typst_string(caption("table", number, block.caption, numbers.language))
    yield f"#{'above' if is_kept else 'over'}({above})"
    headings = ", ".join(f"[{_heading(runs, numbers)}]" for runs in block.headings)
    rows = ",\n".join(
        ", ".join(typst_string(cell) if isinstance(cell, str) else f"[{_cell(cell, numbers)}]" for cell in row)
        if not isinstance(row[0], Strong)
        else ", ".join(f"strong({typst_string(str(cell))})" for cell in row)
        for row in block.rows
    )
    again = "" if is_kept else f"..again({count}, {typst_string(continued(number, numbers.language))}), "
    header = f"table.header({again}..({headings},).map(titled))"
    columns = _columns(block, size, marked=not is_kept)
    yield (
        f"#{{\nset text(size: {size:g}pt, hyphenate: false)\nset par(justify: false, leading: 0.55em)\n"
        f"align(center, table({columns}, align: ({align},), stroke: ruled({int(not is_kept)}), {header},\n{rows}))\n}}"
    )
    if is_kept:
        yield "]"


def _heading(runs: Runs, numbers: Numbering) -> str:
    """Return a heading of a column; a fraction alone is as high as it is, which in a line of text it would not be."""
    match runs:
        case (Math(str(content)),) if isinstance(box := symbol_box(content), Fraction):
            return f"#math.equation(block: true, alt: {typst_string(content)}, $ {typst_box(box)} $);"
    return _runs(runs, numbers)


def _cell(cell: Math, numbers: Numbering) -> str:
    """Return mathematics in a table; a formula is as high as it is, which in a line of text it would not be."""
    if not isinstance(cell.content, FormulaLine):
        return _run(cell, numbers)
    words = typst_string(line_parts(cell.content, numbers.language)[0])
    return f"#math.equation(block: true, alt: {words}, $ {typst_box(formula_of(cell.content, numbers.language))} $);"


def _columns(block: Table, size: float, *, marked: bool) -> str:
    """Return the columns of a table, and its rows where each is one line; measuring them would take most of the time.

    `marked`: whether a row that says where the table goes on stands above its header.
    """
    widths = one_line_widths(block.headings, block.rows, size, room(block))
    # words need less room between their rows than numbers
    close = ", inset: (x: 4pt, y: 2pt)" if block.label == DIVIDED else ""
    if not widths:
        # words have the room that symbols and numbers leave, those of long entries more of it
        longest = [max((len(cell) for cell in column if isinstance(cell, str) and " " in cell), default=0)
                   for column in zip(*block.rows, strict=True)]  # fmt: skip
        return f"columns: ({', '.join(f'{max(length, _SHORT)}fr' if length else 'auto' for length in longest)},){close}"
    if block.rows and not close:
        # numbers stand in the middle under a wide heading
        free = free_widths(block, size, widths)
        sides = ", ".join(f"(left: 4pt, right: {4 + width_left / 2:.1f}pt, y: {_INSET}pt)" for width_left in free)
        close = f", inset: ({sides},)"
    columns = f"columns: ({', '.join(f'{points:.1f}pt' for points in widths)},){close}"
    if any(isinstance(cell, Math) for row in block.rows for cell in row):
        return columns
    return f"{columns}, rows: ({'auto, auto' if marked else 'auto'}, {_LINE * size + 2 * _INSET:.2f}pt)"


def _figure(block: Figure, number: str, language: Language) -> str:
    data = svg(block.drawing).decode("utf-8").replace("\\", "\\\\").replace('"', '\\"')
    words = typst_string(caption("figure", number, block.caption, language))
    image = (
        f'layout(size => image(bytes("{data}"), format: "svg", alt: {typst_string(block.alt)}, '
        f"width: calc.min({block.width / MM:.2f}pt, size.width)))"
    )
    return f"#drawing({image}, {words})"


def _breakable(text: str) -> str:
    """Return a text of the cover as a string, words that no line holds divided anywhere."""
    return typst_string(_LONG_WORD.sub(lambda word: "\u200b".join(word[0]), text))


def _title_page(page: TitlePage, note: Note) -> str:
    """Return the cover: whose it is at the head, the title in the middle, people below, place and year at the foot."""
    headline = note.headline.replace(" × ", "\u00a0×\u00a0")
    small = 0.62 if page.is_crowded else 0.8 if page.is_plain else 1.0

    def lines(texts: tuple[str, ...], size: float, weight: int = 400) -> str:
        boxes = ", ".join(f"text(size: {size * small:.1f}pt, weight: {weight}, {_breakable(entry)})" for entry in texts)
        return f"#stack(spacing: {0.9 * small:.2f}em, {boxes})\n" if texts else ""

    if page.is_plain:
        people_line = tuple(", ".join(person.names) for person in page.people)
        title = f"{lines((headline,), 20, 700)}{lines(page.below, 14)}{lines(people_line, 14)}"
        return f"#align(center, block(below: 1.6em)[#set par(justify: false)\n{title}])"
    # the strokes of signatures stand under names that are written by hand
    sign = "box(width: 32mm, height: 0.9em, stroke: (bottom: 0.4pt))"
    people = ", ".join(
        f"{typst_string(person.label + ':' if k == 0 else '')}, {sign if person.signs else '[]'}, {_breakable(name)}"
        for person in page.people
        for k, name in enumerate(person.names)
    )
    columns = "(auto, auto, 1fr)" if any(person.signs for person in page.people) else "(auto, 0pt, auto)"
    grid = f"grid(columns: {columns}, column-gutter: 0.7em, row-gutter: 0.9em, align: left + bottom, {people})"
    body = (
        f"{lines(page.institution, 13)}#v(1fr)\n{lines(page.above, 15)}#v(0.8em)\n{lines((headline,), 20, 700)}"
        f"#v(0.8em)\n{lines(page.below, 14)}#v(1fr)\n"
    )
    if people:
        width = 100 if page.is_crowded else 75
        sized = f"#set text(size: {12 * small:.1f}pt)\n#align(left, {grid})"
        body += f"#align(right, block(width: {width}%)[{sized}])\n#v(1fr)\n"
    return (
        "#page(numbering: none)[#set par(justify: false, leading: 0.55em)\n#set text(hyphenate: false)\n"
        f"#set align(center)\n{body}{lines((page.place,), 12) if page.place else ''}]"
    )


def typst_box(box: Box) -> str:  # noqa: C901 - one case per kind of box
    """Return a box as Typst mathematics."""
    match box:
        case Letter(text):
            return _letter(text)
        case Upright(text):
            return _upright(text)
        case Digits(text):
            # a number of Typst stands closer to its sign than a string does, and has no decimal comma
            return text.replace(",", '","')
        case Sign(text, kind):
            return "minus" if text == "−" and kind == "prefix" else _SIGNS.get(text, text)
        case Row(parts):
            return " ".join(map(typst_box, parts))
        case Fraction(top, bottom):
            return f"frac({typst_box(top)}, {typst_box(bottom)})"
        case Root(inside):
            return f"sqrt({typst_box(inside)})"
        case Fence(inside, marks):
            return f"lr({marks[0]} {typst_box(inside)} {marks[1]})"
        case Script(base, below, above):
            feet = f", b: {typst_box(below)}" if below else ""
            letter = isinstance(base, Upright) and len(base.text) > 1 and f"op({typst_string(base.text)})"
            return f"attach({letter or typst_box(base)}{feet}{f', t: {typst_box(above)}' if above else ''})"
        case Apply(name, argument):
            return f"{_name(name)} {typst_box(argument)}"
        case Marked(inside, mark):
            return f"{_MARKS[mark]}({typst_box(inside)})"


def _letter(text: str) -> str:
    """Return a variable; the fonts of mathematics have slanted Latin and Greek letters, the others come from text."""
    if len(text) == 1 and (text.isascii() or "α" <= text <= "ω"):
        return text
    if len(text) == 1 and "Α" <= text <= "Ω":
        return f"italic({text})"
    return f'#text(font: "Libertinus Serif", style: "italic", {typst_string(text)})'


def _upright(text: str) -> str:
    if text == "\u2009":
        return "med"
    if len(text) == 1 and "Α" <= text <= "Ω":
        return text
    if text in ("°", "%"):
        return text
    # a string keeps its distance
    if text == "d":
        return "upright(d)"
    return _PRIMES.get(text) or typst_string(text)


def _name(name: Box) -> str:
    """Return the name of a function, which keeps its distance from what follows."""
    if isinstance(name, Script):
        return typst_box(name)
    return f"op({typst_box(name)})"
