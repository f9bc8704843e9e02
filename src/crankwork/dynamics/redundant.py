"""Redundant links: statically indeterminate forces, given as a ratio to the force along another link."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from crankwork.dynamics.dyad_forces import force_along
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import OperatingState
from crankwork.dynamics.reaction import JointForces
from crankwork.formula.expression import Value
from crankwork.formula.traced_value import given, is_traced, named
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied_loads import NO_LOADS, AppliedLoads, force_at
from crankwork.mechanism.joints import Pin, joints
from crankwork.mechanism.linkage import Member
from crankwork.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class RedundantLink:
    """A link with two joints that does not change the motion of the linkage; it fits, and only carries.

    Without a share its force is unknown, and so are the forces in all joints.
    """

    member: Member  # As drawn
    # The joined points, and their distance [m]
    start: str
    end: str
    length: float
    # The force along it over that along another link, both positive where they press [-]
    share: float | None = None
    # The other link, the joint at which the force along it is taken, its second joint, and their distance [m]
    reference: str = ""
    reference_end: str = ""
    reference_start: str = ""
    reference_length: float = 0.0


def with_redundant(running: OperatingState, links: Sequence[RedundantLink]) -> OperatingState:
    """Return a mechanism in operation with the forces of its redundant links on their joints, in numbers.

    All forces are linear in those of the redundant links, which follow from the forces without them and from those due
    to a unit of each.
    """
    if not links:
        return running
    forces = redundant_forces(running, links)
    loads = running.loads
    for link, force in zip(links, forces, strict=True):
        loads = loads.also(pressing(running.mechanism, running.motion, link, force))
    return replace(running, loads=loads)


def redundant_forces(running: OperatingState, links: Sequence[RedundantLink]) -> Array:
    """Return the pressing forces of redundant links, shape (links, n). [N]"""
    mechanism, motion, count = running.mechanism, running.motion, len(running.motion.grid)
    without = _along_others(running, links)
    matrix = np.zeros((count, len(links), len(links)))
    for k, link in enumerate(links):
        unit = pressing(mechanism, motion, link, np.ones(count))
        massless = replace(mechanism, bodies=())
        alone = OperatingState(massless, motion, np.zeros(count), unit, np.zeros(count))
        matrix[:, :, k] = -np.stack(_along_others(alone, links), axis=-1)
    shares = np.array([link.share or 0.0 for link in links])
    matrix *= shares[:, None]
    matrix += np.eye(len(links))
    solution = np.linalg.solve(matrix, (np.stack(without, axis=-1) * shares)[..., None])
    return np.asarray(solution[..., 0].T)


def _along_others(running: OperatingState, links: Sequence[RedundantLink]) -> list[Array]:
    forces = joint_forces(running)
    return [np.asarray(force_along_other(running.mechanism, running.motion, forces, link)) for link in links]


def force_along_other(mechanism: Mechanism, motion: Motion, forces: JointForces, link: RedundantLink) -> Value:
    """Return the force along the link that a redundant link has its share of, positive in compression. [N]"""
    x: Value = 0.0
    y: Value = 0.0
    for joint in joints(mechanism):
        if isinstance(joint, Pin) and joint.point == link.reference_end and link.reference in (joint.link, joint.other):
            force = forces.pins[joint.name]
            sides = (force.x, force.y) if joint.link == link.reference else (-force.x, -force.y)
            x, y = x + sides[0], y + sides[1]
    x, y = named(x, f"link_force_x.{link.reference}"), named(y, f"link_force_y.{link.reference}")
    cos, sin = _direction(motion, (link.reference_end, link.reference_start), link.reference, link.reference_length)
    return named(force_along(x, cos, y, sin), f"axial_force.{link.reference}")


def pressing(mechanism: Mechanism, motion: Motion, link: RedundantLink, force: Value) -> AppliedLoads:
    """Return the forces with which a link pushes its joints apart."""
    name, loads = link.member.name, NO_LOADS
    cos, sin = _direction(motion, (link.start, link.end), name, link.length)
    for point, ahead in ((link.start, -1), (link.end, 1)):
        x, y = (
            named(ahead * force * component, f"load_{axis}.{name}.{point}")
            for axis, component in (("x", cos), ("y", sin))
        )
        loads = loads.also(force_at(mechanism, motion, point, (x, y)))
    return loads


def _direction(motion: Motion, ends: tuple[str, str], link: str, length: Value) -> tuple[Value, Value]:
    """Return cosine and sine of the direction from one point of a link to another."""
    start, end = (motion.points[point] for point in ends)
    x, y = (
        named(b.position - a.position, f"distance_{axis}.{link}") for axis, a, b in zip("xy", start, end, strict=True)
    )
    if is_traced(x, y):
        length = given(f"link_length.{link}", length, f"links.{link}.length")
    return named(x / length, f"link_cos.{link}.along"), named(y / length, f"link_sin.{link}.along")
