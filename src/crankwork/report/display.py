"""Words, units and numbers as each language prints them."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Concatenate, ParamSpec, TypeVar

import numpy as np

from crankwork.locale import decimal, has_text, texts, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.mechanism.structure import ROMAN, structure
from crankwork.quantities import QUANTITIES, SUBJECTS, Language, base_key, derived_unit
from crankwork.quantities.key import MOVED, Key, key_of
from crankwork.quantities.quantity import OWNED, own_name, owned_name
from crankwork.units import DisplayUnits, from_si, parse_in, use_units

if TYPE_CHECKING:
    from crankwork.analysis import Array, Results

P = ParamSpec("P")
R = TypeVar("R")
# kinds of rows whose number is an order, and what is free of each
_BY_ORDER = ("reciprocating", "knuckle_pins", "balance_shafts", "residual")
_OF_ORDERS = {
    "free_force": "drawing.free_force", "free_moment": "drawing.free_moment",
    "shaking_moment_amplitude": "quantities.shaking_moment_amplitude",
}  # fmt: skip
# what is found in several ways
_BY_WAY = ("excess_work", "flywheel_inertia", "whole_inertia")
# what belongs to discs and shafts
_TORSION, _PLANES = (frozenset(row.key for row in SUBJECTS[name]) for name in ("torsion", "balance"))
# what valves let through per unit of time, of all cylinders or of one
_DELIVERED = ("inlet_flow", "gas_mass_flow", "free_air_delivery", "isothermal_power")
# key of the machine file: the quantity or word that it means, where that has another name
FILE_KEYS = {
    "heating": "charge_heating",
    "filling": "filling_factor",
    "pressure_ratio": "pressure_rise_ratio",
    "mechanical_loss": "mechanical_loss_pressure",
    "spacing": "balance_pitch",
}
# values that are those of a whole column, and parts of keys
_EXTREMES = ("max", "min")


def in_own_units(function: Callable[Concatenate[Results, P], R]) -> Callable[Concatenate[Results, P], R]:
    """Return a function that shows results in the system of units that their machine asks for."""

    @functools.wraps(function)
    def shown(results: Results, /, *args: P.args, **options: P.kwargs) -> R:
        with use_units(results.machine.units):
            return function(results, *args, **options)

    return shown


# what takes the place of a unit of which results have as many as that
_LARGER = {"N": ("kN", 1e4), "N*m": ("kN*m", 1e5), "J": ("kJ", 1e5), "W": ("kW", 1e5)}
# sums of forces, that nobody compares with forces
_SUMS = ("crankpin_wear", "main_wear")


def reader_units(results: Results) -> DisplayUnits:
    """Return the display units for readers: forces in kN where many of them are above 10000 N."""
    listed = (listing.columns for name, listing in results.listings.items() if name not in _SUMS)
    largest = dict.fromkeys(_LARGER, 0.0)
    for key, values in itertools.chain(*(columns.items() for columns in (results.columns, *listed))):
        unit = "" if derived_unit(key) else QUANTITIES[base_key(key)].metric
        if unit in largest:
            known = values[np.isfinite(values)]
            largest[unit] = max(largest[unit], float(np.max(np.abs(known), initial=0.0)))
    shown = tuple((unit, larger) for unit, (larger, many) in _LARGER.items() if largest[unit] >= many)
    return DisplayUnits(results.machine.units, shown)


def for_readers(function: Callable[Concatenate[Results, P], R]) -> Callable[Concatenate[Results, P], R]:
    """Return a function that shows results as `in_own_units` does, long numbers in larger units."""

    @functools.wraps(function)
    def shown(results: Results, /, *args: P.args, **options: P.kwargs) -> R:
        with use_units(reader_units(results)):
            return function(results, *args, **options)

    return shown


def key_unit(key: str, *, per_area: bool = False) -> str:
    """Return the display unit of a key, a derived one such as `piston_force_max_angle` included."""
    if unit := derived_unit(key):
        return unit
    row = QUANTITIES[base_key(key)]
    return row.per_area_unit if per_area and row.per_area_unit else row.unit


def displayed(key: str, value: float, *, per_area: float | None = None) -> float:
    """Return an SI value in the display unit of its key; `per_area` is the piston area to divide by. [m2]"""
    return float(displayed_column(key, np.asarray(value), per_area=per_area))


def displayed_column(key: str, values: Array, *, per_area: float | None = None) -> Array:
    """Return SI values in the display unit of their key; `per_area` as `displayed` takes it."""
    if per_area is not None and QUANTITIES.get(base_key(key), None) and is_per_area(key):
        values = values / per_area
    # adding zero turns -0.0 into 0.0
    return np.asarray(from_si(values, key_unit(key, per_area=per_area is not None)) + 0.0)


def displayed_size(key: str, size: float) -> float:
    """Return a difference in the display unit of a key, whose zero does not count."""
    unit = key_unit(key)
    return float(from_si(size, unit) - from_si(0.0, unit)) if unit else size


def is_per_area(key: str) -> bool:
    """Return whether a quantity may be given by the piston area."""
    return not derived_unit(key) and bool(QUANTITIES[base_key(key)].per_area_unit)


def display_key(key: str, results: Results) -> str:
    """Return the key whose name a single value has: the mean torque may be what the driver must give.

    What several cylinders deliver is that of all.
    """
    engine = results.machine.engine
    if key in _DELIVERED and engine is not None and len(engine.layout.places) > 1:
        return f"{key}.all"
    return results.trace[key].key if key in MOVED and key in results.trace else key


def label(key: str, language: Language) -> str:
    """Return the name of a key: `largest piston velocity`, and with its own name `joint force, A`."""
    kind, name = key_of(key)
    name, sign, place = name.partition("@")
    if sign:
        return translate(
            "report.at_place", language, what=label(str(Key(kind, name)), language), place=_place(place, language)
        )
    if kind in _OF_ORDERS and name:
        # half orders where a cycle has two turns
        is_order = name.replace(".", "", 1).isdecimal()
        what = (
            translate("report.order", language, order=decimal(name, language)) if is_order else row_name(name, language)
        )
        return f"{translate(_OF_ORDERS[kind], language)}, {what}"
    if name in _EXTREMES:
        return _label(f"{kind}_{name}", language)
    return _label(kind, language, _part(kind, name, language) if name else "")


def _place(text: str, language: Language) -> str:
    """Return a crank angle or a time as a key names it: `33deg`, `0.2s`."""
    unit = "s" if text.endswith("s") else "deg"
    value = number(float(from_si(parse_in(text, unit), unit)), language)
    return f"{value}{'' if unit == 'deg' else ' '}{unit_name(unit, language)}"


def _part(kind: str, name: str, language: Language) -> str:
    """Return the name of a part of a quantity: the report's own phrase, or the name as it is."""
    if kind in (*_DELIVERED, *MOVED) and (name.isdecimal() or name == "all"):
        of_all = translate("drawing.all_cylinders", language)
        return of_all if name == "all" else translate("drawing.cylinder", language, number=name)
    if kind in ("motor_ratio", "synchronous_speed") and name.isdecimal():
        return translate("drawing.motor_of_speed", language, speed=name)
    if kind in _TORSION:
        # a flywheel is a disc there
        return ", ".join(link_label(part, language) for part in name.split("."))
    method_key = f"report.way_{name}"
    key = method_key if kind in _BY_WAY and has_text(method_key) else f"report.{name}"
    if has_text(key):
        return translate(key, language)
    return own_name(kind, link_label(name, language) if kind in _PLANES else name)


def link_label(link: str, language: Language) -> str:
    """Return the name of a link or guide; names that templates give, `rod_1` too, are those of the language."""
    names = texts("parts", language)
    kind, _, number = link.rpartition("_")
    return f"{names[kind]} {number}" if number.isdecimal() and kind in names else names.get(link, link)


def link_numbers(results: Results | None) -> dict[str, str]:
    """Return the numbers of the moving links of a linkage by name, none of another machine.

    Chambers and vessels whose names are words, none of them that of a link, have Roman numbers. A link that tells apart
    joints of one point has its number there too: `A_rod` is `A_2`.
    """
    linkage = results.machine.linkage if results is not None else None
    analysed = structure(linkage)[0] if linkage else None
    if linkage is None or analysed is None:
        return {}
    numbers = {name: str(number) for number, name in enumerate(analysed.links, start=1)}
    links = ((point, link) for point, owners in linkage.owners.items() for link in owners if link in numbers)
    held = (results.machine.chambers, results.machine.vessels) if results is not None else ()
    words = {name: ROMAN[k] for parts in held for k, name in enumerate(parts, 1) if len(name) > 2 and k < len(ROMAN)}
    words = {} if words.keys() & numbers.keys() else words
    return words | {f"{point}_{link}": f"{point}_{numbers[link]}" for point, link in links} | numbers


def row_name(name: str, language: Language) -> str:
    """Return the name of a row of a listing: `crankpin.1` is crankpin 1, and joints have their own names."""
    kind, number = key_of(name)
    if not has_text(f"report.{kind}"):
        return name
    what = translate(f"report.{kind}", language)
    if kind in _BY_ORDER:
        return f"{what}, {translate('report.order', language, order=number)}"
    return f"{what} {number}".rstrip()


def _label(key: str, language: Language, part: str = "") -> str:
    """Return the name of a kind of key, and with the name of the part that it belongs to."""
    if key in QUANTITIES:
        return owned_name(QUANTITIES[key].label(language), part)
    name = f"report.{key.removesuffix('_angle')}"
    if key.endswith(("_max_angle", "_min_angle")):
        name = "report.max_angle"
    elif key.endswith(("_max_time", "_min_time")):
        name = "report.max_time"
    for suffix in ("max", "min", "error", "difference"):
        if key.endswith(f"_{suffix}"):
            base = _label(key.removesuffix(f"_{suffix}"), language)
            if OWNED.search(base):
                base, part = owned_name(base, part), ""
            return owned_name(translate(f"report.{suffix}", language, name=base), part)
    return owned_name(translate(name, language), part)


def symbol(key: str, language: Language) -> str:
    """Return the symbol of a key; derived keys get the mark of what they are."""
    if unit := derived_unit(key):
        return QUANTITIES["crank_angle" if unit == "deg" else "time"].symbol(language)
    kind = key_of(key).quantity
    if kind in QUANTITIES:
        return QUANTITIES[kind].symbol(language)
    base = QUANTITIES[base_key(kind.removesuffix("_error"))].symbol(language)
    if kind.endswith(("_error", "_difference")):
        return f"Δ{base}"
    return f"{base}{',' if '_' in base else '_'}{kind[-3:]}"


def method_name(kinematics: str, order: int, rod: str, language: Language) -> str:
    """Return the method of a result in words; `rod` is empty for a machine without one."""
    name = translate(f"report.{kinematics}", language, order=order)
    return f"{name}; {translate(f'report.{rod}', language)}" if rod else name


def rounded(value: float, digits: int = 15) -> float:
    """Return a number without the noise of its last bit, for printing as data."""
    return float(f"{value:.{digits}g}") if math.isfinite(value) else value


def plain(value: object) -> object:
    """Return a value for data: a number rounded, None where it is none."""
    if isinstance(value, float):
        return rounded(value) if math.isfinite(value) else None
    return value
