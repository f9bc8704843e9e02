"""The pressure of a diagram over the crank angle, traced piece by piece, also in a form that holds for all inputs."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from crankwork.formula.expression import Value
from crankwork.formula.replay import replay
from crankwork.formula.traced_value import (
    FormulaCall,
    Piecewise,
    ProcedureValue,
    Tabulated,
    TracedAngle,
    TracedValue,
    given,
    is_traced,
    reached,
    to_number,
)
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dead_centres import solve_monotone
from crankwork.loads.curves import CurvePoint, cubic_between, curve_between, line_between, monotone_slopes
from crankwork.loads.gas import gauge_pressure, polytropic_pressure
from crankwork.loads.indicator import DiagramPoint, IndicatorDiagram, Piece, Segment
from crankwork.loads.valves import StatedValves

# A stated volume within this tolerance is the computed volume.
_SAME_VOLUME = 1e-12
# crank angles closer together than this are equal [deg]
_SAME_ANGLE = 1e-6


def pressure_on_piston(
    pressure: TracedValue, ambient: tuple[float, str], factor: tuple[float, str], owner: str = ""
) -> TracedValue:
    """Return the pressure of gas above that on the other side, and what of it is taken.

    `ambient`, `factor`: pressure on the other side [Pa] and share, each with where it is stated; `owner`: what follows
    each key.
    """
    above = pressure.named(f"gas_pressure{owner}")
    if ambient[0]:
        above = gauge_pressure(pressure, given(f"ambient_pressure{owner}", *ambient)).named(above.key)
    if factor[0] != 1:
        above = (above * given(f"pressure_factor{owner}", *factor)).named(above.key)
    return above


def traced_pressure(
    diagram: IndicatorDiagram,
    volume: TracedValue,
    path: str = "gas",
    retold: Callable[[], TracedValue] | DiagramInput | None = None,
    owner: str = "",
) -> TracedValue:
    """Return the pressure of a diagram as a sequence of laws.

    `retold`: its form that holds for all inputs, or points and laws if it is given by them; `path`: of the diagram in
    the description; `owner`: the chamber it belongs to, if it is one of a linkage.
    """
    tracer, general = None, retold
    if isinstance(general, DiagramInput):
        tracer, general = partial(_DiagramTracer, general, diagram), partial(general.general_form, diagram)
    laws = tuple(_law(diagram, segment, volume, (path, owner), tracer) for segment in diagram.segments)
    ends = [segment.end for segment in diagram.segments]
    return TracedValue(Piecewise(ends, laws, diagram.breaks.tolist(), general), _of("diagram_pressure", owner))


def _of(key: str, owner: str, name: str = "") -> str:
    """Return the key of a column, or of its value at a named point, with the chamber it belongs to."""
    return ".".join((key, *(part for part in (owner, name) if part)))


def at_angle(column: TracedValue, degrees: float, key: str, angle: TracedValue | None = None) -> TracedValue:
    """Return the value of a column at one crank angle under a key; `angle`: that angle if it is traced."""
    value = float(replay(column, CrankGrid.from_degrees([degrees]))[0])
    return TracedValue(ProcedureValue(value, "at", (column,), degrees, angle), key)


def polytrope_origin(
    diagram: IndicatorDiagram, segment: Segment, volume: TracedValue, path: str = "gas", owner: str = ""
) -> tuple[TracedValue, TracedValue, TracedValue]:
    """Return pressure and volume of the state that a polytrope passes through, and its exponent."""
    pressure, state_volume, exponent = segment.state
    name = segment.origin
    if segment.operands:
        p_1, n_p, *remaining = segment.operands
        if name == "z" and isinstance(volume.node, FormulaCall):
            # at the end of combustion the volume is the clearance volume times the cut-off ratio
            burnt = (remaining[0] * volume.node.operands[0]).named(f"cylinder_volume.{name}")
            if math.isclose(burnt.value, state_volume, rel_tol=_SAME_VOLUME):
                return p_1, burnt, n_p
        angle = diagram.named.get(name, (None, 0.0))[0]
        return (
            p_1,
            TracedValue(ProcedureValue(state_volume, "at", (volume, *remaining), angle), f"cylinder_volume.{name}"),
            n_p,
        )
    keys = [_of(key, owner, name) if name else "" for key in ("diagram_pressure", "cylinder_volume")]
    place = f"{path}.points.{_stated(name)}"
    p_1 = given(keys[0], pressure, f"{place}.pressure")
    V_1 = given(keys[1], state_volume, f"{place}.volume")
    if name in diagram.named:
        computed = at_angle(volume, diagram.named[name][0], V_1.key)
        if math.isclose(computed.value, state_volume, rel_tol=_SAME_VOLUME):
            V_1 = computed
    kind = "compression_exponent" if segment.pressures[-1] > segment.pressures[0] else "expansion_exponent"
    return p_1, V_1, given(kind, exponent, f"{path}.pieces[{segment.piece}].exponent")


def _stated(name: str) -> str:
    """Return the name of a point as stated, without the primes of later cycles."""
    return name.rstrip("′")


def _place_of_pressure(path: str, name: str) -> str:
    """Return where the pressure of a point of a diagram stands; one that does not change has no point."""
    return f"{path}.points.{name}.pressure" if name else f"{path}.pressure"


def _law(
    diagram: IndicatorDiagram,
    segment: Segment,
    volume: TracedValue,
    stated: tuple[str, str],
    tracer: Callable[[], _DiagramTracer] | None,
) -> TracedValue:
    path, owner = stated
    match segment.law:
        case "constant":
            name, pressure = segment.origin, float(segment.pressures[0])
            plain = given(_of("diagram_pressure", owner, name), pressure, _place_of_pressure(path, _stated(name)))
            return segment.operands[0] if segment.operands else plain
        case "polytropic":
            p_1, V_1, exponent = polytrope_origin(diagram, segment, volume, path, owner)
            return polytropic_pressure(p_1, V_1, volume, exponent)  # type: ignore[no-any-return]
    word = "first_law" if segment.operands else "measured" if segment.is_measured else "curve"
    word, over = (word, None) if segment.volumes is None else ("straight", volume)
    curve = PressureCurve(segment, tracer)
    return TracedValue(Tabulated(curve, word, segment.knots.tolist(), segment.operands, over), "diagram_pressure")


@dataclass(frozen=True)
class PressureCurve:
    """The pressure on the curve of a segment over the crank angle [deg], or straight over the volume [m3]. -> [Pa]

    `tracer`: makes that of a diagram which is given by points.
    """

    segment: Segment
    tracer: Callable[[], _DiagramTracer] | None = field(default=None, compare=False)

    def __call__(self, abscissas: Array) -> Array:
        """Return the pressure at crank angles or volumes."""
        return self.segment.rounded(abscissas) if self.segment.volumes is None else self.segment.straight(abscissas)

    def between(self, abscissa: float, argument: TracedValue) -> TracedValue:
        """Return the pressure at one crank angle or volume, interpolated between two knots."""
        volumes = self.segment.volumes
        knots = self.segment.knots if volumes is None else volumes
        sense = 1 if knots[-1] >= knots[0] else -1
        index = int(np.clip(np.searchsorted(sense * knots, sense * abscissa, side="right") - 1, 0, len(knots) - 2))
        knot = self._knot if self.tracer is None else partial(self.tracer().knot, self.segment)
        ends = knot(index), knot(index + 1)
        return curve_between("diagram_pressure", argument, *ends, is_straight=volumes is not None)

    def _knot(self, index: int) -> CurvePoint:
        segment = self.segment
        degrees, pressure, slope = (float(part[index]) for part in (segment.knots, segment.pressures, segment.slopes))
        if segment.operands:
            value = TracedValue(ProcedureValue(pressure, "first_law", segment.operands))
            return CurvePoint(TracedValue(ProcedureValue(math.radians(degrees), "step")), value, math.degrees(slope))
        path = segment.places[index] if segment.places else "cycle.timing"
        if segment.volumes is not None:
            return CurvePoint(given("", float(segment.volumes[index]), path), given("", pressure, path))
        angle = given("", math.radians(degrees), path.replace(".pressure", ".angle"))
        return CurvePoint(angle, given("", pressure, path), math.degrees(slope))


def curve_laws(x: Sequence[Value], y: Sequence[Value], degrees: TracedValue) -> Iterator[tuple[Value, TracedValue]]:
    """Yield the end of each cubic between two points of a curve [deg], and its pressure at crank angles. [Pa]"""
    abscissas, pressures = column(x), column(y)
    points = zip(x, y, monotone_slopes(abscissas, pressures).tolist(), strict=True)
    for (x_i, y_i, s_i), (x_j, y_j, s_j) in itertools.pairwise(points):
        h = x_j - x_i
        yield x_j, cubic_between((y_i, y_j), (s_i * h, s_j * h), (degrees - x_i) / h)


def column(values: Sequence[Value]) -> Array:
    """Return values as an array, of objects if they are traced."""
    array = np.empty(len(values), dtype=object if is_traced(*values) else float)
    for index, value in enumerate(values):
        array[index] = value
    return array


@dataclass(frozen=True)
class TracedVolume:
    """The volume of a cylinder at single crank angles, traced; `VolumeAt` is the same in numbers. [deg] -> [m3]"""

    volume: TracedValue

    def _numbers(self, degrees: Array) -> Array:
        return replay(self.volume, CrankGrid.from_degrees(degrees))

    def __call__(self, degrees: Any) -> Any:  # noqa: ANN401 - of numbers and traced values
        """Return the volumes at crank angles, an array of traced values."""
        angles = [to_number(value) for value in degrees]
        volumes = self._numbers(np.array(angles, dtype=float))
        values = np.empty(len(angles), dtype=object)
        for index, angle in enumerate(degrees):
            argument = angle if isinstance(angle, TracedValue) else None
            values[index] = TracedValue(ProcedureValue(volumes[index], "at", (self.volume,), angles[index], argument))
        return values

    def reached(self, volume: TracedValue, start: float, end: float) -> TracedValue:
        """Return the crank angle between two others at which a volume is reached. [deg]"""
        angle = solve_monotone(self._numbers, volume.value, start, end)
        return reached(self.volume, angle, volume)


class DiagramInput(NamedTuple):
    """Input of a solved diagram: points by name, laws between them, and their path in the description.

    `volume` is that of the gas; points are counted from the crank angle `begins` [deg].
    """

    points: Mapping[str, DiagramPoint]
    pieces: tuple[Piece, ...]
    path: str
    volume: TracedValue
    clearance: TracedValue
    swept: TracedValue
    valves: StatedValves | None = None
    begins: Value = 0.0

    def general_form(self, diagram: IndicatorDiagram) -> TracedValue:
        """Return the pressure of the solved diagram over the crank angle. [Pa]"""
        tracer = _DiagramTracer(self, diagram)
        ends, laws = list[Value](), list[TracedValue]()
        for segment in diagram.segments:
            for end, law in tracer.laws(segment):
                if segment.start + _SAME_ANGLE < to_number(end) < segment.end + _SAME_ANGLE:
                    laws.append(law)
                    # the last digit decides which law a row next to a jump follows
                    is_there = not isinstance(end, TracedValue) and abs(end - segment.end) < _SAME_ANGLE
                    ends.append(segment.end if is_there else end)
                elif to_number(end) > segment.end:
                    # cut where the cycle ends
                    laws.append(law)
                    ends.append(segment.end)
                    break
        return TracedValue(Piecewise([*ends[:-1], diagram.segments[-1].end], tuple(laws)), "diagram_pressure")


class _Polytrope(NamedTuple):
    """A state that a polytrope passes through, and its exponent."""

    pressure: TracedValue
    volume: TracedValue
    exponent: TracedValue


class _DiagramTracer:
    """Traced points of a diagram, piece after piece."""

    def __init__(self, source: DiagramInput, diagram: IndicatorDiagram) -> None:
        self._source, self._named, self._cycle = source, diagram.named, diagram.segments[-1].end
        self._volume_at = TracedVolume(source.volume)
        self._pressures = {} if source.valves is None else source.valves.at_points(source.points)
        self._volumes: dict[str, TracedValue] = {}
        self._polytropes: dict[int, _Polytrope] = {}
        segments = {segment.piece: segment for segment in reversed(diagram.segments)}
        for number, piece in enumerate(source.pieces, start=1):
            first, last = piece.points[0], piece.points[-1]
            if piece.law == "polytropic" and number in segments:
                self._follow(number, piece, segments[number])
            elif piece.law == "constant" and source.points[last].pressure is None:
                self._pressures.setdefault(last, self._pressure(first))

    def laws(self, segment: Segment) -> Iterator[tuple[Value, TracedValue]]:
        """Yield the end of each law of a segment [deg], and its pressure."""
        names = self._source.pieces[segment.piece - 1].points
        if segment.law == "rounded":
            angles = [self._angle(name, float(knot)) for name, knot in zip(names, segment.knots, strict=True)]
            yield from curve_laws(angles, [self._pressure(name) for name in names], TracedAngle().degrees)
            return
        if segment.law == "straight":
            knots = [self.knot(segment, index) for index in range(len(names))]
            for index, ((V_i, p_i, _), (V_j, p_j, _)) in enumerate(itertools.pairwise(knots), start=1):
                law = line_between(p_i, p_j, (self._source.volume - V_i) / (V_j - V_i))
                yield self._angle(names[index], float(segment.knots[index])), law
            return
        end = self._angle(names[-1], float(segment.knots[-1]))
        if segment.law == "constant":
            yield end, self._pressure(segment.origin or names[0])
            return
        pressure, volume, exponent = self._polytropes[segment.piece]
        yield end, polytropic_pressure(pressure, volume, self._source.volume, exponent)

    def knot(self, segment: Segment, index: int) -> CurvePoint:
        """Return a knot of a curve: its volume if it is straight, else its crank angle [rad], and its pressure."""
        name, degrees = self._source.pieces[segment.piece - 1].points[index], float(segment.knots[index])
        point, path = self._source.points[name], f"{self._source.path}.points.{name}"
        if segment.volumes is not None:
            place = self._volume(name) if point.stroke is None else self._point_volume(name, point)
        elif point.angle is None:
            volume = self._point_volume(name, point)
            place = TracedValue(
                ProcedureValue(math.radians(degrees), "reached", (self._source.volume,), degrees, volume)
            )
        else:
            place = given("", math.radians(degrees), f"{path}.angle")
        return CurvePoint(place, self._pressure(name), math.degrees(float(segment.slopes[index])))

    def _follow(self, number: int, piece: Piece, segment: Segment) -> None:
        """Store the state of a polytrope and the pressures at both its ends."""
        first, last = piece.points[0], piece.points[-1]
        reference = piece.reference or first
        path = f"{self._source.path}.pieces[{number}].exponent"
        exponent = (
            segment.operands[1] if segment.operands else given("polytropic_exponent", piece.exponent or 0.0, path)
        )
        polytrope = _Polytrope(self._pressure(reference), self._volume(reference), exponent)
        self._polytropes[number] = polytrope
        ending = self._source.points[last]
        if ending.angle is None and ending.stroke is None and ending.pressure is not None:
            # the law with pressure and volume exchanged
            turned = polytrope.volume, polytrope.pressure, self._pressure(last), 1 / exponent
            self._volumes.setdefault(last, polytropic_pressure(*turned))
        for name, knot in zip((first, last), segment.knots, strict=True):
            if name not in self._pressures and self._source.points[name].pressure is None:
                angle = self._angle(name, float(knot))
                volume = self._volume_at([angle])[0]
                self._pressures[name] = polytropic_pressure(polytrope.pressure, polytrope.volume, volume, exponent)

    def _pressure(self, name: str) -> TracedValue:
        if name not in self._pressures:
            point, place = self._source.points[name], _place_of_pressure(self._source.path, name)
            stated = given("diagram_pressure", point.pressure or 0.0, place)
            self._pressures[name] = point.inputs[1] if point.inputs else stated
        return self._pressures[name]

    def _volume(self, name: str) -> TracedValue:
        """Return the volume of the state that a polytrope passes through."""
        point = self._source.points[name]
        if point.volume is not None:
            return given("cylinder_volume", point.volume, f"{self._source.path}.points.{name}.volume")
        if name in self._named:
            return self._volume_at([self._angle(name, self._named[name][0])])[0]  # type: ignore[no-any-return]
        if point.angle is None:
            return self._point_volume(name, point)
        angle = self._angle_stated(name, point.angle, point.angle + to_number(self._source.begins))
        return self._volume_at([angle])[0]  # type: ignore[no-any-return]

    def _point_volume(self, name: str, point: DiagramPoint) -> TracedValue:
        """Return the volume that places a point."""
        if name not in self._volumes:
            path = f"{self._source.path}.points.{name}"
            if point.stroke is None:
                self._volumes[name] = given("cylinder_volume", point.volume or 0.0, f"{path}.volume")
            else:
                share = point.inputs[0] if point.inputs else given("travel_share", point.stroke, f"{path}.stroke")
                self._volumes[name] = self._source.clearance + share * self._source.swept
        return self._volumes[name]

    def _angle(self, name: str, degrees: float) -> Value:
        """Return the crank angle of a point; `degrees`: its value in the stated design. [deg]"""
        point = self._source.points[name]
        distance = (degrees - self._named[name][0] + self._cycle / 2) % self._cycle - self._cycle / 2
        if abs(distance) > _SAME_ANGLE or (point.angle is None and point.stroke in (0.0, 1.0)):
            # the end of a constant rest of the cycle, and a dead centre, where no volume is crossed
            return round(degrees, 9)
        if point.angle is not None:
            return self._angle_stated(name, point.angle, degrees)
        return reached(self._source.volume, degrees, self._point_volume(name, point))

    def _angle_stated(self, name: str, angle: float, degrees: float) -> TracedValue:
        stated = given("", angle, f"{self._source.path}.points.{name}.angle", "deg")
        if isinstance(self._source.begins, TracedValue):
            # later by `begins` and by a whole number of cycles
            turns = round(degrees - angle - self._source.begins.value, 9)
            return stated + (self._source.begins + turns if turns else self._source.begins)
        shift = round(degrees - angle, 9)
        return stated + shift if shift else stated
