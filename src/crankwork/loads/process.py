"""Loads over a stroke or the crank angle, as numbers or traced values: cutting, pressing, pumping."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np

from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.expression import Value
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
from crankwork.kinematics.motion import Motion
from crankwork.kinematics.traced_motion import angle_of, interpolant_of
from crankwork.loads.applied_loads import AppliedLoads, check_name, force_along_guide, force_at, torque_on
from crankwork.loads.curves import Curve, CurvePoint, cubic_between, curve_between, line_between, monotone_slopes
from crankwork.loads.curves import LoadCurve as LoadTable
from crankwork.mechanism.dyads import Branch
from crankwork.mechanism.mechanism import Mechanism
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
    begins_at_end: bool = False  # Whether that is an end of the stroke, which moves with the linkage
    # On the working stroke only, or on the return stroke too, with the same direction
    acts: Literal["forward", "both"] = "forward"


@dataclass(frozen=True)
class ForceOnPoint:
    """A constant force at a point."""

    point: str  # Where it acts
    # Its components along the fixed axes [N]
    x: float
    y: float
    link: str = ""  # The link it acts on; empty for the first of the links that meet there


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
