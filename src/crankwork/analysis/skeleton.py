"""A mechanism as a drawing needs it: links with their points, sliding pieces with their guides, letters, numbers."""

from __future__ import annotations

import string
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from crankwork.analysis.sampled_motion import Frame, SampledMotion
from crankwork.kinematics.crank_grid import Array
from crankwork.mechanism.driver import Cylinder, DrivingSlider, rod_name
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Chain, Dyad, Guide, Point
from crankwork.mechanism.mechanism import Crank, Mechanism

PIVOT = "crank pivot"
_CATALOG = frozenset((
    "crank_pin", "piston_pin", "coupler_pin", "coupler_point", "rocker_pin", "rocker_pivot", "second_pin",
    "output_pin", "output_pivot", "lever_pivot", "upper_pivot", "tip", "ram_pin", "knee", "punch_pin",
    "rod_centre", "rocker_centre",
))  # fmt: skip
_LETTERS = "ABCDEFGHIJKLMNPQRTUVWXYZ" + string.ascii_lowercase


class Member(NamedTuple):
    """A moving link: name, number, its points that are joints or coupler points, and the guide it slides on."""

    name: str
    number: int
    points: tuple[str, ...]
    guide: Guide | None = None
    has_rod: bool = False
    rod: int = 0  # Number of the rod of a cylinder, whose barrel is the link: from the first point to the second


class Skeleton(NamedTuple):
    """A mechanism as it is drawn."""

    members: tuple[Member, ...]  # Moving links, the driving one first
    pivots: Mapping[str, Point]  # Joints with the ground, that of a crank first [m]
    # Points that are no joints: those that draw a path, and centres of mass
    coupler_points: tuple[str, ...]
    centres: tuple[str, ...]
    letters: Mapping[str, str]  # Labels of points
    pin: str = ""  # The pin of a crank, whose path is drawn too

    @property
    def driver(self) -> Member:
        """The driving link; of a motor between two the first."""
        return self.members[0]

    @property
    def driven(self) -> str:
        """The point that shows how the driving link moves: the pin of a crank, the end of a rod."""
        return self.pin or next((point for point in self.driver.points[::-1] if point not in self.pivots), "")

    @property
    def traced(self) -> tuple[str, ...]:
        """The points whose paths are drawn."""
        return (*([self.pin] if self.pin else []), *self.coupler_points)

    def member(self, name: str) -> Member:
        """Return the moving link of a name."""
        return next(member for member in self.members if member.name == name)


def skeleton(mechanism: Mechanism, links: Sequence[str] = ()) -> Skeleton:
    """Return a mechanism as it is drawn.

    `links`: the moving links in the order of their numbers, as `Structure.links` gives them; group after group where
    it is left out.
    """
    result = list(_driven_first(mechanism))
    pin, crank_pivot = "", dict[str, Point]()
    if isinstance(mechanism.driver, Crank):
        pin, crank_pivot = mechanism.driver.pin, {result[0].points[0]: mechanism.driver.pivot}
    names = [name for item in result for name in (item.name, *([rod_name(item.name)] if item.rod else []))]
    numbers = {name: count for count, name in enumerate(links or names, 1)}
    further = {item.name: [p.name for p in mechanism.points if p.link == item.name] for item in result}
    members = tuple(
        item._replace(
            number=numbers.get(item.name, 0),
            points=tuple(dict.fromkeys([*item.points, *further[item.name]])),
            rod=numbers[rod_name(item.name)] if item.rod else 0,
        )
        for item in result
    )
    owners = {name: sum(name in member.points for member in members) for member in members for name in member.points}
    fixed = {**crank_pivot, **{name: point for name, point in mechanism.ground.items() if name in owners}}
    massive = {body.start for body in mechanism.bodies if body.start == body.end}
    slides = {member.points[0] for member in members if member.guide and member.points}
    free = [name for name, count in owners.items() if count == 1 and name not in fixed and name not in slides]
    free = [name for name in free if name != pin]
    centres = tuple(name for name in free if name in massive)
    # a centre that the file names is a point of its link too
    unnamed = [centre for centre in centres if "." in centre or centre in _CATALOG]
    members = tuple(member._replace(points=tuple(p for p in member.points if p not in unnamed)) for member in members)
    couplers = tuple(name for name in free if name not in massive)
    return Skeleton(members, fixed, couplers, centres, point_letters(mechanism, members, centres), pin)


def numbered(shape: Skeleton) -> list[tuple[int, str]]:
    """Return numbers and names of the moving links in their order."""
    rods = [(member.rod, rod_name(member.name)) for member in shape.members if member.rod]
    return sorted([*((member.number, member.name) for member in shape.members), *rods])


def _driven_first(mechanism: Mechanism) -> Iterator[Member]:
    """Yield the links with the points and guides of the driver and the groups, the driving one first."""
    driver, result = mechanism.driver, [item for group in mechanism.dyads for item in _members_of(group)]
    match driver:
        case Crank(pivot=centre, link=link, pin=pin):
            pivot = next((name for name, place in mechanism.ground.items() if place == centre), PIVOT)
            yield Member(link, 1, (pivot, pin))
            for item in driver.geared:
                fixed = next((name for name, place in mechanism.ground.items() if place == item.pivot), PIVOT)
                yield Member(item.link, 0, (fixed,))
        case DrivingSlider(link=link, guide=guide):
            yield Member(link, 1, (), guide)
        case Cylinder(barrel=barrel, rod=rod, link=link):
            yield Member(link, 1, (barrel, rod), rod=2)
    yield from (item for item in result if item.name != driver.link)


def _members_of(group: Dyad | Chain) -> Iterator[Member]:
    """Yield the links of a group with the points and guides that the group itself gives them."""
    match group:
        case RRR():
            yield Member(group.link_a, 0, (group.joint_a, group.point))
            yield Member(group.link_b, 0, (group.joint_b, group.point))
        case RRP():
            yield Member(group.link, 0, (group.joint, group.slider))
            yield Member(group.piece, 0, (group.slider,), group.guide)
        case RPR():
            yield Member(group.link, 0, (group.pivot,))
            yield Member(group.block, 0, (group.joint,), _slot(group.slot, group.link))
        case PRP():
            yield Member(group.block_a, 0, (group.point,), group.guide_a, has_rod=not group.guide_a.link)
            yield Member(group.block_b, 0, (group.point,), group.guide_b, has_rod=not group.guide_b.link)
        case RPP():
            yield Member(group.link, 0, (), group.guide, has_rod=not group.guide.link)
            yield Member(group.block, 0, (group.joint,), _slot(group.slot, group.link))
        case chain:
            guides = {slide.link: slide.guide for slide in chain.slides}
            carriers = {guide.link for guide in guides.values()}
            for link in chain.links:
                guide = guides.get(link.name)
                rod = guide is not None and not guide.link and link.name in carriers
                yield Member(link.name, 0, tuple(link.points), guide, has_rod=rod)


def _slot(slot: Guide, link: str) -> Guide:
    """Return a slot as a guide that a link carries."""
    return Guide(slot.point, slot.angle, link)


def point_letters(mechanism: Mechanism, members: Sequence[Member], centres: Sequence[str]) -> dict[str, str]:
    """Return the label of each point: the user's name, or a letter if the catalog has named the point.

    `centres`: points that are centres of mass; S and the number of their link.
    """
    names = list(dict.fromkeys(name for member in members for name in member.points))
    own = {name for name in (*names, *centres) if name not in _CATALOG and name != PIVOT}
    free = (letter for letter in _LETTERS if letter not in own)
    letters = {}
    for name in names:
        if name == PIVOT:
            letters[name] = next(item for item in ("O", "O1", "O2", "O′") if item not in own)
        else:
            letters[name] = name if name in own else next(free, name)
    numbers = {p.name: member.number for member in members for p in mechanism.points if p.link == member.name}
    for name in centres:
        letters[name] = name if name in own and "." not in name else f"S{numbers.get(name, '')}"
    return letters


def tracks(shape: Skeleton, moving: SampledMotion) -> dict[str, Array]:
    """Return where every point is, arrays of shape (n, 2). [m]"""
    count = len(moving.degrees)
    values = {name: np.tile(np.array(point, dtype=float), (count, 1)) for name, point in shape.pivots.items()}
    return values | {name: point.place for name, point in moving.points.items() if name not in values}


class MovingFrame(NamedTuple):
    """A frame that moves: origin and direction of its x axis, arrays of shape (n, 2). [m], [-]"""

    origin: Array
    along: Array

    @property
    def left(self) -> Array:
        """The direction of its y axis."""
        return np.column_stack([-self.along[:, 1], self.along[:, 0]])

    def place(self, u: float | Array, v: float | Array = 0.0) -> Array:
        """Return where a point of the frame is. [m]"""
        u, v = np.reshape(u, (-1, 1)), np.reshape(v, (-1, 1))
        return np.asarray(self.origin + u * self.along + v * self.left)

    def seen(self, places: Array) -> Array:
        """Return the coordinates of places in the frame, shape (n, 2). [m]"""
        offset = places - self.origin
        return np.column_stack([np.sum(offset * self.along, axis=1), np.sum(offset * self.left, axis=1)])


def pose(link: Frame | None, count: int) -> MovingFrame:
    """Return the frame of a link at each angle; that of the ground for None."""
    if link is None:
        return MovingFrame(np.zeros((count, 2)), np.tile([1.0, 0.0], (count, 1)))
    return MovingFrame(link.origin.place, link.along)


def guide_pose(guide: Guide, moving: SampledMotion) -> MovingFrame:
    """Return the line of a guide as a frame, its x axis on the line."""
    base = pose(moving.frames[guide.link] if guide.link else None, len(moving.degrees))
    cos, sin = np.cos(guide.angle), np.sin(guide.angle)
    return MovingFrame(base.place(*guide.point), cos * base.along + sin * base.left)
