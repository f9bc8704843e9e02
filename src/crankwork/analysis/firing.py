"""When the cylinders of an engine fire, where they stand, how large they are, and what the gas does in them."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from crankwork.analysis import traced_inputs
from crankwork.analysis.cylinder_gas import work_of_gas
from crankwork.analysis.cylinders import MultiCylinderEngine
from crankwork.analysis.results import Listing
from crankwork.cylinders.firing import is_even
from crankwork.cylinders.torque import even_firing_interval, firing_intervals, mean_torque_of_work
from crankwork.formula.traced_value import ProcedureValue, TracedValue, given, total
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.loads.gas import indicated_power, mean_torque
from crankwork.loads.valves import StatedValves, inlet_flow
from crankwork.working_cycle.engine_size import displacement

_LISTED = ("bank_axis", "crankpin_angle", "firing_angle", "firing_interval")
_OF_SLAVES = ("top_dead_centre_angle", "stroke", "swept_volume")


def firing_trace(whole: MultiCylinderEngine) -> dict[str, TracedValue]:
    """Return number and volume of the cylinders, where each stands and when it fires."""
    count, layout = given("cylinder_count", float(len(whole.cylinders)), "engine.cylinders"), whole.layout
    found = {count.key: count}
    for place in layout.places:
        for key, degrees, path in (
            ("bank_axis", place.axis, "engine.bank_angle"),
            ("crankpin_angle", place.pin_angle, "engine.throws"),
            ("firing_angle", place.firing_angle, "engine.firing_order"),
        ):
            found[f"{key}.{place.number}"] = given(f"{key}.{place.number}", math.radians(degrees), path)
    sizes = _sizes(whole, found)
    return found | _intervals(whole, found | sizes) | sizes


def _intervals(whole: MultiCylinderEngine, found: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return the firing interval; of uneven firing that of each cylinder, up to the next.

    Where offsets differ a cylinder fires at its own top dead centre.
    """
    layout, cycle = whole.layout, traced_inputs.cycle_angle(whole.machine)
    if is_even(firing_intervals(layout)):
        return {"firing_interval": even_firing_interval(cycle, found["cylinder_count"])}
    kind = "top_dead_centre_angle" if any(place.top for place in layout.places) else "firing_angle"
    order, result = layout.firing_order, {}
    for number, following in zip(order, (*order[1:], order[0]), strict=True):
        key, fired, after = f"firing_interval.{number}", found[f"{kind}.{number}"], found[f"{kind}.{following}"]
        if after.value <= fired.value:
            after = after + cycle if after.value else cycle
        result[key] = (after - fired).named(key)
    return result


def _sizes(whole: MultiCylinderEngine, found: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return the volume of all cylinders, and stroke and dead centre of each where pistons move differently."""
    result, numbered = dict[str, TracedValue](), list(enumerate(whole.cylinders, start=1))
    if not whole.moves_alike:
        for number, one in numbered:
            top = (whole.layout.places[number - 1].firing_angle + one.stroke[1]) % whole.layout.cycle
            lengths = SliderCrank(*(one.trace[key] for key in ("crank_radius", "rod_length", "offset")))
            result[f"top_dead_centre_angle.{number}"] = TracedValue(
                ProcedureValue(math.radians(top), "dead_centre", lengths)
            )
            result[f"stroke.{number}"] = one.traced_stroke(lengths)
    if all(one.space is not None for one in whole.cylinders):
        volumes = [one.trace["swept_volume"] for one in whole.cylinders]
        if whole.moves_alike:
            result["displacement"] = displacement(volumes[0], found["cylinder_count"])
        else:
            each = {f"swept_volume.{number}": one for number, one in enumerate(volumes, start=1)}
            result |= each
            result["displacement"] = total("displacement", (one.named(key) for key, one in each.items()))
    return {key: one.named(key) for key, one in result.items()}


def work_trace(whole: MultiCylinderEngine, firing: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return the works of all cylinders, and the power and the mean torque that follow; nothing without gas in each."""
    works = [work_of_gas(one, one.space) for one in whole.cylinders if one.space is not None]
    if len(works) < len(whole.cylinders):
        return {}
    cycle, several = traced_inputs.cycle_angle(whole.machine), len(works) > 1
    found = {f"indicated_work.{number}": one for number, one in enumerate(works, start=1)} if several else {}
    work, name = works[0].named("indicated_work"), "indicated_power"
    if several:
        work = total("indicated_work.all", (one.named(key) for key, one in found.items()))
        name = "engine_indicated_power"
    found["indicated_power"] = indicated_power(work, whole.master.trace["speed"], cycle).named(name)
    if whole.is_uniform:
        torque = mean_torque_of_work(firing["cylinder_count"], works[0].named("indicated_work"), cycle)
    else:
        each = [
            mean_torque(work, cycle).named(f"mean_torque.indicated.{number}")
            for number, work in enumerate(works, start=1)
        ]
        found |= {one.key: one for one in each}
        torque = total("mean_torque.indicated", each)
    found["mean_torque.indicated"] = torque
    return {key: one if key == "indicated_power" else one.named(key) for key, one in found.items()}


def delivery_trace(
    whole: MultiCylinderEngine, firing: Mapping[str, TracedValue], works: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    """Return what all cylinders with valves deliver per unit of time, after the flow of one of them or of each.

    `firing` and `works`: number and work of the cylinders. Nothing of one cylinder alone, whose delivery is its own.
    """
    gases = {number: one.machine.gas for number, one in enumerate(whole.cylinders, start=1)}
    valved = {number: gas.valves for number, gas in gases.items() if gas is not None and gas.valves is not None}
    if not valved or "indicated_power" not in works or len(whole.cylinders) < 2:
        return {}
    cycle, speed, flows = (
        traced_inputs.cycle_angle(whole.machine),
        whole.master.trace["speed"],
        dict[int, TracedValue](),
    )
    for number, valves in valved.items():
        trace = whole.cylinders[number - 1].trace
        stated = StatedValves(valves, "gas.valves")
        volume = stated.drawn(trace["clearance_volume"], trace["swept_volume"])["induced_volume"]
        flows[number] = inlet_flow(volume, speed, cycle).named(f"inlet_flow.{number}")
    stated = StatedValves(next(iter(valved.values())), "gas.valves")
    if whole.is_uniform:
        one = flows[1].named("inlet_flow.of_cylinder")
        found, flow = {one.key: one}, firing["cylinder_count"] * one
    else:
        found = {one.key: one for one in flows.values()}
        flow = total("inlet_flow", found.values())
    return found | stated.passed(flow, works["indicated_power"])


def firing_listing(whole: MultiCylinderEngine, firing: Mapping[str, TracedValue]) -> Listing:
    """Return where each cylinder stands and fires; where they differ, also stroke, dead centre and work.

    `firing`: number, volume, firing and work of the cylinders.
    """
    numbers = [one.number for one in whole.layout.places]
    columns = {"cylinder_number": np.array(numbers, dtype=float)}
    unlike = _OF_SLAVES if "stroke.1" in firing else ()
    if unlike or whole.engine.gases:
        unlike = (*unlike, "indicated_work")
    for kind in (*_LISTED, *unlike):
        each = [firing.get(f"{kind}.{number}", firing.get(kind)) for number in numbers]
        if all(one is not None for one in each):
            columns[kind] = np.array([one.value for one in each if one is not None])
    return Listing(columns)
