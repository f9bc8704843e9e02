"""Circuits: the closed curves of positions of a linkage, their branches, and the limits of what moves on them.

A circuit belongs to the linkage, whatever drives it. The dead positions of a driver, where its coordinate turns back,
cut it into branches.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise, product
from typing import NamedTuple

import numpy as np

from crankwork.kinematics.assembly import singular_between, suspects
from crankwork.kinematics.closing import ClosingEquations
from crankwork.kinematics.coordinates import Coordinate, Stretch, rod_of, slider_place
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.curves import Curve, PositionEquations, follow
from crankwork.kinematics.dyads import LinkMotion, fixed_point
from crankwork.kinematics.extremes import closed_in
from crankwork.kinematics.loops import as_chain
from crankwork.kinematics.placement import Closures, Placed, place_at
from crankwork.kinematics.transfer import PointMotion, Transfer
from crankwork.mechanism.chain import Chain, ChainLink, Gear, Slide
from crankwork.mechanism.driver import Cylinder, DrivingSlider, LinkMotor
from crankwork.mechanism.dyads import RPR, RRP, RRR, Branch, Guide, Point
from crankwork.mechanism.mechanism import Crank, Mechanism, turns_of

_BRANCHES: tuple[Branch, Branch] = (1, -1)
_BETWEEN_KNOTS = 4
_SCAN = 720
_STILL = 1e-11
_BISECTIONS = 60
_SINGULAR = 1e-13
# what parts stretches that may belong to two circuits which lengths let cross, or all but cross
_NEARLY_SINGULAR = 1e-4
# what is beside a change point on all of a stretch
_BESIDE = 1e-7
# how near to infinity a driver is looked at [deg]
_FROM_ENDS = 0.25
_SAME = 1e-6


class Extent(NamedTuple):
    """Least and greatest value of a coordinate on a part of a circuit, and the arcs at which they are reached."""

    least: float
    least_at: float
    greatest: float
    greatest_at: float

    @property
    def travel(self) -> float:
        """Stroke or swing."""
        return self.greatest - self.least


class Part(NamedTuple):
    """A part of a circuit from arc to arc, beyond the length of the circuit where it goes over its start."""

    start: float
    end: float


@dataclass(frozen=True)
class Circuit:
    """A curve of positions of a linkage; a closed one begins with the position that was stated."""

    mechanism: Mechanism
    curve: Curve

    @property
    def sliders(self) -> dict[str, Coordinate]:
        """The distance of every sliding piece along its guide. [m]"""
        return {one.link: slider_place(one.guide, one.link) for one in self.curve.system.equations.chain.slides}

    @property
    def whole(self) -> Part:
        """All of it."""
        return Part(0.0, self.curve.length)

    @cached_property
    def _sampled(self) -> tuple[Array, Stretch]:
        """Positions at and between the knots."""
        knots = self.curve.arc
        parts = np.linspace(0.0, 1.0, _BETWEEN_KNOTS, endpoint=False)
        arc = np.append((knots[:-1, None] + parts * np.diff(knots)[:, None]).ravel(), knots[-1])
        return arc, self.stretch(arc)

    def stretch(self, arc: Array) -> Stretch:
        """Return where everything is at some arcs."""
        q, q_1 = self.curve.at(np.asarray(arc, dtype=float))
        equations, zero = self.curve.system.equations, np.zeros_like(q)
        angles = {name: Transfer(q[:, k + 2], q_1[:, k + 2], zero[:, 0]) for name, k in equations.index.items()}
        return Stretch(angles, equations.frames(q, q_1, zero))

    def values(self, coordinate: Coordinate, arc: Array) -> Array:
        """Return a coordinate at some arcs."""
        return np.asarray(coordinate(self.stretch(arc)).position)

    def turning_points(self, coordinate: Coordinate) -> Array:
        """Return the arcs at which a coordinate turns back, ascending: the dead positions of a driver."""

        def rate(arc: Array) -> Array:
            return np.asarray(coordinate(self.stretch(arc)).position_1)

        arc, there = self._sampled
        arc, rates = _looked_at_closely(rate, arc, np.asarray(coordinate(there).position_1))
        moving = np.flatnonzero(np.abs(rates) > _STILL)
        if not moving.size:
            return np.empty(0)
        arc, rates = arc[moving], rates[moving]
        if self.curve.is_closed and rates[0] * rates[-1] < 0 and moving[-1] - moving[0] < len(arc) - 1:
            arc, rates = np.append(arc, arc[0] + self.curve.length), np.append(rates, rates[0])
        turned = np.flatnonzero(rates[1:] * rates[:-1] < 0)
        if not turned.size:
            return np.empty(0)
        found = closed_in(rate, arc[turned], arc[turned + 1], rates[turned], rates[turned + 1])
        return np.sort(found % self.curve.length)

    def branches(self, driver: Coordinate) -> list[Part]:
        """Return the parts between dead positions of a driver; the whole where it has none."""
        dead = self.turning_points(driver)
        if not dead.size:
            return [self.whole]
        if self.curve.is_closed:
            return [
                Part(*map(float, ends)) for ends in zip(dead, [*dead[1:], dead[0] + self.curve.length], strict=True)
            ]
        ends = [0.0, *map(float, dead), self.curve.length]
        return [Part(*pair) for pair in pairwise(ends)]

    def branch_at(self, driver: Coordinate, arc: float | None = None) -> Part:
        """Return the branch that a position is on, that of the stated position where none is named."""
        arc = self.curve.stated if arc is None else arc
        for part in self.branches(driver):
            for shift in (0.0, -self.curve.length):
                moved = Part(part.start + shift, part.end + shift)
                if moved.start <= arc <= moved.end:
                    return moved
        return self.whole

    def extent(self, coordinate: Coordinate, part: Part | None = None) -> Extent:
        """Return the least and greatest value of a coordinate on a part, by default on the whole circuit."""
        (found,) = self.extents(coordinate, part or self.whole)
        return found

    def extents(self, coordinate: Coordinate, *parts: Part) -> list[Extent]:
        """Return the least and greatest value of a coordinate on each of some parts."""
        turns = self.turning_points(coordinate)
        return [self._between(coordinate, turns, part) for part in parts]

    def _between(self, coordinate: Coordinate, turns: Array, part: Part) -> Extent:
        """Return the least and greatest value of a coordinate that turns back at some arcs, on a part."""
        every = np.concatenate([turns + k * self.curve.length for k in (-1, 0, 1)])
        arc = np.concatenate([[part.start], every[(every > part.start) & (every < part.end)], [part.end]])
        values = self.values(coordinate, arc)
        low, high = int(np.argmin(values)), int(np.argmax(values))
        return Extent(float(values[low]), float(arc[low]), float(values[high]), float(arc[high]))

    def turns(self, link: str) -> int:
        """Return how many turns a link makes on the way round the circuit."""
        k = self.curve.system.equations.index[link] + 2
        return round(float(self.curve.knots[-1, k] - self.curve.knots[0, k]) / math.tau) if self.curve.is_closed else 0


def _looked_at_closely(rate: Callable[[Array], Array], arc: Array, rates: Array) -> tuple[Array, Array]:
    """Return arcs and rates, with more of them where a rate of one sign may touch zero between two."""
    for _ in range(4):
        same = rates[1:] * rates[:-1] > 0
        near = [one for one in suspects(arc, np.abs(rates)) if same[one]]
        near = [one for one in near if arc[one + 1] - arc[one] > 1e-6]
        if not near:
            break
        more = np.concatenate([np.linspace(arc[one], arc[one + 1], 9)[1:-1] for one in near])
        arc, order = np.unique(np.concatenate([arc, more]), return_index=True)
        rates = np.concatenate([rates, rate(more)])[order]
    return arc, rates


def circuit_through(mechanism: Mechanism, crank_degrees: float = 0.0) -> Circuit:
    """Return the circuit of a linkage that its position at a crank angle is on, which is no change point. [deg]"""
    return circuit_at(mechanism, CrankGrid.from_degrees([crank_degrees]))


def circuit_at(mechanism: Mechanism, coordinate: CrankGrid) -> Circuit:
    """Return the circuit that the position at one value of the driver's coordinate is on, followed as that grows."""
    system, start = _system(mechanism, place_at(mechanism, coordinate))
    index, driver = system.equations.index, mechanism.driver
    ahead = np.zeros_like(start)
    match driver:
        case Crank():
            ahead[index[driver.link] + 2] = driver.direction
        case DrivingSlider():
            ahead[index[driver.link] : index[driver.link] + 2] = (
                math.cos(driver.guide.angle),
                math.sin(driver.guide.angle),
            )
        case Cylinder() | LinkMotor():
            angle, end, foot = start[index[driver.link] + 2], index[rod_of(driver.link)], index[driver.link]
            ahead[end : end + 2] = math.cos(angle), math.sin(angle)
            ahead[foot : foot + 2] = -math.cos(angle), -math.sin(angle)
    return Circuit(mechanism, follow(system, start, ahead))


def _system(mechanism: Mechanism, placed: Placed) -> tuple[PositionEquations, Array]:
    """Return the equations of all links of a linkage, the driving one of them, and their coordinates where it is."""
    driver, ground = mechanism.driver, dict(mechanism.ground)
    points: dict[str, dict[str, Point]] = {}
    slides: list[Slide] = []
    gears: list[Gear] = []
    if isinstance(driver, Crank):
        pivot = f"{driver.link}.pivot"
        points[driver.link] = {pivot: (0.0, 0.0), driver.pin: (driver.radius, 0.0)}
        ground[pivot] = driver.pivot
        for geared in driver.geared:
            points[geared.link] = {f"{geared.link}.pivot": (0.0, 0.0)}
            ground[f"{geared.link}.pivot"] = geared.pivot
            start = geared.start - geared.ratio * driver.start
            gears.append(Gear(geared.link, driver.link, geared.ratio, start))
    elif isinstance(driver, DrivingSlider):
        points[driver.link] = {}
        slides.append(Slide(driver.link, driver.guide))
    for group in mechanism.dyads:
        chain = group if isinstance(group, Chain) else as_chain(group, placed.links, 0.0, mechanism.bars)
        points |= {link.name: dict(link.points) for link in chain.links}
        slides += chain.slides
    halves = {half.link for half in mechanism.halves}
    for one in mechanism.points:
        # centres of barrel and rod move as the cylinder does
        if one.link not in halves:
            points[one.link].setdefault(one.name, (one.along, one.across))
    frames = {name: (*_place_of(placed.links[name].origin), _angle_of(placed.links[name])) for name in points}
    if isinstance(driver, Crank):
        turned = driver.direction * float(placed.grid.angle[0])
        frames[driver.link] = (*frames[driver.link][:2], driver.start + turned)
        frames |= {one.link: (*frames[one.link][:2], one.start + one.ratio * turned) for one in driver.geared}
    elif isinstance(driver, Cylinder | LinkMotor):
        # barrel and rod: a piece that slides on the link and carries its far end
        far = next(name for name, place in points[driver.link].items() if place != (0.0, 0.0))
        del points[driver.link][far]
        points[rod_of(driver.link)] = {far: (0.0, 0.0)}
        slides.append(Slide(rod_of(driver.link), Guide(link=driver.link)))
        frames[rod_of(driver.link)] = (*_place_of(placed.points[far]), frames[driver.link][2])
    named = {name for own in points.values() for name in own}
    links = tuple(ChainLink(name, frames[name][:2], frames[name][2], own) for name, own in points.items())
    whole = Chain(links, tuple(slides), frozenset(named & ground.keys()), gears=tuple(gears))
    around = Placed(placed.grid, {name: fixed_point(point) for name, point in ground.items()})
    return PositionEquations(ClosingEquations(whole, 1), around), np.array(
        [one for name in points for one in frames[name]]
    )


def _place_of(point: PointMotion) -> tuple[float, float]:
    x, y = (float(np.ravel(side.position)[0]) for side in point)
    return x, y


def _angle_of(frame: LinkMotion) -> float:
    return math.atan2(float(np.ravel(frame.sin)[0]), float(np.ravel(frame.cos)[0]))


def all_circuits(mechanism: Mechanism) -> list[Circuit]:
    """Return every circuit of a linkage of dyads; of one with a chain only that of the stated position.

    Every way to put the dyads together gives stretches of the driver's coordinate; each circuit covers some of them.
    """
    if any(isinstance(group, Chain) for group in mechanism.dyads):
        return [circuit_through(mechanism)]
    signed = sum(isinstance(group, RRR | RRP | RPR) for group in mechanism.dyads)
    circuits, sweep = list[Circuit](), _sweep(mechanism)
    for signs in product(_BRANCHES, repeat=signed):
        one = with_branches(mechanism, signs)
        for piece in _stretches(one, sweep):
            at = sweep.at(np.array([piece.best]))
            _, position = _system(one, place_at(one, at))
            if all(circuit.curve.nearest(position)[1] > _SAME for circuit in circuits):
                circuits.append(circuit_at(one, at))
    return circuits


class _Sweep(NamedTuple):
    """All values of a driver's coordinate, as those of an angle between two. [deg]"""

    start: float
    end: float
    at: Callable[[Array], CrankGrid]
    turns: bool  # Whether it is back at the end where it was at the start


def _sweep(mechanism: Mechanism) -> _Sweep:
    """Return all values of the coordinate of a driver: of one that does not turn by the tangent of part of an angle."""
    driver = mechanism.driver
    if isinstance(driver, Crank):
        geared = [turns_of(one.ratio) or 1 for one in driver.geared]
        return _Sweep(0.0, 360.0 * math.lcm(*geared), CrankGrid.from_degrees, turns=True)
    if driver.turns:
        return _Sweep(0.0, 360.0, CrankGrid.from_degrees, turns=True)
    system, _ = _system(mechanism, place_at(mechanism, CrankGrid.from_radians([driver.law.start])))
    size = float(np.max(system.equations.scale))
    # a length is never below zero
    middle, part = (180.0, 2.0) if isinstance(driver, DrivingSlider) else (0.0, 4.0)

    def at(degrees: Array) -> CrankGrid:
        return CrankGrid.from_radians(size * np.tan(np.radians((degrees - middle) / part)))

    return _Sweep(_FROM_ENDS, 360.0 - _FROM_ENDS, at, turns=False)


def with_branches(mechanism: Mechanism, signs: Sequence[Branch]) -> Mechanism:
    """Return a linkage whose dyads that can be put together in two ways have given branches, in their order."""
    given = iter(signs)
    dyads = [replace(one, branch=next(given)) if isinstance(one, RRR | RRP | RPR) else one for one in mechanism.dyads]
    return replace(mechanism, dyads=tuple(dyads))


def assembled_stretches(mechanism: Mechanism) -> list[tuple[float, float]]:
    """Return the crank angles between which dyads of given signs can be assembled, over 360 where they go on. [deg]"""
    sweep = _Sweep(0.0, 360.0, CrankGrid.from_degrees, turns=True)
    return [(one.start, one.end) for one in _stretches(mechanism, sweep)]


class _Stretch(NamedTuple):
    """Between which values of a sweep something can be assembled, where it closes best, and how well. [deg], [-]"""

    start: float
    end: float
    best: float
    margin: float


def _stretches(mechanism: Mechanism, sweep: _Sweep) -> list[_Stretch]:
    """Return where dyads of given signs can be assembled, in parts where they almost change signs."""
    degrees = np.linspace(sweep.start, sweep.end, round(_SCAN * max(1.0, (sweep.end - sweep.start) / 360.0)) + 1)
    degrees = np.unique(np.concatenate([degrees, *_narrow(mechanism, sweep, degrees)]))
    margins = _margins(mechanism, sweep.at(degrees))
    works = np.all(margins > _SINGULAR, axis=0)
    cut = np.zeros(len(degrees) - 1, dtype=bool)
    grid, closures = sweep.at(degrees), Closures(mechanism)
    for index, closure in enumerate(place_at(mechanism, grid).closures):
        for interval, _ in singular_between(grid, closure, closures[index], _NEARLY_SINGULAR):
            cut[interval] = True
    least = margins.min(axis=0)
    stretches = list[_Stretch]()
    start = None
    for k, one in enumerate(works):
        if one and start is None:
            start = k
        if start is not None and (not one or k == len(works) - 1 or cut[k]):
            last = k if one else k - 1
            best = start + int(np.argmax(least[start : last + 1]))
            stretches.append(_Stretch(*map(float, (degrees[start], degrees[last], degrees[best], least[best]))))
            start = None
    if sweep.turns and len(stretches) > 1 and stretches[0].start == sweep.start and stretches[-1].end == sweep.end:
        last_one = stretches.pop()
        stretches[0] = stretches[0]._replace(start=last_one.start - sweep.end)
    clear = [one for one in stretches if one.margin > _BESIDE]
    return clear or stretches


def _margins(mechanism: Mechanism, grid: CrankGrid) -> Array:
    """Return how well each group closes at values of the driver, below zero where it does not, shape (groups, n)."""
    closures = place_at(mechanism, grid).closures
    with np.errstate(invalid="ignore"):
        rows = [np.nan_to_num(one.value / one.scale, nan=-1.0) + np.zeros(len(grid)) for one in closures]
    return np.stack(rows)


def _narrow(mechanism: Mechanism, sweep: _Sweep, degrees: Array) -> Iterator[Array]:
    """Yield the ends of what can be assembled, and values of a sweep in what lies between two of a scan. [deg]"""
    for count in range(1, len(mechanism.dyads) + 1):
        part = replace(mechanism, dyads=mechanism.dyads[:count])

        def margin(at: Array, part: Mechanism = part) -> Array:
            return np.asarray(_margins(part, sweep.at(at)).min(axis=0))

        values = margin(degrees)
        works = values > _SINGULAR
        change = np.flatnonzero(works[1:] != works[:-1])
        low, high, before = degrees[change], degrees[change + 1], works[change]
        for _ in range(_BISECTIONS if change.size else 0):
            middle = (low + high) / 2
            if np.all((middle == low) | (middle == high)):
                break
            same = (margin(middle) > _SINGULAR) == before
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        yield np.where(before, low, high)
        for one in suspects(degrees, np.where(works, -1.0, -values)):
            within = np.linspace(degrees[one], degrees[one + 1], 33)
            for _ in range(6):
                best = int(np.argmax(margin(within)))
                within = np.linspace(within[max(best - 1, 0)], within[min(best + 1, 32)], 33)
            yield within
