"""Slider-crank motion in closed form, central or offset.

Crank angle phi from the cylinder axis on the head side; offset e towards the crankpin at 90 degrees;
rod angle beta with sin beta = (r sin phi - e) / l; displacement from top dead centre towards the
crankshaft. Transfer functions are derivatives by the crank angle.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from crankwork.errors import GeometryError
from crankwork.expressions import Value, formula
from crankwork.kinematics.crank_grid import Array, CrankGrid


@formula("rod_angle", "kolchin_demidov_2008, ch. 6")
def rod_angle_sine(lam: Value, r: Value, e: Value, sin_phi: Value) -> Value:
    """Sine of the rod angle.

    Parameters
    ----------
    lam, r, e, sin_phi : array
        Crank-to-rod ratio, crank radius, offset, sine of the crank angle. [-], [m], [m], [-]

    Returns
    -------
    array
        sin(beta). [-]
    """
    return lam * (sin_phi - e / r)


@formula("piston_displacement", "kolchin_demidov_2008, ch. 6")
def piston_displacement(r: Value, lam: Value, sin_phi: Value, cos_phi: Value, cos_beta: Value) -> Value:
    """Piston displacement of a central slider-crank.

    Parameters
    ----------
    r, lam, sin_phi, cos_phi, cos_beta : array
        Crank radius, crank-to-rod ratio, functions of the crank and rod angles. [m], [-], [-], [-], [-]

    Returns
    -------
    array
        Displacement from top dead centre. [m]

    Notes
    -----
    R (1 - cos phi) + L (1 - cos beta) with 1 - cos beta = sin^2 beta / (1 + cos beta), which keeps
    all digits as the ratio goes to zero.
    """
    return r * (1 - cos_phi + lam * sin_phi**2 / (1 + cos_beta))


@formula("piston_displacement", "kolchin_demidov_2008, ch. 6")
def piston_displacement_offset(r: Value, l: Value, e: Value, cos_phi: Value, cos_beta: Value) -> Value:  # noqa: E741 - l is the rod length of the subject
    """Piston displacement of an offset slider-crank.

    Parameters
    ----------
    r, l, e, cos_phi, cos_beta : array
        Crank radius, rod length, offset, functions of the crank and rod angles. [m], [m], [m], [-], [-]

    Returns
    -------
    array
        Displacement from top dead centre. [m]
    """
    return np.sqrt((r + l) ** 2 - e**2) - r * cos_phi - l * cos_beta


@formula("piston_velocity", "kolchin_demidov_2008, ch. 6")
def piston_transfer_1(r: Value, sin_phi_beta: Value, cos_beta: Value) -> Value:
    """First transfer function of the piston, dx/dphi; the velocity over the angular speed.

    Parameters
    ----------
    r, sin_phi_beta, cos_beta : array
        Crank radius, sin(phi + beta), cos beta. [m], [-], [-]

    Returns
    -------
    array
        dx/dphi. [m]
    """
    return r * sin_phi_beta / cos_beta


@formula("piston_acceleration", "kolchin_demidov_2008, ch. 6")
def piston_transfer_2(r: Value, lam: Value, cos_phi: Value, cos_phi_beta: Value, cos_beta: Value) -> Value:
    """Second transfer function of the piston, d2x/dphi2; the acceleration over the speed squared.

    Parameters
    ----------
    r, lam, cos_phi, cos_phi_beta, cos_beta : array
        Crank radius, crank-to-rod ratio, cos phi, cos(phi + beta), cos beta. [m], [-], [-], [-], [-]

    Returns
    -------
    array
        d2x/dphi2. [m]

    Notes
    -----
    Derivative of r (sin phi + cos phi tan beta) with beta' = lambda cos phi / cos beta.
    """
    return r * (cos_phi_beta / cos_beta + lam * cos_phi**2 / cos_beta**3)


def piston_transfer_3(slider_crank: SliderCrank, grid: CrankGrid) -> Array:
    """Return the third transfer function of the piston, d3x/dphi3, which is zero at extremes of acceleration.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]

    Returns
    -------
    array, shape (n,)
        d3x/dphi3. [m]

    References
    ----------
    Derivative of `piston_transfer_2`.
    """
    rod = rod_swing(slider_crank, grid)
    lam, cos_beta = slider_crank.rod_ratio, rod.cos
    bracket = (
        rod.sin_sum / cos_beta
        + 3 * lam * grid.sin * grid.cos / cos_beta**3
        - 3 * lam**2 * grid.cos**3 * rod.sin / cos_beta**5
    )
    return np.asarray(-slider_crank.crank_radius * bracket)


@formula("rod_angular_velocity", "kolchin_demidov_2008, ch. 6")
def rod_transfer_1(lam: Value, cos_phi: Value, cos_beta: Value) -> Value:
    """First transfer function of the rod, dbeta/dphi.

    Parameters
    ----------
    lam, cos_phi, cos_beta : array
        Crank-to-rod ratio, functions of the crank and rod angles. [-], [-], [-]

    Returns
    -------
    array
        dbeta/dphi. [-]
    """
    return lam * cos_phi / cos_beta


@formula("rod_angular_acceleration", "kolchin_demidov_2008, ch. 6")
def rod_transfer_2(beta_1: Value, lam: Value, sin_phi: Value, sin_beta: Value, cos_beta: Value) -> Value:
    """Second transfer function of the rod, d2beta/dphi2.

    Parameters
    ----------
    beta_1, lam, sin_phi, sin_beta, cos_beta : array
        dbeta/dphi, crank-to-rod ratio, functions of the crank and rod angles. [-], [-], [-], [-], [-]

    Returns
    -------
    array
        d2beta/dphi2. [-]

    Notes
    -----
    From differentiating cos(beta) beta' = lambda cos(phi); holds with offset.
    """
    return (beta_1**2 * sin_beta - lam * sin_phi) / cos_beta


# Share of the rod length that adding up lengths may leave.
_ROUNDING = 1e-12


class SliderCrank(NamedTuple):
    """The three lengths of a slider-crank, floats or arrays of designs. [m]"""

    crank_radius: Value
    rod_length: Value
    offset: Value = 0.0

    @property
    def rod_ratio(self) -> Value:
        """Crank radius over rod length. [-]"""
        return self.crank_radius / self.rod_length

    @property
    def clearance(self) -> Value:
        """Rod length less crank radius and offset, which must be positive for the crank to turn. [m]"""
        return _difference(self.rod_length, self.crank_radius, np.abs(self.offset))

    @property
    def top_dead_centre(self) -> float:
        """Crank angle at which the piston is farthest from the crankshaft. [rad]"""
        return float(np.arcsin(self.offset / (self.rod_length + self.crank_radius)))

    @property
    def bottom_dead_centre(self) -> float:
        """Crank angle at which the piston is nearest to the crankshaft. [rad]"""
        return float(np.pi + np.arcsin(self.offset / (self.rod_length - self.crank_radius)))

    @property
    def stroke(self) -> Value:
        """Distance between the dead centres. [m]"""
        r, l, e = self  # noqa: E741
        if np.all(np.equal(e, 0)):
            return 2 * r
        far, near = (l + r - e) * (l + r + e), _difference(l, r, e) * _difference(l, r, -e)
        return 4 * l * r / (np.sqrt(far) + np.sqrt(near))


def turns_fully(slider_crank: SliderCrank) -> bool:
    """Return whether the rod is longer than crank and offset together, by more than rounding.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.
    """
    return bool(np.all(slider_crank.clearance > _ROUNDING * np.asarray(slider_crank.rod_length)))


def check_slider_crank(slider_crank: SliderCrank) -> None:
    """Raise if the crank cannot turn fully.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.

    Raises
    ------
    GeometryError
        If the rod is not longer than crank and offset together, with the length that is missing.
    """
    r, l, e = (float(np.max(np.abs(one))) for one in slider_crank)  # noqa: E741
    if np.any(np.less_equal(slider_crank.crank_radius, 0)) or np.any(np.less_equal(slider_crank.rod_length, 0)):
        raise GeometryError("crank radius and rod length must be more than zero")
    if not turns_fully(slider_crank):
        raise GeometryError(
            f"the rod ({l * 1e3:g} mm) must be longer than crank radius and offset together "
            f"({r * 1e3:g} + {e * 1e3:g} mm); it misses {(r + e - l) * 1e3:.6g} mm: lengthen the rod"
        )


class RodSwing(NamedTuple):
    """Functions of the rod angle beta, and of phi + beta. [-]"""

    sin: Array
    cos: Array
    sin_sum: Array
    cos_sum: Array


def rod_swing(slider_crank: SliderCrank, grid: CrankGrid) -> RodSwing:
    """Return the sines and cosines of the rod angle and of crank and rod angle together.

    Parameters
    ----------
    slider_crank : SliderCrank
        The dimensions.
    grid : CrankGrid, shape (n,)
        Crank angles. [rad]

    Returns
    -------
    RodSwing of array, shape (n,)
        Functions of the angles. [-]

    References
    ----------
    kolchin_demidov_2008, ch. 6, for sin(beta).

    Notes
    -----
    cos^2 = (1 - sin)(1 + sin), each factor as what is left of the rod length beside crank and offset
    plus r (1 -+ sin phi). Neither cancels when the rod is hardly longer than crank and offset.
    """
    r, l, e = slider_crank  # noqa: E741
    sin_beta = rod_angle_sine(slider_crank.rod_ratio, r, e, grid.sin)
    if np.all(np.equal(e, 0)):
        spare = _difference(l, r, 0.0)
        factors = (spare + r * grid.one_minus_sin) * (spare + r * grid.one_plus_sin)
    else:
        factors = (_difference(l, r, -e) + r * grid.one_minus_sin) * (_difference(l, r, e) + r * grid.one_plus_sin)
    cos_beta = np.sqrt(factors) / l
    return RodSwing(
        sin_beta,
        cos_beta,
        grid.sin * cos_beta + grid.cos * sin_beta,
        grid.cos * cos_beta - grid.sin * sin_beta,
    )


def _difference(large: Value, small: Value, smaller: Value) -> Value:
    """Return large - small - smaller with the rounding of the first subtraction put back."""
    first = large - small
    return (first - smaller) + ((large - first) - small)
