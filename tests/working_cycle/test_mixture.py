"""Fuel, charge and products: nothing is lost on the way."""

import pytest
from hypothesis import given, reject
from hypothesis import strategies as st

from crankwork.formula.calculation import Calculation
from crankwork.working_cycle.cycle_data import GrinevetskyData, traced_cycle_inputs
from crankwork.working_cycle.fuels import FUELS, CycleError, Fuel, burning
from crankwork.working_cycle.grinevetsky import mixture

pytestmark = pytest.mark.elsewhere

PRODUCTS = ("product_co2", "product_co", "product_h2o", "product_h2", "product_o2", "product_n2")
CARBON = st.floats(0.75, 0.9)
OXYGEN = st.floats(0.0, 0.1)
# atoms C, H, O, N of one molecule, in the order of `PRODUCTS`
ATOMS = [(1, 0, 2, 0), (1, 0, 1, 0), (0, 2, 1, 0), (0, 2, 0, 0), (0, 0, 2, 0), (0, 0, 0, 2)]


def _burnt(fuel: Fuel, air: float, share: float = 0.5) -> Calculation:
    data = GrinevetskyData("petrol", 9.0, 5000.0, fuel=fuel, excess_air=air, hydrogen_share=share)
    worked = traced_cycle_inputs(data, data)
    burning(worked, fuel)
    mixture(worked)
    return worked


def _parts(worked: Calculation) -> list[float]:
    return [worked[key].value for key in PRODUCTS]


@given(carbon=CARBON, oxygen=OXYGEN, air=st.floats(0.7, 3.0), share=st.floats(0.3, 0.6))
def test_every_atom_of_fuel_and_air_is_in_the_products(carbon, oxygen, air, share):
    fuel = Fuel(carbon, 1 - carbon - oxygen, oxygen)
    try:
        worked = _burnt(fuel, air, share)
    except CycleError:  # too little air even for CO and H2
        reject()
    found = [sum(n * one[k] for n, one in zip(_parts(worked), ATOMS, strict=True)) for k in range(4)]
    needed = worked["air_amount_needed"].value
    brought = [fuel.carbon / 12, fuel.hydrogen, fuel.oxygen / 16 + 2 * 0.208 * air * needed, 2 * 0.792 * air * needed]
    assert found == pytest.approx(brought, rel=1e-12, abs=1e-15)
    assert worked["product_amount"].value == pytest.approx(sum(_parts(worked)), rel=1e-15)
    assert [one.is_absent for one in map(worked.known.get, PRODUCTS)] == [
        False, air >= 1, False, air >= 1, air < 1, False
    ]  # fmt: skip


def test_a_stoichiometric_mixture_is_the_same_from_both_sides():
    lean, rich = (_burnt(FUELS["petrol"], air) for air in (1.0, 1 - 1e-15))
    assert rich["product_amount"].value == pytest.approx(lean["product_amount"].value, rel=1e-13)
    assert rich["heat_lost_incomplete"].value == pytest.approx(0.0, abs=1e-6)
    assert "heat_lost_incomplete" not in lean.found


def test_mass_of_air_and_amount_of_air_are_the_same_air():
    """Air of 28.96 kg/kmol; the two shares of oxygen of the books, 0.23 and 0.208, agree to half a per cent."""
    worked = _burnt(FUELS["petrol"], 1.0)
    assert worked["air_mass_needed"].value / worked["air_amount_needed"].value == pytest.approx(28.96, rel=5e-3)


def test_a_vapour_adds_to_the_charge_and_not_to_the_products():
    fuel = FUELS["petrol"]
    vapour, liquid = (_burnt(one, 1.1) for one in (fuel, fuel._replace(molar_mass=None)))
    change = vapour["fresh_charge_amount"].value - liquid["fresh_charge_amount"].value
    assert change == pytest.approx(1 / 115, rel=1e-13)
    assert _parts(vapour) == _parts(liquid)


def test_a_heating_value_that_is_given_is_used():
    worked = _burnt(FUELS["diesel"]._replace(heating_value=42.5e6), 1.4)
    assert worked["fuel_heating_value"].value == 42.5e6
    assert "fuel_heating_value" not in worked.found


def test_what_is_no_fuel_is_refused():
    with pytest.raises(CycleError, match="sum to 1"):
        _burnt(Fuel(0.5, 0.1), 1.0)
    with pytest.raises(CycleError, match="give more air"):
        _burnt(FUELS["petrol"], 0.3)
