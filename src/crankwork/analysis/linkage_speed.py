"""How evenly a linkage runs: flywheel in four ways, and the steady speed that motor and loads settle at."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from crankwork.analysis.solved import Notice
from crankwork.errors import MethodError
from crankwork.kinematics.crank_grid import Array
from crankwork.linkage_machine import LinkageMachine
from crankwork.loads.spring import Spring
from crankwork.shaft.curve import Curve
from crankwork.shaft.energy_machine import energy_machine
from crankwork.shaft.energy_motion import moment_after
from crankwork.shaft.fluctuation import excess_work, true_speed
from crankwork.shaft.flywheel import flywheel, flywheels
from crankwork.shaft.motor import GearedMotor
from crankwork.shaft.motor_choice import first_angle_beyond, motor_need
from crankwork.shaft.speed import ReducedMachine, steady_speed


def speed_summary(
    machine: LinkageMachine, speed: float, known: Mapping[str, Array]
) -> tuple[dict[str, float], tuple[Notice, ...]]:
    """Return single values about flywheel, motor and speed, and what the reader should know of them.

    Parameters
    ----------
    machine : LinkageMachine
        Its drive says what is wanted.
    speed : float
        Angular speed of the crank. [rad/s]
    known : mapping of str to array, shape (n,)
        Columns over one revolution from 0 to 360 degrees. [SI]

    Returns
    -------
    tuple of dict and tuple of Notice
        Values by key, and notices.
    """
    drive = machine.drive
    angle = known["crank_angle"]
    inertia, load = _curves(known)
    result: dict[str, float] = {}
    notices: tuple[Notice, ...] = ()
    added = 0.0
    if drive.fluctuation is not None:
        try:
            found = flywheels(inertia, load, speed, drive.fluctuation)
        except MethodError as error:
            return result, (Notice("no_flywheel", {"message": str(error)}),)
        result |= {"excess_work": found[0].excess, "speed_fluctuation": drive.fluctuation}
        # a way that finds a negative inertia says that it needs none
        result |= {f"flywheel_inertia.{one.way}": max(one.inertia, 0.0) for one in found}
        added = max(found[-1].inertia, 0.0)
    if drive.motor is not None and not np.any(known["reduced_inertia"]) and not added + drive.motor.reduced_inertia:
        notices += (Notice("no_steady_speed", {"message": "nothing has a mass; give masses, or motor.inertia"}),)
    elif drive.motor is not None:
        need = motor_need(Curve.linear(angle, known["static_torque"]), speed, efficiency=drive.efficiency)
        result["motor_power"] = need.mean_power
        if need.mean_power > drive.rated_power:
            powers: dict[str, float | str] = {"needed": need.mean_power / 1e3, "rated": drive.rated_power / 1e3}
            notices += (Notice("overloaded", powers),)
        more, told = _steady(drive.motor, speed, inertia, load, added)
        result, notices = result | more, notices + told
    return result, notices


def flywheel_residual(machine: LinkageMachine, speed: float, known: Mapping[str, Array]) -> dict[str, float]:
    """Return how far the simulated fluctuation is from the wanted one, with the exact flywheel.

    Parameters
    ----------
    machine : LinkageMachine
        Its drive says what is wanted.
    speed : float
        Mean angular speed of the crank. [rad/s]
    known : mapping of str to array, shape (n,)
        Columns over one revolution from 0 to 360 degrees. [SI]
    """
    if machine.drive.fluctuation is None:
        return {}
    try:
        return {"flywheel": abs(flywheel(*_curves(known), speed, machine.drive.fluctuation).residual)}
    except MethodError:
        return {}


def speed_columns(machine: LinkageMachine, speed: float, known: Mapping[str, Array], angle: Array) -> dict[str, Array]:
    """Return the change of kinetic energy and the true speed of the crank with the flywheel that is wanted.

    Parameters
    ----------
    machine : LinkageMachine
        Its drive says what is wanted.
    speed : float
        Mean angular speed of the crank. [rad/s]
    known : mapping of str to array, shape (n,)
        Columns over one revolution from 0 to 360 degrees. [SI]
    angle : array, shape (m,)
        Crank angles. [rad]

    Returns
    -------
    dict of str to array, shape (m,)
        `kinetic_energy_change` [J] and `crank_speed` [rad/s]; nothing where there is no such flywheel.
    """
    inertia, load = _curves(known)
    try:
        wheel = flywheel(inertia, load, speed, machine.drive.fluctuation or 0.0)
        turning = true_speed(inertia + wheel.inertia, load, speed)
    except MethodError:
        return {}
    return {"kinetic_energy_change": excess_work(load).curve(angle), "crank_speed": turning.speed(angle)}


def _curves(known: Mapping[str, Array]) -> tuple[Curve, Curve]:
    """Return reduced inertia and the torque of the loads, negative where they brake, over one revolution."""
    angle = known["crank_angle"]
    inertia = Curve.hermite(angle, known["reduced_inertia"], known["reduced_inertia_1"])
    return inertia, Curve.linear(angle, -known["static_torque"])


def _steady(
    motor: GearedMotor, speed: float, inertia: Curve, load: Curve, flywheel: float
) -> tuple[dict[str, float], tuple[Notice, ...]]:
    """Return the steady speed with the motor, or why there is none."""
    reduced = ReducedMachine.of_curves(inertia, load, motor, flywheel=flywheel + motor.reduced_inertia)
    run = steady_speed(reduced, speed)
    if run.status == "steady":
        return {"steady_speed": run.mean_speed, "steady_fluctuation": run.fluctuation}, ()
    speeds = np.linspace(0.0, 2 * speed, 400)
    greatest = float(np.max(motor.torque(speeds)))
    stalls = first_angle_beyond(load * -1.0, greatest)
    if stalls is None:
        return {}, (Notice("no_steady_speed", {"message": run.message}),)
    return {}, (Notice("stalls", {"torque": greatest, "angle": float(np.degrees(stalls))}),)


def transient_summary(machine: LinkageMachine) -> dict[str, float]:
    """Return crank angle and speed after the time of a transient.

    Parameters
    ----------
    machine : LinkageMachine
        With a transient.

    Returns
    -------
    dict of str to float
        Values by key; none without a transient.

    Raises
    ------
    MethodError
        If the linkage does not start, or stands still before that time, with the angle.
    """
    wanted = machine.transient
    if wanted is None:
        return {}
    springs = tuple(load for load in machine.loads if isinstance(load, Spring))
    moving = energy_machine(machine.mechanism, wanted.torque, springs, inertia=machine.drive.inertia)
    found = moment_after(moving, wanted.time, speed=wanted.speed)
    return {"transient_time": wanted.time, "final_turn": found.angle, "final_speed": found.speed}
