"""Dead centres and extremes of velocity and acceleration against closed forms and against forty digits."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.extremes import acceleration_extremes, dead_centres, roots, velocity_extremes
from crankwork.kinematics.piston import piston_motion
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.method import EXACT, TEXTBOOK

RATIOS = [0.05, 0.2, 0.25, 0.28, 0.34, 0.5, 0.8, 0.99]


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


@pytest.mark.parametrize("offset", [0.0, 0.2, -0.2])
@pytest.mark.parametrize("ratio", [0.1, 0.34, 0.7])
@pytest.mark.parametrize(("order", "extremes"), [(1, velocity_extremes), (2, acceleration_extremes)])
def test_exact_extremes_are_those_of_forty_digits(
    ratio: float, offset: float, order: int, extremes: Callable[[SliderCrank], Any]
) -> None:
    machine = SliderCrank(1.0, 1 / ratio, offset)
    angles, values = extremes(machine)
    expected = _extremes_by_search(machine, order)
    # the top dead centre may come out as 0 or as 360 less a rounding
    assert [angle % 360 for angle, _ in expected] == pytest.approx(angles.tolist(), abs=1e-10)
    assert [value for _, value in expected] == pytest.approx(values.tolist(), rel=1e-13)


@pytest.mark.parametrize("ratio", RATIOS)
def test_exact_velocity_is_extreme_once_each_way_and_antisymmetric(ratio: float) -> None:
    angles, values = velocity_extremes(SliderCrank(1.0, 1 / ratio))
    assert angles.size == 2
    assert angles[0] + angles[1] == pytest.approx(360, abs=1e-10)
    assert values[0] == pytest.approx(-values[1], rel=1e-14)


@pytest.mark.parametrize("ratio", [0.05, 0.1, 0.2])
def test_the_fastest_point_is_near_crank_and_rod_at_right_angles(ratio: float) -> None:
    (angle, _), (value, _) = velocity_extremes(SliderCrank(1.0, 1 / ratio))
    assert math.tan(math.radians(angle)) == pytest.approx(1 / ratio, rel=2 * ratio**2)
    assert value == pytest.approx(math.sqrt(1 + ratio**2), rel=ratio**4)


@pytest.mark.parametrize("ratio", RATIOS)
def test_textbook_velocity_is_extreme_where_the_quadratic_says(ratio: float) -> None:
    angles, values = velocity_extremes(SliderCrank(0.05, 0.05 / ratio), TEXTBOOK)
    cosine = (-1 + math.sqrt(1 + 8 * ratio**2)) / (4 * ratio)
    angle = math.acos(cosine)
    assert np.cos(np.radians(angles)) == pytest.approx([cosine, cosine], abs=1e-14)
    fastest = 0.05 * (math.sin(angle) + ratio / 2 * math.sin(2 * angle))
    assert values == pytest.approx([fastest, -fastest], rel=1e-14)


@pytest.mark.parametrize("ratio", [0.05, 0.2, 0.25])
def test_textbook_acceleration_of_a_long_rod_is_extreme_at_the_dead_centres_only(ratio: float) -> None:
    angles, values = acceleration_extremes(SliderCrank(0.05, 0.05 / ratio), TEXTBOOK)
    assert angles.tolist() == [0, 180]
    assert values == pytest.approx([0.05 * (1 + ratio), -0.05 * (1 - ratio)], rel=1e-14)


@pytest.mark.parametrize("ratio", [0.2501, 0.28, 0.34, 0.5, 0.8, 0.99])
def test_textbook_acceleration_of_a_short_rod_has_two_minima_beside_the_bottom(ratio: float) -> None:
    angles, values = acceleration_extremes(SliderCrank(0.05, 0.05 / ratio), TEXTBOOK)
    beside = math.degrees(math.acos(-1 / (4 * ratio)))
    assert angles == pytest.approx([0, beside, 180, 360 - beside], abs=1e-8)
    lowest = -0.05 * (ratio + 1 / (8 * ratio))
    assert values == pytest.approx([0.05 * (1 + ratio), lowest, -0.05 * (1 - ratio), lowest], rel=1e-14)


def test_the_minimum_at_a_ratio_of_028_is_at_153_23_degrees() -> None:
    """A printed course work gives 26.77, the supplement."""
    angles, _ = acceleration_extremes(SliderCrank(0.28, 1.0), TEXTBOOK)
    assert round(float(angles[1]), 2) == 153.23


@pytest.mark.parametrize("ratio", [0.2500001, 0.250005])
def test_minima_close_to_the_bottom_are_found(ratio: float) -> None:
    """They come out of the bottom dead centre as the ratio passes a quarter, closer than the step of any scan."""
    angles, _ = acceleration_extremes(SliderCrank(1.0, 1 / ratio), TEXTBOOK)
    assert angles.size == 4


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("method", [EXACT, TEXTBOOK, EXACT.named("series:8")], ids=lambda method: method.name)
def test_the_largest_acceleration_of_a_central_machine_is_at_the_top(ratio: float, method: Any) -> None:
    angles, values = acceleration_extremes(SliderCrank(1.0, 1 / ratio), method)
    assert 0 in angles
    assert 180 in angles
    if method is not EXACT and ratio > 0.5:  # a truncated series of a short rod overshoots elsewhere
        return
    top = values[angles == 0]
    assert np.max(values) == top or ratio > 0.6
    if method is EXACT:
        assert top == pytest.approx(1 + ratio, rel=1e-15)
        assert values[angles == 180] == pytest.approx(-(1 - ratio), rel=1e-13)


@pytest.mark.parametrize("order", [1, 2, 4, 9])
@pytest.mark.parametrize("offset", [0.0, 0.3])
def test_series_extremes_are_extremes_of_the_series(order: int, offset: float) -> None:
    machine, method = SliderCrank(1.0, 3.0, offset), EXACT.named(f"series:{order}")
    for extremes, which in ((velocity_extremes, 1), (acceleration_extremes, 2)):
        angles, values = extremes(machine, method)
        assert angles.size >= 2
        for side in (-0.01, 0.01):
            beside = piston_motion(machine, CrankGrid.from_degrees(angles + side), method).piston[which]
            assert np.max(np.abs(beside - values)) < 1e-6
        dense = piston_motion(machine, CrankGrid.steps(0.1, 360.0), method).piston[which]
        assert np.max(dense) <= np.max(values) + 1e-14
        assert np.min(dense) >= np.min(values) - 1e-14


@pytest.mark.parametrize(("ratio", "offset"), [(0.99, 0.0), (0.999999, 0.0), (0.5, 0.999998), (0.5, -0.999998)])
def test_no_point_of_a_dense_scan_near_the_limit_exceeds_the_extremes(ratio: float, offset: float) -> None:
    machine = SliderCrank(1.0, 1 / ratio, offset)
    fine = np.linspace(-0.3, 0.3, 6001)
    dense = piston_motion(machine, CrankGrid.from_degrees(np.concatenate([90 + fine, 270 + fine]))).piston
    for extremes, curve in ((velocity_extremes, dense.position_1), (acceleration_extremes, dense.position_2)):
        _, values = extremes(machine)
        assert np.max(curve) <= np.max(values) * (1 + 1e-12)
        assert np.min(curve) >= np.min(values) * (1 + 1e-12)


@pytest.mark.parametrize("offset", [0.0, 0.03, -0.03])
def test_dead_centres_in_degrees_are_those_of_the_triangle(offset: float) -> None:
    top, bottom = dead_centres(SliderCrank(0.05, 0.2, offset))
    assert top == pytest.approx(math.degrees(math.asin(offset / 0.25)), rel=1e-14)
    assert bottom == pytest.approx(180 + math.degrees(math.asin(offset / 0.15)), rel=1e-14)


def test_velocity_vanishes_between_its_extremes_only_at_the_dead_centres() -> None:
    machine = SliderCrank(0.05, 0.2, 0.03)
    top, bottom = dead_centres(machine)
    fastest, backwards = velocity_extremes(machine)[0]
    assert top < fastest < bottom < backwards < top + 360


def test_roots_are_found_at_scan_points_and_between_them() -> None:
    found = roots(lambda degrees: (degrees - 90) * (degrees - 100.3) * (degrees - 359.9), 0.0, 360.0)
    assert found == pytest.approx([90, 100.3, 359.9], rel=1e-15)


def test_a_function_without_sign_changes_has_no_roots() -> None:
    assert roots(lambda degrees: degrees**2 + 1, 0.0, 360.0).size == 0
