"""Worked steps of flywheel and motor of a linkage."""

from __future__ import annotations

import math
from collections.abc import Iterator

from crankwork.analysis.linkage import SolvedLinkage, linkage_columns
from crankwork.analysis.results import Results
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.shaft import flywheel as flywheel_formulas
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import fluctuation_of_energy
from crankwork.shaft.flywheel_body import inertia_on_other_shaft
from crankwork.shaft.flywheel_parts import flywheel_beside_machine, work_of_mean_torque
from crankwork.shaft.motor_choice import needed_power
from crankwork.steps import AnyStep, Given, worked_step

# The step from which `analyse_linkage` makes curves. [deg]
_DENSE_STEP = 1.0
_SLOPES = {
    "wittenbauer": (flywheel_formulas.wittenbauer_slope_largest, flywheel_formulas.wittenbauer_slope_least),
    "exact": (flywheel_formulas.slope_largest, flywheel_formulas.slope_least),
}


def flywheel_steps(results: Results) -> Iterator[AnyStep]:
    """Yield the flywheel in the four ways; the excess work of each is found on the curves and given here.

    Parameters
    ----------
    results : Results
        Of a linkage; nothing where no flywheel is wanted or none does.
    """
    solved: SolvedLinkage = results.solved
    summary, w, drive = results.summary, solved.speed, solved.machine.drive
    if drive.fluctuation is None or "excess_work" not in summary:
        return
    known = linkage_columns(solved, CrankGrid.steps(_DENSE_STEP, 360.0))
    angle = known["crank_angle"]
    inertia = Curve.hermite(angle, known["reduced_inertia"], known["reduced_inertia_1"])
    torque = Curve.linear(angle, -known["static_torque"])
    machine_part = {"energy": float(inertia.mean), "mertsalov": float(inertia.extremes().least)}
    for found in flywheel_formulas.flywheels(inertia, torque, w, drive.fluctuation):
        way = found.way
        for word, slope in zip(("largest", "least"), _SLOPES.get(way, ()), strict=False):
            yield worked_step(slope, w, drive.fluctuation, key=f"wittenbauer_slope.{way}.{word}")
        yield Given("excess_work" if way == "energy" else f"excess_work.{way}", found.excess)
        needed = flywheel_formulas.inertia_for_fluctuation
        less, key = machine_part.get(way), f"flywheel_inertia.{way}"
        # of a machine that needs none the summary says zero, which no formula gives
        shown = found.inertia > 0
        if less is None:
            if shown:
                yield worked_step(needed, found.excess, drive.fluctuation, w, key=key)
            continue
        whole = worked_step(needed, found.excess, drive.fluctuation, w, key=f"whole_inertia.{way}")
        yield whole
        if shown:
            yield worked_step(flywheel_beside_machine, whole.value, less, key=key)
    if summary.get("mean_torque"):
        work = worked_step(work_of_mean_torque, summary["mean_torque"], 2 * math.pi)
        yield work
        yield worked_step(fluctuation_of_energy, summary["excess_work"], work.value)


def motor_steps(results: Results) -> Iterator[AnyStep]:
    """Yield the power that the motor needs and its inertia on the crank.

    Parameters
    ----------
    results : Results
        Of a linkage; nothing without a motor.
    """
    solved: SolvedLinkage = results.solved
    summary, drive = results.summary, solved.machine.drive
    if drive.motor is None:
        return
    if "motor_power" in summary and summary.get("mean_torque"):
        yield worked_step(needed_power, 1.0, summary["mean_torque"], solved.speed, drive.efficiency)
    if drive.motor.inertia:
        yield worked_step(inertia_on_other_shaft, drive.motor.inertia, drive.motor.ratio)
