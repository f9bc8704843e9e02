"""Columns over a cycle against closed forms."""

import math

import mpmath
import numpy as np
import pytest

from crankwork.dynamics.reaction import joint_force
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import Piecewise, TracedAngle, TracedValue, given
from crankwork.kinematics.crank_grid import CrankGrid
from each import for_each

pytestmark = pytest.mark.elsewhere

ANGLE = TracedAngle()


def over(**knowns):
    return CycleInterpolant(
        {key.replace("_of_", "."): one for key, one in knowns.items()}, CrankGrid.from_degrees, 360.0
    )


def test_the_mean_of_a_size_that_vanishes_is_that_of_the_integral_over_both_its_stretches() -> None:
    found = over(size=joint_force(ANGLE.shifted(-20.3).sin, given("", 0.0)))
    assert found.mean("size", "mean").value == pytest.approx(2 / math.pi, rel=1e-13)
    largest, least = found.extreme_points["size"]
    assert (largest.value, largest.at) == (pytest.approx(1.0, rel=1e-15), pytest.approx(110.3, abs=1e-6))
    assert (least.value, least.at) == (pytest.approx(0.0, abs=1e-14), pytest.approx(20.3, abs=1e-9))


@for_each("gap", [1e-3, 1e-6, 1e-9])
def test_the_mean_of_a_size_that_nearly_vanishes_is_an_elliptic_integral(gap: float) -> None:
    found = over(size=joint_force(ANGLE.sin, given("", gap)))
    # sqrt(g^2 + sin^2) = g sqrt(1 - m sin^2) with m = -1 / g^2
    expected = float(2 / mpmath.pi * gap * mpmath.ellipe(-1 / mpmath.mpf(gap) ** 2))
    assert found.mean("size", "mean").value == pytest.approx(expected, rel=1e-11)
    assert found.extreme_points["size"][1].value == pytest.approx(gap, rel=1e-6, abs=1e-13)


@for_each("start", [0.03, -0.03, 1e-4, 0.0])
def test_a_sign_that_changes_just_beside_the_end_of_a_cycle_does_so_there(start: float) -> None:
    ends, is_negative = over(load=ANGLE.shifted(-start).sin).sign_intervals("load")
    expected = {0.03: [0.03, 180.03], 1e-4: [1e-4, 180 + 1e-4], -0.03: [179.97, 359.97], 0.0: [180.0]}[start]
    assert ends == pytest.approx([*expected, 360.0], abs=1e-10)
    assert is_negative == [start > 0, *[start <= 0, start > 0][: len(expected)]]


def test_an_ellipse_is_nearest_and_farthest_at_its_axes() -> None:
    found = over(size=joint_force(3.0 * ANGLE.shifted(-33.0).cos, 0.5 * ANGLE.shifted(-33.0).sin))
    largest, least = found.extreme_points["size"]
    assert (largest.value, least.value) == pytest.approx((3.0, 0.5), rel=1e-14)
    assert (largest.at % 180, least.at % 180) == pytest.approx((33.0, 123.0), abs=1e-6)


def test_a_column_of_nothing_but_rounding_cuts_nothing() -> None:
    sin, cos = ANGLE.sin, ANGLE.cos
    beside = {f"load_of_{at}": sin * sin + cos * cos - (1 + at * 1e-16) for at in range(40)}
    found = over(load_of_sine=sin, **beside)
    assert len(found.edges) < 40
    assert found.extreme_points["load.sine"][0].value == 1.0


def test_the_polynomials_of_a_root_are_not_given_out_for_it() -> None:
    found = over(size=joint_force(ANGLE.sin, ANGLE.cos))
    with pytest.raises(TypeError, match="square root"):
        found.polynomials("size")
    assert np.ptp(found.at("size", np.arange(360.0))) < 1e-15


def test_nothing_to_follow_is_nothing() -> None:
    assert over().extreme_points == {}


@for_each("apart", [0.3, 0.02, 1e-3, 1e-6])
def test_the_mean_of_a_size_that_vanishes_just_beside_a_break(apart: float) -> None:
    """Between the break and the first node of the interval, where its values show nothing of the corner."""
    beside = TracedValue(Piecewise([120.0, 360.0], (given("", 1.0), given("", 1.0))))
    for at in (120.0 + apart, 120.0 - apart):
        found = over(size=joint_force(beside * ANGLE.shifted(-at).sin, given("", 0.0)))
        assert found.mean("size", "mean").value == pytest.approx(2 / math.pi, rel=1e-11)


def test_a_size_of_little_beside_another_has_its_extremes_where_they_are() -> None:
    small = joint_force(1e-7 * ANGLE.shifted(-33.0).cos, given("", 2e-8))
    found = over(size_of_small=small, size_of_large=joint_force(ANGLE.cos, given("", 3.0)))
    largest, least = found.extreme_points["size.small"]
    assert (largest.at % 180, least.at % 180) == pytest.approx((33.0, 123.0), abs=1e-5)


@for_each("beside", [1e-5, 1e-7])
def test_the_mean_of_a_size_with_steep_peaks_is_found_at_once(beside: float) -> None:
    a, below = 1 + beside, beside * (2 + beside)
    once = 1.0 / (a - ANGLE.shifted(-77.7).cos)
    found = over(size=joint_force(once * once * once, given("", 0.0)))
    # of 1 / (a - cos phi)^3, which is to others as 1e21 to 1; its squares at that are as their rounding leaves them
    assert found.mean("size", "mean").value == pytest.approx((2 * a * a + 1) / 2 / below**2.5, rel=1e-8)
