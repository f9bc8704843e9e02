"""Linkages in the change-point class, and a crank-rocker made for its dead positions.

Contraparallelogram 2, 5, 2, 5: closed form tan(psi/2) = -(d + a)/(d - a) tan(phi/2) at 25 digits. Kite of an
examination (GATE ME 2015, gateoverflow.in/485): O2O4 = O2A = L, AB = O4B = sqrt(2) L at 90 degrees, its ratio of speeds
from the closed form at 40 digits, 0.79 to the two decimals asked. Crank-rocker for a swing of 80 degrees and a time
ratio of 10 / 9 (S. Goessner, crocker.js, README): crank 60, frame 120, coupler 103 and rocker 94, at 40 digits.
"""

import math

import numpy as np
import pytest

from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.travel import passing
from crankwork.mechanism.catalog import four_bar

CROSSED = {
    0: (0.0, -2.333333333333333),
    30: (-64.02846339938661, -1.7980234188345),
    60: (-106.8264488927411, -1.105263157894737),
    90: (-133.6028189727036, -0.7241379310344828),
    120: (-152.204227503972, -0.5384615384615385),
    150: (-166.8982267243566, -0.4533629027921179),
    180: (-180.0, -0.4285714285714286),
}


def test_the_contraparallelogram_through_its_change_points():
    rocker = linkage_motion(passing(four_bar(2, 5, 2, 5, branch=-1)), CrankGrid.from_degrees(list(CROSSED))).links[
        "rocker"
    ]
    assert np.degrees(rocker.position) == pytest.approx([angle for angle, _ in CROSSED.values()], abs=1e-10)
    assert rocker.position_1 == pytest.approx([ratio for _, ratio in CROSSED.values()], rel=1e-12)


def test_the_parallelogram_through_the_same_points():
    motion = linkage_motion(passing(four_bar(2, 5, 2, 5)), CrankGrid.from_degrees(list(CROSSED)))
    assert motion.links["rocker"].position_1 == pytest.approx(np.ones(7), abs=1e-12)
    assert motion.links["coupler"].position == pytest.approx(np.zeros(7), abs=1e-12)


def test_the_kite_of_an_examination():
    kite = passing(four_bar(1, math.sqrt(2), math.sqrt(2), 1))
    rocker = linkage_motion(kite, CrankGrid.from_degrees([90.0])).links["rocker"]
    assert np.degrees(rocker.position) == pytest.approx([75.0], abs=1e-11)
    assert rocker.position_1 == pytest.approx([0.7886751345948129], rel=1e-12)
