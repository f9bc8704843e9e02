"""From the values of a machine file to efficiency, motor and flywheel."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal

from crankwork.description.schema import Values
from crankwork.description.value_types import Reader
from crankwork.dynamics.efficiency import Chain, efficiency
from crankwork.errors import MethodError
from crankwork.locale import ErrorMessage
from crankwork.machine import Drive
from crankwork.shaft.flywheel import FlywheelSpec, RimSpec, inertia_of_rim, inertia_of_wheel, mass_of_rim
from crankwork.shaft.motor import AsynchronousMotor, GearedMotor, MotorSelection

_LEAST_EFFICIENCY = 1e-4
WANTED = ("fluctuation", "percent", "speeds")
_SECTION = ("width", "thickness", "density")
_SAME = 5e-3


def _is_whole(part: object) -> bool:
    """Return whether an efficiency, or a list of them in parallel, could be read."""
    return bool(part) and None not in part if isinstance(part, list) else part is not None


def read_drive(values: Values, reader: Reader) -> Drive:
    """Return efficiency and motor of a description."""
    drive = Drive()
    chain = values["efficiency"]["chain"]
    # unreadable values are already reported
    if chain and all(_is_whole(part) for part in chain):
        table = values["efficiency"]
        parts: Chain = tuple(tuple(part) if isinstance(part, list) else part for part in chain)
        total = efficiency(parts)
        if total < _LEAST_EFFICIENCY:
            reader.add_error("efficiency.chain", ErrorMessage("efficiency_small", whole=total))
            return drive
        losses: Literal["", "drive", "machine"] = table.get("losses", "")
        drive = replace(drive, efficiency=total, chain=parts, losses=losses)
        if not losses and any(joints in values.get("friction", {}) for joints in ("pins", "sliders")):
            reader.add_error("efficiency", ErrorMessage("losses_twice"))
        if "decimals" in table:
            used = round(total, int(table["decimals"]))
            drive = replace(drive, efficiency=used, exact_efficiency=total)
            if used <= 0:
                reader.add_error("efficiency.decimals", ErrorMessage("efficiency_rounded", whole=total))
    if "motor_selection" in values:
        table = values["motor_selection"]
        selection = table.made(MotorSelection, frequency=table.si("frequency") / (2 * math.pi))
        drive = replace(drive, selection=selection)
    motor = values.get("motor")
    if motor and {"rated_power", "rated_speed", "overload", "pole_pairs"} <= set(motor):
        frequency = motor.si("frequency") / (2 * math.pi)
        try:
            own = AsynchronousMotor.of_catalogue(
                motor["rated_power"].value, motor["rated_speed"].value, motor["overload"],
                frequency=frequency, pole_pairs=int(motor["pole_pairs"]),
            )  # fmt: skip
        except MethodError as error:
            reader.add_error("motor.rated_speed", error.args[0])
        else:
            geared = GearedMotor(own, motor["ratio"], motor.si("inertia"), drive.efficiency)
            drive = replace(drive, motor=geared, rated_power=motor["rated_power"].value)
    return drive


def read_flywheel(values: Values, drive: Drive, speed: float | None, reader: Reader, *, pi: float = math.pi) -> Drive:
    """Return a drive with the flywheel of a table. `speed`: of the crank, where the description states it. [rad/s]"""
    rim = values["rim"]
    if "rim" in values and {"diameter", "speed", "stress"}.isdisjoint(rim) and not {*_SECTION} <= set(rim):
        # a section of a density has the diameter that its inertia needs
        advice = ('diameter = "1 m"', 'speed = "30 m/s"', 'stress = "5 MPa"')
        reader.add_error("flywheel.rim.diameter", ErrorMessage("missing", advice=advice))
        return drive
    wheel = FlywheelSpec(
        mass=values.si("mass"),
        gyration_radius=values.si("radius_of_gyration"),
        rim=rim.made(RimSpec) if "rim" in values else None,
        recovery_time=values.si("recovery"),
    )
    if wheel == FlywheelSpec() and not {"inertia", *WANTED} & set(values):
        return drive
    if wheel.mass is not None and wheel.gyration_radius is None and not (wheel.rim and wheel.rim.diameter is not None):
        if not reader.has_errors("flywheel.radius_of_gyration", "flywheel.rim"):
            reader.add_error("flywheel.mass", ErrorMessage("wheel_mass_where"))
        return drive
    return replace(
        drive,
        inertia=drive.inertia + _inertia(values, wheel, pi),
        fluctuation=_fluctuation(values, speed, reader),
        wheel=wheel,
    )


def is_given(values: Values) -> bool:
    """Return whether a table states a flywheel, not only its required fluctuation."""
    rim = values["rim"]
    return bool(values.si("inertia")) or "mass" in values or {"diameter", *_SECTION} <= set(rim)


def _inertia(values: Values, wheel: FlywheelSpec, pi: float) -> float:
    """Return the given moment of inertia, zero if it is to be determined. [kg m2]"""
    rim = wheel.rim
    if wheel.mass is not None and wheel.gyration_radius is not None:
        return float(inertia_of_wheel(wheel.mass, wheel.gyration_radius))
    if rim is not None and wheel.mass is not None and rim.diameter is not None:
        return float(inertia_of_rim(wheel.mass, rim.diameter)) / rim.share
    if rim is not None and not values.si("inertia") and is_given(values):
        mass = float(mass_of_rim(rim.density, pi, rim.diameter, rim.width, rim.thickness))
        return float(inertia_of_rim(mass, rim.diameter)) / rim.share
    inertia: float = values.si("inertia") or 0.0
    return inertia


def _fluctuation(values: Values, speed: float | None, reader: Reader) -> float | None:
    """Return the required fluctuation, in any form it is stated."""
    if "percent" in values:
        return float(2 * values["percent"] / 100)
    if "speeds" not in values:
        fluctuation: float | None = values["fluctuation"]
        return fluctuation
    high, low = (limit.value if limit else math.nan for limit in values["speeds"])
    mean = (high + low) / 2
    if not high > low and not reader.has_errors("flywheel.speeds", "flywheel.speeds[1]", "flywheel.speeds[2]"):
        reader.add_error("flywheel.speeds", ErrorMessage("wheel_speeds_order"))
    elif speed is not None and abs(mean - speed) > _SAME * speed:
        reader.add_error("flywheel.speeds", ErrorMessage("wheel_speeds_mean", mean=mean * 30 / math.pi))
    return (high - low) / mean
