"""Goal seeking on the command line: what is printed, and what is refused."""

from __future__ import annotations

import contextlib
import json

import pytest

from crankwork.study.solve import solve

ASKED = ("point_y.B@0 = 80", "--for", "links.coupler.length", "--from", "10 mm", "--to", "400 mm", "--steps", "10")
ENGINE = ("piston_force@33deg = 0", "--for", "crank.speed")

WRONG_EQUATIONS = {
    "piston_force": '"piston_force": write a value of the results, = and what it is to be, like',
    "piston_force@33deg =": '"piston_force@33deg =": write a value of the results',
    "piston_force@ = 0": '"piston_force@ = 0": write a value',
    "piston_farce@33deg = 0": "there is no result piston_farce; did you mean piston_force",
    "time_ratio.A = 1": "this machine has no time_ratio.A by its method, exact",
    "piston_force = 0": "piston_force varies over the cycle; say where it is to have the value: piston_force@90deg",
    "stroke@3 = 90": "stroke is one value for the whole cycle; leave out what stands after the @",
    "piston_force@800 = 0": "there is no crank angle of 800 deg in the cycle",
    "piston_force@3mm = 0": '@3mm: unit "mm" measures length; angle is wanted: deg, rad',
    "piston_force@33 = 3 kg": 'piston_force = 3 kg: unit "kg" measures mass; force is wanted: N, kN',
    "piston_force@33 = nan": 'piston_force = nan: "nan" is not a number',
    "rod_ratio = 3 mm": 'rod_ratio = 3 mm: "3 mm" must be a plain number',
    "rod_ratio = inf": 'rod_ratio = inf: "inf" must be a plain number',
}
WRONG_FIELDS = {
    "crank.sped": "--for crank.sped: unknown key; did you mean speed?",
    "crnak.speed": "--for crnak.speed: unknown key; did you mean crank?",
    "crank": "--for crank: is not a single number of the file",
    "rod.ratio_definition": "--for rod.ratio_definition: is not a single number",
    "engine.cylinders": "--for engine.cylinders: counts something",
    "gas.pieces[x].exponent": "gas.pieces[x].exponent: is no key",
    "crank[1]": "crank[1]: is no key",
    "cylinder.offset": "--from: is missing; nothing says how far cylinder.offset",
}
RATIO = ("--for", "rod.ratio", "--from", "nan", "--to", "1")
WRONG = [
    ((ENGINE[0],), "--for: is missing; write --for KEY, see --help"),
    ((*ENGINE, "--from", "5 rpm", "--to", "5 rpm"), "the range from 5 rpm to 5 rpm is empty"),
    ((*ENGINE, "--from", "500", "--to", "5 rpm"), "is empty; write the smaller number first"),
    ((*ENGINE, "--from", "5 mm", "--to", "9 rpm"), '--from: unit "mm" measures length; speed is wanted'),
    ((*ENGINE, "--from", "slow", "--to", "9 rpm"), '--from: "slow" is not a number with a unit'),
    ((*ENGINE, "--from", "-3 rpm", "--to", "9 rpm"), "--from: crank.speed is from"),
    ((ENGINE[0], *RATIO), "--from: rod.ratio is from 1e-06 to 1000000.0"),
    ((*ENGINE, "--steps", "many"), "--steps: take a whole number from 10 to 100000"),
    ((*ENGINE, "--steps", "0"), "--steps: take a whole number from 10 to 100000"),
    ((*ENGINE, "--set", "rod.ratoi=1"), "--set rod.ratoi: unknown key; did you mean ratio?"),
    *(((equation, *ENGINE[1:], "--steps", "10"), told) for equation, told in WRONG_EQUATIONS.items()),
    *(((ENGINE[0], "--for", field), told) for field, told in WRONG_FIELDS.items()),
]


def test_a_wrong_question_is_refused_with_what_to_write(machine_file, check_refusals):
    name = machine_file()
    check_refusals((("solve", name, *options), told) for options, told in WRONG)


def test_solutions_stretches_and_the_range_are_printed_in_line_and_as_one_json_object(
    crankwork, machine_file, monkeypatch
):
    solutions = []

    def solved_once(*question, **options):
        if not solutions:
            solutions.append(solve(*question, **options))
        return solutions[0]

    monkeypatch.setattr("crankwork.study.solve.solve", solved_once)
    answer = crankwork("solve", machine_file(name="four-bar"), *ASKED)
    assert (answer.code, answer.err) == (0, "")
    lines = answer.out.splitlines()
    assert lines[:4] == [
        "Four-bar linkage",
        "Coordinate y of point B (0°) = 80 mm",
        "links.coupler.length from 10 to 400 mm in 10 steps of the ratio 1.446",
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
    found = json.loads(crankwork("solve", "my.toml", *ASKED, "--json").out)
    assert found["wanted"] == {"key": "point_y.B", "value": 80.0, "unit": "mm"}
    assert found["at"] == {"value": 0.0, "unit": "deg"}
    assert found["range"] == {"from": 10.0, "to": 400.0, "steps": 10, "even": False, "stated": True}
    assert [one["kind"] for one in found["solutions"]] == ["rising", "falling"]
    assert [one["value"] for one in found["solutions"]] == pytest.approx([99.0503582685, 230.89830343])
    assert len(found["without"]) == 3
    # which the file takes as it is written
    setting = f"links.coupler.length={found['solutions'][0]['written']}"
    assert "= 80\u00a0mm" in crankwork("explain", "my.toml", "point_y.B", "--at", "0", "--set", setting).out


def test_no_solution_is_told_with_what_comes_nearest(crankwork, machine_file):
    asked = ("solve", machine_file(), *ENGINE, "--from", "3000 rpm", "--to", "6000", "--steps", "10", "--lang")
    for language, words in {
        "en": ("from 3000 to 6000 rpm in 10 steps of 300", "No solution in this range", "nearest: "),
        "ru": ("от 3000 до 6000 мин⁻¹, шагов 10, шаг 300", "В этой области решений нет", "ближе всего: "),
        "vi": ("từ 3000 đến 6000 vg/ph, 10 bước, mỗi bước 300", "Không có nghiệm trong khoảng này", "gần nhất: "),
    }.items():
        answer = crankwork(*asked, language)
        assert (answer.code, [one for one in words if one not in answer.out]) == (0, []), language
        assert "crank.speed = 3000 " in answer.out.splitlines()[-1]


def test_a_range_that_is_chosen_is_said_to_be_and_a_value_that_nothing_changes_is_a_stretch(crankwork, machine_file):
    answer = crankwork("solve", machine_file(), "side_force@0 = 0", *ENGINE[1:], "--steps", "10")
    assert answer.out.splitlines()[2] == (
        "crank.speed from 300 to 30000 rpm in 10 steps of the ratio 1.585; "
        "chosen around the value or by the limits of the field, write --from and --to for another range"
    )
    assert "The value is as wanted all along\n  crank.speed  300 … 30000 rpm\n" in answer.out


def test_a_decimal_comma_and_settings_are_taken(crankwork, machine_file):
    asked = ("rod_ratio = 0,25", "--for", "crank.radius", "--from", "20,5 mm", "--to", "60", "--steps", "10")
    answer = crankwork("solve", machine_file(), *asked, "--set", "rod.length=100 mm")
    assert "  crank.radius  25 mm  the value rises through it" in answer.out


def test_each_of_several_numbers_has_its_range(crankwork, machine_file):
    """A rod of 4 radii and a stroke of 80 mm, each sought in a range of its own."""
    asked = ("rod_ratio = 0.25", "stroke = 80 mm", "--for", "crank.radius", "--for", "rod.length")
    ends = ("--from", "30 mm", "--to", "60 mm", "--from", "100 mm", "--to", "200 mm")
    found = crankwork("solve", machine_file(), *asked, *ends, "--json").results["solutions"]
    assert found == [{"crank.radius": pytest.approx(40.0), "rod.length": pytest.approx(160.0)}]


def test_it_can_be_interrupted(crankwork, machine_file, monkeypatch):
    def interrupt(_share):
        raise KeyboardInterrupt

    monkeypatch.setattr("crankwork.cli.progress_bar", lambda: contextlib.nullcontext(interrupt))
    answer = crankwork("solve", machine_file(), *ENGINE, "--steps", "10")
    assert (answer.code, answer.out, answer.err.strip()) == (130, "", "")
