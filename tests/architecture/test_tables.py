"""The tables of quantities, arguments, formulas and sources fit together."""

from __future__ import annotations

import string

from crankwork.formula.expression import symbol
from crankwork.notation import ARGUMENTS
from crankwork.quantities import LANGUAGES, QUANTITIES
from crankwork.sources import sources
from crankwork.units import UNITS
from each import failing
from rules import every_formula


def test_a_quantity_is_complete():
    def check(quantity):
        assert quantity.key.isidentifier()
        assert all(quantity.symbol(language).strip() for language in LANGUAGES)
        assert all(quantity.label(language).strip() for language in LANGUAGES)
        assert len({quantity.label(language) for language in LANGUAGES}) == len(LANGUAGES)
        assert quantity.unit in ("", *UNITS)
        assert quantity.per_area_unit in ("", *UNITS)

    assert failing(QUANTITIES, check) == {}


def test_an_argument_has_a_symbol_made_of_quantities():
    def check(name):
        argument = ARGUMENTS[name]
        keys = [key for key in (argument.quantity, argument.extra) if key]
        assert [key for key in keys if key not in QUANTITIES] == []
        assert sum(field is not None for _, field, _, _ in string.Formatter().parse(argument.pattern)) == len(keys)
        assert all(symbol(name, language).strip() for language in LANGUAGES)

    assert failing({name: name for name in ARGUMENTS}, check) == {}


def test_formulas_are_of_known_quantities_and_arguments_and_cite_the_bibliography():
    assert len(every_formula()) > 400

    def check(formula):
        assert formula.quantity in QUANTITIES
        assert formula.source.partition(",")[0] in sources()
        assert [name for name in formula.arguments if name not in ARGUMENTS] == []

    assert failing(every_formula(), check) == {}
