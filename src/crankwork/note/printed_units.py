"""Units as a note prints them."""

from __future__ import annotations

import re

from crankwork.formula.expression import Formula
from crankwork.locale.numbers import unit_name
from crankwork.quantities import QUANTITIES, Language, base_key
from crankwork.report.display import key_unit
from crankwork.units import UNITS

_DIGIT = re.compile(r"(?<=[A-Za-zА-Яа-я])([23])(?!\d)")
_WORD = re.compile(r"[A-Za-z]+")
_CYRILLIC = re.compile(r"[А-Яа-я]+")
_FACTOR = re.compile(r" (?!\()")
_RAISED = {"2": "²", "3": "³"}


def display_unit(key: str, formula: Formula | None = None) -> str:
    """Return the unit in which a value is shown, by its key, or by its formula where the key is of no quantity."""
    if base_key(key) in QUANTITIES or formula is None:
        return key_unit(key)
    return QUANTITIES[formula.quantity].unit


def printed_unit(unit: str, language: Language) -> str:
    """Return a unit as that language prints it, also one that no table of results has.

    Examples
    --------
    >>> printed_unit("m3", "ru"), printed_unit("kJ/(kg*K)", "en")
    ('м³', 'kJ/(kg·K)')
    """
    name = unit_name(unit, language)
    if name == unit and language == "ru":
        name = _WORD.sub(lambda word: _in_russian(word[0]), unit)
    name = _WORD.sub(lambda word: unit_name(word[0], language), name)
    # what follows in parentheses is no factor
    return _FACTOR.sub("·", _DIGIT.sub(lambda digit: _RAISED[digit[1]], name).replace("*", "·"))


def _in_russian(word: str) -> str:
    """Return the Russian name of a unit that stands in a composed one."""
    name = unit_name(word, "ru")
    if name != word or word not in UNITS:
        return name
    spelled = (other for other, unit in UNITS.items() if unit == UNITS[word] and _CYRILLIC.fullmatch(other))
    return next(spelled, word)
