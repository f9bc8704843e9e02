"""The page of a machine: one self-contained HTML file, with the calculation graph that explains its values."""

from __future__ import annotations

import html
import math
import re
from collections.abc import Container, Iterable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis import Array, Results
from crankwork.analysis.vector_polygons import worked_position
from crankwork.browser import script, style
from crankwork.errors import InputError
from crankwork.formula.calculation_lines import Explanation, FormulaLine, ValueLine, has_argument_symbol
from crankwork.formula.expression import symbol
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import (
    AngleFunction,
    Arithmetic,
    Delayed,
    FormulaCall,
    Input,
    Piecewise,
    ProcedureValue,
    Sum,
    Tabulated,
    TracedValue,
)
from crankwork.locale import capital, in_language, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.notation import ARGUMENTS, argument_unit
from crankwork.note.captions import printed_unit
from crankwork.note.closing import main_keys
from crankwork.note.equations import definition_text, shown_values, symbolic, value_symbol, value_text
from crankwork.note.explain import Place, has_own_symbol, meaning_of_argument, of_angle
from crankwork.note.interactive import (
    controls,
    drawer,
    header,
    look,
    packed,
    page_data,
    stored_data_element,
    symbol_html,
    unpacked,
    words,
)
from crankwork.note.math import mathml_box
from crankwork.page.sliders import LivePage, SliderDesigns, scale
from crankwork.quantities import QUANTITIES, Language, base_key
from crankwork.quantities.key import key_of
from crankwork.report.display import display_key, displayed, in_own_units, key_unit, label
from crankwork.report.drawing import film_of
from crankwork.report.figures import AT_ONE_POSITION, drawings, drawings_at
from crankwork.report.look import figure_title, kind_of
from crankwork.report.notices import notice_text, sentence_lists
from crankwork.report.summary import by_subject, check_status, provenance, results_method
from crankwork.show.animation import Animation
from crankwork.show.canvas import MM, SCREEN, use_layout
from crankwork.show.inline import inline_film, inline_positions, inline_svg
from crankwork.show.scene import Drawing
from crankwork.show.theme import alt_text
from crankwork.sources import cite
from crankwork.units import UNITS, to_si

# what the names of the figures of each tab have; all others are of motion
_OF_TABS = {
    "bearings": "_polar|_wear|crankpin_load",
    "balance": "balance|phase_stars|unbalanced",
    "torque": "torque|tangential|inertia|friction|moment|loops|work|speed|wittenbauer|campbell|torsional",
    "forces": "force|indicator|chambers|rod_loads|pump|lever|pressure|combustion|recorded|willans",
}
_TABS = ("motion", "forces", "torque", "bearings", "balance")
_FIRST, _FIRST_LAYOUT = ("total_torque", "torque", "torques"), SCREEN._replace(width=120 / MM, tall=0.6)
_CARDS = 6
# between positions of plans at most [deg], and how many there are at most
_WIDEST, _MOST = 15.0, 75
# angle at which formulas of all angles are written [deg]
_SOMEWHERE = 33.0
# rounding of a table, in units of the last decimal
_HALF = 0.5000001


class TraceExport:
    """The trace of some values as numbered nodes, each once, with its values at the rows of the tables."""

    def __init__(self, results: Results, language: Language, place: Place, columns: Mapping[str, Any]) -> None:
        self._columns = columns
        self._results, self._language, self._place = results, language, place
        self._explained = Explanation(TracedValue(Input(0.0)), 0.0, type(results.grid).from_degrees)
        self._nodes: list[dict[str, Any]] = []
        self._numbers: dict[tuple[int, str], int] = {}
        # nodes are identified by id(); keep references so that ids are not reused
        self._kept: list[TracedValue] = []
        self._arguments: list[str] = []
        self._formulas: dict[str, int] = {}
        self._sources: dict[str, int] = {}
        self._varying: dict[int, str] = {}
        self._degrees = results.grid.degrees
        self._unit = results.period / 360.0 if results.period else 1.0

    def of(self, keys: Iterable[str]) -> dict[str, Any]:
        """Return the nodes of values by key with all their dependencies."""
        numbers = {
            key: self._number(known, "", _SOMEWHERE)
            for key in keys
            if (known := self._results.trace.get(key)) is not None
        }
        rows, cycle = self._results.grid.degrees, self._results.machine.cycle
        # include the angles at which procedures evaluated their operands
        self._degrees = np.unique([*rows, *(item["a"] for item in self._nodes if 0 <= item.get("a", -1) <= cycle)])
        grid = type(self._results.grid).from_degrees(self._degrees)
        columns = Program({str(index): self._kept[index] for index in self._varying})(grid)
        needed = self._needed_rows(numbers)
        for index, argument in self._varying.items():
            (origin, unit), (end, _) = (self._shown(self._kept[index], argument, level) for level in (0.0, 1.0))
            values = np.where(needed[index], origin + (end - origin) * columns[str(index)], np.nan)
            name = unit_name(unit, self._language)
            node, listed = self._nodes[index], self._of_table(self._kept[index].key, values, name)
            node |= listed or {"c": {**packed(values), "u": name}}
            # the page reads symbol and name from the tables if they are equal
            for mark in ("s", "n") if listed else ():
                if node.get(mark) == self._columns[listed["k"]][mark]:
                    del node[mark]
        self._count_as_tables()
        where = f" {unit_name('s', self._language)}" if self._results.period else "°"
        return {
            "nodes": self._nodes, "formulas": list(self._formulas), "keys": numbers, "where": where,
            "rows": [round(angle * self._unit, 9) for angle in self._degrees.tolist()],
            "sources": [html.escape(cite(source)) for source in self._sources],
        }  # fmt: skip

    def follow(self, live: LivePage) -> None:
        """Add to nodes that follow the sliders their name in the calculation and the conversion to display units."""
        names, ending = live.nodes(self._kept), "time" if self._results.period else "angle"
        for node, known, argument, name in zip(self._nodes, self._kept, self._arguments, names, strict=True):
            if name:
                (origin, unit), (end, _) = (self._shown(known, argument, level) for level in (0.0, 1.0))
                node["m"] = [name, end - origin, origin, printed_unit(unit, self._language)]
            if "a" in node and live.follows(place := key_of(known.key).derived(f"_{ending}")):
                node["z"] = place

    def _of_table(self, key: str, values: Array, unit: str) -> dict[str, Any]:
        """Return the column of the tables with these values, and the values at other angles; empty if there is none."""
        column = self._columns.get(key)
        if column is None or html.escape(unit) != column["u"]:
            return {}
        scale, rows = 10.0 ** column["d"], np.isin(self._degrees, self._results.grid.degrees)
        listed, finite = unpacked(column), np.isfinite(values)
        if not np.all(np.abs(values[rows] - listed)[finite[rows]] <= _HALF / scale):
            return {}
        added = np.flatnonzero(finite & ~rows)
        counts = np.rint(values[added] * scale).astype(np.int64)
        pairs = [list(pair) for pair in zip(added.tolist(), counts.tolist(), strict=True)]
        return {"k": key, "e": pairs} if pairs else {"k": key}

    def _needed_rows(self, numbers: Mapping[str, int]) -> NDArray[np.bool_]:
        """Return which rows need each node: a branch of a piecewise column its interval only, shape (nodes, rows)."""
        degrees = self._degrees
        needed = np.zeros((len(self._nodes), len(degrees)), dtype=bool)
        tables = np.isin(degrees, self._results.grid.degrees)
        open_ends = [(root, tables) for root in numbers.values()]
        while open_ends:
            index, rows = open_ends.pop()
            fresh = rows & ~needed[index]
            if not fresh.any():
                continue
            needed[index] |= fresh
            node, start = self._nodes[index], -np.inf
            inner = degrees == node["a"] if "a" in node else fresh
            open_ends += [(operand, inner) for operand in node.get("o", ())]
            if "y" in node:
                before = (degrees[fresh] - node["y"][1]) % self._results.machine.cycle
                open_ends.append((node["y"][0], np.isclose(degrees[:, None], before, rtol=0, atol=1e-6).any(axis=1)))
            for end, law in node.get("p", ()):
                open_ends.append((law, fresh & (degrees > start) & (degrees <= end)))
                start = end
        return needed

    def _count_as_tables(self) -> None:
        """Convert angles to the coordinate of the tables, which is time for a time-based driver."""
        for node in self._nodes:
            if "a" in node:
                node["a"] = round(node["a"] * self._unit, 9)
            if "y" in node:
                node["y"][1] *= self._unit
            if "p" in node:
                node["p"] = [[end * self._unit, law] for end, law in node["p"]]

    def _number(self, known: TracedValue, argument: str, degrees: float) -> int:
        """Return the number of the node of a value under its name in this context."""
        name = known.key if known.key and not has_argument_symbol(known, argument) else argument
        mark = (id(known.node), name)
        if mark not in self._numbers:
            index = self._numbers[mark] = len(self._nodes)
            self._nodes.append({})
            self._kept.append(known)
            self._arguments.append(argument)
            made = {"s": symbol_html(self._symbol(known, name)), "n": self._name(name), **self._made(known, degrees)}
            self._nodes[index] = {key: content for key, content in made.items() if content not in ("", [])}
            if known.varies:
                self._varying[index] = argument
            else:
                value, unit = self._shown(known, argument, known.value)
                self._nodes[index]["t"] = value_text(value, unit, self._language)
        return self._numbers[mark]

    def _made(self, known: TracedValue, degrees: float) -> dict[str, Any]:
        """Return the data of a node: how its value is calculated."""
        match known.node:
            case Piecewise(ends=ends):
                return {"p": self._laws(known, ends)}
            case Delayed(of=traced, by=shift):
                return {"y": [self._number(traced, "", degrees), shift]}
            case Input(path=path, unit=unit) if not known.varies:
                si = float(to_si(known.value, unit)) if unit in UNITS else known.value
                return {
                    "g": self._place(path, (known.value, si)) if path else translate("explain.taken", self._language)
                }
            case FormulaCall() | Arithmetic() | Sum():
                return {**self._line(known, degrees), "o": self._operands(known, degrees)}
            case ProcedureValue(word="sine" | "cosine"):
                return {"o": self._operands(known, degrees)}
            case ProcedureValue(word=word, at=angle):
                defined = definition_text(known.key, self._language) if known.key else ""
                words = "; ".join(text for text in (defined, translate(f"memory.{word}", self._language)) if text)
                return {"w": words, "o": self._operands(known, degrees), **({} if angle is None else {"a": angle})}
            case Tabulated(word=word):
                return {"w": translate(f"memory.{word}", self._language), "o": self._operands(known, degrees)}
            case AngleFunction(function=function):
                description = {"w": translate("memory.taken_at", self._language)}
                return description if function == "angle" or has_own_symbol(known) else {"n": "", **description}
        return {"o": self._operands(known, degrees)}

    def _line(self, known: TracedValue, degrees: float) -> dict[str, int]:
        """Return the formula of a value in symbols, and its source."""
        step = self._explained.moment(degrees).step(known)
        box = symbolic(step, self._language)
        source = step.formula.source.partition(",")[0] if isinstance(step, FormulaLine) else ""
        line = {"q": self._sources.setdefault(source, len(self._sources))} if source else {}
        if box is not None:
            line["f"] = self._formulas.setdefault(mathml_box(box), len(self._formulas))
        return line

    def _laws(self, known: TracedValue, ends: Array) -> list[list[float]]:
        """Return the end [deg] and the number of each branch of a piecewise value."""
        edges = [0.0, *ends.tolist(), self._results.machine.cycle]
        laws = zip(known.node.operands, edges[:-1], edges[1:], strict=False)
        return [[end, self._number(law, "" if law.key else known.key, (start + end) / 2)] for law, start, end in laws]

    def _operands(self, known: TracedValue, degrees: float) -> list[int]:
        operands = self._explained.written(known, degrees)
        return list(dict.fromkeys(self._number(operand, argument, angle) for operand, angle, argument in operands))

    def _symbol(self, known: TracedValue, name: str) -> str:
        node = known.node
        if isinstance(node, AngleFunction) and not has_own_symbol(known):
            return of_angle(node.function, node.multiple, node.shift, self._language)
        if name in ARGUMENTS and name != known.key:
            return symbol(name, self._language)
        return value_symbol(name, self._language) if name else "?"

    def _name(self, name: str) -> str:
        if base_key(key_of(name).quantity) in QUANTITIES:
            return label(name, self._language)
        return meaning_of_argument(name, self._language)[1]

    def _shown(self, known: TracedValue, argument: str, value: float) -> tuple[float, str]:
        """Return a value in its printed unit, and the unit."""
        if isinstance(known.node, Input) and known.node.unit:
            return value, known.node.unit
        if known.key and base_key(known.key) in QUANTITIES:
            return shown_values(ValueLine(known.key, value))[-1]
        return value, argument_unit(argument) if argument in ARGUMENTS else ""


@in_own_units
@use_layout(SCREEN)
def page(
    results: Results, language: Language = "en", place: Place | None = None, moved: SliderDesigns | None = None
) -> bytes:
    """Return the page of a machine, UTF-8.

    `place` returns the location of an input path in the file; `moved`: sliders of the page.
    """
    live = None if moved is None else LivePage(moved, language=language)
    drawn = drawings(results, language=language) if live is None else live.drawn
    film = film_of(results, language=language, forces=True)
    # beside the machine there is room for one
    first = "" if film is None or live else next((name for name in _FIRST if name in drawn), "")
    if first:
        with use_layout(_FIRST_LAYOUT):
            drawn |= drawings(results, language=language, only={first})
    data = page_data(results, drawn, film, language)
    pictures = _positions(results, data["figures"], language, is_still=live is None)
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
    figures = _figures(drawn, pictures, marks, language)
    first_figure = figures.pop(first, "")
    title, listed = title_of(results, language), words("tables", language)
    explained = set(data["memories"]["keys"])
    parts = [
        f'<!DOCTYPE html>\n<html lang="{language}"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f'<meta name="generator" content="{html.escape(provenance(results))}"><title>{html.escape(title)}</title>',
        f"<style>{look()}{style('design', 'layout', *(['sliders'] if steps else []))}</style></head><body>",
        *header(title, language, _contents(drawn, language)),
        '<main><div class="first">',
        *([] if film is None else _machine(film, language, is_filed=is_filed)),
        '<div class="side">',
        *cards(results, explained, language, live),
        *([first_figure] if live is None or moved is None else _sliders(live, moved, language)),
        "</div></div>",
        *_panels(figures, language),
        *values(results, explained, language, live),
        f'<section id="tables"><h3>{listed}</h3><p><select aria-label="{words("choice", language)}"></select></p>',
        f'<div class="scroll" tabindex="0" role="region" aria-label="{listed}"><table></table></div></section>',
        f'</section><p class="without">{words("without_script", language)}</p>',
        f"<footer><p>{html.escape(provenance(results, results_method(results, language)))}</p></footer>",
        "</main>",
        *drawer(language),
        stored_data_element(data),
        f"<script>{steps}{script('slid' if steps else 'page')}</script></body></html>\n",
    ]
    return "\n".join(parts).encode()


def _positions(results: Results, figures: dict[str, Any], language: Language, *, is_still: bool) -> dict[str, str]:
    """Add what figures of one position show at others to their data; return their pictures.

    `is_still`: whether no slider moves curves.
    """
    if AT_ONE_POSITION.isdisjoint(figures):
        return {}
    rows = results.grid.degrees
    # between rows that are far apart machines move visibly
    parts = math.ceil(max(float(np.max(np.diff(rows), initial=0.0)) / _WIDEST, 1e-9))
    counts = np.arange(parts * (len(rows) - 1) + 1) / parts
    worked = worked_position(results)
    degrees = np.union1d(np.interp(counts, np.arange(len(rows)), rows)[:: math.ceil(len(counts) / _MOST)], worked)
    pictures = {}
    places = (degrees * (results.period / 360.0 if results.period else 1.0)).tolist()
    names = [name for name in figures if name in AT_ONE_POSITION or (is_still and kind_of(name) == "paths")]
    for name, drawn in drawings_at(results, degrees, language, names).items():
        row, about = int(np.searchsorted(degrees, worked)), figure_title(name, language)
        pictures[name], inside = inline_positions(drawn, name, about, row)
        figures[name].pop("at", None)
        figures[name] |= {"places": places, "shown": inside}
    return pictures


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
    names = [capital(label(key, language)) if (key := live.name(slider)) else slider.key for slider in moved.sliders]
    for index, (slider, own) in enumerate(zip(moved.sliders, names, strict=True)):
        now, low, high = (slider.shown(value) for value in (slider.now, slider.low, slider.high))
        name = html.escape(own if names.count(own) == 1 else f"{own} ({slider.key})")
        unit = html.escape(unit_name(slider.unit, language))
        ends = f'min="{low!r}" max="{high!r}"'
        reach = "".join(f"<small>{number(value, language, digits=4)}</small>" for value in (low, high))
        parts += [
            f'<p class="slid"><label for="move{index}" title="{html.escape(slider.key)}">{name}</label>',
            f'<input type="range" id="move{index}" data-field="{index}" {ends} step="any" value="{now!r}">',
            f'<input type="text" inputmode="decimal" data-box="{index}" aria-label="{name}, {unit}" size="7">',
            f"<span>{unit}</span>{reach}</p>",
        ]
        if slider.stop is not None:
            # the first of several mistakes
            cause = slider.stop.problems[0].message if isinstance(slider.stop, InputError) else slider.stop.args[0]
            stop = html.escape(in_language(cause, language))
            parts.append(f'<p class="words">{words("slider_stops", language)} {stop}</p>')
    return [
        *parts,
        f'<p><button id="filed">{words("slider_back", language)}</button>',
        f' <output id="told" data-none="{words("slider_none", language)}"',
        f' data-wrong="{words("slider_wrong", language)}"></output></p>',
        f'<p class="words when">{words("slider_filed", language)}</p></section>',
    ]


def _machine(film: Animation, language: Language, *, is_filed: bool) -> list[str]:
    drawn = f"<figure>{inline_film(film, 'machine')}{''.join(controls(film, language))}</figure>"
    kind = ' class="filed"' if is_filed else ""
    return [f'<section id="machine"{kind} aria-label="{words("machine", language)}">{drawn}</section>']


def tables(results: Results, data: dict[str, Any], language: Language) -> list[dict[str, Any]]:
    """Return the columns of each table of a page."""
    return [
        {"n": translate(f"tables.{name}", language), "k": [data["axis"], *known]}
        for name, keys in results.tables.items()
        if (known := [key for key in keys if key in data["columns"]])
    ]


def _contents(drawn: dict[str, Drawing], language: Language) -> list[str]:
    links = [
        f'<li><a href="#figure-{name}">{html.escape(capital(drawing.title))}</a></li>'
        for name, drawing in drawn.items()
    ]
    links += [f'<li><a href="#{room}">{words(room, language)}</a></li>' for room in ("values", "tables")]
    return [f'<nav aria-label="{words("contents", language)}"><ul>', *links, "</ul></nav>"]


def title_of(results: Results, language: Language) -> str:
    """Return the name of a machine in a language, or as its file has it."""
    own = getattr(results.machine.document, f"title_{language}")
    return own or results.machine.title or "crankwork"


def _figures(
    drawn: dict[str, Drawing], pictures: Mapping[str, str], marks: dict[str, list[str]], language: Language
) -> dict[str, str]:
    """Return figures as elements by name."""
    figures = {}
    for name, drawing in drawn.items():
        title = figure_title(name, language) if name in pictures else drawing.title
        caption = f"<figcaption>{html.escape(capital(title))}</figcaption>"
        picture = pictures.get(name) or inline_svg(drawing, name, title, marks.get(name, ()))
        figures[name] = f'<figure id="figure-{name}">{picture}{caption}</figure>'
    return figures


def _panels(figures: dict[str, str], language: Language) -> list[str]:
    """Return the tabs, the panels of those that have figures, and the beginning of that of the values."""
    panels: dict[str, list[str]] = {tab: [] for tab in _TABS}
    for name, figure in figures.items():
        panels[next((tab for tab, names in _OF_TABS.items() if re.search(names, name)), "motion")].append(figure)
    ends = {tab: f'<div class="figures">{"".join(all_)}</div></section>' for tab, all_ in panels.items() if all_}
    tabs, parts = [f'<div role="tablist" aria-label="{words("diagrams", language)}">'], ["</div>"]
    for tab, inside in (*ends.items(), ("all", "")):
        shown = words(f"tab_{tab}", language)
        tabs.append(f'<button role="tab" id="tab-{tab}" aria-controls="panel-{tab}">{shown}</button>')
        parts.append(f'<section role="tabpanel" id="panel-{tab}" aria-labelledby="tab-{tab}"><h2>{shown}</h2>{inside}')
    return tabs + parts


def cards(results: Results, explained: Container[str], language: Language, live: LivePage | None = None) -> list[str]:
    """Return the six single values that matter most."""
    further = (key for key in results.summary if not key_of(key).quantity.endswith(("_angle", "_time")))
    keys = list(dict.fromkeys([*main_keys(results), *further]))[:_CARDS]
    parts = [f'<dl class="cards" aria-label="{words("results", language)}">']
    for key in keys:
        name, unit = capital(label(display_key(key, results), language)), unit_name(key_unit(key), language)
        value = float(f"{displayed(key, results.summary[key]):.4g}")
        shown, marks = _shown_value(key, number(value, language), explained, live), _value_marks(live, key)[0]
        parts.append(f"<div{marks}><dt>{html.escape(name)}</dt><dd>{shown} {html.escape(unit)}</dd></div>")
    return [*parts, "</dl>"]


def values(results: Results, explained: Container[str], language: Language, live: LivePage | None = None) -> list[str]:
    """Return single values, checks and notices as a section; `explained`: keys that can be explained."""
    parts = ['<section id="values"><div class="values">']
    for subject, values_of_subject in by_subject(results).items():
        rows = [_value_row(results, key, value, language, explained, live) for key, value in values_of_subject.items()]
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


def _shown_value(key: str, shown: str, explained: Container[str], live: LivePage | None) -> str:
    """Return a number as an element that is pressed to explain it, if it can be explained."""
    mark = _value_marks(live, key)[1]
    if key in explained:
        quote = "" if key.replace("_", "").replace(".", "").isalnum() else '"'
        return f"<button data-key={quote}{html.escape(key)}{quote}{mark}>{shown}</button>"
    return f"<span{mark}>{shown}</span>" if mark else shown


def _value_row(
    results: Results, key: str, value: float, language: Language, explained: Container[str], live: LivePage | None
) -> str:
    name = html.escape(label(display_key(key, results), language))
    shown = _shown_value(key, number(displayed(key, value), language), explained, live)
    unit = html.escape(unit_name(key_unit(key), language))
    # HTML closes cells itself
    sign = symbol_html(value_symbol(key, language))
    return f"<tr{_value_marks(live, key)[0]}><th>{name}<td>{sign}<td>{shown}<td>{unit}"


def _check_row(results: Results, key: str, language: Language) -> str:
    shown, status = number(results.checks[key], language, digits=2), html.escape(check_status(results, key, language))
    return f"<tr class=filed><th>{html.escape(translate(f'report.{key}', language))}<td>{shown}<td>{status}"
