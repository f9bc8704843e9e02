"""Reduction of a mechanism to one rotating mass: reduced inertia and its derivative, torque, kinetic energy."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.dynamics.link_loads import OperatingState, distinct
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import named
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.dyads import is_zero
from crankwork.kinematics.motion import Motion, body_motions, broadcast, sum_columns
from crankwork.loads.applied_loads import AppliedLoads
from crankwork.mechanism.mechanism import Mechanism

Differences = Literal["forward", "central", "spectral"]


@dataclass(frozen=True)
class TabulatedBody:
    """A body whose motion is a column of numbers."""

    name: str
    # Mass, and moment of inertia about the point whose speed is given [kg], [kg m2]
    mass: float = 0.0
    inertia: float = 0.0
    # Speed of that point over the angular speed of the crank, one for each crank angle [m]
    velocity_ratio: tuple[float, ...] = (0.0,)
    rotation_ratio: tuple[float, ...] = (0.0,)  # Angular speed of the body over that of the crank [-]


@formula("reduced_inertia", "artobolevsky_1988, ch. 15")
def reduced_inertia_of_ratios(m_i: Value, v_w: Value, J_S: Value, w_w: Value) -> Value:
    """Part of one body in the reduced moment of inertia, from its speeds over that of the crank."""
    return m_i * v_w**2 + J_S * w_w**2


def spectral_derivative(crank_angle: ArrayLike, values: ArrayLike) -> Array:
    """Return the derivative by the crank angle of the trigonometric polynomial through a column of a revolution.

    [kg m2] ValueError unless the crank angles are equidistant and there is one value for each. [rad]
    """
    angle, column = np.asarray(crank_angle, dtype=float), np.asarray(values, dtype=float)
    step = np.diff(angle, append=angle[:1] + 2 * np.pi)
    if angle.shape != column.shape or np.any(step <= 0):
        raise ValueError("crank angles must ascend within one revolution, with one value each")
    if np.ptp(step) > 1e-9:
        raise ValueError("the spectral derivative needs equidistant crank angles over the whole revolution")
    orders = np.fft.rfftfreq(column.size, 1 / column.size)
    if column.size % 2 == 0:
        orders[-1] = 0.0
    return np.fft.irfft(1j * orders * np.fft.rfft(column), column.size)


@formula("reduced_inertia", "artobolevsky_1988, ch. 15")
def reduced_inertia_of_body(m_i: Value, x_S1: Value, y_S1: Value, J_S: Value, theta_1: Value) -> Value:
    """Part of one body in the reduced moment of inertia."""
    return m_i * (x_S1**2 + y_S1**2) + J_S * theta_1**2


@formula("reduced_inertia_1", "artobolevsky_1988, ch. 15")
def reduced_inertia_1_of_body(  # noqa: PLR0913 - the five transfer functions and two masses of a body
    m_i: Value, x_S1: Value, x_S2: Value, y_S1: Value, y_S2: Value, J_S: Value, theta_1: Value, theta_2: Value
) -> Value:
    """Part of one body in the derivative of the reduced moment of inertia by the crank angle."""
    return 2 * (m_i * (x_S1 * x_S2 + y_S1 * y_S2) + J_S * theta_1 * theta_2)


@formula("reduced_torque", "artobolevsky_1988, ch. 15")
def reduced_torque_of_force(F_x: Value, x_1F: Value, F_y: Value, y_1F: Value) -> Value:
    """Part of one force in the reduced torque."""
    return F_x * x_1F + F_y * y_1F


@formula("reduced_torque", "artobolevsky_1988, ch. 15")
def reduced_torque_of_torque(M_i: Value, theta_1: Value) -> Value:
    """Part of the torque on one link in the reduced torque."""
    return M_i * theta_1


@formula("kinetic_energy", "artobolevsky_1988, ch. 15")
def kinetic_energy(J: Value, w: Value) -> Value:
    """Kinetic energy of the mechanism."""
    return J * w**2 / 2


@formula("driver_power", "artobolevsky_1988, ch. 15")
def driver_power(Q_q: Value, v_q: Value) -> Value:
    """Power of a driver."""
    return Q_q * v_q


@formula("dynamic_torque", "artobolevsky_1988, ch. 16")
def dynamic_torque(w: Value, J_1: Value, J: Value, eps: Value) -> Value:
    """Torque that changes the speed of the masses."""
    return w**2 / 2 * J_1 + J * eps


@formula("static_torque", "artobolevsky_1988, ch. 15")
def static_torque(M_red: Value) -> Value:
    """Torque on the crank that balances the loads alone."""
    return -M_red


class ReducedInertia(NamedTuple):
    """Reduced moment of inertia and its derivative by the crank angle, arrays of shape (n,). [kg m2]"""

    inertia: Value
    inertia_1: Value


def reduced_inertia(mechanism: Mechanism, motion: Motion, additional: Value = 0.0) -> ReducedInertia:
    """Return the reduced moment of inertia of a mechanism and its exact derivative. [kg m2]

    J and dJ/dphi, zero without bodies. Source: artobolevsky_1988, ch. 15.
    """
    inertia, inertia_1 = [], []
    bodies = body_motions(mechanism, motion)
    names = distinct(moving.body.link for moving in bodies)
    for name, (body, (x, y), angle_1, angle_2) in zip(names, bodies, strict=True):
        m, inertia_s = body.mass, body.inertia
        part = reduced_inertia_of_body(m, x.position_1, y.position_1, inertia_s, angle_1)
        part_1 = reduced_inertia_1_of_body(
            m, x.position_1, x.position_2, y.position_1, y.position_2, inertia_s, angle_1, angle_2
        )
        inertia.append(named(part, f"reduced_inertia.{name}"))
        inertia_1.append(named(part_1, f"reduced_inertia_1.{name}"))
    if not is_zero(additional):
        inertia.append(broadcast(additional, motion.grid))
    total = sum_columns("reduced_inertia", inertia, motion.grid)
    return ReducedInertia(total, sum_columns("reduced_inertia_1", inertia_1, motion.grid))


def reduced_torque(motion: Motion, loads: AppliedLoads) -> Value:
    """Return the torque on the crank that does the work of the loads (artobolevsky_1988, ch. 15). [N m]

    Torque, positive with the rotation.
    """
    return sum_columns("reduced_torque", _parts(loads), motion.grid)


def _parts(loads: AppliedLoads) -> Iterable[Value]:
    names = iter(distinct([*(load.link for load in loads.forces), *(load.link for load in loads.torques)]))
    for force in loads.forces:
        part = reduced_torque_of_force(force.x, force.point.x.position_1, force.y, force.point.y.position_1)
        yield named(part, f"reduced_torque.{next(names)}")
    for torque in loads.torques:
        yield named(reduced_torque_of_torque(torque.torque, torque.angle_1), f"reduced_torque.{next(names)}")


class CrankTorque(NamedTuple):
    """Torques on the crank of an ideal mechanism, positive with the rotation, arrays of shape (n,). [N m]

    `static` balances the loads, `dynamic` moves the masses, and `driving` is both.
    """

    static: Value
    dynamic: Value

    @property
    def driving(self) -> Value:
        """The driving torque of the crank. [N m]"""
        return self.static + self.dynamic


def crank_torque(running: OperatingState) -> CrankTorque:
    """Return the torque needed at the crank without friction, from energy (artobolevsky_1988, ch. 16). [N m]"""
    inertia, inertia_1 = reduced_inertia(running.mechanism, running.motion)
    dynamic = dynamic_torque(running.speed, inertia_1, inertia, running.angular_acceleration)
    return CrankTorque(static_torque(reduced_torque(running.motion, running.loads)), dynamic)


@formula("balancing_torque", "artobolevsky_1988, ch. 16")
def balancing_torque_of_parts(M_st: Value, M_dyn: Value) -> Value:
    """Torque on the crank that balances the loads and moves the masses."""
    return M_st + M_dyn


@formula("static_torque", "artobolevsky_1988, ch. 16")
def static_torque_of_balancing(M_b: Value, M_dyn: Value) -> Value:
    """Static torque that a known balancing torque leaves."""
    return M_b - M_dyn


@formula("reduced_inertia_1", "artobolevsky_1988, ch. 16")
def forward_difference(J_next: Value, J: Value, dphi: Value) -> Value:
    """Derivative of the reduced inertia by the difference to the next position."""
    return (J_next - J) / dphi


@formula("reduced_inertia_1", "artobolevsky_1988, ch. 16")
def central_difference(J_next: Value, J_prev: Value, dphi: Value) -> Value:
    """Derivative of the reduced inertia by the difference of the positions on both sides."""
    return (J_next - J_prev) / dphi
