"""Figures in every format and theme: what is written is what was drawn."""

from __future__ import annotations

import io
import json
import re
from xml.etree import ElementTree as ET

import ezdxf
import numpy as np
import pytest

import crankwork
from crankwork.description.machine_file import read_machine, template
from crankwork.errors import CrankworkError
from crankwork.report.figures import drawings
from crankwork.show.formats import dxf, pdf, png
from crankwork.show.scene import Arc, Circle, Drawing, Hatch, Polyline, Text, literal, pen_of, runs, simplified
from crankwork.show.svg import svg
from crankwork.show.theme import THEMES, palette_of
from each import for_each
from shown import figures_of, in_parts, results_of

SVG = "{http://www.w3.org/2000/svg}"
# an engine, a linkage and a table have all kinds of lines
DRAWN = ("spark-engine", "atkinson", "punching-machine")


def _lightness(colour: str) -> float:
    """Return the relative luminance of WCAG 2."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    red, green, blue = (one / 12.92 if one <= 0.04045 else ((one + 0.055) / 1.055) ** 2.4 for one in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def _contrast(one: str, other: str) -> float:
    low, high = sorted((_lightness(one), _lightness(other)))
    return (high + 0.05) / (low + 0.05)


def _strokes(data: bytes) -> dict[str, set[str]]:
    """Return the colours of curves by their dashes, empty for none."""
    root, found = ET.fromstring(data), dict[str, set[str]]()  # noqa: S314 - our own bytes
    for one in root.iter(f"{SVG}path"):
        if one.get("class"):
            pattern = one.get("stroke-dasharray", "")
            kind = f"{len(pattern.split())}{'.' if pattern and float(pattern.split()[0]) < 0.5 else ''}"
            found.setdefault(kind, set()).add(one.get("stroke", ""))
    return found


@for_each(("name", "theme"), [(name, theme) for name in DRAWN for theme in THEMES])
def test_curves_and_letters_stand_out_from_the_ground_and_curves_have_colours_of_their_own(name, theme):
    """A sample in a legend has the dashes, and so the colour, of its curve."""
    ground = palette_of(theme).ground
    assert _contrast(palette_of(theme).ink, ground) > 12
    for one in figures_of(name, "ru").values():
        data = svg(one, theme)
        assert f'height="{ET.fromstring(data).get("viewBox").split()[3]}" fill="{ground}"'.encode() in data  # noqa: S314
        kinds = _strokes(data)
        colours = set().union(*kinds.values())
        assert all(_contrast(colour, ground) >= 3.0 for colour in colours)
        if theme == "print":
            assert colours <= {"#000000", "#0072b2", "#737373"}
        else:
            assert all(len(own) == 1 for own in kinds.values())
            assert len(colours) == len(kinds)


@in_parts("name", DRAWN[-1:], [*DRAWN[:-1], "petrol-four"])
def test_a_figure_as_dxf_passes_the_audit_and_has_its_texts_and_lines(name):
    for figure, one in figures_of(name, "ru").items():
        document = ezdxf.read(io.StringIO(dxf(one).decode()))
        assert not document.audit().errors, figure
        space = document.modelspace()
        assert len(space.query("TEXT MTEXT")) == sum(isinstance(item, Text) for item in one.items)
        lines = sum(isinstance(item, Polyline) and pen_of(item.kind).width > 0 for item in one.items)
        assert len(space.query("LWPOLYLINE")) == lines


def test_a_figure_as_pdf_has_the_size_of_the_paper_and_as_png_its_pixels():
    one = figures_of("spark-engine", "ru")["torque"]
    data = pdf(one)
    assert data == pdf(one)
    (width, height) = re.search(rb"/MediaBox ?\[0 0 ([\d.]+) ([\d.]+)", data).groups()
    assert (float(width), float(height)) == pytest.approx((one.width * 72 / 25.4, one.height * 72 / 25.4), abs=0.01)
    picture = png(one, "dark", 100.0)
    assert picture.startswith(b"\x89PNG")
    assert int.from_bytes(picture[16:20]) == pytest.approx(one.width / 25.4 * 100, abs=1.0)


SCENE = Drawing("t", "en", 100.0, 50.0, (
    Polyline(np.array([[5.0, 5.0], [20.0, 5.0], [20.0, 15.0]]), "dashed", name="key"),
    Polyline(np.array([[30.0, 5.0], [40.0, 5.0], [40.0, 15.0]]), "thick", closed=True, fill=0.5),
    Circle((60.0, 20.0), 5.0, "thin", 1.0),
    Arc((80.0, 20.0), 10.0, 30.0, 120.0, "medium"),
    Text((10.0, 30.0), "/{M}_{1} = 5·10^{2}", 5.0),
    Text((50.0, 40.0), "turned", 2.5, "middle", 90.0, 0.5),
    Hatch(np.array([[70.0, 35.0], [90.0, 35.0], [90.0, 45.0], [70.0, 45.0]])),
))  # fmt: skip


IN_SVG = """\
<path class="key" d="M5 45L20 45L20 35" fill="none" stroke="#0072b2" stroke-width="0.5" stroke-linejoin="round"\
 stroke-dasharray="4 1.5"/>
<path d="M30 45L40 45L40 35z" fill="#808080" stroke="#000000" stroke-width="0.7" stroke-linejoin="round"/>
<circle cx="60" cy="30" r="5" fill="#ffffff" stroke="#000000" stroke-width="0.25" stroke-linejoin="round"/>
<path d="M88.66 25L88.387 24.554L ... L75.46 21.09L75 21.34" fill="none" stroke="#000000" stroke-width="0.5"\
 stroke-linejoin="round"/>
<text x="10" y="20" font-size="7.599" xml:space="preserve"><tspan font-style="italic">M</tspan>\
<tspan dy="1.5" font-size="5.319">1</tspan><tspan dy="-1.5"> = 5·10</tspan><tspan dy="-2.5" font-size="5.319">2</tspan>\
</text>
<text x="50" y="10" font-size="3.799" text-anchor="middle" fill="#808080" transform="rotate(-90 50 10)"\
 xml:space="preserve">turned</text>
<path d="M88.033 15L90 13.033M84.497 15L90 9.497M80.962 15L90 5.962M77.426 15L87.426 5M73.891 15L83.891 5\
M70.355 15L80.355 5M70 11.82L76.82 5M70 8.284L73.284 5" fill="none" stroke="#000000" stroke-width="0.25"\
 stroke-linejoin="round"/>
</svg>"""
IN_DXF = [
    ("LWPOLYLINE", "DASHED", [5, 5, 20, 5, 20, 15]), ("HATCH", "HATCH", []),
    ("LWPOLYLINE", "THICK", [30, 5, 40, 5, 40, 15]), ("WIPEOUT", "0", []), ("CIRCLE", "THIN", [60, 20, 5]),
    ("ARC", "MEDIUM", [80, 20, 10, 30, 120]), ("MTEXT", "TEXT", [10, 32.5, 5]), ("TEXT", "TEXT", [50, 40, 2.5, 90]),
]  # fmt: skip


def test_a_scene_of_every_item_is_drawn_in_svg_where_it_stands():
    text = svg(SCENE).decode()
    assert text.startswith('<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 100 50"')
    _, ground, items = text.partition('<rect width="100" height="50" fill="#ffffff"/>\n')
    assert ground
    assert re.sub(r"(L88.387 24.554)L.*(L75.46 21.09)", r"\1L ... \2", items).strip() == IN_SVG


def test_a_scene_of_every_item_is_drawn_in_dxf_where_it_stands():
    items = list(ezdxf.read(io.StringIO(dxf(SCENE).decode())).modelspace())
    hatch = [one for one in items if one.dxftype() == "LINE"]
    found = [(one.dxftype(), one.dxf.layer, _numbers(one)) for one in items if one not in hatch]
    assert [one[:2] for one in found] == [one[:2] for one in IN_DXF]
    for one, other in zip(found, IN_DXF, strict=True):
        assert one[2] == pytest.approx(other[2]), one
    assert {one.dxf.layer for one in hatch} == {"HATCH"}
    last = [*hatch[-1].dxf.start.vec2, *hatch[-1].dxf.end.vec2]
    assert (len(hatch), *last) == pytest.approx((8, 70, 41.715729, 73.284271, 45))
    assert items[6].text == r"{\Q15;M}{\H0.7x;\S^ 1;} = 5·10{\H0.7x;\S2^ ;}"


def _numbers(item):
    """Return where something of DXF stands, and how large it is."""
    if item.dxftype() == "LWPOLYLINE":
        return [one for point in item.get_points("xy") for one in point]
    own = item.dxfattribs()
    places = [own[key].vec2 for key in ("center", "insert") if key in own and item.dxftype() != "WIPEOUT"]
    sizes = ("radius", "start_angle", "end_angle", "height", "char_height", "rotation")
    return [*(one for place in places for one in place), *(own[key] for key in sizes if key in own)]


def test_a_picture_is_restyled_and_saved_by_its_ending(tmp_path):
    results = results_of("spark-engine")
    picture = results.figure("torque")
    dark = picture.styled("dark")
    assert (picture.theme, dark.theme) == ("print", "dark")
    assert dark.svg != picture.svg == results.figure("torque").svg
    assert palette_of("dark").ground in dark.svg
    for ending, begin in (("svg", b"<svg"), ("pdf", b"%PDF"), ("png", b"\x89PNG"), ("dxf", b"  0")):
        path = tmp_path / f"torque.{ending}"
        dark.save(path)
        assert path.read_bytes().startswith(begin)
    with pytest.raises(CrankworkError, match="svg, pdf, png, dxf"):
        picture.save(tmp_path / "torque.eps")
    with pytest.raises(CrankworkError, match="print, colour, dark"):
        picture.styled("neon")


@for_each("seed", range(4))
def test_a_thinned_line_leaves_no_point_further_away_than_nobody_sees(seed):
    walk = np.cumsum(np.random.default_rng(seed).normal(size=(400, 2)) * (0.05, 0.01), axis=0)
    # a loop that ends where it begins, and a line drawn twice
    points = np.vstack([walk, walk[::-1]]) if seed % 2 else walk
    kept = simplified(points)
    assert len(kept) < len(points)
    assert np.array_equal(kept[[0, -1]], points[[0, -1]])
    start, way = kept[:-1], np.diff(kept, axis=0)
    shares = np.clip(np.sum((points[:, None] - start) * way, axis=2) / np.maximum(np.sum(way**2, axis=1), 1e-30), 0, 1)
    nearest = np.min(np.hypot(*np.moveaxis(points[:, None] - start - shares[..., None] * way, -1, 0)), axis=1)
    assert np.max(nearest) <= 0.01 + 1e-12


def test_names_with_signs_of_codes_stand_in_dxf_as_they_are_written():
    """Beside letters with an index, where a text has codes, and alone."""
    names = ["P^{2}", "a_{b}", "c\\d", "{x}"]
    items = [Text((5.0, 10.0 + 10 * at), f"M_{{i}} {literal(one)}") for at, one in enumerate(names)]
    items += [Text((5.0, 60.0 + 10 * at), literal(one)) for at, one in enumerate(names)]
    drawing = Drawing("t", "en", 100.0, 120.0, tuple(items))
    space = ezdxf.read(io.StringIO(dxf(drawing).decode())).modelspace()
    coded = [one.plain_text().partition(" ")[2].replace("i ", "") for one in space.query("MTEXT")]
    assert [one.rpartition(" ")[2] for one in coded] == names
    assert [one.plain_text() for one in space.query("TEXT")] == names


@for_each("name", ["Шарнир Ж", "khớp nối ậ", "φ₁", "ο′", "№ 5 %%d", "~x;"])
def test_letters_of_names_come_back_from_dxf(name):
    text = template("four-bar").replace('"A"', json.dumps(name))
    drawn = drawings(crankwork.analyse(read_machine(text)), language="vi", only=["joint_forces"])["joint_forces"]
    space = ezdxf.read(io.StringIO(dxf(drawn).decode())).modelspace()
    read = [one.plain_text() for one in space.query("TEXT MTEXT")]
    assert any(name.replace("%%", "% %") in one for one in read), read
    said = ["".join(run.text for run in runs(one.text)) for one in drawn.items if isinstance(one, Text)]
    assert sorted(_bare(one) for one in read) == sorted(_bare(one) for one in said)


def _bare(text):
    return "".join(text.replace("^", "").replace("%", "").split())
