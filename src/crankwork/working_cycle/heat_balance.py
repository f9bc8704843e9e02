"""Where the heat of the fuel goes."""

from __future__ import annotations

from crankwork.steps import Worked
from crankwork.working_cycle import engine_size
from crankwork.working_cycle.cycle_data import GrinevetskyData
from crankwork.working_cycle.fuels import Burning, CycleError
from crankwork.working_cycle.heat_capacities import fresh_heat, law_zero, residual_heat
from crankwork.working_cycle.mixture import Mixture
from crankwork.working_cycle.sizing import Size

PARTS = ("effective", "to_coolant", "to_exhaust", "unburnt", "rest")


def heat_balance(worked: Worked, data: GrinevetskyData, heat: Burning, mixed: Mixture, size: Size) -> None:
    """Work the heat balance of a sized engine: power, coolant, exhaust, unburnt, rest, and their shares.

    Parameters
    ----------
    worked : Worked
        Holds the power and the fuel already; where the steps are kept.
    data : GrinevetskyData
        Of the engine.
    heat : Burning
        Of the fuel.
    mixed : Mixture
        Charge and products.
    size : Size
        Of the engine.

    References
    ----------
    kolchin_demidov_2008, ch. 4.
    """
    fuel, power = worked.values["fuel_rate"], worked.values["effective_power"]
    whole = worked(engine_size.heat_supplied, heat.heating_value, fuel)
    cooling = (data.cooling_factor, float(data.cylinders), size.bore, data.cooling_exponent, data.rotational_speed)
    if data.kind == "petrol":
        lost = (heat.heating_value, mixed.heat_lost, mixed.excess_air)
        coolant = worked(engine_size.petrol_heat_to_coolant, *cooling, *lost)
    else:
        coolant = worked(engine_size.diesel_heat_to_coolant, *cooling, mixed.excess_air)
    gas = _exhaust(worked, data, mixed, fuel)
    unburnt = worked(engine_size.heat_unburnt, mixed.heat_lost, fuel) if mixed.is_rich else 0.0
    rest = worked(engine_size.heat_rest, whole, power, coolant, gas, unburnt)
    for name, part in zip(PARTS, (power, coolant, gas, unburnt, rest), strict=True):
        worked(engine_size.heat_share, part, whole, key=f"heat_share.{name}")


def _exhaust(worked: Worked, data: GrinevetskyData, mixed: Mixture, fuel: float) -> float:
    """Return the heat of the exhaust gas. [W]"""
    law, hot = data.heat_capacities, data.residual_temperature
    if hot is None:
        raise CycleError("the heat of the exhaust gas needs the temperature of the residual gas")
    cold = worked.values.get("charge_temperature") or data.charge_temperature or data.ambient_temperature
    enthalpies = []
    for name, temperature in (("exhaust", hot), ("charge", cold)):
        heat = (
            residual_heat(worked, law, mixed, temperature, key="product_heat.exhaust")
            if name == "exhaust"
            else fresh_heat(worked, law, temperature, key="fresh_charge_heat.charge")
        )
        counted = temperature - law_zero(law)
        enthalpies.append(
            worked(engine_size.molar_enthalpy, heat, data.gas_constant, counted, key=f"molar_enthalpy.{name}")
        )
    return worked(engine_size.heat_to_exhaust, fuel, mixed.products, enthalpies[0], mixed.fresh, enthalpies[1])
