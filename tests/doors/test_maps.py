"""Maps over numbers of a file: values where they stand, and what does not depend on a number."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path

import numpy as np
import pytest

from crankwork.description.document import Description
from crankwork.description.machine_file import template
from crankwork.study import parameter_map as mapping

OVER = ("--over", "crank.speed=1000..3000rpm:2")
WRONG = [
    (("--over", "crank.speed=1000rpm"), "--over crank.speed=1000rpm: write a key and a range, like --over"),
    (("--over", "crank.sped=1..2rpm"), "--over crank.sped: unknown key; did you mean speed?"),
    (("--over", "gas.pressures=1..2"), "gas.pressures: is not a single number of the file"),
    (("--over", "crank.speed=1..2kg"), 'unit "kg" measures mass; speed is wanted'),
    (OVER * 3, "--over: a map has one or two numbers"),
    (OVER * 2, "--over crank.speed: stands twice; keep one of them"),
    (("--over", "crank.speed=1..2rpm:0"), "--over: take from 1 to 200 steps"),
    (("--over", "crank.speed=2..1rpm"), "--over crank.speed: the range from 2rpm to 1rpm is empty"),
    (("--over", "rod.length=1..2mm"), "there is no machine anywhere in the range: the rod"),
    ((), "--over: is missing; write --over KEY=FROM..TO"),
    ((*OVER, "--workers", "0"), "--workers: "),
]


@pytest.fixture
def machine(tmp_path):
    (tmp_path / "engine.toml").write_text(template("engine"), encoding="utf-8")
    return "engine.toml"


@pytest.mark.elsewhere
def test_inertia_grows_with_the_square_of_the_speed_and_work_does_not(crankwork, machine, tmp_path):
    answer = crankwork("map", machine, *OVER, "--over", "cylinder.bore=80..90mm:1", "-o", "out")
    assert answer.code == 0, answer.err
    with (tmp_path / "out" / "tables" / "map.csv").open(newline="") as file:
        rows = [{key: float(one) for key, one in row.items()} for row in csv.DictReader(file)]
    assert [(round(row["crank.speed [rpm]"], 9), row["cylinder.bore [mm]"]) for row in rows] == [
        (speed, bore) for speed in (1000, 2000, 3000) for bore in (80, 90)
    ]
    for row in rows:
        # r w^2 (1 + lambda) at the top dead centre, (1 - 1/9) of a volume with each bore
        top = 0.045 * (row["crank.speed [rpm]"] * math.pi / 30) ** 2 * (1 + 45 / 160)
        assert row["piston_acceleration_max [m/s2]"] == pytest.approx(top, rel=1e-9)
        assert row["swept_volume [cm3]"] == pytest.approx(math.pi / 4 * (row["cylinder.bore [mm]"] / 10) ** 2 * 9)
    found = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))
    by_speed, by_bore = (set(found["independent"][key]) for key in ("crank.speed", "cylinder.bore"))
    assert {"indicated_work", "mean_torque", "gas_pressure_max", "stroke"} <= by_speed
    assert "piston_acceleration_max" in by_bore - by_speed
    assert "indicated_work" not in by_bore
    assert "Do not depend on crank.speed" in answer.out
    figure = (tmp_path / "out" / "figures" / "map.indicated_work.svg").read_text("utf-8")
    assert "the same at every" in figure


def test_a_wrong_axis_is_named_with_what_to_write(machine, check_refusals):
    check_refusals((("map", machine, *options), told) for options, told in WRONG)


@pytest.mark.slow
def test_processes_find_what_one_finds(crankwork, machine):
    over = ("--over", "crank.speed=1000..3000rpm:4", "--over", "rod.length=40..200mm:8")
    found = {}
    for workers in ("1", "2"):
        out = Path(f"out{workers}")
        answer = crankwork("map", machine, *over, "-o", str(out), "--workers", workers, "--no-figures")
        assert answer.code == 0, answer.err
        assert "without values: the rod" in answer.out
        found[workers] = (out / "tables" / "map.csv").read_bytes(), (out / "summary.json").read_bytes()
    assert found["1"] == found["2"]


@pytest.mark.slow
def test_many_points_calculated_together_are_those_of_analyses(monkeypatch):
    description, over = Description(template("engine")), ("crank.speed=1000..3000rpm:6", "rod.length=150..170mm:6")
    together = mapping.mapped(description, over)
    monkeypatch.setattr(mapping, "_together", lambda *_: None)
    apart = mapping.mapped(description, over)
    assert together.independent == apart.independent
    assert together.values.keys() == apart.values.keys()
    for key, values in apart.values.items():
        np.testing.assert_allclose(together.values[key], values, rtol=1e-11, atol=1e-11 * np.max(np.abs(values)))


def test_points_without_a_machine_are_told_where_many_are_calculated_together():
    found = mapping.mapped(Description(template("engine")), ("rod.length=30..160mm:60",))
    assert sum(found.refused.values()) == np.isnan(found.values["crank_torque_max"]).sum() > 5
    assert len(found.refused) == 1
