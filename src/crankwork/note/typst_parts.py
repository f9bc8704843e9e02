"""Blocks of a note as Typst markup. All text stands in strings of Typst, so that nothing in it is markup."""

from __future__ import annotations

import re
from collections.abc import Iterator

from crankwork.formula.expression import Expression, text
from crankwork.locale import say
from crankwork.note.captions import LANGUAGE_TAGS, caption, printed_date
from crankwork.note.characters import typst_string
from crankwork.note.document import (
    Bibliography,
    Block,
    Bold,
    Citation,
    Contents,
    Equation,
    Figure,
    Heading,
    ItemList,
    Math,
    Note,
    PageBreak,
    Paragraph,
    Reference,
    Run,
    Runs,
    Table,
    TitlePage,
    cell_length,
)
from crankwork.note.equations import legend_rows, printed_equation
from crankwork.note.layout import Box
from crankwork.note.math import formula_box
from crankwork.note.numbering import Numbering, equation_source
from crankwork.note.symbols import symbol_box
from crankwork.note.typst_math import typst_box
from crankwork.quantities import Language
from crankwork.sources import cite

_SETTINGS = """
#set page(paper: "a4", margin: (left: 25mm, right: 15mm, top: 20mm, bottom: 20mm), numbering: "1")
#set text(font: "Libertinus Serif", size: 12pt, hyphenate: true)
#set par(leading: 0.78em, spacing: 0.95em, justify: true)
#show math.equation: set text(font: ("New Computer Modern Math", "Libertinus Serif"))
#show heading: set block(above: 1.5em, below: 0.9em, sticky: true)
#show heading: set par(justify: false)
#show heading.where(level: 1): set text(size: 15pt)
#show heading.where(level: 2): set text(size: 13pt)
#show heading.where(level: 3): set text(size: 12pt)
#set table(stroke: 0.4pt + black, inset: (x: 4pt, y: 3.2pt))
#set list(marker: [–])
#let fitted(line) = layout(size => {
  let wide = measure(line).width
  if wide > size.width { scale(size.width / wide * 100%, reflow: true, line) } else { line }
})
#let lines(number, ..all) = block(width: 100%, breakable: false, above: 1.1em, below: 1.1em, grid(
  columns: (1fr, auto), column-gutter: 0.8em,
  align: (center + horizon, right + if all.pos().len() > 1 { bottom } else { horizon }),
  grid(row-gutter: 0.9em, align: center, ..all.pos().map(fitted)), number,
))
#let drawing(body, words) = figure(body, caption: words, numbering: none, supplement: none, kind: "drawing")
#let above(words) = block(width: 100%, sticky: true, above: 1.4em, below: 0.6em, words)
"""
_SIZE = re.compile(rb'<svg[^>]*?\swidth="([\d.]+)(pt|px|mm|cm|in)?"')
_POINTS = {b"": 0.75, b"px": 0.75, b"pt": 1.0, b"mm": 72 / 25.4, b"cm": 72 / 2.54, b"in": 72.0}
_TOGETHER = 16
_LONG, _SHORT = 300, 14
# width of the text on a page upright and on its side, in points
_PAGE, _WIDE_PAGE = 480.0, 725.0
_ALIGN = {"l": "left", "c": "center", "r": "right"}


def typst_source(note: Note, numbers: Numbering) -> str:
    """Return a note as the source of a Typst document."""
    year, month, day = (note.date.year, note.date.month, note.date.day) if note.date else (2000, 1, 1)
    authors = "".join(f"{typst_string(one)}, " for one in note.authors)
    language, _, region = LANGUAGE_TAGS[note.language].partition("-")
    date = f"datetime(year: {year}, month: {month}, day: {day})"
    parts = [
        f"#set document(title: {typst_string(note.title)}, author: ({authors}), date: {date})",
        f"#set document(keywords: {typst_string(note.provenance)})",
        f'#set text(lang: "{language}", region: "{region}")' + _SETTINGS,
    ]
    turned = False
    for block, number in zip(note.blocks, numbers.blocks, strict=True):
        wide = isinstance(block, Table) and block.wide
        if wide != turned:
            parts.append("#page(flipped: true)[" if wide else "]")
            turned = wide
        parts.extend(_block(block, number, note, numbers))
    return "\n".join([*parts, "]" if turned else "", ""])


def _block(block: Block, number: str, note: Note, numbers: Numbering) -> Iterator[str]:  # noqa: C901 - one case per block
    """Yield the markup of a block."""
    match block:
        case Heading(level, words):
            yield f"#heading(level: {level}, {typst_string(f'{number} {words}'.strip())})"
        case Paragraph(runs):
            yield f"#par[{_runs(runs, numbers)}]"
        case Equation():
            yield from _equation(block, number, numbers)
        case Table():
            yield from _table(block, number, numbers)
        case Figure():
            yield _figure(block, number, note.language)
        case ItemList(items, ordered):
            yield f"#{'enum' if ordered else 'list'}({', '.join(f'[{_runs(item, numbers)}]' for item in items)})"
        case PageBreak():
            yield "#pagebreak(weak: true)"
        case Contents():
            title = typst_string(say("note.contents", note.language))
            yield f"#outline(title: {title}, depth: 2, indent: 1em)"
        case TitlePage():
            yield _title_page(note)
        case Bibliography():
            yield "#enum(" + ", ".join(typst_string(cite(key)) for key in numbers.sources) + ")"


def _runs(runs: Runs, numbers: Numbering) -> str:
    return "".join(_run(run, numbers) for run in runs)


def _run(run: Run, numbers: Numbering) -> str:
    match run:
        case Bold(words):
            return f"#strong({typst_string(words)});"
        case Math(content):
            return _inline(content, numbers.language)
        case Reference(label):
            return f"#{typst_string(numbers.reference(label))};"
        case Citation(source):
            return f"#{typst_string(numbers.citation(source))};"
    return f"#{typst_string(run)};"


def _inline(content: str | Expression, language: Language) -> str:
    if isinstance(content, str):
        return _math(symbol_box(content), content)
    return _math(formula_box(content, None, language), text(content, language=language))


def _math(box: Box, words: str) -> str:
    return f"#math.equation(alt: {typst_string(words)}, ${typst_box(box)}$);"


def _equation(block: Equation, number: str, numbers: Numbering) -> Iterator[str]:
    printed = printed_equation(block, numbers.language)
    source = equation_source(block)
    mark = "\u2002".join(([numbers.citation(source)] if source else []) + ([f"({number})"] if number else []))
    drawn = []
    for k, line in enumerate(printed.lines):
        # what is read aloud is the whole equation once
        words = typst_string(printed.text if k == 0 else "…")
        drawn.append(f"math.equation(block: true, alt: {words}, $ {typst_box(line)} $)")
    yield f"#lines({typst_string(mark)}, {', '.join(drawn)})"
    if block.legend:
        cells = ", ".join(
            f"{typst_string(where)}, [{_math(box, entry.symbol)}#{typst_string(words)}]"
            for (where, box, words), entry in zip(legend_rows(block, numbers.language), block.legend, strict=True)
        )
        yield f"#grid(columns: 2, column-gutter: 0.6em, row-gutter: 0.7em, {cells})"


def _table(block: Table, number: str, numbers: Numbering) -> Iterator[str]:
    count = len(block.headings)
    size = 10 if count <= 9 else 9 if count <= 14 else 8
    align = ", ".join(_ALIGN[letter] for letter in (block.align or "r" * count))
    # a short table stays on one page with its caption
    whole = len(block.rows) <= _TOGETHER
    if whole:
        yield "#block(breakable: false)["
    yield f"#above({typst_string(caption('table', number, block.caption, numbers.language))})"
    headings = ", ".join(f"[{_runs(runs, numbers)}]" for runs in block.headings)
    rows = ",\n".join(
        ", ".join(typst_string(cell) if isinstance(cell, str) else f"[{_run(cell, numbers)}]" for cell in row)
        for row in block.rows
    )
    columns = _columns(block, size)
    header = f"table.header(..({headings},).map(cell => table.cell(align: center + horizon, cell)))"
    yield (
        f"#{{\nset text(size: {size}pt, hyphenate: false)\nset par(justify: false, leading: 0.55em)\n"
        f"align(center, table({columns}, align: ({align},), {header},\n{rows}))\n}}"
    )
    if whole:
        yield "]"


def _columns(block: Table, size: int) -> str:
    """Return the columns of a table; those of a long table of short entries are not measured, which takes long."""
    longest = [max(map(cell_length, column), default=0) for column in zip(*block.rows, strict=True)]
    if len(block.rows) < _LONG or max(longest) > _SHORT:
        return f"columns: {len(block.headings)}"
    widths = [max(0.55 * size * length, 3.2 * size) + 8 for length in longest]
    if sum(widths) > (_WIDE_PAGE if block.wide else _PAGE):
        return f"columns: {len(block.headings)}"
    return f"columns: ({', '.join(f'{one:.1f}pt' for one in widths)},), rows: (auto, {1.55 * size:.1f}pt)"


def svg_width(svg: bytes) -> float:
    """Return the width that an SVG says it has. [pt]"""
    found = _SIZE.search(svg)
    return float(found[1]) * _POINTS[found[2] or b""] if found else 460.0


def _figure(block: Figure, number: str, language: Language) -> str:
    width = svg_width(block.svg)
    data = block.svg.decode("utf-8").replace("\\", "\\\\").replace('"', '\\"')
    words = typst_string(caption("figure", number, block.caption, language))
    image = (
        f'layout(size => image(bytes("{data}"), format: "svg", alt: {typst_string(block.alt)}, '
        f"width: calc.min({width:.2f}pt, size.width)))"
    )
    return f"#drawing({image}, {words})"


def _title_page(note: Note) -> str:
    lines = [f"#text(size: 20pt, weight: 700, {typst_string(note.title)})"]
    if note.subtitle:
        lines.append(f"#text(size: 14pt, {typst_string(note.subtitle)})")
    lines += [f"#{typst_string(author)}" for author in note.authors]
    if note.date:
        lines.append(f"#{typst_string(printed_date(note.date, note.language))}")
    body = "\n\n".join(lines)
    return f"#page(numbering: none)[#set par(justify: false)\n#set align(center)\n#v(1fr)\n{body}\n#v(2fr)]"
