"""What an articulated rod passes on: to its own wall, to the master rod and its piston, and to the crankpin."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.cylinders.articulated import ArticulatedMotion, ArticulatedRod
from crankwork.expressions import Value, formula
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.slider_crank import SliderCrank


@formula("knuckle_couple", "taylor_1985, ch. 8")
def couple_of_knuckle(
    P: Value, r_a: Value, sin_delta_a: Value, cos_delta_a: Value, sin_beta_a: Value, cos_beta_a: Value
) -> Value:
    """Moment of the force on the knuckle pin about the crankpin, which bends the master rod.

    Parameters
    ----------
    P, r_a, sin_delta_a, cos_delta_a, sin_beta_a, cos_beta_a : array
        Force on the piston pin, knuckle radius, functions of its direction and of the rod angle. [N], [m], [-],
        [-], [-], [-]

    Returns
    -------
    array
        Moment, positive with the rotation. [N m]
    """
    return P * r_a * (sin_delta_a + cos_delta_a * sin_beta_a / cos_beta_a)


@formula("knuckle_side_force", "taylor_1985, ch. 8")
def side_force_on_master(M_a: Value, l: Value, cos_beta: Value) -> Value:  # noqa: E741 - l is the rod length of the subject
    """Side force of the master piston that holds the moment of the force on a knuckle pin.

    Parameters
    ----------
    M_a, l, cos_beta : array
        Moment about the crankpin, length and cosine of the angle of the master rod. [N m], [m], [-]

    Returns
    -------
    array
        Addition to the side force of the master piston, positive as that. [N]
    """
    return -M_a / (l * cos_beta)


class SlaveForces(NamedTuple):
    """What the piston force of an articulated rod does, arrays of shape (n,).

    `side` on its own wall and `along` its rod; `couple` on the master rod about the crankpin; `master_side`, addition
    to the side force of the master piston; `x`, `y` on the crankpin in the axes of its own cylinder; `radial`,
    `tangential` on the crankpin by the crank, the same for every cylinder. [N], [N m]
    """

    side: Array
    along: Array
    couple: Array
    master_side: Array
    x: Array
    y: Array
    radial: Array
    tangential: Array


def slave_forces(
    P: Array, lengths: SliderCrank, rod: ArticulatedRod, grid: CrankGrid, motion: ArticulatedMotion
) -> SlaveForces:
    """Return the forces that an articulated rod passes to the master rod and with it to the crankpin.

    Parameters
    ----------
    P : array, shape (n,)
        Force on its piston pin along its cylinder axis, positive towards the crankshaft. [N]
    lengths : SliderCrank
        Crank and master rod. [m]
    rod : ArticulatedRod
        The articulated rod.
    grid : CrankGrid, shape (n,)
        Crank angles from the axis of its own cylinder. [rad]
    motion : ArticulatedMotion
        Its motion there.

    Returns
    -------
    SlaveForces of array, shape (n,)
        Forces and couple; tangential force times crank radius is the torque, P dx/dphi. [N]

    References
    ----------
    taylor_1985, ch. 8; moments on the master rod about the crankpin, then its forces.
    """
    sin_rod, cos_rod = motion.swing.sin, motion.swing.cos
    side = P * sin_rod / cos_rod
    couple = couple_of_knuckle(P, rod.knuckle_radius, motion.sin, motion.cos, sin_rod, cos_rod)
    held = side_force_on_master(couple, lengths.rod_length, motion.master.cos)
    # the wall of the master cylinder answers across the master's axis, which stands at -axis here
    axis = CrankGrid.from_degrees(rod.axis)
    x, y = -P + held * axis.sin, side + held * axis.cos
    return SlaveForces(
        side,
        P / cos_rod,
        couple,
        held,
        x,
        y,
        -(x * grid.cos + y * grid.sin),
        y * grid.cos - x * grid.sin,
    )
