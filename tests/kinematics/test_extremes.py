"""Dead centres, and the largest and least velocity and acceleration, against closed forms and against forty digits."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from crankwork.formula.cycle_interpolant import CycleInterpolant, Extreme
from crankwork.formula.traced_value import TracedAngle, given
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.dead_centres import dead_centres
from crankwork.kinematics.piston import piston_motion
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.method import EXACT, TEXTBOOK, Method
from each import for_each

pytestmark = pytest.mark.elsewhere

RATIOS = [0.05, 0.2, 0.25, 0.28, 0.34, 0.5, 0.8, 0.99]


def _largest_and_least(machine: SliderCrank, order: int, method: Method = EXACT) -> tuple[Extreme, Extreme]:
    """Return the extremes of dx/dphi (order 1) or d2x/dphi2 (order 2) over a turn."""
    lengths = SliderCrank(*(given(key, value) for key, value in zip(SliderCrank._fields, machine, strict=True)))
    angle: Any = TracedAngle()
    moving = piston_motion(lengths, angle, method).piston
    over = CycleInterpolant({"": moving[order]}, CrankGrid.from_degrees, 360.0)
    return over.extreme_points[""]


def _displacement(machine: SliderCrank) -> Callable[[Any], Any]:
    r, l, e = map(mpmath.mpf, machine)  # noqa: E741 - the rod length of the subject
    top = mpmath.sqrt((r + l) ** 2 - e**2)
    return lambda phi: top - r * mpmath.cos(phi) - mpmath.sqrt(l**2 - (r * mpmath.sin(phi) - e) ** 2)


def _extremes_by_search(machine: SliderCrank, order: int) -> list[tuple[float, float]]:
    """Return where the derivative of that order is extreme, and its value there, from forty digits.

    A dense scan shows where each extreme is; the root of the next derivative is then found in mpmath.
    """
    r, l, e = (np.asarray(one, dtype=float) for one in machine)  # noqa: E741
    dense = np.linspace(0, 2 * np.pi, 40_000, endpoint=False)
    s, s_1, s_2 = r * np.sin(dense) - e, r * np.cos(dense), -r * np.sin(dense)
    h = np.sqrt(l**2 - s**2)
    h_1 = -s * s_1 / h
    curve = -s_2 - h_1 if order == 1 else s_1 + (s * s_2 + s_1**2 + h_1**2) / h
    inner = np.flatnonzero((curve - np.roll(curve, 1)) * (np.roll(curve, -1) - curve) <= 0)
    found = []
    with mpmath.workdps(40):
        function = _displacement(machine)
        for k in inner:
            angle = mpmath.findroot(lambda phi: mpmath.diff(function, phi, order + 1), mpmath.mpf(float(dense[k])))
            found.append((float(mpmath.degrees(angle)) % 360, float(mpmath.diff(function, angle, order))))
    return sorted(found)


@for_each("offset", [0.0, 0.2, -0.2])
@for_each("ratio", [0.1, 0.34, 0.7])
@for_each("order", [1, 2])
def test_exact_extremes_are_those_of_forty_digits(ratio: float, offset: float, order: int) -> None:
    machine = SliderCrank(1.0, 1 / ratio, offset)
    expected = _extremes_by_search(machine, order)
    for found, sign in zip(_largest_and_least(machine, order), (1, -1), strict=True):
        value = max(sign * one for _, one in expected) * sign
        assert found.value == pytest.approx(value, rel=1e-13)
        # of equal ones the first counts; the top dead centre may come out as 0 or as 360 less a rounding
        angle = min(angle if angle < 359.999999 else 0.0 for angle, one in expected if abs(one - value) < 1e-13)
        assert found.at % 360 == pytest.approx(angle, abs=1e-9)


@for_each("ratio", RATIOS)
def test_exact_velocity_of_a_central_machine_is_antisymmetric(ratio: float) -> None:
    largest, least = _largest_and_least(SliderCrank(1.0, 1 / ratio), 1)
    assert largest.at + least.at == pytest.approx(360, abs=1e-9)
    assert largest.value == pytest.approx(-least.value, rel=1e-14)


@for_each("ratio", [0.05, 0.1, 0.2])
def test_the_fastest_point_is_near_crank_and_rod_at_right_angles(ratio: float) -> None:
    largest, _ = _largest_and_least(SliderCrank(1.0, 1 / ratio), 1)
    assert math.tan(math.radians(largest.at)) == pytest.approx(1 / ratio, rel=2 * ratio**2)
    assert largest.value == pytest.approx(math.sqrt(1 + ratio**2), rel=ratio**4)


@for_each("ratio", RATIOS)
def test_textbook_velocity_is_extreme_where_the_quadratic_says(ratio: float) -> None:
    found = _largest_and_least(SliderCrank(0.05, 0.05 / ratio), 1, TEXTBOOK)
    cosine = (-1 + math.sqrt(1 + 8 * ratio**2)) / (4 * ratio)
    angle = math.acos(cosine)
    assert [one.at for one in found] == pytest.approx([math.degrees(angle), 360 - math.degrees(angle)], abs=1e-9)
    fastest = 0.05 * (math.sin(angle) + ratio / 2 * math.sin(2 * angle))
    assert [one.value for one in found] == pytest.approx([fastest, -fastest], rel=1e-14)


@for_each("ratio", [0.05, 0.2, 0.25])
def test_textbook_acceleration_of_a_long_rod_is_extreme_at_the_dead_centres(ratio: float) -> None:
    largest, least = _largest_and_least(SliderCrank(0.05, 0.05 / ratio), 2, TEXTBOOK)
    assert (largest.at, least.at) == (0, 180)
    assert (largest.value, least.value) == pytest.approx((0.05 * (1 + ratio), -0.05 * (1 - ratio)), rel=1e-14)


@for_each("ratio", [0.250005, 0.2501, 0.28, 0.34, 0.5, 0.8, 0.99])
def test_textbook_acceleration_of_a_short_rod_is_least_beside_the_bottom(ratio: float) -> None:
    """The minima come out of the bottom dead centre as the ratio passes a quarter; the first of the two counts."""
    largest, least = _largest_and_least(SliderCrank(0.05, 0.05 / ratio), 2, TEXTBOOK)
    beside = math.degrees(math.acos(-1 / (4 * ratio)))
    assert largest == pytest.approx((0.05 * (1 + ratio), 0), rel=1e-14)
    assert least.value == pytest.approx(-0.05 * (ratio + 1 / (8 * ratio)), rel=1e-14)
    # the closer the two minima are, the flatter is the curve between them
    assert least.at == pytest.approx(beside, abs=1e-9 + 1e-6 / (180 - beside) ** 2)


def test_minima_closer_to_the_bottom_than_rounding_can_tell_have_its_value() -> None:
    _, least = _largest_and_least(SliderCrank(1.0, 1 / 0.2500001), 2, TEXTBOOK)
    assert least.value == pytest.approx(-(0.2500001 + 1 / (8 * 0.2500001)), rel=1e-14)
    assert least.at == pytest.approx(180, abs=0.1)


def test_the_minimum_at_a_ratio_of_028_is_at_153_23_degrees() -> None:
    """A printed course work gives 26.77, the supplement."""
    _, least = _largest_and_least(SliderCrank(0.28, 1.0), 2, TEXTBOOK)
    assert round(least.at, 2) == 153.23


@for_each("ratio", [one for one in RATIOS if one < 0.6])
@for_each("method", [EXACT, TEXTBOOK, EXACT.named("series:8")], ids=lambda method: method.name)
def test_the_largest_acceleration_of_a_central_machine_is_at_the_top(ratio: float, method: Method) -> None:
    machine = SliderCrank(1.0, 1 / ratio)
    largest, _ = _largest_and_least(machine, 2, method)
    assert largest.at == 0
    if method is not EXACT:
        return
    assert largest.value == pytest.approx(1 + ratio, rel=1e-15)
    bottom = piston_motion(machine, CrankGrid.from_degrees([180.0])).piston.position_2
    assert bottom == pytest.approx([-(1 - ratio)], rel=1e-13)


@for_each("order", [1, 2, 4, 9])
@for_each("offset", [0.0, 0.3])
def test_series_extremes_are_extremes_of_the_series(order: int, offset: float) -> None:
    machine, method = SliderCrank(1.0, 3.0, offset), EXACT.named(f"series:{order}")
    dense = piston_motion(machine, CrankGrid.steps(0.1, 360.0), method).piston
    for which in (1, 2):
        largest, least = _largest_and_least(machine, which, method)
        at = CrankGrid.from_degrees([largest.at, least.at])
        there = piston_motion(machine, at, method).piston[which]
        assert there == pytest.approx([largest.value, least.value], rel=1e-14)
        assert np.max(dense[which]) <= largest.value + 1e-14
        assert np.min(dense[which]) >= least.value - 1e-14


@for_each(("ratio", "offset"), [(0.99, 0.0), (0.999999, 0.0), (0.5, 0.999998), (0.5, -0.999998)])
def test_no_point_of_a_dense_scan_near_the_limit_exceeds_the_extremes(ratio: float, offset: float) -> None:
    machine = SliderCrank(1.0, 1 / ratio, offset)
    fine = np.linspace(-0.3, 0.3, 6001)
    dense = piston_motion(machine, CrankGrid.from_degrees(np.concatenate([90 + fine, 270 + fine]))).piston
    for order in (1, 2):
        largest, least = _largest_and_least(machine, order)
        assert np.max(dense[order]) <= largest.value * (1 + 1e-12)
        assert np.min(dense[order]) >= least.value * (1 + 1e-12)


@for_each("offset", [0.0, 0.03, -0.03])
def test_dead_centres_in_degrees_are_those_of_the_triangle(offset: float) -> None:
    top, bottom = dead_centres(SliderCrank(0.05, 0.2, offset))
    assert top == pytest.approx(math.degrees(math.asin(offset / 0.25)), rel=1e-14)
    assert bottom == pytest.approx(180 + math.degrees(math.asin(offset / 0.15)), rel=1e-14)


def test_velocity_vanishes_between_its_extremes_only_at_the_dead_centres() -> None:
    machine = SliderCrank(0.05, 0.2, 0.03)
    top, bottom = dead_centres(machine)
    fastest, backwards = _largest_and_least(machine, 1)
    assert top < fastest.at < bottom < backwards.at < top + 360
