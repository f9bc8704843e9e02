"""What a machine gives to the torsional system of its crankshaft: inertias of throws, and the torques on them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

from crankwork.analysis.crankshaft_bearings import rotating_mass_of
from crankwork.analysis.cylinders import MultiCylinderEngine, multi_cylinder_engine
from crankwork.analysis.harmonics import curve_of
from crankwork.analysis.prepared import PreparedCylinder
from crankwork.analysis.reduction import MOVING
from crankwork.cylinders.engines import inline
from crankwork.cylinders.layout import CylinderPlace
from crankwork.cylinders.torque import curve_harmonics
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import HarmonicCoefficient, TracedValue, total
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


class _Harmonic(NamedTuple):
    """One order of a torque of a cylinder, traced, and whether it grows with the square of the speed."""

    order: float
    cosine: TracedValue
    sine: TracedValue
    is_inertia: bool


def gas_and_inertia_torques(
    engine: MultiCylinderEngine, highest: float
) -> Iterator[tuple[CylinderPlace, tuple[_Harmonic, ...]]]:
    """Yield every cylinder with the harmonics of its torque: of its gas, then of all else (den_hartog_1956, ch. 5)."""
    kinds = dict[int, tuple[_Harmonic, ...]]()
    cycle = engine.layout.cycle
    for place, cylinder in zip(engine.layout.places, engine.cylinders, strict=True):
        if id(cylinder) not in kinds:
            own, torque = cylinder.trace, cylinder.trace["crank_torque"]
            columns = {"crank_torque.inertia": torque.named("crank_torque.inertia")}
            if "gas_force" in own:
                gas = (own["gas_force"] * own["piston_transfer_1"]).named("crank_torque.gas")
                columns = {gas.key: gas, "crank_torque.inertia": (torque - gas).named("crank_torque.inertia")}
            over = CycleInterpolant(columns, CrankGrid.from_degrees, cycle)
            kinds[id(cylinder)] = tuple(
                harmonic for key in columns for harmonic in _harmonics(over, key, round(highest * cycle / _TURN))
            )
        yield place, kinds[id(cylinder)]


def _harmonics(over: CycleInterpolant, key: str, count: int) -> Iterator[_Harmonic]:
    """Yield the harmonics of a torque."""
    if over.is_zero(key):
        return
    column, harmonics = over.columns[key], curve_harmonics(curve_of(over, key), count)
    for order, a, b in zip(harmonics.orders.tolist(), harmonics.cosine.tolist(), harmonics.sine.tolist(), strict=True):
        cosine, sine = (
            TracedValue(HarmonicCoefficient(value, column, part, order), f"harmonic_{part}.{order:g}")
            for part, value in (("cosine", a), ("sine", b))
        )
        yield _Harmonic(order, cosine, sine, key.endswith("inertia"))
