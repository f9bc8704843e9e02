"""From the values of a machine file to friction and bearings of a linkage, and the crankshaft of rods and pistons."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TypeVar

from crankwork.description.schema import Values
from crankwork.description.value_types import Reader
from crankwork.dynamics.force_system import all_links_and_joints
from crankwork.dynamics.friction import Circle, Friction, GuideFriction, PinFriction
from crankwork.locale import ErrorMessage
from crankwork.machine import Bearings, Machine, PinBearing, Shaft
from crankwork.mechanism.dyads import Chain, Point
from crankwork.mechanism.joints import Pin, names_of_pivots
from crankwork.mechanism.linkage import GROUND, Linkage
from crankwork.mechanism.mechanism import Crank, Mechanism

J = TypeVar("J")
_TABLES = ("shaft", "bearings", "balance")
# of bearings, what any linkage has whose crank turns fully
_OF_LINKAGE = {"pins", "rays"}


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


def build_bearings(values: Values, mechanism: Mechanism, reader: Reader, *, turns: bool) -> Bearings:
    """Return the bearings of a linkage; report unknown joints, and links that a joint does not hold.

    `turns`: whether the crank turns fully.
    """
    if "bearings" not in values:
        return Bearings()
    table = values["bearings"]
    if not turns and not _of_crankshaft(values):
        reader.add_error("bearings", ErrorMessage("bearings_partial"))
    pins = pins_by_name(mechanism)
    names = {joint: name for name, joint in pins.items()}
    bearings = {}
    for joint, stated in known_joints(table["pins"], pins, "bearings.pins", reader):
        name, link, held = names[joint], stated["link"] or "", [joint.link, joint.other]
        bearings[name] = PinBearing(stated.si("diameter"), stated.si("length"), link)
        if link and (link == GROUND or link not in held):
            reader.add_error(
                f"bearings.pins.{name}.link", ErrorMessage("bearing_link", pin=name, known=", ".join(held))
            )
    made: Bearings = table.made(Bearings, pins=bearings)
    return made


def build_shaft(values: Values, reader: Reader) -> Shaft | None:
    """Return the crankshaft that a file describes, None if it says nothing of it."""
    if not _of_crankshaft(values):
        return None
    shaft, sizes, balance = (values[name] for name in _TABLES)
    check_counterweights(sizes, balance, reader)
    firing = {name: math.degrees(angle.value) for name, angle in shaft["firing"].items() if angle is not None}
    return Shaft(
        cylinders=_names(shaft["cylinders"]),
        positions={name: position.value for name, position in shaft["positions"].items() if position is not None},
        journals=tuple(position.value for position in shaft["journals"] if position is not None),
        throws=tuple(_names(pins) for pins in shaft["throws"] if pins),
        firing=firing,
        period=float(shaft["period"].split()[0]) if shaft["period"] else None,
        reference=shaft.si("reference"),
        misfires=_names(shaft["misfire"]),
        bore=shaft.si("bore"),
        counterweight=sizes.si("counterweight"),
        rotating_share=balance["rotating_share"],
        reciprocating_share=balance["reciprocating_share"],
        balance_shafts=tuple(dict.fromkeys(balance["shafts"])),
    )


def _of_crankshaft(values: Values) -> tuple[str, ...]:
    """Return the tables of a file that say something of the crankshaft of rods and pistons."""
    return tuple(
        name for name in _TABLES if name in values and not (name == "bearings" and set(values[name]) <= _OF_LINKAGE)
    )


def check_counterweights(sizes: Values, balance: Values, reader: Reader) -> None:
    """Report counterweights that are stated twice: as mass moments, and as a share of the masses."""
    if sizes.si("counterweight") and balance["rotating_share"]:
        reader.add_error("bearings.counterweight", ErrorMessage("counterweight_twice"))


def check_shaft(machine: Machine, values: Values, reader: Reader) -> bool:
    """Return whether a linkage is that of a crankshaft if its file describes one; report if not."""
    if machine.shaft is None:
        return True
    # most linkages do not load it
    from crankwork.analysis.cylinder_form import engine_form_or_reason  # noqa: PLC0415

    form = engine_form_or_reason(machine)
    if isinstance(form, Machine):
        return True
    if form.key:
        reader.add_error(form.key, form.message)
    else:
        for table in _of_crankshaft(values):
            reader.add_error(table, ErrorMessage("shaft_of_engine", reason=form.message))
    return False


def _names(listed: list[str | None]) -> tuple[str, ...]:
    return tuple(name for name in listed if name)
