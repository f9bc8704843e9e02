"""The working cycle by Grinevetsky and Mazing: fuel, charge, compression, burning, expansion, results, size."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

from crankwork.loads.gas import clearance_volume
from crankwork.steps import Worked
from crankwork.working_cycle import charge, combustion, performance
from crankwork.working_cycle.calculated_cycle import CalculatedCycle, Corners, Notice
from crankwork.working_cycle.cycle_data import GrinevetskyData, with_usual_values
from crankwork.working_cycle.fuels import Burning, CycleError, burning
from crankwork.working_cycle.heat_balance import heat_balance
from crankwork.working_cycle.heat_capacities import (
    fresh_heat,
    law_zero,
    mixture_heat,
    product_coefficients,
    residual_heat,
)
from crankwork.working_cycle.mixture import Mixture, mixture
from crankwork.working_cycle.sizing import Size, sized
from crankwork.working_cycle.validity import cycle_notices

Given = TypeVar("Given")


def grinevetsky(data: GrinevetskyData) -> CalculatedCycle:
    """Return the working cycle of an engine, every value a worked step.

    Parameters
    ----------
    data : GrinevetskyData
        What is known; with power, or bore and stroke, the engine is sized too.

    Returns
    -------
    CalculatedCycle
        Steps in the order of textbooks, values, corners of the theoretical diagram, notices.

    Raises
    ------
    CycleError
        If no cycle follows from the data.

    References
    ----------
    kolchin_demidov_2008, ch. 1, 3, 4; nguyen_tat_tien_2000.
    """
    full, assumed = with_usual_values(data)
    worked = Worked()
    fuel = _given(full.fuel)
    heat = burning(worked, fuel)
    mixed = mixture(worked, fuel, heat.air_amount, _given(full.excess_air), full.hydrogen_share)
    start = _intake(worked, full)
    end = _compression(worked, full, start)
    burnt = _combustion(worked, full, heat, mixed, end)
    corners = _expansion(worked, full, start, end, burnt)
    indicated = _indicated(worked, full, heat, mixed, start, corners)
    notices: list[Notice] = [("cycle_assumed", {"names": ", ".join(assumed)})] if assumed else []
    if full.power or full.stroke:
        size, said = sized(worked, full, indicated)
        notices += said
        _effective(worked, full, heat, indicated, size)
        heat_balance(worked, full, heat, mixed, size)
    values = _data_values(full, heat, start) | worked.values
    notices += cycle_notices(full.kind, full.heat_capacities, values)
    angle = 180.0 * full.strokes
    return CalculatedCycle(full.kind, angle, corners, tuple(worked.steps), values, tuple(notices))


class _Intake(NamedTuple):
    """State before the intake and pressures around it: charge [Pa], [K], [kg/m3]; intake, residual [Pa]."""

    charge_pressure: float
    charge_temperature: float
    density: float
    intake_pressure: float
    residual_pressure: float


class _Compressed(NamedTuple):
    """Residual gas fraction [-], volumetric efficiency [-], state at c [Pa], [K]."""

    residual_fraction: float
    pressure: float
    temperature: float


class _Burnt(NamedTuple):
    """State at z [Pa], [K]; pressure ratio, cut-off ratio [-]."""

    pressure: float
    temperature: float
    ratio: float
    cut_off: float


def _intake(worked: Worked, data: GrinevetskyData) -> _Intake:
    pressure = data.charge_pressure or data.ambient_pressure
    temperature = data.charge_temperature
    if temperature is None and data.charge_pressure is not None:
        compressor = (data.ambient_temperature, pressure, data.ambient_pressure, data.compressor_exponent)
        temperature = worked(charge.compressor_temperature, *compressor)
        temperature = worked(charge.cooled_charge_temperature, temperature, data.cooler_drop)
    temperature = temperature or data.ambient_temperature
    density = worked(charge.charge_density, pressure, data.air_gas_constant, temperature)
    intake = data.intake_pressure
    if intake is None:
        loss = worked(charge.intake_pressure_loss, _given(data.intake_loss_factor), _given(data.intake_speed), density)
        intake = worked(charge.intake_pressure, pressure, loss)
    residual = _given(data.residual_pressure)
    if data.compression_ratio * data.charge_up * intake <= data.scavenging * residual:
        raise CycleError(
            f"the pressure at the end of intake, {intake / 1e6:g} MPa, lets no fresh charge in against residual gas of "
            f"{residual / 1e6:g} MPa; check intake_pressure, intake_speed and residual_pressure"
        )
    return _Intake(pressure, temperature, density, intake, residual)


def _compression(worked: Worked, data: GrinevetskyData, start: _Intake) -> _Compressed:
    ratio, exponent = data.compression_ratio, _given(data.compression_exponent)
    filled = _filled_vietnamese if data.intake_school == "vietnamese" else _filled
    fraction, begin, efficiency = filled(worked, data, start)
    if data.lost_stroke:
        worked(performance.ported_volumetric_efficiency, efficiency, data.lost_stroke)
        worked(charge.geometric_compression_ratio, ratio, data.lost_stroke)
    pressure = worked(charge.compression_pressure, start.intake_pressure, ratio, exponent)
    return _Compressed(fraction, pressure, worked(charge.compression_temperature, begin, ratio, exponent))


def _filled(worked: Worked, data: GrinevetskyData, start: _Intake) -> tuple[float, float, float]:
    """Return residual gas fraction [-], temperature [K] and volumetric efficiency [-] at the end of intake."""
    ratio, temperature, heating = data.compression_ratio, start.charge_temperature, _given(data.heating)
    hot, residual, intake = _given(data.residual_temperature), start.residual_pressure, start.intake_pressure
    fraction = worked(
        charge.residual_fraction,
        temperature, heating, hot, data.scavenging, residual, ratio, data.charge_up, intake,
    )  # fmt: skip
    begin = worked(charge.intake_temperature, temperature, heating, fraction, hot)
    efficiency = worked(
        charge.volumetric_efficiency,
        temperature, heating, ratio, start.charge_pressure, data.charge_up, intake, data.scavenging, residual,
    )  # fmt: skip
    return fraction, begin, efficiency


def _filled_vietnamese(worked: Worked, data: GrinevetskyData, start: _Intake) -> tuple[float, float, float]:
    """Return the same with residual gas that expands to the pressure of the intake."""
    ratio, temperature, heating = data.compression_ratio, start.charge_temperature, _given(data.heating)
    hot, residual, intake = _given(data.residual_temperature), start.residual_pressure, start.intake_pressure
    correction, exponent = data.heat_correction, data.exhaust_exponent
    fraction = worked(
        charge.residual_fraction_vietnamese,
        data.scavenging, temperature, heating, hot, residual, intake, ratio, data.charge_up, correction, exponent,
    )  # fmt: skip
    begin = worked(
        charge.intake_temperature_vietnamese,
        temperature, heating, correction, fraction, hot, intake, residual, exponent,
    )  # fmt: skip
    efficiency = worked(
        charge.volumetric_efficiency_vietnamese,
        ratio, temperature, heating, intake, start.charge_pressure, data.charge_up, correction, data.scavenging,
        residual, exponent,
    )  # fmt: skip
    return fraction, begin, efficiency


def _combustion(worked: Worked, data: GrinevetskyData, heat: Burning, mixed: Mixture, end: _Compressed) -> _Burnt:
    law, fraction = data.heat_capacities, end.residual_fraction
    celsius = law_zero(law) > 0
    at = worked(charge.compression_celsius, end.temperature) if celsius else end.temperature
    capacity = fresh_heat(worked, law, end.temperature)
    if law != "linear":
        capacity = worked(mixture_heat, capacity, fraction, residual_heat(worked, law, mixed, end.temperature))
    change = worked(combustion.molar_change, mixed.ratio, fraction)
    given = worked(combustion.working_mixture_heat, heat.heating_value, mixed.heat_lost, mixed.fresh, fraction)
    constant, slope = product_coefficients(worked, law, mixed)
    before = (_given(data.heat_use), given, capacity)
    if data.kind == "petrol":
        energy = worked(_ENERGIES["petrol", celsius], *before, at)
    else:
        gas, rise = data.gas_constant, _given(data.pressure_ratio)
        energy = worked(_ENERGIES["diesel", celsius], *before, gas, rise, at, *((change,) if celsius else ()))
        constant = worked(combustion.isobaric_heat_constant, constant, gas)
    temperature = worked(_ROOTS[data.kind, celsius], constant, slope, energy, change)
    if celsius:
        temperature = worked(combustion.combustion_kelvin, temperature)
    return _rise(worked, data, end, change, temperature)


# by kind of engine, and whether the law of heats counts from 0 degrees Celsius
_ENERGIES: dict[tuple[str, bool], Callable[..., Any]] = {
    ("petrol", True): combustion.isochoric_energy,
    ("petrol", False): combustion.isochoric_energy_kelvin,
    ("diesel", True): combustion.dual_energy,
    ("diesel", False): combustion.dual_energy_kelvin,
}
_ROOTS: dict[tuple[str, bool], Callable[..., Any]] = {
    ("petrol", True): combustion.isochoric_celsius,
    ("petrol", False): combustion.isochoric_temperature,
    ("diesel", True): combustion.dual_celsius,
    ("diesel", False): combustion.dual_temperature,
}


def _rise(worked: Worked, data: GrinevetskyData, end: _Compressed, change: float, temperature: float) -> _Burnt:
    """Return pressure and volume at z."""
    if data.kind == "petrol":
        pressure = worked(combustion.isochoric_pressure, end.pressure, change, temperature, end.temperature)
        worked(combustion.real_combustion_pressure, pressure)
        return _Burnt(pressure, temperature, worked(combustion.pressure_rise_ratio, pressure, end.pressure), 1.0)
    rise = _given(data.pressure_ratio)
    pressure = worked(combustion.dual_pressure, end.pressure, rise)
    rho = worked(combustion.cut_off, change, temperature, rise, end.temperature)
    if not 1 <= rho <= data.compression_ratio:
        raise CycleError(
            f"the cut-off ratio comes out as {rho:g}; it lies between 1 and the compression ratio. "
            + ("Lower the pressure_ratio" if rho < 1 else "Check heating value, excess air and heat_use")
        )
    return _Burnt(pressure, temperature, rise, rho)


def _expansion(worked: Worked, data: GrinevetskyData, start: _Intake, end: _Compressed, burnt: _Burnt) -> Corners:
    ratio, exponent = data.compression_ratio, _given(data.expansion_exponent)
    if data.kind == "petrol":
        pressure = worked(combustion.full_expansion_pressure, burnt.pressure, ratio, exponent)
        temperature = worked(combustion.full_expansion_temperature, burnt.temperature, ratio, exponent)
    else:
        delta = worked(combustion.afterexpansion, ratio, burnt.cut_off)
        pressure = worked(combustion.expansion_pressure, burnt.pressure, delta, exponent)
        temperature = worked(combustion.expansion_temperature, burnt.temperature, delta, exponent)
    residual = start.residual_pressure
    found = worked(combustion.residual_temperature_found, temperature, pressure, residual, data.exhaust_exponent)
    worked(combustion.residual_temperature_deviation, found, _given(data.residual_temperature))
    first = _given(data.compression_exponent)
    return Corners(
        residual, start.intake_pressure, end.pressure, burnt.pressure, pressure, burnt.cut_off, first, exponent, ratio,
        data.lost_stroke,
    )  # fmt: skip


def _indicated(
    worked: Worked, data: GrinevetskyData, heat: Burning, mixed: Mixture, start: _Intake, corners: Corners
) -> float:
    """Return the indicated mean pressure. [Pa]"""
    ratio, rise = corners.epsilon, corners.p_z / corners.p_c
    if data.kind == "petrol":
        whole = worked(performance.isochoric_mean_pressure, corners.p_c, ratio, rise, corners.n2, corners.n1)
    else:
        delta = worked.values["afterexpansion"]
        whole = worked(
            performance.dual_mean_pressure,
            corners.p_c, ratio, _given(data.pressure_ratio), corners.rho, corners.n2, delta, corners.n1,
        )  # fmt: skip
    if data.lost_stroke:
        pressure = worked(performance.ported_mean_pressure, _given(data.filling), whole, data.lost_stroke)
    else:
        pressure = worked(performance.filled_mean_pressure, _given(data.filling), whole)
    efficiency = worked(
        performance.indicated_efficiency,
        pressure, heat.air_mass, mixed.excess_air, heat.heating_value, start.density,
        worked.values["volumetric_efficiency"],
    )  # fmt: skip
    worked(performance.indicated_fuel_consumption, heat.heating_value, efficiency)
    return pressure


def _effective(worked: Worked, data: GrinevetskyData, heat: Burning, indicated: float, size: Size) -> None:
    """Work the effective results and the clearance volume of a sized engine."""
    mechanical = worked(performance.mechanical_efficiency, size.effective_pressure, indicated)
    effective = worked(performance.effective_efficiency, worked.values["indicated_efficiency"], mechanical)
    fuel = worked(performance.effective_fuel_consumption, heat.heating_value, effective)
    size.work_results(worked, data, fuel)
    ratio = worked.values.get("geometric_compression_ratio", data.compression_ratio)
    worked(clearance_volume, size.swept_volume, ratio)


def _data_values(data: GrinevetskyData, heat: Burning, start: _Intake) -> dict[str, float]:
    """Return what was put in, by the keys of quantities."""
    return {
        "fuel_heating_value": heat.heating_value,
        "excess_air": _given(data.excess_air),
        "compression_ratio": data.compression_ratio,
        "ambient_temperature": data.ambient_temperature,
        "charge_pressure": start.charge_pressure,
        "charge_temperature": start.charge_temperature,
        "intake_pressure": start.intake_pressure,
        "residual_pressure": start.residual_pressure,
        "residual_temperature": _given(data.residual_temperature),
        "charge_heating": _given(data.heating),
        "compression_exponent": _given(data.compression_exponent),
        "expansion_exponent": _given(data.expansion_exponent),
        "heat_use": _given(data.heat_use),
        "filling_factor": _given(data.filling),
        "cut_off": 1.0,
        "lost_stroke": data.lost_stroke,
        "strokes_per_cycle": float(data.strokes),
        "cylinder_count": float(data.cylinders),
    } | ({"pressure_rise_ratio": data.pressure_ratio} if data.pressure_ratio and data.kind == "diesel" else {})


def _given(value: Given | None) -> Given:
    """Return a value that the usual ones have filled in."""
    if value is None:
        raise CycleError("a value of the cycle is missing; give it in the data")
    return value
