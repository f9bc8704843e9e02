"""Working cycles waiting for a cylinder: calculated corners, sharp or rounded, heat release, and one that misfires."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from crankwork.formula.known import Found, Known, absent
from crankwork.loads.indicator import DiagramPoint, IndicatorDiagram, Piece, Segment, VolumeAt, solve_diagram
from crankwork.working_cycle.calculated_cycle import Calculated, CalculatedCycle, Corners, Drawn, Notice
from crankwork.working_cycle.gas_exchange import constant_pressure
from crankwork.working_cycle.heat_data import HeatReleaseData
from crankwork.working_cycle.heat_release import HeatReleaseResult, heat_release
from crankwork.working_cycle.rounding import (
    Rounding,
    Timing,
    motored_diagram,
    remembered_filling,
    remembered_pressure,
    rounded_diagram,
)
from crankwork.working_cycle.theoretical_diagram import theoretical_diagram

# A cylinder is known by its volume at a few crank angles. [deg]
_PROBES = (0.0, 67.0, 131.0, 213.0)
# Solving takes most of a run, and a file is solved once to check it and once to analyse it.
_MOST_KNOWN = 16
_KNOWN: dict[object, HeatReleaseResult] = {}


@dataclass(frozen=True)
class CornerPressure:
    """The diagram of a calculated cycle."""

    cycle: CalculatedCycle  # What was calculated
    timing: Timing | None = None  # Of valves and ignition, where corners are rounded
    rounding: Rounding = field(default_factory=Rounding)  # How they are rounded

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder."""
        del volume_rate_at
        cycle = self.cycle
        points, pieces = theoretical_diagram(cycle.corners, cycle.angle, volume_at, dead_centres)
        sharp = solve_diagram(points, pieces, cycle.angle, volume_at, dead_centres=dead_centres)
        sharp = _remembering(sharp, cycle.corners)
        notices = (*cycle.notices, ("cycle_speed", {}))
        if self.timing is None:
            return Calculated(sharp, cycle.memory, notices, sharp, (points, pieces))
        found = rounded_diagram(_numbers(cycle.corners), self.timing, self.rounding, volume_at, dead_centres)
        key = "filling_factor.diagram"
        memory = {**cycle.memory, key: Known(Found(found.filling_factor, "integral", cycle.corners), key)}
        rounded = _remembering(found.diagram, cycle.corners)
        return Calculated(rounded, memory, (*notices, *found.notices), sharp, (found.points, found.pieces))

    def remembered(self, volume: Known, dead_centres: tuple[float, float]) -> Known:
        """Return the pressure over the crank angle, made of knowns alone, of the volume of a cylinder."""
        timing = Timing(cycle=self.cycle.angle) if self.timing is None else self.timing
        return remembered_pressure(_theory(self.cycle.corners), timing, self.rounding, volume, dead_centres)

    def filling(self, value: float, columns: tuple[Known, Known], dead_centres: tuple[float, float]) -> Known:
        """Return the filling factor of the rounded diagram, of the columns of pressure and volume."""
        timing = self.timing or Timing(cycle=self.cycle.angle)
        return remembered_filling(value, _theory(self.cycle.corners), timing, columns, dead_centres)

    def motored(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram of a cylinder in which nothing burns: expansion goes back along the compression line."""
        del volume_rate_at
        one = self.cycle.corners
        corners = one._replace(p_z=one.p_c, p_b=one.p_a, n2=one.n1, rho=absent("cut_off", 1.0))
        if self.timing is not None:
            theory = _numbers(corners)
            drawn, diagram = motored_diagram(theory, self.timing, self.rounding, volume_at, dead_centres)
        else:
            drawn = theoretical_diagram(corners, self.cycle.angle, volume_at, dead_centres)
            diagram = solve_diagram(*drawn, self.cycle.angle, volume_at, dead_centres=dead_centres)
        return Calculated(_remembering(diagram, corners), {}, (), drawn=drawn)


def _theory(corners: Corners) -> dict[str, Known]:
    """Return the corners by name, without a burning at constant pressure where there is none. [SI]"""
    return {name: one for name, one in corners._asdict().items() if name != "rho" or one.value > 1}


def _numbers(corners: Corners) -> dict[str, float]:
    return {name: one.value for name, one in _theory(corners).items()}


def _remembering(diagram: IndicatorDiagram, corners: Corners) -> IndicatorDiagram:
    """Return a diagram whose segments know the pressures and exponents of the calculation."""
    lines = {"a": (corners.p_a, corners.n1, corners.psi), "z": (corners.p_z, corners.n2, corners.rho)}
    constants = {one.value: (one,) for one in (corners.p_z, corners.p_r, corners.p_a)}

    def remembering(segment: Segment) -> Segment:
        if segment.law == "polytropic":
            origin = _ORIGINS.get(segment.origin, segment.origin)
            return replace(segment, origin=origin, operands=lines[origin])
        of = constants.get(segment.pressures[0], ()) if segment.law == "constant" else ()
        return replace(segment, places=(), operands=of)

    return replace(diagram, segments=tuple(remembering(one) for one in diagram.segments))


# the points of the calculation by the states that rounded diagrams begin their polytropes with
_ORIGINS = {"~start": "a", "~burnt": "z"}


@dataclass(frozen=True)
class HeatReleasePressure:
    """The diagram that a release of heat makes."""

    data: HeatReleaseData  # Burning, gas, walls and valves

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder."""
        return self._solved(volume_at, volume_rate_at, dead_centres).calculated

    def motored(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram of a cylinder in which nothing burns: no heat is released, and walls take theirs."""
        cold = replace(self.data, heat=0.0, fuel_per_cycle=0.0)
        return HeatReleasePressure(cold).pressure(volume_at, volume_rate_at, dead_centres)

    def diagram_in(
        self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]
    ) -> tuple[IndicatorDiagram, tuple[Notice, ...]]:
        """Return the diagram in a chamber, and what the reader should know of it."""
        found = self._solved(volume_at, volume_rate_at, dead_centres).calculated
        return found.diagram, found.notices

    def _solved(
        self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]
    ) -> HeatReleaseResult:
        """Return the solution, that of the same data in the same cylinder if it is known already."""
        cylinder = tuple(volume_at(np.array(_PROBES)).tolist())
        key = (self.data, cylinder, dead_centres)
        if key not in _KNOWN:
            if len(_KNOWN) >= _MOST_KNOWN:
                _KNOWN.clear()
            _KNOWN[key] = heat_release(self.data, volume_at, volume_rate_at, dead_centres)
        return _KNOWN[key]


@dataclass(frozen=True)
class MisfirePressure:
    """The pressure in a cylinder in which nothing burns, of an engine whose cycle is calculated."""

    of: CornerPressure | HeatReleasePressure  # The cycle of those that fire
    angle: float  # Of the cycle [deg]
    ambient: Known | None = None  # Pressure in it where its valves stay open [Pa]

    @property
    def cycle(self) -> CalculatedCycle | None:
        """What was calculated for those that fire."""
        return self.of.cycle if isinstance(self.of, CornerPressure) else None

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder, and the values of the cycle of those that fire."""
        found = self.of.pressure(volume_at, volume_rate_at, dead_centres)
        if self.ambient is not None:
            diagram = IndicatorDiagram((constant_pressure(0.0, self.angle, self.ambient),), {})
            ends = {"o": DiagramPoint(0.0, self.ambient.value), "o'": DiagramPoint(self.angle)}
            drawn: Drawn = ends, (Piece("constant", ("o", "o'")),)
        else:
            cold = self.of.motored(volume_at, volume_rate_at, dead_centres)
            diagram, drawn = cold.diagram, cold.drawn
        return found._replace(diagram=diagram, theoretical=None, drawn=drawn)
