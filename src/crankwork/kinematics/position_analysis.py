"""Position analysis: the driver, then one group after another, as numbers or traced values."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from crankwork.errors import GeometryError
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import Component, Root, TracedValue, absent, given, is_traced, named
from crankwork.kinematics import plane_motion as plane
from crankwork.kinematics.assembly import assembly_error, first_failure, singular_between
from crankwork.kinematics.chain_solver import ChainPath
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dyads import (
    Closure,
    DrivenAngle,
    GroupMotion,
    LinkMotion,
    Through,
    branch_sign,
    change_point_replacement,
    crank_motion,
    fixed_guide,
    fixed_point,
    guide_on_link,
    in_link_frame,
    is_zero,
    named_link,
    named_point,
    pin_on_crank,
    point_on_guide,
    point_on_link,
    rotated_frame,
    rrp_motion,
    rrr_motion,
    unchanged,
)
from crankwork.kinematics.kinematic_coefficients import PointMotion, Transfer
from crankwork.kinematics.loop_closure import ChainBoundary, is_stretched
from crankwork.kinematics.motion_laws import extent, law_at
from crankwork.kinematics.plane_motion import cosine_of_direction, sine_of_direction, sine_of_turned
from crankwork.kinematics.sliding_dyads import prp_motion, rpp_motion, rpr_motion
from crankwork.locale import ErrorMessage
from crankwork.mechanism.driver import Cylinder, DrivingSlider, GearedCrank, LinkMotor
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Bar, Chain, ChainLink, ChangePointPassage, Dyad, Guide
from crankwork.mechanism.joints import group_links, origin_of
from crankwork.mechanism.mechanism import Crank, Driver, Mechanism

_REST_TOLERANCE = 1e-12
# positions of a driver at which a linkage with a motion law is checked; intervals between them are checked too
_SCAN_POINTS = 361
_SOURCE = "artobolevsky_1988, ch. 4"
_KEYS = ("point_x", "point_y", "link_angle")


@dataclass
class Placed:
    """The positions calculated so far: points, frames of links, distances of sliders, closures of groups.

    `grid` has the coordinate of the driver, a length or an angle. For traced values, `plain` is the same mechanism in
    numbers.
    """

    grid: CrankGrid
    points: dict[str, PointMotion] = field(default_factory=dict)
    links: dict[str, LinkMotion] = field(default_factory=dict)
    sliders: dict[str, Transfer] = field(default_factory=dict)
    lengths: dict[str, Transfer] = field(default_factory=dict)
    # Lines between the joints of links of dyads whose frames lie elsewhere, by link
    bars: dict[str, LinkMotion] = field(default_factory=dict)
    closures: list[Closure] = field(default_factory=list)
    plain: Mechanism | None = None
    # Solved paths of chains by the index of their group, for the chains that depend on them too
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
        frame = rotated_frame(line, bar.angle if is_zero(bar.angle) else -bar.angle, f"{link}.{name}")
        if bar.end == (0.0, 0.0):
            return frame._replace(origin=self.points[ends[1]])
        (x, y), frame = bar.start, named_link(frame, link)
        along, across = (coordinate if is_zero(coordinate) else -coordinate for coordinate in (x, y))
        origin = point_on_link(frame, along, across, f"{link}.origin")
        return frame._replace(origin=named_point(origin, f"{link}.origin"))


def place(mechanism: Mechanism, grid: CrankGrid) -> Placed:
    """Return the positions at the angles of the tables, without a check of assembly.

    Points, links and sliders; NaN or infinite where a group does not close.
    """
    return place_at(mechanism, coordinates(mechanism.driver, grid))


def coordinates(driver: Driver, grid: CrankGrid) -> CrankGrid:
    """Return the coordinate of the driver at the angles of the tables, in place of an angle. [rad] or [m]"""
    return grid if driver.law is None else CrankGrid.from_radians(law_at(driver.law, grid).position)


def place_at(
    mechanism: Mechanism, grid: CrankGrid, *, plain: Mechanism | None = None, paths: dict[int, ChainPath] | None = None
) -> Placed:
    """Return the positions at values of the driver's coordinate.

    `plain`: the mechanism in numbers if lengths and coordinate are traced; `paths`: solved paths of chains.
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
                raise GeometryError(ErrorMessage("group_unplaced", group=_title(group), missing=str(missing))) from None
            if closure is not None:
                placed.closures.append(_bridged(closure, mechanism.passages.get(index), grid))
            _place_halves(mechanism, placed, placed.links.keys() - before)
            _name(placed, placed.links.keys() - before, placed.points.keys() - standing)
            _place_link_points(mechanism, placed, placed.links.keys() - before)
    return placed


def _place_driver(driver: Driver, placed: Placed) -> None:
    """Place the driver, or set the length that is its coordinate."""
    grid = placed.grid
    if isinstance(driver, Crank):
        arm = crank_motion(driver, grid)
        placed.points[driver.pin] = named_point(pin_on_crank(driver, arm), driver.pin)
        placed.links[driver.link] = arm if is_zero(driver.start) else named_link(arm, driver.link)
        placed.links.update(
            {geared.link: named_link(geared_motion(geared, driver, grid), geared.link) for geared in driver.geared}
        )
        return
    if is_traced(grid.angle):
        travel = Transfer(grid.angle, absent("driver_rate", 1.0), absent("driver_rate_1"))
    else:
        travel = Transfer(grid.angle, np.ones_like(grid.angle), np.zeros_like(grid.angle))
    match driver:
        case DrivingSlider(link=piece, guide=guide):
            line = fixed_guide(guide)
            placed.sliders[piece] = travel
            placed.links[piece] = line._replace(origin=named_point(point_on_guide(line, travel), piece))
        case Cylinder(link=link):
            placed.lengths[link] = travel._replace(position=named(travel.position, f"link_length.{link}"))
        case LinkMotor(link=link):
            placed.lengths[link] = third_side_motion(driver, grid)


def _bridged(closure: Closure, passage: ChangePointPassage | None, grid: CrankGrid) -> Closure:
    """Return the closure of a group; near change points, where polynomials are used, that of a group that closes."""
    if passage is None or not passage.bridges:
        return closure
    return closure._replace(value=np.where(passage.is_bridged(grid.degrees), closure.scale, closure.value))


def _name(placed: Placed, links: set[str], points: set[str]) -> None:
    """Name the traced values of links and points."""
    if placed.plain is not None:
        placed.links.update({name: named_link(placed.links[name], name) for name in links})
        placed.points.update({name: named_point(placed.points[name], name) for name in points})


def _place_halves(mechanism: Mechanism, placed: Placed, links: set[str]) -> None:
    """Add the frames of barrel and rod of a cylinder just placed, each at its own end, directed from barrel to rod."""
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
    points, links, group = placed.points, placed.links, mechanism.dyads[index]
    through: Through = unchanged
    if index in mechanism.passages and not isinstance(group, Chain | PRP | RPP):
        passage = mechanism.passages[index]
        group = replace(group, branch=branch_sign(passage, group.branch, placed.grid))
        through = change_point_replacement(passage, placed.grid)
    # the joints between which links have their lines
    ends: dict[str, tuple[str, str]] = {}
    match group:
        case RRR() as dyad:
            driver, opened = mechanism.driver, None
            if isinstance(driver, LinkMotor) and {dyad.link_a, dyad.link_b} == {*driver.links}:
                opened = opened_pair(driver, dyad, links[driver.link], placed.lengths[driver.link])
            solved = rrr_motion(dyad, points[dyad.joint_a], points[dyad.joint_b], placed.lengths, through, opened)
            ends = {dyad.link_a: (dyad.joint_a, dyad.point), dyad.link_b: (dyad.joint_b, dyad.point)}
        case RRP() as dyad:
            solved = rrp_motion(dyad, points[dyad.joint], placed.guide(dyad.guide, dyad.piece), placed.lengths, through)
            ends = {dyad.link: (dyad.joint, dyad.slider)}
        case RPR() as dyad:
            solved = rpr_motion(dyad, points[dyad.joint], points[dyad.pivot], through)
        case PRP() as dyad:
            a, b = placed.guide(dyad.guide_a, dyad.block_a), placed.guide(dyad.guide_b, dyad.block_b)
            solved = prp_motion(dyad, a, b)
        case RPP() as dyad:
            solved = rpp_motion(dyad, points[dyad.joint], placed.guide(dyad.guide, dyad.link))
        case chain if placed.plain is None:
            solved = ChainRoot(mechanism, index, placed.paths).path(placed.grid).motion(placed.grid)
        case chain:
            follows: Any = () if placed.plain.driver.law is None else (placed.grid.angle,)
            solved = traced_chain(chain, placed, Root(ChainRoot(placed.plain, index), follows))
    points.update({name: named_point(point, name) for name, point in solved.points.items()})
    for link, line in solved.links.items():
        links[link] = placed.frame(mechanism.bars.get(link), link, line, ends[link]) if link in ends else line
    placed.sliders.update(solved.sliders)
    return solved.closure


class ChainRoot:
    """The coordinates of the links of one chain, whose path along the driver's coordinate is solved once."""

    def __init__(self, mechanism: Mechanism, index: int, paths: dict[int, ChainPath] | None = None) -> None:
        self._earlier, self._index = replace(mechanism, dyads=mechanism.dyads[:index]), index
        self._paths: dict[int, ChainPath] = {} if paths is None else paths
        chain = mechanism.dyads[index]
        if not isinstance(chain, Chain):
            raise TypeError(f"group {index} is no chain")
        self._chain = chain

    def boundary(self, grid: CrankGrid) -> Placed:
        """Return the placed neighbours of the chain."""
        return place_at(self._earlier, grid, paths=self._paths)

    def path(self, grid: CrankGrid) -> ChainPath:
        """Return the path of the chain, extended to some crank angles."""
        path = self._paths.get(self._index)
        if path is None:
            path = self._paths[self._index] = ChainPath(self._chain, grid, self.boundary)
        elif not path.covers(grid):
            path.extend(grid)
        return path

    def __call__(self, coordinate: CrankGrid | Sequence[Array]) -> Array:
        """Return coordinates, first and second transfer functions, shape (9 links, n). [m], [rad]"""
        grid = coordinate if isinstance(coordinate, CrankGrid) else CrankGrid.from_radians(coordinate[0])
        return self.path(grid).coordinates(grid)


def assembled(mechanism: Mechanism, grid: CrankGrid, paths: dict[int, ChainPath] | None = None) -> Placed:
    """Return the positions of a mechanism; raise GeometryError if it cannot be assembled at or between all angles.

    `paths`: solved paths of its chains, which are extended; `grid`: crank angles, with a check of the intervals between
    them if they ascend [rad]. For a driver with a law, its whole period is checked.
    """
    law = mechanism.driver.law
    if law is None:
        return _assembled_at(mechanism, grid, paths)
    least, greatest = extent(law)
    # a coordinate that changes by rounding only is at rest
    is_at_rest = greatest - least <= _REST_TOLERANCE * max(1.0, abs(least), abs(greatest))
    positions = np.array([law.start]) if is_at_rest else np.linspace(least, greatest, _SCAN_POINTS)
    scan = CrankGrid.from_radians(positions)
    placed = place_at(mechanism, scan)
    closures = Closures(mechanism)
    for index, (group, closure) in enumerate(zip(mechanism.dyads, placed.closures, strict=True)):
        bad = first_failure(closure)
        between = [angle for _, angle in singular_between(scan, closure, closures[index])]
        if bad is not None or between:
            # the first failure from the start of the driver
            lost = [*positions[bad if bad is not None else []].tolist(), *between]
            nearest = min(lost, key=lambda position: abs(position - law.start))
            turns, links = mechanism.driver.turns, ", ".join(group_links(group))
            size = math.degrees(nearest) if turns else nearest * 1e3
            raise GeometryError(ErrorMessage("law_unreached_angle" if turns else "law_unreached", links=links, at=size))
    return place_at(mechanism, coordinates(mechanism.driver, grid), paths=paths)


def _assembled_at(mechanism: Mechanism, grid: CrankGrid, paths: dict[int, ChainPath] | None) -> Placed:
    placed = place_at(mechanism, grid, paths=paths)
    closures = Closures(mechanism, paths)
    for index, (group, closure) in enumerate(zip(mechanism.dyads, placed.closures, strict=True)):
        bad = first_failure(closure)
        if bad is not None:
            raise assembly_error(group, closure, grid, bad)
        for _, angle in singular_between(grid, closure, closures[index]):
            single = CrankGrid.from_radians(np.array([angle]))
            failed = closures[index](single)._replace(scale=closure.scale)
            raise assembly_error(group, failed, single, np.array([True]))
    return placed


class Closures:
    """How well each group of a mechanism closes, as a function of the crank angles; shared positions are cached."""

    def __init__(self, mechanism: Mechanism, paths: dict[int, ChainPath] | None = None) -> None:
        self._mechanism, self._paths = mechanism, dict[int, ChainPath]() if paths is None else paths
        self._placed = functools.lru_cache(maxsize=4)(self._place)

    def __getitem__(self, index: int) -> Callable[[CrankGrid], Closure]:
        groups = self._mechanism.dyads
        # a chain is solved only if its own closure is needed
        end = next(
            (number for number in range(index + 1, len(groups)) if isinstance(groups[number], Chain)), len(groups)
        )
        return lambda grid: self._placed(end, grid.angle.tobytes())[index]

    def _place(self, end: int, angles: bytes) -> tuple[Closure, ...]:
        part = replace(self._mechanism, dyads=self._mechanism.dyads[:end])
        return tuple(place_at(part, CrankGrid.from_radians(np.frombuffer(angles)), paths=self._paths).closures)


def _title(group: Dyad | Chain) -> ErrorMessage:
    """Return the name of a group in messages."""
    if isinstance(group, Chain):
        return ErrorMessage("group_of", names=", ".join(group_links(group)))
    first, second = group_links(group)
    return ErrorMessage("dyad_of", kind=type(group).__name__, first=first, second=second)


@formula("link_length", _SOURCE)
def third_side(l_i: Value, l_k: Value, cos_g: Value) -> Value:
    """Third side of a triangle, from two sides and the angle between them."""
    return np.sqrt(l_i**2 + l_k**2 - 2 * l_i * l_k * cos_g)


@formula("link_length_1", _SOURCE)
def third_side_1(l_i: Value, l_k: Value, sin_g: Value, l_s: Value) -> Value:
    """First derivative of the third side of a triangle by the angle between the other two."""
    return l_i * l_k * sin_g / l_s


@formula("link_length_2", _SOURCE)
def third_side_2(l_i: Value, l_k: Value, cos_g: Value, l_1: Value, l_s: Value) -> Value:
    """Second derivative of the third side of a triangle by the angle between the other two."""
    return (l_i * l_k * cos_g - l_1**2) / l_s


@formula("doubled_area", _SOURCE)
def opened_area(l_s: Value, l_1: Value) -> Value:
    """Twice the area of a triangle whose third side grows with the angle across from it."""
    return l_s * l_1


@formula("link_angle_1", _SOURCE)
def opened_rate(theta_1: Value, l_i: Value, l_k: Value, l_s: Value) -> Value:
    """First transfer function of the first of two sides of a triangle, by the angle between them."""
    return theta_1 + ((l_i**2 - l_k**2) / l_s**2 - 1) / 2


@formula("link_angle_2", _SOURCE)
def opened_rate_1(theta_2: Value, l_1: Value, theta_k1: Value, theta_1: Value, l_s: Value) -> Value:
    """Second transfer function of two sides of a triangle, by the angle between them."""
    return theta_2 - l_1 * (1 + 2 * (theta_k1 - theta_1)) / l_s


def opened_pair(motor: LinkMotor, dyad: RRR, line: LinkMotion, length: Transfer) -> DrivenAngle:
    """Return the rates of a dyad formed by the two links of a motor, from the third side of their triangle.

    Valid with the links in line too, where the formulas of a dyad are 0/0. `line`, `length`: of the third side.
    """
    is_first = dyad.link_a == motor.links[0]
    area = opened_area(length.position, length.position_1)
    first = opened_rate(line.angle_1, *motor.sides, length.position)
    rates = (first, first + 1.0) if is_first else (first + 1.0, first)
    rate_1 = opened_rate_1(line.angle_2, length.position_1, first, line.angle_1, length.position)
    return DrivenAngle(area if is_first else -area, *rates, rate_1)


def third_side_motion(motor: LinkMotor, grid: CrankGrid) -> Transfer:
    """Return the length of the third side of the triangle that a motor between two links opens. [m]"""
    (a, b), name = motor.sides, motor.link
    cos, sin = plane.cosine_of_direction(grid.angle + motor.angle), plane.sine_of_direction(grid.angle + motor.angle)
    cos, sin = named(cos, f"line_cos.{name}"), named(sin, f"line_sin.{name}")
    length = named(third_side(a, b, cos), f"link_length.{name}")
    length_1 = named(third_side_1(a, b, sin, length), f"link_length_1.{name}")
    return Transfer(length, length_1, named(third_side_2(a, b, cos, length_1, length), f"link_length_2.{name}"))


def geared_motion(geared: GearedCrank, crank: Crank, grid: CrankGrid) -> LinkMotion:
    """Return the motion of a crank that gears turn with the driving one, its frame at its pivot."""
    rate = geared.ratio * crank.direction
    angle = rate * grid.angle if is_zero(geared.start) else geared.start + rate * grid.angle
    cos, sin = plane.cosine_of_direction(angle), plane.sine_of_direction(angle)
    if is_traced(cos):
        return LinkMotion(fixed_point(geared.pivot), cos, sin, rate, absent("link_angle_2"))
    return LinkMotion(fixed_point(geared.pivot), cos, sin, np.full_like(cos, rate), np.zeros_like(cos))


def traced_chain(chain: Chain, boundary: ChainBoundary, root: Root) -> GroupMotion:
    """Return the traced motion of a chain of links, with points, frames and distances by the formulas of any link.

    `root`: gives the coordinates of all links and their derivatives; its residuals are set here.
    """
    count = 3 * len(chain.links)

    def coordinate(link: int, which: int) -> Transfer:
        keys = (f"{_KEYS[which]}{order}.{chain.links[link].name}" for order in ("", "_1", "_2"))
        return Transfer(
            *(TracedValue(Component(root, 3 * link + which + k * count), key) for k, key in enumerate(keys))
        )

    frames: dict[str, LinkMotion] = {}
    for k, link in enumerate(chain.links):
        angle = coordinate(k, 2)
        cos, sin = cosine_of_direction(angle.position), sine_of_direction(angle.position)
        frame = LinkMotion(PointMotion(coordinate(k, 0), coordinate(k, 1)), cos, sin, *angle[1:])
        frames[link.name] = named_link(frame, link.name)
    places = {
        (link.name, name): named_point(
            point_on_guide(frames[link.name], boundary.lengths[link.name])
            if is_stretched(link, name, boundary)
            else _point(frames[link.name], name, place, _path(chain, link, name)),
            name,
        )
        for link in chain.links
        for name, place in link.points.items()
    }
    points: dict[str, PointMotion] = {}
    for (_, name), place in places.items():
        points.setdefault(name, place)
    lines = {
        slide.link: guide_on_link(frames[slide.guide.link], slide.guide)
        if slide.guide.link in frames
        else boundary.guide(slide.guide)
        for slide in chain.slides
    }
    root.residuals = (
        *_pins(chain, places, points | {name: boundary.points[name] for name in chain.known}),
        *_slides(chain, frames, lines),
    )
    sliders = {link: in_link_frame(line, frames[link].origin).x for link, line in lines.items()}
    own = {name: point for name, point in points.items() if name not in chain.known}
    return GroupMotion(own, frames, sliders, None)


def _path(chain: Chain, link: ChainLink, name: str) -> str:
    """Return the path of a point in a description; the second joint of a bar is stated by the length."""
    if any(slide.link == link.name for slide in chain.slides):
        return f"sliders.{link.name}.points.{name}"
    return f"links.{link.name}.length" if [*link.points].index(name) == 1 else f"links.{link.name}.points.{name}"


def _point(frame: LinkMotion, name: str, place: tuple[float, float], path: str) -> PointMotion:
    along, across = place
    is_bar = path.endswith(".length")
    return point_on_link(
        frame,
        given(f"point_along.{name}", along, path if is_bar else f"{path}[1]") if along else absent("point_along"),
        given(f"point_across.{name}", across, f"{path}[2]") if across else absent("point_across"),
        name,
    )


def _pins(
    chain: Chain, places: dict[tuple[str, str], PointMotion], anchors: dict[str, PointMotion]
) -> Iterator[TracedValue]:
    """Yield the residuals of the pins, along x and y."""
    for (_, name), place in places.items():
        shared = name in chain.known or place is not anchors[name]
        for axis, end, anchor in zip("xy", place, anchors[name], strict=True):
            if shared:
                yield (end.position - anchor.position).named(f"distance_{axis}.{name}")


def _slides(chain: Chain, frames: dict[str, LinkMotion], lines: dict[str, LinkMotion]) -> Iterator[TracedValue]:
    """Yield the residuals of the slides: distance from the guide, and the sine of the angle to it."""
    for slide in chain.slides:
        frame, line = frames[slide.link], lines[slide.link]
        yield in_link_frame(line, frame.origin).y.position.named(f"guide_across.{slide.link}")
        yield sine_of_turned(frame.sin, line.cos, -frame.cos, line.sin).named(f"guide_sine.{slide.link}")
