"""The page of a machine: one file that needs no server and asks for nothing else."""

from __future__ import annotations

import html
from collections.abc import Container
from typing import Any

from crankwork.analysis import Results
from crankwork.browser import script, style
from crankwork.locale import capital, say
from crankwork.locale.numbers import number, unit_name
from crankwork.note.equations import value_symbol
from crankwork.note.explain import Place
from crankwork.note.live import bar, controls, look, page_data, stored, symbol_html, words
from crankwork.page.memories import Memories
from crankwork.quantities import Language
from crankwork.report.drawing import film_of
from crankwork.report.figures import drawings
from crankwork.report.language import displayed, in_own_units, key_unit, label, told_as
from crankwork.report.notices import notice_text
from crankwork.report.summary import by_subject, met, provenance, results_method
from crankwork.show.alt import described
from crankwork.show.inline import inline_film, inline_svg
from crankwork.show.moving import MovingDrawing
from crankwork.show.scene import Drawing


@in_own_units
def page(results: Results, language: Language = "en", place: Place | None = None) -> bytes:
    """Return the page of a machine, UTF-8; `place` says where a value stands that comes from a path of its file."""
    drawn = drawings(results, language=language)
    film = film_of(results, language=language, forces=True)
    data = page_data(results, drawn, film, language)
    for name, one in drawn.items():
        # without script a figure is called by its title
        data["figures"][name]["told"] = described(one)
    data["tables"] = tables(results, data, language)
    keys = dict.fromkeys([*(key for one in data["tables"] for key in one["k"]), *results.summary])
    data["memories"] = Memories(results, language, place or (lambda path, _: path), data["columns"]).of(keys)
    title = html.escape(results.machine.title or "crankwork")
    parts = [
        f'<!DOCTYPE html>\n<html lang="{language}"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f'<meta name="generator" content="{html.escape(provenance(results))}"><title>{title}</title>',
        f"<style>{look()}{style('page', 'layout')}</style></head><body>",
        f"<header><h1>{title}</h1><p>{html.escape(results_method(results, language))}</p></header>",
        *bar(language),
        '<div class="side">',
        *([] if film is None else _machine(film, language)),
        *_contents(drawn, language),
        "</div><main>",
        *_figures(drawn, language),
        *values(results, set(data["memories"]["keys"]), language),
        *_table_room(language),
        f"<footer><p>{html.escape(provenance(results))}</p></footer></main>",
        *_explanation_room(language),
        stored(data),
        f"<script>{script('page')}</script></body></html>\n",
    ]
    return "\n".join(parts).encode()


def _machine(film: MovingDrawing, language: Language) -> list[str]:
    drawn = f"<figure>{inline_film(film, 'machine')}{''.join(controls(film, language))}</figure>"
    return [f'<section id="machine" aria-label="{words("machine", language)}">{drawn}</section>']


def tables(results: Results, data: dict[str, Any], language: Language) -> list[dict[str, Any]]:
    """Return which columns each table of a page has."""
    found = []
    for name, keys in results.tables.items():
        known = [key for key in keys if key in data["columns"]]
        if known:
            found.append({"n": say(f"tables.{name}", language), "k": [data["axis"], *known]})
    return found


def _contents(drawn: dict[str, Drawing], language: Language) -> list[str]:
    links = [f'<li><a href="#figure-{name}">{html.escape(capital(one.title))}</a></li>' for name, one in drawn.items()]
    links += [f'<li><a href="#{room}">{words(room, language)}</a></li>' for room in ("values", "tables")]
    return [f'<nav aria-label="{words("contents", language)}"><ul>', *links, "</ul></nav>"]


def _figures(drawn: dict[str, Drawing], language: Language) -> list[str]:
    parts = [f'<section><h2>{words("diagrams", language)}</h2><div class="figures">']
    for name, one in drawn.items():
        told = f"<figcaption>{html.escape(capital(one.title))}</figcaption>"
        parts.append(f'<figure id="figure-{name}">{inline_svg(one, name, one.title)}{told}</figure>')
    return [*parts, "</div></section>"]


def values(results: Results, explained: Container[str], language: Language) -> list[str]:
    """Return single values, checks and notices as a section; `explained`: those that a click explains."""
    parts = [f'<section id="values"><h2>{words("values", language)}</h2><div class="values">']
    for subject, found in by_subject(results).items():
        rows = [_value_row(results, key, one, language, is_explained=key in explained) for key, one in found.items()]
        parts += _small_table(say(f"subjects.{subject}", language), rows)
    if results.checks:
        parts += _small_table(
            say("report.checks", language), [_check_row(results, key, language) for key in results.checks]
        )
    parts.append("</div>")
    if results.notices:
        told = (html.escape(notice_text(one.code, one.values, language)) for one in results.notices)
        parts += [f"<h3>{html.escape(say('report.notices', language))}</h3><ul>", *(f"<li>{one}</li>" for one in told)]
        parts.append("</ul>")
    return [*parts, "</section>"]


def _small_table(caption: str, rows: list[str]) -> list[str]:
    return [f"<table><caption>{html.escape(caption)}</caption><tbody>", *rows, "</tbody></table>"]


def _value_row(results: Results, key: str, value: float, language: Language, *, is_explained: bool) -> str:
    name = html.escape(label(told_as(key, results), language))
    shown = number(displayed(key, value), language)
    if is_explained:
        quote = "" if key.replace("_", "").replace(".", "").isalnum() else '"'
        shown = f"<button data-key={quote}{html.escape(key)}{quote}>{shown}</button>"
    unit = html.escape(unit_name(key_unit(key), language))
    # a table needs no ends of its cells
    return f"<tr><th>{name}<td>{symbol_html(value_symbol(key, language))}<td>{shown}<td>{unit}"


def _check_row(results: Results, key: str, language: Language) -> str:
    shown, told = number(results.checks[key], language, digits=2), html.escape(met(results, key, language))
    return f"<tr><th>{html.escape(say(f'report.{key}', language))}<td>{shown}<td>{told}"


def _table_room(language: Language) -> list[str]:
    title = words("tables", language)
    return [
        f'<section id="tables"><h2>{title}</h2><p><select aria-label="{words("choice", language)}"></select></p>',
        f'<div class="scroll" tabindex="0" role="region" aria-label="{title}"><table></table></div></section>',
        f'<p class="without">{words("without_script", language)}</p>',
    ]


def _explanation_room(language: Language) -> list[str]:
    return [
        f'<aside id="explanation" tabindex="-1" hidden aria-label="{words("explanation", language)}">',
        f'<button aria-label="{words("close", language)}">×</button><div class="body"></div></aside>',
    ]
