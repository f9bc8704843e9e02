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
