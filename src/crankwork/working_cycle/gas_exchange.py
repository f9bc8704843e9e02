"""Curves of an indicator diagram by themselves: with given end slopes, cut out, moved, and closed over the cycle.

The exchange of gas is simplified: constant pressures of exhaust and intake, with smooth monotone passages between.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from crankwork.formula.known import Known
from crankwork.kinematics.crank_grid import Array
from crankwork.loads.indicator import Segment
from crankwork.loads.monotone import hermite, hermite_slope

_SAME = 1e-9

# Crank angle [deg], pressure [Pa], slope [Pa/deg].
Knot = tuple[float, float, float]


def passage(start: Knot, end: Knot) -> Segment:
    """Return one cubic between two knots, its slopes reduced where it would overshoot them.

    Source: fritsch_carlson_1980, sec. 3; slopes of one sign, at most three times the chord.
    """
    chord = (end[1] - start[1]) / (end[0] - start[0])
    slopes = [np.sign(chord) * min(abs(one), 3 * abs(chord)) if one * chord > 0 else 0.0 for one in (start[2], end[2])]
    return Segment(
        start[0],
        end[0],
        "rounded",
        np.array([start[0], end[0]]),
        np.array([start[1], end[1]]),
        np.array(slopes),
    )


def constant_pressure(start: float, end: float, pressure: Known) -> Segment:
    """Return a segment of constant pressure.

    `start` and `end`: crank angles [deg].
    """
    return Segment(
        start, end, "constant", np.array([start, end]), np.full(2, pressure.value), np.zeros(2), operands=(pressure,)
    )


def clipped(segment: Segment, start: float, end: float) -> Segment:
    """Return the part of a segment between two crank angles; it is the same curve there.

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


def from_before_zero(dead_centres: tuple[float, float]) -> tuple[float, float]:
    """Return the dead centres with a top that lies before 0 written as a negative angle. [deg]

    Top within half a revolution of 0, bottom after it.
    """
    top, bottom = dead_centres
    top = top - 360.0 if top > 180.0 else top
    return top, bottom - 360.0 if bottom > top + 360.0 else bottom


def within_cycle(segments: Sequence[Segment], cycle: float) -> tuple[Segment, ...]:
    """Return segments of one whole cycle, begun anywhere, as segments from 0 to its end.

    The same curves, the one across the end of the cycle cut in two. `segments`: in order, together one cycle long; of
    constant pressure or rounded.
    """
    parts = []
    for segment in segments:
        turn = cycle * np.floor((segment.start + _SAME) / cycle)
        cut = turn + cycle
        if segment.end > cut + _SAME:
            parts.append(_moved(clipped(segment, segment.start, cut), -turn))
            parts.append(_moved(clipped(segment, cut, segment.end), -cut))
        elif segment.end > segment.start:
            parts.append(_moved(segment, -turn))
    parts.sort(key=lambda one: one.start)
    first, last = parts[0], parts[-1]
    parts[0] = replace(first, start=0.0, knots=np.concatenate([[0.0], first.knots[1:]]))
    parts[-1] = replace(last if len(parts) > 1 else parts[0], end=cycle)
    parts[-1] = replace(parts[-1], knots=np.concatenate([parts[-1].knots[:-1], [cycle]]))
    return tuple(parts)


def _moved(segment: Segment, by: float) -> Segment:
    return replace(segment, start=float(segment.start + by), end=float(segment.end + by), knots=segment.knots + by)
