"""Stroke, mean speed, ratios and dead centres of a slider-crank, and the extremes of its motion, as formulas."""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula


@formula("mean_piston_speed", "kolchin_demidov_2008, ch. 6")
def mean_piston_speed(stroke: Value, n: Value) -> Value:
    """Mean piston speed."""
    return stroke * n / 30


@formula("relative_offset", "kolchin_demidov_2008, ch. 6")
def relative_offset(e: Value, r: Value) -> Value:
    """Cylinder offset over crank radius."""
    return e / r


@formula("stroke", "kolchin_demidov_2008, ch. 6")
def stroke_central(r: Value) -> Value:
    """Stroke of a central slider-crank."""
    return 2 * r


@formula("stroke", "kolchin_demidov_2008, ch. 6")
def stroke_offset(l: Value, r: Value, e: Value) -> Value:  # noqa: E741
    """Stroke of an offset slider-crank."""
    return np.sqrt((l + r) ** 2 - e**2) - np.sqrt((l - r) ** 2 - e**2)


@formula("top_dead_centre_angle", "kolchin_demidov_2008, ch. 6")
def top_dead_centre_angle(e: Value, l: Value, r: Value) -> Value:  # noqa: E741
    """Crank angle of top dead centre, rod and crank stretched."""
    return np.arcsin(e / (l + r))


@formula("top_dead_centre_angle", "kolchin_demidov_2008, ch. 6")
def top_dead_centre_angle_before(pi: Value, e: Value, l: Value, r: Value) -> Value:  # noqa: E741
    """Crank angle of top dead centre with a negative offset, where it comes before a whole turn."""
    return 2 * pi + np.arcsin(e / (l + r))


@formula("bottom_dead_centre_angle", "kolchin_demidov_2008, ch. 6")
def bottom_dead_centre_angle(pi: Value, e: Value, l: Value, r: Value) -> Value:  # noqa: E741
    """Crank angle of bottom dead centre, rod over crank."""
    return pi + np.arcsin(e / (l - r))
