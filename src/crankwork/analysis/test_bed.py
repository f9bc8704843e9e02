"""The power of an engine on a test bed: from what was measured, and from sizes and diagram of the engine, if known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from crankwork.analysis.results import Listing, Results
from crankwork.formula.traced_value import TracedValue
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.machine import Machine
from crankwork.preparation.clutch import worked_clutch
from crankwork.preparation.prepared import PreparedMachine
from crankwork.preparation.test_bed import worked_alone, worked_with_engine
from crankwork.quantities.key import key_of


def analyse_test(machine: Machine) -> Results:
    """Return the results of a test of an engine of which only sizes are known, or of a clutch alone."""
    grid, worked = CrankGrid.from_degrees(np.array([0.0])), (worked_clutch if machine.clutch else worked_alone)(machine)
    summary = {key: value.value for key, value in worked.items()}
    solved = PreparedMachine(machine, machine.method, machine.speed)
    return Results(solved, grid, {}, summary, {}, (), {machine.alone: tuple(worked)}, _loads(worked), trace=worked)


def _loads(worked: Mapping[str, TracedValue]) -> dict[str, Listing]:
    """Return brake power and fuel of every load, where losses follow from several."""
    if "load_fuel_slope" not in worked:
        return {}
    points = worked["load_fuel_slope"].node.operands
    both = (points[::2], points[1::2])
    columns = {key_of(values[0].key).quantity: np.array([item.value for item in values]) for values in both}
    return {"willans": Listing(columns)}


def with_test(results: Results) -> Results:
    """Return the results of an engine with those of its test."""
    known = {key: value for key, value in results.trace.items() if key in results.summary}
    worked = worked_with_engine(results.machine, known, results.solved.space)
    values = {key: value for key, value in worked.items() if key not in results.summary}
    summary = {**results.summary, **{key: value.value for key, value in values.items()}}
    groups = {**results.groups, "test": tuple(values)}
    listings = {**results.listings, **_loads(values)}
    return replace(results, summary=summary, trace={**results.trace, **values}, groups=groups, listings=listings)
