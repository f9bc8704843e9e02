"""Working cycles for any cylinder: calculated corners, sharp or rounded, heat release, and misfire."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from crankwork.formula.known import Found, Known, absent
from crankwork.loads.indicator import DiagramPoint, IndicatorDiagram, Piece, Segment, VolumeAt, solve_diagram
from crankwork.working_cycle.calculated_cycle import Calculated, CalculatedCycle, Corners, DiagramDefinition, Notice
from crankwork.working_cycle.gas_exchange import constant_pressure
from crankwork.working_cycle.heat_data import HeatReleaseData
from crankwork.working_cycle.heat_release import HeatReleaseResult, heat_release
from crankwork.working_cycle.rounding import (
    Rounding,
    Timing,
    motored_diagram,
    rounded_diagram,
    traced_filling_factor,
    traced_rounded_pressure,
)
from crankwork.working_cycle.theoretical_diagram import theoretical_diagram

# A cylinder is identified by its volume at these crank angles. [deg]
_PROBES = (0.0, 67.0, 131.0, 213.0)
# Solving takes most of a run, and a file is solved once to check it and once to analyse it: cached.
_MAX_SOLUTIONS = 16
_SOLUTIONS: dict[object, HeatReleaseResult] = {}


@dataclass(frozen=True)
class CornerPressure:
    """The diagram of a calculated cycle."""

    cycle: CalculatedCycle  # The calculated cycle
    timing: Timing | None = None  # Of valves and ignition, if corners are rounded
    rounding: Rounding = field(default_factory=Rounding)  # How they are rounded

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder."""
        del volume_rate_at
        cycle = self.cycle
        drawn = theoretical_diagram(cycle.corners, cycle.angle, volume_at, dead_centres)
        # if corners are rounded, the sharp one is only looked at
        sharp = partial(_solved, drawn, cycle, volume_at, dead_centres)
        notices = (*cycle.notices, ("cycle_speed", {}))
        if self.timing is None:
            return Calculated(sharp(), cycle.memory, notices, sharp, drawn)
        result = rounded_diagram(_numbers(cycle.corners), self.timing, self.rounding, volume_at, dead_centres)
        key = "filling_factor.diagram"
        memory = {**cycle.memory, key: Known(Found(result.filling_factor, "integral", cycle.corners), key)}
        rounded = _with_traced_segments(result.diagram, cycle.corners)
        return Calculated(rounded, memory, (*notices, *result.notices), sharp, (result.points, result.pieces))

    def traced(self, volume: Known, dead_centres: tuple[float, float]) -> Known:
        """Return the pressure over the crank angle as a traced column of the volume of a cylinder."""
        timing = Timing(cycle=self.cycle.angle) if self.timing is None else self.timing
        return traced_rounded_pressure(_theory(self.cycle.corners), timing, self.rounding, volume, dead_centres)

    def filling_factor(self, value: float, columns: tuple[Known, Known], dead_centres: tuple[float, float]) -> Known:
        """Return the filling factor of the rounded diagram, traced to the columns of pressure and volume."""
        timing = self.timing or Timing(cycle=self.cycle.angle)
        return traced_filling_factor(value, _theory(self.cycle.corners), timing, columns, dead_centres)

    def motored(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram of a cylinder without combustion: expansion along the compression line."""
        del volume_rate_at
        theory = self.cycle.corners
        corners = theory._replace(p_z=theory.p_c, p_b=theory.p_a, n2=theory.n1, rho=absent("cut_off", 1.0))
        if self.timing is not None:
            numbers = _numbers(corners)
            drawn, diagram = motored_diagram(numbers, self.timing, self.rounding, volume_at, dead_centres)
        else:
            drawn = theoretical_diagram(corners, self.cycle.angle, volume_at, dead_centres)
            diagram = solve_diagram(*drawn, self.cycle.angle, volume_at, dead_centres=dead_centres)
        return Calculated(_with_traced_segments(diagram, corners), {}, (), drawn=drawn)


def _solved(
    drawn: DiagramDefinition, cycle: CalculatedCycle, volume_at: VolumeAt, dead_centres: tuple[float, float]
) -> IndicatorDiagram:
    """Return the diagram of a calculated cycle in a cylinder, from its points and pieces."""
    points, pieces = drawn
    diagram = solve_diagram(points, pieces, cycle.angle, volume_at, dead_centres=dead_centres)
    return _with_traced_segments(diagram, cycle.corners)


def _theory(corners: Corners) -> dict[str, Known]:
    """Return the corners by name, without `rho` if no combustion is at constant pressure. [SI]"""
    return {name: corner for name, corner in corners._asdict().items() if name != "rho" or corner.value > 1}


def _numbers(corners: Corners) -> dict[str, float]:
    return {name: corner.value for name, corner in _theory(corners).items()}


def _with_traced_segments(diagram: IndicatorDiagram, corners: Corners) -> IndicatorDiagram:
    """Return a diagram whose segments refer to the traced pressures and exponents of the calculation."""
    lines = {"a": (corners.p_a, corners.n1, corners.psi), "z": (corners.p_z, corners.n2, corners.rho)}
    constants = {pressure.value: (pressure,) for pressure in (corners.p_z, corners.p_r, corners.p_a)}

    def with_inputs(segment: Segment) -> Segment:
        if segment.law == "polytropic":
            origin = _ORIGINS.get(segment.origin, segment.origin)
            return replace(segment, origin=origin, operands=lines[origin])
        inputs = constants.get(segment.pressures[0], ()) if segment.law == "constant" else ()
        return replace(segment, places=(), operands=inputs)

    return replace(diagram, segments=tuple(with_inputs(segment) for segment in diagram.segments))


# names of the points of the calculation, by the reference states of polytropes in rounded diagrams
_ORIGINS = {"~start": "a", "~burnt": "z"}


@dataclass(frozen=True)
class HeatReleasePressure:
    """The diagram of a heat release."""

    data: HeatReleaseData  # Combustion, gas, walls and valves

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder."""
        return self._solved(volume_at, volume_rate_at, dead_centres).calculated

    def motored(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram of a cylinder without combustion; the walls still take heat."""
        cold = replace(self.data, heat=0.0, fuel_per_cycle=0.0)
        return HeatReleasePressure(cold).pressure(volume_at, volume_rate_at, dead_centres)

    def diagram_in(
        self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]
    ) -> tuple[IndicatorDiagram, tuple[Notice, ...]]:
        """Return the diagram in a chamber, with notices."""
        calculated = self._solved(volume_at, volume_rate_at, dead_centres).calculated
        return calculated.diagram, calculated.notices

    def _solved(
        self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]
    ) -> HeatReleaseResult:
        """Return the solution, cached by data and cylinder."""
        cylinder = tuple(volume_at(np.array(_PROBES)).tolist())
        key = (self.data, cylinder, dead_centres)
        if key not in _SOLUTIONS:
            if len(_SOLUTIONS) >= _MAX_SOLUTIONS:
                _SOLUTIONS.clear()
            _SOLUTIONS[key] = heat_release(self.data, volume_at, volume_rate_at, dead_centres)
        return _SOLUTIONS[key]


@dataclass(frozen=True)
class MisfirePressure:
    """The pressure in a misfiring cylinder of an engine whose cycle is calculated."""

    firing: CornerPressure | HeatReleasePressure  # The cycle of the firing cylinders
    angle: float  # Of the cycle [deg]
    ambient: Known | None = None  # Constant pressure if its valves stay open [Pa]

    @property
    def cycle(self) -> CalculatedCycle | None:
        """The calculated cycle of the firing cylinders."""
        return self.firing.cycle if isinstance(self.firing, CornerPressure) else None

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder, with the values of the cycle of the firing cylinders."""
        firing = self.firing.pressure(volume_at, volume_rate_at, dead_centres)
        if self.ambient is not None:
            diagram = IndicatorDiagram((constant_pressure(0.0, self.angle, self.ambient),), {})
            ends = {"o": DiagramPoint(0.0, self.ambient.value), "o'": DiagramPoint(self.angle)}
            drawn: DiagramDefinition = ends, (Piece("constant", ("o", "o'")),)
        else:
            cold = self.firing.motored(volume_at, volume_rate_at, dead_centres)
            diagram, drawn = cold.diagram, cold.drawn
        return firing._replace(diagram=diagram, theoretical=None, drawn=drawn)
