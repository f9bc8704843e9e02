"""Chambers of gas between sliding pieces, and gas that is sealed in several of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal, Protocol

from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import ProcedureValue, TracedValue, given
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.loads import gas
from crankwork.loads.indicator import DiagramError, DiagramPoint, IndicatorDiagram, Piece, VolumeAt
from crankwork.loads.measured_pressure import MeasuredPressure
from crankwork.loads.traced_diagram import at_angle
from crankwork.loads.valves import Pipe, Valves
from crankwork.locale import ErrorMessage
from crankwork.mechanism.dyads import Branch

_TURN = 360.0
# share of the largest volume below which a volume counts as zero
ZERO_TOLERANCE = 1e-12


class CalculatedDiagram(Protocol):
    """A diagram of a calculated cycle, in absolute pressure."""

    @property
    def diagram(self) -> IndicatorDiagram:
        """The diagram."""

    @property
    def trace(self) -> Mapping[str, TracedValue]:
        """Single values by key, in the order of calculation."""

    @property
    def notices(self) -> tuple[tuple[str, Mapping[str, float | str]], ...]:
        """What is to be known about it: codes and values."""


class PressureOfCycle(Protocol):
    """A calculation of the working cycle that needs the volume of a chamber to give a pressure."""

    @property
    def has_corners(self) -> bool:
        """Whether its diagram has the corners of two strokes of one length, or of two pairs of them."""

    def pressure(
        self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]
    ) -> CalculatedDiagram:
        """Return the diagram in a chamber."""

    @property
    def traced(self) -> Callable[[TracedValue, tuple[float, float]], TracedValue] | None:
        """What gives the pressure as a traced column of volume and dead centres, None without formulas for it."""


@dataclass(frozen=True)
class Face:
    """A sliding piece as a wall of a chamber, by its bore, less that of a rod, or by its area. [m], [m2]"""

    slider: str
    bore: float | None = None
    rod_diameter: float = 0.0
    area: float | None = None
    sense: Branch = 1  # 1 if the chamber grows as the piece moves along its guide, -1 if it shrinks


@dataclass(frozen=True)
class Chamber:
    """A space whose walls move, and the gas in it. [m3], [Pa], [deg], [K]

    Its pressure is constant, a diagram of points and pieces, that of valves, measured, that of a calculated
    cycle, or that of a charge which is sealed in it.
    """

    faces: tuple[Face, ...]
    # One of the two gives the volume; without them the volume counts from its minimum
    clearance_volume: float | None = None
    compression_ratio: float | None = None
    ambient: float = 0.0  # Pressure on the other side of its faces, absolute if its own pressure is
    names_ambient: bool = True  # Whether the description gives it
    cycle: float = 360.0  # Crank angle after which its pressure repeats, 360 or 720
    pressure: float | None = None
    points: Mapping[str, DiagramPoint] = field(default_factory=dict)
    pieces: tuple[Piece, ...] = ()
    valves: Valves | None = None  # Give points and pieces, from the smallest volume on
    measured: MeasuredPressure | None = None
    delay: float = 0.0  # Crank angle by which its diagram is delayed [deg]
    factor: float = 1.0  # Of the gauge pressure
    calculated: PressureOfCycle | None = None  # A calculation of the cycle that gives its pressure
    # Added to measured angles; step at which they are resampled
    angle_shift: float = 0.0
    resample: float | None = None
    temperature: float | None = None  # Absolute temperature of a charge while it is here


@dataclass(frozen=True)
class Vessel:
    """A vessel at the valves of several chambers of a pump, and the pipe behind it, whose flow it evens."""

    chambers: tuple[str, ...]
    side: Literal["suction", "discharge"]
    pipe: Pipe | None = None


@dataclass(frozen=True)
class DeadVolume:
    """A volume that is always full of gas: a heat exchanger, a regenerator. [m3], [K]"""

    volume: float
    temperature: float | None = None


@dataclass(frozen=True)
class Charge:
    """A mass of gas sealed in chambers that are open to each other, at one pressure. [Pa], [kg], [J/(kg K)]

    Each part is at its own temperature, or all of it follows a polytrope. The mean pressure, the pressure at a crank
    angle [deg], or the mass says how much gas there is.
    """

    chambers: tuple[str, ...]
    dead_volumes: tuple[DeadVolume, ...] = ()
    exponent: float | None = None  # That of the polytrope
    mean_pressure: float | None = None
    pressure: float | None = None
    angle: float = 0.0
    mass: float | None = None
    gas_constant: float | None = None


def cycle_of(chambers: Mapping[str, Chamber]) -> float:
    """Return the crank angle after which every pressure repeats. [deg]"""
    return max((chamber.cycle for chamber in chambers.values()), default=_TURN)


def least_common(cycle: float, period: float) -> float:
    """Return the least common multiple of two crank angles that are whole numbers of turns. [deg]"""
    return _TURN * math.lcm(round(cycle / _TURN), round(period / _TURN))


def own_cycle(chamber: Chamber, period: float) -> float:
    """Return the crank angle after which pressure and volume of a chamber repeat; `period`: of the motion. [deg]"""
    return least_common(chamber.cycle, period)


def face_names(name: str, chamber: Chamber) -> tuple[str, ...]:
    """Return the names of the faces of a chamber in keys: that of the chamber, with several faces also the piece."""
    if len(chamber.faces) == 1:
        return (name,)
    return tuple(f"{name}.{face.slider}" for face in chamber.faces)


def charge_mass(name: str, charge: Charge, volume: TracedValue, constant: TracedValue, period: float) -> TracedValue:
    """Return the mass of a charge whose parts keep their temperatures."""
    key = f"gas_mass.{name}"
    if charge.mass is not None:
        return given(key, charge.mass, f"charges.{name}.mass")
    over = _volume_over_cycle(name, volume, period)
    if charge.mean_pressure is None:
        start = at_angle(volume, charge.angle, f"reduced_volume.{name}.start")
    else:
        mean = math.radians(period) / over.integral("inverse")
        start = TracedValue(ProcedureValue(mean, "harmonic_mean", (volume,)), f"reduced_volume.{name}.mean")
    return gas.charge_mass(_stated(name, charge), start, constant).named(key)  # type: ignore[no-any-return]


def charge_pressure(
    name: str, charge: Charge, volume: TracedValue, exponent: TracedValue, period: float
) -> TracedValue:
    """Return the pressure of a charge that follows a polytrope."""
    over, stated = _volume_over_cycle(name, volume, period), _stated(name, charge)
    if charge.mean_pressure is None:
        start = at_angle(volume, charge.angle, f"cylinder_volume.{name}.start")
    else:
        angle = over.extremes("")["_min_angle"] * (180 / math.pi)
        start = at_angle(volume, angle.value, f"cylinder_volume.{name}.start", angle)
        trial = gas.polytropic_pressure(stated, start, volume, exponent)
        mean = CycleInterpolant({"": trial}, CrankGrid.from_degrees, period).mean("", f"diagram_pressure.{name}.trial")
        stated = (stated * (stated / mean)).named(f"diagram_pressure.{name}.start")
    return gas.polytropic_pressure(stated, start, volume, exponent)  # type: ignore[no-any-return]


def _stated(name: str, charge: Charge) -> TracedValue:
    if charge.mean_pressure is not None:
        return given(f"diagram_pressure.{name}.mean", charge.mean_pressure, f"charges.{name}.mean_pressure")
    return given(f"diagram_pressure.{name}.start", charge.pressure or math.nan, f"charges.{name}.pressure")


def _volume_over_cycle(name: str, volume: TracedValue, period: float) -> CycleInterpolant:
    """Return the volume of a charge and its inverse over the cycle; raise if the volume vanishes."""
    largest, least = CycleInterpolant({"": volume}, CrankGrid.from_degrees, period).extreme_points[""]
    if least.value <= ZERO_TOLERANCE * largest.value:
        raise DiagramError(f"charges.{name}", ErrorMessage("charge_empty", angle=least.at))
    return CycleInterpolant({"": volume, "inverse": 1 / volume}, CrankGrid.from_degrees, period)
