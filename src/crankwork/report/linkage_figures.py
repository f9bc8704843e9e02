"""The figures of a linkage, and of a table of transfer functions: which there are, from the results."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from crankwork.analysis import Results
from crankwork.analysis.linkage import linkage_columns, reachable
from crankwork.analysis.linkage_speed import speed_columns
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.linkage_machine import LinkageMachine
from crankwork.mechanism.structure import structure
from crankwork.quantities import Language
from crankwork.report.language import label, word
from crankwork.report.linkage_curves import curves
from crankwork.report.linkage_energy import Fluctuation, speed_curve, wittenbauer
from crankwork.report.linkage_look import Style
from crankwork.report.linkage_plan_figures import acceleration_plan, velocity_plan
from crankwork.report.linkage_positions import position_plans
from crankwork.report.summary import results_method

_DENSE_STEP = 2.0
_MAIN = 30.0
_PER_PANEL = 4


def linkage_figures(results: Results, *, language: Language = "en") -> dict[str, bytes]:
    """Return the figures of a linkage as SVG by name; those for which nothing is known are left out.

    Parameters
    ----------
    results : Results
        The results; curves are computed afresh, finer than their table.
    language : str
        Language of names, units and numbers.

    Returns
    -------
    dict of str to bytes
        `position_plans`, `velocity_plan`, `acceleration_plan`, `sliders`, `reduced_inertia`, `torques`,
        `joint_forces`, `wittenbauer`, `speed`; of a table only those of inertia and torques.

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    """
    machine, style = results.machine, Style(language, (), results_method(results, language))
    if not isinstance(machine, LinkageMachine):
        return _dynamics(results.grid, results.columns, style)
    found, _ = structure(machine.linkage)
    style = style._replace(links=found.links if found is not None else ())
    grid, notices = reachable(machine, CrankGrid.steps(_DENSE_STEP, 360.0))
    known = linkage_columns(results.solved, grid)
    drawn = _plans(machine, grid, results.solved.speed, style, is_whole=not notices)
    drawn |= _sliders(grid, known, style)
    drawn |= _dynamics(grid, known, style)
    if not notices and machine.drive.fluctuation is not None:
        drawn |= _evenness(machine, grid, known, results.solved.speed, style)
    return drawn


def _plans(machine: LinkageMachine, grid: CrankGrid, speed: float, style: Style, *, is_whole: bool) -> dict[str, bytes]:
    """Return position plans of the whole turn, and the plans of velocity and acceleration at one crank angle."""
    mechanism = machine.mechanism
    plans = {"position_plans": position_plans(mechanism, style=style)} if is_whole else {}
    index = int(np.argmin(np.abs(grid.degrees - _MAIN)))
    moving = linkage_motion(mechanism, grid)
    eps = machine.angular_acceleration
    return plans | {
        "velocity_plan": velocity_plan(mechanism, moving, index, speed, style),
        "acceleration_plan": acceleration_plan(mechanism, moving, index, speed, eps, style),
    }


def _sliders(grid: CrankGrid, known: Mapping[str, Array], style: Style) -> dict[str, bytes]:
    names = [key.partition(".")[2] for key in known if key.startswith("slider_displacement.")]
    kinds = ("slider_displacement", "slider_velocity", "slider_acceleration")
    panels = [[f"{kind}.{name}" for name in names[:_PER_PANEL]] for kind in kinds]
    if not names:
        return {}
    return {"sliders": curves(grid, known, panels, word("links", style.language), style)}


def _dynamics(grid: CrankGrid, known: Mapping[str, Array], style: Style) -> dict[str, bytes]:
    """Return reduced inertia, torques and joint forces."""
    result = {}
    inertia = [key for key in ("reduced_inertia", "reduced_inertia_1") if key in known and np.any(known[key])]
    if inertia:
        result["reduced_inertia"] = curves(grid, known, inertia, label("reduced_inertia", style.language), style)
    torques = [
        key for key in ("static_torque", "dynamic_torque", "driving_torque") if key in known and np.any(known[key])
    ]
    if torques:
        result["torques"] = curves(grid, known, [torques], label("driving_torque", style.language), style)
    joints = [key for key in known if key.partition(".")[0] == "joint_force" and np.any(known[key])]
    if joints:
        panels = [joints[start : start + _PER_PANEL] for start in range(0, len(joints), _PER_PANEL)]
        result["joint_forces"] = curves(grid, known, panels, word("joint_forces", style.language), style)
    return result


def _evenness(
    machine: LinkageMachine, grid: CrankGrid, known: Mapping[str, Array], speed: float, style: Style
) -> dict[str, bytes]:
    """Return the energy-mass diagram and the speed with the flywheel found."""
    found = speed_columns(machine, speed, known, grid.angle)
    if not found or machine.drive.fluctuation is None:
        return {}
    wanted = Fluctuation(speed, machine.drive.fluctuation)
    energy = found["kinetic_energy_change"]
    return {
        "wittenbauer": wittenbauer(known["reduced_inertia"], energy, wanted, grid.degrees, style),
        "speed": speed_curve(grid, found["crank_speed"], style),
    }
