"""What burned when, from a pressure made with a known Wiebe function by an integration of the first law of its own.

The pressures are solved by SciPy from the first law of a closed gas in a cylinder whose volume, heat to the walls (G.
Woschni, SAE 670931) and burning (I. I. Vibe) are written out here; no formula of crankwork is used for them.
"""

from __future__ import annotations

import functools
import math
from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import crankwork
from crankwork.kinematics.crank_grid import Array
from crankwork.working_cycle.burning_analysis import fitted_polytrope, wiebe_fit
from each import for_each

pytestmark = pytest.mark.elsewhere

BORE, STROKE, ROD_RATIO, RATIO, SPEED = 0.085, 0.09, 0.27, 10.0, 3000.0
AREA, RADIUS = math.pi * BORE**2 / 4, STROKE / 2
CLEARANCE = AREA * STROKE / (RATIO - 1)
SHUT, OPENS, HEAT, BEGINS, DURATION, SHAPE = 230.0, 490.0, 900.0, 345.0, 50.0, 1.8
FIRST, WARM, WALL = 0.95e5, 360.0, 450.0


class Gas(NamedTuple):
    """How the gas behaves: ratio of specific heats at 0 K and its slope, whether heat goes to the walls."""

    ratio: float = 1.33
    slope: float = 0.0
    loses: bool = False


PLAIN = Gas()


def displaced(degrees: Any) -> Any:
    """Return how far the piston is from the top. [m]"""
    sine = np.sin(np.radians(degrees))
    length = RADIUS / ROD_RATIO
    return RADIUS * (1 - np.cos(np.radians(degrees))) + length - np.sqrt(length**2 - (RADIUS * sine) ** 2)


def volume(degrees: Any) -> Any:
    return CLEARANCE + AREA * displaced(degrees)


def growth(degrees: float) -> float:
    """Return the derivative of the volume. [m3/deg]"""
    sine, cosine = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    swing = math.sqrt((RADIUS / ROD_RATIO) ** 2 - (RADIUS * sine) ** 2)
    return AREA * RADIUS * sine * (1 + RADIUS * cosine / swing) * math.pi / 180


def burnt(degrees: Any) -> Any:
    return 1 - np.exp(-6.908 * np.clip((degrees - BEGINS) / DURATION, 0, 1) ** (SHAPE + 1))


def rate(degrees: float) -> float:
    progress = (degrees - BEGINS) / DURATION
    if not 0 < progress < 1:
        return 0.0
    power = progress ** (SHAPE + 1)
    return 6.908 * (SHAPE + 1) / DURATION * power / progress * math.exp(-6.908 * power)


def right_side(degrees: float, state: Array, gas: Gas) -> list[float]:
    """Return the derivatives of pressure [Pa/deg] and of the heat to the walls [J/deg]."""
    pressure, V = state[0], float(volume(degrees))
    temperature = WARM * pressure * V / (FIRST * float(volume(SHUT)))
    wall = 0.0
    if gas.loses:
        piston = STROKE * SPEED / 30
        motored = FIRST * (float(volume(SHUT)) / V) ** 1.35
        burning = 3.24e-3 * AREA * STROKE * WARM / (FIRST * float(volume(SHUT))) * (pressure - motored)
        speed = 2.28 * piston + (burning if degrees > BEGINS else 0.0)
        transfer = 3.26 * (pressure / 1e3) ** 0.8 * speed**0.8 / BORE**0.2 / temperature**0.55
        area = 2 * AREA + math.pi * BORE * float(displaced(degrees))
        wall = transfer * area * (temperature - WALL) / (6 * SPEED)
    ratio = gas.ratio + gas.slope * temperature
    rise = (ratio - 1) / V * (HEAT * rate(degrees) - wall) - ratio * pressure / V * growth(degrees)
    return [rise, wall]


@functools.cache
def made(gas: Gas = PLAIN, step: float = 0.5) -> tuple[Array, Array, float]:
    """Return crank angles [deg], pressures [Pa] and the heat to the walls [J]."""
    degrees = np.arange(0.0, 720.0, step)
    pressure, state = np.full(degrees.shape, FIRST), np.array([FIRST, 0.0])
    for low, high in ((SHUT, BEGINS), (BEGINS, BEGINS + DURATION), (BEGINS + DURATION, OPENS)):
        inside = (degrees >= low) & (degrees <= high)
        at = np.unique([*degrees[inside], high])
        solved = solve_ivp(right_side, (low, high), state, "DOP853", at, args=(gas,), rtol=1e-10, atol=[1e-2, 1e-8])
        pressure[inside], state = solved.y[0, : inside.sum()], solved.y[:, -1]
    after = degrees > OPENS
    pressure[after] = np.maximum(1.05e5, state[0] - (state[0] - 1.05e5) * (degrees[after] - OPENS) / 40)
    return degrees, pressure, float(state[1])


MACHINE = """
crank = { stroke = "90 mm", speed = "3000 rpm" }
rod.ratio = 0.27
cylinder = { bore = "85 mm", compression_ratio = 10.0 }
gas.cycle = "720 deg"
gas.pressures = "absolute"
gas.measured = { file = "p.csv" MEASURED }
gas.combustion = { from = "230 deg", to = "490 deg" COMBUSTION }
"""


@pytest.fixture
def found(tmp_path):
    """Return what the analysis finds of pressures over crank angles, or over times. [deg] or [s], [Pa]"""

    def analysed(first: Array, pressure: Array, combustion: str = "", measured: str = "", unit: str = "deg"):
        head = "angle" if unit == "deg" else "time"
        columns = [first, *(pressure.reshape(len(first), -1).T / 1e5)]
        names = [f"{head} [{unit}]", *(f"p{k} [bar]" for k in range(1, len(columns)))]
        np.savetxt(tmp_path / "p.csv", np.stack(columns, axis=1), "%.9g", ";", header=";".join(names), comments="")
        text = MACHINE.replace("MEASURED", measured).replace("COMBUSTION", combustion)
        return crankwork.analyse(crankwork.read_machine(text, folder=tmp_path))

    return analysed


def differences(results: crankwork.Results) -> tuple[float, float]:
    """Return the largest difference of heat and of fraction from the known function, over the heat, at every angle."""
    degrees = np.arange(SHUT, OPENS + 0.1, 0.5)
    columns = results.columns_at(degrees, ("gross_heat", "burnt_fraction"))
    heat, fraction = columns["gross_heat"] / HEAT, columns["burnt_fraction"]
    return float(np.max(np.abs(heat - burnt(degrees)))), float(np.max(np.abs(fraction - burnt(degrees))))


@for_each("step", [0.5, 1.0])
def test_the_known_function_is_recovered_at_every_angle_without_losses(step, found):
    degrees, pressure, _ = made(step=step)
    results = found(degrees, pressure)
    # the function itself ends at 0.999
    assert max(differences(results)) < 0.0015
    for share in (10, 50, 90):
        angle = BEGINS + DURATION * (-math.log(1 - 0.999 * share / 100) / 6.908) ** (1 / (SHAPE + 1))
        assert math.degrees(results[f"burnt_angle.{share}"]) == pytest.approx(angle, abs=0.02)
    assert math.degrees(results["burning_start.fit"]) == pytest.approx(BEGINS, abs=1e-3)
    assert math.degrees(results["burning_duration.fit"]) == pytest.approx(DURATION, abs=1e-2)
    assert (results["burning_shape.fit"], results["fuel_heat.fit"]) == pytest.approx((SHAPE, HEAT), rel=1e-4)
    assert results.checks["first_law"] < 1e-9


def test_noise_of_two_hundredths_of_a_bar_leaves_one_per_cent(found):
    degrees, pressure, _ = made()
    for seed in range(3):
        noisy = pressure + np.random.default_rng(seed).normal(0.0, 2000.0, len(pressure))
        results = found(degrees, noisy, measured=', smooth = "5 deg"')
        assert max(differences(results)) < 0.01
        # a fit has the noise of all samples
        assert results["fuel_heat.fit"] == pytest.approx(HEAT, rel=2e-3)
        assert results["burning_shape.fit"] == pytest.approx(SHAPE, abs=0.03)


def test_heat_to_the_walls_and_a_ratio_that_falls_are_taken_out(found):
    gas = Gas(1.38, -6e-5, loses=True)
    degrees, pressure, wall = made(gas)
    stated = ', adiabatic_exponent = 1.38, exponent_slope = -6e-5, temperature = "360 K", wall_temperature = "450 K"'
    results = found(degrees, pressure, stated)
    assert max(differences(results)) < 0.0015
    assert results["wall_heat"] == pytest.approx(wall, rel=1e-3)
    assert results["heat_released"] == pytest.approx(0.999 * HEAT, rel=1e-3)
    # without its losses the gas seems to have got less heat
    plain = found(degrees, pressure, stated.replace(', wall_temperature = "450 K"', ""))
    assert plain["heat_released"] == pytest.approx(results["heat_released"] - wall, rel=2e-3)
    top = results.columns_at([380.0], ("cylinder_temperature", "gas_heat_ratio"))
    warm = WARM * float(pressure[760]) * float(volume(380.0)) / (FIRST * float(volume(SHUT)))
    assert top["cylinder_temperature"][0] == pytest.approx(warm, rel=1e-6)
    assert top["gas_heat_ratio"][0] == pytest.approx(1.38 - 6e-5 * warm, rel=1e-6)


def test_rates_are_those_of_the_known_function(found):
    degrees, pressure, _ = made()
    results = found(degrees, pressure)
    peak = BEGINS + DURATION * (SHAPE / (SHAPE + 1) / 6.908) ** (1 / (SHAPE + 1))
    assert results["gross_heat_rate_max"] * math.pi / 180 == pytest.approx(HEAT * rate(peak), rel=2e-3)
    assert math.degrees(results["gross_heat_rate_max_angle"]) == pytest.approx(peak, abs=1.0)
    rises = [
        right_side(at, np.array([p, 0.0]), PLAIN)[0] for at, p in zip(degrees[460:980], pressure[460:980], strict=True)
    ]
    assert results["pressure_rise_max"] * math.pi / 180 == pytest.approx(max(rises), rel=2e-3)


def test_polytropes_over_windows(found):
    degrees, pressure, _ = made()
    results = found(degrees, pressure, ', windows = [["250 deg", "330 deg"], ["410 deg", "480 deg"]]')
    windows = results.listings["fitted_polytropes"].columns
    assert windows["polytropic_exponent"] == pytest.approx([1.33, 1.33], abs=1e-6)
    assert np.degrees(windows["window_start"]) == pytest.approx([250.0, 410.0])


def test_a_recording_over_time_is_one_at_its_own_speed(found):
    degrees, pressure, _ = made()
    at_angles = found(degrees, pressure)
    seconds = degrees / 360 / 20
    over_time = found(seconds, pressure, measured=', time_column = 1, speed = "1200 rpm"', unit="s")
    assert over_time["burnt_angle.50"] == pytest.approx(at_angles["burnt_angle.50"], abs=1e-6)
    assert over_time["heat_released"] == pytest.approx(at_angles["heat_released"], rel=1e-6)


def test_statistics_of_cycles(found):
    degrees, pressure, _ = made(step=1.0)
    factors = np.array([0.9, 1.0, 1.05, 1.15])
    cycles = 1e5 + (pressure - 1e5)[:, None] * factors
    results = found(degrees, cycles, measured=', pressure_column = "2..5", cycle = "mean"')
    listed = results.listings["recorded_cycles"].columns
    # a pressure that is larger by a factor above a level does work that is larger by that factor
    single = found(degrees, 1e5 + (pressure - 1e5) * 1.0)["indicated_mean_pressure"]
    assert listed["indicated_mean_pressure"] == pytest.approx(single * factors, rel=1e-6)
    mean, deviation = 1.025, math.sqrt(((factors - 1.025) ** 2).sum() / 3)
    assert results["mean_pressure_variation"] == pytest.approx(deviation / mean, rel=1e-6)
    assert results["indicated_mean_pressure.deviation"] == pytest.approx(deviation * single, rel=1e-6)
    highest = 1e5 + (pressure.max() - 1e5) * factors
    assert listed["cylinder_pressure_max"] == pytest.approx(highest, rel=1e-6)
    assert results["peak_pressure_variation"] == pytest.approx(np.std(highest, ddof=1) / highest.mean(), rel=1e-6)
    assert results["cylinder_pressure_max_angle.mean"] == pytest.approx(math.radians(degrees[pressure.argmax()]))
    assert results["cylinder_pressure_max_angle.deviation"] == 0.0
    assert results["indicated_mean_pressure.mean"] == pytest.approx(results["indicated_mean_pressure"], rel=1e-6)


def test_a_fit_finds_the_function_that_it_is_given():
    degrees = np.linspace(300.0, 450.0, 301)
    fit = wiebe_fit(degrees, 5.0 + 700.0 * burnt(degrees), (340.0, 70.0))
    assert fit == pytest.approx((BEGINS, DURATION, SHAPE, 700.0, 0.0), abs=1e-5)


def test_a_polytrope_has_its_exponent():
    volumes = np.linspace(1e-4, 4e-4, 20)
    assert fitted_polytrope(volumes, 3e5 * (1e-4 / volumes) ** 1.27) == pytest.approx((1.27, 0.0), abs=1e-12)


@for_each(
    ["combustion", "mistake"],
    [
        (', wall_temperature = "450 K"', "gas.combustion.wall_temperature"),
        (
            ', burning = ["200 deg", "300 deg"]',
            "gas.combustion.burning: two angles must ascend from 230 deg to 490 deg",
        ),
        (', windows = [["300 deg", "250 deg"]]', r"gas.combustion.windows\[1\]: two angles must ascend"),
    ],
)
def test_what_contradicts_itself_is_refused(combustion, mistake, found):
    degrees, pressure, _ = made(step=1.0)
    with pytest.raises(crankwork.errors.InputError, match=mistake):
        found(degrees, pressure, combustion)


@for_each(("shift", "code"), [(-180, "burning_negative"), (-90, "burning_negative"), (180, "burning_unended"),
                          (45, "wiebe_unsettled"), (360, "burning_negative")])  # fmt: skip
def test_heat_of_a_wrong_dead_centre_has_no_fit_and_says_why(shift, code, found):
    degrees, pressure, _ = made()
    results = found(degrees, pressure, measured=f', shift = "{shift} deg"')
    told = [notice.code for notice in results.notices if notice.code.startswith(("wiebe", "burning_"))]
    assert told == ["burning_mass", code]
    assert not any(key.endswith(".fit") for key in results.summary)
    # angles of heat that never ends, or is none, mean nothing
    assert any(key.startswith("burnt_angle") for key in results.summary) == (code == "wiebe_unsettled")


@for_each("shift", [180, 90, -90, -180, 45, -60, 270, 300])
def test_the_advised_shift_counts_the_one_in_force(shift, found):
    degrees, pressure, _ = made()
    far = next(n for n in found(degrees, pressure, measured=f', shift = "{shift} deg"').notices if n.code == "peak_far")
    assert far.values["shift"] == 0.0


def test_a_wiebe_function_without_an_end_is_none():
    degrees = np.linspace(0.0, 100.0, 101)
    assert wiebe_fit(degrees, np.exp(degrees / 10), (10.0, 50.0)) is None
