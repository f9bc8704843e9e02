"""How evenly a shaft of constant inertia turns: the flywheel that is given or found, its sizes, its speed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from crankwork.analysis import origins
from crankwork.analysis.solved import Notice
from crankwork.errors import MethodError
from crankwork.formula.known import Found, Known, Table, absent, given, total
from crankwork.machine import Machine
from crankwork.shaft.curve import AtDegrees, Curve
from crankwork.shaft.fluctuation import (
    ExcessWork,
    TrueSpeed,
    fluctuation_of_inertia,
    speed_of_energy,
    true_speed,
)
from crankwork.shaft.flywheel import check_fluctuation, flywheel_beside_machine, inertia_for_fluctuation
from crankwork.shaft.wheel import (
    Rim,
    hoop_stress,
    inertia_of_rim,
    inertia_of_wheel,
    mass_for_inertia_of_rim,
    mass_of_rim,
    mass_of_wheel,
    recovery_torque,
    rim_diameter,
    rim_section,
    rim_speed,
    rim_speed_of_stress,
    rim_thickness,
)


class Wheel(NamedTuple):
    """A flywheel: single values, what lies between them, and why there is none."""

    summary: dict[str, Known]
    between: dict[str, Known]
    notices: tuple[Notice, ...]
    inertia: Known  # Of all that turns; absent where nothing of it is known


class Course(NamedTuple):
    """Energy and speed over the angle: columns, single values, why there is no speed."""

    columns: dict[str, Known]
    summary: dict[str, Known]
    notices: tuple[Notice, ...]
    speed: TrueSpeed | None


def wanted_fluctuation(machine: Machine, w: Known) -> Known | None:
    """Return the fluctuation of the speed that is wanted, in whichever way it is stated."""
    value, stated = machine.drive.fluctuation, machine.stated
    if value is None:
        return None
    wanted, key = given("speed_fluctuation", value, "flywheel.fluctuation"), "flywheel.percent"
    if key in stated:
        half = given("half_fluctuation", stated[key].value, key)
        return origins.checked(half * 2 / 100, wanted)
    if "flywheel.speeds[1]" in stated:
        high, low = extreme_speeds(machine)
        return origins.checked((high - low) / w, wanted)
    return wanted


def extreme_speeds(machine: Machine) -> tuple[Known, Known]:
    """Return the extreme speeds that a flywheel shall keep to, as they are stated."""
    paths = {".largest": "flywheel.speeds[1]", ".least": "flywheel.speeds[2]"}
    high, low = (
        origins.speed_at(machine, machine.method, path, machine.stated[path].value, name)
        for name, path in paths.items()
    )
    return high, low


def turning_inertia(machine: Machine, key: str) -> Known:
    """Return the moment of inertia of all that turns and is given under a key; absent where nothing is."""
    whole, wheel = machine.drive.inertia, tuple(_given_wheel(machine))
    if not whole:
        return absent(key)
    plain, own = given(key, whole, "flywheel.inertia"), machine.stated.get("crank.inertia")
    beside = () if own is None else (given("reduced_inertia.shaft", own.value, "crank.inertia"),)
    # that of a heavy crank is one of the bodies
    for parts in ((*beside, *wheel), wheel):
        if parts and (found := origins.checked(total(key, parts), plain)) is not plain:
            return found
    return plain


def _given_wheel(machine: Machine) -> Iterator[Known]:
    """Yield the moment of inertia of the flywheel that a description gives."""
    wheel, stated = machine.drive.wheel, machine.stated
    own = stated.get("flywheel.inertia")
    if own is not None and own.value:
        yield given("flywheel_inertia", own.value, "flywheel.inertia")
    elif wheel is not None and wheel.mass is not None and wheel.gyration_radius is not None:
        mass = given("flywheel_mass", wheel.mass, "flywheel.mass")
        yield inertia_of_wheel(mass, _gyration(wheel.gyration_radius))
    elif wheel is not None and wheel.rim is not None and wheel.rim.diameter is not None:
        rim, diameter = wheel.rim, _of_rim("diameter", wheel.rim.diameter)
        if wheel.mass is not None:
            mass = given("rim_mass", wheel.mass, "flywheel.mass")
        elif rim.density is not None and rim.width is not None and rim.thickness is not None:
            sizes = (_of_rim("width", rim.width), _of_rim("thickness", rim.thickness))
            mass = mass_of_rim(_of_rim("density", rim.density), machine.method.pi, diameter, *sizes)
        else:
            return
        inertia: Known = inertia_of_rim(mass, diameter)
        yield inertia if rim.share == 1 else inertia / _of_rim("share", rim.share)


def _gyration(value: float) -> Known:
    return given("gyration_radius", value, "flywheel.radius_of_gyration")


def _of_rim(name: str, value: float) -> Known:
    return given(f"rim_{name}", value, f"flywheel.rim.{name}")


def wheel_for(machine: Machine, excess: Known, w: Known, own: Known) -> Wheel:
    """Return the flywheel of a machine, found where a fluctuation is wanted, and all that is to be told of it."""
    wanted, whole = wanted_fluctuation(machine, w), own
    summary, between, notices = dict[str, Known](), dict[str, Known](), []
    if wanted is not None:
        try:
            check_fluctuation(wanted.value, w.value)
        except MethodError as error:
            notices.append(Notice("no_flywheel", {"message": error.args[0]}))
        else:
            wheel, needed = _found(excess, wanted, w, own)
            summary["flywheel_inertia"] = wheel
            if wheel.value:
                whole = between[needed.key] = needed
                summary |= sizes_of(machine, wheel, w)
    else:
        summary |= sizes_of_given(machine, w)
    return Wheel(summary, between, tuple(notices), whole)


def _found(excess: Known, wanted: Known, w: Known, own: Known) -> tuple[Known, Known]:
    """Return the flywheel that is needed beside what turns already, zero where that is enough, and both."""
    needed: Known = inertia_for_fluctuation(excess, wanted, w).named("flywheel_inertia")
    wheel = needed
    if not own.is_absent:
        needed = needed.named("whole_inertia")
        wheel = flywheel_beside_machine(needed, own)
    return (wheel if wheel.value > 0 else Known(Found(0.0, "none", (wheel,)))), needed


def sizes_of_given(machine: Machine, w: Known) -> dict[str, Known]:
    """Return what follows of the sizes of a flywheel that is given, beside those that are stated."""
    found = dict[str, Known]()
    for wheel in _given_wheel(machine):
        found |= sizes_of(machine, wheel, w)
    return {key: one for key, one in found.items() if key != "flywheel_mass" or "flywheel.mass" not in machine.stated}


def sizes_of(machine: Machine, inertia: Known, w: Known) -> dict[str, Known]:
    """Return the mass of a flywheel of a moment of inertia, and what follows for its rim."""
    wheel = machine.drive.wheel
    if wheel is None:
        return {}
    found = dict[str, Known]()
    if wheel.gyration_radius is not None:
        found["flywheel_mass"] = mass_of_wheel(inertia, _gyration(wheel.gyration_radius))
    if wheel.rim is not None:
        found |= _rim(machine, wheel.rim, inertia, w)
    return {key: one.named(key) for key, one in found.items()}


def _rim(machine: Machine, rim: Rim, inertia: Known, w: Known) -> dict[str, Known]:
    """Return speed, diameter, mass and section of a rim, as far as they follow."""
    found = dict[str, Known]()
    density = None if rim.density is None else _of_rim("density", rim.density)
    if rim.diameter is not None:
        diameter = _of_rim("diameter", rim.diameter)
        speed = found["rim_speed"] = rim_speed(w, diameter)
    else:
        if rim.speed is not None:
            speed = _of_rim("speed", rim.speed)
        else:
            speed = found["rim_speed"] = rim_speed_of_stress(_of_rim("stress", rim.stress or 0.0), density)
        diameter = found["rim_diameter"] = rim_diameter(speed, w)
    if density is not None and rim.stress is None:
        found["rim_stress"] = hoop_stress(density, speed)
    part = inertia if rim.share == 1 else (_of_rim("share", rim.share) * inertia).named("rim_inertia")
    mass = found["rim_mass"] = mass_for_inertia_of_rim(part, diameter)
    if density is None or (rim.width is not None and rim.thickness is not None):
        return found
    section = found["rim_section"] = rim_section(mass, machine.method.pi, diameter, density)
    if rim.ratio is not None:
        ratio = _of_rim("ratio", rim.ratio)
        thickness = found["rim_thickness"] = rim_thickness(section, ratio)
        found["rim_width"] = thickness * ratio
    elif rim.width is not None:
        found["rim_thickness"] = section / _of_rim("width", rim.width)
    elif rim.thickness is not None:
        found["rim_width"] = section / _of_rim("thickness", rim.thickness)
    return found


def course_of(torque: Curve, found: ExcessWork, excess: Known, w: Known, inertia: Known, of: Known) -> Course:
    """Return energy and speed over the angle of a shaft of constant inertia.

    `torque`: that of all, less what balances it or with it; `excess`: its excess work as it is remembered; `of`: the
    column that the energy is the integral of.
    """
    change = Known(
        Table(AtDegrees(found.curve), "integral", np.degrees(found.curve.angle), (of,)), "kinetic_energy_change"
    )
    columns, summary = {"kinetic_energy_change": change}, dict[str, Known]()
    if not inertia.value > 0:
        return Course(columns, summary, (), None)
    try:
        speed = true_speed(Curve.constant(inertia.value, torque.cycle), torque, w.value, found)
    except MethodError as error:
        return Course(columns, summary, (Notice("no_steady_speed", {"message": error.args[0]}),), None)
    energy = Known(Found(speed.energy, "energy", (of,)), "kinetic_energy.start")
    turning = speed_of_energy(energy + change, inertia).named("crank_speed")
    columns["crank_speed"] = turning
    summary["speed_fluctuation"] = fluctuation_of_inertia(excess, inertia, w)
    ends = speed.extremes
    for word, value, at in (("max", ends.largest, ends.at_largest), ("min", ends.least, ends.at_least)):
        # as far above the mean as the least is below it, where the inertia is constant
        half = w * summary["speed_fluctuation"] / 2
        by = w + half if word == "max" else w - half
        summary[f"crank_speed_{word}"] = Known(Found(value, word, (turning,), math.degrees(at), by))
    return Course(columns, summary, (), speed)


def recovery(machine: Machine, inertia: Known, w: Known, summary: Mapping[str, Known]) -> dict[str, Known]:
    """Return the torque that brings a shaft back to its greatest speed in the time that is stated."""
    wheel = machine.drive.wheel
    if wheel is None or wheel.recovery_time is None or "speed_fluctuation" not in summary:
        return {}
    time = given("recovery_time", wheel.recovery_time, "flywheel.recovery")
    delta = summary["speed_fluctuation"].named("speed_fluctuation")
    return {"recovery_torque": recovery_torque(inertia, delta, w, time)}
