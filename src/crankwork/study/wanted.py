"""What is asked of a machine: a value of its results, where, and what it is to be."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from crankwork.analysis import Results, analyse, columns_only, value_only
from crankwork.errors import CrankworkError
from crankwork.formula.known import Known
from crankwork.locale import Refusal
from crankwork.machine import Machine
from crankwork.report.language import key_unit
from crankwork.units import parse_in, use_units

# in SI: rounding
_SAME = 1e-12
_EXAMPLE = "piston_force@33deg = 0"


class Wanted(NamedTuple):
    """A value of the results: its key, where it is taken, as results take it, and what it is to be. [SI]"""

    key: str
    at: float | None  # Crank angle [deg], or time where a law drives [s]
    level: float


class Written(NamedTuple):
    """An equation as it is written: what stands on its left, after an @ there, and on its right."""

    key: str
    place: str
    level: str


def written(equation: str) -> Written:
    """Return the parts of an equation."""
    left, sign, right = (part.strip() for part in equation.rpartition("="))
    key, place_sign, place = (part.strip() for part in left.rpartition("@"))
    key, place = (key, place) if place_sign else (left, "")
    if not sign or not key or not right or (place_sign and not place) or len(equation) > 200:
        raise CrankworkError(Refusal("equation_form", equation=equation[:60], example=_EXAMPLE))
    return Written(key, place, right)


def wanted(parts: Written, results: Results) -> Wanted:
    """Return what is asked of a machine like one whose results are at hand, or refuse what it cannot have."""
    key, place, right = parts
    if key not in results:
        # which names the nearest there are
        results.value(key)
    known = results.memory.get(key)
    varies = known.varies if known is not None else key in results.columns
    if place and not varies:
        raise CrankworkError(Refusal("place_meaningless", key=key))
    if varies and not place:
        example = f"{results.period / 2:g}s" if results.period else "90deg"
        raise CrankworkError(Refusal("place_missing", key=key, example=f"{key}@{example}"))
    at = _place(place, is_time=bool(results.period)) if place else None
    # refuses an angle outside the cycle
    results.value(key, at)
    with use_units(results.machine.units):
        return Wanted(key, at, level(key, right))


def _place(text: str, *, is_time: bool) -> float:
    """Return a crank angle [deg] or a time [s]."""
    try:
        value = parse_in(text, "s" if is_time else "deg")
    except ValueError as error:
        raise CrankworkError(Refusal("option_wrong", option=f"@{text}", mistake=error.args[0])) from None
    return value if is_time else round(math.degrees(value), 9)


def level(key: str, text: str) -> float:
    """Return what a value is to be; a bare number is in the unit in which tables show it. [SI]"""
    unit = key_unit(key)
    try:
        value = parse_in(text, unit) if unit else float(text.replace(",", "."))
    except ValueError as error:
        told = error.args[0] if unit else Refusal("level_plain", text=text[:40])
        raise CrankworkError(Refusal("option_wrong", option=f"{key} = {text[:40]}", mistake=told)) from None
    if not math.isfinite(value):
        raise CrankworkError(Refusal("option_wrong", option=f"{key} = {text[:40]}",
                                     mistake=Refusal("level_plain", text=text[:40])))  # fmt: skip
    return value


def shortest(asked: Wanted, machine: Machine, results: Results) -> Callable[[Machine], float]:
    """Return the function that gives a value of machines like one, by no more of an analysis than it takes.

    What a part of the analysis gives is compared with what all of it gave for this machine.
    """
    ways: list[Callable[[Machine], Results]] = [analyse]
    if machine.transient is not None:
        ways.insert(0, lambda one: analyse(replace(one, transient=None)))
    if asked.at is None:
        ways.insert(0, lambda one: value_only(one, asked.key))
    elif not results.has_positions:
        ways.insert(0, columns_only)
    value = results.value(asked.key, asked.at)
    for way in ways[:-1]:
        found = way(machine)
        if asked.key in found.memory and math.isclose(found.value(asked.key, asked.at), value, abs_tol=_SAME):
            return lambda one: way(one).value(asked.key, asked.at)
    return lambda one: analyse(one).value(asked.key, asked.at)


def is_rounding(asked: Wanted, results: Results) -> bool:
    """Return whether a value is only what rounding has left of larger ones."""
    known: Known | None = results.memory.get(asked.key)
    if known is None or results.has_positions:
        return False
    return results.moment(0.0 if asked.at is None else results.degrees_of(asked.at)).is_noise(known)
