"""The power of an engine on a test bed: from what was measured, and from sizes and diagram of the engine, if known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from crankwork.analysis.results import Results
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.machine import Machine
from crankwork.preparation.clutch import worked_clutch
from crankwork.preparation.prepared import PreparedMachine
from crankwork.preparation.test_bed import worked_alone, worked_with_engine


def analyse_test(machine: Machine) -> Results:
    """Return the results of a test of an engine of which only sizes are known, or of a clutch alone."""
    grid, worked = CrankGrid.from_degrees(np.array([0.0])), (worked_clutch if machine.clutch else worked_alone)(machine)
    summary = {key: value.value for key, value in worked.items()}
    solved = PreparedMachine(machine, machine.method, machine.speed)
    return Results(solved, grid, {}, summary, {}, (), {machine.alone: tuple(worked)}, trace=worked)


def with_test(results: Results) -> Results:
    """Return the results of an engine with those of its test."""
    known = {key: value for key, value in results.trace.items() if key in results.summary}
    worked = worked_with_engine(results.machine, known, results.solved.space)
    values = {key: value for key, value in worked.items() if key not in results.summary}
    summary = {**results.summary, **{key: value.value for key, value in values.items()}}
    groups = {**results.groups, "test": tuple(values)}
    return replace(results, summary=summary, trace={**results.trace, **values}, groups=groups)
