"""The crank gear of every cylinder of an engine: the one of cylinder 1 with what each has of its own."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple, TypeVar

from crankwork.cylinders.articulated import ArticulatedRod
from crankwork.machine import Engine, Machine
from crankwork.mechanism.mechanism import slider_crank
from crankwork.preparation.prepared import PreparedCylinder, prepare, prepare_articulated

_Cylinder = TypeVar("_Cylinder", bound=PreparedCylinder)


class OwnCylinder(NamedTuple):
    """What cylinders share that have the same results: rod, offset, gas and, where they matter, lean and throw."""

    articulated_rod: ArticulatedRod | None
    offset: float | None
    gas: int  # First index among the gases of the engine
    lean: float = 0.0
    is_first: bool = True

    def machine(self, machine: Machine, engine: Engine) -> Machine:
        """Return the machine of one cylinder: its masses, its gas and its lengths."""
        machine = _with_own_masses(machine, self.articulated_rod, is_first=self.is_first)
        if self.gas:
            machine = replace(machine, gas=engine.gases[self.gas])
        if machine.lengths is not None and self.offset not in (None, machine.lengths.offset):
            machine = replace(machine, mechanism=slider_crank(*machine.lengths._replace(offset=self.offset)))
        return machine


def each_cylinder(solved: _Cylinder) -> tuple[_Cylinder, ...]:
    """Return the crank gear of every cylinder of the engine of which a solved one is the first; equal ones are one."""
    engine = solved.machine.engine
    if engine is None:
        return (solved,)
    kinds, each = dict[OwnCylinder, _Cylinder](), list[_Cylinder]()
    for index in range(len(engine.layout.places)):
        own = own_cylinder(solved.machine, engine, index)
        if own not in kinds:
            kinds[own] = solved if index == 0 else _made_ready(solved, engine, own)
        each.append(kinds[own])
    return tuple(each)


def _made_ready(solved: _Cylinder, engine: Engine, own: OwnCylinder) -> _Cylinder:
    """Return a cylinder of an engine, made ready from its first."""
    machine = own.machine(solved.machine, engine)
    if own.articulated_rod is not None:
        return prepare_articulated(replace(solved, machine=machine, lean=own.lean), own.articulated_rod)
    if own.gas or machine.mechanism is not solved.machine.mechanism:
        solved = prepare(machine, solved.method, type(solved))
    return replace(solved, machine=machine, lean=own.lean)


def own_cylinder(machine: Machine, engine: Engine, index: int) -> OwnCylinder:
    """Return what a cylinder has of its own.

    With weight or a changing speed a bank leans by its own angle, and the mass of a throw counts for the first
    cylinder on it only.
    """
    places, articulated_rod = engine.layout.places, engine.articulated_rods[index] if engine.articulated_rods else None
    offset = engine.offsets[index] if engine.offsets else None
    gas = next((item for item, gas in enumerate(engine.gases) if gas is engine.gases[index]), 0)
    if not (machine.has_gravity or machine.angular_acceleration):
        return OwnCylinder(articulated_rod, offset, gas)
    first = next(place for place in places if place.throw == places[index].throw)
    return OwnCylinder(articulated_rod, offset, gas, places[index].axis - places[0].axis, places[index] is first)


def _with_own_masses(machine: Machine, articulated_rod: ArticulatedRod | None, *, is_first: bool) -> Machine:
    """Return the machine with the masses of one cylinder, those of an articulated rod if it has one."""
    if articulated_rod is not None and machine.masses is not None:
        own = machine.engine.articulated_masses if machine.engine is not None else None
        parts = ("rod_small_end", "rod_big_end", "rod_inertia_excess")
        rod = {"rod_inertia_excess": 0.0} if own is None else {part: getattr(own, part) for part in parts}
        machine = replace(machine, masses=replace(machine.masses, **rod))
    if not is_first and machine.masses is not None:
        machine = replace(machine, masses=replace(machine.masses, crank=0.0))
    return machine
