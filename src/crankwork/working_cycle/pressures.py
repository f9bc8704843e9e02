"""Working cycles waiting for a cylinder: calculated corners, sharp or rounded, and heat release."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from crankwork.formula.known import Found, Known
from crankwork.loads.indicator import IndicatorDiagram, Segment, VolumeAt, solve_diagram
from crankwork.working_cycle.calculated_cycle import Calculated, CalculatedCycle, Corners
from crankwork.working_cycle.heat_data import HeatReleaseData
from crankwork.working_cycle.heat_release import HeatReleaseResult, heat_release
from crankwork.working_cycle.rounding import Rounding, Timing, rounded_diagram
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
            return Calculated(sharp, cycle.memory, notices, sharp)
        theory = {name: one.value for name, one in cycle.corners._asdict().items() if name != "rho" or one.value > 1}
        found = rounded_diagram(theory, self.timing, self.rounding, volume_at, dead_centres)
        key = "filling_factor.diagram"
        memory = {**cycle.memory, key: Known(Found(found.filling_factor, "integral", cycle.corners), key)}
        rounded = _remembering(found.diagram, cycle.corners)
        return Calculated(rounded, memory, (*notices, *found.notices), sharp)


def _remembering(diagram: IndicatorDiagram, corners: Corners) -> IndicatorDiagram:
    """Return a diagram whose segments know the pressures and exponents of the calculation."""
    lines = {"a": (corners.p_a, corners.n1, corners.psi), "z": (corners.p_z, corners.n2, corners.rho)}
    constants = {one.value: (one,) for one in (corners.p_z, corners.p_r, corners.p_a)}

    def remembering(segment: Segment) -> Segment:
        if segment.law == "polytropic":
            origin = _ORIGINS.get(segment.origin, segment.origin)
            return replace(segment, origin=origin, of=lines[origin])
        of = constants.get(segment.pressures[0], ()) if segment.law == "constant" else ()
        return replace(segment, places=(), of=of)

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
