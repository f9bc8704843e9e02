"""Stated positions settle branches, also where a link carries the point that a group hangs on."""

import pytest

from crankwork import analyse, read_machine, template
from crankwork.errors import InputError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.report.notices import notice_text

# the two places of E with the lengths of the template at a crank angle of zero [mm]
PLACES = [(415.15182383069, 105.15729815467), (255.5, -57.26)]


WRONG = 'D = ["-500 mm", "80 mm"]'
# two lengths follow from positions
LENGTHS = """
[fixed_points]
O = ["0 mm", "0 mm"]
C = ["300 mm", "0 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "80 mm"
speed = "60 rpm"
[links]
coupler = { joins = ["A", "B"] }
rocker = { joins = ["C", "B"] }
[branch]
B = 1
[positions]
B = ["250 mm", "180 mm"]
"""


def with_position(positions):
    return template("watt-six-bar").replace("[table]", f"[positions]\n{positions}\n[table]")


def old(text):
    return text.replace("format = 2\n", "")


def place_of_e(positions):
    columns = analyse(read_machine(old(with_position(positions)))).columns_at(CrankGrid.from_degrees([0.0]))
    return float(columns["point_x.E"][0]) * 1e3, float(columns["point_y.E"][0]) * 1e3


@pytest.mark.parametrize(("x", "y"), PLACES)
def test_a_joint_stands_where_it_is_stated_to(x, y):
    assert place_of_e(f'E = ["{x} mm", "{y} mm"]') == pytest.approx((x, y), abs=0.05)


def test_a_rough_position_is_enough():
    assert place_of_e('E = ["300 mm", "-200 mm"]') == pytest.approx(PLACES[1], abs=0.05)


@pytest.mark.parametrize("at", ['["-500 mm", "80 mm"]', '["255 mm", "82 mm"]'])
def test_a_position_that_settles_nothing_may_stand_in_files_of_0_1(at):
    assert place_of_e(f"D = {at}") == pytest.approx(PLACES[0], abs=0.05)


def test_a_position_that_settles_nothing_and_is_wrong_is_a_notice_in_files_of_0_1():
    told = [notice_text(one.code, one.values, "en") for one in analyse(read_machine(old(with_position(WRONG)))).notices]
    assert "the position stated for D has no effect: lengths and branches put it at 255.2 mm, 102.7 mm" in told
    right = analyse(read_machine(old(with_position('D = ["255 mm", "82 mm"]'))))
    assert [one for one in right.notices if one.code == "position_idle"] == []


@pytest.mark.parametrize(
    ("positions", "told"),
    [
        (WRONG, "has no effect there"),
        ('D = ["255 mm", "82 mm"]', "settles nothing"),
        ('Q = ["1 m", "0 m"]', "settles nothing"),
    ],
)
def test_a_position_that_settles_nothing_is_refused_in_format_2(positions, told):
    text = with_position(positions)
    with pytest.raises(InputError) as refusal:
        read_machine(text, "my.toml")
    problem, line = refusal.value.problems[0], refusal.value.places[0].partition(":")[2]
    assert problem.key == f"positions.{positions[0]}"
    assert told in problem.message
    assert text.split("\n")[int(line) - 1].startswith(f"{positions[0]} = ")


def test_a_position_that_settles_a_branch_or_gives_a_length_may_stand_in_format_2():
    assert read_machine(with_position("E = " + str([f"{one} mm" for one in PLACES[1]])))
    assert read_machine(f"format = 2\n{LENGTHS}").linkage


@pytest.mark.parametrize("written", ["0", "true", '"2"'])
def test_a_format_that_is_none_is_refused_on_its_line(written):
    text = template("four-bar")
    line = text.split("\n").index("format = 2") + 1
    with pytest.raises(InputError, match=rf"my\.toml:{line}: format: .*write 1 or 2"):
        read_machine(text.replace("format = 2", f"format = {written}"), "my.toml")


def test_a_format_to_come_is_refused_and_nothing_else_is_told():
    with pytest.raises(InputError) as refusal:
        read_machine('title = "x"\nformat = 3\n[new_table]\nnew_key = 1\n', "my.toml")
    assert refusal.value.lines()[0] == (
        "my.toml:2: format: this crankwork knows files up to format 2; write format = 2, or install a newer one"
    )
    assert len(refusal.value.problems) == 1
