"""Drawing sheets: what is measured on paper times the scale written there is the result, and everything has room."""

from __future__ import annotations

import functools
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crankwork.analysis import analyse
from crankwork.analysis.constructions import brix_points
from crankwork.description.machine_file import read_machine, template
from crankwork.errors import CrankworkError, InputError
from crankwork.kinematics.piston import textbook_displacement
from crankwork.kinematics.slider_crank import SliderCrank
from crankwork.note.sheets import Paper, drawn_sheets
from crankwork.note.sheets.packing import Picture
from crankwork.note.sheets.sheet import sheets_with, text_block
from crankwork.quantities import LANGUAGES
from crankwork.report.figures import drawings
from crankwork.report.look import drawn_of
from crankwork.show.canvas import FINE, round_scale
from crankwork.show.scene import ChartBox, Hatch, Polyline, extent, hatch_lines, text_width
from crankwork.show.svg import svg
from each import failing, for_each
from looks import Fault, box_of, faults
from notes import ROOT, SIGNED, lines, results, scale, sheets, texts, value

OVER_CYCLE = ("indicator_brix", "piston_forces", "rod_forces", "crankpin_forces", "torque")
LIGHT = (("spark-engine", "ru"), ("press-geometry", "en"), ("press", "vi"))
# two rods on a pin, a rod with others on it, gears, a driven cylinder
OTHERS = (("v8-diesel", "en"), ("radial-five", "en"), ("andrews-squeezer", "en"),
          ("excavator-boom", "vi"))  # fmt: skip
# the leader of position 9 of the crank goes by the R that stands at the same pin
LEFT = {("andrews-squeezer", "linkage-kinematics"): [Fault("crossed", "/{R}")]}


@pytest.fixture(scope="module", params=["light", pytest.param("others", marks=pytest.mark.slow)])
def drawn(request):
    """Return sheets by machine, of every kind of machine."""
    return {name: sheets(name, language) for name, language in (LIGHT if request.param == "light" else OTHERS)}


def figures(found):
    return {one.name: one.drawing for sheet in found for one in sheet.figures}


def zero(plot, axis):
    """Return where the value 0 of an axis of a graph is. [mm]"""
    start, length = (plot.box.left, plot.box.width) if axis == "x" else (plot.box.bottom, plot.box.height)
    low, high = getattr(plot, axis)
    return start + length * (0 - low) / (high - low)


# --- what a file asks for
CHOICE = """[document]
sheets = ["torque", "own", "indicator"]
figures.own = ["side_force", "piston_velocity"]
figures.torque = ["crank_torque"]
"""


def _asked(text):
    stated = (ROOT / "examples" / "spark-engine.toml").read_text("utf-8")
    return analyse(read_machine(stated.replace("[document]\n", text)))


def test_a_file_chooses_the_figures_of_its_sheets_and_the_curves_of_figures():
    given = _asked(CHOICE)
    found = figures(drawn_sheets(given, paper=Paper("A2")))
    assert list(found) == ["indicator", "torque", "own"]
    assert [list(plot.curves) for plot in found["torque"].plots] == [["crank_torque", "max", "min"]]
    kinds = [next(iter(plot.curves)) for plot in found["own"].plots]
    assert kinds == ["side_force", "piston_velocity"]
    degrees, force = drawings(given, only=["own"])["own"].plots[0].curves["side_force"]
    expected = given.columns_at(np.mod(degrees, 720.0), ["side_force"])["side_force"] / 1e3
    np.testing.assert_allclose(force, expected, atol=1e-9)


@for_each(("before", "after", "told"), [
    ('"torque", ', '"torqe", ', "sheets[1]: torqe is no figure of this machine; write one of indicator_brix, "),
    ('"side_force", ', '"point_velocity.A", ', "figures.own[1]: point_velocity.A is no column of this machine"),
])  # fmt: skip
def test_what_a_machine_does_not_have_is_refused_with_what_it_has(before, after, told):
    with pytest.raises(InputError, match=re.escape(f"document.{told}")):
        drawn_sheets(_asked(CHOICE.replace(before, after)))


def test_curves_of_written_sheets_have_names_and_are_black():
    written = svg(sheets("spark-engine", "ru")[0].drawing, "black").decode()
    assert re.search(r'<path class="piston_velocity" [^>]*stroke="#000000"', written)
    strokes = set(re.findall(r'stroke="(#[0-9a-f]{6})"', written))
    assert all(colour[1:3] == colour[3:5] == colour[5:] for colour in strokes)


# --- what is measured


@pytest.mark.slow
def test_pressure_measured_on_the_sheet_is_the_pressure():
    """The note of the example prints 5.083 MPa at 365 and 370 degrees and 2.42322 MPa at 360."""
    drawing = sheets("spark-engine", "ru")[0].figure("indicator_brix").drawing
    for name, plot in zip(("indicator", "pressure"), drawing.plots, strict=False):
        (line,), unit = lines(drawing, name), scale(drawing, "p")
        assert np.max(line[:, 1] - zero(plot, "y")) * unit == pytest.approx(5.083, rel=1e-9)
    angles = (line[:, 0] - zero(plot, "x")) * scale(drawing, "φ")
    assert angles[-1] == pytest.approx(720, rel=1e-12)
    at = int(np.argmin(np.abs(angles - 360)))
    assert (line[at, 1] - zero(plot, "y")) * unit == pytest.approx(2.42322, rel=1e-9)
    # stroke and bore of 105.8 mm, clearance of 120 cm3
    (line,), (circle,) = lines(drawing, "indicator"), lines(drawing, "circle")
    volumes = (line[:, 0] - zero(drawing.plots[0], "x")) * scale(drawing, "V")
    assert (np.min(volumes), np.ptp(volumes)) == pytest.approx((120, math.pi / 4 * 10.58**3), rel=1e-9)
    written = next(found for one in texts(drawing) if (found := re.search(r"/{μ}_{S} = ([\d,]+)", one.text)))
    assert np.ptp(circle[:, 0]) * value(written[1]) == pytest.approx(105.8, rel=5e-4)
    # the loop of gas exchange, to the scale that stands below it, down to the intake at 0.08 MPa
    inset = drawing.plots[2]
    (written,) = (found for one in texts(drawing) if (found := re.search(r"/{μ}_{p} = ([\d,]+)", one.text)))
    low = min(np.min(one[:, 1]) for one in lines(drawing, "gas_exchange"))
    lowest = np.min(drawn_of(results("spark-engine"), "ru").values("gas_pressure"))
    assert lowest == pytest.approx(0.08, rel=1e-3)
    assert (low - zero(inset, "y")) * value(written[1]) == pytest.approx(lowest, rel=1e-9)
    # the angle of a cycle is drawn to two or four degrees a millimetre
    for one in sheets("spark-engine", "ru")[:2]:
        assert {scale(found.drawing, "φ") for found in one.figures if found.name in OVER_CYCLE} <= {2, 4}
    # the pressure of the surroundings is named at the end of its line
    (place,) = (one.place for one in texts(drawing) if one.text == "/{p}_{0}")
    (line,) = [one for one in lines(drawing, "ambient") if one[0, 1] < drawing.plots[0].box.bottom]
    assert place[0] == pytest.approx(np.max(line[:, 0])) == pytest.approx(inset.box.left + inset.box.width)
    assert within(ChartBox(*line.min(axis=0), *np.ptp(line, axis=0)), inset.box)


@pytest.mark.slow
@for_each("per_area", [False, True])
def test_forces_measured_on_the_sheet_are_the_forces(per_area):
    own = drawn_of(results("spark-engine"), "en", per_area=per_area)
    sheet = sheets("spark-engine", "en", per_area=True)[1] if per_area else sheets("spark-engine")[1]
    for name, key in (("piston_forces", "piston_force"), ("rod_forces", "side_force")):
        drawing = sheet.figure(name).drawing
        (line,), unit = lines(drawing, key), 1.0 if per_area else 1e3  # kN
        measured = (line[:, 1] - zero(drawing.plots[0], "y")) * scale(drawing, "F") * unit
        assert np.allclose(measured, own.values(key), rtol=0, atol=1e-9 * np.max(np.abs(own.values(key))))


def test_velocities_measured_on_the_plans_are_the_velocities():
    """The crank pin of the press runs at 14.65 rad/s on 50 mm in every plan, whatever its scale."""
    drawing = sheets("press-geometry")[0].figure("velocity_plans").drawing
    said = [one.text for one in texts(drawing) if one.text.startswith("position")]
    assert len(said) == 12
    lengths = [np.hypot(*np.ptp(one.points, axis=0)) for one in drawing.items if isinstance(one, Polyline)]
    for unit in {float(re.search(r"= ([\d.]+)", one)[1]) for one in said}:
        assert round_scale(unit, FINE) == unit
        # the shaft of an arrow ends where its head begins
        assert any(abs(length * unit - 14.65 * 0.05) < 0.08 for length in lengths)


def cells(drawing, head):
    """Return what stands in the column of a table under a heading, from above."""
    (top,) = [one for one in texts(drawing) if one.text == head]
    under = [one for one in texts(drawing) if abs(one.place[0] - top.place[0]) < 1e-6 and one.place[1] < top.place[1]]
    return [one.text.replace("−", "-") for one in sorted(under, key=lambda one: -one.place[1])]


def test_what_a_linkage_is_made_of_stands_on_its_first_sheet():
    """Structure, mobility, speed and method: five links, seven pairs, 139.9 rpm."""
    said = " ".join(one.text for one in texts(sheets("press-geometry")[0].figure("structure").drawing))
    wanted = ("= 3·5 − 2·7 = 1", "I(0,1) → II(2,3) → II(4,5)", "class: II", "139.897 rpm", "14.65 rad/s",
              "method: exact")  # fmt: skip
    assert [one for one in wanted if one not in said] == []


@for_each(
    ("sheet", "figure", "head", "key"),
    [
        (1, "velocities", "/{v}_{D}, m/s", "point_velocity.D"),
        (1, "velocities", "/{ω}_{3}, rad/s", "link_angular_velocity.rocker"),
        (1, "accelerations", "/{α}_{2}, rad/s²", "link_angular_acceleration.rod"),
        (1, "accelerations", "/{a}_{B}, m/s²", "point_acceleration.B"),
        (2, "reactions", "/{R}_{C}, N", "joint_force.C"),
        (2, "reactions", "/{M}_{b}, N·m", "balancing_torque"),
    ],
)
def test_tables_of_motion_and_reactions_hold_the_columns(sheet, figure, head, key):
    known = results("press-geometry").columns_at(np.arange(0.0, 360.0, 30.0))[key]
    shown = cells(sheets("press-geometry")[sheet].figure(figure).drawing, head)
    assert [float(one) for one in shown] == pytest.approx(known, abs=6e-4 * np.max(np.abs(known)))


def test_reactions_of_a_machine_that_a_slider_drives_have_the_force_that_drives_it():
    said = [one.text for one in texts(sheets("driven-slider")[2].figure("reactions").drawing)]
    assert "/{F}_{q}, N" in said


@pytest.mark.slow
def test_plans_are_measured_in_the_scale_that_is_written_under_them(drawn):
    """The table repeats the scales of the plans; a length read there, times the scale, is the velocity to 0.05 mm."""

    def check(found):
        sheet = found[0]
        scales = sheet.figure("scales").drawing
        for kind, at in (("velocity_plans", 0), ("acceleration_plans", 1)):
            written = "\n".join(one.text for one in texts(sheet.figure(kind).drawing))
            plans = re.findall(r"position (\d+): /{μ}_{.} = ([\d.]+)", written)
            assert [cells(scales, position)[at] for position, _ in plans] == [one for _, one in plans]
        assert "/{μ}_{v}, (m/s)/mm" in [one.text for one in texts(scales)]
        table = sheet.figure("compared").drawing
        positions = cells(table, "pos.")
        for at, (sign, unit) in enumerate((("v", "m/s"), ("a", "m/s²"))):
            heads = (f"/{{{sign}}} on the plan, mm", f"/{{{sign}}} graphic, {unit}", f"/{{{sign}}} analytic, {unit}")
            columns = ([float(one) for one in cells(table, head)] for head in heads)
            for position, length, one, exact in zip(positions, *columns, strict=True):
                drawn_to = float(cells(scales, position)[at])
                largest = max(float(text) for text in cells(table, heads[2]))
                assert length * drawn_to == pytest.approx(one, abs=1e-3 * largest)
                assert one == pytest.approx(exact, abs=0.05 * drawn_to + 1e-3 * largest)

    # as the words of the table are English
    assert failing({name: drawn[name] for name in drawn if name in ("press-geometry", "andrews-squeezer")}, check) == {}


# --- what every sheet has room for


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


def clashes(found):
    """Return which texts stand on each other, set in letters a tenth wider than ours."""
    boxes = [box_of(one) for one in found]
    return [(one.text, found[j].text) for i, one in enumerate(found) for j in range(i)
            if overlap(boxes[i], boxes[j], 0.3)]  # fmt: skip


@pytest.mark.slow
def test_everything_has_room(drawn):
    """Texts of the standard heights; in wider letters too none leaves the frame, meets another or a line."""
    for name, found in drawn.items():
        for sheet in found:
            frame, where = sheet.paper.frame, (name, sheet.name)
            # GOST 2.304, ISO 3098; what is read at a defence is as large as that
            assert {round(one.height, 9) for one in texts(sheet)} <= {2.5, 3.5, 5.0, 7.0, 10.0}, where
            own = [one for figure in sheet.figures for one in texts(figure.drawing)]
            marks = [one for one in own if "μ" in one.text or (one.angle and name == "spark-engine")]
            assert min((one.height for one in marks), default=3.5) >= 3.5 - 1e-9, where
            assert faults(sheet.drawing) == LEFT.get(where, []), where
            assert [one.text for one in texts(sheet) if not within(box_of(one), frame)] == [], where
            inks = [one.ink for one in sheet.figures]
            assert all(within(one, frame) and not overlap(one, sheet.paper.reserved) for one in inks), where
            # plans of one scale leave room beside those that are small
            least = {1: 0.25, 2: 0.25}.get(len(inks), 0.55)
            block = sheet.paper.reserved
            covered = sum(one.width * one.height for one in inks)
            assert covered > least * (frame.width * frame.height - block.width * block.height), where
            assert len(inks) > 2 or name == "press", where


def test_scales_are_round_and_graphs_stand_on_the_lines_of_millimetre_paper(drawn):
    for name, found in drawn.items():
        for key, plot in ((key, plot) for key, one in figures(found).items() for plot in one.plots):
            for axis, length in (("x", plot.box.width), ("y", plot.box.height)):
                low, high = getattr(plot, axis)
                unit = abs(high - low) / length
                assert not plot.titles.get(axis) or round_scale(unit) == pytest.approx(unit, rel=1e-6), (name, key)
            # the load and the circle of its mean are whole, and in the frame
            for curve in {"load", "mean"} & plot.curves.keys() if "pole" in plot.curves else ():
                x, y = plot.curves[curve]
                assert np.hypot(x[-1] - x[0], y[-1] - y[0]) < 1e-9 * abs(plot.y[1] - plot.y[0]), (name, key)
                for values, ends in ((x, plot.x), (y, plot.y)):
                    assert min(ends) <= values.min() <= values.max() <= max(ends), (name, key)
    for figure in sheets("spark-engine", "ru")[1].figures:
        box = figure.drawing.plots[0].box
        assert (box.left - round(box.left), box.bottom - round(box.bottom)) == pytest.approx((0, 0), abs=1e-6)


def test_no_diagram_of_an_engine_is_left_small(drawn):
    """Polar diagrams of unlike pins are of one size, wear is read on 50 mm at least, the loop of gas exchange seen."""
    for name, found in drawn.items():
        shown = figures(found)
        if "crankpin_polar" not in shown:
            continue
        polars = [one.plots[0] for key, one in shown.items() if key.startswith("crankpin_polar")]
        scales = [(plot.x[1] - plot.x[0]) / plot.box.width for plot in polars]
        assert max(scales) <= 2.5 * min(scales), name
        assert min(plot.box.height for plot in polars) > 60, name
        assert min(np.ptp(one[:, 0]) for one in lines(shown["crankpin_wear"], "journal")) > 50, name
        over_volume, over_angle, *inset = shown["indicator_brix"].plots
        assert over_volume.box.height > 80, name
        assert len(inset) == 1, name
        # read together: one scale of pressures, at one level
        assert (over_volume.y, over_volume.box.height) == (over_angle.y, over_angle.box.height), name
        assert over_volume.box.bottom == pytest.approx(over_angle.box.bottom), name
        # the circle of Brix is as wide as the swept volume above it
        (circle,) = lines(shown["indicator_brix"], "circle")
        volume = over_volume.curves["indicator"][0]
        unit = (over_volume.x[1] - over_volume.x[0]) / over_volume.box.width
        assert np.ptp(circle[:, 0]) * unit == pytest.approx(np.ptp(volume), rel=2e-3), name
        assert circle[0, 0] - over_volume.box.left == pytest.approx(np.min(volume) / unit, abs=0.1), name


def test_headings_of_a_small_sheet_have_one_size_and_those_side_by_side_stand_on_one_line():
    paper = Paper("A3", block=None)
    found = drawn_sheets(results("press-geometry"), "en", paper=paper)
    headings = [[text for text in texts(one.drawing) if text.height > 4] for sheet in found for one in sheet.figures]
    assert {text.height for rows in headings for text in rows} == {5.0}
    pairs = [sheet.figures for sheet in found if len(sheet.figures) == 2]
    beside = [(a, b) for a, b in pairs if a.ink.right < b.ink.left]
    assert beside
    assert all(abs(a.ink.top - b.ink.top) < 2 for a, b in beside)


@pytest.mark.slow
def test_plans_say_whether_they_share_a_scale():
    """Those of a boom that starts and stops do not, those of a press do."""
    shared = {}
    for name in ("boom", "press-geometry"):
        for sign, figure in (("v", "velocity_plans"), ("a", "acceleration_plans")):
            said = [one.text for one in texts(sheets(name)[0].figure(figure).drawing)]
            found = {one[1] for text in said if (one := re.search(rf"/{{μ}}_{{{sign}}} = ([\d.]+)", text))}
            assert found
            assert ("scales differ from plan to plan" in said) == (len(found) > 1), (name, figure)
            shared[name, sign] = len(found) == 1
    assert set(shared.values()) == {True, False}


@pytest.mark.slow
def test_a_small_format_takes_every_figure():
    found, usual = (sheets("spark-engine", "ru", SIGNED._replace(size=one)) for one in ("A3", "A1"))
    assert list(figures(found)) == list(figures(usual))
    assert all(within(one.ink, sheet.paper.frame) for sheet in found for one in sheet.figures)
    assert [clashes(texts(sheet)) for sheet in found if clashes(texts(sheet))] == []
    assert len(found) > len(usual)


@pytest.mark.slow
def test_a_small_engine_has_room():
    text = (ROOT / "tests/machines/points-engine.toml").read_text("utf-8")
    text = text.replace('radius = "45 mm"', 'radius = "12 mm"')
    text = text.replace('length = "160 mm"', 'length = "40 mm"')
    text = text.replace("compression_ratio = 9.0", "compression_ratio = 22")
    for sheet in drawn_sheets(analyse(read_machine(text)), "vi", paper=SIGNED):
        assert clashes(texts(sheet)) == []


# --- paper


def test_form_1_of_gost_has_its_size_and_its_cells():
    """GOST 2.104, form 1: 185 x 55 mm in the lower right corner of a frame 20 mm from the left edge, 5 mm elsewhere."""
    first, second = ([one.text for one in texts(sheet)] for sheet in sheets("spark-engine", "ru")[:2])
    assert SIGNED.reserved == ChartBox(841 - 5 - 185, 5, 185, 55)
    assert SIGNED.frame == ChartBox(20, 5, 816, 584)
    designation = SIGNED.block.designation
    assert {"Изм.", "Разраб.", "Nguyễn Văn Đức", "Щербаков Ю. Ё.", designation, "Лист 1"} <= set(first)
    assert "Лист 2" in second
    # once in the block, and once upside down in the corner
    turned = [one.angle for one in texts(sheets("spark-engine", "ru")[0]) if one.text == designation]
    assert sorted(turned) == [0, 180]


FIELDS = [name for name in SIGNED.block._fields if name not in ("form", "sheet", "sheets", "title_height")]
LONG = (
    "Кафедра «Теория механизмов и машин» факультета робототехники и комплексной автоматизации Московского "
    "государственного технического университета. Bộ môn Động cơ đốt trong, Khoa Cơ khí Giao thông, Trường Đại học "
    "Bách khoa, Đại học Đà Nẵng. Lehrstuhl für Verbrennungskraftmaschinen und Thermodynamik der Hochschule in Aachen"
)[:300]


@pytest.mark.slow
@for_each(("form", "text"), [(form, text) for form in LANGUAGES for text in ("", LONG, "X" * 300, "Ж" * 40)])
def test_a_title_block_says_what_the_document_is_in_its_cells(form, text):
    """Everything that a cell says stays within it, clear of its label, in letters a tenth wider too."""
    block = SIGNED.block._replace(form=form, department="Кафедра РК-2 «Теория механизмов и машин»")
    block = block._replace(approved_by="X" * 90)._replace(**dict.fromkeys(FIELDS if text else (), text))
    sheet = sheets("press", "vi")[0]._replace(figures=(), paper=Paper(block=block))
    room = sheet.paper.reserved
    inside = [one for one in texts(sheet) if overlap(extent(one), room)]
    assert clashes(inside) == []
    sides = [one.points for one in sheet.items if isinstance(one, Polyline) and one.closed and len(one.points) == 4]
    around = [ChartBox(*one.min(axis=0), *np.ptp(one, axis=0)) for one in sides]
    for one in inside:
        # letters below the line hang into the next cell
        box = box_of(one)._replace(bottom=one.place[1], height=one.height) if not one.angle else box_of(one)
        assert within(box, room), one
        # what holds its middle holds all of it
        middle = ChartBox(box.left + box.width / 2, box.bottom + box.height / 2, 0, 0)
        holding = [cell for cell in around if within(middle, cell) and within(cell, room)]
        assert within(box, min(holding, key=lambda cell: cell.width * cell.height), 0.3), one
    said = " ".join(one.text for one in inside)
    if text == LONG:
        assert said.count("Кафедра") >= 6
        assert "…" in said
    if not text:
        for one in ("Nguyễn Văn Đức", "Щербаков Ю. Ё.", "МГТУ", "РК2-41Б", SIGNED.block.designation):
            assert one in said


@pytest.mark.slow
def test_sheets_are_in_the_units_of_the_figures():
    """Forces of an engine in kN, of a machine in pounds and feet in these."""
    text = template("engine").replace("title = ", 'units = "imperial"\ntitle = ', 1)
    units = {}
    for name, found in (("v8-diesel", results("v8-diesel")), ("imperial", analyse(read_machine(text)))):
        shown = sheets(name) if name == "v8-diesel" else drawn_sheets(found)
        plots = (*figures(shown)["rod_forces"].plots, *drawings(found)["rod_forces"].plots)
        (title,) = {plot.titles["y"] for plot in plots}
        units[name] = title.rpartition(", ")[2]
    assert units == {"v8-diesel": "kN", "imperial": "lbf"}


def test_paper_without_frame_and_block_has_figures_alone():
    plain, grid = (
        sheets("press", "vi")[0]._replace(paper=Paper(has_frame=False, has_grid=one)) for one in (False, True)
    )
    assert len(plain.items) == sum(len(one.drawing.items) for one in plain.figures)
    assert len(grid.items) - len(plain.items) == 817 + 585


def test_other_paper_and_results_without_material_are_refused():
    with pytest.raises(CrankworkError, match="take A0, A1, A2, A3"):
        sheets("spark-engine", paper=Paper(size="A7"))
    with pytest.raises(CrankworkError, match="sheets need the motion of a piston, a drawn linkage or torques"):
        drawn_sheets(replace(results("press"), columns={}))
    with pytest.raises(CrankworkError, match="there is no figure brix"):
        sheets("spark-engine", "ru")[1].figure("brix")


@pytest.mark.slow
def test_what_has_no_room_on_a_paper_is_named():
    """A figure with more letters than a small sheet has room for says so in its place."""
    tall, small = (
        functools.partial(text_block, [str(one) * 400 for one in range(count)], "words", "en") for count in (300, 2)
    )
    pictures = [Picture("small", small), Picture("tall", tall)]
    found = list(sheets_with("s", "t", pictures, SIGNED._replace(size="A3"), "en"))
    assert list(figures(found)) == ["small", "tall"]
    said = [one.text for sheet in found for one in texts(sheet)]
    assert "words: no room on A3; take larger paper" in said


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
