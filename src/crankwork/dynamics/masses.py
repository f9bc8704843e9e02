"""Masses of the crank gear: the rod as two masses, three masses or a rigid body; pendulum tests."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from crankwork.formula.expression import Value, formula


@formula("rod_small_end_mass", "kolchin_demidov_2008, ch. 7")
def rod_small_end_mass(m: Value, b: Value, l: Value) -> Value:  # noqa: E741
    """Part of the rod mass placed at the piston pin."""
    return m * b / l


@formula("rod_big_end_mass", "kolchin_demidov_2008, ch. 7")
def rod_big_end_mass(m: Value, m_1: Value) -> Value:
    """Part of the rod mass placed at the crankpin."""
    return m - m_1


@formula("rod_inertia_excess", "khurmi_gupta_2005, ch. 15")
def rod_inertia_excess(J_c: Value, m: Value, b: Value, l: Value) -> Value:  # noqa: E741
    """Moment of inertia of the rod less that of its two-mass model."""
    return J_c - m * b * (l - b)


@formula("reciprocating_mass", "kolchin_demidov_2008, ch. 7")
def reciprocating_mass(m_p: Value, m_1: Value) -> Value:
    """Mass taken to move with the piston."""
    return m_p + m_1


@formula("rotating_mass", "kolchin_demidov_2008, ch. 7")
def rotating_mass(m_k: Value, m_2: Value) -> Value:
    """Mass taken to turn with the crankpin."""
    return m_k + m_2


@dataclass(frozen=True)
class CrankGearMasses:
    """Masses of one crank gear. [kg], [kg m2]

    Parameters
    ----------
    piston, crank : float
        Piston group; unbalanced crank throw at the crankpin. [kg]
    rod_small_end, rod_big_end : float
        Rod mass at the piston pin and at the crankpin. [kg]
    rod_inertia_excess : float
        Inertia of the rod beyond that of the two masses; zero where nothing more is known. [kg m2]
    """

    piston: float = 0.0
    rod_small_end: float = 0.0
    rod_big_end: float = 0.0
    crank: float = 0.0
    rod_inertia_excess: float = 0.0

    @property
    def reciprocating(self) -> float:
        """Piston and the rod mass at the piston pin. [kg]"""
        return float(reciprocating_mass(self.piston, self.rod_small_end))

    @property
    def rotating(self) -> float:
        """Crank throw and the rod mass at the crankpin. [kg]"""
        return float(rotating_mass(self.crank, self.rod_big_end))


class ThreeMasses(NamedTuple):
    """A rod as masses at piston pin, crankpin and centre of mass; the last may be negative. [kg]"""

    piston_pin: float
    crankpin: float
    centre: float


def three_masses(mass: float, inertia: float, centre_of_mass: float, length: float) -> ThreeMasses:
    """Return the three masses that move exactly as the rigid rod.

    Parameters
    ----------
    mass, inertia : float
        Rod mass, moment of inertia about the centre of mass. [kg], [kg m2]
    centre_of_mass, length : float
        Distance of the centre of mass from the crankpin; rod length. [m]

    Returns
    -------
    ThreeMasses
        Same mass, centre of mass and moment of inertia as the rod. [kg]

    References
    ----------
    wittenbauer_1923; dubbel, dynamically equivalent masses.
    """
    to_crankpin, to_piston = centre_of_mass, length - centre_of_mass
    return ThreeMasses(
        inertia / (length * to_piston), inertia / (length * to_crankpin), mass - inertia / (to_crankpin * to_piston)
    )


class RodProperties(NamedTuple):
    """What two pendulum tests tell of a rod. [m], [kg m2]"""

    centre_of_mass: float
    radius_of_gyration: float
    inertia: float


def rod_from_pendulum_tests(  # noqa: PLR0913 - the six readings of the two tests
    mass: float,
    length: float,
    small_end_bore: float,
    big_end_bore: float,
    small_end_period: float,
    big_end_period: float,
    *,
    gravity: float = 9.80665,
) -> RodProperties:
    """Return centre of mass and inertia of a rod swung about the top of each of its bores.

    Parameters
    ----------
    mass : float
        Rod mass. [kg]
    length, small_end_bore, big_end_bore : float
        Distance between the bore axes; bore diameters. The rod hangs on the inner edge of a bore. [m]
    small_end_period, big_end_period : float
        Periods of small oscillations, hung at either end. [s]
    gravity : float
        Acceleration of free fall. [m/s2]

    Returns
    -------
    RodProperties
        Distance of the centre of mass from the big-end axis [m], radius of gyration about the centre of
        mass [m], moment of inertia there [kg m2].

    References
    ----------
    khurmi_gupta_2005, ch. 15, compound pendulum: k^2 = L h - h^2 with L = g (T / 2 pi)^2.
    """
    span = length + small_end_bore / 2 + big_end_bore / 2
    small, big = (gravity * (period / (2 * math.pi)) ** 2 for period in (small_end_period, big_end_period))
    # k^2 = small h - h^2 = big (span - h) - (span - h)^2 is linear in h, the distance from the small end
    from_small = span * (span - big) / (2 * span - small - big)
    gyration = math.sqrt(from_small * (small - from_small))
    centre = span - from_small - big_end_bore / 2
    return RodProperties(centre, gyration, mass * gyration**2)
