"""The crank angles of a kernel: evenly spaced, or nodes of polynomials between breakpoints."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Array = NDArray[np.float64]

_NODES = 16
# crank angles nearer than this are equal [deg]
_ANGLE_TOLERANCE = 1e-7


class Polynomials(NamedTuple):
    """Nodes from -1 to 1 with both ends, their weights, and the matrix from values to Legendre coefficients."""

    nodes: Array
    weights: Array
    coefficients: Array


def lobatto(count: int) -> Polynomials:
    """Return the nodes and weights of Lobatto's quadrature (abramowitz_stegun_1964, 25.4.32)."""
    # complex since NumPy 2.5
    inner = legendre.legroots(legendre.legder([0.0] * (count - 1) + [1.0])).real
    nodes = np.concatenate([[-1.0], inner, [1.0]])
    weights = 2 / (count * (count - 1) * legendre.legval(nodes, [0.0] * (count - 1) + [1.0]) ** 2)
    return Polynomials(nodes, weights, np.linalg.inv(legendre.legvander(nodes, count - 1)))


class Grid(NamedTuple):
    """Crank angles in panels over one cycle, between the breakpoints of laws. [deg]

    `edges`: ends of panels; `degrees`: the angles; `panel`: panel of each angle; `weights`: of an integral over the
    crank angle [rad]; `each`: nodes per panel of polynomials, 0 for evenly spaced angles; `moves`: whether a panel has
    other edges in other designs. The last `rows` of the angles are those of tables, not nodes.
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
        """Number of angles of integrals and extremes."""
        return int(self.degrees.size) - self.rows

    @property
    def middles(self) -> Array:
        """An angle inside each panel. [deg]"""
        return (self.edges[1:] + self.edges[:-1]) / 2

    def earlier(self, delay: float) -> NDArray[np.intp] | None:
        """Return the index of each angle minus a delay, or None if the grid lacks such angles."""
        if not delay:
            return np.arange(self.degrees.size)
        if not self.each:
            step = self.cycle / self.degrees.size
            places = delay / step
            if abs(places - round(places)) > _ANGLE_TOLERANCE / step:
                return None
            return (np.arange(self.degrees.size) - round(places)) % self.degrees.size
        panel, middles = self.panels_earlier(delay)
        widths = np.diff(self.edges)
        fits = (np.abs(self.middles[panel] - middles) < _ANGLE_TOLERANCE) & (
            np.abs(widths[panel] - widths) < _ANGLE_TOLERANCE
        )
        if not fits.all():
            return None
        nodes = (panel[:, None] * self.each + np.arange(self.each)).ravel()
        rows = self.degrees[self.nodes :]
        if not rows.size:
            return nodes
        earlier = np.mod(rows - delay - self.start, self.cycle) + self.start
        index = np.minimum(np.searchsorted(rows, earlier - _ANGLE_TOLERANCE), rows.size - 1)
        if np.max(np.abs(rows[index] - earlier)) > _ANGLE_TOLERANCE:
            return None
        return np.concatenate([nodes, self.nodes + index])

    def panels_earlier(self, delay: float) -> tuple[NDArray[np.intp], Array]:
        """Return the panel at the middle of each panel minus a delay, and that angle. [deg]"""
        middles = np.mod(self.middles - delay - self.start, self.cycle) + self.start
        return np.searchsorted(self.edges, middles, side="right") - 1, middles

    def with_rows(self, rows: Array) -> Grid:
        """Return the grid with rising angles of tables after its nodes; at an edge in the panel that ends there."""
        panel = np.maximum(np.searchsorted(self.edges, rows - _ANGLE_TOLERANCE, side="left") - 1, 0)
        degrees, panels = np.concatenate([self.degrees, rows]), np.concatenate([self.panel, panel])
        return self._replace(degrees=degrees, panel=panels, rows=int(rows.size))


def uniform_grid(breaks: Array, steps: int) -> Grid:
    """Return evenly spaced crank angles; an angle at a breakpoint belongs to the law that ends there."""
    start, cycle = float(breaks[0]), float(breaks[-1] - breaks[0])
    degrees = np.asarray(start + np.arange(steps) * (cycle / steps), dtype=float)
    panel = np.maximum(np.searchsorted(breaks, degrees - _ANGLE_TOLERANCE, side="left") - 1, 0)
    weights = np.asarray(np.full(steps, np.radians(cycle) / steps))
    return Grid(start, cycle, breaks, degrees, panel, weights, 0, np.zeros(breaks.size - 1, dtype=bool))


class Edges(NamedTuple):
    """Edges of panels, some of which depend on the design. [deg]

    `breaks`: breakpoints of the stated design and of others; `interval`: between breakpoints in which each panel lies;
    `share`: of the interval that lies before it; `followed_end`: index of the end of a law that each breakpoint
    follows, -1 if it is fixed; `stated`: those ends in the stated design.
    """

    breaks: Sequence[Array]
    interval: NDArray[np.intp]
    share: Array
    followed_end: NDArray[np.intp] = np.zeros(0, dtype=np.intp)
    stated: Array = np.zeros(0)

    def following(self, ends: Sequence[tuple[object, Array]]) -> Edges | None:
        """Return edges that follow ends of laws, whose crank angles are given for all designs; None if they cannot."""
        stated, *compared = self.breaks
        cycle = float(stated[-1] - stated[0])
        shifts = np.array([angles - angles[0] for _, angles in ends]).T[1:]
        # nothing that ends there moves, or one of the ends does
        moved: NDArray[np.bool_] = np.all([
            [_is_among(stated + shift, of_design, cycle) for shift in (0.0, *of_ends)]
            for of_design, of_ends in zip(compared, shifts, strict=False)
        ], axis=0)  # fmt: skip
        moved[0, [0, -1]] = True
        if not moved.any(axis=0).all():
            return None
        followed = np.argmax(moved, axis=0) - 1
        return self._replace(followed_end=followed, stated=np.array([angles[0] for _, angles in ends]))

    def divided(self, coarse: NDArray[np.bool_], count: int) -> Edges:
        """Return edges with coarse panels divided, and their neighbours, in which designs between may be coarse."""
        coarse = coarse | np.append(coarse[1:], False) | np.append(False, coarse[:-1])
        width = np.append(self.share[1:], 0.0)
        width = np.where(width > 0, width, 1.0) - self.share
        counts = np.where(coarse, count, 1)
        within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        share = np.repeat(self.share, counts) + within * np.repeat(width / counts, counts)
        return self._replace(interval=np.repeat(self.interval, counts), share=share)

    @property
    def in_stated(self) -> Array:
        """Edges of the stated design."""
        breaks = self.breaks[0]
        return np.append(breaks[self.interval] + np.diff(breaks)[self.interval] * self.share, breaks[-1])

    @property
    def moves(self) -> NDArray[np.bool_]:
        """Whether each panel has other edges in other designs."""
        moving = self.followed_end >= 0
        return np.asarray((moving[1:] | moving[:-1])[self.interval])

    @property
    def ends(self) -> NDArray[np.intp]:
        """Index of the end of a law at each edge of a panel, -1 if there is none."""
        ends = np.full(self.share.size + 1, -1)
        ends[np.append(np.flatnonzero(self.share == 0), -1)] = self.followed_end
        return ends

    def at(self, ends: Array) -> Array:
        """Return the edges of designs from the ends of their laws, shape (edges, lanes) of (ends, lanes)."""
        breaks = np.repeat(self.breaks[0][:, None], ends.shape[1], axis=1)
        moving = np.flatnonzero(self.followed_end >= 0)
        breaks[moving] += (ends - self.stated[:, None])[self.followed_end[moving]]
        inner = breaks[self.interval] + (breaks[self.interval + 1] - breaks[self.interval]) * self.share[:, None]
        return np.concatenate([inner, breaks[-1:]])


def _is_among(angles: Array, breaks: Array, cycle: float) -> NDArray[np.bool_]:
    """Return whether each angle is one of the breakpoints of a cycle. [deg]"""
    start = breaks[0]
    inside = np.mod(angles - start, cycle) + start
    place = np.clip(np.searchsorted(breaks, inside), 1, breaks.size - 1)
    near = np.minimum(np.abs(breaks[place] - inside), np.abs(breaks[place - 1] - inside))
    return np.asarray(near < _ANGLE_TOLERANCE)


def lobatto_grid(edges: Array, moves: NDArray[np.bool_], polynomials: Polynomials) -> Grid:
    """Return the nodes of polynomials between edges; an edge occurs twice, once for the law on either side."""
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
    # the ends are exact to the last digit, where sines are exact
    degrees[:, 0], degrees[:, -1] = edges[:-1], edges[1:]
    return degrees, np.radians(half) * polynomials.weights.reshape(shape)


def with_delayed_breakpoints(breaks: Array, delays: Sequence[float], most: int) -> Array:
    """Return breakpoints with all delayed ones; the original ones if there would be too many."""
    start, cycle = float(breaks[0]), float(breaks[-1] - breaks[0])
    offsets = breaks[:-1] - start
    while True:
        extended = np.concatenate([offsets, *(np.mod(offsets + delay, cycle) for delay in delays)])
        extended = np.sort(np.where(cycle - extended < _ANGLE_TOLERANCE, 0.0, extended))
        extended = extended[np.append(True, np.diff(extended) > _ANGLE_TOLERANCE)]
        if extended.size == offsets.size:
            break
        offsets = extended
        if offsets.size > most:
            return breaks
    return start + np.append(offsets, cycle)


def subdivide(breaks: Sequence[Array], width: float) -> Edges:
    """Return edges of panels of limited width between the breakpoints of the first design. [deg]"""
    parts = np.maximum(1, np.ceil(np.diff(breaks[0]) / width - _ANGLE_TOLERANCE)).astype(np.intp)
    share = np.concatenate([np.arange(count) / count for count in parts])
    return Edges(breaks, np.repeat(np.arange(parts.size), parts), share)
