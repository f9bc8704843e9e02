"""The chambers of a linkage: work, mean pressure and power of their gas, and its work found a second way."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis.results import Results
from crankwork.dynamics.reduction import reduced_torque
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import TracedValue, absent, breakpoints_of, given, total
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import Motion
from crankwork.kinematics.traced_motion import traced_mechanism
from crankwork.loads import gas
from crankwork.loads.chamber import Chamber, own_cycle
from crankwork.loads.chamber_gas import ChamberGas, rate_by_angle, stated_valves
from crankwork.loads.valves import inlet_flow, isothermal_efficiency
from crankwork.preparation.cylinder_gas import cycle_values
from crankwork.preparation.linkage import speed_of
from crankwork.preparation.prepared import PreparedLinkage

_STEP = 1.0
# behind a corner of the pressure, where there may be a jump [deg]
_AFTER = 1e-6


def gas_summary(solved: PreparedLinkage) -> dict[str, TracedValue]:
    """Return the single values of the gas in each chamber, and work and power of all of it."""
    chambers, values = solved.machine.chambers, dict(solved.filling.singles)
    for name in chambers:
        power = _per_time(solved, name)(values[f"indicated_work.{name}"])
        values[f"indicated_power.{name}"] = power.named(f"indicated_power.{name}")
    if chambers:
        values["indicated_power"] = total("indicated_power", [values[f"indicated_power.{name}"] for name in chambers])
    return values | _cycle(solved) | _delivery(solved, values)


def _cycle(solved: PreparedLinkage) -> dict[str, TracedValue]:
    """Return the values of the first calculated cycle; of a crankshaft its engine form tells them."""
    calculated = solved.filling.calculated
    if not calculated or solved.machine.shaft is not None:
        return {}
    return cycle_values(next(iter(calculated.values())).trace)


def _per_time(solved: PreparedLinkage, name: str) -> Callable[[TracedValue], TracedValue]:
    """Return the factor from the work of a cycle of a chamber to its power, or from a volume to a flow."""
    chamber, law = solved.machine.chambers[name], solved.machine.mechanism.driver.law
    if law is not None:
        period = given("period", law.period, "driver.period")
        return lambda item: item / period
    w = speed_of(solved.machine)
    cycle = given(f"cycle_angle.{name}", math.radians(chamber.cycle), f"chambers.{name}.period")
    again = own_cycle(chamber, solved.machine.mechanism.period) / chamber.cycle
    full_cycle = cycle if again == 1 else again * cycle.named(f"cycle_angle.{name}.stated")
    is_work = gas.indicated_power
    return lambda item: (inlet_flow if item.key.startswith("induced") else is_work)(item, w, full_cycle)


def _delivery(solved: PreparedLinkage, values: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return the flow through the valves of each chamber; of several also the intake of the first stage and sums."""
    chambers, none = solved.machine.chambers, absent("clearance_volume")
    result = dict[str, TracedValue]()
    valved = {name: value.valves for name, value in chambers.items() if value.valves is not None}
    for name in valved:
        stated = stated_valves(f"chambers.{name}", chambers[name])
        if stated is not None:
            clearance, swept = values.get(f"clearance_volume.{name}", none), values[f"swept_volume.{name}"]
            power = values[f"indicated_power.{name}"]
            result |= stated.delivery(clearance, swept, power, _per_time(solved, name))
    if len(valved) > 1:
        lowest = min(value.suction for value in valved.values())
        first = [name for name, value in valved.items() if value.suction == lowest]
        for key in ("inlet_flow", "gas_mass_flow", "free_air_delivery"):
            result |= _together(key, first, result)
        if len(valved) == len(chambers):
            result |= _together("isothermal_power", list(valved), result)
        if "isothermal_power" in result and values["indicated_power"].value:
            efficiency = isothermal_efficiency(result["isothermal_power"], values["indicated_power"])
            result["isothermal_efficiency"] = efficiency
    if solved.machine.stages is not None:
        # few machines have them
        from crankwork.preparation.stages import stage_values  # noqa: PLC0415 - loaded where it is needed

        result |= stage_values(solved.machine, solved.machine.stages, {**values, **result})
    return result


def _together(key: str, names: Sequence[str], values: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return the sum of a value over several chambers, empty if one of them lacks it."""
    parts = [values[f"{key}.{name}"] for name in names if f"{key}.{name}" in values]
    return {key: total(key, parts)} if len(parts) == len(names) else {}


class Indicator(NamedTuple):
    """Volume and pressure of a chamber over its cycle and back to its beginning, shape (n,). [m3], [Pa], [deg]"""

    volume: Array
    pressure: Array
    degrees: Array


def indicators(results: Results) -> dict[str, Indicator]:
    """Return the indicator diagrams of the chambers by name, with both sides of every jump."""
    machine, values = results.machine, {}
    for name in machine.chambers:
        keys = (f"cylinder_volume.{name}", f"diagram_pressure.{name}")
        corners = breakpoints_of((results.trace[key] for key in keys), machine.cycle)
        fine = np.concatenate([np.arange(0.0, machine.cycle, _STEP), corners, corners[:-1] + _AFTER])
        degrees = np.unique(fine)
        columns = results.columns_at(degrees, keys)
        volume, pressure = (np.append(columns[key], columns[key][0]) for key in keys)
        values[name] = Indicator(volume, pressure, np.append(degrees, machine.cycle))
    return values


def _against(filling: ChamberGas, chambers: Mapping[str, Chamber], period: float) -> dict[str, float]:
    """Return the work on the surroundings of each chamber over its cycle, zero if its volume returns. [J]"""
    cycles = {name: own_cycle(chamber, period) for name, chamber in chambers.items()}
    degrees = sorted({0.0, *cycles.values()})
    volumes = Program({name: filling.columns[f"cylinder_volume.{name}"] for name in chambers})
    columns = volumes(CrankGrid.from_degrees(degrees))
    return {
        name: chamber.factor * chamber.ambient * float(columns[name][degrees.index(cycles[name])] - columns[name][0])
        for name, chamber in chambers.items()
    }


def gas_check(solved: PreparedLinkage, motion: Motion) -> dict[str, float]:
    """Return how far the work of the gas by pressure and volume is from that of its torque on the crank."""
    machine, filling = solved.machine, solved.filling
    if not filling.forces:
        return {}
    mechanism = traced_mechanism(machine.mechanism, machine.linkage)
    torque: TracedValue = reduced_torque(motion, filling.loads(mechanism, motion))
    if machine.mechanism.driver.law is not None:
        torque = torque * rate_by_angle(motion, machine.mechanism.driver.law)
    over = CycleInterpolant({"": torque}, CrankGrid.from_degrees, machine.cycle)
    work, against = 0.0, _against(filling, machine.chambers, machine.mechanism.period)
    for name, value in machine.chambers.items():
        cycle = own_cycle(value, machine.mechanism.period)
        done = filling.singles[f"indicated_work.{name}"].value - against[name]
        work += done * machine.cycle / cycle
    by_pressures = _work_of_valves(solved)
    largest, least = over.extreme_points[""]
    moved = max(largest.value, -least.value) * math.radians(machine.cycle) or 1.0
    return {"work": abs(over.integral("") - work) / moved, **by_pressures}


def _work_of_valves(solved: PreparedLinkage) -> dict[str, float]:
    """Return how far the work of chambers with valves is from that which follows from pressures alone."""
    residuals, singles = list[float](), solved.filling.singles
    for name, value in solved.machine.chambers.items():
        stated = stated_valves(f"chambers.{name}", value)
        # the pressures of valves do not include the work of pipes
        if stated is not None and not stated.valves.has_pipes:
            sizes = [singles[key].value if key in singles else 0.0
                     for key in (f"clearance_volume.{name}", f"swept_volume.{name}")]  # fmt: skip
            work = stated.work(*sizes)
            residuals.append(abs(singles[f"indicated_work.{name}"].value - value.factor * work) / abs(work))
    return {"valves": max(residuals)} if residuals else {}
