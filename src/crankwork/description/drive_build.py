"""From the values of a machine file to the efficiency between motor and process, and the motor."""

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
from crankwork.shaft.motor import AsynchronousMotor, GearedMotor, MotorSelection

_LEAST_EFFICIENCY = 1e-4


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
