"""Groups that no dyad describes, by Newton's method on the coordinates of all their links.

Each moving link has three coordinates, its origin and its angle; each pin and each slide two equations. All
positions are solved at once from a path that starts at the stated position and follows the crank in steps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from crankwork.errors import GeometryError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dyads import Closure, GroupMotion, LinkMotion, in_link_frame
from crankwork.kinematics.loop_closure import ChainBoundary, LoopClosure, Positions, point_of, solve_positions
from crankwork.locale import ErrorMessage
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Bar, Chain, ChainLink, Dyad, Point, Slide

_STEP = np.radians(6.0)
_SMALLEST_STEP = 1e-4
_LAST_STEP = 1e-8
_ITERATIONS = 12
_FARTHEST = 0.05
# largest relative distance of Newton's solution from a stated position
_ROUGHLY = 0.25
# first step of the homotopy, as a share of the residual at the stated position
_FIRST_PART = 0.1


class _Solution(NamedTuple):
    """Coordinates of the links and their derivatives, shape (n, 3 m), and the determinant, shape (n,)."""

    q: Array
    q_1: Array
    q_2: Array
    determinant: Array


class ChainPath:
    """Positions of a chain along the path of the crank, from the stated start; all others are solved from these.

    `boundary_at` gives the placed neighbours as a function of the crank angles.

    F(q, phi) = 0; q' and q'' solve J q' = -F' and J q'' = -F'' with the same Jacobian, where F' and F'' are the
    derivatives of the equations with the unknown one set to zero (uicker_2011).
    """

    def __init__(self, chain: Chain, grid: CrankGrid, boundary_at: Callable[[CrankGrid], ChainBoundary]) -> None:
        self._equations, self._boundary_at = LoopClosure(chain), boundary_at
        # rotation of the links per turn of the crank, if the position repeats
        self._turned: Array | None = None
        self._start = _start(self._equations, boundary_at(CrankGrid.from_radians([chain.start])))
        self._knots = [(chain.start, self._start)]
        self._path = _path(self._knots, self._start)
        # range solved so far, and whether the path ends before and after it
        self._reach, self._lost = (chain.start, chain.start), [False, False]
        self.extend(grid)

    def extend(self, grid: CrankGrid) -> None:
        """Extend the path to cover some crank angles."""
        before = self._reach
        self._reach = min(before[0], float(grid.angle.min())), max(before[1], float(grid.angle.max()))
        is_long = self._equations.chain.radian == 1.0 and self._reach[1] - self._reach[0] > 2 * math.tau
        if is_long and self._repeats():
            return
        behind = self._extend_side(0, before[0], self._reach[0])
        ahead = self._extend_side(-1, before[1], self._reach[1])
        self._knots = [*behind[::-1], *self._knots, *ahead]
        self._path = _path(self._knots, self._start)

    def _extend_side(self, side: int, known: float, end: float) -> list[tuple[float, _Solution]]:
        """Return positions beyond the last one on a side, up to an end or to where the path ends."""
        if known == end or self._lost[side]:
            return []
        angle, solution = self._knots[side]
        path = list(self._walk(angle, solution, _knots(self._equations.chain, angle, end)))
        self._lost[side] = not path or path[-1][0] != end
        return path

    def _walk(self, angle: float, solution: _Solution, knots: Array) -> Iterator[tuple[float, _Solution]]:
        boundary = self._boundary_at(CrankGrid.from_radians(knots))
        return _Walk(self._equations, boundary, self._boundary_at).along(angle, solution, knots)

    def _repeats(self) -> bool:
        """Solve one turn of the crank, and return whether it ends as it began, so that all turns are equal."""
        chain, start = self._equations.chain, self._start
        knots = _knots(chain, chain.start, chain.start + math.tau)
        path = list(self._walk(chain.start, start, knots))
        if not path or path[-1][0] != knots[-1]:
            return False
        last, scale = path[-1][1], self._equations.scale
        turned = np.zeros_like(start.q[0])
        turned[2::3] = math.tau * np.rint((last.q - start.q)[0, 2::3] / math.tau)
        same = (last.q - start.q - turned, last.q_1 - start.q_1, last.q_2 - start.q_2)
        if max(float(np.max(np.abs(difference) / scale)) for difference in same) > _LAST_STEP:
            return False
        self._path, self._turned = _path([(chain.start, start), *path], start), turned
        return True

    def covers(self, grid: CrankGrid) -> bool:
        """Return whether the path covers crank angles."""
        return self._turned is not None or bool(
            self._reach[0] <= grid.angle.min() and grid.angle.max() <= self._reach[1]
        )

    def _solved(self, grid: CrankGrid, boundary: ChainBoundary) -> _Solution:
        path, angle = self._path, grid.angle
        turns = np.zeros_like(angle)
        if self._turned is not None:
            turns = np.floor((angle - path.angle[0]) / math.tau)
            angle = angle - math.tau * turns
        nearest = np.clip(np.searchsorted(path.angle, angle), 1, path.angle.size - 1)
        nearest -= angle - path.angle[nearest - 1] < path.angle[nearest] - angle
        step = (angle - path.angle[nearest])[:, None]
        guess = path.q[nearest] + step * (path.q_1[nearest] + 0.5 * step * path.q_2[nearest])
        if self._turned is not None:
            guess += turns[:, None] * self._turned
        guess[np.abs(step[:, 0]) > 1.001 * _STEP * self._equations.chain.radian] = np.nan
        positions = np.arange(len(grid))
        q, _ = _newton(self._equations, guess, boundary, positions)
        with np.errstate(invalid="ignore"):
            return _derivatives(self._equations, q, boundary, positions)

    def coordinates(self, grid: CrankGrid) -> Array:
        """Return the coordinates of all links, then their derivatives, shape (9 links, n). [m], [rad]"""
        solution = self._solved(grid, self._boundary_at(grid))
        return np.concatenate([solution.q, solution.q_1, solution.q_2], axis=1).T

    def motion(self, grid: CrankGrid) -> GroupMotion:
        """Return points, frames and distances at crank angles."""
        boundary = self._boundary_at(grid)
        solution, positions = self._solved(grid, boundary), np.arange(len(grid))
        return _as_motion(self._equations, solution, self._path.determinant, boundary, positions)


def _knots(chain: Chain, start: float, end: float) -> Array:
    """Return equal steps of the coordinate from a start to an end, without the start."""
    return np.linspace(start, end, math.ceil(abs(end - start) / (_STEP * chain.radian)) + 1)[1:]


class _Path(NamedTuple):
    """Solved positions along the path of the crank, ascending, and the determinant at the start."""

    angle: Array
    q: Array
    q_1: Array
    q_2: Array
    determinant: float


def _path(knots: list[tuple[float, _Solution]], start: _Solution) -> _Path:
    """Return solved positions as arrays, at least two."""
    if len(knots) == 1:
        knots = knots * 2
    q, q_1, q_2 = (np.concatenate([solution[k] for _, solution in knots]) for k in range(3))
    return _Path(np.array([angle for angle, _ in knots]), q, q_1, q_2, float(start.determinant[0]))


def _start(equations: LoopClosure, boundary: ChainBoundary) -> _Solution:
    """Return the position at the stated start, which is the first of the boundary."""
    chain, positions = equations.chain, np.array([0])
    given = np.array([[value for link in chain.links for value in (*link.origin, link.angle)]])
    q, miss = _newton(equations, given, boundary, positions)
    distance = float(np.max(np.abs(q - given) / equations.scale))
    if not distance < _ROUGHLY:
        tracked = _start_by_homotopy(equations, given, boundary)
        if tracked is not None and not np.max(np.abs(tracked - given) / equations.scale) > distance:
            q = tracked
    if not np.isfinite(q).all():
        raise GeometryError(
            ErrorMessage(
                "chain_unassembled" if chain.radian == 1.0 else "chain_unassembled_start",
                links=equations.names,
                angle=math.degrees(chain.start),
                open=float(miss[0]) * 1e3,
            )
        )
    return _derivatives(equations, q, boundary, positions)


def _start_by_homotopy(equations: LoopClosure, given: Array, boundary: ChainBoundary) -> Array | None:
    """Return the position reached from a stated one while the residual is reduced in steps, None if this fails.

    Newton's method alone may converge far from its start.
    """
    positions, q, still, step = np.array([0]), given, 1.0, _FIRST_PART
    first, _ = equations.residual(q, boundary, positions)
    while still > 0 and step > _SMALLEST_STEP:
        target = max(still - step, 0.0)
        _, jacobian = equations.residual(q, boundary, positions)
        guess = q + solve_positions(jacobian, (target - still) * first)
        corrected, _ = _newton(equations, guess, boundary, positions, target * first)
        if np.max(np.abs(corrected - guess) / equations.scale) < _FARTHEST:
            q, still, step = corrected, target, 2 * step
        else:
            step /= 2
    return None if still > 0 else q


class _Walk(NamedTuple):
    """Follows the crank from knot to knot."""

    equations: LoopClosure
    boundary: ChainBoundary
    boundary_at: Callable[[CrankGrid], ChainBoundary]

    def along(self, angle: float, solution: _Solution, knots: Array) -> Iterator[tuple[float, _Solution]]:
        """Yield positions at the knots, and between them where needed, up to where the path ends."""
        for index, target in enumerate(knots.tolist()):
            following = _continued(self.equations, solution, target - angle, self.boundary, index)
            if following is None:
                refined = list(self._refine_step(solution, angle, target))
                yield from refined
                if not refined or refined[-1][0] != target:
                    return
                angle, solution = refined[-1]
            else:
                angle, solution = target, following
                yield angle, solution

    def _refine_step(self, solution: _Solution, angle: float, end: float) -> Iterator[tuple[float, _Solution]]:
        """Yield positions up to an end, in steps as small as needed."""
        step = (end - angle) / 2
        while angle != end and abs(step) > _SMALLEST_STEP * self.equations.chain.radian:
            target = end if abs(step) >= abs(end - angle) else angle + step
            boundary = self.boundary_at(CrankGrid.from_radians([target]))
            following = _continued(self.equations, solution, target - angle, boundary, 0)
            if following is None:
                step /= 2
            else:
                angle, solution, step = target, following, 2 * step
                yield angle, solution


def _continued(
    equations: LoopClosure, solution: _Solution, step: float, boundary: ChainBoundary, index: int
) -> _Solution | None:
    """Return the next position, or None if it is a jump or lies beyond a singular position."""
    guess = solution.q + step * (solution.q_1 + 0.5 * step * solution.q_2)
    positions = np.array([index])
    q, _ = _newton(equations, guess, boundary, positions)
    if not np.max(np.abs(q - guess) / equations.scale) < _FARTHEST:
        return None
    following = _derivatives(equations, q, boundary, positions)
    # the extrapolation back must agree too
    back = following.q - step * (following.q_1 - 0.5 * step * following.q_2)
    if not np.max(np.abs(back - solution.q) / equations.scale) < _FARTHEST:
        return None
    return following if following.determinant[0] * solution.determinant[0] > 0 else None


def _newton(
    equations: LoopClosure, guess: Array, boundary: ChainBoundary, positions: Positions, aim: Array | float = 0.0
) -> tuple[Array, Array]:
    """Return the coordinates that close all loops, NaN without convergence, and the residual of the guess.

    The guesses belong to `positions` of the boundary. Converged ones are dropped: after a step shorter than the square
    root of the rounding, the error is gone. `aim`: the residual to reach.
    """
    q, active = guess.copy(), np.arange(len(guess))
    active = active[np.isfinite(q).all(axis=1)]
    miss = np.full(len(guess), np.nan)
    for iteration in range(_ITERATIONS):
        if not active.size:
            break
        value, jacobian = equations.residual(q[active], boundary, positions[active])
        if iteration == 0:
            miss[active] = np.abs(value).max(axis=1)
        step = solve_positions(jacobian, aim - value)
        q[active] += step
        active = active[~(np.max(np.abs(step) / equations.scale, axis=1) < _LAST_STEP)]
    q[active] = np.nan
    return q, miss


def _derivatives(equations: LoopClosure, q: Array, boundary: ChainBoundary, positions: Positions) -> _Solution:
    """Return the transfer functions of the coordinates."""
    _, jacobian = equations.residual(q, boundary, positions)
    still = np.zeros_like(q)
    first, _ = equations.residual_derivatives(q, still, still, boundary, positions)
    q_1 = solve_positions(jacobian, -first)
    _, second = equations.residual_derivatives(q, q_1, still, boundary, positions)
    q_2 = solve_positions(jacobian, -second)
    return _Solution(q, q_1, q_2, np.linalg.det(jacobian))


def _as_motion(
    equations: LoopClosure, solution: _Solution, determinant: float, boundary: ChainBoundary, positions: Positions
) -> GroupMotion:
    """Return points, frames and distances from the coordinates of the links."""
    chain, frames = equations.chain, equations.frames(*solution[:3])
    points = {
        name: point_of(link, name, frames[link.name], boundary, positions)
        for link in chain.links
        for name in link.points
        if name not in chain.known
    }
    sliders = {}
    for slide in chain.slides:
        line = equations.line(slide, frames, boundary, positions)
        sliders[slide.link] = in_link_frame(line, frames[slide.link].origin).x
    ratio = solution.determinant / determinant
    return GroupMotion(points, frames, sliders, Closure(np.where(ratio > 0, ratio * ratio, np.nan), 1.0, ratio))


def as_chain(
    dyad: Dyad, placed: Mapping[str, LinkMotion], start: float, bars: Mapping[str, Bar] = MappingProxyType({})
) -> Chain:
    """Return a dyad as a chain that starts from a solved position, for an independent solution.

    `placed`: solved frames of links, of which the first position is used; `start`: crank angle of the first position
    [rad]; `bars`: those of the mechanism.
    """

    def link(name: str, **own: Point) -> ChainLink:
        frame = placed[name]
        x, y = (float(np.ravel(coordinate.position)[0]) for coordinate in frame.origin)
        cos, sin = float(np.ravel(frame.cos)[0]), float(np.ravel(frame.sin)[0])
        return ChainLink(name, (x, y), math.atan2(sin, cos), own)

    def bar(name: str, joint: str, point: str, length: float) -> ChainLink:
        own = bars.get(name, Bar((0.0, 0.0), (length, 0.0), 0.0))
        return link(name, **{joint: own.start, point: own.end})

    origin = (0.0, 0.0)
    match dyad:
        case RRR():
            a = bar(dyad.link_a, dyad.joint_a, dyad.point, dyad.length_a)
            b = bar(dyad.link_b, dyad.joint_b, dyad.point, dyad.length_b)
            return Chain((a, b), (), frozenset({dyad.joint_a, dyad.joint_b}), start)
        case RRP():
            a = bar(dyad.link, dyad.joint, dyad.slider, dyad.length)
            b = link(dyad.piece, **{dyad.slider: origin})
            return Chain((a, b), (Slide(dyad.piece, dyad.guide),), frozenset({dyad.joint}), start)
        case RPR():
            a, b = link(dyad.link, **{dyad.pivot: origin}), link(dyad.block, **{dyad.joint: origin})
            slot = replace(dyad.slot, link=dyad.link)
            return Chain((a, b), (Slide(dyad.block, slot),), frozenset({dyad.joint, dyad.pivot}), start)
        case PRP():
            a, b = link(dyad.block_a, **{dyad.point: origin}), link(dyad.block_b, **{dyad.point: origin})
            return Chain((a, b), (Slide(dyad.block_a, dyad.guide_a), Slide(dyad.block_b, dyad.guide_b)), start=start)
        case RPP():
            a, b = link(dyad.link), link(dyad.block, **{dyad.joint: origin})
            slides = Slide(dyad.link, dyad.guide), Slide(dyad.block, replace(dyad.slot, link=dyad.link))
            return Chain((a, b), slides, frozenset({dyad.joint}), start)
