"""Notices of unusual values in a calculated cycle, which is used as it is."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from crankwork.formula.traced_value import FormulaCall, TracedValue, in_order, to_number
from crankwork.quantities import QUANTITIES
from crankwork.units import from_si
from crankwork.working_cycle.calculated_cycle import Notice
from crankwork.working_cycle.closed_gas import ClosedGas, HeatReleaseData
from crankwork.working_cycle.heat_capacities import HIGH_LIMIT, LOW_LIMIT, ZERO_CELSIUS, HeatLaw


class Range(NamedTuple):
    """Usual values of a quantity in its display unit, with their source."""

    low: float
    high: float
    source: str = "kolchin_demidov_2008, ch. 3"


USUAL: Mapping[str, Mapping[str, Range]] = {
    "petrol": {
        "excess_air": Range(0.80, 1.20),
        "residual_fraction": Range(0.03, 0.10),
        "volumetric_efficiency": Range(0.70, 0.96),
        "compression_exponent": Range(1.34, 1.39),
        "compression_pressure": Range(0.9, 2.0),
        "compression_temperature": Range(600, 800),
        "combustion_temperature": Range(2400, 3100),
        "combustion_pressure": Range(3.5, 8.5),
        "expansion_exponent": Range(1.23, 1.30),
        "residual_temperature": Range(900, 1100),
    },
    "diesel": {
        "excess_air": Range(1.2, 2.2),
        "residual_fraction": Range(0.0, 0.06),
        "volumetric_efficiency": Range(0.80, 0.97),
        "compression_exponent": Range(1.32, 1.42),
        "compression_pressure": Range(3.0, 8.0),
        "compression_temperature": Range(700, 1000),
        "combustion_temperature": Range(1700, 2400),
        "combustion_pressure": Range(5.0, 15.0),
        "expansion_exponent": Range(1.15, 1.30),
        "residual_temperature": Range(600, 900),
    },
}
# of petrol: a spark lights the mixture
FLAMMABLE = Range(0.5, 1.6, "heywood_1988, ch. 9")
# of petrol: knocks above it as a rule
KNOCK_COMPRESSION_RATIO = Range(4.0, 12.0, "heywood_1988, ch. 9")
LARGEST_DEVIATION = 0.10


def cycle_notices(kind: str, law: HeatLaw, values: Mapping[str, float]) -> tuple[Notice, ...]:
    """Return notices of unusual values in a cycle.

    `law`: law of heats, for the range of its table.
    """
    notices: list[Notice] = []
    for key, usual in USUAL[kind].items():
        value = float(from_si(values[key], QUANTITIES[key].metric))
        if not usual.low <= value <= usual.high:
            notices.append((f"cycle_{key}", {"value": value, "low": usual.low, "high": usual.high}))
    if kind == "petrol":
        notices += _spark(values)
    if law == "kolchin":
        notices += _heat_table(values)
    deviation = values["residual_temperature_deviation"]
    if abs(deviation) > LARGEST_DEVIATION:
        assumed, result = values["residual_temperature"], values["residual_temperature_found"]
        percent = 100 * deviation
        notices.append(("cycle_residual_check", {"assumed": assumed, "found": result, "percent": percent}))
    return tuple(notices)


def _spark(values: Mapping[str, float]) -> list[Notice]:
    notices: list[Notice] = []
    air, ratio = values["excess_air"], values["compression_ratio"]
    if not FLAMMABLE.low <= air <= FLAMMABLE.high:
        notices.append(("cycle_flammability", {"value": air, "low": FLAMMABLE.low, "high": FLAMMABLE.high}))
    limit, hottest = KNOCK_COMPRESSION_RATIO.high, USUAL["petrol"]["compression_temperature"].high
    if ratio > limit or values["compression_temperature"] > hottest:
        numbers = {"compression_ratio": ratio, "temperature": values["compression_temperature"]}
        notices.append(("cycle_knock", {**numbers, "limit": limit, "hottest": hottest}))
    return notices


def _heat_table(values: Mapping[str, float]) -> list[Notice]:
    burnt = values["combustion_temperature"] - ZERO_CELSIUS
    if LOW_LIMIT <= burnt <= HIGH_LIMIT:
        return []
    return [("cycle_heat_high", {"value": burnt, "low": LOW_LIMIT, "high": HIGH_LIMIT})]


# wide ranges of practice over petrol and diesel engines, not limits of the formulas
_SHAPE = (0.1, 5.0)
_DURATION = (20.0, 120.0)
_HEAT_RATIO = (1.2, 1.42)
_WALL_SHARE = (0.05, 0.4)
_HOTTEST = 2800.0
_ROUGH, _KNOCK = 0.5e6, 0.8e6


def heat_notices(data: HeatReleaseData, gas: ClosedGas, values: Mapping[str, float]) -> tuple[Notice, ...]:
    """Return notices of values beyond the usual ranges."""
    hottest = values["cylinder_temperature_max"]
    notices: list[Notice] = []
    if gas.heat:
        notices += _outside("heat_shape", data.burning_shape, _SHAPE)
        notices += _outside("heat_duration", data.burning_duration, _DURATION)
    coldest = data.heat_ratio + data.heat_ratio_slope * data.shut_temperature
    for ratio in sorted({coldest, data.heat_ratio + data.heat_ratio_slope * hottest}):
        notices += _outside("heat_ratio", ratio, _HEAT_RATIO)
    if hottest > _HOTTEST:
        notices.append(("heat_temperature", {"temperature": hottest, "limit": _HOTTEST}))
    if gas.heat and data.has_wall_loss:
        share = values["wall_heat"] / values["heat_released"]
        notices += _outside("heat_walls", 100 * share, (100 * _WALL_SHARE[0], 100 * _WALL_SHARE[1]))
    steepest = math.radians(values["pressure_rise_max"])
    if steepest > _ROUGH:
        code = "heat_knock" if steepest > _KNOCK else "heat_rough"
        limit = _KNOCK if steepest > _KNOCK else _ROUGH
        angle = math.degrees(values["pressure_rise_max_angle"])
        notices.append((code, {"rise": steepest / 1e6, "angle": angle, "limit": limit / 1e6}))
    return tuple(notices)


def _outside(code: str, value: float, usual: tuple[float, float]) -> list[Notice]:
    if usual[0] <= value <= usual[1]:
        return []
    return [(code, {"value": value, "low": usual[0], "high": usual[1]})]


CODE = "formula_range"


def range_notices(traced_values: Iterable[TracedValue]) -> Iterator[tuple[str, Mapping[str, float | str]]]:
    """Yield where formulas that traced values are made of are used outside the range that their source vouches for.

    Of each formula and argument at most one notice, about the value farthest outside, in the unit of the argument.
    """
    farthest: dict[tuple[str, str], tuple[float, Mapping[str, float | str]]] = {}
    for node in (traced.node for traced in in_order(traced_values)):
        if not isinstance(node, FormulaCall):
            continue
        for name, operand in zip(node.formula.arguments, node.inputs, strict=True):
            if name not in node.formula.valid:
                continue
            (low, high), value, key = node.formula.valid[name], float(to_number(operand)), (node.formula.name, name)
            outside = max(low - value, value - high)
            if outside > max(0.0, farthest.get(key, (0.0, {}))[0]):
                about: dict[str, float | str] = {"quantity": node.formula.quantity, "argument": name}
                farthest[key] = outside, about | {"value": value, "low": low, "high": high}
    yield from ((CODE, values_of_notice) for _, values_of_notice in farthest.values())
