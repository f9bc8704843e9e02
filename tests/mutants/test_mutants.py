"""The campaign can fail: mutants differ from their formula, reach what is remembered, and leave nothing behind."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

from crankwork.formula.expression import FORMULAS, Formula, record, text
from crankwork.formula.traced_value import given
from crankwork.loads.gas import clearance_volume, piston_area
from replaced import replaced_formula

HERE = Path(__file__).parent
MUTANTS = runpy.run_path(str(HERE / "mutants.py"))
CAMPAIGN = runpy.run_path(str(HERE / "campaign.py"))
OPERANDS = {"V_d": 0.3, "r_c": 0.7}


def _values(formula: Formula) -> dict[str, float]:
    values = {}
    for mutant in MUTANTS["mutants"](formula):
        mutant.largest = 2.0
        values[mutant.kind] = mutant.function(*OPERANDS.values())
    return values


def test_each_kind_of_mutant() -> None:
    right = 0.3 / (0.7 - 1)
    assert _values(FORMULAS["clearance_volume"]) == {
        "factor": pytest.approx(right * 1.001),
        "offset": pytest.approx(right + 0.002),
        "operator": pytest.approx(0.3 / (0.7 + 1)),
    }


def test_an_operator_is_swapped_where_a_formula_has_one() -> None:
    def shown(function: object) -> str:
        return text(MUTANTS["swapped"](record(function)))

    assert shown(lambda r, x, w: r * (x + w) / r) == "r·(x − ω)/r"
    assert shown(lambda r, x: r * x) == "r/x"
    assert shown(lambda r: r**2) == "r·2"


def test_a_mutant_is_in_place_for_numbers_and_for_what_is_remembered_only_while_it_is_wanted() -> None:
    bore = given("bore", 2.0)
    with replaced_formula(FORMULAS["piston_area"], lambda pi, bore: pi + bore):
        assert piston_area(3.0, 2.0) == 5.0
        assert piston_area(3.0, bore).value == 5.0
    assert piston_area(3.0, 2.0) == 3.0
    assert piston_area(3.0, bore).value == 3.0


def test_who_expects_the_right_value_notices_and_who_does_not_survives() -> None:
    def witness(tolerance: float) -> object:
        return CAMPAIGN["Witness"]("it", False, lambda: abs(clearance_volume(8.0, 9.0) - 1.0) > tolerance)

    for mutant in MUTANTS["mutants"](FORMULAS["clearance_volume"]):
        assert not CAMPAIGN["tried"](mutant, [witness(1.0)]).witness
        assert CAMPAIGN["tried"](mutant, [witness(1e-4)]).witness == "it"


@pytest.mark.slow
def test_processes_answer_in_any_order_and_a_hang_is_told() -> None:
    def hang() -> None:
        while True:
            pass

    answers = dict(CAMPAIGN["apart"]([hang, lambda: "here"], 2, 1))
    assert answers == {0: None, 1: "here"}


def test_every_formula_is_in_one_part() -> None:
    shares = [{name for name in FORMULAS if CAMPAIGN["_digest"](name) % 10 == part} for part in range(10)]
    assert sum(map(len, shares)) == len(FORMULAS) == len(set().union(*shares))
