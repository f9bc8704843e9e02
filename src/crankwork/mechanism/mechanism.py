"""What a mechanism is: a crank and an ordered list of dyads, with bodies and named points."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

Point = tuple[float, float]
Branch = Literal[-1, 1]


@dataclass(frozen=True)
class Crank:
    """A link that turns about a fixed pivot and drives the mechanism.

    Parameters
    ----------
    radius : float
        Distance from pivot to pin. [m]
    pivot : tuple of float
        Coordinates of the fixed axis. [m]
    start : float
        Direction of the crank arm at crank angle zero, from the x axis. [rad]
    direction : {1, -1}
        1 if the crank angle grows anticlockwise, -1 if clockwise.
    pin, link : str
        Names of the moving end and of the link.
    """

    radius: float
    pivot: Point = (0.0, 0.0)
    start: float = 0.0
    direction: Branch = 1
    pin: str = "crank_pin"
    link: str = "crank"


@dataclass(frozen=True)
class RRP:
    """A dyad of one link between a known point and a slider on a fixed straight guide.

    Parameters
    ----------
    joint, slider : str
        Name of the known point, and of the point that slides.
    link : str
        Name of the link.
    length : float
        Distance between the two points. [m]
    guide_point : tuple of float
        A point of the guide line. [m]
    guide_angle : float
        Direction in which the slider's distance along the guide is counted, from the x axis. [rad]
    branch : {1, -1}
        1 if the slider lies ahead of the joint in the guide direction, -1 if behind.
    """

    joint: str
    slider: str
    link: str
    length: float
    guide_point: Point = (0.0, 0.0)
    guide_angle: float = 0.0
    branch: Branch = 1


Dyad = RRP


@dataclass(frozen=True)
class Body:
    """A moving mass: a link with its centre of mass on the line between two named points.

    Parameters
    ----------
    link : str
        Name of the link or slider that carries the mass.
    mass, inertia : float
        Mass, and moment of inertia about the centre of mass. [kg], [kg m2]
    start, end : str
        Points between which the centre of mass lies.
    share : float
        Where it lies: 0 at `start`, 1 at `end`. [-]
    """

    link: str
    mass: float
    inertia: float
    start: str
    end: str
    share: float


@dataclass(frozen=True)
class Mechanism:
    """A crank, the dyads in the order in which they are solved, and the bodies.

    Parameters
    ----------
    crank : Crank
        The driving link.
    dyads : tuple of Dyad
        Each rests on points that the crank or an earlier dyad has placed.
    bodies : tuple of Body
        Moving masses; may be empty where only the motion is wanted.
    """

    crank: Crank
    dyads: tuple[Dyad, ...]
    bodies: tuple[Body, ...] = ()


def slider_crank(crank_radius: float, rod_length: float, offset: float = 0.0) -> Mechanism:
    """Return the slider-crank of an upright engine, its crank turning clockwise.

    Parameters
    ----------
    crank_radius, rod_length : float
        The lengths. [m]
    offset : float
        Distance of the cylinder axis from the crankshaft axis, towards the crankpin at 90 degrees. [m]

    Returns
    -------
    Mechanism
        Points `crank_pin` and `piston_pin`, links `crank` and `rod`.
    """
    up = math.pi / 2
    crank = Crank(crank_radius, start=up, direction=-1)
    rod = RRP("crank_pin", "piston_pin", "rod", rod_length, guide_point=(offset, 0.0), guide_angle=up)
    return Mechanism(crank, (rod,))
