"""Machines that are linkages, and those whose motion is a table of transfer functions, all in SI."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from crankwork.dynamics.efficiency import Series
from crankwork.dynamics.tabulated import Differences, TabulatedBody
from crankwork.loads.load import Load
from crankwork.machine import Machine, Stated
from crankwork.mechanism.linkage import Linkage
from crankwork.mechanism.mechanism import Mechanism
from crankwork.method import EXACT, Method
from crankwork.shaft.motor import GearedMotor


@dataclass(frozen=True)
class Drive:
    """What drives the crank of a linkage.

    Parameters
    ----------
    efficiency : float
        Of the joints between motor and process, as the calculation uses it. [-]
    exact_efficiency : float or None
        Before a document rounded it. [-]
    inertia : float
        Moment of inertia that turns with the crank. [kg m2]
    motor : GearedMotor or None
        The motor, as the crank feels it.
    rated_power : float
        Of the motor. [W]
    fluctuation : float or None
        Wanted fluctuation of the speed, for which a flywheel is to be found. [-]
    chain : Series or None
        The efficiencies that make up the whole, as they are given.
    """

    efficiency: float = 1.0
    exact_efficiency: float | None = None
    inertia: float = 0.0
    motor: GearedMotor | None = None
    rated_power: float = 0.0
    fluctuation: float | None = None
    chain: Series | None = None


@dataclass(frozen=True)
class Transient:
    """Motion from a crank angle of zero under a constant torque. [N m], [s], [rad/s]"""

    torque: float
    time: float
    speed: float = 0.0


@dataclass(frozen=True)
class LinkageMachine:
    """A machine that is a planar linkage, all in SI.

    Parameters
    ----------
    mechanism : Mechanism
        What moves, as it is solved.
    linkage : Linkage
        The same as it was described, for its structure.
    speed, angular_acceleration : float
        Of the crank. [rad/s], [rad/s2]
    title : str
        What the owner calls it.
    loads : tuple of Load
        What pushes it.
    drive : Drive
        What drives it.
    transient : Transient or None
        A start to be followed.
    method : Method
        Constants; the motion is exact.
    table_step, table_special : float and tuple of float
        Step of the tables and further angles. [deg]
    """

    mechanism: Mechanism
    linkage: Linkage
    speed: float
    angular_acceleration: float = 0.0
    title: str = ""
    loads: tuple[Load, ...] = ()
    drive: Drive = Drive()
    transient: Transient | None = None
    method: Method = EXACT
    table_step: float = 10.0
    table_special: tuple[float, ...] = ()
    # The numbers of the description by their paths: `crank.speed`; a machine may be made without one
    stated: Mapping[str, Stated] = field(default_factory=dict, compare=False, repr=False)

    @property
    def cycle(self) -> float:
        """Crank angle after which everything repeats. [deg]"""
        return 360.0


@dataclass(frozen=True)
class TabulatedMachine:
    """A machine whose motion is a table of transfer functions, as a document prints them, all in SI.

    Parameters
    ----------
    speed : float
        Of the crank. [rad/s]
    angles : tuple of float
        Crank angles of the positions. [rad]
    bodies : tuple of TabulatedBody
        Moving masses and their transfer functions at the positions.
    title : str
        What the owner calls it.
    reduced_inertia_1 : tuple of float or None
        Derivative of the reduced inertia, where the document prints its own. [kg m2]
    differences : str
        How it is taken otherwise.
    static_torque, balancing_torque : tuple of float or None
        Torque that balances the loads, or that and the dynamic torque together. [N m]
    drive : Drive
        What drives it.
    method : Method
        Constants.
    """

    speed: float
    angles: tuple[float, ...]
    bodies: tuple[TabulatedBody, ...]
    title: str = ""
    reduced_inertia_1: tuple[float, ...] | None = None
    differences: Differences = "central"
    static_torque: tuple[float, ...] | None = None
    balancing_torque: tuple[float, ...] | None = None
    drive: Drive = Drive()
    method: Method = EXACT
    # The numbers of the description by their paths: `crank.speed`; a machine may be made without one
    stated: Mapping[str, Stated] = field(default_factory=dict, compare=False, repr=False)

    @property
    def cycle(self) -> float:
        """Crank angle after which everything repeats. [deg]"""
        return 360.0


AnyMachine = Machine | LinkageMachine | TabulatedMachine
