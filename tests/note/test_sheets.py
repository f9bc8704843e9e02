"""Drawing sheets: what is measured on paper times the scale written there is the result, and everything has room."""

from __future__ import annotations

import functools
import itertools
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.analysis import analyse
from crankwork.analysis.diagrams import brix_points
from crankwork.analysis.plans import Plan, Vector
from crankwork.analysis.whole_engine import as_engine
from crankwork.description.machine_file import read, read_machine, template
from crankwork.errors import CrankworkError
from crankwork.kinematics.crank_grid import CrankGrid
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.kinematics.textbook import textbook_displacement
from crankwork.note.sheets import Paper, TitleBlock, drawn_sheets
from crankwork.note.sheets.engine_motion import tolle_corners
from crankwork.note.sheets.engine_whole import whole_engine_extra
from crankwork.note.sheets.linkage_polygons import Numbered, vector_plans
from crankwork.note.sheets.placing import Named, names_beside
from crankwork.note.sheets.sheet import SIZES
from crankwork.note.sheets.words import Words
from crankwork.quantities import LANGUAGES
from crankwork.report.figure_data import drawn_from
from crankwork.show.scene import Box, Circle, Hatch, Polyline, Text, extent, hatch_lines, text_width
from crankwork.units import from_si

EXAMPLES = Path(__file__).parents[2] / "examples"
ROUND = (1.0, 2.0, 2.5, 4.0, 5.0)
EXTRA = {
    "crank_angle": np.linspace(0, 4 * np.pi, 361),
    "total_torque": 100 + 80 * np.cos(2 * np.linspace(0, 4 * np.pi, 361)),
    "crankpin_load": 5000 + 1000 * np.cos(np.linspace(0, 4 * np.pi, 361)),
    "wear_sums": np.array([60e3, 30e3, 10e3, 20e3, 40e3, 50e3]),
}
SIGNED = Paper(block=TitleBlock(designation="КП.01.02.000", drawn_by="Nguyễn Văn Đức", organisation="МГТУ"))


@functools.cache
def results(name):
    if name == "flywheel":
        return analyse(
            read_machine(template("toggle-press").replace("[table]", "[flywheel]\nfluctuation = 0.04\n[table]"))
        )
    path = EXAMPLES / f"{name}.toml"
    return analyse(read(path) if path.exists() else read_machine(template(name)))


def sheets(name, language="en", paper=SIGNED, **options):
    return drawn_sheets(results(name), language, paper=paper, **options)


ALL = ["spark-engine", "engine", "compressor", "slider-crank", "press", "press-geometry", "flywheel",
       "stephenson-six-bar", "whitworth", "scotch-yoke", "andrews-squeezer"]  # fmt: skip


def written_scale(graph, symbol):
    """Return the number of a scale as it stands on the sheet."""
    texts = [one.text for one in graph.items if isinstance(one, Text)]
    found = re.search(rf"μ_\{{{re.escape(symbol)}\}} = ([\d.,]+)", "\n".join(texts))
    assert found, texts
    return float(found[1].replace(",", "."))


def test_pressure_measured_on_the_sheet_is_the_pressure():
    """The note of the example prints 5.083 MPa at 365 and 370 degrees and 2.42322 MPa at 360."""
    sheet = sheets("spark-engine", "ru")[0]
    for name, symbol in (("indicator", "p"), ("developed", "p")):
        graph = sheet.graph(name)
        line, scale = graph.curve("gas_pressure"), written_scale(graph, symbol)
        assert np.max(line[:, 1] - graph.y.zero) * scale == pytest.approx(5.083, rel=1e-9)
    graph = sheet.graph("developed")
    line, degrees = graph.curve("gas_pressure"), written_scale(graph, "φ")
    angles = (line[:, 0] - graph.x.zero) * degrees
    assert angles[-1] == pytest.approx(720, rel=1e-12)
    at = int(np.argmin(np.abs(angles - 360)))
    assert (line[at, 1] - graph.y.zero) * written_scale(graph, "p") == pytest.approx(2.42322, rel=1e-9)


def test_both_diagrams_of_pressure_share_scale_and_zero():
    sheet = sheets("spark-engine")[0]
    one, other = sheet.graph("indicator"), sheet.graph("developed")
    assert one.y.scale == other.y.scale
    assert one.y.zero == pytest.approx(other.y.zero, abs=1e-9)
    assert np.allclose(one.curve("gas_pressure")[:, 1], other.curve("gas_pressure")[:, 1], atol=1e-9)


def test_brix_and_tolle_stand_under_the_stroke():
    sheet = sheets("spark-engine")[0]
    indicator, brix, tolle = (sheet.graph(name) for name in ("indicator", "brix", "tolle"))
    volumes = indicator.curve("gas_pressure")[:, 0]
    assert brix.x.start == pytest.approx(volumes.min(), abs=1e-6)
    assert brix.x.end == pytest.approx(volumes.max(), abs=1e-6)
    assert (brix.x.end - brix.x.start) * written_scale(brix, "x") == pytest.approx(105.8, rel=1e-9)
    assert tolle.x.zero == pytest.approx(brix.x.start, abs=1e-9)
    area = math.pi / 4 * 10.58**2
    assert indicator.x.scale == pytest.approx(area * written_scale(brix, "x") / 10, rel=1e-9)


@given(st.floats(0.05, 0.4), st.floats(0, 180))
def test_a_ray_of_brix_cuts_off_the_displacement(ratio, degrees):
    """The projection is the textbook displacement and lambda^2/8 r cos phi sin^2 phi, to the fourth power of lambda."""
    found = brix_points(SliderCrank(1.0, 1 / ratio), np.array([degrees]))
    assert np.hypot(found.across, found.up) == pytest.approx(1.0, rel=1e-12)
    sin, cos = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    textbook = float(textbook_displacement(1.0, cos, ratio, math.cos(2 * math.radians(degrees)), 0.0, sin))
    expected = textbook + ratio**2 / 8 * cos * sin**2
    assert 1 - found.up == pytest.approx(expected, abs=ratio**4 / 100)
    assert found.across >= -1e-11


def test_tolle_starts_from_the_accelerations_at_the_dead_centres():
    """r w^2 (1 + lambda) = 0.0529 * 240.855^2 * 1.25 and -r w^2 (1 - lambda); EF = -3 lambda r w^2."""
    corners = tolle_corners(drawn_from(results("spark-engine"), "vi", per_area=False))
    unit = 0.0529 * (math.pi * 2300 / 30) ** 2
    expected = [[0, 1.25 * unit], [105.8 * 1.25 / 2, 0], [105.8 * 1.25 / 2, -0.75 * unit], [105.8, -0.75 * unit]]
    assert np.allclose(corners, expected, rtol=1e-9)


def test_lines_of_tolle_envelop_the_curve():
    """The parabola with the tangents CF and FD comes within 1.5 per cent of the acceleration of two terms."""
    sheet = sheets("spark-engine")[0]
    tolle = sheet.graph("tolle")
    c, _, f, d = (np.array(tolle.point(*one)) for one in
                  tolle_corners(drawn_from(results("spark-engine"), "en", per_area=False)))  # fmt: skip
    t = np.linspace(0, 1, 400)[:, None]
    parabola = (1 - t) ** 2 * c + 2 * t * (1 - t) * f + t**2 * d
    curve = tolle.curve("piston_acceleration")
    apart = np.interp(curve[:, 0], parabola[:, 0], parabola[:, 1]) - curve[:, 1]
    assert np.max(np.abs(apart)) < 0.015 * (c[1] - tolle.y.zero)


@pytest.mark.parametrize("per_area", [False, True])
def test_forces_measured_on_the_sheet_are_the_forces(per_area):
    found = results("spark-engine")
    drawn = drawn_from(found, "en", per_area=per_area)
    sheet = sheets("spark-engine", per_area=per_area)[1]
    keys = {"piston_forces": "piston_force", "rod_forces": "side_force", "crankpin_forces": "tangential_force"}
    for name, key in keys.items():
        graph = sheet.graph(name)
        measured = (graph.curve(key)[:, 1] - graph.y.zero) * written_scale(graph, "F")
        assert np.allclose(measured, drawn.values(key), rtol=0, atol=1e-9 * np.max(np.abs(drawn.values(key))))


def test_mean_torque_is_a_line_at_its_place():
    sheet = sheets("spark-engine")[1]
    graph = sheet.graph("torque")
    line = graph.curve("mean_torque")
    mean = results("spark-engine").summary["mean_torque"]
    assert np.allclose((line[:, 1] - graph.y.zero) * written_scale(graph, "M"), mean, rtol=1e-9)


def test_load_from_the_pole_is_the_unrolled_load():
    """Distances from the shifted pole in the polar diagram are the ordinates of the unrolled one."""
    sheet = sheets("spark-engine")[1]
    polar, unrolled = sheet.graph("polar"), sheet.graph("unrolled")
    assert polar.x.scale == -polar.y.scale
    big_end = 13.76e-3 / 1e-4 * math.pi / 4 * 0.1058**2
    shift = big_end * 0.0529 * (math.pi * 2300 / 30) ** 2
    pole = np.array(polar.point(0.0, shift))
    loads = np.hypot(*(polar.curve("crankpin_load") - pole).T) * written_scale(polar, "F")
    line = unrolled.curve("crankpin_load")
    assert np.allclose((line[:, 1] - unrolled.y.zero) * written_scale(unrolled, "F"), loads, rtol=1e-9)
    dots = [one for one in polar.items if isinstance(one, Circle) and one.kind == "medium"]
    assert dots[0].centre == pytest.approx(tuple(pole), abs=1e-9)


def test_what_is_known_of_the_whole_engine_is_drawn():
    sheet = sheets("spark-engine", extra=EXTRA)[1]
    torque, load, wear = (sheet.graph(name) for name in ("torque", "unrolled", "wear"))
    total = (torque.curve("total_torque")[:, 1] - torque.y.zero) * written_scale(torque, "M")
    assert np.allclose(total, EXTRA["total_torque"], rtol=1e-9)
    mean = (torque.curve("mean_torque")[:, 1] - torque.y.zero) * written_scale(torque, "M")
    assert np.allclose(mean, 100, rtol=1e-6)
    shown = (load.curve("crankpin_load")[:, 1] - load.y.zero) * written_scale(load, "F")
    assert np.allclose(shown, EXTRA["crankpin_load"], rtol=1e-9)
    circle = max((one for one in wear.items if isinstance(one, Circle)), key=lambda one: one.radius)
    depth = circle.radius - np.hypot(*(wear.curve("wear_sums") - circle.centre).T)
    assert depth.max() * written_scale(wear, "ΣR") == pytest.approx(60e3, rel=1e-9)
    assert depth.min() * written_scale(wear, "ΣR") == pytest.approx(10e3, rel=1e-9)
    deepest = wear.curve("wear_sums")[int(np.argmax(depth))] - circle.centre
    assert deepest[1] > 0
    assert deepest[0] == pytest.approx(0, abs=1e-9)


@functools.cache
def known_of(name, step=None):
    """Return whole results and what sheets take of them, with a table of other steps if they are given."""
    found = results(name)
    if step is not None:
        found = analyse(found.machine, CrankGrid.steps(step, found.machine.cycle))
    found = as_engine(found)
    return found, whole_engine_extra(found)


def texts_of(graph):
    return [one.text for one in graph.items if isinstance(one, Text)]


def test_the_sheet_of_the_example_prints_the_mean_load_of_its_note_and_has_its_wear():
    """Mean by midpoints between the corners 8840.27 N; the sums of the wear diagram are those of the listing."""
    found, known = known_of("spark-engine")
    sheet = drawn_sheets(found, "ru", paper=SIGNED, extra=known)[1]
    assert any(one.endswith("8840,27 Н") for one in texts_of(sheet.graph("unrolled")))
    wear = sheet.graph("wear")
    circle = max((one for one in wear.items if isinstance(one, Circle)), key=lambda one: one.radius)
    depth = circle.radius - np.hypot(*(wear.curve("wear_sums") - circle.centre).T)
    largest = found.listings["crankpin_wear"].columns["wear_sum.1"].max()
    assert depth.max() * written_scale(wear, "ΣR") == pytest.approx(largest, rel=1e-9)
    assert "total_torque" not in known


@pytest.mark.parametrize(("name", "rays"), [("radial-five", 3), ("petrol-four", 2)])
def test_the_oil_hole_is_in_the_middle_of_the_rays_that_are_loaded_least(name, rays):
    found, known = known_of(name)
    wear = drawn_sheets(found, "en", paper=SIGNED, extra=known)[1].graph("wear")
    circles = [one for one in wear.items if isinstance(one, Circle)]
    journal, (hole,) = max(circles, key=lambda one: one.radius), [one for one in circles if one.radius == 2.0]
    columns = found.listings["crankpin_wear"].columns
    sums = columns["wear_sum.1"]
    least = columns["wear_ray_angle"][sums <= (1 + 1e-9) * sums.min()]
    assert least.size == rays
    across, up = np.subtract(hole.centre, journal.centre)
    assert math.atan2(across, up) == pytest.approx(least.mean(), abs=1e-9)


@pytest.mark.parametrize(("name", "rods", "pins"), [("v8-diesel", 2, 2), ("radial-five", 5, 1), ("petrol-four", 1, 1)])
def test_the_polar_diagram_shows_all_rods_of_the_crankpin(name, rods, pins):
    """From the pole, every point is as far as the unrolled load is high, whose mean the note prints."""
    found, known = known_of(name)
    sheet = drawn_sheets(found, "en", paper=SIGNED, extra=known)[1]
    polar, unrolled = sheet.graph("polar"), sheet.graph("unrolled")
    assert known["crankpin_rods"] == rods
    masses, solved = found.machine.masses, found.solved
    shift = rods * masses.rod_big_end * solved.lengths.crank_radius * solved.speed**2
    pole = np.array(polar.point(0.0, shift))
    loads = np.hypot(*(polar.curve("crankpin_load") - pole).T) * written_scale(polar, "F")
    line = (unrolled.curve("crankpin_load")[:, 1] - unrolled.y.zero) * written_scale(unrolled, "F")
    assert np.allclose(line, loads, rtol=1e-9, atol=1e-9 * loads.max())
    mean = found.summary["mean_crankpin_load" + (".1" if pins > 1 else "")]
    assert np.trapezoid(line, known["crank_angle"]) / np.ptp(known["crank_angle"]) == pytest.approx(mean, rel=2e-3)
    for graph in (polar, unrolled, sheet.graph("wear")):
        assert any(one.endswith("crankpin 1") for one in texts_of(graph)) == (pins > 1)


@pytest.mark.parametrize("name", ["petrol-four", "two-stroke"])
def test_sheets_do_not_depend_on_the_step_of_the_table(name):
    (_, one), (_, other) = known_of(name), known_of(name, 45.0)
    assert one.keys() == other.keys()
    assert len(one["crank_angle"]) > 300
    for key, values in one.items():
        assert np.allclose(values, other[key], rtol=1e-12, atol=1e-9 * np.max(np.abs(values))), key


def test_nothing_is_known_of_an_engine_without_forces():
    assert known_of("slider-crank")[1] == {}


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", ["spark-engine", "v8-diesel", "radial-five"])
def test_whole_engines_have_room(name, language):
    found, known = known_of(name)
    for sheet in drawn_sheets(found, language, paper=SIGNED, extra=known):
        for graph in sheet.graphs:
            for item in graph.items:
                assert within(extent(item), graph.box), (graph.name, item)


@pytest.mark.parametrize(
    "extra",
    [{"total_torque": np.ones(5), "crank_angle": np.ones(4)}, {"wear_sums": np.ones(2)}, {"wear_sums": np.zeros(8)}],
)
def test_arrays_that_do_not_fit_are_refused(extra):
    with pytest.raises(CrankworkError, match="give"):
        sheets("spark-engine", extra=extra)


def test_lengths_of_the_position_plans_are_to_scale():
    """The press of the example has a crank of 50 mm, a rod of 600 mm; its punch runs on a line at 10.4 degrees."""
    sheet = sheets("press-geometry", "ru")[0]
    graph = sheet.graph("position_plans")
    scale = written_scale(graph, "l")
    path = graph.curve("path.A")
    pivot = path.mean(axis=0)
    radii = np.hypot(*(path[:-1] - path[:-1].mean(axis=0)).T) * scale
    assert np.allclose(radii, 0.05, rtol=1e-9)
    rods = [one.points for one in graph.items if isinstance(one, Polyline) and len(one.points) == 2]
    lengths = np.array([np.hypot(*(one[1] - one[0])) * scale for one in rods])
    assert np.sum(np.abs(lengths - 0.6) < 1e-9) == 12
    assert graph.box.left < pivot[0] < graph.box.right


def test_velocities_measured_on_the_plans_are_the_velocities():
    """v_A = 14.65 rad/s * 50 mm at every position; that of the punch is in the table of results."""
    found = results("press-geometry")
    sheet = sheets("press-geometry")[0]
    heads = [one.text for one in sheet.more if isinstance(one, Text) and one.text.startswith("μ_{v}")]
    scale = float(heads[0].split(" = ")[1].split()[0])
    punch = found.columns["slider_velocity.punch"]
    for position, speed in enumerate(punch[:12]):
        graph = sheet.graph(f"velocity_plans.{position}")
        crank = graph.curve("A")
        assert np.hypot(*(crank[1] - crank[0])) * scale == pytest.approx(14.65 * 0.05, rel=1e-9)
        driven = graph.curve("D")
        assert np.hypot(*(driven[1] - driven[0])) * scale == pytest.approx(abs(speed), abs=1e-9)


def test_tangents_of_the_energy_diagram_cut_off_the_flywheel():
    """J = mu_T kl / (tan psi_max - tan psi_min), all of it read from the sheet."""
    found = results("flywheel")
    graph = sheets("flywheel")[1].graph("wittenbauer")
    per_mm = written_scale(graph, "E") if graph.y.mark == "E" else written_scale(graph, graph.y.mark)
    inertia = written_scale(graph, graph.x.mark)
    lines = [graph.curve(f"tangent_{name}") for name in ("max", "min")]
    cut = (lines[0][0, 1] - lines[1][0, 1]) * per_mm
    slopes = [(one[1, 1] - one[0, 1]) * per_mm / ((one[1, 0] - one[0, 0]) * inertia) for one in lines]
    expected = found.summary["flywheel_inertia.wittenbauer"]
    assert cut / (slopes[0] - slopes[1]) == pytest.approx(expected, rel=2e-3)
    speed = found.summary["speed"]
    assert slopes == pytest.approx([speed**2 / 2 * 1.04, speed**2 / 2 * 0.96], rel=1e-6)


def test_a_table_of_positions_gives_the_dynamics_only():
    (sheet,) = sheets("press")
    graph = sheet.graph("torques")
    line = graph.curve("driving_torque")
    expected = results("press").columns["driving_torque"]
    measured = (line[:, 1] - graph.y.zero) * written_scale(graph, "M")
    assert np.allclose(measured, [*expected, expected[0]], rtol=0, atol=1e-9 * np.max(np.abs(expected)))


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", ALL)
def test_scales_are_round(name, language):
    for sheet in sheets(name, language):
        for graph in sheet.graphs:
            axes = (graph.y,) if graph.name == "indicator" else (graph.x, graph.y)
            for axis in axes:
                mantissa = float(f"{abs(axis.scale):.9e}".partition("e")[0])
                assert min(abs(mantissa - one) for one in ROUND) < 1e-6, (graph.name, axis)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", ALL)
def test_everything_has_room(name, language, size):
    """Graphs stay in their boxes, the boxes in the frame, and neither touches another one or the title block."""
    paper = SIGNED._replace(size=size)
    options = {"extra": EXTRA} if name == "spark-engine" else {}
    for sheet in sheets(name, language, paper, **options):
        for graph in sheet.graphs:
            for item in graph.items:
                assert within(extent(item), graph.box), (graph.name, item)
            assert within(graph.box, paper.frame)
        boxes = [*(one.box for one in sheet.graphs), paper.reserved]
        for one, other in itertools.combinations(boxes, 2):
            assert not overlap(one, other)
        corner = Box(paper.frame.left, paper.frame.top - 14, 70, 14)
        texts = [one for graph in sheet.graphs for one in graph.items if isinstance(one, Text)]
        for text in [*texts, *(one for one in sheet.more if isinstance(one, Text))]:
            assert not overlap(extent(text), corner), text
            assert not overlap(extent(text), paper.reserved), text
            assert within(extent(text), paper.frame), text


@pytest.mark.parametrize("offset", ["0 mm", "5 mm"])
@pytest.mark.parametrize(("radius", "length", "ratio"), [(12, 40, 22), (33, 110, 5), (420, 1700, 14)])
def test_engines_of_any_size_have_room(radius, length, ratio, offset):
    text = template("engine").replace('radius = "45 mm"', f'radius = "{radius} mm"')
    text = text.replace('length = "160 mm"', f'length = "{length} mm"').replace(
        "compression_ratio = 9.0", f"compression_ratio = {ratio}"
    )
    found = analyse(read_machine(text.replace('# offset = "0 mm"', f'offset = "{offset}"')))
    assert found.machine.cylinder is not None
    for sheet in drawn_sheets(found, "vi", paper=SIGNED):
        for graph in sheet.graphs:
            assert all(within(extent(item), graph.box) for item in graph.items), graph.name
        names = {one.name for one in sheet.graphs}
        assert ("brix" in names) == ("tolle" in names) == (sheet.name == "engine-motion" and offset == "0 mm")


def within(box, other, spare=1e-6):
    return (
        box.left >= other.left - spare
        and box.bottom >= other.bottom - spare
        and box.right <= other.right + spare
        and box.top <= other.top + spare
    )


def overlap(one, other, spare=1e-6):
    return (
        one.left < other.right - spare
        and other.left < one.right - spare
        and one.bottom < other.top - spare
        and other.bottom < one.top - spare
    )


@pytest.mark.parametrize("name", ["spark-engine", "press-geometry"])
def test_titles_scales_and_data_do_not_run_into_each_other(name):
    for language in LANGUAGES:
        for sheet in sheets(name, language):
            for graph in sheet.graphs:
                texts = [one for one in graph.items if isinstance(one, Text) and one.height >= 3.5 and not one.angle]
                for one, other in itertools.combinations(texts, 2):
                    assert not overlap(extent(one), extent(other), 0.3), (graph.name, one.text, other.text)


def test_title_block_has_the_size_of_the_form():
    """GOST 2.104, form 1: 185 x 55 mm in the lower right corner of a frame 20 mm from the left edge, 5 mm elsewhere."""
    (first, second) = sheets("spark-engine", "ru")
    assert SIGNED.reserved == Box(841 - 5 - 185, 5, 185, 55)
    assert SIGNED.frame == Box(20, 5, 816, 584)
    texts = [one.text for one in first.items if isinstance(one, Text)]
    assert {"Изм.", "Разраб.", "Nguyễn Văn Đức", "КП.01.02.000", "Лист 1", "Листов 2", "МГТУ"} <= set(texts)
    assert "Лист 2" in [one.text for one in second.items if isinstance(one, Text)]
    for item in first.items[-60:]:
        if isinstance(item, Text) and item.place[1] < 60 and item.place[0] > 651:
            assert within(extent(item), SIGNED.reserved), item


def test_paper_without_frame_and_block_has_graphs_alone():
    plain = sheets("press", paper=Paper(has_frame=False))[0]
    assert len(plain.items) == sum(len(one.items) for one in plain.graphs)
    grid = sheets("press", paper=Paper(has_frame=False, has_grid=True))[0]
    assert len(grid.items) - len(plain.items) == 817 + 585


def test_other_paper_and_results_without_material_are_refused():
    with pytest.raises(CrankworkError, match="take A1 or A0"):
        sheets("spark-engine", paper=Paper(size="A7"))
    with pytest.raises(CrankworkError, match="sheets need the motion of a piston, a drawn linkage or torques"):
        drawn_sheets(replace(results("press"), columns={}))
    with pytest.raises(CrankworkError, match="there is no graph brix"):
        sheets("spark-engine")[1].graph("brix")


@given(st.lists(st.tuples(st.floats(30, 170), st.floats(30, 170)), min_size=1, max_size=6))
def test_names_never_cover_each_other(places):
    points = [Named(f"n{i}", place) for i, place in enumerate(places)]
    texts = [one for one in names_beside(points, [], Box(0, 0, 200, 200)) if isinstance(one, Text)]
    for one, other in itertools.combinations(texts, 2):
        assert not overlap(extent(one), extent(other), 0.8)


@given(st.floats(3, 30), st.floats(1, 5))
def test_a_hatch_stays_in_its_polygon_and_fills_it(size, spacing):
    """The lengths of strokes times their distance approach the area of a triangle."""
    triangle = np.array([[0.0, 0.0], [10 * size, 0.0], [0.0, 10 * size]])
    strokes = hatch_lines(Hatch(triangle, spacing))
    for one in strokes:
        assert np.all(one >= -1e-9)
        assert np.all(one.sum(axis=1) <= 10 * size + 1e-9)
        assert one[1, 0] - one[0, 0] == pytest.approx(one[1, 1] - one[0, 1], abs=1e-9)
    area = spacing * sum(np.hypot(*(one[1] - one[0])) for one in strokes)
    assert area == pytest.approx(50 * size**2, abs=12 * size * spacing + spacing**2)


def test_vectors_to_one_scale_fit_their_cells():
    ends = [np.array([3.0, 4.0]), np.array([-1.0, 0.5])]
    plans = [
        Numbered(i, Plan({"A": end}, [Vector("A", "absolute", np.zeros(2), end)], {}, {})) for i, end in enumerate(ends)
    ]
    graphs, heads = vector_plans("velocity_plans", plans, Box(0, 0, 200, 100), 2, Words("vi"))
    assert heads[0].text == "Họa đồ vận tốc"
    assert graphs[0].x.scale == graphs[1].x.scale
    line = graphs[0].curve("A")
    assert (line[1] - line[0]) * graphs[0].x.scale == pytest.approx([3.0, 4.0], rel=1e-12)


def test_words_print_scales_as_their_language_does():
    assert Words("ru").scale("v", 0.025, "m/s") == "μ_{v} = 0,025 (м/с)/мм"
    assert Words("vi").scale("p", from_si(20e3, "MPa"), "MPa") == "μ_{p} = 0,02 MPa/mm"
    assert Words("en").scale("δ", 0.001, "") == "μ_{δ} = 0.001 mm⁻¹"
    assert Words("en").number(2.5e-7) == "2.5·10^{−7}"
    assert text_width("M_{кр}") < text_width("Mкр")
