"""Mobility, Assur groups, formula of structure, and what is wrong with a linkage."""

import re
from pathlib import Path

import numpy as np
import pytest

import linkages
from crankwork.description.machine_file import read
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.motion import linkage_motion
from crankwork.mechanism.decomposition import linkage_of, mechanism_of
from crankwork.mechanism.dyads import RPR, RRP, RRR
from crankwork.mechanism.structure import mobility, structure
from crankwork.mechanism.table_reader import linkage_from
from each import for_each
from linkages import LINKAGES, SHAPER, mechanism_from
from motions import changed

EXAMPLES = Path(__file__).parents[2] / "examples"
SIX_BAR = {
    "fixed_points": {"O": [0.0, 0.0], "B": [0.18, 0.0]},
    "crank": {"pivot": "O", "pin": "A", "radius": 0.05},
    "links": {
        "link": {"joins": ["C", "D"], "length": 0.25},
        "rod": {"joins": ["A", "C"], "length": 0.2, "points": {"S": [0.1, 0.02]}, "mass": 2.0, "centre": "S"},
        "rocker": {"joins": ["B", "C"], "length": 0.12},
    },
    "guides": {"bed": {"through": [0.0, -0.05], "angle": 0.0}},
    "sliders": {"ram": {"pin": "D", "guide": "bed", "mass": 5.0}},
}
TRIAD = changed(linkages.TRIAD, "links.plate.points", {"S": [0.05, 0.01]})


def solved(tables):
    mechanism, problems = mechanism_from(tables)
    assert problems == []
    return mechanism


@for_each(
    ("tables", "formula", "number"),
    [
        (SIX_BAR, "I(0,1) -> II(3,4) -> II(2,5)", 2),
        (SHAPER, "I(0,1) -> II(2,4) -> II(3,5)", 2),
        (TRIAD, "I(0,1) -> III(2,3,4,5)", 3),
    ],
)
def test_formula_of_structure(tables, formula, number):
    linkage, _ = linkage_from(tables)
    found, problems = structure(linkage)
    assert problems == []
    assert found.formula == formula
    assert found.number == number
    assert found.mobility == mobility(linkage).value == 1


def test_links_may_stand_in_any_order():
    mechanism = solved(SIX_BAR)
    assert [type(dyad) for dyad in mechanism.dyads] == [RRR, RRP]
    assert [body.link for body in mechanism.bodies] == ["rod", "ram"]


def test_a_slotted_lever_is_an_rpr_dyad():
    mechanism = solved(SHAPER)
    assert [type(dyad) for dyad in mechanism.dyads] == [RPR, RRP]
    ram = linkage_motion(mechanism, CrankGrid.from_degrees(np.arange(360.0))).sliders["ram"].position
    assert np.ptp(ram) == pytest.approx(0.2, rel=1e-3)


def test_lengths_and_branches_follow_from_positions():
    drawn = {
        "fixed_points": {"O": [0, 0], "B": [0.18, 0]},
        "crank": {"pivot": "O", "pin": "A", "radius": 0.05},
        "positions": {"C": [0.15, -0.12], "D": [-0.05, -0.2]},
        "links": {"rod": {"joins": ["A", "C"]}, "rocker": {"joins": ["B", "C"]}, "link": {"joins": ["C", "D"]}},
        "guides": {"bed": {"through": [0, -0.2]}},
        "sliders": {"ram": {"pin": "D", "guide": "bed"}},
    }
    solved_motion = linkage_motion(solved(drawn), CrankGrid.from_degrees([0.0]))
    for name, place in drawn["positions"].items():
        point = solved_motion.points[name]
        assert [float(point.x.position[0]), float(point.y.position[0])] == pytest.approx(place)


def test_a_joint_off_the_line_of_its_slider():
    offset = changed(SIX_BAR, "sliders.ram", {"guide": "bed", "points": {"D": [0.02, 0.05]}})
    direct = changed(SIX_BAR, "guides.bed.through", [0.02, 0.0])
    grid = CrankGrid.from_degrees(np.arange(0.0, 360, 30))
    one, other = (linkage_motion(solved(tables), grid) for tables in (offset, direct))
    assert one.points["D"].x.position == pytest.approx(other.points["D"].x.position)
    assert one.sliders["ram"].position == pytest.approx(other.sliders["ram"].position)


@for_each(
    ("tables", "key", "text"),
    [
        (changed(SIX_BAR, "links.loose", {"joins": ["C", "X"], "length": 0.1}), "links.loose", "hangs only on C"),
        (changed(SIX_BAR, "links.rod.joins", ["A", "A"]), "links.rod.joins", "names a joint twice: A, A"),
        (changed(SIX_BAR, "links.rod.length", None), "links.rod.length", "is missing; write length = "),
        (changed(SIX_BAR, "branch", {"A": 1}), "branch.A", "A has no branch; there is one for: C, D"),
        (changed(SIX_BAR, "links.stay", {"joins": ["B", "D"], "length": 0.2}), "sliders.ram", "mobility 0"),
        (changed(SIX_BAR, "links.stay", {"joins": ["A", "B"], "length": 0.2}), "links.stay", "stay cannot move"),
        (changed(SIX_BAR, "sliders.ram.guide", "rail"), "sliders.ram.guide", "rail is not a guide"),
        (changed(SIX_BAR, "guides.bed.link", "bar"), "guides.bed.link", "bar is neither a link nor a slider"),
        (changed(SIX_BAR, "crank.pivot", "Q"), "crank.pivot", "Q is not a fixed point"),
        (
            changed(SIX_BAR, "sliders.rod", {"pin": "D", "guide": "bed"}),
            "sliders.rod",
            "rod is the name of another link",
        ),
        (changed(SIX_BAR, "links.rod.centre", "T"), "links.rod.centre", "T is not a point of rod"),
        (changed(TRIAD, "positions.D", None), "links.plate.points.D", "is missing"),
        (changed(SIX_BAR, "crank.pin", "B"), "crank.pin", "is a fixed point already"),
        (changed(SIX_BAR, "guides.bed.through", "Q"), "guides.bed.through", "Q is not a fixed point"),
        (changed(SIX_BAR, "positions", {"A": [0, 0]}), "positions.A", "is placed by the ground or the crank"),
    ],
)
def test_problems_name_the_key(tables, key, text):
    mechanism, problems = mechanism_from(tables)
    assert mechanism is None
    assert [one for one in problems if one.key == key and text in one.message], problems


def test_a_second_freedom_is_named():
    free = changed(SIX_BAR, "sliders", {})
    free = changed(free, "links.tail", {"joins": ["D", "E"], "length": 0.1})
    free = changed(free, "links.end", {"joins": ["E", "B"], "length": 0.4})
    _, problems = mechanism_from(free)
    assert "2 degrees of freedom" in problems[0].message


def test_all_problems_come_at_once():
    wrong = changed(changed(SIX_BAR, "links.rod.joins", ["A", "A"]), "crank.pivot", "Q")
    _, problems = mechanism_from(wrong)
    assert {one.key for one in problems} == {"links.rod.joins", "crank.pivot"}


TURN = CrankGrid.from_degrees(np.arange(0.0, 360, 15))


def test_a_scotch_yoke_is_an_rpp_dyad():
    tables = {
        "fixed_points": {"O": [0.0, 0.0]},
        "crank": {"pivot": "O", "pin": "A", "radius": 0.05},
        "guides": {"bed": {"through": "O"}, "slot": {"link": "yoke", "through": [0.1, 0.0], "angle": np.pi / 2}},
        "sliders": {"yoke": {"guide": "bed", "points": {"T": [0.3, 0.02]}}, "block": {"pin": "A", "guide": "slot"}},
    }
    moved = linkage_motion(solved(tables), TURN)
    assert moved.sliders["yoke"].position == pytest.approx(0.05 * TURN.cos - 0.1)
    assert moved.points["T"].x.position == pytest.approx(0.05 * TURN.cos + 0.2)
    assert moved.sliders["block"].position == pytest.approx(0.05 * TURN.sin)


def test_a_ram_in_the_slot_of_the_lever_is_a_prp_dyad():
    tables = changed(SHAPER, "links.link", None)
    tables = changed(tables, "links.lever", {"joins": ["B", "tip"], "length": 0.4})
    tables = changed(tables, "guides.slot", {"link": "lever", "through": [0.1, 0.01], "angle": 0.1})
    tables = changed(tables, "sliders.upper", {"pin": "D", "guide": "slot"})
    moved = linkage_motion(solved(tables), TURN)
    lever, pin, block = moved.frames["lever"], moved.points["D"], moved.points["A"]
    assert pin.y.position == pytest.approx(0.14)
    for point in (pin, block):
        x, y = point.x.position, point.y.position + 0.15
        along, across = x * lever.cos + y * lever.sin - 0.1, y * lever.cos - x * lever.sin - 0.01
        assert across * np.cos(0.1) - along * np.sin(0.1) == pytest.approx(0, abs=1e-15)


def test_pivot_of_a_lever_inside_its_frame_and_pin_of_a_block_off_its_line():
    tables = {
        "fixed_points": {"O": [0.0, 0.0], "B": [0.0, -0.15]},
        "crank": {"pivot": "O", "pin": "A", "radius": 0.05},
        "links": {"lever": {"joins": ["E", "F"], "length": 0.4, "points": {"B": [0.1, -0.02]}}},
        "guides": {"slot": {"link": "lever", "through": [0.0, 0.03]}},
        "sliders": {"block": {"guide": "slot", "points": {"A": [0.01, 0.02]}}},
    }
    mechanism, problems = mechanism_from(tables)
    assert problems == []
    moved = linkage_motion(mechanism, TURN)
    end, far, pin = moved.points["E"], moved.points["F"], moved.points["A"]
    cos, sin = (far.x.position - end.x.position) / 0.4, (far.y.position - end.y.position) / 0.4
    x, y = pin.x.position - end.x.position, pin.y.position - end.y.position
    assert y * cos - x * sin == pytest.approx(0.05)
    assert x * cos + y * sin - 0.01 == pytest.approx(moved.sliders["block"].position)
    x, y = -end.x.position, -0.15 - end.y.position
    assert [x * cos + y * sin, y * cos - x * sin] == [pytest.approx(0.1), pytest.approx(-0.02)]


def test_a_guide_on_a_link_that_was_solved_from_its_other_end():
    tables = changed(SIX_BAR, "links.rocker.joins", ["C", "B"])
    tables = changed(tables, "guides.rail", {"link": "rocker", "through": [0.02, 0.01], "angle": 0.3})
    tables = changed(tables, "sliders.shoe", {"pin": "E", "guide": "rail"})
    tables = changed(tables, "fixed_points.G", [0.0, -0.1])
    tables = changed(tables, "links.strut", {"joins": ["G", "E"], "length": 0.4})
    moved = linkage_motion(solved(tables), TURN)
    c, b, e = (moved.points[name] for name in "CBE")
    cos, sin = (b.x.position - c.x.position) / 0.12, (b.y.position - c.y.position) / 0.12
    x, y = e.x.position - c.x.position, e.y.position - c.y.position
    along, across = x * cos + y * sin - 0.02, y * cos - x * sin - 0.01
    assert across * np.cos(0.3) - along * np.sin(0.3) == pytest.approx(0, abs=1e-15)
    assert along * np.cos(0.3) + across * np.sin(0.3) == pytest.approx(moved.sliders["shoe"].position)


def test_a_crank_with_two_pins():
    tables = changed(SIX_BAR, "crank.points", {"K": [-0.03, 0.01]})
    tables = changed(tables, "links.second", {"joins": ["K", "P"], "length": 0.15})
    tables = changed(tables, "guides.axis", {"through": "O", "angle": np.pi})
    tables = changed(tables, "sliders.piston", {"pin": "P", "guide": "axis"})
    moved = linkage_motion(solved(tables), TURN)
    k, p = moved.points["K"], moved.points["P"]
    assert np.hypot(k.x.position - p.x.position, k.y.position - p.y.position) == pytest.approx(0.15)
    assert np.hypot(k.x.position, k.y.position) == pytest.approx(np.hypot(0.03, 0.01))


def test_a_cylinder_is_two_links_of_which_its_driver_makes_one():
    """Barrel 1, rod 2 and boom 3 of an excavator: the driver moves 2 against 1, and both together hold the boom."""
    found, _ = structure(read(EXAMPLES / "excavator-boom.toml").linkage)
    assert found.links == ("cylinder", "cylinder_rod", "boom")
    assert found.formula == "I(1,2) -> II(1+2,3)"


@for_each("name", [name for name in LINKAGES if name != "class III"])
def test_a_mechanism_is_that_of_the_linkage_that_it_is(name):
    mechanism = LINKAGES[name]
    back, problems = mechanism_of(linkage_of(mechanism))
    assert problems == []
    for part in ("driver", "ground", "bars"):
        assert getattr(back, part) == getattr(mechanism, part)
    for part in ("bodies", "points"):
        assert set(getattr(back, part)) == set(getattr(mechanism, part))
    # the link of a slot is not used, and read only where it is drawn
    assert [re.sub(r"(?<=slot=)(.*?)link='\w*'", r"\1", repr(dyad)) for dyad in back.dyads] == [
        re.sub(r"(?<=slot=)(.*?)link='\w*'", r"\1", repr(dyad)) for dyad in mechanism.dyads
    ]
