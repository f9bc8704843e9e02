"""From the values of a machine file to the bearings of a linkage, and the crankshaft of one of rods and pistons."""

from __future__ import annotations

import math

from crankwork.description.friction_build import known_joints, pins_by_name
from crankwork.description.schema import Values
from crankwork.description.value_types import Reader
from crankwork.locale import ErrorMessage
from crankwork.machine import Bearings, Machine, PinBearing, Shaft
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Mechanism

_TABLES = ("shaft", "bearings", "balance")
# of bearings, what any linkage has whose crank turns fully
_OF_LINKAGE = {"pins", "rays"}


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
