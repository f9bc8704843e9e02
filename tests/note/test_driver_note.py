"""Note, explanation, figures and moving drawing of machines whose driver follows a law over time."""

import dataclasses
import re
from pathlib import Path

import pytest

import crankwork
from crankwork.analysis.moving import moving
from crankwork.analysis.plans import accelerations, driver_rates, velocities
from crankwork.errors import CrankworkError
from crankwork.locale import LANGUAGES
from crankwork.note.linkage_note import linkage_note
from crankwork.note.options import NoteOptions
from crankwork.note.sheets import drawn_sheets
from crankwork.note.web import web
from crankwork.report.drawing import moving_drawing
from crankwork.report.figures import figures
from crankwork.report.summary import description_text, summary_text
from crankwork.show.moving_svg import moving_svg

MACHINES = Path(__file__).parent.parent / "machines"
NAMES = ("boom", "driven-slider", "elbow", "crank-by-table", "cylinder-between-links", "gas-by-law", "heavy-boom")


@pytest.fixture(scope="module")
def results():
    return {name: crankwork.analyse(crankwork.read(MACHINES / f"{name}.toml")) for name in NAMES}


def written(results, language):
    """Return the note as plain words."""
    note = linkage_note(results, NoteOptions(language=language, figures=False))
    page = re.sub(r"<style.*?</style>", " ", web(note).decode(), flags=re.DOTALL)
    return re.sub(r"<[^>]+>", " ", page)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_note_is_written(results, language):
    for name, one in results.items():
        text = written(one, language)
        assert not re.search(r"[{}]|None|nan", text), name
        assert one.machine.title in text


@pytest.mark.parametrize("name", ["boom", "driven-slider", "elbow", "cylinder-between-links"])
def test_where_no_crank_drives_nothing_says_crank(results, name):
    one = dataclasses.replace(results[name])
    said = [written(one, "en"), summary_text(one), description_text(one), moving_drawing(one).about]
    said += [column for keys in one.tables.values() for column in keys]
    assert not any("third_side" in text for text in said[1:])
    for text in said:
        assert "crank" not in text.replace("crankwork", "").lower(), re.findall(".{40}crank.{40}", text)


def test_joints_of_a_cylinder_are_those_of_its_barrel_and_of_its_rod(results):
    note = linkage_note(results["boom"], NoteOptions(language="en", figures=False))
    cells = [row[2] for one in note.blocks for row in getattr(one, "rows", ()) if len(row) == 4]
    between = [cell for cell in cells if re.fullmatch(r"\d–\d", cell)]
    # one closed loop of four links: each has two joints
    assert sorted("".join(between).replace("–", "")) == list("00112233"), between


def test_explanations_are_at_times(results):
    boom = results["boom"]
    text = boom.explain("driver_force", at=2.0).replace("\u00a0", " ")
    assert "(2 s)" in text
    assert "At the time 2 s" in text
    assert "law from 0 s to 4 s" in text
    assert "°" not in text.partition("Given values")[0]
    assert boom.value("driver_displacement", at=2.0) == pytest.approx(1.6, rel=1e-14)
    with pytest.raises(CrankworkError, match="--at 4"):
        boom.value("driver_force")
    with pytest.raises(CrankworkError, match="from 0 to 8 s"):
        boom.value("driver_force", at=9.0)


@pytest.mark.parametrize("name", NAMES)
def test_figures_run_over_time(results, name):
    one = results[name]
    drawn = figures(one)
    assert "driver" in drawn
    for data in drawn.values():
        assert "angle of the crank" not in data.decode()
    film = moving_drawing(one)
    assert all(re.fullmatch(r"/{t} = [\d.]+ s", text) for text in film.readouts)
    assert b"nan" not in moving_svg(film)


@pytest.mark.parametrize("name", NAMES)
def test_sheets_run_over_time(results, name):
    sheets = drawn_sheets(results[name])
    drawn = {one.name for sheet in sheets for one in sheet.figures}
    assert {"position_plans", "velocity_plans", "acceleration_plans", "driver"} <= drawn
    plots = [plot for sheet in sheets for one in sheet.figures for plot in one.drawing.plots]
    assert {one.over for one in plots if one.titles.get("x", "").endswith(", s")} == {"time"}
    assert "crank_angle" not in {one.over for one in plots}


def test_the_rod_of_a_cylinder_slides_on_its_barrel_in_the_plans(results):
    one, at = results["boom"], [25.0, 300.0]
    mechanism, known = one.machine.mechanism, one.columns_at(at)
    moved, rates = moving(mechanism, at), driver_rates(one, known)
    for i in range(2):
        rate, second = float(rates.first[i]), float(rates.second[i])
        turning = known["link_angular_velocity.cylinder"][i]
        speed = {v.of: v for v in velocities(mechanism, moved, i, rate).vectors if v.kind == "sliding"}
        assert speed["BB1"].length == pytest.approx(abs(rate), rel=1e-12)
        plan = accelerations(mechanism, moved, i, rate, second).vectors
        parts = {v.kind: v for v in plan if v.of == "BB1"}
        assert parts["coriolis"].length == pytest.approx(2 * abs(turning * rate), rel=1e-12)
        assert parts["sliding"].length == pytest.approx(abs(second), rel=1e-9, abs=1e-12)
        (end,) = (v.end for v in plan if v.of == "B")
        assert end == pytest.approx([known["point_acceleration_x.B"][i], known["point_acceleration_y.B"][i]])
