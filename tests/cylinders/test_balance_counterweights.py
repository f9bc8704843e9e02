"""Counterweights remove what turns forwards, and nothing else."""

import math

import numpy as np
import pytest

from crankwork.cylinders.balance import free_forces, inertia_harmonics
from crankwork.cylinders.counterweights import (
    OrderBalance,
    Unbalance,
    balance_sum,
    counterweight_moment,
    in_two_planes,
    rotating_unbalances,
    throw_counterweights,
    turning_forces,
)
from crankwork.cylinders.layout import CylinderPlace, Layout
from crankwork.errors import CrankworkError
from crankwork.kinematics.slider_crank import SliderCrank
from each import for_each

pytestmark = pytest.mark.elsewhere

RODS = inertia_harmonics(SliderCrank(0.04, 0.14))
M_REC, M_ROT, R, W = 0.5, 0.8, 0.04, 300.0
ONE = M_REC * R * W**2


def _layout(pins, axes=(0.0,), pitch=0.1) -> Layout:
    """Return cylinders of several banks on the same crankpins."""
    middle = (len(pins) - 1) / 2
    places = [
        CylinderPlace(1 + k + len(pins) * row, axis, k, k, pin, (k - middle) * pitch, 0.0)
        for row, axis in enumerate(axes)
        for k, pin in enumerate(pins)
    ]
    return Layout("any", tuple(places), 720.0, tuple(range(1, len(places) + 1)))


def _left(layout: Layout, share: float = 0.5) -> tuple[OrderBalance, ...]:
    """Return what counterweights on each crankpin leave."""
    turning = [*rotating_unbalances(layout, M_ROT, R), *throw_counterweights(layout, M_REC, M_ROT, R, share)]
    return balance_sum([*free_forces(layout, M_REC, R, W, RODS), turning_forces(layout, turning, W)])


# --- on each crankpin


def test_half_the_mass_of_a_single_cylinder_leaves_half_its_force_turning_backwards() -> None:
    first = _left(_layout([0.0], [20.0]))[0]
    assert first.force.forward == pytest.approx(0, abs=1e-12 * ONE)
    assert abs(first.force.backward) == pytest.approx(ONE / 2, rel=1e-14)


@for_each("share", [0.0, 0.3, 0.5, 2 / 3, 1.0])
def test_a_share_is_taken_from_the_axis_and_put_across_it(share: float) -> None:
    first = _left(_layout([0.0]), share)[0]
    assert (first.force.largest, first.force.least) == pytest.approx(
        sorted(((1 - share) * ONE, share * ONE), reverse=True), abs=1e-11 * ONE
    )
    if share != 0.5:
        assert first.force.direction == pytest.approx(0 if share < 0.5 else 90)


@for_each(
    ("pins", "axes"),
    [
        ([0.0], (-45.0, 45.0)),
        ([0.0, 90.0, 270.0, 180.0], (-45.0, 45.0)),
        ([0.0], (0.0, 72.0, 144.0, 216.0, 288.0)),
        ([0.0], (0.0, 120.0, 240.0)),
    ],
    ids=["V2 at 90 degrees", "V8 with crossed throws", "radial five", "radial three"],
)
def test_the_first_order_of_some_engines_is_balanced_by_counterweights(pins, axes) -> None:
    layout = _layout(pins, axes)
    first, *others = _left(layout)
    assert first.force.largest == pytest.approx(0, abs=1e-12 * ONE)
    assert first.moment.largest == pytest.approx(0, abs=1e-12 * ONE)
    assert tuple(others) == free_forces(layout, M_REC, R, W, RODS)[1:], "counterweights leave the other orders alone"


def test_the_crossed_v8_needs_the_counterweights() -> None:
    first = free_forces(_layout([0.0, 90.0, 270.0, 180.0], (-45.0, 45.0)), M_REC, R, W, RODS)[0]
    assert first.force.largest == 0
    # sqrt(10) pitches of the couple of the throws, turning forwards
    assert first.moment.largest == pytest.approx(math.sqrt(10) * 0.1 * ONE, rel=1e-14)
    assert first.moment.backward == 0


def test_there_is_one_counterweight_for_each_crankpin() -> None:
    found = throw_counterweights(_layout([0.0, 120.0], (-30.0, 30.0)), M_REC, M_ROT, R)
    assert [one.angle for one in found] == [180, 300]
    assert [one.position for one in found] == pytest.approx([-0.05, 0.05])
    moment = 2 * counterweight_moment(M_ROT, 0.5, M_REC, R)
    assert [one.mass_moment for one in found] == pytest.approx([moment, moment])


def test_a_counterweight_stands_midway_between_the_masses_of_its_crankpin() -> None:
    places = (CylinderPlace(1, -45.0, 0, 0, 0.0, -0.01, 0.0), CylinderPlace(2, 45.0, 0, 0, 0.0, 0.01, 0.0))
    layout = Layout("V", places, 720.0, (1, 2))
    (heavier,) = throw_counterweights(layout, [0.3, 0.9], 0.0, R)
    assert heavier.position == pytest.approx(0.005)
    (massless,) = throw_counterweights(layout, 0.0, 0.0, R)
    assert (massless.mass_moment, massless.position) == (0, 0)


# --- in two planes


def test_three_cranks_need_a_couple_in_two_planes() -> None:
    layout = _layout([0.0, 240.0, 120.0])
    turning = rotating_unbalances(layout, M_ROT, R)
    couple = turning_forces(layout, turning, W)
    assert couple.force == (0, 0)
    assert couple.moment.largest == pytest.approx(math.sqrt(3) * 0.1 * M_ROT * R * W**2, rel=1e-14)
    vectors = [one.mass_moment * np.exp(1j * np.radians(one.angle)) for one in turning]
    parts = in_two_planes(vectors, [one.position for one in turning], (-0.15, 0.15))
    assert np.abs(parts) == pytest.approx([math.sqrt(3) / 3 * M_ROT * R] * 2, rel=1e-14)
    # cranks 1 and 3 at 0 and 120 degrees: the couple lies along -30 degrees
    assert np.degrees(np.angle(parts)) == pytest.approx([-30, 150])


def test_a_mass_has_no_moment_about_its_own_position() -> None:
    one = [Unbalance(2.0, 30.0, 0.1)]
    assert turning_forces(_layout([0.0]), one, W, about=0.1).moment == (0, 0)
    assert turning_forces(_layout([0.0]), one, W, about=-0.1).moment.largest == pytest.approx(0.4 * W**2)


def test_two_planes_must_be_apart() -> None:
    with pytest.raises(CrankworkError, match="both planes are at 120 mm; a couple needs two planes apart"):
        in_two_planes([1.0], [0.0], (0.12, 0.12))


def test_vectors_in_two_planes_have_the_sum_and_the_moment() -> None:
    first, second = in_two_planes([1 + 2j, -3j], [0.2, 0.7], (-1.0, 1.5))
    assert first + second == pytest.approx(1 - 1j)
    assert -first + 1.5 * second == pytest.approx(0.2 * (1 + 2j) - 2.1j)
