"""Balance shafts take away one order, and act on the frame by their height."""

import numpy as np
import pytest

from crankwork.cylinders.balance import (
    ShaftWeight,
    balance_shafts,
    free_forces,
    inertia_harmonics,
    layout_factors,
    shaft_forces,
)
from crankwork.cylinders.counterweights import balance_sum, rotating_unbalances, throw_counterweights, turning_forces
from crankwork.cylinders.layout import CylinderPlace, Layout
from crankwork.kinematics.slider_crank import SliderCrank
from each import for_each

pytestmark = pytest.mark.elsewhere

LENGTHS = SliderCrank(0.04, 0.14)
RODS = inertia_harmonics(LENGTHS)
M_REC, M_ROT, R, W = 0.5, 0.8, 0.04, 300.0
ONE = M_REC * R * W**2


def _layout(pins, axis=0.0) -> Layout:
    middle = (len(pins) - 1) / 2
    places = [CylinderPlace(k + 1, axis, k, k, pin, (k - middle) * 0.1, 0.0) for k, pin in enumerate(pins)]
    return Layout("inline", tuple(places), 720.0, tuple(range(1, len(pins) + 1)))


FOUR, THREE = _layout([0.0, 180.0, 180.0, 0.0]), _layout([0.0, 240.0, 120.0])


def test_the_pair_of_lanchester_takes_the_second_order_of_four_cylinders() -> None:
    free = free_forces(FOUR, M_REC, R, W, RODS)
    pair = balance_shafts(free[1], W)
    assert [(one.order, one.sense, one.angle) for one in pair] == [(2, 1, 180), (2, -1, 180)]
    moment = 4 * M_REC * R * RODS.coefficients[1].real / 8
    assert [one.mass_moment for one in pair] == pytest.approx([moment, moment], rel=1e-14)
    left = balance_sum([*free, *shaft_forces(pair, W)])
    assert left[1].force.largest == pytest.approx(0, abs=1e-12 * ONE)
    assert left[0] == free[0]
    assert left[2:] == free[2:]


def test_the_factor_in_the_formula_of_lanchester_is_that_of_the_layout() -> None:
    assert layout_factors(FOUR)[1].force.largest == 4


def test_a_balanced_order_needs_no_shafts() -> None:
    assert balance_shafts(free_forces(FOUR, M_REC, R, W, RODS)[0], W) == ()


@for_each("axis", [0.0, 35.0, 90.0])
def test_two_shafts_take_the_first_order_of_one_cylinder(axis: float) -> None:
    free = free_forces(_layout([0.0], axis), M_REC, R, W, RODS)
    pair = balance_shafts(free[0], W)
    assert [one.mass_moment for one in pair] == pytest.approx([M_REC * R / 2] * 2, rel=1e-14)
    # at top dead centre both weights are down, whichever way the cylinder leans
    assert [one.angle for one in pair] == pytest.approx([axis + 180] * 2)
    assert balance_sum([*free, *shaft_forces(pair, W)])[0].force.largest == pytest.approx(0, abs=1e-12 * ONE)


def test_with_counterweights_one_shaft_against_the_crank_is_enough() -> None:
    layout = _layout([0.0], 15.0)
    turning = [*rotating_unbalances(layout, M_ROT, R), *throw_counterweights(layout, M_REC, M_ROT, R)]
    left = balance_sum([*free_forces(layout, M_REC, R, W, RODS), turning_forces(layout, turning, W)])
    (weight,) = balance_shafts(left[0], W)
    assert weight.sense == -1
    assert weight.mass_moment == pytest.approx(M_REC * R / 2, rel=1e-12)


def test_one_shaft_with_two_weights_takes_the_couple_of_three_cylinders() -> None:
    turning = [*rotating_unbalances(THREE, M_ROT, R), *throw_counterweights(THREE, M_REC, M_ROT, R)]
    left = balance_sum([*free_forces(THREE, M_REC, R, W, RODS), turning_forces(THREE, turning, W)])
    weights = balance_shafts(left[0], W, (-0.12, 0.18))
    assert [one.sense for one in weights] == [-1, -1]
    couple = np.sqrt(3) / 2 * 0.1 * M_REC * R
    assert [one.mass_moment for one in weights] == pytest.approx([couple / 0.3] * 2, rel=1e-12)
    assert abs(weights[0].angle - weights[1].angle) == pytest.approx(180)
    after = balance_sum([*left, *shaft_forces(weights, W)])
    assert after[0].force.largest == pytest.approx(0, abs=1e-12 * ONE)
    assert after[0].moment.largest == pytest.approx(0, abs=1e-12 * ONE)


def test_two_planes_take_force_and_moment_of_a_twin() -> None:
    twin = _layout([0.0, 270.0], 10.0)
    for part in free_forces(twin, M_REC, R, W, RODS):
        weights = balance_shafts(part, W, (0.02, 0.3))
        (left,) = balance_sum([part, *shaft_forces(weights, W)])
        assert left.force.largest == pytest.approx(0, abs=1e-11 * ONE)
        assert left.moment.largest == pytest.approx(0, abs=1e-11 * ONE)


def test_moments_of_shafts_are_about_the_position_asked_for() -> None:
    weight = ShaftWeight(2, -1, 1e-3, 40.0, 0.25)
    (middle,), (end,) = shaft_forces([weight], W), shaft_forces([weight], W, about=0.25)
    assert middle.moment.largest == pytest.approx(1e-3 * (2 * W) ** 2 * 0.25)
    assert end.moment.largest == 0
