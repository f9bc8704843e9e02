"""The note as a web page: well formed, complete, and asking nobody for anything."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from html.parser import HTMLParser

from crankwork.note.document import Equation, Figure, Math, Note, Table
from crankwork.note.web import web
from crankwork.quantities import LANGUAGES
from each import for_each

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


@for_each("language", LANGUAGES)
def test_a_page_is_well_formed_and_asks_nobody_for_anything(samples, hostile, language):
    page = web(samples[language])
    assert web(samples[language]) == page
    reader = _read(page)
    assert dict(reader.seen)["html"] == {"lang": language}
    assert "".join(reader.words).count(hostile) == 11 + 60
    assert "script" not in {tag for tag, _ in reader.seen}
    addresses = [value for _, attrs in reader.seen for name, value in attrs.items() if name in ("href", "src")]
    assert [one for one in addresses if not one.startswith("#")] == []
    assert not re.search(rb"url\((?!#)|@import", page)
    assert not any(name.startswith("on") for _, attrs in reader.seen for name in attrs)
    # links of the contents lead to headings
    links = [attrs["href"] for tag, attrs in reader.seen if tag == "a"]
    assert links == [f"#{attrs['id']}" for tag, attrs in reader.seen if re.fullmatch("h[2-4]", tag)]


def test_symbols_drawings_and_long_tables_stand_in_the_page(drawing):
    rows = [[str(k), f"{k / 7:.3f}"] for k in range(10_000)]
    blocks = (
        Table("c", (("a",),), [[Math("V_h")]]),
        Figure(drawing, "a", "what is seen", label="f:name"),
        Table("c", (("a",), ("b",)), rows),
    )
    page = web(Note("t", "vi", blocks)).decode("utf-8")
    assert re.search("<td><math><msub>.*?</msub></math></td>", page)
    assert re.search(r'<svg class=drawing data-figure=name [^>]*role=img aria-label="what is seen"', page)
    assert page.count("<script") == 0
    assert page.count("<tr>") == 10_001 + 2
    assert f"{9999 / 7:.3f}" in page


@for_each(("language", "every"), [("ru", 1), ("en", 20)])
def test_every_formula_is_mathml(steps, language, every):
    chosen = steps[::every]
    page = web(Note("t", language, tuple(map(Equation, chosen)))).decode("utf-8")
    lines = re.findall(r"<math display.*?</math>", page)
    assert len(lines) >= len(chosen)
    for line in lines:
        ET.fromstring(line)  # noqa: S314 - our own text
    assert len(re.findall(r"<mn>0[.,]1234[56]\d*</mn>", page)) >= len(chosen)
    assert ("<mn>0.1234" in page) == (language == "en")
