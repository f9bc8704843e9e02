"""Where the cylinders of an engine stand, which crankpin each works on, and when each fires.

Angles are in degrees, because 360/n of them are exact where radians are not.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

MOST_CYLINDERS = 28


@dataclass(frozen=True)
class CylinderPlace:
    """The place of one cylinder."""

    number: int  # Its number, from 1
    # Direction from the crankshaft to its head, from the reference direction of the engine,
    # positive with the rotation [deg]
    axis: float
    # Which crankpin its rod turns on and which throw that belongs to, from 0; a throw lies between two main journals,
    # and cylinders of one throw share a crankpin unless its pins are offset
    crankpin: int
    throw: int
    pin_angle: float  # Angle of its crankpin ahead of that of cylinder 1, positive with the rotation [deg]
    # Distance of its axis along the shaft from the middle between the outermost cylinders, positive
    # towards higher throws [m]
    position: float
    # Crank angle of cylinder 1 by which its own, from its axis, comes after, at least 0 and less than the cycle [deg]
    firing_angle: float
    master: int = 0  # Number of the cylinder whose rod carries its rod, 0 if its rod turns on the crankpin itself
    top: float = 0.0  # Its own crank angle where it fires: at top dead centre, which an offset moves [deg]


@dataclass(frozen=True)
class Layout:
    """All cylinders of an engine, in the order of their numbers."""

    kind: str  # inline, V, boxer, W, radial or opposed
    places: tuple[CylinderPlace, ...]  # The cylinders
    cycle: float  # 720 or 360 [deg]
    firing_order: tuple[int, ...]  # Numbers of the cylinders as they fire, starting with 1
    # Main journals along the shaft, one more than throws, in the coordinate of `Place.position` [m]
    journal_positions: tuple[float, ...] = ()


@dataclass(frozen=True)
class Banks:
    """How the cylinders of an engine are arranged, before its firing order is known."""

    kind: str  # inline, V, boxer, W or radial
    cylinders: int  # Number of cylinders
    # Direction of each bank from the crankshaft, positive with the rotation; the first holds cylinder 1 [deg]
    axes: tuple[float, ...] = (0.0,)
    spacing: float = 0.0  # Distance between neighbouring cylinders of a bank [m]
    stagger: float = 0.0  # Offset of each bank along the shaft from the bank before [m]
    # Angle of the crankpin of each bank ahead of that of the bank before, on the same throw [deg]
    pin_offset: float = 0.0
    numbering: str = "banks"  # banks: along the first bank, then the next. pairs: across the banks, throw by throw
    own_throws: bool = False  # Whether every cylinder has a throw of its own, as in a boxer
    articulated: bool = False  # Whether the rods of a throw hang on the rod of its first cylinder
    # Own crank angle of each cylinder by number at top dead centre, where offsets that differ move it [deg]
    tops: tuple[float, ...] = ()


class PinBearing(NamedTuple):
    """Known data of the bearing in a revolute joint of a linkage."""

    diameter: float | None = None  # [m]
    length: float | None = None  # That carries load [m]
    link: str = ""  # One of the two links, along whose axis reversal counts; by default that of the rod


@dataclass(frozen=True)
class Bearings:
    """Known sizes of the bearings, and the rays of their wear diagrams."""

    # Diameters and working lengths of crankpin, main journals and piston pin [m]
    crankpin_diameter: float | None = None
    crankpin_length: float | None = None
    main_diameter: float | None = None
    main_length: float | None = None
    pin_diameter: float | None = None
    pin_length: float | None = None
    rays: int = 12  # Rays of the wear diagram, 12 or 24
    pins: Mapping[str, PinBearing] = field(default_factory=dict)  # Of a linkage, by the name of the joint


@dataclass(frozen=True)
class Shaft:
    """What a linkage of crank, rods and pistons does not show of its crankshaft.

    Its cylinders are told by their sliding pieces.
    """

    cylinders: tuple[str, ...] = ()  # By number; by default in the order of the chambers, else of the sliding pieces
    # Distances along the shaft of cylinders, and of main journals, one more than throws; empty if unknown [m]
    positions: Mapping[str, float] = field(default_factory=dict)
    journals: tuple[float, ...] = ()
    # Pins of the crank by throw, along the shaft; by default each pin is a throw
    throws: tuple[tuple[str, ...], ...] = ()
    # Crank angle at which each cylinder begins its cycle; by default from the chambers [deg]
    firing: Mapping[str, float] = field(default_factory=dict)
    period: float | None = None  # 720 or 360, if no chamber states it [deg]
    # Direction from which the axes of the cylinders count, from the x axis; by default that of cylinder 1 [rad]
    reference: float | None = None
    misfires: tuple[str, ...] = ()  # Cylinders without combustion
    bore: float | None = None  # Of the cylinders, if no chamber states it [m]
    # As those of an `Engine`
    counterweight: float = 0.0
    rotating_share: float = 0.0
    reciprocating_share: float = 0.0
    balance_shafts: tuple[int, ...] = ()
