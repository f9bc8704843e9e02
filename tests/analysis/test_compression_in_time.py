"""An engine that runs down, or is started, against the compression in its cylinder; motion solved apart by SciPy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import crankwork
from crankwork.kinematics.crank_grid import Array

pytestmark = [pytest.mark.elsewhere, pytest.mark.slow]

RADIUS, RATIO, MASS, WHEEL, EXPONENT, RUBBING = 0.045, 0.27, 0.4, 0.2, 1.35, 80.0
AREA = math.pi / 4 * 0.085**2
MACHINE = f"""
crank = {{ stroke = "90 mm" }}
rod.ratio = {RATIO}
piston.mass = "{MASS} kg"
cylinder = {{ bore = "85 mm", compression_ratio = 10.0 }}
flywheel.inertia = "{WHEEL} kg*m2"
gas.cycle = "360 deg"
gas.pressures = "absolute"
gas.ambient = "1 bar"
gas.points.o = {{ angle = "0 deg" }}
gas.points.a = {{ angle = "180 deg", pressure = "1 bar" }}
gas.points.c = {{ angle = "360 deg" }}
gas.pieces = [
    {{ law = "polytropic", exponent = {EXPONENT}, reference = "a", points = ["o", "a"] }},
    {{ law = "polytropic", exponent = {EXPONENT}, points = ["a", "c"] }},
]
friction.sliders.piston.force = "{RUBBING} N"
"""


def displaced(angle: float) -> tuple[float, float, float]:
    """Return the way of the piston with its derivatives by the crank angle. [m]"""
    sine, cosine, length = math.sin(angle), math.cos(angle), RADIUS / RATIO
    swing = math.sqrt(length**2 - (RADIUS * sine) ** 2)
    first = RADIUS * sine + RADIUS**2 * sine * cosine / swing
    bend = (cosine**2 - sine**2) / swing + RADIUS**2 * (sine * cosine) ** 2 / swing**3
    return RADIUS * (1 - cosine) + length - swing, first, RADIUS * cosine + RADIUS**2 * bend


def right_side(_: float, state: Array, torque: float) -> list[float]:
    angle, speed = state
    way, first, second = displaced(angle)
    clearance = AREA * 2 * RADIUS / 9
    pressure = 1e5 * (10 * clearance / (clearance + AREA * way)) ** EXPONENT
    force = (pressure - 1e5) * AREA - RUBBING * math.copysign(1, first * speed)
    pushing = torque + force * first - MASS * first * second * speed**2
    return [speed, pushing / (WHEEL + MASS * first**2)]


def test_an_engine_runs_down_against_its_compression() -> None:
    text = MACHINE + 'transient = { time = "0.3 s", speed = "600 rpm", start = "180 deg", step = "50 ms" }'
    rows = crankwork.analyse(crankwork.Description(text)).listings["transient"].columns
    start = [math.pi, 600 * math.pi / 30]
    solved = solve_ivp(
        right_side,
        (0, rows["time"][-1]),
        start,
        "DOP853",
        rows["time"],
        args=(0.0,),
        rtol=1e-9,
        atol=1e-9,
        max_step=1e-3,
    )
    assert rows["crank_angle"] == pytest.approx(solved.y[0], rel=2e-4)
    assert rows["crank_speed"] == pytest.approx(solved.y[1], rel=1e-3)
    # slower at every top dead centre than before it
    assert np.all(rows["crank_speed"] < start[1] + 1e-9)


@pytest.mark.parametrize(("torque", "passes"), [(20, False), (75, True)])
def test_a_torque_starts_an_engine_if_it_gets_over_the_compression(torque: int, passes: bool) -> None:
    text = MACHINE + f'transient = {{ time = "0.5 s", start = "180 deg", torque = "{torque} N*m", step = "100 ms" }}'
    rows = crankwork.analyse(crankwork.Description(text)).listings["transient"].columns
    angles = rows["crank_angle"] - (rows["crank_angle"][0] - math.pi)
    assert bool(np.max(angles) > 2 * math.pi) is passes
    solved = solve_ivp(
        right_side, (0, 0.2), [math.pi, 1e-9], "DOP853", [0.1], args=(float(torque),), rtol=1e-9, atol=1e-9
    )
    assert angles[1] == pytest.approx(solved.y[0, 0], rel=1e-4)
