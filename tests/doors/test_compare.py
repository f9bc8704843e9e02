"""Comparisons on the command line."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from crankwork.description.machine_file import template
from machine_texts import POINTS_ENGINE


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
    found = json.loads(crankwork("run", machine_file(), "--compare", "textbook", "--json").out)
    assert found["comparison"]["own"] == "exact"
    torque = found["comparison"]["others"]["textbook"]["crank_torque_max"]
    own = found["summary"]["crank_torque_max"]["value"]
    assert torque["unit"] == "N*m"
    assert torque["value"] - own == pytest.approx(torque["difference"], abs=1e-9)
    assert found["comparison"]["others"]["textbook"]["crank_torque_error"]["difference"] is None


def test_another_file_is_put_beside_as_it_is_and_may_have_any_name(crankwork, machine_file):
    # that of a method, and that of the file itself
    Path("other").mkdir()
    for name in ("textbook.toml", "other/my.toml"):
        Path(name).write_text(POINTS_ENGINE.replace('"160 mm"', '"140 mm"'), encoding="utf-8")
    asked = ("run", machine_file(), "--set", "crank.speed=2000 rpm", "--compare")
    answer = crankwork(*asked, "textbook.toml")
    assert answer.code == 0
    lines = filter(None, answer.out.partition("Comparison of machines")[2].splitlines())
    rows = {line.split("  ")[1]: line.split()[-3:] for line in lines}
    assert rows["connecting rod length"] == ["160", "140", "−20"]
    assert rows["rotational speed"] == ["2000", "3000", "1000"]
    assert "my_2 less my_1" in crankwork(*asked, "other/my.toml").out


@pytest.mark.slow
def test_in_every_language_and_in_a_note(crankwork, machine_file):
    name = machine_file()
    headings = {"ru": "Сравнение методов", "vi": "So sánh các phương pháp", "en": "Comparison of methods"}
    for language, words in headings.items():
        answer = crankwork("run", name, "--compare", "textbook", "--lang", language, "--per-area")
        assert (answer.code, words in answer.out) == (0, True), language
    assert crankwork("report", name, "--compare", "textbook", "-o", "note.html", "--no-figures").code == 0
    assert "Comparison</h" in Path("note.html").read_text(encoding="utf-8")


def test_what_cannot_be_compared_is_refused(machine_file, check_refusals):
    Path("same.toml").write_text(POINTS_ENGINE, encoding="utf-8")
    crank_gear = "--compare textbook: approximate methods exist for a crank gear"
    for name, refusals in {
        "four-bar": [
            (("textbook",), crank_gear),
            (("foo",), '--compare: method "foo" does not exist'),
        ],
        "press": [(("textbook",), crank_gear)],
        "engine": [
            (("exakt",), '--compare: method "exakt" does not exist'),
            (("",), '--compare: method "" does not exist'),
            (("textbook,exact",), "--compare: exact is the machine's own method"),
            ((",".join(f"series:{n}" for n in range(1, 9)),), "--compare: name at most 6 methods"),
            (("no.toml",), "no.toml"),
            (("same.toml", "--per-area"), "--per-area: the two machines have pistons of their own"),
        ],
    }.items():
        file = machine_file(name=name)
        check_refusals((("run", file, "-o", "out", "--compare", *some), told) for some, told in refusals)


def test_what_is_wrong_or_doubtful_of_the_other_machine_is_told_by_its_name(crankwork, machine_file, check_mistakes):
    Path("wrong.toml").write_text("format = 2\n", encoding="utf-8")
    answer = crankwork("run", machine_file(name="four-bar"), "--compare", "wrong.toml")
    check_mistakes(answer)
    assert "wrong.toml:1: crank: is missing" in answer.err
    Path("swing.toml").write_text(template("four-bar").replace('"175 mm"', '"260 mm"'), encoding="utf-8")
    answer = crankwork("run", "my.toml", "--compare", "swing.toml")
    assert answer.code == 1
    assert answer.err.startswith("swing: ")
    assert "Comparison of machines" in answer.out
