"""Export of the calculation graph to a page, which explains values step by step."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crankwork.analysis import Array, Results
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
from crankwork.locale import translate
from crankwork.locale.numbers import unit_name
from crankwork.notation import ARGUMENTS, argument_unit
from crankwork.note.definitions import definition_text
from crankwork.note.equations import shown_values, symbolic, value_symbol, value_text
from crankwork.note.explain import Place, has_own_symbol, meaning_of_argument, of_angle
from crankwork.note.interactive import packed, symbol_html, unpacked
from crankwork.note.mathml import mathml_box
from crankwork.note.printed_units import printed_unit
from crankwork.page.sliders import LivePage
from crankwork.quantities import QUANTITIES, Language, base_key
from crankwork.quantities.key import key_of
from crankwork.report.display import label
from crankwork.sources import cite
from crankwork.units import UNITS, to_si

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
        for number, argument in self._varying.items():
            (origin, unit), (end, _) = (self._shown(self._kept[number], argument, level) for level in (0.0, 1.0))
            values = np.where(needed[number], origin + (end - origin) * columns[str(number)], np.nan)
            name = unit_name(unit, self._language)
            node, listed = self._nodes[number], self._of_table(self._kept[number].key, values, name)
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
            number, rows = open_ends.pop()
            fresh = rows & ~needed[number]
            if not fresh.any():
                continue
            needed[number] |= fresh
            node, start = self._nodes[number], -np.inf
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
            number = self._numbers[mark] = len(self._nodes)
            self._nodes.append({})
            self._kept.append(known)
            self._arguments.append(argument)
            made = {"s": symbol_html(self._symbol(known, name)), "n": self._name(name), **self._made(known, degrees)}
            self._nodes[number] = {key: content for key, content in made.items() if content not in ("", [])}
            if known.varies:
                self._varying[number] = argument
            else:
                value, unit = self._shown(known, argument, known.value)
                self._nodes[number]["t"] = value_text(value, unit, self._language)
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
