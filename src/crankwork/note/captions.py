"""The fixed words around the blocks of a note in each language, and how units are printed there."""

from __future__ import annotations

import datetime as dt
import re

from crankwork.formula.expression import Formula
from crankwork.locale import capital, translate
from crankwork.locale.numbers import unit_name
from crankwork.quantities import QUANTITIES, Language, base_key
from crankwork.report.display import key_unit
from crankwork.units import UNITS

# what is called as something else is called already
_SAME = {
    "headings.bearings": "subjects.bearings",
    "headings.torque_harmonics": "tables.torque_harmonics",
    "headings.chambers": "tables.chambers",
    "headings.comparison": "tables.comparison",
    "headings.driving": "quantities.driving_torque",
    "headings.firing": "columns.order",
    "headings.friction": "tables.friction",
    "headings.machine": "subjects.machine",
    "headings.method": "report.method",
    "headings.reactions": "tables.joint_forces",
    "headings.accumulated": "tables.accumulated_torque",
    "headings.static": "quantities.static_torque",
    "headings.turning_moments": "figures.turning_moment",
    "headings.energy_extremes": "tables.energy_extremes",
    "headings.torques": "figures.torques",
    "headings.unrolled": "figures.crankpin_load",
    "headings.wear": "figures.crankpin_wear",
    "captions.accumulated": "tables.accumulated_torque",
    "captions.acceleration": "quantities.piston_acceleration",
    "captions.balance": "figures.balance_orders",
    "captions.balance_forces": "figures.balance_forces",
    "captions.displacement": "quantities.piston_displacement",
    "captions.harmonics": "tables.torque_harmonics",
    "captions.heat_balance": "headings.heat_balance",
    "captions.inertia": "quantities.inertia_force",
    "captions.instant_centres": "headings.instant_centres",
    "captions.more": "headings.more",
    "captions.linkage_orders": "figures.balance_orders",
    "captions.cycle_results": "headings.cycle",
    "captions.glance": "headings.results",
    "captions.nomenclature": "headings.nomenclature",
    "captions.motion": "figures.kinematics",
    "captions.pairs": "columns.joints",
    "captions.reactions": "tables.joint_forces",
    "captions.summary": "headings.results",
    "captions.table_static": "quantities.static_torque",
    "captions.torques_all": "tables.dynamics",
    "captions.total": "figures.total_torque",
    "captions.transmission_angles": "headings.transmission",
    "headings.torsion": "subjects.torsion",
    "headings.stages": "tables.stages",
    "captions.rod_loads": "figures.rod_loads",
    "captions.velocity": "quantities.piston_velocity",
    "columns.fuel": "report.fuel",
    "columns.row": "report.row",
    "figures.friction": "tables.friction",
    "figures.joint_forces": "tables.joint_forces",
    **{f"captions.{name}": f"tables.{name}" for name in (
        "bearings", "chambers", "comparison", "firing", "fitted_polytropes", "friction", "polytropes",
        "energy_extremes", "planes", "torsional_discs", "torsional_shafts", "natural_modes",
        "torsional_nodes", "holzer", "holzer_trials", "damped_modes", "critical_speeds", "turning",
        "stages",
    )},
}  # fmt: skip
_PLACE = re.compile(r"(?<!\w)(?:ch\.|vol\.|sec\.|pp\.|p\.|eq\.|fig\.|table|ex\.|example)(?!\w)")
_REMARK = re.compile(r"\s*\([^)]*\)")
LANGUAGE_TAGS: dict[Language, str] = {"en": "en-GB", "ru": "ru-RU", "vi": "vi-VN"}
_DIGIT = re.compile(r"(?<=[A-Za-zА-Яа-я])([23])(?!\d)")
_WORD = re.compile(r"[A-Za-z]+")
_CYRILLIC = re.compile(r"[А-Яа-я]+")
_FACTOR = re.compile(r" (?!\()")
_RAISED = {"2": "²", "3": "³"}


def note_text(key: str, language: Language, **values: str) -> str:
    """Return a text of a note, also one under another key; headings and captions have a capital letter."""
    text = translate(_SAME.get(key, key), language, **values)
    return text if key.startswith("columns.") else capital(text)


def caption(kind: str, number: str, title: str, language: Language) -> str:
    """Return the line under a `figure` or over a `table`; a table without a title goes on."""
    return translate(f"note.{kind}", language, number=number, title=title) if title else continued(number, language)


def continued(number: str, language: Language) -> str:
    """Return the caption above the continuation of a table."""
    return translate("note.continued", language, number=number)


def place_in_source(place: str, language: Language) -> str:
    """Return chapter, page or equation of a source as that language abbreviates it.

    Examples
    --------
    >>> place_in_source("ch. 6", "ru")
    'гл. 6'
    """
    # a remark in parentheses is in English
    place = place if language == "en" else _REMARK.sub("", place)
    return _PLACE.sub(lambda match: translate(f"places.{match[0]}", language), place)


def printed_date(date: dt.date, language: Language) -> str:
    """Return a date in figures, as that language orders them."""
    return {"en": f"{date:%Y-%m-%d}", "ru": f"{date:%d.%m.%Y}", "vi": f"{date:%d/%m/%Y}"}[language]


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
