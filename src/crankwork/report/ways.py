"""Circuits and branches of a linkage as text and as plain data."""

from __future__ import annotations

import math
from typing import Any

from crankwork.analysis.ways import MOST_SIGNED, Way, Ways
from crankwork.locale import say
from crankwork.locale.numbers import number, unit_name
from crankwork.machine import Machine
from crankwork.mechanism.driver import LinkMotor
from crankwork.quantities import Language


def ways_text(machine: Machine, found: Ways, language: Language = "en") -> str:
    """Return the circuits and branches of a linkage, one in a line."""
    lines = [say("check.circuits", language)]
    lines += [f"  {_line(machine, one, language)}" for one in found.found]
    if not found.is_all:
        lines.append("  " + say("check.circuits_stated", language, most=MOST_SIGNED))
    return "\n".join(lines)


def _line(machine: Machine, way: Way, language: Language) -> str:
    driver = machine.mechanism.driver
    is_angle = driver.turns
    name = "–".join(driver.links) if isinstance(driver, LinkMotor) else driver.link

    def shown(value: float, *, is_turn: bool) -> str:
        unit = "deg" if is_turn else "mm"
        size = math.degrees(value) if is_turn else value * 1e3
        return number(size, language) + ("" if is_turn else " ") + unit_name(unit, language)

    if way.turns > 1:
        moved = say("check.way_turns_many", language, driver=name, turns=way.turns)
    elif way.turns:
        moved = say("check.way_turns", language, driver=name)
    else:
        ends = {"start": shown(way.start, is_turn=is_angle), "end": shown(way.end, is_turn=is_angle)}
        moved = say("check.way_between", language, driver=name, **ends)
    parts = [f"{link} {shown(one, is_turn=True)}" for link, one in way.swings.items()]
    parts += [f"{piece} {shown(one, is_turn=False)}" for piece, one in way.strokes.items()]
    told = "check.way_stated" if way.is_stated else "check.way"
    said = say(told, language, circuit=way.circuit, branch=way.branch, moved=moved)
    return f"{said}; {', '.join(parts)}" if parts else said


def ways_data(machine: Machine, found: Ways) -> dict[str, Any]:
    """Return circuits and branches as plain data: angles in degrees, lengths in millimetres."""
    is_angle = machine.mechanism.driver.turns
    unit, size = ("deg", math.degrees(1.0)) if is_angle else ("mm", 1e3)
    return {
        "all": found.is_all,
        "branches": [
            {
                "circuit": one.circuit,
                "branch": one.branch,
                "stated": one.is_stated,
                "driver": {"start": one.start * size, "end": one.end * size, "unit": unit, "turns": one.turns},
                "swings": {name: {"value": math.degrees(swing), "unit": "deg"} for name, swing in one.swings.items()},
                "strokes": {name: {"value": stroke * 1e3, "unit": "mm"} for name, stroke in one.strokes.items()},
            }
            for one in found.found
        ],
    }
