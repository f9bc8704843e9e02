"""Rod loads of double-acting cylinders, heads and separation of plunger pumps, and flow of several plungers.

H. P. Bloch and J. J. Hoefner: Reciprocating compressors, operation and maintenance, 1996, page 85, for the rod loads,
whose formulas are printed; the numbers put in are chosen. K. Subramanya: 1000 solved problems in fluid mechanics,
chapter 16, as in `test_compressors`. R. K. Bansal: A textbook of fluid mechanics and hydraulic machines, chapter 20,
for the work that an air vessel saves: 84.8 per cent of one single-acting plunger and 39.2 per cent of one that is
double-acting. Flows of several plungers that move as cosines are integrated in closed form.
"""

import math

import pytest

from crankwork import InputError
from crankwork.analysis import Results
from crankwork.analysis.assumptions import assumptions
from each import for_each
from machine_texts import analysed

POUND, INCH, PSI = 0.45359237 * 9.80665, 25.4, 6894.757293168361


def cylinder(mass: str, crosshead: str, rod: str = "30 in", start: str = "180 deg", branch: int = -1) -> Results:
    """Return the results of a double-acting cylinder without pressure around it, to the left of the shaft."""
    text = f"""
    fixed_points.O = ["0 mm", "0 mm"]
    crank = {{ pivot = "O", pin = "A", radius = "6 in", speed = "300 rpm", start = "{start}" }}
    links.rod = {{ joins = ["A", "B"], length = "{rod}" }}
    guides.bed = {{ through = "O" }}
    sliders.piston = {{ guide = "bed", pin = "B", mass = "{mass}", crosshead_mass = "{crosshead}" }}
    branch.B = {branch}
    """
    outer = -branch
    for name, more in (("head", f"sense = {outer}"), ("crank", f'rod_diameter = "2.5 in"\nsense = {-outer}')):
        text += f"""
        [chambers.{name}]
        slider = "piston"
        bore = "10 in"
        {more}
        compression_ratio = 8
        pressures = "absolute"
        ambient = "0 psi"
        valves = {{ suction = "215 psi", discharge = "515 psi", compression_exponent = 1.3 }}
        """
    return analysed(text)


@for_each(("start", "branch"), [("180 deg", -1), ("0 deg", 1)], ids=["left", "right"])
def test_bloch_rod_load(start: str, branch: int) -> None:
    """The gas alone, whichever side of the shaft the cylinder is on: all digits of the formulas."""
    found = cylinder("0.001 g", "0 g", start=start, branch=branch)
    assert found["rod_load_compression.piston"] / POUND == pytest.approx(24617.323684, rel=1e-9)
    assert found["rod_load_tension.piston"] / POUND == pytest.approx(21033.9445635, rel=1e-9)
    assert found["mean_rod_load.piston"] / POUND == pytest.approx(22825.6341237, rel=1e-9)
    assert found["reversal_ratio.piston"] == pytest.approx(0.85443668993, rel=1e-7)
    assert not found.unmet


def test_inertia_is_added() -> None:
    """The force on the pin is that of the joint, found by equilibrium; without the crosshead the rod carries less."""
    found = cylinder("400 lb", "150 lb")
    assert found["crosshead_load.piston"] == pytest.approx(-found["joint_force_x.B"], rel=1e-10, abs=1e-6)
    acceleration = found["slider_acceleration.piston"]
    behind = found["piston_rod_load.piston"] - found["crosshead_load.piston"]
    assert behind == pytest.approx(150 * 0.45359237 * acceleration, rel=1e-10, abs=1e-6)
    gas = 24617.323684 * POUND
    # at the outer dead centre the gas presses fully, and inertia pulls
    a = 0.1524 * (10 * math.pi) ** 2 * (1 + 0.1524 / 0.762)
    at_head = found.value("crosshead_load.piston", 0.0)
    assert at_head == pytest.approx(gas - 400 * 0.45359237 * a, rel=1e-9)


def test_degrees_of_reversal() -> None:
    """A large inertia turns the load early: both stretches together make a turn, the shorter one is told."""
    light, heavy = cylinder("0.001 g", "0 g"), cylinder("20000 lb", "100 lb")
    assert 0.0 < light["reversal_duration.piston"] <= math.pi
    assert light["reversal_duration.piston"] != pytest.approx(heavy["reversal_duration.piston"], rel=1e-3)
    assert not [one for one in light.notices if one.code == "rod_reversal"]


def test_a_load_that_is_not_reversed_is_told() -> None:
    """A single-acting cylinder that pumps at no speed worth naming presses all the time."""
    found = analysed("""
    fixed_points.O = ["0 mm", "0 mm"]
    crank = { pivot = "O", pin = "A", radius = "50 mm", speed = "1 rpm", start = "180 deg" }
    links.rod = { joins = ["A", "B"], length = "200 mm" }
    guides.bed = { through = "O" }
    sliders.piston = { guide = "bed", pin = "B", mass = "2 kg", crosshead_mass = "1 kg" }
    branch.B = -1
    [chambers.head]
    slider = "piston"
    bore = "100 mm"
    compression_ratio = 10
    pressures = "absolute"
    ambient = "0 bar"
    valves = { suction = "1 bar", discharge = "4 bar", compression_exponent = 1.3 }
    """)
    assert found["reversal_duration.piston"] == 0.0
    assert [one.code for one in found.notices].count("rod_reversal") == 1
    assert found["rod_load_tension.piston"] < 0 < found["rod_load_compression.piston"]


YOKES = """
fixed_points.O = ["0 mm", "0 mm"]
[crank]
pivot = "O"
pin = "C"
radius = "{radius} mm"
speed = "{speed} rpm"
points = {{ D = {second}, E = {third} }}
[guides]
bore = {{ through = "O" }}
slot_1 = {{ link = "plunger_1", angle = "90 deg" }}
slot_2 = {{ link = "plunger_2", angle = "90 deg" }}
slot_3 = {{ link = "plunger_3", angle = "90 deg" }}
[sliders]
plunger_1 = {{ guide = "bore" }}
block_1 = {{ pin = "C", guide = "slot_1" }}
plunger_2 = {{ guide = "bore" }}
block_2 = {{ pin = "D", guide = "slot_2" }}
plunger_3 = {{ guide = "bore" }}
block_3 = {{ pin = "E", guide = "slot_3" }}
"""
CHAMBER = """
[chambers.{name}]
slider = "{slider}"
bore = "{bore} mm"
sense = {sense}
pressures = "absolute"
ambient = "{ambient} m H2O"
valves = {{ {valves} }}
"""


def plungers(chambers: dict[str, tuple[str, int]], more: str, ambient: float = 10.0) -> Results:
    """Return the results of three plungers a third of a turn apart, with chambers by name: plunger and sense."""
    radius, third = 100.0, 2 * math.pi / 3
    pins = [f'["{radius * math.cos(k * third)!r} mm", "{radius * math.sin(k * third)!r} mm"]' for k in (1, 2)]
    text = YOKES.format(radius=radius, speed=60, second=pins[0], third=pins[1])
    valves = 'suction = "0.5 bar", discharge = "5 bar", density = "1000 kg/m3"'
    for name, (slider, sense) in chambers.items():
        side = CHAMBER.format(name=name, slider=slider, bore=80, sense=sense, ambient=ambient, valves=valves)
        text += side.replace(f"{ambient} m H2O", "1 bar")
    return analysed(text + more)


OF_ONE = math.pi / 4 * 0.08**2 * 0.2
PIPE = 'length = "20 m"\ndiameter = "50 mm"\nfriction = 0.02'


@for_each(
    ("chambers", "ratio", "least", "saving"),
    [
        ({"a": ("plunger_1", -1)}, math.pi, 0.0, 1 - 3 / (2 * math.pi**2)),
        ({"a": ("plunger_1", -1), "b": ("plunger_1", 1)}, math.pi / 2, 0.0, 1 - 6 / math.pi**2),
        ({name: (f"plunger_{name}", -1) for name in "123"}, math.pi / 3, math.pi / 3 * math.sqrt(3) / 2, None),
    ],
    ids=["single", "double", "triplex"],
)
def test_pulsation(chambers: dict[str, tuple[str, int]], ratio: float, least: float, saving: float | None) -> None:
    """Largest and least over mean flow, and what a vessel saves of the friction, of cosines."""
    names = ", ".join(f'"{name}"' for name in chambers)
    found = plungers(chambers, f"[vessels.air]\nchambers = [{names}]\n{PIPE}")
    assert found["mean_flow.air"] == pytest.approx(len(chambers) * OF_ONE, rel=1e-11)
    assert found["flow_ratio.air"] == pytest.approx(ratio, rel=1e-11)
    assert found["flow_pulsation.air"] == pytest.approx(ratio - least, rel=1e-9)
    if saving is not None:
        assert found["vessel_saving.air"] == pytest.approx(saving, rel=1e-10)
    mean, area = len(chambers) * OF_ONE, math.pi / 4 * 0.05**2
    even = 0.02 * 20 / 0.05 * 500 * (mean / area) ** 2 * mean
    assert found["even_pipe_power.air"] == pytest.approx(even, rel=1e-10)


def test_what_a_vessel_takes_up() -> None:
    """0.5511 of the volume of a stroke of one single-acting plunger, 0.2105 of a double-acting one (by hand)."""
    for sides, share in ((("a",), 0.5511), (("a", "b"), 0.2105)):
        chambers = {name: ("plunger_1", -1 if name == "a" else 1) for name in sides}
        found = plungers(chambers, f"[vessels.air]\nchambers = {str(list(sides)).replace(chr(39), chr(34))}")
        lower = math.asin(1 / math.pi) if len(sides) == 1 else math.asin(2 / math.pi)
        # between the angles where the flow is the mean: what is above it
        above = (math.cos(lower) - (math.pi - 2 * lower) / (2 * math.pi) if len(sides) == 1
                 else math.cos(lower) - (math.pi - 2 * lower) / math.pi)  # fmt: skip
        assert above == pytest.approx(share, abs=5e-5)
        assert found["vessel_volume_change.air"] == pytest.approx(above * OF_ONE, rel=1e-9)


def test_the_suction_side() -> None:
    """It is as uneven as the other one, half a turn later."""
    one = plungers({"a": ("plunger_1", -1)}, '[vessels.air]\nchambers = ["a"]\nside = "suction"')
    other = plungers({"a": ("plunger_1", -1)}, '[vessels.air]\nchambers = ["a"]')
    assert one["flow_pulsation.air"] == pytest.approx(other["flow_pulsation.air"], rel=1e-12)
    for angle in (30.0, 200.0, 315.0):
        later = other.value("vessel_flow.air", (angle + 180.0) % 360.0)
        assert one.value("vessel_flow.air", angle) == pytest.approx(later, rel=1e-9, abs=1e-15)


def pump(more: str, speed: float = 20.0) -> Results:
    """Return the results of the plunger of K. Subramanya, example 16.41, by heights: 10 m of water around it."""
    return analysed(f"""
    method.gravity = "9.81 m/s2"
    fixed_points.O = ["0 mm", "0 mm"]
    crank = {{ pivot = "O", pin = "C", radius = "150 mm", speed = "{speed} rpm" }}
    guides = {{ bore = {{ through = "O" }}, slot = {{ link = "plunger", angle = "90 deg" }} }}
    sliders = {{ plunger = {{ guide = "bore" }}, block = {{ pin = "C", guide = "slot" }} }}
    [chambers.water]
    slider = "plunger"
    bore = "150 mm"
    sense = -1
    pressures = "absolute"
    ambient = "98.1 kPa"
    [chambers.water.valves]
    density = "1000 kg/m3"
    suction_height = "2.5 m"
    discharge_height = "15 m"
    vapour_pressure = "19.62 kPa"
    {more}
    """)


def test_subramanya_16_41() -> None:
    """Page 421: the speed of separation in the suction pipe, from heights, at any speed of the file."""
    pipe = 'suction_pipe = { length = "5 m", diameter = "50 mm" }'
    for speed in (10.0, 25.0):
        found = pump(pipe, speed)
        assert found["separation_speed.water.suction"] * 30 / math.pi == pytest.approx(26.9982331852, rel=1e-10)
    assert found["suction_pressure.water"] == pytest.approx(7.5 * 9810, rel=1e-12)
    assert found["discharge_pressure.water"] == pytest.approx(25 * 9810, rel=1e-12)
    head = 5 / 9.81 * 9 * 0.15 * (25 * math.pi / 30) ** 2
    assert found["acceleration_head.water.suction"] == pytest.approx(head, rel=1e-11)
    assert pump(pipe, 26.9982331852)["diagram_pressure_min.water"] / 9810 == pytest.approx(2.0, rel=1e-9)


def test_heads_in_the_cylinder() -> None:
    """At both ends of the suction stroke and in its middle: acceleration, friction, acceleration again."""
    found = pump('suction_pipe = { length = "5 m", diameter = "50 mm", friction = 0.03 }')
    speed = 20 * math.pi / 30
    head, velocity = 5 / 9.81 * 9 * 0.15 * speed**2, 9 * 0.15 * speed
    lost = 0.03 * 5 / 0.05 * velocity**2 / (2 * 9.81)
    assert found.value("pressure_head.water", 1e-9) == pytest.approx(7.5 - head, rel=1e-7)
    assert found.value("pressure_head.water", 90.0) == pytest.approx(7.5 - lost, rel=1e-11)
    assert found.value("pressure_head.water", 180.0) == pytest.approx(7.5 + head, rel=1e-7)
    assert found.value("pressure_head.water", 270.0) == pytest.approx(25.0, rel=1e-11)


def test_flow_into_a_vessel() -> None:
    """R. K. Bansal, chapter 20: A r w (sin - 2/pi) of a double-acting, with 1/pi of a single-acting plunger."""
    scale = math.pi / 4 * 0.08**2 * 0.1 * 2 * math.pi
    for chambers, mean in (({"a": ("plunger_1", -1)}, 1 / math.pi), (
            {"a": ("plunger_1", -1), "b": ("plunger_1", 1)}, 2 / math.pi)):  # fmt: skip
        names = ", ".join(f'"{name}"' for name in chambers)
        found = plungers(chambers, f"[vessels.air]\nchambers = [{names}]")
        for angle in (30.0, 90.0, 120.0):
            # the plunger delivers in the second half of the turn
            expected = scale * (math.sin(math.radians(angle)) - mean)
            assert found.value("vessel_inflow.air", 180.0 + angle) == pytest.approx(expected, rel=1e-10)


def test_friction_head() -> None:
    """At the middle of the stroke, after Darcy."""
    found = pump('discharge_pipe = { length = "40 m", diameter = "100 mm", friction = 0.03 }')
    velocity = 2.25 * 0.15 * 20 * math.pi / 30
    head = 0.03 * 40 / 0.1 * velocity**2 / (2 * 9.81)
    assert found["friction_head.water.discharge"] == pytest.approx(head, rel=1e-11)


def test_subramanya_16_38() -> None:
    """Page 420, by heights: 15 m of water of 9800 N/m3 in all."""
    found = analysed("""
    method.gravity = "9.8 m/s2"
    fixed_points.O = ["0 mm", "0 mm"]
    crank = { pivot = "O", pin = "A", radius = "150 mm", speed = "60 rpm", start = "180 deg" }
    links.rod = { joins = ["A", "B"], length = "10 m" }
    guides.bed = { through = "O" }
    sliders.piston = { guide = "bed", pin = "B" }
    branch.B = -1
    [chambers.head]
    slider = "piston"
    bore = "150 mm"
    pressures = "absolute"
    ambient = "1 bar"
    valves = { density = "1000 kg/m3", suction_height = "5 m", discharge_height = "10 m", delivered = "310 l/min" }
    """)
    assert found["inlet_flow.head"] == pytest.approx(318.086256176e-3 / 60, rel=1e-11)
    assert found["pump_slip.head"] == pytest.approx(0.0254215830422, rel=1e-9)
    assert found["discharge_coefficient.head"] == pytest.approx(0.974578416958, rel=1e-11)
    assert found["motor_power"] == pytest.approx(779.311327631, rel=1e-11)


def test_each_side_that_separates_is_told_with_its_speed() -> None:
    pipes = "\n".join(f'{side}_pipe = {{ length = "{long} m", diameter = "50 mm" }}'
                      for side, long in (("suction", 5), ("discharge", 12)))  # fmt: skip
    # after the page 27.0 rpm of the suction; the delivery has sqrt(23/12 * 5/5.5) of it
    limits = {"suction": 26.9982331852, "discharge": 26.9982331852 * math.sqrt(23 / 5.5 * 5 / 12)}
    for speed in (26.0, 30.0, 36.0):
        told = {notice.code: notice.values for notice in pump(pipes, speed).notices}
        assert {code for code in told if "separation_" in code} == {
            f"separation_{side}" for side, most in limits.items() if speed > most
        }
        for side, most in limits.items():
            if speed > most:
                assert told[f"separation_{side}"]["most"] == pytest.approx(most, rel=1e-9)
    assert "separation" in told


@for_each(("more", "place"), [
    ('[vessels]\nv.chambers = ["water", "water"]', r"vessels\.v\.chambers\[2\]"),
    ('[vessels]\nv.chambers = ["water"]\nu.chambers = ["water"]', r"vessels\.u\.chambers\[1\]"),
])  # fmt: skip
def test_a_side_of_a_chamber_has_one_vessel(more: str, place: str) -> None:
    with pytest.raises(InputError, match=place):
        pump(more)


def test_the_pipe_of_a_vessel_is_told_to_stand_apart() -> None:
    found = pump("""[vessels]
    a.chambers = ["water"]
    b = { chambers = ["water"], side = "suction", length = "9 m", diameter = "80 mm", friction = 0.02 }""")
    assert [item.names for item in assumptions(found) if item.code == "vessel_pipes"] == [("b",)]
