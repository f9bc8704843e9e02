"""The summary of results: as text for the screen, and as data."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from types import ModuleType
from typing import TYPE_CHECKING, Any

from crankwork.analysis import Results
from crankwork.machine import Machine
from crankwork.quantities import Language
from crankwork.report.language import (
    displayed,
    key_unit,
    label,
    method_name,
    number,
    rounded,
    symbol,
    unit_name,
    word,
)
from crankwork.report.notices import notice_text

if TYPE_CHECKING:
    from crankwork.linkage_machine import AnyMachine


# A residual above this is more than rounding.
_MET = 1e-7


def summary_data(results: Results, *, per_area: bool = False) -> dict[str, Any]:
    """Return the summary as plain data: method, value and unit by key, checks and notices.

    Parameters
    ----------
    results : Results
        The results.
    per_area : bool
        Divide forces by the piston area.
    """
    area = results.summary["piston_area"] if per_area else None
    return {
        "method": results.method.name,
        "title": results.machine.title,
        "summary": {
            key: {"value": rounded(displayed(key, value, per_area=area)), "unit": key_unit(key, per_area=per_area)}
            for key, value in results.summary.items()
        },
        "checks": dict(results.checks),
        "notices": [notice_text(notice.code, notice.values, "en") for notice in results.notices],
    }


def summary_text(results: Results, *, language: Language = "en", per_area: bool = False) -> str:
    """Return the summary as aligned text.

    Parameters
    ----------
    results : Results
        The results.
    language : str
        Its language.
    per_area : bool
        Divide forces by the piston area.
    """
    area = results.summary["piston_area"] if per_area else None
    lines = [results.machine.title] if results.machine.title else []
    lines.append(f"{word('method', language)}: {results_method(results, language)}")
    if per_area:
        lines.append(word("per_area", language))
    rows = [
        (
            label(key, language),
            symbol(key, language),
            number(displayed(key, value, per_area=area), language),
            unit_name(key_unit(key, per_area=per_area), language),
        )
        for key, value in results.summary.items()
    ]
    lines += ["", *aligned(rows)]
    if results.checks:
        lines += ["", word("checks", language)]
        checks = results.checks.items()
        lines += aligned(
            [
                (word(key, language), "", number(value, language, digits=2), word("not_met", language) * (value > _MET))
                for key, value in checks
            ]
        )
    if results.notices:
        lines += ["", word("notices", language)]
        lines += [f"  {notice_text(one.code, one.values, language)}" for one in results.notices]
    return "\n".join(lines)


def aligned(rows: list[tuple[str, str, str, str]]) -> list[str]:
    """Return label, symbol, value and unit in columns."""
    if not rows:
        return []
    widths = [max(len(row[i]) for row in rows) for i in range(4)]
    return [
        f"  {name:<{widths[0]}}  {mark:<{widths[1]}}  {value:>{widths[2]}} {unit}".rstrip()
        for name, mark, value, unit in rows
    ]


def results_method(results: Results, language: Language) -> str:
    """Return how results were made, in words."""
    if not isinstance(results.machine, Machine):
        return str(_linkages().method_words(results.machine, language))
    method = results.method
    return method_name(method.kinematics, method.order, method.rod, language)


def _linkages() -> ModuleType:
    """Return the words for linkages, loaded when there is one: an engine starts faster without them."""
    return importlib.import_module("crankwork.report.linkage_summary")


def description_text(machine: AnyMachine, results: Results) -> str:
    """Return what a machine file describes, in a few lines of English.

    Parameters
    ----------
    machine : Machine, LinkageMachine or TabulatedMachine
        The machine.
    results : Results
        Its results, for the derived lengths and volumes.
    """
    summary = results.summary
    keys = [key for key in summary if not any(part in key for part in ("_max", "_min")) and not key.endswith("_error")]
    rows = [
        (
            label(key, "en"),
            symbol(key, "en"),
            number(displayed(key, summary[key]), "en"),
            unit_name(key_unit(key), "en"),
        )
        for key in keys
    ]
    return "\n".join([*_headline(machine, summary), *aligned(rows)])


def _headline(machine: AnyMachine, summary: Mapping[str, float]) -> list[str]:
    if not isinstance(machine, Machine):
        return list(_linkages().headline(machine))
    parts = ["slider-crank" if not summary.get("offset") else "offset slider-crank"]
    if machine.gas:
        source = "measured pressure" if machine.gas.measured else f"{len(machine.gas.pieces)} pieces of gas pressure"
        if machine.gas.calculated is not None:
            source = "calculated pressure"
        parts.append(f"{source} over {machine.gas.cycle:g} deg")
    parts.append("with masses" if machine.masses else "motion only")
    lines = [", ".join(parts)]
    if machine.engine is not None:
        layout = machine.engine.layout
        order = "-".join(map(str, layout.firing_order))
        count = len(layout.places)
        lines.append(f"{layout.kind} engine of {count} cylinder{'s' * (count > 1)}, firing order {order}")
    return lines
