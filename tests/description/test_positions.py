"""Stated positions settle branches, also where a link carries the point that a group hangs on."""

import pytest

from crankwork import analyse, read_machine, template
from crankwork.errors import InputError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.report.notices import notice_text
from each import for_each

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


@for_each(("x", "y"), PLACES)
def test_a_joint_stands_where_it_is_stated_to(x, y):
    assert place_of_e(f'E = ["{x} mm", "{y} mm"]') == pytest.approx((x, y), abs=0.05)


def test_a_rough_position_is_enough():
    assert place_of_e('E = ["300 mm", "-200 mm"]') == pytest.approx(PLACES[1], abs=0.05)


@for_each("at", ['["-500 mm", "80 mm"]', '["255 mm", "82 mm"]'])
def test_a_position_that_settles_nothing_may_stand_in_files_of_0_1(at):
    assert place_of_e(f"D = {at}") == pytest.approx(PLACES[0], abs=0.05)


def test_a_position_that_settles_nothing_and_is_wrong_is_a_notice_in_files_of_0_1():
    told = [notice_text(one.code, one.values, "en") for one in analyse(read_machine(old(with_position(WRONG)))).notices]
    assert "the position stated for D has no effect: lengths and branches put it at 255.2 mm, 102.7 mm" in told
    right = analyse(read_machine(old(with_position('D = ["255 mm", "82 mm"]'))))
    assert [one for one in right.notices if one.code == "position_idle"] == []


@for_each(
    ("positions", "told"),
    [
        (WRONG, "has no effect there"),
    ],
)
def test_a_position_that_settles_nothing_and_is_wrong_is_refused_in_format_2(positions, told):
    text = with_position(positions)
    with pytest.raises(InputError) as refusal:
        read_machine(text, "my.toml")
    problem, line = refusal.value.problems[0], refusal.value.places[0].partition(":")[2]
    assert problem.key == f"positions.{positions[0]}"
    assert told in problem.message
    assert text.split("\n")[int(line) - 1].startswith(f"{positions[0]} = ")


def test_all_positions_that_settle_nothing_are_notices():
    results = analyse(read_machine(with_position('D = ["255 mm", "82 mm"]\nQ = ["1 m", "0 m"]')))
    told = [notice_text(item.code, item.values, "en") for item in results.notices if item.code == "position_unused"]
    ending = "settles nothing: without it everything stays the same"
    assert told == [f"the position stated for {name} {ending}" for name in "DQ"]


def test_a_position_that_settles_a_branch_or_gives_a_length_may_stand_in_format_2():
    assert read_machine(with_position("E = " + str([f"{one} mm" for one in PLACES[1]])))
    assert read_machine(f"format = 2\n{LENGTHS}").linkage


@for_each("written", ["0", "true", '"2"'])
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


# a cylinder between two moving links, and the two ways to assemble them
LIFT = """
{version}
[fixed_points]
O = ["0 mm", "0 mm"]
B = ["400 mm", "0 mm"]
[driver]
cylinder = ["P", "R"]
start = "250 mm"
law = [{{ kind = "4-5-6-7", to = "260 mm", over = "1 s" }}, {{ kind = "4-5-6-7", to = "250 mm", over = "1 s" }}]
[links]
a = {{ joins = ["O", "C"], length = "300 mm", points = {{ P = ["100 mm", "40 mm"] }} }}
b = {{ joins = ["C", "D"], length = "350 mm" }}
c = {{ joins = ["B", "D"], length = "280 mm", points = {{ R = ["150 mm", "10 mm"] }} }}
[positions]
C = ["{c[0]} mm", "{c[1]} mm"]
D = ["{d[0]} mm", "{d[1]} mm"]
[table]
step = "0.1 s"
"""
ONE, OTHER = ((-56.128, -294.703), (120.106, 7.697)), ((283.056, -99.395), (274.916, 250.508))


@for_each("places", [ONE, OTHER])
def test_a_cylinder_between_moving_links_is_assembled_near_what_is_stated(places):
    """The places by another solver (scipy's, from 3600 positions)."""
    (c, d), rough = places, [(x + 20, y - 20) for x, y in places]
    machine = read_machine(LIFT.format(version="format = 2", c=rough[0], d=rough[1]))
    found = analyse(machine).columns_at([0.0], ["point_x.C", "point_y.C", "point_x.D", "point_y.D"])
    assert [float(one[0]) * 1e3 for one in found.values()] == pytest.approx([*c, *d], abs=0.01)


def test_a_start_far_from_where_links_are_assembled_is_told():
    far = {"c": (60, 290), "d": (400, 280)}
    told = [one for one in read_machine(LIFT.format(version="", **far)).notices if one[0] == "position_far"]
    assert [one[1]["name"] for one in told] == ["C", "D"]
    with pytest.raises(InputError) as refusal:
        read_machine(LIFT.format(version="format = 2", **far))
    assert [one.key for one in refusal.value.problems] == ["positions.C", "positions.D"]


@pytest.mark.slow
def test_what_a_group_of_class_iii_hangs_on_is_settled_before_it():
    """A dyad whose branch is seen only when the link it hangs on has been placed, and a group beyond it."""
    machine = read_machine("""
[fixed_points]
O = ["0 mm", "0 mm"]
O1 = ["2.722953 mm", "29.784260 mm"]
O16 = ["26.632188 mm", "-23.191061 mm"]
O19 = ["1.078395 mm", "11.971423 mm"]
[links]
link3 = { joins = ["A", "P2"], length = "40.729325 mm" }
link4 = { joins = ["O1", "P2"], length = "20.245106 mm", points = { T5 = ["38.874581 mm", "-19.836250 mm"] } }
link7 = { joins = ["T5", "P6"], length = "47.486238 mm" }
link9 = { joins = ["A", "P6"], length = "26.900628 mm" }
link13 = { joins = ["P10", "P11"], length = "14.552081 mm", points = { P12 = ["6.925370 mm", "18.566878 mm"] } }
link15 = { joins = ["P6", "P10"], length = "15.527924 mm" }
link17 = { joins = ["O16", "P11"], length = "28.382536 mm" }
link20 = { joins = ["O19", "P12"], length = "23.620459 mm" }
[crank]
pivot = "O"
pin = "A"
radius = "8.069956 mm"
speed = "714.5 rpm"
[positions]
P2 = ["20.924789 mm", "38.647525 mm"]
P6 = ["-0.988234 mm", "25.329686 mm"]
P10 = ["4.727098 mm", "10.891840 mm"]
P11 = ["6.099865 mm", "-3.595346 mm"]
P12 = ["23.864481 mm", "5.748855 mm"]
""")
    found = analyse(machine).columns_at([0.0], ["point_x.P12", "point_y.P12"])
    assert [float(one[0]) * 1e3 for one in found.values()] == pytest.approx([23.864481, 5.748855], abs=1e-4)
