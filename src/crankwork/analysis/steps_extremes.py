"""Worked steps of the extremes of motion and forces of an engine."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from crankwork.analysis.solved import Solved
from crankwork.analysis.steps_forces import force_steps
from crankwork.analysis.steps_motion import EngineMoment, Function, acceleration_step
from crankwork.dynamics import piston_forces as forces
from crankwork.kinematics import lengths as length_formulas
from crankwork.steps import AnyStep, Step, named_step


def extreme_steps(solved: Solved, summary: Mapping[str, float]) -> Iterator[Step]:
    """Yield the extremes of piston velocity and acceleration, in closed form where there is one.

    Otherwise they are the formulas of the motion at the crank angle that the results have found.

    Parameters
    ----------
    solved : Solved
        Machine and method.
    summary : mapping of str to float
        The summary of the results. [SI]
    """
    known = {
        "r": float(solved.lengths.crank_radius), "lam": float(solved.lengths.rod_ratio), "w": solved.speed,
    }  # fmt: skip
    steady = not solved.lengths.offset and not solved.machine.angular_acceleration
    kinematics = solved.method.kinematics
    closed: dict[str, Function] = {}
    if steady and kinematics != "series":
        closed["piston_acceleration_max"] = length_formulas.acceleration_at_top
    if steady and kinematics == "textbook":
        yield named_step(length_formulas.textbook_velocity_max_angle, known, key="piston_velocity_max_angle")
        closed["piston_acceleration_min"] = (
            length_formulas.acceleration_at_bottom
            if known["lam"] <= 1 / 4
            else length_formulas.textbook_acceleration_least
        )
    for key in (f"piston_{noun}_{end}" for noun in ("velocity", "acceleration") for end in ("max", "min")):
        if key in closed:
            yield named_step(closed[key], known, key=key)
            continue
        moment = EngineMoment.at(solved, math.degrees(summary[f"{key}_angle"])).functions
        yield (
            named_step(forces.piston_velocity, moment, key=key) if "velocity" in key else acceleration_step(moment, key)
        )


def force_extreme_steps(solved: Solved, summary: Mapping[str, float]) -> Iterator[AnyStep]:
    """Yield largest and smallest forces and torque, each at the crank angle where the results have found it.

    Parameters
    ----------
    solved : Solved
        Machine and method.
    summary : mapping of str to float
        The summary of the results. [SI]
    """
    for key in ("inertia_force", "piston_force", "side_force", "tangential_force", "crank_torque"):
        for end in ("max", "min"):
            angle = summary.get(f"{key}_{end}_angle")
            if angle is not None:
                # the angle has been through radians, and a vertical line of the diagram has two sides
                moment = EngineMoment.at(solved, round(math.degrees(angle), 9))
                step = next(one for one in force_steps(moment) if one.key == key)
                yield step._replace(key=f"{key}_{end}")
