"""Forces between the teeth of geared cranks: by hand, by power, and against one system of all links."""

import math
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis.mechanism import operating_state
from crankwork.dynamics.force_system import system_joint_forces
from crankwork.kinematics.motion import linkage_motion
from crankwork.kinematics.traced_motion import traced_motion
from crankwork.preparation.linkage import solve_linkage
from each import for_each
from machine_texts import FIVE_BAR, analysed

pytestmark = pytest.mark.elsewhere
FILE = Path(__file__).parent.parent / "machines" / "toothed-five-bar.toml"
TEXT = FILE.read_text("utf-8")
DEGREES = np.arange(2.5, 360.0, 5.0)
RATIOS = ["-2", "-0.75", "2", "0.5"]


def lifted(ratio, angle="20 deg"):
    """Return the machine with another ratio, its second pivot higher than the first."""
    text = TEXT.replace("ratio = -2", f"ratio = {ratio}").replace('E = ["180 mm", "0 mm"]', 'E = ["180 mm", "15 mm"]')
    return crankwork.read_machine(text.replace('"20 deg"', f'"{angle}"'))


def test_a_torque_on_the_geared_crank_presses_its_teeth():
    results = analysed(FIVE_BAR.replace("ratio = -2", 'ratio = -2, pressure_angle = "20 deg"'))
    # pitch radii of 120 and 60 mm
    across = 7 / 0.06
    assert np.abs(results["tooth_force.second"]) == pytest.approx(across, rel=1e-13)
    assert results["separating_force.second"] == pytest.approx(across * math.tan(math.radians(20)), rel=1e-13)
    for pivot in "OE":
        assert results[f"joint_force.{pivot}"] == pytest.approx(across / math.cos(math.radians(20)), rel=1e-12)
    # teeth push the second wheel away from the first, and the bearing holds it
    assert results["joint_force_x.E"] == pytest.approx(-across * math.tan(math.radians(20)), rel=1e-12)
    assert results["joint_force_x.O"] == pytest.approx(across * math.tan(math.radians(20)), rel=1e-12)


@for_each("ratio", RATIOS)
def test_the_pivots_bear_what_one_system_of_all_links_gives(ratio):
    one, grid = lifted(ratio), crankwork.CrankGrid.from_degrees(DEGREES)
    results, moved = crankwork.analyse(one), linkage_motion(one.mechanism, crankwork.CrankGrid.from_degrees(DEGREES))
    assert max(results.checks.values()) < 1e-12
    solved = solve_linkage(one, traced_motion(one.mechanism, moved, one.linkage))
    system, found = (
        system_joint_forces(operating_state(solved, linkage_motion(one.mechanism, grid))),
        results.columns_at(DEGREES),
    )
    largest = np.max(found["joint_force.O"])
    for name, joint in (("O", "crank_pivot"), ("E", "second_pivot"), ("A", "A"), ("C", "C"), ("D", "D")):
        assert found[f"joint_force_x.{name}"] == pytest.approx(system.pins[joint].x, abs=1e-12 * largest)
        assert found[f"joint_force_y.{name}"] == pytest.approx(system.pins[joint].y, abs=1e-12 * largest)


@for_each("ratio", RATIOS)
def test_the_power_of_the_teeth_is_that_of_the_torque_that_passes(ratio):
    """Where wheels touch both move alike, and what the teeth give the one they take from the other."""
    results = crankwork.analyse(lifted(ratio))
    plain = analysed(TEXT.replace('pressure_angle = "20 deg"\n', "").replace(
        "ratio = -2", f"ratio = {ratio}").replace('E = ["180 mm", "0 mm"]', 'E = ["180 mm", "15 mm"]'))  # fmt: skip
    found, without = results.columns_at(DEGREES), plain.columns_at(DEGREES)
    assert found["balancing_torque"] == pytest.approx(without["balancing_torque"], rel=1e-12)
    i, e = float(ratio), np.array([0.18, 0.015])
    distance = np.hypot(*e)
    e, touch = e / distance, i / (i - 1) * distance
    across, apart = found["tooth_force.second"], found["separating_force.second"]
    # on the driving pivot: what teeth take there, beside what it bears without them
    push = np.outer([-e[1], e[0]], across) + np.sign(-i) * np.outer(e, apart)
    for pivot, sign in (("E", -1.0), ("O", 1.0)):
        for k, axis in enumerate("xy"):
            apart_by = found[f"joint_force_{axis}.{pivot}"] - without[f"joint_force_{axis}.{pivot}"]
            assert apart_by == pytest.approx(sign * push[k], abs=1e-11 * np.max(np.abs(push)))
    # the velocity of both wheels where they touch
    assert touch == pytest.approx(i * (touch - distance))
    assert np.min(apart) >= 0
    assert apart == pytest.approx(np.abs(across) * math.tan(math.radians(20)), rel=1e-12)


def test_without_an_angle_there_is_only_the_force_across():
    found = crankwork.analyse(lifted("-2", "0 deg")).columns_at(DEGREES)
    assert not np.any(found["separating_force.second"])
    assert np.any(found["tooth_force.second"])


def test_the_notice_is_for_wheels_that_do_not_touch_only():
    codes = {one.code for one in crankwork.analyse(crankwork.read(FILE)).notices}
    assert "geared" not in codes


@for_each(
    ("old", "new", "told"),
    [
        (
            "ratio = -2",
            "ratio = 1",
            r"geared\.second\.pressure_angle: wheels of this ratio on these pivots do not touch",
        ),
        ('pivot = "E"', 'pivot = "O"', r"geared\.second\.pressure_angle: wheels"),
        ('"20 deg"', '"60 deg"', r"geared\.second\.pressure_angle: "),
    ],
)
def test_mistakes_are_told_with_their_place(old, new, told):
    with pytest.raises(crankwork.InputError, match=told):
        crankwork.read_machine(TEXT.replace(old, new, 1))
