"""Goal seeking on the command line: what is printed, and what is refused."""

from __future__ import annotations

import json
import signal
import sys
import time

import pytest

ASKED = ("point_y.B@0 = 80", "--for", "links.coupler.length", "--from", "10 mm", "--to", "400 mm", "--steps", "16")
ENGINE = ("piston_force@33deg = 0", "--for", "crank.speed")

WRONG = {
    "no equation": (
        ("piston_force", *ENGINE[1:]),
        '"piston_force": write a value of the results, = and what it is to be, like',
    ),
    "nothing wanted": (("piston_force@33deg =", *ENGINE[1:]), '"piston_force@33deg =": write a value of the results'),
    "no place after the sign": (("piston_force@ = 0", *ENGINE[1:]), '"piston_force@ = 0": write a value'),
    "unknown value": (
        ("piston_farce@33deg = 0", *ENGINE[1:]),
        "there is no result piston_farce; did you mean piston_force",
    ),
    "value that engines have not": (
        ("time_ratio.A = 1", *ENGINE[1:], "--steps", "10"), "this machine has no time_ratio.A by its method, exact",
    ),
    "no angle": (
        ("piston_force = 0", *ENGINE[1:]),
        "piston_force varies over the cycle; say where it is to have the value: piston_force@90deg",
    ),
    "angle of one value": (
        ("stroke@3 = 90", *ENGINE[1:]),
        "stroke is one value for the whole cycle; leave out what stands after the @",
    ),
    "angle outside": (("piston_force@800 = 0", *ENGINE[1:]), "there is no crank angle of 800 deg in the cycle"),
    "angle of a length": (
        ("piston_force@3mm = 0", *ENGINE[1:]),
        '@3mm: unit "mm" measures length; angle is wanted: deg, rad',
    ),
    "value in another unit": (
        ("piston_force@33 = 3 kg", *ENGINE[1:]), 'piston_force = 3 kg: unit "kg" measures mass; force is wanted: N, kN',
    ),
    "value that is no number": (("piston_force@33 = nan", *ENGINE[1:]), 'piston_force = nan: "nan" is not a number'),
    "no plain number": (("rod_ratio = 3 mm", *ENGINE[1:]), 'rod_ratio = 3 mm: "3 mm" must be a plain number'),
    "no finite number": (("rod_ratio = inf", *ENGINE[1:]), 'rod_ratio = inf: "inf" must be a plain number'),
    "unknown field": ((ENGINE[0], "--for", "crank.sped"), "--for crank.sped: unknown key; did you mean speed?"),
    "unknown table": ((ENGINE[0], "--for", "crnak.speed"), "--for crnak.speed: unknown key; did you mean crank?"),
    "field of no file": ((ENGINE[0], "--for", "crank"), "--for crank: is not a single number of the file"),
    "field that is a word": (
        (ENGINE[0], "--for", "rod.ratio_definition"),
        "--for rod.ratio_definition: is not a single number",
    ),
    "field that counts": ((ENGINE[0], "--for", "engine.cylinders"), "--for engine.cylinders: counts something"),
    "field in brackets": ((ENGINE[0], "--for", "gas.pieces[x].exponent"), "gas.pieces[x].exponent: is no key"),
    "entry of no list": ((ENGINE[0], "--for", "crank[1]"), "crank[1]: is no key"),
    "no field": ((ENGINE[0],), "--for: is missing; write --for KEY, see --help"),
    "empty range": ((*ENGINE, "--from", "5 rpm", "--to", "5 rpm"), "the range from 5 rpm to 5 rpm is empty"),
    "range turned round": (
        (*ENGINE, "--from", "500", "--to", "5 rpm"),
        "is empty; give --from a value below that of --to",
    ),
    "range in another unit": (
        (*ENGINE, "--from", "5 mm", "--to", "9 rpm"),
        '--from: unit "mm" measures length; speed is wanted',
    ),
    "range of letters": ((*ENGINE, "--from", "slow", "--to", "9 rpm"), '--from: "slow" is not a number with a unit'),
    "range beyond the field": ((*ENGINE, "--from", "-3 rpm", "--to", "9 rpm"), "--from: crank.speed is from"),
    "range that is no number": (
        (ENGINE[0], "--for", "rod.ratio", "--from", "nan", "--to", "1"), "--from: rod.ratio is from 1e-06 to 1000000.0",
    ),
    "steps of letters": ((*ENGINE, "--steps", "many"), "--steps: take a whole number from 10 to 100000"),
    "no steps": ((*ENGINE, "--steps", "0"), "--steps: take a whole number from 10 to 100000"),
    "nothing to look around": (
        (ENGINE[0], "--for", "cylinder.offset"),
        "--from: is missing; nothing says how far cylinder.offset",
    ),
    "setting": ((*ENGINE, "--set", "rod.ratoi=1"), "--set rod.ratoi: unknown key; did you mean ratio?"),
}  # fmt: skip


@pytest.mark.parametrize(("options", "answered"), WRONG.values(), ids=WRONG)
def test_a_wrong_question_is_refused_with_what_to_write(crankwork, machine_file, check_mistakes, options, answered):
    answer = crankwork("solve", machine_file(), *options)
    check_mistakes(answer)
    assert answered in answer.err


def test_solutions_stretches_and_the_range_are_printed_in_line(crankwork, machine_file):
    answer = crankwork("solve", machine_file(name="four-bar"), *ASKED)
    assert (answer.code, answer.err) == (0, "")
    lines = answer.out.splitlines()
    assert lines[:4] == [
        "Four-bar linkage",
        "Coordinate y of point B (0°) = 80 mm",
        "links.coupler.length from 10 to 400 mm in 16 steps of the ratio 1.259",
        "two solutions, or two ends of a stretch, less than a step apart may be missed",
    ]
    assert lines[5:8] == [
        "Solutions",
        "  links.coupler.length  99.0503582685 mm  the value rises through it",
        "  links.coupler.length   230.89830343 mm  the value falls through it",
    ]
    assert lines[9] == "No value"
    assert [line.partition(" mm  ")[0] for line in lines[10:]] == [
        "  links.coupler.length    10 … 25",
        "  links.coupler.length  250 … 375",
        "  links.coupler.length  375 … 400",
    ]
    assert all("  links" in line for line in lines[10:])


def test_the_same_as_one_json_object(crankwork, machine_file):
    answer = crankwork("solve", machine_file(name="four-bar"), *ASKED, "--json")
    found = json.loads(answer.out)
    assert found["wanted"] == {"key": "point_y.B", "value": 80.0, "unit": "mm"}
    assert found["at"] == {"value": 0.0, "unit": "deg"}
    assert found["range"] == {"from": 10.0, "to": 400.0, "steps": 16, "even": False, "stated": True}
    assert [one["kind"] for one in found["solutions"]] == ["rising", "falling"]
    assert [one["value"] for one in found["solutions"]] == pytest.approx([99.0503582685, 230.89830343])
    assert len(found["without"]) == 3
    # which the file takes as it is written
    written = found["solutions"][0]["written"]
    told = crankwork("explain", machine_file(name="four-bar"), "point_y.B", "--at", "0",
                     "--set", f"links.coupler.length={written}")  # fmt: skip
    assert "= 80\u00a0mm" in told.out


LANGUAGES = {
    "en": ("from 3000 to 6000 rpm in 10 steps of 300", "No solution in this range", "nearest: "),
    "ru": ("от 3000 до 6000 мин⁻¹, шагов 10, шаг 300", "В этой области решений нет", "ближе всего: "),
    "vi": ("từ 3000 đến 6000 vg/ph, 10 bước, mỗi bước 300", "Không có nghiệm trong khoảng này", "gần nhất: "),
}


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_solution_is_told_with_what_comes_nearest(crankwork, machine_file, language):
    asked = (*ENGINE, "--from", "3000 rpm", "--to", "6000", "--steps", "10", "--lang", language)
    answer = crankwork("solve", machine_file(), *asked)
    assert answer.code == 0
    for words in LANGUAGES[language]:
        assert words in answer.out
    assert "crank.speed = 3000 " in answer.out.splitlines()[-1]


def test_a_range_that_is_chosen_is_said_to_be(crankwork, machine_file):
    answer = crankwork("solve", machine_file(), *ENGINE, "--steps", "10")
    assert answer.out.splitlines()[2] == (
        "crank.speed from 300 to 30000 rpm in 10 steps of the ratio 1.585; "
        "chosen around the value or by the limits of the field, write --from and --to for another range"
    )


def test_a_value_that_nothing_changes_is_told_as_a_stretch(crankwork, machine_file):
    answer = crankwork("solve", machine_file(), "side_force@0 = 0", "--for", "crank.speed", "--steps", "10")
    assert "The value is as wanted all along\n  crank.speed  300 … 30000 rpm\n" in answer.out


def test_a_decimal_comma_and_settings_are_taken(crankwork, machine_file):
    asked = ("rod_ratio = 0,25", "--for", "crank.radius", "--from", "20,5 mm", "--to", "60", "--steps", "10")
    answer = crankwork("solve", machine_file(), *asked, "--set", "rod.length=100 mm")
    assert "  crank.radius  25 mm  the value rises through it" in answer.out


@pytest.mark.skipif(sys.platform == "win32", reason="signals are those of Unix")
def test_it_can_be_interrupted(machine_file, spawn):
    running = spawn("solve", machine_file(), *ENGINE, "--steps", "100000")
    time.sleep(2.0)
    running.send_signal(signal.SIGINT)
    out, err = running.communicate(timeout=20)
    assert (running.returncode, out, err.strip()) == (130, b"", b"")
