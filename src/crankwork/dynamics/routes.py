"""The routes to the torque on the crank: by the forces in joints, and four that share no formula with them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np

from crankwork.dynamics.force_system import system_joint_forces
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.reduction import crank_torque
from crankwork.dynamics.running import Running
from crankwork.dynamics.zhukovsky import virtual_work_torque, zhukovsky_torque
from crankwork.kinematics.crank_grid import Array


def by_groups(running: Running) -> Array:
    """Return the torque that the forces in joints end in, group after group to the crank. [N m]"""
    return np.asarray(joint_forces(running).balancing_torque)


def whole_system(running: Running) -> Array:
    """Return the torque from one linear system of all links. [N m]"""
    return np.asarray(system_joint_forces(running).balancing_torque)


def energy(running: Running) -> Array:
    """Return the torque from the work of the loads and the change of the kinetic energy. [N m]"""
    return np.asarray(crank_torque(running).driving)


ROUTES: Mapping[str, Callable[[Running], Array]] = MappingProxyType({
    "whole_system": whole_system, "zhukovsky": zhukovsky_torque, "virtual_work": virtual_work_torque, "energy": energy,
})  # fmt: skip
