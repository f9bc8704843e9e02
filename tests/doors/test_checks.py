"""Results that do not hold together, or not all round, end with a status of 1 and a sentence; all others with 0."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import crankwork.analysis as crankwork_analysis
from crankwork.analysis import analyse
from crankwork.description.machine_file import read

EXAMPLE = str(Path(__file__).parents[2] / "examples" / "spark-engine.toml")
NO_WORK = """
crank = { radius = "45 mm", speed = "3000 rpm" }
rod.ratio = 0.3
piston.mass = "0.6 kg"
cylinder = { bore = "85 mm", compression_ratio = 9 }
[gas]
cycle = "720 deg"
points = { a = { angle = "0 deg", pressure = "0.5 MPa" }, b = { angle = "720 deg" } }
pieces = [{ law = "constant", points = ["a", "b"] }]
"""


def test_a_check_that_is_not_met_ends_with_one_and_a_sentence_after_everything_is_written(
    crankwork, machine_file, monkeypatch
) -> None:
    checks = {"work": 0.5, "overturning": 0.0}
    monkeypatch.setattr(
        crankwork_analysis, "analyse", lambda *machine, **options: replace(analyse(*machine, **options), checks=checks)
    )
    name = machine_file()
    for command, options, written in (
        ("check", (), "."),
        ("run", ("-o", "out", "--no-figures"), "out/tables"),
        ("report", ("-o", "note.html", "--no-figures"), "note.html"),
        ("page", ("-o", "page.html"), "page.html"),
        ("draw", ("-o", "drawn.svg", "--at", "30"), "drawn.svg"),
    ):
        answer = crankwork(command, name, *options)
        assert answer.code == 1, command
        assert answer.err.splitlines()[-1].startswith(
            "my.toml: 1 of 2 checks are not met (work by p–V = work by torque), so the results are not to be used; look"
        )
        assert Path(written).exists()


def test_an_approximate_method_is_compared_with_its_own_error(crankwork) -> None:
    for language, said, unmet in (
        ("en", "the error of the method", "not met"),
        ("ru", "погрешности метода", "не выполнено"),
        ("vi", "của phương pháp", "không đạt"),
    ):
        answer = crankwork("run", EXAMPLE, "--lang", language)
        assert (answer.code, said in answer.out, unmet in answer.out) == (0, True, False), language


def test_the_error_that_is_allowed_is_the_one_that_is_stated() -> None:
    for method in ("textbook", "series:1", "series:3", "series:8"):
        results = analyse(read(EXAMPLE, [f"method.kinematics={method}"]))
        assert 1e-12 < results.checks["work"] < results.allowed["work"], method
        assert results.unmet == ()
        for residual in (2 * results.allowed["work"], math.nan):
            assert replace(results, checks={**results.checks, "work": residual}).unmet == ("work",), method
    assert analyse(read(EXAMPLE, ["method.kinematics=exact"])).allowed == {}


def test_work_that_is_nothing_in_the_end_is_no_failure(crankwork, machine_file) -> None:
    answer = crankwork("run", machine_file(text=NO_WORK))
    assert answer.code == 0, answer.err
    assert "work by p–V = work by torque" in answer.out
    assert "not met" not in answer.out


def test_numbers_at_their_limits_bring_no_warning_of_python():
    for settings in (
        # an offset of nothing by a textbook, and an intake near nought
        ("cylinder.offset=1e-6 um", "method.kinematics=textbook"),
        ("gas.pieces[3].exponent=3", "cylinder.compression_ratio=100"),
    ):
        results = analyse(read(EXAMPLE, overrides=settings))
        assert [key for key, one in results.summary.items() if not math.isfinite(one)] == [], settings
