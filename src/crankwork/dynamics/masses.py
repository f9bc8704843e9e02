"""Masses of the crank mechanism: the rod as two masses, three masses or a rigid body; pendulum tests."""

from __future__ import annotations

from dataclasses import dataclass

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
