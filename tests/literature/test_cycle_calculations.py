"""Working cycles of books and course works.

End of compression: Russian course work, http://allrefs.net/c35/1x6m5/p3/?full, recalculated to all printed digits.
Air and fuel: A. I. Kolchin, V. P. Demidov, Расчет автомобильных и тракторных двигателей, chapters 1 and 4, petrol
engine of compression ratio 8.5 at 5600 rpm; only numbers of which all inputs are known.
Ideal cycles: Y. A. Çengel, M. A. Boles, Thermodynamics, chapter 9, the Otto cycle of ratio 8 and the Diesel cycle of
ratio 18 and cut-off 2, cold-air-standard values. R. K. Rajput, A textbook of internal combustion engines, pages 115 and
123, and M. L. Mathur, R. P. Sharma, Internal combustion engine, page 58, from their machine files; read from the public
notebooks of the books' examples, github.com/FOSSEE/Python-Textbook-Companions at commit
d34b2ae7e5e6051f7c87531ebc73b154b082d05b, files
A_textbook_of_Internal_Combustion_Engines_by_R._K._Rajput/CHAPTER3_3.ipynb and
Internal_Combustion_Engine_by_M._l._Mathur_and_R._P._Sharma/ch2_2.ipynb, and secondary to the books.
"""

import pytest

from crankwork.analysis import Results
from crankwork.formula.calculation import Calculation
from crankwork.formula.traced_value import given
from crankwork.working_cycle.charge import compression_pressure, compression_temperature
from crankwork.working_cycle.cycle_data import GrinevetskyData
from crankwork.working_cycle.grinevetsky import grinevetsky
from crankwork.working_cycle.heat_capacities import fresh_heat
from crankwork.working_cycle.ideal import IdealData, ideal_cycle
from machine_texts import analysed

RANKINE = 5 / 9
PSI = 6894.757293168361


def test_end_of_compression_of_a_course_work() -> None:
    pressure = compression_pressure(0.0893e6, 8.2, 1.37)
    temperature = compression_temperature(340.6, 8.2, 1.37)
    assert round(pressure / 1e6, 3) == 1.595
    assert temperature == pytest.approx(741.918, abs=5.001e-4)
    assert round(fresh_heat(Calculation(), "linear", given("compression_temperature", temperature)).value, 2) == 21.45


KD = GrinevetskyData(
    "petrol", 8.5, 5600.0, excess_air=0.96, ambient_pressure=0.1e6, ambient_temperature=293.0, intake_pressure=0.085e6,
    residual_pressure=0.118e6, residual_temperature=1060.0, heating=8.0, compression_exponent=1.377, heat_use=0.91,
    expansion_exponent=1.251,
)  # fmt: skip


def test_air_and_heat_of_petrol() -> None:
    values = grinevetsky(KD).values
    assert round(values["air_amount_needed"], 3) == 0.517
    assert values["air_mass_needed"] == pytest.approx(14.957, abs=5.001e-4)
    assert values["fuel_heating_value"] == pytest.approx(43.93e6, abs=5.001e3)


def test_the_petrol_engine_lies_where_such_engines_lie() -> None:
    """Not printed values, but the neighbourhood in which the example of the book has them."""
    values = grinevetsky(KD).values
    assert values["intake_temperature"] == pytest.approx(340, abs=2)
    assert values["compression_pressure"] == pytest.approx(1.62e6, rel=2e-3)
    assert values["combustion_temperature"] == pytest.approx(2850, abs=60)
    assert values["combustion_pressure"] == pytest.approx(6.3e6, rel=0.02)
    assert abs(values["residual_temperature_deviation"]) < 0.03
    assert 0.30 < values["indicated_efficiency"] < 0.40


def test_otto_cycle_of_ratio_8() -> None:
    values = ideal_cycle(IdealData("otto", 8.0, 100e3, 290.0, heat=800e3)).values
    assert round(values["thermal_efficiency"], 3) == 0.565
    assert round(values["thermal_efficiency"], 4) == 0.5647


def test_diesel_cycle_of_ratio_18_and_cut_off_2() -> None:
    values = ideal_cycle(IdealData("ideal-diesel", 18.0, 14.7 * PSI, 540 * RANKINE, cut_off=2.0)).values
    temperatures = [round(values[f"state_temperature.{point}"] / RANKINE) for point in (2, 3, 4)]
    assert temperatures == [1716, 3432, 1425]
    assert round(values["state_pressure.2"] / PSI) == 841
    assert round(values["thermal_efficiency"], 3) == 0.632
    # the book rounds its gas constants, which moves its 110 psia by half a per cent
    assert values["ideal_mean_pressure"] / PSI == pytest.approx(110, rel=0.01)


def of_file(cylinder: str, cycle: str) -> Results:
    """Return the results of a cylinder of 200 mm bore and 300 mm stroke with an ideal cycle."""
    text = f"""
        format = 2
        crank = {{ stroke = "300 mm", speed = "760 rpm" }}
        rod.ratio = 0.25
        cylinder = {{ bore = "200 mm", {cylinder} }}
        cycle = {{ corners = "sharp", {cycle}, adiabatic_exponent = 1.4 }}
    """
    return analysed(text)


def test_rajput_3_21() -> None:
    """A Diesel cycle with cut-off at 8 per cent of the stroke, 380 cycles a minute."""
    cycle = 'kind = "ideal-diesel", cut_off = 2.12, intake_pressure = "1 bar", intake_temperature = "300 K"'
    found = of_file("compression_ratio = 15", cycle)
    assert found["state_temperature.2"] == pytest.approx(886.253081719, rel=1e-11)
    assert found["state_temperature.3"] == pytest.approx(1878.85653324, rel=1e-11)
    assert found["state_temperature.4"] == pytest.approx(858.996630003, rel=1e-11)
    assert found["state_pressure.2"] == pytest.approx(44.3126540859e5, rel=1e-11)
    assert found["state_pressure.4"] == pytest.approx(2.86332210001e5, rel=1e-11)
    assert found["clearance_volume"] == pytest.approx(0.000673198425769, rel=1e-11)
    assert found["thermal_efficiency"] == pytest.approx(0.597741367379, rel=1e-11)
    assert found["ideal_mean_pressure"] == pytest.approx(7.41650180475e5, rel=1e-11)
    assert found["indicated_work"] == pytest.approx(6989.88827554, rel=1e-10)
    assert found["indicated_power"] == pytest.approx(44269.2924118, rel=1e-10)


def test_rajput_3_23() -> None:
    """A dual cycle by its volumes, greatest pressure, and cut-off at 5 per cent of the stroke."""
    ratio = 1 + 0.0053 / 0.00035
    cycle = f'kind = "dual", pressure_ratio = {65 / (0.9 * ratio**1.4)!r}, cut_off = {1 + 0.05 * (ratio - 1)!r}'
    intake = 'intake_pressure = "0.9 bar", intake_temperature = "353 K"'
    found = of_file(f"compression_ratio = {ratio!r}", f"{cycle}, {intake}")
    assert found["thermal_efficiency"] == pytest.approx(0.637576292043, rel=1e-11)
    assert found["state_pressure.2"] == pytest.approx(44.1992677349e5, rel=1e-11)
    assert found["state_temperature.2"] == pytest.approx(1073.90747859, rel=1e-11)
    assert found["state_temperature.3"] == pytest.approx(1579.30186824, rel=1e-11)
    assert found["state_temperature.4"] == pytest.approx(2775.05899705, rel=1e-11)
    assert found["state_temperature.5"] == pytest.approx(1142.88593409, rel=1e-11)


def test_mathur_2_5() -> None:
    """An Otto cycle of ratio 8 from 100 degrees C, taken as 373 K, to 50 bar."""
    cycle = f'kind = "otto", pressure_ratio = {50 / 8**1.4!r}, intake_pressure = "1 bar", intake_temperature = "373 K"'
    found = of_file("compression_ratio = 8", cycle)
    celsius = [found[f"state_temperature.{at}"] - 273 for at in (2, 3, 4)]
    assert celsius == pytest.approx([583.928972828, 2058.25, 741.735500342], rel=1e-11)
    assert found["state_pressure.2"] == pytest.approx(18.37917368e5, rel=1e-9)
    assert found["state_pressure.4"] == pytest.approx(2.7204705103e5, rel=1e-11)
