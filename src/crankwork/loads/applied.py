"""What pushes a mechanism, ready for the dynamics: forces at moving points and torques on links."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

from crankwork.errors import GeometryError
from crankwork.formula.expression import Value
from crankwork.formula.known import named
from crankwork.kinematics.bodies import broadcast
from crankwork.kinematics.dyads import LinkMotion, point_of_link
from crankwork.kinematics.motion import Motion
from crankwork.kinematics.transfer import PointMotion
from crankwork.mechanism.joints import SlidingJoint, joints, links_of_points
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Mechanism


class AppliedForce(NamedTuple):
    """A force on a link, where it acts, and its components along the fixed axes, arrays of shape (n,). [m], [N]"""

    link: str
    at: PointMotion
    x: Value
    y: Value


class AppliedTorque(NamedTuple):
    """A torque on a link, positive anticlockwise, an array of shape (n,), and the link's rate of turning. [N m], [-]"""

    link: str
    torque: Value
    angle_1: Value


@dataclass(frozen=True)
class AppliedLoads:
    """Forces and torques on the links of a mechanism."""

    forces: tuple[AppliedForce, ...] = ()  # Forces, in any order
    torques: tuple[AppliedTorque, ...] = ()

    def also(self, other: AppliedLoads) -> AppliedLoads:
        """Return these loads and others together."""
        return AppliedLoads(self.forces + other.forces, self.torques + other.torques)


NO_LOADS = AppliedLoads()


def together(parts: Iterable[AppliedLoads]) -> AppliedLoads:
    """Return all loads as one."""
    parts = list(parts)
    return AppliedLoads(
        tuple(force for part in parts for force in part.forces),
        tuple(torque for part in parts for torque in part.torques),
    )


def check_name(what: str, name: str, known: Iterable[str]) -> None:
    """Refuse the name of a point, link or sliding piece that does not exist."""
    known = list(known)
    if name not in known:
        raise GeometryError(f"there is no {what} {name} to load; choose from {', '.join(known)}")


def force_at(
    mechanism: Mechanism, motion: Motion, point: str, force: tuple[Value, Value], link: str = ""
) -> AppliedLoads:
    """Return a force at a named point; nothing if the point is fixed.

    `link`: the link it acts on; empty for the first one of those that meet there.
    """
    bearer = links_of_points(mechanism)
    check_name("point", point, bearer)
    link = link or bearer[point]
    if link == GROUND:
        return NO_LOADS
    x, y = (broadcast(one, motion.grid) for one in force)
    return AppliedLoads((AppliedForce(link, motion.points[point], x, y),))


def force_between(
    mechanism: Mechanism,
    motion: Motion,
    points: tuple[str, str],
    pull: tuple[Value, Value],
    links: tuple[str, str] = ("", ""),
) -> AppliedLoads:
    """Return a pull on the first of two points towards the second, and its opposite on the second.

    `pull`: components along the fixed axes [N]; `links`: those that the points are of, as `force_at` takes them.
    """
    name = ".".join(points)
    x, y = (named(one, f"load_{axis}.{name}") for axis, one in zip("xy", pull, strict=True))
    back = named(-x, f"load_x.{name}.end"), named(-y, f"load_y.{name}.end")
    return force_at(mechanism, motion, points[0], (x, y), links[0]).also(
        force_at(mechanism, motion, points[1], back, links[1])
    )


def force_along_guide(motion: Motion, slider: str, force: Value, own: str = "") -> AppliedForce:
    """Return a force on a sliding piece, along its guide and through the origin of its frame.

    `force`: positive in the direction in which the distance of the piece counts [N]; `own`: what follows the name of
    the piece in that of the force.
    """
    frame = motion.frames[slider]
    x, y = named(force * frame.cos, f"load_x.{slider}{own}"), named(force * frame.sin, f"load_y.{slider}{own}")
    return AppliedForce(slider, frame.origin, x, y)


def force_on_slider(
    mechanism: Mechanism, motion: Motion, slider: str, force: Value, own: str = "", other: str = ""
) -> AppliedLoads:
    """Return a force along its guide on a sliding piece, and its reaction on the link that carries the guide.

    On a carrier the force acts at the point of it where the piece is: it moves with the carrier, not with the piece.
    `own`, `other`: what follows the name of the piece, and that of the carrier, in the names of the forces.
    """
    push = force_along_guide(motion, slider, force, own)
    slides = {one.link: one.other for one in joints(mechanism) if isinstance(one, SlidingJoint)}
    if mechanism.halves:
        barrel, rod = (one.link for one in mechanism.halves)
        slides[rod] = barrel
    carrier = slides[slider]
    if carrier == GROUND:
        return AppliedLoads((push,))
    x, y = named(-push.x, f"load_x.{carrier}{other or own}"), named(-push.y, f"load_y.{carrier}{other or own}")
    return AppliedLoads((push, AppliedForce(carrier, carried_point(motion.frames[carrier], push.at), x, y)))


def torque_on(motion: Motion, link: str, torque: Value) -> AppliedLoads:
    """Return a torque on a link."""
    check_name("link", link, {**motion.links, **motion.frames})
    rate = broadcast(_rate(motion, link), motion.grid)
    return AppliedLoads(torques=(AppliedTorque(link, broadcast(torque, motion.grid), rate),))


def carried_point(link: LinkMotion, point: PointMotion) -> PointMotion:
    """Return the motion of the point of a link that is, at each angle, where another point passes. [m]

    The place of the one, with the transfer functions of the other.
    """
    place = point.x.position, point.y.position
    x, y = point_of_link(link, place[0] - link.origin.x.position, place[1] - link.origin.y.position)
    return PointMotion(x._replace(position=place[0]), y._replace(position=place[1]))


def _rate(motion: Motion, link: str) -> Value:
    frame: LinkMotion | None = motion.frames.get(link)
    return motion.links[link].position_1 if frame is None else frame.angle_1
