"""A machine made ready to compute by one method: lengths, speed and indicator diagram known."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np

from crankwork.cylinders.articulated import ArticulatedRod, articulated_stroke
from crankwork.dynamics.piston_forces import angular_speed
from crankwork.errors import CrankworkError
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import ProcedureValue, TracedValue
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.dead_centres import dead_centres
from crankwork.kinematics.slider_crank import SliderCrank, check_slider_crank
from crankwork.loads import gas as gas_formulas
from crankwork.loads.chamber_gas import NO_GAS, ChamberGas
from crankwork.loads.indicator import DeadCentres, IndicatorDiagram, counts_from_top, solve_diagram
from crankwork.loads.pressure_processing import PressureReference, measured_diagram
from crankwork.loads.valves import StatedValves
from crankwork.locale import ErrorMessage
from crankwork.machine import Cylinder, Gas, Machine
from crankwork.method import Method
from crankwork.preparation import traced_inputs
from crankwork.preparation.piston_kinematics import CylinderKinematics, moving_cylinder

if TYPE_CHECKING:
    from crankwork.working_cycle.calculated_cycle import Calculated


_TURN = 360.0


class Notice(NamedTuple):
    """Something the reader should know about a result: a code of `report.notices` and its values."""

    code: str
    values: Mapping[str, float | str]


class WorkingSpace(NamedTuple):
    """The cylinder as solved for one method: areas [m2], volumes [m3], pressures [Pa], work [J]."""

    gas: Gas
    cylinder: Cylinder
    area: float
    clearance: float
    swept: float
    diagram: IndicatorDiagram
    work: float
    calculated: Calculated | None = None

    @property
    def ambient(self) -> float:
        """The pressure on the crankcase side that the diagram counts in, zero for gauge pressures."""
        return self.gas.ambient if self.gas.is_absolute else 0.0

    @property
    def theoretical(self) -> IndicatorDiagram | None:
        """The diagram of a calculated cycle before its corners were rounded."""
        result = self.calculated.theoretical if self.calculated is not None else None
        return None if result is None else result()

    def gauge(self, pressure: Array) -> Array:
        """Return the gauge pressure on the piston where that of the diagram is known. [Pa]"""
        return (pressure - self.ambient) * self.gas.factor


@dataclass(frozen=True)
class PreparedMachine:
    """A machine made ready for one method: angular speed with the method's own pi. [rad/s]"""

    machine: Machine
    method: Method
    speed: float


@dataclass(frozen=True)
class PreparedLinkage(PreparedMachine):
    """A linkage made ready: the gas in its chambers known."""

    filling: ChamberGas = field(default=NO_GAS, compare=False)


@dataclass(frozen=True)
class PreparedCylinder(PreparedMachine):
    """A crank gear made ready: its lengths and its diagram known.

    `moving` is the traced motion; `slave` the articulated rod of a cylinder that hangs on the master rod; `lean`
    how far its axis is ahead of that of cylinder 1, where weights count [deg].
    """

    lengths: SliderCrank
    space: WorkingSpace | None
    moving: CylinderKinematics = field(compare=False)
    notices: tuple[Notice, ...] = ()
    articulated_rod: ArticulatedRod | None = None
    lean: float = 0.0

    def traced_stroke(self, lengths: SliderCrank) -> TracedValue:
        """Return the stroke as a traced value, of traced lengths."""
        if self.articulated_rod is not None:
            travel = TracedValue(ProcedureValue(self.stroke[0], "max", (self.moving.trace["piston_displacement"],)))
            return TracedValue(ProcedureValue(self.stroke[0], "dead_centre", lengths, argument=travel), "stroke")
        return traced_inputs.stroke(lengths)

    @property
    def begins(self) -> float:
        """The crank angle that a stated diagram counts from: its own top dead centre where offsets differ. [deg]"""
        delay = self.machine.gas.delay if self.machine.gas is not None else 0.0
        return delay + self.stroke[1] if self.counts_from_top else delay

    @property
    def counts_from_top(self) -> bool:
        """Whether each cylinder counts from its own top dead centre, because offsets differ."""
        places = self.machine.engine.layout.places if self.machine.engine is not None else ()
        return any(place.top for place in places)

    @property
    def stroke(self) -> tuple[float, float, float]:
        """Stroke [m], and the crank angles of top and bottom dead centre [deg]."""
        if self.articulated_rod is None:
            return (self.lengths.stroke, *dead_centres(self.lengths))
        result = articulated_stroke(self.lengths, self.articulated_rod)
        return result.stroke, result.top_angle, result.bottom_angle


_Cylinder = TypeVar("_Cylinder", bound=PreparedCylinder)


def prepare(machine: Machine, method: Method, kind: type[_Cylinder]) -> _Cylinder:
    """Return a machine made ready for a method.

    Lengths, angular speed and the solved indicator diagram.
    """
    lengths = machine.lengths
    if lengths is None:
        raise CrankworkError(ErrorMessage("object_mechanism"))
    check_slider_crank(lengths)
    speed = angular_speed(method.pi, machine.speed * 30 / math.pi)
    notices = []
    if method.pi != math.pi:
        notices.append(Notice("pi", {"pi": method.pi}))
    if method.inertia_rod_ratio is not None and not method.is_exact:
        notices.append(Notice("inertia_rod_ratio", {"used": method.inertia_rod_ratio, "rod_ratio": lengths.rod_ratio}))
    if machine.gas is not None and machine.gas.is_absolute and not machine.gas.names_ambient:
        notices.append(Notice("ambient", {"pressure": machine.gas.ambient / 1e6}))
    if machine.masses is not None and machine.masses.rod_inertia_excess and method.rod != "rigid":
        notices.append(Notice("no_couple", {}))
    solved = kind(machine, method, float(speed), lengths, None, moving_cylinder(machine, method, lengths))
    return _with_space(solved, notices)


def prepare_articulated(solved: _Cylinder, articulated_rod: ArticulatedRod) -> _Cylinder:
    """Return a cylinder of the same engine whose rod hangs on the master rod.

    The same machine with the stroke, dead centres and diagram of that rod.
    """
    moving = moving_cylinder(solved.machine, solved.method, solved.lengths, articulated_rod)
    return _with_space(replace(solved, articulated_rod=articulated_rod, moving=moving, space=None, notices=()), [])


def _with_space(solved: _Cylinder, notices: list[Notice]) -> _Cylinder:
    """Return a cylinder with its working space, if it has one."""
    machine, method = solved.machine, solved.method
    gas, cylinder = machine.gas, machine.cylinder
    if gas is None or cylinder is None:
        return replace(solved, notices=tuple(notices))
    area = float(gas_formulas.piston_area(method.pi, cylinder.bore))
    stroke, top, bottom = solved.stroke
    swept = float(gas_formulas.swept_volume(area, stroke))
    clearance = _clearance(cylinder, swept)

    position = Program({"": solved.moving.trace["piston_displacement"]})
    rate = Program({"": solved.moving.trace["piston_transfer_1"]})

    def volume_at(degrees: Array) -> Array:
        moved = position(CrankGrid.from_degrees(degrees))[""]
        return np.asarray(gas_formulas.cylinder_volume(clearance, area, moved))

    def volume_rate_at(degrees: Array) -> Array:
        return np.asarray(area * rate(CrankGrid.from_degrees(degrees))[""])

    calculated = None
    if gas.calculated is not None:
        calculated = gas.calculated.pressure(volume_at, volume_rate_at, (top, bottom))
        diagram = calculated.diagram
        notices += [Notice(*notice) for notice in calculated.notices]
    else:
        if gas.valves is not None:
            StatedValves(gas.valves, "gas.valves").check(clearance, swept)
        # valves open by the volume, and strokes begin, wherever the dead centre is
        is_from_top = gas.valves is not None or counts_from_top(gas.points, gas.pieces)
        begins = top + _TURN * round((gas.delay - top) / _TURN) if is_from_top else solved.begins
        ends = ((top - begins) % _TURN, (bottom - begins) % _TURN) if begins else (top, bottom)
        diagram = _given_diagram(gas, lambda degrees: volume_at(degrees + begins), ends, notices).later(begins)
        notices += [Notice("jump", {"point": name, "angle": phi, "step": step}) for name, phi, step in diagram.jumps]
    work = gas.factor * diagram.work(volume_at)
    space = WorkingSpace(gas, cylinder, area, clearance, swept, diagram, work, calculated)
    return replace(solved, space=space, notices=tuple(notices))


def _given_diagram(
    gas: Gas, volume_at: Callable[[Array], Array], centres: tuple[float, float], notices: list[Notice]
) -> IndicatorDiagram:
    """Return the diagram that the description or a measurement gives, over the angles that it counts.

    `volume_at` and `centres`: volume and dead centres by these angles. [deg]
    """
    if gas.measured is not None:
        around = PressureReference(volume_at, centres[0], has_strokes=not gas.path.startswith("chambers"))
        diagram, messages = measured_diagram(
            gas.measured, gas.cycle, around, shift=gas.angle_shift, step=gas.resample, path=gas.path
        )
        notices += [Notice(*item) for item in messages]
        return diagram
    if gas.valves is not None:
        valves = StatedValves(gas.valves, "gas.valves")
        return valves.solved(gas.points, gas.pieces, volume_at, DeadCentres(centres), "cylinder.clearance_volume")
    return solve_diagram(gas.points, gas.pieces, gas.cycle, volume_at, dead_centres=centres, path=gas.path)


def _clearance(cylinder: Cylinder, swept: float) -> float:
    if cylinder.clearance_volume is not None:
        return cylinder.clearance_volume
    if cylinder.compression_ratio is None:
        return 0.0
    return float(gas_formulas.clearance_volume(swept, cylinder.compression_ratio))


def relative_difference(values: Array, other: Array, size: float = 0.0) -> float:
    """Return how far two columns are apart, as a share of the largest value of the first, or of a size above it."""
    scale = max(float(np.max(np.abs(values))), size)
    return float(np.max(np.abs(values - other))) / scale if scale else 0.0
