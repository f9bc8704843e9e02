"""The options of the command line: what each does, and what is said where it cannot."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from crankwork.description.machine_file import template, template_title

WRONG_SETTINGS = {
    "rod.ratio": "--set rod.ratio: write --set KEY=VALUE, like --set rod.ratio=0.25",
    "=1": "--set =1: write --set KEY=VALUE",
    "rod..ratio=1": "--set rod..ratio=1: write --set KEY=VALUE",
    "a.b.c.d.e.f.g.h.i=1": "--set a.b.c.d.e.f.g.h.i=1: write --set KEY=VALUE",
    "crank.radius.x=1": "--set crank.radius.x: radius is not a table in this file",
    "gas.pieces.law=1": "--set gas.pieces.law: pieces is a list in this file; write the number",
    "gas.pieces[9].law=1": "--set gas.pieces[9].law: there is no entry 9",
    "gas.pieces[0].law=1": "--set gas.pieces[0].law: there is no entry 0",
    "crank[1]=1": "--set crank[1]: crank is not a list in this file",
    "gas.pieces[a]=1": "--set gas.pieces[a]=1: write --set KEY=VALUE",
    "rod.ratoi=1": "--set rod.ratoi: unknown key; did you mean ratio?",
    "rdo.ratio=1": "--set rdo: unknown table; did you mean rod?",
    "crank=5": "--set crank: must be a table; put its keys below a line [crank]",
    "table={step=1}": "--set table.step: 1 has no unit; write it as text",
    "rod.ratio=abc": '--set rod.ratio: "abc" must be a plain number',
    "crank.radius=3 kg": '--set crank.radius: unit "kg" measures mass; length is',
    "crank.radius=30": "--set crank.radius: 30 has no unit; write it as text with a",
    "rod.ratio=4": "--set rod.ratio: 4 would make the rod no longer than the crank",
    "title=" + "x" * 5000: "--set title: the value is too long",
    "rod.ratio=" + "9" * 4090: "--set rod.ratio: ",
    "rod.ratio=" + "[" * 4000: "--set rod.ratio: ",
    "title=a\nb": '--set title: "a\\nb" holds a line break',
    "rod.ratio=1979-05-27": "--set rod.ratio: 1979-05-27 must be a plain number",
}
WRONG_STEPS = {
    "0": '"0 deg" is out of range; write at least "0.01 deg" and at most "180 deg"',
    "-5": '"-5 deg" is out of range; write at least "0.01 deg"',
    "1e-9": '"1e-9 deg" is out of range',
    "abc": '"abc" is not a number with a unit; write it like "30 deg"',
    "5 mm": 'unit "mm" measures length; angle is wanted: deg, rad',
    "": '"" is not a number with a unit; write it like "30 deg"',
    '1" #': "",
    "2,5": '"2,5 deg" has a decimal comma; write "2.5 deg"',
}
WRONG_METHODS = {
    "foo": 'method "foo" does not exist; write exact, textbook or series:N',
    'ex"act': "",
    "x" * 1000: "",
    "series:0": "",
    "series:99999999": "",
    "series:x": 'method "series:x" does not exist; write exact, textbook or series:N, N from 1 to 200',
}
WRONG = [
    (("--lang", "xx"), "--lang: xx is not possible; write en, ru or vi"),
    (("--overwirte",), "--overwirte: there is no such option; did you mean --overwrite?"),
    (("--set",), "--set: needs a value; see --help"),
    (("other.toml",), "other.toml: is not expected here; leave it out, or put"),
    *((("--set", setting), told) for setting, told in WRONG_SETTINGS.items()),
    *((("--step", step), f"--step: {told}") for step, told in WRONG_STEPS.items()),
    *((("--method", method), f"--method: {told}") for method, told in WRONG_METHODS.items()),
]
WRONG_COMMANDS = [
    (("new", "fourbar"), 'there is no template "fourbar"; did you mean four-bar?'),
    (("reprot", "my.toml"), '"reprot": there is no such command; did you mean report?'),
    (("my.toml",), "my.toml: a command comes first; write crankwork check my.toml, or"),
    (("--lang", "ru", "run", "my.toml"), "--lang: параметр команды; запишите его после неё, например crankwork run"),
    (
        ("new", "steam"),
        'there is no template "steam"; there are: balancing, chebyshev, clutch, compressor, crank-shaper, ',
    ),
    (("new", "../../engine"), "there is no template"),
    (("new", "a\x1b[31m"), '"a\\x1b[31m"'),
    (("check",), "FILE: is missing; write it after the command"),
    (("solve", "my.toml"), "EQUATION...: is missing; write it after the command"),
    (("zoom", "a"), '"zoom": there is no such command; write new, check, run, report, page, draw, sweep, optimise, '),
    (("schema", "x"), "x: is not expected here; leave it out"),
]


def _summary(crankwork, *arguments):
    """Return the values that a run prints, by key."""
    results = crankwork("run", *arguments, "--json").results
    return {key: one["value"] for key, one in results["summary"].items()} | {"method": results["method"]}


def test_a_wrong_option_or_command_is_named_with_what_to_write(machine_file, check_refusals) -> None:
    name = machine_file()
    check_refusals((("run", name, "-o", "out", *options), told) for options, told in WRONG)
    check_refusals(WRONG_COMMANDS)


def test_mistakes_of_options_and_of_the_file_are_told_together(crankwork, machine_file) -> None:
    answer = crankwork("run", machine_file(('"0.55 kg"', '"x"')), "--step", "0", "--method", "x", "--set", "rod.x=1")
    assert [line.partition(": ")[0] for line in answer.mistakes] == ["--set rod.x", "--step", "--method", "my.toml:22"]


def test_a_speed_in_radians_is_that_speed_whatever_pi_a_document_has(crankwork, machine_file) -> None:
    found = {}
    for name in ("slider-crank", "four-bar"):
        for speed in ("30 rad/s", "30 рад/с", "30 rpm"):
            settings = ("--set", "method.pi=3.0", "--set", f"crank.speed={speed}")
            summary = _summary(crankwork, machine_file(name=name), *settings)
            found[name, speed] = (round(summary["rotational_speed"], 9), round(summary["speed"], 9))
    wanted = {"30 rad/s": (300.0, 30.0), "30 рад/с": (300.0, 30.0), "30 rpm": (30.0, 3.0)}
    assert found == {(name, speed): one for name in ("slider-crank", "four-bar") for speed, one in wanted.items()}


def test_what_a_machine_or_its_method_does_not_have_is_told(machine_file, check_refusals) -> None:
    bore = "--per-area: needs the piston area; give cylinder.bore in the file, or leave this option out"
    cylinder = "--set engine.misfire[1]: there is no cylinder 6; write numbers from 1 to 4"
    bare = machine_file(text='[crank]\nradius = "45 mm"\nspeed = "3000 rpm"\n[rod]\nratio = 0.3\n')
    check_refusals([(("run", bare, "--per-area"), bore)])
    check_refusals([(("run", machine_file(name="four-bar"), "--per-area"), bore)])
    check_refusals([(("run", machine_file(name="whole-engine"), "--set", "engine.misfire=[6]"), cylinder)])
    asked = ("explain", machine_file(), "rod_transverse_force", "--method", "textbook")
    check_refusals([(asked, "by its method, textbook")])


def test_an_angle_is_read_as_it_is_printed(crankwork, machine_file, check_mistakes) -> None:
    asked = ("explain", machine_file(), "piston_velocity", "--lang")
    for at in ("390.5", "390,5", "390.5 deg", "6.815510728937 rad"):
        assert "(390,5°)" in crankwork(*asked, "ru", "--at", at).out.partition("\n")[0], at
    answer = crankwork(*asked, "vi", "--at", "abc")
    check_mistakes(answer)
    assert answer.err == '--at: "abc": không phải số kèm đơn vị; hãy ghi như "30 deg"\n'


def test_a_setting_replaces_what_says_the_same(crankwork, machine_file) -> None:
    plain = _summary(crankwork, machine_file())
    changed = _summary(crankwork, "my.toml", "--set", "rod.ratio=0.34")
    assert changed["rod_ratio"] == 0.34
    assert changed["rod_length"] == pytest.approx(45 / 0.34)
    assert plain["rod_ratio"] == pytest.approx(45 / 160)
    assert changed["piston_acceleration_max"] != plain["piston_acceleration_max"]
    # a compression of a smaller exponent takes less work
    into_a_list = _summary(crankwork, "my.toml", "--set", "gas.pieces[3].exponent=1.3")
    assert into_a_list["indicated_work"] > plain["indicated_work"]


def test_a_setting_is_read_as_in_the_file_and_the_last_of_two_counts(crankwork, machine_file) -> None:
    name = machine_file()
    settings = [
        (("crank.speed=1500 rpm",), "rotational_speed", 1500),
        (('crank.speed="1500 об/мин"',), "rotational_speed", 1500),
        ((" crank.stroke = 80 mm ",), "crank_radius", 40),
        (("crank.stroke=8 cm",), "stroke", 80),
        (("cylinder.clearance_volume=70 cm3",), "clearance_volume", 70),
        (("gas.points.z.pressure=6 MPa",), "gas_pressure_max", 5.9),
        (("rod.ratio=1e-1",), "rod_ratio", 0.1),
        (("crank.speed=1 rpm", "crank.speed=1500 rpm"), "rotational_speed", 1500),
    ]
    found = [
        _summary(crankwork, name, *(word for one in some for word in ("--set", one)))[key] for some, key, _ in settings
    ]
    assert found == pytest.approx([value for *_, value in settings])


def test_a_step_is_in_degrees(crankwork, machine_file) -> None:
    name, rows = machine_file(name="slider-crank"), {}
    for step in ("15", "15 deg", "15°", "1.5e1"):
        answer = crankwork("run", name, "--step", step, "-o", step, "--no-figures")
        assert answer.code == 0, answer.err
        rows[step] = Path(step, "tables/forces.csv").read_text("utf-8").splitlines()
    assert {step: len(one) for step, one in rows.items()} == dict.fromkeys(rows, 1 + 360 // 15 + 1)
    assert {one[2].partition(",")[0] for one in rows.values()} == {"15.0"}


def test_a_method_is_taken_and_named_whatever_the_file_says(crankwork, machine_file) -> None:
    name = machine_file(('kinematics = "exact"', 'kinematics = "textbook"'))
    asked = (None, "exact", "textbook", "series:1", "series:6", "series:200")
    found = [_summary(crankwork, name, *(("--method", one) if one else ()))["method"] for one in asked]
    assert found == ["textbook", *asked[1:]]


def test_a_title_with_emoji_and_any_script_is_printed_as_it_is(crankwork, machine_file) -> None:
    title = "Động cơ 👩‍🔧 двигатель <b>&amp;"
    answer = crankwork("run", machine_file(('"Four-stroke engine"', f"'{title}'")))
    assert answer.out.splitlines()[0] == title


def test_new_prints_the_names_or_the_template(crankwork) -> None:
    lines = crankwork("new").out.splitlines()
    assert [line.split()[0] for line in lines] == [
        "balancing", "chebyshev", "clutch", "compressor", "crank-shaper", "engine", "four-bar", "hoecken", "jansen",
        "klann", "press", "pumpjack", "scotch-yoke", "slider-crank", "stephenson-six-bar", "toggle-press",
        "turning-moment", "watt-six-bar", "watt-straight-line", "whitworth", "whole-engine",
    ]  # fmt: skip
    assert all(template_title(name, "en") == title for name, title in (line.split(maxsplit=1) for line in lines))
    assert "двигатель" in crankwork("new", "--lang", "ru").out
    assert crankwork("new", "engine").out == template("engine")


def test_circuits_are_listed(crankwork, machine_file, check_refusals) -> None:
    file = machine_file(name="four-bar")
    listed = crankwork("check", file, "--circuits")
    assert listed.code == 0
    assert "circuit 2, branch 1: crank turns fully; " in listed.out
    data = json.loads(crankwork("check", file, "--circuits", "--json").out)
    assert [one["circuit"] for one in data["branches"]] == [1, 2]
    check_refusals([(("check", file, "--json"), "add --circuits")])
