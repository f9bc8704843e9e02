"""Assur groups of class II: the five dyads, each two links and three joints, and the guides they slide on.

The frame of a link has its origin at the first joint and its x axis towards the second; that of a sliding piece has its
origin at its pin (or on its guide) and its x axis along the guide. Points and guides on a link are given in its frame.
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
