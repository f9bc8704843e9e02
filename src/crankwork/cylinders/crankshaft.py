"""What is known of a crankshaft besides the motion of its rods and pistons."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Bearings:
    """Known sizes of the bearings, and the rays of their wear diagrams.

    Parameters
    ----------
    crankpin_diameter, crankpin_length, main_diameter, main_length, pin_diameter, pin_length : float or None
        Diameters and working lengths of crankpin, main journals and piston pin. [m]
    rays : int
        Rays of the wear diagram, 12 or 24.
    """

    crankpin_diameter: float | None = None
    crankpin_length: float | None = None
    main_diameter: float | None = None
    main_length: float | None = None
    pin_diameter: float | None = None
    pin_length: float | None = None
    rays: int = 12


@dataclass(frozen=True)
class Shaft:
    """What a linkage of crank, rods and pistons does not show of its crankshaft: what stands along it, its bearings.

    Parameters
    ----------
    cylinders : tuple of str
        Sliding pieces by the number of their cylinder; by default in the order of their chambers, else of the pieces.
    positions : mapping of str to float
        Distance of each cylinder along the shaft, by sliding piece; empty if unknown. [m]
    journals : tuple of float
        Main journals along the shaft, one more than throws; empty if unknown. [m]
    throws : tuple of tuple of str
        Pins of the crank by throw, along the shaft; by default each pin is a throw, as the cylinders stand.
    firing : mapping of str to float
        Crank angle at which each cylinder begins its cycle, by sliding piece; by default from the chambers. [deg]
    period : float or None
        720 or 360, if no chamber states it. [deg]
    reference : float or None
        Direction from which the axes of the cylinders count, from the x axis; that of cylinder 1 by default. [rad]
    misfires : tuple of str
        Sliding pieces of the cylinders without combustion.
    bore : float or None
        Of the cylinders, if no chamber states it. [m]
    bearings, counterweight, rotating_share, reciprocating_share, balance_shafts
        As those of an `Engine`.
    """

    cylinders: tuple[str, ...] = ()
    positions: Mapping[str, float] = field(default_factory=dict)
    journals: tuple[float, ...] = ()
    throws: tuple[tuple[str, ...], ...] = ()
    firing: Mapping[str, float] = field(default_factory=dict)
    period: float | None = None
    reference: float | None = None
    misfires: tuple[str, ...] = ()
    bore: float | None = None
    bearings: Bearings = field(default_factory=Bearings)
    counterweight: float = 0.0
    rotating_share: float = 0.0
    reciprocating_share: float = 0.0
    balance_shafts: tuple[int, ...] = ()
