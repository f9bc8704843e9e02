"""A crank gear of its own as an engine of one cylinder."""

from __future__ import annotations

from dataclasses import replace

from crankwork.analysis.engine import analyse_engine
from crankwork.analysis.results import Results
from crankwork.cylinders.engines import inline
from crankwork.machine import Engine, Machine

_FOUR_STROKES = 720.0


def as_engine(results: Results) -> Results:
    """Return results with those of the whole engine; a crank gear of its own is an engine of one cylinder."""
    machine = results.machine
    if not isinstance(machine, Machine) or machine.engine is not None or "crank_torque" not in results.columns:
        return results
    layout, notices = inline(1, (1,), strokes=4 if machine.cycle == _FOUR_STROKES else 2)
    if layout.cycle != machine.cycle:
        return results
    return analyse_engine(replace(machine, engine=Engine(layout, notices=notices)), results.grid, method=results.method)
