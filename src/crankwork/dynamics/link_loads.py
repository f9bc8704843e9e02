"""What acts on each link before its joints: loads, and the inertia of its bodies after D'Alembert."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from crankwork.dynamics.running import Running
from crankwork.expressions import Value, formula
from crankwork.kinematics.bodies import body_motions
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.transfer import PointMotion
from crankwork.loads.applied import AppliedForce, AppliedLoads, AppliedTorque


class Wrench(NamedTuple):
    """Force [N] and moment about the origin of a frame [N m], arrays of shape (n,)."""

    x: Array
    y: Array
    moment: Array

    def plus(self, x: Array, y: Array, moment: Array) -> Wrench:
        """Return this wrench with a further one about the same origin."""
        return Wrench(self.x + x, self.y + y, self.moment + moment)


@formula("link_inertia_force", "artobolevsky_1988, ch. 12")
def link_inertia_force(m_i: Value, a_S: Value) -> Value:
    """Inertia force of a body along one axis.

    Parameters
    ----------
    m_i, a_S : array
        Mass, acceleration of its centre along the axis. [kg], [m/s2]

    Returns
    -------
    array
        Force at the centre of mass. [N]
    """
    return -m_i * a_S


@formula("link_inertia_torque", "artobolevsky_1988, ch. 12")
def link_inertia_torque(J_S: Value, eps_i: Value) -> Value:
    """Inertia torque of a body.

    Parameters
    ----------
    J_S, eps_i : array
        Moment of inertia about the centre of mass, angular acceleration of the body. [kg m2], [rad/s2]

    Returns
    -------
    array
        Torque. [N m]
    """
    return -J_S * eps_i


@formula("centre_acceleration", "artobolevsky_1988, ch. 5")
def centre_acceleration(q_2: Value, w: Value, q_1: Value, eps: Value) -> Value:
    """Acceleration of a centre of mass along one axis.

    Parameters
    ----------
    q_2, w, q_1, eps : array
        Second transfer function of the coordinate, angular speed, first transfer function, angular acceleration.
        [m], [rad/s], [m], [rad/s2]

    Returns
    -------
    array
        Acceleration. [m/s2]
    """
    return q_2 * w**2 + q_1 * eps


@formula("link_angular_acceleration", "artobolevsky_1988, ch. 5")
def link_angular_acceleration(theta_2: Value, w: Value, theta_1: Value, eps: Value) -> Value:
    """Angular acceleration of a link.

    Parameters
    ----------
    theta_2, w, theta_1, eps : array
        Second transfer function of the rotation, angular speed of the crank, first transfer function, angular
        acceleration of the crank. [-], [rad/s], [-], [rad/s2]

    Returns
    -------
    array
        Angular acceleration. [rad/s2]
    """
    return theta_2 * w**2 + theta_1 * eps


def inertia_loads(running: Running) -> AppliedLoads:
    """Return the inertia forces and torques of the bodies.

    Parameters
    ----------
    running : Running
        The mechanism at work.

    Returns
    -------
    AppliedLoads
        -m a at each centre of mass and -J eps on each link. [N], [N m]

    References
    ----------
    artobolevsky_1988, ch. 12.
    """
    w, eps = running.speed, running.angular_acceleration
    forces, torques = [], []
    for body, centre, angle_1, angle_2 in body_motions(running.mechanism, running.motion):
        x, y = (centre_acceleration(one.position_2, w, one.position_1, eps) for one in centre)
        forces.append(
            AppliedForce(body.link, centre, link_inertia_force(body.mass, x), link_inertia_force(body.mass, y))
        )
        turning = link_angular_acceleration(angle_2, w, angle_1, eps)
        torques.append(AppliedTorque(body.link, link_inertia_torque(body.inertia, turning), angle_1))
    return AppliedLoads(tuple(forces), tuple(torques))


def all_loads(running: Running) -> AppliedLoads:
    """Return the loads of a mechanism together with the inertia of its bodies."""
    return running.loads.also(inertia_loads(running))


def link_wrenches(running: Running) -> dict[str, Wrench]:
    """Return what loads and inertia put on each moving link.

    Parameters
    ----------
    running : Running
        The mechanism at work.

    Returns
    -------
    dict of str to Wrench, arrays of shape (n,)
        Force [N] and moment about the origin of the frame of the link [N m].
    """
    motion, loads = running.motion, all_loads(running)
    still = np.zeros_like(motion.grid.angle)
    wrenches = {link: Wrench(still, still, still) for link in motion.frames}
    for force in loads.forces:
        moment = cross(arm(motion.frames[force.link].origin, force.at), (force.x, force.y))
        wrenches[force.link] = wrenches[force.link].plus(force.x, force.y, moment)
    for one in loads.torques:
        wrenches[one.link] = wrenches[one.link].plus(still, still, one.torque)
    return wrenches


def arm(origin: PointMotion, point: PointMotion) -> tuple[Array, Array]:
    """Return the way from one point to another.

    Parameters
    ----------
    origin, point : PointMotion, arrays of shape (n,)
        From where, to where. [m], [m]

    Returns
    -------
    tuple of array, shape (n,)
        Components along the fixed axes. [m]
    """
    return point.x.position - origin.x.position, point.y.position - origin.y.position


def cross(a: tuple[Array, Array], b: tuple[Array, Array]) -> Array:
    """Return the cross product of two plane vectors, the moment of a force `b` with the arm `a`.

    Parameters
    ----------
    a, b : tuple of array, shape (n,)
        The vectors. [m], [N]
    """
    return a[0] * b[1] - a[1] * b[0]
