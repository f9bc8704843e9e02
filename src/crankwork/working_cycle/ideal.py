"""Ideal cycles of 1 kg of a gas with constant heat capacities: their formulas and their diagrams.

Points: 1 begins the compression, 2 ends it. Otto: heat up to 3, expansion to 4. Diesel: heat at constant pressure up
to 3, expansion to 4. Dual: heat at constant volume up to 3, at constant pressure up to 4, expansion to 5.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from crankwork.formula.calculation import Calculation
from crankwork.formula.expression import FORMULAS, Value, formula
from crankwork.formula.traced_value import TracedValue
from crankwork.locale import ErrorMessage
from crankwork.notation import ARGUMENTS
from crankwork.working_cycle.calculated_cycle import CalculatedCycle, Corners
from crankwork.working_cycle.fuels import CycleError

IdealKind = Literal["otto", "ideal-diesel", "dual"]


@formula("isochoric_heat", "cengel_boles_2015, ch. 4")
def isochoric_heat(R_gas: Value, kappa: Value) -> Value:
    """Specific heat at constant volume of an ideal gas."""
    return R_gas / (kappa - 1)


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def compressed_temperature(T_st1: Value, r_c: Value, kappa: Value) -> Value:
    """Temperature after isentropic compression."""
    return T_st1 * r_c ** (kappa - 1)


@formula("state_pressure", "cengel_boles_2015, ch. 9")
def compressed_pressure(p_st1: Value, r_c: Value, kappa: Value) -> Value:
    """Pressure after isentropic compression."""
    return p_st1 * r_c**kappa


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def isochorically_heated(T_st2: Value, q_add: Value, c_v: Value) -> Value:
    """Temperature after heat at constant volume."""
    return T_st2 + q_add / c_v


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def isobarically_heated(T_st2: Value, q_add: Value, kappa: Value, c_v: Value) -> Value:
    """Temperature after heat at constant pressure."""
    return T_st2 + q_add / (kappa * c_v)


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def dually_heated(T_st3: Value, q_add: Value, c_v: Value, T_st2: Value, kappa: Value) -> Value:
    """Temperature after the rest of the heat at constant pressure."""
    return T_st3 + (q_add - c_v * (T_st3 - T_st2)) / (kappa * c_v)


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def raised_temperature(lam_p: Value, T_st2: Value) -> Value:
    """Temperature after a rise of pressure at constant volume, or of volume at constant pressure."""
    return lam_p * T_st2


@formula("state_pressure", "cengel_boles_2015, ch. 9")
def raised_pressure(lam_p: Value, p_st2: Value) -> Value:
    """Pressure after a pressure rise at constant volume."""
    return lam_p * p_st2


@formula("pressure_rise_ratio", "cengel_boles_2015, ch. 9")
def temperature_ratio(T_st3: Value, T_st2: Value) -> Value:
    """Ratio of temperatures: of the pressures at constant volume, of the volumes at constant pressure."""
    return T_st3 / T_st2


@formula("state_temperature", "cengel_boles_2015, ch. 9")
def expanded_temperature(T_st3: Value, rho_cut: Value, r_c: Value, kappa: Value) -> Value:
    """Temperature after isentropic expansion from the highest one."""
    return T_st3 * (rho_cut / r_c) ** (kappa - 1)


@formula("state_pressure", "cengel_boles_2015, ch. 9")
def expanded_pressure(p_st3: Value, rho_cut: Value, r_c: Value, kappa: Value) -> Value:
    """Pressure after isentropic expansion of an Otto or Diesel cycle."""
    return p_st3 * (rho_cut / r_c) ** kappa


@formula("heat_added", "cengel_boles_2015, ch. 9")
def heat_at_constant_volume(c_v: Value, T_st3: Value, T_st2: Value) -> Value:
    """Heat between two temperatures at constant volume."""
    return c_v * (T_st3 - T_st2)


@formula("heat_added", "cengel_boles_2015, ch. 9")
def isobaric_heat_added(kappa: Value, c_v: Value, T_st3: Value, T_st2: Value) -> Value:
    """Heat added at constant pressure."""
    return kappa * c_v * (T_st3 - T_st2)


@formula("heat_added", "cengel_boles_2015, ch. 9")
def dual_heat_added(c_v: Value, T_st3: Value, T_st2: Value, kappa: Value, T_st4: Value) -> Value:
    """Heat added at constant volume, then pressure."""
    return c_v * (T_st3 - T_st2) + kappa * c_v * (T_st4 - T_st3)


@formula("ideal_work", "cengel_boles_2015, ch. 9")
def ideal_work(q_add: Value, q_rej: Value) -> Value:
    """Work of a cycle."""
    return q_add - q_rej


@formula("thermal_efficiency", "cengel_boles_2015, ch. 9")
def thermal_efficiency(w_t: Value, q_add: Value) -> Value:
    """Work over heat added."""
    return w_t / q_add


@formula("thermal_efficiency", "cengel_boles_2015, ch. 9")
def otto_efficiency(r_c: Value, kappa: Value) -> Value:
    """Efficiency of the Otto cycle in closed form."""
    return 1 - 1 / r_c ** (kappa - 1)


@formula("thermal_efficiency", "cengel_boles_2015, ch. 9")
def dual_efficiency(r_c: Value, kappa: Value, lam_p: Value, rho_cut: Value) -> Value:
    """Efficiency of the dual cycle in closed form; of the Diesel cycle with a pressure ratio of 1."""
    return 1 - (lam_p * rho_cut**kappa - 1) / (r_c ** (kappa - 1) * (lam_p - 1 + kappa * lam_p * (rho_cut - 1)))


@formula("ideal_mean_pressure", "cengel_boles_2015, ch. 9")
def ideal_mean_pressure(w_t: Value, p_st1: Value, r_c: Value, R_gas: Value, T_st1: Value) -> Value:
    """Work over the change of volume."""
    return w_t * p_st1 * r_c / (R_gas * T_st1 * (r_c - 1))


@dataclass(frozen=True)
class IdealData:
    """Data of an ideal cycle; exactly one of them states how hot it becomes."""

    kind: IdealKind  # Heat at constant volume, at constant pressure, or first at constant volume
    compression_ratio: float  # Largest over smallest volume [-]
    # Absolute state at the start of compression [Pa], [K]
    pressure: float
    temperature: float
    # Heat added to 1 kg of gas, or the highest temperature [J/kg], [K]
    heat: float | None = None
    peak_temperature: float | None = None
    # Rise of pressure at constant volume: needed by a dual cycle, or states how
    # hot an Otto cycle becomes [-]
    pressure_ratio: float | None = None
    # Rise of volume at constant pressure: states how hot the other two become [-]
    cut_off: float | None = None
    # Ratio of specific heats, gas constant [-], [J/(kg K)]
    adiabatic_exponent: float = 1.4
    gas_constant: float = 287.0
    angle: float = 720.0  # Crank angle of the cycle [deg]


def ideal_cycle(data: IdealData) -> CalculatedCycle:
    """Return an ideal cycle.

    States `state_pressure.1`, `state_temperature.1` and so on, heats, work, efficiency both as work over heat and in
    closed form (`thermal_efficiency.closed`), mean pressure. Source: cengel_boles_2015, ch. 9; kolchin_demidov_2008,
    ch. 2.
    """
    _check(data)
    worked = _given(data)
    worked(isochoric_heat)
    # 1 and 2 are before and after compression; heat leads to 3, in a dual cycle over 3 to 4
    cold = _work(worked, compressed_temperature, "state_temperature.2")
    compressed = _work(worked, compressed_pressure, "state_pressure.2")
    _HEATINGS[data.kind](worked, data)
    last = 5 if data.kind == "dual" else 4
    hot, heated = f"state_temperature.{last - 1}", f"state_pressure.{last - 1}"
    rise, cut_off = worked["pressure_rise_ratio"], worked["cut_off"]
    if not (worked[hot].value > cold.value and rise.value >= 1 and 1 <= cut_off.value < data.compression_ratio):
        numbers = {"cold": cold.value, "hot": worked[hot].value, "rise": rise.value, "cut_off": cut_off.value}
        raise CycleError(ErrorMessage("heat_backwards", **numbers, ratio=data.compression_ratio))
    _results(worked, data, last)
    ratio, exponent = worked["compression_ratio"], worked["gas_heat_ratio"]
    first, peak, end = (worked[key] for key in ("state_pressure.1", heated, f"state_pressure.{last}"))
    corners = Corners(first, first, compressed, peak, end, cut_off, exponent, exponent, ratio)
    shown = (
        "compression_ratio", "state_pressure.1", "state_temperature.1", heated, hot, "gas_heat_ratio",
        "specific_gas_constant", "pressure_rise_ratio", "cut_off", "heat_added",
    )  # fmt: skip
    return CalculatedCycle(data.kind, data.angle, corners, {key: worked[key] for key in shown} | worked.found)


def _given(data: IdealData) -> Calculation:
    """Return the calculation before its first step."""
    worked = Calculation()
    worked.given("compression_ratio", data.compression_ratio, "cylinder.compression_ratio")
    worked.given("gas_heat_ratio", data.adiabatic_exponent, "cycle.adiabatic_exponent")
    worked.given("specific_gas_constant", data.gas_constant)
    worked.given("state_pressure.1", data.pressure, "cycle.intake_pressure")
    worked.given("state_temperature.1", data.temperature, "cycle.intake_temperature")
    for key, value, name in (
        ("heat_added", data.heat, "heat"),
        ("pressure_rise_ratio", data.pressure_ratio, "pressure_ratio"),
        ("cut_off", data.cut_off, "cut_off"),
    ):
        if value is not None:
            worked.given(key, value, f"cycle.{name}")
    hottest = "state_temperature.4" if data.kind == "dual" else "state_temperature.3"
    if data.peak_temperature is not None:
        worked.given(hottest, data.peak_temperature, "cycle.peak_temperature")
    return worked


def _work(
    worked: Calculation, function: Callable[..., Any], key: str = "", *, later: int = 0, **arguments: TracedValue
) -> TracedValue:
    """Apply a formula whose arguments are numbered states, `later` points further on."""
    states = {
        name: worked[f"{ARGUMENTS[name].quantity}.{int(name[-1]) + later}"]
        for name in FORMULAS[function.__name__].arguments
        if name.startswith(("T_st", "p_st")) and name not in arguments
    }
    return worked(function, key, **states, **arguments)


def _otto(worked: Calculation, data: IdealData) -> None:
    worked.absent("cut_off", 1.0)
    if data.heat is not None:
        _work(worked, isochorically_heated, "state_temperature.3")
    if data.pressure_ratio is not None:
        _work(worked, raised_temperature, "state_temperature.3")
    elif "state_temperature.3" in worked.known:
        _work(worked, temperature_ratio)
    else:
        raise CycleError(ErrorMessage("otto_heat"))
    _work(worked, raised_pressure, "state_pressure.3")


def _diesel(worked: Calculation, data: IdealData) -> None:
    worked.absent("pressure_rise_ratio", 1.0)
    worked.known["state_pressure.3"] = worked["state_pressure.2"].named("state_pressure.3")
    if data.heat is not None:
        _work(worked, isobarically_heated, "state_temperature.3")
    if data.cut_off is not None:
        _work(worked, raised_temperature, "state_temperature.3", lam_p=worked["cut_off"])
    elif "state_temperature.3" in worked.known:
        _work(worked, temperature_ratio, "cut_off")
    else:
        raise CycleError(ErrorMessage("diesel_heat"))


def _dual(worked: Calculation, data: IdealData) -> None:
    if data.pressure_ratio is None:
        raise CycleError(ErrorMessage("dual_rise"))
    _work(worked, raised_temperature, "state_temperature.3")
    raised = _work(worked, raised_pressure, "state_pressure.3")
    worked.known["state_pressure.4"] = raised.named("state_pressure.4")
    if data.heat is not None:
        _work(worked, dually_heated, "state_temperature.4")
    if data.cut_off is not None:
        _work(worked, raised_temperature, "state_temperature.4", later=1, lam_p=worked["cut_off"])
    elif "state_temperature.4" in worked.known:
        _work(worked, temperature_ratio, "cut_off", later=1)
    else:
        raise CycleError(ErrorMessage("dual_heat"))


_HEATINGS = {"otto": _otto, "ideal-diesel": _diesel, "dual": _dual}
_HEATS: dict[str, Callable[..., Any]] = {
    "otto": heat_at_constant_volume,
    "ideal-diesel": isobaric_heat_added,
    "dual": dual_heat_added,
}


def _results(worked: Calculation, data: IdealData, last: int) -> None:
    """Calculate expansion, heats, work, efficiency and mean pressure."""
    _work(worked, expanded_temperature, f"state_temperature.{last}", later=last - 4)
    _work(worked, expanded_pressure, f"state_pressure.{last}", later=last - 4)
    if data.heat is None:
        _work(worked, _HEATS[data.kind])
    warm, cold = worked[f"state_temperature.{last}"], worked["state_temperature.1"]
    worked(heat_at_constant_volume, "heat_rejected", T_st3=warm, T_st2=cold)
    worked(ideal_work)
    worked(thermal_efficiency)
    closed = otto_efficiency if data.kind == "otto" else dual_efficiency
    worked(closed, "thermal_efficiency.closed")
    _work(worked, ideal_mean_pressure)


def _check(data: IdealData) -> None:
    """Raise unless the data are those of one cycle."""
    if data.compression_ratio <= 1:
        raise CycleError(ErrorMessage("not_above", name="compression_ratio", value=data.compression_ratio, limit=1))
    statements = [data.heat, data.peak_temperature, data.cut_off]
    statements += [] if data.kind == "dual" else [data.pressure_ratio]
    if sum(statement is not None for statement in statements) > 1:
        raise CycleError(ErrorMessage("heat_said_twice"))
    if (data.kind == "otto" and data.cut_off) or (data.kind == "ideal-diesel" and data.pressure_ratio):
        wrong = "cut_off" if data.cut_off else "pressure_ratio"
        raise CycleError(ErrorMessage("cycle_has_no", kind=data.kind, name=wrong))
