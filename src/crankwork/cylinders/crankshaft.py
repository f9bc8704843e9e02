"""What is known of a crankshaft besides the motion of its rods and pistons."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple


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
