"""The bearings in the pins of a linkage whose crank turns fully: loads in the frames of crank and rods, and wear."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from crankwork.analysis.bearings import IN_FRAME, ON_CRANKPIN, Bearing, bearing_size, loads_on_crankpin
from crankwork.cylinders.load_vectors import BearingLoad
from crankwork.dynamics.dyad_forces import force_across, force_along
from crankwork.dynamics.link_loads import arm
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import TracedValue
from crankwork.kinematics.motion import Motion
from crankwork.machine import Machine
from crankwork.mechanism.joints import Pin, SlidingJoint, joints, names_of_pivots
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Crank

# columns whose extremes have other keys
FOLLOWED = (IN_FRAME[0], ON_CRANKPIN[2])


@formula("link_cos", "artobolevsky_1988, ch. 13")
def cosine_of_arm(r_x: Value, r_y: Value) -> Value:
    """Cosine of the direction of an arm; the sine with its components exchanged."""
    return r_x / np.sqrt(r_x**2 + r_y**2)


class _Frame(NamedTuple):
    """A direction that turns with a link, and whether a quarter turn further is to its left or its right."""

    cos: TracedValue
    sin: TracedValue
    side: int

    def along(self, x: TracedValue, y: TracedValue) -> TracedValue:
        """Return the component of a force along the direction."""
        force: TracedValue = force_along(x, self.cos, y, self.sin)
        return force

    def across(self, x: TracedValue, y: TracedValue) -> TracedValue:
        """Return the component of a force a quarter turn further."""
        force: TracedValue = (
            force_across(y, self.cos, x, self.sin) if self.side > 0 else force_across(x, self.sin, y, self.cos)
        )
        return force

    @property
    def opposite(self) -> _Frame:
        """The direction with the other side."""
        return self._replace(side=-self.side)


@dataclass(frozen=True)
class JointBearings:
    """Loads of the bearings of a linkage; none where its crank does not turn fully or joint forces are unknown."""

    columns: Mapping[str, TracedValue] = field(default_factory=dict)  # Loads of crankpins and of pivots of cranks [N]
    between: Mapping[str, TracedValue] = field(default_factory=dict)  # Components in the frames of rods and cranks [N]
    loads: Mapping[str, str] = field(default_factory=dict)  # Column of the size of the load, by bearing
    crankpins: Mapping[str, tuple[str, ...]] = field(default_factory=dict)  # Joints of the rods, by crankpin
    journals: tuple[str, ...] = ()  # Pivots of cranks
    reversing: tuple[str, ...] = ()  # Bearings with a component along a rod

    @property
    def of_journals(self) -> dict[str, TracedValue]:
        """Components of the loads of crankpins and main journals, each in the frame of its crank."""
        components = {**self.columns, **self.between}
        keys = [f"{kind}.{name}" for name in self.crankpins for kind in ON_CRANKPIN[:2]]
        keys += [f"{kind}.{name}" for name in self.journals for kind in IN_FRAME]
        return {key: components[key] for key in keys}

    def loaded(self, machine: Machine, over: CycleInterpolant) -> Iterator[Bearing]:
        """Yield the bearings that are loaded. `over`: their loads over the cycle."""
        for name, load in self.loads.items():
            if load not in over.columns or over.is_zero(load):
                continue
            stated = machine.bearings.pins.get(name)
            sizes = (None, None) if stated is None else (stated.diameter, stated.length)
            yield Bearing(
                name,
                load,
                name,
                name,
                bearing_size(name, *sizes, f"bearings.pins.{name}."),
                is_crankpin=name in self.crankpins,
                is_journal=name in self.journals,
                reversing=f"{IN_FRAME[0]}.{name}" if name in self.reversing else "",
            )

    def followed(self, kept: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
        """Return further columns that single values are taken from, of the bearings whose joint forces are kept."""
        usable = [
            name
            for name in self.loads
            if all(f"joint_force.{joint}" in kept for joint in self.crankpins.get(name, (name,)))
        ]
        values = {key: self.columns[key] for name in usable if (key := self.loads[name]) not in kept}
        reversing = (f"{IN_FRAME[0]}.{name}" for name in usable if name in self.reversing)
        return values | {key: self.between[key] for key in reversing}


def bearings_of(machine: Machine, motion: Motion, trace: Mapping[str, TracedValue]) -> JointBearings:
    """Return the loads of the bearings of a linkage from its joint forces.

    `motion`: traced, of a crank that turns fully; `trace`: the columns of the linkage.
    """
    mechanism, crank = machine.mechanism, machine.mechanism.driver
    if (
        not isinstance(crank, Crank)
        or crank.law is not None
        or not any(key.startswith("joint_force.") for key in trace)
    ):
        return JointBearings()
    shown, held = names_of_pivots(mechanism), joints(mechanism)
    pins = {shown.get(joint.name, joint.name): joint for joint in held if isinstance(joint, Pin)}
    # seen from a crank, with its rotation
    sides: dict[str, int] = {crank.link: crank.direction}
    sides |= {geared.link: crank.direction * (1 if geared.ratio > 0 else -1) for geared in crank.geared}
    forces = {name: (trace[f"joint_force_x.{name}"], trace[f"joint_force_y.{name}"]) for name in pins}
    columns, between, journals = dict[str, TracedValue](), dict[str, TracedValue](), list[str]()
    loads = {name: f"joint_force.{name}" for name in pins}
    crankpins = _crankpins(machine, pins, sides)
    for point, names in crankpins.items():
        carrier = pins[names[0]].other
        frame = _arm(motion, carrier, point, crank)._replace(side=sides[carrier])
        size = trace[f"joint_force.{names[0]}"] if len(names) == 1 else None
        on_pin = {force.key: force for force in _on_crankpin(point, names, frame, forces, size)}
        columns |= on_pin
        if size is None:
            loads[point] = [*on_pin][-1]
    for name, joint in pins.items():
        if joint.link in sides and joint.other == GROUND:
            journals.append(name)
            columns[f"main_journal_load.{name}"] = trace[f"joint_force.{name}"]
            between |= _components(name, _of_link(motion, joint.link, sides[joint.link]), *forces[name])
    reversing = []
    sliding = {joint.link for joint in held if isinstance(joint, SlidingJoint)}
    for name, joint in pins.items():
        stated = machine.bearings.pins.get(name)
        link = (stated.link if stated is not None else "") or _rod(joint, {GROUND, *sides, *sliding})
        if link:
            reversing.append(name)
            x, y = forces[name] if link == joint.link else (-forces[name][0], -forces[name][1])
            between = _components(name, _of_link(motion, link, sides.get(link, 1)), x, y) | between
    columns = {key: known.named(key) for key, known in columns.items()}
    return JointBearings(columns, between, loads, crankpins, tuple(journals), tuple(reversing))


def _crankpins(machine: Machine, pins: Mapping[str, Pin], cranks: Mapping[str, int]) -> dict[str, tuple[str, ...]]:
    """Return the joints of the rods on each pin of a crank, without the pins of redundant links (forces unknown)."""
    extra = {point for link in machine.redundant for point in link.member.points}
    # on the axis of the crank there is no arm
    extra |= {point.name for point in machine.mechanism.points if point.along == point.across == 0}
    crankpins: dict[str, tuple[str, ...]] = {}
    for name, joint in pins.items():
        if joint.other in cranks and joint.point not in extra:
            crankpins[joint.point] = (*crankpins.get(joint.point, ()), name)
    return crankpins


def _arm(motion: Motion, link: str, point: str, crank: Crank) -> _Frame:
    """Return the direction of the arm of a crank from its pivot to a pin."""
    frame = motion.frames[link]
    if link == crank.link and point == crank.pin:
        return _Frame(frame.cos, frame.sin, 1)
    x, y = arm(frame.origin, motion.points[point])
    x, y = x.named(f"arm_x.{point}"), y.named(f"arm_y.{point}")
    return _Frame(
        cosine_of_arm(x, y).named(f"link_cos.{point}.arm"), cosine_of_arm(y, x).named(f"link_sin.{point}.arm"), 1
    )


def _of_link(motion: Motion, link: str, side: int) -> _Frame:
    frame = motion.frames[link]
    return _Frame(frame.cos, frame.sin, side)


def _on_crankpin(
    point: str,
    names: Sequence[str],
    frame: _Frame,
    forces: Mapping[str, tuple[TracedValue, TracedValue]],
    size: TracedValue | None,
) -> Iterator[TracedValue]:
    """Yield radial and tangential force of the rods on a crankpin and the load; `size`: that of a rod that is alone."""
    radial, tangential, _ = ON_CRANKPIN
    own = {name: f".{name}" if len(names) > 1 else "" for name in names}
    # a joint force is that on the rod, and the pin has the opposite one
    rods = [
        (
            frame.along(*forces[name]).named(f"{radial}.{point}{own[name]}"),
            frame.opposite.across(*forces[name]).named(f"{tangential}.{point}{own[name]}"),
        )
        for name in names
    ]
    yield from loads_on_crankpin(point, rods, size)


def _components(name: str, frame: _Frame, x: TracedValue, y: TracedValue) -> dict[str, TracedValue]:
    """Return the components of a force in a frame, under the name of its bearing."""
    load = BearingLoad(frame.along(x, y), frame.across(x, y)).named(name)
    return {known.key: known for known in load}


def _rod(joint: Pin, excluded: set[str]) -> str:
    """Return the link of a joint along whose axis its load reverses, of two rods the one that drives; none if none."""
    return next((link for link in (joint.other, joint.link) if link not in excluded), "")
