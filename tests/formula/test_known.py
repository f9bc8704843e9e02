"""What remembers: knowns, their refusals, replay at any angles, columns over a whole cycle."""

import math
import pickle

import numpy as np
import pytest

from crankwork.dynamics.piston_forces import crank_torque, tangential_force
from crankwork.formula.cycle_interpolant import CycleInterpolant
from crankwork.formula.replay import Program, replay
from crankwork.formula.traced_value import (
    AngleFunction,
    Arithmetic,
    Piecewise,
    Tabulated,
    TracedValue,
    absent,
    breakpoints_of,
    delayed,
    given,
    total,
)
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.loads.gas import polytropic_pressure
from each import for_each

SIN, SIN_2, COS_2 = (TracedValue(AngleFunction(*one), "crank_angle") for one in (("sin", 1), ("sin", 2), ("cos", 2)))


def torque_given_as_harmonics() -> TracedValue:
    return given("crank_torque", 5000.0) + given("crank_torque", 900.0) * SIN_2 - given("crank_torque", 600.0) * COS_2


def over(cycle: float = 360.0, **knowns: TracedValue) -> CycleInterpolant:
    return CycleInterpolant(knowns, CrankGrid.from_degrees, cycle)


def test_a_formula_is_inert_on_numbers():
    assert crank_torque(200.0, 0.05, 0.0) == 10.0
    assert type(crank_torque(200.0, 0.05, 0.0)) is float


def test_a_formula_of_knowns_remembers_and_has_its_value_at_once():
    torque = crank_torque(given("tangential_force", 200.0), 0.05, 0.0)
    assert torque.value == 10.0
    assert torque.key == "crank_torque"
    assert torque.node.formula.name == "crank_torque"


REFUSED = {
    "bool": bool, "float": float, "int": int, "len": len, "abs": abs, "list": list, "round": round,
    "sqrt": np.sqrt, "asarray": np.asarray, "math": math.sqrt,
    "equal": lambda one: one == 1, "less": lambda one: one < 1, "item": lambda one: one[0], "power": lambda one: one**2,
    "where": lambda one: np.where(True, one, one), "maximum": lambda one: np.maximum(one, 0.0),
}  # fmt: skip


@for_each("taken", REFUSED.values(), ids=REFUSED)
def test_outside_formulas_a_known_refuses(taken):
    with pytest.raises(TypeError):
        taken(SIN)


def test_a_column_has_no_single_value():
    with pytest.raises(TypeError, match="replay"):
        _ = SIN.value


def test_plain_arithmetic_is_remembered():
    made = 2.0 * (SIN + 1.0) / (4.0 - COS_2) - (-SIN)
    grid = CrankGrid.from_degrees([10.0, 77.0])
    assert isinstance(made.node, Arithmetic)
    assert np.array_equal(replay(made, grid), 2.0 * (grid.sin + 1.0) / (4.0 - grid.multiple(2).cos) - (-grid.sin))


def test_replay_gives_the_bits_of_the_formula():
    grid = CrankGrid.steps(0.05, 720.0)
    force = tangential_force(given("piston_force", 3e4), SIN, 2.0 + COS_2, SIN_2, 3.0)
    expected = tangential_force(3e4, grid.sin, 2.0 + grid.multiple(2).cos, grid.multiple(2).sin, 3.0)
    assert np.array_equal(replay(force, grid), expected)


def test_a_delay_is_replayed_at_the_earlier_angle():
    grid = CrankGrid.from_degrees([0.0, 90.0, 137.3, 720.0])
    later = delayed(SIN + COS_2, 90.3, 720.0, "crank_torque.2")
    earlier = CrankGrid.from_degrees((grid.degrees - 90.3) % 720)
    assert replay(later, grid) == pytest.approx(earlier.sin + earlier.multiple(2).cos, abs=1e-15)


def test_delays_of_delays_add_up():
    twice = delayed(delayed(SIN, 100.0, 720.0, "a"), 30.0, 720.0, "b")
    assert replay(twice, CrankGrid.from_degrees([200.0])) == pytest.approx([math.sin(math.radians(70))], abs=1e-15)


def test_pieces_own_their_end():
    column = TracedValue(Piecewise([90.0, 360.0], (given("p", 1.0), given("p", 2.0))), "gas_pressure")
    assert replay(column, CrankGrid.from_degrees([0.0, 90.0, 90.001, 360.0])).tolist() == [1.0, 1.0, 2.0, 2.0]


def test_pieces_follow_formulas_of_columns_beside_them():
    volume = 2.0 + SIN
    law = polytropic_pressure(given("p", 1e5), given("V", 1.0), volume, given("n", 1.3))
    column = TracedValue(Piecewise([90.0, 360.0], (law, given("p", 2.0))), "gas_pressure")
    grid = CrankGrid.from_degrees([10.0, 80.0, 200.0])
    assert replay(column, grid).tolist() == [*(1e5 * (1.0 / (2.0 + grid.sin[:2])) ** 1.3).tolist(), 2.0]


def test_breaks_travel_with_delays():
    column = TracedValue(Piecewise([90.0, 360.0], (given("p", 1.0), given("p", 2.0))), "gas_pressure")
    both = total("p", [column, delayed(column, 100.0, 360.0, "p.2")])
    assert breakpoints_of([both], 360.0).tolist() == [0.0, 90.0, 100.0, 190.0, 360.0]


def test_a_table_is_asked_at_the_angles():
    column = TracedValue(Tabulated(lambda degrees: 2 * degrees, "measured"), "gas_pressure")
    assert replay(column, CrankGrid.from_degrees([3.0])).tolist() == [6.0]


def test_rows_replayed_in_parts_are_the_same():
    grid = CrankGrid.steps(0.01, 360.0)
    assert np.array_equal(replay(SIN * SIN, grid), grid.sin * grid.sin)


def test_what_does_not_vary_is_repeated():
    assert Program({"g": given("g", 9.8)})(CrankGrid.from_degrees([0.0, 1.0]))["g"].tolist() == [9.8, 9.8]


def test_extremes_stand_where_calculus_puts_them():
    found = over(T=torque_given_as_harmonics()).extreme_points["T"][0]
    assert found.value == pytest.approx(5000 + math.hypot(900, 600), rel=1e-15)
    assert math.radians(found.at) == pytest.approx((math.pi - math.atan(900 / 600)) / 2, abs=1e-9)


def test_the_mean_is_exact_across_jumps():
    torque = TracedValue(
        Piecewise([10.0, 130.0, 360.0], (given("T", 0.0), given("T", 300.0), given("T", 0.0))), "static_torque"
    )
    assert over(T=torque).mean("T", "mean_torque").value == pytest.approx(100.0, rel=1e-14)


def test_both_sides_of_a_jump_count():
    saw = TracedValue(
        Piecewise([90.0, 360.0], (TracedValue(AngleFunction("cos"), "a").named("a"), given("T", -2.0))), "static_torque"
    )
    falling = TracedValue(
        Piecewise([100.0, 360.0], (given("T", 0.0), polytropic_pressure(5.0, 1.0, 2.0 - COS_2 * 0.0 + SIN, 1.0))), "T"
    )
    assert over(T=saw).extreme_points["T"][1].value == -2.0
    assert over(T=falling).extreme_points["T"][0].at < 360.0


def test_of_a_plateau_the_first_angle_counts():
    column = TracedValue(
        Piecewise([30.0, 70.0, 360.0], (given("p", 1.0), given("p", 4.0), given("p", 2.0))), "gas_pressure"
    )
    found = over(p=column).extreme_points["p"][0]
    assert found.value == 4.0
    # just beyond the step, so far that the law after it holds at the angle of another cylinder too
    assert 0 < found.at - 30.0 < 1e-10


def test_the_largest_after_a_step_is_met_at_the_angle_of_another_cylinder():
    cosine = TracedValue(AngleFunction("cos"), "cos")
    own = TracedValue(Piecewise([360.0, 720.0], (1.0 - cosine, 9.0 + cosine)), "gas_force")
    for by in (0.0, 90.0, 123.4, 510.0, 630.0):
        found = over(720.0, y=delayed(own, by, 720.0, "gas_force.2") * 1.0).extreme_points["y"]
        assert found[0].value == pytest.approx(10.0, rel=1e-9), by
        assert found[0].at == pytest.approx((360.0 + by) % 720.0, abs=1e-3), by


def test_integrals_and_extremes_of_what_is_sharp():
    sharp = 1.0 / (1.0001 - TracedValue(AngleFunction("cos"), "cos"))
    found = over(y=sharp)
    assert found.integral("y") == pytest.approx(2 * math.pi / math.sqrt(1.0001**2 - 1), rel=1e-10)
    assert found.extreme_points["y"][0].value == pytest.approx(1e4, rel=1e-11)


def test_a_mean_of_nothing_but_rounding_is_nothing():
    assert over(s=SIN * 1e6).mean("s", "mean_torque").value == 0.0


def test_absent_is_said_by_the_leaf_and_not_by_its_value():
    assert absent("offset").is_absent
    assert not given("offset", 0.0).is_absent


def test_memory_can_be_pickled():
    torque = crank_torque(given("tangential_force", 200.0), 0.05, 0.0)
    assert pickle.loads(pickle.dumps(torque)).value == 10.0  # noqa: S301 - our own bytes
