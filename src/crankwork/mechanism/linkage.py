"""A linkage as it is drawn: fixed points, a driver, links and sliding pieces in any order."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

from crankwork.mechanism.driver import DrivingSlider
from crankwork.mechanism.dyads import Branch, Guide, Point
from crankwork.mechanism.mechanism import Crank, Driver, crank_of

GROUND = "ground"


class LengthInertia(NamedTuple):
    """A moment of inertia stated as a share of m l^2: about the centre of mass, or of a uniform bar about its end."""

    share: float  # Of the mass times the square of the length [-]
    about_end: bool = False

    def about_centre(self, mass: float, length: float) -> float:
        """Return the moment of inertia about the centre of mass; that of a bar is in its middle. [kg m2]"""
        return mass * length**2 * (self.share - (0.25 if self.about_end else 0.0))


class MassPerLength(NamedTuple):
    """A mass stated per length of a bar. [kg/m]"""

    value: float


@dataclass(frozen=True)
class Member:
    """A link, or a piece that slides without turning on its guide."""

    name: str
    points: Mapping[str, Point]  # Its joints and other named points, in its own frame [m]
    guide: str = ""  # Name of the guide it slides on, its x axis on the line; empty for a link
    # Mass, and moment of inertia about the centre of mass [kg], [kg m2]
    mass: float = 0.0
    inertia: float = 0.0
    centre: str = ""  # Name of the point at the centre of mass; empty without mass
    # Its distance from the first joint over that of the second, if it is stated so [-]
    centre_share: float | None = None
    # How the mass and the moment of inertia follow from the length, if they are stated so, and that length [m]
    length_mass: MassPerLength | None = None
    length_inertia: LengthInertia | None = None
    gyration_radius: float = 0.0  # From which the moment of inertia follows, if it is stated so [m]
    bar_length: float = 0.0


@dataclass(frozen=True)
class Linkage:
    """A planar linkage before its decomposition."""

    driver: Driver
    ground: Mapping[str, Point]  # Fixed points by name [m]
    members: tuple[Member, ...]  # Links and sliding pieces, in any order
    # Straight guides by name, fixed or carried by a member, in its frame
    guides: Mapping[str, Guide] = field(default_factory=dict)
    # Branch by the name of the joint that it places, or of the slotted lever
    branches: Mapping[str, Branch] = field(default_factory=dict)
    # Approximate initial positions of joints, which determine branches that are not given [m]
    positions: Mapping[str, Point] = field(default_factory=dict)
    # Points and mass of the driving link; points of a crank besides its pin, along and to the left of the arm
    driving: Member = Member("", {})
    geared: tuple[Member, ...] = ()  # Points and masses of the geared cranks

    @property
    def crank(self) -> Crank:
        """The crank, if the driver is one."""
        return crank_of(self.driver)

    @property
    def base(self) -> frozenset[str]:
        """The links placed before any group: the ground, and the driving links."""
        is_link = isinstance(self.driver, Crank | DrivingSlider)
        geared = (crank.name for crank in self.geared)
        return frozenset({GROUND, self.driver.link, *geared} if is_link else {GROUND})

    def member(self, name: str) -> Member:
        """Return the member with a name."""
        return next(member for member in self.members if member.name == name)

    @cached_property
    def owners(self) -> dict[str, list[str]]:
        """The owners of every point: members, the driving link, the ground."""
        owners: dict[str, list[str]] = {name: [GROUND] for name in self.ground}
        pin = (self.driver.pin,) if isinstance(self.driver, Crank) else ()
        for name in (*pin, *self.driving.points):
            owners.setdefault(name, []).append(self.driver.link)
        for member in (*self.geared, *self.members):
            for name in member.points:
                owners.setdefault(name, []).append(member.name)
        return owners

    def base_frame(self, link: str) -> tuple[Point, float]:
        """Return the initial origin and direction of the frame of a link that is placed first. [m], [rad]"""
        match self.driver:
            case Crank(pivot=pivot, start=start, direction=direction, law=law, geared=geared):
                turned = direction * law.start if law else 0.0
                for crank in geared:
                    if crank.link == link:
                        return crank.pivot, crank.start + crank.ratio * turned
                return pivot, start + turned
            case DrivingSlider(guide=guide, law=law):
                (x, y), angle = guide.point, guide.angle
                return (x + law.start * math.cos(angle), y + law.start * math.sin(angle)), angle
        raise TypeError(f"{self.driver.link} has no place of its own")

    def at_zero(self) -> dict[str, Point]:
        """Return the initial positions of points that are given. [m]"""
        if self.base == {GROUND}:
            return {**self.positions, **self.ground}
        pin = {self.driver.pin: (self.driver.radius, 0.0)} if isinstance(self.driver, Crank) else {}
        placed: dict[str, Point] = {}
        for link in (self.driving, *self.geared):
            (x, y), angle = self.base_frame(link.name)
            cos, sin = math.cos(angle), math.sin(angle)
            points = {**link.points, **(pin if link is self.driving else {})}
            placed |= {name: (x + u * cos - v * sin, y + u * sin + v * cos) for name, (u, v) in points.items()}
        return {**self.positions, **self.ground, **placed}
