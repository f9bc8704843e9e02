"""The chambers of a linkage: work, mean pressure and power of their gas, and its work found a second way."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from crankwork.analysis.linkage_memory import speed_of
from crankwork.analysis.solved import SolvedLinkage
from crankwork.dynamics.reduction import reduced_torque
from crankwork.formula.known import Known, breaks_of, given, total
from crankwork.formula.over_cycle import OverCycle
from crankwork.formula.replay import Program
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.memory import given_mechanism
from crankwork.kinematics.motion import Motion
from crankwork.loads import gas
from crankwork.loads.chamber import Chamber, own_cycle
from crankwork.loads.filling import Filling, filled, rate_by_angle
from crankwork.machine import Machine

if TYPE_CHECKING:
    from crankwork.analysis.results import Results

_STEP = 1.0
# behind a corner of the pressure, where there may be a jump [deg]
_AFTER = 1e-6


def solve_linkage(machine: Machine, motion: Motion) -> SolvedLinkage:
    """Return a linkage made ready, with the gas in its chambers over its remembered motion."""
    method = machine.method
    speed = machine.speed * method.pi / math.pi
    law = machine.mechanism.driver.law
    period = machine.mechanism.period
    filling = filled(machine.chambers, machine.charges, motion, method.pi, law, period)
    return SolvedLinkage(machine, method, speed, filling)


def gas_summary(solved: SolvedLinkage) -> dict[str, Known]:
    """Return the single values of the gas in each chamber, and work and power of all of it."""
    chambers, found = solved.machine.chambers, dict(solved.filling.singles)
    w, law = speed_of(solved.machine), solved.machine.mechanism.driver.law
    for name, chamber in chambers.items():
        work = found[f"indicated_work.{name}"]
        if law is not None:
            power = work / given("period", law.period, "driver.period")
        else:
            cycle = given(f"cycle_angle.{name}", math.radians(chamber.cycle), f"chambers.{name}.period")
            again = own_cycle(chamber, solved.machine.mechanism.period) / chamber.cycle
            cycle = cycle if again == 1 else again * cycle.named(f"cycle_angle.{name}.stated")
            power = gas.indicated_power(work, w, cycle)
        found[f"indicated_power.{name}"] = power.named(f"indicated_power.{name}")
    if len(chambers) > 1:
        found["indicated_power"] = total("indicated_power", [found[f"indicated_power.{name}"] for name in chambers])
    return found


class Indicator(NamedTuple):
    """Volume and pressure of a chamber over its cycle and back to its beginning, shape (n,). [m3], [Pa]"""

    volume: Array
    pressure: Array


def indicators(results: Results) -> dict[str, Indicator]:
    """Return the indicator diagrams of the chambers by name, with both sides of every jump."""
    machine, found = results.machine, {}
    for name in machine.chambers:
        keys = (f"cylinder_volume.{name}", f"diagram_pressure.{name}")
        corners = breaks_of((results.memory[key] for key in keys), machine.cycle)
        fine = np.concatenate([np.arange(0.0, machine.cycle, _STEP), corners, corners[:-1] + _AFTER])
        columns = results.columns_at(np.unique(fine), keys)
        found[name] = Indicator(*(np.append(columns[key], columns[key][0]) for key in keys))
    return found


def _against(filling: Filling, name: str, chamber: Chamber, cycle: float) -> float:
    """Return the work on what is around a chamber, nothing where its volume comes back. [J]"""
    ends = Program({"": filling.columns[f"cylinder_volume.{name}"]})(CrankGrid.from_degrees([0.0, cycle]))[""]
    return chamber.factor * chamber.ambient * float(ends[1] - ends[0])


def gas_check(solved: SolvedLinkage, motion: Motion) -> dict[str, float]:
    """Return how far the work of the gas by pressure and volume is from that of its torque on the crank."""
    machine, filling = solved.machine, solved.filling
    if not filling.forces:
        return {}
    mechanism = given_mechanism(machine.mechanism, machine.linkage)
    torque: Known = reduced_torque(motion, filling.loads(mechanism, motion))
    if machine.mechanism.driver.law is not None:
        torque = torque * rate_by_angle(motion, machine.mechanism.driver.law)
    over = OverCycle({"": torque}, CrankGrid.from_degrees, machine.cycle)
    work = 0.0
    for name, one in machine.chambers.items():
        cycle = own_cycle(one, machine.mechanism.period)
        done = filling.singles[f"indicated_work.{name}"].value - _against(filling, name, one, cycle)
        work += done * machine.cycle / cycle
    largest, least = over.largest_and_least[""]
    moved = max(largest.value, -least.value) * math.radians(machine.cycle) or 1.0
    return {"work": abs(over.integral("") - work) / moved}
