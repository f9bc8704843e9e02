"""Segments of an indicator diagram: with given end slopes, clipped, shifted, and closed over the cycle.

Gas exchange is simplified: constant pressures of exhaust and intake, with smooth monotone transitions.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from crankwork.formula.expression import Value
from crankwork.formula.traced_value import TracedValue, to_number
from crankwork.kinematics.crank_grid import Array
from crankwork.loads.curves import hermite, hermite_slope
from crankwork.loads.indicator import Segment

_ANGLE_TOLERANCE = 1e-9

# Crank angle [deg], pressure [Pa], slope [Pa/deg].
Knot = tuple[float, float, float]


def connecting_cubic(start: Knot, end: Knot) -> Segment:
    """Return one cubic between two knots, with slopes reduced where it would overshoot them.

    Source: fritsch_carlson_1980, sec. 3; slopes of one sign, at most three times the chord.
    """
    chord = (end[1] - start[1]) / (end[0] - start[0])
    limit = 3 * abs(chord)
    slopes = [np.sign(chord) * min(abs(slope), limit) if slope * chord > 0 else 0.0 for slope in (start[2], end[2])]
    ends = np.array([start[0], end[0]])
    return Segment(start[0], end[0], "rounded", ends, np.array([start[1], end[1]]), np.array(slopes))


def constant_pressure(start: float, end: float, pressure: TracedValue) -> Segment:
    """Return a segment of constant pressure.

    `start` and `end`: crank angles [deg].
    """
    return Segment(
        start, end, "constant", np.array([start, end]), np.full(2, pressure.value), np.zeros(2), operands=(pressure,)
    )


def clip_segment(segment: Segment, start: float, end: float) -> Segment:
    """Return the same curve between two crank angles.

    `start` and `end`: crank angles within it [deg].
    """
    edges = np.array([start, end])
    if segment.law != "rounded":
        return replace(segment, start=start, end=end, knots=edges)
    curve = (segment.knots, segment.pressures, segment.slopes)
    inside = (segment.knots > start) & (segment.knots < end)
    pressures, slopes = hermite(*curve, edges), hermite_slope(*curve, edges)
    return replace(
        segment,
        start=start,
        end=end,
        knots=_around(edges, segment.knots[inside]),
        pressures=_around(pressures, segment.pressures[inside]),
        slopes=_around(slopes, segment.slopes[inside]),
    )


def _around(ends: Array, inside: Array) -> Array:
    return np.concatenate([ends[:1], inside, ends[1:]])


def from_before_zero(dead_centres: tuple[Value, Value]) -> tuple[Value, Value]:
    """Return the dead centres, a top dead centre that lies before 0 as a negative angle. [deg]

    Top within half a revolution of 0, bottom after it.
    """
    top, bottom = dead_centres
    top = top - 360.0 if to_number(top) > 180.0 else top
    return top, bottom - 360.0 if to_number(bottom) > to_number(top) + 360.0 else bottom


def within_cycle(segments: Sequence[Segment], cycle: float) -> tuple[Segment, ...]:
    """Return segments of one cycle that begins anywhere as segments from 0 to its end.

    The segment across the end of the cycle is cut in two. `segments`: in order, together one cycle long; of constant
    pressure or rounded.
    """
    parts = []
    for segment in segments:
        turn = cycle * np.floor((segment.start + _ANGLE_TOLERANCE) / cycle)
        cut = turn + cycle
        if segment.end > cut + _ANGLE_TOLERANCE:
            parts.append(_moved(clip_segment(segment, segment.start, cut), -turn))
            parts.append(_moved(clip_segment(segment, cut, segment.end), -cut))
        elif segment.end > segment.start:
            parts.append(_moved(segment, -turn))
    parts.sort(key=lambda part: part.start)
    first, last = parts[0], parts[-1]
    parts[0] = replace(first, start=0.0, knots=np.concatenate([[0.0], first.knots[1:]]))
    parts[-1] = replace(last if len(parts) > 1 else parts[0], end=cycle)
    parts[-1] = replace(parts[-1], knots=np.concatenate([parts[-1].knots[:-1], [cycle]]))
    return tuple(parts)


def _moved(segment: Segment, shift: float) -> Segment:
    start, end = float(segment.start + shift), float(segment.end + shift)
    return replace(segment, start=start, end=end, knots=segment.knots + shift)
