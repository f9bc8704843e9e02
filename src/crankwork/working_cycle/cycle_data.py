"""Data of the calculation of Grinevetsky and Mazing, with usual values for those that are not given."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import Literal

from crankwork.formula.calculation import Calculation
from crankwork.formula.traced_value import absent, given
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.locale import ErrorMessage
from crankwork.working_cycle.engine_size import MECHANICAL_LOSSES
from crankwork.working_cycle.fuels import FUELS, CycleError, Fuel
from crankwork.working_cycle.heat_capacities import HeatLaw, law_zero


@dataclass(frozen=True)
class GrinevetskyData:
    """Data of a calculated cycle; `None` takes the usual value for the kind of engine, or leaves a step out."""

    kind: Literal["petrol", "diesel"]  # Combustion at constant volume, or at constant volume and then pressure
    compression_ratio: float  # Of the closed cylinder; of a two-stroke engine from the closing of its ports [-]
    rotational_speed: float  # Revolutions per minute [rpm]
    fuel: Fuel | None = None  # By default the one the kind is named after
    excess_air: float | None = None  # Air over air needed [-]
    # Of the surroundings [Pa], [K]
    ambient_pressure: float = 0.1e6
    ambient_temperature: float = 293.0
    # Behind compressor and cooler; the temperature may follow from the compressor [Pa], [K]
    charge_pressure: float | None = None
    charge_temperature: float | None = None
    # Polytrope of the compressor, temperature drop of the cooler [-], [K]
    compressor_exponent: float = 1.65
    cooler_drop: float = 0.0
    # At the end of intake; by default from the loss factor and the speed in the intake [Pa]
    intake_pressure: float | None = None
    # Square of the slowing plus resistance, speed in the narrowest section [-], [m/s]
    intake_loss_factor: float | None = None
    intake_speed: float | None = None
    # Of the residual gas; heating of the charge [Pa], [K], [K]
    residual_pressure: float | None = None
    residual_temperature: float | None = None
    heating: float | None = None
    # Factors of charging after the dead centre and of scavenging [-]
    charge_up: float = 1.0
    scavenging: float = 1.0
    # Whether the residual gas keeps its pressure in the balance of the intake, or expands to the intake pressure
    intake_school: Literal["kolchin", "vietnamese"] = "kolchin"
    # Heat of the residual gas over that of the fresh charge, in the Vietnamese balance [-]
    heat_correction: float = 1.1
    lost_stroke: float = 0.0  # Share of the stroke lost to the ports of a two-stroke engine [-]
    # Of the polytropes; heat used up to z [-]
    compression_exponent: float | None = None
    expansion_exponent: float | None = None
    heat_use: float | None = None
    pressure_ratio: float | None = None  # Pressure at z over that at c, of a diesel [-]
    filling: float | None = None  # Roundness factor of the diagram [-]
    exhaust_exponent: float = 1.5  # Of the polytrope from b to r [-]
    hydrogen_share: float = 0.5  # Hydrogen over carbon monoxide in rich products [-]
    heat_capacities: HeatLaw = "kolchin"  # Law of the mean molar heats
    # Molar one and that of air [kJ/(kmol K)], [J/(kg K)]
    gas_constant: float = 8.315
    air_gas_constant: float = 287.0
    strokes: Literal[4, 2] = 4  # Strokes per cycle
    cylinders: int = 1  # Number of cylinders
    mechanical_loss: tuple[float, float] | None = None  # Coefficients of p_m = a + b v_p [Pa, Pa s/m]
    power: float | None = None  # Target of effective power, from which bore and stroke follow [W]
    stroke_bore_ratio: float = 1.0  # Stroke over bore, if they follow from the power [-]
    # Given size [m]
    bore: float | None = None
    stroke: float | None = None
    lengths: SliderCrank | None = None  # Of an offset cylinder, from which its stroke follows [m]
    rounds_size: bool = False  # Whether bore and stroke that follow are rounded to whole millimetres
    # Of the heat to the coolant [-]
    cooling_factor: float = 0.5
    cooling_exponent: float = 0.6
    pi: float = 3.141592653589793  # The constant the calculation uses [-]


# kolchin_demidov_2008, ch. 3: the middle of the usual ranges
_USUAL = {
    "petrol": {
        "excess_air": 0.95, "intake_loss_factor": 2.8, "intake_speed": 95.0, "residual_temperature": 1000.0,
        "heating": 8.0, "compression_exponent": 1.37, "expansion_exponent": 1.25, "heat_use": 0.9, "filling": 0.96,
    },
    "diesel": {
        "excess_air": 1.5, "intake_loss_factor": 2.7, "intake_speed": 70.0, "residual_temperature": 750.0,
        "heating": 20.0, "compression_exponent": 1.37, "expansion_exponent": 1.25, "heat_use": 0.82,
        "pressure_ratio": 1.8, "filling": 0.94,
    },
}  # fmt: skip
# residual over charge pressure
_RESIDUAL = {"petrol": 1.15, "diesel": 1.05}


def with_usual_values(data: GrinevetskyData) -> GrinevetskyData:
    """Return data completed with usual values."""
    check_data(data)
    usual: dict[str, float] = dict(_USUAL[data.kind])
    if data.intake_pressure is not None:
        del usual["intake_loss_factor"], usual["intake_speed"]
    usual["residual_pressure"] = _RESIDUAL[data.kind] * (data.charge_pressure or data.ambient_pressure)
    taken = {name: value for name, value in usual.items() if getattr(data, name) is None}
    rest: dict[str, object] = {}
    if data.fuel is None:
        rest["fuel"] = FUELS[data.kind]
    if data.mechanical_loss is None:
        rest["mechanical_loss"] = MECHANICAL_LOSSES[data.kind]
    if data.kind == "diesel" and (data.fuel or FUELS["diesel"]).molar_mass:
        # the fuel of a diesel does not evaporate before the cylinder
        rest["fuel"] = (data.fuel or FUELS["diesel"])._replace(molar_mass=None)
    return replace(data, **taken, **rest)  # type: ignore[arg-type]


# fields with another path in a machine file, or another key of quantity
_PLACES = {
    "compression_ratio": "cylinder.compression_ratio", "rotational_speed": "crank.speed", "bore": "cylinder.bore",
    "cylinders": "engine.cylinders", "strokes": "cycle.cycle",
}  # fmt: skip
_QUANTITIES = {
    "heating": "charge_heating", "pressure_ratio": "pressure_rise_ratio", "filling": "filling_factor",
    "strokes": "strokes_per_cycle", "cylinders": "cylinder_count", "gas_constant": "molar_gas_constant",
    "air_gas_constant": "specific_gas_constant",
}  # fmt: skip
# no key of a file states these
_CONSTANTS = {
    "compressor_exponent", "cooler_drop", "heat_correction", "exhaust_exponent", "hydrogen_share", "gas_constant",
    "air_gas_constant", "cooling_factor", "cooling_exponent",
}  # fmt: skip
_LEFT_OUT = {"power", "stroke", "pi"}


def traced_cycle_inputs(data: GrinevetskyData, full: GrinevetskyData) -> Calculation:
    """Return the calculation before its first step: every number of the data as a traced input.

    `data` and `full`: as given, and completed with usual values.
    """
    worked = Calculation()
    for field in fields(data):
        value, key = getattr(full, field.name), _QUANTITIES.get(field.name, field.name)
        if not isinstance(value, float | int) or field.name in _LEFT_OUT:
            continue
        if field.name == "lost_stroke" and not value:
            worked.absent(key)
            continue
        path = "" if field.name in _CONSTANTS else _PLACES.get(field.name, f"cycle.{field.name}")
        worked.given(key, value, path, "rpm" if key == "rotational_speed" else "")
    fuel = full.fuel or FUELS[full.kind]
    for name in ("carbon", "hydrogen", "oxygen", "molar_mass", "heating_value"):
        value = getattr(fuel, name)
        if value is not None:
            worked.given(f"fuel_{name}", value, f"cycle.fuel.{name}")
    if fuel.molar_mass is None:
        # the share of a vapour without mass in the charge is 0
        worked.absent("fuel_molar_mass", math.inf)
    if full.kind == "petrol":
        worked.absent("cut_off", 1.0)
    zero = law_zero(full.heat_capacities)
    worked.known["T_zero"] = given("heat_zero_temperature", zero) if zero else absent("heat_zero_temperature")
    if isinstance(full.mechanical_loss, tuple):
        a, b = full.mechanical_loss
        worked.given("mechanical_loss_constant", a, "cycle.mechanical_loss[1]")
        worked.given("mechanical_loss_slope", b, "cycle.mechanical_loss[2]")
    return worked


# of any sign, never negative in a file, or no number
_UNCHECKED = {"heating", "cooler_drop", "lost_stroke", "scavenging", "rounds_size"}


def check_data(data: GrinevetskyData) -> None:
    """Raise unless a cycle can follow from the data."""
    for name, value in vars(data).items():
        if isinstance(value, float | int) and name not in _UNCHECKED and value <= 0:
            raise CycleError(ErrorMessage("not_above", name=name, value=value, limit=0))
    if data.compression_ratio <= 1:
        raise CycleError(ErrorMessage("not_above", name="compression_ratio", value=data.compression_ratio, limit=1))
    if 1.0 in (data.compression_exponent, data.expansion_exponent):
        raise CycleError(ErrorMessage("exponent_one"))
    if data.strokes == 4 and data.lost_stroke:
        raise CycleError(ErrorMessage("lost_stroke_of_two"))
    if data.lost_stroke >= 1:
        raise CycleError(ErrorMessage("lost_stroke_whole", value=data.lost_stroke))
