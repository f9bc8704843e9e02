"""Curves and diagrams of a whole engine that figures and sheets draw, each computed once, when asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from crankwork.analysis.all_cylinders import EngineTrace
from crankwork.analysis.bearings import AFTER, CrankpinLoad
from crankwork.analysis.cylinder_balance import EngineBalance, engine_balance
from crankwork.analysis.cylinders import MultiCylinderEngine, multi_cylinder_engine
from crankwork.analysis.results import Results
from crankwork.analysis.shaft_torque import EngineTorque, engine_torque
from crankwork.cylinders.counterweights import Ellipse, balance_sum
from crankwork.cylinders.load_vectors import BearingLoad, big_end_inertia_force
from crankwork.cylinders.torque import PhaseStar, phase_star, torques_along_shaft
from crankwork.cylinders.wear import polar_diagram
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import breakpoints_of
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.shaft.fluctuation import ExcessWork, excess_work

_ROUNDING = 1e-9
_STAR_ORDERS = 6
# Loci are of the orders up to this one; higher ones are small.
_LOCI = 2


class Locus(NamedTuple):
    """Closed curve in which a free force of one order runs: its longest [N], its ends across and up [N], shape (n,)."""

    largest: float
    across: Array
    up: Array


def crankpin_of_one(results: Results, degrees: Array, columns: Mapping[str, Array]) -> CrankpinLoad:
    """Return the load of the one rod of a crank gear on its crankpin; the machine may have no engine."""
    inertia = _rod_inertia(results)
    load = BearingLoad(-columns["radial_force"] - inertia, columns["tangential_force"])
    return CrankpinLoad(load.resultant, polar_diagram(load, degrees, results.machine.cycle, inertia), inertia, 1)


def _rod_inertia(results: Results) -> float:
    """Return the inertia force of the mass of one rod at the crankpin, never positive. [N]"""
    solved = results.solved
    mass = solved.machine.masses.rod_big_end if solved.machine.masses is not None else 0.0
    return float(big_end_inertia_force(mass, solved.lengths.crank_radius, solved.speed))


@dataclass(frozen=True)
class EngineDiagrams:
    """Curves and diagrams of a whole engine."""

    results: Results  # Of a machine with an engine whose forces are known

    @property
    def cycle(self) -> float:
        """Length of the cycle. [deg]"""
        return self.results.machine.cycle

    @cached_property
    def engine(self) -> MultiCylinderEngine:
        """The engine."""
        return multi_cylinder_engine(self.results.solved)

    @property
    def count(self) -> int:
        """How many cylinders it has."""
        return len(self.engine.cylinders)

    @property
    def has_throws(self) -> bool:
        """Whether its crankshaft has more than one throw."""
        return len({place.throw for place in self.engine.layout.places}) > 1

    @property
    def is_spread(self) -> bool:
        """Whether cylinders are at different positions along the shaft."""
        return len({place.position for place in self.engine.layout.places}) > 1

    @cached_property
    def torque(self) -> EngineTorque:
        """Torque of one cylinder and of all, and speed."""
        result = EngineTrace.of(self.engine.master)
        return engine_torque(result.engine, result.trace, result.over, result.extremes)

    @cached_property
    def excess(self) -> ExcessWork:
        """What the torque of all cylinders does beyond its mean, that of inertia at constant speed in it."""
        return excess_work(self.torque.total)

    @cached_property
    def degrees(self) -> Array:
        """Crank angles of the torques, on both sides of every corner of the pressure. [deg]"""
        corners = breakpoints_of([self.results.trace["total_torque"]], self.cycle)
        angles = np.concatenate([np.arange(0.0, self.cycle + 0.5), corners, corners[:-1] + AFTER])
        return np.unique(angles)

    @cached_property
    def torques(self) -> Array:
        """Torque of every cylinder at `degrees`, shape (cylinders, n). [N m]"""
        return self.engine.each("crank_torque", self.degrees)

    def values(self, *keys: str) -> dict[str, Array]:
        """Return columns of the whole engine at `degrees`. [SI]"""
        program = Program({key: self.results.trace[key] for key in keys})
        return dict(program(CrankGrid.from_degrees(self.degrees)))

    @property
    def journal_torques(self) -> Array:
        """Torque on every main journal that carries some, from the second on, at `degrees`. [N m]"""
        return np.asarray(torques_along_shaft(list(self.torques), self.engine.layout).journals[1:])

    def other_pressures(self, degrees: Array) -> dict[int, Array]:
        """Return the gas pressure of the first cylinder of every gas that is not that of cylinder 1, by number. [Pa]

        `degrees`: its own crank angles.
        """
        gases = self.engine.engine.gases
        firsts = [index for index, gas in enumerate(gases) if index and all(gas is not gase for gase in gases[:index])]
        values = Program({str(index): self.engine.cylinders[index].trace["gas_pressure"] for index in firsts})
        return {int(index) + 1: value for index, value in values(CrankGrid.from_degrees(degrees)).items()}

    @cached_property
    def balance(self) -> EngineBalance:
        """Free forces and moments."""
        return engine_balance(self.engine)

    @cached_property
    def loci(self) -> dict[int, tuple[Locus, Locus]]:
        """The forces of each order of cylinders and cranks, and the residual, unless both are negligible."""
        balance = self.balance
        before = {item.order: item.force for item in balance_sum((*balance.reciprocating, balance.rotating))}
        after = {item.order: item.force for item in balance.residual}
        least = _ROUNDING * self.engine.masses.reciprocating * self.engine.master.lengths.crank_radius
        least *= self.engine.master.speed**2
        return {
            order: (_locus(value), _locus(after[order]))
            for order, value in before.items()
            if order <= _LOCI and max(value.largest, after[order].largest) > least
        }

    @property
    def phase_stars(self) -> list[PhaseStar]:
        """The phase stars of the orders up to 6."""
        step = 360 / self.cycle
        return [phase_star(self.engine.layout, step * k) for k in range(1, round(_STAR_ORDERS / step) + 1)]


def _locus(ellipse: Ellipse) -> Locus:
    points = ellipse.outline()
    return Locus(ellipse.largest, points.imag, points.real)
