"""Friction in pins and guides: the joint forces with it, the power it takes, and where it locks the mechanism."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from crankwork.dynamics.force_system import Equilibrium, solve_positions, whole_system
from crankwork.dynamics.link_loads import arm, cross, link_wrenches
from crankwork.dynamics.reaction import JointForces, gathered
from crankwork.dynamics.running import Running
from crankwork.errors import MethodError
from crankwork.formula.expression import Value, formula
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import Motion
from crankwork.mechanism.joints import Joint, Pin, SlidingJoint
from crankwork.mechanism.linkage import GROUND

Status = NDArray[np.int8]

CONVERGED, NOT_CONVERGED, SELF_LOCKING, NO_POSITION = 0, 1, 2, 3
MEANING = {
    CONVERGED: "the forces balance",
    NOT_CONVERGED: "the iteration did not converge; the forces are not to be relied on",
    NO_POSITION: "the mechanism does not get here",
    SELF_LOCKING: "self-locking, no torque turns the crank; reduce the friction or move the links out of line",
}

_TOLERANCE = 1e-13
_ITERATIONS = 30
# friction grows to its full value in steps, so that the solution is followed from that without friction
_STEPS = (0.25, 0.5, 0.75, 1.0)
# share of the largest relative speed below which two links count as at rest
_REST = 1e-12


@dataclass(frozen=True)
class FrictionForces:
    """Joint forces with friction, and how far they are to be relied on."""

    joint_forces: JointForces  # Reactions and balancing torque with friction; NaN where `status` is not 0 [N], [N m]
    ideal_torque: Array  # Balancing torque without friction, shape (n,) [N m]
    # By joint, the friction moment on the link that a pin holds, or the friction force on a sliding piece along its
    # guide, shape (n,) [N m or N]
    friction: Mapping[str, Array]
    power_loss: Array  # Power that all joints take, shape (n,) [W]
    # Torque without friction over torque with it where the crank drives, the reverse where the load does; zero or less
    # where the load alone could not move the mechanism, shape (n,) [-]
    efficiency: Array
    residual: Array  # By what share of the forces on a link the equilibrium is missed, shape (n,) [-]
    # 0 converged, 1 not converged, 2 self-locking, 3 no position; `MEANING` says it in words, shape (n,) [-]
    status: Status
    iterations: int  # Steps of the iteration

    @property
    def held(self) -> NDArray[np.bool_]:
        """Where friction alone holds the load: without it the load would drive the crank, with it it does not."""
        return np.asarray((self.ideal_torque < 0) & (self.joint_forces.balancing_torque >= 0))

    def messages(self, grid: CrankGrid) -> list[str]:
        """Return a sentence for each run of crank angles where something is wrong, or friction holds the load."""
        runs = [(self.status == code, text) for code, text in MEANING.items() if code != CONVERGED]
        runs.append((self.held, "friction holds the load, which cannot drive the crank (self-locking in reverse)"))
        return [f"{where}: {text}" for wrong, text in runs for where in _ranges(wrong, grid)]


@dataclass(frozen=True)
class _Rubbing:
    """The friction of one joint in the equations of equilibrium."""

    joint: Joint
    # what a unit of pressing force does to the links, shape (n, 3 links), already against the motion
    effect: Array
    # place of the first of the two unknowns of the joint
    column: int
    # share of its length that turns a moment into pressing force: 2 / length
    per_moment: float
    # relative speed over that of the crank, signed
    rate: Array
    # coefficient, or radius of the friction circle
    factor: float

    def pressing(self, unknowns: Array) -> tuple[Array, Array, Array]:
        """Return the pressing force and its derivatives by the two unknowns of the joint."""
        one, two = unknowns[:, self.column], unknowns[:, self.column + 1]
        if isinstance(self.joint, Pin):
            force = np.hypot(one, two)
            inverse = np.divide(1.0, force, out=np.zeros_like(force), where=force > 0)
            return force, one * inverse, two * inverse
        by_moment = self.per_moment * np.abs(two)
        tilted = by_moment > np.abs(one)
        return (
            np.where(tilted, by_moment, np.abs(one)),
            np.where(tilted, 0.0, np.sign(one)),
            np.where(tilted, self.per_moment * np.sign(two), 0.0),
        )


def friction_forces(running: Running, friction: Sequence[Friction]) -> FrictionForces:
    """Return the joint forces of a mechanism with dry friction in some joints (artobolevsky_1988, ch. 11 and 13-14).

    Forces, torque, losses, efficiency, residual and status at each crank angle. `running`: the mechanism at work; the
    crank turns forward unless its speed is negative.

    Friction in a pin is a moment rho |R| against the relative rotation; on a guide a force f |N| against the
    sliding, with 2 |M| / length in place of |N| where the moment M of the guide is so large that the piece
    presses with opposite sides. Newton's method solves the equilibrium; the friction grows from zero to its value
    in steps. As long as the determinant of the equations keeps its sign there is one solution. Where it changes
    it, the torque has grown beyond all bounds before, or there is none that turns the crank: self-locking.
    """
    system, wrenches = whole_system(running), link_wrenches(running)
    right = system.right_side(wrenches)
    rubbing = _rubbing(running, system, friction)
    ideal = solve_positions(system.matrix, right)
    unknowns, residual, status, iterations = _solved(system.matrix, right, rubbing, ideal)
    forces = gathered(system.reactions(unknowns), system.joints, unknowns[:, -1])
    values, power = {}, np.zeros_like(residual)
    for one in rubbing:
        pressing, _, _ = one.pressing(unknowns)
        law = friction_torque if isinstance(one.joint, Pin) else friction_force
        values[one.joint.name] = -np.sign(one.rate) * law(one.factor, pressing)
        power += np.abs(running.speed * one.rate) * law(one.factor, pressing)
    efficiency = _efficiency(ideal[:, -1], unknowns[:, -1])
    return FrictionForces(forces, ideal[:, -1], values, power, efficiency, residual, status, iterations)


def _solved(matrix: Array, right: Array, rubbing: Sequence[_Rubbing], start: Array) -> tuple[Array, Array, Status, int]:
    """Return the unknowns with friction, the residual, the status and the number of steps."""
    unknowns, count = start.copy(), 0
    status = np.where(np.isfinite(start).all(axis=1), CONVERGED, NO_POSITION).astype(np.int8)
    sign, turned = _orientation(matrix), np.zeros(len(right), dtype=bool)
    miss = _miss(matrix, right, rubbing, unknowns, 0.0)
    for share in _STEPS:
        miss = _miss(matrix, right, rubbing, unknowns, share)
        for _ in range(_ITERATIONS):
            active = (status == CONVERGED) & ~(miss[1] < _TOLERANCE) & np.isfinite(miss[1])
            if not active.any():
                break
            unknowns[active] -= solve_positions(miss[2][active], miss[0][active])
            count += 1
            miss = _miss(matrix, right, rubbing, unknowns, share)
            turned |= active & (_orientation(miss[2]) != sign)
        open_yet, settled = status == CONVERGED, miss[1] < _TOLERANCE
        lost = np.where(settled, _orientation(miss[2]) != sign, turned)
        status[open_yet & lost] = SELF_LOCKING
        status[open_yet & ~lost & ~settled] = NOT_CONVERGED
    unknowns[status != CONVERGED] = np.nan
    return unknowns, miss[1], status, count


def _orientation(matrix: Array) -> Array:
    """Return the sign of the determinant of each system, 0 where it is not known."""
    return np.asarray(np.linalg.slogdet(np.nan_to_num(matrix))[0])


def _miss(
    matrix: Array, right: Array, rubbing: Sequence[_Rubbing], unknowns: Array, share: float
) -> tuple[Array, Array, Array]:
    """Return by how much the equilibrium is missed, that as a share of the forces, and its derivative."""
    missing = (matrix @ unknowns[..., None])[..., 0] - right
    size = (np.abs(matrix) @ np.abs(unknowns)[..., None])[..., 0] + np.abs(right)
    derivative = matrix.copy()
    for one in rubbing:
        pressing, by_one, by_two = one.pressing(unknowns)
        missing += share * one.effect * pressing[:, None]
        size += np.abs(one.effect) * pressing[:, None]
        derivative[:, :, one.column] += share * one.effect * by_one[:, None]
        derivative[:, :, one.column + 1] += share * one.effect * by_two[:, None]
    ratio = np.divide(np.abs(missing), size, out=np.zeros_like(size), where=size != 0)
    return missing, ratio.max(axis=1), derivative


def _rubbing(running: Running, system: Equilibrium, friction: Sequence[Friction]) -> list[_Rubbing]:
    """Return the friction of the joints as parts of the equations."""
    found: dict[Joint, _Rubbing] = {}
    for one in friction:
        kind, name = (Pin, one.joint) if isinstance(one, PinFriction) else (SlidingJoint, one.slider)
        names = [joint.name for joint in system.joints if isinstance(joint, kind)]
        if name not in names:
            raise MethodError(f"there is no joint {name} to rub; choose from {', '.join(names)}")
        joint = next(joint for joint in system.joints if isinstance(joint, kind) and joint.name == name)
        if joint in found:
            raise MethodError(f"joint {name} has two frictions; give one")
        found[joint] = _rubbing_joint(running, system, joint, one)
    return list(found.values())


def _rubbing_joint(running: Running, system: Equilibrium, joint: Joint, friction: Friction) -> _Rubbing:
    """Return the friction of one joint: its effect on the two links, against their relative motion."""
    motion = running.motion
    rate = _relative_rate(motion, joint) * np.where(np.asarray(running.speed) < 0, -1.0, 1.0)
    against = -np.where(np.abs(rate) > _REST * np.nanmax(np.abs(rate)), np.sign(rate), 0.0)
    factor = (
        friction_radius(friction.coefficient, friction.radius)
        if isinstance(friction, PinFriction)
        else friction.coefficient
    )
    frame, effect = motion.frames[joint.link], np.zeros((len(motion.grid), 3 * len(system.links)))
    for link, sign in ((joint.link, factor), (joint.other, -factor)):
        if link == GROUND:
            continue
        row = 3 * system.links.index(link)
        if isinstance(joint, Pin):
            effect[:, row + 2] = sign * against
        else:
            along = frame.cos, frame.sin
            effect[:, row], effect[:, row + 1] = sign * against * along[0], sign * against * along[1]
            effect[:, row + 2] = sign * against * cross(arm(motion.frames[link].origin, frame.origin), along)
    length = friction.length if isinstance(friction, GuideFriction) else 0.0
    per_moment = 2 / length if length else 0.0
    return _Rubbing(joint, effect, 2 * system.joints.index(joint), per_moment, rate, factor)


def _relative_rate(motion: Motion, joint: Joint) -> Array:
    """Return how fast one link turns or slides in the other, over the speed of the crank."""
    still = np.zeros_like(motion.grid.angle)
    if isinstance(joint, SlidingJoint):
        return np.asarray(motion.sliders[joint.link].position_1 + still)
    other = 0.0 if joint.other == GROUND else motion.frames[joint.other].angle_1
    return np.asarray(motion.frames[joint.link].angle_1 - other + still)


def _efficiency(ideal: Array, actual: Array) -> Array:
    """Return the efficiency, of the crank as driver or of the load; NaN where no torque is needed."""
    forward, backward = ideal > 0, ideal < 0
    one = np.where(forward, ideal, np.where(backward, actual, np.nan))
    other = np.where(forward, actual, np.where(backward, ideal, 1.0))
    return np.asarray(instantaneous_efficiency(one, other))


def _ranges(wrong: NDArray[np.bool_], grid: CrankGrid) -> list[str]:
    """Return the runs of crank angles in words."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], wrong, [False]]).astype(int)))
    degrees = grid.degrees
    return [
        f"at {degrees[first]:g} deg" if after - first == 1 else f"from {degrees[first]:g} to {degrees[after - 1]:g} deg"
        for first, after in zip(edges[::2], edges[1::2], strict=True)
    ]


@dataclass(frozen=True)
class PinFriction:
    """Friction in a revolute joint."""

    joint: str  # Name of the joint, see `mechanism.joints`
    radius: float  # Radius of the pin [m]
    # Friction moment over joint force and radius, f': from f in a loose bearing to 1.57 f in a tight new one [-]
    coefficient: float


@dataclass(frozen=True)
class GuideFriction:
    """Friction of a sliding piece on its guide."""

    slider: str  # The sliding piece
    coefficient: float  # Friction force over normal force, the tangent of the friction angle [-]
    # Length of the piece along the guide, its origin in the middle. The moment of the normal force then presses the
    # ends of the piece on both sides; with 0 that moment makes no friction [m]
    length: float = 0.0


Friction = PinFriction | GuideFriction


@formula("friction_radius", "artobolevsky_1988, ch. 11")
def friction_radius(f_z: Value, r_z: Value) -> Value:
    """Radius of the friction circle of a pin."""
    return f_z * r_z


@formula("friction_torque", "artobolevsky_1988, ch. 11")
def friction_torque(rho: Value, R: Value) -> Value:
    """Friction moment in a pin."""
    return rho * R


@formula("friction_force", "artobolevsky_1988, ch. 11")
def friction_force(f: Value, N_s: Value) -> Value:
    """Friction force of a guide."""
    return f * N_s


@formula("efficiency", "artobolevsky_1988, ch. 14")
def instantaneous_efficiency(M_0: Value, M_f: Value) -> Value:
    """Instantaneous efficiency of a mechanism that the crank drives."""
    return M_0 / M_f
