"""Exponential and logarithm of kernels against forty digits, and at the ends of what numbers there are."""

import math

import mpmath
import numpy as np
import pytest

pytest.importorskip("numba")

from crankwork.kernel.elementary import compiled, exp, half_turns, log, log_ratio

pytestmark = pytest.mark.elsewhere
COUNT = 4000


@compiled
def exps(x, result):
    for at in range(x.size):
        result[at] = exp(x[at])


@compiled
def logs(x, result):
    for at in range(x.size):
        result[at] = log(x[at])


@compiled
def log_ratios(x, y, result):
    for at in range(x.size):
        result[at] = log_ratio(x[at], y[at])


@compiled
def turns(near, angle, result):
    for at in range(near.size):
        result[at] = half_turns(near[at], angle[at])


def of(function, *arguments):
    arguments = [np.array(one, dtype=float) for one in arguments]
    result = np.empty_like(arguments[0])
    function(*arguments, result)
    return result


def apart(found, expected, least=0.0):
    with mpmath.workdps(40):
        return max(
            float(abs((mpmath.mpf(float(a)) - b) / max(abs(b), least))) for a, b in zip(found, expected, strict=True)
        )


def drawn(low, high):
    return np.random.default_rng(7).uniform(low, high, COUNT)


@pytest.mark.parametrize("reach", [1.0, 30.0, 700.0])
def test_exponentials(reach):
    x = drawn(-reach, reach)
    with mpmath.workdps(40):
        expected = [mpmath.exp(mpmath.mpf(one)) for one in x.tolist()]
    assert apart(of(exps, x), expected) < 2.3e-16


@pytest.mark.parametrize("reach", [0.3, 30.0, 700.0])
def test_logarithms(reach):
    x = np.exp(drawn(-reach, reach))
    with mpmath.workdps(40):
        expected = [mpmath.log(mpmath.mpf(one)) for one in x.tolist()]
    assert apart(of(logs, x), expected, 1e-6) < 4e-16


def test_logarithms_of_quotients_keep_their_digits_where_the_quotient_is_near_one():
    x, y = np.exp(drawn(-9, 9)), np.exp(drawn(-9, 9)[::-1])
    near = x * (1 + drawn(-1e-4, 1e-4))
    for one, other, limit in ((x, y, 1e-15), (x, near, 4e-16)):
        with mpmath.workdps(40):
            pairs = zip(one.tolist(), other.tolist(), strict=True)
            expected = [mpmath.log(mpmath.mpf(a) / mpmath.mpf(b)) for a, b in pairs]
        assert apart(of(log_ratios, one, other), expected, 1e-12) < limit


def test_the_ends_of_what_numbers_there_are():
    inf, nan = math.inf, math.nan
    x = [0.0, -0.0, inf, -inf, nan, 709.78, 709.79, 800.0, 1e300, -708.5, -744.44, -746.0, -1e300]
    with np.errstate(over="ignore"):
        np.testing.assert_allclose(of(exps, x), np.exp(x), rtol=3e-16, atol=0)
    x = [0.0, -0.0, inf, -inf, nan, -1.0, -1e-310, 5e-324, 1e-310, 2.2250738585072014e-308, 1.7e308, 1.0]
    with np.errstate(divide="ignore", invalid="ignore"):
        np.testing.assert_allclose(of(logs, x), np.log(x), rtol=3e-16, atol=0)
    assert np.isnan(of(log_ratios, [0.0, 1.0, inf, nan, -1.0, 1.0], [1.0, 0.0, 1.0, 1.0, 1.0, 5e-324])).all()


def test_subnormal_results_are_not_flushed():
    assert of(exps, [-740.0])[0] == pytest.approx(float(mpmath.exp(-740)), abs=5e-324)


def test_half_turns():
    angle = drawn(-1.5, 1.5)
    whole = np.random.default_rng(3).integers(-9, 9, COUNT)
    assert (of(turns, angle + math.pi * whole + drawn(-1.5, 1.5)[::-1], angle) == whole).all()
