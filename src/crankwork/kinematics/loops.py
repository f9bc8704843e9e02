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
from crankwork.kinematics.closing import ClosingEquations, Positions, Surroundings, point_of
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dyads import Closure, LinkMotion, seen_from
from crankwork.kinematics.transfer import PointMotion, Transfer
from crankwork.locale import Refusal
from crankwork.mechanism.chain import Chain, ChainLink, Slide
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Bar, Dyad, Point

_STEP = np.radians(6.0)
_SMALLEST_STEP = 1e-4
_LAST_STEP = 1e-8
_ITERATIONS = 12
_FARTHEST = 0.05
# by how much a stated position may miss what Newton's method finds from it
_ROUGHLY = 0.25
# of what loops are open by at a stated position, the part that is closed at first
_FIRST_PART = 0.1


class ChainMotion(NamedTuple):
    """Points, frames of links, distances of sliders, and how well the chain closes."""

    points: dict[str, PointMotion]
    links: dict[str, LinkMotion]
    sliders: dict[str, Transfer]
    closure: Closure | None


class _Solution(NamedTuple):
    """Coordinates of the links and their derivatives, shape (n, 3 m), and the determinant, shape (n,)."""

    q: Array
    q_1: Array
    q_2: Array
    determinant: Array


class ChainPath:
    """Positions of a chain along the way of the crank, from the stated start; all others are solved from these.

    `around` gives what is placed before, as a function of the crank angles.

    F(q, phi) = 0; q' and q'' solve J q' = -F' and J q'' = -F'' with the same Jacobian, where F' and F'' are the
    derivatives of the equations with the unknown one set to zero (uicker_2011).
    """

    def __init__(self, chain: Chain, grid: CrankGrid, around: Callable[[CrankGrid], Surroundings]) -> None:
        self._equations, self._around = ClosingEquations(chain), around
        # by how much a turn of the crank turns the links, where it brings them back
        self._turned: Array | None = None
        self._start = _start(self._equations, around(CrankGrid.from_radians([chain.start])))
        self._knots = [(chain.start, self._start)]
        self._path = _path(self._knots, self._start)
        # how far it has been followed, and whether there is no way on behind and ahead
        self._reach, self._lost = (chain.start, chain.start), [False, False]
        self.follow(grid)

    def follow(self, grid: CrankGrid) -> None:
        """Follow the chain as far as some crank angles, on from where that was done already."""
        before = self._reach
        self._reach = min(before[0], float(grid.angle.min())), max(before[1], float(grid.angle.max()))
        is_long = self._equations.chain.radian == 1.0 and self._reach[1] - self._reach[0] > 2 * math.tau
        if is_long and self._repeats():
            return
        behind = self._way(0, before[0], self._reach[0])
        ahead = self._way(-1, before[1], self._reach[1])
        self._knots = [*behind[::-1], *self._knots, *ahead]
        self._path = _path(self._knots, self._start)

    def _way(self, side: int, known: float, end: float) -> list[tuple[float, _Solution]]:
        """Return positions on from the last known on a side, as far as there are any."""
        if known == end or self._lost[side]:
            return []
        angle, at = self._knots[side]
        found = list(self._walk(angle, at, _knots(self._equations.chain, angle, end)))
        self._lost[side] = not found or found[-1][0] != end
        return found

    def _walk(self, angle: float, at: _Solution, knots: Array) -> Iterator[tuple[float, _Solution]]:
        return _Walk(self._equations, self._around(CrankGrid.from_radians(knots)), self._around).along(angle, at, knots)

    def _repeats(self) -> bool:
        """Follow one turn of the crank, and return whether it ends as it began; then it is the same in every other."""
        chain, start = self._equations.chain, self._start
        knots = _knots(chain, chain.start, chain.start + math.tau)
        there = list(self._walk(chain.start, start, knots))
        if not there or there[-1][0] != knots[-1]:
            return False
        last, scale = there[-1][1], self._equations.scale
        turned = np.zeros_like(start.q[0])
        turned[2::3] = math.tau * np.rint((last.q - start.q)[0, 2::3] / math.tau)
        same = (last.q - start.q - turned, last.q_1 - start.q_1, last.q_2 - start.q_2)
        if max(float(np.max(np.abs(one) / scale)) for one in same) > _LAST_STEP:
            return False
        self._path, self._turned = _path([(chain.start, start), *there], start), turned
        return True

    def covers(self, grid: CrankGrid) -> bool:
        """Return whether crank angles lie within what has been followed."""
        return self._turned is not None or bool(
            self._reach[0] <= grid.angle.min() and grid.angle.max() <= self._reach[1]
        )

    def _solved(self, grid: CrankGrid, surroundings: Surroundings) -> _Solution:
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
        at = np.arange(len(grid))
        q, _ = _newton(self._equations, guess, surroundings, at)
        with np.errstate(invalid="ignore"):
            return _derivatives(self._equations, q, surroundings, at)

    def coordinates(self, grid: CrankGrid) -> Array:
        """Return the coordinates of all links, then their derivatives, shape (9 links, n). [m], [rad]"""
        found = self._solved(grid, self._around(grid))
        return np.concatenate([found.q, found.q_1, found.q_2], axis=1).T

    def motion(self, grid: CrankGrid) -> ChainMotion:
        """Return points, frames and distances at crank angles."""
        surroundings = self._around(grid)
        solution, at = self._solved(grid, surroundings), np.arange(len(grid))
        return _as_motion(self._equations, solution, self._path.determinant, surroundings, at)


def _knots(chain: Chain, start: float, end: float) -> Array:
    """Return equal steps of the coordinate from a start to an end, without the start."""
    return np.linspace(start, end, math.ceil(abs(end - start) / (_STEP * chain.radian)) + 1)[1:]


class _Path(NamedTuple):
    """Solved positions along the way of the crank, ascending, and the determinant at the start."""

    angle: Array
    q: Array
    q_1: Array
    q_2: Array
    determinant: float


def _path(knots: list[tuple[float, _Solution]], start: _Solution) -> _Path:
    """Return solved positions as arrays, two at least."""
    if len(knots) == 1:
        knots = knots * 2
    q, q_1, q_2 = (np.concatenate([one[k] for _, one in knots]) for k in range(3))
    return _Path(np.array([angle for angle, _ in knots]), q, q_1, q_2, float(start.determinant[0]))


def _start(equations: ClosingEquations, surroundings: Surroundings) -> _Solution:
    """Return the position at the stated start, which is the first of the surroundings."""
    chain, here = equations.chain, np.array([0])
    given = np.array([[value for link in chain.links for value in (*link.origin, link.angle)]])
    q, miss = _newton(equations, given, surroundings, here)
    apart = float(np.max(np.abs(q - given) / equations.scale))
    if not apart < _ROUGHLY:
        led = _led(equations, given, surroundings)
        if led is not None and not np.max(np.abs(led - given) / equations.scale) > apart:
            q = led
    if not np.isfinite(q).all():
        raise GeometryError(
            Refusal(
                "chain_unassembled" if chain.radian == 1.0 else "chain_unassembled_start",
                links=equations.names,
                angle=math.degrees(chain.start),
                open=float(miss[0]) * 1e3,
            )
        )
    return _derivatives(equations, q, surroundings, here)


def _led(equations: ClosingEquations, given: Array, surroundings: Surroundings) -> Array | None:
    """Return the position that a stated one is led to while what its loops are open by shrinks, None if there is none.

    Newton's method alone may end far from where it began.
    """
    here, q, still, step = np.array([0]), given, 1.0, _FIRST_PART
    first, _ = equations.closed(q, surroundings, here)
    while still > 0 and step > _SMALLEST_STEP:
        to = max(still - step, 0.0)
        _, jacobian = equations.closed(q, surroundings, here)
        guess = q + _solved(jacobian, (to - still) * first)
        found, _ = _newton(equations, guess, surroundings, here, to * first)
        if np.max(np.abs(found - guess) / equations.scale) < _FARTHEST:
            q, still, step = found, to, 2 * step
        else:
            step /= 2
    return None if still > 0 else q


class _Walk(NamedTuple):
    """Follows the crank from knot to knot."""

    equations: ClosingEquations
    surroundings: Surroundings
    around: Callable[[CrankGrid], Surroundings]

    def along(self, angle: float, at: _Solution, knots: Array) -> Iterator[tuple[float, _Solution]]:
        """Yield positions at the knots, and between where needed, until there is none that continues the last."""
        for index, target in enumerate(knots.tolist()):
            found = _continued(self.equations, at, target - angle, self.surroundings, index)
            if found is None:
                crept = list(self._creep(at, angle, target))
                yield from crept
                if not crept or crept[-1][0] != target:
                    return
                angle, at = crept[-1]
            else:
                angle, at = target, found
                yield angle, at

    def _creep(self, at: _Solution, angle: float, end: float) -> Iterator[tuple[float, _Solution]]:
        """Yield positions on the way to the end in steps as small as it takes."""
        step = (end - angle) / 2
        while angle != end and abs(step) > _SMALLEST_STEP * self.equations.chain.radian:
            target = end if abs(step) >= abs(end - angle) else angle + step
            here = self.around(CrankGrid.from_radians([target]))
            found = _continued(self.equations, at, target - angle, here, 0)
            if found is None:
                step /= 2
            else:
                angle, at, step = target, found, 2 * step
                yield angle, at


def _continued(
    equations: ClosingEquations, at: _Solution, step: float, surroundings: Surroundings, index: int
) -> _Solution | None:
    """Return the position one step on, or None if that would be a jump or a passage through a singular one."""
    guess = at.q + step * (at.q_1 + 0.5 * step * at.q_2)
    here = np.array([index])
    q, _ = _newton(equations, guess, surroundings, here)
    if not np.max(np.abs(q - guess) / equations.scale) < _FARTHEST:
        return None
    found = _derivatives(equations, q, surroundings, here)
    # what lies between is foretold from either end
    back = found.q - step * (found.q_1 - 0.5 * step * found.q_2)
    if not np.max(np.abs(back - at.q) / equations.scale) < _FARTHEST:
        return None
    return found if found.determinant[0] * at.determinant[0] > 0 else None


def _newton(
    equations: ClosingEquations, guess: Array, surroundings: Surroundings, at: Positions, aim: Array | float = 0.0
) -> tuple[Array, Array]:
    """Return the coordinates that close all loops, NaN where none were found, and by how much the guess misses.

    The guesses belong to the positions `at` of the surroundings. Those that have converged drop out: after a
    step shorter than the square root of the rounding, the error is gone. `aim`: by how much loops are to stay open.
    """
    q, active = guess.copy(), np.arange(len(guess))
    active = active[np.isfinite(q).all(axis=1)]
    miss = np.full(len(guess), np.nan)
    for iteration in range(_ITERATIONS):
        if not active.size:
            break
        value, jacobian = equations.closed(q[active], surroundings, at[active])
        if iteration == 0:
            miss[active] = np.abs(value).max(axis=1)
        step = _solved(jacobian, aim - value)
        q[active] += step
        active = active[~(np.max(np.abs(step) / equations.scale, axis=1) < _LAST_STEP)]
    q[active] = np.nan
    return q, miss


def _derivatives(equations: ClosingEquations, q: Array, surroundings: Surroundings, at: Positions) -> _Solution:
    """Return the transfer functions of the coordinates."""
    _, jacobian = equations.closed(q, surroundings, at)
    still = np.zeros_like(q)
    first, _ = equations.rates(q, still, still, surroundings, at)
    q_1 = _solved(jacobian, -first)
    _, second = equations.rates(q, q_1, still, surroundings, at)
    q_2 = _solved(jacobian, -second)
    return _Solution(q, q_1, q_2, np.linalg.det(jacobian))


def _solved(matrix: Array, right: Array) -> Array:
    """Return the solutions of linear systems, NaN where the matrix is singular."""
    try:
        return np.asarray(np.linalg.solve(matrix, right[..., None])[..., 0], dtype=float)
    except np.linalg.LinAlgError:
        regular = np.linalg.det(matrix) != 0
        solution = np.full_like(right, np.nan)
        solution[regular] = np.linalg.solve(matrix[regular], right[regular, :, None])[..., 0]
        return solution


def _as_motion(
    equations: ClosingEquations, solution: _Solution, determinant: float, around: Surroundings, at: Positions
) -> ChainMotion:
    """Return points, frames and distances from the coordinates of the links."""
    chain, frames = equations.chain, equations.frames(*solution[:3])
    points = {
        name: point_of(link, name, frames[link.name], around, at)
        for link in chain.links
        for name in link.points
        if name not in chain.known
    }
    sliders = {}
    for slide in chain.slides:
        line = equations.line(slide, frames, around, at)
        sliders[slide.link] = seen_from(line, frames[slide.link].origin).x
    ratio = solution.determinant / determinant
    return ChainMotion(points, frames, sliders, Closure(np.where(ratio > 0, ratio * ratio, np.nan), 1.0, ratio))


def as_chain(
    dyad: Dyad, placed: Mapping[str, LinkMotion], start: float, bars: Mapping[str, Bar] = MappingProxyType({})
) -> Chain:
    """Return a dyad as a chain that starts from a solved position, to be solved the other way.

    `placed`: solved frames of links, of which the first position is taken; `start`: crank angle of the first position
    [rad]; `bars`: those of the mechanism.
    """

    def link(name: str, **own: Point) -> ChainLink:
        frame = placed[name]
        x, y = (float(np.ravel(one.position)[0]) for one in frame.origin)
        cos, sin = float(np.ravel(frame.cos)[0]), float(np.ravel(frame.sin)[0])
        return ChainLink(name, (x, y), math.atan2(sin, cos), own)

    def bar(name: str, joint: str, point: str, length: float) -> ChainLink:
        own = bars.get(name, Bar((0.0, 0.0), (length, 0.0), 0.0))
        return link(name, **{joint: own.start, point: own.end})

    at = (0.0, 0.0)
    match dyad:
        case RRR():
            a = bar(dyad.link_a, dyad.joint_a, dyad.point, dyad.length_a)
            b = bar(dyad.link_b, dyad.joint_b, dyad.point, dyad.length_b)
            return Chain((a, b), (), frozenset({dyad.joint_a, dyad.joint_b}), start)
        case RRP():
            a = bar(dyad.link, dyad.joint, dyad.slider, dyad.length)
            b = link(dyad.piece, **{dyad.slider: at})
            return Chain((a, b), (Slide(dyad.piece, dyad.guide),), frozenset({dyad.joint}), start)
        case RPR():
            a, b = link(dyad.link, **{dyad.pivot: at}), link(dyad.block, **{dyad.joint: at})
            slot = replace(dyad.slot, link=dyad.link)
            return Chain((a, b), (Slide(dyad.block, slot),), frozenset({dyad.joint, dyad.pivot}), start)
        case PRP():
            a, b = link(dyad.block_a, **{dyad.point: at}), link(dyad.block_b, **{dyad.point: at})
            return Chain((a, b), (Slide(dyad.block_a, dyad.guide_a), Slide(dyad.block_b, dyad.guide_b)), start=start)
        case RPP():
            a, b = link(dyad.link), link(dyad.block, **{dyad.joint: at})
            slides = Slide(dyad.link, dyad.guide), Slide(dyad.block, replace(dyad.slot, link=dyad.link))
            return Chain((a, b), slides, frozenset({dyad.joint}), start)
