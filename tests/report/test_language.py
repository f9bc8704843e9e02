"""Numbers as each language prints them."""

import math

import pytest

from crankwork.locale.numbers import number
from crankwork.quantities import QUANTITIES
from crankwork.report.display import displayed, label
from crankwork.units import to_si
from each import for_each


@for_each(
    ("value", "language", "text"),
    [
        (4e-6, "en", "4·10⁻⁶"),
        (-1.25e-7, "ru", "−1,25·10⁻⁷"),
        (1e-6, "vi", "10⁻⁶"),
        (-1e20, "en", "−10²⁰"),
        (12.5, "vi", "12,5"),
        (-0.0, "en", "0"),
        (math.inf, "en", "inf"),
    ],
)
def test_a_power_of_ten_is_raised_wherever_it_is_printed(value, language, text):
    assert number(value, language) == text


@for_each("key", [key for key, row in QUANTITIES.items() if row.unit])
def test_the_unit_of_values_and_that_of_tables_are_told_apart(key):
    row = QUANTITIES[key]
    # what is labelled with the one and what is labelled with the other are the same amount
    assert to_si(displayed(key, 2.5), row.unit) == pytest.approx(to_si(2.5, row.si_unit)) == pytest.approx(2.5)


def test_lengths_are_shown_in_millimetres_and_held_in_metres():
    row = QUANTITIES["piston_displacement"]
    assert (row.unit, row.si_unit) == ("mm", "m")


def test_a_half_order_of_a_cycle_of_two_turns_is_an_order():
    assert label("free_force.0.5", "ru").endswith("порядок 0,5")
    assert label("free_force.2", "en") == "free force, order 2"
    assert label("free_moment.residual.2", "en") == "free moment, residual, order 2"
