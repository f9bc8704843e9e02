"""Values that studies ask of columns, numbers that follow others, and several numbers sought at once."""

from __future__ import annotations

import io
import math
import sys
import zipfile

import numpy as np
import pytest

import crankwork
from crankwork import CrankworkError, Description, cli
from crankwork.analysis.requested_values import with_requested
from crankwork.study.optimise import best_of
from crankwork.study.parameter_map import mapped
from crankwork.study.runner import ExecutionOptions, run_study
from crankwork.study.solve import several_text, solve_several
from crankwork.study.study_file import load_study
from crankwork.study.study_text import found_files, optimum_files
from machine_texts import POINTS_ENGINE

pytestmark = pytest.mark.usefixtures("by_arrays")
ENGINE = Description(POINTS_ENGINE)
SLIDER_CRANK = Description(crankwork.template("slider-crank"))
STUDY = """\
machine = "engine.toml"
values = ["piston_displacement@90deg", "piston_area", "side_force_max"]
[settings]
cylinder.bore = "1.8 * crank.radius"
rod.length = "3.5 * crank.radius"
[designs]
drawing = "grid"
[vary]
crank.radius = { from = "40 mm", to = "50 mm", steps = 4 }
"""


@pytest.fixture
def study(tmp_path):
    (tmp_path / "engine.toml").write_text(POINTS_ENGINE, encoding="utf-8")

    def written(text):
        (tmp_path / "study.toml").write_text(text, encoding="utf-8")
        return tmp_path / "study.toml"

    return written


def displaced(r, length, degrees):
    """Return the piston displacement of a slider-crank without offset, from top dead centre."""
    phi = math.radians(degrees)
    return r * (1 - math.cos(phi)) + length - math.sqrt(length**2 - (r * math.sin(phi)) ** 2)


def test_a_column_is_taken_at_an_angle_and_at_its_extremes():
    results = crankwork.analyse(SLIDER_CRANK.machine())
    r, length = results.value("crank_radius"), results.value("rod_length")
    keys = ["piston_displacement@77.5deg", "side_force_max", "side_force_max_angle", "rod_angle_min"]
    requested = with_requested(results, keys)
    assert requested.value(keys[0]) == pytest.approx(displaced(r, length, 77.5), rel=1e-13)
    angles = np.arange(0.0, 360.0, 0.01)
    force = results.columns_at(angles, ["side_force"])["side_force"]
    assert requested.value("side_force_max") == pytest.approx(force.max(), rel=1e-7)
    assert math.degrees(requested.value("side_force_max_angle")) == pytest.approx(angles[force.argmax()], abs=0.02)
    assert abs(requested.value("rod_angle_min")) == pytest.approx(math.asin(r / length), rel=1e-12)
    assert with_requested(results, ["stroke", "nonsense_max"]) is results


def test_a_sweep_takes_values_at_an_angle_and_numbers_that_follow(study):
    found = crankwork.sweep(
        ENGINE,
        {"crank.radius": ["40 mm", "45 mm", "50 mm"]},
        ["piston_displacement@90deg", "piston_area", "side_force_max"],
        overrides=["cylinder.bore = 1.8 * crank.radius", "rod.length = 7 * crank.radius / 2"],
    )
    assert (found.reason, found.one_by_one) == ("", 0)
    radii = np.array([0.04, 0.045, 0.05])
    np.testing.assert_allclose(found.values["piston_area"], math.pi / 4 * (1.8 * radii) ** 2, rtol=1e-12)
    expected = [displaced(r, 3.5 * r, 90.0) for r in radii]
    np.testing.assert_allclose(found.values["piston_displacement@90deg"], expected, rtol=1e-12)
    alone = crankwork.analyse(ENGINE.machine(["crank.radius=50 mm", "cylinder.bore=90 mm", "rod.length=175 mm"]))
    assert found.values["side_force_max"][2] == pytest.approx(
        with_requested(alone, ["side_force_max"])["side_force_max"]
    )
    stated = load_study(study(STUDY))
    assert stated.keys == ("piston_displacement@90deg", "piston_area", "side_force_max")
    assert stated.stated["piston_area"] == pytest.approx(math.pi / 4 * (1.8 * 0.045) ** 2)


def test_the_best_design_is_written_with_the_numbers_that_follow(study, tmp_path):
    text = STUDY.partition("[designs]")[0].replace(
        'values = ["piston_displacement@90deg", "piston_area", "side_force_max"]\n', ""
    )
    text += '[vary]\ncrank.radius = { from = "40 mm", to = "50 mm" }\n[objectives]\npiston_area = "maximise"\n'
    text += '[limits]\n"piston_displacement@90deg" = { at_most = "55 mm" }\n'
    stated = load_study(study(text), is_search=True)
    best = best_of(stated)
    radius = 0.055 / (1 + 3.5 - math.sqrt(3.5**2 - 1))
    assert best.fields["crank.radius"] == pytest.approx(radius, rel=1e-9)
    written = Description(optimum_files(stated, best, tmp_path)["machine.toml"].decode()).machine()
    assert crankwork.analyse(written).value("piston_area") == pytest.approx(math.pi / 4 * (1.8 * radius) ** 2, rel=1e-9)


def test_a_map_shows_the_values_that_are_named():
    found = mapped(ENGINE, ["crank.radius=40..50mm:2"], keys=["piston_displacement@90deg"])
    assert list(found.values) == ["piston_displacement@90deg"]
    expected = [displaced(r, 0.16, 90.0) for r in (0.04, 0.045, 0.05)]
    np.testing.assert_allclose(found.values["piston_displacement@90deg"], expected, rtol=1e-12)


def test_spreads_are_those_of_values_at_an_angle():
    text = crankwork.template("slider-crank")
    described = Description(text)
    described["crank.radius"] = "50 sd 0.1 mm"
    length = crankwork.analyse(described.machine()).value("rod_length")
    found = crankwork.spread(described, ["piston_displacement@60deg"])["piston_displacement@60deg"]
    step = 1e-7
    slope = (displaced(0.05 + step, length, 60.0) - displaced(0.05 - step, length, 60.0)) / (2 * step)
    assert found.deviation == pytest.approx(1e-4 * slope, rel=1e-4)


def test_two_numbers_are_found_for_two_values():
    # r + l - sqrt(l^2 - r^2) = 56.4 mm with r = 50 mm
    found = solve_several(
        SLIDER_CRANK,
        ["stroke = 100 mm", "piston_displacement@90deg = 56.4 mm"],
        ["crank.radius", "rod.length"],
        limits=[("30 mm", "80 mm"), ("120 mm", "400 mm")],
    )
    assert len(found.solutions) == 1
    np.testing.assert_allclose(found.solutions[0], [0.05, (0.05**2 + 0.0064**2) / 0.0128], rtol=1e-9)
    for language, words in (("en", "Solutions"), ("ru", "Решения"), ("vi", "Nghiệm")):
        text = several_text(found, language)
        assert words in text
        assert "rod.length" in text


def test_what_has_no_solution_says_what_comes_nearest():
    found = solve_several(
        SLIDER_CRANK, ["stroke = 100 mm", "piston_displacement@90deg = 49 mm"], ["crank.radius", "rod.length"],
        limits=[("30 mm", "80 mm"), ("120 mm", "400 mm")],
    )  # fmt: skip
    assert found.solutions == ()
    assert "No solution in this range" in several_text(found)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["stroke = 100 mm", "--for", "crank.radius", "--for", "rod.length"], "1 equations and 2 numbers"),
        (
            ["stroke = 1 m", "--for", "crank.radius", "--from", "1 mm", "--from", "2 mm"],
            "--from and --to once for each",
        ),
        (["crank_torque = 3", "--for", "crank.radius"], "crank_torque@90deg"),
        (["stroke@3deg = 3 mm", "--for", "crank.radius"], "one value for the whole cycle"),
    ],
)
def test_questions_that_cannot_be_answered(tmp_path, monkeypatch, capsys, arguments, message):
    path = tmp_path / "machine.toml"
    path.write_text(crankwork.template("slider-crank"), encoding="utf-8")
    monkeypatch.setattr(sys, "argv", ["crankwork", "solve", str(path), *arguments])
    with pytest.raises(SystemExit) as ended:
        cli.main()
    assert ended.value.code == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        (
            "cylinder.bore = 2 * crank.radiu",
            r"^cylinder\.bore = 2 \* crank\.radiu: crank\.radiu: .* did you mean radius",
        ),
        ("cylinder.bore = 2 * crank.speed", "another kind of quantity"),
        ("cylinder.bore = 2 * piston.height", "piston.height"),
    ],
)
def test_a_number_that_cannot_follow_is_refused(setting, message):
    with pytest.raises(CrankworkError, match=message):
        ENGINE.machine([setting])


def test_a_file_of_numbers_is_no_number_that_follows():
    with pytest.raises(CrankworkError, match=r"bench\.csv"):
        ENGINE.machine(["gas.measured.file = bench.csv"])


def test_a_column_alone_is_refused_with_what_to_write():
    with pytest.raises(CrankworkError, match="crank_torque@90deg, or crank_torque_max"):
        crankwork.sweep(SLIDER_CRANK, {"crank.radius": ["40 mm"]}, ["crank_torque"])


@pytest.mark.data
def test_the_tables_of_a_study_are_a_workbook_too(study, tmp_path, monkeypatch):
    stated = load_study(study(STUDY))
    aggregate = run_study(stated, tmp_path / "out", ExecutionOptions(1))
    with zipfile.ZipFile(io.BytesIO(found_files(stated, aggregate)["study.xlsx"])) as book:
        names = book.read("xl/workbook.xml").decode()
        words = book.read("xl/sharedStrings.xml").decode()
    assert "Histogram.side_force_max" in names
    assert "Histogram.piston_displacement@" in names
    assert "count" in words
    with monkeypatch.context() as patched:
        patched.setitem(sys.modules, "xlsxwriter", None)
        assert "study.xlsx" not in found_files(stated, aggregate)
    # every design is kept where there are few, though the file does not say so
    assert stated.has_rows
