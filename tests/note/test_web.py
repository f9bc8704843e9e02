"""The note as a web page: well formed, complete, and asking nobody for anything."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from html.parser import HTMLParser

import pytest

from crankwork.note.document import Equation, Figure, Math, Note, Table
from crankwork.note.web import web
from crankwork.quantities import LANGUAGES

_EMPTY = {"meta", "br", "hr", "img"}


class _Reader(HTMLParser):
    """Reads a page; every element that opens must close."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[tuple[str, dict[str, str | None]]] = []
        self.words: list[str] = []

    def handle_starttag(self, tag, attrs):
        self.seen.append((tag, dict(attrs)))
        if tag not in _EMPTY:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.seen.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if not self.open or self.open[-1] != "style":
            self.words.append(data)


def _read(page: bytes) -> _Reader:
    reader = _Reader()
    reader.feed(page.decode("utf-8"))
    reader.close()
    assert reader.open == []
    return reader


def test_a_page_is_well_formed_and_in_its_language(note, hostile):
    page = web(note)
    assert web(note) == page
    reader = _read(page)
    assert dict(reader.seen)["html"] == {"lang": note.language}
    assert "".join(reader.words).count(hostile) == 11 + 60


def test_a_page_asks_nobody_for_anything(note):
    page = web(note)
    reader = _read(page)
    assert "script" not in {tag for tag, _ in reader.seen}
    addresses = [value for _, attrs in reader.seen for name, value in attrs.items() if name in ("href", "src")]
    assert all(one.startswith("#") for one in addresses)
    assert not re.search(rb"url\((?!#)|@import", page)
    assert not any(name.startswith("on") for _, attrs in reader.seen for name in attrs)


def test_a_symbol_in_a_cell_is_mathematics():
    page = web(Note("t", "en", (Table("c", (("a",),), [[Math("V_h")]]),))).decode("utf-8")
    assert re.search("<td><math><msub>.*</msub></math></td>", page)


def test_links_of_the_contents_lead_to_headings(note):
    reader = _read(web(note))
    links = [attrs["href"] for tag, attrs in reader.seen if tag == "a"]
    headings = [f"#{attrs['id']}" for tag, attrs in reader.seen if re.fullmatch("h[2-4]", tag)]
    assert links == headings


def test_a_drawing_stands_in_the_page_with_its_description(drawing):
    page = web(Note("t", "en", (Figure(drawing, "a", "what is seen", label="f:name"),))).decode("utf-8")
    assert re.search(r'<svg class=drawing data-figure=name [^>]*role=img aria-label="what is seen"', page)
    assert page.count("<script") == 0


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_formula_is_mathml(steps, language):
    page = web(Note("t", language, tuple(map(Equation, steps)))).decode("utf-8")
    lines = re.findall(r"<math display.*?</math>", page)
    assert len(lines) >= len(steps)
    for line in lines:
        ET.fromstring(line)  # noqa: S314 - our own text
    assert len(re.findall(r"<mn>0[.,]1234[56]\d*</mn>", page)) >= len(steps)
    assert ("<mn>0.1234" in page) == (language == "en")


def test_a_table_of_ten_thousand_rows_is_whole():
    rows = [[str(k), f"{k / 7:.3f}"] for k in range(10_000)]
    page = web(Note("t", "vi", (Table("c", (("a",), ("b",)), rows),)))
    assert page.count(b"<tr>") == 10_001
    assert f"{9999 / 7:.3f}".encode() in page
