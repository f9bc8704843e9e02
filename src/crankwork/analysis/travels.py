"""At which crank angle the piston has gone a way: ignition and injection in millimetres, heights of ports."""

from __future__ import annotations

import math
from dataclasses import replace

from crankwork.analysis.results import Results
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import ProcedureValue, TracedValue, given
from crankwork.kinematics.crank_grid import CrankGrid

_TURN = 360.0


def with_travels(results: Results) -> Results:
    """Return the results of an engine with the crank angles of the ways that its description names.

    A way counts from the top dead centre; a negative one from the bottom dead centre.
    """
    cylinder, stroke = results.machine.cylinder, results.summary["stroke"]
    moved, values = results.trace["piston_displacement"], dict[str, TracedValue]()
    over = CycleInterpolant({"": moved}, CrankGrid.from_degrees, _TURN)
    for name, travel in (cylinder.travels if cylinder is not None else {}).items():
        stated = given(f"piston_displacement.{name}", travel, f"cylinder.travels.{name}")
        crossings = over.crossings("", travel if travel >= 0 else stroke + travel)
        for side, angle in zip(("down", "up"), (crossings[:1], crossings[-1:]), strict=True):
            if len(angle):
                degrees = float(angle[0])
                reaching = ProcedureValue(math.radians(degrees), "reached", (moved,), degrees, stated)
                values[f"travel_{side}.{name}"] = TracedValue(reaching, f"travel_{side}.{name}")
    summary = {**results.summary, **{key: value.value for key, value in values.items()}}
    return replace(results, summary=summary, trace={**results.trace, **values})
