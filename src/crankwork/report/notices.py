"""What readers should know as sentences: notices, figures left out, assumptions, and inputs without effect."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from crankwork.analysis import Results
from crankwork.analysis.assumptions import Assumption, IdleInput
from crankwork.formula.expression import symbol
from crankwork.locale import decimal, in_language, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.mechanism.driver import Cylinder, LinkMotor
from crankwork.notation import argument_unit
from crankwork.quantities import QUANTITIES, Language
from crankwork.quantities.key import key_of
from crankwork.report.display import displayed, in_own_units, key_unit, label, link_label
from crankwork.report.tables import any_nonzero

# numbers of a notice that are in the unit of its quantity
_IN_UNIT = ("value", "low", "high", "before", "after")
_DRAWN = ("reduced_inertia", "static_torque", "dynamic_torque", "driving_torque", "joint_force")
# what a screen shows beside the results
MOST_LINES, WIDEST = 3, 100
_MOST_KEYS = 3
_QUANTITY = re.compile(r"([-+\d.eE]+) (\S.*)")


def notice_text(code: str, values: Mapping[str, float | str], language: Language) -> str:
    """Return the sentence of a notice with its numbers printed."""
    shown = {}
    for key, value in values.items():
        if key == "quantities":
            shown[key] = ", ".join(label(name, language) for name in str(value).split(", "))
        elif key == "quantity":
            shown[key] = label(str(value), language)
        elif key in ("argument", "unit"):
            shown[key] = (symbol if key == "argument" else unit_name)(str(value), language)
        elif key == "angles":
            shown[key] = decimal(str(value), language).replace("-", "−")
        elif key in ("shift", "write"):
            # to be written in the machine file
            shown[key] = f"{value:g}"
        elif isinstance(value, str):
            shown[key] = in_language(value, language)
        else:
            # pressure steps are the only values with a unit of their own, MPa
            shown[key] = number(value / 1e6 if key == "step" else value, language, digits=5)
    if code in ("implausible", "implausible_own", "impossible", "law_jump"):
        key = str(values["quantity"])
        numbers = {name: displayed(key, float(values[name])) for name in _IN_UNIT if name in values}
        shown |= {name: number(value, language) for name, value in numbers.items()}
        shown["unit"] = f" {unit_name(key_unit(key), language)}".rstrip()
    if "argument" in values:
        unit = unit_name(argument_unit(str(values["argument"])), language)
        shown |= {key: f"{shown[key]} {unit}".rstrip() for key in ("value", "high")}
    return translate(f"notices.{code}", language, **shown)


def skipped_figure_notes(results: Results, language: Language, *, zeros: bool = True) -> Iterator[str]:
    """Yield sentences about figures that are left out; `zeros`: also those of what is zero throughout."""
    names = list(dict.fromkeys(label(kind, language) for kind in _zero(results))) if zeros else []
    if names:
        yield translate("report.not_drawn_zero", language, names=", ".join(names))
    if results.machine.linkage is not None and _has_no_groups(results):
        yield translate("report.no_force_plans", language)


def _zero(results: Results) -> Iterator[str]:
    """Yield the quantities that figures are of and that are zero throughout."""
    for kind in _DRAWN:
        keys: Iterable[str] = [key for key in results.columns if key_of(key).quantity == kind and kind in QUANTITIES]
        if keys and not any_nonzero(keys, results.columns):
            yield kind


def _has_no_groups(results: Results) -> bool:
    """Return whether there are joint forces, but a driver within a group, so that none is apart from it."""
    has_forces = any(key.startswith("joint_force.") for key in results.columns)
    return has_forces and isinstance(results.machine.mechanism.driver, Cylinder | LinkMotor)


@in_own_units
def assumption_texts(results: Results, language: Language) -> list[str]:
    """Return a sentence for each assumption, what matters most first."""
    return [_assumption(item, language) for item in results.assumptions]


@in_own_units
def plain_assumptions(results: Results, language: Language) -> list[str]:
    """Return the assumptions that are no defaults, without the keys of the file, for a note."""
    plain = [item._replace(keys=()) for item in results.assumptions if item.code != "default"]
    taken = "; ".join(_taken(item, language) for item in plain if item.code == "taken")
    texts = [_assumption(item, language).replace(" ()", "") for item in plain if item.code != "taken"]
    return [*texts, translate("assumptions.taken_plain", language, values=taken)] if taken else texts


def idle_texts(results: Results, language: Language) -> list[str]:
    """Return a sentence for each reason why inputs are without effect."""
    groups: dict[tuple[object, ...], list[IdleInput]] = {}
    for item in results.without_effect:
        groups.setdefault((item.reason, *item.values.values()), []).append(item)
    return [_idle(items, language) for items in groups.values()]


def _idle(items: Sequence[IdleInput], language: Language) -> str:
    values = {name: number(value, language) for name, value in items[0].values.items()}
    keys = _keys([item.key for item in items], language)
    return translate(f"assumptions.{items[0].reason}", language, keys=keys, **values)


def sentence_lists(results: Results, language: Language) -> Iterator[tuple[str, list[str]]]:
    """Yield the headings of assumptions and of inputs without effect with their sentences, where there are any."""
    for name, texts in (
        ("heading", assumption_texts(results, language)),
        ("heading_idle", idle_texts(results, language)),
    ):
        if texts:
            yield translate(f"assumptions.{name}", language), texts


def screen_lines(texts: Sequence[str], language: Language) -> Iterator[str]:
    """Yield the first sentences, cut to the width of a screen, and how many more there are."""
    for text in texts[:MOST_LINES]:
        yield text if len(text) <= WIDEST else f"{text[: WIDEST - 1].rstrip()}…"
    if len(texts) > MOST_LINES:
        yield translate("assumptions.more", language, count=len(texts) - MOST_LINES)


def _assumption(item: Assumption, language: Language) -> str:
    keys = _keys(item.keys, language)
    if item.code == "taken":
        return translate("assumptions.taken", language, value=_taken(item, language), keys=keys)
    name = translate(item.meaning, language) if item.meaning else ""
    names = ", ".join(link_label(part.partition(".")[2] or part, language) for part in item.names)
    return translate(
        f"assumptions.{item.code}", language, keys=keys, name=name, names=names, value=_written(item.value, language)
    )


def _taken(item: Assumption, language: Language) -> str:
    unit = unit_name(key_unit(item.quantity), language)
    value = number(displayed(item.quantity, item.value), language)
    return f"{label(item.quantity, language)} {value} {unit}".rstrip()


def _written(value: object, language: Language) -> str:
    """Return a value of a file as a language prints it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list):
        return ", ".join(_written(item, language) for item in value)
    match = _QUANTITY.fullmatch(str(value))
    if match is None:
        return decimal(str(value), language) if isinstance(value, float) else str(value)
    return f"{decimal(match[1], language)} {unit_name(match[2], language)}".replace(" °", "°")


def _keys(keys: Sequence[str], language: Language) -> str:
    shown = ", ".join(keys[:_MOST_KEYS])
    rest = len(keys) - _MOST_KEYS
    return shown if rest <= 0 else f"{shown} {translate('assumptions.more_keys', language, count=rest)}"
