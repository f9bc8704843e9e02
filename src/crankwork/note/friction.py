"""Friction in the joints of a linkage in its note."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from crankwork.analysis.input_loads import FrictionInput, stated_friction
from crankwork.note.document import Block, Citation, ItemList, Math, Run, Runs
from crankwork.note.material import Material
from crankwork.note.parts import At, Head, Lines, Places, Section, Shown, Text, When, amount, drawn, every, has, number
from crankwork.note.wording import Words, named
from crankwork.quantities.quantity import own_name
from crankwork.report.tables import any_nonzero

_SOURCE = "artobolevsky_1988, ch. 11, 14"
_WITH_FRICTION = (
    "torque_with_friction", "driver_force_with_friction", "driver_torque_with_friction", "static_torque_with_friction",
    "instantaneous_efficiency",
)  # fmt: skip
_JOINTS = ("friction_torque", "friction_force", "joint_force_with_friction", "normal_force_with_friction")


def _joints(material: Material) -> Iterator[Block]:
    """Yield what rubs, and how much."""
    joints = stated_friction(material.machine)
    yield ItemList(tuple(_friction_of_joint(joint, material.words) for joint in joints))


def _friction_of_joint(joint: FrictionInput, words: Words) -> Runs:
    """Return the friction of a joint in words."""
    runs: list[Run] = []
    for key, (value, unit) in joint.amounts.items():
        runs += [
            ", " if runs else f"{own_name('joint_force', joint.name)}: ",
            Math(words.symbol(key)),
            f" = {words.amount(value, unit)}",
        ]
    return tuple(runs)


def _columns(material: Material) -> Iterable[str]:
    columns = material.columns
    return any_nonzero([*named(columns, *_WITH_FRICTION), "friction_power", *named(columns, *_JOINTS)], columns)


SECTIONS = (
    Section("friction", (
        Head("friction"), Text("rubbing"), _joints, Text("with_friction", {"source": Citation(_SOURCE)}),
        At("friction"), Lines("friction"), Places("friction", _columns, "friction"),
        When(has("mean_friction_power"), (
            Text("mean_friction_power", {"value": amount("mean_friction_power", "W")}),
        )),
        When(has("mean_efficiency"), (Text("mean_efficiency", {"value": number("mean_efficiency")}),)),
        Shown(("friction",)),
    ), every(drawn, has("friction_power"), lambda material: bool(stated_friction(material.machine)))),
)  # fmt: skip
