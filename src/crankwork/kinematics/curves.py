"""The curve of all positions of a linkage, followed by its arc through dead positions and change points."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from crankwork.errors import GeometryError
from crankwork.kinematics.closing import ClosingEquations, Surroundings
from crankwork.kinematics.crank_grid import Array
from crankwork.locale import Refusal

# lengths that differ by less, of the longest, count as equal; by less than the second, as nearly equal
EQUAL = 1e-9
NEARLY_EQUAL = 1e-6
_LONGEST_STEP = 0.2
_CLOSE_STEP = 0.02
_SHORTEST_STEP = 1e-8
_MOST_STEPS = 1_500
# how far the direction may turn from knot to knot, and what a step aims at, so that few have to be repeated [rad]
_MOST_TURNED, _TURNED = math.cos(0.15), 0.13
_FARTHEST = 0.02
_LAST_STEP = 1e-8
_ITERATIONS = 10
# within this of a change point positions follow the curve through the knots: the equations lose digits there
_AT_CROSSING = 1e-4
_SAME = 1e-7
_BIGGEST = 1e3
# from there on what runs away is followed in steps that grow with it
_FAR_OUT = 10.0
_NEAREST_KNOTS = 6
_ALL_BUT_SINGULAR = 0.1


class Crossing(NamedTuple):
    """A position in which the equations lose rank: where it is, by how much lengths miss it, and the ways through."""

    u: Array
    miss: float
    ways: Array


class _Knot(NamedTuple):
    """A position, the direction of the curve, and on which side of it the equations lie."""

    u: Array
    way: Array
    side: float


@dataclass(frozen=True)
class PositionEquations:
    """The closing equations of a linkage with one freedom; coordinates over the longest length, so of like size."""

    equations: ClosingEquations
    around: Surroundings

    def closed(self, u: Array) -> tuple[Array, Array]:
        """Return what is left open, shape (n, equations), and its derivative, shape (n, equations, coordinates)."""
        scale, row_scale = self.equations.scale, self.equations.row_scale
        value, slope = self.equations.closed(u * scale, self.around, np.arange(len(u)))
        return value / row_scale, slope * scale / row_scale[:, None]

    def corrected(self, guess: Array, normal: Array) -> Array:
        """Return positions on the curve in the planes through guesses, NaN where there are none."""
        u, active = guess.copy(), np.arange(len(guess))
        for _ in range(_ITERATIONS):
            value, jacobian = self.closed(u[active])
            aside = np.sum(normal[active] * (u[active] - guess[active]), axis=-1, keepdims=True)
            matrix = np.concatenate([jacobian, normal[active, None, :]], axis=1)
            step = _solved(matrix, -np.concatenate([value, aside], axis=1))
            u[active] += step
            active = active[~(np.max(np.abs(step), axis=1) < _LAST_STEP)]
            if not active.size:
                break
        u[active] = np.nan
        return u

    def ways(self, u: Array, along: Array) -> tuple[Array, Array]:
        """Return the directions of the curve, on the side of given ones, and on which side the equations lie."""
        _, jacobian = self.closed(u)
        matrix = np.concatenate([jacobian, along[:, None, :]], axis=1)
        right = np.zeros(u.shape)
        right[:, -1] = 1.0
        way = _solved(matrix, right)
        way /= np.linalg.norm(way, axis=1, keepdims=True)
        return way, np.linalg.det(matrix)

    def free(self, u: Array) -> Array:
        """Return a direction in which the linkage can move from one position, shape (coordinates,)."""
        _, jacobian = self.closed(u[None])
        return np.asarray(np.linalg.svd(jacobian[0])[2][-1])

    def crossing(self, u: Array) -> Crossing | None:
        """Return the position near one in which two curves cross, or would if lengths were a little different.

        F(u) + miss w0 = 0 and J(u)^T w = 0 with |w| = 1, by Newton's method; w0 is the w of the first position.
        """
        _, jacobian = self.closed(u[None])
        w = np.linalg.svd(jacobian[0])[0][:, -1]
        first, miss, count, size = w.copy(), 0.0, len(w), len(u)
        for _ in range(3 * _ITERATIONS):
            value, jacobian = self.closed(u[None])
            curvature = self._curvature(u, w)
            matrix = np.zeros((count + size + 1, count + size + 1))
            matrix[:count, :size], matrix[:count, -1] = jacobian[0], first
            matrix[count:-1, :size], matrix[count:-1, size:-1] = curvature, jacobian[0].T
            matrix[-1, size:-1] = 2 * w
            right = np.concatenate([value[0] + miss * first, jacobian[0].T @ w, [w @ w - 1.0]])
            step = _solved(matrix[None], -right[None])[0]
            u, w, miss = u + step[:size], w + step[size:-1], miss + float(step[-1])
            if not np.max(np.abs(step)) < 1.0:
                return None
            if np.max(np.abs(step)) < _LAST_STEP:
                break
        else:
            return None
        _, jacobian = self.closed(u[None])
        plane = np.linalg.svd(jacobian[0])[2][-2:]
        (a, b), (_, c) = plane @ self._curvature(u, w) @ plane.T
        root = b * b - a * c
        if root <= 0:
            return None
        far = b + math.copysign(math.sqrt(root), b)
        # a x^2 + 2 b x y + c y^2 = 0 without the difference of like numbers
        ways = np.array([[-c, far], [-far, a]]) @ plane
        return Crossing(u, abs(miss) / float(np.max(np.abs(first))), ways / np.linalg.norm(ways, axis=1, keepdims=True))

    def _curvature(self, u: Array, w: Array) -> Array:
        """Return the second derivative of a sum of the equations, shape (coordinates, coordinates)."""
        step = 1e-5
        shift = step * np.eye(len(u))
        _, jacobian = self.closed(np.concatenate([u + shift, u - shift]))
        gradient = np.einsum("e,nek->nk", w, jacobian)
        found = (gradient[: len(u)] - gradient[len(u) :]) / (2 * step)
        return np.asarray((found + found.T) / 2)


def _solved(matrix: Array, right: Array) -> Array:
    try:
        return np.asarray(np.linalg.solve(matrix, right[..., None])[..., 0])
    except np.linalg.LinAlgError:
        return np.full_like(right, np.nan)


@dataclass(frozen=True)
class Curve:
    """Positions of a linkage from knot to knot; those between are solved from the knots beside them."""

    system: PositionEquations
    arc: Array  # Length of the curve to each knot, in coordinates over the longest length, shape (n,)
    knots: Array  # Coordinates over their scale, shape (n, coordinates)
    ways: Array  # Direction of the curve at each knot
    is_closed: bool
    crossings: NDArray[np.intp]  # Which knots are change points
    nearly: tuple[Crossing, ...] = ()  # Change points that lengths miss by a little
    stated: float = 0.0  # Arc of the position from which it was followed

    @property
    def length(self) -> float:
        """Arc of the whole curve."""
        return float(self.arc[-1])

    def at(self, arc: Array) -> tuple[Array, Array]:
        """Return coordinates and their derivatives by the arc, each shape (n, coordinates). [m], [rad]

        A closed curve goes on beyond its ends, with the turns that its links have made.
        """
        turns = np.floor(arc / self.length) if self.is_closed else np.zeros_like(arc)
        local = arc - turns * self.length
        left = np.clip(np.searchsorted(self.arc, local, side="right") - 1, 0, len(self.arc) - 2)
        guess, way = self._between(left, local)
        normal = way / np.linalg.norm(way, axis=1, keepdims=True)
        far = np.ones(len(arc), dtype=bool)
        for knot in self.crossings:
            far &= np.abs(local - self.arc[knot]) > _AT_CROSSING
        if far.any():
            guess[far] = self.system.corrected(guess[far], normal[far])
            with np.errstate(invalid="ignore"):
                way[far], _ = self.system.ways(guess[far], normal[far])
        whole = turns[:, None] * (self.knots[-1] - self.knots[0])
        scale = self.system.equations.scale
        return (guess + whole) * scale, way * scale

    def nearest(self, q: Array) -> tuple[float, float]:
        """Return the arc at which the curve comes nearest to a position, whole turns aside, and how near. [-]"""
        scale = self.system.equations.scale

        def gap(there: Array) -> Array:
            apart = (q - there) / scale
            apart[..., 2::3] -= math.tau * np.rint(apart[..., 2::3] / math.tau)
            return np.asarray(apart)

        knots = np.argsort(np.linalg.norm(gap(self.knots * scale), axis=1))[:_NEAREST_KNOTS]
        arc = self.arc[knots]
        for _ in range(_ITERATIONS):
            there, way = self.at(arc)
            arc = arc + np.clip(np.sum(gap(there) * way / scale, axis=1), -_LONGEST_STEP, _LONGEST_STEP)
            if not self.is_closed:
                arc = np.clip(arc, 0.0, self.length)
        apart = np.linalg.norm(gap(self.at(arc)[0]), axis=1)
        best = int(np.argmin(apart))
        return float(arc[best] % self.length if self.is_closed else arc[best]), float(apart[best])

    def _between(self, left: NDArray[np.intp], arc: Array) -> tuple[Array, Array]:
        """Return positions and directions between knots by cubics."""
        width = (self.arc[left + 1] - self.arc[left])[:, None]
        t = (arc[:, None] - self.arc[left][:, None]) / width
        start, end, way, way_end = self.knots[left], self.knots[left + 1], self.ways[left], self.ways[left + 1]
        place = _cubic(t, start, end, width * way, width * way_end)
        rise = end - start
        a, b = width * way - rise, width * way_end - rise
        slope = rise + (1 - 2 * t) * ((1 - t) * a - t * b) - t * (1 - t) * (a + b)
        return place, slope / width


def _cubic(t: Array | float, start: Array, end: Array, slope: Array, slope_end: Array) -> Array:
    """Return a cubic by what it is, and its slope, where t is 0 and where it is 1."""
    rise = end - start
    return np.asarray(start + t * rise + t * (1 - t) * ((1 - t) * (slope - rise) - t * (slope_end - rise)))


def follow(system: PositionEquations, start: Array, ahead: Array) -> Curve:
    """Return the curve through a position, which must not be a change point; it goes straight on through those.

    `ahead`: towards which side it starts, shape (coordinates,).
    """
    u = start / system.equations.scale
    way = system.free(u)
    forward = _Follower(system, u, -way if way @ ahead < 0 else way)
    forward.run()
    if forward.is_closed:
        return forward.curve()
    backward = _Follower(system, u, -forward.first.way)
    backward.run()
    curve = forward.after(backward)
    if len(curve.knots) < 3:
        raise GeometryError(Refusal("circuit_lost", links=system.equations.names))
    return curve


class _Follower:
    """Steps along a curve from a position, until it is back there or gets out of bounds."""

    def __init__(self, system: PositionEquations, start: Array, way: Array) -> None:
        self.system, self.start = system, start
        ways, sides = system.ways(start[None], way[None])
        self.here = self.first = _Knot(start, ways[0], float(sides[0]))
        self.arcs, self.knots = [0.0], [self.here]
        # the knot before, so far away that the first step is straight on
        self.before, self.width = _Knot(start - self.here.way, self.here.way, self.here.side), 1.0
        self.step = _CLOSE_STEP
        self.crossings: list[int] = []
        self.is_closed = False

    def run(self) -> None:
        """Follow the curve."""
        for _ in range(_MOST_STEPS):
            if self.step < _SHORTEST_STEP or self._away() > _BIGGEST:
                return
            following = self._next()
            if following is None:
                self.step /= 2
            elif following.side * self.here.side < 0:
                self._cross(following)
            else:
                self._closes(following)
                if self.is_closed:
                    return
                self._accept(following)

    def _away(self) -> float:
        """Return how far the farthest link has come, in longest lengths."""
        return float(max(np.max(np.abs(self.here.u[axis::3])) for axis in (0, 1)))

    def _ahead(self, step: float) -> Array:
        """Return where the curve is some way on, by the cubic through the last two knots."""
        before, here, width = self.before, self.here, self.width
        return _cubic(1 + step / width, before.u, here.u, width * before.way, width * here.way)

    def _next(self) -> _Knot | None:
        """Return the position one step on, or None if the step is too long."""
        guess = self._ahead(self.step)
        u = self.system.corrected(guess[None], self.here.way[None])[0]
        if not np.linalg.norm(u - guess) < _FARTHEST * min(1.0, 10 * self.step):
            return None
        ways, sides = self.system.ways(u[None], self.here.way[None])
        return _Knot(u, ways[0], float(sides[0])) if ways[0] @ self.here.way > _MOST_TURNED else None

    def _accept(self, knot: _Knot) -> None:
        chord = float(np.linalg.norm(knot.u - self.here.u))
        turned = knot.way - self.here.way
        arc = chord * (1 + float(turned @ turned) / 24)
        self.before, self.width = self.here, arc
        self.arcs.append(self.arcs[-1] + arc)
        self.knots.append(knot)
        self.here = knot
        growth = min(1.5, _TURNED / max(float(np.linalg.norm(turned)), _SAME))
        self.step = min(growth * self.step, _LONGEST_STEP * max(1.0, self._away() / _FAR_OUT))

    def _cross(self, following: _Knot) -> None:
        """Go through a change point straight on, or step shorter where it is none."""
        if self.step > _CLOSE_STEP:
            self.step /= 2
            return
        found = self.system.crossing((self.here.u + following.u) / 2)
        # a curve that misses another by the square root of what lengths differ is told by shorter steps
        if found is None or np.linalg.norm(found.u - self.here.u) > 3 * self.step or found.miss > EQUAL:
            self.step /= 2
            return
        along = found.ways @ self.here.way
        best = int(np.argmax(np.abs(along)))
        self.crossings.append(len(self.knots))
        self._accept(_Knot(found.u, found.ways[best] * math.copysign(1.0, along[best]), following.side))
        self.step = _CLOSE_STEP

    def _closes(self, following: _Knot) -> None:
        """Note whether the start lies on the step just made."""
        way, turn = self.here.way, math.tau
        to_start = self.start - self.here.u
        to_start[2::3] -= turn * np.rint(to_start[2::3] / turn)
        along = float(to_start @ way)
        if not 0 < along <= float((following.u - self.here.u) @ way) or self.first.way @ way < 0.9:
            return
        there = self.here.u + to_start
        guess = self._ahead(along)
        guess += self.first.way * float((there - guess) @ self.first.way)
        reached = self.system.corrected(guess[None], self.first.way[None])[0]
        if np.linalg.norm(reached - there) < _SAME:
            self._accept(_Knot(there, self.first.way, self.first.side))
            self.is_closed = True

    def curve(self) -> Curve:
        """Return what has been followed."""
        knots = np.array([one.u for one in self.knots])
        ways = np.array([one.way for one in self.knots])
        crossings = np.array(self.crossings, dtype=np.intp)
        return Curve(self.system, np.array(self.arcs), knots, ways, self.is_closed, crossings, tuple(self._nearly()))

    def _nearly(self) -> Iterator[Crossing]:
        """Yield change points that lengths miss by a little: the equations all but lose rank beside them."""
        sides = np.abs([one.side for one in self.knots])
        least = 1 + np.flatnonzero((sides[1:-1] <= sides[:-2]) & (sides[1:-1] <= sides[2:]))
        for knot in least[sides[least] < _ALL_BUT_SINGULAR * sides.max()]:
            found = self.system.crossing(self.knots[knot].u)
            if found is not None and EQUAL < found.miss <= NEARLY_EQUAL:
                yield found

    def after(self, behind: _Follower) -> Curve:
        """Return an open curve: what has been followed the other way, and then this."""
        back, ahead = behind.curve(), self.curve()
        arc = np.concatenate([back.arc[-1] - back.arc[::-1], back.arc[-1] + ahead.arc[1:]])
        knots, ways = (
            np.concatenate([back.knots[::-1], ahead.knots[1:]]),
            np.concatenate([-back.ways[::-1], ahead.ways[1:]]),
        )
        crossings = np.concatenate([len(back.arc) - 1 - back.crossings[::-1], len(back.arc) - 1 + ahead.crossings])
        both = back.nearly + ahead.nearly
        return Curve(
            self.system, arc, knots, ways, is_closed=False, crossings=crossings, nearly=both, stated=float(back.arc[-1])
        )
