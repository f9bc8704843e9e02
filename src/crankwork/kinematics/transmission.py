"""Formulas of transmission: between the links of a dyad, or a link and the guide of its piece."""

from __future__ import annotations

import numpy as np

from crankwork.formula.expression import Value, formula


@formula("transmission_angle", "norton_2012, ch. 4")
def transmission_angle(cos_th: Value, cos_thk: Value, sin_th: Value, sin_thk: Value) -> Value:
    """Angle between the links of a dyad, from difference and sum of their directions.

    Notes
    -----
    The cosine has no digits left where links come into line.
    """
    return 2 * np.arctan(
        np.sqrt(
            ((cos_th - cos_thk) ** 2 + (sin_th - sin_thk) ** 2) / ((cos_th + cos_thk) ** 2 + (sin_th + sin_thk) ** 2)
        )
    )


@formula("transmission_cosine", "norton_2012, ch. 4")
def transmission_cosine(cos_th: Value, cos_thk: Value, sin_th: Value, sin_thk: Value) -> Value:
    """Cosine of the angle between the links of a dyad."""
    return cos_th * cos_thk + sin_th * sin_thk


@formula("transmission_angle", "norton_2012, ch. 4")
def transmission_of_cosine(cos_mu: Value) -> Value:
    """Angle between the links of a dyad from its cosine."""
    return np.arccos(cos_mu)


@formula("pressure_angle", "norton_2012, ch. 4")
def pressure_angle(sin_th: Value, cos_thk: Value, cos_th: Value, sin_thk: Value) -> Value:
    """Angle from a guide to the line of the link that moves its piece."""
    return np.arctan((sin_th * cos_thk - cos_th * sin_thk) / (cos_th * cos_thk + sin_th * sin_thk))


@formula("pressure_sine", "norton_2012, ch. 4")
def pressure_sine(sin_th: Value, cos_thk: Value, cos_th: Value, sin_thk: Value) -> Value:
    """Sine of the angle from a guide to the link that moves its piece."""
    return sin_th * cos_thk - cos_th * sin_thk


@formula("pressure_angle", "norton_2012, ch. 4")
def pressure_of_sine(sin_mu: Value) -> Value:
    """Angle between a guide and the line of the link that moves its piece, from its sine."""
    return np.arcsin(sin_mu)


@formula("transmission_angle", "norton_2012, ch. 4")
def transmission_of_pressure(mu_p: Value) -> Value:
    """Angle between a link and the normal of the guide of its piece."""
    return np.pi / 2 - mu_p
