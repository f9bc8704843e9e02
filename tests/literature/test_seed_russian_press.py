"""Kinematics of a press: table of transfer functions of a Russian course project on the dynamics of machines.

The document prints |v| and |w| over the crank speed for twelve positions, to three decimals, read from velocity
plans; the pivots are not given. Crank 0.05 m, rod 0.6 m, slotted rocker 0.21 m. Two rows of the rocker (30 and 210
degrees) depart from the four-bar that fits best by 0.015 to 0.018, the others by less than 0.005.
"""

import numpy as np
import pytest

from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from each import for_each
from linkages import slotted_press

PRINTED = {
    "rod_centre": [0.025, 0.032, 0.046, 0.05, 0.043, 0.031, 0.025, 0.037, 0.045, 0.05, 0.046, 0.036],
    "rod": [0.083, 0.082, 0.05, 0, 0.051, 0.079, 0.083, 0.068, 0.035, 0, 0.035, 0.062],
    "rocker": [0, 0.115, 0.22, 0.238, 0.193, 0.107, 0, 0.129, 0.197, 0.238, 0.21, 0.133],
    "punch": [0, 0.025, 0.044, 0.05, 0.042, 0.024, 0, 0.028, 0.042, 0.05, 0.043, 0.027],
}


@pytest.fixture(scope="module")
def computed():
    solved = linkage_motion(slotted_press(), CrankGrid.from_degrees(np.arange(0.0, 360, 30)))
    centre = solved.points["rod_centre"]
    return {
        "rod_centre": np.hypot(centre.x.position_1, centre.y.position_1),
        "rod": np.abs(solved.links["rod"].position_1),
        "rocker": np.abs(solved.links["rocker"].position_1),
        "punch": np.abs(solved.sliders["punch"].position_1),
    }


@for_each(
    ("name", "root_mean_square"), [("rod_centre", 0.0009), ("rod", 0.0015), ("rocker", 0.0071), ("punch", 0.0011)]
)
def test_the_printed_table_to_the_accuracy_of_the_velocity_plans(computed, name, root_mean_square):
    difference = computed[name] - PRINTED[name]
    assert np.sqrt(np.mean(difference**2)) < root_mean_square


def test_the_rocker_without_the_two_rows_that_stand_out(computed):
    difference = np.delete(computed["rocker"] - PRINTED["rocker"], [1, 7])
    assert np.max(np.abs(difference)) < 0.005


def test_the_whole_table(computed):
    difference = np.concatenate([computed[name] - PRINTED[name] for name in PRINTED])
    assert np.sqrt(np.mean(difference**2)) < 0.0037
