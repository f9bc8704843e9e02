"""Forces in the joints of a mechanism, group after group from the last to the driver (Bruyevich).

Forces between teeth act where both wheels have the same velocity: on the line of centres, between the axes if they turn
in opposite senses, beyond one of them if the other is a ring.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from crankwork.dynamics.dyad_forces import (
    OnGuide,
    Vector,
    force_across,
    force_along,
    force_along_x,
    force_along_y,
    prp_forces,
    rpp_forces,
    rpr_forces,
    rrp_forces,
    rrr_forces,
)
from crankwork.dynamics.force_system import cylinder_force, solved_group
from crankwork.dynamics.link_loads import OperatingState, Wrench, Wrenches, arm, link_wrenches, moment_of
from crankwork.dynamics.reaction import GuideForce, JointForces, PinForce, Reaction, collect_reactions, reaction_wrench
from crankwork.formula.expression import Value, formula
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import Piecewise, Tabulated, TracedValue, is_traced, named
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dyads import BEYOND
from crankwork.kinematics.kinematic_coefficients import PointMotion
from crankwork.kinematics.motion import Motion
from crankwork.kinematics.traced_motion import Follower, interpolant_of
from crankwork.mechanism.driver import Cylinder, CylinderPart, DrivingSlider, GearedCrank, LinkMotor
from crankwork.mechanism.dyads import (
    PRP,
    RPP,
    RPR,
    RRP,
    RRR,
    Chain,
    ChangePointFit,
    ChangePointPassage,
    Dyad,
    Polynomial,
)
from crankwork.mechanism.equal_parts import EqualPart
from crankwork.mechanism.joints import Joint, Pin, SlidingJoint, group_links, joints
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Crank, Driver, Mechanism

_DEGREE, _NODES = 12, 40
# forces lose one digit more than the motion they follow from: their nodes lie farther off
_NEAREST, _REACH = 0.25, 1.5
_SMOOTH = 1e-8
# without a common limit, the change point itself has no value [deg]
_ANGLE_TOLERANCE = 1e-6
_SOURCE = "artobolevsky_1988, ch. 13"


def joint_forces(running: OperatingState) -> JointForces:
    """Return the forces in all joints and the balancing torque or force at the driver.

    On each pin the force on the link it holds [N]; on each sliding piece the normal force [N] and its moment [N m];
    the torque [N m] or force [N] that the driver needs. Source: artobolevsky_1988, ch. 13; the method of Bruyevich.
    """
    mechanism, motion, driver = running.mechanism, running.motion, running.mechanism.driver
    all_joints, wrenches = joints(mechanism), _loaded(running)
    result: dict[Joint, Reaction] = {}
    torque: Value = 0.0
    parts = {link: part for part in motion.equal_parts for link in part.links}
    # forces in an equal part follow from those of the earlier one
    for group, links in sorted(_held_together(mechanism), key=lambda held: held[1][0] in parts):
        held = [joint for joint in all_joints if joint.link in links]
        if links[0] in parts:
            reactions = dict(_of_equal_part(parts[links[0]], held, result))
        elif group is not None:
            reactions = _group_reactions(group, running, held, wrenches)
            passages = [passage for index, passage in mechanism.passages.items() if mechanism.dyads[index] is group]
            if passages:
                reactions = bridged_forces(reactions, passages[0])
        elif isinstance(driver, LinkMotor):
            reactions, torque = solved_group(motion, links, held, wrenches, driver)
        result |= reactions
        for reaction in reactions.values():
            carrier = reaction.joint.other
            if carrier != GROUND and carrier not in links:
                wrenches.add(carrier, reaction_wrench(reaction, motion, carrier))
    meshing = {mesh.link: mesh for mesh in meshes(driver, motion, wrenches)} if isinstance(driver, Crank) else {}
    tooth_forces = on_cranks(driver, meshing) if isinstance(driver, Crank) else {}
    result |= _at_base(running, all_joints, wrenches, tooth_forces)
    if isinstance(driver, Cylinder) and driver.halves:
        guided = _in_barrel(driver, motion, result, wrenches)
        result[guided.joint], all_joints = guided, (*all_joints, guided.joint)
    if not isinstance(driver, LinkMotor):
        torque = _at_driver(running, result, wrenches)
    teeth = {name: (mesh.across, mesh.separating) for name, mesh in meshing.items()}
    return replace(collect_reactions(result, all_joints, torque), teeth=teeth)


def _of_equal_part(
    part: EqualPart, held: Sequence[Joint], values: Mapping[Joint, Reaction]
) -> Iterator[tuple[Joint, Reaction]]:
    """Yield the reactions in joints of a part by those of the earlier part that it is equal to."""
    follower = Follower(part)
    for joint in held:
        first = values[part.joint_of_first(joint, values)]
        name = joint.name
        if isinstance(first, PinForce) and isinstance(joint, Pin):
            x, y = follower.vector(first.x, first.y)
            yield joint, PinForce(joint, named(x, f"joint_force_x.{name}"), named(y, f"joint_force_y.{name}"))
        elif isinstance(first, GuideForce) and isinstance(joint, SlidingJoint):
            normal, moment = follower.later(first.normal), follower.later(first.moment)
            yield (
                joint,
                GuideForce(joint, named(normal, f"normal_force.{name}"), named(moment, f"normal_moment.{name}")),
            )


def _loaded(running: OperatingState) -> Wrenches:
    """Return the wrenches of loads and inertia on each link; barrel and rod of a cylinder also count as one link."""
    wrenches, driver = link_wrenches(running), running.mechanism.driver
    for half in running.mechanism.halves:
        wrenches.add(driver.link, _on_cylinder(half, driver, running.motion, wrenches[half.link]))
    return wrenches


def _at_driver(running: OperatingState, reactions: Mapping[Joint, Reaction], wrenches: Wrenches) -> Value:
    """Return the torque of a crank, or the force of a slider or a cylinder that drives."""
    driver, motion = running.mechanism.driver, running.motion
    if isinstance(driver, Crank):
        return _crank_torque(driver, motion, wrenches)
    if isinstance(driver, DrivingSlider):
        piece, (cos, sin) = wrenches[driver.link], motion.frames[driver.link][1:3]
        return -force_along(piece.x, cos, piece.y, sin)
    return cylinder_force(running.mechanism, motion, reactions, wrenches)


def _at_base(
    running: OperatingState,
    all_joints: Sequence[Joint],
    wrenches: Wrenches,
    tooth_forces: Mapping[str, tuple[Value, Value]],
) -> dict[Joint, Reaction]:
    """Return the reactions in the joints of links that are placed before any group.

    `tooth_forces`: along the fixed axes [N].
    """
    result: dict[Joint, Reaction] = {}
    inner = {name for group in running.mechanism.dyads for name in group_links(group)}
    for joint in all_joints:
        if joint.link in inner:
            continue
        held = wrenches[joint.link]
        if isinstance(joint, Pin):
            x, y = tooth_forces.get(joint.link, (None, None))
            along = (-held.x if x is None else -held.x - x, -held.y if y is None else -held.y - y)
            result[joint] = PinForce(joint, *along)
        else:
            cos, sin = running.motion.frames[joint.link][1:3]
            across = named(-force_across(held.y, cos, held.x, sin), f"normal_force.{joint.link}")
            result[joint] = GuideForce(joint, across, named(-held.moment, f"normal_moment.{joint.link}"))
    return result


def _on_cylinder(half: CylinderPart, driver: Driver, motion: Motion, own: Wrench) -> Wrench:
    """Return the wrench on the barrel or the rod of a cylinder, referred to the cylinder as one link."""
    offset = arm(motion.frames[driver.link].origin, motion.frames[half.link].origin)
    moved = moment_of(offset, (own.x, own.y), f"{driver.link}.{half.link}")
    return Wrench(own.x, own.y, named(own.moment + moved, f"link_moment.{driver.link}.{half.link}.both"))


def _in_barrel(driver: Cylinder, motion: Motion, reactions: Mapping[Joint, Reaction], wrenches: Wrenches) -> GuideForce:
    """Return the force across the rod of a cylinder from its barrel, and its moment about the end of the rod."""
    barrel, rod = (part.link for part in driver.halves)
    own, frame, x, y = wrenches[rod], motion.frames[rod], wrenches[rod].x, wrenches[rod].y
    for joint, force in reactions.items():
        if isinstance(force, PinForce) and force.joint.point == driver.rod and driver.link in (joint.link, joint.other):
            sign = 1.0 if joint.link == driver.link else -1.0
            x, y = x + sign * force.x, y + sign * force.y
    across = force_across(y, frame.cos, x, frame.sin)
    normal, moment = named(-across, f"normal_force.{rod}"), named(-own.moment, f"normal_moment.{rod}")
    return GuideForce(SlidingJoint(rod, rod, barrel), normal, moment)


def _crank_torque(crank: Crank, motion: Motion, wrenches: Wrenches) -> Value:
    """Return the torque of a crank, with that of geared cranks in the inverse ratio of the speeds."""
    torque = -wrenches[crank.link].moment if crank.direction == 1 else wrenches[crank.link].moment
    for geared in crank.geared:
        rate = motion.frames[geared.link].angle_1
        torque = torque - named(rate * wrenches[geared.link].moment, f"link_moment.{geared.link}.geared")
    return torque


def _held_together(mechanism: Mechanism) -> Iterator[tuple[Dyad | Chain | None, tuple[str, ...]]]:
    """Yield groups and their links from the last to the first, and None with the links that a motor connects.

    The third side of its triangle is not a link: its group and that of the links of the motor are solved together.
    """
    groups = [(group, group_links(group)) for group in mechanism.dyads]
    if not isinstance(mechanism.driver, LinkMotor):
        yield from reversed(groups)
        return
    third_side, between = mechanism.driver.link, mechanism.driver.links
    opened = [links for _, links in groups if third_side in links or between[0] in links]
    for group, links in reversed(groups):
        if third_side in links:
            yield None, tuple(name for names in opened for name in names if name != third_side)
        elif between[0] not in links:
            yield group, links


def _group_reactions(
    group: Dyad | Chain, running: OperatingState, held: Sequence[Joint], wrenches: Wrenches
) -> dict[Joint, Reaction]:
    """Return the reactions in the joints of a group, for a dyad in closed form."""
    if isinstance(group, Chain):
        return solved_group(running.motion, group_links(group), held, wrenches)[0]
    forces = _dyad_reactions(group, running, wrenches, held[1].name)
    return {joint: _reaction(joint, force) for joint, force in zip(held, forces, strict=True)}


def _arm(link: str, origin: PointMotion, pin: PointMotion) -> Vector:
    x, y = arm(origin, pin)
    return named(x, f"arm_x.{link}"), named(y, f"arm_y.{link}")


def _dyad_reactions(
    dyad: Dyad, running: OperatingState, wrenches: Wrenches, name: str
) -> tuple[Vector | OnGuide, Vector | OnGuide, Vector | OnGuide]:
    """Return the reactions of a dyad in the order of its joints."""
    (link_a, link_b), motion = group_links(dyad), running.motion
    (first, origin), (second, other) = (_about_joint(link, running, wrenches[link]) for link in (link_a, link_b))
    along_a, along_b = ((motion.frames[link].cos, motion.frames[link].sin) for link in (link_a, link_b))
    match dyad:
        case RRR():
            pin = motion.points[dyad.point]
            return rrr_forces(first, second, _arm(link_a, origin, pin), _arm(link_b, other, pin), name)
        case RRP():
            return rrp_forces(first, second, _arm(link_a, origin, other), along_b, name)
        case RPR():
            return rpr_forces(first, second, _arm(link_a, origin, other), along_b, name)
        case PRP():
            return prp_forces(first, second, along_a, along_b, name)
        case RPP():
            return rpp_forces(first, second, _arm(link_a, origin, other), along_b, along_a, name)


def _about_joint(link: str, running: OperatingState, own: Wrench) -> tuple[Wrench, PointMotion]:
    """Return the wrench on a link of a dyad about its outer joint, and that joint."""
    origin = running.motion.frames[link].origin
    if link not in running.mechanism.bars:
        return own, origin
    joint = running.motion.bars[link].origin
    moved = moment_of(arm(joint, origin), (own.x, own.y), f"{link}.moved")
    return Wrench(own.x, own.y, named(own.moment + moved, f"link_moment.{link}.hung")), joint


def _reaction(joint: Joint, force: Vector | OnGuide) -> Reaction:
    match joint:
        case Pin():
            return PinForce(
                joint, named(force[0], f"joint_force_x.{joint.name}"), named(force[1], f"joint_force_y.{joint.name}")
            )
        case SlidingJoint():
            return GuideForce(
                joint, named(force[0], f"normal_force.{joint.name}"), named(force[1], f"normal_moment.{joint.name}")
            )


def bridged_forces(reactions: dict[Joint, Reaction], passage: ChangePointPassage) -> dict[Joint, Reaction]:
    """Return traced reactions of a dyad that passes change points; numbers stay as they are."""
    if not all(isinstance(value, TracedValue) for force in reactions.values() for value in force[1:]):
        return reactions
    columns: dict[str, TracedValue] = {
        f"{number}.{index}": value
        for number, force in enumerate(reactions.values())
        for index, value in enumerate(force[1:])
    }
    varying = {key: column for key, column in columns.items() if column.varies}
    ends: list[float] = []
    laws: dict[str, list[TracedValue]] = {key: [] for key in varying}
    for bridge in passage.bridges:
        nodes = _nodes(bridge)
        values = Program(varying)(CrankGrid.from_degrees(bridge.degrees + nodes))
        # a force that is negligible against the others is rough from rounding
        width, tolerance = bridge.width, _SMOOTH * max(float(np.max(np.abs(value))) for value in values.values())
        fits = {key: _limit(bridge.degrees, nodes, value, tolerance) for key, value in values.items()}
        if any(fit is None for fit in fits.values()):
            width, unknown = _ANGLE_TOLERANCE, Polynomial(bridge.degrees, _ANGLE_TOLERANCE, (np.nan,))
            fits = dict.fromkeys(values, unknown)
        ends += [bridge.degrees - width, bridge.degrees + width]
        for key, law in fits.items():
            if law is not None:
                laws[key] += [varying[key], TracedValue(Tabulated(law, "change_point"), varying[key].key)]
    for key, traced in varying.items():
        columns[key] = TracedValue(Piecewise([*ends, BEYOND], (*laws[key], traced)), traced.key)
    result: dict[Joint, Reaction] = {}
    for number, reaction in enumerate(reactions.values()):
        first, second = columns[f"{number}.0"], columns[f"{number}.1"]
        if isinstance(reaction, PinForce):
            result[reaction.joint] = PinForce(reaction.joint, first, second)
        else:
            result[reaction.joint] = GuideForce(reaction.joint, first, second)
    return result


def _nodes(bridge: ChangePointFit) -> Array:
    """Return angles on both sides of a change point, relative to it. [deg]"""
    near, far = _NEAREST * bridge.width, _REACH * bridge.width
    nodes = np.cos(np.pi * (2 * np.arange(_NODES // 2) + 1) / _NODES)
    offsets = np.sqrt((near**2 + far**2) / 2 + (far**2 - near**2) / 2 * nodes)
    return np.concatenate([-offsets, offsets[::-1]])


def _limit(degrees: float, nodes: Array, values: Array, tolerance: float) -> Polynomial | None:
    """Return the polynomial through values on both sides of a change point, or None if its error is too large."""
    reach = float(np.max(np.abs(nodes)))
    powers = chebyshev.chebvander(nodes / reach, _DEGREE)
    coefficients = np.linalg.lstsq(powers, values, rcond=None)[0]
    if not np.max(np.abs(powers @ coefficients - values)) <= tolerance:
        return None
    return Polynomial(degrees, reach, tuple(map(float, coefficients)))


class Mesh(NamedTuple):
    """The force on the teeth of a geared crank, across the line of centres and along it, arrays of shape (n,). [N]"""

    link: str
    across: Value  # To the left of the direction from the driving pivot to its own
    separating: Value  # Away from the other teeth, never negative
    # Along the fixed axes
    x: Value
    y: Value


class Centres(NamedTuple):
    """The line of centres of two wheels: its length, and its direction from the driving wheel. [m]"""

    distance: Value
    cos: Value
    sin: Value


@formula("link_length", _SOURCE)
def centre_distance(r_x: Value, r_y: Value) -> Value:
    """Distance of the axes of two wheels."""
    return np.sqrt(r_x**2 + r_y**2)


@formula("tooth_force", _SOURCE)
def tooth_force(M_1: Value, i_g: Value, a_w: Value) -> Value:
    """Force between teeth across the line of centres, from the moment of what the wheel of a geared crank carries."""
    return M_1 * (1 - i_g) / a_w


@formula("separating_force", _SOURCE)
def separating_force(F_z: Value, mu_p: Value) -> Value:
    """Force between teeth along the line of centres, where that across it is positive."""
    return F_z * np.tan(mu_p)


def centres(crank: Crank, geared: GearedCrank) -> Centres:
    """Return the line of centres of the wheels of two cranks."""
    x, y = (its - mine for its, mine in zip(geared.pivot, crank.pivot, strict=True))
    distance = named(centre_distance(x, y), f"link_length.{geared.link}.centres")
    return Centres(
        distance,
        named(x / distance, f"line_cos.{geared.link}.centres"),
        named(y / distance, f"line_sin.{geared.link}.centres"),
    )


def meshes(crank: Crank, motion: Motion, wrenches: Wrenches) -> Iterator[Mesh]:
    """Yield the forces on the teeth of geared cranks whose pressure angle is given.

    `wrenches`: on every link, without bearings and teeth.
    """
    for geared in crank.geared:
        if geared.pressure_angle is None:
            continue
        line, moment = centres(crank, geared), wrenches[geared.link].moment
        if is_traced(moment) and moment.is_absent:
            continue
        across = named(tooth_force(moment, geared.ratio, line.distance), f"tooth_force.{geared.link}")
        separating = _separating_force(across, geared, motion)
        along = -separating if _is_inside(geared) else separating
        x = named(force_along_x(along, line.cos, across, line.sin), f"joint_force_x.{geared.link}.teeth")
        y = named(force_along_y(along, line.sin, across, line.cos), f"joint_force_y.{geared.link}.teeth")
        yield Mesh(geared.link, across, separating, x, y)


def _is_inside(geared: GearedCrank) -> bool:
    """Return whether one of the wheels is a ring, so that teeth push the other towards its centre."""
    ratio: Any = geared.ratio
    return bool((ratio.value if is_traced(ratio) else ratio) > 0)


def _separating_force(across: Value, geared: GearedCrank, motion: Motion) -> Value:
    """Return the force that separates the wheels, on either flank."""
    angle, key = geared.pressure_angle, f"separating_force.{geared.link}"
    if not is_traced(across):
        return separating_force(np.abs(across), angle)
    push, pull = named(separating_force(across, angle), key), named(separating_force(-across, angle), key)
    if not across.varies:
        return push if across.value >= 0 else pull
    ends, is_pull = interpolant_of(motion.grid)({"": across}).sign_intervals("")
    return TracedValue(Piecewise(ends, tuple(pull if is_pulling else push for is_pulling in is_pull)), key)


def on_cranks(crank: Crank, meshes_by_link: Mapping[str, Mesh]) -> dict[str, tuple[Value, Value]]:
    """Return the tooth forces on the crank and the geared cranks, along the fixed axes. [N]"""
    forces: dict[str, tuple[Value, Value]] = {name: (item.x, item.y) for name, item in meshes_by_link.items()}
    for mesh in meshes_by_link.values():
        x, y = forces.get(crank.link, (0.0, 0.0))
        forces[crank.link] = (x - mesh.x, y - mesh.y)
    return forces
