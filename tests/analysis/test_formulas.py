"""Formulas against another calculation of the same, and against 30 digits."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.cylinders.journal_loads import unbalance_weight
from crankwork.dynamics import reduction
from crankwork.kinematics import slider_crank
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.dead_centres import dead_centres
from crankwork.kinematics.slider_crank import SliderCrank, rod_angle, rod_swing
from crankwork.mechanism.structure import chain_mobility

pytestmark = pytest.mark.elsewhere

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
    assert slider_crank.stroke_offset(l, r, e) == pytest.approx(one.stroke, rel=1e-11)
    top, bottom = (math.radians(angle) for angle in dead_centres(one))
    if e >= 0:
        assert slider_crank.top_dead_centre_angle(e, l, r) == pytest.approx(top, rel=1e-14, abs=1e-300)
    else:
        assert slider_crank.top_dead_centre_angle_before(math.pi, e, l, r) == pytest.approx(
            top + 2 * math.pi, rel=1e-14
        )
    assert slider_crank.bottom_dead_centre_angle(math.pi, e, l, r) == pytest.approx(bottom, rel=1e-14)


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
    cos_phi = math.cos(math.radians(angle))
    found = {
        "angle": rod_angle(swing.sin, swing.cos),
        "cosine": swing.cos,
        "radial": slider_crank.radial_factor(swing.cos_sum, swing.cos),
        "tangential": slider_crank.tangential_factor(swing.sin_sum, swing.cos),
        "pin": slider_crank.pin_distance(one.crank_radius, cos_phi, one.rod_length, swing.cos),
    }
    for key, value in expected.items():
        assert float(np.squeeze(found[key])) == pytest.approx(float(value), rel=1e-13, abs=2e-15), key


def test_differences_are_those_of_the_table():
    angle = np.radians([0.0, 40.0, 70.0, 160.0, 250.0])
    inertia = np.array([1.0, 1.5, 1.2, 0.7, 0.9])
    # by hand: 0.5 / 40 degrees, -0.3 / 30, -0.5 / 90, 0.2 / 90, 0.1 / 110; two steps: 0.6 / 150, 0.2 / 70 ...
    forward = np.array([0.5, -0.3, -0.5, 0.2, 0.1]) / np.radians([40.0, 30.0, 90.0, 90.0, 110.0])
    central = np.array([0.6, 0.2, -0.8, -0.3, 0.3]) / np.radians([150.0, 70.0, 120.0, 180.0, 200.0])
    for row in range(5):
        before, after = row - 1, (row + 1) % 5
        ahead, behind = (angle[after] - angle[row]) % math.tau, (angle[row] - angle[before]) % math.tau
        found = reduction.forward_difference(inertia[after], inertia[row], ahead)
        assert found == pytest.approx(forward[row], rel=1e-14)
        found = reduction.central_difference(inertia[after], inertia[before], ahead + behind)
        assert found == pytest.approx(central[row], rel=1e-14)


def test_mobility_of_known_chains():
    """Artobolevsky, ch. 2: four-bar and six-bar linkages, crank, five-bar linkage, triangle."""
    chains = {(3, 4): 1, (5, 7): 1, (1, 1): 1, (4, 5): 2, (2, 3): 0}
    assert {chain: chain_mobility(*chain, 0) for chain in chains} == chains
    assert {chain: chain_mobility(*chain, 1) + 1 for chain in chains} == chains


def test_the_bottom_dead_centre_is_where_the_crank_lies_on_the_rod():
    # crank and rod in line, the rod 150 mm beyond the shaft and 30 mm beside it
    angle = slider_crank.bottom_dead_centre_angle(math.pi, 0.03, 0.2, 0.05)
    assert angle == pytest.approx(math.pi + math.asin(0.2), rel=1e-14)


def test_the_weight_of_a_mass_on_the_shaft_is_taken_along_its_arm():
    crank, lean = 0.3, 0.2
    turned = math.cos(crank), math.cos(lean), math.sin(crank), math.sin(lean)
    # half a kilogram
    assert unbalance_weight(0.02, 0.04, 9.8, *turned) == pytest.approx(-4.9 * math.cos(0.5), rel=1e-14)
