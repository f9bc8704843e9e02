"""Time ratios, ends of strokes, transmission angles and instant centres that books print, from machine files.

As printed in the companion notebooks github.com/FOSSEE/Python-Textbook-Companions at commit
d34b2ae7e5e6051f7c87531ebc73b154b082d05b; values with more digits are closed forms or closed loops at 40 digits.
"""

import math

import pytest

from machine_texts import analysed

SLOTTED_LEVER = """
    fixed_points = {{ O = ["0 mm", "{centres} mm"], A = ["0 mm", "0 mm"] }}
    crank = {{ pivot = "O", pin = "B", radius = "{crank} mm", speed = "60 rpm" }}
    links.lever = {{ joins = ["A", "P"], length = "{lever} mm" }}
    links.link = {{ joins = ["P", "R"], length = "900 mm" }}
    guides = {{ slot = {{ link = "lever" }}, bed = {{ through = ["0 mm", "{bed} mm"] }} }}
    sliders = {{ block = {{ pin = "B", guide = "slot" }}, ram = {{ pin = "R", guide = "bed" }} }}
"""


def test_crank_and_slotted_lever():
    """Khurmi and Gupta, Theory of Machines, ex. 5.1, p. 110: centres 300 mm apart, crank 120 mm."""
    summary = analysed(SLOTTED_LEVER.format(centres=300, crank=120, lever=450, bed=430)).summary
    assert summary["time_ratio.lever"] == pytest.approx(1.7, rel=0.01)
    assert summary["time_ratio.lever"] == pytest.approx(1.709952781721411, rel=1e-12)
    # the ends are where the crank stands across the lever
    swing = math.asin(120 / 300)
    assert summary["link_angle_max.lever"] == pytest.approx(math.pi / 2 + swing, rel=1e-12)
    assert summary["link_angle_min.lever"] == pytest.approx(math.pi / 2 - swing, rel=1e-12)
    assert summary["link_angle_max_angle.lever"] == pytest.approx(math.pi + swing, rel=1e-9)
    assert summary["link_angle_min_angle.lever"] == pytest.approx(math.tau - swing, rel=1e-9)


def test_stroke_of_a_slotted_lever():
    """B. K. Sarkar, Theory of Machines, ex. 1.1, p. 15: 200 mm, crank 100 mm, lever 400 mm; swings 30 degrees each way.

    The notebook takes a sine of degrees for one of radians and prints a stroke of -13.79 mm: 400 mm is right.
    """
    summary = analysed(SLOTTED_LEVER.format(centres=200, crank=100, lever=400, bed=370)).summary
    assert math.degrees(summary["link_swing.lever"]) / 2 == pytest.approx(30, rel=1e-12)
    assert summary["time_ratio.lever"] == pytest.approx(2, rel=1e-12)
    assert summary["time_ratio.ram"] == pytest.approx(2, rel=1e-12)
    assert summary["slider_stroke.ram"] == pytest.approx(0.4, rel=1e-12)
    ends = summary["slider_displacement_max.ram"], summary["slider_displacement_min.ram"]
    assert ends[0] - ends[1] == pytest.approx(0.4, rel=1e-12)
    assert ends[0] + ends[1] == pytest.approx(2 * math.sqrt(0.9**2 - (0.37 - 0.2 * math.sqrt(3)) ** 2), rel=1e-12)


def test_slotted_lever_made_for_a_stroke_and_a_time_ratio():
    """Khurmi and Gupta, ex. 5.3, p. 112: crank 30 mm; for 120 mm and 1.7 centres 75.7 mm apart, lever 151.48 mm."""
    found = analysed(
        SLOTTED_LEVER.format(centres=75.74231902831959, crank=30, lever=151.4846380566392, bed=140)
    ).summary
    assert found["time_ratio.lever"] == pytest.approx(1.7, rel=1e-9)
    assert found["slider_stroke.ram"] == pytest.approx(0.12, rel=1e-12)
    printed = analysed(SLOTTED_LEVER.format(centres=75.7, crank=30, lever=151.48, bed=140)).summary
    assert printed["time_ratio.lever"] == pytest.approx(1.7, rel=1e-3)
    assert printed["slider_stroke.ram"] == pytest.approx(0.12, rel=1e-3)


def test_whitworth():
    """Khurmi and Gupta, ex. 5.4, p. 112: fixed link 50 mm, crank 75 mm, arm 150 mm, link 135 mm long."""
    text = """
        fixed_points = { C = ["0 mm", "50 mm"], D = ["0 mm", "0 mm"] }
        crank = { pivot = "C", pin = "A", radius = "75 mm", speed = "60 rpm" }
        links.lever = { joins = ["D", "P"], length = "100 mm" }
        links.link = { joins = ["P", "R"], length = "135 mm" }
        guides = { slot = { link = "lever", angle = "180 deg" }, bed = { through = "D" } }
        sliders = { block = { pin = "A", guide = "slot" }, ram = { pin = "R", guide = "bed" } }
    """
    summary = analysed(text).summary
    assert summary["time_ratio.ram"] == pytest.approx(2.735, rel=1e-4)
    assert summary["time_ratio.ram"] == pytest.approx(2.735239182632303, rel=1e-12)
    assert summary["slider_stroke.ram"] == pytest.approx(0.2, rel=1e-12)
    # the lever turns fully: it has no ends
    assert "link_angle_max.lever" not in summary
    assert "time_ratio.lever" not in summary


FOUR_BAR = """
    fixed_points = {{ A = ["0 mm", "0 mm"], D = ["{ground} mm", "0 mm"] }}
    crank = {{ pivot = "A", pin = "B", radius = "{crank} mm", speed = "{speed} rpm" }}
    links.coupler = {{ joins = ["B", "C"], length = "{coupler} mm" }}
    links.rocker = {{ joins = ["D", "C"], length = "{rocker} mm" }}
"""


def test_crank_rocker_for_a_swing_and_a_time_ratio():
    """The example of crocker.js by S. Goessner, github.com/goessner/crocker: swing 80 degrees, time ratio 10/9."""
    lengths = {"crank": 60, "ground": 120, "coupler": 103.1970349892125, "rocker": 93.9646098959277}
    results = analysed(FOUR_BAR.format(speed=60, **lengths))
    summary = results.summary
    assert math.degrees(summary["link_swing.rocker"]) == pytest.approx(80, rel=1e-12)
    assert summary["time_ratio.rocker"] == pytest.approx(10 / 9, rel=1e-9)
    assert math.degrees(summary["transmission_angle_min.C"]) == pytest.approx(35.03832591706699, rel=1e-10)
    # with the crank along the ground: the law of cosines on 60 + 120 mm
    greatest = math.acos(
        (lengths["coupler"] ** 2 + lengths["rocker"] ** 2 - 180**2) / (2 * lengths["coupler"] * lengths["rocker"])
    )
    assert summary["transmission_angle_max.C"] == pytest.approx(greatest, rel=1e-12)
    # and with the crank across the ground
    across = analysed(FOUR_BAR.format(speed=60, **lengths), 90.0).columns["transmission_angle.C"][0]
    squares = lengths["coupler"] ** 2 + lengths["rocker"] ** 2 - 60**2 - 120**2
    expected = math.acos(squares / (2 * lengths["coupler"] * lengths["rocker"]))
    assert across == pytest.approx(expected, rel=1e-12)
    told = [one.values["angle"] for one in results.notices if one.code == "transmission"]
    assert told == pytest.approx([35.03832591706699])


def test_instant_centre_of_a_coupler():
    """Khurmi and Gupta, ex. 6.1, p. 126: 300, 360, 360 mm on 600 mm, crank at 60 degrees and 100 rev/min."""
    found = analysed(FOUR_BAR.format(crank=300, coupler=360, rocker=360, ground=600, speed=100), 60.0).columns
    x, y = (1e3 * float(found[f"instant_centre_{axis}.coupler"][0]) for axis in "xy")
    assert (x, y) == pytest.approx((399.1987158875422, 691.4324582334764), rel=1e-12)
    to_crankpin = math.dist((x, y), (1e3 * found["point_x.B"][0], 1e3 * found["point_y.B"][0]))
    assert to_crankpin == pytest.approx(500, rel=0.004)
    # the ratio of velocities by the centres
    assert abs(found["link_angular_velocity.coupler"][0]) == pytest.approx(6.283, rel=0.004)
    by_centres = 100 * math.tau / 60 * 300 / to_crankpin
    assert abs(found["link_angular_velocity.coupler"][0]) == pytest.approx(by_centres, rel=1e-12)


def test_torque_through_a_four_bar_with_losses():
    """Khurmi and Gupta, ex. 7.10, p. 162: the same linkage; 50 N m at 70 % hold a torque 1.17 times as large."""
    text = FOUR_BAR.format(crank=300, coupler=360, rocker=360, ground=600, speed=100)
    free = analysed(text, 60.0).columns
    assert free["point_velocity.C"][0] == pytest.approx(2.25, rel=0.01)
    assert free["point_velocity.C"][0] == pytest.approx(2.269219869902356, rel=1e-12)
    assert abs(free["link_angular_velocity.rocker"][0]) == pytest.approx(6.303388527506544, rel=1e-12)
    torque = -58.14636704042652 * math.copysign(1.0, free["link_angular_velocity.rocker"][0])
    load = f'\n[[loads]]\nkind = "torque"\nlink = "rocker"\ntorque = ["{torque!r} N*m"]\n[efficiency]\nchain = [0.7]\n'
    found = analysed(text + load, 60.0).columns
    assert found["driving_torque"][0] == pytest.approx(50, rel=1e-12)
    # printed 58.6 N m, from a velocity read off a drawing
    assert abs(torque) == pytest.approx(58.6, rel=0.01)


def test_pressure_angle_of_a_slider_crank_and_of_an_offset_one():
    """R. L. Norton, Design of Machinery, ch. 4: the sine is that of the crank over the rod, and of the offset."""
    text = """
        fixed_points.O = ["0 mm", "0 mm"]
        crank = { pivot = "O", pin = "A", radius = "50 mm", speed = "60 rpm" }
        links.rod = { joins = ["A", "B"], length = "200 mm" }
        guides.bed = { through = ["0 mm", "OFFSET"] }
        sliders.piston = { pin = "B", guide = "bed" }
    """
    central = analysed(text.replace("OFFSET", "0 mm"), 0.0, 30.0, 90.0)
    sines = [0.25 * math.sin(math.radians(one)) for one in (0, 30, 90)]
    assert [abs(math.sin(one)) for one in central.columns["pressure_angle.B"]] == pytest.approx(sines, abs=1e-14)
    assert central.summary["pressure_angle_max.B"] == pytest.approx(math.asin(0.25), rel=1e-12)
    # the same machine turned by 35 degrees
    turned = text.replace('"OFFSET"]', '"0 mm"], angle = "35 deg"')
    leaning = analysed(turned, 35.0, 65.0, 125.0)
    assert [abs(math.sin(one)) for one in leaning.columns["pressure_angle.B"]] == pytest.approx(sines, abs=1e-14)
    assert leaning.summary["pressure_angle_max.B"] == pytest.approx(math.asin(0.25), rel=1e-12)
    offset = analysed(text.replace("OFFSET", "30 mm")).summary
    assert offset["pressure_angle_max.B"] == pytest.approx(math.asin(80 / 200), rel=1e-12)
    assert offset["transmission_angle_min.B"] == pytest.approx(math.acos(80 / 200), rel=1e-12)
    # its ends are where crank and rod are in line
    assert offset["slider_displacement_max.piston"] == pytest.approx(math.sqrt(0.25**2 - 0.03**2), rel=1e-12)
    assert offset["slider_displacement_max_angle.piston"] == pytest.approx(math.asin(30 / 250), rel=1e-7)
