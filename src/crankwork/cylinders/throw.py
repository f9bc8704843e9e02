"""The crank mechanism of one throw: all rods on one crankpin, or on the master rod there."""

from __future__ import annotations

import math
from collections.abc import Sequence

from crankwork.cylinders.articulated import ArticulatedRod
from crankwork.cylinders.layout import Layout
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.mechanism.dyads import RRP
from crankwork.mechanism.mechanism import Crank, LinkPoint, Mechanism

_UP = math.pi / 2


def throw_mechanism(
    layout: Layout,
    lengths: SliderCrank,
    articulated_rods: Sequence[ArticulatedRod | None] = (),
    offsets: Sequence[float] = (),
    crankpin: int | None = None,
) -> Mechanism:
    """Return the mechanism of a crankpin, by default that of cylinder 1, with the crank turning clockwise.

    Crankpin A, piston pins B1, B2 ... and knuckle pins C2, C3 ... by the numbers of the cylinders; at a crank angle
    of zero the crank of cylinder 1 lies along its axis. `lengths`: crank, rod and offset of every cylinder, of the
    master for articulated rods [m]; `articulated_rods`: that of each cylinder that has one; `offsets`: of
    each cylinder, if they differ [m].
    """
    first = layout.places[0]
    wanted = first.crankpin if crankpin is None else crankpin
    # a master rod comes before the rods that it carries
    on_pin = (candidate for candidate in layout.places if candidate.crankpin == wanted)
    places = sorted(on_pin, key=lambda candidate: candidate.master > 0)
    points, rods = [], []
    for place in places:
        articulated = articulated_rods[place.number - 1] if articulated_rods else None
        axis = math.radians(place.axis)
        joint, length = "A", lengths.rod_length
        offset = offsets[place.number - 1] if offsets else lengths.offset
        if articulated is not None:
            angle = math.radians(articulated.knuckle_angle)
            joint, length, offset = f"C{place.number}", articulated.length, articulated.offset
            along, across = articulated.knuckle_radius * math.cos(angle), -articulated.knuckle_radius * math.sin(angle)
            points.append(LinkPoint(joint, f"rod {place.master}", along, across))
        guide_point = (offset * math.cos(axis), -offset * math.sin(axis))
        pin, name = f"B{place.number}", f"rod {place.number}"
        rods.append(RRP(joint, pin, name, length, guide_point=guide_point, guide_angle=_UP - axis))
    start = _UP - math.radians(first.axis + places[0].pin_angle)
    crank = Crank(lengths.crank_radius, start=start, direction=-1, pin="A")
    return Mechanism(crank, tuple(rods), points=tuple(points))
