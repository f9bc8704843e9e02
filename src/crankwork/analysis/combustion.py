"""Combustion from a measured pressure: heat release, angles of burning, polytropes, statistics of recorded cycles."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from crankwork.analysis.cylinder_forces import TracedCylinder
from crankwork.analysis.results import Listing, Results
from crankwork.formula.calculation import Calculation
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.replay import Program
from crankwork.formula.traced_value import Piecewise, ProcedureValue, Tabulated, TracedValue, given
from crankwork.kinematics.crank_grid import Array, CrankGrid
from crankwork.loads import gas as gas_formulas
from crankwork.loads.curves import hermite, hermite_slope
from crankwork.loads.indicator import IndicatorDiagram
from crankwork.loads.measured_pressure import closed_diagram
from crankwork.loads.pressure_processing import treated_cycles
from crankwork.machine import Gas
from crankwork.preparation.prepared import Notice, WorkingSpace
from crankwork.working_cycle import closed_gas
from crankwork.working_cycle.burning_analysis import (
    BurningAnalysis,
    fitted_polytrope,
    gross_heat_rate,
    net_heat_rate,
    released_fraction,
    wiebe_fit,
)

COLUMNS = (
    "pressure_rise", "cylinder_temperature", "gas_heat_ratio", "net_heat_rate", "net_heat", "wall_heat_rate",
    "gross_heat_rate", "gross_heat", "burnt_fraction",
)  # fmt: skip
SHARES = (10, 50, 90)
_PATH = "gas.combustion"
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(5)
_FEWEST = 5
# over which the heat is averaged where burning begins and ends [deg]
_AVERAGED = 4.0
# before the end of the closed period [deg], and share of the heat that is released there if burning does not end
_LATE, _UNENDED = 10.0, 0.1
_VARIATIONS = {
    "indicated_mean_pressure": "mean_pressure_variation",
    "cylinder_pressure_max": "peak_pressure_variation",
}
_STATISTICS = ("indicated_mean_pressure", "cylinder_pressure_max", "cylinder_pressure_max_angle")


class _Closed(NamedTuple):
    """The gas between two angles, and the columns of the machine. [deg]"""

    data: BurningAnalysis
    knots: Array  # Samples between both ends, with these
    cycle: float
    trace: Mapping[str, TracedValue]

    def law(self, inside: TracedValue, after: float = 0.0) -> Piecewise:
        """Return a column that is another one in the closed period, zero before it and a value after it."""
        before, behind = (TracedValue(ProcedureValue(value, "open")) for value in (0.0, after))
        return Piecewise((self.data.start, self.data.end, self.cycle), (before, inside, behind), self.knots.tolist())

    def integral(self, rate: TracedValue, key: str) -> TracedValue:
        """Return the integral of a column since the start of the closed period; after its end it keeps its value."""
        program, (low, high) = Program({"": rate}), (self.knots[:-1], self.knots[1:])
        nodes = (low + high)[:, None] / 2 + (high - low)[:, None] / 2 * _NODES
        values = program(CrankGrid.from_degrees(nodes.ravel()))[""].reshape(nodes.shape)
        heat = np.append(0.0, np.cumsum(values @ _WEIGHTS * np.radians(high - low) / 2))
        # the rate at an end is that inside
        edges = np.append(self.knots[0] + 1e-9, self.knots[1:])
        slopes = np.radians(program(CrankGrid.from_degrees(edges))[""])
        curve = Tabulated(partial(hermite, self.knots, heat, slopes), "integral", self.knots.tolist(), (rate,))
        return TracedValue(self.law(TracedValue(curve), float(heat[-1])), key)


def with_combustion(results: Results) -> Results:
    """Return the results of an engine with the analysis of combustion that its gas asks for."""
    solved, gas = results.solved, results.machine.gas
    if gas is None or gas.combustion is None or solved.space is None:
        return results
    data, space = gas.combustion, solved.space
    inner = space.diagram.breaks
    inner = inner[(inner > data.start + 1e-6) & (inner < data.end - 1e-6)]
    closed = _Closed(data, np.array([data.start, *inner, data.end]), results.machine.cycle, solved.trace)
    columns, between = _columns(closed, space, results)
    over = CycleInterpolant(columns, CrankGrid.from_degrees, closed.cycle)
    values = over.extremes("pressure_rise", "gross_heat_rate")
    values = {key: value for key, value in values.items() if "_max" in key} | _totals(closed, columns, space)
    burning, left_out = _burning(closed, columns)
    values |= burning
    listings = {**results.listings}
    if data.windows:
        listings["fitted_polytropes"] = _polytropes(data, solved)
    cycles = _cycles(gas, solved)
    if cycles is not None:
        listings["recorded_cycles"] = cycles
        values |= _statistics(cycles, results)
    residual = values.pop("first_law_residual").value
    checks = {"first_law": abs(residual) / max(abs(values["heat_released"].value), 1e-300)}
    return replace(
        results,
        notices=(*results.notices, *_taken(data), *left_out),
        columns={**results.columns, **Program(columns)(results.grid)},
        summary={**results.summary, **{key: value.value for key, value in values.items()}},
        checks={**results.checks, **checks},
        groups={**results.groups, "combustion": COLUMNS},
        listings=listings,
        trace={**results.trace, **between, **columns, **values},
    )


def _taken(data: BurningAnalysis) -> list[Notice]:
    """Return what is taken as usual for the heat to the walls, and that no gas is lost."""
    kept = [Notice("burning_mass", {})]
    wall = Notice("burning_walls", {"exponent": data.motored_exponent})
    return kept if data.wall_temperature is None else [*kept, wall]


def _columns(
    closed: _Closed, space: WorkingSpace, results: Results
) -> tuple[dict[str, TracedValue], dict[str, TracedValue]]:
    """Return the columns of the analysis, and what stands between them, by key."""
    data, trace, worked = closed.data, closed.trace, Calculation()
    pressure, volume = trace["diagram_pressure"], trace["cylinder_volume"]
    rise = Tabulated(partial(_slope, space.diagram), "slope", space.diagram.breaks.tolist(), (pressure,))
    worked.known |= {"p_cyl": pressure, "V": volume, "p_phi": TracedValue(rise, "pressure_rise")}
    worked.known["V_phi"] = (trace["piston_area"] * trace["piston_transfer_1"]).named("cylinder_volume_1")
    worked.known["gas_heat_ratio"] = given("gas_heat_ratio", data.heat_ratio, f"{_PATH}.adiabatic_exponent")
    columns = {"pressure_rise": worked["p_phi"]}
    if data.temperature is not None:
        _temperature(closed, worked)
    columns |= {key: worked[key] for key in COLUMNS if key in worked.found and worked[key].varies}
    inside = worked(net_heat_rate, "net_heat_rate.closed").named("net_heat_rate")
    columns["net_heat_rate"] = TracedValue(closed.law(inside), "net_heat_rate")
    columns["net_heat"] = closed.integral(columns["net_heat_rate"], "net_heat")
    if data.wall_temperature is None:
        columns |= {f"gross_{part}": columns[f"net_{part}"].named(f"gross_{part}") for part in ("heat_rate", "heat")}
    else:
        (begins, _), _ = _burning_ends(closed, columns["net_heat"])
        wall = _wall(closed, worked, results, begins)
        columns["wall_heat_rate"] = TracedValue(closed.law(wall), "wall_heat_rate")
        columns["gross_heat_rate"] = gross_heat_rate(columns["net_heat_rate"], columns["wall_heat_rate"])
        columns["gross_heat"] = closed.integral(columns["gross_heat_rate"], "gross_heat")
    # where burning begins and ends
    heat, degrees = columns["gross_heat"], closed.knots
    (start, low), (end, high) = _burning_ends(closed, heat)
    levels = [
        TracedValue(ProcedureValue(value, word, (heat,), degree), f"gross_heat.{name}")
        for value, word, degree, name in ((low, "least_heat", start, "before"), (high, "greatest_heat", end, "after"))
    ]
    fraction = released_fraction(heat, *levels)
    none, all_of_it = (TracedValue(ProcedureValue(value, "open")) for value in (0.0, 1.0))
    columns["burnt_fraction"] = TracedValue(
        Piecewise((start, end, closed.cycle), (none, fraction, all_of_it), degrees.tolist()), "burnt_fraction"
    )
    between = {level.key: level for level in levels}
    between |= {key: value for key, value in worked.found.items() if key not in columns and not key.endswith(".closed")}
    return columns, between


def _slope(diagram: IndicatorDiagram, degrees: Array) -> Array:
    """Return the derivative of a measured pressure at crank angles. [Pa/rad]"""
    ends = np.array([part.end for part in diagram.segments[:-1]])
    which = np.searchsorted(ends, degrees)
    slopes = np.empty_like(degrees)
    for number, part in enumerate(diagram.segments):
        own = which == number
        slopes[own] = hermite_slope(part.knots, part.pressures, part.slopes, degrees[own])
    return np.degrees(slopes)


def _temperature(closed: _Closed, worked: Calculation) -> None:
    """Add mass, temperature and ratio of specific heats of the gas."""
    data = closed.data
    start = CrankGrid.from_degrees([data.start])
    state = Program({"p": worked["p_cyl"], "V": worked["V"]})(start)
    p_1, V_1 = (
        TracedValue(ProcedureValue(float(state[name][0]), "at", (worked[key],), data.start), f"{quantity}.1")
        for name, key, quantity in (("p", "p_cyl", "cylinder_pressure"), ("V", "V", "cylinder_volume"))
    )
    warm = given("cylinder_temperature.1", data.temperature or 0.0, f"{_PATH}.temperature")
    worked.known |= {"p_shut": p_1, "V_1": V_1, "T_shut": warm}
    worked.given("specific_gas_constant", data.gas_constant)
    worked(closed_gas.gas_mass)
    worked(closed_gas.gas_temperature)
    if data.heat_ratio_slope:
        worked.given("gas_heat_ratio_slope", data.heat_ratio_slope, f"{_PATH}.exponent_slope")
        worked.known["gamma_cyl_0"] = worked["gas_heat_ratio"]
        worked(closed_gas.gas_heat_ratio)


def _wall(closed: _Closed, worked: Calculation, results: Results, begins: float) -> TracedValue:
    """Return the heat to the walls by crank angle (woschni_1967); `begins`: angle of the start of burning. [deg]"""
    trace, data, factors = closed.trace, closed.data, closed_gas.EXPANSION
    worked.known |= {key: trace[key] for key in ("bore", "piston_area", "swept_volume", "piston_displacement", "speed")}
    worked.known |= {"mean_piston_speed": results.trace["mean_piston_speed"]}
    worked.known |= {key: trace["piston_area"].named(key) for key in ("head_area", "crown_area")}
    worked.given("wall_temperature", data.wall_temperature or 0.0, f"{_PATH}.wall_temperature")
    worked.given("polytropic_exponent", data.motored_exponent)
    motored = worked.keep(_motored(closed, worked))
    worked.given("gas_speed_factor", factors.piston)
    none, more = closed_gas.COMPRESSION.burning, factors.burning
    burns = [TracedValue(ProcedureValue(value, "open"), "burning_speed_factor") for value in (none, more)]
    worked.known["burning_speed_factor"] = TracedValue(
        Piecewise((begins, closed.cycle), tuple(burns)), "burning_speed_factor"
    )
    worked(closed_gas.woschni_gas_speed, p_mot=motored)
    worked(closed_gas.woschni_coefficient)
    worked(closed_gas.wall_area, pi=results.method.pi)
    return worked(closed_gas.wall_heat_rate, "wall_heat_rate.closed").named("wall_heat_rate")


def _motored(closed: _Closed, worked: Calculation) -> TracedValue:
    """Return the pressure without burning: a polytrope in the closed period, nowhere above the measured pressure."""
    state = worked["p_shut"].value, worked["V_1"].value
    program = Program({key: worked[key] for key in ("p_cyl", "V")})

    def pressure(degrees: Array) -> Array:
        columns = program(CrankGrid.from_degrees(degrees))
        line = gas_formulas.polytropic_pressure(*state, columns["V"], closed.data.motored_exponent)
        return np.minimum(line, columns["p_cyl"])

    operands = (worked["p_cyl"], worked["V"], worked["p_shut"], worked["polytropic_exponent"])
    return TracedValue(Tabulated(pressure, "motored", closed.knots.tolist(), operands), "motored_pressure")


def _burning_ends(closed: _Closed, column: TracedValue) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return angle and heat where burning begins and ends: as stated, or where the heat is least and then greatest."""
    degrees = closed.knots
    heat = Program({"": column})(CrankGrid.from_degrees(degrees))[""]
    if closed.data.burning is not None:
        start, end = closed.data.burning
        return (start, float(np.interp(start, degrees, heat))), (end, float(np.interp(end, degrees, heat)))
    top = int(np.argmax(heat))
    bottom = int(np.argmin(heat[: top + 1]))
    # the extreme of noise is no level: means before the one, and around the other
    levels = (
        float(np.mean(heat[(degrees >= low) & (degrees <= high)]))
        for low, high in (
            (degrees[bottom] - _AVERAGED, degrees[bottom]),
            (degrees[top] - _AVERAGED / 2, degrees[top] + _AVERAGED / 2),
        )
    )
    return (float(degrees[bottom]), next(levels)), (float(degrees[top]), next(levels))


def _totals(closed: _Closed, columns: Mapping[str, TracedValue], space: WorkingSpace) -> dict[str, TracedValue]:
    """Return the heats of the closed period, and what is left of the first law without a derivative. [J]"""
    ends = CrankGrid.from_degrees([closed.data.start, closed.data.end])
    keys = [key for key in ("net_heat", "gross_heat", "cylinder_temperature") if key in columns]
    wanted = {"p": closed.trace["diagram_pressure"], "V": closed.trace["cylinder_volume"]}
    state = Program({**{key: columns[key] for key in keys}, **wanted})(ends)
    net, gross = (float(state[key][1]) for key in ("net_heat", "gross_heat"))
    moved = Program({"": closed.trace["cylinder_volume"]})
    parts = (
        replace(part, start=max(part.start, closed.data.start), end=min(part.end, closed.data.end))
        for part in space.diagram.segments
    )
    work = sum(
        part.work(lambda degrees: moved(CrankGrid.from_degrees(degrees))[""]) for part in parts if part.end > part.start
    )
    p_V = state["p"] * state["V"]
    if closed.data.heat_ratio_slope and "cylinder_temperature" in columns:
        first, last = (float(value) for value in state["cylinder_temperature"])
        ratio = (closed.data.heat_ratio, closed.data.heat_ratio_slope)
        stored = closed_gas.internal_energy_change(float(p_V[0]) / first, *ratio, first, last)
    else:
        stored = float(p_V[1] - p_V[0]) / (closed.data.heat_ratio - 1)
    values = {"heat_released": gross, "wall_heat": gross - net, "closed_work": work, "internal_energy_change": stored}
    heat = (columns["gross_heat"],)
    result = {key: TracedValue(ProcedureValue(value, "integral", heat), key) for key, value in values.items()}
    left = net - work - stored
    return result | {"first_law_residual": TracedValue(ProcedureValue(left, "integral", heat))}


def _burning(closed: _Closed, columns: Mapping[str, TracedValue]) -> tuple[dict[str, TracedValue], list[Notice]]:
    """Return the angles at which shares of the heat are released and the nearest Wiebe function, or why there is none.

    Shares of a heat that is not positive, or that still grows where the closed period ends, tell nothing.
    """
    fraction, heat, degrees = columns["burnt_fraction"], columns["gross_heat"], closed.knots
    over = CycleInterpolant({"": fraction}, CrankGrid.from_degrees, closed.cycle)
    released = Program({"": heat})(CrankGrid.from_degrees(degrees))[""]
    top, burning = int(np.argmax(released)), closed.data.burning
    ends = burning or (closed.data.start, closed.data.end)
    gained, late = (
        float(np.diff(np.interp((angle, ends[1]), degrees, released))[0]) for angle in (ends[0], ends[1] - _LATE)
    )
    if gained <= 0 or (burning is None and late > _UNENDED * gained):
        code = "burning_unended" if gained > 0 else "burning_negative"
        return {}, [Notice(code, {"heat": gained, "angle": ends[1]})]
    values = dict[str, TracedValue]()
    for share in SHARES:
        crossings = over.crossings("", share / 100)
        if len(crossings):
            angle = float(crossings[0])
            values[f"burnt_angle.{share}"] = TracedValue(
                ProcedureValue(math.radians(angle), "reached", (fraction,), angle, given("", share / 100)),
                f"burnt_angle.{share}",
            )
    if len(values) < len(SHARES):
        return values, []
    first, middle, last = (math.degrees(value.value) for value in values.values())
    end_of_it = top if burning is None else int(np.searchsorted(degrees, burning[1]))
    kept = slice(0, max(end_of_it + 1, _FEWEST))
    fit = wiebe_fit(degrees[kept], released[kept], (first - (middle - first) / 2, 2 * (last - first)))
    if fit is None:
        return values, [Notice("wiebe_unsettled", {})]
    if fit.heat <= 0 or fit.duration > closed.data.end - closed.data.start:
        return values, [Notice("wiebe_odd", {"heat": fit.heat, "duration": fit.duration})]
    parameters = {
        "burning_start": math.radians(fit.start),
        "burning_duration": math.radians(fit.duration),
        "burning_shape": fit.shape,
        "fuel_heat": fit.heat,
        "fit_scatter": fit.scatter,
    }
    wiebe = {
        f"{key}.fit": TracedValue(ProcedureValue(value, "fit", (heat,)), f"{key}.fit")
        for key, value in parameters.items()
    }
    return values | wiebe, []


def _polytropes(data: BurningAnalysis, solved: TracedCylinder) -> Listing:
    """Return the polytropes of the windows: from, to, exponent, scatter of the logarithm of the pressure."""
    program = Program({key: solved.trace[key] for key in ("cylinder_volume", "diagram_pressure")})
    knots, rows = solved.space.diagram.breaks if solved.space else np.empty(0), []
    for start, end in data.windows:
        inside = np.unique([start, *knots[(knots > start) & (knots < end)], end])
        state = program(CrankGrid.from_degrees(inside))
        line = fitted_polytrope(state["cylinder_volume"], state["diagram_pressure"])
        rows.append((math.radians(start), math.radians(end), *line))
    keys = ("window_start", "window_end", "polytropic_exponent", "fit_scatter")
    return Listing({key: np.array(column) for key, column in zip(keys, zip(*rows, strict=True), strict=True)})


def _cycles(gas: Gas, solved: TracedCylinder) -> Listing | None:
    """Return mean pressure, peak and its angle of every cycle of a recording; None of a single one."""
    if gas.measured is None or solved.space is None:
        return None
    volume = Program({"": solved.trace["cylinder_volume"]})

    def volume_at(degrees: Array) -> Array:
        return volume(CrankGrid.from_degrees(degrees))[""]

    begins, swept = solved.begins, solved.space.swept
    recorded, degrees, _ = treated_cycles(
        gas.measured, gas.cycle, lambda angles: volume_at(angles + begins), shift=gas.angle_shift, step=gas.resample,
        path=gas.path,
    )  # fmt: skip
    if len(recorded.cycles) < 2:
        return None
    rows = []
    for pressure in recorded.cycles:
        diagram = closed_diagram(degrees + begins, pressure, gas.cycle, ([""] * len(degrees), ""))
        top = int(np.argmax(pressure))
        rows.append((diagram.work(volume_at) / swept, pressure[top], math.radians((degrees[top] + begins) % gas.cycle)))
    columns = dict(zip(_STATISTICS, np.array(rows).T, strict=True))
    return Listing({"cycle_number": np.arange(1.0, len(rows) + 1), **columns})


def _statistics(cycles: Listing, results: Results) -> dict[str, TracedValue]:
    """Return mean, standard deviation and coefficient of variation over the cycles of a recording."""
    values, pressure = dict[str, TracedValue](), (results.solved.trace["diagram_pressure"],)
    for key in _STATISTICS:
        column = cycles.columns[key]
        mean, deviation = (
            TracedValue(ProcedureValue(value, f"cycles_{word}", pressure), f"{key}.{word}")
            for value, word in ((float(column.mean()), "mean"), (float(column.std(ddof=1)), "deviation"))
        )
        values |= {mean.key: mean, deviation.key: deviation}
        # an angle has no zero of its own
        if key in _VARIATIONS and mean.value:
            values[_VARIATIONS[key]] = (deviation / mean).named(_VARIATIONS[key])
    return values
