"""What is only rounding is printed as nothing; what is small is not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis.rounding_noise import summary_without_rounding, without_rounding
from crankwork.formula.traced_value import breakpoints_of

EXAMPLES = Path(__file__).parents[2] / "examples"
SPEED = 10.0
MOTION = {
    "point_x.A": np.array([0.3, -0.3]),
    "link_angular_velocity.rod": np.array([2.0, -2.0]),
    "joint_force.A": np.array([500.0, 400.0]),
    "reduced_inertia": np.array([0.1, 0.2]),
    "kinetic_energy": np.array([5.0, 10.0]),
}


@pytest.fixture(scope="module")
def parallelogram():
    return crankwork.analyse(crankwork.read(EXAMPLES / "parallelogram.toml"))


def test_the_coupler_of_a_parallelogram_does_not_turn_and_no_torque_is_needed(parallelogram):
    printed = without_rounding(parallelogram.columns, parallelogram.machine.speed)
    assert {key for key, one in printed.items() if np.any(parallelogram.columns[key]) and not np.any(one)} == {
        "link_angle.coupler", "link_angular_velocity.coupler", "link_angular_acceleration.coupler",
        "link_angular_acceleration.rocker", "reduced_inertia_1", "dynamic_torque", "balancing_torque", "driving_torque",
        "crankpin_tangential_force.A",
    }  # fmt: skip
    summary = summary_without_rounding(parallelogram)
    changed = {key for key, one in summary.items() if one != parallelogram.summary[key]}
    kinds = ("reduced_inertia_1", "dynamic_torque", "balancing_torque", "driving_torque")
    ends = ("max", "min")
    turning = {f"link_angular_acceleration_{end}.rocker" for end in ends}
    assert changed == {f"{kind}_{end}" for kind in kinds for end in ends} | turning
    assert not any(summary[key] for key in changed)


def test_a_column_is_nothing_below_a_million_millionth_of_its_size():
    for key, size in {
        "point_y.A": 0.3, "link_angle.rod": 1.0, "link_angular_velocity.bar": SPEED,
        "link_angular_acceleration.bar": SPEED**2, "joint_force_x.A": 500.0, "balancing_torque": 500.0 * 0.3,
        "dynamic_torque": 10.0, "reduced_inertia_1": 0.2,
    }.items():  # fmt: skip
        below, above = (np.array([np.nan, share * 1e-12 * size]) for share in (0.9, -1.1))
        printed = without_rounding({**MOTION, key: below}, SPEED)[key]
        assert np.array_equal(printed, [np.nan, 0.0], equal_nan=True), key
        assert without_rounding({**MOTION, key: above}, SPEED)[key] is above, key


def test_what_a_slow_heavily_loaded_machine_moves_is_small_and_no_rounding():
    slow = {"kinetic_energy": 5e-12, "dynamic_torque": 1e-13, "shaking_force": 1e-13, "crank_speed": 1e-20}
    columns = MOTION | {key: np.array([one]) for key, one in slow.items()}
    printed = without_rounding(columns, 1e-5)
    assert all(printed[key] is columns[key] for key in slow)


def test_nothing_of_machines_of_like_sizes_is_taken_for_rounding():
    for name in ("four-bar", "engine"):
        results = crankwork.analyse(crankwork.read_machine(crankwork.template(name)))
        printed = without_rounding(results.columns, results.machine.speed)
        assert all(printed[key] is one for key, one in results.columns.items())
        assert summary_without_rounding(results) == results.summary


# crank, coupler and third link make a triangle that turns about the pivot as one body
TRIANGLE = """
fixed_points.O = ["0 mm", "0 mm"]
crank = { pivot = "O", pin = "A", radius = "56 mm", speed = "139 rpm", points.A2 = ["-8 mm", "-31 mm"] }
links.coupler = { joins = ["A", "B"], length = "105 mm", mass = "18 kg", centre = ["52 mm", "0 mm"] }
links.third = { joins = ["A2", "B"], length = "37 mm", mass = "2.3 kg", centre = ["-3 mm", "35 mm"] }
efficiency.chain = [0.95, 0.9]
"""


def test_a_triangle_that_turns_as_one_body_needs_no_torque_that_changes_sign():
    results = crankwork.analyse(crankwork.read_machine(TRIANGLE))
    # rounding of J' all the way round, and none of it a change from driving to braking
    assert 0 < results.summary["dynamic_torque_max"] < 1e-9
    assert len(breakpoints_of([results.trace["driving_torque"]], 360.0)) == 2


def test_an_extreme_that_is_nothing_beside_its_column_is_printed_as_nothing():
    press = crankwork.Description(crankwork.template("toggle-press"))
    # nothing acts on the way back
    results = crankwork.analyse(press.machine(["fixed_points.E[2]=160 mm"]))
    assert 0 < results.summary["static_torque_min"] < 1e-11
    assert summary_without_rounding(results)["static_torque_min"] == 0
    assert summary_without_rounding(results)["static_torque_max"] == results.summary["static_torque_max"] > 100


def test_orders_that_cancel_among_three_cranks_are_nothing_and_the_sixth_is_something():
    pump = crankwork.analyse(crankwork.read(EXAMPLES / "triplex-pump.toml"))
    assert 0 < pump.summary["free_force.2"] < 1e-9
    assert not any(value for key, value in summary_without_rounding(pump).items() if key.startswith("free_force."))
    assert summary_without_rounding(pump)["shaking_force_max"] == pump.summary["shaking_force_max"] > 1e-3


def test_an_engine_without_gas_has_no_excess_work_but_that_of_its_inertia():
    file = "crank = { radius = '43 mm', speed = '5600 rpm' }\nrod = { length = '150 mm', mass = '0.6 kg' }\n"
    engine = crankwork.Description(file + "piston.mass = '0.45 kg'\nengine = { layout = 'inline', cylinders = 4 }")
    results = crankwork.analyse(engine.machine(["rod.small_end_share=0.27", "engine.firing_order=[1, 3, 4, 2]"]))
    assert 0 <= results.summary["excess_work"] < 1e-9
    printed = summary_without_rounding(results)
    assert printed["excess_work"] == 0
    assert printed["excess_work.mertsalov"] > 100
