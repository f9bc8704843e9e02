"""Independent methods for the torque on the crank: from joint forces, and four that share no formula with them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np

from crankwork.dynamics.force_system import numeric_loads, system_joint_forces
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import OperatingState, cross
from crankwork.dynamics.reduction import crank_torque
from crankwork.kinematics.crank_grid import Array


def torque_by_groups(running: OperatingState) -> Array:
    """Return the torque from the joint forces, group after group to the crank. [N m]"""
    return np.asarray(joint_forces(running).balancing_torque)


def torque_by_full_system(running: OperatingState) -> Array:
    """Return the torque from one linear system of all links. [N m]"""
    return np.asarray(system_joint_forces(running).balancing_torque)


def torque_by_energy(running: OperatingState) -> Array:
    """Return the torque from the work of the loads and the change of the kinetic energy. [N m]"""
    return np.asarray(crank_torque(running).driving)


def zhukovsky_torque(running: OperatingState) -> Array:
    """Return the balancing torque from the moments of all forces on the rotated velocity polygon. [N m]

    Torque on the crank, positive with the rotation. Source: artobolevsky_1988, ch. 15.

    The polygon is drawn for an angular speed of 1 rad/s and rotated clockwise by 90 degrees; each force acts at the tip
    of the velocity of its point. A torque is a pair of forces, square to its link at its origin and a unit along it.
    """
    motion, loads = running.motion, numeric_loads(running)
    moment = np.zeros_like(motion.grid.angle)
    for force in loads.forces:
        moment += cross((force.point.y.position_1, -force.point.x.position_1), (force.x, force.y))
    for torque in loads.torques:
        frame = motion.frames[torque.link]
        x, y = frame.origin.x.position_1, frame.origin.y.position_1
        across = -frame.sin * torque.torque, frame.cos * torque.torque
        end_x, end_y = x - frame.angle_1 * frame.sin, y + frame.angle_1 * frame.cos
        moment += cross((end_y, -end_x), across) - cross((y, -x), across)
    return -moment


def virtual_work_torque(running: OperatingState) -> Array:
    """Return the balancing torque from the virtual work of loads and inertia (artobolevsky_1988, ch. 15). [N m]

    Torque on the crank, positive with the rotation.
    """
    loads = numeric_loads(running)
    power = np.zeros_like(running.motion.grid.angle)
    for force in loads.forces:
        power += force.x * force.point.x.position_1 + force.y * force.point.y.position_1
    for torque in loads.torques:
        power += torque.torque * torque.angle_1
    return -power


TORQUE_METHODS: Mapping[str, Callable[[OperatingState], Array]] = MappingProxyType({
    "whole_system": torque_by_full_system, "zhukovsky": zhukovsky_torque, "virtual_work": virtual_work_torque,
    "energy": torque_by_energy,
})  # fmt: skip
