"""Crank angles: exact where a table is read by eye, periodic to the last bit, without cancellation."""

import mpmath
import numpy as np

from crankwork.kinematics.crank_grid import CrankGrid
from each import for_each

NEAR_QUARTERS = np.array([k * 90 + d for k in range(-4, 9) for d in (-1e-3, -1e-6, -1e-9, 1e-9, 1e-6, 1e-3)])


@for_each("turns", [-2, -1, 0, 1, 2, 1000])
def test_multiples_of_a_right_angle_are_exact(turns: int) -> None:
    grid = CrankGrid.from_degrees(turns * 360 + np.array([0.0, 90.0, 180.0, 270.0]))
    assert grid.sin.tolist() == [0, 1, 0, -1]
    assert grid.cos.tolist() == [1, 0, -1, 0]
    assert grid.one_minus_sin.tolist() == [1, 0, 1, 2]
    assert grid.one_plus_sin.tolist() == [1, 2, 1, 0]


def test_no_zero_is_negative() -> None:
    grid = CrankGrid.from_degrees(np.arange(-8, 9) * 90.0)
    assert not np.any(np.signbit(grid.sin[grid.sin == 0]))
    assert not np.any(np.signbit(grid.cos[grid.cos == 0]))


def test_quadrants_mirror_each_other_bit_for_bit() -> None:
    degrees = np.arange(1.0, 45.0)  # 90 - 44.5 and 44.5 would round in different quadrants
    grid, other, opposite = (CrankGrid.from_degrees(one) for one in (degrees, 90 - degrees, 180 + degrees))
    assert np.allclose(grid.sin, other.cos, rtol=2**-52, atol=0)
    assert np.array_equal(grid.sin, -opposite.sin)
    assert np.array_equal(grid.cos, -opposite.cos)
    assert np.array_equal(grid.sin, -CrankGrid.from_degrees(-degrees).sin)
    assert np.array_equal(grid.cos, CrankGrid.from_degrees(-degrees).cos)


def test_sines_and_cosines_agree_with_forty_digits() -> None:
    degrees = np.concatenate([np.arange(-360, 1081) + 0.0, NEAR_QUARTERS])
    grid = CrankGrid.from_degrees(degrees)
    with mpmath.workdps(40):
        for angle, sin, cos in zip(degrees, grid.sin, grid.cos, strict=True):
            exact = mpmath.radians(mpmath.mpf(angle))
            assert abs(sin - mpmath.sin(exact)) <= 2**-52 * abs(mpmath.sin(exact)) or angle % 180 == 0
            assert abs(cos - mpmath.cos(exact)) <= 2**-52 * abs(mpmath.cos(exact)) or angle % 180 == 90


def test_derived_functions_agree_with_forty_digits_relative_to_themselves() -> None:
    degrees = np.concatenate([np.arange(0, 721) + 0.0, NEAR_QUARTERS])
    degrees = degrees[degrees % 90 != 0]
    grid = CrankGrid.from_degrees(degrees)
    with mpmath.workdps(40):
        exact = [mpmath.radians(mpmath.mpf(angle)) for angle in degrees]
        for shown, function in (
            (grid.one_minus_sin, lambda angle: 1 - mpmath.sin(angle)),
            (grid.one_plus_sin, lambda angle: 1 + mpmath.sin(angle)),
            (grid.sin_2, lambda angle: mpmath.sin(2 * angle)),
        ):
            expected = np.array([function(angle) for angle in exact])
            assert np.max(np.abs(shown / expected - 1)) < 1e-15
        # near its zeros, at 45 degrees, the cosine of twice the angle is good to the rounding of both functions
        expected = np.array([mpmath.cos(2 * angle) for angle in exact])
        assert np.max(np.abs(grid.cos_2 - expected)) < 3e-16


@for_each("order", [1, 2, 3, 8, 200])
def test_multiples_of_the_angle_are_those_of_the_grid(order: int) -> None:
    degrees = np.arange(0, 721, 7.5)
    grid = CrankGrid.from_degrees(degrees)
    with mpmath.workdps(40):
        several = grid.multiple(order)
        for angle, sin, cos in zip(degrees, several.sin, several.cos, strict=True):
            exact = mpmath.radians(order * mpmath.mpf(angle))
            assert abs(sin - mpmath.sin(exact)) < 2e-16
            assert abs(cos - mpmath.cos(exact)) < 2e-16


def test_radians_and_degrees_are_the_same_angle() -> None:
    degrees = np.arange(0, 721, 30.0)
    grid, other = CrankGrid.from_degrees(degrees), CrankGrid.from_radians(np.radians(degrees))
    assert np.allclose(grid.degrees, other.degrees, rtol=1e-15)
    assert np.array_equal(grid.angle, other.angle)
    assert np.allclose(grid.sin, other.sin, atol=5e-15)
    assert np.allclose(grid.cos, other.cos, atol=5e-15)
    assert len(grid) == len(other) == 25


def test_steps_come_from_an_index() -> None:
    assert np.array_equal(CrankGrid.steps(0.1, 720.0).degrees, np.arange(7201) * 0.1)


def test_the_last_angle_is_a_row_where_the_step_does_not_divide_it() -> None:
    assert CrankGrid.steps(50.0, 180.0).degrees.tolist() == [0, 50, 100, 150, 180]
    assert CrankGrid.steps(200.0, 180.0).degrees.tolist() == [0, 180]


def test_special_angles_are_sorted_in_once() -> None:
    degrees = CrankGrid.steps(30.0, 720.0, special=(375.0, 370.0, 30.0, 720.0)).degrees
    assert degrees.size == 25 + 2
    assert np.array_equal(degrees, np.unique([*range(0, 721, 30), 370, 375]))


@for_each(("step", "end", "special"), [(0.3, 0.9, ()), (0.1, 0.5, (0.3,)), (0.7, 360.0, (14.7,))])
def test_rounding_of_the_step_does_not_make_two_rows_of_one_angle(
    step: float, end: float, special: tuple[float, ...]
) -> None:
    assert np.min(np.diff(CrankGrid.steps(step, end, special=special).degrees)) > 1e-9
