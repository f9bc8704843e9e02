"""Assignments entered as their sheets state them; the folder `assignments` has the files, each with its source."""

from dataclasses import replace
from functools import cache
from math import log
from pathlib import Path

import numpy as np
import pytest

import crankwork
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
        ((('school = "vi"', 'school = "vi"\ntotal_volume = "400 cm3"'),), "total_volume stands beside"),
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
