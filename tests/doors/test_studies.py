"""Studies on the command line: what is found, and what is refused."""

from __future__ import annotations

import json
import math
import re
import sys

import pytest

from crankwork.description.machine_file import template
from machine_texts import POINTS_ENGINE

STUDY = """\
machine = "machine.toml"
values = "stroke"
[designs]
drawing = "sobol"
count = 64
[vary]
crank.radius = { from = "40 mm", to = "50 mm" }
"rod.ratio" = "0.25 ± 0.01"
[objectives]
piston_velocity_max = "minimise"
piston_acceleration_max = "maximise"
[limits]
piston_velocity_max = { at_most = "14 m/s" }
"""
WRONG = {
    "unknown field": ("crank.radius = {", "crank.raduis = {", ":7: vary.crank.raduis: unknown key; did you mean"),
    "unknown table": ("crank.radius = {", "crnak.radius = {", ":7: vary.crnak: unknown key; did you mean crank?"),
    "range turned round": ('to = "50 mm"', 'to = "30 mm"', ':7: vary.crank.radius.to: "30 mm" is not above "40 mm"'),
    "range without end": (', to = "50 mm"', "", ":7: vary.crank.radius.to: is missing; write to = ..."),
    "range in another unit": ('to = "50 mm"', 'to = "50 kg"', ':7: vary.crank.radius.to: unit "kg" measures mass'),
    "range outside": ('to = "50 mm"', 'to = "500 m"', ':7: vary.crank.radius.to: "500 m" is out of range; write at'),
    "steps of a draw": (', to = "50 mm"', ', to = "50 mm", steps = 4', ":7: vary.crank.radius: a range says nothing"),
    "no deviation": ("0.25 ± 0.01", "0.25", ':8: vary.rod.ratio: "0.25" must be a plain number'),
    "limits of a deviation": (
        '"0.25 ± 0.01"', '{ uniform = "0.25 sd 0.01" }',
        ':8: vary.rod.ratio.uniform: "0.25 sd 0.01" states no limits, between which all is as likely; write { uniform',
    ),
    "no list of words": (
        '"0.25 ± 0.01"', '0.25\nrod.ratio_definition = "r/l"',
        ":9: vary.rod.ratio_definition: holds words or counts, and there is nothing between them; write a list",
    ),
    "unknown drawing": ('"sobol"', '"sobel"', ':4: designs.drawing: "sobel" is not possible here; write "grid"'),
    "a grid of draws": ('"sobol"\ncount = 64', '"grid"', ":6: vary.crank.radius: a grid needs to know how finely"),
    "many designs": ("64", "1_000_000_000_000_000", ":5: designs.count: 1000000000000000 designs are wanted, more"),
    "designs of zero": ("64", "0", ":5: designs.count: 0 is not possible here; write a whole number from 1 to"),
    "unknown value": ('"stroke"', '["stroke", "stroek"]', ":2: values[2]: there is no result stroek; did you mean"),
    "value that varies": ('"stroke"', '"piston_velocity"', ":2: values[1]: piston_velocity varies over the cycle"),
    "no direction": ('"minimise"', '"small"', ':10: objectives.piston_velocity_max: "small" is not possible here'),
    "limit in another unit": ("14 m/s", "14 kg", ':13: limits.piston_velocity_max.at_most: unit "kg" measures mass'),
    "limits that leave nothing": (
        "at_most", 'at_least = "15 m/s", at_most', ":13: limits.piston_velocity_max: at_least is above at_most",
    ),
    "no such limit": ("{ at_most", "{ at_mots", ":13: limits.piston_velocity_max.at_mots: unknown key; did you mean"),
    "no limit": ('{ at_most = "14 m/s" }', "{}", ":13: limits.piston_velocity_max: is missing; write at_most"),
    "no machine": ("machine.toml", "nothing.toml", ":1: machine: "),
}  # fmt: skip


@pytest.fixture
def study(tmp_path):
    """Write a study and its machine."""
    (tmp_path / "machine.toml").write_text(template("slider-crank"), encoding="utf-8")

    def write(text: str = STUDY) -> str:
        (tmp_path / "study.toml").write_text(text, encoding="utf-8")
        return "study.toml"

    return write


def _wrong(crankwork, study, command, text, mistakes):
    """Return the mistakes that are not told as they should be."""
    failures = {}
    for name, (old, new, told) in mistakes.items():
        assert old in text
        answer = crankwork(command, study(text.replace(old, new, 1)), "-o", "out")
        if answer.code != 2 or f"study.toml{told}" not in answer.err:
            failures[name] = answer
    return failures


def test_a_mistake_is_told_on_its_line_and_all_at_once(crankwork, study):
    assert _wrong(crankwork, study, "sweep", STUDY, WRONG) == {}
    assert _wrong(crankwork, study, "optimise", SEARCH, WRONG_SEARCH) == {}
    text = STUDY
    for old, new, _ in (WRONG["unknown field"], WRONG["many designs"], WRONG["unknown value"], WRONG["no direction"]):
        text = text.replace(old, new, 1)
    answer = crankwork("sweep", study(text), "-o", "out")
    assert [line.split(":")[1] for line in answer.mistakes] == ["2", "5", "7", "10"]


def test_a_grid_of_too_many_designs_is_refused_with_their_number(crankwork, study):
    ranges = "".join(
        f'{key} = {{ from = "1 mm", to = "2 mm", steps = 999 }}\n' for key in ("crank.radius", "rod.length")
    )
    ranges += 'crank.speed = { from = "1 rpm", to = "2 rpm", steps = 9999 }\n'
    text = STUDY.replace('"sobol"\ncount = 64', '"grid"')
    text = f"{text[: text.index('crank.radius')]}{ranges}{text[text.index('[objectives]') :]}"
    answer = crankwork("sweep", study(text), "-o", "out")
    assert ":5: vary: 10000000000 designs are wanted" in answer.err


@pytest.mark.data
def test_a_study_writes_what_it_found(crankwork, study, tmp_path):
    answer = crankwork("sweep", study(), "-o", "out", "--workers", "1")
    assert answer.code == 0, answer.err
    assert "64 designs" in answer.out
    # not the time of day
    assert float(re.search(r"([\d.]+) s\b", answer.err)[1]) < 1000
    found = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    assert found["values"]["stroke"]["least"] >= 80
    assert found["values"]["stroke"]["largest"] <= 100
    best = found["best"]["piston_velocity_max"]
    assert [one["piston_velocity_max"] for one in best] == sorted(one["piston_velocity_max"] for one in best)
    assert all(one["piston_velocity_max"] <= 14 for one in found["pareto"])
    assert (tmp_path / "out" / "tables" / "pareto.csv").exists()
    drawn = {one.name for one in (tmp_path / "out" / "figures").iterdir()}
    assert {"pareto.svg", "histogram.stroke.svg", "parallel.piston_velocity_max.svg"} <= drawn
    without = crankwork("sweep", "study.toml", "-o", "without", "--workers", "1", "--no-figures")
    assert without.code == 0, without.err
    assert not (tmp_path / "without" / "figures").exists()


SEARCH = """\
machine = "machine.toml"
[vary]
crank.radius = { from = "30 mm", to = "60 mm" }
rod.length = { uniform = "185 ± 35 mm" }
[objectives]
piston_acceleration_max = "minimise"
[limits]
stroke = { at_least = "90 mm" }
[search]
starts = 2
"""
WRONG_SEARCH = {
    "a list": ('{ from = "30 mm", to = "60 mm" }', '["30 mm", "60 mm"]', ":3: vary.crank.radius: is no range, and"),
    "a distribution": ('{ uniform = "185 ± 35 mm" }', '"185 ± 35 mm"', ":4: vary.rod.length: is no range, and"),
    "unknown field": ("rod.length", "rod.lenth", ":4: vary.rod.lenth: unknown key; did you mean length?"),
    "nothing varies": (SEARCH[SEARCH.index("crank.r") : SEARCH.index("[obj")], "", ":2: vary: is empty; name what"),
    "no objective": ('piston_acceleration_max = "minimise"\n', "", ":5: objectives: is missing; name the value that"),
    "objectives": ('"minimise"', '"minimise"\nstroke = "maximise"', ":5: objectives: are several, piston_accel"),
    "without reduction": ("acceleration_max", "acceleration", ":6: objectives.piston_acceleration: piston_accel"),
    "unknown way": ("starts = 2", 'way = "luck"', ':10: search.way: "luck" is not possible here; write "slsqp"'),
}  # fmt: skip


@pytest.mark.elsewhere
def test_the_best_design_is_a_machine_file_with_its_comments(crankwork, study, tmp_path):
    """The acceleration at top dead centre, r w^2 (1 + r/l), is least with the longest rod and the shortest crank."""
    answer = crankwork("optimise", study(SEARCH), "-o", "out", "--set", "crank.speed=3000 rpm")
    assert answer.code == 0, answer.err
    file = (tmp_path / "out" / "machine.toml").read_text(encoding="utf-8")
    stated = (tmp_path / "machine.toml").read_text(encoding="utf-8")
    for before, after in (('radius = "50 mm"', 'radius = "45 mm"'), ('length = "200 mm"', 'length = "220 mm"'),
                          ('"1500 rpm"', '"3000 rpm"')):  # fmt: skip
        assert before in stated
        stated = stated.replace(before, after, 1)
    assert file == stated
    found = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    speed = 3000 * math.pi / 30
    assert found["values"]["piston_acceleration_max"] == pytest.approx(0.045 * speed**2 * (1 + 45 / 220), rel=1e-8)
    held = {one["key"]: (one["sense"], one["level"], one["price"]) for one in found["holding"]}
    # by a millimetre of each
    assert held["stroke"] == (">=", 90, pytest.approx(speed**2 / 2 * (1 + 2 * 45 / 220) / 1000, rel=1e-7))
    assert held["rod.length"] == ("<=", 220, pytest.approx(-((0.045 * speed / 0.22) ** 2) / 1000, rel=1e-7))
    course = (tmp_path / "out" / "tables" / "course.csv").read_text(encoding="utf-8").splitlines()
    assert len(course) == found["designs"] + 1
    again = crankwork("check", "out/machine.toml")
    assert again.code == 0, again.err


def test_tables_of_the_best_machine_are_found_from_its_folder(crankwork, study, tmp_path):
    name = study(SEARCH.replace("stroke = { at_least", "swept_volume = { at_least").replace("90 mm", "600 cm3"))
    engine = POINTS_ENGINE
    measured = '[gas.measured]\nfile = "pressure.csv"\npressure_unit = "bar"\nshift = "0 deg"\n\n'
    engine = engine[: engine.index("[gas.points]")] + measured + engine[engine.index("[method]") :]
    (tmp_path / "machine.toml").write_text(engine, encoding="utf-8")
    samples = "".join(f"{at},{1 + at % 360 / 100}\n" for at in range(0, 721, 5))
    (tmp_path / "pressure.csv").write_text(samples, encoding="utf-8")
    answer = crankwork("optimise", name, "-o", "a/out")
    assert answer.code == 0, answer.err
    assert 'file = "../../pressure.csv"' in (tmp_path / "a" / "out" / "machine.toml").read_text(encoding="utf-8")
    again = crankwork("check", "a/out/machine.toml")
    assert again.code == 0, again.err


def test_a_study_without_what_reads_its_parts_says_what_to_install(study, check_refusals, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    told = "a study needs an optional part; install it with: pip install"
    check_refusals([(("sweep", study(), "-o", "out"), told)])


def test_a_search_without_scipy_says_what_to_install(study, check_refusals, monkeypatch):
    monkeypatch.setattr("crankwork.errors.find_spec", lambda name: None if name == "scipy" else name)
    two = ("stroke=90mm", "piston_velocity_max=14m/s", "--for", "crank.radius", "--for", "crank.speed")
    told = "needs an optional part; install it with: pip install"
    check_refusals([
        (("optimise", study(SEARCH), "-o", "out"), f"a study {told}"),
        (("solve", "machine.toml", *two), f"solving for several numbers {told}"),
    ])  # fmt: skip


def test_a_number_in_the_place_of_a_table_is_told(crankwork, study):
    for table in ("designs", "vary", "objectives", "limits", "search"):
        name = study(f'{table} = 3\nmachine = "machine.toml"\n')
        for command in ("sweep", "optimise"):
            answer = crankwork(command, name, "-o", "out")
            assert (answer.code, f"study.toml:1: {table}: must be a table" in answer.err) == (2, True), command
