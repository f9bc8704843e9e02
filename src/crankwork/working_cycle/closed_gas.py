"""The gas from intake closing to exhaust opening, as functions of crank angle and pressure: one zone of ideal gas.

By the Wiebe function combustion ends when the exponent reaches ln 1000, that is when 0.999 of the fuel is burnt. The
correlation of Woschni for the heat to the walls is empirical and has its units built in: the bore in metres, the
temperature in kelvins, the gas speed in metres per second, the pressure in kilopascals (divided from pascals in the
formula itself), the coefficient in W/(m2 K).
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from crankwork.errors import CrankworkError, MissingExtraError
from crankwork.formula.calculation import Calculation
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import ProcedureValue, TracedValue, given
from crankwork.kinematics.crank_grid import Array
from crankwork.kinematics.slider_crank import mean_piston_speed
from crankwork.loads import gas as gas_formulas
from crankwork.loads.indicator import VolumeAt
from crankwork.locale import ErrorMessage

# a cycle of an engine takes one or two thousand evaluations
_MAX_EVALUATIONS = 10_000
# hydrogen with oxygen releases 13 MJ/kg
_MAX_HEAT = 2e7


@dataclass(frozen=True)
class ClosedGas:
    """The enclosed gas at any crank angle. Volumes [m3], mass [kg], heat [J], angles [deg]."""

    data: HeatReleaseData
    volume_at: VolumeAt
    volume_rate_at: VolumeAt
    clearance: float
    swept: float
    shut_volume: float
    mass: float
    heat: float
    piston_speed: float
    areas: tuple[float, float]
    burning: tuple[float, float]
    first: float

    @property
    def speed(self) -> float:
        """Angular speed of the crank. [rad/s]"""
        return self.data.rotational_speed * math.pi / 30

    def temperature(self, degrees: Array, pressure: Array) -> Array:
        """Return the temperature at crank angles [deg] and pressures [Pa]. [K]"""
        volume = self.volume_at(degrees)
        return np.asarray(gas_temperature(pressure, volume, self.mass, self.data.gas_constant))

    def _progress(self, degrees: Array) -> Array:
        start, end = self.burning
        return np.asarray(np.clip(burning_progress(degrees, start, end - start), 0.0, 1.0))

    def _wall_rate(self, volume: Array, pressure: Array, *, has_burnt: bool) -> Array:
        """Return the heat to the walls at volumes [m3] and pressures [Pa]. [J/rad]"""
        data = self.data
        motored = gas_formulas.polytropic_pressure(data.shut_pressure, self.shut_volume, volume, data.motored_exponent)
        # late in the expansion of a cold charge the difference may be negative, but combustion never slows the gas down
        above = np.maximum(pressure, motored)
        factors = EXPANSION if has_burnt else COMPRESSION
        shut = (data.shut_temperature, data.shut_pressure, self.shut_volume)
        speed = woschni_gas_speed(factors.piston, self.piston_speed, factors.burning, self.swept, *shut, above, motored)
        temperature = gas_temperature(pressure, volume, self.mass, data.gas_constant)
        coefficient = woschni_coefficient(data.bore, pressure, temperature, speed)
        x = (volume - self.clearance) / (math.pi * data.bore**2 / 4)
        area = wall_area(*self.areas, math.pi, data.bore, x)
        return np.asarray(wall_heat_rate(coefficient, area, temperature, data.wall_temperature, self.speed))

    def rates(self, degrees: Array, pressure: Array, stage: Stage) -> Array:
        """Return the derivatives of pressure, work and heat to the walls by crank angle, shape (3, n).

        Rates [Pa/rad], [J/rad], [J/rad].
        """
        data = self.data
        volume, growth = self.volume_at(degrees), self.volume_rate_at(degrees)
        temperature = gas_temperature(pressure, volume, self.mass, data.gas_constant)
        ratio = gas_heat_ratio(data.heat_ratio, data.heat_ratio_slope, temperature)
        burning: Array | float = 0.0
        if stage.burns:
            duration = math.radians(stage.end - stage.start)
            burning = wiebe_burning_rate(self._progress(degrees), data.burning_shape, duration)
        wall = np.zeros_like(pressure)
        if data.has_wall_loss:
            wall = self._wall_rate(volume, pressure, has_burnt=stage.has_burnt)
        rise = pressure_rise(ratio, volume, self.heat, burning, wall, pressure, growth)
        return np.array([rise, pressure * growth, wall])

    def integrated(self, stage: Stage, pressure: float, relative: float, absolute: float) -> tuple[VolumeAt, Array]:
        """Solve the first law over one stage of the closed period.

        Returns pressure, work and heat to the walls as a function of the crank angle, and at its end [Pa], [J], [J].
        `pressure`: at its start [Pa]; `relative` and `absolute`: tolerances, the latter by the size of each unknown.
        """
        try:
            from scipy.integrate import solve_ivp  # noqa: PLC0415 - loaded where it is needed
        except ModuleNotFoundError:
            raise MissingExtraError(ErrorMessage("extra_heat"), "dynamics") from None
        sizes = np.array([self.data.shut_pressure, 1.0, 1.0])
        sizes[1:] = self.data.shut_pressure * self.shut_volume + self.heat

        evaluations = itertools.count()

        def right_side(angle: float, state: Array) -> Array:
            if next(evaluations) > _MAX_EVALUATIONS:
                raise self._not_followed(stage, angle)
            # nan makes the solver repeat a trial step below vacuum with a shorter one
            return np.radians(self.rates(np.array([angle]), state[:1], stage)[:, 0]) if state[0] > 0 else state * np.nan

        with np.errstate(all="ignore"):
            solution = solve_ivp(
                right_side,
                (stage.start, stage.end),
                [pressure, 0.0, 0.0],
                method="DOP853",
                dense_output=True,
                rtol=relative,
                atol=absolute * sizes,
            )
        if not solution.success or solution.sol is None or not np.isfinite(solution.y).all():
            raise self._not_followed(stage, float(solution.t[-1]))
        return solution.sol, solution.y[:, -1]

    def _not_followed(self, stage: Stage, angle: float) -> CrankworkError:
        return CrankworkError(ErrorMessage("heat_unfollowed", start=stage.start, end=stage.end, angle=angle))

    def energy_change(self, temperature: float) -> float:
        """Return the change of internal energy since intake closing, at a temperature [K]. [J]"""
        data = self.data
        constant = self.mass * data.gas_constant
        ratio = (data.heat_ratio, data.heat_ratio_slope)
        return internal_energy_change(constant, *ratio, data.shut_temperature, float(temperature))


def closed_gas(
    data: HeatReleaseData,
    volume_at: VolumeAt,
    volume_rate_at: VolumeAt,
    dead_centres: tuple[float, float],
    worked: Calculation,
) -> ClosedGas:
    """Return the gas enclosed at intake closing, after calculating its constants."""
    check_heat_release(data)
    shut, begin, end = (stage.start for stage in stages(data, dead_centres))
    clearance, largest, shut_volume = (float(volume) for volume in volume_at(np.array([*dead_centres, shut])))
    _give(worked, data)
    _give_sizes(worked, clearance, largest, data)
    worked.known["V_1"] = volume_when(worked, shut_volume, shut).named("cylinder_volume.1")
    turn = TracedValue(ProcedureValue(math.radians(dead_centres[0] + 360.0), "dead_centre"), "top_dead_centre_angle")
    advance = given("burning_advance", math.radians(data.burning_advance), data.stated_at("cycle.combustion_start"))
    worked.known["burning_start"] = (turn - advance).named("burning_start")
    for key in ("head_area", "crown_area"):
        worked.known.setdefault(key, worked["piston_area"])
    if data.heat is None:
        worked(fuel_heat)
    mass, heat = worked(gas_mass).value, worked["fuel_heat"].value
    if heat > _MAX_HEAT * mass:
        raise CrankworkError(ErrorMessage("heat_excessive", heat=heat, share=heat / mass / 1e6))
    return ClosedGas(
        data=data,
        volume_at=volume_at,
        volume_rate_at=volume_rate_at,
        clearance=clearance,
        swept=largest - clearance,
        shut_volume=shut_volume,
        mass=mass,
        heat=heat,
        piston_speed=worked["mean_piston_speed"].value,
        areas=(worked["head_area"].value, worked["crown_area"].value),
        burning=(begin, end),
        first=shut,
    )


def _give_sizes(worked: Calculation, clearance: float, largest: float, data: HeatReleaseData) -> None:
    """Add area, volumes and mean speed of the piston, from the stroke and the compression ratio of the cylinder."""
    area = gas_formulas.piston_area(math.pi, worked["bore"])
    stroke = given("stroke", (largest - clearance) / area.value, data.stated_at("crank.stroke"))
    ratio = given("compression_ratio", largest / clearance, data.stated_at("cylinder.compression_ratio"))
    swept, speed = gas_formulas.swept_volume(area, stroke), mean_piston_speed(stroke, worked["rotational_speed"])
    traced_values = (area, swept, gas_formulas.clearance_volume(swept, ratio), speed)
    worked.known |= {traced.key: traced for traced in traced_values}


def volume_when(worked: Calculation, volume: float, degrees: float) -> TracedValue:
    """Return the volume of the cylinder at a crank angle, from the displacement of the piston. [m3]"""
    clearance, area = worked["clearance_volume"], worked["piston_area"]
    displacement = TracedValue(
        ProcedureValue((volume - clearance.value) / area.value, "motion", angle=degrees), "piston_displacement"
    )
    cylinder_volume: TracedValue = gas_formulas.cylinder_volume(clearance, area, displacement)
    return cylinder_volume


# define the heat unless it is stated itself
_OF_FUEL = ("fuel_per_cycle", "heating_value", "burning_efficiency")


def _give(worked: Calculation, data: HeatReleaseData) -> None:
    """Add the data as stated."""
    worked.given("rotational_speed", data.rotational_speed, "crank.speed", "rpm")
    for name, key, path in (
        ("bore", "bore", "cylinder.bore"),
        ("heat", "fuel_heat", "cycle.cycle_heat"),
        ("fuel_per_cycle", "fuel_per_cycle", "cycle.fuel_mass"),
        ("heating_value", "fuel_heating_value", "cycle.heating_value"),
        ("burning_efficiency", "burning_efficiency", "cycle.burning_efficiency"),
        ("burning_shape", "burning_shape", "cycle.shape"),
        ("heat_ratio_slope", "gas_heat_ratio_slope", ""),
        ("gas_constant", "specific_gas_constant", ""),
        ("wall_temperature", "wall_temperature", "cycle.wall_temperature"),
        ("head_area", "head_area", ""),
        ("crown_area", "crown_area", ""),
        ("exhaust_pressure", "residual_pressure", "cycle.residual_pressure"),
        ("intake_pressure", "intake_pressure", "cycle.intake_pressure"),
    ):
        value = getattr(data, name)
        if value is not None and (data.heat is None or name not in _OF_FUEL):
            worked.given(key, value, data.stated_at(path))
    if not data.heat_ratio_slope:
        worked.absent("gas_heat_ratio_slope")
    worked.given("burning_duration", math.radians(data.burning_duration), data.stated_at("cycle.combustion_duration"))
    # states of a quantity that varies are stored under the argument that they are used for
    worked.known |= {
        "p_shut": given("cylinder_pressure", data.shut_pressure, data.stated_at("cycle.intake_pressure")),
        "T_shut": given("cylinder_temperature", data.shut_temperature, data.stated_at("cycle.intake_temperature")),
        "gamma_cyl_0": given("gas_heat_ratio", data.heat_ratio, data.stated_at("cycle.adiabatic_exponent")),
        "n_p": given("polytropic_exponent", data.motored_exponent),
    }


@formula("gas_mass", "heywood_1988, ch. 3")
def gas_mass(p_shut: Value, V_1: Value, R_gas: Value, T_shut: Value) -> Value:
    """Mass of the gas enclosed at intake closing."""
    return p_shut * V_1 / (R_gas * T_shut)


@formula("cylinder_temperature", "heywood_1988, ch. 3")
def gas_temperature(p_cyl: Value, V: Value, m_gas: Value, R_gas: Value) -> Value:
    """Mean temperature of the enclosed gas."""
    return p_cyl * V / (m_gas * R_gas)


@formula("gas_heat_ratio", "heywood_1988, ch. 9")
def gas_heat_ratio(gamma_cyl_0: Value, gamma_cyl_T: Value, T_cyl: Value) -> Value:
    """Ratio of specific heats, linear in temperature."""
    return gamma_cyl_0 + gamma_cyl_T * T_cyl


@formula("pressure_rise", "heywood_1988, ch. 9")
def pressure_rise(  # noqa: PLR0913 - one argument per symbol
    gamma_cyl: Value, V: Value, Q_fuel: Value, x_burn_1: Value, Q_wall_1: Value, p_cyl: Value, V_phi: Value
) -> Value:
    """Pressure rise of the enclosed gas by the first law."""
    return (gamma_cyl - 1) / V * (Q_fuel * x_burn_1 - Q_wall_1) - gamma_cyl * p_cyl / V * V_phi


def internal_energy_change(heat_constant: float, ratio: float, ratio_slope: float, start: float, end: float) -> float:
    """Return the change of internal energy between two temperatures, of m R / (gamma - 1) (heywood_1988, ch. 9). [J]"""
    first = ratio + ratio_slope * start - 1
    growth = ratio_slope * (end - start) / first
    # ln(1 + g) / g keeps its digits as the slope goes to zero
    mean = np.log1p(growth) / growth if growth else 1.0
    return float(heat_constant * (end - start) / first * mean)


@formula("burning_progress", "vibe_1970")
def burning_progress(phi: Value, phi_burn_0: Value, phi_burn: Value) -> Value:
    """Progress of burning: 0 at its start, 1 at its end."""
    return (phi - phi_burn_0) / phi_burn


@formula("burnt_fraction", "vibe_1970")
def wiebe_burnt_fraction(s_burn: Value, m_vibe: Value) -> Value:
    """Fraction burnt by the Wiebe function."""
    return 1 - np.exp(-6.908 * s_burn ** (m_vibe + 1))


@formula("burning_rate", "vibe_1970", unit="1/rad")
def wiebe_burning_rate(s_burn: Value, m_vibe: Value, phi_burn: Value) -> Value:
    """Rate of burning by the Wiebe function."""
    return 6.908 * (m_vibe + 1) / phi_burn * s_burn**m_vibe * np.exp(-6.908 * s_burn ** (m_vibe + 1))


@formula("fuel_heat", "heywood_1988, ch. 3")
def fuel_heat(m_fuel: Value, H_fuel: Value, eta_burn: Value) -> Value:
    """Heat that the fuel of one cycle gives."""
    return m_fuel * H_fuel * eta_burn


class GasSpeedFactors(NamedTuple):
    """The two factors of Woschni's gas speed: of the mean piston speed [-] and of the rise by burning [m/(s K)]."""

    piston: float
    burning: float


COMPRESSION = GasSpeedFactors(2.28, 0.0)
EXPANSION = GasSpeedFactors(2.28, 3.24e-3)


@formula("wall_gas_speed", "woschni_1967")
def woschni_gas_speed(  # noqa: PLR0913 - one argument per symbol
    C_speed: Value,
    S_pm: Value,
    C_burn: Value,
    V_d: Value,
    T_shut: Value,
    p_shut: Value,
    V_1: Value,
    p_cyl: Value,
    p_mot: Value,
) -> Value:
    """Gas speed at the walls."""
    return C_speed * S_pm + C_burn * V_d * T_shut / (p_shut * V_1) * (p_cyl - p_mot)


@formula("heat_transfer_coefficient", "woschni_1967", constants="kPa, m, m/s, K")
def woschni_coefficient(D: Value, p_cyl: Value, T_cyl: Value, w_gas: Value) -> Value:
    """Heat transfer coefficient from gas to walls.

    Notes
    -----
    The exponent of the bore is 0.2, that of the temperature 0.75 - 1.62 * 0.8 = -0.546,
    rounded to -0.55.
    """
    return 3.26 * (p_cyl / 1000) ** 0.8 * w_gas**0.8 / (D**0.2 * T_cyl**0.55)


@formula("wall_area", "heywood_1988, ch. 2")
def wall_area(A_head: Value, A_crown: Value, pi: Value, D: Value, x: Value) -> Value:
    """Area of the walls around the gas."""
    return A_head + A_crown + pi * D * x


@formula("wall_heat_rate", "heywood_1988, ch. 12", unit="J/rad")
def wall_heat_rate(h_wall: Value, A_wall: Value, T_cyl: Value, T_wall: Value, w: Value) -> Value:
    """Heat to the walls by crank angle."""
    return h_wall * A_wall * (T_cyl - T_wall) / w


@dataclass(frozen=True)
class HeatReleaseData:
    """Data of a cycle from heat release."""

    # Bore; revolutions per minute [m], [rpm]
    bore: float
    rotational_speed: float
    # Of the gas at intake closing [Pa], [K]
    shut_pressure: float
    shut_temperature: float
    heat: float | None = None  # Heat of the fuel per cycle; instead of it, the next three [J]
    # Mass of fuel, lower heating value, share of it that is released [kg], [J/kg], [-]
    fuel_per_cycle: float = 0.0
    heating_value: float = 0.0
    burning_efficiency: float = 1.0
    # Start of burning before top dead centre, duration, Wiebe exponent [deg], [deg], [-]
    burning_advance: float = 20.0
    burning_duration: float = 50.0
    burning_shape: float = 2.0
    # Ratio of specific heats (at 0 K where it has a slope), its change with temperature, specific gas
    # constant [-], [1/K], [J/(kg*K)]
    heat_ratio: float = 1.33
    heat_ratio_slope: float = 0.0
    gas_constant: float = 287.0
    has_wall_loss: bool = True  # Whether heat goes to the walls
    # Of the walls; areas of head and crown (the piston area if left out); polytrope without
    # burning [K], [m2], [m2], [-]
    wall_temperature: float = 450.0
    head_area: float | None = None
    crown_area: float | None = None
    motored_exponent: float = 1.35
    cycle: float = 720.0  # 720, or 360 for two strokes [deg]
    # After and before bottom dead centre; the ports of two strokes likewise, the last to close
    # and the first to open [deg]
    intake_closes: float = 50.0
    exhaust_opens: float = 60.0
    # Before and after top dead centre; with two strokes the scavenging ports open before bottom dead centre and the
    # exhaust ports shut after it [deg]
    intake_opens: float = 15.0
    exhaust_closes: float = 15.0
    # While gas is exchanged; with two strokes the first is that of scavenging [Pa]
    exhaust_pressure: float = 1.1e5
    intake_pressure: float = 0.9e5
    chamber: str = ""  # Path of its chamber in the description, in a linkage

    def stated_at(self, path: str) -> str:
        """Return the path in the description of the field that an engine states at `path`."""
        table, _, name = path.partition(".")
        if not self.chamber or path in ("", "crank.speed"):
            return path
        return {"cycle": f"{self.chamber}.{path}", "cylinder": f"{self.chamber}.{name}"}.get(table, "")


class Stage(NamedTuple):
    """Part of the closed period: from, to [deg]; whether fuel burns, and whether it has begun to."""

    start: float
    end: float
    burns: bool
    has_burnt: bool


def stages(data: HeatReleaseData, dead_centres: tuple[float, float]) -> tuple[Stage, Stage, Stage]:
    """Return compression, combustion and expansion in order; their length may be 0."""
    top, bottom = dead_centres
    closes = data.intake_closes
    if data.cycle == 360:
        # compression begins when the last ports close
        closes = max(closes, data.exhaust_closes)
    shut, opens = bottom + closes, bottom + 360.0 - data.exhaust_opens
    begin = top + 360.0 - data.burning_advance
    end = begin + data.burning_duration
    if begin < shut or end > opens:
        raise CrankworkError(ErrorMessage("burning_outside", begin=begin, end=end, shut=shut, opens=opens))
    return Stage(shut, begin, False, False), Stage(begin, end, True, True), Stage(end, opens, False, True)  # noqa: FBT003


def check_heat_release(data: HeatReleaseData) -> None:
    """Raise if the numbers contradict each other."""
    if data.heat_ratio + data.heat_ratio_slope * data.shut_temperature <= 1:
        raise CrankworkError(ErrorMessage("heat_ratio_low"))
    if data.cycle == 360 and data.exhaust_opens < data.intake_opens:
        raise CrankworkError(ErrorMessage("ports_early", intake=data.intake_opens, exhaust=data.exhaust_opens))
