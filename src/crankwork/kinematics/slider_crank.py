"""Slider-crank motion in closed form, central or offset.

Crank angle phi from the cylinder axis on the head side; offset e towards the crankpin at 90 degrees;
rod angle beta with sin beta = (r sin phi - e) / l; displacement from top dead centre towards the
crankshaft. Transfer functions are derivatives by the crank angle.
"""

from __future__ import annotations

import operator
from typing import NamedTuple

import numpy as np

from crankwork.errors import GeometryError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import Arithmetic, is_traced, named
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.locale import ErrorMessage


@formula("rod_ratio", "kolchin_demidov_2008, ch. 6")
def rod_ratio(r: Value, l: Value) -> Value:  # noqa: E741 - l is the rod length of the subject
    """Crank radius over rod length."""
    return r / l


@formula("rod_sine", "kolchin_demidov_2008, ch. 6")
def rod_sine(lam: Value, sin_phi: Value, e: Value, r: Value) -> Value:
    """Sine of the rod angle."""
    return lam * (sin_phi - e / r)


def _printed_rod_cosine(sin_beta: Value) -> Value:
    return np.sqrt(1 - sin_beta**2)


@formula("rod_cosine", "kolchin_demidov_2008, ch. 6", printed=_printed_rod_cosine)
def rod_cosine(sin_beta: Value, r: Value, l: Value, e: Value, less_sin_phi: Value, more_sin_phi: Value) -> Value:  # noqa: ARG001, E741 - the sine is what books print it from
    """Cosine of the rod angle.

    Notes
    -----
    cos^2 = (1 - sin)(1 + sin), each factor as the rod length less crank and offset, plus
    r (1 -+ sin phi). Neither cancels when the rod is hardly longer than crank and offset.
    """
    clearance = l - r
    lost = (l - clearance) - r
    return np.sqrt((clearance + e + lost + r * less_sin_phi) * (clearance - e + lost + r * more_sin_phi)) / l


@formula("rod_angle", "kolchin_demidov_2008, ch. 6")
def rod_angle(sin_beta: Value, cos_beta: Value) -> Value:
    """Angle of the rod from the cylinder axis, between -90 and 90 degrees."""
    return np.arctan(sin_beta / cos_beta)


@formula("crank_rod_sine", "kolchin_demidov_2008, ch. 7")
def crank_rod_sine(sin_phi: Value, cos_beta: Value, cos_phi: Value, sin_beta: Value) -> Value:
    """Sine of crank and rod angle together."""
    return sin_phi * cos_beta + cos_phi * sin_beta


@formula("crank_rod_cosine", "kolchin_demidov_2008, ch. 7")
def crank_rod_cosine(cos_phi: Value, cos_beta: Value, sin_phi: Value, sin_beta: Value) -> Value:
    """Cosine of crank and rod angle together."""
    return cos_phi * cos_beta - sin_phi * sin_beta


def _printed_displacement(r: Value, l: Value, e: Value, cos_phi: Value, cos_beta: Value) -> Value:  # noqa: E741
    return np.sqrt((r + l) ** 2 - e**2) - r * cos_phi - l * cos_beta


@formula("piston_displacement", "kolchin_demidov_2008, ch. 6", printed=_printed_displacement)
def piston_displacement(r: Value, cos_phi: Value, l: Value, sin_beta: Value, cos_beta: Value, e: Value) -> Value:  # noqa: E741
    """Piston displacement.

    Notes
    -----
    1 - cos beta = sin^2 beta / (1 + cos beta), and the same for the dead centre, keep all digits as the ratio goes
    to zero.
    """
    return r * (1 - cos_phi) + l * sin_beta**2 / (1 + cos_beta) - e**2 / (r + l + np.sqrt((r + l) ** 2 - e**2))


@formula("piston_transfer_1", "kolchin_demidov_2008, ch. 6")
def piston_transfer_1(r: Value, sin_phi_beta: Value, cos_beta: Value) -> Value:
    """First transfer function of the piston, dx/dphi; the velocity over the angular speed."""
    return r * sin_phi_beta / cos_beta


@formula("piston_transfer_2", "kolchin_demidov_2008, ch. 6")
def piston_transfer_2(r: Value, lam: Value, cos_phi: Value, cos_phi_beta: Value, cos_beta: Value) -> Value:
    """Second transfer function of the piston, d2x/dphi2; the acceleration over the speed squared.

    Notes
    -----
    Derivative of r (sin phi + cos phi tan beta) with beta' = lambda cos phi / cos beta.
    """
    return r * (cos_phi_beta / cos_beta + lam * cos_phi**2 / cos_beta**3)


@formula("rod_transfer_1", "kolchin_demidov_2008, ch. 6")
def rod_transfer_1(lam: Value, cos_phi: Value, cos_beta: Value) -> Value:
    """First transfer function of the rod, dbeta/dphi."""
    return lam * cos_phi / cos_beta


@formula("rod_transfer_2", "kolchin_demidov_2008, ch. 6")
def rod_transfer_2(beta_1: Value, lam: Value, sin_phi: Value, sin_beta: Value, cos_beta: Value) -> Value:
    """Second transfer function of the rod, d2beta/dphi2.

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
        made = self.rod_length.node if is_traced(self.rod_length) else None
        if isinstance(made, Arithmetic) and made.inputs[0] is self.crank_radius and made.function is operator.truediv:
            # what the length was made of
            return made.inputs[1]
        return rod_ratio(self.crank_radius, self.rod_length)

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
    """Return whether the rod is longer than crank and offset together, by more than rounding."""
    return bool(np.all(slider_crank.clearance > _ROUNDING * np.asarray(slider_crank.rod_length)))


def check_slider_crank(slider_crank: SliderCrank) -> None:
    """Raise if the crank cannot turn fully."""
    r, l, e = (float(np.max(np.abs(length))) for length in slider_crank)  # noqa: E741
    if np.any(np.less_equal(slider_crank.crank_radius, 0)) or np.any(np.less_equal(slider_crank.rod_length, 0)):
        raise GeometryError(ErrorMessage("lengths_zero"))
    if not turns_fully(slider_crank):
        raise GeometryError(
            ErrorMessage("rod_too_short", length=l * 1e3, radius=r * 1e3, offset=e * 1e3, missing=(r + e - l) * 1e3)
        )


class RodSwing(NamedTuple):
    """Functions of the rod angle beta, and of phi + beta. [-]"""

    sin: Value
    cos: Value
    sin_sum: Value
    cos_sum: Value


def rod_swing(slider_crank: SliderCrank, grid: CrankGrid, lam: Value = None, *, part: str = "") -> RodSwing:
    """Return the sines and cosines of the rod angle and of crank and rod angle together. [-]

    `lam`: its rod ratio, where that is known already; `part`: what tells this rod from another of the same trace,
    `.master`. Source: kolchin_demidov_2008, ch. 6, for sin(beta).
    """
    r, l, e = slider_crank  # noqa: E741
    sin_beta = named(rod_sine(slider_crank.rod_ratio if lam is None else lam, grid.sin, e, r), f"rod_sine{part}")
    cos_beta = rod_cosine(sin_beta, r, l, e, grid.one_minus_sin, grid.one_plus_sin)
    cos_beta = named(cos_beta, f"rod_cosine{part}")
    return RodSwing(
        sin_beta,
        cos_beta,
        crank_rod_sine(grid.sin, cos_beta, grid.cos, sin_beta),
        crank_rod_cosine(grid.cos, cos_beta, grid.sin, sin_beta),
    )


def _difference(large: Value, small: Value, smaller: Value) -> Value:
    """Return large - small - smaller with the rounding of the first subtraction put back."""
    first = large - small
    return (first - smaller) + ((large - first) - small)


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


@formula("time_ratio", "artobolevsky_1988, ch. 4")
def time_ratio_of_offset(pi: Value, e: Value, l: Value, r: Value) -> Value:  # noqa: E741
    """Crank angle of the slower stroke over that of the faster one, by the size of the offset."""
    return (pi + np.arcsin(e / (l - r)) - np.arcsin(e / (l + r))) / (
        pi - np.arcsin(e / (l - r)) + np.arcsin(e / (l + r))
    )
