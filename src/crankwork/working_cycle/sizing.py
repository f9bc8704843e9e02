"""Bore and stroke of an engine for a power, or the power of an engine of a given size."""

from __future__ import annotations

from crankwork.formula.known import Found, Known, absent, given
from crankwork.formula.worked import Worked
from crankwork.kinematics.slider_crank import mean_piston_speed
from crankwork.loads.gas import piston_area, swept_volume
from crankwork.locale import Refusal
from crankwork.working_cycle import engine_size
from crankwork.working_cycle.calculated_cycle import Notice
from crankwork.working_cycle.cycle_data import GrinevetskyData
from crankwork.working_cycle.fuels import CycleError
from crankwork.working_cycle.heat_capacities import as_counted, fresh_heat, residual_heat
from crankwork.working_cycle.performance import effective_mean_pressure, mechanical_loss_pressure

_CONVERGED = 1e-13
_MAX_PASSES = 200


def work_power(worked: Worked, data: GrinevetskyData) -> None:
    """Calculate power, torque and fuel per time of a sized engine."""
    worked(engine_size.effective_power)
    worked(engine_size.effective_torque, pi=data.pi)
    worked(engine_size.fuel_rate)
    worked(engine_size.power_per_litre)


def sized(worked: Worked, data: GrinevetskyData) -> list[Notice]:
    """Calculate the size of the engine for an indicated mean pressure, with a notice if it was rounded.

    Losses depend on the mean piston speed, and that on the unknown stroke: the calculation is repeated until the stroke
    converges, and its last pass is the one that is shown.
    """
    if data.bore is not None and data.stroke is not None:
        worked.given("stroke", data.stroke, "crank.stroke")
        _of_size(worked, data)
        return []
    stroke = 0.0
    for _ in range(_MAX_PASSES):
        following = _of_power(worked.again(""), data, stroke)
        if abs(following - stroke) <= _CONVERGED * following:
            break
        stroke = following
    else:
        raise CycleError(Refusal("power_unreached"))
    if not data.rounds_size:
        _of_power(worked, data, stroke)
        return []
    exact_size = worked.again(".before_rounding")
    _of_power(exact_size, data, stroke)
    millimetres = {key: exact_size[key].value * 1e3 for key in ("bore", "stroke")}
    if min(round(value) for value in millimetres.values()) == 0:
        raise CycleError(Refusal("power_tiny", **millimetres))
    values: dict[str, float | str] = {}
    for key in ("bore", "stroke"):
        exact = worked.keep(exact_size[key].named(key))
        taken = round(exact.value * 1e3) / 1e3
        worked.known[key] = Known(Found(taken, "rounded", (exact,)), key)
        values |= {key: exact.value * 1e3, f"{key}_taken": taken * 1e3}
    _of_size(worked, data)
    return [("cycle_rounded_size", values)]


def _effective(worked: Worked, data: GrinevetskyData) -> None:
    """Calculate the effective mean pressure at a stroke."""
    if not isinstance(data.mechanical_loss, tuple):
        raise CycleError(Refusal("losses_two"))
    speed = worked(mean_piston_speed).value
    loss = worked(mechanical_loss_pressure).value
    if worked(effective_mean_pressure).value <= 0:
        indicated = worked["indicated_mean_pressure"].value / 1e6
        raise CycleError(Refusal("losses_all", speed=speed, loss=loss / 1e6, indicated=indicated))


def _of_power(worked: Worked, data: GrinevetskyData, stroke: float) -> float:
    """Calculate the size that the power needs at an assumed stroke, and return the stroke that follows. [m]"""
    worked.known["stroke"] = Known(Found(stroke, "root"), "stroke")
    _effective(worked, data)
    worked(engine_size.displacement_of_power, N_e=given("effective_power", data.power or 0.0, "cycle.power"))
    worked(engine_size.swept_volume_of_one)
    worked(engine_size.bore_of_volume, pi=data.pi)
    return worked(engine_size.stroke_of_bore).value


def _of_size(worked: Worked, data: GrinevetskyData) -> None:
    """Calculate the size of an engine with given bore and stroke."""
    worked(piston_area, pi=data.pi)
    worked(swept_volume)
    worked(engine_size.displacement)
    _effective(worked, data)


PARTS = {
    "effective": "effective_power", "to_coolant": "heat_to_coolant", "to_exhaust": "heat_to_exhaust",
    "unburnt": "heat_unburnt", "rest": "heat_rest",
}  # fmt: skip


def heat_balance(worked: Worked, data: GrinevetskyData) -> None:
    """Calculate the heat balance of a sized engine: power, coolant, exhaust, unburnt, rest, and their shares.

    `worked`: has charge, products, power and fuel; takes the results. Source: kolchin_demidov_2008, ch. 4.
    """
    worked(engine_size.heat_supplied)
    worked(engine_size.heat_to_coolant)
    _exhaust(worked, data)
    if worked["heat_lost_incomplete"].is_absent:
        worked.absent("heat_unburnt")
    else:
        worked(engine_size.heat_unburnt)
    worked(engine_size.heat_rest)
    for name, key in PARTS.items():
        share = f"heat_share.{name}"
        if worked[key].is_absent:
            worked.keep(absent(share))
        else:
            worked(engine_size.heat_share, share, Q_part=worked[key])


def _exhaust(worked: Worked, data: GrinevetskyData) -> None:
    """Calculate the heat of the exhaust gas."""
    law = data.heat_capacities
    hot, cold = (
        as_counted(worked, law, worked[key], name)
        for key, name in (("residual_temperature", "exhaust"), ("charge_temperature", "charge"))
    )
    heats = (
        residual_heat(worked, law, hot, "product_heat.exhaust"),
        fresh_heat(worked, law, cold, "fresh_charge_heat.charge"),
    )
    exhaust, fresh = (
        worked(engine_size.molar_enthalpy, f"molar_enthalpy.{name}", mc_gas=heat, th_gas=temperature)
        for name, heat, temperature in zip(("exhaust", "charge"), heats, (hot, cold), strict=True)
    )
    worked(engine_size.heat_to_exhaust, h_prod=exhaust, h_fresh=fresh)
