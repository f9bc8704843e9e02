"""What a machine gives to the torsional system of its crankshaft: inertias of throws, and the torques on them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from crankwork.analysis.crankshaft_bearings import rotating_mass_of
from crankwork.analysis.cylinders import MultiCylinderEngine, multi_cylinder_engine
from crankwork.analysis.prepared import PreparedCylinder
from crankwork.analysis.reduction import MOVING
from crankwork.cylinders.engines import inline
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import TracedValue, total
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.machine import Engine

if TYPE_CHECKING:
    from crankwork.analysis.results import Results

_TURN, _CYCLE = 360.0, 720.0


def engine_of(results: Results) -> MultiCylinderEngine | None:
    """Return all cylinders of an engine, one where there is one crank gear; None of another machine."""
    solved = results.solved
    if not isinstance(solved, PreparedCylinder):
        return None
    if solved.machine.engine is not None:
        return multi_cylinder_engine(solved)
    layout, _ = inline(1, (1,), strokes=4 if solved.machine.cycle == _CYCLE else 2)
    return MultiCylinderEngine(solved.machine, Engine(layout), (solved,))


def throw_inertias(results: Results) -> tuple[Mapping[str, TracedValue], TracedValue | None]:
    """Return the mean over the cycle of the reduced inertia of the cylinders of each throw, and the crank radius."""
    engine = engine_of(results)
    if engine is None:
        return {}, None
    radius = engine.master.trace["crank_radius"]
    if engine.machine.masses is None:
        return {}, radius
    throws: dict[str, list[TracedValue]] = {}
    means = dict[int, TracedValue]()
    for place, cylinder in zip(engine.layout.places, engine.cylinders, strict=True):
        parts = throws.setdefault(f"throw_{place.throw + 1}", [])
        if id(cylinder) not in means:
            moving = [
                cylinder.trace[key] for key in (f"reduced_inertia.{part}" for part in MOVING) if key in cylinder.trace
            ]
            column = total("reduced_inertia.moving", moving)
            over = CycleInterpolant({column.key: column}, CrankGrid.from_degrees, _TURN)
            means[id(cylinder)] = over.mean(column.key, "reduced_inertia.mean")
        rotating = rotating_mass_of(engine, place) * radius * radius
        parts += [means[id(cylinder)], rotating.named("reduced_inertia.rotating")]
    return {name: total("disc_inertia", parts) for name, parts in throws.items()}, radius
