"""Khurmi and Gupta, Theory of Machines, chapter 16: turning moment diagrams and flywheels.

R. S. Khurmi, J. K. Gupta: Theory of Machines. S. Chand, New Delhi 2005. Chapter 16, Turning moment diagrams and
flywheel, examples 16.7, 16.8, 16.11 and 16.19. The printed values were read from the public notebook of the book's
examples, github.com/FOSSEE/Python-Textbook-Companions at commit d34b2ae7e5e6051f7c87531ebc73b154b082d05b, file
Theory_Of_Machines_by_R._S._Khurmi_And_J._K._Gupta/ch16.ipynb, so they are secondary to the book. The book measures
areas of the diagram; here the broken line is integrated exactly, and the recomputed digits are from there.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import excess_work, fluctuation_of_inertia, true_speed
from crankwork.shaft.flywheel import WAYS, flywheel, flywheels
from crankwork.shaft.motor_choice import motor_need, needed_power


def _speed(rpm: float) -> float:
    return rpm * math.pi / 30


class TestExample7:
    """Example 16.7, page 578: two triangles per revolution; mass of the flywheel and angles of extreme speed."""

    torque = Curve.linear(np.radians([0, 80, 180, 270, 360]), [0.0, 2000.0, 0.0, 1500.0, 0.0])
    machine = Curve.constant(0.0)

    def test_the_printed_values(self) -> None:
        excess = excess_work(self.torque)
        found = flywheel(self.machine, self.torque, _speed(100), 0.015)
        assert round(100 * excess.coefficient) == 18
        assert round(found.inertia / 1.75**2, 1) == 197.3
        assert round(math.degrees(excess.extremes.at_least)) == 35
        assert round(math.degrees(excess.extremes.at_largest)) == 136

    def test_the_recomputed_values(self) -> None:
        excess = excess_work(self.torque)
        found = flywheel(self.machine, self.torque, _speed(100), 0.015)
        assert excess.mean_torque == pytest.approx(875, rel=1e-14)
        assert excess.work == pytest.approx(994.0195, abs=1e-4)
        assert 100 * excess.coefficient == pytest.approx(18.08036, abs=1e-5)
        assert found.inertia / 1.75**2 == pytest.approx(197.3197, abs=1e-4)
        assert math.degrees(excess.extremes.at_least) == pytest.approx(35, abs=1e-9)
        assert math.degrees(excess.extremes.at_largest) == pytest.approx(136.25, abs=1e-9)

    def test_all_ways_agree(self) -> None:
        found = flywheels(self.machine, self.torque, _speed(100), 0.015)
        assert [one.way for one in found] == list(WAYS)
        assert [one.inertia for one in found] == pytest.approx([found[0].inertia] * 4, rel=1e-13)
        assert max(abs(one.residual) for one in found) < 1e-14


class TestExample8:
    """Example 16.8, page 580: three cylinders at 120 degrees, each with one triangle per revolution."""

    one = Curve.linear(np.radians([0, 60, 180, 360]), [0.0, 90.0, 0.0, 0.0])
    torque = one + one.delayed(2 * math.pi / 3) + one.delayed(4 * math.pi / 3)
    inertia = 12 * 0.08**2

    def test_the_printed_values(self) -> None:
        """The book rounds the fluctuation, 3.9 per cent, up to 4, and cuts 292.97 rad/s2."""
        excess, need = excess_work(self.torque), motor_need(self.torque, _speed(600))
        assert round(need.mean_power / 1e3, 2) == 4.24
        assert round(excess.work, 2) == 11.78
        assert round(100 * excess.coefficient, 2) == 2.78
        assert round(100 * float(fluctuation_of_inertia(excess.work, self.inertia, _speed(600)))) == 4
        assert int(self._largest_acceleration()) == 292

    def test_the_recomputed_values(self) -> None:
        excess, need = excess_work(self.torque), motor_need(self.torque, _speed(600))
        assert need.mean_power == pytest.approx(4241.15, abs=0.005)
        assert excess.work == pytest.approx(11.780972, abs=1e-6)
        assert 100 * excess.coefficient == pytest.approx(2.777778, abs=1e-6)
        delta = float(fluctuation_of_inertia(excess.work, self.inertia, _speed(600)))
        assert 100 * delta == pytest.approx(3.885619, abs=1e-6)
        assert self._largest_acceleration() == pytest.approx(292.96875, rel=1e-12)

    def test_the_true_speed_has_that_fluctuation(self) -> None:
        speed = true_speed(Curve.constant(self.inertia), self.torque, _speed(600))
        assert 100 * speed.fluctuation == pytest.approx(3.885619, abs=1e-6)

    def _largest_acceleration(self) -> float:
        speed = true_speed(Curve.constant(self.inertia), self.torque, _speed(600))
        return float(np.max(np.abs(speed.acceleration(self.torque.angle))))


class TestExample11:
    """Example 16.11, page 585: T = 20000 + 9500 sin 2t - 5700 cos 2t, one per cent at 180 rev/min.

    The book takes w^2 C_s = 3.55 for 3.5531 and so prints 3121 kg m2 and 3.044 rad/s2, both 0.1 per cent off.
    """

    angle = np.linspace(0, 2 * math.pi, 1441)
    torque = Curve.hermite(
        angle,
        20000 + 9500 * np.sin(2 * angle) - 5700 * np.cos(2 * angle),
        19000 * np.cos(2 * angle) + 11400 * np.sin(2 * angle),
    )

    def test_power_and_excess_work(self) -> None:
        need, excess = motor_need(self.torque, _speed(180)), excess_work(self.torque)
        assert round(need.mean_power / 1e3) == 377
        assert need.mean_power == pytest.approx(376991, abs=0.5)
        assert int(excess.work) == 11078
        assert excess.work == pytest.approx(math.hypot(9500, 5700), rel=1e-9)

    def test_flywheel_and_acceleration(self) -> None:
        found = flywheel(Curve.constant(0.0), self.torque, _speed(180), 0.01)
        assert found.inertia == pytest.approx(3118.11, abs=0.005)
        assert found.inertia == pytest.approx(3121, rel=2e-3)
        speed = true_speed(Curve.constant(found.inertia), self.torque, _speed(180))
        acceleration = float(speed.acceleration(np.array([math.pi / 4]))[0])
        assert acceleration == pytest.approx(3.04672, abs=5e-6)
        assert acceleration == pytest.approx(3.044, rel=2e-3)


class TestExample19:
    """Example 16.19, page 603: a punching press, 720 operations an hour of 15 kJ in 2 s, from 225 to 200 rev/min.

    The load is a torque pulse over 2 of the 5 seconds of a cycle; time stands in for the angle, so that the excess
    work is what the flywheel gives while the motor runs on at its mean power.
    """

    work, period, stroke, gyration = 15000.0, 3600 / 720, 2.0, 0.5
    load = Curve.linear([0, stroke, stroke, period], [work / stroke, work / stroke, 0.0, 0.0])

    def test_the_motor(self) -> None:
        assert round(float(needed_power(1.0, self.load.mean, 1.0, 1.0)) / 1e3, 12) == 3.0

    def test_the_flywheel(self) -> None:
        excess = excess_work(self.load)
        assert excess.work == pytest.approx(9000, rel=1e-14)
        fast, slow = _speed(225), _speed(200)
        mean = (fast + slow) / 2
        found = flywheel(Curve.constant(0.0, self.period), self.load, mean, (fast - slow) / mean)
        mass = found.inertia / self.gyration**2
        assert round(mass) == 618
        assert mass == pytest.approx(617.94, abs=0.005)
