"""Meanings of the symbols of formulas."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from crankwork.formula.calculation_lines import FormulaLine, symbols_of
from crankwork.formula.expression import Formula, record, symbol
from crankwork.locale import has_text, translate
from crankwork.notation import ARGUMENTS, Argument, argument_unit
from crankwork.note.captions import printed_unit
from crankwork.note.document import Block, Equation, Table
from crankwork.note.equations import equation_symbol, own_key, value_symbol
from crankwork.quantities import QUANTITIES, Language, base_key
from crankwork.quantities.key import key_of
from crankwork.report.display import key_unit, label

# parts of a quantity that are no cylinder or point, and arguments made of a quantity
_PARTS = {"inertia": "note.of_inertia", "drive": "note.of_drive", "of_cylinder": "report.of_cylinder"}
_DERIVED = {
    "{}′": "derivative_1",
    "{}″": "derivative_2",
    "Δ{}": "step",
    "{}₀": "at_start",
    "{}₊": "at_next",
    "{}₋": "at_last",
}
# a symbol inside arithmetic that is written in place: it goes by the name of its own value
_NAMED_ONLY = Argument("")


class Meaning(NamedTuple):
    """A symbol and what it stands for, with its unit after a comma if it has one."""

    symbol: str
    text: str
    is_derived: bool = False  # Whether its text says only what it is made of, for want of a name


def legend(step: FormulaLine | Formula, language: Language, known: frozenset[str] = frozenset()) -> tuple[Meaning, ...]:
    """Return the meanings of the symbols of a formula, each with the unit in which the formula takes it."""
    explanations: dict[str, Meaning] = {}
    named = dict(step.named) if isinstance(step, FormulaLine) else {}
    for name in _arguments(step):
        entry = ARGUMENTS.get(name, _NAMED_ONLY)
        unit = _unit(name, named.get(name, "")) if name in ARGUMENTS else ""
        after = f", {printed_unit(unit, language)}" if unit else ""
        for key in _explaining(name, named):
            if key in known or key in explanations:
                continue
            if key == f"argument:{name}":
                derived = not has_text(f"arguments.{name}")
                explanations[key] = Meaning(symbol(name, language), words_of(name, language) + after, derived)
            else:
                own = entry.pattern == "{}" or name in named
                meaning = _meaning(key, language)
                # some names of quantities end in their unit
                shown = value_symbol(own_key(named.get(name, key)), language)
                explanations[key] = Meaning(shown, meaning.removesuffix(after) + after * own)
    return tuple(explanations.values())


def meanings(blocks: Iterable[Block], language: Language) -> list[Meaning]:
    """Return the meanings of all symbols of equations, each once, in alphabetical order.

    A symbol that stands for two things, as some letters of a school do, is there with both.
    """
    collected: dict[Meaning, None] = {}
    known: set[str] = set()
    for block in blocks:
        if isinstance(block, Table):
            collected |= dict.fromkeys(Meaning(*defined) for defined in block.defined)
        if not isinstance(block, Equation):
            continue
        step = block.step
        left = "" if isinstance(step, Formula) else key_of(step.key).quantity
        if left in QUANTITIES and left not in known:
            own = block.symbol or equation_symbol(step, language)
            unit = printed_unit(key_unit(left, per_area=bool(block.area)), language)
            after = f", {unit}" if unit else ""
            collected[Meaning(own, label(left, language).removesuffix(after) + after)] = None
            known.add(left)
        if isinstance(step, FormulaLine | Formula):
            collected |= dict.fromkeys(legend(step, language, frozenset(known)))
            known |= explained_keys(step)
    named = {meaning.symbol for meaning in collected if not meaning.is_derived}
    shown = (meaning for meaning in collected if not (meaning.is_derived and meaning.symbol in named))
    # once, with its unit where one of several places states it
    longest = sorted(shown, key=lambda meaning: len(meaning.text))
    once = {(meaning.symbol, meaning.text.partition(", ")[0]): meaning for meaning in longest}
    return sorted(once.values(), key=lambda meaning: (meaning.symbol.casefold(), meaning.symbol))


def _unit(name: str, key: str) -> str:
    """Return the unit of an argument; of one that stands for another quantity, the SI unit of that."""
    kind = base_key(key_of(key).quantity)
    return QUANTITIES[kind].si_unit if kind in QUANTITIES and kind != ARGUMENTS[name].quantity else argument_unit(name)


def words_of(name: str, language: Language) -> str:
    """Return the meaning of an argument whose symbol is not that of a quantity alone."""
    if has_text(f"arguments.{name}"):
        return translate(f"arguments.{name}", language)
    entry = ARGUMENTS[name]
    return f"{label(entry.quantity, language)}, {translate(f'note.{_DERIVED[entry.pattern]}', language)}"


def _meaning(key: str, language: Language) -> str:
    """Return the name of a quantity, and of a part of it that is no cylinder or point what it is for."""
    kind, part = key_of(key)
    return label(kind, language) + (f" {translate(_PARTS[part], language)}" if part in _PARTS else "")


def explained_keys(step: FormulaLine | Formula) -> set[str]:
    """Return the keys that the legend of a formula explains: of quantities, and of arguments with own words."""
    named = dict(step.named) if isinstance(step, FormulaLine) else {}
    return {key for name in _arguments(step) for key in _explaining(name, named)}


def _arguments(step: FormulaLine | Formula) -> tuple[str, ...]:
    """Return the names of the symbols that are printed."""
    return symbols_of(step.expression if isinstance(step, FormulaLine) else record(step.shown))


def _explaining(name: str, named: Mapping[str, str]) -> tuple[str, ...]:
    """Return the keys that explain an argument."""
    entry = ARGUMENTS.get(name, _NAMED_ONLY)
    if name in named:
        key = own_key(named[name])
        kind, part = key_of(key)
        return (key if part in _PARTS else kind,)
    if has_text(f"arguments.{name}") or entry.pattern in _DERIVED:
        return (f"argument:{name}",)
    return tuple(key for key in (entry.quantity, entry.extra) if key)
