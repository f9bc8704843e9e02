"""Friction of a linkage, from the values of a machine file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeVar

from crankwork.description.schema import Values
from crankwork.description.value_types import Reader
from crankwork.dynamics.force_system import all_links_and_joints
from crankwork.dynamics.friction import Circle, Friction, GuideFriction, PinFriction
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.dyads import Point
from crankwork.mechanism.joints import Pin, names_of_pivots
from crankwork.mechanism.linkage import Linkage
from crankwork.mechanism.mechanism import Crank, Mechanism

J = TypeVar("J")


def build_friction(values: Values, linkage: Linkage, mechanism: Mechanism, reader: Reader) -> tuple[Friction, ...]:
    """Return the friction of pins and guides; report unknown joints."""
    table = values.get("friction")
    if table is None:
        return ()
    held = all_links_and_joints(mechanism)[1]
    guides = {joint.name: joint.name for joint in held if not isinstance(joint, Pin)}
    circle: Circle = table["circle"] or "tangent"
    pin_friction = tuple(
        PinFriction(
            joint.name,
            stated.si("radius") or 0.0,
            stated["coefficient"],
            stated.si("moment"),
            stated.si("damping"),
            circle,
        )
        for joint, stated in known_joints(table["pins"], pins_by_name(mechanism), "friction.pins", reader)
    )
    guide_friction = tuple(
        _guide(name, stated, _middle(name, linkage, mechanism))
        for name, stated in known_joints(table["sliders"], guides, "friction.sliders", reader)
    )
    return (*pin_friction, *guide_friction)


def _guide(name: str, values: Values, middle: Point) -> GuideFriction:
    length, force, damping = (values.si(key) or 0.0 for key in ("length", "force", "damping"))
    return GuideFriction(name, values["coefficient"], length, force, damping, middle)


def _middle(name: str, linkage: Linkage, mechanism: Mechanism) -> Point:
    """Return the origin of a sliding piece, a point of its guide, relative to the pin that it is solved at."""
    member = next((candidate for candidate in linkage.members if candidate.name == name), None)
    chained = (link.name for group in mechanism.dyads if isinstance(group, Chain) for link in group.links)
    if member is None or not member.points or name in chained:
        return 0.0, 0.0
    further = {placed.name: (placed.along, placed.across) for placed in mechanism.points if placed.link == name}
    point = next(iter(further), next(iter(member.points)))
    (x, y), (u, v) = further.get(point, (0.0, 0.0)), member.points[point]
    return x - u, y - v


def pins_by_name(mechanism: Mechanism) -> dict[str, Pin]:
    """Return the revolute joints by the names that files have for them; a pivot has that of its fixed point."""
    shown = names_of_pivots(mechanism)
    held = all_links_and_joints(mechanism)[1]
    return {shown.get(joint.name, joint.name): joint for joint in held if isinstance(joint, Pin)}


def known_joints(
    tables: Mapping[str, Values | None], known: Mapping[str, J], path: str, reader: Reader
) -> Iterator[tuple[J, Values]]:
    """Yield known joints with their tables; report unknown joints."""
    for name, table in tables.items():
        if name not in known:
            kind = "sliders" if path.endswith("sliders") else "pins"
            message = ErrorMessage(f"absent_rubbing_{kind}", name=name, known=", ".join(known) or "–")
            reader.add_error(f"{path}.{name}", message)
        elif table is not None:
            yield known[name], table


def check_friction(machine: Machine, reader: Reader) -> None:
    """Report friction in machines whose joint forces are calculated without it."""
    if not machine.friction:
        return
    crank = machine.mechanism.driver
    if machine.redundant:
        reader.add_error("friction", ErrorMessage("friction_redundant", name=machine.redundant[0].member.name))
    if machine.mechanism.passages:
        reader.add_error("friction", ErrorMessage("friction_passages"))
    toothed = [geared.link for geared in crank.geared if geared.pressure_angle] if isinstance(crank, Crank) else []
    if toothed:
        reader.add_error(f"geared.{toothed[0]}.pressure_angle", ErrorMessage("friction_teeth"))
