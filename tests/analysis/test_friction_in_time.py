"""Machines let go whose joints rub: run-downs, and swings that die away and stay, against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import crankwork

pytestmark = pytest.mark.elsewhere
G = 9.80665

WHEEL = """
fixed_points.O = ["0 m", "0 m"]
friction = {{ circle = "{circle}", pins.O = {{ radius = "10 mm", coefficient = 0.2, moment = "{moment} N*m" }} }}
method.weights = true
[crank]
pivot = "O"
pin = "P"
radius = "0.3 m"
start = "{start} deg"
speed = "60 rpm"
mass = "5 kg"
inertia = "{inertia} kg*m2"
centre = ["{centre} m", "0 m"]
[transient]
time = "{time} s"
speed = "{speed} rad/s"
"""


def let_go(text: str, **values: object) -> crankwork.Results:
    given = {"start": 0, "inertia": 0.5, "centre": 0, "circle": "tangent", "moment": 0, "time": 200, "speed": 20}
    return crankwork.analyse(crankwork.read_machine(text.format(**(given | values))))


def rests(results: crankwork.Results) -> tuple[float, float]:
    """When and at which crank angle it comes to rest."""
    listing = results.listings["transient_events"]
    row = next(row for row, name in enumerate(listing.names) if name.startswith("comes_to_rest"))
    return float(listing.columns["time"][row]), float(listing.columns["crank_angle"][row])


def test_a_wheel_runs_down_in_its_bearing() -> None:
    """M = rho m g + M_0 stops it after J w / M, and J w^2 / (2 M) round; there it stays."""
    for circle, radius in (("tangent", 2e-3), ("sine", 2e-3 / math.sqrt(1.04))):
        for speed in (20.0, -20.0):
            results = let_go(WHEEL, circle=circle, moment=0.05, speed=speed)
            torque = radius * 5 * G + 0.05
            time, angle = rests(results)
            assert time == pytest.approx(0.5 * 20 / torque, rel=1e-12), (circle, speed)
            assert angle == pytest.approx(math.copysign(0.5 * 400 / 2 / torque, speed), rel=1e-12), (circle, speed)
            assert results.checks["energy_balance"] < 1e-12, (circle, speed)
            assert results.summary["final_speed"] == 0.0, (circle, speed)


def test_a_pendulum_in_a_rubbing_bearing() -> None:
    """It rests as soon as it stands within the angle whose sine is rho / l; before, against another integration."""
    results = let_go(WHEEL, start=-40, inertia=0.6, centre=0.3, speed=0, time=400)
    mass, lever, inertia, rho = 5.0, 0.3, 0.6, 2e-3

    def acceleration(angle: float, rate: float) -> float:
        """The force in the bearing depends on the acceleration, and this on the moment of the force."""
        found = 0.0
        for _ in range(60):
            along = mass * (lever * rate**2 + G * -math.sin(angle))
            across = mass * (lever * found + G * math.cos(angle))
            moment = -math.copysign(rho * math.hypot(along, across), rate)
            found = (-mass * G * lever * math.cos(angle) + moment) / inertia
        return found

    stopped = lambda _, y: y[1]  # noqa: E731
    stopped.terminal = True
    time, angle = 0.0, math.radians(-40)
    for _ in range(6):
        stopped.direction = 1 if angle > -math.pi / 2 else -1
        start = [angle, -math.copysign(1e-300, angle + math.pi / 2)]
        part = solve_ivp(
            lambda _, y: [y[1], acceleration(y[0], y[1])], (time, time + 9), start, "DOP853", rtol=3e-14, atol=1e-15,
            events=stopped,
        )  # fmt: skip
        time, angle = part.t[-1], part.y[0, -1]
    listing = results.listings["transient_events"]
    back = [row for row, name in enumerate(listing.names) if name.startswith("turns_back")]
    assert float(listing.columns["time"][back[5]]) == pytest.approx(time, rel=1e-8)
    assert math.radians(-40) + listing.columns["crank_angle"][back[5]] == pytest.approx(angle, rel=1e-9)
    _, last = rests(results)
    from_bottom = math.radians(-40) + last + math.pi / 2
    assert abs(math.sin(from_bottom)) < rho / lever
    before = math.radians(-40) + listing.columns["crank_angle"][back[-2]] + math.pi / 2
    assert abs(math.sin(before)) > rho / lever
    assert results.checks["energy_balance"] < 1e-12


# a block hauled along a guide by a long rod, its weight pressing: the crank stands across
DRAWN = """
fixed_points.O = ["0 m", "0 m"]
links.rod = {{ joins = ["A", "B"], length = "0.3 m" }}
sliders.block = {{ guide = "floor", pin = "B", mass = "4 kg" }}
guides.floor = {{}}
positions.B = ["0.28 m", "0 m"]
[crank]
pivot = "O"
pin = "A"
radius = "0.1 m"
start = "90 deg"
speed = "60 rpm"
inertia = "0.02 kg*m2"
[friction.pins]
O = {{ radius = "12 mm", coefficient = 0.1 }}
A = {{ radius = "10 mm", coefficient = 0.15 }}
B = {{ radius = "8 mm", coefficient = 0.15, damping = "0.02 N*m*s/rad" }}
[friction.sliders]
block = {{ coefficient = 0.2, length = "60 mm", force = "1.5 N", damping = "2 N*s/m" }}
[method]
weights = true
[transient]
time = "{time} s"
speed = "{speed} rad/s"
"""


OVERHUNG = DRAWN.replace('pin = "B", mass', 'points = {{ B = ["20 mm", "-50 mm"] }}, centre = "B", mass').replace(
    "floor = {{}}", 'floor = {{ through = ["0 m", "50 mm"] }}'
)


@pytest.mark.parametrize("speed", [15.0, pytest.param(-15.0, marks=pytest.mark.slow)])
@pytest.mark.parametrize("drawn", [DRAWN, pytest.param(OVERHUNG, marks=pytest.mark.slow)], ids=["drawn", "overhung"])
def test_a_slider_crank_that_rubs_everywhere_loses_what_the_equilibrium_says(drawn: str, speed: float) -> None:
    """Energies against the losses of the equilibrium of all links, solved on its own at speeds and accelerations."""
    results = let_go(drawn, time=3.0, speed=speed)
    assert results.checks["energy_balance"] < 1e-11
    columns = results.listings["transient"].columns
    assert np.all(columns["friction_power"][:-1] >= 0.0)
    time, _ = rests(results)
    assert time < 3.0
    assert results.summary["final_speed"] == 0.0


@pytest.mark.parametrize("speed", [15.0, -15.0])
def test_friction_turns_round_with_a_piece_that_turns_round_in_its_dead_centres(speed: float) -> None:
    """Only the block rubs, by 3 N, and reverses at 0 and 180 degrees: energy goes with its way, 4 r a turn."""
    alone = DRAWN[: DRAWN.index("[friction.pins]")] + '[friction.sliders.block]\nforce = "3 N"\n'
    level = alone.replace('start = "90 deg"', 'start = "0 deg"')
    results = let_go(f'{level}[transient]\ntime = "4 s"\nspeed = "{{speed}} rad/s"\n', speed=speed)
    begun = 0.02 * speed**2 / 2
    _, angle = rests(results)
    turns, reached = abs(angle) // math.pi, abs(angle)
    place = 0.1 * math.cos(reached) + math.sqrt(0.09 - (0.1 * math.sin(reached)) ** 2)
    dead = 0.2 if turns % 2 else 0.4
    assert 3 * (0.2 * turns + abs(dead - place)) == pytest.approx(begun, rel=1e-9)
    assert results.checks["energy_balance"] < 1e-11


def test_what_stands_against_its_stop_stays_there() -> None:
    text = WHEEL.replace(
        "[transient]", '[transient]\ntorque = "1 N*m"\nstops = ["-90 deg", "90 deg"]\nstart = "90 deg"'
    )
    results = let_go(text, speed=0, time=2)
    assert results.summary["final_turn"] == 0.0
    assert rests(results)[0] == 0.0
