"""Kinematics of a linkage: plans, transfer functions, velocities and accelerations."""

from __future__ import annotations

import math
from collections.abc import Iterator

from crankwork.analysis.moving import transfer_ratios
from crankwork.analysis.rounding import without_rounding
from crankwork.note.document import Block, Citation, Reference
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_tables import Column, equations, position_tables, quantity_columns
from crankwork.note.linkage_words import named

_CENTRES = "khurmi_gupta_2005, ch. 6"
_SOURCE = "artobolevsky_1988, ch. 4"
_MOVING = ("point_velocity", "link_angular_velocity", "slider_velocity")
_ACCELERATING = ("point_acceleration", "link_angular_acceleration", "slider_acceleration", "coriolis_acceleration")


def kinematics(material: Material) -> Iterator[Block]:
    """Yield the section about the motion."""
    words, columns, degrees = material.words, material.columns, material.positions
    yield words.heading("linkage_kinematics")
    yield words.heading("plans", 2)
    yield words.paragraph("positions")
    yield from material.figures("position_plans")
    places = [f"point_{axis}.{key.partition('.')[2]}" for key in named(columns, "point_x") for axis in "xy"]
    keys = [*places, *named(columns, "link_angle", "slider_displacement")]
    yield from position_tables(
        "positions", degrees, quantity_columns(keys, columns, words), words, first=material.first
    )
    yield words.heading("transfer", 2)
    yield words.paragraph("transfer", source=Citation(_SOURCE))
    yield from position_tables(
        "transfer", degrees, _transfer_columns(material), words, first=material.first, label="transfer"
    )
    yield words.heading("worked_motion", 2)
    yield from worked_at(material, "motion")
    yield from equations(material.lines("speed"), words)
    yield from equations(material.lines("motion"), words)
    velocities = quantity_columns(named(columns, *_MOVING), columns, words)
    yield from position_tables("velocities", degrees, velocities, words, first=material.first)
    accelerations = quantity_columns(named(columns, *_ACCELERATING), columns, words)
    yield from position_tables("accelerations", degrees, accelerations, words, first=material.first)
    yield from instant_centres(material)
    yield from material.figures("centrodes", "points", "links")
    if material.drawn:
        yield words.heading("polygons", 2)
        yield words.paragraph("plan_numbers", table=Reference("links"))
        yield from material.figures("velocity_plan", "acceleration_plan", "sliders")


def instant_centres(material: Material) -> Iterator[Block]:
    """Yield where links turn about that have no fixed pivot, worked at one position and at all of them."""
    words, columns = material.words, material.columns
    keys = [
        f"instant_centre_{axis}.{key.partition('.')[2]}" for key in named(columns, "instant_centre_x") for axis in "xy"
    ]
    if not keys:
        return
    yield words.heading("instant_centres", 2)
    yield words.paragraph("instant_centres", source=Citation(_CENTRES))
    yield from worked_at(material, "instant_centres")
    yield from equations(material.lines("instant_centres"), words)
    shown = quantity_columns(keys, columns, words)
    yield from position_tables("instant_centres", material.positions, shown, words, first=material.first)


def worked_at(material: Material, group: str) -> Iterator[Block]:
    """Yield the sentence that says at which crank angle a group is worked."""
    found = material.groups.get(group)
    if found is not None and found.degrees is not None:
        words = material.words
        if words.period:
            yield words.paragraph("worked_time", value=words.amount(words.place(found.degrees)[1], "s"))
            return
        yield words.paragraph("worked_position", value=words.amount(math.radians(found.degrees), "deg"))


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
        keys = ("kinetic_energy_change", "crank_speed")
        shown = quantity_columns(keys, material.columns, words)
        yield from position_tables("speeds", material.positions, shown, words, first=material.first)
        yield from material.figures("speed")
    if "steady_speed" in summary:
        yield words.paragraph(
            "steady",
            speed=words.amount(summary["steady_speed"], "rpm"),
            fluctuation=words.number(summary["steady_fluctuation"]),
        )
