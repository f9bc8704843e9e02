"""Where the cylinders of an engine stand, which crankpin each works on, and when each fires.

Angles are in degrees, because 360/n of them are exact where radians are not.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Place:
    """The place of one cylinder.

    Parameters
    ----------
    number : int
        Its number, from 1.
    axis : float
        Direction from the crankshaft to its head, from the reference direction of the engine, positive with
        the rotation. [deg]
    crankpin, throw : int
        Which crankpin its rod turns on and which throw that belongs to, from 0; a throw lies between two main journals,
        and cylinders of one throw share a crankpin unless its pins are offset.
    pin_angle : float
        Angle of its crankpin ahead of that of cylinder 1, positive with the rotation. [deg]
    position : float
        Distance of its axis along the shaft from the middle between the outermost cylinders, positive towards higher
        throws. [m]
    firing_angle : float
        Crank angle of cylinder 1 by which it comes after cylinder 1, at least 0 and less than the cycle. [deg]
    master : int
        Number of the cylinder whose rod carries its rod, 0 if its rod turns on the crankpin itself.
    """

    number: int
    axis: float
    crankpin: int
    throw: int
    pin_angle: float
    position: float
    firing_angle: float
    master: int = 0


@dataclass(frozen=True)
class Layout:
    """All cylinders of an engine, in the order of their numbers.

    Parameters
    ----------
    kind : str
        inline, V, boxer, W, radial or opposed.
    places : tuple of Place
        The cylinders.
    cycle : float
        720 or 360. [deg]
    firing_order : tuple of int
        Numbers of the cylinders as they fire, starting with 1.
    journal_positions : tuple of float
        Main journals along the shaft, one more than throws, in the coordinate of `Place.position`. [m]
    """

    kind: str
    places: tuple[Place, ...]
    cycle: float
    firing_order: tuple[int, ...]
    journal_positions: tuple[float, ...] = ()


@dataclass(frozen=True)
class Banks:
    """How the cylinders of an engine are arranged, before its firing order is known.

    Parameters
    ----------
    kind : str
        inline, V, boxer, W or radial.
    cylinders : int
        How many there are.
    axes : tuple of float
        Direction of each bank from the crankshaft, positive with the rotation; the first holds cylinder 1. [deg]
    spacing : float
        Distance between neighbouring cylinders of a bank. [m]
    stagger : float
        How much farther along the shaft each bank stands than the one before. [m]
    pin_offset : float
        Angle of the crankpin of each bank ahead of that of the bank before, on the same throw. [deg]
    numbering : str
        banks: along the first bank, then the next. pairs: across the banks, throw by throw.
    own_throws : bool
        Whether every cylinder has a throw of its own, as in a boxer.
    articulated : bool
        Whether the rods of a throw hang on the rod of its first cylinder.
    """

    kind: str
    cylinders: int
    axes: tuple[float, ...] = (0.0,)
    spacing: float = 0.0
    stagger: float = 0.0
    pin_offset: float = 0.0
    numbering: str = "banks"
    own_throws: bool = False
    articulated: bool = False
