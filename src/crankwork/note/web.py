"""A note as one web page that needs nothing else: MathML, drawings inside, a style for the screen and for paper."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.browser import script, style
from crankwork.locale import translate
from crankwork.note.captions import caption
from crankwork.note.characters import xml_text
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
)
from crankwork.note.equations import printed_equation
from crankwork.note.interactive import bar, controls, look, page_data, stored_data_element, symbol_html
from crankwork.note.mathml import mathml_box
from crankwork.note.numbering import Numbering, numbering
from crankwork.note.word_parts import inline_box
from crankwork.quantities import Language
from crankwork.report.drawing import film_of
from crankwork.show.inline import inline_film, inline_svg
from crankwork.sources import cite

# the fonts of browsers are wider than those of the PDF
_LINE_WIDTH = 31.0
_ALIGN = {"l": "left", "c": "centre", "r": "right"}
STYLE = """
body { margin: 0; background: var(--ground); color: var(--ink); font: 17px/1.45 "Libertinus Serif", "Times New Roman",
  Tinos, "Liberation Serif", "Noto Serif", "DejaVu Serif", serif; }
main { max-width: 50rem; margin: 0 auto; padding: 1.5rem 1rem 4rem; }
math { font-family: "Libertinus Math", "Cambria Math", "STIX Two Math", "Latin Modern Math", "DejaVu Math TeX Gyre",
  math, serif; font-size: 1em; }
mi.slanted { font-style: italic; }
h1 { font-size: 1.9rem; line-height: 1.2; }
h2 { font-size: 1.35rem; margin: 2.2em 0 .6em; }
h3 { font-size: 1.12rem; margin: 1.8em 0 .5em; }
h4 { font-size: 1rem; margin: 1.5em 0 .4em; }
h2, h3, h4 { break-after: avoid; }
header.title { text-align: center; display: flex; flex-direction: column; justify-content: space-between; gap: 3rem;
  min-height: 80vh; padding: 4vh 0; overflow-wrap: anywhere; }
header.title:not(:has(.institution)) { justify-content: space-around; min-height: 0; }
header.title p { margin: .3em 0; }
.institution, .above, .subtitle { font-size: 1.2rem; }
.people { align-self: flex-end; text-align: left; width: 75%; border-spacing: .7em .5em; }
.people td { vertical-align: bottom; }
.people td:first-child { white-space: nowrap; }
.people .sign { min-width: 7em; border-bottom: 1px solid #444; }
nav .contents { font-size: 1.35rem; font-weight: bold; margin: 0 0 .5em; }
nav ul { list-style: none; padding: 0; }
nav .level2 { padding-left: 1.2em; }
nav a { color: inherit; text-decoration: none; }
nav a:hover, nav a:focus { text-decoration: underline; }
ul { list-style: "–  "; padding-left: 1.4em; }
.equation { display: flex; align-items: center; gap: 1rem; margin: .9em 0; break-inside: avoid; }
.lines { flex: 1; overflow-x: auto; overflow-y: hidden; padding: .15em 0; }
.lines math { margin: .35em 0; }
.mark { white-space: nowrap; }
.lines:has(math + math) + .mark { align-self: flex-end; padding-bottom: .5em; }
.table { margin: 1.6em 0; }
.table table { border-collapse: collapse; margin: 0 auto; font-size: .82rem; line-height: 1.25;
  font-variant-numeric: lining-nums tabular-nums; }
.table caption { text-align: left; font-size: 1rem; padding-bottom: .4em; }
.table table { border-top: 1.5px solid currentColor; }
.table th, .table td { border-bottom: 1px solid var(--g16); padding: .15em .45em; text-align: right;
  white-space: nowrap; }
.table td.left { text-align: left; white-space: normal; }
.table td.centre { text-align: center; }
.table th { text-align: center; font-weight: normal; background: var(--ground); border-bottom-color: currentColor; }
figure { margin: 1.6em 0; text-align: center; break-inside: avoid; }
figure svg { max-width: 100%; height: auto; }
figcaption { margin-top: .5em; }
.beside { display: flex; flex-wrap: wrap; justify-content: space-evenly; gap: 0 1rem; }
@media screen {
  .table thead th { position: sticky; top: 0; box-shadow: inset 0 1px var(--g6), inset 0 -1px var(--g6); }
  .wide { position: relative; left: 50%; width: max-content; max-width: 96vw; transform: translateX(-50%); }
}
/* a narrow screen: the number below its formula, which has the whole width and scrolls, a shadow at the edge behind
   which it goes on; tables scroll too */
@media screen and (max-width: 44rem) {
  .equation { flex-wrap: wrap; gap: 0 1rem; }
  .lines { flex: 1 0 100%; max-width: 100%; background:
    linear-gradient(90deg, var(--ground) 50%, transparent) 0 0 / 2.5rem 100% no-repeat local,
    linear-gradient(270deg, var(--ground) 50%, transparent) 100% 0 / 2.5rem 100% no-repeat local,
    linear-gradient(90deg, #0003, #0000) 0 0 / .6rem 100% no-repeat scroll,
    linear-gradient(270deg, #0003, #0000) 100% 0 / .6rem 100% no-repeat scroll; }
  .lines math { font-size: .82em; }
  .mark { margin-left: auto; }
  .table, .wide { position: static; width: auto; max-width: 100%; transform: none; overflow-x: auto; }
  .table thead th { position: static; box-shadow: none; }
}
@media screen {
  h2, h3, h4, figure { scroll-margin-top: 3.5rem; }
  .live .table thead th { top: 2.9rem; }
  #machine .drawing { max-height: 70vh; }
}
/* the contents stand beside where there is room */
@media screen and (min-width: 82rem) {
  .live nav { position: fixed; inset: 3rem auto 0 0; width: 17rem; overflow: auto; padding: 0 1rem; font-size: .85rem; }
  .live main { margin-left: max(19rem, calc(50vw - 25rem)); }
}
@page { size: A4; margin: 20mm 15mm 20mm 25mm; }
@page wide { size: A4 landscape; margin: 25mm 20mm 15mm; }
@media print {
  body { font-size: 12pt; }
  main { max-width: none; padding: 0; }
  header.title { min-height: 250mm; padding: 0; break-after: page; }
  .page { break-after: page; }
  .wide { page: wide; }
  .wide table { font-size: 8pt; }
  thead { display: table-header-group; }
  tr { break-inside: avoid; }
  .table caption { break-after: avoid; }
}
"""


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
