"""Equation of motion: steady speed with a motor."""

import math

import numpy as np
import pytest

from crankwork.shaft.collocation import integrate_periodic
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import true_speed
from crankwork.shaft.motor import AsynchronousMotor, GearedMotor
from crankwork.shaft.steady_speed import ReducedMachine, steady_speed
from motors import LinearMotor, missed

pytestmark = pytest.mark.elsewhere

INERTIA = Curve.fitted(lambda phi: 0.5 + 0.2 * np.cos(2 * phi) + 0.05 * np.sin(phi), [0, 2 * math.pi])
LOAD = Curve.linear(np.radians([0, 40, 80, 120, 360]), [-5.0, -5.0, -100.0, -5.0, -5.0])
MOTOR = GearedMotor(AsynchronousMotor.of_catalogue(750.0, 148.0, 2.2), 14.0, 0.002)


def machine(flywheel=3.0, load=LOAD, motor=MOTOR):
    return ReducedMachine.of_curves(INERTIA, load, motor, flywheel=flywheel + MOTOR.reduced_inertia)


class TestCollocation:
    def test_a_periodic_solution(self):
        """The solution of y' = 2 - y + cos x that repeats is 2 + (cos x + sin x) / 2."""
        edges = np.linspace(0, 2 * math.pi, 5)
        solved = integrate_periodic(lambda x, y: 2 + np.cos(x) - y, edges, np.ones(5))
        assert solved.values == pytest.approx(2 + (np.cos(solved.edges) + np.sin(solved.edges)) / 2, abs=1e-13)
        assert solved.multiplier == pytest.approx(math.exp(-2 * math.pi))

    def test_no_periodic_solution_is_not_solved(self):
        """A solution of y' = y^2 + 1 grows for ever."""
        edges = np.linspace(0, 2 * math.pi, 9)
        assert not integrate_periodic(lambda x, y: y**2 + 1 + 0 * x, edges, np.ones(9)).converged


class TestSteady:
    def test_the_speed_repeats_and_the_energy_balances(self):
        found = steady_speed(machine(), 11.0)
        assert found.speed[0] == pytest.approx(found.speed[-1], rel=1e-14)
        assert missed(machine(), found) < 1e-10

    def test_it_does_not_depend_on_the_guess(self):
        one, two = (steady_speed(machine(), guess) for guess in (10.0, 11.2))
        assert one.mean_speed == pytest.approx(two.mean_speed, rel=1e-13)

    def test_extremes_are_extremes(self):
        found = steady_speed(machine(), 11.0)
        assert found.least <= found.speed.min()
        assert found.largest >= found.speed.max()
        assert found.fluctuation == pytest.approx(2 * (found.largest - found.least) / (found.largest + found.least))

    def test_a_soft_motor_is_nearly_a_constant_torque(self):
        """With a motor whose torque hardly changes, w is that of the energy quadrature."""
        soft = LinearMotor(1e-4, 10.0 - LOAD.mean / 1e-4)
        found = steady_speed(ReducedMachine.of_curves(INERTIA, LOAD, soft, flywheel=3.0), 10.0)
        middle = (found.largest + found.least) / 2
        exact = true_speed(INERTIA + 3.0, LOAD, found.mean_speed)
        books = true_speed(INERTIA + 3.0, LOAD, middle, mean="extremes")
        assert found.fluctuation == pytest.approx(books.fluctuation, rel=1e-4)
        assert found.speed == pytest.approx(exact.speed(found.angle), rel=1e-5)

    def test_a_load_beyond_the_motor_is_not_solved(self):
        assert steady_speed(machine(load=Curve.constant(-400.0)), 10.0) is None

    def test_no_steady_speed_without_a_motor(self):
        assert steady_speed(ReducedMachine.of_curves(INERTIA, LOAD - LOAD.mean), 10.0) is None
