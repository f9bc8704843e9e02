"""Three measured files and what people do to them: each of the faulty ones is read rightly, or asked about.

The pressures are worked out here, of a gas that is compressed, burns by Wiebe's law and expands, and the mean torque by
a sum over a fine grid. A question has the line that answers it, and with that line the torque is right.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest
import xlsxwriter

import crankwork
from crankwork.description import measured_build
from crankwork.errors import InputError
from crankwork.kinematics.crank_grid import Array
from crankwork.report.notices import notice_text
from each import for_each
from shown import in_parts

MACHINE = """
[crank]
radius = "45 mm"
speed = "3000 rpm"
[rod]
length = "150 mm"
[cylinder]
bore = "86 mm"
compression_ratio = {ratio}
[gas]
cycle = "720 deg"
{pressures}
[gas.measured]
file = "p.txt"
{keys}
"""
ABSOLUTE = 'pressures = "absolute"\nambient = "1.01325 bar"'
BAR = 'pressure_unit = "bar"'
AMBIENT = 1.01325
# what a question is: a refusal, or one of these notices
QUESTIONS = {
    "peak_far", "work_negative", "exponent_odd", "dead_centre_compression",
    "dead_centre_expansion", "pressure_unit_odd", "pressures_other",
    "pressure_level", "measured_reference", "measured_other_unit", "pressure_spike",
}  # fmt: skip


class Engine(NamedTuple):
    """An engine: compression ratio, pressures of intake and exhaust, pressure that the heat would add at dead centre.

    Start and duration of the burning by Wiebe's law [deg], exponents of compression and expansion, step [deg]; [bar]
    """

    ratio: float
    intake: float
    exhaust: float
    heat: float
    start: float
    duration: float
    exponent: float
    step: float


ENGINES = {
    "petrol": Engine(9.0, 0.95, 1.08, 42.0, 348.0, 50.0, 1.32, 1.0),
    "supercharged diesel": Engine(16.5, 2.3, 2.4, 70.0, 355.0, 60.0, 1.35, 0.5),
    "petrol at part load": Engine(10.0, 0.45, 1.05, 20.0, 345.0, 45.0, 1.3, 1.0),
}
FIRST, OTHERS = ["petrol"], ["supercharged diesel", "petrol at part load"]


def volume(degrees: Array, engine: Engine) -> Array:
    """Return the volume over the swept one."""
    angle, share = np.radians(degrees), 45 / 150
    moved = 1 - np.cos(angle) + (1 - np.sqrt(1 - (share * np.sin(angle)) ** 2)) / share
    return np.asarray(1 / (engine.ratio - 1) + moved / 2)


@cache
def cycle_of(name: str) -> tuple[Array, Array]:
    """Return crank angles, and absolute pressures by steps of the first law of a burning gas. [deg], [bar]"""
    engine, count = ENGINES[name], 8
    fine = np.linspace(180, 540, round(360 / engine.step) * count + 1)
    size, n = volume(fine, engine), engine.exponent
    burnt = 1 - np.exp(-6.908 * (np.clip(fine - engine.start, 0, None) / engine.duration) ** 3)
    # p V^n rises by what is burnt, so that without burning it is constant
    least = float(volume(np.array([360.0]), engine)[0])
    constant = engine.intake * size[0] ** n + np.concatenate(
        [[0.0], np.cumsum(engine.heat * least * np.diff(burnt) * ((size[1:] + size[:-1]) / 2) ** (n - 1))]
    )
    closed = (constant / size**n)[::count]
    degrees = np.arange(0.0, 720.0, engine.step)
    pressure = np.where(degrees < 180, engine.intake, engine.exhaust)
    pressure = np.asarray(pressure, float)
    pressure[(degrees >= 180) & (degrees < 540)] = closed[:-1]
    # the gas blows down after the dead centre, and the intake follows the exhaust within twenty degrees
    down = (degrees >= 540) & (degrees < 600)
    pressure[down] = engine.exhaust + (closed[-1] - engine.exhaust) * (1 - (degrees[down] - 540) / 60) ** 2
    change = degrees < 20
    pressure[change] = engine.intake + (engine.exhaust - engine.intake) * (1 - degrees[change] / 20) ** 2
    return degrees, pressure


@cache
def torque_of(name: str) -> float:
    """Return the mean torque: work of the polygon of pressure over volume, by the angle of a cycle. [N m]"""
    degrees, pressure = cycle_of(name)
    size = volume(np.append(degrees, 720.0), ENGINES[name]) * 0.09 * math.pi / 4 * 0.086**2
    closed = np.append(pressure, pressure[0]) * 1e5
    return float((closed[1:] + closed[:-1]) @ np.diff(size)) / 2 / (4 * math.pi)


def rows(degrees: Array, pressure: Array, separator: str = ";", mark: str = ".", digits: int = 6) -> str:
    """Return rows of numbers as a program writes them."""
    lines = [f"{angle:g}{separator}{value:.{digits}f}" for angle, value in zip(degrees, pressure, strict=True)]
    return "\n".join(lines).replace(".", mark) + "\n"


def later(pressure: Array, degrees: Array, by: float) -> Array:
    """Return the pressures as a recorder has them whose angles are smaller by a shift."""
    return np.asarray(np.interp((degrees + by) % 720, np.append(degrees, 720), np.append(pressure, pressure[0])))


def thousands(value: float, mark: str = ".") -> str:
    """Return a number with thousands apart."""
    whole, part = f"{value:,.4f}".split(".")
    return whole.replace(",", mark) + ("," if mark == "." else ".") + part


Fault = Callable[[Array, Array], str]
# fault: the file, the keys of its table, and how pressures are counted
ASKED: dict[str, tuple[Fault, str, str]] = {
    "firing at 0, from -360": (lambda a, p: rows(a - 360, p), BAR, ABSOLUTE),
    "firing at 0": (lambda a, p: rows(a, later(p, a, 360)), BAR, ABSOLUTE),
    "180 early": (lambda a, p: rows(a, later(p, a, 180)), BAR, ABSOLUTE),
    "180 late": (lambda a, p: rows(a, later(p, a, -180)), BAR, ABSOLUTE),
    "3 early": (lambda a, p: rows(a, later(p, a, 3)), BAR, ABSOLUTE),
    "3 late": (lambda a, p: rows(a, later(p, a, -3)), BAR, ABSOLUTE),
    "against the rotation": (lambda a, p: rows(a, p[-np.arange(len(p)) % len(p)]), BAR, ABSOLUTE),
    "gauge, read as absolute": (lambda a, p: rows(a, p - AMBIENT), BAR, ABSOLUTE),
    "gauge and never below 0, read as absolute": (lambda a, p: rows(a, p - p.min()), BAR, ABSOLUTE),
    "absolute, read as gauge": (rows, BAR, 'pressures = "gauge"'),
    "kPa, read as bar": (lambda a, p: rows(a, 100 * p), BAR, ABSOLUTE),
    "MPa, read as bar": (lambda a, p: rows(a, p / 10), BAR, ABSOLUTE),
    "bar, read as MPa": (rows, 'pressure_unit = "MPa"', ABSOLUTE),
    "pegged in the exhaust": (rows, BAR + '\npeg = { angle = "450 deg", pressure = "1 bar" }', ABSOLUTE),
    "pegged at the peak": (rows, BAR + '\npeg = { angle = "370 deg", pressure = "1 bar" }', ABSOLUTE),
    "columns named the wrong way round": (
        lambda a, p: "phi;p\n" + rows(a, p), BAR + '\nangle_column = "p"\npressure_column = "phi"', ABSOLUTE),
}  # fmt: skip
READ: dict[str, tuple[Fault, str, str]] = {
    "columns the other way round": (lambda a, p: rows(p, a), BAR, ABSOLUTE),
    "a heading says where zero is": (lambda a, p: "CA [deg ATDC firing];p [bar]\n" + rows(a - 360, p), "", ABSOLUTE),
    "aTDC of combustion": (lambda a, p: "CA (deg aTDC combustion);p (bar)\n" + rows(a - 360, p), "", ABSOLUTE),
    "a Russian heading": (
        lambda a, p: "φ, °ПКВ после ВМТ сгорания;p, кПа\n" + rows(a - 360, 100 * p, mark=","), "", ABSOLUTE),
    "a Russian heading, gauge": (
        lambda a, p: "Угол, °ПКВ;Давление избыточное, МПа\n" + rows(a, (p - AMBIENT) / 10, mark=",", digits=8), "", ""),
    "a Vietnamese heading, gauge": (
        lambda a, p: "Góc quay [độ];Áp suất dư [bar]\n" + rows(a, p - AMBIENT), "", ""),
    "a German heading": (lambda a, p: "Kurbelwinkel [°KW];Zylinderdruck [bar]\n" + rows(a, p, mark=","), "", ABSOLUTE),
    "absolute by its heading": (lambda a, p: "CA [deg];p_abs [bar]\n" + rows(a, p), "", ""),
    "a unit in the heading": (lambda a, p: "CA, deg;p, kPa\n" + rows(a, 100 * p), "", ABSOLUTE),
    "words below": (lambda a, p: rows(a, p) + "\nMean;1.23\nend of file\n", BAR, ABSOLUTE),
    "a heading of two lines": (lambda a, p: "Crank angle;Pressure\n[deg];Cyl 1 [bar]\n" + rows(a, p), "", ABSOLUTE),
    "Markdown": (
        lambda a, p: "| CA [deg] | p [bar] |\n|---|:--:|\n" + "".join(
            f"| {line.replace(';', ' | ')} |\n" for line in rows(a, p).splitlines()), "", ABSOLUTE),
    "thousands with dots": (
        lambda a, p: "".join(f"{x:g};{thousands(1000 * y)}\n" for x, y in zip(a, p, strict=True)).replace(".5;", ",5;"),
        'pressure_unit = "hPa"', ABSOLUTE),
    "thousands with commas": (
        lambda a, p: "".join(f"{x:g}\t{thousands(1000 * y, ',')}\n" for x, y in zip(a, p, strict=True)),
        'pressure_unit = "mbar"', ABSOLUTE),
    "one number on each line": (
        lambda a, p: "CA [deg]\np [bar]\n" + rows(a, p).replace(";", "\n"), "", ABSOLUTE),
    "an empty last column": (
        lambda a, p: "CA [deg];p [bar];note\n" + rows(a, p).replace("\n", ";\n"), "", ABSOLUTE),
    "two empty columns": (lambda a, p: rows(a, p).replace("\n", ";;\n"), BAR, ABSOLUTE),
    "comments and a mark of order": (lambda a, p: "\ufeff# bench 3\n% deg, bar\n" + rows(a, p), BAR, ABSOLUTE),
    "from the last row to the first": (lambda a, p: rows(a[::-1], p[::-1]), BAR, ABSOLUTE),
    "before the dead centre": (lambda a, p: "CA [deg BTDC];p [bar]\n" + rows(-a, p), "", ABSOLUTE),
}  # fmt: skip


class Reading(NamedTuple):
    """What a machine file says about a pressure file: its mean torque, questions, and all that is told. [N m]"""

    torque: float
    questions: set[str]
    words: str


@pytest.fixture
def reading(tmp_path):
    def read(content: str, name: str, keys: str, pressures: str) -> Reading:
        (tmp_path / "p.txt").write_text(content, encoding="utf-8")
        text = MACHINE.format(ratio=ENGINES[name].ratio, pressures=pressures, keys=keys)
        try:
            results = crankwork.analyse(crankwork.read_machine(text, folder=tmp_path))
        except InputError as error:
            return Reading(math.nan, {"refusal"}, str(error))
        codes = {notice.code for notice in results.notices}
        words = "\n".join(
            notice_text(notice.code, notice.values, "en") for notice in results.notices if notice.code in QUESTIONS
        )
        return Reading(results.summary["mean_torque"], codes & QUESTIONS, words)

    return read


def with_advice(words: str, keys: str, pressures: str) -> tuple[str, str]:
    """Return the keys with the first line written into them that is advised."""
    if advised := re.search(r'pressures = "(absolute|gauge)"', words):
        return keys, ABSOLUTE if advised[1] == "absolute" else 'pressures = "gauge"'
    if "the other way round" in words:
        return keys.replace(
            'angle_column = "p"\npressure_column = "phi"', 'angle_column = "phi"\npressure_column = "p"'
        ), pressures
    line = re.search(r'(shift|reversed|pressure_unit) = ("[^"]*"|true)|(peg) = \{.*?\}', words)
    assert line, f"no line to write in: {words}"
    key = line[1] or line[3]
    return "\n".join([*(own for own in keys.splitlines() if not own.startswith(key)), line[0]]), pressures


@for_each("name", ENGINES)
def test_the_right_file_is_read_without_a_question(reading, name):
    found = reading(rows(*cycle_of(name)), name, BAR, ABSOLUTE)
    assert found.questions == set()
    # a smooth curve through the samples instead of a polygon
    assert found.torque == pytest.approx(torque_of(name), rel=1e-3)


@in_parts("name", FIRST, OTHERS)
@for_each("fault", READ)
def test_an_awkward_file_is_the_right_one(reading, name, fault):
    degrees, pressure = cycle_of(name)
    write, keys, pressures = READ[fault]
    found = reading(write(degrees, pressure), name, keys, pressures)
    assert found.questions == set(), found.words
    assert found.torque == pytest.approx(reading(rows(degrees, pressure), name, BAR, ABSOLUTE).torque, rel=2e-6)


@in_parts("name", FIRST, OTHERS)
@for_each("fault", ASKED)
def test_a_wrong_file_is_asked_about_with_the_line_that_makes_it_right(reading, name, fault):
    degrees, pressure = cycle_of(name)
    write, keys, pressures = ASKED[fault]
    content, right = write(degrees, pressure), reading(rows(degrees, pressure), name, BAR, ABSOLUTE).torque
    found = reading(content, name, keys, pressures)
    assert found.questions, "nothing was asked"
    for _ in range(2):
        keys, pressures = with_advice(found.words, keys, pressures)
        found = reading(content, name, keys, pressures)
        if not found.questions:
            break
    assert found.questions == set(), found.words
    # resampling at another angle, and two digits of the shift
    assert found.torque == pytest.approx(right, rel=2e-3)


ENGINE = """
[engine]
layout = "inline"
cylinders = 4
firing_order = [1, 3, 4, 2]
"""
# later than cylinder 1, by the firing order
LATER = {1: 0, 2: 540, 3: 180, 4: 360}


def four(name: str) -> str:
    """Return four cylinders over one crank angle."""
    degrees, pressure = cycle_of(name)
    columns = [degrees, *(later(pressure, degrees, -angle) for angle in LATER.values())]
    lines = (";".join(f"{value:.6f}" for value in row) for row in zip(*columns, strict=True))
    return "CA [deg];p1 [bar];p2 [bar];p3 [bar];p4 [bar]\n" + "\n".join(lines)


def test_four_cylinders_over_one_crank_angle_are_one_entry(tmp_path):
    (tmp_path / "p.txt").write_text(four("petrol"), encoding="utf-8")
    text = MACHINE.format(ratio=9.0, pressures=ABSOLUTE, keys='columns = ["p1", "p2", "p3 [bar]", 5]') + ENGINE
    machine = crankwork.read_machine(text, folder=tmp_path)
    results = crankwork.analyse(machine)
    assert results.summary["mean_torque"] == pytest.approx(4 * torque_of("petrol"), rel=1e-3)
    assert results.other is not None
    assert results.other.summary["mean_torque"] == pytest.approx(results.summary["mean_torque"], rel=1e-9)
    with pytest.raises(InputError, match=r"gas\.measured\.columns: has 3 entries; write 4 of them"):
        crankwork.read_machine(text.replace(', "p2"', ""), folder=tmp_path)
    with pytest.raises(InputError, match=r"gas\.measured\.columns: there is one crank gear only; add \[engine\]"):
        crankwork.read_machine(text.removesuffix(ENGINE), folder=tmp_path)


def test_four_cylinders_counted_from_the_first_are_asked_about_all_at_once(tmp_path):
    (tmp_path / "p.txt").write_text(four("petrol"), encoding="utf-8")
    own = '[gas.cylinders.{0}.measured]\nfile = "p.txt"\npressure_column = "p{0}"\n'
    text = MACHINE.format(ratio=9.0, pressures=ABSOLUTE, keys='pressure_column = "p1"') + ENGINE
    with pytest.raises(InputError) as caught:
        crankwork.read_machine(text + "".join(own.format(number) for number in (2, 3, 4)), folder=tmp_path)
    shifts = {
        problem.key[14]: re.search(r'write (shift = ".*?")', problem.message)[1] for problem in caught.value.problems
    }
    assert shifts == {"2": 'shift = "180 deg"', "3": 'shift = "-180 deg"', "4": 'shift = "360 deg"'}
    answered = "".join(f"{own.format(number)}{shifts.get(str(number), '')}\n" for number in (2, 3, 4))
    results = crankwork.analyse(crankwork.read_machine(text + answered, folder=tmp_path))
    assert results.summary["mean_torque"] == pytest.approx(4 * torque_of("petrol"), rel=1e-3)


def test_every_wrong_row_of_a_file_is_told_with_its_line(reading):
    lines = rows(*cycle_of("petrol")).splitlines()
    lines[7], lines[20], lines[99] = "7;n/a", "20;1,0,1", "99;1;2;3"
    words = reading("\n".join(lines), "petrol", BAR, ABSOLUTE).words
    assert [re.findall(r"line (\d+)", line)[0] for line in words.splitlines()] == ["8", "21", "100"]


FIRING = """CA [deg ATDC firing]; Crank angle, deg after firing TDC; CA [deg] (0 = firing TDC); Angle ATDCF [deg]
CA [deg aTDC power]; φ, °ПКВ после ВМТ сгорания; Угол ПКВ от ВМТ рабочего хода, град; φ, ° ПКВ (0 – ВМТ сгорания)
Угол от ВМТ вспышки, град; Угол поворота от ВМТ воспламенения, град; φ, град после ВМТ такта сжатия
Кут повороту, град після ВМТ згоряння; φ, °ПКВ від ВМТ робочого ходу; Кут, град (ВМТ стиску); Góc quay [độ sau ĐCT nổ]
ĐCT nổ; Góc quay trục khuỷu, ° sau ĐCT kỳ nổ; φ (độ) từ ĐCT cháy; Góc quay từ ĐCT cuối nén, độ
Góc (điểm chết trên cháy); Goc quay sau DCT no [do]; Kurbelwinkel [°KW nach ZOT]"""
BEFORE = """CA [deg BTDC]; Crank angle before TDC [deg]; φ, град до ВМТ; Кут перед ВМТ, град; Кут до ВМТ, град
Góc trước ĐCT [độ]; Goc quay truoc DCT [do]"""


def headings(text: str) -> list[str]:
    return re.split(r"; ?|\n", text)


@for_each("form", ["NFC", "NFD"])
@for_each("heading", headings(FIRING) + headings(BEFORE))
def test_headings_of_every_language_say_where_zero_is(reading, heading, form):
    degrees, pressure = cycle_of("petrol")
    angles = degrees - 360 if heading in headings(FIRING) else -degrees
    found = reading(
        unicodedata.normalize(form, f"{heading}\tp [bar]\n") + rows(angles, pressure, "\t"), "petrol", "", ABSOLUTE
    )
    assert found.questions == set(), found.words
    assert found.torque == pytest.approx(torque_of("petrol"), rel=1e-3)


def test_a_heading_may_say_that_firing_is_at_360(reading):
    degrees, pressure = cycle_of("petrol")
    found = reading("CA [deg] (firing TDC = 360);p [bar]\n" + rows(degrees, pressure), "petrol", "", ABSOLUTE)
    assert found.torque == pytest.approx(torque_of("petrol"), rel=1e-3)


ABOVE = """Gauge pressure;Избыточное давление;Давление манометрическое;Тиск надлишковий
Áp suất dư;Ap suat du;Áp suất tương đối"""


@for_each("heading", headings(ABOVE))
def test_headings_of_every_language_say_what_pressures_count_from(reading, heading):
    degrees, pressure = cycle_of("petrol")
    content = f"CA [deg];{heading} [bar]\n" + rows(degrees, pressure)
    assert reading(content, "petrol", "", ABSOLUTE).questions >= {"measured_reference"}


def test_words_of_headings_are_of_one_alphabet():
    """A Cyrillic letter among Latin ones looks right and is never found."""
    for pattern in (
        measured_build._FROM_FIRING,
        measured_build._BEFORE,
        *measured_build._REFERENCES.values(),
        *measured_build._WORDS.values(),
    ):
        for word in re.findall(r"[^\W\d_]+", re.sub(r"\\.", " ", pattern.pattern)):
            alphabets = {unicodedata.name(letter).split()[0] for letter in word}
            assert len(alphabets - {"GREEK"}) <= 1, word


PEGS = {
    'pressure = "1 bar"': ['peg.angle: is missing; write angle = "180 deg"'],
    'angle = "180 deg"': ['peg.pressure: is missing; write pressure = "1 bar"'],
    "exponent = 1.32": ['peg.from: is missing; write from = "270 deg"', 'peg.to: is missing; write to = "330 deg"'],
    'from = "270 deg", to = "330 deg"': ["peg.exponent: is missing; write exponent = 1.32"],
}


@for_each(("peg", "words"), PEGS.items())
def test_what_a_pegging_lacks_is_named(reading, peg, words):
    found = reading(rows(*cycle_of("petrol")), "petrol", f"{BAR}\npeg = {{ {peg} }}", ABSOLUTE)
    lines = found.words.splitlines()
    assert len(lines) == len(words)
    assert [word for word, line in zip(words, lines, strict=True) if not line.endswith(word)] == [], lines
    # with what is advised the pressures are pegged
    more = ", ".join(re.split("write ", line)[1] for line in lines)
    assert reading(rows(*cycle_of("petrol")), "petrol", f"{BAR}\npeg = {{ {peg}, {more} }}", ABSOLUTE).torque > 0


# how many of a unit are a bar
OF_BAR = {"MPa": 0.1, "bar": 1.0, "kPa": 100.0, "mbar": 1000.0, "Pa": 1e5, "psi": 14.5038, "kgf/cm2": 1.0197}


@in_parts("name", FIRST, OTHERS)
@for_each("unit", OF_BAR)
@for_each("counted", [0.0, AMBIENT])
def test_a_missing_unit_is_asked_for_by_size(reading, name, unit, counted):
    degrees, pressure = cycle_of(name)
    words = reading(rows(degrees, OF_BAR[unit] * (pressure - counted)), name, "", ABSOLUTE).words
    units = re.findall(r'pressure_unit = "(.*?)"', words)
    assert unit in units, words
    # absolute pressures tell it better
    assert len(units) <= (4 if counted else 3), words


def test_all_that_a_file_lacks_is_told_at_once(reading):
    lines = rows(*cycle_of("petrol")).splitlines()
    lines[7], lines[20] = "7;n/a", "20;1,0,1"
    words = reading("\n".join(lines), "petrol", "", ABSOLUTE).words.splitlines()
    assert [re.findall(r"pressure_unit|line \d+", line)[0] for line in words] == ["pressure_unit", "line 8", "line 21"]
    wide = "a;b;c\n" + "\n".join(f"{line};1" for line in lines)
    names = reading(wide, "petrol", 'angle_column = "x"\npressure_column = "y"', ABSOLUTE).words
    assert re.findall(r'no column "(.)"', names) == ["x", "y"]


FAR = [3, -3, 8, -8, 10, -10, 15, -15, 20, -20, 30, -30, 45, -45, 90, -90, 102, -102, 180, 360]


@in_parts("name", FIRST, OTHERS)
@for_each("shift", FAR)
@for_each("is_reversed", [False, True])
def test_a_shift_of_any_size_is_asked_about_with_the_right_line(reading, name, shift, is_reversed):
    degrees, pressure = cycle_of(name)
    recorded = pressure[-np.arange(len(pressure)) % len(pressure)] if is_reversed else pressure
    words = reading(rows(degrees, later(recorded, degrees, shift)), name, BAR, ABSOLUTE).words
    assert bool(re.search("reversed = true", words)) == is_reversed, words
    stated = re.search(r'shift = "(\S+) deg"', words.split("if the file")[0] if is_reversed else words)
    wanted = -shift if is_reversed else shift
    if stated or not is_reversed or abs(shift) > 3:
        assert stated, words
        assert (float(stated[1]) - wanted + 360) % 720 - 360 == pytest.approx(0, abs=0.6)
    assert "peg" not in words
    assert "exponent" not in words


def compressor(ratio: float, clearance: float) -> tuple[Array, Array]:
    """Return crank angles and pressures of compression, delivery and expansion by closed forms. [deg], [bar]"""
    degrees, share = np.arange(0.0, 360.0), 45 / 150
    moved = 1 - np.cos(np.radians(degrees)) + (1 - np.sqrt(1 - (share * np.sin(np.radians(degrees))) ** 2)) / share
    size = clearance + moved / 2
    down, up = np.maximum(1.0, ratio * (clearance / size) ** 1.3), np.minimum(ratio, ((1 + clearance) / size) ** 1.3)
    return degrees, np.where(degrees < 180, down, up)


def two_stroke(name: str) -> tuple[Array, Array]:
    """Return the closed part of a cycle from the dead centre on. [deg], [bar]"""
    degrees, pressure = cycle_of(name)
    closed = pressure[(degrees >= 180) & (degrees < 540)]
    return degrees[degrees < 360], np.roll(closed, -len(closed) // 2)


TURNS = {
    "compressor 2.5": (compressor(2.5, 0.05), 21.0),
    "compressor 8": (compressor(8.0, 0.05), 21.0),
    "compressor 12": (compressor(12.0, 0.03), 1 + 1 / 0.03),
    "two-stroke": (two_stroke("petrol"), 9.0),
    "two-stroke diesel": (two_stroke("supercharged diesel"), 16.5),
}
CHAMBER = """
[fixed_points]
O = ["0 mm", "0 mm"]
[crank]
pivot = "O"
pin = "A"
radius = "45 mm"
speed = "3000 rpm"
[guides]
bed = { through = "O" }
[links]
rod = { joins = ["A", "B"], length = "150 mm" }
[sliders]
piston = { guide = "bed", pin = "B" }
[chambers.gas]
slider = "piston"
bore = "86 mm"
sense = -1
period = "360 deg"
pressures = "absolute"
"""


@for_each("name", TURNS)
@for_each("form", ["cylinder", "chamber"])
@for_each(("by", "is_reversed"), [(0, False), (0, True), (180, False), (90, False), (-90, False), (90, True)])
def test_cycles_of_a_turn_are_asked_about_in_cylinders_and_chambers(tmp_path, name, form, by, is_reversed):
    (degrees, pressure), ratio = TURNS[name]
    recorded = pressure[-np.arange(len(pressure)) % len(pressure)] if is_reversed else pressure
    moved = np.interp((degrees + by) % 360, np.append(degrees, 360), np.append(recorded, recorded[0]))
    (tmp_path / "p.txt").write_text(rows(degrees, moved), encoding="utf-8")
    text = MACHINE.replace("720 deg", "360 deg").format(ratio=ratio, pressures=ABSOLUTE, keys=BAR)
    if form == "chamber":
        head, measured = f"{CHAMBER}\ncompression_ratio = {ratio}\n", text[text.index("[gas.measured]") :]
        text = head + measured.replace("gas.", "chambers.gas.")
    if not by and not is_reversed:
        assert not QUESTIONS & {
            one.code for one in crankwork.analyse(crankwork.read_machine(text, folder=tmp_path)).notices
        }
        return
    with pytest.raises(InputError) as caught:
        crankwork.read_machine(text, folder=tmp_path)
    (problem,) = caught.value.problems
    wanted = ["reversed = true"] * is_reversed + [f'shift = "{by * (-1) ** is_reversed} deg"'] * bool(by)
    advice = re.search(r"write (.*?)(?: if the file|, or)", problem.message)
    assert advice is not None
    assert advice[1] == ", ".join(wanted)
    assert crankwork.read_machine(text + "\n" + advice[1].replace(", ", "\n"), folder=tmp_path)


@for_each("name", [name for name in TURNS if name.startswith("compressor")])
@for_each("by", [-10, 10, 5])
def test_a_dead_centre_of_a_compressor_that_is_some_degrees_off_is_told(tmp_path, name, by):
    (degrees, pressure), ratio = TURNS[name]
    moved = np.interp((degrees + by) % 360, np.append(degrees, 360), np.append(pressure, pressure[0]))
    (tmp_path / "p.txt").write_text(rows(degrees, moved), encoding="utf-8")
    text = MACHINE.replace("720 deg", "360 deg").format(ratio=ratio, pressures=ABSOLUTE, keys=BAR)
    notices = {
        item.code: item.values for item in crankwork.analyse(crankwork.read_machine(text, folder=tmp_path)).notices
    }
    assert notices["dead_centre_expansion"]["shift"] == pytest.approx(by, abs=0.5)
    right = f'{text}\nshift = "{by} deg"'
    codes = {item.code for item in crankwork.analyse(crankwork.read_machine(right, folder=tmp_path)).notices}
    assert not QUESTIONS & codes


@for_each(("row", "value"), [(300, 60.0), (640, 60.0), (50, 20.0), (372, 5.0)])
def test_one_wrong_sample_is_named_and_nothing_else_is_asked(reading, row, value):
    degrees, pressure = cycle_of("petrol")
    wrong = np.where(np.arange(len(pressure)) == row, value, pressure)
    found = reading(rows(degrees, wrong), "petrol", BAR, ABSOLUTE)
    assert found.questions == {"pressure_spike"}
    assert f"line {row + 1}:" in found.words


@for_each("pressure", [1.0, 0.0])
def test_a_pressure_that_does_not_change_is_said_to(reading, pressure):
    degrees = np.arange(720.0)
    words = reading(rows(degrees, pressure + 1e-4 * np.sin(degrees)), "petrol", BAR, 'pressures = "gauge"').words
    assert "the pressure hardly changes over the cycle" in words
    assert 'as measured.pressure_column, or shift = "0 deg" if it is so' in words


ORDERS = [
    ["p1", "p3", "p4", "p2"],
    ["p1", "p3", "p2", "p4"],
    ["p4", "p3", "p2", "p1"],
    ["p2", "p1", "p3", "p4"],
    [2, 4, 3, 5],
]


@for_each("order", ORDERS)
def test_columns_in_a_wrong_order_are_answered_with_the_right_one(tmp_path, order):
    (tmp_path / "p.txt").write_text(four("petrol"), encoding="utf-8")
    keys = f"columns = {order}".replace("'", '"')
    text = MACHINE.format(ratio=9.0, pressures=ABSOLUTE, keys=keys) + ENGINE
    with pytest.raises(InputError) as caught:
        crankwork.read_machine(text, folder=tmp_path)
    (problem,) = caught.value.problems
    line = re.search(r"write (columns = \[.*?\])", problem.message)[1]
    assert line == f"columns = {sorted(order)}".replace("'", '"')
    results = crankwork.analyse(crankwork.read_machine(text.replace(keys, line), folder=tmp_path))
    assert results.summary["mean_torque"] == pytest.approx(4 * torque_of("petrol"), rel=1e-3)


SHIFTS = 'shift = "180 deg"', 'shift = "-180 deg"', 'shift = "360 deg"'


@for_each("order", [["p3", "p2", "p4"], ["p3", "p4", "p2"]])
def test_entries_with_the_columns_of_others_are_answered_with_their_own(tmp_path, order):
    (tmp_path / "p.txt").write_text(four("petrol"), encoding="utf-8")
    text = MACHINE.format(ratio=9.0, pressures=ABSOLUTE, keys='pressure_column = "p1"') + ENGINE
    for number, (column, shift) in enumerate(zip(order, SHIFTS, strict=True), start=2):
        own = f'[gas.cylinders.{number}.measured]\nfile = "p.txt"\npressure_column = "{column}"\n{shift}\n'
        text += own
    with pytest.raises(InputError) as caught:
        crankwork.read_machine(text, folder=tmp_path)
    lines = {
        problem.key: re.search(r'pressure_column = "(.*?)"', problem.message)[1] for problem in caught.value.problems
    }
    wrong = [number for number, column in enumerate(order, start=2) if column != f"p{number}"]
    assert lines == {f"gas.cylinders.{number}.measured.pressure_column": f"p{number}" for number in wrong}


PASTED = {
    "decimal commas, one number on each line": lambda lines: "\n".join(lines).replace(";", "\n").replace(".", ","),
    "words below numbers of one column": lambda lines: "\n".join([*lines, "Mean", "1.2", "end"]).replace(";", "\n"),
    "headings again on every page": lambda lines: "\n".join(
        line + "\nCA [deg];p [bar]" * (row % 100 == 99) for row, line in enumerate(lines)
    ),
    "Markdown with a caption and a source": lambda lines: "\n".join(
        ["", "Table 3", "", *(f"| {line.replace(';', ' | ')} |" for line in lines), "", "Source: bench"]
    ).replace("CA [deg] | p [bar] |", "**CA** [deg] | **p** [bar] |\n|:-|-:|"),
    "a typographic minus": lambda lines: "\n".join(lines).replace("-", "\N{MINUS SIGN}"),
}


@for_each("paste", PASTED)
def test_tables_pasted_from_documents_are_read(reading, paste):
    degrees, pressure = cycle_of("petrol")
    lines = ["CA [deg]" + ";p [bar]", *rows(degrees, pressure).splitlines()]
    content = PASTED[paste](lines)
    found = reading(content, "petrol", "", ABSOLUTE)
    assert found.torque == pytest.approx(torque_of("petrol"), rel=1e-3), found.words


@for_each("separated", [True, False])
def test_spaces_between_thousands_are_none(reading, separated):
    degrees, pressure = cycle_of("petrol")
    space = "\N{NO-BREAK SPACE}" if separated else "\N{NARROW NO-BREAK SPACE}"
    lines = [f"{x:g};{thousands(1000 * y, space)}" for x, y in zip(degrees, pressure, strict=True)]
    content = "CA [deg];p [mbar]\n" + "\n".join(lines)
    assert reading(content, "petrol", "", ABSOLUTE).torque == pytest.approx(torque_of("petrol"), rel=1e-3)


@for_each("mark", [".", ","])
def test_a_single_mark_that_may_be_between_thousands_is_asked_about(reading, mark):
    degrees, pressure = cycle_of("petrol")
    lines = [
        f"{x:g};{y:.1f}".replace(".", "," if mark == "." else ".") for x, y in zip(degrees, 100 * pressure, strict=True)
    ]
    lines[20] = "20;" + ("1.013,1" if mark == "." else "1,013.1")
    words = reading("CA [deg];p [kPa]\n" + "\n".join(lines), "petrol", "", ABSOLUTE).words
    assert "line 22: " in words
    assert f"write {'1013,1' if mark == '.' else '1013.1'} if it is that number, else correct it" in words


def test_missing_numbers_in_one_column_are_told_all_at_once(reading):
    lines = rows(*cycle_of("petrol")).splitlines()
    for row in (7, 300):
        lines[row] = f"{row};n/a"
    words = reading("CA [deg]\np [bar]\n" + "\n".join(lines).replace(";", "\n"), "petrol", "", ABSOLUTE).words
    assert re.findall(r'line (\d+): "n/a"', words) == ["17", "603"]


def test_a_mark_that_differs_is_told_in_its_own_row_only(reading):
    lines = rows(*cycle_of("petrol")).splitlines()
    lines[300] = "300;7,5"
    assert re.findall(r"line (\d+)", reading("\n".join(lines), "petrol", BAR, ABSOLUTE).words) == ["301"]


def test_headings_over_merged_cells_are_those_of_each_column(tmp_path):
    degrees, pressure = cycle_of("petrol")
    with xlsxwriter.Workbook(tmp_path / "p.xlsx") as book:
        sheet = book.add_worksheet()
        sheet.merge_range(0, 1, 0, 2, "Pressure [bar]")
        sheet.merge_range(0, 0, 1, 0, "Crank angle [deg]")
        sheet.write_row(1, 1, ["Cyl 1", "Cyl 2"])
        for row, (x, y) in enumerate(zip(degrees.tolist(), pressure.tolist(), strict=True), start=2):
            sheet.write_row(row, 0, [x, y, 0.9 * y])
    text = MACHINE.format(ratio=9.0, pressures=ABSOLUTE, keys='pressure_column = "Cyl 1"').replace("p.txt", "p.xlsx")
    results = crankwork.analyse(crankwork.read_machine(text, folder=tmp_path))
    assert results.summary["mean_torque"] == pytest.approx(torque_of("petrol"), rel=1e-3)
