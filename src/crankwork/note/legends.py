"""What the symbols of a formula stand for: the lines below an equation, after "where"."""

from __future__ import annotations

from collections.abc import Mapping

from crankwork.expressions import Formula, symbol
from crankwork.notation import ARGUMENTS
from crankwork.note.document import Explanation
from crankwork.note.equations import value_symbol
from crankwork.note.stated_units import printed_unit, stated_units
from crankwork.quantities import LANGUAGES, QUANTITIES, Language
from crankwork.report.language import label
from crankwork.steps import Step

_PARTS = {"inertia": ("for the inertia force", "для силы инерции", "dùng cho lực quán tính")}
_DERIVED = {
    "{}′": ("derivative by the crank angle", "первая производная по углу поворота кривошипа",
            "đạo hàm bậc một theo góc quay"),
    "{}″": ("second derivative by the crank angle", "вторая производная по углу поворота кривошипа",
            "đạo hàm bậc hai theo góc quay"),
    "Δ{}": ("step", "шаг", "bước"),
    "{}₀": ("at the start", "начальное значение", "giá trị ban đầu"),
    "{}₊": ("at the next position", "в следующем положении", "ở vị trí sau"),
    "{}₋": ("at the position before", "в предыдущем положении", "ở vị trí trước"),
}  # fmt: skip


def legend(step: Step | Formula, language: Language, known: frozenset[str] = frozenset()) -> tuple[Explanation, ...]:
    """Return what the symbols of a formula stand for, each with the unit in which the formula takes it.

    Parameters
    ----------
    step : Step or Formula
        Whose symbols.
    language : str
        Language of the names.
    known : frozenset of str
        Keys of quantities that need no explanation any more.
    """
    formula = step.formula if isinstance(step, Step) else step
    units = stated_units(formula)
    found: dict[str, Explanation] = {}
    named = dict(step.named) if isinstance(step, Step) else {}
    for name in formula.arguments:
        entry = ARGUMENTS[name]
        unit = units.get(name, "")
        after = f", {printed_unit(unit, language)}" if unit else ""
        for key in _explaining(name, named):
            if key in known or key in found:
                continue
            if key == f"argument:{name}":
                shown = symbol(name, language)
                if not any(one in QUANTITIES and QUANTITIES[one].symbol(language) == shown for one in known):
                    found[key] = Explanation(shown, _words_of(name, language) + after)
            else:
                own = entry.pattern == "{}" or name in named
                found[key] = Explanation(value_symbol(key, language), _meaning(key, language) + after * own)
    return tuple(found.values())


def _words_of(name: str, language: Language) -> str:
    """Return what an argument means whose symbol is not that of a quantity alone."""
    entry, place = ARGUMENTS[name], LANGUAGES.index(language)
    if entry.meaning:
        return entry.meaning.split(" | ")[place]
    return f"{label(entry.quantity, language)}, {_DERIVED[entry.pattern][place]}"


def _meaning(key: str, language: Language) -> str:
    """Return the name of a quantity, and of a part of it that is no cylinder or point what it is for."""
    kind, _, part = key.partition(".")
    return label(kind, language) + (f" {_PARTS[part][LANGUAGES.index(language)]}" if part in _PARTS else "")


def explained_keys(step: Step | Formula) -> set[str]:
    """Return the keys that the legend of a formula explains: of quantities, and of arguments with words of their own.

    Parameters
    ----------
    step : Step or Formula
        Whose symbols.
    """
    formula = step.formula if isinstance(step, Step) else step
    named = dict(step.named) if isinstance(step, Step) else {}
    return {key for name in formula.arguments for key in _explaining(name, named)}


def _explaining(name: str, named: Mapping[str, str]) -> tuple[str, ...]:
    """Return the keys that explain an argument."""
    entry = ARGUMENTS[name]
    if name in named:
        kind, _, part = named[name].partition(".")
        return (named[name] if part in _PARTS else kind,)
    if entry.meaning or entry.pattern in _DERIVED:
        return (f"argument:{name}",)
    return tuple(key for key in (entry.quantity, entry.extra) if key)
