"""The vector equations of the groups of a linkage, and its plans as they are constructed from them on paper.

Every length that is laid off and every point that is found is rounded to the precision of the drawing, and the next
vector starts there, so that errors grow as they do by hand.
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
from crankwork.mechanism.driver import DrivingSlider
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Chain, Dyad
from crankwork.mechanism.joints import group_links
from crankwork.mechanism.mechanism import Crank, Mechanism


class PlanVector(NamedTuple):
    """A vector of a plan: name of its points, kind, its components on paper [mm], its line.

    `known`: 2 of a vector whose magnitude and direction are known before its group is solved, 1 of one whose line is,
    else 0; `line`: `⊥BA`, `∥BA`, or `∥4` along the guide of link 4; `link`, `arm`: number of the link that turns with
    it, or carries the guide, and distance of its points [m].
    """

    name: str
    kind: Kind
    drawn: complex
    known: int = 2
    line: str = ""
    link: int = 0
    arm: float = 0.0


class VectorEquation(NamedTuple):
    """The vector on the left equals the sum of those on the right, of which a point on a fixed guide has none."""

    left: PlanVector
    right: tuple[PlanVector, ...]


class ConstructedPlan(NamedTuple):
    """The equations of each group; points found by similarity; how fast links turn by number [rad/s] or [rad/s2]."""

    groups: tuple[tuple[VectorEquation, ...], ...]
    similar: tuple[PlanVector, ...]
    turning: dict[int, float]


class PlanScales(NamedTuple):
    """Scales of positions, velocities and accelerations. [m/mm], [(m/s)/mm], [(m/s2)/mm]"""

    length: float
    velocity: float
    acceleration: float


class _Side(NamedTuple):
    """One of the two vectors that find a point: `node` against `base`, both on a link, or sliding on its guide."""

    node: str
    base: str  # Empty where the guide is fixed
    link: str  # The link of both points, or that which carries the guide
    piece: str = ""  # What slides


def constructed_plans(
    results: Results, degrees: float, scales: PlanScales, precision: float, links: tuple[str, ...] = ()
) -> tuple[ConstructedPlan, ConstructedPlan] | None:
    """Return the plans of velocities and accelerations at a crank angle. [deg]

    `precision`: of points and lengths on paper, 0 for exact plans [mm]; `links`: in the order of their numbers.
    None of a linkage that is not constructed so.
    """
    if not is_constructed(results.machine.mechanism):
        return None
    paper = _Paper(results, degrees, scales, precision, links)
    try:
        return paper.plan(1), paper.plan(2)
    except ZeroDivisionError:
        # in a dead position the two lines are parallel
        return None


def is_constructed(mechanism: Mechanism) -> bool:
    """Return whether a crank or a slider drives groups each of which two lines solve."""
    unsolved = (isinstance(group, Chain) or (isinstance(group, RPP) and group.guide.link) for group in mechanism.dyads)
    return bool(mechanism.dyads) and isinstance(mechanism.driver, Crank | DrivingSlider) and not any(unsolved)


def _plane(vector: Array) -> complex:
    return complex(float(vector[0]), float(vector[1]))


def _cross(first: complex, second: complex) -> float:
    return (first.conjugate() * second).imag


class _Paper:
    """The drawing of the positions and the plans constructed from it."""

    def __init__(
        self, results: Results, degrees: float, scales: PlanScales, precision: float, links: tuple[str, ...]
    ) -> None:
        self._mechanism = mechanism = results.machine.mechanism
        self._shape, self._scales, self._precision = skeleton(mechanism, links), scales, precision
        self._moving = moving = sample_motion(mechanism, [degrees])
        rates = driver_rates(results, results.columns_at(np.array([degrees])))
        given = float(rates.first[0]), float(rates.second[0])
        # of these only what the cranks give is taken
        self._given = (
            velocities(mechanism, moving, 0, given[0], links),
            accelerations(mechanism, moving, 0, *given, links),
        )
        letters = self._shape.letters
        self._fixed = {letters[name]: complex(*place) for name, place in self._shape.pivots.items()}
        self._places = self._fixed | {
            letters[name]: _plane(track.place[0]) for name, track in moving.points.items() if name in letters
        }
        self._sliding = {under: over for under, (_, over) in self._given[0].coincident.items()}
        self._places |= {under: self._places[over] for under, over in self._sliding.items()}
        self._drawn = {name: self._rounded(place / scales.length) for name, place in self._places.items()}
        # ends of the vectors from the pole of the plan in hand and of that of velocities; of each link a point and the
        # ratio of its plan to its drawing; how fast links turn by both plans
        self._nodes, self._velocities = dict[str, complex](), dict[str, complex]()
        self._images, self._rates = dict[str, tuple[str, complex]](), (dict[str, float](), dict[str, float]())

    def _read(self, length: float) -> float:
        return round(length / self._precision) * self._precision if self._precision else length

    def _rounded(self, place: complex) -> complex:
        return complex(self._read(place.real), self._read(place.imag))

    def _number(self, link: str) -> int:
        return self._shape.member(link).number

    def _sides(self, dyad: Dyad) -> tuple[str, _Side, _Side]:
        """Return the point that a group finds, and the two vectors that find it."""
        letters = self._shape.letters

        def on_guide(point: str, piece: str, carrier: str) -> _Side:
            under = f"{letters[point]}{self._number(carrier)}" if carrier else ""
            return _Side(letters[point], under, carrier, piece)

        match dyad:
            case RRR():
                node, ends = letters[dyad.point], ((dyad.joint_a, dyad.link_a), (dyad.joint_b, dyad.link_b))
                first, second = (_Side(node, letters[base], link) for base, link in ends)
                return node, first, second
            case RRP():
                node = letters[dyad.slider]
                turning = _Side(node, letters[dyad.joint], dyad.link)
                return node, turning, on_guide(dyad.slider, dyad.piece, dyad.guide_link)
            case PRP():
                guides = (dyad.block_a, dyad.guide_a.link), (dyad.block_b, dyad.guide_b.link)
                first, second = (on_guide(dyad.point, *guide) for guide in guides)
                return first.node, first, second
            case RPR():
                along = on_guide(dyad.joint, dyad.block, dyad.link)
                return along.base, _Side(along.base, letters[dyad.pivot], dyad.link), along
            case RPP():
                along = on_guide(dyad.joint, dyad.block, dyad.link)
                return along.base, _Side(along.base, "", "", dyad.link), along

    def plan(self, order: int) -> ConstructedPlan:
        """Return the plan of velocities, 1, which comes first, or of accelerations, 2."""
        self._order, self._velocities, self._images = order, self._nodes, {}
        self._scale = self._scales[order]
        self._nodes = {"": 0j, **dict.fromkeys(self._fixed, 0j)}
        self._drive()
        groups, similar = [], list[str]()
        for group in self._mechanism.dyads:
            if not isinstance(group, Chain):
                groups.append(self._solved(*self._sides(group)))
                similar += [letter for link in group_links(group) for letter in self._completed(link)]
        rates = {self._number(link): rate for link, rate in self._rates[order - 1].items()}
        return ConstructedPlan(tuple(groups), tuple(self._absolute(letter) for letter in similar), rates)

    def _drive(self) -> None:
        """Put the points of cranks on the plan: they are given."""
        driver, plan = self._mechanism.driver, self._given[self._order - 1]
        geared = driver.geared if isinstance(driver, Crank) else ()
        for link in (driver.link, *(crank.link for crank in geared)):
            self._rates[self._order - 1][link] = plan.turning.get(self._number(link), 0.0)
            letters = [self._shape.letters[name] for name in self._shape.member(link).points]
            for letter in letters[len(letters) > 1 :]:
                exact = _plane(plan.nodes[letter])
                size = abs(exact)
                self._nodes[letter] = self._rounded(exact / size * self._read(size / self._scale)) if size else 0j
                # a piece that slides does not turn
                arm = self._drawn[letter] - self._drawn[letters[0]]
                self._images[link] = letters[0], self._nodes[letter] / arm if arm else 0j

    def _completed(self, link: str) -> Iterator[str]:
        """Put the other points of a link on the plan, and yield them."""
        further = [point.name for point in self._mechanism.points if point.link == link]
        for name in dict.fromkeys([*self._shape.member(link).points, *further]):
            letter = self._shape.letters.get(name, "")
            if letter in self._drawn and letter not in self._nodes:
                self._find(link, letter)
                yield letter

    def _find(self, link: str, letter: str) -> None:
        """Put a point of a link on the plan, whose figure is similar to that of the link."""
        base, ratio = self._images[link]
        self._nodes[letter] = self._rounded(self._nodes[base] + ratio * (self._drawn[letter] - self._drawn[base]))

    def _solved(self, node: str, *sides: _Side) -> tuple[VectorEquation, ...]:
        """Return the equations of a group; its point lies where two lines cross, each through what is known."""
        for side in sides:
            if side.base not in (*self._nodes, node):
                self._find(side.link, side.base)
        (start, along), (other, across) = (self._line(side, node) for side in sides)
        self._nodes[node] = self._rounded(start + _cross(other - start, across) / _cross(along, across) * along)
        return tuple(self._equation(side, node) for side in sides)

    def _line(self, side: _Side, unknown: str) -> tuple[complex, complex]:
        """Return a point and the direction of the line on which one side of a group has its unknown point. [mm]"""
        along = self._guide(side) if side.piece else 1j * self._arm(side)
        if side.base == unknown:
            return self._nodes[side.node] - self._known(side), along
        return self._rounded(self._nodes[side.base] + self._known(side)), along

    def _arm(self, side: _Side) -> complex:
        return self._drawn[side.node] - self._drawn[side.base]

    def _length(self, side: _Side) -> float:
        """Return the length of a link between its points: given, or on a lever measured up to the block. [m]"""
        if side.node in self._sliding:
            return self._read(abs(self._arm(side))) * self._scales.length
        return abs(self._places[side.node] - self._places[side.base])

    def _guide(self, side: _Side) -> complex:
        """Return the direction of a guide as drawn: that of a link follows from the points of the link."""
        guide = self._shape.member(side.piece).guide
        assert guide is not None  # noqa: S101 - a piece slides
        along = _plane(guide_pose(guide, self._moving).along[0])
        if not side.link:
            return along
        first, *letters = [*(self._shape.letters[name] for name in self._shape.member(side.link).points), side.base]
        end = max(letters or [first], key=lambda letter: abs(self._places[letter] - self._places[first]))
        exact = self._places[end] - self._places[first]
        return along * (self._drawn[end] - self._drawn[first]) / exact if exact else along

    def _known(self, side: _Side) -> complex:
        """Return the part of a relative acceleration that follows from the velocities, none of a velocity. [mm]"""
        if self._order == 1 or not side.link:
            return 0j
        relative = self._velocities[side.node] - self._velocities[side.base]
        speed = self._read(abs(relative)) * self._scales.velocity
        if not side.piece:
            return -self._arm(side) / abs(self._arm(side)) * self._read(speed**2 / self._length(side) / self._scale)
        rate = self._rates[0].get(side.link, 0.0)
        size = math.copysign(self._read(2 * abs(rate) * speed / self._scale), rate)
        return 1j * size * relative / abs(relative) if relative else 0j

    def _equation(self, side: _Side, unknown: str) -> VectorEquation:
        """Return an equation of the solved point, and remember how its links turn."""
        relative, known = self._nodes[side.node] - self._nodes[side.base], self._known(side)
        if side.piece:
            self._images[side.piece] = side.node, self._images[side.link][1] if side.link else 0j
        else:
            self._images[side.link] = side.base, relative / self._arm(side)
            size = self._read(abs(relative - known)) * self._scale / self._length(side)
            self._rates[self._order - 1][side.link] = math.copysign(size, _cross(self._arm(side), relative - known))
        line, name = str(self._number(side.piece)) if side.piece else side.node + side.base, side.node + side.base
        if not side.link:
            return VectorEquation(self._absolute(side.node, 1, f"∥{line}"), ())
        left, base = (self._absolute(letter, 0 if letter == unknown else 2) for letter in (side.node, side.base))
        link, length = self._number(side.link), self._length(side)
        marks: tuple[str, str] = ("∥", "⊥") if side.piece else ("⊥", "∥")
        kinds: tuple[Kind, Kind, Kind] = (
            ("sliding", "coriolis", "sliding") if side.piece else ("relative", "normal", "tangential")
        )
        if self._order == 1:
            return VectorEquation(left, (base, PlanVector(name, kinds[0], relative, 1, marks[0] + line, link, length)))
        first = PlanVector(name, kinds[1], known, 2, marks[1] + line, link, length)
        return VectorEquation(
            left, (base, first, PlanVector(name, kinds[2], relative - known, 1, marks[0] + line, link, length))
        )

    def _absolute(self, letter: str, known: int = 2, line: str = "") -> PlanVector:
        return PlanVector(letter, "absolute", self._nodes[letter], known, line)
