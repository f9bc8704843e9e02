"""Loads of a mechanism, ready for the dynamics: forces at moving points and torques on links."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, NamedTuple

from crankwork.errors import GeometryError
from crankwork.formula.expression import Value
from crankwork.formula.traced_value import named
from crankwork.kinematics.dyads import LinkMotion, point_of_link
from crankwork.kinematics.kinematic_coefficients import PointMotion
from crankwork.kinematics.motion import Motion, broadcast
from crankwork.mechanism.joints import SlidingJoint, joints, links_of_points
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Mechanism

ForceKind = Literal["load", "weight", "inertia"]


class AppliedForce(NamedTuple):
    """A force on a link, where it acts, and its components along the fixed axes, arrays of shape (n,). [m], [N]"""

    link: str
    point: PointMotion
    x: Value
    y: Value
    kind: ForceKind = "load"


class AppliedTorque(NamedTuple):
    """A torque on a link, positive anticlockwise, an array of shape (n,), and the link's rate of turning. [N m], [-]"""

    link: str
    torque: Value
    angle_1: Value
    kind: ForceKind = "load"


@dataclass(frozen=True)
class AppliedLoads:
    """Forces and torques on the links of a mechanism."""

    forces: tuple[AppliedForce, ...] = ()  # Forces, in any order
    torques: tuple[AppliedTorque, ...] = ()

    def also(self, other: AppliedLoads) -> AppliedLoads:
        """Return the sum of two sets of loads."""
        return AppliedLoads(self.forces + other.forces, self.torques + other.torques)


NO_LOADS = AppliedLoads()


def combine_loads(parts: Iterable[AppliedLoads]) -> AppliedLoads:
    """Return several sets of loads as one."""
    parts = list(parts)
    return AppliedLoads(
        tuple(force for part in parts for force in part.forces),
        tuple(torque for part in parts for torque in part.torques),
    )


def check_name(what: str, name: str, known: Iterable[str]) -> None:
    """Raise GeometryError if a point, link or sliding piece does not exist."""
    known = list(known)
    if name not in known:
        raise GeometryError(f"there is no {what} {name} to load; choose from {', '.join(known)}")


def force_at(
    mechanism: Mechanism, motion: Motion, point: str, force: tuple[Value, Value], link: str = ""
) -> AppliedLoads:
    """Return a force at a named point; no load if the point is fixed.

    `link`: the link it acts on; empty for the first of the links that meet there.
    """
    owners = links_of_points(mechanism)
    check_name("point", point, owners)
    link = link or owners[point]
    if link == GROUND:
        return NO_LOADS
    x, y = (broadcast(component, motion.grid) for component in force)
    return AppliedLoads((AppliedForce(link, motion.points[point], x, y),))


def force_between(
    mechanism: Mechanism,
    motion: Motion,
    points: tuple[str, str],
    pull: tuple[Value, Value],
    links: tuple[str, str] = ("", ""),
) -> AppliedLoads:
    """Return a pull on the first of two points towards the second, and its opposite on the second.

    `pull`: components along the fixed axes [N]; `links`: as in `force_at`.
    """
    name = ".".join(points)
    x, y = (named(component, f"load_{axis}.{name}") for axis, component in zip("xy", pull, strict=True))
    back = named(-x, f"load_x.{name}.end"), named(-y, f"load_y.{name}.end")
    return force_at(mechanism, motion, points[0], (x, y), links[0]).also(
        force_at(mechanism, motion, points[1], back, links[1])
    )


def force_along_guide(motion: Motion, slider: str, force: Value, own: str = "") -> AppliedForce:
    """Return a force on a sliding piece, along its guide and through the origin of its frame.

    `force`: positive in the direction of growing distance [N]; `own`: suffix of the key of the force.
    """
    frame = motion.frames[slider]
    x, y = named(force * frame.cos, f"load_x.{slider}{own}"), named(force * frame.sin, f"load_y.{slider}{own}")
    return AppliedForce(slider, frame.origin, x, y)


def force_on_slider(
    mechanism: Mechanism, motion: Motion, slider: str, force: Value, own: str = "", other: str = ""
) -> AppliedLoads:
    """Return a force along its guide on a sliding piece, and its reaction on the link that carries the guide.

    The reaction acts at the point of the carrier where the piece is now; that point moves with the carrier.
    `own`, `other`: suffixes of the keys of the force and of its reaction.
    """
    push = force_along_guide(motion, slider, force, own)
    slides = {joint.link: joint.other for joint in joints(mechanism) if isinstance(joint, SlidingJoint)}
    if mechanism.halves:
        barrel, rod = (half.link for half in mechanism.halves)
        slides[rod] = barrel
    carrier = slides[slider]
    if carrier == GROUND:
        return AppliedLoads((push,))
    x, y = named(-push.x, f"load_x.{carrier}{other or own}"), named(-push.y, f"load_y.{carrier}{other or own}")
    return AppliedLoads((push, AppliedForce(carrier, carried_point(motion.frames[carrier], push.point), x, y)))


def torque_on(motion: Motion, link: str, torque: Value) -> AppliedLoads:
    """Return a torque on a link."""
    check_name("link", link, {**motion.links, **motion.frames})
    frame: LinkMotion | None = motion.frames.get(link)
    rate = motion.links[link].position_1 if frame is None else frame.angle_1
    return AppliedLoads(torques=(AppliedTorque(link, broadcast(torque, motion.grid), broadcast(rate, motion.grid)),))


def carried_point(link: LinkMotion, point: PointMotion) -> PointMotion:
    """Return the motion of the point of a link that coincides with another point at each angle. [m]"""
    place = point.x.position, point.y.position
    x, y = point_of_link(link, place[0] - link.origin.x.position, place[1] - link.origin.y.position)
    return PointMotion(x._replace(position=place[0]), y._replace(position=place[1]))
