"""The crank gear of one throw as a mechanism: all rods that turn on one crankpin, or on the master rod there."""

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
    slaves: Sequence[ArticulatedRod | None] = (),
    offsets: Sequence[float] = (),
    crankpin: int | None = None,
) -> Mechanism:
    """Return the rods and pistons of a crankpin, that of cylinder 1 if none is named, the crank turning clockwise.

    Crankpin A, piston pins B1, B2 ... and knuckle pins C2, C3 ... by the numbers of the cylinders; at a crank angle
    of zero the crank of cylinder 1 lies along its axis. `lengths`: crank, rod and offset of every cylinder, of the
    master where rods are articulated [m]; `slaves`: the articulated rod of each cylinder that has one; `offsets`: of
    each cylinder, if they differ [m].
    """
    first = layout.places[0]
    wanted = first.crankpin if crankpin is None else crankpin
    # a rod stands before those that it carries
    places = sorted((one for one in layout.places if one.crankpin == wanted), key=lambda one: one.master > 0)
    points, rods = [], []
    for place in places:
        slave = slaves[place.number - 1] if slaves else None
        axis = math.radians(place.axis)
        joint, length = "A", lengths.rod_length
        offset = offsets[place.number - 1] if offsets else lengths.offset
        if slave is not None:
            angle = math.radians(slave.knuckle_angle)
            joint, length, offset = f"C{place.number}", slave.length, slave.offset
            along, across = slave.knuckle_radius * math.cos(angle), -slave.knuckle_radius * math.sin(angle)
            points.append(LinkPoint(joint, f"rod {place.master}", along, across))
        beside = (offset * math.cos(axis), -offset * math.sin(axis))
        rods.append(
            RRP(joint, f"B{place.number}", f"rod {place.number}", length, guide_point=beside, guide_angle=_UP - axis)
        )
    start = _UP - math.radians(first.axis + places[0].pin_angle)
    crank = Crank(lengths.crank_radius, start=start, direction=-1, pin="A")
    return Mechanism(crank, tuple(rods), points=tuple(points))
