"""Monotone cubic curves with continuous slope through given points.

SciPy has the same curve, but importing it costs more than the whole of a run; it is the reference of the tests.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from crankwork.formula.traced_value import select, to_number
from crankwork.kinematics.crank_grid import Array
from crankwork.loads.interpolation import cubic_between


def monotone_slopes(x: Array, y: Array, *, periodic: bool = False) -> Array:
    """Return slopes at the points such that the cubic Hermite curve never overshoots them. [Pa/deg]

    Zero at local extremes. `x` and `y`: ascending abscissas and ordinates, numbers or traced [deg], [Pa]; `periodic`:
    the last point repeats the first, and both have one slope.
    Source: fritsch_butland_1984, weighted harmonic mean; three-point end slopes.
    """
    if periodic:
        x = np.concatenate([[x[0] - (x[-1] - x[-2])], x, [x[-1] + x[1] - x[0]]])
        y = np.concatenate([[y[-2]], y, [y[1]]])
        return monotone_slopes(x, y)[1:-1]
    h, delta = np.diff(x), np.diff(y) / np.diff(x)
    if len(x) == 2:
        return np.repeat(delta, 2)
    before, after = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    product = delta[:-1] * delta[1:]
    left, right = select(product, delta[:-1], 1.0), select(product, delta[1:], 1.0)
    inner = select(product, (before + after) / (before / left + after / right), 0.0)
    slopes = np.empty(len(x), dtype=delta.dtype)
    slopes[0], slopes[-1] = _end_slope(h[0], h[1], *delta[:2]), _end_slope(h[-1], h[-2], *delta[:-3:-1])
    slopes[1:-1] = inner
    return slopes


def _end_slope(near: Any, far: Any, delta_near: Any, delta_far: Any) -> Any:  # noqa: ANN401 - numbers or traced values
    slope, steepest = ((2 * near + far) * delta_near - near * delta_far) / (near + far), 3 * delta_near
    turning = select((slope - steepest) * delta_near, steepest, slope)
    return select(slope * delta_near, select(delta_near * delta_far, slope, turning), 0.0)


def hermite(x: Array, y: Array, slopes: Array, abscissas: Array) -> Array:
    """Return the piecewise cubic with given ordinates and slopes (fritsch_carlson_1980, eq. 2). [Pa]

    `abscissas`: between the first and the last point [deg]; the others: points and slopes [deg], [Pa], [Pa/deg].
    """
    i = _interval(x, abscissas)
    h = x[i + 1] - x[i]
    return cubic_between((y[i], y[i + 1]), (slopes[i] * h, slopes[i + 1] * h), (abscissas - x[i]) / h)  # type: ignore[no-any-return]


def hermite_slope(x: Array, y: Array, slopes: Array, abscissas: Array) -> Array:
    """Return the derivative of `hermite`. [Pa/deg]"""
    i = _interval(x, abscissas)
    h = x[i + 1] - x[i]
    t = (abscissas - x[i]) / h
    rise = (y[i + 1] - y[i]) / h
    return np.asarray(6 * t * (1 - t) * rise + slopes[i] * (1 - t) * (1 - 3 * t) + slopes[i + 1] * t * (3 * t - 2))


def _interval(x: Array, abscissas: Array) -> NDArray[np.intp]:
    numbers = np.array([to_number(value) for value in x], dtype=float) if x.dtype == object else x
    return np.asarray(np.clip(np.searchsorted(numbers, abscissas, side="right") - 1, 0, len(x) - 2))
