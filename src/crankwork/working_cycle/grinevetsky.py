"""The working cycle by Grinevetsky and Mazing: fuel, charge, compression, burning, expansion, results, size."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from crankwork.formula.known import Known
from crankwork.formula.ranges import range_notices
from crankwork.formula.worked import Worked
from crankwork.loads.gas import clearance_volume
from crankwork.locale import Refusal
from crankwork.working_cycle import charge, combustion, performance
from crankwork.working_cycle.calculated_cycle import CalculatedCycle, Corners, Notice
from crankwork.working_cycle.cycle_data import GrinevetskyData, traced_cycle_inputs, with_usual_values
from crankwork.working_cycle.fuels import FUELS, CycleError, burning
from crankwork.working_cycle.heat_capacities import fresh_heat, mixture_heat, product_coefficients, residual_heat
from crankwork.working_cycle.mixture import mixture
from crankwork.working_cycle.sizing import heat_balance, sized, work_power
from crankwork.working_cycle.validity import cycle_notices

# inputs that are shown with the results
_SHOWN = (
    "fuel_heating_value", "excess_air", "compression_ratio", "ambient_temperature", "charge_pressure",
    "charge_temperature", "intake_pressure", "residual_pressure", "residual_temperature", "charge_heating",
    "compression_exponent", "expansion_exponent", "heat_use", "filling_factor", "cut_off", "lost_stroke",
    "strokes_per_cycle", "cylinder_count", "pressure_rise_ratio",
)  # fmt: skip
# the laws of heats are fitted up to this temperature before combustion [K]
_HOTTEST = 3000.0


def grinevetsky(data: GrinevetskyData) -> CalculatedCycle:
    """Return the working cycle of an engine.

    Values in the order of textbooks, corners of the theoretical diagram, notices. `data`: with power, or bore and
    stroke, the engine is sized too. Source: kolchin_demidov_2008, ch. 1, 3, 4; nguyen_tat_tien_2000.
    """
    full, assumed = with_usual_values(data)
    worked = traced_cycle_inputs(data, full)
    burning(worked, full.fuel or FUELS[full.kind])
    mixture(worked)
    _intake(worked, full)
    _compression(worked, full)
    _combustion(worked, full)
    _expansion(worked, full)
    _indicated(worked, full)
    notices: list[Notice] = [("cycle_assumed", {"names": ", ".join(assumed)})] if assumed else []
    if full.power or full.stroke:
        notices += sized(worked, full)
        _effective(worked, full)
        heat_balance(worked, full)
    memory = {key: worked[key] for key in _SHOWN if key in worked.known and key not in worked.found} | worked.found
    notices += cycle_notices(full.kind, full.heat_capacities, {key: traced.value for key, traced in memory.items()})
    notices += range_notices(memory.values())
    return CalculatedCycle(full.kind, 180.0 * full.strokes, _corners(worked), memory, tuple(notices))


def _corners(worked: Worked) -> Corners:
    names = (
        "residual_pressure", "intake_pressure", "compression_pressure", "combustion_pressure", "expansion_pressure",
        "cut_off", "compression_exponent", "expansion_exponent", "compression_ratio", "lost_stroke",
    )  # fmt: skip
    return Corners(*(worked[name] for name in names))


def _intake(worked: Worked, data: GrinevetskyData) -> None:
    if data.charge_pressure is None:
        worked.known["charge_pressure"] = worked["ambient_pressure"].named("charge_pressure")
    if data.charge_temperature is None and data.charge_pressure is None:
        worked.known["charge_temperature"] = worked["ambient_temperature"].named("charge_temperature")
    elif data.charge_temperature is None:
        worked(charge.compressor_temperature)
        worked(charge.cooled_charge_temperature)
    warm = worked["charge_temperature"].value + worked["charge_heating"].value
    if min(warm, worked["charge_temperature"].value) <= 0:
        raise CycleError(Refusal("charge_cold", temperature=warm))
    worked(charge.charge_density)
    if data.intake_pressure is None:
        worked(charge.intake_pressure_loss)
        worked(charge.intake_pressure)
    intake, residual = worked["intake_pressure"].value, worked["residual_pressure"].value
    if data.compression_ratio * data.charge_up * intake <= data.scavenging * residual:
        raise CycleError(Refusal("intake_weak", intake=intake / 1e6, residual=residual / 1e6))


def _compression(worked: Worked, data: GrinevetskyData) -> None:
    for function in _FILLINGS[data.intake_school]:
        worked(function)
    if data.lost_stroke:
        closed = worked["volumetric_efficiency"].named("volumetric_efficiency.before_ports")
        worked(performance.ported_volumetric_efficiency, eta_v=closed)
        worked(charge.geometric_compression_ratio)
    worked(charge.compression_pressure)
    temperature = worked(charge.compression_temperature).value
    if temperature > _HOTTEST:
        raise CycleError(Refusal("compression_hot", temperature=temperature))


# residual gas, temperature and volumetric efficiency at the end of intake
_FILLINGS: dict[str, tuple[Callable[..., Any], ...]] = {
    "kolchin": (charge.residual_fraction, charge.intake_temperature, charge.volumetric_efficiency),
    "vietnamese": (
        charge.residual_fraction_vietnamese,
        charge.intake_temperature_vietnamese,
        charge.volumetric_efficiency_vietnamese,
    ),
}


def _combustion(worked: Worked, data: GrinevetskyData) -> None:
    law = data.heat_capacities
    celsius = law == "kolchin"
    worked(combustion.molar_change)
    worked(combustion.working_mixture_heat)
    product_coefficients(worked, law)
    temperature = worked(charge.compression_celsius) if celsius else worked["compression_temperature"]
    capacity = fresh_heat(worked, law, temperature)
    if law == "linear":
        # its fresh charge includes the residual gas
        worked.known["mixture_heat"] = capacity
    else:
        residual_heat(worked, law, temperature)
        worked(mixture_heat)
    constant = {}
    if data.kind == "petrol":
        worked(combustion.isochoric_energy, th_gas=temperature)
    else:
        worked(combustion.dual_energy, th_gas=temperature)
        constant["a_prod"] = worked(combustion.isobaric_heat_constant)
    worked(combustion.burnt_celsius if celsius else combustion.burnt_temperature, **constant)
    if celsius:
        worked(combustion.combustion_kelvin)
    _rise(worked, data)


def _rise(worked: Worked, data: GrinevetskyData) -> None:
    """Calculate pressure and volume at z."""
    if data.kind == "petrol":
        worked(combustion.isochoric_pressure)
        worked(combustion.real_combustion_pressure)
        worked(combustion.pressure_rise_ratio)
        return
    worked(combustion.dual_pressure)
    rho = worked(combustion.cut_off).value
    if not 1 <= rho <= data.compression_ratio:
        raise CycleError(Refusal("cut_off_low" if rho < 1 else "cut_off_high", ratio=rho))


def _expansion(worked: Worked, data: GrinevetskyData) -> None:
    if data.kind == "diesel":
        worked(combustion.afterexpansion)
    expansion_ratio = _whole_expansion(worked, data)
    worked(combustion.expansion_pressure, **expansion_ratio)
    worked(combustion.expansion_temperature, **expansion_ratio)
    worked(combustion.residual_temperature_found)
    worked(combustion.residual_temperature_deviation)


def _whole_expansion(worked: Worked, data: GrinevetskyData) -> dict[str, Known]:
    """Return the ratio of the whole expansion as an argument; in petrol engines it equals the compression ratio."""
    if data.kind == "petrol":
        return {"delta_post": worked["compression_ratio"]}
    return {"delta_post": worked["afterexpansion"]}


def _indicated(worked: Worked, data: GrinevetskyData) -> None:
    worked(performance.theoretical_mean_pressure, **_whole_expansion(worked, data))
    worked(performance.filled_mean_pressure)
    worked(performance.indicated_efficiency)
    worked(performance.fuel_consumption, "indicated_fuel_consumption", eta_e=worked["indicated_efficiency"])


def _effective(worked: Worked, data: GrinevetskyData) -> None:
    """Calculate the effective results and the clearance volume of a sized engine."""
    worked(performance.mechanical_efficiency)
    worked(performance.effective_efficiency)
    worked(performance.fuel_consumption)
    work_power(worked, data)
    geometric_ratio = worked.known.get("geometric_compression_ratio", worked["compression_ratio"])
    worked(clearance_volume, r_c=geometric_ratio)
