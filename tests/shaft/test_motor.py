"""Torque of motors over speed, and the choice of a motor."""

from __future__ import annotations

import math

import numpy as np
import pytest

from crankwork.errors import MethodError
from crankwork.shaft.curve import Curve
from crankwork.shaft.motor import (
    AsynchronousMotor,
    ConstantMotor,
    GearedMotor,
    LinearMotor,
    SeriesMotor,
    TableMotor,
    breakdown_slip,
    breakdown_slip_full,
    synchronous_speed,
)
from crankwork.shaft.motor_choice import (
    CatalogueMotor,
    check_motor,
    choose_motor,
    first_angle_beyond,
    motor_need,
)

pytestmark = pytest.mark.elsewhere

RPM = math.pi / 30


def test_synchronous_speed():
    assert synchronous_speed(50.0, 2, math.pi) == pytest.approx(1500 * RPM)
    assert synchronous_speed(60.0, 3, math.pi) == pytest.approx(1200 * RPM)


@pytest.mark.parametrize("ratio", [0.0, 0.5, 1.0])
def test_a_catalogue_motor_has_its_rated_and_its_greatest_torque(ratio):
    motor = AsynchronousMotor.of_catalogue(7500.0, 1455 * RPM, 2.5, resistance_ratio=ratio)
    rated = 7500 / (1455 * RPM)
    assert motor.torque(1455 * RPM) == pytest.approx(rated, rel=1e-12)
    speeds = np.linspace(0, 1500 * RPM, 100001)
    assert np.max(motor.torque(speeds)) == pytest.approx(2.5 * rated, rel=1e-8)
    assert motor.torque(motor.synchronous_speed) == 0.0
    assert motor.torque(1600 * RPM) < 0.0


def test_the_full_formula_with_no_stator_is_the_simplified_one():
    assert breakdown_slip_full(0.03, 2.2, 0.0) == breakdown_slip(0.03, 2.2)
    assert breakdown_slip(0.03, 2.2) == pytest.approx(0.03 * 4.1595918, rel=1e-7)


@pytest.mark.parametrize(
    ("speed", "overload", "ratio"), [(1500 * RPM, 2.0, 0.0), (1400 * RPM, 1.0, 0.0), (1000 * RPM, 3.0, 1.0)]
)
def test_motors_that_do_not_exist(speed, overload, ratio):
    with pytest.raises(MethodError):
        AsynchronousMotor.of_catalogue(7500.0, speed, overload, resistance_ratio=ratio)


def test_linear_and_direct_current():
    motor = LinearMotor.of_rating(1500.0, 150.0, 157.0)
    assert motor.torque(150.0) == pytest.approx(10)
    assert motor.torque(157.0) == 0
    shunt = LinearMotor.of_direct_current(220.0, 0.5, 1.4)
    assert shunt.torque(0.0) == pytest.approx(1.4 * 220 / 0.5)
    series = SeriesMotor(220.0, 0.5, 0.02)
    assert series.torque(0.0) == pytest.approx(0.02 * 440**2)
    assert series.torque(100.0) == pytest.approx(0.02 * 88**2)


def test_table_and_constant():
    assert TableMotor(np.array([0.0, 10.0]), np.array([5.0, 1.0])).torque([0, 5, 20]) == pytest.approx([5, 3, 1])
    assert ConstantMotor(3.0).torque([1, 2]) == pytest.approx([3, 3])


def test_a_gear():
    geared = GearedMotor(LinearMotor(1.0, 100.0), 10.0, 0.02, 0.5)
    assert geared.reduced_inertia == pytest.approx(2.0)
    assert geared.torque(9.0) == pytest.approx(10 * 10 * 0.5)
    assert geared.torque(11.0) == pytest.approx(-10 * 10 / 0.5)


LOAD = Curve.linear(np.radians([0, 90, 90, 180, 180, 360]), [10.0, 10.0, 100.0, 100.0, 10.0, 10.0])


def test_what_a_load_needs():
    need = motor_need(LOAD, 20.0, efficiency=0.8, safety=1.2)
    assert need.mean_torque == pytest.approx(32.5)
    assert need.rms_torque == pytest.approx(math.sqrt((100 * 3 + 10000) / 4))
    assert need.mean_power == pytest.approx(1.2 * 32.5 * 20 / 0.8)
    assert (need.largest_torque, need.at_largest) == pytest.approx((100, math.pi / 2))


CATALOGUE = [CatalogueMotor(f"{p} kW", 1e3 * p, 1440 * RPM, 2.2) for p in (0.55, 0.75, 1.1, 1.5, 2.2)]


def test_the_smallest_motor_that_does():
    need = motor_need(LOAD, 20.0)
    chosen = choose_motor(need, CATALOGUE)
    # rms 50.7 N m at 20 rad/s is 1.01 kW; 100 N m at 20 rad/s is 2 kW, and 2.2 times 1.1 kW is enough
    assert chosen.motor.name == "1.1 kW"
    assert choose_motor(need, CATALOGUE, heating=False).motor.name == "1.1 kW"


def test_what_is_too_weak_is_said_with_the_angle():
    check = check_motor(motor_need(LOAD, 20.0), CATALOGUE[0])
    assert not check.ok
    assert "0.55 kW is too weak" in check.message
    assert "at 90.0 deg the load needs 100 N m" in check.message
    with pytest.raises(MethodError, match=r"no motor of the catalogue does; 0\.75 kW is too weak"):
        choose_motor(motor_need(LOAD, 20.0), CATALOGUE[:2])
    with pytest.raises(MethodError, match="empty"):
        choose_motor(motor_need(LOAD, 20.0), [])


def test_where_the_load_first_exceeds_a_torque():
    assert first_angle_beyond(LOAD, 60.0) == pytest.approx(math.pi / 2)
    assert first_angle_beyond(LOAD, 5.0) == 0.0
    assert first_angle_beyond(LOAD, 100.0) is None
    assert first_angle_beyond(Curve.linear([0, 1, 2], [0, 10, 0]), 5.0) == pytest.approx(0.5)
