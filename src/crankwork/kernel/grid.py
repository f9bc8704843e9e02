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
    over the crank angle [rad]. `each` are the angles in a panel of polynomials, none where they are evenly spaced;
    `moves` says which panels lie elsewhere in other designs. The last `rows` of the degrees are no nodes: they are
    those of tables.
    """

    start: float
    cycle: float
    edges: Array
    degrees: Array
    panel: NDArray[np.intp]
    weights: Array
    each: int
    moves: NDArray[np.bool_]
    rows: int = 0

    @property
    def nodes(self) -> int:
        """How many of the angles are those of integrals and extremes."""
        return int(self.degrees.size) - self.rows

    @property
    def middles(self) -> Array:
        """An angle inside each panel. [deg]"""
        return (self.edges[1:] + self.edges[:-1]) / 2

    def earlier(self, by: float) -> NDArray[np.intp] | None:
        """Return where columns stand at each angle earlier by some degrees, or None if the grid has no such ones."""
        if not by:
            return np.arange(self.degrees.size)
        if not self.each:
            step = self.cycle / self.degrees.size
            places = by / step
            if abs(places - round(places)) > _SAME / step:
                return None
            return (np.arange(self.degrees.size) - round(places)) % self.degrees.size
        panel, middles = self.panels_earlier(by)
        widths = np.diff(self.edges)
        fits = (np.abs(self.middles[panel] - middles) < _SAME) & (np.abs(widths[panel] - widths) < _SAME)
        if not fits.all():
            return None
        nodes = (panel[:, None] * self.each + np.arange(self.each)).ravel()
        rows = self.degrees[self.nodes :]
        if not rows.size:
            return nodes
        at = np.mod(rows - by - self.start, self.cycle) + self.start
        found = np.minimum(np.searchsorted(rows, at - _SAME), rows.size - 1)
        if np.max(np.abs(rows[found] - at)) > _SAME:
            return None
        return np.concatenate([nodes, self.nodes + found])

    def panels_earlier(self, by: float) -> tuple[NDArray[np.intp], Array]:
        """Return in which panel the middle of each lies earlier by some degrees, and at which angle. [deg]"""
        middles = np.mod(self.middles - by - self.start, self.cycle) + self.start
        return np.searchsorted(self.edges, middles, side="right") - 1, middles

    def with_rows(self, rows: Array) -> Grid:
        """Return the grid with rising angles of tables behind its nodes; one at an edge belongs to what ends there."""
        panel = np.maximum(np.searchsorted(self.edges, rows - _SAME, side="left") - 1, 0)
        degrees, panels = np.concatenate([self.degrees, rows]), np.concatenate([self.panel, panel])
        return self._replace(degrees=degrees, panel=panels, rows=int(rows.size))


def even(breaks: Array, steps: int) -> Grid:
    """Return evenly spaced crank angles; one at a break belongs to the law that ends there."""
    start, cycle = float(breaks[0]), float(breaks[-1] - breaks[0])
    degrees = np.asarray(start + np.arange(steps) * (cycle / steps), dtype=float)
    panel = np.maximum(np.searchsorted(breaks, degrees - _SAME, side="left") - 1, 0)
    weights = np.asarray(np.full(steps, np.radians(cycle) / steps))
    return Grid(start, cycle, breaks, degrees, panel, weights, 0, np.zeros(breaks.size - 1, dtype=bool))


class Edges(NamedTuple):
    """Edges of panels of which some follow from the design. [deg]

    `breaks` of the stated design and of others, the way from each to the next cut in so many `parts`; `of` says which
    of the ends of laws each follows at a distance that stays, -1 where it stays itself; `stated` are those ends.
    """

    breaks: Sequence[Array]
    parts: NDArray[np.intp]
    of: NDArray[np.intp] = np.zeros(0, dtype=np.intp)
    stated: Array = np.zeros(0)

    def following(self, ends: Sequence[tuple[object, Array]]) -> Edges | None:
        """Return the same following ends, each with its crank angles in all designs; None if breaks do otherwise."""
        if len({one.size for one in self.breaks}) > 1:
            return None
        breaks = np.array(self.breaks)
        cycle, of = breaks[0, -1] - breaks[0, 0], np.full(breaks.shape[1], -1)
        for at in np.flatnonzero(np.ptp(breaks, axis=0) > _SAME):
            moved = breaks[:, at] - breaks[0, at]
            for end, (_, angles) in enumerate(ends):
                apart = moved - (angles - angles[0])
                if np.all(np.abs(apart - cycle * np.rint(apart / cycle)) < _SAME):
                    of[at] = end
            if of[at] < 0:
                return None
        return self._replace(of=of, stated=np.array([angles[0] for _, angles in ends]))

    @property
    def moves(self) -> NDArray[np.bool_]:
        """Which panels lie elsewhere in other designs."""
        moving = self.of >= 0
        return np.repeat(moving[1:] | moving[:-1], self.parts)

    @property
    def ends(self) -> NDArray[np.intp]:
        """Which of the ends each edge of a panel is, -1 where it is none."""
        found = np.full(int(self.parts.sum()) + 1, -1)
        found[np.append(0, np.cumsum(self.parts))] = self.of
        return found

    def at(self, ends: Array) -> Array:
        """Return the edges of designs whose laws end at some crank angles, shape (edges, lanes) of (ends, lanes)."""
        breaks = np.repeat(self.breaks[0][:, None], ends.shape[1], axis=1)
        moving = np.flatnonzero(self.of >= 0)
        breaks[moving] += (ends - self.stated[:, None])[self.of[moving]]
        interval = np.repeat(np.arange(self.parts.size), self.parts)
        share = np.concatenate([np.arange(count) / count for count in self.parts])[:, None]
        inner = breaks[interval] + (breaks[interval + 1] - breaks[interval]) * share
        return np.concatenate([inner, breaks[-1:]])


def between(edges: Array, moves: NDArray[np.bool_], polynomials: Polynomials) -> Grid:
    """Return the nodes of polynomials between edges; an edge is twice among them, with the law of either side."""
    degrees, weights = nodes_between(edges, polynomials)
    panel = np.repeat(np.arange(edges.size - 1), polynomials.nodes.size)
    start, cycle = float(edges[0]), float(edges[-1] - edges[0])
    each = polynomials.nodes.size
    return Grid(start, cycle, edges, degrees.ravel(), panel, weights.ravel(), each, moves)


def nodes_between(edges: Array, polynomials: Polynomials) -> tuple[Array, Array]:
    """Return nodes [deg] and weights [rad] between edges, shape (panels, nodes, ...) of edges of shape (edges, ...)."""
    shape = (1, -1) + (1,) * (edges.ndim - 1)
    middle, half = (edges[1:] + edges[:-1])[:, None] / 2, np.diff(edges, axis=0)[:, None] / 2
    degrees = middle + half * polynomials.nodes.reshape(shape)
    # the ends to the last digit, where sines are exact
    degrees[:, 0], degrees[:, -1] = edges[:-1], edges[1:]
    return degrees, np.radians(half) * polynomials.weights.reshape(shape)


def closed(breaks: Array, delays: Sequence[float], most: int) -> Array:
    """Return breaks, the same around every delayed angle; those of the columns alone where they would be too many."""
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
            return breaks
    return start + np.append(found, cycle)


def divided(breaks: Array, width: float) -> tuple[Array, NDArray[np.intp]]:
    """Return edges of panels no wider than some degrees, and in how many the way between two breaks is cut. [deg]"""
    parts = np.maximum(1, np.ceil(np.diff(breaks) / width - _SAME)).astype(np.intp)
    inner = [
        np.linspace(low, high, count, endpoint=False)
        for low, high, count in zip(breaks, breaks[1:], parts, strict=False)
    ]
    return np.append(np.concatenate(inner), breaks[-1]), parts
