"""Areas, volumes, polytropes and gas forces, each against numbers that can be worked out by hand."""

import math

import numpy as np
import pytest

from crankwork.loads import gas
from each import for_each

pytestmark = pytest.mark.elsewhere


def test_the_area_is_that_of_a_circle_with_the_pi_of_the_calculation() -> None:
    assert gas.piston_area(math.pi, 2.0) == math.pi
    assert gas.piston_area(3.14, 0.2) == pytest.approx(0.0314, rel=1e-15)


def test_swept_volume_is_area_times_stroke() -> None:
    assert gas.swept_volume(0.01, 0.1) == pytest.approx(1e-3, rel=1e-15)


def test_the_clearance_volume_gives_the_compression_ratio_it_was_made_for() -> None:
    assert gas.clearance_volume(900.0, 10.0) == 100.0
    assert gas.compression_ratio(900.0, 100.0) == 10.0
    assert gas.compression_ratio(5e-4, gas.clearance_volume(5e-4, 9.3)) == pytest.approx(9.3, rel=1e-14)


def test_the_volume_is_the_clearance_at_top_dead_centre_and_all_at_bottom() -> None:
    volumes = gas.cylinder_volume(1e-4, 0.01, np.array([0.0, 0.05, 0.1]))
    assert volumes == pytest.approx([1e-4, 6e-4, 1.1e-3], rel=1e-15)


@for_each(("exponent", "expected"), [(0.0, 1e5), (1.0, 2e5), (2.0, 4e5), (1.5, 2**1.5 * 1e5), (-1.0, 0.5e5)])
def test_half_the_volume_multiplies_the_pressure_by_a_power_of_two(exponent: float, expected: float) -> None:
    assert gas.polytropic_pressure(1e5, 1e-3, 0.5e-3, exponent) == pytest.approx(expected, rel=1e-15)


def test_a_polytrope_passes_through_its_known_state() -> None:
    assert gas.polytropic_pressure(1.7e5, 3e-4, 3e-4, 1.37) == 1.7e5


def test_gas_force_is_pressure_times_area() -> None:
    assert gas.gas_force(2e6, 0.01, 0.0, 0.0) == pytest.approx(2e4, rel=1e-15)


def test_the_crank_side_of_a_double_acting_piston_lacks_the_area_of_its_rod() -> None:
    assert gas.gas_force(30.0, 2.0, 4.0, 0.5) == 60 - 4 * 1.5
    assert gas.gas_force(30.0, 2.0, 0.0, 0.5) == 60


def test_equal_pressure_on_both_sides_leaves_the_force_on_the_piston_rod() -> None:
    assert gas.gas_force(30.0, 2.0, 30.0, 0.5) == 15.0


def test_mean_pressure_mean_torque_and_power_share_the_work_out() -> None:
    assert gas.indicated_mean_pressure(500.0, 5e-4) == pytest.approx(1e6, rel=1e-15)
    assert gas.mean_torque(500.0, 4 * math.pi) == 500 / (4 * math.pi)
    assert gas.indicated_power(500.0, 100.0, 4 * math.pi) == pytest.approx(500 * 100 / (4 * math.pi), rel=1e-15)
    assert gas.indicated_power(500.0, 100.0, 4 * math.pi) == pytest.approx(
        gas.mean_torque(500.0, 4 * math.pi) * 100.0, rel=1e-15
    )
