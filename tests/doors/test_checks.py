"""Results that do not hold together, or not all round, end with a status of 1 and a sentence; all others with 0."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest

import crankwork.analysis
from crankwork.analysis import analyse
from crankwork.description.machine_file import read

EXAMPLE = str(Path(__file__).parents[2] / "examples" / "spark-engine.toml")
NO_WORK = """
[crank]
radius = "45 mm"
speed = "3000 rpm"
[rod]
ratio = 0.3
[piston]
mass = "0.6 kg"
[cylinder]
bore = "85 mm"
compression_ratio = 9
[gas]
cycle = "720 deg"
points = { a = { angle = "0 deg", pressure = "0.5 MPa" }, b = { angle = "720 deg" } }
pieces = [{ law = "constant", points = ["a", "b"] }]
"""
COMMANDS = {"check": (), "run": ("-o", "out", "--no-figures"), "report": ("-o", "note.html", "--no-figures")}


@pytest.fixture
def doubtful(monkeypatch) -> None:
    """Make one check of every analysis fail."""
    checks = {"work": 0.5, "overturning": 0.0}
    monkeypatch.setattr(
        crankwork.analysis, "analyse", lambda *machine, **options: replace(analyse(*machine, **options), checks=checks)
    )


@pytest.mark.usefixtures("doubtful")
@pytest.mark.parametrize("command", COMMANDS)
def test_a_check_that_is_not_met_ends_with_one_and_a_sentence_after_everything_is_written(
    crankwork, machine_file, command
) -> None:
    answer = crankwork(command, machine_file(), *COMMANDS[command])
    assert answer.code == 1
    assert answer.err.splitlines()[-1].startswith(
        "my.toml: 1 of 2 checks are not met (work by p–V = work by torque), so the results are not to be used; look for"
    )
    written = {"check": "", "run": "out/tables", "report": "note.html"}[command]
    assert Path(written).exists()


@pytest.mark.parametrize("language", ["en", "ru", "vi"])
def test_an_approximate_method_is_compared_with_its_own_error(crankwork, language) -> None:
    answer = crankwork("run", EXAMPLE, "--lang", language)
    assert answer.code == 0
    assert not any(word in answer.out for word in ("not met", "не выполнено", "không đạt"))
    assert any(word in answer.out for word in ("the error of the method", "погрешности метода", "của phương pháp"))


@pytest.mark.parametrize("method", ["textbook", "series:1", "series:3", "series:8"])
def test_the_error_that_is_allowed_is_the_one_that_is_stated(method) -> None:
    results = analyse(read(EXAMPLE, [f"method.kinematics={method}"]))
    assert 1e-12 < results.checks["work"] < results.allowed["work"]
    assert results.unmet == ()
    for residual in (2 * results.allowed["work"], math.nan):
        assert replace(results, checks={**results.checks, "work": residual}).unmet == ("work",)
    assert analyse(read(EXAMPLE, ["method.kinematics=exact"])).allowed == {}


def test_work_that_is_nothing_in_the_end_is_no_failure(crankwork, machine_file) -> None:
    answer = crankwork("run", machine_file(text=NO_WORK))
    assert answer.code == 0, answer.err
    assert "work by p–V = work by torque" in answer.out
    assert "not met" not in answer.out


LIMITS = {
    "an offset of nothing by a textbook": ("cylinder.offset=1e-6 um", "method.kinematics=textbook"),
    "intake near nought": ("gas.pieces[3].exponent=3", "cylinder.compression_ratio=100"),
}


@pytest.mark.parametrize("settings", LIMITS.values(), ids=LIMITS)
def test_numbers_at_their_limits_bring_no_warning_of_python(settings):
    results = analyse(read(EXAMPLE, overrides=settings))
    assert all(math.isfinite(one) for one in results.summary.values())
