"""Forces in the joints of a mechanism, group after group from the last to the crank (Bruyevich)."""

from __future__ import annotations

from collections.abc import Sequence

from crankwork.dynamics.dyad_forces import OnGuide, Vector, prp_forces, rpp_forces, rpr_forces, rrp_forces, rrr_forces
from crankwork.dynamics.force_system import solved_group
from crankwork.dynamics.link_loads import Wrenches, arm, link_wrenches
from crankwork.dynamics.reaction import GuideForce, JointForces, PinForce, Reaction, gathered, reaction_wrench
from crankwork.dynamics.running import Running
from crankwork.formula.known import named
from crankwork.kinematics.motion import Motion
from crankwork.kinematics.transfer import PointMotion
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Dyad
from crankwork.mechanism.joints import Joint, Pin, SlidingJoint, group_links, joints
from crankwork.mechanism.linkage import GROUND


def joint_forces(running: Running) -> JointForces:
    """Return the forces in all joints and the balancing torque on the crank.

    On each pin the force on the link it holds [N]; on each sliding piece the normal force [N] and its moment [N m];
    the torque that the crank needs [N m]. Source: artobolevsky_1988, ch. 13; the method of Bruyevich.
    """
    mechanism, motion = running.mechanism, running.motion
    every, wrenches = joints(mechanism), link_wrenches(running)
    found: dict[Joint, Reaction] = {}
    for group in reversed(mechanism.dyads):
        links = group_links(group)
        held = [joint for joint in every if joint.link in links]
        reactions = _group_reactions(group, motion, held, wrenches)
        found |= reactions
        for reaction in reactions.values():
            carrier = reaction.joint.other
            if carrier != GROUND and carrier not in links:
                wrenches.add(carrier, reaction_wrench(reaction, motion, carrier))
    pivot, crank = every[0], wrenches[mechanism.crank.link]
    if isinstance(pivot, Pin):
        found[pivot] = PinForce(pivot, -crank.x, -crank.y)
    return gathered(found, every, -crank.moment if mechanism.crank.direction == 1 else crank.moment)


def _group_reactions(
    group: Dyad | Chain, motion: Motion, held: Sequence[Joint], wrenches: Wrenches
) -> dict[Joint, Reaction]:
    """Return the reactions in the joints of a group: of a dyad in closed form."""
    if isinstance(group, Chain):
        return solved_group(motion, group_links(group), held, wrenches)
    forces = _dyad_reactions(group, motion, wrenches, held[1].name)
    return {joint: _reaction(joint, one) for joint, one in zip(held, forces, strict=True)}


def _arm(link: str, origin: PointMotion, pin: PointMotion) -> Vector:
    x, y = arm(origin, pin)
    return named(x, f"arm_x.{link}"), named(y, f"arm_y.{link}")


def _dyad_reactions(
    dyad: Dyad, motion: Motion, wrenches: Wrenches, name: str
) -> tuple[Vector | OnGuide, Vector | OnGuide, Vector | OnGuide]:
    """Return the reactions of a dyad in the order of its joints."""
    one, two = group_links(dyad)
    first, second = wrenches[one], wrenches[two]
    origin, other = motion.frames[one].origin, motion.frames[two].origin
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
