"""Functions of crank and rod angle as notes tabulate them, and the rates of the rod."""

from __future__ import annotations

import numpy as np

from crankwork.expressions import Value, formula


@formula("rod_sine", "kolchin_demidov_2008, ch. 6")
def rod_sine_central(lam: Value, sin_phi: Value) -> Value:
    """Sine of the rod angle of a central slider-crank.

    Parameters
    ----------
    lam, sin_phi : array
        Crank-to-rod ratio, sine of the crank angle. [-]

    Returns
    -------
    array
        sin(beta). [-]
    """
    return lam * sin_phi


@formula("rod_cosine", "kolchin_demidov_2008, ch. 6")
def rod_cosine(sin_beta: Value) -> Value:
    """Cosine of the rod angle; `slider_crank.rod_swing` computes it without the cancellation of this form.

    Parameters
    ----------
    sin_beta : array
        Sine of the rod angle. [-]

    Returns
    -------
    array
        cos(beta). [-]
    """
    return np.sqrt(1 - sin_beta**2)


@formula("rod_angle", "kolchin_demidov_2008, ch. 6")
def rod_angle_of_functions(sin_beta: Value, cos_beta: Value) -> Value:
    """Rod angle.

    Parameters
    ----------
    sin_beta, cos_beta : array
        Functions of the rod angle. [-]

    Returns
    -------
    array
        beta, between -90 and 90 degrees. [rad]
    """
    return np.arctan(sin_beta / cos_beta)


@formula("crank_rod_sine", "kolchin_demidov_2008, ch. 7")
def crank_rod_sine(sin_phi: Value, cos_beta: Value, cos_phi: Value, sin_beta: Value) -> Value:
    """Sine of crank and rod angle together.

    Parameters
    ----------
    sin_phi, cos_beta, cos_phi, sin_beta : array
        Functions of the crank and rod angles. [-]

    Returns
    -------
    array
        sin(phi + beta). [-]
    """
    return sin_phi * cos_beta + cos_phi * sin_beta


@formula("crank_rod_cosine", "kolchin_demidov_2008, ch. 7")
def crank_rod_cosine(cos_phi: Value, cos_beta: Value, sin_phi: Value, sin_beta: Value) -> Value:
    """Cosine of crank and rod angle together.

    Parameters
    ----------
    cos_phi, cos_beta, sin_phi, sin_beta : array
        Functions of the crank and rod angles. [-]

    Returns
    -------
    array
        cos(phi + beta). [-]
    """
    return cos_phi * cos_beta - sin_phi * sin_beta


@formula("side_factor", "kolchin_demidov_2008, ch. 7")
def side_factor(sin_beta: Value, cos_beta: Value) -> Value:
    """Side force per force on the piston pin, tan beta.

    Parameters
    ----------
    sin_beta, cos_beta : array
        Functions of the rod angle. [-]

    Returns
    -------
    array
        tan(beta). [-]
    """
    return sin_beta / cos_beta


@formula("rod_factor", "kolchin_demidov_2008, ch. 7")
def rod_factor(cos_beta: Value) -> Value:
    """Force along the rod per force on the piston pin.

    Parameters
    ----------
    cos_beta : array
        Cosine of the rod angle. [-]

    Returns
    -------
    array
        1 / cos(beta). [-]
    """
    return 1 / cos_beta


@formula("radial_factor", "kolchin_demidov_2008, ch. 7")
def radial_factor(cos_phi_beta: Value, cos_beta: Value) -> Value:
    """Radial force on the crankpin per force on the piston pin.

    Parameters
    ----------
    cos_phi_beta, cos_beta : array
        cos(phi + beta), cos beta. [-]

    Returns
    -------
    array
        cos(phi + beta) / cos(beta). [-]
    """
    return cos_phi_beta / cos_beta


@formula("tangential_factor", "kolchin_demidov_2008, ch. 7")
def tangential_factor(sin_phi_beta: Value, cos_beta: Value) -> Value:
    """Tangential force on the crankpin per force on the piston pin.

    Parameters
    ----------
    sin_phi_beta, cos_beta : array
        sin(phi + beta), cos beta. [-]

    Returns
    -------
    array
        sin(phi + beta) / cos(beta). [-]
    """
    return sin_phi_beta / cos_beta


@formula("pin_distance", "kolchin_demidov_2008, ch. 6")
def pin_distance(r: Value, cos_phi: Value, l: Value, cos_beta: Value) -> Value:  # noqa: E741
    """Distance of the piston pin from the crankshaft along the cylinder axis.

    Parameters
    ----------
    r, cos_phi, l, cos_beta : array
        Crank radius, cosine of the crank angle, rod length, cosine of the rod angle. [m], [-], [m], [-]

    Returns
    -------
    array
        Distance. [m]
    """
    return r * cos_phi + l * cos_beta


@formula("rod_angular_velocity", "kolchin_demidov_2008, ch. 6")
def rod_angular_velocity(beta_1: Value, w: Value) -> Value:
    """Angular velocity of the rod.

    Parameters
    ----------
    beta_1, w : array
        dbeta/dphi, angular speed of the crank. [-], [rad/s]

    Returns
    -------
    array
        Angular velocity, positive as the rod angle. [rad/s]
    """
    return beta_1 * w


@formula("rod_angular_acceleration", "kolchin_demidov_2008, ch. 6")
def rod_angular_acceleration(beta_2: Value, w: Value) -> Value:
    """Angular acceleration of the rod at constant speed of the crank.

    Parameters
    ----------
    beta_2, w : array
        d2beta/dphi2, angular speed of the crank. [-], [rad/s]

    Returns
    -------
    array
        Angular acceleration, positive as the rod angle. [rad/s2]
    """
    return beta_2 * w**2


@formula("rod_angular_acceleration", "artobolevsky_1988, ch. 5")
def rod_angular_acceleration_unsteady(beta_2: Value, w: Value, beta_1: Value, eps: Value) -> Value:
    """Angular acceleration of the rod when the crank speed changes.

    Parameters
    ----------
    beta_2, w, beta_1, eps : array
        d2beta/dphi2, angular speed of the crank, dbeta/dphi, angular acceleration of the crank.
        [-], [rad/s], [-], [rad/s2]

    Returns
    -------
    array
        Angular acceleration, positive as the rod angle. [rad/s2]
    """
    return beta_2 * w**2 + beta_1 * eps
