"""Motor and flywheel of a linkage, and the end of the note: checks, main results, all columns, sources."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from crankwork.analysis.rounding import without_rounding
from crankwork.locale import say
from crankwork.note.comparison import comparison_blocks, main_numbers
from crankwork.note.document import Bibliography, Block, ItemList, Reference
from crankwork.note.flywheel import flywheel_by_methods
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_tables import equations, position_tables, quantity_columns
from crankwork.note.printed_units import printed_unit
from crankwork.note.words import Words, named
from crankwork.report.language import display_key, displayed, key_unit, label
from crankwork.report.notices import notice_text
from crankwork.report.tables import any_nonzero

_DYNAMICS = (
    "reduced_inertia", "reduced_inertia_1", "static_torque", "dynamic_torque", "balancing_torque", "driving_torque",
    "kinetic_energy_change", "crank_speed",
)  # fmt: skip
_MOTION = (
    "slider_displacement", "slider_velocity", "slider_acceleration",
    "link_angle", "link_angular_velocity", "link_angular_acceleration",
)  # fmt: skip


def motor(material: Material) -> Iterator[Block]:
    """Yield the choice of the motor, where there is one."""
    drive, words = material.machine.drive, material.words
    if drive.motor is None:
        return
    yield words.heading("motor")
    yield words.paragraph("motor", rated=words.amount(drive.rated_power, "kW"))
    yield from material.equations("motor")


def flywheel(material: Material) -> Iterator[Block]:
    """Yield the flywheel by every method, where one is wanted."""
    words, summary = material.words, material.results.summary
    if "excess_work" not in summary:
        return
    yield words.heading("flywheel")
    lines, wanted = material.lines("flywheel"), material.machine.drive.fluctuation
    if wanted is None:
        yield from equations(lines, words)
        return
    yield words.paragraph("flywheel", value=words.number(wanted))
    yield from flywheel_by_methods(lines, summary, words)
    yield from material.figures("wittenbauer")


def comparison(material: Material) -> Iterator[Block]:
    """Yield the values and curves of another machine beside those of this one."""
    words = material.words
    caption = words.caption("comparison")
    yield from comparison_blocks(material.results, words, words.heading("comparison"), caption)
    yield from material.figures("comparison")


def checks(material: Material) -> Iterator[Block]:
    """Yield the identities that were checked, and what the reader should know."""
    words, results = material.words, material.results
    if not (results.checks or results.notices or results.has_positions):
        return
    yield words.heading("checks")
    if results.checks:
        yield words.paragraph("identities")
        rows = [
            (say(f"report.{key}", words.language), words.number(100.0 * check, digits=2))
            for key, check in results.checks.items()
        ]
        yield words.table("identities", ("identity", "difference"), rows, "lr", "checks")
    elif results.has_positions:
        yield words.paragraph("no_checks")
    if results.notices:
        yield words.paragraph("notices")
        yield ItemList(tuple((notice_text(notice.code, notice.values, words.language),) for notice in results.notices))


def conclusion(material: Material) -> Iterator[Block]:
    """Yield the main results as a table."""
    words, results = material.words, material.results
    yield words.heading("results" if material.options.order == "en" else "conclusion")
    yield from main_numbers(results, words)
    yield words.paragraph("conclusion", table=Reference("summary"))
    rows = [_row(key, material) for key in results.summary if not _is_angle(key)]
    yield words.table("summary", ("quantity", "value", "unit", words.reached_at()), rows, "lrcr", "summary")


def _is_angle(key: str) -> bool:
    return key.partition(".")[0].endswith(("_max_angle", "_min_angle", "_max_time", "_min_time"))


def _row(key: str, material: Material) -> tuple[str, ...]:
    """Return name, value and unit of a single value, and the crank angle where it is reached."""
    words, summary = material.words, material.summary
    kind, dot, name = key.partition(".")
    angle = summary.get(f"{kind}_angle{dot}{name}") if kind.endswith(("_max", "_min")) else None
    angle_or_time = summary.get(f"{kind}_time{dot}{name}") if angle is None else float(np.degrees(angle))
    return (
        label(display_key(key, material.results), words.language)
        if not key.startswith("flywheel_inertia.")
        else _wheel(key, words),
        words.number(displayed(key, summary[key])),
        printed_unit(key_unit(key), words.language) or "–",
        "" if angle_or_time is None else words.number(angle_or_time, digits=4),
    )


def _wheel(key: str, words: Words) -> str:
    kind, _, method = key.partition(".")
    return f"{label(kind, words.language)}, {words.way(method)}"


def appendix(material: Material) -> Iterator[Block]:
    """Yield all columns at the step of the tables."""
    words, results = material.words, material.results
    columns, degrees = without_rounding(results.columns, results.machine.speed), results.grid.degrees
    if len(degrees) == len(material.positions) and np.allclose(degrees, material.positions):
        # the sections before have the same tables
        return
    over = "period" if words.period else "partial" if words.is_partial else "turn"
    yield words.heading(f"appendix_{over}")
    for caption, keys in (
        ("torques_all", any_nonzero(_DYNAMICS, results.columns)),
        ("driver_all", [key for key in columns if key.startswith("driver_")]),
        ("motion_all", named(columns, *_MOTION)),
        (
            f"reactions_{over}",
            material.nonzero("joint_force", "axial_force", "normal_force", "normal_moment"),
        ),
    ):
        shown = quantity_columns(keys, columns, words)
        yield from position_tables(caption, degrees, shown, words, first=None)


def sources(material: Material) -> Iterator[Block]:
    """Yield the bibliography."""
    yield material.words.heading("sources")
    yield Bibliography()
