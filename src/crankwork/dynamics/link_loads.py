"""A mechanism in operation, and wrenches on each link without its joints: loads, and inertia after D'Alembert."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import absent, is_traced, named
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.dyads import is_zero
from crankwork.kinematics.kinematic_coefficients import PointMotion
from crankwork.kinematics.motion import Motion, body_motions, sum_columns, zero_column
from crankwork.loads.applied_loads import NO_LOADS, AppliedForce, AppliedLoads, AppliedTorque
from crankwork.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class OperatingState:
    """A mechanism in operation: links, motion, speed and loads."""

    mechanism: Mechanism  # Links, joints and bodies
    motion: Motion
    speed: Value = 0.0  # Angular speed of the crank, shape (n,) [rad/s]
    loads: AppliedLoads = NO_LOADS  # Forces and torques
    angular_acceleration: Value = 0.0  # Angular acceleration of the crank, shape (n,) [rad/s2]


class Wrench(NamedTuple):
    """Force [N] and moment about the origin of a frame [N m], arrays of shape (n,) or traced values."""

    x: Value
    y: Value
    moment: Value


class Wrenches:
    """Collects the wrenches on each link, which are added on access."""

    def __init__(self, motion: Motion) -> None:
        self._grid = motion.grid
        self._parts: dict[str, list[Wrench]] = {link: [] for link in motion.frames}

    def add(self, link: str, wrench: Wrench) -> None:
        """Add a force and its moment about the origin of a link."""
        self._parts[link].append(wrench)

    def __getitem__(self, link: str) -> Wrench:
        """Return the sum of the wrenches on a link so far."""
        sides = zip(*self._parts[link], strict=True) if self._parts[link] else ((), (), ())
        keys = (f"{key}.{link}" for key in ("link_force_x", "link_force_y", "link_moment"))
        return Wrench(*(sum_columns(key, side, self._grid) for key, side in zip(keys, sides, strict=True)))


@formula("link_moment", "artobolevsky_1988, ch. 13")
def moment_about(r_x: Value, F_y: Value, r_y: Value, F_x: Value) -> Value:
    """Moment of a force."""
    return r_x * F_y - r_y * F_x


@formula("link_inertia_force", "artobolevsky_1988, ch. 12")
def link_inertia_force(m_i: Value, a_S: Value) -> Value:
    """Inertia force of a body along one axis."""
    return -m_i * a_S


@formula("link_inertia_torque", "artobolevsky_1988, ch. 12")
def link_inertia_torque(J_S: Value, eps_i: Value) -> Value:
    """Inertia torque of a body."""
    return -J_S * eps_i


@formula("centre_acceleration", "artobolevsky_1988, ch. 5")
def centre_acceleration(q_2: Value, w: Value, q_1: Value, eps: Value) -> Value:
    """Acceleration of a centre of mass along one axis."""
    return q_2 * w**2 + q_1 * eps


@formula("link_angular_acceleration", "artobolevsky_1988, ch. 5")
def link_angular_acceleration(theta_2: Value, w: Value, theta_1: Value, eps: Value) -> Value:
    """Angular acceleration of a link."""
    return theta_2 * w**2 + theta_1 * eps


def inertia_loads(running: OperatingState) -> AppliedLoads:
    """Return -m a at each centre of mass [N] and -J eps on each link [N m] (artobolevsky_1988, ch. 12)."""
    w, eps = running.speed, running.angular_acceleration
    forces, torques = [], []
    bodies = body_motions(running.mechanism, running.motion)
    names = distinct(moving.body.link for moving in bodies)
    for name, (body, centre, angle_1, angle_2) in zip(names, bodies, strict=True):
        if not is_zero(body.mass):
            x, y = (
                _inertia_force(body.mass, centre_acceleration(q_2, w, q_1, eps), f"{name}.{axis}")
                for axis, (_, q_1, q_2) in zip("xy", centre, strict=True)
            )
            forces.append(AppliedForce(body.link, centre, x, y, "inertia"))
        if not is_zero(body.inertia):
            turning = link_angular_acceleration(angle_2, w, angle_1, eps)
            turning = named(turning, f"link_angular_acceleration.{name}")
            torque = named(link_inertia_torque(body.inertia, turning), f"link_inertia_torque.{name}")
            torques.append(AppliedTorque(body.link, torque, angle_1, "inertia"))
    return AppliedLoads(tuple(forces), tuple(torques))


def _inertia_force(mass: Value, acceleration: Value, name: str) -> Value:
    acceleration = named(acceleration, f"centre_acceleration.{name}")
    return named(link_inertia_force(mass, acceleration), f"link_inertia_force.{name}")


def distinct(names: Iterable[str]) -> list[str]:
    """Return names, numbered from the second occurrence of each."""
    seen: Counter[str] = Counter()
    result = []
    for name in names:
        seen[name] += 1
        result.append(name if seen[name] == 1 else f"{name}.{seen[name]}")
    return result


def link_wrenches(running: OperatingState) -> Wrenches:
    """Return the wrenches of loads and inertia on each moving link.

    Force [N] and moment about the origin of the frame of each link [N m].
    """
    motion, loads = running.motion, running.loads.also(inertia_loads(running))
    wrenches, still = Wrenches(motion), zero_column(motion.grid)
    names = distinct(f"{force.link}.load" for force in loads.forces)
    for name, force in zip(names, loads.forces, strict=True):
        moment = moment_of(arm(motion.frames[force.link].origin, force.point), (force.x, force.y), name)
        wrenches.add(force.link, Wrench(force.x, force.y, moment))
    for torque in loads.torques:
        wrenches.add(torque.link, Wrench(still, still, torque.torque))
    return wrenches


def arm(origin: PointMotion, point: PointMotion) -> tuple[Value, Value]:
    """Return the vector from one point to another. [m]"""
    ends, starts = (point.x.position, point.y.position), (origin.x.position, origin.y.position)
    if all(is_traced(end, start) and end.node is start.node for end, start in zip(ends, starts, strict=True)):
        return absent("arm_x"), absent("arm_y")
    return ends[0] - starts[0], ends[1] - starts[1]


def moment_of(lever: tuple[Value, Value], force: tuple[Value, Value], name: str = "") -> Value:
    """Return the moment of a force with an arm; absent where it has none."""
    if all(is_traced(component) and component.is_absent for component in lever):
        return absent("link_moment")
    return named(moment_about(lever[0], force[1], lever[1], force[0]), f"link_moment.{name}")


def cross(a: tuple[Array, Array], b: tuple[Array, Array]) -> Array:
    """Return the cross product of two plane vectors, the moment of a force `b` with the arm `a`."""
    return a[0] * b[1] - a[1] * b[0]
