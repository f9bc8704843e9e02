"""Interpolation between two points of a curve, as traced values."""

from __future__ import annotations

from typing import NamedTuple

from crankwork.formula.expression import Value
from crankwork.formula.traced_value import ProcedureValue, TracedValue


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
