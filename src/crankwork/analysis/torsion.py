"""Torsional vibration of a machine: its discs and shafts, natural modes, nodes, tables by Holzer."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from crankwork.analysis.deferred import Deferred
from crankwork.analysis.prepared import PreparedMachine
from crankwork.analysis.results import Listing, Results
from crankwork.analysis.torsion_machine import throw_inertias
from crankwork.analysis.torsion_trace import TorsionTrace, torsion_trace
from crankwork.analysis.torsion_vibration import (
    NODE,
    at_rest,
    damped_values,
    damper_values,
    forced_values,
    vibrating,
    vibration_listings,
    vibration_notices,
)
from crankwork.formula.traced_value import FunctionValue, ProcedureValue, TracedValue, given
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.machine import Machine
from crankwork.shaft.torsion_model import GROUNDED
from crankwork.shaft.torsion_replay import NaturalModes
from crankwork.shaft.torsional_system import HolzerTable, Modes


def shaft_alone(machine: Machine, grid: CrankGrid | None = None) -> Results:
    """Return the results of discs on shafts without a mechanism, still without their vibration."""
    solved = PreparedMachine(machine, machine.method, machine.speed)
    grid = grid or CrankGrid.steps(machine.table_step, machine.cycle, special=machine.table_special)
    return Results(solved, grid, {}, {}, {}, (), {})


def with_torsion(results: Results) -> Results:
    """Return results with the torsional vibration of the shaft of their machine."""
    model = results.machine.torsion
    if model is None:
        return results
    own, radius = throw_inertias(results)
    trace = torsion_trace(model, own, results.method.pi, radius)
    natural = NaturalModes(trace.structure.without_rings(), model.modes)
    modes = natural.modes([number.value for number in trace.elastic])
    values = dict(trace.values) | dict(_traced_modes(trace, natural, modes))
    nodes = dict(_nodes(trace, values, modes))
    values |= {key: value for pair in nodes.values() for key, value in pair.items()}
    values |= dict(_remainders(trace, natural))
    system, pi = vibrating(results, trace, modes), results.method.pi
    values |= damper_values(results, system) | forced_values(system, pi)
    single = {key: value for key, value in values.items() if _is_single(key, value)}
    listings = {**results.listings, **_listings(trace, modes), **_node_listing(nodes), **_holzer(trace, natural, modes)}
    if damped := damped_values(system):
        listings["damped_modes"] = Listing(damped)
    notices = vibration_notices(system, None if radius is None else radius.value)
    return replace(
        results,
        summary={**results.summary, **{key: value.value for key, value in single.items()}},
        checks={**results.checks, **_checks(trace, natural, modes)},
        notices=(*results.notices, *notices),
        listings=Deferred(listings, lambda: vibration_listings(system, pi)),
        trace={**results.trace, **values},
    )


_SINGLE = (
    "natural_frequency", "node_distance", "equivalent_node_distance", "vibration_amplitude", "vibration_torque",
    "vibration_stress", "holzer_remainder", "effective_inertia", "damper_inertia_ratio", "optimum_tuning",
    "optimum_damping_ratio", "optimum_damping", "optimum_stiffness", "least_magnification",
)  # fmt: skip
_CALCULATED = ("torsional_stiffness", "equivalent_length", "equivalent_inertia")


def _is_single(key: str, value: TracedValue) -> bool:
    """Return whether a value stands in the summary: a result, or what follows from sizes that are stated."""
    kind = key.partition(".")[0]
    return kind in _SINGLE or (kind in _CALCULATED and bool(value.node.operands))


def _traced_modes(trace: TorsionTrace, natural: NaturalModes, modes: Modes) -> Iterator[tuple[str, TracedValue]]:
    """Yield natural frequencies, then the amplitudes of discs in each mode."""
    count = modes.frequency.size
    for index, frequency in enumerate(modes.frequency.tolist()):
        key = f"natural_frequency.{index + 1}"
        yield key, TracedValue(FunctionValue(frequency, "eigenvalue", trace.elastic, natural, index), key)
    for index, shape in enumerate(modes.shape):
        for disc, amplitude in enumerate(shape.tolist()):
            key, part = f"relative_amplitude.{index + 1}.{trace.names[disc]}", count + index * shape.size + disc
            yield key, TracedValue(FunctionValue(amplitude, "eigenvector", trace.elastic, natural, part), key)


def _nodes(
    trace: TorsionTrace, values: Mapping[str, TracedValue], modes: Modes
) -> Iterator[tuple[tuple[int, str], dict[str, TracedValue]]]:
    """Yield mode and shaft of each node, with its distances from the first end of the shaft where lengths are known."""
    number = {name: index for index, name in enumerate(trace.names)}
    for mode, shape in enumerate(modes.shape, start=1):
        for name, shaft in trace.model.shafts.items():
            if GROUNDED in shaft.between or shaft.density is not None:
                continue
            first, second = (shape[number[end]] for end in shaft.between)
            if min(abs(first), abs(second)) < NODE * np.max(np.abs(shape)) or first * second >= 0:
                continue
            a, b = (values[f"relative_amplitude.{mode}.{end}"] for end in shaft.between)
            length = values.get(f"equivalent_length.{name}.own", trace.lengths.get(name))
            distances = dict[str, TracedValue]()
            if length is not None:
                key = f"equivalent_node_distance.{mode}.{name}"
                distances[key] = (length * a / (a - b)).named(key)
            if shaft.parts:
                key, place = f"node_distance.{mode}.{name}", first / (first - second) * _compliance(shaft.parts)
                distance = _along(shaft.parts, place)
                distances[key] = TracedValue(ProcedureValue(distance, "node", (a, b)), key)
                if len(shaft.parts) == 1:
                    first_length = next(
                        operand
                        for operand in values[f"torsional_stiffness.{name}"].node.operands
                        if operand.key == f"equivalent_length.{name}"
                    )
                    own = next(item for item in first_length.node.operands if item.key == "shaft_length")
                    distances[key] = (own * a / (a - b)).named(key)
            yield (mode, name), distances
        for name in at_rest(trace.names, shape):
            yield (mode, name), {}


def _compliance(parts: tuple[object, ...]) -> float:
    """Return what the twist of the parts of a shaft is proportional to. [1/m3]"""
    return math.fsum(part.length / (part.diameter**4 - part.bore**4) for part in parts)  # type: ignore[attr-defined]


def _along(parts: tuple[object, ...], place: float) -> float:
    """Return how far along a shaft a part of its twist is reached. [1/m3] -> [m]"""
    distance = 0.0
    for part in parts:
        own = _compliance((part,))
        if place <= own:
            return distance + float(part.length) * place / own  # type: ignore[attr-defined]
        place, distance = place - own, distance + float(part.length)  # type: ignore[attr-defined]
    return distance


def _listings(trace: TorsionTrace, modes: Modes) -> dict[str, Listing]:
    """Return the tables of discs, of shafts and of modes."""
    discs = {"disc_inertia": np.array([trace.inertia[name].value for name in trace.names])}
    if trace.geared:
        ratios = [trace.geared[name].value if name in trace.geared else 1.0 for name in trace.names]
        discs["speed_ratio"] = np.array(ratios)
        discs["equivalent_inertia"] = discs["disc_inertia"] * discs["speed_ratio"] ** 2
    held = [trace.model.discs[name].damping if name in trace.model.discs else 0.0 for name in trace.names]
    if any(held):
        discs["angular_damping"] = np.array(held)
    shafts = {"torsional_stiffness": np.array([item.value for item in trace.stiffness.values()])}
    if trace.lengths:
        lengths = [trace.lengths[name].value if name in trace.lengths else math.nan for name in trace.stiffness]
        shafts["equivalent_length"] = np.array(lengths)
    for key, name in (("angular_damping", "damping"), ("loss_factor", "loss_factor")):
        damped = np.array([getattr(shaft, name) for shaft in trace.model.shafts.values()])
        if np.any(damped):
            shafts[key] = damped
    frequency = modes.frequency
    rows = {"mode_number": np.arange(1.0, frequency.size + 1), "natural_frequency": frequency,
            "angular_frequency": frequency}  # fmt: skip
    for index in range(modes.shape.shape[1]):
        rows[f"relative_amplitude.{trace.names[index]}"] = modes.shape[:, index]
    tables = {
        "torsional_discs": Listing(discs, trace.names),
        "torsional_shafts": Listing(shafts, tuple(trace.stiffness)),
    }
    return tables | ({"natural_modes": Listing(rows)} if frequency.size else {})


def _node_listing(nodes: Mapping[tuple[int, str], Mapping[str, TracedValue]]) -> dict[str, Listing]:
    """Return the table of nodes: mode, shaft and distances."""
    if not nodes:
        return {}
    columns = {"mode_number": np.array([float(mode) for mode, _ in nodes])}
    for kind in ("node_distance", "equivalent_node_distance"):
        cells = [
            known[f"{kind}.{mode}.{name}"].value if f"{kind}.{mode}.{name}" in known else math.nan
            for (mode, name), known in nodes.items()
        ]
        if not np.all(np.isnan(cells)):
            columns[kind] = np.array(cells)
    return {"torsional_nodes": Listing(columns, tuple(name for _, name in nodes))}


def _remainders(trace: TorsionTrace, natural: NaturalModes) -> Iterator[tuple[str, TracedValue]]:
    """Yield what tables by Holzer leave at trial frequencies."""
    if natural.structure.is_tree and not natural.heavy:
        system = natural.system([number.value for number in trace.elastic])
        for index, w in enumerate(trace.model.trials, start=1):
            key, left = f"holzer_remainder.{index}", system.holzer(w, system.trial(w)).remainder
            w_trial = given("angular_frequency", w, f"torsion.trials[{index}]")
            yield key, TracedValue(ProcedureValue(left, "holzer", (*trace.elastic, w_trial)), key)


def _holzer(trace: TorsionTrace, natural: NaturalModes, modes: Modes) -> dict[str, Listing]:
    """Return the tables by Holzer, at natural frequencies and at trial frequencies, one below the other."""
    structure = natural.structure
    if not structure.is_tree or natural.heavy:
        return {}
    system = natural.system([number.value for number in trace.elastic])
    tables = {
        "holzer": [
            (w, system.holzer(w, shape)) for w, shape in zip(modes.frequency.tolist(), modes.shape, strict=True)
        ],
        "holzer_trials": [(w, system.holzer(w, system.trial(w))) for w in trace.model.trials],
    }
    return {name: _holzer_listing(trace, rows) for name, rows in tables.items() if rows}


def _holzer_listing(trace: TorsionTrace, tables: list[tuple[float, HolzerTable]]) -> Listing:
    stiffness = [item.value for item in trace.stiffness.values()]
    columns: dict[str, list[float]] = {
        key: [] for key in ("angular_frequency", "disc_inertia", "relative_amplitude", "disc_torque", "holzer_sum",
                            "torsional_stiffness", "shaft_twist")
    }  # fmt: skip
    names = []
    for w, table in tables:
        for row in table.rows:
            names.append(trace.names[row.disc])
            k = math.nan if row.shaft is None else stiffness[row.shaft]
            cells = (w, trace.inertia[names[-1]].value, row.amplitude, row.torque, row.sum, k, row.sum / k)
            for cell, column in zip(cells, columns.values(), strict=True):
                column.append(cell)
    return Listing({key: np.array(column) for key, column in columns.items()}, tuple(names))


def _checks(trace: TorsionTrace, natural: NaturalModes, modes: Modes) -> dict[str, float]:
    """Return what is left of the table by Holzer at natural frequencies, relative to the largest torque in it."""
    structure = natural.structure
    if not structure.is_tree or natural.heavy or not modes.frequency.size:
        return {}
    system = natural.system([number.value for number in trace.elastic])
    left = []
    for w, shape in zip(modes.frequency.tolist(), modes.shape, strict=True):
        table = system.holzer(w, shape)
        largest = max((abs(value) for row in table.rows for value in (row.torque, row.sum)), default=1.0)
        left.append(abs(table.remainder) / (largest or 1.0))
    return {"holzer": max(left)}
