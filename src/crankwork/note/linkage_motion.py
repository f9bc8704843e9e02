"""Kinematics of a linkage: plans, transfer functions, velocities and accelerations."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from crankwork.analysis.moving import transfer_ratios
from crankwork.analysis.rounding import without_rounding
from crankwork.note.document import Block, Citation, Reference, Runs, Table
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_tables import Column, quantity_columns
from crankwork.note.words import Words, named
from crankwork.report.language import row_name

_CENTRES = "khurmi_gupta_2005, ch. 6"
_SOURCE = "artobolevsky_1988, ch. 4"
MOVING = ("point_velocity", "link_angular_velocity", "slider_velocity")
ACCELERATING = ("point_acceleration", "link_angular_acceleration", "slider_acceleration")


def kinematics(material: Material) -> Iterator[Block]:
    """Yield the section about the motion."""
    words, columns = material.words, material.columns
    yield words.heading("linkage_kinematics")
    yield words.heading("plans", 2)
    yield words.paragraph("positions")
    yield from material.figures("position_plans")
    yield from material.table("positions", positions(material))
    yield words.heading("transfer", 2)
    yield words.paragraph("transfer", source=Citation(_SOURCE))
    yield from material.tabulated("transfer", _transfer_columns(material), label="transfer")
    yield words.heading("worked_motion", 2)
    yield from material.worked_at("motion")
    yield from material.equations("speed")
    yield from material.equations("motion")
    yield from material.table("velocities", named(columns, *MOVING))
    yield from material.table("accelerations", named(columns, *ACCELERATING, "coriolis_acceleration"))
    yield from instant_centres(material)
    yield from material.figures("centrodes", "points", "links")
    if material.drawn:
        yield words.heading("polygons", 2)
        yield words.paragraph("plan_numbers", table=Reference("links"))
        yield from material.figures("velocity_plan", "acceleration_plan", "sliders")


def positions(material: Material) -> list[str]:
    """Return the columns that say where points, links and sliders are."""
    return [*material.of_axes("point"), *named(material.columns, "link_angle", "slider_displacement")]


def instant_centres(material: Material) -> Iterator[Block]:
    """Yield where links turn about that have no fixed pivot, worked at one position and at all of them."""
    words, keys = material.words, material.of_axes("instant_centre")
    if not keys:
        return
    yield words.heading("instant_centres", 2)
    yield words.paragraph("instant_centres", source=Citation(_CENTRES))
    yield from material.worked("instant_centres")
    yield from material.table("instant_centres", keys)


def _transfer_columns(material: Material) -> list[Column]:
    """Return velocities of points and sliders and angular velocities of links, over that of the crank."""
    words = material.words
    ratios = transfer_ratios(material.machine.mechanism, material.positions)
    return [
        Column(
            words.titled(key, "m") if key.startswith("velocity_ratio.") else words.titled(key),
            words.column_texts(values.tolist()),
        )
        for key, values in without_rounding(ratios, 1.0).items()
    ]


def law_of_motion(material: Material) -> Iterator[Block]:
    """Yield the speed of the crank with the flywheel found, where it is known."""
    words, summary = material.words, material.results.summary
    has_speed = "crank_speed" in material.columns
    if not has_speed and "steady_speed" not in summary:
        return
    yield words.heading("law")
    if has_speed:
        yield words.paragraph("law")
        yield from material.table("speeds", ("kinetic_energy_change", "crank_speed"))
        yield from material.figures("speed")
    if "steady_speed" in summary:
        yield words.paragraph(
            "steady",
            speed=words.amount(summary["steady_speed"], "rpm"),
            fluctuation=words.number(summary["steady_fluctuation"]),
        )


_DYNAMICS = "artobolevsky_1988, ch. 15"
_ROWS = 21
_MOST_EVENTS = 24
_SHOWN = ("time", "crank_angle", "crank_speed", "angular_acceleration", "kinetic_energy", "potential_energy")


def transient(material: Material) -> Iterator[Block]:
    """Yield the section about the transient motion."""
    words, results, wanted = material.words, material.results, material.machine.transient
    if wanted is None or "transient" not in results.listings:
        return
    yield words.heading("transient")
    yield words.paragraph("transient_equation", source=Citation(_DYNAMICS))
    driven = "transient_motor" if wanted.motor else "transient_torque" if wanted.torque else "transient_free"
    yield words.paragraph(
        driven,
        angle=words.amount(wanted.start, "deg"),
        speed=words.amount(wanted.speed, "rad/s"),
        torque=words.amount(wanted.torque, "N*m"),
    )
    yield words.paragraph(
        "transient_end",
        time=words.amount(results.summary["transient_time"], "s"),
        turn=words.amount(results.summary["final_turn"], "deg"),
        speed=words.amount(results.summary["final_speed"], "rad/s"),
    )
    columns = results.listings["transient"].columns
    count = len(columns["time"])
    rows = np.unique(np.round(np.linspace(0, count - 1, min(_ROWS, count))).astype(int))
    keys = [*(key for key in _SHOWN if np.any(columns[key])), *named(columns, "slider_displacement")]
    yield _table("transient", {key: columns[key][rows] for key in keys}, words)
    yield from material.figures("transient")
    happened = results.listings.get("transient_events")
    if happened is not None:
        names = [row_name(name, words.language) for name in happened.names[:_MOST_EVENTS]]
        shown = {key: column[:_MOST_EVENTS] for key, column in happened.columns.items()}
        yield _table("transient_events", shown, words, names)


def _table(caption: str, columns: dict[str, np.ndarray], words: Words, names: list[str] | None = None) -> Table:
    """Return columns as a table, rows called by names where they have some."""
    made = quantity_columns(columns, columns, words)
    titles: list[Runs] = [column.heading for column in made]
    entries = [column.entries for column in made]
    if names is not None:
        titles.insert(0, (words.column("event"),))
        entries.insert(0, names)
    align = "l" * (names is not None) + "r" * len(made)
    return words.table(caption, titles, list(zip(*entries, strict=True)), align, caption)
