"""From an engine to its results over one cycle, with their summary and the checks on them."""

from __future__ import annotations

import importlib
import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from crankwork.analysis.results import Results
from crankwork.analysis.solved import Solved, solve
from crankwork.analysis.state import FORCES, HARMONICS, KINEMATICS, columns, harmonic_columns
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.extremes import acceleration_extremes, dead_centres, velocity_extremes
from crankwork.kinematics.lengths import mean_piston_speed
from crankwork.kinematics.piston import largest_error
from crankwork.loads import gas as gas_formulas
from crankwork.loads.cycle import quadrature
from crankwork.machine import Machine
from crankwork.method import Method

_DENSE_STEP, _ERROR_STEP = 0.1, 1.0
# what a cycle is calculated with or checked by, and the rest of a summary says in its own way
_NOT_SHOWN = ("first_law_residual", "rotational_speed")
_ROUNDING = 1e-13
GROUPS = {"kinematics": KINEMATICS, "harmonics": HARMONICS, "forces": FORCES}


def analyse_engine(machine: Machine, grid: CrankGrid | None = None, *, method: Method | None = None) -> Results:
    """Return everything a machine does over one cycle.

    Parameters
    ----------
    machine : Machine
        What to compute.
    grid : CrankGrid, shape (n,), optional
        Ascending crank angles for the columns, within one cycle; the machine's own table otherwise. [rad]
    method : Method, optional
        Instead of the machine's own.

    Returns
    -------
    Results
        Columns, summary, checks and notices.

    Raises
    ------
    CrankworkError
        If the mechanism cannot turn, or the diagram does not hang together.
    """
    solved = solve(machine, method or machine.method)
    if grid is None:
        grid = CrankGrid.steps(machine.table_step, machine.cycle, special=machine.table_special)
    dense = columns(solved, CrankGrid.steps(_DENSE_STEP, machine.cycle))
    table = columns(solved, grid) | harmonic_columns(solved, grid)
    summary = {
        **_geometry_summary(solved), **_motion_summary(solved), **_force_errors(solved), **_force_summary(solved, dense)
    }  # fmt: skip
    calculated = solved.space.calculated if solved.space is not None else None
    steps = calculated.steps if calculated is not None else ()
    results = Results(
        solved, grid, table, summary, _checks(solved, dense, summary), solved.notices, GROUPS, steps=steps
    )
    if machine.engine is None:
        return results
    # loaded when needed, as linkages are
    whole: Results = importlib.import_module("crankwork.analysis.whole_engine").with_whole_engine(results)
    return whole


def _geometry_summary(solved: Solved) -> dict[str, float]:
    lengths, machine, space = solved.lengths, solved.machine, solved.space
    top, bottom = dead_centres(lengths)
    result = {
        "crank_radius": lengths.crank_radius,
        "rod_length": lengths.rod_length,
        "rod_ratio": lengths.rod_ratio,
        "stroke": lengths.stroke,
    }
    if lengths.offset:
        result |= {
            "offset": lengths.offset,
            "top_dead_centre_angle": math.radians(top % 360),
            "bottom_dead_centre_angle": math.radians(bottom),
        }
    if machine.cylinder is not None:
        result["bore"] = machine.cylinder.bore
        result["piston_area"] = gas_formulas.piston_area(solved.method.pi, machine.cylinder.bore)
    if space is not None:
        result |= {
            "swept_volume": space.swept,
            "clearance_volume": space.clearance,
            "compression_ratio": gas_formulas.compression_ratio(space.swept, space.clearance),
        }
    if machine.masses is not None:
        result |= {
            "reciprocating_mass": machine.masses.reciprocating,
            "rotating_mass": machine.masses.rotating,
        }
    return {key: float(value) for key, value in result.items()}


def _motion_summary(solved: Solved) -> dict[str, float]:
    lengths, method, w = solved.lengths, solved.method, solved.speed
    n = solved.machine.speed * 30 / math.pi
    velocity_at, x_1 = velocity_extremes(lengths, method)
    unsteadiness = solved.machine.angular_acceleration / w**2
    acceleration_at, x_2 = acceleration_extremes(lengths, method, unsteadiness=unsteadiness)
    result = {
        "rotational_speed": solved.machine.speed,
        "speed": w,
        "mean_piston_speed": mean_piston_speed(lengths.stroke, n),
        **_extremes("piston_velocity", velocity_at, x_1 * w),
        **_extremes("piston_acceleration", acceleration_at, x_2 * w**2),
    }
    if solved.machine.angular_acceleration:
        result["angular_acceleration"] = solved.machine.angular_acceleration
    if not method.is_exact:
        error = largest_error(lengths, method, unsteadiness=unsteadiness)
        result |= {
            "piston_displacement_error": error[0],
            "piston_velocity_error": error[1] * w,
            "piston_acceleration_error": error[2] * w**2,
        }
    return {key: float(value) for key, value in result.items()}


def _extremes(key: str, degrees: Array, values: Array) -> dict[str, float]:
    """Return the largest and smallest value of a quantity and the crank angles where they stand."""
    # of a plateau the first angle counts, whatever rounding says
    spare = _ROUNDING * (float(np.ptp(values)) + float(np.max(np.abs(values))))
    high, low = int(np.argmax(values >= np.max(values) - spare)), int(np.argmax(values <= np.min(values) + spare))
    return {
        f"{key}_max": float(values[high]),
        f"{key}_max_angle": math.radians(degrees[high]),
        f"{key}_min": float(values[low]),
        f"{key}_min_angle": math.radians(degrees[low]),
    }


def _force_errors(solved: Solved) -> dict[str, float]:
    """Return how far the forces of an approximate method are from those of the exact one at most."""
    if solved.method.is_exact or (solved.machine.masses is None and solved.space is None):
        return {}
    exact = solve(solved.machine, replace(solved.method.named("exact"), inertia_rod_ratio=None))
    grid = CrankGrid.steps(_ERROR_STEP, solved.machine.cycle)
    one, other = columns(solved, grid), columns(exact, grid)
    keys = ("inertia_force", "piston_force", "side_force", "tangential_force", "radial_force", "crank_torque")
    return {f"{key}_error": float(np.max(np.abs(one[key] - other[key]))) for key in keys if key in one}


def _force_summary(solved: Solved, dense: Mapping[str, Array]) -> dict[str, float]:
    if "piston_force" not in dense:
        return {}
    degrees = np.degrees(dense["crank_angle"])
    result: dict[str, float] = {}
    for key in ("gas_pressure", "inertia_force", "piston_force", "side_force", "tangential_force", "crank_torque"):
        if key in dense:
            result |= _extremes(key, degrees, dense[key])
    if solved.machine.masses is not None:
        result["rotating_inertia_force"] = float(dense["rotating_inertia_force"][0])
    cycle = math.radians(solved.machine.cycle)
    nodes, weights = quadrature(_breaks(solved))
    torque = columns(solved, CrankGrid.from_degrees(nodes))["crank_torque"]
    mean = float(weights @ torque) / cycle
    # a torque that does no work leaves rounding only
    result["mean_torque"] = mean if abs(mean) > _ROUNDING * float(np.max(np.abs(torque))) else 0.0
    if solved.space is not None:
        work = solved.space.work
        if solved.space.calculated is not None:
            result |= _cycle_values(solved.space.calculated.values)
        result |= {
            "indicated_work": work,
            "indicated_mean_pressure": float(gas_formulas.indicated_mean_pressure(work, solved.space.swept)),
            "indicated_power": float(gas_formulas.indicated_power(work, solved.speed, cycle)),
        }
    return result


def _cycle_values(values: Mapping[str, float]) -> dict[str, float]:
    """Return what a calculation of the cycle has to say in a summary: what the rest does not say as well."""
    own = {"indicated_work", "indicated_mean_pressure", "piston_area", "swept_volume", "bore", "stroke"}
    shown = {key: value for key, value in values.items() if key not in _NOT_SHOWN}
    return {f"{key}.cycle" if key in own else key: value for key, value in shown.items()}


def _breaks(solved: Solved) -> Array:
    ends = [0.0, solved.machine.cycle]
    return np.array(sorted({*ends, *solved.space.diagram.breaks.tolist()} if solved.space is not None else ends))


def _checks(solved: Solved, dense: Mapping[str, Array], summary: Mapping[str, float]) -> dict[str, float]:
    """Return the residuals of identities between the results, relative to the largest term."""
    if "piston_force" not in dense:
        return {}
    T, K, S, N = (dense[key] for key in ("tangential_force", "radial_force", "rod_force", "side_force"))
    P, r, l = dense["piston_force"], solved.lengths.crank_radius, solved.lengths.rod_length  # noqa: E741
    across = dense.get("rod_transverse_force", np.zeros_like(S))
    # what the wall takes beside the rod: the weight across the axis
    weight = dense.get("transverse_weight", np.zeros_like(S))
    height = r * np.cos(dense["crank_angle"]) + l * np.cos(dense["rod_angle"])
    rigid = "_rigid" if "rod_transverse_force" in dense else ""
    result = {
        f"crankpin_resultant{rigid}": _residual(T**2 + K**2, S**2 + across**2),
        f"pin_resultant{rigid}": _residual(P**2 + (N + weight) ** 2, S**2 + across**2),
        "overturning": _residual(T * r, weight * height - dense["overturning_moment"] - across * l),
    }
    if solved.space is not None and not solved.machine.angular_acceleration:
        work = summary["mean_torque"] * math.radians(solved.machine.cycle)
        result["work"] = abs(work - summary["indicated_work"]) / max(abs(work), 1e-300)
    calculated = solved.space.calculated if solved.space is not None else None
    if calculated is not None and "first_law_residual" in calculated.values:
        residual, heat = calculated.values["first_law_residual"], calculated.values["fuel_heat"]
        result["first_law"] = abs(residual) / max(heat, 1e-300)
    return result


def _residual(one: Array, other: Array) -> float:
    scale = float(np.max(np.abs(one)))
    return float(np.max(np.abs(one - other))) / scale if scale else 0.0
