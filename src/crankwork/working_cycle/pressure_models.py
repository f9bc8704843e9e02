"""Pressures for any cylinder: theoretical diagrams, sharp or rounded, heat release, and misfire.

With heat release the gas is one zone of constant mass from intake closing to exhaust opening; Wiebe's law burns it,
heat goes to the walls, and the first law is integrated over the crank angle. The rest of the cycle is simplified.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import ClassVar

import numpy as np

from crankwork.formula.calculation import Calculation
from crankwork.formula.expression import Value
from crankwork.formula.traced_value import ProcedureValue, TracedValue, absent
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.dead_centres import solve_monotone
from crankwork.loads import gas as gas_formulas
from crankwork.loads.curves import hermite
from crankwork.loads.indicator import IndicatorDiagram, Segment, VolumeAt
from crankwork.loads.traced_diagram import at_angle, traced_pressure
from crankwork.locale import ErrorMessage
from crankwork.working_cycle.calculated_cycle import Calculated, CalculatedCycle, Corners
from crankwork.working_cycle.closed_gas import (
    COMPRESSION,
    EXPANSION,
    ClosedGas,
    GasSpeedFactors,
    HeatReleaseData,
    Stage,
    burning_progress,
    closed_gas,
    gas_heat_ratio,
    gas_temperature,
    pressure_rise,
    stages,
    volume_when,
    wall_area,
    wall_heat_rate,
    wiebe_burning_rate,
    wiebe_burnt_fraction,
    woschni_coefficient,
    woschni_gas_speed,
)
from crankwork.working_cycle.diagram_parts import (
    DiagramPart,
    NamedPoint,
    connecting_cubic,
    constant_pressure,
    diagram_of_parts,
    from_before_zero,
    within_cycle,
)
from crankwork.working_cycle.fuels import CycleError
from crankwork.working_cycle.rounding import (
    Rounding,
    Timing,
    motored_diagram,
    rounded_diagram,
    traced_filling_factor,
    traced_rounded_pressure,
)
from crankwork.working_cycle.usual_ranges import heat_notices

# A cylinder is identified by its volume at these crank angles. [deg]
_PROBES = (0.0, 67.0, 131.0, 213.0)
# Solving takes most of a run, and a file is solved once to check it and once to analyse it: cached.
_MAX_SOLUTIONS = 16
_SOLUTIONS: dict[object, Calculated] = {}
_STEP, _LEAST_STEPS, _DOUBLINGS = 0.5, 40, 5
_AGREEMENT = 1e-9
_FINE = 2001
_RELATIVE, _ABSOLUTE = 1e-11, 1e-12


@dataclass(frozen=True)
class CornerPressure:
    """The diagram of a calculated cycle."""

    cycle: CalculatedCycle  # The calculated cycle
    timing: Timing | None = None  # Of valves and ignition, if corners are rounded
    rounding: Rounding = field(default_factory=Rounding)  # How they are rounded
    has_corners: ClassVar[bool] = True

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder."""
        del volume_rate_at
        cycle = self.cycle
        # if corners are rounded, the sharp one is only looked at
        sharp = partial(sharp_diagram, cycle.corners, cycle.angle, volume_at, dead_centres)
        notices = (*cycle.notices, ("cycle_speed", {}))
        if self.timing is None:
            return Calculated(sharp(), cycle.trace, notices, sharp)
        result = rounded_diagram(_numbers(cycle.corners), self.timing, self.rounding, volume_at, dead_centres)
        key = "filling_factor.diagram"
        trace = {**cycle.trace, key: TracedValue(ProcedureValue(result.filling_factor, "integral", cycle.corners), key)}
        rounded = _with_traced_segments(result.diagram, cycle.corners)
        return Calculated(rounded, trace, (*notices, *result.notices), sharp)

    def traced(self, volume: TracedValue, dead_centres: tuple[Value, Value]) -> TracedValue:
        """Return the pressure over the crank angle as a traced column of the volume of a cylinder."""
        timing = Timing(cycle=self.cycle.angle) if self.timing is None else self.timing
        return traced_rounded_pressure(_theory(self.cycle.corners), timing, self.rounding, volume, dead_centres)

    def filling_factor(
        self, value: float, columns: tuple[TracedValue, TracedValue], dead_centres: tuple[Value, Value]
    ) -> TracedValue:
        """Return the filling factor of the rounded diagram, traced to the columns of pressure and volume."""
        timing = self.timing or Timing(cycle=self.cycle.angle)
        return traced_filling_factor(value, _theory(self.cycle.corners), timing, columns, dead_centres)

    def motored(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram of a cylinder without combustion: expansion along the compression line."""
        del volume_rate_at
        theory = self.cycle.corners
        corners = theory._replace(p_z=theory.p_c, p_b=theory.p_a, n2=theory.n1, rho=absent("cut_off", 1.0))
        if self.timing is None:
            return Calculated(sharp_diagram(corners, self.cycle.angle, volume_at, dead_centres), {}, ())
        diagram = motored_diagram(_numbers(corners), self.timing, self.rounding, volume_at, dead_centres)
        return Calculated(_with_traced_segments(diagram, corners), {}, ())


def _theory(corners: Corners) -> dict[str, TracedValue]:
    """Return the corners by name, without `rho` if no combustion is at constant pressure. [SI]"""
    return {name: corner for name, corner in corners._asdict().items() if name != "rho" or corner.value > 1}


def _numbers(corners: Corners) -> dict[str, float]:
    return {name: corner.value for name, corner in _theory(corners).items()}


def _with_traced_segments(diagram: IndicatorDiagram, corners: Corners) -> IndicatorDiagram:
    """Return a diagram whose segments refer to the traced pressures and exponents of the calculation."""
    start = corners.psi if corners.V_a.is_absent else corners.V_a
    lines = {"a": (corners.p_a, corners.n1, start), "z": (corners.p_z, corners.n2, corners.rho)}
    constants = {pressure.value: (pressure,) for pressure in (corners.p_z, corners.p_r, corners.p_a)}

    def with_inputs(segment: Segment) -> Segment:
        if segment.law == "polytropic":
            return replace(segment, operands=lines[segment.origin])
        inputs = constants.get(segment.pressures[0], ()) if segment.law == "constant" else ()
        return replace(segment, operands=inputs)

    return replace(diagram, segments=tuple(with_inputs(segment) for segment in diagram.segments))


@dataclass(frozen=True)
class HeatReleasePressure:
    """The diagram of a heat release."""

    data: HeatReleaseData  # Combustion, gas, walls and valves
    has_corners: ClassVar[bool] = False
    # its pressure is integrated
    traced: ClassVar[None] = None

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder; solutions are kept by data and cylinder."""
        cylinder = tuple(volume_at(np.array(_PROBES)).tolist())
        key = (self.data, cylinder, dead_centres)
        if key not in _SOLUTIONS:
            if len(_SOLUTIONS) >= _MAX_SOLUTIONS:
                _SOLUTIONS.clear()
            _SOLUTIONS[key] = heat_release(self.data, volume_at, volume_rate_at, dead_centres)
        return _SOLUTIONS[key]

    def motored(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram of a cylinder without combustion; the walls still take heat."""
        cold = replace(self.data, heat=0.0, fuel_per_cycle=0.0)
        return HeatReleasePressure(cold).pressure(volume_at, volume_rate_at, dead_centres)


@dataclass(frozen=True)
class MisfirePressure:
    """The pressure in a misfiring cylinder of an engine whose cycle is calculated."""

    firing: CornerPressure | HeatReleasePressure  # The cycle of the firing cylinders
    angle: float  # Of the cycle [deg]
    ambient: TracedValue | None = None  # Constant pressure if its valves stay open [Pa]
    traced: ClassVar[None] = None

    @property
    def cycle(self) -> CalculatedCycle | None:
        """The calculated cycle of the firing cylinders."""
        return self.firing.cycle if isinstance(self.firing, CornerPressure) else None

    @property
    def rounding(self) -> Rounding:
        """How corners of the firing cylinders are rounded."""
        return self.firing.rounding if isinstance(self.firing, CornerPressure) else Rounding()

    @property
    def has_corners(self) -> bool:
        """Whether the diagram of the firing cylinders has corners."""
        return self.firing.has_corners

    def pressure(self, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]) -> Calculated:
        """Return the diagram in a cylinder, with the values of the cycle of the firing cylinders."""
        firing = self.firing.pressure(volume_at, volume_rate_at, dead_centres)
        if self.ambient is not None:
            diagram = IndicatorDiagram((constant_pressure(0.0, self.angle, self.ambient),), {})
        else:
            diagram = self.firing.motored(volume_at, volume_rate_at, dead_centres).diagram
        return firing._replace(diagram=diagram, theoretical=None)


def heat_release(
    data: HeatReleaseData, volume_at: VolumeAt, volume_rate_at: VolumeAt, dead_centres: tuple[float, float]
) -> Calculated:
    """Return the cycle of a heat release (heywood_1988, ch. 9 and 12)."""
    dead_centres = from_before_zero(dead_centres)
    worked = Calculation()
    gas = closed_gas(data, volume_at, volume_rate_at, dead_centres, worked)
    periods = [stage for stage in stages(data, dead_centres) if stage.end > stage.start]
    solved = _solved(gas, periods, tuple(worked.known.values()))
    segments = [segment for segment, _ in solved]
    # the pressure has been integrated already: its column needs no volume
    diagram = _diagram(data, segments, dead_centres, (worked["residual_pressure"], worked["intake_pressure"]))
    pressure = traced_pressure(diagram, absent("cylinder_volume"))
    work, wall = (float(sum(change[i] for _, change in solved)) for i in (1, 2))
    ends = np.array([segments[-1].end]), segments[-1].pressures[-1:]
    stored = gas.energy_change(float(gas.temperature(*ends)[0]))
    # combustion ends before the exhaust opens
    burnt = wiebe_burnt_fraction(1.0, worked["burning_shape"]).named("burnt_fraction.exhaust")
    trace = {"fuel_heat": worked["fuel_heat"], "heat_released": (worked["fuel_heat"] * burnt).named("heat_released")}
    trace |= {
        key: TracedValue(ProcedureValue(value, "integral", (pressure,)), key)
        for key, value in (("wall_heat", wall), ("closed_work", work), ("internal_energy_change", stored))
    }
    left = trace["heat_released"] - trace["wall_heat"] - trace["closed_work"] - trace["internal_energy_change"]
    trace["first_law_residual"] = left.named("first_law_residual")
    trace |= _extremes(gas, periods, segments, pressure)
    trace["cylinder_temperature_max"] = _hottest(gas, trace, pressure, worked)
    trace["indicated_work"] = TracedValue(
        ProcedureValue(diagram.work(volume_at), "integral", (pressure,)), "indicated_work"
    )
    at_peak = worked.again(".peak")
    work_peak(gas, trace, at_peak)
    peak = {
        traced.key: traced for traced in (*worked.found.values(), *at_peak.found.values()) if traced.key not in trace
    }
    calculated = Calculated(diagram, trace, (), peak=peak)
    return calculated._replace(notices=heat_notices(data, gas, calculated.values))


def _solved(gas: ClosedGas, periods: list[Stage], inputs: tuple[TracedValue, ...]) -> list[tuple[Segment, Array]]:
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


def _extremes(
    gas: ClosedGas, periods: list[Stage], segments: list[Segment], column: TracedValue
) -> dict[str, TracedValue]:
    """Return the greatest pressure, temperature and pressure rise, with their angles."""
    diagram = IndicatorDiagram(tuple(segments), {})

    def pressure(degrees: Array) -> Array:
        return diagram.pressure(degrees, degrees)

    def temperature(degrees: Array) -> Array:
        return gas.temperature(degrees, pressure(degrees))

    knots = diagram.breaks
    extremes: dict[str, TracedValue] = {}
    for key, function in (("cylinder_pressure", pressure), ("cylinder_temperature", temperature)):
        top = int(np.argmax(function(knots)))
        fine = np.linspace(knots[max(top - 1, 0)], knots[min(top + 1, len(knots) - 1)], _FINE)
        extremes |= _greatest(key, [(fine, function(fine))], column, gas.data.cycle)
    steepest = []
    for period, segment in zip(periods, segments, strict=True):
        top = int(np.argmax(segment.slopes))
        fine = np.linspace(segment.knots[max(top - 1, 0)], segment.knots[min(top + 1, len(segment.knots) - 1)], _FINE)
        rise = gas.rates(fine, hermite(segment.knots, segment.pressures, segment.slopes, fine), period)[0]
        steepest.append((fine, rise))
    return extremes | _greatest("pressure_rise", steepest, column, gas.data.cycle)


def _hottest(gas: ClosedGas, trace: Mapping[str, TracedValue], column: TracedValue, worked: Calculation) -> TracedValue:
    """Return the greatest temperature, from pressure and volume at its angle."""
    degrees = math.degrees(trace["cylinder_temperature_max_angle"].value)
    volume = volume_when(worked, float(gas.volume_at(np.array([degrees]))[0]), degrees)
    state = at_angle(column, degrees, "cylinder_pressure"), volume
    hottest = gas_temperature(*state, worked["gas_mass"], worked["specific_gas_constant"])
    return hottest.named("cylinder_temperature_max")  # type: ignore[no-any-return]


def _greatest(
    key: str, intervals: list[tuple[Array, Array]], column: TracedValue, cycle: float
) -> dict[str, TracedValue]:
    """Return the largest value of all intervals, and its crank angle."""
    value, degrees = max((float(values.max()), float(degrees[np.argmax(values)])) for degrees, values in intervals)
    angle = degrees % cycle
    return {
        f"{key}_max": TracedValue(ProcedureValue(value, "max", (column,), angle), f"{key}_max"),
        f"{key}_max_angle": TracedValue(
            ProcedureValue(math.radians(angle), "max_angle", (column,), angle), f"{key}_max_angle"
        ),
    }


def _diagram(
    data: HeatReleaseData,
    closed: list[Segment],
    dead_centres: tuple[float, float],
    exchange: tuple[TracedValue, TracedValue],
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


def work_peak(gas: ClosedGas, trace: Mapping[str, TracedValue], worked: Calculation) -> None:
    """Calculate combustion, heat to the walls and pressure rise at the greatest pressure."""
    data, (start, end) = gas.data, gas.burning
    pressure = trace["cylinder_pressure_max"].named("cylinder_pressure")
    degrees = math.degrees(trace["cylinder_pressure_max_angle"].value)
    degrees += data.cycle if degrees < gas.first else 0.0
    volume, growth = (float(function(np.array([degrees]))[0]) for function in (gas.volume_at, gas.volume_rate_at))
    area = worked["piston_area"]
    slope = TracedValue(ProcedureValue(growth / area.value, "motion", angle=degrees), "piston_transfer_1")
    worked.known |= {"cylinder_pressure": pressure, "cylinder_volume": volume_when(worked, volume, degrees)}
    worked.known["crank_angle"] = TracedValue(
        ProcedureValue(math.radians(degrees), "max_angle", (pressure,), degrees), "crank_angle"
    )
    if start < degrees < end:
        worked(burning_progress)
        worked(wiebe_burnt_fraction)
        worked(wiebe_burning_rate)
    else:
        worked.absent("burning_rate")
    worked(gas_temperature)
    if worked["gas_heat_ratio_slope"].is_absent:
        worked.known["gas_heat_ratio"] = worked["gamma_cyl_0"]
    else:
        worked(gas_heat_ratio)
    if data.has_wall_loss:
        _work_walls(pressure, worked, EXPANSION if degrees > start else COMPRESSION)
    else:
        worked.absent("wall_heat_rate")
    worked(pressure_rise, V_phi=area * slope)


def _work_walls(pressure: TracedValue, worked: Calculation, factor: GasSpeedFactors) -> None:
    """Calculate the heat to the walls."""
    motored = worked(gas_formulas.polytropic_pressure, "motored_pressure", p_1=worked["p_shut"])
    higher = pressure if pressure.value > motored.value else motored
    worked(woschni_gas_speed, C_speed=factor.piston, C_burn=factor.burning, p_cyl=higher)
    worked(woschni_coefficient)
    below_head = worked["cylinder_volume"] - worked["clearance_volume"]
    x = (below_head / worked["piston_area"]).named("piston_displacement")
    worked(wall_area, pi=math.pi, x=x)
    worked(wall_heat_rate, w=(math.pi * worked["rotational_speed"] / 30).named("speed"))


def sharp_diagram(
    corners: Corners, cycle: float, volume_at: VolumeAt, dead_centres: tuple[float, float]
) -> IndicatorDiagram:
    """Return the theoretical diagram of a cylinder, absolute pressures.

    Four strokes: r, d begin the intake, a ends it; c, z (z' before it if combustion continues at constant pressure), b,
    e and r' end the cycle. Two strokes: c, z, b at the opening of the ports, e and a at their closing. Source:
    kolchin_demidov_2008, ch. 3; nguyen_tat_tien_2000.
    """
    top = dead_centres[0] % 360
    # a top dead centre just before 0 begins its cycle at the end of the previous one
    top = top + cycle - 360 if top > 180 else top
    bottom = top + (dead_centres[1] - dead_centres[0]) % 360
    p_r, p_a, p_c, p_z, p_b, rho, *_ = (corner.value for corner in corners)
    clearance = float(volume_at(np.array([top]))[0])

    def angle_of(ratio: float, start: float, end: float) -> float:
        return _angle_of_volume(volume_at, ratio * clearance, start, end)

    firing = top + cycle - 360
    if cycle == 720:
        begins, opens, compressed = bottom, bottom + 360, "c"
        first = NamedPoint("r", top, p_r)
        exchange = [
            _constant(NamedPoint("d", top, p_a), NamedPoint("a", bottom, p_a)),
            _constant(NamedPoint("e", opens, p_r), NamedPoint("r'", top + 720, p_r)),
        ]
    else:
        opens = begins = bottom
        if corners.psi.value:
            opens = angle_of(corners.epsilon.value, top, bottom)
            begins = angle_of(corners.epsilon.value, top + 360, bottom)
        first, compressed = NamedPoint("c", top, p_c), "c'"
        exchange = [_constant(NamedPoint("e", opens, p_a), NamedPoint("a", begins, p_a))]
    z = NamedPoint("z", angle_of(rho, firing, opens) if rho > 1 else firing, p_z)
    a, c = NamedPoint("a", begins, p_a), NamedPoint(compressed, top + 360, p_c)
    parts = [
        *exchange,
        DiagramPart("polytropic", (a, c), exponent=corners.n1.value, reference="a"),
        _constant(NamedPoint("z'", firing, p_z), z),
        DiagramPart("polytropic", (z, NamedPoint("b", opens, p_b)), exponent=corners.n2.value, reference="z"),
    ]
    of_states = volume_at(np.array([begins, z.angle])).tolist()
    states = {"a": (p_a, corners.V_a.value or of_states[0]), "z": (p_z, of_states[1])}
    diagram = diagram_of_parts(parts, cycle, volume_at, states)
    named = {first.name: (first.angle, first.pressure), **diagram.named}
    return _with_traced_segments(replace(diagram, named=named), corners)


def _constant(start: NamedPoint, end: NamedPoint) -> DiagramPart:
    return DiagramPart("constant", (start, end))


def _angle_of_volume(volume_at: VolumeAt, volume: float, small: float, large: float) -> float:
    """Return the angle at which a volume is reached, between angles of a smaller and a larger volume."""
    low, high = float(small), float(large)
    ends = volume_at(np.array([low, high]))
    if not ends[0] <= volume <= ends[1] * (1 + 1e-12):
        raise CycleError(ErrorMessage("volume_unreached", volume=volume * 1e6, least=ends[0] * 1e6, most=ends[1] * 1e6))
    return solve_monotone(volume_at, volume, low, high)
