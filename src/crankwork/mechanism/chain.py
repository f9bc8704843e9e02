"""Assur groups of class III and higher, solved numerically from a stated start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from crankwork.mechanism.dyads import Guide, Point


@dataclass(frozen=True)
class ChainLink:
    """A moving link of a chain, and its position at the start."""

    name: str  # Name of the link or sliding piece
    origin: Point  # Origin of its frame at the start [m]
    angle: float  # Direction of its x axis at the start, from the fixed x axis [rad]
    points: Mapping[str, Point]  # Its joints and other named points, in its frame [m]


@dataclass(frozen=True)
class Slide:
    """A link of a chain whose x axis lies on a guide."""

    link: str
    guide: Guide


@dataclass(frozen=True)
class Gear:
    """Two links on fixed axes that gears couple."""

    link: str
    other: str
    ratio: float  # Angle of the first over that of the second [-]
    start: float  # Angle of the first where that of the second is zero [rad]


@dataclass(frozen=True)
class Chain:
    """Links that have to be solved together.

    Links that share the name of a point are pinned there; a point that no link of the chain owns alone is placed by the
    crank or an earlier group.
    """

    links: tuple[ChainLink, ...]  # The moving links
    # The sliding links with their guides: fixed, on a known link or on a link of the chain
    slides: tuple[Slide, ...] = ()
    known: frozenset[str] = field(default_factory=frozenset)  # Points that are placed before
    start: float = 0.0  # Coordinate of the driver at the stated start [rad] or [m]
    # Change of the driver's coordinate that moves links about as far as a radian; of a length, a length
    radian: float = 1.0
    gears: tuple[Gear, ...] = ()
