"""What the moving masses of a linkage do to its foundation, its orders, and the best counterweight on the crank."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping

import numpy as np

from crankwork.dynamics.link_loads import arm, inertia_loads, moment_of
from crankwork.dynamics.reaction import shaking_force
from crankwork.dynamics.running import Running
from crankwork.formula.known import Found, Known, Total, total
from crankwork.formula.replay import Program
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.mechanism.mechanism import Crank

_ORDERS = (1, 2, 3, 4)
# share of the forces that are added which rounding leaves of nothing
_ROUNDING = 1e-13
_SAMPLES = 1440


def shaking(running: Running) -> Iterator[tuple[str, Known]]:
    """Yield force and moment of all moving masses on the ground, the moment about the pivot of the crank."""
    driver, loads = running.mechanism.driver, inertia_loads(running)
    x = total("shaking_force_x", [one.x for one in loads.forces])
    y = total("shaking_force_y", [one.y for one in loads.forces])
    yield from ((one.key, one) for one in (x, y, shaking_force(x, y).named("shaking_force")))
    if isinstance(driver, Crank):
        pivot = running.motion.frames[driver.link].origin
        moments = [moment_of(arm(pivot, one.point), (one.x, one.y), f"{one.link}.shaking") for one in loads.forces]
        turning = [one.torque for one in loads.torques]
        stated = [one for one in (*moments, *turning) if not one.is_absent]
        if stated:
            yield "shaking_moment", total("shaking_moment", stated)


def counterweight_balance(driver: Crank, memory: Mapping[str, Known], period: float) -> Iterator[tuple[str, Known]]:
    """Yield the largest force of each order, and the counterweight on the crank that takes the part that turns with it.

    That counterweight makes the mean square of the shaking force least. `period`: crank angle of a cycle [deg].
    """
    of = memory["shaking_force_x"], memory["shaking_force_y"]
    grid, turns = CrankGrid.from_degrees(np.arange(_SAMPLES) * period / _SAMPLES), round(period / 360.0)
    terms = [term for one in of for term in (one.node.operands if isinstance(one.node, Total) else (one,))]
    columns = Program({**dict(zip("xy", of, strict=True)), **{str(n): one for n, one in enumerate(terms)}})(grid)
    force = columns["x"] + 1j * columns["y"]
    size = np.max(np.sum([np.abs(columns[str(n)] + np.zeros(_SAMPLES)) for n in range(len(terms))], axis=0))
    coefficients = np.fft.fft(force) / _SAMPLES
    coefficients[np.abs(coefficients) <= _ROUNDING * size] = 0.0
    # of a cycle of two turns there are half orders too
    for count in range(1, _ORDERS[-1] * turns + 1):
        both = abs(coefficients[count]) + abs(coefficients[-count])
        yield f"free_force.{count / turns:g}", Known(Found(float(both), "harmonic", of))
    forward = complex(coefficients[driver.direction * turns])
    moment = Known(Found(abs(forward) / memory["speed"].value ** 2, "fourier", of))
    yield "counterweight_moment", moment
    if forward:
        angle = math.remainder(cmath.phase(-forward) - driver.start, math.tau)
        yield "counterweight_angle", Known(Found(angle, "fourier", of))
