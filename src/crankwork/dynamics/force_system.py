"""Joint forces of several links, or of a full mechanism, by one linear system."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from crankwork.dynamics.dyad_forces import force_along
from crankwork.dynamics.link_loads import OperatingState, Wrench, Wrenches, arm
from crankwork.dynamics.reaction import GuideForce, JointForces, PinForce, Reaction, collect_reactions, joint_place
from crankwork.formula.expression import Value
from crankwork.formula.traced_value import Component, Root, TracedValue, is_traced, sum_terms, total
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.loop_closure import solve_positions
from crankwork.kinematics.motion import Motion, body_motions
from crankwork.loads.applied_loads import AppliedForce, AppliedLoads, AppliedTorque
from crankwork.mechanism.driver import Cylinder, DrivingSlider, GearedCrank, LinkMotor
from crankwork.mechanism.joints import Joint, Pin, SlidingJoint, group_links, joints, origin_of
from crankwork.mechanism.mechanism import Crank, Driver, Mechanism

Acting = Wrenches | Mapping[str, Wrench]


@dataclass(frozen=True)
class Equilibrium:
    """The equations of some links, three each, with two unknowns for each joint."""

    links: tuple[str, ...]  # The links, in order
    joints: tuple[Joint, ...]  # The joints of the links, in order
    # Force and moment on each link of a unit of each unknown; moments about the origins of the frames, shape (n, 3
    # links, unknowns) [- or m]
    matrix: Array

    def right_side(self, wrenches: Acting) -> Array:
        """Return minus the wrenches on the links, shape (n, 3 links). [N], [N m]"""
        return -np.stack([part for link in self.links for part in wrenches[link]], axis=-1)

    def reactions(self, unknowns: Array) -> dict[Joint, Reaction]:
        """Return the reactions by joint, from the unknowns of shape (n, unknowns). [N], [N m]"""
        return {
            joint: (PinForce(joint, *pair) if isinstance(joint, Pin) else GuideForce(joint, *pair))
            for k, joint in enumerate(self.joints)
            for pair in [(unknowns[..., 2 * k], unknowns[..., 2 * k + 1])]
        }


def equilibrium(
    motion: Motion, links: Sequence[str], held: Sequence[Joint], *, driver: Driver | None = None
) -> Equilibrium:
    """Return the equations of equilibrium of some links.

    `driver`: adds the last unknown, its torque or force; that of a cylinder is part of the forces at its ends.
    """
    pushed, meshes = _pushed(driver, motion), len(driver.geared) if isinstance(driver, Crank) else 0
    matrix = np.zeros((len(motion.grid), 3 * len(links), 2 * len(held) + meshes + bool(pushed)))
    for row, column, value in _entries(motion, links, held, pushed, matrix.shape[-1] - 1):
        matrix[:, row, column] = value
    if isinstance(driver, Crank):
        _mesh(matrix[:, :, 2 * len(held) :], driver, {link: 3 * k for k, link in enumerate(links)})
    return Equilibrium(tuple(links), tuple(held), matrix)


def _entries(
    motion: Motion, links: Sequence[str], held: Sequence[Joint], pushed: Sequence[tuple[str, int, Value]], last: int
) -> Iterator[tuple[int, int, Value]]:
    """Yield what a unit of each unknown does to links, `last` that of the driver: row, column and value."""
    row = {link: 3 * k for k, link in enumerate(links)}
    for k, joint in enumerate(held):
        place, frame = joint_place(joint, motion), motion.frames[joint.link]
        units = ((1.0, 0.0), (0.0, 1.0)) if isinstance(joint, Pin) else ((-frame.sin, frame.cos),)
        for link, sign in ((joint.link, 1), (joint.other, -1)):
            if link not in row:
                continue
            i, (x, y) = row[link], arm(motion.frames[link].origin, place)
            for j, unit in enumerate(units, start=2 * k):
                parts = (unit[0], unit[1], x * unit[1] - y * unit[0])
                yield from ((i + offset, j, part if sign == 1 else -part) for offset, part in enumerate(parts))
            if not isinstance(joint, Pin):
                yield i + 2, 2 * k + 1, float(sign)
    yield from ((row[link] + which, last, value) for link, which, value in pushed)


def _mesh(matrix: Array, driver: Crank, row: Mapping[str, int]) -> None:
    """Set the effects of gears on the crank and the geared cranks: a torque, or a force between teeth."""
    for k, geared in enumerate(driver.geared):
        if geared.pressure_angle is None:
            matrix[:, row[geared.link] + 2, k] = 1.0
            matrix[:, row[driver.link] + 2, k] = -geared.ratio
            continue
        # a unit force where both wheels have the same velocity
        (x, y), reach = _between(driver, geared), geared.ratio / (geared.ratio - 1)
        length = math.hypot(x, y)
        for link, sign, lever in ((geared.link, 1.0, (reach - 1) * length), (driver.link, -1.0, reach * length)):
            matrix[:, row[link], k], matrix[:, row[link] + 1, k] = -sign * y / length, sign * x / length
            matrix[:, row[link] + 2, k] = sign * lever


def _between(crank: Crank, geared: GearedCrank) -> tuple[float, float]:
    """Return the vector from the axis of a crank to that of a geared one. [m]"""
    return geared.pivot[0] - crank.pivot[0], geared.pivot[1] - crank.pivot[1]


def _separated(wrenches: dict[str, Wrench], crank: Crank, forces: Array) -> dict[str, Wrench]:
    """Return the wrenches on the links with the forces that separate wheels, through their axes.

    `forces`: between teeth across the lines of centres, shape (n, geared cranks) [N].
    """
    result = dict(wrenches)
    for k, geared in enumerate(crank.geared):
        if geared.pressure_angle:
            x, y = _between(crank, geared)
            size = np.abs(forces[..., k]) * math.tan(geared.pressure_angle) / math.hypot(x, y)
            size = size if geared.ratio < 0 else -size
            for link, sign in ((geared.link, 1.0), (crank.link, -1.0)):
                own = result[link]
                result[link] = Wrench(own.x + sign * size * x, own.y + sign * size * y, own.moment)
    return result


def _pushed(driver: Driver | None, motion: Motion) -> list[tuple[str, int, Value]]:
    """Return the effect of a unit torque or force of a driver: link, row (x, y or moment) and value."""
    match driver:
        case Crank(link=link, direction=direction):
            return [(link, 2, float(direction))]
        case DrivingSlider(link=link):
            return [(link, 0, motion.frames[link].cos), (link, 1, motion.frames[link].sin)]
        case LinkMotor(links=(first, second)):
            return [(first, 2, -1.0), (second, 2, 1.0)]
        case Cylinder(halves=(barrel, rod)):
            frame = motion.frames[barrel.link]
            back = [(barrel.link, 0, -frame.cos), (barrel.link, 1, -frame.sin)]
            return [*back, (rod.link, 0, frame.cos), (rod.link, 1, frame.sin)]
    return []


def solved_group(
    motion: Motion, links: Sequence[str], held: Sequence[Joint], wrenches: Acting, motor: LinkMotor | None = None
) -> tuple[dict[Joint, Reaction], Value]:
    """Return the reactions in the joints of links, and the last unknown: the torque of a motor that connects them.

    Source: artobolevsky_1988, ch. 13.
    """
    if is_traced(motion.grid.angle):
        return _traced_group(motion, links, held, wrenches, motor)
    system = equilibrium(motion, links, held, driver=motor)
    unknowns = solve_positions(system.matrix, system.right_side(wrenches))
    return system.reactions(unknowns), unknowns[..., -1]


class GroupSolver:
    """Solves the equilibrium of a group from columns: entries of the matrix, then those of the right side.

    `entries`: row, column and value; None where a column gives the value.
    """

    def __init__(self, size: int, entries: tuple[tuple[int, int, float | None], ...]) -> None:
        self._size, self._entries = size, entries

    def __call__(self, columns: Sequence[Array | float]) -> Array:
        """Return the unknowns, shape (unknowns, n)."""
        count = max(np.size(values) for values in columns)
        augmented, remaining = np.zeros((count, self._size, self._size + 1)), iter(columns)
        for row, column, value in self._entries:
            augmented[:, row, column] = next(remaining) if value is None else value
        return solve_positions(augmented[:, :, :-1], augmented[:, :, -1]).T


def _traced_group(
    motion: Motion, links: Sequence[str], held: Sequence[Joint], wrenches: Acting, driver: Driver | None
) -> tuple[dict[Joint, Reaction], TracedValue]:
    """Return the traced reactions, as a root of the equilibrium equations, and the last unknown."""
    size = 3 * len(links)
    entries = list(_entries(motion, links, held, _pushed(driver, motion), size - 1))
    entries += [(3 * k + n, size, -part) for k, link in enumerate(links) for n, part in enumerate(wrenches[link])]
    known = tuple(value for _, _, value in entries if is_traced(value))
    solver = GroupSolver(size, tuple((i, j, None if is_traced(value) else value) for i, j, value in entries))
    root = Root(solver, known)
    unknowns = [TracedValue(Component(root, index)) for index in range(size)]
    root.residuals = tuple(_residual(entries, unknowns, i) for i in range(size))
    reactions: dict[Joint, Reaction] = {
        joint: (PinForce(joint, *pair) if isinstance(joint, Pin) else GuideForce(joint, *pair))
        for k, joint in enumerate(held)
        for pair in [_named_pair(joint, unknowns[2 * k], unknowns[2 * k + 1])]
    }
    return reactions, unknowns[-1]


def cylinder_force(
    mechanism: Mechanism, motion: Motion, reactions: Mapping[Joint, Reaction], wrenches: Acting
) -> Value:
    """Return the pushing force of a cylinder, from the reactions at its barrel. [N]"""
    driver = mechanism.driver
    if not isinstance(driver, Cylinder):
        raise TypeError(f"{driver.link} is no cylinder")
    on_barrel = [
        (reaction.x, reaction.y) if joint.link == driver.link else (-reaction.x, -reaction.y)
        for joint, reaction in reactions.items()
        if isinstance(reaction, PinForce)
        and reaction.joint.point == driver.barrel
        and driver.link in (joint.link, joint.other)
    ]
    x, y = (
        sum_terms(f"link_force_{axis}.{driver.link}", side)
        for axis, side in zip("xy", zip(*on_barrel, strict=True), strict=True)
    )
    if driver.halves:
        # the loads on the barrel are part of its force
        barrel = wrenches[driver.halves[0].link]
        frame = motion.frames[driver.halves[0].link]
        return force_along(x + barrel.x, frame.cos, y + barrel.y, frame.sin)
    frame = motion.frames[driver.link]
    force = force_along(x, frame.cos, y, frame.sin)
    return force if origin_of(mechanism, driver.link) == driver.barrel else -force


def _residual(entries: list[tuple[int, int, Value]], unknowns: Sequence[TracedValue], row: int) -> TracedValue:
    """Return the residual of one equilibrium equation."""
    in_row = ((j, entry) for i, j, entry in entries if i == row and (is_traced(entry) or bool(entry)))
    terms = [entry * unknowns[j] if j < len(unknowns) else -entry for j, entry in in_row]
    return total(("link_force_x", "link_force_y", "link_moment")[row % 3], terms)


def _named_pair(joint: Joint, first: TracedValue, second: TracedValue) -> tuple[TracedValue, TracedValue]:
    kinds = ("joint_force_x", "joint_force_y") if isinstance(joint, Pin) else ("normal_force", "normal_moment")
    return first.named(f"{kinds[0]}.{joint.name}"), second.named(f"{kinds[1]}.{joint.name}")


def system_joint_forces(running: OperatingState) -> JointForces:
    """Return the joint forces from one linear system, a check of `joint_forces` (norton_2012, ch. 11). [N], [N m]"""
    system, mechanism = full_equilibrium(running), running.mechanism
    wrenches = {link: Wrench(*wrench) for link, wrench in numeric_wrenches(running).items()}
    unknowns = solve_positions(system.matrix, system.right_side(wrenches))
    if isinstance(mechanism.driver, Crank) and any(geared.pressure_angle for geared in mechanism.driver.geared):
        between = unknowns[..., 2 * len(system.joints) : -1]
        wrenches = _separated(wrenches, mechanism.driver, between)
        unknowns = solve_positions(system.matrix, system.right_side(wrenches))
    reactions = system.reactions(unknowns)
    is_inside = isinstance(mechanism.driver, Cylinder) and not mechanism.driver.halves
    driven = cylinder_force(mechanism, running.motion, reactions, wrenches) if is_inside else unknowns[..., -1]
    return collect_reactions(reactions, system.joints, driven)


def full_equilibrium(running: OperatingState) -> Equilibrium:
    """Return the equilibrium equations of all links; the last unknown is the torque or force of the driver."""
    return equilibrium(running.motion, *all_links_and_joints(running.mechanism), driver=running.mechanism.driver)


def all_links_and_joints(mechanism: Mechanism) -> tuple[tuple[str, ...], tuple[Joint, ...]]:
    """Return all links of a mechanism and their joints; a cylinder with masses counts as two links."""
    held = joints(mechanism)
    # a link of a chain may be the second link of all its joints
    holding = (name for group in mechanism.dyads for name in group_links(group))
    links = dict.fromkeys([*(joint.link for joint in held), *holding])
    if mechanism.halves:
        barrel, rod = (half.link for half in mechanism.halves)
        held = (*(_on_half(joint, mechanism.driver) for joint in held), SlidingJoint(rod, rod, barrel))
        links = dict.fromkeys([*(link for link in links if link != mechanism.driver.link), barrel, rod])
    if isinstance(mechanism.driver, LinkMotor):
        links.pop(mechanism.driver.link)
    return tuple(links), held


def _on_half(joint: Joint, driver: Driver) -> Joint:
    """Return a joint of a cylinder as one of its barrel or its rod."""
    if not isinstance(joint, Pin) or not isinstance(driver, Cylinder) or driver.link not in (joint.link, joint.other):
        return joint
    half = driver.halves[0 if joint.point == driver.barrel else 1].link
    return replace(joint, link=half) if joint.link == driver.link else replace(joint, other=half)


def numeric_loads(running: OperatingState) -> AppliedLoads:
    """Return the loads of a mechanism together with the inertia of its bodies after D'Alembert."""
    w, eps = running.speed, running.angular_acceleration
    forces, torques = list(running.loads.forces), list(running.loads.torques)
    for body, centre, angle_1, angle_2 in body_motions(running.mechanism, running.motion):
        x, y = (-body.mass * (coordinate.position_2 * w * w + coordinate.position_1 * eps) for coordinate in centre)
        forces.append(AppliedForce(body.link, centre, x, y))
        torques.append(AppliedTorque(body.link, -body.inertia * (angle_2 * w * w + angle_1 * eps), angle_1))
    return AppliedLoads(tuple(forces), tuple(torques))


def numeric_wrenches(running: OperatingState) -> dict[str, tuple[Array, Array, Array]]:
    """Return force and moment about the origin of each link.

    Components [N], [N] and moment [N m] by link.
    """
    loads, frames = numeric_loads(running), running.motion.frames
    totals = {link: [np.zeros_like(running.motion.grid.angle) for _ in range(3)] for link in frames}
    for force in loads.forces:
        (origin_x, origin_y), (at_x, at_y) = frames[force.link].origin, force.point
        x, y = at_x.position - origin_x.position, at_y.position - origin_y.position
        parts = zip(totals[force.link], (force.x, force.y, x * force.y - y * force.x), strict=True)
        totals[force.link] = [before + part for before, part in parts]
    for torque in loads.torques:
        totals[torque.link][2] = totals[torque.link][2] + torque.torque
    return {link: (x, y, moment) for link, (x, y, moment) in totals.items()}
