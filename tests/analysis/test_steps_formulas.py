"""The formulas that exist for the steps, against the calculation that does without them, and against 30 digits."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.dynamics import force_parts
from crankwork.dynamics.tabulated import difference_derivative
from crankwork.kinematics import lengths, rod_functions, series_terms, textbook
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.extremes import dead_centres
from crankwork.kinematics.series import acceleration_harmonics, series_transfer
from crankwork.kinematics.slider_crank import SliderCrank, rod_angle_sine, rod_swing
from crankwork.kinematics.textbook import textbook_transfer_1, textbook_transfer_2
from crankwork.mechanism.freedom import chain_mobility

RADII = st.floats(0.01, 0.3)
RATIOS = st.floats(0.05, 0.6)
SHARES = st.floats(-0.5, 0.5)
ANGLES = st.floats(0.0, 360.0)


def _slider_crank(radius, ratio, share):
    """Return a slider-crank whose offset is a share of what the rod has to spare."""
    rod = radius / ratio
    return SliderCrank(radius, rod, share * (rod - radius))


@given(RADII, RATIOS, SHARES)
def test_stroke_and_dead_centres_are_those_of_the_mechanism(radius, ratio, share):
    one = _slider_crank(radius, ratio, share)
    r, l, e = one  # noqa: E741
    assert lengths.stroke_offset(l, r, e) == pytest.approx(one.stroke, rel=1e-11)
    top, bottom = (math.radians(angle) for angle in dead_centres(one))
    if e >= 0:
        assert lengths.top_dead_centre_angle(e, l, r) == pytest.approx(top, rel=1e-14, abs=1e-300)
    else:
        assert lengths.top_dead_centre_angle_before(math.pi, e, l, r) == pytest.approx(top + 2 * math.pi, rel=1e-14)
    assert lengths.bottom_dead_centre_angle(math.pi, e, l, r) == pytest.approx(bottom, rel=1e-14)


@given(RADII, RATIOS, SHARES, ANGLES)
def test_functions_of_the_rod_angle_in_thirty_digits(radius, ratio, share, angle):
    one = _slider_crank(radius, ratio, share)
    swing = rod_swing(one, CrankGrid.from_degrees([angle]))
    with mpmath.workdps(30):
        phi = mpmath.mpf(angle) * mpmath.pi / 180
        r, l, e = (mpmath.mpf(float(value)) for value in one)  # noqa: E741
        beta = mpmath.asin((r * mpmath.sin(phi) - e) / l)
        expected = {
            "angle": beta,
            "cosine": mpmath.cos(beta),
            "radial": mpmath.cos(phi + beta) / mpmath.cos(beta),
            "tangential": mpmath.sin(phi + beta) / mpmath.cos(beta),
            "pin": r * mpmath.cos(phi) + l * mpmath.cos(beta),
        }
    sin_phi, cos_phi = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    found = {
        "angle": rod_functions.rod_angle_of_functions(swing.sin, swing.cos),
        "cosine": rod_functions.rod_cosine(rod_angle_sine(one.rod_ratio, one.crank_radius, one.offset, sin_phi)),
        "radial": rod_functions.radial_factor(swing.cos_sum, swing.cos),
        "tangential": rod_functions.tangential_factor(swing.sin_sum, swing.cos),
        "pin": rod_functions.pin_distance(one.crank_radius, cos_phi, one.rod_length, swing.cos),
    }
    for key, value in expected.items():
        assert float(np.squeeze(found[key])) == pytest.approx(float(value), rel=1e-13, abs=2e-15), key


@given(st.floats(0.05, 0.9))
def test_closed_extremes_of_the_textbook_are_extremes(ratio):
    angle = float(lengths.textbook_velocity_max_angle(ratio))
    here = textbook_transfer_2(1.0, ratio, math.cos(angle), math.cos(2 * angle))
    assert here == pytest.approx(0.0, abs=1e-14)
    phi = np.radians(np.arange(0.0, 360.0, 0.25))
    velocity = textbook_transfer_1(1.0, ratio, np.sin(phi), np.sin(2 * phi))
    assert textbook_transfer_1(1.0, ratio, math.sin(angle), math.sin(2 * angle)) >= np.max(velocity)
    acceleration = textbook_transfer_2(1.0, ratio, np.cos(phi), np.cos(2 * phi))
    assert lengths.acceleration_at_top(1.0, 1.0, ratio) == pytest.approx(np.max(acceleration), rel=1e-14)
    least = lengths.textbook_acceleration_least if ratio > 0.25 else lengths.acceleration_at_bottom
    # a quarter of a degree aside an extreme is off by the square of that
    assert least(1.0, 1.0, ratio) == pytest.approx(np.min(acceleration), abs=2e-5)
    assert least(1.0, 1.0, ratio) <= np.min(acceleration) + 1e-14


def test_the_least_acceleration_of_the_field_tables():
    """At a ratio of 1/4 both closed forms give -3/4 of r w^2."""
    assert lengths.textbook_acceleration_least(1.0, 1.0, 0.25) == -0.75
    assert lengths.acceleration_at_bottom(1.0, 1.0, 0.25) == -0.75


@given(RATIOS, SHARES, st.integers(1, 12), ANGLES)
def test_terms_of_a_series_add_up_to_the_series(ratio, share, order, angle):
    one = _slider_crank(0.1, ratio, share)
    grid = CrankGrid.from_degrees([angle])
    start = one.top_dead_centre
    sums = np.zeros(3)
    for k, (a, b) in enumerate(zip(*acceleration_harmonics(one, order), strict=True), start=1):
        cos, sin = math.cos(k * math.radians(angle)), math.sin(k * math.radians(angle))
        sums += (
            series_terms.series_displacement_term_offset(a, math.cos(k * start), b, math.sin(k * start), cos, sin, k),
            series_terms.series_transfer_1_term(a, sin, b, cos, k),
            series_terms.series_transfer_2_term(a, cos, b, sin),
        )
    assert sums == pytest.approx([column[0] for column in series_transfer(one, grid, order)], rel=1e-12, abs=1e-15)


@given(st.floats(-1, 1), st.floats(-1, 1), st.integers(1, 20))
def test_a_central_term_is_one_of_an_offset_without_offset(a, cos, order):
    with_offset = series_terms.series_displacement_term_offset(a, 1.0, 0.0, 0.0, cos, 0.3, order)
    assert series_terms.series_displacement_term(a, cos, order) == pytest.approx(with_offset, rel=1e-12, abs=1e-15)


@pytest.mark.parametrize("scheme", ["forward", "central"])
def test_differences_are_those_of_the_table(scheme):
    angle = np.radians([0.0, 40.0, 70.0, 160.0, 250.0])
    inertia = np.array([1.0, 1.5, 1.2, 0.7, 0.9])
    expected = difference_derivative(angle, inertia, scheme)
    for row in range(5):
        before, after = row - 1, (row + 1) % 5
        ahead, behind = (angle[after] - angle[row]) % math.tau, (angle[row] - angle[before]) % math.tau
        found = (
            force_parts.forward_difference(inertia[after], inertia[row], ahead)
            if scheme == "forward"
            else force_parts.central_difference(inertia[after], inertia[before], ahead + behind)
        )
        assert found == pytest.approx(expected[row], rel=1e-14)


@pytest.mark.parametrize(("links", "joints", "freedom"), [(3, 4, 1), (5, 7, 1), (1, 1, 1), (4, 5, 2), (2, 3, 0)])
def test_mobility_of_known_chains(links, joints, freedom):
    """Artobolevsky, ch. 2: four-bar and six-bar linkages, crank, five-bar linkage, triangle."""
    assert chain_mobility(links, joints) == freedom


def test_parts_of_the_textbook_motion_add_up():
    r, lam, sin, cos = 0.05, 0.3, math.sin(1.0), math.cos(1.0)
    whole = textbook.textbook_displacement(r, lam, cos, math.cos(2.0))
    first, second = (
        textbook.textbook_displacement_first(r, cos),
        textbook.textbook_displacement_second(r, lam, math.cos(2.0)),
    )
    assert first + second == pytest.approx(whole, rel=1e-15)
    assert rod_functions.rod_sine_central(lam, sin) == rod_angle_sine(lam, r, 0.0, sin)
