"""Sheets as files: SVG and PDF of the right size in every language, DXF that says the same when it is read again."""

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
from matplotlib.font_manager import findfont, get_font

from crankwork.analysis import analyse
from crankwork.analysis.whole_engine import as_engine
from crankwork.description.machine_file import read, read_machine, template
from crankwork.errors import MissingExtraError
from crankwork.note.sheets import (
    Paper,
    TitleBlock,
    drawn_sheets,
)
from crankwork.quantities import LANGUAGES
from crankwork.show.dxf import dxf
from crankwork.show.pdf import pdf
from crankwork.show.scene import (
    CAP_HEIGHT,
    INDEX,
    Arc,
    Circle,
    Polyline,
    Text,
    pen_of,
    runs,
    shade_of,
    text_width,
    thinned,
)
from crankwork.show.svg import svg

EXAMPLES = Path(__file__).parents[2] / "examples"
SVG = "{http://www.w3.org/2000/svg}"
BLOCK = TitleBlock(
    "ru", designation="КП.01.02.000 <&>", title="Đồ thị công", institution="ĐHBK Hà Nội", author="Щербаков Ю. Ё."
)


@functools.cache
def results(name):
    return analyse(read(EXAMPLES / f"{name}.toml"))


@functools.cache
def sheets(language, size="A1"):
    paper = Paper(size=size, block=BLOCK)
    return (
        *drawn_sheets(as_engine(results("spark-engine")), language, paper=paper)[:2],
        *drawn_sheets(results("press-geometry"), language, paper=paper),
        *drawn_sheets(results("press"), language, paper=paper),
    )


def texts(language):
    found = [one for sheet in sheets(language) for one in sheet.items if isinstance(one, Text)]
    assert len(found) > 400
    return found


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(("size", "width", "height"), [("A1", 841, 594), ("A0", 1189, 841)])
def test_svg_is_in_millimetres(language, size, width, height):
    for sheet in sheets(language, size):
        root = ET.fromstring(svg(sheet.drawing))  # noqa: S314 - our own
        assert (root.get("width"), root.get("height")) == (f"{width}mm", f"{height}mm")
        assert root.get("viewBox") == f"0 0 {width} {height}"
        assert root.findtext(f"{SVG}title") == sheet.title


def test_a_curve_in_svg_is_the_curve_of_the_sheet():
    sheet = sheets("ru")[0]
    root = ET.fromstring(svg(sheet.drawing))  # noqa: S314 - our own
    (path,) = (one for one in root.iter(f"{SVG}path") if one.get("class") == "piston_velocity")
    points = np.array([one.split() for one in path.get("d")[1:].split("L")], dtype=float)
    (expected,) = (one.points for one in sheet.items if isinstance(one, Polyline) and one.name == "piston_velocity")
    assert np.allclose(points * [1, -1] + [0, 594], thinned(expected), atol=6e-4)


def test_every_text_is_in_the_svg_once():
    sheet = sheets("vi")[1]
    root = ET.fromstring(svg(sheet.drawing))  # noqa: S314 - our own
    written = sorted("".join(one.itertext()) for one in root.iter(f"{SVG}text"))
    assert written == sorted(
        "".join(run.text for run in runs(one.text)) for one in sheet.items if isinstance(one, Text)
    )
    assert "КП.01.02.000 <&>" in written


@pytest.mark.parametrize("language", LANGUAGES)
def test_pdf_has_one_page_of_exactly_the_size(language, tmp_path):
    for size, width, height in (("A1", 841, 594), ("A0", 1189, 841)):
        data = pdf(sheets(language, size)[1].drawing)
        (box,) = re.findall(rb"/MediaBox ?\[0 0 ([\d.]+) ([\d.]+)\]", data)
        assert [float(one) for one in box] == pytest.approx([width / 25.4 * 72, height / 25.4 * 72], abs=0.01)
        if shutil.which("pdfinfo"):
            (tmp_path / "sheet.pdf").write_bytes(data)
            told = subprocess.run(
                ["pdfinfo", tmp_path / "sheet.pdf"], capture_output=True, text=True, check=True
            ).stdout
            assert re.search(r"Pages: +1\n", told)
            assert f"({size})" in told


def test_files_are_the_same_bytes_every_time():
    sheet = sheets("en")[3]
    for write in (svg, pdf, dxf):
        assert (write(sheet.drawing) == write(sheet.drawing)) is True


@pytest.mark.parametrize("language", LANGUAGES)
def test_dxf_says_the_same_when_read_again(language):
    for sheet in sheets(language)[:3]:
        document = ezdxf.read(io.StringIO(dxf(sheet.drawing).decode()))
        assert document.audit().errors == []
        assert (document.dxfversion, document.header["$INSUNITS"], document.header["$MEASUREMENT"]) == ("AC1024", 4, 1)
        space = document.modelspace()
        lines = [one for one in sheet.items if isinstance(one, Polyline) and pen_of(one.kind).width]
        again = list(space.query("LWPOLYLINE"))
        assert len(again) == len(lines)
        for one, other in zip(lines, again, strict=True):
            assert np.allclose(np.array(other.get_points("xy")), one.points, rtol=0, atol=1e-9)
            assert other.closed == one.closed
            if isinstance(one.kind, str):
                assert other.dxf.layer == one.kind.upper()
            # what is light on the sheet is light there
            is_light = document.layers.get(other.dxf.layer).dxf.color != 7
            assert is_light == (shade_of(pen_of(one.kind)) > 0.3)
        circles = [one for one in sheet.items if isinstance(one, Circle)]
        assert len(space.query("CIRCLE")) == sum(pen_of(one.kind).width > 0 for one in circles)
        cleared = [one for one in sheet.items if isinstance(one, Polyline | Circle) and one.fill == 1]
        assert len(space.query("WIPEOUT")) == len(cleared)
        assert len(space.query("ARC")) == sum(isinstance(one, Arc) for one in sheet.items)


def test_a_force_measured_in_dxf_is_the_force():
    """The largest radial force, from the coordinates of the file and the scale written in it."""
    sheet = sheets("en")[1]
    drawing = sheet.figure("crankpin_forces").drawing
    (plot,) = drawing.plots
    document = ezdxf.read(io.StringIO(dxf(sheet.drawing).decode()))
    (expected,) = (one.points for one in drawing.items if isinstance(one, Polyline) and one.name == "radial_force")
    again = [np.array(one.get_points("xy")) for one in document.modelspace().query("LWPOLYLINE")]
    (found,) = (one for one in again if one.shape == expected.shape and np.allclose(one, expected, atol=1e-9))
    scale = re.search(r"μ_\{F\} = ([\d.]+)", "".join(one.text for one in drawing.items if isinstance(one, Text)))
    zero = plot.box.bottom - plot.box.height * plot.y[0] / (plot.y[1] - plot.y[0])
    largest = np.max(found[:, 1] - zero) * float(scale[1]) * 1e3  # kN
    columns = results("spark-engine").columns
    assert largest >= np.max(columns["radial_force"]) * (1 - 1e-9)
    assert largest == pytest.approx(np.max(columns["radial_force"]), rel=0.01)


@pytest.mark.parametrize("language", LANGUAGES)
def test_dxf_has_every_text_at_its_height(language):
    sheet = sheets(language)[1]
    space = ezdxf.read(io.StringIO(dxf(sheet.drawing).decode())).modelspace()
    plain = [(one.dxf.text, one.dxf.height) for one in space.query("TEXT")]
    coded = [(one.plain_text().replace("^", ""), one.dxf.char_height) for one in space.query("MTEXT")]
    expected = [one for one in sheet.items if isinstance(one, Text)]
    assert len(plain) + len(coded) == len(expected)
    for one in expected:
        if not any(run.shift or run.is_slanted for run in runs(one.text)):
            assert any(text == one.text and height == pytest.approx(one.height) for text, height in plain), one
        else:
            letters = "".join("".join(run.text for run in runs(one.text)).split())
            assert any("".join(text.split()).replace("/", "") == letters.replace("/", "") for text, _ in coded), one


def test_dashes_of_dxf_run_through_the_corners_in_millimetres():
    document = ezdxf.read(io.StringIO(dxf(sheets("en")[1].drawing).decode()))
    dashed = document.layers.get("DASHED")
    assert dashed.dxf.linetype == "DASHED"
    pattern = [tag.value for tag in document.linetypes.get("DASHED").pattern_tags.tags if tag.code == 49]
    assert pattern == [4.0, -1.5]
    assert document.layers.get("THICK").dxf.lineweight == 70
    lines = [one for one in document.modelspace().query("LWPOLYLINE") if one.dxf.layer == "DASHED"]
    assert lines
    assert all(one.dxf.flags & 128 for one in lines)


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
                scale = font["head"].unitsPerEm
                return {code: widths[name][0] / scale for code, name in font.getBestCmap().items()}
        except (TTLibError, AssertionError, KeyError, ValueError):
            pass
        start += 4
    raise AssertionError("typst no longer carries Libertinus Serif; look for the font of the sheets")


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_glyph_is_missing(language):
    font, other = typst_font(), get_font(findfont("DejaVu Serif"))
    for one in texts(language):
        letters = {ord(letter) for run in runs(one.text) for letter in run.text}
        assert [chr(code) for code in letters if code not in font] == [], one
        assert [chr(code) for code in letters if not other.get_char_index(code)] == [], one


@pytest.mark.parametrize("language", LANGUAGES)
def test_texts_are_no_wider_than_the_room_left_for_them(language):
    font = typst_font()
    for one in texts(language):
        true = sum(font[ord(letter)] * (INDEX if run.shift else 1) for run in runs(one.text) for letter in run.text)
        assert true * one.height / CAP_HEIGHT <= text_width(one.text, one.height) + 0.4, one


def test_text_from_outside_cannot_break_a_file():
    nasty = TitleBlock("ru", designation="<\x00&\"'>\\P{;}^I %%c", title="#set page(width: 1mm)", institution="日本")
    (sheet,) = drawn_sheets(results("press"), "en", paper=Paper(block=nasty))
    ET.fromstring(svg(sheet.drawing))  # noqa: S314 - our own
    (width,) = re.findall(rb"/MediaBox ?\[0 0 ([\d.]+)", pdf(sheet.drawing))
    assert float(width) == pytest.approx(841 / 25.4 * 72, abs=0.01)
    document = ezdxf.read(io.StringIO(dxf(sheet.drawing).decode()))
    assert document.audit().errors == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_readers_of_dxf_break_no_text_and_find_all_on_the_paper(language):
    for sheet in sheets(language):
        space = ezdxf.read(io.StringIO(dxf(sheet.drawing).decode())).modelspace()
        covered = bbox.extents(space)
        assert min(covered.extmin.x, covered.extmin.y) >= -1e-6, sheet.name
        assert covered.extmax.x <= 841 + 1e-6, sheet.name
        assert covered.extmax.y <= 594 + 1e-6, sheet.name
        for one in space.query("MTEXT"):
            if not one.dxf.rotation:
                assert bbox.extents([one]).size.y < 2.5 * one.dxf.char_height, one.text


@pytest.mark.parametrize(("write", "module", "format"), [(pdf, "typst", "PDF"), (dxf, "ezdxf", "DXF")])
def test_a_missing_part_is_named(write, module, format, monkeypatch):  # noqa: A002 - what it is
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(MissingExtraError, match=f"writing {format} needs an optional part"):
        write(sheets("en")[1].drawing)


def test_sheets_of_the_templates_are_written():
    for name in ("compressor", "four-bar", "crank-shaper"):
        found = analyse(read_machine(template(name)))
        made = drawn_sheets(found)
        for one in made:
            assert svg(one.drawing).startswith(b"<svg")
            assert dxf(one.drawing).rstrip().endswith(b"EOF")
