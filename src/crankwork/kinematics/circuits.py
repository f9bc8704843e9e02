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

from crankwork.kinematics.assembly import singular_between, suspect_intervals
from crankwork.kinematics.chain_solver import as_chain
from crankwork.kinematics.configuration_curve import (
    ConfigurationCurve,
    Configurations,
    Coordinate,
    PositionEquations,
    rod_of,
    slider_place,
    trace_curve,
)
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dead_centres import bracketed_roots
from crankwork.kinematics.dyads import LinkMotion, fixed_point
from crankwork.kinematics.kinematic_coefficients import PointMotion, Transfer
from crankwork.kinematics.loop_closure import LoopClosure
from crankwork.kinematics.position_analysis import Closures, Placed, assembled, place_at
from crankwork.mechanism.driver import Cylinder, DrivingSlider, LinkMotor
from crankwork.mechanism.dyads import RPR, RRP, RRR, Branch, Chain, ChainLink, Gear, Guide, Point, Slide
from crankwork.mechanism.mechanism import Crank, Mechanism, period_in_turns

_BRANCHES: tuple[Branch, Branch] = (1, -1)
_BETWEEN_KNOTS = 4
_SCAN = 720
_REST_TOLERANCE = 1e-11
_BISECTIONS = 60
_SINGULAR = 1e-13
# margin that divides an interval: its parts may belong to two circuits that cross or nearly cross
_NEARLY_SINGULAR = 1e-4
# margin of intervals that are nothing but rounding at a change point
_MIN_MARGIN = 1e-7
# distance from infinity up to which the coordinate of a driver is scanned [deg]
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


class CircuitPart(NamedTuple):
    """A part of a circuit from arc to arc; the end exceeds the length of the circuit where it contains the start."""

    start: float
    end: float


@dataclass(frozen=True)
class Circuit:
    """A curve of positions of a linkage; a closed one begins with the stated position."""

    mechanism: Mechanism
    curve: ConfigurationCurve

    @property
    def sliders(self) -> dict[str, Coordinate]:
        """The distance of every sliding piece along its guide. [m]"""
        return {slide.link: slider_place(slide.guide, slide.link) for slide in self.curve.system.equations.chain.slides}

    @property
    def full_part(self) -> CircuitPart:
        """The full circuit."""
        return CircuitPart(0.0, self.curve.length)

    @cached_property
    def _sampled(self) -> tuple[Array, Configurations]:
        """Positions at and between the knots."""
        knots = self.curve.arc
        parts = np.linspace(0.0, 1.0, _BETWEEN_KNOTS, endpoint=False)
        arc = np.append((knots[:-1, None] + parts * np.diff(knots)[:, None]).ravel(), knots[-1])
        return arc, self.stretch(arc)

    def stretch(self, arc: Array) -> Configurations:
        """Return the positions at some arcs."""
        q, q_1 = self.curve.at(np.asarray(arc, dtype=float))
        equations, zero = self.curve.system.equations, np.zeros_like(q)
        angles = {name: Transfer(q[:, k + 2], q_1[:, k + 2], zero[:, 0]) for name, k in equations.index.items()}
        return Configurations(angles, equations.frames(q, q_1, zero))

    def values(self, coordinate: Coordinate, arc: Array) -> Array:
        """Return a coordinate at some arcs."""
        return np.asarray(coordinate(self.stretch(arc)).position)

    def turning_points(self, coordinate: Coordinate) -> Array:
        """Return the arcs at which a coordinate reverses, ascending: the dead positions of a driver."""

        def rate(arc: Array) -> Array:
            return np.asarray(coordinate(self.stretch(arc)).position_1)

        arc, poses = self._sampled
        arc, rates = _refine_near_touching(rate, arc, np.asarray(coordinate(poses).position_1))
        moving = np.flatnonzero(np.abs(rates) > _REST_TOLERANCE)
        if not moving.size:
            return np.empty(0)
        arc, rates = arc[moving], rates[moving]
        if self.curve.is_closed and rates[0] * rates[-1] < 0 and moving[-1] - moving[0] < len(arc) - 1:
            arc, rates = np.append(arc, arc[0] + self.curve.length), np.append(rates, rates[0])
        turned = np.flatnonzero(rates[1:] * rates[:-1] < 0)
        if not turned.size:
            return np.empty(0)
        roots = bracketed_roots(rate, arc[turned], arc[turned + 1], rates[turned], rates[turned + 1])
        return np.sort(roots % self.curve.length)

    def branches(self, driver: Coordinate) -> list[CircuitPart]:
        """Return the parts between dead positions of a driver; the full circuit if there are none."""
        dead = self.turning_points(driver)
        if not dead.size:
            return [self.full_part]
        if self.curve.is_closed:
            return [
                CircuitPart(*map(float, ends))
                for ends in zip(dead, [*dead[1:], dead[0] + self.curve.length], strict=True)
            ]
        ends = [0.0, *map(float, dead), self.curve.length]
        return [CircuitPart(*pair) for pair in pairwise(ends)]

    def branch_at(self, driver: Coordinate) -> CircuitPart:
        """Return the branch at the stated position."""
        arc = self.curve.stated
        for part in self.branches(driver):
            for shift in (0.0, -self.curve.length):
                shifted = CircuitPart(part.start + shift, part.end + shift)
                if shifted.start <= arc <= shifted.end:
                    return shifted
        return self.full_part

    def extent(self, coordinate: Coordinate, part: CircuitPart | None = None) -> Extent:
        """Return the extent of a coordinate on a part, by default on the full circuit."""
        (extent,) = self.extents(coordinate, part or self.full_part)
        return extent

    def extents(self, coordinate: Coordinate, *parts: CircuitPart) -> list[Extent]:
        """Return the extent of a coordinate on each of some parts."""
        turns = self.turning_points(coordinate)
        return [self._between(coordinate, turns, part) for part in parts]

    def _between(self, coordinate: Coordinate, turns: Array, part: CircuitPart) -> Extent:
        """Return the extent of a coordinate on a part, given the arcs at which it reverses."""
        candidates = np.concatenate([turns + k * self.curve.length for k in (-1, 0, 1)])
        inside = candidates[(candidates > part.start) & (candidates < part.end)]
        arc = np.concatenate([[part.start], inside, [part.end]])
        values = self.values(coordinate, arc)
        low, high = int(np.argmin(values)), int(np.argmax(values))
        return Extent(float(values[low]), float(arc[low]), float(values[high]), float(arc[high]))

    def turns(self, link: str) -> int:
        """Return the turns of a link along the circuit."""
        k = self.curve.system.equations.index[link] + 2
        return round(float(self.curve.knots[-1, k] - self.curve.knots[0, k]) / math.tau) if self.curve.is_closed else 0


def _refine_near_touching(rate: Callable[[Array], Array], arc: Array, rates: Array) -> tuple[Array, Array]:
    """Return arcs and rates, refined where a rate of one sign may touch zero between two arcs."""
    for _ in range(4):
        same = rates[1:] * rates[:-1] > 0
        near = [interval for interval in suspect_intervals(arc, np.abs(rates)) if same[interval]]
        near = [interval for interval in near if arc[interval + 1] - arc[interval] > 1e-6]
        if not near:
            break
        more = np.concatenate([np.linspace(arc[interval], arc[interval + 1], 9)[1:-1] for interval in near])
        arc, order = np.unique(np.concatenate([arc, more]), return_index=True)
        rates = np.concatenate([rates, rate(more)])[order]
    return arc, rates


def circuit_through(mechanism: Mechanism, crank_degrees: float = 0.0) -> Circuit:
    """Return the circuit through the position at a crank angle, which must not be a change point. [deg]"""
    return circuit_at(mechanism, CrankGrid.from_degrees([crank_degrees]))


def circuit_at(mechanism: Mechanism, coordinate: CrankGrid) -> Circuit:
    """Return the circuit through the position at a value of the driver's coordinate, traced as that grows."""
    system, start = _system(mechanism, place_at(mechanism, coordinate))
    if not np.all(np.isfinite(start)):
        # refused, with the group that does not meet
        assembled(mechanism, coordinate)
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
    return Circuit(mechanism, trace_curve(system, start, ahead))


def _system(mechanism: Mechanism, placed: Placed) -> tuple[PositionEquations, Array]:
    """Return the closure equations of all links, the driving one included, and their coordinates in a position."""
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
    for point in mechanism.points:
        # centres of barrel and rod move with the cylinder
        if point.link not in halves:
            points[point.link].setdefault(point.name, (point.along, point.across))
    frames = {name: (*_place_of(placed.links[name].origin), _angle_of(placed.links[name])) for name in points}
    if isinstance(driver, Crank):
        turned = driver.direction * float(placed.grid.angle[0])
        frames[driver.link] = (*frames[driver.link][:2], driver.start + turned)
        frames |= {crank.link: (*frames[crank.link][:2], crank.start + crank.ratio * turned) for crank in driver.geared}
    elif isinstance(driver, Cylinder | LinkMotor):
        # barrel and rod: a piece that slides on the link and carries its far end
        far = next(name for name, place in points[driver.link].items() if place != (0.0, 0.0))
        del points[driver.link][far]
        points[rod_of(driver.link)] = {far: (0.0, 0.0)}
        slides.append(Slide(rod_of(driver.link), Guide(link=driver.link)))
        frames[rod_of(driver.link)] = (*_place_of(placed.points[far]), frames[driver.link][2])
    named = {name for own in points.values() for name in own}
    links = tuple(ChainLink(name, frames[name][:2], frames[name][2], own) for name, own in points.items())
    full_chain = Chain(links, tuple(slides), frozenset(named & ground.keys()), gears=tuple(gears))
    around = Placed(placed.grid, {name: fixed_point(position) for name, position in ground.items()})
    coordinates = np.array([coordinate for name in points for coordinate in frames[name]])
    return PositionEquations(LoopClosure(full_chain, 1), around), coordinates


def _place_of(point: PointMotion) -> tuple[float, float]:
    x, y = (float(np.ravel(side.position)[0]) for side in point)
    return x, y


def _angle_of(frame: LinkMotion) -> float:
    return math.atan2(float(np.ravel(frame.sin)[0]), float(np.ravel(frame.cos)[0]))


def all_circuits(mechanism: Mechanism) -> list[Circuit]:
    """Return every circuit of a linkage of dyads; of one with a chain only that of the stated position.

    Each combination of branches gives intervals of the driver's coordinate, and each circuit covers some of them.
    """
    if any(isinstance(group, Chain) for group in mechanism.dyads):
        return [circuit_through(mechanism)]
    signed = sum(isinstance(group, RRR | RRP | RPR) for group in mechanism.dyads)
    circuits, sweep = list[Circuit](), _sweep(mechanism)
    for signs in product(_BRANCHES, repeat=signed):
        variant = with_branches(mechanism, signs)
        for piece in _stretches(variant, sweep):
            coordinate = sweep.grid_at(np.array([piece.best]))
            _, position = _system(variant, place_at(variant, coordinate))
            if all(circuit.curve.nearest(position)[1] > _SAME for circuit in circuits):
                circuits.append(circuit_at(variant, coordinate))
    return circuits


class _Sweep(NamedTuple):
    """All values of a driver's coordinate as a function of an angle. [deg]"""

    start: float
    end: float
    grid_at: Callable[[Array], CrankGrid]
    turns: bool  # Whether the end is the position of the start


def _sweep(mechanism: Mechanism) -> _Sweep:
    """Return the sweep of a driver's coordinate; one that does not turn is the tangent of part of an angle."""
    driver = mechanism.driver
    if isinstance(driver, Crank):
        geared = [period_in_turns(crank.ratio) or 1 for crank in driver.geared]
        return _Sweep(0.0, 360.0 * math.lcm(*geared), CrankGrid.from_degrees, turns=True)
    if driver.turns:
        return _Sweep(0.0, 360.0, CrankGrid.from_degrees, turns=True)
    system, _ = _system(mechanism, place_at(mechanism, CrankGrid.from_radians([driver.law.start])))
    size = float(np.max(system.equations.scale))
    # a length is never negative
    middle, part = (180.0, 2.0) if isinstance(driver, DrivingSlider) else (0.0, 4.0)

    def coordinates(degrees: Array) -> CrankGrid:
        return CrankGrid.from_radians(size * np.tan(np.radians((degrees - middle) / part)))

    return _Sweep(_FROM_ENDS, 360.0 - _FROM_ENDS, coordinates, turns=False)


def with_branches(mechanism: Mechanism, signs: Sequence[Branch]) -> Mechanism:
    """Return a linkage with given branches of the dyads with two ways of assembly, in their order."""
    given = iter(signs)
    dyads = [
        replace(group, branch=next(given)) if isinstance(group, RRR | RRP | RPR) else group for group in mechanism.dyads
    ]
    return replace(mechanism, dyads=tuple(dyads))


def assembled_stretches(mechanism: Mechanism) -> list[tuple[float, float]]:
    """Return the ranges of crank angles in which dyads of given branches meet, over 360 beyond a turn. [deg]"""
    sweep = _Sweep(0.0, 360.0, CrankGrid.from_degrees, turns=True)
    return [(stretch.start, stretch.end) for stretch in _stretches(mechanism, sweep)]


class _Stretch(NamedTuple):
    """An interval of a sweep that can be assembled, where its margin is largest, and that margin. [deg], [-]"""

    start: float
    end: float
    best: float
    margin: float


def _stretches(mechanism: Mechanism, sweep: _Sweep) -> list[_Stretch]:
    """Return the intervals in which dyads of given branches can be assembled, divided where one is nearly singular."""
    degrees = np.linspace(sweep.start, sweep.end, round(_SCAN * max(1.0, (sweep.end - sweep.start) / 360.0)) + 1)
    degrees = np.unique(np.concatenate([degrees, *_narrow(mechanism, sweep, degrees)]))
    margins = _margins(mechanism, sweep.grid_at(degrees))
    works = np.all(margins > _SINGULAR, axis=0)
    cut = np.zeros(len(degrees) - 1, dtype=bool)
    grid, closures = sweep.grid_at(degrees), Closures(mechanism)
    for index, closure in enumerate(place_at(mechanism, grid).closures):
        for interval, _ in singular_between(grid, closure, closures[index], _NEARLY_SINGULAR):
            cut[interval] = True
    least = margins.min(axis=0)
    stretches = list[_Stretch]()
    start = None
    for k, closes in enumerate(works):
        if closes and start is None:
            start = k
        if start is not None and (not closes or k == len(works) - 1 or cut[k]):
            last = k if closes else k - 1
            best = start + int(np.argmax(least[start : last + 1]))
            stretches.append(_Stretch(*map(float, (degrees[start], degrees[last], degrees[best], least[best]))))
            start = None
    if sweep.turns and len(stretches) > 1 and stretches[0].start == sweep.start and stretches[-1].end == sweep.end:
        last_one = stretches.pop()
        stretches[0] = stretches[0]._replace(start=last_one.start - sweep.end)
    clear = [stretch for stretch in stretches if stretch.margin > _MIN_MARGIN]
    return clear or stretches


def _margins(mechanism: Mechanism, grid: CrankGrid) -> Array:
    """Return the closure of each group over its scale, -1 where it does not close, shape (groups, n)."""
    closures = place_at(mechanism, grid).closures
    with np.errstate(invalid="ignore"):
        rows = [np.nan_to_num(closure.value / closure.scale, nan=-1.0) + np.zeros(len(grid)) for closure in closures]
    return np.stack(rows)


def _narrow(mechanism: Mechanism, sweep: _Sweep, degrees: Array) -> Iterator[Array]:
    """Yield bisected ends of intervals that can be assembled, and samples where a scan may miss one. [deg]"""
    for count in range(1, len(mechanism.dyads) + 1):
        part = replace(mechanism, dyads=mechanism.dyads[:count])

        def margin(angles: Array, part: Mechanism = part) -> Array:
            return np.asarray(_margins(part, sweep.grid_at(angles)).min(axis=0))

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
        for interval in suspect_intervals(degrees, np.where(works, -1.0, -values)):
            within = np.linspace(degrees[interval], degrees[interval + 1], 33)
            for _ in range(6):
                best = int(np.argmax(margin(within)))
                within = np.linspace(within[max(best - 1, 0)], within[min(best + 1, 32)], 33)
            yield within
