"""Figures in every format and theme: what is written is what was drawn."""

from __future__ import annotations

import io
import json
import re
from pathlib import Path
from xml.etree import ElementTree as ET

import ezdxf
import numpy as np
import pytest

import crankwork
from crankwork.description.machine_file import read_machine, template
from crankwork.errors import CrankworkError
from crankwork.report.figures import drawings
from crankwork.show.dxf import dxf
from crankwork.show.pdf import pdf, png
from crankwork.show.scene import Drawing, Polyline, Text, literal, pen_of, runs, thinned
from crankwork.show.svg import svg
from crankwork.show.theme import THEMES, look_of

SVG = "{http://www.w3.org/2000/svg}"
EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module", params=["spark-engine", "knuckle-press", "punching-machine"])
def drawn(request) -> dict[str, Drawing]:
    return drawings(crankwork.analyse(crankwork.read(EXAMPLES / f"{request.param}.toml")), language="ru")


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
            kind = f"{len(pattern.split())}{'.' if pattern and float(pattern.split()[0]) < 0.8 else ''}"
            found.setdefault(kind, set()).add(one.get("stroke", ""))
    return found


@pytest.mark.parametrize("theme", THEMES)
def test_curves_and_letters_stand_out_from_the_ground(drawn, theme):
    ground = look_of(theme).ground
    for one in drawn.values():
        data = svg(one, theme)
        assert f'height="{ET.fromstring(data).get("viewBox").split()[3]}" fill="{ground}"'.encode() in data  # noqa: S314
        for colours in _strokes(data).values():
            assert all(_contrast(colour, ground) >= 3.0 for colour in colours)
    assert _contrast(look_of(theme).ink, ground) > 12


def test_curves_of_one_figure_have_colours_of_their_own(drawn):
    """A sample in a legend has the dashes, and so the colour, of its curve."""
    for one in drawn.values():
        for theme in ("colour", "dark"):
            kinds = _strokes(svg(one, theme))
            assert all(len(colours) == 1 for colours in kinds.values())
            assert len(set().union(*kinds.values())) == len(kinds)
        assert set().union(*_strokes(svg(one)).values()) <= {"#000000", "#737373"}


def test_a_figure_as_dxf_passes_the_audit_and_has_its_texts(drawn):
    ezdxf = pytest.importorskip("ezdxf")
    for name, one in drawn.items():
        document = ezdxf.read(io.StringIO(dxf(one).decode()))
        assert not document.audit().errors, name
        space = document.modelspace()
        assert len(space.query("TEXT MTEXT")) == sum(isinstance(item, Text) for item in one.items)
        lines = sum(isinstance(item, Polyline) and pen_of(item.kind).width > 0 for item in one.items)
        assert len(space.query("LWPOLYLINE")) == lines


def test_a_figure_as_pdf_has_the_size_of_the_paper_and_as_png_its_pixels(drawn):
    pytest.importorskip("typst")
    name, one = next(iter(drawn.items()))
    data = pdf(one)
    assert data == pdf(one), name
    (width, height) = re.search(rb"/MediaBox ?\[0 0 ([\d.]+) ([\d.]+)", data).groups()
    assert (float(width), float(height)) == pytest.approx((one.width * 72 / 25.4, one.height * 72 / 25.4), abs=0.01)
    picture = png(one, "dark", 100.0)
    assert picture.startswith(b"\x89PNG")
    assert int.from_bytes(picture[16:20]) == pytest.approx(one.width / 25.4 * 100, abs=1.0)


def test_a_picture_is_restyled_and_saved_by_its_ending(tmp_path):
    results = crankwork.analyse(crankwork.read(EXAMPLES / "spark-engine.toml"))
    picture = results.figure("torque")
    dark = picture.styled("dark")
    assert (picture.theme, dark.theme) == ("print", "dark")
    assert dark.svg != picture.svg == results.figure("torque").svg
    assert look_of("dark").ground in dark.svg
    for ending, begin in (("svg", b"<svg"), ("pdf", b"%PDF"), ("png", b"\x89PNG"), ("dxf", b"  0")):
        path = tmp_path / f"torque.{ending}"
        dark.save(path)
        assert path.read_bytes().startswith(begin)
    with pytest.raises(CrankworkError, match="svg, pdf, png, dxf"):
        picture.save(tmp_path / "torque.eps")
    with pytest.raises(CrankworkError, match="print, colour, dark"):
        picture.styled("neon")


@pytest.mark.parametrize("seed", range(4))
def test_a_thinned_line_leaves_no_point_further_away_than_nobody_sees(seed):
    walk = np.cumsum(np.random.default_rng(seed).normal(size=(400, 2)) * (0.05, 0.01), axis=0)
    # a loop that ends where it begins, and a line drawn twice
    points = np.vstack([walk, walk[::-1]]) if seed % 2 else walk
    kept = thinned(points)
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


@pytest.mark.parametrize("name", ["Шарнир Ж", "khớp nối ậ", "φ₁", "ο′", "№ 5 %%d", "~x;"])
def test_letters_of_names_come_back_from_dxf(name):
    text = template("four-bar").replace('"A"', json.dumps(name))
    drawn = drawings(crankwork.analyse(read_machine(text)), language="vi")["joint_forces"]
    space = ezdxf.read(io.StringIO(dxf(drawn).decode())).modelspace()
    read = [one.plain_text() for one in space.query("TEXT MTEXT")]
    assert any(name.replace("%%", "% %") in one for one in read), read
    said = ["".join(run.text for run in runs(one.text)) for one in drawn.items if isinstance(one, Text)]
    assert sorted(_bare(one) for one in read) == sorted(_bare(one) for one in said)


def _bare(text):
    return "".join(text.replace("^", "").replace("%", "").split())
