"""Motion laws: the coordinate of a driver over one period of time, and its two rates.

A segment moves the coordinate from one value to another. Its normalised law gives the share of the travel by the share
of the time: a polynomial, or a straight line less a sine, piece by piece. The period is one turn of 360 degrees of the
angle that all columns depend on.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from crankwork.errors import CrankworkError
from crankwork.formula.expression import Value, formula
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import Piecewise, Tabulated, TracedValue, absent, given
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.kinematic_coefficients import Transfer
from crankwork.locale import ErrorMessage
from crankwork.mechanism.driver import Law, LawKind, MotionLaw, Segment

_REST_TOLERANCE = 1e-9
_LAWS = "norton_2012, ch. 8"


@formula("way_share", _LAWS)
def polynomial_law(  # noqa: PLR0913 - the coefficients of a polynomial
    z: Value, c_0: Value, c_1: Value, c_2: Value, c_3: Value, c_4: Value, c_5: Value, c_6: Value, c_7: Value
) -> Value:
    """Share of the way by a polynomial of the share of the time."""
    return c_0 + c_1 * z + c_2 * z**2 + c_3 * z**3 + c_4 * z**4 + c_5 * z**5 + c_6 * z**6 + c_7 * z**7


@formula("way_share_1", _LAWS)
def polynomial_law_1(  # noqa: PLR0913 - the coefficients of a polynomial
    z: Value, c_1: Value, c_2: Value, c_3: Value, c_4: Value, c_5: Value, c_6: Value, c_7: Value
) -> Value:
    """Normalised velocity of a polynomial law."""
    return c_1 + 2 * c_2 * z + 3 * c_3 * z**2 + 4 * c_4 * z**3 + 5 * c_5 * z**4 + 6 * c_6 * z**5 + 7 * c_7 * z**6


@formula("way_share_2", _LAWS)
def polynomial_law_2(  # noqa: PLR0913 - the coefficients of a polynomial
    z: Value, c_2: Value, c_3: Value, c_4: Value, c_5: Value, c_6: Value, c_7: Value
) -> Value:
    """Normalised acceleration of a polynomial law."""
    return 2 * c_2 + 6 * c_3 * z + 12 * c_4 * z**2 + 20 * c_5 * z**3 + 30 * c_6 * z**4 + 42 * c_7 * z**5


@formula("way_share_3", _LAWS)
def polynomial_law_3(z: Value, c_3: Value, c_4: Value, c_5: Value, c_6: Value, c_7: Value) -> Value:
    """Normalised jerk of a polynomial law."""
    return 6 * c_3 + 24 * c_4 * z + 60 * c_5 * z**2 + 120 * c_6 * z**3 + 210 * c_7 * z**4


@formula("way_share_3", _LAWS)
def sine_law_3(A_s: Value, k_s: Value, z: Value, d_s: Value) -> Value:
    """Normalised jerk of a law with a sine."""
    return A_s * k_s * np.cos(k_s * z + d_s)


@formula("driver_jerk", _LAWS)
def law_jerk(h_q: Value, f_z3: Value, T_s: Value) -> Value:
    """Third rate of the coordinate of a driver."""
    return h_q * f_z3 / T_s**3


@formula("way_share", _LAWS)
def sine_law(c_0: Value, c_1: Value, z: Value, A_s: Value, k_s: Value, d_s: Value) -> Value:
    """Share of the way by a straight line less a sine."""
    return c_0 + c_1 * z - A_s / k_s**2 * np.sin(k_s * z + d_s)


@formula("way_share_1", _LAWS)
def sine_law_1(c_1: Value, A_s: Value, k_s: Value, z: Value, d_s: Value) -> Value:
    """Normalised velocity of a law with a sine."""
    return c_1 - A_s / k_s * np.cos(k_s * z + d_s)


@formula("way_share_2", _LAWS)
def sine_law_2(A_s: Value, k_s: Value, z: Value, d_s: Value) -> Value:
    """Normalised acceleration of a law with a sine."""
    return A_s * np.sin(k_s * z + d_s)


@formula("driver_displacement", _LAWS)
def law_displacement(q_a: Value, h_q: Value, f_z: Value) -> Value:
    """Coordinate of a driver on its way from one value to another."""
    return q_a + h_q * f_z


@formula("driver_velocity", _LAWS)
def law_velocity(h_q: Value, f_z1: Value, T_s: Value) -> Value:
    """Rate of the coordinate of a driver."""
    return h_q * f_z1 / T_s


@formula("driver_acceleration", _LAWS)
def law_acceleration(h_q: Value, f_z2: Value, T_s: Value) -> Value:
    """Second rate of the coordinate of a driver."""
    return h_q * f_z2 / T_s**2


class LawPiece(NamedTuple):
    """A normalised law up to a share of the time: a polynomial, less a sine if it has an amplitude."""

    end: float
    coefficients: tuple[float, ...]
    amplitude: float = 0.0
    frequency: float = 0.0
    phase: float = 0.0


class _Pushed(NamedTuple):
    """An acceleration up to a share of the time: constant, or the amplitude of a sine."""

    end: float
    acceleration: float
    frequency: float = 0.0
    phase: float = 0.0


def _from_accelerations(pushed: Sequence[_Pushed]) -> tuple[LawPiece, ...]:
    """Return the law from rest to rest with given accelerations, scaled to a travel of one."""
    start, place, rate = 0.0, 0.0, 0.0
    pieces = []
    for push in pushed:
        if push.frequency:
            k, a = push.frequency, push.acceleration
            slope = rate + a / k * math.cos(k * start + push.phase)
            constant = place - slope * start + a / k**2 * math.sin(k * start + push.phase)
            pieces.append(LawPiece(push.end, (constant, slope), a, k, push.phase))
            place = constant + slope * push.end - a / k**2 * math.sin(k * push.end + push.phase)
            rate = slope - a / k * math.cos(k * push.end + push.phase)
        else:
            a = push.acceleration
            coefficients = (place - rate * start + a / 2 * start**2, rate - a * start, a / 2)
            pieces.append(LawPiece(push.end, coefficients))
            step = push.end - start
            place, rate = place + rate * step + a / 2 * step**2, rate + a * step
        start = push.end
    return tuple(
        piece._replace(coefficients=tuple(c / place for c in piece.coefficients), amplitude=piece.amplitude / place)
        for piece in pieces
    )


_TURN = 2 * math.pi
_POLYNOMIALS: Mapping[LawKind, tuple[float, ...]] = MappingProxyType({
    "constant": (0.0, 1.0),
    "cubic": (0.0, 0.0, 3.0, -2.0),
    "3-4-5": (0.0, 0.0, 0.0, 10.0, -15.0, 6.0),
    "4-5-6-7": (0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0),
})  # fmt: skip
_ACCELERATIONS: Mapping[LawKind, tuple[_Pushed, ...]] = MappingProxyType({
    "parabolic": (_Pushed(0.5, 1.0), _Pushed(1.0, -1.0)),
    "harmonic": (_Pushed(1.0, 1.0, math.pi, math.pi / 2),),
    "cycloidal": (_Pushed(1.0, 1.0, _TURN),),
    "modified-sine": (
        _Pushed(1 / 8, 1.0, 2 * _TURN), _Pushed(7 / 8, 1.0, 2 * _TURN / 3, math.pi / 3), _Pushed(1.0, 1.0, 2 * _TURN),
    ),
    "modified-trapezoidal": (
        _Pushed(1 / 8, 1.0, 2 * _TURN), _Pushed(3 / 8, 1.0), _Pushed(5 / 8, 1.0, 2 * _TURN, -math.pi),
        _Pushed(7 / 8, -1.0), _Pushed(1.0, 1.0, 2 * _TURN),
    ),
})  # fmt: skip


@cache
def shape(kind: LawKind, ramp: float = 1 / 3) -> tuple[LawPiece, ...]:
    """Return a normalised law of a segment that rises or returns, piece after piece (norton_2012, ch. 8).

    The names are those of VDI 2143. A trapezoidal law has a trapezoid of velocity; `ramp` is the part of the time in
    which it rises, and in which it falls.
    """
    if kind in _POLYNOMIALS:
        return (LawPiece(1.0, _POLYNOMIALS[kind]),)
    if kind == "trapezoidal":
        return _from_accelerations((_Pushed(ramp, 1.0), _Pushed(1 - ramp, 0.0), _Pushed(1.0, -1.0)))
    return _from_accelerations(_ACCELERATIONS[kind])


def smooth_shape(
    shares: Sequence[float],
    ways: Sequence[float],
    *,
    is_closed: bool,
    rates: tuple[float | None, float | None] = (0.0, 0.0),
) -> tuple[LawPiece, ...]:
    """Return the cubic spline through some points as a normalised law.

    `shares`: from 0 to 1, ascending; `ways`: of any scale; `rates`: at both ends, None where the first or last two
    intervals have one polynomial (not-a-knot). A closed spline is periodic instead.
    """
    z, y = np.array(shares, dtype=float), np.array(ways, dtype=float)
    count, step = z.size, np.diff(z)
    slopes = np.diff(y) / step
    matrix, right = np.zeros((count, count)), np.zeros(count)
    for k in range(1, count - 1):
        matrix[k, k - 1 : k + 2] = 1 / step[k - 1], 2 / step[k - 1] + 2 / step[k], 1 / step[k]
        right[k] = 3 * (slopes[k - 1] / step[k - 1] + slopes[k] / step[k])
    for end, given_rate in ((0, rates[0]), (-1, rates[1])):
        _end_row(matrix, right, end, given_rate, (step[::-1], slopes[::-1]) if end else (step, slopes))
    if is_closed:
        # equal rates and equal accelerations at both ends
        matrix[-1, 0], right[-1] = -1.0, 0.0
        matrix[0] = 0.0
        matrix[0, :2] += 2 / step[0], 1 / step[0]
        matrix[0, -2:] += 1 / step[-1], 2 / step[-1]
        right[0] = 3 * (slopes[0] / step[0] + slopes[-1] / step[-1])
    rate = np.linalg.solve(matrix, right)
    pieces = []
    for k in range(count - 1):
        h, bend = step[k], (3 * slopes[k] - 2 * rate[k] - rate[k + 1]) / step[k]
        local = np.polynomial.Polynomial([y[k], rate[k], bend, (rate[k] + rate[k + 1] - 2 * slopes[k]) / h**2])
        shifted = local(np.polynomial.Polynomial([-z[k], 1.0]))
        pieces.append(LawPiece(float(z[k + 1]), tuple(shifted.coef.tolist())))
    return tuple(pieces)


def _end_row(matrix: Array, right: Array, end: int, rate: float | None, inwards: tuple[Array, Array]) -> None:
    """Set the equation of the rate at an end of a spline; steps and slopes `inwards` from there."""
    next_to = -2 if end else 1
    matrix[end, end] = 1.0
    if rate is not None:
        right[end] = rate
        return
    (first, *more), (slope, *next_slopes) = inwards
    if len(more) < 2:
        # three points have one parabola, two a straight line
        matrix[end, next_to], right[end] = (1.0, 2 * slope) if more else (0.0, slope)
        return
    span = first + more[0]
    matrix[end, next_to] = span / more[0]
    right[end] = ((first + 2 * span) * more[0] * slope + first**2 * next_slopes[0]) / (span * more[0])


# share of a segment by which its rates are taken inside its ends, and their difference that is no jump, of the largest
_INSIDE, _SAME_RATE = 1e-8, 1e-5
_TRIED, _HALVINGS = np.linspace(0.0, 1.0, 2001), 52
# largest difference of a rate from the difference quotient, relative to the largest rate
_RATE_TOLERANCE = 1e-3


class _Own:
    """A law of the user, checked when it is made."""

    def __init__(self, law: MotionLaw) -> None:
        self.law, self.breaks = law, tuple(law.breaks)
        tried = np.array(law.ways(_TRIED), dtype=float)
        name = type(law).__name__
        if tried.shape != (3, _TRIED.size) or not np.all(np.isfinite(tried)):
            raise CrankworkError(ErrorMessage("own_law_values", name=name))
        if abs(tried[0, 0]) > _REST_TOLERANCE or abs(tried[0, -1] - 1.0) > _REST_TOLERANCE:
            raise CrankworkError(ErrorMessage("own_law_ends", name=name, start=tried[0, 0], end=tried[0, -1]))
        if not all(0.0 < share < 1.0 for share in self.breaks) or list(self.breaks) != sorted(set(self.breaks)):
            raise CrankworkError(ErrorMessage("own_law_breaks", name=name))
        step = _TRIED[1]
        smooth = np.all(np.abs(_TRIED[1:-1, None] - np.array(self.breaks)) > step, axis=1)
        for order, (values, rate) in enumerate(itertools.pairwise(tried), start=1):
            error = np.abs((values[2:] - values[:-2]) / (2 * step) - rate[1:-1])[smooth]
            if np.max(error) > _RATE_TOLERANCE * max(1.0, np.max(np.abs(rate))):
                raise CrankworkError(ErrorMessage("own_law_rates", name=name, order=order))

    def pieces(self, z: TracedValue) -> Iterator[tuple[float, tuple[TracedValue, TracedValue, TracedValue]]]:
        """Yield the intervals between breaks: end, share of the travel, normalised velocity and acceleration."""
        for begin, end in itertools.pairwise((0.0, *self.breaks, 1.0)):
            share, rate, second = (
                TracedValue(Tabulated(_Part(self.law, order, begin, end), "own_law", argument=z), key)
                for order, key in enumerate(("way_share", "way_share_1", "way_share_2"))
            )
            yield end, (share, rate, second)

    def passed(self) -> Array:
        """Return the least and the greatest share of the travel at samples, and the shares at reversals."""
        ways, rates, _ = self.law.ways(_TRIED)
        signs = np.sign(rates)
        before = np.flatnonzero(signs[:-1] * signs[1:] < 0)
        low, high = _TRIED[before], _TRIED[before + 1]
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            is_low = np.sign(self.law.ways(middle)[1]) == signs[before]
            low, high = np.where(is_low, middle, low), np.where(is_low, high, middle)
        return np.array([np.min(ways), np.max(ways), *self.law.ways(low)[0]])


@dataclass(frozen=True)
class _Part:
    """One of the three outputs of a law of the user, in one interval between breaks."""

    law: MotionLaw
    order: int
    begin: float
    end: float

    def __call__(self, share: Array) -> Array:
        inside = np.clip(share, np.nextafter(self.begin, 1.0), np.nextafter(self.end, 0.0))
        return np.asarray(self.law.ways(inside)[self.order], dtype=float)


# keys of coordinate, rates and travel of a driver on a line, and of one that turns
_KEYS = {
    False: (("driver_displacement", "driver_velocity", "driver_acceleration"), "driver_way"),
    True: (("driver_angle", "driver_speed", "driver_angular_acceleration"), "driver_turn"),
}


class _PlacedSegment(NamedTuple):
    """A segment in the period: start and end [deg], initial value, travel, and pieces or law."""

    start: float
    end: float
    origin: float
    travel: float
    pieces: tuple[LawPiece, ...] | _Own


def _placed_segments(law: Law) -> Iterator[_PlacedSegment]:
    shares = np.cumsum([0.0, *(section.share for section in law.segments)])
    edges, origin = (360.0 * (shares / shares[-1])).tolist(), law.start
    for segment, (start, end) in zip(law.segments, itertools.pairwise(edges), strict=True):
        duration = law.period * (end - start) / 360.0
        travel, pieces = _shape_of(segment, origin, duration, is_alone=len(law.segments) == 1)
        yield _PlacedSegment(start, end, origin, travel, pieces)
        origin = segment.to


def _shape_of(
    segment: Segment, origin: float, duration: float, *, is_alone: bool
) -> tuple[float, tuple[LawPiece, ...] | _Own]:
    """Return the travel of a segment and its normalised law; a dwell has neither."""
    if not isinstance(segment.kind, str):
        return segment.to - origin, _Own(segment.kind)
    if segment.kind == "table":
        shares = (0.0, *(share for share, _ in segment.points), 1.0)
        places = (origin, *(place for _, place in segment.points), segment.to)
        travel = max(places) - min(places) or 1.0
        ways = [(place - origin) / travel for place in places]
        first, last = (None if rate is None else rate * duration / travel for rate in segment.rates)
        is_closed = is_alone and segment.to == origin and segment.rates == (0.0, 0.0)
        return travel, smooth_shape(shares, ways, is_closed=is_closed, rates=(first, last))
    if segment.kind == "constant-acceleration":
        distance, first = segment.to - origin, (segment.rates[0] or 0.0) * duration
        travel = max(abs(distance), abs(first)) or 1.0
        return travel, (LawPiece(1.0, (0.0, first / travel, (distance - first) / travel)),)
    if segment.kind == "dwell" or segment.to == origin:
        return 0.0, ()
    return segment.to - origin, shape(segment.kind, segment.ramp)


@dataclass(frozen=True)
class Clock:
    """Time by the angle of a period. [s]"""

    period: float

    def __call__(self, degrees: Array) -> Array:
        """Return the time at angles of the period. [deg]"""
        return degrees * (self.period / 360.0)


def clock(law: Law) -> TracedValue:
    """Return the traced time over the angle of one period. [s]"""
    return TracedValue(Tabulated(Clock(law.period), "clock"), "time")


def _timed(
    law: Law, time: TracedValue, segment: _PlacedSegment, number: int, way_key: str
) -> tuple[TracedValue, TracedValue, TracedValue]:
    """Return the travel and the duration of a segment, and the share of its time."""
    begins, lasts = (law.period * degrees / 360.0 for degrees in (segment.start, segment.end - segment.start))
    begin = given(f"start_time.{number}", begins, f"driver.law[{number - 1}].over") if begins else absent("start_time")
    duration = given(f"segment_time.{number}", lasts, f"driver.law[{number}].over")
    z = ((time - begin) / duration).named(f"time_share.{number}")
    return given(f"{way_key}.{number}", segment.travel, f"driver.law[{number}].to"), duration, z


def traced_law(law: Law, *, turns: bool) -> Transfer:
    """Return the traced coordinate, rate and second rate of a driver over the angle of one period.

    `turns`: whether the coordinate is an angle and not a length.
    """
    keys, way_key = _KEYS[turns]
    time, ends = clock(law), list[float]()
    columns: tuple[list[TracedValue], ...] = ([], [], [])
    for number, segment in enumerate(_placed_segments(law), start=1):
        path = f"driver.law[{number - 1}].to" if number > 1 else "driver.start"
        origin = given(f"{keys[0]}.{number}", segment.origin, path)
        if not segment.pieces:
            ends.append(segment.end)
            for column, known in zip(columns, (origin, absent(keys[1]), absent(keys[2])), strict=True):
                column.append(known)
            continue
        travel, duration, z = _timed(law, time, segment, number, way_key)
        for end, (f, f_1, f_2) in (
            segment.pieces.pieces(z)
            if isinstance(segment.pieces, _Own)
            else ((piece.end, _normalised(piece, z)) for piece in segment.pieces)
        ):
            ends.append(segment.start + end * (segment.end - segment.start))
            columns[0].append(law_displacement(origin, travel, f))
            columns[1].append(law_velocity(travel, f_1, duration))
            columns[2].append(f_2 if f_2.is_absent else law_acceleration(travel, f_2, duration))
    ends[-1] = 360.0
    return Transfer(*(TracedValue(Piecewise(ends, tuple(laws)), key) for laws, key in zip(columns, keys, strict=True)))


def traced_jerk(law: Law, *, turns: bool) -> TracedValue | None:
    """Return the traced third rate of a driver over the angle of one period, None for a law of the user.

    Where the second rate jumps there is an impulse besides.
    """
    time, laws, ends = clock(law), list[TracedValue](), list[float]()
    for number, segment in enumerate(_placed_segments(law), start=1):
        if isinstance(segment.pieces, _Own):
            return None
        travel, duration, z = _timed(law, time, segment, number, _KEYS[turns][1])
        for piece in segment.pieces or (LawPiece(1.0, ()),):
            ends.append(segment.start + piece.end * (segment.end - segment.start))
            c = [_coefficient(value) for value in (*piece.coefficients[3:], *[0.0] * 5)][:5]
            third = absent("way_share_3")
            if piece.amplitude:
                third = sine_law_3(piece.amplitude, piece.frequency, z, _coefficient(piece.phase))
            elif any(piece.coefficients[3:]):
                third = polynomial_law_3(z, *c)
            laws.append(third if third.is_absent else law_jerk(travel, third, duration))
    ends[-1] = 360.0
    return TracedValue(Piecewise(ends, tuple(laws)), "driver_angular_jerk" if turns else "driver_jerk")


def _normalised(piece: LawPiece, z: TracedValue) -> tuple[TracedValue, TracedValue, TracedValue]:
    """Return share of the travel, normalised velocity and acceleration of a piece; absent for a constant rate."""
    if piece.amplitude:
        c_0, c_1, *_ = (_coefficient(c) for c in piece.coefficients)
        a, k, d = piece.amplitude, piece.frequency, _coefficient(piece.phase)
        return sine_law(c_0, c_1, z, a, k, d), sine_law_1(c_1, a, k, z, d), sine_law_2(a, k, z, d)
    c = [_coefficient(value) for value in (*piece.coefficients, *[0.0] * (8 - len(piece.coefficients)))]
    second = polynomial_law_2(z, *c[2:]) if any(piece.coefficients[2:]) else absent("way_share_2")
    return polynomial_law(z, *c), polynomial_law_1(z, *c[1:]), second


def _coefficient(value: float) -> TracedValue | float:
    return value or absent("law_coefficient")


@cache
def _program(law: Law) -> Program:
    return Program(dict(zip(_KEYS[False][0], traced_law(law, turns=False), strict=True)))


def law_at(law: Law, grid: CrankGrid) -> Transfer:
    """Return coordinate, rate and second rate of a driver at angles of its period, arrays of shape (n,)."""
    return Transfer(*_program(law)(grid).values())


def rate_jumps(law: Law, *, turns: bool) -> list[tuple[int, float, float]]:
    """Return the numbers of the segments at whose ends the rate jumps, and the rates before and after.

    At the end of the period only if the coordinate comes back; `turns`: whether it is an angle.
    """
    placed = list(_placed_segments(law))
    away = (_INSIDE * (item.end - item.start) for item in placed)
    degrees = [place for item, step in zip(placed, away, strict=True) for place in (item.start + step, item.end - step)]
    rates = law_at(law, CrankGrid.from_degrees(degrees)).position_1.reshape(-1, 2)
    before, after = rates[:, 1], np.roll(rates[:, 0], -1)
    largest = max(*np.abs(rates).ravel(), *(abs(item.travel) / law.period for item in placed))
    jumps = np.abs(after - before) > _SAME_RATE * largest
    left = law.segments[-1].to - law.start
    jumps[-1] &= abs(math.remainder(left, math.tau) if turns else left) <= _REST_TOLERANCE * max(map(abs, extent(law)))
    return [(int(k) + 1, float(before[k]), float(after[k])) for k in np.flatnonzero(jumps)]


def extent(law: Law) -> tuple[float, float]:
    """Return the least and the greatest coordinate of a driver over its period."""
    passed = [law.start, *(section.to for section in law.segments)]
    for segment, placed in zip(law.segments, _placed_segments(law), strict=True):
        # the other laws stay between the values at their ends
        if isinstance(placed.pieces, _Own):
            passed += (placed.origin + placed.travel * placed.pieces.passed()).tolist()
        elif segment.kind in ("table", "constant-acceleration"):
            passed += [place for _, place in segment.points]
            begin = 0.0
            for piece in placed.pieces:
                share = np.polynomial.Polynomial(piece.coefficients)
                stops = share.deriv().trim().roots()
                extremes = stops[np.isreal(stops)].real
                inside = extremes[(extremes > begin) & (extremes < piece.end)]
                passed += (placed.origin + placed.travel * share(inside)).tolist()
                begin = piece.end
    return min(passed), max(passed)
