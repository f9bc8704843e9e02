"""Khurmi and Gupta, Theory of Machines, chapter 15: a connecting rod swung about both of its ends.

R. S. Khurmi, J. K. Gupta: Theory of Machines. S. Chand, New Delhi 2005. Chapter 15, Inertia forces in
reciprocating parts, example 15.17, page 547. The printed values were read from the public notebook of the book's
examples, github.com/FOSSEE/Python-Textbook-Companions at commit d34b2ae7e5e6051f7c87531ebc73b154b082d05b, file
Theory_Of_Machines_by_R._S._Khurmi_And_J._K._Gupta/ch15.ipynb, so they are secondary to the book. Values with more
digits are from an independent recalculation, which solved the two pendulum equations numerically.

A rod of 55 kg and 850 mm between its pins, bores of 75 and 100 mm, makes an oscillation in 1.83 s hung by the small
end and in 1.68 s hung by the big end; g = 9.81 m/s2.
"""

from __future__ import annotations

import pytest

from crankwork.dynamics.masses import rod_from_pendulum_tests, three_masses

ROD = rod_from_pendulum_tests(55, 0.85, 0.075, 0.1, 1.83, 1.68, gravity=9.81)
FROM_SMALL_END = 0.85 - ROD.centre_of_mass
# distance from the centre of mass at which the second of two masses moves with the first as the rod does
SECOND_MASS = ROD.radius_of_gyration**2 / FROM_SMALL_END


def test_radius_of_gyration_and_inertia_are_the_printed_ones() -> None:
    assert round(ROD.radius_of_gyration, 3) == 0.345
    assert round(ROD.inertia, 2) == 6.56


def test_radius_of_gyration_and_inertia_are_the_recalculated_ones() -> None:
    assert ROD.radius_of_gyration == pytest.approx(0.345234, abs=5.001e-7)
    assert ROD.inertia == pytest.approx(6.555248, abs=5.001e-7)


def test_the_centre_of_mass_is_where_the_recalculation_has_it() -> None:
    assert 0.85 - ROD.centre_of_mass + 0.075 / 2 == pytest.approx(0.648334, abs=5.001e-7)
    assert ROD.centre_of_mass + 0.1 / 2 == pytest.approx(0.289166, abs=5.001e-7)


def test_two_masses_one_at_the_small_end_are_the_printed_ones() -> None:
    """Two masses are three with nothing left at the centre of mass."""
    masses = three_masses(55, ROD.inertia, SECOND_MASS, FROM_SMALL_END + SECOND_MASS)
    assert round(masses.piston_pin, 2) == 13.32
    assert round(masses.crankpin, 2) == 41.68
    assert abs(masses.centre) < 1e-12


def test_two_masses_one_at_the_small_end_are_the_recalculated_ones() -> None:
    masses = three_masses(55, ROD.inertia, SECOND_MASS, FROM_SMALL_END + SECOND_MASS)
    assert abs(SECOND_MASS - 0.195121) < 5.001e-7
    assert masses.piston_pin == pytest.approx(13.315431, abs=5.001e-7)
    assert masses.crankpin == pytest.approx(41.684569, abs=5.001e-7)
