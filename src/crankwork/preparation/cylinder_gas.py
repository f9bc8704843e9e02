"""The pressure in a cylinder and its force on the piston, traced."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import TypeVar

from crankwork.formula.expression import Value
from crankwork.formula.traced_value import ProcedureValue, TracedValue, absent, delayed, given, reached
from crankwork.kinematics.slider_crank import top_dead_centre_angle
from crankwork.loads import gas
from crankwork.loads.traced_diagram import DiagramInput, at_angle, polytrope_origin, pressure_on_piston, traced_pressure
from crankwork.loads.valves import StatedValves
from crankwork.preparation import traced_inputs
from crankwork.preparation.piston_kinematics import CylinderKinematics
from crankwork.preparation.prepared import PreparedCylinder, WorkingSpace

_Value = TypeVar("_Value")
# inputs and checks of a cycle, which other keys of a summary also show
_NOT_SHOWN = ("first_law_residual", "rotational_speed")


def space_trace(solved: PreparedCylinder, moving: CylinderKinematics) -> dict[str, TracedValue]:
    """Return areas and volumes of the cylinder, as far as they are known (kolchin_demidov_2008, ch. 5)."""
    cylinder, space = solved.machine.cylinder, solved.space
    if cylinder is None:
        return {}
    bore = traced_inputs.bore(solved.machine, cylinder.bore)
    area = gas.piston_area(solved.method.pi, bore)
    values = [bore, area]
    if space is not None:
        stroke = solved.traced_stroke(moving.lengths)
        swept = gas.swept_volume(area, stroke)
        values += [stroke, swept]
        if not space.clearance:
            values.append(absent("clearance_volume"))
        elif cylinder.compression_ratio is not None and cylinder.clearance_volume is None:
            ratio = given("compression_ratio", cylinder.compression_ratio, "cylinder.compression_ratio")
            clearance = gas.clearance_volume(swept, ratio)
            values += [clearance, gas.compression_ratio(swept, clearance)]
        else:
            clearance = given("clearance_volume", space.clearance, "cylinder.clearance_volume")
            values += [clearance, gas.compression_ratio(swept, clearance)]
    return {item.key: item for item in values}


def gas_trace(solved: PreparedCylinder, space: WorkingSpace, moving: CylinderKinematics) -> dict[str, TracedValue]:
    """Return volume, pressure and force of the gas (kolchin_demidov_2008, ch. 5 and 7).

    `moving`: the motion, with areas and volumes in its trace.
    """
    trace = moving.trace
    area = trace["piston_area"]
    volume = gas.cylinder_volume(trace["clearance_volume"], area, trace["piston_displacement"])
    of_cycle = traced_pressure(space.diagram, volume, space.gas.path, _general_form(solved, space, trace, volume))
    read, stated_gas = of_cycle, space.gas
    if stated_gas.calculated is not None:
        # a calculated cycle begins at 0, whole turns earlier than its chamber
        read = delayed(of_cycle, stated_gas.delay, stated_gas.cycle, of_cycle.key)
    ambient = "gas.ambient" if stated_gas.calculated is None else "cycle.ambient_pressure"
    pressure = pressure_on_piston(read, (space.ambient, ambient), (stated_gas.factor, stated_gas.factor_path))
    back, rod_area = absent(""), absent("")
    if rod := space.cylinder.piston_rod_diameter:
        diameter = given("piston_rod_diameter", rod, "cylinder.piston_rod_diameter")
        rod_area = gas.piston_area(solved.method.pi, diameter).named("piston_area.rod")
        back = given("back_pressure", stated_gas.back_pressure, "gas.back_pressure")
    force = gas.gas_force(pressure, area, back, rod_area)
    values = {item.key: item for item in (volume, read, pressure, force)} | _ends_of_polytropes(space, volume)
    return values | _filling(space, (of_cycle, volume), _dead_centres(solved, trace))


def _filling(
    space: WorkingSpace, columns: tuple[TracedValue, TracedValue], dead_centres: tuple[Value, Value]
) -> dict[str, TracedValue]:
    """Return the filling factor of a rounded diagram."""
    key = "filling_factor.diagram"
    if space.calculated is None or key not in space.calculated.trace:
        return {}
    filling = getattr(space.gas.calculated, "filling_factor", None)
    return {} if filling is None else {key: filling(space.calculated.trace[key].value, columns, dead_centres)}


def _general_form(
    solved: PreparedCylinder, space: WorkingSpace, trace: Mapping[str, TracedValue], volume: TracedValue
) -> Callable[[], TracedValue] | DiagramInput | None:
    """Return the general form of the pressure in traced inputs, or its input, if there are formulas for it."""
    given_gas = space.gas
    if given_gas.measured is not None:
        return None
    if given_gas.calculated is not None:
        traced = given_gas.calculated.traced
        return None if traced is None else partial(traced, volume, _dead_centres(solved, trace))
    size = trace["clearance_volume"], trace["swept_volume"]
    valves = None if given_gas.valves is None else StatedValves(given_gas.valves, "gas.valves")
    return DiagramInput(
        given_gas.points, given_gas.pieces, given_gas.path, volume, *size, valves, _begins(solved, given_gas.delay)
    )


def _dead_centres(solved: PreparedCylinder, trace: Mapping[str, TracedValue]) -> tuple[Value, Value]:
    """Return the crank angles of top and bottom dead centre, traced where they depend on lengths. [deg]"""
    rate = trace.get("piston_transfer_1")
    top, bottom = (angle if rate is None or not angle % 180.0 else reached(rate, angle) for angle in solved.stroke[1:])
    return top, bottom


def _begins(solved: PreparedCylinder, delay: float) -> Value:
    """Return the crank angle that the points of a diagram count from, traced where it depends on lengths. [deg]"""
    if not (solved.counts_from_top and solved.stroke[1]):
        return delay
    r, l, e = solved.moving.lengths  # noqa: E741
    top = top_dead_centre_angle(e, l, r) * (180 / math.pi)
    return top + delay if delay else top


def gas_of_cylinder(solved: PreparedCylinder) -> dict[str, TracedValue]:
    """Return motion, areas, volumes and gas of a cylinder by key, as far as they are known."""
    moving = solved.moving._replace(trace=dict(solved.moving.trace))
    moving.trace.update(space_trace(solved, moving))
    if solved.space is not None:
        moving.trace.update(gas_trace(solved, solved.space, moving))
    return moving.trace


def work_of_gas(trace: Mapping[str, TracedValue], space: WorkingSpace) -> TracedValue:
    """Return the work that the gas does in a cycle: the area of the diagram."""
    pressure = trace["diagram_pressure" if space.gas.factor == 1 else "gas_pressure"]
    return TracedValue(ProcedureValue(space.work, "work", (pressure, trace["cylinder_volume"])), "indicated_work")


def indicated_values(
    trace: Mapping[str, TracedValue], space: WorkingSpace, cycle: TracedValue
) -> dict[str, TracedValue]:
    """Return the indicated work of a cylinder, its mean pressure and its power; `cycle`: its angle [rad]."""
    work = work_of_gas(trace, space)
    return {
        "indicated_work": work,
        "indicated_mean_pressure": gas.indicated_mean_pressure(work, trace["swept_volume"]),
        "indicated_power": gas.indicated_power(work, trace["speed"], cycle),
    }


def _ends_of_polytropes(space: WorkingSpace, volume: TracedValue) -> dict[str, TracedValue]:
    """Return volume and pressure at the ends of each polytrope of a diagram that was given by its points."""
    given_gas, values = space.gas, dict[str, TracedValue]()
    if given_gas.measured is not None or given_gas.calculated is not None:
        return values
    for segment in space.diagram.segments:
        if segment.law != "polytropic" or not segment.origin:
            continue
        p_1, V_1, exponent = polytrope_origin(space.diagram, segment, volume, given_gas.path)
        values |= {p_1.key: p_1, V_1.key: V_1}
        for name, (degrees, _) in space.diagram.named.items():
            if name != segment.origin and degrees in (segment.start, segment.end):
                V = at_angle(volume, degrees, f"cylinder_volume.{name}")
                end = gas.polytropic_pressure(p_1, V_1, V, exponent).named(f"diagram_pressure.{name}")
                values |= {V.key: V, end.key: end}
    return values


def cycle_values(values: Mapping[str, _Value]) -> dict[str, _Value]:
    """Return the single values of a calculated cycle that the rest of a summary does not show."""
    own = {"indicated_work", "indicated_mean_pressure", "piston_area", "swept_volume", "bore", "stroke"}
    shown = {key: value for key, value in values.items() if key not in _NOT_SHOWN}
    return {f"{key}.cycle" if key in own else key: value for key, value in shown.items()}
