"""Khurmi and Gupta, Theory of Machines, chapter 16: an engine of three cylinders as shifted copies of one.

R. S. Khurmi, J. K. Gupta: Theory of Machines. S. Chand, New Delhi 2005. Chapter 16, Turning moment diagrams and
flywheel, example 16.8, page 580: three single-acting cylinders, cranks at 120 degrees, at 600 rpm; the torque of each
rises to 90 N m at 60 degrees and falls to zero at 180 degrees; flywheel of 12 kg with a radius of gyration of 80 mm.
The printed values were read from the public notebook of the book's examples,
github.com/FOSSEE/Python-Textbook-Companions at commit d34b2ae7e5e6051f7c87531ebc73b154b082d05b, file
Theory_Of_Machines_by_R._S._Khurmi_And_J._K._Gupta/ch16.ipynb, so they are secondary to the book.
"""

import math

import numpy as np
import pytest

from crankwork.cylinders.arrangement import inline
from crankwork.cylinders.torque import curve_harmonics, total_harmonics
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import acceleration_of_crank, excess_work, fluctuation_of_inertia
from engines import cylinder_angle

SPEED = 600 * math.pi / 30
INERTIA = 12 * 0.08**2
ONE = Curve.linear(np.radians([0, 60, 180, 360]), [0.0, 90.0, 0.0, 0.0])
LAYOUT = inline(3, (1, 3, 2), strokes=2)[0]
TOTAL = ONE + ONE.delayed(math.radians(120)) + ONE.delayed(math.radians(240))


def test_the_cranks_stand_at_120_degrees():
    assert [place.pin_angle for place in LAYOUT.places] == [0, 120, 240]
    assert [place.firing_angle for place in LAYOUT.places] == [0, 240, 120]


def test_the_printed_values():
    excess = excess_work(TOTAL)
    assert round(excess.mean_torque * SPEED / 1000, 2) == 4.24
    assert round(excess.work, 2) == 11.78
    assert math.ceil(100 * float(fluctuation_of_inertia(excess.work, INERTIA, SPEED))) == 4  # printed rounded up
    assert round(100 * excess.coefficient, 2) == 2.78
    top = TOTAL.extremes().largest - TOTAL.mean
    assert int(acceleration_of_crank(top, SPEED, INERTIA, 0.0)) == 292  # printed cut off


def test_the_recomputed_values():
    excess = excess_work(TOTAL)
    assert excess.mean_torque * SPEED / 1000 == pytest.approx(4.24115, abs=5e-6)
    assert excess.work == pytest.approx(11.780972, abs=5e-7)
    assert 100 * float(fluctuation_of_inertia(excess.work, INERTIA, SPEED)) == pytest.approx(3.885619, abs=5e-7)
    assert 100 * excess.coefficient == pytest.approx(2.777778, abs=5e-7)
    top = TOTAL.extremes().largest - TOTAL.mean
    assert float(acceleration_of_crank(top, SPEED, INERTIA, 0.0)) == pytest.approx(292.96875, abs=1e-9)


def test_the_total_rises_and_falls_between_half_and_all_of_the_peak():
    """Every 60 degrees one cylinder begins, peaks or ends; between them the total is straight."""
    assert TOTAL(np.radians(np.arange(0, 360, 60))) == pytest.approx([45, 90, 45, 90, 45, 90])
    degrees = np.arange(0.0, 360.0, 7.0)
    by_cylinder = [ONE(np.radians(cylinder_angle(degrees, place, 360.0))) for place in LAYOUT.places]
    assert TOTAL(np.radians(degrees)) == pytest.approx(np.sum(by_cylinder, axis=0), abs=1e-12)


def test_only_every_third_order_is_left():
    one = curve_harmonics(ONE, 12)
    left = total_harmonics(one, LAYOUT).amplitude
    assert left[2::3] == pytest.approx(3 * one.amplitude[2::3], rel=1e-13)
    assert np.delete(left, [2, 5, 8, 11]) == pytest.approx(np.zeros(8), abs=1e-12)
    assert curve_harmonics(TOTAL, 12).amplitude == pytest.approx(left, abs=1e-12)
