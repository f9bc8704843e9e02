"""The load of a bearing as a vector, in the frame of whatever turns with it.

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

from crankwork.expressions import Value, formula
from crankwork.kinematics.crank_grid import Array, CrankGrid


@formula("bearing_load", "kolchin_demidov_2008, ch. 7")
def bearing_load(F_x: Value, F_y: Value) -> Value:
    """Size of a load from its components.

    Parameters
    ----------
    F_x, F_y : array
        Components in one frame. [N], [N]

    Returns
    -------
    array
        Force. [N]
    """
    return np.sqrt(F_x**2 + F_y**2)


class BearingLoad(NamedTuple):
    """A load in one frame: x along its reference direction, y a quarter turn further, shape (n,). [N]"""

    x: Array
    y: Array

    @property
    def resultant(self) -> Array:
        """Size of the load. [N]"""
        return np.asarray(bearing_load(self.x, self.y))

    @property
    def direction(self) -> Array:
        """Angle of the force from the reference direction, at least 0 and less than 360. [deg]"""
        turned = np.degrees(np.arctan2(self.y, self.x)) % 360
        return np.asarray(np.where(turned == 360, 0.0, turned))

    @property
    def opposite(self) -> BearingLoad:
        """The force with which what is loaded presses back."""
        return BearingLoad(-self.x, -self.y)


def turned(load: BearingLoad, sin: ArrayLike, cos: ArrayLike) -> BearingLoad:
    """Return a load in a frame that its own frame is ahead of.

    Parameters
    ----------
    load : BearingLoad of array, shape (n,)
        Load in its own frame. [N]
    sin, cos : array, shape (n,), or float
        Functions of the angle by which its own frame is ahead of the other, with the rotation. [-]

    Returns
    -------
    BearingLoad of array, shape (n,)
        The same vector in the other frame. [N]
    """
    sin, cos = np.asarray(sin), np.asarray(cos)
    return BearingLoad(load.x * cos - load.y * sin, load.x * sin + load.y * cos)


def turned_by(load: BearingLoad, angle: ArrayLike) -> BearingLoad:
    """Return a load in a frame that its own frame is ahead of by an angle, exactly at multiples of 90 degrees.

    Parameters
    ----------
    load : BearingLoad of array, shape (n,)
        Load in its own frame: of a crankpin, for the shaft frame; of the shaft, for the block frame. [N]
    angle : array, shape (n,), or float
        How far its own frame is ahead: `pin_angle`; the direction of crank 1 in the block. [deg]

    Returns
    -------
    BearingLoad of array, shape (n,)
        The same vector in the other frame. [N]
    """
    grid = CrankGrid.from_degrees(angle)
    return turned(load, grid.sin, grid.cos)
