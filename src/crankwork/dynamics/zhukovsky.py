"""The balancing torque by work: Zhukovsky's lever, and virtual work with the inertia forces."""

from __future__ import annotations

import numpy as np

from crankwork.dynamics.link_loads import cross
from crankwork.dynamics.plain_loads import plain_loads
from crankwork.dynamics.running import Running
from crankwork.kinematics.crank_grid import Array


def zhukovsky_torque(running: Running) -> Array:
    """Return the balancing torque from the moments of all forces on the velocity plan turned by a right angle. [N m]

    Torque on the crank, positive with the rotation. Source: artobolevsky_1988, ch. 15.

    The plan is drawn for an angular speed of 1 rad/s and turned clockwise; each force stands at the end of the
    velocity of its point. A torque is a pair of forces, square to its link at its origin and a unit length along it.
    """
    motion, loads = running.motion, plain_loads(running)
    moment = np.zeros_like(motion.grid.angle)
    for force in loads.forces:
        moment += cross((force.at.y.position_1, -force.at.x.position_1), (force.x, force.y))
    for one in loads.torques:
        frame = motion.frames[one.link]
        x, y = frame.origin.x.position_1, frame.origin.y.position_1
        across = -frame.sin * one.torque, frame.cos * one.torque
        end_x, end_y = x - frame.angle_1 * frame.sin, y + frame.angle_1 * frame.cos
        moment += cross((end_y, -end_x), across) - cross((y, -x), across)
    return -moment


def virtual_work_torque(running: Running) -> Array:
    """Return the balancing torque from the virtual work of loads and inertia (artobolevsky_1988, ch. 15). [N m]

    Torque on the crank, positive with the rotation.
    """
    loads = plain_loads(running)
    power = np.zeros_like(running.motion.grid.angle)
    for force in loads.forces:
        power += force.x * force.at.x.position_1 + force.y * force.at.y.position_1
    for one in loads.torques:
        power += one.torque * one.angle_1
    return -power
