"""One equation y' = f(x, y) on panels of Gauss points, all panels at once, closed over a period.

On each panel y is a polynomial that satisfies the equation at the Gauss points, which is the implicit Runge-Kutta
method of order 16. Newton's method acts on the whole row of panels; each is condensed to what it does to its start
value, so that the row is closed by one short recurrence. A panel whose polynomial does not die out is halved.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from crankwork.kinematics.crank_grid import Array

Rate = Callable[[Array, Array], Array]


def gauss(points: int) -> tuple[Array, Array, Array, Array, Array]:
    """Return Gauss points of a panel from 0 to 1, their weights, and what turns values there into something else.

    Into Legendre coefficients, these into their integral from the panel's start, and values into the integral up to
    each point.
    """
    x, w = legendre.leggauss(points)
    to_series = (np.arange(points) + 0.5)[:, None] * legendre.legvander(x, points - 1).T * w
    to_integral = legendre.legint(np.eye(points), lbnd=-1) / 2
    return (x + 1) / 2, w / 2, to_series, to_integral, legendre.legvander(x, points) @ to_integral @ to_series


POINTS = 8
NODES, WEIGHTS, _TO_SERIES, _TO_INTEGRAL, _INTEGRATION = gauss(POINTS)

# a solution that wants to pass zero step after step has no place above it
_MOST_HELD = 6
_STEPS, _ROUNDS, _MOST_PANELS = 40, 12, 20000
TOLERANCE = 1e-13


@dataclass(frozen=True)
class Panels:
    """A solution on panels."""

    # Where panels meet, and the solution there, shape (n + 1,) [unit of x], [unit of y]
    edges: Array
    values: Array
    # Gauss points of the panels, solution and its derivative there, shape (n, 8) [unit of x], [unit of y], [y / x]
    points: Array
    inside: Array
    rate: Array
    converged: bool  # Whether Newton's method settled and every polynomial died out
    multiplier: float  # Change of the last value per change of the first [-]

    def __call__(self, x: Array) -> Array:
        """Return the solution anywhere on the panels."""
        panel = np.clip(np.searchsorted(self.edges, x, side="right") - 1, 0, len(self.edges) - 2)
        h = np.diff(self.edges)[panel]
        place = 2 * (x - self.edges[panel]) / h - 1
        series = self.rate[panel] @ (_TO_INTEGRAL @ _TO_SERIES).T
        return np.asarray(self.values[panel] + h * np.sum(legendre.legvander(place, POINTS) * series, axis=-1))


def integrate_periodic(rate: Rate, edges: Array, guess: Array) -> Panels:
    """Return the solution whose last value is its first (hairer_wanner_1996, sec. IV.5, Gauss methods).

    `rate`: f(x, y), of arrays of any one shape; it must depend on y; `edges`: panels to begin with, over one period
    [unit of x], shape (n + 1,); `guess`: values at the edges to begin with, above zero as all others
    [unit of y], shape (n + 1,).
    """
    values = guess
    for _ in range(_ROUNDS):
        solved = _newton(rate, edges, values)
        if not solved.converged:
            return solved
        series = np.abs(solved.rate @ _TO_SERIES.T)
        bad = (series[:, -1] + series[:, -2]) * np.diff(edges) > TOLERANCE * np.max(np.abs(solved.values))
        if not bad.any() or len(edges) > _MOST_PANELS:
            return solved
        edges = np.sort(np.concatenate([edges, (edges[1:] + edges[:-1])[bad] / 2]))
        values = solved(edges)
    return solved


def _newton(rate: Rate, edges: Array, values: Array) -> Panels:
    h = np.diff(edges)
    x = edges[:-1, None] + h[:, None] * NODES
    y = values[:-1, None] + np.diff(values)[:, None] * NODES
    values = values.copy()
    multiplier, last, held = np.nan, np.inf, 0
    for _ in range(_STEPS):
        f = rate(x, y)
        # the slope only steers Newton's method; what it converges to does not depend on it
        step = 1e-7 * np.maximum(np.abs(y), 1e-9 * np.max(np.abs(y)) + 1e-300)
        slope = (rate(x, y + step) - f) / step
        if not (np.all(np.isfinite(f)) and np.all(np.isfinite(slope))):
            break
        matrix = np.eye(POINTS) - h[:, None, None] * _INTEGRATION * slope[:, None, :]
        miss = values[:-1, None] + h[:, None] * (f @ _INTEGRATION.T) - y
        answer = np.linalg.solve(matrix, np.stack([miss, np.ones_like(miss)], axis=-1))
        own, by_start = answer[..., 0], answer[..., 1]
        added = h * ((f + slope * own) @ WEIGHTS) + values[:-1] - values[1:]
        factor = 1 + h * ((slope * by_start) @ WEIGHTS)
        change, multiplier = _closed(added.tolist(), factor.tolist())
        move = own + by_start * change[:-1, None]
        part = _allowed(y, move, values, change)
        held += part < 1
        if held > _MOST_HELD:
            break
        y, values = y + part * move, values + part * change
        size = float(np.max(np.abs(move)) / max(float(np.max(np.abs(y))), 1e-300))
        if part == 1 and (size <= 1e-14 or (size <= 1e-10 and size >= last / 4)):
            return Panels(edges, values, x, y, rate(x, y), converged=True, multiplier=multiplier)
        last = size
    return Panels(edges, values, x, y, np.full_like(y, np.nan), converged=False, multiplier=multiplier)


def _closed(added: list[float], factor: list[float]) -> tuple[Array, float]:
    """Return the changes at all edges, e -> factor e + added, closing on themselves, and the product of the factors."""
    total, constant = 1.0, 0.0
    for a, b in zip(added, factor, strict=True):
        total, constant = total * b, constant * b + a
    changes = [constant / (1 - total) if total != 1 else np.nan]
    for a, b in zip(added, factor, strict=True):
        changes.append(changes[-1] * b + a)
    return np.array(changes), total


def _allowed(y: Array, move: Array, values: Array, change: Array) -> float:
    """Return the part of a step that takes no value more than nine tenths of the way to zero."""
    worst = max(float(np.max(-move / y)), float(np.max(-change / values)))
    return min(1.0, 0.9 / worst) if worst > 0 else 1.0
