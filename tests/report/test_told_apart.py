"""What tells curves apart where nothing has a colour, and what becomes of names with any letters in figures."""

from __future__ import annotations

import itertools
import re
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from crankwork.analysis import analyse
from crankwork.description.machine_file import read
from crankwork.quantities import LANGUAGES
from crankwork.report.figures import drawings
from crankwork.report.not_drawn import not_drawn
from crankwork.show.pdf import png
from crankwork.show.scene import Drawing, Polyline, Text, pen_of, shade_of
from crankwork.show.svg import svg

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.toml"))
# contrast of lines with their ground that is asked for of pictures, and what is no less apart in shade or width
CONTRAST, SHADES, WIDTHS = 3.0, 0.25, 1.3


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


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_curves_of_a_graph_are_told_apart_in_grey_and_seen_on_paper(path):
    for name, drawing in drawings(analyse(read(path))).items():
        for pens in _curves(drawing):
            alike = [pair for pair in itertools.combinations(pens, 2) if not _are_apart(*(pens[one] for one in pair))]
            assert alike == [], name
            assert all(_contrast(shade_of(one)) >= CONTRAST for one in pens.values()), name


AWKWARD = ["<b>", "a&b", 'q"q', "{x}", "p_q_r", "u^v", "back\\slash", "$m$", "long" * 12]


@pytest.fixture
def awkward(tmp_path):
    """Return a parallelogram whose points and links have names with letters that mean something elsewhere."""
    text = (ROOT / "examples" / "parallelogram.toml").read_text(encoding="utf-8")

    def named(name):
        return "'" + name + "'"

    for old, new in zip(["A", "B", "C", "O", "P"], AWKWARD, strict=False):
        text = re.sub(rf'"{old}"', named(new), text)
        text = re.sub(rf"(?m)^{old} = |(?<=\{{ ){old} = ", f"{named(new)} = ", text)
    for old, new in zip(["coupler", "rocker"], AWKWARD[5:], strict=False):
        text = text.replace(f"[links.{old}]", f"[links.{named(new)}]")
    path = tmp_path / "awkward.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("language", LANGUAGES)
def test_names_with_any_letters_are_printed_as_they_are(awkward, language):
    found = drawings(analyse(read(awkward)), language=language)
    texts = []
    for drawing in found.values():
        root = ET.fromstring(svg(drawing))  # noqa: S314 - our own bytes
        texts += ["".join(one.itertext()) for one in root.iter("{http://www.w3.org/2000/svg}text")]
    for name in ("<b>", "a&b", 'q"q', "p_q_r"):
        assert any(name in one for one in texts), name


def test_letters_without_a_glyph_are_boxes_in_a_picture_and_not_lost():
    def drawn(text):
        return png(Drawing("t", "en", 40.0, 10.0, (Text((2.0, 3.0), text),)), pixels_per_inch=60.0)

    assert len({drawn(one) for one in ("ab", "a😀b", "a😀中b")}) == 3
    assert "a😀中b" in svg(Drawing("t", "en", 40.0, 10.0, (Text((2.0, 3.0), "a😀中b"),))).decode()


def test_what_is_not_drawn_is_told():
    told = [*not_drawn(analyse(read(ROOT / "examples" / "parallelogram.toml")), "en")]
    assert told == ["not drawn, because zero throughout: static torque"]
    told = [*not_drawn(analyse(read(ROOT / "examples" / "excavator-boom.toml")), "ru")]
    assert told[0].startswith("планы сил не построены")
