"""The four-bar linkage 2.5 / 7 / 4.5 / 8 at 60 degrees, which two books solve graphically.

T. Bevan, The Theory of Machines, ch. 3, p. 98 (inches, 100 rev/min), and R. S. Khurmi and J. K. Gupta, Theory of
Machines, ch. 8, p. 184 (25 mm to the inch, 10 rad/s), as printed in the companion notebooks FOSSEE
Python-Textbook-Companions. Read off drawings: 0.1 to 4 per cent.
"""

import math

import numpy as np
import pytest

from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.mechanism.catalog import four_bar

GRID = CrankGrid.from_degrees([60.0])


@pytest.fixture(scope="module")
def motion():
    inch = 0.0254
    return linkage_motion(four_bar(2.5 * inch, 7 * inch, 4.5 * inch, 8 * inch), GRID)


def test_angles_and_rates_against_the_exact_solution_of_the_loop(motion):
    coupler, rocker = motion.links["coupler"], motion.links["rocker"]
    assert np.degrees(coupler.position) == pytest.approx(19.463423, abs=5e-7)
    assert np.degrees(rocker.position) == pytest.approx(91.910458, abs=5e-7)
    assert 10 * coupler.position_1 == pytest.approx(-1.980026, abs=5e-7)
    assert 10 * rocker.position_1 == pytest.approx(3.7870723, abs=5e-8)
    assert 100 * coupler.position_2 == pytest.approx(23.3675698, abs=5e-8)
    assert 100 * rocker.position_2 == pytest.approx(46.1434599, abs=5e-8)


def test_khurmi_reads_within_two_per_cent(motion):
    coupler, rocker = motion.links["coupler"], motion.links["rocker"]
    assert abs(10 * coupler.position_1) == pytest.approx(1.9, rel=0.045)
    assert abs(10 * rocker.position_1) == pytest.approx(3.79, rel=0.01)
    assert abs(100 * coupler.position_2) == pytest.approx(23.43, rel=0.01)
    assert abs(100 * rocker.position_2) == pytest.approx(47.1, rel=0.025)


def test_bevan_reads_within_five_per_cent(motion):
    speed = 100 * math.tau / 60
    coupler, rocker = motion.links["coupler"], motion.links["rocker"]
    pin = motion.points["coupler_pin"]
    foot = 0.3048
    assert speed * np.hypot(pin.x.position_1, pin.y.position_1) / foot == pytest.approx(1.47, rel=0.015)
    assert abs(speed * coupler.position_1) * 7 / 12 == pytest.approx(1.26, rel=0.045)
    assert abs(speed**2 * rocker.position_2) == pytest.approx(50.9, rel=0.01)
    assert abs(speed**2 * coupler.position_2) == pytest.approx(24.7, rel=0.045)
