"""The working cycle by Grinevetsky and Mazing: mixture, charge, compression, combustion, expansion, results, size.

That of an assignment, whose sheet gives pressures and exponents in place of a fuel, is worked by the same formulas.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from crankwork.formula.calculation import Calculation
from crankwork.formula.expression import Value, formula
from crankwork.formula.traced_value import ProcedureValue, TracedValue, absent, given
from crankwork.kinematics.slider_crank import SliderCrank, mean_piston_speed, stroke_offset
from crankwork.loads.gas import clearance_volume, compression_ratio, piston_area, swept_volume
from crankwork.locale import ErrorMessage
from crankwork.working_cycle import charge, engine_size, heat_capacities
from crankwork.working_cycle.calculated_cycle import CalculatedCycle, Corners, Notice
from crankwork.working_cycle.cycle_data import GrinevetskyData, traced_cycle_inputs, with_usual_values
from crankwork.working_cycle.engine_size import effective_mean_pressure, mechanical_loss_pressure
from crankwork.working_cycle.fuels import FUELS, CycleError, burning
from crankwork.working_cycle.usual_ranges import cycle_notices, range_notices

# inputs that are shown with the results
_SHOWN = (
    "fuel_heating_value", "excess_air", "compression_ratio", "ambient_temperature", "charge_pressure",
    "charge_temperature", "intake_pressure", "residual_pressure", "residual_temperature", "charge_heating",
    "compression_exponent", "expansion_exponent", "heat_use", "filling_factor", "cut_off", "lost_stroke",
    "strokes_per_cycle", "cylinder_count", "pressure_rise_ratio",
)  # fmt: skip
# the laws of heats are fitted up to this temperature before combustion [K]
_HOTTEST = 3000.0
# between a size that is stated and one in whole millimetres [m]
_SAME_SIZE = 1e-9
_CONVERGED = 1e-13
_MAX_PASSES = 200


def grinevetsky(data: GrinevetskyData) -> CalculatedCycle:
    """Return the working cycle of an engine.

    Values in the order of textbooks, corners of the theoretical diagram, notices. `data`: with power, or bore and
    stroke, the engine is sized too. Source: kolchin_demidov_2008, ch. 1, 3, 4; nguyen_tat_tien_2000.
    """
    full = with_usual_values(data)
    worked = traced_cycle_inputs(data, full)
    burning(worked, full.fuel or FUELS[full.kind])
    mixture(worked)
    _intake(worked, full)
    _compression(worked, full)
    _combustion(worked, full)
    _expansion(worked, full)
    worked(engine_size.theoretical_mean_pressure, **_whole_expansion(worked, full))
    worked(engine_size.filled_mean_pressure)
    worked(engine_size.indicated_efficiency)
    worked(engine_size.fuel_consumption, "indicated_fuel_consumption", eta_e=worked["indicated_efficiency"])
    notices = list[Notice]()
    if full.power or full.stroke:
        notices += sized(worked, full)
        _effective(worked, full)
        heat_balance(worked, full)
    trace = {key: worked[key] for key in _SHOWN if key in worked.known and key not in worked.found} | worked.found
    notices += cycle_notices(full.kind, full.heat_capacities, {key: traced.value for key, traced in trace.items()})
    notices += range_notices(trace.values())
    return CalculatedCycle(full.kind, 180.0 * full.strokes, _corners(worked), trace, tuple(notices))


def _corners(worked: Calculation) -> Corners:
    names = (
        "residual_pressure", "intake_pressure", "compression_pressure", "combustion_pressure", "expansion_pressure",
        "cut_off", "compression_exponent", "expansion_exponent", "compression_ratio", "lost_stroke",
    )  # fmt: skip
    return Corners(*(worked[name] for name in names))


def _intake(worked: Calculation, data: GrinevetskyData) -> None:
    if data.charge_pressure is None:
        worked.known["charge_pressure"] = worked["ambient_pressure"].named("charge_pressure")
    if data.charge_temperature is None and data.charge_pressure is None:
        worked.known["charge_temperature"] = worked["ambient_temperature"].named("charge_temperature")
    elif data.charge_temperature is None:
        worked(charge.compressor_temperature)
        worked(charge.cooled_charge_temperature)
    warm = worked["charge_temperature"].value + worked["charge_heating"].value
    if min(warm, worked["charge_temperature"].value) <= 0:
        raise CycleError(ErrorMessage("charge_cold", temperature=warm))
    worked(charge.charge_density)
    if data.intake_pressure is None:
        worked(charge.intake_pressure_loss)
        worked(charge.intake_pressure)
    intake, residual = worked["intake_pressure"].value, worked["residual_pressure"].value
    if data.compression_ratio * data.charge_up * intake <= data.scavenging * residual:
        raise CycleError(ErrorMessage("intake_weak", intake=intake / 1e6, residual=residual / 1e6))


def _compression(worked: Calculation, data: GrinevetskyData) -> None:
    for function in _FILLINGS[data.intake_school]:
        worked(function)
    if data.lost_stroke:
        closed = worked["volumetric_efficiency"].named("volumetric_efficiency.before_ports")
        worked(engine_size.ported_volumetric_efficiency, eta_v=closed)
        worked(charge.geometric_compression_ratio)
    worked(charge.compression_pressure)
    temperature = worked(charge.compression_temperature).value
    if temperature > _HOTTEST:
        raise CycleError(ErrorMessage("compression_hot", temperature=temperature))


# residual gas, temperature and volumetric efficiency at the end of intake
_FILLINGS: dict[str, tuple[Callable[..., Any], ...]] = {
    "kolchin": (charge.residual_fraction, charge.intake_temperature, charge.volumetric_efficiency),
    "vietnamese": (
        charge.residual_fraction_vietnamese,
        charge.intake_temperature_vietnamese,
        charge.volumetric_efficiency_vietnamese,
    ),
}


def _combustion(worked: Calculation, data: GrinevetskyData) -> None:
    law = data.heat_capacities
    celsius = law == "kolchin"
    worked(molar_change)
    worked(working_mixture_heat)
    heat_capacities.product_coefficients(worked, law)
    temperature = worked(charge.compression_celsius) if celsius else worked["compression_temperature"]
    capacity = heat_capacities.fresh_heat(worked, law, temperature)
    if law == "linear":
        # its fresh charge includes the residual gas
        worked.known["mixture_heat"] = capacity
    else:
        heat_capacities.residual_heat(worked, law, temperature)
        worked(heat_capacities.mixture_heat)
    constant = {}
    if data.kind == "petrol":
        worked(isochoric_energy, th_gas=temperature)
    else:
        worked(dual_energy, th_gas=temperature)
        constant["a_prod"] = worked(isobaric_heat_constant)
    worked(burnt_celsius if celsius else burnt_temperature, **constant)
    if celsius:
        worked(combustion_kelvin)
    _rise(worked, data)


def _rise(worked: Calculation, data: GrinevetskyData) -> None:
    """Calculate pressure and volume at z."""
    if data.kind == "petrol":
        worked(isochoric_pressure)
        worked(real_combustion_pressure)
        worked(pressure_rise_ratio)
        return
    worked(dual_pressure)
    rho = worked(cut_off).value
    if not 1 <= rho <= data.compression_ratio:
        raise CycleError(ErrorMessage("cut_off_low" if rho < 1 else "cut_off_high", ratio=rho))


def _expansion(worked: Calculation, data: GrinevetskyData) -> None:
    if data.kind == "diesel":
        worked(afterexpansion)
    expansion_ratio = _whole_expansion(worked, data)
    worked(expansion_pressure, **expansion_ratio)
    worked(expansion_temperature, **expansion_ratio)
    worked(residual_temperature_found)
    worked(residual_temperature_deviation)


def _whole_expansion(worked: Calculation, data: GrinevetskyData) -> dict[str, TracedValue]:
    """Return the ratio of the whole expansion as an argument; in petrol engines it equals the compression ratio."""
    if data.kind == "petrol":
        return {"delta_post": worked["compression_ratio"]}
    return {"delta_post": worked["afterexpansion"]}


def _effective(worked: Calculation, data: GrinevetskyData) -> None:
    """Calculate the effective results and the clearance volume of a sized engine."""
    worked(engine_size.mechanical_efficiency)
    worked(engine_size.effective_efficiency)
    worked(engine_size.fuel_consumption)
    worked(engine_size.effective_power)
    worked(engine_size.effective_torque, pi=data.pi)
    worked(engine_size.fuel_rate)
    worked(engine_size.power_per_litre)
    geometric_ratio = worked.known.get("geometric_compression_ratio", worked["compression_ratio"])
    worked(clearance_volume, r_c=geometric_ratio)


@formula("molar_change", "kolchin_demidov_2008, ch. 3")
def molar_change(mu_0: Value, gamma_r: Value) -> Value:
    """Molar change of the working mixture."""
    return (mu_0 + gamma_r) / (1 + gamma_r)


@formula("working_mixture_heat", "kolchin_demidov_2008, ch. 3")
def working_mixture_heat(H_fuel: Value, dH_u: Value, M_fresh: Value, gamma_r: Value) -> Value:
    """Heat that 1 kmol of working mixture gives; the 1000 makes kJ of J."""
    return (H_fuel - dH_u) / (1000 * M_fresh * (1 + gamma_r))


@formula("combustion_energy", "kolchin_demidov_2008, ch. 3")
def isochoric_energy(xi_z: Value, H_mix: Value, mc_mix: Value, th_gas: Value) -> Value:
    """Energy at z after burning at constant volume, from the zero of the law of heats."""
    return xi_z * H_mix + mc_mix * th_gas


@formula("combustion_energy", "kolchin_demidov_2008, ch. 3")
def dual_energy(  # noqa: PLR0913 - one argument per symbol
    xi_z: Value, H_mix: Value, mc_mix: Value, R_m: Value, lam_p: Value, th_gas: Value, T_zero: Value, mu: Value
) -> Value:
    """Enthalpy at z after burning at constant volume, then pressure, from the zero of the law of heats."""
    return xi_z * H_mix + (mc_mix + R_m * lam_p) * th_gas + T_zero * R_m * (lam_p - mu)


@formula("product_heat_constant_pressure", "kolchin_demidov_2008, ch. 3")
def isobaric_heat_constant(a_prod: Value, R_m: Value) -> Value:
    """Constant of the heat of the products at constant pressure."""
    return a_prod + R_m


@formula("combustion_celsius", "kolchin_demidov_2008, ch. 3", unit="degC")
def burnt_celsius(a_prod: Value, b_prod: Value, E_z: Value, mu: Value) -> Value:
    """Temperature at z, the positive root of mu (a + b t) t = E with heats at constant volume or pressure."""
    return (np.sqrt(a_prod**2 + 4 * b_prod * E_z / mu) - a_prod) / (2 * b_prod)


@formula("combustion_temperature", "kolchin_demidov_2008, ch. 3")
def combustion_kelvin(t_z: Value, T_zero: Value) -> Value:
    """Absolute temperature at z."""
    return t_z + T_zero


@formula("combustion_temperature", "nguyen_tat_tien_2000")
def burnt_temperature(a_prod: Value, b_prod: Value, E_z: Value, mu: Value) -> Value:
    """Absolute temperature at z, the positive root of mu (a + b T) T = E, as for degrees Celsius."""
    return (np.sqrt(a_prod**2 + 4 * b_prod * E_z / mu) - a_prod) / (2 * b_prod)


@formula("combustion_pressure", "kolchin_demidov_2008, ch. 3")
def isochoric_pressure(p_c: Value, mu: Value, T_z: Value, T_c: Value) -> Value:
    """Pressure at z after burning at constant volume."""
    return p_c * mu * T_z / T_c


@formula("combustion_pressure", "kolchin_demidov_2008, ch. 3")
def dual_pressure(p_c: Value, lam_p: Value) -> Value:
    """Pressure at z where the pressure ratio is chosen."""
    return p_c * lam_p


@formula("pressure_rise_ratio", "kolchin_demidov_2008, ch. 3")
def pressure_rise_ratio(p_z: Value, p_c: Value) -> Value:
    """Pressure ratio of burning."""
    return p_z / p_c


@formula("combustion_pressure_real", "kolchin_demidov_2008, ch. 3")
def real_combustion_pressure(p_z: Value) -> Value:
    """Largest pressure of a real petrol engine."""
    return 0.85 * p_z


@formula("cut_off", "kolchin_demidov_2008, ch. 3")
def cut_off(mu: Value, T_z: Value, lam_p: Value, T_c: Value) -> Value:
    """Cut-off ratio."""
    return mu * T_z / (lam_p * T_c)


@formula("afterexpansion", "kolchin_demidov_2008, ch. 3")
def afterexpansion(r_c: Value, rho_cut: Value) -> Value:
    """Expansion ratio after z."""
    return r_c / rho_cut


@formula("expansion_pressure", "kolchin_demidov_2008, ch. 3")
def expansion_pressure(p_z: Value, delta_post: Value, n_2: Value) -> Value:
    """Pressure at the end of expansion."""
    return p_z / np.power(delta_post, n_2)


@formula("expansion_temperature", "kolchin_demidov_2008, ch. 3")
def expansion_temperature(T_z: Value, delta_post: Value, n_2: Value) -> Value:
    """Temperature at the end of expansion."""
    return T_z / np.power(delta_post, n_2 - 1)


@formula("residual_temperature_found", "kolchin_demidov_2008, ch. 3")
def residual_temperature_found(T_exp: Value, p_exp: Value, p_r: Value, m_exh: Value) -> Value:
    """Temperature of the residual gas from the end of expansion."""
    return T_exp / np.power(p_exp / p_r, (m_exh - 1) / m_exh)


@formula("residual_temperature_deviation", "kolchin_demidov_2008, ch. 3")
def residual_temperature_deviation(T_r_found: Value, T_r: Value) -> Value:
    """Deviation of the temperature of the residual gas from the one assumed."""
    return (T_r_found - T_r) / T_r


@formula("fresh_charge_amount", "kolchin_demidov_2008, ch. 1")
def fresh_charge_amount(alpha_air: Value, L_air: Value, m_T: Value) -> Value:
    """Fresh charge of air and fuel vapour."""
    return alpha_air * L_air + 1 / m_T


@formula("product_co", "kolchin_demidov_2008, ch. 1")
def carbon_monoxide(alpha_air: Value, K_H: Value, L_air: Value) -> Value:
    """Carbon monoxide of a rich mixture."""
    return 2 * (1 - alpha_air) / (1 + K_H) * 0.208 * L_air


@formula("product_h2", "kolchin_demidov_2008, ch. 1")
def hydrogen_left(K_H: Value, M_CO: Value) -> Value:
    """Hydrogen of a rich mixture."""
    return K_H * M_CO


@formula("product_co2", "kolchin_demidov_2008, ch. 1", constants="molar masses in kg/kmol")
def carbon_dioxide(C_f: Value, M_CO: Value) -> Value:
    """Carbon dioxide, of the carbon that does not burn halfway."""
    return C_f / 12 - M_CO


@formula("product_h2o", "kolchin_demidov_2008, ch. 1", constants="molar masses in kg/kmol")
def water(H_f: Value, M_H2: Value) -> Value:
    """Water vapour, of the hydrogen that does burn."""
    return H_f / 2 - M_H2


@formula("product_o2", "kolchin_demidov_2008, ch. 1")
def oxygen_left(alpha_air: Value, L_air: Value) -> Value:
    """Oxygen that a lean mixture does not use."""
    return 0.208 * (alpha_air - 1) * L_air


@formula("product_n2", "kolchin_demidov_2008, ch. 1")
def nitrogen(alpha_air: Value, L_air: Value) -> Value:
    """Nitrogen of the air."""
    return 0.792 * alpha_air * L_air


@formula("product_amount", "kolchin_demidov_2008, ch. 1")
def products(M_CO2: Value, M_CO: Value, M_H2O: Value, M_H2: Value, M_O2: Value, M_N2: Value) -> Value:
    """All products."""
    return M_CO2 + M_CO + M_H2O + M_H2 + M_O2 + M_N2


@formula("molar_change_ideal", "kolchin_demidov_2008, ch. 1")
def molar_change_ideal(M_prod: Value, M_fresh: Value) -> Value:
    """Molar change of the fresh charge by burning."""
    return M_prod / M_fresh


@formula("heat_lost_incomplete", "kolchin_demidov_2008, ch. 1", constants="heat of CO and H2 in J/kmol")
def heat_lost_incomplete(alpha_air: Value, L_air: Value) -> Value:
    """Heat that a rich mixture does not give."""
    return 119.95e6 * (1 - alpha_air) * L_air


def mixture(worked: Calculation) -> None:
    """Calculate charge and products of 1 kg of fuel.

    `worked`: has the fuel, the air that it needs, the excess air and the share of hydrogen in the products of a rich
    mixture; takes the results.
    """
    worked(fresh_charge_amount)
    excess_air = worked["excess_air"].value
    is_rich = excess_air < 1
    if is_rich:
        worked(carbon_monoxide)
        worked(hydrogen_left)
    else:
        for key in ("product_co", "product_h2"):
            worked.absent(key)
    if min(worked(carbon_dioxide).value, worked(water).value) < 0:
        raise CycleError(ErrorMessage("mixture_rich", value=excess_air))
    if is_rich:
        worked.absent("product_o2")
    else:
        worked(oxygen_left)
    worked(nitrogen)
    worked(products)
    worked(molar_change_ideal)
    if is_rich:
        worked(heat_lost_incomplete)
    else:
        worked.absent("heat_lost_incomplete")


def sized(worked: Calculation, data: GrinevetskyData) -> list[Notice]:
    """Calculate the size of the engine for an indicated mean pressure, with a notice if it was rounded.

    Losses depend on the mean piston speed, and that on the unknown stroke: the calculation is repeated until the stroke
    converges, and its last pass is the one that is shown.
    """
    if data.bore is not None and data.stroke is not None and not data.rounds_size:
        return _of_stated_size(worked, data)
    stroke = 0.0
    for _ in range(_MAX_PASSES):
        following = _of_power(worked.again(""), data, stroke)
        if abs(following - stroke) <= _CONVERGED * following:
            break
        stroke = following
    else:
        raise CycleError(ErrorMessage("power_unreached"))
    if not data.rounds_size:
        _of_power(worked, data, stroke)
        return []
    exact_size = worked.again(".before_rounding")
    _of_power(exact_size, data, stroke)
    millimetres = {key: exact_size[key].value * 1e3 for key in ("bore", "stroke")}
    if min(round(value) for value in millimetres.values()) == 0:
        raise CycleError(ErrorMessage("power_tiny", **millimetres))
    stated_size = {"bore": data.bore, "stroke": data.stroke}
    if any(size and abs(size - round(millimetres[key]) / 1e3) > _SAME_SIZE for key, size in stated_size.items()):
        return _of_stated_size(worked, data)
    values: dict[str, float | str] = {}
    for key in ("bore", "stroke"):
        exact = worked.keep(exact_size[key].named(key))
        taken = round(exact.value * 1e3) / 1e3
        worked.known[key] = TracedValue(ProcedureValue(taken, "rounded", (exact,)), key)
        values |= {key: exact.value * 1e3, f"{key}_taken": taken * 1e3}
    _of_size(worked, data)
    return [("cycle_rounded_size", values)]


def _of_stated_size(worked: Calculation, data: GrinevetskyData) -> list[Notice]:
    stated = given("stroke", data.stroke or 0.0, "crank.stroke")
    worked.known["stroke"] = stated if data.lengths is None else _stroke_of(data.lengths)
    _of_size(worked, data)
    return []


def _stroke_of(lengths: SliderCrank) -> TracedValue:
    r, l, e = (given(key, float(length), path) for (key, path), length in zip(_LENGTHS, lengths, strict=True))  # noqa: E741
    stroke: TracedValue = stroke_offset(l, r, e)
    return stroke.named("stroke")


_LENGTHS = (("crank_radius", "crank.radius"), ("rod_length", "rod.length"), ("offset", "cylinder.offset"))


def _effective_pressure(worked: Calculation, data: GrinevetskyData) -> None:
    """Calculate the effective mean pressure at a stroke."""
    if not isinstance(data.mechanical_loss, tuple):
        raise CycleError(ErrorMessage("losses_two"))
    speed = worked(mean_piston_speed).value
    loss = worked(mechanical_loss_pressure).value
    if worked(effective_mean_pressure).value <= 0:
        indicated = worked["indicated_mean_pressure"].value / 1e6
        raise CycleError(ErrorMessage("losses_all", speed=speed, loss=loss / 1e6, indicated=indicated))


def _of_power(worked: Calculation, data: GrinevetskyData, stroke: float) -> float:
    """Calculate the size that the power needs at an assumed stroke, and return the stroke that follows. [m]"""
    worked.known["stroke"] = TracedValue(ProcedureValue(stroke, "root"), "stroke")
    _effective_pressure(worked, data)
    worked(engine_size.displacement_of_power, N_e=given("effective_power", data.power or 0.0, "cycle.power"))
    worked(engine_size.swept_volume_of_one)
    worked(engine_size.bore_of_volume, pi=data.pi)
    return worked(engine_size.stroke_of_bore).value


def _of_size(worked: Calculation, data: GrinevetskyData) -> None:
    """Calculate the size of an engine with given bore and stroke."""
    worked(piston_area, pi=data.pi)
    worked(swept_volume)
    worked(engine_size.displacement)
    _effective_pressure(worked, data)


PARTS = {
    "effective": "effective_power", "to_coolant": "heat_to_coolant", "to_exhaust": "heat_to_exhaust",
    "unburnt": "heat_unburnt", "rest": "heat_rest",
}  # fmt: skip


def heat_balance(worked: Calculation, data: GrinevetskyData) -> None:
    """Calculate the heat balance of a sized engine: power, coolant, exhaust, unburnt, rest, and their shares.

    `worked`: has charge, products, power and fuel; takes the results. Source: kolchin_demidov_2008, ch. 4.
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


def _exhaust(worked: Calculation, data: GrinevetskyData) -> None:
    """Calculate the heat of the exhaust gas."""
    law = data.heat_capacities
    hot, cold = (
        heat_capacities.as_counted(worked, law, worked[key], name)
        for key, name in (("residual_temperature", "exhaust"), ("charge_temperature", "charge"))
    )
    heats = (
        heat_capacities.residual_heat(worked, law, hot, "product_heat.exhaust"),
        heat_capacities.fresh_heat(worked, law, cold, "fresh_charge_heat.charge"),
    )
    exhaust, fresh = (
        worked(engine_size.molar_enthalpy, f"molar_enthalpy.{name}", mc_gas=heat, th_gas=temperature)
        for name, heat, temperature in zip(("exhaust", "charge"), heats, (hot, cold), strict=True)
    )
    worked(engine_size.heat_to_exhaust, h_prod=exhaust, h_fresh=fresh)


AssignedKind = Literal["assigned-petrol", "assigned-diesel"]


@formula("compression_exponent", "kolchin_demidov_2008, ch. 3")
def compression_exponent(p_c: Value, p_a: Value, r_c: Value) -> Value:
    """Exponent of the polytrope between the pressures at both ends of compression."""
    return np.log(p_c / p_a) / np.log(r_c)


@formula("expansion_exponent", "kolchin_demidov_2008, ch. 3")
def expansion_exponent(p_z: Value, p_exp: Value, delta_post: Value) -> Value:
    """Exponent of the polytrope between the pressures at both ends of expansion."""
    return np.log(p_z / p_exp) / np.log(delta_post)


@dataclass(frozen=True)
class AssignedData:
    """What an assignment gives; of two equivalent values one is None. [SI]"""

    kind: AssignedKind
    angle: float  # Crank angle of the cycle [deg]
    # At the points a, z and r, absolute [Pa]
    intake_pressure: float
    peak_pressure: float | None
    residual_pressure: float
    pressure_ratio: float | None  # Of burning, in place of the pressure at z [-]
    # Of the polytropes [-], or the pressures at their ends [Pa]
    compression_exponent: float | None
    compression_pressure: float | None
    expansion_exponent: float | None
    expansion_pressure: float | None
    cut_off: float  # Volume at z over the clearance volume [-]
    compression_ratio: float | None  # Or both volumes [-], [m3]
    clearance_volume: float | None = None
    total_volume: float | None = None


# keys of quantities that are named otherwise in a file
_KEYS = {"peak_pressure": "combustion_pressure", "pressure_ratio": "pressure_rise_ratio"}
_OF_CYLINDER = ("compression_ratio", "clearance_volume")


def assigned_cycle(data: AssignedData) -> CalculatedCycle:
    """Return the cycle of an assignment: pressures at c, z and b, and the mean pressure of the sharp diagram."""
    worked = Calculation()
    for name, value in vars(data).items():
        if name in ("kind", "angle") or value is None:
            continue
        table = "cylinder" if name in _OF_CYLINDER else "cycle"
        worked.given(_KEYS.get(name, name), value, f"{table}.{name}")
    if data.cut_off == 1.0:
        worked.absent("cut_off", 1.0)
    stated = dict(worked.known)
    if data.total_volume is not None:
        total, clearance = worked["total_volume"], worked["clearance_volume"]
        worked(compression_ratio, V_d=total - clearance)
    if data.compression_exponent is None:
        worked(compression_exponent)
    else:
        worked(charge.compression_pressure)
    worked(dual_pressure if data.peak_pressure is None else pressure_rise_ratio)
    _check(worked)
    worked(afterexpansion)
    if data.expansion_exponent is None:
        worked(expansion_exponent)
    else:
        worked(expansion_pressure)
    if 1.0 not in (worked["compression_exponent"].value, worked["expansion_exponent"].value):
        worked(engine_size.theoretical_mean_pressure)
    worked.absent("lost_stroke")
    corners = _corners(worked)
    if data.total_volume is not None:
        corners = corners._replace(V_a=worked["total_volume"])
    shown = {key: known for key, known in stated.items() if not known.is_absent}
    return CalculatedCycle(data.kind, data.angle, corners, shown | worked.found)


def _check(worked: Calculation) -> None:
    """Raise where the data contradict one another."""
    rise, cut_off, ratio = (worked[key].value for key in ("pressure_rise_ratio", "cut_off", "compression_ratio"))
    if rise < 1 or not 1 <= cut_off < ratio:
        raise CycleError(ErrorMessage("assigned_backwards", rise=rise, cut_off=cut_off, ratio=ratio))
