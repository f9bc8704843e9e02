"""The traced motion of a mechanism: lengths are inputs, and formulas give everything else."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, TypeVar

import numpy as np

from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import AngleFunction, AngleUnwrap, TracedValue, absent, delayed, given, named
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dyads import LinkMotion, named_link, named_point
from crankwork.kinematics.kinematic_coefficients import PointMotion, Transfer
from crankwork.kinematics.motion import Motion
from crankwork.kinematics.motion_laws import traced_law
from crankwork.kinematics.plane_motion import cosine_of_direction, direction_of_slope, sine_of_direction
from crankwork.kinematics.position_analysis import Placed, place_at
from crankwork.mechanism.driver import Cylinder, DrivingSlider, GearedCrank, LinkMotor
from crankwork.mechanism.dyads import PRP, RPP, RPR, RRP, RRR, Bar, Chain, Dyad, Guide, Point
from crankwork.mechanism.equal_parts import EqualPart, without
from crankwork.mechanism.linkage import Linkage
from crankwork.mechanism.mechanism import Body, Crank, Driver, LinkPoint, Mechanism

_Moving = TypeVar("_Moving")


class TracedCrankAngle(NamedTuple):
    """The crank angle and its functions, as in a grid, and the range of the crank. [deg]"""

    angle: TracedValue = TracedValue(AngleFunction("angle"), "crank_angle")
    sin: TracedValue = TracedValue(AngleFunction("sin"), "crank_sin")
    cos: TracedValue = TracedValue(AngleFunction("cos"), "crank_cos")
    start: float = 0.0
    end: float = 360.0

    def over(self, columns: Mapping[str, TracedValue]) -> CycleInterpolant:
        """Return the interpolant of columns over the range of the crank."""
        return CycleInterpolant(columns, CrankGrid.from_degrees, self.end - self.start, self.start)


@dataclass(frozen=True)
class ApproximateDirection:
    """Directions at some crank angles, interpolated linearly. [deg], [rad]"""

    degrees: Array
    angle: Array

    def __call__(self, degrees: Array) -> Array:
        """Return the approximate direction at crank angles."""
        return np.asarray(np.interp(degrees, self.degrees, self.angle))


def traced_motion(
    mechanism: Mechanism, motion: Motion, linkage: Linkage | None = None, parts: Sequence[EqualPart] = ()
) -> Motion:
    """Return the traced motion of a mechanism: how it follows from lengths and crank angle.

    `motion`: the same in numbers, for the full turns of its links; `linkage`: the mechanism as described; `parts`:
    those that do what earlier ones do, so that they are not traced again.
    """
    driver, ends = mechanism.driver, (float(motion.grid.degrees[0]), float(motion.grid.degrees[-1]))
    grid = _untyped(TracedCrankAngle(start=ends[0], end=ends[1]))
    rates = None if driver.law is None else traced_law(driver.law, turns=driver.turns)
    coordinate = grid if rates is None else _untyped(_coordinate(driver, rates.position))
    reduced = without(mechanism, parts)
    placed = place_at(traced_mechanism(reduced, linkage), coordinate, plain=reduced)
    for part in parts:
        place_equal(placed, part, placed.links[driver.link].origin)
    links = {}
    for name, frame in _ordered(placed.links, motion.frames).items():
        if name == driver.link and isinstance(driver, Crank):
            links[name] = Transfer(driver.start + driver.direction * coordinate.angle, frame.angle_1, frame.angle_2)
        elif name in motion.links:
            approximate = ApproximateDirection(motion.grid.degrees, motion.links[name].position)
            turns = TracedValue(AngleUnwrap(frame.sin, frame.cos, approximate), f"half_turns.{name}")
            angle = direction_of_slope(frame.sin, frame.cos, turns).named(f"link_angle.{name}")
            links[name] = Transfer(angle, frame.angle_1, frame.angle_2)
    return Motion(
        grid,
        _ordered(placed.points, motion.points),
        links,
        _ordered(placed.sliders, motion.sliders),
        _ordered(placed.links, motion.frames),
        _ordered(placed.bars, motion.bars),
        rates,
        tuple(parts),
    )


def _ordered(values: dict[str, _Moving], order: Iterable[str]) -> dict[str, _Moving]:
    """Return values by name in the order of the mechanism, in which parts equal to earlier ones have their places."""
    return {name: values[name] for name in dict.fromkeys([*(name for name in order if name in values), *values])}


def _coordinate(driver: Driver, angle: TracedValue) -> TracedCrankAngle:
    """Return the coordinate of a driver in the form of a crank angle."""
    if not driver.turns:
        return TracedCrankAngle(angle, angle, angle)
    return TracedCrankAngle(
        angle, named(sine_of_direction(angle), "crank_sin"), named(cosine_of_direction(angle), "crank_cos")
    )


def interpolant_of(grid: Any) -> Callable[[Mapping[str, TracedValue]], CycleInterpolant]:  # noqa: ANN401 - typed as a grid
    """Return the function that interpolates columns over the crank angles of a traced motion."""
    interpolant: Callable[[Mapping[str, TracedValue]], CycleInterpolant] = grid.over
    return interpolant


def angle_of(grid: Any) -> TracedValue:  # noqa: ANN401 - typed as a grid
    """Return the crank angle of a traced motion."""
    angle: TracedValue = grid.angle
    return angle


class _Paths:
    """Paths of members and guides in a description."""

    def __init__(self, linkage: Linkage | None) -> None:
        members = () if linkage is None else (linkage.driving, *linkage.members)
        self._geared = set() if linkage is None else {geared.name for geared in linkage.geared}
        self._guides = {member.name: member.guide for member in members}
        self.members = {member.name: member for member in members}
        halves = linkage.driver.halves if linkage is not None and isinstance(linkage.driver, Cylinder) else ()
        self._halves = {half.link: f"driver.{name}" for half, name in zip(halves, ("barrel", "rod"), strict=False)}
        self._crank = linkage.driver.link if linkage is not None and isinstance(linkage.driver, Crank) else ""

    def member(self, name: str) -> str:
        if name == self._crank:
            return "crank"
        if name in self._geared:
            return f"geared.{name}"
        if name in self._halves:
            return self._halves[name]
        return f"{'sliders' if self._guides.get(name) else 'links'}.{name}"

    def guide(self, piece: str) -> str:
        return f"guides.{self._guides.get(piece, piece)}"


def traced_mechanism(mechanism: Mechanism, linkage: Linkage | None = None) -> Mechanism:
    """Return a mechanism whose lengths, angles and masses are inputs; zeros are absent."""
    paths = _Paths(linkage)
    ground: dict[str, Any] = {
        name: _point(name, point, f"fixed_points.{name}") for name, point in mechanism.ground.items()
    }
    return replace(
        mechanism,
        driver=_given_driver(mechanism, ground, paths),
        dyads=tuple(
            _chain(group, paths) if isinstance(group, Chain) else _dyad(group, paths) for group in mechanism.dyads
        ),
        bodies=tuple(_body(body, paths) for body in mechanism.bodies),
        ground=ground,
        points=tuple(_link_point(point, paths) for point in mechanism.points),
        bars={name: _bar(name, bar) for name, bar in mechanism.bars.items()},
    )


def _given_driver(mechanism: Mechanism, ground: Mapping[str, Any], paths: _Paths) -> Any:  # noqa: ANN401 - traced where numbers are typed
    driver: Any = mechanism.driver
    match mechanism.driver:
        case Crank():
            pivot = next((name for name, point in mechanism.ground.items() if point == driver.pivot), "")
            return replace(
                driver,
                radius=given("crank_radius", driver.radius, "crank.radius"),
                pivot=ground[pivot] if pivot else _point(f"{driver.link}_pivot", driver.pivot, "crank.pivot"),
                start=_stated("line_angle.crank", driver.start, "crank.start"),
                geared=tuple(_geared(geared, mechanism.ground, ground) for geared in driver.geared),
            )
        case DrivingSlider(link=piece, guide=guide):
            return replace(driver, guide=_guide(piece, guide, paths.guide(piece)))
        case LinkMotor(links=links, sides=sides):
            given_sides = tuple(
                given(f"link_length.{link}", side, f"links.{link}.length")
                for link, side in zip(links, sides, strict=True)
            )
            return replace(
                driver, sides=given_sides, angle=_stated(f"line_angle.{driver.link}", driver.angle, "driver.between")
            )
    return driver


def _geared(crank: GearedCrank, places: Mapping[str, Point], ground: Mapping[str, Any]) -> GearedCrank:
    pivot = next((name for name, point in places.items() if point == crank.pivot), "")
    path, name = f"geared.{crank.link}", crank.link
    return replace(
        crank,
        ratio=_untyped(given(f"gear_ratio.{name}", crank.ratio, f"{path}.ratio")),
        pivot=ground[pivot] if pivot else _point(f"{name}_pivot", crank.pivot, f"{path}.pivot"),
        start=_stated(f"line_angle.{name}", crank.start, f"{path}.start"),
        pressure_angle=None
        if crank.pressure_angle is None
        else _stated(f"pressure_angle.{name}", crank.pressure_angle, f"{path}.pressure_angle"),
    )


def _stated(key: str, value: float, path: str) -> Any:  # noqa: ANN401 - a known where a number is typed
    return given(key, value, path) if value else absent(key)


def _branch(name: str, branch: int) -> Any:  # noqa: ANN401 - a known where a number is typed
    return absent("branch", 1.0) if branch == 1 else given(f"branch.{name}", -1.0, f"branch.{name}")


def _point(name: str, point: tuple[float, float], path: str) -> Any:  # noqa: ANN401 - traced where numbers are typed
    return tuple(
        given(f"point_{axis}.{name}", coordinate, f"{path}[{number}]")
        for number, axis, coordinate in zip((1, 2), "xy", point, strict=True)
    )


def _guide(name: str, guide: Guide, path: str) -> Guide:
    """Return a guide of inputs; zeros of a fixed guide are given, those of a carried guide absent."""
    if not guide.link:
        point: Any = _point(f"{name}.guide", guide.point, f"{path}.through")
        return Guide(point, _untyped(given(f"link_angle.{name}.guide", guide.angle, f"{path}.angle")))
    return replace(_slot(f"{name}.guide", guide, path), link=guide.link)


def _slot(name: str, slot: Guide, path: str) -> Guide:
    return Guide(
        _along_across(name, slot.point, f"{path}.through"),
        _stated(f"line_angle.{name}", slot.angle, f"{path}.angle"),
        slot.link,
    )


def _along_across(name: str, point: tuple[float, float], path: str) -> Any:  # noqa: ANN401 - traced where numbers are typed
    keys = (f"point_along.{name}", f"point_across.{name}")
    return tuple(
        _stated(key, coordinate, f"{path}[{number}]")
        for number, key, coordinate in zip((1, 2), keys, point, strict=True)
    )


def _untyped(known: TracedValue | TracedCrankAngle) -> Any:  # noqa: ANN401 - a known where a number is typed
    return known


def _length(link: str, length: float) -> Any:  # noqa: ANN401 - a known where a number is typed
    return given(f"link_length.{link}", length, f"links.{link}.length")


def _dyad(dyad: Dyad, paths: _Paths) -> Dyad:
    match dyad:
        case RRR():
            return replace(
                dyad,
                length_a=_length(dyad.link_a, dyad.length_a),
                length_b=_length(dyad.link_b, dyad.length_b),
                branch=_branch(dyad.point, dyad.branch),
            )
        case RRP():
            guide = _guide(dyad.piece, dyad.guide, paths.guide(dyad.piece))
            return replace(
                dyad,
                length=_length(dyad.link, dyad.length),
                guide_point=guide.point,
                guide_angle=guide.angle,
                branch=_branch(dyad.slider, dyad.branch),
            )
        case RPR():
            return replace(
                dyad, slot=_slot(dyad.block, dyad.slot, paths.guide(dyad.block)), branch=_branch(dyad.link, dyad.branch)
            )
        case PRP():
            a, b = dyad.block_a, dyad.block_b
            return replace(
                dyad, guide_a=_guide(a, dyad.guide_a, paths.guide(a)), guide_b=_guide(b, dyad.guide_b, paths.guide(b))
            )
        case RPP():
            return replace(
                dyad,
                slot=_slot(dyad.block, dyad.slot, paths.guide(dyad.block)),
                guide=_guide(dyad.link, dyad.guide, paths.guide(dyad.link)),
            )


def _bar(name: str, bar: Bar) -> Bar:
    """Return a bar of inputs; a bar that is only reversed stays as it is."""
    if bar.end == (0.0, 0.0) and abs(bar.angle) == math.pi:
        return bar
    path = f"links.{name}"
    start: Any = _along_across(f"{name}.origin", bar.start, path)
    return replace(bar, start=start, angle=_stated(f"line_angle.{name}", bar.angle, path))


def _chain(chain: Chain, paths: _Paths) -> Chain:
    """Return a chain whose guides are inputs; its points become inputs where they are placed."""
    guides = (_guide(slide.link, slide.guide, paths.guide(slide.link)) for slide in chain.slides)
    slides = (replace(slide, guide=guide) for slide, guide in zip(chain.slides, guides, strict=True))
    return replace(chain, slides=tuple(slides))


def _body(body: Body, paths: _Paths) -> Body:
    path, name, member = paths.member(body.link), body.link, paths.members.get(body.link)
    mass = _stated(f"body_mass.{name}", body.mass, f"{path}.mass")
    length = _of_first_joints(path, name, member.bar_length if member is not None else 0.0)
    if member is not None and member.length_mass is not None:
        per_length = given(f"mass_per_length.{name}", member.length_mass.value, f"{path}.mass")
        mass = _untyped((per_length * length).named(f"body_mass.{name}"))
    if member is not None and member.gyration_radius:
        radius = given(f"body_gyration_radius.{name}", member.gyration_radius, f"{path}.radius_of_gyration")
        return replace(body, mass=mass, inertia=_untyped((mass * radius * radius).named(f"body_inertia.{name}")))
    if member is None or member.length_inertia is None:
        return replace(body, mass=mass, inertia=_stated(f"body_inertia.{name}", body.inertia, f"{path}.inertia"))
    share = given(f"inertia_share.{name}", member.length_inertia.share, f"{path}.inertia")
    inertia = share * mass * length * length
    if member.length_inertia.about_end:
        inertia = inertia.named(f"end_inertia.{name}") - mass * length * length / 4
    return replace(body, mass=mass, inertia=_untyped(inertia.named(f"body_inertia.{name}")))


def _of_first_joints(path: str, name: str, length: float) -> TracedValue:
    """Return the distance of the first two joints of a link, or the radius of the crank."""
    if path == "crank":
        return given("crank_radius", length, "crank.radius")
    return given(f"link_length.{name}", length, f"{path}.length")


def _link_point(point: LinkPoint, paths: _Paths) -> LinkPoint:
    member, stated = paths.member(point.link), paths.members.get(point.link)
    # a centre of mass that is not a joint has no name in the description
    is_centre = point.name == f"{point.link}.centre"
    if is_centre and stated is not None and stated.centre_share:
        share = given(f"centre_share.{point.link}", stated.centre_share, f"{member}.centre")
        length = _of_first_joints(member, point.link, point.along / stated.centre_share)
        along = (share * length).named(f"point_along.{point.name}")
        return replace(point, along=_untyped(along), across=_untyped(absent(f"point_across.{point.name}")))
    path = f"{member}.centre" if is_centre else f"{member}.points.{point.name}"
    along, across = _along_across(point.name, (point.along, point.across), path)
    return replace(point, along=along, across=across)


Vector = tuple[TracedValue, TracedValue]


class Follower:
    """Gives traced values of an equal part: those of the earlier part at its own crank angle, vectors turned."""

    def __init__(self, part: EqualPart) -> None:
        self.part = part
        angle = CrankGrid.from_degrees([part.turn])
        self._cos, self._sin = float(angle.cos[0]), float(angle.sin[0])
        self._later: dict[int, tuple[TracedValue, TracedValue]] = {}
        self._points: dict[tuple[int, int], tuple[PointMotion, PointMotion]] = {}

    def later(self, known: TracedValue) -> TracedValue:
        """Return a value at the crank angle of this part; the same node for the same value."""
        if not known.varies:
            return known
        if id(known.node) not in self._later:
            self._later[id(known.node)] = known, delayed(known, self.part.delay, self.part.cycle, known.key)
        return self._later[id(known.node)][1]

    def vector(self, x: TracedValue, y: TracedValue) -> Vector:
        """Return a vector at the crank angle of this part, turned to it."""
        return self._turned(self.later(x), self.later(y))

    def _turned(self, x: TracedValue, y: TracedValue) -> Vector:
        cos, sin = self._cos, self._sin
        if not sin:
            return (x, y) if cos > 0 else (-x, -y)
        if not cos:
            return (-y, x) if sin > 0 else (y, -x)
        return x * cos - y * sin, x * sin + y * cos

    def set_point(self, first: PointMotion, own: PointMotion) -> None:
        """Say which point stands for one of the earlier part, where both are known."""
        self._points[id(first.x.position.node), id(first.y.position.node)] = first, own

    def point(self, first: PointMotion, pivot: PointMotion) -> PointMotion:
        """Return the motion of a point; the same for the same point."""
        key = id(first.x.position.node), id(first.y.position.node)
        if key not in self._points:
            (x, *x_rates), (y, *y_rates) = first
            rates = [self.vector(*pair) for pair in zip(x_rates, y_rates, strict=True)]
            if self.part.turn:
                origin = pivot.x.position, pivot.y.position
                across = self._turned(self.later(x) - origin[0], self.later(y) - origin[1])
                place = tuple(start + way for start, way in zip(origin, across, strict=True))
            else:
                place = self.later(x), self.later(y)
            own = PointMotion(*(Transfer(place[side], *(rate[side] for rate in rates)) for side in (0, 1)))
            self._points[key] = first, own
        return self._points[key][1]

    def frame(self, first: LinkMotion, pivot: PointMotion) -> LinkMotion:
        """Return the motion of a frame."""
        return LinkMotion(
            self.point(first.origin, pivot),
            *self.vector(first.cos, first.sin),
            self.later(first.angle_1),
            self.later(first.angle_2),
        )


def place_equal(placed: Placed, part: EqualPart, pivot: PointMotion) -> None:
    """Add points, links and sliders of an equal part to those placed."""
    follower = Follower(part)
    for name, own in part.names.items():
        if name in placed.points and own in placed.points:
            follower.set_point(placed.points[name], placed.points[own])
    for name, point in [*placed.points.items()]:
        own_name = part.names.get(name)
        if own_name is not None and own_name not in placed.points:
            moved = named_point(follower.point(point, pivot), own_name)
            placed.points[own_name] = moved
            follower.set_point(point, moved)
    for frames in (placed.links, placed.bars):
        for name in part.first & frames.keys():
            frames[part.names[name]] = named_link(follower.frame(frames[name], pivot), part.names[name])
    for name in part.first & placed.sliders.keys():
        own, slide = part.names[name], map(follower.later, placed.sliders[name])
        placed.sliders[own] = Transfer(*(side.named(f"{side.key.partition('.')[0]}.{own}") for side in slide))
