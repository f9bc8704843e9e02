"""Motion of piston and rod in the note of an engine."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from crankwork.note.document import Block, Reference, Table
from crankwork.note.engine_material import Material
from crankwork.note.engine_tables import angle_table

_NOUNS = ("piston_displacement", "piston_velocity", "piston_acceleration")
_ROD = ("rod_angle", "rod_angular_velocity", "rod_angular_acceleration")
_SWING = ("rod_sine", "rod_cosine", "crank_rod_sine", "crank_rod_cosine", "rod_angle")
_ORDERS = ("first", "second")


def kinematics(material: Material) -> Iterator[Block]:
    """Yield the section about the motion: displacement, velocity and acceleration in one."""
    words = material.words
    yield words.heading("kinematics")
    yield from material.worked_at("motion")
    yield from material.equations("motion")
    yield words.heading("harmonics", 2)
    yield from material.intro("orders", material.equations("harmonics"))
    yield words.heading("extremes", 2)
    yield from material.intro("extremes", material.equations("extremes"))
    keys = [f"{noun}{order}" for noun in _NOUNS for order in ("_first_order", "_second_order", "")]
    yield words.paragraph("repeats")
    tables = [angle_table(material, "motion", keys, one_turn=True), angle_table(material, "rod", _ROD, one_turn=True)]
    yield from material.presented(tables, ("kinematics", "brix", "tolle"))
    yield from error_bound(material)


def displacement(material: Material) -> Iterator[Block]:
    """Yield the section about the displacement, by the construction of Brix."""
    words = material.words
    yield words.heading("brix")
    yield words.paragraph("brix")
    yield from material.worked_at("motion")
    yield from material.equations("motion", *_SWING, "piston_displacement")
    yield from material.equations("harmonics", "piston_displacement_first_order", "piston_displacement_second_order")
    yield words.paragraph("repeats")
    yield from material.presented([_table(material, "displacement")], ("brix",))


def velocity(material: Material) -> Iterator[Block]:
    """Yield the section about the velocity."""
    yield material.words.heading("velocity")
    yield from material.worked_at("motion")
    yield from material.equations("motion", "piston_transfer_1", "piston_velocity")
    kinds = ("piston_transfer_1", "piston_velocity")
    yield from material.equations("harmonics", *(f"{kind}_{order}_order" for kind in kinds for order in _ORDERS))
    yield from material.equations("motion", "rod_transfer_1", "rod_angular_velocity")
    most = material.equations("extremes", "piston_velocity_max_angle", "piston_velocity_max", "piston_velocity_min")
    yield from material.intro("extremes", most)
    yield from material.presented([_table(material, "velocity")], ("kinematics",))


def acceleration(material: Material) -> Iterator[Block]:
    """Yield the section about the acceleration over the displacement, by the construction of Tolle."""
    yield material.words.heading("acceleration")
    yield material.words.paragraph("tolle")
    yield from material.worked_at("motion")
    yield from material.equations("motion")
    yield from material.equations("harmonics")
    yield from material.intro("extremes", material.equations("extremes"))
    tables = [_table(material, "acceleration"), angle_table(material, "rod", _ROD, one_turn=True)]
    yield from material.presented(tables, ("tolle",))
    yield from error_bound(material)


def _table(material: Material, noun: str) -> Table | None:
    """Return the table of one of displacement, velocity, acceleration with its first two orders."""
    keys = [f"piston_{noun}_{order}_order" for order in _ORDERS]
    return angle_table(material, noun, [*keys, f"piston_{noun}"], one_turn=True)


def error_bound(material: Material) -> Iterator[Block]:
    """Yield how far the method is from exact; nothing if it is exact."""
    largest_errors = errors(material)
    if "piston_acceleration_error" in largest_errors:
        share = material.words.number(100 * largest_errors["piston_acceleration_error"][1], digits=2)
        yield material.words.paragraph("error", share=share, table=Reference("t:errors"))
    if "inertia_force_error" in largest_errors:
        share = material.words.number(100 * largest_errors["inertia_force_error"][1], digits=2)
        yield material.words.paragraph("force_error", share=share)


def errors(material: Material) -> dict[str, tuple[float, float]]:
    """Return the largest errors against exact [SI], and their shares of the largest value, by key."""
    largest_errors = {}
    for key in (name for name in material.summary if name.endswith("_error")):
        values = material.results.columns.get(key.removesuffix("_error"))
        if values is not None and np.any(values):
            largest_errors[key] = (material.summary[key], material.summary[key] / float(np.max(np.abs(values))))
    return largest_errors
