"""A machine made ready to compute by one method: lengths, speed and indicator diagram known."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from crankwork.dynamics.piston_forces import angular_speed
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.kinematics.extremes import dead_centres
from crankwork.kinematics.piston import as_slider_crank, piston_motion
from crankwork.kinematics.slider_crank import SliderCrank, check_slider_crank
from crankwork.loads import gas as gas_formulas
from crankwork.loads.indicator import IndicatorDiagram, solve_diagram
from crankwork.loads.measured import measured_diagram, wrap_is_rough
from crankwork.machine import Cylinder, Machine
from crankwork.method import Method


class Notice(NamedTuple):
    """Something the reader should know about a result: a code of `report.notices` and its values."""

    code: str
    values: Mapping[str, float | str]


class WorkingSpace(NamedTuple):
    """The cylinder as solved for one method: areas [m2], volumes [m3], pressures [Pa], work [J]."""

    area: float
    clearance: float
    swept: float
    diagram: IndicatorDiagram
    ambient: float
    work: float
    rod_area: float = 0.0
    back_pressure: float = 0.0


@dataclass(frozen=True)
class Solved:
    """A machine made ready for one method: lengths, speed and diagram known.

    `speed` is the angular speed with the method's own pi. [rad/s]
    """

    machine: Machine
    method: Method
    lengths: SliderCrank
    speed: float
    space: WorkingSpace | None
    notices: tuple[Notice, ...]


def solve(machine: Machine, method: Method) -> Solved:
    """Return a machine made ready for a method.

    Parameters
    ----------
    machine : Machine
        What to compute.
    method : Method
        How.

    Returns
    -------
    Solved
        Lengths, angular speed and the solved indicator diagram.

    Raises
    ------
    CrankworkError
        If the mechanism is no slider-crank, cannot turn, or the diagram does not hang together.
    """
    lengths = as_slider_crank(machine.mechanism)
    if lengths is None:
        raise CrankworkError("only a slider-crank can be analysed")
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
    space = _working_space(machine, method, lengths, notices)
    return Solved(machine, method, lengths, float(speed), space, tuple(notices))


def _working_space(
    machine: Machine, method: Method, lengths: SliderCrank, notices: list[Notice]
) -> WorkingSpace | None:
    gas, cylinder = machine.gas, machine.cylinder
    if gas is None or cylinder is None:
        return None
    area = float(gas_formulas.piston_area(method.pi, cylinder.bore))
    swept = float(gas_formulas.swept_volume(area, lengths.stroke))
    clearance = _clearance(cylinder, swept)
    ambient = gas.ambient if gas.is_absolute else 0.0

    def volume_at(degrees: Array) -> Array:
        x = piston_motion(lengths, CrankGrid.from_degrees(degrees), method).piston.position
        return np.asarray(gas_formulas.cylinder_volume(clearance, area, x))

    if gas.measured is not None:
        diagram, cycles, wrap = measured_diagram(gas.measured, gas.cycle, shift=gas.angle_shift, step=gas.resample)
        if cycles > 1:
            notices.append(Notice("cycles_averaged", {"cycles": cycles}))
        if wrap_is_rough(diagram, wrap):
            notices.append(Notice("wrap", {"step": wrap}))
    else:
        diagram = solve_diagram(gas.points, gas.pieces, gas.cycle, volume_at, dead_centres=dead_centres(lengths))
        notices += [
            Notice("jump", {"point": name, "angle": angle, "step": step}) for name, angle, step in diagram.jumps
        ]
    rod_area = float(gas_formulas.piston_area(method.pi, cylinder.piston_rod_diameter))
    work = diagram.work(volume_at)
    return WorkingSpace(area, clearance, swept, diagram, ambient, work, rod_area, gas.back_pressure)


def _clearance(cylinder: Cylinder, swept: float) -> float:
    if cylinder.clearance_volume is not None:
        return cylinder.clearance_volume
    if cylinder.compression_ratio is None:
        raise CrankworkError("gas needs cylinder.clearance_volume or cylinder.compression_ratio")
    return float(gas_formulas.clearance_volume(swept, cylinder.compression_ratio))
