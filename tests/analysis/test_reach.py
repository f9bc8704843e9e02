"""What is told of a crank that turns back and of one that passes change points, from the machine file."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork import analyse, figures, read_machine
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.report.drawing import moving_drawing
from four_bars import four_bar_of

pytestmark = pytest.mark.elsewhere
EXAMPLES = Path(__file__).parent.parent.parent / "examples"
PART = ', from = "30 deg", to = "60 deg"'


def four_bar(*lengths, mass="1 kg", **more):
    return four_bar_of(*lengths, mass=mass, **more)


def deg(value):
    return math.degrees(value)


def test_range_and_swing_do_not_depend_on_the_start():
    whole = pytest.approx(64.53289907034215, abs=1e-9)
    for start in (0, 17, 30, 45, 79, 120, 200, 300, 350):
        summary = analyse(four_bar(150, 80, 150, 200, start=start)).summary
        assert deg(summary["crank_range"]) == whole, start
        assert deg(summary["link_swing_circuit.rocker"]) == whole, start
        nearest = min((43.92320613281, 23.81345930662), key=lambda one: abs(one - deg(summary["link_swing.rocker"])))
        assert deg(summary["link_swing.rocker"]) == pytest.approx(nearest, abs=1e-9), start
        assert deg(summary["crank_range_end"] - summary["crank_range_start"]) == whole, start


def test_what_moves_to_both_sides_of_zero_is_told_whole():
    machine = four_bar(30, 40, 50, 70)
    results = analyse(machine)
    half = deg(math.acos((3**2 + 7**2 - 9**2) / (2 * 3 * 7)))
    assert deg(results.summary["crank_range_start"]) == pytest.approx(-half, abs=1e-9)
    assert results.grid.degrees.tolist() == [10.0 * one for one in range(-12, 13)]
    assert np.isfinite(results.columns["point_x.C"]).all()
    notice = next(one for one in results.notices if one.code == "partial")
    assert notice.values["from"] == pytest.approx(-half, abs=1e-9)
    asked = analyse(machine, CrankGrid.from_degrees([0.0, 90.0, 300.0]))
    assert asked.grid.degrees.tolist() == [-60.0, 0.0, 90.0]


def test_what_has_no_bound_has_no_largest_value():
    results = analyse(four_bar(150, 80, 150, 200))
    assert not [key for key in results.summary if key.startswith("joint_force_max")]
    told = next(one for one in results.notices if one.code == "unbounded")
    assert "joint_force" in told.values["quantities"].split(", ")
    assert told.values["angles"].split("°, ") == ["16.2602", "80.7931"]
    assert results.unmet == ()


def test_largest_values_of_a_working_range():
    results = analyse(four_bar(150, 80, 150, 200, of_crank=PART))
    columns = results.columns_at(np.linspace(30, 60, 3001))
    for joint in "OACB":
        assert results.summary[f"joint_force_max.{joint}"] == pytest.approx(
            columns[f"joint_force.{joint}"].max(), rel=1e-6
        )
    assert deg(results.summary["crank_range"]) == pytest.approx(64.53289907034215, abs=1e-9)


def test_a_working_range_that_is_not_reached_is_refused():
    for of_crank, crank, coupler, message in (
        (', from = "10 deg"', 150, 80, r"crank\.from: from 10 to 80\.79.* is not within 16\.26.* to 80\.79"),
        (', from = "60 deg", to = "50 deg"', 150, 80, r"crank\.from: from 60 to 50 deg is not within"),
        (', to = "50 deg"', 30, 180, r"crank\.to: the crank turns fully"),
    ):
        with pytest.raises(CrankworkError, match=message):
            four_bar(crank, coupler, 150, 200, of_crank=of_crank)


def test_a_parallelogram_turns_fully():
    results = analyse(four_bar(300, 1000, 300, 1000))
    assert [one.code for one in results.notices] == ["change_points"]
    assert results.notices[0].values["angles"] == "0°, 180"
    grid = results.grid
    assert results.columns["point_x.C"] == pytest.approx(1 + 0.3 * grid.cos, abs=1e-12)
    speed = math.tau
    # the coupler does not turn: its weight-free force of inertia is borne by the pins as the lever law says
    inertia = 1.0 * 0.3 * speed**2
    assert results.columns["joint_force.C"] == pytest.approx(np.full(len(grid), 0.04 * inertia), abs=1e-11)
    assert results.columns["joint_force.A"] == pytest.approx(np.full(len(grid), 0.96 * inertia), abs=1e-11)
    assert results.unmet == ()


def test_a_force_that_is_nothing_beside_the_others_has_its_limit_at_a_change_point():
    """Of a coupler of a milligram rounding is all that remains; the rocker turns about its pivot at a steady speed."""
    rocker = 'mass = "1 kg"\ncentre = ["75 mm", "0 mm"]'
    results = analyse(four_bar(150, 500, 150, 500, more=rocker, mass="1e-6 kg"))
    assert results.columns["joint_force.B"] == pytest.approx(np.full(len(results.grid), 0.075 * math.tau**2), rel=1e-6)
    assert np.isfinite([one for key, one in results.summary.items() if key.startswith("joint_force")]).all()


def test_forces_of_a_loaded_parallelogram_are_not_told_where_they_have_no_limit():
    load = '[[loads]]\nkind = "torque"\nlink = "rocker"\ntorque = ["10 N*m"]'
    results = analyse(four_bar(300, 1000, 300, 1000, more=load, mass=None))
    grid = results.grid
    at = np.abs(grid.sin) > 1e-9
    # the coupler pulls with the torque over its distance from the pivot
    assert results.columns["joint_force.C"][at] == pytest.approx(10 / (0.3 * np.abs(grid.sin[at])), rel=1e-10)
    assert np.isnan(results.columns["joint_force.C"][~at]).all()
    assert "joint_force_max.C" not in results.summary
    assert {one.code for one in results.notices} == {"change_points", "unbounded"}
    assert results.columns["balancing_torque"] == pytest.approx(np.full(len(grid), -10.0), abs=1e-10)


def test_two_turns_of_a_kite_are_told():
    codes = [one.code for one in analyse(four_bar(100, 150, 150, 100)).notices]
    assert codes == ["change_points", "two_turns"]


def test_lengths_that_are_nearly_those_of_a_change_point_are_told():
    told = [one for one in analyse(four_bar(300, 1000, 300.0001, 1000)).notices if one.code == "nearly_change_point"]
    assert sorted(round(one.values["angle"]) % 180 for one in told) == [0, 0]
    assert [one.values["miss"] for one in told] == pytest.approx([1e-7, 1e-7], rel=0.02)


def test_a_drawing_of_a_crank_that_turns_back_swings():
    drawn = moving_drawing(four_bar(30, 40, 50, 70))
    assert "to and fro in 4 s" in drawn.about
    assert not drawn.turns
    shown = [float(one.replace("−", "-")) for one in re.findall(r"= (−?[\d.]+)", "; ".join(drawn.readouts))]
    assert len(shown) == 72
    assert min(shown) < -120
    assert max(shown) > 120
    assert "one revolution in 4 s" in moving_drawing(four_bar(300, 1000, 300, 1000)).about


THIRD = """
fixed_points = { O = ["0 mm", "0 mm"], P = ["1000 mm", "0 mm"], Q = ["2000 mm", "0 mm"] }
crank = { pivot = "O", pin = "A", radius = "300 mm", speed = "60 rpm" }
links.rod = { joins = ["A", "B"], length = "1000 mm", points.C = ["2000 mm", "0 mm"] }
[links.second]
joins = ["P", "B"]
length = "300 mm"
[links.third]
joins = ["Q", "C"]
length = "THIRD"
"""


def test_the_third_of_coupled_wheels_is_named_and_its_misfit_told():
    with pytest.raises(CrankworkError, match=r"does not fit: .* 300 to 300 mm apart, and it is 310 mm long"):
        read_machine(THIRD.replace("THIRD", "310 mm"))


def test_a_link_too_many_has_no_mass():
    """Where one of the two has none that is taken for it."""
    heavy = THIRD.replace("THIRD", '300 mm"\nmass = "2 kg"\ncentre = "C')
    assert [one.member.name for one in read_machine(THIRD.replace("THIRD", "300 mm")).redundant] == ["third"]
    assert [one.member.name for one in read_machine(heavy).redundant] == ["second"]
    both = heavy.replace("[links.third]", 'mass = "2 kg"\ncentre = "B"\n[links.third]')
    with pytest.raises(CrankworkError, match=r"third is one link too many \(mobility 0\): .* taken without mass"):
        read_machine(both)


def test_what_has_a_limit_from_either_side_is_not_told_as_unbounded():
    """A torque that rises evenly from the change point, over the distance of the coupler from the pivot."""
    table = 'torque = ["0 N*m", "10 N*m", "0 N*m", "4 N*m"]\nat = ["0 deg", "90 deg", "180 deg", "270 deg"]'
    load = f'[[loads]]\nkind = "torque"\nlink = "rocker"\n{table}\ncurve = "straight"'
    results = analyse(four_bar(300, 1000, 300, 1000, more=load, mass=None))
    beside = results.columns_at([179.99, 180.01], ["joint_force_x.C"])["joint_force_x.C"]
    assert np.abs(beside) == pytest.approx([20 / math.pi / 0.3, 8 / math.pi / 0.3], rel=1e-6)
    told = next(one for one in results.notices if one.code == "undetermined")
    assert told.values == {"angles": "0°, 180°, 360", "quantities": "joint_force"}
    assert "unbounded" not in {one.code for one in results.notices}


def test_the_parallelogram_of_the_examples():
    """Its coupler goes round without turning: half of its centrifugal force at each end, and what the rocker has."""
    results = analyse(crankwork.read(EXAMPLES / "parallelogram.toml"))
    w = 4 * math.pi
    half = 4 * w**2 * 0.15 / 2
    wanted = {"A": half, "C": half, "O": half, "B": half + w**2 * 0.075}
    for name, force in wanted.items():
        assert results.columns[f"joint_force.{name}"] == pytest.approx(np.full(37, force), rel=1e-11)
    angle = np.radians(results.grid.degrees)
    assert results.columns["point_x.P"] == pytest.approx(0.25 + 0.15 * np.cos(angle), abs=1e-13)
    assert results.columns["point_y.P"] == pytest.approx(0.08 + 0.15 * np.sin(angle), abs=1e-13)
    assert results.columns["balancing_torque"] == pytest.approx(np.zeros(37), abs=1e-10)


def test_everything_about_a_kite_covers_its_two_turns():
    """The second turn is the first backwards, mirrored: links swing through both."""
    results = analyse(four_bar(100, 150, 150, 100))
    assert results.grid.degrees[-1] == 720.0
    rocker = np.degrees(results.columns["link_angle.rocker"])
    assert rocker[::-1] == pytest.approx(rocker[-1] + rocker[0] - rocker, abs=1e-8)
    force = results.columns["joint_force.C"]
    assert force[::-1] == pytest.approx(force, rel=1e-6)
    # the joint by the law of cosines: the diagonal from A to B is 200 sin(phi/2), the kite is symmetrical about OC
    phi = np.radians(results.grid.degrees[1:36])
    along = 100 * np.cos(phi / 2)
    far = along + np.sqrt(150**2 - (100 * np.sin(phi / 2)) ** 2)
    x = 1e3 * results.columns["point_x.C"][1:36]
    assert np.abs(x) == pytest.approx(np.abs(far * np.cos(phi / 2)), rel=1e-9)
    film = moving_drawing(results)
    assert film.angles[-1] == 720
    assert film.seconds == 8


GEARED = (Path(__file__).parent.parent / "machines" / "geared-five-bar.toml").read_text("utf-8")


def test_gears_bring_a_linkage_back_after_some_turns():
    """Over all of them constant forces do no work, and everything is as it was."""
    for ratio, turns in (("-0.5", 2), ("1.5", 2), ("0.25", 4)):
        results = analyse(read_machine(GEARED.replace("ratio = -2", f"ratio = {ratio}")))
        assert results.grid.degrees[-1] == 360.0 * turns
        assert results.summary["mean_torque"] == pytest.approx(0.0, abs=1e-11 * results.summary["static_torque_max"])
        for key in ("joint_force.C", "kinetic_energy", "point_x.C", "balancing_torque"):
            assert results.columns[key][-1] == pytest.approx(results.columns[key][0], rel=1e-9), (ratio, key)
        assert [one.values["turns"] for one in results.notices if one.code == "two_turns"] == [turns]


def test_gears_that_do_not_bring_it_back_are_told():
    results = analyse(read_machine(GEARED.replace("ratio = -2", "ratio = 0.7321")))
    assert results.grid.degrees[-1] == 360.0
    assert [one.values["ratio"] for one in results.notices if one.code == "no_cycle"] == [0.7321]


TANGENT = """
fixed_points.O = ["0 mm", "0 mm"]
crank = { pivot = "O", pin = "A", radius = "50 mm", speed = "60 rpm", start = "20 deg" }
guides = { arm = { link = "crank" }, wall = { through = ["100 mm", "0 mm"], angle = "90 deg" } }
sliders = { block = { guide = "arm", pin = "P" }, ram = { guide = "wall", pin = "P" } }
"""


def test_what_runs_away_is_told_with_its_angle():
    """The pin is at 100 mm times the tangent of the crank's direction, which has none at 90 degrees."""
    with pytest.raises(CrankworkError) as caught:
        read_machine(TANGENT)
    message = caught.value.problems[0].message
    assert message.name == "runs_away"
    assert message.values["angle"] % 180 == pytest.approx(70.0, abs=1e-4)
    assert message.values["name"] in ("block", "ram")


def test_beside_a_working_range_the_dead_positions_are_told():
    codes = {one.code for one in analyse(four_bar(150, 80, 150, 200, of_crank=PART)).notices}
    assert {"working_range", "unbounded"} <= codes


def test_a_partial_motion_has_its_plans():
    assert {"position_plans", "velocity_plan", "joint_forces"} <= figures(analyse(four_bar(150, 80, 150, 200))).keys()


# Chebyshev's straight line 200 : 250 : 100, crossed,, after Artobolevsky
def crossed(special=""):
    return read_machine(f"""
format = 2
[fixed_points]
O2 = ["0 mm", "0 mm"]
O4 = ["200 mm", "0 mm"]
[crank]
pivot = "O2"
pin = "A"
radius = "250 mm"
speed = "10 rpm"
[links]
coupler = {{ joins = ["A", "B"], length = "100 mm" }}
rocker = {{ joins = ["O4", "B"], length = "250 mm" }}
[branch]
B = -1
[table]
step = "5 deg"
special_angles = [{special}]
""")


def test_transmission_angles_reach_their_limits_in_dead_positions():
    # at one end the coupler lies on the rocker, at the other they are in line
    summary = analyse(crossed()).summary
    assert (summary["transmission_angle_min.B"], summary["transmission_angle_max.B"]) == (0.0, math.pi)


def test_a_row_in_a_dead_position_has_limits_and_no_value_where_there_is_none():
    # sides 200, 250 and 250 - 100 or 250 + 100 between the pivots and A
    first, last = deg(math.acos(0.8)), deg(math.acos(-0.2))
    results = analyse(crossed(f'"{first:.12f} deg", "{last:.9f} deg"'))
    assert results.grid.degrees[[0, 1, -1]] == pytest.approx([first, 40.0, last], abs=1e-7)
    columns = results.columns
    assert columns["transmission_angle.B"][[0, -1]].tolist() == [0.0, math.pi]
    assert columns["link_angle.rocker"][0] == pytest.approx(math.pi / 2, abs=1e-9)
    assert [columns[f"point_{axis}.B"][0] for axis in "xy"] == pytest.approx([0.2, 0.25], abs=1e-9)
    # B leaves by u along the line square to both links, u² = v t / 3 where A comes by v t, and sinks by u² / 0.5 m
    assert columns["point_velocity_y.B"][0] == pytest.approx(-2 / 3 * 0.2 * results.summary["speed"], rel=1e-8)
    for key in ("link_angular_velocity.rocker", "point_velocity_x.B", "point_acceleration.B"):
        assert np.flatnonzero(np.isnan(columns[key])).tolist() == [0, len(results.grid) - 1], key


def test_each_end_of_a_range_names_what_stops_there():
    # a four-bar ABCD that would fail at C elsewhere, and a dyad EFG whose links come into line before: Stephenson III
    text = """
format = 2
[fixed_points]
A = ["7 m", "4 m"]
D = ["23 m", "10 m"]
G = ["45 m", "17 m"]
[crank]
pivot = "A"
pin = "B"
radius = "12.165525060596439 m"
start = "1.7359450042095235 rad"
speed = "10 rpm"
[links]
CD = { joins = ["D", "C"], length = "15.132745950421556 m" }
EF = { joins = ["E", "F"], length = "25.179356624028344 m" }
FG = { joins = ["G", "F"], length = "15.132745950421556 m" }
[links.BCE]
joins = ["B", "C", "E"]
length = "21.93171219946131 m"
points = { E = ["19.65190843652354 m", "11.991767793052649 m"] }
[positions]
C = ["25 m", "25 m"]
F = ["43 m", "32 m"]
"""
    results = analyse(read_machine(text))
    notice = next(item for item in results.notices if item.code == "partial")
    assert notice.values["message"] == "at both ends links EF and FG are in line at F"
    assert results.summary["transmission_angle_min.F"] == 0.0
    assert results.summary["transmission_angle_max.F"] == math.pi
    # with longer links F stops the crank at one end only; at the other C does, where BD is BC - CD
    longer = text.replace("25.179356624028344", "30").replace(
        '["G", "F"], length = "15.132745950421556', '["G", "F"], length = "20'
    )
    longer = longer.replace('F = ["43 m", "32 m"]', "[branch]\nF = 1")
    results = analyse(read_machine(longer))
    notice = next(item for item in results.notices if item.code == "partial")
    radius, fixed, apart = 12.165525060596439, math.hypot(16, 6), 21.93171219946131 - 15.132745950421556
    between = math.acos((radius**2 + fixed**2 - apart**2) / (2 * radius * fixed))
    last = deg(math.atan2(6, 16) - between - 1.7359450042095235) + 360
    assert notice.values["to"] == pytest.approx(last, abs=1e-9)
    told = r"at -58\.9304 deg links EF and FG are in line at F, at 262\.374 deg links CD and BCE are in line at C"
    assert re.fullmatch(told, notice.values["message"])
