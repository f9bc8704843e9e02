"""Velocities and accelerations of points and of blocks in slotted levers that textbooks print, from machine files.

As printed in the companion notebooks github.com/FOSSEE/Python-Textbook-Companions at commit
d34b2ae7e5e6051f7c87531ebc73b154b082d05b; angles that stand in figures are from the books. Books read them off drawings;
values with more digits are exact derivatives of the closed loops at 40 digits.
"""

import math

import pytest

import crankwork
from crankwork.kinematics.crank_grid import CrankGrid
from each import for_each

INCH = 0.0254


def at(text, degrees):
    """Return the columns of a machine file at one crank angle."""
    columns = crankwork.analyse(crankwork.read_machine(text), CrankGrid.from_degrees([degrees])).columns
    return {key: float(values[0]) for key, values in columns.items()}


SLOTTED_LEVER = """
    fixed_points = { O = ["0 in", "0 in"], C = ["0 in", "8 in"] }
    crank = { pivot = "C", pin = "P", radius = "4 in", start = "90 deg", speed = "60 rpm" }
    links.lever = { joins = ["O", "N"], length = "14 in" }
    guides.slot = { link = "lever" }
    sliders.block = { pin = "P", guide = "slot" }
"""


class TestBevan37:
    """T. Bevan, The Theory of Machines, ch. 3, ex. 7, p. 110: crank and slotted lever, 120 degrees at the crank."""

    def test_the_lever_turns_as_printed(self):
        found = at(SLOTTED_LEVER, 60.0)
        assert found["slider_displacement.block"] / INCH == pytest.approx(10.6, rel=0.002)
        assert found["slider_displacement.block"] / INCH == pytest.approx(10.58300524425836, rel=1e-12)
        assert found["link_angular_velocity.lever"] == pytest.approx(1.77, rel=0.02)
        assert found["link_angular_velocity.lever"] == pytest.approx(1.79519580205131, rel=1e-12)
        assert abs(found["link_angular_acceleration.lever"]) == pytest.approx(4.23, rel=0.02)
        assert abs(found["link_angular_acceleration.lever"]) == pytest.approx(4.186446434275633, rel=1e-12)

    def test_the_block_has_the_coriolis_acceleration_of_the_law_of_cosines(self):
        found, w = at(SLOTTED_LEVER, 60.0), math.tau
        way = math.sqrt(80 + 64 * math.cos(math.pi / 3))
        along = -32 * math.sin(math.pi / 3) * w / way * INCH
        assert found["slider_velocity.block"] == pytest.approx(along, rel=1e-12)
        assert found["coriolis_acceleration.block"] == pytest.approx(2 * 1.79519580205131 * along, rel=1e-12)

    def test_its_parts_make_up_the_acceleration_of_the_crankpin(self):
        found, w = at(SLOTTED_LEVER, 60.0), math.tau
        th, s = found["link_angle.lever"], found["slider_displacement.block"]
        turning, rate = found["link_angular_velocity.lever"], found["link_angular_acceleration.lever"]
        along = found["slider_acceleration.block"] - turning**2 * s
        across = rate * s + found["coriolis_acceleration.block"]
        x, y = (along * math.cos(th) - across * math.sin(th), along * math.sin(th) + across * math.cos(th))
        centripetal = 4 * INCH * w**2
        assert (x, y) == pytest.approx((centripetal * math.sin(math.pi / 3), -centripetal / 2), rel=1e-12)
        assert (found["point_acceleration_x.P"], found["point_acceleration_y.P"]) == pytest.approx((x, y), rel=1e-12)


SLIDER_CRANK = """
    fixed_points.O = ["0 m", "0 m"]
    crank = {{ pivot = "O", pin = "B", radius = "{r} m", speed = "{n} rpm" }}
    links.rod = {{ joins = ["P", "B"], length = "{l} m", points = {{ E = ["{at} m", "0 m"] }} }}
    guides.bed = {{ through = "O" }}
    sliders.crosshead = {{ pin = "P", guide = "bed" }}
"""


FOOT = 12 * INCH
ENGINE = """
    fixed_points.O = ["0 in", "0 in"]
    crank = {{ pivot = "O", pin = "C", radius = "9 in", speed = "240 rpm"{more} }}
    links.rod = {{ joins = ["C", "P"], length = "36 in", points = {{ X = ["12 in", "0 in"] }} }}
    guides.bed = {{ through = "O" }}
    sliders.piston = {{ pin = "P", guide = "bed" }}
"""


@for_each(
    ("more", "piston", "point", "rod", "printed"),
    [
        ("", 385.610118654139, 422.4504285947545, 98.96964765662062, (422, 98.7)),
        (', angular_acceleration = "100 rad/s2"', 443.1733303311859, 452.8191827076349, 79.56636771449882, (452, 79.3)),
    ],
)
def test_engine_whose_crank_gathers_speed(more, piston, point, rod, printed):
    """T. Bevan, ch. 3, ex. 4, p. 93: crank 9 in, rod 36 in, 240 rev/min, 40 degrees; without and with 100 rad/s2.

    The notebook prints the acceleration of the piston against the crankpin, 306 ft/s2, as that of the piston.
    """
    found = at(ENGINE.format(more=more), 40.0)
    assert abs(found["slider_acceleration.piston"]) / FOOT == pytest.approx(piston, rel=1e-12)
    assert found["point_acceleration.X"] / FOOT == pytest.approx(point, rel=1e-12)
    assert abs(found["link_angular_acceleration.rod"]) == pytest.approx(rod, rel=1e-12)
    assert (found["point_acceleration.X"] / FOOT, abs(found["link_angular_acceleration.rod"])) == pytest.approx(
        printed, rel=5e-3
    )


def test_point_of_the_rod_of_a_steam_engine():
    """Khurmi and Gupta, Theory of Machines, ex. 7.2, p. 148: crank 0.5 m, rod 2 m, 180 rev/min, 45 degrees."""
    found = at(SLIDER_CRANK.format(r=0.5, l=2, n=180, at=1.5), 45.0)
    assert abs(found["slider_velocity.crosshead"]) == pytest.approx(8.15, rel=0.04)
    assert abs(found["slider_velocity.crosshead"]) == pytest.approx(7.861272405203857, rel=1e-12)
    assert abs(found["link_angular_velocity.rod"]) == pytest.approx(3.4, rel=0.005)
    assert found["point_velocity.E"] == pytest.approx(8.5, rel=0.01)
    assert found["point_velocity.E"] == pytest.approx(8.571675659143011, rel=1e-12)


def test_middle_of_a_connecting_rod():
    """Khurmi and Gupta, ex. 8.1, p. 179: crank 150 mm, rod 600 mm, 300 rev/min, 45 degrees."""
    found = at(SLIDER_CRANK.format(r=0.15, l=0.6, n=300, at=0.3), 45.0)
    assert found["point_velocity.E"] == pytest.approx(4.1, rel=0.03)
    assert found["point_velocity.E"] == pytest.approx(3.995358107874297, rel=1e-12)
    assert found["point_acceleration.E"] == pytest.approx(117, rel=0.003)
    assert found["point_acceleration.E"] == pytest.approx(117.3104257701301, rel=1e-12)
    assert abs(found["link_angular_acceleration.rod"]) == pytest.approx(171.67, rel=0.001)
    # of the middle by hand: half of what crankpin and crosshead have
    along = found["point_velocity_x.E"], found["point_acceleration_x.E"]
    halves = (found[f"point_{rate}_x.B"] + found[f"point_{rate}_x.P"] for rate in ("velocity", "acceleration"))
    assert along == pytest.approx([one / 2 for one in halves], rel=1e-12)


FOUR_BAR = """
    fixed_points = {{ O = [{pivot}], D = [{fixed}] }}
    crank.pivot = "O"
    crank.pin = "A"
    crank.radius = "{crank} mm"
    crank.start = "{start} deg"
    crank.speed = "{speed} rad/s"
    crank.angular_acceleration = "{eps} rad/s2"
    links.coupler = {{ joins = ["A", "B"], length = "{coupler} mm" }}
    links.rocker = {{ joins = ["D", "B"], length = "{rocker} mm" }}
"""


def test_four_bar_with_a_crank_that_gathers_speed():
    """Khurmi and Gupta, ex. 8.5, p. 186: 300, 360, 360 mm, 600 mm apart; the crank 10 rad/s and 30 rad/s2 at 60.

    The book's crank turns clockwise; here its mirror turns the other way.
    """
    text = FOUR_BAR.format(
        pivot='"0 mm", "0 mm"', fixed='"600 mm", "0 mm"', crank=300, start=0, speed=10, eps=30, coupler=360, rocker=360
    )
    text += '\n[positions]\nB = ["500 mm", "-346 mm"]\n'
    found = at(text.replace('start = "0 deg"', 'start = "-60 deg"'), 0.0)
    assert found["link_angular_velocity.rocker"] == pytest.approx(6.1, rel=0.02)
    assert abs(found["link_angular_velocity.coupler"]) == pytest.approx(5.7, rel=0.06)
    assert abs(found["link_angular_velocity.coupler"]) == pytest.approx(6.01929265428846, rel=1e-12)
    assert found["point_acceleration.B"] == pytest.approx(29.6, rel=0.04)
    assert found["point_acceleration.B"] == pytest.approx(30.78259814437143, rel=1e-12)
    assert abs(found["link_angular_acceleration.rocker"]) == pytest.approx(77.45149932875567, rel=1e-12)
    assert abs(found["link_angular_acceleration.coupler"]) == pytest.approx(37.8, rel=0.01)


def test_four_bar_given_by_vectors():
    """Meriam and Kraige, Engineering Mechanics: Dynamics, ex. 5/8 and 5/14, p. 352 and 375: crank CB at 2 rad/s."""
    text = FOUR_BAR.format(
        pivot='"250 mm", "50 mm"', fixed='"0 mm", "0 mm"', crank=75, start=180, speed=2, eps=0,
        coupler=math.hypot(175, 50), rocker=100,
    )  # fmt: skip
    found = at(text + '\n[positions]\nB = ["0 mm", "100 mm"]\n', 0.0)
    assert found["link_angular_velocity.coupler"] == pytest.approx(-0.857, rel=1e-3)
    assert found["link_angular_velocity.rocker"] == pytest.approx(-0.429, rel=2e-3)
    assert found["link_angular_acceleration.coupler"] == pytest.approx(-0.1049562682215743, rel=1e-10)
    assert found["link_angular_acceleration.rocker"] == pytest.approx(-4.338192419825073, rel=1e-12)
    # of the end of the rocker 100 mm above its pivot
    assert found["point_velocity_x.B"] == pytest.approx(0.1 * 3 / 7, rel=1e-12)
    assert found["point_velocity_y.B"] == pytest.approx(0, abs=1e-15)
    assert found["point_acceleration_x.B"] == pytest.approx(0.4338192419825073, rel=1e-12)
    assert found["point_acceleration_y.B"] == pytest.approx(-0.1 * (3 / 7) ** 2, rel=1e-12)


def test_a_guide_that_the_crank_carries():
    """A block on a slot of the crank, 2 rad/s2 faster: along w^2 s is missing, across are eps s and 2 w s'."""
    found = at(
        """
        fixed_points = { O = ["0 mm", "0 mm"], C = ["150 mm", "0 mm"] }
        crank = { pivot = "O", pin = "A", radius = "50 mm", speed = "100 rpm", angular_acceleration = "2 rad/s2" }
        links.lever = { joins = ["C", "B"], length = "300 mm" }
        guides.slot = { link = "crank", angle = "0 deg" }
        sliders.block = { guide = "slot", pin = "B" }
        positions.B = ["440 mm", "0 mm"]
        """,
        30.0,
    )
    th, w, s = math.pi / 6, 10 * math.pi / 3, found["slider_displacement.block"]
    assert s == pytest.approx(0.15 * math.cos(th) + math.sqrt(0.3**2 - (0.15 * math.sin(th)) ** 2), rel=1e-12)
    assert found["coriolis_acceleration.block"] == pytest.approx(2 * w * found["slider_velocity.block"], rel=1e-12)
    along, across = found["slider_acceleration.block"] - w**2 * s, 2 * s + found["coriolis_acceleration.block"]
    x, y = along * math.cos(th) - across * math.sin(th), along * math.sin(th) + across * math.cos(th)
    assert (found["point_acceleration_x.B"], found["point_acceleration_y.B"]) == pytest.approx((x, y), rel=1e-12)
