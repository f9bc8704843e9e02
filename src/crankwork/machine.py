"""The machine that a description describes: mechanism, speed, cylinder, masses, gas, and how to compute."""

from __future__ import annotations

import datetime as dt
import math
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from numbers import Real
from typing import TYPE_CHECKING, Literal, NamedTuple

from crankwork.cylinders.layout import Bearings, Layout, PinBearing, Shaft
from crankwork.cylinders.planes import Rotor
from crankwork.dynamics.masses import CrankGearMasses
from crankwork.errors import CrankworkError
from crankwork.kinematics.piston import as_slider_crank
from crankwork.loads.chamber import Chamber, Charge, Vessel, cycle_of, least_common
from crankwork.loads.indicator import DiagramPoint, Piece
from crankwork.loads.measured_pressure import MeasuredPressure
from crankwork.loads.stages import Stages
from crankwork.loads.valves import Valves
from crankwork.locale import ErrorMessage
from crankwork.mechanism.driver import Law
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import EXACT, Method
from crankwork.units import System

if TYPE_CHECKING:
    from crankwork.cylinders.articulated import ArticulatedRod
    from crankwork.dynamics.efficiency import Chain
    from crankwork.dynamics.friction import Friction
    from crankwork.dynamics.reduction import Differences, TabulatedBody
    from crankwork.dynamics.redundant import RedundantLink
    from crankwork.kinematics.crank_range import CrankRange
    from crankwork.kinematics.slider_crank import SliderCrank
    from crankwork.loads.load import Load
    from crankwork.mechanism.linkage import Linkage
    from crankwork.shaft.flywheel import FlywheelSpec
    from crankwork.shaft.motor import GearedMotor, MotorSelection
    from crankwork.shaft.torque_diagram import ShaftTorques
    from crankwork.shaft.torsion_model import TorsionModel
    from crankwork.working_cycle.burning_analysis import BurningAnalysis
    from crankwork.working_cycle.calculated_cycle import CalculatedPressure

__all__ = [
    "Bearings", "Cylinder", "Document", "Drive", "Engine", "Gas", "InputNumber", "Machine", "PinBearing", "Shaft",
    "TransferTable", "Transient",
]  # fmt: skip
_TURN = 360.0
# of drivers and dyads
_LENGTHS = ("radius", "length", "length_a", "length_b")


class InputNumber(NamedTuple):
    """A number of a description in SI, and the unit in which it is stated."""

    value: float
    unit: str = ""


class FileInput(NamedTuple):
    """A value of a description as it is written, and the key of the text about its field."""

    value: object
    meaning: str = ""


class FileInputs(NamedTuple):
    """What a description states, and the defaults of what else it could state, by path."""

    stated: Mapping[str, FileInput]
    defaults: Mapping[str, FileInput]


@dataclass(frozen=True)
class Document:
    """Title data of a note and its sheets; empty fields are left out or filled in by hand.

    `title_ru`: the title in a note of this language; `work`: kind of the work, such as a course project; `subtitle`: if
    the note is not a calculation report; `year`: 0 if unknown; `sections`: of the note in their order, by default those
    of its school; `sheets`: figures of the sheets; `figures`: curves of figures by name, keys of columns.
    """

    title_en: str = ""
    title_ru: str = ""
    title_vi: str = ""
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
    scale: str = ""
    sheets: tuple[str, ...] = ()
    figures: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


@dataclass(frozen=True)
class Cylinder:
    """The cylinder of a crank mechanism.

    Parameters
    ----------
    bore : float
        Diameter. [m]
    clearance_volume, compression_ratio : float or None
        One of them is needed with gas. [m3], [-]
    piston_rod_diameter : float
        Of a double-acting piston; the rod takes its area from the crank side. [m]
    inclination : float or None
        From the upward vertical to the direction of the head, positive towards the crankpin at 90 degrees; None for
        an upright engine. [rad]
    travels : mapping of str to float
        Ways of the piston whose crank angles are wanted, from the top dead centre, negative from the bottom. [m]
    """

    bore: float
    clearance_volume: float | None = None
    compression_ratio: float | None = None
    piston_rod_diameter: float = 0.0
    inclination: float | None = None
    travels: Mapping[str, float] = field(default_factory=dict, hash=False)


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
        Valves that give points and pieces, counted from the top dead centre.
    measured : MeasuredPressure or None
        Samples instead of points and pieces.
    angle_shift, resample : float and float or None
        Added to measured angles; step at which they are resampled. [deg]
    delay : float
        Crank angle by which points or measured samples come later than the cycle of the cylinder. [deg]
    is_absolute : bool
        Whether pressures are absolute; then `ambient` is subtracted.
    ambient : float
        Absolute pressure on the crankcase side. [Pa]
    names_ambient : bool
        Whether the description states it.
    back_pressure : float
        Gauge pressure on the crank side of a double-acting piston. [Pa]
    calculated : CalculatedPressure or None
        A calculation of the working cycle instead of points and pieces.
    factor, factor_path : float and str
        Of the gauge pressure, and its path in the description. [-]
    path : str
        Of the diagram in the description.
    combustion : BurningAnalysis or None
        What the analysis of combustion from measured samples is told.
    """

    cycle: float = 720.0
    points: Mapping[str, DiagramPoint] = field(default_factory=dict)
    pieces: tuple[Piece, ...] = ()
    valves: Valves | None = None
    measured: MeasuredPressure | None = None
    angle_shift: float = 0.0
    resample: float | None = None
    delay: float = 0.0
    is_absolute: bool = False
    ambient: float = 101325.0
    names_ambient: bool = False
    back_pressure: float = 0.0
    calculated: CalculatedPressure | None = None
    factor: float = 1.0
    factor_path: str = ""
    path: str = "gas"
    combustion: BurningAnalysis | None = None


@dataclass(frozen=True)
class Engine:
    """Everything that an engine of several cylinders has besides one crank mechanism.

    Parameters
    ----------
    layout : Layout
        Positions and firing angles of the cylinders.
    slaves : tuple of ArticulatedRod or None
        The articulated rod of each cylinder, None where the rod turns on the crankpin; empty if none is articulated.
    slave_rod : CrankGearMasses or None
        Masses of an articulated rod at piston pin and knuckle pin; by default those of the master rod.
    offsets : tuple of float
        Of each cylinder axis from the crankshaft axis, by number, positive towards the crankpin at 90 degrees; empty
        if all have that of the crank mechanism. [m]
    gases : tuple of Gas
        The gas of each cylinder by number, one object for equal gas; empty if all have that of the crank mechanism.
    misfires : tuple of int
        Numbers of the cylinders without combustion.
    bearings : Bearings
        Sizes of the bearings.
    counterweight : float
        Mass moment opposite each throw. [kg m]
    rotating_share, reciprocating_share : float
        Shares of the masses that counterweights balance, beyond `counterweight`. [-]
    balance_shafts : tuple of int
        Orders that pairs of balance shafts balance.
    notices : tuple of (str, mapping)
        Notices about the layout: code and values.
    """

    layout: Layout
    articulated_rods: tuple[ArticulatedRod | None, ...] = ()
    articulated_masses: CrankGearMasses | None = None
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
    """Motor, flywheel and efficiency on the crank.

    Parameters
    ----------
    efficiency : float
        Of the joints between motor and process, as the calculation uses it. [-]
    exact_efficiency : float or None
        Before rounding by a document. [-]
    inertia : float
        Moment of inertia on the crank, including a given flywheel. [kg m2]
    motor : GearedMotor or None
        The motor with its gear to the crank.
    rated_power : float
        Of the motor. [W]
    fluctuation : float or None
        Required fluctuation of the speed, for which a flywheel is sized. [-]
    chain : tuple or None
        The given efficiencies that give the total; those of an inner tuple are in parallel.
    wheel : Wheel or None
        Further data of the flywheel, given or to be sized.
    losses : str
        What the efficiency stands for: all losses of the `machine`, friction too, or those of the `drive` between motor
        and crank; empty where the description states no friction.
    selection : MotorSelection or None
        What a motor is selected with where none is given.
    """

    efficiency: float = 1.0
    exact_efficiency: float | None = None
    inertia: float = 0.0
    motor: GearedMotor | None = None
    rated_power: float = 0.0
    fluctuation: float | None = None
    chain: Chain | None = None
    wheel: FlywheelSpec | None = None
    losses: Literal["", "drive", "machine"] = ""
    selection: MotorSelection | None = None


@dataclass(frozen=True)
class Transient:
    """Settings of a transient simulation: initial state, drive besides the loads, and end.

    Parameters
    ----------
    time : float
        Longest duration. [s]
    torque : float
        Constant torque on the crank. [N m]
    speed, start : float
        Initial speed and angle of the crank. [rad/s], [rad]
    motor : bool
        Whether the motor drives.
    until : str
        End at `time`, or earlier at the first `rest` or in the `steady` cycle.
    step : float or None
        Of the table. [s]
    stops : tuple of float
        Crank angles of stops, infinite without a stop. [rad]
    restitution : float
        Ratio of the speeds after and before a stop. [-]
    speeds : tuple of float
        Speeds whose first time is reported. [rad/s]
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
    """Tabulated transfer functions instead of a mechanism.

    Parameters
    ----------
    angles : tuple of float
        Crank angles of the positions. [rad]
    bodies : tuple of TabulatedBody
        Moving masses and their transfer functions at the positions.
    reduced_inertia_1 : tuple of float or None
        Derivative of the reduced inertia, if tabulated. [kg m2]
    differences : str
        Method of differentiation if it is not tabulated.
    static_torque, balancing_torque : tuple of float or None
        Torque that balances the loads, and torque that balances loads and inertia. [N m]
    of_bodies, of_crank : str
        Paths in the description of the bodies, and of what is reduced to the crank.
    """

    angles: tuple[float, ...]
    bodies: tuple[TabulatedBody, ...]
    reduced_inertia_1: tuple[float, ...] | None = None
    differences: Differences = "central"
    static_torque: tuple[float, ...] | None = None
    balancing_torque: tuple[float, ...] | None = None
    of_bodies: str = "transfer.bodies"
    of_crank: str = "transfer"


@dataclass(frozen=True)
class Machine:
    """One machine, in SI units; the analysis depends on the fields that are given.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism; a crank only if transfer functions are given instead.
    speed, angular_acceleration : float
        Of the crank. [rad/s], [rad/s2]
    title : str
        Name of the machine.
    document : Document
        Title data of its note and sheets.
    deviations : mapping of str to float
        Standard deviations stated in the file, by key; a third of a stated tolerance. [SI]
    tolerances : mapping of str to float
        Tolerances stated in the file, the largest distance to either side, by key. [SI]
    digest : str
        SHA-256 of the machine file and its overrides; empty for a machine made without a file.
    units : str
        System of units of its tables, figures and notes: `metric`, `si` or `imperial`; results are in SI.
    linkage : Linkage or None
        The linkage as described, for its structure; None for a crank mechanism, which is given by its lengths.
    transfer : TransferTable or None
        Transfer functions instead of a mechanism.
    turning : Turning or None
        The torques on a shaft, instead of a mechanism.
    cylinder, masses, gas : optional
        Data of a crank mechanism besides its motion.
    has_gravity : bool
        Whether its weights count; those of a linkage are loads.
    loads : tuple of Load
        Loads of a linkage.
    redundant : tuple of RedundantLink
        Redundant links that fit, with their shares of the load; not in `linkage`.
    friction : tuple of Friction
        Friction in pins and guides of a linkage.
    bearings : Bearings
        Sizes of the bearings of a linkage, by its pins or by their kinds; those of an engine are among its data.
    chambers, charges : mapping of str to Chamber and to Charge
        The gas between sliding pieces of a linkage, and the gas sealed in several chambers, by name.
    shaft : Shaft or None
        The crankshaft of a linkage of crank, rods and pistons, if more of it is known than the linkage shows.
    stages : Stages or None
        The stages of a compressor, with a linkage whose chambers they are, or instead of a mechanism.
    crossheads : mapping of str to float
        Masses of crossheads, by the pieces of a linkage of whose masses they are a part. [kg]
    vessels : mapping of str to Vessel
        Vessels that even the flow of the chambers of a pump, by name.
    drive : Drive
        Motor, flywheel and efficiency on the crank.
    transient : Transient or None
        Settings of a transient simulation.
    method : Method
        The default method of calculation.
    table_step, table_special : float and tuple of float
        Step of the tables and further angles. [deg]
    working_range : tuple of float or None
        Crank angles between which largest values count, of a crank that does not turn fully. [deg]
    engine : Engine or None
        The engine of which this crank mechanism is a cylinder.
    notices : tuple of (str, mapping)
        Notices about the description of a linkage: code and values.
    test : mapping of str to tuple of float or None
        What a test bed measured, by key of its table; several numbers where one cylinder is cut out. [SI]
    torsion : TorsionModel or None
        The torsional system of the shaft.
    """

    mechanism: Mechanism
    speed: float
    angular_acceleration: float = 0.0
    title: str = ""
    document: Document = Document()
    units: System = "metric"
    digest: str = field(default="", compare=False)
    deviations: Mapping[str, float] = field(default_factory=dict, compare=False)
    tolerances: Mapping[str, float] = field(default_factory=dict, compare=False)
    linkage: Linkage | None = None
    transfer: TransferTable | None = None
    turning: ShaftTorques | None = None
    cylinder: Cylinder | None = None
    masses: CrankGearMasses | None = None
    gas: Gas | None = None
    has_gravity: bool = False
    loads: tuple[Load, ...] = ()
    redundant: tuple[RedundantLink, ...] = ()
    friction: tuple[Friction, ...] = ()
    bearings: Bearings = field(default_factory=Bearings)
    chambers: Mapping[str, Chamber] = field(default_factory=dict)
    charges: Mapping[str, Charge] = field(default_factory=dict)
    shaft: Shaft | None = None
    drive: Drive = Drive()
    transient: Transient | None = None
    method: Method = EXACT
    table_step: float = 10.0
    table_special: tuple[float, ...] = ()
    working_range: tuple[float, float] | None = None
    engine: Engine | None = None
    notices: tuple[tuple[str, Mapping[str, float | str]], ...] = ()
    # How many masses replace the rod with the same inertia, `two masses` or `three masses`
    rod_equivalent: str = ""
    # Points of a linkage, the extents of whose paths are told
    extents: tuple[str, ...] = ()
    # Masses on a shaft in given planes, instead of a mechanism
    rotor: Rotor | None = None
    # Crank range, if the description determined it
    way: CrankRange | None = field(default=None, compare=False, repr=False)
    # The linkage that an engine is, or the engine that a linkage with friction was written as
    other_form: Callable[[Machine], Machine | None] | None = field(default=None, compare=False, repr=False)
    # The numbers of the description by path, `crank.stroke`; empty without a description
    stated: Mapping[str, InputNumber] = field(default_factory=dict, compare=False, repr=False)
    # What the description states and what it leaves to defaults; None without a description
    inputs: Callable[[], FileInputs] | None = field(default=None, compare=False, repr=False)
    stages: Stages | None = None
    crossheads: Mapping[str, float] = field(default_factory=dict)
    vessels: Mapping[str, Vessel] = field(default_factory=dict)
    test: Mapping[str, tuple[float, ...]] | None = None
    # The torsional system of its shaft
    torsion: TorsionModel | None = None
    # What is even all over the faces of a friction clutch, `uniform wear` or `uniform pressure`; its numbers are stated
    clutch: str | None = None

    @property
    def lengths(self) -> SliderCrank | None:
        """The lengths of crank and rod, unless a linkage or a table gives the motion. [m]"""
        return as_slider_crank(self.mechanism) if self.linkage is None and self.transfer is None else None

    @property
    def moves(self) -> bool:
        """Whether there is a mechanism to be drawn."""
        return self.linkage is not None or self.lengths is not None

    @property
    def alone(self) -> str:
        """What is calculated without a mechanism: torsion, turning, rotor, stages, test or clutch; empty with one."""
        if self.moves or self.transfer is not None:
            return ""
        if self.turning is not None:
            return "turning" if self.turning.diagrams else "torsion"
        return next((name for name in ("rotor", "stages", "test", "clutch") if getattr(self, name) is not None), "")

    @property
    def inclination(self) -> float:
        """Angle from the upward vertical to the head of cylinder 1, stated or that of an upright layout. [rad]"""
        if self.cylinder is not None and self.cylinder.inclination is not None:
            return self.cylinder.inclination
        return math.radians(self.engine.layout.places[0].axis) if self.engine is not None else 0.0

    def __post_init__(self) -> None:
        """Raise for values that a machine file could not state either."""
        is_timed = self.mechanism.driver.law is not None
        limits: dict[str, tuple[object, float]] = {
            "speed": (self.speed, 0.0 if is_timed else sys.float_info.min),
            "angular_acceleration": (self.angular_acceleration, -math.inf),
            "table_step": (self.table_step, sys.float_info.min),
        }
        for number, part in enumerate((self.mechanism.driver, *self.mechanism.dyads)):
            place = f"{type(part).__name__}[{number}]"
            limits |= {f"{place}.{name}": (value, 0.0) for name, value in vars(part).items() if name in _LENGTHS}
        for name, (value, low) in limits.items():
            if not isinstance(value, Real) or not math.isfinite(value) or value < low:
                kind = "object_number" if low < 0 else "object_positive"
                raise CrankworkError(ErrorMessage(kind, name=name, value=str(value)[:40]))
        for load in self.loads:
            if not hasattr(load, "forces") and not type(load).__module__.startswith("crankwork.loads."):
                raise CrankworkError(ErrorMessage("object_load", value=type(load).__name__))

    def driven_by(self, law: Law) -> Machine:
        """Return the machine with another law of its driver, whose segments may have a `MotionLaw` of the user."""
        driver = self.mechanism.driver
        if driver.law is None or self.linkage is None:
            raise CrankworkError(ErrorMessage("law_unasked"))
        changed = replace(driver, law=law)
        return replace(
            self,
            mechanism=replace(self.mechanism, driver=changed),
            linkage=replace(self.linkage, driver=changed),
            way=None,
        )

    @property
    def drawn(self) -> Linkage:
        """The linkage as described; TypeError if the machine is not a linkage."""
        if self.linkage is None:
            raise TypeError("this machine was not drawn as a linkage")
        return self.linkage

    @property
    def whole(self) -> Linkage:
        """The linkage as described, including redundant links."""
        extra = tuple(link.member for link in self.redundant)
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
        stated = self.shaft.period if self.shaft is not None and self.shaft.period is not None else _TURN
        return least_common(max(cycle_of(self.chambers), stated), self.mechanism.period)
