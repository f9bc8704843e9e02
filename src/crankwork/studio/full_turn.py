"""The least change of one length that lets a rocking crank turn fully."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from crankwork.analysis import Results
from crankwork.analysis.full_turn import full_turn_bounds
from crankwork.description.document import Description
from crankwork.errors import CrankworkError
from crankwork.locale import Language, say
from crankwork.locale.numbers import number, unit_name
from crankwork.mechanism.mechanism import Crank
from crankwork.units import from_si

_DIGITS = 3
# relative error of bounds found between sampled positions
_ROUNDING = 1e-6


def full_turn(
    description: Description, results: Results, handles: Iterable[Mapping[str, Any]], language: Language
) -> dict[str, str] | None:
    """Return the least change of one length that lets a rocking crank turn fully; None if there is none."""
    crank_range, mechanism = results.machine.way, results.machine.mechanism
    if crank_range is None or crank_range.is_whole or not isinstance(mechanism.driver, Crank):
        return None
    stated = {handle["key"]: handle for handle in handles}
    choices = []
    for bound in full_turn_bounds(mechanism):
        handle = stated.get(bound.key)
        if handle is None or handle["power"] != 1:
            continue
        value = _rounded(float(from_si(bound.length, handle["unit"])), bound.sign)
        if value > 0:
            choices.append((abs(value / handle["number"] - 1), bound, f"{value:g} {handle['unit']}", value))
    for _, bound, written, value in sorted(choices):
        try:
            other = description.machine([f"{bound.key}={written}"])
        except CrankworkError:
            continue
        if other.way is None or other.way.is_whole:
            name = bound.key.rpartition(".")[0].removeprefix("links.")
            name = bound.key if name.isdigit() else name
            shown = f"{number(value, language)} {unit_name(stated[bound.key]['unit'], language)}"
            start, end = (number(round(angle, 1), language) for angle in (crank_range.start, crank_range.end))
            text = say("studio.full_turn", language, name=name, sign=bound.sign, value=shown, start=start, end=end)
            return {"key": bound.key, "value": written, "text": text, "use": say("studio.use", language, value=shown)}
    return None


def _rounded(value: float, sign: str) -> float:
    """Return a bound rounded to the side where it holds; at the bound itself links come into line."""
    step = 10.0 ** (math.floor(math.log10(abs(value) or 1.0)) + 1 - _DIGITS)
    parts = value / step
    slack = _ROUNDING * abs(parts)
    steps = math.floor(parts + slack) + 1 if sign == "≥" else math.ceil(parts - slack) - 1
    return round(steps * step, 12)
