"""Where the heat of the fuel goes."""

from __future__ import annotations

from crankwork.formula.known import absent
from crankwork.formula.worked import Worked
from crankwork.working_cycle import engine_size
from crankwork.working_cycle.cycle_data import GrinevetskyData
from crankwork.working_cycle.heat_capacities import as_counted, fresh_heat, residual_heat

PARTS = {
    "effective": "effective_power", "to_coolant": "heat_to_coolant", "to_exhaust": "heat_to_exhaust",
    "unburnt": "heat_unburnt", "rest": "heat_rest",
}  # fmt: skip


def heat_balance(worked: Worked, data: GrinevetskyData) -> None:
    """Work the heat balance of a sized engine: power, coolant, exhaust, unburnt, rest, and their shares.

    `worked`: knows charge, products, power and fuel; where it is kept. Source: kolchin_demidov_2008, ch. 4.
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
    """Work the heat of the exhaust gas."""
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
        worked(engine_size.molar_enthalpy, f"molar_enthalpy.{name}", mc_gas=heat, th_gas=at)
        for name, heat, at in zip(("exhaust", "charge"), heats, (hot, cold), strict=True)
    )
    worked(engine_size.heat_to_exhaust, h_prod=exhaust, h_fresh=fresh)
