"""The theoretical diagram with corners rounded by valves, ignition and combustion.

Two schools: the Russian one puts c'' at a ratio to the end of compression and b'' halfway between b and the
exhaust line; the Vietnamese one puts c'' a third of the way up to the peak and b'' in the middle of ab.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre

from crankwork.formula.known import Known, Procedure, plain
from crankwork.kinematics.crank_grid import Array
from crankwork.loads.indicator import DiagramPoint, IndicatorDiagram, Piece, Segment, VolumeAt, solve_diagram
from crankwork.loads.retold import RememberedVolume
from crankwork.working_cycle.calculated_cycle import DiagramDefinition, Notice
from crankwork.working_cycle.gas_exchange import clip_segment
from crankwork.working_cycle.rounded_pieces import (
    DiagramPart,
    NamedPoint,
    to_points_and_pieces,
    traced_pressure_of_parts,
    without_auxiliary,
)
from crankwork.working_cycle.rounding_corners import (
    RoundedCorners,
    Rounding,
    Timing,
    burning_parts,
    compression_parts,
    corners_of,
    exchange_parts,
)

__all__ = ["RoundedDiagram", "Rounding", "Timing", "filling_factor", "rounded_diagram", "theoretical_work"]

_LEVELS = {"petrol": (0.80, 0.95), "diesel": (0.80, 1.0)}
_LEVEL = {"petrol": 0.85, "diesel": 1.0}
_USUAL_FILLING = (0.90, 0.98)
_USUAL_RISE = (1.15, 1.25)
_USUAL_PEAK = (10.0, 15.0)
_DEVIATION = 0.01
_ABOVE = 1.1


class RoundedDiagram(NamedTuple):
    """A rounded diagram: points and pieces for `solve_diagram`, its solution, values and notices."""

    points: Mapping[str, DiagramPoint]
    pieces: tuple[Piece, ...]
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
    points, pieces, diagram, filling = _at_level(corners, level)
    notices = (*_deviations(corners), *notices, *_unusual(corners, filling), *_above(corners, level))
    return RoundedDiagram(points, pieces, without_auxiliary(diagram), filling, level, notices)


def traced_rounded_pressure(
    theory: Mapping[str, Known], timing: Timing, rounding: Rounding, volume: Known, dead_centres: tuple[float, float]
) -> Known:
    """Return the pressure of the rounded diagram as a traced column; sharp without timing."""
    corners = corners_of(theory, timing, rounding, RememberedVolume(volume), dead_centres)
    exchange = exchange_parts(corners)
    if theory["psi"].value and not timing.exhaust_opens:
        # only the share of the stroke that the ports take is given
        shut = theory["epsilon"] * corners.clearance
        opens, shuts = (
            RememberedVolume(volume).reached(shut, corners.top, end) for end in (corners.bottom, corners.bottom - 360.0)
        )
        corners = corners._replace(start=shuts, opens=opens, start_volume=shut)
        ends = NamedPoint("e", opens, theory["p_a"]), NamedPoint("a", shuts + timing.cycle, theory["p_a"])
        exchange = [DiagramPart("constant", ends)]
    level, _ = _peak_level(corners)
    parts = [*compression_parts(corners), *burning_parts(corners, level), *exchange]
    states = {"~start": (theory["p_a"], corners.start_volume), "~burnt": (theory["p_z"], corners.burnt_volume)}
    return traced_pressure_of_parts(parts, timing.cycle, volume, states)


def motored_diagram(
    theory: Mapping[str, float],
    timing: Timing,
    rounding: Rounding,
    volume_at: VolumeAt,
    dead_centres: tuple[float, float],
) -> tuple[DiagramDefinition, IndicatorDiagram]:
    """Return the points and pieces without combustion, and their diagram; gas exchange as with combustion.

    `theory`: of the rounded diagram, with expansion along the compression line [SI].
    """
    corners = corners_of(theory, replace(timing, ignition_advance=0.0), rounding, volume_at, dead_centres)
    points, pieces, diagram = _drawn(corners._replace(kind="motored"), 1.0)
    return (points, pieces), without_auxiliary(diagram)


def _peak_level(corners: RoundedCorners) -> tuple[float, tuple[Notice, ...]]:
    """Return the peak over p_z: given, usual, or solved for the given filling factor."""
    rounding = corners.rounding
    target = rounding.filling_factor
    if target is None or not corners.timing.ignition_advance:
        return _LEVEL[corners.kind] if rounding.peak_level is None else rounding.peak_level, ()
    low, high = _LEVELS[corners.kind]
    for level in (low, high):
        obtained = _at_level(corners, level)[3]
        if (obtained - target) * (1 if level == low else -1) > rounding.tolerance:
            return level, (("round_unreachable", {"wanted": target, "obtained": obtained, "level": level}),)
    for _ in range(60):
        level = (low + high) / 2
        excess = _at_level(corners, level)[3] - target
        if abs(excess) <= rounding.tolerance:
            break
        low, high = (low, level) if excess > 0 else (level, high)
    return level, ()


def _at_level(
    corners: RoundedCorners, level: float
) -> tuple[dict[str, DiagramPoint], tuple[Piece, ...], IndicatorDiagram, float]:
    """Return the diagram with a peak at a share of p_z, and its filling factor."""
    points, pieces, diagram = _drawn(corners, level)
    return points, pieces, diagram, _filling(corners, diagram)


def _drawn(
    corners: RoundedCorners, level: float
) -> tuple[dict[str, DiagramPoint], tuple[Piece, ...], IndicatorDiagram]:
    """Return the diagram with a peak at a share of p_z."""
    theory = corners.theory
    references = {
        "~start": DiagramPoint(None, theory["p_a"], corners.start_volume),
        "~burnt": DiagramPoint(None, theory["p_z"], corners.burnt_volume),
    }
    parts = [*compression_parts(corners), *burning_parts(corners, level), *exchange_parts(corners)]
    points, pieces = to_points_and_pieces(parts, corners.timing.cycle, references)
    diagram = solve_diagram(points, pieces, corners.timing.cycle, corners.volume_at, dead_centres=corners.dead_centres)
    return points, pieces, diagram


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
    end; the `cycle`. [deg]
    """

    names: tuple[str, ...]
    angles: tuple[float, float, float]
    cycle: float

    def __call__(self, edges: Array, series: Array) -> tuple[float]:
        """Return the factor; `series`: Legendre coefficients of pressure, volume, and of each number of the theory."""
        pressure, volume, *stated = series
        start, _, end = self.angles
        inside = np.mod(np.degrees(edges[1:] + edges[:-1]) / 2 - start, self.cycle) < end - start
        nodes, weights = legendre.leggauss(pressure.shape[-1])
        p = legendre.legval(nodes, pressure[inside].T)
        V_1 = legendre.legval(nodes, legendre.legder(volume[inside].T))

        def volume_at(degrees: Array) -> Array:
            angle = np.mod(np.radians(degrees) - edges[0], edges[-1] - edges[0]) + edges[0]
            panel = np.clip(np.searchsorted(edges, angle) - 1, 0, len(edges) - 2)
            u = (2 * angle - edges[panel] - edges[panel + 1]) / (edges[panel + 1] - edges[panel])
            return np.asarray(legendre.legval(u, volume[panel].T, tensor=False))

        theory = {name: float(coefficients[0, 0]) for name, coefficients in zip(self.names, stated, strict=True)}
        return (float(((p * V_1) @ weights).sum()) / theoretical_work(theory, volume_at, self.angles),)


def traced_filling_factor(
    value: float,
    theory: Mapping[str, Known],
    timing: Timing,
    columns: tuple[Known, Known],
    centres: tuple[float, float],
) -> Known:
    """Return the filling factor as the value of a function of the columns of pressure and volume."""
    corners = corners_of(theory, timing, Rounding(), RememberedVolume(columns[1]), centres)
    end = corners.bottom if timing.cycle > 360 else plain(corners.opens)
    function = FillingOfPolynomials(tuple(theory), (plain(corners.start), corners.top, end), timing.cycle)
    return Known(Procedure(value, "integral", (*columns, *theory.values()), function, 0), "filling_factor.diagram")


def theoretical_work(theory: Mapping[str, float], volume_at: VolumeAt, angles: tuple[float, float, float]) -> float:
    """Return the work of compression, combustion and expansion without any rounding. [J]

    `theory`: `p_a`, `p_z`, `n1`, `n2` and for a diesel `rho` [SI]; `angles`: where compression begins, top dead
    centre, where expansion ends [deg]. Source: kolchin_demidov_2008, ch. 4.
    """
    start, least, end = (float(volume) for volume in volume_at(np.array(angles)))
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
        if rounding.school == "ru":
            values += [("round_rise", rounding.rise, _USUAL_RISE)]
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


def filling_factor(
    theory: Mapping[str, float],
    timing: Timing,
    diagram: IndicatorDiagram,
    volume_at: VolumeAt,
    dead_centres: tuple[float, float],
) -> float:
    """Return the work of a diagram from compression to expansion over that of the theoretical lines. [-]

    `timing`: of two strokes the ports, which bound compression and expansion; of four strokes the cycle alone counts;
    `diagram`: any diagram in absolute pressure over the same cycle. Source: kolchin_demidov_2008, ch. 4.
    """
    bare = replace(timing, ignition_advance=0.0, ignition_delay=0.0)
    return _filling(corners_of(theory, bare, Rounding(), volume_at, dead_centres), diagram)
