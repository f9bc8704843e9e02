"""The crank angles at which a kernel calculates: evenly spaced, or nodes of polynomials between breaks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Array = NDArray[np.float64]

_NODES = 16
# crank angles nearer than this are one [deg]
_SAME = 1e-7


class Polynomials(NamedTuple):
    """Nodes from -1 to 1 with both ends, their weights, and what takes values there to Legendre coefficients."""

    nodes: Array
    weights: Array
    coefficients: Array


def lobatto(count: int) -> Polynomials:
    """Return the nodes and weights of Lobatto's quadrature (abramowitz_stegun_1964, 25.4.32)."""
    inner = legendre.legroots(legendre.legder([0.0] * (count - 1) + [1.0]))
    nodes = np.concatenate([[-1.0], inner, [1.0]])
    weights = 2 / (count * (count - 1) * legendre.legval(nodes, [0.0] * (count - 1) + [1.0]) ** 2)
    return Polynomials(nodes, weights, np.linalg.inv(legendre.legvander(nodes, count - 1)))


class Grid(NamedTuple):
    """Crank angles in panels over one cycle, between the breaks of laws. [deg]

    `edges` are the ends of panels; `degrees` the angles, `panel` which one each is in, `weights` those of an integral
    over the crank angle [rad]. `each` are the angles in a panel of polynomials, none where they are evenly spaced.
    """

    start: float
    cycle: float
    edges: Array
    degrees: Array
    panel: NDArray[np.intp]
    weights: Array
    each: int

    @property
    def middles(self) -> Array:
        """An angle inside each panel. [deg]"""
        return (self.edges[1:] + self.edges[:-1]) / 2

    def earlier(self, by: float) -> NDArray[np.intp] | None:
        """Return where columns stand at each angle earlier by some degrees, or None if the grid has no such ones."""
        if not self.each:
            step = self.cycle / self.degrees.size
            places = by / step
            if abs(places - round(places)) > _SAME / step:
                return None
            return (np.arange(self.degrees.size) - round(places)) % self.degrees.size
        middles = np.mod(self.middles - by - self.start, self.cycle) + self.start
        panel = np.searchsorted(self.edges, middles, side="right") - 1
        widths = np.diff(self.edges)
        fits = (np.abs(self.middles[panel] - middles) < _SAME) & (np.abs(widths[panel] - widths) < _SAME)
        if not fits.all():
            return None
        return (panel[:, None] * self.each + np.arange(self.each)).ravel()


def even(breaks: Array, steps: int) -> Grid:
    """Return evenly spaced crank angles; one at a break belongs to the law that ends there."""
    start, cycle = float(breaks[0]), float(breaks[-1] - breaks[0])
    degrees = np.asarray(start + np.arange(steps) * (cycle / steps), dtype=float)
    panel = np.maximum(np.searchsorted(breaks, degrees - _SAME, side="left") - 1, 0)
    weights = np.asarray(np.full(steps, np.radians(cycle) / steps))
    return Grid(start, cycle, breaks, degrees, panel, weights, 0)


def between(edges: Array, polynomials: Polynomials) -> Grid:
    """Return the nodes of polynomials between edges; an edge is twice among them, with the law of either side."""
    middle, half = (edges[1:] + edges[:-1])[:, None] / 2, np.diff(edges)[:, None] / 2
    degrees = middle + half * polynomials.nodes
    # the ends to the last digit, where sines are exact
    degrees[:, 0], degrees[:, -1] = edges[:-1], edges[1:]
    count = polynomials.nodes.size
    weights = np.radians(half) * polynomials.weights
    panel = np.repeat(np.arange(edges.size - 1), count)
    each = np.asarray(weights.ravel(), dtype=float)
    return Grid(float(edges[0]), float(edges[-1] - edges[0]), edges, degrees.ravel(), panel, each, count)


def shared(breaks: Array, delays: Sequence[float], width: float, most: int) -> Array:
    """Return the edges of panels no wider than some degrees, the same around every delayed angle. [deg]

    Where that would be too many breaks they are those of the columns alone.
    """
    start, cycle = float(breaks[0]), float(breaks[-1] - breaks[0])
    found = breaks[:-1] - start
    while True:
        every = np.concatenate([found, *(np.mod(found + by, cycle) for by in delays)])
        every = np.where(cycle - every < _SAME, 0.0, every)
        every = np.sort(every)
        every = every[np.append(True, np.diff(every) > _SAME)]
        if every.size == found.size:
            break
        found = every
        if found.size > most:
            found = breaks[:-1] - start
            break
    edges = np.append(found, cycle)
    parts = np.maximum(1, np.ceil(np.diff(edges) / width - _SAME)).astype(int)
    inner = [
        np.linspace(low, high, count, endpoint=False) for low, high, count in zip(edges, edges[1:], parts, strict=False)
    ]
    return start + np.append(np.concatenate(inner), cycle)
