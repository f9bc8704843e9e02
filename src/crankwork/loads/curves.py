"""Curves through points: values between two of them, monotone cubics with continuous slope, and tables of loads.

SciPy has the same monotone curve, but importing it costs more than the whole of a run; the tests compare with it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Literal, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from crankwork.formula.expression import Value
from crankwork.formula.traced_value import ProcedureValue, TracedValue, select, to_number
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import ErrorMessage

Curve = Callable[[Array], Array]


class CurvePoint(NamedTuple):
    """A point of a curve: abscissa, ordinate, and slope."""

    abscissa: TracedValue
    value: TracedValue
    slope: float = 0.0


def line_between(y_i: Value, y_j: Value, t: Value) -> Value:
    """Return the straight line between two ordinates, `t` from 0 to 1."""
    return y_i + (y_j - y_i) * t


def cubic_between(ordinates: tuple[Value, Value], rises: tuple[Value, Value], t: Value) -> Value:
    """Return the cubic between two ordinates (fritsch_carlson_1980, eq. 2).

    `rises`: of the tangents at both ends over the interval; `t`: from 0 to 1.
    """
    (y_i, y_j), (q_i, q_j), s = ordinates, rises, 1 - t
    return y_i * (1 + 2 * t) * (s * s) + q_i * t * (s * s) + y_j * (t * t) * (1 + 2 * s) - q_j * (t * t) * s


def curve_between(
    key: str, argument: TracedValue, first: CurvePoint, second: CurvePoint, *, is_straight: bool = False
) -> TracedValue:
    """Return a value of a curve between the points `i` and `j`. [SI]"""
    x_i, x_j = first.abscissa.named(f"{argument.key}.i"), second.abscissa.named(f"{argument.key}.j")
    y_i, y_j = first.value.named(f"{key}.i"), second.value.named(f"{key}.j")
    t = ((argument - x_i) / (x_j - x_i)).named("curve_share")
    if is_straight:
        return line_between(y_i, y_j, t).named(key)  # type: ignore[no-any-return]
    step = second.abscissa.value - first.abscissa.value
    q_i, q_j = (TracedValue(ProcedureValue(slope * step, "tangent")) for slope in (first.slope, second.slope))
    rises = q_i.named(f"{key}.Δi"), q_j.named(f"{key}.Δj")
    return cubic_between((y_i, y_j), rises, t).named(key)  # type: ignore[no-any-return]


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


@dataclass(frozen=True)
class LoadCurve:
    """A curve through points, which is called like a function.

    Examples
    --------
    >>> import numpy as np
    >>> LoadCurve((0.0, 0.1), (0.0, 500.0))(np.array([0.05, 0.2]))
    array([250.,   0.])
    """

    # Ascending abscissas, angles in radians or lengths in metres, and ordinates [rad or m], [N or N m]
    at: tuple[float, ...]
    values: tuple[float, ...]
    # Straight, where an abscissa given twice is a jump; a smooth curve that never overshoots the points; or one value
    # between two abscissas, with a jump at both
    interpolation: Literal["linear", "monotone", "constant"] = "linear"
    period: float = 0.0  # Period of the abscissa, 0 for none: outside the table the value is then zero [rad]
    stroke: float = 0.0  # Stroke of which the abscissas are shares, 0 if they are stated as lengths [m]

    def __post_init__(self) -> None:
        if len(self.at) != len(self.values) or len(self.at) < 2:
            raise ValueError(ErrorMessage("load_table_short", at=len(self.at), values=len(self.values)))
        if not all(math.isfinite(number) for number in (*self.at, *self.values)):
            raise ValueError(ErrorMessage("load_table_finite"))
        jumps = self.interpolation == "linear"
        if any(after < before or (after == before and not jumps) for before, after in pairwise(self.at)) or (
            self.at[0] == self.at[-1]
        ):
            raise ValueError(ErrorMessage("load_table_rises"))
        if self.period and self.at[-1] - self.at[0] > self.period * (1 + 1e-12):
            raise ValueError(ErrorMessage("load_table_period"))

    def over(self, stroke: float) -> Self:
        """Return the curve over a stroke of which its abscissas are shares. [m]"""
        return replace(self, at=tuple(share * stroke for share in self.at), stroke=stroke)

    def __call__(self, abscissas: Array) -> Array:
        """Return the values at some abscissas."""
        x, y = np.array(self.at), np.array(self.values)
        if self.period:
            abscissas = x[0] + np.mod(abscissas - x[0], self.period)
            if self.interpolation != "constant" and x[-1] - x[0] < self.period * (1 - 1e-12):
                x, y = np.append(x, x[0] + self.period), np.append(y, y[0])
        inside = (abscissas >= x[0]) & (abscissas <= x[-1])
        if self.interpolation != "monotone":
            value = np.interp(abscissas, x, y)
        else:
            value = hermite(x, y, monotone_slopes(x, y, periodic=bool(self.period)), np.clip(abscissas, x[0], x[-1]))
        return np.where(inside, value, 0.0)
