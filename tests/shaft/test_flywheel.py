"""Excess work, true speed, the flywheel four ways."""

import math

import numpy as np
import pytest

from crankwork.errors import MethodError
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import excess_work, fluctuation_of_inertia, true_speed
from crankwork.shaft.flywheel import inertia_of_wheel, inertia_on_other_shaft, rim_speed_of_stress
from each import for_each
from flywheels import WAYS, flywheel

pytestmark = pytest.mark.elsewhere

INERTIA = Curve.fitted(lambda phi: 0.5 + 0.2 * np.cos(2 * phi) + 0.05 * np.sin(phi), [0, 2 * math.pi])
LOAD = Curve.linear(np.radians([0, 200, 230, 250, 360]), [-40.0, -40.0, -400.0, -40.0, -40.0])


def test_all_crossings_count():
    """Three lobes of which the outer two together exceed the middle one: the extremes are not neighbours."""
    torque = Curve.linear([0, 1, 1, 2, 2, 3, 3, 4], [3.0, 3.0, -1.0, -1.0, 3.0, 3.0, -5.0, -5.0])
    excess = excess_work(torque)
    assert excess.work == pytest.approx(5.0)
    assert (excess.extremes.at_least, excess.extremes.at_largest) == (0.0, 3.0)
    assert excess.coefficient == math.inf


def test_true_speed_has_the_mean_asked_for_and_the_extremes_are_extremes():
    speed = true_speed(INERTIA + 3.0, LOAD, 10.0)
    angle = np.linspace(0, 2 * math.pi, 100001)
    w = speed.speed(angle)
    time = np.trapezoid(1 / w, angle)
    assert 2 * math.pi / time == pytest.approx(10, rel=1e-9)
    books = true_speed(INERTIA + 3.0, LOAD, 10.0, mean="extremes").extremes
    assert (books.largest + books.least) / 2 == pytest.approx(10, rel=1e-14)
    assert speed.fluctuation == pytest.approx((books.largest - books.least) / 10, rel=1e-13)
    assert (w.min(), w.max()) == pytest.approx((speed.extremes.least, speed.extremes.largest), rel=1e-7)
    assert w.min() >= speed.extremes.least * (1 - 1e-14)


def test_acceleration_is_the_derivative_of_the_speed():
    speed = true_speed(INERTIA + 3.0, LOAD, 10.0)
    angle, step = np.array([0.3, 1.7, 4.1, 5.5]), 1e-5
    slope = (speed.speed(angle + step) - speed.speed(angle - step)) / (2 * step)
    assert speed.acceleration(angle) == pytest.approx(speed.speed(angle) * slope, rel=1e-5)


@for_each("fluctuation", [0.3, 0.1, 0.02, 0.001])
def test_the_exact_flywheel_gives_the_fluctuation_asked_for(fluctuation):
    found = flywheel(INERTIA, LOAD, 10.0, fluctuation)
    turning = true_speed(INERTIA + found, LOAD, 10.0)
    assert turning.fluctuation == pytest.approx(fluctuation, abs=1e-12)


def test_the_ways_agree_where_the_inertia_is_constant():
    found = [flywheel(Curve.constant(0.5), LOAD, 10.0, 0.05, way) for way in WAYS]
    assert found == pytest.approx([found[0]] * 4, rel=1e-13)
    assert found[0] + 0.5 == pytest.approx(excess_work(LOAD).work / (0.05 * 100))


def test_order_of_convergence():
    def error(way, fluctuation):
        exact = flywheel(INERTIA, LOAD, 10.0, fluctuation)
        return abs(flywheel(INERTIA, LOAD, 10.0, fluctuation, way) / exact - 1)

    assert math.log2(error("mertsalov", 0.02) / error("mertsalov", 0.01)) == pytest.approx(1, abs=0.1)
    assert math.log2(error("wittenbauer", 0.02) / error("wittenbauer", 0.01)) == pytest.approx(2, abs=0.1)


def test_a_machine_that_needs_no_flywheel():
    assert flywheel(Curve.constant(1000.0), LOAD, 10.0, 0.1) < 0


@for_each(("speed", "fluctuation"), [(10, 0), (10, 2), (10, -0.1), (0, 0.1)])
def test_what_cannot_be_asked(speed, fluctuation):
    with pytest.raises(MethodError, match="between 0 and 2"):
        flywheel(INERTIA, LOAD, speed, fluctuation)


def test_a_machine_that_would_stop_says_where():
    with pytest.raises(MethodError, match=r"stops at a crank angle of 2\d\d"):
        true_speed(INERTIA, LOAD, 1.0)


def test_a_flywheel_on_a_faster_shaft_counts_by_the_square_of_the_ratio():
    assert inertia_on_other_shaft(2.0, 3.0) == 18.0
    assert fluctuation_of_inertia(10.0, 2.0, 5.0) == 0.2


def test_a_wheel_has_the_inertia_of_its_mass_at_its_radius_of_gyration():
    """Khurmi and Gupta, Theory of Machines, ch. 16: 6500 kg at 1.8 m, 21 060 kg m2."""
    assert inertia_of_wheel(6500.0, 1.8) == pytest.approx(21060.0, rel=1e-12)


def test_a_rim_turns_as_fast_as_its_hoop_stress_allows():
    """A thin ring under its own centrifugal force: stress = density times the square of the speed of the rim."""
    assert rim_speed_of_stress(8.1e6, 8100.0) == pytest.approx(31.6227766016838, rel=1e-14)


def test_mertsalovs_flywheel_where_nothing_works_holds_what_swings_of_the_inertia():
    """Without torque the energy of the second group alone swings: J = (J_max - J_min) / (2 delta) - J_min."""
    inertia = Curve.fitted(lambda phi: 3.0 + np.cos(2 * phi), [0, 2 * math.pi])
    found = flywheel(inertia, Curve.linear([0, 2 * math.pi], [0.0, 0.0]), 10.0, 0.05, "mertsalov")
    assert found == pytest.approx(2.0 / (2 * 0.05) - 2.0, rel=1e-12)
