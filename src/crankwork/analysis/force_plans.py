"""Force plans: the forces on each group of a linkage at one crank angle, end to end, and closed."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import Literal, NamedTuple

import numpy as np

from crankwork.analysis.operating_state import operating_state
from crankwork.analysis.results import Results
from crankwork.analysis.sampled_motion import sample_motion
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import link_wrenches
from crankwork.dynamics.reaction import PinForce, Reaction, reaction_wrench
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.mechanism.driver import Cylinder, DrivingSlider, LinkMotor
from crankwork.mechanism.dyads import RRP, RRR
from crankwork.mechanism.joints import Pin, group_links, joints, names_of_pivots
from crankwork.mechanism.linkage import GROUND

# forces smaller than this share of the largest of a plan are left out
_NEGLIGIBLE = 1e-9
# lines of forces that close a plan
_LINES = 2


class PolygonForce(NamedTuple):
    """A force of a plan: its joint, guide, link or driver, and its parts along the fixed axes. [N]"""

    kind: Literal["load", "pin", "guide", "driver"]
    name: str
    x: float
    y: float

    @property
    def size(self) -> float:
        """Its magnitude. [N]"""
        return float(np.hypot(self.x, self.y))


class ForcePolygon(NamedTuple):
    """The forces on the links of a group: loads with inertia first, then those of its outer joints."""

    links: tuple[str, ...]
    forces: tuple[PolygonForce, ...]


def force_plans(results: Results, degrees: float) -> list[ForcePolygon]:
    """Return the plans of all groups, from the last to the driver, at a crank angle [deg].

    None of a linkage that a cylinder or a motor between links drives: its groups include the driver.
    """
    solved, mechanism = results.solved, results.machine.mechanism
    if isinstance(mechanism.driver, Cylinder | LinkMotor) or mechanism.passages or results.machine.redundant:
        return []
    running = operating_state(solved, linkage_motion(mechanism, CrankGrid.from_degrees([degrees])))
    result, motion, wrenches = joint_forces(running), running.motion, link_wrenches(running)
    reactions: dict[str, Reaction] = {**result.pins, **result.guides}
    pivots = names_of_pivots(mechanism)

    def on_group(links: tuple[str, ...]) -> Iterator[PolygonForce]:
        for link in links:
            wrench = wrenches[link]
            yield PolygonForce("load", link, *(float(np.ravel(item)[0]) for item in (wrench.x, wrench.y)))
        for joint in joints(mechanism):
            inside = [link for link in (joint.link, joint.other) if link in links]
            if len(inside) == 1:
                reaction = reactions[joint.name]
                held = reaction_wrench(reaction, motion, joint.link)
                sign = 1.0 if inside[0] == joint.link else -1.0
                parts = (sign * float(np.ravel(item)[0]) for item in (held.x, held.y))
                kind: Literal["pin", "guide"] = "pin" if isinstance(reaction, PinForce) else "guide"
                yield PolygonForce(kind, pivots.get(joint.name, joint.name), *parts)
        if isinstance(mechanism.driver, DrivingSlider) and mechanism.driver.link in links:
            pushed = float(results.columns_at(np.array([degrees]), ["driver_force"])["driver_force"][0])
            cos, sin = (float(np.ravel(frame)[0]) for frame in motion.frames[mechanism.driver.link][1:3])
            yield PolygonForce("driver", mechanism.driver.link, pushed * cos, pushed * sin)

    driven = tuple(name for name in motion.frames if name not in _of_groups(results) and name != GROUND)
    plans = []
    for links in (*(group_links(group) for group in reversed(mechanism.dyads)), driven):
        forces = tuple(on_group(links))
        most = max((force.size for force in forces), default=0.0)
        if most > 0:
            plans.append(ForcePolygon(links, tuple(force for force in forces if force.size > _NEGLIGIBLE * most)))
    return plans


def constructed_forces(
    results: Results, degrees: float, plan: ForcePolygon, solved: Collection[str], scale: float, precision: float
) -> dict[PolygonForce, float]:
    """Return how long unknown forces are on a plan at a scale [N/mm], read and laid off to a precision. [mm], [mm]

    Loads, forces of joints in `solved`, and what the moments of a link give across it, are laid off; where the lines of
    the two forces that are left cross, or the plan closes, is what they come to. Empty where that is not enough.
    """
    mechanism = results.machine.mechanism
    group = next((dyad for dyad in mechanism.dyads if {*group_links(dyad)} == {*plan.links}), None)
    points = {pin.name: pin.point for pin in joints(mechanism) if isinstance(pin, Pin)}
    points |= {shown: points[name] for name, shown in names_of_pivots(mechanism).items() if name in points}
    inner = {RRR: ("joint_a", "joint_b"), RRP: ("joint",)}.get(type(group), ())
    ends = {getattr(group, name): getattr(group, "point" if isinstance(group, RRR) else "slider") for name in inner}
    moving = sample_motion(mechanism, [degrees])

    def place(point: str) -> complex:
        return complex(*(moving.points[point].place[0] if point in moving.points else mechanism.ground[point]))

    def rounded(length: float) -> float:
        return round(length / precision) * precision

    drawn, lines, pivot = list[complex](), list[tuple[int, complex]](), getattr(group, "pivot", "")
    for index, force in enumerate(plan.forces):
        vector, point = complex(force.x, force.y) / scale, points.get(force.name, "")
        if force.kind in ("pin", "guide") and force.name not in solved:
            if point in ends:
                along = place(ends[point]) - place(point)
                lines.append((index, along / abs(along)))
                vector -= lines[-1][1] * (vector * lines[-1][1].conjugate()).real
            elif force.kind == "guide" or group is None or point == pivot:
                lines.append((index, vector / abs(vector)))
                vector = 0j
        drawn.append(vector / abs(vector) * rounded(abs(vector)) if vector else 0j)
    (first, along), (second, across) = lines if len(lines) == _LINES else (lines[:1] or [(0, 1j)]) * 2
    crossing = (along.conjugate() * across).imag
    if not lines or len(lines) > _LINES or (first != second and abs(crossing) < _NEGLIGIBLE):
        return {}
    if first != second:
        drawn[first] += (-sum(drawn).conjugate() * across).imag / crossing * along
    drawn[second] -= sum(drawn)
    return {force: rounded(abs(end)) for force, end in zip(plan.forces, drawn, strict=True)
            if force.kind != "load" and force.name not in solved}  # fmt: skip


def _of_groups(results: Results) -> set[str]:
    return {link for group in results.machine.mechanism.dyads for link in group_links(group)}
