"""How fuel burns over the crank angle: the Wiebe function.

Burning ends when the exponent reaches ln 1000, that is when 0.999 of the fuel is burnt.
"""

from __future__ import annotations

import numpy as np

from crankwork.expressions import Value, formula


@formula("burning_progress", "vibe_1970")
def burning_progress(phi: Value, phi_burn_0: Value, phi_burn: Value) -> Value:
    """Progress of burning: 0 at its start, 1 at its end.

    Parameters
    ----------
    phi, phi_burn_0, phi_burn : array
        Crank angle, start and duration of burning, all in one unit. [rad]

    Returns
    -------
    array
        Progress. [-]
    """
    return (phi - phi_burn_0) / phi_burn


@formula("burnt_fraction", "vibe_1970")
def wiebe_burnt_fraction(s_burn: Value, m_vibe: Value) -> Value:
    """Fraction burnt by the Wiebe function.

    Parameters
    ----------
    s_burn, m_vibe : array
        Progress of burning, shape exponent. [-]

    Returns
    -------
    array
        Fraction burnt; 0.999 at the end of burning. [-]
    """
    return 1 - np.exp(-6.908 * s_burn ** (m_vibe + 1))


@formula("burning_rate", "vibe_1970")
def wiebe_burning_rate(s_burn: Value, m_vibe: Value, phi_burn: Value) -> Value:
    """Rate of burning by the Wiebe function.

    Parameters
    ----------
    s_burn, m_vibe, phi_burn : array
        Progress of burning, shape exponent, duration of burning. [-], [-], [rad]

    Returns
    -------
    array
        Fraction burnt per crank angle. [1/rad]
    """
    return 6.908 * (m_vibe + 1) / phi_burn * s_burn**m_vibe * np.exp(-6.908 * s_burn ** (m_vibe + 1))


@formula("fuel_heat", "heywood_1988, ch. 3")
def fuel_heat(m_fuel: Value, H_fuel: Value, eta_burn: Value) -> Value:
    """Heat that the fuel of one cycle gives.

    Parameters
    ----------
    m_fuel, H_fuel, eta_burn : array
        Fuel per cycle, its lower heating value, combustion efficiency. [kg], [J/kg], [-]

    Returns
    -------
    array
        Heat. [J]
    """
    return m_fuel * H_fuel * eta_burn
