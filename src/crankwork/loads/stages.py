"""Compression in stages with coolers between them: best pressures, clearance, powers and heats, as formulas."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from crankwork.formula.expression import Value, formula

_TEXT = "eastop_mcconkey_1993, ch. 12"


@formula("limit_ratio", _TEXT)
def ratio_of_temperature(T_lim: Value, T_suc: Value, n_1: Value) -> Value:
    """Largest pressure ratio of a stage that does not heat the gas above a limit."""
    return np.power(T_lim / T_suc, n_1 / (n_1 - 1))


@formula("needed_stages", _TEXT)
def needed_stages(p_end: Value, p_first: Value, r_lim: Value) -> Value:
    """Number of stages, not yet a whole one, that keep to the largest pressure ratio of a stage."""
    return np.log(p_end / p_first) / np.log(r_lim)


@formula("stage_pressure_ratio", _TEXT)
def equal_ratio(p_end: Value, p_first: Value, z_st: Value) -> Value:
    """Pressure ratio of stages that take up the least work, where each draws in gas of the same temperature."""
    return np.power(p_end / p_first, 1 / z_st)


@formula("stage_pressure_ratio", _TEXT)
def cooled_ratio(r_st: Value, T_other: Value, T_suc: Value, n_1: Value, z_st: Value) -> Value:
    """Best pressure ratio after the temperature of another stage counts.

    Notes
    -----
    The sum of T_i r_i^a with a given product of the r_i is least where all T_i r_i^a are equal, a = (n-1)/n.
    """
    return r_st * np.power(T_other / T_suc, n_1 / ((n_1 - 1) * z_st))


@formula("clearance_volumetric_efficiency", _TEXT)
def efficiency_of_clearance(k_c: Value, p_dis: Value, p_suc: Value, n_2: Value) -> Value:
    """Volume drawn in over swept volume, by clearance and pressures."""
    return 1 + k_c - k_c * np.power(p_dis / p_suc, 1 / n_2)


@formula("clearance_ratio", _TEXT)
def clearance_of_efficiency(eta_cl: Value, p_dis: Value, p_suc: Value, n_2: Value) -> Value:
    """Clearance over swept volume, by the volume drawn in."""
    return (1 - eta_cl) / (np.power(p_dis / p_suc, 1 / n_2) - 1)


@formula("stage_power", _TEXT)
def stage_power(n_1: Value, p_suc: Value, Q_in: Value, p_dis: Value) -> Value:
    """Power of a polytropic compression, of clearance gas that expands as it is compressed."""
    return n_1 / (n_1 - 1) * p_suc * Q_in * (np.power(p_dis / p_suc, (n_1 - 1) / n_1) - 1)


@formula("returned_power", _TEXT)
def returned_power(k_c: Value, Q_sw: Value, n_2: Value, p_suc: Value, p_dis: Value) -> Value:
    """Power that clearance gas gives back as it expands."""
    return k_c * Q_sw * n_2 / (n_2 - 1) * (p_dis - p_suc * np.power(p_dis / p_suc, 1 / n_2))


@formula("isothermal_efficiency", _TEXT)
def isothermal_share(P_iso: Value, P_st: Value) -> Value:
    """Isothermal power over that which the gas takes up in all stages."""
    return P_iso / P_st


@formula("stage_saving", _TEXT)
def stage_saving(P_st: Value, P_one: Value) -> Value:
    """Share of the power of one stage that several save."""
    return 1 - P_st / P_one


@formula("cooler_heat", _TEXT)
def cooler_heat(G_gas: Value, c_gas: Value, T_dis: Value, T_cold: Value) -> Value:
    """Heat that a cooler takes from the gas per unit of time."""
    return G_gas * c_gas * (T_dis - T_cold)


@formula("cylinder_heat", _TEXT)
def cylinder_heat(P_st: Value, G_gas: Value, c_gas: Value, T_dis: Value, T_suc: Value) -> Value:
    """Heat through the walls of a stage per unit of time: what does not stay in the gas."""
    return P_st - G_gas * c_gas * (T_dis - T_suc)


@formula("water_flow", _TEXT)
def water_flow(Q_cooler: Value, c_wat: Value, dT_wat: Value) -> Value:
    """Water that takes a heat and warms up by some degrees."""
    return Q_cooler / (c_wat * dT_wat)


@dataclass(frozen=True)
class Stages:
    """A compressor of several stages.

    `numbers`: as a machine file has them, by key, one for all or one for each stage or cooler [SI]; `chambers`: those
    of a linkage by stage; `has_speed`: whether it is stated how fast the crank turns.
    """

    numbers: Mapping[str, tuple[float, ...]]
    chambers: tuple[tuple[str, ...], ...] = ()
    has_speed: bool = True
