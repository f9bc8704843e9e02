"""Torque of motors over speed, and what a load needs."""

import math

import numpy as np
import pytest

from crankwork.errors import MethodError
from crankwork.shaft.curve import Curve
from crankwork.shaft.motor import AsynchronousMotor, GearedMotor, breakdown_slip, first_angle_beyond, synchronous_speed
from each import for_each
from motors import LinearMotor

pytestmark = pytest.mark.elsewhere

RPM = math.pi / 30


def test_synchronous_speed():
    assert synchronous_speed(50.0, 2, math.pi) == pytest.approx(1500 * RPM)
    assert synchronous_speed(60.0, 3, math.pi) == pytest.approx(1200 * RPM)


def test_a_catalogue_motor_has_its_rated_and_its_greatest_torque():
    motor = AsynchronousMotor.of_catalogue(7500.0, 1455 * RPM, 2.5)
    rated = 7500 / (1455 * RPM)
    assert motor.torque(1455 * RPM) == pytest.approx(rated, rel=1e-12)
    speeds = np.linspace(0, 1500 * RPM, 100001)
    assert np.max(motor.torque(speeds)) == pytest.approx(2.5 * rated, rel=1e-8)
    assert motor.torque(motor.synchronous_speed) == 0.0
    assert motor.torque(1600 * RPM) < 0.0


def test_the_slip_of_the_greatest_torque():
    assert breakdown_slip(0.03, 2.2) == pytest.approx(0.03 * 4.1595918, rel=1e-7)


@for_each(("speed", "overload"), [(1500 * RPM, 2.0), (1400 * RPM, 1.0)])
def test_motors_that_do_not_exist(speed, overload):
    with pytest.raises(MethodError):
        AsynchronousMotor.of_catalogue(7500.0, speed, overload)


def test_a_gear():
    geared = GearedMotor(LinearMotor(1.0, 100.0), 10.0, 0.02, 0.5)
    assert geared.reduced_inertia == pytest.approx(2.0)
    assert geared.torque(9.0) == pytest.approx(10 * 10 * 0.5)
    assert geared.torque(11.0) == pytest.approx(-10 * 10 / 0.5)


LOAD = Curve.linear(np.radians([0, 90, 90, 180, 180, 360]), [10.0, 10.0, 100.0, 100.0, 10.0, 10.0])


def test_where_the_load_first_exceeds_a_torque():
    assert first_angle_beyond(LOAD, 60.0) == pytest.approx(math.pi / 2)
    assert first_angle_beyond(LOAD, 5.0) == 0.0
    assert first_angle_beyond(LOAD, 100.0) is None
    assert first_angle_beyond(Curve.linear([0, 1, 2], [0, 10, 0]), 5.0) == pytest.approx(0.5)
