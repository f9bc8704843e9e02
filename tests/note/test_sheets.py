"""Drawing sheets: what is measured on paper times the scale written there is the result, and everything has room."""

from __future__ import annotations

import functools
import io
import math
import re
from dataclasses import replace
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.analysis import analyse
from crankwork.analysis.diagrams import brix_points
from crankwork.analysis.whole_engine import as_engine
from crankwork.description.machine_file import read, read_machine, template
from crankwork.errors import CrankworkError
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.kinematics.textbook import textbook_displacement
from crankwork.note.sheets import Paper, TitleBlock, drawn_sheets
from crankwork.note.sheets.packing import Picture
from crankwork.note.sheets.sheet import SIZES, sheets_with
from crankwork.note.sheets.table import text_block
from crankwork.quantities import LANGUAGES
from crankwork.report.engine_figure_data import engine_drawn
from crankwork.report.figures import drawings
from crankwork.show.dxf import dxf
from crankwork.show.place import FINE, round_scale
from crankwork.show.scene import Box, Hatch, Polyline, Text, extent, hatch_lines, text_width
from looks import Fault, box_of, faults

EXAMPLES = Path(__file__).parents[2] / "examples"
HEIGHTS = {2.5, 3.5, 5.0, 7.0, 10.0}
NAMED = TitleBlock(
    form="ru", designation="КП.01.02.000", author="Nguyễn Văn Đức", institution="МГТУ", group="РК2-41Б",
    supervisor="Щербаков Ю. Ё.", subject="Курсовой проект по теории механизмов и машин",
)  # fmt: skip
SIGNED = Paper(block=NAMED)
# those of which there is nothing that a sheet shows
WITHOUT = {"punching-machine"}
# of every kind one, in the languages whose words are shorter
SOME = ("petrol-four", "v8-diesel", "press-geometry", "excavator-boom", "press", "flywheel")
ALL = [*sorted(one.stem for one in EXAMPLES.glob("*.toml") if one.stem not in WITHOUT), "flywheel", "whitworth"]


OVER_CYCLE = ("pressure", "piston_forces", "rod_forces", "crankpin_forces", "torque")
EACH = [*((name, "ru") for name in ALL), *((name, language) for name in SOME for language in ("en", "vi"))]


# the leader of position 9 of the crank goes by the R that stands at the same pin
LEFT = {("andrews-squeezer", "ru", "linkage-kinematics"): [Fault("crossed", "/{R}")]}


@functools.cache
def results(name):
    if name == "flywheel":
        text = template("toggle-press").replace("[table]", "[flywheel]\nfluctuation = 0.04\n[table]")
        return as_engine(analyse(read_machine(text)))
    path = EXAMPLES / f"{name}.toml"
    return as_engine(analyse(read(path) if path.exists() else read_machine(template(name))))


@functools.cache
def sheets(name, language="en", paper=SIGNED, **options):
    return drawn_sheets(results(name), language, paper=paper, **options)


def written_scale(drawing, symbol):
    """Return the number of a scale as it stands on the sheet."""
    texts = [one.text for one in drawing.items if isinstance(one, Text)]
    found = re.search(rf"μ_\{{{re.escape(symbol)}\}} = ([\d.,]+)", "\n".join(texts))
    assert found, texts
    return float(found[1].replace(",", "."))


def line_of(drawing, key):
    (found,) = [one.points for one in drawing.items if isinstance(one, Polyline) and one.name == key]
    return found


def zero(plot, axis):
    """Return where the value 0 of an axis of a graph is. [mm]"""
    start, length = (plot.box.left, plot.box.width) if axis == "x" else (plot.box.bottom, plot.box.height)
    low, high = getattr(plot, axis)
    return start + length * (0 - low) / (high - low)


def test_pressure_measured_on_the_sheet_is_the_pressure():
    """The note of the example prints 5.083 MPa at 365 and 370 degrees and 2.42322 MPa at 360."""
    sheet = sheets("spark-engine", "ru")[0]
    for name in ("indicator", "pressure"):
        drawing = sheet.figure(name).drawing
        line, scale = line_of(drawing, "gas_pressure"), written_scale(drawing, "p")
        assert np.max(line[:, 1] - zero(drawing.plots[0], "y")) * scale == pytest.approx(5.083, rel=1e-9)
    angles = (line[:, 0] - zero(drawing.plots[0], "x")) * written_scale(drawing, "φ")
    assert angles[-1] == pytest.approx(720, rel=1e-12)
    at = int(np.argmin(np.abs(angles - 360)))
    assert (line[at, 1] - zero(drawing.plots[0], "y")) * scale == pytest.approx(2.42322, rel=1e-9)


def test_the_angle_of_a_cycle_is_drawn_to_two_or_four_degrees_a_millimetre():
    for at in (0, 1):
        drawn = [one for one in sheets("spark-engine", "ru")[at].figures if one.name in OVER_CYCLE]
        assert len(drawn) >= 1
        for figure in drawn:
            assert written_scale(figure.drawing, "φ") in (2, 4)


@pytest.mark.parametrize("per_area", [False, True])
def test_forces_measured_on_the_sheet_are_the_forces(per_area):
    drawn = engine_drawn(results("spark-engine"), "en", per_area=per_area)
    sheet = sheets("spark-engine", per_area=per_area)[1]
    for name, key, sign in (("piston_forces", "piston_force", "F"), ("rod_forces", "side_force", "F")):
        drawing = sheet.figure(name).drawing
        unit = 1.0 if per_area else 1e3  # kN
        measured = (line_of(drawing, key)[:, 1] - zero(drawing.plots[0], "y")) * written_scale(drawing, sign) * unit
        assert np.allclose(measured, drawn.values(key), rtol=0, atol=1e-9 * np.max(np.abs(drawn.values(key))))


def test_velocities_measured_on_the_plans_are_the_velocities():
    """The crank pin of the press runs at 14.65 rad/s on 50 mm in every plan, whatever its scale."""
    drawing = sheets("press-geometry")[0].figure("velocity_plans").drawing
    texts = [one for one in drawing.items if isinstance(one, Text) and one.text.startswith("position")]
    assert len(texts) == 12
    scales = {float(re.search(r"= ([\d.]+)", one.text)[1]) for one in texts}
    lengths = [np.hypot(*np.ptp(one.points, axis=0)) for one in drawing.items if isinstance(one, Polyline)]
    for scale in scales:
        assert round_scale(scale, FINE) == scale
        # the shaft of an arrow ends where its head begins
        assert any(abs(length * scale - 14.65 * 0.05) < 0.08 for length in lengths)


@pytest.mark.parametrize(("name", "language"), EACH)
def test_scales_are_round_and_as_they_are_written(name, language):
    for sheet in sheets(name, language):
        for figure in sheet.figures:
            for plot in figure.drawing.plots:
                for axis, length in (("x", plot.box.width), ("y", plot.box.height)):
                    if plot.titles.get(axis):
                        low, high = getattr(plot, axis)
                        scale = abs(high - low) / length
                        assert round_scale(scale) == pytest.approx(scale, rel=1e-6), (figure.name, axis)


def cells(drawing, head):
    """Return what stands in the column of a table under a heading, from above."""
    texts = [one for one in drawing.items if isinstance(one, Text)]
    (top,) = [one for one in texts if one.text == head]
    under = [one for one in texts if abs(one.place[0] - top.place[0]) < 1e-6 and one.place[1] < top.place[1]]
    return [one.text.replace("−", "-") for one in sorted(under, key=lambda one: -one.place[1])]


def test_what_a_linkage_is_made_of_stands_on_its_first_sheet():
    """Structure, mobility, speed and method: five links, seven pairs, 139.9 rpm."""
    drawing = sheets("press-geometry")[0].figure("structure").drawing
    said = " ".join(one.text for one in drawing.items if isinstance(one, Text))
    for one in (
        "= 3·5 − 2·7 = 1",
        "I(0,1) → II(2,3) → II(4,5)",
        "class: II",
        "139.897 rpm",
        "14.65 rad/s",
        "method: exact",
    ):
        assert one in said


def test_tables_of_motion_and_reactions_hold_the_columns():
    found = results("press-geometry")
    known = found.columns_at(np.arange(0.0, 360.0, 30.0))
    motion, forces = sheets("press-geometry")[1], sheets("press-geometry")[2]
    for figure, head, key in (
        (motion.figure("velocities"), "/{v}_{D}, m/s", "point_velocity.D"),
        (motion.figure("velocities"), "/{ω}_{3}, rad/s", "link_angular_velocity.rocker"),
        (motion.figure("accelerations"), "/{α}_{2}, rad/s²", "link_angular_acceleration.rod"),
        (motion.figure("accelerations"), "/{a}_{B}, m/s²", "point_acceleration.B"),
        (forces.figure("reactions"), "/{R}_{C}, N", "joint_force.C"),
        (forces.figure("reactions"), "/{M}_{b}, N·m", "balancing_torque"),
    ):
        shown = [float(one) for one in cells(figure.drawing, head)]
        assert shown == pytest.approx(known[key], abs=6e-4 * np.max(np.abs(known[key])))


@pytest.mark.parametrize("name", ["press-geometry", "andrews-squeezer", "excavator-boom"])
def test_plans_are_measured_in_the_scale_that_is_written_under_them(name):
    """The table repeats the scales of the plans; a length read there, times the scale, is the velocity to 0.05 mm."""
    sheet = sheets(name)[0]
    scales = [one.text for one in sheet.figure("scales").drawing.items if isinstance(one, Text)]
    for kind, sign in (("velocity_plans", "v"), ("acceleration_plans", "a")):
        for one in sheet.figure(kind).drawing.items:
            if isinstance(one, Text) and (found := re.match(r"position (\d+): /{μ}_{.} = ([\d.]+)", one.text)):
                assert cells(sheet.figure("scales").drawing, found[1])["va".index(sign)] == found[2]
    assert "/{μ}_{v}, (m/s)/mm" in scales
    table = sheet.figure("compared").drawing
    positions = cells(table, "pos.")
    for sign, unit in (("v", "m/s"), ("a", "m/s²")):
        heads = (f"/{{{sign}}} on the plan, mm", f"/{{{sign}}} graphic, {unit}", f"/{{{sign}}} analytic, {unit}")
        lengths, drawn, exact = ([float(one) for one in cells(table, head)] for head in heads)
        for position, length, one, other in zip(positions, lengths, drawn, exact, strict=True):
            scale = float(cells(sheet.figure("scales").drawing, position)["va".index(sign)])
            assert length * scale == pytest.approx(one, abs=1e-3 * max(exact))
            assert one == pytest.approx(other, abs=0.05 * scale + 1e-3 * max(exact))


def corners(text, wider):
    """Return what a text covers, set in letters that are wider: left, bottom, right, top. [mm]"""
    box = extent(replace_at_zero(text))
    left = {"start": 0.0, "middle": -wider * box.width / 2, "end": -wider * box.width}[text.anchor]
    turn = np.radians(text.angle)
    points = np.array([[x, y] for x in (left, left + wider * box.width) for y in (0.0, text.height)])
    points = points @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]) + text.place
    return np.concatenate([points.min(axis=0), points.max(axis=0)])


def replace_at_zero(text):
    return text._replace(place=(0.0, 0.0), angle=0.0)


def clashes(texts, wider):
    boxes = np.array([corners(one, wider) for one in texts])
    apart = 0.3
    over = (
        (boxes[:, None, 0] < boxes[None, :, 2] - apart)
        & (boxes[None, :, 0] < boxes[:, None, 2] - apart)
        & (boxes[:, None, 1] < boxes[None, :, 3] - apart)
        & (boxes[None, :, 1] < boxes[:, None, 3] - apart)
    )
    return [(texts[i].text, texts[j].text) for i, j in np.argwhere(over) if i < j]


@pytest.mark.parametrize(("name", "language"), EACH)
def test_everything_has_room(name, language):
    """Texts of the standard heights; in wider letters too none leaves the frame, meets another or a line."""
    for sheet in sheets(name, language):
        frame = sheet.paper.frame
        assert {round(one.height, 9) for one in sheet.items if isinstance(one, Text)} <= HEIGHTS
        assert faults(sheet.drawing) == LEFT.get((name, language, sheet.name), []), sheet.name
        assert [one.text for one in sheet.items if isinstance(one, Text) and not within(box_of(one), frame)] == []
        for one in sheet.figures:
            assert within(one.ink, frame)
            assert not overlap(one.ink, sheet.paper.reserved)


@pytest.mark.parametrize(("name", "language"), EACH)
def test_polar_diagrams_end_within_their_frames(name, language):
    """The load and the circle of its mean are whole, and in the frame."""
    for sheet in sheets(name, language):
        for plot in [plot for one in sheet.figures for plot in one.drawing.plots if "pole" in plot.curves]:
            for key in plot.curves.keys() & {"load", "mean"}:
                x, y = plot.curves[key]
                assert np.hypot(x[-1] - x[0], y[-1] - y[0]) < 1e-9 * abs(plot.y[1] - plot.y[0])
                for values, ends in ((x, plot.x), (y, plot.y)):
                    assert min(ends) <= values.min() <= values.max() <= max(ends), key


@pytest.mark.parametrize("name", ALL)
def test_sheets_are_filled(name):
    for sheet in sheets(name, "ru"):
        # plans of one scale leave room beside those that are small
        least = {1: 0.25, 2: 0.25, 3: 0.55}.get(len(sheet.figures), 0.55 if sheet.name == "linkage-kinematics" else 0.6)
        field, block = sheet.paper.frame, sheet.paper.reserved
        covered = sum(one.ink.width * one.ink.height for one in sheet.figures)
        filled = covered / (field.width * field.height - block.width * block.height)
        assert filled > least, (sheet.name, round(filled, 3))


@pytest.mark.parametrize("name", ALL)
def test_every_sheet_is_a_sound_dxf(name):
    for sheet in sheets(name, "ru"):
        document = ezdxf.read(io.StringIO(dxf(sheet.drawing).decode()))
        assert document.audit().errors == []
        texts = [one for one in sheet.items if isinstance(one, Text)]
        space = document.modelspace()
        assert len(space.query("TEXT MTEXT")) == len(texts)
        heights = {one.dxf.height for one in space.query("TEXT")}
        heights |= {one.dxf.char_height for one in space.query("MTEXT")}
        # GOST 2.304, ISO 3098
        assert {round(one, 6) for one in heights} <= {2.5, 3.5, 5.0, 7.0, 10.0, 14.0, 20.0}


def test_the_pressure_of_the_surroundings_is_named_at_the_end_of_its_line():
    drawing = sheets("petrol-four", "ru")[0].figure("indicator").drawing
    inset = drawing.plots[1].box
    (place,) = (one.place for one in drawing.items if isinstance(one, Text) and one.text == "/{p}_{0}")
    assert place[0] == pytest.approx(inset.left + inset.width)


def test_what_is_read_at_a_defence_is_as_large_as_that():
    for sheet in sheets("petrol-four", "ru"):
        for figure in sheet.figures:
            for one in figure.drawing.items:
                if isinstance(one, Text) and ("μ" in one.text or one.angle):
                    assert one.height >= 3.5 - 1e-9, one


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


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", ["petrol-four", "press-geometry"])
def test_every_format_takes_every_figure(name, size):
    def names(one):
        return [figure.name for sheet in one for figure in sheet.figures]

    found = sheets(name, "ru", SIGNED._replace(size=size))
    assert names(found) == names(sheets(name, "ru"))
    for sheet in found:
        assert all(within(one.ink, sheet.paper.frame) for one in sheet.figures)
        assert clashes([one for one in sheet.items if isinstance(one, Text)], 1.0) == []
    if size == "A3":
        assert len(found) > len(sheets(name, "ru"))


@pytest.mark.parametrize(("radius", "length", "ratio"), [(12, 40, 22), (33, 110, 5), (420, 1700, 14)])
def test_engines_of_any_size_have_room(radius, length, ratio):
    text = template("engine").replace('radius = "45 mm"', f'radius = "{radius} mm"')
    text = text.replace('length = "160 mm"', f'length = "{length} mm"').replace(
        "compression_ratio = 9.0", f"compression_ratio = {ratio}"
    )
    for sheet in drawn_sheets(analyse(read_machine(text)), "vi", paper=SIGNED):
        assert clashes([one for one in sheet.items if isinstance(one, Text)], 1.0) == []


def test_form_1_of_gost_has_its_size_and_its_cells():
    """GOST 2.104, form 1: 185 x 55 mm in the lower right corner of a frame 20 mm from the left edge, 5 mm elsewhere."""
    first, second = sheets("spark-engine", "ru")[:2]
    assert SIGNED.reserved == Box(841 - 5 - 185, 5, 185, 55)
    assert SIGNED.frame == Box(20, 5, 816, 584)
    texts = [one.text for one in first.items if isinstance(one, Text)]
    assert {"Изм.", "Разраб.", "Nguyễn Văn Đức", "Щербаков Ю. Ё.", "КП.01.02.000", "Лист 1"} <= set(texts)
    assert "Лист 2" in [one.text for one in second.items if isinstance(one, Text)]
    # once in the block, and once upside down in the corner
    turned = [one for one in first.items if isinstance(one, Text) and one.text == "КП.01.02.000"]
    assert sorted(one.angle for one in turned) == [0, 180]


FIELDS = [name for name in TitleBlock._fields if name not in ("form", "sheet", "sheets", "title_height")]
LONG = (
    "Кафедра «Теория механизмов и машин» факультета робототехники и комплексной автоматизации Московского "
    "государственного технического университета. Bộ môn Động cơ đốt trong, Khoa Cơ khí Giao thông, Trường Đại học "
    "Bách khoa, Đại học Đà Nẵng. Lehrstuhl für Verbrennungskraftmaschinen und Thermodynamik der Hochschule in Aachen"
)[:300]


@pytest.mark.parametrize("form", LANGUAGES)
@pytest.mark.parametrize("text", ["", LONG, "X" * 300, "Ж" * 40], ids=["named", "long", "one word", "wide"])
def test_a_title_block_says_what_the_document_is_in_its_cells(form, text):
    """Everything that a cell says stays within it, clear of its label, in letters a tenth wider too."""
    block = NAMED._replace(form=form, department="Кафедра РК-2 «Теория механизмов и машин»", approved_by="X" * 90)
    if text:
        block = block._replace(**dict.fromkeys(FIELDS, text))
    (sheet,) = drawn_sheets(results("press"), form, paper=Paper(block=block))
    room = sheet.paper.reserved
    inside = [one for one in sheet.items if isinstance(one, Text) and overlap(extent(one), room)]
    assert clashes(inside, 1.1) == []
    sides = [one.points for one in sheet.items if isinstance(one, Polyline) and one.closed and len(one.points) == 4]
    cells = [Box(*one.min(axis=0), *np.ptp(one, axis=0)) for one in sides]
    for one in inside:
        box = Box(*corners(one, 1.1)[:2], *(corners(one, 1.1)[2:] - corners(one, 1.1)[:2]))
        assert within(box, room), one
        # what holds its middle holds all of it
        x, y = box.left + box.width / 2, box.bottom + box.height / 2
        around = [cell for cell in cells if within(Box(x, y, 0, 0), cell) and within(cell, room)]
        assert within(box, min(around, key=lambda cell: cell.width * cell.height), 0.3), one
    said = " ".join(one.text for one in inside)
    if text == LONG:
        assert said.count("Кафедра") >= 6
        assert "…" in said
    if not text:
        for one in ("Nguyễn Văn Đức", "Щербаков Ю. Ё.", "МГТУ", "РК2-41Б", "КП.01.02.000"):
            assert one in said


def test_sheets_are_in_the_units_of_the_figures():
    """Forces of a large engine in kN, of a small one in N; of a machine in pounds and feet in these."""
    units = {}
    text = template("engine").replace("title = ", 'units = "imperial"\ntitle = ', 1)
    for name, found in (("v8-diesel", results("v8-diesel")), ("compressor", results("compressor")),
                        ("imperial", analyse(read_machine(text)))):  # fmt: skip
        drawn = {one.name: one for sheet in drawn_sheets(found) for one in sheet.figures}["rod_forces"].drawing
        own = drawings(found)["rod_forces"]
        titles = {plot.titles["y"] for plot in (*drawn.plots, *own.plots)}
        assert len(titles) == 1, titles
        units[name] = titles.pop().rpartition(", ")[2]
    assert units == {"v8-diesel": "kN", "compressor": "N", "imperial": "lbf"}


def test_paper_without_frame_and_block_has_figures_alone():
    plain = sheets("press", paper=Paper(has_frame=False))[0]
    assert len(plain.items) == sum(len(one.drawing.items) for one in plain.figures)
    grid = sheets("press", paper=Paper(has_frame=False, has_grid=True))[0]
    assert len(grid.items) - len(plain.items) == 817 + 585


def test_graphs_stand_on_the_lines_of_millimetre_paper():
    for figure in sheets("petrol-four", "ru")[1].figures:
        box = figure.drawing.plots[0].box
        assert (box.left - round(box.left), box.bottom - round(box.bottom)) == pytest.approx((0, 0), abs=1e-6)


def test_other_paper_and_results_without_material_are_refused():
    with pytest.raises(CrankworkError, match="take A0, A1, A2, A3"):
        sheets("spark-engine", paper=Paper(size="A7"))
    with pytest.raises(CrankworkError, match="sheets need the motion of a piston, a drawn linkage or torques"):
        drawn_sheets(replace(results("press"), columns={}))
    with pytest.raises(CrankworkError, match="there is no figure brix"):
        sheets("spark-engine")[1].figure("brix")


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


def test_an_index_is_narrower_than_letters():
    assert text_width("M_{кр}") < text_width("Mкр")


@pytest.mark.parametrize("size", ["A2", "A3"])
def test_what_has_no_room_on_a_paper_is_named(size):
    """A figure with more letters than a small sheet has room for says so in its place."""
    tall, small = (
        functools.partial(text_block, [str(one) * 400 for one in range(count)], "words", "en") for count in (300, 2)
    )
    pictures = [Picture("small", small), Picture("tall", tall)]
    found = list(sheets_with("s", "t", pictures, SIGNED._replace(size=size), "en"))
    assert [one.name for sheet in found for one in sheet.figures] == ["small", "tall"]
    said = [one.text for sheet in found for one in sheet.items if isinstance(one, Text)]
    assert f"words: no room on {size}; take larger paper" in said


@pytest.mark.parametrize("name", ["v8-diesel", "narrow-v6", "petrol-four", "spark-engine"])
def test_no_diagram_of_an_engine_is_left_small(name):
    """Polar diagrams of unlike pins are of one size, wear is read on 50 mm at least, the loop of gas exchange seen."""
    figures = {one.name: one.drawing for sheet in sheets(name, "ru") for one in sheet.figures}
    polars = [one.plots[0] for key, one in figures.items() if key.startswith("crankpin_polar")]
    scales = [(plot.x[1] - plot.x[0]) / plot.box.width for plot in polars]
    assert max(scales) <= 2.5 * min(scales)
    assert min(plot.box.height for plot in polars) > 60
    rings = [one for one in figures["crankpin_wear"].items if getattr(one, "name", "") == "journal"]
    assert min(np.ptp(one.points[:, 0]) for one in rings) > 50
    graph, *inset = figures["indicator"].plots
    assert graph.box.height > 80
    assert len(inset) == 1


def test_no_sheet_of_a_linkage_has_one_or_two_figures():
    for name in ("excavator-boom", "knuckle-press", "parallelogram", "opposed-pistons"):
        assert min(len(one.figures) for one in sheets(name, "ru")) > 2, name


def test_plans_say_whether_they_share_a_scale():
    """Those of a linkage whose crank pin alone is fast, and those of one whose points all go round."""
    for name in ("opposed-pistons", "beta-stirling", "parallelogram"):
        for sign, figure in (("v", "velocity_plans"), ("a", "acceleration_plans")):
            drawing = sheets(name, "en")[0].figure(figure).drawing
            texts = [one.text for one in drawing.items if isinstance(one, Text)]
            found = {one[1] for text in texts if (one := re.search(rf"/{{μ}}_{{{sign}}} = ([\d.]+)", text))}
            assert found
            assert ("scales differ from plan to plan" in texts) == (len(found) > 1), (name, figure)
