"""RoundedCorners of the theoretical diagram rounded as valves, ignition and burning round them.

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
from crankwork.working_cycle.calculated_cycle import Drawn, Notice
from crankwork.working_cycle.gas_exchange import clipped
from crankwork.working_cycle.rounded_pieces import Named, Part, remembered, without_auxiliary, written
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
    """A rounded diagram: points and pieces for `solve_diagram`, what was obtained, and what to know about it."""

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

    Points, pieces, the solved diagram, the filling factor obtained. `theory`: `p_r`, `p_a`, `p_z`, `n1`, `n2` and for
    a diesel `rho` of the theoretical cycle; `p_c`, `p_b` and `epsilon` are only compared [SI]. Source:
    kolchin_demidov_2008, ch. 5; nguyen_tat_tien_2000.
    """
    corners = corners_of(theory, timing, rounding, volume_at, dead_centres)
    level, notices = _peak_level(corners)
    points, pieces, diagram, filling = _at_level(corners, level)
    notices = (*_deviations(corners), *notices, *_unusual(corners, filling), *_above(corners, level))
    return RoundedDiagram(points, pieces, without_auxiliary(diagram), filling, level, notices)


def remembered_pressure(
    theory: Mapping[str, Known], timing: Timing, rounding: Rounding, volume: Known, dead_centres: tuple[float, float]
) -> Known:
    """Return the pressure of the rounded diagram as a column that is made of knowns alone; sharp without timing."""
    corners = corners_of(theory, timing, rounding, RememberedVolume(volume), dead_centres)
    exchange = exchange_parts(corners)
    if theory["psi"].value and not timing.exhaust_opens:
        # ports of which only the share of the stroke is known
        shut = theory["epsilon"] * corners.clearance
        opens, shuts = (
            RememberedVolume(volume).reached(shut, corners.top, one) for one in (corners.bottom, corners.bottom - 360.0)
        )
        corners = corners._replace(start=shuts, opens=opens, start_volume=shut)
        ends = Named("e", opens, theory["p_a"]), Named("a", shuts + timing.cycle, theory["p_a"])
        exchange = [Part("constant", ends)]
    level, _ = _peak_level(corners)
    parts = [*compression_parts(corners), *burning_parts(corners, level), *exchange]
    states = {"~start": (theory["p_a"], corners.start_volume), "~burnt": (theory["p_z"], corners.burnt_volume)}
    return remembered(parts, timing.cycle, volume, states)


def motored_diagram(
    theory: Mapping[str, float],
    timing: Timing,
    rounding: Rounding,
    volume_at: VolumeAt,
    dead_centres: tuple[float, float],
) -> tuple[Drawn, IndicatorDiagram]:
    """Return what is drawn, and the diagram, where nothing burns, the exchange of gas as where it does.

    `theory`: that of the rounded diagram, its expansion along the line of compression [SI].
    """
    corners = corners_of(theory, replace(timing, ignition_advance=0.0), rounding, volume_at, dead_centres)
    points, pieces, diagram = _drawn(corners._replace(kind="motored"), 1.0)
    return (points, pieces), without_auxiliary(diagram)


def _peak_level(corners: RoundedCorners) -> tuple[float, tuple[Notice, ...]]:
    """Return the peak over p_z: given, usual, or solved for so that the filling factor is the wanted one."""
    rounding = corners.rounding
    wanted = rounding.filling_factor
    if wanted is None or not corners.timing.ignition_advance:
        return _LEVEL[corners.kind] if rounding.peak_level is None else rounding.peak_level, ()
    low, high = _LEVELS[corners.kind]
    for level in (low, high):
        reached = _at_level(corners, level)[3]
        if (reached - wanted) * (1 if level == low else -1) > rounding.tolerance:
            return level, (("round_unreachable", {"wanted": wanted, "obtained": reached, "level": level}),)
    for _ in range(60):
        level = (low + high) / 2
        excess = _at_level(corners, level)[3] - wanted
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
    points, pieces = written(parts, corners.timing.cycle, references)
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
                parts.append(clipped(segment, first, last))
    work = IndicatorDiagram(tuple(parts), {}).work(corners.volume_at)
    return work / theoretical_work(corners.theory, corners.volume_at, (corners.start, corners.top, end))


@dataclass(frozen=True)
class FillingOfPolynomials:
    """The filling factor of a diagram, of polynomials over one cycle.

    `names` of the pressures and exponents of the theory; `angles` where compression starts, of the top dead centre, and
    where expansion ends; the `cycle`. [deg]
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
            at = np.mod(np.radians(degrees) - edges[0], edges[-1] - edges[0]) + edges[0]
            panel = np.clip(np.searchsorted(edges, at) - 1, 0, len(edges) - 2)
            u = (2 * at - edges[panel] - edges[panel + 1]) / (edges[panel + 1] - edges[panel])
            return np.asarray(legendre.legval(u, volume[panel].T, tensor=False))

        theory = {name: float(one[0, 0]) for name, one in zip(self.names, stated, strict=True)}
        return (float(((p * V_1) @ weights).sum()) / theoretical_work(theory, volume_at, self.angles),)


def remembered_filling(
    value: float,
    theory: Mapping[str, Known],
    timing: Timing,
    columns: tuple[Known, Known],
    centres: tuple[float, float],
) -> Known:
    """Return the filling factor as what a procedure finds of the pressure and the volume."""
    corners = corners_of(theory, timing, Rounding(), RememberedVolume(columns[1]), centres)
    end = corners.bottom if timing.cycle > 360 else plain(corners.opens)
    by = FillingOfPolynomials(tuple(theory), (plain(corners.start), corners.top, end), timing.cycle)
    return Known(Procedure(value, "integral", (*columns, *theory.values()), by, 0), "filling_factor.diagram")


def theoretical_work(theory: Mapping[str, float], volume_at: VolumeAt, angles: tuple[float, float, float]) -> float:
    """Return the work of compression, combustion and expansion without any rounding. [J]

    `theory`: `p_a`, `p_z`, `n1`, `n2` and for a diesel `rho` [SI]; `angles`: where compression begins, top dead
    centre, where expansion ends [deg]. Source: kolchin_demidov_2008, ch. 4.
    """
    start, least, end = (float(one) for one in volume_at(np.array(angles)))
    burnt = theory.get("rho", 1.0) * least
    lines = ((theory["p_a"], start, least, theory["n1"]), (theory["p_z"], burnt, end, theory["n2"]))
    work = theory["p_z"] * (burnt - least)
    for pressure, volume, last, exponent in lines:
        growth, less = np.log(last / volume), 1 - exponent
        work += float(pressure * volume * (np.expm1(less * growth) / less if less else growth))
    return work


def _deviations(corners: RoundedCorners) -> list[Notice]:
    """Return where given pressures are not those of the lines they lie on."""
    found: list[Notice] = []
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
            found.append(("round_differs", {"name": name, "given": given, "computed": value}))
    return found


def _unusual(corners: RoundedCorners, filling: float) -> list[Notice]:
    rounding, found = corners.rounding, []
    if corners.timing.ignition_advance:
        found += [("round_peak", rounding.peak_angle, _USUAL_PEAK)]
        if rounding.school == "ru":
            found += [("round_rise", rounding.rise, _USUAL_RISE)]
        found += [("round_filling", filling, _USUAL_FILLING)]
    return [
        (code, {"value": value, "low": low, "high": high})
        for code, value, (low, high) in found
        if not low <= value <= high
    ]


def _above(corners: RoundedCorners, level: float) -> list[Notice]:
    """Return whether the peak stands out above the expansion line that it is to be rounded from."""
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
