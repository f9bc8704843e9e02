"""The operating state of a linkage in numbers, with the forces along its redundant links."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import OperatingState
from crankwork.dynamics.reaction import JointForces
from crankwork.dynamics.redundant import RedundantLink, force_along_other, pressing, redundant_forces, with_redundant
from crankwork.formula.traced_value import Component, Root, TracedValue, given
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import Motion, linkage_motion
from crankwork.loads.load import applied_loads
from crankwork.preparation.prepared import PreparedLinkage


def operating_state(solved: PreparedLinkage, motion: Motion) -> OperatingState:
    """Return the linkage at work, with its loads."""
    links = solved.machine.redundant
    # what bears an unknown part does no work, so that torques are as without it
    return with_redundant(_without(solved, motion), links if is_shared(links) else ())


def is_shared(links: Sequence[RedundantLink]) -> bool:
    """Return whether the force share of every redundant link is stated, so that joint forces are known."""
    return all(link.share is not None for link in links)


def _without(solved: PreparedLinkage, motion: Motion) -> OperatingState:
    machine = solved.machine
    w, eps = solved.speed, machine.angular_acceleration
    if motion.driver is not None:
        _, w, eps = motion.driver
    loads = applied_loads(machine.mechanism, motion, machine.loads, w)
    loads = loads.also(solved.filling.loads(machine.mechanism, motion))
    return OperatingState(machine.mechanism, motion, w, loads, eps)


@dataclass(frozen=True)
class _Shares:
    """The forces of redundant links as a function of the crank angle, shape (links, n). [N]"""

    solved: PreparedLinkage

    def __call__(self, grid: CrankGrid) -> Array:
        machine = self.solved.machine
        return redundant_forces(_without(self.solved, linkage_motion(machine.mechanism, grid)), machine.redundant)


def _left(
    links: Sequence[RedundantLink], forces: Sequence[TracedValue], other_forces: Sequence[TracedValue]
) -> Iterator[TracedValue]:
    """Yield by how much forces along redundant links differ from their shares."""
    for link, force, other in zip(links, forces, other_forces, strict=True):
        share = given(f"force_share.{link.member.name}", link.share or 0.0, f"links.{link.member.name}.share")
        yield (force - share * other).named(f"axial_force.{link.member.name}.left")


def traced_joint_forces(solved: PreparedLinkage, running: OperatingState) -> tuple[JointForces, dict[str, TracedValue]]:
    """Return the joint forces of a mechanism at work with its redundant links, and the forces along links by key.

    Without redundant links if their shares are not stated; then only the driver's force is one of the full mechanism.
    The forces of redundant links are solved together; the residuals of their shares are traced as equations.
    """
    links = solved.machine.redundant
    if not links or not is_shared(links):
        return joint_forces(running), {}
    root = Root(_Shares(solved))
    forces = [TracedValue(Component(root, k), f"axial_force.{link.member.name}") for k, link in enumerate(links)]
    loads = running.loads
    for link, force in zip(links, forces, strict=True):
        loads = loads.also(pressing(running.mechanism, running.motion, link, force))
    state = OperatingState(running.mechanism, running.motion, running.speed, loads, running.angular_acceleration)
    values = joint_forces(state)
    other_forces = [force_along_other(running.mechanism, running.motion, values, link) for link in links]
    root.residuals = tuple(_left(links, forces, other_forces))
    return values, {item.key: item for item in [*forces, *other_forces]}
