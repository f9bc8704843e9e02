"""A calculated working cycle: its values, how they follow, and the corners of its diagram."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal, NamedTuple, Protocol

from crankwork.formula.traced_value import FormulaCall, Sum, TracedValue, absent, in_order
from crankwork.loads.indicator import IndicatorDiagram, VolumeAt

CycleKind = Literal["petrol", "diesel", "otto", "ideal-diesel", "dual", "assigned-petrol", "assigned-diesel"]
Notice = tuple[str, Mapping[str, float | str]]


class Corners(NamedTuple):
    """Pressures, exponents and ratios that define the theoretical diagram."""

    # Absolute pressures at the named points [Pa]
    p_r: TracedValue
    p_a: TracedValue
    p_c: TracedValue
    p_z: TracedValue
    p_b: TracedValue
    rho: TracedValue  # Volume at z over the clearance volume; 1 for combustion at constant volume [-]
    # Exponents of compression and expansion [-]
    n1: TracedValue
    n2: TracedValue
    epsilon: TracedValue  # Compression ratio of the closed cylinder [-]
    psi: TracedValue = absent("lost_stroke")  # Share of the stroke that the ports of a two-stroke engine take [-]
    V_a: TracedValue = absent("total_volume")  # Stated volume where compression begins [m3]


@dataclass(frozen=True, eq=False)
class CalculatedCycle:
    """A working cycle and how it was calculated."""

    kind: CycleKind  # Method of calculation
    angle: float  # Crank angle of the cycle, 720 or 360 [deg]
    corners: Corners  # Of the theoretical diagram
    trace: Mapping[str, TracedValue]  # Data and results by key, in the order of textbooks
    notices: tuple[Notice, ...] = ()  # Code and numbers of each notice

    @property
    def values(self) -> dict[str, float]:
        """Data and results by key. [SI]"""
        return {key: traced.value for key, traced in self.trace.items()}

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, CalculatedCycle):
            return NotImplemented
        # traced values have no equality: compare their numbers
        theirs = other.kind, other.angle, other.values, other.notices
        return (self.kind, self.angle, self.values, self.notices) == theirs

    __hash__ = None  # type: ignore[assignment]


class Calculated(NamedTuple):
    """A calculated diagram."""

    diagram: IndicatorDiagram  # Absolute pressure over the cycle
    # Single values by key of the table of quantities, in the order of calculation
    trace: Mapping[str, TracedValue]
    notices: tuple[tuple[str, Mapping[str, float | str]], ...]  # Codes and values
    theoretical: Callable[[], IndicatorDiagram] | None = None  # Gives the diagram before its corners were rounded
    peak: Mapping[str, TracedValue] = {}  # Values at the greatest pressure of a heat release, by key

    @property
    def values(self) -> dict[str, float]:
        """Single values by key. [SI]"""
        return {key: traced.value for key, traced in self.trace.items()}

    @property
    def worked(self) -> tuple[TracedValue, ...]:
        """Results of formulas and sums, in the order of calculation."""
        traced_values = {**self.peak, **self.trace}
        return tuple(
            traced
            for traced in in_order(traced_values.values())
            if isinstance(traced.node, FormulaCall | Sum) and (traced.key in traced_values or "." in traced.key)
        )


class CalculatedPressure(Protocol):
    """Calculation of the working cycle for any cylinder."""

    @property
    def has_corners(self) -> bool:
        """Whether the diagram has the corners of two strokes of one length, or of two pairs of them."""

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder."""

    @property
    def traced(self) -> Callable[[TracedValue, tuple[float, float]], TracedValue] | None:
        """What gives the pressure as a traced column of volume and dead centres, None without formulas for it."""
