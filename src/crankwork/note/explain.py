"""One value explained as text: the value, every line of its calculation in order, and what was given."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple

from crankwork.analysis.results import Results
from crankwork.description.document import Origin
from crankwork.formula.calculation_lines import (
    ExplainedValue,
    Explanation,
    FormulaLine,
    Line,
    SumLine,
    ValueLine,
    has_argument_symbol,
    is_given,
    without_noise,
)
from crankwork.formula.expression import symbol
from crankwork.formula.traced_value import (
    AngleFunction,
    AngleUnwrap,
    Arithmetic,
    Component,
    Delayed,
    FormulaCall,
    Input,
    ProcedureValue,
    Sum,
    Tabulated,
    TracedValue,
)
from crankwork.locale import capital, has_text, texts, translate
from crankwork.locale.numbers import number
from crankwork.mechanism.joints import joints, names_of_pivots
from crankwork.mechanism.linkage import GROUND
from crankwork.notation import ARGUMENTS, argument_unit
from crankwork.note.captions import printed_unit
from crankwork.note.equations import (
    OF_LINKS,
    definition_text,
    distinct_values,
    integral_text,
    line_parts,
    shown_values,
    value_symbol,
    value_text,
)
from crankwork.note.legends import words_of
from crankwork.note.numbering import Numbering
from crankwork.quantities import QUANTITIES, SUBJECTS, Language, base_key
from crankwork.quantities.key import key_of
from crankwork.report.display import display_key, in_own_units, label, link_label
from crankwork.sources import cite
from crankwork.units import UNITS, from_si, to_si

_OF_ANGLE = re.compile(r"^(sin|cos|tan) ?")
_OF_CYCLE = frozenset(row.key for row in SUBJECTS["cycle"])
_OWNERS = {"stroke": "of_piston"}
# what is found of the whole course of a column, and how many rows of that are told at most [deg]
_IN_JOINTS = ("joint_force", "joint_force_x", "joint_force_y")
_OVER_CYCLE = ("mean", "harmonic_mean", "integral", "fourier", "range")
_COARSE, _FEWEST, _MOST = 30.0, 5, 25
_FENCES = re.compile(r"[() ]")


# what says where a value stands: of its path, and its number in SI and in the units it is printed in
Place = Callable[[str, Iterable[float]], str]


@in_own_units
def explanation(
    results: Results, key: str, at: float | None = None, language: Language = "en", place: Place = lambda path, _: path
) -> str:
    """Return how a value came about, line by line down to what is given.

    Parameters
    ----------
    results : Results
        Results of an analysis.
    key : str
        Key of a column, of a single value, or of what lies between them.
    at : float, optional
        Crank angle of what varies, or the time where a law drives. [deg] or [s]
    language : str
        `en`, `ru` or `vi`.
    place : callable, optional
        Says where a value comes from that is said to stand at a path of the machine file.

    Returns
    -------
    str
        The value, every step in the order of calculation, and the given values.

    Raises
    ------
    CrankworkError
        As `Results.value` does.
    """
    key = results.current(key)
    results = results.holding(key)
    value = results.value(key, at)
    known = results.trace.get(key)
    degrees, places = 0.0 if at is None else results.degrees_of(at), _Places(results.period, language)
    is_constant = known is not None and not known.varies
    explained = None if known is None else Explanation(known, degrees, type(results.grid).from_degrees)
    if known is not None and explained is not None and explained.moment(None).is_noise(known):
        value = 0.0
    where = "" if at is None or is_constant else f"({places(degrees)})"
    shown = " = ".join([f"{value_symbol(display_key(key, results), language)}{where}", *_values(key, value, language)])
    head = [f"{capital(label(display_key(key, results), language)) if base_key(key) in QUANTITIES else key}: {shown}"]
    head += list(_acting(key, results, language))
    if explained is None:
        return "\n".join([*head, "", translate("explain.no_memory", language)]) + "\n"
    return "\n".join([*head, *_Printed(explained, places, place, _shown_rows(results))]) + "\n"


def _acting(key: str, results: Results, language: Language) -> Iterator[str]:
    """Yield on which link a force in a joint acts, and from which one."""
    kind, name = key_of(key)
    if kind not in _IN_JOINTS or results.machine.linkage is None:
        return
    mechanism = results.machine.mechanism
    pivots = names_of_pivots(mechanism)
    joint = next((item for item in joints(mechanism) if pivots.get(item.name, item.name) == name), None)
    if joint is not None:
        link, other = (link_label(item, language) for item in (joint.link, joint.other))
        text = "explain.acts_from_frame" if joint.other == GROUND else "explain.acts_from_link"
        yield translate(text, language, link=link, other=other)


@in_own_units
def key_lines(results: Results, language: Language = "en") -> list[str]:
    """Return the keys of results, each with its name; a column has its sign of varying with the crank angle."""
    keys = dict.fromkeys((*results.columns, *results.summary))
    wide = max(map(len, keys))
    sign = f"({QUANTITIES['time' if results.period else 'crank_angle'].symbol(language)})"
    varying = {key for key in keys if key in results.columns and results.trace[key].varies}
    return [
        f"{key:<{wide}}  {sign if key in varying else '   '}  {label(display_key(key, results), language)}".rstrip()
        for key in keys
    ]


def _shown_rows(results: Results) -> list[float]:
    """Return the rows of the tables at which a column is listed that is evaluated over the whole cycle. [deg]"""
    rows: list[float] = results.grid.degrees.tolist()
    coarse = [row for row in rows if row % _COARSE == 0]
    return coarse if _FEWEST <= len(coarse) <= _MOST else rows[:: -(-len(rows) // _MOST)]


def place_text(origin: Origin, language: Language) -> str:
    """Return where the machine file states a value, in words."""
    return translate(f"explain.{origin.kind}", language, path=origin.path, line=origin.line)


def _angle(degrees: float, language: Language) -> str:
    return f"{number(degrees, language, digits=10)}°"


def _values(key: str, value: float, language: Language) -> list[str]:
    """Return a value in SI and in the unit of the tables, where it is that of a quantity."""
    if base_key(key) not in QUANTITIES:
        return [number(value, language)]
    return [value_text(shown_value, unit, language) for shown_value, unit in shown_values(ValueLine(key, value))]


class _Places(NamedTuple):
    """Names of the angles of tables: crank angles, or times where a law with a period drives. [s]"""

    period: float
    language: Language

    def __call__(self, degrees: float) -> str:
        """Return an angle of the tables as it is printed."""
        if self.period:
            return value_text(degrees / 360.0 * self.period, "s", self.language)
        return _angle(degrees, self.language)

    @property
    def steady(self) -> str:
        """The heading of what stands still."""
        return translate("explain.steady_time" if self.period else "explain.steady", self.language)

    def at(self, degrees: float) -> str:
        """Return the heading of what stands at an angle of the tables."""
        return translate("explain.at_time" if self.period else "explain.at", self.language, angle=self(degrees))


class _Printed:
    """The lines below the value: of what does not vary, of each crank angle, what is given, sources."""

    def __init__(self, explanation: Explanation, places: _Places, place: Place, rows: list[float]) -> None:
        self._rows = rows
        self._explanation, self._language, self._place = explanation, places.language, place
        self._places = places
        self._sources: dict[str, int] = {}
        self._own: dict[str, str] = {}

    def __iter__(self) -> Iterator[str]:
        explained = list(self._explanation)
        self._own = distinct_symbols([item.known.key for item in explained], self._language)
        self._own |= numbered_terms([item.known for item in explained], self._own, self._language)
        made = [item for item in explained if not is_given(item)]
        # constants come before everything that varies
        later = _later(made)
        steady = [item for item in made if id(item.known.node) not in later]
        moving = [item for item in made if id(item.known.node) in later]
        yield from self._section(self._places.steady, steady)
        current: float | None = None
        printed: dict[str, None] = {}
        for entry in moving:
            angle = entry.known.node.at if isinstance(entry.known.node, ProcedureValue) else entry.degrees
            if angle is not None and angle != current:
                yield from ("", self._places.at(angle))
                current, printed = angle, {}
            lines = [line for line in self._lines([entry]) if line not in printed]
            printed |= dict.fromkeys(lines)
            yield from lines
        yield from self._given([item for item in explained if is_given(item)])
        yield from self._legend(explained)
        if self._sources:
            yield from ("", translate("explain.sources", self._language))
            yield from (f"  [{count}] {cite(source)}" for source, count in self._sources.items())

    def _section(self, title: str, entries: Iterable[ExplainedValue]) -> Iterator[str]:
        lines = dict.fromkeys(self._lines(entries))
        if lines:
            yield from ("", title, *lines)

    def _lines(self, entries: Iterable[ExplainedValue]) -> Iterator[str]:
        for entry in entries:
            line = self._line(entry)
            if line:
                yield f"  {line}"
                yield from self._rows_of_columns(entry)

    def _rows_of_columns(self, entry: ExplainedValue) -> Iterator[str]:
        """Yield the columns that a value over the cycle is taken from, at some rows of the tables."""
        node = entry.known.node
        if not isinstance(node, ProcedureValue | Tabulated) or node.word not in _OVER_CYCLE:
            return
        for column in (part for part in node.operands if part.key and part.varies):
            samples: list[str] = []
            for row in self._rows:
                step = ValueLine(column.key, self._explanation.moment(row).value(column))
                value, unit = shown_values(step)[-1] if base_key(column.key) in QUANTITIES else (step.value, "")
                samples.append(f"{self._places(row)}: {number(value, self._language, digits=5)}".replace(" ", "\u00a0"))
            unit_text = printed_unit(unit, self._language)
            head = f"{self._symbol(column)}{f', {unit_text}' if unit_text else ''} – "
            yield from textwrap.wrap(head + "; ".join(samples), 116, initial_indent="    ", subsequent_indent="      ",
                                     break_long_words=False, break_on_hyphens=False)  # fmt: skip

    def _symbol(self, known: TracedValue, argument: str = "") -> str:
        match known.node:
            case AngleFunction(function=function, multiple=multiple, shift=shift) if not has_own_symbol(known):
                return of_angle(function, multiple, shift, self._language)
        if known.key and not has_argument_symbol(known, argument):
            return self._own.get(known.key) or value_symbol(known.key, self._language)
        return symbol(argument, self._language) if argument in ARGUMENTS else "?"

    def _symbols(self, step: Line) -> dict[str, str]:
        """Return the symbols of operands that have another here than elsewhere."""
        if isinstance(step, SumLine):
            return self._own
        if not isinstance(step, FormulaLine) or not self._own:
            return {}
        entries = {name: ARGUMENTS[name] for name in step.values if name in ARGUMENTS}
        symbols = {name: argument.pattern.format(self._own[argument.quantity]) for name, argument in entries.items()
                 if argument.quantity in self._own and not argument.extra}  # fmt: skip
        return symbols | {name: self._own[key] for name, key in step.named if key in self._own}

    def _line(self, entry: ExplainedValue) -> str:
        """Return the line of a value."""
        known, language = entry.known, self._language
        parts = [self._symbol(known, entry.argument)]
        parts += [value_symbol(entry.own, language)] if entry.own not in ("", known.key) else []
        match known.node:
            case AngleFunction():
                return " = ".join(_once([*parts, *self._angle_parts(entry)]))
            case FormulaCall() | Arithmetic() | Sum():
                step = without_noise(self._explanation.moment(entry.degrees).step(known))
                parts = ["0"] if entry.residual else parts
                parts += [translate(f"memory.{entry.word}", language)] if entry.word else []
                line_texts = line_parts(step, language, self._symbols(step))
                parts += line_texts[: -len(distinct_values(step))] if entry.residual else line_texts
                source = step.formula.source if isinstance(step, FormulaLine) else ""
                return " = ".join(_once(parts)) + self._cited(source) + self._held(entry)
            case Delayed(of=column, by=shift, cycle=cycle) if entry.degrees is not None:
                before = _angle((entry.degrees - shift) % cycle, language)
                parts = [f"{parts[0]}({_angle(entry.degrees, language)})", f"{self._symbol(column)}({before})"]
            case ProcedureValue(word="at", operands=operands, at=angle) if angle is not None:
                parts += [f"{self._symbol(column)}({self._places(angle)})" for column in operands[:1]]
            case ProcedureValue(word="sine" | "cosine" as word, operands=(operand,)):
                of_degrees = _angle(float(from_si(operand.value, "deg")), language)
                parts.append(f"{'sin' if word == 'sine' else 'cos'} {of_degrees}")
            case ProcedureValue(word=word, operands=operands, at=angle):
                defined = definition_text(known.key, language) if known.key else ""
                parts += [defined] if defined else []
                parts.append(self._found(word, operands, angle))
            case Tabulated(word=word, operands=operands):
                integral = integral_text(operands[0].key, language) if operands and word == "integral" else ""
                parts += [*([integral] if integral else []), translate(f"memory.{word}", language)]
            case Component():
                parts.append(translate("explain.root", language))
            case AngleUnwrap():
                parts.append(translate("explain.half_turns", language))
        parts += [value_text(*pair, self._language) for pair in self._shown(entry)]
        return " = ".join(_once(parts)) + self._held(entry)

    def _found(self, word: str, operands: tuple[TracedValue, ...], angle: float | None) -> str:
        """Return a procedure and its operands as text, with the keys of columns that are not followed here."""
        columns = ", ".join(
            self._symbol(part) + (f": {label(part.key.partition('.')[0], self._language)}" if angle is None else "")
            for part in operands
            if part.key and part.varies
        )
        words = translate(f"memory.{word}", self._language)
        where = "" if angle is None else translate("explain.where", self._language, angle=self._places(angle))
        return f"{words}{f' ({columns})' if columns else ''}{where}"

    def _shown(self, entry: ExplainedValue) -> list[tuple[float, str]]:
        """Return a value in the units in which it is printed, each with its unit."""
        node, key = entry.known.node, entry.known.key
        if isinstance(node, Input) and node.unit:
            return [(entry.value, node.unit)]
        if key and base_key(key) in QUANTITIES:
            return shown_values(ValueLine(key, entry.value))
        return [(entry.value, argument_unit(entry.argument) if entry.argument in ARGUMENTS else "")]

    def _angle_parts(self, entry: ExplainedValue) -> list[str]:
        node, degrees = entry.known.node, entry.degrees
        if not isinstance(node, AngleFunction) or degrees is None:
            return []
        angle = _angle(node.multiple * degrees + node.shift, self._language)
        turned = of_angle(node.function, node.multiple, node.shift, self._language)
        if node.function == "angle":
            return [turned, angle, value_text(entry.value, "rad", self._language)]
        name = {"one_minus_sin": "1 − sin ", "one_plus_sin": "1 + sin "}.get(node.function, f"{node.function} ")
        return [turned, f"{name}{angle}", number(entry.value, self._language)]

    def _held(self, entry: ExplainedValue) -> str:
        if entry.stretch is None:
            return ""
        start, end = (self._places(edge) for edge in entry.stretch)
        return f"   ({translate('explain.holds', self._language, start=start, end=end)})"

    def _cited(self, source: str) -> str:
        if not source:
            return ""
        self._sources.setdefault(source.partition(",")[0], len(self._sources) + 1)
        return f"   {Numbering((), {}, self._sources, self._language).citation(source)}"

    def _given(self, entries: list[ExplainedValue]) -> Iterator[str]:
        lines = []
        for entry in entries:
            node = entry.known.node
            if not isinstance(node, Input):
                continue
            shown = self._shown(entry)
            si = float(to_si(entry.value, node.unit)) if node.unit in UNITS else entry.value
            numbers = [si, *(number for number, _ in shown)]
            file, _, row = node.path.partition(":")
            if row:
                where = translate("explain.line", self._language, path=file, line=row)
            else:
                where = self._place(node.path, numbers) if node.path else translate("explain.taken", self._language)
            values = [self._symbol(entry.known, entry.argument), *(value_text(*pair, self._language) for pair in shown)]
            lines.append(f"  {' = '.join(values)}   {where}")
        if lines:
            yield from ("", capital(translate("captions.data", self._language)), *dict.fromkeys(lines))

    def _legend(self, explained: list[ExplainedValue]) -> Iterator[str]:
        """Yield the meanings of the symbols: each quantity once, whatever its point or link."""
        meanings = dict.fromkeys(self._meaning(entry) for entry in explained)
        entries = [f"{shown} – {words}".replace(" ", "\u00a0", 2) for shown, words in meanings if words]
        if entries:
            yield ""
            yield capital(translate("note.where", self._language))
            yield from textwrap.wrap("; ".join(entries), 116, initial_indent="  ", subsequent_indent="  ",
                                     break_long_words=False, break_on_hyphens=False)  # fmt: skip

    def _meaning(self, entry: ExplainedValue) -> tuple[str, str]:
        """Return a symbol as it stands for all its points and links, and its words."""
        known, language = entry.known, self._language
        if isinstance(known.node, AngleFunction) and not has_own_symbol(known):
            return value_symbol("crank_angle", language), label("crank_angle", language)
        if not known.key or has_argument_symbol(known, entry.argument):
            return meaning_of_argument(entry.argument, language)
        kind, part = key_of(known.key)
        if kind not in QUANTITIES:
            return "", ""
        is_part = has_text(f"marks.{part}") and has_text(f"report.{part}")
        words = label(known.key if is_part else kind, language)
        return self._own.get(known.key) or symbol_of_kind(known.key, language), words


def symbol_of_kind(key: str, language: Language) -> str:
    """Return the symbol that a quantity has of any cylinder, and of any point or link with the subscript i."""
    kind, part = key_of(key)
    if has_text(f"marks.{part}"):
        return value_symbol(key if has_text(f"report.{part}") else kind, language)
    return value_symbol(f"{kind}.i" if part and kind in OF_LINKS and kind != "efficiency" else kind, language)


def meaning_of_argument(name: str, language: Language) -> tuple[str, str]:
    """Return the symbol and the meaning of an argument of formulas, empty where it is obvious."""
    entry = ARGUMENTS.get(name)
    if entry is None:
        return "", ""
    if has_text(f"arguments.{name}"):
        return symbol(name, language), words_of(name, language)
    return (value_symbol(entry.quantity, language), label(entry.quantity, language)) if entry.quantity else ("", "")


def distinct_symbols(keys: Iterable[str], language: Language) -> dict[str, str]:
    """Return symbols with the mark of their owner, for quantities whose letters have another meaning here too."""
    kinds: dict[str, set[str]] = {}
    for key in {"crank_angle", *keys} - {""}:
        for shown in (value_symbol(key, language), symbol_of_kind(key, language)):
            kinds.setdefault(_OF_ANGLE.sub("", shown), set()).add(base_key(key_of(key).quantity))
    marks, symbols = texts("marks", language), {}
    for key in keys:
        shown, owner = value_symbol(key, language), "cycle" if key in _OF_CYCLE else _OWNERS.get(key)
        if owner and len(kinds.get(shown, ())) > 1:
            symbols[key] = f"{shown}{',' if '_' in shown else '_'}{marks[owner]}"
    return symbols


def numbered_terms(known: Iterable[TracedValue], symbols: Mapping[str, str], language: Language) -> dict[str, str]:
    """Return symbols with a number, for terms of a sum that would have the symbol of another one."""
    result = dict[str, str]()
    for value in known:
        terms = value.node.operands if isinstance(value.node, Sum) else ()
        taken = list[str]()
        for key in dict.fromkeys(term.key for term in terms if term.key):
            shown = symbols.get(key) or value_symbol(key, language)
            if shown in taken:
                result[key] = f"{shown}{',' if '_' in shown else '_'}{taken.count(shown) + 1}"
            taken.append(shown)
    return result


def _later(calculated: list[ExplainedValue]) -> set[int]:
    """Return the nodes that belong to a crank angle, and all that depend on them."""
    varying: set[int] = set()
    for entry in calculated:
        if entry.degrees is not None or _is_at_angle(entry) or _is_made_of(entry.known, varying):
            varying.add(id(entry.known.node))
    return varying


def _is_made_of(known: TracedValue, nodes: set[int]) -> bool:
    parts = known.node.operands
    written = (part for part in parts if isinstance(part.node, Arithmetic) and not part.key)
    return any(id(part.node) in nodes for part in parts) or any(_is_made_of(operand, nodes) for operand in written)


def _is_at_angle(entry: ExplainedValue) -> bool:
    """Return whether a procedure took a value from columns at a crank angle."""
    node = entry.known.node
    return isinstance(node, ProcedureValue) and node.at is not None and bool(node.operands)


def has_own_symbol(known: TracedValue) -> bool:
    """Return whether a function of the crank angle goes by a name of its own."""
    return bool(known.key) and not known.key.startswith("crank_")


def _once(parts: list[str]) -> list[str]:
    """Return parts without those that repeat the one before: sin θ = sin(θ)."""
    plain = [_FENCES.sub("", part) for part in parts]
    return [part for index, part in enumerate(parts) if not index or plain[index] != plain[index - 1]]


def of_angle(function: str, multiple: int, shift: float, language: Language) -> str:
    """Return a function of the crank angle, counted from elsewhere where that is shifted: cos (φ + 72°)."""
    phi = QUANTITIES["crank_angle"].symbol(language)
    turned = f"{'' if multiple == 1 else multiple}{phi}"
    if shift:
        sign = "+" if shift > 0 else "−"
        turned = f"({turned} {sign} {_angle(abs(shift), language)})"
    match function:
        case "angle":
            return turned
        case "one_minus_sin":
            return f"1 − sin {turned}"
        case "one_plus_sin":
            return f"1 + sin {turned}"
    return f"{function} {turned}"
