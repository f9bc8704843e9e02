"""The page of a machine: one self-contained HTML file."""

from __future__ import annotations

import html
from collections.abc import Container, Iterator
from typing import Any

from crankwork.analysis import Results
from crankwork.browser import script, style
from crankwork.errors import CrankworkError, InputError
from crankwork.locale import capital, in_language, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.note.equations import value_symbol
from crankwork.note.explain import Place
from crankwork.note.interactive import bar, controls, look, page_data, stored_data_element, symbol_html, words
from crankwork.page.sliders import LivePage, SliderDesigns, scale
from crankwork.page.trace_export import TraceExport
from crankwork.quantities import Language
from crankwork.report.assumptions import sentence_lists
from crankwork.report.display import display_key, displayed, in_own_units, key_unit, label
from crankwork.report.drawing import film_of
from crankwork.report.figures import drawings
from crankwork.report.notices import notice_text
from crankwork.report.summary import by_subject, check_status, provenance, results_method
from crankwork.show.alt_text import alt_text
from crankwork.show.animation import Animation
from crankwork.show.inline import inline_film, inline_svg
from crankwork.show.scene import Drawing


@in_own_units
def page(
    results: Results, language: Language = "en", place: Place | None = None, moved: SliderDesigns | None = None
) -> bytes:
    """Return the page of a machine, UTF-8.

    `place` returns the location of an input path in the file; `moved`: sliders of the page.
    """
    live = None if moved is None else LivePage(moved, language=language)
    drawn = drawings(results, language=language) if live is None else live.drawn
    film = film_of(results, language=language, forces=True)
    data = page_data(results, drawn, film, language)
    for name, drawing in drawn.items():
        # without script the alternative text is the title
        data["figures"][name]["told"] = alt_text(drawing)
    data["tables"] = tables(results, data, language)
    keys = dict.fromkeys([*(key for table in data["tables"] for key in table["k"]), *results.summary])
    trace = TraceExport(results, language, place or (lambda path, _: path), data["columns"])
    data["memories"] = trace.of(keys)
    marks, steps, is_filed = dict[str, list[str]](), "", False
    if live is not None:
        trace.follow(live)
        marks, steps, is_filed = follow(live, results, data)
    title, listed = html.escape(results.machine.title or "crankwork"), words("tables", language)
    parts = [
        f'<!DOCTYPE html>\n<html lang="{language}"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f'<meta name="generator" content="{html.escape(provenance(results))}"><title>{title}</title>',
        f"<style>{look()}{style('page', 'layout', *(['sliders'] if steps else []))}</style></head><body>",
        f"<header><h1>{title}</h1><p>{html.escape(results_method(results, language))}</p></header>",
        *bar(language),
        '<div class="side">',
        *([] if live is None or moved is None else _sliders(live, moved, language)),
        *([] if film is None else _machine(film, language, is_filed=is_filed)),
        *_contents(drawn, language),
        "</div><main>",
        *_figures(drawn, marks, language),
        *values(results, set(data["memories"]["keys"]), language, live),
        f'<section id="tables"><h2>{listed}</h2><p><select aria-label="{words("choice", language)}"></select></p>',
        f'<div class="scroll" tabindex="0" role="region" aria-label="{listed}"><table></table></div></section>',
        f'<p class="without">{words("without_script", language)}</p>',
        f"<footer><p>{html.escape(provenance(results))}</p></footer></main>",
        f'<aside id="explanation" tabindex="-1" hidden aria-label="{words("explanation", language)}">',
        f'<button aria-label="{words("close", language)}">×</button><div class="body"></div></aside>',
        stored_data_element(data),
        f"<script>{steps}{script('slid' if steps else 'page')}</script></body></html>\n",
    ]
    return "\n".join(parts).encode()


def _followed(live: LivePage, name: str, data: dict[str, Any]) -> list[str]:
    """Add the curves that follow the sliders to the data of a figure; return the marks of its items."""
    plots, marks, differs = live.figure(name)
    for plot, more in zip(data["plots"], plots, strict=False):
        plot.update(more)
    if differs and not plots:
        data["filed"] = True
    return marks if plots else []


def follow(live: LivePage, results: Results, data: dict[str, Any]) -> tuple[dict[str, list[str]], str, bool]:
    """Add to the page data what follows its sliders.

    Return the marks of the items of each figure, the script of the calculation, and whether the machine stays
    unchanged.
    """
    marks = {name: _followed(live, name, figure) for name, figure in data["figures"].items()}
    moves, joints = live.machine()
    columns = {key: scale(key)[0] for key in data["columns"] if live.follows(key)}
    followed = [key for key in results.summary if live.follows(key)]
    live_data, steps = live.data()
    # data() may have excluded some values
    values = {key: live.value_data(key) for key in followed if live.follows(key)}
    filed = [key for key in (*data["columns"], *results.summary) if live.differs(key) and not live.follows(key)]
    data["sliders"] = {**live_data, "columns": columns, "values": values, "filed": filed}
    if joints is not None:
        data["sliders"]["joints"] = joints
    return marks, steps, moves and joints is None


def _sliders(live: LivePage, moved: SliderDesigns, language: Language) -> list[str]:
    """Return the elements of the sliders."""
    title = words("sliders", language)
    parts = [f'<section id="sliders" aria-label="{title}"><h2>{title}</h2>']
    for index, slider in enumerate(moved.sliders):
        now, low, high = (slider.shown(value) for value in (slider.now, slider.low, slider.high))
        key = live.name(slider)
        name = html.escape(f"{capital(label(key, language))} ({slider.key})" if key else slider.key)
        unit = html.escape(unit_name(slider.unit, language))
        ends = f'min="{low!r}" max="{high!r}"'
        reach = " … ".join(number(value, language, digits=4) for value in (low, high))
        parts += [
            f'<p class="slid"><label for="move{index}">{name} <small>{reach} {unit}</small></label>',
            f'<input type="range" id="move{index}" data-field="{index}" {ends} step="any" value="{now!r}">',
            f'<input type="text" inputmode="decimal" data-box="{index}" aria-label="{name}, {unit}" size="7">',
            f"<span>{unit}</span></p>",
        ]
        if slider.stop is not None:
            stop = html.escape(_cause(slider.stop, language))
            parts.append(f'<p class="words">{words("slider_stops", language)} {stop}</p>')
    return [
        *parts,
        f'<p><button id="filed">{words("slider_back", language)}</button>',
        f' <output id="told" data-none="{words("slider_none", language)}"',
        f' data-wrong="{words("slider_wrong", language)}"></output></p>',
        f'<p class="words when">{words("slider_filed", language)}</p></section>',
    ]


def _cause(error: CrankworkError, language: Language) -> str:
    """Return why there is no machine: the first of several messages."""
    return in_language(error.problems[0].message if isinstance(error, InputError) else error.args[0], language)


def _machine(film: Animation, language: Language, *, is_filed: bool) -> list[str]:
    drawn = f"<figure>{inline_film(film, 'machine')}{''.join(controls(film, language))}</figure>"
    kind = ' class="filed"' if is_filed else ""
    return [f'<section id="machine"{kind} aria-label="{words("machine", language)}">{drawn}</section>']


def tables(results: Results, data: dict[str, Any], language: Language) -> list[dict[str, Any]]:
    """Return the columns of each table of a page."""
    listed = []
    for name, keys in results.tables.items():
        known = [key for key in keys if key in data["columns"]]
        if known:
            listed.append({"n": translate(f"tables.{name}", language), "k": [data["axis"], *known]})
    return listed


def _contents(drawn: dict[str, Drawing], language: Language) -> list[str]:
    links = [
        f'<li><a href="#figure-{name}">{html.escape(capital(drawing.title))}</a></li>'
        for name, drawing in drawn.items()
    ]
    links += [f'<li><a href="#{room}">{words(room, language)}</a></li>' for room in ("values", "tables")]
    return [f'<nav aria-label="{words("contents", language)}"><ul>', *links, "</ul></nav>"]


def _figures(drawn: dict[str, Drawing], marks: dict[str, list[str]], language: Language) -> list[str]:
    parts = [f'<section><h2>{words("diagrams", language)}</h2><div class="figures">']
    for name, drawing in drawn.items():
        caption = f"<figcaption>{html.escape(capital(drawing.title))}</figcaption>"
        picture = inline_svg(drawing, name, drawing.title, marks.get(name, ()))
        parts.append(f'<figure id="figure-{name}">{picture}{caption}</figure>')
    return [*parts, "</div></section>"]


def values(results: Results, explained: Container[str], language: Language, live: LivePage | None = None) -> list[str]:
    """Return single values, checks and notices as a section; `explained`: keys that can be explained."""
    parts = [f'<section id="values"><h2>{words("values", language)}</h2><div class="values">']
    for subject, values_of_subject in by_subject(results).items():
        rows = [
            _value_row(results, key, value, language, is_explained=key in explained, marks=_value_marks(live, key))
            for key, value in values_of_subject.items()
        ]
        parts += _small_table(translate(f"subjects.{subject}", language), rows)
    if results.checks:
        parts += _small_table(
            translate("report.checks", language), [_check_row(results, key, language) for key in results.checks]
        )
    parts.append("</div>")
    return [*parts, *sentences(results, language), "</section>"]


def sentences(results: Results, language: Language) -> Iterator[str]:
    """Yield lists of notices, assumptions and inputs without effect, as HTML."""
    notices = [notice_text(notice.code, notice.values, language) for notice in results.notices]
    lists = [(translate("report.notices", language), notices)] if notices else []
    for heading, texts in (*lists, *sentence_lists(results, language)):
        items = (f"<li>{html.escape(text)}</li>" for text in texts)
        yield "".join((f"<h3>{html.escape(heading)}</h3><ul class=filed>", *items, "</ul>"))


def _small_table(caption: str, rows: list[str]) -> list[str]:
    return [f"<table><caption>{html.escape(caption)}</caption><tbody>", *rows, "</tbody></table>"]


def _value_marks(live: LivePage | None, key: str) -> tuple[str, str]:
    """Return the attributes of a row and of its number, which follow the sliders or cannot."""
    if live is None or not live.differs(key):
        return "", ""
    return ("", f' data-value="{html.escape(key)}"') if live.follows(key) else (' class="filed"', "")


def _value_row(
    results: Results, key: str, value: float, language: Language, *, is_explained: bool, marks: tuple[str, str]
) -> str:
    name = html.escape(label(display_key(key, results), language))
    shown = number(displayed(key, value), language)
    if is_explained:
        quote = "" if key.replace("_", "").replace(".", "").isalnum() else '"'
        shown = f"<button data-key={quote}{html.escape(key)}{quote}{marks[1]}>{shown}</button>"
    elif marks[1]:
        shown = f"<span{marks[1]}>{shown}</span>"
    unit = html.escape(unit_name(key_unit(key), language))
    # HTML closes cells itself
    return f"<tr{marks[0]}><th>{name}<td>{symbol_html(value_symbol(key, language))}<td>{shown}<td>{unit}"


def _check_row(results: Results, key: str, language: Language) -> str:
    shown, status = number(results.checks[key], language, digits=2), html.escape(check_status(results, key, language))
    return f"<tr class=filed><th>{html.escape(translate(f'report.{key}', language))}<td>{shown}<td>{status}"
