"""Assur groups of class II: the five dyads, each two links and three joints, and the guides they slide on.

A link has a frame: origin at its first joint, x axis towards its second. A sliding piece has its origin at its
pin (or on its guide) and its x axis along the guide. Points and guides that a link carries are given there.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Point = tuple[float, float]
Branch = Literal[-1, 1]


@dataclass(frozen=True)
class Guide:
    """A straight line to slide on, fixed or carried by a link."""

    # A point of the line, from which distances along it count; in the frame of the link that carries it [m]
    point: Point = (0.0, 0.0)
    angle: float = 0.0  # Direction in which they count, from the x axis of that frame [rad]
    link: str = ""  # The link that carries it; empty for a fixed guide


@dataclass(frozen=True)
class Bar:
    """Where the line from the known joint of a link of a dyad to its other joint lies in the frame of the link."""

    # Its ends, at the known joint and at the other one [m]
    start: Point
    end: Point
    angle: float  # Its direction, from the x axis of the frame [rad]


@dataclass(frozen=True)
class RRR:
    """Two links between two known points."""

    # The known points, and the one where the links meet
    joint_a: str
    joint_b: str
    point: str
    # Names of the links, each counted from its known point
    link_a: str
    link_b: str
    # Their lengths [m]
    length_a: float
    length_b: float
    branch: Branch = 1  # 1 if `point` lies on the left on the way from `joint_a` to `joint_b`, -1 if on the right


@dataclass(frozen=True)
class RRP:
    """A link between a known point and a slider on a known straight guide."""

    # Name of the known point, and of the point that slides
    joint: str
    slider: str
    link: str  # Name of the link
    length: float  # Distance between the two points [m]
    guide_point: Point = (0.0, 0.0)  # A point of the guide line, in the frame of `guide_link` [m]
    # Direction in which the slider's distance along the guide is counted, from the x axis of that frame [rad]
    guide_angle: float = 0.0
    branch: Branch = 1  # 1 if the slider lies ahead of the joint in the guide direction, -1 if behind
    guide_link: str = ""  # The link that carries the guide; empty for a fixed guide
    block: str = ""  # Name of the sliding piece, where it is not that of its point

    @property
    def guide(self) -> Guide:
        """The line the slider runs on."""
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
    """Two blocks on one pin, each on a known guide. There is one way to assemble it."""

    point: str  # The pin, where the guides cross
    # Names of the blocks
    block_a: str
    block_b: str
    # Their guides
    guide_a: Guide
    guide_b: Guide


@dataclass(frozen=True)
class RPP:
    """A yoke on a known guide, and the block on a known pin that slides in its slot, in one way."""

    joint: str  # Pin of the block
    # Names of yoke and block
    link: str
    block: str
    # The slot in the frame of the yoke, which moves along the guide without turning on it; its `link` is not used
    slot: Guide
    guide: Guide = Guide()  # What the yoke slides on


Dyad = RRR | RRP | RPR | PRP | RPP
