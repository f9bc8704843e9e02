"""Change points passed by smooth continuation: positions and transfer functions against closed forms."""

import math

import numpy as np
import pytest

from crankwork.formula.replay import Program
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.crank_range import find_crank_range, pass_change_points
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.traced_motion import traced_motion
from crankwork.mechanism.catalog import four_bar
from crankwork.mechanism.dyads import RPR, RRR
from crankwork.mechanism.mechanism import Crank, Mechanism, slider_crank
from each import for_each

pytestmark = pytest.mark.elsewhere

NEAR = [0.0, 1e-9, 1e-6, 1e-3, 0.1, 1.0]
GRID = CrankGrid.from_degrees(
    sorted({*np.arange(0.0, 360.5, 0.5), *NEAR[1:], *(180 + one for one in (-1e-7, 1e-8, 0.01))})
)
PARALLELOGRAM = four_bar(0.3, 1.0, 0.3, 1.0)


def _passing(mechanism):
    return pass_change_points(mechanism)[0]


def same(found, expected, within=1e-12):
    for mine, its in zip(found, expected, strict=True):
        assert mine == pytest.approx(its + np.zeros(mine.shape), abs=within)


def test_a_parallelogram_moves_its_coupler_without_turning_it():
    motion = linkage_motion(_passing(PARALLELOGRAM), GRID)
    pin = motion.points["coupler_pin"]
    same(pin.x, (1 + 0.3 * GRID.cos, -0.3 * GRID.sin, -0.3 * GRID.cos))
    same(pin.y, (0.3 * GRID.sin, 0.3 * GRID.cos, -0.3 * GRID.sin))
    same(motion.links["rocker"], (GRID.angle, np.ones(len(GRID)), np.zeros(len(GRID))))
    same(motion.links["coupler"], np.zeros((3, len(GRID))))


def test_a_crank_that_goes_on_for_turns_passes_every_time():
    grid = CrankGrid.from_degrees(np.arange(-725.0, 1500.0, 2.5))
    motion = linkage_motion(_passing(PARALLELOGRAM), grid)
    same(motion.points["coupler_pin"].x, (1 + 0.3 * grid.cos, -0.3 * grid.sin, -0.3 * grid.cos))
    kite = _passing(four_bar(1.0, math.sqrt(2), math.sqrt(2), 1.0))
    pin = linkage_motion(kite, grid).points["coupler_pin"]
    half = grid.angle / 2
    assert pin.x[0] == pytest.approx((np.cos(half) + np.sqrt(2 - np.sin(half) ** 2)) * np.cos(half), abs=1e-12)


def test_what_is_remembered_passes_as_well():
    mechanism = _passing(PARALLELOGRAM)
    moved = linkage_motion(mechanism, CrankGrid.steps(1.0, 360.0))
    motion = traced_motion(mechanism, moved)
    pin = motion.points["coupler_pin"]
    found = Program({"x": pin.x[0], "x_1": pin.x[1], "x_2": pin.x[2], "turn": motion.links["rocker"][0]})(GRID)
    same((found["x"], found["x_1"], found["x_2"]), (1 + 0.3 * GRID.cos, -0.3 * GRID.sin, -0.3 * GRID.cos))
    assert found["turn"] == pytest.approx(GRID.angle, abs=1e-12)


@for_each(("crank", "ground"), [(0.3, 1.0), (2.0, 5.0), (0.5, 0.9)])
def test_the_crossed_branch_goes_on_crossed(crank, ground):
    rocker = linkage_motion(_passing(four_bar(crank, ground, crank, ground, branch=-1)), GRID).links["rocker"]
    half, k = GRID.angle / 2, (ground + crank) / (ground - crank)
    cos, sin = np.cos(half), np.sin(half)
    below = cos**2 + k**2 * sin**2
    assert np.exp(1j * rocker.position) == pytest.approx(np.exp(2j * np.arctan2(-k * sin, cos)), abs=1e-12)
    assert rocker.position_1 == pytest.approx(-k / below, abs=1e-11)
    assert rocker.position_2 == pytest.approx(k * (k**2 - 1) * sin * cos / below**2, abs=1e-10)


def test_a_kite_needs_two_turns():
    mechanism = four_bar(1.0, math.sqrt(2), math.sqrt(2), 1.0)
    assert find_crank_range(mechanism).turns == 2
    grid = CrankGrid.from_degrees(np.arange(0.0, 720.5, 0.5))
    pin = linkage_motion(_passing(mechanism), grid).points["coupler_pin"]
    half = grid.angle / 2
    cos, sin = np.cos(half), np.sin(half)
    root = np.sqrt(2 - sin**2)
    along, along_1 = cos + root, -0.5 * sin - 0.5 * sin * cos / root
    same(pin.x[:2], (along * cos, along_1 * cos - 0.5 * along * sin))
    same(pin.y[:2], (along * sin, along_1 * sin + 0.5 * along * cos))


def test_an_isosceles_slider_crank_passes_the_shaft():
    slide = linkage_motion(_passing(slider_crank(0.1, 0.1)), GRID).sliders["piston_pin"]
    same(slide, (0.2 * GRID.cos, -0.2 * GRID.sin, -0.2 * GRID.cos))


def test_coupled_wheels_keep_in_step():
    dyads = (RRR("crank_pin", "P", "B", "rod", "w2", 1.0, 0.3), RRR("B", "Q", "C", "rod2", "w3", 1.0, 0.3))
    wheels = Mechanism(Crank(0.3), dyads, ground={"P": (1.0, 0.0), "Q": (2.0, 0.0)})
    motion = linkage_motion(_passing(wheels), GRID)
    same(motion.points["C"].x, (2 + 0.3 * GRID.cos, -0.3 * GRID.sin, -0.3 * GRID.cos), 1e-11)
    same(motion.links["w3"], (GRID.angle, np.ones(len(GRID)), np.zeros(len(GRID))), 1e-11)


def test_a_slotted_lever_whose_pin_passes_the_pivot_turns_half_as_fast():
    lever = Mechanism(Crank(0.05), (RPR("crank_pin", "P", "lever", "block"),), ground={"P": (0.0, -0.05)})
    assert find_crank_range(lever).turns == 2
    turned = linkage_motion(_passing(lever), CrankGrid.from_degrees(np.arange(0.0, 720.0, 2.5))).links["lever"]
    same(turned[1:], (0.5 * np.ones(288), np.zeros(288)))


def test_a_crank_that_turns_fully_or_back_passes_nothing():
    for mechanism in (four_bar(2.5, 7, 4.5, 8), four_bar(3, 4, 5, 7)):
        assert _passing(mechanism) is mechanism


def test_a_crank_gets_as_far_as_its_dead_positions():
    half = math.degrees(math.acos((3**2 + 7**2 - 9**2) / (2 * 3 * 7)))
    found = find_crank_range(four_bar(3, 4, 5, 7))
    assert (found.start, found.end) == pytest.approx((-half, half), abs=1e-9)
    assert not found.is_whole
