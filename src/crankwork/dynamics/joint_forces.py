"""Forces in the joints of a mechanism, group after group from the last to the driver (Bruyevich)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from crankwork.dynamics.dyad_forces import (
    OnGuide,
    Vector,
    force_across,
    force_along,
    prp_forces,
    rpp_forces,
    rpr_forces,
    rrp_forces,
    rrr_forces,
)
from crankwork.dynamics.force_passages import bridged_forces
from crankwork.dynamics.force_system import cylinder_force, opened_group, solved_group
from crankwork.dynamics.gears import meshes, on_cranks
from crankwork.dynamics.link_loads import Wrench, Wrenches, arm, link_wrenches, moment_of
from crankwork.dynamics.reaction import GuideForce, JointForces, PinForce, Reaction, gathered, reaction_wrench
from crankwork.dynamics.running import Running
from crankwork.formula.expression import Value
from crankwork.formula.known import named
from crankwork.kinematics.motion import Motion
from crankwork.kinematics.transfer import PointMotion
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.driver import Cylinder, CylinderPart, DrivingSlider, LinkMotor
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Dyad
from crankwork.mechanism.joints import Joint, Pin, SlidingJoint, group_links, joints
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Crank, Driver, Mechanism


def joint_forces(running: Running) -> JointForces:
    """Return the forces in all joints and the balancing torque or force at the driver.

    On each pin the force on the link it holds [N]; on each sliding piece the normal force [N] and its moment [N m];
    the torque [N m] or force [N] that the driver needs. Source: artobolevsky_1988, ch. 13; the method of Bruyevich.
    """
    mechanism, motion, driver = running.mechanism, running.motion, running.mechanism.driver
    every, wrenches = joints(mechanism), _loaded(running)
    found: dict[Joint, Reaction] = {}
    torque: Value = 0.0
    for group, links in _held_together(mechanism):
        held = [joint for joint in every if joint.link in links]
        if group is not None:
            reactions = _group_reactions(group, running, held, wrenches)
            passage = next((one for at, one in mechanism.passages.items() if mechanism.dyads[at] is group), None)
            if passage is not None:
                reactions = bridged_forces(reactions, passage)
        elif isinstance(driver, LinkMotor):
            reactions, torque = opened_group(motion, links, held, wrenches, driver)
        found |= reactions
        for reaction in reactions.values():
            carrier = reaction.joint.other
            if carrier != GROUND and carrier not in links:
                wrenches.add(carrier, reaction_wrench(reaction, motion, carrier))
    meshing = {one.link: one for one in meshes(driver, motion, wrenches)} if isinstance(driver, Crank) else {}
    pushed = on_cranks(driver, meshing) if isinstance(driver, Crank) else {}
    found |= _at_base(running, every, wrenches, pushed)
    if isinstance(driver, Cylinder) and driver.halves:
        guided = _in_barrel(driver, motion, found, wrenches)
        found[guided.joint], every = guided, (*every, guided.joint)
    if not isinstance(driver, LinkMotor):
        torque = _at_driver(running, found, wrenches)
    teeth = {name: (one.across, one.apart) for name, one in meshing.items()}
    return replace(gathered(found, every, torque), teeth=teeth)


def _loaded(running: Running) -> Wrenches:
    """Return what loads and inertia put on each link; barrel and rod of a cylinder are one link as well."""
    wrenches, driver = link_wrenches(running), running.mechanism.driver
    for half in running.mechanism.halves:
        wrenches.add(driver.link, _on_cylinder(half, driver, running.motion, wrenches[half.link]))
    return wrenches


def _at_driver(running: Running, found: Mapping[Joint, Reaction], wrenches: Wrenches) -> Value:
    """Return the torque of a crank, or the force of a slider or a cylinder that drives."""
    driver, motion = running.mechanism.driver, running.motion
    if isinstance(driver, Crank):
        return _crank_torque(driver, motion, wrenches)
    if isinstance(driver, DrivingSlider):
        piece, (cos, sin) = wrenches[driver.link], motion.frames[driver.link][1:3]
        return -force_along(piece.x, cos, piece.y, sin)
    return cylinder_force(running.mechanism, motion, found, wrenches)


def _at_base(
    running: Running, every: Sequence[Joint], wrenches: Wrenches, pushed: Mapping[str, tuple[Value, Value]]
) -> dict[Joint, Reaction]:
    """Return the reactions in the joints of the links that are placed before any group.

    `pushed`: by teeth, along the fixed axes [N].
    """
    found: dict[Joint, Reaction] = {}
    inner = {name for group in running.mechanism.dyads for name in group_links(group)}
    for joint in every:
        if joint.link in inner:
            continue
        held = wrenches[joint.link]
        if isinstance(joint, Pin):
            x, y = pushed.get(joint.link, (None, None))
            along = (-held.x if x is None else -held.x - x, -held.y if y is None else -held.y - y)
            found[joint] = PinForce(joint, *along)
        else:
            cos, sin = running.motion.frames[joint.link][1:3]
            across = named(-force_across(held.y, cos, held.x, sin), f"normal_force.{joint.link}")
            found[joint] = GuideForce(joint, across, named(-held.moment, f"normal_moment.{joint.link}"))
    return found


def _on_cylinder(half: CylinderPart, driver: Driver, motion: Motion, own: Wrench) -> Wrench:
    """Return what acts on the barrel or the rod of a cylinder as it acts on both together."""
    way = arm(motion.frames[driver.link].origin, motion.frames[half.link].origin)
    moved = moment_of(way, (own.x, own.y), f"{driver.link}.{half.link}")
    return Wrench(own.x, own.y, named(own.moment + moved, f"link_moment.{driver.link}.{half.link}.both"))


def _in_barrel(driver: Cylinder, motion: Motion, reactions: Mapping[Joint, Reaction], wrenches: Wrenches) -> GuideForce:
    """Return the force across the rod of a cylinder from its barrel, and its moment about the end of the rod."""
    barrel, rod = (one.link for one in driver.halves)
    own, frame, x, y = wrenches[rod], motion.frames[rod], wrenches[rod].x, wrenches[rod].y
    for joint, one in reactions.items():
        if isinstance(one, PinForce) and one.joint.point == driver.rod and driver.link in (joint.link, joint.other):
            sign = 1.0 if joint.link == driver.link else -1.0
            x, y = x + sign * one.x, y + sign * one.y
    across = force_across(y, frame.cos, x, frame.sin)
    normal, moment = named(-across, f"normal_force.{rod}"), named(-own.moment, f"normal_moment.{rod}")
    return GuideForce(SlidingJoint(rod, rod, barrel), normal, moment)


def _crank_torque(crank: Crank, motion: Motion, wrenches: Wrenches) -> Value:
    """Return the torque of a crank, with that of the cranks that gears turn: changed as the inverse of the speed."""
    torque = -wrenches[crank.link].moment if crank.direction == 1 else wrenches[crank.link].moment
    for one in crank.geared:
        rate = motion.frames[one.link].angle_1
        torque = torque - named(rate * wrenches[one.link].moment, f"link_moment.{one.link}.geared")
    return torque


def _held_together(mechanism: Mechanism) -> Iterator[tuple[Dyad | Chain | None, tuple[str, ...]]]:
    """Yield groups and their links from the last to the first; without a group those that a motor holds together.

    The third side of its triangle is no link: the group that it is in and that of the links that it is between are one.
    """
    groups = [(group, group_links(group)) for group in mechanism.dyads]
    if not isinstance(mechanism.driver, LinkMotor):
        yield from reversed(groups)
        return
    third_side, between = mechanism.driver.link, mechanism.driver.links
    opened = [links for _, links in groups if third_side in links or between[0] in links]
    for group, links in reversed(groups):
        if third_side in links:
            yield None, tuple(one for some in opened for one in some if one != third_side)
        elif between[0] not in links:
            yield group, links


def _group_reactions(
    group: Dyad | Chain, running: Running, held: Sequence[Joint], wrenches: Wrenches
) -> dict[Joint, Reaction]:
    """Return the reactions in the joints of a group: of a dyad in closed form."""
    if isinstance(group, Chain):
        return solved_group(running.motion, group_links(group), held, wrenches)
    forces = _dyad_reactions(group, running, wrenches, held[1].name)
    return {joint: _reaction(joint, one) for joint, one in zip(held, forces, strict=True)}


def _arm(link: str, origin: PointMotion, pin: PointMotion) -> Vector:
    x, y = arm(origin, pin)
    return named(x, f"arm_x.{link}"), named(y, f"arm_y.{link}")


def _dyad_reactions(
    dyad: Dyad, running: Running, wrenches: Wrenches, name: str
) -> tuple[Vector | OnGuide, Vector | OnGuide, Vector | OnGuide]:
    """Return the reactions of a dyad in the order of its joints."""
    (one, two), motion = group_links(dyad), running.motion
    (first, origin), (second, other) = (_about_joint(link, running, wrenches[link]) for link in (one, two))
    along_one, along_two = ((motion.frames[link].cos, motion.frames[link].sin) for link in (one, two))
    match dyad:
        case RRR():
            pin = motion.points[dyad.point]
            return rrr_forces(first, second, _arm(one, origin, pin), _arm(two, other, pin), name)
        case RRP():
            return rrp_forces(first, second, _arm(one, origin, other), along_two, name)
        case RPR():
            return rpr_forces(first, second, _arm(one, origin, other), along_two, name)
        case PRP():
            return prp_forces(first, second, along_one, along_two, name)
        case RPP():
            return rpp_forces(first, second, _arm(one, origin, other), along_two, along_one, name)


def _about_joint(link: str, running: Running, own: Wrench) -> tuple[Wrench, PointMotion]:
    """Return what acts on a link of a dyad with its moment about the joint that it hangs on, and that joint."""
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
