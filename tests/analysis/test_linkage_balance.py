"""Shaking forces are what the joints put on the ground, and counterweights take what turns with the crank."""

import cmath
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
    fixed_points.O = ["0 mm", "0 mm"]
    guides = {{ track = {{ link = "yoke", angle = "90 deg" }}, bed = {{ through = "O" }} }}
    [sliders]
    yoke = {{ pin = "Y", guide = "bed", mass = "4 kg" }}
    block = {{ pin = "A", guide = "track" }}
    [crank]
    pivot = "O"
    pin = "A"
    radius = "50 mm"
    speed = "10 rad/s"
    {crank}
"""


def test_half_the_mass_of_a_yoke_turns_with_the_crank():
    for crank in ('start = "0 deg"', 'start = "30 deg"\n    direction = "clockwise"'):
        summary = analyse(read_machine(YOKE.format(crank=crank))).summary
        assert summary["shaking_force_max"] == pytest.approx(4 * 0.05 * 100, rel=1e-12), crank
        assert summary["free_force.1"] == pytest.approx(20, rel=1e-12), crank
        # of a force that only turns with the crank rounding leaves nothing in the other orders
        assert [summary[f"free_force.{order}"] for order in (2, 3, 4)] == [0.0, 0.0, 0.0], crank
        assert summary["counterweight_moment"] == pytest.approx(4 * 0.05 / 2, rel=1e-12), crank
        assert abs(summary["counterweight_angle"]) == pytest.approx(math.pi, rel=1e-12), crank


def test_a_cycle_of_two_turns_has_half_orders():
    """A kite, by sums over its own samples: 2.41701, 3.94784, 0.46841 N and none of order 2."""
    text = """
fixed_points = { O = ["0 mm", "0 mm"], B = ["100 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "100 mm", speed = "60 rpm", start = "40 deg", inertia = "0.01 kg*m2" }
links.coupler = { joins = ["A", "C"], length = "250 mm", mass = "1 kg", centre = ["125 mm", "0 mm"] }
links.rocker = { joins = ["B", "C"], length = "250 mm", mass = "1 kg", centre = ["125 mm", "0 mm"] }
positions.C = ["300 mm", "150 mm"]
"""
    results = analyse(read_machine(text))
    degrees = np.arange(1440) / 2
    columns = results.columns_at(degrees, ["shaking_force_x", "shaking_force_y"])
    force = columns["shaking_force_x"] + 1j * columns["shaking_force_y"]
    for order in (0.5, 1.0, 1.5, 2.5):
        turned = np.exp(1j * order * np.radians(degrees))
        size = abs(np.mean(force * turned)) + abs(np.mean(force / turned))
        assert results.summary[f"free_force.{order:g}"] == pytest.approx(size, rel=1e-9)
    assert results.summary["free_force.0.5"] == pytest.approx(2.41701, rel=1e-5)
    assert results.summary["free_force.2"] == pytest.approx(0.0, abs=1e-9)


THREE = """
fixed_points.O = ["0 mm", "0 mm"]
guides.line = { through = "O", angle = "90 deg" }
[crank]
pivot = "O"
pin = "A0"
radius = "57.3 mm"
speed = "3000 rpm"
start = "90 deg"
"""
ROD = """
[links.rod_{n}]
joins = ["A{n}", "B{n}"]
length = "190 mm"
mass = "0.7 kg"
centre = ["61 mm", "0 mm"]
[sliders.piston_{n}]
guide = "line"
pin = "B{n}"
mass = "0.9 kg"
"""


def test_of_forces_that_cancel_rounding_leaves_nothing():
    """Three equal throws at 120 degrees with rods to one line: no order that 3 does not divide, and no direction."""
    turns = [cmath.rect(57.3, math.radians(120 * n)) for n in range(3)]
    text = THREE + "".join(f'points.A{n} = ["{turns[n].real} mm", "{turns[n].imag} mm"]\n' for n in (1, 2))
    text += "[positions]\n" + "".join(
        f'B{n} = ["0 mm", "{turn.real + math.sqrt(190**2 - turn.imag**2)} mm"]\n' for n, turn in enumerate(turns)
    )
    summary = analyse(read_machine(text + "".join(ROD.format(n=n) for n in range(3)))).summary
    assert [summary[f"free_force.{order}"] for order in (1, 2, 4)] == [0.0, 0.0, 0.0]
    assert summary["counterweight_moment"] == 0.0
    assert "counterweight_angle" not in summary
