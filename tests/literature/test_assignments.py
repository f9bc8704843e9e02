"""Assignments entered as their sheets state them; the folder `assignments` has the files, each with its source."""

import re
from dataclasses import replace
from functools import cache
from math import log
from pathlib import Path

import numpy as np
import pytest

import crankwork
from crankwork.analysis.vector_polygons import positions
from crankwork.working_cycle.schools import SCHOOLS
from each import for_each

HERE = Path(__file__).parent
SHEETS = sorted(path.stem for path in (HERE / "assignments").glob("*.toml"))
pytestmark = pytest.mark.elsewhere


@cache
def entered(name: str) -> crankwork.Results:
    return crankwork.analyse(crankwork.read(HERE / "assignments" / f"{name}.toml"))


@for_each("name", SHEETS)
def test_a_sheet_is_computed(name: str) -> None:
    assert entered(name).columns


def test_the_vietnamese_engine_has_the_printed_columns_where_its_note_follows_its_formulas() -> None:
    """All but the corners, whose pressures the note draws by hand, and the rows that it prints from another run."""
    results = entered("vi_seed_engine")
    angle, pressure, inertia, force = np.loadtxt(HERE / "data" / "vietnamese_engine.csv", delimiter=",").T
    area = results["piston_area"] * 1e6
    follows = (angle >= 5) & (angle <= 350) | (angle >= 380) & (angle <= 500) | (angle >= 575) & (angle < 720)
    assert np.count_nonzero(follows) == 124
    assert np.max(np.abs(np.asarray(results["inertia_force"]) / area - inertia)) < 5e-7
    rows = {key: np.abs(values - printed)[follows] for key, values, printed in (
        ("gas_pressure", np.asarray(results["gas_pressure"]) / 1e6, pressure),
        ("piston_force", np.asarray(results["piston_force"]) / area, force),
    )}  # fmt: skip
    # at 180 degrees the note has 1050 cm3 where its stroke and bore give 1050.14, 0.000014 MPa
    at_bottom = angle[follows] == 180
    assert max(np.max(row[~at_bottom]) for row in rows.values()) < 5e-6
    assert max(np.max(row[at_bottom]) for row in rows.values()) < 2e-5
    assert results["gas_pressure_max"] == pytest.approx(5.083e6)


# each by hand: p_c = p_a e^n1, p_b = p_z / (e / rho)^n2, V_h = pi D^2 S / 4
def test_pressures_of_a_petrol_sheet_follow_from_its_exponents() -> None:
    results = entered("vi_ford_z6")
    expected = {
        "compression_pressure": 0.088e6 * 10.8**1.34,
        "expansion_pressure": 5.3e6 / 10.8**1.25,
        "swept_volume": np.pi * 0.083**2 / 4 * 0.0695,
        "pressure_rise_ratio": 5.3 / (0.088 * 10.8**1.34),
    }
    assert {key: results[key] for key in expected} == pytest.approx(expected, rel=1e-12)
    assert results["compression_pressure"] == pytest.approx(2.134e6, abs=500)
    assert results["expansion_pressure"] == pytest.approx(0.2707e6, abs=50)


def test_exponents_of_a_diesel_sheet_follow_from_its_pressures() -> None:
    results = entered("vi_1d6_de25")
    expected = {"compression_exponent": log(3.6 / 0.09) / log(15), "expansion_exponent": log(5.6 / 0.353) / log(10)}
    assert {key: results[key] for key in expected} == pytest.approx(expected, rel=1e-12)
    assert results["compression_exponent"] == pytest.approx(1.3622, abs=5e-5)


def test_the_mean_pressure_of_a_sharp_sheet_is_the_area_of_its_lines() -> None:
    """By quadrature over the lines of pressure; exhaust and intake at p_r and p_a."""
    results = entered("vi_ford_z6")
    volume = np.geomspace(1, 10.8, 200_001)
    lines = 5.3e6 * volume**-1.25 - 0.088e6 * (10.8 / volume) ** 1.34
    area = np.trapezoid(lines, volume) / 9.8
    assert results["theoretical_mean_pressure"] == pytest.approx(area, rel=1e-8)


def _changed(tmp_path: Path, *changes: tuple[str, str], name: str = "vi_ford_z6") -> crankwork.Results:
    text = (HERE / "assignments" / f"{name}.toml").read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "changed.toml"
    path.write_text(text, encoding="utf-8")
    return crankwork.analyse(crankwork.read(path))


def _at(results: crankwork.Results, angle: float) -> float:
    """Return the absolute pressure before a crank angle. [MPa]"""
    cylinder = replace(results.machine, engine=None)
    columns = crankwork.analyse(cylinder).columns_at([angle])
    return float(np.asarray(columns["gas_pressure"])[0]) / 1e6 + 0.1


P_C, P_B = 0.088 * 10.8**1.34, 5.3 / 10.8**1.25


@for_each(
    ("changes", "angle", "pressure"),
    [
        # Vietnamese: a third of the way to the peak of 0.85 p_z; b'' in the middle of ab
        ((), 360.0, P_C + (0.85 * 5.3 - P_C) / 3),
        ((), 540.0, (P_B + 0.088) / 2),
        # Russian: 1.2 p_c; b'' halfway to the exhaust line
        ((('school = "vi"', 'school = "ru"'),), 360.0, 1.2 * P_C),
        ((('school = "vi"', 'school = "ru"'),), 540.0, (P_B + 0.113) / 2),
        # single keys override the school
        ((('school = "vi"', 'school = "vi"\nrise = 1.15'),), 360.0, 1.15 * P_C),
        ((('school = "vi"', 'school = "ru"\nrise_share = "1/2"'),), 360.0, (P_C + 0.85 * 5.3) / 2),
        ((('school = "vi"', 'school = "vi"\npeak_level = 0.9'),), 360.0, P_C + (0.9 * 5.3 - P_C) / 3),
        ((('school = "vi"', 'school = "vi"\nblow_down = "exhaust"'),), 540.0, (P_B + 0.113) / 2),
        # without a school corners are sharp: the pressure before the vertical line
        ((('school = "vi"', 'school = "none"'),), 360.0, P_C),
    ],
)
def test_corners_are_rounded_by_the_conventions_of_a_school(
    tmp_path: Path, changes: tuple[tuple[str, str], ...], angle: float, pressure: float
) -> None:
    results = _changed(tmp_path, *changes)
    assert _at(results, angle) == pytest.approx(pressure, abs=1e-9)


def test_applied_conventions_are_assumptions_and_those_without_effect_are_not(tmp_path: Path) -> None:
    def conventions(results: crankwork.Results) -> dict[str, object]:
        names = ("school", "rise", "rise_share", "blow_down", "peak_level")
        paths = {f"cycle.{name}" for name in names}
        return {key: item.value for item in results.assumptions for key in item.keys if key in paths}

    assert conventions(entered("vi_ford_z6")) == {
        "cycle.peak_level": 0.85, "cycle.rise_share": 1 / 3, "cycle.blow_down": "intake",
    }  # fmt: skip
    assert conventions(_changed(tmp_path, ('school = "vi"\n', ""))) == {
        "cycle.school": "ru", "cycle.peak_level": 0.85, "cycle.rise": 1.2, "cycle.blow_down": "exhaust",
    }  # fmt: skip
    assert not conventions(_changed(tmp_path, ('school = "vi"', 'school = "none"')))


def test_every_school_has_a_source() -> None:
    assert all("source" in record for name, record in SCHOOLS.items() if name != "peak_level")


@for_each(
    ("line", "key"),
    [
        ('intake_pressure = "0.088 MN/m2"\n', "intake_pressure"),
        ("compression_exponent = 1.34\n", "compression_exponent"),
        ('peak_pressure = "5.3 MN/m2"\n', "peak_pressure"),
        ("expansion_exponent = 1.25\n", "expansion_exponent"),
        ('residual_pressure = "0.113 MN/m2"\n', "residual_pressure"),
    ],
)
def test_what_a_sheet_leaves_out_is_asked_for(tmp_path: Path, line: str, key: str) -> None:
    with pytest.raises(crankwork.InputError, match=rf"cycle\.{key}: is missing"):
        _changed(tmp_path, (line, ""))


@for_each(
    ("changes", "message"),
    [
        ((('peak_pressure = "5.3 MN/m2"', 'peak_pressure = "2 MPa"'),), "pressure ratio of 0.937"),
        ((('school = "vi"', 'school = "vi"\ntotal_volume = "400 cm3"'),), "stands without the other volumes"),
    ],
)
def test_data_that_contradict_one_another_are_refused(
    tmp_path: Path, changes: tuple[tuple[str, str], ...], message: str
) -> None:
    with pytest.raises(crankwork.InputError, match=message):
        _changed(tmp_path, *changes)


def test_forces_of_a_printed_program_follow_with_its_pi_its_gravity_and_weights() -> None:
    """Pd, Pn, Pr, Pk per piston area at five crank angles; its degrees are those of 3.14. [Pa]"""
    printed = {
        540: (609275.46273, 873.32585, -609272.68089, 2037.76730),
        720: (2278778.96925, -4355.14510, 2278704.98284, -18872.18055),
        12.5: (3121328.79537, 203000.61166, 3003500.08699, 873435.70145),
        30: (1389711.55912, 210743.02925, 1098386.85046, 877073.06917),
        40: (872921.19861, 171475.56198, 558719.10972, 692263.13189),
    }
    results = entered("ru_kshm_delphi")
    columns = results.columns_at([angle * 3.14 / np.pi for angle in printed])
    keys = ("piston_force", "side_force", "radial_force", "tangential_force")
    forces = np.array([columns[key] for key in keys]).T / results["piston_area"]
    # the file states the angles of the pressures to 1e-6 degrees
    assert forces == pytest.approx(np.array(list(printed.values())), abs=0.5)


def test_motion_of_a_calculus_project_is_that_of_its_functions() -> None:
    """By x = r cos q + sqrt(l^2 - r^2 sin^2 q) and differences of it."""
    results, step = entered("en_rosehulman_engine"), 1e-4
    speed = 1000 * 2 * np.pi / 60
    degrees = np.array([20.0, 75.0, 200.0])

    def height(q: np.ndarray) -> np.ndarray:
        return 0.08 * np.cos(q) + np.sqrt(0.245**2 - 0.08**2 * np.sin(q) ** 2)

    before, here, after = (height(np.radians(degrees) + shift) for shift in (-step, 0, step))
    columns = results.columns_at(degrees)
    assert columns["piston_displacement"] == pytest.approx(0.325 - here, rel=1e-12)
    assert columns["piston_velocity"] == pytest.approx((before - after) / (2 * step) * speed, rel=1e-6)
    assert columns["piston_acceleration"] == pytest.approx((2 * here - before - after) / step**2 * speed**2, rel=1e-5)


def test_weights_in_newtons_are_masses_by_the_gravity_of_the_sheet(tmp_path: Path) -> None:
    """G = 30, 40 and 60 N are 3, 4 and 6 kg with g = 10 in the sheet of a gear shaper (ukrbukva.net, 44430, page 7)."""
    for weight, mass in ((30, 3.0), (40, 4.0), (60, 6.0)):
        heavy = ('mass = "0.8 kg"', f'mass = "{weight} N"')
        # a mass of the rod of 1 kg, 0.3 of which moves with the piston
        results = _changed(tmp_path, heavy, ("[engine]", '[method]\ngravity = "10 m/s2"\n[engine]'))
        assert results["reciprocating_mass"] == pytest.approx(mass + 0.3, rel=1e-12)
        assert {one.values["gravity"] for one in results.notices if one.code == "weight"} == {10.0}


def test_a_force_table_shows_that_its_rod_force_is_multiplied_by_the_cosine() -> None:
    """Printed P_ш in MN against P_д / cos β; it is P_д cos β with a cosine of two digits, negative past 180 degrees."""
    printed = {
        30: -0.00418, 60: -0.00259, 90: 0.00153, 120: 0.00414, 150: 0.00523, 240: -0.00517, 270: -0.00256, 420: -0.015,
        450: -0.01331, 480: -0.01242, 510: -0.01307, 570: 0.01202, 600: 0.00906, 630: 0.00384,
    }  # fmt: skip
    results = entered("ru_force_table")
    columns = results.columns_at([float(angle) for angle in printed])
    force, right = (np.asarray(columns[key]) / results["piston_area"] / 1e6 for key in ("piston_force", "rod_force"))
    cosine = np.cos(np.asarray(columns["rod_angle"]))
    angles, values = np.array([*printed]), np.array([*printed.values()])
    sign = np.where((angles > 180) & (angles < 540), -1, 1)
    assert values == pytest.approx(sign * force * cosine, rel=0.006)
    assert right == pytest.approx(force / cosine, rel=1e-12)
    # right values lie by the square of the cosine higher, up to 6 per cent
    assert np.max(np.abs(right / (sign * values))) == pytest.approx(1 / 0.97**2, rel=0.003)


def test_a_stirling_engine_has_the_printed_power_and_pressures() -> None:
    """255.05 W by both methods and 0.47 to 1.18 MPa; the torque printed beside them does not give that power."""
    results = entered("en_stirling")
    assert results["indicated_power"] == pytest.approx(255.05, abs=0.05)
    assert results["mean_torque"] * 650 * np.pi / 30 == pytest.approx(results["indicated_power"], rel=1e-9)
    absolute = np.asarray(results["diagram_pressure.hot"]) / 1e6
    assert (round(float(np.min(absolute)), 2), round(float(np.max(absolute)), 2)) == (0.47, 1.18)
    # a rim of that section: m = rho pi D b t, J = m D^2 / 4
    diameter = results["rim_diameter"]
    assert results["rim_mass"] == pytest.approx(7750 * np.pi * diameter * 0.025 * 0.05, rel=1e-9)
    assert results["flywheel_inertia"] == pytest.approx(results["rim_mass"] * diameter**2 / 4, rel=1e-9)


@cache
def _four_bar_at_60_degrees() -> dict[str, np.ndarray]:
    """Return accelerations and pin forces of the homework by vectors and nine equations of Newton and Euler."""
    r2, r3, r4, ground, q, w, a = 1.0, 2.06, 2.33, 2.22, np.radians(60), 10.0, 5.0
    pin = r2 * np.exp(1j * q)
    across = ground - pin
    beside = np.arccos((r3**2 + abs(across) ** 2 - r4**2) / (2 * r3 * abs(across)))
    coupler = r3 * np.exp(1j * (np.angle(across) + beside))
    rocker = pin + coupler - ground
    a_pin = pin * (1j * a - w**2)
    # i w3 c - i w4 d = -i w p, the same for the accelerations
    matrix = np.array([[(1j * coupler).real, -(1j * rocker).real], [(1j * coupler).imag, -(1j * rocker).imag]])
    v_pin = 1j * w * pin
    w3, w4 = np.linalg.solve(matrix, [-v_pin.real, -v_pin.imag])
    rest = -a_pin + coupler * w3**2 - rocker * w4**2
    a3, a4 = np.linalg.solve(matrix, [rest.real, rest.imag])
    turn = coupler / r3
    g2, g4 = pin / 2, rocker / 2
    g3, p = (turn * complex(x, y) for x, y in ((1.561008, -0.527122), (2.622932, -1.576017)))
    acc = (g2 * (1j * a - w**2), a_pin + g3 * (1j * a3 - w3**2), g4 * (1j * a4 - w4**2))
    m, J = (9.8125, 219.9657, 22.863125), (0.82, 10.35, 50.13)
    load = -100j
    # unknown: F12 on the crank, F32 on the crank, F43 on the coupler, F14 on the rocker, T12
    left, right = np.zeros((9, 9)), np.zeros(9)

    def moment(arm: complex) -> list[float]:
        return [-arm.imag, arm.real]

    for row, (mass, accel) in enumerate(zip(m, acc, strict=True)):
        right[3 * row], right[3 * row + 1] = (mass * accel).real, (mass * accel).imag
    right[3:5] -= load.real, load.imag
    right[2], right[8] = J[0] * a, J[2] * a4
    right[5] = J[1] * a3 - ((p - g3).conjugate() * load).imag
    for row, column, sign, arm in ((0, 0, 1, -g2), (0, 2, 1, pin - g2), (3, 2, -1, -g3), (3, 4, 1, coupler - g3),
                                   (6, 4, -1, rocker - g4), (6, 6, 1, -g4)):  # fmt: skip
        left[row : row + 2, column : column + 2] += sign * np.eye(2)
        left[row + 2, column : column + 2] += np.multiply(sign, moment(arm))
    left[2, 8] = 1
    found = np.linalg.solve(left, right)
    return {"forces": np.hypot(found[:8:2], found[1:8:2]), "torque": found[8:], "rates": np.array([w3, w4, a3, a4])}


def test_a_four_bar_with_masses_has_the_forces_of_newton_and_euler() -> None:
    columns, expected = entered("en_hw6_fourbar").columns_at([60.0]), _four_bar_at_60_degrees()
    kinds = ("link_angular_velocity", "link_angular_acceleration")
    rates = [float(columns[f"{kind}.{link}"][0]) for kind in kinds for link in ("coupler", "rocker")]
    assert rates == pytest.approx(expected["rates"], rel=1e-9)
    assert [float(columns[f"joint_force.{pin}"][0]) for pin in ("O2", "A", "B", "O4")] == pytest.approx(
        expected["forces"], rel=1e-9
    )
    assert float(columns["balancing_torque"][0]) == pytest.approx(expected["torque"][0], rel=1e-9)


def test_an_offset_slider_moves_as_its_sheet_writes_it() -> None:
    """The slider at 30 cos q + 100 cos(arcsin((40 - 30 sin q) / 100)), by differences."""
    degrees, step, speed = np.array([15.0, 100.0, 250.0]), 1e-4, 100 * np.pi / 30

    def place(q: np.ndarray) -> np.ndarray:
        return 0.3 * np.cos(q) + np.sqrt(1 - (0.4 - 0.3 * np.sin(q)) ** 2)

    before, here, after = (place(np.radians(degrees) + shift) for shift in (-step, 0, step))
    columns = entered("en_hw6_slider").columns_at(degrees)
    assert columns["point_x.B"] == pytest.approx(here, rel=1e-12)
    assert columns["point_acceleration_x.B"] == pytest.approx(
        (before - 2 * here + after) / step**2 * speed**2, rel=1e-5
    )
    assert columns["point_acceleration_y.B"] == pytest.approx(0, abs=1e-9)


def test_a_slider_crank_without_a_speed_turns_as_its_energy_says() -> None:
    """By Runge-Kutta of J w' = M - J' w^2 / 2 with inertia, spring, dashpot and weights of the sheet."""
    results = entered("en_case1_transient")

    def places(q: complex) -> tuple[complex, complex, complex, complex]:
        # x of the slider, x and y of the middle of the rod, angle of the rod
        across = 0.2 * np.sin(q)
        x = 0.2 * np.cos(q) + np.sqrt(0.25 - across**2)
        return x, (0.2 * np.cos(q) + x) / 2, across / 2, -np.arcsin(across / 0.5)

    def state(q: float) -> tuple[np.ndarray, np.ndarray, float]:
        step = 1e-5
        before, here, after = (np.array(places(q + shift)) for shift in (-step, 0.0, step))
        return (after - before) / (2 * step), (after - 2 * here + before) / step**2, float(here[0])

    mass = np.array([2.0, 3.0, 3.0, 3 * 0.25 / 12])

    def rate(y: np.ndarray) -> np.ndarray:
        first, second, x = state(float(y[0]))
        inertia = 0.04 / 3 + np.sum(mass * first**2)
        force = -10_000 * (x - 0.5) - 1_000 * first[0] * y[1]
        weight = -9.81 * (0.1 * np.cos(y[0]) + 3 * first[2])
        return np.array([y[1], (500 + force * first[0] + weight - np.sum(mass * first * second) * y[1] ** 2) / inertia])

    y, h = np.array([np.radians(30), 0.0]), 5e-4
    for _ in range(4000):
        k1 = rate(y)
        k2 = rate(y + h / 2 * k1)
        k3 = rate(y + h / 2 * k2)
        y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(y + h * k3))
    run = results.listings["transient"].columns
    assert run["crank_angle"][-1] == pytest.approx(y[0] - np.radians(30), rel=1e-5)
    assert run["crank_speed"][-1] == pytest.approx(y[1], rel=1e-4)
    assert [item.value for item in results.assumptions if "crank.speed" in item.keys] == ["1 rad/s"]


def test_a_rod_that_no_sheet_states_is_an_assumption_of_a_thermal_calculation() -> None:
    """L0 of 15 kg and L of 13.5 kg; 1.998 l; the ratio of the rod is told."""
    results = entered("vi_toyota_1rz")
    assert results["air_mass_needed"] == pytest.approx(15, abs=0.1)
    assert results["displacement"] == pytest.approx(1.998e-3, abs=5e-7)
    assert results["fuel_heating_value"] == pytest.approx(10400 * 4186.8, rel=1e-12)
    assert [item.value for item in results.assumptions if "rod.ratio" in item.keys] == [0.25]


def test_a_two_stage_compressor_has_the_work_of_its_stages() -> None:
    """Areas of both diagrams by their polytropes; the stages differ in bore, piston and clearance."""
    results, n = entered("uk_compressor"), 1.35
    for name, bore, clearance, low, high in (("1", 0.12, 45e-6, 1e5, 3e5), ("2", 0.075, 18e-6, 3e5, 9e5)):
        swept = np.pi * bore**2 / 4 * 0.08
        drawn = swept + clearance - clearance * (high / low) ** (1 / n)
        work = n / (n - 1) * low * drawn * ((high / low) ** ((n - 1) / n) - 1)
        assert results[f"indicated_work.cylinder_{name}"] == pytest.approx(-work, rel=1e-9)
    # with the same piston the second stage would have 2.55 kg
    masses = {body.link: body.mass for body in results.machine.mechanism.bodies if body.link.startswith("piston")}
    assert masses == pytest.approx({"piston_1": 2.5, "piston_2": 2.0})


def test_a_sheet_without_masses_or_speed_is_asked_for_what_is_missing(tmp_path: Path) -> None:
    with pytest.raises(crankwork.InputError, match=r"crank\.speed: is missing"):
        _changed(tmp_path, ('speed = "960 об/хв"\n', ""), name="uk_compressor")


@for_each(
    ("changes", "message"),
    [
        ((("[gas]\n", '[cylinder]\nbore = "0,1 м"\n[gas]\n'),), "engine.bores: says the same as cylinder.bore"),
        ((('bores = ["0,12 м", "0,075 м"]', 'bores = ["0,12 м"]'),), "engine.bores"),
        ((('pressures = "absolute"\n', ""), ('ambient = "0,1 МПа"\n', "")), "gas.cylinders.1.valves"),
    ],
)
def test_sizes_of_cylinders_that_contradict_others_are_refused(
    tmp_path: Path, changes: tuple[tuple[str, str], ...], message: str
) -> None:
    with pytest.raises(crankwork.InputError, match=message):
        _changed(tmp_path, *changes, name="uk_compressor")


def test_two_static_forces_balance_by_both_ways() -> None:
    """Virtual work of 5600 and 2200 N at the pistons, without masses, against the joint forces."""
    results = entered("vi_vengine")
    degrees = np.arange(0.0, 360.0, 45.0)
    columns = results.columns_at(degrees)
    power = 5600 * columns["slider_velocity.piston_1"] + 2200 * columns["slider_velocity.piston_2"]
    assert np.abs(columns["balancing_torque"] * 60 * np.pi) == pytest.approx(np.abs(power), rel=1e-9, abs=1e-6)
    assert results["mean_torque"] == pytest.approx(0, abs=1e-9)
    # plans stand at the eight positions of the sheet
    assert list(positions(results.machine)[:8]) == list(degrees)


def test_a_weight_in_newtons_of_any_alphabet_has_the_gravity_of_the_sheet(tmp_path: Path) -> None:
    results = _changed(
        tmp_path, ('mass = "0.8 kg"', 'mass = "30 Н"'), ("[engine]", '[method]\ngravity = "10 m/s2"\n[engine]')
    )
    assert results["reciprocating_mass"] == pytest.approx(3.3, rel=1e-12)
    assert not [item for item in results.without_effect if item.key == "method.gravity"]


def test_a_note_of_a_cycle_without_masses_is_written() -> None:
    note = crankwork.note_of(entered("vi_toyota_1rz"))
    assert note


def test_pressures_without_angles_are_those_of_a_file_with_them(tmp_path: Path) -> None:
    """The same numbers as a list in a file, as a list in the machine file and as two columns."""
    pressures = [
        round(0.05 + 3.5 * float(np.exp(-((((angle + 180) % 720 - 360) / 45) ** 2))), 3) for angle in range(0, 720, 5)
    ]
    (tmp_path / "list.txt").write_text(
        "p, МПа\n" + "\n".join(f"{value}".replace(".", ",") for value in pressures), encoding="utf-8"
    )
    rows = [f"{(180 + 5 * index)},{value}" for index, value in enumerate(pressures)]
    (tmp_path / "table.csv").write_text("angle,pressure\n" + "\n".join(rows), encoding="utf-8")
    spaced = 'start = "180 deg"\nstep = "5 deg"\n'
    tables = ('file = "table.csv"', f'{spaced}file = "list.txt"', f"{spaced}values = {pressures}")
    gas = '[gas]\ncycle = "720 deg"\n[gas.measured]\npressure_unit = "MPa"\n'
    results = list[crankwork.Results]()
    for table in tables:
        text = (HERE / "assignments" / "ru_kshm_delphi.toml").read_text(encoding="utf-8")
        (tmp_path / "machine.toml").write_text(
            text[: text.index("[gas]")] + gas + table + "\n" + text[text.index("[method]") :], encoding="utf-8"
        )
        results.append(crankwork.analyse(crankwork.read(tmp_path / "machine.toml")))
    first, *others = (np.asarray(result["gas_pressure"]) for result in results)
    assert all(np.array_equal(first, other) for other in others)


@for_each(
    ("old", "new", "key", "value"),
    [
        ("excess_air = 0.9", 'excess_air = "90 %"', "excess_air", 0.9),
        ('heating_value = "10400 kcal/kg"', 'heating_value = "43 542,72 kJ/kg"', "fuel_heating_value", 43.54272e6),
    ],
)
def test_numbers_are_read_as_sheets_print_them(tmp_path: Path, old: str, new: str, key: str, value: float) -> None:
    comma = ("format = 2\n", 'format = 2\ndecimal_mark = ","\n')
    assert _changed(tmp_path, (old, new), comma, name="vi_toyota_1rz")[key] == pytest.approx(value, rel=1e-12)


def test_a_percentage_of_a_percentage_is_no_share(tmp_path: Path) -> None:
    results = _changed(tmp_path, ('fluctuation = "1/50"', 'percent = "1 %"'), name="uk_compressor")
    assert results["speed_fluctuation"] == pytest.approx(0.02, rel=1e-9)


def test_a_firing_order_stands_as_sheets_write_it(tmp_path: Path) -> None:
    orders = [_changed(tmp_path, ("[1, 3, 4, 2]", order)) for order in ("[1, 3, 4, 2]", '"1-3-4-2"', '"1 – 3 – 4 – 2"')]
    assert len({results.machine.engine.layout.firing_order for results in orders if results.machine.engine}) == 1


def test_headings_with_other_letters_are_answered_with_their_quotation_marks(tmp_path: Path) -> None:
    with pytest.raises(crankwork.InputError, match=re.escape('write [links."шатун"]')):
        _changed(tmp_path, ("[links.rod]", "[links.шатун]"), name="en_case1_transient")


def test_a_slot_begins_where_its_lever_does() -> None:
    text = crankwork.template("crank-shaper")
    named = text.replace('slot = { link = "lever" }', 'slot = { link = "lever", through = "B" }')
    assert named != text
    plain, other = (crankwork.analyse(crankwork.read_machine(source)) for source in (text, named))
    assert other.summary == plain.summary
