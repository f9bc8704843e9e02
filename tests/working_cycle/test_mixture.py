"""Fuel, charge and products: nothing is lost on the way."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.steps import Worked
from crankwork.working_cycle.fuels import FUELS, CycleError, Fuel, burning
from crankwork.working_cycle.mixture import mixture

CARBON = st.floats(0.75, 0.9)
OXYGEN = st.floats(0.0, 0.1)
# atoms C, H, O, N of one molecule, in the order of `Mixture.parts`
RICH = [(1, 0, 2, 0), (1, 0, 1, 0), (0, 2, 1, 0), (0, 2, 0, 0), (0, 0, 0, 2)]
LEAN = [(1, 0, 2, 0), (0, 2, 1, 0), (0, 0, 2, 0), (0, 0, 0, 2)]


@given(carbon=CARBON, oxygen=OXYGEN, air=st.floats(0.7, 3.0), share=st.floats(0.3, 0.6))
def test_every_atom_of_fuel_and_air_is_in_the_products(carbon, oxygen, air, share):
    fuel = Fuel(carbon, 1 - carbon - oxygen, oxygen)
    worked = Worked()
    needed = burning(worked, fuel).air_amount
    burnt = mixture(worked, fuel, needed, air, share)
    atoms = RICH if burnt.is_rich else LEAN
    found = [sum(n * one[k] for n, one in zip(burnt.parts, atoms, strict=True)) for k in range(4)]
    brought = [
        fuel.carbon / 12,
        fuel.hydrogen,
        fuel.oxygen / 16 + 2 * 0.208 * air * needed,
        2 * 0.792 * air * needed,
    ]
    assert found == pytest.approx(brought, rel=1e-12, abs=1e-15)
    assert burnt.products == pytest.approx(sum(burnt.parts), rel=1e-15)


def test_a_stoichiometric_mixture_is_the_same_from_both_sides():
    fuel, air = FUELS["petrol"], 0.5
    air = burning(Worked(), fuel).air_amount
    lean = mixture(Worked(), fuel, air, 1.0, 0.5)
    rich = mixture(Worked(), fuel, air, 1 - 1e-15, 0.5)
    assert rich.products == pytest.approx(lean.products, rel=1e-13)
    assert rich.heat_lost == pytest.approx(0.0, abs=1e-6)


def test_mass_of_air_and_amount_of_air_are_the_same_air():
    """Air of 28.96 kg/kmol; the two shares of oxygen of the books, 0.23 and 0.208, agree to half a per cent."""
    heat = burning(Worked(), FUELS["petrol"])
    assert heat.air_mass / heat.air_amount == pytest.approx(28.96, rel=5e-3)


def test_a_vapour_adds_to_the_charge_and_not_to_the_products():
    fuel = FUELS["petrol"]
    air = burning(Worked(), fuel).air_amount
    vapour = mixture(Worked(), fuel, air, 1.1, None)
    liquid = mixture(Worked(), fuel._replace(molar_mass=None), air, 1.1, None)
    assert vapour.fresh - liquid.fresh == pytest.approx(1 / 115, rel=1e-13)
    assert vapour.parts == liquid.parts


def test_a_heating_value_that_is_given_is_used():
    assert burning(Worked(), FUELS["diesel"]._replace(heating_value=42.5e6)).heating_value == 42.5e6


def test_what_is_no_fuel_is_refused():
    with pytest.raises(CycleError, match="sum to 1"):
        burning(Worked(), Fuel(0.5, 0.1))
    with pytest.raises(CycleError, match="as a rule"):
        mixture(Worked(), FUELS["petrol"], 0.5, 0.9, None)
    with pytest.raises(CycleError, match="give more air"):
        mixture(Worked(), FUELS["petrol"], 0.5168, 0.3, 0.5)
