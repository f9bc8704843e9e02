"""A torque over the angle of a shaft as it is traced: lines between points, orders, stretches, cylinders."""

from __future__ import annotations

import math

from crankwork.analysis import traced_inputs
from crankwork.formula.traced_value import Piecewise, TracedAngle, TracedValue, absent, delayed, given, total
from crankwork.machine import Machine
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


def works_at_once(machine: Machine, turning: ShaftTorques, table: str, key: str, w: TracedValue) -> TracedValue:
    """Return the work of a period that is done at single angles."""
    diagram = turning.diagrams[table]
    torque = _Torque(machine, diagram, table, key, w, turning.cycle)
    works = [torque.work(number) for number, stroke in enumerate(diagram.strokes, start=1) if not stroke.over]
    return total("stroke_work", works * len(diagram.delays))


def work_scale(machine: Machine, table: str) -> TracedValue | None:
    """Return the work that a unit of area of a drawing represents, None without a scale."""
    stated = {name: machine.stated.get(f"{table}.scale.{name}") for name in ("work", "torque", "angle")}
    known = {
        name: given(f"{name}_scale", value.value, f"{table}.scale.{name}")
        for name, value in stated.items()
        if value is not None
    }
    if "work" in known:
        return known["work"]
    return (known["torque"] * known["angle"]).named("work_scale") if len(known) == 2 else None


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
        parts = [self._constant()] if diagram.constant else []
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

    def _constant(self) -> TracedValue:
        """Return the constant part: stated, or that of a power."""
        path, power = f"{self._table}.constant", self._machine.stated.get(f"{self._table}.power")
        plain = given(f"{self._key}.0", self._diagram.constant, path)
        if power is None:
            return plain
        return traced_inputs.checked(given("shaft_power", power.value, f"{self._table}.power") / self._w, plain)

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
            period = given("cycle_angle", self._diagram.period, f"{self._table}.period")
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
        machine, stated, path = self._machine, self._machine.stated, f"{self._table}.strokes[{number}]"
        plain = given(f"stroke_work.{number}", self._diagram.strokes[number - 1].work, f"{path}.work")
        scale = work_scale(machine, self._table)
        work, shear = stated.get(f"{path}.work"), stated.get(f"{path}.shear_energy")
        strength = stated.get(f"{path}.shear_strength")
        if shear is not None or strength is not None:
            thickness = given("plate_thickness", stated[f"{path}.thickness"].value, f"{path}.thickness")
            hole, strip = stated.get(f"{path}.hole_diameter"), stated.get(f"{path}.cut_width")
            if hole is not None:
                diameter = given("hole_diameter", hole.value, f"{path}.hole_diameter")
                area: TracedValue = sheared_area_of_hole(machine.method.pi, diameter, thickness)
            else:
                width = given("cut_width", strip.value if strip else 0.0, f"{path}.cut_width")
                area = width * thickness
            area = area.named(f"sheared_area.{number}")
            if strength is not None:
                return traced_inputs.checked(self._by_strength(number, area, thickness), plain)
            energy = given("shear_energy", shear.value if shear else 0.0, f"{path}.shear_energy")
            return traced_inputs.checked(energy * area, plain)
        if scale is not None and work is not None and UNITS[work.unit].dimension == "area":
            return traced_inputs.checked(scale * given("drawn_area", work.value, f"{path}.work"), plain)
        return plain

    def _by_strength(self, number: int, area: TracedValue, thickness: TracedValue) -> TracedValue:
        """Return the work of a stroke that shears an area by its strength, until the plate is cut through."""
        stated, path = self._machine.stated, f"{self._table}.strokes[{number}]"
        strength = given("shear_strength", stated[f"{path}.shear_strength"].value, f"{path}.shear_strength")
        depth = given("penetration", stated[f"{path}.penetration"].value, f"{path}.penetration") * thickness
        depth, force = depth.named("sheared_depth"), shearing_force(strength, area)
        slope = stated.get(f"{path}.punch_slope")
        if slope is None:
            return force.named(f"shearing_force.{number}") * depth  # type: ignore[no-any-return]
        longer = given("punch_slope", slope.value, f"{path}.punch_slope")
        force = force_of_slope(force.named(f"flat_shearing_force.{number}"), depth, longer)
        return force.named(f"shearing_force.{number}") * (depth + longer)  # type: ignore[no-any-return]

    def _over(self, stroke: WorkStroke, number: int) -> TracedValue:
        """Return the angle of a stroke: stated, of a time, of a part of the period, or of a punch in a plate."""
        stated, path = self._machine.stated, f"{self._table}.strokes[{number}]"
        plain = given(f"stroke_angle.{number}", stroke.over, f"{path}.over")
        over, punch = stated.get(f"{path}.over"), stated.get(f"{path}.punch_stroke")
        period = given("cycle_angle", self._diagram.period, f"{self._table}.period")
        if punch is not None:
            thickness = given("plate_thickness", stated[f"{path}.thickness"].value, f"{path}.thickness")
            return traced_inputs.checked(
                angle_in_plate(thickness, period, given("punch_stroke", punch.value, f"{path}.punch_stroke")), plain
            )
        if over is not None and over.unit and UNITS[over.unit].dimension == "time":
            return traced_inputs.checked(self._w * given("stroke_time", over.value, f"{path}.over"), plain)
        if over is not None and not over.unit:
            return traced_inputs.checked(given("stroke_share", over.value, f"{path}.over") * period, plain)
        return plain
