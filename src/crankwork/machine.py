"""The machine that a description describes: mechanism, speed, cylinder, masses, gas, and how to compute."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from crankwork.dynamics.masses import CrankGearMasses
from crankwork.loads.indicator import DiagramPoint, Piece
from crankwork.loads.measured import MeasuredPressure
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import EXACT, Method


@dataclass(frozen=True)
class Cylinder:
    """The cylinder of a crank gear.

    Parameters
    ----------
    bore : float
        Diameter. [m]
    clearance_volume, compression_ratio : float or None
        One of them where the volume matters, that is, with gas. [m3], [-]
    piston_rod_diameter : float
        Of a double-acting piston; the rod takes its area from the crank side. [m]
    inclination : float
        From the upward vertical to the direction of the head, leaning towards the crankpin at 90 degrees. [rad]
    """

    bore: float
    clearance_volume: float | None = None
    compression_ratio: float | None = None
    piston_rod_diameter: float = 0.0
    inclination: float = 0.0


@dataclass(frozen=True)
class Gas:
    """The pressure in the cylinder over one cycle: an indicator diagram to be solved, or measured samples.

    Parameters
    ----------
    cycle : float
        720 or 360. [deg]
    points, pieces : mapping and tuple
        Named points and the laws between them.
    measured : MeasuredPressure or None
        Samples instead of points and pieces.
    angle_shift, resample : float and float or None
        Added to measured angles; step at which they are resampled. [deg]
    is_absolute : bool
        Whether pressures are absolute; then `ambient` is taken off.
    ambient : float
        Absolute pressure on the crankcase side. [Pa]
    names_ambient : bool
        Whether the description gives it.
    back_pressure : float
        Gauge pressure on the crank side of a double-acting piston. [Pa]
    """

    cycle: float = 720.0
    points: Mapping[str, DiagramPoint] = field(default_factory=dict)
    pieces: tuple[Piece, ...] = ()
    measured: MeasuredPressure | None = None
    angle_shift: float = 0.0
    resample: float | None = None
    is_absolute: bool = False
    ambient: float = 101325.0
    names_ambient: bool = False
    back_pressure: float = 0.0


@dataclass(frozen=True)
class Machine:
    """One machine, all in SI.

    Parameters
    ----------
    mechanism : Mechanism
        What moves.
    speed, angular_acceleration : float
        Of the crank. [rad/s], [rad/s2]
    title : str
        What the owner calls it.
    cylinder, masses, gas : optional
        What is known besides the motion.
    has_gravity : bool
        Whether weights count.
    method : Method
        How to compute unless told otherwise.
    table_step, table_special : float and tuple of float
        Step of the tables and further angles. [deg]
    """

    mechanism: Mechanism
    speed: float
    angular_acceleration: float = 0.0
    title: str = ""
    cylinder: Cylinder | None = None
    masses: CrankGearMasses | None = None
    gas: Gas | None = None
    has_gravity: bool = False
    method: Method = EXACT
    table_step: float = 10.0
    table_special: tuple[float, ...] = ()

    @property
    def cycle(self) -> float:
        """Crank angle after which everything repeats. [deg]"""
        return self.gas.cycle if self.gas else 360.0
