"""The working cycle from heat release: Wiebe combustion, heat to the walls, first law, integrated over the crank angle.

From intake closing to exhaust opening the gas is one zone of constant mass; the rest of the cycle is simplified.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from crankwork.formula.known import Found, Known, absent
from crankwork.formula.worked import Worked
from crankwork.kinematics.crank_grid import Array
from crankwork.loads import gas as gas_formulas
from crankwork.loads.cycle import quadrature
from crankwork.loads.indicator import IndicatorDiagram, Segment, VolumeAt
from crankwork.loads.monotone import hermite
from crankwork.loads.pressure import at_angle, remembered_pressure
from crankwork.working_cycle import first_law, wiebe, woschni
from crankwork.working_cycle.calculated_cycle import Calculated
from crankwork.working_cycle.closed_gas import ClosedGas, closed_gas, volume_when
from crankwork.working_cycle.gas_exchange import connecting_cubic, constant_pressure, from_before_zero, within_cycle
from crankwork.working_cycle.heat_data import HeatReleaseData, Stage, stages
from crankwork.working_cycle.validity import heat_notices

_STEP, _LEAST_STEPS, _DOUBLINGS = 0.5, 40, 5
_AGREEMENT = 1e-9
_FINE = 2001
_RELATIVE, _ABSOLUTE = 1e-11, 1e-12


class HeatReleaseTrace(NamedTuple):
    """The closed period point by point, arrays of shape (n,).

    Crank angle [deg], pressure [Pa], temperature [K], burnt fraction [-], pressure rise [Pa/rad], heat to the
    walls [J/rad]. Angles continue past the end of the cycle.
    """

    degrees: Array
    pressure: Array
    temperature: Array
    burnt: Array
    pressure_rise: Array
    wall_heat_rate: Array


@dataclass(frozen=True)
class HeatReleaseResult:
    """A cycle from heat release."""

    calculated: Calculated  # Diagram, single values, notices
    trace: HeatReleaseTrace  # The closed period point by point
    # Work and heat to the walls by quadrature over the diagram, and the residual of the first law with them [J]
    again: Mapping[str, float]


def heat_release(
    data: HeatReleaseData, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]
) -> HeatReleaseResult:
    """Return the cycle of a heat release (heywood_1988, ch. 9 and 12)."""
    dead_centres = from_before_zero(dead_centres)
    worked = Worked()
    gas = closed_gas(data, volume_at, volume_rate_at, dead_centres, worked)
    periods = [stage for stage in stages(data, dead_centres) if stage.end > stage.start]
    solved = _solved(gas, periods, tuple(worked.known.values()))
    segments = [segment for segment, _ in solved]
    trace = _trace(gas, solved)
    # the pressure has been integrated already: its column needs no volume
    diagram = _diagram(data, segments, dead_centres, (worked["residual_pressure"], worked["intake_pressure"]))
    pressure = remembered_pressure(diagram, absent("cylinder_volume"))
    work, wall = (float(sum(change[i] for _, change in solved)) for i in (1, 2))
    stored = gas.energy_change(trace.temperature[-1])
    # combustion ends before the exhaust opens
    burnt = wiebe.wiebe_burnt_fraction(1.0, worked["burning_shape"]).named("burnt_fraction.exhaust")
    memory = {"fuel_heat": worked["fuel_heat"], "heat_released": (worked["fuel_heat"] * burnt).named("heat_released")}
    memory |= {
        key: Known(Found(value, "integral", (pressure,)), key)
        for key, value in (("wall_heat", wall), ("closed_work", work), ("internal_energy_change", stored))
    }
    left = memory["heat_released"] - memory["wall_heat"] - memory["closed_work"] - memory["internal_energy_change"]
    memory["first_law_residual"] = left.named("first_law_residual")
    memory |= _extremes(gas, periods, segments, trace, pressure)
    memory["cylinder_temperature_max"] = _hottest(gas, memory, pressure, worked)
    memory["indicated_work"] = Known(Found(diagram.work(volume_at), "integral", (pressure,)), "indicated_work")
    again = _by_quadrature(gas, periods, segments)
    again["first_law_residual"] = memory["heat_released"].value - again["wall_heat"] - again["closed_work"] - stored
    at_peak = worked.again(".peak")
    work_peak(gas, memory, at_peak)
    peak = {
        traced.key: traced for traced in (*worked.found.values(), *at_peak.found.values()) if traced.key not in memory
    }
    calculated = Calculated(diagram, memory, (), peak=peak)
    return HeatReleaseResult(calculated._replace(notices=heat_notices(data, gas, calculated.values)), trace, again)


def _solved(gas: ClosedGas, periods: list[Stage], inputs: tuple[Known, ...]) -> list[tuple[Segment, Array]]:
    """Return the pressure curve of each stage, and the changes of pressure, work and heat to the walls over it."""
    results = []
    pressure = gas.data.shut_pressure
    scale = pressure * gas.shut_volume + gas.heat
    for period in periods:
        dense, final = gas.integrated(period, pressure, _RELATIVE, _ABSOLUTE)
        start = np.array([pressure, 0.0, 0.0])
        count = max(_LEAST_STEPS, int(np.ceil((period.end - period.start) / _STEP)))
        for _ in range(_DOUBLINGS + 1):
            segment = _curve(gas, period, dense, count, (pressure, float(final[0])))
            if abs(segment.work(gas.volume_at) - final[1]) <= _AGREEMENT * scale:
                break
            count *= 2
        results.append((replace(segment, operands=inputs), final - start))
        pressure = float(final[0])
    return results


def _curve(gas: ClosedGas, period: Stage, dense: VolumeAt, count: int, ends: tuple[float, float]) -> Segment:
    """Return the cubics through the solution, with the slopes of the first law."""
    # with a small exponent combustion begins abruptly, which needs denser knots at the start
    grading = max(1.0, 3.0 - gas.data.burning_shape) if period.burns else 1.0
    knots = period.start + (period.end - period.start) * np.linspace(0.0, 1.0, count + 1) ** grading
    knots[-1] = period.end
    pressures = dense(knots)[0]
    pressures[[0, -1]] = ends
    slopes = np.radians(gas.rates(knots, pressures, period)[0])
    return Segment(period.start, period.end, "rounded", knots, pressures, slopes)


def _trace(gas: ClosedGas, solved: list[tuple[Segment, Array]]) -> HeatReleaseTrace:
    parts = [segment for segment, _ in solved]
    keep = [slice(1 if number else 0, None) for number in range(len(parts))]
    degrees = np.concatenate([segment.knots[part] for segment, part in zip(parts, keep, strict=True)])
    pressure = np.concatenate([segment.pressures[part] for segment, part in zip(parts, keep, strict=True)])
    slopes = np.degrees(np.concatenate([segment.slopes[part] for segment, part in zip(parts, keep, strict=True)]))
    temperature = gas.temperature(degrees, pressure)
    wall = gas.wall_rate(degrees, pressure, gas.is_burning(degrees))
    return HeatReleaseTrace(degrees, pressure, temperature, gas.burnt(degrees), slopes, wall)


def _by_quadrature(gas: ClosedGas, periods: list[Stage], segments: list[Segment]) -> dict[str, float]:
    """Return work and heat to the walls as integrals over the diagram, independent of the differential equation."""
    work = wall = 0.0
    for period, segment in zip(periods, segments, strict=True):
        nodes, weights = quadrature(segment.knots)
        pressure = hermite(segment.knots, segment.pressures, segment.slopes, nodes)
        work += segment.work(gas.volume_at)
        wall += float(weights @ gas.wall_rate(nodes, pressure, np.full(len(nodes), period.has_burnt)))
    return {"closed_work": work, "wall_heat": wall}


def _extremes(
    gas: ClosedGas, periods: list[Stage], segments: list[Segment], trace: HeatReleaseTrace, column: Known
) -> dict[str, Known]:
    """Return the greatest pressure, temperature and pressure rise, with their angles."""
    diagram = IndicatorDiagram(tuple(segments), {})

    def pressure(degrees: Array) -> Array:
        return diagram.pressure(degrees, degrees)

    def temperature(degrees: Array) -> Array:
        return gas.temperature(degrees, pressure(degrees))

    extremes: dict[str, Known] = {}
    for key, function, values in (
        ("cylinder_pressure", pressure, trace.pressure),
        ("cylinder_temperature", temperature, trace.temperature),
    ):
        top = int(np.argmax(values))
        fine = np.linspace(trace.degrees[max(top - 1, 0)], trace.degrees[min(top + 1, len(values) - 1)], _FINE)
        extremes |= _greatest(key, [(fine, function(fine))], column, gas.data.cycle)
    steepest = []
    for period, segment in zip(periods, segments, strict=True):
        top = int(np.argmax(segment.slopes))
        fine = np.linspace(segment.knots[max(top - 1, 0)], segment.knots[min(top + 1, len(segment.knots) - 1)], _FINE)
        rise = gas.rates(fine, hermite(segment.knots, segment.pressures, segment.slopes, fine), period)[0]
        steepest.append((fine, rise))
    return extremes | _greatest("pressure_rise", steepest, column, gas.data.cycle)


def _hottest(gas: ClosedGas, memory: Mapping[str, Known], column: Known, worked: Worked) -> Known:
    """Return the greatest temperature, from pressure and volume at its angle."""
    degrees = math.degrees(memory["cylinder_temperature_max_angle"].value)
    volume = volume_when(worked, float(gas.volume_at(np.array([degrees]))[0]), degrees)
    state = at_angle(column, degrees, "cylinder_pressure"), volume
    hottest = first_law.gas_temperature(*state, worked["gas_mass"], worked["specific_gas_constant"])
    return hottest.named("cylinder_temperature_max")  # type: ignore[no-any-return]


def _greatest(key: str, intervals: list[tuple[Array, Array]], column: Known, cycle: float) -> dict[str, Known]:
    """Return the largest value of all intervals, and its crank angle."""
    value, degrees = max((float(values.max()), float(degrees[np.argmax(values)])) for degrees, values in intervals)
    angle = degrees % cycle
    return {
        f"{key}_max": Known(Found(value, "max", (column,), angle), f"{key}_max"),
        f"{key}_max_angle": Known(Found(math.radians(angle), "max_angle", (column,), angle), f"{key}_max_angle"),
    }


def _diagram(
    data: HeatReleaseData, closed: list[Segment], dead_centres: tuple[float, float], exchange: tuple[Known, Known]
) -> IndicatorDiagram:
    """Return the diagram of the whole cycle, with simplified gas exchange."""
    top, bottom = dead_centres
    first, last = closed[0], closed[-1]
    opens, closes = last.end, first.start + data.cycle
    exhaust, intake = exchange
    segments = list(closed)
    centre = bottom + 360.0
    if data.cycle > 360:
        blown, change, changed = 2 * centre - opens, top + 720 - data.intake_opens, top + 720 + data.exhaust_closes
    else:
        blown, change, changed = centre - data.intake_opens, centre, centre
        intake = exhaust
    low = (blown, exhaust.value, 0.0)
    if blown > opens:
        segments.append(connecting_cubic((opens, float(last.pressures[-1]), float(last.slopes[-1])), low))
    segments.append(constant_pressure(blown, change, exhaust))
    if changed > change:
        segments.append(connecting_cubic((change, exhaust.value, 0.0), (changed, intake.value, 0.0)))
    end = (closes, data.shut_pressure, float(first.slopes[0]))
    charged = centre + data.cycle - 360.0
    segments.append(constant_pressure(changed, min(charged, closes), intake))
    if closes > charged:
        segments.append(connecting_cubic((charged, intake.value, 0.0), end))
    named = {"a": (first.start % data.cycle, data.shut_pressure), "b": (opens % data.cycle, float(last.pressures[-1]))}
    return IndicatorDiagram(within_cycle(segments, data.cycle), named)


def work_peak(gas: ClosedGas, memory: Mapping[str, Known], worked: Worked) -> None:
    """Calculate combustion, heat to the walls and pressure rise at the greatest pressure."""
    data, (start, end) = gas.data, gas.burning
    pressure = memory["cylinder_pressure_max"].named("cylinder_pressure")
    degrees = math.degrees(memory["cylinder_pressure_max_angle"].value)
    degrees += data.cycle if degrees < gas.first else 0.0
    volume, growth = (float(function(np.array([degrees]))[0]) for function in (gas.volume_at, gas.volume_rate_at))
    area = worked["piston_area"]
    slope = Known(Found(growth / area.value, "motion", angle=degrees), "piston_transfer_1")
    worked.known |= {"cylinder_pressure": pressure, "cylinder_volume": volume_when(worked, volume, degrees)}
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
        _work_walls(pressure, worked, woschni.EXPANSION if degrees > start else woschni.COMPRESSION)
    else:
        worked.absent("wall_heat_rate")
    worked(first_law.pressure_rise, V_phi=area * slope)


def _work_walls(pressure: Known, worked: Worked, factor: woschni.GasSpeedFactors) -> None:
    """Calculate the heat to the walls."""
    motored = worked(gas_formulas.polytropic_pressure, "motored_pressure", p_1=worked["p_shut"])
    higher = pressure if pressure.value > motored.value else motored
    worked(woschni.woschni_gas_speed, C_speed=factor.piston, C_burn=factor.burning, p_cyl=higher)
    worked(woschni.woschni_coefficient)
    below_head = worked["cylinder_volume"] - worked["clearance_volume"]
    x = (below_head / worked["piston_area"]).named("piston_displacement")
    worked(woschni.wall_area, pi=math.pi, x=x)
    worked(woschni.wall_heat_rate, w=(math.pi * worked["rotational_speed"] / 30).named("speed"))
