"""Firing angles, positions and sizes of the cylinders of an engine, and the work of the gas in them."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from crankwork.analysis.cylinders import MultiCylinderEngine
from crankwork.analysis.results import Listing
from crankwork.cylinders.firing import is_even
from crankwork.cylinders.torque import even_firing_interval, firing_intervals, mean_torque_of_work
from crankwork.formula.traced_value import ProcedureValue, TracedValue, given, total
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.loads.gas import indicated_power, mean_torque
from crankwork.loads.valves import StatedValves, inlet_flow
from crankwork.preparation import traced_inputs
from crankwork.preparation.cylinder_gas import work_of_gas
from crankwork.working_cycle.engine_size import displacement

_LISTED = ("bank_axis", "crankpin_angle", "firing_angle", "firing_interval")
_OF_ARTICULATED = ("top_dead_centre_angle", "stroke", "swept_volume")


def firing_trace(engine: MultiCylinderEngine) -> dict[str, TracedValue]:
    """Return number and volume of the cylinders, and position and firing angle of each."""
    count, layout = traced_inputs.size("engine.cylinders", float(len(engine.cylinders))), engine.layout
    values = {count.key: count}
    for place in layout.places:
        for key, degrees, path in (
            ("bank_axis", place.axis, "engine.bank_angle"),
            ("crankpin_angle", place.pin_angle, "engine.throws"),
            ("firing_angle", place.firing_angle, "engine.firing_order"),
        ):
            values[f"{key}.{place.number}"] = given(f"{key}.{place.number}", math.radians(degrees), path)
    sizes = _sizes(engine, values)
    return values | _intervals(engine, values | sizes) | sizes


def _intervals(engine: MultiCylinderEngine, values: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return the firing interval; of uneven firing that of each cylinder, up to the next.

    Where offsets differ a cylinder fires at its own top dead centre.
    """
    layout, cycle = engine.layout, traced_inputs.cycle_angle(engine.machine)
    if is_even(firing_intervals(layout)):
        return {"firing_interval": even_firing_interval(cycle, values["cylinder_count"])}
    kind = "top_dead_centre_angle" if any(place.top for place in layout.places) else "firing_angle"
    order, result = layout.firing_order, {}
    for number, following in zip(order, (*order[1:], order[0]), strict=True):
        key, fired, after = f"firing_interval.{number}", values[f"{kind}.{number}"], values[f"{kind}.{following}"]
        if after.value <= fired.value:
            after = after + cycle if after.value else cycle
        result[key] = (after - fired).named(key)
    return result


def _sizes(engine: MultiCylinderEngine, values: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return the volume of all cylinders, and stroke and dead centre of each where pistons move differently."""
    result, numbered = dict[str, TracedValue](), list(enumerate(engine.cylinders, start=1))
    if not engine.has_equal_motion:
        for number, item in numbered:
            top = (engine.layout.places[number - 1].firing_angle + item.stroke[1]) % engine.layout.cycle
            lengths = SliderCrank(*(item.trace[key] for key in ("crank_radius", "rod_length", "offset")))
            result[f"top_dead_centre_angle.{number}"] = TracedValue(
                ProcedureValue(math.radians(top), "dead_centre", lengths)
            )
            result[f"stroke.{number}"] = item.traced_stroke(lengths)
    if all(cylinder.space is not None for cylinder in engine.cylinders):
        volumes = [cylinder.trace["swept_volume"] for cylinder in engine.cylinders]
        if engine.has_equal_motion:
            result["displacement"] = displacement(volumes[0], values["cylinder_count"])
        else:
            each = {f"swept_volume.{number}": volume for number, volume in enumerate(volumes, start=1)}
            result |= each
            result["displacement"] = total("displacement", (value.named(key) for key, value in each.items()))
    return {key: value.named(key) for key, value in result.items()}


def work_trace(engine: MultiCylinderEngine, firing: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return the works of all cylinders, and their power and mean torque; empty if a cylinder has no gas."""
    works = [work_of_gas(cylinder.trace, cylinder.space) for cylinder in engine.cylinders if cylinder.space is not None]
    if len(works) < len(engine.cylinders):
        return {}
    cycle, several = traced_inputs.cycle_angle(engine.machine), len(works) > 1
    values = {f"indicated_work.{number}": work for number, work in enumerate(works, start=1)} if several else {}
    work, name = works[0].named("indicated_work"), "indicated_power"
    if several:
        work = total("indicated_work.all", (value.named(key) for key, value in values.items()))
        name = "engine_indicated_power"
    values["indicated_power"] = indicated_power(work, engine.master.trace["speed"], cycle).named(name)
    if engine.is_uniform:
        torque = mean_torque_of_work(firing["cylinder_count"], works[0].named("indicated_work"), cycle)
    else:
        each = [
            mean_torque(work, cycle).named(f"mean_torque.indicated.{number}")
            for number, work in enumerate(works, start=1)
        ]
        values |= {item.key: item for item in each}
        torque = total("mean_torque.indicated", each)
    values["mean_torque.indicated"] = torque
    return {key: value if key == "indicated_power" else value.named(key) for key, value in values.items()}


def delivery_trace(
    engine: MultiCylinderEngine, firing: Mapping[str, TracedValue], works: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    """Return the delivery of all cylinders with valves per unit of time, and the flow of one of them or of each.

    `firing` and `works`: number and work of the cylinders. Empty for a single cylinder, which has its own delivery.
    """
    gases = {number: cylinder.machine.gas for number, cylinder in enumerate(engine.cylinders, start=1)}
    valved = {number: gas.valves for number, gas in gases.items() if gas is not None and gas.valves is not None}
    if not valved or "indicated_power" not in works or len(engine.cylinders) < 2:
        return {}
    cycle = traced_inputs.cycle_angle(engine.machine)
    speed = engine.master.trace["speed"]
    flows = dict[int, TracedValue]()
    for number, valves in valved.items():
        trace = engine.cylinders[number - 1].trace
        stated = StatedValves(valves, "gas.valves")
        volume = stated.drawn(trace["clearance_volume"], trace["swept_volume"])["induced_volume"]
        flows[number] = inlet_flow(volume, speed, cycle).named(f"inlet_flow.{number}")
    stated = StatedValves(next(iter(valved.values())), "gas.valves")
    if engine.is_uniform:
        single = flows[1].named("inlet_flow.of_cylinder")
        values, flow = {single.key: single}, firing["cylinder_count"] * single
    else:
        values = {flow.key: flow for flow in flows.values()}
        flow = total("inlet_flow", values.values())
    return values | stated.passed(flow, works["indicated_power"])


def firing_listing(engine: MultiCylinderEngine, firing: Mapping[str, TracedValue]) -> Listing:
    """Return position and firing angle of each cylinder; if they differ, also stroke, dead centre and work.

    `firing`: number, volume, firing and work of the cylinders.
    """
    numbers = [place.number for place in engine.layout.places]
    columns = {"cylinder_number": np.array(numbers, dtype=float)}
    unlike = _OF_ARTICULATED if "stroke.1" in firing else ()
    if unlike or engine.engine.gases:
        unlike = (*unlike, "indicated_work")
    for kind in (*_LISTED, *unlike):
        each = [firing.get(f"{kind}.{number}", firing.get(kind)) for number in numbers]
        if all(item is not None for item in each):
            columns[kind] = np.array([item.value for item in each if item is not None])
    return Listing(columns)
