"""What a mechanism is: a driver and an ordered list of dyads, with bodies and named points."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING

from crankwork.mechanism.driver import Cylinder, DrivingSlider, GearedCrank, Half, Law, LinkMotor
from crankwork.mechanism.dyads import RRP

if TYPE_CHECKING:
    from crankwork.mechanism.chain import Chain
    from crankwork.mechanism.dyads import Bar, Branch, Dyad, Point
    from crankwork.mechanism.passage import Passage


_TURN = 360.0
# turns of the crank that results may go over, and how much a ratio of gears may differ from one of whole numbers
_MOST_TURNS, _SAME_RATIO = 6, 1e-9


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
    law: Law | None = None  # How it turns; at the angle of the tables without
    geared: tuple[GearedCrank, ...] = ()  # What gears turn with it

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
    dyads: tuple[Dyad | Chain, ...]  # Each rests on points and links that the driver or an earlier one has placed
    bodies: tuple[Body, ...] = ()  # Moving masses; may be empty where only the motion is wanted
    ground: Mapping[str, Point] = field(default_factory=dict)  # Fixed points by name [m]
    points: tuple[LinkPoint, ...] = ()  # Further points of the links; a dyad may rest on them
    # Lines between the joints of those links of dyads whose frames they are not, by link
    bars: Mapping[str, Bar] = field(default_factory=dict)
    # Those of the dyads, by their place, that go through change points
    passages: Mapping[int, Passage] = field(default_factory=dict)

    @property
    def crank(self) -> Crank:
        """The crank, of a mechanism that one drives."""
        return crank_of(self.driver)

    @property
    def halves(self) -> tuple[Half, ...]:
        """Barrel and rod of a driving cylinder that has masses."""
        return self.driver.halves if isinstance(self.driver, Cylinder) else ()

    @property
    def period(self) -> float:
        """Crank angle after which it is back where it was: with gears or change points it may be some turns. [deg]"""
        passed = [one.period for one in self.passages.values() if math.isfinite(one.period)]
        geared = self.driver.geared if isinstance(self.driver, Crank) and self.driver.law is None else ()
        return max([_TURN * math.lcm(*(turns_of(one.ratio) or 1 for one in geared)), *passed])


def turns_of(ratio: float) -> int:
    """Return after how many turns of the crank one that gears turn with it is back too; none for many of them."""
    nearest = Fraction(ratio).limit_denominator(_MOST_TURNS)
    return nearest.denominator if abs(ratio - nearest) < _SAME_RATIO else 0


def crank_of(driver: Driver) -> Crank:
    """Return the crank that drives, of what one drives."""
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
