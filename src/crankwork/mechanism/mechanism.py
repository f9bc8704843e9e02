"""Mechanisms: a driver and an ordered list of dyads, with bodies and named points."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from crankwork.mechanism.driver import Cylinder, CylinderPart, DrivingSlider, GearedCrank, Law, LinkMotor
from crankwork.mechanism.dyads import RRP, Bar, Branch, Chain, ChangePointPassage, Dyad, Point

_TURN = 360.0
# largest period in turns of the crank, and tolerance of a gear ratio that is one of integers
_MAX_TURNS, _RATIO_TOLERANCE = 6, 1e-9


@dataclass(frozen=True)
class Crank:
    """A link that turns about a fixed pivot and drives the mechanism."""

    radius: float  # Distance from pivot to pin [m]
    pivot: Point = (0.0, 0.0)  # Coordinates of the fixed axis [m]
    start: float = 0.0  # Direction of the crank arm at crank angle zero, from the x axis [rad]
    direction: Branch = 1  # 1 if the crank angle grows anticlockwise, -1 if clockwise
    # Names of the moving end and of the link
    pin: str = "crank_pin"
    link: str = "crank"
    law: Law | None = None  # Its motion law; without one it is at the angle of the tables
    geared: tuple[GearedCrank, ...] = ()  # Cranks that are geared to it

    turns = True


Driver = Crank | DrivingSlider | Cylinder | LinkMotor


@dataclass(frozen=True)
class LinkPoint:
    """A named point that moves with a link: a coupler point, a further joint, a centre of mass."""

    # Name of the point, and of the link or sliding piece it belongs to
    name: str
    link: str
    # Coordinates in the frame of the link: from its first joint towards its second, and to the left of that [m]
    along: float
    across: float = 0.0


@dataclass(frozen=True)
class Body:
    """A moving mass: a link with its centre of mass on the line between two named points."""

    link: str  # Name of the link or slider that carries the mass
    # Mass, and moment of inertia about the centre of mass [kg], [kg m2]
    mass: float
    inertia: float
    # Points between which the centre of mass lies
    start: str
    end: str
    share: float  # Where it lies: 0 at `start`, 1 at `end` [-]


def body_at(link: str, mass: float, inertia: float, point: str) -> Body:
    """Return a moving mass whose centre is a named point.

    `link`: name of the link or slider that carries the mass; `mass` and `inertia`: mass, and moment of inertia about
    the centre of mass [kg], [kg m2].
    """
    return Body(link, mass, inertia, point, point, 0.0)


@dataclass(frozen=True)
class Mechanism:
    """A driver, the dyads in the order in which they are solved, and the bodies."""

    driver: Driver
    dyads: tuple[Dyad | Chain, ...]  # Each connects to points and links of the driver or an earlier group
    bodies: tuple[Body, ...] = ()  # Moving masses; may be empty if only the motion is needed
    ground: Mapping[str, Point] = field(default_factory=dict)  # Fixed points by name [m]
    points: tuple[LinkPoint, ...] = ()  # Further points of the links; a dyad may connect to them
    # Lines between the joints of links of dyads whose frames lie elsewhere, by link
    bars: Mapping[str, Bar] = field(default_factory=dict)
    # The dyads that pass change points, by index
    passages: Mapping[int, ChangePointPassage] = field(default_factory=dict)

    @property
    def crank(self) -> Crank:
        """The crank, if the driver is one."""
        return crank_of(self.driver)

    @property
    def halves(self) -> tuple[CylinderPart, ...]:
        """Barrel and rod of a driving cylinder that has masses."""
        return self.driver.halves if isinstance(self.driver, Cylinder) else ()

    @property
    def period(self) -> float:
        """Crank angle after which everything repeats: with gears or change points it may be several turns. [deg]"""
        passed = [passage.period for passage in self.passages.values() if math.isfinite(passage.period)]
        geared = self.driver.geared if isinstance(self.driver, Crank) and self.driver.law is None else ()
        return max([_TURN * math.lcm(*(period_in_turns(crank.ratio) or 1 for crank in geared)), *passed])


def period_in_turns(ratio: float) -> int:
    """Return the turns of the crank after which a geared one is back too, 0 if there are too many."""
    nearest = Fraction(ratio).limit_denominator(_MAX_TURNS)
    return nearest.denominator if abs(ratio - nearest) < _RATIO_TOLERANCE else 0


def crank_of(driver: Driver) -> Crank:
    """Return the crank that drives, or raise TypeError for another driver."""
    if isinstance(driver, Crank):
        return driver
    raise TypeError(f"{driver.link} drives, and that is no crank")


def slider_crank(crank_radius: float, rod_length: float, offset: float = 0.0) -> Mechanism:
    """Return the slider-crank of an upright engine, its crank turning clockwise.

    Points `crank_pin` and `piston_pin`, links `crank` and `rod`. `offset`: distance of the cylinder axis from the
    crankshaft axis, towards the crankpin at 90 degrees [m].
    """
    up = math.pi / 2
    crank = Crank(crank_radius, start=up, direction=-1)
    rod = RRP("crank_pin", "piston_pin", "rod", rod_length, guide_point=(offset, 0.0), guide_angle=up)
    return Mechanism(crank, (rod,))
