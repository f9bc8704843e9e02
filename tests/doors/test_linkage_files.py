"""Linkages from their files to their results: columns, names of the user's own, motor and flywheel."""

from __future__ import annotations

import csv
import json
import zipfile
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

import crankwork as package
from crankwork.description.machine_file import read_machine, template

DYNAMICS = ["crank_angle [deg]", "reduced_inertia [kg*m2]", "reduced_inertia_1 [kg*m2]", "static_torque [N*m]",
            "dynamic_torque [N*m]", "balancing_torque [N*m]", "driving_torque [N*m]"]  # fmt: skip
MOTOR = '[motor]\nrated_power = "2.2 kW"\nrated_speed = "1430 rpm"\noverload = 2.2\npole_pairs = 2\nratio = 24\n[table]'


def _rows(name, folder="out"):
    return list(csv.reader(Path(folder, "tables", f"{name}.csv").read_text("utf-8").splitlines()))


def test_tables_of_a_linkage_have_keys_and_units(crankwork, machine_file) -> None:
    name = machine_file(name="toggle-press")
    answer = crankwork("run", name, "-o", "out", "--no-figures", "--step", "7", "--json")
    assert answer.code == 0, answer.err
    data = json.loads(answer.out)
    assert set(data["checks"]) == {"whole_system", "zhukovsky", "virtual_work", "energy"}
    assert max(data["checks"].values()) < 1e-10
    heading, *rows = _rows("dynamics")
    assert heading == DYNAMICS
    assert [float(row[0]) for row in rows] == [7.0 * number for number in range(52)] + [360.0]
    assert {"joint_force.A [N]", "joint_force_x.D [N]"} <= set(_rows("joint_forces")[0])


def test_tables_and_summary_have_zero_where_only_rounding_is_left(crankwork) -> None:
    example = Path(__file__).parents[2] / "examples" / "parallelogram.toml"
    answer = crankwork("run", str(example), "-o", "out", "--no-figures", "--json")
    assert answer.code == 0, answer.err
    summary = {key: one["value"] for key, one in json.loads(answer.out)["summary"].items()}
    assert {summary[f"{kind}_{end}"] for kind in ("dynamic_torque", "driving_torque") for end in ("max", "min")} == {
        0.0
    }
    heading, *rows = _rows("dynamics")
    for key in DYNAMICS[2:]:
        assert {row[heading.index(key)] for row in rows} == {"0.0"}, key


@pytest.mark.slow
def test_any_name_comes_back_in_the_tables_and_the_workbook(crankwork, machine_file) -> None:
    failures = {}
    for joint in ("Điểm 👩‍🔧", "a.b", 'say ""B""', "x,y;z", "<b>&amp;"):
        quoted = joint.replace('""', '"')
        text = template("four-bar").replace('"B"]', f"'{quoted}']").replace("\nB = 1 ", f"\n'{quoted}' = 1 ")
        options = ("-o", "out", "--no-figures", "--overwrite", "--step", "30")
        answer = crankwork("run", machine_file(text=text), *options)
        assert answer.code == 0, answer.err
        heading, *rows = _rows("joint_forces")
        with zipfile.ZipFile("out/tables.xlsx") as book:
            assert book.testzip() is None
            strings = ET.fromstring(book.read("xl/sharedStrings.xml"))  # noqa: S314 - our own workbook
        ET.parse("out/machine.svg")  # noqa: S314 - our own drawing
        good = f"joint_force.{quoted} [N]" in heading, {len(row) for row in rows} == {len(heading)}
        if not all(good) or not any(quoted in (one.text or "") for one in strings.iter()):
            failures[joint] = heading
    assert failures == {}


def test_a_setting_changes_the_linkage_and_check_names_mobility_and_structure(crankwork, machine_file) -> None:
    name = machine_file(name="toggle-press")
    settings = ("--set", "links.rod.length=225 mm", "--set", "crank.speed=30 rpm")
    plain, changed = (json.loads(crankwork("run", name, "--json", *one).out)["summary"] for one in ((), settings))
    assert plain["slider_stroke.ram"] != changed["slider_stroke.ram"]
    assert (plain["rotational_speed"]["value"], changed["rotational_speed"]["value"]) == (60, 30)
    out = crankwork("check", name).out
    assert "mobility W = 3·5 − 2·7 = 1 (Chebyshev)" in out
    assert "structure I(0,1) -> II(2,3) -> II(4,5), mechanism of class II" in out


CLASS_III = """
fixed_points = { O = ["0 mm", "0 mm"], E = ["200 mm", "250 mm"], F = ["300 mm", "-50 mm"] }
crank = { pivot = "O", pin = "A", radius = "10 mm", speed = "60 rpm" }
positions = { B = ["150 mm", "30 mm"], C = ["200 mm", "100 mm"], D = ["200 mm", "-50 mm"] }
[links]
rod = { joins = ["A", "B"] }
plate = { joins = ["B", "C", "D"], mass = "2 kg", inertia = "0.01 kg*m2", centre = ["40 mm", "0 mm"] }
arm = { joins = ["C", "E"] }
leg = { joins = ["D", "F"] }
"""


@pytest.mark.slow
def test_a_group_of_class_iii_follows_from_positions_alone(crankwork, machine_file) -> None:
    name = machine_file(text=CLASS_III)
    checked = crankwork("check", name)
    assert checked.code == 0, checked.err
    assert "structure I(0,1) -> III(2,3,4,5), mechanism of class III" in checked.out
    data = json.loads(crankwork("run", name, "--json").out)
    assert data["notices"] == []
    assert max(data["checks"].values()) < 1e-9


def test_a_massless_loop_with_a_torque_gives_the_torque_of_the_crank() -> None:
    text = template("four-bar").replace(', mass = "1 kg", inertia = "0.0011 kg*m2", centre = ["56 mm", "0 mm"]', "")
    text = text.replace(', mass = "1.5 kg", inertia = "0.004 kg*m2", centre = "P"', "")
    load = '[[loads]]\nkind = "torque"\nlink = "rocker"\ntorque = ["10 N*m"]\n[table]'
    results = package.analyse(read_machine(text.replace("[table]", load)))
    assert not results["reduced_inertia"].any()
    assert max(abs(results["static_torque"])) > 1
    assert max(results.checks.values()) < 1e-12
    noted = package.analyse(read_machine(text.replace("[table]", f"[[loads]]{load[9:-7]}{MOTOR}")))
    assert noted.notices[-1].values["message"].startswith("nothing has a mass")


def test_a_crank_alone_turns() -> None:
    results = package.analyse(read_machine(template("four-bar").partition("[links]")[0] + "[links]"))
    assert not results.unmet
    assert results.summary["speed"] > 0


def test_motor_and_flywheel_of_a_file() -> None:
    """Four flywheels; the exact one gives the wanted fluctuation, and the motor runs below its synchronous speed."""
    text = template("toggle-press").replace("[table]", f"[flywheel]\nfluctuation = 0.04\n{MOTOR}")
    machine = read_machine(text)
    results = package.analyse(machine)
    assert sum(key.startswith("flywheel_inertia.") for key in results.summary) == 4
    assert results.checks["flywheel"] < 1e-6
    synchronous = 2 * 3.141592653589793 * 50 / 2 / 24
    assert 0.9 * synchronous < results.summary["steady_speed"] < synchronous
    assert 0 < results.summary["steady_fluctuation"] < 0.04
    assert results.summary["motor_power"] > 0


def test_an_engine_with_a_spring_goes_through_every_command(crankwork) -> None:
    load = "loads = [{ kind = 'spring', slider = 'piston', stiffness = '2 N/mm' }]"
    Path("gear.toml").write_text(f"{load}\n{template('slider-crank')}", "utf-8")
    answer = crankwork("check", "gear.toml")
    assert (answer.code, answer.err) == (0, "")
    assert "linkage, moving links (3): " in answer.out
    data = crankwork("run", "gear.toml", "-o", "out", "--no-figures", "--json").results
    assert data["summary"]["static_torque_max"]["value"] > 0
    assert max(data["checks"].values()) < 1e-10
    assert "static_torque [N*m]" in _rows("dynamics")[0]
    assert crankwork("report", "gear.toml", "-o", "note.html", "--lang", "vi").code == 0
    assert crankwork("page", "gear.toml", "-o", "page.html", "--slider", "piston.mass").code == 0
    assert crankwork("draw", "gear.toml", "-o", "gear.svg").code == 0
    refused = crankwork("run", "gear.toml", "--method", "textbook")
    assert (refused.code, refused.mistakes) == (
        2, ["--method: loads counts in an exact calculation only, not by textbook; write exact, or leave loads out"],
    )  # fmt: skip
