"""The load of a bearing as a vector, in fixed and rotating frames.

A load has two components in a frame: x along the reference direction of the frame, y a quarter turn further
with the rotation. A vector is the same in every frame but for the angle by which the frame is turned:

* crank frame: x along the crank arm, away from the crankshaft, so that x is minus the radial force and y the
  tangential force;
* shaft frame: that of the crank of cylinder 1, into which a load on another crankpin turns by its `pin_angle`;
* rod frame: x along the rod, from the crankpin to the piston pin; the crank frame is phi + beta ahead of it;
* cylinder frame: x along the cylinder axis, away from the crankshaft; the crank frame is phi ahead of it;
* block frame: x along the reference direction of the engine.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import named
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.slider_crank import RodSwing


@formula("bearing_force_x", "kolchin_demidov_2008, ch. 7")
def turned_along(F_x: Value, F_y: Value, sin_psi: Value, cos_psi: Value) -> Value:
    """Component of a load along the reference direction of a frame that its own frame is ahead of."""
    return F_x * cos_psi - F_y * sin_psi


@formula("bearing_force_y", "kolchin_demidov_2008, ch. 7")
def turned_across(F_x: Value, F_y: Value, sin_psi: Value, cos_psi: Value) -> Value:
    """Component of a load across the reference direction of a frame that its own frame is ahead of."""
    return F_x * sin_psi + F_y * cos_psi


@formula("bearing_load", "kolchin_demidov_2008, ch. 7")
def bearing_load(F_x: Value, F_y: Value) -> Value:
    """Size of a load from its components."""
    return np.sqrt(F_x**2 + F_y**2)


class BearingLoad(NamedTuple):
    """A load in one frame: x along its reference direction, y a quarter turn further, shape (n,). [N]"""

    x: Value
    y: Value

    @property
    def resultant(self) -> Value:
        """Size of the load. [N]"""
        return bearing_load(self.x, self.y)

    @property
    def direction(self) -> Array:
        """Angle of the force from the reference direction, at least 0 and less than 360. [deg]"""
        turned = np.degrees(np.arctan2(self.y, self.x)) % 360
        return np.asarray(np.where(turned == 360, 0.0, turned))

    def named(self, owner: str) -> BearingLoad:
        """Return the load under the name of its owner, if it is traced."""
        return BearingLoad(named(self.x, f"bearing_force_x.{owner}"), named(self.y, f"bearing_force_y.{owner}"))

    @property
    def opposite(self) -> BearingLoad:
        """The reaction to the load."""
        return BearingLoad(-self.x, -self.y)


def rotated(load: BearingLoad, sin: Value, cos: Value) -> BearingLoad:
    """Return a load in a frame that its own frame is ahead of. [N]

    `sin` and `cos`: functions of the angle by which its own frame is ahead of the other, with the rotation.
    """
    return BearingLoad(turned_along(load.x, load.y, sin, cos), turned_across(load.x, load.y, sin, cos))


def rotated_by(load: BearingLoad, angle: ArrayLike) -> BearingLoad:
    """Return a load in a frame that its own frame is ahead of by an angle, exactly at multiples of 90 degrees. [N]

    `load`: load in its own frame: of a crankpin, for the shaft frame; of the shaft, for the block frame [N]; `angle`:
    how far its own frame is ahead: `pin_angle`; the direction of crank 1 in the block [deg].
    """
    grid = CrankGrid.from_degrees(angle)
    sin, cos = (float(value) if value.ndim == 0 else value for value in (grid.sin, grid.cos))
    return rotated(load, sin, cos)


@formula("big_end_inertia_force", "kolchin_demidov_2008, ch. 7")
def big_end_inertia_force(m_2: Value, r: Value, w: Value) -> Value:
    """Inertia force of the rod mass at the crankpin."""
    return -m_2 * r * w**2


@formula("big_end_weight", "artobolevsky_1988, ch. 13")
def big_end_weight(m_2: Value, g: Value, cos_phi: Value, cos_theta: Value, sin_phi: Value, sin_theta: Value) -> Value:
    """Weight of the rod mass at the crankpin along the crank arm, positive towards the crankshaft."""
    return m_2 * g * (cos_phi * cos_theta - sin_phi * sin_theta)


@formula("big_end_tangential_force", "artobolevsky_1988, ch. 13")
def big_end_tangential_force(  # noqa: PLR0913 - one argument per symbol
    m_2: Value, g: Value, sin_phi: Value, cos_theta: Value, cos_phi: Value, sin_theta: Value, r: Value, eps: Value
) -> Value:
    """Weight of the rod mass at the crankpin across the crank arm, less what its angular acceleration takes."""
    return m_2 * (g * (sin_phi * cos_theta + cos_phi * sin_theta) - r * eps)


@formula("crankpin_radial_force", "kolchin_demidov_2008, ch. 7")
def crankpin_radial_force(K: Value, K_Rb: Value, K_wb: Value) -> Value:
    """Load on the crankpin along the crank arm."""
    return K + K_Rb + K_wb


@formula("crankpin_tangential_force", "kolchin_demidov_2008, ch. 7")
def crankpin_tangential_force(T: Value, T_b: Value) -> Value:
    """Load on the crankpin across the crank arm."""
    return T + T_b


@formula("crankpin_load", "kolchin_demidov_2008, ch. 7")
def crankpin_load(T: Value, K: Value, K_Rb: Value) -> Value:
    """Size of the load on the crankpin."""
    return np.sqrt(T**2 + (K + K_Rb) ** 2)


@formula("piston_pin_force", "lukanin_shatrov_2007, ch. 1")
def piston_pin_force(F_g: Value, m_p: Value, a: Value, F_wp: Value) -> Value:
    """Force of the piston on its pin along the cylinder axis, without the rod mass at the pin."""
    return F_g - m_p * a + F_wp


@formula("small_end_load", "lukanin_shatrov_2007, ch. 1")
def small_end_load(P_p: Value, N: Value) -> Value:
    """Size of the load on the small end of the rod."""
    return np.sqrt(P_p**2 + N**2)


@formula("bearing_pressure", "kolchin_demidov_2008, ch. 7")
def bearing_pressure(R_b: Value, d_b: Value, l_b: Value) -> Value:
    """Load per projected area of the bearing."""
    return R_b / (d_b * l_b)


@formula("bearing_load_ratio", "kolchin_demidov_2008, ch. 9")
def bearing_load_ratio(R_max: Value, R_mean: Value) -> Value:
    """Largest load over the mean load."""
    return R_max / R_mean


def big_end_bearing_load(load: BearingLoad, swing: RodSwing) -> BearingLoad:
    """Return the load on the big-end bearing of a rod: the force of the crankpin on it, in the rod frame. [N]

    Opposite to the load on the crankpin, turned by phi + beta; positive x presses the bearing towards the piston pin,
    as compression does. `load`: force of this rod alone on the crankpin, in the crank frame [N]. Source:
    kolchin_demidov_2008, ch. 7.
    """
    return rotated(load.opposite, swing.sin_sum, swing.cos_sum)


def small_end_bearing_load(pin_force: Value, side: Value, swing: RodSwing) -> BearingLoad:
    """Return the load on the small-end bearing, the force of the piston pin on it, in the rod frame. [N]

    Negative x presses the bearing towards the crankpin, as compression does. The side force of a cylinder that leans
    has the weight of the piston group across the axis in it. Source: lukanin_shatrov_2007.

    The piston hands on axially what acts on it and sideways what the wall gives back, so the force on the rod
    needs no rod mass. It is the force along the rod plus the inertia force that moves the rod's small-end mass.
    """
    return rotated(BearingLoad(-pin_force, side), swing.sin, swing.cos)
