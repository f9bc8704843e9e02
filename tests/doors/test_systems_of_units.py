"""Systems of units at the doors: what is written, what is told, and that results stay in SI."""

from __future__ import annotations

import csv
import functools
import json
import math
import re

import pytest

import crankwork
from crankwork.note.explain import explanation
from crankwork.note.options import NoteOptions
from crankwork.note.sections import note_of, written_note
from crankwork.report.summary import summary_data, summary_text
from crankwork.report.tables import csv_of_sheet, sheets

ENGINE = crankwork.template("engine")
SIZES = {
    "in": 25.4e-3, "in2": 6.4516e-4, "in3": 1.6387064e-5, "lbf": 4.4482216152605, "lbf*ft": 1.3558179483314004,
    "psi": 6894.757293168361, "ft/s": 0.3048, "ft/s2": 0.3048, "deg": math.pi / 180, "rad/s": 1.0, "rad/s2": 1.0,
    "lb*ft2": 0.04214011009380481, "-": 1.0,
}  # fmt: skip


@functools.cache
def engine(system: str) -> crankwork.Results:
    return crankwork.analyse(crankwork.read_machine(f'units = "{system}"\n{ENGINE}'))


def test_results_are_in_si_whatever_is_shown() -> None:
    plain, imperial = engine("metric"), engine("imperial")
    assert dict(plain.summary) == dict(imperial.summary)
    assert all((plain[key] == imperial[key]).all() for key in plain.columns)


def test_tables_have_the_units_that_their_headings_say() -> None:
    for system in ("si", "imperial"):
        results = engine(system)
        for sheet in sheets(results).values():
            rows = list(csv.reader(csv_of_sheet(sheet).decode().splitlines()))
            for heading, cell in zip(rows[0], rows[2], strict=True):
                key, unit = re.fullmatch(r"(\S+) \[(.+)\]", heading).groups()
                size = SIZES[unit] if system == "imperial" or unit in ("deg", "-") else 1.0
                if key in results.columns and key != "crank_angle":
                    assert float(cell) * size == pytest.approx(results[key][1], rel=1e-12, abs=1e-12), heading
        assert ("lbf" if system == "imperial" else "Pa") in csv_of_sheet(sheets(results)["forces"]).decode()


def test_summary_json_and_explanation_speak_one_system() -> None:
    results = engine("imperial")
    found = summary_data(results)["summary"]["piston_force_max"]
    assert found["unit"] == "lbf"
    assert found["value"] * 4.4482216152605 == pytest.approx(results.summary["piston_force_max"])
    assert "lbf·ft" in summary_text(results)
    assert " MPa" not in summary_text(results)
    told = explanation(results, "piston_force", 30.0, place=lambda *_: "")
    assert "lbf" in told


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "languages", "on_paper"),
    # scale, rounding and headings of plans are in millimetres of the paper
    [("engine", ["ru"], 0), ("press", ["vi"], 7), ("crank-shaper", ["en", "ru"], 7)],
)
def test_a_note_shows_every_value_in_its_system_beside_si(name, languages, on_paper) -> None:
    results = crankwork.analyse(crankwork.read_machine(f'units = "imperial"\n{crankwork.template(name)}'))
    found = {}
    for language in languages:
        page = written_note(
            note_of(results, NoteOptions(full=True, language=language, figures=False)), "note.html"
        ).decode()
        text = re.sub(r"<[^>]+>", " ", re.sub(r"<style.*?</style>", "", page, flags=re.DOTALL))
        found[language] = re.findall(r"\bMPa\b|\bМПа\b|cm³|см³|\bmm\b|\bмм\b", text)
        assert ("фунт-сила" if language == "ru" else "lbf") in text
    assert found == {language: ["мм" if language == "ru" else "mm"] * on_paper for language in languages}


def test_the_option_stands_over_the_file(machine_file, crankwork) -> None:
    path = machine_file(text=f'units = "imperial"\n{ENGINE}')
    done = crankwork("run", path, "--units", "si", "--json")
    assert json.loads(done.out)["summary"]["gas_pressure_max"]["unit"] == "Pa"


def test_a_system_that_is_none_is_told_with_those_that_are() -> None:
    with pytest.raises(crankwork.InputError, match=r'units: .*"metric", "si" or "imperial"'):
        engine("inches")


def test_what_was_taken_for_what_is_told() -> None:
    heavy = ENGINE.replace('mass = "0.55 kg"', f'mass = "{0.55 * 9.80665!r} N"')
    plain, weighed = (crankwork.analyse(crankwork.read_machine(one)) for one in (ENGINE, heavy))
    assert [one.values["path"] for one in weighed.notices if one.code == "weight"] == ["piston.mass"]
    assert weighed["piston_force"] == pytest.approx(plain["piston_force"], rel=1e-12)


@pytest.mark.parametrize("many", [100, 500_000])
def test_workbooks_of_the_same_results_are_the_same_bytes(monkeypatch, many) -> None:
    from crankwork.report.results_folder import workbook

    monkeypatch.setattr("crankwork.report.results_folder._MANY", many)
    assert workbook(engine("metric")) == workbook(engine("metric"))
