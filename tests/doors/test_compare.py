"""Comparisons on the command line."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from crankwork.description.machine_file import template


def test_methods_stand_beside_the_own_one_in_summary_table_and_figure(crankwork, machine_file):
    answer = crankwork("run", machine_file(), "--compare", "textbook,series:4", "-o", "out")
    assert (answer.code, answer.err) == (0, "")
    lines = answer.out.splitlines()
    heading = lines.index("Comparison of methods")
    assert lines[heading + 1].split("  ")[-1] == "series:4 less exact"
    row = next(line for line in lines[heading:] if "largest crank torque" in line)
    assert row.split()[-5:] == ["389.12", "389.629", "0.509674", "389.116", "−0.00341507"]
    table = list(csv.reader(Path("out/tables/comparison.csv").read_text(encoding="utf-8").splitlines()))
    assert table[0][:4] == [
        "crank_angle [deg]",
        "piston_displacement.exact [mm]",
        "piston_displacement.textbook [mm]",
        "piston_displacement_difference.textbook [mm]",
    ]
    values = [[float(one) for one in row] for row in table[1:]]
    assert all(abs(row[2] - row[1] - row[3]) < 1e-9 for row in values)
    assert Path("out/figures/comparison.svg").stat().st_size > 1000
    assert Path("out/tables.xlsx").exists()


def test_the_summary_as_data_has_value_and_difference_of_each(crankwork, machine_file):
    answer = crankwork("run", machine_file(), "--compare", "textbook", "--json")
    found = json.loads(answer.out)
    assert found["comparison"]["own"] == "exact"
    torque = found["comparison"]["others"]["textbook"]["crank_torque_max"]
    own = found["summary"]["crank_torque_max"]["value"]
    assert torque["unit"] == "N*m"
    assert torque["value"] - own == pytest.approx(torque["difference"], abs=1e-9)
    assert found["comparison"]["others"]["textbook"]["crank_torque_error"]["difference"] is None


def test_another_file_is_put_beside_as_it_is(crankwork, machine_file):
    Path("short.toml").write_text(template("engine").replace('"160 mm"', '"140 mm"'), encoding="utf-8")
    answer = crankwork("run", machine_file(), "--compare", "short.toml", "--set", "crank.speed=2000 rpm")
    assert answer.code == 0
    rows = {
        line.split("  ")[1]: line.split()[-3:]
        for line in answer.out.partition("Comparison of machines")[2].splitlines()
        if line
    }
    assert rows["connecting rod length"] == ["160", "140", "−20"]
    assert rows["rotational speed"] == ["2000", "3000", "1000"]


def test_a_file_of_the_same_name_has_a_number(crankwork, machine_file):
    Path("other").mkdir()
    Path("other/my.toml").write_text(template("engine"), encoding="utf-8")
    answer = crankwork("run", machine_file(), "--compare", "other/my.toml")
    assert "my_2 less my_1" in answer.out


@pytest.mark.parametrize(
    ("language", "words"),
    [("ru", "Сравнение методов"), ("vi", "So sánh các phương pháp"), ("en", "Comparison of methods")],
)
def test_in_every_language(crankwork, machine_file, language, words):
    answer = crankwork("run", machine_file(), "--compare", "textbook", "--lang", language, "--per-area")
    assert (answer.code, words in answer.out) == (0, True)


def test_a_note_has_the_section(crankwork, machine_file):
    answer = crankwork("report", machine_file(), "--compare", "textbook", "-o", "note.html", "--no-figures")
    assert answer.code == 0
    assert "Comparison</h" in Path("note.html").read_text(encoding="utf-8")


WRONG = {
    "no method": ("engine", ("--compare", "exakt"), '--compare: method "exakt" does not exist'),
    "nothing": ("engine", ("--compare", ""), '--compare: method "" does not exist'),
    "its own": ("engine", ("--compare", "textbook,exact"), "--compare: exact is the machine's own method"),
    "too many": (
        "engine", ("--compare", ",".join(f"series:{n}" for n in range(1, 9))),
        "--compare: name at most 6 methods",
    ),
    "linkage": (
        "four-bar", ("--compare", "textbook"),
        "--compare textbook: approximate methods exist for a crank gear",
    ),
    "linkage by a wrong method": ("four-bar", ("--compare", "foo"), '--compare: method "foo" does not exist'),
    "table": ("press", ("--compare", "textbook"), "--compare textbook: approximate methods exist for a crank gear"),
    "no file": ("engine", ("--compare", "no.toml"), "no.toml"),
    "wrong file": ("engine", ("--compare", "wrong.toml"), "wrong.toml:1: crank: is missing"),
    "areas of two": (
        "engine", ("--compare", "same.toml", "--per-area"),
        "--per-area: the two machines have pistons of their own",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("name", "options", "answered"), WRONG.values(), ids=WRONG)
def test_what_cannot_be_compared_is_refused(crankwork, machine_file, check_mistakes, name, options, answered):
    Path("wrong.toml").write_text("format = 2\n", encoding="utf-8")
    Path("same.toml").write_text(template("engine"), encoding="utf-8")
    answer = crankwork("run", machine_file(name=name), *options, "-o", "out")
    check_mistakes(answer)
    assert answered in answer.err
    assert not Path("out").exists()


def test_what_is_doubtful_of_the_other_machine_is_told_at_the_end(crankwork, machine_file):
    Path("swing.toml").write_text(template("four-bar").replace('"175 mm"', '"260 mm"'), encoding="utf-8")
    answer = crankwork("run", machine_file(name="four-bar"), "--compare", "swing.toml")
    assert answer.code == 1
    assert answer.err.startswith("swing: ")
    assert "Comparison of machines" in answer.out


def test_a_file_may_be_called_as_a_method(crankwork, machine_file):
    Path("textbook.toml").write_text(template("engine"), encoding="utf-8")
    answer = crankwork("run", machine_file(), "--compare", "textbook.toml")
    assert "Comparison of machines" in answer.out
