"""A linkage as it is drawn: fixed points, a crank, links and sliding pieces in any order."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from crankwork.mechanism.dyads import Branch, Guide, Point
from crankwork.mechanism.mechanism import Crank

GROUND = "ground"


@dataclass(frozen=True)
class Member:
    """A link, or a piece that slides without turning on its guide."""

    name: str
    points: Mapping[str, Point]  # Its joints and other named points, in its own frame [m]
    guide: str = ""  # Name of the guide it slides on, its x axis on the line; empty for a link
    # Mass, and moment of inertia about the centre of mass [kg], [kg m2]
    mass: float = 0.0
    inertia: float = 0.0
    centre: str = ""  # Name of the point that is the centre of mass; empty where there is no mass


@dataclass(frozen=True)
class Linkage:
    """A planar linkage before it is taken apart."""

    crank: Crank  # The driving link
    ground: Mapping[str, Point]  # Fixed points by name [m]
    members: tuple[Member, ...]  # Links and sliding pieces, in any order
    # Straight guides by name, fixed or carried by a member, in its frame
    guides: Mapping[str, Guide] = field(default_factory=dict)
    # Branch by the name of the joint that it places, or of the slotted lever
    branches: Mapping[str, Branch] = field(default_factory=dict)
    # Roughly where joints are at a crank angle of zero; they settle the branches that are not given [m]
    positions: Mapping[str, Point] = field(default_factory=dict)
    # Further points of the crank: from the pivot towards the pin, and to the left of that [m]
    crank_points: Mapping[str, Point] = field(default_factory=dict)

    def member(self, name: str) -> Member:
        """Return the member of a name."""
        return next(one for one in self.members if one.name == name)

    @cached_property
    def owners(self) -> dict[str, list[str]]:
        """For every point what it belongs to: members, the crank, the ground."""
        owners: dict[str, list[str]] = {name: [GROUND] for name in self.ground}
        for name in (self.crank.pin, *self.crank_points):
            owners.setdefault(name, []).append(self.crank.link)
        for one in self.members:
            for name in one.points:
                owners.setdefault(name, []).append(one.name)
        return owners

    def at_zero(self) -> dict[str, Point]:
        """Return where points are at a crank angle of zero, as far as it is given. [m]"""
        (x, y), r, start = self.crank.pivot, self.crank.radius, self.crank.start
        pin = (x + r * math.cos(start), y + r * math.sin(start))
        cos, sin = math.cos(start), math.sin(start)
        throws = {name: (x + u * cos - v * sin, y + u * sin + v * cos) for name, (u, v) in self.crank_points.items()}
        return {**self.positions, **self.ground, **throws, self.crank.pin: pin}
