"""Interactive parts of a web page of results: colours, the store of data, the bar of the cursor."""

from __future__ import annotations

import base64
import gzip
import html
import json
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.rounding_noise import without_rounding
from crankwork.analysis.vector_polygons import worked_position
from crankwork.locale import capital, translate
from crankwork.locale.numbers import unit_name
from crankwork.note.equations import value_symbol
from crankwork.quantities import Language
from crankwork.report.display import displayed_column, in_own_units, key_unit, label
from crankwork.report.figures import AT_ONE_POSITION
from crankwork.show.animation import Animation
from crankwork.show.animation import data as moving_data
from crankwork.show.inline import STYLE, colours, figure_data, html_symbol
from crankwork.show.scene import Drawing

_ENDLESS = 1e15
# how fast a film may run
_RATES = {"0.1": "1/10", "0.25": "1/4", "0.5": "1/2", "1": "1", "2": "2"}


# signs of names, which mark nothing
_SIGNS = "^{}"
_HIDDEN = {ord(sign): 0xE000 + k for k, sign in enumerate(_SIGNS)}
_SHOWN = {code: chr(sign) for sign, code in _HIDDEN.items()}


def symbol_html(symbol: str) -> str:
    """Return a symbol `base_index` as HTML, signs of names in it as they are."""
    return html_symbol(symbol.translate(_HIDDEN)).translate(_SHOWN)


def words(key: str, language: Language) -> str:
    """Return a text of the page as HTML."""
    return html.escape(translate(f"page.{key}", language))


def look() -> str:
    """Return the colours of a page: those of the screen of the reader, others by choice, and black on paper."""
    dark = colours("dark")
    return (
        f":root{{color-scheme:light dark;{colours('colour')}}}"
        f"@media(prefers-color-scheme:dark){{:root:not([data-look=light]){{{dark}}}}}"
        f":root[data-look=dark]{{{dark}}}@media print{{:root:root:root{{{colours('print')}}}}}{STYLE}"
    )


def stored_data_element(data: dict[str, Any]) -> str:
    """Return data as an element of a page, compressed."""
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":")).encode()
    return f'<script type="text/plain" id="data">{base64.b64encode(gzip.compress(text, mtime=0)).decode()}</script>'


def packed(values: Array, digits: int = 5) -> dict[str, Any]:
    """Return numbers of a column with as many decimals as give the largest that many digits.

    Integers of the last decimal, each as the difference to the one before; `x` for no number.
    """
    values = np.asarray(values, dtype=float)
    # quotients by rounding noise are no numbers either
    known = np.abs(values) < _ENDLESS
    largest = float(np.max(np.abs(values[known]), initial=0.0))
    is_whole = bool(np.all(values[known] == np.rint(values[known]))) and largest < 10.0**digits
    power = int(f"{largest:.0e}".partition("e")[2]) if largest and not is_whole else digits - 1
    decimals = min(max(digits - 1 - power, 0), 12)
    counts = np.rint(values[known] * 10.0**decimals).astype(np.int64)
    while decimals and not np.any(counts % 10):
        counts, decimals = counts // 10, decimals - 1
    steps = iter(np.diff(counts, prepend=0).tolist())
    return {"d": decimals, "v": " ".join(str(next(steps)) if is_known else "x" for is_known in known.tolist())}


def unpacked(column: Mapping[str, Any]) -> Array:
    """Return the numbers of a packed column; not a number where there is none."""
    steps = column["v"].split(" ")
    known = np.array([step != "x" for step in steps])
    values = np.full(len(steps), np.nan)
    values[known] = np.cumsum([int(step) for step in steps if step != "x"]) / 10.0 ** column["d"]
    return values


@in_own_units
def page_data(
    results: Results,
    drawn: Mapping[str, Drawing],
    film: Animation | None,
    language: Language,
    *,
    only_read: bool = False,
) -> dict[str, Any]:
    """Return the data of a page of results: columns at the rows of the tables, graphs of figures, the animation.

    `only_read`: only columns that are read at the cursor of a figure.
    """
    columns = without_rounding(results.columns, results.machine.speed)
    axis = "time" if results.period else "crank_angle"
    read = {curve for drawing in drawn.values() for plot in drawing.plots for curve in plot.curves} | {"time"}
    known = {
        key: displayed_column(key, column)
        for key, column in columns.items()
        if key != "crank_angle" and (key in read or not only_read)
    }
    rows = known.pop("time") if results.period else results.grid.degrees
    return {
        "axis": axis,
        "rows": _column(axis, rows, language),
        "columns": {key: _column(key, column, language) for key, column in known.items()},
        "figures": {name: figure_data(drawing) | _at(name, results) for name, drawing in drawn.items()},
        **({} if film is None else {"film": _film_data(film, results.period)}),
    }


def _at(name: str, results: Results) -> dict[str, float]:
    """Return where the cursor stands when a figure of one position is true, nothing for others. [deg], [s]"""
    if name not in AT_ONE_POSITION:
        return {}
    return {"at": worked_position(results) * (results.period / 360.0 if results.period else 1.0)}


def _column(key: str, values: Array, language: Language) -> dict[str, Any]:
    symbol, unit = symbol_html(value_symbol(key, language)), html.escape(unit_name(key_unit(key), language))
    return {"s": symbol, "n": html.escape(label(key, language)), "u": unit, **packed(values)}


def _film_data(film: Animation, period: float) -> dict[str, Any]:
    """Return a film for a page; `period` of the law that drives, where tables go by time. [s]"""
    data, tracks = moving_data(film), dict[str, int]()
    parts = {
        name: {
            key: [tracks.setdefault(_steps(value), len(tracks))] if isinstance(value, list) else value
            for key, value in own.items()
        }
        for name, own in data["parts"].items()
    }
    kept = {key: data[key] for key in ("angles", "seconds", "turns")}
    return kept | {"parts": parts, "tracks": list(tracks), "degrees": 360.0 / period if period else 1.0}


def _steps(track: list[float]) -> str:
    """Return hundredths by their second differences, which are small where a motion is smooth."""
    counts = np.rint(100 * np.array(track)).astype(np.int64)
    return " ".join(map(str, np.diff(np.diff(counts, prepend=0), prepend=0).tolist()))


def controls(film: Animation, language: Language) -> list[str]:
    """Return the elements that choose what of a film is seen, and how fast it runs."""
    rates = "".join(
        f'<option value="{rate}"{" selected" if rate == "1" else ""}>{shown}×' for rate, shown in _RATES.items()
    )
    listed = f'<option value="">{words("every_view", language)}' + "".join(
        f'<option value="{" ".join(f"{side:.1f}" for side in box)}">{html.escape(name)}' for name, box in film.views
    )
    views = f'<label>{words("view", language)} <select id="view">{listed}</select></label>' if film.views else ""
    parts = [
        f'<label><input type="checkbox" data-choice="{html.escape(start)}"> {html.escape(capital(name))}</label>'
        for start, name in film.choices.items()
    ]
    return [
        f'<div class="controls" role="group" aria-label="{words("controls", language)}">',
        *parts,
        f'<label><input type="checkbox" id="traces"> {words("traces", language)}</label>{views}',
        f'<label>{words("rate", language)} <select id="rate">{rates}</select></label></div>',
    ]


def bar(language: Language) -> list[str]:
    """Return the elements that move the cursor."""
    return [
        f'<div class="bar" role="region" aria-label="{words("cursor", language)}">',
        f'<button id="play" aria-pressed="false" aria-label="{words("play", language)}"></button>',
        f'<input id="slider" type="range" min="0" value="0" aria-label="{words("slider", language)}">',
        f'<output id="shown"></output><button id="look">{words("look", language)}</button></div>',
    ]


def header(title: str, language: Language, menu: Iterable[str]) -> list[str]:
    """Return the head of a page: its name, the bar of the cursor, and a menu."""
    return [
        f'<header><h1 id="title">{html.escape(title)}</h1><div id="bar">{"".join(bar(language))}</div>',
        f'<details class="menu"><summary aria-label="{words("menu", language)}">…</summary><div>',
        *menu,
        "</div></details></header>",
    ]


def drawer(language: Language) -> list[str]:
    """Return the element in which a value is explained, beside the page."""
    return [
        f'<aside id="explanation" tabindex="-1" hidden aria-label="{words("explanation", language)}">',
        f'<button aria-label="{words("close", language)}">×</button><div class="body"></div></aside>',
    ]
