"""The page of a machine: one file that needs no server and asks for nothing else."""

from __future__ import annotations

import html
from collections.abc import Container
from typing import Any

from crankwork.analysis import Results
from crankwork.browser import script, style
from crankwork.errors import CrankworkError, InputError
from crankwork.locale import capital, say, told
from crankwork.locale.numbers import number, unit_name
from crankwork.note.equations import value_symbol
from crankwork.note.explain import Place
from crankwork.note.live import bar, controls, look, page_data, stored, symbol_html, words
from crankwork.page.memories import Memories
from crankwork.page.sliders import Live, Moved, scale
from crankwork.quantities import Language
from crankwork.report.drawing import film_of
from crankwork.report.figures import drawings
from crankwork.report.language import displayed, in_own_units, key_unit, label, told_as
from crankwork.report.notices import notice_text
from crankwork.report.summary import by_subject, met, provenance, results_method
from crankwork.show.alt import alt_text
from crankwork.show.inline import inline_film, inline_svg
from crankwork.show.moving import Animation
from crankwork.show.scene import Drawing


@in_own_units
def page(results: Results, language: Language = "en", place: Place | None = None, moved: Moved | None = None) -> bytes:
    """Return the page of a machine, UTF-8.

    `place` says where a value stands that comes from a path of its file; `moved`: what its reader may move.
    """
    live = None if moved is None else Live(moved, language=language)
    drawn = drawings(results, language=language) if live is None else live.drawn
    film = film_of(results, language=language, forces=True)
    data = page_data(results, drawn, film, language)
    for name, one in drawn.items():
        # without script a figure is called by its title
        data["figures"][name]["told"] = alt_text(one)
    data["tables"] = tables(results, data, language)
    keys = dict.fromkeys([*(key for one in data["tables"] for key in one["k"]), *results.summary])
    memories = Memories(results, language, place or (lambda path, _: path), data["columns"])
    data["memories"] = memories.of(keys)
    marks, steps, is_filed = dict[str, list[str]](), "", False
    if live is not None:
        memories.follow(live)
        marks, steps, is_filed = follow(live, results, data)
    title = html.escape(results.machine.title or "crankwork")
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
        *_table_room(language),
        f"<footer><p>{html.escape(provenance(results))}</p></footer></main>",
        *_explanation_room(language),
        stored(data),
        f"<script>{steps}{script('slid' if steps else 'page')}</script></body></html>\n",
    ]
    return "\n".join(parts).encode()


def _followed(live: Live, name: str, data: dict[str, Any]) -> list[str]:
    """Say in the data of a figure which curves follow the sliders; return what becomes of its items."""
    plots, marks, differs = live.figure(name)
    for one, more in zip(data["plots"], plots, strict=False):
        one.update(more)
    if differs and not plots:
        data["filed"] = True
    return marks if plots else []


def follow(live: Live, results: Results, data: dict[str, Any]) -> tuple[dict[str, list[str]], str, bool]:
    """Say in the data of a page what follows its sliders, and by what.

    Return what becomes of the items of each figure, the steps of the calculation, whether the machine stays behind.
    """
    marks = {name: _followed(live, name, one) for name, one in data["figures"].items()}
    moves, joints = live.machine()
    columns = {key: scale(key)[0] for key in data["columns"] if live.follows(key)}
    followed = [key for key in results.summary if live.follows(key)]
    found, steps = live.data()
    # of which some were found wrong
    values = {key: live.value_data(key) for key in followed if live.follows(key)}
    filed = [key for key in (*data["columns"], *results.summary) if live.differs(key) and not live.follows(key)]
    data["sliders"] = {**found, "columns": columns, "values": values, "filed": filed}
    if joints is not None:
        data["sliders"]["joints"] = joints
    return marks, steps, moves and joints is None


def _sliders(live: Live, moved: Moved, language: Language) -> list[str]:
    """Return the elements by which a reader states numbers of the machine file."""
    title = words("sliders", language)
    parts = [f'<section id="sliders" aria-label="{title}"><h2>{title}</h2>']
    for at, one in enumerate(moved.sliders):
        now, low, high = (one.shown(value) for value in (one.now, one.low, one.high))
        key = live.name(one)
        name = html.escape(f"{capital(label(key, language))} ({one.key})" if key else one.key)
        unit = html.escape(unit_name(one.unit, language))
        ends = f'min="{low!r}" max="{high!r}"'
        reach = " … ".join(number(value, language, digits=4) for value in (low, high))
        parts += [
            f'<p class="slid"><label for="move{at}">{name} <small>{reach} {unit}</small></label>',
            f'<input type="range" id="move{at}" data-field="{at}" {ends} step="any" value="{now!r}">',
            f'<input type="text" inputmode="decimal" data-box="{at}" aria-label="{name}, {unit}" size="7">',
            f"<span>{unit}</span></p>",
        ]
        if one.stop is not None:
            stop = html.escape(_cause(one.stop, language))
            parts.append(f'<p class="words">{words("slider_stops", language)} {stop}</p>')
    return [
        *parts,
        f'<p><button id="filed">{words("slider_back", language)}</button>',
        f' <output id="told" data-none="{words("slider_none", language)}"',
        f' data-wrong="{words("slider_wrong", language)}"></output></p>',
        f'<p class="words when">{words("slider_filed", language)}</p></section>',
    ]


def _cause(error: CrankworkError, language: Language) -> str:
    """Return why there is no machine: of several mistakes the first."""
    return told(error.problems[0].message if isinstance(error, InputError) else error.args[0], language)


def _machine(film: Animation, language: Language, *, is_filed: bool) -> list[str]:
    drawn = f"<figure>{inline_film(film, 'machine')}{''.join(controls(film, language))}</figure>"
    kind = ' class="filed"' if is_filed else ""
    return [f'<section id="machine"{kind} aria-label="{words("machine", language)}">{drawn}</section>']


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


def _figures(drawn: dict[str, Drawing], marks: dict[str, list[str]], language: Language) -> list[str]:
    parts = [f'<section><h2>{words("diagrams", language)}</h2><div class="figures">']
    for name, one in drawn.items():
        told = f"<figcaption>{html.escape(capital(one.title))}</figcaption>"
        parts.append(
            f'<figure id="figure-{name}">{inline_svg(one, name, one.title, marks.get(name, ()))}{told}</figure>'
        )
    return [*parts, "</div></section>"]


def values(results: Results, explained: Container[str], language: Language, live: Live | None = None) -> list[str]:
    """Return single values, checks and notices as a section; `explained`: those that a click explains."""
    parts = [f'<section id="values"><h2>{words("values", language)}</h2><div class="values">']
    for subject, found in by_subject(results).items():
        rows = [
            _value_row(results, key, one, language, is_explained=key in explained, marks=_value_marks(live, key))
            for key, one in found.items()
        ]
        parts += _small_table(say(f"subjects.{subject}", language), rows)
    if results.checks:
        parts += _small_table(
            say("report.checks", language), [_check_row(results, key, language) for key in results.checks]
        )
    parts.append("</div>")
    if results.notices:
        told = (html.escape(notice_text(one.code, one.values, language)) for one in results.notices)
        parts += [
            f"<h3>{html.escape(say('report.notices', language))}</h3><ul class=filed>",
            *(f"<li>{one}</li>" for one in told),
        ]
        parts.append("</ul>")
    return [*parts, "</section>"]


def _small_table(caption: str, rows: list[str]) -> list[str]:
    return [f"<table><caption>{html.escape(caption)}</caption><tbody>", *rows, "</tbody></table>"]


def _value_marks(live: Live | None, key: str) -> tuple[str, str]:
    """Return what a row and the number in it are marked with: that it follows the sliders, or cannot."""
    if live is None or not live.differs(key):
        return "", ""
    return ("", f' data-value="{html.escape(key)}"') if live.follows(key) else (' class="filed"', "")


def _value_row(
    results: Results, key: str, value: float, language: Language, *, is_explained: bool, marks: tuple[str, str]
) -> str:
    name = html.escape(label(told_as(key, results), language))
    shown = number(displayed(key, value), language)
    if is_explained:
        quote = "" if key.replace("_", "").replace(".", "").isalnum() else '"'
        shown = f"<button data-key={quote}{html.escape(key)}{quote}{marks[1]}>{shown}</button>"
    elif marks[1]:
        shown = f"<span{marks[1]}>{shown}</span>"
    unit = html.escape(unit_name(key_unit(key), language))
    # a table needs no ends of its cells
    return f"<tr{marks[0]}><th>{name}<td>{symbol_html(value_symbol(key, language))}<td>{shown}<td>{unit}"


def _check_row(results: Results, key: str, language: Language) -> str:
    shown, told = number(results.checks[key], language, digits=2), html.escape(met(results, key, language))
    return f"<tr class=filed><th>{html.escape(say(f'report.{key}', language))}<td>{shown}<td>{told}"


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
