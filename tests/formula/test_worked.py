"""A calculation step by step: where operands come from, and what is kept."""

import math

import pytest

from crankwork.errors import CrankworkError
from crankwork.formula.calculation import Calculation
from crankwork.formula.traced_value import given
from crankwork.kinematics.slider_crank import mean_piston_speed
from crankwork.loads.gas import clearance_volume, polytropic_pressure
from crankwork.locale import in_language
from each import for_each


def _speeds() -> Calculation:
    worked = Calculation()
    worked.given("stroke", 0.08, "crank.stroke")
    worked.given("rotational_speed", 3000.0)
    return worked


def test_an_operand_is_what_the_call_names_else_what_goes_by_its_name_else_its_quantity():
    worked = _speeds()
    assert worked(mean_piston_speed).value == pytest.approx(8.0)
    worked.known["n"] = given("rotational_speed", 1500.0)
    assert worked(mean_piston_speed).value == pytest.approx(4.0)
    assert worked(mean_piston_speed, n=6000.0).value == pytest.approx(16.0)


def test_what_is_worked_is_kept_in_order_and_given_values_are_not():
    worked = _speeds()
    slow = worked(mean_piston_speed)
    worked(mean_piston_speed, "mean_piston_speed.taken", stroke=given("stroke", 0.1))
    assert {key: one.value for key, one in worked.found.items()} == {
        "mean_piston_speed": 8.0, "mean_piston_speed.taken": 10.0
    }  # fmt: skip
    assert worked["mean_piston_speed"] is slow


def test_what_is_worked_again_later_is_marked_and_leaves_the_first_calculation_alone():
    worked = _speeds()
    asked = worked.again(".before_rounding")
    assert asked(mean_piston_speed).key == "mean_piston_speed.before_rounding"
    assert asked["mean_piston_speed"].value == 8.0
    assert "mean_piston_speed" not in worked.known


@for_each("ratio", [1.0, math.nan], ids=["division by zero", "no number"])
def test_where_no_number_follows_the_operands_are_told(ratio):
    worked = Calculation()
    worked.given("swept_volume", 0.0005)
    worked.given("compression_ratio", ratio)
    with pytest.raises(
        CrankworkError, match=f"no clearance volume follows from swept volume 0.0005 and compression ratio {ratio:g}"
    ) as caught:
        worked(clearance_volume)
    russian = in_language(caught.value.args[0], "ru")
    assert russian.startswith("объём камеры сжатия: величина не определяется, если рабочий объём")
    assert f" 0,0005 и степень сжатия {ratio:g};" in russian


def test_what_is_not_known_is_named():
    with pytest.raises(KeyError, match="diagram_pressure"):
        Calculation()(polytropic_pressure)
