"""Statistics of a bearing load over the cycle: mean and extremes, reversal, the polar diagram."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from crankwork.cylinders.load_vectors import BearingLoad
from crankwork.kinematics.crank_grid import Array
from crankwork.shaft.curve import Curve


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
        """The shorter of the two stretches. [deg]"""
        return min(self.compression, self.tension)

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
