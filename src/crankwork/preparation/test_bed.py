"""What follows from a test of an engine: from what was measured, and from sizes and diagram, if they are known."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import reduce
from operator import add

from crankwork.dynamics.piston_forces import angular_speed
from crankwork.formula.calculation import Calculation
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.traced_value import Input, ProcedureValue, TracedValue, given, in_order, total
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.loads.gas import piston_area
from crankwork.loads.indicator import DiagramError
from crankwork.loads.measured_pressure import AMBIENT
from crankwork.locale import ErrorMessage
from crankwork.machine import Machine
from crankwork.mechanism.mechanism import Crank
from crankwork.preparation import traced_inputs
from crankwork.preparation.cylinder_gas import gas_of_cylinder, indicated_values
from crankwork.preparation.prepared import PreparedCylinder, WorkingSpace
from crankwork.units import UNITS
from crankwork.working_cycle.test_bed import MEASURED, contradictions, missing, willans_loss, work_test

# what an engine gives to the analysis of its test
_OF_ENGINE = ("bore", "stroke", "indicated_power", "indicated_mean_pressure")
# keys of a file that state what a test needs of its engine
_STATED = {
    **{quantity: f"test.{key}" for key, quantity in MEASURED.items()},
    "bore": "cylinder.bore", "stroke": "crank.stroke", "speed": "crank.speed", "displacement": "cylinder.displacement",
    "piston_area": "cylinder.bore", "swept_volume": "cylinder.bore", "mean_piston_speed": "crank.stroke",
    "working_cycle_rate": "crank.speed", "charge_density": "test.air_pressure",
    "mechanical_loss_pressure": "test.mechanical_loss_constant", "heat_supplied": "test.fuel_heating_value",
}  # fmt: skip
# what a brake shows, by the dimension in which it is stated
_SHOWN = {"force": "brake_load", "torque": "effective_torque", "power": "effective_power"}
# keys that say how the engine is built, not what was measured
_BUILT, _MEASURED = ("test.cylinders", "test.strokes"), ("test.", "cylinder.displacement")
_RATIO = "test.mechanical_efficiency"
_LISTS = ("one_cut", "load_powers", "load_fuel_rates")


def worked_alone(machine: Machine) -> dict[str, TracedValue]:
    """Return what follows from a test of an engine of which only sizes are known (heywood_1988, ch. 2 and 13)."""
    sizes = dict[str, TracedValue]()
    cylinder, driver = machine.cylinder, machine.mechanism.driver
    if cylinder is not None and cylinder.bore:
        sizes["bore"] = given("bore", cylinder.bore, "cylinder.bore")
    if isinstance(driver, Crank) and driver.radius:
        sizes["stroke"] = given("stroke", 2 * driver.radius, "crank.stroke")
    if "crank.speed" in machine.stated:
        sizes |= {value.key: value for value in _speeds(machine)}
    return _worked(machine, sizes)


def check_test(machine: Machine, cylinders: Sequence[PreparedCylinder]) -> None:
    """Raise DiagramError for the test of an engine if its measurements contradict each other or the engine."""
    first, traces = cylinders[0], [gas_of_cylinder(cylinder) for cylinder in cylinders]
    trace, known = traces[0], {"stroke": traced_inputs.stroke(first.moving.lengths)}
    if machine.cylinder is not None:
        known["bore"] = trace["bore"]
    if first.space is not None:
        spaces = (cylinder.space or first.space for cylinder in cylinders)
        cycle = traced_inputs.cycle_angle(machine)
        works = [indicated_values(*item, cycle) for item in zip(traces, spaces, strict=True)]
        known |= works[0]
        known["indicated_power"] = total("", [values["indicated_power"] for values in works])
        over = CycleInterpolant({"": trace["gas_pressure"]}, CrankGrid.from_degrees, machine.cycle)
        known["gas_pressure_max"] = over.extremes("")["_max"]
    worked_with_engine(machine, known, first.space)


def worked_with_engine(
    machine: Machine, known: Mapping[str, TracedValue], space: WorkingSpace | None
) -> dict[str, TracedValue]:
    """Return what follows from the test of an engine.

    `known`: what is known of the engine: bore, stroke, indicated power and mean pressure, largest pressure of the gas.
    """
    own = {key: known[key].named(key) for key in _OF_ENGINE if key in known}
    if machine.engine is not None:
        own["cylinder_count"] = given("cylinder_count", float(len(machine.engine.layout.places)), "engine.cylinders")
    elif machine.gas is not None:
        own["cylinder_count"] = given("cylinder_count", 1.0)
    own |= {value.key: value for value in _speeds(machine)}
    if space is not None:
        # losses follow the absolute pressure
        peak = known["gas_pressure_max"]
        node = ProcedureValue(peak.value + (space.ambient or AMBIENT), "max", peak.node.operands)
        own["cylinder_pressure"] = TracedValue(node, "cylinder_pressure")
    if machine.gas is not None or machine.engine is not None:
        own["strokes_per_cycle"] = given("strokes_per_cycle", round(machine.cycle / 180), "gas.cycle")
    return _worked(machine, own)


def _worked(machine: Machine, sizes: Mapping[str, TracedValue]) -> dict[str, TracedValue]:
    """Return what follows from a test and the sizes of an engine."""
    worked, test, pi = Calculation(), machine.test or {}, machine.method.pi
    worked.known |= sizes
    for key, numbers in test.items():
        quantity = MEASURED.get(key, key)
        if key not in _LISTS:
            path = f"cylinder.{key}" if key == "displacement" else f"test.{key}"
            if quantity in sizes and sizes[quantity].value != numbers[0]:
                raise DiagramError(path, ErrorMessage("test_of_engine"))
            worked.given(quantity, numbers[0], path)
    worked.known.setdefault("cylinder_count", given("cylinder_count", 1.0))
    if "charge_pressure" in worked.known:
        # dry air
        worked.given("specific_gas_constant", 287.0)
    cylinder = machine.cylinder
    if cylinder is not None and cylinder.piston_rod_diameter:
        rod = given("piston_rod_diameter", cylinder.piston_rod_diameter, "cylinder.piston_rod_diameter")
        worked.keep(piston_area(pi, rod).named("rod_area"))
    elif "crank_side_pressure" in worked.known:
        worked.absent("rod_area")
    if cut := test.get("one_cut"):
        worked.known |= _cut_powers(machine, worked, cut, pi)
    work_test(worked, pi)
    if test.get("load_powers"):
        _draw_willans_line(worked, test)
        work_test(worked, pi)
    _check(machine, worked, pi)
    stated = {key: value for key, value in worked.known.items() if key in sizes or not value.is_absent}
    results = {key: value for key, value in worked.found.items() if key not in sizes}
    # in revolutions per minute, as one formula takes it
    return {key: value for key, value in {**stated, **results}.items() if key != "rotational_speed"}


def _speeds(machine: Machine) -> tuple[TracedValue, TracedValue]:
    """Return revolutions per minute and angular speed of the shaft."""
    n = given("rotational_speed", machine.speed * 30 / math.pi, "crank.speed", "rpm")
    speed: TracedValue = angular_speed(machine.method.pi, n)
    return n, speed.named("speed")


def _cut_powers(machine: Machine, worked: Calculation, cut: tuple[float, ...], pi: float) -> dict[str, TracedValue]:
    """Return the sum of the brake powers with each cylinder cut out."""
    count = round(worked["cylinder_count"].value)
    if machine.engine is None and "test.cylinders" not in machine.stated:
        raise DiagramError("test.cylinders", ErrorMessage("missing", advice=(f"cylinders = {len(cut)}",)))
    if len(cut) != count:
        raise DiagramError("test.one_cut", ErrorMessage("entries", count=len(cut), wanted=count))
    powers = []
    for number, load in enumerate(cut, start=1):
        path = f"test.one_cut[{number}]"
        kind = _SHOWN[UNITS[machine.stated[path].unit].dimension]
        cut_out = Calculation()
        cut_out.known = {key: item for key, item in worked.known.items() if key.startswith(("brake", "speed"))}
        cut_out.known[kind] = given(f"{kind}.{number}", load, path)
        if kind != "effective_power":
            work_test(cut_out, pi)
        if "effective_power" not in cut_out.known:
            raise _without(path, missing(cut_out, kind) or missing(cut_out, "effective_torque"))
        powers.append(cut_out["effective_power"].named(f"effective_power.{number}"))
    for power in powers:
        worked.keep(power)
    return {"power_with_one_cut": total("power_with_one_cut", powers)}


def _draw_willans_line(worked: Calculation, test: Mapping[str, tuple[float, ...]]) -> None:
    """Add the straight line of fuel over brake power at one speed by least squares, and the losses that it gives."""
    powers, rates = test["load_powers"], test["load_fuel_rates"]
    if len(powers) != len(rates):
        raise DiagramError("test.load_fuel_rates", ErrorMessage("entries", count=len(rates), wanted=len(powers)))
    points = [
        (given(f"effective_power.{i}", power, f"test.load_powers[{i}]"),
         given(f"fuel_rate.{i}", rate, f"test.load_fuel_rates[{i}]"))
        for i, (power, rate) in enumerate(zip(powers, rates, strict=True), start=1)
    ]  # fmt: skip
    mean, mean_rate = (reduce(add, values) / len(points) for values in zip(*points, strict=True))
    spread = reduce(add, ((power - mean) * power for power, _ in points))
    slope = reduce(add, ((power - mean) * rate for power, rate in points)) / spread if max(powers) > min(powers) else 0
    if isinstance(slope, int) or slope.value <= 0 or mean_rate.value <= slope.value * mean.value:
        raise DiagramError("test.load_fuel_rates", ErrorMessage("willans_line"))
    lines = {"load_fuel_slope": slope, "idle_fuel_rate": mean_rate - slope * mean}
    for key, known in lines.items():
        fitted = ProcedureValue(known.value, "fit", [value for point in points for value in point], argument=known)
        worked.keep(TracedValue(fitted, key))
    loss = worked(willans_loss)
    if "indicated_power" not in worked.known:
        worked.keep(loss.named("mechanical_loss_power"))


def _check(machine: Machine, worked: Calculation, pi: float) -> None:
    """Raise DiagramError for measurements that nothing follows from, or that contradict each other."""
    stated = dict.fromkeys(path.partition("[")[0] for path in machine.stated)
    measured = [path for path in stated if path.startswith(_MEASURED) and path not in _BUILT]
    if not measured:
        raise DiagramError("test", ErrorMessage("test_nothing"))
    for known, other in contradictions(worked, pi):
        ways = _paths([known]), _paths([other])
        differing = [path for path in stated if path in ways[0] ^ ways[1]]
        tests = [path for path in differing if path in measured]
        if not tests:
            continue
        # the efficiency, or one that alone says as much as others
        sides = [[path for path in tests if path in inputs] for inputs in ways]
        tests.sort(key=lambda path: (path != _RATIO, min(len(side) for side in sides if path in side)))
        if machine.gas is not None and tests[0] != _RATIO and not all(sides):
            raise DiagramError(tests[0], ErrorMessage("test_of_engine"))
        same = [path for path in (tests if len(tests) > 1 else differing) if path != tests[0]]
        raise DiagramError(tests[0], ErrorMessage("same", others=same))
    used = _paths(worked.found.values())
    if "power_with_one_cut" in worked.known and "effective_power" not in worked.known:
        raise _without("test.one_cut", ("effective_power",))
    for path in measured:
        key = path.removeprefix("test.")
        if path not in used and (lacking := missing(worked, MEASURED.get(key, key))):
            raise _without(path, lacking)


def _paths(values: Iterable[TracedValue]) -> set[str]:
    """Return the keys of a file that values follow from."""
    return {known.node.path.partition("[")[0] for known in in_order(values) if isinstance(known.node, Input)}


def _without(path: str, lacking: tuple[str, ...]) -> DiagramError:
    keys = dict.fromkeys(_STATED.get(key, f"test.{key}") for key in lacking if key != "specific_gas_constant")
    return DiagramError(path, ErrorMessage("test_lacks", keys=list(keys)))
