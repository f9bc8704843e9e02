"""Cranks that gears turn with the driving one: places by hand, torque by power, bad input."""

import math
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.formula.replay import Program
from crankwork.kinematics.circuits import circuit_through
from crankwork.kinematics.configuration_curve import driver_coordinate, link_angle
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.traced_motion import traced_motion
from each import for_each
from machine_texts import FIVE_BAR, analysed

pytestmark = pytest.mark.elsewhere
FILE = Path(__file__).parent.parent / "machines" / "geared-five-bar.toml"
TEXT = FILE.read_text("utf-8")
RESULTS = crankwork.analyse(crankwork.read(FILE))
DEGREES = np.array([0.0, 33.0, 150.0, 271.0])


def test_the_second_crank_turns_twice_as_fast_the_other_way():
    angle = math.radians(15) - 2 * np.radians(DEGREES)
    at = RESULTS.columns_at(DEGREES)
    assert at["point_x.D"] == pytest.approx(0.18 + 0.045 * np.cos(angle), rel=1e-13)
    assert at["point_y.D"] == pytest.approx(0.045 * np.sin(angle), abs=1e-15)
    assert at["link_angular_velocity.second"] == pytest.approx(-2 * 240 * math.pi / 30, rel=1e-14)
    assert at["point_velocity.D"] == pytest.approx(0.045 * 2 * 240 * math.pi / 30, rel=1e-13)
    # the coupler closes between both
    for link, length, start in (("left", 0.2, "A"), ("right", 0.21, "D")):
        dx, dy = (at[f"point_{axis}.C"] - at[f"point_{axis}.{start}"] for axis in "xy")
        assert np.hypot(dx, dy) == pytest.approx(length, rel=1e-13), link


def test_one_turn_of_a_crank_of_a_ratio_of_two_closes():
    assert RESULTS.value("point_x.C", 360.0) == pytest.approx(RESULTS.value("point_x.C", 0.0), rel=1e-12)
    assert not RESULTS.unmet
    assert RESULTS.trace["mobility"].value == 1


def test_pivots_have_the_names_of_their_points():
    assert {"joint_force.O", "joint_force.E"} <= set(RESULTS.columns)


def test_a_load_on_the_geared_crank_alone_comes_by_the_ratio():
    results = analysed(FIVE_BAR)
    # the load turns with 7 N m where the geared crank turns -2 times as fast: it hands 14 N m to the crank
    assert results["balancing_torque"] == pytest.approx(14.0, rel=1e-13)


def test_the_memory_replayed_is_the_motion():
    machine = RESULTS.machine
    moved = linkage_motion(machine.mechanism, CrankGrid.steps(1.0, 360.0))
    motion = traced_motion(machine.mechanism, moved, machine.linkage)
    grid = CrankGrid.from_degrees(DEGREES)
    expected = linkage_motion(machine.mechanism, grid)
    columns = {"angle": motion.links["second"].position, "x": motion.points["D"].x.position_2}
    found = Program(columns)(grid)
    assert found["angle"] == pytest.approx(expected.links["second"].position - 2 * np.pi * np.rint(
        (expected.links["second"].position - found["angle"]) / (2 * np.pi)), rel=1e-12)  # fmt: skip
    assert found["x"] == pytest.approx(expected.points["D"].x.position_2, rel=1e-12)


def test_its_circuit_is_the_whole_turn():
    circuit = circuit_through(RESULTS.machine.mechanism)
    assert circuit.curve.is_closed
    assert len(circuit.branches(driver_coordinate(RESULTS.machine.mechanism))) == 1
    for link in ("left", "right"):
        assert circuit.extent(link_angle(link)).travel == pytest.approx(RESULTS.summary[f"link_swing.{link}"], rel=1e-9)


@for_each(
    ("old", "new", "key", "advice"),
    [
        ("ratio = -2", "ratio = 0", "geared.second.ratio", "negative"),
        ('pivot = "E"', 'pivot = "Z"', "geared.second.pivot", "fixed_points"),
        ('points = { D = ["45 mm", "0 mm"] }', "points = {}", "geared.second.points", "D = "),
        ("ratio = -2\n", "", "geared.second.ratio", "ratio"),
    ],
)
def test_bad_input_is_told(old, new, key, advice):
    with pytest.raises(crankwork.InputError) as caught:
        crankwork.read_machine(TEXT.replace(old, new))
    assert key in [one.key for one in caught.value.problems]
    assert advice in str(caught.value)
