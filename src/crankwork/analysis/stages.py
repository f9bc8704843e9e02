"""A compressor of several stages: what follows from its pressures, temperatures and one delivery or size."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from crankwork.analysis.results import Listing, Results
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import AngleFunction, TracedValue, absent
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.loads.stages import Stages
from crankwork.machine import Machine
from crankwork.preparation import traced_inputs
from crankwork.preparation.prepared import Notice, PreparedMachine
from crankwork.preparation.stages import stage_values
from crankwork.quantities.key import key_of

# columns of the table of stages, in their order
_COLUMNS = (
    "suction_pressure", "discharge_pressure", "stage_pressure_ratio", "suction_temperature", "discharge_temperature",
    "stage_flow", "clearance_volumetric_efficiency", "swept_volume", "bore", "stage_power", "cylinder_heat",
    "cooler_heat",
)  # fmt: skip
# by how much a later stage may draw in another volume than it is given [-]
_FLOW_ERROR = 0.01
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(40)


def analyse_stages(machine: Machine, stages: Stages, grid: CrankGrid | None = None) -> Results:
    """Return the results of a compressor that is given by its stages (eastop_mcconkey_1993, ch. 12)."""
    w = traced_inputs.speed(machine, machine.method)
    solved = PreparedMachine(machine, machine.method, w.value)
    grid = grid or CrankGrid.steps(machine.table_step, machine.cycle)
    columns = {"crank_angle": TracedValue(AngleFunction("angle"), "crank_angle")}
    result = stage_values(machine, stages)
    speeds = traced_inputs.speeds(machine, w) if stages.has_speed else {}
    summary = {**speeds, **traced_inputs.efficiency(machine.drive), **result}
    values = {key: value.value for key, value in summary.items()}
    return Results(
        solved, grid, Program(columns)(grid), values, stage_checks(result), (), {}, stage_listing(result),
        trace={**columns, **summary},
    )  # fmt: skip


def _owners(values: Mapping[str, TracedValue]) -> tuple[str, ...]:
    """Return the numbers of the stages."""
    return tuple(key_of(key).owner for key in values if key.startswith("stage_pressure_ratio."))


def stage_listing(values: Mapping[str, TracedValue]) -> dict[str, Listing]:
    """Return the table of stages by its name, empty without stages."""
    owners = _owners(values)
    columns = {
        key: np.array([values[f"{key}.{owner}"].value if f"{key}.{owner}" in values else math.nan for owner in owners])
        for key in _COLUMNS
        if any(f"{key}.{owner}" in values for owner in owners)
    }
    return {"stages": Listing(columns, owners)} if owners else {}


def stage_notices(values: Mapping[str, TracedValue]) -> Iterator[Notice]:
    """Yield notices of stages that draw in another volume than they are given."""
    for key, error in values.items():
        if key.startswith("stage_flow_error.") and abs(error.value) > _FLOW_ERROR:
            yield Notice("stage_flow", {"number": key_of(key).owner, "error": 100 * error.value})


def stage_checks(values: Mapping[str, TracedValue]) -> dict[str, float]:
    """Return how far powers of stages are from those by quadrature of volume over pressure; empty without stages."""
    errors = []
    for owner in _owners(values):
        names = ("discharge_pressure", "suction_pressure", "stage_flow", "compression_exponent", "stage_power")
        high, low, flow, n_1, stated = (values[f"{name}.{owner}"].value for name in names)
        n_2, clearance, swept = (
            values.get(f"{name}.{owner}", absent(name, neutral)).value
            for name, neutral in (("expansion_exponent", n_1), ("clearance_ratio", 0.0), ("swept_flow", flow))
        )
        if n_1 == n_2:
            clearance, swept = 0.0, flow
        # by the logarithm of the pressure both volumes are smooth
        span = math.log(high / low)
        pressure = low * np.exp(span * (_NODES + 1) / 2)
        volume = (1 + clearance) * swept * (low / pressure) ** (1 / n_1)
        volume -= clearance * swept * (high / pressure) ** (1 / n_2)
        power = float(np.sum(_WEIGHTS * volume * pressure)) * span / 2
        errors.append(abs(power - stated) / abs(power))
    return {"stages": max(errors)} if errors else {}


class StageDiagram(NamedTuple):
    """The indicator diagram of a stage and back to its start. [m3], [Pa]"""

    volume: Array
    pressure: Array


def stage_diagrams(results: Results) -> dict[str, StageDiagram]:
    """Return the indicator diagram of one side of the piston of each stage, by number; none without sizes."""
    values, diagrams = results.summary, {}
    for number in results.listings["stages"].names if "stages" in results.listings else ():
        if f"swept_volume.{number}" not in values:
            continue
        low, high, n_1, swept = (
            values[f"{key}.{number}"]
            for key in ("suction_pressure", "discharge_pressure", "compression_exponent", "swept_volume")
        )
        n_2 = values.get(f"expansion_exponent.{number}", n_1)
        left = values.get(f"clearance_ratio.{number}", 0.0) * swept
        rising = low * (high / low) ** np.linspace(0.0, 1.0, 91)
        volumes = (left + swept) * (low / rising) ** (1 / n_1), left * (high / rising[::-1]) ** (1 / n_2)
        volume = np.concatenate([*volumes, volumes[0][:1]])
        pressure = np.concatenate([rising, rising[::-1], rising[:1]])
        diagrams[number] = StageDiagram(volume, pressure)
    return diagrams
