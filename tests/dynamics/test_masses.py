"""Masses of the crank gear: replacements that keep what they promise, and pendulum tests of known rods."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.dynamics.masses import (
    CrankGearMasses,
    reciprocating_mass,
    rod_big_end_mass,
    rod_from_pendulum_tests,
    rod_inertia_excess,
    rod_small_end_mass,
    rotating_mass,
    three_masses,
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


@given(masses, lengths, shares, st.floats(0.05, 1.0))
def test_three_masses_keep_mass_centre_of_mass_and_inertia(
    mass: float, length: float, share: float, gyration: float
) -> None:
    centre, inertia = share * length, mass * (gyration * length) ** 2
    three = three_masses(mass, inertia, centre, length)
    scale = mass + abs(three.centre)
    assert sum(three) == pytest.approx(mass, abs=1e-14 * scale)
    assert three.piston_pin * (length - centre) == pytest.approx(three.crankpin * centre, rel=1e-13)
    about_centre = three.piston_pin * (length - centre) ** 2 + three.crankpin * centre**2
    assert about_centre == pytest.approx(inertia, rel=1e-13)


def test_the_middle_one_of_three_masses_may_be_negative() -> None:
    """A rod of 2 kg, 1 m, with its mass at the pins and a little beyond them."""
    assert three_masses(2.0, 0.6, 0.5, 1.0) == pytest.approx((1.2, 1.2, -0.4), rel=1e-15)


def test_a_rod_with_its_mass_at_the_pins_has_nothing_in_the_middle() -> None:
    assert three_masses(2.0, 0.5, 0.5, 1.0) == (1.0, 1.0, 0.0)


def test_the_rod_is_shared_between_piston_and_crank() -> None:
    gear = CrankGearMasses(piston=1.5, rod_small_end=0.25, rod_big_end=0.75, crank=2.0)
    assert (gear.reciprocating, gear.rotating) == (1.75, 2.75)
    assert (reciprocating_mass(1.5, 0.25), rotating_mass(2.0, 0.75)) == (1.75, 2.75)
    assert CrankGearMasses().reciprocating == CrankGearMasses().rotating == 0.0


def _period(pivot_to_centre: float, gyration: float, gravity: float) -> float:
    """Return the period of a compound pendulum. [s]"""
    return 2 * math.pi * math.sqrt((gyration**2 + pivot_to_centre**2) / (gravity * pivot_to_centre))


@given(
    masses,
    lengths,
    st.floats(0.1, 0.45),
    st.floats(0.15, 0.6),
    st.floats(0.0, 0.3),
    st.sampled_from([9.80665, 9.81, 1.62]),
)
def test_a_known_rod_is_found_from_the_periods_it_would_have(
    mass: float, length: float, share: float, gyration: float, bores: float, gravity: float
) -> None:
    centre, k = share * length, gyration * length
    small_bore, big_bore = 0.6 * bores * length, bores * length
    small = _period(length - centre + small_bore / 2, k, gravity)
    big = _period(centre + big_bore / 2, k, gravity)
    found = rod_from_pendulum_tests(mass, length, small_bore, big_bore, small, big, gravity=gravity)
    # the equation for the centre degenerates where both ends swing alike about a centre in the middle
    assert found.centre_of_mass == pytest.approx(centre, rel=1e-9)
    assert found.radius_of_gyration == pytest.approx(k, rel=1e-9)
    assert found.inertia == pytest.approx(mass * k**2, rel=2e-9)


def test_standard_gravity_is_the_one_used_unless_said_otherwise() -> None:
    readings = (1.0, 0.3, 0.02, 0.04, 1.1, 1.0)
    assert rod_from_pendulum_tests(*readings) == rod_from_pendulum_tests(*readings, gravity=9.80665)
    assert rod_from_pendulum_tests(*readings) != rod_from_pendulum_tests(*readings, gravity=9.81)
