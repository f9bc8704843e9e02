"""Measured pressure as test benches and programs write it: read rightly, or asked about with the words to write."""

from __future__ import annotations

import math

import numpy as np
import pytest

import crankwork
from crankwork.errors import InputError
from crankwork.kinematics.crank_grid import Array

MACHINE = """
[crank]
radius = "45 mm"
speed = "3000 rpm"
[rod]
length = "160 mm"
[cylinder]
bore = "85 mm"
compression_ratio = 9.0
[gas]
cycle = "720 deg"
[gas.measured]
file = "p.txt"
"""
ANGLES = np.arange(0.0, 720.0, 1.0)


def true_pressure(degrees: Array) -> Array:
    """Return a smooth pressure of period 720 degrees with its peak of 41 bar at 372. [bar]"""
    return np.asarray(1 + 40 * np.exp(12 * (np.cos(np.radians(degrees - 372) / 2) - 1)))


BAR = true_pressure(ANGLES)


def table(*columns: Array, separator: str = "\t", mark: str = ".", end: str = "") -> str:
    """Return rows of columns as a program writes them."""
    rows = (separator.join(f"{one:.6f}" for one in row) for row in zip(*columns, strict=True))
    return "\n".join(row.replace(".", mark) + end for row in rows) + "\n"


@pytest.fixture
def read(tmp_path):
    """Return what a machine file says about a pressure file: its results, or its mistakes."""

    def reading(content: str | bytes, keys: str = 'pressure_unit = "bar"', machine: str = MACHINE):
        (tmp_path / "p.txt").write_bytes(content if isinstance(content, bytes) else content.encode())
        return crankwork.analyse(crankwork.read_machine(machine + keys, folder=tmp_path))

    return reading


def peak(results) -> float:
    return float(np.max(results["gas_pressure"])) / 1e5


def told(results) -> dict:
    return {one.code: one.values for one in results.notices}


def refusal(read, *given: str) -> str:
    with pytest.raises(InputError) as caught:
        read(*given)
    (problem,) = caught.value.problems
    return f"{problem.key}: {problem.message}"


def is_right(results) -> bool:
    return peak(results) == pytest.approx(41.0, rel=2e-3)


def test_twelve_columns_are_asked_about(read):
    speeds = "\t".join(f"p_{speed} rpm" for speed in range(800, 5200, 400))
    text = f"Angle\t{speeds}\n" + table(ANGLES, *(BAR * share for share in np.linspace(0.5, 1, 11)))
    message = refusal(read, text)
    assert "p.txt, line 1: say which column is meant" in message
    assert '2 ("p_800 rpm"), 3 ("p_1200 rpm")' in message
    assert 'write pressure_column = "p_800 rpm"' in message
    assert is_right(read(text, 'pressure_unit = "bar"\npressure_column = "p_4800 rpm"'))
    assert is_right(read(text, 'pressure_unit = "bar"\npressure_column = 12'))


def test_many_columns_without_headings_are_asked_about(read):
    message = refusal(read, table(ANGLES, BAR / 2, BAR))
    assert "line 1: 3 columns without headings; write angle_column = 1" in message
    keys = 'pressure_unit = "bar"\nangle_column = 1'
    assert "write pressure_column = 3, the number" in refusal(read, table(ANGLES, BAR / 2, BAR), keys)
    assert is_right(read(table(ANGLES, BAR / 2, BAR), f"{keys}\npressure_column = 3"))


def test_a_trailing_tab_is_no_column(read):
    assert is_right(read(table(ANGLES, BAR, end="\t")))


def test_the_only_columns_of_their_units_are_taken_and_named(read):
    text = "t [s]\tphi [°CA]\tV [cm3]\tp [bar]\n" + table(ANGLES / 18000, ANGLES, ANGLES, BAR)
    results = read(text, "")
    assert is_right(results)
    assert told(results)["measured_columns_taken"] == {"angle": '2 ("phi [°CA]")', "pressure": '4 ("p [bar]")'}
    assert told(results)["measured_units_of_file"] == {"units": "deg, bar"}


def test_columns_the_other_way_round_are_known_by_their_units(read):
    assert is_right(read("p [kPa]\tphi [deg]\n" + table(100 * BAR, ANGLES), ""))


def test_a_column_of_time_is_no_angle(read):
    message = refusal(read, "t [s]\tp [bar]\n" + table(ANGLES / 18000, BAR))
    assert 'column 1 ("t [s]") is in s, which is not what angle_column wants' in message


def test_units_that_contradict_the_machine_file_are_told(read):
    results = read("phi [deg]\tp [MPa]\n" + table(ANGLES, BAR))
    assert told(results)["measured_other_unit"] == {
        "column": '2 ("p [MPa]")', "unit": "MPa", "stated": "bar", "name": "pressure_unit",
    }  # fmt: skip
    assert is_right(results)


def test_units_are_asked_for_where_no_one_states_them(read):
    message = refusal(read, "phi\tp\n" + table(ANGLES, BAR), "")
    assert message.startswith("gas.measured.pressure_unit: is missing; write pressure_unit")


@pytest.mark.parametrize("heading", ["", "phi [deg]\tp [bar]\n"])
@pytest.mark.parametrize("turns", [1, 2])
def test_radians_taken_for_degrees_are_told(read, heading, turns):
    machine = MACHINE.replace("720 deg", f"{360 * turns} deg")
    angles = np.radians(ANGLES[: 360 * turns])
    text = heading + table(angles, BAR[: 360 * turns])
    message = refusal(read, text, 'pressure_unit = "bar"', machine)
    assert 'which are whole turns in rad; write angle_unit = "rad"' in message
    assert read(text, 'pressure_unit = "bar"\nangle_unit = "rad"', machine)


@pytest.mark.parametrize("step", [0.1, 1.0, 10.0])
def test_degrees_taken_for_radians_are_told(read, step):
    angles = np.arange(0.0, 720.0 + step / 2, step)
    text = table(angles, true_pressure(angles))
    message = refusal(read, text, 'pressure_unit = "bar"\nangle_unit = "rad"')
    assert 'over the file the angle runs 720 rad, which are whole turns in deg; write angle_unit = "deg"' in message


def test_many_cycles_in_radians_are_radians(read):
    angles = np.radians(np.arange(0.0, 720.0 * 12 + 100, 3.0))
    samples = true_pressure(np.degrees(angles))
    assert math.isclose(
        peak(read(table(angles, samples), 'pressure_unit = "bar"\nangle_unit = "rad"')), 41, rel_tol=0.01
    )
