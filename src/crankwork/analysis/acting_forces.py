"""Forces and torques on the links of a linkage at one crank angle, each with what it comes from."""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

import numpy as np

from crankwork.dynamics.link_loads import inertia_loads
from crankwork.dynamics.operating_state import OperatingState
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.kinematic_coefficients import PointMotion
from crankwork.loads.applied_loads import ForceKind


class ActingForce(NamedTuple):
    """A force on a link, the sum of those of its kind at one point. [N]"""

    kind: ForceKind
    link: str
    point: PointMotion
    force: Array
    before: int = 0  # How many of its kind on its link stand before it


class ActingTorque(NamedTuple):
    """A torque on a link, positive anticlockwise [N m], and the link's rate of turning over the crank's."""

    kind: ForceKind
    link: str
    torque: float
    rate: float


def first_value(value: object) -> float:
    """Return the first element of a column, at the one angle that is asked for."""
    return float(np.ravel(np.asarray(value, dtype=float))[0])


def place_of(point: PointMotion) -> Array:
    """Return where a point is. [m]"""
    return np.array([first_value(side.position) for side in point])


def acting_forces(running: OperatingState) -> list[ActingForce]:
    """Return the loads, weights and inertia forces on the links, those that are zero left out."""
    sums: dict[tuple[object, ...], ActingForce] = {}
    for load in running.loads.also(inertia_loads(running)).forces:
        force, place = np.array([first_value(load.x), first_value(load.y)]), np.round(place_of(load.point), 9)
        key = (load.kind, load.link, *place.tolist())
        same = sums.get(key)
        sums[key] = ActingForce(load.kind, load.link, load.point, force if same is None else same.force + force)
    seen, result = Counter[tuple[str, str]](), list[ActingForce]()
    for acting in sums.values():
        if np.any(acting.force):
            result.append(acting._replace(before=seen[acting[:2]]))
            seen[acting[:2]] += 1
    return result


def acting_torques(running: OperatingState) -> list[ActingTorque]:
    """Return the torques of loads and of inertia on the links, those of one kind on a link as one."""
    sums: dict[tuple[str, str], ActingTorque] = {}
    for load in running.loads.also(inertia_loads(running)).torques:
        same, torque = sums.get((load.kind, load.link)), first_value(load.torque)
        total = torque + (same.torque if same else 0.0)
        sums[load.kind, load.link] = ActingTorque(load.kind, load.link, total, first_value(load.angle_1))
    return [*sums.values()]
