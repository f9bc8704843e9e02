"""`check --expand`, and the schema in every language."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest

from crankwork.description.machine_file import template


@pytest.mark.parametrize("name", ["engine", "four-bar"])
def test_a_file_written_out_can_be_run(crankwork, name):
    Path("my.toml").write_text(template(name), "utf-8")
    answer = crankwork("check", "my.toml", "--expand")
    assert (answer.code, answer.err) == (0, "")
    assert {"links", "method", "table"} <= tomllib.loads(answer.out).keys()
    Path("again.toml").write_text(answer.out, "utf-8")
    assert crankwork("run", "again.toml").code == 0


@pytest.mark.parametrize(
    ("language", "told"),
    [
        ("en", "# not written out: [bearings], their sizes"),
        ("ru", "# не записано: [bearings], размеры"),
        ("vi", "# không ghi ra: [bearings], kích thước"),
    ],
)
def test_what_cannot_be_written_out_is_told_above(crankwork, language, told):
    Path("my.toml").write_text(template("whole-engine"), "utf-8")
    answer = crankwork("check", "my.toml", "--expand", "--lang", language)
    assert (answer.code, answer.err) == (0, "")
    assert told in answer.out.partition("\nformat")[0]
    assert all(f"[{table}]" in answer.out.partition("\nformat")[0] for table in ("engine", "bearings"))


def test_a_method_that_is_not_exact_can_be_set_aside(crankwork):
    Path("my.toml").write_text(template("engine").replace('"exact"', '"textbook"'), "utf-8")
    answer = crankwork("check", "my.toml", "--expand")
    assert (answer.code, "--set method.kinematics=exact" in answer.err) == (2, True)
    assert crankwork("check", "my.toml", "--expand", "--set", "method.kinematics=exact").code == 0


@pytest.mark.parametrize("also", [("--circuits",), ("--json",), ("--circuits", "--json")])
def test_a_file_is_written_out_alone(crankwork, also):
    Path("my.toml").write_text(template("four-bar"), "utf-8")
    answer = crankwork("check", "my.toml", "--expand", *also)
    assert (answer.code, answer.out) == (2, "")
    assert "leave out --circuits and --json" in answer.err


@pytest.mark.parametrize(
    ("language", "told"), [("en", "speed of rotation"), ("ru", "частота вращения"), ("vi", "số vòng quay")]
)
def test_the_schema_says_what_keys_mean_in_every_language(crankwork, language, told):
    schema = json.loads(crankwork("schema", "--lang", language).out)
    speed = schema["anyOf"][0]["properties"]["crank"]["properties"]["speed"]
    assert told in speed["description"]
    assert (speed["unit"], speed["maximum"] > speed["minimum"] > 0) == ("rpm", True)


@pytest.mark.parametrize(
    ("language", "given"),
    [("en", "mean crank torque"), ("ru", "средний крутящий момент"), ("vi", "mômen quay trung bình")],
)
def test_the_linkage_that_an_engine_is_gives_its_torque_by_the_same_name(crankwork, language, given):
    Path("my.toml").write_text(template("engine"), "utf-8")
    Path("again.toml").write_text(crankwork("check", "my.toml", "--expand").out, "utf-8")
    told = [crankwork("run", name, "--lang", language).out for name in ("my.toml", "again.toml")]
    lines = [next(line.split() for line in text.splitlines() if given in line) for text in told]
    assert lines[0] == lines[1]
    assert float(lines[1][-2].replace(",", ".")) > 0
