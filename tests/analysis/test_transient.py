"""Machines let go, from their files: against integrations and closed forms written here, and what is told of them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import crankwork

EXAMPLES = Path(__file__).parents[2] / "examples"
PRESS = (EXAMPLES / "press-start.toml").read_text(encoding="utf-8")

pytestmark = pytest.mark.elsewhere


def let_go(text: str) -> crankwork.Results:
    return crankwork.analyse(crankwork.read_machine(text))


def told(results: crankwork.Results) -> list[str]:
    return [one.code for one in results.notices if one.code.startswith("transient")]


class Press:
    """The press of the example by the formulas of a central slider-crank, its ram above the crank."""

    r, length, to_centre, rod, rod_inertia, ram, beside, g = 0.08, 0.4, 0.15, 30.0, 0.5, 120.0, 40.0, 9.80665

    def __init__(self) -> None:
        rated, self.synchronous = 960 * math.pi / 30, 2 * math.pi * 50 / 3
        slip = (self.synchronous - rated) / self.synchronous
        self.breakdown = 2.2 * 5500 / rated
        self.slip = slip * (2.2 + math.sqrt(2.2**2 - 1))
        self.beside += 0.05 * 16**2

    def motor(self, speed: float) -> float:
        s = 1 - 16 * speed / self.synchronous
        return 16 * 2 * self.breakdown / (s / self.slip + self.slip / s) if s else 0.0

    def rates(self, q: float) -> tuple[float, float, float, float, float]:
        """Rates of ram, rod's centre and rod, and how far the ram is down."""
        sin, cos = math.sin(q), math.cos(q)
        beta = math.asin(self.r / self.length * sin)
        turning = -self.r * cos / (self.length * math.cos(beta))
        ram = -self.r * (sin + math.tan(beta) * cos)
        part = self.to_centre / self.length
        across, along = -self.r * cos * (1 - part), -self.r * sin + part * (ram + self.r * sin)
        down = self.r + self.length - self.r * cos - self.length * math.cos(beta)
        return ram, across, along, turning, down

    def inertia(self, q: float) -> float:
        ram, across, along, turning, _ = self.rates(q)
        return self.beside + self.ram * ram**2 + self.rod * (across**2 + along**2) + self.rod_inertia * turning**2

    def torque(self, q: float, speed: float) -> float:
        ram, _, along, _, down = self.rates(q)
        force = float(np.interp(down, [0.0, 0.13, 0.14, 0.16], [200.0, 200.0, 15e3, 20e3])) if ram * speed < 0 else 0.0
        return self.motor(speed) - self.g * (self.ram * ram + self.rod * along) + force * ram

    def acceleration(self, q: float, speed: float) -> float:
        h = 1e-30
        slope = self._complex_slope(q, h)
        return (self.torque(q, speed) - speed**2 * slope / 2) / self.inertia(q)

    def _complex_slope(self, q: float, h: float) -> float:
        z = complex(q, h)
        sin, cos = np.sin(z), np.cos(z)
        beta = np.arcsin(self.r / self.length * sin)
        turning, ram = -self.r * cos / (self.length * np.cos(beta)), -self.r * (sin + np.tan(beta) * cos)
        part = self.to_centre / self.length
        across, along = -self.r * cos * (1 - part), -self.r * sin + part * (ram + self.r * sin)
        whole = self.ram * ram**2 + self.rod * (across**2 + along**2) + self.rod_inertia * turning**2
        return float(whole.imag / h)

    def corners(self) -> list[float]:
        """Crank angles of one turn at which the law of the load changes."""
        found = [math.pi, 2 * math.pi]
        for way in (0.13, 0.14):
            low, high = 0.0, math.pi
            for _ in range(100):
                middle = (low + high) / 2
                low, high = (middle, high) if self.rates(middle)[4] < way else (low, middle)
            found.append(low)
        return sorted(found)


def test_a_press_started_by_its_motor_against_another_integration() -> None:
    """SciPy's DOP853 from corner to corner of the load, on formulas of the slider-crank."""
    results = let_go(PRESS.replace('until = "steady"\n', "").replace('"12 s"', '"2.5 s"'))
    press = Press()
    ahead = [one + 2 * math.pi * turn for turn in range(6) for one in press.corners()]
    time, state = 0.0, np.zeros(2)
    for corner in ahead:
        reached = lambda _, y, at=corner: y[0] - at  # noqa: E731
        reached.terminal = True
        part = solve_ivp(
            lambda _, y: [y[1], press.acceleration(y[0], y[1])], (time, 2.5), state, "DOP853", rtol=3e-14, atol=1e-15,
            events=reached,
        )  # fmt: skip
        time, state = part.t[-1], part.y[:, -1]
        if time >= 2.5:
            break
    assert results.summary["final_turn"] == pytest.approx(state[0], rel=1e-9)
    assert results.summary["final_speed"] == pytest.approx(state[1], rel=1e-9)
    assert results.checks["energy_balance"] < 1e-12


def test_the_end_of_a_start_is_the_steady_motion_found_apart() -> None:
    results = let_go(PRESS)
    assert told(results)[-1] == "transient_steady"
    assert results.checks["steady_cycle"] < 1e-11


SWING = """
fixed_points.O = ["0 m", "0 m"]
links.rod = { joins = ["A", "B"], length = "0.5 m" }
guides.floor = { through = ["0 m", "-0.2 m"] }
sliders.block = { guide = "floor", pin = "B", mass = "3 kg" }
positions.B = ["0.5 m", "-0.2 m"]
method.weights = true
transient = { time = "3 s", start = "40 deg", step = "10 ms" }
loads = [
    { kind = "damper", slider = "block", damping = "8 N*s/m" },
    { kind = "spring", slider = "block", stiffness = "100 N/m", free_length = "0.5 m", preload = "2 N" },
]
[crank]
pivot = "O"
pin = "A"
radius = "0.2 m"
speed = "60 rpm"
start = "-90 deg"
mass = "2 kg"
centre = ["0.1 m", "0 m"]
inertia = "0.03 kg*m2"
"""


def test_a_damped_swing_against_another_integration() -> None:
    """Pendulum, block, spring with preload and damper; the block at x = r sin q + sqrt(l^2 - (r - r cos q)^2)."""
    results = let_go(SWING)
    r, length, g = 0.2, 0.5, 9.80665

    def rate(_: float, state: np.ndarray) -> list[float]:
        q, w = state
        z = complex(q, 1e-30)
        h = r - r * np.cos(z)
        x_1 = r * np.cos(z) - h * r * np.sin(z) / np.sqrt(length**2 - h**2)
        inertia = 0.03 + 3 * x_1**2
        x = r * math.sin(q) + math.sqrt(length**2 - h.real**2)
        force = -100 * (x - 0.5) - 2 - 8 * x_1.real * w
        torque = -2 * g * 0.1 * math.sin(q) + force * x_1.real
        return [w, (torque - w * w * inertia.imag / 1e-30 / 2) / inertia.real]

    columns = results.listings["transient"].columns
    other = solve_ivp(
        rate, (0.0, 3.0), [math.radians(40), 0.0], "DOP853", rtol=3e-14, atol=1e-15, t_eval=columns["time"][:300]
    )
    assert columns["crank_angle"][:300] == pytest.approx(other.y[0], abs=1e-10)
    assert columns["crank_speed"][:300] == pytest.approx(other.y[1], abs=1e-9)
    q = columns["crank_angle"]
    longer = r * np.sin(q) + np.sqrt(length**2 - (r - r * np.cos(q)) ** 2) - 0.5
    stored = 50 * longer**2 + 2 * longer - 2 * g * 0.1 * np.cos(q)
    # the weights count from the origin, the block's from its guide
    assert columns["potential_energy"] == pytest.approx(stored - 3 * g * 0.2, rel=1e-12)
    assert results.checks["energy_balance"] < 1e-12


def test_a_motor_too_weak_says_what_is_missing() -> None:
    """At a crank angle of 90 degrees the weights need M; the motor gives less when it starts."""
    results = let_go(
        PRESS.replace("ratio = 16", "ratio = 0.1").replace('time = "12 s"', 'start = "270 deg"\ntime = "1 s"')
    )
    (stays,) = (one for one in results.notices if one.code == "transient_overcome")
    press = Press()
    gives = 0.1 * 2 * press.breakdown / (1 / press.slip + press.slip)
    assert stays.values["torque"] == pytest.approx(
        -press.torque(1.5 * math.pi, 0.0) + press.motor(0.0) - gives, rel=1e-9
    )


ROCKERS = """
fixed_points = {{ A = ["0 mm", "0 mm"], D = ["200 mm", "0 mm"] }}
[crank]
pivot = "A"
pin = "B"
radius = "150 mm"
speed = "10 rpm"
start = "60 deg"
mass = "1 kg"
centre = ["75 mm", "0 mm"]
[links]
BC = {{ joins = ["B", "C"], length = "80 mm", mass = "0.5 kg", points = {{ G = ["40 mm", "0 mm"] }}, centre = "G" }}
DC = {{ joins = ["D", "C"], length = "150 mm", mass = "1 kg", points = {{ H = ["75 mm", "0 mm"] }}, centre = "H" }}
[method]
weights = true
[transient]
time = "2 s"
{more}
"""


def happenings(results: crankwork.Results, word: str) -> list[float]:
    """The crank angles of what happens. [deg]"""
    listing = results.listings["transient_events"]
    angles = np.degrees(listing.columns["crank_angle"])
    return [float(angles[row]) for row, name in enumerate(listing.names) if name.startswith(word)]


def test_a_linkage_swings_through_the_dead_positions_of_its_crank() -> None:
    """They are 64.53290 degrees apart (closed form); energy is kept, and each side is passed as often as the other."""
    results = let_go(ROCKERS.format(more=""))
    low, high = sorted(set(np.round(happenings(results, "dead_position"), 6)))
    assert high - low == pytest.approx(64.532899, abs=1e-5)
    assert results.checks["energy_balance"] < 1e-8
    columns = results.listings["transient"].columns
    assert np.degrees(columns["crank_angle"]).min() >= low - 1e-6
    assert np.degrees(columns["crank_angle"]).max() <= high + 1e-6


def test_stops_hold_a_crank_that_has_dead_positions() -> None:
    results = let_go(ROCKERS.format(more='stops = ["-20 deg", "15 deg"]\nrestitution = 0.5'))
    met = happenings(results, "stop")
    assert len(met) > 3
    assert {round(one, 9) for one in met} <= {-20.0, 15.0}
    # what stops take is not missing
    assert results.checks["energy_balance"] < 1e-8


def message(results: crankwork.Results) -> str:
    (notice,) = (one for one in results.notices if one.code == "transient_unfollowed")
    return str(notice.values["message"])


def test_a_speed_in_a_dead_position_is_told() -> None:
    results = let_go(ROCKERS.format(more='start = "20.7931 deg"\nspeed = "40 rpm"'))
    assert "dead position of the crank" in message(results)
    assert "transient" not in results.listings


def test_a_crank_that_nothing_slows_is_told() -> None:
    """A block alone has a mass, and it stands still in its dead centres."""
    light = SWING.replace('mass = "2 kg"\ncentre = ["0.1 m", "0 m"]\ninertia = "0.03 kg*m2"\n', "")
    level = light.replace('through = ["0 m", "-0.2 m"]', 'through = ["0 m", "0 m"]').replace('"-0.2 m"]', '"0 m"]')
    told_of = message(let_go(level))
    assert "all that has a mass stands still" in told_of
    assert "crank.inertia" in told_of


@pytest.mark.parametrize("speed", ["90 rpm", "-90 rpm"])
def test_gas_pushes_either_way_round(speed: str) -> None:
    """Its work over volumes, from the diagram, against the energies, through more turns than one."""
    text = (EXAMPLES / "double-acting-steam.toml").read_text(encoding="utf-8")
    results = let_go(f'{text}\n[transient]\ntime = "2 s"\nspeed = "{speed}"\n')
    assert abs(results.summary["final_turn"]) > 2 * math.pi
    assert results.checks["energy_balance"] < 1e-11


def test_friction_in_time_needs_a_crank_that_turns_fully() -> None:
    rubbing = ROCKERS.format(more="").replace("[method]", '[friction.pins.C]\nmoment = "0.1 N*m"\n[method]')
    assert "only where the crank turns fully" in message(let_go(rubbing))


def test_a_time_that_no_number_of_steps_reaches_is_told_early_with_what_to_write() -> None:
    text = PRESS.replace('until = "steady"', "").replace("12 s", "1e6 s").replace('step = "20 ms"', "")
    results = let_go(text)
    notice = next(item for item in results.notices if item.code == "transient_many_steps")
    assert notice.values["steps"] < 1100
    time = notice.values["write"]
    assert time == pytest.approx(results["transient_time"])
    assert "transient_many_steps" not in told(let_go(text.replace("1e6 s", f"{time:g} s")))


def test_a_torque_against_the_crank_angle_is_told() -> None:
    motorless = PRESS.replace('until = "steady"', 'torque = "-3000 N*m"').replace("12 s", "0.1 s")
    assert "transient_backwards" in told(let_go(motorless))
    assert "transient_backwards" not in told(let_go(motorless.replace("-3000", "3000")))
