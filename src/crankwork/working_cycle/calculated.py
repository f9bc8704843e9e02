"""What any calculation of the working cycle gives to a cylinder: its diagram, and how the numbers came about."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Protocol

from crankwork.formula.known import Known, Total, Use, in_order
from crankwork.formula.lines import Moment
from crankwork.formula.steps import AnyStep
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.loads.indicator import IndicatorDiagram, VolumeAt


class Calculated(NamedTuple):
    """A calculated diagram."""

    diagram: IndicatorDiagram  # Absolute pressure over the cycle
    # Single values by key of the table of quantities, in the order in which they were found
    memory: Mapping[str, Known]
    notices: tuple[tuple[str, Mapping[str, float | str]], ...]  # What the reader should know: code and values
    theoretical: IndicatorDiagram | None = None  # The diagram before its corners were rounded
    peak: Mapping[str, Known] = {}  # What stands behind the greatest pressure of a release of heat, by key

    @property
    def values(self) -> dict[str, float]:
        """Single values by key. [SI]"""
        return {key: one.value for key, one in self.memory.items()}

    @property
    def steps(self) -> tuple[AnyStep, ...]:
        """How they came about, in order."""
        knowns = {**self.peak, **self.memory}
        worked = [
            one
            for one in in_order(knowns.values())
            if isinstance(one.node, Use | Total) and (one.key in knowns or "." in one.key)
        ]
        return tuple(Moment(CrankGrid.from_degrees, 0.0).steps(worked))


class CalculatedPressure(Protocol):
    """A calculation of the working cycle, waiting for a cylinder."""

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder."""
