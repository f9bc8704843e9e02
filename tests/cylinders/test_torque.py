"""Torque of many cylinders: angles, sums, torque along the shaft, harmonics and phase stars."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from crankwork.cylinders.arrangement import STANDARD_ORDERS, standard_orders, vee
from crankwork.cylinders.torque import (
    curve_harmonics,
    even_firing_interval,
    firing_intervals,
    mean_torque_of_work,
    phase_star,
    torque_harmonics,
    torques_along_shaft,
    total_harmonics,
)
from crankwork.errors import MethodError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.piston import piston_motion
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.method import Method
from crankwork.shaft.curve import Curve
from engines import cylinder_angle, standard_layout

pytestmark = pytest.mark.elsewhere

CYCLE = 4 * math.pi
EVEN = np.arange(0.0, 720.0, 1.25)
standards = st.sampled_from([one for one in STANDARD_ORDERS if one.strokes == 4])


def _standard(kind, cylinders):
    return standard_layout(standard_orders(kind, cylinders)[0])[0]


def _cylinder_angles(degrees, layout):
    return np.stack([cylinder_angle(degrees, place, layout.cycle) for place in layout.places])


def _wave(coefficients):
    """A torque over 720 degrees of known harmonics, orders 0.5, 1, 1.5, ..."""

    def torque(degrees):
        angle = np.radians(degrees)
        return 50 + sum(
            a * np.cos(k / 2 * angle) + b * np.sin(k / 2 * angle) for k, (a, b) in enumerate(coefficients, start=1)
        )

    return torque


waves = st.lists(st.tuples(st.floats(-100, 100), st.floats(-100, 100)), min_size=1, max_size=20)


# --- the angle of each cylinder


def test_cylinder_angles_of_decimal_degrees_are_decimals():
    layout = _standard("inline", 4)
    degrees = np.arange(0, 7201) / 10
    for place, row in zip(layout.places, _cylinder_angles(degrees, layout), strict=True):
        expected = (np.arange(0, 7201) - round(10 * place.firing_angle)) % 7200 / 10
        if place.number == 1:
            expected[-1] = 720.0
        assert np.array_equal(row, expected)


@given(standards, st.floats(-2000, 2000))
def test_a_cylinder_angle_is_the_angle_of_its_crankpin_from_its_own_axis(standard, degrees):
    layout, _ = standard_layout(standard)
    first = layout.places[0]
    for place in layout.places:
        own = cylinder_angle([degrees], place, layout.cycle)[0]
        crankpin = degrees + first.axis + place.pin_angle
        assert 0 <= own <= layout.cycle
        assert math.cos(math.radians(own)) == pytest.approx(math.cos(math.radians(crankpin - place.axis)), abs=1e-10)


def test_the_first_cylinder_keeps_its_angles_to_the_last_bit():
    degrees = np.linspace(0, 720, 1234)
    assert cylinder_angle(degrees, _standard("V", 8).places[0], 720.0) is degrees


# --- sums


def test_torque_along_the_shaft_of_a_four_cylinder_engine():
    """The table of accumulated torques, row by row: journal 1 is free, journal 5 carries all."""
    torques = np.array([[10.0, 1.0], [20.0, 2.0], [40.0, 4.0], [80.0, 8.0]])
    shaft = torques_along_shaft(torques, _standard("inline", 4))
    assert np.transpose(shaft.journals).tolist() == [[0, 10, 30, 70, 150], [0, 1, 3, 7, 15]]
    assert np.transpose(shaft.crankpins).tolist() == [[5, 20, 50, 110], [0.5, 2, 5, 11]]
    assert np.array_equal(shaft.journals[-1], torques.sum(axis=0))


def test_cylinders_of_one_throw_act_together_whatever_their_numbers():
    torques = 2.0 ** np.arange(8)[:, None]
    in_banks = torques_along_shaft(torques, vee(8, (1, 5, 4, 2, 6, 3, 7, 8), 90.0)[0])
    assert np.ravel(in_banks.throws).tolist() == [1 + 16, 2 + 32, 4 + 64, 8 + 128]
    in_pairs = torques_along_shaft(torques, vee(8, (1, 8, 4, 3, 6, 5, 7, 2), -90.0, numbering="pairs")[0])
    assert np.ravel(in_pairs.throws).tolist() == [1 + 2, 4 + 8, 16 + 32, 64 + 128]
    assert np.ravel(in_pairs.crankpins).tolist() == [1.5, 9, 39, 159]


def test_torques_must_be_a_row_per_cylinder():
    with pytest.raises(MethodError, match="4 rows, not 3"):
        torques_along_shaft(np.zeros((3, 10)), _standard("inline", 4))


@given(standards, waves)
def test_the_mean_of_the_sum_is_the_work_of_all_over_the_cycle(standard, wave):
    layout, _ = standard_layout(standard)
    torque = _wave(wave)
    total = torque(_cylinder_angles(EVEN, layout)).sum(axis=0)
    work = float(np.mean(torque(EVEN))) * CYCLE
    size = 50 + sum(map(sum, np.abs(wave)))
    count = len(layout.places)
    assert np.mean(total) == pytest.approx(mean_torque_of_work(count, work, CYCLE), abs=1e-12 * count * size)


def test_intervals_of_even_firing():
    assert firing_intervals(_standard("inline", 6)) == (120.0,) * 6
    assert math.degrees(even_firing_interval(CYCLE, 6)) == pytest.approx(120)


# --- harmonics


@given(waves)
def test_samples_give_back_the_harmonics_they_were_made_of(wave):
    found = torque_harmonics(_wave(wave)(EVEN), 720.0, 24)
    exact = np.zeros((24, 2))
    exact[: len(wave)] = wave
    size = 50 + np.abs(exact).sum()
    assert found.mean == pytest.approx(50, abs=1e-13 * size)
    assert found.cosine == pytest.approx(exact[:, 0], abs=1e-13 * size)
    assert found.sine == pytest.approx(exact[:, 1], abs=1e-13 * size)
    assert found.amplitude * np.cos(found.phase) == pytest.approx(exact[:, 0], abs=1e-12 * size)
    assert found.orders.tolist() == [k / 2 for k in range(1, 25)]


def test_two_strokes_have_whole_orders():
    assert torque_harmonics(np.zeros(100), 360.0, 4).orders.tolist() == [1, 2, 3, 4]


def test_harmonics_of_a_triangle_are_those_of_its_closed_form():
    """A triangle over the first half of 2 pi: c_k = (2 e^{-ik pi/2} - 1 - e^{-ik pi}) / (pi k^2) * 2 h / pi."""
    height = 90.0
    curve = Curve.linear([0, math.pi / 2, math.pi, 2 * math.pi], [0, height, 0, 0])
    found = curve_harmonics(curve, 30)
    k = np.arange(1, 31)
    exact = (2 * np.exp(-0.5j * k * math.pi) - 1 - np.exp(-1j * k * math.pi)) * 2 * height / (math.pi * k) ** 2
    assert found.cosine == pytest.approx(exact.real, abs=1e-13 * height)
    assert found.sine == pytest.approx(-exact.imag, abs=1e-13 * height)
    assert found.mean == pytest.approx(height / 4)


def test_the_inertia_torque_of_two_terms_has_four_sine_harmonics():
    """Kolchin and Demidov, chapter 7: lambda/4, -1/2, -3 lambda/4, -lambda^2/4 times m r^2 w^2."""
    lengths, grid = SliderCrank(0.04, 0.16), CrankGrid.from_degrees(np.arange(0.0, 360.0, 2.0))
    piston = piston_motion(lengths, grid, Method(kinematics="textbook")).piston
    found = torque_harmonics(-piston.position_1 * piston.position_2 / 0.04**2, 360.0, 6)
    lam = 0.25
    assert found.sine == pytest.approx([lam / 4, -1 / 2, -3 * lam / 4, -(lam**2) / 4, 0, 0], abs=1e-15)
    assert found.cosine == pytest.approx(np.zeros(6), abs=1e-15)


def test_too_few_samples_are_refused():
    with pytest.raises(MethodError, match="10 harmonics need more than 20 samples, not 20"):
        torque_harmonics(np.zeros(20), 720.0, 10)


@settings(max_examples=60)
@given(standards, waves)
def test_the_harmonics_of_the_sum_are_those_of_one_times_the_phase_star(standard, wave):
    layout, _ = standard_layout(standard)
    torque = _wave(wave)
    summed = torque_harmonics(torque(_cylinder_angles(EVEN, layout)).sum(axis=0), 720.0, 24)
    by_star = total_harmonics(torque_harmonics(torque(EVEN), 720.0, 24), layout)
    size = len(layout.places) * (50 + sum(map(sum, np.abs(wave))))
    for one, other in zip(summed[:5], by_star[:5], strict=True):
        assert one == pytest.approx(other, abs=1e-13 * size)
    assert by_star.amplitude * np.sin(by_star.phase) == pytest.approx(by_star.sine, abs=1e-13 * size)


# --- phase stars


def test_an_even_engine_sums_to_zero_in_every_other_order():
    layout = _standard("inline", 6)
    for k in range(1, 30):
        star = phase_star(layout, k / 2)
        assert np.abs(star.vectors) == pytest.approx(np.ones(6), rel=1e-15)
        assert abs(star.sum) == pytest.approx(6 if k % 6 == 0 else 0, abs=1e-13)


def test_the_star_of_a_six_cylinder_engine_of_order_one_and_a_half():
    """1-5-3-6-2-4: cylinders 1, 3 and 2 against 5, 6 and 4."""
    star = phase_star(_standard("inline", 6), 1.5)
    assert star.vectors.tolist() == [1, 1, 1, -1, -1, -1]
