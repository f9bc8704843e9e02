"""Lengths with which a crank that turns back would turn fully, changed one at a time."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.position_analysis import place
from crankwork.mechanism.dyads import RPR, RRP, RRR, Chain, Dyad
from crankwork.mechanism.mechanism import Mechanism

_DENSE = CrankGrid.steps(0.1, 360.0)
_PASSED = 1e-9


class LengthBound(NamedTuple):
    """The key of a length, and its least or greatest value. [m]"""

    key: str
    sign: str
    length: float


def full_turn_bounds(mechanism: Mechanism) -> Iterator[LengthBound]:
    """Yield the bounds of lengths with which the first dyad that does not close all round would close."""
    placed = place(mechanism, _DENSE)
    still = np.zeros(len(_DENSE))
    points = {name: np.array([axis.position + still for axis in value]) for name, value in placed.points.items()}
    for dyad, closure in zip(mechanism.dyads, placed.closures, strict=True):
        # a change point is passed
        if np.all(closure.value > -_PASSED * closure.scale):
            continue
        yield from _of_dyad(dyad, points)
        yield from _of_crank(mechanism, dyad)
        return


def _of_dyad(dyad: Dyad | Chain, points: Mapping[str, Array]) -> Iterator[LengthBound]:
    match dyad:
        case RRR():
            distance = np.hypot(*(points[dyad.joint_a] - points[dyad.joint_b]))
            near, far = float(distance.min()), float(distance.max())
            links = (dyad.link_a, dyad.length_a), (dyad.link_b, dyad.length_b)
            for (link, own), (_, other) in (links, links[::-1]):
                least, most = max(far - other, other - near), other + near
                if least <= most:
                    yield LengthBound(
                        f"links.{link}.length", "≥" if own < least else "≤", least if own < least else most
                    )
        case RRP(guide_link=""):
            x, y = (points[dyad.joint].T - dyad.guide_point).T
            offset = np.abs(y * math.cos(dyad.guide_angle) - x * math.sin(dyad.guide_angle))
            yield LengthBound(f"links.{dyad.link}.length", "≥", float(offset.max()))


def _of_crank(mechanism: Mechanism, dyad: Dyad | Chain) -> Iterator[LengthBound]:
    """Yield the greatest length of the crank for a dyad between crank and ground."""
    crank = mechanism.crank
    match dyad:
        case RRR() if crank.pin in (dyad.joint_a, dyad.joint_b):
            other = dyad.joint_b if dyad.joint_a == crank.pin else dyad.joint_a
            if other in mechanism.ground:
                frame = math.dist(crank.pivot, mechanism.ground[other])
                short = abs(dyad.length_a - dyad.length_b)
                yield LengthBound("crank.radius", "≤", min(dyad.length_a + dyad.length_b - frame, frame - short))
        case RRP(guide_link="") if dyad.joint == crank.pin:
            x, y = (item - other for item, other in zip(crank.pivot, dyad.guide_point, strict=True))
            offset = abs(y * math.cos(dyad.guide_angle) - x * math.sin(dyad.guide_angle))
            yield LengthBound("crank.radius", "≤", dyad.length - offset)
        case RPR() if dyad.joint == crank.pin and dyad.pivot in mechanism.ground:
            (x, y), angle = dyad.slot.point, dyad.slot.angle
            offset = abs(y * math.cos(angle) - x * math.sin(angle))
            yield LengthBound("crank.radius", "≤", math.dist(crank.pivot, mechanism.ground[dyad.pivot]) - offset)
