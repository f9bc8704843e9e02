"""Bore and stroke of the engine that a cycle asks for, or the power of one whose size is known."""

from __future__ import annotations

from crankwork.formula.known import Found, Known, given
from crankwork.formula.worked import Worked
from crankwork.kinematics.lengths import mean_piston_speed
from crankwork.loads.gas import piston_area, swept_volume
from crankwork.working_cycle import engine_size
from crankwork.working_cycle.calculated_cycle import Notice
from crankwork.working_cycle.cycle_data import GrinevetskyData
from crankwork.working_cycle.fuels import CycleError
from crankwork.working_cycle.performance import effective_mean_pressure, mechanical_loss_pressure

_SETTLED = 1e-13
_LONGEST = 200


def work_power(worked: Worked, data: GrinevetskyData) -> None:
    """Work power, torque and fuel per time of a sized engine."""
    worked(engine_size.effective_power)
    worked(engine_size.effective_torque, pi=data.pi)
    worked(engine_size.fuel_rate)
    worked(engine_size.power_per_litre)


def sized(worked: Worked, data: GrinevetskyData) -> list[Notice]:
    """Work the size of the engine.

    A notice where the size was rounded. `worked`: knows the indicated mean pressure; where it is kept.

    Losses depend on the mean piston speed and that on the stroke to be found: the calculation is repeated until the
    stroke stays, and its last pass is the one that is shown.
    """
    if data.bore is not None and data.stroke is not None:
        worked.given("stroke", data.stroke, "crank.radius")
        _of_size(worked, data)
        return []
    stroke = 0.0
    for _ in range(_LONGEST):
        found = _of_power(worked.again(""), data, stroke)
        if abs(found - stroke) <= _SETTLED * found:
            break
        stroke = found
    else:
        raise CycleError("no stroke gives the wanted power at this speed; lower the speed or the stroke-bore ratio")
    if not data.rounds_size:
        _of_power(worked, data, stroke)
        return []
    asked = worked.again(".before_rounding")
    _of_power(asked, data, stroke)
    if min(round(asked[key].value * 1e3) for key in ("bore", "stroke")) == 0:
        raise CycleError(
            f"the wanted power needs a bore of {asked['bore'].value * 1e3:.2g} mm and a stroke of "
            f"{asked['stroke'].value * 1e3:.2g} mm; write a larger power, or the bore and the stroke"
        )
    said: dict[str, float | str] = {}
    for key in ("bore", "stroke"):
        exact = worked.keep(asked[key].named(key))
        taken = round(exact.value * 1e3) / 1e3
        worked.known[key] = Known(Found(taken, "rounded", (exact,)), key)
        said |= {key: exact.value * 1e3, f"{key}_taken": taken * 1e3}
    _of_size(worked, data)
    return [("cycle_rounded_size", said)]


def _effective(worked: Worked, data: GrinevetskyData) -> None:
    """Work the effective mean pressure at a stroke."""
    if not isinstance(data.mechanical_loss, tuple):
        raise CycleError("mechanical losses need the two coefficients of p_m = a + b v_p")
    speed = worked(mean_piston_speed).value
    loss = worked(mechanical_loss_pressure).value
    if worked(effective_mean_pressure).value <= 0:
        raise CycleError(
            f"at a mean piston speed of {speed:g} m/s the losses, {loss / 1e6:g} MPa, take all of the indicated mean "
            f"pressure, {worked['indicated_mean_pressure'].value / 1e6:g} MPa; lower speed or stroke, or give other "
            "mechanical losses"
        )


def _of_power(worked: Worked, data: GrinevetskyData, stroke: float) -> float:
    """Work the size that the power asks for if the stroke were the one given; return the stroke that follows. [m]"""
    worked.known["stroke"] = Known(Found(stroke, "root"), "stroke")
    _effective(worked, data)
    worked(engine_size.displacement_of_power, N_e=given("effective_power", data.power or 0.0, "cycle.power"))
    worked(engine_size.swept_volume_of_one)
    worked(engine_size.bore_of_volume, pi=data.pi)
    return worked(engine_size.stroke_of_bore).value


def _of_size(worked: Worked, data: GrinevetskyData) -> None:
    """Work the size of an engine whose bore and stroke are known."""
    worked(piston_area, pi=data.pi)
    worked(swept_volume)
    worked(engine_size.displacement)
    _effective(worked, data)
