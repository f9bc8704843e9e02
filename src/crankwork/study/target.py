"""Target equations of `solve`: a value of the results, where it is taken, and its target."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from crankwork.analysis import Results, analyse, columns_only, value_only
from crankwork.analysis.requested_values import place_of, with_requested
from crankwork.errors import CrankworkError
from crankwork.formula.traced_value import TracedValue
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.report.display import key_unit
from crankwork.units import parse_in, use_units

# in SI: rounding
_SAME = 1e-12
_EXAMPLE = "piston_force@33deg = 0"


class Target(NamedTuple):
    """A value of the results: key, crank angle or time, and its target. [SI]"""

    key: str
    position: float | None  # Crank angle [deg], or time with a time-based driver [s]
    level: float


class TargetText(NamedTuple):
    """An equation as text: left side, position after an @ there, right side."""

    key: str
    place: str
    level: str


def split_target(equation: str) -> TargetText:
    """Split the text of an equation."""
    left, sign, right = (part.strip() for part in equation.rpartition("="))
    key, place_sign, place = (part.strip() for part in left.rpartition("@"))
    key, place = (key, place) if place_sign else (left, "")
    if not sign or not key or not right or (place_sign and not place) or len(equation) > 200:
        raise CrankworkError(ErrorMessage("equation_form", equation=equation[:60], example=_EXAMPLE))
    return TargetText(key, place, right)


def parse_target(parts: TargetText, results: Results) -> Target:
    """Parse and validate a target equation against the results of the stated machine."""
    key, place, right = results.current(parts.key), parts.place, parts.level
    results = results if place else with_requested(results, [key])
    if key not in results:
        # raises an error with the nearest keys
        results.value(key)
    results = results.holding(key)
    known = results.trace.get(key)
    varies = known.varies if known is not None else key in results.columns
    if place and not varies:
        raise CrankworkError(ErrorMessage("place_meaningless", key=key))
    if varies and not place:
        example = f"{results.period / 2:g}s" if results.period else "90deg"
        raise CrankworkError(ErrorMessage("place_missing", key=key, example=f"{key}@{example}"))
    position = place_of(place, is_time=bool(results.period)) if place else None
    # raises an error for an angle outside the cycle
    results.value(key, position)
    with use_units(results.machine.units):
        return Target(key, position, level(key, right))


def level(key: str, text: str) -> float:
    """Return a target in SI; a bare number is in the unit of the tables."""
    unit = key_unit(key)
    try:
        value = parse_in(text, unit) if unit else float(text.replace(",", "."))
    except ValueError as error:
        mistake = error.args[0] if unit else ErrorMessage("level_plain", text=text[:40])
        raise CrankworkError(ErrorMessage("option_wrong", option=f"{key} = {text[:40]}", mistake=mistake)) from None
    if not math.isfinite(value):
        raise CrankworkError(ErrorMessage("option_wrong", option=f"{key} = {text[:40]}",
                                     mistake=ErrorMessage("level_plain", text=text[:40])))  # fmt: skip
    return value


def value_function(target: Target, machine: Machine, results: Results) -> Callable[[Machine], float]:
    """Return the function that gives a value of variants of a machine by the cheapest analysis.

    Cheaper analyses are compared with the full one for this machine.
    """
    key, position, _ = target
    methods: list[Callable[[Machine], Results]] = [analyse]
    if machine.transient is not None:
        methods.insert(0, lambda variant: analyse(replace(variant, transient=None)))
    if position is None:
        methods.insert(0, lambda variant: value_only(variant, key))
    elif not results.has_positions:
        methods.insert(0, columns_only)
    value = results.value(key, position)
    for method in methods[:-1]:
        partial = method(machine)
        if key in partial.trace and math.isclose(partial.value(key, position), value, abs_tol=_SAME):
            return lambda variant: method(variant).value(key, position)
    return lambda variant: (with_requested(analyse(variant), [key]) if position is None else analyse(variant)).value(
        key, position
    )


def is_rounding(target: Target, results: Results) -> bool:
    """Return whether a value is only the rounding error of larger ones."""
    results = results.holding(target.key)
    known: TracedValue | None = results.trace.get(target.key)
    if known is None or results.has_positions:
        return False
    return results.moment(0.0 if target.position is None else results.degrees_of(target.position)).is_noise(known)
