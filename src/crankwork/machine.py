"""The machine that a description describes: mechanism, speed, cylinder, masses, gas, and how to compute."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from crankwork.cylinders.layout import Layout
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.loads.indicator import DiagramPoint, Piece
from crankwork.loads.measured import MeasuredPressure
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import EXACT, Method

if TYPE_CHECKING:
    from crankwork.cylinders.articulated import ArticulatedRod
    from crankwork.working_cycle.calculated_cycle import CalculatedPressure


class Stated(NamedTuple):
    """A number as a description states it, in SI, and the unit in which it is written."""

    value: float
    unit: str = ""


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
    calculated : CalculatedPressure or None
        A calculation of the working cycle instead of points and pieces.
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
    calculated: CalculatedPressure | None = None


@dataclass(frozen=True)
class Bearings:
    """Sizes of the bearings, as far as known, and how their wear is drawn.

    Parameters
    ----------
    crankpin_diameter, crankpin_length, main_diameter, main_length, pin_diameter, pin_length : float or None
        Diameters and working lengths of crankpin, main journals and piston pin. [m]
    rays : int
        Rays of the wear diagram, 12 or 24.
    """

    crankpin_diameter: float | None = None
    crankpin_length: float | None = None
    main_diameter: float | None = None
    main_length: float | None = None
    pin_diameter: float | None = None
    pin_length: float | None = None
    rays: int = 12


@dataclass(frozen=True)
class Engine:
    """What makes a whole engine of one crank gear.

    Parameters
    ----------
    layout : Layout
        Where the cylinders stand and when they fire.
    slaves : tuple of ArticulatedRod or None
        The articulated rod of each cylinder, None where the rod turns on the crankpin; empty if none is articulated.
    bearings : Bearings
        Their sizes.
    counterweight : float
        Mass moment opposite each throw. [kg m]
    rotating_share, reciprocating_share : float
        Shares of the masses that counterweights balance, beyond `counterweight`. [-]
    balance_shafts : tuple of int
        Orders that pairs of balance shafts take out.
    fluctuation : float or None
        Wanted fluctuation of the speed. [-]
    inertia : float
        What turns with the crankshaft, without the flywheel to be found. [kg m2]
    notices : tuple of (str, mapping)
        What the reader should know of the layout: code and values.
    """

    layout: Layout
    slaves: tuple[ArticulatedRod | None, ...] = ()
    bearings: Bearings = field(default_factory=Bearings)
    counterweight: float = 0.0
    rotating_share: float = 0.0
    reciprocating_share: float = 0.0
    balance_shafts: tuple[int, ...] = ()
    fluctuation: float | None = None
    inertia: float = 0.0
    notices: tuple[tuple[str, Mapping[str, float | str]], ...] = ()


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
    engine : Engine or None
        The whole engine that this crank gear is a cylinder of.
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
    engine: Engine | None = None
    # The numbers of the description by their paths: `crank.stroke`; a machine may be made without one
    stated: Mapping[str, Stated] = field(default_factory=dict, compare=False, repr=False)

    @property
    def cycle(self) -> float:
        """Crank angle after which everything repeats. [deg]"""
        if self.gas is not None:
            return self.gas.cycle
        return self.engine.layout.cycle if self.engine is not None else 360.0
