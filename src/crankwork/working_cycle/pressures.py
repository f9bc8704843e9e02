"""Working cycles waiting for a cylinder: calculated corners, sharp or rounded, and heat release."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from crankwork.loads.indicator import VolumeAt, solve_diagram
from crankwork.working_cycle.calculated import Calculated
from crankwork.working_cycle.calculated_cycle import CalculatedCycle
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
    """The diagram of a calculated cycle.

    Parameters
    ----------
    cycle : CalculatedCycle
        What was calculated.
    timing : Timing or None
        Of valves and ignition, where corners are rounded.
    rounding : Rounding
        How they are rounded.
    """

    cycle: CalculatedCycle
    timing: Timing | None = None
    rounding: Rounding = field(default_factory=Rounding)

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder.

        Parameters
        ----------
        volume_at, volume_rate_at : callable
            Cylinder volume of an array of crank angles, and its derivative. [deg] -> [m3], [deg] -> [m3/rad]
        dead_centres : tuple of float
            Top and bottom dead centre within one revolution. [deg]
        """
        del volume_rate_at
        cycle = self.cycle
        points, pieces = theoretical_diagram(cycle.corners, cycle.angle, volume_at, dead_centres)
        sharp = solve_diagram(points, pieces, cycle.angle, volume_at, dead_centres=dead_centres)
        if self.timing is None:
            return Calculated(sharp, cycle.values, cycle.steps, cycle.notices, sharp, cycle.corners)
        corners = cycle.corners
        theory = {
            "p_r": corners.p_r, "p_a": corners.p_a, "p_c": corners.p_c, "p_z": corners.p_z, "p_b": corners.p_b,
            "epsilon": corners.epsilon, "n1": corners.n1, "n2": corners.n2,
        }  # fmt: skip
        if corners.rho > 1:
            theory["rho"] = corners.rho
        found = rounded_diagram(theory, self.timing, self.rounding, volume_at, dead_centres)
        values = {**cycle.values, "filling_factor.diagram": found.filling_factor}
        notices = (*cycle.notices, *found.notices)
        return Calculated(found.diagram, values, cycle.steps, notices, sharp, corners)


@dataclass(frozen=True)
class HeatReleasePressure:
    """The diagram that a release of heat makes.

    Parameters
    ----------
    data : HeatReleaseData
        Burning, gas, walls and valves.
    """

    data: HeatReleaseData

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder.

        Parameters
        ----------
        volume_at, volume_rate_at : callable
            Cylinder volume of an array of crank angles, and its derivative. [deg] -> [m3], [deg] -> [m3/rad]
        dead_centres : tuple of float
            Top and bottom dead centre within one revolution. [deg]
        """
        found = self._solved(volume_at, volume_rate_at, dead_centres)
        values = {
            key: math.radians(value) if key.endswith("_angle") else value
            for key, value in found.values.items()
            if "quadrature" not in key
        }
        return Calculated(found.diagram, values, found.steps, found.notices)

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
