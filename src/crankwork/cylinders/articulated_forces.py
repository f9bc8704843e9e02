"""Forces of an articulated rod: on its own wall, on the master rod and its piston, and on the crankpin."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.cylinders.articulated import ArticulatedMotion, ArticulatedRod, sine_and_cosine
from crankwork.dynamics.piston_forces import rod_force, side_force
from crankwork.formula.expression import Value, formula
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.slider_crank import SliderCrank


@formula("knuckle_acceleration_x", "artobolevsky_1988, ch. 5")
def knuckle_acceleration_along(x_A2: Value, w: Value, x_A1: Value, eps: Value) -> Value:
    """Acceleration of the knuckle pin along the cylinder axis, positive towards the head."""
    return x_A2 * w**2 + x_A1 * eps


@formula("knuckle_acceleration_y", "artobolevsky_1988, ch. 5")
def knuckle_acceleration_across(y_A2: Value, w: Value, y_A1: Value, eps: Value) -> Value:
    """Acceleration of the knuckle pin across the cylinder axis."""
    return y_A2 * w**2 + y_A1 * eps


@formula("knuckle_force_x", "taylor_1985, ch. 8")
def knuckle_force_along(P: Value, m_2a: Value, a_Ax: Value, g: Value, cos_theta: Value) -> Value:
    """Force of the articulated rod on its knuckle pin along the cylinder axis, positive towards the head."""
    return -P - m_2a * (a_Ax + g * cos_theta)


@formula("knuckle_force_y", "taylor_1985, ch. 8")
def knuckle_force_across(  # noqa: PLR0913 - one argument per symbol
    P: Value, sin_beta_a: Value, cos_beta_a: Value, dN: Value, m_2a: Value, a_Ay: Value, g: Value, sin_theta: Value
) -> Value:
    """Force of the articulated rod on its knuckle pin across the cylinder axis."""
    return P * sin_beta_a / cos_beta_a + dN - m_2a * (a_Ay - g * sin_theta)


@formula("knuckle_couple", "taylor_1985, ch. 8")
def couple_of_knuckle(r_a: Value, Y_A: Value, cos_delta_a: Value, X_A: Value, sin_delta_a: Value) -> Value:
    """Moment of the force on the knuckle pin about the crankpin, which bends the master rod."""
    return r_a * (Y_A * cos_delta_a - X_A * sin_delta_a)


@formula("knuckle_side_force", "taylor_1985, ch. 8")
def side_force_on_master(M_a: Value, l: Value, cos_beta: Value) -> Value:  # noqa: E741 - l is the rod length of the subject
    """Side force of the master piston that holds the moment of the force on a knuckle pin."""
    return -M_a / (l * cos_beta)


class KnuckleMass(NamedTuple):
    """The mass of an articulated rod at its knuckle pin, with the motion of that pin.

    `mass` at the knuckle pin [kg], its acceleration along and across the axis of the cylinder [m/s2]; `gravity` [m/s2]
    with cosine and sine of the inclination of the cylinder; `couple`, side force of a rod that is not two masses [N];
    `transverse_weight` of the reciprocating mass [N].
    """

    mass: Value = 0.0
    along: Value = 0.0
    across: Value = 0.0
    gravity: Value = 0.0
    lean_cos: Value = 1.0
    lean_sin: Value = 0.0
    couple: Value = 0.0
    transverse_weight: Value = 0.0


_MASSLESS = KnuckleMass()


class ArticulatedForces(NamedTuple):
    """Forces due to the piston force of an articulated rod, arrays of shape (n,).

    `side` on its own wall and `along` its rod; `knuckle`, force on its knuckle pin along and across its axis; `couple`
    on the master rod about the crankpin; `master_side`, addition to the side force of the master piston; `x`, `y` on
    the crankpin in the axes of its own cylinder; `radial`, `tangential` on the crankpin by the crank, the same for
    every cylinder. [N], [N m]
    """

    side: Value
    along: Value
    knuckle: tuple[Value, Value]
    couple: Value
    master_side: Value
    x: Value
    y: Value
    radial: Value
    tangential: Value


def articulated_forces(
    P: Value,
    lengths: SliderCrank,
    rod: ArticulatedRod,
    grid: CrankGrid,
    motion: ArticulatedMotion,
    held: KnuckleMass = _MASSLESS,
) -> ArticulatedForces:
    """Return the forces that an articulated rod passes to the master rod and with it to the crankpin. [N]

    Forces and couple; tangential force times crank radius is the torque. `P`: force on its piston pin along its
    cylinder axis, positive towards the crankshaft [N]; `grid`: crank angles from the axis of its own cylinder [rad].
    Source: taylor_1985, ch. 8; moments on the master rod about the crankpin, then its forces.
    """
    sin_rod, cos_rod = motion.swing.sin, motion.swing.cos
    side = side_force(P, sin_rod, cos_rod, held.couple, held.transverse_weight)
    X = knuckle_force_along(P, held.mass, held.along, held.gravity, held.lean_cos)
    Y = knuckle_force_across(P, sin_rod, cos_rod, held.couple, held.mass, held.across, held.gravity, held.lean_sin)
    couple = couple_of_knuckle(motion.own.knuckle_radius, Y, motion.cos, X, motion.sin)
    wall = side_force_on_master(couple, lengths.rod_length, motion.master.cos)
    # the wall of the master cylinder answers across the master's axis, which stands at -axis here
    axis_sin, axis_cos = sine_and_cosine(rod.axis, motion.own.axis, ("axis_sine", "axis_cosine"))
    x, y = wall * axis_sin + X, Y + wall * axis_cos
    return ArticulatedForces(
        side,
        rod_force(P, cos_rod, held.couple, sin_rod),
        (X, Y),
        couple,
        wall,
        x,
        y,
        -(x * grid.cos + y * grid.sin),
        y * grid.cos - x * grid.sin,
    )
