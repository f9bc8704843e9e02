"""Linkages in the change-point class, and others of their lengths, from machine files.

Contraparallelogram 2, 5, 2, 5: closed form tan(psi/2) = -(d + a)/(d - a) tan(phi/2) at 25 digits. Kite of an
examination (GATE ME 2015, gateoverflow.in/485): O2O4 = O2A = L, AB = O4B = sqrt(2) L at 90 degrees, its ratio of speeds
from the closed form at 40 digits, 0.79 to the two decimals asked. Crank-rocker for a swing of 80 degrees and a time
ratio of 10 / 9 (S. Goessner, crocker.js, README): crank 60, frame 120, coupler 103 and rocker 94, at 40 digits.
"""

import math

import numpy as np
import pytest

import crankwork
from crankwork.kinematics.crank_grid import CrankGrid

CROSSED = {
    0: (0.0, -2.333333333333333),
    30: (-64.02846339938661, -1.7980234188345),
    60: (-106.8264488927411, -1.105263157894737),
    90: (-133.6028189727036, -0.7241379310344828),
    120: (-152.204227503972, -0.5384615384615385),
    150: (-166.8982267243566, -0.4533629027921179),
    180: (-180.0, -0.4285714285714286),
}


LINKAGE = """
fixed_points = {{ O = ["0 mm", "0 mm"], D = ["{ground!r} mm", "0 mm"] }}
crank = {{ pivot = "O", pin = "A", radius = "{crank!r} mm", speed = "1 rad/s" }}
links.coupler = {{ joins = ["A", "B"], length = "{coupler!r} mm", points = {{ T = ["{tracer!r} mm", "0 mm"] }} }}
links.rocker = {{ joins = ["D", "B"], length = "{rocker!r} mm" }}
branch.B = {branch}
"""


def linkage(*lengths, degrees, branch=1, tracer=1.0):
    """Return the columns of a four-bar of the stated branch at crank angles."""
    crank, coupler, rocker, ground = (float(one) for one in lengths)
    text = LINKAGE.format(crank=crank, coupler=coupler, rocker=rocker, ground=ground, branch=branch, tracer=tracer)
    return crankwork.analyse(crankwork.read_machine(text), CrankGrid.from_degrees(degrees)).columns


def test_the_contraparallelogram_through_its_change_points():
    found = linkage(2, 5, 2, 5, branch=-1, degrees=list(CROSSED))
    angles = np.degrees(found["link_angle.rocker"])
    # whole turns aside
    assert angles - angles[0] == pytest.approx([angle for angle, _ in CROSSED.values()], abs=1e-10)
    assert found["link_angular_velocity.rocker"] == pytest.approx([ratio for _, ratio in CROSSED.values()], rel=1e-12)


def test_the_parallelogram_through_the_same_points():
    found = linkage(2, 5, 2, 5, degrees=list(CROSSED))
    assert found["link_angular_velocity.rocker"] == pytest.approx(np.ones(7), abs=1e-12)
    assert np.remainder(found["link_angle.coupler"] + 1, math.tau) == pytest.approx(np.ones(7), abs=1e-12)


def test_the_kite_of_an_examination():
    found = linkage(1, math.sqrt(2), math.sqrt(2), 1, degrees=[90.0])
    assert np.degrees(found["link_angle.rocker"]) % 360 == pytest.approx([75.0], abs=1e-11)
    assert found["link_angular_velocity.rocker"] == pytest.approx([0.7886751345948129], rel=1e-12)


def test_the_tracer_of_the_lambda_linkage():
    """Chebyshev's lambda linkage: level over 180 degrees, 0.9 cranks higher in between."""
    found = linkage(1, 2.5, 2.5, 2, tracer=5.0, degrees=[0.0, 30.0, 60.0, 90.0, 120.0, 180.0, 270.0])
    height = [4.898979485566356, 4.432247961528706, 4.06201920231798, 4.0, 4.008918628686366, 4.0, 4.0]
    assert 1e3 * found["point_y.T"] == pytest.approx(height, rel=1e-12)
    x = 1e3 * found["point_x.T"][[0, 1, 2, 3, 5]]
    assert x == pytest.approx([2.0, 3.954297731325087, 4.345207879911715, 4.0, 2.0], rel=1e-11)
