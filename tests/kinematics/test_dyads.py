"""The kernels of the dyads: what they say at a glance, designs in a batch, complex steps."""

import math

import numpy as np
import pytest

from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.dyads import (
    crank_motion,
    fixed_guide,
    fixed_point,
    in_link_frame,
    pin_on_crank,
    rrp_motion,
    rrr_motion,
)
from crankwork.kinematics.motion import linkage_motion
from crankwork.mechanism.catalog import scotch_yoke
from crankwork.mechanism.dyads import RRP, RRR, Guide
from crankwork.mechanism.mechanism import Crank

pytestmark = pytest.mark.elsewhere

GRID = CrankGrid.from_degrees(np.arange(0.0, 360, 7))


def test_three_four_five():
    dyad = RRR("a", "b", "c", "p", "q", 3.0, 4.0)
    solved = rrr_motion(dyad, fixed_point((0.0, 0.0)), fixed_point((5.0, 0.0)))
    assert float(solved.points["c"].x.position) == pytest.approx(1.8)
    assert float(solved.points["c"].y.position) == pytest.approx(2.4)


def test_the_other_branch_is_on_the_other_side():
    dyad = RRR("a", "b", "c", "p", "q", 3.0, 4.0, -1)
    solved = rrr_motion(dyad, fixed_point((0.0, 0.0)), fixed_point((5.0, 0.0)))
    assert float(solved.points["c"].y.position) == pytest.approx(-2.4)


def test_a_scotch_yoke_is_harmonic():
    yoke = linkage_motion(scotch_yoke(0.05), GRID).sliders["yoke"]
    assert yoke.position == pytest.approx(0.05 * GRID.cos)
    assert yoke.position_2 == pytest.approx(-0.05 * GRID.cos)


def test_coriolis_of_a_block_on_a_turning_lever(linkages):
    mechanism = linkages["crank shaper"]
    solved = linkage_motion(mechanism, GRID)
    lever, slide, pin = solved.frames["lever"], solved.sliders["block"], solved.points["crank_pin"]
    coriolis = 2 * slide.position_1 * lever.angle_1 + slide.position * lever.angle_2
    across = pin.y.position_2 * lever.cos - pin.x.position_2 * lever.sin
    assert across == pytest.approx(coriolis, abs=1e-15)


def test_seen_from_its_own_lever_the_pin_only_slides(linkages):
    solved = linkage_motion(linkages["crank shaper"], GRID)
    along, across = in_link_frame(solved.frames["lever"], solved.points["crank_pin"])
    for order in range(3):
        assert along[order] == pytest.approx(solved.sliders["block"][order], abs=1e-14)
        assert across[order] == pytest.approx(0.0, abs=1e-14)


def _pin(crank, grid):
    return pin_on_crank(crank, crank_motion(crank, grid))


def test_a_batch_of_designs_is_the_same_as_one_by_one():
    lengths = np.array([0.2, 0.25, 0.3])
    pin = _pin(Crank(0.05), GRID)
    guide = fixed_guide(Guide((0.0, 0.01)))
    batch = rrp_motion(RRP("A", "P", "rod", lengths[:, None]), pin, guide)
    for row, length in enumerate(lengths):
        one = rrp_motion(RRP("A", "P", "rod", float(length)), pin, guide)
        assert np.array_equal(batch.sliders["P"].position_2[row], one.sliders["P"].position_2)


def test_a_complex_step_gives_the_sensitivity_to_a_length():
    pin = _pin(Crank(0.05), GRID)
    pivot = fixed_point((0.18, 0.0))

    def rate(length):
        return rrr_motion(RRR("A", "B", "C", "p", "q", length, 0.12), pin, pivot).links["q"].angle_2

    step = rate(0.2 + 1e-30j).imag / 1e-30
    assert step == pytest.approx((rate(0.2 + 1e-6) - rate(0.2 - 1e-6)) / 2e-6, rel=1e-6, abs=1e-6)


def test_the_crank_turns_as_told():
    pin = _pin(Crank(2.0, (1.0, 0.0), math.pi / 2, -1), CrankGrid.from_degrees([90.0]))
    assert [float(pin.x.position[0]), float(pin.y.position[0])] == pytest.approx([3.0, 0.0])
