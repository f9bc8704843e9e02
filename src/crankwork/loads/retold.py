"""The pressure of a diagram told in knowns alone: where its laws end, and its curves, follow from other numbers."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from crankwork.formula.expression import Value
from crankwork.formula.known import Found, Known, KnownAngle, Pieces, given, is_known, plain
from crankwork.formula.replay import replay
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.extremes import solve_monotone
from crankwork.loads.between import cubic_between
from crankwork.loads.gas import polytropic_pressure
from crankwork.loads.indicator import DiagramPoint, IndicatorDiagram, Piece, Segment
from crankwork.loads.monotone import monotone_slopes
from crankwork.loads.valves import StatedValves

# crank angles nearer than this are one [deg]
_SAME_ANGLE = 1e-6


def curve_laws(x: Sequence[Value], y: Sequence[Value], degrees: Known) -> Iterator[tuple[Value, Known]]:
    """Yield where each cubic between two points of a curve ends [deg], and its pressure at crank angles. [Pa]"""
    at, pressures = column(x), column(y)
    every = zip(x, y, monotone_slopes(at, pressures).tolist(), strict=True)
    for (x_i, y_i, s_i), (x_j, y_j, s_j) in itertools.pairwise(every):
        h = x_j - x_i
        yield x_j, cubic_between((y_i, y_j), (s_i * h, s_j * h), (degrees - x_i) / h)


def column(of: Sequence[Value]) -> Array:
    """Return numbers as an array, of objects where they are knowns."""
    made = np.empty(len(of), dtype=object if is_known(*of) else float)
    for at, one in enumerate(of):
        made[at] = one
    return made


@dataclass(frozen=True)
class RememberedVolume:
    """The volume of a cylinder at single crank angles, remembered: what `VolumeAt` is in numbers. [deg] -> [m3]"""

    volume: Known

    def _numbers(self, degrees: Array) -> Array:
        return replay(self.volume, CrankGrid.from_degrees(degrees))

    def __call__(self, degrees: Any) -> Any:  # noqa: ANN401 - of numbers and knowns
        """Return the volumes at crank angles, an array of knowns."""
        angles = [plain(one) for one in degrees]
        volumes = self._numbers(np.array(angles, dtype=float))
        found = np.empty(len(angles), dtype=object)
        for place, one in enumerate(degrees):
            by = one if isinstance(one, Known) else None
            found[place] = Known(Found(volumes[place], "at", (self.volume,), angles[place], by))
        return found

    def reached(self, volume: Known, start: float, end: float) -> Known:
        """Return where the volume is reached between two crank angles. [deg]"""
        angle = solve_monotone(self._numbers, volume.value, start, end)
        return Known(Found(angle, "reached", (self.volume,), angle, volume))


class StatedDiagram(NamedTuple):
    """What a diagram was solved from: points by name, laws between them, and where a description states these.

    `volume` is that of the gas; `begins` is the crank angle that points are counted from [deg].
    """

    points: Mapping[str, DiagramPoint]
    pieces: tuple[Piece, ...]
    path: str
    volume: Known
    clearance: Known
    swept: Known
    valves: StatedValves | None = None
    begins: Value = 0.0

    def retold(self, diagram: IndicatorDiagram) -> Known:
        """Return the pressure of the solved diagram over the crank angle. [Pa]"""
        told = _Told(self, diagram)
        ends, laws = list[Value](), list[Known]()
        for segment in diagram.segments:
            for end, law in told.laws(segment):
                if segment.start + _SAME_ANGLE < plain(end) < segment.end + _SAME_ANGLE:
                    laws.append(law)
                    # which law a row beside a jump follows is told by its last digit
                    is_there = not isinstance(end, Known) and abs(end - segment.end) < _SAME_ANGLE
                    ends.append(segment.end if is_there else end)
                elif plain(end) > segment.end:
                    # cut where the cycle ends
                    laws.append(law)
                    ends.append(segment.end)
                    break
        return Known(Pieces([*ends[:-1], diagram.segments[-1].end], tuple(laws)), "diagram_pressure")


class _Polytrope(NamedTuple):
    """A state that a polytrope passes through, and its exponent."""

    pressure: Known
    volume: Known
    exponent: Known


class _Told:
    """Points of a diagram as they become known, piece after piece."""

    def __init__(self, of: StatedDiagram, diagram: IndicatorDiagram) -> None:
        self._of, self._named, self._cycle = of, diagram.named, diagram.segments[-1].end
        self._volume_at = RememberedVolume(of.volume)
        self._pressures = {} if of.valves is None else of.valves.at_points(of.points)
        self._volumes: dict[str, Known] = {}
        self._polytropes: dict[int, _Polytrope] = {}
        segments = {one.piece: one for one in reversed(diagram.segments)}
        for number, piece in enumerate(of.pieces, start=1):
            first, last = piece.points[0], piece.points[-1]
            if piece.law == "polytropic" and number in segments:
                self._follow(number, piece, segments[number])
            elif piece.law != "rounded" and of.points[last].pressure is None:
                self._pressures.setdefault(last, self._pressure(first))

    def laws(self, segment: Segment) -> Iterator[tuple[Value, Known]]:
        """Yield where each law of a segment ends [deg], and its pressure."""
        names = self._of.pieces[segment.piece - 1].points
        if segment.law == "rounded":
            angles = [self._angle(name, float(at)) for name, at in zip(names, segment.knots, strict=True)]
            yield from curve_laws(angles, [self._pressure(name) for name in names], KnownAngle().degrees)
            return
        end = self._angle(names[-1], float(segment.knots[-1]))
        if segment.law == "constant":
            yield end, self._pressure(segment.origin or names[0])
            return
        pressure, volume, exponent = self._polytropes[segment.piece]
        yield end, polytropic_pressure(pressure, volume, self._of.volume, exponent)

    def _follow(self, number: int, piece: Piece, segment: Segment) -> None:
        """Remember the state of a polytrope, and the points at both its ends."""
        first, last = piece.points[0], piece.points[-1]
        reference = piece.reference or first
        path = f"{self._of.path}.pieces[{number}].exponent"
        exponent = segment.of[1] if segment.of else given("polytropic_exponent", piece.exponent or 0.0, path)
        found = _Polytrope(self._pressure(reference), self._volume(reference), exponent)
        self._polytropes[number] = found
        ending = self._of.points[last]
        if ending.angle is None and ending.stroke is None and ending.pressure is not None:
            # the law with pressure and volume in each other's place
            turned = found.volume, found.pressure, self._pressure(last), 1 / exponent
            self._volumes.setdefault(last, polytropic_pressure(*turned))
        for name, at in zip((first, last), segment.knots, strict=True):
            if name not in self._pressures and self._of.points[name].pressure is None:
                angle = self._angle(name, float(at))
                volume = self._volume_at([angle])[0]
                self._pressures[name] = polytropic_pressure(found.pressure, found.volume, volume, exponent)

    def _pressure(self, name: str) -> Known:
        if name not in self._pressures:
            pressure, path = self._of.points[name].pressure, f"{self._of.path}.points.{name}.pressure"
            self._pressures[name] = given("diagram_pressure", pressure or 0.0, path)
        return self._pressures[name]

    def _volume(self, name: str) -> Known:
        """Return the volume of the state that a polytrope passes through."""
        point = self._of.points[name]
        if point.volume is not None:
            return given("cylinder_volume", point.volume, f"{self._of.path}.points.{name}.volume")
        if name in self._named:
            return self._volume_at([self._angle(name, self._named[name][0])])[0]  # type: ignore[no-any-return]
        if point.angle is None:
            return self._wanted(name, point)
        angle = self._angle_stated(name, point.angle, point.angle + plain(self._of.begins))
        return self._volume_at([angle])[0]  # type: ignore[no-any-return]

    def _wanted(self, name: str, point: DiagramPoint) -> Known:
        """Return the volume that places a point."""
        if name not in self._volumes:
            path = f"{self._of.path}.points.{name}"
            if point.stroke is None:
                self._volumes[name] = given("cylinder_volume", point.volume or 0.0, f"{path}.volume")
            else:
                share = given("stroke_share", point.stroke, f"{path}.stroke")
                self._volumes[name] = self._of.clearance + share * self._of.swept
        return self._volumes[name]

    def _angle(self, name: str, degrees: float) -> Value:
        """Return the crank angle of a point, which is that number in the stated design. [deg]"""
        point = self._of.points[name]
        apart = (degrees - self._named[name][0] + self._cycle / 2) % self._cycle - self._cycle / 2
        if abs(apart) > _SAME_ANGLE or (point.angle is None and point.stroke in (0.0, 1.0)):
            # the end of a cycle that rests, and a dead centre, where nothing is crossed
            return round(degrees, 9)
        if point.angle is not None:
            return self._angle_stated(name, point.angle, degrees)
        return Known(Found(degrees, "reached", (self._of.volume,), degrees, self._wanted(name, point)))

    def _angle_stated(self, name: str, angle: float, degrees: float) -> Known:
        stated = given("", angle, f"{self._of.path}.points.{name}.angle", "deg")
        if isinstance(self._of.begins, Known):
            # later by this, and by what whole cycles lie between
            turns = round(degrees - angle - self._of.begins.value, 9)
            return stated + (self._of.begins + turns if turns else self._of.begins)
        by = round(degrees - angle, 9)
        return stated + by if by else stated
