"""The motor that a machine needs: power, standard size, gear ratio to the crank."""

from __future__ import annotations

import math

from crankwork.formula.traced_value import ProcedureValue, TracedValue, absent, given
from crankwork.machine import Machine
from crankwork.preparation import traced_inputs
from crankwork.shaft import motor

# share of the largest torque below which a mean is rounding
_CANCELLED = 1e-12

# where the series of powers is published
SERIES_SOURCE = motor.POWERS_SOURCE


def selection_of(machine: Machine) -> motor.MotorSelection:
    """Return how a motor is selected: as stated, or as usual."""
    return machine.drive.selection or motor.MotorSelection()


def motor_of_crank(
    machine: Machine, mean: TracedValue | None, w: TracedValue, largest: float
) -> dict[str, TracedValue]:
    """Return `motor_choice` of a machine that must be driven and has no motor; empty for others.

    `largest`: largest torque on the crank [N m].
    """
    if machine.drive.motor is not None or mean is None or mean.key != "mean_driving_torque":
        return {}
    return motor_choice(machine, mean, w) if mean.value > _CANCELLED * largest else {}


def mean_power(mean: TracedValue, w: TracedValue) -> dict[str, TracedValue]:
    """Return the mean power at the crank."""
    return {"shaft_power": (mean * w).named("shaft_power")}


def motor_choice(machine: Machine, mean: TracedValue, w: TracedValue) -> dict[str, TracedValue]:
    """Return the mean power at the crank, that of the motor, its next standard size, and gear ratios by speed."""
    selection, pi = selection_of(machine), machine.method.pi
    path, reserve = "motor_selection.{}".format, absent("power_reserve", 1.0)
    if selection.reserve != 1.0:
        reserve = given("power_reserve", selection.reserve, path("reserve"))
    power = motor.needed_power(reserve, mean, w, traced_inputs.efficiency_of(machine.drive)).named("motor_power")
    result = mean_power(mean, w) | {"motor_power": power}
    size = motor.standard_power(power)
    if math.isfinite(size.value):
        result["standard_motor_power"] = TracedValue(
            ProcedureValue(size.value, "next_size", (power,), argument=size), "standard_motor_power"
        )
    slip, frequency = given("rated_slip", selection.slip, path("slip")), selection.frequency
    mains = given("mains_frequency", frequency, path("frequency"), "Hz")
    for pairs in motor.POLE_PAIRS:
        name = f"{60 * frequency / pairs:.6g}"
        field = motor.synchronous_speed(mains, given("pole_pairs", pairs), pi).named(f"synchronous_speed.{name}")
        result[f"motor_ratio.{name}"] = motor.gear_ratio_of_motor(field, slip, w).named(f"motor_ratio.{name}")
    return result
