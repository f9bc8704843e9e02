import pytest

from crankwork.dynamics.efficiency import Parallel, Series, driving_torque_as_brake, driving_torque_as_motor, efficiency
from each import for_each

pytestmark = pytest.mark.elsewhere


def test_series_and_parallel():
    assert efficiency(0.9) == 0.9
    assert efficiency(Series((0.9, 0.8))) == pytest.approx(0.72)
    assert efficiency(Parallel((0.9, 0.8))) == pytest.approx(0.85)
    assert efficiency(Parallel((0.9, 0.8), (0.75, 0.25))) == pytest.approx(0.875)
    assert efficiency(Series((0.5, Parallel((0.9, Series((0.5, 0.5))))))) == pytest.approx(0.5 * (0.9 + 0.25) / 2)


@for_each("wrong", [0.0, -0.1, 1.2, float("nan")])
def test_an_impossible_efficiency(wrong):
    with pytest.raises(ValueError, match="above 0 and not above 1"):
        efficiency(Series((0.9, wrong)))


@for_each("shares", [(0.5,), (0.5, 0.6), (1.5, -0.5)])
def test_impossible_shares(shares):
    with pytest.raises(ValueError, match="as many shares"):
        efficiency(Parallel((0.9, 0.8), shares))


def test_a_motor_pays_the_losses_and_a_brake_saves_them():
    assert driving_torque_as_motor(60.0, 20.0, 0.8) == pytest.approx(100)
    assert driving_torque_as_brake(-60.0, -20.0, 0.8) == pytest.approx(-64)
