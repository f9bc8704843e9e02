"""What any calculation of the working cycle gives to a cylinder: its diagram, and how the numbers came about."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Protocol

from crankwork.loads.indicator import IndicatorDiagram, VolumeAt
from crankwork.steps import Step
from crankwork.working_cycle.calculated_cycle import Corners


class Calculated(NamedTuple):
    """A calculated diagram.

    Parameters
    ----------
    diagram : IndicatorDiagram
        Absolute pressure over the cycle.
    values : mapping of str to float
        Single values by key of the table of quantities. [SI]
    steps : tuple of Step
        How they came about, in order.
    notices : tuple of (str, mapping)
        What the reader should know: code and values.
    theoretical : IndicatorDiagram or None
        The diagram before its corners were rounded.
    corners : Corners or None
        What that is drawn from.
    """

    diagram: IndicatorDiagram
    values: Mapping[str, float]
    steps: tuple[Step, ...]
    notices: tuple[tuple[str, Mapping[str, float | str]], ...]
    theoretical: IndicatorDiagram | None = None
    corners: Corners | None = None


class CalculatedPressure(Protocol):
    """A calculation of the working cycle, waiting for a cylinder."""

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder.

        Parameters
        ----------
        volume_at, volume_rate_at : callable
            Cylinder volume of an array of crank angles, and its derivative. [deg] -> [m3], [deg] -> [m3/rad]
        dead_centres : tuple of float
            Top and bottom dead centre within one revolution. [deg]
        """
