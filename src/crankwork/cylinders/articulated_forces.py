"""What an articulated rod passes on: to its own wall, to the master rod and its piston, and to the crankpin."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.cylinders.articulated import ArticulatedMotion, ArticulatedRod, sine_and_cosine
from crankwork.dynamics.piston_forces import rod_force, side_force
from crankwork.formula.expression import Value, formula
from crankwork.formula.known import absent, is_known
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.slider_crank import SliderCrank


@formula("knuckle_couple", "taylor_1985, ch. 8")
def couple_of_knuckle(
    P: Value, r_a: Value, sin_delta_a: Value, cos_delta_a: Value, sin_beta_a: Value, cos_beta_a: Value
) -> Value:
    """Moment of the force on the knuckle pin about the crankpin, which bends the master rod."""
    return P * r_a * (sin_delta_a + cos_delta_a * sin_beta_a / cos_beta_a)


@formula("knuckle_side_force", "taylor_1985, ch. 8")
def side_force_on_master(M_a: Value, l: Value, cos_beta: Value) -> Value:  # noqa: E741 - l is the rod length of the subject
    """Side force of the master piston that holds the moment of the force on a knuckle pin."""
    return -M_a / (l * cos_beta)


class SlaveForces(NamedTuple):
    """What the piston force of an articulated rod does, arrays of shape (n,).

    `side` on its own wall and `along` its rod; `couple` on the master rod about the crankpin; `master_side`, addition
    to the side force of the master piston; `x`, `y` on the crankpin in the axes of its own cylinder; `radial`,
    `tangential` on the crankpin by the crank, the same for every cylinder. [N], [N m]
    """

    side: Value
    along: Value
    couple: Value
    master_side: Value
    x: Value
    y: Value
    radial: Value
    tangential: Value


def slave_forces(
    P: Value, lengths: SliderCrank, rod: ArticulatedRod, grid: CrankGrid, motion: ArticulatedMotion
) -> SlaveForces:
    """Return the forces that an articulated rod passes to the master rod and with it to the crankpin. [N]

    Forces and couple; tangential force times crank radius is the torque, P dx/dphi. `P`: force on its piston pin
    along its cylinder axis, positive towards the crankshaft [N]; `grid`: crank angles from the axis of its own
    cylinder [rad]. Source: taylor_1985, ch. 8; moments on the master rod about the crankpin, then its forces.
    """
    sin_rod, cos_rod = motion.swing.sin, motion.swing.cos
    nothing: Value = absent("side_force.couple") if is_known(P) else 0.0
    side = side_force(P, sin_rod, cos_rod, nothing, nothing)
    couple = couple_of_knuckle(P, motion.own.knuckle_radius, motion.sin, motion.cos, sin_rod, cos_rod)
    held = side_force_on_master(couple, lengths.rod_length, motion.master.cos)
    # the wall of the master cylinder answers across the master's axis, which stands at -axis here
    axis_sin, axis_cos = sine_and_cosine(rod.axis, motion.own.axis, ("axis_sine", "axis_cosine"))
    x, y = held * axis_sin - P, side + held * axis_cos
    return SlaveForces(
        side,
        rod_force(P, cos_rod, nothing, sin_rod),
        couple,
        held,
        x,
        y,
        -(x * grid.cos + y * grid.sin),
        y * grid.cos - x * grid.sin,
    )
