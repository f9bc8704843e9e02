"""Links too many: what they bear is no matter of equilibrium, but stated as a share of what another link bears."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from crankwork.dynamics.dyad_forces import force_along
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.reaction import JointForces
from crankwork.dynamics.running import Running
from crankwork.formula.expression import Value
from crankwork.formula.known import given, is_known, named
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.motion import Motion
from crankwork.loads.applied import NO_LOADS, AppliedLoads, force_at
from crankwork.mechanism.joints import Pin, joints
from crankwork.mechanism.linkage import Member
from crankwork.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class RedundantLink:
    """A link of two joints without which a linkage moves as it does with it; it fits, and only carries.

    Without a share what it bears is not known, and with it no force in any joint.
    """

    member: Member  # As it is drawn
    # The points that it joins, and their distance [m]
    start: str
    end: str
    length: float
    # The force along it over that along another link, both positive where they press [-]
    share: float | None = None
    # That link, the point of it where the force along it counts, its other joint, and their distance [m]
    of: str = ""
    of_end: str = ""
    of_start: str = ""
    of_length: float = 0.0


def with_redundant(running: Running, links: Sequence[RedundantLink]) -> Running:
    """Return a mechanism at work with what its redundant links press at their joints, in numbers.

    All forces are linear in those of the redundant links, so that each of them is solved for from the forces without
    them and those that a unit of each makes.
    """
    if not links:
        return running
    forces = redundant_forces(running, links)
    pressed = [pressing(running.mechanism, running.motion, *one) for one in zip(links, forces, strict=True)]
    loads = running.loads
    for one in pressed:
        loads = loads.also(one)
    return replace(running, loads=loads)


def redundant_forces(running: Running, links: Sequence[RedundantLink]) -> Array:
    """Return the pressing forces of redundant links, shape (links, n). [N]"""
    mechanism, motion, count = running.mechanism, running.motion, len(running.motion.grid)
    without = _along_others(running, links)
    matrix = np.zeros((count, len(links), len(links)))
    for k, link in enumerate(links):
        unit = pressing(mechanism, motion, link, np.ones(count))
        massless = replace(mechanism, bodies=())
        alone = Running(massless, motion, np.zeros(count), unit, np.zeros(count))
        matrix[:, :, k] = -np.stack(_along_others(alone, links), axis=-1)
    shares = np.array([link.share or 0.0 for link in links])
    matrix *= shares[:, None]
    matrix += np.eye(len(links))
    found = np.linalg.solve(matrix, (np.stack(without, axis=-1) * shares)[..., None])
    return np.asarray(found[..., 0].T)


def _along_others(running: Running, links: Sequence[RedundantLink]) -> list[Array]:
    found = joint_forces(running)
    return [np.asarray(force_along_other(running.mechanism, running.motion, found, link)) for link in links]


def force_along_other(mechanism: Mechanism, motion: Motion, found: JointForces, link: RedundantLink) -> Value:
    """Return the force along the link that a redundant one has its share of, positive where it presses. [N]"""
    x: Value = 0.0
    y: Value = 0.0
    for joint in joints(mechanism):
        if isinstance(joint, Pin) and joint.point == link.of_end and link.of in (joint.link, joint.other):
            force = found.pins[joint.name]
            sides = (force.x, force.y) if joint.link == link.of else (-force.x, -force.y)
            x, y = x + sides[0], y + sides[1]
    x, y = named(x, f"link_force_x.{link.of}"), named(y, f"link_force_y.{link.of}")
    cos, sin = _direction(motion, (link.of_end, link.of_start), link.of, link.of_length)
    return named(force_along(x, cos, y, sin), f"axial_force.{link.of}")


def pressing(mechanism: Mechanism, motion: Motion, link: RedundantLink, force: Value) -> AppliedLoads:
    """Return the forces with which a link presses what it joins apart."""
    name, loads = link.member.name, NO_LOADS
    cos, sin = _direction(motion, (link.start, link.end), name, link.length)
    for point, ahead in ((link.start, -1), (link.end, 1)):
        x, y = (named(ahead * force * one, f"load_{axis}.{name}.{point}") for axis, one in (("x", cos), ("y", sin)))
        loads = loads.also(force_at(mechanism, motion, point, (x, y)))
    return loads


def _direction(motion: Motion, ends: tuple[str, str], link: str, length: Value) -> tuple[Value, Value]:
    """Return cosine and sine of the direction from one point of a link to another."""
    start, end = (motion.points[one] for one in ends)
    x, y = (
        named(b.position - a.position, f"distance_{axis}.{link}") for axis, a, b in zip("xy", start, end, strict=True)
    )
    if is_known(x, y):
        length = given(f"link_length.{link}", length, f"links.{link}.length")
    return named(x / length, f"link_cos.{link}.along"), named(y / length, f"link_sin.{link}.along")
