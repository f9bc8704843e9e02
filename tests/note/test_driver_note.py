"""Note, explanation, figures and moving drawing of machines whose driver follows a law over time."""

import re

import pytest

from crankwork.analysis.sampled_motion import sample_motion
from crankwork.analysis.vector_polygons import accelerations, driver_rates, velocities
from crankwork.errors import CrankworkError
from crankwork.note.document import Table
from crankwork.note.web import web
from crankwork.report.drawing import moving_drawing
from crankwork.report.figures import figures
from crankwork.report.summary import description_text, summary_text
from crankwork.show.svg import moving_svg
from notes import blocks, note, results, sheets

# how the driver moves: a cylinder on the frame, a slider, an angle at a joint, a table, a cylinder between two links
CRANKLESS = ("boom", "driven-slider", "elbow", "cylinder-between-links")
LIGHT, OTHERS = ("boom",), ("elbow", "driven-slider", "crank-by-table", "cylinder-between-links", "gas-by-law")


@pytest.mark.slow
@pytest.mark.parametrize("names", [LIGHT, pytest.param(OTHERS, marks=pytest.mark.slow)], ids=["light", "others"])
def test_what_a_driver_moves_runs_over_time(names):
    """Figures, sheets and the moving drawing have the time, and say nothing of a crank where no crank drives."""
    for name in names:
        one = results(name)
        drawn = figures(one)
        assert "driver" in drawn, name
        assert [key for key, data in drawn.items() if "angle of the crank" in data.decode()] == [], name
        film = moving_drawing(one)
        assert [text for text in film.readouts if not re.fullmatch(r"/{t} = [\d.]+ s", text)] == [], name
        assert b"nan" not in moving_svg(film), name
        if name in ("boom", "cylinder-between-links"):
            shown = [figure for sheet in sheets(name) for figure in sheet.figures]
            assert {"position_plans", "velocity_plans", "acceleration_plans", "driver"} <= {one.name for one in shown}
            plots = [plot for figure in shown for plot in figure.drawing.plots]
            assert {plot.over for plot in plots if plot.titles.get("x", "").endswith(", s")} == {"time"}, name
            assert "crank_angle" not in {plot.over for plot in plots}, name
        if name in CRANKLESS:
            page = re.sub(r"<style.*?</style>|<[^>]+>", " ", web(note(name)).decode(), flags=re.DOTALL)
            said = [summary_text(one), description_text(one), film.about]
            said += [key for keys in one.tables.values() for key in keys]
            assert not any("third_side" in text for text in said), name
            for text in (page, *said):
                assert "crank" not in text.replace("crankwork", "").lower(), re.findall(".{40}crank.{40}", text)


def test_joints_of_a_cylinder_are_those_of_its_barrel_and_of_its_rod():
    cells = [row[2] for table in blocks(note("boom"), Table) for row in table.rows if len(row) == 4]
    between = [cell for cell in cells if re.fullmatch(r"\d–\d", str(cell))]
    # one closed loop of four links: each has two joints
    assert sorted("".join(between).replace("–", "")) == list("00112233"), between


def test_explanations_are_at_times():
    boom = results("boom")
    text = boom.explain("driver_force", at=2.0).replace("\u00a0", " ")
    for part in ("(2 s)", "At the time 2 s", "law from 0 s to 4 s"):
        assert part in text
    assert "°" not in text.partition("Given values")[0]
    assert boom.value("driver_displacement", at=2.0) == pytest.approx(1.6, rel=1e-14)
    with pytest.raises(CrankworkError, match="--at 4"):
        boom.value("driver_force")
    with pytest.raises(CrankworkError, match="from 0 to 8 s"):
        boom.value("driver_force", at=9.0)


def test_the_rod_of_a_cylinder_slides_on_its_barrel_in_the_plans():
    one, at = results("boom"), [25.0, 300.0]
    mechanism, known = one.machine.mechanism, one.columns_at(at)
    moved, rates = sample_motion(mechanism, at), driver_rates(one, known)
    for i in range(2):
        rate, second = float(rates.first[i]), float(rates.second[i])
        turning = known["link_angular_velocity.cylinder"][i]
        speed = {v.name: v for v in velocities(mechanism, moved, i, rate).vectors if v.kind == "sliding"}
        assert speed["BB1"].length == pytest.approx(abs(rate), rel=1e-12)
        plan = accelerations(mechanism, moved, i, rate, second).vectors
        parts = {v.kind: v for v in plan if v.name == "BB1"}
        assert parts["coriolis"].length == pytest.approx(2 * abs(turning * rate), rel=1e-12)
        assert parts["sliding"].length == pytest.approx(abs(second), rel=1e-9, abs=1e-12)
        (end,) = (v.end for v in plan if v.name == "B")
        assert end == pytest.approx([known["point_acceleration_x.B"][i], known["point_acceleration_y.B"][i]])
