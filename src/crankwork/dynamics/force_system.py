"""Joint forces of several links, or of a whole mechanism, by one linear system."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from crankwork.dynamics.link_loads import Wrench, arm, cross, link_wrenches
from crankwork.dynamics.reaction import GuideForce, JointForces, PinForce, Reaction, gathered, joint_place
from crankwork.dynamics.running import Running
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.dyads import LinkMotion
from crankwork.kinematics.motion import Motion
from crankwork.mechanism.joints import Joint, Pin, group_links, joints
from crankwork.mechanism.mechanism import Crank

Vector = tuple[Array, Array]

_ZERO, _ONE = np.array(0.0), np.array(1.0)
_FIXED_AXES: list[Vector] = [(_ONE, _ZERO), (_ZERO, _ONE)]


@dataclass(frozen=True)
class Equilibrium:
    """The equations of some links, three each, with two unknowns for each joint.

    Parameters
    ----------
    links : tuple of str
        The links, in order.
    joints : tuple of Joint
        The joints that hold them, in order.
    matrix : array, shape (n, 3 links, unknowns)
        Force and moment on each link of a unit of each unknown; moments about the origins of the frames. [- or m]
    """

    links: tuple[str, ...]
    joints: tuple[Joint, ...]
    matrix: Array

    def right_side(self, wrenches: Mapping[str, Wrench]) -> Array:
        """Return minus what acts on the links, shape (n, 3 links). [N], [N m]"""
        return -np.stack([part for link in self.links for part in wrenches[link]], axis=-1)

    def reactions(self, unknowns: Array) -> dict[Joint, Reaction]:
        """Return the reactions by joint, from the unknowns of shape (n, unknowns). [N], [N m]"""
        return {
            joint: (PinForce(joint, *pair) if isinstance(joint, Pin) else GuideForce(joint, *pair))
            for k, joint in enumerate(self.joints)
            for pair in [(unknowns[..., 2 * k], unknowns[..., 2 * k + 1])]
        }


def equilibrium(
    motion: Motion, links: Sequence[str], held: Sequence[Joint], *, crank: Crank | None = None
) -> Equilibrium:
    """Return the equations of equilibrium of some links.

    Parameters
    ----------
    motion : Motion
        Where everything is.
    links : sequence of str
        The links.
    held : sequence of Joint
        The joints that hold them.
    crank : Crank, optional
        The link on which a torque is the last unknown, positive with the rotation.
    """
    row = {link: 3 * k for k, link in enumerate(links)}
    matrix = np.zeros((len(motion.grid), 3 * len(row), 2 * len(held) + (crank is not None)))
    for k, joint in enumerate(held):
        place, frame = joint_place(joint, motion), motion.frames[joint.link]
        for link, sign in ((joint.link, 1.0), (joint.other, -1.0)):
            if link not in row:
                continue
            i, way = row[link], arm(motion.frames[link].origin, place)
            for j, unit in enumerate(_FIXED_AXES if isinstance(joint, Pin) else _normal(frame), start=2 * k):
                matrix[:, i, j], matrix[:, i + 1, j] = sign * unit[0], sign * unit[1]
                matrix[:, i + 2, j] = sign * cross(way, unit)
            if not isinstance(joint, Pin):
                matrix[:, i + 2, 2 * k + 1] = sign
    if crank is not None:
        matrix[:, row[crank.link] + 2, -1] = crank.direction
    return Equilibrium(tuple(links), tuple(held), matrix)


def _normal(guide: LinkMotion) -> list[Vector]:
    return [(-guide.sin, guide.cos)]


def solved_group(
    motion: Motion, links: Sequence[str], held: Sequence[Joint], wrenches: Mapping[str, Wrench]
) -> dict[Joint, Reaction]:
    """Return the reactions in the joints of one group.

    Parameters
    ----------
    motion : Motion
        Where everything is.
    links : sequence of str
        The links of the group.
    held : sequence of Joint
        The joints that hold them.
    wrenches : mapping of str to Wrench, arrays of shape (n,)
        What acts on them. [N]

    References
    ----------
    artobolevsky_1988, ch. 13.
    """
    system = equilibrium(motion, links, held)
    return system.reactions(solve_positions(system.matrix, system.right_side(wrenches)))


def system_joint_forces(running: Running) -> JointForces:
    """Return the forces in all joints and the balancing torque from one linear system.

    Parameters
    ----------
    running : Running
        The mechanism at work.

    Returns
    -------
    JointForces, arrays of shape (n,)
        The same as `joint_forces` gives group after group. [N], [N m]

    References
    ----------
    norton_2012, ch. 11.
    """
    system = whole_system(running)
    unknowns = solve_positions(system.matrix, system.right_side(link_wrenches(running)))
    return gathered(system.reactions(unknowns), system.joints, unknowns[..., -1])


def whole_system(running: Running) -> Equilibrium:
    """Return the equations of equilibrium of all links, the last unknown the balancing torque.

    Parameters
    ----------
    running : Running
        The mechanism at work.
    """
    mechanism = running.mechanism
    held = joints(mechanism)
    # a link of a chain may only hold others
    holding = (name for group in mechanism.dyads for name in group_links(group))
    links = tuple(dict.fromkeys([*(joint.link for joint in held), *holding]))
    return equilibrium(running.motion, links, held, crank=mechanism.crank)


def solve_positions(matrix: Array, right: Array) -> Array:
    """Return the solutions of linear systems, NaN where the position is not known or singular.

    Parameters
    ----------
    matrix, right : array, shape (n, k, k) and (n, k)
        A system for each position. [m], [N]
    """
    known: NDArray[np.bool_] = np.asarray(np.isfinite(matrix).all(axis=(-2, -1)) & np.isfinite(right).all(axis=-1))
    solution = np.full_like(right, np.nan)
    try:
        solution[known] = np.linalg.solve(matrix[known], right[known, :, None])[..., 0]
    except np.linalg.LinAlgError:
        known = known & (np.linalg.det(np.where(known[:, None, None], matrix, 0.0)) != 0)
        solution[known] = np.linalg.solve(matrix[known], right[known, :, None])[..., 0]
    return solution
