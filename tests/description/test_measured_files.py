"""Measured pressure as test benches and programs write it: read rightly, or asked about with the words to write."""

from __future__ import annotations

import math

import numpy as np
import pytest

import crankwork
from crankwork.errors import InputError
from crankwork.kinematics.crank_grid import Array
from each import for_each

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
    assert 'write pressure_column = "p_800 rpm", or "2..12" if each of them is a cycle' in message
    assert is_right(read(text, 'pressure_unit = "bar"\npressure_column = "p_4800 rpm"'))
    assert is_right(read(text, 'pressure_unit = "bar"\npressure_column = 12'))


def test_many_columns_without_headings_are_asked_about(read):
    with pytest.raises(InputError) as caught:
        read(table(ANGLES, BAR / 2, BAR))
    of_angle, of_pressure = (problem.message for problem in caught.value.problems)
    assert "line 1: 3 columns without headings; write angle_column = 1" in of_angle
    assert "line 1: 3 columns without headings; write pressure_column = 3" in of_pressure
    keys = 'pressure_unit = "bar"\nangle_column = 1'
    assert "write pressure_column = 3, the number" in refusal(read, table(ANGLES, BAR / 2, BAR), keys)
    assert is_right(read(table(ANGLES, BAR / 2, BAR), f"{keys}\npressure_column = 3"))


def test_the_only_columns_of_their_units_are_taken_and_named(read):
    text = "t [s]\tphi [°CA]\tV [cm3]\tp [bar]\n" + table(ANGLES / 18000, ANGLES, ANGLES, BAR)
    results = read(text, "")
    assert is_right(results)
    assert told(results)["measured_columns_taken"] == {"angle": '2 ("phi [°CA]")', "pressure": '4 ("p [bar]")'}
    assert told(results)["measured_units_of_file"] == {"units": "deg, bar"}


def test_units_that_contradict_the_machine_file_are_told(read):
    results = read("phi [deg]\tp [MPa]\n" + table(ANGLES, BAR))
    assert told(results)["measured_other_unit"] == {
        "column": '2 ("p [MPa]")', "unit": "MPa", "stated": "bar", "name": "pressure_unit",
    }  # fmt: skip
    assert is_right(results)


@for_each("heading", ["phi [deg]\tp [bar(a)]\n", "phi\tp\ndeg\tbara\n", "phi, deg\tp abs, bar\n"])
def test_pressures_are_counted_as_the_heading_says_where_the_machine_file_does_not(read, heading):
    text = heading + table(ANGLES, BAR)
    assert told(read(text, ""))["measured_reference_used"] == {"reference": "absolute"}
    assert peak(read(text, "")) == pytest.approx(41 - 1.01325, rel=2e-3)
    assert not {"measured_reference", "measured_reference_used"} & set(told(read(text, "", ABSOLUTE)))
    gauge = MACHINE.replace('cycle = "720 deg"', 'cycle = "720 deg"\npressures = "gauge"')
    assert told(read(text, "", gauge))["measured_reference"] == {"reference": "absolute", "stated": "gauge"}


@for_each("heading", ["", "phi [deg]\tp [bar]\n"])
@for_each("turns", [1, 2])
def test_radians_taken_for_degrees_are_told(read, heading, turns):
    machine = MACHINE.replace("720 deg", f"{360 * turns} deg")
    angles = np.radians(ANGLES[: 360 * turns])
    text = heading + table(angles, BAR[: 360 * turns])
    message = refusal(read, text, 'pressure_unit = "bar"', machine)
    assert 'which are whole turns in rad; write angle_unit = "rad"' in message
    assert read(text, 'pressure_unit = "bar"\nangle_unit = "rad"\nshift = "0 deg"', machine)


def test_many_cycles_in_radians_are_radians(read):
    angles = np.radians(np.arange(0.0, 720.0 * 12 + 100, 3.0))
    samples = true_pressure(np.degrees(angles))
    results = read(table(angles, samples), 'pressure_unit = "bar"\nangle_unit = "rad"\ncycle = "mean"')
    assert math.isclose(peak(results), 41, rel_tol=0.01)


ABSOLUTE = MACHINE.replace('cycle = "720 deg"', 'cycle = "720 deg"\npressures = "absolute"\nambient = "1 bar"')
MEAN = 'pressure_unit = "bar"\ncycle = "mean"'
SHARES = np.array([0.9, 1.0, 1.1])


def stacked(*, anew: bool, last: bool = False) -> str:
    """Return three cycles one below the other, whose angles run on or begin anew, with their last sample or not."""
    angles = np.arange(0.0, 721.0 if last else 720.0)
    cycles = [(angles + (0 if anew else 720 * k), share * true_pressure(angles)) for k, share in enumerate(SHARES)]
    return "".join(table(*one) for one in cycles)


STACKED = {
    "running on": (stacked(anew=False), ""),
    "beginning anew": (stacked(anew=True), ""),
    "beginning anew, with the last sample": (stacked(anew=True, last=True), ""),
    "from the middle": (table(np.tile(ANGLES - 360, 3), np.concatenate([BAR * one for one in SHARES])), "360"),
    "side by side": (table(ANGLES, *(BAR * one for one in SHARES)), 'angle_column = 1\npressure_column = "2..4"'),
}


@pytest.mark.slow
@for_each(("text", "keys"), STACKED.values(), ids=STACKED)
def test_cycles_are_told_apart_however_they_stand(read, text, keys):
    keys = 'shift = "360 deg"' if keys == "360" else keys
    unit = f'pressure_unit = "bar"\n{keys}\n'
    message = refusal(read, text, unit)
    assert '3 cycles were recorded; write cycle = "mean", cycle = 1 or another number' in message
    chosen = {'"mean"': 41.0, "1": 36.9, "3": 45.1, '"greatest peak"': 45.1, '"least peak"': 36.9}
    for cycle, expected in chosen.items():
        results = read(text, f"{unit}cycle = {cycle}")
        assert peak(results) == pytest.approx(expected, rel=2e-3)
        spread = told(results)["cycles_spread"]
        assert spread["cycles"] == 3
        assert spread["peak"] == pytest.approx(10.0, rel=1e-6)
        assert spread["work"] == pytest.approx(10.0, rel=1e-6)
    assert "there is no cycle 4; recorded are 3" in refusal(read, text, f"{unit}cycle = 4")


TURN = np.arange(360.0)
BY_TURNS = {
    "0 to 360 twice": (np.tile(TURN, 2), 0),
    "with the last sample": (np.tile(np.arange(361.0), 2), 0),
    "-180 to 180 twice": (np.tile(TURN - 180, 2), -180),
    "from before to after": (np.arange(-360.0, 360.0), -360),
    "after, and then before": (np.concatenate([TURN, TURN - 360]), 0),
}


@for_each(("angles", "start"), BY_TURNS.values(), ids=BY_TURNS)
def test_angles_that_begin_anew_within_a_cycle_run_on(read, angles, start):
    turn = np.concatenate([[0], np.cumsum(np.diff(angles) < 0)])
    is_by_turns = turn[-1] > 0 and angles.min() != -360
    true = angles + 360 * turn if is_by_turns else angles
    results = read(table(angles, true_pressure(true)))
    assert is_right(results)
    assert results.value("gas_pressure", 372) == pytest.approx(41e5, rel=1e-4)
    assert ("measured_turns" in told(results)) == is_by_turns
    if is_by_turns:
        assert told(results)["measured_turns"] == {"file": "p.txt", "name": "gas.measured"}
        shifted = read(table(angles, true_pressure(true - 360)), 'pressure_unit = "bar"\nshift = "360 deg"')
        assert shifted.value("gas_pressure", 372) == pytest.approx(41e5, rel=1e-4)


def test_cycles_of_turns_are_counted_and_asked_about(read):
    text = table(np.tile(TURN, 6), np.concatenate([BAR * one for one in SHARES]))
    assert "3 cycles were recorded" in refusal(read, text)
    assert peak(read(text, 'pressure_unit = "bar"\ncycle = 3')) == pytest.approx(45.1, rel=2e-3)
    two_strokes = MACHINE.replace("720 deg", "360 deg")
    doubled = table(np.tile(np.arange(720.0), 2), np.tile(true_pressure(360 + TURN), 4))
    assert "4 cycles were recorded" in refusal(read, doubled, 'pressure_unit = "bar"', two_strokes)


def test_what_is_done_to_samples_is_explained(read):
    explained = read(STACKED["running on"][0], MEAN).explain("gas_pressure", at=33.0)
    assert "gas.measured.cycle" in str(explained)


CLOSED = np.arange(180.0, 540.0)


@pytest.mark.slow
@for_each("times", [1, 3])
def test_a_closed_period_needs_a_pressure_for_the_rest(read, times):
    text = table(np.tile(CLOSED, times), np.tile(true_pressure(CLOSED), times))
    message = refusal(read, table(CLOSED, true_pressure(CLOSED)), MEAN)
    assert "the samples cover 359 deg; one cycle is 720 deg" in message
    assert 'rest_pressure = "1 bar"' in message
    results = read(text, f'{MEAN}\nrest_pressure = "1.1 bar"')
    assert is_right(results)
    found = results.columns_at(np.array([100.0, 372.0, 600.0]), ("gas_pressure",))["gas_pressure"]
    assert found == pytest.approx([1.1e5, 41e5, 1.1e5])
    assert "cycles_averaged" not in told(results) or told(results)["cycles_averaged"] == {"cycles": times}


def test_a_spike_is_told_with_its_line(read):
    spiked = np.where(np.arange(720) == 50, 1e9, BAR)
    assert "line 51: 1e+08 MPa is no pressure of a gas" in refusal(read, table(ANGLES, spiked), MEAN)
    values = told(read(table(ANGLES, np.where(np.arange(720) == 50, 20.0, BAR)), MEAN))["pressure_spike"]
    assert values == {"line": "51", "step": 2e6, "count": 1.0}
    assert "pressure_spike" not in told(read(table(ANGLES, BAR), MEAN))


def test_pegging_at_an_angle_recovers_an_offset(read):
    results = read(table(ANGLES, BAR - 3.7), f'{MEAN}\npeg = {{ angle = "180 deg", pressure = "{BAR[180]:.6f} bar" }}')
    assert told(results)["pressure_pegged"]["step"] == pytest.approx(3.7e5, abs=20)
    assert is_right(results)


def volume(degrees: Array) -> Array:
    """Return the volume above the piston as a share of the swept one."""
    angle, ratio = np.radians(degrees), 45 / 160
    moved = 1 - np.cos(angle) + (1 - np.sqrt(1 - (ratio * np.sin(angle)) ** 2)) / ratio
    return np.asarray(1 / 8 + moved / 2)


def motored(degrees: Array, exponent: float = 1.34) -> Array:
    """Return a pressure that is compressed and expanded around 360 degrees, and 1 bar elsewhere. [bar]"""
    closed = np.abs(degrees - 360) < 180
    return np.asarray(np.where(closed, (volume(np.array([180.0])) / volume(degrees)) ** exponent, 1.0))


def test_pegging_to_an_exponent_recovers_an_offset(read):
    peg = 'peg = { exponent = 1.34, from = "250 deg", to = "320 deg" }'
    text = table(ANGLES, motored(ANGLES) + 0.43)
    results = read(text, f"{MEAN}\n{peg}", ABSOLUTE)
    assert told(results)["pressure_pegged"]["step"] == pytest.approx(-0.43e5, abs=20)
    assert 'pressures = "gauge"' in refusal(read, text, f"{MEAN}\n{peg}")


def test_without_a_clearance_no_exponent_is_asked_for_or_told(read):
    machine = ABSOLUTE.replace("compression_ratio = 9.0", "")
    text = table(ANGLES, motored(ANGLES, 1.7))
    message = refusal(read, text, f'{MEAN}\npeg = {{ exponent = 1.34, from = "250 deg", to = "320 deg" }}', machine)
    assert "compression_ratio" in message
    assert not {"exponent_odd", "dead_centre_compression"} & set(told(read(text, MEAN, machine)))


def test_chambers_of_linkages_have_measured_cycles_too(tmp_path):
    (tmp_path / "p.txt").write_text(table(np.arange(1080.0), 5 + np.cos(np.radians(np.arange(1080.0)))))
    machine = """
[fixed_points]
O = ["0 mm", "0 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "40 mm"
speed = "600 rpm"
[guides]
bed = { through = "O" }
[links]
rod = { joins = ["A", "B"], length = "200 mm" }
[sliders]
piston = { guide = "bed", pin = "B" }
[chambers.gas]
slider = "piston"
area = "20 cm2"
sense = -1
[chambers.gas.measured]
file = "p.txt"
pressure_unit = "bar"
cycle = 2
peg = { angle = "0 deg", pressure = "4 bar" }
"""
    results = crankwork.analyse(crankwork.read_machine(machine, folder=tmp_path))
    assert told(results)["pressure_pegged"]["step"] == pytest.approx(-2e5)
    assert told(results)["cycle_chosen"] == {"number": 2.0, "cycles": 3.0}
    expected = [4e5, 3e5, 2e5]
    assert results.columns_at(np.array([0.0, 90.0, 180.0]), ("gas_pressure.gas",))["gas_pressure.gas"] == pytest.approx(
        expected
    )


LINKAGE = """
[fixed_points]
O = ["0 mm", "0 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "45 mm"
speed = "3000 rpm"
start = "90 deg"
direction = "clockwise"
[guides]
bed = { through = "O", angle = "90 deg" }
[links]
rod = { joins = ["A", "B"], length = "160 mm" }
[sliders]
piston = { guide = "bed", pin = "B" }
[chambers.gas]
slider = "piston"
bore = "85 mm"
sense = -1
compression_ratio = 9.0
period = "720 deg"
pressures = "absolute"
[chambers.gas.measured]
file = "p.txt"
"""


def test_a_chamber_of_a_linkage_says_of_its_dead_centre_what_an_engine_says(read):
    angles = np.arange(0.0, 720.0, 0.5)
    keys = f'{MEAN}\nloss_angle = "0.6 deg"\n'
    text = table(angles, motored(np.mod(angles + 2.6, 720)))
    engine, chamber = (told(read(text, keys, machine)) for machine in (ABSOLUTE, LINKAGE))
    assert chamber["dead_centre_motored"].pop("name") == "chambers.gas.measured"
    assert engine["dead_centre_motored"].pop("name") == "gas.measured"
    assert chamber["dead_centre_motored"] == pytest.approx(engine["dead_centre_motored"], rel=1e-6)
    assert chamber["dead_centre_motored"]["shift"] == pytest.approx(2.0, abs=0.05)
    fired = table(angles, motored(np.mod(angles + 4, 720)) * (1 + 1.5 / (1 + np.exp(-(angles - 366) / 6))))
    engine, chamber = (told(read(fired, MEAN, machine)) for machine in (ABSOLUTE, LINKAGE))
    assert chamber["dead_centre_compression"]["shift"] == engine["dead_centre_compression"]["shift"]
    far = table(ANGLES, true_pressure(ANGLES + 187))
    message = refusal(read, far, MEAN, LINKAGE)
    assert "chambers.gas.measured: p.txt, the greatest pressure stands at 545 deg" in message
    assert 'top dead centre is at 0 deg; write shift = "180 deg", or shift = "0 deg" if the angles are right' in message
    assert "peak_far" in told(read(far, f'{MEAN}\nshift = "0 deg"', LINKAGE))


def test_smoothing_says_what_it_changed(read):
    noise = np.random.default_rng(5).normal(0, 0.4, len(ANGLES))
    results = read(table(ANGLES, 5 + BAR + noise), f'{MEAN}\nsmooth = "15 deg"')
    values = told(results)["pressure_smoothed"]
    assert values["window"] == pytest.approx(15.0)
    assert abs(values["after"] - 4.6) < abs(values["before"] - 4.6)
    found = results.columns_at(ANGLES, ("gas_pressure",))["gas_pressure"] / 1e5 - 5 - BAR
    # a cubic through fifteen samples leaves the root of 0.167 of the noise
    assert 0.8 < np.std(found) / (0.4 * math.sqrt(0.167)) < 1.2


def test_smoothing_asks_for_even_angles_and_a_wide_window(read):
    uneven = np.concatenate([np.arange(0.0, 300.0), np.arange(300.0, 420.0, 0.5), np.arange(420.0, 720.0)])
    text = table(uneven, true_pressure(uneven))
    assert 'write resample = "1 deg" too' in refusal(read, text, f'{MEAN}\nsmooth = "9 deg"')
    assert is_right(read(text, f'{MEAN}\nsmooth = "9 deg"\nresample = "1 deg"'))
    assert 'write smooth = "4 deg" or more' in refusal(read, text, f'{MEAN}\nsmooth = "2 deg"\nresample = "1 deg"')


@for_each(("shift", "seed"), [(-2.0, 1), (-0.7, 2), (0.9, 3), (3.0, 1)])
def test_a_motored_cycle_proposes_the_shift_that_it_needs(read, shift, seed):
    """The peak of the true cycle is 0.6 degrees early; what the recorder counts is late by the shift."""
    angles = np.arange(0.0, 720.0, 0.5)
    noise = np.random.default_rng(seed).normal(0, 0.02, len(angles))
    text = table(angles, motored(np.mod(angles + 0.6 + shift, 720)) + noise)
    keys = f'{MEAN}\nloss_angle = "0.6 deg"\n'
    values = told(read(text, keys))["dead_centre_motored"]
    assert values["error"] < 0.3
    assert abs(values["shift"] - shift) < values["error"]
    assert "dead_centre_motored" not in told(read(text, f'{keys}shift = "{shift} deg"'))


@for_each("shift", [-4.0, 4.0])
def test_a_compression_line_proposes_a_shift_with_an_honest_uncertainty(read, shift):
    angles = np.arange(0.0, 720.0, 0.5)
    fired = motored(np.mod(angles + shift, 720)) * (1 + 1.5 / (1 + np.exp(-(angles + shift - 370) / 6)))
    values = told(read(table(angles, fired), MEAN, ABSOLUTE))["dead_centre_compression"]
    assert abs(values["shift"] - shift) < values["error"]
    assert 0.3 < values["error"] < 4
    assert "dead_centre_compression" not in told(read(table(angles, fired), f'{MEAN}\nshift = "{shift} deg"', ABSOLUTE))


def test_a_peak_at_zero_is_said_to_be_there(read):
    rows = table(ANGLES, true_pressure(ANGLES + 372)).split("\n")
    message = refusal(read, "\n".join([rows[0], "1e-8\t42", *rows[1:]]), MEAN)
    assert "the greatest pressure stands at 0 deg of the cycle, and firing is at 360 deg" in message


def test_a_peak_far_from_top_dead_centre_is_told(read):
    text = table(ANGLES, true_pressure(ANGLES + 187))
    message = refusal(read, text, MEAN)
    assert (
        'the greatest pressure stands at 185 deg of the cycle, and firing is at 360 deg; write shift = "180' in message
    )
    assert 'or shift = "0 deg" if the angles are right' in message
    values = told(read(text, f'{MEAN}\nshift = "0 deg"'))["peak_far"]
    assert (values["angle"], values["apart"]) == (pytest.approx(185), pytest.approx(175))
    assert values["shift"] == 180


def test_negative_work_and_odd_exponents_are_told(read):
    early = table(ANGLES, true_pressure(ANGLES + 30))
    assert "write reversed = true if the file counts against the rotation" in refusal(read, early, MEAN)
    assert "work_negative" in told(read(early, f'{MEAN}\nshift = "0 deg"'))
    odd = table(ANGLES, motored(ANGLES, 1.7))
    assert told(read(odd, MEAN, ABSOLUTE))["exponent_odd"]["exponent"] == pytest.approx(1.7, abs=1e-3)
    right = table(ANGLES, motored(ANGLES) * np.where(ANGLES > 361, 1.5, 1))
    assert not {"work_negative", "exponent_odd", "peak_far"} & set(told(read(right, MEAN, ABSOLUTE)))


KG = BAR / 0.980665
AWKWARD = {
    "words and units before the numbers": (
        "Engine test 14.03.2019\nSpeed: 3000 rpm, load 80 %\n\nCrank angle\tCylinder pressure\n[°CA]\t[bar]\n"
        + table(ANGLES, BAR), ""),
    "an old encoding": (
        ("Kurbelwinkel [°KW];Zylinderdrücke [bar]\n" + table(ANGLES, BAR, separator=";")).encode("latin-1"), ""),
    "another old encoding": (
        ("Угол ПКВ, град;Давление, кгс/см2\n" + table(ANGLES, KG, separator=";", mark=",")).encode("cp1251"), ""),
    "decimal commas": ("phi;p\n" + table(ANGLES, BAR, separator=";", mark=","), 'pressure_unit = "bar"'),
    "as Excel saves Unicode": (("Góc (độ)\tÁp suất (bar)\n" + table(ANGLES, BAR, mark=",")).encode("utf-16"), ""),
    "a program's preamble": (
        "Program 4.3.0\nEngine = D-245, 4 cylinders\nRPM = 3000\nBore, mm = 85; Stroke, mm = 90\n==========\n"
        " CA,deg    p,bar     T,K\n" + table(ANGLES, BAR, 300 + BAR, separator="   "), ""),
    "a trailing tab": ("phi [deg]\tp [bar]\t\n" + table(ANGLES, BAR, end="\t"), ""),
    "columns the other way round": ("p [kPa]\tphi [deg]\n" + table(100 * BAR, ANGLES), ""),
    "kp/cm2": ("CA [deg]\tp [kp/cm2]\n" + table(ANGLES, BAR / 0.980665), ""),
    "mmHg": ("CA [deg]\tp [mmHg]\n" + table(ANGLES, BAR / 133.322387415e-5), ""),
    "Torr": ("CA [deg]\tp [Torr]\n" + table(ANGLES, BAR / (1.01325 / 760)), ""),
    "derivatives by the angle, as Diesel-RK writes them": (
        " DIESEL-RK  results\n Engine: 4T  D=85\n --------\n  CA  V  P  T  dQ/dx\n  deg  cm3  bar  K  1/deg\n"
        + table(ANGLES, 1e3 + ANGLES, BAR, 300 + ANGLES, 0 * ANGLES, separator="  "), ""),
    "rows numbered": ("No\tphi [deg]\tp [bar]\n" + table(np.arange(720.0), ANGLES, BAR), ""),
    "time, volume and temperature beside": (
        "t, s;phi, deg;V, cm3;p, MPa;T, K\n" + table(ANGLES, ANGLES, ANGLES, BAR / 10, ANGLES, separator=";"), ""),
}  # fmt: skip


@for_each(("content", "keys"), AWKWARD.values(), ids=AWKWARD)
def test_awkward_files_are_read_rightly(read, content, keys):
    results = read(content, keys)
    assert is_right(results)
    assert results.columns_at(np.array([372.0]), ("gas_pressure",))["gas_pressure"] == pytest.approx(41e5, rel=1e-6)


RADIANS = 'pressure_unit = "bar"\nangle_unit = "rad"'
LOW = np.where(np.arange(720) == 50, -1.2, 0.0)
COMMAS = "\n".join(f"{round(one)},0,{one % 7:.3f}".replace(".", ",") for one in ANGLES)
ALIKE = np.tile(true_pressure(360 + TURN), 2) * np.repeat([1, 0.8], 360)
REFUSED = {
    "time for an angle": ("t [s]\tp [bar]\n" + table(ANGLES / 18000, BAR), MEAN, MACHINE,
        ['column 1 ("t [s]") is in s, which is not what angle_column wants']),
    "no unit": ("phi\tp\n" + table(ANGLES, BAR), "", MACHINE,
        ["gas.measured.pressure_unit: is missing; write pressure_unit"]),
    **{f"degrees for radians, {step}": (table(np.arange(0, 720 + step / 2, step), np.arange(0, 720 + step / 2, step)),
        RADIANS, MACHINE, ['the angle runs 720 rad, which are whole turns in deg; write angle_unit = "deg"'])
       for step in (0.1, 1.0, 10.0)},
    "turns that are alike": (table(np.tile(TURN, 2), ALIKE), 'pressure_unit = "bar"', MACHINE,
        ["line 361: the angle begins anew with a turn, and the pressures of both turns are alike",
         'write a cycle of "360 deg" if each turn is one']),
    "a rest of nothing": (table(ANGLES, BAR), f'{MEAN}\nrest_pressure = "1 bar"', MACHINE,
        ["rest_pressure is for what is left"]),
    "noise below vacuum": (table(ANGLES, BAR + LOW), MEAN, ABSOLUTE,
        ["line 51: the pressure is below vacuum; correct it, peg or smooth it"]),
    "noise below vacuum, gauge": (table(ANGLES, BAR + 2 * LOW), MEAN, MACHINE,
        ["line 51: a gauge pressure of -0.14 MPa is below vacuum"]),
    "commas in and between numbers": (f"CA,p\n{COMMAS}\n", MEAN, MACHINE,
        ["the comma stands in the numbers and between the columns; export with semicolons"]),
    "volts": ("CA [deg]\tp [V]\n" + table(ANGLES, BAR / 10), "", MACHINE,
        ['column 2 ("p [V]") is in "V", which is not known here; convert its numbers, or write pressure_']),
    "tenths of degrees": ("CA [1/10 deg]\tp [bar]\n" + table(10 * ANGLES, BAR), "", MACHINE,
        ['column 1 ("CA [1/10 deg]") is in "1/10 deg"']),
}  # fmt: skip


@for_each(("content", "keys", "machine", "words"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_meant_is_refused_with_what_to_write(read, content, keys, machine, words):
    message = refusal(read, content, keys, machine)
    assert [one for one in words if one not in message] == [], message


def test_commas_that_may_part_thousands_are_asked_about(read):
    rows = "\n".join(f"{angle:.0f};{round(1e5 * bar) // 1000},{round(1e5 * bar) % 1000:03d}"
                     for angle, bar in zip(ANGLES, BAR / 10, strict=True))  # fmt: skip
    said = refusal(read, f"CA [deg];p [Pa]\n{rows}\n", "")
    assert 'if it parts thousands, export without it, and if it is the decimal mark, write decimal_mark = ","' in said
    # with the words that are told
    assert peak(read(f"CA [deg];p [Pa]\n{rows}\n", 'shift = "0 deg"', 'decimal_mark = ","\n' + MACHINE)) < 0.01
    assert is_right(read("CA [deg]\tp [bar]\n" + table(ANGLES, BAR, mark=","), ""))


def test_one_low_sample_among_low_ones_is_told(read):
    low = np.where(ANGLES == 250, 0.0, BAR + 0.4)
    assert told(read(table(ANGLES, low)))["pressure_spike"]["line"] == "251"
    noise = np.random.default_rng(2).normal(0.0, 0.02, ANGLES.size)
    assert "pressure_spike" not in told(read(table(ANGLES, BAR + noise)))
