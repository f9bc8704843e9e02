"""A calculated working cycle: what was found, how, and the corners of its diagram."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, NamedTuple

from crankwork.formula.known import Known, absent

CycleKind = Literal["petrol", "diesel", "otto", "ideal-diesel", "dual"]
Notice = tuple[str, Mapping[str, float | str]]


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
