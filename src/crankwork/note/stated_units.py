"""The units in which a formula takes its numbers and gives its value, read from what its docstring states.

Formulas compute in SI except where they say otherwise (revolutions per minute, degrees Celsius). The docstring is
where they say it, and a test holds every registered formula to a unit of the quantity that it gives.
"""

from __future__ import annotations

import functools
import re
from types import MappingProxyType

from crankwork.expressions import Formula
from crankwork.quantities import QUANTITIES, Language, base_key
from crankwork.report.language import key_unit, unit_name
from crankwork.units import UNITS

RESULT = ""
_SECTION = re.compile(r"^ *(Parameters|Returns)\n *-+\n(.*?)(?=^ *[A-Z]\w+\n *-{3,}$|\Z)", re.MULTILINE | re.DOTALL)
_HEADER = re.compile(r"\s*(?P<names>\*{0,2}\w+(?:, \*{0,2}\w+)*) : \S.*")
_UNIT = re.compile(r"\[([^\]\s][^\]]*)\]")
_DIGIT = re.compile(r"(?<=[A-Za-zА-Яа-я])([23])(?!\d)")
_WORD = re.compile(r"[A-Za-z]+")
_CYRILLIC = re.compile(r"[А-Яа-я]+")
_SPECIAL = {"degC": "°C", "deg": "°"}
_RUSSIAN = {"kmol": "кмоль", "mol": "моль", "h": "ч"}
_RAISED = {"2": "²", "3": "³"}


@functools.cache
def stated_units(formula: Formula) -> MappingProxyType[str, str]:
    """Return the unit of each argument of a formula by name, and that of its value under `RESULT`.

    Parameters
    ----------
    formula : Formula
        A registered formula; what its docstring does not state is left out.
    """
    sections = dict(_SECTION.findall(formula.function.__doc__ or ""))
    units: dict[str, str] = {}
    names: list[str] = []
    text = ""
    for line in [*sections.get("Parameters", "").splitlines(), "end : of the section"]:
        header = _HEADER.fullmatch(line)
        if header:
            found = _UNIT.findall(text)
            units.update(zip(names, found * len(names) if len(found) == 1 else found, strict=False))
            names, text = header["names"].split(", "), ""
        else:
            text += " " + line
    result = _UNIT.findall(sections.get("Returns", ""))
    if len(result) == 1:
        units[RESULT] = result[0]
    return MappingProxyType({name: _known(unit) for name, unit in units.items()})


def _known(unit: str) -> str:
    """Return a unit as the table of units spells it; `-` is no unit."""
    joined = unit.replace(" ", "*")
    return "" if unit == "-" else joined if joined in UNITS else unit


def coherent_unit(unit: str) -> str:
    """Return the SI unit of what a unit measures, or the unit itself if the table has no such unit.

    Examples
    --------
    >>> coherent_unit("MPa"), coherent_unit("rpm")
    ('Pa', 'rad/s')
    """
    if unit not in UNITS:
        return unit
    dimension = UNITS[unit].dimension
    return next((name for name, one in UNITS.items() if one.dimension == dimension and one.factor == 1.0), unit)


def display_unit(key: str, formula: Formula | None = None) -> str:
    """Return the unit in which a value is shown, by its key, or by its formula where the key is of no quantity."""
    if base_key(key) in QUANTITIES or formula is None:
        return key_unit(key)
    return QUANTITIES[formula.quantity].unit


def printed_unit(unit: str, language: Language) -> str:
    """Return a unit as that language prints it, also one that no table of results has.

    Parameters
    ----------
    unit : str
        As the table of units spells it.
    language : str
        The language.

    Examples
    --------
    >>> printed_unit("m3", "ru"), printed_unit("kJ/(kg*K)", "en")
    ('м³', 'kJ/(kg·K)')
    """
    name = unit_name(unit, language)
    if name == unit and language == "ru":
        name = _WORD.sub(lambda word: _in_russian(word[0]), unit)
    name = _WORD.sub(lambda word: _SPECIAL.get(word[0], word[0]), name)
    return _DIGIT.sub(lambda digit: _RAISED[digit[1]], name).replace("*", "·").replace(" ", "·")


def _in_russian(word: str) -> str:
    """Return the Russian name of a unit that stands in a composed one."""
    name = unit_name(word, "ru")
    if name != word or word not in UNITS:
        return _RUSSIAN.get(word, name)
    spelled = (other for other, one in UNITS.items() if one == UNITS[word] and _CYRILLIC.fullmatch(other))
    return next(spelled, word)
