"""Exponential and logarithm of kernels against forty digits, and at the ends of what numbers there are."""

import math

import mpmath
import numpy as np
import pytest

pytestmark = [pytest.mark.elsewhere, pytest.mark.compiled]
COUNT = 4000


@pytest.fixture(scope="module")
def of():
    """Return what calls a function, by its name, for each number of some arrays in a compiled loop."""
    from crankwork.kernel.elementary import exp, half_turns, log, log_ratio, once

    @once
    def exps(x, result):
        for at in range(x.size):
            result[at] = exp(x[at])

    @once
    def logs(x, result):
        for at in range(x.size):
            result[at] = log(x[at])

    @once
    def log_ratios(x, y, result):
        for at in range(x.size):
            result[at] = log_ratio(x[at], y[at])

    @once
    def turns(near, angle, result):
        for at in range(near.size):
            result[at] = half_turns(near[at], angle[at])

    loops = {"exp": exps, "log": logs, "log_ratio": log_ratios, "half_turns": turns}

    def called(name, *arguments):
        arguments = [np.array(one, dtype=float) for one in arguments]
        result = np.empty_like(arguments[0])
        loops[name](*arguments, result)
        return result

    return called


def apart(found, expected, least=0.0):
    with mpmath.workdps(40):
        return max(
            float(abs((mpmath.mpf(float(a)) - b) / max(abs(b), least))) for a, b in zip(found, expected, strict=True)
        )


def drawn(low, high):
    return np.random.default_rng(7).uniform(low, high, COUNT)


def exactly(function, x):
    with mpmath.workdps(40):
        return [function(mpmath.mpf(one)) for one in x.tolist()]


def test_exponentials(of):
    arrays = [drawn(-reach, reach) for reach in (1.0, 30.0, 700.0)]
    assert [apart(of("exp", x), exactly(mpmath.exp, x)) < 2.3e-16 for x in arrays] == [True] * 3


def test_logarithms(of):
    arrays = [np.exp(drawn(-reach, reach)) for reach in (0.3, 30.0, 700.0)]
    assert [apart(of("log", x), exactly(mpmath.log, x), 1e-6) < 4e-16 for x in arrays] == [True] * 3


def test_logarithms_of_quotients_keep_their_digits_where_the_quotient_is_near_one(of):
    x, y = np.exp(drawn(-9, 9)), np.exp(drawn(-9, 9)[::-1])
    near = x * (1 + drawn(-1e-4, 1e-4))
    for one, other, limit in ((x, y, 1e-15), (x, near, 4e-16)):
        with mpmath.workdps(40):
            pairs = zip(one.tolist(), other.tolist(), strict=True)
            expected = [mpmath.log(mpmath.mpf(a) / mpmath.mpf(b)) for a, b in pairs]
        assert apart(of("log_ratio", one, other), expected, 1e-12) < limit


def test_the_ends_of_what_numbers_there_are(of):
    inf, nan = math.inf, math.nan
    x = [0.0, -0.0, inf, -inf, nan, 709.78, 709.79, 800.0, 1e300, -708.5, -744.44, -746.0, -1e300]
    with np.errstate(over="ignore"):
        np.testing.assert_allclose(of("exp", x), np.exp(x), rtol=3e-16, atol=0)
    x = [0.0, -0.0, inf, -inf, nan, -1.0, -1e-310, 5e-324, 1e-310, 2.2250738585072014e-308, 1.7e308, 1.0]
    with np.errstate(divide="ignore", invalid="ignore"):
        np.testing.assert_allclose(of("log", x), np.log(x), rtol=3e-16, atol=0)
    assert np.isnan(of("log_ratio", [0.0, 1.0, inf, nan, -1.0, 1.0], [1.0, 0.0, 1.0, 1.0, 1.0, 5e-324])).all()


def test_subnormal_results_are_not_flushed(of):
    assert of("exp", [-740.0])[0] == pytest.approx(float(mpmath.exp(-740)), abs=5e-324)


def test_half_turns(of):
    angle = drawn(-1.5, 1.5)
    whole = np.random.default_rng(3).integers(-9, 9, COUNT)
    assert (of("half_turns", angle + math.pi * whole + drawn(-1.5, 1.5)[::-1], angle) == whole).all()
