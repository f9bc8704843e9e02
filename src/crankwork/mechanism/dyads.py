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
    """A straight line to slide on, fixed or carried by a link.

    Parameters
    ----------
    point : tuple of float
        A point of the line, from which distances along it count; in the frame of the link that carries it. [m]
    angle : float
        Direction in which they count, from the x axis of that frame. [rad]
    link : str
        The link that carries it; empty for a fixed guide.
    """

    point: Point = (0.0, 0.0)
    angle: float = 0.0
    link: str = ""


@dataclass(frozen=True)
class RRR:
    """Two links between two known points.

    Parameters
    ----------
    joint_a, joint_b, point : str
        The known points, and the one where the links meet.
    link_a, link_b : str
        Names of the links, each counted from its known point.
    length_a, length_b : float
        Their lengths. [m]
    branch : {1, -1}
        1 if `point` lies on the left on the way from `joint_a` to `joint_b`, -1 if on the right.
    """

    joint_a: str
    joint_b: str
    point: str
    link_a: str
    link_b: str
    length_a: float
    length_b: float
    branch: Branch = 1


@dataclass(frozen=True)
class RRP:
    """A link between a known point and a slider on a known straight guide.

    Parameters
    ----------
    joint, slider : str
        Name of the known point, and of the point that slides.
    link : str
        Name of the link.
    length : float
        Distance between the two points. [m]
    guide_point : tuple of float
        A point of the guide line, in the frame of `guide_link`. [m]
    guide_angle : float
        Direction in which the slider's distance along the guide is counted, from the x axis of that frame. [rad]
    branch : {1, -1}
        1 if the slider lies ahead of the joint in the guide direction, -1 if behind.
    guide_link : str
        The link that carries the guide; empty for a fixed guide.
    block : str
        Name of the sliding piece, where it is not that of its point.
    """

    joint: str
    slider: str
    link: str
    length: float
    guide_point: Point = (0.0, 0.0)
    guide_angle: float = 0.0
    branch: Branch = 1
    guide_link: str = ""
    block: str = ""

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
    """A slotted lever on a known pivot, and the block on a known pin that slides in its slot.

    Parameters
    ----------
    joint, pivot : str
        The known points: pin of the block, pivot of the lever.
    link, block : str
        Names of lever and block.
    slot : Guide
        The slot in the frame of the lever, whose origin is the pivot; its own `link` is not used.
    branch : {1, -1}
        1 if the pin lies ahead of the foot of the pivot on the slot, -1 if behind.
    """

    joint: str
    pivot: str
    link: str
    block: str
    slot: Guide = Guide()
    branch: Branch = 1


@dataclass(frozen=True)
class PRP:
    """Two blocks on one pin, each on a known guide. There is one way to assemble it.

    Parameters
    ----------
    point : str
        The pin, where the guides cross.
    block_a, block_b : str
        Names of the blocks.
    guide_a, guide_b : Guide
        Their guides.
    """

    point: str
    block_a: str
    block_b: str
    guide_a: Guide
    guide_b: Guide


@dataclass(frozen=True)
class RPP:
    """A yoke on a known guide, and the block on a known pin that slides in its slot. There is one way to assemble it.

    Parameters
    ----------
    joint : str
        Pin of the block.
    link, block : str
        Names of yoke and block.
    slot : Guide
        The slot in the frame of the yoke, which moves along the guide without turning on it; its `link` is not used.
    guide : Guide
        What the yoke slides on.
    """

    joint: str
    link: str
    block: str
    slot: Guide
    guide: Guide = Guide()


Dyad = RRR | RRP | RPR | PRP | RPP
