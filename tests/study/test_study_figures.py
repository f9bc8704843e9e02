"""Figures of studies and maps: lines of equal value where they are, texts that can be read, numbers of the tables."""

from __future__ import annotations

import numpy as np
import pytest

from crankwork.description.document import Description
from crankwork.description.machine_file import template
from crankwork.locale import LANGUAGES
from crankwork.quantities import QUANTITIES
from crankwork.show.canvas import BLACK, MM
from crankwork.show.chart import ChartBox, Field, Graph, contours, round_ticks, sheet
from crankwork.show.scene import Circle, Polyline, Text, pen_of
from crankwork.study.figures import found_drawings, map_drawings
from crankwork.study.parameter_map import mapped
from crankwork.study.runner import ExecutionOptions, run_study
from crankwork.study.study_file import load_study
from crankwork.study.study_text import found_data
from looks import faults

STUDY = """\
machine = "machine.toml"
values = "stroke"
[designs]
drawing = "saltelli"
count = 1000
angles = 72
[vary]
crank.radius = { from = "40 mm", to = "50 mm" }
crank.speed = { from = "1000 rpm", to = "2000 rpm" }
"rod.ratio" = "0.25 sd 0.01"
[objectives]
piston_velocity_max = "minimise"
stroke = "maximise"
piston_acceleration_max = "minimise"
[limits]
piston_velocity_max = { at_least = "5 m/s", at_most = "8 m/s" }
"""
NAMES = [
    *(f"histogram.{key}" for key in ("piston_acceleration_max", "piston_velocity_max", "stroke")),
    *(f"parallel.{key}" for key in ("piston_acceleration_max", "piston_velocity_max", "stroke")),
    "pareto", "pareto_2", "pareto_3",
    *(f"sensitivity.{key}" for key in ("piston_acceleration_max", "piston_velocity_max", "stroke")),
]  # fmt: skip


def seen(drawing):
    """Return what is wrong with a drawing; keys of files have their underscores."""
    return [one for one in faults(drawing) if one.kind != "mark"]


@pytest.mark.elsewhere
def test_lines_of_equal_height_are_circles_of_a_paraboloid_and_lines_of_a_plane():
    x, y = np.linspace(-2, 2, 81), np.linspace(-3, 3, 121)
    across, up = np.meshgrid(x, y, indexing="ij")
    (circle,) = Field(x, y, across**2 + up**2).lines(2.0)
    assert np.hypot(*circle.T) == pytest.approx(np.sqrt(2), abs=2e-3)
    assert circle[0] == pytest.approx(circle[-1])
    around = np.unwrap(np.arctan2(circle[:, 1], circle[:, 0]))
    assert abs(around[-1] - around[0]) == pytest.approx(2 * np.pi)
    plane = 3 * across - 2 * up
    (line,) = Field(x, y, plane).lines(1.3)
    assert 3 * line[:, 0] - 2 * line[:, 1] == pytest.approx(1.3)
    # of a saddle four branches, none of which crosses another
    assert len(Field(x, y, across * up).lines(0.5)) == 2
    assert Field(x, y, plane).lines(1e3) == []


def test_a_hole_has_no_lines():
    x = y = np.linspace(0, 1, 11)
    z = np.add.outer(x, y)
    z[4:7, 4:7] = np.nan
    field = Field(x, y, z)
    assert field.holes.sum() == 16
    lines = field.lines(1.0)
    assert len(lines) == 2
    assert all(((line[:, 0] <= 0.3 + 1e-9) | (line[:, 0] >= 0.7 - 1e-9)).all() for line in lines)


def test_numbers_stand_on_their_lines():
    paper, box = sheet(200.0)
    graph = Graph(paper, ChartBox(*box), (0.0, 10.0), (0.0, 10.0), "en")
    x = np.linspace(0, 10, 21)
    contours(graph, Field(x, x, np.add.outer(x, 2 * x)), round_ticks(0, 30, 6))
    texts = [one for one in paper.drawing("").items if isinstance(one, Text)]
    assert {one.text for one in texts} == {"5", "10", "15", "20", "25"}
    height = paper.drawing("").height
    for one in texts:
        left, down = one.place[0] / 25.4 * 72, (height - one.place[1]) / 25.4 * 72 - 2.6
        across, up = (left - box.left) / box.width * 10, 10 - (down - box.top) / box.height * 10
        assert across + 2 * up == pytest.approx(float(one.text), abs=0.15)


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """A study, and what is found of it."""
    folder = tmp_path_factory.mktemp("study")
    (folder / "machine.toml").write_text(template("slider-crank"), encoding="utf-8")
    (folder / "study.toml").write_text(STUDY, encoding="utf-8")
    study = load_study(folder / "study.toml")
    return study, run_study(study, folder / "out", ExecutionOptions(1))


@pytest.mark.data
def test_figures_of_a_study_can_be_read(found):
    wrong = {}
    for language in LANGUAGES:
        drawn = found_drawings(*found, language)
        assert sorted(drawn) == NAMES
        wrong |= {(language, name): faulty for name, one in drawn.items() if (faulty := seen(one))}
    assert wrong == {}


@pytest.mark.data
def test_figures_show_the_designs_of_the_tables(found):
    drawn, data = found_drawings(*found, "en"), found_data(*found)
    dots = [one for one in drawn["pareto"].items if isinstance(one, Circle)]
    # and one in the legend, which is larger
    assert sum(one.fill == 0 and one.radius == pytest.approx(1.5 * MM) for one in dots) == len(data["pareto"])
    x, y = drawn["histogram.stroke"].plots[0].curves["count"]
    assert np.sum(np.diff(x[1:-1:2], append=x[-1]) > 0) == len(found[1].histograms["stroke"].counts)
    assert y[1:-1:2].sum() == data["values"]["stroke"]["count"] == 1000
    lines = [one for one in drawn["parallel.stroke"].items if isinstance(one, Polyline) and len(one.points) == 4]
    assert sum(pen_of(one.kind).colour == BLACK for one in lines) == len(data["best"]["stroke"]) == 10
    # the largest stroke stands at the upper end of its axis and that of the crank radius
    best = lines[-1].points
    assert best[0, 1] == pytest.approx(best[-1, 1], abs=0.02 * drawn["parallel.stroke"].height)


def test_maps_can_be_read():
    engine = Description(template("engine"))
    found, wrong = mapped(engine, ["crank.speed=800..6000rpm:4", "rod.length=30..200mm:4"]), {}
    for language in LANGUAGES:
        drawn = map_drawings(found, language)
        wrong |= {(language, name): faulty for name, one in drawn.items() if (faulty := seen(one))}
        # the velocity grows as the speed does, the least ratio of the rod does not depend on it
        assert set(drawn["map.rod_ratio"].plots[0].curves) == {"rod_ratio"}
        assert len(drawn["map.piston_velocity_max"].plots[0].curves) > 3
        # axes have names and symbols of the field, not keys of the file
        titles = drawn["map.piston_velocity_max"].plots[0].titles
        for title, key in zip((titles["x"], titles["y"]), ("rotational_speed", "rod_length"), strict=True):
            assert QUANTITIES[key].label(language) in title
            assert f"/{{{QUANTITIES[key].symbol(language)[0]}}}" in title
    assert wrong == {}
