"""Where the cylinders of an engine stand, which crankpin each works on, and when each fires.

Angles are in degrees, because 360/n of them are exact where radians are not.
"""

from __future__ import annotations

from dataclasses import dataclass

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
