"""Loads and inertia in plain numbers, for the routes that check forces found by formulas.

Inertia and moments are written out once more, on purpose: a mistake in a formula of the joint forces then shows as a
difference between the routes.
"""

from __future__ import annotations

import numpy as np

from crankwork.dynamics.running import Running
from crankwork.kinematics.bodies import body_motions
from crankwork.kinematics.crank_grid import Array
from crankwork.loads.applied import AppliedForce, AppliedLoads, AppliedTorque


def plain_loads(running: Running) -> AppliedLoads:
    """Return the loads of a mechanism together with the inertia of its bodies after D'Alembert."""
    w, eps = running.speed, running.angular_acceleration
    forces, torques = list(running.loads.forces), list(running.loads.torques)
    for body, centre, angle_1, angle_2 in body_motions(running.mechanism, running.motion):
        x, y = (-body.mass * (one.position_2 * w * w + one.position_1 * eps) for one in centre)
        forces.append(AppliedForce(body.link, centre, x, y))
        torques.append(AppliedTorque(body.link, -body.inertia * (angle_2 * w * w + angle_1 * eps), angle_1))
    return AppliedLoads(tuple(forces), tuple(torques))


def plain_wrenches(running: Running) -> dict[str, tuple[Array, Array, Array]]:
    """Return force and moment about the origin of each link.

    Components [N], [N] and moment [N m] by link.
    """
    loads, frames = plain_loads(running), running.motion.frames
    found = {link: [np.zeros_like(running.motion.grid.angle) for _ in range(3)] for link in frames}
    for force in loads.forces:
        (origin_x, origin_y), (at_x, at_y) = frames[force.link].origin, force.at
        x, y = at_x.position - origin_x.position, at_y.position - origin_y.position
        on = found[force.link]
        on[0], on[1], on[2] = on[0] + force.x, on[1] + force.y, on[2] + (x * force.y - y * force.x)
    for one in loads.torques:
        found[one.link][2] = found[one.link][2] + one.torque
    return {link: (x, y, moment) for link, (x, y, moment) in found.items()}
