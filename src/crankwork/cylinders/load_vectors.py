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
