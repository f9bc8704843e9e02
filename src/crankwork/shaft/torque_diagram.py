"""Torque over the angle of a shaft as books draw it: points, harmonics, work in a stretch, loops about its mean."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.formula.expression import Value, formula
from crankwork.kinematics.crank_grid import Array

Shape = Literal["constant", "triangle"]


@formula("turning_moment", "khurmi_gupta_2005, ch. 16")
def torque_between_points(M_p1: Value, M_p2: Value, phi: Value, phi_p1: Value, phi_p2: Value) -> Value:
    """Torque on the straight line between two points of a diagram."""
    return M_p1 + (M_p2 - M_p1) * (phi - phi_p1) / (phi_p2 - phi_p1)


@formula("turning_moment", "khurmi_gupta_2005, ch. 16")
def torque_of_harmonic(a_n: Value, b_n: Value, k_h: Value, phi: Value) -> Value:
    """Part of one order in a torque."""
    return a_n * np.sin(k_h * phi) + b_n * np.cos(k_h * phi)


@formula("turning_moment", "khurmi_gupta_2005, ch. 16")
def torque_of_work(W_s: Value, phi_s: Value) -> Value:
    """Torque that does a work evenly over an angle."""
    return W_s / phi_s


@formula("turning_moment", "khurmi_gupta_2005, ch. 16")
def peak_torque_of_work(W_s: Value, phi_s: Value) -> Value:
    """Greatest torque of a triangle that does a work over an angle."""
    return 2 * W_s / phi_s


@formula("sheared_area", "khurmi_gupta_2005, ch. 16")
def sheared_area_of_hole(pi: Value, d_h: Value, s_h: Value) -> Value:
    """Area that is sheared where a round hole is punched."""
    return pi * d_h * s_h


@formula("shearing_force", "khurmi_gupta_2005, ch. 16")
def shearing_force(tau_cut: Value, A_sheared: Value) -> Value:
    """Greatest force that shears an area at once."""
    return tau_cut * A_sheared


@formula("shearing_force", "suchy_2006, ch. 6")
def force_of_slope(F_sheared: Value, h_in: Value, h_slope: Value) -> Value:
    """Force of a punch or die whose edge slopes, so that the same work is done over a longer way."""
    return F_sheared * h_in / (h_in + h_slope)


@formula("stroke_angle", "khurmi_gupta_2005, ch. 16")
def angle_in_plate(s_h: Value, phi_c: Value, h_p: Value) -> Value:
    """Angle that a punch is in the plate, if it goes down and up at one speed."""
    return s_h * phi_c / (2 * h_p)


class Harmonic(NamedTuple):
    """One order of a torque: how often it repeats in a turn, and its parts [-], [N m], [N m]."""

    order: float
    sine: float
    cosine: float


class WorkStroke(NamedTuple):
    """Work in a stretch of the period; over no angle it is done at once."""

    work: float  # [J]
    # Where it begins, and over which angle it is done [rad]
    start: float
    over: float
    shape: Shape = "constant"
    peak: float = 0.5  # Part of the stretch before the greatest torque of a triangle [-]

    def share(self, turned: Array) -> Array:
        """Return the part of the work that is done at angles from the beginning of the stretch. [-]"""
        if not self.over:
            return np.where(turned >= 0, 1.0, 0.0)
        u = np.clip(turned / self.over, 0.0, 1.0)
        if self.shape == "constant":
            return u
        before = u**2 / self.peak if self.peak else np.zeros_like(u)
        after = 1 - (1 - u) ** 2 / (1 - self.peak) if self.peak < 1 else np.ones_like(u)
        return np.where(u < self.peak, before, after)


class Line(NamedTuple):
    """A straight line between two points, by number, each moved by a number of periods, and where it ends. [rad]"""

    first: int
    last: int
    moved: tuple[int, int]
    end: float


@dataclass(frozen=True)
class TorqueDiagram:
    """A torque over its period: a constant, and what it differs by. Of loops, or an excess, the energies are known."""

    period: float  # [rad]
    constant: float = 0.0  # [N m]
    points: tuple[tuple[float, float], ...] = ()  # Corners: angles that do not descend, torques [rad], [N m]
    harmonics: tuple[Harmonic, ...] = ()
    strokes: tuple[WorkStroke, ...] = ()
    delays: tuple[float, ...] = (0.0,)  # By which the same torque comes again, for each cylinder [rad]
    loops: tuple[float, ...] = ()  # Work of each loop about the mean [J]
    excess: float | None = None  # Fluctuation of the energy [J]

    @property
    def is_complete(self) -> bool:
        """Whether the torque is known at every angle."""
        return not self.loops and self.excess is None

    @property
    def work(self) -> float:
        """Work of a period. [J]"""
        return float(self.work_to(np.array([self.period]))[0])

    def lines(self) -> Iterator[Line]:
        """Yield the straight lines of a period in their order, closed over its ends."""
        if not self.points:
            return
        last, angles = len(self.points) - 1, [angle for angle, _ in self.points]
        if angles[0] > 0:
            yield Line(last, 0, (-1, 0), angles[0])
        for index in range(last):
            if angles[index + 1] > angles[index]:
                yield Line(index, index + 1, (0, 0), angles[index + 1])
        if angles[-1] < self.period:
            yield Line(last, 0, (0, 1), self.period)

    def work_to(self, angle: Array) -> Array:
        """Return the work from an angle of zero up to angles. [rad] -> [J]"""
        moved = np.array(self.delays)[:, None]
        return np.asarray(np.sum(self._work_of_one(angle - moved) - self._work_of_one(-moved), axis=0))

    def _work_of_one(self, angle: Array) -> Array:
        result = self.constant * angle
        for order, sine, cosine in self.harmonics:
            result = result + (sine * (1 - np.cos(order * angle)) + cosine * np.sin(order * angle)) / order
        for stroke in self.strokes:
            periods, rest = np.divmod(angle - stroke.start, self.period)
            result = result + stroke.work * (periods + stroke.share(rest))
        return result + self._work_of_lines(angle) if self.points else result

    def _work_of_lines(self, angle: Array) -> Array:
        lines = list(self.lines())
        low = np.array([self.points[part.first][0] + part.moved[0] * self.period for part in lines])
        high = np.array([self.points[part.last][0] + part.moved[1] * self.period for part in lines])
        left = np.array([self.points[part.first][1] for part in lines])
        right = np.array([self.points[part.last][1] for part in lines])
        slope = (right - left) / (high - low)

        def area(line: NDArray[np.intp], end: Array) -> Array:
            return np.asarray((left[line] + slope[line] * (end - low[line]) / 2) * (end - low[line]))

        ends = np.array([part.end for part in lines])
        starts, all_lines = np.append(0.0, ends[:-1]), np.arange(len(lines))
        work = np.append(0.0, np.cumsum(area(all_lines, ends) - area(all_lines, starts)))
        periods, rest = np.divmod(angle, self.period)
        line = np.minimum(np.searchsorted(ends, rest, side="left"), len(lines) - 1)
        return np.asarray(periods * work[-1] + work[line] + area(line, rest) - area(line, starts[line]))


class ShaftTorques(NamedTuple):
    """Driving and load torque of a shaft; one that is not given is constant."""

    torque: TorqueDiagram | None
    load: TorqueDiagram | None
    cycle: float  # Angle after which both repeat [rad]

    @property
    def diagrams(self) -> dict[str, TorqueDiagram]:
        """Those that are given, by the table that describes them."""
        return {name: item for name, item in (("torque", self.torque), ("load", self.load)) if item is not None}


def common_period(first: float, second: float, most: int = 60) -> float | None:
    """Return the common period of two, or None if it has too many of them. [rad]"""
    for times in range(1, most + 1):
        share = times * first / second
        if share > 0.5 and math.isclose(share, round(share), rel_tol=1e-9):
            return times * first
    return None
