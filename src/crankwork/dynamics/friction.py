"""Friction in pins and guides: the joint forces with it, the power it takes, and where it locks the mechanism."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from crankwork.dynamics.force_system import Equilibrium, all_links_and_joints, cylinder_force, full_equilibrium
from crankwork.dynamics.friction_equations import FrictionEquations, Status, Truth
from crankwork.dynamics.link_loads import OperatingState, Wrenches, arm, cross, link_wrenches
from crankwork.dynamics.reaction import JointForces, collect_reactions
from crankwork.errors import MethodError
from crankwork.formula.expression import Value, formula
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.motion import Motion, broadcast
from crankwork.mechanism.driver import Cylinder
from crankwork.mechanism.joints import Joint, Pin, SlidingJoint
from crankwork.mechanism.linkage import GROUND

Circle = Literal["tangent", "sine"]
# a force below which no direction is known [N]
_TINY = 1e-290
# share of the largest relative speed below which two links count as at rest
_REST = 1e-12
_ZERO_TOLERANCE = 1e-12


@dataclass(frozen=True)
class PinFriction:
    """Friction in a revolute joint."""

    joint: str  # Name of the joint, see `mechanism.joints`
    radius: float  # Radius of the pin [m]
    # Friction moment over joint force and radius, f': from f in a loose bearing to 1.57 f in a tight new one [-]
    coefficient: float
    moment: float = 0.0  # Drag that does not depend on the force [N m]
    damping: float = 0.0  # Drag over the relative angular velocity [N m s]
    # Radius of the friction circle: that of the pin times f, or times the sine of the friction angle
    circle: Circle = "tangent"


@dataclass(frozen=True)
class GuideFriction:
    """Friction of a sliding piece on its guide."""

    slider: str  # The sliding piece
    coefficient: float  # Friction force over normal force, the tangent of the friction angle [-]
    # Length of the piece along the guide. The moment of the normal force about its middle then presses the ends of the
    # piece on both sides; with 0 that moment makes no friction [m]
    length: float = 0.0
    force: float = 0.0  # Drag that does not depend on the normal force [N]
    damping: float = 0.0  # Drag over the sliding velocity [N s/m]
    # Where the middle of the piece is on its guide, from the pin that its forces are taken at: along the guide, and to
    # the left of that [m]
    middle: tuple[float, float] = (0.0, 0.0)

    @property
    def middle_x(self) -> float:
        """Where the middle is along the guide. [m]"""
        return self.middle[0]

    @property
    def middle_y(self) -> float:
        """Where the middle is to the left of the guide. [m]"""
        return self.middle[1]

    @property
    def sides(self) -> tuple[int, ...]:
        """Signs of the tilting force at the ends that are pressed: both, or one where it does not count."""
        return (1, -1) if self.length else (1,)

    def tilting(self, normal: Array, moment: Array) -> Array:
        """Return the difference of the forces that press at both ends. [N]"""
        if not self.length:
            return np.zeros_like(moment)
        return np.asarray(tilting_force(moment, normal, self.middle[0], self.length))


Friction = PinFriction | GuideFriction


@dataclass(frozen=True)
class FrictionForces:
    """Joint forces with friction, and their reliability."""

    joint_forces: JointForces  # Reactions and balancing torque with friction; NaN where `status` is not 0 [N], [N m]
    ideal_torque: Array  # Balancing torque without friction, shape (n,) [N m]
    pressing: Mapping[Friction, Array]  # Force that causes the friction of each joint, shape (n,) [N]
    # Of each joint, the friction moment on the link that a pin holds, or the friction force on a sliding piece along
    # its guide, shape (n,) [N m or N]
    friction: Mapping[Friction, Array]
    power_loss: Array  # Power lost in all joints, shape (n,) [W]
    # Torque without friction over torque with it where the crank drives, the reverse where the load does; zero or less
    # where the load alone could not move the mechanism, shape (n,) [-]
    efficiency: Array
    residual: Array  # Residual of the equilibrium over the forces on a link, shape (n,) [-]
    # 0 converged, 1 not converged, 2 self-locking, 3 no position, shape (n,) [-]
    status: Status
    # Determinant of the equations over that without friction; the forces become unbounded as it tends to zero,
    # shape (n,) [-]
    margin: Array
    has_another: Truth  # Where another equilibrium was found, if one was looked for, shape (n,)

    @property
    def held(self) -> Truth:
        """Where friction alone holds the load: without friction the load would drive the crank."""
        ideal, torque = self.ideal_torque, self.joint_forces.balancing_torque
        rounding = _ZERO_TOLERANCE * np.nanmax(np.abs(np.stack([ideal, torque])), initial=0.0)
        return np.asarray((ideal < -rounding) & (torque >= 0))


@dataclass(frozen=True)
class FrictionJoint:
    """A joint with friction: the relative motion of its links, and the friction on the first one."""

    joint: Joint
    law: Friction
    rate: Array  # Relative rotation or sliding over the coordinate of the driver, shape (n,) [- or m]
    velocity: Array  # Relative angular velocity or velocity, shape (n,) [rad/s] or [m/s]
    sense: Array  # Direction of the friction on the first link: 1, -1, or 0 at rest, shape (n,) [-]

    @property
    def factor(self) -> float:
        """Radius of the friction circle [m], or coefficient of a guide [-]."""
        if isinstance(self.law, GuideFriction):
            return self.law.coefficient
        circle = friction_radius if self.law.circle == "tangent" else friction_radius_of_angle
        return float(circle(self.law.coefficient, self.law.radius))

    def pressing(self, first: Array, second: Array) -> tuple[Array, Array, Array]:
        """Return the pressing force and its derivatives by the two unknowns of the joint.

        The unknowns are the components of the force of a pin, or normal force and moment of a guide.
        """
        if isinstance(self.law, PinFriction):
            force = np.hypot(first, second)
            inverse = np.divide(1.0, force, out=np.zeros_like(force), where=force > _TINY)
            return force, first * inverse, second * inverse
        tilting = self.law.tilting(first, second)
        per_moment = 2 / self.law.length if self.law.length else 0.0
        tilted = np.abs(tilting) > np.abs(first)
        by_moment = np.where(tilted, per_moment * np.sign(tilting), 0.0)
        return (
            np.where(tilted, np.abs(tilting), np.abs(first)),
            np.where(tilted, -self.law.middle[0] * by_moment, np.sign(first)),
            by_moment,
        )

    def friction(self, pressing: Array) -> Array:
        """Return the friction on the first link, its moment or its force along the guide. [N m] or [N]"""
        if isinstance(self.law, PinFriction):
            constant, damping = self.law.moment, self.law.damping
            return np.asarray(friction_torque(self.sense, self.factor, pressing, constant, damping, self.velocity))
        constant, damping = self.law.force, self.law.damping
        return np.asarray(friction_force(self.sense, self.factor, pressing, constant, damping, self.velocity))

    def unit_effect(self, motion: Motion, system: Equilibrium) -> Array:
        """Return the effect of a unit of friction on all links, shape (n, 3 links)."""
        frame, effect = motion.frames[self.joint.link], np.zeros((len(motion.grid), 3 * len(system.links)))
        for link, sign in ((self.joint.link, 1.0), (self.joint.other, -1.0)):
            if link == GROUND:
                continue
            row = 3 * system.links.index(link)
            if isinstance(self.law, PinFriction):
                effect[:, row + 2] = sign
            else:
                along = frame.cos, frame.sin
                effect[:, row], effect[:, row + 1] = sign * along[0], sign * along[1]
                lever = cross(arm(motion.frames[link].origin, frame.origin), along)
                effect[:, row + 2] = sign * (lever - self.law.middle[1])
        return effect


def friction_joints(
    running: OperatingState, friction: Sequence[Friction], senses: Mapping[Friction, Array] | None = None
) -> tuple[FrictionJoint, ...]:
    """Return the joints with friction of a mechanism in operation.

    `senses`: direction of each friction; by default against the relative motion, none at rest.
    """
    held, motion, result = all_links_and_joints(running.mechanism)[1], running.motion, dict[Joint, FrictionJoint]()
    for law in friction:
        kind, name = (Pin, law.joint) if isinstance(law, PinFriction) else (SlidingJoint, law.slider)
        joint = next((joint for joint in held if isinstance(joint, kind) and joint.name == name), None)
        if joint is None:
            names = ", ".join(joint.name for joint in held if isinstance(joint, kind))
            raise MethodError(f"there is no joint {name} to rub; choose from {names}")
        if joint in result:
            raise MethodError(f"joint {name} has two frictions; give one")
        rate = np.asarray(broadcast(relative_rate(motion, joint), motion.grid))
        velocity = np.asarray(rate * running.speed)
        moves = np.abs(velocity) > _REST * np.nanmax(np.abs(velocity), initial=0.0)
        sense = np.where(moves, -np.sign(velocity), 0.0) if senses is None else senses[law]
        result[joint] = FrictionJoint(joint, law, rate, velocity, sense)
    return tuple(result.values())


def relative_rate(motion: Motion, joint: Joint) -> Value:
    """Return the rate of rotation or sliding in a joint, over the rate of the driver's coordinate."""
    if isinstance(joint, SlidingJoint):
        # the rod of a cylinder slides by the change of its length
        return motion.sliders[joint.link].position_1 if joint.link in motion.sliders else 1.0
    own = motion.frames[joint.link].angle_1
    return own if joint.other == GROUND else own - motion.frames[joint.other].angle_1


def friction_forces(running: OperatingState, friction: Sequence[Friction]) -> FrictionForces:
    """Return the joint forces of a mechanism with friction in some joints (artobolevsky_1988, ch. 11 and 13-14).

    Forces, torque, losses, efficiency, residual and status at each crank angle. `running`: the mechanism at work; the
    crank turns forward unless its speed is negative.

    Friction in a pin is a moment rho |R| against the relative rotation; on a guide a force f |N| against the
    sliding, with 2 |M| / length in place of |N| where the moment M of the guide is so large that the piece
    presses with opposite sides. Drags add what does not depend on these forces. Newton's method solves the
    equilibrium; the friction grows from zero to its value in steps. As long as the determinant of the equations keeps
    its sign there is one solution. Where it changes it, the torque has grown beyond all bounds before, or there is none
    that turns the crank: self-locking.
    """
    return solve_with_friction(running, friction_joints(running, friction))


def solve_with_friction(
    running: OperatingState, joints: Sequence[FrictionJoint], *, thorough: bool = False
) -> FrictionForces:
    """Return the joint forces with friction for given relative motions in the joints.

    `thorough`: look for a second solution.
    """
    system, wrenches = full_equilibrium(running), link_wrenches(running)
    right = system.right_side(wrenches)
    equations = FrictionEquations(running, system, right, joints)
    ideal = equations.without_friction(right)
    unknowns, residual, status = equations.solve(ideal)
    pressing = equations.pressing(unknowns)
    values = {joint.law: joint.friction(pressing[joint.law]) for joint in joints}
    power = sum((-values[joint.law] * joint.velocity for joint in joints), np.zeros_like(residual))
    torque, without = (_driven(running, system, solution, wrenches) for solution in (unknowns, ideal))
    return FrictionForces(
        collect_reactions(system.reactions(unknowns), system.joints, torque),
        without,
        pressing,
        values,
        power,
        _efficiency(without, torque),
        residual,
        status,
        equations.margin(unknowns),
        equations.has_another(unknowns) if thorough else np.zeros_like(status, dtype=bool),
    )


def _driven(running: OperatingState, system: Equilibrium, unknowns: Array, wrenches: Wrenches) -> Array:
    """Return the torque or force of the driver."""
    mechanism = running.mechanism
    if not isinstance(mechanism.driver, Cylinder) or mechanism.halves:
        return np.asarray(unknowns[..., -1])
    return np.asarray(cylinder_force(mechanism, running.motion, system.reactions(unknowns), wrenches))


def _efficiency(ideal: Array, actual: Array) -> Array:
    """Return the efficiency, of the crank as driver or of the load; NaN where no torque is needed."""
    forward, backward = (ideal > 0) & (actual != 0), ideal < 0
    output = np.where(forward, ideal, np.where(backward, actual, np.nan))
    supplied = np.where(forward, actual, np.where(backward, ideal, 1.0))
    return np.asarray(instantaneous_efficiency(output, supplied))


@formula("friction_radius", "artobolevsky_1988, ch. 11")
def friction_radius(f_pin: Value, r_z: Value) -> Value:
    """Radius of the friction circle of a pin."""
    return f_pin * r_z


@formula("friction_radius", "artobolevsky_1988, ch. 11")
def friction_radius_of_angle(f_pin: Value, r_z: Value) -> Value:
    """Radius of the friction circle of a pin by the friction angle, whose sine it takes."""
    return f_pin * r_z / np.sqrt(1 + f_pin**2)


@formula("friction_torque", "artobolevsky_1988, ch. 11")
def friction_torque(sigma_f: Value, rho: Value, R_f: Value, M_c0: Value, d_t: Value, w_r: Value) -> Value:
    """Friction moment in a pin: by the force in it, a constant drag, and one with the speed."""
    return sigma_f * (rho * R_f + M_c0) - d_t * w_r


@formula("friction_force", "artobolevsky_1988, ch. 11")
def friction_force(sigma_f: Value, f: Value, N_p: Value, F_c0: Value, d: Value, v_s: Value) -> Value:
    """Friction force of a guide: by the force that presses, a constant drag, and one with the speed."""
    return sigma_f * (f * N_p + F_c0) - d * v_s


@formula("tilting_force", "artobolevsky_1988, ch. 11")
def tilting_force(M_n: Value, N_f: Value, x_p: Value, l_p: Value) -> Value:
    """Difference of the forces that press at both ends of a piece, by the moment of its guide about its middle."""
    return 2 * (M_n - N_f * x_p) / l_p


@formula("friction_couple", "artobolevsky_1988, ch. 11")
def friction_couple(F_fr: Value, y_p: Value) -> Value:
    """Moment of the friction of a guide about a pin that is not on the line of the guide."""
    return -F_fr * y_p


@formula("pressing_force", "artobolevsky_1988, ch. 11")
def pressing_force(N_f: Value, N_t: Value) -> Value:
    """Sum of the forces that press at both ends of a piece, whichever sides of the guide they press."""
    return (np.sqrt((N_f + N_t) ** 2) + np.sqrt((N_f - N_t) ** 2)) / 2


@formula("friction_power", "artobolevsky_1988, ch. 14")
def friction_power_of_pin(M_fr: Value, w_r: Value) -> Value:
    """Power that the friction of a pin takes."""
    return -M_fr * w_r


@formula("friction_power", "artobolevsky_1988, ch. 14")
def friction_power_of_guide(F_fr: Value, v_s: Value) -> Value:
    """Power that the friction of a guide takes."""
    return -F_fr * v_s


@formula("instantaneous_efficiency", "artobolevsky_1988, ch. 14")
def instantaneous_efficiency(M_0: Value, M_f: Value) -> Value:
    """Efficiency of a mechanism that the crank drives."""
    return M_0 / M_f
