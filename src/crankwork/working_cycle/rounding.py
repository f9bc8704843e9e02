"""The theoretical diagram with corners rounded by valves, ignition and combustion.

The conventions of schools are records of `schools.toml`. A corner whose timing is zero stays sharp.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.polynomial import legendre

from crankwork.errors import CrankworkError
from crankwork.formula.expression import Value
from crankwork.formula.traced_value import FunctionValue, TracedValue, given, select, to_number
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.dead_centres import solve_monotone
from crankwork.loads.gas import polytropic_pressure
from crankwork.loads.indicator import IndicatorDiagram, Segment, VolumeAt
from crankwork.loads.traced_diagram import TracedVolume
from crankwork.locale import ErrorMessage
from crankwork.working_cycle.calculated_cycle import Notice
from crankwork.working_cycle.diagram_parts import (
    DiagramPart,
    NamedPoint,
    clip_segment,
    diagram_of_parts,
    from_before_zero,
    traced_pressure_of_parts,
)
from crankwork.working_cycle.schools import PEAK_LEVEL, SCHOOLS

__all__ = ["RoundedDiagram", "Rounding", "Timing", "rounded_diagram", "theoretical_work"]
_LEVELS = {"petrol": (0.80, 0.95), "diesel": (0.80, 1.0)}
_USUAL_FILLING = (0.90, 0.98)
_USUAL_RISE = (1.15, 1.25)
_USUAL_PEAK = (10.0, 15.0)
_DEVIATION = 0.01
_ABOVE = 1.1
_JOIN_BELOW = 0.9
_RISING = (0.25, 0.5, 0.75)


class RoundedDiagram(NamedTuple):
    """A rounded diagram, values and notices."""

    diagram: IndicatorDiagram
    filling_factor: float
    peak_level: float
    notices: tuple[Notice, ...]


def rounded_diagram(
    theory: Mapping[str, float],
    timing: Timing,
    rounding: Rounding,
    volume_at: VolumeAt,
    dead_centres: tuple[float, float],
) -> RoundedDiagram:
    """Return the diagram with rounded corners.

    `theory`: `p_r`, `p_a`, `p_z`, `n1`, `n2` and for a diesel `rho` of the theoretical cycle; `p_c`, `p_b` and
    `epsilon` are only compared [SI]. Source: kolchin_demidov_2008, ch. 5; nguyen_tat_tien_2000.
    """
    corners = corners_of(theory, timing, rounding, volume_at, dead_centres)
    level, notices = _peak_level(corners)
    diagram, filling = _at_level(corners, level)
    notices = (*_deviations(corners), *notices, *_unusual(corners, filling), *_above(corners, level))
    return RoundedDiagram(diagram, filling, level, notices)


def traced_rounded_pressure(
    theory: Mapping[str, TracedValue],
    timing: Timing,
    rounding: Rounding,
    volume: TracedValue,
    dead_centres: tuple[Value, Value],
) -> TracedValue:
    """Return the pressure of the rounded diagram as a traced column; sharp without timing."""
    corners = corners_of(theory, timing, rounding, TracedVolume(volume), dead_centres)
    exchange = exchange_parts(corners)
    if theory["psi"].value and not timing.exhaust_opens:
        # only the share of the stroke that the ports take is given
        shut = theory["epsilon"] * corners.clearance
        opens, shuts = (
            TracedVolume(volume).reached(shut, to_number(corners.top), to_number(end))
            for end in (corners.bottom, corners.bottom - 360.0)
        )
        corners = corners._replace(start=shuts, opens=opens, start_volume=shut)
        ends = NamedPoint("e", opens, theory["p_a"]), NamedPoint("a", shuts + timing.cycle, theory["p_a"])
        exchange = [DiagramPart("constant", ends)]
    level, _ = _peak_level(corners)
    parts = [*compression_parts(corners), *burning_parts(corners, level), *exchange]
    return traced_pressure_of_parts(parts, timing.cycle, volume, corners.states)


def motored_diagram(
    theory: Mapping[str, float],
    timing: Timing,
    rounding: Rounding,
    volume_at: VolumeAt,
    dead_centres: tuple[float, float],
) -> IndicatorDiagram:
    """Return the diagram without combustion; gas exchange as with combustion.

    `theory`: of the rounded diagram, with expansion along the compression line [SI].
    """
    corners = corners_of(theory, replace(timing, ignition_advance=0.0), rounding, volume_at, dead_centres)
    # its lines enclose no work, of which a filling factor would be a share
    return _drawn(corners._replace(kind="motored"), 1.0)


def _peak_level(corners: RoundedCorners) -> tuple[float, tuple[Notice, ...]]:
    """Return the peak over p_z: given, usual, or solved for the given filling factor."""
    rounding = corners.rounding
    target = rounding.filling_factor
    if target is None or not corners.timing.ignition_advance:
        return PEAK_LEVEL[corners.kind] if rounding.peak_level is None else rounding.peak_level, ()
    low, high = _LEVELS[corners.kind]
    for level in (low, high):
        obtained = _at_level(corners, level)[1]
        if (obtained - target) * (1 if level == low else -1) > rounding.tolerance:
            return level, (("round_unreachable", {"wanted": target, "obtained": obtained, "level": level}),)
    for _ in range(60):
        level = (low + high) / 2
        excess = _at_level(corners, level)[1] - target
        if abs(excess) <= rounding.tolerance:
            break
        low, high = (low, level) if excess > 0 else (level, high)
    return level, ()


def _at_level(corners: RoundedCorners, level: float) -> tuple[IndicatorDiagram, float]:
    """Return the diagram with a peak at a share of p_z, and its filling factor."""
    diagram = _drawn(corners, level)
    return diagram, _filling(corners, diagram)


def _drawn(corners: RoundedCorners, level: float) -> IndicatorDiagram:
    parts = [*compression_parts(corners), *burning_parts(corners, level), *exchange_parts(corners)]
    return diagram_of_parts(parts, corners.timing.cycle, corners.volume_at, corners.states)


def _filling(corners: RoundedCorners, diagram: IndicatorDiagram) -> float:
    """Return the work of compression to expansion over that of the theoretical lines."""
    cycle, parts = corners.timing.cycle, list[Segment]()
    end = corners.bottom if cycle > 360 else corners.opens
    for turn in (0.0, cycle):
        for segment in diagram.segments:
            first, last = max(segment.start, corners.start - turn), min(segment.end, end - turn)
            if last > first:
                parts.append(clip_segment(segment, first, last))
    work = IndicatorDiagram(tuple(parts), {}).work(corners.volume_at)
    return work / theoretical_work(corners.theory, corners.volume_at, (corners.start, corners.top, end))


@dataclass(frozen=True)
class FillingOfPolynomials:
    """Filling factor of a diagram that is given by polynomials over one cycle.

    `names` of the pressures and exponents of the theory; `angles` of compression start, top dead centre and expansion
    end, None for those that follow the numbers of the theory; the `cycle`. [deg]
    """

    names: tuple[str, ...]
    angles: tuple[float | None, ...]
    cycle: float

    def __call__(self, edges: Array, series: Array) -> tuple[float]:
        """Return the factor; `series`: Legendre coefficients of pressure, volume, and of each number of the theory."""
        pressure, volume, *stated = series
        following = iter(stated[len(self.names) :])
        angles = [float(next(following)[0, 0]) if angle is None else angle for angle in self.angles]
        start, top, end = angles
        inside = np.mod(np.degrees(edges[1:] + edges[:-1]) / 2 - start, self.cycle) < end - start
        nodes, weights = legendre.leggauss(pressure.shape[-1])
        p = legendre.legval(nodes, pressure[inside].T)
        V_1 = legendre.legval(nodes, legendre.legder(volume[inside].T))

        def volume_at(degrees: Array) -> Array:
            angle = np.mod(np.radians(degrees) - edges[0], edges[-1] - edges[0]) + edges[0]
            panel = np.clip(np.searchsorted(edges, angle) - 1, 0, len(edges) - 2)
            u = (2 * angle - edges[panel] - edges[panel + 1]) / (edges[panel + 1] - edges[panel])
            return np.asarray(legendre.legval(u, volume[panel].T, tensor=False))

        theory = {name: float(coefficients[0, 0]) for name, coefficients in zip(self.names, stated, strict=False)}
        return (float(((p * V_1) @ weights).sum()) / theoretical_work(theory, volume_at, (start, top, end)),)


def traced_filling_factor(
    value: float,
    theory: Mapping[str, TracedValue],
    timing: Timing,
    columns: tuple[TracedValue, TracedValue],
    centres: tuple[Value, Value],
) -> TracedValue:
    """Return the filling factor as the value of a function of the columns of pressure and volume."""
    corners = corners_of(theory, timing, Rounding(), TracedVolume(columns[1]), centres)
    end = corners.bottom if timing.cycle > 360 else corners.opens
    places = corners.start, corners.top, end
    following = [place for place in places if isinstance(place, TracedValue)]
    plain = tuple(None if isinstance(place, TracedValue) else float(place) for place in places)
    function = FillingOfPolynomials(tuple(theory), plain, timing.cycle)
    operands = (*columns, *theory.values(), *following)
    return TracedValue(FunctionValue(value, "integral", operands, function, 0), "filling_factor.diagram")


def theoretical_work(theory: Mapping[str, float], volume_at: VolumeAt, angles: tuple[float, float, float]) -> float:
    """Return the work of compression, combustion and expansion without any rounding. [J]

    `theory`: `p_a`, `p_z`, `n1`, `n2` and for a diesel `rho` [SI]; `angles`: where compression begins, top dead
    centre, where expansion ends [deg]. Source: kolchin_demidov_2008, ch. 4.
    """
    start, least, end = (float(volume) for volume in volume_at(np.array(angles)))
    start = theory.get("V_a") or start
    burnt = theory.get("rho", 1.0) * least
    lines = ((theory["p_a"], start, least, theory["n1"]), (theory["p_z"], burnt, end, theory["n2"]))
    work = theory["p_z"] * (burnt - least)
    for pressure, volume, last, exponent in lines:
        growth, less = np.log(last / volume), 1 - exponent
        work += float(pressure * volume * (np.expm1(less * growth) / less if less else growth))
    return work


def _deviations(corners: RoundedCorners) -> list[Notice]:
    """Return notices of given pressures that differ from those of the lines they lie on."""
    notices: list[Notice] = []
    computed = {
        "p_c": corners.compression(corners.top)[0] / 1e6,
        "p_b": corners.expansion(corners.opens if corners.timing.cycle == 360 else corners.bottom)[0] / 1e6,
        "epsilon": corners.start_volume / corners.clearance,
    }
    for name, value in computed.items():
        given = corners.theory.get(name)
        if given is None:
            continue
        given = given if name == "epsilon" else given / 1e6
        if abs(given - value) > _DEVIATION * value:
            notices.append(("round_differs", {"name": name, "given": given, "computed": value}))
    return notices


def _unusual(corners: RoundedCorners, filling: float) -> list[Notice]:
    rounding, values = corners.rounding, []
    if corners.timing.ignition_advance:
        values += [("round_peak", rounding.peak_angle, _USUAL_PEAK)]
        if rounding.ratio_of_rise is not None:
            values += [("round_rise", rounding.ratio_of_rise, _USUAL_RISE)]
        values += [("round_filling", filling, _USUAL_FILLING)]
    return [
        (code, {"value": value, "low": low, "high": high})
        for code, value, (low, high) in values
        if not low <= value <= high
    ]


def _above(corners: RoundedCorners, level: float) -> list[Notice]:
    """Return a notice if the peak is above the expansion line that it is rounded from."""
    if not corners.timing.ignition_advance:
        return []
    line = min(corners.theory["p_z"], *corners.expansion(corners.top + corners.rounding.peak_angle))
    ratio = level * corners.theory["p_z"] / line
    return [("round_above", {"ratio": ratio})] if ratio > _ABOVE else []


class RoundedCorners(NamedTuple):
    """Corners independent of the level of the peak: angles [deg], volumes [m3], polytropes.

    Pressures, volumes and the angles that follow from them are numbers or traced values; numbers decide only about
    errors.
    """

    theory: Mapping[str, Value]
    timing: Timing
    angles: Timing  # The same, traced where the diagram is
    rounding: Rounding
    volume_at: VolumeAt | TracedVolume
    dead_centres: tuple[Value, Value]
    kind: Literal["petrol", "diesel", "motored"]
    start: Value
    top: Value
    bottom: Value
    opens: Value
    clearance: Value
    start_volume: Value
    burnt_volume: Value

    @property
    def states(self) -> dict[str, tuple[Value, Value]]:
        """Pressure and volume where compression and expansion begin, by the names of the points. [Pa], [m3]"""
        return {"a": (self.theory["p_a"], self.start_volume), "z": (self.theory["p_z"], self.burnt_volume)}

    def compression(self, *angles: Value) -> list[Value]:
        """Return the pressures on the compression line. [Pa]"""
        return self._on("a", self.theory["n1"], angles)

    def expansion(self, *angles: Value) -> list[Value]:
        """Return the pressures on the expansion line. [Pa]"""
        return self._on("z", self.theory["n2"], angles)

    def _on(self, state: str, exponent: Value, angles: tuple[Value, ...]) -> list[Value]:
        return [polytropic_pressure(*self.states[state], volume, exponent) for volume in self.volumes(*angles)]

    def volumes(self, *angles: Value) -> list[Value]:
        """Return the volumes at crank angles. [m3]"""
        degrees: Any = angles if isinstance(self.volume_at, TracedVolume) else np.array(angles)
        volumes: list[Value] = self.volume_at(degrees).tolist()
        return volumes

    def slope(self, line: str, angle: Value, step: float = 0.01) -> Value:
        """Return the slope of a polytrope by crank angle. [Pa/deg]"""
        line_at = self.compression if line == "compression" else self.expansion
        after, before = line_at(angle + step, angle - step)
        return (after - before) / (2 * step)

    def angle_of_volume(self, volume: Value) -> Value:
        """Return the angle at which the expansion reaches a volume. [deg]"""
        if isinstance(self.volume_at, TracedVolume):
            return self.volume_at.reached(volume, to_number(self.top), to_number(self.bottom))
        return solve_monotone(self.volume_at, volume, self.top, self.bottom)


def corners_of(
    theory: Mapping[str, Value],
    timing: Timing,
    rounding: Rounding,
    volume_at: VolumeAt | TracedVolume,
    dead_centres: tuple[Value, Value],
) -> RoundedCorners:
    """Return the corners of a theoretical diagram."""
    _check(theory, timing)
    is_traced = isinstance(volume_at, TracedVolume)
    dead_centres = from_before_zero(dead_centres)
    top, bottom = dead_centres[0] + 360.0, dead_centres[1] + 360.0
    is_two_stroke = timing.cycle == 360.0
    angles = _traced(timing) if is_traced else timing
    closes = max(angles.intake_closes, angles.exhaust_closes, key=to_number)
    start = closes + dead_centres[1] if is_two_stroke else dead_centres[1]
    places: Any = (top, start)
    volumes = volume_at(places if is_traced else np.array(places))
    clearance, start_volume = volumes.tolist()
    if to_number(theory.get("V_a", 0.0)):
        start_volume = theory["V_a"]
    rho = theory.get("rho", 1.0)
    return RoundedCorners(
        theory,
        timing,
        angles,
        rounding,
        volume_at,
        dead_centres,
        "diesel" if to_number(rho) > 1 else "petrol",
        start,
        top,
        bottom,
        bottom - angles.exhaust_opens,
        clearance,
        start_volume,
        rho * clearance,
    )


def _traced(timing: Timing) -> Timing:
    """Return a timing whose angles are traced, as far as they are stated."""
    stated = {name: value for name, value in vars(timing).items() if value and name != "cycle"}
    paths = {name: f"cycle.timing.{name.removesuffix('_advance')}" for name in stated}
    angles: dict[str, Any] = {name: given("", value, paths[name], "deg") for name, value in stated.items()}
    return replace(timing, **angles)


def _check(theory: Mapping[str, Value], timing: Timing) -> None:
    missing = [name for name in ("p_r", "p_a", "p_z", "n1", "n2") if not to_number(theory.get(name, 0.0)) > 0]
    if missing:
        raise CrankworkError(ErrorMessage("theory_missing", names=", ".join(missing)))
    if timing.ignition_advance and timing.ignition_delay >= timing.ignition_advance:
        raise CrankworkError(
            ErrorMessage("ignition_late", advance=timing.ignition_advance, delay=timing.ignition_delay)
        )
    if timing.cycle == 360 and timing.exhaust_opens < timing.intake_opens:
        raise CrankworkError(ErrorMessage("ports_early", intake=timing.intake_opens, exhaust=timing.exhaust_opens))


def compression_parts(corners: RoundedCorners) -> list[DiagramPart]:
    """Return the compression line from a, in parts that end at the named points on it."""
    timing, angles = corners.timing, corners.angles
    events = [("a", corners.start)]
    if timing.cycle > 360 and timing.intake_closes:
        events.append(("a''", corners.start + angles.intake_closes))
    if timing.ignition_advance:
        events.append(("c'", corners.top - angles.ignition_advance))
        if timing.ignition_delay:
            events.append(("f", corners.top - angles.ignition_advance + angles.ignition_delay))
    else:
        events.append(("c", corners.top))
    names, places = zip(*events, strict=True)
    numbers = [to_number(angle) for angle in places]
    if any(after <= before for before, after in pairwise(numbers)):
        raise CrankworkError(ErrorMessage("events_crossed", names=list(names), angles=numbers))
    points = list(map(NamedPoint, names, places, corners.compression(*places)))
    exponent = corners.theory["n1"]
    return [DiagramPart("polytropic", pair, exponent=exponent, reference="a") for pair in pairwise(points)]


def burning_parts(corners: RoundedCorners, level: float) -> list[DiagramPart]:
    """Return combustion and expansion up to the opening of the exhaust."""
    theory, top = corners.theory, corners.top
    if not corners.timing.ignition_advance:
        opened = _opened(corners, *corners.expansion(corners.opens))
        burnt = corners.angle_of_volume(corners.burnt_volume) if corners.kind == "diesel" else top
        z = NamedPoint("z", burnt, theory["p_z"])
        return [
            DiagramPart("constant", (NamedPoint("y", top, theory["p_z"]), z)),
            DiagramPart("polytropic", (z, opened), exponent=theory["n2"], reference="z"),
        ]
    peak = level * theory["p_z"]
    highest = NamedPoint(SCHOOLS[corners.rounding.school]["highest"], top + corners.rounding.peak_angle, peak)
    joined, falls_to = highest.angle + corners.rounding.join_after, _falls_to(corners, _JOIN_BELOW * peak)
    joined = select(falls_to - joined, falls_to, joined)
    if to_number(joined) >= to_number(corners.opens) or to_number(highest.angle) <= to_number(top):
        raise CrankworkError(ErrorMessage("peak_late", angle=corners.rounding.peak_angle))
    opened_pressure, joined_pressure = corners.expansion(corners.opens, joined)
    opened, join = _opened(corners, opened_pressure), NamedPoint("~g", joined, joined_pressure)
    rising = _rising(corners, peak)
    slopes = corners.slope("compression", rising[0].angle), corners.slope("expansion", joined)
    return [
        DiagramPart("rounded", (*rising, highest, join), slopes),
        DiagramPart("polytropic", (join, opened), exponent=theory["n2"], reference="z"),
    ]


def _opened(corners: RoundedCorners, pressure: Value) -> NamedPoint:
    return NamedPoint("b'" if corners.timing.exhaust_opens else "b", corners.opens, pressure)


def _rising(corners: RoundedCorners, peak: Value) -> list[NamedPoint]:
    """Return the points from the end of the compression line to c''."""
    start = compression_parts(corners)[-1].points[-1]
    angles = [start.angle + share * (corners.top - start.angle) for share in _RISING]
    compressed, *lines = corners.compression(corners.top, *angles)
    ratio = corners.rounding.ratio_of_rise
    if ratio is not None:
        # a small rise of pressure has no room for the usual one
        usual, half = ratio * compressed, (compressed + peak) / 2
        middle = select(half - usual, usual, half)
    else:
        middle = compressed + corners.rounding.share_of_rise * (peak - compressed)
    low, centre, high = (to_number(pressure) for pressure in (compressed, middle, peak))
    if not low < centre < high:
        raise CrankworkError(ErrorMessage("middle_outside", middle=centre / 1e6, compressed=low / 1e6, peak=high / 1e6))
    # combustion adds to the compression line the square of the angle since its start
    between = [
        NamedPoint(f"~f{number}", angle, line + (middle - compressed) * share**2)
        for number, (share, angle, line) in enumerate(zip(_RISING, angles, lines, strict=True))
    ]
    return [start, *between, NamedPoint("c''", corners.top, middle)]


def _falls_to(corners: RoundedCorners, pressure: Value) -> Value:
    """Return the angle at which the expansion line falls to a pressure. [deg]"""
    theory = corners.theory
    # the polytropic law with pressure and volume exchanged
    return corners.angle_of_volume(polytropic_pressure(corners.burnt_volume, theory["p_z"], pressure, 1 / theory["n2"]))


def exchange_parts(corners: RoundedCorners) -> list[DiagramPart]:
    """Return exhaust and intake from the opening of the exhaust to a of the next cycle."""
    theory, timing, angles = corners.theory, corners.timing, corners.angles
    low, charge = theory["p_r"], theory["p_a"]
    pressure, expanded = corners.expansion(corners.opens, corners.bottom)
    opened = _opened(corners, pressure)
    closed = NamedPoint("a", corners.start + timing.cycle, charge)
    if timing.cycle == 360:
        out = NamedPoint("~s", corners.bottom - angles.intake_opens, low)
        turned = NamedPoint("~t", max(corners.bottom, out.angle, key=to_number), low)
        blown = _blow_down(corners, (opened, out))
        return [*blown, DiagramPart("constant", (out, turned)), DiagramPart("rounded", (turned, closed))]
    out = NamedPoint("~s", corners.bottom + angles.exhaust_opens, low)
    turn = corners.dead_centres[0] + 720.0
    left = NamedPoint("r'" if timing.intake_opens else "r", turn - angles.intake_opens, low)
    entered = NamedPoint("a'" if timing.exhaust_closes else "~a", turn + angles.exhaust_closes, charge)
    if to_number(left.angle) < to_number(out.angle):
        raise CrankworkError(ErrorMessage("exhaust_nothing", exhaust=timing.exhaust_opens, intake=timing.intake_opens))
    blown = []
    if timing.exhaust_opens:
        other = low if corners.rounding.other_line == "exhaust" else charge
        middle = NamedPoint("b''", corners.bottom, (expanded + other) / 2)
        blown = _blow_down(corners, (opened, middle, out))
    return [
        *blown,
        DiagramPart("constant", (out, left)),
        DiagramPart("rounded", (left, entered)),
        DiagramPart("constant", (entered, closed)),
    ]


def _blow_down(corners: RoundedCorners, points: tuple[NamedPoint, ...]) -> list[DiagramPart]:
    if corners.kind == "motored":
        # without combustion the pressure may rise to that of the exhaust
        points = (points[0], points[-1])
    pressures = [to_number(point.pressure) for point in points]
    if to_number(points[-1].angle) <= to_number(points[0].angle):
        return []
    if corners.kind != "motored" and any(after >= before for before, after in pairwise(pressures)):
        raise CrankworkError(ErrorMessage("blow_down_rising", pressures=[pressure / 1e6 for pressure in pressures]))
    return [DiagramPart("rounded", points, (corners.slope("expansion", points[0].angle), 0.0))]


@dataclass(frozen=True)
class Timing:
    """Angles of valves and ignition from the true dead centres."""

    # Spark or injection before top dead centre; from then until the pressure leaves the compression line [deg]
    ignition_advance: float = 0.0
    ignition_delay: float = 0.0
    # Before top and after bottom dead centre; with two strokes the scavenging ports, before and after bottom [deg]
    intake_opens: float = 0.0
    intake_closes: float = 0.0
    # Before bottom and after top dead centre; with two strokes the exhaust ports, before and after bottom [deg]
    exhaust_opens: float = 0.0
    exhaust_closes: float = 0.0
    cycle: float = 720.0  # 720, or 360 for two strokes [deg]


@dataclass(frozen=True)
class Rounding:
    """How corners are rounded."""

    school: str = "ru"  # Whose conventions hold where nothing else is given
    # Greatest pressure: after top dead centre, and over p_z (0.85 petrol, 1 diesel if left out) [deg], [-]
    peak_angle: float = 12.0
    peak_level: float | None = None
    join_after: float = 8.0  # From there to the expansion line, at least [deg]
    # Pressure at c'' over that at c, or share of the way from c to the peak at which it lies [-]
    rise: float | None = None
    rise_share: float | None = None
    blow_down: str | None = None  # The line halfway to which b'' lies, `exhaust` or `intake`
    filling_factor: float | None = None  # Target for which the peak level is solved [-]
    tolerance: float = 1e-4  # Largest deviation from the target [-]

    @property
    def ratio_of_rise(self) -> float | None:
        """Pressure at c'' over that at c, None if a share places it. [-]"""
        return SCHOOLS[self.school].get("rise") if self.rise is None is self.rise_share else self.rise

    @property
    def share_of_rise(self) -> float:
        """Share of the way from c to the peak at which c'' lies. [-]"""
        return float(SCHOOLS[self.school]["rise_share"] if self.rise_share is None else self.rise_share)

    @property
    def other_line(self) -> str:
        """The line halfway to which b'' lies from b."""
        return str(self.blow_down or SCHOOLS[self.school]["blow_down"])
