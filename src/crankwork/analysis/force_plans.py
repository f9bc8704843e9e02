"""Force plans: the forces on each group of a linkage at one crank angle, end to end, and closed.

What the equations of moments about inner joints give, a force across a link, is laid off before a plan closes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator
from itertools import chain
from typing import Literal, NamedTuple

import numpy as np

from crankwork.analysis.operating_state import operating_state
from crankwork.analysis.results import Results
from crankwork.dynamics.joint_forces import joint_forces
from crankwork.dynamics.link_loads import OperatingState, inertia_loads
from crankwork.dynamics.reaction import PinForce, Reaction, joint_place, reaction_wrench
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.kinematic_coefficients import PointMotion
from crankwork.kinematics.motion import linkage_motion
from crankwork.loads.applied_loads import ForceKind
from crankwork.mechanism.driver import Cylinder, DrivingSlider, LinkMotor
from crankwork.mechanism.dyads import RPR, RRP, RRR
from crankwork.mechanism.joints import Joint, Pin, group_links, joints, names_of_pivots
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Crank


class ActingForce(NamedTuple):
    """A force on a link, the sum of those of its kind at one point. [N]"""

    kind: ForceKind
    link: str
    point: PointMotion
    force: Array
    before: int = 0  # How many of its kind on its link stand before it


class ActingTorque(NamedTuple):
    """A torque on a link, positive anticlockwise [N m], and the link's rate of turning over the crank's."""

    kind: ForceKind
    link: str
    torque: float
    rate: float


def first_value(value: object) -> float:
    """Return the first element of a column, at the one angle that is asked for."""
    return float(np.ravel(np.asarray(value, dtype=float))[0])


def place_of(point: PointMotion) -> Array:
    """Return where a point is. [m]"""
    return np.array([first_value(side.position) for side in point])


def acting_forces(running: OperatingState) -> list[ActingForce]:
    """Return the loads, weights and inertia forces on the links, those that are zero left out."""
    sums: dict[tuple[object, ...], ActingForce] = {}
    for load in running.loads.also(inertia_loads(running)).forces:
        force, place = np.array([first_value(load.x), first_value(load.y)]), np.round(place_of(load.point), 9)
        key = (load.kind, load.link, *place.tolist())
        same = sums.get(key)
        sums[key] = ActingForce(load.kind, load.link, load.point, force if same is None else same.force + force)
    seen, result = Counter[tuple[str, str]](), list[ActingForce]()
    for acting in sums.values():
        if np.any(acting.force):
            result.append(acting._replace(before=seen[acting[:2]]))
            seen[acting[:2]] += 1
    return result


def acting_torques(running: OperatingState) -> list[ActingTorque]:
    """Return the torques of loads and of inertia on the links, those of one kind on a link as one."""
    sums: dict[tuple[str, str], ActingTorque] = {}
    for load in running.loads.also(inertia_loads(running)).torques:
        same, torque = sums.get((load.kind, load.link)), first_value(load.torque)
        total = torque + (same.torque if same else 0.0)
        sums[load.kind, load.link] = ActingTorque(load.kind, load.link, total, first_value(load.angle_1))
    return [*sums.values()]


# forces smaller than this share of the largest of a plan, and moments than this of an equation, are left out
_NEGLIGIBLE = 1e-9
# lines of forces that close a plan
_LINES = 2


class PolygonForce(NamedTuple):
    """A force of a plan: its joint, guide, link or driver, and its parts along the fixed axes. [N]"""

    kind: Literal[ForceKind, "pin", "guide", "driver"]
    name: str
    x: float
    y: float
    before: int = 0  # How many of its kind on its link stand before it
    across: tuple[float, float] | None = None  # Its part across its link, which an equation of moments gives [N]

    @property
    def size(self) -> float:
        """Its magnitude. [N]"""
        return float(np.hypot(self.x, self.y))

    @property
    def is_load(self) -> bool:
        """Whether it is known before joints are: a load, a weight, an inertia force."""
        return self.kind in ("load", "weight", "inertia")


class ForcePolygon(NamedTuple):
    """The forces on the links of a group: an outer joint, loads with inertia, then other joints."""

    links: tuple[str, ...]
    forces: tuple[PolygonForce, ...]


class MomentEquation(NamedTuple):
    """The moments on a link about a point, of which one follows: of a force across it, or the torque of the crank.

    `arm`: of the unknown force, 1 of a torque; `sense`: 1 where the unknown turns anticlockwise if it is positive;
    `terms`: forces with their arms, positive anticlockwise. [m], [N m]
    """

    link: str
    point: str
    kind: Literal["pin", "guide", "driver"]
    unknown: str
    arm: float
    sense: float
    terms: tuple[tuple[PolygonForce, float], ...]
    torques: tuple[ActingTorque, ...]
    end: str = ""  # The point of the unknown force

    @property
    def value(self) -> float:
        """The unknown force or torque. [N] or [N m]"""
        known = sum(force.size * arm for force, arm in self.terms) + sum(load.torque for load in self.torques)
        return -self.sense * known / self.arm


class _Forces:
    """All forces on the links of a linkage at a crank angle. [deg]"""

    def __init__(self, results: Results, degrees: float) -> None:
        self.mechanism = results.machine.mechanism
        running = operating_state(results.solved, linkage_motion(self.mechanism, CrankGrid.from_degrees([degrees])))
        self.motion, self.loads, self.torques = running.motion, acting_forces(running), acting_torques(running)
        result = joint_forces(running)
        self.reactions: dict[str, Reaction] = {**result.pins, **result.guides}
        self.balancing = first_value(result.balancing_torque)
        self.joints, self.pivots = joints(self.mechanism), names_of_pivots(self.mechanism)

    def on_link(self, link: str) -> Iterator[tuple[PolygonForce, Array]]:
        """Yield loads, weights and inertia forces on a link, and where they act. [m]"""
        for load in self.loads:
            if load.link == link:
                x, y = load.force.tolist()
                yield PolygonForce(load.kind, link, x, y, load.before), place_of(load.point)

    def of_joint(self, joint: Joint, link: str, about: Array | None = None) -> tuple[PolygonForce, float]:
        """Return what a joint does to one of its links, and its moment about a place. [N m]"""
        reaction = self.reactions[joint.name]
        x, y, moment = map(first_value, reaction_wrench(reaction, self.motion, link))
        arm = place_of(self.motion.frames[link].origin) - about if about is not None else np.zeros(2)
        kind: Literal["pin", "guide"] = "pin" if isinstance(reaction, PinForce) else "guide"
        force = PolygonForce(kind, self.pivots.get(joint.name, joint.name), x, y)
        return force, moment + float(arm[0] * y - arm[1] * x)

    def equation(self, link: str, about: Joint, without: Collection[Joint], unknown: Joint) -> MomentEquation | None:
        """Return the moments on a link about a joint, of which that of another one follows; None where it has none."""
        place, point = self.place(about), getattr(about, "point", "")
        force, moment = self.of_joint(unknown, link, place)
        if isinstance(unknown, Pin):
            return MomentEquation(link, point, "pin", force.name, float(np.hypot(*(self.place(unknown) - place))), 1.0,
                                  *self.known(link, place, without, unknown), unknown.point)  # fmt: skip
        normal = first_value(getattr(self.reactions[unknown.name], "normal", 0.0))
        arm, known = moment / normal if normal else 0.0, self.known(link, place, without, unknown)
        if abs(arm) < _NEGLIGIBLE or not any(known):
            return None
        return MomentEquation(link, point, "guide", force.name, abs(arm), float(np.sign(arm)), *known)

    def place(self, joint: Joint) -> Array:
        """Return where a joint is. [m]"""
        return place_of(joint_place(joint, self.motion))

    def known(
        self, link: str, about: Array, without: Collection[Joint], other: Joint
    ) -> tuple[tuple[tuple[PolygonForce, float], ...], tuple[ActingTorque, ...]]:
        """Return forces on a link without some joints with their arms about a place, and the torques on it.

        Arms and torques that are rounding are left out; `other`: a joint of the link, whose distance is of its size.
        """
        span = float(np.hypot(*(self.place(other) - about)))
        pairs = [(force, place - about) for force, place in self.on_link(link)]
        moments = [(force, float(arm[0] * force.y - arm[1] * force.x)) for force, arm in pairs]
        moments += [
            self.of_joint(joint, link, about)
            for joint in self.joints if link in (joint.link, joint.other) and joint not in without
        ]  # fmt: skip
        arms = tuple((force, moment / force.size) for force, moment in moments if force.size)
        most = span * max((force.size for force, _ in arms), default=0.0)
        return (
            tuple((force, arm) for force, arm in arms if abs(arm) > _NEGLIGIBLE * span),
            tuple(load for load in self.torques if load.link == link and abs(load.torque) > _NEGLIGIBLE * most),
        )


def _has_separate_groups(results: Results) -> bool:
    """Return whether each group has its own equilibrium: a driver between links is in one with them."""
    mechanism = results.machine.mechanism
    is_within = isinstance(mechanism.driver, Cylinder | LinkMotor)
    return not (is_within or mechanism.passages or results.machine.redundant)


def loads_on_links(results: Results, degrees: float) -> tuple[list[ActingForce], list[ActingTorque]]:
    """Return what acts on the links besides their joints at a crank angle. [deg]"""
    forces = _Forces(results, degrees)
    return forces.loads, forces.torques


def moment_equations(results: Results, degrees: float) -> list[MomentEquation]:
    """Return the equations of moments of the groups, from the last one to the crank, at a crank angle. [deg]"""
    return list(_equations(_Forces(results, degrees))) if _has_separate_groups(results) else []


def _equations(forces: _Forces) -> Iterator[MomentEquation]:
    for group in reversed(forces.mechanism.dyads):
        links = group_links(group)
        own = [joint for joint in forces.joints if joint.link in links]
        known: tuple[tuple[str, Joint, Joint], ...]
        match group:
            case RRR():
                known = (group.link_a, own[1], own[0]), (group.link_b, own[1], own[2])
            case RRP():
                known = ((group.link, own[1], own[0]),)
            case RPR():
                known = ((group.link, own[2], own[1]),)
            case _:
                continue
        solved = (forces.equation(link, about, own, unknown) for link, about, unknown in known)
        yield from (equation for equation in solved if equation is not None)
    yield from _of_crank(forces)


def _of_crank(forces: _Forces) -> Iterator[MomentEquation]:
    """Yield the equation of moments about the pivot of a crank alone on its shaft."""
    driver = forces.mechanism.driver
    if not isinstance(driver, Crank) or driver.geared or not forces.balancing:
        return
    pivot = forces.joints[0]
    pin = next((joint for joint in forces.joints if joint != pivot and driver.link in (joint.link, joint.other)), pivot)
    terms, torques = forces.known(driver.link, forces.place(pivot), [pivot], pin)
    name = forces.pivots.get(pivot.name, pivot.name)
    equation = MomentEquation(driver.link, name, "driver", "", 1.0, 1.0, terms, torques)
    equation = equation._replace(sense=float(np.sign(equation.value * forces.balancing)))
    if abs(equation.value - forces.balancing) <= 1e-6 * abs(forces.balancing):
        yield equation


def force_plans(results: Results, degrees: float) -> list[ForcePolygon]:
    """Return the plans of all groups, from the last to the driver, at a crank angle [deg].

    None of a linkage that a cylinder or a motor between links drives: its groups include the driver.
    """
    if not _has_separate_groups(results):
        return []
    solved, mechanism = _Forces(results, degrees), results.machine.mechanism
    across = {equation.unknown: equation for equation in _equations(solved) if equation.kind == "pin"}

    def at_joint(joint: Joint, link: str) -> PolygonForce:
        force, _ = solved.of_joint(joint, link)
        equation = across.get(force.name)
        if equation is None or equation.link != link:
            return force
        ends = [place_of(solved.motion.points[name]) for name in (equation.point, equation.end)]
        (x, y), value = (ends[1] - ends[0]) / equation.arm, equation.value
        return force._replace(across=(-y * value, x * value))

    def on_group(links: tuple[str, ...]) -> Iterator[PolygonForce]:
        held = [(joint, [link for link in (joint.link, joint.other) if link in links]) for joint in solved.joints]
        outer = [at_joint(joint, inside[0]) for joint, inside in held if len(inside) == 1 and joint.link in links]
        first = [force for force in outer if force.across is not None][:1]
        yield from first
        yield from (force for force, _ in chain.from_iterable(map(solved.on_link, links)))
        yield from (at_joint(joint, inside[0]) for joint, inside in held
                    if len(inside) == 1 and joint.link not in links)  # fmt: skip
        yield from (force for force in outer if force not in first)
        if isinstance(mechanism.driver, DrivingSlider) and mechanism.driver.link in links:
            pushed = float(results.columns_at(np.array([degrees]), ["driver_force"])["driver_force"][0])
            cos, sin = map(first_value, solved.motion.frames[mechanism.driver.link][1:3])
            yield PolygonForce("driver", mechanism.driver.link, pushed * cos, pushed * sin)

    driven = tuple(name for name in solved.motion.frames if name not in _of_groups(results) and name != GROUND)
    plans = []
    for links in (*(group_links(group) for group in reversed(mechanism.dyads)), driven):
        forces = tuple(on_group(links))
        most = max((force.size for force in forces), default=0.0)
        if most > 0:
            plans.append(ForcePolygon(links, tuple(force for force in forces if force.size > _NEGLIGIBLE * most)))
    return plans


def constructed_forces(
    results: Results, plan: ForcePolygon, solved: Collection[str], scale: float, precision: float
) -> dict[PolygonForce, float]:
    """Return how long the forces are on a plan at a scale [N/mm], read and laid off to a precision. [mm], [mm]

    Loads, forces of joints in `solved`, and what the moments of a link give across it, are laid off; where the lines of
    the two forces that are left cross, or the plan closes, is what they come to. Empty where that is not enough.
    """
    mechanism = results.machine.mechanism
    group = next((dyad for dyad in mechanism.dyads if {*group_links(dyad)} == {*plan.links}), None)
    points = {pin.name: pin.point for pin in joints(mechanism) if isinstance(pin, Pin)}
    points |= {shown: points[name] for name, shown in names_of_pivots(mechanism).items() if name in points}

    def rounded(length: float) -> float:
        return round(length / precision) * precision

    drawn, lines, pivot = list[complex](), list[tuple[int, complex]](), getattr(group, "pivot", "")
    for index, force in enumerate(plan.forces):
        vector, point = complex(force.x, force.y) / scale, points.get(force.name, "")
        if force.kind in ("pin", "guide") and force.name not in solved:
            if force.across is not None:
                known = complex(*force.across) / scale
                along = vector - known if abs(vector - known) > _NEGLIGIBLE * abs(vector) else 1j * known
                lines.append((index, along / abs(along)))
                vector = known
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
    return {force: rounded(abs(end)) for force, end in zip(plan.forces, drawn, strict=True)}


def _of_groups(results: Results) -> set[str]:
    return {link for group in results.machine.mechanism.dyads for link in group_links(group)}
