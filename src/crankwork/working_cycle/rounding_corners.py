"""Corners of a theoretical diagram, and the parts of the rounded diagram around them.

A corner whose timing is zero stays sharp.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal, NamedTuple

import numpy as np

from crankwork.errors import CrankworkError
from crankwork.formula.expression import Value
from crankwork.formula.known import chosen, plain
from crankwork.kinematics.extremes import solve_monotone
from crankwork.loads.gas import polytropic_pressure
from crankwork.loads.indicator import VolumeAt
from crankwork.loads.retold import RememberedVolume
from crankwork.locale import Refusal
from crankwork.working_cycle.gas_exchange import from_before_zero
from crankwork.working_cycle.rounded_pieces import DiagramPart, NamedPoint

_JOIN_BELOW = 0.9
_RISING = (0.25, 0.5, 0.75)


class RoundedCorners(NamedTuple):
    """Corners independent of the level of the peak: angles [deg], volumes [m3], polytropes.

    Pressures, volumes and the angles that follow from them are numbers or traced values; numbers decide only about
    errors.
    """

    theory: Mapping[str, Value]
    timing: Timing
    rounding: Rounding
    volume_at: VolumeAt | RememberedVolume
    dead_centres: tuple[float, float]
    kind: Literal["petrol", "diesel", "motored"]
    start: Value
    top: float
    bottom: float
    opens: Value
    clearance: Value
    start_volume: Value
    burnt_volume: Value

    def compression(self, *angles: Value) -> list[Value]:
        """Return the pressures on the compression line. [Pa]"""
        return self._on((self.theory["p_a"], self.start_volume), self.theory["n1"], angles)

    def expansion(self, *angles: Value) -> list[Value]:
        """Return the pressures on the expansion line. [Pa]"""
        return self._on((self.theory["p_z"], self.burnt_volume), self.theory["n2"], angles)

    def _on(self, state: tuple[Value, Value], exponent: Value, angles: tuple[Value, ...]) -> list[Value]:
        return [polytropic_pressure(*state, volume, exponent) for volume in self.volumes(*angles)]

    def volumes(self, *angles: Value) -> list[Value]:
        """Return the volumes at crank angles. [m3]"""
        degrees: Any = angles if isinstance(self.volume_at, RememberedVolume) else np.array(angles)
        volumes: list[Value] = self.volume_at(degrees).tolist()
        return volumes

    def slope(self, line: str, angle: Value, step: float = 0.01) -> Value:
        """Return the slope of a polytrope by crank angle. [Pa/deg]"""
        line_at = self.compression if line == "compression" else self.expansion
        after, before = line_at(angle + step, angle - step)
        return (after - before) / (2 * step)

    def angle_of_volume(self, volume: Value) -> Value:
        """Return the angle at which the expansion reaches a volume. [deg]"""
        if isinstance(self.volume_at, RememberedVolume):
            return self.volume_at.reached(volume, self.top, self.bottom)
        return solve_monotone(self.volume_at, volume, self.top, self.bottom)


def corners_of(
    theory: Mapping[str, Value],
    timing: Timing,
    rounding: Rounding,
    volume_at: VolumeAt | RememberedVolume,
    dead_centres: tuple[float, float],
) -> RoundedCorners:
    """Return the corners of a theoretical diagram."""
    _check(theory, timing)
    dead_centres = from_before_zero(dead_centres)
    top, bottom = dead_centres[0] + 360.0, dead_centres[1] + 360.0
    is_two_stroke = timing.cycle == 360.0
    start = dead_centres[1] + (max(timing.intake_closes, timing.exhaust_closes) if is_two_stroke else 0.0)
    volumes = volume_at(np.array([top, start]))
    clearance, start_volume = volumes.tolist()
    rho = theory.get("rho", 1.0)
    return RoundedCorners(
        theory,
        timing,
        rounding,
        volume_at,
        dead_centres,
        "diesel" if plain(rho) > 1 else "petrol",
        start,
        top,
        bottom,
        bottom - timing.exhaust_opens,
        clearance,
        start_volume,
        rho * clearance,
    )


def _check(theory: Mapping[str, Value], timing: Timing) -> None:
    missing = [name for name in ("p_r", "p_a", "p_z", "n1", "n2") if not plain(theory.get(name, 0.0)) > 0]
    if missing:
        raise CrankworkError(Refusal("theory_missing", names=", ".join(missing)))
    if timing.cycle not in (360.0, 720.0):
        raise CrankworkError(Refusal("cycle_angle", angle=timing.cycle))
    if timing.ignition_advance and timing.ignition_delay >= timing.ignition_advance:
        raise CrankworkError(Refusal("ignition_late", advance=timing.ignition_advance, delay=timing.ignition_delay))
    if timing.cycle == 360 and timing.exhaust_opens < timing.intake_opens:
        raise CrankworkError(Refusal("ports_early", intake=timing.intake_opens, exhaust=timing.exhaust_opens))


def compression_parts(corners: RoundedCorners) -> list[DiagramPart]:
    """Return the compression line from a, in parts that end at the named points on it."""
    timing = corners.timing
    events = [("a", corners.start)]
    if timing.cycle > 360 and timing.intake_closes:
        events.append(("a''", corners.start + timing.intake_closes))
    if timing.ignition_advance:
        events.append(("c'", corners.top - timing.ignition_advance))
        if timing.ignition_delay:
            events.append(("f", corners.top - timing.ignition_advance + timing.ignition_delay))
    else:
        events.append(("c", corners.top))
    names, angles = zip(*events, strict=True)
    numbers = [plain(angle) for angle in angles]
    if any(after <= before for before, after in pairwise(numbers)):
        raise CrankworkError(Refusal("events_crossed", names=list(names), angles=numbers))
    points = list(map(NamedPoint, names, angles, corners.compression(*angles)))
    exponent = corners.theory["n1"]
    return [DiagramPart("polytropic", pair, exponent=exponent, reference="~start") for pair in pairwise(points)]


def burning_parts(corners: RoundedCorners, level: float) -> list[DiagramPart]:
    """Return combustion and expansion up to the opening of the exhaust."""
    theory, top = corners.theory, corners.top
    if not corners.timing.ignition_advance:
        opened = _opened(corners, *corners.expansion(corners.opens))
        burnt = corners.angle_of_volume(corners.burnt_volume) if corners.kind == "diesel" else top
        z = NamedPoint("z", burnt, theory["p_z"])
        return [
            DiagramPart("constant", (NamedPoint("y", top, theory["p_z"]), z)),
            DiagramPart("polytropic", (z, opened), exponent=theory["n2"], reference="~burnt"),
        ]
    peak = level * theory["p_z"]
    highest = NamedPoint("z_d" if corners.rounding.school == "ru" else "z'", top + corners.rounding.peak_angle, peak)
    joined, falls_to = highest.angle + corners.rounding.join_after, _falls_to(corners, _JOIN_BELOW * peak)
    joined = chosen(falls_to - joined, falls_to, joined)
    if plain(joined) >= plain(corners.opens) or highest.angle <= top:
        raise CrankworkError(Refusal("peak_late", angle=corners.rounding.peak_angle))
    opened_pressure, joined_pressure = corners.expansion(corners.opens, joined)
    opened, join = _opened(corners, opened_pressure), NamedPoint("~g", joined, joined_pressure)
    rising = _rising(corners, peak)
    slopes = corners.slope("compression", rising[0].angle), corners.slope("expansion", joined)
    return [
        DiagramPart("rounded", (*rising, highest, join), slopes),
        DiagramPart("polytropic", (join, opened), exponent=theory["n2"], reference="~burnt"),
    ]


def _opened(corners: RoundedCorners, pressure: Value) -> NamedPoint:
    return NamedPoint("b'" if corners.timing.exhaust_opens else "b", corners.opens, pressure)


def _rising(corners: RoundedCorners, peak: Value) -> list[NamedPoint]:
    """Return the points from the end of the compression line to c''."""
    start = compression_parts(corners)[-1].points[-1]
    angles = [start.angle + share * (corners.top - start.angle) for share in _RISING]
    compressed, *lines = corners.compression(corners.top, *angles)
    if corners.rounding.school == "ru":
        # a small rise of pressure has no room for the usual one
        usual, half = corners.rounding.rise * compressed, (compressed + peak) / 2
        middle = chosen(half - usual, usual, half)
    else:
        middle = compressed + (peak - compressed) / 3
    low, centre, high = (plain(pressure) for pressure in (compressed, middle, peak))
    if not low < centre < high:
        raise CrankworkError(Refusal("middle_outside", middle=centre / 1e6, compressed=low / 1e6, peak=high / 1e6))
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
    theory, timing = corners.theory, corners.timing
    low, charge = theory["p_r"], theory["p_a"]
    pressure, expanded = corners.expansion(corners.opens, corners.bottom)
    opened = _opened(corners, pressure)
    closed = NamedPoint("a", corners.start + timing.cycle, charge)
    if timing.cycle == 360:
        out = NamedPoint("~s", corners.bottom - timing.intake_opens, low)
        turned = NamedPoint("~t", max(corners.bottom, out.angle), low)
        blown = _blow_down(corners, (opened, out))
        return [*blown, DiagramPart("constant", (out, turned)), DiagramPart("rounded", (turned, closed))]
    out = NamedPoint("~s", corners.bottom + timing.exhaust_opens, low)
    turn = corners.dead_centres[0] + 720.0
    left = NamedPoint("r'" if timing.intake_opens else "r", turn - timing.intake_opens, low)
    entered = NamedPoint("a'" if timing.exhaust_closes else "~a", turn + timing.exhaust_closes, charge)
    if left.angle < out.angle:
        raise CrankworkError(Refusal("exhaust_nothing", exhaust=timing.exhaust_opens, intake=timing.intake_opens))
    blown = []
    if timing.exhaust_opens:
        other = low if corners.rounding.school == "ru" else charge
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
    pressures = [plain(point.pressure) for point in points]
    if points[-1].angle <= points[0].angle:
        return []
    if corners.kind != "motored" and any(after >= before for before, after in pairwise(pressures)):
        raise CrankworkError(Refusal("blow_down_rising", pressures=[pressure / 1e6 for pressure in pressures]))
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

    school: Literal["ru", "vi"] = "ru"  # `ru` or `vi`
    # Greatest pressure: after top dead centre, and over p_z (0.85 petrol, 1 diesel if left out) [deg], [-]
    peak_angle: float = 12.0
    peak_level: float | None = None
    join_after: float = 8.0  # From there to the expansion line, at least [deg]
    rise: float = 1.2  # Pressure at c'' over that at c, of the Russian school [-]
    filling_factor: float | None = None  # Target for which the peak level is solved [-]
    tolerance: float = 1e-4  # Largest deviation from the target [-]
