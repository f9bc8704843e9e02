"""The indicator diagram: gas pressure over the crank angle, piece by piece, closed over the cycle.

The description is named points and the laws between them. Solving it against the volume of the cylinder gives
segments with a pressure at any angle. A segment owns its end, not its start: at a jump the pressure before it counts.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from crankwork.errors import CrankworkError
from crankwork.formula.traced_value import TracedValue
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.dead_centres import solve_monotone
from crankwork.loads.curves import hermite, hermite_slope, monotone_slopes
from crankwork.loads.gas import polytropic_pressure
from crankwork.locale import ErrorMessage

Law = Literal["constant", "polytropic", "rounded", "straight"]
# Cylinder volume [m3], or its derivative [m3/rad], of crank angles [deg].
VolumeAt = Callable[[Array], Array]
_CLOSING = 1e-3
# pieces that end nearer than this to where the next begins leave no gap [deg]
_SAME_ANGLE = 1e-5
# parts of pieces that are shorter come from rounding [deg]
_SAME_ROUNDED = 1e-9
# share of the stroke by which a volume may miss that of a dead centre
_SAME_PLACE = 1e-12
# samples of a volume that may be constant
_SAMPLES = 5
# share of the largest volume that counts as zero
_EMPTY = 1e-12
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
# Longest interval that gets one set of eight nodes. [deg]
_WIDTH = 15.0


class DiagramError(CrankworkError):
    """An inconsistent diagram; `key` is the part of the description at fault."""

    def __init__(self, key: str, message: str) -> None:
        super().__init__(message)
        self.key = key


@dataclass(frozen=True)
class DiagramPoint:
    """A named point: crank angle [deg] and pressure [Pa]; either may be left to the law that ends there.

    `volume` replaces the computed volume of the cylinder at that angle [m3]. Without an angle the point is where the
    volume next reaches it, or `stroke`, a share of the stroke. [-]
    `inputs`: stroke and pressure as they follow from a description that states no points.
    """

    angle: float | None = None
    pressure: float | None = None
    volume: float | None = None
    stroke: float | None = None
    inputs: tuple[TracedValue, ...] = field(default=(), compare=False)


@dataclass(frozen=True)
class Piece:
    """A law between two named points, through more of them if it is rounded or straight over the volume.

    `reference` names the state a polytrope passes through, by default the first point.
    """

    law: Law
    points: tuple[str, ...]
    exponent: float | None = None
    reference: str | None = None


def constant_diagram(pressure: float, cycle: float) -> tuple[dict[str, DiagramPoint], tuple[Piece, ...]]:
    """Return points without names and the law of a pressure [Pa] that does not change over a cycle [deg]."""
    return {"": DiagramPoint(0.0, pressure), "'": DiagramPoint(cycle, pressure)}, (Piece("constant", ("", "'")),)


class DeadCentres(NamedTuple):
    """Crank angles of the extremes of a volume within its period. [deg]"""

    angles: tuple[float, ...]
    period: float = 360.0


@dataclass(frozen=True)
class Segment:
    """A solved piece from `start` to `end` [deg]: knots of a curve [deg], [Pa], or a polytrope's state.

    `origin` is the named point of that state or pressure; `piece` the number of the piece in the description; `places`
    where the description or a file of measurements states the pressures at the knots. `operands` of a calculated
    pressure: the pressure of a constant; pressure, exponent and operands of the volume of a polytrope; those of the
    equation of a curve. `volumes` at the knots if the law is straight over them. [m3]
    """

    start: float
    end: float
    law: Law
    knots: Array
    pressures: Array
    slopes: Array
    state: tuple[float, float, float] = (0.0, 0.0, 0.0)
    origin: str = ""
    piece: int = 0
    places: tuple[str, ...] = field(default=(), compare=False)
    operands: tuple[TracedValue, ...] = field(default=(), compare=False)
    volumes: Array | None = None

    @property
    def is_measured(self) -> bool:
        """Whether its knots are samples of a file."""
        return any(":" in place or ".measured." in place for place in self.places)

    def rounded(self, degrees: Array) -> Array:
        """Return the pressure on the curve through the knots, shape (n,). [Pa]"""
        return hermite(self.knots, self.pressures, self.slopes, degrees)

    def pressure(self, degrees: Array, volume: Array) -> Array:
        """Return the pressure at crank angles of this segment. [Pa]"""
        if self.law == "constant":
            return np.full_like(degrees, self.pressures[0])
        if self.law == "polytropic":
            pressure, reference, exponent = self.state
            return np.asarray(polytropic_pressure(pressure, reference, volume, exponent))
        return self.rounded(degrees) if self.volumes is None else self.straight(volume)

    def straight(self, volume: Array) -> Array:
        """Return the pressure on straight lines between volumes, which rise or fall. [Pa]"""
        volumes = np.array([]) if self.volumes is None else self.volumes
        order = slice(None, None, 1 if volumes[-1] >= volumes[0] else -1)
        return np.interp(volume, volumes[order], self.pressures[order])

    def work(self, volume_at: VolumeAt, volume: Array | None = None) -> float:
        """Return the integral of pressure by volume over the segment (heywood_1988, sec. 2.4). [J]

        Closed form for constants and polytropes, by parts for curves. `volume`: at both ends if known [m3], (2,).
        """
        ends = np.array([self.start, self.end])
        volume = volume_at(ends) if volume is None else volume
        pressure = self.pressure(ends, volume)
        if self.law == "constant":
            return float(pressure[0] * (volume[1] - volume[0]))
        if self.law == "polytropic":
            # p1 V1 ((V2/V1)^(1-n) - 1) / (1-n), in a form that keeps its digits as n goes to 1
            growth, less = np.log(volume[1] / volume[0]), 1 - self.state[2]
            return float(pressure[0] * volume[0] * (np.expm1(less * growth) / less if less else growth))
        # the end of the cycle may cut a curve
        knots = np.clip(self.knots, self.start, self.end)
        if self.volumes is not None:
            volume = volume_at(knots)
            return float(np.trapezoid(self.straight(volume), volume))
        nodes, weights = quadrature(knots)
        slope = hermite_slope(self.knots, self.pressures, self.slopes, nodes)
        change = weights @ (volume_at(nodes) * np.degrees(slope))
        return float(pressure[1] * volume[1] - pressure[0] * volume[0] - change)


@dataclass(frozen=True)
class IndicatorDiagram:
    """A solved diagram: segments in order, from 0 to the end of the cycle.

    `jumps` lists angle [deg] and pressure step [Pa] where two segments meet at one named point at different pressures.
    """

    segments: tuple[Segment, ...]
    named: Mapping[str, tuple[float, float]]
    jumps: tuple[tuple[str, float, float], ...] = ()

    @property
    def breaks(self) -> Array:
        """Crank angles where the law changes or a curve has a knot. [deg]"""
        knots = [segment.knots for segment in self.segments]
        return np.array(sorted({*np.concatenate(knots).tolist(), self.segments[-1].end}))

    def work(self, volume_at: VolumeAt) -> float:
        """Return the area of the diagram over the cylinder volume, the work of one cycle. [J]

        Source: heywood_1988, sec. 2.4.
        """
        ends = volume_at(np.array([(segment.start, segment.end) for segment in self.segments]).ravel()).reshape(-1, 2)
        return sum(segment.work(volume_at, volume) for segment, volume in zip(self.segments, ends, strict=True))

    def later(self, shift: float) -> IndicatorDiagram:
        """Return the diagram shifted to later crank angles, closed over the cycle. [deg]"""
        cycle = self.segments[-1].end
        shift %= cycle
        moved = []
        for turn, segment in itertools.product((shift - cycle, shift), self.segments):
            start, end = max(segment.start + turn, 0.0), min(segment.end + turn, cycle)
            if end - start > _SAME_ROUNDED:
                moved.append(replace(segment, start=start, end=end, knots=segment.knots + turn))
        moved[-1] = replace(moved[-1], end=cycle)
        named = {name: ((angle + shift) % cycle, pressure) for name, (angle, pressure) in self.named.items()}
        jumps = tuple((name, (angle + shift) % cycle, step) for name, angle, step in self.jumps)
        return IndicatorDiagram(tuple(moved), named, jumps) if shift else self

    def pressure(self, degrees: Array, volume: Array) -> Array:
        """Return the pressure at ascending crank angles within one cycle. [Pa]"""
        edges = [0, *np.searchsorted(degrees, [segment.end for segment in self.segments], side="right")]
        edges[-1] = len(degrees)
        result = np.empty_like(degrees)
        for segment, (first, last) in zip(self.segments, itertools.pairwise(edges), strict=True):
            part = slice(first, last)
            result[part] = segment.pressure(degrees[part], volume[part])
        return result


def solve_diagram(
    points: Mapping[str, DiagramPoint],
    pieces: tuple[Piece, ...],
    cycle: float,
    volume_at: VolumeAt,
    *,
    dead_centres: tuple[float, ...] | DeadCentres,
    path: str = "gas",
) -> IndicatorDiagram:
    """Return the diagram that named points and laws describe.

    Each piece starts where the one before ends. `dead_centres`: crank angles of one revolution where the volume turns
    back, the least and the largest among them [deg]; `path`: where a description states the diagram.
    """
    if not isinstance(dead_centres, DeadCentres):
        dead_centres = DeadCentres(dead_centres)
    solver = _Solver(points, volume_at, dead_centres, cycle, path)
    segments = [replace(solver.segment(index, piece), piece=index + 1) for index, piece in enumerate(pieces)]
    segments += solver.held(segments[-1], pieces[-1].points[-1])
    _check_chain(segments, cycle, solver.named, path)
    _check_closed(segments, solver.named[pieces[-1].points[-1]][1], path)
    return IndicatorDiagram(
        tuple(segment for segment in segments if segment.end > segment.start), solver.named, tuple(solver.jumps)
    )


def counts_from_top(points: Mapping[str, DiagramPoint], pieces: Sequence[Piece], *, by_law: bool = False) -> bool:
    """Return whether a diagram begins where the volume is least: a table, or points without angles or law."""
    first = points.get(pieces[0].points[0]) if pieces else None
    if first is None or first.stroke != 0.0:
        return False
    return bool(first.inputs) or not (by_law or any(point.angle is not None for point in points.values()))


class _Solver:
    """Angles and pressures of the named points as they become known, piece after piece."""

    def __init__(
        self,
        points: Mapping[str, DiagramPoint],
        volume_at: VolumeAt,
        dead_centres: DeadCentres,
        cycle: float,
        path: str,
    ) -> None:
        self.points = points
        # rounding leaves less than nothing of a volume without clearance
        self.volume_at: VolumeAt = lambda degrees: np.maximum(volume_at(degrees), 0.0)
        self.dead_centres, self.period = dead_centres
        self.cycle = cycle
        self.path = path
        self.named: dict[str, tuple[float, float]] = {}
        self.jumps: list[tuple[str, float, float]] = []
        self.ended, self.level = 0.0, 0.0

    def segment(self, number: int, piece: Piece) -> Segment:
        """Solve one piece and remember what it says about its points."""
        key = f"{self.path}.pieces[{number + 1}]"
        for name in (*piece.points, *([piece.reference] if piece.reference else [])):
            if name not in self.points:
                raise DiagramError(f"{key}.points", ErrorMessage("point_absent", name=name))
        match piece.law:
            case "constant":
                return self._constant(key, piece)
            case "polytropic":
                return self._polytropic(key, piece)
            case "rounded" | "straight":
                return self._curve(key, piece)

    def held(self, last: Segment, point: str) -> list[Segment]:
        """Return the rest of the cycle, in which the pressure stays as it is, where the volume does not change then.

        `point`: the last one.
        """
        if not self.cycle - last.end > _SAME_ANGLE:
            return []
        volumes = self.volume_at(np.linspace(last.end, self.cycle, _SAMPLES))
        low, high = self._reach
        if float(np.ptp(volumes)) > _SAME_PLACE * (high - low):
            return []
        ends = np.array([last.end, self.cycle])
        held = replace(last, start=last.end, end=self.cycle, knots=ends, pressures=np.full(2, last.pressures[-1]))
        if last.law in ("constant", "polytropic"):
            return [held]
        stated = self.points[point].inputs[1:]
        return [replace(held, law="constant", slopes=np.zeros(2), places=(), volumes=None, origin=point,
                        operands=stated)]  # fmt: skip

    def start(self, key: str, name: str) -> float:
        """Return the crank angle of the point where a piece begins: where the one before ended, if it may be. [deg]"""
        point, end = self.points[name], self.ended
        if name in self.named or point.angle is not None or not self._is_by_volume(point):
            return self.angle(key, name, end)
        low, high = self._reach
        is_here = abs(float(self.volume_at(np.array([end]))[0]) - self._point_volume(point)) <= _SAME_PLACE * (
            high - low
        )
        if is_here and point.inputs and self.named:
            self._compare(name, end, self.level)
        return end if is_here else self.angle(key, name, end)

    def angle(self, key: str, name: str, after: float) -> float:
        """Return the crank angle of a point, given, already found, or where its volume is reached next. [deg]"""
        if name in self.named:
            return self.named[name][0]
        point = self.points[name]
        if point.angle is not None:
            return point.angle
        if not self._is_by_volume(point):
            raise DiagramError(key, ErrorMessage("point_angle", name=name))
        return self._angle_of_volume(name, after)

    @staticmethod
    def _is_by_volume(point: DiagramPoint) -> bool:
        return point.angle is None and (point.stroke is not None or point.volume is not None)

    @cached_property
    def _reach(self) -> tuple[float, float]:
        """The least and the largest volume. [m3]"""
        volumes = self.volume_at(np.array(self.dead_centres))
        return float(np.min(volumes)), float(np.max(volumes))

    def _point_volume(self, point: DiagramPoint) -> float:
        """Return the volume that places a point. [m3]"""
        low, high = self._reach
        return low + point.stroke * (high - low) if point.stroke is not None else point.volume or 0.0

    def _centres_after(self, start: float) -> Array:
        """Return the dead centres behind a crank angle, those of the next period among them. [deg]"""
        turns = np.arange(0.0, max(self.cycle, start) + 2 * self.period, self.period)
        centres = np.sort(np.concatenate([turns + angle for angle in self.dead_centres]))
        return np.asarray(centres[np.searchsorted(centres, start + 1e-9) :])

    def _angle_of_volume(self, name: str, after: float) -> float:
        """Return where the volume next comes to that of a point. [deg]"""
        target, (low, high) = self._point_volume(self.points[name]), self._reach
        edges = np.array([after, *self._centres_after(after)])
        differences = self.volume_at(edges) - target
        differences[np.abs(differences) <= _SAME_PLACE * (high - low)] = 0.0
        for index in range(len(edges) - 1):
            if differences[index + 1] == 0:
                return float(edges[index + 1])
            if differences[index] * differences[index + 1] < 0:
                return solve_monotone(self.volume_at, target, float(edges[index]), float(edges[index + 1]))
        key = "volume" if self.points[name].stroke is None else "stroke"
        raise DiagramError(
            f"{self.path}.points.{name}.{key}", ErrorMessage("point_volume_far", low=low * 1e6, high=high * 1e6)
        )

    def pressure(self, key: str, name: str) -> float:
        """Return the pressure of a point, given or already found. [Pa]"""
        if name in self.named:
            return self.named[name][1]
        pressure = self.points[name].pressure
        if pressure is None:
            raise DiagramError(key, ErrorMessage("point_pressure", name=name))
        return pressure

    def settle(self, name: str, angle: float, pressure: float) -> None:
        """Remember a point; a given pressure other than the computed one is a jump to report."""
        self._compare(name, angle, pressure)
        given = self.points[name].pressure
        self.level = pressure if given is None else given
        self.named[name] = (angle, self.level)
        self.ended = angle

    def _compare(self, name: str, angle: float, pressure: float) -> None:
        given = self.points[name].pressure
        if given is not None and abs(given - pressure) > _CLOSING * max(abs(given), abs(pressure)):
            self.jumps.append((name, angle, given - pressure))

    def _constant(self, key: str, piece: Piece) -> Segment:
        first, last = piece.points[0], piece.points[-1]
        pressure = self.pressure(key, first)
        start = self.start(key, first)
        end = self.angle(key, last, start)
        self.settle(first, start, pressure)
        self.settle(last, end, pressure)
        knots = np.array([start, end])
        return Segment(start, end, "constant", knots, np.full(2, pressure), np.zeros(2), origin=first)

    def _polytropic(self, key: str, piece: Piece) -> Segment:
        if piece.exponent is None:
            raise DiagramError(f"{key}.exponent", ErrorMessage("exponent_missing"))
        first, last = piece.points[0], piece.points[-1]
        reference = piece.reference or first
        start = self.start(key, first)
        volume = self._volume(key, reference, start if reference == first else self.ended)
        state = (self.pressure(key, reference), volume, piece.exponent)
        if state[0] <= 0:
            raise DiagramError(key, ErrorMessage("polytrope_vacuum", name=reference))
        ending = self.points[last]
        if ending.angle is not None:
            end = ending.angle
        elif ending.stroke is not None or (ending.volume is not None and ending.pressure is None):
            end = self._angle_of_volume(last, start)
        else:
            end = self._angle_of_pressure(key, start, last, state)
        self._check_filled(key, start, end, volume)
        degrees = np.array([start, end])
        ends = np.asarray(polytropic_pressure(*state[:2], self.volume_at(degrees), state[2]))
        self.settle(first, start, float(ends[0]))
        self.settle(last, end, float(ends[1]))
        return Segment(start, end, "polytropic", degrees, ends, np.zeros(2), state, reference)

    def _volume(self, key: str, name: str, after: float) -> float:
        given = self.points[name].volume
        return float(self.volume_at(np.array([self.angle(key, name, after)]))[0]) if given is None else given

    def _check_filled(self, key: str, start: float, end: float, reference: float) -> None:
        """Raise if a polytrope passes where the volume is nothing."""
        if min(self._reach[0], reference) > _EMPTY * self._reach[1]:
            return
        centres = self._centres_after(start)
        degrees = np.array([start, *centres[centres < end], end])
        volumes = self.volume_at(degrees)
        if min(float(np.min(volumes)), reference) <= _EMPTY * self._reach[1]:
            raise DiagramError(key, ErrorMessage("polytrope_empty", angle=float(degrees[np.argmin(volumes)])))

    def _angle_of_pressure(self, key: str, start: float, last: str, state: tuple[float, float, float]) -> float:
        """Return where the polytrope reaches the pressure of its end point, before the next dead centre."""
        target = self.points[last].pressure
        if target is None or target <= 0:
            raise DiagramError(key, ErrorMessage("polytrope_end", name=last))
        low, high = start, float(self._centres_after(start)[0])

        def pressure(degrees: Array) -> Array:
            # beyond all bounds where nothing is left of the volume
            with np.errstate(divide="ignore"):
                return np.asarray(polytropic_pressure(*state[:2], self.volume_at(degrees), state[2]))

        ends = pressure(np.array([low, high])) - target
        if ends[0] * ends[1] > 0:
            raise DiagramError(
                key, ErrorMessage("polytrope_far", name=last, angle=high, centres=tuple(self.dead_centres))
            )
        return solve_monotone(pressure, target, low, high)

    def _curve(self, key: str, piece: Piece) -> Segment:
        if len(piece.points) < 2:
            raise DiagramError(f"{key}.points", ErrorMessage("rounded_points"))
        angles = [self.start(key, piece.points[0])]
        for name in piece.points[1:]:
            angles.append(self.angle(key, name, angles[-1]))
        knots = np.array(angles)
        pressures = np.array([self.pressure(key, name) for name in piece.points])
        slopes = np.zeros_like(knots)
        if knots[0] != knots[-1]:
            if np.any(np.diff(knots) <= 0):
                raise DiagramError(f"{key}.points", ErrorMessage("rounded_rises"))
            slopes = monotone_slopes(knots, pressures)
        centre = float(self._centres_after(knots[0])[0])
        if piece.law == "straight" and centre < knots[-1] - _SAME_ANGLE:
            raise DiagramError(f"{key}.points", ErrorMessage("straight_turns", angle=centre))
        for name, angle, pressure in zip(piece.points, knots, pressures, strict=True):
            self.settle(name, float(angle), float(pressure))
        places = tuple(f"{self.path}.points.{name}.pressure" for name in piece.points)
        volumes = self.volume_at(knots) if piece.law == "straight" else None
        return Segment(float(knots[0]), float(knots[-1]), piece.law, knots, pressures, slopes, places=places,
                       volumes=volumes)  # fmt: skip


def _check_chain(segments: list[Segment], cycle: float, named: Mapping[str, tuple[float, float]], path: str) -> None:
    """Raise unless every segment starts where the one before ends, from 0 to the end of the cycle."""
    end = 0.0
    for number, segment in enumerate(segments, start=1):
        if abs(segment.start - end) > _SAME_ANGLE:
            name = "piece_gap" if segment.start > end else "piece_overlap"
            raise DiagramError(f"{path}.pieces[{number}]", ErrorMessage(name, start=segment.start, end=end))
        if segment.end < segment.start:
            raise DiagramError(
                f"{path}.pieces[{number}]", ErrorMessage("piece_backwards", start=segment.start, end=segment.end)
            )
        end = segment.end
    if abs(end - cycle) > _SAME_ANGLE:
        last = max(named, key=lambda name: named[name][0])
        raise DiagramError(f"{path}.pieces", ErrorMessage("pieces_end", end=end, name=last, cycle=cycle))


def _check_closed(segments: list[Segment], stated: float, path: str) -> None:
    """Raise unless the pressure stated at the last point, or that of the law which ends there, is that of the first."""
    first = float(segments[0].pressures[0])
    last = min(stated, float(segments[-1].pressures[-1]), key=lambda pressure: abs(pressure - first))
    highest = max(float(np.max(np.abs(segment.pressures))) for segment in segments)
    if abs(first - last) > 0.02 * highest:
        raise DiagramError(f"{path}.pieces", ErrorMessage("diagram_open", first=first / 1e6, last=last / 1e6))


def quadrature(breaks: Array) -> tuple[Array, Array]:
    """Return Gauss-Legendre nodes and weights between the breaks (press_2007, sec. 4.6).

    Crank angles [deg] and weights [rad]; the sum of weight times integrand is the integral over angle. `breaks`:
    ascending crank angles between which the integrand is smooth [deg].
    """
    edges = np.concatenate([
        np.linspace(start, end, max(1, int(np.ceil((end - start) / _WIDTH))), endpoint=False)
        for start, end in itertools.pairwise(breaks)
    ] + [breaks[-1:]])  # fmt: skip
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    nodes = middle[:, None] + half[:, None] * _NODES
    weights = np.radians(half)[:, None] * _WEIGHTS
    return nodes.ravel(), weights.ravel()
