"""The bearings in the pins of a linkage whose crank turns fully: loads in the frames of crank and rods, and wear."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from crankwork.analysis.bearing_loads import (
    WEAR_STEP,
    hole_of,
    load_values,
    loads_listing,
    reversal_values,
    wear_listing,
    wear_table,
)
from crankwork.analysis.results import Listing
from crankwork.cylinders.load_vectors import BearingLoad
from crankwork.dynamics.dyad_forces import force_across, force_along
from crankwork.dynamics.link_loads import arm
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.expression import Value, formula
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import TracedValue, given, total
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import Motion
from crankwork.machine import Machine
from crankwork.mechanism.joints import Pin, SlidingJoint, joints, names_of_pivots
from crankwork.mechanism.linkage import GROUND
from crankwork.mechanism.mechanism import Crank

FORCES = ("crankpin_radial_force", "crankpin_tangential_force", "crankpin_load")
# columns whose extremes have other keys
FOLLOWED = ("bearing_force_x", "crankpin_load")
_X, _Y = "bearing_force_x", "bearing_force_y"
_OF_CRANKPIN = {
    "mean_crankpin_load": "mean_bearing_load", "crankpin_load_max": "bearing_load_max",
    "crankpin_load_max_angle": "bearing_load_max_angle",
}  # fmt: skip


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
        return {key: components[key] for name in (*self.crankpins, *self.journals) for key in _keys(self, name)}

    def followed(self, kept: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
        """Return further columns that single values are taken from, of the bearings whose joint forces are kept."""
        usable = [
            name
            for name in self.loads
            if all(f"joint_force.{joint}" in kept for joint in self.crankpins.get(name, (name,)))
        ]
        values = {key: self.columns[key] for name in usable if (key := self.loads[name]) not in kept}
        return values | {f"{_X}.{name}": self.between[f"{_X}.{name}"] for name in usable if name in self.reversing}


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
        columns |= _on_crankpin(point, names, frame, forces)
        if len(names) == 1:
            columns[f"crankpin_load.{point}"] = trace[f"joint_force.{names[0]}"]
        else:
            loads[point] = f"crankpin_load.{point}"
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
    point: str, names: Sequence[str], frame: _Frame, forces: Mapping[str, tuple[TracedValue, TracedValue]]
) -> Iterator[tuple[str, TracedValue]]:
    """Yield radial and tangential force of the rods on a crankpin, and of several rods the size of their sum."""
    radial, tangential = "crankpin_radial_force", "crankpin_tangential_force"
    own = {name: f".{name}" if len(names) > 1 else "" for name in names}
    # a joint force is that on the rod, and the pin has the opposite one
    along = [frame.along(*forces[name]).named(f"{radial}.{point}{own[name]}") for name in names]
    across = [frame.opposite.across(*forces[name]).named(f"{tangential}.{point}{own[name]}") for name in names]
    load = BearingLoad(-total(f"{radial}.{point}", along), total(f"{tangential}.{point}", across))
    yield f"{radial}.{point}", total(f"{radial}.{point}", along)
    yield f"{tangential}.{point}", load.y
    if len(names) > 1:
        yield f"crankpin_load.{point}", load.resultant


def _components(name: str, frame: _Frame, x: TracedValue, y: TracedValue) -> dict[str, TracedValue]:
    """Return the components of a force in a frame, under the name of its bearing."""
    load = BearingLoad(frame.along(x, y), frame.across(x, y)).named(name)
    return {known.key: known for known in load}


def _rod(joint: Pin, excluded: set[str]) -> str:
    """Return the link of a joint along whose axis its load reverses, of two rods the one that drives; none if none."""
    return next((link for link in (joint.other, joint.link) if link not in excluded), "")


class BearingCycle:
    """What the loads of the bearings of a linkage come to over its cycle, computed when it is asked for.

    `program`: replays, among others, the components of `JointBearings.of_journals`.
    """

    def __init__(self, machine: Machine, bearings: JointBearings, over: CycleInterpolant, program: Program) -> None:
        self._machine, self._bearings, self._over, self._program = machine, bearings, over, program
        # bearings that are loaded, with the column of the size of the load
        self._loads = {
            name: key for name, key in bearings.loads.items() if key in over.columns and not over.is_zero(key)
        }
        self._components = bearings.of_journals

    @cached_property
    def crankpins(self) -> dict[str, TracedValue]:
        """Mean, extremes, pressures, wear and oil hole of each loaded crankpin."""
        names = [name for name in self._bearings.crankpins if name in self._loads]
        values = self._statistics(names)
        for name in names:
            table = self._wear(name)
            values |= {table.key: table}
            hole = hole_of(f"oil_hole_angle.{name}", table, self._traced(name), self._machine.bearings.rays)
            values[hole.key] = hole
        return values

    @cached_property
    def all_bearings(self) -> dict[str, TracedValue]:
        """Mean, extremes, pressures and reversal of every loaded bearing, wear of crankpins and main journals."""
        values = self._statistics(self._loads) | self.crankpins
        for name in self._bearings.reversing:
            if name in self._loads:
                key = f"{_X}.{name}"
                values |= reversal_values(key, self._over, self._over.extremes(key), name)
        tables = (self._wear(name) for name in self._bearings.journals if name in self._loads)
        return values | {table.key: table for table in tables}

    def summary(self) -> dict[str, TracedValue]:
        """Return mean and largest load of each crankpin, and where its oil hole should be."""
        result = dict[str, TracedValue]()
        for name in self._bearings.crankpins:
            if name in self._loads:
                result |= {
                    f"{key}.{name}": self.crankpins[f"{statistic}.{name}"].named(f"{key}.{name}")
                    for key, statistic in _OF_CRANKPIN.items()
                }
                result[f"oil_hole_angle.{name}"] = self.crankpins[f"oil_hole_angle.{name}"]
        return result

    def trace(self) -> dict[str, TracedValue]:
        """Return all of it, with the components that loads are made of."""
        return {**self._bearings.between, **self.all_bearings}

    def listings(self) -> dict[str, Listing]:
        """Return the summary of the loads over the cycle, and the wear of crankpins and main journals."""
        if not self._loads:
            return {}
        result = {"bearing_loads": loads_listing(self.all_bearings, with_reversal=True)}
        owners = {"crankpin_wear": self._bearings.crankpins, "main_wear": self._bearings.journals}
        for listing, names in owners.items():
            tables = {name: self.all_bearings[f"wear_sum.{name}"] for name in names if name in self._loads}
            if tables:
                result[listing] = wear_listing(tables, self._machine.bearings.rays)
        return result

    def _statistics(self, names: Iterable[str]) -> dict[str, TracedValue]:
        keys = {name: self._loads[name] for name in names}
        extremes, values = self._over.extremes(*keys.values()), dict[str, TracedValue]()
        for name, key in keys.items():
            values |= load_values(name, key, self._over, extremes, _size(self._machine, name))
        return values

    @cached_property
    def _at_steps(self) -> dict[str, Array]:
        """The components of loads at the steps of wear diagrams. [N]"""
        steps = CrankGrid.from_degrees(np.arange(0.0, self._machine.cycle, WEAR_STEP))
        return dict(zip(self._components, self._program.rows(steps, self._components), strict=True))

    def _traced(self, name: str) -> tuple[TracedValue, TracedValue]:
        along, across = _keys(self._bearings, name)
        return self._components[along], self._components[across]

    def _wear(self, name: str) -> TracedValue:
        along, across = (self._at_steps[key] for key in _keys(self._bearings, name))
        load = BearingLoad(along if name in self._bearings.journals else -along, across)
        return wear_table(f"wear_sum.{name}", load, self._traced(name), self._machine.bearings.rays)


def _size(machine: Machine, name: str) -> tuple[TracedValue, TracedValue] | None:
    """Return diameter and length of a bearing, if both are stated."""
    stated = machine.bearings.pins.get(name)
    if stated is None or stated.diameter is None or stated.length is None:
        return None
    path = f"bearings.pins.{name}"
    return (
        given(f"bearing_diameter.{name}", stated.diameter, f"{path}.diameter"),
        given(f"bearing_length.{name}", stated.length, f"{path}.length"),
    )


def _keys(bearings: JointBearings, name: str) -> tuple[str, str]:
    """Return the keys of the components of the load of a crankpin or a main journal."""
    kinds = (_X, _Y) if name in bearings.journals else FORCES[:2]
    return f"{kinds[0]}.{name}", f"{kinds[1]}.{name}"
