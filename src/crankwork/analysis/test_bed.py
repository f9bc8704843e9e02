"""The power of an engine on a test bed: from what was measured, and from sizes and diagram of the engine, if known."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from crankwork.analysis.prepared import PreparedMachine
from crankwork.analysis.results import Results
from crankwork.dynamics.piston_forces import angular_speed
from crankwork.formula.calculation import Calculation
from crankwork.formula.traced_value import ProcedureValue, TracedValue, given, total
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.loads.gas import piston_area
from crankwork.loads.measured_pressure import AMBIENT
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import Crank
from crankwork.working_cycle.test_bed import MEASURED, work_test

# what an engine gives to the analysis of its test, by the names that it has there
_OF_ENGINE = {
    "bore": "bore", "stroke": "stroke", "indicated_power": "indicated_power",
    "indicated_mean_pressure": "indicated_mean_pressure",
}  # fmt: skip


def analyse_test(machine: Machine) -> Results:
    """Return the results of a test of an engine of which only sizes are known (heywood_1988, ch. 2 and 13)."""
    sizes = dict[str, TracedValue]()
    cylinder, driver = machine.cylinder, machine.mechanism.driver
    if cylinder is not None and cylinder.bore:
        sizes["bore"] = given("bore", cylinder.bore, "cylinder.bore")
    if isinstance(driver, Crank) and driver.radius:
        sizes["stroke"] = given("stroke", 2 * driver.radius, "crank.stroke")
    if "crank.speed" in machine.stated:
        sizes |= {value.key: value for value in _speeds(machine)}
    worked = _worked(machine, sizes)
    grid = CrankGrid.from_degrees(np.array([0.0]))
    summary = {key: value.value for key, value in worked.items()}
    return Results(
        PreparedMachine(machine, machine.method, machine.speed),
        grid,
        {},
        summary,
        {},
        (),
        {"test": tuple(worked)},
        trace=worked,
    )


def with_test(results: Results) -> Results:
    """Return the results of an engine with those of its test."""
    trace = results.trace
    solved = results.solved
    own = {name: trace[key].named(name) for key, name in _OF_ENGINE.items() if key in results.summary}
    if results.machine.engine is not None:
        places = results.machine.engine.layout.places
        own["cylinder_count"] = given("cylinder_count", float(len(places)), "engine.cylinders")
    own |= {value.key: value for value in _speeds(results.machine)}
    if solved.space is not None:
        # losses follow the absolute pressure
        peak = trace["gas_pressure_max"].value + (solved.space.ambient or AMBIENT)
        own["cylinder_pressure"] = TracedValue(
            ProcedureValue(peak, "max", (trace["gas_pressure"],)), "cylinder_pressure"
        )
    own["strokes_per_cycle"] = given("strokes_per_cycle", round(results.machine.cycle / 180), "gas.cycle")
    worked = _worked(results.machine, own)
    values = {key: value for key, value in worked.items() if key not in results.summary}
    summary = {**results.summary, **{key: value.value for key, value in values.items()}}
    return replace(
        results, summary=summary, trace={**trace, **values}, groups={**results.groups, "test": tuple(values)}
    )


def _worked(machine: Machine, sizes: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return what follows from a test and the sizes of an engine."""
    worked, test, pi = Calculation(), machine.test or {}, machine.method.pi
    worked.known |= sizes
    for key, numbers in test.items():
        quantity = MEASURED.get(key, key)
        if key != "one_cut":
            worked.given(quantity, numbers[0], f"cylinder.{key}" if key == "displacement" else f"test.{key}")
    worked.known.setdefault("cylinder_count", given("cylinder_count", 1.0))
    if "charge_pressure" in worked.known:
        # dry air
        worked.given("specific_gas_constant", 287.0)
    cylinder = machine.cylinder
    if cylinder is not None and cylinder.piston_rod_diameter:
        rod = given("piston_rod_diameter", cylinder.piston_rod_diameter, "cylinder.piston_rod_diameter")
        worked.keep(piston_area(pi, rod).named("rod_area"))
    elif "crank_side_pressure" in worked.known:
        worked.absent("rod_area")
    if cut := test.get("one_cut"):
        worked.known |= _cut_powers(worked, cut, pi)
    work_test(worked, pi)
    stated = {key: value for key, value in worked.known.items() if key in sizes or not value.is_absent}
    results = {key: value for key, value in worked.found.items() if key not in sizes}
    # in revolutions per minute, as one formula takes it
    return {key: value for key, value in {**stated, **results}.items() if key != "rotational_speed"}


def _speeds(machine: Machine) -> tuple[TracedValue, TracedValue]:
    """Return revolutions per minute and angular speed of the shaft."""
    n = given("rotational_speed", machine.speed * 30 / math.pi, "crank.speed", "rpm")
    speed: TracedValue = angular_speed(machine.method.pi, n)
    return n, speed.named("speed")


def _cut_powers(worked: Calculation, cut: tuple[float, ...], pi: float) -> dict[str, TracedValue]:
    """Return the sum of the brake powers with each cylinder cut out."""
    kind = next(key for key in ("brake_load", "effective_torque", "effective_power") if key in worked.known)
    powers = []
    for number, load in enumerate(cut, start=1):
        cut_out = Calculation()
        cut_out.known = {**worked.known, kind: given(f"{kind}.{number}", load, f"test.one_cut[{number}]")}
        if kind != "effective_power":
            work_test(cut_out, pi)
        powers.append(cut_out["effective_power"].named(f"effective_power.{number}"))
    for power in powers:
        worked.keep(power)
    return {"power_with_one_cut": total("power_with_one_cut", powers)}
