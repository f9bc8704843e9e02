"""Every kind of load, as numbers or traced values: processes, forces, springs, dampers, weights; and their energy."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal, NamedTuple, Protocol, runtime_checkable

import numpy as np

from crankwork.errors import GeometryError
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import (
    Piecewise,
    ProcedureValue,
    Tabulated,
    TracedValue,
    absent,
    given,
    is_traced,
    named,
    reached,
)
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.kinematic_coefficients import slider_velocity
from crankwork.kinematics.motion import Motion, broadcast, centre_of_mass
from crankwork.kinematics.plane_motion import cosine_of_direction, sine_of_direction
from crankwork.kinematics.traced_motion import angle_of, interpolant_of
from crankwork.loads.applied_loads import (
    AppliedForce,
    AppliedLoads,
    check_name,
    combine_loads,
    force_along_guide,
    force_at,
    force_between,
    force_on_slider,
    torque_on,
)
from crankwork.loads.curves import Curve, CurvePoint, cubic_between, curve_between, line_between, monotone_slopes
from crankwork.loads.curves import LoadCurve as LoadTable
from crankwork.locale import ErrorMessage
from crankwork.mechanism.dyads import Branch
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import STANDARD_GRAVITY
from crankwork.quantities.key import key_of

# share of the largest speed below which a piece is at rest, and the angle that it takes to reach that [deg]
_REST = 1e-12
_AT_REST = 1e-11
_DECIMALS = 9
_MARGIN = 1e-12


@dataclass(frozen=True)
class ProcessForce:
    """A force against the working stroke of a sliding piece, along its guide."""

    slider: str  # The sliding piece
    force: (
        Curve  # Force, positive against the forward stroke, at the stroke or the crank angle; a `LoadCurve` is one [N]
    )
    # Argument of `force`: distance from `start`, or crank angle [m], [rad]
    against: Literal["stroke", "angle"] = "stroke"
    forward: Branch = 1  # 1 if the distance of the piece along its guide grows on the working stroke, -1 if it falls
    start: float = 0.0  # That distance where the working stroke begins [m]
    # On the working stroke only, or on the return stroke too, with the same direction
    acts: Literal["forward", "both"] = "forward"
    begins_at_end: bool = False  # Whether `start` is an end of the stroke, which moves with the linkage


@dataclass(frozen=True)
class ForceOnPoint:
    """A constant force at a point."""

    point: str  # Where it acts
    # Its components along the fixed axes [N]
    x: float
    y: float
    link: str = ""  # The link it acts on; empty for the first of the links that meet there
    polar: tuple[float, float] | None = None  # Size and direction from the x axis, where these are stated [N], [rad]


@dataclass(frozen=True)
class TorqueOnLink:
    """A torque on a link, constant or by the crank angle."""

    link: str
    torque: float | Curve  # Positive anticlockwise; a callable takes the crank angle in radians [N m]


class _Travel(NamedTuple):
    """Distance of a piece from the start of its working stroke, and its derivative. [m], [m]"""

    position: Value
    position_1: Value


def process_force(load: ProcessForce, motion: Motion, path: str = "") -> AppliedLoads:
    """Return the force of a process on a sliding piece."""
    check_name("sliding piece", load.slider, motion.sliders)
    slide = motion.sliders[load.slider]
    start: Value = load.start
    if is_traced(slide.position):
        key = f"slider_displacement.{load.slider}.start"
        end = ProcedureValue(load.start, "min" if load.forward == 1 else "max", (slide.position,))
        start = TracedValue(end, key) if load.begins_at_end else given(key, start, f"{path}.start")
    # a rate with the sign of the velocity: the driver's coordinate may decrease
    rate = slide.position_1 if motion.driver is None else slide.position_1 * motion.driver.position_1
    travel = slide.position - start, rate
    travel = _Travel(*(travel if load.forward == 1 else (-travel[0], -travel[1])))
    force = _force(load, travel, motion, (load.slider, path))
    return AppliedLoads((force_along_guide(motion, load.slider, -force if load.forward == 1 else force),))


def _force(load: ProcessForce, travel: _Travel, motion: Motion, named_at: tuple[str, str]) -> Value:
    if is_traced(travel.position):
        return _traced(load, travel, motion, *named_at)
    force = np.asarray(load.force(travel.position if load.against == "stroke" else motion.grid.angle), dtype=float)
    if load.acts == "both":
        return force
    return np.where(travel.position_1 >= -_REST * np.max(np.abs(travel.position_1)), force, 0.0)


def _traced(load: ProcessForce, travel: _Travel, motion: Motion, name: str, path: str) -> TracedValue:
    """Return the force as a curve over travel or crank angle, piecewise if it acts on the working stroke only."""
    key, interpolator = f"process_force.{name}", interpolant_of(motion.grid)
    travel = travel._replace(position=named(travel.position, f"working_stroke.{name}"))
    columns = {"travel": travel.position} if load.against == "stroke" else {}
    over = interpolator(columns if load.acts == "both" else {**columns, "rate": travel.position_1})
    if load.against == "stroke":
        force = curve_over_column(load.force, over, "travel", key, f"{path}.force")
    else:
        force = curve_over_angle(load.force, over.edges, angle_of(motion.grid), key, f"{path}.force")
    if load.acts == "both":
        return force
    (*ends, last), is_back = over.sign_intervals("rate")
    # the force acts at rest: an interval of the return stroke does not own its end
    ends = [_rounded(end, over.breaks, back=back) for end, back in zip(ends, is_back, strict=False)]
    places: list[TracedValue | float] = [reached(travel.position_1, end) for end in ends]
    if is_back[-1] and not is_back[0]:
        places, is_back = [*places, math.nextafter(last, 0.0)], [*is_back, False]
    return TracedValue(Piecewise([*places, last], tuple(absent(key) if back else force for back in is_back)), key)


def _rounded(end: float, breaks: Array, *, back: bool) -> float:
    """Return the end of an interval, rounded to a close breakpoint of the driver's law or to decimals. [deg]"""
    law = float(breaks[np.argmin(np.abs(breaks - end))])
    if abs(law - end) < _AT_REST:
        return law
    near = round(end, _DECIMALS)
    end = near if abs(near - end) < _AT_REST else end
    return math.nextafter(end, 0.0) if back else end


def constant_force(load: ForceOnPoint, mechanism: Mechanism, motion: Motion, path: str = "") -> AppliedLoads:
    """Return a constant force at a point."""
    force: tuple[Value, Value] = np.array(load.x), np.array(load.y)
    if is_traced(motion.grid.angle):
        x, y = ((f"load_{axis}.{load.point}", f"{path}.{axis}") for axis in "xy")
        force = given(x[0], load.x, x[1]), given(y[0], load.y, y[1])
        if load.polar is not None:
            size = given(f"load_size.{load.point}", load.polar[0], f"{path}.force")
            direction = given(f"link_angle.{load.point}.load", load.polar[1], f"{path}.angle")
            along = size * cosine_of_direction(direction), size * sine_of_direction(direction)
            force = named(along[0], x[0]), named(along[1], y[0])
    return force_at(mechanism, motion, load.point, force, load.link)


def link_torque(load: TorqueOnLink, motion: Motion, path: str = "") -> AppliedLoads:
    """Return a torque on a link."""
    torque: Value
    if is_traced(motion.grid.angle):
        key = f"link_torque.{load.link}"
        if callable(load.torque):
            edges = interpolant_of(motion.grid)({}).edges
            torque = curve_over_angle(load.torque, edges, angle_of(motion.grid), key, f"{path}.torque")
        else:
            torque = given(key, load.torque, f"{path}.torque")
    else:
        torque = load.torque(motion.grid.angle) if callable(load.torque) else np.array(load.torque)
    return torque_on(motion, load.link, torque)


@dataclass(frozen=True)
class StatedTable:
    """A table of loads as a column, constant beyond its ends, which rounding may pass.

    `path`: where a description states the load; `before`: points of the load before those of the table.
    """

    table: LoadTable
    key: str
    path: str
    before: int = 0

    def __call__(self, abscissas: Array) -> Array:
        """Return the values at some abscissas."""
        return self.table(abscissas if self.table.period else np.clip(abscissas, self.table.at[0], self.table.at[-1]))

    def corner_near(self, abscissa: float) -> float:
        """Return the abscissa of the point that is nearest to an abscissa."""
        x, _, _, turn, _ = self._around(abscissa)
        return float(x[np.argmin(np.abs(x + turn - abscissa))]) + turn

    def ends_around(self, abscissa: float) -> tuple[float, float]:
        """Return the abscissas of the points before and after an abscissa, infinite where there is none."""
        x, _, _, turn, first = self._around(abscissa)
        if not self.table.period and not x[0] < abscissa < x[-1]:
            return (-math.inf, float(x[0])) if abscissa <= x[0] else (float(x[-1]), math.inf)
        return float(x[first]) + turn, float(x[first + 1]) + turn

    def law_at(self, abscissa: float) -> Callable[[Value], Value]:
        """Return the law between the points around an abscissa, as a function of the abscissa."""
        x, y, slopes, turn, first = self._around(abscissa)
        if not self.table.period and not x[0] < abscissa < x[-1]:
            return lambda _: float(y[0] if abscissa <= x[0] else y[-1])
        begin, length = float(x[first]) + turn, float(x[first + 1] - x[first])
        ordinates = float(y[first]), float(y[first + 1])
        if self.table.interpolation != "monotone":
            return lambda value: line_between(*ordinates, (value - begin) / length)
        rises = float(slopes[first]) * length, float(slopes[first + 1]) * length
        return lambda value: cubic_between(ordinates, rises, (value - begin) / length)

    def _around(self, abscissa: float) -> tuple[Array, Array, Array, float, int]:
        """Return points and slopes of one period, its start, and the number of the point before an abscissa."""
        x, y, period = np.array(self.table.at), np.array(self.table.values), self.table.period
        turn = 0.0
        if period:
            turn = period * math.floor((abscissa - x[0]) / period)
            if x[-1] - x[0] < period * (1 - _MARGIN):
                x, y = np.append(x, x[0] + period), np.append(y, y[0])
        is_straight = self.table.interpolation != "monotone"
        slopes = np.zeros_like(y) if is_straight else monotone_slopes(x, y, periodic=bool(period))
        return x, y, slopes, turn, int(np.clip(np.searchsorted(x, abscissa - turn, side="right") - 1, 0, len(x) - 2))

    def between(self, abscissa: float, argument: TracedValue) -> TracedValue:
        """Return the value at one abscissa, interpolated between two points."""
        x, y, slopes, turn, first = self._around(abscissa)

        def point(k: int) -> CurvePoint:
            number = self.before + k % len(self.table.at) + 1
            column = "torque" if self.path.endswith(".torque") else "force"
            stated = f"{self.path.removesuffix(column)}at[{number}]"
            value = given("", float(y[k]), f"{self.path}[{number}]")
            place, stroke = given("", float(x[k]) + turn, stated), self.table.stroke
            if stroke:
                largest = TracedValue(ProcedureValue(stroke, "max", (argument,)), key_of(argument.key).derived("_max"))
                place = given("travel_share", place.value / stroke, stated) * largest
            return CurvePoint(place, value, float(slopes[k]))

        is_straight = self.table.interpolation != "monotone"
        return curve_between(self.key, argument, point(first), point(first + 1), is_straight=is_straight)


def curve_over_angle(curve: Curve, edges: Array, angle: TracedValue, key: str, path: str = "") -> TracedValue:
    """Return a curve over the crank angle. [rad]

    `curve`: a table, or a function that may have `corners` [rad]; `edges`: of the panels of the cycle [deg].
    """
    corners = [math.degrees(corner) for corner in _corners(curve)]
    if isinstance(curve, LoadTable) and not _varies(curve):
        return given(key, curve.values[0], f"{path}[1]")
    if isinstance(curve, LoadTable) and curve.interpolation == "constant":
        start, end = float(edges[0]), float(edges[-1])
        first, last = (math.degrees(bound) for bound in curve.at)
        turns = range(math.floor((start - last) / 360.0), math.ceil((end - first) / 360.0) + 1)
        bounds = (bound + 360.0 * turn for turn in turns for bound in (first, last))
        ends = [*sorted({round(bound, _DECIMALS) for bound in bounds if start < bound < end}), end]
        acts = curve(np.radians((np.array([start, *ends[:-1]]) + np.array(ends)) / 2)) != 0.0
        force, none = given(key, curve.values[0], f"{path}[1]"), absent(key)
        return TracedValue(Piecewise(ends, tuple(force if law else none for law in acts)), key)
    function = StatedTable(curve, key, path) if isinstance(curve, LoadTable) else curve
    return TracedValue(Tabulated(function, "given", corners, argument=angle), key)


def curve_over_column(curve: Curve, over: CycleInterpolant, column: str, key: str, path: str = "") -> TracedValue:
    """Return a curve over a column, with its corners at the crank angles where the column passes them.

    `column`: its key among the columns over the cycle.
    """
    if isinstance(curve, LoadTable) and not _varies(curve):
        return given(key, curve.values[0], f"{path}[1]")
    known, corners = over.columns[column], _corners(curve)
    passed = [angle for corner in corners for angle in over.crossings(column, corner).tolist()]
    if not isinstance(curve, LoadTable):
        return TracedValue(Tabulated(curve, "given", passed, argument=known), key)
    # an abscissa given twice is a jump: each part has a law of its own
    jumps = [index for index, (before, after) in enumerate(pairwise(curve.at), start=1) if before == after]
    parts = list(pairwise((0, *jumps, len(curve.at))))
    tables = [replace(curve, at=curve.at[first:end], values=curve.values[first:end]) for first, end in parts]
    laws = [
        TracedValue(Tabulated(StatedTable(table, key, path, first), "given", passed, argument=known), key)
        for table, (first, _) in zip(tables, parts, strict=True)
    ]
    low, high = curve.at[0], curve.at[-1]
    margin = _MARGIN * max(abs(low), abs(high))
    if curve.interpolation == "constant":
        laws, margin = [given(key, curve.values[0], f"{path}[1]")], 0.0
    bounds = [low - margin, *(curve.at[index] for index in jumps), high + margin]
    passed_at = sorted((angle, bound) for bound in bounds for angle in over.crossings(column, bound).tolist())
    ends = [*(angle for angle, _ in passed_at), float(over.edges[-1])]
    values = over.at(column, (np.array([over.edges[0], *ends[:-1]]) + np.array(ends)) / 2)
    places = np.searchsorted(bounds, values).tolist()
    if set(places) == {1} and len(laws) == 1:
        return laws[0]
    laws = [absent(key), *laws, absent(key)]
    places_of = [*(reached(known, angle, bound) for angle, bound in passed_at), ends[-1]]
    return TracedValue(Piecewise(places_of, tuple(laws[place] for place in places)), key)


def _corners(curve: Curve) -> tuple[float, ...]:
    return curve.at if isinstance(curve, LoadTable) else tuple(getattr(curve, "corners", ()))


def _varies(table: LoadTable) -> bool:
    return len(set(table.values)) > 1 or not (table.at[0] < -_ANYWHERE and table.at[-1] > _ANYWHERE)


_ANYWHERE = 100.0


@dataclass(frozen=True)
class Spring:
    """A straight spring between two points."""

    # The points it joins, of links or fixed
    start: str
    end: str
    stiffness: float  # Force per length [N/m]
    free_length: float  # Length at which it pulls with the preload only [m]
    preload: float = 0.0  # Pull at the free length [N]
    # Links it is fixed to; empty for the first of the links that meet there
    start_link: str = ""
    end_link: str = ""


@dataclass(frozen=True)
class SliderSpring:
    """A spring along a guide, between a sliding piece and the link of the guide."""

    slider: str  # The sliding piece
    stiffness: float  # Force per length [N/m]
    # Distance of the piece along its guide at which the spring pulls with the preload only [m]
    free_position: float = 0.0
    preload: float = 0.0  # Pull there, against the direction in which that distance counts [N]


@formula("spring_force", "norton_2012, ch. 8")
def spring_force(c: Value, s: Value, s_0: Value, F_0: Value) -> Value:
    """Pull of a linear spring."""
    return c * (s - s_0) + F_0


@formula("spring_length", "norton_2012, ch. 8")
def spring_length(dx: Value, dy: Value) -> Value:
    """Distance of the ends of a spring."""
    return np.sqrt(dx**2 + dy**2)


def _stated(
    load: Spring | SliderSpring, free: float, name: str, length: Value, path: str
) -> tuple[Value, Value, Value]:
    """Return stiffness, free length and preload of a spring, traced if its length is traced."""
    if not is_traced(length):
        return load.stiffness, free, load.preload
    pull, at_free = load.preload, given(f"spring_length.{name}.free", free, f"{path}.free_length")
    return (
        given(f"spring_stiffness.{name}", load.stiffness, f"{path}.stiffness"),
        at_free if free else absent("spring_length"),
        given(f"spring_force.{name}.preload", pull, f"{path}.preload") if pull else absent("spring_force"),
    )


def _ends(load: Spring | Damper, motion: Motion) -> tuple[str, Value, Value]:
    """Return the name of a spring or damper in keys, and how far its end is from its start along the axes. [m]"""
    for name in (load.start, load.end):
        check_name("point", name, motion.points)
    start, end = motion.points[load.start], motion.points[load.end]
    return f"{load.start}.{load.end}", end.x.position - start.x.position, end.y.position - start.y.position


def _length(load: Spring | Damper, x: Value, y: Value, kind: str) -> Value:
    """Return the length of a spring or damper; raise if both ends meet. [m]"""
    length = named(spring_length(x, y), f"{kind}_length.{load.start}.{load.end}")
    if not is_traced(length) and np.any(length == 0):
        raise GeometryError(ErrorMessage(f"{kind}_shut", start=load.start, end=load.end))
    return length


def _pull(load: Spring | Damper, mechanism: Mechanism, motion: Motion, pull: tuple[Value, Value]) -> AppliedLoads:
    """Return the pull of a spring or damper on its links; `pull`: on its start, along the axes. [N]"""
    return force_between(mechanism, motion, (load.start, load.end), pull, (load.start_link, load.end_link))


def point_spring(load: Spring, mechanism: Mechanism, motion: Motion, path: str = "") -> AppliedLoads:
    """Return the forces of a spring on the two links that it joins."""
    name, x, y = _ends(load, motion)
    length = _length(load, x, y, "spring")
    stiffness, free, preload = _stated(load, load.free_length, name, length, path)
    force = named(spring_force(stiffness, length, free, preload), f"spring_force.{name}")
    return _pull(load, mechanism, motion, (x / length * force, y / length * force))


def slider_spring(load: SliderSpring, mechanism: Mechanism, motion: Motion, path: str = "") -> AppliedLoads:
    """Return the forces of a spring on a sliding piece and on the link that carries its guide."""
    check_name("sliding piece", load.slider, motion.sliders)
    position = motion.sliders[load.slider].position
    stiffness, free, preload = _stated(load, load.free_position, load.slider, position, path)
    force = -named(spring_force(stiffness, position, free, preload), f"spring_force.{load.slider}")
    return force_on_slider(mechanism, motion, load.slider, force, other="_spring")


@dataclass(frozen=True)
class Damper:
    """A straight damper between two points."""

    # The points it joins, of links or fixed
    start: str
    end: str
    damping: float  # Force over the rate of its length [N s/m]
    # Links it is fixed to; empty for the first ones of those that meet there
    start_link: str = ""
    end_link: str = ""


@dataclass(frozen=True)
class SliderDamper:
    """A damper along a guide, between a sliding piece and the link of the guide."""

    slider: str  # The sliding piece
    damping: float  # Force over the velocity along the guide [N s/m]


@formula("damper_force", "norton_2012, ch. 10")
def damper_force(d: Value, v_l: Value) -> Value:
    """Pull of a damper."""
    return d * v_l


@formula("damper_velocity", "norton_2012, ch. 10")
def damper_velocity(dx: Value, dx_1: Value, dy: Value, dy_1: Value, s: Value, w: Value) -> Value:
    """Rate of the distance of the ends of a damper."""
    return (dx * dx_1 + dy * dy_1) / s * w


def point_damper(load: Damper, mechanism: Mechanism, motion: Motion, speed: Value, path: str = "") -> AppliedLoads:
    """Return the forces of a damper on the two links that it joins."""
    name, x, y = _ends(load, motion)
    length = _length(load, x, y, "damper")
    start, end = motion.points[load.start], motion.points[load.end]
    rates = end.x.position_1 - start.x.position_1, end.y.position_1 - start.y.position_1
    rate = named(damper_velocity(x, rates[0], y, rates[1], length, speed), f"damper_velocity.{name}")
    force = named(damper_force(_damping(load, name, rate, path), rate), f"damper_force.{name}")
    return _pull(load, mechanism, motion, (x / length * force, y / length * force))


def slider_damper(
    load: SliderDamper, mechanism: Mechanism, motion: Motion, speed: Value, path: str = ""
) -> AppliedLoads:
    """Return the forces of a damper on a sliding piece and on the link that carries its guide."""
    check_name("sliding piece", load.slider, motion.sliders)
    rate = named(slider_velocity(motion.sliders[load.slider].position_1, speed), f"slider_velocity.{load.slider}")
    force = -named(damper_force(_damping(load, load.slider, rate, path), rate), f"damper_force.{load.slider}")
    return force_on_slider(mechanism, motion, load.slider, force, ".damper")


def _damping(load: Damper | SliderDamper, name: str, rate: Value, path: str) -> Value:
    return given(f"damping.{name}", load.damping, f"{path}.damping") if is_traced(rate) else load.damping


@dataclass(frozen=True)
class Weight:
    """Gravity on every body."""

    gravity: float = STANDARD_GRAVITY  # Acceleration of free fall [m/s2]
    direction: float = -math.pi / 2  # Where it pulls, from the x axis [rad]


@formula("load_x", "artobolevsky_1988, ch. 12")
def weight_along(m_i: Value, g: Value, cos_ga: Value) -> Value:
    """Component of a weight along a fixed axis."""
    return m_i * g * cos_ga


def weight(load: Weight, mechanism: Mechanism, motion: Motion) -> AppliedLoads:
    """Return the weights of the bodies of a mechanism."""
    gravity: Value = load.gravity
    if is_traced(motion.grid.angle):
        gravity = given("gravity", load.gravity, "method.gravity")
    forces = []
    for body in mechanism.bodies:
        x, y = (weight_along(body.mass, gravity, part) for part in (math.cos(load.direction), math.sin(load.direction)))
        x, y = named(x, f"load_x.{body.link}.weight"), named(y, f"load_y.{body.link}.weight")
        x, y = broadcast(x, motion.grid), broadcast(y, motion.grid)
        forces.append(AppliedForce(body.link, centre_of_mass(body, motion), x, y, "weight"))
    return AppliedLoads(tuple(forces))


@runtime_checkable
class LoadLaw(Protocol):
    """A load of one's own: what it puts on the links, wherever they are.

    Examples
    --------
    A pull on point C that grows with its distance from the origin:

    >>> class Tether:
    ...     def forces(self, mechanism, motion, speed):
    ...         at = motion.points["C"]
    ...         return force_at(mechanism, motion, "C", (-50.0 * at.x.position, -50.0 * at.y.position))
    >>> isinstance(Tether(), LoadLaw)
    True
    """

    def forces(self, mechanism: Mechanism, motion: Motion, speed: Value) -> AppliedLoads:
        """Return forces at moving points [N] and torques on links [N m]; `speed`: of the driver [rad/s] or [m/s]."""


Load = (
    ProcessForce | ForceOnPoint | TorqueOnLink | Spring | SliderSpring | Damper | SliderDamper
    | Weight | LoadLaw
)  # fmt: skip


def applied_loads(mechanism: Mechanism, motion: Motion, loads: Iterable[Load], speed: Value = 0.0) -> AppliedLoads:
    """Return the forces at moving points [N] and the torques on links [N m] that act on a mechanism.

    `speed`: rate of the driver's coordinate, which dampers follow [rad/s] or [m/s].
    """
    return combine_loads(
        _applied(load, mechanism, motion, speed, f"loads[{number}]") for number, load in enumerate(loads, start=1)
    )


def _applied(load: Load, mechanism: Mechanism, motion: Motion, speed: Value, path: str) -> AppliedLoads:
    match load:
        case ProcessForce():
            return process_force(load, motion, path)
        case ForceOnPoint():
            return constant_force(load, mechanism, motion, path)
        case TorqueOnLink():
            return link_torque(load, motion, path)
        case Spring():
            return point_spring(load, mechanism, motion, path)
        case SliderSpring():
            return slider_spring(load, mechanism, motion, path)
        case Damper():
            return point_damper(load, mechanism, motion, speed, path)
        case SliderDamper():
            return slider_damper(load, mechanism, motion, speed, path)
        case Weight():
            return weight(load, mechanism, motion)
    return load.forces(mechanism, motion, speed)


@formula("potential_energy", "norton_2012, ch. 8")
def spring_energy(c: Value, s: Value, s_0: Value, F_0: Value) -> Value:
    """Potential energy of a linear spring."""
    return c * (s - s_0) ** 2 / 2 + F_0 * (s - s_0)


@formula("potential_energy", "artobolevsky_1988, ch. 15")
def energy_of_force(F_x: Value, r_x: Value, F_y: Value, r_y: Value) -> Value:
    """Potential energy of a constant force."""
    return -(F_x * r_x + F_y * r_y)


def has_potential(load: Load) -> bool:
    """Return whether a load has a potential energy."""
    return isinstance(load, Spring | SliderSpring | Weight | ForceOnPoint)


def potential_energy(mechanism: Mechanism, motion: Motion, loads: Iterable[Load]) -> Array:
    """Return the potential energy of the loads that have one (artobolevsky_1988, ch. 15). [J]"""
    energy = np.zeros_like(motion.grid.angle)
    for load in loads:
        match load:
            case Spring():
                energy += spring_energy(
                    load.stiffness, spring_length(*_ends(load, motion)[1:]), load.free_length, load.preload
                )
            case SliderSpring():
                place = motion.sliders[load.slider].position
                energy += spring_energy(load.stiffness, place, load.free_position, load.preload)
            case ForceOnPoint():
                x, y = motion.points[load.point]
                energy += energy_of_force(load.x, x.position, load.y, y.position)
            case Weight():
                pull = load.gravity * math.cos(load.direction), load.gravity * math.sin(load.direction)
                for body in mechanism.bodies:
                    x, y = centre_of_mass(body, motion)
                    energy += energy_of_force(body.mass * pull[0], x.position, body.mass * pull[1], y.position)
    return energy
