"""A note as one web page that needs nothing else: MathML, drawings inside, a style for the screen and for paper."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.browser import script, style
from crankwork.locale import translate
from crankwork.note.captions import caption
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
    xml_text,
)
from crankwork.note.equations import printed_equation
from crankwork.note.interactive import bar, controls, look, page_data, stored_data_element, symbol_html
from crankwork.note.math import mathml_box
from crankwork.note.numbering import Numbering, numbering
from crankwork.note.word_parts import inline_box
from crankwork.quantities import Language
from crankwork.report.drawing import film_of
from crankwork.resources import read_resource
from crankwork.show.inline import inline_film, inline_svg
from crankwork.sources import cite

# the fonts of browsers are wider than those of the PDF
_LINE_WIDTH = 31.0
_ALIGN = {"l": "left", "c": "centre", "r": "right"}
STYLE = "\n" + read_resource("note", "web.css")


def web(note: Note) -> bytes:
    """Return a note as a web page, UTF-8."""
    numbers, results = numbering(note), note.results
    drawn = {block.name: block.drawing for block in note.blocks if isinstance(block, Figure)}
    film = film_of(results, language=note.language, forces=True) if results is not None and drawn else None
    parts = [
        f'<!DOCTYPE html>\n<html lang="{note.language}">\n<head>\n<meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f'<meta name="generator" content="{xml_text(note.provenance)}">',
        f"<title>{xml_text(note.title)}</title>\n<style>{look()}{style('design')}{STYLE}</style>\n</head>\n<body>",
        *([] if results is None else bar(note.language)),
        "<main>",
    ]
    second = {row[1] for row in side_by_side(note.blocks) if len(row) > 1}
    for k, (block, number) in enumerate(zip(note.blocks, numbers.blocks, strict=True)):
        if k + 1 in second:
            parts.append('<div class="beside">')
        if film is not None and isinstance(block, Figure) and block.name == "machine":
            # here it moves
            own = "".join(controls(film, note.language))
            words = xml_text(caption("figure", number, block.caption, note.language))
            moves = f"{inline_film(film, 'machine')}{own}<figcaption>{words}</figcaption>"
            parts.append(f'<figure id="machine">{moves}</figure>')
        else:
            parts.extend(_block(block, number, k, note, numbers))
        if k in second:
            parts.append("</div>")
    parts.append("</main>")
    if results is not None:
        parts += [
            stored_data_element(page_data(results, drawn, film, note.language)),
            f"<script>{script('page')}</script>",
        ]
    return "\n".join([*parts, "</body>\n</html>\n"]).encode("utf-8")


def _block(block: Block, number: str, k: int, note: Note, numbers: Numbering) -> Iterator[str]:  # noqa: C901 - one case per block
    """Yield the elements of a block, the k-th of its note."""
    match block:
        case Heading(level, words):
            yield f'<h{level + 1} id="b{k}">{xml_text(f"{number} {words}".strip())}</h{level + 1}>'
        case Paragraph(runs):
            yield f"<p>{_runs(runs, numbers)}</p>"
        case Equation():
            yield from _equation(block, number, numbers)
        case Table():
            yield from _table(block, number, numbers)
        case Figure():
            yield _figure(block, number, k, note.language)
        case ItemList(items):
            yield "<ul>" + "".join(f"<li>{_runs(item, numbers)}</li>" for item in items) + "</ul>"
        case PageBreak():
            yield '<div class="page"></div>'
        case Contents():
            yield _contents(note, numbers)
        case TitlePage():
            yield _title_page(block, note)
        case Bibliography():
            yield (
                '<ol class="sources">' + "".join(f"<li>{xml_text(cite(key))}</li>" for key in numbers.sources) + "</ol>"
            )


def _runs(runs: Runs, numbers: Numbering) -> str:
    return "".join(_run(run, numbers) for run in runs)


def _run(run: Run, numbers: Numbering) -> str:
    if isinstance(run, Math):
        return f"<math>{mathml_box(inline_box(run.content, numbers.language))}</math>"
    words = xml_text(numbers.words(run))
    return f"<strong>{words}</strong>" if isinstance(run, Bold | Strong) else words


def _equation(block: Equation, number: str, numbers: Numbering) -> Iterator[str]:
    printed = printed_equation(block, numbers.language, _LINE_WIDTH)
    lines = "".join(f'<math display="block">{mathml_box(line)}</math>' for line in printed.lines)
    mark = xml_text(numbers.mark(block, number, " "))
    yield f'<div class="equation"><div class="lines">{lines}</div><div class="mark">{mark}</div></div>'


def _table(block: Table, number: str, numbers: Numbering) -> Iterator[str]:
    kinds = [_ALIGN[letter] for letter in (block.align or "r" * len(block.headings))]
    headings = "".join(f'<th scope="col">{_heading(runs, numbers)}</th>' for runs in block.headings)
    words = xml_text(caption("table", number, block.caption, numbers.language))
    before = ["<td>" if kind == "right" else f'<td class="{kind}">' for kind in kinds]
    rows = "\n".join(
        "<tr>"
        + "".join(f"{start}{_run(cell, numbers)}</td>" for start, cell in zip(before, row, strict=True))
        + "</tr>"
        for row in block.rows
    )
    yield (
        f'<div class="table{" wide" if block.wide else ""}"><table><caption>{words}</caption>'
        f"<thead><tr>{headings}</tr></thead>\n<tbody>\n{rows}\n</tbody></table></div>"
    )


def _heading(runs: Runs, numbers: Numbering) -> str:
    """Return a heading; a symbol alone is set as text, because readers of pages take mathematics alone for nothing."""
    match runs:
        case (Math(str(symbol)),):
            return symbol_html(symbol)
    return _runs(runs, numbers)


def _figure(block: Figure, number: str, k: int, language: Language) -> str:
    """Return a figure, its drawing inside the page."""
    words = xml_text(caption("figure", number, block.caption, language))
    drawing = inline_svg(block.drawing, block.name, block.alt)
    return f'<figure id="b{k}">{drawing}<figcaption>{words}</figcaption></figure>'


def _contents(note: Note, numbers: Numbering) -> str:
    items = "".join(
        f'<li class="level{block.level}"><a href="#b{k}">{xml_text(f"{number} {block.text}".strip())}</a></li>'
        for k, (block, number) in enumerate(zip(note.blocks, numbers.blocks, strict=True))
        if isinstance(block, Heading) and block.level <= 2
    )
    return f'<nav><p class="contents">{translate("note.contents", note.language)}</p><ul>{items}</ul></nav>'


def _title_page(page: TitlePage, note: Note) -> str:
    def lines(texts: tuple[str, ...], name: str) -> str:
        return f'<div class="{name}">{"".join(f"<p>{xml_text(entry)}</p>" for entry in texts)}</div>' if texts else ""

    signed = '<td class="sign"></td>'
    people = "".join(
        f"<tr><td>{xml_text(person.label + ':') if k == 0 else ''}</td>"
        f"{signed if person.signs else '<td></td>'}<td>{xml_text(name)}</td></tr>"
        for person in page.people
        for k, name in enumerate(person.names)
    )
    table = f'<table class="people" role="presentation">{people}</table>' if people else ""
    title = f"{lines(page.above, 'above')}<h1>{xml_text(note.title)}</h1>{lines(page.below, 'subtitle')}"
    place = lines((page.place,), "place") if page.place else ""
    return f'<header class="title">{lines(page.institution, "institution")}<div>{title}</div>{table}{place}</header>'
