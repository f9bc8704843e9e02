"""What every figure looks like, told from its scene: where letters stand, what runs through them, curves in grey."""

from __future__ import annotations

import itertools
import re

import numpy as np
import pytest

from crankwork.description.machine_file import read_machine
from crankwork.locale.numbers import unit_name
from crankwork.note.sheets import drawn_sheets
from crankwork.quantities import LANGUAGES
from crankwork.report.drawing import film_of
from crankwork.report.figures import drawings
from crankwork.report.notices import skipped_figure_notes
from crankwork.show.canvas import ChartLayout, use_layout
from crankwork.show.chart import Graph, round_ticks, sheet
from crankwork.show.formats import png
from crankwork.show.label_placement import mark_point
from crankwork.show.scene import ChartBox, Circle, Drawing, Pen, Polyline, Text, line, pen_of, rectangle, runs, shade_of
from crankwork.show.svg import svg
from each import for_each
from expansions import of_linkage
from looks import box_of, faults
from shown import FEW, REST, WIDE, figures_of, in_parts, results_of

# contrast of lines with their ground that is asked for of pictures, and what is no less apart in shade or width
CONTRAST, SHADES, WIDTHS = 3.0, 0.25, 1.3


# letters of Russian are the widest
@in_parts(
    ("name", "language"),
    [(name, LANGUAGES[at % 3]) for at, name in enumerate(FEW) if name != "petrol-four"],
    [("petrol-four", "ru"), ("atkinson", "vi"), *WIDE.items()],
)
def test_letters_stand_on_their_paper_clear_of_lines_and_of_each_other(name, language):
    found = figures_of(name, language)
    assert {figure: wrong for figure, one in found.items() if (wrong := faults(one))} == {}


def test_faults_are_seen():
    def kinds(*items):
        return [one.kind for one in faults(Drawing("t", "en", 100.0, 50.0, items))]

    over, under = line((0.0, 11.0), (60.0, 12.0), "medium"), Text((10.0, 10.0), "word")
    ground = rectangle(ChartBox(8.0, 8.0, 20.0, 8.0), Pen(0.0), fill=1.0)
    assert kinds(under) == []
    assert kinds(over, under) == kinds(under, over) == ["crossed"]
    assert kinds(over, ground, under) == []
    assert kinds(ground, over, under) == ["crossed"]
    assert kinds(under, Text((12.0, 11.0), "other")) == ["overlap"]
    assert kinds(Text((95.0, 10.0), "word")) == kinds(Text((5.0, 48.0), "word", angle=90.0)) == ["outside"]
    assert kinds(Text((10.0, 10.0), "J_S^2")) == ["mark"]


@pytest.mark.slow
def test_letters_stand_clear_where_forces_are_per_area():
    """Footers tell the frame of the vectors, the method and the area."""
    found = drawings(results_of("v8-diesel"), language="ru", per_area=True)
    assert {name: wrong for name, one in found.items() if (wrong := faults(one))} == {}


NAMED = """
format = 2
[fixed_points]
O = ["0 mm", "0 mm"]
[crank]
pivot = "O"
pin = "P^{2}"
radius = "50 mm"
speed = "1000 rpm"
[links."r/{d}"]
joins = ["P^{2}", "B"]
length = "200 mm"
mass = "2 kg"
inertia = "0.01 kg*m2"
centre = ["80 mm", "0 mm"]
points = { "c_{1}" = ["100 mm", "40 mm"] }
[guides]
g = { through = "O" }
[sliders]
"s$l{i}" = { guide = "g", pin = "B", mass = "1 kg" }
[chambers."h^{a}"]
slider = "s$l{i}"
bore = "80 mm"
sense = -1
clearance_volume = "60 cm3"
ambient = "0.1 MPa"
pressures = "absolute"
pieces = [{ law = "rounded", points = ["a", "b"] }, { law = "rounded", points = ["b", "c"] }]
[chambers."h^{a}".points]
a = { stroke = 0.0, pressure = "0.8 MPa" }
b = { stroke = 1.0, pressure = "0.1 MPa" }
c = { stroke = 0.0, pressure = "0.8 MPa" }
"""


@pytest.mark.slow
def test_names_are_printed_as_they_are_written():
    """Signs that mark an index, an exponent or slanted letters in our texts mark nothing in names of users."""
    results = of_linkage(read_machine(NAMED))
    scenes = {**drawings(results), "film": film_of(results).still(0)}
    scenes |= {sheet.name: sheet.drawing for sheet in drawn_sheets(results)}
    said = {
        name: " ".join("".join(run.text for run in runs(item.text)) for item in one.items if isinstance(item, Text))
        for name, one in scenes.items()
    }
    for name, wanted in {
        "position_plans": ("P^{2}", "c_{1}"), "velocity_plan": ("v P^{2} =", "v c_{1}P^{2} ="),
        "force_plans": ("R P^{2} =",), "joint_forces": ("R P^{2}",), "film": ("P^{2}", "c_{1}"),
        "sliders": ("3 – s$l{i}",), "links": ("2 – r/{d}",),
        "chambers": ("gas force, I", "I – h^{a}"), "centrodes": ("P^{2}", "centrode of link 2"),
        "zhukovsky_lever": ("pP^{2} = ",),
        "linkage-kinematics": ("2 – r/{d}", "c_{1}"), "linkage-forces": ("R P^{2}",),
    }.items():  # fmt: skip
        for one in wanted:
            assert one in said[name], (name, one, said[name][:2000])
    assert not [one for text in said.values() for one in text if 0xE000 <= ord(one) < 0xF900]


@for_each("is_sheet", [False, True])
def test_numbers_of_axes_stand_clear_where_an_axis_goes_through_zero(is_sheet):
    """Below and left of the graph, not at the axis in its middle, where curves would run through them."""
    with use_layout(ChartLayout(is_sheet=is_sheet)):
        paper, box = sheet(200.0)
        graph = Graph(paper, box, (-3.0, 3.0), (-2.0, 5.0), "en", to_scale=False)
        graph.frame(round_ticks(*graph.x), graph.up_ticks)
        x = np.linspace(-3.0, 3.0, 50)
        for at in np.linspace(-2.0, 5.0, 40):
            graph.curve(f"c{at}", x, np.full(50, at))
        graph.curve("upright", [0.0, 0.0], [-2.0, 5.0])
        mark_point(graph, "zero", 0.0, 0.0, "zero")
        drawing = paper.drawing("t")
    assert faults(drawing) == []
    (plot,) = drawing.plots
    numbers = [one for one in drawing.items if isinstance(one, Text) and one.text.lstrip("−").isdecimal()]
    assert {"0", "−2", "4"} <= {one.text for one in numbers}
    for one in numbers:
        box = box_of(one)
        assert box.right < plot.box.left or box.top < plot.box.bottom


def _contrast(shade):
    """Return the contrast of a shade of grey with white paper."""
    light = shade / 12.92 if shade <= 0.04045 else ((shade + 0.055) / 1.055) ** 2.4
    return 1.05 / (light + 0.05)


def _are_apart(one, other):
    """Return whether two pens are told apart in grey."""
    dashes = [tuple(round(dash / pen.width, 1) for dash in pen.dashes) for pen in (one, other)]
    wide, narrow = max(one.width, other.width), min(one.width, other.width)
    return dashes[0] != dashes[1] or wide > WIDTHS * narrow or abs(shade_of(one) - shade_of(other)) > SHADES


def _curves(drawing):
    """Yield the pens of curves on each graph, by their names; straight lines have letters or numbers at their ends."""
    for plot in drawing.plots:
        found = {}
        for item in drawing.items:
            if isinstance(item, Polyline) and len(plot.curves.get(item.name, ((),))[0]) > 2 and item.fill is None:
                x, y = item.points.mean(axis=0)
                if plot.box.left <= x <= plot.box.right and plot.box.bottom <= y <= plot.box.top:
                    found[item.name] = pen_of(item.kind)
        yield found


@in_parts("name", FEW, REST)
def test_curves_of_a_graph_are_told_apart_in_grey_and_seen_on_paper(name):
    for figure, drawing in figures_of(name).items():
        for pens in _curves(drawing):
            alike = [pair for pair in itertools.combinations(pens, 2) if not _are_apart(*(pens[one] for one in pair))]
            assert alike == [], figure
            assert all(_contrast(shade_of(one)) >= CONTRAST for one in pens.values()), figure


# units of one quantity, of which the figures of a machine have one
UNITS_OF_ONE = (("N", "kN"), ("N*m", "kN*m"), ("J", "kJ"), ("W", "kW"), ("MPa", "bar", "kPa", "Pa"))


def _units(drawing, names):
    """Return which of some units stand behind numbers or at the end of titles of axes."""
    told = [item.text for item in drawing.items if isinstance(item, Text)]
    shown = {unit: re.escape(unit_name(unit, drawing.language)) for unit in names}
    return {unit for unit, name in shown.items() for text in told
            if re.search(rf"(?:, |\(|\d[ \u00a0]){name}(?![\w·/])", text)}  # fmt: skip


@in_parts("name", FEW, REST)
def test_figures_of_a_machine_have_one_unit_for_a_quantity_and_two_widths_of_lines(name):
    drawn = figures_of(name)
    units = {names: set().union(*(_units(one, names) for one in drawn.values())) for names in UNITS_OF_ONE}
    assert {names: found for names, found in units.items() if len(found) > 1} == {}
    pens = {figure: {pen_of(item.kind).width for item in one.items if isinstance(item, Polyline | Circle)} - {0.0}
            for figure, one in drawn.items()}  # fmt: skip
    # 0.9 pt for what is meant, 0.45 pt for all else
    wide = {figure: {round(width / 25.4 * 72, 3) for width in found} - {0.45, 0.9} for figure, found in pens.items()}
    assert {figure: found for figure, found in wide.items() if found} == {}


def test_letters_without_a_glyph_are_boxes_in_a_picture_and_not_lost():
    def drawn(text):
        return png(Drawing("t", "en", 40.0, 10.0, (Text((2.0, 3.0), text),)), pixels_per_inch=60.0)

    assert len({drawn(one) for one in ("ab", "a😀b", "a😀中b")}) == 3
    assert "a😀中b" in svg(Drawing("t", "en", 40.0, 10.0, (Text((2.0, 3.0), "a😀中b"),))).decode()


def test_what_is_not_drawn_is_told():
    told = [*skipped_figure_notes(results_of("parallelogram"), "en")]
    assert told == ["not drawn, because zero throughout: static torque"]
    assert next(iter(skipped_figure_notes(results_of("excavator-boom"), "ru"))).startswith("планы сил не построены")
