"""A step of a motion q'' = a(q, q') by Gauss collocation, a polynomial in time (hairer_wanner_1996, sec. IV.5)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import legendre

from crankwork.kinematics.crank_grid import Array
from crankwork.shaft.collocation import gauss

# Acceleration at coordinates and rates, arrays of any one shape
Acceleration = Callable[[Array, Array], Array]

POINTS = 12
NODES, WEIGHTS, TO_SERIES, _TO_INTEGRAL, INTEGRATION = gauss(POINTS)
TWICE = INTEGRATION @ INTEGRATION
ITERATIONS = 25
SETTLED = 1e-15
STAGNANT = 1e-12
NEGLIGIBLE = 1e-13
LOOKS = (1 - np.cos(np.pi * np.arange(4 * POINTS + 1) / (4 * POINTS))) / 2
# from values at the points to the integral up to each look, and to the integral of that
AT_LOOKS = legendre.legvander(2 * LOOKS - 1, POINTS) @ _TO_INTEGRAL @ TO_SERIES
TWICE_AT_LOOKS = AT_LOOKS @ INTEGRATION
_HALVINGS = 80
# how far a polynomial still tells what follows it, of its own length
AHEAD = 0.3
_AT_START = 1e-13


@dataclass
class Step:
    """A stretch of motion in time: the acceleration is a polynomial."""

    # Time, coordinate and rate where it begins, and how long it is
    time: float
    start: float
    rate: float
    length: float
    stages: Array  # Acceleration at the Gauss points, shape (12,)

    def at(self, time: Array) -> tuple[Array, Array, Array]:
        """Return coordinate, rate and acceleration at some times of the step."""
        s, h = (np.asarray(time) - self.time) / self.length, self.length
        first, second, third = self._series
        x = 2 * s - 1
        value = self.start + h * s * self.rate + h * h * legendre.legval(x, third)
        rate, acceleration = self.rate + h * legendre.legval(x, second), legendre.legval(x, first)
        return np.asarray(value), np.asarray(rate), np.asarray(acceleration)

    @cached_property
    def _series(self) -> tuple[Array, Array, Array]:
        """Legendre series of the acceleration, of its integral and of the integral of that, over the unit step."""
        first = TO_SERIES @ self.stages
        second = _TO_INTEGRAL @ first
        return first, second, legendre.legint(second, lbnd=-1) / 2

    @property
    def end(self) -> tuple[float, float]:
        """Coordinate and rate at its end."""
        h = self.length
        rates = self.rate + h * (INTEGRATION @ self.stages)
        return self.start + h * float(WEIGHTS @ rates), self.rate + h * float(WEIGHTS @ self.stages)

    @property
    def tail(self) -> tuple[float, float, float]:
        """Truncation errors of coordinate and rate from the last coefficients of the acceleration, and their share."""
        last = float(np.sum(np.abs(self._series[0][-2:])))
        return last * self.length**2, last * self.length, last / max(float(np.max(np.abs(self.stages))), 1e-300)

    def crossings(self, value: Callable[[Array, Array], Array]) -> list[float]:
        """Return the times within the step at which a function of coordinate and rate changes its sign, ascending."""
        q, v, _ = self.at(self.time + self.length * LOOKS)
        signs = value(q, v)
        if abs(signs[0]) <= _AT_START * np.max(np.abs(signs)):
            # it starts there
            signs[0] = 0.0
        times = []
        for k in np.flatnonzero(signs[1:] * signs[:-1] < 0):
            low, high, below = LOOKS[k], LOOKS[k + 1], signs[k] < 0
            for _ in range(_HALVINGS):
                middle = (low + high) / 2
                if middle in (low, high):
                    break
                q, v, _ = self.at(np.array(self.time + self.length * middle))
                low, high = (middle, high) if (float(value(q, v)) < 0) == below else (low, middle)
            times.append(self.time + self.length * high)
        return times


@np.errstate(all="ignore")  # of a step too long anything may come out
def gauss_step(
    acceleration: Acceleration, time: float, state: tuple[float, float], length: float, before: Step | None = None
) -> Step | None:
    """Return a step from a coordinate and its rate, None where Newton's method does not settle.

    `before`: the step before it under the same law, which tells what to begin with.
    """
    start, rate = state
    h, drift = length, start + length * NODES * rate
    if before is None:
        a = np.full(POINTS, float(acceleration(np.array([start]), np.array([rate]))[0]))
    else:
        a = before.at(np.minimum(time + h * NODES, time + AHEAD * before.length))[2]
    if not np.isfinite(a).all():
        return None
    last = math.inf
    for iteration in range(ITERATIONS):
        q, v = drift + h * h * (TWICE @ a), rate + h * (INTEGRATION @ a)
        result = acceleration(q, v)
        if iteration % 6 == 0:
            by_q, by_v = _slopes(acceleration, q, v, result)
            matrix = np.eye(POINTS) - h * h * by_q[:, None] * TWICE - h * by_v[:, None] * INTEGRATION
        if not (np.isfinite(result).all() and np.isfinite(matrix).all()):
            return None
        move = np.linalg.solve(matrix, result - a)
        a = a + move
        size, scale = float(np.max(np.abs(move))), float(np.max(np.abs(a)))
        # its effect on coordinate and rate is below their own rounding
        change = max(size * h * h / max(np.max(np.abs(q - start)), 1e-300), size * h / max(np.max(np.abs(v)), 1e-300))
        stagnates = size >= last / 4 and (size <= STAGNANT * scale or change <= NEGLIGIBLE)
        # the next move would be as much smaller as this one is than the last
        left = size * min(size / last, 1.0) if iteration else size
        if left <= SETTLED * scale or change <= 1e-17 or stagnates:
            return Step(time, start, rate, length, a)
        last = size
    return None


def _slopes(acceleration: Acceleration, q: Array, v: Array, a: Array) -> tuple[Array, Array]:
    """Return the derivatives of the acceleration; they only steer Newton's method."""
    step_q = 1e-7 * max(float(np.ptp(q)), 1e-3 * float(np.max(np.abs(q))), 1e-9)
    step_v = 1e-7 * max(float(np.max(np.abs(v))), 1e-9)
    both = acceleration(np.concatenate([q + step_q, q]), np.concatenate([v, v + step_v]))
    return (both[: q.size] - a) / step_q, (both[q.size :] - a) / step_v
