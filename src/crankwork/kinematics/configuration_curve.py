"""The curve of all positions of a linkage, traced by its arc through dead positions and change points."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import GeometryError
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.dyads import LinkMotion, fixed_guide, guide_on_link, in_link_frame
from crankwork.kinematics.kinematic_coefficients import Transfer
from crankwork.kinematics.loop_closure import ChainBoundary, LoopClosure, solve_positions
from crankwork.locale import ErrorMessage
from crankwork.mechanism.driver import Cylinder, DrivingSlider, LinkMotor
from crankwork.mechanism.dyads import Guide
from crankwork.mechanism.mechanism import Mechanism

# relative differences of lengths below the first count as equal, below the second as nearly equal
EQUAL = 1e-9
NEARLY_EQUAL = 1e-6
_LONGEST_STEP = 0.2
_CLOSE_STEP = 0.02
_SHORTEST_STEP = 1e-8
_MAX_STEPS = 1_500
# largest turn of the direction between knots, and the turn aimed at, so that few steps are repeated [rad]
_MIN_COSINE, _AIMED_TURN = math.cos(0.15), 0.13
_FARTHEST = 0.02
_LAST_STEP = 1e-8
_ITERATIONS = 10
# distance from a change point within which positions are interpolated: the equations lose digits there
_AT_CROSSING = 1e-4
_TOLERANCE = 1e-7
_MAX_DISTANCE = 1e3
# distance beyond which steps grow with the distance
_FAR = 10.0
_NEAREST_KNOTS = 6
_ALL_BUT_SINGULAR = 0.1


class BranchPoint(NamedTuple):
    """A position at which the equations lose rank, the relative error of lengths that misses it, and the tangents."""

    u: Array
    miss: float
    tangents: Array


class _Knot(NamedTuple):
    """A position, the direction of the curve, and the determinant that changes sign at change points."""

    u: Array
    tangent: Array
    side: float


@dataclass(frozen=True)
class PositionEquations:
    """The closure equations of a linkage with one degree of freedom; coordinates over the longest length."""

    equations: LoopClosure
    boundary: ChainBoundary

    def residual(self, u: Array) -> tuple[Array, Array]:
        """Return the residuals, shape (n, equations), and their derivative, shape (n, equations, coordinates)."""
        scale, row_scale = self.equations.scale, self.equations.row_scale
        value, slope = self.equations.residual(u * scale, self.boundary, np.arange(len(u)))
        return value / row_scale, slope * scale / row_scale[:, None]

    def corrector(self, guess: Array, normal: Array) -> Array:
        """Return the positions on the curve in the planes through guesses, NaN without convergence."""
        u, active = guess.copy(), np.arange(len(guess))
        for _ in range(_ITERATIONS):
            value, jacobian = self.residual(u[active])
            offset = np.sum(normal[active] * (u[active] - guess[active]), axis=-1, keepdims=True)
            matrix = np.concatenate([jacobian, normal[active, None, :]], axis=1)
            step = solve_positions(matrix, -np.concatenate([value, offset], axis=1))
            u[active] += step
            active = active[~(np.max(np.abs(step), axis=1) < _LAST_STEP)]
            if not active.size:
                break
        u[active] = np.nan
        return u

    def tangents(self, u: Array, along: Array) -> tuple[Array, Array]:
        """Return the tangents of the curve on the side of given directions, and the determinants with these."""
        _, jacobian = self.residual(u)
        matrix = np.concatenate([jacobian, along[:, None, :]], axis=1)
        right = np.zeros(u.shape)
        right[:, -1] = 1.0
        tangent = solve_positions(matrix, right)
        tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
        return tangent, np.linalg.det(matrix)

    def null_direction(self, u: Array) -> Array:
        """Return a direction in which the linkage can move from a position, shape (coordinates,)."""
        _, jacobian = self.residual(u[None])
        return np.asarray(np.linalg.svd(jacobian[0])[2][-1])

    def crossing(self, u: Array) -> BranchPoint | None:
        """Return the position near a given one at which two curves cross, or would with slightly different lengths.

        F(u) + miss w0 = 0 and J(u)^T w = 0 with |w| = 1, by Newton's method; w0 is the w of the first position.
        """
        _, jacobian = self.residual(u[None])
        w = np.linalg.svd(jacobian[0])[0][:, -1]
        first, miss, count, size = w.copy(), 0.0, len(w), len(u)
        for _ in range(3 * _ITERATIONS):
            value, jacobian = self.residual(u[None])
            curvature = self._curvature(u, w)
            matrix = np.zeros((count + size + 1, count + size + 1))
            matrix[:count, :size], matrix[:count, -1] = jacobian[0], first
            matrix[count:-1, :size], matrix[count:-1, size:-1] = curvature, jacobian[0].T
            matrix[-1, size:-1] = 2 * w
            right = np.concatenate([value[0] + miss * first, jacobian[0].T @ w, [w @ w - 1.0]])
            step = solve_positions(matrix[None], -right[None])[0]
            u, w, miss = u + step[:size], w + step[size:-1], miss + float(step[-1])
            if not np.max(np.abs(step)) < 1.0:
                return None
            if np.max(np.abs(step)) < _LAST_STEP:
                break
        else:
            return None
        _, jacobian = self.residual(u[None])
        plane = np.linalg.svd(jacobian[0])[2][-2:]
        (a, b), (_, c) = plane @ self._curvature(u, w) @ plane.T
        root = b * b - a * c
        if root <= 0:
            return None
        far = b + math.copysign(math.sqrt(root), b)
        # a x^2 + 2 b x y + c y^2 = 0 without cancellation
        tangents = np.array([[-c, far], [-far, a]]) @ plane
        tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
        return BranchPoint(u, abs(miss) / float(np.max(np.abs(first))), tangents)

    def _curvature(self, u: Array, w: Array) -> Array:
        """Return the second derivative of a sum of the equations, shape (coordinates, coordinates)."""
        step = 1e-5
        shift = step * np.eye(len(u))
        _, jacobian = self.residual(np.concatenate([u + shift, u - shift]))
        gradient = np.einsum("e,nek->nk", w, jacobian)
        second = (gradient[: len(u)] - gradient[len(u) :]) / (2 * step)
        return np.asarray((second + second.T) / 2)


@dataclass(frozen=True)
class ConfigurationCurve:
    """Positions of a linkage at knots; positions between them are interpolated and corrected."""

    system: PositionEquations
    arc: Array  # Length of the curve to each knot, in coordinates over the longest length, shape (n,)
    knots: Array  # Coordinates over their scale, shape (n, coordinates)
    tangents: Array  # Direction of the curve at each knot
    is_closed: bool
    crossings: NDArray[np.intp]  # Indices of the knots that are change points
    near_crossings: tuple[BranchPoint, ...] = ()  # Change points that lengths miss slightly
    stated: float = 0.0  # Arc of the position from which it was traced

    @property
    def length(self) -> float:
        """Arc length of the curve."""
        return float(self.arc[-1])

    def at(self, arc: Array) -> tuple[Array, Array]:
        """Return coordinates and their derivatives by the arc, each shape (n, coordinates). [m], [rad]

        A closed curve continues beyond its ends, with the turns that its links have made.
        """
        turns = np.floor(arc / self.length) if self.is_closed else np.zeros_like(arc)
        local = arc - turns * self.length
        left = np.clip(np.searchsorted(self.arc, local, side="right") - 1, 0, len(self.arc) - 2)
        guess, tangent = self._between(left, local)
        normal = tangent / np.linalg.norm(tangent, axis=1, keepdims=True)
        far = np.ones(len(arc), dtype=bool)
        for knot in self.crossings:
            far &= np.abs(local - self.arc[knot]) > _AT_CROSSING
        if far.any():
            guess[far] = self.system.corrector(guess[far], normal[far])
            with np.errstate(invalid="ignore"):
                exact, _ = self.system.tangents(guess[far], normal[far])
            # where several curves cross only the interpolated tangent has a direction
            tangent[far] = np.where(np.isfinite(exact), exact, tangent[far])
        rotation = turns[:, None] * (self.knots[-1] - self.knots[0])
        scale = self.system.equations.scale
        return (guess + rotation) * scale, tangent * scale

    def nearest(self, q: Array) -> tuple[float, float]:
        """Return the arc at which the curve is nearest to a position, up to turns of links, and the distance. [-]"""
        scale = self.system.equations.scale

        def gap(other: Array) -> Array:
            difference = (q - other) / scale
            difference[..., 2::3] -= math.tau * np.rint(difference[..., 2::3] / math.tau)
            return np.asarray(difference)

        knots = np.argsort(np.linalg.norm(gap(self.knots * scale), axis=1))[:_NEAREST_KNOTS]
        arc = self.arc[knots]
        for _ in range(_ITERATIONS):
            position, tangent = self.at(arc)
            arc = arc + np.clip(np.sum(gap(position) * tangent / scale, axis=1), -_LONGEST_STEP, _LONGEST_STEP)
            if not self.is_closed:
                arc = np.clip(arc, 0.0, self.length)
        distance = np.linalg.norm(gap(self.at(arc)[0]), axis=1)
        best = int(np.argmin(distance))
        return float(arc[best] % self.length if self.is_closed else arc[best]), float(distance[best])

    def _between(self, left: NDArray[np.intp], arc: Array) -> tuple[Array, Array]:
        """Return positions and derivatives between knots by cubics."""
        width = (self.arc[left + 1] - self.arc[left])[:, None]
        t = (arc[:, None] - self.arc[left][:, None]) / width
        start, end = self.knots[left], self.knots[left + 1]
        slope_start, slope_end = width * self.tangents[left], width * self.tangents[left + 1]
        place = _cubic(t, start, end, slope_start, slope_end)
        rise = end - start
        a, b = slope_start - rise, slope_end - rise
        slope = rise + (1 - 2 * t) * ((1 - t) * a - t * b) - t * (1 - t) * (a + b)
        return place, slope / width


def _cubic(t: Array | float, start: Array, end: Array, slope: Array, slope_end: Array) -> Array:
    """Return a cubic from its values and slopes at t = 0 and t = 1."""
    rise = end - start
    return np.asarray(start + t * rise + t * (1 - t) * ((1 - t) * (slope - rise) - t * (slope_end - rise)))


def trace_curve(system: PositionEquations, start: Array, ahead: Array) -> ConfigurationCurve:
    """Return the curve through a position, which must not be a change point; it passes change points straight on.

    `ahead`: the side on which it starts, shape (coordinates,).
    """
    u = start / system.equations.scale
    tangent = system.null_direction(u)
    forward = _Follower(system, u, -tangent if tangent @ ahead < 0 else tangent)
    forward.run()
    if forward.is_closed:
        return forward.curve()
    backward = _Follower(system, u, -forward.first.tangent)
    backward.run()
    curve = forward.after(backward)
    if len(curve.knots) < 3:
        raise GeometryError(ErrorMessage("circuit_lost", links=system.equations.names))
    return curve


class _Follower:
    """Steps along a curve from a position, until it returns there or leaves the bounds."""

    def __init__(self, system: PositionEquations, start: Array, tangent: Array) -> None:
        self.system, self.start = system, start
        tangents, sides = system.tangents(start[None], tangent[None])
        self.last = self.first = _Knot(start, tangents[0], float(sides[0]))
        self.arcs, self.knots = [0.0], [self.last]
        # a previous knot that makes the first extrapolation straight
        self.before, self.width = _Knot(start - self.last.tangent, self.last.tangent, self.last.side), 1.0
        self.step = _CLOSE_STEP
        self.crossings: list[int] = []
        self.is_closed = False

    def run(self) -> None:
        """Follow the curve."""
        for _ in range(_MAX_STEPS):
            if self.step < _SHORTEST_STEP or self._distance() > _MAX_DISTANCE:
                return
            following = self._next()
            if following is None:
                self.step /= 2
            elif following.side * self.last.side < 0:
                self._cross(following)
            else:
                self._closes(following)
                if self.is_closed:
                    return
                self._accept(following)

    def _distance(self) -> float:
        """Return the largest coordinate of a link, in longest lengths."""
        return float(max(np.max(np.abs(self.last.u[axis::3])) for axis in (0, 1)))

    def _extrapolated(self, step: float) -> Array:
        """Extrapolate the curve by the cubic through the last two knots."""
        before, last, width = self.before, self.last, self.width
        return _cubic(1 + step / width, before.u, last.u, width * before.tangent, width * last.tangent)

    def _next(self) -> _Knot | None:
        """Return the next knot, or None if the step is too long."""
        guess = self._extrapolated(self.step)
        u = self.system.corrector(guess[None], self.last.tangent[None])[0]
        if not np.linalg.norm(u - guess) < _FARTHEST * min(1.0, 10 * self.step):
            return None
        tangents, sides = self.system.tangents(u[None], self.last.tangent[None])
        return _Knot(u, tangents[0], float(sides[0])) if tangents[0] @ self.last.tangent > _MIN_COSINE else None

    def _accept(self, knot: _Knot) -> None:
        chord = float(np.linalg.norm(knot.u - self.last.u))
        turned = knot.tangent - self.last.tangent
        arc = chord * (1 + float(turned @ turned) / 24)
        self.before, self.width = self.last, arc
        self.arcs.append(self.arcs[-1] + arc)
        self.knots.append(knot)
        self.last = knot
        growth = min(1.5, _AIMED_TURN / max(float(np.linalg.norm(turned)), _TOLERANCE))
        self.step = min(growth * self.step, _LONGEST_STEP * max(1.0, self._distance() / _FAR))

    def _cross(self, following: _Knot) -> None:
        """Pass a change point straight on; if there is none, shorten the step."""
        if self.step > _CLOSE_STEP:
            self.step /= 2
            return
        crossing = self.system.crossing((self.last.u + following.u) / 2)
        # a curve that passes close to another, by the square root of the difference of lengths, needs shorter steps
        if crossing is None or np.linalg.norm(crossing.u - self.last.u) > 3 * self.step or crossing.miss > EQUAL:
            self.step /= 2
            return
        along = crossing.tangents @ self.last.tangent
        best = int(np.argmax(np.abs(along)))
        self.crossings.append(len(self.knots))
        self._accept(_Knot(crossing.u, crossing.tangents[best] * math.copysign(1.0, along[best]), following.side))
        self.step = _CLOSE_STEP

    def _closes(self, following: _Knot) -> None:
        """Close the curve if its start lies on the last step."""
        tangent, turn = self.last.tangent, math.tau
        to_start = self.start - self.last.u
        to_start[2::3] -= turn * np.rint(to_start[2::3] / turn)
        along = float(to_start @ tangent)
        if not 0 < along <= float((following.u - self.last.u) @ tangent) or self.first.tangent @ tangent < 0.9:
            return
        target = self.last.u + to_start
        guess = self._extrapolated(along)
        guess += self.first.tangent * float((target - guess) @ self.first.tangent)
        reached = self.system.corrector(guess[None], self.first.tangent[None])[0]
        if np.linalg.norm(reached - target) < _TOLERANCE:
            self._accept(_Knot(target, self.first.tangent, self.first.side))
            self.is_closed = True

    def curve(self) -> ConfigurationCurve:
        """Return the curve traced so far."""
        knots = np.array([knot.u for knot in self.knots])
        tangents = np.array([knot.tangent for knot in self.knots])
        crossings = np.array(self.crossings, dtype=np.intp)
        return ConfigurationCurve(
            self.system, np.array(self.arcs), knots, tangents, self.is_closed, crossings, tuple(self._near_crossings())
        )

    def _near_crossings(self) -> Iterator[BranchPoint]:
        """Yield change points that lengths miss slightly: the determinant is almost zero near them."""
        sides = np.abs([knot.side for knot in self.knots])
        least = 1 + np.flatnonzero((sides[1:-1] <= sides[:-2]) & (sides[1:-1] <= sides[2:]))
        for index in least[sides[least] < _ALL_BUT_SINGULAR * sides.max()]:
            crossing = self.system.crossing(self.knots[index].u)
            if crossing is not None and EQUAL < crossing.miss <= NEARLY_EQUAL:
                yield crossing

    def after(self, behind: _Follower) -> ConfigurationCurve:
        """Return an open curve: the one traced backwards, then this one."""
        back, ahead = behind.curve(), self.curve()
        arc = np.concatenate([back.arc[-1] - back.arc[::-1], back.arc[-1] + ahead.arc[1:]])
        knots = np.concatenate([back.knots[::-1], ahead.knots[1:]])
        tangents = np.concatenate([-back.tangents[::-1], ahead.tangents[1:]])
        crossings = np.concatenate([len(back.arc) - 1 - back.crossings[::-1], len(back.arc) - 1 + ahead.crossings])
        near = back.near_crossings + ahead.near_crossings
        start = float(back.arc[-1])
        return ConfigurationCurve(
            self.system, arc, knots, tangents, is_closed=False, crossings=crossings, near_crossings=near, stated=start
        )


class Configurations(NamedTuple):
    """Some positions on a circuit: directions and frames of all links, with derivatives by the arc."""

    angles: dict[str, Transfer]
    frames: dict[str, LinkMotion]


Coordinate = Callable[[Configurations], Transfer]


def link_angle(name: str) -> Coordinate:
    """Return the direction of a link from the x axis. [rad]"""
    return lambda poses: poses.angles[name]


def driver_coordinate(mechanism: Mechanism) -> Coordinate:
    """Return the driver's coordinate: a crank angle or an angle between links [rad], a distance or a length [m]."""
    driver = mechanism.driver
    match driver:
        case DrivingSlider():
            return slider_place(driver.guide, driver.link)
        case Cylinder():
            return slider_place(Guide(link=driver.link), rod_of(driver.link))
        case LinkMotor():
            return relative_angle(*driver.links)

    def coordinate(poses: Configurations) -> Transfer:
        angle = poses.angles[driver.link]
        rate = driver.direction * angle.position_1
        return Transfer(driver.direction * (angle.position - driver.start), rate, angle.position_2)

    return coordinate


def relative_angle(link: str, other: str) -> Coordinate:
    """Return the angle from one link to another. [rad]"""
    return lambda poses: Transfer(*(b - a for a, b in zip(poses.angles[link], poses.angles[other], strict=True)))


def slider_place(guide: Guide, piece: str) -> Coordinate:
    """Return the distance of a sliding piece along its guide. [m]"""

    def coordinate(poses: Configurations) -> Transfer:
        line = guide_on_link(poses.frames[guide.link], guide) if guide.link else fixed_guide(guide)
        return in_link_frame(line, poses.frames[piece].origin).x

    return coordinate


def rod_of(link: str) -> str:
    """Return the name of the rod of a link whose length changes."""
    return f"{link}.rod"
