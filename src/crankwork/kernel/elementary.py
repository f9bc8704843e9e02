"""Exponential and logarithm that a compiler turns into operations on several designs at once.

Written for Numba: no table, no branch, exact to about one unit in the last place, with the results of the C library at
zero, infinity and beyond. `contract` allows fused multiply-add and nothing else: other options would undo the order of
operations, which is deliberate.
"""

from __future__ import annotations

import math
from typing import Any

import numba
import numpy as np
from llvmlite import binding
from numba import njit

_config: Any = numba.config
_features = binding.get_host_cpu_features()
if not _config.CPU_NAME and _features.get("avx512f"):
    # the widest registers: LLVM uses half of them by default
    _config.CPU_NAME, _config.CPU_FEATURES = binding.get_host_cpu_name(), f"{_features.flatten()},-prefer-256-bit"

# options that its stubs lack; without wrappers, which take a tenth of the time to compile
_numba: Any = njit
_OPTIONS = {"fastmath": {"contract"}, "error_model": "numpy", "nogil": True, "no_cfunc_wrapper": True}
once = _numba(**_OPTIONS)
# inlined and called only by compiled code: of two calls that are merged, one may be rounded differently
inside = _numba(no_cpython_wrapper=True, forceinline=True, **_OPTIONS)


def _kept(**more: bool) -> Any:  # noqa: ANN401
    """Return a decorator that compiles a function, with a cache if this machine has a folder for it."""

    def compiling(function: Any) -> Any:  # noqa: ANN401
        try:
            return _numba(cache=True, **more, **_OPTIONS)(function)
        except RuntimeError:
            return _numba(**more, **_OPTIONS)(function)

    return compiling


compiled = _kept()
# inlined
_within = _kept(forceinline=True)
# ln 2 in two parts, the first with zeros at its end, so that integer multiples of it are exact
_LN2, _LN2_REST = float.fromhex("0x1.62e42fefa3800p-1"), float.fromhex("0x1.ef35793c76730p-45")
_PER_LN2 = 1 / math.log(2)
# adding and subtracting this rounds a number to an integer
_ROUNDS = 1.5 * 2.0**52
# beyond these the result is infinity, or 0
_LARGEST, _LEAST = 709.782712893384, -745.1332191019412
# polynomials through the nodes of Chebyshev, off by less than 2e-17 of the function: (e^r - 1 - r) / r^2 for |r| up to
# ln 2 / 2, and (2 artanh s - 2 s) / s^3 by s^2 for |s| up to 0.2
_E = (
    0.5000000000000001, 0.16666666666666669, 0.04166666666662413, 0.008333333333330062, 0.0013888888917213717,
    0.00019841269863053618, 2.4801521295954376e-05, 2.7557268459997064e-06, 2.7620088445409746e-07,
    2.510038549551032e-08,
)  # fmt: skip
_L = (
    0.6666666666666666, 0.4000000000001106, 0.2857142856590786, 0.2222222327069289, 0.18181720592633382,
    0.15389532133201755, 0.13196949543228448, 0.1370473041022565,
)  # fmt: skip
_SQRT_HALF = np.float64(math.sqrt(0.5)).view(np.int64).item()
_HALF = 1 << 51
_TINY, _SCALED = 2.0**-1022, 2.0**54


@_within
def exp(x):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201 - Numba finds the types
    """Return e to the power of a number (muller_2016, ch. 5)."""
    y = min(max(x, _LEAST - 1.0), _LARGEST + 1.0)
    n = y * _PER_LN2 + _ROUNDS - _ROUNDS
    r = y - n * _LN2 - n * _LN2_REST
    # in pairs of pairs, so that independent operations overlap
    r_2 = r * r
    r_4 = r_2 * r_2
    low = (_E[0] + _E[1] * r) + (_E[2] + _E[3] * r) * r_2
    high = (_E[4] + _E[5] * r) + (_E[6] + _E[7] * r) * r_2
    p = 1.0 + (r + r_2 * (low + r_4 * (high + r_4 * (_E[8] + _E[9] * r))))
    # a power of two as two factors, both of which are representable
    integer = np.int64(n)
    half = integer >> 1
    first = np.int64((half + 1023) << 52).view(np.float64)
    second = np.int64((integer - half + 1023) << 52).view(np.float64)
    return x if math.isnan(x) else p * first * second


@_within
def _sum(n, difference, total):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202
    """Return n ln 2 and the logarithm of a number near 1: the quotient of its difference from 1 and its sum with it."""
    s = difference / total
    z = s * s
    z_2 = z * z
    z_4 = z_2 * z_2
    low = (_L[0] + _L[1] * z) + (_L[2] + _L[3] * z) * z_2
    high = (_L[4] + _L[5] * z) + (_L[6] + _L[7] * z) * z_2
    p = low + z_4 * high
    return n * _LN2 + (2 * s + (s * z * p + n * _LN2_REST))


@_within
def log(x):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Return the natural logarithm of a number (muller_2016, ch. 5)."""
    is_tiny = x < _TINY
    bits = np.float64(x * _SCALED if is_tiny else x).view(np.int64)
    exponent = (bits - _SQRT_HALF) >> 52
    m = np.int64(bits - (exponent << 52)).view(np.float64)
    n = np.float64(exponent) - (54.0 if is_tiny else 0.0)
    result = _sum(n, m - 1.0, m + 1.0)
    result = result if x > 0.0 else (-math.inf if x == 0.0 else math.nan)
    return result if x < math.inf else x


@_within
def log_ratio(x, y):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Return the natural logarithm of a quotient of normal numbers above zero, without dividing twice."""
    difference = np.float64(x).view(np.int64) - np.float64(y).view(np.int64)
    exponent = (difference + _HALF) >> 52
    near = np.int64(np.float64(x).view(np.int64) - (exponent << 52)).view(np.float64)
    result = _sum(np.float64(exponent), near - y, near + y)
    is_normal = (x >= _TINY) & (y >= _TINY) & (x < math.inf) & (y < math.inf)
    return result if is_normal else math.nan


@_within
def half_turns(near, angle):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201
    """Return the number of half turns between an angle and another, rounded. [rad]"""
    return (near - angle) / math.pi + _ROUNDS - _ROUNDS
