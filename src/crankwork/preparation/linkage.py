"""A linkage made ready: its traced motion, the speed of its driver, and the gas in its chambers."""

from __future__ import annotations

import math

from crankwork.formula.traced_value import TracedValue, given
from crankwork.kinematics.motion import Motion
from crankwork.kinematics.traced_motion import traced_motion
from crankwork.loads.chamber_gas import solve_chambers, with_equal_chambers
from crankwork.machine import Machine
from crankwork.preparation import traced_inputs
from crankwork.preparation.equal_cells import equal_cells
from crankwork.preparation.prepared import PreparedLinkage


def traced_linkage(machine: Machine, motion: Motion) -> tuple[Motion, PreparedLinkage]:
    """Return the traced motion of a linkage and the linkage made ready; equal cells are traced once.

    `motion`: the same in numbers, over its whole range.
    """
    cells = equal_cells(machine)
    traced = traced_motion(machine.mechanism, motion, machine.linkage, cells)
    return traced, solve_linkage(machine, traced)


def solve_linkage(machine: Machine, motion: Motion) -> PreparedLinkage:
    """Return a linkage made ready, with the gas in its chambers over its traced motion."""
    method = machine.method
    speed = machine.speed * method.pi / math.pi
    law = machine.mechanism.driver.law
    period = machine.mechanism.period
    turning = driver_speed_and_acceleration(machine, motion)
    left_out = {name for part in motion.equal_parts for name in part.chambers.values()}
    chambers = {name: chamber for name, chamber in machine.chambers.items() if name not in left_out}
    filling = solve_chambers(chambers, machine.charges, motion, method.pi, law, period, turning)
    filling = with_equal_chambers(filling, machine.chambers, motion.equal_parts)
    return PreparedLinkage(machine, method, speed, filling)


def driver_speed_and_acceleration(machine: Machine, motion: Motion) -> tuple[TracedValue, TracedValue]:
    """Return speed and acceleration of the driver's coordinate."""
    if motion.driver is not None:
        _, rate, change = motion.driver
        return rate, change
    return speed_of(machine), traced_inputs.acceleration(machine)


def speed_of(machine: Machine) -> TracedValue:
    """Return the angular speed of the crank, with the method's own pi."""
    if machine.method.pi == math.pi and not machine.stated:
        return given("speed", machine.speed, "crank.speed")
    return traced_inputs.speed(machine, machine.method)
