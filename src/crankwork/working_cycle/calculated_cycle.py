"""A calculated working cycle: what was found, how, and the corners of its diagram."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, NamedTuple, Protocol

from crankwork.formula.known import Known, Total, Use, absent, in_order
from crankwork.loads.indicator import DiagramPoint, IndicatorDiagram, Piece, VolumeAt

CycleKind = Literal["petrol", "diesel", "otto", "ideal-diesel", "dual"]
Notice = tuple[str, Mapping[str, float | str]]
# points of a diagram and the laws between them
Drawn = tuple[Mapping[str, DiagramPoint], tuple[Piece, ...]]


class Corners(NamedTuple):
    """What the theoretical diagram is drawn from."""

    # Absolute pressures at the named points [Pa]
    p_r: Known
    p_a: Known
    p_c: Known
    p_z: Known
    p_b: Known
    rho: Known  # Volume at z over the clearance volume; 1 where burning is at constant volume [-]
    # Exponents of compression and expansion [-]
    n1: Known
    n2: Known
    epsilon: Known  # Compression ratio of the closed cylinder [-]
    psi: Known = absent("lost_stroke")  # Share of the stroke that the ports of a two-stroke engine take [-]


@dataclass(frozen=True, eq=False)
class CalculatedCycle:
    """A working cycle and how it was calculated."""

    kind: CycleKind  # What was calculated
    angle: float  # Crank angle of the cycle, 720 or 360 [deg]
    corners: Corners  # Of the theoretical diagram
    memory: Mapping[str, Known]  # Data and results by key, in the order of textbooks
    notices: tuple[Notice, ...] = ()  # Code and numbers of everything worth saying

    @property
    def values(self) -> dict[str, float]:
        """Data and results by key. [SI]"""
        return {key: one.value for key, one in self.memory.items()}

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, CalculatedCycle):
            return NotImplemented
        # knowns are never compared: cycles are equal where their numbers are
        told = [(one.kind, one.angle, one.values, one.notices) for one in (self, other)]
        return told[0] == told[1]

    __hash__ = None  # type: ignore[assignment]


class Calculated(NamedTuple):
    """A calculated diagram."""

    diagram: IndicatorDiagram  # Absolute pressure over the cycle
    # Single values by key of the table of quantities, in the order in which they were found
    memory: Mapping[str, Known]
    notices: tuple[tuple[str, Mapping[str, float | str]], ...]  # What the reader should know: code and values
    theoretical: IndicatorDiagram | None = None  # The diagram before its corners were rounded
    # Points and laws that give the diagram; empty where it is none of corners
    drawn: Drawn = ({}, ())
    peak: Mapping[str, Known] = {}  # What stands behind the greatest pressure of a release of heat, by key

    @property
    def values(self) -> dict[str, float]:
        """Single values by key. [SI]"""
        return {key: one.value for key, one in self.memory.items()}

    @property
    def worked(self) -> tuple[Known, ...]:
        """What formulas and sums give, in the order of calculation."""
        knowns = {**self.peak, **self.memory}
        return tuple(
            one
            for one in in_order(knowns.values())
            if isinstance(one.node, Use | Total) and (one.key in knowns or "." in one.key)
        )


class CalculatedPressure(Protocol):
    """A calculation of the working cycle, waiting for a cylinder."""

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder."""
