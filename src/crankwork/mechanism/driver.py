"""Drivers of a mechanism, and the laws of their coordinate over one period."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from crankwork.mechanism.dyads import Guide, Point

LawKind = Literal[
    "constant", "parabolic", "trapezoidal", "modified-trapezoidal", "cubic", "3-4-5", "4-5-6-7", "harmonic",
    "cycloidal", "modified-sine", "constant-acceleration", "dwell", "table",
]  # fmt: skip


@runtime_checkable
class MotionLaw(Protocol):
    """A motion law of the user: the share of the travel by the share of the time, from rest to rest or not.

    Examples
    --------
    Half a turn of a cosine, as `harmonic` has it:

    >>> class Swing:
    ...     breaks = ()
    ...
    ...     def ways(self, share):
    ...         angle = np.pi * share
    ...         return (1 - np.cos(angle)) / 2, np.pi / 2 * np.sin(angle), np.pi**2 / 2 * np.cos(angle)
    >>> isinstance(Swing(), MotionLaw)
    True
    """

    breaks: Sequence[float]  # Shares of the time between 0 and 1 where its second derivative jumps or bends [-]

    def ways(self, share: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Return the share of the travel, from 0 to 1, and its two derivatives by the share of the time, shape (n,)."""


@dataclass(frozen=True)
class Segment:
    """A rise, a return or a rest of the coordinate."""

    kind: LawKind | MotionLaw  # Its normalised law
    to: float  # The coordinate at its end [m] or [rad]
    share: float  # Its part of the period [-]
    ramp: float = 1 / 3  # Share of the segment that each ramp of a trapezoidal velocity takes [-]
    # Of a table, shares of the segment between 0 and 1, and the coordinate there [-], [m] or [rad]
    points: tuple[tuple[float, float], ...] = ()
    # Rates at both ends of a table, at the start of a constant acceleration; None where they follow from the points of
    # a table [m/s] or [rad/s]
    rates: tuple[float | None, float | None] = (0.0, 0.0)


@dataclass(frozen=True)
class Law:
    """The coordinate of a driver over one period, segment after segment."""

    segments: tuple[Segment, ...]
    period: float  # [s]
    start: float  # The coordinate at time zero [m] or [rad]
    has_jerk: bool = False  # Whether its third rate is told
    is_instant: bool = False  # Whether its beginning alone is asked for


@dataclass(frozen=True)
class DrivingSlider:
    """A piece that slides on a fixed guide and drives: its distance along the guide is the coordinate."""

    link: str  # Name of the piece; its origin is on the line
    guide: Guide
    law: Law

    turns = False


@dataclass(frozen=True)
class CylinderPart:
    """The barrel or the rod of a cylinder with its mass. [kg], [kg m2]"""

    link: str
    mass: float
    inertia: float  # About its centre of mass
    centre: Point  # From its own end towards the other, and to the left of that [m]


@dataclass(frozen=True)
class Cylinder:
    """A link of changing length between two points: that length is the coordinate."""

    # The points that barrel and rod are pinned to
    barrel: str
    rod: str
    law: Law
    link: str = "cylinder"  # Name of the link
    halves: tuple[CylinderPart, ...] = ()  # Barrel and rod, where they have masses

    turns = False


def rod_name(cylinder: str) -> str:
    """Return the name of the rod of a cylinder, which is a separate link."""
    return f"{cylinder}_rod"


@dataclass(frozen=True)
class LinkMotor:
    """A motor in the pin of two moving links: the angle from the first to the second is the coordinate.

    One point of each link and the pin form a triangle, whose third side is a massless link of changing length.
    """

    # The links, the first and the second
    links: tuple[str, str]
    pin: str
    # Distances of the pin from the points between which the third side lies [m]
    sides: tuple[float, float]
    angle: float  # Angle of the triangle at the pin where the coordinate is zero, anticlockwise from the first [rad]
    law: Law
    link: str = "third_side"  # Name of the third side

    turns = True


@dataclass(frozen=True)
class GearedCrank:
    """A crank that is geared to the driving one."""

    link: str
    pivot: Point  # [m]
    ratio: float  # Its angular velocity over that of the driving crank, negative for the opposite sense [-]
    start: float = 0.0  # Direction of its x axis at a driving crank angle of zero [rad]
    pressure_angle: float | None = None  # Of teeth in mesh with the driving crank's wheel [rad]
