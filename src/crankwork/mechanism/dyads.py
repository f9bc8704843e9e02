"""Assur groups: the five dyads, each two links and three joints, their guides, and chains, solved numerically.

The frame of a link has its origin at the first joint and its x axis towards the second; that of a sliding piece has its
origin at its pin (or on its guide) and its x axis along the guide. Points and guides on a link are given in its frame.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Polynomial:
    """A quantity near a crank angle, by Chebyshev polynomials of the distance from it. [deg]"""

    centre: float
    reach: float  # Distance from the centre of the farthest fitted values
    coefficients: tuple[float, ...]

    def __call__(self, degrees: Array) -> Array:
        """Return the quantity at crank angles."""
        return np.asarray(chebyshev.chebval((degrees - self.centre) / self.reach, self.coefficients))


@dataclass(frozen=True)
class ChangePointFit:
    """Polynomials for a dyad near a change point, where its own formulas are 0/0."""

    degrees: float  # Crank angle of the change point
    width: float  # Half width of the range of the polynomials [deg]
    columns: Mapping[str, Polynomial]  # By the quantity that they replace


@dataclass(frozen=True)
class ChangePointPassage:
    """The change points of a dyad, at each of which it changes its branch."""

    changes: tuple[float, ...]  # Crank angles at which its branch changes, ascending [deg]
    stated: float  # Crank angle at which, or just after which, it is on its own branch [deg]
    period: float = math.inf  # Crank angle after which everything repeats, if the crank turns fully [deg]
    bridges: tuple[ChangePointFit, ...] = ()

    def within(self, degrees: Array) -> Array:
        """Return crank angles within the period."""
        outside = (degrees < 0.0) | (degrees > self.period)
        return np.where(outside, np.mod(degrees, self.period), degrees) if math.isfinite(self.period) else degrees

    def signs(self, degrees: Array) -> Array:
        """Return 1 where the dyad is on its own branch, -1 where it is on the other."""
        passed = np.searchsorted(self.changes, self.within(degrees), side="left")
        return np.where((passed - np.searchsorted(self.changes, self.stated, side="right")) % 2 == 0, 1.0, -1.0)

    def is_bridged(self, degrees: Array) -> NDArray[np.bool_]:
        """Return where polynomials are used (True)."""
        inside, local = np.zeros(degrees.shape, dtype=bool), self.within(degrees)
        for bridge in self.bridges:
            inside |= np.abs(local - bridge.degrees) <= bridge.width
        return inside


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


Point = tuple[float, float]
Branch = Literal[-1, 1]


@dataclass(frozen=True)
class Guide:
    """A straight line to slide on, fixed or carried by a link."""

    # A point of the line, from which distances along it count; in the frame of the link that carries it [m]
    point: Point = (0.0, 0.0)
    angle: float = 0.0  # Positive direction of the line, from the x axis of that frame [rad]
    link: str = ""  # The link that carries it; empty for a fixed guide


@dataclass(frozen=True)
class Bar:
    """The line from the known joint of a link of a dyad to the other joint, in the frame of the link."""

    # Its ends, at the known joint and at the other one [m]
    start: Point
    end: Point
    angle: float  # Its direction, from the x axis of the frame [rad]


@dataclass(frozen=True)
class RRR:
    """Two links between two known points."""

    # The known points, and the inner joint
    joint_a: str
    joint_b: str
    point: str
    # Names of the links, each directed from its known point
    link_a: str
    link_b: str
    # Their lengths [m]
    length_a: float
    length_b: float
    branch: Branch = 1  # 1 if `point` lies on the left of the line from `joint_a` to `joint_b`, -1 if on the right


@dataclass(frozen=True)
class RRP:
    """A link between a known point and a slider on a known straight guide."""

    # Name of the known point, and of the point that slides
    joint: str
    slider: str
    link: str  # Name of the link
    length: float  # Distance between the two points [m]
    guide_point: Point = (0.0, 0.0)  # A point of the guide line, in the frame of `guide_link` [m]
    # Positive direction of the slider's distance along the guide, from the x axis of that frame [rad]
    guide_angle: float = 0.0
    branch: Branch = 1  # 1 if the slider lies ahead of the joint in the guide direction, -1 if behind
    guide_link: str = ""  # The link that carries the guide; empty for a fixed guide
    block: str = ""  # Name of the sliding piece, if it differs from that of its point

    @property
    def guide(self) -> Guide:
        """The guide of the slider."""
        return Guide(self.guide_point, self.guide_angle, self.guide_link)

    @property
    def piece(self) -> str:
        """Name of the sliding piece."""
        return self.block or self.slider


@dataclass(frozen=True)
class RPR:
    """A slotted lever on a known pivot, and the block on a known pin that slides in its slot."""

    # The known points: pin of the block, pivot of the lever
    joint: str
    pivot: str
    # Names of lever and block
    link: str
    block: str
    slot: Guide = Guide()  # The slot in the frame of the lever, whose origin is the pivot; its own `link` is not used
    branch: Branch = 1  # 1 if the pin lies ahead of the foot of the pivot on the slot, -1 if behind


@dataclass(frozen=True)
class PRP:
    """Two blocks on one pin, each on a known guide. It has one way of assembly."""

    point: str  # The pin, where the guides cross
    # Names of the blocks
    block_a: str
    block_b: str
    # Their guides
    guide_a: Guide
    guide_b: Guide


@dataclass(frozen=True)
class RPP:
    """A yoke on a known guide, and the block on a known pin that slides in its slot. It has one way of assembly."""

    joint: str  # Pin of the block
    # Names of yoke and block
    link: str
    block: str
    # The slot in the frame of the yoke, which does not rotate on its guide; its `link` is not used
    slot: Guide
    guide: Guide = Guide()  # The guide of the yoke


Dyad = RRR | RRP | RPR | PRP | RPP
