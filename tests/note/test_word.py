"""The note as a Word file: python-docx opens it and finds headings, tables, equations and figures."""

from __future__ import annotations

import functools
import io
import re
import zipfile

import docx
import pytest

from crankwork.note.document import Equation, Heading, Math, Note, PageBreak, Strong, Table
from crankwork.note.equations import printed_equation
from crankwork.note.numbering import numbering
from crankwork.note.word import word
from crankwork.note.word_parts import table_columns
from crankwork.quantities import LANGUAGES
from crankwork.show.svg import svg
from each import for_each

MATH = "{http://schemas.openxmlformats.org/officeDocument/2006/math}"
WORD = "{http://schemas.openxmlformats.org/wordprocessingml/2006/main}"


def _opened(note):
    return docx.Document(io.BytesIO(word(note)))


@pytest.fixture(scope="module")
def written(samples):
    """Return the sample as a Word file, by language."""
    return functools.cache(lambda language: word(samples[language]))


def _words(element):
    return "".join(one.text or "" for one in element.iter(f"{MATH}t", f"{WORD}t"))


@for_each("language", LANGUAGES)
def test_headings_are_headings_and_text_is_as_it_was(samples, written, hostile, language):
    assert word(samples[language]) == written(language)
    opened = docx.Document(io.BytesIO(written(language)))
    headings = [(one.style.name, one.text) for one in opened.paragraphs if one.style.name.startswith("Heading")]
    assert headings == [("Heading 1", f"1 {hostile}"), ("Heading 2", "1.1 Động học"), ("Heading 1", "References")]
    assert opened.core_properties.title == hostile
    assert opened.core_properties.language.startswith(language)
    cover = opened.tables[0]._cells
    assert [one.text for one in cover[1].paragraphs if one.style.name == "Title"] == [hostile]
    assert cover[2].tables[0].rows[0].cells[0].text == "Выполнил:"
    # every line of mathematics is a paragraph of its own
    body = opened.element.body
    lines = [_words(one) for one in body.iter(f"{MATH}oMathPara")]
    mark = "." if language == "en" else ","
    assert [sum(f"{one}" in line for line in lines) for one in (f"87{mark}9146", f"0{mark}2045")] == [1, 1]
    assert all(len(one.findall(f"{MATH}oMath")) == 1 for one in body.iter(f"{MATH}oMathPara"))
    assert all(len(one.findall(f".//{MATH}oMathPara")) <= 1 for one in body.iter(f"{WORD}p"))


def test_tables_contents_and_figures_are_those_of_word(written, hostile, drawing):
    opened = docx.Document(io.BytesIO(written("ru")))
    table = next(one for one in opened.tables if one._tbl.xpath(".//w:tblHeader"))
    assert len(table.rows) == 61
    assert len(table._tbl.xpath(".//w:tblHeader")) == 1
    assert [section.page_width > section.page_height for section in opened.sections] == [False, True, False]
    # the contents show the sections and ask for their pages
    body = opened.element.body
    links = [one.get(f"{WORD}anchor") for one in body.iter(f"{WORD}hyperlink")]
    marks = [one.get(f"{WORD}name") for one in body.iter(f"{WORD}bookmarkStart")]
    asked = [one.text.split()[1] for one in body.iter(f"{WORD}instrText") if "PAGEREF" in one.text]
    assert links == marks == asked
    assert len(marks) == 3
    kinds = [one.get(f"{WORD}fldCharType") for one in body.iter(f"{WORD}fldChar")]
    assert kinds == ["begin", "separate", "end"] * 3
    # a figure is a picture with a drawing beside it and a description
    (shape,) = opened.inline_shapes
    assert shape._inline.docPr.get("descr") == hostile
    blip = shape._inline.graphic.graphicData.pic.blipFill.blip
    (embedded,) = re.findall(r'svgBlip[^>]*r:embed="(\w+)"', docx.oxml.xmlchemy.serialize_for_reading(blip))
    assert opened.part.related_parts[embedded].blob == svg(drawing)
    with zipfile.ZipFile(io.BytesIO(written("ru"))) as members:
        assert {"word/media/drawing1.svg", "word/media/image1.png"} <= set(members.namelist())
        assert {entry.date_time for entry in members.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_a_table_with_too_many_columns_goes_on_in_another_in_letters_of_nine_points_at_least():
    headings = (("Pos.",), ("φ",), *(((Math(f"v_{k}"), ", m/s")) for k in range(12)))
    rows = [[f"{k}", f"{30 * k}", *(f"−0.{k:02}{n:02}" for n in range(12))] for k in range(13)]
    note = Note(
        "t", "en", (Table("Velocities", headings, rows, align="cc" + 12 * "r"), Table("Last", (("x",),), [["1"]]))
    )
    body = _opened(note).element.body
    parts = [[[_words(cell) for cell in row.iter(f"{WORD}tc")] for row in table.iter(f"{WORD}tr")]
             for table in body.iter(f"{WORD}tbl")][:2]  # fmt: skip
    for row, *halves in zip(rows, *(part[1:] for part in parts), strict=True):
        assert all(half[:2] == row[:2] for half in halves)
        assert [cell for half in halves for cell in half[2:]] == row[2:]
    captions = [_words(one) for one in body.iter(f"{WORD}p") if "Table" in _words(one)]
    assert captions == ["Table 1. Velocities", "Table 1 (continued)", "Table 2. Last"]
    sizes = [int(one.get(f"{WORD}val")) for one in body.iter(f"{WORD}sz") if one.getparent().tag == f"{WORD}rPr"]
    assert min(sizes) >= 18


def test_a_row_in_bold_has_room_in_its_column():
    """Letters in bold are a tenth wider; where a row has its height, what does not fit in a line is not seen."""
    widths = [table_columns(Table("t", (("j",),), [[kind("−1361.7364")]]), numbering(Note("t", "en", ()))).widths[0]
              for kind in (str, Strong)]  # fmt: skip
    assert widths[1] > 1.07 * widths[0]


def test_a_symbol_in_a_cell_is_an_equation():
    body = _opened(Note("t", "en", (Table("c", (("a",),), [[Math("V_h")]]),))).element.body
    (cell,) = body.iter(f"{MATH}oMath")
    assert (_words(cell), len(list(cell.iter(f"{MATH}sSub")))) == ("Vh", 1)


@pytest.mark.slow
def test_every_formula_is_an_equation_of_word(steps):
    body = _opened(Note("t", "ru", tuple(map(Equation, steps)))).element.body
    assert len(body.findall(f"{WORD}tbl")) == len(steps)
    assert all("0,1234" in _words(one) for one in body.findall(f"{WORD}tbl"))
    # lines are divided sooner than in the PDF
    lines = sum(len(printed_equation(Equation(one), "ru").lines) for one in steps[::4])
    parts = [len(list(one.iter(f"{MATH}oMathPara"))) for one in body.findall(f"{WORD}tbl")]
    assert sum(parts[::4]) > 1.1 * lines


def test_a_wide_table_turns_its_page_wherever_it_stands():
    for place, wanted in enumerate(([True, False], [False, True, False], [False, True])):
        blocks = [Heading(1, "a"), PageBreak()]
        blocks.insert(place, Table("t", (("x",),), [["1"]], wide=True))
        sections = _opened(Note("t", "en", tuple(blocks))).sections
        assert [section.page_width > section.page_height for section in sections] == wanted, place


def test_a_table_of_ten_thousand_rows_is_whole():
    rows = [[str(k), f"{k / 7:.3f}"] for k in range(10_000)]
    with zipfile.ZipFile(io.BytesIO(word(Note("t", "en", (Table("c", (("a",), ("b",)), rows),))))) as members:
        text = members.read("word/document.xml").decode("utf-8")
    assert text.count("<w:tr>") == 10_001
    assert f"{9999 / 7:.3f}" in text


def test_control_characters_and_emoji_do_no_harm():
    opened = _opened(Note("a\x00\x1b\ud800\N{GRINNING FACE}\n<b>", "en", (Heading(1, "x\x08y\u2028z"),)))
    assert opened.core_properties.title == "a\N{GRINNING FACE} <b>"
    assert opened.paragraphs[0].text == "1 xy z"
