"""The memory as lines: what is absent folds away, arithmetic stands in place, operands go by their own names."""

import math

import pytest

from crankwork.dynamics.efficiency import driving_torque_as_motor
from crankwork.dynamics.piston_forces import crank_torque, piston_force, tangential_force
from crankwork.formula.calculation_lines import DelayedLine, FormulaLine, Snapshot, SumLine, without_noise
from crankwork.formula.expression import Expression, Number, Operation, Symbol, evaluate, record, simplify, text
from crankwork.formula.traced_value import AngleFunction, Piecewise, TracedValue, absent, delayed, given, total
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.series import series_transfer_2_term
from crankwork.loads.gas import gas_force, polytropic_pressure
from each import for_each

SIN = TracedValue(AngleFunction("sin"), "crank_angle")


def at(degrees: float) -> Snapshot:
    return Snapshot(CrankGrid.from_degrees, degrees)


def lines(known: TracedValue, degrees: float = 30.0) -> list[object]:
    return list(at(degrees).steps([known]))


def test_operands_come_before_what_is_made_of_them():
    force = tangential_force(
        given("piston_force", 1000.0), SIN, given("rod_cosine", 1.0), absent("side_force.couple"), 1.0
    )
    torque = crank_torque(force, given("crank_radius", 0.05), absent("rotating_torque"))
    found = lines(torque)
    assert [one.key for one in found] == ["tangential_force", "crank_torque"]
    assert found[1].values == {"T": found[0].value, "r": 0.05}
    assert found[1].value == pytest.approx(1000 * 0.5 * 0.05)


def test_what_is_absent_is_not_printed():
    force = piston_force(given("gas_force", 5.0), given("inertia_force", -2.0), absent("weight_force"))
    (line,) = lines(force)
    assert text(line.expression) == "F_g + F_j"
    assert line.value == 3.0


def test_arithmetic_stands_where_it_was_written():
    force = tangential_force(given("gas_force", 5.0) - given("weight_force", 2.0), SIN, 1.0, absent(""), 1.0)
    (line,) = lines(force)
    assert line.value == pytest.approx(1.5)
    assert evaluate(line.expression, line.values) == pytest.approx(1.5)
    assert dict(line.named) == {"P.0": "gas_force", "P.1": "weight_force"}


def test_an_operand_of_several_goes_by_its_own_name():
    (line,) = lines(
        crank_torque(given("tangential_force.2", 5.0), given("crank_radius", 0.1), absent("rotating_torque"))
    )
    assert dict(line.named) == {"T": "tangential_force.2"}


def test_of_pieces_the_law_of_the_angle_is_shown():
    volume = given("clearance_volume", 2.0) + SIN
    law = polytropic_pressure(given("p", 1e5), given("V", 1.0), volume, given("n", 1.3))
    pressure = TracedValue(Piecewise([90.0, 360.0], (law, given("p", 7.0))), "gas_pressure")
    force = gas_force(pressure, given("piston_area", 2.0), absent(""), absent(""))
    assert [one.key for one in lines(force, 30.0)] == ["gas_pressure", "gas_force"]
    assert [(one.key, one.value) for one in lines(force, 200.0)] == [("gas_pressure", 7.0), ("gas_force", 14.0)]


def test_a_delay_shows_which_value_came_earlier():
    (line,) = lines(delayed(SIN.named("crank_torque"), 80.0, 720.0, "crank_torque.2"), 10.0)
    assert line == DelayedLine("crank_torque.2", "crank_torque", 650.0, pytest.approx(math.sin(math.radians(650))))


def test_a_mark_tells_whose_values_vary():
    force = tangential_force(
        SIN.named("piston_force"), TracedValue(AngleFunction("sin")), given("rod_cosine", 0.5), absent(""), 1.0
    )
    own = crank_torque(force, given("crank_radius", 0.05), absent("rotating_torque"))
    found = list(Snapshot(CrankGrid.from_degrees, 30.0, "2").steps([own]))
    assert [one.key for one in found] == ["tangential_force.2", "crank_torque.2"]
    assert dict(found[0].named) == {"P": "piston_force.2", "sin_phi_beta": "crank_sin.2"}
    assert dict(found[1].named) == {"T": "tangential_force.2"}


def test_the_angle_of_cylinder_1_has_no_mark():
    of_first = TracedValue(AngleFunction("sin", shift=90.0), "crank_sin")
    force = tangential_force(given("piston_force", 5.0), of_first, 1.0, absent(""), 1.0)
    (line,) = Snapshot(CrankGrid.from_degrees, 0.0, "2").steps([force])
    assert line.value == pytest.approx(5.0)
    assert dict(line.named) == {"sin_phi_beta": "crank_sin"}


def test_a_total_shows_its_terms():
    found = lines(total("total_torque", [given("crank_torque.1", 2.0), given("crank_torque.2", 3.0)]))
    assert isinstance(found[-1], SumLine)
    assert [(one.key, one.value) for one in found[-1].terms] == [("crank_torque.1", 2.0), ("crank_torque.2", 3.0)]


def test_a_line_evaluates_to_its_value():
    force = tangential_force(given("piston_force", 1000.0) + SIN, SIN * SIN, 2.0 - SIN, absent(""), 1.0)
    (line,) = lines(force, 77.0)
    assert isinstance(line, FormulaLine)
    assert evaluate(line.expression, line.values) == line.value
    sine = math.sin(math.radians(77))
    assert line.value == pytest.approx((1000 + sine) * sine**2 / (2 - sine), rel=1e-15)


@for_each(("order", "shown"), [(1, "a_k·cos φ"), (2, "a_k·cos 2φ"), (3, "a_k·cos kφ")])
def test_the_first_two_orders_are_written_out(order, shown):
    cosine = TracedValue(AngleFunction("cos", order))
    (line,) = lines(series_transfer_2_term(2.0, cosine, absent(""), absent("")))
    assert text(line.expression) == shown


def test_what_rounding_has_left_of_larger_terms_is_printed_as_zero():
    rest = given("gas_force", 0.04) - given("weight_force", 0.04 - 5e-13)
    step = at(30.0).step(rest.named("piston_force"))
    assert step.value != 0
    assert without_noise(step).value == 0
    assert without_noise(at(30.0).step((rest + 1e-6).named("piston_force"))).value == pytest.approx(1e-6)


def test_an_operand_that_is_noise_is_printed_as_zero():
    cosine = TracedValue(AngleFunction("cos"), "crank_cos")
    step = at(90 + 2e-11).step((given("crank_radius", 0.05) * cosine).named("arm_x.A"))
    assert 0 < abs(step.value) < 1e-12
    shown = without_noise(step)
    assert (shown.value, sorted(shown.values.values())) == (0, [0, 0.05])


def test_folding_keeps_the_numbers_of_a_formula():
    tree = record(lambda r, l: 2 * r - 0.5 * l)  # noqa: E741
    assert simplify(tree) == tree


@for_each(("couple", "shown"), [(12.0, "(M_st + M_dyn)/η"), (None, "M_st/η")], ids=["given", "absent"])
def test_a_step_leaves_out_what_nobody_stated(couple, shown):
    dynamic = absent("dynamic_torque") if couple is None else given("dynamic_torque", couple)
    (step,) = lines(driving_torque_as_motor(given("static_torque", 30.0), dynamic, given("efficiency", 0.5)))
    assert text(step.expression) == shown
    assert step.value == 60 + 2 * (couple or 0)
    assert ("M_dyn" in step.values) == (couple is not None)
    assert evaluate(step.expression, step.values) == step.value


def test_a_difference_of_equals_and_a_quotient_by_infinity_fold_away():
    tree = record(lambda r, l, e: r * (1 - l) + 1 / e)  # noqa: E741
    one, infinite = Number(1.0), Number(math.inf)
    assert text(simplify(replaced(tree, {"l": one}))) == "1/e"
    assert text(simplify(replaced(tree, {"e": infinite}))) == "r·(1 − l)"


def replaced(tree: Expression, numbers: dict[str, Number]) -> Expression:
    if isinstance(tree, Operation):
        return Operation(tree.function, tuple(replaced(one, numbers) for one in tree.operands))
    return numbers.get(tree.name, tree) if isinstance(tree, Symbol) else tree
