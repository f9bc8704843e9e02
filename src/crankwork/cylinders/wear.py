"""The wear diagram of a journal, where its oil hole should be, and statistics of the load of a bearing.

A ray is a direction from the centre of the journal to a point of its surface, in the frame of the journal. A force on
the journal presses where it comes from, opposite to the direction it points in: a rod pulled outward by its inertia
presses on the side of the crankpin that faces the crankshaft. From there it acts on an arc to both sides.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike

from crankwork.cylinders.load_vectors import BearingLoad
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array
from crankwork.shaft.curve import Curve

# Angles closer than this are the same, so that a ray at the very end of an arc is on it. [deg]
_SAME_ANGLE = 1e-9
_SPREAD = 60.0
# Sums closer than this share of the largest are the same.
_SAME_SUM = 1e-9
# error of a polynomial, relative to the largest force
_ROUNDING = 1e-11


def ray_angles(rays: int) -> Array:
    """Return the directions of evenly spread rays, the first along the reference direction of the frame, shape (rays,).

    Angles, positive with the rotation [deg].
    """
    if rays < 3:
        raise CrankworkError(f"a wear diagram of {rays} rays shows nothing; give at least 3, usually 12 or 24")
    return np.arange(rays) * 360 / rays


def wear_table(load: BearingLoad, rays: int = 12) -> Array:
    """Return the classical table: every force in the columns of the rays within its arc, shape (n, rays).

    Row per tabulated crank angle, column per ray of `ray_angles` [N]. `load`: load on the journal in its own frame:
    crank frame of a crankpin, shaft frame of a main journal [N]. The arc goes 60 degrees to either side of the point
    where the force presses, ends included (kolchin_demidov_2008, ch. 7).
    """
    distance = np.abs((ray_angles(rays) - load.opposite.direction[:, np.newaxis] + 180) % 360 - 180)
    within = distance <= _SPREAD + _SAME_ANGLE
    return np.where(within, load.resultant[:, np.newaxis], 0.0)


def wear_sums(load: BearingLoad, *, rays: int = 12) -> Array:
    """Return the sum of the loads on every ray, shape (rays,) (kolchin_demidov_2008, ch. 7). [N]

    The load is that on the journal in its own frame, at even steps without the end of the cycle.
    """
    return np.asarray(np.sum(wear_table(load, rays), axis=0))


@dataclass(frozen=True)
class OilHoleOfPolynomials:
    """The oil hole of a crankpin, from polynomials of its load over one cycle.

    `step`: between the loads that are added [deg]; `rays` in the wear diagram.
    """

    step: float
    rays: int

    def __call__(self, edges: Array, series: Array) -> tuple[float]:
        """Return its angle from the crank [rad]; `series`: of the force of the rods, along the crank and across it."""
        # an edge belongs to the panel that ends there, and the end of the cycle is its start
        angles = np.arange(edges[-1], edges[0] + np.radians(self.step) / 2, -np.radians(self.step))
        panel = np.searchsorted(edges, angles - _SAME_ANGLE) - 1
        u = (2 * angles - edges[panel] - edges[panel + 1]) / (edges[panel + 1] - edges[panel])
        forces = np.array([legendre.legval(u, coefficients[panel].T, tensor=False) for coefficients in series])
        # zero components that are rounding errors, which would decide about a ray at the end of an arc
        radial, tangential = np.where(np.abs(forces) > _ROUNDING * np.max(np.abs(forces)), forces, 0.0)
        return (float(np.radians(oil_hole(wear_sums(BearingLoad(-radial, tangential), rays=self.rays)).angle)),)


class OilHole(NamedTuple):
    """The least loaded position on a journal."""

    angle: float  # Middle of the least loaded arc, from the reference direction of the frame with the rotation [deg]
    # Width of that arc: one step of the rays for each ray on it. 360 if all rays are as good, and then the
    # angle says nothing [deg]
    arc: float
    least: float  # The sum there [N]


def oil_hole(sums: ArrayLike) -> OilHole:
    """Return the middle of the longest arc of rays that all have the least sum (kolchin_demidov_2008, ch. 7).

    Angle, arc and sum; of arcs as long as each other the one between the less loaded neighbours [deg], [N]. `sums`:
    sums of evenly spread rays [N], shape (rays,).
    """
    sums = np.asarray(sums, dtype=float)
    rays, least = sums.size, float(np.min(sums))
    step = 360 / rays
    at_least = sums <= least + _SAME_SUM * float(np.max(np.abs(sums)))
    if np.all(at_least):
        return OilHole(0.0, 360.0, least)
    starts = np.flatnonzero(at_least & ~np.roll(at_least, 1)).tolist()
    # as many chosen rays as follow each other from there, around the circle
    arcs = [(start, int(np.argmin(np.roll(at_least, -start)))) for start in starts]
    start, length = max(arcs, key=lambda arc: (arc[1], -sums[arc[0] - 1] - sums[(arc[0] + arc[1]) % rays]))
    return OilHole(float((start + (length - 1) / 2) * step % 360), length * step, least)


class LoadReversal(NamedTuple):
    """Duration and size of the load on a bearing along the rod, in both directions."""

    # Longest unbroken stretch of the cycle in that direction [deg]
    compression: float
    tension: float
    # Largest force in that direction, not negative [N]
    compression_peak: float
    tension_peak: float

    @property
    def duration(self) -> float:
        """The shorter of the two stretches, 0 where the load never has one of the directions. [deg]"""
        return min(self.compression, self.tension) if self.ratio > 1e-9 else 0.0

    @property
    def ratio(self) -> float:
        """Smaller over larger peak, 0 without load. [-]"""
        larger = max(self.compression_peak, self.tension_peak)
        return min(self.compression_peak, self.tension_peak) / larger if larger else 0.0


def reversal(
    ends: Sequence[float], is_compression: Sequence[bool], peaks: tuple[float, float], *, start: float = 0.0
) -> LoadReversal:
    """Return the reversal of a load along the rod, from its intervals of one direction.

    Stretches and peaks in both directions [deg], [N]. `ends`: where stretches of one direction end, the last at the
    end of the cycle [deg]; `is_compression`: whether each is one of compression, negative x; `start`: where the cycle
    begins [deg]. Source: api_618, which counts within one turn of the crankshaft.
    """
    lengths = np.diff(ends, prepend=start).tolist()
    if len(ends) > 1 and is_compression[0] == is_compression[-1]:
        # one stretch across the end of the cycle
        lengths[0] += lengths.pop()
    longest = {True: 0.0, False: 0.0}
    for direction, length in zip(is_compression, lengths, strict=False):
        longest[direction] = max(longest[direction], length)
    return LoadReversal(longest[True], longest[False], max(-peaks[1], 0.0), max(peaks[0], 0.0))


def reversal_of_polynomials(edges: Array, series: Array) -> tuple[float, float]:
    """Return duration [rad] and ratio of the reversal of a load along the rod, from its polynomials over one cycle.

    `edges`: ends of panels [rad]; `series`: Legendre coefficients of the load on them, shape (1, panels, k).
    """
    load = Curve.legendre(edges, series[0])
    angles = np.unique(np.concatenate([edges, load.zeros()]))
    negative = load((angles[1:] + angles[:-1]) / 2) < 0
    last = np.flatnonzero(np.append(negative[1:] != negative[:-1], True))
    reach = load.extremes()
    peaks, start = (reach.largest, reach.least), math.degrees(angles[0])
    turned = reversal(np.degrees(angles[1:][last]).tolist(), negative[last].tolist(), peaks, start=start)
    return math.radians(turned.duration), turned.ratio


# steps of closer marks [deg], and the share of the size of a diagram between marks above which they are used
_CLOSER = ((10.0, 0.45), (5.0, 0.15))
# largest step that gets closer marks; diagrams with larger steps are small [deg]
_CLOSE = 30.0


class PolarDiagram(NamedTuple):
    """The end of a load vector over the cycle, as a curve with marked crank angles, seen from its pole."""

    # Curve: to the right and downward, in a crank frame tangential and radial force, shape (n,) [N]
    across: Array
    down: Array
    degrees: Array  # Crank angles of its points, shape (n,) [deg]
    pole: tuple[float, float]  # Where the vectors begin, right and down [N]
    marks: Array  # Marked crank angles, shape (m,) [deg]
    # Points of the curve at the marked angles, shape (m,) [N]
    marks_across: Array
    marks_down: Array


def _marks(across: Array, down: Array, degrees: Array, cycle: float, step: float) -> Array:
    """Return multiples of a step, and of 10 and 5 degrees where the curve is long between them. [deg]"""
    marks = np.arange(0.0, cycle - 1e-9 * cycle, step)
    size = float(np.hypot(np.ptp(across), np.ptp(down)))
    path_length = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(across), np.diff(down)))])
    for closer, far in _CLOSER if step <= _CLOSE else ():
        ends = np.append(marks, cycle)
        lengths = np.diff(np.interp(ends, degrees, path_length))
        fast = (lengths > far * size) & (np.diff(ends) <= 3 * closer)
        between = [np.arange(ends[index] + closer, ends[index + 1] - 1e-9, closer) for index in np.flatnonzero(fast)]
        marks = np.sort(np.concatenate([marks, *between]))
    return marks


def polar_diagram(
    load: BearingLoad, degrees: ArrayLike, cycle: float, inertia: float = 0.0, step: float = 30.0
) -> PolarDiagram:
    """Return the polar diagram of a load: y to the right, minus x downward, crank angles marked. [N]

    Given the inertia force of all rod masses at the crankpin, never positive, the curve is that of the rods without it,
    and the pole lies as far below the origin: from the pole every vector is the whole load. Marks are `step` apart
    [deg], and closer where the load is fast. Source: kolchin_demidov_2008, ch. 7.
    """
    degrees = np.asarray(degrees, dtype=float)
    across, down = np.asarray(load.y, dtype=float), -np.asarray(load.x) - inertia
    marks = _marks(across, down, degrees, cycle, step)
    marked = (np.interp(marks, degrees, values, period=cycle) for values in (across, down))
    return PolarDiagram(across, down, degrees, (0.0, -inertia), marks, *marked)
