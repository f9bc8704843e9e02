"""Formulas of the working space: areas, volumes, polytropes and the force of the gas."""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula


@formula("piston_area", "kolchin_demidov_2008, ch. 5")
def piston_area(pi: Value, D: Value) -> Value:
    """Area of a circle of the bore."""
    return pi * D**2 / 4


@formula("swept_volume", "kolchin_demidov_2008, ch. 5")
def swept_volume(A: Value, stroke: Value) -> Value:
    """Swept volume."""
    return A * stroke


@formula("clearance_volume", "kolchin_demidov_2008, ch. 5")
def clearance_volume(V_d: Value, r_c: Value) -> Value:
    """Clearance volume that gives a compression ratio."""
    return V_d / (r_c - 1)


@formula("compression_ratio", "kolchin_demidov_2008, ch. 5")
def compression_ratio(V_d: Value, V_c: Value) -> Value:
    """Compression ratio."""
    return (V_d + V_c) / V_c


@formula("cylinder_volume", "kolchin_demidov_2008, ch. 5")
def cylinder_volume(V_c: Value, A: Value, x: Value) -> Value:
    """Volume above the piston."""
    return V_c + A * x


@formula("diagram_pressure", "kolchin_demidov_2008, ch. 5")
def polytropic_pressure(p_1: Value, V_1: Value, V: Value, n_p: Value) -> Value:
    """Pressure on a polytrope through a known state."""
    return p_1 * np.power(V_1 / V, n_p)


@formula("gas_force", "kolchin_demidov_2008, ch. 7")
def gas_force(p: Value, A: Value, p_b: Value, A_r: Value) -> Value:
    """Force of the gas on the piston, less that on the side of a piston rod, positive towards the crankshaft."""
    return p * A - p_b * (A - A_r)


@formula("indicated_mean_pressure", "kolchin_demidov_2008, ch. 4")
def indicated_mean_pressure(W: Value, V_d: Value) -> Value:
    """Indicated mean effective pressure."""
    return W / V_d


@formula("mean_torque", "kolchin_demidov_2008, ch. 7")
def mean_torque(W: Value, phi_c: Value) -> Value:
    """Mean crank torque that does the work of a cycle."""
    return W / phi_c


@formula("indicated_power", "kolchin_demidov_2008, ch. 4")
def indicated_power(W: Value, w: Value, phi_c: Value) -> Value:
    """Indicated power of one cylinder."""
    return W * w / phi_c


@formula("gas_pressure", "kolchin_demidov_2008, ch. 7")
def gauge_pressure(p_abs: Value, p_0: Value) -> Value:
    """Pressure above that on the crankcase side."""
    return p_abs - p_0


@formula("piston_area", "kolchin_demidov_2008, ch. 7")
def face_area(A: Value, A_r: Value) -> Value:
    """Area of a face that a piston rod passes."""
    return A - A_r


@formula("face_volume", "kolchin_demidov_2008, ch. 5")
def face_volume(sigma: Value, A: Value, s_x: Value, s_x0: Value) -> Value:
    """Volume that a sliding piece adds to a chamber, from its position at the smallest volume on."""
    return sigma * A * (s_x - s_x0)


@formula("cylinder_volume_1", "kolchin_demidov_2008, ch. 5")
def face_volume_1(sigma: Value, A: Value, s_1: Value) -> Value:
    """Part of one sliding piece in the derivative of the volume of a chamber by the crank angle."""
    return sigma * A * s_1


@formula("cylinder_volume_2", "kolchin_demidov_2008, ch. 5")
def face_volume_2(sigma: Value, A: Value, s_2: Value) -> Value:
    """Part of one sliding piece in the second derivative of the volume of a chamber by the crank angle."""
    return sigma * A * s_2


@formula("gas_force", "kolchin_demidov_2008, ch. 7")
def face_force(sigma: Value, p: Value, A: Value) -> Value:
    """Force of the gas on a sliding piece, positive along its guide."""
    return sigma * p * A


@formula("reduced_volume", "urieli_berchowitz_1984")
def reduced_volume(V: Value, T_cyl: Value) -> Value:
    """Volume of a part of the gas over its absolute temperature."""
    return V / T_cyl


@formula("diagram_pressure", "urieli_berchowitz_1984")
def isothermal_pressure(m_gas: Value, R_gas: Value, Z: Value) -> Value:
    """Pressure of a sealed mass of gas, every part of which keeps its temperature."""
    return m_gas * R_gas / Z


@formula("gas_mass", "urieli_berchowitz_1984")
def charge_mass(p_ref: Value, Z_1: Value, R_gas: Value) -> Value:
    """Mass of gas that has a pressure, every part at its own temperature."""
    return p_ref * Z_1 / R_gas
