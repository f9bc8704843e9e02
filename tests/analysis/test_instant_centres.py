"""Instant centres lie where the perpendiculars of the velocities of two points of a link cross."""

import numpy as np
import pytest

from crankwork import analyse, read_machine, template
from crankwork.kinematics.crank_grid import CrankGrid

pytestmark = pytest.mark.elsewhere


def crossing(columns, one, other):
    """Return where the lines through two points, across their velocities, cross."""
    places = [np.stack([columns[f"point_{axis}.{name}"] for axis in "xy"]) for name in (one, other)]
    ways = [np.stack([columns[f"point_velocity_{axis}.{name}"] for axis in "xy"]) for name in (one, other)]
    sides = [(place * way).sum(axis=0) for place, way in zip(places, ways, strict=True)]
    area = ways[0][0] * ways[1][1] - ways[0][1] * ways[1][0]
    x = (sides[0] * ways[1][1] - sides[1] * ways[0][1]) / area
    y = (ways[0][0] * sides[1] - ways[1][0] * sides[0]) / area
    return x, y


def test_centres_lie_where_perpendiculars_cross():
    wrong = []
    for text, link, points in (
        (template("four-bar"), "coupler", ("A", "B")),
        (SLIDER_CRANK, "rod", ("A", "B")),
        (template("crank-shaper"), "link", ("C", "D")),
    ):
        columns = analyse(read_machine(text), CrankGrid.from_degrees(np.arange(3.0, 360.0, 7.0))).columns
        for axis, expected in zip("xy", crossing(columns, *points), strict=True):
            if columns[f"instant_centre_{axis}.{link}"] != pytest.approx(expected, rel=1e-9):
                wrong.append((link, axis))
    assert wrong == []


SLIDER_CRANK = """
    fixed_points.O = ["0 mm", "0 mm"]
    crank = { pivot = "O", pin = "A", radius = "50 mm", speed = "60 rpm" }
    links.rod = { joins = ["A", "B"], length = "200 mm" }
    guides.bed.through = "O"
    sliders.piston = { pin = "B", guide = "bed" }
"""


def test_a_rod_that_does_not_turn_has_no_centre_and_one_on_a_pivot_no_column():
    degrees, key = [60.0, 90.0, 120.0], "instant_centre_y.rod"
    columns = analyse(read_machine(SLIDER_CRANK), CrankGrid.from_degrees(degrees)).columns
    for found in (columns, analyse(read_machine(SLIDER_CRANK)).columns_at(degrees, [key])):
        assert np.isnan(found[key]).tolist() == [False, True, False]
    # above the piston, on the line of the crank
    assert columns["instant_centre_x.rod"][0] == pytest.approx(columns["point_x.B"][0], rel=1e-12)
    assert columns["instant_centre_y.rod"][0] == pytest.approx(np.sqrt(3) * columns["point_x.B"][0], rel=1e-12)
    four_bar = analyse(read_machine(template("four-bar"))).columns
    assert not [key for key in four_bar if key.startswith("instant_centre") and not key.endswith(".coupler")]
