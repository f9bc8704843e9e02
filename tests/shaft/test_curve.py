"""Quantities over the crank angle as piecewise polynomials."""

import math

import numpy as np
import pytest

from crankwork.errors import MethodError
from crankwork.shaft.curve import Curve, extremes_of
from each import for_each

pytestmark = pytest.mark.elsewhere

TRIANGLES = Curve.linear(np.radians([0, 80, 180, 270, 360]), [0.0, 2000.0, 0.0, 1500.0, 0.0])


def test_a_broken_line_goes_through_its_corners_and_repeats():
    assert TRIANGLES(np.radians([40, 80, 360, 440])) == pytest.approx([1000, 2000, 0, 2000])


def test_the_mean_of_triangles():
    assert TRIANGLES.mean == pytest.approx((2000 * 180 + 1500 * 180) / 2 / 360, rel=1e-15)


def test_a_jump_is_taken_from_the_right():
    step = Curve.linear([0, 1, 1, 2], [3.0, 3.0, 5.0, 5.0])
    assert step([0.5, 1.0, 1.5, 2.0]) == pytest.approx([3, 5, 5, 3])
    assert step.extremes() == (3.0, 0.0, 5.0, 1.0)


def test_the_integral_grows_from_cycle_to_cycle():
    assert TRIANGLES.integral(6 * math.pi) == pytest.approx(3 * TRIANGLES.integral.growth)


def test_derivative_undoes_integral():
    angle = np.linspace(0, 7, 50)
    assert TRIANGLES.integral.derivative(angle) == pytest.approx(TRIANGLES(angle))


def test_sums_and_products_on_different_corners():
    other = Curve.linear(np.radians([0, 100, 360]), [1.0, -2.0, 1.0])
    angle = np.linspace(0, 2 * math.pi, 97)
    assert (TRIANGLES + other)(angle) == pytest.approx(TRIANGLES(angle) + other(angle))
    assert (TRIANGLES * other)(angle) == pytest.approx(TRIANGLES(angle) * other(angle))
    assert (TRIANGLES - 2 * math.pi)(angle) == pytest.approx(TRIANGLES(angle) - 2 * math.pi)


@for_each("by", [0.0, 1.0, 2 * math.pi / 3, 2 * math.pi, -1.0])
def test_a_delayed_curve(by):
    angle = np.linspace(0, 2 * math.pi, 50)
    assert TRIANGLES.delayed(by)(angle) == pytest.approx(TRIANGLES(angle - by), abs=1e-9)


def test_a_fitted_curve_has_the_values_and_the_slopes_of_its_function():
    curve, angle = Curve.fitted(np.sin, [0, 2 * math.pi]), np.linspace(0, 2 * math.pi, 181)[:-1]
    assert curve(angle) == pytest.approx(np.sin(angle), abs=1e-13)
    assert curve.derivative(angle) == pytest.approx(np.cos(angle), abs=1e-10)


def test_extremes_between_the_points():
    curve = Curve.fitted(np.sin, [0.004, 2 * math.pi + 0.004])
    least, at_least, largest, at_largest = curve.extremes()
    assert (least, largest) == pytest.approx((-1, 1), abs=1e-8)
    assert (at_least, at_largest) == pytest.approx((1.5 * math.pi, 0.5 * math.pi), abs=1e-6)


def test_the_extremes_of_several_curves_are_those_of_each():
    """Of c + a sin(x - b): c - a and c + a, a quarter of a turn before and after b."""
    waves = [(1.0, 2.0, 0.3), (-3.0, 0.5, 2.0), (0.0, 40.0, 4.0)]
    curves = [Curve.fitted(lambda x, c=c, a=a, b=b: c + a * np.sin(x - b), [0, 2 * math.pi]) for c, a, b in waves]
    for (c, a, b), (least, at_least, largest, at_largest) in zip(waves, extremes_of(curves), strict=True):
        assert (least, largest) == pytest.approx((c - a, c + a), abs=1e-11 * a)
        places = (b - math.pi / 2) % (2 * math.pi), (b + math.pi / 2) % (2 * math.pi)
        assert (at_least, at_largest) == pytest.approx(places, abs=1e-6)


def test_a_curve_within_its_intervals_is_the_curve_there():
    parts, steps = np.array([0.0, 0.25, 0.9]), np.diff(TRIANGLES.angle)
    assert TRIANGLES.within(parts) == pytest.approx(TRIANGLES(TRIANGLES.angle[:-1] + np.outer(parts, steps)))


def test_every_crossing_is_found():
    curve = Curve.linear(np.arange(9.0), [1.0, -1.0] * 4 + [1.0])
    assert curve.zeros() == pytest.approx(np.arange(8) + 0.5)


@for_each(
    ("angle", "value"),
    [([0, 1], [1, 2, 3]), ([0, 2, 1], [0, 0, 0]), ([0, 0], [1, 2]), ([0, 1], [0, math.nan]), ([0], [1])],
)
def test_what_is_no_curve(angle, value):
    with pytest.raises(MethodError):
        Curve.linear(angle, value)


def test_what_cannot_be_combined():
    with pytest.raises(MethodError, match="different cycles"):
        TRIANGLES + Curve.constant(1.0, 4 * math.pi)
    with pytest.raises(MethodError, match="grows"):
        TRIANGLES.integral * TRIANGLES
    with pytest.raises(MethodError, match="grows"):
        TRIANGLES.integral.delayed(1.0)
