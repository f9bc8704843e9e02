import pytest

from crankwork.dynamics.efficiency import driving_torque_as_brake, driving_torque_as_motor, efficiency

pytestmark = pytest.mark.elsewhere


def test_series_and_parallel():
    assert efficiency((0.9,)) == 0.9
    assert efficiency((0.9, 0.8)) == pytest.approx(0.72)
    assert efficiency(((0.9, 0.8),)) == pytest.approx(0.85)
    assert efficiency((0.5, (0.9, 0.25))) == pytest.approx(0.5 * (0.9 + 0.25) / 2)


def test_a_motor_pays_the_losses_and_a_brake_saves_them():
    assert driving_torque_as_motor(60.0, 20.0, 0.8) == pytest.approx(100)
    assert driving_torque_as_brake(-60.0, -20.0, 0.8) == pytest.approx(-64)
