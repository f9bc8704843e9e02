"""The vector equations of the groups of a linkage, and its plans as they are constructed from them on paper.

A plan is constructed as by hand: every length that is laid off and every point found is rounded to the precision of the
drawing, and the next vector starts from it, so that errors grow as they do on paper.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from crankwork.analysis.results import Results
from crankwork.analysis.sampled_motion import sample_motion
from crankwork.analysis.skeleton import guide_pose, skeleton
from crankwork.analysis.vector_polygons import Kind, accelerations, driver_rates, velocities
from crankwork.kinematics.crank_grid import Array
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Dyad
from crankwork.mechanism.joints import group_links
from crankwork.mechanism.mechanism import Crank

# parts of the relative accelerations of points of a link, and of a point on a guide
_TURNING: tuple[Kind, Kind] = ("normal", "tangential")
_SLIDING: tuple[Kind, Kind] = ("coriolis", "sliding")


class PlanVector(NamedTuple):
    """A vector of a plan: name of its points, kind, what is known of it, its line, its exact and its drawn components.

    `known`: 2 of a vector whose magnitude and direction are known before its group is solved, 1 of one whose direction
    is, 0 of any other; `line`: `⊥BA` or `∥BA`, `∥4` along the guide of link 4, empty of an absolute vector.
    """

    name: str
    kind: Kind
    known: int
    line: str
    exact: complex  # [m/s] or [m/s2]
    drawn: complex  # [mm]
    length: float  # Of the drawn one, as it is read [mm]
    link: int = 0  # Number of the link that turns with it, or that carries the guide
    arm: float = 0.0  # Distance of its two points [m]


class VectorEquation(NamedTuple):
    """The vector on the left equals the sum of those on the right."""

    left: PlanVector
    right: tuple[PlanVector, ...]


class GroupEquations(NamedTuple):
    """The equations of the links with these numbers."""

    links: tuple[int, ...]
    equations: tuple[VectorEquation, ...]


class ConstructedPlan(NamedTuple):
    """The equations of all groups, points by similarity, rates of links exact and from the plan."""

    groups: tuple[GroupEquations, ...]
    similar: tuple[PlanVector, ...]
    turning: dict[int, tuple[float, float]]  # By number of the link [rad/s] or [rad/s2]


class PlanScales(NamedTuple):
    """Scales of positions, velocities and accelerations, and the precision of points and lengths on paper. [mm]"""

    length: float  # [m/mm]
    velocity: float  # [(m/s)/mm]
    acceleration: float  # [(m/s2)/mm]
    precision: float


class _Side(NamedTuple):
    """One of the two vectors that find a point: `node` against `base`, both on a link, or sliding on its guide."""

    node: str
    base: str  # Empty where the guide is fixed
    link: str  # The link of both points, or that which carries the guide
    piece: str = ""  # What slides


class _Group(NamedTuple):
    """A group: its links, the point that its two sides find."""

    links: tuple[str, ...]
    node: str
    sides: tuple[_Side, _Side]


def constructed_plans(
    results: Results, degrees: float, scales: PlanScales, links: tuple[str, ...] = ()
) -> tuple[ConstructedPlan, ConstructedPlan] | None:
    """Return the plans of velocities and accelerations at a crank angle [deg]; `links`: in the order of their numbers.

    None of a linkage that no crank drives, of one with a group of a higher class, which two lines do not solve, and
    where the two lines of a group are parallel.
    """
    mechanism = results.machine.mechanism
    moving_yoke = any(isinstance(group, RPP) and group.guide.link for group in mechanism.dyads)
    higher = any(isinstance(group, Chain) for group in mechanism.dyads)
    if not isinstance(mechanism.driver, Crank) or moving_yoke or higher:
        return None
    paper = _Paper(results, degrees, scales, links)
    try:
        return paper.plan(1), paper.plan(2)
    except ZeroDivisionError:
        return None


def _plane(vector: Array) -> complex:
    return complex(float(vector[0]), float(vector[1]))


def _cross(first: complex, second: complex) -> float:
    return (first.conjugate() * second).imag


class _Paper:
    """The drawing of the positions and the plans constructed from it, with the exact plans beside them."""

    def __init__(self, results: Results, degrees: float, scales: PlanScales, links: tuple[str, ...]) -> None:
        self._mechanism = mechanism = results.machine.mechanism
        self._shape, self._scales = skeleton(mechanism, links), scales
        self._moving = moving = sample_motion(mechanism, [degrees])
        rates = driver_rates(results, results.columns_at(np.array([degrees])))
        first, second = float(rates.first[0]), float(rates.second[0])
        self._exact = (
            velocities(mechanism, moving, 0, first, links),
            accelerations(mechanism, moving, 0, first, second, links),
        )
        letters = self._shape.letters
        self._fixed = {letters[name]: complex(*place) for name, place in self._shape.pivots.items()}
        tracks = {letters[name]: track for name, track in moving.points.items() if name in letters}
        self._places = self._fixed | {name: _plane(track.place[0]) for name, track in tracks.items()}
        self._places |= {under: self._places[over] for under, (_, over) in self._exact[0].coincident.items()}
        self._drawn = {name: self._rounded(place / scales.length) for name, place in self._places.items()}
        self._groups = [self._group(group) for group in mechanism.dyads if not isinstance(group, Chain)]
        # nodes of the plan in hand, and of that of velocities
        self._nodes: dict[str, complex] = {}
        self._velocities: dict[str, complex] = {}
        # of each link a point and the ratio of its plan to its drawing, and how fast it turns by the plan
        self._images: dict[str, tuple[str, complex]] = {}
        self._rates: tuple[dict[str, float], dict[str, float]] = ({}, {})
        # points of links beside those that the groups find
        self._further: list[str] = []

    def _rounded(self, place: complex) -> complex:
        return complex(self._read(place.real), self._read(place.imag))

    def _read(self, length: float) -> float:
        return round(length / self._scales.precision) * self._scales.precision

    def _number(self, link: str) -> int:
        return self._shape.member(link).number

    def _group(self, dyad: Dyad) -> _Group:
        """Return what finds the point in which the two links of a group meet."""
        letters, links = self._shape.letters, group_links(dyad)

        def on_guide(point: str, piece: str, carrier: str) -> _Side:
            under = f"{letters[point]}{self._number(carrier)}" if carrier else ""
            return _Side(letters[point], under, carrier, piece)

        match dyad:
            case RRR(point=point):
                ends = (dyad.joint_a, dyad.link_a), (dyad.joint_b, dyad.link_b)
                first, second = (_Side(letters[point], letters[base], link) for base, link in ends)
            case RRP(slider=point):
                first = _Side(letters[point], letters[dyad.joint], dyad.link)
                second = on_guide(point, dyad.piece, dyad.guide_link)
            case PRP(point=point):
                first = on_guide(point, dyad.block_a, dyad.guide_a.link)
                second = on_guide(point, dyad.block_b, dyad.guide_b.link)
            case RPR() | RPP():
                second = on_guide(dyad.joint, dyad.block, dyad.link)
                first = _Side(second.base, "", "", dyad.link)
                if isinstance(dyad, RPR):
                    first = _Side(second.base, letters[dyad.pivot], dyad.link)
                return _Group(links, second.base, (first, second))
        return _Group(links, letters[point], (first, second))

    def plan(self, order: int) -> ConstructedPlan:
        """Return the plan of velocities, 1, which comes first, or of accelerations, 2."""
        self._order, self._velocities, self._images, self._further = order, self._nodes, {}, []
        self._nodes = {"": 0j, **dict.fromkeys(self._fixed, 0j)}
        self._scale = self._scales.velocity if order == 1 else self._scales.acceleration
        self._drive()
        groups = tuple(self._solved(group) for group in self._groups)
        similar = tuple(self._absolute(name) for name in self._further)
        exact = self._exact[order - 1].turning
        rates = {self._number(link): rate for link, rate in self._rates[order - 1].items()}
        return ConstructedPlan(groups, similar, {number: (exact[number], rate) for number, rate in rates.items()})

    def _complete(self, link: str) -> None:
        """Put the other points of a link on the plan."""
        further = [point.name for point in self._mechanism.points if point.link == link]
        for name in dict.fromkeys([*self._shape.member(link).points, *further]):
            letter = self._shape.letters.get(name, "")
            if letter in self._drawn and letter not in self._nodes and link in self._images:
                self._find(link, letter)
                self._further.append(letter)

    def _find(self, link: str, letter: str) -> None:
        """Put a point of a link on the plan, whose figure is similar to that of the link."""
        base, ratio = self._images[link]
        self._nodes[letter] = self._rounded(self._nodes[base] + ratio * (self._drawn[letter] - self._drawn[base]))

    def _drive(self) -> None:
        """Put the points of cranks on the plan: they are given."""
        driver, plan = self._mechanism.driver, self._exact[self._order - 1]
        geared = driver.geared if isinstance(driver, Crank) else ()
        for link in (driver.link, *(crank.link for crank in geared)):
            self._rates[self._order - 1][link] = plan.turning[self._number(link)]
            base, *names = (self._shape.letters[name] for name in self._shape.member(link).points)
            for name in names:
                exact = _plane(plan.nodes[name])
                size = abs(exact)
                self._nodes[name] = self._rounded(exact / size * self._read(size / self._scale)) if size else 0j
                self._images[link] = base, self._nodes[name] / (self._drawn[name] - self._drawn[base])

    def _solved(self, group: _Group) -> GroupEquations:
        """Return the equations of a group; its point lies where two lines cross, each through what is known."""
        for side in group.sides:
            if side.base not in (*self._nodes, group.node):
                self._find(side.link, side.base)
        (start, along), (other, across) = (self._line(side, group.node) for side in group.sides)
        self._nodes[group.node] = self._rounded(start + _cross(other - start, across) / _cross(along, across) * along)
        for side in sorted(group.sides, key=lambda side: bool(side.piece and side.link)):
            self._turn(side)
        for link in group.links:
            self._complete(link)
        numbers = tuple(self._number(link) for link in group.links)
        return GroupEquations(numbers, tuple(self._equation(side, group.node) for side in group.sides))

    def _line(self, side: _Side, unknown: str) -> tuple[complex, complex]:
        """Return a point and the direction of the line on which one side of a group has its unknown point. [mm]"""
        along = self._guide(side) if side.piece else 1j * self._arm(side)
        if side.base == unknown:
            return self._nodes[side.node] - self._known(side), along
        return self._rounded(self._nodes[side.base] + self._known(side)), along

    def _arm(self, side: _Side) -> complex:
        return self._drawn[side.node] - self._drawn[side.base]

    def _length(self, side: _Side) -> float:
        """Return the length of a link between its points: given, or on a lever measured where the block is. [m]"""
        if side.node in self._exact[0].coincident:
            return self._read(abs(self._arm(side))) * self._scales.length
        return abs(self._places[side.node] - self._places[side.base])

    def _guide(self, side: _Side) -> complex:
        """Return the direction of a guide as drawn: that of a link follows from the points of the link."""
        guide = self._shape.member(side.piece).guide
        assert guide is not None  # noqa: S101 - a piece slides
        along = _plane(guide_pose(guide, self._moving).along[0])
        if not side.link:
            return along
        first, *names = (self._shape.letters[name] for name in self._shape.member(side.link).points)
        end = max((*names, side.base), key=lambda name: abs(self._places[name] - self._places[first]))
        exact = self._places[end] - self._places[first]
        return along * (self._drawn[end] - self._drawn[first]) / exact if exact else along

    def _known(self, side: _Side) -> complex:
        """Return the part of a relative acceleration that follows from the velocities, none of a velocity. [mm]"""
        if self._order == 1 or (side.piece and not side.link):
            return 0j
        relative = self._velocities[side.node] - self._velocities[side.base]
        speed = self._read(abs(relative)) * self._scales.velocity
        if side.piece:
            rate = self._rates[0].get(side.link, 0.0)
            across = 1j * relative / abs(relative) if relative else 0j
            return across * math.copysign(self._read(2 * abs(rate) * speed / self._scale), rate)
        return -self._arm(side) / abs(self._arm(side)) * self._read(speed**2 / self._length(side) / self._scale)

    def _turn(self, side: _Side) -> None:
        """Remember how the link of a side turns, by the plan."""
        if side.piece:
            self._images[side.piece] = side.node, self._images[side.link][1] if side.link else 0j
            return
        ratio = (self._nodes[side.node] - self._nodes[side.base]) / self._arm(side)
        across = self._nodes[side.node] - self._nodes[side.base] - self._known(side)
        size = self._read(abs(across)) * self._scale / self._length(side)
        self._images[side.link] = side.base, ratio
        self._rates[self._order - 1][side.link] = math.copysign(size, _cross(self._arm(side), across))

    def _equation(self, side: _Side, unknown: str) -> VectorEquation:
        if side.piece and not side.link:
            line = f"∥{self._number(side.piece)}"
            return VectorEquation(self._absolute(side.node, 1, line), ())
        left, base = (self._absolute(name, 0 if name == unknown else 2) for name in (side.node, side.base))
        return VectorEquation(left, (base, *self._parts(side)))

    def _absolute(self, name: str, known: int = 2, line: str = "") -> PlanVector:
        exact = self._exact[self._order - 1].nodes.get(name)
        return self._vector(name, "absolute", known, line, 0j if exact is None else _plane(exact), self._nodes[name])

    def _parts(self, side: _Side) -> Iterator[PlanVector]:
        """Yield the relative velocity of a side, or the two parts of its relative acceleration."""
        name, plan = side.node + side.base, self._exact[self._order - 1]
        ends = [plan.nodes.get(letter, np.zeros(2)) for letter in (side.node, side.base)]
        exact = _plane(ends[0] - ends[1])
        drawn = self._nodes[side.node] - self._nodes[side.base]
        line = f"∥{self._number(side.piece)}" if side.piece else f"⊥{side.node}{side.base}"
        number = self._number(side.link)
        arm = self._places[side.node] - self._places[side.base]
        rate = self._exact[0].turning.get(number, 0.0)

        def part(kind: Kind, known: int, line: str, exact: complex, drawn: complex) -> PlanVector:
            return self._vector(name, kind, known, line, exact, drawn)._replace(link=number, arm=abs(arm))

        if self._order == 1:
            yield part("sliding" if side.piece else "relative", 1, line, exact, drawn)
            return
        if side.piece:
            first = [_plane(self._exact[0].nodes[letter]) for letter in (side.node, side.base)]
            known = 2j * rate * (first[0] - first[1])
            kinds, across = _SLIDING, f"⊥{self._number(side.piece)}"
        else:
            known, kinds, across = -(rate**2) * arm, _TURNING, f"∥{side.node}{side.base}"
        laid_off = self._known(side)
        yield part(kinds[0], 2, across, known, laid_off)
        yield part(kinds[1], 1, line, exact - known, drawn - laid_off)

    def _vector(self, name: str, kind: Kind, known: int, line: str, exact: complex, drawn: complex) -> PlanVector:
        return PlanVector(name, kind, known, line, exact, drawn, self._read(abs(drawn)))
