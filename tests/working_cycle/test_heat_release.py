"""The cycle from the heat released: formulas, limits with a closed form, conservation, and the closed diagram."""

import functools
import itertools
import math
import pickle
import sys
from dataclasses import replace

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from crankwork.errors import CrankworkError, MissingExtraError
from crankwork.formula.calculation import Calculation
from crankwork.formula.calculation_lines import Snapshot
from crankwork.formula.replay import replay
from crankwork.formula.traced_value import absent, in_order
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.dead_centres import dead_centres
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.loads.curves import hermite, hermite_slope
from crankwork.loads.indicator import Segment, quadrature
from crankwork.loads.traced_diagram import traced_pressure
from crankwork.working_cycle.calculated_cycle import Calculated
from crankwork.working_cycle.closed_gas import (
    EXPANSION,
    ClosedGas,
    HeatReleaseData,
    Stage,
    closed_gas,
    internal_energy_change,
    stages,
    wiebe_burning_rate,
    wiebe_burnt_fraction,
    woschni_coefficient,
    woschni_gas_speed,
)
from crankwork.working_cycle.diagram_parts import from_before_zero
from crankwork.working_cycle.pressure_models import _solved, heat_release
from each import for_each
from engines import cylinder_volumes

BORE, RATIO = 0.08, 9.0
CENTRAL = SliderCrank(0.04, 0.14, 0.0)
OFFSETS = for_each("offset", [0.0, 0.006, -0.006])
ENGINE = HeatReleaseData(BORE, 3000.0, 1e5, 340.0, heat=900.0)
TWO_STROKE = replace(ENGINE, cycle=360.0, exhaust_opens=70.0, intake_opens=52.0, intake_closes=65.0, heat=500.0)


def _clearance(lengths: SliderCrank) -> float:
    return math.pi * BORE**2 / 4 * lengths.stroke / (RATIO - 1)


@functools.cache
def _run(data: HeatReleaseData, lengths: SliderCrank = CENTRAL) -> Calculated:
    return heat_release(data, *cylinder_volumes(lengths, data.bore, _clearance(lengths)), dead_centres(lengths))


def _closed(data: HeatReleaseData, lengths: SliderCrank = CENTRAL) -> tuple[ClosedGas, list[tuple[Stage, Segment]]]:
    """Return the gas, and the stages of its closed period with their pressures."""
    centres, worked = from_before_zero(dead_centres(lengths)), Calculation()
    gas = closed_gas(data, *cylinder_volumes(lengths, data.bore, _clearance(lengths)), centres, worked)
    periods = [stage for stage in stages(data, centres) if stage.end > stage.start]
    return gas, [(period, segment) for period, (segment, _) in zip(periods, _solved(gas, periods, ()), strict=True)]


def _points(solved: list[tuple[Stage, Segment]]) -> tuple[np.ndarray, np.ndarray]:
    """Return the crank angles of the closed period and the pressures there."""
    knots, pressures = (np.concatenate([getattr(one, key) for _, one in solved]) for key in ("knots", "pressures"))
    first = np.append(True, np.diff(knots) > 0)
    return knots[first], pressures[first]


VOLUME, VOLUME_RATE = cylinder_volumes(CENTRAL, BORE, _clearance(CENTRAL))


# --- formulas


def test_the_wiebe_function_of_thirty_digits():
    with mpmath.workdps(30):
        s, m = mpmath.mpf("0.37"), mpmath.mpf("2.4")
        expected = 1 - mpmath.exp(-mpmath.mpf("6.908") * s ** (m + 1))
        assert float(abs(wiebe_burnt_fraction(0.37, 2.4) - expected)) < 1e-15
        rate = mpmath.diff(lambda at: 1 - mpmath.exp(-mpmath.mpf("6.908") * at ** (m + 1)), s) / mpmath.mpf("0.9")
        assert wiebe_burning_rate(0.37, 2.4, 0.9) == pytest.approx(float(rate), rel=1e-14)


def test_burning_ends_with_a_thousandth_left():
    assert wiebe_burnt_fraction(1.0, 1.7) == pytest.approx(0.999, abs=1e-6)


@for_each("m", [0.0, 0.8, 2.0, 3.5])
def test_the_rate_of_burning_integrates_to_what_has_burnt(m):
    assert quad(lambda s: wiebe_burning_rate(s, m, 1.0), 0, 0.6)[0] == pytest.approx(
        wiebe_burnt_fraction(0.6, m), rel=1e-11
    )


def test_woschni_with_pressure_in_kilopascals_of_thirty_digits():
    with mpmath.workdps(30):
        bore, kilopascals, kelvins, speed = (mpmath.mpf(one) for one in ("0.082", "5300", "2350", "31.5"))
        expected = mpmath.mpf("3.26") * bore ** mpmath.mpf("-0.2") * kilopascals ** mpmath.mpf("0.8")
        expected *= kelvins ** mpmath.mpf("-0.55") * speed ** mpmath.mpf("0.8")
    assert woschni_coefficient(0.082, 5.3e6, 2350.0, 31.5) == pytest.approx(float(expected), rel=1e-14)


def test_woschni_in_bars_has_the_constant_of_the_other_books():
    """The constant 130 goes with bars: 3.26 * 100^0.8 = 129.8."""
    assert woschni_coefficient(1.0, 1e5, 1.0, 1.0) == pytest.approx(130, rel=2e-3)


def test_the_gas_speed_without_burning_is_that_of_the_piston():
    assert woschni_gas_speed(EXPANSION.piston, 10.0, 0.0, 4e-4, 340.0, 1e5, 4e-4, 3e6, 2e6) == pytest.approx(22.8)
    burning = woschni_gas_speed(2.28, 10.0, EXPANSION.burning, 4e-4, 340.0, 1e5, 4e-4, 3e6, 2e6)
    assert burning - 22.8 == pytest.approx(3.24e-3 * 340 * 10)


@given(
    first=st.floats(1.3, 1.45), slope=st.floats(-9e-5, 0.0), start=st.floats(280.0, 500.0), end=st.floats(500.0, 2800.0)
)
def test_internal_energy_is_the_integral_of_the_specific_heat(first, slope, start, end):
    expected, _ = quad(lambda t: 5e-4 * 287 / (first + slope * t - 1), start, end, epsabs=0, epsrel=1e-13)
    assert internal_energy_change(5e-4 * 287.0, first, slope, start, end) == pytest.approx(expected, rel=1e-11)


# --- limits with a closed form


def test_without_heat_and_walls_the_gas_follows_the_isentrope():
    degrees, pressure = _points(_closed(replace(ENGINE, heat=0.0, has_wall_loss=False, heat_ratio=1.4))[1])
    invariant = pressure * VOLUME(degrees) ** 1.4
    assert np.max(np.abs(invariant / invariant[0] - 1)) < 1e-9


@pytest.mark.slow
@for_each("gamma", [1.3, 1.4])
@OFFSETS
def test_instant_burning_at_top_dead_centre_is_the_otto_cycle(gamma, offset):
    lengths = SliderCrank(0.04, 0.14, offset)
    instant = {"burning_advance": 0.01, "burning_duration": 0.02, "intake_closes": 0.0, "exhaust_opens": 0.0}
    result = _run(replace(ENGINE, heat_ratio=gamma, has_wall_loss=False, **instant), lengths)
    efficiency = result.values["closed_work"] / result.values["heat_released"]
    assert efficiency == pytest.approx(1 - RATIO ** (1 - gamma), rel=1e-6)
    peak = 1e5 * RATIO**gamma + (gamma - 1) * result.values["heat_released"] / _clearance(lengths)
    assert result.values["cylinder_pressure_max"] == pytest.approx(peak, rel=1e-5)


def test_a_machine_twice_as_large_has_the_same_pressures():
    data = replace(ENGINE, has_wall_loss=False)
    large = SliderCrank(0.08, 0.28, 0.0)
    volumes = cylinder_volumes(large, 2 * BORE, 8 * _clearance(CENTRAL))
    doubled = heat_release(replace(data, bore=2 * BORE, heat=8 * 900.0), *volumes, dead_centres(large))
    once = _run(data)
    knots = once.diagram.breaks
    pressures = (one.diagram.pressure(knots, np.ones_like(knots)) for one in (doubled, once))
    assert next(pressures) == pytest.approx(next(pressures), rel=1e-9)
    assert doubled.values["indicated_work"] == pytest.approx(8 * once.values["indicated_work"], rel=1e-9)


# --- conservation


@settings(deadline=None, max_examples=4)
@given(
    shape=st.floats(0.3, 4.0),
    duration=st.floats(10.0, 90.0),
    advance=st.floats(-5.0, 35.0),
    slope=st.sampled_from([0.0, -8e-5]),
    two_stroke=st.booleans(),
    offset=st.sampled_from([0.0, 0.006, -0.006]),
)
def test_the_first_law_holds(shape, duration, advance, slope, two_stroke, offset):
    data = replace(TWO_STROKE if two_stroke else ENGINE, burning_shape=shape, burning_duration=duration)
    data = replace(data, burning_advance=advance, heat_ratio=1.39, heat_ratio_slope=slope)
    lengths = SliderCrank(0.04, 0.14, offset)
    values = _run(data, lengths).values
    assert abs(values["first_law_residual"]) < 1e-8 * values["heat_released"]
    gas, solved = _closed(data, lengths)
    work, wall = sum(segment.work(gas.volume_at) for _, segment in solved), 0.0
    for period, segment in solved:
        nodes, weights = quadrature(segment.knots)
        wall += weights @ gas.rates(nodes, segment.rounded(nodes), period)[2]
    assert work == pytest.approx(values["closed_work"], rel=1e-8)
    assert wall == pytest.approx(values["wall_heat"], rel=1e-7)
    left = values["heat_released"] - wall - work - values["internal_energy_change"]
    assert abs(left) < 1e-8 * values["heat_released"]


def test_the_pressure_gives_back_the_burning_that_made_it():
    """The apparent heat release of the diagram, as one takes it from measured pressure."""
    result = _run(replace(ENGINE, has_wall_loss=False))
    burning = next(one for one in result.diagram.segments if one.start == pytest.approx(340.0))
    at = np.linspace(341.0, 389.0, 97)
    pressure = hermite(burning.knots, burning.pressures, burning.slopes, at)
    rise = np.degrees(hermite_slope(burning.knots, burning.pressures, burning.slopes, at))
    g = ENGINE.heat_ratio
    heat = g / (g - 1) * pressure * VOLUME_RATE(at) + VOLUME(at) * rise / (g - 1)
    s = (at - 340.0) / 50.0
    assert heat / 900.0 == pytest.approx(wiebe_burning_rate(s, 2.0, math.radians(50.0)), rel=1e-4, abs=1e-5)


def test_without_walls_the_pressure_is_an_integral_over_the_burning():
    """P V^g = p1 V1^g + (g - 1) Q times the integral of V^(g - 1) dx, in one quadrature."""
    result = _run(replace(ENGINE, has_wall_loss=False))

    def volume(degrees):
        return float(VOLUME(np.array([degrees]))[0])

    g, end = ENGINE.heat_ratio, 372.0

    def integrand(s):
        exponent = 6.908 * s**3
        return volume(340.0 + 50.0 * s) ** (g - 1) * 3 * 6.908 * s**2 * math.exp(-exponent)

    released = quad(integrand, 0.0, (end - 340.0) / 50.0, epsabs=0, epsrel=1e-12)[0]
    expected = (1e5 * volume(230.0) ** g + (g - 1) * 900.0 * released) / volume(end) ** g
    found = result.diagram.pressure(np.array([end]), VOLUME(np.array([end])))[0]
    assert found == pytest.approx(expected, rel=1e-8)


def test_a_march_in_small_steps_with_its_own_equations_ends_at_the_same_work():
    """Runge-Kutta, kinematics of a central mechanism and Woschni in kilopascals, all written out here."""
    area = math.pi * BORE**2 / 4
    clearance, swept, omega, mean_speed = area * 0.08 / 8, area * 0.08, 100 * math.pi, 8.0

    def kinematics(phi):
        root = math.sqrt(0.14**2 - (0.04 * math.sin(phi)) ** 2)
        x = 0.18 - 0.04 * math.cos(phi) - root
        return x, 0.04 * math.sin(phi) + 0.04**2 * math.sin(phi) * math.cos(phi) / root

    shut = clearance + area * kinematics(math.radians(230))[0]
    g, mass = 1.33, 1e5 * shut / (287.0 * 340.0)

    def rates(degrees, pressure, begun, burning):
        x, speed = kinematics(math.radians(degrees))
        volume, growth = clearance + area * x, area * speed
        temperature = pressure * volume / (mass * 287.0)
        motored = 1e5 * (shut / volume) ** 1.35
        w = 2.28 * mean_speed
        if begun:
            w += 3.24e-3 * swept * 340.0 / (1e5 * shut) * max(pressure - motored, 0.0)
        h = 3.26 * BORE**-0.2 * (pressure / 1000) ** 0.8 * temperature**-0.55 * w**0.8
        wall = h * (2 * area + math.pi * BORE * x) * (temperature - 450.0) / omega
        s = (degrees - 340.0) / 50.0
        heat = 900.0 * 3 * 6.908 * s**2 * math.exp(-6.908 * s**3) / math.radians(50.0) if burning else 0.0
        return (g - 1) / volume * (heat - wall) - g * pressure / volume * growth, pressure * growth, wall

    pressure, work, lost = 1e5, 0.0, 0.0
    for start, end, begun, burning in ((230, 340, False, False), (340, 390, True, True), (390, 480, True, False)):
        count = (end - start) * 8
        h, step = 1 / 8, math.radians(1 / 8)
        for k in range(count):
            at = start + k * h
            one = rates(at, pressure, begun, burning)
            two = rates(at + h / 2, pressure + step / 2 * one[0], begun, burning)
            three = rates(at + h / 2, pressure + step / 2 * two[0], begun, burning)
            four = rates(at + h, pressure + step * three[0], begun, burning)
            change = [step / 6 * (a + 2 * b + 2 * c + d) for a, b, c, d in zip(one, two, three, four, strict=True)]
            pressure, work, lost = pressure + change[0], work + change[1], lost + change[2]
    values = _run(ENGINE).values
    assert values["closed_work"] == pytest.approx(work, rel=1e-8)
    assert values["wall_heat"] == pytest.approx(lost, rel=1e-8)


def test_the_ideal_gas_law_holds_along_the_trace():
    gas, solved = _closed(ENGINE)
    degrees, pressure = _points(solved)
    constant = pressure * VOLUME(degrees) / gas.temperature(degrees, pressure)
    assert constant == pytest.approx(np.full_like(constant, constant[0]), rel=1e-12)
    lost = sum(
        np.trapezoid(gas.rates(one.knots, one.pressures, period)[2], np.radians(one.knots)) for period, one in solved
    )
    assert _run(ENGINE).values["wall_heat"] == pytest.approx(lost, rel=1e-4)


# --- the diagram


@pytest.mark.slow
@OFFSETS
@for_each("data", [ENGINE, TWO_STROKE], ids=["four strokes", "two strokes"])
def test_the_diagram_is_closed_and_without_gaps_or_steps(data, offset):
    segments = _run(data, SliderCrank(0.04, 0.14, offset)).diagram.segments
    assert (segments[0].start, segments[-1].end) == (0.0, data.cycle)
    for one, other in itertools.pairwise([*segments, segments[0]]):
        assert one.end % data.cycle == pytest.approx(other.start, abs=1e-9)
        assert one.pressures[-1] == pytest.approx(other.pressures[0], rel=1e-9)
    for one in segments:
        assert (one.knots[0], one.knots[-1]) == (one.start, one.end)
        assert np.all(np.diff(one.knots) > 0)


@OFFSETS
def test_valves_and_burning_count_from_the_true_dead_centres(offset):
    lengths = SliderCrank(0.04, 0.14, offset)
    top, bottom = dead_centres(lengths)
    starts = [one.start for one in _run(ENGINE, lengths).diagram.segments]
    for angle in (top + 15, bottom, bottom + 50, top + 340, top + 390, bottom + 300, bottom + 420, top + 705):
        assert min(abs(np.array(starts) - angle)) < 1e-9


def test_exchange_of_gas_stays_between_its_pressures():
    result = _run(ENGINE)
    for segment in result.diagram.segments:
        if segment.start >= 480 or segment.end <= 230:
            inside = segment.pressure(np.linspace(segment.start, segment.end, 400), np.empty(400))
            ends = sorted((segment.pressures[0], segment.pressures[-1]))
            assert np.all((inside >= ends[0] - 1e-6) & (inside <= ends[1] + 1e-6))


def test_the_pressure_has_no_corner_where_burning_begins_and_ends():
    segments = {round(one.start): one for one in _run(replace(ENGINE, has_wall_loss=False)).diagram.segments}
    assert segments[230].slopes[-1] == pytest.approx(segments[340].slopes[0], rel=1e-9)
    jump = segments[340].slopes[-1] - segments[390].slopes[0]
    assert abs(jump) < 0.03 * np.max(np.abs(segments[340].slopes)), "one thousandth of the fuel is left"


def test_extremes_are_those_of_the_curve():
    result = _run(ENGINE)
    values, fine = result.values, np.linspace(350.0, 400.0, 200_001)
    pressure = result.diagram.pressure(fine, VOLUME(fine))
    assert values["cylinder_pressure_max"] == pytest.approx(np.max(pressure), rel=1e-9)
    assert values["cylinder_pressure_max_angle"] == pytest.approx(math.radians(fine[np.argmax(pressure)]), abs=4e-5)
    rise = np.gradient(pressure, np.radians(fine))
    assert values["pressure_rise_max"] == pytest.approx(np.max(rise), rel=1e-4)


# --- steps, notices, refusals


def test_what_stands_behind_the_greatest_pressure_is_told():
    data = replace(ENGINE, heat=None, fuel_per_cycle=2.5e-5, heating_value=43e6, burning_efficiency=0.9)
    found = _run(data)
    assert found.values["fuel_heat"] == pytest.approx(967.5, rel=1e-12)
    volume = VOLUME(np.array([230.0]))[0]
    assert found.peak["gas_mass"].value == pytest.approx(1e5 * volume / (287 * 340), rel=1e-12)
    assert abs(found.peak["pressure_rise.peak"].value) < 1e-3 * found.values["pressure_rise_max"], "no rise at the peak"
    lines = {one.key: one for one in Snapshot(CrankGrid.from_degrees, 0.0).steps(found.worked)}
    assert lines["heat_transfer_coefficient.peak"].values["p_cyl"] == found.values["cylinder_pressure_max"]
    assert lines["fuel_heat"].values == {"m_fuel": 2.5e-5, "H_fuel": 43e6, "eta_burn": 0.9}


def test_what_was_found_can_be_kept_and_read_again():
    found = _run(ENGINE)
    again = pickle.loads(pickle.dumps(found))  # noqa: S301 - written by the line itself
    assert again.values == found.values
    pressure = again.trace["closed_work"].node.operands[0]
    grid = CrankGrid.from_degrees([240.0, 350.0, 372.0])
    volume = np.ones(3)
    assert np.array_equal(replay(pressure, grid), found.diagram.pressure(grid.degrees, volume))


def test_the_pressure_at_any_angle_is_followed_to_the_heat():
    found = _run(TWO_STROKE)
    pressure = traced_pressure(found.diagram, absent("cylinder_volume"))
    grid = CrankGrid.steps(3.7, 360.0)
    assert np.array_equal(replay(pressure, grid), found.diagram.pressure(grid.degrees, grid.degrees))
    assert {"fuel_heat", "burning_shape", "residual_pressure"} <= {one.key for one in in_order([pressure])}


@pytest.mark.slow
@for_each(
    ("changes", "code"),
    [
        ({"burning_shape": 7.0}, "heat_shape"),
        ({"burning_duration": 8.0}, "heat_duration"),
        ({"heat_ratio": 1.6}, "heat_ratio"),
        ({"heat": 2500.0}, "heat_temperature"),
        ({"burning_duration": 20.0, "heat": 1500.0}, "heat_knock"),
        ({"wall_temperature": 1500.0}, "heat_walls"),
    ],
)
def test_values_beyond_the_usual_are_said(changes, code):
    assert code in {one for one, _ in _run(replace(ENGINE, **changes)).notices}


def test_a_rise_of_pressure_beyond_the_usual_is_told_in_megapascals_a_degree():
    """Against differences of the pressure from step to step."""
    data = replace(ENGINE, burning_duration=20.0, heat=1500.0)
    told = dict(_run(data).notices)["heat_knock"]
    degrees, pressure = _points(_closed(data)[1])
    steepest = np.max(np.diff(pressure) / np.diff(degrees))
    assert told["rise"] == pytest.approx(steepest / 1e6, rel=0.01)
    assert told["limit"] == 0.8


def test_a_usual_cycle_needs_no_notice():
    assert _run(replace(ENGINE, heat=700.0)).notices == ()


@for_each(
    ("changes", "says"),
    [
        ({"burning_advance": 140.0}, "closed from"),
        ({"burning_duration": 180.0}, "closed from"),
        ({"heat": 60_000.0}, "more than any fuel gives; write less"),
        ({"heat_ratio": 1.02, "heat_ratio_slope": -1e-4}, "exceed 1"),
        ({"cycle": 360.0, "intake_opens": 70.0}, "exhaust open first"),
    ],
)
def test_what_makes_no_sense_is_refused(changes, says):
    with pytest.raises(CrankworkError, match=says):
        _run(replace(ENGINE, **changes))


def test_without_scipy_the_missing_part_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy.integrate", None)
    with pytest.raises(MissingExtraError, match="dynamics"):
        _run.__wrapped__(ENGINE)


def test_compression_of_two_strokes_begins_when_the_last_port_shuts():
    for intake, exhaust in ((50.0, 70.0), (70.0, 50.0)):
        ports = replace(TWO_STROKE, intake_closes=intake, exhaust_closes=exhaust)
        assert stages(ports, (0.0, 180.0))[0].start == 250.0
