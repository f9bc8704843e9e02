"""Engine files with friction, loads, a motor and motion in time are the linkages that they stand for."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import root

import crankwork
from machine_texts import analysed

R, L = 0.05, 0.2
PUSH = 1000.0
COEFFICIENTS, RADII = {"O": 0.1, "A": 0.15, "B": 0.12}, {"O": 0.02, "A": 0.018, "B": 0.012}
GUIDE = 0.08
RUBBING = f"""
loads = [{{ kind = "force", point = "B", link = "piston", y = "-{PUSH} N" }}]
friction.pins.O = {{ coefficient = 0.1, radius = "20 mm" }}
friction.pins.A = {{ coefficient = 0.15, radius = "18 mm" }}
friction.pins.B = {{ coefficient = 0.12, radius = "12 mm" }}
friction.sliders.piston.coefficient = {GUIDE}
"""
GEAR = """
crank = { radius = "50 mm", speed = "300 rpm" }
rod.length = "200 mm"
cylinder.bore = "80 mm"
"""
DRAWN = """
fixed_points.O = ["0 mm", "0 mm"]
crank = { pivot = "O", pin = "A", radius = "50 mm", speed = "300 rpm", start = "90 deg", direction = "clockwise" }
links.rod = { joins = ["A", "B"], length = "200 mm" }
guides.bore = { through = ["0 mm", "250 mm"], angle = "270 deg" }
sliders.piston = { guide = "bore", pin = "B" }
positions.B = ["0 mm", "250 mm"]
"""


def assert_same(results: crankwork.Results, others: crankwork.Results) -> None:
    """Compare every column and every single value of two results."""
    for one, other in ((results.columns, others.columns), (results.summary, others.summary)):
        assert set(one) == set(other)
        for key, value in one.items():
            size = float(np.nanmax(np.abs(other[key])))
            assert value == pytest.approx(other[key], rel=1e-12, abs=1e-12 * size, nan_ok=True), key


def torque_by_hand(degrees: float) -> float:
    """Return the driving torque of the crank, from the equilibrium of three links without mass. [N·m]"""
    phi = math.radians(degrees)
    # crank clockwise from the head, which is up
    a = np.array([R * math.sin(phi), R * math.cos(phi)])
    b = np.array([0.0, a[1] + math.sqrt(L**2 - a[0] ** 2)])
    rod_turns = R * math.cos(phi) / math.sqrt(L**2 - a[0] ** 2)  # anticlockwise, over the speed of the crank
    goes = np.sign(-a[0] - rod_turns * (a[0] - b[0]))  # piston, upwards
    rho = {pin: COEFFICIENTS[pin] * RADII[pin] for pin in RADII}

    def missing(force: np.ndarray) -> list[float]:
        """Return what piston and rod lack for equilibrium; `force`: of the rod on the piston, and of the wall."""
        x, y, wall = force
        size = math.hypot(x, y)
        lever = b - a
        on_rod = lever[0] * -y - lever[1] * -x
        rubs = -rho["B"] * size * np.sign(rod_turns) - rho["A"] * size * np.sign(rod_turns + 1)
        return [x + wall, y - PUSH - goes * GUIDE * abs(wall), on_rod + rubs]

    x, y, _ = root(missing, [0.0, PUSH, 0.0], tol=1e-13).x
    size = math.hypot(x, y)
    # the rod presses the pin of the crank with the same force turned round
    clockwise = -(a[0] * -y - a[1] * -x)
    return float(-clockwise + rho["A"] * size + rho["O"] * size)


@pytest.mark.elsewhere
def test_a_crank_gear_rubs_as_its_links_in_equilibrium_say() -> None:
    degrees = np.array([20.0, 75.0, 130.0, 200.0, 285.0, 340.0])
    results = analysed(GEAR + RUBBING, *degrees)
    expected = [torque_by_hand(one) for one in degrees]
    assert results["torque_with_friction"] == pytest.approx(expected, rel=1e-9)


def test_a_crank_gear_with_friction_is_its_linkage() -> None:
    assert_same(analysed(GEAR + RUBBING), analysed(DRAWN + RUBBING))


@pytest.mark.elsewhere
def test_a_dragging_piston_takes_its_force_over_both_strokes_of_every_turn() -> None:
    """P = 4 r F n; a spring between head and piston takes no power, and pushes with c s along the axis."""
    spring = "loads = [{ kind = 'spring', slider = 'piston', stiffness = '2 N/mm' }]"
    results = analysed(f"{GEAR}friction.sliders.piston.force = '30 N'\n{spring}", 20.0, 75.0, 200.0, 340.0)
    assert results["mean_friction_power"] == pytest.approx(4 * R * 30 * 5, rel=1e-12)
    phi = np.radians(results.grid.degrees)
    along = np.sqrt(L**2 - (R * np.sin(phi)) ** 2)
    stretched = R + L - R * np.cos(phi) - along
    rate = R * np.sin(phi) + R**2 * np.sin(phi) * np.cos(phi) / along
    assert results["balancing_torque"] == pytest.approx(2000 * stretched * rate, rel=1e-12)


RUN_DOWN = """
crank = { radius = "50 mm", speed = "300 rpm" }
rod.length = "200 mm"
piston.mass = "3 kg"
flywheel.inertia = "0.4 kg*m2"
friction.pins.O.moment = "0.6 N*m"
friction.sliders.piston.force = "12 N"
transient = { time = "20 s", speed = "10 rad/s", until = "rest" }
"""


@pytest.mark.elsewhere
def test_an_engine_runs_down_until_friction_has_its_energy() -> None:
    """It begins in a dead centre, with J w^2 / 2 of the flywheel alone, and has none at rest."""
    results = analysed(RUN_DOWN)
    listing = results.listings["transient_events"]
    row = next(row for row, name in enumerate(listing.names) if name.startswith("comes_to_rest"))
    angle = abs(float(listing.columns["crank_angle"][row]))
    halves = angle // math.pi
    place = R * math.cos(angle) + math.sqrt(L**2 - (R * math.sin(angle)) ** 2)
    way = 2 * R * halves + abs(place - (L - R if halves % 2 else L + R))
    assert angle * 0.6 + way * 12 == pytest.approx(0.4 * 10**2 / 2, rel=1e-9)
    assert results.checks["energy_balance"] < 1e-11


MOTOR = """
[motor]
rated_power = "5.5 kW"
rated_speed = "1440 rpm"
overload = 2.4
pole_pairs = 2
ratio = 1.5
inertia = "0.02 kg*m2"
[efficiency]
chain = [0.95, 0.97]
losses = "drive"
[friction.pins]
O = { coefficient = 0.02, radius = "25 mm" }
[flywheel]
inertia = "0.8 kg*m2"
[transient]
time = "0.5 s"
"""
COMPRESSOR = """
[crank]
radius = "40 mm"
speed = "960 rpm"
mass = "1.5 kg"
[rod]
length = "180 mm"
mass = "1 kg"
small_end_share = 0.3
[piston]
mass = "1.4 kg"
[cylinder]
bore = "100 mm"
clearance_volume = "30 cm3"
[gas]
cycle = "360 deg"
pressures = "absolute"
ambient = "0.1 MPa"
[gas.valves]
suction = "0.095 MPa"
discharge = "0.6 MPa"
compression_exponent = 1.3
"""
CHAMBER = """
[crank]
pivot = "O"
pin = "A"
radius = "40 mm"
speed = "960 rpm"
start = "90 deg"
direction = "clockwise"
mass = "1.5 kg"
centre = "A"
inertia = "0.0024 kg*m2"
[fixed_points]
O = ["0 mm", "0 mm"]
[links.rod]
joins = ["A", "B"]
length = "180 mm"
mass = "1 kg"
centre = ["54 mm", "0 mm"]
inertia = "0.006804 kg*m2"
[guides.bore]
through = ["0 mm", "220 mm"]
angle = "270 deg"
[sliders.piston]
guide = "bore"
pin = "B"
mass = "1.4 kg"
[positions]
B = ["0 mm", "220 mm"]
[chambers.cylinder]
slider = "piston"
bore = "100 mm"
clearance_volume = "30 cm3"
pressures = "absolute"
ambient = "0.1 MPa"
[chambers.cylinder.valves]
suction = "0.095 MPa"
discharge = "0.6 MPa"
compression_exponent = 1.3
"""


@pytest.mark.elsewhere
def test_a_compressor_with_motor_and_start_is_its_linkage_and_needs_what_gas_and_friction_take() -> None:
    results = analysed(COMPRESSOR + MOTOR)
    assert_same(results, analysed(CHAMBER + MOTOR))
    # work of the diagram: two polytropes and two strokes at constant pressure, by hand
    swept, clearance, suction, discharge, n = math.pi * 0.05**2 * 0.08, 30e-6, 0.095e6, 0.6e6, 1.3
    ratio = (discharge / suction) ** (1 / n)
    drawn = swept + clearance - clearance * ratio
    work = n / (n - 1) * suction * drawn * ((discharge / suction) ** (1 - 1 / n) - 1)
    needed = work * 16 + results["mean_friction_power"]
    assert results["motor_power"] == pytest.approx(needed / (0.95 * 0.97), rel=1e-9)
    assert results.checks["energy_balance"] < 1e-9


FOUR = """
crank = { radius = "40 mm", speed = "3000 rpm", mass = "1 kg" }
rod = { length = "140 mm", mass = "0.6 kg", small_end_share = 0.3 }
piston.mass = "0.4 kg"
cylinder = { bore = "75 mm", compression_ratio = 8 }
engine = { layout = "inline", cylinders = 4 }
[gas]
cycle = "720 deg"
pressures = "absolute"
ambient = "0.1 MPa"
pieces = [
    { law = "constant", points = ["r", "a"] },
    { law = "polytropic", points = ["a", "c"], exponent = 1.35 },
    { law = "polytropic", points = ["z", "b"], exponent = 1.25 },
    { law = "constant", points = ["s", "t"] },
]
[gas.points]
r = { angle = "0 deg", pressure = "0.09 MPa" }
a = { angle = "180 deg", pressure = "0.09 MPa" }
c = { angle = "360 deg" }
z = { angle = "360 deg", pressure = "5 MPa" }
b = { angle = "540 deg" }
s = { angle = "540 deg", pressure = "0.11 MPa" }
t = { angle = "720 deg", pressure = "0.11 MPa" }
[friction.pins]
"""
PINS = ("O", *(f"{pin}{number}" for number in range(1, 5) for pin in "AB"))


@pytest.mark.slow
@pytest.mark.elsewhere
def test_what_the_gas_of_four_cylinders_gives_goes_to_brake_and_pins() -> None:
    """Gas work of the diagram by hand: polytropes between the volumes of the dead centres."""
    pins = "".join(f'{pin} = {{ coefficient = 0.01, radius = "20 mm" }}\n' for pin in PINS)
    summary = analysed(FOUR + pins).summary
    swept = math.pi * 0.0375**2 * 0.08
    low, high = swept / 7, swept * 8 / 7
    squeezed = 0.09e6 * high / 0.35 * (8**0.35 - 1)
    expanded = 5e6 * low / 0.25 * (1 - 8**-0.25)
    work = expanded - squeezed - (0.11e6 - 0.09e6) * swept
    brake = summary["mean_torque"] * summary["speed"]
    assert brake + summary["mean_friction_power"] == pytest.approx(4 * work * 25, rel=1e-9)
    assert summary["mean_friction_power"] > 0.02 * brake


def test_an_engine_with_friction_has_the_forces_that_its_cylinder_has_without():
    plain, friction = crankwork.template("engine"), '\n[friction.sliders.piston]\nforce = "80 N"\n'
    alone, rubbed = (crankwork.analyse(crankwork.Description(text)) for text in (plain, plain + friction))
    for key in ("piston_force", "side_force", "tangential_force"):
        assert rubbed[key] == pytest.approx(alone[key], rel=1e-13), key
    assert rubbed["mean_torque"] < alone["mean_torque"]
    pushed = crankwork.analyse(crankwork.Description(plain + '\n[[loads]]\nkind = "force"\npoint = "B"\ny = "5 N"\n'))
    assert "piston_force" not in pushed


def test_the_air_behind_a_calculated_cycle_does_not_push_on_the_piston_rod() -> None:
    text = f"""
        crank = {{ radius = "50 mm", speed = "3000 rpm" }}
        rod.length = "200 mm"
        cylinder = {{ bore = "80 mm", compression_ratio = 9.0 }}
        cycle = {{ kind = "otto", pressure_ratio = 2.5 }}
        {RUBBING}
    """
    plain = analysed(text)
    with_rod = analysed(text.replace("bore =", 'piston_rod_diameter = "20 mm", bore ='))
    assert with_rod["mean_torque"] == pytest.approx(plain["mean_torque"], rel=1e-12)
