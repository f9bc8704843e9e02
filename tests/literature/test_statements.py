"""Data as textbooks state them: pounds of force, radii of gyration, one instant at rest; each by its own method."""

import math

import numpy as np
import pytest

from crankwork.errors import CrankworkError
from crankwork.report.notices import idle_texts
from crankwork.report.summary import summary_text
from each import for_each
from machine_texts import analysed

pytestmark = pytest.mark.elsewhere

GRAVITY, POUND, INCH = 9.80665, 0.45359237, 0.0254

BOOM = """
format = 2
fixed_points = { O = ["0 m", "0 m"], Q = ["1 m", "0 m"] }
links.boom = { joins = ["O", "B"], length = "2 m", points.C = ["1.2 m", "0 m"], mass = "200 kg", centre = 0.5 }
driver = { cylinder = ["Q", "C"], start = "0.9 m", velocity = "0 m/s" }
loads = [{ kind = "force", point = "B", y = "-5 kN" }]
method.weights = true
"""


def test_a_cylinder_holds_a_boom_that_stands_still() -> None:
    """Moments about the foot of the boom, whose inclination is that of a triangle of three sides."""
    results = analysed(BOOM)
    lean = math.acos((1.2**2 + 1 - 0.9**2) / (2 * 1.2))
    push = np.array([1.2 * math.cos(lean) - 1, 1.2 * math.sin(lean)]) / 0.9
    arm = 1.2 * (math.cos(lean) * push[1] - math.sin(lean) * push[0])
    force = (5000 * 2 + 200 * GRAVITY) * math.cos(lean) / arm
    assert results.value("driver_force", at=0) == pytest.approx(force, rel=1e-12)
    assert results.value("joint_force_x.O", at=0) == pytest.approx(-force * push[0], rel=1e-12)


@for_each("velocity", ["0 m/s", "0.1 m/s"])
def test_an_instant_is_told_by_its_values(velocity: str) -> None:
    """A travel, a largest value and its time over a moment that the program chose would be of nobody's machine."""
    results = analysed(BOOM.replace("0 m/s", velocity))
    assert results.summary == {}
    told = {line.split()[-1]: line.split()[-3] for line in summary_text(results).splitlines() if "_force" in line}
    assert float(told["driver_force"]) == pytest.approx(results.value("driver_force", at=0), rel=1e-5)


def test_a_spring_of_pounds_to_an_inch_and_a_link_of_a_radius_of_gyration() -> None:
    """A pendulum of 5 lb with k = 3 in, whose end a spring of 2 lb/in pulls down; torque by differences of energy."""
    results = analysed("""
fixed_points = { O = ["0 in", "0 in"], Q = ["3 in", "0 in"], W = ["3 in", "-9 in"] }
crank = { pivot = "O", pin = "A", radius = "2 in", speed = "20 rad/s" }
links.swing = { joins = ["Q", "B"], length = "8 in", mass = "5 lb", centre = 0.5, radius_of_gyration = "3 in" }
guides.slot.link = "swing"
sliders.block = { guide = "slot", pin = "A" }
loads = [{ kind = "spring", between = ["B", "W"], stiffness = "2 lb/in", free_length = "4 in" }]
method.weights = true
""")
    step = 1e-4
    angles = math.radians(70) + np.arange(-2, 3) * step
    turned = np.angle(2 * np.exp(1j * angles) - 3)
    end = 3 + 8 * np.exp(1j * turned)
    spring = 2 / 2 * (abs(end - (3 - 9j)) - 4) ** 2
    potential = (spring + 5 * 4 * np.sin(turned)) * POUND * GRAVITY * INCH
    reduced = 5 * POUND * (3**2 + 4**2) * INCH**2 * np.gradient(turned, step) ** 2
    torque = (potential[3] - potential[1]) / (2 * step) + (reduced[3] - reduced[1]) / (4 * step) * 20**2
    assert results.value("driving_torque", at=70) == pytest.approx(torque, rel=1e-6)


FOLLOWER = """
format = 2
fixed_points.O = ["0 mm", "0 mm"]
guides.line = { through = "O", angle = "90 deg" }
sliders.follower = { guide = "line", mass = "0.4 kg" }
driver.slider = "follower"
driver.start = "10 mm"
driver.law = [{ kind = "cycloidal", to = "40 mm", over = "0.1 s" }, { kind = "dwell", over = "0.05 s" }]
loads = [{ kind = "spring", slider = "follower", stiffness = "5 N/mm", free_length = "-10 mm" }]
"""


def test_a_spring_of_a_follower_is_free_below_its_origin() -> None:
    """A cycloid rises with an acceleration of 2 pi h sin(2 pi t / T) / T2; the spring is pressed by 10 mm more."""
    results = analysed(FOLLOWER)
    for time in (0.02, 0.07):
        turn = 2 * math.pi * time / 0.1
        rise = 0.01 + 0.03 * (turn - math.sin(turn)) / (2 * math.pi)
        force = 0.4 * 0.03 / 0.1**2 * 2 * math.pi * math.sin(turn) + 5000 * (rise + 0.01)
        assert results.value("driver_force", at=time) == pytest.approx(force, rel=1e-12)


@for_each(("begins", "told"), [
    ("0 mm", "loads[1].at[1]: the force is zero on both sides of it"),
    ("-5 mm", "loads[1].at[1]: beyond the travel of the sliding piece, 0 to 30 mm"),
])  # fmt: skip
def test_a_table_that_begins_with_no_force_is_told_why_its_beginning_has_no_effect(begins: str, told: str) -> None:
    """The table counts from where the working stroke begins, 10 mm from the origin of the guide."""
    law = FOLLOWER.partition("loads")[0]
    load = f'at = ["{begins}", "20 mm", "50 mm"], force = ["0 N", "0 N", "9 N"]'
    results = analysed(f'{law}loads = [{{ kind = "process", slider = "follower", {load} }}]')
    assert idle_texts(results, "en")[0] == told


CRANK = """
format = 2
fixed_points.O = ["0 m", "0 m"]
crank = { pivot = "O", pin = "A", radius = "1 m", speed = "1 rpm" }
"""


@for_each(("text", "told"), [
    (CRANK.replace("1 rpm", "-10 rad/s"), ('crank.speed: "-10 rad/s" is below zero; write the speed without its sign, '
                                           'and direction = "clockwise" if it turns so')),
    (CRANK.replace('["0 m", "0 m"]', '["0 m",0]'), ('fixed_points.O[2]: 0 has no unit; write it as text with a unit, '
                                                    'for example "0 mm" or "0 m"')),
    (CRANK + 'links.lever = { joins = ["O", "B"], length = "2 m", points.M = 0.5 }',
     'links.lever.points.M: must be a list in square brackets, like ["30 mm", "30 mm"]'),
    (CRANK + 'links.lever = { joins = ["O", "B"], length = "2 m" }\nguides.slot = { link = "lever", through = "B" }',
     ('guides.slot.through: B is no place on a guide that lever carries; give [along, across] from the first joint of '
      'lever, such as ["50 mm", "0 mm"]')),
])  # fmt: skip
def test_a_statement_that_cannot_be_read_is_told_with_what_to_write(text: str, told: str) -> None:
    with pytest.raises(CrankworkError) as refused:
        analysed(text)
    assert [line.split(": ", 1)[1] for line in str(refused.value).splitlines()] == [told]


def test_a_length_between_two_points_is_not_below_zero() -> None:
    spring = 'kind = "spring", between = ["A", "W"], stiffness = "8 N/m", free_length = "-3 mm"'
    with pytest.raises(CrankworkError, match=r"loads\[1\]\.free_length: is a length between two points"):
        analysed(f'{CRANK}fixed_points.W = ["9 m", "0 m"]\nloads = [{{ {spring} }}]')


def test_a_list_of_zeros_has_no_decimal_comma() -> None:
    with pytest.raises(CrankworkError) as refused:
        analysed(CRANK.replace('["0 m", "0 m"]', "[0,0]"))
    assert "comma" not in str(refused.value)
