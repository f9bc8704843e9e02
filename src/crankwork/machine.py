"""The machine that a description describes: mechanism, speed, cylinder, masses, gas, and how to compute."""

from __future__ import annotations

import datetime as dt
import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal, NamedTuple

from crankwork.cylinders.layout import Layout
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.errors import CrankworkError
from crankwork.kinematics.piston import as_slider_crank
from crankwork.loads.chamber import Chamber, Charge, cycle_of, least_common
from crankwork.loads.indicator import DiagramPoint, Piece
from crankwork.loads.measured import MeasuredPressure
from crankwork.loads.valves import Valves
from crankwork.locale import Refusal
from crankwork.mechanism.driver import Law
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import EXACT, Method
from crankwork.units import System

if TYPE_CHECKING:
    from crankwork.cylinders.articulated import ArticulatedRod
    from crankwork.dynamics.efficiency import Series
    from crankwork.dynamics.friction import Friction
    from crankwork.dynamics.redundant import RedundantLink
    from crankwork.dynamics.tabulated import Differences, TabulatedBody
    from crankwork.kinematics.slider_crank import SliderCrank
    from crankwork.kinematics.travel import Travel
    from crankwork.loads.load import Load
    from crankwork.mechanism.linkage import Linkage
    from crankwork.shaft.motor import GearedMotor
    from crankwork.shaft.torque_diagram import Turning
    from crankwork.shaft.wheel import Wheel
    from crankwork.working_cycle.calculated_cycle import CalculatedPressure


_TURN = 360.0


class Stated(NamedTuple):
    """A number as a description states it, in SI, and the unit in which it is written."""

    value: float
    unit: str = ""


@dataclass(frozen=True)
class Document:
    """What a note and its sheets say of themselves; what is empty is left out, or to be filled in by hand.

    `work`: its kind, a course project; `subtitle`: what the note is, where it is no calculation report; `year`: 0 where
    none is known; `sections`: those of the note in their order, none for those of its school.
    """

    ministry: str = ""
    institution: str = ""
    faculty: str = ""
    department: str = ""
    work: str = ""
    subject: str = ""
    subtitle: str = ""
    variant: str = ""
    designation: str = ""
    author: tuple[str, ...] = ()
    student_number: tuple[str, ...] = ()
    group: str = ""
    supervisor: str = ""
    checked_by: str = ""
    standards_by: str = ""
    approved_by: str = ""
    city: str = ""
    year: int = 0
    date: dt.date | None = None
    sections: tuple[str, ...] = ()


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
    inclination : float or None
        From the upward vertical to the direction of the head, leaning towards the crankpin at 90 degrees; None where
        the engine stands upright. [rad]
    """

    bore: float
    clearance_volume: float | None = None
    compression_ratio: float | None = None
    piston_rod_diameter: float = 0.0
    inclination: float | None = None


@dataclass(frozen=True)
class Gas:
    """The pressure in the cylinder over one cycle: an indicator diagram to be solved, or measured samples.

    Parameters
    ----------
    cycle : float
        720 or 360. [deg]
    points, pieces : mapping and tuple
        Named points and the laws between them.
    valves : Valves or None
        What points and pieces follow from, counted from the top dead centre.
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
    factor, factor_path : float and str
        Of the gauge pressure, and where the description gives it. [-]
    path : str
        Where the description gives the diagram.
    """

    cycle: float = 720.0
    points: Mapping[str, DiagramPoint] = field(default_factory=dict)
    pieces: tuple[Piece, ...] = ()
    valves: Valves | None = None
    measured: MeasuredPressure | None = None
    angle_shift: float = 0.0
    resample: float | None = None
    is_absolute: bool = False
    ambient: float = 101325.0
    names_ambient: bool = False
    back_pressure: float = 0.0
    calculated: CalculatedPressure | None = None
    factor: float = 1.0
    factor_path: str = ""
    path: str = "gas"


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
    slave_rod : CrankGearMasses or None
        Masses of such a rod, at its piston pin and at its knuckle pin; those of the master rod if they are not given.
    offsets : tuple of float
        Of each cylinder axis from the crankshaft axis, by number, positive towards the crankpin at 90 degrees; empty
        if all have that of the crank gear. [m]
    gases : tuple of Gas
        The gas of each cylinder by number, alike ones the same object; empty if all have that of the crank gear.
    misfires : tuple of int
        Numbers of the cylinders in which nothing burns.
    bearings : Bearings
        Their sizes.
    counterweight : float
        Mass moment opposite each throw. [kg m]
    rotating_share, reciprocating_share : float
        Shares of the masses that counterweights balance, beyond `counterweight`. [-]
    balance_shafts : tuple of int
        Orders that pairs of balance shafts take out.
    notices : tuple of (str, mapping)
        What the reader should know of the layout: code and values.
    """

    layout: Layout
    slaves: tuple[ArticulatedRod | None, ...] = ()
    slave_rod: CrankGearMasses | None = None
    offsets: tuple[float, ...] = ()
    gases: tuple[Gas, ...] = ()
    misfires: tuple[int, ...] = ()
    bearings: Bearings = field(default_factory=Bearings)
    counterweight: float = 0.0
    rotating_share: float = 0.0
    reciprocating_share: float = 0.0
    balance_shafts: tuple[int, ...] = ()
    notices: tuple[tuple[str, Mapping[str, float | str]], ...] = ()


@dataclass(frozen=True)
class Drive:
    """What turns with the crank and drives it, or is driven by it.

    Parameters
    ----------
    efficiency : float
        Of the joints between motor and process, as the calculation uses it. [-]
    exact_efficiency : float or None
        Before a document rounded it. [-]
    inertia : float
        Moment of inertia that turns with the crank, a given flywheel included, one to be found not. [kg m2]
    motor : GearedMotor or None
        The motor, as the crank feels it.
    rated_power : float
        Of the motor. [W]
    fluctuation : float or None
        Wanted fluctuation of the speed, for which a flywheel is to be found. [-]
    chain : Series or None
        The efficiencies that make up the whole, as they are given.
    wheel : Wheel or None
        What else is known of the flywheel, given or to be found.
    losses : str
        What the efficiency stands for: all losses of the `machine`, friction too, or those of the `drive` between motor
        and crank; empty where the description states no friction.
    """

    efficiency: float = 1.0
    exact_efficiency: float | None = None
    inertia: float = 0.0
    motor: GearedMotor | None = None
    rated_power: float = 0.0
    fluctuation: float | None = None
    chain: Series | None = None
    wheel: Wheel | None = None
    losses: Literal["", "drive", "machine"] = ""


@dataclass(frozen=True)
class Transient:
    """A machine let go: from where and how fast, what drives it besides its loads, and how long it is followed.

    Parameters
    ----------
    time : float
        How long at most. [s]
    torque : float
        Constant torque on the crank. [N m]
    speed, start : float
        Of the crank at the beginning, and its angle there. [rad/s], [rad]
    motor : bool
        Whether the motor drives it.
    until : str
        `time`, or before it the first `rest` or the `steady` cycle.
    step : float or None
        Of the table. [s]
    stops : tuple of float
        Crank angles at which it is stopped, infinite where there is none. [rad]
    restitution : float
        Part of the speed that a stop gives back. [-]
    speeds : tuple of float
        Speeds whose first time is told. [rad/s]
    """

    time: float
    torque: float = 0.0
    speed: float = 0.0
    start: float = 0.0
    motor: bool = False
    until: Literal["time", "rest", "steady"] = "time"
    step: float | None = None
    stops: tuple[float, float] = (-math.inf, math.inf)
    restitution: float = 0.0
    speeds: tuple[float, ...] = ()


@dataclass(frozen=True)
class TransferTable:
    """Transfer functions by position, as a document prints them, instead of a mechanism.

    Parameters
    ----------
    angles : tuple of float
        Crank angles of the positions. [rad]
    bodies : tuple of TabulatedBody
        Moving masses and their transfer functions at the positions.
    reduced_inertia_1 : tuple of float or None
        Derivative of the reduced inertia, where the document prints its own. [kg m2]
    differences : str
        How it is taken otherwise.
    static_torque, balancing_torque : tuple of float or None
        Torque that balances the loads, or that and the dynamic torque together. [N m]
    """

    angles: tuple[float, ...]
    bodies: tuple[TabulatedBody, ...]
    reduced_inertia_1: tuple[float, ...] | None = None
    differences: Differences = "central"
    static_torque: tuple[float, ...] | None = None
    balancing_torque: tuple[float, ...] | None = None


@dataclass(frozen=True)
class Machine:
    """One machine, all in SI: what of it is known decides what is analysed.

    Parameters
    ----------
    mechanism : Mechanism
        What moves; a crank alone where transfer functions are given instead.
    speed, angular_acceleration : float
        Of the crank. [rad/s], [rad/s2]
    title : str
        What the owner calls it.
    document : Document
        What its note and sheets say of themselves.
    deviations : mapping of str to float
        Standard deviations of numbers that the file states with one, by key. [SI]
    digest : str
        SHA-256 of the machine file and of what was laid over it; empty for a machine made without one.
    units : str
        System of units of its tables, figures and notes: `metric`, `si` or `imperial`; results are in SI.
    linkage : Linkage or None
        The mechanism as it was drawn, for its structure; None for a crank gear, which is given by its lengths.
    transfer : TransferTable or None
        Transfer functions instead of a mechanism.
    turning : Turning or None
        The torques on a shaft that is nothing but a shaft, instead of a mechanism.
    cylinder, masses, gas : optional
        What is known of a crank gear besides the motion.
    has_gravity : bool
        Whether its weights count; those of a linkage are loads.
    loads : tuple of Load
        What pushes a linkage.
    redundant : tuple of RedundantLink
        Links too many that fit, and what each of them bears; `linkage` is without them.
    friction : tuple of Friction
        What rubs in pins and guides of a linkage.
    chambers, charges : mapping of str to Chamber and to Charge
        The gas between sliding pieces of a linkage, and that which is sealed in several chambers, by name.
    drive : Drive
        What turns with the crank and drives it.
    transient : Transient or None
        A start to be followed.
    method : Method
        How to compute unless told otherwise.
    table_step, table_special : float and tuple of float
        Step of the tables and further angles. [deg]
    working_range : tuple of float or None
        Of a crank that does not turn fully, the crank angles between which largest values count. [deg]
    engine : Engine or None
        The whole engine that this crank gear is a cylinder of.
    notices : tuple of (str, mapping)
        What the reader should know of the description of a linkage: code and values.
    """

    mechanism: Mechanism
    speed: float
    angular_acceleration: float = 0.0
    title: str = ""
    document: Document = Document()
    units: System = "metric"
    digest: str = field(default="", compare=False)
    deviations: Mapping[str, float] = field(default_factory=dict, compare=False)
    linkage: Linkage | None = None
    transfer: TransferTable | None = None
    turning: Turning | None = None
    cylinder: Cylinder | None = None
    masses: CrankGearMasses | None = None
    gas: Gas | None = None
    has_gravity: bool = False
    loads: tuple[Load, ...] = ()
    redundant: tuple[RedundantLink, ...] = ()
    friction: tuple[Friction, ...] = ()
    chambers: Mapping[str, Chamber] = field(default_factory=dict)
    charges: Mapping[str, Charge] = field(default_factory=dict)
    drive: Drive = Drive()
    transient: Transient | None = None
    method: Method = EXACT
    table_step: float = 10.0
    table_special: tuple[float, ...] = ()
    working_range: tuple[float, float] | None = None
    engine: Engine | None = None
    notices: tuple[tuple[str, Mapping[str, float | str]], ...] = ()
    # How far its crank gets, where the description has followed that
    way: Travel | None = field(default=None, compare=False, repr=False)
    # The numbers of the description by their paths: `crank.stroke`; a machine may be made without one
    stated: Mapping[str, Stated] = field(default_factory=dict, compare=False, repr=False)

    @property
    def lengths(self) -> SliderCrank | None:
        """The lengths of crank and rod, where neither a drawing nor a table gives the motion. [m]"""
        return as_slider_crank(self.mechanism) if self.linkage is None and self.transfer is None else None

    @property
    def inclination(self) -> float:
        """From the upward vertical to the head of cylinder 1, stated or that of an upright layout. [rad]"""
        if self.cylinder is not None and self.cylinder.inclination is not None:
            return self.cylinder.inclination
        return math.radians(self.engine.layout.places[0].axis) if self.engine is not None else 0.0

    def __post_init__(self) -> None:
        """Refuse what a machine file could not state either."""
        is_timed = self.mechanism.driver.law is not None
        limits: dict[str, tuple[object, float]] = {
            "speed": (self.speed, 0.0 if is_timed else sys.float_info.min),
            "angular_acceleration": (self.angular_acceleration, -math.inf),
            "table_step": (self.table_step, sys.float_info.min),
        }
        for name, (value, low) in limits.items():
            if not isinstance(value, int | float) or not math.isfinite(value) or value < low:
                kind = "object_number" if low < 0 else "object_positive"
                raise CrankworkError(Refusal(kind, name=name, value=str(value)[:40]))
        for load in self.loads:
            if not hasattr(load, "forces") and not type(load).__module__.startswith("crankwork.loads."):
                raise CrankworkError(Refusal("object_load", value=type(load).__name__))

    def driven_by(self, law: Law) -> Machine:
        """Return the machine with another law of its driver, whose segments may move by a `MotionLaw` of one's own."""
        driver = self.mechanism.driver
        if driver.law is None or self.linkage is None:
            raise CrankworkError(Refusal("law_unasked"))
        changed = replace(driver, law=law)
        return replace(
            self,
            mechanism=replace(self.mechanism, driver=changed),
            linkage=replace(self.linkage, driver=changed),
            way=None,
        )

    @property
    def drawn(self) -> Linkage:
        """The linkage as it was drawn, of a machine that is one."""
        if self.linkage is None:
            raise TypeError("this machine was not drawn as a linkage")
        return self.linkage

    @property
    def whole(self) -> Linkage:
        """The linkage as it was drawn, with the links too many that `drawn` is without."""
        extra = tuple(one.member for one in self.redundant)
        return replace(self.drawn, members=(*self.drawn.members, *extra)) if extra else self.drawn

    @property
    def cycle(self) -> float:
        """Crank angle after which everything repeats. [deg]"""
        if self.turning is not None:
            return round(math.degrees(self.turning.cycle), 9)
        if self.gas is not None:
            return self.gas.cycle
        if self.engine is not None:
            return self.engine.layout.cycle
        return least_common(cycle_of(self.chambers), self.mechanism.period)
