"""Masses of the crank mechanism: the rod as two masses, three masses or a rigid body; pendulum tests."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

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


@formula("pendulum_length", "khurmi_gupta_2005, ch. 4")
def pendulum_length(pi: Value, g: Value, T_p: Value) -> Value:
    """Length of the simple pendulum that swings as a body does."""
    return g * (T_p / (2 * pi)) ** 2


@formula("suspension_distance", "khurmi_gupta_2005, ch. 15")
def suspension_distance(L_s: Value, L_q: Value, D_s: Value) -> Value:
    """Distance of the centre of mass from the first of two edges on which a rod swings."""
    return D_s * (L_q - D_s) / (L_s + L_q - 2 * D_s)


@formula("rod_gyration_radius", "khurmi_gupta_2005, ch. 4")
def pendulum_gyration(h_s: Value, L_s: Value) -> Value:
    """Radius of gyration of a body from its swinging."""
    return np.sqrt(h_s * (L_s - h_s))


@formula("equivalent_distance", "khurmi_gupta_2005, ch. 15")
def equivalent_distance(J_c: Value, m: Value, b: Value, l: Value) -> Value:  # noqa: E741
    """Distance of the second of two masses that have the inertia of the rod, the first at the piston pin."""
    return J_c / (m * (l - b))


@formula("equivalent_mass", "khurmi_gupta_2005, ch. 15")
def first_equivalent_mass(m: Value, b: Value, l: Value, l_e: Value) -> Value:  # noqa: E741
    """Mass at the piston pin, of two that have the inertia of the rod."""
    return m * l_e / (l - b + l_e)


@formula("equivalent_mass", "uicker_2011, ch. 14")
def end_mass_of_three(J_c: Value, a_e: Value, l: Value) -> Value:  # noqa: E741
    """Mass at one end, of three that have the inertia of the rod."""
    return J_c / (a_e * l)


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
    """Masses of one crank mechanism. [kg], [kg m2]"""

    # Piston group; unbalanced crank throw at the crankpin [kg]
    piston: float = 0.0
    # Rod mass at the piston pin and at the crankpin [kg]
    rod_small_end: float = 0.0
    rod_big_end: float = 0.0
    crank: float = 0.0
    # Inertia of the rod beyond that of the two masses; zero if it is unknown [kg m2]
    rod_inertia_excess: float = 0.0

    @property
    def reciprocating(self) -> float:
        """Piston and the rod mass at the piston pin. [kg]"""
        return float(reciprocating_mass(self.piston, self.rod_small_end))

    @property
    def rotating(self) -> float:
        """Crank throw and the rod mass at the crankpin. [kg]"""
        return float(rotating_mass(self.crank, self.rod_big_end))
