"""All cylinders of an engine: each is the one-cylinder engine at its own crank angle, traced once per kind."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from crankwork.analysis.cylinder_forces import TracedCylinder
from crankwork.cylinders.layout import CylinderPlace, Layout
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import TracedValue, delayed
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.machine import Engine, Machine
from crankwork.preparation.cylinders import each_cylinder


@dataclass(frozen=True, eq=False)
class MultiCylinderEngine:
    """A prepared engine: the crank gear of every cylinder by number; equal ones are the same object."""

    machine: Machine
    engine: Engine
    cylinders: tuple[TracedCylinder, ...]

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
    def master(self) -> TracedCylinder:
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


def multi_cylinder_engine(solved: TracedCylinder) -> MultiCylinderEngine:
    """Return the engine that a solved crank gear is the first cylinder of."""
    if solved.machine.engine is None:
        raise TypeError("this machine is one crank gear only")
    return MultiCylinderEngine(solved.machine, solved.machine.engine, each_cylinder(solved))
