"""The figures of a drawn linkage, and of what is reduced to a driver: which there are, from the results."""

from __future__ import annotations

import itertools
from collections.abc import Mapping

import numpy as np

from crankwork.analysis import Array, Results
from crankwork.analysis.diagrams import Fluctuation
from crankwork.analysis.moving import moving, reached_angles
from crankwork.analysis.plans import DriverRates, driver_rates
from crankwork.locale import say
from crankwork.machine import Machine
from crankwork.mechanism.linkage import Linkage
from crankwork.mechanism.structure import structure
from crankwork.quantities import Language
from crankwork.report.chambers import chamber_figures
from crankwork.report.language import label
from crankwork.report.linkage_curves import curves
from crankwork.report.linkage_energy import speed_curve, wittenbauer
from crankwork.report.linkage_look import Style
from crankwork.report.linkage_plan_figures import acceleration_plan, velocity_plan
from crankwork.report.linkage_positions import position_plans
from crankwork.report.linkage_transient import transient_figures
from crankwork.report.summary import results_method
from crankwork.report.tables import any_nonzero
from crankwork.show.scene import Drawing

_DENSE_STEP = 2.0
_MAIN = 30.0
_PER_PANEL = 4


def linkage_figures(results: Results, *, language: Language = "en") -> dict[str, Drawing]:
    """Return the figures of a linkage by name; those for which nothing is known are left out."""
    style = Style(language, (), results_method(results, language), results.period)
    if results.machine.linkage is None:
        return _dynamics(results.grid.degrees, results.columns, style)
    return _of_drawing(results, results.machine.linkage, style)


def _of_drawing(results: Results, linkage: Linkage, style: Style) -> dict[str, Drawing]:
    """Return the figures of a linkage that was drawn, between its dead positions."""
    machine, (found, _) = results.machine, structure(linkage)
    style = style._replace(links=found.links if found is not None else ())
    degrees, is_whole = reached_angles(machine, _DENSE_STEP)
    known = results.columns_at(degrees)
    rates = driver_rates(results, known)
    if style.period:
        drawn, both = _driver(degrees, known, style), np.abs(rates.first * rates.second)
        # where the driver moves, and gets faster or slower if it ever does
        at = int(np.argmax(both if np.any(both) else np.abs(rates.first)))
    else:
        drawn, at = {}, int(np.argmin(np.abs(degrees - _MAIN)))
    drawn |= _plans(machine, degrees, at, rates, style, is_whole=is_whole)
    drawn |= _sliders(degrees, known, style)
    drawn |= chamber_figures(results, degrees, known, style)
    drawn |= _dynamics(degrees, known, style)
    drawn |= transient_figures(results, style)
    if is_whole:
        drawn |= _evenness(machine, degrees, known, results.solved.speed, style)
    return drawn


def _plans(
    machine: Machine, degrees: Array, at: int, rates: DriverRates, style: Style, *, is_whole: bool
) -> dict[str, Drawing]:
    """Return position plans of all that is reached, and the plans of velocity and acceleration at one crank angle.

    `at`: which of the crank angles.
    """
    mechanism = machine.mechanism
    ends = None if is_whole else (float(degrees[0]), float(degrees[-1]))
    plans = {"position_plans": position_plans(mechanism, ends, style=style)}
    moved, first, second = moving(mechanism, degrees), float(rates.first[at]), float(rates.second[at])
    return plans | {
        "velocity_plan": velocity_plan(mechanism, moved, at, first, style),
        "acceleration_plan": acceleration_plan(mechanism, moved, at, first, second, style),
    }


def _driver(degrees: Array, known: Mapping[str, Array], style: Style) -> dict[str, Drawing]:
    """Return coordinate and rates of the driver, its force or torque, its power."""
    panels = [key for key in known if key.startswith("driver_")]
    return {"driver": curves(degrees, known, panels, say("tables.driver", style.language), style)}


def _sliders(degrees: Array, known: Mapping[str, Array], style: Style) -> dict[str, Drawing]:
    names = [key.partition(".")[2] for key in known if key.startswith("slider_displacement.")]
    kinds = ("slider_displacement", "slider_velocity", "slider_acceleration")
    panels = [[f"{kind}.{name}" for name in names[:_PER_PANEL]] for kind in kinds]
    if not names:
        return {}
    return {"sliders": curves(degrees, known, panels, say("tables.links", style.language), style)}


def _dynamics(degrees: Array, known: Mapping[str, Array], style: Style) -> dict[str, Drawing]:
    """Return reduced inertia, torques and joint forces."""
    result = {}
    inertia = any_nonzero(("reduced_inertia", "reduced_inertia_1"), known)
    if inertia and "dynamic_torque" in known:
        result["reduced_inertia"] = curves(degrees, known, inertia, label("reduced_inertia", style.language), style)
    torques = any_nonzero(("static_torque", "dynamic_torque", "driving_torque"), known)
    if torques:
        result["torques"] = curves(degrees, known, [torques], label("driving_torque", style.language), style)
    result |= _friction(degrees, known, style)
    joints = any_nonzero((key for key in known if key.partition(".")[0] == "joint_force"), known)
    if joints:
        panels = [joints[start : start + _PER_PANEL] for start in range(0, len(joints), _PER_PANEL)]
        result["joint_forces"] = curves(degrees, known, panels, say("tables.joint_forces", style.language), style)
    return result


def _friction(degrees: Array, known: Mapping[str, Array], style: Style) -> dict[str, Drawing]:
    """Return what the driver needs with and without friction, and the efficiency."""
    pairs = (("balancing_torque", "torque_with_friction"), ("driver_force", "driver_force_with_friction"),
             ("driver_torque", "driver_torque_with_friction"))  # fmt: skip
    panels = [[one for one in pair if one in known] for pair in pairs if pair[1] in known]
    ratio = [["instantaneous_efficiency"]] if "instantaneous_efficiency" in known else []
    if not panels or not all(np.isfinite(known[key]).any() for key in itertools.chain(*panels, *ratio)):
        return {}
    title = say("tables.friction", style.language)
    return {"friction": curves(degrees, known, [*panels, *ratio], title, style)}


def _evenness(
    machine: Machine, degrees: Array, known: Mapping[str, Array], speed: float, style: Style
) -> dict[str, Drawing]:
    """Return the energy-mass diagram and the speed with the flywheel found."""
    if "crank_speed" not in known:
        return {}
    course = {"speed": speed_curve(degrees, known["crank_speed"], style)}
    if machine.drive.fluctuation is None:
        return course
    wanted = Fluctuation(speed, machine.drive.fluctuation)
    energy, inertia = known["kinetic_energy_change"], known["reduced_inertia"]
    # without masses the energy stands over one point
    drawn = {"wittenbauer": wittenbauer(inertia, energy, wanted, degrees, style)} if np.any(inertia) else {}
    return drawn | course
