"""A linkage as it is drawn: fixed points, a driver, links and sliding pieces in any order."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from crankwork.mechanism.driver import DrivingSlider
from crankwork.mechanism.dyads import Branch, Guide, Point
from crankwork.mechanism.mechanism import Crank, Driver, crank_of

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

    driver: Driver
    ground: Mapping[str, Point]  # Fixed points by name [m]
    members: tuple[Member, ...]  # Links and sliding pieces, in any order
    # Straight guides by name, fixed or carried by a member, in its frame
    guides: Mapping[str, Guide] = field(default_factory=dict)
    # Branch by the name of the joint that it places, or of the slotted lever
    branches: Mapping[str, Branch] = field(default_factory=dict)
    # Roughly where joints are at the beginning; they settle the branches that are not given [m]
    positions: Mapping[str, Point] = field(default_factory=dict)
    # Points and mass of a driving link; points of a crank are further ones, from the pivot towards the pin, and left
    driving: Member = Member("", {})
    geared: tuple[Member, ...] = ()  # Points and masses of the cranks that gears turn with the driving one

    @property
    def crank(self) -> Crank:
        """The crank, of a linkage that one drives."""
        return crank_of(self.driver)

    @property
    def base(self) -> frozenset[str]:
        """What is placed before any group: the ground, and the link that drives."""
        is_link = isinstance(self.driver, Crank | DrivingSlider)
        geared = (one.name for one in self.geared)
        return frozenset({GROUND, self.driver.link, *geared} if is_link else {GROUND})

    def member(self, name: str) -> Member:
        """Return the member of a name."""
        return next(one for one in self.members if one.name == name)

    @cached_property
    def owners(self) -> dict[str, list[str]]:
        """For every point what it belongs to: members, the driving link, the ground."""
        owners: dict[str, list[str]] = {name: [GROUND] for name in self.ground}
        pin = (self.driver.pin,) if isinstance(self.driver, Crank) else ()
        for name in (*pin, *self.driving.points):
            owners.setdefault(name, []).append(self.driver.link)
        for one in (*self.geared, *self.members):
            for name in one.points:
                owners.setdefault(name, []).append(one.name)
        return owners

    def base_frame(self, link: str) -> tuple[Point, float]:
        """Where the frame of a link that is placed first is at the beginning, and its direction. [m], [rad]"""
        match self.driver:
            case Crank(pivot=pivot, start=start, direction=direction, law=law, geared=geared):
                turned = direction * law.start if law else 0.0
                for one in geared:
                    if one.link == link:
                        return one.pivot, one.start + one.ratio * turned
                return pivot, start + turned
            case DrivingSlider(guide=guide, law=law):
                (x, y), angle = guide.point, guide.angle
                return (x + law.start * math.cos(angle), y + law.start * math.sin(angle)), angle
        raise TypeError(f"{self.driver.link} has no place of its own")

    def at_zero(self) -> dict[str, Point]:
        """Return where points are at the beginning, as far as it is given. [m]"""
        if self.base == {GROUND}:
            return {**self.positions, **self.ground}
        pin = {self.driver.pin: (self.driver.radius, 0.0)} if isinstance(self.driver, Crank) else {}
        placed: dict[str, Point] = {}
        for one in (self.driving, *self.geared):
            (x, y), angle = self.base_frame(one.name)
            cos, sin = math.cos(angle), math.sin(angle)
            points = {**one.points, **(pin if one is self.driving else {})}
            placed |= {name: (x + u * cos - v * sin, y + u * sin + v * cos) for name, (u, v) in points.items()}
        return {**self.positions, **self.ground, **placed}
