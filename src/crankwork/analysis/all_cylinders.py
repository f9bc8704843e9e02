"""From the results of one cylinder to those of the whole engine."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import NamedTuple

from crankwork.analysis.bearings import Bearing, BearingCycle
from crankwork.analysis.crankshaft_bearings import bearing_trace, engine_bearings, master_joints
from crankwork.analysis.cylinder_balance import (
    balance_checks,
    balance_listing,
    balance_summary,
    balance_trace,
    engine_balance,
)
from crankwork.analysis.cylinder_forces import TracedCylinder
from crankwork.analysis.cylinders import MultiCylinderEngine, multi_cylinder_engine
from crankwork.analysis.firing import delivery_trace, firing_listing, firing_trace, work_trace
from crankwork.analysis.harmonics import harmonics_listing
from crankwork.analysis.one_cylinder import analyse_engine, moved_work, with_measured
from crankwork.analysis.reduction import REDUCTION
from crankwork.analysis.results import Listing, Results
from crankwork.analysis.shaft_torque import (
    engine_reduction,
    engine_torque,
    harmonics_trace,
    has_own_inertia,
    torque_checks,
    torque_trace,
)
from crankwork.cylinders.arrangement import inline
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.replay import Program, Samples
from crankwork.formula.traced_value import TracedValue
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.machine import Engine
from crankwork.preparation.prepared import Notice

_TORQUES = ("crank_torque.", "total_torque", "total_tangential_force", "journal_torque.", "crankpin_torque.")
_WHOLE_VALUES = ("cylinder_count", "displacement", "indicated_power")
_TABLES = {
    "engine_torque": ("crank_torque.", "total_torque", "total_tangential_force"),
    "accumulated_torque": ("journal_torque.", "crankpin_torque."),
    "bearings": ("crankpin_", "big_end_load", "small_end_load"),
    "main_journals": ("main_journal_load.",),
    "speed": ("kinetic_energy_change", "crank_speed"),
}


class EngineTrace(NamedTuple):
    """Torques and bearing loads of an engine by key, their interpolants over the cycle, extremes and samples."""

    engine: MultiCylinderEngine
    trace: dict[str, TracedValue]
    over: CycleInterpolant
    extremes: Mapping[str, TracedValue]
    samples: Samples
    bearings: tuple[Bearing, ...]

    @property
    def bearing_cycle(self) -> BearingCycle:
        """The loads of the bearings over the cycle."""
        components = {key: self.trace[key] for key in _components(self.bearings)}
        cycle, rays = self.engine.layout.cycle, self.engine.engine.bearings.rays
        return BearingCycle(self.bearings, components, self.over, self.samples, cycle, rays)

    @classmethod
    def of(
        cls,
        solved: TracedCylinder,
        followed_too: Mapping[str, TracedValue] = MappingProxyType({}),
        size_of: Mapping[str, str] = MappingProxyType({}),
        own: Mapping[str, TracedValue] = MappingProxyType({}),
    ) -> EngineTrace:
        """Return those of the engine of a cylinder; `followed_too` and `own`: columns to interpolate and sample too."""
        engine = multi_cylinder_engine(solved)
        trace = torque_trace(engine) | bearing_trace(engine) | engine_reduction(engine)
        first = engine.of(1, "crank_torque")
        bearings = tuple(engine_bearings(engine, trace))
        reversing = [bearing.reversing for bearing in bearings if bearing.reversing]
        keys = ("total_torque", *(bearing.load for bearing in bearings), *reversing)
        inertias = REDUCTION if has_own_inertia(engine) else ()
        followed = {
            first.key: first,
            **{key: trace[key] for key in inertias},
            **{key: trace[key] for key in keys},
            **followed_too,
        }
        inertia = [engine.of(number, "inertia_force") for number in engine.has("inertia_force")]
        sampled = {key: trace[key] for key in (*_table_keys(trace, bearings), *_components(bearings))}
        program = Program({**own, **sampled, **{item.key: item for item in inertia}, **followed})
        over = CycleInterpolant(followed, CrankGrid.from_degrees, engine.layout.cycle, size_of=size_of, program=program)
        samples = Samples(program, CrankGrid.from_degrees, engine.layout.cycle)
        return cls(engine, trace, over, over.extremes(*keys), samples, bearings)


def _components(bearings: Iterable[Bearing]) -> list[str]:
    """Return the columns of the loads of crankpins and main journals along and across the arms of their cranks."""
    return [key for bearing in bearings if bearing.is_crankpin or bearing.is_journal for key in bearing.components]


def _table_keys(trace: Mapping[str, TracedValue], bearings: Iterable[Bearing]) -> tuple[str, ...]:
    """Return the keys of the torques, loads and inertias in the tables of an engine."""
    torques = [key for key in trace if key.startswith(_TORQUES)]
    loads = [key for bearing in bearings for key in (*bearing.components * bearing.is_crankpin, bearing.load)]
    return (*torques, *loads, *(key for key in REDUCTION if key in trace))


def with_whole_engine(results: Results, traced: EngineTrace | None) -> Results:
    """Return the results of cylinder 1 with those of the engine it belongs to, of which only the motion may be known.

    Every column and single value of cylinder 1 as it was, and those of the engine.
    """
    engine = multi_cylinder_engine(results.solved) if traced is None else traced.engine
    notices = [Notice(*notice) for notice in engine.engine.notices]
    machine = engine.machine
    stated = machine.cylinder.inclination if machine.cylinder is not None else None
    if machine.has_gravity and stated is None and machine.inclination:
        notices.append(Notice("upright", {"inclination": math.degrees(machine.inclination)}))
    if (
        any(engine.engine.articulated_rods)
        and engine.masses.rod_inertia_excess
        and engine.engine.articulated_masses is None
    ):
        notices.append(Notice("articulated_two_mass", {}))
    if (
        len({place.position for place in engine.layout.places})
        == 1
        < len({place.throw for place in engine.layout.places})
    ):
        notices.append(Notice("no_spacing", {"name": "engine.spacing"}))
    firing = firing_trace(engine)
    if traced is None:
        notices.append(Notice("motion_only", {}))
        return replace(results, notices=(*results.notices, *notices), trace={**results.trace, **firing})
    _, trace, over, extremes, samples, _ = traced
    torque = engine_torque(engine, trace, over, extremes)
    bearings = traced.bearing_cycle
    # what has no owner is shown in the summary
    loads, reversal = bearings.values, {key: known for key, known in bearings.values.items() if "." not in key}
    works, harmonics = work_trace(engine, firing), harmonics_trace(engine, torque, trace)
    delivered = delivery_trace(engine, firing, works)
    sampled = samples(results.grid)
    columns = {key: sampled[key].copy() for key in _table_keys(trace, traced.bearings)} | Program(torque.columns)(
        results.grid
    )
    trace |= torque.columns
    groups = {
        name: tuple(key for key in columns if key.startswith(starts) and _belongs(name, key))
        for name, starts in _TABLES.items()
    } | {"dynamics": (*results.groups["dynamics"], *(key for key in REDUCTION if key in columns))}
    listings: dict[str, Listing] = {
        "firing": firing_listing(engine, firing | works),
        "torque_harmonics": harmonics_listing(harmonics),
        **bearings.listings(),
    }
    balance, balanced, left = engine_balance(engine), dict[str, TracedValue](), dict[str, TracedValue]()
    if engine.machine.masses is not None:
        balanced = balance_trace(engine, balance)
        listings["balance"] = balance_listing(engine, balance, balanced)
        left = balance_summary(engine, balance, balanced)
        balanced |= left
    whole_values = {key: value for key, value in {**firing, **works}.items() if key in _WHOLE_VALUES}
    single = {**whole_values, **delivered, **torque.summary, **bearings.summary(), **reversal, **left}
    summary = {key: value.value for key, value in single.items()}
    thrown, joints = dict[str, float](), dict[str, TracedValue]()
    if any(engine.engine.articulated_rods):
        from crankwork.analysis.second_routes import throw_residuals  # noqa: PLC0415 - few engines have such rods

        thrown = throw_residuals(engine, trace)
        joints = {master_joint.key: master_joint for master_joint in master_joints(engine, trace)}
    further = [*torque.notices, *_against_cycle(engine, results.summary, summary), *_of_gases(engine, results.notices)]
    return replace(
        results,
        columns={**results.columns, **columns},
        summary={**results.summary, **summary},
        checks={
            **results.checks,
            **torque_checks(engine, torque, samples, moved_work(results.solved, results.summary)),
            **balance_checks(engine, balance, samples),
            **torque.checks,
            **thrown,
        },
        allowed=_allowed(results),
        notices=(*results.notices, *notices, *further),
        groups={**results.groups, **groups},
        listings={**results.listings, **listings},
        trace={
            **results.trace,
            **firing,
            **works,
            **trace,
            **{key: value for key, value in _of_unlike(engine).items() if key not in trace},
            **joints,
            **loads,
            **harmonics,
            **balanced,
            **torque.between,
            **single,
        },
    )


def _of_unlike(engine: MultiCylinderEngine) -> dict[str, TracedValue]:
    """Return the columns of the cylinders with articulated rods or other gas, at the crank angle of cylinder 1."""
    first = engine.master.machine.gas
    unlike = [
        (number, cylinder)
        for number, cylinder in enumerate(engine.cylinders, start=1)
        if cylinder.articulated_rod is not None or cylinder.machine.gas is not first
    ]
    values = (engine.of(number, key) for number, item in unlike for key, known in item.trace.items() if known.varies)
    return {item.key: item for item in values}


def _of_gases(engine: MultiCylinderEngine, earlier: Sequence[Notice]) -> Iterator[Notice]:
    """Yield which cylinders misfire, and new notices of the diagrams of cylinders with their own gas."""
    if engine.engine.misfires:
        yield Notice("misfire", {"numbers": ", ".join(map(str, engine.engine.misfires))})
    seen = list(earlier)
    for item in engine.cylinders if engine.engine.gases else ():
        for notice in item.notices:
            if notice not in seen:
                seen.append(notice)
                yield notice


def _allowed(results: Results) -> dict[str, float]:
    """Return the residuals that an approximate method allows: its share of the work, its error of forces."""
    allowed = dict(results.allowed)
    if "work" in allowed:
        allowed["engine_work"] = allowed["work"]
    if "inertia_force_error" in results.summary:
        largest = max(abs(results.summary[f"inertia_force_{item}"]) for item in ("max", "min")) or 1.0
        allowed["free_forces"] = results.summary["inertia_force_error"] / largest
    return allowed


def _belongs(table: str, key: str) -> bool:
    """Return whether a key that begins like those of a table is one of them."""
    return table != "bearings" or not key.startswith("crankpin_torque")


def _against_cycle(
    engine: MultiCylinderEngine, values: Mapping[str, float], summary: Mapping[str, float]
) -> Iterator[Notice]:
    """Yield the deviation of the mean torque from that of the calculated cycle, or that they do not compare."""
    if not {"effective_torque", "mechanical_efficiency"} <= set(values):
        return
    gases = engine.engine.gases
    if engine.engine.misfires or any(gas is not gases[0] or gas.factor != 1 for gas in gases):
        yield Notice("cycle_in_every", {})
    elif not engine.machine.angular_acceleration:
        # a mean torque less that of accelerating the parts is not that of the gas
        cycle, mean = values["effective_torque"] / values["mechanical_efficiency"], summary["mean_torque"]
        yield Notice("torque_of_cycle", {"torque": mean, "cycle": cycle, "percent": 100 * (mean / cycle - 1)})


_FOUR_STROKES = 720.0


def with_engine_results(results: Results) -> Results:
    """Return results with those of the whole engine; one cylinder whose torque is known is an engine of one."""
    machine = results.machine
    if machine.engine is not None or "crank_torque" not in results.columns:
        return results
    layout, notices = inline(1, (1,), strokes=4 if machine.cycle == _FOUR_STROKES else 2)
    if layout.cycle != machine.cycle:
        return results
    machine = replace(machine, engine=Engine(layout, notices=notices))
    own = with_measured(analyse_engine(machine, results.grid, method=results.method))
    completed = replace(own, compared=results.compared)
    if machine.torsion is not None:
        from crankwork.analysis.torsion import with_torsion  # noqa: PLC0415 - few machines vibrate

        completed = with_torsion(completed)
    return completed
