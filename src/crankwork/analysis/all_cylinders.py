"""From the results of one cylinder to those of the whole engine."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import NamedTuple

from crankwork.analysis.crankshaft_bearings import (
    bearing_columns,
    bearing_components,
    bearing_listings,
    bearing_summary,
    bearing_trace,
    bearing_values,
    load_columns,
    wear_trace,
)
from crankwork.analysis.cylinder_balance import (
    balance_checks,
    balance_listing,
    balance_summary,
    balance_trace,
    engine_balance,
)
from crankwork.analysis.cylinders import MultiCylinderEngine, multi_cylinder_engine
from crankwork.analysis.firing import delivery_trace, firing_listing, firing_trace, work_trace
from crankwork.analysis.harmonics import harmonics_listing
from crankwork.analysis.one_cylinder import analyse_engine, moved_work
from crankwork.analysis.prepared import Notice, PreparedCylinder
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
from crankwork.cylinders.engines import inline
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.replay import Program, Samples
from crankwork.formula.traced_value import TracedValue
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.machine import Engine

_TORQUES = ("crank_torque.", "total_torque", "journal_torque.", "crankpin_torque.")
_WHOLE_VALUES = ("cylinder_count", "displacement", "indicated_power")
_TABLES = {
    "engine_torque": ("crank_torque.", "total_torque"),
    "accumulated_torque": ("journal_torque.", "crankpin_torque."),
    "bearings": ("crankpin_", "big_end_load", "small_end_load"),
    "main_journals": ("main_journal_load.",),
    "speed": ("kinetic_energy_change", "crank_speed"),
}


class EngineTrace(NamedTuple):
    """Torques and bearing loads of an engine by key, what they are over the cycle, their extremes, and samples."""

    whole: MultiCylinderEngine
    trace: dict[str, TracedValue]
    over: CycleInterpolant
    extremes: Mapping[str, TracedValue]
    samples: Samples

    @classmethod
    def of(
        cls,
        solved: PreparedCylinder,
        beside: Mapping[str, TracedValue] = MappingProxyType({}),
        size_of: Mapping[str, str] = MappingProxyType({}),
        own: Mapping[str, TracedValue] = MappingProxyType({}),
    ) -> EngineTrace:
        """Return those of the engine that a cylinder belongs to; other columns are followed and sampled beside them."""
        whole = multi_cylinder_engine(solved)
        trace = torque_trace(whole) | bearing_trace(whole) | engine_reduction(whole)
        first = whole.of(1, "crank_torque")
        keys = ("total_torque", *load_columns(trace).values(), "bearing_force_x.small_end")
        inertias = REDUCTION if has_own_inertia(whole) else ()
        followed = {
            first.key: first,
            **{key: trace[key] for key in inertias},
            **{key: trace[key] for key in keys},
            **beside,
        }
        inertia = [whole.of(number, "inertia_force") for number in whole.has("inertia_force")]
        sampled = {key: trace[key] for key in (*_table_keys(trace), *bearing_components(whole, trace))}
        program = Program({**own, **sampled, **{one.key: one for one in inertia}, **followed})
        over = CycleInterpolant(followed, CrankGrid.from_degrees, whole.layout.cycle, size_of=size_of, program=program)
        samples = Samples(program, CrankGrid.from_degrees, whole.layout.cycle)
        return cls(whole, trace, over, over.extremes(*keys), samples)


def _table_keys(trace: Mapping[str, TracedValue]) -> tuple[str, ...]:
    """Return which torques, loads and inertias of an engine stand in its tables."""
    torques = [key for key in trace if key.startswith(_TORQUES)]
    return (*torques, *bearing_columns(trace), *(key for key in REDUCTION if key in trace))


def with_whole_engine(results: Results, found: EngineTrace | None) -> Results:
    """Return the results of cylinder 1 with those of the engine it belongs to, of which only the motion may be known.

    Every column and single value of cylinder 1 as it was, and those of the engine.
    """
    whole = multi_cylinder_engine(results.solved) if found is None else found.whole
    notices = [Notice(*one) for one in whole.engine.notices]
    machine = whole.machine
    stated = machine.cylinder.inclination if machine.cylinder is not None else None
    if machine.has_gravity and stated is None and machine.inclination:
        notices.append(Notice("upright", {"inclination": math.degrees(machine.inclination)}))
    if (
        any(whole.engine.articulated_rods)
        and whole.masses.rod_inertia_excess
        and whole.engine.articulated_masses is None
    ):
        notices.append(Notice("articulated_two_mass", {}))
    if len({one.position for one in whole.layout.places}) == 1 < len({one.throw for one in whole.layout.places}):
        notices.append(Notice("no_spacing", {}))
    firing = firing_trace(whole)
    if found is None:
        notices.append(Notice("motion_only", {}))
        return replace(results, notices=(*results.notices, *notices), trace={**results.trace, **firing})
    _, trace, over, extremes, samples = found
    torque = engine_torque(whole, trace, over, extremes)
    loads = bearing_values(whole, trace, over, extremes) | wear_trace(whole, trace, samples)
    works, harmonics = work_trace(whole, firing), harmonics_trace(whole, torque, trace)
    delivered = delivery_trace(whole, firing, works)
    sampled = samples(results.grid)
    columns = {key: sampled[key].copy() for key in _table_keys(trace)} | Program(torque.columns)(results.grid)
    trace |= torque.columns
    groups = {
        name: tuple(key for key in columns if key.startswith(starts) and _belongs(name, key))
        for name, starts in _TABLES.items()
    } | {"dynamics": (*results.groups["dynamics"], *(key for key in REDUCTION if key in columns))}
    listings: dict[str, Listing] = {
        "firing": firing_listing(whole, firing | works),
        "torque_harmonics": harmonics_listing(harmonics),
        **bearing_listings(whole, loads),
    }
    balance, balanced, left = engine_balance(whole), dict[str, TracedValue](), dict[str, TracedValue]()
    if whole.machine.masses is not None:
        balanced = balance_trace(whole, balance)
        listings["balance"] = balance_listing(whole, balance, balanced)
        left = balance_summary(whole, balance, balanced)
        balanced |= left
    whole_values = {key: one for key, one in {**firing, **works}.items() if key in _WHOLE_VALUES}
    single = {**whole_values, **delivered, **torque.summary, **bearing_summary(whole, loads), **left}
    summary = {key: one.value for key, one in single.items()}
    thrown, joints = dict[str, float](), dict[str, TracedValue]()
    if any(whole.engine.articulated_rods):
        from crankwork.analysis.master_joints import master_joints  # noqa: PLC0415 - few engines have such rods
        from crankwork.analysis.second_routes import throw_residuals  # noqa: PLC0415 - few engines have such rods

        thrown = throw_residuals(whole, trace)
        joints = {one.key: one for one in master_joints(whole, trace)}
    told = [*torque.notices, *_against_cycle(whole, results.summary, summary), *_of_gases(whole, results.notices)]
    return replace(
        results,
        columns={**results.columns, **columns},
        summary={**results.summary, **summary},
        checks={
            **results.checks,
            **torque_checks(whole, torque, samples, moved_work(results.solved, results.summary)),
            **balance_checks(whole, balance, samples),
            **torque.checks,
            **thrown,
        },
        allowed=_allowed(results),
        notices=(*results.notices, *notices, *told),
        groups={**results.groups, **groups},
        listings={**results.listings, **listings},
        trace={
            **results.trace,
            **firing,
            **works,
            **trace,
            **{key: one for key, one in _of_unlike(whole).items() if key not in trace},
            **joints,
            **loads,
            **harmonics,
            **balanced,
            **torque.between,
            **single,
        },
    )


def _of_unlike(whole: MultiCylinderEngine) -> dict[str, TracedValue]:
    """Return the columns of the cylinders with articulated rods or other gas, at the crank angle of cylinder 1."""
    first = whole.master.machine.gas
    unlike = [
        (number, one)
        for number, one in enumerate(whole.cylinders, start=1)
        if one.articulated_rod is not None or one.machine.gas is not first
    ]
    found = (whole.of(number, key) for number, one in unlike for key, known in one.trace.items() if known.varies)
    return {one.key: one for one in found}


def _of_gases(whole: MultiCylinderEngine, told: Sequence[Notice]) -> Iterator[Notice]:
    """Yield which cylinders misfire, and what is to be known of the diagrams of those that have their own."""
    if whole.engine.misfires:
        yield Notice("misfire", {"numbers": ", ".join(map(str, whole.engine.misfires))})
    seen = list(told)
    for one in whole.cylinders if whole.engine.gases else ():
        for notice in one.notices:
            if notice not in seen:
                seen.append(notice)
                yield notice


def _allowed(results: Results) -> dict[str, float]:
    """Return what an approximate method allows: of the work of every cylinder the same share, of forces its error."""
    allowed = dict(results.allowed)
    if "work" in allowed:
        allowed["engine_work"] = allowed["work"]
    if "inertia_force_error" in results.summary:
        largest = max(abs(results.summary[f"inertia_force_{one}"]) for one in ("max", "min")) or 1.0
        allowed["free_forces"] = results.summary["inertia_force_error"] / largest
    return allowed


def _belongs(table: str, key: str) -> bool:
    """Return whether a key that begins like those of a table is one of them."""
    return table != "bearings" or not key.startswith("crankpin_torque")


def _against_cycle(
    whole: MultiCylinderEngine, one: Mapping[str, float], summary: Mapping[str, float]
) -> Iterator[Notice]:
    """Yield how far the mean torque is from that of the calculated cycle, or that this is of other cylinders."""
    if not {"effective_torque", "mechanical_efficiency"} <= set(one):
        return
    gases = whole.engine.gases
    if whole.engine.misfires or any(gas is not gases[0] or gas.factor != 1 for gas in gases):
        yield Notice("cycle_in_every", {})
    elif not whole.machine.angular_acceleration:
        # a mean torque less what the parts take up is not that of the gas
        cycle, mean = one["effective_torque"] / one["mechanical_efficiency"], summary["mean_torque"]
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
    return replace(analyse_engine(machine, results.grid, method=results.method), compared=results.compared)
