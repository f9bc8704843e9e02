"""The flywheel of a machine whose motor gives way, found by simulating until the speed has the fluctuation."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from crankwork.shaft.speed import ReducedMachine, SpeedRun, steady_speed

_STEPS = 40
_TOLERANCE = 1e-10


@dataclass(frozen=True)
class SimulatedFlywheel:
    """A flywheel found by simulation."""

    inertia: float  # Moment of inertia of the flywheel on the crank; NaN where none was found [kg m2]
    run: SpeedRun  # Steady motion with it
    residual: float  # Its fluctuation less the one asked for [-]
    message: str = ""  # Why none was found; empty if one was


def flywheel_by_simulation(
    machine: Callable[[float], ReducedMachine], speed: float, fluctuation: float, guess: float
) -> SimulatedFlywheel:
    """Return the flywheel with which the steady speed of a machine with its motor has a wanted fluctuation.

    Where the motor itself evens the speed out more than asked, none is found. `speed` and `guess` are roughly the speed
    and the inertia, such as that of `flywheel.flywheel` (artobolevsky_1988, ch. 16).

    The fluctuation falls about as the inverse of the inertia: the secant method acts on their logarithms.
    """
    tried: list[tuple[float, float]] = []
    at = math.log(guess)
    run = steady_speed(machine(guess), speed)
    for _ in range(_STEPS):
        if run.status != "steady":
            return SimulatedFlywheel(math.nan, run, math.nan, run.message)
        miss = math.log(run.fluctuation / fluctuation)
        if abs(miss) < _TOLERANCE:
            return SimulatedFlywheel(math.exp(at), run, run.fluctuation - fluctuation)
        slope = -1.0
        if tried and tried[-1][0] != at:
            slope = min((miss - tried[-1][1]) / (at - tried[-1][0]), -0.05)
        tried.append((at, miss))
        at -= max(-1.5, min(1.5, miss / slope))
        run = steady_speed(machine(math.exp(at)), run.mean_speed)
    message = (
        f"no flywheel gives a fluctuation of {fluctuation:g}: with {math.exp(tried[-1][0]):.4g} kg m2 it is "
        f"{fluctuation * math.exp(tried[-1][1]):.4g}; the motor evens the speed out by itself, or the machine's own "
        "inertia is enough"
    )
    return SimulatedFlywheel(math.nan, run, math.nan, message)
