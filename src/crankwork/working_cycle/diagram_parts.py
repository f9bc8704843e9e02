"""Pieces of an indicator diagram: parts between named points and solved segments, both closed over the cycle.

A rounded part takes its slopes from its points alone. A point next to each of its ends, at the pressure that gives the
required three-point end slope, lets it join its neighbours without a corner. Gas exchange is simplified: constant
pressures of exhaust and intake, with smooth monotone transitions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from crankwork.formula.expression import Value
from crankwork.formula.traced_value import Piecewise, TracedAngle, TracedValue, to_number
from crankwork.kinematics.crank_grid import Array
from crankwork.loads.curves import hermite, hermite_slope, monotone_slopes
from crankwork.loads.gas import polytropic_pressure
from crankwork.loads.indicator import DiagramError, IndicatorDiagram, Law, Segment, VolumeAt
from crankwork.loads.traced_diagram import column, curve_laws
from crankwork.locale import ErrorMessage

# parts that begin nearer to another angle begin there; segments are cut more closely [deg]
_ANGLE_TOLERANCE, _SEGMENT_TOLERANCE = 1e-6, 1e-9

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
        turn = cycle * np.floor((segment.start + _SEGMENT_TOLERANCE) / cycle)
        cut = turn + cycle
        if segment.end > cut + _SEGMENT_TOLERANCE:
            parts.append(_moved_segment(clip_segment(segment, segment.start, cut), -turn))
            parts.append(_moved_segment(clip_segment(segment, cut, segment.end), -cut))
        elif segment.end > segment.start:
            parts.append(_moved_segment(segment, -turn))
    parts.sort(key=lambda part: part.start)
    first, last = parts[0], parts[-1]
    parts[0] = replace(first, start=0.0, knots=np.concatenate([[0.0], first.knots[1:]]))
    parts[-1] = replace(last if len(parts) > 1 else parts[0], end=cycle)
    parts[-1] = replace(parts[-1], knots=np.concatenate([parts[-1].knots[:-1], [cycle]]))
    return tuple(parts)


def _moved_segment(segment: Segment, shift: float) -> Segment:
    start, end = float(segment.start + shift), float(segment.end + shift)
    return replace(segment, start=start, end=end, knots=segment.knots + shift)


# prefix of the names of points that only shape a curve
AUXILIARY = "~"
_OFFSET = 0.2
# of a stated pressure, what a polytrope that ends there may miss it by
_CLOSING = 1e-3
# parts that end nearer than this to where the next begins leave no gap [deg]
_GAP = 1e-5


class NamedPoint(NamedTuple):
    """A point by name: crank angle [deg], pressure [Pa]."""

    name: str
    angle: Value
    pressure: Value


@dataclass(frozen=True)
class DiagramPart:
    """A piece through points; a curve has slopes at its ends [Pa/deg], a polytrope an exponent and a reference."""

    law: Law
    points: tuple[NamedPoint, ...]
    slopes: tuple[Value, Value] = (0.0, 0.0)
    exponent: Value | None = None
    reference: str = ""


def diagram_of_parts(
    parts: Sequence[DiagramPart], cycle: float, volume_at: VolumeAt, states: Mapping[str, tuple[float, float]]
) -> IndicatorDiagram:
    """Return the diagram of parts in order of the crank angle, beginning anywhere; those without length are left out.

    `states`: pressure and volume of the states that polytropes pass through. A pressure stated at the end of a
    polytrope that is not the computed one is a jump.
    """
    segments, named, jumps = list[Segment](), dict[str, tuple[float, float]](), list[tuple[str, float, float]]()
    end = 0.0
    for number, part in enumerate(inside_cycle(parts, cycle), start=1):
        knots = _shaped(part) if part.law == "rounded" else part.points
        degrees, pressures = (np.array([knot[index] for knot in knots], dtype=float) for index in (1, 2))
        if abs(degrees[0] - end) > _GAP:
            name = "piece_gap" if degrees[0] > end else "piece_overlap"
            raise DiagramError(f"gas.pieces[{number}]", ErrorMessage(name, start=float(degrees[0]), end=end))
        end, state = float(degrees[-1]), (0.0, 0.0, 0.0)
        named |= {name: (float(angle), pressure) for name, angle, pressure in knots if not name.startswith(AUXILIARY)}
        if part.law == "polytropic":
            state = (*states[part.reference], float(to_number(part.exponent)))
            stated, pressures = pressures, np.asarray(polytropic_pressure(*state[:2], volume_at(degrees), state[2]))
            missed, name = float(stated[-1] - pressures[-1]), knots[-1].name
            if name in named and abs(missed) > _CLOSING * max(abs(stated[-1]), abs(pressures[-1])):
                jumps.append((name, end, missed))
        slopes = monotone_slopes(degrees, pressures) if part.law == "rounded" else np.zeros_like(degrees)
        origin = knots[0].name if part.law == "constant" else part.reference
        segments.append(Segment(float(degrees[0]), end, part.law, degrees, pressures, slopes, state, origin))
    return IndicatorDiagram(tuple(segments), named, tuple(jumps))


def inside_cycle(parts: Sequence[DiagramPart], cycle: float) -> list[DiagramPart]:
    """Return the parts with a length, from 0 to the end of the cycle."""
    inside = [piece for part in parts for piece in _within(part, cycle)]
    return sorted(inside, key=lambda part: to_number(part.points[0].angle))


def traced_pressure_of_parts(
    parts: Sequence[DiagramPart],
    cycle: float,
    volume: TracedValue,
    references: Mapping[str, tuple[TracedValue, TracedValue]],
) -> TracedValue:
    """Return the pressure of traced parts as a piecewise column; each cubic between two knots is a piece. [Pa]

    `references`: pressure and volume of the states that polytropes pass through.
    """
    degrees, ends, laws = TracedAngle().degrees, list[Value](), list[TracedValue]()
    for part in inside_cycle(parts, cycle):
        if part.law == "rounded":
            knots = _shaped(part)
            for end, law in curve_laws([knot.angle for knot in knots], [knot.pressure for knot in knots], degrees):
                ends.append(end)
                laws.append(law)
            continue
        ends.append(part.points[-1].angle)
        laws.append(
            part.points[0].pressure
            if part.law == "constant"
            else polytropic_pressure(*references[part.reference], volume, part.exponent)
        )
    return TracedValue(Piecewise([*ends[:-1], cycle], tuple(laws)), "diagram_pressure")


def _within(part: DiagramPart, cycle: float) -> list[DiagramPart]:
    """Return a part shifted into the cycle, in two if it crosses its end."""
    start, end = to_number(part.points[0].angle), to_number(part.points[-1].angle)
    if end - start < _ANGLE_TOLERANCE:
        return []
    turn = cycle * float(np.floor((start + _ANGLE_TOLERANCE) / cycle))
    if end <= turn + cycle + _ANGLE_TOLERANCE:
        return [_moved(part, -turn, cycle)]
    before, after = _halves(part, turn + cycle)
    return [_moved(before, -turn, cycle), _moved(after, -turn - cycle, cycle)]


def _moved(part: DiagramPart, shift: float, cycle: float) -> DiagramPart:
    """Return a part shifted along the crank angle, with the ends of the cycle hit exactly."""
    moved = [point._replace(angle=point.angle + shift) for point in part.points]
    snapped = [
        point._replace(angle=edge) if abs(to_number(point.angle) - edge) < _ANGLE_TOLERANCE else point
        for point in moved
        for edge in [0.0 if to_number(point.angle) < cycle / 2 else cycle]
    ]
    return DiagramPart(part.law, tuple(snapped), part.slopes, part.exponent, part.reference)


def _halves(part: DiagramPart, cut: float) -> tuple[DiagramPart, DiagramPart]:
    """Return the parts before and after a crank angle; the curve stays the same."""
    before = tuple(point for point in part.points if to_number(point.angle) < cut - _ANGLE_TOLERANCE)
    after = tuple(point for point in part.points if to_number(point.angle) > cut + _ANGLE_TOLERANCE)
    at_cut = [point for point in part.points if abs(to_number(point.angle) - cut) <= _ANGLE_TOLERANCE]
    slope: Value = 0.0
    if part.law == "rounded":
        knots = _shaped(part)
        x, y = column([knot.angle for knot in knots]), column([knot.pressure for knot in knots])
        curve, where = (x, y, monotone_slopes(x, y)), np.array([cut])
        pressure, slope = hermite(*curve, where)[0], hermite_slope(*curve, where)[0]
    else:
        pressure = part.points[0].pressure
    middle = at_cut[0] if at_cut else NamedPoint(f"{AUXILIARY}0", cut, pressure)
    first = DiagramPart(part.law, (*before, middle), (part.slopes[0], slope), part.exponent, part.reference)
    second = DiagramPart(part.law, (middle, *after), (slope, part.slopes[1]), part.exponent, part.reference)
    return first, second


def _shaped(part: DiagramPart) -> tuple[NamedPoint, ...]:
    """Return the points of a curve with one more next to each end, which give it its end slopes."""
    points = part.points
    if len(points) == 2:
        return _shaped_alone(points[0], points[1], part.slopes)
    start = _slope_point(points[0], points[1], part.slopes[0])
    end = _slope_point(points[-1], points[-2], part.slopes[1])
    return (points[0], start, *points[1:-1], end, points[-1])


def _slope_point(end: NamedPoint, inner: NamedPoint, slope: Value) -> NamedPoint:
    """Return the point next to an end for which (2h0 + h1) d0 - h0 d1 = (h0 + h1) slope, with d1 the next chord."""
    span = inner.angle - end.angle
    near, far = _OFFSET * span, (1 - _OFFSET) * span
    rise = inner.pressure - end.pressure
    chord = (slope * span + near * rise / far) / (2 * near + far + near * near / far)
    return NamedPoint(f"{AUXILIARY}{end.name}{inner.name}", end.angle + near, end.pressure + near * chord)


def _shaped_alone(start: NamedPoint, end: NamedPoint, slopes: tuple[Value, Value]) -> tuple[NamedPoint, ...]:
    """Return two points with one more next to each, for both end slopes at once."""
    span, rise = end.angle - start.angle, end.pressure - start.pressure
    near, far = _OFFSET, 1 - 2 * _OFFSET
    # slopes of chords times the span: near (first + last) + far middle = rise, (2 near + far) first - near
    # middle = (near + far) slope at the start, and so at the end
    at_start, at_end = (slope * (near + far) * span / (2 * near + far) for slope in slopes)
    spread = near / (2 * near + far)
    middle = (rise - near * (at_start + at_end)) / (far + 2 * near * spread)
    first, last = at_start + spread * middle, at_end + spread * middle
    return (
        start,
        NamedPoint(f"{AUXILIARY}{start.name}{end.name}", start.angle + near * span, start.pressure + near * first),
        NamedPoint(f"{AUXILIARY}{end.name}{start.name}", end.angle - near * span, end.pressure - near * last),
        end,
    )
