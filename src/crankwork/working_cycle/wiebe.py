"""Combustion over the crank angle: the Wiebe function.

Combustion ends when the exponent reaches ln 1000, that is when 0.999 of the fuel is burnt.
"""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula


@formula("burning_progress", "vibe_1970")
def burning_progress(phi: Value, phi_burn_0: Value, phi_burn: Value) -> Value:
    """Progress of burning: 0 at its start, 1 at its end."""
    return (phi - phi_burn_0) / phi_burn


@formula("burnt_fraction", "vibe_1970")
def wiebe_burnt_fraction(s_burn: Value, m_vibe: Value) -> Value:
    """Fraction burnt by the Wiebe function."""
    return 1 - np.exp(-6.908 * s_burn ** (m_vibe + 1))


@formula("burning_rate", "vibe_1970", unit="1/rad")
def wiebe_burning_rate(s_burn: Value, m_vibe: Value, phi_burn: Value) -> Value:
    """Rate of burning by the Wiebe function."""
    return 6.908 * (m_vibe + 1) / phi_burn * s_burn**m_vibe * np.exp(-6.908 * s_burn ** (m_vibe + 1))


@formula("fuel_heat", "heywood_1988, ch. 3")
def fuel_heat(m_fuel: Value, H_fuel: Value, eta_burn: Value) -> Value:
    """Heat that the fuel of one cycle gives."""
    return m_fuel * H_fuel * eta_burn
