"""Type, limits, time ratio, transmission angle, ranges of the crank."""

import math

import numpy as np
import pytest

from crankwork.errors import GeometryError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.quality import (
    coupler_curve,
    grashof,
    limits,
    limits_of_all,
    pressure_angle,
    time_ratio,
    transmission_angle,
    transmission_extremes,
)
from crankwork.mechanism.catalog import crank_shaper, four_bar, scotch_yoke, toggle_press, whitworth
from crankwork.mechanism.joints import group_links
from crankwork.mechanism.mechanism import slider_crank

pytestmark = pytest.mark.elsewhere


@pytest.mark.parametrize(
    ("lengths", "kind"),
    [
        ((2.5, 7, 4.5, 8), "crank-rocker"),
        ((4, 2, 5, 6), "double rocker"),
        ((5, 6, 2, 4), "rocker-crank"),
        ((4, 5, 6, 2), "double crank"),
        ((3, 4, 5, 11), "triple rocker"),
        ((2, 4, 2, 4), "change point"),
    ],
)
def test_types(lengths, kind):
    assert grashof(*lengths).type == kind


def test_dead_positions_of_a_crank_rocker_are_where_crank_and_coupler_are_in_line():
    found = limits(four_bar(2.5, 7, 4.5, 8), "rocker")
    outer = math.degrees(math.acos((9.5**2 + 8**2 - 4.5**2) / (2 * 9.5 * 8)))
    inner = 180 + math.degrees(math.acos((4.5**2 + 8**2 - 4.5**2) / (2 * 4.5 * 8)))
    assert found.degrees == pytest.approx([outer, inner], abs=1e-9)
    assert found.travel == pytest.approx(abs(np.diff(found.position)[0]))


def test_time_ratio_of_a_shaper_lever():
    theta = 2 * math.degrees(math.asin(1 / 3))
    shaper = crank_shaper(0.05, 0.15, 0.3, 0.2, 0.14)
    assert time_ratio(shaper, "lever") == pytest.approx((180 + theta) / (180 - theta), rel=1e-12)
    assert limits(shaper, "ram").travel == pytest.approx(2 * 0.3 / 3)


def test_time_ratio_of_whitworth():
    half = math.degrees(math.acos(0.02 / 0.05))
    machine = whitworth(0.05, 0.02, 0.06, 0.3)
    assert time_ratio(machine, "ram") == pytest.approx((360 - 2 * half) / (2 * half))
    assert limits(machine, "ram").travel == pytest.approx(0.12)
    assert limits(machine, "lever").travel == pytest.approx(math.tau)


def test_a_toggle_press_straightens_twice():
    found = limits(toggle_press(0.05, 0.3, 0.2, 0.2, (0.28, 0.25)), "ram")
    assert found.degrees.size == 4
    assert found.position.max() == pytest.approx(0.4)
    with pytest.raises(GeometryError, match="4 dead positions"):
        time_ratio(toggle_press(0.05, 0.3, 0.2, 0.2, (0.28, 0.25)), "ram")


def test_limits_of_several_outputs_are_those_of_each():
    machine = toggle_press(0.05, 0.3, 0.2, 0.2, (0.28, 0.25))
    outputs = [*(name for dyad in machine.dyads for name in group_links(dyad))]
    for name, together in zip(outputs, limits_of_all(machine, outputs), strict=True):
        alone = limits(machine, name)
        assert together.degrees == pytest.approx(alone.degrees, abs=1e-9)
        assert together.position == pytest.approx(alone.position, abs=1e-12)
        assert together.travel == pytest.approx(alone.travel, abs=1e-12)
        rate = linkage_motion(machine, CrankGrid.from_degrees(together.degrees))
        found = rate.sliders.get(name) or rate.links[name]
        assert found.position_1 == pytest.approx(0, abs=1e-12)


def test_transmission_angle_extremes_of_a_crank_rocker():
    found = transmission_extremes(four_bar(2.5, 7, 4.5, 8), [0])[0]
    least, greatest = (
        math.degrees(math.acos((7**2 + 4.5**2 - distance**2) / (2 * 7 * 4.5))) for distance in (8 - 2.5, 8 + 2.5)
    )
    assert (found.least, found.greatest) == pytest.approx((least, greatest))
    assert found.greatest_at == pytest.approx(180, abs=1e-4)


def test_pressure_angle_of_a_slider_crank_is_the_swing_of_the_rod():
    grid = CrankGrid.from_degrees([0.0, 30.0, 90.0])
    expected = np.degrees(np.arcsin(0.25 * np.sin(grid.angle)))
    assert pressure_angle(slider_crank(0.05, 0.2), 0, grid) == pytest.approx(expected, abs=1e-9)


def test_a_yoke_has_no_transmission_angle():
    with pytest.raises(GeometryError, match="defined for"):
        transmission_angle(scotch_yoke(0.05), 0, CrankGrid.from_degrees([0.0]))


def test_coupler_curve_closes():
    x, y = coupler_curve(
        four_bar(2.5, 7, 4.5, 8, coupler_point=(3.5, 2.0)), "coupler_point", CrankGrid.from_degrees([0.0, 90.0, 360.0])
    )
    assert (x[0], y[0]) == (x[2], y[2])


def test_an_unknown_output_is_named():
    with pytest.raises(GeometryError, match="piston is not an output"):
        limits(scotch_yoke(0.05), "piston")
