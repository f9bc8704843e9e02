"""The initial page of the studio: sections, buttons and texts of its script."""

from __future__ import annotations

import html
import json

from crankwork.browser import style
from crankwork.description.machine_file import template_names, template_title
from crankwork.locale import LANGUAGES, Language, say, texts
from crankwork.note.live import bar, look
from crankwork.show.formats import FORMATS

# names of the languages in their own language
_OWN = {"en": "English", "ru": "Русский", "vi": "Tiếng Việt"}
# files that can be exported, by name
EXPORTS = ("note.pdf", "note.docx", "note.html", "page.html", "tables.xlsx", "sheets.zip", "machine.gif", "machine.svg")


def styles() -> str:
    """Return the style sheet of the studio."""
    return look() + style("page", "sliders", "studio")


def shell(language: Language) -> str:
    """Return the page of the studio in a language."""
    stored = json.dumps(dict(texts("studio", language)), ensure_ascii=False).replace("<", "\\u003c")
    return "\n".join([
        f'<!DOCTYPE html>\n<html lang="{language}"><head><meta charset="utf-8"><title>crankwork</title>',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<link rel="stylesheet" href="studio.css"><link rel="icon" href="data:,"></head><body>',
        *_header(language),
        f'<div id="bar">{"".join(bar(language))}</div>',
        f'<p id="notice" role="alert" hidden></p><script type="application/json" id="words">{stored}</script>',
        "<main>",
        *_left(language),
        f'<section id="machine" aria-label="{html.escape(say("page.machine", language))}">',
        '<div id="film"></div><output id="chip" hidden></output>',
        '<p id="turn" hidden></p>',
        f'<p class="hint">{_text("hint", language)}</p></section>',
        f'<section id="diagrams" aria-label="{html.escape(say("page.diagrams", language))}">',
        f'<select id="add" aria-label="{_text("add", language)}"></select><div class="figures"></div>',
        f'<details id="trial"><summary>{_text("vary", language)}</summary></details></section>',
        f'<section id="results" aria-label="{_text("results", language)}"></section>',
        f'<aside id="explanation" tabindex="-1" hidden aria-label="{html.escape(say("page.explanation", language))}">',
        f'<button aria-label="{html.escape(say("page.close", language))}">×</button><div class="body"></div></aside>',
        "</main>",
        f'<dialog id="commands" aria-label="{_text("commands", language)}"><input role="combobox" aria-expanded="true"',
        f' aria-controls="found" aria-autocomplete="list" aria-label="{_text("commands", language)}">',
        f'<ul id="found" role="listbox" aria-label="{_text("commands", language)}"></ul></dialog>',
        '<p id="told" role="status" class="unseen"></p>',
        '<script src="studio.js"></script></body></html>\n',
    ])  # fmt: skip


def _text(key: str, language: Language) -> str:
    return html.escape(say(f"studio.{key}", language))


def _header(language: Language) -> list[str]:
    templates = "".join(
        f'<option value="{name}">{html.escape(template_title(name, language))}' for name in template_names()
    )
    exports = "".join(f"<option>{name}" for name in EXPORTS)
    languages = "".join(
        f'<option value="{key}" lang="{key}"{" selected" if key == language else ""}>{_OWN[key]}' for key in LANGUAGES
    )
    return [
        '<header><h1 id="title">crankwork</h1>',
        f'<button id="all" aria-keyshortcuts="/" title="{_text("commands", language)}: /">',
        f'<kbd aria-hidden="true">/</kbd> <span>{_text("commands", language)}</span></button>',
        f'<select id="template" aria-label="{_text("template", language)}">',
        f'<option value="">{_text("template", language)}</option><optgroup label="{_text("recent", language)}" hidden>',
        f'</optgroup><optgroup label="{_text("examples", language)}">{templates}</optgroup></select>',
        f'<label class="button" tabindex="-1">{_text("open", language)}',
        '<input id="open" type="file" accept=".toml,.txt,.pmks,text/plain"></label>',
        *(f'<button id="{name}">{_text(name, language)}</button>' for name in ("save", "undo", "redo", "share", "pin")),
        f'<span id="pins"></span><button id="draw" aria-pressed="false">{_text("draw", language)}</button>',
        f'<select id="export" aria-label="{_text("export", language)}" data-formats="{" ".join(FORMATS)}">',
        f'<option value="">{_text("export", language)}</option>{exports}</select>',
        f'<select id="language" aria-label="{_text("language", language)}">{languages}</select></header>',
    ]


def _left(language: Language) -> list[str]:
    tabs = "".join(
        f'<button role="tab" id="{name}-tab" aria-controls="{name}" aria-selected="{chosen}">'
        f"{_text(name, language)}</button>"
        for name, chosen in (("form", "true"), ("text", "false"))
    )
    return [
        f'<section id="description" aria-label="{_text("description", language)}"><div role="tablist">{tabs}</div>',
        '<div id="form" role="tabpanel" aria-labelledby="form-tab"></div>',
        '<div id="text" role="tabpanel" aria-labelledby="text-tab" hidden><pre id="lines" aria-hidden="true"></pre>',
        f'<textarea id="source" spellcheck="false" wrap="off" aria-label="{_text("text", language)}"></textarea></div>',
        '<ul id="refusals"></ul></section>',
    ]
