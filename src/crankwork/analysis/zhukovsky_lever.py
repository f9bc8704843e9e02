"""Zhukovsky's lever: the velocity plan turned by a right angle, with all forces at the ends of their velocities."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from crankwork.analysis.force_plans import acting_forces, acting_torques, first_value
from crankwork.analysis.operating_state import operating_state
from crankwork.analysis.results import Results
from crankwork.analysis.sampled_motion import sample_motion
from crankwork.analysis.vector_polygons import VectorPolygon, velocities
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.kinematic_coefficients import PointMotion
from crankwork.kinematics.motion import linkage_motion
from crankwork.loads.applied_loads import ForceKind
from crankwork.mechanism.mechanism import Crank

# moments smaller than this share of the largest are left out
_NEGLIGIBLE = 1e-9


class LeverForce(NamedTuple):
    """A force on the lever: on which link, the end of the velocity of its point, turned [m/s], and its parts [N]."""

    kind: ForceKind
    link: str
    end: Array
    force: Array
    before: int = 0  # How many of its kind on its link stand before it

    @property
    def size(self) -> float:
        """Its magnitude. [N]"""
        return float(np.hypot(*self.force))

    @property
    def moment(self) -> float:
        """Its moment about the pole, positive anticlockwise. [W]"""
        return float(self.end[0] * self.force[1] - self.end[1] * self.force[0])

    @property
    def arm(self) -> float:
        """Distance of the pole from its line of action. [m/s]"""
        return abs(self.moment) / self.size

    @property
    def foot(self) -> Array:
        """Foot of the arm on its line of action. [m/s]"""
        along = self.force / self.size
        return np.asarray(self.end - (self.end @ along) * along)


class LeverTorque(NamedTuple):
    """A torque on a link, and how fast the link turns. [N m], [rad/s]"""

    kind: ForceKind
    link: str
    torque: float
    turning: float

    @property
    def moment(self) -> float:
        """Its part of the moment about the pole. [W]"""
        return self.torque * self.turning


class Lever(NamedTuple):
    """The turned plan with the forces and torques that have a moment, and the force on the crank pin that balances."""

    plan: VectorPolygon
    forces: tuple[LeverForce, ...]
    torques: tuple[LeverTorque, ...]
    balancing: LeverForce
    radius: float  # Of the crank [m]

    @property
    def torque(self) -> float:
        """The balancing torque on the crank, positive with its rotation. [N m]"""
        return self.balancing.moment / float(np.hypot(*self.balancing.end)) * self.radius


def zhukovsky_lever(results: Results, degrees: float, links: tuple[str, ...] = ()) -> Lever | None:
    """Return the lever at a crank angle [deg] (artobolevsky_1988, ch. 15), none where nothing acts or nothing moves.

    `links`: the moving links in the order of their numbers. The plan is turned clockwise; the balancing force is square
    to the crank.
    """
    mechanism, speed = results.machine.mechanism, results.solved.speed
    if not isinstance(mechanism.driver, Crank) or not speed:
        return None
    running = operating_state(results.solved, linkage_motion(mechanism, CrankGrid.from_degrees([degrees])))
    forces = [
        LeverForce(acting.kind, acting.link, _turned(acting.point, speed), acting.force, acting.before)
        for acting in acting_forces(running)
    ]
    torques = [LeverTorque(load.kind, load.link, load.torque, load.rate * speed) for load in acting_torques(running)]
    # a force square to its velocity has only the moment of rounding errors
    sizes = [force.size * float(np.hypot(*force.end)) for force in forces] + [abs(torque.moment) for torque in torques]
    most = max(sizes, default=0.0)
    forces = [force for force in forces if abs(force.moment) > _NEGLIGIBLE * most]
    torques = [torque for torque in torques if abs(torque.moment) > _NEGLIGIBLE * most]
    if not forces and not torques:
        return None
    plan = velocities(mechanism, sample_motion(mechanism, [degrees]), 0, speed, links)
    pin = running.motion.points[mechanism.driver.pin]
    end = _turned(pin, speed)
    # forwards where the pin moves, which on the turned plan is square to the crank
    forwards = np.array([-end[1], end[0]]) / np.hypot(*end)
    total = sum(force.moment for force in forces) + sum(torque.moment for torque in torques)
    return Lever(
        VectorPolygon({name: _clockwise(node) for name, node in plan.nodes.items()}, [
            vector._replace(start=_clockwise(vector.start), end=_clockwise(vector.end)) for vector in plan.vectors
        ], plan.turning, plan.coincident),
        tuple(forces), tuple(torques),
        LeverForce("load", mechanism.driver.link, end, -total / np.hypot(*end) * forwards),
        mechanism.driver.radius,
    )  # fmt: skip


def _clockwise(vector: Array) -> Array:
    return np.array([vector[1], -vector[0]])


def _turned(point: PointMotion, speed: float) -> Array:
    """Return the velocity of a point, turned clockwise. [m/s]"""
    return _clockwise(np.array([first_value(item.position_1) for item in point]) * speed)
