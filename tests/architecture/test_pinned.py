"""Tables that one word could spoil unseen are pinned: symbols of formulas, quantities of formulas, units of quantities.

A change that is meant changes the digest here, which the failing test prints.
"""

from __future__ import annotations

import dataclasses
import hashlib
from collections.abc import Iterable

import crankwork
from crankwork import machine
from crankwork.notation import ARGUMENTS
from crankwork.quantities import QUANTITIES
from rules import every_formula

PINNED = {
    "symbols": "1504f419eb08",
    "formulas": "44847bddb9a7",
    "quantities": "da90798e10e7",
    "defaults": "baf67d61b30e",
}


def digest(lines: Iterable[object]) -> str:
    """Return a few letters that are others for other lines."""
    return hashlib.sha256("\n".join(map(str, lines)).encode()).hexdigest()[:12]


def test_symbols_stand_for_the_quantities_that_they_did() -> None:
    assert digest(sorted(ARGUMENTS.items())) == PINNED["symbols"]


def test_formulas_give_the_quantities_that_they_did() -> None:
    lines = (
        f"{name} {one.quantity} {one.stated_unit} {sorted(one.valid.items())}" for name, one in every_formula().items()
    )
    assert digest(sorted(lines)) == PINNED["formulas"]


def test_quantities_have_the_units_that_they_had() -> None:
    assert digest(sorted(f"{key} {one.unit} {one.si_unit}" for key, one in QUANTITIES.items())) == PINNED["quantities"]


def test_what_a_machine_does_not_state_is_what_it_was() -> None:
    kinds = [one for one in vars(machine).values() if dataclasses.is_dataclass(one) and isinstance(one, type)]
    defaults = [
        f"{kind.__name__}.{field.name} {field.default!r}"
        for kind in kinds
        for field in dataclasses.fields(kind)
        if field.default is not dataclasses.MISSING and not callable(field.default)
    ]
    assert crankwork.Machine in kinds
    assert digest(sorted(set(defaults))) == PINNED["defaults"]
