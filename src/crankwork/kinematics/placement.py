"""The driver and one group after another: where every point and link of a mechanism is."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from crankwork.errors import GeometryError
from crankwork.formula.known import Root, absent, is_known, named
from crankwork.kinematics.assembly import refusal, singular_between, unassembled
from crankwork.kinematics.bridges import over_bridges, passed_branch
from crankwork.kinematics.chain_memory import remembered_chain
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.driving import geared_motion, opened_pair, third_side_motion
from crankwork.kinematics.dyads import (
    Closure,
    LinkMotion,
    Through,
    crank_motion,
    fixed_guide,
    fixed_point,
    guide_on_link,
    is_nothing,
    named_link,
    named_point,
    pin_on_crank,
    point_on_guide,
    point_on_link,
    rrp_motion,
    rrr_motion,
    straight,
    turned,
)
from crankwork.kinematics.loops import ChainPath
from crankwork.kinematics.motion_laws import extent, law_at
from crankwork.kinematics.sliding_dyads import prp_motion, rpp_motion, rpr_motion
from crankwork.kinematics.transfer import PointMotion, Transfer
from crankwork.locale import Refusal
from crankwork.mechanism.chain import Chain
from crankwork.mechanism.driver import Cylinder, DrivingSlider, LinkMotor
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Bar, Dyad, Guide
from crankwork.mechanism.joints import group_links, origin_of
from crankwork.mechanism.mechanism import Crank, Driver, Mechanism
from crankwork.mechanism.passage import Passage

_STANDS = 1e-12
# positions of a driver with a law at which a linkage is looked at, between which it is as well
_LOOKED_AT = 361


@dataclass
class Placed:
    """What has been placed so far: points, frames of links, distances of sliders, and how well groups closed.

    `grid` has the coordinate of the driver, a length or an angle. Where all these are remembered, `plain` is the same
    mechanism in numbers.
    """

    grid: CrankGrid
    points: dict[str, PointMotion] = field(default_factory=dict)
    links: dict[str, LinkMotion] = field(default_factory=dict)
    sliders: dict[str, Transfer] = field(default_factory=dict)
    lengths: dict[str, Transfer] = field(default_factory=dict)
    # Lines between the joints of those links of dyads whose frames they are not, by link
    bars: dict[str, LinkMotion] = field(default_factory=dict)
    closures: list[Closure] = field(default_factory=list)
    plain: Mechanism | None = None
    # What has been followed of chains, by their place; it serves what hangs on them
    paths: dict[int, ChainPath] = field(default_factory=dict)

    def guide(self, guide: Guide, piece: str = "chain") -> LinkMotion:
        """Return the motion of a guide, under the name of what slides on it."""
        line = guide_on_link(self.links[guide.link], guide) if guide.link else fixed_guide(guide)
        line = named_link(line, f"{piece}.guide")
        return line._replace(origin=named_point(line.origin, f"{piece}.guide"))

    def frame(self, bar: Bar | None, link: str, line: LinkMotion, ends: tuple[str, str]) -> LinkMotion:
        """Return the frame of a link, given the line from its known joint to its other one."""
        if bar is None:
            return line
        name = "–".join(ends)
        line = line._replace(cos=named(line.cos, f"link_cos.{name}"), sin=named(line.sin, f"link_sin.{name}"))
        self.bars[link] = line
        frame = turned(line, bar.angle if is_nothing(bar.angle) else -bar.angle, f"{link}.{name}")
        if bar.end == (0.0, 0.0):
            return frame._replace(origin=self.points[ends[1]])
        (x, y), frame = bar.start, named_link(frame, link)
        along, across = (one if is_nothing(one) else -one for one in (x, y))
        origin = point_on_link(frame, along, across, f"{link}.origin")
        return frame._replace(origin=named_point(origin, f"{link}.origin"))


def place(mechanism: Mechanism, grid: CrankGrid) -> Placed:
    """Return where everything is at the angles of the tables, without asking whether it can be assembled.

    Points, links and sliders; NaN or infinite where a group does not close.
    """
    return place_at(mechanism, coordinates(mechanism.driver, grid))


def coordinates(driver: Driver, grid: CrankGrid) -> CrankGrid:
    """Return the coordinate of the driver at the angles of the tables, in place of an angle. [rad] or [m]"""
    return grid if driver.law is None else CrankGrid.from_radians(law_at(driver.law, grid).position)


def place_at(
    mechanism: Mechanism,
    grid: CrankGrid,
    *,
    plain: Mechanism | None = None,
    paths: dict[int, ChainPath] | None = None,
) -> Placed:
    """Return what `place` does at values of the driver's coordinate.

    `plain`: the same in numbers, where lengths and coordinate are knowns; `paths`: of its chains, as far as they have
    been followed, for more of them.
    """
    placed = Placed(grid, plain=plain, paths={} if paths is None else paths)
    placed.points.update({name: fixed_point(point) for name, point in mechanism.ground.items()})
    _place_driver(mechanism.driver, placed)
    _place_link_points(mechanism, placed, set(placed.links))
    with np.errstate(invalid="ignore", divide="ignore"):
        for index, group in enumerate(mechanism.dyads):
            before, standing = set(placed.links), set(placed.points)
            try:
                closure = _place_group(mechanism, index, placed)
            except KeyError as missing:
                raise GeometryError(Refusal("group_unplaced", group=_title(group), missing=str(missing))) from None
            if closure is not None:
                placed.closures.append(_bridged(closure, mechanism.passages.get(index), grid))
            _place_halves(mechanism, placed, placed.links.keys() - before)
            _name(placed, placed.links.keys() - before, placed.points.keys() - standing)
            _place_link_points(mechanism, placed, placed.links.keys() - before)
    return placed


def _place_driver(driver: Driver, placed: Placed) -> None:
    """Add what the driver places by itself, or the length that is its coordinate."""
    grid = placed.grid
    if isinstance(driver, Crank):
        arm = crank_motion(driver, grid)
        placed.points[driver.pin] = named_point(pin_on_crank(driver, arm), driver.pin)
        placed.links[driver.link] = arm if is_nothing(driver.start) else named_link(arm, driver.link)
        placed.links.update({one.link: named_link(geared_motion(one, driver, grid), one.link) for one in driver.geared})
        return
    if is_known(grid.angle):
        way = Transfer(grid.angle, absent("driver_rate", 1.0), absent("driver_rate_1"))
    else:
        way = Transfer(grid.angle, np.ones_like(grid.angle), np.zeros_like(grid.angle))
    match driver:
        case DrivingSlider(link=piece, guide=guide):
            line = fixed_guide(guide)
            placed.sliders[piece] = way
            placed.links[piece] = line._replace(origin=named_point(point_on_guide(line, way), piece))
        case Cylinder(link=link):
            placed.lengths[link] = way._replace(position=named(way.position, f"link_length.{link}"))
        case LinkMotor(link=link):
            placed.lengths[link] = third_side_motion(driver, grid)


def _bridged(closure: Closure, passage: Passage | None, grid: CrankGrid) -> Closure:
    """Return how well a group closes; where it is led over a change point, nothing is to be told."""
    if passage is None or not passage.bridges:
        return closure
    return closure._replace(value=np.where(passage.is_bridged(grid.degrees), closure.scale, closure.value))


def _name(placed: Placed, links: set[str], points: set[str]) -> None:
    """Give what is remembered of links and points its name."""
    if placed.plain is not None:
        placed.links.update({name: named_link(placed.links[name], name) for name in links})
        placed.points.update({name: named_point(placed.points[name], name) for name in points})


def _place_halves(mechanism: Mechanism, placed: Placed, links: set[str]) -> None:
    """Add the frames of barrel and rod of a cylinder just placed, each at its own end, from the one to the other."""
    driver = mechanism.driver
    if not isinstance(driver, Cylinder) or not driver.halves or driver.link not in links:
        return
    frame = placed.links[driver.link]
    if origin_of(mechanism, driver.link) != driver.barrel:
        frame = frame._replace(cos=-frame.cos, sin=-frame.sin)
    for half, end in zip(driver.halves, (driver.barrel, driver.rod), strict=True):
        placed.links[half.link] = frame._replace(origin=placed.points[end])


def _place_link_points(mechanism: Mechanism, placed: Placed, links: set[str]) -> None:
    for point in mechanism.points:
        if point.link in links:
            moved = point_on_link(placed.links[point.link], point.along, point.across, point.name)
            placed.points[point.name] = named_point(moved, point.name)


def _place_group(mechanism: Mechanism, index: int, placed: Placed) -> Closure | None:
    """Add the points, links and sliders of one group."""
    points, links, sliders = placed.points, placed.links, placed.sliders
    group = mechanism.dyads[index]
    through: Through = straight
    if index in mechanism.passages and not isinstance(group, Chain | PRP | RPP):
        passage = mechanism.passages[index]
        group = replace(group, branch=passed_branch(passage, group.branch, placed.grid))
        through = over_bridges(passage, placed.grid)
    match group:
        case RRR() as dyad:
            hung, driver, opened = (points[dyad.joint_a], points[dyad.joint_b]), mechanism.driver, None
            if isinstance(driver, LinkMotor) and {dyad.link_a, dyad.link_b} == {*driver.links}:
                opened = opened_pair(driver, dyad, links[driver.link], placed.lengths[driver.link])
            rrr = rrr_motion(dyad, *hung, placed.lengths, through, opened)
            points[dyad.point] = named_point(rrr.point, dyad.point)
            for link, line, joint in (
                (dyad.link_a, rrr.link_a, dyad.joint_a),
                (dyad.link_b, rrr.link_b, dyad.joint_b),
            ):
                links[link] = placed.frame(mechanism.bars.get(link), link, line, (joint, dyad.point))
            return rrr.closure
        case RRP() as dyad:
            rrp = rrp_motion(dyad, points[dyad.joint], placed.guide(dyad.guide, dyad.piece), placed.lengths, through)
            points[dyad.slider], sliders[dyad.piece] = named_point(rrp.point, dyad.slider), rrp.slide
            ends = dyad.joint, dyad.slider
            links[dyad.link] = placed.frame(mechanism.bars.get(dyad.link), dyad.link, rrp.link, ends)
            links[dyad.piece] = rrp.piece
            return rrp.closure
        case RPR() as dyad:
            rpr = rpr_motion(dyad, points[dyad.joint], points[dyad.pivot], through)
            links[dyad.link], links[dyad.block], sliders[dyad.block] = rpr.link, rpr.block, rpr.slide
            return rpr.closure
        case PRP() as dyad:
            prp = prp_motion(dyad, placed.guide(dyad.guide_a, dyad.block_a), placed.guide(dyad.guide_b, dyad.block_b))
            points[dyad.point], links[dyad.block_a], links[dyad.block_b] = prp.point, prp.block_a, prp.block_b
            sliders[dyad.block_a], sliders[dyad.block_b] = prp.slide_a, prp.slide_b
            return prp.closure
        case RPP() as dyad:
            rpp = rpp_motion(dyad, points[dyad.joint], placed.guide(dyad.guide, dyad.link))
            links[dyad.link], links[dyad.block] = rpp.link, rpp.block
            sliders[dyad.link], sliders[dyad.block] = rpp.slide, rpp.block_slide
            return rpp.closure
        case chain:
            if placed.plain is None:
                root = ChainRoot(mechanism, index, placed.paths)
                solved = root.path(placed.grid).motion(placed.grid)
            else:
                follows: Any = () if placed.plain.driver.law is None else (placed.grid.angle,)
                solved = remembered_chain(chain, placed, Root(ChainRoot(placed.plain, index), follows))
            points.update(solved.points)
            links.update(solved.links)
            sliders.update(solved.sliders)
            return solved.closure


class ChainRoot:
    """The coordinates of the links of one chain of a mechanism, its way along the driver's coordinate solved once."""

    def __init__(self, mechanism: Mechanism, index: int, paths: dict[int, ChainPath] | None = None) -> None:
        self._earlier, self._index = replace(mechanism, dyads=mechanism.dyads[:index]), index
        self._paths: dict[int, ChainPath] = {} if paths is None else paths
        chain = mechanism.dyads[index]
        if not isinstance(chain, Chain):
            raise TypeError(f"group {index} is no chain")
        self._chain = chain

    def around(self, grid: CrankGrid) -> Placed:
        """Return what the chain hangs on."""
        return place_at(self._earlier, grid, paths=self._paths)

    def path(self, grid: CrankGrid) -> ChainPath:
        """Return the way of the chain, followed as far as some crank angles."""
        found = self._paths.get(self._index)
        if found is None:
            found = self._paths[self._index] = ChainPath(self._chain, grid, self.around)
        elif not found.covers(grid):
            found.follow(grid)
        return found

    def __call__(self, at: CrankGrid | Sequence[Array]) -> Array:
        """Return coordinates, first and second transfer functions, shape (9 links, n). [m], [rad]"""
        grid = at if isinstance(at, CrankGrid) else CrankGrid.from_radians(at[0])
        return self.path(grid).coordinates(grid)


def assembled(mechanism: Mechanism, grid: CrankGrid, paths: dict[int, ChainPath] | None = None) -> Placed:
    """Return where everything is, of a mechanism that can be assembled at and between all angles.

    `paths`: of its chains, as far as they have been followed, for more of them.
    `grid`: crank angles; what lies between them is looked at where they ascend [rad]. Where a law drives, everything
    that the driver passes in its period is looked at.
    """
    law = mechanism.driver.law
    if law is None:
        return _assembled_at(mechanism, grid, paths)
    least, greatest = extent(law)
    # a coordinate that only rounding changes stands
    stands = greatest - least <= _STANDS * max(1.0, abs(least), abs(greatest))
    ways = np.array([law.start]) if stands else np.linspace(least, greatest, _LOOKED_AT)
    whole = CrankGrid.from_radians(ways)
    placed = place_at(mechanism, whole)
    closures = Closures(mechanism)
    for index, (group, closure) in enumerate(zip(mechanism.dyads, placed.closures, strict=True)):
        bad = unassembled(closure)
        between = [angle for _, angle in singular_between(whole, closure, closures[index])]
        if bad is not None or between:
            # what the driver meets first
            lost = [*ways[bad if bad is not None else []].tolist(), *between]
            raise _unreached(mechanism.driver, group, min(lost, key=lambda one: abs(one - law.start)))
    return place_at(mechanism, coordinates(mechanism.driver, grid), paths=paths)


def _unreached(driver: Driver, group: Dyad | Chain, at: float) -> GeometryError:
    told, size = ("law_unreached_angle", math.degrees(at)) if driver.turns else ("law_unreached", at * 1e3)
    return GeometryError(Refusal(told, links=", ".join(group_links(group)), at=size))


def _assembled_at(mechanism: Mechanism, grid: CrankGrid, paths: dict[int, ChainPath] | None) -> Placed:
    placed = place_at(mechanism, grid, paths=paths)
    closures = Closures(mechanism, paths)
    for index, (group, closure) in enumerate(zip(mechanism.dyads, placed.closures, strict=True)):
        bad = unassembled(closure)
        if bad is not None:
            raise refusal(group, closure, grid, bad)
        for _, angle in singular_between(grid, closure, closures[index]):
            at = CrankGrid.from_radians(np.array([angle]))
            there = closures[index](at)._replace(scale=closure.scale)
            raise refusal(group, there, at, np.array([True]))
    return placed


class Closures:
    """How well each group of a mechanism closes, as a function of the crank angles.

    What several groups are asked for at the same angles is placed once.
    """

    def __init__(self, mechanism: Mechanism, paths: dict[int, ChainPath] | None = None) -> None:
        self._mechanism, self._paths = mechanism, dict[int, ChainPath]() if paths is None else paths
        self._placed = functools.lru_cache(maxsize=4)(self._place)

    def __getitem__(self, index: int) -> Callable[[CrankGrid], Closure]:
        groups = self._mechanism.dyads
        # a chain is followed where it is asked for only
        end = next((at for at in range(index + 1, len(groups)) if isinstance(groups[at], Chain)), len(groups))
        return lambda grid: self._placed(end, grid.angle.tobytes())[index]

    def _place(self, end: int, angles: bytes) -> tuple[Closure, ...]:
        part = replace(self._mechanism, dyads=self._mechanism.dyads[:end])
        return tuple(place_at(part, CrankGrid.from_radians(np.frombuffer(angles)), paths=self._paths).closures)


def _title(group: Dyad | Chain) -> Refusal:
    """Return what to call a group in a message."""
    match group:
        case RRR():
            pair = group.link_a, group.link_b
        case RRP():
            pair = group.link, group.piece
        case RPR() | RPP():
            pair = group.link, group.block
        case PRP():
            pair = group.block_a, group.block_b
        case Chain():
            return Refusal("group_of", names=", ".join(link.name for link in group.links))
    return Refusal("dyad_of", kind=type(group).__name__, first=pair[0], second=pair[1])
