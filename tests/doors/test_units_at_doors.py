"""Speeds per second at every door, files, options, studies, Python and the studio; units of the text, and fractions."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import crankwork as package
from crankwork import units
from crankwork.description.schema import NumberOr
from crankwork.description.value_types import Number, Quantity, Reader
from crankwork.studio.session import Session
from each import for_each
from machine_texts import POINTS_ENGINE

SPEED = 'speed = "3000 rpm"'
LINES = 'write speed = "9.42478 rad/s" or speed = "9.42478 rev/s"'
WORDS = {
    "en": LINES,
    "ru": LINES.replace("write", "запишите").replace(" or ", " или "),
    "vi": LINES.replace("write", "hãy ghi").replace(" or ", " hoặc "),
}
STUDY = """
machine = "my.toml"
[vary]
crank.speed = { from = "9.42478 Hz", to = "900 rpm" }
[objectives]
side_force_max = "minimise"
"""


@for_each("unit", ["1/s", "с⁻¹", "Hz", "s^-1"])
@for_each("form", ["1", "2"])
def test_a_speed_per_second_is_asked_about_in_files_and_options(crankwork, check_mistakes, unit, form):
    source = POINTS_ENGINE.replace("format = 2", f"format = {form}")
    Path("my.toml").write_text(source.replace(SPEED, f'speed = "9.42478 {unit}"'), encoding="utf-8")
    for language, words in WORDS.items():
        answer = crankwork("check", "my.toml", "--lang", language)
        check_mistakes(answer)
        assert words in answer.mistakes[0]
    Path("my.toml").write_text(source, encoding="utf-8")
    setting = crankwork("check", "my.toml", "--set", f"crank.speed=9.42478 {unit}").err
    assert setting.startswith("--set crank.speed: ")
    assert LINES in setting
    search = crankwork("solve", "my.toml", "piston_force@33deg = 0", "--for", "crank.speed", "--from", f"9 {unit}")
    assert 'write "9 rad/s" or "9 rev/s"' in search.err
    Path("study.toml").write_text(STUDY, encoding="utf-8")
    assert LINES.replace("speed =", "from =") in crankwork("optimise", "study.toml", "-o", "out").err


@for_each(("written", "factor"), [("rad/s", 1.0), ("rev/s", 2 * math.pi)])
def test_either_line_that_is_offered_is_accepted(machine_file, written, factor):
    machine = package.load(machine_file((SPEED, f'speed = "9.42478 {written}"'))).machine()
    assert machine.speed == pytest.approx(9.42478 * factor)


def test_a_line_out_of_range_is_not_offered():
    description = package.Description(POINTS_ENGINE)
    description["crank.speed"] = "9000 1/s"
    with pytest.raises(package.InputError, match=r'write speed = "9000 rad/s"$'):
        description.machine()


def test_python_and_the_studio_ask_too(machine_file):
    description = package.load(machine_file())
    description["crank.speed"] = "9.42478 Гц"
    with pytest.raises(package.InputError, match="radians or revolutions"):
        description.machine()
    answer = Session("ru").answer({"do": "show", "text": description.dump()})
    assert WORDS["ru"] in str(answer["refusals"])


def test_the_frequency_of_the_mains_is_per_second():
    press = package.load(Path(__file__).parents[2] / "examples" / "press-start.toml")
    motors = [
        press.machine([f"motor.frequency={text}"]).drive.motor
        for text in ("60 Hz", "60 Гц", "60 1/s", "60 с⁻¹", "3600 мин⁻¹")
    ]
    # three pairs of poles
    assert [motor.motor.synchronous_speed for motor in motors] == pytest.approx([2 * math.pi * 60 / 3] * 5)


def test_a_fraction_is_a_number():
    description = package.Description(POINTS_ENGINE)
    description["rod.ratio"] = "1/4"
    assert package.analyse(description.machine()).summary["rod_ratio"] == 0.25
    description["rod.ratio"] = "1/0"
    with pytest.raises(package.InputError, match=r"rod\.ratio"):
        description.machine()


def test_a_fraction_is_a_number_beside_quantities_too():
    kind, reader = NumberOr(Quantity(("time",), 0.0, 1e3), Number(0.0, 1.0)), Reader()
    assert kind.read("1/4", "over", reader) == kind.read(0.25, "over", reader) == 0.25
    assert kind.read("3 s", "over", reader).value == 3.0
    assert reader.problems == []


@for_each("unit", ["c⁻¹", "1/c", "s^{-1}", "hertz", "Герц"])
def test_other_spellings_per_second_are_asked_about_too(unit):
    description = package.Description(POINTS_ENGINE)
    description["crank.speed"] = f"9.42478 {unit}"
    with pytest.raises(package.InputError, match="radians or revolutions") as raised:
        description.machine()
    assert LINES in str(raised.value)


@for_each(("text", "dimension", "nearest"), [
    ("3 N*m/rev", "torsional_stiffness", ""), ("3 MJ/m3", "specific_energy", ""), ("3 Nmg", "torque", ""),
    ("3 kg*m3", "inertia", ""), ("3 rmp", "speed", "3 rpm"),
    ("27 C", "temperature", "27 °C"), ("27 С", "temperature", "27 °C"), ("3 inchs", "length", "3 inch"),
])  # fmt: skip
def test_a_suggested_unit_keeps_the_meaning(text, dimension, nearest):
    with pytest.raises(ValueError, match="not a unit known") as told:
        units.parse(text, (dimension,))
    assert (f'did you mean "{nearest}"' if nearest else "known here; ") in str(told.value.args[0])


@for_each(("unit", "plain"), [("bar g", "bar"), ("psia", "psi"), ("bar(a)", "bar"), ("ата", "ат")])
def test_a_unit_that_counts_from_something_is_told_by_its_key(unit, plain):
    with pytest.raises(ValueError, match=f'the unit is written "3 {plain}"'):
        units.parse(f"3 {unit}", ("pressure",))


@for_each(("text", "dimension", "value"), [
    ("0.74 kg/l", "density", 740), ("12 cc/min", "volume_rate", 2e-7),
    ("0.42 lb/bhp-hr", "fuel_consumption", 7.09657e-8),
    ("1 kp", "force", 9.80665), ("100 CV", "power", 73549.875), ("0.8 kgf/cm2/mm", "pressure_by_length", 78453200),
])  # fmt: skip
def test_units_of_engine_tests(text, dimension, value):
    """By the pound, the foot and the weight of a kilogram: 0.42 x 0.45359237 / (550 x 1.3558179483 x 3600)."""
    assert units.parse(text, (dimension,)).value == pytest.approx(value, rel=1e-5)


@for_each(("text", "nearest"), [("3000 RPM", "3000 rpm"), ("50 RAD/S", "50 rad/s")])
def test_a_unit_in_capitals_is_told_with_the_usual_one(text, nearest):
    description = package.Description(POINTS_ENGINE)
    description["crank.speed"] = text
    with pytest.raises(package.InputError, match=f'did you mean "{nearest}"'):
        description.machine()


@for_each(
    ("key", "text", "low", "high", "scale"),
    [
        ("crank.radius", "45 +0.1/-0.2 mm", 44.8, 45.1, 1e3),
        ("crank.radius", "45^{+0.1}_{-0.2} mm", 44.8, 45.1, 1e3),
        ("crank.radius", "45 mm −0.02 −0.05", 44.95, 44.98, 1e3),
        ("crank.radius", "45 +0,1/0 mm", 45.0, 45.1, 1e3),
        ("rod.ratio", "0.25 +0.01/-0.02", 0.23, 0.26, 1.0),
    ],
)
def test_limits_of_two_sizes_are_refused_with_a_line_of_the_same_limits(key, text, low, high, scale):
    description = package.Description(POINTS_ENGINE)
    description[key] = text
    with pytest.raises(package.InputError, match="two limits of its own") as raised:
        description.machine()
    written = str(raised.value).split('"')[-2]
    description[key] = written
    middle, half = description.machine(), float(written.split()[2])
    value = middle.mechanism.driver.radius if key == "crank.radius" else package.analyse(middle)["rod_ratio"]
    assert (value * scale - half, value * scale + half) == pytest.approx((low, high))


@for_each(
    ("source", "latin", "mixed"),
    [
        ("four-bar", 'pin = "A"', 'pin = "А"'),
        ("points", '"a", "c1"', '"а", "c1"'),
        ("points", '"polytropic"', '"pоlytropic"'),
    ],
)
def test_names_and_words_with_letters_of_the_other_alphabet_are_told_by_them(source, latin, mixed):
    letter = next(letter for letter in mixed if ord(letter) > 1000)
    text = POINTS_ENGINE if source == "points" else package.template(source)
    with pytest.raises(package.InputError, match=f"Cyrillic letter {letter}.*; write "):
        package.Description(text.replace(latin, mixed)).machine()
