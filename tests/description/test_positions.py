"""Stated positions settle branches, also where a link carries the point that a group hangs on."""

import pytest

from crankwork import analyse, read_machine, template
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import CrankGrid

# the two places of E with the lengths of the template at a crank angle of zero [mm]
PLACES = [(415.15182383069, 105.15729815467), (255.5, -57.26)]


def place_of_e(positions):
    text = template("watt-six-bar").replace("[table]", f"[positions]\n{positions}\n[table]")
    columns = analyse(read_machine(text)).columns_at(CrankGrid.from_degrees([0.0]))
    return float(columns["point_x.E"][0]) * 1e3, float(columns["point_y.E"][0]) * 1e3


@pytest.mark.parametrize(("x", "y"), PLACES)
def test_a_joint_stands_where_it_is_stated_to(x, y):
    assert place_of_e(f'E = ["{x} mm", "{y} mm"]') == pytest.approx((x, y), abs=0.05)


def test_a_rough_position_is_enough():
    assert place_of_e('E = ["300 mm", "-200 mm"]') == pytest.approx(PLACES[1], abs=0.05)


def test_a_position_that_settles_nothing_and_is_wrong_is_refused():
    with pytest.raises(CrankworkError, match=r"positions\.D.*has no effect"):
        place_of_e('D = ["-500 mm", "80 mm"]')


def test_a_position_that_settles_nothing_and_is_right_may_stand():
    assert place_of_e('D = ["255 mm", "82 mm"]') == pytest.approx(PLACES[0], abs=0.05)
