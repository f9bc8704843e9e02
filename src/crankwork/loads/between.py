"""The value of a curve between two of its points, remembered."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.formula.expression import Value
from crankwork.formula.known import Found, Known


class CurvePoint(NamedTuple):
    """A point of a curve: abscissa, ordinate, and slope."""

    at: Known
    value: Known
    slope: float = 0.0


def line_between(y_i: Value, y_j: Value, t: Value) -> Value:
    """Return the straight line between two ordinates, `t` of the way from one to the other."""
    return y_i + (y_j - y_i) * t


def cubic_between(ordinates: tuple[Value, Value], rises: tuple[Value, Value], t: Value) -> Value:
    """Return the cubic between two ordinates (fritsch_carlson_1980, eq. 2).

    `rises`: of the tangents at both ends over the interval; `t`: share of the way from one to the other.
    """
    (y_i, y_j), (q_i, q_j), s = ordinates, rises, 1 - t
    return y_i * (1 + 2 * t) * (s * s) + q_i * t * (s * s) + y_j * (t * t) * (1 + 2 * s) - q_j * (t * t) * s


def curve_between(key: str, by: Known, one: CurvePoint, other: CurvePoint, *, is_straight: bool = False) -> Known:
    """Return a value of a curve, of the two points that it lies between, `i` and `j`. [SI]"""
    x_i, x_j = one.at.named(f"{by.key}.i"), other.at.named(f"{by.key}.j")
    y_i, y_j = one.value.named(f"{key}.i"), other.value.named(f"{key}.j")
    t = ((by - x_i) / (x_j - x_i)).named("curve_share")
    if is_straight:
        return line_between(y_i, y_j, t).named(key)  # type: ignore[no-any-return]
    step = other.at.value - one.at.value
    q_i, q_j = (Known(Found(slope * step, "tangent")) for slope in (one.slope, other.slope))
    rises = q_i.named(f"{key}.Δi"), q_j.named(f"{key}.Δj")
    return cubic_between((y_i, y_j), rises, t).named(key)  # type: ignore[no-any-return]
