"""Notices about results as sentences, by their code."""

from __future__ import annotations

from collections.abc import Mapping

from crankwork.formula.expression import symbol
from crankwork.locale import decimal, has_text, say, told
from crankwork.locale.numbers import number, unit_name
from crankwork.notation import argument_unit
from crankwork.quantities import QUANTITIES, Language
from crankwork.report.language import FILE_KEYS, label


def notice_text(code: str, values: Mapping[str, float | str], language: Language) -> str:
    """Return the sentence of a notice with its numbers printed."""
    shown = {}
    for key, value in values.items():
        if key == "names":
            shown[key] = _meanings(str(value), language)
        elif key == "quantities":
            shown[key] = ", ".join(label(name, language) for name in str(value).split(", "))
        elif key == "quantity":
            shown[key] = label(str(value), language)
        elif key == "argument":
            shown[key] = symbol(str(value), language)
        elif key == "angles":
            shown[key] = decimal(str(value), language).replace("-", "−")
        elif isinstance(value, str):
            shown[key] = told(value, language)
        else:
            # pressure steps are the only values with a unit of their own, MPa
            shown[key] = number(value / 1e6 if key == "step" else value, language, digits=5)
    if "argument" in values:
        unit = unit_name(argument_unit(str(values["argument"])), language)
        shown |= {key: f"{shown[key]} {unit}".rstrip() for key in ("value", "high")}
    return say(f"notices.{code}", language, **shown)


def _meanings(names: str, language: Language) -> str:
    """Return keys of the machine file with what they mean, in a language that is not theirs."""
    if language == "en":
        return names
    meant = {name: FILE_KEYS.get(name, name) for name in names.split(", ")}
    return ", ".join(
        f"{label(key, language)} ({name})" if key in QUANTITIES or has_text(f"report.{key}") else name
        for name, key in meant.items()
    )
