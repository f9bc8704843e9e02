"""What a test bed measures, and the power, losses, efficiencies and heat that follow from whatever of it is known."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

import numpy as np

from crankwork.errors import CrankworkError
from crankwork.formula.calculation import Calculation
from crankwork.formula.expression import FORMULAS, Value, formula
from crankwork.formula.traced_value import TracedValue
from crankwork.kinematics.slider_crank import mean_piston_speed
from crankwork.loads.gas import piston_area, swept_volume
from crankwork.notation import ARGUMENTS
from crankwork.working_cycle import engine_size
from crankwork.working_cycle.charge import charge_density
from crankwork.working_cycle.ideal import otto_efficiency

# what stated values of the same thing may differ by [-]
_SAME = 1e-6
_TEXT, _AIR = "heywood_1988, ch. 2", "heywood_1988, ch. 13"
# keys of the table of a test that are no quantities: those that they state
MEASURED = {
    "cylinders": "cylinder_count", "strokes": "strokes_per_cycle", "air_rate": "gas_mass_flow",
    "air_pressure": "charge_pressure", "air_temperature": "charge_temperature", "peak_pressure": "cylinder_pressure",
    "discharge_coefficient": "orifice_coefficient", "heat_ratio": "gas_heat_ratio",
}  # fmt: skip
# what may be left out, with its neutral value
_NEUTRAL = {
    "brake_spring_load": 0.0, "brake_rope_diameter": 0.0, "card_loop_area": 0.0, "mechanical_loss_slope": 0.0,
    "mechanical_loss_square": 0.0, "mechanical_loss_share": 0.0,
}  # fmt: skip


@formula("brake_arm", _TEXT)
def arm_of_drum(D_drum: Value, d_rope: Value) -> Value:
    """Arm of a rope brake: to the middle of the rope."""
    return (D_drum + d_rope) / 2


@formula("brake_arm", _TEXT)
def arm_of_circumference(C_brake: Value, pi: Value) -> Value:
    """Arm of a brake whose effective circumference is known."""
    return C_brake / (2 * pi)


@formula("effective_torque", _TEXT)
def brake_torque(F_brake: Value, F_spring: Value, R_brake: Value) -> Value:
    """Torque of a brake by its net load."""
    return (F_brake - F_spring) * R_brake


@formula("effective_power", _TEXT)
def power_of_torque(M_e: Value, w: Value) -> Value:
    """Power of a torque."""
    return M_e * w


@formula("effective_torque", _TEXT)
def torque_of_power(N_e: Value, w: Value) -> Value:
    """Torque of a power."""
    return N_e / w


@formula("indicated_mean_pressure", _TEXT)
def card_mean_pressure(A_card: Value, A_loop: Value, l_card: Value, k_card: Value) -> Value:
    """Mean pressure of an indicator card: its area, less the loop of gas exchange, over its length, by its spring."""
    return (A_card - A_loop) / l_card * k_card


@formula("working_cycle_rate", _TEXT)
def working_cycle_rate(w: Value, tau_s: Value) -> Value:
    """Working cycles of a cylinder, a turn for each."""
    return 2 * w / tau_s


@formula("indicated_power", _TEXT)
def double_acting_power(  # noqa: PLR0913 - one argument per symbol
    p_ind: Value, p_crank: Value, V_engine: Value, i_cyl: Value, A_rod: Value, stroke: Value, f_cycle: Value, pi: Value
) -> Value:
    """Indicated power of both sides of pistons, that of the crank side without the area of the piston rod."""
    return (p_ind * V_engine + p_crank * (V_engine - i_cyl * A_rod * stroke)) * f_cycle / (2 * pi)


@formula("indicated_power", _TEXT)
def power_of_mean_pressure(p_ind: Value, V_engine: Value, f_cycle: Value, pi: Value) -> Value:
    """Power of all cylinders by a mean pressure."""
    return p_ind * V_engine * f_cycle / (2 * pi)


@formula("indicated_mean_pressure", _TEXT)
def mean_pressure_of_power(N_ind: Value, V_engine: Value, f_cycle: Value, pi: Value) -> Value:
    """Mean pressure that gives a power of all cylinders."""
    return 2 * pi * N_ind / (V_engine * f_cycle)


@formula("indicated_power", _AIR)
def morse_power(i_cyl: Value, N_e: Value, N_cut: Value) -> Value:
    """Indicated power by a test of Morse: what the brake power falls by as cylinders are cut out one by one."""
    return i_cyl * N_e - N_cut


@formula("mechanical_loss_pressure", "chen_flynn_1965")
def chen_flynn_loss(a_loss: Value, b_loss: Value, S_pm: Value, c_loss: Value, k_loss: Value, p_cyl: Value) -> Value:
    """Mean pressure of mechanical losses by piston speed and greatest pressure."""
    return a_loss + b_loss * S_pm + c_loss * S_pm**2 + k_loss * p_cyl


@formula("mechanical_efficiency", _TEXT)
def efficiency_of_powers(N_e: Value, N_ind: Value) -> Value:
    """Power that is given over power that is taken."""
    return N_e / N_ind


@formula("relative_efficiency", _TEXT)
def relative_efficiency(eta_ind: Value, eta_t: Value) -> Value:
    """Indicated efficiency over that of the ideal cycle."""
    return eta_ind / eta_t


@formula("indicated_power", _TEXT)
def indicated_of_brake(N_e: Value, eta_m: Value) -> Value:
    """Indicated power of a brake power."""
    return N_e / eta_m


@formula("effective_power", _TEXT)
def brake_of_indicated(N_ind: Value, eta_m: Value) -> Value:
    """Brake power of an indicated power."""
    return N_ind * eta_m


@formula("mechanical_loss_power", _TEXT)
def mechanical_loss_power(N_ind: Value, N_e: Value) -> Value:
    """Power that the engine itself takes."""
    return N_ind - N_e


@formula("indicated_power", _AIR)
def indicated_of_losses(N_e: Value, N_loss: Value) -> Value:
    """Indicated power of a brake power and of the power that the engine itself takes."""
    return N_e + N_loss


@formula("willans_loss_power", _AIR)
def willans_loss(G_idle: Value, g_load: Value) -> Value:
    """Power of losses, at which the straight line of fuel over brake power would need no fuel."""
    return G_idle / g_load


@formula("fuel_rate", _TEXT)
def fuel_of_volume(V_fuel: Value, rho_fuel: Value) -> Value:
    """Fuel by its volume flow."""
    return V_fuel * rho_fuel


@formula("effective_fuel_consumption", _TEXT)
def consumption_of_power(G_f: Value, N_e: Value) -> Value:
    """Fuel per work."""
    return G_f / N_e


@formula("gas_mass_flow", _TEXT)
def orifice_flow(C_d: Value, pi: Value, d_orifice: Value, rho_k: Value, dp_orifice: Value) -> Value:
    """Air through the orifice of an air box."""
    return C_d * pi * d_orifice**2 / 4 * np.sqrt(2 * rho_k * dp_orifice)


@formula("volumetric_efficiency", _TEXT)
def measured_volumetric_efficiency(G_air: Value, rho_k: Value, V_engine: Value, f_cycle: Value, pi: Value) -> Value:
    """Air taken in over what the swept volume would hold."""
    return 2 * pi * G_air / (rho_k * V_engine * f_cycle)


@formula("air_fuel_ratio", _TEXT)
def air_fuel_ratio(G_air: Value, G_f: Value) -> Value:
    """Air over fuel by mass."""
    return G_air / G_f


@formula("heat_to_coolant", _TEXT)
def heat_of_coolant(G_cool: Value, c_water: Value, dT_water: Value) -> Value:
    """Heat that the coolant carries away."""
    return G_cool * c_water * dT_water


@formula("heat_to_exhaust", _TEXT)
def heat_of_exhaust(G_air: Value, G_f: Value, c_exh: Value, dT_exh: Value) -> Value:
    """Heat that the exhaust gas carries away, of air and fuel."""
    return (G_air + G_f) * c_exh * dT_exh


@formula("speed_droop", _AIR)
def speed_droop(w_idle: Value, w: Value) -> Value:
    """What a governed speed falls by from idling to this load, over this speed."""
    return (w_idle - w) / w


# in the order in which what is known gives what is not: what is known already is not worked again
_RULES = (
    piston_area, swept_volume, engine_size.displacement, mean_piston_speed, working_cycle_rate,
    arm_of_drum, arm_of_circumference, brake_torque, power_of_torque, morse_power,
    card_mean_pressure, double_acting_power, power_of_mean_pressure, chen_flynn_loss,
    engine_size.effective_mean_pressure, (power_of_mean_pressure, "effective"), indicated_of_brake, brake_of_indicated,
    mean_pressure_of_power, (mean_pressure_of_power, "effective"), efficiency_of_powers, mechanical_loss_power,
    indicated_of_losses,
    torque_of_power, fuel_of_volume, engine_size.fuel_rate, consumption_of_power, (consumption_of_power, "indicated"),
    engine_size.heat_supplied, (efficiency_of_powers, "effective"), (efficiency_of_powers, "indicated"),
    otto_efficiency, relative_efficiency, charge_density, orifice_flow, measured_volumetric_efficiency,
    air_fuel_ratio, heat_of_coolant, heat_of_exhaust, speed_droop,
)  # fmt: skip
# of formulas that are used for several quantities: what their result and their arguments then are
_OTHERS: dict[tuple[str, str], dict[str, str]] = {
    ("power_of_mean_pressure", "effective"): {"": "effective_power", "p_ind": "effective_mean_pressure"},
    ("mean_pressure_of_power", "effective"): {"": "effective_mean_pressure", "N_ind": "effective_power"},
    ("consumption_of_power", "indicated"): {"": "indicated_fuel_consumption", "N_e": "indicated_power"},
    ("efficiency_of_powers", "effective"): {"": "effective_efficiency", "N_ind": "heat_supplied"},
    ("efficiency_of_powers", "indicated"): {
        "": "indicated_efficiency", "N_e": "indicated_power", "N_ind": "heat_supplied",
    },
}  # fmt: skip


def work_test(worked: Calculation, pi: float) -> None:
    """Work everything that follows from what is known of a test.

    `worked`: has the inputs; takes the results.
    """
    for key, neutral in _NEUTRAL.items():
        if key not in worked.known:
            worked.absent(key, neutral)
    # a speed or a pressure that no loss follows
    for key, coefficient in (("stroke", "mechanical_loss_slope"), ("cylinder_pressure", "mechanical_loss_share")):
        if key not in worked.known and worked[coefficient].is_absent:
            worked.absent("mean_piston_speed" if key == "stroke" else key)
    before = -1
    while len(worked.found) != before:
        before = len(worked.found)
        for function, quantity, taken, constants in _rules(pi):
            if quantity not in worked.known and all(key in worked.known for key in taken.values()):
                worked(function, quantity, **{name: worked[key] for name, key in taken.items()}, **constants)
    if "heat_supplied" in worked.found and "effective_power" in worked.known:
        _balance_heat(worked)


def _rules(pi: float) -> Iterator[tuple[Callable[..., Any], str, dict[str, str], dict[str, float]]]:
    """Yield formulas with the quantity that each gives here, those that its arguments are, and pi if it takes that."""
    for rule in _RULES:
        function, use = rule if isinstance(rule, tuple) else (rule, "")
        entry, other = FORMULAS[function.__name__], _OTHERS.get((function.__name__, use), {})
        taken = {name: other.get(name, ARGUMENTS[name].quantity) for name in entry.arguments if name != "pi"}
        yield function, other.get("", entry.quantity), taken, {"pi": pi} if "pi" in entry.arguments else {}


def contradictions(worked: Calculation, pi: float) -> Iterator[tuple[TracedValue, TracedValue]]:
    """Yield what is known with the other value that the rest of what is known gives it."""
    # both sides of a piston have more than one mean pressure
    one_sided = {"indicated_power", "indicated_mean_pressure"} if "crank_side_pressure" in worked.known else set[str]()
    for function, quantity, taken, constants in _rules(pi):
        known = worked.known.get(quantity)
        skipped = one_sided and {quantity, *taken.values()} >= one_sided
        if skipped or known is None or known.is_absent or not worked.known.keys() >= {*taken.values()}:
            continue
        with suppress(CrankworkError):
            operands = {name: worked[key] for name, key in taken.items()}
            other = worked.again("")(function, quantity, **operands, **constants)
            # cycles may be missed, but not added
            is_missed = quantity == "working_cycle_rate" and known.value < other.value
            if abs(other.value - known.value) > _SAME * abs(known.value) and not is_missed:
                yield known, other


def missing(worked: Calculation, quantity: str) -> tuple[str, ...]:
    """Return the fewest quantities that something would follow from beside a known one."""
    uses = [set(taken.values()) for _, _, taken, _ in _rules(0.0) if quantity in taken.values()]
    return min((tuple(sorted(use - worked.known.keys())) for use in uses), key=len, default=())


def _balance_heat(worked: Calculation) -> None:
    """Add what is left of the heat of the fuel, and the share of each part of it."""
    parts = {"effective": worked["effective_power"]}
    parts |= {name: worked[f"heat_{name}"] for name in ("to_coolant", "to_exhaust") if f"heat_{name}" in worked.found}
    rest = worked["heat_supplied"]
    for part in parts.values():
        rest = rest - part
    parts["rest"] = worked.keep(rest.named("heat_rest"))
    for name, part in parts.items():
        worked.keep((part / worked["heat_supplied"]).named(f"heat_share.{name}"))
