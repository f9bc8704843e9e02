"""Shaking forces are what the joints put on the ground, and counterweights take what turns with the crank."""

import math

import numpy as np
import pytest

from crankwork import analyse, read_machine, template
from crankwork.kinematics.crank_grid import CrankGrid

pytestmark = pytest.mark.elsewhere


def test_shaking_force_and_moment_are_those_of_the_joints_on_the_ground():
    found = analyse(read_machine(template("four-bar")), CrankGrid.from_degrees(np.arange(0.0, 360.0, 10.0))).columns
    for axis in "xy":
        held = found[f"joint_force_{axis}.O"] + found[f"joint_force_{axis}.C"]
        assert found[f"shaking_force_{axis}"] == pytest.approx(-held, rel=1e-9, abs=1e-9)
    # about the pivot of the crank: the other pivot is 200 mm from it along x, and the driver holds the crank
    moment = -(0.2 * found["joint_force_y.C"] + found["balancing_torque"])
    assert found["shaking_moment"] == pytest.approx(moment, rel=1e-9, abs=1e-9)


YOKE = """
    [fixed_points]
    O = ["0 mm", "0 mm"]
    [crank]
    pivot = "O"
    pin = "A"
    radius = "50 mm"
    speed = "10 rad/s"
    {crank}
    [guides]
    track = {{ link = "yoke", angle = "90 deg" }}
    bed = {{ through = "O" }}
    [sliders]
    yoke = {{ pin = "Y", guide = "bed", mass = "4 kg" }}
    block = {{ pin = "A", guide = "track" }}
"""


@pytest.mark.parametrize("crank", ['start = "0 deg"', 'start = "30 deg"\n    direction = "clockwise"'])
def test_half_the_mass_of_a_yoke_turns_with_the_crank(crank):
    summary = analyse(read_machine(YOKE.format(crank=crank))).summary
    assert summary["shaking_force_max"] == pytest.approx(4 * 0.05 * 100, rel=1e-12)
    assert summary["free_force.1"] == pytest.approx(20, rel=1e-12)
    # of a force that only turns with the crank rounding leaves nothing in the other orders
    assert [summary[f"free_force.{order}"] for order in (2, 3, 4)] == [0.0, 0.0, 0.0]
    assert summary["counterweight_moment"] == pytest.approx(4 * 0.05 / 2, rel=1e-12)
    assert abs(summary["counterweight_angle"]) == pytest.approx(math.pi, rel=1e-12)
