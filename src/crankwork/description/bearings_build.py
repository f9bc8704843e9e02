"""Bearings of a linkage, from the values of a machine file."""

from __future__ import annotations

from crankwork.description.friction_build import known_joints, pins_by_name
from crankwork.description.kinds import Reader
from crankwork.description.schema import Values
from crankwork.locale import Refusal
from crankwork.machine import Bearings, PinBearing
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Mechanism


def build_bearings(values: Values, mechanism: Mechanism, reader: Reader, *, turns: bool) -> Bearings:
    """Return the bearings in the joints of a linkage; report unknown joints, and links that a joint does not hold.

    `turns`: whether the crank turns fully.
    """
    if "bearings" not in values:
        return Bearings()
    if not turns:
        reader.complain("bearings", Refusal("bearings_partial"))
    table, pins = values["bearings"], pins_by_name(mechanism)
    names = {joint: name for name, joint in pins.items()}
    bearings = {}
    for joint, stated in known_joints(table["pins"], pins, "bearings.pins", reader):
        name, link, held = names[joint], stated["link"] or "", [joint.link, joint.other]
        bearings[name] = PinBearing(stated.si("diameter"), stated.si("length"), link)
        if link and (link == GROUND or link not in held):
            reader.complain(f"bearings.pins.{name}.link", Refusal("bearing_link", pin=name, known=", ".join(held)))
    made: Bearings = table.made(Bearings, pins=bearings)
    return made
