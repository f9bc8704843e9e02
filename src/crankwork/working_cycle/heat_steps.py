"""Burning and heat to the walls at the greatest pressure, worked out step by step."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from crankwork.loads import gas as gas_formulas
from crankwork.steps import Worked
from crankwork.working_cycle import first_law, wiebe, woschni
from crankwork.working_cycle.closed_gas import ClosedGas


def work_peak(gas: ClosedGas, values: Mapping[str, float], worked: Worked) -> None:
    """Work out burning, heat to the walls and pressure rise at the greatest pressure.

    Parameters
    ----------
    gas : ClosedGas
        The enclosed gas.
    values : mapping of str to float
        With the greatest pressure and its crank angle. [SI]
    worked : Worked
        Where the steps are kept.
    """
    data, (start, end) = gas.data, gas.burning
    degrees = values["cylinder_pressure_max_angle"]
    degrees += data.cycle if degrees < gas.first else 0.0
    pressure = values["cylinder_pressure_max"]
    at = np.array([degrees])
    volume, growth = float(gas.volume_at(at)[0]), float(gas.volume_rate_at(at)[0])
    rate = 0.0
    if start < degrees < end:
        progress = worked(wiebe.burning_progress, *(math.radians(one) for one in (degrees, start, end - start)))
        worked(wiebe.wiebe_burnt_fraction, progress, data.burning_shape)
        rate = worked(wiebe.wiebe_burning_rate, progress, data.burning_shape, math.radians(end - start))
    temperature = worked(first_law.gas_temperature, pressure, volume, gas.mass, data.gas_constant)
    ratio = worked(first_law.gas_heat_ratio, data.heat_ratio, data.heat_ratio_slope, temperature)
    wall = 0.0
    if data.has_wall_loss:
        factor = woschni.EXPANSION if degrees > start else woschni.COMPRESSION
        shut = (data.shut_pressure, gas.shut_volume)
        motored = worked(gas_formulas.polytropic_pressure, *shut, volume, data.motored_exponent, key="motored_pressure")
        state = (factor.piston, gas.piston_speed, factor.burning, gas.swept, data.shut_temperature, *shut)
        speed = worked(woschni.woschni_gas_speed, *state, max(pressure, motored), motored)
        coefficient = worked(woschni.woschni_coefficient, data.bore, pressure, temperature, speed)
        x = (volume - gas.clearance) / float(gas_formulas.piston_area(math.pi, data.bore))
        area = worked(woschni.wall_area, *gas.areas, math.pi, data.bore, x)
        wall = worked(woschni.wall_heat_rate, coefficient, area, temperature, data.wall_temperature, gas.speed)
    worked(first_law.pressure_rise, ratio, volume, gas.heat, rate, wall, pressure, growth)
