"""Masses and forces of one cylinder in the note of an engine."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.note.document import Block, Reference, Table
from crankwork.note.engine_material import Material
from crankwork.note.engine_tables import angle_table, long_table
from crankwork.report.tables import any_nonzero

_ALONG = ("gas_pressure", "gas_force", "piston_acceleration", "inertia_force", "weight_force", "piston_force")
_ACROSS = (
    "side_factor", "side_force", "rod_factor", "rod_force", "rod_transverse_force", "radial_factor", "radial_force",
    "tangential_factor", "tangential_force", "crank_torque",
)  # fmt: skip
_OF_PISTON = ("gas_force", "inertia_force", "piston_force")
_BEFORE_FORCES = (
    "rod_sine", "rod_cosine", "crank_rod_sine", "crank_rod_cosine", "cylinder_volume", "diagram_pressure",
    "gas_pressure", "gas_force",
)  # fmt: skip
_INERTIA = (
    "piston_transfer_1", "piston_transfer_2", "piston_acceleration", "inertia_acceleration", "inertia_force",
    "rotating_inertia_force",
)  # fmt: skip
# decimals of the table of forces that Vietnamese notes print
_VIETNAMESE = {"gas_force": 5, "inertia_force": 6, "piston_force": 6}


def dynamics(material: Material) -> Iterator[Block]:
    """Yield the section about masses and forces; nothing if neither is known."""
    words = material.words
    if "masses" not in material.groups and "forces" not in material.groups:
        return
    yield words.heading("dynamics")
    yield words.heading("masses", 2)
    yield from masses(material)
    if "forces" not in material.groups:
        return
    yield words.heading("forces", 2)
    yield from material.worked_at("forces")
    yield from material.equations("forces")
    yield from material.equations("reduction")
    yield from per_area(material)
    method = material.results.method
    keys = any_nonzero(_ALONG, material.columns)
    if method.inertia_rod_ratio is not None and not method.is_exact:
        # the acceleration of the columns is not the one that the inertia force is made of
        keys.remove("piston_acceleration")
    yield from material.presented([angle_table(material, "along", keys)], ("piston_forces",))
    across = [key for key in _ACROSS if key != "rod_transverse_force" or any_nonzero((key,), material.columns)]
    yield from material.presented(
        [angle_table(material, "forces", across)], ("rod_forces", "crankpin_forces", "torque")
    )
    yield words.heading("extremes", 2)
    yield from material.intro("extremes", material.equations("force_extremes"))
    yield from material.equations("power", "mean_torque", "mean_driving_torque")


def masses(material: Material) -> Iterator[Block]:
    """Yield the masses of the crank gear."""
    given = material.machine.masses
    rigid = given is not None and bool(given.rod_inertia_excess) and material.results.method.rod == "rigid"
    yield from material.intro("masses_rigid" if rigid else "masses", material.equations("masses"))


def per_area(material: Material) -> Iterator[Block]:
    """Yield how forces are related to the piston area, where they are."""
    if material.per_area:
        words = material.words
        value = words.amount(material.summary["piston_area"], "cm2")
        yield words.paragraph("per_area", value=value, unit=words.unit("gas_pressure"))


def inertia(material: Material) -> Iterator[Block]:
    """Yield masses and inertia force as a section of its own; nothing if no masses are known."""
    words = material.words
    if "masses" not in material.groups:
        return
    yield words.heading("inertia")
    yield from masses(material)
    yield from material.worked_at("forces")
    yield from material.intro("inertia", material.equations("forces", *_INERTIA))
    most = material.equations("force_extremes", "inertia_force_max", "inertia_force_min")
    yield from material.intro("extremes", most)
    if "forces" in material.groups:
        yield words.paragraph("see_table", tables=Reference("t:along"))


def along(material: Material) -> Iterator[Block]:
    """Yield the forces along the cylinder axis with the table that Vietnamese notes print."""
    words = material.words
    if "forces" not in material.groups:
        return
    yield words.heading("along")
    yield from material.worked_at("forces")
    yield from material.equations("forces", *_BEFORE_FORCES, "weight_force", "piston_force")
    yield from per_area(material)
    yield from material.presented([_along_table(material)], ("piston_forces",))
    most = material.equations("force_extremes", "piston_force_max", "piston_force_min")
    yield from material.intro("extremes", most)


def _along_table(material: Material) -> Table | None:
    """Return the gas force, inertia force and their sum, to six decimals where they are per area."""
    if not material.per_area:
        return long_table(material, "along", _OF_PISTON)
    return long_table(material, "along", _OF_PISTON, decimals=_VIETNAMESE)


def across(material: Material) -> Iterator[Block]:
    """Yield the forces on wall, rod and crankpin as a section of its own."""
    if "forces" not in material.groups:
        return
    yield material.words.heading("forces")
    yield from material.worked_at("forces")
    yield from material.equations("forces")
    yield from material.equations("reduction")
    shown = [key for key in _ACROSS if key != "rod_transverse_force" or any_nonzero((key,), material.columns)]
    figures = ("rod_forces", "crankpin_forces", "torque")
    yield from material.presented([angle_table(material, "forces", shown)], figures)
    yield from material.intro("extremes", material.equations("force_extremes"))
    yield from material.equations("power", "mean_torque", "mean_driving_torque")
