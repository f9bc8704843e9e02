"""Assur groups that no dyad describes: class III and up, solved numerically from a stated start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from crankwork.mechanism.dyads import Guide, Point


@dataclass(frozen=True)
class ChainLink:
    """A moving link of a chain, and where it is at the start."""

    name: str  # Name of the link or sliding piece
    origin: Point  # Where the origin of its frame is at the start [m]
    angle: float  # Direction of its x axis at the start, from the fixed x axis [rad]
    points: Mapping[str, Point]  # Its joints and other named points, in its frame [m]


@dataclass(frozen=True)
class Slide:
    """A link of a chain whose x axis lies on a guide."""

    link: str
    guide: Guide


@dataclass(frozen=True)
class Gear:
    """Two links about fixed axes that gears turn together."""

    link: str
    other: str
    ratio: float  # Angle of the first over that of the other [-]
    start: float  # Angle of the first where that of the other is zero [rad]


@dataclass(frozen=True)
class Chain:
    """Links that have to be solved together.

    Links that share the name of a point are pinned there; a point that no link of the chain owns alone is
    one that the crank or an earlier group has placed.
    """

    links: tuple[ChainLink, ...]  # The moving links
    # Which of them slide, and on what: a guide that is fixed, on a known link or on a link of the chain
    slides: tuple[Slide, ...] = ()
    known: frozenset[str] = field(default_factory=frozenset)  # Points that are placed before
    start: float = 0.0  # Coordinate of the driver at the stated start [rad] or [m]
    # What of the driver's coordinate moves links about as far as a radian does: of one that is a length, a length
    radian: float = 1.0
    gears: tuple[Gear, ...] = ()
