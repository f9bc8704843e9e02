"""`check --expand`, and the schema in every language."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

from crankwork.description.machine_file import template


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


def test_a_file_is_written_out_with_its_method_and_its_cycle(crankwork):
    Path("my.toml").write_text(template("engine").replace('"exact"', '"textbook"'), "utf-8")
    answer = crankwork("check", "my.toml", "--expand")
    assert (answer.code, answer.err) == (0, "")
    assert tomllib.loads(answer.out)["method"]["kinematics"] == "textbook"
    Path("again.toml").write_text(answer.out, "utf-8")
    for option in ((), ("--compare", "exact")):
        answers = [crankwork("run", name, *option) for name in ("my.toml", "again.toml")]
        assert [answer.code for answer in answers] == [0, 0]
        # what is a default in one file is stated in the other
        first, second = (answer.out.partition("\n")[2].partition("Assumptions")[0] for answer in answers)
        assert first == second
    Path("whole.toml").write_text(template("whole-engine"), "utf-8")
    out = crankwork("check", "whole.toml", "--expand").out
    assert "not written out" not in out
    assert tomllib.loads(out)["chambers"]["cylinder_1"]["cycle"]["kind"] == "petrol"


def test_what_a_linkage_does_not_have_is_told_in_the_file(crankwork):
    burning = Path(__file__).parents[1] / "machines" / "burning.toml"
    for language, told in {"en": "is left out", "ru": "не записано", "vi": "không được ghi"}.items():
        out = crankwork("check", str(burning), "--expand", "--lang", language).out
        assert f"# [gas.combustion] {told}" in out
        assert "combustion" not in tomllib.loads(out)["chambers"]["cylinder"]
    Path("my.toml").write_text(template("engine"), "utf-8")
    assert "is left out" not in crankwork("check", "my.toml", "--expand").out


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
