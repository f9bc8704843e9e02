"""Monotone cubic curves: the same as SciPy's, and never beyond the points they pass through."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from crankwork.kinematics.crank_grid import Array
from crankwork.loads.curves import hermite, hermite_slope, monotone_slopes
from each import for_each

values = st.floats(-10.0, 10.0).map(lambda value: round(value, 3))
steps = st.floats(0.05, 5.0)


@st.composite
def points(draw: st.DrawFn, fewest: int = 2, most: int = 12) -> tuple[Array, Array]:
    """Return ascending abscissas and any ordinates, flat stretches and turns among them."""
    y = draw(st.lists(values, min_size=fewest, max_size=most))
    x = draw(st.floats(-50.0, 50.0)) + np.cumsum(draw(st.lists(steps, min_size=len(y), max_size=len(y))))
    return x, np.array(y)


def _inside(x: Array) -> Array:
    return np.sort(np.concatenate([x, np.linspace(x[0], x[-1], 101)]))


def _check_against_scipy(x: Array, y: Array) -> None:
    reference, slopes = PchipInterpolator(x, y), monotone_slopes(x, y)
    at = _inside(x)
    scale = max(1.0, float(np.max(np.abs(y))))
    steepest = max(1.0, float(np.max(np.abs(np.diff(y) / np.diff(x)))))
    # an abscissa is known to one part in 2^53, and the curve runs by its slope over that
    fuzz = np.finfo(float).eps * steepest * float(np.max(np.abs(x)))
    assert np.max(np.abs(slopes - reference.derivative()(x))) <= 1e-14 * steepest + 4e-15 * steepest / np.min(
        np.diff(x)
    ) * np.max(np.abs(x))
    assert np.max(np.abs(hermite(x, y, slopes, at) - reference(at))) <= 1e-14 * scale + 4 * fuzz


@given(points())
def test_the_curve_is_that_of_scipy(data: tuple[Array, Array]) -> None:
    _check_against_scipy(*data)


def test_random_curves_are_those_of_scipy_to_fourteen_digits() -> None:
    generator = np.random.default_rng(7)
    for _ in range(50):
        x = np.cumsum(generator.uniform(0.2, 1.0, 15))
        y = generator.normal(size=15)
        at = np.sort(generator.uniform(x[0], x[-1], 200))
        assert np.max(np.abs(hermite(x, y, monotone_slopes(x, y), at) - PchipInterpolator(x, y)(at))) < 1e-14


SPECIAL = {
    "two points": [1.0, 3.0],
    "three points and a turn": [1.0, 3.0, 2.0],
    "flat": [2.0, 2.0, 2.0, 2.0],
    "flat stretches": [0.0, 0.0, 1.0, 1.0, 1.0, 0.0],
    "end slope held back": [0.0, 1.0, -5.0, 1.0],
    "end slope of the wrong sign": [0.0, 0.1, 5.0, 5.1],
}


@for_each("ordinates", SPECIAL.values(), ids=SPECIAL)
def test_the_special_cases_are_those_of_scipy(ordinates: list[float]) -> None:
    _check_against_scipy(np.array([0.0, 1.0, 1.5, 4.0, 4.2, 6.0])[: len(ordinates)], np.array(ordinates))


def test_two_points_are_joined_by_a_straight_line() -> None:
    x, y = np.array([1.0, 3.0]), np.array([10.0, 4.0])
    slopes = monotone_slopes(x, y)
    assert slopes.tolist() == [-3.0, -3.0]
    assert hermite(x, y, slopes, np.array([1.0, 1.5, 2.0, 3.0])) == pytest.approx([10, 8.5, 7, 4], rel=1e-15)


@given(points(fewest=3))
def test_the_curve_passes_through_its_points_and_never_beyond_them(data: tuple[Array, Array]) -> None:
    x, y = data
    slopes = monotone_slopes(x, y)
    assert hermite(x, y, slopes, x).tolist() == y.tolist()
    at = _inside(x)
    i = np.clip(np.searchsorted(x, at, side="right") - 1, 0, len(x) - 2)
    fuzz = 1e-13 * max(1.0, float(np.max(np.abs(y))))
    curve = hermite(x, y, slopes, at)
    assert np.all(curve >= np.minimum(y[i], y[i + 1]) - fuzz)
    assert np.all(curve <= np.maximum(y[i], y[i + 1]) + fuzz)


@given(points(fewest=4))
def test_a_closed_curve_has_the_same_slope_wherever_the_period_is_opened(data: tuple[Array, Array]) -> None:
    x, y = data
    assume(len(np.unique(y)) > 1)
    y = np.append(y[:-1], y[0])
    slopes = monotone_slopes(x, y, periodic=True)
    period = x[-1] - x[0]
    # SciPy on three periods is not near the ends in the middle one
    three = np.concatenate([x[:-1] - period, x[:-1], x + period])
    reference = PchipInterpolator(three, np.concatenate([y[:-1], y[:-1], y])).derivative()(x)
    steepest = float(np.max(np.abs(np.diff(y) / np.diff(x))))
    assert np.max(np.abs(slopes - reference)) <= 1e-11 * steepest
    assert abs(slopes[0] - slopes[-1]) <= 1e-11 * steepest


def test_the_slope_of_the_curve_is_its_derivative() -> None:
    """Central differences of a cubic are exact but for the third derivative, which is constant in an interval."""
    x, y = np.array([0.0, 1.0, 2.5, 3.0, 5.0]), np.array([0.0, 2.0, 1.0, 1.0, -4.0])
    slopes = monotone_slopes(x, y)
    at, h = np.array([0.3, 0.7, 1.2, 2.0, 2.7, 3.5, 4.6]), 1e-3

    def central(step: float) -> Array:
        return np.asarray((hermite(x, y, slopes, at + step) - hermite(x, y, slopes, at - step)) / (2 * step))

    richardson = (4 * central(h) - central(2 * h)) / 3
    assert hermite_slope(x, y, slopes, at) == pytest.approx(richardson, abs=1e-11)
    assert hermite_slope(x, y, slopes, x) == pytest.approx(slopes, abs=1e-15)
