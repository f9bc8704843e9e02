"""Circuits and branches of a linkage as text and as plain data."""

from __future__ import annotations

import math
from typing import Any

from crankwork.analysis.assembly_modes import MOST_SIGNED, AssemblyMode, AssemblyModes
from crankwork.locale import translate
from crankwork.locale.numbers import number, unit_name
from crankwork.machine import Machine
from crankwork.mechanism.driver import LinkMotor
from crankwork.quantities import Language


def assembly_modes_text(machine: Machine, modes: AssemblyModes, language: Language = "en") -> str:
    """Return the circuits and branches of a linkage, one in a line."""
    lines = [translate("check.circuits", language)]
    lines += [f"  {_line(machine, mode, language)}" for mode in modes.branches]
    if not modes.is_all:
        lines.append("  " + translate("check.circuits_stated", language, most=MOST_SIGNED))
    return "\n".join(lines)


def _line(machine: Machine, mode: AssemblyMode, language: Language) -> str:
    driver = machine.mechanism.driver
    is_angle = driver.turns
    name = "–".join(driver.links) if isinstance(driver, LinkMotor) else driver.link

    def shown(value: float, *, is_turn: bool) -> str:
        unit = "deg" if is_turn else "mm"
        size = math.degrees(value) if is_turn else value * 1e3
        return number(size, language) + ("" if is_turn else " ") + unit_name(unit, language)

    if mode.turns > 1:
        moved = translate("check.way_turns_many", language, driver=name, turns=mode.turns)
    elif mode.turns:
        moved = translate("check.way_turns", language, driver=name)
    else:
        ends = {"start": shown(mode.start, is_turn=is_angle), "end": shown(mode.end, is_turn=is_angle)}
        moved = translate("check.way_between", language, driver=name, **ends)
    parts = [f"{link} {shown(swing, is_turn=True)}" for link, swing in mode.swings.items()]
    parts += [f"{piece} {shown(stroke, is_turn=False)}" for piece, stroke in mode.strokes.items()]
    key = "check.way_stated" if mode.is_stated else "check.way"
    text = translate(key, language, circuit=mode.circuit, branch=mode.branch, moved=moved)
    return f"{text}; {', '.join(parts)}" if parts else text


def assembly_modes_data(machine: Machine, modes: AssemblyModes) -> dict[str, Any]:
    """Return circuits and branches as plain data: angles in degrees, lengths in millimetres."""
    is_angle = machine.mechanism.driver.turns
    unit, size = ("deg", math.degrees(1.0)) if is_angle else ("mm", 1e3)
    return {
        "all": modes.is_all,
        "branches": [
            {
                "circuit": mode.circuit,
                "branch": mode.branch,
                "stated": mode.is_stated,
                "driver": {"start": mode.start * size, "end": mode.end * size, "unit": unit, "turns": mode.turns},
                "swings": {name: {"value": math.degrees(swing), "unit": "deg"} for name, swing in mode.swings.items()},
                "strokes": {name: {"value": stroke * 1e3, "unit": "mm"} for name, stroke in mode.strokes.items()},
            }
            for mode in modes.branches
        ],
    }
