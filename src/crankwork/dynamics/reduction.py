"""A whole mechanism as one turning mass: reduced inertia and its derivative, reduced torque, kinetic energy."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from crankwork.dynamics.running import Running
from crankwork.expressions import Value, formula
from crankwork.kinematics.bodies import body_motions
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied import AppliedLoads
from crankwork.mechanism.mechanism import Mechanism


@formula("reduced_inertia", "artobolevsky_1988, ch. 15")
def reduced_inertia_of_body(m_i: Value, x_S1: Value, y_S1: Value, J_S: Value, theta_1: Value) -> Value:
    """Part of one body in the reduced moment of inertia.

    Parameters
    ----------
    m_i, x_S1, y_S1, J_S, theta_1 : array
        Mass, first transfer functions of its centre, moment of inertia about it, of its rotation.
        [kg], [m], [m], [kg m2], [-]

    Returns
    -------
    array
        Moment of inertia. [kg m2]
    """
    return m_i * (x_S1**2 + y_S1**2) + J_S * theta_1**2


@formula("reduced_inertia_1", "artobolevsky_1988, ch. 15")
def reduced_inertia_1_of_body(  # noqa: PLR0913 - the five transfer functions and two masses of a body
    m_i: Value, x_S1: Value, x_S2: Value, y_S1: Value, y_S2: Value, J_S: Value, theta_1: Value, theta_2: Value
) -> Value:
    """Part of one body in the derivative of the reduced moment of inertia by the crank angle.

    Parameters
    ----------
    m_i, x_S1, x_S2, y_S1, y_S2, J_S, theta_1, theta_2 : array
        Mass, transfer functions of its centre, moment of inertia about it, transfer functions of its rotation.
        [kg], [m], [m], [m], [m], [kg m2], [-], [-]

    Returns
    -------
    array
        Derivative. [kg m2]
    """
    return 2 * (m_i * (x_S1 * x_S2 + y_S1 * y_S2) + J_S * theta_1 * theta_2)


@formula("reduced_torque", "artobolevsky_1988, ch. 15")
def reduced_torque_of_force(F_x: Value, x_1F: Value, F_y: Value, y_1F: Value) -> Value:
    """Part of one force in the reduced torque.

    Parameters
    ----------
    F_x, x_1F, F_y, y_1F : array
        Components of the force and first transfer functions of the point where it acts. [N], [m], [N], [m]

    Returns
    -------
    array
        Torque on the crank that does the same work. [N m]
    """
    return F_x * x_1F + F_y * y_1F


@formula("reduced_torque", "artobolevsky_1988, ch. 15")
def reduced_torque_of_torque(M_i: Value, theta_1: Value) -> Value:
    """Part of the torque on one link in the reduced torque.

    Parameters
    ----------
    M_i, theta_1 : array
        Torque on the link, first transfer function of its rotation. [N m], [-]

    Returns
    -------
    array
        Torque on the crank that does the same work. [N m]
    """
    return M_i * theta_1


@formula("kinetic_energy", "artobolevsky_1988, ch. 15")
def kinetic_energy(J: Value, w: Value) -> Value:
    """Kinetic energy of the mechanism.

    Parameters
    ----------
    J, w : array
        Reduced moment of inertia, angular speed of the crank. [kg m2], [rad/s]

    Returns
    -------
    array
        Energy. [J]
    """
    return J * w**2 / 2


@formula("dynamic_torque", "artobolevsky_1988, ch. 16")
def dynamic_torque(w: Value, J_1: Value, J: Value, eps: Value) -> Value:
    """Torque that changes the speed of the masses.

    Parameters
    ----------
    w, J_1, J, eps : array
        Angular speed, derivative of the reduced moment of inertia, that moment itself, angular acceleration.
        [rad/s], [kg m2], [kg m2], [rad/s2]

    Returns
    -------
    array
        Torque on the crank, positive with the rotation. [N m]
    """
    return w**2 / 2 * J_1 + J * eps


@formula("dynamic_torque", "artobolevsky_1988, ch. 16")
def dynamic_torque_steady(w: Value, J_1: Value) -> Value:
    """Torque that changes the speed of the masses while the crank turns evenly.

    Parameters
    ----------
    w, J_1 : array
        Angular speed, derivative of the reduced moment of inertia. [rad/s], [kg m2]

    Returns
    -------
    array
        Torque on the crank, positive with the rotation. [N m]
    """
    return w**2 / 2 * J_1


@formula("static_torque", "artobolevsky_1988, ch. 15")
def static_torque(M_red: Value) -> Value:
    """Torque on the crank that balances the loads alone.

    Parameters
    ----------
    M_red : array
        Reduced torque of the loads. [N m]

    Returns
    -------
    array
        Torque, positive with the rotation. [N m]
    """
    return -M_red


class ReducedInertia(NamedTuple):
    """Reduced moment of inertia and its derivative by the crank angle, arrays of shape (n,). [kg m2]"""

    inertia: Array
    inertia_1: Array


def reduced_inertia(mechanism: Mechanism, motion: Motion) -> ReducedInertia:
    """Return the reduced moment of inertia of a mechanism and its exact derivative.

    Parameters
    ----------
    mechanism : Mechanism
        Its bodies.
    motion : Motion
        Its transfer functions.

    Returns
    -------
    ReducedInertia of array, shape (n,)
        J and dJ/dphi, zero without bodies. [kg m2]

    References
    ----------
    artobolevsky_1988, ch. 15.
    """
    inertia, inertia_1 = np.zeros_like(motion.grid.angle), np.zeros_like(motion.grid.angle)
    for (m, inertia_s), (x, y), angle_1, angle_2 in (
        ((one.body.mass, one.body.inertia), *one[1:]) for one in body_motions(mechanism, motion)
    ):
        inertia += reduced_inertia_of_body(m, x.position_1, y.position_1, inertia_s, angle_1)
        inertia_1 += reduced_inertia_1_of_body(
            m, x.position_1, x.position_2, y.position_1, y.position_2, inertia_s, angle_1, angle_2
        )
    return ReducedInertia(inertia, inertia_1)


def reduced_torque(motion: Motion, loads: AppliedLoads) -> Array:
    """Return the torque on the crank that does the work of the loads.

    Parameters
    ----------
    motion : Motion
        The crank angles.
    loads : AppliedLoads
        Forces and torques.

    Returns
    -------
    array, shape (n,)
        Torque, positive with the rotation. [N m]

    References
    ----------
    artobolevsky_1988, ch. 15.
    """
    return _sum(_parts(loads), motion)


def _parts(loads: AppliedLoads) -> Iterable[Array]:
    for force in loads.forces:
        yield reduced_torque_of_force(force.x, force.at.x.position_1, force.y, force.at.y.position_1)
    for one in loads.torques:
        yield reduced_torque_of_torque(one.torque, one.angle_1)


def _sum(parts: Iterable[Array], motion: Motion) -> Array:
    total = np.zeros_like(motion.grid.angle)
    for part in parts:
        total += part
    return total


class CrankTorque(NamedTuple):
    """Torques on the crank of an ideal mechanism, positive with the rotation, arrays of shape (n,). [N m]

    `static` balances the loads, `dynamic` moves the masses, and `driving` is both.
    """

    static: Array
    dynamic: Array

    @property
    def driving(self) -> Array:
        """The torque that the crank needs. [N m]"""
        return self.static + self.dynamic


def crank_torque(running: Running) -> CrankTorque:
    """Return the torque that the crank needs without friction, from energy.

    Parameters
    ----------
    running : Running
        The mechanism at work.

    Returns
    -------
    CrankTorque of array, shape (n,)
        Static, dynamic and driving torque. [N m]

    References
    ----------
    artobolevsky_1988, ch. 16.
    """
    inertia, inertia_1 = reduced_inertia(running.mechanism, running.motion)
    dynamic = dynamic_torque(running.speed, inertia_1, inertia, running.angular_acceleration)
    return CrankTorque(static_torque(reduced_torque(running.motion, running.loads)), dynamic)
