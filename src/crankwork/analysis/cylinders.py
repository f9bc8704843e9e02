"""All cylinders of an engine: each is the one-cylinder engine at its own crank angle, traced once per kind."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.analysis.prepared import PreparedCylinder, prepare, prepare_articulated
from crankwork.cylinders.articulated import ArticulatedRod
from crankwork.cylinders.layout import CylinderPlace, Layout
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import TracedValue, delayed
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.machine import Engine, Machine
from crankwork.mechanism.mechanism import slider_crank


@dataclass(frozen=True, eq=False)
class MultiCylinderEngine:
    """A prepared engine: the crank gear of every cylinder by number; equal ones are the same object."""

    machine: Machine
    engine: Engine
    cylinders: tuple[PreparedCylinder, ...]

    def of(self, number: int, key: str) -> TracedValue:
        """Return a column of a cylinder at the crank angle of cylinder 1, under its key and the number."""
        if (number, key) not in self._delayed:
            delay = self.layout.places[number - 1].firing_angle
            name = f"{key}.{number}" if len(self.cylinders) > 1 else key
            known = self.cylinders[number - 1].trace[key]
            self._delayed[number, key] = delayed(known, delay, self.layout.cycle, name)
        return self._delayed[number, key]

    @cached_property
    def _delayed(self) -> dict[tuple[int, str], TracedValue]:
        return {}

    def has(self, key: str) -> tuple[int, ...]:
        """Return the numbers of the cylinders that have a column."""
        return tuple(number for number, cylinder in enumerate(self.cylinders, start=1) if key in cylinder.trace)

    def each(self, key: str, degrees: ArrayLike) -> Array:
        """Return a column of every cylinder at crank angles of cylinder 1, shape (cylinders, n). [SI]"""
        columns = [self.of(number, key) for number in range(1, len(self.cylinders) + 1)]
        return self.each_of(key, Program({column.key: column for column in columns})(CrankGrid.from_degrees(degrees)))

    def each_of(self, key: str, columns: Mapping[str, Array]) -> Array:
        """Return a column of every cylinder, shape (cylinders, n), out of columns of the whole engine. [SI]"""
        return np.stack([columns[self.of(number, key).key] for number in range(1, len(self.cylinders) + 1)])

    @property
    def is_uniform(self) -> bool:
        """Whether all cylinders are the same object, with the same results."""
        return len(set(map(id, self.cylinders))) == 1

    @property
    def has_equal_motion(self) -> bool:
        """Whether the piston of every cylinder moves as that of the first does."""
        return len({(cylinder.lengths, cylinder.articulated_rod) for cylinder in self.cylinders}) == 1

    @property
    def layout(self) -> Layout:
        """Positions and firing angles of the cylinders."""
        return self.engine.layout

    @property
    def master(self) -> PreparedCylinder:
        """Cylinder 1."""
        return self.cylinders[0]

    @property
    def masses(self) -> CrankGearMasses:
        """Masses of one crank gear, zero where none are known."""
        return self.machine.masses or CrankGearMasses()

    @property
    def each_masses(self) -> tuple[CrankGearMasses, ...]:
        """The masses of every cylinder by number: piston and rod, and the throw with the first on it."""
        return tuple(cylinder.machine.masses or CrankGearMasses() for cylinder in self.cylinders)

    @cached_property
    def on_pin(self) -> dict[int, tuple[CylinderPlace, ...]]:
        """The cylinders of each crankpin."""
        pins = sorted({place.crankpin for place in self.layout.places})
        return {pin: tuple(place for place in self.layout.places if place.crankpin == pin) for pin in pins}


def multi_cylinder_engine(solved: PreparedCylinder) -> MultiCylinderEngine:
    """Return the engine that a solved crank gear is the first cylinder of."""
    machine = solved.machine
    engine = machine.engine
    if engine is None:
        raise TypeError("this machine is one crank gear only")
    kinds, each = dict[_Kind, PreparedCylinder](), list[PreparedCylinder]()
    for index in range(len(engine.layout.places)):
        kind = _kind(machine, engine, index)
        if kind not in kinds:
            kinds[kind] = solved if index == 0 else _of_kind(solved, engine, kind)
        each.append(kinds[kind])
    return MultiCylinderEngine(machine, engine, tuple(each))


class _Kind(NamedTuple):
    """Key of cylinders that share results: rod, offset, gas and, where they matter, lean and share of a throw."""

    articulated_rod: ArticulatedRod | None
    offset: float | None
    gas: int  # First index among the gases of the engine
    lean: float = 0.0
    is_first: bool = True


def _of_kind(solved: PreparedCylinder, engine: Engine, kind: _Kind) -> PreparedCylinder:
    """Return a cylinder of an engine, made ready from its first."""
    machine = _own_machine(solved.machine, kind.articulated_rod, is_first=kind.is_first)
    solved = replace(solved, lean=kind.lean)
    if kind.gas:
        machine = replace(machine, gas=engine.gases[kind.gas])
    if kind.articulated_rod is not None:
        return prepare_articulated(replace(solved, machine=machine), kind.articulated_rod)
    if kind.offset not in (None, solved.lengths.offset):
        sizes = solved.lengths._replace(offset=kind.offset)
        return replace(prepare(replace(machine, mechanism=slider_crank(*sizes)), solved.method), lean=kind.lean)
    return replace(prepare(machine, solved.method), lean=kind.lean) if kind.gas else replace(solved, machine=machine)


def _kind(machine: Machine, engine: Engine, index: int) -> _Kind:
    """Return the kind of a cylinder.

    With weight or a changing speed a bank leans by its own angle, and the mass of a throw counts for the first
    cylinder on it only.
    """
    places, articulated_rod = engine.layout.places, engine.articulated_rods[index] if engine.articulated_rods else None
    offset = engine.offsets[index] if engine.offsets else None
    gas = next((item for item, gas in enumerate(engine.gases) if gas is engine.gases[index]), 0)
    if not (machine.has_gravity or machine.angular_acceleration):
        return _Kind(articulated_rod, offset, gas)
    first = next(place for place in places if place.throw == places[index].throw)
    return _Kind(articulated_rod, offset, gas, places[index].axis - places[0].axis, places[index] is first)


def _own_machine(machine: Machine, articulated_rod: ArticulatedRod | None, *, is_first: bool) -> Machine:
    """Return the machine with the masses of one cylinder, those of an articulated rod if it has one."""
    if articulated_rod is not None and machine.masses is not None:
        own = machine.engine.articulated_masses if machine.engine is not None else None
        parts = ("rod_small_end", "rod_big_end", "rod_inertia_excess")
        rod = {"rod_inertia_excess": 0.0} if own is None else {part: getattr(own, part) for part in parts}
        machine = replace(machine, masses=replace(machine.masses, **rod))
    if not is_first and machine.masses is not None:
        machine = replace(machine, masses=replace(machine.masses, crank=0.0))
    return machine
