"""Functions of crank and rod angle as notes tabulate them, and the rates of the rod."""

from __future__ import annotations

from crankwork.formula.expression import Value, formula


@formula("side_factor", "kolchin_demidov_2008, ch. 7")
def side_factor(sin_beta: Value, cos_beta: Value) -> Value:
    """Side force per force on the piston pin, tan beta."""
    return sin_beta / cos_beta


@formula("rod_factor", "kolchin_demidov_2008, ch. 7")
def rod_factor(cos_beta: Value) -> Value:
    """Force along the rod per force on the piston pin."""
    return 1 / cos_beta


@formula("radial_factor", "kolchin_demidov_2008, ch. 7")
def radial_factor(cos_phi_beta: Value, cos_beta: Value) -> Value:
    """Radial force on the crankpin per force on the piston pin."""
    return cos_phi_beta / cos_beta


@formula("tangential_factor", "kolchin_demidov_2008, ch. 7")
def tangential_factor(sin_phi_beta: Value, cos_beta: Value) -> Value:
    """Tangential force on the crankpin per force on the piston pin."""
    return sin_phi_beta / cos_beta


@formula("pin_distance", "kolchin_demidov_2008, ch. 6")
def pin_distance(r: Value, cos_phi: Value, l: Value, cos_beta: Value) -> Value:  # noqa: E741
    """Distance of the piston pin from the crankshaft along the cylinder axis."""
    return r * cos_phi + l * cos_beta


@formula("rod_angular_velocity", "kolchin_demidov_2008, ch. 6")
def rod_angular_velocity(beta_1: Value, w: Value) -> Value:
    """Angular velocity of the rod."""
    return beta_1 * w


@formula("rod_angular_acceleration", "artobolevsky_1988, ch. 5")
def rod_angular_acceleration(beta_2: Value, w: Value, beta_1: Value, eps: Value) -> Value:
    """Angular acceleration of the rod, positive as the rod angle."""
    return beta_2 * w**2 + beta_1 * eps
