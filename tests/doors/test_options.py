"""The options of the command line: what each does, and what is said where it cannot."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from crankwork.description.machine_file import template, template_title

WRONG = {
    "set without value": (("--set", "rod.ratio"), "--set rod.ratio: write --set KEY=VALUE, like --set rod.ratio=0.25"),
    "set without key": (("--set", "=1"), "--set =1: write --set KEY=VALUE"),
    "set with a dot too many": (("--set", "rod..ratio=1"), "--set rod..ratio=1: write --set KEY=VALUE"),
    "set too deep": (("--set", "a.b.c.d.e.f.g.h.i=1"), "--set a.b.c.d.e.f.g.h.i=1: write --set KEY=VALUE"),
    "set below a value": (("--set", "crank.radius.x=1"), "--set crank.radius.x: radius is not a table in this file"),
    "set in a list": (("--set", "gas.pieces.law=1"), "--set gas.pieces.law: pieces is not a table in this file"),
    "set beyond a list": (("--set", "gas.pieces[9].law=1"), "--set gas.pieces[9].law: there is no entry 9"),
    "set of entry 0": (("--set", "gas.pieces[0].law=1"), "--set gas.pieces[0].law: there is no entry 0"),
    "set of an entry of no list": (("--set", "crank[1]=1"), "--set crank[1]: crank is not a list in this file"),
    "set in brackets that are none": (("--set", "gas.pieces[a]=1"), "--set gas.pieces[a]=1: write --set KEY=VALUE"),
    "set of an unknown key": (("--set", "rod.ratoi=1"), "--set rod.ratoi: unknown key; did you mean ratio?"),
    "set of an unknown table": (("--set", "rdo.ratio=1"), "--set rdo: unknown table; did you mean rod?"),
    "set of a table": (("--set", "crank=5"), "--set crank: must be a table; put its keys below a line [crank]"),
    "set of a table inline": (("--set", "table={step=1}"), '--set table.step: 1 has no unit; write it as text'),
    "set with a wrong value": (("--set", "rod.ratio=abc"), '--set rod.ratio: "abc" must be a plain number'),
    "set with a wrong unit": (("--set", "crank.radius=3 kg"), '--set crank.radius: unit "kg" measures mass; length is'),
    "set without unit": (("--set", "crank.radius=30"), '--set crank.radius: 30 has no unit; write it as text with a'),
    "set with l/r": (("--set", "rod.ratio=4"), "--set rod.ratio: 4 would make the rod no longer than the crank"),
    "set with a long value": (("--set", "title=" + "x" * 5000), "--set title: the value is too long"),
    "set with thousands of digits": (("--set", "rod.ratio=" + "9" * 4090), "--set rod.ratio: "),
    "set with brackets": (("--set", "rod.ratio=" + "[" * 4000), "--set rod.ratio: "),
    "set with a line break": (("--set", "title=a\nb"), '--set title: "a\\nb" holds a line break'),
    "set of a date": (("--set", "rod.ratio=1979-05-27"), "--set rod.ratio: 1979-05-27 must be a plain number"),
    "step 0": (("--step", "0"), '--step: "0 deg" is out of range; write at least "0.01 deg" and at most "180 deg"'),
    "step negative": (("--step", "-5"), '--step: "-5 deg" is out of range; write at least "0.01 deg"'),
    "step tiny": (("--step", "1e-9"), '--step: "1e-9 deg" is out of range'),
    "step of letters": (("--step", "abc"), '--step: "abc" is not a number with a unit; write it like "30 deg"'),
    "step of a length": (("--step", "5 mm"), '--step: unit "mm" measures length; angle is wanted: deg, rad'),
    "step empty": (("--step", ""), '--step: "" is not a number with a unit; write it like "30 deg"'),
    "step with quotes": (("--step", '1" #'), "--step: "),
    "step with a comma": (("--step", "2,5"), '--step: "2,5 deg" has a decimal comma; write "2.5 deg"'),
    "method": (("--method", "foo"), '--method: method "foo" does not exist; write exact, textbook or series:N'),
    "method with quotes": (("--method", 'ex"act'), "--method: "),
    "method too long": (("--method", "x" * 1000), "--method: "),
    "series of none": (("--method", "series:0"), "--method: "),
    "series of many": (("--method", "series:99999999"), "--method: "),
    "series of letters": (("--method", "series:x"), "N from 1 to 200"),
    "language": (("--lang", "xx"), "--lang: xx is not possible; write en, ru or vi"),
    "unknown option": (("--overwirte",), "--overwirte: there is no such option; did you mean --overwrite?"),
    "no value": (("--set",), "--set: needs a value; see --help"),
    "two files": (("other.toml",), "other.toml: is not expected here; leave it out, or put"),
}  # fmt: skip


@pytest.mark.parametrize(("options", "answered"), WRONG.values(), ids=WRONG)
def test_a_wrong_option_is_named_with_what_to_write(
    crankwork, machine_file, check_mistakes, tmp_path, options, answered
) -> None:
    answer = crankwork("run", machine_file(), "-o", "out", *options)
    check_mistakes(answer)
    (line,) = answer.mistakes
    assert answered in line
    assert not (tmp_path / "out").exists()


def test_mistakes_of_options_and_of_the_file_are_told_together(crankwork, machine_file) -> None:
    answer = crankwork("run", machine_file(('"0.55 kg"', '"x"')), "--step", "0", "--method", "x", "--set", "rod.x=1")
    assert [line.partition(": ")[0] for line in answer.mistakes] == ["--set rod.x", "--step", "--method", "my.toml:22"]


@pytest.mark.parametrize(
    ("speed", "rotational", "angular"), [("30 rad/s", 300.0, 30.0), ("30 рад/с", 300.0, 30.0), ("30 rpm", 30.0, 3.0)]
)
@pytest.mark.parametrize("name", ["slider-crank", "four-bar"])
def test_a_speed_in_radians_is_that_speed_whatever_pi_a_document_has(
    crankwork, name, speed, rotational, angular
) -> None:
    Path("my.toml").write_text(template(name), "utf-8")
    answer = crankwork("run", "my.toml", "--json", "--set", "method.pi=3.0", "--set", f"crank.speed={speed}")
    summary = json.loads(answer.out)["summary"]
    assert summary["rotational_speed"]["value"] == pytest.approx(rotational)
    assert summary["speed"]["value"] == pytest.approx(angular)


@pytest.mark.parametrize(
    "text", ['[crank]\nradius = "45 mm"\nspeed = "3000 rpm"\n[rod]\nratio = 0.3\n', template("four-bar")]
)
def test_forces_per_area_need_the_bore(crankwork, machine_file, check_mistakes, text) -> None:
    answer = crankwork("run", machine_file(text=text), "--per-area")
    check_mistakes(answer)
    sentence = "needs the piston area; give cylinder.bore in the file, or leave this option out"
    assert answer.err == f"--per-area: {sentence}\n"


@pytest.mark.parametrize(
    ("arguments", "answered"),
    [
        (("new", "fourbar"), 'there is no template "fourbar"; did you mean four-bar?'),
        (("reprot", "my.toml"), '"reprot": there is no such command; did you mean report?'),
        (("my.toml",), "my.toml: a command comes first; write crankwork check my.toml, or"),
        (
            ("--lang", "ru", "run", "my.toml"),
            "--lang: параметр команды; запишите его после неё, например crankwork run",
        ),
        (("new", "steam"), 'there is no template "steam"; there are: compressor, crank-shaper, engine, four-bar, '),
        (("new", "../../engine"), "there is no template"),
        (("new", "a\x1b[31m"), '"a\\x1b[31m"'),
        (("check",), "FILE: is missing; write it after the command"),
        (
            ("zoom", "my.toml"),
            '"zoom": there is no such command; write new, check, run, report, page, draw, sweep, optimise, map, ',
        ),
        (("schema", "x"), "x: is not expected here; leave it out"),
    ],
)
def test_a_wrong_command_is_answered_in_one_line(crankwork, check_mistakes, arguments, answered) -> None:
    answer = crankwork(*arguments)
    check_mistakes(answer)
    assert len(answer.mistakes) == 1
    assert answered in answer.err


@pytest.mark.parametrize("at", ["390.5", "390,5", "390.5 deg", "6.815510728937 rad"])
def test_an_angle_is_read_as_it_is_printed(crankwork, machine_file, at) -> None:
    answer = crankwork("explain", machine_file(), "piston_velocity", "--at", at, "--lang", "ru")
    assert "(390,5°)" in answer.out.partition("\n")[0]


def test_an_angle_that_is_none_is_told_in_the_language(crankwork, machine_file, check_mistakes) -> None:
    answer = crankwork("explain", machine_file(), "piston_velocity", "--at", "abc", "--lang", "vi")
    check_mistakes(answer)
    assert answer.err == '--at: "abc": không phải số kèm đơn vị; hãy ghi như "30 deg"\n'


def test_a_result_that_the_method_does_not_give_is_told_with_the_method(crankwork, machine_file) -> None:
    answer = crankwork("explain", machine_file(), "rod_transverse_force", "--method", "textbook")
    assert answer.code == 2
    assert "by its method, textbook" in answer.err


def test_a_setting_replaces_what_says_the_same(crankwork, machine_file) -> None:
    name = machine_file()
    plain, changed = (
        crankwork("run", name, "--json", *one).results["summary"] for one in ((), ("--set", "rod.ratio=0.34"))
    )
    assert changed["rod_ratio"] == {"value": 0.34, "unit": ""}
    assert changed["rod_length"]["value"] == pytest.approx(45 / 0.34)
    assert plain["rod_ratio"]["value"] == pytest.approx(45 / 160)
    assert changed["piston_acceleration_max"] != plain["piston_acceleration_max"]


@pytest.mark.parametrize(
    ("setting", "key", "value"),
    [
        ("crank.speed=1500 rpm", "rotational_speed", 1500),
        ('crank.speed="1500 об/мин"', "rotational_speed", 1500),
        (" crank.stroke = 80 mm ", "crank_radius", 40),
        ("crank.stroke=8 cm", "stroke", 80),
        ("cylinder.clearance_volume=70 cm3", "clearance_volume", 70),
        ("gas.points.z.pressure=6 MPa", "gas_pressure_max", 5.9),
        ("rod.ratio=1e-1", "rod_ratio", 0.1),
    ],
)
def test_a_setting_is_read_as_in_the_file(crankwork, machine_file, setting, key, value) -> None:
    assert crankwork("run", machine_file(), "--json", "--set", setting).results["summary"][key][
        "value"
    ] == pytest.approx(value)


def test_a_setting_of_a_list_is_named_for_its_entries(crankwork, machine_file) -> None:
    file = machine_file(name="whole-engine")
    answer = crankwork("run", file, "--set", "engine.misfire=[6]")
    assert answer.code == 2
    assert answer.mistakes[0].startswith("--set engine.misfire[1]: there is no cylinder 6; write numbers from 1 to 4")


def test_a_setting_reaches_into_lists(crankwork, machine_file) -> None:
    name, setting = machine_file(), "gas.pieces[3].exponent=1.3"
    plain, changed = (crankwork("run", name, "--json", *one).results["summary"] for one in ((), ("--set", setting)))
    # a compression of a smaller exponent takes less work
    assert changed["indicated_work"]["value"] > plain["indicated_work"]["value"]


def test_the_last_of_two_settings_counts(crankwork, machine_file) -> None:
    settings = ("--set", "crank.speed=1 rpm", "--set", "crank.speed=1500 rpm")
    assert crankwork("run", machine_file(), "--json", *settings).results["summary"]["rotational_speed"]["value"] == 1500


@pytest.mark.parametrize("step", ["15", "15 deg", "15deg", "15°", "15.0", "1.5e1"])
def test_a_step_is_in_degrees(crankwork, machine_file, tmp_path, step) -> None:
    answer = crankwork("run", machine_file(), "--step", step, "-o", "out", "--no-figures")
    assert answer.code == 0, answer.err
    assert len((tmp_path / "out/tables/forces.csv").read_text("utf-8").splitlines()) == 1 + 720 // 15 + 1 + 1


@pytest.mark.parametrize("method", ["exact", "textbook", "series:1", "series:6", "series:200"])
def test_a_method_is_taken_and_named(crankwork, machine_file, method) -> None:
    answer = crankwork("run", machine_file(), "--json", "--method", method)
    assert json.loads(answer.out)["method"] == method


def test_a_method_of_the_command_line_overrides_that_of_the_file(crankwork, machine_file) -> None:
    name = machine_file(('kinematics = "exact"', 'kinematics = "textbook"'))
    assert json.loads(crankwork("run", name, "--json").out)["method"] == "textbook"
    assert json.loads(crankwork("run", name, "--json", "--method", "exact").out)["method"] == "exact"


def test_a_title_with_emoji_and_any_script_is_printed_as_it_is(crankwork, machine_file) -> None:
    title = "Động cơ 👩‍🔧 двигатель <b>&amp;"
    answer = crankwork("run", machine_file(('"Four-stroke engine"', f"'{title}'")))
    assert answer.out.splitlines()[0] == title


def test_new_prints_the_names_or_the_template(crankwork) -> None:
    lines = crankwork("new").out.splitlines()
    assert [line.split()[0] for line in lines] == [
        "compressor", "crank-shaper", "engine", "four-bar", "press", "scotch-yoke", "slider-crank",
        "stephenson-six-bar", "toggle-press", "turning-moment", "watt-six-bar", "whitworth", "whole-engine",
    ]  # fmt: skip
    assert all(template_title(name, "en") == title for name, title in (line.split(maxsplit=1) for line in lines))
    assert "двигатель" in crankwork("new", "--lang", "ru").out
    assert crankwork("new", "engine").out == template("engine")


def test_circuits_are_listed(crankwork, machine_file) -> None:
    file = machine_file(name="four-bar")
    listed = crankwork("check", file, "--circuits")
    assert listed.code == 0
    assert "circuit 2, branch 1: crank turns fully; " in listed.out
    data = json.loads(crankwork("check", file, "--circuits", "--json").out)
    assert [one["circuit"] for one in data["branches"]] == [1, 2]
    refused = crankwork("check", file, "--json")
    assert (refused.code, "add --circuits" in refused.err) == (2, True)
