"""The torques on a shaft as a description gives them, traced over the angle, and their excess work."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import Piecewise, TracedAngle, TracedValue, absent, delayed, given, total
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.machine import Machine
from crankwork.preparation import traced_inputs
from crankwork.shaft.curve import Curve
from crankwork.shaft.fluctuation import ExcessWork, excess_work
from crankwork.shaft.torque_diagram import (
    ShaftTorques,
    TorqueDiagram,
    WorkStroke,
    angle_in_plate,
    force_of_slope,
    peak_torque_of_work,
    sheared_area_of_hole,
    shearing_force,
    torque_between_points,
    torque_of_harmonic,
    torque_of_work,
)
from crankwork.units import UNITS


def torque_trace(machine: Machine, turning: ShaftTorques, table: str, key: str, w: TracedValue) -> TracedValue:
    """Return a torque of a description over the angle, that of all cylinders."""
    diagram = turning.diagrams[table]
    single = _Torque(machine, diagram, table, key, w, turning.cycle).column()
    parts = [
        delayed(single, round(math.degrees(delay), 9), machine.cycle, f"{key}.{number}")
        for number, delay in enumerate(diagram.delays, start=1)
    ]
    return total(key, parts)


def traced_torques(machine: Machine, turning: ShaftTorques, w: TracedValue) -> CycleInterpolant:
    """Return the torques of a description over the angle, by the keys of their columns."""
    traced = {key: torque_trace(machine, turning, table, key, w) for table, key in torque_keys(turning)}
    return CycleInterpolant(traced, CrankGrid.from_degrees, machine.cycle)


def works_at_once(machine: Machine, turning: ShaftTorques, table: str, key: str, w: TracedValue) -> TracedValue:
    """Return the work of a period that is done at single angles."""
    diagram = turning.diagrams[table]
    torque = _Torque(machine, diagram, table, key, w, turning.cycle)
    works = [torque.work(number) for number, stroke in enumerate(diagram.strokes, start=1) if not stroke.over]
    return total("stroke_work", works * len(diagram.delays))


def work_scale(machine: Machine, table: str) -> TracedValue:
    """Return the work that a unit of area of a drawing represents, absent without a scale."""
    work, torque, angle = (
        traced_inputs.stated_value(machine, f"{table}.scale.{name}", f"{name}_scale")
        for name in ("work", "torque", "angle")
    )
    is_product = work.is_absent and not (torque.is_absent or angle.is_absent)
    return (torque * angle).named("work_scale") if is_product else work


class _Torque:
    """One torque of a description, traced."""

    def __init__(
        self, machine: Machine, diagram: TorqueDiagram, table: str, key: str, w: TracedValue, cycle: float
    ) -> None:
        self._machine, self._diagram, self._table, self._key, self._w = machine, diagram, table, key, w
        self._times = round(cycle / diagram.period)
        self._period, self._cycle = math.degrees(diagram.period), machine.cycle

    def column(self) -> TracedValue:
        """Return the torque of one cylinder."""
        diagram = self._diagram
        if diagram.points:
            return self._through_points().named(self._key)
        constant = constant_torque(self._machine, diagram, self._table, f"{self._key}.0", self._w)
        parts = [constant] if diagram.constant else []
        for number, (order, sine, cosine) in enumerate(diagram.harmonics, start=1):
            path = f"{self._table}.harmonics[{number}]"
            a, b = (
                given(f"{key}.{order:g}", value, f"{path}.{name}") if value else absent(key)
                for key, value, name in (("harmonic_sine", sine, "sin"), ("harmonic_cosine", cosine, "cos"))
            )
            k = given("harmonic_order", order, f"{path}.order")
            part: TracedValue = torque_of_harmonic(a, b, k, TracedAngle().angle)
            parts.append(part.named(f"{self._key}.order_{order:g}"))
        for number, stroke in enumerate(diagram.strokes, start=1):
            if stroke.over:
                parts.extend(self._stretch(stroke, number))
        return total(self._key, parts) if parts else absent(self._key)

    def _through_points(self) -> TracedValue:
        """Return the broken line through the points."""
        laws, ends = [], []
        for turn in range(self._times):
            angle = TracedAngle().shifted(-turn * self._period).angle
            for line in self._diagram.lines():
                first, last = (self._point(index, moved) for index, moved in zip(line[:2], line.moved, strict=True))
                laws.append(torque_between_points(first[0], last[0], angle, first[1], last[1]))
                ends.append(turn * self._period + math.degrees(line.end))
        ends[-1] = self._cycle
        return TracedValue(Piecewise(ends, tuple(laws)), self._key)

    def _point(self, index: int, moved: int) -> tuple[TracedValue, TracedValue]:
        """Return torque and angle of a point, moved by some periods."""
        angle, torque = self._diagram.points[index]
        height = given(f"{self._key}.{index + 1}", torque, f"{self._table}.torque[{index + 1}]")
        place = given(f"crank_angle.{index + 1}", angle, f"{self._table}.at[{index + 1}]")
        if moved:
            period = self._period_value()
            place = (place + period if moved > 0 else place - period).named(f"crank_angle.{index + 1}")
        return height, place

    def _stretch(self, stroke: WorkStroke, number: int) -> list[TracedValue]:
        """Return the torque of a working stroke, in each period."""
        path, name = f"{self._table}.strokes[{number}]", f"{self._key}.stretch_{number}"
        work, over, end = self.work(number), self._over(stroke, number), math.degrees(stroke.over)
        zero, angle = absent(self._key), TracedAngle().angle
        ends: list[TracedValue | float] = [over * math.degrees(1.0)]
        if stroke.shape == "constant":
            laws = [torque_of_work(work, over)]
        else:
            peak: TracedValue = peak_torque_of_work(work, over).named(f"{self._key}.peak")
            start = absent("crank_angle")
            top = (given("peak_share", stroke.peak, f"{path}.peak") * over).named("crank_angle.peak")
            laws = []
            if stroke.peak > 0:
                laws.append(torque_between_points(zero, peak, angle, start, top))
            if stroke.peak < 1:
                laws.append(torque_between_points(peak, zero, angle, top, over))
            if len(laws) == 2:
                ends.insert(0, top * math.degrees(1.0))
        if end < self._cycle - 1e-9:
            laws, ends = [*laws, zero], [*ends, self._cycle]
        single = TracedValue(Piecewise(ends, tuple(laws)), name)
        begin = math.degrees(stroke.start)
        return [
            delayed(single, round(begin + turn * self._period, 9), self._cycle, f"{name}.{turn + 1}")
            for turn in range(self._times)
        ]

    def work(self, number: int) -> TracedValue:
        """Return the work of a stroke: stated, of an area of the drawing, or of shearing."""
        path, scale = f"{self._table}.strokes[{number}]", work_scale(self._machine, self._table)
        plain = given(f"stroke_work.{number}", self._diagram.strokes[number - 1].work, f"{path}.work")
        work, strength = self._machine.stated.get(f"{path}.work"), self._of_stroke(number, "shear_strength")
        energy = self._of_stroke(number, "shear_energy")
        if not (energy.is_absent and strength.is_absent):
            thickness, hole = (
                self._of_stroke(number, "thickness", "plate_thickness"),
                self._of_stroke(number, "hole_diameter"),
            )
            if hole.is_absent:
                area = self._of_stroke(number, "cut_width") * thickness
            else:
                area = sheared_area_of_hole(self._machine.method.pi, hole, thickness)
            area = area.named(f"sheared_area.{number}")
            by_strength = not strength.is_absent
            sheared = self._by_strength(number, strength, area, thickness) if by_strength else energy * area
            return traced_inputs.checked(sheared, plain)
        if not scale.is_absent and work is not None and UNITS[work.unit].dimension == "area":
            return traced_inputs.checked(scale * given("drawn_area", work.value, f"{path}.work"), plain)
        return plain

    def _of_stroke(self, number: int, name: str, key: str = "") -> TracedValue:
        """Return a number of a stroke, absent if it is not stated; `key`: of its quantity where that differs."""
        return traced_inputs.stated_value(self._machine, f"{self._table}.strokes[{number}].{name}", key or name)

    def _by_strength(
        self, number: int, strength: TracedValue, area: TracedValue, thickness: TracedValue
    ) -> TracedValue:
        """Return the work of a stroke that shears an area by its strength, until the plate is cut through."""
        depth = (self._of_stroke(number, "penetration") * thickness).named("sheared_depth")
        force, longer = shearing_force(strength, area), self._of_stroke(number, "punch_slope")
        if longer.is_absent:
            return force.named(f"shearing_force.{number}") * depth  # type: ignore[no-any-return]
        force = force_of_slope(force.named(f"flat_shearing_force.{number}"), depth, longer)
        return force.named(f"shearing_force.{number}") * (depth + longer)  # type: ignore[no-any-return]

    def _over(self, stroke: WorkStroke, number: int) -> TracedValue:
        """Return the angle of a stroke: stated, of a time, of a part of the period, or of a punch in a plate."""
        path = f"{self._table}.strokes[{number}].over"
        plain, over = given(f"stroke_angle.{number}", stroke.over, path), self._machine.stated.get(path)
        punch, period = self._of_stroke(number, "punch_stroke"), self._period_value()
        if not punch.is_absent:
            thickness = self._of_stroke(number, "thickness", "plate_thickness")
            return traced_inputs.checked(angle_in_plate(thickness, period, punch), plain)
        if over is not None and over.unit and UNITS[over.unit].dimension == "time":
            return traced_inputs.checked(self._w * given("stroke_time", over.value, path), plain)
        if over is not None and not over.unit:
            return traced_inputs.checked(given("stroke_share", over.value, path) * period, plain)
        return plain

    def _period_value(self) -> TracedValue:
        """Return the period of the torque."""
        return given("cycle_angle", self._diagram.period, f"{self._table}.period")


COLUMN_OF = {"torque": "turning_moment", "load": "load_torque"}
# of the largest torque: what is rounding
NEGLIGIBLE = 1e-13


def torque_keys(turning: ShaftTorques) -> Iterator[tuple[str, str]]:
    """Yield the tables that are given, each with the key of its column."""
    yield from ((table, COLUMN_OF[table]) for table in turning.diagrams)


def impulsive_work(diagram: TorqueDiagram) -> float:
    """Return the work of a period that is done at one angle. [J]"""
    return sum(stroke.work for stroke in diagram.strokes if not stroke.over) * len(diagram.delays)


def curve_of(over: CycleInterpolant, key: str) -> Curve:
    """Return a torque over its period. [rad]"""
    return Curve.legendre(np.radians(over.edges), over.polynomials(key))


def excess_of_torques(turning: ShaftTorques, over: CycleInterpolant) -> tuple[Curve, ExcessWork]:
    """Return the excess torque less its mean, and the excess work with the work that is done at one angle."""
    parts = {"torque": 1.0, "load": -1.0}
    net = Curve.constant(0.0, turning.cycle)
    for table, key in torque_keys(turning):
        net = net + curve_of(over, key) * parts[table]
    result = excess_work(net)
    low, _, high, _ = net.extremes()
    if result.work <= NEGLIGIBLE * turning.cycle * max(abs(low), abs(high)):
        # a variation that is rounding is zero
        net = Curve.constant(result.mean_torque, turning.cycle)
        result = excess_work(net)
    jumps = [
        _sawtooth(item, turning.cycle) * parts[key] for key, item in turning.diagrams.items() if impulsive_work(item)
    ]
    if not jumps:
        return net - result.mean_torque, result
    curve, at_once = result.curve, 0.0
    for jump in jumps:
        curve = curve + jump
    for table, diagram in turning.diagrams.items():
        at_once += parts[table] * impulsive_work(diagram) / diagram.period
    mean = result.mean_torque + at_once
    combined = ExcessWork(curve, curve.extremes(), mean, mean * turning.cycle)
    return net - mean, combined


def _sawtooth(diagram: TorqueDiagram, cycle: float) -> Curve:
    """Return the work that is done at single angles, less its mean over the angle, zero at an angle of zero."""
    jumps = sorted(
        ((stroke.start + delay) % diagram.period + index * diagram.period, stroke.work)
        for index in range(round(cycle / diagram.period))
        for stroke in diagram.strokes
        if not stroke.over
        for delay in diagram.delays
    )
    slope, done = sum(work for _, work in jumps) / cycle, 0.0
    corners = [(0.0, 0.0)]
    for angle, work in jumps:
        corners += [(angle, done - slope * angle), (angle, done + work - slope * angle)]
        done += work
    corners.append((cycle, 0.0))
    return Curve.linear(*zip(*corners, strict=True))


def constant_torque(machine: Machine, diagram: TorqueDiagram, table: str, key: str, w: TracedValue) -> TracedValue:
    """Return a constant torque that is stated, or that of a power."""
    power, plain = (
        traced_inputs.stated_value(machine, f"{table}.power", "shaft_power"),
        given(key, diagram.constant, f"{table}.constant"),
    )
    return plain if power.is_absent else traced_inputs.checked(power / w, plain)


def excess_work_of(machine: Machine, turning: ShaftTorques, w: TracedValue) -> float:
    """Return the excess work of the torques on a shaft, of the areas of loops, or as stated. [J]"""
    diagrams = turning.diagrams.values()
    if all(diagram.is_complete for diagram in diagrams):
        return excess_of_torques(turning, traced_torques(machine, turning, w))[1].work
    return next(float(np.ptp(np.cumsum(item.loops))) if item.loops else item.excess or 0.0 for item in diagrams)
