"""Sheets as files: SVG and PDF of the right size, DXF that says the same when it is read again, and letters."""

from __future__ import annotations

import functools
import io
import re
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import ezdxf
import numpy as np
import pytest
import typst
from ezdxf import bbox
from fontTools.ttLib import TTFont, TTLibError

from crankwork.errors import MissingExtraError
from crankwork.note.sheets import Paper, TitleBlock
from crankwork.show.formats import dxf, pdf
from crankwork.show.scene import (
    CAP_HEIGHT,
    INDEX,
    Arc,
    Circle,
    Polyline,
    pen_of,
    runs,
    shade_of,
    simplified,
    text_width,
)
from crankwork.show.svg import svg
from each import for_each
from notes import SIGNED, lines, results, scale, sheets, texts

SVG = "{http://www.w3.org/2000/svg}"
# a sheet of each kind, and all languages
KINDS = {"engine": ("spark-engine", "ru", 1), "linkage": ("press-geometry", "en", 0), "press": ("press", "vi", 0)}


@functools.cache
def sheet(kind):
    name, language, number = KINDS[kind]
    return sheets(name, language)[number]


@functools.cache
def reread(kind):
    """Return a sheet as a reader of DXF finds it."""
    return ezdxf.read(io.StringIO(dxf(sheet(kind).drawing).decode()))


@for_each("kind", KINDS)
def test_svg_has_the_size_the_texts_and_the_curves_of_its_sheet(kind):
    one = sheet(kind)
    root = ET.fromstring(svg(one.drawing))  # noqa: S314 - our own
    assert (root.get("width"), root.get("height"), root.get("viewBox")) == ("841mm", "594mm", "0 0 841 594")
    assert root.findtext(f"{SVG}title") == one.title
    written = sorted("".join(text.itertext()) for text in root.iter(f"{SVG}text"))
    assert written == sorted("".join(run.text for run in runs(text.text)) for text in texts(one))
    assert "КП.01.02.000 <&>" in written
    if kind == "engine":
        drawn = [curve for path in root.iter(f"{SVG}path") for curve in path.get("d").split("M")[1:]]
        (expected,) = lines(one, "radial_force")
        points = simplified(expected)
        curves = [np.array([point.split() for point in curve.rstrip("Zz").split("L")], dtype=float) for curve in drawn]
        same = [curve for curve in curves if curve.shape == points.shape]
        assert any(np.allclose(curve * [1, -1] + [0, 594], points, atol=6e-4) for curve in same)


@for_each(("size", "width", "height"), [("A1", 841, 594), ("A0", 1189, 841)])
def test_pdf_has_one_page_of_exactly_the_size(size, width, height):
    data = pdf(sheets("press", "vi", SIGNED._replace(size=size))[0].drawing)
    (box,) = re.findall(rb"/MediaBox ?\[0 0 ([\d.]+) ([\d.]+)\]", data)
    assert [float(one) for one in box] == pytest.approx([width / 25.4 * 72, height / 25.4 * 72], abs=0.01)
    assert data.count(b"/Type/Page/") + data.count(b"/Type /Page\n") == 1


@pytest.mark.programs
def test_poppler_finds_one_page_of_the_paper(tmp_path):
    if shutil.which("pdfinfo") is None:
        pytest.skip("pdfinfo is not installed")
    for kind in KINDS:
        (tmp_path / "sheet.pdf").write_bytes(pdf(sheet(kind).drawing))
        told = subprocess.run(["pdfinfo", tmp_path / "sheet.pdf"], capture_output=True, text=True, check=True).stdout
        assert re.search(r"Pages: +1\n", told)
        assert "(A1)" in told


def test_files_are_the_same_bytes_every_time():
    assert [write for write in (svg, pdf, dxf) if write(sheet("press").drawing) != write(sheet("press").drawing)] == []


@pytest.mark.slow
@for_each("kind", KINDS)
def test_dxf_says_the_same_when_read_again(kind):
    one, document = sheet(kind), reread(kind)
    assert document.audit().errors == []
    assert (document.dxfversion, document.header["$INSUNITS"], document.header["$MEASUREMENT"]) == ("AC1024", 4, 1)
    space = document.modelspace()
    drawn = [item for item in one.items if isinstance(item, Polyline) and pen_of(item.kind).width]
    for item, other in zip(drawn, space.query("LWPOLYLINE"), strict=True):
        assert np.allclose(np.array(other.get_points("xy")), item.points, rtol=0, atol=1e-9)
        assert other.closed == item.closed
        if isinstance(item.kind, str):
            assert other.dxf.layer == item.kind.upper()
        # what is light on the sheet is light there
        is_light = document.layers.get(other.dxf.layer).dxf.color != 7
        assert is_light == (shade_of(pen_of(item.kind)) > 0.3)
    circles = [item for item in one.items if isinstance(item, Circle)]
    assert len(space.query("CIRCLE")) == sum(pen_of(item.kind).width > 0 for item in circles)
    cleared = [item for item in one.items if isinstance(item, Polyline | Circle) and item.fill == 1]
    assert len(space.query("WIPEOUT")) == len(cleared)
    assert len(space.query("ARC")) == sum(isinstance(item, Arc) for item in one.items)
    # all is on the paper
    covered = bbox.extents(space)
    assert min(covered.extmin.x, covered.extmin.y) >= -1e-6
    assert covered.extmax.x <= 841 + 1e-6
    assert covered.extmax.y <= 594 + 1e-6


@pytest.mark.slow
@for_each("kind", KINDS)
def test_dxf_has_every_text_at_its_height_on_one_line(kind):
    space = reread(kind).modelspace()
    plain = [(one.dxf.text, round(one.dxf.height, 6)) for one in space.query("TEXT")]
    coded = [one.plain_text().replace("^", "") for one in space.query("MTEXT")]
    heights = {height for _, height in plain} | {round(one.dxf.char_height, 6) for one in space.query("MTEXT")}
    # GOST 2.304, ISO 3098
    assert heights <= {2.5, 3.5, 5.0, 7.0, 10.0, 14.0, 20.0}
    expected = texts(sheet(kind))
    assert len(plain) + len(coded) == len(expected)
    marked = [one for one in expected if any(run.shift or run.is_slanted for run in runs(one.text))]
    assert {(one.text, round(one.height, 6)) for one in expected if one not in marked} <= set(plain)
    letters = {"".join("".join(run.text for run in runs(one.text)).split()).replace("/", "") for one in marked}
    assert letters <= {"".join(text.split()).replace("/", "") for text in coded}
    for one in space.query("MTEXT"):
        if not one.dxf.rotation:
            assert bbox.extents([one]).size.y < 2.5 * one.dxf.char_height, one.text


def test_a_force_measured_in_dxf_is_the_force():
    """The largest radial force, from the coordinates of the file and the scale written in it."""
    drawing = sheets("spark-engine", "ru")[1].figure("crankpin_forces").drawing
    (plot,) = drawing.plots
    (expected,) = lines(drawing, "radial_force")
    again = [np.array(one.get_points("xy")) for one in reread("engine").modelspace().query("LWPOLYLINE")]
    (found,) = (one for one in again if one.shape == expected.shape and np.allclose(one, expected, atol=1e-9))
    zero = plot.box.bottom - plot.box.height * plot.y[0] / (plot.y[1] - plot.y[0])
    largest = np.max(found[:, 1] - zero) * scale(drawing, "T,K,N") * 1e3  # kN
    forces = results("spark-engine").columns["radial_force"]
    assert largest >= np.max(forces) * (1 - 1e-9)
    assert largest == pytest.approx(np.max(forces), rel=0.01)


def test_dashes_of_dxf_run_through_the_corners_in_millimetres():
    document = reread("engine")
    dashed = document.layers.get("DASHED")
    assert dashed.dxf.linetype == "DASHED"
    pattern = [tag.value for tag in document.linetypes.get("DASHED").pattern_tags.tags if tag.code == 49]
    assert pattern == [4.0, -1.5]
    assert document.layers.get("THICK").dxf.lineweight == 70
    found = [one for one in document.modelspace().query("LWPOLYLINE") if one.dxf.layer == "DASHED"]
    assert found
    assert all(one.dxf.flags & 128 for one in found)


@functools.cache
def typst_font():
    """Return the characters and widths of the font that PDF is set in, which typst carries within itself."""
    data = next(Path(typst.__file__).parent.glob("_typst*")).read_bytes()
    start = 0
    while (start := data.find(b"OTTO", start)) >= 0:
        try:
            font = TTFont(io.BytesIO(data[start : start + 4_000_000]), lazy=True)
            if font["name"].getDebugName(4) == "Libertinus Serif Regular":
                widths = font["hmtx"]
                unit = font["head"].unitsPerEm
                return {code: widths[name][0] / unit for code, name in font.getBestCmap().items()}
        except (TTLibError, AssertionError, KeyError, ValueError):
            pass
        start += 4
    raise AssertionError("typst no longer carries Libertinus Serif; look for the font of the sheets")


def test_no_glyph_is_missing_and_texts_are_no_wider_than_the_room_left_for_them():
    font, wide = typst_font(), []
    for one in (one for kind in KINDS for one in texts(sheet(kind))):
        letters = {ord(letter) for run in runs(one.text) for letter in run.text}
        assert [chr(code) for code in letters if code not in font] == [], one
        true = sum(font[ord(letter)] * (INDEX if run.shift else 1) for run in runs(one.text) for letter in run.text)
        if true * one.height / CAP_HEIGHT > text_width(one.text, one.height) + 0.4:
            wide.append(one.text)
    assert wide == []


@pytest.mark.slow
def test_the_font_of_a_browser_has_every_letter():
    from matplotlib.font_manager import findfont, get_font

    font = get_font(findfont("DejaVu Serif"))
    letters = {ord(letter) for kind in KINDS for one in texts(sheet(kind)) for letter in one.text}
    assert [chr(code) for code in letters if not font.get_char_index(code)] == []


def test_text_from_outside_cannot_break_a_file():
    nasty = TitleBlock("ru", designation="<\x00&\"'>\\P{;}^I %%c", title="#set page(width: 1mm)", institution="日本")
    drawing = sheets("press", "vi")[0]._replace(paper=Paper(block=nasty)).drawing
    ET.fromstring(svg(drawing))  # noqa: S314 - our own
    (width,) = re.findall(rb"/MediaBox ?\[0 0 ([\d.]+)", pdf(drawing))
    assert float(width) == pytest.approx(841 / 25.4 * 72, abs=0.01)
    assert ezdxf.read(io.StringIO(dxf(drawing).decode())).audit().errors == []


@for_each(("write", "module", "name"), [(pdf, "typst", "PDF"), (dxf, "ezdxf", "DXF")])
def test_a_missing_part_is_named(write, module, name):
    with pytest.MonkeyPatch.context() as patched:
        patched.setitem(sys.modules, module, None)
        with pytest.raises(MissingExtraError, match=f"writing {name} needs an optional part"):
            write(sheet("press").drawing)
