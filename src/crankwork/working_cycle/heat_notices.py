"""Values of a cycle from the heat released that lie beyond the usual or the range of its correlations."""

from __future__ import annotations

import math
from collections.abc import Mapping

from crankwork.working_cycle.closed_gas import ClosedGas
from crankwork.working_cycle.heat_data import HeatReleaseData

# wide ranges of practice over petrol and diesel engines, no limits of the formulas themselves
_SHAPE = (0.1, 5.0)
_DURATION = (20.0, 120.0)
_HEAT_RATIO = (1.2, 1.42)
_WALL_SHARE = (0.05, 0.4)
_HOTTEST = 2800.0
_ROUGH, _KNOCK = 0.5e6, 0.8e6

Notice = tuple[str, Mapping[str, float | str]]


def heat_notices(data: HeatReleaseData, gas: ClosedGas, values: Mapping[str, float]) -> tuple[Notice, ...]:
    """Return what is beyond the usual; it is said, and used."""
    hottest = values["cylinder_temperature_max"]
    found: list[Notice] = []
    if gas.heat:
        found += _outside("heat_shape", data.burning_shape, _SHAPE)
        found += _outside("heat_duration", data.burning_duration, _DURATION)
    coldest = data.heat_ratio + data.heat_ratio_slope * data.shut_temperature
    for ratio in sorted({coldest, data.heat_ratio + data.heat_ratio_slope * hottest}):
        found += _outside("heat_ratio", ratio, _HEAT_RATIO)
    if hottest > _HOTTEST:
        found.append(("heat_temperature", {"temperature": hottest, "limit": _HOTTEST}))
    if gas.heat and data.has_wall_loss:
        share = values["wall_heat"] / values["heat_released"]
        found += _outside("heat_walls", 100 * share, (100 * _WALL_SHARE[0], 100 * _WALL_SHARE[1]))
    steepest = math.radians(values["pressure_rise_max"])
    if steepest > _ROUGH:
        code = "heat_knock" if steepest > _KNOCK else "heat_rough"
        limit = _KNOCK if steepest > _KNOCK else _ROUGH
        angle = math.degrees(values["pressure_rise_max_angle"])
        found.append((code, {"rise": steepest / 1e6, "angle": angle, "limit": limit / 1e6}))
    return tuple(found)


def _outside(code: str, value: float, usual: tuple[float, float]) -> list[Notice]:
    if usual[0] <= value <= usual[1]:
        return []
    return [(code, {"value": value, "low": usual[0], "high": usual[1]})]
