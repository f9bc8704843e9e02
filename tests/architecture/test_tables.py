"""The tables of quantities, arguments, formulas and sources fit together."""

from __future__ import annotations

import string

import pytest

from crankwork.formula.expression import FORMULAS, symbol
from crankwork.notation import ARGUMENTS
from crankwork.quantities import LANGUAGES, QUANTITIES
from crankwork.sources import sources
from crankwork.units import UNITS


@pytest.mark.parametrize("quantity", QUANTITIES.values(), ids=QUANTITIES)
def test_a_quantity_is_complete(quantity):
    assert quantity.key.isidentifier()
    assert all(quantity.symbol(language).strip() for language in LANGUAGES)
    assert all(quantity.label(language).strip() for language in LANGUAGES)
    assert len({quantity.label(language) for language in LANGUAGES}) == len(LANGUAGES)
    assert quantity.definition.endswith(".")
    assert quantity.unit in ("", *UNITS)
    assert quantity.per_area_unit in ("", *UNITS)


@pytest.mark.parametrize("name", ARGUMENTS)
def test_an_argument_has_a_symbol_made_of_quantities(name):
    argument = ARGUMENTS[name]
    keys = [key for key in (argument.quantity, argument.extra) if key]
    assert [key for key in keys if key not in QUANTITIES] == []
    assert sum(field is not None for _, field, _, _ in string.Formatter().parse(argument.pattern)) == len(keys)
    assert all(symbol(name, language).strip() for language in LANGUAGES)


@pytest.mark.usefixtures("imported")
def test_formulas_are_of_known_quantities():
    assert FORMULAS
    assert {one.name: one.quantity for one in FORMULAS.values() if one.quantity not in QUANTITIES} == {}


@pytest.mark.usefixtures("imported")
def test_formulas_cite_the_bibliography():
    assert {one.name: one.source for one in FORMULAS.values() if _key(one.source) not in sources()} == {}


@pytest.mark.usefixtures("imported")
def test_formulas_take_known_arguments():
    unknown = {one.name: [name for name in one.arguments if name not in ARGUMENTS] for one in FORMULAS.values()}
    assert {name: arguments for name, arguments in unknown.items() if arguments} == {}


def _key(source: str) -> str:
    return source.partition(",")[0]
