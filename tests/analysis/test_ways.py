"""Every circuit and branch of a linkage, with the ranges of each, against closed forms."""

import json
import math
from pathlib import Path

import pytest

from crankwork import read, read_machine, template
from crankwork.analysis.assembly_modes import assembly_modes
from crankwork.errors import CrankworkError
from crankwork.locale import LANGUAGES
from crankwork.report.summary import assembly_modes_data, assembly_modes_text
from four_bars import four_bar_of as four_bar

pytestmark = pytest.mark.elsewhere
ROOT = Path(__file__).parent.parent.parent


def test_both_mirror_circuits_of_a_crank_that_swings():
    for start in (0.0, 40.0, 300.0):
        found = assembly_modes(four_bar(150, 80, 150, 200, start=start))
        assert found.is_all
        assert [(one.circuit, one.branch) for one in found.branches] == [(1, 1), (1, 2), (2, 1), (2, 2)]
        assert [one.is_stated for one in found.branches] == [True, False, False, False]
        ranges = [math.degrees(one.end - one.start) for one in found.branches]
        assert ranges == pytest.approx([64.53289907034215] * 4, abs=1e-9), start
        assert [one.turns for one in found.branches] == [0] * 4
        swings = [math.degrees(one.swings["rocker"]) for one in found.branches]
        for pair in (swings[:2], swings[2:]):
            assert sorted(pair) == pytest.approx([23.81345930662, 43.92320613281], abs=1e-9), start
        # the other circuit is the mirror image on the line of the pivots
        ends = {tuple(round((math.degrees(at) + start) % 360, 6) for at in (m.start, m.end)) for m in found.branches}
        assert ends == {tuple(round(-at % 360, 6) for at in pair[::-1]) for pair in ends}
        assert len(ends) == 2


def test_a_crank_rocker_has_two_circuits_of_one_branch():
    """The rocker swings between the positions in which crank and coupler are in line."""
    found = assembly_modes(four_bar(50, 175, 112.5, 200))
    assert [(one.circuit, one.branch, one.turns) for one in found.branches] == [(1, 1, 1), (2, 1, 1)]
    far, near = (math.acos((112.5**2 + 200**2 - reach**2) / (2 * 112.5 * 200)) for reach in (225.0, 125.0))
    for one in found.branches:
        assert one.swings["rocker"] == pytest.approx(far - near, abs=1e-11)
        assert (one.start, one.end) == (0.0, math.tau)


def test_a_parallelogram_crosses_an_antiparallelogram():
    found = assembly_modes(read(ROOT / "examples/parallelogram.toml"))
    assert [(one.circuit, one.turns, one.is_stated) for one in found.branches] == [(1, 1, True), (2, 1, False)]
    assert found.branches[0].swings["coupler"] == pytest.approx(0.0, abs=1e-9)
    # the crossed coupler turns by the angle whose half has the sine r / l
    assert found.branches[1].swings["coupler"] == pytest.approx(4 * math.asin(0.15 / 0.5), abs=1e-9)


def test_a_six_bar_has_the_circuits_of_both_its_dyads():
    found = assembly_modes(read(ROOT / "examples/atkinson.toml"))
    assert [one.circuit for one in found.branches] == [1, 2, 3, 4]
    assert found.branches[0].is_stated
    assert found.branches[0].strokes["piston"] == pytest.approx(78.0637e-3, abs=1e-7)
    assert found.is_all


def test_of_other_drivers_every_circuit_and_that_of_the_stated_position_first():
    for name in ("examples/excavator-boom", "tests/machines/elbow", "tests/machines/driven-slider"):
        machine = read(ROOT / f"{name}.toml")
        found = assembly_modes(machine)
        stated, *others = found.branches
        assert (found.is_all, stated.is_stated, any(one.is_stated for one in others)) == (True, True, False), name
        assert all(stated.start <= one.to <= stated.end for one in machine.mechanism.driver.law.segments), name


def test_the_circuits_of_a_driving_slider_are_those_of_the_linkage():
    """The rod can be put on in two ways, and the slider turns back twice on each circuit."""
    found = assembly_modes(read(ROOT / "tests/machines/driven-slider.toml")).branches
    assert [(one.circuit, one.branch) for one in found] == [(1, 1), (1, 2), (2, 1), (2, 2)]
    # the second circuit is the mirror image of the first
    assert found[2].strokes == {}
    for one, other in zip(found[:2], found[3:1:-1], strict=True):
        assert other.swings == pytest.approx(one.swings, rel=1e-9)
        assert other.end - other.start == pytest.approx(one.end - one.start, rel=1e-9)


def test_a_motor_between_links_that_turns_fully_does_so():
    machine = read(ROOT / "tests/machines/elbow.toml")
    found = assembly_modes(machine)
    assert [(one.circuit, one.turns) for one in found.branches] == [(1, 1), (2, 1)]
    assert "upper–lower turns fully" in assembly_modes_text(machine, found)


@pytest.mark.parametrize("almost", [[9e-10], pytest.param([1e-13, 1e-12, 1e-11, 3e-10], marks=pytest.mark.slow)])
def test_lengths_that_are_equal_but_for_rounding_are_equal(almost):
    """A parallelogram, a kite, and the linkage whose links fold once."""
    wrong = []
    for lengths, turns in (((100, 300, 100, 300), [1, 1]), ((100, 300, 300, 100), [2]), ((150, 250, 200, 300), [2])):
        for less in (0.0, *almost, *(-one for one in almost)):
            crank, coupler, rocker, ground = lengths
            if [
                one.turns for one in assembly_modes(four_bar(crank, coupler * (1 - less), rocker, ground)).branches
            ] != turns:
                wrong.append((lengths, less))
    assert wrong == []


def test_the_reach_of_a_cylinder_follows_from_two_sides():
    stated = assembly_modes(read(ROOT / "examples/excavator-boom.toml")).branches[0]
    base = math.hypot(0.55, 0.55)
    assert [stated.start, stated.end] == pytest.approx([2.1 - base, 2.1 + base], abs=1e-11)


TRIAD = """
[fixed_points]
O = ["0 mm", "0 mm"]
E = ["200 mm", "500 mm"]
F = ["260 mm", "400 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "30 mm"
speed = "60 rpm"
[links]
rod = { joins = ["A", "B"], length = "123.7 mm" }
plate = { joins = ["B", "C"], length = "86 mm", points = { D = ["-11.6 mm", "93.6 mm"] } }
arm = { joins = ["C", "E"], length = "400 mm" }
leg = { joins = ["D", "F"], length = "454 mm" }
[positions]
B = ["150 mm", "30 mm"]
C = ["200 mm", "100 mm"]
D = ["67.5 mm", "76.4 mm"]
"""


def test_of_a_group_of_class_iii_the_circuit_of_the_stated_position():
    machine = read_machine(TRIAD)
    found = assembly_modes(machine)
    assert not found.is_all
    assert {one.circuit for one in found.branches} == {1}
    assert found.branches[0].is_stated
    assert "only the circuit of the stated position" in assembly_modes_text(machine, found)


def test_text_and_data():
    machine = four_bar(150, 80, 150, 200)
    found = assembly_modes(machine)
    for language in LANGUAGES:
        text = assembly_modes_text(machine, found, language)
        assert (text.count("\n"), "16" in text, "rocker 43" in text) == (4, True, True), language
    data = json.loads(json.dumps(assembly_modes_data(machine, found), allow_nan=False))
    assert data["all"] is True
    assert [one["stated"] for one in data["branches"]] == [True, False, False, False]
    driver = data["branches"][0]["driver"]
    assert driver["end"] - driver["start"] == pytest.approx(64.532899070342)


def test_what_is_no_linkage_has_none():
    for machine in (read_machine(template("engine")), read(ROOT / "examples/press.toml")):
        with pytest.raises(CrankworkError, match="leave --circuits out"):
            assembly_modes(machine)


def test_masses_of_a_cylinder_do_not_change_where_it_gets():
    boom = (ROOT / "examples/excavator-boom.toml").read_text("utf-8")
    mass, light = (
        '{ mass = "80 kg", inertia = "30 kg*m2", centre = ["0.6 m", "20 mm"] }',
        assembly_modes(read_machine(boom)),
    )
    for halves in (("rod",), ("barrel", "rod")):
        heavy = boom.replace("[driver]", "\n".join(["[driver]", *(f"{name} = {mass}" for name in halves)]))
        assert assembly_modes(read_machine(heavy)) == light, halves


def test_a_crank_that_hardly_moves_is_found_between_the_angles_looked_at():
    """Coupler and rocker are in line at both ends, by the law of cosines."""
    end = math.degrees(math.acos((100**2 + 449.9999**2 - 350**2) / (2 * 100 * 449.9999)))
    for start in (0.0, 0.37):
        found = assembly_modes(four_bar(100, 200, 150, 449.9999, start=start)).branches
        assert [(one.circuit, one.branch) for one in found] == [(1, 1), (1, 2)]
        for one in found:
            ends = [math.degrees(one.start) + start, math.degrees(one.end) + start]
            assert ends == pytest.approx([-end, end], abs=1e-8), start
