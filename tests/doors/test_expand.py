"""`check --expand`, and the schema in every language."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest

from crankwork.description.machine_file import template
from each import for_each


def test_a_file_written_out_can_be_run_and_gives_its_torque_by_the_same_name(crankwork):
    for name in ("four-bar", "engine"):
        Path("my.toml").write_text(template(name), "utf-8")
        answer = crankwork("check", "my.toml", "--expand")
        assert (answer.code, answer.err) == (0, "")
        assert {"links", "method", "table"} <= tomllib.loads(answer.out).keys()
        Path("again.toml").write_text(answer.out, "utf-8")
        assert crankwork("run", "again.toml").code == 0
    for language, given in {
        "en": "mean crank torque", "ru": "средний крутящий момент", "vi": "mômen quay trung bình",
    }.items():  # fmt: skip
        told = [crankwork("run", name, "--lang", language).out for name in ("my.toml", "again.toml")]
        lines = [next(line.split() for line in text.splitlines() if given in line) for text in told]
        assert lines[0] == lines[1]
        assert float(lines[1][-2].replace(",", ".")) > 0


@pytest.mark.slow
@for_each(
    ("language", "told"),
    [
        ("ru", "# [cycle] записан давлениями"),
        ("en", "# [cycle] is written out as the pressures"),
        ("vi", "# [cycle] được ghi ra bằng các áp suất"),
    ],
)
def test_what_is_written_out_otherwise_is_told_above(crankwork, language, told):
    Path("my.toml").write_text(template("whole-engine"), "utf-8")
    answer = crankwork("check", "my.toml", "--expand", "--lang", language)
    assert (answer.code, answer.err) == (0, "")
    head = answer.out.partition("\nformat")[0]
    assert told in head
    assert head.count("#") == 1


def test_a_method_that_is_not_exact_can_be_set_aside(crankwork, check_refusals):
    Path("my.toml").write_text(template("engine").replace('"exact"', '"textbook"'), "utf-8")
    asked = ("check", "my.toml", "--expand")
    check_refusals([(asked, "--set method.kinematics=exact")])
    assert crankwork(*asked, "--set", "method.kinematics=exact").code == 0


def test_a_file_is_written_out_alone(check_refusals):
    Path("my.toml").write_text(template("four-bar"), "utf-8")
    alone = "leave out --circuits and --json"
    also = (("--circuits",), ("--json",), ("--circuits", "--json"))
    check_refusals((("check", "my.toml", "--expand", *one), alone) for one in also)


def test_the_schema_says_what_keys_mean_in_every_language(crankwork):
    for language, told in {"en": "speed of rotation", "ru": "частота вращения", "vi": "số vòng quay"}.items():
        schema = json.loads(crankwork("schema", "--lang", language).out)
        assert schema["title"] == "crankwork machine file"
        speed = schema["anyOf"][0]["properties"]["crank"]["properties"]["speed"]
        assert told in speed["description"]
        assert (speed["unit"], speed["maximum"] > speed["minimum"] > 0) == ("rpm", True)
