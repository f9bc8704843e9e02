"""What the note of a linkage says of friction: what rubs, its forces and losses, the torque that it costs."""

from __future__ import annotations

from collections.abc import Iterator

from crankwork.analysis.stated import StatedFriction, stated_friction
from crankwork.note.document import Block, Citation, ItemList, Math, Run, Runs
from crankwork.note.linkage_material import Material
from crankwork.note.linkage_motion import worked_at
from crankwork.note.linkage_tables import equations, position_tables, quantity_columns
from crankwork.note.linkage_words import Words, named
from crankwork.report.tables import any_nonzero

_SOURCE = "artobolevsky_1988, ch. 11, 14"
_TORQUES = (
    "torque_with_friction", "driver_force_with_friction", "driver_torque_with_friction", "static_torque_with_friction",
    "instantaneous_efficiency",
)  # fmt: skip
_JOINTS = ("friction_torque", "friction_force", "joint_force_with_friction", "normal_force_with_friction")


def friction(material: Material) -> Iterator[Block]:
    """Yield the section about friction in the joints."""
    words, columns, summary = material.words, material.columns, material.results.summary
    rubbing = stated_friction(material.machine)
    if not rubbing or "friction_power" not in columns:
        return
    yield words.heading("friction")
    yield words.paragraph("rubbing")
    yield ItemList(tuple(_rubbing(one, words) for one in rubbing))
    yield words.paragraph("with_friction", source=Citation(_SOURCE))
    yield from worked_at(material, "friction")
    yield from equations(material.lines("friction"), words)
    keys = any_nonzero([*named(columns, *_TORQUES), "friction_power", *named(columns, *_JOINTS)], columns)
    shown = quantity_columns(keys, columns, words)
    yield from position_tables("friction", material.positions, shown, words, first=material.first, label="friction")
    if "mean_friction_power" in summary:
        yield words.paragraph("mean_friction_power", value=words.amount(summary["mean_friction_power"], "W"))
    if "mean_efficiency" in summary:
        yield words.paragraph("mean_efficiency", value=words.number(summary["mean_efficiency"]))
    yield from material.figures("friction")


def _rubbing(one: StatedFriction, words: Words) -> Runs:
    """Return a joint that rubs in words."""
    runs: list[Run] = []
    for key, (value, unit) in one.amounts.items():
        runs += [
            ", " if runs else f"{one.name.replace('_', ' ')}: ",
            Math(words.symbol(key)),
            f" = {words.amount(value, unit)}",
        ]
    return tuple(runs)
