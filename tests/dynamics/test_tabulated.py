import numpy as np
import pytest

from crankwork.dynamics.reduction import central_difference, forward_difference, spectral_derivative
from each import for_each

pytestmark = pytest.mark.elsewhere

ANGLE = np.radians(np.arange(0, 360, 10))


def derivative(angle, values, scheme):
    if scheme == "spectral":
        return spectral_derivative(angle, values)
    step, ahead = np.diff(angle, append=angle[0] + 2 * np.pi), np.roll(values, -1)
    if scheme == "forward":
        return forward_difference(ahead, values, step)
    return central_difference(ahead, np.roll(values, 1), step + np.roll(step, 1))


@for_each(("scheme", "error"), [("forward", 0.2), ("central", 0.03), ("spectral", 1e-13)])
def test_differences_approach_the_derivative(scheme, error):
    found = derivative(ANGLE, np.sin(2 * ANGLE) + 3, scheme)
    miss = np.max(np.abs(found - 2 * np.cos(2 * ANGLE)))
    assert miss < 2 * error
    assert scheme == "spectral" or miss > error / 2


def test_differences_of_unequal_steps():
    angle = np.array([0.0, 1.0, 3.0])
    values = np.array([1.0, 2.0, 6.0])
    last = 2 * np.pi - 3
    assert derivative(angle, values, "forward") == pytest.approx([1, 2, -5 / last])
    assert derivative(angle, values, "central") == pytest.approx([-4 / (last + 1), 5 / 3, -1 / (last + 2)])


def test_the_highest_even_order_has_no_slope():
    values = np.cos(np.pi * np.arange(8))
    assert spectral_derivative(np.arange(8) * np.pi / 4, values) == pytest.approx(0, abs=1e-14)


@for_each(("angle", "values"), [([0.0, 1.0, 1.0], [1, 2, 3]), ([0.0, 1.0, 7.0], [1, 2, 3]), ([0.0, 1.0], [1, 2, 3])])
def test_angles_that_do_not_make_a_revolution(angle, values):
    with pytest.raises(ValueError, match="ascend within one revolution"):
        spectral_derivative(angle, values)


def test_spectral_needs_equal_steps():
    with pytest.raises(ValueError, match="equidistant"):
        spectral_derivative([0.0, 1.0, 3.0], [1, 2, 3])
