"""Every formula of the working cycle with numbers that can be worked out by hand: whole powers, round quotients.

Constants drawn from experience are those of the books: heats of gases at 1000 degrees Celsius, heating value after
Mendeleev, the 0.1 % that Vibe leaves unburnt.
"""

import math
from collections.abc import Callable

import pytest

from crankwork.working_cycle import (
    charge,
    closed_gas,
    engine_size,
    fuels,
    grinevetsky,
    heat_capacities,
    ideal,
)
from each import for_each

pytestmark = pytest.mark.elsewhere

Case = tuple[Callable[..., float], tuple[float, ...], float]

CHARGE: list[Case] = [
    # 8^(1/3) = 2, 8^(2/3) = 4, 16^(1/4) = 2
    (charge.compressor_temperature, (300, 8e5, 1e5, 1.5), 600),
    (charge.cooled_charge_temperature, (350, 40), 310),
    (charge.charge_density, (1.8e5, 300, 400), 1.5),
    (charge.intake_pressure_loss, (3, 80, 1.25), 12000),
    (charge.intake_pressure, (1e5, 12000), 88000),
    (charge.residual_fraction, (290, 10, 1000, 0.8, 1.25e5, 8, 1.25, 0.9e5), 0.0375),
    (charge.intake_temperature, (290, 10, 0.25, 800), 400),
    (charge.volumetric_efficiency, (270, 30, 9, 1e5, 1.2, 0.9e5, 0.8, 1.25e5), 0.981),
    (charge.residual_fraction_vietnamese, (0.8, 290, 10, 1000, 8e5, 1e5, 10, 1.2, 1.25, 1.5), 0.24),
    (charge.intake_temperature_vietnamese, (290, 10, 1.25, 0.25, 800, 8e5, 1e5, 1.5), 640),
    (charge.volumetric_efficiency_vietnamese, (10, 270, 30, 1e5, 1.25e5, 1.2, 1.25, 0.8, 8e5, 1.5), 0.64),
    (charge.geometric_compression_ratio, (9, 0.2), 11),
    (charge.compression_pressure, (1e5, 16, 1.25), 3.2e6),
    (charge.compression_temperature, (300, 16, 1.25), 600),
    (charge.compression_celsius, (700, 273), 427),
]

FUEL: list[Case] = [
    # 33.91 * 0.85 + 125.6 * 0.15 - 10.89 * 0.02 - 2.51 * 9 * 0.15
    (fuels.lower_heating_value, (0.85, 0.15, 0.02), 44.0572e6),
    (fuels.air_mass_needed, (0.84, 0.14, 0.1), 326 / 23),
    (fuels.air_amount_needed, (0.84, 0.12, 0.032), 99 / 208),
    (grinevetsky.fresh_charge_amount, (0.9, 0.5, 125), 0.458),
    (grinevetsky.carbon_monoxide, (0.9, 0.6, 0.5), 0.013),
    (grinevetsky.hydrogen_left, (0.6, 0.013), 0.0078),
    (grinevetsky.carbon_dioxide, (0.84, 0.013), 0.057),
    (grinevetsky.water, (0.14, 0.0078), 0.0622),
    (grinevetsky.oxygen_left, (1.5, 0.5), 0.052),
    (grinevetsky.nitrogen, (1.25, 0.5), 0.495),
    (grinevetsky.products, (0.057, 0.013, 0.0622, 0.0078, 0.052, 0.495), 0.687),
    (grinevetsky.molar_change_ideal, (0.54, 0.5), 1.08),
    (grinevetsky.heat_lost_incomplete, (0.9, 0.5), 5.9975e6),
]

HEATS: list[Case] = [
    (heat_capacities.air_heat, (500,), 21.919),
    (heat_capacities.air_heat_vietnamese, (1000,), 21.896),
    (heat_capacities.air_heat_linear, (1000,), 21.9),
    # 41.454 CO2 + 23.267 CO + 30.312 H2O + 21.478 H2 + 24.731 O2 + 22.898 N2 at 1000 degrees
    (heat_capacities.heat_of_gases, (1, 2, 3, 4, 5, 6, 20, 1000), 525.879 / 20),
    (heat_capacities.heat_constant_of_gases, (1, 2, 3, 4, 5, 6, 20), 24.6573),
    (heat_capacities.heat_slope_of_gases, (1, 2, 3, 4, 5, 6, 20), 0.00215235),
    (heat_capacities.rich_heat_constant_vietnamese, (0.9,), 21.1506),
    (heat_capacities.rich_heat_slope_vietnamese, (0.9,), 0.0029375),
    (heat_capacities.lean_heat_constant_vietnamese, (1.6,), 20.89725),
    (heat_capacities.lean_heat_slope_vietnamese, (1.6,), 0.002715425),
    (heat_capacities.rich_heat_constant_linear, (0.9,), 20.74),
    (heat_capacities.rich_heat_slope_linear, (0.9,), 0.002792),
    (heat_capacities.lean_heat_constant_linear, (1.6,), 20.775),
    (heat_capacities.lean_heat_slope_linear, (1.6,), 0.0024125),
    (heat_capacities.product_heat, (20, 0.0025, 2400), 26),
    (heat_capacities.mixture_heat, (21, 0.25, 26), 22),
]

COMBUSTION: list[Case] = [
    (grinevetsky.molar_change, (1.1, 0.25), 1.08),
    (grinevetsky.working_mixture_heat, (44e6, 4e6, 0.5, 0.25), 64000),
    (grinevetsky.isochoric_energy, (0.9, 80000, 21, 400), 80400),
    (grinevetsky.dual_energy, (0.8, 75000, 22, 8, 1.5, 500, 250, 1.1), 77800),
    (grinevetsky.isobaric_heat_constant, (20.5, 8.25), 28.75),
    # 1.05 (20 + 0.0025 * 2400) 2400 = 65520 and 1.1 (18 + 0.0025 * 2800) 2800 = 77000
    (grinevetsky.burnt_celsius, (20, 0.0025, 65520, 1.05), 2400),
    (grinevetsky.burnt_temperature, (18, 0.0025, 77000, 1.1), 2800),
    (grinevetsky.combustion_kelvin, (2400, 273), 2673),
    (grinevetsky.isochoric_pressure, (1.6e6, 1.05, 2500, 750), 5.6e6),
    (grinevetsky.dual_pressure, (4e6, 1.75), 7e6),
    (grinevetsky.pressure_rise_ratio, (6.6e6, 1.65e6), 4),
    # of a Vietnamese course work: 0.85 * 5.98
    (grinevetsky.real_combustion_pressure, (5.98e6,), 5.083e6),
    (grinevetsky.cut_off, (1.04, 2200, 1.6, 1100), 1.3),
    (grinevetsky.afterexpansion, (16.8, 1.4), 12),
    (grinevetsky.expansion_pressure, (6.4e6, 16, 1.25), 2e5),
    (grinevetsky.expansion_temperature, (2400, 16, 1.25), 1200),
    (grinevetsky.residual_temperature_found, (1600, 8e5, 1e5, 1.5), 800),
    (grinevetsky.residual_temperature_deviation, (1030, 1000), 0.03),
]

PERFORMANCE: list[Case] = [
    # 2 (1.6 - 1) + 2 * 1.6/0.5 (1 - 1/2) - 1/0.25 (1 - 1/2) = 2.4, times 1.5 MPa over 15
    (engine_size.theoretical_mean_pressure, (1.5e6, 16, 2, 1.6, 1.5, 4, 1.25), 240e3),
    (engine_size.filled_mean_pressure, (0.95, 1.2e6, 0.05), 1.083e6),
    (engine_size.ported_volumetric_efficiency, (0.8, 0.15), 0.68),
    (engine_size.indicated_efficiency, (1.1e6, 15, 0.96, 44e6, 1.2, 0.75), 0.4),
    (engine_size.mechanical_loss_pressure, (0.04e6, 0.01e6, 12), 0.16e6),
    (engine_size.effective_mean_pressure, (1e6, 0.16e6), 0.84e6),
    (engine_size.mechanical_efficiency, (0.84e6, 1.05e6), 0.8),
    (engine_size.effective_efficiency, (0.4, 0.8), 0.32),
    (engine_size.fuel_consumption, (40e6, 0.25), 1e-7),
    (engine_size.displacement_of_power, (4, 60e3, 0.8e6, 4500), 0.002),
    (engine_size.swept_volume_of_one, (2e-3, 4), 5e-4),
    # with pi as 3, pi 0.08^3 * 1.25/4 = 0.00048
    (engine_size.bore_of_volume, (4.8e-4, 3, 1.25), 0.08),
    (engine_size.stroke_of_bore, (1.25, 0.08), 0.1),
    (engine_size.displacement, (5e-4, 6), 3e-3),
    (engine_size.effective_power, (0.8e6, 2e-3, 4500, 4), 60e3),
    (engine_size.effective_torque, (60e3, 3.2, 4500), 125),
    (engine_size.fuel_rate, (60e3, 7.5e-8), 4.5e-3),
    (engine_size.power_per_litre, (60e3, 2e-3), 3e7),
    (engine_size.heat_supplied, (44e6, 5e-3), 220e3),
    # 0.5 * 4 * 4^2.5 * 10000^0.75 * 3/4 / 1.2
    (engine_size.heat_to_coolant, (0.5, 4, 0.04, 0.75, 10000, 11e6, 44e6, 1.2), 40e3),
    (engine_size.molar_enthalpy, (22, 8, 500), 15000),
    (engine_size.heat_to_exhaust, (5e-3, 0.55, 20000, 0.5, 2000), 50e3),
    (engine_size.heat_unburnt, (2.4e6, 5e-3), 12e3),
    (engine_size.heat_rest, (220, 60, 70, 50, 12), 28),
    (engine_size.heat_share, (66, 220), 0.3),
]

IDEAL: list[Case] = [
    (ideal.isochoric_heat, (287, 1.4), 717.5),
    (ideal.compressed_temperature, (300, 16, 1.25), 600),
    (ideal.compressed_pressure, (1e5, 16, 1.25), 3.2e6),
    (ideal.isochorically_heated, (600, 720e3, 720), 1600),
    (ideal.isobarically_heated, (600, 1e6, 1.25, 800), 1600),
    (ideal.dually_heated, (900, 1e6, 800, 650, 1.25), 1700),
    (ideal.raised_temperature, (1.5, 600), 900),
    (ideal.raised_pressure, (1.5, 4e6), 6e6),
    (ideal.temperature_ratio, (900, 600), 1.5),
    (ideal.expanded_temperature, (2000, 2, 32, 1.25), 1000),
    (ideal.expanded_pressure, (6.4e6, 2, 32, 1.25), 2e5),
    (ideal.heat_at_constant_volume, (720, 1600, 600), 720e3),
    (ideal.isobaric_heat_added, (1.25, 800, 1600, 600), 1e6),
    (ideal.dual_heat_added, (800, 900, 650, 1.25, 1700), 1e6),
    (ideal.ideal_work, (800, 350), 450),
    (ideal.thermal_efficiency, (450, 900), 0.5),
    (ideal.otto_efficiency, (16, 1.25), 0.5),
    # 1.5 * 4^1.5 = 12, 16^0.5 = 4
    (ideal.dual_efficiency, (16, 1.5, 1.5, 4), 18 / 29),
    (ideal.ideal_mean_pressure, (420e3, 1e5, 8, 300, 400), 400e3),
]

HEAT_RELEASE: list[Case] = [
    (closed_gas.gas_mass, (1e5, 6e-4, 300, 400), 5e-4),
    (closed_gas.gas_temperature, (2e6, 6e-5, 5e-4, 300), 800),
    (closed_gas.gas_heat_ratio, (1.4, -8e-5, 1000), 1.32),
    (closed_gas.pressure_rise, (1.4, 5e-5, 2000, 0.5, 100, 2e6, 1e-5), 6.64e6),
    (closed_gas.burning_progress, (6.4, 6.2, 0.8), 0.25),
    (closed_gas.fuel_heat, (5e-5, 44e6, 0.9), 1980),
    (closed_gas.woschni_gas_speed, (2.28, 12, 3.24e-3, 5e-4, 400, 1e5, 6e-4, 3e6, 1e6), 48.96),
    # 1024^0.8 = 256, 32^0.8 = 16, 32^-0.2 = 1/2, 1024^0.55 = 32 * 2^0.5
    (closed_gas.woschni_coefficient, (1 / 32, 1.024e6, 1024, 32), 834.56 / math.sqrt(2)),
    (closed_gas.wall_area, (0.006, 0.007, 3, 0.08, 0.05), 0.025),
    (closed_gas.wall_heat_rate, (500, 0.02, 1200, 400, 200), 40),
]


CASES = (*CHARGE, *FUEL, *HEATS, *COMBUSTION, *PERFORMANCE, *IDEAL, *HEAT_RELEASE)


@for_each(("formula", "operands", "expected"), CASES, ids=lambda case: case[0].__name__)
def test_a_formula_gives_what_a_calculation_by_hand_gives(
    formula: Callable[..., float], operands: tuple[float, ...], expected: float
) -> None:
    assert formula(*operands) == pytest.approx(expected, rel=1e-12)


def test_burning_leaves_one_thousandth_and_its_rate_is_its_derivative() -> None:
    """Vibe's 6.908 is the logarithm of 1000 to four digits; burnt is 1 - 1000^-(s^(m + 1))."""
    assert closed_gas.wiebe_burnt_fraction(0.5, 1.0) == pytest.approx(1 - 1000**-0.25, rel=2e-5)
    assert closed_gas.wiebe_burnt_fraction(0.25, 0.5) == pytest.approx(1 - 1000**-0.125, rel=5e-5)
    # d(1 - 1000^-(s^2))/ds = 2 s ln 1000 * 1000^-(s^2), over a duration of 0.8
    rate = 2 * 0.5 * math.log(1000) * 1000**-0.25 / 0.8
    assert closed_gas.wiebe_burning_rate(0.5, 1.0, 0.8) == pytest.approx(rate, rel=1e-4)
