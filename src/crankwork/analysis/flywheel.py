"""The flywheel of a machine: a given one, the requirements on one to be sized, and the dimensions of both."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from crankwork.formula.traced_value import TracedValue, absent, given, total
from crankwork.machine import Machine
from crankwork.preparation import traced_inputs
from crankwork.shaft import flywheel as formulas


def target_fluctuation(machine: Machine, w: TracedValue) -> TracedValue | None:
    """Return the target fluctuation of the speed, in any form that it is stated in."""
    value, stated = machine.drive.fluctuation, machine.stated
    if value is None:
        return None
    wanted, key = given("speed_fluctuation", value, "flywheel.fluctuation"), "flywheel.percent"
    if key in stated:
        half = given("half_fluctuation", stated[key].value, key)
        return traced_inputs.checked(half * 2 / 100, wanted)
    if "flywheel.speeds[1]" in stated:
        high, low = extreme_speeds(machine)
        return traced_inputs.checked((high - low) / w, wanted)
    return wanted


def extreme_speeds(machine: Machine) -> tuple[TracedValue, TracedValue]:
    """Return the stated extreme speeds that a flywheel is sized for."""
    paths = {".largest": "flywheel.speeds[1]", ".least": "flywheel.speeds[2]"}
    high, low = (
        traced_inputs.speed_at(machine, machine.method, path, machine.stated[path].value, name)
        for name, path in paths.items()
    )
    return high, low


def turning_inertia(machine: Machine, key: str) -> TracedValue:
    """Return the stated moment of inertia of the rotating parts, under a key; absent if none is stated."""
    value, wheel = machine.drive.inertia, tuple(_given_wheel(machine))
    if not value:
        return absent(key)
    plain, own = given(key, value, "flywheel.inertia"), machine.stated.get("crank.inertia")
    shaft = () if own is None else (given("reduced_inertia.shaft", own.value, "crank.inertia"),)
    # the inertia of a crank with mass is one of the bodies
    for parts in ((*shaft, *wheel), wheel):
        if parts and (result := traced_inputs.checked(total(key, parts), plain)) is not plain:
            return result
    return plain


def _given_wheel(machine: Machine) -> Iterator[TracedValue]:
    """Yield the moment of inertia of the flywheel that a description gives."""
    wheel, stated = machine.drive.wheel, machine.stated
    own = stated.get("flywheel.inertia")
    if own is not None and own.value:
        yield given("flywheel_inertia", own.value, "flywheel.inertia")
    elif wheel is not None and wheel.mass is not None and wheel.gyration_radius is not None:
        mass = given("flywheel_mass", wheel.mass, "flywheel.mass")
        yield formulas.inertia_of_wheel(mass, _gyration(wheel.gyration_radius))
    elif wheel is not None and wheel.rim is not None and wheel.rim.diameter is not None:
        rim, diameter = wheel.rim, _of_rim("diameter", wheel.rim.diameter)
        if wheel.mass is not None:
            mass = given("rim_mass", wheel.mass, "flywheel.mass")
        elif rim.density is not None and rim.width is not None and rim.thickness is not None:
            sizes = (_of_rim("width", rim.width), _of_rim("thickness", rim.thickness))
            mass = formulas.mass_of_rim(_of_rim("density", rim.density), machine.method.pi, diameter, *sizes)
        else:
            return
        inertia: TracedValue = formulas.inertia_of_rim(mass, diameter)
        yield inertia if rim.share == 1 else inertia / _of_rim("share", rim.share)


def _gyration(value: float) -> TracedValue:
    return given("gyration_radius", value, "flywheel.radius_of_gyration")


def _of_rim(name: str, value: float) -> TracedValue:
    return given(f"rim_{name}", value, f"flywheel.rim.{name}")


def given_flywheel_dimensions(machine: Machine, w: TracedValue) -> dict[str, TracedValue]:
    """Return the dimensions of a given flywheel that follow from its stated ones."""
    values = dict[str, TracedValue]()
    for wheel in _given_wheel(machine):
        values |= flywheel_dimensions(machine, wheel, w)
    return {
        key: value for key, value in values.items() if key != "flywheel_mass" or "flywheel.mass" not in machine.stated
    }


def flywheel_dimensions(machine: Machine, inertia: TracedValue, w: TracedValue) -> dict[str, TracedValue]:
    """Return the mass of a flywheel of a moment of inertia, and the dimensions of its rim."""
    wheel = machine.drive.wheel
    if wheel is None:
        return {}
    values = dict[str, TracedValue]()
    if wheel.gyration_radius is not None:
        values["flywheel_mass"] = formulas.mass_of_wheel(inertia, _gyration(wheel.gyration_radius))
    if wheel.rim is not None:
        values |= _rim(machine, wheel.rim, inertia, w)
    return {key: value.named(key) for key, value in values.items()}


def _rim(machine: Machine, rim: formulas.RimSpec, inertia: TracedValue, w: TracedValue) -> dict[str, TracedValue]:
    """Return speed, diameter, mass and section of a rim, as far as they follow."""
    values = dict[str, TracedValue]()
    density = None if rim.density is None else _of_rim("density", rim.density)
    part = inertia if rim.share == 1 else (_of_rim("share", rim.share) * inertia).named("rim_inertia")
    if rim.diameter is not None:
        diameter = _of_rim("diameter", rim.diameter)
        speed = values["rim_speed"] = formulas.rim_speed(w, diameter)
    elif rim.speed is None and rim.stress is None:
        section = _of_rim("width", rim.width or 0.0), _of_rim("thickness", rim.thickness or 0.0)
        diameter = values["rim_diameter"] = formulas.rim_diameter_of_section(part, density, machine.method.pi, *section)
        speed = values["rim_speed"] = formulas.rim_speed(w, diameter)
    else:
        if rim.speed is not None:
            speed = _of_rim("speed", rim.speed)
        else:
            speed = values["rim_speed"] = formulas.rim_speed_of_stress(_of_rim("stress", rim.stress or 0.0), density)
        diameter = values["rim_diameter"] = formulas.rim_diameter(speed, w)
    if density is not None and rim.stress is None:
        values["rim_stress"] = formulas.hoop_stress(density, speed)
    mass = values["rim_mass"] = formulas.mass_for_inertia_of_rim(part, diameter)
    if density is None or (rim.width is not None and rim.thickness is not None):
        return values
    section = values["rim_section"] = formulas.rim_section(mass, machine.method.pi, diameter, density)
    if rim.ratio is not None:
        ratio = _of_rim("ratio", rim.ratio)
        thickness = values["rim_thickness"] = formulas.rim_thickness(section, ratio)
        values["rim_width"] = thickness * ratio
    elif rim.width is not None:
        values["rim_thickness"] = section / _of_rim("width", rim.width)
    elif rim.thickness is not None:
        values["rim_width"] = section / _of_rim("thickness", rim.thickness)
    return values


def recovery_torque_values(
    machine: Machine, inertia: TracedValue, w: TracedValue, summary: Mapping[str, TracedValue]
) -> dict[str, TracedValue]:
    """Return the torque that brings a shaft back to its greatest speed in the time that is stated."""
    wheel = machine.drive.wheel
    if wheel is None or wheel.recovery_time is None or "speed_fluctuation" not in summary:
        return {}
    time = given("recovery_time", wheel.recovery_time, "flywheel.recovery")
    delta = summary["speed_fluctuation"].named("speed_fluctuation")
    return {"recovery_torque": formulas.recovery_torque(inertia, delta, w, time)}
