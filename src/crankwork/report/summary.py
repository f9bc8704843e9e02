"""The summary of results, and circuits and branches of a linkage: as text for the screen, and as data."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from crankwork.analysis import Results
from crankwork.analysis.assembly_modes import MOST_SIGNED, AssemblyMode, AssemblyModes
from crankwork.analysis.rounding_noise import summary_without_rounding, without_rounding
from crankwork.errors import CrankworkError
from crankwork.locale import ErrorMessage, translate
from crankwork.locale.numbers import number, unit_name
from crankwork.machine import Machine
from crankwork.mechanism.driver import LinkMotor
from crankwork.mechanism.structure import Structure, structure
from crankwork.quantities import SUBJECTS, Language, subject
from crankwork.report.display import (
    display_key,
    displayed,
    in_own_units,
    key_unit,
    label,
    link_label,
    method_name,
    rounded,
    symbol,
)
from crankwork.report.notices import assumption_texts, idle_texts, notice_text, screen_lines, sentence_lists
from crankwork.report.tables import comparison_data, comparison_text
from crankwork.version import __version__


def provenance_data(results: Results) -> dict[str, str]:
    """Return the provenance of an export: program, file, method."""
    return {
        "title": results.machine.title,
        "source": f"crankwork {__version__}",
        "method": results.method.name,
        "machine_file_sha256": results.machine.digest,
    }


def provenance(results: Results, method: str = "") -> str:
    """Return where results come from in one line; `method`: in other words than its name."""
    data = provenance_data(results)
    parts = [data["source"], method or data["method"], f"sha256 {data['machine_file_sha256']}"]
    return "; ".join(parts if results.machine.digest else parts[:2])


@in_own_units
def summary_data(results: Results, *, per_area: bool = False) -> dict[str, Any]:
    """Return the summary as plain data: where it comes from, value and unit by key, checks and notices."""
    area = results.value("piston_area") if per_area else None
    return {
        **provenance_data(results),
        "summary": {
            key: {"value": rounded(displayed(key, value, per_area=area)), "unit": key_unit(key, per_area=per_area)}
            for values in by_subject(results).values()
            for key, value in values.items()
        },
        "checks": dict(results.checks),
        "allowed": dict(results.allowed),
        "not_met": list(results.unmet),
        "notices": [notice_text(notice.code, notice.values, "en") for notice in results.notices],
        "assumptions": assumption_texts(results, "en"),
        "without_effect": idle_texts(results, "en"),
        **comparison_data(results, per_area=per_area),
    }


@in_own_units
def summary_text(results: Results, *, language: Language = "en", per_area: bool = False) -> str:
    """Return the summary as aligned text."""
    area = results.value("piston_area") if per_area else None
    lines = [results.machine.title] if results.machine.title else []
    lines.append(f"{translate('report.method', language)}: {results_method(results, language)}")
    if per_area:
        lines.append(translate("report.per_area", language))
    subjects = by_subject(results)
    rows = aligned([_row(results, entry, language, area) for values in subjects.values() for entry in values.items()])
    for name, values in subjects.items():
        lines += ["", *([translate(f"subjects.{name}", language)] if len(subjects) > 1 else [])]
        lines += rows[: len(values)]
        rows = rows[len(values) :]
    if not subjects and results.columns:
        lines += ["", values_text(results, 0.0, language)]
    if results.checks:
        lines += ["", translate("report.checks", language)]
        lines += aligned(
            [
                (
                    translate(f"report.{key}", language),
                    "",
                    number(value, language, digits=2),
                    check_status(results, key, language),
                )
                for key, value in results.checks.items()
            ]
        )
    if results.notices:
        lines += ["", translate("report.notices", language)]
        lines += [f"  {notice_text(notice.code, notice.values, language)}" for notice in results.notices]
    for heading, texts in sentence_lists(results, language):
        lines += ["", heading, *(f"  {line}" for line in screen_lines(texts, language))]
    if results.compared is not None:
        lines += ["", comparison_text(results, language, per_area=per_area)]
    return "\n".join(lines)


@in_own_units
def values_text(results: Results, place: float, language: Language = "en") -> str:
    """Return every column at a crank angle [deg] or time [s], with its key."""
    full = results.complete
    columns = full.columns_at([full.degrees_of(place) if full.period else place])
    keys = [key for key in dict.fromkeys((*results.columns, *full.columns)) if key in columns]
    if not {*keys} - {"crank_angle"}:
        raise CrankworkError(ErrorMessage("explain_nothing_varies"))
    # refused by its name where it is beyond the cycle or never reached
    full.value(next((key for key in keys if not math.isfinite(columns[key][0])), keys[0]), at=place)
    shown = without_rounding({key: columns[key] for key in keys}, results.machine.speed)
    rows = aligned([_row(full, (key, float(shown[key][0])), language) for key in keys])
    wide = max(map(len, rows))
    return "\n".join(f"{row:<{wide}}  {key}" for row, key in zip(rows, keys, strict=True))


def by_subject(results: Results) -> dict[str, dict[str, float]]:
    """Return the single values by subject, what the whole machine does before one cylinder and its working cycle."""
    values_of: dict[str, dict[str, float]] = {name: {} for name in SUBJECTS}
    for key, value in summary_without_rounding(results).items():
        name = subject(display_key(key, results))
        if name == "engine" and results.machine.lengths is None:
            # gas of a linkage has the names of that on a piston, and is that of a chamber
            name = "chambers" if results.machine.chambers else "shaft"
        values_of[name][key] = value
    return {name: values for name, values in values_of.items() if values}


def check_status(results: Results, key: str, language: Language) -> str:
    """Return the status of a check: that it is not met, or that an approximate method explains its residual."""
    if key in results.unmet:
        return translate("report.not_met", language)
    if key not in results.allowed:
        return ""
    return translate("report.within_error", language, error=number(results.allowed[key], language, digits=2))


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
    """Return the method of results in words."""
    if results.has_positions:
        return translate("report.tabulated", language)
    method, masses = results.method, results.machine.masses
    rod = method.rod if masses is not None and "rod_length" in results.summary else ""
    # without a moment of inertia of its own it is its two masses
    if rod == "rigid" and masses is not None and not masses.rod_inertia_excess:
        rod = "two-mass"
    return method_name(method.kinematics, method.order, rod, language)


def warning_text(results: Results, language: Language = "en") -> str:
    """Return in a sentence why results are not to be used as they are, or nothing."""
    if results.unmet:
        names = ", ".join(translate(f"report.{key}", language) for key in results.unmet)
        counts = {"count": len(results.unmet), "all": len(results.checks)}
        return translate("check.unmet", language, names=names, **counts)
    partial = next((notice for notice in results.notices if notice.code == "partial"), None)
    if partial is None:
        return ""
    notice = notice_text(partial.code, partial.values, language).partition(": ")[0]
    match partial.values["message"]:
        case ErrorMessage(name="branch_first", values=values):
            return translate("check.partial_branch", language, notice=notice, written=values["written"])
    return translate("check.partial", language, notice=notice)


@in_own_units
def description_text(results: Results, language: Language = "en") -> str:
    """Return the description of a machine in a few lines."""
    machine, summary = results.machine, results.summary
    keys = [key for key in summary if not any(part in key for part in ("_max", "_min")) and not key.endswith("_error")]
    rows = [_row(results, (key, summary[key]), language) for key in keys]
    return "\n".join([*_headline(machine, summary, language), *aligned(rows)])


def _row(
    results: Results, entry: tuple[str, float], language: Language, area: float | None = None
) -> tuple[str, str, str, str]:
    """Return name, symbol, value and unit of a single value; `area`: of the piston, to divide by. [m2]"""
    key, value = entry
    shown = number(displayed(key, value, per_area=area), language)
    unit = unit_name(key_unit(key, per_area=area is not None), language)
    return label(display_key(key, results), language), symbol(key, language), shown, unit


def _headline(machine: Machine, summary: Mapping[str, float], language: Language) -> list[str]:
    """Return the parts of a machine: a crank mechanism of known lengths, an engine, a table, a drawing, chambers."""
    lines = _crank_gear_lines(machine, summary, language) if "rod_length" in summary else []
    if machine.engine is not None:
        layout = machine.engine.layout
        count, order = len(layout.places), "-".join(map(str, layout.firing_order))
        kind = layout.kind if language == "en" else translate(f"kinds.{layout.kind}", language)
        key = "check.engine" if count > 1 else "check.engine_of_one"
        lines.append(translate(key, language, kind=kind, count=count, order=order))
    if machine.transfer is not None:
        bodies, positions = len(machine.transfer.bodies), len(machine.transfer.angles)
        lines.append(translate("check.table", language, bodies=bodies, positions=positions))
    if machine.turning is not None and machine.turning.diagrams:
        lines.append(translate("check.turning", language, cycle=f"{machine.cycle:g}"))
    if machine.rotor is not None:
        planes = translate(f"check.{'one_plane' if machine.rotor.is_flat else 'several_planes'}", language)
        lines.append(translate("check.rotor", language, count=len(machine.rotor.masses), planes=planes))
    if machine.stages is not None:
        count = sum(key.startswith("stage_pressure_ratio.") for key in summary)
        lines.append(translate("check.stages", language, count=count))
    if machine.torsion is not None:
        counts = {
            "discs": len(machine.torsion.discs) + len(machine.torsion.throws),
            "shafts": len(machine.torsion.shafts),
        }
        lines.append(translate("check.torsion", language, **counts))
    if machine.linkage is not None:
        lines += _drawing_lines(machine, language)
    if machine.chambers:
        lines.append(translate("check.chambers", language, names=", ".join(machine.chambers)))
    return lines


def _crank_gear_lines(machine: Machine, summary: Mapping[str, float], language: Language) -> list[str]:
    """Return that it is a slider-crank, and what is known of it besides."""
    parts = [translate("check.offset_slider_crank" if summary.get("offset") else "check.slider_crank", language)]
    gas = machine.gas
    if gas:
        source = "measured_gas" if gas.measured else "pieces_of_gas" if gas.calculated is None else "calculated_gas"
        parts.append(translate(f"check.{source}", language, count=len(gas.pieces), cycle=f"{gas.cycle:g}"))
    if machine.masses or not gas:
        parts.append(translate("check.with_masses" if machine.masses else "check.motion_only", language))
    return [", ".join(parts)]


def _drawing_lines(machine: Machine, language: Language) -> list[str]:
    """Return mobility, groups and formula of structure of a linkage as it was drawn."""
    analysed, _ = structure(machine.drawn)
    if analysed is None:
        return [translate("check.linkage", language)]
    numbered = ", ".join(
        f"{number} {link_label(name, language)}" for number, name in enumerate(analysed.links, start=1)
    )
    count, number = len(analysed.links), "I" * analysed.number if analysed.number < 4 else analysed.number
    return [
        translate("check.links", language, count=count, names=numbered),
        _mobility(analysed, language),
        translate("check.structure", language, formula=analysed.formula, number=number),
        *_grashof_lines(machine, language),
    ]


def _mobility(analysed: Structure, language: Language) -> str:
    """Return the mobility by the formula, with pairs of gears where there are some."""
    values = {"links": len(analysed.links), "joints": analysed.joints, "mobility": analysed.mobility}
    if analysed.meshes:
        return translate("check.mobility_geared", language, meshes=analysed.meshes, **values)
    return translate("check.mobility", language, **values)


def _grashof_lines(machine: Machine, language: Language) -> list[str]:
    """Return the type of a four-bar linkage by Grashof."""
    from crankwork.analysis.mechanism import four_bar_type  # noqa: PLC0415 - engines do not load it

    kind = four_bar_type(machine)
    if not kind:
        return []
    shown = kind if language == "en" else translate(f"kinds.{kind.replace(' ', '_')}", language)
    return [translate("check.grashof", language, kind=shown)]


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
