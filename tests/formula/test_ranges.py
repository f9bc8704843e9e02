"""Ranges of formulas: what is put in from outside is told once, at its farthest."""

from crankwork.formula.traced_value import TracedValue, given
from crankwork.report.notices import notice_text
from crankwork.working_cycle.heat_capacities import air_heat, mixture_heat
from crankwork.working_cycle.usual_ranges import range_notices


def _heat(celsius: float) -> TracedValue:
    return air_heat(given("compression_celsius", celsius))


def test_a_value_in_the_range_or_at_its_end_is_no_news():
    assert list(range_notices([_heat(0.0), _heat(700.0), _heat(1500.0)])) == []


def test_the_value_farthest_outside_is_told_wherever_the_formula_is_used():
    mixed = mixture_heat(_heat(1510.0), given("residual_fraction", 0.05), _heat(1700.0))
    ((code, said),) = range_notices([mixed, _heat(-20.0)])
    assert said == {"quantity": "fresh_charge_heat", "argument": "t_c", "value": 1700.0, "low": 0.0, "high": 1500.0}
    assert notice_text(code, said, "en") == (
        "mean molar heat of the fresh charge: t_c = 1700 °C lies outside 0 to 1500 °C, where its formula holds; "
        "the formula is used"
    )
