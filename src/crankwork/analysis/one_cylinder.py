"""From an engine to its results over one cycle, with their summary and the checks on them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from crankwork.analysis.cylinder_forces import COLUMNS, FORCES, TracedCylinder, traced_cylinder
from crankwork.analysis.motor_choice import motor_of_crank
from crankwork.analysis.reduction import REDUCTION
from crankwork.analysis.results import Results
from crankwork.analysis.speed import delivered_or_needed
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.replay import Program, Samples
from crankwork.formula.traced_value import ProcedureValue, TracedValue, given
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.slider_crank import (
    bottom_dead_centre_angle,
    mean_piston_speed,
    relative_offset,
    time_ratio_of_offset,
    top_dead_centre_angle,
    top_dead_centre_angle_before,
)
from crankwork.loads import gas as gas_formulas
from crankwork.loads.valves import StatedValves, inlet_flow
from crankwork.machine import Machine
from crankwork.method import Method
from crankwork.preparation import traced_inputs
from crankwork.preparation.cylinder_gas import cycle_values, indicated_values
from crankwork.preparation.piston_kinematics import HARMONICS, KINEMATICS
from crankwork.preparation.prepared import relative_difference
from crankwork.quantities.key import MOVED

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


_CHECK_STEP = 1.0
_MOVING = ("piston_velocity", "piston_acceleration")
_PUSHING = ("gas_pressure", "inertia_force", "piston_force", "side_force", "tangential_force", "crank_torque")
_WRONG_FORCES = ("inertia_force", "piston_force", "side_force", "tangential_force", "radial_force", "crank_torque")
GROUPS = {"kinematics": KINEMATICS, "harmonics": HARMONICS, "forces": FORCES, "dynamics": REDUCTION}


def analyse_engine(machine: Machine, grid: CrankGrid | None = None, *, method: Method | None = None) -> Results:
    """Return everything a machine does over one cycle.

    `grid`: ascending crank angles for the columns, within one cycle; the machine's own table otherwise [rad].
    """
    solved = traced_cylinder(machine, method or machine.method)
    if grid is None:
        grid = CrankGrid.steps(machine.table_step, machine.cycle, special=machine.table_special)
    followed, wrong = _followed(solved)
    names = {key: own_key(machine, key) for key in (*COLUMNS, *HARMONICS) if key in solved.trace}
    own = {name: solved.trace[key] for key, name in names.items()}
    if machine.engine is None or "crank_torque" not in solved.trace:
        program = Program(own | followed)
        samples = Samples(program, CrankGrid.from_degrees, machine.cycle)
        engine_trace = None
        over = CycleInterpolant(followed, CrankGrid.from_degrees, machine.cycle, size_of=wrong, program=program)
    else:
        from crankwork.analysis.all_cylinders import EngineTrace  # noqa: PLC0415 - loaded where it is needed

        # columns of one cylinder are interpolated together with those of all
        engine_trace = EngineTrace.of(solved, followed, wrong, own)
        samples, over = engine_trace.samples, engine_trace.over
    result = {**_geometry(solved), **_motion(solved, over), **_forces(solved, over)}
    result = _by_own_keys(machine, result)
    calculated = solved.space.calculated if solved.space is not None else None
    summary = {key: known.value for key, known in result.items()}
    if calculated is not None:
        summary |= cycle_values(calculated.values)
    trace = (
        ({} if calculated is None else {**cycle_values(calculated.trace), **calculated.peak})
        | _by_own_keys(machine, solved.trace)
        | result
    )
    if calculated is not None and "geometric_compression_ratio" in calculated.trace:
        # the ratio of the closed cylinder, as in the summary
        trace["compression_ratio"] = calculated.trace["compression_ratio"]
    results = Results(
        solved,
        grid,
        _only({name: name for name in own}, samples(grid)),
        summary,
        _checks(solved, summary, samples, over),
        solved.notices,
        {name: tuple(own_key(machine, key) for key in keys) for name, keys in GROUPS.items()},
        allowed=_allowed(solved, summary),
        trace=trace,
    )
    if machine.engine is None:
        return results
    from crankwork.analysis.all_cylinders import with_whole_engine  # noqa: PLC0415 - loaded where it is needed

    return with_whole_engine(results, engine_trace)


def with_measured(results: Results) -> Results:
    """Return the results of an engine with what follows from its measured pressure and its test."""
    gas, cylinder = results.machine.gas, results.machine.cylinder
    if cylinder is not None and cylinder.travels:
        results = with_travels(results)
    if gas is not None and gas.combustion is not None:
        from crankwork.analysis.combustion import with_combustion  # noqa: PLC0415 - loaded where it is needed

        results = with_combustion(results)
    if results.machine.test is not None:
        from crankwork.analysis.test_bed import with_test  # noqa: PLC0415 - loaded where it is needed

        results = with_test(results)
    return results


def own_key(machine: Machine, key: str) -> str:
    """Return the key of a value of cylinder 1; different from that of the whole engine if both have the value."""
    return MOVED.get(key, key) if machine.engine is not None else key


def _by_own_keys(machine: Machine, values: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return values of cylinder 1 by the keys that they have in the results."""
    return {own_key(machine, key): known for key, known in values.items()}


def _only(names: Mapping[str, str], columns: Mapping[str, Array]) -> dict[str, Array]:
    """Return columns by key, each read under its name."""
    return {key: columns[name].copy() for key, name in names.items() if name in columns}


def _followed(solved: TracedCylinder) -> tuple[dict[str, TracedValue], dict[str, str]]:
    """Return the columns of the summary, with the errors of an approximate method, and the column of each error."""
    trace, wrong = solved.trace, dict[str, str]()
    values = {key: trace[key] for key in (*_MOVING, *_PUSHING) if key in trace}
    if not solved.method.is_exact:
        exact = traced_cylinder(solved.machine, replace(solved.method.named("exact"), inertia_rod_ratio=None)).trace
        wrong = {f"{key}_error": key for key in ("piston_displacement", *_MOVING, *_WRONG_FORCES) if key in trace}
        values |= {key: trace[key] for key in wrong.values()}
        values |= {
            error: (trace[key].named(key) - exact[key].named(f"{key}.exact")).named(error)
            for error, key in wrong.items()
        }
    return values, wrong


def _geometry(solved: TracedCylinder) -> dict[str, TracedValue]:
    trace, lengths = solved.trace, solved.lengths
    values = {key: trace[key] for key in ("crank_radius", "rod_length")}
    r, l, e = values["crank_radius"], values["rod_length"], trace["offset"]  # noqa: E741
    values |= {"rod_ratio": solved.moving.lengths.rod_ratio, "stroke": traced_inputs.stroke(solved.moving.lengths)}
    if not e.is_absent:
        values |= {"offset": e, "relative_offset": relative_offset(e, r)}
        top = top_dead_centre_angle if lengths.offset > 0 else top_dead_centre_angle_before
        values["top_dead_centre_angle"] = top(*((e, l, r) if lengths.offset > 0 else (math.pi, e, l, r)))
        values["bottom_dead_centre_angle"] = bottom_dead_centre_angle(math.pi, e, l, r)
        values["time_ratio"] = time_ratio_of_offset(math.pi, e if lengths.offset > 0 else -e, l, r)
    of_cylinder = ("bore", "piston_area", "swept_volume", "clearance_volume", "compression_ratio")
    wanted = (*of_cylinder, "reciprocating_mass", "rotating_mass")
    values |= {key: trace[key] for key in wanted if key in trace and not trace[key].is_absent}
    if solved.machine.rod_equivalent:
        values |= {key: known for key, known in trace.items() if key.startswith("equivalent_") or key == "rod_inertia"}
    return values


def _motion(solved: TracedCylinder, over: CycleInterpolant) -> dict[str, TracedValue]:
    trace = solved.trace
    n = traced_inputs.revolutions(solved.machine)
    stroke = traced_inputs.stroke(solved.moving.lengths)
    values = traced_inputs.speeds(solved.machine, trace["speed"])
    values["mean_piston_speed"] = mean_piston_speed(stroke, n)
    values |= over.extremes(*_MOVING)
    eps = traced_inputs.acceleration(solved.machine)
    values |= {} if eps.is_absent else {eps.key: eps}
    if not solved.method.is_exact:
        values |= over.errors(*(f"{key}_error" for key in ("piston_displacement", *_MOVING)))
    return values


def _forces(solved: TracedCylinder, over: CycleInterpolant) -> dict[str, TracedValue]:
    trace, cycle = solved.trace, traced_inputs.cycle_angle(solved.machine)
    if "piston_force" not in trace:
        return {}
    values = over.errors(*(key for key in (f"{item}_error" for item in _WRONG_FORCES) if key in over.columns))
    values |= over.extremes(*(key for key in _PUSHING if key in trace))
    if "rotating_inertia_force" in trace:
        values["rotating_inertia_force"] = trace["rotating_inertia_force"]
    mean = over.mean("crank_torque", "mean_torque")
    if solved.space is not None:
        values |= (indicated := indicated_values(trace, solved.space, cycle))
        if solved.machine.angular_acceleration:
            # the torque that accelerates the parts is not periodic
            mean = gas_formulas.mean_torque(indicated["indicated_work"], cycle).named("mean_torque")
        if solved.space.gas.valves is not None:
            stated = StatedValves(solved.space.gas.valves, "gas.valves")
            values |= stated.drawn(trace["clearance_volume"], trace["swept_volume"])
            engine = solved.machine.engine
            if engine is None or len(engine.layout.places) == 1:
                # the delivery of several cylinders is that of the engine
                values |= stated.passed(
                    inlet_flow(values["induced_volume"], trace["speed"], cycle), indicated["indicated_power"]
                )
    if solved.machine.engine is not None:
        return values | {"mean_torque": mean}
    largest = max(abs(values[f"crank_torque_{word}"].value) for word in ("max", "min"))
    mean = delivered_or_needed(mean)
    return values | {"mean_torque": mean} | motor_of_crank(solved.machine, mean, trace["speed"], largest)


def _checks(
    solved: TracedCylinder, summary: Mapping[str, float], samples: Samples, over: CycleInterpolant
) -> dict[str, float]:
    """Return the residuals of identities between the results, relative to the largest term."""
    if "piston_force" not in solved.trace:
        return {}
    names = {key: own_key(solved.machine, key) for key in solved.trace}
    dense = _only(names, samples(CrankGrid.steps(_CHECK_STEP, solved.machine.cycle)))
    T, K, S, N = (dense[key] for key in ("tangential_force", "radial_force", "rod_force", "side_force"))
    P, r, l = dense["piston_force"], solved.lengths.crank_radius, solved.lengths.rod_length  # noqa: E741
    across = dense.get("rod_transverse_force", np.zeros_like(S))
    # the wall also carries the weight across the axis
    weight = dense.get("transverse_weight", np.zeros_like(S))
    height = r * np.cos(dense["crank_angle"]) + l * np.cos(dense["rod_angle"])
    rigid = "_rigid" if "rod_transverse_force" in dense else ""
    result = {
        f"crankpin_resultant{rigid}": relative_difference(T**2 + K**2, S**2 + across**2),
        f"pin_resultant{rigid}": relative_difference(P**2 + (N + weight) ** 2, S**2 + across**2),
        "overturning": relative_difference(T * r, weight * height - dense["overturning_moment"] - across * l),
    }
    if solved.method.is_exact:
        from crankwork.analysis.second_routes import joint_force_residuals  # noqa: PLC0415 - loaded where it is needed

        result |= joint_force_residuals(solved, samples)
        if "reduced_inertia" in dense:
            result["torque_of_energy"] = relative_difference(dense["crank_torque"], _torque_of_energy(solved, dense))
    if (space := solved.space) is None:
        return result
    if not solved.machine.angular_acceleration:
        work = over.mean("crank_torque", "mean_torque").value * math.radians(solved.machine.cycle)
        result["work"] = abs(work - summary["indicated_work"]) / moved_work(solved, summary)
    if space.gas.valves is not None:
        work = StatedValves(space.gas.valves, "gas.valves").work(space.clearance, space.swept)
        result["valves"] = abs(summary["indicated_work"] - space.gas.factor * work) / abs(work)
    calculated = space.calculated
    if calculated is not None and "first_law_residual" in calculated.values:
        residual, heat = calculated.values["first_law_residual"], calculated.values["fuel_heat"]
        result["first_law"] = abs(residual) / max(heat, moved_work(solved, summary))
    return result


def _torque_of_energy(solved: TracedCylinder, dense: Mapping[str, Array]) -> Array:
    """Return the torque of the work of gas and weights, less that of the change of kinetic energy."""
    w, eps, trace = solved.speed, solved.machine.angular_acceleration, solved.trace
    pushed = sum((dense[key] for key in ("gas_force", "weight_force") if key in dense), np.zeros_like(w))
    # the torque of the rotating mass includes its inertia
    turning = trace["rotating_mass"].value * solved.lengths.crank_radius**2
    rotating = dense.get("rotating_torque", 0.0) + turning * eps
    energy = w**2 / 2 * dense["reduced_inertia_1"] + dense["reduced_inertia"] * eps
    return np.asarray(pushed * dense["piston_velocity"] / w + rotating - energy)


def _allowed(solved: TracedCylinder, summary: Mapping[str, float]) -> dict[str, float]:
    """Return the residual of the work that the stated errors of torque and piston velocity allow."""
    if "crank_torque_error" not in summary or solved.space is None:
        return {}
    # the torque of the gas may be exact where the volume is not
    push = max(abs(summary[f"piston_force_{end}"]) for end in ("max", "min"))
    error = summary["crank_torque_error"] + push * summary["piston_velocity_error"] / solved.speed
    return {"work": error * math.radians(solved.machine.cycle) / moved_work(solved, summary)}


def moved_work(solved: TracedCylinder, summary: Mapping[str, float]) -> float:
    """Return the work of the largest torque over a cycle, as a scale; the net work may be zero."""
    largest = max(abs(summary["crank_torque_max"]), abs(summary["crank_torque_min"]))
    return largest * math.radians(solved.machine.cycle) or 1.0
