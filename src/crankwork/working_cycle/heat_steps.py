"""Burning and heat to the walls at the greatest pressure, worked out step by step."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from crankwork.formula.known import Found, Known
from crankwork.formula.worked import Worked
from crankwork.loads import gas as gas_formulas
from crankwork.working_cycle import first_law, wiebe, woschni
from crankwork.working_cycle.closed_gas import ClosedGas


def work_peak(gas: ClosedGas, memory: Mapping[str, Known], worked: Worked) -> None:
    """Work out burning, heat to the walls and pressure rise at the greatest pressure."""
    data, (start, end) = gas.data, gas.burning
    pressure = memory["cylinder_pressure_max"].named("cylinder_pressure")
    degrees = math.degrees(memory["cylinder_pressure_max_angle"].value)
    degrees += data.cycle if degrees < gas.first else 0.0
    volume, growth = (
        Known(Found(float(one(np.array([degrees]))[0]), "value", at=degrees), key)
        for one, key in ((gas.volume_at, "cylinder_volume"), (gas.volume_rate_at, ""))
    )
    worked.known |= {"cylinder_pressure": pressure, "cylinder_volume": volume}
    worked.known["crank_angle"] = Known(Found(math.radians(degrees), "max_angle", (pressure,), degrees), "crank_angle")
    if start < degrees < end:
        worked(wiebe.burning_progress)
        worked(wiebe.wiebe_burnt_fraction)
        worked(wiebe.wiebe_burning_rate)
    else:
        worked.absent("burning_rate")
    worked(first_law.gas_temperature)
    if worked["gas_heat_ratio_slope"].is_absent:
        worked.known["gas_heat_ratio"] = worked["gamma_cyl_0"]
    else:
        worked(first_law.gas_heat_ratio)
    if data.has_wall_loss:
        _work_walls(gas, pressure, worked, woschni.EXPANSION if degrees > start else woschni.COMPRESSION)
    else:
        worked.absent("wall_heat_rate")
    worked(first_law.pressure_rise, V_phi=growth)


def _work_walls(gas: ClosedGas, pressure: Known, worked: Worked, factor: woschni.GasSpeedFactors) -> None:
    """Work out the heat to the walls."""
    motored = worked(gas_formulas.polytropic_pressure, "motored_pressure", p_1=worked["p_shut"])
    higher = pressure if pressure.value > motored.value else motored
    worked(woschni.woschni_gas_speed, C_speed=factor.piston, C_burn=factor.burning, p_cyl=higher)
    worked(woschni.woschni_coefficient)
    below_head = worked["cylinder_volume"] - worked["clearance_volume"]
    x = (below_head / worked["piston_area"]).named("piston_displacement")
    worked(woschni.wall_area, pi=math.pi, x=x)
    worked(woschni.wall_heat_rate, w=Known(Found(gas.speed, "value"), "speed"))
