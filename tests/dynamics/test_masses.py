"""Masses of the crank gear: what replaces the rod keeps what it promises."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.dynamics.masses import (
    CrankGearMasses,
    reciprocating_mass,
    rod_big_end_mass,
    rod_inertia_excess,
    rod_small_end_mass,
    rotating_mass,
)

pytestmark = pytest.mark.elsewhere

masses = st.floats(0.01, 1e3)
lengths = st.floats(0.01, 5.0)
shares = st.floats(0.02, 0.98)


@given(masses, lengths, shares)
def test_two_masses_keep_the_mass_and_the_centre_of_mass(mass: float, length: float, share: float) -> None:
    centre = share * length
    small = rod_small_end_mass(mass, centre, length)
    big = rod_big_end_mass(mass, small)
    assert small + big == pytest.approx(mass, rel=1e-15)
    assert small * length == pytest.approx(mass * centre, rel=1e-14)


@given(masses, lengths, shares)
def test_the_excess_is_the_inertia_less_that_of_the_two_masses(mass: float, length: float, share: float) -> None:
    centre = share * length
    small = rod_small_end_mass(mass, centre, length)
    of_two_masses = small * (length - centre) ** 2 + rod_big_end_mass(mass, small) * centre**2
    assert rod_inertia_excess(of_two_masses, mass, centre, length) == pytest.approx(0, abs=1e-14 * mass * length**2)
    assert rod_inertia_excess(of_two_masses + 0.7, mass, centre, length) == pytest.approx(
        0.7, abs=1e-14 * mass * length**2
    )


def test_the_rod_is_shared_between_piston_and_crank() -> None:
    gear = CrankGearMasses(piston=1.5, rod_small_end=0.25, rod_big_end=0.75, crank=2.0)
    assert (gear.reciprocating, gear.rotating) == (1.75, 2.75)
    assert (reciprocating_mass(1.5, 0.25), rotating_mass(2.0, 0.75)) == (1.75, 2.75)
    assert CrankGearMasses().reciprocating == CrankGearMasses().rotating == 0.0
