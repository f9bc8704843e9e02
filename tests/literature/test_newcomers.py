"""Problems as textbooks set them, entered as a newcomer would; each against a method that crankwork does not use.

The stepped shaft of two flywheels is example 24.14 of R. S. Khurmi, J. K. Gupta: Theory of Machines, S. Chand, New
Delhi 2005, which prints 3.37 Hz and a node 0.855 m from the first flywheel. All others are worked here.
"""

import math
from pathlib import Path

import numpy as np
import pytest

from crankwork import Description, solve
from crankwork.description.shorthand import expanded
from crankwork.errors import CrankworkError
from crankwork.note.explain import explanation
from crankwork.report.notices import assumption_texts
from crankwork.report.summary import values_text
from each import for_each
from machine_texts import analysed

pytestmark = pytest.mark.elsewhere

RPM = math.pi / 30
LBF, INCH, FOOT, POUND = 4.4482216152605, 0.0254, 0.3048, 0.45359237
PSI, SLUG = LBF / INCH**2, LBF / FOOT

CELL = """
format = 2
fixed_points = { O = ["0 mm", "0 mm"], Q = ["50 mm", "0 mm"] }
crank = { pivot = "Q", pin = "A", radius = "50 mm", speed = "10 rpm" }
positions = { C = ["170 mm", "96 mm"], D = ["170 mm", "-96 mm"], P = ["240 mm", "0 mm"] }
[links]
oc = { joins = ["O", "C"], length = "200 mm" }
od = { joins = ["O", "D"], length = "200 mm" }
ac = { joins = ["A", "C"], length = "120 mm" }
ad = { joins = ["A", "D"], length = "120 mm" }
cp = { joins = ["C", "P"], length = "120 mm" }
dp = { joins = ["D", "P"], length = "120 mm" }
"""


def test_peaucelliers_cell_runs_straight_between_two_dead_positions() -> None:
    """Both rhombus dyads die together, where the distance of O and A is 200 less 120 mm, at 2 arccos 0.8."""
    results = analysed(CELL)
    reach = math.degrees(2 * math.acos(0.8))
    assert math.degrees(results["crank_range_start"]) == pytest.approx(-reach, abs=1e-6)
    assert math.degrees(results["crank_range_end"]) == pytest.approx(reach, abs=1e-6)
    assert results["point_x.P"] == pytest.approx((0.2**2 - 0.12**2) / 0.1, rel=1e-11)
    # and a value is told at angles before zero too
    height = (0.2**2 - 0.12**2) / 0.1 * math.tan(math.radians(-15))
    assert results.value("point_y.P", at=-30) == pytest.approx(height, rel=1e-11)


def test_a_stepped_shaft_of_two_flywheels_as_printed() -> None:
    results = analysed("""
[torsion]
modulus = "80 GPa"
[torsion.discs]
A = { mass = "900 kg", radius_of_gyration = "0.85 m" }
B = { mass = "700 kg", radius_of_gyration = "0.55 m" }
[torsion.shafts.steel]
between = ["A", "B"]
parts = [
    { length = "0.6 m", diameter = "95 mm" },
    { length = "0.5 m", diameter = "60 mm" },
    { length = "0.4 m", diameter = "50 mm" },
]
""")
    assert results["natural_frequency.1"] / (2 * math.pi) == pytest.approx(3.37, abs=0.005)
    (node,) = (value for key, value in results.summary.items() if key.startswith("node_distance"))
    assert node == pytest.approx(0.855, abs=0.0005)


@for_each("start", ['"0 deg"', '"0 s"', '"1.5 s"'])
def test_a_riveting_machine_slows_down(start: str) -> None:
    """10 kJ in one second of every 10/3 s, with 3 kW that refill: what is missing comes from 54 kg m2."""
    results = analysed(f"""
format = 2
crank.largest_speed = "300 rpm"
load.period = "3.33333333333333 s"
load.strokes = [{{ work = "10 kJ", from = {start}, over = "1 s" }}]
flywheel = {{ mass = "150 kg", radius_of_gyration = "0.6 m" }}
""")
    least = math.sqrt((300 * RPM) ** 2 - 2 * 7000 / 54)
    assert results["crank_speed_min"] == pytest.approx(least, rel=1e-9)
    assert results["shaft_power"] == pytest.approx(3000, rel=1e-9)


def test_an_offset_needs_no_bore() -> None:
    results = analysed("""
format = 2
crank = { radius = "50 mm", speed = "120 rpm" }
rod.length = "150 mm"
cylinder.offset = "25 mm"
""")
    outer, inner = (math.sqrt(reach**2 - 0.025**2) for reach in (0.2, 0.1))
    assert results["stroke"] == pytest.approx(outer - inner, rel=1e-12)
    slow = 180 + math.degrees(math.asin(0.025 / 0.1) - math.asin(0.025 / 0.2))
    assert results["time_ratio.piston"] == pytest.approx(slow / (360 - slow), rel=1e-9)


@for_each("layout", ['layout = "V"\ncylinders = 2\nbank_angle = "90 deg"', 'layout = "radial"\ncylinders = 5'])
def test_an_engine_without_gas_has_no_excess_work(layout: str) -> None:
    """Gas does none; what is left is rounding and no work."""
    results = analysed(f"""
crank = {{ radius = "75 mm", speed = "500 rpm" }}
rod.length = "350 mm"
piston.mass = "11.5 kg"
[engine]
{layout}
""")
    assert results["excess_work"] == 0


def test_forces_of_a_v_twin_by_fourier() -> None:
    """First and second order of the exact acceleration of both pistons, by the sums of samples."""
    results = analysed("""
crank = { radius = "75 mm", speed = "500 rpm" }
rod.length = "350 mm"
piston.mass = "11.5 kg"
[engine]
layout = "V"
cylinders = 2
bank_angle = "90 deg"
""")
    angles = np.linspace(0, 2 * math.pi, 4096, endpoint=False)
    pin, rod = 0.075 * np.exp(1j * angles), 0.35
    reach = pin.real + np.sqrt(rod**2 - pin.imag**2)
    orders = 2 * np.fft.rfft(reach)[1:3].real / angles.size * np.array([1, 4]) * (500 * RPM) ** 2 * 11.5
    assert results["free_force.reciprocating.1"] == pytest.approx(abs(orders[0]), rel=1e-9)
    assert results["free_force.reciprocating.2"] == pytest.approx(abs(orders[1]) * math.sqrt(2), rel=1e-9)


def test_a_follower_rises_by_a_cosine_and_comes_back_by_parabolas() -> None:
    """A slider alone, with a mass and no pin: force is mass times acceleration."""
    results = analysed("""
format = 2
[driver]
slider = "follower"
start = "0 mm"
period = "0.24 s"
law = [
    { kind = "harmonic", to = "40 mm", over = 0.25 },
    { kind = "dwell", over = 0.25 },
    { kind = "parabolic", to = "0 mm", over = 0.25 },
    { kind = "dwell", over = 0.25 },
]
[guides]
line.angle = "90 deg"
line.through = ["0 mm", "0 mm"]
[sliders]
follower = { guide = "line", mass = "2 kg" }
""")
    rise = 0.02 * (math.pi / 0.06) ** 2
    assert results["driver_velocity_max"] == pytest.approx(0.02 * math.pi / 0.06, rel=1e-9)
    assert results["driver_velocity_min"] == pytest.approx(-2 * 0.04 / 0.06, rel=1e-9)
    assert results["driver_force_max"] == pytest.approx(2 * max(rise, 4 * 0.04 / 0.06**2), rel=1e-9)


WILLANS = """
format = 2
crank = { stroke = "120 mm", speed = "1500 rpm" }
cylinder.bore = "100 mm"
[test]
cylinders = 4
load_powers = ["10 kW", "20 kW", "30 kW", "40 kW"]
load_fuel_rates = ["4 kg/h", "6.1 kg/h", "8 kg/h", "10.1 kg/h"]
effective_power = "40 kW"
"""


def test_losses_by_the_line_of_willans() -> None:
    results = analysed(WILLANS)
    slope, idle = np.polyfit([10, 20, 30, 40], [4, 6.1, 8, 10.1], 1)
    assert results["load_fuel_slope"] * 3.6e9 == pytest.approx(1000 * slope, rel=1e-9)
    assert results["idle_fuel_rate"] * 3600 == pytest.approx(idle, rel=1e-9)
    assert results["mechanical_efficiency"] == pytest.approx(40 / (40 + idle / slope), rel=1e-9)


def test_a_measured_indicated_power_is_not_overruled_by_the_line() -> None:
    results = analysed(WILLANS + 'indicated_power = "52 kW"\n')
    assert results["mechanical_loss_power"] == pytest.approx(12e3)
    assert results["willans_loss_power"] == pytest.approx(9900.990099, rel=1e-9)


@for_each(
    "rates",
    [
        '"4 kg/h", "6 kg/h", "8 kg/h"',
        '"10 kg/h", "8 kg/h", "6 kg/h", "4 kg/h"',
        '"1 kg/h", "3 kg/h", "5 kg/h", "7 kg/h"',
    ],
)
def test_fuel_without_a_line_is_refused(rates: str) -> None:
    with pytest.raises(CrankworkError, match=r"must rise|write 4 of them"):
        analysed(WILLANS.replace('"4 kg/h", "6.1 kg/h", "8 kg/h", "10.1 kg/h"', rates))


def test_a_torque_by_the_pressure_of_one_position_needs_no_speed() -> None:
    """0.6 MPa on 120 mm at 45 degrees past the inner dead centre; arm r (sin q + sin 2q / 2 sqrt(n2 - sin2 q))."""
    results = analysed("""
crank.radius = "100 mm"
rod.length = "400 mm"
cylinder.bore = "120 mm"
gas.pressure = "0.6 N/mm2"
""")
    force = 0.6e6 * math.pi / 4 * 0.12**2
    arm = 0.1 * (math.sin(math.pi / 4) + 1 / (2 * math.sqrt(16 - 0.5)))
    assert results.value("crank_torque", at=45) == pytest.approx(force * arm, rel=1e-12)
    assert [text for text in assumption_texts(results, "en") if "crank.speed = 1 rad/s" in text]


@for_each("mass", ["piston.mass", "rod.mass", "crank.mass"])
def test_a_mass_needs_a_speed(mass: str) -> None:
    with pytest.raises(CrankworkError, match=r"crank\.speed: is missing"):
        analysed(f"""
crank.radius = "100 mm"
rod.length = "400 mm"
cylinder.bore = "120 mm"
gas.pressure = "0.6 N/mm2"
{mass} = "2 kg"
""")


def test_weight_and_inertia_take_from_the_pressure_at_an_instant() -> None:
    """700 kN/m2 on 100 mm, 1.1 kg, 20 degrees past the upper dead centre: by the exact acceleration of a cosine rod."""
    results = analysed("""
crank = { stroke = "120 mm", speed = "2000 rpm" }
rod.length = "250 mm"
piston.mass = "1.1 kg"
cylinder = { bore = "100 mm", inclination = "0 deg" }
gas.pressure = "700 kN/m2"
method.weights = true
""")
    angles = math.radians(20) + np.array([-1, 0, 1]) * 1e-4
    reach = 0.06 * np.cos(angles) + np.sqrt(0.25**2 - (0.06 * np.sin(angles)) ** 2)
    inertia = 1.1 * (reach[2] - 2 * reach[1] + reach[0]) / 1e-8 * (2000 * RPM) ** 2
    force = 700e3 * math.pi / 4 * 0.1**2 + inertia + 1.1 * 9.80665
    assert results.value("piston_force", at=20) == pytest.approx(force, rel=1e-6)


FORCED = """
fixed_points = { O2 = ["0 in", "0 in"], O4 = ["8 in", "0 in"] }
crank = { pivot = "O2", pin = "A", radius = "6 in" }
[links]
coupler = { joins = ["A", "B"], length = "18 in" }
rocker = { joins = ["O4", "B"], length = "12 in", points = { Q = ["5 in", "0 in"] } }
"""


@for_each("pull", ['force = "120 lbf"\nangle = "220 deg"', 'x = "-91.925333 lbf"\ny = "-77.134513 lbf"'])
def test_a_force_in_a_direction_is_held_by_the_crank(pull: str) -> None:
    """The coupler has two forces alone, along it; its moment about the pivot of the rocker is that of the load."""
    results = analysed(FORCED + f'[[loads]]\nkind = "force"\npoint = "Q"\n{pull}\n')
    pin = 6 * np.exp(0.75j * math.pi)
    line = 8 - pin
    along = (18**2 - 12**2 + abs(line) ** 2) / (2 * abs(line))
    joint = pin + line / abs(line) * (along + 1j * math.sqrt(18**2 - along**2))
    rod, load = (joint - pin) / 18, 120 * np.exp(1j * math.radians(220))
    held = -((joint - 8).conjugate() * 5 / 12 * load).imag / ((joint - 8).conjugate() * rod).imag
    torque = (pin.conjugate() * held * rod).imag * LBF * INCH
    assert results.value("driving_torque", at=135) == pytest.approx(torque, rel=1e-7)
    assert "Q_x,Q = Q_Q·cos θ" in explanation(results, "driving_torque", at=135) or pull.startswith("x")


LADDER = """
guides = { floor = { through = ["0 m", "0 m"] }, wall = { through = ["0 m", "0 m"], angle = "90 deg" } }
links.ladder = { joins = ["A", "B"], length = "3 m" }
sliders = { foot = { pin = "A", guide = "floor" }, head = { pin = "B", guide = "wall" } }
driver = { slider = "foot", start = "1.5 m", velocity = "2 m/s", acceleration = "1 m/s2" }
"""


def test_a_ladder_slips_at_an_instant() -> None:
    """x2 + y2 = 9 differentiated twice."""
    results = analysed(LADDER)
    height = math.sqrt(9 - 1.5**2)
    falls = -1.5 * 2 / height
    assert results.value("slider_velocity.head", at=0) == pytest.approx(falls, rel=1e-12)
    change = -(2**2 + 1.5 * 1 + falls**2) / height
    assert results.value("slider_acceleration.head", at=0) == pytest.approx(change, rel=1e-7)
    assert results.value("link_angular_velocity.ladder", at=0) == pytest.approx(2 / height, rel=1e-12)


@for_each(("old", "new", "told"), [
    ("2 m/s", "2 rad/s", r"driver\.velocity: this driver moves along a line"),
    ("1 m/s2", "1 rad/s2", r"driver\.acceleration: this driver moves along a line"),
    ('start = "1.5 m", ', "", r"driver\.start: the law begins nowhere"),
])  # fmt: skip
def test_an_instant_is_a_position_and_its_rates(old: str, new: str, told: str) -> None:
    with pytest.raises(CrankworkError, match=told):
        analysed(LADDER.replace(old, new))


def test_all_values_of_an_instant_are_told_with_their_keys() -> None:
    """A piston of 4 in at 100 psi: 1256.6 lbf; the side force of a rod at asin(3 sin 60 / 8)."""
    results = analysed("""
units = "imperial"
crank.radius = "3 in"
rod.length = "8 in"
cylinder.bore = "4 in"
gas.pressure = "100 psi"
""")
    told = {line.split()[-1]: line.split()[-3:-1] for line in values_text(results, 60).splitlines()}
    lean = math.asin(3 * math.sin(math.pi / 3) / 8)
    assert told["gas_force"] == ["1256.64", "lbf"]
    assert told["side_force"] == [f"{400 * math.pi * math.tan(lean):.6g}", "lbf"]
    assert told["point_velocity_x.B"][0] == "0"
    with pytest.raises(CrankworkError, match="no crank angle of 400 deg"):
        values_text(analysed('crank = { radius = "1 m", speed = "9 rpm" }\nrod.ratio = 0.2'), 400)


PUMP = """
format = 2
crank = { stroke = "300 mm", speed = "20 rpm" }
rod.length = "90 m"
cylinder.bore = "200 mm"
[gas]
pressures = "absolute"
cycle = "360 deg"
ambient = "10.3 mH2O"
[gas.valves]
density = "1000 kg/m3"
suction_height = "3 m"
discharge_height = "20 m"
vapour_pressure = "2.5 mH2O"
suction_pipe = { length = "8 m", diameter = "100 mm", friction = 0.04 }
discharge_pipe = { length = "25 m", diameter = "100 mm", friction = 0.04 }
"""


@for_each("written", ["as a crank gear", "as a linkage"])
def test_a_pump_with_pipes_does_the_work_of_their_friction(written: str, tmp_path: Path) -> None:
    """With a long rod the plunger moves as a cosine: heads of 23 m, and two thirds of the greatest friction."""
    file = tmp_path / "pump.toml"
    file.write_text(PUMP, encoding="utf-8")
    results = analysed(PUMP if written == "as a crank gear" else expanded(file))
    gravity, area, speed = 9.80665, math.pi / 4 * 0.2**2, 20 * RPM
    fastest = 4 * speed * 0.15
    friction = 0.04 * (8 + 25) / 0.1 * fastest**2 / (2 * gravity)
    work = 1000 * gravity * area * 0.3 * (23 + 2 / 3 * friction)
    assert results["mean_torque"] * 2 * math.pi == pytest.approx(work, rel=1e-4)
    begins = 8 / gravity * 4 * speed**2 * 0.15
    assert results["acceleration_head.cylinder.suction"] == pytest.approx(begins, rel=2e-3)
    # half-way there is no acceleration, and the pressure is that of the suction less all friction of its pipe
    suction = (10.3 - 3) - friction * 8 / 33
    head = results.value("gas_pressure.cylinder", at=90) / (1000 * gravity) + 10.3
    assert head == pytest.approx(suction, rel=2e-3)
    # the forces of an engine, which has no pipes, would be others
    assert "piston_force" not in results.complete.columns


def test_a_pump_of_three_throws_does_three_times_the_work() -> None:
    throws = '[engine]\nlayout = "inline"\ncylinders = 3\nfiring_order = "1-2-3"\n[gas]'
    results = analysed(PUMP.replace("[gas]", throws))
    assert results["mean_torque"] == pytest.approx(3 * analysed(PUMP)["mean_torque"], rel=1e-12)


GEAR = """
crank = { radius = "50 mm", speed = "600 rpm" }
rod.ratio = 0.25
cylinder.bore = "100 mm"
"""
INSTANT = LADDER.replace("1.5 m", "4 m")
HEAD = PUMP.replace('discharge_height = "20 m"', 'discharge_height = "-20 m"')
PUSHED = FORCED + '[[loads]]\nkind = "force"\npoint = "Q"\n'


@for_each(("text", "told"), [
    (f'{GEAR}gas.pressure = "2"', 'gas.pressure: "2" has no unit; write it like "2 MPa"'),
    (f'{GEAR}gas.strokes = "table.csv"\ngas.cycle = "360 deg"',
     "gas.strokes: must be a table; put its keys below a line [gas.strokes]"),
    (f'{GEAR}gas = {{ pressure = "-1 bar", pressures = "absolute" }}',
     'gas.pressure: is below vacuum; write it above zero, or pressures = "gauge"'),
    (f"{PUSHED}force = 120\nangle = \"220 deg\"",
     'loads[1].force: 120 has no unit; write it as text with a unit, for example "120 N"'),
    (f'{PUSHED}x = "1 N"\ny = "1 N"\nangle = "9 deg"',
     'loads[1].angle: says nothing without force; add force = "30 N", or leave it out'),
    (INSTANT, ("driver.velocity: ladder, head cannot be assembled, or are in a dead position, with the driver at "
               "4000 mm, which its law passes; keep the law within what the links reach, or change a length")),
    (HEAD, ("gas.valves.discharge_height: does not lie above the pressure of the suction; write the larger one as "
            "discharge, the smaller one as suction")),
])  # fmt: skip
def test_one_mistake_is_told_once_with_its_fix(text: str, told: str) -> None:
    with pytest.raises(CrankworkError) as refused:
        analysed(text)
    assert [line.split(": ", 1)[1] for line in str(refused.value).splitlines()] == [told]


def test_a_point_of_the_coupler_by_its_distance_and_direction() -> None:
    """7.5 in at 30 degrees from the line of the joints; the pivot of the rocker by distance and direction too."""
    results = analysed("""
fixed_points = { O2 = ["0 in", "0 in"], O4 = ["10 in", "-20 deg"] }
crank = { pivot = "O2", pin = "A", radius = "5 in" }
[links]
coupler = { joins = ["A", "B"], length = "8.5 in", points = { P = ["7.5 in", "30 deg"] } }
rocker = { joins = ["O4", "B"], length = "7 in" }
""")
    pin, pivot = 5 * np.exp(1j * math.pi / 3), 10 * np.exp(-1j * math.pi / 9)
    line = pivot - pin
    along = (8.5**2 - 7**2 + abs(line) ** 2) / (2 * abs(line))
    joint = pin + line / abs(line) * (along + 1j * math.sqrt(8.5**2 - along**2))
    point = (pin + (joint - pin) / 8.5 * 7.5 * np.exp(1j * math.pi / 6)) * INCH
    assert results.value("point_x.P", at=60) == pytest.approx(point.real, rel=1e-12)
    assert results.value("point_y.P", at=60) == pytest.approx(point.imag, rel=1e-12)


def test_a_clutch_of_a_power_is_pressed_by_its_torque() -> None:
    """20 kW at 1575 rpm over four faces of 240 and 120 mm, worn evenly."""
    results = analysed("""
[clutch]
faces = 4
friction = 0.3
outer_diameter = "240 mm"
inner_diameter = "120 mm"
power = "20 kW"
driving.speed = "1575 rpm"
""")
    force = 20e3 / (1575 * RPM) / (4 * 0.3 * 0.09)
    assert results["clutch_force"] == pytest.approx(force, rel=1e-12)
    assert results["clutch_pressure"] == pytest.approx(force / (2 * math.pi * 0.06 * 0.06), rel=1e-12)


def test_a_four_bar_with_centres_by_distance_and_direction_has_the_torque_of_energy() -> None:
    """Lengths, masses and accelerations as in R. L. Norton, Design of machinery, ch. 11; by differences of energy."""
    results = analysed("""
fixed_points = { O2 = ["0 in", "0 in"], O4 = ["19 in", "0 in"] }
[crank]
pivot = "O2"
pin = "A"
radius = "5 in"
speed = "25 rad/s"
angular_acceleration = "-40 rad/s2"
mass = "1.5 lb"
centre = ["3 in", "30 deg"]
inertia = "0.4 lb-in-s2"
inertia_about = "centre"
[links.coupler]
joins = ["A", "B"]
length = "15 in"
mass = "7.7 lb"
inertia = "1.5 lb-in-s2"
centre = ["9 in", "45 deg"]
[links.rocker]
joins = ["O4", "B"]
length = "10 in"
mass = "5.8 lb"
inertia = "0.8 lb-in-s2"
centre = ["5 in", "0 deg"]
""")
    unit = LBF * INCH
    masses, inertias = np.array([1.5, 7.7, 5.8]) * 0.45359237, np.array([0.4, 1.5, 0.8]) * unit
    step = 1e-4
    angles = math.pi / 3 + np.arange(-2, 3) * step
    pin = 5 * np.exp(1j * angles)
    line = 19 - pin
    along = (15**2 - 10**2 + abs(line) ** 2) / (2 * abs(line))
    joint = pin + line / abs(line) * (along + 1j * np.sqrt(15**2 - along**2))
    rod, swing = (joint - pin) / 15, (joint - 19) / 10
    centres = [3 * np.exp(1j * (angles + math.pi / 6)), pin + 9 * rod * np.exp(0.25j * math.pi), 19 + 5 * swing]
    turned = [angles, np.unwrap(np.angle(rod)), np.unwrap(np.angle(swing))]
    slopes = (
        [abs(np.gradient(np.array(place), step)) * INCH for place in centres],
        [np.gradient(angle, step) for angle in turned],
    )
    reduced = sum(m * place**2 + j * angle**2 for m, j, place, angle in zip(masses, inertias, *slopes, strict=True))
    torque = reduced[2] * -40 + (reduced[3] - reduced[1]) / (2 * step) / 2 * 25**2
    assert results.value("driving_torque", at=60) == pytest.approx(torque, rel=1e-5)


HEAT_BALANCE = """
crank = { stroke = "4.5 in", speed = "2000 rpm" }
cylinder.bore = "3.75 in"
[test]
cylinders = 6
brake_load = "95 lbf"
brake_arm = "21 in"
fuel_rate = "31 lb/h"
fuel_heating_value = "18500 Btu/lb"
coolant_rate = "60 lb/min"
coolant_heat = "1 Btu/(lb*°F)"
coolant_rise = "22 °F"
"""


@for_each("rise", ["22 °F", "22 degF", "22 R", "12.222222222222 °C", "12.222222222222 degC", "12.222222222222 K"])
def test_a_rise_of_temperature_has_no_zero(rise: str) -> None:
    """60 lb of water a minute, each warmed by 22 degrees: 1320 Btu a minute."""
    results = analysed(HEAT_BALANCE.replace("22 °F", rise))
    assert results["heat_to_coolant"] == pytest.approx(1320 * 1055.05585262 / 60, rel=1e-8)
    assert results["heat_share.to_coolant"] == pytest.approx(1320 * 60 / (31 * 18500), rel=1e-8)


def test_a_rise_that_is_sought_is_told_between_ends_in_any_degrees() -> None:
    description = Description(HEAT_BALANCE)
    limits = ("5 °C", "36 °F")
    (root,) = solve(description, "heat_share.to_coolant = 0.1", "test.coolant_rise", limits=limits).roots
    assert root.at == pytest.approx(0.1 * 31 * 18500 / 3600 * 5 / 9, rel=1e-6)


def test_two_stages_in_british_units() -> None:
    """Work of polytropes, sizes by what clearance leaves, and the water that takes the heat of the cooler."""
    results = analysed("""
units = "imperial"
crank.speed = "200 rpm"
[stages]
count = 2
suction = "14.5 psi"
between = "48 psi"
discharge = "150 psi"
exponent = [1.3, 1.25]
temperature = "70 °F"
temperatures = ["90 °F"]
clearance = [0.05, 0.06]
free_flow = "500 ft3/min"
free_pressure = "14.7 psi"
free_temperature = "60 °F"
stroke_bore_ratio = 0.9
sides = 2
gas_constant = "53.34 ft-lbf/(lbm-°R)"
heat_capacity = "0.24 Btu/(lb*°F)"
water_heat_capacity = "1 Btu/(lb*°F)"
water_rise = "15 °F"
""")
    gas, zero = 53.34, 459.67
    mass = 14.7 * 144 * 500 / (gas * (60 + zero))  # pounds a minute
    works = [
        exponent / (exponent - 1) * gas * (cold + zero) * (ratio ** (1 - 1 / exponent) - 1)
        for exponent, cold, ratio in ((1.3, 70, 48 / 14.5), (1.25, 90, 150 / 48))
    ]
    assert results["stage_power"] == pytest.approx(mass * sum(works) * FOOT * LBF / 60, rel=1e-9)
    swept = [
        mass * gas * (cold + zero) / (144 * pressure) / (1 + share - share * ratio ** (1 / exponent)) / 400
        for cold, pressure, share, ratio, exponent in (
            (70, 14.5, 0.05, 48 / 14.5, 1.3),
            (90, 48, 0.06, 150 / 48, 1.25),
        )
    ]
    bore = (swept[0] / (math.pi / 4 * 0.9)) ** (1 / 3)
    assert results["bore.1"] == pytest.approx(bore * FOOT, rel=1e-9)
    assert results["bore.2"] == pytest.approx(math.sqrt(swept[1] / (math.pi / 4 * 0.9 * bore)) * FOOT, rel=1e-9)
    cooled = (70 + zero) * (48 / 14.5) ** (0.3 / 1.3) - (90 + zero)
    assert results["water_flow"] == pytest.approx(mass * 0.24 * cooled / 15 * POUND / 60, rel=1e-9)


PRESS = """
crank.largest_speed = "250 rpm"
load.period = "2 s"
[[load.strokes]]
shear_strength = "50 ksi"
hole_diameter = "1 in"
thickness = "5/8 in"
penetration = "1/2"
from = "0 s"
over = "0.4 s"
[flywheel]
radius_of_gyration = "18 in"
"""


@for_each("wanted", ["percent = 5", 'fluctuation = "1/10"'])
def test_a_press_begins_at_its_largest_speed(wanted: str) -> None:
    """Half of 50 ksi times the sheared area times the thickness; four fifths come from the flywheel."""
    results = analysed(PRESS + wanted)
    work = 0.5 * 50e3 * PSI * math.pi * INCH * (0.625 * INCH) ** 2
    mean = 250 * RPM / 1.05
    assert results["crank_speed_max"] == pytest.approx(250 * RPM, rel=1e-9)
    assert results["crank_speed_min"] == pytest.approx(mean * 0.95, rel=1e-9)
    assert results["flywheel_mass"] == pytest.approx(0.8 * work / (0.1 * mean**2) / (18 * INCH) ** 2, rel=1e-9)
    assert "crank.largest_speed" in explanation(results, "speed")


def test_the_speeds_of_a_press_before_and_after_its_stroke() -> None:
    results = analysed(PRESS.replace('crank.largest_speed = "250 rpm"', "") + 'speeds = ["250 rpm", "225 rpm"]')
    lost = 0.8 * 0.5 * 50e3 * PSI * math.pi * INCH * (0.625 * INCH) ** 2
    inertia = 2 * lost / ((250 * RPM) ** 2 - (225 * RPM) ** 2)
    assert results["flywheel_inertia"] == pytest.approx(inertia, rel=1e-9)


@for_each(("wanted", "told"), [
    ('speeds = ["250 rpm", "225 rpm"]', r"largest_speed: is the first of flywheel\.speeds already"),
    ("", r"says nothing without the flywheel; .* percent or fluctuation"),
])  # fmt: skip
def test_a_largest_speed_is_stated_once_and_has_a_flywheel(wanted: str, told: str) -> None:
    with pytest.raises(CrankworkError, match=told):
        analysed(PRESS + wanted)


@for_each("mechanism", ['rod.length = "10 in"', FORCED.partition("crank")[0]])
def test_one_load_of_a_mechanism_is_a_list_too(mechanism: str) -> None:
    with pytest.raises(CrankworkError, match=r"load: unknown table; did you mean \[\[loads\]\]") as told:
        analysed(f'{mechanism}\ncrank = {{ radius = "3 in" }}\n[load]\nkind = "force"\npoint = "B"\nforce = "1 lbf"')
    assert "crank.radius" not in str(told.value)


@for_each("clearance", ["", 'cylinder.clearance_volume = "0 in3"'])
def test_a_compressor_without_clearance(clearance: str) -> None:
    """All of the stroke is drawn in; the piston and its 3 slug turn the crank by the rate of its way."""
    results = analysed(f"""
crank = {{ stroke = "10 in", speed = "150 rpm" }}
rod.length = "25 in"
piston.mass = "3 slug"
cylinder.bore = "12 in"
{clearance}
[gas]
pressures = "absolute"
cycle = "360 deg"
ambient = "14.7 psi"
[gas.valves]
suction = "14.7 psi"
discharge = "60 psi"
compression_exponent = 1.35
expansion_exponent = 1.2
""")
    area, low, high, speed = math.pi * (6 * INCH) ** 2, 14.7 * PSI, 60 * PSI, 150 * RPM
    work = 1.35 / 0.35 * low * area * 10 * INCH * ((high / low) ** (0.35 / 1.35) - 1)
    assert results["indicated_power"] == pytest.approx(-work * 2.5, rel=1e-9)
    angles, step = math.radians(250) + np.array([-1, 0, 1]) * 1e-4, 1e-4
    way = (30 - 5 * np.cos(angles) - np.sqrt(25**2 - (5 * np.sin(angles)) ** 2)) * INCH
    rate, bend = (way[2] - way[0]) / (2 * step), (way[2] - 2 * way[1] + way[0]) / step**2
    pressure = low * (10 * INCH / way[1]) ** 1.35 - low
    torque = -(pressure * area - 3 * SLUG * bend * speed**2) * rate
    assert results.value("driving_torque", at=250) == pytest.approx(torque, rel=1e-6)


def test_the_speed_of_a_crank_by_that_of_a_rocker_far_from_what_the_file_states() -> None:
    """Lengths of 2, 8, 7 and 7 in; angular velocities have the ratio of the distances of the instant centre."""
    description = Description("""
fixed_points = { O = ["0 in", "0 in"], E = ["7 in", "0 in"] }
crank = { pivot = "O", pin = "A", radius = "2 in", speed = "10 rpm" }
links.left = { joins = ["A", "C"], length = "8 in" }
links.right = { joins = ["E", "C"], length = "7 in" }
""")
    (root,) = solve(description, "link_angular_velocity.right@60deg = 3 rad/s", "crank.speed", steps=50).roots
    pin = 2 * np.exp(1j * math.pi / 3)
    line = 7 - pin
    along = (8**2 - 7**2 + abs(line) ** 2) / (2 * abs(line))
    joint = pin + line / abs(line) * (along + 1j * math.sqrt(8**2 - along**2))
    centre = pin.real - pin.imag * (joint - pin).real / (joint - pin).imag
    assert root.at == pytest.approx(3 * (centre - 7) / centre, rel=1e-9)


def test_a_double_acting_pump_with_a_vessel() -> None:
    """A rod of 325 ft makes cosines; the vessel takes what both sides give above their mean."""
    valves = 'pressures = "absolute"\nambient = "14.7 psi"\ncompression_ratio = 20\nbore = "8 in"\n'
    valves += 'slider = "piston"\nvalves = { density = "1.94 slug/ft3", suction = "10 psi", discharge = "60 psi" }\n'
    results = analysed(f"""
fixed_points.O = ["0 in", "0 in"]
crank = {{ pivot = "O", pin = "A", radius = "6 in", speed = "45 rpm", start = "180 deg" }}
links.rod = {{ joins = ["A", "B"], length = "325 ft" }}
guides.bed = {{ through = "O" }}
sliders.piston = {{ guide = "bed", pin = "B" }}
branch.B = -1
[vessels.out]
chambers = ["head", "crank"]
side = "discharge"
length = "300 ft"
diameter = "4 in"
friction = 0.02
[chambers.head]
{valves}sense = 1
[chambers.crank]
{valves}sense = -1
rod_diameter = "2 in"
""")
    head, crank, speed = math.pi * (4 * INCH) ** 2, math.pi * 15 * INCH**2, 45 * RPM
    mean = (head + crank) * 12 * INCH * 45 / 60
    assert results["mean_flow.out"] == pytest.approx(mean, rel=1e-9)
    assert results["mean_torque"] == pytest.approx((head + crank) * 12 * INCH * 50 * PSI / (2 * math.pi), rel=1e-9)
    angles = np.linspace(0, 2 * math.pi, 200001)
    flow = np.where(np.sin(angles) > 0, head, crank) * 6 * INCH * speed * abs(np.sin(angles)) - mean
    stored = np.cumsum(flow[1:] + flow[:-1]) / 2 * angles[1] / speed
    assert results["vessel_volume_change.out"] == pytest.approx(np.ptp(stored), rel=1e-5)
    lost = 0.02 * 900 * (mean / (math.pi * (2 * INCH) ** 2)) ** 2 / 2
    assert results["even_pipe_power.out"] == pytest.approx(1.94 * SLUG / FOOT**3 * mean * lost, rel=1e-9)


def test_a_coupler_with_friction_in_both_its_pins() -> None:
    """Its force touches both circles of friction; the sides of the circles follow from how the links turn."""
    results = analysed("""
fixed_points = { O = ["0 in", "0 in"], E = ["30 in", "0 in"] }
crank = { pivot = "O", pin = "A", radius = "6 in" }
links.coupler = { joins = ["A", "B"], length = "26 in" }
links.rocker = { joins = ["E", "B"], length = "14 in" }
friction.circle = "sine"
friction.pins.A = { coefficient = 0.15, radius = "1 in" }
friction.pins.B = { coefficient = 0.15, radius = "1 in" }
loads = [{ kind = "torque", link = "rocker", torque = "-2000 lbf*in" }]
""")
    angles = math.pi / 3 + np.array([-1, 0, 1]) * 1e-6
    pins = 6 * np.exp(1j * angles)
    line = 30 - pins
    along = (26**2 - 14**2 + abs(line) ** 2) / (2 * abs(line))
    joints = pins + line / abs(line) * (along + 1j * np.sqrt(26**2 - along**2))
    coupler, rocker = (np.diff(np.angle(link)).sum() / 2e-6 for link in (joints - pins, joints - 30))
    pin, joint, radius = pins[1], joints[1], math.sin(math.atan(0.15))
    at_pin, at_joint = -np.sign(coupler - 1) * radius, -np.sign(coupler - rocker) * radius
    # moments of friction on the coupler, of a force of one at its end; the force is turned by what they need
    push = (joint - pin) / 26 * np.exp(-1j * math.asin((at_pin + at_joint) / 26))
    size = 2000 / -(((joint - 30).conjugate() * push).imag + at_joint)
    torque = -((pin.conjugate() * push).imag - at_pin) * size
    assert results.value("torque_with_friction", at=60) == pytest.approx(torque * LBF * INCH, rel=1e-8)


@for_each("offset", [30.0, -30.0])
def test_an_offset_makes_one_stroke_slower(offset: float) -> None:
    """Directions of the crank at both ends of the stroke: towards the pin of the piston, and away from it."""
    results = analysed(f"""
crank = {{ radius = "50 mm", speed = "60 rpm" }}
rod.length = "120 mm"
cylinder.offset = "{offset} mm"
""")
    out, back = (math.atan2(30.0, math.sqrt(reach**2 - 30.0**2)) for reach in (170.0, 70.0))
    slower = math.pi + back - out
    assert results["time_ratio"] == pytest.approx(slower / (2 * math.pi - slower), rel=1e-12)


def orders_of_throws(throws: list[float], spacing: float) -> tuple[list[complex], list[complex]]:
    """Return sums over cranks of the first and second order, of forces and of their moments about the middle."""
    stars = [np.exp(1j * order * np.radians(throws)) for order in (1, 2)]
    places = spacing * (np.arange(len(throws)) - (len(throws) - 1) / 2)
    return [star.sum() for star in stars], [(star * places).sum() for star in stars]


@for_each(("layout", "throws", "order"), [
    ("inline", [0, 90, 270, 180], "1-4-3-2"),
    ("inline", [0, 120, 240, 240, 120, 0], "1-4-2-6-3-5"),
    ("inline", [0, 90, 180], "1-2-3"),
])  # fmt: skip
def test_cranks_that_are_given_need_no_firing_order(layout: str, throws: list[float], order: str) -> None:
    """Forces and moments of the first two orders from the crank star, r/l = 1/4 of a cosine rod by the series."""
    results = analysed(f"""
crank = {{ radius = "300 mm", speed = "100 rpm" }}
rod.length = "1.2 m"
piston.mass = "450 kg"
[engine]
layout = "{layout}"
cylinders = {len(throws)}
throws = {[f"{throw} deg" for throw in throws]}
spacing = "1 m"
""")
    assert f"firing order {order} (engine.firing_order)" in assumption_texts(results, "en")
    first = 450 * 0.3 * (100 * RPM) ** 2
    # second order of cos q + sqrt(16 - sin2 q): 2^2 (1/4 + 1/4^3/4 + 15/128/4^5 ...)
    for size, order_number in ((1, 1), (1 / 4 + 1 / 256 + 15 / 128 / 4**5, 2)):
        sums = [star[order_number - 1] for star in orders_of_throws(throws, 1.0)]
        for name, star in zip(("force", "moment"), sums, strict=True):
            told = results.summary.get(f"free_{name}.reciprocating.{order_number}", 0.0)
            assert told == pytest.approx(first * size * abs(star), rel=3e-5, abs=1e-6)


STEAM = """
crank = { stroke = "500 mm", speed = "120 rpm" }
rod.length = "1.25 m"
cylinder = { bore = "300 mm", clearance_volume = "0 cm3" }
[gas]
cycle = "360 deg"
pressures = "absolute"
ambient = "1 bar"
[gas.points]
a = { angle = "0 deg", pressure = "10 bar" }
c = { stroke = 0.35 }
r = { angle = "180 deg" }
e = { angle = "180 deg", pressure = "1.2 bar" }
f = { angle = "360 deg", pressure = "10 bar" }
[[gas.pieces]]
law = "constant"
points = ["a", "c"]
[[gas.pieces]]
law = "polytropic"
exponent = 1
points = ["c", "r"]
[[gas.pieces]]
law = "constant"
points = ["e", "f"]
"""


def test_a_steam_engine_without_clearance() -> None:
    """Mean pressure p (1 + ln R) / R less that of the exhaust."""
    results = analysed(STEAM)
    assert results["indicated_mean_pressure"] == pytest.approx(1e6 * 0.35 * (1 - math.log(0.35)) - 1.2e5, rel=1e-12)
    # a hyperbola to a volume of nothing has no end
    with pytest.raises(CrankworkError, match="the volume is zero"):
        analysed(STEAM.replace('law = "constant"\npoints = ["e"', 'law = "polytropic"\nexponent = 1\npoints = ["e"'))


@for_each("offset", ["0 mm", "10 mm"])
def test_points_by_the_stroke_count_from_the_top_of_an_offset_cylinder(offset: str) -> None:
    """Straight lines over the stroke: 0.3 of it at 8 bar, 4.5 bar on the rest and on the way back."""
    results = analysed(f"""
crank = {{ radius = "50 mm", speed = "600 rpm" }}
rod.length = "150 mm"
cylinder = {{ bore = "100 mm", clearance_volume = "80 cm3", offset = "{offset}" }}
[gas]
cycle = "360 deg"
pressures = "absolute"
points.a = {{ stroke = 0, pressure = "8 bar" }}
points.c = {{ stroke = 0.3, pressure = "8 bar" }}
points.r = {{ stroke = 1, pressure = "1 bar" }}
points.f = {{ stroke = 0, pressure = "8 bar" }}
pieces = [{{ law = "straight", points = ["a", "c", "r"] }}, {{ law = "straight", points = ["r", "f"] }}]
""")
    assert results["indicated_mean_pressure"] == pytest.approx((0.3 * 8 + 0.7 * 4.5 - 4.5) * 1e5, rel=1e-9)


def test_a_load_of_one_direction_has_no_reversal() -> None:
    """Gas that presses or does nothing never pulls the rod."""
    results = analysed("""
crank = { stroke = "90 mm", speed = "3000 rpm" }
rod.ratio = 0.25
cylinder = { bore = "90 mm", compression_ratio = 8 }
engine = { layout = "inline", cylinders = 1 }
cycle = { kind = "otto", heat = "1800 kJ/kg" }
""")
    assert results["reversal_ratio"] == results["reversal_duration"] == 0.0


def test_valves_ask_for_a_cycle_of_one_turn() -> None:
    with pytest.raises(CrankworkError, match=r'gas\.cycle: is missing; write cycle = "360 deg"'):
        analysed(STEAM.split("[gas]", maxsplit=1)[0] + '[gas]\nvalves = { suction = "1 bar", discharge = "8 bar" }\n')


def test_harmonics_repeat_by_themselves() -> None:
    """A sine of amplitude A and order k gives 2 A / k between its zeros; work is counted over a turn."""
    results = analysed("""
format = 2
crank.speed = "180 rpm"
flywheel.fluctuation = 0.01
torque = { constant = "20 kN*m", harmonics = [{ order = 2, sin = "9500 N*m", cos = "-5700 N*m" }] }
""")
    assert results["excess_work"] == pytest.approx(math.hypot(9500, 5700), rel=1e-9)
    assert results["work_per_cycle"] == pytest.approx(20000 * 2 * math.pi, rel=1e-12)


@for_each("throws", ["", 'throws = ["0 deg", "180 deg"]'])
def test_opposed_cylinders_have_opposed_cranks(throws: str) -> None:
    """Forces cancel; first-order and centrifugal forces of both throws, 150 mm apart, make a couple."""
    results = analysed(f"""
crank = {{ stroke = "120 mm", speed = "740 rpm" }}
rod = {{ length = "300 mm", mass = "6 kg", small_end_share = 0.3 }}
piston.mass = "9 kg"
[engine]
layout = "boxer"
cylinders = 2
strokes = 2
spacing = "150 mm"
{throws}
""")
    assert not [key for key in results.summary if key.startswith("free_force")]
    couple = (9 + 6) * 0.06 * (740 * RPM) ** 2 * 0.15
    assert results["free_moment.residual.1"] == pytest.approx(couple, rel=1e-9)
    assert not results.notices
